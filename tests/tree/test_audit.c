/* test_audit.c: right trees pass, and every invariant, violated once, is found. */
#include "audits.h"
#include "tree/list.h"
#include <math.h>
#include <stdio.h>

/* --------------------------------------------------------------- right trees -- */

typedef struct variety {
    int dim;
    froe_kind kind;
    uint32_t grid;
    double size;
} variety;

static const variety varieties[] = {
    {2, FROE_SEGMENT, 0, 0.3}, {2, FROE_SEGMENT, 4, 0.8}, {3, FROE_POLYGON, 0, 0.3}, {3, FROE_POLYGON, 4, 0.8},
    {3, FROE_SEGMENT, 5, 0.5}, {2, FROE_POINT, 5, 0},     {5, FROE_POINT, 2, 0},     {2, FROE_BOX, 5, 0.5},
    {3, FROE_BOX, 5, 0.5},     {6, FROE_BOX, 3, 0.5},     {2, FROE_BALL, 0, 0.5},    {3, FROE_BALL, 5, 0.9},
    {4, FROE_BALL, 0, 0.5},    {2, FROE_HULL, 0, 0.3},    {3, FROE_HULL, 4, 0.8},
};

static void built_trees_pass(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof varieties / sizeof *varieties; i++)
        for (uint32_t leaf = 1; leaf <= 4; leaf += 3) {
            const variety *v = varieties + i;
            froe_tree *tree = trees_grow(v->dim, v->kind, 120, v->grid, v->size, "density", leaf);
            assert_right(tree);
            froe_tree_free(tree);
        }
}

static void mixed_scenes_pass(void **state) {
    (void)state;
    for (int dim = 2; dim <= 3; dim++)
        for (uint32_t grid = 0; grid <= 4; grid += 4) {
            froe_scene *scene = trees_scene(dim, FROE_SEGMENT, 30, grid, 0.5, 1);
            for (int kind = FROE_POINT; kind <= FROE_HULL; kind++)
                if (kind != FROE_POLYGON || dim == 3)
                    assert_int_equal(trees_scatter(scene, (froe_kind)kind, 20, grid, 0.5, 7), FROE_OK);
            froe_tree *tree = trees_build(scene, "density", 3);
            assert_right(tree);
            froe_tree_free(tree);
            froe_scene_free(scene);
        }
}

static void all_stages_and_thread_counts_agree(void **state) {
    (void)state;
    froe_tree *tree = trees_grow(3, FROE_POLYGON, 600, 6, 0.4, "density", 1);
    for (unsigned threads = 1; threads <= 3; threads++)
        for (int exact = 0; exact < 2; exact++) {
            froe_audit_options o = froe_audit_defaults();
            o.threads = threads;
            o.exact_only = exact;
            assert_int_equal(froe_tree_audit(tree, &o, NULL), FROE_OK);
        }
    froe_tree_free(tree);
}

static void huge_and_tiny_coordinates_pass(void **state) {
    (void)state;
    const double scales[] = {1e300, 1e-300, 0x1p-1060};
    for (size_t i = 0; i < 3; i++) {
        froe_scene *scene;
        double coords[9];
        assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
        for (uint32_t j = 0; j < 40; j++) {
            for (uint32_t k = 0; k < 9; k++) coords[k] = scales[i] * (int)trees_random(j, k, 7);
            assert_int_equal(trees_add(scene, FROE_POLYGON, 1, coords, NULL, NULL), FROE_OK);
        }
        froe_tree *tree = trees_build(scene, "autopartition", 1);
        assert_right(tree);
        froe_tree_free(tree);
        froe_scene_free(scene);
    }
}

/* ------------------------------------------------------- structure, violated -- */

static uint32_t find_node(const froe_tree *t, unsigned type, uint32_t least) {
    for (uint32_t i = 0; i < t->node_count; i++)
        if (t->nodes[i].type == type && tree_list(t, i).count >= least) return i;
    fail_msg("no such node");
    return 0;
}

static uint32_t find_piece(const froe_tree *t, bool whole) {
    for (uint32_t i = 0; i < t->piece_count; i++)
        if (!t->pieces[i].ring == whole) return i;
    fail_msg("no such piece");
    return 0;
}

