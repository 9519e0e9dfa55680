/* subtree.c: cells of grids, then cells of fragments, one after the other, depth first. */
#include "build/index/subtree.h"
#include "build/index/halve.h"
#include <math.h>
#include <string.h>

enum { BARREN = 2, LONELY = 3, AHEAD = 16 };

/* --------------------------------------------------------------- fragments -- */

static froe_status end_packed_leaf(index_work *w, const index_cell *cell) {
    const build_job *job = w->plan->job;
    const uint8_t flags = cell->count > job->leaf ? TREE_CROWDED : 0;
    const packed_fragment *fragments = w->items.data + cell->first;
    if (job->max_fragments && (uint64_t)w->packer->piece_count + cell->count > job->max_fragments) return FROE_E_BUDGET;
    w->items.count = cell->first;
    return packer_leaf(w->packer, cell->node, &cell->box, fragments, cell->count, flags);
}

/* One more fragment, for which there is room: the part of an object in a box, or, not shared, the whole of it. */
static inline void put_fragment(index_work *w, uint32_t id, const packed_box *box) {
    packed_fragment *out = w->items.data + w->items.count++;
    if (id & GRID_SHARED)
        axis_clip(w->axis, id & PACKED_OBJECT, box, out);
    else
        *out = axis_whole(w->axis, id);
}

/* The fragments of a node of the uppermost grid, each object once. */
static froe_status fill_cell(index_work *w, index_cell *cell) {
    const index_layer *layer = w->layers.data + w->layers.count - 1;
    const uint32_t *ids = layer->part.ids.data, level = layer->grid->upper + grid_level(cell->heap);
    const uint32_t from = grid_first(layer->grid, &layer->part, cell->heap);
    const uint32_t to = grid_end(layer->grid, &layer->part, cell->heap);
    if (!array_reserve(&w->plan->job->alloc, &w->items, to - from)) return FROE_E_MEMORY;
    cell->first = (uint32_t)w->items.count;
    for (uint32_t i = from; i < to; i++) {
        if (i + AHEAD < layer->part.ids.count) __builtin_prefetch(w->axis->ends + (ids[i + AHEAD] & PACKED_OBJECT));
        if (layer->part.since.data[i] <= level) put_fragment(w, ids[i], &cell->box);
    }
    cell->count = (uint32_t)w->items.count - cell->first;
    cell->heap = 0;
    return FROE_OK;
}

/* Bounds of the fragments' images. */
static packed_box contents(const packed_fragment *f, uint32_t count) {
    packed_box box = {{f->p[0], f->p[1]}, {f->p[0], f->p[1]}};
    for (uint32_t i = 0; i < count; i++)
        for (int k = 0; k < 2; k++) {
            double a = f[i].p[k], b = f[i].q[k];
            box.lo[k] = fmin(box.lo[k], fmin(a, b));
            box.hi[k] = fmax(box.hi[k], fmax(a, b));
        }
    return box;
}

/* ----------------------------------------------------------------- one cut -- */

static void halves(const index_cell *cell, int axis, double value, index_cell side[2]) {
    for (uint32_t i = 0; i < 2; i++) {
        side[i] = *cell;
        side[i].depth++;
        (i ? side[i].box.lo : side[i].box.hi)[axis] = value;
    }
}

double subtree_halve(const split_grid *g, const index_cell *cell, uint32_t level, const uint32_t *count,
                     index_cell side[2]) {
    const uint32_t axis = g->axis[level], middle = cell->line[axis] + (1u << g->rest[level][axis] >> 1);
    const double sum = (double)count[2 * cell->heap] + count[2 * cell->heap + 1];
    halves(cell, (int)axis, g->lines[axis][middle], side);
    side[1].line[axis] = middle;
    for (uint32_t i = 0; i < 2; i++) {
        side[i].heap = 2 * cell->heap + i;
        side[i].growth = cell->growth * sum / count[cell->heap];
    }
    return g->lines[axis][middle];
}

