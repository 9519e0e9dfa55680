/* sweep.c: see sweep.h. */
#include "build/grain/sweep.h"
#include <math.h>
#include <string.h>

#define ALWAYS UINT32_MAX    /* met: lies in every plane of the pencil */
#define NEGATIVE 0x80000000u /* met: is on the negative side before it is met, on the positive one after */
enum { BITS = 40, INDEX = 24, DIGIT = 8, PASSES = BITS / DIGIT, SMALL = 48 };

void split_sweep_free(const froe_allocator *alloc, split_sweep *s) {
    array_free(alloc, &s->order);
    array_free(alloc, &s->spare);
    array_free(alloc, &s->met);
    array_free(alloc, &s->at);
    for (int k = 0; k < 3; k++) array_free(alloc, &s->change[k]);
}

static bool reserve_sweep(split_sweep *s, const froe_allocator *alloc, size_t corners) {
    s->order.count = s->spare.count = s->met.count = s->at.count = 0;
    for (int k = 0; k < 3; k++) {
        s->change[k].count = 0;
        if (!array_reserve(alloc, &s->change[k], corners + 1)) return false;
    }
    return array_reserve(alloc, &s->order, corners) && array_reserve(alloc, &s->spare, corners) &&
           array_reserve(alloc, &s->met, corners) && array_reserve(alloc, &s->at, corners);
}

/** A corner in a direction from 0 to 1. */
static void put_sweep_corner(split_sweep *s, double direction, uint32_t corner) {
    uint64_t top = ((uint64_t)1 << BITS) - 1, rounded = direction < 1 ? (uint64_t)(direction * 0x1p40) : top;
    s->order.data[s->order.count++] = rounded << INDEX | corner;
}

/* ---------------------------------------------------------------- sorting -- */

/** By direction; returns x or y, whichever holds the result. */
static uint64_t *radix_sort(uint64_t *x, uint64_t *y, size_t n) {
    enum { SIZE = 1 << DIGIT };
    uint32_t place[PASSES][SIZE];
    memset(place, 0, sizeof place);
    for (size_t i = 0; i < n; i++)
        for (int d = 0; d < PASSES; d++) place[d][x[i] >> (INDEX + DIGIT * d) & (SIZE - 1)]++;
    for (int d = 0; d < PASSES; d++) {
        uint32_t sum = 0;
        for (int k = 0; k < SIZE; k++) {
            uint32_t here = place[d][k];
            place[d][k] = sum;
            sum += here;
        }
        for (size_t i = 0; i < n; i++) y[place[d][x[i] >> (INDEX + DIGIT * d) & (SIZE - 1)]++] = x[i];
        uint64_t *swap = x;
        x = y;
        y = swap;
    }
    return x;
}

/* --------------------------------------------------------------- counting -- */

/** A fragment has no corner of some sort from one rank to another, both included. */
static void note_missing(split_sweep *s, int sort, uint32_t from, uint32_t to) {
    if (from > to) return;
    s->change[sort].data[from]++;
    s->change[sort].data[to + 1]--;
}

/** Negative corners are the NEGATIVE ones not yet met and the others met before: there are none from the last of the
 * former to the first of the latter. Positive ones the other way round. */
static void note_fragment(split_sweep *s, const uint32_t *corner, const uint32_t *end, uint32_t ranks) {
    uint32_t least = UINT32_MAX, most = 0, least_other = UINT32_MAX, most_other = 0; /* other: top bit turned */
    for (; corner < end; corner++) {
        uint32_t met = s->met.data[*corner], other = met ^ NEGATIVE;
        if (met == ALWAYS) continue;
        least = met < least ? met : least;
        most = met > most ? met : most;
        least_other = other < least_other ? other : least_other;
        most_other = other > most_other ? other : most_other;
    }
    uint32_t first_positive = least < NEGATIVE ? least : ranks - 1;
    uint32_t first_negative = least_other < NEGATIVE ? least_other : ranks - 1;
    uint32_t last_negative = most >= NEGATIVE ? most - NEGATIVE : 0;
    uint32_t last_positive = most_other >= NEGATIVE ? most_other - NEGATIVE : 0;
    note_missing(s, 0, last_negative, first_positive);
    note_missing(s, 1, last_positive, first_negative);
    note_missing(s, 2, last_negative > last_positive ? last_negative : last_positive,
                 first_negative < first_positive ? first_negative : first_positive);
}

static double square_of(const split_view *f, uint32_t corner) {
    double x = f->x.data[corner], y = f->y.data[corner], z = f->z.data[corner];
    return x * x + y * y + z * z;
}

/** Of two corners in one direction, which names the plane: the input vertex, or the later one, unless it lies among
 * others that doubles cannot tell apart, in the middle of a scene of all scales. */
static bool stands_for(const split_view *f, uint32_t corner, uint32_t other) {
    if (f->vertex.data[corner] == FROE_NONE || corner == other) return false;
    return f->vertex.data[other] == FROE_NONE || square_of(f, other) <= 0x1p20 * square_of(f, corner);
}

