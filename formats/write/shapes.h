/* shapes.h: shapes with attributes, and the files they are written to. */
#ifndef FROE_FORMATS_SHAPES_H
#define FROE_FORMATS_SHAPES_H

#include "formats/write/geojson.h"

/** One attribute: a whole number, a text, or nothing ("unknown"). */
typedef struct formats_attribute {
    const char *name;
    const char *text; /**< NULL: a number */
    uint64_t number;
    bool missing;
} formats_attribute;

typedef enum formats_sort { FORMATS_POINTS, FORMATS_LINE, FORMATS_POLYGON, FORMATS_SURFACE } formats_sort;

enum { FORMATS_MOST_ATTRIBUTES = 12 };

/** What is written: geometry and attributes. Each shape of a file has the same attributes. */
typedef struct formats_shape {
    formats_sort sort;
    int dim;
    const double *coords; /**< dim doubles per corner */
    size_t corners;
    const size_t *starts; /**< surfaces: faces are corners starts[f] .. starts[f+1]-1 */
    size_t faces;
    formats_attribute attributes[FORMATS_MOST_ATTRIBUTES];
    int attribute_count;
} formats_shape;

/** How a file of shapes is written: its beginning, shapes, its end. */
typedef struct formats_shape_file {
    int least_dim, most_dim;
    froe_status (*check)(const froe_scene *scene, const char *path,
                         froe_diagnostic *diag); /**< can it be? May be NULL */
    /** `like` has the names of the attributes of all shapes to come. */
    void (*begin)(formats_writer *writer, const froe_scene *scene, const formats_shape *like);
    void (*shape)(formats_writer *writer, const formats_shape *shape, bool first);
    const char *end;
} formats_shape_file;

/** By extension; NULL: none is known. */
const formats_shape_file *formats_shape_file_of(const char *path);

#endif
