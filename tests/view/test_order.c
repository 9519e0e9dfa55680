/* test_order.c: depth orders, verified pair by pair with exact rays.
 *
 * A ray from the eye meets pieces at exact rational distances; a piece is met where the ray pierces its object
 * inside the cell of its node, decided by the cuts above it alone. Along each ray the order must be that of the
 * distances, and where they are equal (in one cut) that of the ranks. */
#include "rays.h"
#include "tree/list.h"
#include <froe/view.h>
#include <stdlib.h>

typedef struct ray_case {
    const froe_tree *tree;
    rational_plane *cuts;     /* per node */
    uint32_t *parents, *home; /* per node; per piece its node */
    uint32_t *place;          /* per piece: its position front to back */
    rational_point from, to;  /* the eye (at infinity when from.w is 0), and a point the ray runs through */
} ray_case;

static void open_case(ray_case *c, const froe_tree *tree) {
    *c = (ray_case){.tree = tree};
    c->cuts = calloc(tree->node_count, sizeof *c->cuts);
    c->parents = calloc(tree->node_count, sizeof *c->parents);
    c->home = calloc(tree->piece_count + 1, sizeof *c->home);
    c->place = calloc(tree->piece_count + 1, sizeof *c->place);
    for (uint32_t n = 0; n < tree->node_count; n++) {
        const tree_objects list = tree_list(tree, n);
        rational_plane_init(&c->cuts[n]);
        for (uint32_t i = 0; i < list.count; i++) c->home[list.first + i] = n;
        if (tree_is_leaf(tree->nodes + n)) continue;
        const geom_plane plane = tree_plane_at(tree, n);
        rational_plane_set(&c->cuts[n], &plane);
        c->parents[tree->nodes[n].child] = c->parents[tree->nodes[n].child + 1] = n;
    }
    rational_point_init(&c->from);
    rational_point_init(&c->to);
}

static void close_case(ray_case *c) {
    for (uint32_t n = 0; n < c->tree->node_count; n++) rational_plane_clear(&c->cuts[n]);
    rational_point_clear(&c->from);
    rational_point_clear(&c->to);
    free(c->cuts), free(c->parents), free(c->home), free(c->place);
}

static bool inside_cell(ray_case *c, uint32_t node, rational_point *x) {
    for (; node; node = c->parents[node]) {
        const int wanted = node == c->tree->nodes[c->parents[node]].child ? -1 : 1;
        if (rational_side(&c->cuts[c->parents[node]], x) != wanted) return false;
    }
    return true;
}

/* Checks all pairs of pieces on one ray; returns how many pieces it meets. */
static uint32_t check_ray(ray_case *c, const uint32_t *ranks) {
    enum { MOST = 200 };
    const froe_tree *tree = c->tree;
    uint32_t met[MOST], count = 0;
    mpq_t t[MOST];
    rational_point x;
    rational_point_init(&x);
    for (uint32_t i = 0; i < tree->piece_count && count < MOST; i++) {
        mpq_init(t[count]);
        if (rays_hit(tree->scene, &c->from, &c->to, tree->pieces[i].object, t[count], &x) &&
            inside_cell(c, c->home[i], &x))
            met[count++] = i;
        else
            mpq_clear(t[count]);
    }
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t j = 0; j < count; j++) {
            const int nearer = mpq_cmp(t[i], t[j]);
            if (nearer < 0) assert_true(c->place[met[i]] < c->place[met[j]]);
            if (nearer == 0 && ranks[tree->pieces[met[i]].object] > ranks[tree->pieces[met[j]].object])
                assert_true(c->place[met[i]] < c->place[met[j]]);
        }
    for (uint32_t i = 0; i < count; i++) mpq_clear(t[i]);
    rational_point_clear(&x);
    return count;
}

typedef struct listing {
    uint32_t *pieces;
    size_t count, stop;
} listing;

static bool keep(void *user, size_t piece) {
    listing *l = user;
    l->pieces[l->count++] = (uint32_t)piece;
    return l->count != l->stop;
}

