/* assimp_metadata.h: what a model says about itself beside its nodes and meshes, as assimp has it. */
#ifndef FROE_IO_ASSIMP_METADATA_H
#define FROE_IO_ASSIMP_METADATA_H
#include <assimp/scene.h>
#include <stdint.h>

/** What assimp calls the format of a scene; "": nothing. */
const char *io_assimp_format(const struct aiScene *scene);
/** A whole number of the scene, such as UpAxis; `otherwise` where it is not said. */
int32_t io_assimp_number(const struct aiScene *scene, const char *name, int32_t otherwise);
#endif
