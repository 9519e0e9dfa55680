/* mtl.h: colours and textures of an OBJ's materials, from the file beside it. */
#ifndef FROE_FORMATS_MTL_H
#define FROE_FORMATS_MTL_H

#include "formats/input/texture.h"

typedef struct formats_material {
    char *name;
    double rgba[4];
    bool coloured, textured; /**< textured: the colour only tints the texture, */
    char image[256];         /**< of this image, as the file names it; "": too long a name */
    formats_texture texture; /**< pixels NULL: it cannot be read */
} formats_material;
/** As met. */
typedef ARRAY(formats_material) formats_materials;

/** Adds the materials of the file `name`, as said in the OBJ `path`. Colours are no geometry: a file that is not there,
 * cannot be read, or lies elsewhere than at or below the OBJ, adds nothing. images: where textures are kept.
 * FROE_E_MEMORY. */
froe_status formats_materials_read(formats_sink *sink, const char *path, const char *name, formats_materials *materials,
                                   formats_images *images);
void formats_materials_free(const froe_allocator *alloc, formats_materials *materials);
/** The last of that name; NULL: there is none. */
const formats_material *formats_material_find(const formats_materials *materials, const char *name);
/** Its colour (see froe_group); 0: unknown. */
uint32_t formats_material_colour(const formats_material *material);
/** The colour of a face under its texture, tinted: corners and places as in formats_texture_mean(). 0: the texture
 * cannot be read. */
uint32_t formats_material_texel(const formats_material *material, const double *corners, const double *places,
                                size_t count);

#endif
