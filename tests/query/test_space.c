/* Packed trees of space: the same answers as brute force, on all kernels that the machine has; validation and audit of
 * blocks. (What tests/query asks of all builders is asked of these, too.) */
#include "oracle/convex.h"
#include "query/spaces.h"
#include "support/large.h"
#include "support/memory.h"
#include "tree/validate.h"
#include <stdlib.h>

static int ascending(const void *a, const void *b) {
    uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

/* Within one axis, two, or all three, thick or thin. */
static void check_window(froe_query *q, froe_query *reference, uint64_t draw, const char *name) {
    double w[6], x[3], y[3];
    froe_range range = froe_range_defaults();
    froe_list found, wanted;
    uint64_t count;
    odd_point(q->tree, 2 * draw, x);
    odd_point(q->tree, 2 * draw + 1, y);
    for (int k = 0; k < 3; k++) {
        double step = trees_unit(21, draw) * 0.3 * (y[k] - x[k]);
        double other = draw % 3 == 0 ? y[k] : draw % 3 == 1 ? x[k] + step : x[k];
        w[k] = fmin(x[k], other), w[3 + k] = fmax(x[k], other);
        if (draw % 11 == 7) w[k] = -INFINITY;
        if (isinf(w[k])) continue;
        if (draw % 7 == 3 + (uint64_t)k) w[3 + k] = w[k]; /* flat */
        if (draw % 14 == 6 && k < 2) w[3 + k] = w[k];     /* a line */
        if (draw % 14 == 13 && k) w[3 + k] = w[k] + 0x1p-19 * fabs(w[3 + k] - w[k]);
    }
    range.points = w;
    assert_int_equal(froe_query_range(reference, &range, &wanted, NULL), FROE_OK);
    assert_int_equal(froe_query_range(q, &range, &found, NULL), FROE_OK);
    qsort((void *)(uintptr_t)found.ids, found.count, sizeof *found.ids, ascending);
    qsort((void *)(uintptr_t)wanted.ids, wanted.count, sizeof *wanted.ids, ascending);
    if (found.count != wanted.count || (found.count && memcmp(found.ids, wanted.ids, found.count * sizeof *found.ids)))
        fail_msg("%s, window %d: %zu objects, not %zu", name, (int)draw, found.count, wanted.count);
    size_t wanted_count = wanted.count;
    assert_int_equal(froe_query_count(q, &range, &count, NULL), FROE_OK);
    assert_int_equal(count, wanted_count);
}

/* Through a corner or the middle of an edge of an object, along an edge, or in its plane. */
static void aim_at_object(const froe_tree *t, uint64_t draw, double o[3], double d[3]) {
    const froe_scene *s = t->scene;
    const uint32_t object = trees_random(16, draw, s->object_count), corners = scene_corners(s, object);
    const double *p = scene_point(s, object, 0),
                 *q = scene_point(s, object, corners > 1 && scene_form(s, object) != FROE_BALL);
    for (int k = 0; k < 3; k++) {
        if (draw % 3 == 1) d[k] = 0.5 * (p[k] + q[k]) - o[k];
        if (draw % 3 == 2) d[k] = q[k] - p[k], o[k] = p[k] - (draw % 2 ? 2 : 0) * d[k];
        if (draw % 3 == 0) d[k] = q[k] - o[k];
    }
}

/* Through corners, along axes and nearly so, from far away, in the planes of triangles, in long and in short steps. */
static void odd_ray(const froe_tree *t, uint64_t draw, double o[3], double d[3]) {
    double to[3];
    odd_point(t, 1000 + 2 * draw, o);
    odd_point(t, 1001 + 2 * draw, to);
    for (int k = 0; k < 3; k++) d[k] = to[k] - o[k];
    if (draw % 4 == 3) aim_at_object(t, draw / 4, o, d);
    if (draw % 5 == 1) d[draw % 3] = 0;
    if (draw % 7 == 1) d[draw % 3] *= 0x1p-70;
    if (d[0] == 0 && d[1] == 0 && d[2] == 0) d[2] = t->meta.root_hi[2] - t->meta.root_lo[2];
    if (d[2] == 0 && d[0] == 0 && d[1] == 0) d[2] = 1;
    if (draw % 9 == 2)
        for (int k = 0; k < 3; k++) o[k] -= (draw % 2 ? 100 : 0x1p30) * d[k];
    const double most = fmax(fabs(d[0]), fmax(fabs(d[1]), fabs(d[2])));
    const double step = draw % 16 == 5 ? 1e300 / most : draw % 16 == 6 ? 0x1p-1060 / most : 1; /* the last: denormal */
    for (int k = 0; k < 3; k++) d[k] *= isfinite(step) ? step : 1;
    if (d[0] == 0 && d[1] == 0 && d[2] == 0) d[2] = 1;
}

static void check_ray_until(froe_query *q, froe_query *reference, const double *o, const double *d, double t_max,
                            const char *name, uint64_t draw) {
    froe_hit hit, wanted;
    uint32_t any;
    query_met met;
    assert_int_equal(froe_query_ray(reference, o, d, t_max, &wanted, NULL), FROE_OK);
    assert_int_equal(froe_query_ray(q, o, d, t_max, &hit, NULL), FROE_OK);
    if (hit.object != wanted.object || hit.t != wanted.t)
        fail_msg("%s, ray %d up to %a: object %u at %a, not %u at %a", name, (int)draw, t_max, hit.object, hit.t,
                 wanted.object, wanted.t);
    assert_int_equal(froe_query_ray_any(q, o, d, t_max, &any, NULL), FROE_OK);
    const bool met_any = any != FROE_NONE && query_ray_meets(reference, &reference->ray.ray, any, t_max, &met);
    if (met_any != (wanted.object != FROE_NONE) || met_any != (any != FROE_NONE))
        fail_msg("%s, ray %d up to %a: object %u is not any", name, (int)draw, t_max, any);
}

/* Up to infinity, to the first hit, to just before it, and to just beyond it. */
static void check_ray(froe_query *q, froe_query *reference, uint64_t draw, const char *name) {
    double o[3], d[3];
    froe_hit hit;
    odd_ray(q->tree, draw, o, d);
    check_ray_until(q, reference, o, d, INFINITY, name, draw);
    assert_int_equal(froe_query_ray(reference, o, d, INFINITY, &hit, NULL), FROE_OK);
    if (hit.object == FROE_NONE) return;
    const double until[3] = {hit.t, nextafter(hit.t, -1) > 0 ? nextafter(hit.t, -1) : 0, hit.t * (1 + 0x1p-18)};
    check_ray_until(q, reference, o, d, until[draw % 3], name, draw);
}

static void check_near(froe_query *q, froe_query *reference, uint64_t draw, const char *name) {
    double x[3];
    froe_neighbours found, wanted;
    odd_point(q->tree, 5000 + draw, x);
    size_t k = 1 + draw % 4;
    assert_int_equal(froe_query_near(reference, x, k, INFINITY, &wanted, NULL), FROE_OK);
    assert_int_equal(froe_query_near(q, x, k, INFINITY, &found, NULL), FROE_OK);
    assert_int_equal(found.count, wanted.count);
    for (size_t i = 0; i < found.count; i++)
        if (found.items[i].object != wanted.items[i].object || found.items[i].distance != wanted.items[i].distance)
            fail_msg("%s, point %d: neighbour %zu is %u, not %u", name, (int)draw, i, found.items[i].object,
                     wanted.items[i].object);
}

static void every_kernel_gives_the_answers_of_general_trees(void **state) {
    (void)state;
    for (int i = 0; i < KINDS; i++) {
        froe_tree *tree = tree_of(kinds + i), *general = reference_of(tree);
        for (size_t kernel = 0; space_kernels_at(kernel); kernel++) {
            froe_query *q, *reference;
            assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
            assert_int_equal(froe_query_new(general, &reference, NULL), FROE_OK);
            q->space->kernels = space_kernels_at(kernel);
            for (uint64_t draw = 0; draw < QUERIES; draw++) {
                check_window(q, reference, draw, kinds[i].name);
                check_ray(q, reference, draw, kinds[i].name);
                check_near(q, reference, draw, kinds[i].name);
            }
            froe_query_free(q);
            froe_query_free(reference);
        }
        froe_tree_free(general);
        froe_tree_free(tree);
    }
}

/* -------------------------------------------------------------------- batches -- */

enum { RAYS = 280 }; /* more than a thread takes at a time */

typedef struct rays {
    double o[3 * RAYS], d[3 * RAYS];
    froe_hit hits[RAYS];
    uint32_t any[RAYS];
} rays;

static void answer_one_by_one(froe_query *q, rays *r, double t_max) {
    for (size_t i = 0; i < RAYS; i++) {
        assert_int_equal(froe_query_ray(q, r->o + 3 * i, r->d + 3 * i, t_max, r->hits + i, NULL), FROE_OK);
        assert_int_equal(froe_query_ray_any(q, r->o + 3 * i, r->d + 3 * i, t_max, r->any + i, NULL), FROE_OK);
    }
}

static void check_batch(froe_query *q, const rays *r, double t_max, size_t count, const char *name) {
    static froe_hit hits[RAYS];
    static uint32_t any[RAYS];
    for (unsigned way = 0; way < 3; way++) {
        froe_batch_options o = froe_batch_defaults();
        o.threads = way < 2 ? 1 : 3;
        large_ask(q, way == 1);
        assert_int_equal(froe_batch_ray(q, r->o, r->d, count, t_max, &o, hits, NULL), FROE_OK);
        assert_int_equal(froe_batch_ray_any(q, r->o, r->d, count, t_max, &o, any, NULL), FROE_OK);
        for (size_t i = 0; i < count; i++)
            if (hits[i].object != r->hits[i].object || hits[i].t != r->hits[i].t || any[i] != r->any[i])
                fail_msg("%s, ray %d of %d: object %u at %a, any %u; alone %u at %a, any %u", name, (int)i, (int)count,
                         hits[i].object, hits[i].t, any[i], r->hits[i].object, r->hits[i].t, r->any[i]);
    }
}

static void batches_answer_as_rays_alone(void **state) {
    rays *r = malloc(sizeof *r);
    (void)state;
    for (int i = 0; i < KINDS; i++) {
        froe_tree *tree = tree_of(kinds + i);
        for (uint64_t draw = 0; draw < RAYS; draw++) odd_ray(tree, draw, r->o + 3 * draw, r->d + 3 * draw);
        for (size_t kernel = 0; space_kernels_at(kernel); kernel++) {
            froe_query *q;
            assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
            q->space->kernels = space_kernels_at(kernel);
            for (int far = 0; far < 2; far++) {
                const double t_max = far ? (double)INFINITY : 0.25;
                answer_one_by_one(q, r, t_max);
                check_batch(q, r, t_max, RAYS, kinds[i].name);
                check_batch(q, r, t_max, 1 + (size_t)i, kinds[i].name);
            }
            froe_query_free(q);
        }
        froe_tree_free(tree);
    }
    free(r);
}

/* The first bad one ends the call, wherever it is. */
static void batches_refuse_bad_rays(void **state) {
    froe_tree *tree = tree_of(kinds);
    froe_query *q;
    rays *r = malloc(sizeof *r);
    froe_diagnostic why;
    (void)state;
    assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
    for (uint64_t draw = 0; draw < RAYS; draw++) odd_ray(tree, draw, r->o + 3 * draw, r->d + 3 * draw);
    r->o[3 * 270 + 1] = NAN;
    for (int k = 0; k < 3; k++) r->d[3 * 275 + k] = 0;
    assert_int_equal(froe_batch_ray(q, r->o, r->d, RAYS, INFINITY, NULL, r->hits, &why), FROE_E_INPUT);
    assert_int_equal(why.object, 270);
    assert_int_equal(froe_batch_ray_any(q, r->o, r->d, 5, -1, NULL, r->any, &why), FROE_E_INPUT);
    assert_int_equal(why.object, 0);
    assert_int_equal(froe_batch_ray(q, r->o, r->d, 270, INFINITY, NULL, r->hits, &why), FROE_OK);
    assert_int_equal(froe_batch_ray(q, r->o, r->d, 0, INFINITY, NULL, r->hits, &why), FROE_OK);
    froe_query_free(q);
    froe_tree_free(tree);
    free(r);
}

/* --------------------------------------------------------------------- memory -- */

static froe_status ask_without_memory(void *user, const froe_allocator *alloc) {
    froe_tree tree = *(const froe_tree *)user;
    const double two[12] = {0, 0, 0, 0.4, 0.6, -1, 1, 1, 1, 0.01, 0.02, 1}, window[6] = {0.2, 0.2, 0.2, 0.6, 0.6, 0.6};
    froe_range range = froe_range_defaults();
    froe_query *q;
    froe_hit hit, hits[2];
    froe_neighbours near;
    froe_list list;
    uint32_t any;
    tree.alloc = *alloc;
    froe_status status = froe_query_new(&tree, &q, NULL);
    if (status) return status;
    range.points = window;
    large_ask(q, true);
    status = froe_query_ray(q, two, two + 6, INFINITY, &hit, NULL);
    if (!status) status = froe_query_ray_any(q, two, two + 6, INFINITY, &any, NULL);
    if (!status) status = froe_batch_ray(q, two, two + 6, 2, INFINITY, NULL, hits, NULL);
    if (!status) status = froe_query_near(q, two + 3, 1, INFINITY, &near, NULL);
    if (!status) status = froe_query_range(q, &range, &list, NULL);
    if (!status) assert_true(hits[0].object == hit.object && hits[0].t == hit.t && any != FROE_NONE && near.count == 1);
    froe_query_free(q);
    return status;
}

static void every_allocation_of_a_query_may_fail(void **state) {
    froe_tree *t = tree_of(kinds);
    (void)state;
    assert_true(test_memory_each(ask_without_memory, t) > 8);
    froe_tree_free(t);
}

/* ------------------------------------------------------------------- kernels -- */

static void assert_same(const space_found *a, const space_found *b) {
    assert_int_equal(a->count, b->count);
    assert_memory_equal(a->objects, b->objects, a->count * sizeof *a->objects);
    assert_memory_equal(a->keys, b->keys, a->count * sizeof *a->keys);
    assert_memory_equal(a->ends, b->ends, a->count * sizeof *a->ends);
}

static space_window odd_window(const froe_tree *t, uint64_t draw) {
    space_window w = {.wide = t->packed.wide};
    odd_point(t, 2 * draw, w.lo);
    odd_point(t, 2 * draw + 1, w.hi);
    for (int k = 0; k < 3; k++) {
        const double lo = w.lo[k] < w.hi[k] ? w.lo[k] : w.hi[k], hi = w.lo[k] < w.hi[k] ? w.hi[k] : w.lo[k];
        w.lo[k] = lo, w.hi[k] = hi;
        w.from[k] = (lo - w.wide->middle[k]) * w.wide->scale, w.to[k] = (hi - w.wide->middle[k]) * w.wide->scale;
    }
    return w;
}

static void assert_same_window(const space_kernels *first, const space_kernels *other, const space_header *h,
                               const space_window *w) {
    uint32_t sure[2][512], unsure[2][512];
    space_answers a = {sure[0], unsure[0], 0, 0}, b = {sure[1], unsure[1], 0, 0};
    first->window(h, w, &a);
    other->window(h, w, &b);
    assert_int_equal(a.sure_count, b.sure_count);
    assert_int_equal(a.unsure_count, b.unsure_count);
    assert_memory_equal(a.sure, b.sure, a.sure_count * sizeof *a.sure);
    assert_memory_equal(a.unsure, b.unsure, a.unsure_count * sizeof *a.unsure);
}

/* Bit for bit. */
static void kernels_agree(void **state) {
    froe_tree *t = tree_of(kinds + 1);
    const tree_wide *wide = t->packed.wide;
    const space_kernels *first = space_kernels_at(0), *other;
    uint32_t room = (uint32_t)t->report.max_leaf + PACKED_LANES, objects[2][512];
    float keys[2][512], ends[2][512], near[2][PACKED_LANES];
    froe_query *q;
    (void)state;
    assert_true(room <= 512);
    assert_int_equal(froe_query_new(t, &q, NULL), FROE_OK);
    for (size_t kernel = 1; (other = space_kernels_at(kernel)); kernel++)
        for (uint64_t draw = 0; draw < 20; draw++) {
            const space_window window = odd_window(t, draw);
            bool begun;
            odd_point(t, 2 * draw, q->ray.ray.o);
            odd_point(t, 2 * draw + 1, q->ray.ray.d);
            memcpy(q->near.point, q->ray.ray.o, sizeof(double[3]));
            q->near.scale = 1;
            assert_int_equal(space_walk_ray(q, &q->space->walk, &q->ray.ray, INFINITY, SPACE_ALL, &begun), FROE_OK);
            assert_true(begun);
            assert_int_equal(space_walk_near(q, &q->space->walk, SPACE_ALL, &begun), FROE_OK);
            assert_true(begun);
            for (size_t n = 0; n < wide->count; n++) {
                const wide_node *node = wide->nodes + n;
                uint32_t a = first->ray_node(node, &q->space->walk.ray, INFINITY, near[0]);
                assert_int_equal(a, other->ray_node(node, &q->space->walk.ray, INFINITY, near[1]));
                assert_memory_equal(near[0], near[1], node->count * sizeof(float));
                a = first->near_node(node, &q->space->walk.point, 1, near[0]);
                assert_int_equal(a, other->near_node(node, &q->space->walk.point, 1, near[1]));
                assert_memory_equal(near[0], near[1], node->count * sizeof(float));
                assert_int_equal(first->window_node(node, &window), other->window_node(node, &window));
            }
            for (uint32_t n = 0; n < t->node_count; n++) {
                if (!tree_is_leaf(t->nodes + n)) continue;
                const space_header *h = space_block(t, t->nodes[n].child);
                space_found a = {objects[0], keys[0], ends[0], 0}, b = {objects[1], keys[1], ends[1], 0};
                first->ray(h, &q->space->walk.ray, 0, INFINITY, &a);
                other->ray(h, &q->space->walk.ray, 0, INFINITY, &b);
                assert_same(&a, &b);
                a.count = b.count = 0;
                first->near(h, &q->space->walk.point, 0, 0.5f, &a);
                other->near(h, &q->space->walk.point, 0, 0.5f, &b);
                assert_same(&a, &b);
                assert_same_window(first, other, h, &window);
            }
        }
    froe_query_free(q);
    froe_tree_free(t);
}

/* A parameter up to or from a key. */
static double parameter_of_key(const space_walk *w, float key, double rounding) {
    return (w->ray.start + (double)key) * (1 + rounding) / w->per;
}

/* Every object of a block that a ray meets is found, not after its key; what is sure is met, and not after its end. */
static void check_block(froe_query *q, const space_kernels *kernels, const space_header *h, uint64_t *sure) {
    const space_walk *w = &q->space->walk;
    uint32_t objects[512];
    float keys[512], ends[512];
    space_found found = {objects, keys, ends, 0};
    kernels->ray(h, &w->ray, 0, INFINITY, &found);
    for (uint32_t i = 0; i < h->count; i++) {
        const uint32_t object = space_ids(h)[i] & PACKED_OBJECT;
        query_met met;
        const bool meets = query_ray_meets(q, &q->ray.ray, object, INFINITY, &met);
        size_t at = 0;
        while (at < found.count && objects[at] != object) at++;
        if (at == found.count) {
            assert_false(meets && i < h->triangles); /* of the rest, only parts in the cell are there */
            continue;
        }
        const double from = parameter_of_key(w, keys[at], -0x1p-45), to = parameter_of_key(w, ends[at], 0x1p-45);
        if (meets && i < h->triangles) assert_true(geom_hit_compare_to(&q->numbers, &q->ray.ray, &met.hit, from) >= 0);
        if (!isfinite(ends[at])) continue;
        assert_true(meets);
        assert_true(geom_hit_compare_to(&q->numbers, &q->ray.ray, &met.hit, to) <= 0);
        ++*sure;
    }
}

static void kernels_are_sure_only_of_what_is_met(void **state) {
    (void)state;
    for (int i = 0; i < KINDS; i++) {
        froe_tree *t = tree_of(kinds + i);
        froe_query *q;
        bool begun = true;
        uint64_t sure = 0;
        assert_int_equal(froe_query_new(t, &q, NULL), FROE_OK);
        for (uint64_t draw = 0; draw < 60 && t->packed.wide; draw++) {
            q->ray.ray = (geom_ray){.dim = 3};
            odd_ray(t, draw, q->ray.ray.o, q->ray.ray.d);
            assert_int_equal(space_walk_ray(q, &q->space->walk, &q->ray.ray, INFINITY, SPACE_ALL, &begun), FROE_OK);
            for (uint32_t n = 0; begun && n < t->node_count; n++)
                if (tree_is_leaf(t->nodes + n))
                    check_block(q, space_kernels_at(space_kernels_at(1) ? draw % 2 : 0),
                                space_block(t, t->nodes[n].child), &sure);
        }
        assert_true(sure > 0 || kinds[i].count == 1 || !t->packed.wide || kinds[i].scale < 0x1p-100 ||
                    kinds[i].shift != 0);
        froe_query_free(q);
        froe_tree_free(t);
    }
}

/* Small triangles in a leaf whose units are 1, at quarters of units: whatever is tested is off by a unit or so. They
 * are in the middle of the units that there are, from 0 to 65535, or at either end. */
static const double places_of_units[] = {20000, 0, 65525};
enum { PLACES = sizeof places_of_units / sizeof *places_of_units };

static froe_tree *tree_of_units(uint64_t seed) {
    froe_scene *scene;
    froe_tree *tree;
    froe_build_options o = froe_build_defaults();
    const double frame[9] = {0, 0, 0, 65535, 65535, 65535, 65535, 0, 0};
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_POLYGON, 1, frame, NULL, NULL), FROE_OK);
    for (uint64_t i = 0; i < 20; i++) {
        double c[9];
        for (uint64_t j = 0; j < 9; j++)
            c[j] = places_of_units[seed % PLACES] + 0.25 * trees_random(seed, 9 * i + j, 41);
        if (i % 4 == 0) c[5] = c[2], c[8] = c[2];
        if (i % 4 == 1) c[3] = c[0], c[4] = c[1];
        assert_int_equal(trees_add(scene, FROE_POLYGON, 1, c, NULL, NULL), FROE_OK);
    }
    o.method = "index", o.leaf = 64;
    assert_int_equal(froe_build(scene, &o, &tree, NULL), FROE_OK);
    froe_scene_free(scene);
    return tree;
}

