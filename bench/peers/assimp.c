/* assimp.c: the corners of a model by assimp, as it reads them, with no further work asked of it. */
#include "reading.h"
#include <assimp/cimport.h>
#include <assimp/scene.h>
#include <stdlib.h>
#include <string.h>

size_t reading_by_assimp(const char *path) {
    const struct aiScene *scene = aiImportFile(path, 0);
    size_t count = 0, at = 0;
    if (!scene) return 0;
    for (unsigned i = 0; i < scene->mNumMeshes; i++) count += scene->mMeshes[i]->mNumVertices;
    struct aiVector3D *points = malloc((count ? count : 1) * sizeof *points);
    if (!points) abort();
    for (unsigned i = 0; i < scene->mNumMeshes; i++) {
        memcpy(points + at, scene->mMeshes[i]->mVertices, scene->mMeshes[i]->mNumVertices * sizeof *points);
        at += scene->mMeshes[i]->mNumVertices;
    }
    free(points);
    aiReleaseImport(scene);
    return count;
}
