/* test_audit_rare.c: cells that the audit seldom has to ask about: empty ones, those of higher dimensions, those whose
 * numbers overflow; solids with many corners; root boxes and cuts that packed trees cannot have; and no memory. */
#include "audits.h"
#include "geom/selftest.h"
#include "tree/audit/aspect.h"
#include "tree/audit/inseparable.h"
#include "tree/packed/packed_audit.h"
#include "tree/packed/space.h"
#include <float.h>
#include <froe/query.h>
#include <math.h>

/* A triangle below the line x + y = sum in the first two coordinates, as a hull in a scene of that dimension. Cuts go
 * across the axes, at 1 and at `second`; the last cell is beyond both, or beyond none if the second is on one axis. */
static froe_tree *hull_beside(int dim, double scale, double sum, int axis, double second, bool listed) {
    double corners[3 * FROE_MAX_DIM] = {0}, *a = corners, *b = a + dim, *c = b + dim;
    const size_t starts[2] = {0, 3};
    a[0] = a[1] = b[1] = c[0] = -4 * scale, b[0] = c[1] = (sum + 4) * scale;
    const froe_cut cuts[2] = {{.kind = FROE_CUT_AXIS, .axis = 0, .value = scale},
                              {.kind = FROE_CUT_AXIS, .axis = axis, .value = second * scale}};
    const uint32_t splits[2] = {0, 2}; /* leaves: 1: left; 3, 4: right, on both sides of the second cut */
    const entry beyond[3] = {{1, 0, 0, {0}}, {3, 0, 0, {0}}, {4, 0, 0, {0}}};
    const entry empty[3] = {{1, 0, 0, {0}}, {4, 0, 0, {0}}, {3, 0, 0, {0}}};
    froe_scene *scene;
    assert_int_equal(froe_scene_new(dim, NULL, &scene), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_HULL, 1, corners, NULL, starts), FROE_OK);
    froe_tree *tree = hand_made(scene, cuts, splits, 2, axis ? beyond : empty, listed ? 3 : 2, &by_hand);
    froe_scene_free(scene);
    return tree;
}

static void assert_must(froe_tree *with, froe_tree *without, bool must) {
    assert_right(with); /* a superset is allowed: no single cut excludes the cell */
    if (must)
        assert_wrong(without, "no piece where the object is");
    else
        assert_right(without);
    froe_tree_free(with), froe_tree_free(without);
}

static void hulls_of_dimension_4_must_be_listed_where_they_reach(void **state) {
    static const double sums[] = {1.5, 2, 2 + 0x1p-40, 3};
    (void)state;
    for (int dim = 4; dim <= FROE_MAX_DIM; dim++)
        for (int i = 0; i < 4; i++)
            assert_must(hull_beside(dim, 1, sums[i], 1, 1, true), hull_beside(dim, 1, sums[i], 1, 1, false), i >= 2);
}

/* A ball around 0 beyond two cuts, whose corner is 5 from there, and a point far off on the other side. */
static froe_tree *balls_beside(int dim, double radius, bool listed) {
    static const double centre[3] = {0}, far[3] = {-100, -100, 0};
    const froe_cut cuts[2] = {{.kind = FROE_CUT_AXIS, .axis = 0, .value = 3},
                              {.kind = FROE_CUT_AXIS, .axis = 1, .value = 4}};
    const uint32_t splits[2] = {0, 2};
    const entry entries[4] = {{1, 0, 0, {0}}, {1, 1, 0, {0}}, {3, 1, 0, {0}}, {4, 1, 0, {0}}};
    froe_scene *scene;
    assert_int_equal(froe_scene_new(dim, NULL, &scene), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_POINT, 1, far, NULL, NULL), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_BALL, 1, centre, &radius, NULL), FROE_OK);
    froe_tree *tree = hand_made(scene, cuts, splits, 2, entries, listed ? 4 : 3, &by_hand);
    froe_scene_free(scene);
    return tree;
}

static void balls_must_be_listed_where_they_reach(void **state) {
    static const double radii[] = {4.5, 5, 0x1.4000000000001p2, 6};
    (void)state;
    for (int dim = 2; dim <= 3; dim++)
        for (int i = 0; i < 4; i++)
            assert_must(balls_beside(dim, radii[i], true), balls_beside(dim, radii[i], false), i >= 2);
}

/* Beyond x = 1, what is below x = -1 is nothing; nothing has to be listed there. */
static void nothing_must_be_listed_in_empty_cells(void **state) {
    (void)state;
    for (int dim = 2; dim <= 5; dim++)
        assert_must(hull_beside(dim, 1, 3, 0, -1, true), hull_beside(dim, 1, 3, 0, -1, false), false);
}

