/* folder.h: a folder that is open, and the trees in it that were asked so far. */
#ifndef FROE_SHARDS_FOLDER_H
#define FROE_SHARDS_FOLDER_H
#include "manifest.h"

typedef struct shards_slot {
    froe_tree *tree; /**< NULL: not opened yet, or nothing to open */
    froe_query *query;
} shards_slot;

typedef struct shards_share shards_share;

struct froe_shards {
    int dim;
    uint32_t count;
    uint32_t first; /**< the first shard that has objects */
    shards_manifest manifest;
    shards_slot *slots;  /**< of each shard */
    shards_share *share; /**< with other processes; NULL: this one has all shards. See share.h */
    char *path;
    size_t path_size;
    froe_allocator alloc;
};

/** A context of the tree of a shard, which has objects. FROE_E_IO, FROE_E_FORMAT, FROE_E_MEMORY. */
froe_status shards_query(froe_shards *shards, uint32_t shard, froe_query **out, froe_diagnostic *diag);
/** Puts the name of a shard's file before a sentence about its content that does not name it. Returns the status. */
froe_status shards_name_file(const froe_shards *shards, uint32_t shard, froe_status status, froe_diagnostic *diag);
/** The box of an object of a scene, as shards_object_box() has it. */
void shards_scene_box(const froe_scene *scene, uint32_t object, double *lo, double *hi);
static inline const froe_shard_entry *shards_entry(const froe_shards *shards, uint32_t shard) {
    return &shards->manifest.entries.data[shard];
}
#endif
