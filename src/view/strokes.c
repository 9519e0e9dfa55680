/* strokes.c: intervals of edges become segments, segments of one kind that meet at a vertex become polylines.
 *
 * At a vertex where several could go on, the straightest does. Where a line ends because something begins to hide it, a
 * round cap would stick out over what hides it: such ends are marked. */
#include "view/strokes.h"
#include "view/picture.h"
#include <math.h>

typedef struct chainer {
    view_painter *p;
    const froe_allocator *alloc;
    const uint8_t *kinds;
    view_segments segments;
    ARRAY(base_pair) ends; /* by class and vertex: 2 * segment + end; twice as long for sorting */
    size_t end_count;
    print_ring forth, back;
} chainer;

/* -------------------------------------------------------------------- segments -- */

static uint32_t class_of(const view_segment *s) {
    return (s->hidden ? 0u : 256u) + s->kind;
}

static void set_end(const chainer *c, view_segment *s, int e, const double *u, const double *v, double t) {
    const froe_projection *view = c->p->options->view;
    double x[3], at[3], page[2];
    for (int k = 0; k < 3; k++) x[k] = t == 1 ? v[k] : u[k] + t * (v[k] - u[k]);
    view_camera_point(view, x, at);
    view_camera_page(view, at, page);
    s->at[e] = (print_point){page[0], page[1]};
    s->near[e] = view->eye.parallel ? -at[2] : 1 / at[2];
}

/* The part of an edge between two shares, as far as it is on the page. */
static bool add_segment(chainer *c, uint32_t edge, double from, double to, bool hidden) {
    const uint32_t *v = c->p->sights->surface->vertices + 2 * (size_t)edge;
    const double *a = view_vertex(c->p->sights, v[0]), *b = view_vertex(c->p->sights, v[1]);
    double share[2] = {from, to};
    if (!(from < to) || !print_clip_segment(c->p->options->view, a, b, hidden ? 0 : 1e-6, share)) return true;
    view_segment s = {.kind = c->kinds[edge], .hidden = hidden};
    s.vertex[0] = share[0] == 0 ? v[0] : FROE_NONE;
    s.vertex[1] = share[1] == 1 ? v[1] : FROE_NONE;
    for (int i = 0; i < 2; i++) set_end(c, &s, i, a, b, share[i]);
    return array_push(c->alloc, &c->segments, s);
}

static bool add_edge(chainer *c, uint32_t edge) {
    size_t count;
    const froe_interval *x = froe_visibility_of_edge(c->p->v, edge, &count);
    double last = 0;
    for (size_t i = 0; i < count; i++) {
        if (!add_segment(c, edge, x[i].from, x[i].to, false)) return false;
        if (c->p->options->hidden && !add_segment(c, edge, last, x[i].from, true)) return false;
        last = x[i].to;
    }
    return !c->p->options->hidden || add_segment(c, edge, last, 1, true);
}

/* Ends of crossings at one place of the page get one number, above those of vertices. */
static bool number_crossings(chainer *c, size_t first) {
    const size_t n = 2 * (c->segments.count - first);
    const double fine = 1e6 / (c->p->options->view->width + c->p->options->view->height);
    uint32_t number = c->p->sights->tree->scene->vertex_count;
    base_pair *pairs = base_calloc(c->alloc, 2 * n + 1, sizeof *pairs);
    for (size_t i = 0; pairs && i < n; i++) {
        const print_point at = c->segments.data[first + i / 2].at[i % 2];
        const uint64_t x = (uint64_t)(int64_t)floor(at.x * fine + 0.5) & UINT32_MAX,
                       y = (uint64_t)(int64_t)floor(at.y * fine + 0.5) & UINT32_MAX;
        pairs[i] = (base_pair){x << 32 | y, (uint32_t)i};
    }
    if (pairs) base_radix_sort(pairs, pairs + n, n);
    for (size_t i = 0; pairs && i < n; i++) {
        number += i && pairs[i].key != pairs[i - 1].key;
        c->segments.data[first + pairs[i].value / 2].vertex[pairs[i].value % 2] = number;
    }
    base_free(c->alloc, pairs, (2 * n + 1) * sizeof *pairs);
    return pairs != NULL;
}

static bool add_crossings(chainer *c) {
    size_t count;
    const size_t first = c->segments.count;
    const froe_crossing *x = froe_visibility_crossings(c->p->v, &count);
    for (size_t i = 0; i < count; i++) {
        double share[2] = {0, 1};
        if (!print_clip_segment(c->p->options->view, x[i].from, x[i].to, 1e-6, share)) continue;
        view_segment s = {.kind = FROE_LINE_CROSSING};
        for (int e = 0; e < 2; e++) set_end(c, &s, e, x[i].from, x[i].to, share[e]);
        if (!array_push(c->alloc, &c->segments, s)) return false;
    }
    return number_crossings(c, first);
}

