/* mark.c: see mark.h. */
#include "split/score/mark.h"
#include <math.h>

static const split_fragment *fragment_at(const split_view *v, const split_set *set, const split_cell *cell,
                                         uint32_t i) {
    return set->items.data + cell->first + (v->pairs ? i : v->item.data[i]);
}

/** Is it wide enough to be a wall? What is tiny beside the cell seems to lie in every plane that comes near it, and
 * tells nothing about other planes: scenes of all scales are full of it. */
static bool is_wide(const split_view *v, uint32_t i) {
    const double *const x[3] = {v->x.data, v->y.data, v->z.data};
    const uint32_t from = v->pairs ? 2 * i : v->start.data[i], to = v->pairs ? from + 2 : v->start.data[i + 1];
    const uint32_t first = v->pairs ? from : v->corner.data[from];
    for (uint32_t j = from + 1; j < to; j++)
        for (int k = 0; k < v->dim; k++)
            if (fabs(x[k][v->pairs ? j : v->corner.data[j]] - x[k][first]) > SPLIT_WIDE) return true;
    return false;
}

bool split_mark(split_view *v, split_work *work, const split_cell *cell, const froe_cut *cut,
                const split_view_plane *plane, const uint8_t *classes) {
    split_set *set = &work->set;
    const split_plane exact = split_plane_of(set->scene, cut);
    const bool first = !v->marks;
    for (uint32_t i = 0; i < v->count; i++) {
        if (v->marked.data[i] || !split_view_flat(v, plane, i) || !is_wide(v, i)) continue;
        const split_fragment *f = fragment_at(v, set, cell, i);
        if (!classes && !array_reserve(&set->alloc, &set->sides, split_corner_count(set, f))) return false;
        const int class = classes ? classes[f - (set->items.data + cell->first)] : split_class(set, &exact, f);
        if (class == SPLIT_ON) continue;
        v->marked.data[i] = 3;
        v->marks++;
    }
    if (!first || !v->marks) return true;
    split_view_find_outermost(v, set->scene);
    return !v->swept || split_view_add(v, set, v->outermost, v->outermost_count);
}

split_tally split_mark_count_support(split_view *v, const split_set *set, const split_cell *cell, uint32_t object,
                                     const split_view_plane *plane) {
    split_tally t = split_view_count(v, plane);
    for (uint32_t i = 0; i < v->count && v->marks; i++) {
        if (!v->marked.data[i] || fragment_at(v, set, cell, i)->object != object) continue;
        const uint32_t own = split_view_flat(v, plane, i);
        t.both -= own;
        t.on += own;
    }
    return t;
}
