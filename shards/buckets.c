/* buckets.c: bytes of several buckets in one file without name.
 *
 *     file      | 2 | 0 | 0 | 1 | 0 | ...      blocks of one size, each of one bucket, in the order they became full
 *     bucket 0        o---o-------o            the places of its blocks, and what does not fill a block yet, in memory
 *
 * A file that has been unlinked goes away with the last program that holds it, so that no failure leaves it behind. */
#define _GNU_SOURCE 1 /* fallocate, mkstemp */
#include "record.h"
#include "shard.h"
#include "support/fail.h"
#include "support/floats.h"
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

enum { LARGEST_BLOCK = 1 << 18, SMALLEST_BLOCK = 1 << 12, MEMORY_OF_BLOCKS = 1 << 26 };

typedef struct shard_bucket {
    ARRAY(uint32_t) blocks; /* their numbers in the file */
    unsigned char *open;    /* the last block, which is not full; NULL: empty */
    size_t filled;
} shard_bucket;

struct froe_shard_buckets {
    shard_bucket *buckets;
    uint32_t count, blocks; /* buckets; blocks in the file */
    size_t block;           /* bytes of one */
    int file;
    char *folder; /* for messages */
    size_t folder_size;
    froe_allocator alloc;
};

/* ------------------------------------------------------------------- making -- */

/* A file that has no name any more. Returns its descriptor, or -1 and errno. */
static int open_nameless(const char *folder, const froe_allocator *alloc) {
    static const char name[] = "/.froe-XXXXXX";
    const size_t size = strlen(folder) + sizeof name;
    char *path = support_realloc(alloc, NULL, 0, size);
    if (!path) {
        errno = ENOMEM;
        return -1;
    }
    snprintf(path, size, "%s%s", folder, name);
    const int file = mkstemp(path);
    const int error = errno;
    if (file >= 0) {
        unlink(path);
        fcntl(file, F_SETFD, FD_CLOEXEC);
    }
    support_free(alloc, path, size);
    errno = error;
    return file;
}

froe_status froe_shard_buckets_new(const char *folder, uint32_t count, const froe_allocator *alloc,
                                   froe_shard_buckets **out, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (!folder || !out) return support_fail_null(diag, __func__);
    if (!count || count > FROE_SHARDS_MOST)
        return support_fail(diag, FROE_E_ARG, "Buckets are 1 to %d.", FROE_SHARDS_MOST);
    const froe_allocator own = support_allocator(alloc);
    froe_shard_buckets *b = support_calloc(&own, 1, sizeof *b);
    if (!b) return support_fail_memory(diag);
    *b = (froe_shard_buckets){.file = -1, .alloc = own, .folder_size = strlen(folder) + 1};
    b->folder = support_realloc(&own, NULL, 0, b->folder_size);
    b->buckets = support_calloc(&own, count, sizeof *b->buckets);
    froe_status status = FROE_OK;
    if (b->buckets) b->count = count;
    if (!b->folder || !b->buckets) {
        status = support_fail_memory(diag);
    } else {
        memcpy(b->folder, folder, b->folder_size);
        b->block = LARGEST_BLOCK;
        while (b->block > SMALLEST_BLOCK && b->block > (size_t)MEMORY_OF_BLOCKS / count) b->block /= 2;
        b->file = open_nameless(folder, &own);
        if (b->file < 0) status = support_fail_file(diag, "written", folder, errno);
    }
    if (status)
        froe_shard_buckets_free(b);
    else
        *out = b;
    return status;
}

void froe_shard_buckets_free(froe_shard_buckets *b) {
    if (!b) return;
    const froe_allocator alloc = b->alloc;
    for (uint32_t i = 0; i < b->count; i++) {
        array_free(&alloc, &b->buckets[i].blocks);
        if (b->buckets[i].open) support_free(&alloc, b->buckets[i].open, b->block);
    }
    if (b->file >= 0) close(b->file);
    if (b->buckets) support_free(&alloc, b->buckets, b->count * sizeof *b->buckets);
    if (b->folder) support_free(&alloc, b->folder, b->folder_size);
    support_free(&alloc, b, sizeof *b);
}

/* ------------------------------------------------------------------ writing -- */