static void check_units(froe_query *q, froe_query *reference, double place, uint64_t draw) {
    froe_range range = froe_range_defaults();
    froe_list found, wanted;
    double w[6], o[3], d[3];
    for (uint64_t k = 0; k < 3; k++) {
        w[k] = place + 0.125 * trees_random(41, 3 * draw + k, 80);
        if (place < 1) w[k] -= 4; /* some end before the first unit */
        w[3 + k] = w[k] + (trees_random(42, 3 * draw + k, 3) ? 0.125 * trees_random(43, 3 * draw + k, 40) : 0);
        o[k] = place + 0.25 * trees_random(44, 3 * draw + k, 40);
        d[k] = 0.25 * trees_random(45, 3 * draw + k, 40) - 5;
    }
    if (d[0] == 0 && d[1] == 0 && d[2] == 0) d[2] = 1;
    range.points = w;
    assert_int_equal(froe_query_range(reference, &range, &wanted, NULL), FROE_OK);
    assert_int_equal(froe_query_range(q, &range, &found, NULL), FROE_OK);
    qsort((void *)(uintptr_t)found.ids, found.count, sizeof *found.ids, ascending);
    qsort((void *)(uintptr_t)wanted.ids, wanted.count, sizeof *wanted.ids, ascending);
    assert_int_equal(found.count, wanted.count);
    if (found.count) assert_memory_equal(found.ids, wanted.ids, found.count * sizeof *found.ids);
    check_ray_until(q, reference, o, d, draw % 2 ? (double)INFINITY : 1, "units", draw);
}

