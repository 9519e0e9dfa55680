/* thin.c: see thin.h. */
#include "split/charge/thin.h"
#include "split/cell.h"
#include "split/guard/guards.h"
#include <string.h>

enum { THIN_MOST = 8 };

static bool may_go_on(const split_thin_notes *notes) {
    return notes->after <= THIN_MOST * notes->before;
}

/* ------------------------------------------------------------------ guards -- */

/** The different vertices of the box of a fragment; returns how many. */
static size_t guards_of(const split_set *set, const split_fragment *f, double *out) {
    const size_t dim = (size_t)set->scene->dim;
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    memcpy(lo, split_image(set, f, 0), dim * sizeof *lo);
    memcpy(hi, lo, dim * sizeof *hi);
    for (uint32_t i = 1; i < split_corner_count(set, f); i++) {
        const double *x = split_image(set, f, i);
        for (size_t a = 0; a < dim; a++) {
            lo[a] = x[a] < lo[a] ? x[a] : lo[a];
            hi[a] = x[a] > hi[a] ? x[a] : hi[a];
        }
    }
    return guards_of_box((int)dim, lo, hi, out);
}

/** Makes the guard tree of the cell's fragments. */
static froe_status plant_guards(const split_thin_rule *rule, split_work *work, const split_cell *cell) {
    const split_set *set = &work->set;
    const froe_allocator *alloc = &set->alloc;
    const size_t dim = (size_t)set->scene->dim;
    const split_guard_options options = {.dim = (int)dim, .k = rule->guards, .form = SPLIT_FORM_U};
    ARRAY(double) guards = {0};
    base_task task; /* on this thread alone: other cells are thinned out on others at the same time */
    base_task_init(&task, 1, NULL, NULL);
    bool room = array_reserve(alloc, &guards, (size_t)cell->count * dim << dim);
    for (uint32_t i = 0; room && i < cell->count; i++)
        guards.count += dim * guards_of(set, set->items.data + cell->first + i, guards.data + guards.count);
    split_guard_tree_free(alloc, &work->thin);
    froe_status status = room ? FROE_OK : FROE_E_MEMORY;
    if (room) status = split_guard_tree_build(alloc, &task, 0, &options, guards.data, guards.count / dim, &work->thin);
    array_free(alloc, &guards);
    return status;
}

/* -------------------------------------------------------------------- cuts -- */

froe_status thin_cut(split_work *work, const split_cell *cell) {
    const split_guard_node *node = work->thin.nodes.data + cell->thin - 1;
    const froe_cut cut = {.kind = FROE_CUT_AXIS, .axis = node->axis, .value = node->value};
    froe_status status = cell_cut(work, cell, &cut, TREE_CHARGED, NULL);
    if (status) return status;
    split_cell *negative = work->cells.data + work->cells.count - 1;
    for (uint32_t s = 0; s < 2; s++) {
        split_cell *side = negative - s;
        const uint32_t child = node->child + s;
        side->growth = 0;
        side->thin = side->count && work->thin.nodes.data[child].child ? child + 1 : 0;
    }
    return FROE_OK;
}

/** Makes all cuts below the cell, and forgets each cell that is left as soon as it is counted. */
static froe_status count_cells(split_work *work, const split_cell *root, split_thin_notes *notes) {
    split_set *set = &work->set;
    const size_t pending = work->cells.count, pieces = set->draft->pieces.count;
    froe_status status = array_push(&set->alloc, &work->cells, *root) ? FROE_OK : FROE_E_MEMORY;
    for (uint32_t turn = 0; !status && work->cells.count > pending && may_go_on(notes); turn++) {
        const split_cell cell = work->cells.data[--work->cells.count];
        set->corners.count = cell.corner_top;
        if (turn % 64 == 63 && !split_go_on(work)) status = FROE_E_CANCELLED;
        if (cell.thin && !status) status = thin_cut(work, &cell);
        if (cell.thin) continue;
        notes->after += cell.count;
        notes->largest = cell.count > notes->largest ? cell.count : notes->largest;
        set->items.count = cell.first;
    }
    work->cells.count = pending;
    notes->after += set->draft->pieces.count - pieces;
    return status;
}

/** Counts, and takes back what was made for that. */
static froe_status count_ahead(split_work *work, const split_cell *root, split_thin_notes *notes) {
    split_set *set = &work->set;
    const froe_allocator *alloc = &set->alloc;
    const tree_draft_mark before = draft_mark(set->draft);
    ARRAY(split_fragment) items = {0};
    bool room = array_append(alloc, &items, set->items.data + root->first, root->count);
    froe_status status = room ? count_cells(work, root, notes) : FROE_E_MEMORY;
    if (room) {
        draft_cut_back(set->draft, &before, root->node - set->draft->outer);
        set->items.count = root->first;
        set->corners.count = root->corner_top;
        if (!array_append(alloc, &set->items, items.data, items.count)) status = FROE_E_MEMORY;
    }
    array_free(alloc, &items);
    return status;
}

froe_status thin_begin(const split_thin_rule *rule, split_work *work, const split_cell *cell, bool *begun) {
    split_cell root = *cell;
    root.thin = 1;
    root.thinned = true;
    *begun = false;
    froe_status status = plant_guards(rule, work, cell);
    if (status || !work->thin.nodes.data[0].child) return status;
    split_thin_notes notes = {.before = cell->count, .height = work->thin.height};
    status = count_ahead(work, &root, &notes);
    if (status || !may_go_on(&notes)) return status;
    thin_add_up(&work->thinned, &notes);
    *begun = array_push(&work->set.alloc, &work->cells, root);
    return *begun ? FROE_OK : FROE_E_MEMORY;
}

void thin_add_up(split_thin_notes *sum, const split_thin_notes *notes) {
    sum->before += notes->before;
    sum->after += notes->after;
    sum->height = notes->height > sum->height ? notes->height : sum->height;
    sum->largest = notes->largest > sum->largest ? notes->largest : sum->largest;
}
