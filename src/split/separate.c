/* separate.c: see separate.h. Every plane found is checked by the exact predicates before it counts. */
#include "split/separate.h"
#include "tree/crowd.h"
#include <math.h>

static uint32_t object_at(const split_work *work, const split_cell *cell, uint32_t i) {
    return work->set.items.data[cell->first + i].object;
}

/** On some axis one extent ends where, or before, another begins: cut there. */
static bool by_axis(const split_work *work, const split_cell *cell, froe_cut *cut) {
    const froe_scene *scene = work->set.scene;
    double least_hi[FROE_MAX_DIM], most_lo[FROE_MAX_DIM], lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    for (uint32_t i = 0; i < cell->count; i++) {
        scene_object_bounds(scene, object_at(work, cell, i), lo, hi);
        for (int k = 0; k < scene->dim; k++) {
            if (!i || hi[k] < least_hi[k]) least_hi[k] = hi[k];
            if (!i || lo[k] > most_lo[k]) most_lo[k] = lo[k];
        }
    }
    for (int k = 0; k < scene->dim; k++) {
        if (least_hi[k] > most_lo[k]) continue;
        double middle = 0.5 * least_hi[k] + 0.5 * most_lo[k];
        *cut = (froe_cut){.kind = FROE_CUT_AXIS, .axis = k, .value = middle};
        if (least_hi[k] == most_lo[k]) cut->value = least_hi[k];
        return true;
    }
    return false;
}

/** Appends the corners of a hull; the caller has made room. */
static void add_corners(const froe_scene *scene, uint32_t object, int set, split_separator *separator) {
    for (uint32_t i = 0; i < scene_corners(scene, object); i++) {
        uint32_t id = scene_corner(scene, object, i);
        separator->corners.data[separator->corners.count++] = (geom_member){scene_vertex(scene, id), id, set};
    }
}

bool split_separate_pair(split_work *work, uint32_t a, uint32_t b, split_separator *separator, froe_cut *cut) {
    const froe_scene *scene = work->set.scene;
    const bool boxes = scene_form(scene, a) == FROE_BOX && scene_form(scene, b) == FROE_BOX;
    if (boxes) return false; /* axis-parallel planes do */
    if (scene->dim <= 3 && scene_form(scene, a) == FROE_HULL && scene_form(scene, b) == FROE_HULL) {
        geom_member *corners = separator->corners.data;
        separator->corners.count = 0;
        add_corners(scene, a, -1, separator);
        add_corners(scene, b, 1, separator);
        const uint32_t count = (uint32_t)separator->corners.count;
        if (geom_between(&work->set.context, scene->dim, corners, count) == GEOM_YES) {
            *cut = (froe_cut){.kind = FROE_CUT_VERTICES};
            for (int k = 0; k < scene->dim; k++) cut->id[k] = corners[k].id;
            return true;
        }
    }
    const geom_body one = scene_body(scene, a), other = scene_body(scene, b);
    const int rows = geom_apart(&work->set.context, &one, &other, separator->rows);
    *cut = (froe_cut){.kind = FROE_CUT_PLANE, .value = separator->rows[scene->dim], .normal = separator->rows};
    if (rows > 1) cut->kind = FROE_CUT_FINE, cut->id[0] = (uint32_t)rows;
    return rows > 0;
}

/** Do all balls contain the centre of the smallest? Then no two can be separated: no need to try all pairs. */
static bool share_a_point(split_work *work, const split_cell *cell) {
    const froe_scene *scene = work->set.scene;
    uint32_t least = 0;
    for (uint32_t i = 0; i < cell->count; i++) {
        if (scene_form(scene, object_at(work, cell, i)) != FROE_BALL) return false;
        if (scene_radius(scene, object_at(work, cell, i)) < scene_radius(scene, object_at(work, cell, least)))
            least = i;
    }
    const double *centre = scene_point(scene, object_at(work, cell, least), 0);
    for (uint32_t i = 0; i < cell->count; i++) {
        uint32_t object = object_at(work, cell, i);
        double square = 0, r = scene_radius(scene, object);
        for (int k = 0; k < scene->dim; k++) {
            double d = fabs(scene_point(scene, object, 0)[k] - centre[k]) * (1 + 0x1p-40);
            square += d * d;
        }
        if (!(square * (1 + 0x1p-40) < r * r)) return false; /* certainly strictly inside, or unknown */
    }
    return true;
}

bool split_separator_ready(const split_set *set, const split_cell *cell, split_separator *separator) {
    uint32_t most = 0;
    for (uint32_t i = 0; i < cell->count; i++) {
        uint32_t n = split_corner_count(set, set->items.data + cell->first + i);
        if (n > most) most = n;
    }
    separator->corners.count = 0;
    return array_reserve(&set->alloc, &separator->corners, 2 * (size_t)most) &&
           array_reserve(&set->alloc, &separator->bounds, 2 * (size_t)set->scene->dim * cell->count);
}

split_verdict split_separate(split_work *work, const split_cell *cell, split_separator *separator, froe_cut *cut) {
    if (by_axis(work, cell, cut) && cell->attempt < 2) return SPLIT_CUT;
    const froe_scene *scene = work->set.scene;
    if (share_a_point(work, cell)) return SPLIT_INSEPARABLE;
    if (!split_separator_ready(&work->set, cell, separator)) return SPLIT_MEMORY;
    for (uint32_t i = 0; i < cell->count && split_go_on(work); i++) {
        const uint32_t a = object_at(work, cell, i);
        if (scene_form(scene, a) == FROE_BOX) continue; /* by_axis() found no plane beside another box */
        for (uint32_t j = 0; j < cell->count; j++) {
            const uint32_t b = object_at(work, cell, j);
            if ((j < i || scene_form(scene, b) == FROE_BOX) && split_separate_pair(work, a, b, separator, cut))
                return SPLIT_CUT;
        }
    }
    return base_cancelled(work->task) ? SPLIT_CANCELLED : SPLIT_INSEPARABLE;
}

/** On some axis one of them ends where, or before, one begins: as in by_axis(). */
static bool apart_on_an_axis(int dim, const double *a, const double *b) {
    for (int k = 0; k < dim; k++)
        if (fmin(a[dim + k], b[dim + k]) <= fmax(a[k], b[k])) return true;
    return false;
}

bool split_crowded(split_work *work, const split_cell *cell, split_separator *separator) {
    tree_crowd crowd = tree_crowd_of(cell->count);
    const int dim = work->set.scene->dim;
    double *bounds = separator->bounds.data; /* each object is in many pairs */
    for (uint32_t i = 0; i < cell->count; i++) {
        double *of = bounds + 2 * (size_t)dim * i;
        scene_object_bounds(work->set.scene, object_at(work, cell, i), of, of + dim);
    }
    while (!tree_crowd_known(&crowd) && split_go_on(work)) {
        const uint32_t a = object_at(work, cell, crowd.a), b = object_at(work, cell, crowd.b);
        const double *of_a = bounds + 2 * (size_t)dim * crowd.a, *of_b = bounds + 2 * (size_t)dim * crowd.b;
        froe_cut cut;
        tree_crowd_tell(&crowd, apart_on_an_axis(dim, of_a, of_b) || split_separate_pair(work, a, b, separator, &cut));
    }
    return tree_crowd_is(&crowd);
}

void split_separator_free(const froe_allocator *alloc, split_separator *separator) {
    array_free(alloc, &separator->corners);
    array_free(alloc, &separator->bounds);
}
