/* shapes.h: shapes with attributes, and the files they are written to. */
#ifndef FROE_FORMATS_SHAPES_H
#define FROE_FORMATS_SHAPES_H

#include "formats/write/geojson.h"

/** How a file of shapes is written: its beginning, shapes, its end. */
typedef struct formats_shape_file {
    int least_dim, most_dim;
    froe_status (*check)(const froe_scene *scene, const char *path,
                         froe_diagnostic *diag); /**< can it be? May be NULL */
    /** `like` has the names of the attributes of all shapes to come. */
    void (*begin)(formats_writer *writer, const froe_scene *scene, const froe_part *like);
    void (*shape)(formats_writer *writer, const froe_part *shape, bool first);
    const char *end;
} formats_shape_file;

/** By extension; NULL: none is known. */
const formats_shape_file *formats_shape_file_of(const char *path);

#endif
