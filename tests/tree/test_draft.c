/* test_draft.c: drafts and sealing, by hand-made and by random trees. */
#include "tree/validate.h"
#include "trees.h"

/* Two crossing segments: the first is the root's cut, the second lies on both sides of it. */
static froe_scene *cross(const froe_allocator *alloc) {
    static const double coords[8] = {0, 0, 4, 0, 1, -1, 3, 1};
    froe_scene *scene = NULL;
    if (froe_scene_new(2, alloc, &scene)) return NULL;
    if (trees_add(scene, FROE_SEGMENT, 2, coords, NULL, NULL)) {
        froe_scene_free(scene);
        return NULL;
    }
    return scene;
}

static froe_status fill_cross(tree_draft *draft) {
    const froe_cut cut = {.kind = FROE_CUT_OBJECT, .id = {0}};
    const uint32_t below[2] = {0, TREE_EDGE_CUT | 0}, above[2] = {TREE_EDGE_CUT | 0, 1};
    uint32_t child;
    froe_status status = draft_split(draft, 0, &cut, 0, &child);
    if (!status) status = draft_list(draft, 0);
    if (!status) status = draft_piece(draft, 0, 0, NULL, 0);
    if (status) return status;
    draft_leaf(draft, child, 0);
    draft_leaf(draft, child + 1, 0);
    status = draft_list(draft, child + 1); /* lists come in any order */
    if (!status) status = draft_piece(draft, child + 1, 1, above, 2);
    if (!status) status = draft_list(draft, child);
    return status ? status : draft_piece(draft, child, 1, below, 2);
}

static const tree_meta meta = {.method = "by hand", .leaf = 1};

static froe_status grow_cross(froe_scene *scene, const froe_allocator *alloc, froe_tree **tree) {
    tree_draft draft;
    froe_status status = draft_new(alloc, 2, 0, &draft);
    if (status) return status;
    status = fill_cross(&draft);
    if (!status) status = draft_seal(&draft, NULL, 0, scene, &meta, tree);
    draft_free(&draft);
    return status;
}

static void a_hand_made_tree_reads_as_it_was_made(void **state) {
    (void)state;
    froe_scene *scene = cross(NULL);
    froe_tree *tree;
    assert_int_equal(grow_cross(scene, NULL, &tree), FROE_OK);
    froe_scene_free(scene); /* the tree holds it */
    froe_node_info root = froe_tree_node(tree, froe_tree_root(tree));
    assert_int_equal(root.cut.kind, FROE_CUT_OBJECT);
    assert_int_equal(root.cut.id[0], 0);
    assert_int_equal(root.piece_count, 1);
    froe_node_info below = froe_tree_node(tree, root.child[0]), above = froe_tree_node(tree, root.child[1]);
    assert_int_equal(below.cut.kind, FROE_CUT_NONE);
    assert_int_equal(below.child[0].id1, 0);
    assert_int_equal(below.first_piece, 1);
    assert_int_equal(above.first_piece, 2);
    assert_true(froe_tree_piece(tree, 0).whole);
    assert_false(froe_tree_piece(tree, 1).whole);
    froe_report r = froe_tree_report(tree);
    assert_int_equal(r.nodes, 3);
    assert_int_equal(r.leaves, 2);
    assert_int_equal(r.fragments, 3);
    assert_int_equal(r.in_cut, 1);
    assert_int_equal(r.size, 6);
    assert_int_equal(r.height, 1);
    assert_int_equal(r.max_leaf, 1);
    assert_true(r.mean_depth == 2.0 / 3);
    assert_string_equal(r.method, "by hand");
    assert_null(r.promises[0].name);
    froe_tree_free(tree);
}