/* Guard stage above and refinement below, whole pieces and fragments, in leaves and in cuts. */
static froe_tree *sample(void) {
    return trees_grow(2, FROE_SEGMENT, 60, 5, 0.7, "density", 2);
}

static void broken_structure_is_found(void **state) {
    (void)state;
    froe_tree *t = sample();
    uint32_t leaf = find_node(t, TREE_LEAF, 1), tabled = find_node(t, TREE_TABLED, 1),
             plain = find_node(t, TREE_PLAIN, 0);
    uint32_t ring = t->pieces[find_piece(t, false)].ring;
    struct {
        void *field;
        size_t size;
        uint32_t value;
        const char *what;
    } const doctored[] = {
        {&t->nodes[0].child, 4, 3, "children out of place"},
        {&t->nodes[leaf].child, 4, 1, "cover that is no box"},
        {&t->nodes[leaf].child, 4, 5, "more covers than pieces"},
        {&t->nodes[tabled].u.covers, 4, UINT32_MAX, "more covers than pieces"},
        {&t->nodes[leaf].type, 1, 3, "unknown type"},
        {&t->nodes[leaf].flags, 1, 8, "unknown type or flag"},
        {&t->nodes[plain].flags, 1, TREE_INSEPARABLE, "unknown flag"},
        {&t->nodes[plain].flags, 1, TREE_CROWDED, "unknown flag"},
        {&t->nodes[plain].axis, 1, 2, "cut that does not exist"},
        {&t->nodes[leaf].u.list.first, 4, 77777, "list out of place"},
        {&t->nodes[leaf].u.list.count, 4, UINT32_MAX, "list out of place"},
        {&t->nodes[tabled].u.cut, 4, t->cut_count, "cut out of place"},
        {&t->cuts[t->nodes[tabled].u.cut].kind, 4, 0, "cut that does not exist"},
        {&t->cuts[t->nodes[tabled].u.cut].kind, 4, FROE_CUT_EDGE, "cut that does not exist"},
        {&t->cuts[t->nodes[tabled].u.cut].a, 4, 60, "cut that does not exist"},
        {&t->pieces[0].object, 4, 60, "object that does not exist"},
        {&t->pieces[find_piece(t, false)].ring, 4, t->bound_count, "ring out of place"},
        {&t->bounds[ring], 4, 3, "ring of wrong length"},
        {&t->bounds[ring + 1], 4, 1, "ring entry"},
        {&t->bounds[ring + 1], 4, TREE_EDGE_CUT | leaf, "ring entry"},
        {&t->bounds[ring + 1], 4, TREE_EDGE_CUT | (t->node_count - 1), "ring entry"},
        {&t->scene->form_of[0], 1, FROE_BALL, "wrong kind or form"},
        {&t->meta.leaf, 4, UINT32_MAX, "description"},
        {&t->meta.promise_count, 4, 13, "description"},
        {&t->piece_count, 4, t->piece_count + 1, "no node uses"},
    };
    for (size_t i = 0; i < sizeof doctored / sizeof *doctored; i++) {
        uint8_t old[4];
        memcpy(old, doctored[i].field, doctored[i].size);
        memcpy(doctored[i].field, &doctored[i].value, doctored[i].size);
        assert_wrong(t, doctored[i].what);
        memcpy(doctored[i].field, old, doctored[i].size);
    }
    assert_right(t);
    froe_tree_free(t);
}

static void a_wrong_report_is_found(void **state) {
    (void)state;
    froe_tree *t = sample();
    uint64_t *const counts[] = {&t->report.nodes,  &t->report.leaves, &t->report.fragments, &t->report.in_cut,
                                &t->report.height, &t->report.size,   &t->report.max_leaf,  &t->report.objects};
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        ++*counts[i];
        assert_wrong(t, "report");
        --*counts[i];
    }
    t->report.mean_depth += 1;
    assert_wrong(t, "report");
    froe_tree_free(t);
}

static void a_torn_charge_is_found(void **state) {
    (void)state;
    froe_tree *t = sample();
    uint32_t tabled = find_node(t, TREE_TABLED, 1);
    t->nodes[tabled].flags |= TREE_CHARGED;
    assert_wrong(t, "a charged node whose parent is not");
    froe_tree_free(t);
}