static void what_is_a_unit_from_the_truth_is_decided_exactly(void **state) {
    (void)state;
    for (uint64_t seed = 0; seed < 9; seed++) {
        froe_tree *tree = tree_of_units(seed), *general = reference_of(tree);
        froe_query *q, *reference;
        assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
        assert_int_equal(froe_query_new(general, &reference, NULL), FROE_OK);
        for (uint64_t draw = 0; draw < 3000; draw++) {
            q->space->kernels = space_kernels_at(draw % 8 == 0 && space_kernels_at(1) ? 1 : 0);
            check_units(q, reference, places_of_units[seed % PLACES], 3000 * seed + draw);
        }
        froe_query_free(q);
        froe_query_free(reference);
        froe_tree_free(general);
        froe_tree_free(tree);
    }
}

/* Flat windows and lines are no exception. */
static void few_triangles_of_windows_are_left_to_exact_tests(void **state) {
    froe_tree *t = tree_of(kinds + KINDS - 1);
    froe_query *q;
    froe_list found;
    size_t met[2] = {0, 0};
    (void)state;
    assert_int_equal(froe_query_new(t, &q, NULL), FROE_OK);
    for (int line = 0; line < 2; line++) {
        for (uint64_t draw = 0; draw < 300; draw++) {
            froe_range range = froe_range_defaults();
            double w[6];
            for (int k = 0; k < 3; k++) {
                w[k] = w[3 + k] = trees_unit(31, 3 * draw + (uint64_t)k);
                if ((draw % 3 == (uint64_t)k) == line) w[k] = 0.1, w[3 + k] = 0.9;
            }
            range.points = w;
            assert_int_equal(froe_query_range(q, &range, &found, NULL), FROE_OK);
            met[line] += found.count;
        }
        const froe_query_stats stats = froe_query_statistics(q);
        if (!met[line] || stats.tests * 20 > met[line]) fail_msg("%zu met, %zu tests", met[line], (size_t)stats.tests);
    }
    froe_query_free(q);
    froe_tree_free(t);
}

