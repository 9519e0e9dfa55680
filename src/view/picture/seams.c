/* seams.c: visible pieces on the page, and their parts along a side. */
#include "view/picture/seams.h"
#include "base/sort.h"
#include "support/clip.h"
#include <math.h>

/* ----------------------------------------------------------------- begin, end -- */

static const print_point *seam_points(const void *user, size_t i, size_t *points) {
    const view_seams *s = user;
    *points = s->starts.data[i + 1] - s->starts.data[i];
    return s->points.data + s->starts.data[i];
}

froe_status view_seams_new(view_seams *s, view_parts *parts, const uint32_t *order, const uint8_t *breaks,
                           const uint32_t *styles, const uint8_t *clear, double width) {
    const froe_allocator *alloc = &parts->v->alloc;
    const size_t n = parts->nodes.count;
    uint32_t run = 0, last = FROE_NONE;
    *s = (view_seams){.parts = parts, .clear = clear, .width = width};
    s->place = support_calloc(alloc, n + 1, sizeof *s->place);
    s->run = support_calloc(alloc, n + 1, sizeof *s->run);
    if (!s->place || !s->run || !array_reserve(alloc, &s->starts, (size_t)parts->v->piece_count + 1))
        return FROE_E_MEMORY;
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t patch = parts->nodes.data[order[i]].patch, style = styles ? styles[patch] : 0;
        run += style != last || (breaks && breaks[i]);
        last = style;
        s->place[order[i]] = i;
        s->run[order[i]] = run;
    }
    if (!array_reserve(alloc, &s->points, parts->v->corners.count)) return FROE_E_MEMORY; /* most are not cut */
    for (uint32_t i = 0; i < parts->v->piece_count; i++) {
        s->starts.data[s->starts.count++] = (uint32_t)s->points.count;
        if (!view_print_visible(parts, i, &s->points)) return FROE_E_MEMORY;
        if (s->points.count > INT32_MAX) return FROE_E_LIMIT;
    }
    s->starts.data[s->starts.count++] = (uint32_t)s->points.count;
    return FROE_OK;
}

froe_status view_seams_spread(view_seams *s) {
    return view_grid_new(&s->parts->v->alloc, s->parts->view, s->parts->v->piece_count, seam_points, s, &s->grid);
}

void view_seams_free(view_seams *s) {
    if (!s->parts) return;
    const froe_allocator *alloc = &s->parts->v->alloc;
    support_free(alloc, s->place, (s->parts->nodes.count + 1) * sizeof *s->place);
    support_free(alloc, s->run, (s->parts->nodes.count + 1) * sizeof *s->run);
    view_grid_free(alloc, &s->grid);
    array_free(alloc, &s->points);
    array_free(alloc, &s->starts);
    *s = (view_seams){.parts = NULL};
}

froe_status view_seams_fork(const view_seams *s, view_seams *out) {
    const froe_allocator *alloc = &s->parts->v->alloc;
    *out = *s;
    out->marks = support_calloc(alloc, s->parts->nodes.count + 1, sizeof *out->marks);
    return view_grid_fork(alloc, &s->grid, &out->grid) || !out->marks ? FROE_E_MEMORY : FROE_OK;
}

void view_seams_close(view_seams *s) {
    if (!s->parts) return;
    const froe_allocator *alloc = &s->parts->v->alloc;
    view_grid_close(alloc, &s->grid);
    support_free(alloc, s->marks, (s->parts->nodes.count + 1) * sizeof *s->marks);
    array_free(alloc, &s->near);
    array_free(alloc, &s->own);
    array_free(alloc, &s->inside);
    array_free(alloc, &s->beyond);
    array_free(alloc, &s->order);
    array_free(alloc, &s->extra);
    array_free(alloc, &s->extra_ends);
    array_free(alloc, &s->clip[0]);
    array_free(alloc, &s->clip[1]);
}

/* -------------------------------------------------------------------- clipping -- */

