/* segments.c: intervals of edges and wires, crossings, and points become segments on the page. */
#include "base/radix.h"
#include "view/picture/picture.h"
#include <math.h>
#include <string.h>

/* Far enough beyond the page that no rounding matters: what is visible, or hidden, has been cut to it exactly. */
#define BEYOND 1e-6

/* A stretch of the segment from a to b, between two shares, unless it is too near to the eye. */
static bool add_view_item(view_painter *p, view_item *item, const double *a, const double *b, double from, double to) {
    const froe_projection *view = p->options->view;
    double share[2] = {from, to};
    if (!print_clip_segment(view, a, b, BEYOND, share)) return true;
    for (int e = 0; e < 2; e++) {
        const double t = share[e];
        double x[3], at[3], page[2];
        for (int k = 0; k < 3; k++) x[k] = t == 1 ? b[k] : a[k] + t * (b[k] - a[k]);
        view_camera_point(view, x, at);
        view_camera_page(view, at, page);
        item->at[e] = (print_point){page[0], page[1]};
        item->near[e] = view->eye.parallel ? -at[2] : 1 / at[2];
        memcpy(item->space[e], x, sizeof x);
    }
    return array_push(&p->picture->alloc, &p->items, *item);
}

/* The object that an edge is a line of: of those that use it the first that faces the eye, or the first. */
static uint32_t owner_of_edge(view_sightlines *s, uint32_t edge) {
    if (edge >= s->surface->edge_count) return s->surface->wires[edge - s->surface->edge_count];
    const uint32_t first = s->surface->edge_starts[edge], end = s->surface->edge_starts[edge + 1];
    for (uint32_t i = first; i < end; i++)
        if (view_facing(s, s->surface->uses[i]) > 0) return s->surface->uses[i];
    return s->surface->uses[first];
}

static bool add_stretch(view_painter *p, uint32_t edge, uint32_t kind, bool hidden, const view_mark mark[2]) {
    view_sightlines *s = p->sights;
    const uint32_t *v = s->surface->vertices + 2 * (size_t)edge;
    view_item item = {
        .run = {view_line_of_edge(s, edge), {mark[0], mark[1]}}, .kind = (uint16_t)kind, .hidden = hidden};
    item.object = owner_of_edge(s, edge);
    return add_view_item(p, &item, view_vertex(s, v[0]), view_vertex(s, v[1]), view_share_of(s, edge, mark[0]),
                         view_share_of(s, edge, mark[1]));
}

/* Adds all of a line on the page as hidden: its visible parts are drawn over that. */
static froe_status add_hidden(view_painter *p, uint32_t edge, uint32_t kind) {
    view_stretch part;
    bool there;
    const froe_status status = view_rest_of_edge(p->v, edge, &part, &there);
    if (status || !there) return status;
    const view_mark mark[2] = {view_mark_of(&part.end[0]), view_mark_of(&part.end[1])};
    return add_stretch(p, edge, kind, true, mark) ? FROE_OK : FROE_E_MEMORY;
}

/* ----------------------------------------------------------------------- chains -- */

/* Ends of crossings at one place of the page get one number, above those of vertices. */
static bool number_crossings(view_painter *p) {
    const size_t most = 2 * p->segments.count;
    const double fine = 1e9 / (p->options->view->width + p->options->view->height);
    uint32_t number = p->sights->tree->scene->vertex_count;
    base_pair *pairs = support_calloc(&p->picture->alloc, 2 * most + 1, sizeof *pairs);
    size_t n = 0;
    for (uint32_t i = 0; pairs && i < most; i++) {
        const print_point at = p->segments.data[i / 2].at[i % 2];
        const uint64_t x = (uint64_t)(int64_t)floor(at.x * fine + 0.5) & UINT32_MAX,
                       y = (uint64_t)(int64_t)floor(at.y * fine + 0.5) & UINT32_MAX;
        const uint16_t kind = p->segments.data[i / 2].kind;
        if (kind == FROE_LINE_CROSSING || kind == FROE_LINE_SECTION) pairs[n++] = (base_pair){x << 32 | y, i};
    }
    if (pairs) base_radix_sort(pairs, pairs + n, n);
    for (size_t i = 0; pairs && i < n; i++) {
        number += i && pairs[i].key != pairs[i - 1].key;
        p->segments.data[pairs[i].value / 2].vertex[pairs[i].value % 2] = number;
    }
    support_free(&p->picture->alloc, pairs, (2 * most + 1) * sizeof *pairs);
    return pairs != NULL;
}

/* Adds visible points, as segments of length 0. */
static bool add_points(view_painter *p) {
    const froe_projection *view = p->options->view;
    const froe_surface *surface = p->sights->surface;
    bool ok = true;
    for (uint32_t i = 0; i < surface->point_count && ok; i++) {
        const double *x = scene_point(surface->scene, surface->points[i], 0);
        view_segment s = {.vertex = {FROE_NONE, FROE_NONE}, .object = surface->points[i], .kind = FROE_LINE_POINT};
        double at[3], page[2];
        if (!p->v->points_seen[i]) continue;
        view_camera_point(view, x, at);
        if (!view->eye.parallel && at[2] < view->near) continue;
        view_camera_page(view, at, page);
        s.place = FROE_NONE;
        for (int e = 0; e < 2; e++) {
            s.at[e] = (print_point){page[0], page[1]};
            s.near[e] = view->eye.parallel ? -at[2] : 1 / at[2];
            memcpy(s.space[e], x, sizeof s.space[e]);
        }
        ok = array_push(&p->picture->alloc, &p->segments, s);
    }
    return ok;
}

froe_status view_make_segments(view_painter *p, const uint8_t *kinds) {
    const froe_picture_options *o = p->options;
    const uint32_t *starts = p->v->edge_starts;
    froe_status status = FROE_OK;
    const froe_surface *surface = p->sights->surface;
    p->chains = (view_chains){o->chains, surface->scene->groups};
    for (uint32_t e = 0; !status && e < surface_line_count(surface); e++) {
        const uint32_t kind = e < surface->edge_count ? kinds[e] : o->lines & FROE_LINE_WIRE;
        for (uint32_t i = starts[e]; !status && kind && i < starts[e + 1]; i++)
            if (!add_stretch(p, e, kind, false, p->v->interval_marks + 2 * (size_t)i)) status = FROE_E_MEMORY;
        if (!status && kind && o->hidden) status = add_hidden(p, e, kind);
    }
    size_t count;
    const froe_crossing *x = froe_visibility_crossings(p->v, &count);
    for (size_t i = 0; !status && i < count; i++) {
        const uint32_t kind = x[i].section ? FROE_LINE_SECTION : FROE_LINE_CROSSING;
        view_item item = {.run = p->v->crossing_runs.data[i], .kind = (uint16_t)kind, .hidden = x[i].hidden};
        item.object = surface_first(p->sights->surface, x[i].patch);
        if (o->lines & kind && !add_view_item(p, &item, x[i].from, x[i].to, 0, 1)) status = FROE_E_MEMORY;
    }
    view_drop_intervals(p->v); /* all are in items now */
    if (!status)
        status =
            view_overlay(p->sights, o->view, &p->items, &p->chains, o->halo > 0 || o->interleave > 0, &p->segments);
    array_free(&p->picture->alloc, &p->items); /* and now in segments */
    if (!status && !number_crossings(p)) status = FROE_E_MEMORY;
    if (!status) status = view_cut_segments(&p->picture->alloc, o->view, o->halo, &p->segments);
    if (!status && o->lines & FROE_LINE_POINT && !add_points(p)) status = FROE_E_MEMORY;
    return status;
}
