/* strokes.c: segments of one kind that meet at a vertex become polylines, wires of one group. Points stay alone.
 *
 * At a vertex where several could go on, the straightest does. Where a line ends because something begins to hide it, a
 * round cap would stick out over the hiding face: such ends are marked. */
#include "view/picture/picture.h"
#include <math.h>
#include <string.h>

typedef struct chainer {
    view_painter *p;
    const froe_allocator *alloc;
    ARRAY(base_pair) ends; /* by class and vertex: 2 * segment + end; twice as long for sorting */
    size_t end_count;
    print_ends forth, back; /* how the line goes on to both sides: 2 * segment + its far end */
} chainer;

static uint32_t class_of(const view_segment *s) {
    return (s->hidden ? 0u : (uint32_t)FROE_LINE_END) + s->kind;
}

/* The order of painting, before places: hidden lines first, then by kind, those of groups together; points by depth. */
static uint64_t rank_of(const chainer *c, const view_segment *s) {
    const uint32_t *groups = c->p->chains.groups;
    const uint64_t kind = s->kind < FROE_LINE_WIRE ? (uint64_t)FROE_LINE_WIRE / s->kind : (uint64_t)s->kind * 2;
    uint64_t within = s->kind == FROE_LINE_WIRE && groups ? groups[s->object] : 0;
    if (s->kind == FROE_LINE_POINT) { /* the upper bits of doubles are in their order, when negative ones are turned */
        memcpy(&within, &s->near[0], sizeof within);
        within = (within >> 63 ? ~within : within | UINT64_C(1) << 63) >> 12;
    }
    return (uint64_t)!s->hidden << 63 | kind << 52 | within;
}

/* -------------------------------------------------------------------- polylines -- */

/* The unused segment that goes on straightest beyond end `e` of segment `i`: 2 * segment + end; FROE_NONE. */
static uint32_t continuation(const chainer *c, uint32_t i, uint32_t e) {
    const view_segment *s = c->p->segments.data + i;
    if (s->vertex[e] == FROE_NONE) return FROE_NONE;
    const uint64_t key = (uint64_t)class_of(s) << 32 | s->vertex[e];
    const double dx = s->at[e].x - s->at[!e].x, dy = s->at[e].y - s->at[!e].y;
    double best = -INFINITY;
    uint32_t found = FROE_NONE;
    size_t lo = 0, hi = c->end_count; /* the first end of that key */
    while (lo < hi) {
        const size_t mid = lo + (hi - lo) / 2;
        if (c->ends.data[mid].key < key)
            lo = mid + 1;
        else
            hi = mid;
    }
    for (size_t k = lo; k < c->end_count && c->ends.data[k].key == key; k++) {
        const uint32_t other = c->ends.data[k].value >> 1, end = c->ends.data[k].value & 1;
        const view_segment *t = c->p->segments.data + other;
        if (t->used || t->place != s->place || !view_runs_on(&c->p->chains, s->kind, s->object, t->object)) continue;
        const double x = t->at[!end].x - t->at[end].x, y = t->at[!end].y - t->at[end].y, length = sqrt(x * x + y * y);
        const double along = length > 0 ? (dx * x + dy * y) / length : 0;
        if (along > best) best = along, found = 2 * other + end;
    }
    return found;
}

/* Follows segments from end `e` of segment `i`. *vertex: where they end; FROE_NONE: within an edge. */
static bool follow_chain(chainer *c, uint32_t i, uint32_t e, print_ends *out, uint32_t *vertex) {
    out->count = 0;
    for (;;) {
        *vertex = c->p->segments.data[i].vertex[e];
        const uint32_t next = continuation(c, i, e);
        if (next == FROE_NONE) return true;
        i = next >> 1, e = !(next & 1);
        c->p->segments.data[i].used = 1;
        if (!array_push(c->alloc, out, 2 * i + e)) return false;
    }
}

/* Appends an end of a segment, 2 * segment + end, from which the line goes on along another one. */
static void put_point(chainer *c, uint32_t at, uint32_t along) {
    froe_picture *picture = c->p->picture;
    const view_segment *segments = c->p->segments.data, *s = segments + at / 2;
    picture->stroke_points.data[picture->stroke_points.count++] = s->at[at % 2];
    memcpy(picture->stroke_space.data + picture->stroke_space.count, s->space[at % 2], sizeof s->space[at % 2]);
    picture->stroke_space.count += 3;
    picture->stroke_objects.data[picture->stroke_objects.count++] = segments[along / 2].object;
}

