/* test_cylindrical.c: cylindrical partitions against their definition, orders, refusals, and what lies above and below.
 */
#include "build/options.h"
#include "builders/cylinder_oracle.h"
#include "geom/predicates.h"
#include "support/fuzz.h"
#include "tree/tree.h"
#include <froe/io.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

enum { MOST = 48 };

static froe_build_options options(uint32_t leaf) {
    froe_build_options o = froe_build_defaults();
    o.method = "cylindrical";
    o.leaf = leaf;
    o.threads = 1;
    return o;
}

static froe_tree *build(froe_scene *scene, const froe_build_options *o) {
    froe_diagnostic why = {0};
    froe_tree *tree = NULL;
    if (froe_build(scene, o, &tree, &why)) fail_msg("%s", why.message);
    return tree;
}

static froe_scene *segments(const double *xyxy, size_t count) {
    froe_scene *scene;
    froe_objects o = froe_objects_defaults();
    o.kind = FROE_SEGMENT;
    o.count = count;
    o.coords = xyxy;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
    return scene;
}

/* ---------------------------------------------------------- the definition -- */

typedef struct walk {
    const froe_tree *tree;
    const froe_scene *scene;
    uint32_t seen; /* nodes */
} walk;

static void check_cell(walk *w, uint32_t node, const oracle_cell *cell, const uint32_t *set, uint32_t count);

/* Those of the set that reach into the cell. */
static void check_child(walk *w, uint32_t node, const oracle_cell *cell, const uint32_t *set, uint32_t count) {
    uint32_t inside[MOST], kept = 0;
    oracle_part part;
    oracle_part_init(&part);
    for (uint32_t i = 0; i < count; i++)
        if (oracle_clip(w->scene, set[i], cell, &part)) inside[kept++] = set[i];
    oracle_part_clear(&part);
    check_cell(w, node, cell, inside, kept);
}

/* The point by which a wall is named. */
static void wall_point(walk *w, const froe_cut *cut, oracle_point *out) {
    if (cut->kind == FROE_CUT_VERTEX) {
        oracle_vertex(w->scene, cut->id[0], out);
        return;
    }
    assert_int_equal(cut->kind, FROE_CUT_CROSSING);
    oracle_point left, right;
    oracle_point_init(&left), oracle_point_init(&right);
    oracle_ends(w->scene, cut->id[0], &left, &right);
    oracle_crossing(w->scene, cut->id[1], &left, &right, out);
    oracle_point_clear(&left), oracle_point_clear(&right);
}

/* The wall at one end of the part: its far child is checked, the node goes on to the near one. */
static void check_wall(walk *w, uint32_t *node, oracle_cell *cell, const oracle_point *at, int side,
                       const uint32_t *set, uint32_t count) {
    const froe_cut cut = tree_cut_at(w->tree, *node);
    const uint32_t child = w->tree->nodes[*node].child;
    oracle_point named;
    oracle_point_init(&named);
    wall_point(w, &cut, &named);
    assert_int_equal(oracle_order(&named, at), 0);
    oracle_point_clear(&named);
    oracle_cell far = *cell;
    *(side ? &far.left : &far.right) = at;
    *(side ? &cell->right : &cell->left) = at;
    check_child(w, child + (uint32_t)side, &far, set, count);
    *node = child + !side;
}

static void check_line(walk *w, uint32_t node, const oracle_cell *cell, const uint32_t *set, uint32_t count) {
    const froe_cut cut = tree_cut_at(w->tree, node);
    assert_int_equal(cut.kind, FROE_CUT_OBJECT);
    for (uint32_t k = 0; k < 2; k++) { /* the same line, by what may be another object */
        oracle_point end;
        oracle_point_init(&end);
        oracle_vertex(w->scene, scene_corner(w->scene, set[0], k), &end);
        assert_int_equal(oracle_above(w->scene, cut.id[0], &end), 0);
        oracle_point_clear(&end);
    }
    const double *u = scene_point(w->scene, cut.id[0], 0), *v = scene_point(w->scene, cut.id[0], 1);
    const uint32_t rises = u[0] < v[0] || (u[0] == v[0] && u[1] < v[1]), child = w->tree->nodes[node].child;
    oracle_cell above = *cell, below = *cell;
    above.bottom = below.top = set[0];
    check_child(w, child + rises, &above, set + 1, count - 1);
    check_child(w, child + !rises, &below, set + 1, count - 1);
}

