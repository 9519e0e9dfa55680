/* assimp_paint.h: the colours of faces of assimp's models: of their materials, their corners and their textures.
 *
 *     glTF      the factor of the material, the mean of the corners, and that of the texture under the face, in shares
 * of
 *               light, multiplied (glTF 2.0, 3.9.2)
 *     others    the mean of the corners, if they have colours; or the mean of the texture; or the material's colour */
#ifndef FROE_IO_ASSIMP_PAINT_H
#define FROE_IO_ASSIMP_PAINT_H
#include "formats/input/paint.h"
#include "formats/input/texture.h"
#include <assimp/scene.h>

/** A material as faces are painted by it. */
typedef struct assimp_paint {
    const struct aiScene *scene;
    bool linear;             /**< glTF */
    bool textured;           /**< by this texture, */
    unsigned channel;        /**< and these places of corners */
    formats_texture texture; /**< pixels NULL: it cannot be read */
    uint32_t colour;         /**< of the material (see froe_group); 0: it has none */
    double factor[4];        /**< glTF: shares of light, and opacity */
} assimp_paint;

/** Reads what a material says. images: those of the model. FROE_E_MEMORY. */
froe_status assimp_paint_read(formats_sink *sink, const char *path, const struct aiScene *scene, unsigned material,
                              bool linear, formats_images *images, assimp_paint *out);
/** Do faces of that mesh have colours of their own? */
bool assimp_paint_varies(const assimp_paint *paint, const struct aiMesh *mesh);
/** The colour of a face with its corners in space, 3 numbers each; `places`: room for 2 numbers a corner. */
uint32_t assimp_paint_face(const assimp_paint *paint, const struct aiMesh *mesh, const struct aiFace *face,
                           const double *corners, double *places);
#endif
