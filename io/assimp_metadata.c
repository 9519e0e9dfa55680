/* assimp_metadata.c: a search among the pairs of names and values that a scene of assimp has. */
#include "assimp_metadata.h"
#include <assimp/commonMetaData.h>
#include <assimp/metadata.h>
#include <string.h>

/* NULL: the scene has no such value of that type. */
static const void *value_of(const struct aiScene *scene, const char *name, enum aiMetadataType type) {
    const void *found = NULL;
    for (unsigned i = 0; scene->mMetaData && i < scene->mMetaData->mNumProperties && !found; ++i) {
        const struct aiMetadataEntry *entry = &scene->mMetaData->mValues[i];
        if (!strcmp(scene->mMetaData->mKeys[i].data, name) && entry->mType == type) found = entry->mData;
    }
    return found;
}

const char *io_assimp_format(const struct aiScene *scene) {
    const struct aiString *format = value_of(scene, AI_METADATA_SOURCE_FORMAT, AI_AISTRING);
    return format ? format->data : "";
}

int32_t io_assimp_number(const struct aiScene *scene, const char *name, int32_t otherwise) {
    const void *number = value_of(scene, name, AI_INT32);
    if (number) memcpy(&otherwise, number, sizeof otherwise);
    return otherwise;
}