static void check_cell(walk *w, uint32_t node, const oracle_cell *given, const uint32_t *set, uint32_t count) {
    oracle_cell cell = *given;
    oracle_part part;
    w->seen++;
    if (!count) {
        assert_true(tree_is_leaf(w->tree->nodes + node));
        return;
    }
    oracle_part_init(&part);
    assert_true(oracle_clip(w->scene, set[0], &cell, &part));
    if (scene_form(w->scene, set[0]) == FROE_POINT) {
        oracle_cell right = cell;
        check_wall(w, &node, &cell, &part.end[0], 1, set + 1, count - 1);
        right.right = &part.end[0], right.left = given->left;
        check_child(w, node, &right, set + 1, count - 1);
    } else {
        for (int side = 0; side < 2; side++)
            if (!part.wall[side]) check_wall(w, &node, &cell, &part.end[side], side, set, count), w->seen++;
        check_line(w, node, &cell, set, count);
    }
    oracle_part_clear(&part);
}

/* Builds in the given order and compares node by node. */
static void check_definition(froe_scene *scene, const uint32_t *order) {
    const uint32_t n = scene->object_count;
    froe_build_options o = options(0);
    o.order = order;
    o.order_count = n;
    froe_tree *tree = build(scene, &o);
    walk w = {tree, scene, 0};
    const oracle_cell plane = {NULL, NULL, FROE_NONE, FROE_NONE};
    check_cell(&w, 0, &plane, order, n);
    assert_int_equal(w.seen, tree->node_count);
    froe_tree_free(tree);
}

static void shuffle(fuzz_source *r, uint32_t *order, uint32_t n) {
    for (uint32_t i = 0; i < n; i++) order[i] = i;
    for (uint32_t i = n; i > 1; i--) {
        uint32_t j = (uint32_t)fuzz_int(r, 0, (int)i - 1), t = order[i - 1];
        order[i - 1] = order[j], order[j] = t;
    }
}

static void trees_are_those_of_the_definition(void **state) {
    (void)state;
    for (int kind = 0; kind < FUZZ_CLASSES; kind++) {
        fuzz_source r = {(uint64_t)kind};
        for (int trial = 0; trial < 40; trial++) {
            enum { COUNT = 8 };
            double points[4 * COUNT];
            uint32_t order[COUNT];
            fuzz_points(&r, (fuzz_class)kind, 2, points, 2 * COUNT);
            froe_scene *scene = segments(points, COUNT);
            shuffle(&r, order, COUNT);
            check_definition(scene, order);
            froe_scene_free(scene);
        }
    }
}

/* Mass coincidence: every end on a grid of 5 x 5. */
static void trees_on_tiny_lattices_are_those_of_the_definition(void **state) {
    (void)state;
    fuzz_source r = {99};
    for (int trial = 0; trial < 60; trial++) {
        enum { COUNT = 16 };
        double points[4 * COUNT];
        uint32_t order[COUNT];
        for (int i = 0; i < 4 * COUNT; i++) points[i] = fuzz_int(&r, 0, trial % 5 + 1);
        froe_scene *scene = segments(points, COUNT);
        shuffle(&r, order, COUNT);
        check_definition(scene, order);
        froe_scene_free(scene);
    }
}

/* ------------------------------------------------------------ above and below -- */

/* On the way down to a leaf of leaf 0, the last line or plane passed below x is what is below it, and so above. Queries
 * stand over points whose x no vertex has. */
static void neighbours(const froe_tree *t, num_context *context, const double *x, int up, uint32_t found[2]) {
    uint32_t node = 0;
    found[0] = found[1] = FROE_NONE;
    while (!tree_is_leaf(t->nodes + node)) {
        const froe_cut cut = tree_cut_at(t, node);
        const geom_plane plane = tree_plane_at(t, node);
        int side = geom_side_vertex(context, &plane, x);
        assert_int_not_equal(side, 0);
        if (cut.kind == FROE_CUT_OBJECT) found[side * (plane.n[up] > 0 ? 1 : -1) < 0] = cut.id[0];
        node = t->nodes[node].child + (side > 0);
    }
}

