/* Covers: the audit finds those that do not contain the region of their node, those of objects listed again below, and
 * objects that are listed nowhere. Trees by hand, and trees of builders. */
#include "audits.h"
#include "tree/list.h"
#include <math.h>

/* A piece of the list of a node; covers first. */
typedef struct listed {
    uint32_t node, object;
    bool cover;
} listed;

/* Boxes 0: around all of the cell of node 3; 1: within it. 2: a flat one on x = 4, above that cell.
 *
 *     x = 0: node 1 | 2         node 2 by x = 4: 3 | 4        node 3 by y = 0: 5 | 6       6 by y = 4: 7 | 8
 */
static froe_tree *covers_by_hand(const double *outer, const listed *list, size_t count, uint32_t leaf) {
    static const froe_cut cuts[] = {{.kind = FROE_CUT_AXIS, .axis = 0, .value = 0},
                                    {.kind = FROE_CUT_AXIS, .axis = 0, .value = 4},
                                    {.kind = FROE_CUT_AXIS, .axis = 1, .value = 0},
                                    {.kind = FROE_CUT_AXIS, .axis = 1, .value = 4},
                                    {.kind = FROE_CUT_AXIS, .axis = 0, .value = 2}};
    static const uint32_t splits[] = {0, 2, 3, 6, 7}; /* 7: x = 2, within 0 .. 4 on both axes: 9 | 10 */
    const double coords[12] = {outer[0], outer[1], outer[2], outer[3], 1, 1, 2, 3, 4, 6, 4, 7};
    const tree_meta meta = {.method = "by hand", .leaf = leaf};
    tree_draft draft;
    froe_tree *tree;
    froe_scene *scene;
    uint32_t child;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_BOX, 3, coords, NULL, NULL), FROE_OK);
    assert_int_equal(draft_new(NULL, 2, 0, &draft), FROE_OK);
    for (size_t i = 0; i < sizeof splits / sizeof *splits; i++)
        assert_int_equal(draft_split(&draft, splits[i], cuts + i, 0, &child), FROE_OK);
    for (size_t i = 0; i < count; i++) {
        if (!i || list[i].node != list[i - 1].node) assert_int_equal(draft_list(&draft, list[i].node), FROE_OK);
        const froe_status status = list[i].cover ? draft_cover(&draft, list[i].node, list[i].object)
                                                 : draft_piece(&draft, list[i].node, list[i].object, NULL, 0);
        assert_int_equal(status, FROE_OK);
    }
    assert_int_equal(draft_seal(&draft, NULL, 0, scene, &meta, &tree), FROE_OK);
    draft_free(&draft);
    froe_scene_free(scene);
    return tree;
}

static void judge(froe_tree *tree, const char *what) {
    if (what)
        assert_wrong(tree, what);
    else
        assert_right(tree);
    froe_tree_free(tree);
}

static const double square[4] = {0, 0, 4, 4};
static const listed right[] = {{7, 0, true}, {9, 1, false}, {2, 2, false}};

static void a_cover_is_listed_once_for_all_that_is_below(void **state) {
    (void)state;
    const double inner[4] = {-1, -1, 5, 9};
    const listed below[] = {{9, 0, true}, {9, 1, false}, {10, 0, false}, {2, 2, false}};
    froe_tree *tree = covers_by_hand(square, right, 3, 1);
    const froe_report r = froe_tree_report(tree);
    const froe_node_info info = froe_tree_node(tree, (froe_node){8});
    assert_true(r.fragments == 3 && r.covers == 1 && r.in_cut == 1);
    assert_true(info.cut.kind == FROE_CUT_AXIS && info.piece_count == 1 && info.cover_count == 1);
    judge(tree, NULL);
    judge(covers_by_hand(square, below, 4, 1), NULL); /* it need not be listed as high as it could */
    judge(covers_by_hand(inner, right, 3, 1), "no piece where the object is"); /* it is in other cells, too */
}

static void a_cover_that_does_not_contain_its_region_is_found(void **state) {
    (void)state;
    for (int side = 0; side < 4; side++) { /* too small by one number */
        double less[4] = {0, 0, 4, 4};
        less[side] = nextafter(less[side], 2);
        judge(covers_by_hand(less, right, 3, 1), "a cover that does not contain the region of the node");
    }
    const listed high[] = {{6, 0, true}, {9, 1, false}, {2, 2, false}};
    const listed root[] = {{0, 0, true}, {9, 1, false}, {2, 2, false}};
    const listed small[] = {{7, 0, true}, {9, 1, true}, {2, 2, false}};
    const listed flat[] = {{2, 2, true}, {7, 0, true}, {9, 1, false}};
    judge(covers_by_hand(square, high, 3, 1), "a cover that does not contain the region of the node");
    judge(covers_by_hand(square, root, 3, 1), "a cover that does not contain the region of the node");
    judge(covers_by_hand(square, small, 3, 1), "a cover that does not contain the region of the node");
    judge(covers_by_hand(square, flat, 3, 1), "a cover that does not contain the region of the node");
}

