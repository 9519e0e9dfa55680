/* The laid-out tree leads every point to the leaf that its exact sides lead it to, one at a time and many together. */
#include "geom/predicates.h"
#include "query/point/descent.h"
#include "query/point/leaf.h"
#include "query/range/centroids.h"
#include "query/worlds.h"
#include "tree/list.h"

enum { POINTS = 3000 };

static size_t on_cuts, in_doubt, laid_out, deep;

/* ---------------------------------------------------------------- reference -- */

/* Cut by cut, in exact numbers. */
static uint32_t descend(const froe_tree *t, num_context *exact, const double *x, bool *on_cut) {
    uint32_t node = 0;
    *on_cut = false;
    while (!tree_is_leaf(t->nodes + node)) {
        const geom_plane h = tree_plane_at(t, node);
        const int side = geom_side_vertex(exact, &h, x);
        *on_cut |= side == 0;
        node = t->nodes[node].child + (side > 0);
    }
    return node;
}

/* Does a float of the path leave the side open? */
static bool is_in_doubt(const query_descent *d, const double *x) {
    descent_point p;
    if (!query_descent_begin(d, x, &p)) return false;
    while (!(p.next & DESCENT_LEAF)) {
        const float value = query_descent_value(d->cuts + p.next, p.at);
        if (!(fabsf(value) > DESCENT_DOUBT)) return true;
        p.next = query_descent_next(d->cuts + p.next, value > 0);
    }
    return false;
}

/* ------------------------------------------------------------------- points -- */

/* One of three is in the middle of a segment, or a unit in the last place from a corner of one. */
static void draw_point(const world *w, world_dice *d, double *x) {
    world_point(w, d, x);
    const froe_object o = froe_scene_object(w->scene, world_below(d, (uint32_t)w->count));
    if (o.corners < 2 || !world_below(d, 3)) return;
    const uint32_t i = world_below(d, (uint32_t)w->count), last = froe_scene_object(w->scene, i).corners - 1;
    const double *u = froe_scene_vertex(w->scene, froe_scene_corner(w->scene, i, 0));
    const double *v = froe_scene_vertex(w->scene, froe_scene_corner(w->scene, i, last));
    const bool near = world_below(d, 2);
    for (int k = 0; k < 2; k++)
        x[k] = near ? nextafter(u[k], world_below(d, 2) ? 1e300 : -1e300) : 0.5 * u[k] + 0.5 * v[k];
}

static void compare(const world *w, size_t t, const double *points, num_context *exact) {
    static query_leaf all[POINTS];
    const query_descent *d;
    assert_int_equal(query_leaf_find_all(w->queries[t], points, POINTS, all), FROE_OK);
    assert_int_equal(query_descent_of(w->queries[t], &d, NULL), FROE_OK);
    laid_out += d->there;
    deep += d->there && query_is_deep(w->trees[t]);
    for (size_t i = 0; i < POINTS; i++) {
        const double *x = points + 2 * i;
        query_leaf one;
        bool on_cut;
        const uint32_t node = descend(w->trees[t], exact, x, &on_cut);
        assert_int_equal(query_leaf_find(w->queries[t], x, &one), FROE_OK);
        assert_int_equal(one.place, all[i].place);
        assert_int_equal(one.on_cut, all[i].on_cut);
        assert_int_equal(one.empty, all[i].empty);
        if (tree_is_packed(w->trees[t])) continue;
        if (one.empty) assert_int_equal(tree_list(w->trees[t], one.place).count, 0);
        if (one.on_cut != on_cut || (!on_cut && one.place != node))
            fail_msg("%s, %s: %a %a in leaf %u, not %u", w->name, froe_tree_report(w->trees[t]).method, x[0], x[1],
                     one.place, node);
        on_cuts += on_cut;
        in_doubt += d->there && is_in_doubt(d, x);
    }
}