/* The common part of a visible piece and a convex ring of four corners, into clip[0]: cut side by side. */
static bool clip_piece(view_seams *s, uint32_t visible, const print_point ring[4]) {
    const froe_allocator *alloc = &s->parts->v->alloc;
    const seam_span span = view_seam_span(s, visible);
    s->clip[0].count = 0;
    if (!array_reserve(alloc, &s->clip[0], span.count)) return false;
    for (size_t i = 0; i < span.count; i++) s->clip[0].data[s->clip[0].count++] = s->points.data[span.first + i];
    for (int side = 0; side < 4; side++) {
        const print_ring *in = &s->clip[side % 2];
        print_ring *out = &s->clip[!(side % 2)];
        const print_point a = ring[side], b = ring[(side + 1) % 4];
        const double dx = b.x - a.x, dy = b.y - a.y;
        out->count = 0;
        if (!array_reserve(alloc, out, 2 * in->count)) return false;
        for (size_t i = 0; i < in->count; i++) { /* what is on the left of ab, as the eye sees it */
            const print_point p = in->data[i], q = in->data[i + 1 < in->count ? i + 1 : 0];
            const double at_p = dy * (p.x - a.x) - dx * (p.y - a.y), at_q = dy * (q.x - a.x) - dx * (q.y - a.y);
            const support_clipped left = support_clip_edge(at_p, at_q);
            if (left.corner) out->data[out->count++] = p;
            if (left.meeting)
                out->data[out->count++] = (print_point){p.x + left.share * (q.x - p.x), p.y + left.share * (q.y - p.y)};
        }
    }
    return true;
}

/* -------------------------------------------------------------------- looking -- */

void view_make_strip(print_point a, print_point b, double width, print_point out[4]) {
    const double dx = b.x - a.x, dy = b.y - a.y, length = sqrt(dx * dx + dy * dy);
    const double x = -dy / length * width, y = dx / length * width; /* to the right: y points down */
    const bool right = width > 0;
    out[0] = right ? b : a;
    out[1] = right ? a : b;
    out[2] = (print_point){out[1].x + x, out[1].y + y};
    out[3] = (print_point){out[0].x + x, out[0].y + y};
}

bool view_seams_near(view_seams *s, view_grid_walk walk) {
    s->near.count = 0;
    for (uint32_t i; view_grid_next(&walk, &i);)
        if (!array_push(&s->parts->v->alloc, &s->near, i)) return false;
    return true;
}

bool view_seams_own(view_seams *s, uint32_t node, view_grid_walk walk) {
    enum { FEW = 32 };
    const uint32_t *node_of = s->parts->node_of, first = s->parts->nodes.data[node].first,
                   most = s->parts->v->piece_count - first;
    uint32_t n = 0;
    while (n < most && n <= FEW && node_of[first + n] == node) n++;
    s->own.count = 0;
    if (!array_reserve(&s->parts->v->alloc, &s->own, FEW)) return false;
    for (uint32_t i = 0; n <= FEW && i < n; i++) s->own.data[s->own.count++] = first + i;
    for (uint32_t i; n > FEW && view_grid_next(&walk, &i);)
        if (node_of[i] == node && !array_push(&s->parts->v->alloc, &s->own, i)) return false;
    return true;
}

bool view_seam_meets(const view_seams *s, uint32_t visible, const print_point *ring, size_t count) {
    const seam_span span = view_seam_span(s, visible);
    return span.count > 2 &&
           print_overlap(s->points.data + span.first, span.count, ring, count, SEAM_MARGIN * s->width);
}

bool view_own_meets(const view_seams *s, const print_point *ring, size_t count) {
    bool meets = false;
    for (size_t i = 0; i < s->own.count && !meets; i++) meets = view_seam_meets(s, s->own.data[i], ring, count);
    return meets;
}

bool view_seam_covers(const view_seams *s, uint32_t visible, uint32_t node) {
    const uint32_t other = s->parts->node_of[visible];
    return s->place[other] > s->place[node] && s->run[other] != s->run[node] &&
           !(s->clear && s->clear[s->parts->nodes.data[other].patch]);
}

