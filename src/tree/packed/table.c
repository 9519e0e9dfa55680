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

/* Cells as the builder halves its cells: always the longer side, `bits` times. */
static void shape_grid(tree_table *table, const froe_tree *t, uint32_t bits) {
    double side[2];
    for (int k = 0; k < 2; k++) {
        side[k] = t->meta.root_hi[k] - t->meta.root_lo[k];
        table->lo[k] = t->meta.root_lo[k];
        table->cells[k] = 1;
    }
    double whole[2] = {side[0], side[1]};
    for (; bits; bits--) {
        int longer = side[1] > side[0];
        side[longer] *= 0.5;
        table->cells[longer] *= 2;
    }
    for (int k = 0; k < 2; k++) table->scale[k] = table->cells[k] / whole[k];
}

static uint32_t bits_for(const froe_tree *t) {
    uint32_t bits = 0;
    while (bits < MOST_BITS && (2u << bits) <= t->node_count / 2 + 1) bits++;
    return bits;
}

static bool grid_fits(const froe_tree *t) {
    for (int k = 0; k < 2; k++) {
        double side = t->meta.root_hi[k] - t->meta.root_lo[k];
        if (!(side >= 0x1p-900 && side <= 0x1p900)) return false;
    }
    return tree_is_packed(t) && t->scene->dim == 2;
}

/* ----------------------------------------------------------------- filling -- */

static void fill_rect(filling *f, const table_rect *r, uint32_t ragged) {
    const tree_node *n = f->tree->nodes + r->node;
    tree_entry entry = {r->node, ragged};
    if (tree_is_leaf(n)) entry = (tree_entry){n->child, TABLE_LEAF | n->u.list.count};
    for (uint32_t i = r->from[0]; i < r->to[0]; i++)
        for (uint32_t j = r->from[1]; j < r->to[1]; j++) f->table->entries[(size_t)i * f->table->cells[1] + j] = entry;
}

/* Notes a cut within a hair of a line. */
static void note_line(filling *f, int axis, double place, double value) {
    double line = floor(place + 0.5);
    if (!(line >= 0 && line <= f->table->cells[axis]) || fabs(place - line) > TABLE_HAIR) return;
    double *known = f->values[axis] + (size_t)line;
    if (isnan(*known)) *known = value;
    if (*known != value) f->table->crooked[axis][(size_t)line] = 1;
}

/* The first cell from `from` on whose core is beyond the cut at this place. */
static uint32_t first_beyond(double place, uint32_t from, uint32_t to) {
    double first = floor(place - TABLE_HAIR) + 1;
    if (!(first > from)) return from;
    return first < to ? (uint32_t)first : to;
}

/* The first cell whose core is not short of it. */
static uint32_t first_not_short(double place, uint32_t from, uint32_t to) {
    double first = ceil(place + TABLE_HAIR) - 1;
    if (!(first > from)) return from;
    return first < to ? (uint32_t)first : to;
}

/* Fills the cells whose cores the cut divides, and leaves the others to its children. */
static bool divide_rect(filling *f, const table_rect *r) {
    const tree_node *n = f->tree->nodes + r->node;
    double place = tree_table_place(f->table, n->axis, n->u.value);
    uint32_t middle = first_not_short(place, r->from[n->axis], r->to[n->axis]);
    uint32_t beyond = first_beyond(place, middle, r->to[n->axis]);
    table_rect low = *r, high = *r, between = *r;
    note_line(f, n->axis, place, n->u.value);
    low.node = n->child, low.to[n->axis] = middle;
    high.node = n->child + 1, high.from[n->axis] = beyond;
    between.from[n->axis] = middle, between.to[n->axis] = beyond;
    bool all = middle == r->from[n->axis] && beyond == r->to[n->axis];
    fill_rect(f, &between, all ? 0 : TABLE_RAGGED);
    if (middle > r->from[n->axis] && !array_push(&f->tree->alloc, &f->stack, low)) return false;
    return beyond == r->to[n->axis] || array_push(&f->tree->alloc, &f->stack, high);
}

static froe_status fill_all(filling *f) {
    table_rect all = {0, {0, 0}, {f->table->cells[0], f->table->cells[1]}};
    bool room = array_push(&f->tree->alloc, &f->stack, all);
    while (room && f->stack.count) {
        table_rect r = f->stack.data[--f->stack.count];
        if (tree_is_leaf(f->tree->nodes + r.node))
            fill_rect(f, &r, 0);
        else
            room = divide_rect(f, &r);
    }
    array_free(&f->tree->alloc, &f->stack);
    return room ? FROE_OK : FROE_E_MEMORY;
}

/* ------------------------------------------------------------------- whole -- */

static size_t cell_count(const tree_table *table) {
    return (size_t)table->cells[0] * table->cells[1];
}

static froe_status take_table(filling *f) {
    const froe_allocator *alloc = &f->tree->alloc;
    tree_table *table = f->table;
    table->entries = support_calloc(alloc, cell_count(table), sizeof *table->entries);
    for (int k = 0; k < 2; k++) {
        table->crooked[k] = support_calloc(alloc, table->cells[k] + 1, 1);
        f->values[k] = support_calloc(alloc, table->cells[k] + 1, sizeof(double));
        for (uint32_t i = 0; f->values[k] && i <= table->cells[k]; i++) f->values[k][i] = NAN;
    }
    return table->entries && table->crooked[0] && table->crooked[1] && f->values[0] && f->values[1] ? FROE_OK
                                                                                                    : FROE_E_MEMORY;
}

froe_status tree_table_new(const froe_tree *t, tree_table **out) {
    const froe_allocator *alloc = &t->alloc;
    *out = NULL;
    if (!grid_fits(t)) return FROE_OK;
    tree_table *table = support_calloc(alloc, 1, sizeof *table);
    if (!table) return FROE_E_MEMORY;
    filling f = {.tree = t, .table = table};
    shape_grid(table, t, bits_for(t));
    froe_status status = take_table(&f);
    if (!status) status = fill_all(&f);
    for (int k = 0; k < 2; k++) support_free(alloc, f.values[k], (table->cells[k] + 1) * sizeof(double));
    if (status)
        tree_table_free(alloc, table);
    else
        *out = table;
    return status;
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