static void an_object_listed_twice_or_lost_is_found(void **state) {
    (void)state;
    const listed lost[] = {{9, 1, false}, {2, 2, false}};
    const listed twice[] = {{7, 0, true}, {7, 0, true}, {9, 1, false}, {2, 2, false}};
    const listed as_both[] = {{7, 0, true}, {7, 0, false}, {9, 1, false}, {2, 2, false}};
    const listed below[] = {{7, 0, true}, {9, 0, false}, {9, 1, false}, {2, 2, false}};
    const listed again[] = {{7, 0, true}, {9, 0, true}, {9, 1, false}, {2, 2, false}};
    const listed elsewhere[] = {{7, 0, true}, {9, 1, false}, {2, 2, false}, {8, 0, true}};
    judge(covers_by_hand(square, lost, 2, 1), "no piece where the object is");
    judge(covers_by_hand(square, twice, 4, 1), "two pieces of the object");
    judge(covers_by_hand(square, as_both, 4, 1), "two pieces of the object");
    judge(covers_by_hand(square, below, 4, 1), "a piece where the object is not");
    judge(covers_by_hand(square, again, 4, 1), "a piece where the object is not");
    judge(covers_by_hand(square, elsewhere, 4, 1), "a piece where the object is not");
}

/* Covers of a leaf do not count as a load. */
static void leaves_have_room_for_what_is_not_a_cover(void **state) {
    (void)state;
    const listed leaf[] = {{9, 0, true}, {9, 1, false}, {10, 0, true}, {2, 2, false}};
    const listed full[] = {{9, 0, false}, {9, 1, false}, {10, 0, true}, {2, 2, false}};
    judge(covers_by_hand(square, leaf, 4, 1), NULL);
    judge(covers_by_hand(square, full, 4, 1), "The leaf has 2 pieces, and room for 1.");
    froe_tree *tree = covers_by_hand(square, leaf, 4, 1);
    for (uint32_t i = 0; i < tree->node_count; i++)
        if (tree_list(tree, i).count == 2) tree->nodes[i].flags = TREE_INSEPARABLE, tree->report.inseparable = 1;
    judge(tree, "It is called inseparable, but is not over capacity");
}

/* Each cover of a tree made a piece of its own list, or shifted to a child, is found, whatever the builder. */
static void covers_of_builders_are_proved(void **state) {
    static const char *const methods[] = {"directional", "density", "kd", "grid", "quad", "paterson_yao", "bar"};
    (void)state;
    for (size_t m = 0; m < sizeof methods / sizeof *methods; m++) {
        froe_scene *scene = trees_scene(3, FROE_BOX, 12, 6, 0.4, 7);
        double around[6] = {-40, -40, -40, 40, 40, 40};
        for (int i = 0; i < 12; i++) {
            assert_int_equal(trees_add(scene, FROE_BOX, 1, around, NULL, NULL), FROE_OK);
            for (int k = 0; k < 6; k++) around[k] += k < 3 ? 1.5 : -1.25;
        }
        froe_tree *tree = trees_build(scene, methods[m], 1);
        uint64_t met = 0;
        assert_right(tree);
        for (uint32_t i = 0; i < tree->node_count; i++) {
            tree_node *n = tree->nodes + i;
            if (n->type != TREE_TABLED || !n->u.covers) continue;
            n->u.covers--, tree->report.covers--, tree->report.in_cut++;
            assert_wrong(tree, "The audit finds");
            n->u.covers++, tree->report.covers++, tree->report.in_cut--;
            met++;
        }
        if (strcmp(methods[m], "bar") != 0) assert_true(met > 5);
        froe_tree_free(tree);
        froe_scene_free(scene);
    }
}

int main(void) {
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_cover_is_listed_once_for_all_that_is_below),
        cmocka_unit_test(a_cover_that_does_not_contain_its_region_is_found),
        cmocka_unit_test(an_object_listed_twice_or_lost_is_found),
        cmocka_unit_test(leaves_have_room_for_what_is_not_a_cover),
        cmocka_unit_test(covers_of_builders_are_proved),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
