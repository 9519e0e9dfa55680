/* table.c: one walk over the upper part of the tree, each node with the rectangle of cells it is to serve. */
#include "tree/packed/table.h"
#include <math.h>
#include <string.h>

enum { MOST_BITS = 22 };

typedef struct table_rect {
    uint32_t node, from[2], to[2]; /* cells from .. to - 1 */
} table_rect;

typedef struct filling {
    const froe_tree *tree;
    const tree_table *grid; /* without arrays */
    table_cells *cells;
    double *values[2]; /* per line: the value of the cut there, NaN: none yet */
    ARRAY(table_rect) stack;
} filling;

/* -------------------------------------------------------------------- grid -- */

/* Lines and cells; false: there is no grid. */
static bool lay_grid(const froe_tree *t, tree_table *grid) {
    double side[2], whole[2];
    *grid = (tree_table){.cells = {1, 1}};
    if (!tree_is_packed(t) || t->scene->dim != 2) return false;
    for (int k = 0; k < 2; k++) {
        side[k] = whole[k] = t->meta.root_hi[k] - t->meta.root_lo[k];
        if (!(side[k] >= 0x1p-900 && side[k] <= 0x1p900)) return false;
    }
    /* cells as the builder halves its cells: always the longer side */
    for (uint32_t bits = 0; bits < MOST_BITS && (2u << bits) <= t->node_count / 2 + 1; bits++) {
        int longer = side[1] > side[0];
        side[longer] *= 0.5;
        grid->cells[longer] *= 2;
    }
    for (int k = 0; k < 2; k++) {
        grid->lo[k] = t->meta.root_lo[k];
        grid->scale[k] = grid->cells[k] / whole[k];
    }
    return true;
}

static size_t cell_count(const tree_table *table) {
    return (size_t)table->cells[0] * table->cells[1];
}

/* Where the lines of an axis begin. */
static size_t first_line(const tree_table *grid, int axis) {
    return axis ? (size_t)grid->cells[0] + 1 : 0;
}

/* ----------------------------------------------------------------- filling -- */

/* The cell with this number, or the nearest of from .. to. */
static uint32_t cell_between(double first, uint32_t from, uint32_t to) {
    if (!(first > from)) return from;
    return first < to ? (uint32_t)first : to;
}

static void fill_rect(filling *f, const table_rect *r, uint32_t ragged) {
    for (uint32_t i = r->from[0]; i < r->to[0]; i++)
        for (uint32_t j = r->from[1]; j < r->to[1]; j++)
            f->cells->nodes[(size_t)i * f->grid->cells[1] + j] = r->node | ragged;
}

/* Fills the cells whose cores the cut divides, and leaves the others to its children. */
static bool divide_rect(filling *f, const table_rect *r) {
    const tree_node *n = f->tree->nodes + r->node;
    const double place = tree_table_place(f->grid, n->axis, n->u.value), line = floor(place + 0.5);
    /* the first cell whose core is not short of the cut, and the first whose core is beyond it */
    uint32_t middle = cell_between(ceil(place + TABLE_MARGIN) - 1, r->from[n->axis], r->to[n->axis]);
    uint32_t beyond = cell_between(floor(place - TABLE_MARGIN) + 1, middle, r->to[n->axis]);
    table_rect low = *r, high = *r, between = *r;
    if (line >= 0 && line <= f->grid->cells[n->axis] && fabs(place - line) <= TABLE_MARGIN) {
        double *known = f->values[n->axis] + (size_t)line;
        if (isnan(*known)) *known = n->u.value;
        if (*known != n->u.value) f->cells->crooked[first_line(f->grid, n->axis) + (size_t)line] = 1;
    }
    low.node = n->child, low.to[n->axis] = middle;
    high.node = n->child + 1, high.from[n->axis] = beyond;
    between.from[n->axis] = middle, between.to[n->axis] = beyond;
    bool all = middle == r->from[n->axis] && beyond == r->to[n->axis];
    fill_rect(f, &between, all ? 0 : TABLE_RAGGED_CELL);
    if (middle > r->from[n->axis] && !array_push(&f->tree->alloc, &f->stack, low)) return false;
    return beyond == r->to[n->axis] || array_push(&f->tree->alloc, &f->stack, high);
}

/* Fills the arrays, which are zero. False without memory. */
static bool fill_cells(filling *f) {
    const froe_allocator *alloc = &f->tree->alloc;
    const tree_table *grid = f->grid;
    table_rect all = {0, {0, 0}, {grid->cells[0], grid->cells[1]}};
    bool room = array_push(alloc, &f->stack, all);
    for (int k = 0; k < 2; k++) {
        f->values[k] = support_calloc(alloc, grid->cells[k] + 1, sizeof(double));
        room = room && f->values[k];
        for (uint32_t i = 0; f->values[k] && i <= grid->cells[k]; i++) f->values[k][i] = NAN;
    }
    while (room && f->stack.count) {
        table_rect r = f->stack.data[--f->stack.count];
        if (tree_is_leaf(f->tree->nodes + r.node))
            fill_rect(f, &r, 0);
        else
            room = divide_rect(f, &r);
    }
    for (int k = 0; k < 2; k++) support_free(alloc, f->values[k], (grid->cells[k] + 1) * sizeof(double));
    array_free(alloc, &f->stack);
    return room;
}

