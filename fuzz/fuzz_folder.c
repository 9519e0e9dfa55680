/* fuzz_folder.c: bytes as a scene, which becomes a folder of shards and one tree: both answer alike. Then a byte of the
 * folder is changed: what still opens must be safe to ask. */
#include "support.h"
#include <froe/shards.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { POINTS = 4, MOST_SHARDS = 5, NEIGHBOURS = 3 };

typedef struct folder {
    char path[256];
    int dim;
    double x[POINTS * 3], way[POINTS * 3], boxes[POINTS * 6];
} folder;

static void expect(bool holds, const char *what) {
    const froe_diagnostic why = {.message = "the folder and the tree do not agree"};
    if (!holds) fuzz_complain(what, &why);
}

static void remove_folder(const folder *f) {
    char name[300];
    for (int i = 0; i <= MOST_SHARDS; i++) {
        snprintf(name, sizeof name, "%s/shard-%04d.froe", f->path, i);
        remove(name);
    }
    snprintf(name, sizeof name, "%s/froe.shards", f->path);
    remove(name);
    rmdir(f->path);
}

static void draw_places(folder *f, fuzz_bytes *bytes) {
    for (int i = 0; i < POINTS * f->dim; i++) f->x[i] = fuzz_double(bytes), f->way[i] = fuzz_double(bytes);
    for (int i = 0; i < POINTS; i++)
        for (int k = 0; k < f->dim; k++) {
            const double a = f->x[i * f->dim + k], b = fuzz_double(bytes);
            f->boxes[2 * i * f->dim + k] = a < b ? a : b;
            f->boxes[(2 * i + 1) * f->dim + k] = a < b ? b : a;
        }
}

/* --------------------------------------------------------------- answers -- */