/* Walls at x = 0, 50, 100, ..., each of two triangles; twice: each is there again, divided along the other diagonal. */
static froe_tree *tree_of_walls(bool twice) {
    static const double square[4][2] = {{0, 0}, {1000, 0}, {1000, 1000}, {0, 1000}};
    froe_scene *scene;
    froe_tree *tree;
    froe_build_options o = froe_build_defaults();
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    for (int wall = 0; wall < 12; wall++)
        for (int i = 0; i < (twice ? 4 : 2); i++) {
            double c[9];
            for (int j = 0; j < 3; j++) {
                const int corner = (i / 2 + (j ? i % 2 + j : 0)) % 4;
                c[3 * j] = 50 * wall, c[3 * j + 1] = square[corner][0], c[3 * j + 2] = square[corner][1];
            }
            assert_int_equal(trees_add(scene, FROE_POLYGON, 1, c, NULL, NULL), FROE_OK);
        }
    o.method = "index";
    assert_int_equal(froe_build(scene, &o, &tree, NULL), FROE_OK);
    froe_scene_free(scene);
    return tree;
}

/* From between two walls. */
static froe_query_stats ask_along_walls(const froe_tree *t, bool any, uint64_t count) {
    froe_query *q;
    assert_int_equal(froe_query_new(t, &q, NULL), FROE_OK);
    for (uint64_t draw = 0; draw < count; draw++) {
        const double at = 10 * trees_unit(41, 3 * draw);
        const double origin[3] = {50 * at, 400 + trees_unit(41, 3 * draw + 1), 300 + trees_unit(41, 3 * draw + 2)};
        const double direction[3] = {0.5, 1, 0.3 * trees_unit(42, draw)};
        const uint32_t ahead = (uint32_t)floor(at) + 1;
        froe_hit hit = {.object = FROE_NONE};
        uint32_t object = FROE_NONE;
        if (any)
            assert_int_equal(froe_query_ray_any(q, origin, direction, INFINITY, &object, NULL), FROE_OK);
        else
            assert_int_equal(froe_query_ray(q, origin, direction, INFINITY, &hit, NULL), FROE_OK);
        const uint32_t each = t->scene->object_count / 12;
        if (any)
            assert_true(object / each >= ahead && object / each < 12);
        else
            assert_int_equal(hit.object / each, ahead);
    }
    const froe_query_stats stats = froe_query_statistics(q);
    froe_query_free(q);
    return stats;
}

