/* Queries on packed trees: the same answers as brute force in rationals, in the same order on all kernels that the
 * machine has. */
#include "oracle/segment.h"
#include "query/packed/packed.h"
#include "tree/packed/table.h"
#include "tree/trees.h"
#include <float.h>
#include <stdlib.h>

/* ------------------------------------------------------------------- scenes -- */

typedef struct kind_of_scene {
    const char *name;
    uint32_t count, grid, leaf;
    double size, scale, shift;
} kind_of_scene;

static const kind_of_scene kinds[] = {
    {"random", 600, 0, 24, 0.1, 1, 0},
    {"long", 150, 0, 24, 1.5, 1, 0},
    {"small leaves", 300, 0, 2, 0.3, 1, 0},
    {"lattice", 400, 10, 8, 0.4, 1, 0},
    {"coarse lattice, all kinds of coincidence", 150, 4, 5, 1, 1, 0},
    {"lattice, huge", 200, 8, 6, 0.6, 0x1p990, 0},
    {"random, huge", 200, 0, 6, 0.6, 1.7e308, 0},
    {"lattice, denormal", 200, 8, 6, 0.6, 0x1p-1074, 0},
    {"random, far away", 400, 0, 8, 0.2, 1, 0x1p40},
    {"random, so far away that cells are a few units in the last place", 400, 0, 8, 0.2, 0x1p-8, 0x1p40},
    {"random, tiny", 300, 0, 8, 0.2, 0x1p-800, 0},
    {"leaves of more pieces than entries of the table count", 700, 0, 250, 0.1, 1, 0},
    {"one", 1, 0, 24, 0.2, 1, 0},
    {"none", 0, 0, 24, 0.2, 1, 0},
};
enum { KINDS = sizeof kinds / sizeof *kinds };

/* A few points among the segments; and a star of them, and a bundle of equal ones. */
static void add_oddities(froe_scene *scene, const kind_of_scene *k) {
    double s = k->scale;
    for (uint32_t i = 0; i < k->count / 20; i++) {
        double x = trees_unit(5, 2 * i) * s + k->shift, y = trees_unit(5, 2 * i + 1) * s + k->shift;
        if (k->grid) x = floor(trees_unit(5, 2 * i) * k->grid) * s, y = floor(trees_unit(6, i) * k->grid) * s;
        const double point[4] = {x, y, x, y}, ray[4] = {0.5 * s + k->shift, 0.5 * s + k->shift, x, y};
        const double equal[4] = {0.25 * s + k->shift, 0.25 * s + k->shift, 0.5 * s + k->shift, 0.75 * s + k->shift};
        assert_int_equal(trees_add(scene, FROE_POINT, 1, point, NULL, NULL), FROE_OK);
        assert_int_equal(trees_add(scene, FROE_SEGMENT, 1, point, NULL, NULL), FROE_OK);
        assert_int_equal(trees_add(scene, FROE_SEGMENT, 1, ray, NULL, NULL), FROE_OK);
        if (i % 3 == 0) assert_int_equal(trees_add(scene, FROE_SEGMENT, 1, equal, NULL, NULL), FROE_OK);
    }
}

static froe_scene *scene_of(const kind_of_scene *k) {
    froe_scene *scene;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    for (uint32_t i = 0; i < k->count; i++) {
        double c[4];
        for (int j = 0; j < 2; j++) {
            double at = trees_unit(1, 4 * i + (uint32_t)j);
            for (int e = 0; e < 2; e++) {
                double x = at + k->size * (trees_unit(2, 4 * i + (uint32_t)(2 * j + e)) - 0.5);
                c[2 * e + j] = (k->grid ? floor(x * k->grid) : x) * k->scale + k->shift;
                if (isinf(c[2 * e + j])) c[2 * e + j] = x > 0 ? DBL_MAX : -DBL_MAX;
            }
        }
        assert_int_equal(trees_add(scene, FROE_SEGMENT, 1, c, NULL, NULL), FROE_OK);
    }
    add_oddities(scene, k);
    return scene;
}

static void assert_audited(const froe_tree *t, const char *name) {
    froe_diagnostic why;
    if (froe_tree_audit(t, NULL, &why)) fail_msg("%s: %s", name, why.message);
}

