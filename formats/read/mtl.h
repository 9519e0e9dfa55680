/* mtl.h: colours of an OBJ's materials, from the file beside it. */
#ifndef FROE_FORMATS_MTL_H
#define FROE_FORMATS_MTL_H

#include "formats/input/sink.h"

enum { FORMATS_MATERIAL_NAME = 128 };
typedef struct formats_material {
    char name[FORMATS_MATERIAL_NAME];
    double rgba[4];
    bool coloured, painted; /**< painted: by a picture, the colour only tints it */
} formats_material;
/** As met. */
typedef ARRAY(formats_material) formats_materials;

/** Adds the materials of the file `name`, as said in the OBJ `path`. Colours are no geometry: a file that is not there,
 * cannot be read, or lies elsewhere than at or below the OBJ, adds nothing. FROE_E_MEMORY. */
froe_status formats_materials_read(formats_sink *sink, const char *path, const char *name,
                                   formats_materials *materials);
/** Its colour (see froe_group); 0: unknown. */
uint32_t formats_material_colour(const formats_materials *materials, const char *name);

#endif