/* Seen from within, a wall reaches before and behind the origin; where the ray crosses its plane says which it is. */
static void walls_behind_a_ray_are_not_decided(void **state) {
    froe_tree *t = tree_of_walls(false);
    (void)state;
    for (int any = 0; any < 2; any++) {
        const uint64_t tests = ask_along_walls(t, any, 400).tests;
        if (tests > 20) fail_msg("%d tests", (int)tests);
    }
    froe_tree_free(t);
}

static void walls_in_one_plane_need_no_exact_numbers(void **state) {
    froe_tree *t = tree_of_walls(true);
    (void)state;
    const froe_query_stats stats = ask_along_walls(t, false, 400);
    assert_true(stats.tests >= 400);
    assert_int_equal(stats.exact, 0);
    froe_tree_free(t);
}

/* -------------------------------------------------------------------- blocks -- */

/* Every byte of a block changed in turn: refused, or found by the audit, or of no consequence for answers. */
static void damaged_blocks_are_noticed(void **state) {
    const kind_of_scene k = {"small", 12, 0, 6, 0.5, 1, 0, false};
    froe_tree *t = tree_of(&k);
    size_t bytes = (size_t)t->packed.block_count * PACKED_BLOCK, silent = 0;
    (void)state;
    for (size_t i = 0; i < bytes; i++) {
        const uint8_t was = t->packed.blocks[i];
        t->packed.blocks[i] = (uint8_t)(was ^ 0x20);
        if (!tree_validate(t, NULL) && !froe_tree_audit(t, NULL, NULL)) silent++;
        t->packed.blocks[i] = was;
    }
    assert_int_equal(froe_tree_audit(t, NULL, NULL), FROE_OK);
    if (silent * 8 > bytes) fail_msg("%zu of %zu bytes", silent, bytes); /* a wider box does no harm */
    froe_tree_free(t);
}

