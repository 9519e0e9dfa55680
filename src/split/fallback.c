/* fallback.c: see fallback.h. */
#include "split/fallback.h"
#include "base/random.h"
#include "base/sort.h"

static bool any_of(const split_set *set, const split_cell *cell, uint64_t draw, bool only_free, froe_cut *cut) {
    uint32_t m = cell->count, start = base_below(draw, m);
    for (uint32_t i = 0; i < m; i++) {
        const split_fragment *f = set->items.data + cell->first + ((uint64_t)start + i) % m;
        if (only_free && !split_is_free(set, f)) continue;
        *cut = scene_support_cut(set->scene, f->object);
        if (cut->kind != FROE_CUT_NONE) return true;
    }
    return false;
}

bool split_any_support(const split_set *set, const split_cell *cell, uint64_t draw, froe_cut *cut) {
    return any_of(set, cell, draw, false, cut);
}

bool split_any_free(const split_set *set, const split_cell *cell, uint64_t draw, froe_cut *cut) {
    return any_of(set, cell, draw, true, cut);
}

bool split_is_free(const split_set *set, const split_fragment *f) {
    for (uint32_t i = 0; i < f->count; i++)
        if (!(set->corners.data[f->first + i].edge & TREE_EDGE_CUT)) return false;
    return f->count > 0;
}

bool split_vertex_median(split_view *v, const froe_scene *scene, froe_cut *cut) {
    size_t most = 0;
    for (int axis = 0; axis < scene->dim; axis++) {
        double median = 0;
        /* the median of the inner coordinates on an axis, and how many there are */
        double *x = v->x.data; /* local coordinates, no longer needed: there is room for as many */
        size_t count = v->inside, lo = 0, hi = count;
        for (size_t i = 0; i < count; i++) x[i] = scene_vertex(scene, v->vertex.data[v->vertices.data[i]])[axis];
        base_sort(x, count, sizeof *x, base_compare_doubles);
        while (lo < count && x[lo] == x[0]) lo++;
        while (hi > lo && x[hi - 1] == x[count - 1]) hi--;
        if (hi > lo) median = x[lo + (hi - lo) / 2];
        size_t inner = hi - lo;
        if (inner <= most) continue;
        most = inner;
        *cut = (froe_cut){.kind = FROE_CUT_AXIS, .axis = axis, .value = median};
    }
    return most > 0;
}

bool split_one_point(const split_set *set, const split_cell *cell) {
    uint32_t vertex = FROE_NONE;
    for (uint32_t i = 0; i < cell->count; i++) {
        uint32_t object = set->items.data[cell->first + i].object;
        if (scene_form(set->scene, object) != FROE_POINT) return false;
        if (i && scene_corner(set->scene, object, 0) != vertex) return false;
        vertex = scene_corner(set->scene, object, 0);
    }
    return true;
}