static void a_torn_guard_stage_is_found(void **state) {
    (void)state;
    froe_tree *t = sample();
    assert_true(t->nodes[0].flags & TREE_GUARD);
    uint32_t tabled = find_node(t, TREE_TABLED, 1);
    t->nodes[0].flags = 0;
    assert_wrong(t, "a node of the guard stage whose parent is not");
    t->nodes[0].flags = TREE_GUARD;
    for (uint32_t i = 0; i < t->node_count; i++)
        if (!tree_is_leaf(t->nodes + i)) t->nodes[i].flags = TREE_GUARD;
    assert_true(t->cuts[t->nodes[tabled].u.cut].kind != 0);
    froe_diagnostic why;
    assert_int_equal(audit(t, &why), FROE_E_AUDIT);
    assert_non_null(strstr(why.message, "depends on the objects"));
    froe_tree_free(t);
}

/* ----------------------------------------------------------- lists, violated -- */

/* Segments 0: across x = 1; 1: on x = 1; 2: touches x = 1 from the left; 3: a point-like one on the right. */
static froe_scene *four_segments(void) {
    static const double coords[16] = {0, 0, 2, 0, 1, 3, 1, 4, 0, 5, 1, 5, 3, 3, 3, 3};
    froe_scene *scene;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_SEGMENT, 4, coords, NULL, NULL), FROE_OK);
    return scene;
}

#define CUT(node) (TREE_EDGE_CUT | (node))
static const entry right_lists[] = {
    {0, 1, 0, {0}}, {1, 0, 2, {0, CUT(0)}}, {1, 2, 0, {0}}, {2, 0, 2, {CUT(0), 1}}, {2, 3, 0, {0}},
};
enum { RIGHT = sizeof right_lists / sizeof *right_lists };

static void check_lists(const entry *entries, size_t count, const char *what) {
    const froe_cut cut = {.kind = FROE_CUT_AXIS, .axis = 0, .value = 1};
    const uint32_t root = 0;
    froe_scene *scene = four_segments();
    froe_tree *tree = hand_made(scene, &cut, &root, 1, entries, count, &by_hand);
    if (what)
        assert_wrong(tree, what);
    else
        assert_right(tree);
    froe_tree_free(tree);
    froe_scene_free(scene);
}

static void every_missing_piece_is_found(void **state) {
    (void)state;
    check_lists(right_lists, RIGHT, NULL);
    for (size_t gone = 0; gone < RIGHT; gone++) {
        entry entries[RIGHT];
        size_t count = 0;
        for (size_t i = 0; i < RIGHT; i++)
            if (i != gone) entries[count++] = right_lists[i];
        check_lists(entries, count, "no piece where the object is");
    }
}

static void every_stray_piece_is_found(void **state) {
    (void)state;
    const entry strays[] = {
        {0, 0, 0, {0}},                 /* what crosses the cut does not lie in it */
        {0, 2, 0, {0}},                 /* nor what touches it */
        {1, 1, 0, {0}},                 /* what lies in the cut is on no side */
        {2, 1, 0, {0}}, {2, 2, 0, {0}}, /* touching is being on one side only */
        {1, 3, 0, {0}},                 /* elsewhere */
    };
    for (size_t s = 0; s < sizeof strays / sizeof *strays; s++) {
        entry entries[RIGHT + 1];
        size_t count = 0;
        for (size_t i = 0; i < RIGHT; i++) {
            entries[count++] = right_lists[i];
            if (right_lists[i].node == strays[s].node && (i + 1 == RIGHT || right_lists[i + 1].node != strays[s].node))
                entries[count++] = strays[s];
        }
        assert_int_equal(count, RIGHT + 1);
        check_lists(entries, count,
                    strays[s].node == 0 && strays[s].object == 0 ? "where the object is not" : "object");
    }
}

static void every_wrong_shape_is_found(void **state) {
    (void)state;
    entry entries[RIGHT];
    memcpy(entries, right_lists, sizeof entries);
    entries[1].count = 0; /* whole instead of its part */
    check_lists(entries, RIGHT, "wrong shape");
    memcpy(entries, right_lists, sizeof entries);
    entries[2] = (entry){1, 2, 2, {0, 1}}; /* a ring that is the whole */
    check_lists(entries, RIGHT, "wrong shape");
    memcpy(entries, right_lists, sizeof entries);
    entries[2] = (entry){1, 2, 2, {0, CUT(0)}}; /* the cut only touches */
    check_lists(entries, RIGHT, "wrong shape");
    memcpy(entries, right_lists, sizeof entries);
    entries[3] = entries[1], entries[3].node = 2; /* the other half */
    check_lists(entries, RIGHT, "wrong shape");
}