/* ------------------------------------------------------------------- cells -- */

table_cells tree_table_shape(const froe_tree *t) {
    tree_table grid;
    if (!lay_grid(t, &grid)) return (table_cells){NULL, NULL, 0, 0};
    return (table_cells){NULL, NULL, cell_count(&grid), (uint64_t)grid.cells[0] + grid.cells[1] + 2};
}

froe_status tree_table_cells(const froe_tree *t, table_cells *out) {
    tree_table grid;
    *out = tree_table_shape(t);
    if (!out->count) return FROE_OK;
    lay_grid(t, &grid);
    out->nodes = support_calloc(&t->alloc, out->count, sizeof *out->nodes);
    out->crooked = support_calloc(&t->alloc, out->lines, 1);
    filling f = {.tree = t, .grid = &grid, .cells = out};
    if (out->nodes && out->crooked && fill_cells(&f)) return FROE_OK;
    tree_table_cells_free(t, out);
    return FROE_E_MEMORY;
}

void tree_table_cells_free(const froe_tree *t, table_cells *cells) {
    support_free(&t->alloc, cells->nodes, cells->count * sizeof *cells->nodes);
    support_free(&t->alloc, cells->crooked, cells->lines);
    *cells = (table_cells){NULL, NULL, 0, 0};
}

/* ------------------------------------------------------------------- whole -- */

static table_entry entry_of(const froe_tree *t, uint32_t node, bool ragged) {
    const tree_node *n = t->nodes + node;
    if (!tree_is_leaf(n)) return (uint32_t)ragged << TABLE_NODE_BITS | node;
    const bool fits = n->u.list.count >> TABLE_PIECES_BITS == 0 && n->child >> TABLE_BLOCK_BITS == 0;
    return fits ? TABLE_LEAF | n->u.list.count << TABLE_BLOCK_BITS | n->child : node;
}

/* False: a node does not exist. */
static bool open_cells(const froe_tree *t, const table_cells *cells, tree_table *table) {
    for (size_t i = 0; i < cells->count; i++) {
        const uint32_t node = cells->nodes[i] & ~TABLE_RAGGED_CELL, ragged = cells->nodes[i] & TABLE_RAGGED_CELL;
        if (node >= t->node_count) return false;
        table->entries[i] = entry_of(t, node, ragged);
    }
    return true;
}

froe_status tree_table_from(const froe_tree *t, const table_cells *cells, tree_table **out) {
    const froe_allocator *alloc = &t->alloc;
    tree_table grid;
    *out = NULL;
    if (!lay_grid(t, &grid) || t->node_count >> TABLE_NODE_BITS) return FROE_OK;
    tree_table *table = support_calloc(alloc, 1, sizeof *table);
    if (!table) return FROE_E_MEMORY;
    *table = grid;
    table->entries = support_calloc(alloc, cells->count, sizeof *table->entries);
    bool room = table->entries;
    for (int k = 0; k < 2; k++) {
        table->crooked[k] = support_calloc(alloc, (size_t)table->cells[k] + 1, 1);
        room = room && table->crooked[k];
        if (table->crooked[k])
            memcpy(table->crooked[k], cells->crooked + first_line(&grid, k), (size_t)table->cells[k] + 1);
    }
    const froe_status status = !room ? FROE_E_MEMORY : open_cells(t, cells, table) ? FROE_OK : FROE_E_FORMAT;
    if (status)
        tree_table_free(alloc, table);
    else
        *out = table;
    return status;
}

froe_status tree_table_new(const froe_tree *t, tree_table **out) {
    table_cells cells;
    *out = NULL;
    froe_status status = tree_table_cells(t, &cells);
    if (!status) status = tree_table_from(t, &cells, out);
    tree_table_cells_free(t, &cells);
    return status;
}

void tree_table_free(const froe_allocator *alloc, tree_table *table) {
    if (!table) return;
    support_free(alloc, table->entries, cell_count(table) * sizeof *table->entries);
    for (int k = 0; k < 2; k++) support_free(alloc, table->crooked[k], (size_t)table->cells[k] + 1);
    support_free(alloc, table, sizeof *table);
}

uint64_t tree_table_bytes(const froe_tree *t) {
    const table_cells shape = tree_table_shape(t);
    return shape.count ? shape.count * sizeof(table_entry) + shape.lines + sizeof(tree_table) : 0;
}