/* Height of a plane that is not upright, over or under x: for comparing with others. */
static double height(const geom_plane *h, const double *x, int up) {
    double sum = 0;
    for (int k = 0; k < up; k++) sum += h->n[k] * (x[k] - h->p[0][k]);
    return h->p[0][up] - sum / h->n[up];
}

static bool is_over(const froe_scene *s, num_context *context, uint32_t object, const double *x) {
    uint32_t n = scene_corners(s, object);
    int seen = 0;
    if (s->dim == 2) {
        const double *u = scene_point(s, object, 0), *v = scene_point(s, object, n - 1);
        return (u[0] < x[0]) != (v[0] < x[0]);
    }
    for (uint32_t i = 0; i < n; i++) {
        geom_plane edge = geom_plane_vertical(scene_point(s, object, i), scene_point(s, object, i + 1 < n ? i + 1 : 0));
        int side = geom_side_vertex(context, &edge, x);
        if (side == 0 || side == -seen) return false;
        seen = side;
    }
    return true;
}

static void check_neighbours(const froe_tree *t, num_context *context, const double *x) {
    const froe_scene *s = t->scene;
    uint32_t found[2];
    int up = s->dim - 1;
    double best[2] = {-INFINITY, INFINITY};
    neighbours(t, context, x, up, found);
    for (uint32_t i = 0; i < s->object_count; i++) {
        geom_plane h;
        if (scene_form(s, i) == FROE_POINT || !is_over(s, context, i, x)) continue;
        scene_support(s, i, &h);
        double z = height(&h, x, up);
        int above = z > x[up];
        if (above ? z < best[1] : z > best[0]) best[above] = z;
    }
    for (int above = 0; above < 2; above++) {
        geom_plane h;
        assert_int_equal(found[above] == FROE_NONE, isinf(best[above]) != 0);
        if (found[above] == FROE_NONE) continue;
        scene_support(s, found[above], &h);
        assert_true(fabs(height(&h, x, up) - best[above]) < 1e-9 * (1 + fabs(best[above])));
        assert_true(is_over(s, context, found[above], x));
    }
}

static void leaves_know_what_is_above_and_below(void **state) {
    static const char *const kinds[] = {"segments",    "mixed",  "lattice", "tiles",    "walls",     "star",
                                        "polylines",   "rooms",  "blocks",  "slats",    "diagonals", "terrain",
                                        "disjoint-3d", "sphere", "city",    "tiles-3d", "cuboids",   "rooms-3d"};
    num_context context;
    (void)state;
    assert_int_equal(num_context_new(NULL, &context), FROE_OK);
    for (size_t g = 0; g < 2 * (sizeof kinds / sizeof *kinds); g++) {
        froe_scene *scene;
        fuzz_source r = {g};
        froe_build_options o = options(0);
        if (g % 2) o.settings = "edges=given";
        assert_int_equal(froe_generate(kinds[g / 2], 150, 3, NULL, &scene, NULL), FROE_OK);
        froe_tree *tree = build(scene, &o);
        assert_int_equal(froe_tree_audit(tree, NULL, NULL), FROE_OK);
        for (int i = 0; i < 400; i++) {
            double x[3] = {0};
            for (int k = 0; k < scene->dim; k++)
                x[k] = scene->lo[k] + (scene->hi[k] - scene->lo[k]) * (0.51 + 0.501 * fuzz_unit(&r));
            check_neighbours(tree, &context, x);
        }
        froe_tree_free(tree);
        froe_scene_free(scene);
    }
    num_context_free(&context);
}

/* ------------------------------------------------------------------- orders -- */

/* Which edge of a triangle cuts first, by its number. */
static uint32_t first_edge(const double *corners, const char *settings) {
    froe_scene *scene;
    froe_objects batch = froe_objects_defaults();
    froe_build_options o = options(0);
    batch.kind = FROE_POLYGON, batch.count = 1, batch.coords = corners, batch.starts = (const size_t[]){0, 3};
    o.settings = settings;
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    assert_int_equal(froe_scene_add(scene, &batch, NULL), FROE_OK);
    froe_tree *tree = build(scene, &o);
    froe_node_info info = froe_tree_node(tree, froe_tree_root(tree));
    for (int side = 0; info.cut.kind == FROE_CUT_VERTEX; side = 1) /* walls, with the triangle between them */
        info = froe_tree_node(tree, info.child[1 - side]);
    assert_int_equal(info.cut.kind, FROE_CUT_EDGE);
    uint32_t edge = 0;
    for (; edge < 3; edge++) {
        const uint32_t a = froe_scene_corner(scene, 0, edge), b = froe_scene_corner(scene, 0, (edge + 1) % 3);
        if ((a == info.cut.id[0] && b == info.cut.id[1]) || (b == info.cut.id[0] && a == info.cut.id[1])) break;
    }
    froe_tree_free(tree);
    froe_scene_free(scene);
    return edge;
}

