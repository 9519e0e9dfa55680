/* Packed trees of many blocks in scenes of every scale: each set of kernels that the machine has gives the answers of
 * brute force, to batches as to single questions. (test_extremes.c asks trees of few objects, by the best kernels.) */
#include "build/options.h"
#include "query/answers.h"
#include "query/packed/packed.h"
#include "query/packed/space.h"
#include "support/large.h"
#include "tree/packed/wide.h"

enum { BATCH = 40 };

/* What has been asked, so that no part of it goes missing unnoticed. */
static struct { uint64_t blocks, wide, asked; } sum;

typedef struct scene_case {
    froe_scene *scene;
    char name[80];
    uint64_t seed;
} scene_case;

static scene_case case_of(int dim, uint64_t seed) {
    static const unsigned plane[] = {1 << FROE_SEGMENT, 1 << FROE_SEGMENT | 1 << FROE_POINT};
    static const unsigned space[] = {1 << FROE_POLYGON, 63};
    const int style = (int)(seed % EXTREME_STYLES);
    extreme_scene s = extreme_begin(dim, style, seed);
    scene_case c = {.scene = s.scene, .seed = seed};
    extreme_grow(&s, (dim == 2 ? plane : space)[seed % 2], dim == 2 ? 90 : 60);
    snprintf(c.name, sizeof c.name, "R^%d, style %d, FROE_SEED=%llu", dim, style, (unsigned long long)seed);
    return c;
}

static froe_tree *tree_of(const scene_case *c) {
    froe_build_options o = froe_build_defaults();
    froe_tree *tree;
    froe_diagnostic why;
    o.method = "index", o.leaf = 2;
    if (froe_scene_dim(c->scene) == 2 && c->seed / 2 % 2) o.settings = "grid=4 load=2";
    if (build_tuned(c->scene, &o, &tree, &why)) fail_msg("%s: %s", c->name, why.message);
    if (froe_tree_audit(tree, NULL, &why)) fail_msg("%s: %s", c->name, why.message);
    sum.blocks += tree->packed.block_count;
    if (tree->packed.wide) sum.wide += tree->packed.wide->count;
    return tree;
}

/* The set of kernels of this number, or NULL. */
static const char *use_kernels(froe_query *q, size_t kernel) {
    if (!packed_kernels_at(kernel)) return NULL;
    if (q->packed) q->packed->kernels = packed_kernels_at(kernel);
    if (q->space) q->space->kernels = space_kernels_at(kernel);
    return packed_kernels_at(kernel)->name;
}

/* ----------------------------------------------------------------- batches -- */

typedef struct batch {
    double x[BATCH * 3], d[BATCH * 3];
    froe_batch_options options;
} batch;

static batch batch_of(const world *w, uint64_t seed) {
    batch b = {.options = froe_batch_defaults()};
    world_dice d = {seed, 0};
    b.options.threads = 1;
    for (size_t i = 0; i < BATCH; i++) {
        world_point(w, &d, b.x + i * (size_t)w->dim);
        make_vector(w, &d, b.d + i * (size_t)w->dim);
    }
    return b;
}

static void check_vertical_batch(froe_query *q, const batch *b, const char *name) {
    uint32_t all[BATCH], one;
    for (int direction = -1; direction <= 1; direction += 2) {
        assert_int_equal(froe_batch_vertical(q, b->x, BATCH, direction, &b->options, all, NULL), FROE_OK);
        for (size_t i = 0; i < BATCH; i++) {
            assert_int_equal(froe_query_vertical(q, b->x + 2 * i, direction, &one, NULL), FROE_OK);
            if (all[i] != one) fail_msg("%s, vertical %zu: %u in a batch, %u alone", name, i, all[i], one);
        }
    }
}

static void check_ray_batch(froe_query *q, int dim, const batch *b, const char *name) {
    froe_hit all[BATCH], one;
    assert_int_equal(froe_batch_ray(q, b->x, b->d, BATCH, INFINITY, &b->options, all, NULL), FROE_OK);
    for (size_t i = 0; i < BATCH; i++) {
        const size_t at = i * (size_t)dim;
        assert_int_equal(froe_query_ray(q, b->x + at, b->d + at, INFINITY, &one, NULL), FROE_OK);
        if (all[i].object != one.object || (one.object != FROE_NONE && all[i].t != one.t))
            fail_msg("%s, ray %zu: %u in a batch, %u alone", name, i, all[i].object, one.object);
    }
}