/* A ball around 0 in the wedge beyond two lines through (1, 0): where the products of coordinates overflow, nothing is
 * certain, and nothing must be listed. */
static void nothing_must_be_listed_where_numbers_overflow(void **state) {
    static const int powers[] = {0, 200, 700};
    (void)state;
    for (int i = 0; i < 3; i++) {
        const double u = ldexp(1, powers[i]), centre[2] = {0}, radius = 2 * u;
        const double legs[8] = {u, 0, 5 * u, u, 5 * u, -u, 9 * u, -2 * u};
        const froe_cut cuts[2] = {{.kind = FROE_CUT_OBJECT, .id = {0}}, {.kind = FROE_CUT_OBJECT, .id = {1}}};
        const uint32_t splits[2] = {0, 1};
        const entry all[5] = {{0, 0, 0, {0}}, {1, 1, 0, {0}}, {3, 2, 0, {0}}, {4, 2, 0, {0}}, {2, 2, 0, {0}}};
        const entry without[4] = {all[0], all[1], all[2], all[4]};
        froe_scene *scene;
        assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
        assert_int_equal(trees_add(scene, FROE_SEGMENT, 2, legs, NULL, NULL), FROE_OK);
        assert_int_equal(trees_add(scene, FROE_BALL, 1, centre, &radius, NULL), FROE_OK);
        froe_tree *listed = hand_made(scene, cuts, splits, 2, all, 5, &by_hand);
        assert_must(listed, hand_made(scene, cuts, splits, 2, without, 4, &by_hand), powers[i] < 600);
        froe_scene_free(scene);
    }
}

static froe_status audit_with(void *user, const froe_allocator *alloc) {
    froe_tree *tree = user;
    const froe_allocator own = tree->alloc;
    tree->alloc = *alloc;
    const froe_status status = froe_tree_audit(tree, NULL, NULL);
    tree->alloc = own;
    return status;
}

static void audits_of_cells_may_lack_memory(void **state) {
    (void)state;
    for (int dim = 2; dim <= 4; dim++) {
        froe_tree *tree = hull_beside(dim, 1, 1.5, 1, 1, false);
        assert_true(test_memory_each(audit_with, tree) > 5);
        froe_tree_free(tree);
    }
}

/* ------------------------------------------------------------------ overfull leaves -- */

enum { ROUND = 40 };

/* Hulls of many points on spheres of radius 1, all boxes of which meet, in one leaf. */
static froe_tree *round_hulls(const double centres[][3], size_t count) {
    static double corners[4 * ROUND * 3];
    size_t starts[5] = {0};
    froe_scene *scene;
    for (size_t h = 0; h < count; h++) {
        starts[h + 1] = (h + 1) * ROUND;
        for (int i = 0; i < ROUND; i++) {
            const double z = (2 * i + 1.0) / ROUND - 1, r = sqrt(1 - z * z), turn = 2.399963 * i;
            double *x = corners + 3 * (h * ROUND + (size_t)i);
            x[0] = centres[h][0] + r * cos(turn), x[1] = centres[h][1] + r * sin(turn), x[2] = centres[h][2] + z;
        }
    }
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_HULL, count, corners, NULL, starts), FROE_OK);
    froe_tree *tree = trees_build(scene, "density", 9);
    froe_scene_free(scene);
    return tree;
}

typedef struct refuting {
    const froe_tree *tree;
    const char *expected; /* the finding; NULL: none */
} refuting;

static froe_status refute(void *user, const froe_allocator *alloc) {
    const refuting *r = user;
    froe_tree tree = *r->tree;
    const tree_objects list = tree_own_list(&tree, 0);
    const char *why = NULL;
    num_context context;
    base_task task;
    tree.alloc = *alloc;
    base_task_init(&task, 1, NULL, NULL);
    assert_int_equal(geom_context_new(NULL, &context), FROE_OK);
    const froe_status status = inseparable_refuted(&context, &task, &tree, &list, &why);
    num_context_free(&context);
    if (!status && r->expected) assert_string_equal(why, r->expected);
    if (!status && !r->expected) assert_null(why);
    return status;
}