static void edges_cut_by_length_or_in_the_given_order(void **state) {
    static const double flat[] = {0, 0, 0, 1, 1, 0, 9, 0, 0}, upright[] = {3, 0, 0, 3, 0, 4, 5, 0, 0};
    (void)state;
    assert_int_equal(first_edge(flat, ""), 2);
    assert_int_equal(first_edge(flat, "edges=longest"), 2);
    assert_int_equal(first_edge(flat, "edges=given"), 0);
    assert_int_equal(first_edge(upright, "edges=given"), 1); /* its first edge is a point from above */
}

static void assert_refused(froe_scene *scene, const froe_build_options *o, froe_status status, const char *message) {
    froe_tree *tree = NULL;
    froe_diagnostic why = {0};
    assert_int_equal(froe_build(scene, o, &tree, &why), status);
    assert_null(tree);
    assert_string_equal(why.message, message);
}

static void orders_must_name_every_object_once(void **state) {
    static const double xyxy[] = {0, 0, 1, 1, 0, 1, 1, 0, 2, 0, 3, 1};
    froe_scene *scene = segments(xyxy, 3);
    froe_build_options o = options(1);
    (void)state;
    o.order = (const uint32_t[]){2, 0, 1};
    o.order_count = 3;
    froe_tree_free(build(scene, &o));
    o.order_count = 2;
    assert_refused(scene, &o, FROE_E_OPTIONS, "The order has 2 entries for 3 objects.");
    o.order_count = 3;
    o.order = (const uint32_t[]){2, 2, 1};
    assert_refused(scene, &o, FROE_E_OPTIONS, "The order has object 2 twice.");
    o.order = (const uint32_t[]){2, 0, 3};
    assert_refused(scene, &o, FROE_E_OPTIONS, "Entry 2 of the order is 3, and there is no such object.");
    o.method = "density";
    assert_refused(scene, &o, FROE_E_OPTIONS, "Method 'density' takes no order of objects.");
    froe_scene_free(scene);
}

/* In the order of the stairs every step is one level deeper. */
static froe_scene *stairs(uint32_t n, uint32_t *order) {
    double xyxy[4 * 1024];
    for (uint32_t i = 0; i < n; i++) {
        const double step[4] = {0, i, 1, i};
        memcpy(xyxy + 4 * i, step, sizeof step);
        order[i] = i;
    }
    return segments(xyxy, n);
}

static void an_order_that_was_given_is_kept_however_deep(void **state) {
    enum { COUNT = 200 };
    uint32_t order[COUNT];
    froe_scene *scene = stairs(COUNT, order);
    froe_build_options o = options(0);
    (void)state;
    o.order = order;
    o.order_count = COUNT;
    o.settings = "height=1 draws=1";
    froe_tree *tree = build(scene, &o);
    assert_true(froe_tree_report(tree).height >= COUNT);
    assert_null(froe_tree_report(tree).promises[0].name); /* the theorem is about random orders */
    assert_int_equal(froe_tree_audit(tree, NULL, NULL), FROE_OK);
    froe_tree_free(tree);
    froe_scene_free(scene);
}

/* A bound between the heights of the first orders: the first that keeps it is taken. */
static void deep_orders_are_drawn_again(void **state) {
    enum { COUNT = 1000 };
    uint32_t order[COUNT];
    froe_scene *scene = stairs(COUNT, order);
    uint64_t least = UINT64_MAX, most = 0, redrawn = 0;
    (void)state;
    for (uint64_t seed = 1; seed < 40; seed++) {
        froe_build_options o = options(0);
        o.seed = seed;
        o.settings = "height=1 draws=100"; /* 24 + log2(1002) levels, near the mean */
        froe_tree *tree = build(scene, &o);
        froe_report r = froe_tree_report(tree);
        o.settings = "height=100";
        froe_tree *first = build(scene, &o);
        redrawn += froe_tree_report(first).height > 33;
        least = r.height < least ? r.height : least, most = r.height > most ? r.height : most;
        if (froe_tree_report(first).height <= 33) assert_int_equal(froe_tree_report(first).nodes, r.nodes);
        assert_true((double)r.height <= r.promises[0].promised);
        froe_tree_free(first);
        froe_tree_free(tree);
    }
    assert_true(redrawn > 5 && redrawn < 39 && least < 33 && most <= 33);
    froe_scene_free(scene);
}

