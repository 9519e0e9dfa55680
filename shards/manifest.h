/* manifest.h: the text froe.shards of a folder, which names its shards. docs/format.md specifies it. */
#ifndef FROE_SHARDS_MANIFEST_H
#define FROE_SHARDS_MANIFEST_H
#include "plan.h"

#define SHARDS_MANIFEST "froe.shards"

typedef struct shards_manifest {
    froe_shard_plan *plan;
    ARRAY(froe_shard_entry) entries; /**< of each shard of the plan */
    uint64_t sum;                    /**< shards_manifest_sum() of the whole text */
    froe_allocator alloc;
} shards_manifest;

/** The text of a manifest, behind what `text` holds. False: no memory. */
typedef ARRAY(char) shards_text;
bool shards_manifest_print(const froe_shard_plan *plan, const froe_shard_entry *entries, const froe_allocator *alloc,
                           shards_text *text);
/** The checksum of the lines before the last one. */
uint64_t shards_manifest_sum(const char *text, size_t count);
/** Reads a text. Each manifest has one text, so one that differs by a byte is refused. FROE_E_FORMAT: it is none, of
 * another version, cut off or damaged; FROE_E_MEMORY. `path` is for messages. */
froe_status shards_manifest_parse(const char *text, size_t count, const char *path, const froe_allocator *alloc,
                                  shards_manifest *out, froe_diagnostic *diag);
void shards_manifest_free(shards_manifest *manifest);
#endif