static void corners_of_pieces_tell_points_and_what_made_them(void **state) {
    (void)state;
    froe_scene *scene = cross(NULL);
    froe_tree *tree;
    assert_int_equal(grow_cross(scene, NULL, &tree), FROE_OK);
    froe_scene_free(scene);
    const double below[4] = {1, -1, 2, 0}, above[4] = {2, 0, 3, 1};
    double x[4];
    froe_node made[2];
    assert_int_equal(froe_tree_piece_corners(tree, 1, x, made, 2), 2);
    assert_memory_equal(x, below, sizeof x);
    assert_int_equal(made[0].id1, 0);
    assert_int_equal(made[1].id1, 1);
    assert_int_equal(froe_tree_piece_corners(tree, 2, x, made, 2), 2);
    assert_memory_equal(x, above, sizeof x);
    assert_int_equal(made[0].id1, 1);
    assert_int_equal(froe_tree_piece_corners(tree, 0, NULL, NULL, 0), 2);
    x[2] = 99;
    assert_int_equal(froe_tree_piece_corners(tree, 2, x, NULL, 1), 2); /* no more than there is room for */
    assert_true(x[2] == 99);
    assert_int_equal(froe_tree_piece_corners(tree, 3, x, NULL, 1), 0);
    froe_tree_free(tree);
}

static void nodes_and_pieces_that_do_not_exist_are_none(void **state) {
    (void)state;
    froe_scene *scene = cross(NULL);
    froe_tree *tree;
    assert_int_equal(grow_cross(scene, NULL, &tree), FROE_OK);
    froe_scene_free(scene);
    assert_int_equal(froe_tree_node(tree, (froe_node){0}).cut.kind, FROE_CUT_NONE);
    assert_int_equal(froe_tree_node(tree, (froe_node){4}).piece_count, 0);
    assert_int_equal(froe_tree_piece(tree, 3).object, FROE_NONE);
    froe_tree_free(tree);
    froe_tree_free(NULL);
}

static void every_kind_of_cut_survives_sealing(void **state) {
    (void)state;
    froe_scene *scene;
    froe_tree *tree;
    tree_draft draft;
    const double triangle[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0}, normal[3] = {1, 2, 3};
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_POLYGON, 1, triangle, NULL, NULL), FROE_OK);
    const froe_cut cuts[] = {
        {.kind = FROE_CUT_AXIS, .axis = 2, .value = -7},        {.kind = FROE_CUT_OBJECT, .id = {0}},
        {.kind = FROE_CUT_VERTICES, .id = {2, 0, 1}},           {.kind = FROE_CUT_EDGE, .id = {1, 2}},
        {.kind = FROE_CUT_PLANE, .normal = normal, .value = 6}, {.kind = FROE_CUT_AXIS, .axis = 1, .value = 5}};
    assert_int_equal(draft_new(NULL, 3, 0, &draft), FROE_OK);
    uint32_t node = 0, child;
    for (size_t i = 0; i < 6; i++, node = child + 1) {
        assert_int_equal(draft_split(&draft, node, cuts + i, i == 0 ? TREE_GUARD : 0, &child), FROE_OK);
        if (i == 5) assert_int_equal(draft_list(&draft, node), FROE_OK); /* moves the cut to the table */
    }
    assert_int_equal(draft_seal(&draft, NULL, 0, scene, &meta, &tree), FROE_OK);
    draft_free(&draft);
    froe_scene_free(scene);
    assert_int_equal(tree_validate(tree, NULL), FROE_OK);
    froe_node at = froe_tree_root(tree);
    for (size_t i = 0; i < 6; i++) {
        froe_node_info info = froe_tree_node(tree, at);
        assert_int_equal(info.cut.kind, cuts[i].kind);
        assert_int_equal(info.cut.axis, cuts[i].axis);
        assert_true(info.cut.value == cuts[i].value);
        assert_memory_equal(info.cut.id, cuts[i].id, sizeof info.cut.id);
        assert_int_equal(info.guard, i == 0);
        if (cuts[i].normal) assert_memory_equal(info.cut.normal, normal, sizeof normal);
        at = info.child[1];
    }
    assert_int_equal(froe_tree_node(tree, at).cut.kind, FROE_CUT_NONE);
    assert_int_equal(tree->cut_count, 5);
    froe_tree_free(tree);
}

/* ------------------------------------------------------------ random trees -- */

/* The tree is a function of paths alone; how it is grown is not: newest or oldest cell first, with
 * the subtrees of some cells in drafts of their own, or after another subtree that is removed. */