/* Batches of any number of threads say what single questions say. */
static void compare_batches(froe_query *q, const double *points) {
    for (unsigned threads = 1; threads <= 3; threads += 2) {
        froe_batch_options o = froe_batch_defaults();
        froe_answers all;
        froe_list one;
        o.threads = threads;
        assert_int_equal(froe_batch_locate(q, points, POINTS, &o, &all, NULL), FROE_OK);
        for (size_t i = 0; i < POINTS; i++) {
            assert_int_equal(froe_query_locate(q, points + 2 * i, &one, NULL), FROE_OK);
            assert_int_equal(all.starts[i + 1] - all.starts[i], one.count);
            if (one.count) assert_memory_equal(all.ids + all.starts[i], one.ids, one.count * sizeof *one.ids);
        }
        froe_answers_free(&all);
    }
}

static void check(const char *name, froe_scene *scene, bool lattice) {
    static double points[2 * POINTS];
    world w = world_begin(name, scene);
    num_context exact;
    w.lattice = lattice;
    assert_int_equal(num_context_new(NULL, &exact), FROE_OK);
    for (uint64_t i = 0; i < POINTS; i++) {
        world_dice d = {i, 0};
        draw_point(&w, &d, points + 2 * i);
    }
    for (size_t t = 0; t < w.tree_count; t++) {
        compare(&w, t, points, &exact);
        compare_batches(w.queries[t], points);
    }
    num_context_free(&exact);
    world_end(&w);
}

/* ------------------------------------------------------------------- scenes -- */

/* Short segments anywhere in a square. */
static froe_scene *square(double x, double y, double size) {
    froe_scene *scene;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    for (uint64_t i = 0; i < 200; i++) {
        const double u[2] = {trees_unit(1, 2 * i), trees_unit(1, 2 * i + 1)};
        const double c[4] = {x + size * u[0], y + size * u[1], x + size * (u[0] + 0.05 * trees_unit(2, i)),
                             y + size * (u[1] + 0.05 * trees_unit(3, i))};
        assert_int_equal(trees_add(scene, FROE_SEGMENT, 1, c, NULL, NULL), FROE_OK);
    }
    return scene;
}

static void points_come_to_their_leaves(void **state) {
    (void)state;
    check("square", square(0, 0, 1), false);
    check("far away", square(1e9, -3e7, 1), false);
    check("tiny", square(0, 0, 0x1p-700), false);
    check("huge", square(-0x1p1000, 0, 0x1p1000), false);
    check("lattice", world_mixture(2, 1 << FROE_SEGMENT, 150, 12, 0.4, 2), true);
    check("nested", world_generate("nested", 300), false);
    check("mixture", world_mixture(2, 1 << FROE_POINT | 1 << FROE_SEGMENT | 1 << FROE_BOX, 60, 0, 0.3, 4), false);
    check("floor plan", world_read("freedoom-e1m1.geojson"), false);
    assert_true(laid_out > 50 && on_cuts > 1000 && in_doubt > on_cuts && deep > 0);
}

/* A row has an extent of 0 on one axis, a point on both. */
static void flat_scenes_have_leaves(void **state) {
    froe_scene *row, *point;
    (void)state;
    assert_int_equal(froe_scene_new(2, NULL, &row), FROE_OK);
    assert_int_equal(froe_scene_new(2, NULL, &point), FROE_OK);
    for (uint32_t i = 0; i < 100; i++) {
        const double c[4] = {i, 3, i + 0.5, 3};
        assert_int_equal(trees_add(row, FROE_SEGMENT, 1, c, NULL, NULL), FROE_OK);
    }
    assert_int_equal(trees_add(point, FROE_POINT, 1, (const double[]){1, 2}, NULL, NULL), FROE_OK);
    check("row", row, false);
    check("point", point, false);
}

/* Cuts that floats cannot hold: some far beyond the scene, and sums of which the later, finer planes are not small:
 * they move the first one, or turn it. Between them is one that floats can hold. */
