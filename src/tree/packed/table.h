/* table.h: a jump table over a packed tree: which node to begin with.
 *
 *        line 0     1     2     3         The root box is a grid of about as many cells as the tree has leaves; each
 *          +-----+--:--+-----+            cell names the lowest node whose region holds its core, the cell without a
 *          |  4  |  9  |  9  |            margin along its lines. Where a tree is cut in the middle the lines are its
 *          +-----+--:--+-----+            cuts, up to rounding, and the nodes about as deep as its leaves.
 *          |  5  |  6  |  7  |
 *          +-----+--:--+-----+
 *
 * g(x) = (x - lo) * scale is where x lies in the grid. It is monotone, rounded or not; that alone makes the table
 * right: x is in the core of cell i if i + MARGIN <= g(x) <= i + 1 - MARGIN, and then it is beyond every value v with
 * g(v) < i + MARGIN.
 *
 * Two cuts of different values within a margin of one line could have a cell between them that no core reaches. Such a
 * line is crooked, and what crosses it has to begin at the root. A cell whose node is cut where other cells of that
 * node are not is ragged: a rectangle with it and another node has to begin at the root, too. Along a line that is not
 * crooked, the regions of the cells on both sides meet in its one cut, or span it: so the nodes of a rectangle of cells
 * cover everything between its outer cores. */
#ifndef FROE_TREE_PACKED_TABLE_H
#define FROE_TREE_PACKED_TABLE_H
#include "tree/tree.h"

#define TABLE_MARGIN 0x1p-24

/** The node of a cell. Leaves are opened up, which saves their readers a cache miss, where their numbers fit. */
typedef struct tree_entry {
    uint32_t at;   /**< the node; of a leaf: its block */
    uint32_t kind; /**< TABLE_LEAF + its pieces; TABLE_RAGGED: nodes of other cells may lie below this one; or 0 */
} tree_entry;
#define TABLE_LEAF 0x80000000u
#define TABLE_RAGGED 1u

/** An entry as the table holds it. A table of half the size is in the caches more often.
 *
 *      31     30 .. 24   23 .. 0
 *     | 1 | pieces   | block     |     a leaf of fewer than 2^7 pieces, with a block below 2^24
 *     | 0 | ragged | node        |     30 bits */
typedef uint32_t table_entry;
enum { TABLE_PIECES_BITS = 7, TABLE_BLOCK_BITS = 24, TABLE_NODE_BITS = 30 };

/** A cell of the table as files hold it: its node, and TABLE_RAGGED_CELL. */
#define TABLE_RAGGED_CELL 0x80000000u

struct tree_table {
    double lo[2], scale[2];
    uint32_t cells[2];    /**< per axis, powers of 2 */
    table_entry *entries; /**< of cell (column, row): entries[column * cells[1] + row] */
    uint8_t *crooked[2];  /**< line -> bool; line i begins cell i */
};

/** How many cells and lines a tree has, none unless it is packed and its root box has a size that a grid can have; its
 * arrays are not made. O(1). */
table_cells tree_table_shape(const froe_tree *t);
/** Both from the nodes of the tree. FROE_E_MEMORY. O(nodes + cells). */
froe_status tree_table_cells(const froe_tree *t, table_cells *out);
void tree_table_cells_free(const froe_tree *t, table_cells *cells);

/** *out NULL: there is none, or there are 2^TABLE_NODE_BITS nodes or more. From the nodes alone. FROE_E_MEMORY.
 * O(nodes + cells). */
froe_status tree_table_new(const froe_tree *t, tree_table **out);
/** The same from cells of a file, of the shape that the tree has. FROE_E_FORMAT, without a sentence: a node does not
 * exist. O(cells). */
froe_status tree_table_from(const froe_tree *t, const table_cells *cells, tree_table **out);
void tree_table_free(const froe_allocator *alloc, tree_table *table);
/** Of the table that a tree has, once it is there. */
uint64_t tree_table_bytes(const froe_tree *t);

/** Where x lies in the grid; anything, NaN too, for an x outside. */
static inline double tree_table_place(const tree_table *table, int axis, double x) {
    return (x - table->lo[axis]) * table->scale[axis];
}
static inline tree_entry tree_table_at(const tree_table *table, uint32_t column, uint32_t row) {
    const table_entry entry = table->entries[(size_t)column * table->cells[1] + row];
    const uint32_t leaf = entry & TABLE_LEAF, bits = leaf ? TABLE_BLOCK_BITS : TABLE_NODE_BITS;
    return (tree_entry){entry & ((1u << bits) - 1), leaf | (entry & ~TABLE_LEAF) >> bits};
}
/** Columns or rows from .. to (included) that [lo, hi] reaches, or comes within a margin of. */
static inline void tree_table_span(const tree_table *table, int axis, double lo, double hi, uint32_t *from,
                                   uint32_t *to) {
    double a = tree_table_place(table, axis, lo) - TABLE_MARGIN, b = tree_table_place(table, axis, hi) + TABLE_MARGIN;
    uint32_t last = table->cells[axis] - 1;
    *from = a > 0 ? a < last ? (uint32_t)a : last : 0;
    *to = b > 0 ? b < last ? (uint32_t)b : last : 0;
}
#endif