static bool list_ends(chainer *c) {
    const size_t n = c->segments.count;
    if (!array_reserve(c->alloc, &c->ends, 4 * n)) return false;
    c->end_count = 0;
    for (uint32_t i = 0; i < n; i++) {
        const view_segment *s = c->segments.data + i;
        for (uint32_t e = 0; e < 2; e++)
            if (s->vertex[e] != FROE_NONE)
                c->ends.data[c->end_count++] = (base_pair){(uint64_t)class_of(s) << 32 | s->vertex[e], 2 * i + e};
    }
    base_radix_sort(c->ends.data, c->ends.data + c->end_count, c->end_count);
    return true;
}

/* -------------------------------------------------------------------- polylines -- */

static size_t first_end(const chainer *c, uint64_t key) {
    size_t lo = 0, hi = c->end_count;
    while (lo < hi) {
        const size_t mid = lo + (hi - lo) / 2;
        if (c->ends.data[mid].key < key)
            lo = mid + 1;
        else
            hi = mid;
    }
    return lo;
}

/* The unused segment that goes on straightest beyond end `e` of segment `i`: 2 * segment + end; FROE_NONE. */
static uint32_t continuation(const chainer *c, uint32_t i, uint32_t e) {
    const view_segment *s = c->segments.data + i;
    if (s->vertex[e] == FROE_NONE) return FROE_NONE;
    const uint64_t key = (uint64_t)class_of(s) << 32 | s->vertex[e];
    const double dx = s->at[e].x - s->at[!e].x, dy = s->at[e].y - s->at[!e].y;
    double best = -INFINITY;
    uint32_t found = FROE_NONE;
    for (size_t k = first_end(c, key); k < c->end_count && c->ends.data[k].key == key; k++) {
        const uint32_t other = c->ends.data[k].value >> 1, end = c->ends.data[k].value & 1;
        const view_segment *t = c->segments.data + other;
        if (t->used) continue;
        const double x = t->at[!end].x - t->at[end].x, y = t->at[!end].y - t->at[end].y, length = sqrt(x * x + y * y);
        const double along = length > 0 ? (dx * x + dy * y) / length : 0;
        if (along > best) best = along, found = 2 * other + end;
    }
    return found;
}

/* Follows segments from end `e` of segment `i`; their far ends go to `out`. *free: the last end is within an edge. */
static bool follow(chainer *c, uint32_t i, uint32_t e, print_ring *out, uint32_t *vertex) {
    out->count = 0;
    for (;;) {
        *vertex = c->segments.data[i].vertex[e];
        const uint32_t next = continuation(c, i, e);
        if (next == FROE_NONE) return true;
        i = next >> 1, e = !(next & 1);
        c->segments.data[i].used = 1;
        if (!array_push(c->alloc, out, c->segments.data[i].at[e])) return false;
    }
}

static bool put_stroke(chainer *c, uint32_t i) {
    froe_picture *picture = c->p->picture;
    view_segment *s = c->segments.data + i;
    uint32_t start, end;
    s->used = 1;
    if (!follow(c, i, 1, &c->forth, &end) || !follow(c, i, 0, &c->back, &start)) return false;
    picture_stroke stroke = {.first = (uint32_t)picture->stroke_points.count, .kind = s->kind, .hidden = s->hidden};
    stroke.count = (uint32_t)(c->forth.count + c->back.count + 2);
    stroke.butt[0] = start == FROE_NONE, stroke.butt[1] = end == FROE_NONE;
    if (!array_reserve(c->alloc, &picture->stroke_points, stroke.count)) return false;
    print_point *out = picture->stroke_points.data + stroke.first;
    for (size_t k = c->back.count; k-- > 0;) *out++ = c->back.data[k];
    *out++ = s->at[0], *out++ = s->at[1];
    for (size_t k = 0; k < c->forth.count; k++) *out++ = c->forth.data[k];
    stroke.closed = start != FROE_NONE && start == end && stroke.count > 3;
    if (stroke.closed) stroke.count--; /* the last point is the first */
    picture->stroke_points.count += stroke.count;
    return array_push(c->alloc, &picture->strokes, stroke);
}

/* Hidden lines first, then by kind. */
static bool put_strokes(chainer *c) {
    for (int hidden = 1; hidden >= 0; hidden--)
        for (uint32_t kind = FROE_LINE_END >> 1; kind; kind >>= 1)
            for (uint32_t i = 0; i < c->segments.count; i++) {
                const view_segment *s = c->segments.data + i;
                if (s->used || s->kind != kind || s->hidden != hidden) continue;
                if (!put_stroke(c, i)) return false;
            }
    return true;
}

froe_status view_make_strokes(view_painter *painter, const uint8_t *kinds) {
    chainer c = {.p = painter, .alloc = &painter->picture->alloc, .kinds = kinds};
    bool ok = true;
    for (uint32_t e = 0; ok && e < painter->sights->surface->edge_count; e++) ok = !kinds[e] || add_edge(&c, e);
    ok = ok && add_crossings(&c);
    if (ok && (painter->options->hidden || painter->options->halo > 0))
        ok = !view_cut_segments(c.alloc, painter->options->view, painter->options->halo, &c.segments);
    ok = ok && list_ends(&c) && put_strokes(&c);
    array_free(c.alloc, &c.segments);
    array_free(c.alloc, &c.ends);
    array_free(c.alloc, &c.forth);
    array_free(c.alloc, &c.back);
    return ok ? FROE_OK : FROE_E_MEMORY;
}
