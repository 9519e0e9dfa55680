/* bar_shape.c: a box, clipped by the other facets.
 *
 * Two corners are the ends of an edge when dim - 1 facets hold both. Where many facets meet in one point rounding may
 * leave several corners there, or miss that a facet holds one: then edges are doubled, or lie inside; both change
 * nothing, since all that is asked for are least and largest values. */
#include "build/bar/bar_shape.h"
#include <math.h>
#include <string.h>

enum { BISECTIONS = 40, ROUNDS = 3 };
#define PAD 0x1p-48
#define SAME 0x1p-44 /* corners no further apart than this share of the cell are one */

bar_region bar_region_of(int dim, const double *lo, const double *hi) {
    bar_region r = {.goal = 0};
    for (int i = 0; i < FROE_MAX_DIM; i++) {
        r.lo[i] = i < dim ? lo[i] : -INFINITY;
        r.hi[i] = i < dim ? hi[i] : INFINITY;
    }
    return r;
}

double bar_shape_local(const bar_shape *s, int i, double value) {
    return num_pair_sub((num_pair){value, 0}, s->shift[i]).hi;
}

double bar_shape_global(const bar_shape *s, int i, double local) {
    return num_pair_add((num_pair){local, 0}, s->shift[i]).hi;
}

/** Lowers *bound, or raises it (sign -1), to a sum that bounds the same, made larger by more than its rounding. */
static void lower(double *bound, int sign, double sum, double size) {
    const double to = sign * sum + PAD * size;
    if (to < sign * *bound) *bound = sign * to;
}

/** Bounds on axis k from one diagonal: n . x less what the other axes add at least, or at most. */
static void bound_by_one(const split_directions *d, int i, int k, bar_region *r) {
    const double *n = d->normals[i];
    double least = n[k] > 0 ? r->lo[i] : -r->hi[i], most = n[k] > 0 ? r->hi[i] : -r->lo[i];
    double size[2] = {fabs(least), fabs(most)};
    for (int j = 0; j < d->dim; j++) {
        if (j == k) continue;
        const bool same = n[j] * n[k] > 0;
        least -= same ? r->hi[j] : -r->lo[j];
        most -= same ? r->lo[j] : -r->hi[j];
        size[0] += fabs(same ? r->hi[j] : r->lo[j]);
        size[1] += fabs(same ? r->lo[j] : r->hi[j]);
    }
    lower(&r->lo[k], -1, least, size[0]);
    lower(&r->hi[k], 1, most, size[1]);
}

/** Bounds on an axis from two diagonals, if their sum or difference (sign) is twice an axis. */
static void bound_by_two(const split_directions *d, int i, int j, int sign, bar_region *r) {
    int axis = -1, count = 0;
    for (int k = 0; k < d->dim; k++)
        if (d->normals[i][k] + sign * d->normals[j][k] != 0) axis = k, count++;
    if (count != 1) return;
    const double least[2] = {0.5 * r->lo[i], 0.5 * (sign > 0 ? r->lo[j] : -r->hi[j])};
    const double most[2] = {0.5 * r->hi[i], 0.5 * (sign > 0 ? r->hi[j] : -r->lo[j])};
    const bool up = d->normals[i][axis] > 0;
    const double *below = up ? least : most, *above = up ? most : least;
    const int turn = up ? 1 : -1;
    lower(&r->lo[axis], -1, turn * (below[0] + below[1]), fabs(below[0]) + fabs(below[1]));
    lower(&r->hi[axis], 1, turn * (above[0] + above[1]), fabs(above[0]) + fabs(above[1]));
}

/** Moves the cell to the middle of its box, and begins with the corners of that; false: the box is empty. *size: its
 * longest side. */
