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
    tree_table *table;
    double *values[2]; /* per line: the value of the cut there, NaN: none yet */
    ARRAY(table_rect) stack;
} filling;

/* -------------------------------------------------------------------- grid -- */

/* ----------------------------------------------------------------- filling -- */

/* The cell with this number, or the nearest of from .. to. */
static uint32_t cell_between(double first, uint32_t from, uint32_t to) {
    if (!(first > from)) return from;
    return first < to ? (uint32_t)first : to;
}

static void fill_rect(filling *f, const table_rect *r, uint32_t ragged) {
    const tree_node *n = f->tree->nodes + r->node;
    tree_entry entry = {r->node, ragged};
    if (tree_is_leaf(n)) entry = (tree_entry){n->child, TABLE_LEAF | n->u.list.count};
    for (uint32_t i = r->from[0]; i < r->to[0]; i++)
        for (uint32_t j = r->from[1]; j < r->to[1]; j++) f->table->entries[(size_t)i * f->table->cells[1] + j] = entry;
}

/* Fills the cells whose cores the cut divides, and leaves the others to its children. */
static bool divide_rect(filling *f, const table_rect *r) {
    const tree_node *n = f->tree->nodes + r->node;
    const double place = tree_table_place(f->table, n->axis, n->u.value), line = floor(place + 0.5);
    /* the first cell whose core is not short of the cut, and the first whose core is beyond it */
    uint32_t middle = cell_between(ceil(place + TABLE_MARGIN) - 1, r->from[n->axis], r->to[n->axis]);
    uint32_t beyond = cell_between(floor(place - TABLE_MARGIN) + 1, middle, r->to[n->axis]);
    table_rect low = *r, high = *r, between = *r;
    if (line >= 0 && line <= f->table->cells[n->axis] && fabs(place - line) <= TABLE_MARGIN) {
        double *known = f->values[n->axis] + (size_t)line;
        if (isnan(*known)) *known = n->u.value;
        if (*known != n->u.value) f->table->crooked[n->axis][(size_t)line] = 1;
    }
    low.node = n->child, low.to[n->axis] = middle;
    high.node = n->child + 1, high.from[n->axis] = beyond;
    between.from[n->axis] = middle, between.to[n->axis] = beyond;
    bool all = middle == r->from[n->axis] && beyond == r->to[n->axis];
    fill_rect(f, &between, all ? 0 : TABLE_RAGGED);
    if (middle > r->from[n->axis] && !array_push(&f->tree->alloc, &f->stack, low)) return false;
    return beyond == r->to[n->axis] || array_push(&f->tree->alloc, &f->stack, high);
}

/* ------------------------------------------------------------------- whole -- */

static size_t cell_count(const tree_table *table) {
    return (size_t)table->cells[0] * table->cells[1];
}

/* Takes and fills the arrays of a table whose grid is known. False without memory. */
static bool fill_table(filling *f) {
    const froe_allocator *alloc = &f->tree->alloc;
    tree_table *table = f->table;
    table->entries = support_calloc(alloc, cell_count(table), sizeof *table->entries);
    bool room = table->entries;
    for (int k = 0; k < 2; k++) {
        table->crooked[k] = support_calloc(alloc, table->cells[k] + 1, 1);
        f->values[k] = support_calloc(alloc, table->cells[k] + 1, sizeof(double));
        room = room && table->crooked[k] && f->values[k];
        for (uint32_t i = 0; f->values[k] && i <= table->cells[k]; i++) f->values[k][i] = NAN;
    }
    table_rect all = {0, {0, 0}, {table->cells[0], table->cells[1]}};
    room = room && array_push(alloc, &f->stack, all);
    while (room && f->stack.count) {
        table_rect r = f->stack.data[--f->stack.count];
        if (tree_is_leaf(f->tree->nodes + r.node))
            fill_rect(f, &r, 0);
        else
            room = divide_rect(f, &r);
    }
    array_free(alloc, &f->stack);
    return room;
}

froe_status tree_table_new(const froe_tree *t, tree_table **out) {
    const froe_allocator *alloc = &t->alloc;
    double side[2], whole[2];
    *out = NULL;
    if (!tree_is_packed(t) || t->scene->dim != 2) return FROE_OK;
    for (int k = 0; k < 2; k++) {
        side[k] = whole[k] = t->meta.root_hi[k] - t->meta.root_lo[k];
        if (!(side[k] >= 0x1p-900 && side[k] <= 0x1p900)) return FROE_OK;
    }
    tree_table *table = support_calloc(alloc, 1, sizeof *table);
    if (!table) return FROE_E_MEMORY;
    table->cells[0] = table->cells[1] = 1;
    /* cells as the builder halves its cells: always the longer side */
    for (uint32_t bits = 0; bits < MOST_BITS && (2u << bits) <= t->node_count / 2 + 1; bits++) {
        int longer = side[1] > side[0];
        side[longer] *= 0.5;
        table->cells[longer] *= 2;
    }
    for (int k = 0; k < 2; k++) {
        table->lo[k] = t->meta.root_lo[k];
        table->scale[k] = table->cells[k] / whole[k];
    }
    filling f = {.tree = t, .table = table};
    bool filled = fill_table(&f);
    for (int k = 0; k < 2; k++) support_free(alloc, f.values[k], (table->cells[k] + 1) * sizeof(double));
    if (filled)
        *out = table;
    else
        tree_table_free(alloc, table);
    return filled ? FROE_OK : FROE_E_MEMORY;
}

void tree_table_free(const froe_allocator *alloc, tree_table *table) {
    if (!table) return;
    support_free(alloc, table->entries, cell_count(table) * sizeof *table->entries);
    for (int k = 0; k < 2; k++) support_free(alloc, table->crooked[k], table->cells[k] + 1);
    support_free(alloc, table, sizeof *table);
}

uint64_t tree_table_bytes(const tree_table *table) {
    return table ? cell_count(table) * sizeof *table->entries + table->cells[0] + table->cells[1] + 2 + sizeof *table
                 : 0;
}