/* Of boxes and points searches believe the box told, so one larger than the object is a wrong one. */
static void boxes_larger_than_their_objects_are_found(void **state) {
    const kind_of_scene k = {"small", 30, 0, 6, 0.5, 1, 0, false};
    froe_tree *t = tree_of(&k);
    size_t changed = 0;
    froe_diagnostic why;
    (void)state;
    for (uint32_t n = 0; n < t->node_count; n++) {
        if (!tree_is_leaf(t->nodes + n)) continue;
        const space_header *h = space_block(t, t->nodes[n].child);
        for (uint32_t i = h->triangles; i < h->count; i++)
            for (int row = 0; row < 6 && space_ids(h)[i] & SPACE_EXACT; row++) {
                uint16_t *told = (uint16_t *)(uintptr_t)(space_row(h, row) + i), was = *told;
                const int by = row < 3 ? -2 : 2, end = h->box[row / 3][row % 3];
                if (row < 3 ? was + by < end : was + by > end) continue;
                *told = (uint16_t)(was + by);
                if (froe_tree_audit(t, NULL, &why) != FROE_E_AUDIT) fail_msg("node %u, row %d, not found", n, row);
                assert_non_null(strstr(why.message, "a box larger than the object"));
                *told = was;
                changed++;
            }
    }
    assert_true(changed > 10);
    froe_tree_free(t);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_kernel_gives_the_answers_of_general_trees),
        cmocka_unit_test(batches_answer_as_rays_alone),
        cmocka_unit_test(batches_refuse_bad_rays),
        cmocka_unit_test(every_allocation_of_a_query_may_fail),
        cmocka_unit_test(kernels_agree),
        cmocka_unit_test(kernels_are_sure_only_of_what_is_met),
        cmocka_unit_test(what_is_a_unit_from_the_truth_is_decided_exactly),
        cmocka_unit_test(few_triangles_of_windows_are_left_to_exact_tests),
        cmocka_unit_test(walls_behind_a_ray_are_not_decided),
        cmocka_unit_test(walls_in_one_plane_need_no_exact_numbers),
        cmocka_unit_test(damaged_blocks_are_noticed),
        cmocka_unit_test(boxes_larger_than_their_objects_are_found),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
