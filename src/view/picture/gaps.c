/* gaps.c: the gaps that other segments leave in a segment.
 *
 *      |         |              A halo is a gap in a line at a nearer one that crosses it, or behind which it ends; the
 *   ---  ---   --| -- --        depth between the two must be as much as the gap is wide, or neighbours on a curved
 *      |         |              surface would have gaps. Hidden lines of one wall lie behind those of the next:
 *    halo      dashes           drawn twice, their dashes would fill each other's gaps. */
#include "base/radix.h"
#include "base/sort.h"
#include "view/grid.h"
#include "view/picture/strokes.h"
#include <math.h>

typedef struct gap {
    double from, to;
} gap;

typedef struct gapper {
    const froe_allocator *alloc;
    const froe_projection *view;
    double halo;    /* width of gaps */
    double same[2]; /* the distance within which lines count as one: visible ones, hidden ones */
    const view_segments *in;
    view_grid grid;
    ARRAY(gap) gaps; /* of the current one */
    ARRAY(uint32_t) order;
    ARRAY(base_pair) gapped; /* the segments in which others leave gaps, which are few, and their numbers among these */
    ARRAY(uint32_t) ends;    /* of these: where their parts end */
    view_segments parts;
} gapper;

static const print_point *gap_points(const void *user, size_t i, size_t *points) {
    const view_segments *s = user;
    *points = 2;
    return s->data[i].at;
}

/* The stretch of s that is no farther than `width` from t, measured across and along it; false: none. */
static bool stretch_near(const view_segment *s, const view_segment *t, double width, gap *out) {
    const double dx = t->at[1].x - t->at[0].x, dy = t->at[1].y - t->at[0].y, length = sqrt(dx * dx + dy * dy);
    *out = (gap){0, 1};
    if (!(length > 0)) return false;
    const double limits[2][2] = {{-width, width}, {0, length}};
    for (int k = 0; k < 2; k++) { /* across, along */
        double at[2];
        for (int e = 0; e < 2; e++) {
            const double x = s->at[e].x - t->at[0].x, y = s->at[e].y - t->at[0].y;
            at[e] = (k ? dx * x + dy * y : dx * y - dy * x) / length;
        }
        for (int side = 0; side < 2; side++) {
            const double from = side ? limits[k][1] - at[0] : at[0] - limits[k][0],
                         to = side ? limits[k][1] - at[1] : at[1] - limits[k][0];
            if (from < 0 && to < 0) return false;
            if (from < 0) out->from = fmax(out->from, from / (from - to));
            if (to < 0) out->to = fmin(out->to, from / (from - to));
        }
    }
    return out->from < out->to;
}

/* How far t is in front of s, in units of the page, in the middle of a stretch of s. */
static double depth_between(const gapper *g, const view_segment *s, const view_segment *t, gap stretch) {
    const double middle = 0.5 * (stretch.from + stretch.to), dx = t->at[1].x - t->at[0].x, dy = t->at[1].y - t->at[0].y,
                 x = s->at[0].x + middle * (s->at[1].x - s->at[0].x) - t->at[0].x,
                 y = s->at[0].y + middle * (s->at[1].y - s->at[0].y) - t->at[0].y,
                 along = (x * dx + y * dy) / (dx * dx + dy * dy),
                 near_s = s->near[0] + middle * (s->near[1] - s->near[0]),
                 near_t = t->near[0] + along * (t->near[1] - t->near[0]);
    return g->view->scale * (g->view->eye.parallel ? near_t - near_s : 1 - near_s / near_t);
}

static double length_of(const view_segment *s) {
    const double x = s->at[1].x - s->at[0].x, y = s->at[1].y - s->at[0].y;
    return sqrt(x * x + y * y);
}

/* Notes the gaps that other segments leave in segment i. */
static bool compare_all(gapper *g, uint32_t i) {
    const view_segment *s = g->in->data + i;
    const double reach = fmax(g->same[s->hidden], s->hidden ? 0 : g->halo);
    view_grid_walk walk = view_grid_along(&g->grid, s->at[0], s->at[1], reach);
    g->gaps.count = 0;
    for (uint32_t j; view_grid_next(&walk, &j);) {
        const view_segment *t = g->in->data + j;
        gap x;
        if (j == i) continue;
        const int weaker = view_strength(t->kind, t->hidden) - view_strength(s->kind, s->hidden);
        for (int wide = 0; wide <= s->hidden && (weaker > 0 || (!weaker && j < i)); wide++)
            if (stretch_near(s, t, g->same[wide], &x) && (x.to - x.from) * length_of(s) >= 8 * g->same[wide] &&
                !array_push(g->alloc, &g->gaps, x)) /* lines with shorter stretches only cross */
                return false;
        if (s->hidden || t->hidden || !(g->halo > 0)) continue;
        bool meet = false; /* then they leave no halo in each other */
        for (int e = 0; e < 4; e++)
            meet = meet || (s->vertex[e / 2] != FROE_NONE && s->vertex[e / 2] == t->vertex[e % 2]);
        if (meet || !stretch_near(s, t, g->halo, &x)) continue;
        if (depth_between(g, s, t, x) >= g->halo && !array_push(g->alloc, &g->gaps, x)) return false;
    }
    return true;
}