static bool begin_box(bar_shape *s, const bar_region *r, double *size) {
    const split_directions *d = s->directions;
    double o[3] = {0}, lo[3], hi[3];
    for (int k = 0; k < d->dim; k++) o[k] = 0.5 * r->lo[k] + 0.5 * r->hi[k];
    for (int i = 0; i < d->count; i++) {
        const double *n = d->normals[i];
        s->shift[i] = num_pair_add(num_pair_sum(n[0] * o[0], n[1] * o[1]), (num_pair){n[2] * o[2], 0});
    }
    *size = 0;
    for (int k = 0; k < d->dim; k++) {
        lo[k] = bar_shape_local(s, k, r->lo[k]);
        hi[k] = bar_shape_local(s, k, r->hi[k]);
        if (!(lo[k] < hi[k])) return false;
        if (hi[k] - lo[k] > *size) *size = hi[k] - lo[k];
    }
    s->count = 1u << d->dim;
    for (uint32_t c = 0; c < s->count; c++) {
        double x[3] = {0};
        s->corners[c].facets = 0;
        for (int k = 0; k < d->dim; k++) {
            unsigned high = c >> k & 1;
            x[k] = high ? hi[k] : lo[k];
            s->corners[c].facets |= 1u << (2 * (unsigned)k + high);
        }
        for (int i = 0; i < d->count; i++) s->corners[c].at[i] = split_key(d, i, x);
    }
    return true;
}

static bool joined(const bar_shape *s, uint32_t a, uint32_t b) {
    return __builtin_popcount(s->corners[a].facets & s->corners[b].facets) >= s->directions->dim - 1;
}

/** Adds a corner, unless one of those from `first` on is there already. */
static bool add_bar_corner(bar_shape *s, uint32_t first, const bar_corner *corner, double size) {
    for (uint32_t c = first; c < s->count; c++) {
        int i = 0;
        while (i < s->directions->count && fabs(s->corners[c].at[i] - corner->at[i]) <= SAME * size) i++;
        if (i < s->directions->count) continue;
        s->corners[c].facets |= corner->facets;
        return true;
    }
    if (s->count == BAR_CORNERS) return false;
    s->corners[s->count++] = *corner;
    return true;
}

/** The point of an edge where n . y = at. */
static bar_corner meet_edge(const bar_shape *s, uint32_t from, uint32_t to, int direction, double at) {
    const bar_corner *a = s->corners + from, *b = s->corners + to;
    double t = (at - a->at[direction]) / (b->at[direction] - a->at[direction]);
    bar_corner corner = {.facets = a->facets & b->facets};
    for (int i = 0; i < s->directions->count; i++) corner.at[i] = a->at[i] + t * (b->at[i] - a->at[i]);
    corner.at[direction] = at;
    return corner;
}

/** Keeps the part where sign * (n . y - at) >= 0. */
static bool clip_bar_shape(bar_shape *s, int direction, double at, int sign, double size) {
    const uint32_t old = s->count, facet = 1u << (2 * direction + (sign < 0));
    double beyond[BAR_CORNERS];
    uint32_t kept = 0;
    for (uint32_t c = 0; c < old; c++) beyond[c] = sign * (s->corners[c].at[direction] - at);
    for (uint32_t a = 0; a < old; a++)
        for (uint32_t b = 0; b < old; b++) {
            if (!(beyond[a] > 0 && beyond[b] < 0) || !joined(s, a, b)) continue;
            bar_corner corner = meet_edge(s, a, b, direction, at);
            corner.facets |= facet;
            if (!add_bar_corner(s, old, &corner, size)) return false;
        }
    for (uint32_t c = 0; c < s->count; c++) {
        if (c < old && beyond[c] < 0) continue;
        if (c < old && beyond[c] == 0) s->corners[c].facets |= facet;
        s->corners[kept++] = s->corners[c];
    }
    s->count = kept;
    return kept > 0;
}

/* Least and largest values in all directions. */
typedef struct extent {
    double lo[DIRECTIONS_MOST], hi[DIRECTIONS_MOST];
} extent;

static extent no_extent(void) {
    extent e;
    for (int i = 0; i < DIRECTIONS_MOST; i++) e.lo[i] = INFINITY, e.hi[i] = -INFINITY;
    return e;
}

static void widen_extent(extent *e, const bar_corner *c, int count) {
    for (int i = 0; i < count; i++) {
        e->lo[i] = c->at[i] < e->lo[i] ? c->at[i] : e->lo[i];
        e->hi[i] = c->at[i] > e->hi[i] ? c->at[i] : e->hi[i];
    }
}

static double aspect_of(const split_directions *d, const extent *e, double *least) {
    double lo = INFINITY, hi = 0;
    for (int i = 0; i < d->count; i++) {
        double width = (e->hi[i] - e->lo[i]) / d->lengths[i];
        if (!(width > 0)) return (double)INFINITY;
        lo = width < lo ? width : lo;
        hi = width > hi ? width : hi;
    }
    *least = lo;
    return hi / lo;
}