/* The only pair that can be separated is the first, the first of the last object, or the last. */
static void separable_hulls_are_found_wherever_they_are_listed(void **state) {
    static const double orders[3][4][3] = {
        {{0, 0, 0}, {1.2, 1.2, 1.2}, {0.6, 0.6, 0.6}, {0.5, 0.6, 0.7}},
        {{0, 0, 0}, {0.6, 0.6, 0.6}, {0.5, 0.6, 0.7}, {1.2, 1.2, 1.2}},
        {{0.6, 0.6, 0.6}, {0.5, 0.6, 0.7}, {0, 0, 0}, {1.2, 1.2, 1.2}},
    };
    (void)state;
    for (int i = 0; i < 3; i++) {
        froe_tree *tree = round_hulls(orders[i], 4);
        assert_int_equal(tree_own_list(tree, 0).count, 4);
        refuting r = {tree, "a plane separates two of its objects"};
        assert_true(test_memory_each(refute, &r) > 2);
        froe_tree_free(tree);
    }
}

/* The third hull has more corners than both before it, so that comparing it with the first takes memory. */
static void memory_may_end_at_any_pair_of_hulls(void **state) {
    enum { FEW = 4, MORE = 60 };
    static const double simplex[FEW * 3] = {-1, -1, -1, 1, -1, -1, 0, 1, -1, 0, 0, 1};
    double corners[(2 * FEW + MORE) * 3];
    const size_t starts[4] = {0, FEW, 2 * FEW, 2 * FEW + MORE};
    froe_scene *scene;
    (void)state;
    for (size_t i = 0; i < 2 * FEW * 3; i++) corners[i] = simplex[i % (FEW * 3)] + (i < FEW * 3 ? 0 : 0.125);
    for (int i = 0; i < MORE; i++) {
        const double z = (2 * i + 1.0) / MORE - 1, r = sqrt(1 - z * z), turn = 2.399963 * i;
        double *x = corners + 3 * (2 * FEW + (size_t)i);
        x[0] = r * cos(turn), x[1] = r * sin(turn), x[2] = z;
    }
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_HULL, 3, corners, NULL, starts), FROE_OK);
    froe_tree *tree = trees_build(scene, "density", 9);
    assert_int_equal(tree_own_list(tree, 0).count, 3);
    refuting r = {tree, NULL};
    assert_true(test_memory_each(refute, &r) > 3);
    froe_tree_free(tree);
    froe_scene_free(scene);
}

/* ------------------------------------------------------------------------- guards -- */

/* x - y, and y and z alone, are bounded by a guard; x + y, 2 x and x - y + z are no differences. */
static void guards_cut_by_other_sums_bound_nothing(void **state) {
    static const struct {
        double normal[3], value;
        bool bounds;
    } cases[] = {{{1, -1, 0}, 0.25, true}, {{0, 1, 0}, 0.25, true},  {{0, 0, -1}, -0.25, true},
                 {{1, 1, 0}, 0.25, false}, {{2, 0, 0}, 0.25, false}, {{1, -1, 1}, 0.25, false}};
    static const double box[] = {0, 0, 0, 1, 1, 1};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const froe_cut cut = {.kind = FROE_CUT_PLANE, .normal = cases[i].normal, .value = cases[i].value};
        const uint32_t split = 0;
        const entry entries[2] = {{1, 0, 0, {0}}, {2, 0, 0, {0}}};
        tree_meta meta = by_hand;
        froe_scene *scene;
        double aspect = 0;
        for (int k = 0; k < 3; k++) meta.root_hi[k] = 1;
        assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
        assert_int_equal(trees_add(scene, FROE_BOX, 1, box, NULL, NULL), FROE_OK);
        froe_tree *tree = hand_made(scene, &cut, &split, 1, entries, 2, &meta);
        tree->nodes[0].flags |= TREE_GUARD;
        assert_int_equal(tree_aspect(tree, &aspect), FROE_OK);
        assert_int_equal(isinf(aspect) != 0, !cases[i].bounds);
        froe_tree_free(tree);
        froe_scene_free(scene);
    }
}

/* ------------------------------------------------------------------- packed trees -- */

/* In the plane the root box holds the scene, in space it is the scene's, and unused axes have 0. */
static void root_boxes_have_to_fit_the_scene(void **state) {
    (void)state;
    for (int dim = 2; dim <= 3; dim++) {
        froe_tree *tree = trees_grow(dim, dim == 2 ? FROE_SEGMENT : FROE_POLYGON, 20, 0, 0.4, "index", 6);
        const tree_meta right = tree->meta;
        uint32_t node;
        const char *why;
        assert_right(tree);
        for (int k = 0; k < 5; k++)
            for (int upper = 0; upper < 2; upper++)
                for (int way = -1; way <= 1; way += 2) {
                    tree->meta = right;
                    (upper ? tree->meta.root_hi : tree->meta.root_lo)[k] += 0.125 * way;
                    assert_int_equal(packed_frame_refuted(tree, &node, &why), FROE_OK);
                    const bool fits = dim == 2 && k < 2 && (way > 0) == upper;
                    assert_int_equal(!why, fits);
                    if (why) assert_string_equal(why, "a root box that does not fit the scene");
                }
        tree->meta = right;
        froe_tree_free(tree);
    }
}