static listing list_order(const froe_tree *tree, const froe_eye *eye, bool front_to_back, const uint32_t *ranks) {
    listing l = {calloc(tree->piece_count + 1, sizeof(uint32_t)), 0, 0};
    froe_order_options o = froe_order_defaults();
    o.front_to_back = front_to_back;
    o.ranks = ranks;
    assert_int_equal(froe_tree_order(tree, eye, &o, keep, &l, NULL), FROE_OK);
    return l;
}

/* Every piece once; back to front is front to back reversed. */
static void check_order(ray_case *c, const froe_eye *eye, const uint32_t *ranks) {
    const size_t n = c->tree->piece_count;
    listing near = list_order(c->tree, eye, true, ranks), far = list_order(c->tree, eye, false, ranks);
    assert_int_equal(near.count, n);
    assert_int_equal(far.count, n);
    for (size_t i = 0; i < n; i++) c->place[i] = UINT32_MAX;
    for (size_t i = 0; i < n; i++) {
        assert_int_equal(c->place[near.pieces[i]], UINT32_MAX);
        c->place[near.pieces[i]] = (uint32_t)i;
        assert_int_equal(near.pieces[i], far.pieces[n - 1 - i]);
    }
    free(near.pieces), free(far.pieces);
}

static uint32_t check_eye(ray_case *c, uint32_t e, uint32_t rays, const uint32_t *ranks) {
    const froe_scene *s = c->tree->scene;
    const froe_eye eye = rays_eye(c->tree, e);
    uint32_t met = 0;
    check_order(c, &eye, ranks);
    rational_point_set(&c->from, s->dim, eye.at);
    if (eye.parallel) mpq_set_ui(c->from.w, 0, 1);
    for (uint32_t r = 0; r < rays; r++) {
        double to[3] = {0};
        for (int k = 0; k < s->dim; k++)
            to[k] = s->lo[k] + trees_unit(e + 9, 3 * r + (uint32_t)k) * (s->hi[k] - s->lo[k]);
        rational_point_set(&c->to, s->dim, to);
        met += check_ray(c, ranks);
    }
    return met;
}

static void check_scene(int dim, size_t count, uint32_t grid, double size, const char *method, uint32_t leaf) {
    froe_tree *tree = trees_grow(dim, dim == 2 ? FROE_SEGMENT : FROE_POLYGON, count, grid, size, method, leaf);
    ray_case c;
    uint32_t met = 0, *ranks = calloc(count, sizeof *ranks);
    for (uint32_t i = 0; i < count; i++) ranks[i] = trees_random(8, i, 1000000);
    open_case(&c, tree);
    for (uint32_t e = 0; e < 10; e++) met += check_eye(&c, e, 9, ranks);
    assert_true(met > 60);
    close_case(&c);
    free(ranks);
    froe_tree_free(tree);
}

static void random_triangles_are_in_order_along_every_ray(void **state) {
    (void)state;
    check_scene(3, 40, 0, 1, "density", 1);
    check_scene(3, 40, 0, 1, "autopartition", 0);
}

static void triangles_of_a_lattice_are_in_order_and_ranks_decide_in_planes(void **state) {
    (void)state;
    check_scene(3, 55, 3, 2, "density", 0);
    check_scene(3, 55, 2, 2, "density", 1);
    check_scene(3, 55, 2, 2, "autopartition", 1);
}

static void segments_in_the_plane_are_in_order(void **state) {
    (void)state;
    check_scene(2, 80, 0, 1, "density", 1);
    check_scene(2, 80, 4, 2, "density", 0);
}

