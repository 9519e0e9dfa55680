/* sweep.c: see sweep.h. */
#include "build/grain/sweep.h"
#include <float.h>
#include <math.h>
#include <string.h>

/* Places: 0 to 1 for corners that are positive until they are met, -1 to -2 for negative ones. */
enum { BITS = 40, INDEX = 24, DIGIT = 8, PASSES = BITS / DIGIT, SMALL = 48, EACH = 4 };

void split_sweep_free(const froe_allocator *alloc, split_sweep *s) {
    array_free(alloc, &s->place);
    array_free(alloc, &s->apart);
    array_free(alloc, &s->spot);
    array_free(alloc, &s->order);
    array_free(alloc, &s->spare);
    sweep_buckets_free(alloc, &s->turn);
    sweep_buckets_free(alloc, &s->refined);
}

static double share_of(double place) {
    return place < 0 ? -1 - place : place;
}

/* ---------------------------------------------------------------- buckets -- */

/** A power of two of buckets, EACH for a corner if possible. */
static uint32_t bucket_count(size_t corners) {
    uint32_t count = SWEEP_LEAST;
    while (count < EACH * corners && count < SWEEP_MOST) count *= 2;
    return count;
}

/** Corners nearer to the axle than that lie in every plane, and so do those so far outside of the cell that no double
 * says where. What can be computed without branches comes first, so that compilers take several corners at once. */
static void put_all(split_sweep *s, double near, uint32_t from, uint32_t to) {
    const double *restrict place = s->place.data, *restrict apart = s->apart.data, scale = s->turn.last;
    int32_t *restrict spot = s->spot.data;
    for (uint32_t i = from; i < to; i++) {
        const double negative = 0.5 - copysign(0.5, place[i]);
        const double at = (fabs(place[i]) - negative) * scale + (1 + negative * SWEEP_NEGATIVE);
        const int somewhere = (apart[i] > near) & (apart[i] <= DBL_MAX);
        spot[i] = (int32_t)(somewhere ? at : 0.0);
    }
    for (uint32_t i = from; i < to; i++) {
        if (spot[i])
            sweep_put(&s->turn, i, (uint32_t)spot[i] & (SWEEP_NEGATIVE - 1), (uint32_t)spot[i] & SWEEP_NEGATIVE);
        else
            s->turn.met.data[i + 1] = SWEEP_ALWAYS;
    }
}

/* ------------------------------------------------------------- refinement -- */

/** By place; returns x or y, whichever holds the result. */
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

static uint64_t *sort_order(split_sweep *s) {
    uint64_t *x = s->order.data;
    if (s->order.count > SMALL) return radix_sort(x, s->spare.data, s->order.count);
    for (size_t i = 1; i < s->order.count; i++) {
        uint64_t item = x[i];
        size_t at = i;
        for (; at && x[at - 1] > item; at--) x[at] = x[at - 1];
        x[at] = item;
    }
    return x;
}

/** The corners of a bucket, sorted by rounded place; returns how many places there are. */
static uint32_t sort_bucket(split_sweep *s, uint32_t bucket, uint64_t **sorted) {
    uint32_t different = 0;
    s->order.count = 0;
    for (uint32_t k = s->turn.first.data[bucket]; k != FROE_NONE; k = s->turn.next.data[k]) {
        const uint64_t place = (uint64_t)(share_of(s->place.data[k]) * 0x1p40);
        s->order.data[s->order.count++] = place << INDEX | k;
    }
    *sorted = sort_order(s);
    for (size_t i = 0; i < s->order.count; i++) different += !i || (*sorted)[i] >> INDEX != (*sorted)[i - 1] >> INDEX;
    return different;
}