typedef struct cell {
    uint32_t node, depth, above; /* in its draft; an ancestor, ring numbering */
    uint64_t path;
    tree_draft *draft;
} cell;
typedef struct growing {
    froe_allocator alloc;
    bool oldest_first, own_drafts, detours;
    tree_draft main, drafts[16];
    tree_graft grafts[16];
    size_t graft_count;
    ARRAY(cell) cells;
} growing;

enum { OBJECTS = 5, GRAFT_DEPTH = 3, MOST_DEPTH = 9 };

static uint32_t ring_number(const cell *c) {
    return c->node + c->draft->outer;
}

static froe_status random_list(const cell *c, bool inner) {
    uint32_t count = trees_random(c->path, 1, 4);
    froe_status status = !count && inner ? FROE_OK : draft_list(c->draft, c->node);
    for (uint32_t i = 0; i < count && !status; i++) {
        uint32_t ring[2] = {0, TREE_EDGE_CUT | c->above};
        bool whole = c->depth == 0 || trees_random(c->path, 10 + i, 2);
        status = draft_piece(c->draft, c->node, trees_random(c->path, 20 + i, OBJECTS), whole ? NULL : ring, 2);
    }
    return status;
}

/* Opens a draft for a cell of the main one. */
static froe_status move_out(growing *g, cell *c) {
    tree_draft *draft = g->drafts + g->graft_count;
    froe_status status = draft_new(&g->alloc, 2, (uint32_t)g->main.nodes.count, draft);
    if (status) return status;
    draft_leaf(c->draft, c->node, 0);
    g->grafts[g->graft_count++] = (tree_graft){c->node, draft};
    c->draft = draft;
    c->node = 0;
    return FROE_OK;
}

static froe_status grow_cell(growing *g, cell c) {
    static const double normal[2] = {1, 2}, rows[2 * 3] = {1, 3, 5, 0.5, -0.25, 0.125};
    froe_cut cut = {.kind = FROE_CUT_AXIS, .axis = (int)(c.depth % 2), .value = trees_unit(c.path, 2)};
    if (trees_random(c.path, 3, 4) == 0)
        cut = (froe_cut){.kind = FROE_CUT_OBJECT, .id = {trees_random(c.path, 4, OBJECTS)}};
    if (trees_random(c.path, 3, 8) == 1) cut = (froe_cut){.kind = FROE_CUT_PLANE, .normal = normal, .value = 3};
    if (trees_random(c.path, 3, 8) == 2) cut = (froe_cut){.kind = FROE_CUT_FINE, .id = {2}, .normal = rows};
    if (c.depth >= MOST_DEPTH || (c.depth > 2 && trees_random(c.path, 5, 4) == 0)) {
        draft_leaf(c.draft, c.node, 0);
        return random_list(&c, false);
    }
    cell child[2];
    froe_status status = draft_split(c.draft, c.node, &cut, 0, &child[0].node);
    for (uint32_t s = 0; s < 2 && !status; s++) {
        child[s] = (cell){child[0].node + s, c.depth + 1, ring_number(&c), base_path(c.path, (int)s), c.draft};
        if (!array_push(&g->alloc, &g->cells, child[s])) status = FROE_E_MEMORY;
    }
    return status ? status : random_list(&c, true);
}

static froe_status grow_below(growing *g, cell root) {
    const size_t others = g->cells.count;
    froe_status status = array_push(&g->alloc, &g->cells, root) ? FROE_OK : FROE_E_MEMORY;
    while (g->cells.count > others && !status) status = grow_cell(g, g->cells.data[--g->cells.count]);
    return status;
}

/** Grows a cell after another subtree in its place, which is removed then. */
static froe_status grow_after_detour(growing *g, cell c) {
    cell other = c;
    const tree_draft_mark from = draft_mark(c.draft);
    other.path = base_path(c.path, 2);
    froe_status status = grow_below(g, other);
    if (status) return status;
    const tree_draft_mark to = draft_mark(c.draft);
    c.draft->nodes.data[c.node] = (tree_node){0};
    status = grow_below(g, c);
    if (!status) draft_remove(c.draft, &from, &to, c.node);
    return status;
}

