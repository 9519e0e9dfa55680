/* folder.c: opening a folder, and its trees at first need. */
#include "folder.h"
#include "record.h"
#include "shard.h"
#include "shards/ask/share.h"
#include "support/fail.h"
#include "support/floats.h"
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

/* ----------------------------------------------------------------- manifest -- */

/* All of a file, which is not larger than a manifest can be. */
static froe_status read_text(const char *path, const froe_allocator *alloc, shards_text *text, froe_diagnostic *diag) {
    enum { MOST = 1 << 24 };
    struct stat info;
    const int file = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (file < 0) return support_fail_file(diag, "read", path, errno);
    froe_status status = FROE_OK;
    if (fstat(file, &info))
        status = support_fail_file(diag, "read", path, errno);
    else if (!S_ISREG(info.st_mode))
        status = support_fail_irregular(diag, path, info.st_mode);
    else if (info.st_size > MOST)
        status = support_fail(diag, FROE_E_FORMAT, "%s: It is too large for a manifest.", support_short(path));
    else if (!array_reserve(alloc, text, (size_t)info.st_size + 1))
        status = support_fail_memory(diag);
    while (!status) {
        const ssize_t got = read(file, text->data + text->count, text->capacity - text->count);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) status = support_fail_file(diag, "read", path, errno);
        if (got <= 0) break;
        text->count += (size_t)got;
        if (text->count == text->capacity) break; /* it grew meanwhile, and will not be what it was */
    }
    close(file);
    return status;
}

/* Is a file of this name in a folder, of which nothing but the names that are asked for needs to be known? */
static bool has_file(const char *folder, const char *name) {
    char path[PATH_MAX];
    struct stat info;
    if (strlen(folder) + 1 + strlen(name) >= sizeof path) return false;
    strcpy(stpcpy(stpcpy(path, folder), "/"), name); /* printf() would need froe's floating point */
    return !stat(path, &info);
}

bool froe_is_shards(const char *path) {
    return path && (has_file(path, SHARDS_MANIFEST) || has_file(path, "shard-0000.froe"));
}

froe_status froe_shards_open(const char *path, const froe_allocator *given, froe_shards **out, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (!path || !out) return support_fail_null(diag, __func__);
    const froe_allocator alloc = support_allocator(given);
    froe_shards *s = support_calloc(&alloc, 1, sizeof *s);
    if (!s) return support_fail_memory(diag);
    *s = (froe_shards){.alloc = alloc, .path_size = strlen(path) + sizeof "/" SHARDS_MANIFEST};
    shards_text text = {0};
    s->path = support_realloc(&alloc, NULL, 0, s->path_size);
    froe_status status = s->path ? FROE_OK : support_fail_memory(diag);
    if (!status) {
        snprintf(s->path, s->path_size, "%s/" SHARDS_MANIFEST, path);
        status = read_text(s->path, &alloc, &text, diag);
    }
    if (!status) status = shards_manifest_parse(text.data, text.count, s->path, &alloc, &s->manifest, diag);
    if (!status) {
        s->path[strlen(path)] = '\0';
        s->dim = s->manifest.plan->dim;
        s->slots = support_calloc(&alloc, s->manifest.plan->count, sizeof *s->slots);
        if (s->slots)
            s->count = s->manifest.plan->count;
        else
            status = support_fail_memory(diag);
        while (s->first + 1 < s->count && !shards_entry(s, s->first)->objects) s->first++;
    }
    array_free(&alloc, &text);
    if (status)
        froe_shards_close(s);
    else
        *out = s;
    return status;
}

void froe_shards_close(froe_shards *s) {
    if (!s) return;
    const froe_allocator alloc = s->alloc;
    shards_share_free(s);
    for (uint32_t i = 0; i < s->count; i++) {
        froe_query_free(s->slots[i].query);
        froe_tree_free(s->slots[i].tree);
    }
    if (s->slots) support_free(&alloc, s->slots, s->count * sizeof *s->slots);
    if (s->manifest.plan) shards_manifest_free(&s->manifest);
    if (s->path) support_free(&alloc, s->path, s->path_size);
    support_free(&alloc, s, sizeof *s);
}

