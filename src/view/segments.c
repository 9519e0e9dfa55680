/* segments.c: intervals of edges, and crossings, become segments on the page. */
#include "base/radix.h"
#include "view/picture.h"
#include <math.h>

static void set_end(const view_painter *p, view_segment *s, int e, const double *u, const double *v, double t) {
    const froe_projection *view = p->options->view;
    double x[3], at[3], page[2];
    for (int k = 0; k < 3; k++) x[k] = t == 1 ? v[k] : u[k] + t * (v[k] - u[k]);
    view_camera_point(view, x, at);
    view_camera_page(view, at, page);
    s->at[e] = (print_point){page[0], page[1]};
    s->near[e] = view->eye.parallel ? -at[2] : 1 / at[2];
}

/* What of a hidden stretch the section has left; visible ones end there anyway. */
static bool clip_to_section(const view_painter *p, const double *a, const double *b, double share[2]) {
    const froe_tree *t = p->v->tree;
    double at[2] = {0, 0};
    if (!p->v->section) return true;
    const froe_cut cut = tree_cut_at(t, 0);
    for (int k = 0; k < 3; k++) {
        const double n = cut.kind == FROE_CUT_PLANE ? cut.normal[k] : k == cut.axis;
        at[0] += n * a[k], at[1] += n * b[k];
    }
    for (int e = 0; e < 2; e++) at[e] = (at[e] - cut.value) * p->v->section;
    if (at[0] < 0 && at[1] < 0) return false;
    if (at[0] < 0) share[0] = fmax(share[0], at[0] / (at[0] - at[1]));
    if (at[1] < 0) share[1] = fmin(share[1], at[0] / (at[0] - at[1]));
    return share[0] < share[1];
}

/* The part of an edge between two shares, as far as it is on the page. */
static bool add_segment(view_painter *p, uint32_t edge, uint8_t kind, double from, double to, bool hidden) {
    const uint32_t *v = p->sights->surface->vertices + 2 * (size_t)edge;
    const double *a = view_vertex(p->sights, v[0]), *b = view_vertex(p->sights, v[1]);
    double share[2] = {from, to};
    if (!(from < to) || (hidden && !clip_to_section(p, a, b, share))) return true;
    if (!print_clip_segment(p->options->view, a, b, hidden ? 0 : 1e-6, share)) return true;
    view_segment s = {.kind = kind, .hidden = hidden, .place = FROE_NONE};
    s.vertex[0] = share[0] == 0 ? v[0] : FROE_NONE;
    s.vertex[1] = share[1] == 1 ? v[1] : FROE_NONE;
    for (int i = 0; i < 2; i++) set_end(p, &s, i, a, b, share[i]);
    return array_push(&p->picture->alloc, &p->segments, s);
}

static bool add_edge(view_painter *p, uint32_t edge, uint8_t kind) {
    size_t count;
    const froe_interval *x = froe_visibility_of_edge(p->v, edge, &count);
    double last = 0;
    for (size_t i = 0; i < count; i++) {
        if (!add_segment(p, edge, kind, x[i].from, x[i].to, false)) return false;
        if (p->options->hidden && !add_segment(p, edge, kind, last, x[i].from, true)) return false;
        last = x[i].to;
    }
    return !p->options->hidden || add_segment(p, edge, kind, last, 1, true);
}

/* Ends of crossings at one place of the page get one number, above those of vertices. */
static bool number_crossings(view_painter *p, size_t first) {
    const size_t n = 2 * (p->segments.count - first);
    const double fine = 1e6 / (p->options->view->width + p->options->view->height);
    uint32_t number = p->sights->tree->scene->vertex_count;
    base_pair *pairs = base_calloc(&p->picture->alloc, 2 * n + 1, sizeof *pairs);
    for (size_t i = 0; pairs && i < n; i++) {
        const print_point at = p->segments.data[first + i / 2].at[i % 2];
        const uint64_t x = (uint64_t)(int64_t)floor(at.x * fine + 0.5) & UINT32_MAX,
                       y = (uint64_t)(int64_t)floor(at.y * fine + 0.5) & UINT32_MAX;
        pairs[i] = (base_pair){x << 32 | y, (uint32_t)i};
    }
    if (pairs) base_radix_sort(pairs, pairs + n, n);
    for (size_t i = 0; pairs && i < n; i++) {
        number += i && pairs[i].key != pairs[i - 1].key;
        p->segments.data[first + pairs[i].value / 2].vertex[pairs[i].value % 2] = number;
    }
    base_free(&p->picture->alloc, pairs, (2 * n + 1) * sizeof *pairs);
    return pairs != NULL;
}

static bool add_crossings(view_painter *p) {
    size_t count;
    const size_t first = p->segments.count;
    const froe_crossing *x = froe_visibility_crossings(p->v, &count);
    for (size_t i = 0; i < count; i++) {
        double share[2] = {0, 1};
        const uint32_t kind = x[i].section ? FROE_LINE_SECTION : FROE_LINE_CROSSING;
        const double beyond = x[i].hidden ? 0 : 1e-6;
        if (!(p->options->lines & kind) || !print_clip_segment(p->options->view, x[i].from, x[i].to, beyond, share))
            continue;
        view_segment s = {.kind = (uint8_t)kind, .hidden = x[i].hidden, .place = FROE_NONE};
        for (int e = 0; e < 2; e++) set_end(p, &s, e, x[i].from, x[i].to, share[e]);
        if (!array_push(&p->picture->alloc, &p->segments, s)) return false;
    }
    return number_crossings(p, first);
}

froe_status view_make_segments(view_painter *p, const uint8_t *kinds) {
    const froe_picture_options *o = p->options;
    bool ok = true;
    for (uint32_t e = 0; ok && e < p->sights->surface->edge_count; e++) ok = !kinds[e] || add_edge(p, e, kinds[e]);
    ok = ok && add_crossings(p);
    if (ok && (o->hidden || o->halo > 0)) ok = !view_cut_segments(&p->picture->alloc, o->view, o->halo, &p->segments);
    return ok ? FROE_OK : FROE_E_MEMORY;
}