static void cuts_that_floats_cannot_hold_are_passed_exactly(void **state) {
    static const tree_meta meta = {.method = "by hand", .leaf = 300};
    static const double far[2] = {1, 0.5}, plain[2] = {0.5, 1};
    static const double moved[6] = {1, -1, 0, 0, 0, 0x1p48}, turned[6] = {1, 1, 1, 0x1p52, 0, 0};
    static const froe_cut cuts[] = {{.kind = FROE_CUT_AXIS, .value = 3},
                                    {.kind = FROE_CUT_AXIS, .value = -0x1p600},
                                    {.kind = FROE_CUT_PLANE, .value = 0x1p11, .normal = far},
                                    {.kind = FROE_CUT_PLANE, .value = -1e300, .normal = far},
                                    {.kind = FROE_CUT_PLANE, .value = 5, .normal = far},
                                    {.kind = FROE_CUT_FINE, .id = {2}, .normal = moved},
                                    {.kind = FROE_CUT_PLANE, .value = 0.75, .normal = plain},
                                    {.kind = FROE_CUT_FINE, .id = {2}, .normal = turned}};
    static double points[2 * POINTS];
    (void)state;
    world w = {.name = "by hand", .dim = 2, .scene = square(0, 0, 1), .tree_count = 1};
    tree_draft draft;
    froe_tree *tree;
    froe_query *q;
    num_context exact;
    const query_descent *d;
    uint32_t node = 0, child, known = 0;
    assert_int_equal(draft_new(NULL, 2, 0, &draft), FROE_OK);
    for (size_t i = 0; i < sizeof cuts / sizeof *cuts; i++, node = child + i % 2) /* below, above, below */
        assert_int_equal(draft_split(&draft, node, cuts + i, 0, &child), FROE_OK);
    assert_int_equal(draft_seal(&draft, NULL, 0, w.scene, &meta, &tree), FROE_OK);
    draft_free(&draft);
    assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
    assert_int_equal(num_context_new(NULL, &exact), FROE_OK);
    for (uint64_t i = 0; i < POINTS; i++) { /* some a little beside the lines */
        double *x = points + 2 * i;
        x[0] = trees_unit(6, 2 * i), x[1] = trees_unit(6, 2 * i + 1);
        if (i % 3 == 1) x[1] = x[0] - 0x1p-5 + (trees_unit(7, i) - 0.5) * 0x1p-40;
        if (i % 3 == 2) x[1] = 1 - 1.5 * x[0] + (trees_unit(7, i) - 0.5) * 0x1p-40;
    }
    w.trees = &tree, w.queries = &q;
    compare(&w, 0, points, &exact);
    assert_int_equal(query_descent_of(q, &d, NULL), FROE_OK);
    for (uint32_t i = 0; i < d->cut_count; i++) known += !isnan(d->cuts[i].c);
    assert_int_equal(known, 1);
    num_context_free(&exact);
    froe_query_free(q), froe_tree_free(tree), froe_scene_free(w.scene);
}

static froe_status find(void *user, const froe_allocator *alloc) {
    froe_scene *scene = NULL;
    froe_tree *tree = NULL;
    froe_query *q = NULL;
    query_leaf leaf;
    froe_build_options o = froe_build_defaults();
    const double x[2] = {0.5, 0.5};
    (void)user;
    o.method = "cylindrical";
    o.threads = 1;
    froe_status status = froe_scene_new(2, alloc, &scene);
    if (!status) status = trees_scatter(scene, FROE_SEGMENT, 9, 0, 0.3, 1);
    if (!status) status = froe_build(scene, &o, &tree, NULL);
    if (!status) status = froe_query_new(tree, &q, NULL);
    if (!status) status = query_leaf_find(q, x, &leaf);
    froe_query_free(q);
    froe_tree_free(tree);
    froe_scene_free(scene);
    return status;
}

static void leaves_survive_every_failing_allocation(void **state) {
    (void)state;
    assert_true(test_memory_each(find, NULL) > 10);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_come_to_their_leaves),
        cmocka_unit_test(flat_scenes_have_leaves),
        cmocka_unit_test(cuts_that_floats_cannot_hold_are_passed_exactly),
        cmocka_unit_test(leaves_survive_every_failing_allocation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