static bool put_stroke(chainer *c, uint32_t i) {
    froe_picture *picture = c->p->picture;
    view_segment *s = c->p->segments.data + i;
    uint32_t start, end;
    s->used = 1;
    if (!follow_chain(c, i, 1, &c->forth, &end) || !follow_chain(c, i, 0, &c->back, &start)) return false;
    const bool point = s->kind == FROE_LINE_POINT;
    const size_t forth = c->forth.count, count = c->back.count + (point ? 1 : 2) + forth;
    picture_stroke stroke = {
        .first = (uint32_t)picture->stroke_points.count, .kind = s->kind, .hidden = s->hidden, .place = s->place};
    stroke.butt[0] = start == FROE_NONE, stroke.butt[1] = end == FROE_NONE;
    stroke.closed = start != FROE_NONE && start == end && count > 3; /* the last point is the first */
    stroke.count = (uint32_t)count - stroke.closed;
    if (point) stroke.closed = 1, picture->report.dots++;
    if (!array_reserve(c->alloc, &picture->stroke_points, count) ||
        !array_reserve(c->alloc, &picture->stroke_space, 3 * count) ||
        !array_reserve(c->alloc, &picture->stroke_objects, count))
        return false;
    for (size_t k = c->back.count; k-- > 0;) put_point(c, c->back.data[k], c->back.data[k]);
    put_point(c, 2 * i, 2 * i);
    for (size_t k = 0; k + stroke.closed <= forth && !point; k++) /* the far ends of it and of what follows */
        put_point(c, k ? c->forth.data[k - 1] : 2 * i + 1,
                  k < forth ? c->forth.data[k]
                  : k       ? c->forth.data[k - 1]
                            : 2 * i);
    return array_push(c->alloc, &picture->strokes, stroke);
}

/* Sorts strokes by their places in the order of painting, stably. */
static bool sort_strokes(chainer *c) {
    froe_picture *picture = c->p->picture;
    const size_t n = picture->strokes.count;
    base_pair *pairs = support_calloc(c->alloc, 2 * n + 1, sizeof *pairs);
    if (!pairs || !array_reserve(c->alloc, &picture->strokes, n))
        return support_free(c->alloc, pairs, (2 * n + 1) * sizeof *pairs), false;
    picture_stroke *strokes = picture->strokes.data;
    for (size_t i = 0; i < n; i++) {
        const uint32_t place = strokes[i].place;
        strokes[i].place = place == FROE_NONE ? (uint32_t)picture->shapes.count : c->p->painted[place];
        pairs[i] = (base_pair){strokes[i].place, (uint32_t)i};
        strokes[n + i] = strokes[i];
    }
    base_radix_sort(pairs, pairs + n, n);
    for (size_t i = 0; i < n; i++) strokes[i] = strokes[n + pairs[i].value];
    support_free(c->alloc, pairs, (2 * n + 1) * sizeof *pairs);
    return true;
}

static bool put_strokes(chainer *c) {
    const size_t n = c->p->segments.count;
    base_pair *pairs = support_calloc(c->alloc, 2 * n + 1, sizeof *pairs);
    bool ok = pairs != NULL;
    for (uint32_t i = 0; ok && i < n; i++) pairs[i] = (base_pair){rank_of(c, c->p->segments.data + i), i};
    if (ok) base_radix_sort(pairs, pairs + n, n);
    for (size_t k = 0; ok && k < n; k++)
        if (!c->p->segments.data[pairs[k].value].used) ok = put_stroke(c, pairs[k].value);
    support_free(c->alloc, pairs, (2 * n + 1) * sizeof *pairs);
    return ok;
}

froe_status view_make_strokes(view_painter *painter) {
    chainer c = {.p = painter, .alloc = &painter->picture->alloc};
    const size_t n = painter->segments.count;
    bool ok = array_reserve(c.alloc, &c.ends, 4 * n);
    for (uint32_t i = 0; ok && i < n; i++) {
        const view_segment *s = painter->segments.data + i;
        for (uint32_t e = 0; e < 2; e++)
            if (s->vertex[e] != FROE_NONE)
                c.ends.data[c.end_count++] = (base_pair){(uint64_t)class_of(s) << 32 | s->vertex[e], 2 * i + e};
    }
    if (ok) base_radix_sort(c.ends.data, c.ends.data + c.end_count, c.end_count);
    ok = ok && put_strokes(&c);
    ok = ok && sort_strokes(&c);
    array_free(c.alloc, &c.ends);
    array_free(c.alloc, &c.forth);
    array_free(c.alloc, &c.back);
    return ok ? FROE_OK : FROE_E_MEMORY;
}