/* Splits the node of a cell whose sides are known otherwise; the negative child last, so that it comes first. */
static froe_status split_index_node(index_work *w, const index_cell *cell, int axis, double value, index_cell side[2]) {
    const froe_allocator *alloc = &w->plan->job->alloc;
    uint32_t child;
    froe_status status = packer_split(w->packer, cell->node, axis, value, &child);
    if (status) return status;
    side[0].node = child;
    side[1].node = child + 1;
    return array_push(alloc, &w->cells, side[1]) && array_push(alloc, &w->cells, side[0]) ? FROE_OK : FROE_E_MEMORY;
}

/* A cut beside the contents, where the cell has more room than they are large; false: nowhere. */
static bool shrink_cut(const index_cell *cell, const packed_fragment *f, halve_cut *cut) {
    packed_box box = contents(f, cell->count);
    double size = fmax(box.hi[0] - box.lo[0], box.hi[1] - box.lo[1]), most = 2 * size;
    if (!(size > 0)) return false;
    for (int k = 0; k < 2; k++) {
        double below = box.lo[k] - cell->box.lo[k], above = cell->box.hi[k] - box.hi[k];
        if (below > most) *cut = (halve_cut){.axis = k, .value = box.lo[k] - 0.173 * size}, most = below;
        if (above > most) *cut = (halve_cut){.axis = k, .value = box.hi[k] + 0.191 * size}, most = above;
    }
    return most > 2 * size;
}

/* The middle of the middles of fragments along the longer side of their box. REQUIRES: room for twice as many. */
static void median_cut(index_work *w, const index_cell *cell, const packed_fragment *f, halve_cut *cut) {
    packed_box box = contents(f, cell->count);
    size_t n = cell->count;
    cut->axis = box.hi[1] - box.lo[1] > box.hi[0] - box.lo[0];
    for (uint32_t i = 0; i < n; i++)
        w->middles.data[i] = (base_pair){base_double_key(0.5 * f[i].p[cut->axis] + 0.5 * f[i].q[cut->axis]), i};
    base_radix_sort(w->middles.data, w->middles.data + n, n);
    const packed_fragment *middle = f + w->middles.data[n / 2].value;
    cut->value = 0.5 * middle->p[cut->axis] + 0.5 * middle->q[cut->axis];
}

static halve_cut middle_cut(const packed_box *box, int axis) {
    return (halve_cut){.axis = axis, .value = 0.5 * box->lo[axis] + 0.5 * box->hi[axis]};
}

static bool count_sides(index_work *w, const index_cell *cell, halve_cut *cut, int which) {
    return halve_count(w->axis, &cell->box, w->items.data + cell->first, cell->count, cut, w->classes[which].data);
}

/* Is it time for medians? */
static bool is_deep(const index_work *w, const index_cell *cell) {
    return w->plan->height > 0 && cell->depth > w->plan->height;
}

/* Names the cut of a cell; false: it is to be a leaf. */
static bool choose_halving(index_work *w, const index_cell *cell, halve_cut *cut, int *which) {
    const packed_fragment *f = w->items.data + cell->first;
    *which = 0;
    if (cell->growth >= w->plan->growth || cell->barren >= BARREN) return false;
    if (cell->lonely >= LONELY && shrink_cut(cell, f, cut) && count_sides(w, cell, cut, 0)) return true;
    if (is_deep(w, cell)) {
        median_cut(w, cell, f, cut);
        if (count_sides(w, cell, cut, 0)) return true;
    }
    /* The middle cut across the longer side, or the other one where that divides most fragments; false where both
     * divide all. *which: whose classes. */
    const double *lo = cell->box.lo, *hi = cell->box.hi;
    int axis = 0.5 * hi[1] - 0.5 * lo[1] > 0.5 * hi[0] - 0.5 * lo[0];
    halve_cut other = middle_cut(&cell->box, 1 - axis);
    *cut = middle_cut(&cell->box, axis);
    *which = 0;
    bool found = count_sides(w, cell, cut, 0);
    if (found && 2 * (uint64_t)cut->both <= cell->count) return true;
    if (count_sides(w, cell, &other, 1) && (!found || other.both < cut->both)) *cut = other, *which = 1, found = true;
    return found && cut->both < cell->count;
}

