/* cover.c: the boxes that contain a cell. */
#include "split/cell.h"
#include <math.h>
#include <string.h>

enum { PEEL_LEAST = 8 }; /* fragments: about as many as cuts that turn a box into a cover */

/** Does the object, if it is a box, contain these bounds? */
static bool contains(const split_set *set, uint32_t object, const double *lo, const double *hi) {
    const froe_scene *s = set->scene;
    if (scene_form(s, object) != FROE_BOX) return false;
    const double *from = scene_point(s, object, 0), *to = scene_point(s, object, 1);
    for (int k = 0; k < s->dim; k++)
        if (!(from[k] <= lo[k] && to[k] >= hi[k])) return false;
    return true;
}

froe_status cover_find(split_set *set, split_cell *cell) {
    uint32_t covers = 0, kept = 0;
    if (!set->boxes) return FROE_OK;
    split_fragment *item = set->items.data + cell->first;
    while (kept < cell->count && !contains(set, item[kept].object, cell->lo, cell->hi)) kept++;
    if (kept == cell->count) return FROE_OK;
    set->spare.count = 0;
    if (!array_reserve(&set->alloc, &set->spare, cell->count)) return FROE_E_MEMORY;
    for (uint32_t i = kept; i < cell->count; i++) {
        if (contains(set, item[i].object, cell->lo, cell->hi))
            set->spare.data[covers++] = item[i];
        else
            item[kept++] = item[i];
    }
    memmove(item + covers, item, kept * sizeof *item);
    memcpy(item, set->spare.data, covers * sizeof *item);
    cell->covers = covers;
    cell->first += covers;
    cell->count = kept;
    return FROE_OK;
}

froe_status cover_emit(split_set *set, const split_cell *cell) {
    const uint32_t node = cell->node - set->draft->outer;
    froe_status status = cell->covers ? draft_list(set->draft, node) : FROE_OK;
    for (uint32_t i = cell->first - cell->covers; i < cell->first && !status; i++)
        status = draft_cover(set->draft, node, set->items.data[i].object);
    return status;
}

void cover_drop(split_set *set, split_cell *cell) {
    split_fragment *item = set->items.data + cell->first;
    if (!cell->covers) return;
    memmove(item - cell->covers, item, cell->count * sizeof *item);
    set->items.count -= cell->covers;
    cell->first -= cell->covers;
    cell->covers = 0;
}

bool cover_peel(const split_set *set, const split_cell *cell, froe_cut *cut) {
    const froe_scene *s = set->scene;
    const split_fragment *item = set->items.data + cell->first;
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM], from[FROE_MAX_DIM], to[FROE_MAX_DIM];
    bool held = false;
    if (!set->boxes || cell->count <= PEEL_LEAST) return false;
    for (int k = 0; k < s->dim; k++) lo[k] = INFINITY, hi[k] = -INFINITY;
    for (uint32_t i = 0; i < cell->count; i++) {
        scene_object_bounds(s, item[i].object, from, to);
        for (int k = 0; k < s->dim; k++) lo[k] = fmin(lo[k], from[k]), hi[k] = fmax(hi[k], to[k]);
    }
    for (int k = 0; k < s->dim; k++) lo[k] = fmax(lo[k], cell->lo[k]), hi[k] = fmin(hi[k], cell->hi[k]);
    for (uint32_t i = 0; i < cell->count && !held; i++) held = contains(set, item[i].object, lo, hi);
    for (int k = 0; k < s->dim && held; k++) {
        if (lo[k] == cell->lo[k] && hi[k] == cell->hi[k]) continue;
        *cut = (froe_cut){.kind = FROE_CUT_AXIS, .axis = k, .value = lo[k] > cell->lo[k] ? lo[k] : hi[k]};
        return true;
    }
    return false;
}