static froe_tree *tree_of(const kind_of_scene *k, bool grids) {
    froe_scene *scene = scene_of(k);
    froe_tree *tree;
    froe_build_options o = froe_build_defaults();
    froe_diagnostic why;
    o.method = "index", o.leaf = k->leaf, o.settings = grids ? "grid=4 load=2" : NULL;
    if (build_tuned(scene, &o, &tree, &why)) fail_msg("%s: %s", k->name, why.message);
    froe_scene_free(scene);
    assert_true(tree_is_packed(tree));
    assert_audited(tree, k->name);
    return tree;
}

/* ------------------------------------------------------------------ queries -- */

/* A number that queries may trip over: a corner's coordinate, a cut, one beside it, anything in or around the scene. */
static double odd_number(const froe_tree *t, int axis, uint64_t draw) {
    const froe_scene *s = t->scene;
    double lo = t->meta.root_lo[axis], hi = t->meta.root_hi[axis], share = 1.2 * trees_unit(11, draw) - 0.1;
    uint32_t node = t->node_count ? trees_random(12, draw, t->node_count) : 0;
    double x = lo * (1 - share) + hi * share;
    switch (trees_random(13, draw, 6)) {
    case 0:
        if (s->vertex_count) x = scene_vertex(s, trees_random(14, draw, s->vertex_count))[axis];
        break;
    case 1:
        if (!tree_is_leaf(t->nodes + node) && t->nodes[node].axis == axis) x = t->nodes[node].u.value;
        break;
    case 2:
        if (s->vertex_count) x = nextafter(scene_vertex(s, trees_random(14, draw, s->vertex_count))[axis], -INFINITY);
        break;
    default:
        break;
    }
    return isinf(x) ? (x > 0 ? DBL_MAX : -DBL_MAX) : x;
}

static packed_window window_of(const froe_tree *t, uint64_t draw) {
    packed_window w;
    uint32_t sort = trees_random(20, draw, 10);
    for (int k = 0; k < 2; k++) {
        double a = odd_number(t, k, 8 * draw + (uint64_t)k), b = odd_number(t, k, 8 * draw + 2 + (uint64_t)k);
        double small = (t->meta.root_hi[k] * 0.05 - t->meta.root_lo[k] * 0.05) * trees_unit(21, draw);
        if (sort < 4) b = a + small;
        if (sort == 4) b = a;
        if (isinf(b)) b = DBL_MAX;
        w.lo[k] = fmin(a, b), w.hi[k] = fmax(a, b);
        if (sort == 5 && k == (int)(draw % 2)) w.lo[k] = -INFINITY;
        if (sort == 6) w.hi[k] = INFINITY;
    }
    return w;
}