/** Corners of other buckets are met before the one at hand, or after it: while it lasts they stay on their side. */
static void put_others(split_sweep *s, uint32_t bucket, uint32_t corners) {
    const uint32_t never = s->refined.last + 2;
    for (uint32_t i = 0; i < corners; i++) {
        const sweep_met m = s->turn.met.data[i + 1];
        const uint32_t at = m & (SWEEP_NEGATIVE - 1);
        const bool negative = !(m & SWEEP_NEGATIVE) == (at < bucket);
        s->refined.met.data[i + 1] = m == SWEEP_ALWAYS ? m : sweep_met_of(never, negative);
    }
}

/** The best within a bucket of several corners, by their rounded places. False: no memory. */
static bool refine(split_sweep *s, const split_set *set, const split_view *v, const split_view_part *part,
                   const split_prices *prices, const sweep_stop *stop, double limit, split_sweep_best *best) {
    uint64_t *sorted;
    const uint32_t places = sort_bucket(s, stop->bucket, &sorted);
    if (places == 1) {
        *best = (split_sweep_best){sweep_vertex(&s->turn, v, stop->bucket), stop->cost, stop->tally};
        return true;
    }
    if (places > SWEEP_MOST) return true;
    if (!sweep_buckets_clear(&s->refined, &set->alloc, places, v->x.count)) return false;
    put_others(s, stop->bucket, part->corners);
    uint32_t rank = 0;
    for (size_t i = 0; i < s->order.count; i++) {
        const uint32_t corner = (uint32_t)sorted[i] & ((1u << INDEX) - 1);
        rank += !i || sorted[i] >> INDEX != sorted[i - 1] >> INDEX;
        sweep_put(&s->refined, corner, rank, s->place.data[corner] < 0);
    }
    sweep_stop found[SWEEP_STOPS];
    if (sweep_count(&s->refined, v, part, prices, limit, found))
        *best = (split_sweep_best){sweep_vertex(&s->refined, v, found->bucket), found->cost, found->tally};
    return true;
}

/** The plane of least price below the limit, once all corners have their places. */
static bool find_best(split_sweep *s, const split_set *set, const split_view *v, const split_view_part *part,
                      const split_prices *prices, double limit, split_sweep_best *best) {
    sweep_stop stops[SWEEP_STOPS];
    const uint32_t count = sweep_count(&s->turn, v, part, prices, limit, stops);
    for (uint32_t i = 0; i < count && stops[i].cost < limit; i++) {
        if (!refine(s, set, v, part, prices, stops + i, limit, best)) return false;
        if (best->vertex != FROE_NONE) limit = best->cost;
    }
    return true;
}

static bool begin_sweep(split_sweep *s, const split_set *set, const split_view *v, const split_view_part *part,
                        split_sweep_best *best, bool *possible) {
    const size_t corners = v->x.count;
    *best = (split_sweep_best){.vertex = FROE_NONE};
    *possible = corners < (size_t)1 << INDEX && part->count <= SWEEP_COUNT;
    s->place.count = s->apart.count = s->spot.count = s->order.count = s->spare.count = 0;
    return array_reserve(&set->alloc, &s->place, corners) && array_reserve(&set->alloc, &s->apart, corners) &&
           array_reserve(&set->alloc, &s->spot, corners) && array_reserve(&set->alloc, &s->order, corners) &&
           array_reserve(&set->alloc, &s->spare, corners) &&
           sweep_buckets_clear(&s->turn, &set->alloc, bucket_count((size_t)part->corners + part->outside), corners);
}

/* ---------------------------------------------------------------- pencils -- */

/** The line that a pencil turns about, and two vectors across it. */
typedef struct axle_frame {
    double p[3], f[3], g[3], near;
} axle_frame;