/* One cut of a cell of fragments; a leaf, where none pays. */
static froe_status halve_cell(index_work *w, const index_cell *cell) {
    const froe_allocator *alloc = &w->plan->job->alloc;
    halve_cut cut = {0};
    index_cell side[2];
    int which;
    for (int i = 0; i < 2; i++) {
        w->classes[i].count = 0;
        if (!array_reserve(alloc, &w->classes[i], cell->count)) return FROE_E_MEMORY;
    }
    w->middles.count = 0;
    if (is_deep(w, cell) && !array_reserve(alloc, &w->middles, 2 * (size_t)cell->count)) return FROE_E_MEMORY;
    if (!choose_halving(w, cell, &cut, &which)) return end_packed_leaf(w, cell);
    /* deals the fragments: the positive ones take the place of all, the negative ones lie on top */
    uint32_t negative = cut.sides[0], positive = cut.sides[1];
    w->items.count = cell->first + cell->count;
    w->spare.count = 0;
    if (!array_reserve(alloc, &w->items, cut.both + 1) || !array_reserve(alloc, &w->spare, negative + 1))
        return FROE_E_MEMORY;
    packed_fragment *items = w->items.data + cell->first;
    halve_deal(w->axis, items, cell->count, &cut, w->classes[which].data, w->spare.data, items);
    if (negative) memcpy(items + positive, w->spare.data, negative * sizeof *items);
    w->items.count = cell->first + positive + negative;
    bool lonely = !negative || !positive, barren = 5 * (uint64_t)cut.both > 4 * (uint64_t)cell->count;
    halves(cell, cut.axis, cut.value, side);
    for (int i = 0; i < 2; i++) {
        side[i].first = i ? cell->first : cell->first + positive;
        side[i].count = cut.sides[i];
        side[i].growth = cell->growth * (1 + (double)cut.both / cell->count);
        side[i].lonely = lonely ? cell->lonely + 1 : 0;
        side[i].barren = barren ? cell->barren + 1 : 0;
    }
    return split_index_node(w, cell, cut.axis, cut.value, side);
}

/* ------------------------------------------------------------------- grids -- */

/* Lays a grid over a cell of fragments. */
static froe_status begin_grid(index_work *w, const index_cell *cell, bool *made) {
    const froe_allocator *alloc = &w->plan->job->alloc;
    const packed_fragment *f = w->items.data + cell->first;
    const double growth = w->plan->growth / cell->growth;
    grid_source source = {.fragments = f,
                          .count = cell->count,
                          .box = cell->box,
                          .load = w->plan->load,
                          .growth = growth < 2 ? growth : 2,
                          .workers = w->axis};
    for (uint32_t i = 0; i < cell->count; i++)
        for (int k = 0; k < 2; k++) source.length[k] += fabs(f[i].q[k] - f[i].p[k]);
    *made = false;
    if (!array_reserve(alloc, &w->layers, 1) || !array_reserve(alloc, &w->cells, 2)) return FROE_E_MEMORY;
    index_layer layer = {NULL, {0}};
    froe_status status = grid_new(alloc, &source, &layer.grid);
    if (status || !layer.grid) return status;
    *made = true;
    w->layers.data[w->layers.count++] = layer;
    index_cell end = *cell, root = *cell;
    end.heap = SUBTREE_END;
    root.heap = 1;
    root.line[0] = root.line[1] = root.barren = root.lonely = 0;
    w->cells.data[w->cells.count++] = end;
    w->cells.data[w->cells.count++] = root;
    return grid_sort(alloc, layer.grid, 0, &w->layers.data[w->layers.count - 1].part);
}

static void end_grid(index_work *w) {
    index_layer *layer = w->layers.data + --w->layers.count;
    grid_part_free(&w->plan->job->alloc, layer->grid, &layer->part);
    grid_free(&w->plan->job->alloc, layer->grid);
}

