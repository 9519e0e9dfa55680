/* folders.h: objects of every kind for folders of shards, and folders that are compared byte for byte. */
#ifndef FROE_TESTS_SHARDS_FOLDERS_H
#define FROE_TESTS_SHARDS_FOLDERS_H
#include "shards/record.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/** Numbers of a test: a linear congruence (Knuth's MMIX). */
static inline uint64_t next_random(uint64_t *state) {
    *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return *state >> 33;
}

/** An object with corners of its own. */
typedef struct one_object {
    froe_kind kind;
    size_t corners;
    double at[5 * FROE_MAX_DIM], radius;
    uint64_t tag;
} one_object;

/** Whole numbers from 0 to `most`: ties, touches and equal objects are everywhere. */
static inline double on_lattice(uint64_t *state, int most) {
    return (double)(next_random(state) % (uint64_t)(most + 1));
}

/** Objects of a kind on a lattice; FROE_KIND_COUNT: of all kinds that there are in the dimension. Tags are unique, and
 * in no order. */
static inline one_object *lattice_objects(int dim, froe_kind kind, size_t count, int most, uint64_t seed) {
    one_object *list = calloc(count, sizeof *list);
    assert_non_null(list);
    uint64_t state = seed;
    for (size_t i = 0; i < count; i++) {
        one_object *o = list + i;
        o->tag = i * 7919 % count * 3 + 5;
        do o->kind = kind == FROE_KIND_COUNT ? (froe_kind)(next_random(&state) % FROE_KIND_COUNT) : kind;
        while (o->kind == FROE_POLYGON && dim != 3);
        const size_t some[] = {1, 2, 3 + next_random(&state) % 2, 2, 1, 1 + next_random(&state) % 5};
        o->corners = some[o->kind];
        for (int a = 0; a < dim; a++) o->at[a] = on_lattice(&state, most);
        for (size_t c = 1; c < o->corners; c++)
            for (int a = 0; a < dim; a++)
                o->at[c * (size_t)dim + (size_t)a] =
                    o->at[a] + on_lattice(&state, o->kind == FROE_BOX ? 3 : 6) - (o->kind == FROE_BOX ? 0 : 3);
        for (int a = 0; a < 3 && o->kind == FROE_POLYGON && o->corners == 4; a++) /* a parallelogram */
            o->at[9 + a] = o->at[a] + o->at[6 + a] - o->at[3 + a];
        if (o->kind == FROE_BALL) o->radius = on_lattice(&state, 3);
    }
    return list;
}

/** One of them as a batch. */
static inline froe_objects batch_of(const one_object *o, size_t starts[2]) {
    froe_objects batch = froe_objects_defaults();
    starts[0] = 0, starts[1] = o->corners;
    batch.kind = o->kind;
    batch.count = 1;
    batch.coords = o->at;
    batch.starts = o->kind == FROE_POLYGON || o->kind == FROE_HULL ? starts : NULL;
    batch.radii = o->kind == FROE_BALL ? &o->radius : NULL;
    batch.tags = &o->tag;
    return batch;
}

static inline int by_tag_of_object(const void *a, const void *b) {
    const one_object *x = a, *y = b;
    return (x->tag > y->tag) - (x->tag < y->tag);
}

/** The bytes of a file, or NULL. */
static inline char *read_whole(const char *path, size_t *count) {
    FILE *file = fopen(path, "rb");
    if (!file) return NULL;
    fseek(file, 0, SEEK_END);
    *count = (size_t)ftell(file);
    rewind(file);
    char *bytes = calloc(*count + 1, 1);
    assert_non_null(bytes);
    assert_int_equal(fread(bytes, 1, *count, file), *count);
    fclose(file);
    return bytes;
}

static inline bool equal_files(const char *a, const char *b) {
    size_t n = 0, m = 0;
    char *x = read_whole(a, &n), *y = read_whole(b, &m);
    const bool equal = x && y && n == m && !memcmp(x, y, n);
    const bool neither = !x && !y;
    free(x), free(y);
    return equal || neither;
}

/** Do two folders of at most so many shards have the same files? */
static inline void assert_equal_folders(const char *a, const char *b, unsigned shards) {
    char x[256], y[256];
    snprintf(x, sizeof x, "%s/froe.shards", a);
    snprintf(y, sizeof y, "%s/froe.shards", b);
    assert_true(equal_files(x, y));
    for (unsigned i = 0; i <= shards; i++) {
        snprintf(x, sizeof x, "%s/shard-%04u.froe", a, i);
        snprintf(y, sizeof y, "%s/shard-%04u.froe", b, i);
        assert_true(equal_files(x, y));
    }
}

/** Builds the folder of some objects, one after the other. */
static inline froe_status build_folder(const char *path, int dim, const one_object *list, size_t count,
                                       const froe_shards_options *o, froe_shards_report *report,
                                       froe_diagnostic *diag) {
    froe_shards_builder *builder;
    froe_status status = froe_shards_begin(path, dim, o, &builder, diag);
    if (status) return status;
    for (size_t i = 0; i < count && !status; i++) {
        size_t starts[2];
        const froe_objects batch = batch_of(list + i, starts);
        status = froe_shards_add(builder, &batch, diag);
    }
    if (!status) return froe_shards_finish(builder, report, diag);
    froe_shards_abandon(builder);
    return status;
}
#endif