/* ---------------------------------------------------------------------- strips -- */

/* Appends the stretch of ab along which a piece lies in a strip beside it. */
static bool add_range(view_seams *s, seam_ranges *ranges, uint32_t visible, const print_point strip[4], print_point a,
                      print_point b) {
    const double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
    seam_range r = {1, 0};
    if (!clip_piece(s, visible, strip)) return false;
    for (size_t i = 0; i < s->clip[0].count; i++) {
        const double t = ((s->clip[0].data[i].x - a.x) * dx + (s->clip[0].data[i].y - a.y) * dy) / square;
        const double lo = t > 0 ? t : 0, hi = t < 1 ? t : 1; /* calls of fmin() would take longer than all else here */
        r.from = lo < r.from ? lo : r.from, r.to = hi > r.to ? hi : r.to;
    }
    return r.from >= r.to || array_push(&s->parts->v->alloc, ranges, r);
}

static int by_seam_start(void *user, uint32_t i, uint32_t j) {
    const seam_ranges *ranges = user;
    const double x = ranges->data[i].from, y = ranges->data[j].from;
    return (x > y) - (x < y);
}

/* Sorts ranges and joins what touches. */
static bool join_ranges(view_seams *s, seam_ranges *ranges) {
    const froe_allocator *alloc = &s->parts->v->alloc;
    const size_t n = ranges->count;
    s->order.count = 0;
    if (!array_reserve(alloc, &s->order, 2 * n) || !array_reserve(alloc, ranges, n)) return false;
    for (uint32_t i = 0; i < n; i++) s->order.data[i] = i;
    base_merge_sort(s->order.data, s->order.data + n, n, by_seam_start, ranges);
    for (size_t i = 0; i < n; i++) ranges->data[n + i] = ranges->data[s->order.data[i]];
    ranges->count = 0;
    for (size_t i = 0; i < n; i++) {
        const seam_range r = ranges->data[n + i];
        seam_range *last = ranges->data + ranges->count - 1;
        if (ranges->count && r.from <= last->to + 1e-6)
            last->to = fmax(last->to, r.to);
        else
            ranges->data[ranges->count++] = r;
    }
    return true;
}

/* Beyond ab from one share to the other, narrower outside, as wide as there is room. */
static bool put_strip(view_seams *s, uint32_t node, print_point a, print_point b, double from, double to) {
    const double dx = b.x - a.x, dy = b.y - a.y, length = sqrt(dx * dx + dy * dy);
    const print_point u = {a.x + from * dx, a.y + from * dy}, v = {a.x + to * dx, a.y + to * dy};
    const froe_allocator *alloc = &s->parts->v->alloc;
    bool all = (to - from) * length < s->width; /* too short to be seen */
    for (int trial = 0; !all && trial < 6; trial++) {
        /* Where the border of the later face leads away at a sharp angle, only slanting ends stay within it. */
        const double w = s->width / (1 << trial / 2) / length, slant = trial % 2 ? 1.6 : 0.4, x = dx * w, y = dy * w;
        const print_point strip[4] = {
            v, u, {u.x - y + slant * x, u.y + x + slant * y}, {v.x - y - slant * x, v.y + x - slant * y}};
        if (2 * slant * w >= to - from) continue;
        double covered = 0; /* by pieces that are painted later, which do not overlap */
        for (size_t i = 0; i < s->near.count; i++) {
            if (!view_seam_covers(s, s->near.data[i], node)) continue;
            if (!clip_piece(s, s->near.data[i], strip)) return false;
            covered += s->clip[0].count < 3 ? 0 : print_area(s->clip[0].data, s->clip[0].count);
        }
        all = covered > 0.999 * print_area(strip, 4);
        if (!all) continue;
        if (!array_reserve(alloc, &s->extra, 4)) return false;
        for (int i = 0; i < 4; i++) s->extra.data[s->extra.count++] = strip[i];
        if (!array_push(alloc, &s->extra_ends, (uint32_t)s->extra.count)) return false;
    }
    return true;
}