froe_shards_info froe_shards_about(const froe_shards *s) {
    SUPPORT_FLOATS_OWN;
    froe_shards_info info = {0};
    if (!s) return info;
    const froe_shards_report all = froe_shard_report(s->manifest.plan, s->manifest.entries.data);
    info.dim = s->dim;
    info.shards = all.shards;
    info.objects = all.objects;
    info.copies = all.copies;
    info.bytes = all.bytes;
    info.check = s->manifest.sum;
    for (uint32_t i = s->first; i < s->count; i++) {
        const froe_shard_entry *e = shards_entry(s, i);
        for (int a = 0; a < s->dim && e->objects; a++) {
            info.lo[a] = i == s->first || e->lo[a] < info.lo[a] ? e->lo[a] : info.lo[a];
            info.hi[a] = i == s->first || e->hi[a] > info.hi[a] ? e->hi[a] : info.hi[a];
        }
    }
    return info;
}

/* -------------------------------------------------------------------- trees -- */

froe_status shards_name_file(const froe_shards *s, uint32_t shard, froe_status status, froe_diagnostic *diag) {
    if (diag && status == FROE_E_FORMAT && !strstr(diag->message, ".froe: ")) {
        const froe_diagnostic why = *diag;
        char path[64 + SHARDS_NAME];
        const size_t length = strlen(s->path);
        shards_file_name(path, sizeof path, length < 64 ? s->path : s->path + length - 63, shard);
        support_fail(diag, status, "%s: %s", path, why.message);
    }
    return status;
}

/* Opens the file of a shard, if it is the one that the manifest names. */
static froe_status open_shard(const froe_shards *s, uint32_t shard, const char *path, froe_tree **out,
                              froe_diagnostic *diag) {
    const froe_shard_entry *e = shards_entry(s, shard);
    uint64_t bytes, check;
    froe_status status = shards_file_check(path, &bytes, &check, diag);
    if (status) return status;
    const bool same = bytes == e->bytes && check == e->check;
    if (same) status = froe_tree_open(path, &s->alloc, out, diag);
    if (status) return status;
    if (same && froe_scene_dim(froe_tree_scene(*out)) == s->dim &&
        froe_scene_object_count(froe_tree_scene(*out)) == e->objects)
        return FROE_OK;
    if (same) froe_tree_free(*out);
    return support_fail(diag, FROE_E_FORMAT,
                        "%s: It is not the shard that the manifest names, but one of another folder or another time, "
                        "or damaged.",
                        support_short(path));
}

static froe_status open_slot(froe_shards *s, uint32_t shard, froe_diagnostic *diag) {
    const size_t size = strlen(s->path) + SHARDS_NAME;
    froe_tree *tree = NULL;
    if (s->slots[shard].tree) return FROE_OK;
    char *path = support_realloc(&s->alloc, NULL, 0, size);
    if (!path) return support_fail_memory(diag);
    shards_file_name(path, size, s->path, shard);
    froe_status status = open_shard(s, shard, path, &tree, diag);
    if (!status) s->slots[shard].tree = tree;
    support_free(&s->alloc, path, size);
    return status;
}

froe_status shards_query(froe_shards *s, uint32_t shard, froe_query **out, froe_diagnostic *diag) {
    shards_slot *slot = &s->slots[shard];
    froe_status status = open_slot(s, shard, diag);
    if (!status && !slot->query) status = froe_query_new(slot->tree, &slot->query, diag);
    if (!status) *out = slot->query;
    return status;
}

froe_status froe_shards_query(froe_shards *s, uint32_t shard, froe_query **out, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (!s || !out) return support_fail_null(diag, __func__);
    if (shard >= s->count || !shards_entry(s, shard)->objects)
        return support_fail(diag, FROE_E_ARG, "There is no shard %u with objects.", shard);
    return shards_query(s, shard, out, diag);
}

froe_status froe_shards_tree(froe_shards *s, uint32_t shard, const froe_tree **out, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (!s || !out) return support_fail_null(diag, __func__);
    if (shard >= s->count) return support_fail(diag, FROE_E_ARG, "There is no shard %u.", shard);
    const froe_status status = shards_entry(s, shard)->objects ? open_slot(s, shard, diag) : FROE_OK;
    if (!status) *out = s->slots[shard].tree;
    return status;
}

void shards_scene_box(const froe_scene *scene, uint32_t object, double *lo, double *hi) {
    const int dim = froe_scene_dim(scene);
    const froe_object o = froe_scene_object(scene, object);
    for (uint32_t i = 0; i < o.corners; i++) {
        const double *x = froe_scene_vertex(scene, froe_scene_corner(scene, object, i));
        for (int a = 0; a < dim; a++) {
            lo[a] = !i || x[a] < lo[a] ? x[a] : lo[a];
            hi[a] = !i || x[a] > hi[a] ? x[a] : hi[a];
        }
    }
    if (o.kind == FROE_BALL) shards_widen_box(dim, o.radius, lo, hi);
}
