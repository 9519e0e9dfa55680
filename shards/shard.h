/* shard.h: the tree of one cell, from its records to its file. */
#ifndef FROE_SHARDS_SHARD_H
#define FROE_SHARDS_SHARD_H
#include "plan.h"
#include "record.h"
#include <sys/types.h>

enum { SHARDS_NAME = 24 };
/** The path of a shard's file; `size` is that of `out`: SHARDS_NAME more than the length of `folder` suffice. */
void shards_file_name(char *out, size_t size, const char *folder, uint32_t shard);
/** Reads from a place of a file until so many bytes are there, or the file ends; how many, -1 with errno on failure. */
ssize_t shards_read_at(int file, void *to, size_t count, off_t place);
/** Reads the checksum of the header of a tree file, and the size of the file. FROE_E_IO; FROE_E_FORMAT: it is too short
 * to have a header. */
froe_status shards_file_check(const char *path, uint64_t *bytes, uint64_t *check, froe_diagnostic *diag);
/** Is the struct from froe_shards_defaults()? */
froe_status shards_check_options(const froe_shards_options *options, froe_diagnostic *diag);
/** Lets the bounds of an entry hold what a box, which meets the cell, has in common with it. first: they hold nothing
 * yet. */
void shards_entry_bound(froe_shard_entry *entry, const froe_shard_plan *plan, uint32_t cell, const double *lo,
                        const double *hi, bool first);
#endif
