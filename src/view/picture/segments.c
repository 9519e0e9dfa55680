/* segments.c: intervals of edges and wires, crossings, and points become segments on the page. */
#include "base/radix.h"
#include "view/picture/picture.h"
#include <math.h>
#include <string.h>

/* Far enough beyond the page that no rounding matters: what is visible, or hidden, has been cut to it exactly. */
#define BEYOND 1e-6

/* ------------------------------------------------------------------------ items -- */

view_ends view_item_source(const view_drawing *d, const view_item *item) {
    if (item->kind == FROE_LINE_CROSSING || item->kind == FROE_LINE_SECTION) {
        const froe_crossing *x = d->crossings + item->source;
        return (view_ends){x->from, x->to};
    }
    const uint32_t *v = d->sights->surface->vertices + 2 * (size_t)item->source;
    return (view_ends){view_vertex(d->sights, v[0]), view_vertex(d->sights, v[1])};
}

print_point view_item_end(const view_drawing *d, const view_item *item, int end, double *near, double space[3]) {
    const view_ends ends = view_item_source(d, item);
    const double t = item->share[end];
    double at[3], page[2];
    for (int k = 0; k < 3; k++) space[k] = t == 1 ? ends.to[k] : ends.from[k] + t * (ends.to[k] - ends.from[k]);
    view_camera_point(d->view, space, at);
    view_camera_page(d->view, at, page);
    *near = d->view->eye.parallel ? -at[2] : 1 / at[2];
    return (print_point){page[0], page[1]};
}

/* Adds a stretch between two shares of its source, unless it is too near to the eye. */
static bool add_view_item(view_painter *p, const view_drawing *d, view_item *item, double from, double to) {
    const view_ends ends = view_item_source(d, item);
    item->share[0] = from, item->share[1] = to;
    if (!print_clip_segment(d->view, ends.from, ends.to, BEYOND, item->share)) return true;
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

static bool add_stretch(view_painter *p, const view_drawing *d, uint32_t edge, uint32_t kind, bool hidden,
                        const view_mark mark[2]) {
    view_sightlines *s = p->sights;
    view_item item = {.run = {view_line_of_edge(s, edge), {mark[0], mark[1]}},
                      .source = edge,
                      .kind = (uint16_t)kind,
                      .hidden = hidden};
    item.object = owner_of_edge(s, edge);
    return add_view_item(p, d, &item, view_share_of(s, edge, mark[0]), view_share_of(s, edge, mark[1]));
}

/* Adds all of a line on the page as hidden: its visible parts are drawn over that. */
static froe_status add_hidden(view_painter *p, const view_drawing *d, uint32_t edge, uint32_t kind) {
    view_stretch part;
    bool there;
    const froe_status status = view_rest_of_edge(p->v, edge, &part, &there);
    if (status || !there) return status;
    const view_mark mark[2] = {view_mark_of(&part.end[0]), view_mark_of(&part.end[1])};
    return add_stretch(p, d, edge, kind, true, mark) ? FROE_OK : FROE_E_MEMORY;
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

/* Adds the stretches of all edges, wires and crossings. */
static froe_status add_items(view_painter *p, const view_drawing *d, const uint8_t *kinds) {
    const froe_picture_options *o = p->options;
    const uint32_t *starts = p->v->edge_starts;
    const froe_surface *surface = p->sights->surface;
    froe_status status = FROE_OK;
    for (uint32_t e = 0; !status && e < surface_line_count(surface); e++) {
        const uint32_t kind = e < surface->edge_count ? kinds[e] : o->lines & FROE_LINE_WIRE;
        for (uint32_t i = starts[e]; !status && kind && i < starts[e + 1]; i++)
            if (!add_stretch(p, d, e, kind, false, p->v->interval_marks + 2 * (size_t)i)) status = FROE_E_MEMORY;
        if (!status && kind && o->hidden) status = add_hidden(p, d, e, kind);
    }
    for (uint32_t i = 0; !status && i < p->v->crossings.count; i++) {
        const froe_crossing *x = d->crossings + i;
        const uint32_t kind = x->section ? FROE_LINE_SECTION : FROE_LINE_CROSSING;
        view_item item = {.run = p->v->crossing_runs.data[i], .source = i, .kind = (uint16_t)kind, .hidden = x->hidden};
        item.object = surface_first(surface, x->patch);
        if (o->lines & kind && !add_view_item(p, d, &item, 0, 1)) status = FROE_E_MEMORY;
    }
    return status;
}

froe_status view_make_segments(view_painter *p, const uint8_t *kinds) {
    const froe_picture_options *o = p->options;
    const view_drawing drawing = {p->sights, o->view, p->v->crossings.data};
    froe_status status = add_items(p, &drawing, kinds);
    p->chains = (view_chains){o->chains, p->sights->surface->scene->groups};
    view_drop_intervals(p->v); /* all are in items now */
    if (!status) status = view_overlay(&drawing, &p->items, &p->chains, o->halo > 0 || o->interleave > 0, &p->segments);
    array_free(&p->picture->alloc, &p->items); /* and now in segments */
    if (!status && !number_crossings(p)) status = FROE_E_MEMORY;
    if (!status) status = view_cut_segments(&p->picture->alloc, o->view, o->halo, &p->segments);
    if (!status && o->lines & FROE_LINE_POINT && !add_points(p)) status = FROE_E_MEMORY;
    return status;
}