static int by_tag(const void *a, const void *b) {
    const uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

/* The tags of what a tree has found are those of the folder, which tells them in order. */
static void compare_lists(const froe_scene *scene, const froe_answers *alone, const froe_finds *found) {
    for (size_t i = 0; i < POINTS; i++) {
        const size_t first = alone->starts[i], count = alone->starts[i + 1] - first;
        expect(found->starts[i + 1] - found->starts[i] == count, "how many");
        uint64_t *tags = calloc(count + 1, sizeof *tags);
        if (!tags) abort();
        for (size_t j = 0; j < count; j++) tags[j] = froe_scene_object(scene, alone->ids[first + j]).tag;
        qsort(tags, count, sizeof *tags, by_tag);
        for (size_t j = 0; j < count; j++) expect(found->items[found->starts[i] + j].tag == tags[j], "which");
        free(tags);
    }
}

static void compare_values(const froe_answers *alone, const froe_finds *found) {
    for (size_t i = 0; i < POINTS; i++) {
        const size_t first = alone->starts[i], count = alone->starts[i + 1] - first;
        expect(found->starts[i + 1] - found->starts[i] == count, "how many values");
        for (size_t j = 0; j < count; j++)
            expect(found->items[found->starts[i] + j].value == alone->values[first + j], "values");
    }
}

/* Both were asked the same; what one refuses the other refuses. */
#define BOTH(single, folder_call, judge)                                                                               \
    do {                                                                                                               \
        froe_answers alone;                                                                                            \
        froe_finds found;                                                                                              \
        const froe_status a = (single), b = (folder_call);                                                             \
        expect(a == b, #single);                                                                                       \
        if (!a && !b) judge;                                                                                           \
        if (!a) froe_answers_free(&alone);                                                                             \
        if (!b) froe_finds_free(&found);                                                                               \
    } while (0)

static void ask_both(const folder *f, froe_shards *shards, froe_query *q, const froe_scene *scene) {
    froe_batch_options o = froe_batch_defaults();
    o.threads = 1;
    BOTH(froe_batch_boxes(q, f->boxes, POINTS, &o, &alone, NULL),
         froe_shards_boxes(shards, f->boxes, POINTS, &o, &found, NULL), compare_lists(scene, &alone, &found));
    BOTH(froe_batch_locate(q, f->x, POINTS, &o, &alone, NULL),
         froe_shards_locate(shards, f->x, POINTS, &o, &found, NULL), compare_lists(scene, &alone, &found));
    BOTH(froe_batch_ray_all(q, f->x, f->way, POINTS, INFINITY, &o, &alone, NULL),
         froe_shards_ray_all(shards, f->x, f->way, POINTS, INFINITY, &o, &found, NULL), compare_values(&alone, &found));
    BOTH(froe_batch_near(q, f->x, POINTS, NEIGHBOURS, INFINITY, &o, &alone, NULL),
         froe_shards_near(shards, f->x, POINTS, NEIGHBOURS, INFINITY, &o, &found, NULL),
         compare_values(&alone, &found));
}

/* Frees the lists. */
static void compare_counts(froe_status listed, froe_finds *found, froe_status counted, const uint64_t *counts) {
    if (listed != counted) abort();
    for (size_t i = 0; i < POINTS && !listed; i++)
        if (counts[i] != found->starts[i + 1] - found->starts[i]) abort();
    if (!listed) froe_finds_free(found);
}

static void count_all(const folder *f, froe_shards *s) {
    froe_finds found;
    froe_find above[POINTS];
    uint64_t counts[POINTS];
    froe_status listed = froe_shards_locate(s, f->x, POINTS, NULL, &found, NULL);
    compare_counts(listed, &found, froe_shards_locate_count(s, f->x, POINTS, NULL, counts, NULL), counts);
    listed = froe_shards_near(s, f->x, POINTS, NEIGHBOURS, 1, NULL, &found, NULL);
    compare_counts(listed, &found, froe_shards_near_count(s, f->x, POINTS, NEIGHBOURS, 1, NULL, counts, NULL), counts);
    listed = froe_shards_ray_all(s, f->x, f->way, POINTS, INFINITY, NULL, &found, NULL);
    compare_counts(listed, &found, froe_shards_ray_count(s, f->x, f->way, POINTS, INFINITY, NULL, counts, NULL),
                   counts);
    listed = froe_shards_vertical(s, f->x, POINTS, 1, NULL, above, NULL);
    if (listed != froe_shards_vertical_count(s, f->x, POINTS, 1, NULL, counts, NULL)) abort();
    for (size_t i = 0; i < POINTS && !listed; i++)
        if (counts[i] != (above[i].object != FROE_NONE)) abort();
}

static void ask_again(const folder *f, froe_shards *shards) {
    froe_find finds[POINTS];
    froe_finds found;
    if (!froe_shards_boxes(shards, f->boxes, POINTS, NULL, &found, NULL)) froe_finds_free(&found);
    if (!froe_shards_locate(shards, f->x, POINTS, NULL, &found, NULL)) froe_finds_free(&found);
    if (!froe_shards_near(shards, f->x, POINTS, NEIGHBOURS, INFINITY, NULL, &found, NULL)) froe_finds_free(&found);
    (void)froe_shards_ray(shards, f->x, f->way, POINTS, INFINITY, NULL, finds, NULL);
    (void)froe_shards_check(shards, NULL, NULL);
}

/* ---------------------------------------------------------------- folders -- */

static bool build(folder *f, const froe_scene *scene, uint8_t shards) {
    froe_shards_options o = froe_shards_defaults();
    froe_shards_builder *builder;
    froe_diagnostic why;
    o.shards = 1 + shards % MOST_SHARDS;
    o.threads = 1;
    if (froe_shards_begin(f->path, f->dim, &o, &builder, &why)) fuzz_complain("a folder cannot be begun", &why);
    if (froe_shards_add_scene(builder, scene, &why) == FROE_OK) return !froe_shards_finish(builder, NULL, &why);
    froe_shards_abandon(builder);
    return false;
}

static void compare(const folder *f, froe_scene *scene) {
    froe_build_options o = froe_build_defaults();
    froe_diagnostic why;
    froe_shards *shards;
    froe_tree *tree;
    froe_query *q;
    o.purpose = "query", o.threads = 1;
    if (froe_shards_open(f->path, NULL, &shards, &why)) fuzz_complain("a new folder does not open", &why);
    if (froe_shards_check(shards, NULL, &why)) fuzz_complain("a new folder is wrong", &why);
    if (froe_build(scene, &o, &tree, &why) == FROE_OK) {
        if (froe_query_new(tree, &q, NULL)) abort();
        ask_both(f, shards, q, scene);
        count_all(f, shards);
        froe_query_free(q);
        froe_tree_free(tree);
    }
    froe_shards_close(shards);
}

static void damage(const folder *f, fuzz_bytes *bytes) {
    char name[300];
    froe_shards *shards;
    snprintf(name, sizeof name, "%s/shard-%04d.froe", f->path, fuzz_byte(bytes) % MOST_SHARDS);
    FILE *file = fopen(name, "r+b");
    if (!file) return;
    fseek(file, 0, SEEK_END);
    const long size = ftell(file), at = (fuzz_byte(bytes) << 16 | fuzz_byte(bytes) << 8 | fuzz_byte(bytes)) % size;
    fseek(file, at, SEEK_SET);
    fputc(fuzz_byte(bytes), file);
    fclose(file);
    if (froe_shards_open(f->path, NULL, &shards, NULL) == FROE_OK) {
        ask_again(f, shards);
        froe_shards_close(shards);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_bytes bytes = {data, size};
    folder f = {.dim = 2 + fuzz_byte(&bytes) % 2};
    const uint8_t shards = fuzz_byte(&bytes);
    froe_scene *scene;
    fuzz_file("", ".froes", NULL, 0, f.path, sizeof f.path);
    remove(f.path);
    if (froe_scene_new(f.dim, NULL, &scene)) return 0;
    for (int batches = 1 + fuzz_byte(&bytes) % 3; batches; batches--) fuzz_add_batch(scene, &bytes);
    draw_places(&f, &bytes);
    if (build(&f, scene, shards)) {
        compare(&f, scene);
        damage(&f, &bytes);
    }
    remove_folder(&f);
    froe_scene_free(scene);
    return 0;
}