static froe_status grow_by_way(growing *g, cell c) {
    const bool detour = g->detours && c.depth == GRAFT_DEPTH + (uint32_t)g->own_drafts;
    return detour ? grow_after_detour(g, c) : grow_cell(g, c);
}

static froe_status grow_cells(growing *g) {
    froe_status status = draft_new(&g->alloc, 2, 0, &g->main);
    if (status) return status;
    if (!array_push(&g->alloc, &g->cells, (cell){.path = 1, .draft = &g->main})) return FROE_E_MEMORY;
    /* first all of the main draft, which the others count from */
    for (size_t done = 0; done < g->cells.count && !status; done++) {
        size_t at = done;
        cell c = g->cells.data[at];
        if (g->own_drafts && c.depth == GRAFT_DEPTH) continue;
        status = grow_by_way(g, c);
        g->cells.data[at].draft = NULL;
        if (!g->oldest_first && !status) { /* bring the newest unfinished one forward */
            cell newest = g->cells.data[g->cells.count - 1];
            if (g->cells.count > done + 1) {
                g->cells.data[g->cells.count - 1] = g->cells.data[done + 1];
                g->cells.data[done + 1] = newest;
            }
        }
    }
    for (size_t i = 0; i < g->cells.count && !status; i++) {
        cell c = g->cells.data[i];
        if (!c.draft) continue;
        if (c.draft == &g->main) status = move_out(g, &c);
        if (!status) status = grow_by_way(g, c);
    }
    return status;
}

enum { OLDEST_FIRST = 1, OWN_DRAFTS = 2, DETOURS = 4, WAYS = 8 };

static froe_status grow_random(int way, froe_scene *scene, const froe_allocator *alloc, froe_tree **tree) {
    growing g = {.alloc = support_allocator(alloc),
                 .oldest_first = way & OLDEST_FIRST,
                 .own_drafts = way & OWN_DRAFTS,
                 .detours = way & DETOURS};
    froe_status status = grow_cells(&g);
    if (!status) status = draft_seal(&g.main, g.grafts, g.graft_count, scene, &meta, tree);
    if (g.main.nodes.data) draft_free(&g.main);
    for (size_t i = 0; i < g.graft_count; i++) draft_free(g.drafts + i);
    array_free(&g.alloc, &g.cells);
    return status;
}

static void sealing_depends_on_the_shape_alone(void **state) {
    (void)state;
    froe_scene *scene = trees_scene(2, FROE_SEGMENT, OBJECTS, 0, 1, 3);
    froe_tree *tree[WAYS];
    for (int i = 0; i < WAYS; i++) assert_int_equal(grow_random(i, scene, NULL, tree + i), FROE_OK);
    froe_scene_free(scene);
    assert_true(tree[0]->node_count > 100 && tree[0]->normal_count > 10);
    froe_diagnostic why;
    for (int i = 0; i < WAYS; i++) {
        if (tree_validate(tree[i], &why)) fail_msg("%s", why.message);
        trees_assert_equal(tree[0], tree[i]);
    }
    for (int i = 0; i < WAYS; i++) froe_tree_free(tree[i]);
}

/* A chain of cuts, each below the last, so that more nodes wait than an array begins with. */
static froe_status sealing_a_chain(void *user, const froe_allocator *alloc) {
    enum { DEPTH = 40 };
    tree_draft draft;
    froe_tree *tree = NULL;
    uint32_t node = 0;
    froe_status status = draft_new(alloc, 2, 0, &draft);
    if (status) return status;
    for (uint32_t i = 0; i < DEPTH && !status; i++) {
        const froe_cut cut = {.kind = FROE_CUT_AXIS, .value = -(double)i};
        status = draft_split(&draft, node, &cut, 0, &node);
    }
    if (!status) status = draft_seal(&draft, NULL, 0, user, &meta, &tree);
    draft_free(&draft);
    if (!status) assert_int_equal(froe_tree_report(tree).height, DEPTH);
    froe_tree_free(tree);
    return status;
}