/** In the plane it stands upright on a vertex. False: it is too short. */
static bool frame_of(const split_view *v, const froe_scene *scene, const uint32_t *axle, axle_frame *out) {
    double *p = out->p, *f = out->f, *g = out->g, q[3], e[3], square = 0;
    split_view_local(v, scene_vertex(scene, axle[0]), p);
    if (scene->dim == 3)
        split_view_local(v, scene_vertex(scene, axle[1]), q);
    else
        memcpy(q, (double[]){p[0], p[1], 1}, sizeof q);
    for (int k = 0; k < 3; k++) e[k] = q[k] - p[k], square += e[k] * e[k];
    const double length = sqrt(square);
    for (int k = 0; k < 3; k++) e[k] /= length;
    out->near = 0x1p-40 * (1 + fabs(p[0]) + fabs(p[1]) + fabs(p[2]));
    /* vectors that favour no axis, so that structure does not fall on the seam where directions begin */
    double h[3] = {0.3, 0.2, 0.1};
    const int k = fabs(e[0]) < fabs(e[1]) ? 0 : 1;
    h[fabs(e[2]) < fabs(e[k]) ? 2 : k] = 1;
    f[0] = e[1] * h[2] - e[2] * h[1];
    f[1] = e[2] * h[0] - e[0] * h[2];
    f[2] = e[0] * h[1] - e[1] * h[0];
    g[0] = e[1] * f[2] - e[2] * f[1];
    g[1] = e[2] * f[0] - e[0] * f[2];
    g[2] = e[0] * f[1] - e[1] * f[0];
    return length > 0x1p-100 && length < 0x1p100;
}

/** Where corners are met. Directions u, v of opposite sense lie in one plane: the lower half is turned up. They grow
 * with the angle; an arc tangent is not needed to sort. Without branches, so that compilers take several at once. */
static void find_places(split_sweep *s, const split_view *view, const axle_frame *a, uint32_t from, uint32_t to) {
    const double *x = view->x.data, *y = view->y.data, *z = view->z.data;
    const double p0 = a->p[0], p1 = a->p[1], p2 = a->p[2], top = 1 - 0x1p-41;
    const double f0 = a->f[0], f1 = a->f[1], f2 = a->f[2], g0 = a->g[0], g1 = a->g[1], g2 = a->g[2];
    double *restrict place = s->place.data, *restrict apart = s->apart.data;
    for (uint32_t i = from; i < to; i++) {
        const double dx = x[i] - p0, dy = y[i] - p1, dz = z[i] - p2;
        const double u = f0 * dx + f1 * dy + f2 * dz, v = g0 * dx + g1 * dy + g2 * dz;
        const double far = fabs(u) + fabs(v), sign = copysign(1, v + 0.0);
        const double share = top * (0.5 - 0.5 * (sign * (u / far)));
        place[i] = sign * share + (0.5 * sign - 0.5);
        apart[i] = far;
    }
}

bool split_sweep_pencil(split_sweep *s, const split_set *set, const split_view *view, const split_view_part *part,
                        const split_prices *prices, const uint32_t *axle, double limit, split_sweep_best *best) {
    axle_frame frame;
    bool possible;
    if (!begin_sweep(s, set, view, part, best, &possible)) return false;
    if (!possible || !frame_of(view, set->scene, axle, &frame)) return true;
    const uint32_t outside = view->corners + part->outside;
    find_places(s, view, &frame, 0, part->corners);
    find_places(s, view, &frame, view->corners, outside);
    put_all(s, frame.near, 0, part->corners);
    put_all(s, frame.near, view->corners, outside);
    return find_best(s, set, view, part, prices, limit, best);
}

bool split_sweep_axis(split_sweep *s, const split_set *set, const split_view *view, const split_prices *prices,
                      int axis, split_sweep_best *best) {
    const double *x = axis == 0 ? view->x.data : axis == 1 ? view->y.data : view->z.data;
    const split_view_part part = {view->count, view->corners, 0, view->weight};
    bool possible;
    if (!begin_sweep(s, set, view, &part, best, &possible)) return false;
    if (!possible) return true;
    for (uint32_t i = 0; i < view->corners; i++) {
        s->place.data[i] = 0.5 + 0.75 * x[i]; /* |x| <= 1/2 */
        s->apart.data[i] = 1;
    }
    put_all(s, 0, 0, view->corners);
    return find_best(s, set, view, &part, prices, INFINITY, best);
}