static void check_locate_batch(froe_query *q, int dim, const batch *b, const char *name) {
    froe_answers all;
    froe_list one;
    assert_int_equal(froe_batch_locate(q, b->x, BATCH, &b->options, &all, NULL), FROE_OK);
    for (size_t i = 0; i < BATCH; i++) {
        assert_int_equal(froe_query_locate(q, b->x + i * (size_t)dim, &one, NULL), FROE_OK);
        if (all.starts[i + 1] - all.starts[i] != one.count ||
            (one.count && memcmp(all.ids + all.starts[i], one.ids, one.count * sizeof *one.ids)))
            fail_msg("%s, point %zu: a batch finds others", name, i);
    }
    froe_answers_free(&all);
}

/* ------------------------------------------------------------------- pairs -- */

enum { PAIRS = 1 << 15 };
typedef struct pairs {
    froe_pair at[PAIRS];
    size_t count;
} pairs;

static bool note_pair(void *user, const froe_pair *pair) {
    pairs *p = user;
    assert_true(p->count < PAIRS);
    p->at[p->count++] = *pair;
    return true;
}

/* Those of a tree that is not packed: test_pairs.c holds such trees against brute force. */
static void reference_pairs(froe_scene *scene, pairs *out) {
    froe_tree *tree = trees_build(scene, "density", scene->object_count); /* one leaf */
    froe_query *q;
    out->count = 0;
    assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
    assert_int_equal(froe_query_pairs(q, true, note_pair, out, NULL), FROE_OK);
    froe_query_free(q);
    froe_tree_free(tree);
}

static void check_pairs(froe_query *q, const pairs *expected, const char *name) {
    static pairs found;
    found.count = 0;
    assert_int_equal(froe_query_pairs(q, true, note_pair, &found, NULL), FROE_OK);
    for (size_t i = 0; i < found.count && i < expected->count; i++) {
        const froe_pair *p = found.at + i, *e = expected->at + i;
        if (p->a != e->a || p->b != e->b || p->kind != e->kind)
            fail_msg("%s: pair %u %u for %u %u", name, p->a, p->b, e->a, e->b);
    }
    if (found.count != expected->count) fail_msg("%s: %zu pairs for %zu", name, found.count, expected->count);
}

/* ------------------------------------------------------------------ asking -- */

static void check_kernels(froe_query *q, const world *w, const scene_case *c, int rounds) {
    static pairs expected;
    const char *kernels;
    const batch b = batch_of(w, c->seed);
    reference_pairs(c->scene, &expected);
    for (size_t k = 0; (kernels = use_kernels(q, k)); k++) {
        char why[200], name[120];
        snprintf(name, sizeof name, "%s, %s", c->name, kernels);
        if (!answers_right_at_every_scale(q, 8 * c->seed + k, rounds, why, sizeof why)) fail_msg("%s: %s", name, why);
        if (w->dim == 2) check_vertical_batch(q, &b, name);
        large_ask(q, c->seed % 2);
        check_ray_batch(q, w->dim, &b, name);
        check_locate_batch(q, w->dim, &b, name);
        check_pairs(q, &expected, name);
        sum.asked += w->count * (size_t)rounds;
    }
}

static void check_scenes(int dim, uint64_t scenes, int rounds) {
    const uint64_t first = extreme_seed(), last = first + scenes * extreme_rounds() / EXACT_SHARE;
    sum.blocks = sum.wide = sum.asked = 0;
    for (uint64_t seed = first; seed < last; seed++) {
        const scene_case c = case_of(dim, seed);
        froe_tree *tree = tree_of(&c);
        froe_query *q;
        const world w = {.name = c.name,
                         .dim = dim,
                         .count = froe_scene_object_count(c.scene),
                         .scene = c.scene,
                         .trees = &tree,
                         .tree_count = 1,
                         .extreme = true};
        assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
        check_kernels(q, &w, &c, rounds);
        froe_query_free(q);
        froe_tree_free(tree);
        froe_scene_free(c.scene);
    }
    print_message("  R^%d: %d blocks, %d wide nodes, %d objects asked of\n", dim, (int)sum.blocks, (int)sum.wide,
                  (int)sum.asked);
}

static void packed_trees_of_the_plane_at_every_scale(void **state) {
    (void)state;
    check_scenes(2, 10, 3);
    assert_true(EXACT_SHARE > 1 || sum.blocks > 1500);
}

static void packed_trees_of_space_at_every_scale(void **state) {
    (void)state;
    check_scenes(3, 7, 1);
    assert_true(EXACT_SHARE > 1 || (sum.blocks > 400 && sum.wide > 4));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(packed_trees_of_the_plane_at_every_scale),
        cmocka_unit_test(packed_trees_of_space_at_every_scale),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