static froe_status do_index_cell(index_work *w, index_cell *cell) {
    const build_job *job = w->plan->job;
    const bool grown = cell->growth >= w->plan->growth;
    froe_status status = FROE_OK;
    bool made = false;
    if (cell->heap == SUBTREE_END) {
        end_grid(w);
        w->items.count = cell->first;
        return FROE_OK;
    }
    if (cell->heap) {
        const index_layer *layer = w->layers.data + w->layers.count - 1;
        const uint32_t level = layer->grid->upper + grid_level(cell->heap), *count = layer->part.count;
        if (level < layer->grid->levels && !grown && count[cell->heap] > job->leaf) {
            index_cell side[2];
            const double value = subtree_halve(layer->grid, cell, level, count, side);
            return split_index_node(w, cell, layer->grid->axis[level], value, side);
        }
        status = fill_cell(w, cell);
        if (status) return status;
    }
    w->items.count = cell->first + cell->count;
    if (cell->count <= job->leaf) return end_packed_leaf(w, cell);
    if (cell->count >= w->plan->grid && !is_deep(w, cell) && !grown) status = begin_grid(w, cell, &made);
    return status || made ? status : halve_cell(w, cell);
}

/* ------------------------------------------------------------------- whole -- */

/* The first cell: that of a part of the grid of all objects, as a layer, or of a node above with few objects, or of
 * all, as fragments. */
static froe_status begin_subtree(index_work *w, const index_cell *root) {
    const froe_allocator *alloc = &w->plan->job->alloc;
    split_grid *g = w->plan->whole;
    const uint32_t level = g ? grid_level(root->heap) : 0, objects = w->plan->job->scene->object_count;
    index_cell cell = *root;
    w->items.count = w->cells.count = w->layers.count = 0;
    if (!array_reserve(alloc, &w->layers, 1) || !array_reserve(alloc, &w->cells, 1)) return FROE_E_MEMORY;
    if (g && level == g->upper) {
        froe_status status = grid_sort(alloc, g, root->heap - (1u << level), &w->part);
        if (status) return status;
        w->layers.data[w->layers.count++] = (index_layer){g, w->part};
        cell.heap = 1;
    } else if (g) {
        const uint32_t first = root->heap - (1u << level), below = g->upper - level;
        const uint32_t from = g->starts[first << below], to = g->starts[(first + 1) << below];
        if (!array_reserve(alloc, &w->items, to - from)) return FROE_E_MEMORY;
        for (uint32_t i = from; i < to; i++)
            if (grid_since(g->places[i]) <= level) put_fragment(w, g->ids[i], &cell.box);
    } else {
        if (!array_reserve(alloc, &w->items, objects)) return FROE_E_MEMORY;
        for (uint32_t i = 0; i < objects; i++) put_fragment(w, i, &cell.box);
    }
    if (!w->layers.count) cell.heap = 0, cell.first = 0, cell.count = (uint32_t)w->items.count;
    w->cells.data[w->cells.count++] = cell;
    return FROE_OK;
}

froe_status subtree_build(index_work *w, const index_cell *root) {
    base_task *task = w->plan->job->task;
    froe_status status = begin_subtree(w, root);
    while (w->cells.count && !status) {
        index_cell cell = w->cells.data[--w->cells.count];
        status = do_index_cell(w, &cell);
        /* the calling thread asks; progress is that of jobs */
        const bool go_on = w->worker ? !base_cancelled(task) : base_progress(task, task->done);
        if (!status && !go_on) status = FROE_E_CANCELLED;
    }
    while (w->layers.count && w->layers.data[w->layers.count - 1].grid != w->plan->whole) end_grid(w);
    return status;
}

void subtree_work_free(index_work *w) {
    const froe_allocator *alloc = &w->plan->job->alloc;
    if (w->plan->whole) grid_part_free(alloc, w->plan->whole, &w->part);
    array_free(alloc, &w->layers);
    array_free(alloc, &w->cells);
    array_free(alloc, &w->items);
    array_free(alloc, &w->spare);
    array_free(alloc, &w->middles);
    for (int i = 0; i < 2; i++) array_free(alloc, &w->classes[i]);
}