/* -------------------------------------------------------------------- size -- */

static const froe_promise *promised(const froe_tree *tree, const char *name) {
    const froe_promise *p = froe_tree_report(tree).promises;
    while (p->name && strcmp(p->name, name) != 0) p++;
    return p->name ? p : NULL;
}

/* Short level segments beside one another below long ones; `crossing` of these are upright, and cross the rest. In the
 * order of their ids walls of the short ones cross all long ones. */
static froe_scene *ladder(uint32_t n, uint32_t crossing, uint32_t *order) {
    double xyxy[4 * 1024];
    for (uint32_t i = 0; i < n; i++) {
        const double level[4] = {i, 0, i + 0.5, 0}, high[4] = {-1. - i, i, 2. * n + i, i};
        const double upright[4] = {i + 0.25, 1, i + 0.25, 2. * n};
        memcpy(xyxy + 4 * i, i < n / 2 ? level : i < n - crossing ? high : upright, sizeof level);
        order[i] = i;
    }
    return segments(xyxy, n);
}

/* 2 (3 n + 4 n (H_n - 1) + 5 k) cuts for k crossings; sorted, there are many more. */
static void size_is_bounded_by_segments_and_crossings(void **state) {
    enum { COUNT = 400 };
    uint32_t order[COUNT];
    double harmonic = 0;
    (void)state;
    for (int i = 1; i <= COUNT; i++) harmonic += 1.0 / i;
    for (uint32_t crossing = 0; crossing <= 20; crossing += 20) {
        froe_scene *scene = ladder(COUNT, crossing, order);
        const double k = crossing * (COUNT / 2.0 - crossing);
        const double most = 4 * (3 * COUNT + 4 * COUNT * (harmonic - 1) + 5 * k) + 1;
        froe_build_options o = options(0);
        for (o.seed = 1; o.seed <= 20; o.seed++) {
            froe_tree *tree = build(scene, &o);
            const froe_promise *nodes = promised(tree, "nodes"), *path = promised(tree, "path_length");
            assert_true(fabs(nodes->promised - most) < 1e-6 * most);
            assert_true(nodes->measured == (double)froe_tree_report(tree).nodes && nodes->measured <= most);
            assert_true(path->measured <= path->promised);
            assert_int_equal(froe_tree_audit(tree, NULL, NULL), FROE_OK);
            froe_tree_free(tree);
        }
        o.order = order, o.order_count = COUNT;
        froe_tree *sorted = build(scene, &o);
        assert_true((double)froe_tree_report(sorted).nodes > most);
        froe_tree_free(sorted);
        froe_scene_free(scene);
    }
}

/* A bound among the sizes of the first orders: the first that keeps it is taken; none keeps a tenth. */
static void large_orders_are_drawn_again(void **state) {
    enum { COUNT = 300 };
    uint32_t order[COUNT], redrawn = 0;
    froe_scene *scene = ladder(COUNT, 0, order);
    (void)state;
    for (uint64_t seed = 1; seed <= 40; seed++) {
        froe_build_options o = options(0);
        froe_tree *first, *small, *none;
        o.seed = seed;
        first = build(scene, &o);
        o.settings = "size=0.55 draws=100";
        assert_int_equal(build_tuned(scene, &o, &small, NULL), FROE_OK);
        const froe_promise *nodes = promised(small, "nodes");
        assert_true(nodes && nodes->measured <= nodes->promised);
        const bool fits = (double)froe_tree_report(first).nodes <= nodes->promised;
        if (fits) assert_int_equal(froe_tree_report(first).nodes, froe_tree_report(small).nodes);
        redrawn += !fits;
        o.settings = "size=0.1";
        assert_int_equal(build_tuned(scene, &o, &none, NULL), FROE_OK);
        assert_null(froe_tree_report(none).promises[0].name);
        assert_int_equal(froe_tree_report(none).nodes, froe_tree_report(first).nodes);
        froe_tree_free(first), froe_tree_free(small), froe_tree_free(none);
    }
    if (redrawn < 3 || redrawn > 37) fail_msg("%u of 40 first orders are redrawn", redrawn);
    froe_scene_free(scene);
}

