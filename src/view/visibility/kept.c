/* kept.c: what is kept of what is visible: corners, without their rays, and the lines on which anything visible ends.
 *
 * Most lines are those of hidden faces and of cuts through them. They go when all has been looked at; the others stay
 * in the order in which they were made, on which the order of crossings and of rings depends. */
#include "view/visibility/visibility.h"
#include <string.h>

/* --------------------------------------------------------------------- corners -- */

/* The ray of a corner as images tell it. */
static void ray_by_images(const view_sightlines *s, uint32_t vertex, view_way before, view_way way, double out[3]) {
    filter_vector ray;
    if (vertex == FROE_NONE) {
        const filter_vector a = view_way_image(s, before), b = view_way_image(s, way);
        ray = filter_cross(&a, &b);
    } else {
        ray = view_ray(s, vertex);
    }
    memcpy(out, ray.x, sizeof ray.x);
}

bool view_keep_corner(froe_visibility *v, const view_corner *corner, view_way before) {
    view_spot spot = {corner->way, corner->vertex};
    view_kept_ray kept = {.corner = (uint32_t)v->corners.count};
    ray_by_images(&v->sights, corner->vertex, before, corner->way, kept.x);
    /* NOLINTNEXTLINE(bugprone-suspicious-memory-comparison): equal to the last bit */
    if (corner->vertex == FROE_NONE && memcmp(kept.x, corner->ray.x, sizeof kept.x) != 0) {
        spot.vertex = VIEW_KEPT;
        memcpy(kept.x, corner->ray.x, sizeof kept.x);
        if (!array_push(&v->alloc, &v->kept_rays, kept)) return false;
    }
    v->corners.data[v->corners.count++] = spot;
    return true;
}

void view_ray_at(const froe_visibility *v, view_turn at, double out[3]) {
    const view_spot *spot = v->corners.data + at.corner;
    if (spot->vertex != VIEW_KEPT) {
        ray_by_images(&v->sights, spot->vertex, at.before, spot->way, out);
        return;
    }
    size_t lo = 0, hi = v->kept_rays.count - 1; /* it is there */
    while (lo < hi) {
        const size_t middle = lo + (hi - lo) / 2;
        if (v->kept_rays.data[middle].corner < at.corner)
            lo = middle + 1;
        else
            hi = middle;
    }
    memcpy(out, v->kept_rays.data[lo].x, sizeof v->kept_rays.data[lo].x);
}

bool view_ring_of_visible(const froe_visibility *v, view_sightlines *s, uint32_t visible, view_ring *out) {
    const view_piece *p = v->pieces + visible;
    const view_spot *spots = v->corners.data + p->first;
    out->count = 0;
    if (!array_reserve(&v->alloc, out, p->count)) return false;
    for (uint32_t i = 0; i < p->count; i++) {
        view_corner k = {.way = spots[i].way, .vertex = view_vertex_of(spots + i)};
        k.ray =
            k.vertex != FROE_NONE ? view_ray(s, k.vertex) : view_meeting(s, spots[i ? i - 1 : p->count - 1].way, k.way);
        out->data[out->count++] = k;
    }
    return true;
}

/* ----------------------------------------------------------------------- lines -- */

static void note_mark(uint32_t *numbers, const view_mark *mark) {
    if (mark->vertex == FROE_NONE) numbers[mark->way >> 1] = 1;
}

static void renumber_mark(const uint32_t *numbers, view_mark *mark) {
    mark->way = mark->vertex == FROE_NONE ? 2 * numbers[mark->way >> 1] + (mark->way & 1) : 0;
}

froe_status view_keep_lines(froe_visibility *v) {
    view_sightlines *s = &v->sights;
    const size_t count = s->lines.count, edges = surface_line_count(v->surface);
    const uint32_t *of_edge = s->of_edge;
    uint32_t *numbers = support_calloc(&v->alloc, count + 1, sizeof *numbers);
    if (!numbers) return FROE_E_MEMORY;
    for (size_t i = 0; i < v->corners.count; i++) numbers[v->corners.data[i].way >> 1] = 1;
    for (size_t e = 0; e < edges; e++)
        if (v->edge_starts[e] < v->edge_starts[e + 1]) numbers[of_edge[e] - 1] = 1;
    for (size_t i = 0; i < 2 * (size_t)v->interval_count; i++) note_mark(numbers, v->interval_marks + i);
    for (size_t i = 0; i < v->crossing_runs.count; i++) {
        const view_run *run = v->crossing_runs.data + i;
        numbers[run->line] = 1;
        for (int e = 0; e < 2; e++) note_mark(numbers, run->end + e);
    }
    const froe_status status = view_sightlines_keep(s, numbers);
    for (size_t i = 0; !status && i < v->corners.count; i++) {
        view_way *way = &v->corners.data[i].way;
        *way = 2 * numbers[*way >> 1] + (*way & 1);
    }
    for (size_t i = 0; !status && i < 2 * (size_t)v->interval_count; i++) renumber_mark(numbers, v->interval_marks + i);
    for (size_t i = 0; !status && i < v->crossing_runs.count; i++) {
        view_run *run = v->crossing_runs.data + i;
        run->line = numbers[run->line];
        for (int e = 0; e < 2; e++) renumber_mark(numbers, run->end + e);
    }
    support_free(&v->alloc, numbers, (count + 1) * sizeof *numbers);
    return status;
}

/* --------------------------------------------------------------------- dropping -- */

void view_drop_pieces(froe_visibility *v) {
    view_sightlines_drop(&v->sights);
    array_free(&v->alloc, &v->corners);
    array_free(&v->alloc, &v->kept_rays);
    support_free(&v->alloc, v->pieces, ((size_t)v->piece_count + 1) * sizeof *v->pieces);
    v->pieces = NULL;
}