static uint32_t winner(split_sweep *s, const split_view *f, const split_price *price, const split_terms *terms) {
    /* the different directions get numbers */
    uint64_t *x = s->order.data;
    uint32_t ranks = 0;
    if (s->order.count > SMALL)
        x = radix_sort(x, s->spare.data, s->order.count);
    else {
        for (size_t i = 1; i < s->order.count; i++) {
            uint64_t item = x[i];
            size_t at = i;
            for (; at && x[at - 1] > item; at--) x[at] = x[at - 1];
            x[at] = item;
        }
    }
    for (size_t i = 0; i < s->order.count; i++) {
        uint32_t corner = (uint32_t)x[i] & ((1u << INDEX) - 1);
        if (!i || x[i] >> INDEX != x[i - 1] >> INDEX) s->at.data[ranks++] = corner;
        if (stands_for(f, corner, s->at.data[ranks - 1])) s->at.data[ranks - 1] = corner;
        s->met.data[corner] |= ranks - 1;
    }
    if (!ranks) return FROE_NONE;
    const uint32_t *corner = f->corner.data, *start = f->start.data;
    for (int k = 0; k < 3; k++) memset(s->change[k].data, 0, (ranks + 1) * sizeof *s->change[k].data);
    for (uint32_t i = 0; i < f->count; i++) note_fragment(s, corner + start[i], corner + start[i + 1], ranks);
    /* the corner of the cheapest rank that has an input vertex */
    uint32_t best = FROE_NONE;
    int32_t no_negative = 0, no_positive = 0, on = 0;
    double least = 0;
    for (uint32_t r = 0; r < ranks; r++) {
        no_negative += s->change[0].data[r];
        no_positive += s->change[1].data[r];
        on += s->change[2].data[r];
        split_tally t = {(uint32_t)(no_positive - on), (uint32_t)(no_negative - on), (uint32_t)on, 0};
        t.both = f->count - t.negative - t.positive - t.on;
        if (f->vertex.data[s->at.data[r]] == FROE_NONE || !split_tally_useful(t)) continue;
        double cost = split_price_of(price, terms, t, f->weight);
        if (best != FROE_NONE && cost >= least) continue;
        best = s->at.data[r];
        least = cost;
    }
    return best;
}

/* ---------------------------------------------------------------- pencils -- */

bool split_sweep_pencil(split_sweep *s, const split_set *set, const split_view *view, const split_price *price,
                        const split_terms *terms, const uint32_t *axle, uint32_t *best) {
    double p[3], e[3];
    *best = FROE_NONE;
    if (view->x.count > SPLIT_SWEEP_MOST) return true;
    if (!reserve_sweep(s, &set->alloc, view->x.count)) return false;
    /* The line that a pencil turns about: a point and a unit vector. In the plane it stands upright on a vertex. */
    double q[3], square = 0;
    split_view_local(view, scene_vertex(set->scene, axle[0]), p);
    if (set->scene->dim == 3)
        split_view_local(view, scene_vertex(set->scene, axle[1]), q);
    else
        memcpy(q, (double[]){p[0], p[1], 1}, sizeof q);
    for (int k = 0; k < 3; k++) e[k] = q[k] - p[k], square += e[k] * e[k];
    double length = sqrt(square);
    for (int k = 0; k < 3; k++) e[k] /= length;
    if (!(length > 0x1p-100 && length < 0x1p100)) return true;
    /* Where corners are met. Directions u, v of opposite sense lie in one plane: the lower half is turned up. They
     * grow with the angle; an arc tangent is not needed to sort. */
    const double *x = view->x.data, *y = view->y.data, *z = view->z.data;
    const double near = 0x1p-40 * (1 + fabs(p[0]) + fabs(p[1]) + fabs(p[2]));
    double f[3], g[3];
    /* two vectors across e that favour no axis, so that structure does not fall on the seam where directions begin */
    double h[3] = {0.3, 0.2, 0.1};
    int k = fabs(e[0]) < fabs(e[1]) ? 0 : 1;
    h[fabs(e[2]) < fabs(e[k]) ? 2 : k] = 1;
    f[0] = e[1] * h[2] - e[2] * h[1];
    f[1] = e[2] * h[0] - e[0] * h[2];
    f[2] = e[0] * h[1] - e[1] * h[0];
    g[0] = e[1] * f[2] - e[2] * f[1];
    g[1] = e[2] * f[0] - e[0] * f[2];
    g[2] = e[0] * f[1] - e[1] * f[0];
    for (uint32_t i = 0; i < view->x.count; i++) {
        double dx = x[i] - p[0], dy = y[i] - p[1], dz = z[i] - p[2];
        double u = f[0] * dx + f[1] * dy + f[2] * dz, v = g[0] * dx + g[1] * dy + g[2] * dz;
        double size = fabs(u) + fabs(v), cosine = u / size;
        bool below = v < 0 || (v == 0 && u < 0);
        s->met.data[i] = !(size > near) ? ALWAYS : below ? NEGATIVE : 0;
        if (size > near) put_sweep_corner(s, 0.5 - 0.5 * (below ? -cosine : cosine), i);
    }
    uint32_t corner = winner(s, view, price, terms);
    if (corner != FROE_NONE) *best = view->vertex.data[corner];
    return true;
}

bool split_sweep_axis(split_sweep *s, const split_set *set, const split_view *view, const split_price *price,
                      const split_terms *terms, int axis, uint32_t *best) {
    const double *x = axis == 0 ? view->x.data : axis == 1 ? view->y.data : view->z.data;
    *best = FROE_NONE;
    if (view->x.count > SPLIT_SWEEP_MOST) return true;
    if (!reserve_sweep(s, &set->alloc, view->x.count)) return false;
    for (uint32_t i = 0; i < view->corners; i++) {
        s->met.data[i] = 0;
        put_sweep_corner(s, 0.5 + 0.75 * x[i], i); /* |x| <= 1/2, but for rounding */
    }
    uint32_t corner = winner(s, view, price, terms);
    if (corner != FROE_NONE) *best = view->vertex.data[corner];
    return true;
}