static froe_status write_block(froe_shard_buckets *b, shard_bucket *to, froe_diagnostic *diag) {
    if (b->blocks == UINT32_MAX || !array_push(&b->alloc, &to->blocks, b->blocks)) return support_fail_memory(diag);
    const off_t place = (off_t)b->blocks * (off_t)b->block;
    for (size_t done = 0; done < b->block;) {
        const ssize_t wrote = pwrite(b->file, to->open + done, b->block - done, place + (off_t)done);
        if (wrote < 0 && errno == EINTR) continue;
        if (wrote <= 0) return support_fail_file(diag, "written", b->folder, wrote ? errno : ENOSPC);
        done += (size_t)wrote;
    }
    b->blocks++;
    to->filled = 0;
    return FROE_OK;
}

froe_status froe_shard_buckets_add(froe_shard_buckets *b, uint32_t number, const void *records, size_t count,
                                   froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (!b || (!records && count)) return support_fail_null(diag, __func__);
    if (number >= b->count) return support_fail(diag, FROE_E_ARG, "There is no bucket %u.", number);
    shard_bucket *to = &b->buckets[number];
    const unsigned char *at = records;
    if (count && !to->open && !(to->open = support_realloc(&b->alloc, NULL, 0, b->block)))
        return support_fail_memory(diag);
    while (count) {
        const size_t room = b->block - to->filled, some = count < room ? count : room;
        memcpy(to->open + to->filled, at, some);
        to->filled += some;
        at += some;
        count -= some;
        const froe_status status = to->filled == b->block ? write_block(b, to, diag) : FROE_OK;
        if (status) return status;
    }
    return FROE_OK;
}

/* ------------------------------------------------------------------- taking -- */

/* Reads a block to its place, and gives back its place on the disk. */
static froe_status read_block(const froe_shard_buckets *b, uint32_t number, unsigned char *to, froe_diagnostic *diag) {
    const off_t place = (off_t)number * (off_t)b->block;
    const ssize_t got = shards_read_at(b->file, to, b->block, place);
    if (got < (ssize_t)b->block) return support_fail_file(diag, "read", b->folder, got < 0 ? errno : EIO);
#ifdef FALLOC_FL_PUNCH_HOLE
    (void)fallocate(b->file, FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE, place, (off_t)b->block);
#endif
    return FROE_OK;
}

/* Hands over the whole records that `held` begins with, and moves what is left to the front. *none: that begins no
 * record. */
static froe_status hand_over(froe_shard_records *held, froe_shard_records_fn *fn, void *user, bool *none) {
    size_t whole = 0;
    for (size_t size; (size = froe_shard_record_size(held->bytes + whole, held->count - whole)) != 0;) whole += size;
    const froe_status status = whole ? support_callback(fn(user, held->bytes, whole)) : FROE_OK;
    held->count -= whole;
    memmove(held->bytes, held->bytes + whole, held->count);
    *none = shards_record_is_none(held->bytes, held->count);
    return status;
}

froe_status froe_shard_buckets_take(froe_shard_buckets *b, uint32_t number, froe_shard_records_fn *fn, void *user,
                                    froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (!b || !fn) return support_fail_null(diag, __func__);
    if (number >= b->count) return support_fail(diag, FROE_E_ARG, "There is no bucket %u.", number);
    shard_bucket *from = &b->buckets[number];
    froe_shard_records held = {.alloc = b->alloc};
    froe_status status = FROE_OK;
    bool none = false; /* what comes next is no record */
    for (size_t i = 0; i < from->blocks.count && !status && !none; i++) {
        status = shards_records_reserve(&held, b->block)
                     ? read_block(b, from->blocks.data[i], held.bytes + held.count, diag)
                     : support_fail_memory(diag);
        if (status) break;
        held.count += b->block;
        status = hand_over(&held, fn, user, &none);
    }
    if (!status && !none && from->filled) {
        status = froe_shard_records_append(&held, from->open, from->filled, diag);
        if (!status) status = hand_over(&held, fn, user, &none);
    }
    if (!status && held.count)
        status = support_fail(diag, FROE_E_FORMAT, "%s: Bucket %u holds bytes that are no records.",
                              support_short(b->folder), number);
    froe_shard_records_free(&held);
    array_free(&b->alloc, &from->blocks);
    if (from->open) support_free(&b->alloc, from->open, b->block);
    from->open = NULL;
    from->filled = 0;
    return status;
}
