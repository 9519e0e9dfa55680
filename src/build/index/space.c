/* space.c: trees of space to be queried: cuts by surface area, whole objects in packed leaves.
 *
 * Cells are cut where that saves a search most (build/index/surface.h), one by one, depth first; a leaf is written as a
 * block as soon as it is reached. Objects are listed whole in all leaves they reach; while cells are cut each has the
 * bounds of its part, so that none comes into a cell it does not meet, and boxes of leaves are tight.
 *
 * Where cuts do not pay, leaves stay over capacity: below cells that the cuts above have multiplied into `growth`
 * listings for each, and where three cuts in a row would save less than a fiftieth, or divide nearly all. As in the
 * plane there are at most 2 growth n listings. */
#include "build/index/space.h"
#include "build/index/surface.h"
#include "tree/packed/packer.h"
#include <math.h>
#include <string.h>

enum { BARREN = 3, THOROUGH = 256 };

/* Its items are on top of all others when its turn comes. */
typedef struct index_space_cell {
    uint32_t node, first, count, barren;
    double growth;
} index_space_cell;

typedef struct index_space_work {
    build_job *job;
    double growth;
    tree_packer packer;
    ARRAY(index_space_cell) cells;
    ARRAY(space_item) items, spare;
    ARRAY(uint8_t) classes;
    double done; /* share of the objects in finished leaves */
} index_space_work;

static froe_status cut_cell(index_space_work *w, const index_space_cell *cell) {
    surface_cut cut;
    index_space_cell side[2] = {*cell, *cell};
    uint32_t child;
    w->classes.count = 0;
    if (!array_reserve(&w->job->alloc, &w->classes, cell->count)) return FROE_E_MEMORY;
    /* names the cut, and tells on which sides the items are */
    space_item *items = w->items.data + cell->first;
    const bool may_cut = cell->count > w->job->leaf && cell->growth < w->growth && cell->barren < BARREN;
    if (!may_cut || !surface_choose(items, cell->count, &cut) ||
        !surface_count(items, cell->count, &cut, w->classes.data) || cut.both >= cell->count) {
        /* nothing separates them, or it does not pay: a leaf */
        const uint64_t most = w->job->max_fragments;
        const uint8_t flags = cell->count > w->job->leaf ? TREE_CROWDED : 0;
        if (most && (uint64_t)w->packer.piece_count + cell->count > most) return FROE_E_BUDGET;
        w->items.count = cell->first;
        w->done += cell->count / cell->growth;
        return packer_space_leaf(&w->packer, cell->node, w->job->scene, items, cell->count, flags);
    }
    froe_status status = packer_split(&w->packer, cell->node, cut.axis, cut.value, &child);
    if (status) return status;
    /* the positive items take the place of all, the negative ones lie on top */
    const froe_allocator *alloc = &w->job->alloc;
    w->items.count = cell->first + cell->count;
    w->spare.count = 0;
    if (!array_reserve(alloc, &w->items, cut.sides[0] + cut.sides[1] - cell->count) ||
        !array_reserve(alloc, &w->spare, cut.sides[0]))
        return FROE_E_MEMORY;
    items = w->items.data + cell->first;
    const bool thorough = cell->count <= THOROUGH;
    surface_deal(w->job->scene, items, cell->count, &cut, w->classes.data, thorough, w->spare.data, items);
    if (cut.sides[0]) memcpy(items + cut.sides[1], w->spare.data, cut.sides[0] * sizeof *items);
    w->items.count = cell->first + cut.sides[0] + cut.sides[1];
    side[0].first = cell->first + cut.sides[1];
    const uint64_t listed = (uint64_t)cut.sides[0] + cut.sides[1];
    const bool barren = cut.cost > 0.98 || 5 * (listed - cell->count) > 4 * (uint64_t)cell->count;
    for (uint32_t i = 0; i < 2; i++) {
        side[i].node = child + i;
        side[i].count = cut.sides[i];
        side[i].growth = listed > cell->count ? cell->growth * (double)listed / cell->count : cell->growth;
        side[i].barren = barren ? cell->barren + 1 : 0;
    }
    /* the negative child last, so that it comes first */
    return array_push(alloc, &w->cells, side[1]) && array_push(alloc, &w->cells, side[0]) ? FROE_OK : FROE_E_MEMORY;
}

froe_status build_in_space(build_job *job, double growth, froe_tree **out) {
    index_space_work w = {.job = job, .growth = growth};
    froe_scene *s = job->scene;
    const size_t objects = s->object_count;
    const index_space_cell root = {.count = s->object_count, .growth = 1};
    const uint64_t leaves = objects / (job->leaf / 2 + 1) + 1;
    froe_status status = packer_new(&job->alloc, 2 * leaves, leaves + objects, 0, &w.packer);
    if (status) return status;
    if (!array_reserve(&job->alloc, &w.items, objects + objects / 2) || !array_push(&job->alloc, &w.cells, root))
        status = FROE_E_MEMORY;
    for (uint32_t i = 0; i < objects && !status; i++) {
        space_item *item = w.items.data + w.items.count++;
        scene_bounds_in(s, 3, i, item->lo, item->hi);
        item->object = i;
        item->corner = space_is_triangle(s, i) ? scene_start(s, i) : FROE_NONE;
    }
    for (int k = 0; objects && k < 3; k++) {
        job->meta.root_lo[k] = s->lo[k] + 0.0;
        job->meta.root_hi[k] = s->hi[k] + 0.0;
    }
    while (w.cells.count && !status) {
        const index_space_cell cell = w.cells.data[--w.cells.count];
        status = cut_cell(&w, &cell);
        const double share = fmin(w.done / ((double)objects + 1.0), 1);
        if (!status && !base_progress(job->task, 0.05 + 0.9 * share)) status = FROE_E_CANCELLED;
    }
    array_free(&job->alloc, &w.cells);
    array_free(&job->alloc, &w.items);
    array_free(&job->alloc, &w.spare);
    array_free(&job->alloc, &w.classes);
    if (!status) status = packer_seal(&w.packer, s, &job->meta, out);
    packer_free(&w.packer);
    return status;
}