static froe_status sealing(void *user, const froe_allocator *alloc) {
    (void)user;
    froe_scene *scene = NULL;
    froe_tree *tree = NULL;
    froe_status status = froe_scene_new(2, alloc, &scene);
    if (!status) status = trees_scatter(scene, FROE_SEGMENT, OBJECTS, 0, 1, 3);
    if (!status) status = grow_random(OLDEST_FIRST | OWN_DRAFTS | DETOURS, scene, alloc, &tree);
    froe_scene_free(scene);
    froe_tree_free(tree);
    return status;
}

static void any_allocation_may_fail(void **state) {
    (void)state;
    assert_true(test_memory_each(sealing, NULL) > 30);
    froe_scene *scene = trees_scene(2, FROE_SEGMENT, OBJECTS, 0, 1, 3);
    assert_true(test_memory_each(sealing_a_chain, scene) > 10);
    froe_scene_free(scene);
}

static void a_deep_chain_needs_no_stack(void **state) {
    (void)state;
    enum { DEPTH = 1000000 };
    froe_scene *scene = trees_scene(2, FROE_SEGMENT, OBJECTS, 0, 1, 3);
    for (uint32_t side = 0; side < 2; side++) {
        tree_draft draft;
        froe_tree *tree;
        uint32_t node = 0, child;
        assert_int_equal(draft_new(NULL, 2, 0, &draft), FROE_OK);
        for (uint32_t i = 0; i < DEPTH; i++, node = child + side) {
            froe_cut cut = {.kind = FROE_CUT_AXIS, .value = i};
            assert_int_equal(draft_split(&draft, node, &cut, 0, &child), FROE_OK);
        }
        assert_int_equal(draft_seal(&draft, NULL, 0, scene, &meta, &tree), FROE_OK);
        draft_free(&draft);
        assert_int_equal(froe_tree_report(tree).height, DEPTH);
        assert_int_equal(tree_validate(tree, NULL), FROE_OK);
        froe_tree_free(tree);
    }
    froe_scene_free(scene);
}

static void more_nodes_than_numbers_are_refused(void **state) {
    (void)state;
    tree_draft draft;
    uint32_t child = 5;
    const froe_cut cut = {.kind = FROE_CUT_AXIS};
    assert_int_equal(draft_new(NULL, 2, 0x7ffffffcu, &draft), FROE_OK);
    assert_int_equal(draft_split(&draft, 0, &cut, 0, &child), FROE_E_LIMIT);
    assert_int_equal(child, 5);
    draft_free(&draft);
}

static void promises_left_open_are_measured(void **state) {
    (void)state;
    froe_scene *scene = cross(NULL);
    tree_meta promising = {.promise_count = 3,
                           .promises = {{"height", 9, 0}, {"fragments", 9, 0}, {"guard_load", 9, 2}}};
    tree_draft draft;
    froe_tree *tree;
    assert_int_equal(draft_new(NULL, 2, 0, &draft), FROE_OK);
    assert_int_equal(fill_cross(&draft), FROE_OK);
    assert_int_equal(draft_seal(&draft, NULL, 0, scene, &promising, &tree), FROE_OK);
    froe_report r = froe_tree_report(tree);
    assert_true(r.promises[0].measured == 1 && r.promises[1].measured == 3 && r.promises[2].measured == 2);
    assert_null(r.promises[3].name);
    draft_free(&draft);
    froe_scene_free(scene);
    froe_tree_free(tree);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_hand_made_tree_reads_as_it_was_made),
        cmocka_unit_test(corners_of_pieces_tell_points_and_what_made_them),
        cmocka_unit_test(nodes_and_pieces_that_do_not_exist_are_none),
        cmocka_unit_test(every_kind_of_cut_survives_sealing),
        cmocka_unit_test(sealing_depends_on_the_shape_alone),
        cmocka_unit_test(any_allocation_may_fail),
        cmocka_unit_test(a_deep_chain_needs_no_stack),
        cmocka_unit_test(more_nodes_than_numbers_are_refused),
        cmocka_unit_test(promises_left_open_are_measured),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
