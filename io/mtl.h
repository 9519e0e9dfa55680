/* mtl.h: colours of an OBJ's materials, from the file beside it. */
#ifndef FROE_IO_MTL_H
#define FROE_IO_MTL_H

#include "sink.h"

/** Names and colours (see froe_group), as met. */
typedef struct io_materials {
    io_buffer all; /**< of material */
} io_materials;

/** Adds the materials of the file `name`, as said in the OBJ `path`. Colours are no geometry: a file that is not there,
 * cannot be read, or lies elsewhere than at or below the OBJ, adds nothing. FROE_E_MEMORY. */
froe_status io_materials_read(io_sink *sink, const char *path, const char *name, io_materials *materials);
/** Its colour; 0: unknown. */
uint32_t io_material_colour(const io_materials *materials, const char *name);
void io_materials_free(io_sink *sink, io_materials *materials);

/** A colour (see froe_group) of four shares, cut to 0 .. 1. */
uint32_t io_colour(const double rgba[4]);

#endif