static void orders_for_many_eyes_are_those_for_each(void **state) {
    (void)state;
    enum { EYES = 70 };
    froe_tree *tree = trees_grow(3, FROE_POLYGON, 200, 5, 0.6, "density", 1);
    const size_t n = froe_tree_piece_count(tree);
    froe_eye eyes[EYES];
    uint32_t *all = calloc(EYES * n, sizeof *all);
    for (uint32_t e = 0; e < EYES; e++) eyes[e] = rays_eye(tree, e);
    for (unsigned threads = 1; threads < 4; threads += 2) {
        froe_order_options o = froe_order_defaults();
        o.threads = threads;
        assert_int_equal(froe_tree_orders(tree, eyes, EYES, &o, all, NULL), FROE_OK);
        for (size_t e = 0; e < EYES; e++) {
            listing one = list_order(tree, eyes + e, false, NULL);
            assert_memory_equal(one.pieces, all + e * n, n * sizeof *all);
            free(one.pieces);
        }
    }
    free(all);
    froe_tree_free(tree);
}

static void a_visitor_may_stop(void **state) {
    (void)state;
    froe_tree *tree = trees_grow(3, FROE_POLYGON, 50, 0, 1, "density", 1);
    listing l = {calloc(froe_tree_piece_count(tree) + 1, sizeof(uint32_t)), 0, 7};
    const froe_eye eye = {.at = {1, 2, 3}};
    assert_int_equal(froe_tree_order(tree, &eye, NULL, keep, &l, NULL), FROE_OK);
    assert_int_equal(l.count, 7);
    free(l.pieces);
    froe_tree_free(tree);
}

static void refuse(const froe_tree *tree, froe_eye eye, const char *word, froe_status status) {
    uint32_t pieces[300];
    listing l = {pieces, 0, 0};
    froe_diagnostic why = {.message = ""};
    assert_int_equal(froe_tree_order(tree, &eye, NULL, keep, &l, &why), status);
    assert_non_null(strstr(why.message, word));
    assert_int_equal(froe_tree_orders(tree, &eye, 1, NULL, pieces, &why), status);
    assert_int_equal(l.count, 0);
}

typedef struct node_walk {
    const froe_tree *tree;
    uint32_t *open;  /* nodes that have begun and not ended */
    uint32_t *lists; /* nodes whose lists hold something, as they come */
    size_t depth, nodes, count, stop;
} node_walk;

/* A node begins within its parent, and its list and its end come while it is the last that is open. */
static bool walk_node(void *user, froe_node node, froe_order_stage stage) {
    node_walk *w = user;
    if (stage == FROE_ORDER_BEGIN) {
        if (w->depth) {
            const froe_node_info parent = froe_tree_node(w->tree, (froe_node){w->open[w->depth - 1]});
            assert_true(parent.child[0].id1 == node.id1 || parent.child[1].id1 == node.id1);
        }
        w->open[w->depth++] = node.id1;
        w->nodes++;
    } else
        assert_int_equal(w->open[w->depth - 1], node.id1);
    if (stage == FROE_ORDER_END) w->depth--;
    if (stage == FROE_ORDER_LIST && froe_tree_node(w->tree, node).piece_count) w->lists[w->count++] = node.id1 - 1;
    return w->nodes != w->stop;
}

/* The pieces of froe_tree_order(), list by list. */
static void nodes_come_in_the_order_of_their_pieces(void **state) {
    (void)state;
    froe_tree *tree = trees_grow(3, FROE_POLYGON, 60, 0, 0.5, "density", 1);
    ray_case c;
    open_case(&c, tree);
    for (uint32_t e = 0; e < 12; e++) {
        const froe_eye eye = rays_eye(tree, e / 2);
        froe_order_options o = froe_order_defaults();
        node_walk w = {.tree = tree};
        w.open = calloc(tree->node_count, sizeof *w.open);
        w.lists = calloc(tree->node_count, sizeof *w.lists);
        o.front_to_back = e % 2;
        assert_int_equal(froe_tree_order_nodes(tree, &eye, &o, walk_node, &w, NULL), FROE_OK);
        assert_int_equal(w.nodes, tree->node_count);
        assert_int_equal(w.depth, 0);
        listing l = list_order(tree, &eye, e % 2, NULL);
        size_t at = 0;
        for (size_t i = 0; i < l.count; i++) {
            if (i && c.home[l.pieces[i]] != w.lists[at]) at++;
            assert_int_equal(c.home[l.pieces[i]], w.lists[at]);
        }
        assert_int_equal(at + 1, w.count);
        w.stop = 3, w.nodes = w.depth = 0;
        assert_int_equal(froe_tree_order_nodes(tree, &eye, &o, walk_node, &w, NULL), FROE_OK);
        assert_int_equal(w.nodes, 3);
        free(w.open), free(w.lists), free(l.pieces);
    }
    close_case(&c);
    froe_tree_free(tree);
}