bool bar_shape_of(const split_directions *d, const bar_region *region, bar_shape *s) {
    double size;
    bar_region near = *region, *r = &near;
    s->directions = d;
    s->width = 0;
    /* Adds facets along the axes near the cell that do not touch it. One cut may leave a small corner of a large
     * box: what is computed near the middle of that says nothing about the corner. Sums of facets do. */
    for (int round = 0; round < ROUNDS; round++)
        for (int i = d->dim; i < d->count; i++) {
            for (int k = 0; k < d->dim; k++) bound_by_one(d, i, k, r);
            for (int j = d->dim; j < i; j++) {
                bound_by_two(d, i, j, 1, r);
                bound_by_two(d, i, j, -1, r);
            }
        }
    if (!begin_box(s, r, &size)) return false;
    for (int i = d->dim; i < d->count; i++) {
        if (r->lo[i] > -INFINITY && !clip_bar_shape(s, i, bar_shape_local(s, i, r->lo[i]), 1, size)) return false;
        if (r->hi[i] < INFINITY && !clip_bar_shape(s, i, bar_shape_local(s, i, r->hi[i]), -1, size)) return false;
    }
    extent all = no_extent();
    for (uint32_t c = 0; c < s->count; c++) widen_extent(&all, s->corners + c, d->count);
    memcpy(s->lo, all.lo, sizeof all.lo);
    memcpy(s->hi, all.hi, sizeof all.hi);
    s->aspect = aspect_of(d, &all, &s->width);
    if (!(s->width > 0)) return false;
    s->edge_count = 0;
    for (uint32_t a = 0; a < s->count; a++)
        for (uint32_t b = a + 1; b < s->count; b++) {
            if (!joined(s, a, b)) continue;
            if (s->edge_count == BAR_EDGES) return false;
            s->edges[s->edge_count][0] = (uint8_t)a;
            s->edges[s->edge_count++][1] = (uint8_t)b;
        }
    return true;
}

double bar_shape_reach(const bar_shape *s) {
    double reach = 0;
    for (int k = 0; k < s->directions->dim; k++)
        reach = fmax(reach, fmax(fabs(s->shift[k].hi + s->lo[k]), fabs(s->shift[k].hi + s->hi[k])));
    return reach;
}

void bar_shape_halves(const bar_shape *s, int direction, double at, double aspect[2]) {
    extent part[2] = {no_extent(), no_extent()};
    double least;
    for (uint32_t c = 0; c < s->count; c++) {
        if (s->corners[c].at[direction] <= at) widen_extent(&part[0], s->corners + c, s->directions->count);
        if (s->corners[c].at[direction] >= at) widen_extent(&part[1], s->corners + c, s->directions->count);
    }
    for (uint32_t e = 0; e < s->edge_count; e++) {
        double a = s->corners[s->edges[e][0]].at[direction], b = s->corners[s->edges[e][1]].at[direction];
        if (!((a < at && b > at) || (a > at && b < at))) continue;
        const bar_corner corner = meet_edge(s, s->edges[e][0], s->edges[e][1], direction, at);
        widen_extent(&part[0], &corner, s->directions->count);
        widen_extent(&part[1], &corner, s->directions->count);
    }
    for (int side = 0; side < 2; side++) aspect[side] = aspect_of(s->directions, &part[side], &least);
}

/** The last plane, coming from the far end of `side`'s part, whose part on that side is fat. */
static double border(const bar_shape *s, int direction, double most, int side) {
    double thin = side ? s->hi[direction] : s->lo[direction], fat = side ? s->lo[direction] : s->hi[direction];
    for (int i = 0; i < BISECTIONS; i++) {
        double middle = 0.5 * (thin + fat), aspect[2];
        bar_shape_halves(s, direction, middle, aspect);
        *(aspect[side] <= most ? &fat : &thin) = middle;
    }
    return fat;
}

bool bar_shape_interval(const bar_shape *s, int direction, double most, double *lo, double *hi) {
    *lo = border(s, direction, most, 0);
    *hi = border(s, direction, most, 1);
    return s->aspect <= most && *lo <= *hi && *lo < s->hi[direction] && *hi > s->lo[direction];
}