/* Sums over threads were taken twice. */
static void predicates_are_counted_once_for_any_number_of_threads(void **state) {
    froe_scene *scene;
    froe_predicate_stats one = {0};
    (void)state;
    assert_int_equal(froe_generate("segments", 1500, 1, NULL, &scene, NULL), FROE_OK);
    for (unsigned threads = 1; threads <= 3; threads++) {
        froe_build_options o = options(1);
        o.threads = threads;
        froe_tree *tree = build(scene, &o);
        const froe_predicate_stats stats = froe_tree_report(tree).predicates;
        if (threads == 1) one = stats;
        assert_memory_equal(&stats, &one, sizeof one);
        froe_tree_free(tree);
    }
    assert_true(one.calls > 0);
    froe_scene_free(scene);
}

/* ------------------------------------------------------------------ refusals -- */

static froe_scene *triangles(const double *xyz, size_t count) {
    froe_scene *scene;
    froe_objects o = froe_objects_defaults();
    o.kind = FROE_POLYGON;
    o.count = count;
    o.coords = xyz;
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
    return scene;
}

static void polygons_that_cross_are_named(void **state) {
    static const double xyz[] = {9,  9,  9,  10, 9,  9, 9, 10, 9,  /* elsewhere */
                                 -4, -4, 0,  4,  -4, 0, 0, 4,  0,  /* flat */
                                 0,  0,  -1, 0,  1,  2, 1, 0,  2}; /* through it */
    froe_scene *scene = triangles(xyz, 3);
    froe_build_options o = options(0);
    froe_tree *tree = NULL;
    froe_diagnostic why = {0};
    (void)state;
    for (o.seed = 1; o.seed < 20; o.seed++) {
        assert_int_equal(froe_build(scene, &o, &tree, &why), FROE_E_INPUT);
        assert_true(why.object == 1 || why.object == 2);
        const char *message = why.object == 1 ? "object 1: It crosses object 2." : "object 2: It crosses object 1.";
        assert_int_equal(strncmp(why.message, message, strlen(message)), 0);
    }
    o.settings = "crossing=split";
    tree = build(scene, &o);
    assert_int_equal(froe_tree_audit(tree, NULL, NULL), FROE_OK);
    froe_tree_free(tree);
    froe_scene_free(scene);
}

/* Far from one another, so that different threads meet them: those of the first refused part of the tree are named. */
static void of_many_polygons_that_cross_the_same_are_named_by_all_threads(void **state) {
    enum { SIDE = 56, COUNT = SIDE * SIDE };
    static double xyz[9 * (COUNT + 4)];
    static const int crossed[4] = {0, SIDE - 1, COUNT - SIDE, COUNT - 1};
    (void)state;
    for (int i = 0; i < COUNT; i++) {
        const double x = 4 * (i % SIDE), y = 4.0 * (double)(i / SIDE), z = i * 7 % 11;
        const double flat[9] = {x, y, z, x + 2, y, z, x, y + 2, z};
        memcpy(xyz + 9 * (size_t)i, flat, sizeof flat);
        for (int c = 0; c < 4; c++) {
            const double through[9] = {x + 0.5, y + 0.5, z - 1, x + 0.5, y + 0.5, z + 1, x + 1, y + 0.25, z + 1};
            if (crossed[c] == i) memcpy(xyz + 9 * (size_t)(COUNT + c), through, sizeof through);
        }
    }
    froe_scene *scene = triangles(xyz, COUNT + 4);
    for (uint64_t seed = 1; seed < 4; seed++) {
        froe_diagnostic why[2] = {{0}};
        for (unsigned i = 0; i < 2; i++) {
            froe_build_options o = options(0);
            froe_tree *tree = NULL;
            o.threads = 1 + 2 * i, o.seed = seed;
            assert_int_equal(froe_build(scene, &o, &tree, why + i), FROE_E_INPUT);
            assert_null(tree);
        }
        assert_string_equal(why[0].message, why[1].message);
        unsigned pair[2];
        assert_int_equal(sscanf(why[0].message, "object %u: It crosses object %u.", pair, pair + 1), 2);
        const unsigned flat = pair[0] < COUNT ? pair[0] : pair[1], upright = pair[0] + pair[1] - flat;
        assert_in_range(upright, COUNT, COUNT + 3);
        assert_int_equal(flat, crossed[upright - COUNT]);
    }
    froe_scene_free(scene);
}

