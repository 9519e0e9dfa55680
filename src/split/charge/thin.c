/* thin.c: see thin.h. */
#include "split/charge/thin.h"
#include "base/sort.h"
#include "split/cell.h"
#include "split/guard/guards.h"
#include <string.h>

enum { THIN_MOST = 8 };

static bool may_go_on(const split_thin_notes *notes) {
    return notes->after <= THIN_MOST * notes->before;
}

/* ------------------------------------------------------------------ guards -- */

/* Guards are seen from an input vertex, by differences of input coordinates, and cuts run through input vertices. So
 * wherever a scene lies they are the same. */

static const double *origin_of(const split_set *set, const split_cell *cell) {
    return scene_point(set->scene, set->items.data[cell->first].object, 0);
}

/** Half the difference, which never overflows. */
static double half_way(double from, double to) {
    return 0.5 * to - 0.5 * from;
}

/** The different vertices of the box of a fragment, half way from the origin; returns how many. */
static size_t guards_of(const split_set *set, const split_fragment *f, const double *origin, double *out) {
    const size_t dim = (size_t)set->scene->dim;
    const double *first = scene_point(set->scene, f->object, 0);
    double lo[FROE_MAX_DIM] = {0}, hi[FROE_MAX_DIM] = {0};
    for (uint32_t i = 0; i < split_corner_count(set, f); i++) {
        const split_corner k = split_corner_of(set, f, i);
        const bool made = k.type != SPLIT_VERTEX;
        for (size_t a = 0; a < dim; a++) {
            const double x = made ? half_way(origin[a], first[a]) + 0.5 * k.apart[a] : half_way(origin[a], k.x[a]);
            lo[a] = !i || x < lo[a] ? x : lo[a];
            hi[a] = !i || x > hi[a] ? x : hi[a];
        }
    }
    return guards_of_box((int)dim, lo, hi, out);
}

/** Of ascending coordinates the one nearest to a place half way from the origin. */
static double nearest(const double *x, size_t count, double origin, double place) {
    size_t low = 0, high = count - 1;
    while (low < high) {
        const size_t middle = (low + high) / 2;
        if (half_way(origin, x[middle]) < place)
            low = middle + 1;
        else
            high = middle;
    }
    if (low && place - half_way(origin, x[low - 1]) <= half_way(origin, x[low]) - place) low--;
    return x[low];
}

/** Moves the planes of the guard tree to the nearest vertices of the cell's objects. `x` has room for all of these. */
static void move_to_vertices(split_work *work, const split_cell *cell, const double *origin, double *x) {
    const froe_scene *scene = work->set.scene;
    const split_fragment *items = work->set.items.data + cell->first;
    split_guard_node *nodes = work->thin.nodes.data;
    for (int axis = 0; axis < scene->dim; axis++) {
        size_t count = 0;
        for (uint32_t i = 0; i < cell->count; i++)
            for (uint32_t k = 0; k < scene_corners(scene, items[i].object); k++)
                x[count++] = scene_point(scene, items[i].object, k)[axis];
        base_sort(x, count, sizeof *x, base_compare_doubles);
        for (size_t i = 0; i < work->thin.nodes.count; i++)
            if (nodes[i].child && nodes[i].axis == axis)
                nodes[i].value = nearest(x, count, origin[axis], nodes[i].value);
    }
}

/** Makes the guard tree of the cell's fragments. */
static froe_status plant_guards(const split_thin_rule *rule, split_work *work, const split_cell *cell) {
    const split_set *set = &work->set;
    const froe_allocator *alloc = &set->alloc;
    const split_fragment *items = set->items.data + cell->first;
    const double *origin = origin_of(set, cell);
    const size_t dim = (size_t)set->scene->dim;
    const split_guard_options options = {.dim = (int)dim, .k = rule->guards, .form = SPLIT_FORM_U};
    ARRAY(double) guards = {0};
    size_t corners = 0;
    base_task task; /* on this thread alone: other cells are thinned out on others at the same time */
    base_task_init(&task, 1, NULL, NULL);
    for (uint32_t i = 0; i < cell->count; i++) corners += scene_corners(set->scene, items[i].object);
    bool room = array_reserve(alloc, &guards, ((size_t)cell->count * dim << dim) + corners);
    for (uint32_t i = 0; room && i < cell->count; i++)
        guards.count += dim * guards_of(set, items + i, origin, guards.data + guards.count);
    split_guard_tree_free(alloc, &work->thin);
    froe_status status = room ? FROE_OK : FROE_E_MEMORY;
    if (room) status = split_guard_tree_build(alloc, &task, 0, &options, guards.data, guards.count / dim, &work->thin);
    if (!status) move_to_vertices(work, cell, origin, guards.data);
    array_free(alloc, &guards);
    return status;
}

/* -------------------------------------------------------------------- cuts -- */

/** Cells that are left by the guards are charged no more. */
static void go_on_by(const split_work *work, split_cell *cell, uint32_t node) {
    cell->growth = 0;
    cell->thin = cell->count && work->thin.nodes.data[node].child ? node + 1 : 0;
}

froe_status thin_cut(split_work *work, const split_cell *cell) {
    const split_thin_rule none = {0};
    const split_guard_node *node = work->thin.nodes.data + cell->thin - 1;
    const froe_cut cut = {.kind = FROE_CUT_AXIS, .axis = node->axis, .value = node->value};
    cell_limits limits = {.thin = &none};
    froe_status status = cell_cut(work, cell, &cut, TREE_CHARGED, &limits);
    if (!status && !limits.kept) { /* two planes were moved to one vertex */
        split_cell whole = *cell;
        go_on_by(work, &whole, node->child + (work->set.classes.data[0] == SPLIT_POS));
        return array_push(&work->set.alloc, &work->cells, whole) ? FROE_OK : FROE_E_MEMORY;
    }
    for (uint32_t s = 0; s < 2 && !status; s++)
        go_on_by(work, work->cells.data + work->cells.count - 1 - s, node->child + s);
    return status;
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