static void cuts_of_packed_trees_are_axis_parallel(void **state) {
    (void)state;
    for (int dim = 2; dim <= 3; dim++) {
        froe_tree *tree = trees_grow(dim, dim == 2 ? FROE_SEGMENT : FROE_POLYGON, 40, 0, 0.4, "index", 6);
        froe_tree wrong = *tree;
        uint32_t node;
        const char *why;
        const uint8_t type = tree->nodes[0].type;
        assert_int_equal(type, TREE_PLAIN);
        tree->nodes[0].type = TREE_TABLED;
        assert_int_equal(packed_frame_refuted(&wrong, &node, &why), FROE_OK);
        assert_string_equal(why, "a cut of a kind that packed trees do not have");
        tree->nodes[0].type = type;
        froe_tree_free(tree);
    }
}

/* A corner of the scene that is moved into a cut of the tree: the audit reads the scene anew. */
static void corners_in_cuts_of_packed_trees_are_found(void **state) {
    (void)state;
    froe_tree *tree = trees_grow(2, FROE_SEGMENT, 60, 0, 0.1, "index", 6);
    const tree_node *root = tree->nodes;
    double *nearest = NULL;
    for (uint32_t v = 0; v < tree->scene->vertex_count; v++) {
        double *x = (double *)(uintptr_t)scene_vertex(tree->scene, v) + root->axis;
        if (!nearest || fabs(*x - root->u.value) < fabs(*nearest - root->u.value)) nearest = x;
    }
    const double right = *nearest;
    assert_right(tree);
    *nearest = root->u.value;
    froe_diagnostic why = {0};
    assert_int_equal(audit(tree, &why), FROE_E_AUDIT);
    *nearest = right;
    assert_right(tree);
    froe_tree_free(tree);
}

static void assert_invalid(froe_tree *tree, const char *what) {
    froe_diagnostic why = {0};
    assert_int_equal(packed_validate(tree, &why), FROE_E_FORMAT);
    if (!strstr(why.message, what)) fail_msg("%s instead of %s", why.message, what);
}

static void blocks_that_a_packed_tree_cannot_have_are_found(void **state) {
    (void)state;
    for (int dim = 2; dim <= 3; dim++) {
        froe_tree *tree = trees_grow(dim, dim == 2 ? FROE_SEGMENT : FROE_POLYGON, 20, 0, 0.4, "index", 6);
        assert_int_equal(packed_validate(tree, NULL), FROE_OK);
        for (int wrong = 0; wrong < 5; wrong++) {
            froe_tree copy = *tree;
            if (wrong < 2) copy.meta.root_lo[wrong] = copy.meta.root_hi[wrong] + 1;
            if (wrong == 2) copy.cut_count = 1;
            if (wrong == 3) copy.packed.block_count = 0;
            if (wrong == 4) copy.packed.block_count = 1;
            assert_invalid(&copy, wrong < 3 ? "blocks that such a tree cannot have" : "a block out of place");
        }
        froe_tree_free(tree);
    }
}

/* Headers of blocks of space: units only where there are objects, of a scale that doubles hold; else zeros. */
static void headers_of_blocks_of_space_are_checked(void **state) {
    (void)state;
    froe_tree *full = trees_grow(3, FROE_POLYGON, 4, 0, 0.4, "index", 6);
    froe_tree *none = trees_grow(3, FROE_POLYGON, 0, 0, 0.4, "index", 6);
    for (int wrong = 0; wrong < 10; wrong++) {
        froe_tree *tree = wrong < 6 ? full : none;
        space_header *h = (space_header *)(void *)tree->packed.blocks;
        const space_header right = *h;
        if (wrong == 0) h->scale = INFINITY;
        if (wrong == 1) h->scale = 0x1p621;
        if (wrong == 2) h->scale = 0x1p-401;
        if (wrong == 3) h->scale *= 0.75;
        if (wrong == 4) h->scale = 0;
        if (wrong == 5) h->lo[1] = NAN;
        if (wrong == 6) h->scale = 1;
        if (wrong == 7) h->lo[2] = 1;
        if (wrong == 8) h->box[1][0] = 1;
        if (wrong == 9) h->unused[11] = 1;
        assert_invalid(tree, "a block whose header does not fit");
        *h = right;
        assert_int_equal(packed_validate(tree, NULL), FROE_OK);
    }
    froe_tree_free(full), froe_tree_free(none);
}