static void a_piece_listed_twice_is_found(void **state) {
    (void)state;
    entry entries[RIGHT + 1];
    memcpy(entries, right_lists, RIGHT * sizeof *entries);
    entries[RIGHT] = right_lists[RIGHT - 1];
    check_lists(entries, RIGHT + 1, "two pieces of the object");
}

static void the_lowest_object_is_told_whatever_the_threads(void **state) {
    (void)state;
    froe_tree *t = trees_grow(2, FROE_SEGMENT, 5000, 0, 0.02, "density", 2);
    uint32_t lowest = FROE_NONE, doctored = 0;
    for (uint32_t i = 0; i < t->piece_count; i++) {
        if (!t->pieces[i].ring || trees_random(3, i, 20)) continue;
        uint32_t *ring = t->bounds + t->pieces[i].ring + 1;
        if (ring[0] == 0 || !(ring[0] & TREE_EDGE_CUT) || ring[0] == CUT(0)) continue;
        ring[0] = CUT(0); /* the root is everybody's ancestor */
        if (t->pieces[i].object < lowest) lowest = t->pieces[i].object;
        doctored++;
    }
    assert_true(doctored > 20);
    for (unsigned threads = 1; threads <= 4; threads++) {
        froe_audit_options o = froe_audit_defaults();
        froe_diagnostic why;
        o.threads = threads;
        assert_int_equal(froe_tree_audit(t, &o, &why), FROE_E_AUDIT);
        assert_int_equal(why.object, lowest);
    }
    froe_tree_free(t);
}

/* Every piece of built trees, moved to another object, another ring or away: never unnoticed. */
static void no_doctored_piece_of_a_built_tree_passes(void **state) {
    (void)state;
    static const variety some[] = {
        {2, FROE_SEGMENT, 4, 0.8}, {3, FROE_POLYGON, 3, 0.9}, {2, FROE_BOX, 5, 0.5}, {3, FROE_POINT, 3, 0}};
    for (size_t k = 0; k < sizeof some / sizeof *some; k++) {
        froe_tree *t = trees_grow(some[k].dim, some[k].kind, 25, some[k].grid, some[k].size, "density", 2);
        for (uint32_t i = 0; i < t->piece_count; i++) {
            tree_piece old = t->pieces[i];
            for (uint32_t object = 0; object < 25; object++) {
                t->pieces[i].object = object;
                froe_status expected = object == old.object ? FROE_OK : FROE_E_AUDIT;
                assert_int_equal(audit(t, NULL), expected);
            }
            t->pieces[i] = old;
        }
        for (uint32_t i = 1; i < t->bound_count; i++) {
            uint32_t old = t->bounds[i];
            for (uint32_t node = 0; node < t->node_count; node += 3) {
                t->bounds[i] = CUT(node);
                if (t->bounds[i] != old) assert_int_equal(audit(t, NULL), FROE_E_AUDIT);
            }
            t->bounds[i] = old;
        }
        assert_right(t);
        froe_tree_free(t);
    }
}

/* A polygon's ring may begin at any corner. */
static void rings_may_begin_anywhere(void **state) {
    (void)state;
    froe_tree *t = trees_grow(3, FROE_POLYGON, 40, 0, 0.9, "density", 1);
    for (uint32_t i = 0; i < t->piece_count; i++) {
        uint32_t *ring = t->bounds + t->pieces[i].ring, first;
        if (!t->pieces[i].ring) continue;
        first = ring[1];
        memmove(ring + 1, ring + 2, (ring[0] - 1) * sizeof *ring);
        ring[ring[0]] = first;
    }
    assert_right(t);
    uint32_t *ring = t->bounds + t->pieces[find_piece(t, false)].ring, swap = ring[1];
    ring[1] = ring[2];
    ring[2] = swap;
    assert_wrong(t, "wrong shape");
    froe_tree_free(t);
}

/* -------------------------------------------------------------------- solids -- */

