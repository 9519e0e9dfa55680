/* mtl.h: colours of an OBJ's materials, from the file beside it. */
#ifndef FROE_FORMATS_MTL_H
#define FROE_FORMATS_MTL_H

#include "formats/input/sink.h"

/** Names and colours (see froe_group), as met. */
typedef struct formats_materials {
    formats_buffer all; /**< of material */
} formats_materials;

/** Adds the materials of the file `name`, as said in the OBJ `path`. Colours are no geometry: a file that is not there,
 * cannot be read, or lies elsewhere than at or below the OBJ, adds nothing. FROE_E_MEMORY. */
froe_status formats_materials_read(formats_sink *sink, const char *path, const char *name,
                                   formats_materials *materials);
/** Its colour; 0: unknown. */
uint32_t formats_material_colour(const formats_materials *materials, const char *name);
void formats_materials_free(formats_sink *sink, formats_materials *materials);

#endif