/* Units of bounds are believed by searches: boxes within that of their leaf, which starts where doubles go on. */
static void boxes_of_space_are_audited(void **state) {
    static const char *const what[] = {"a box outside the box of its leaf", "a box outside the box of its leaf",
                                       "a box that the object leaves", "a box that the object leaves"};
    (void)state;
    froe_tree *tree = trees_grow(3, FROE_SEGMENT, 4, 0, 0.4, "index", 6);
    space_header *h = (space_header *)(void *)tree->packed.blocks;
    assert_int_equal(audit(tree, NULL), FROE_OK);
    assert_true(h->count == 4 && h->triangles == 0 && h->scale > 0);
    for (int wrong = 0; wrong < 4; wrong++) {
        const space_header right = *h;
        froe_diagnostic why = {0};
        if (wrong == 0) h->box[0][1]++;
        if (wrong == 1) h->box[1][2]--;
        if (wrong == 2) h->lo[0] = DBL_MAX; /* no double is beyond the box */
        if (wrong == 3) h->lo[2] = -DBL_MAX;
        assert_int_equal(audit(tree, &why), FROE_E_AUDIT);
        if (!strstr(why.message, what[wrong])) fail_msg("%s", why.message);
        *h = right;
    }
    assert_int_equal(audit(tree, NULL), FROE_OK);
    froe_tree_free(tree);
}

/* The largest unit is that of the upper bound of a scene whose size is as many. */
static void units_reach_the_upper_bound(void **state) {
    static const double coords[] = {0, 0, 0, 65535, 1, 2, 3, 65535, 65535, 5, 5, 5, 65535, 6, 65535, 65535, 65535, 4};
    (void)state;
    for (int box = 0; box < 2; box++) {
        const double far[3] = {65535, 65535, box ? 65535 : 4}, window[6] = {far[0], far[1], far[2], 1e5, 1e5, 1e5};
        const double corners[6] = {1, 2, 3, 65535, 65535, 65535};
        const size_t starts[3] = {0, 3, 6};
        froe_scene *scene;
        froe_query *q;
        froe_list found;
        froe_range r = froe_range_defaults();
        assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
        assert_int_equal(trees_add(scene, FROE_POLYGON, 2, coords, NULL, starts), FROE_OK);
        if (box) assert_int_equal(trees_add(scene, FROE_BOX, 1, corners, NULL, NULL), FROE_OK);
        froe_tree *tree = trees_build(scene, "index", 6);
        assert_int_equal(((const space_header *)(const void *)tree->packed.blocks)->box[1][0], 65535);
        assert_int_equal(audit(tree, NULL), FROE_OK);
        assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
        r.points = window;
        assert_int_equal(froe_query_range(q, &r, &found, NULL), FROE_OK);
        assert_int_equal(found.count, 1);
        assert_int_equal(found.ids[0], box ? 2 : 1);
        froe_query_free(q), froe_tree_free(tree), froe_scene_free(scene);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hulls_of_dimension_4_must_be_listed_where_they_reach),
        cmocka_unit_test(balls_must_be_listed_where_they_reach),
        cmocka_unit_test(nothing_must_be_listed_in_empty_cells),
        cmocka_unit_test(nothing_must_be_listed_where_numbers_overflow),
        cmocka_unit_test(audits_of_cells_may_lack_memory),
        cmocka_unit_test(separable_hulls_are_found_wherever_they_are_listed),
        cmocka_unit_test(memory_may_end_at_any_pair_of_hulls),
        cmocka_unit_test(guards_cut_by_other_sums_bound_nothing),
        cmocka_unit_test(root_boxes_have_to_fit_the_scene),
        cmocka_unit_test(cuts_of_packed_trees_are_axis_parallel),
        cmocka_unit_test(corners_in_cuts_of_packed_trees_are_found),
        cmocka_unit_test(blocks_that_a_packed_tree_cannot_have_are_found),
        cmocka_unit_test(headers_of_blocks_of_space_are_checked),
        cmocka_unit_test(boxes_of_space_are_audited),
        cmocka_unit_test(units_reach_the_upper_bound),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