/* Disc of radius 1 at the corner cell beyond (1, 1) of its centre's cell, at distance sqrt(2) gap. */
static froe_tree *disc_beside_corner(double radius, bool listed, froe_kind kind) {
    const double disc[2] = {0, 0}, box[4] = {-2, -2, 2, 2};
    const froe_cut cuts[2] = {{.kind = FROE_CUT_AXIS, .axis = 0, .value = 1},
                              {.kind = FROE_CUT_AXIS, .axis = 1, .value = 1}};
    const uint32_t splits[2] = {0, 2}; /* leaves: 1: left; 3, 4: right, below and above */
    const entry entries[3] = {{1, 0, 0, {0}}, {3, 0, 0, {0}}, {4, 0, 0, {0}}};
    froe_scene *scene;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    assert_int_equal(
        trees_add(scene, kind, 1, kind == FROE_BALL ? disc : box, kind == FROE_BALL ? &radius : NULL, NULL), FROE_OK);
    froe_tree *tree = hand_made(scene, cuts, splits, 2, entries, listed ? 3 : 2, &by_hand);
    froe_scene_free(scene);
    return tree;
}

static void balls_must_be_listed_exactly_where_their_distance_says(void **state) {
    (void)state;
    const double near = sqrt(2); /* just more than the true root: 1.4142135623730951^2 > 2 */
    struct {
        double radius;
        bool must;
    } const cases[] = {{1.2, false}, {nextafter(near, 0), false}, {near, true}, {1.5, true}};
    for (size_t i = 0; i < 4; i++) {
        froe_tree *with = disc_beside_corner(cases[i].radius, true, FROE_BALL);
        froe_tree *without = disc_beside_corner(cases[i].radius, false, FROE_BALL);
        assert_right(with); /* a superset is allowed: no single cut excludes the corner cell */
        if (cases[i].must)
            assert_wrong(without, "no piece where the object is");
        else
            assert_right(without);
        froe_tree_free(with);
        froe_tree_free(without);
    }
    froe_tree *beyond = disc_beside_corner(1, true, FROE_BALL); /* touches both cuts from inside */
    assert_wrong(beyond, "where the object is not");
    froe_tree_free(beyond);
}

static void boxes_among_axis_parallel_cuts_are_exact(void **state) {
    (void)state;
    froe_tree *with = disc_beside_corner(0, true, FROE_BOX), *without = disc_beside_corner(0, false, FROE_BOX);
    assert_right(with);
    assert_wrong(without, "no piece where the object is");
    froe_tree_free(with);
    froe_tree_free(without);
}

/* A triangle below the line x + y = sum, as a hull, has no corner in the cell beyond (1, 1). */
static froe_tree *hull_beside_corner(double sum, bool listed) {
    const double corners[6] = {-4, -4, sum + 4, -4, -4, sum + 4};
    const size_t starts[2] = {0, 3};
    const froe_cut cuts[2] = {{.kind = FROE_CUT_AXIS, .axis = 0, .value = 1},
                              {.kind = FROE_CUT_AXIS, .axis = 1, .value = 1}};
    const uint32_t splits[2] = {0, 2};
    const entry entries[3] = {{1, 0, 0, {0}}, {3, 0, 0, {0}}, {4, 0, 0, {0}}};
    froe_scene *scene;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_HULL, 1, corners, NULL, starts), FROE_OK);
    froe_tree *tree = hand_made(scene, cuts, splits, 2, entries, listed ? 3 : 2, &by_hand);
    froe_scene_free(scene);
    return tree;
}

static void hulls_must_be_listed_in_cells_without_a_corner_of_theirs(void **state) {
    (void)state;
    const struct {
        double sum;
        bool must;
    } cases[] = {{1.5, false}, {2, false}, {2 + 0x1p-40, true}, {3, true}};
    for (size_t i = 0; i < 4; i++) {
        froe_tree *with = hull_beside_corner(cases[i].sum, true), *without = hull_beside_corner(cases[i].sum, false);
        assert_right(with);
        if (cases[i].must)
            assert_wrong(without, "no piece where the object is");
        else
            assert_right(without);
        froe_tree_free(with);
        froe_tree_free(without);
    }
}