static void what_has_no_order_is_refused(void **state) {
    (void)state;
    froe_tree *tree = trees_grow(3, FROE_POLYGON, 30, 0, 1, "density", 1);
    refuse(tree, (froe_eye){.at = {0, (double)NAN, 0}}, "Coordinate 1", FROE_E_ARG);
    refuse(tree, (froe_eye){.at = {0, 0, 0}, .parallel = true}, "length 0", FROE_E_ARG);
    froe_tree_free(tree);
    tree = trees_grow(3, FROE_POLYGON, 30, 0, 1, "density", 4);
    refuse(tree, (froe_eye){.at = {0, 0, 3}}, "capacity of 1 or 0", FROE_E_UNSUPPORTED);
    froe_tree_free(tree);
    tree = trees_grow(3, FROE_BALL, 10, 0, 0.1, "density", 1);
    refuse(tree, (froe_eye){.at = {0, 0, 3}}, "ball", FROE_E_UNSUPPORTED);
    froe_tree_free(tree);
    tree = trees_grow(4, FROE_POINT, 10, 0, 0.1, "density", 1);
    refuse(tree, (froe_eye){.at = {0, 0, 3}}, "dimensions", FROE_E_UNSUPPORTED);
    froe_tree_free(tree);
}

static void an_empty_scene_has_an_empty_order(void **state) {
    (void)state;
    froe_tree *tree = trees_grow(3, FROE_POLYGON, 0, 0, 1, "density", 1);
    listing l = list_order(tree, &(froe_eye){.at = {1, 1, 1}}, true, NULL);
    assert_int_equal(l.count, 0);
    free(l.pieces);
    froe_tree_free(tree);
}

static bool any_node(void *user, froe_node node, froe_order_stage stage) {
    (void)user, (void)stage;
    return node.id1;
}

static froe_status order_with(void *user, const froe_allocator *alloc) {
    froe_scene *scene;
    froe_tree *tree = NULL;
    uint32_t pieces[8000];
    const froe_eye eyes[2] = {{.at = {1, 2, 3}}, {.at = {1, 2, 3}, .parallel = true}};
    listing l = {pieces, 0, 0};
    froe_build_options o = froe_build_defaults();
    o.threads = 1;
    (void)user;
    froe_status status = froe_scene_new(3, alloc, &scene);
    if (status) return status;
    status = trees_scatter(scene, FROE_POLYGON, 40, 3, 1, 1);
    if (!status) status = froe_build(scene, &o, &tree, NULL);
    if (!status) status = froe_tree_order(tree, eyes, NULL, keep, &l, NULL);
    if (!status) status = froe_tree_orders(tree, eyes, 2, NULL, pieces, NULL);
    if (!status) status = froe_tree_order_nodes(tree, eyes, NULL, any_node, NULL, NULL);
    froe_tree_free(tree);
    froe_scene_free(scene);
    return status;
}

static void every_allocation_may_fail(void **state) {
    (void)state;
    assert_true(test_memory_each(order_with, NULL) > 5);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_triangles_are_in_order_along_every_ray),
        cmocka_unit_test(triangles_of_a_lattice_are_in_order_and_ranks_decide_in_planes),
        cmocka_unit_test(segments_in_the_plane_are_in_order),
        cmocka_unit_test(orders_for_many_eyes_are_those_for_each),
        cmocka_unit_test(a_visitor_may_stop),
        cmocka_unit_test(nodes_come_in_the_order_of_their_pieces),
        cmocka_unit_test(what_has_no_order_is_refused),
        cmocka_unit_test(an_empty_scene_has_an_empty_order),
        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
