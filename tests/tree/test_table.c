/* test_table.c: what searches begin with, the table of cells of the plane and the wide nodes of space, of trees that
 * files may hold although no builder makes them. */
#include "tree/packed/packed_audit.h"
#include "tree/packed/space.h"
#include "tree/packed/table.h"
#include "tree/packed/wide.h"
#include "trees.h"
#include <math.h>

static froe_tree *packed_tree(int dim) {
    return trees_grow(dim, dim == 2 ? FROE_SEGMENT : FROE_POLYGON, 200, 0, 0.1, "index", 6);
}

/* The node of a cell by going down from the root; FROE_NONE: a cut divides the cell. */
static uint32_t node_of_cell(const froe_tree *t, const tree_table *table, const uint32_t cell[2]) {
    uint32_t node = 0;
    while (!tree_is_leaf(t->nodes + node)) {
        const tree_node *n = t->nodes + node;
        const double place = tree_table_place(table, n->axis, n->u.value);
        if (place > cell[n->axis] + TABLE_MARGIN && place < cell[n->axis] + 1 - TABLE_MARGIN) return FROE_NONE;
        node = n->child + (place <= cell[n->axis] + 0.5);
    }
    return node;
}

static void assert_cells(const froe_tree *tree) {
    tree_table *table;
    table_cells cells;
    assert_int_equal(tree_table_new(tree, &table), FROE_OK);
    assert_int_equal(tree_table_cells(tree, &cells), FROE_OK);
    assert_true(cells.count >= 32);
    for (uint32_t i = 0; i < cells.count; i++) {
        const uint32_t cell[2] = {i / table->cells[1], i % table->cells[1]}, node = node_of_cell(tree, table, cell);
        if (node != FROE_NONE) assert_int_equal(cells.nodes[i] & ~TABLE_RAGGED_CELL, node);
    }
    tree_table_cells_free(tree, &cells);
    tree_table_free(&tree->alloc, table);
}

static uint64_t crooked_lines(const froe_tree *tree) {
    table_cells cells;
    uint64_t crooked = 0;
    assert_int_equal(tree_table_cells(tree, &cells), FROE_OK);
    for (uint64_t i = 0; i < cells.lines; i++) crooked += cells.crooked[i];
    tree_table_cells_free(tree, &cells);
    return crooked;
}

/* A cut beyond the root box, on one side or the other: all cells are on its other side, no line is crooked, and the
 * audit refuses it, as one that lies in a side of its cell. */
static void cuts_beyond_the_root_box_divide_no_cell(void **state) {
    (void)state;
    froe_tree *tree = packed_tree(2);
    tree_node *root = tree->nodes;
    const tree_node right = *root;
    const double *const sides[2] = {tree->meta.root_lo, tree->meta.root_hi};
    assert_cells(tree);
    tree_table *table;
    assert_int_equal(tree_table_new(tree, &table), FROE_OK);
    const double cells[2] = {1 / table->scale[0], 1 / table->scale[1]};
    tree_table_free(&tree->alloc, table);
    for (int i = 0; i < 16; i++) { /* whole cells */
        const int far = i / 4, upper = i / 2 % 2;
        uint32_t node;
        const char *why;
        root->axis = i % 2 ? 1 : 0;
        root->u.value = sides[upper][root->axis] + (upper ? far : -far) * cells[root->axis];
        assert_cells(tree);
        assert_int_equal(crooked_lines(tree), 0);
        assert_int_equal(packed_frame_refuted(tree, &node, &why), FROE_OK);
        assert_string_equal(why, "a cut that does not divide its cell");
        assert_int_equal(node, 0);
    }
    *root = right;
    froe_tree_free(tree);
}

/* Two cuts on one line of the grid, of which one is moved a little: only then the line is crooked. */
static void lines_of_two_cuts_are_crooked(void **state) {
    (void)state;
    froe_tree *tree = packed_tree(2);
    uint32_t moved = 0;
    for (uint32_t i = 1; i < tree->node_count && !moved; i++) /* another cut at the same place of the same axis */
        for (uint32_t j = 0; j < i && !moved; j++) {
            const tree_node *a = tree->nodes + i, *b = tree->nodes + j;
            if (!tree_is_leaf(a) && !tree_is_leaf(b) && a->axis == b->axis && a->u.value == b->u.value) moved = i;
        }
    assert_true(moved > 0);
    for (int turn = 0; turn < 2; turn++) {
        assert_int_equal(crooked_lines(tree), turn);
        tree->nodes[moved].u.value = nextafter(tree->nodes[moved].u.value, INFINITY);
    }
    froe_tree_free(tree);
}

/* No memory is taken for cells beyond the most, nor for a table of nodes whose numbers do not fit. */
static void tables_have_a_most_of_cells_and_of_nodes(void **state) {
    (void)state;
    froe_tree *tree = packed_tree(2), large = *tree;
    tree_table *table;
    const uint64_t counts[3] = {UINT64_C(1) << 22, UINT64_C(1) << 24, UINT32_MAX};
    for (int i = 0; i < 3; i++) {
        large.node_count = (uint32_t)counts[i];
        assert_int_equal(tree_table_shape(&large).count, i ? UINT64_C(1) << 22 : UINT64_C(1) << 21);
    }
    const table_cells none = {NULL, NULL, 0, 0};
    large.node_count = 1u << TABLE_NODE_BITS;
    assert_int_equal(tree_table_from(&large, &none, &table), FROE_OK);
    assert_null(table);
    froe_tree_free(tree);
}

/* Leaves without objects: two beside each other, and all. Wide nodes lead to the other leaves, and to each once. */
static void wide_nodes_leave_out_what_is_empty(void **state) {
    (void)state;
    froe_tree *tree = packed_tree(3);
    for (int turn = 0; turn < 3; turn++) {
        uint32_t full = 0, led = 0;
        for (uint32_t i = 1; i < tree->node_count; i += 2) { /* siblings */
            const tree_node *n = tree->nodes + i;
            if (turn < 2 && !(turn == 1 && i % 3 == 0 && tree_is_leaf(n) && tree_is_leaf(n + 1))) continue;
            for (int side = 0; side < 2; side++)
                if (tree_is_leaf(n + side)) ((space_header *)(uintptr_t)space_block(tree, n[side].child))->count = 0;
        }
        for (uint32_t i = 0; i < tree->node_count; i++)
            if (tree_is_leaf(tree->nodes + i)) full += space_block(tree, tree->nodes[i].child)->count > 0;
        tree_wide *wide;
        assert_int_equal(tree_wide_new(tree, &wide), FROE_OK);
        assert_non_null(wide);
        for (size_t i = 0; i < wide->count; i++)
            for (uint32_t c = 0; c < wide->nodes[i].count; c++) {
                const uint32_t child = wide->nodes[i].child[c];
                if (!(child & WIDE_LEAF)) continue;
                assert_true(space_block(tree, child & ~WIDE_LEAF)->count > 0);
                led++;
            }
        assert_int_equal(led, full);
        assert_int_equal(full > 0, turn < 2);
        tree_wide_free(&tree->alloc, wide);
    }
    froe_tree_free(tree);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cuts_beyond_the_root_box_divide_no_cell),
        cmocka_unit_test(lines_of_two_cuts_are_crooked),
        cmocka_unit_test(tables_have_a_most_of_cells_and_of_nodes),
        cmocka_unit_test(wide_nodes_leave_out_what_is_empty),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