/* A disc around (0, 0) in the cell where x > 1 and x + y > 2, which begins at (1, 1). A point gives x > 1 as a wall. */
static void balls_beside_oblique_planes_must_be_listed_where_they_reach(void **state) {
    (void)state;
    const double centre[2] = {0, 0}, point[2] = {1, -9}, diagonal[2] = {1, 1}, radii[] = {1.25, 1.4375, 3};
    const froe_cut upright[2] = {{.kind = FROE_CUT_AXIS, .axis = 0, .value = 1}, {.kind = FROE_CUT_VERTEX, .id = {0}}};
    const uint32_t splits[2] = {0, 2};
    const entry entries[4] = {{0, 0, 0, {0}}, {1, 1, 0, {0}}, {3, 1, 0, {0}}, {4, 1, 0, {0}}};
    for (size_t i = 0; i < 6; i++) {
        const froe_cut cuts[2] = {upright[i / 3], {.kind = FROE_CUT_PLANE, .normal = diagonal, .value = 2}};
        const bool must = i % 3;
        froe_scene *scene;
        assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
        assert_int_equal(trees_add(scene, FROE_POINT, 1, point, NULL, NULL), FROE_OK);
        assert_int_equal(trees_add(scene, FROE_BALL, 1, centre, radii + i % 3, NULL), FROE_OK);
        froe_tree *with = hand_made(scene, cuts, splits, 2, entries, must ? 4 : 3, &by_hand);
        froe_tree *without = hand_made(scene, cuts, splits, 2, entries, 3, &by_hand);
        assert_right(with);
        if (must)
            assert_wrong(without, "no piece where the object is");
        else
            assert_right(without);
        froe_tree_free(with);
        froe_tree_free(without);
        froe_scene_free(scene);
    }
}

/* A solid between -2 and 2, of which the tip of the wedge beyond (tip, 0) holds no corner, nor the centre; its legs are
 * two segments, which give the cuts. */
static froe_tree *solid_before_wedge(int dim, froe_cut_kind cut, froe_kind kind, double tip, bool listed) {
    const double legs[2][12] = {{tip, 0, tip + 4, 1, tip + 4, -1, tip + 8, -2},
                                {tip, 0, 0, tip + 4, 1, 0, tip + 4, -1, 0, tip + 8, -2, 0}};
    const double boxes[2][6] = {{-2, -2, 2, 2}, {-2, -2, -2, 2, 2, 2}};
    const double hulls[2][12] = {{2, -2, 2, 2, -2, 0}, {2, -2, -2, 2, 2, -2, 2, 1, 2, -2, 0, 0}};
    const double centre[3] = {0}, radius = 2;
    const double *x = kind == FROE_BALL ? centre : kind == FROE_BOX ? boxes[dim - 2] : hulls[dim - 2];
    const size_t starts[2] = {0, (size_t)dim + 1};
    const froe_cut cuts[2] = {{.kind = cut, .id = {0, 1}}, {.kind = cut, .id = {cut == FROE_CUT_OBJECT ? 1 : 2, 3}}};
    const uint32_t splits[2] = {0, 1}; /* leaves: 3: below both legs; 4: the wedge; 2: above the first leg */
    const entry all[5] = {{0, 0, 0, {0}}, {1, 1, 0, {0}}, {3, 2, 0, {0}}, {4, 2, 0, {0}}, {2, 2, 0, {0}}};
    const entry without[4] = {all[0], all[1], all[2], all[4]};
    froe_scene *scene;
    assert_int_equal(froe_scene_new(dim, NULL, &scene), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_SEGMENT, 2, legs[dim - 2], NULL, NULL), FROE_OK);
    assert_int_equal(
        trees_add(scene, kind, 1, x, kind == FROE_BALL ? &radius : NULL, kind == FROE_HULL ? starts : NULL), FROE_OK);
    froe_tree *tree = hand_made(scene, cuts, splits, 2, listed ? all : without, listed ? 5 : 4, &by_hand);
    froe_scene_free(scene);
    return tree;
}