/* Drops near pieces that do not cover the node, or lie wholly beside the strip beyond ab. */
static void drop_far(view_seams *s, uint32_t node, print_point a, print_point b) {
    const double dx = b.x - a.x, dy = b.y - a.y, slack = 1 + 1e-6, length = sqrt(dx * dx + dy * dy) * slack;
    size_t kept = 0;
    for (size_t i = 0; i < s->near.count; i++) {
        const seam_span span = view_seam_span(s, s->near.data[i]);
        double lo = INFINITY, hi = -INFINITY; /* to the right: y points down */
        for (size_t k = span.first; k < span.first + span.count; k++) {
            const double at = dx * (s->points.data[k].y - a.y) - dy * (s->points.data[k].x - a.x);
            lo = at < lo ? at : lo, hi = at > hi ? at : hi;
        }
        const bool beyond = lo <= s->width * length && hi >= 0;
        if (beyond && view_seam_covers(s, s->near.data[i], node)) s->near.data[kept++] = s->near.data[i];
    }
    s->near.count = kept;
}

/* Where the node is visible inside ab, by the list `own`, and something later beyond it. */
static bool put_strips(view_seams *s, uint32_t node, print_point a, print_point b) {
    print_point inner[4], outer[4];
    s->inside.count = s->beyond.count = 0;
    view_make_strip(a, b, -0.1 * s->width, inner);
    view_make_strip(a, b, 0.1 * s->width, outer);
    for (size_t i = 0; i < s->own.count; i++)
        if (!add_range(s, &s->inside, s->own.data[i], inner, a, b)) return false;
    if (!s->inside.count) return true;
    if (!join_ranges(s, &s->inside)) return false;
    const double dx = b.x - a.x, dy = b.y - a.y, first = s->inside.data[0].from,
                 last = s->inside.data[s->inside.count - 1].to;
    const print_point u = {a.x + first * dx, a.y + first * dy}, v = {a.x + last * dx, a.y + last * dy};
    if (!view_seams_near(s, view_grid_along(&s->grid, u, v, s->width))) return false;
    drop_far(s, node, a, b);
    for (size_t i = 0; i < s->near.count; i++)
        if (!add_range(s, &s->beyond, s->near.data[i], outer, a, b)) return false;
    if (!join_ranges(s, &s->beyond)) return false;
    for (size_t i = 0, j = 0; i < s->inside.count && j < s->beyond.count;) {
        const seam_range p = s->inside.data[i], q = s->beyond.data[j];
        const double from = fmax(p.from, q.from), to = fmin(p.to, q.to);
        if (from < to && !put_strip(s, node, a, b, from, to)) return false;
        if (p.to < q.to)
            i++;
        else
            j++;
    }
    return true;
}

bool view_seams_look(view_seams *s, uint32_t node, print_point a, print_point b, bool *beside) {
    print_point inner[4];
    *beside = false;
    if (a.x == b.x && a.y == b.y) return true;
    view_make_strip(a, b, -0.5 * s->width, inner);
    if (!view_seams_own(s, node, view_grid_along(&s->grid, a, b, s->width))) return false;
    *beside = view_own_meets(s, inner, 4);
    return !*beside || put_strips(s, node, a, b);
}

bool view_seams_flush(view_seams *s, print_ring *points, print_ends *ends) {
    const froe_allocator *alloc = &s->parts->v->alloc;
    const uint32_t first = (uint32_t)points->count;
    if (!array_reserve(alloc, points, s->extra.count) || !array_reserve(alloc, ends, s->extra_ends.count)) return false;
    for (size_t i = 0; i < s->extra.count; i++) points->data[points->count++] = s->extra.data[i];
    for (size_t i = 0; i < s->extra_ends.count; i++) ends->data[ends->count++] = first + s->extra_ends.data[i];
    s->extra.count = s->extra_ends.count = 0;
    return true;
}
