/* exact.c: see exact.h. */
#include "split/score/exact.h"

/** SPLIT_NEG and so on, by what the sides of corners add up to: bit 0 negative, bit 1 positive. */
static const uint8_t class_of[] = {SPLIT_ON, SPLIT_NEG, SPLIT_POS, SPLIT_BOTH};

static uint8_t bit_of(int side) {
    return (uint8_t)((side == -1) | (side == 1) << 1);
}

/** By its corners, of which the vertices have their sides in the view. Those that it shows of boxes and balls are no
 * corners of the fragment. */
static int class_of_fragment(const split_view *v, split_set *set, const split_plane *plane, uint32_t i,
                             const split_fragment *f) {
    if (plane->cut.kind == FROE_CUT_OBJECT && plane->cut.id[0] == f->object) return SPLIT_ON;
    const froe_kind form = scene_form(set->scene, f->object);
    if (form == FROE_BOX || form == FROE_BALL) return split_class(set, plane, f);
    const uint32_t *corner = v->corner.data + v->start.data[i], n = v->start.data[i + 1] - v->start.data[i];
    const uint8_t *side = v->side.data + 1;
    uint8_t seen = 0;
    bool unsure = false;
    for (uint32_t j = 0; j < n && seen != 3; j++) {
        if (v->vertex.data[corner[j]] != FROE_NONE) {
            seen |= side[corner[j]];
        } else {
            const int made = split_image_side(set, plane, set->corners.data + f->first + j);
            seen |= bit_of(made);
            unsure |= made == NUM_UNSURE;
        }
    }
    return unsure && seen != 3 ? split_class(set, plane, f) : class_of[seen];
}

bool split_exact_tally(split_view *v, split_work *work, const split_cell *cell, const froe_cut *cut, split_tally *out) {
    split_set *set = &work->set;
    const split_plane plane = split_plane_of(set->scene, cut);
    uint8_t *side = v->side.data + 1;
    uint32_t of[4] = {0};
    for (uint32_t k = 0; k < v->inside; k++) {
        const uint32_t at = v->vertices.data[k];
        side[at] = bit_of(split_vertex_side(set, &plane, scene_vertex(set->scene, v->vertex.data[at])));
    }
    set->classes.count = set->sides.count = 0;
    if (!array_reserve(&set->alloc, &set->classes, cell->count)) return false;
    for (uint32_t i = 0; i < v->count; i++) {
        const uint32_t item = v->item.data[i];
        const split_fragment *f = set->items.data + cell->first + item;
        if (!array_reserve(&set->alloc, &set->sides, split_corner_count(set, f))) return false;
        const int class = class_of_fragment(v, set, &plane, i, f);
        set->classes.data[item] = (uint8_t) class;
        of[class]++;
    }
    set->classes.count = cell->count;
    *out = (split_tally){of[SPLIT_NEG], of[SPLIT_POS], of[SPLIT_ON], of[SPLIT_BOTH]};
    return true;
}