static void polygons_that_touch_are_welcome(void **state) {
    static const double xyz[] = {-4, -4, 0, 4, -4, 0, 0, 4,  0,  /* flat */
                                 0,  0,  0, 0, 1,  2, 1, 0,  2,  /* stands on it with a corner */
                                 -1, -1, 0, 1, -1, 0, 0, -1, 2,  /* upright, on an edge */
                                 -2, -2, 0, 2, -2, 0, 0, 3,  0}; /* in its plane, overlapping */
    froe_scene *scene = triangles(xyz, 4);
    froe_build_options o = options(0);
    (void)state;
    for (o.seed = 1; o.seed < 20; o.seed++) {
        froe_tree *tree = build(scene, &o);
        assert_int_equal(froe_tree_audit(tree, NULL, NULL), FROE_OK);
        froe_tree_free(tree);
    }
    froe_scene_free(scene);
}

/* Where polygons cut each other, edges cross borders of cells inside them: no cut may come again and again. */
static void polygons_that_cross_everywhere_come_to_an_end(void **state) {
    enum { COUNT = 14 };
    (void)state;
    for (int trial = 0; trial < 60; trial++) {
        fuzz_source r = {(uint64_t)trial};
        double xyz[9 * COUNT];
        for (int i = 0; i < 9 * COUNT; i++) xyz[i] = trial % 2 ? fuzz_int(&r, 0, 5) : fuzz_unit(&r);
        froe_scene *scene = triangles(xyz, COUNT);
        froe_build_options o = options(0);
        o.settings = "crossing=split";
        o.max_fragments = 100000;
        froe_tree *tree = build(scene, &o);
        if (trial < 10) assert_int_equal(froe_tree_audit(tree, NULL, NULL), FROE_OK);
        froe_tree_free(tree);
        froe_scene_free(scene);
    }
}

/* n segments that all start at one point need one wall there on each side, not n. */
static void shared_ends_share_their_walls(void **state) {
    enum { COUNT = 60 };
    double xyxy[4 * COUNT];
    (void)state;
    for (int i = 0; i < COUNT; i++) {
        const double spoke[4] = {0, 0, 1 + i % 7, i - COUNT / 2.0};
        memcpy(xyxy + 4 * i, spoke, sizeof spoke);
    }
    froe_scene *scene = segments(xyxy, COUNT);
    froe_build_options o = options(0);
    froe_tree *tree = build(scene, &o);
    uint32_t walls = 0;
    for (uint32_t i = 0; i < tree->node_count; i++) {
        const froe_cut cut = tree_cut_at(tree, i);
        walls += cut.kind == FROE_CUT_VERTEX && scene_vertex(scene, cut.id[0])[0] == 0;
    }
    assert_int_equal(walls, 1);
    froe_tree_free(tree);
    froe_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(trees_are_those_of_the_definition),
        cmocka_unit_test(trees_on_tiny_lattices_are_those_of_the_definition),
        cmocka_unit_test(leaves_know_what_is_above_and_below),
        cmocka_unit_test(edges_cut_by_length_or_in_the_given_order),
        cmocka_unit_test(orders_must_name_every_object_once),
        cmocka_unit_test(an_order_that_was_given_is_kept_however_deep),
        cmocka_unit_test(deep_orders_are_drawn_again),
        cmocka_unit_test(size_is_bounded_by_segments_and_crossings),
        cmocka_unit_test(large_orders_are_drawn_again),
        cmocka_unit_test(predicates_are_counted_once_for_any_number_of_threads),
        cmocka_unit_test(polygons_that_cross_are_named),
        cmocka_unit_test(of_many_polygons_that_cross_the_same_are_named_by_all_threads),
        cmocka_unit_test(polygons_that_touch_are_welcome),
        cmocka_unit_test(polygons_that_cross_everywhere_come_to_an_end),
        cmocka_unit_test(shared_ends_share_their_walls),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