/* The wedge begins within the solid, where it touches the solid, and beyond. */
static void solids_beside_cuts_through_vertices_must_be_listed_where_they_reach(void **state) {
    (void)state;
    const struct {
        int dim;
        froe_cut_kind cut;
    } cuts[] = {{2, FROE_CUT_OBJECT}, {2, FROE_CUT_VERTICES}, {3, FROE_CUT_EDGE}};
    const froe_kind kinds[] = {FROE_BOX, FROE_BALL, FROE_HULL};
    const double tips[] = {1.5, 2 - 0x1p-40, 2, 2.5};
    for (size_t i = 0; i < sizeof cuts / sizeof *cuts * 12; i++) {
        const size_t cut = i / 12, kind = i / 4 % 3, tip = i % 4;
        froe_tree *with = solid_before_wedge(cuts[cut].dim, cuts[cut].cut, kinds[kind], tips[tip], true);
        froe_tree *without = solid_before_wedge(cuts[cut].dim, cuts[cut].cut, kinds[kind], tips[tip], false);
        assert_right(with); /* a superset is allowed: no single cut excludes the wedge */
        if (tips[tip] < 2)
            assert_wrong(without, "no piece where the object is");
        else
            assert_right(without);
        froe_tree_free(with);
        froe_tree_free(without);
    }
}

/* A solid divided by the diagonal y = x, given by a segment: it has a corner on either side, and x = 9 excludes it. */
static void solids_beside_oblique_cuts_are_enclosed(void **state) {
    (void)state;
    const double coords[4] = {-5, -5, 5, 5}, box[4] = {0, 0, 1, 1}, hull[6] = {0, 1, 2, 1, 1, 3}, disc[2] = {0, 0},
                 radius = 1;
    const froe_cut cuts[2] = {{.kind = FROE_CUT_OBJECT, .id = {0}}, {.kind = FROE_CUT_AXIS, .axis = 0, .value = 9}};
    const uint32_t splits[2] = {0, 1}; /* node 1 right of (below) the diagonal: 3 left of x = 9, 4 right; 2 above */
    const size_t starts[2] = {0, 3};
    const froe_kind kinds[3] = {FROE_BOX, FROE_HULL, FROE_BALL};
    for (int k = 0; k < 3; k++) {
        const double *x = kinds[k] == FROE_BOX ? box : kinds[k] == FROE_HULL ? hull : disc;
        froe_scene *scene;
        assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
        assert_int_equal(trees_add(scene, FROE_SEGMENT, 1, coords, NULL, NULL), FROE_OK);
        assert_int_equal(trees_add(scene, kinds[k], 1, x, kinds[k] == FROE_BALL ? &radius : NULL,
                                   kinds[k] == FROE_HULL ? starts : NULL),
                         FROE_OK);
        const entry all[3] = {{0, 0, 0, {0}}, {3, 1, 0, {0}}, {2, 1, 0, {0}}};
        const entry beyond[4] = {{0, 0, 0, {0}}, {3, 1, 0, {0}}, {4, 1, 0, {0}}, {2, 1, 0, {0}}};
        const entry half[2] = {{0, 0, 0, {0}}, {3, 1, 0, {0}}};
        froe_tree *tree = hand_made(scene, cuts, splits, 2, all, 3, &by_hand);
        assert_right(tree);
        froe_tree_free(tree);
        tree = hand_made(scene, cuts, splits, 2, beyond, 4, &by_hand);
        assert_wrong(tree, "where the object is not");
        froe_tree_free(tree);
        tree = hand_made(scene, cuts, splits, 2, half, 2, &by_hand);
        if (kinds[k] != FROE_BALL)
            assert_wrong(tree, "no piece where the object is"); /* a disc's centre is in the cut: no witness */
        froe_tree_free(tree);
        froe_scene_free(scene);
    }
}

/* ------------------------------------------------------------------ promises -- */

static void broken_promises_are_found(void **state) {
    (void)state;
    froe_tree *t = sample();
    assert_true(t->meta.promise_count > 0);
    tree_promise *p = t->meta.promises, old = *p;
    p->promised = p->measured - 1;
    assert_wrong(t, "at most");
    *p = (tree_promise){"height", 1e9, 0};
    assert_wrong(t, "said to be measured");
    *p = (tree_promise){"fragments", 1e9, (double)t->piece_count};
    assert_right(t);
    *p = (tree_promise){"nodes", 1e9, t->node_count - 1.0};
    assert_wrong(t, "said to be measured");
    *p = (tree_promise){"path_length", 1e9, 1};
    assert_wrong(t, "said to be measured");
    *p = (tree_promise){"only the builder knows", 1, 1};
    assert_right(t);
    *p = (tree_promise){"only the builder knows", 1, 2};
    assert_wrong(t, "at most");
    *p = old;
    assert_right(t);
    froe_tree_free(t);
}

/* --------------------------------------------------------------------- calls -- */