static int by_gap_start(void *user, uint32_t a, uint32_t b) {
    const gapper *g = user;
    return (g->gaps.data[a].from > g->gaps.data[b].from) - (g->gaps.data[a].from < g->gaps.data[b].from);
}

static bool put_part(gapper *g, const view_segment *s, double from, double to) {
    view_segment part = *s;
    if (to - from < 1 && (to - from) * length_of(s) < g->same[0]) return true;
    const double share[2] = {from, to};
    for (int e = 0; e < 2; e++) {
        const double t = share[e];
        if (t == e) continue;
        part.vertex[e] = FROE_NONE;
        part.at[e].x = s->at[0].x + t * (s->at[1].x - s->at[0].x);
        part.at[e].y = s->at[0].y + t * (s->at[1].y - s->at[0].y);
        part.near[e] = s->near[0] + t * (s->near[1] - s->near[0]);
        const double u = print_share(g->view, s->space[0], s->space[1], t);
        for (int k = 0; k < 3; k++) part.space[e][k] = s->space[0][k] + u * (s->space[1][k] - s->space[0][k]);
    }
    return array_push(g->alloc, &g->parts, part);
}

/* Appends what the gaps leave of a segment. */
static bool put_parts(gapper *g, uint32_t i) {
    const view_segment *s = g->in->data + i;
    const size_t count = g->gaps.count;
    double last = 0; /* of its share before which all has been decided */
    bool ok = true;
    g->order.count = 0;
    if (!array_reserve(g->alloc, &g->order, 2 * count)) return false;
    for (uint32_t k = 0; k < count; k++) g->order.data[k] = k;
    base_merge_sort(g->order.data, g->order.data + count, count, by_gap_start, g);
    for (size_t k = 0; ok && k < count; k++) {
        const gap x = g->gaps.data[g->order.data[k]];
        ok = x.from <= last || put_part(g, s, last, x.from);
        last = fmax(last, x.to);
    }
    return ok && (last >= 1 || put_part(g, s, last, 1)) &&
           array_push(g->alloc, &g->gapped, (base_pair){i, (uint32_t)g->ends.count}) &&
           array_push(g->alloc, &g->ends, (uint32_t)g->parts.count);
}

/* Puts parts in the places of their segments, where they lie: all move as far to the right as parts need room. */
static bool replace_by_parts(gapper *g, view_segments *segments) {
    const size_t n = segments->count, gapped = g->gapped.count;
    size_t room = 0, from = 0, to = 0, parts = 0;
    if (!array_reserve(g->alloc, &g->gapped, gapped)) return false;
    base_radix_sort(g->gapped.data, g->gapped.data + gapped, gapped);
    for (size_t k = 0; k < gapped; k++) {
        const uint32_t i = g->gapped.data[k].value;
        parts += g->ends.data[i] - (i ? g->ends.data[i - 1] : 0);
        if (parts > k + 1 + room) room = parts - k - 1;
    }
    if (!gapped || !array_reserve(g->alloc, segments, room)) return !gapped;
    view_segment *at = segments->data;
    memmove(at + room, at, n * sizeof *at);
    for (size_t k = 0; k <= gapped; k++) {
        const size_t next = k < gapped ? g->gapped.data[k].key : n;
        memmove(at + to, at + room + from, (next - from) * sizeof *at);
        to += next - from, from = next + 1;
        if (k == gapped) break;
        const uint32_t i = g->gapped.data[k].value;
        for (uint32_t part = i ? g->ends.data[i - 1] : 0; part < g->ends.data[i]; part++)
            at[to++] = g->parts.data[part];
    }
    segments->count = to;
    return true;
}

/* All segments along a curve over the page: their neighbours then mostly are in the caches. NULL: no memory. */
static base_pair *make_tour(const gapper *g) {
    const size_t n = g->in->count;
    base_pair *pairs = support_calloc(g->alloc, 2 * n + 1, sizeof *pairs);
    for (uint32_t i = 0; pairs && i < n; i++) pairs[i] = (base_pair){view_grid_place(g->view, g->in->data[i].at[0]), i};
    if (pairs) base_radix_sort(pairs, pairs + n, n);
    return pairs;
}

froe_status view_cut_segments(const froe_allocator *alloc, const froe_projection *view, double halo,
                              view_segments *segments) {
    gapper g = {.alloc = alloc, .view = view, .halo = halo, .in = segments};
    const size_t n = segments->count;
    g.same[0] = 2.5e-6 * (view->width + view->height);
    g.same[1] = 20 * g.same[0];
    froe_status status = view_grid_new(alloc, view, n, gap_points, segments, &g.grid);
    base_pair *tour = make_tour(&g);
    bool ok = !status && tour;
    for (size_t k = 0; ok && k < n; k++)
        ok = compare_all(&g, tour[k].value) && (!g.gaps.count || put_parts(&g, tour[k].value));
    support_free(alloc, tour, (2 * n + 1) * sizeof *tour);
    view_grid_free(alloc, &g.grid);
    ok = ok && replace_by_parts(&g, segments);
    if (!ok && !status) status = FROE_E_MEMORY;
    array_free(alloc, &g.gaps);
    array_free(alloc, &g.order);
    array_free(alloc, &g.gapped);
    array_free(alloc, &g.ends);
    array_free(alloc, &g.parts);
    return status;
}