static int ascending(const void *a, const void *b) {
    uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

static size_t brute_force(const froe_scene *s, const packed_window *w, uint32_t *out) {
    size_t count = 0;
    const double *ends[2];
    for (uint32_t i = 0; i < s->object_count; i++) {
        packed_ends(s, i, ends);
        if (oracle_segment_meets_box(ends[0], ends[1], w->lo, w->hi)) out[count++] = i;
    }
    return count;
}

typedef struct asking {
    froe_query *q[3]; /* one for each set of kernels */
    size_t kernels;
    uint32_t *expected, *first;
    uint64_t decisions, answers;
} asking;

static asking asking_of(const froe_tree *t) {
    asking a = {.kernels = 0};
    for (; packed_kernels_at(a.kernels); a.kernels++) {
        assert_int_equal(froe_query_new(t, &a.q[a.kernels], NULL), FROE_OK);
        a.q[a.kernels]->packed->kernels = packed_kernels_at(a.kernels);
    }
    a.expected = malloc((t->scene->object_count + 1) * sizeof(uint32_t));
    a.first = malloc((t->scene->object_count + 1) * sizeof(uint32_t));
    return a;
}

static void asking_end(asking *a) {
    for (size_t i = 0; i < a->kernels; i++) froe_query_free(a->q[i]);
    free(a->expected);
    free(a->first);
}

static void ask_window(asking *a, const froe_tree *t, const char *name, uint64_t draw) {
    packed_window w = window_of(t, draw);
    size_t expected = brute_force(t->scene, &w, a->expected);
    for (size_t i = 0; i < a->kernels; i++) {
        froe_query *q = a->q[i];
        uint64_t count;
        assert_int_equal(packed_range(q, w.lo, w.hi), FROE_OK);
        if (q->found.count != expected)
            fail_msg("%s, window %llu, %s: %zu for %zu", name, (unsigned long long)draw, q->packed->kernels->name,
                     q->found.count, expected);
        if (!expected) continue;
        if (i) assert_memory_equal(q->found.data, a->first, expected * sizeof(uint32_t));
        memcpy(a->first, q->found.data, expected * sizeof(uint32_t));
        qsort(q->found.data, expected, sizeof(uint32_t), ascending);
        assert_memory_equal(q->found.data, a->expected, expected * sizeof(uint32_t));
        assert_int_equal(packed_count_range(q, w.lo, w.hi, &count), FROE_OK);
        assert_int_equal(count, expected);
        assert_int_equal(packed_any(q, w.lo, w.hi), FROE_OK);
        assert_true(q->found.count > 0);
        for (size_t j = 0; j < q->found.count; j++)
            assert_non_null(bsearch(q->found.data + j, a->expected, expected, sizeof(uint32_t), ascending));
    }
    a->decisions += t->scene->object_count;
    a->answers += expected;
}

static void windows_are_answered_exactly(void **state) {
    (void)state;
    uint64_t decisions = 0, answers = 0;
    for (size_t k = 0; k < 2 * KINDS; k++) {
        froe_tree *t = tree_of(kinds + k / 2, k % 2);
        asking a = asking_of(t);
        for (uint64_t draw = 0; draw < 150; draw++) ask_window(&a, t, kinds[k / 2].name, draw);
        decisions += a.decisions, answers += a.answers;
        asking_end(&a);
        froe_tree_free(t);
    }
    assert_true(decisions > 1000000 && answers > 100000);
}

/* ---------------------------------------------------------------- vertical -- */

static uint32_t first_by_force(const froe_scene *s, const double *point, int direction) {
    mpq_t best, here;
    uint32_t object = FROE_NONE;
    const double *ends[2];
    mpq_init(best);
    mpq_init(here);
    for (uint32_t i = 0; i < s->object_count; i++) {
        packed_ends(s, i, ends);
        if (scene_kind(s, i) != FROE_SEGMENT || !oracle_height(ends[0], ends[1], point, direction, here)) continue;
        if (object == FROE_NONE || mpq_cmp(here, best) * direction < 0) mpq_set(best, here), object = i;
    }
    mpq_clear(best);
    mpq_clear(here);
    return object;
}

enum { POINTS = 150 };

/* All at once, as a batch, and one by one. */
static void ask_vertical(asking *a, const froe_tree *t, const char *name) {
    double points[2 * POINTS];
    uint32_t batch[POINTS], alone;
    for (uint64_t i = 0; i < 2 * POINTS; i++) points[i] = odd_number(t, (int)(i % 2), 7000 + i);
    for (int direction = -1; direction <= 1; direction += 2) {
        for (size_t k = 0; k < a->kernels; k++) {
            assert_int_equal(packed_vertical(a->q[k], points, POINTS, direction, batch), FROE_OK);
            for (size_t i = 0; i < POINTS; i++) {
                assert_int_equal(packed_vertical(a->q[k], points + 2 * i, 1, direction, &alone), FROE_OK);
                uint32_t expected = k ? alone : first_by_force(t->scene, points + 2 * i, direction);
                if (alone != expected || batch[i] != alone)
                    fail_msg("%s, point %zu (%.17g %.17g), direction %d: %u alone, %u in a batch, for %u", name, i,
                             points[2 * i], points[2 * i + 1], direction, alone, batch[i], expected);
            }
        }
        a->decisions += (uint64_t)POINTS * t->scene->object_count;
    }
}

static void verticals_are_answered_exactly(void **state) {
    (void)state;
    uint64_t decisions = 0;
    for (size_t k = 0; k < 2 * KINDS; k++) {
        froe_tree *t = tree_of(kinds + k / 2, k % 2);
        asking a = asking_of(t);
        ask_vertical(&a, t, kinds[k / 2].name);
        decisions += a.decisions;
        asking_end(&a);
        froe_tree_free(t);
    }
    assert_true(decisions > 1000000);
}

/* ------------------------------------------------------------------- pairs -- */

typedef struct told {
    ARRAY(froe_pair) pairs;
    size_t most; /* stop after so many */
} told;

static bool note_pair(void *user, const froe_pair *pair) {
    told *t = user;
    const froe_allocator alloc = support_allocator(NULL);
    assert_true(array_push(&alloc, &t->pairs, *pair));
    return t->pairs.count < t->most;
}

static int by_ids(const void *a, const void *b) {
    const froe_pair *p = a, *q = b;
    return p->a != q->a ? (p->a > q->a) - (p->a < q->a) : (p->b > q->b) - (p->b < q->b);
}

static bool same_corner(const double *a, const double *b) {
    return a[0] == b[0] && a[1] == b[1];
}

/* Do two objects that touch have nothing but a corner of both in common? */
static bool at_corner(const double *const u[2], const double *const v[2]) {
    return same_corner(u[0], v[0]) || same_corner(u[0], v[1]) || same_corner(u[1], v[0]) || same_corner(u[1], v[1]);
}

static void pairs_by_force(const froe_scene *s, bool shared, told *out) {
    static const froe_meeting kind[4] = {[1] = FROE_MEET_CROSS, [2] = FROE_MEET_TOUCH, [3] = FROE_MEET_OVERLAP};
    const double *u[2], *v[2];
    for (uint32_t i = 0; i < s->object_count; i++)
        for (uint32_t j = i + 1; j < s->object_count; j++) {
            packed_ends(s, i, u);
            packed_ends(s, j, v);
            int how = oracle_segments_meet(u, v);
            if (how && (shared || how != 2 || !at_corner(u, v))) note_pair(out, &(froe_pair){i, j, kind[how]});
        }
}

/* Asks on several threads, and expects these pairs in this order. */
static void expect_pairs(froe_query *query, unsigned threads, bool shared, const told *expected, const char *name) {
    const froe_allocator alloc = support_allocator(NULL);
    told found = {.most = SIZE_MAX};
    froe_batch_options o = froe_batch_defaults();
    o.threads = threads;
    assert_int_equal(froe_batch_pairs(query, shared, &o, note_pair, &found, NULL), FROE_OK);
    if (found.pairs.count != expected->pairs.count)
        fail_msg("%s, %s, %u threads: %zu pairs for %zu", name, query->packed->kernels->name, threads,
                 found.pairs.count, expected->pairs.count);
    for (size_t i = 0; i < found.pairs.count; i++) {
        const froe_pair *p = found.pairs.data + i, *q = expected->pairs.data + i;
        if (by_ids(p, q) || p->kind != q->kind)
            fail_msg("%s, %u threads: %u %u kind %d for %u %u kind %d", name, threads, p->a, p->b, (int)p->kind, q->a,
                     q->b, (int)q->kind);
    }
    array_free(&alloc, &found.pairs);
}

/* By all kernels: those of brute force, each once, by ids. */
static uint64_t check_pairs(asking *a, const froe_tree *t, const char *name, bool shared) {
    const froe_allocator alloc = support_allocator(NULL);
    told expected = {.most = SIZE_MAX};
    pairs_by_force(t->scene, shared, &expected);
    for (size_t k = 0; k < a->kernels; k++)
        for (unsigned threads = 1; threads <= 3; threads += 2) expect_pairs(a->q[k], threads, shared, &expected, name);
    uint64_t count = expected.pairs.count;
    array_free(&alloc, &expected.pairs);
    return count;
}

static void pairs_are_told_exactly_once(void **state) {
    (void)state;
    uint64_t decisions = 0, pairs = 0;
    for (size_t k = 0; k < 2 * KINDS; k++) {
        froe_tree *t = tree_of(kinds + k / 2, k % 2);
        asking a = asking_of(t);
        for (int shared = 0; shared < 2; shared++) pairs += check_pairs(&a, t, kinds[k / 2].name, shared);
        decisions += (uint64_t)t->scene->object_count * t->scene->object_count;
        asking_end(&a);
        froe_tree_free(t);
    }
    assert_true(decisions > 2000000 && pairs > 50000);
}

static void a_visitor_stops_the_pairs(void **state) {
    (void)state;
    const froe_allocator alloc = support_allocator(NULL);
    froe_tree *t = tree_of(kinds + 1, false);
    asking a = asking_of(t);
    told found = {.most = 5};
    assert_int_equal(froe_query_pairs(a.q[0], true, note_pair, &found, NULL), FROE_OK);
    assert_int_equal(found.pairs.count, 5);
    array_free(&alloc, &found.pairs);
    asking_end(&a);
    froe_tree_free(t);
}

/* Scenes of so many nodes that each thread gets several runs of them, against a tree that is not packed. */
static void pairs_do_not_depend_on_threads(void **state) {
    (void)state;
    const froe_allocator alloc = support_allocator(NULL);
    const struct {
        uint32_t count;
        double size;
    } scenes[] = {{20000, 0.03}, {3600, 3}}; /* the second has more pairs than are gathered */
    for (size_t k = 0; k < sizeof scenes / sizeof *scenes; k++) {
        froe_scene *scene = trees_scene(2, FROE_SEGMENT, scenes[k].count, 0, scenes[k].size, 7);
        froe_tree *general = trees_build(scene, "density", 8), *packed = trees_build(scene, "index", 4);
        froe_query *q, *reference;
        told expected = {.most = SIZE_MAX};
        assert_int_equal(froe_query_new(general, &reference, NULL), FROE_OK);
        assert_int_equal(froe_query_new(packed, &q, NULL), FROE_OK);
        assert_int_equal(froe_query_pairs(reference, true, note_pair, &expected, NULL), FROE_OK);
        assert_true(expected.pairs.count > 10000);
        if (k) assert_true(expected.pairs.count > 16 * (uint64_t)scenes[k].count + (1 << 20));
        for (unsigned threads = 1; threads <= 5; threads += 4) expect_pairs(q, threads, true, &expected, "threads");
        array_free(&alloc, &expected.pairs);
        froe_query_free(q), froe_query_free(reference);
        froe_tree_free(packed), froe_tree_free(general);
        froe_scene_free(scene);
    }
}

/* Says no at the end, when all pairs are found. */
static bool almost(void *user, double done) {
    double *most = user;
    assert_true(done >= *most && done <= 1);
    *most = done;
    return done < 0.8;
}

static void pairs_are_cancelled_before_they_are_told(void **state) {
    (void)state;
    const froe_allocator alloc = support_allocator(NULL);
    froe_tree *t = tree_of(kinds + 1, false);
    asking a = asking_of(t);
    told found = {.most = SIZE_MAX};
    double most = 0;
    froe_diagnostic why;
    froe_batch_options o = froe_batch_defaults();
    o.threads = 2, o.progress = almost, o.user = &most;
    assert_int_equal(froe_batch_pairs(a.q[0], true, &o, note_pair, &found, &why), FROE_E_CANCELLED);
    assert_int_equal(why.status, FROE_E_CANCELLED);
    assert_int_equal(found.pairs.count, 0);
    array_free(&alloc, &found.pairs);
    asking_end(&a);
    froe_tree_free(t);
}

/* ------------------------------------------------------------------ batches -- */

static void batches_answer_as_single_questions_do(void **state) {
    enum { MANY = 1000 };
    (void)state;
    static double points[2 * MANY];
    static uint32_t objects[3][MANY];
    froe_tree *t = tree_of(kinds, true);
    froe_query *q;
    froe_batch_options o = froe_batch_defaults();
    froe_diagnostic why;
    assert_int_equal(froe_query_new(t, &q, NULL), FROE_OK);
    for (uint64_t i = 0; i < 2 * MANY; i++) points[i] = odd_number(t, (int)(i % 2), 90000 + i);
    for (size_t i = 0; i < MANY; i++)
        assert_int_equal(froe_query_vertical(q, points + 2 * i, -1, &objects[0][i], NULL), FROE_OK);
    for (unsigned threads = 1; threads < 3; threads++) {
        o.threads = threads;
        assert_int_equal(froe_batch_vertical(q, points, MANY, -1, &o, objects[threads], NULL), FROE_OK);
        assert_memory_equal(objects[threads], objects[0], sizeof objects[0]);
    }
    points[2 * 700 + 1] = NAN;
    assert_int_equal(froe_batch_vertical(q, points, MANY, -1, &o, objects[1], &why), FROE_E_INPUT);
    assert_int_equal(why.object, 700);
    assert_int_equal(froe_batch_vertical(q, points, MANY, 2, &o, objects[1], &why), FROE_E_ARG);
    froe_query_free(q);
    froe_tree_free(t);
}

/* ------------------------------------------------------------------- faults -- */

static bool go_on(void *user, const froe_pair *pair) {
    (void)user, (void)pair;
    return true;
}

/* Every query once, in memory that runs out at some moment. */
static froe_status ask_all(void *user, const froe_allocator *alloc) {
    froe_scene *scene = NULL;
    froe_tree *tree = NULL;
    froe_query *q = NULL;
    froe_list list;
    uint64_t count;
    uint32_t object;
    const double all[4] = {-1, -1, 2, 2}, some[4] = {0.1, 0.1, 0.8, 0.8};
    froe_build_options o = froe_build_defaults();
    froe_range range = froe_range_defaults();
    (void)user;
    o.method = "index", o.leaf = 4;
    range.points = some;
    froe_status status = froe_scene_new(2, alloc, &scene);
    if (!status) status = trees_scatter(scene, FROE_SEGMENT, 40, 0, 0.3, 3);
    if (!status) status = froe_build(scene, &o, &tree, NULL);
    if (!status) status = froe_query_new(tree, &q, NULL);
    if (!status) status = froe_query_range(q, &range, &list, NULL);
    range.points = all;
    if (!status) status = froe_query_count(q, &range, &count, NULL);
    if (!status) status = froe_query_vertical(q, some, 1, &object, NULL);
    if (!status) status = froe_query_pairs(q, true, go_on, NULL, NULL);
    froe_query_free(q);
    froe_tree_free(tree);
    froe_scene_free(scene);
    return status;
}

static void queries_survive_every_failing_allocation(void **state) {
    (void)state;
    assert_true(test_memory_each(ask_all, NULL) > 20);
}

/* Rays through two neighbouring cells of a column, from below and from above, against brute force. */
static void check_neighbours(froe_query *q, const froe_tree *t, uint32_t column, uint32_t row) {
    const tree_table *table = t->packed.table;
    for (uint32_t i = 0; i < 8; i++)
        for (int direction = -1; direction <= 1; direction += 2) {
            double place = row + (direction > 0 ? 0.1 + 0.1 * i : 1.1 + 0.1 * i);
            const double point[2] = {table->lo[0] + (column + 0.1 + 0.1 * i) / table->scale[0],
                                     table->lo[1] + place / table->scale[1]};
            uint32_t object;
            assert_int_equal(packed_vertical(q, point, 1, direction, &object), FROE_OK);
            assert_int_equal(object, first_by_force(t->scene, point, direction));
        }
}

/* An entry of the table holds a node or a block: equal numbers of different kinds are different places. */
static void a_block_is_not_taken_for_a_node_of_the_same_number(void **state) {
    (void)state;
    uint32_t coincidences = 0;
    for (uint64_t seed = 1; seed < 60; seed++) {
        froe_scene *scene = trees_scene(2, FROE_SEGMENT, 600, 0, 0.05, seed);
        froe_tree *t = trees_build(scene, "index", 3);
        froe_query *q;
        froe_scene_free(scene);
        assert_int_equal(froe_query_new(t, &q, NULL), FROE_OK);
        for (uint32_t i = 0; i < t->packed.table->cells[0]; i++)
            for (uint32_t j = 0; j + 1 < t->packed.table->cells[1]; j++) {
                tree_entry a = tree_table_at(t->packed.table, i, j), b = tree_table_at(t->packed.table, i, j + 1);
                if (a.at != b.at || a.kind == b.kind) continue;
                coincidences++;
                check_neighbours(q, t, i, j);
            }
        froe_query_free(q);
        froe_tree_free(t);
    }
    assert_true(coincidences > 3);
}

/* The entry of a cell whose node is a leaf of so many pieces, with such a block. */
static void check_entry(froe_tree *t, const table_cells *cells, uint32_t cell, uint32_t pieces, uint32_t block) {
    tree_node *leaf = t->nodes + cells->nodes[cell], was = *leaf;
    tree_table *table;
    leaf->u.list.count = pieces, leaf->child = block;
    assert_int_equal(tree_table_from(t, cells, &table), FROE_OK);
    const tree_entry entry = tree_table_at(table, cell / table->cells[1], cell % table->cells[1]);
    const bool fits = pieces < 1u << 7 && block < 1u << 24;
    assert_int_equal(entry.kind, fits ? TABLE_LEAF | pieces : 0);
    assert_int_equal(entry.at, fits ? block : cells->nodes[cell]);
    tree_table_free(&t->alloc, table);
    *leaf = was;
}

static void entries_name_leaves_whose_numbers_fit(void **state) {
    froe_scene *scene = trees_scene(2, FROE_SEGMENT, 600, 0, 0.05, 1);
    froe_tree *t = trees_build(scene, "index", 3);
    table_cells cells;
    uint32_t leaves = 0;
    (void)state;
    froe_scene_free(scene);
    assert_int_equal(tree_table_cells(t, &cells), FROE_OK);
    for (uint32_t i = 0; i < cells.count; i++) {
        if (cells.nodes[i] & TABLE_RAGGED_CELL || !tree_is_leaf(t->nodes + cells.nodes[i])) continue;
        check_entry(t, &cells, i, 127, (1u << 24) - 1);
        check_entry(t, &cells, i, 128, 0);
        check_entry(t, &cells, i, 0, 1u << 24);
        leaves++;
    }
    assert_true(leaves > 10);
    tree_table_cells_free(t, &cells);
    froe_tree_free(t);
}

/* Wherever the scene lies and however small its cells are: searches believe units to within the error that a block
 * tells. */
static void units_are_audited_exactly(void **state) {
    size_t changed = 0;
    (void)state;
    for (size_t i = 0; i < KINDS; i++) {
        kind_of_scene k = kinds[i];
        k.count = k.count < 40 ? k.count : 40;
        froe_tree *t = tree_of(&k, false);
        for (uint32_t n = 0; n < t->node_count; n++) {
            const tree_node *leaf = t->nodes + n;
            const packed_header *h = tree_is_leaf(leaf) ? packed_block(t, leaf) : NULL;
            for (size_t u = 0; h && h->error < 1 && u < 4 * (size_t)leaf->u.list.count; u++) {
                uint16_t *unit = (uint16_t *)(uintptr_t)packed_units(h) + u;
                const uint16_t was = *unit;
                *unit = (uint16_t)(was < 2 ? was + 2 : was - 2);
                if (froe_tree_audit(t, NULL, NULL) != FROE_E_AUDIT) fail_msg("%s, node %u", k.name, n);
                *unit = was;
                changed++;
            }
        }
        froe_tree_free(t);
    }
    assert_true(changed > 1000);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pairs_are_told_exactly_once),
        cmocka_unit_test(a_visitor_stops_the_pairs),
        cmocka_unit_test(pairs_do_not_depend_on_threads),
        cmocka_unit_test(pairs_are_cancelled_before_they_are_told),
        cmocka_unit_test(batches_answer_as_single_questions_do),
        cmocka_unit_test(queries_survive_every_failing_allocation),
        cmocka_unit_test(a_block_is_not_taken_for_a_node_of_the_same_number),
        cmocka_unit_test(entries_name_leaves_whose_numbers_fit),
        cmocka_unit_test(units_are_audited_exactly),
        cmocka_unit_test(verticals_are_answered_exactly),
        cmocka_unit_test(windows_are_answered_exactly),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