static bool say_no(void *user, double done) {
    int *left = user;
    assert_true(done >= 0 && done <= 1);
    return --*left > 0;
}

static void the_audit_can_be_cancelled(void **state) {
    (void)state;
    froe_tree *t = trees_grow(2, FROE_SEGMENT, 3000, 0, 0.05, "density", 2);
    int asked = 1 << 20, most;
    froe_audit_options o = froe_audit_defaults();
    o.progress = say_no;
    o.threads = 2;
    o.user = &asked;
    assert_int_equal(froe_tree_audit(t, &o, NULL), FROE_OK);
    most = (1 << 20) - asked;
    assert_true(most >= 4);
    for (int after = 1; after <= 3; after++) {
        froe_diagnostic why;
        asked = after;
        assert_int_equal(froe_tree_audit(t, &o, &why), FROE_E_CANCELLED);
        assert_int_equal(why.status, FROE_E_CANCELLED);
    }
    froe_tree_free(t);
}

static void bad_arguments_are_refused(void **state) {
    (void)state;
    froe_tree *t = sample();
    froe_audit_options o = {0};
    froe_diagnostic why;
    assert_int_equal(froe_tree_audit(NULL, NULL, &why), FROE_E_ARG);
    assert_int_equal(froe_tree_audit(t, &o, &why), FROE_E_OPTIONS);
    froe_tree_free(t);
}

static froe_status auditing(void *user, const froe_allocator *alloc) {
    froe_tree *tree = user; /* its own allocator is what the audit uses */
    froe_audit_options o = froe_audit_defaults();
    froe_allocator own = tree->alloc;
    o.threads = 2;
    tree->alloc = *alloc;
    froe_status status = froe_tree_audit(tree, &o, NULL);
    tree->alloc = own;
    return status;
}

static void any_allocation_may_fail(void **state) {
    (void)state;
    static const variety some[] = {
        {2, FROE_SEGMENT, 4, 0.8}, {3, FROE_POLYGON, 3, 0.9}, {2, FROE_BALL, 0, 0.9}, {3, FROE_HULL, 0, 0.9}};
    for (size_t k = 0; k < 4; k++) {
        froe_tree *t = trees_grow(some[k].dim, some[k].kind, 20, some[k].grid, some[k].size, "density", 2);
        assert_true(test_memory_each(auditing, t) > 10);
        froe_tree_free(t);
    }
    froe_tree *beside = solid_before_wedge(3, FROE_CUT_EDGE, FROE_HULL, 2, false); /* its cell is asked about */
    assert_true(test_memory_each(auditing, beside) > 10);
    froe_tree_free(beside);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(built_trees_pass),
        cmocka_unit_test(mixed_scenes_pass),
        cmocka_unit_test(all_stages_and_thread_counts_agree),
        cmocka_unit_test(huge_and_tiny_coordinates_pass),
        cmocka_unit_test(broken_structure_is_found),
        cmocka_unit_test(a_wrong_report_is_found),
        cmocka_unit_test(a_torn_charge_is_found),
        cmocka_unit_test(a_torn_guard_stage_is_found),
        cmocka_unit_test(every_missing_piece_is_found),
        cmocka_unit_test(every_stray_piece_is_found),
        cmocka_unit_test(every_wrong_shape_is_found),
        cmocka_unit_test(a_piece_listed_twice_is_found),
        cmocka_unit_test(the_lowest_object_is_told_whatever_the_threads),
        cmocka_unit_test(no_doctored_piece_of_a_built_tree_passes),
        cmocka_unit_test(rings_may_begin_anywhere),
        cmocka_unit_test(balls_must_be_listed_exactly_where_their_distance_says),
        cmocka_unit_test(boxes_among_axis_parallel_cuts_are_exact),
        cmocka_unit_test(hulls_must_be_listed_in_cells_without_a_corner_of_theirs),
        cmocka_unit_test(balls_beside_oblique_planes_must_be_listed_where_they_reach),
        cmocka_unit_test(solids_beside_oblique_cuts_are_enclosed),
        cmocka_unit_test(solids_beside_cuts_through_vertices_must_be_listed_where_they_reach),
        cmocka_unit_test(broken_promises_are_found),
        cmocka_unit_test(the_audit_can_be_cancelled),
        cmocka_unit_test(bad_arguments_are_refused),
        cmocka_unit_test(any_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
