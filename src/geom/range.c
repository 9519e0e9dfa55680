/* range.c: bounds, facets, and what they exclude or include for certain. */
#include "geom/range.h"
#include "geom/filter.h"
#include "geom/meet/meet.h"
#include <string.h>

#define SURE (1 - 0x1p-48) /* pays for the few roundings of a sum of squares */

void geom_range_free(geom_range *range, const froe_allocator *alloc) {
    array_free(alloc, &range->facets);
}

/* More than a sum of dim products takes. */
static double roundings(int dim) {
    return dim > 3 ? 16 : 8;
}

/* The doubles that corner i is known by. */
static void corner_image(const geom_convex *c, uint32_t i, double x[FROE_MAX_DIM]) {
    for (int k = 0; k < c->dim; k++) x[k] = geom_convex_coordinate(c, i, k);
}

void geom_range_bound(geom_range *r) {
    for (int k = 0; k < r->dim; k++) r->lo[k] = INFINITY, r->hi[k] = -INFINITY;
    for (uint32_t i = 0; i < r->set.count; i++) {
        double x[FROE_MAX_DIM];
        corner_image(&r->set, i, x);
        for (int k = 0; k < r->dim; k++) {
            if (x[k] < r->lo[k]) r->lo[k] = x[k];
            if (x[k] > r->hi[k]) r->hi[k] = x[k];
        }
    }
    double reach = r->set.radius + r->set.error;
    for (int k = 0; k < r->dim && reach > 0; k++) {
        r->lo[k] = nextafter(r->lo[k] - reach, -INFINITY);
        r->hi[k] = nextafter(r->hi[k] + reach, INFINITY);
    }
}

bool geom_range_add_facet(geom_range *r, const froe_allocator *alloc, const double *n) {
    geom_facet f = {.c = -INFINITY, .norm = filter_length_in(r->dim, n)};
    double sum = 0;
    for (int k = 0; k < r->dim; k++) {
        f.n[k] = n[k];
        sum += fabs(n[k]);
    }
    for (uint32_t i = 0; i < r->set.count; i++) {
        double x[FROE_MAX_DIM], size = 0, value = 0;
        corner_image(&r->set, i, x);
        for (int k = 0; k < r->dim; k++) value += n[k] * x[k], size += fabs(n[k] * x[k]);
        value += roundings(r->dim) * FILTER_U * size + NUM_BALL_TINY;
        f.c = filter_greater(value, f.c);
        if (!(value < INFINITY)) return true; /* no use */
    }
    f.c += (f.norm * r->set.radius + sum * r->set.error) * (1 + 0x1p-48);
    f.c += 4 * FILTER_U * fabs(f.c) + NUM_BALL_TINY;
    return !(f.norm > 0x1p-500 && f.norm < INFINITY && f.c < INFINITY) || array_push(alloc, &r->facets, f);
}

/* ---------------------------------------------------------------- shrinking -- */

bool geom_shrink_box(const double *n, double c, int dim, double *lo, double *hi) {
    double sum = 0, size = fabs(c);
    for (int k = 0; k < dim; k++) {
        const double least = n[k] > 0 ? n[k] * lo[k] : n[k] * hi[k];
        sum += least;
        size += fabs(least);
    }
    const double room = c - sum + 16 * FILTER_U * size + NUM_BALL_TINY; /* >= n_k (x_k - where it is least) */
    if (!(size < INFINITY)) return true;
    if (room < 0) return false;
    for (int k = 0; k < dim; k++) {
        if (!(fabs(n[k]) > 0x1p-400)) continue;
        const double step = room / fabs(n[k]) * (1 + 0x1p-48);
        const double end = n[k] > 0 ? lo[k] + step : hi[k] - step, error = 2 * FILTER_U * fabs(end) + NUM_BALL_TINY;
        if (n[k] > 0 && end + error < hi[k]) hi[k] = end + error;
        if (n[k] < 0 && end - error > lo[k]) lo[k] = end - error;
    }
    return true;
}

bool geom_range_shrink(const geom_range *r, double *lo, double *hi) {
    for (int k = 0; k < r->dim; k++)
        if (lo[k] > hi[k]) return false;
    for (size_t i = 0; i < r->facets.count; i++) {
        const geom_facet *f = r->facets.data + i;
        if (!geom_shrink_box(f->n, f->c, r->dim, lo, hi)) return false;
    }
    return true;
}

/* ------------------------------------------------------------------- balls -- */

bool geom_range_misses(const geom_range *r, const double *lo, const double *hi) {
    const double *centre = r->set.coords;
    double sum = 0;
    for (int k = 0; k < r->dim; k++) {
        const double below = lo[k] - centre[k], above = centre[k] - hi[k], most = below > above ? below : above;
        const double gap = most > 0 ? most : 0;
        sum += gap * gap;
    }
    return filter_capped(sum) * SURE > r->set.radius * r->set.radius + NUM_BALL_TINY;
}

/* Squared distance from the centre of a ball to the furthest point of a box, or from a box to the furthest corner
 * of another; about. */
static double furthest(const geom_range *r, const double *lo, const double *hi) {
    double sum = 0;
    for (int k = 0; k < r->dim; k++) {
        const double low = r->kind == GEOM_RANGE_BALL ? r->set.coords[k] : r->lo[k];
        const double high = r->kind == GEOM_RANGE_BALL ? r->set.coords[k] : r->hi[k];
        const double below = low - lo[k], above = hi[k] - high, most = below > above ? below : above;
        const double gap = most > 0 ? most : 0;
        sum += gap * gap;
    }
    return sum;
}

/* ----------------------------------------------------------------- holding -- */

static bool facets_hold(const geom_range *r, double margin, const double *lo, const double *hi) {
    for (size_t i = 0; i < r->facets.count; i++) {
        const geom_facet *f = r->facets.data + i;
        double most = 0;
        for (int k = 0; k < r->dim; k++) most += f->n[k] > 0 ? f->n[k] * hi[k] : f->n[k] * lo[k];
        if (most > f->c + f->norm * margin) return false;
    }
    return true;
}

/* Is the box certainly in every facet's halfspace, moved outwards by a margin? That is all there is to a range without
 * corners. */
static bool in_facets(const geom_range *r, double margin, const double *lo, const double *hi) {
    for (size_t i = 0; i < r->facets.count; i++) {
        const geom_facet *f = r->facets.data + i;
        double most = 0, size = fabs(f->c);
        for (int k = 0; k < r->dim; k++) {
            const double term = f->n[k] > 0 ? f->n[k] * hi[k] : f->n[k] * lo[k];
            most += term;
            size += fabs(term);
        }
        const double moved = f->c + f->norm * margin * (1 - 0x1p-40); /* the norm and the sum are rounded upwards */
        if (!(most + roundings(r->dim) * FILTER_U * size + NUM_BALL_TINY < moved)) return false;
    }
    return true;
}

/* All corners of the box: a convex set that has them has the box. */
static bool corners_held(num_context *context, const geom_range *r, double margin, const double *lo, const double *hi) {
    for (uint32_t i = 0; i < 1u << r->dim; i++) {
        double x[FROE_MAX_DIM];
        for (int k = 0; k < r->dim; k++) x[k] = i >> k & 1 ? hi[k] : lo[k];
        geom_convex corner = {.dim = r->dim, .count = 1, .coords = x, .radius = margin};
        if (!geom_meet_surely(context, &corner, &r->set)) return false;
    }
    return true;
}

bool geom_range_holds(num_context *context, const geom_range *r, double margin, const double *lo, const double *hi) {
    bool held = true;
    for (int k = 0; k < r->dim && r->kind != GEOM_RANGE_BALL; k++)
        held &= (lo[k] >= r->lo[k] - margin) & (hi[k] <= r->hi[k] + margin);
    if (!held) return false;
    if (r->kind == GEOM_RANGE_BOX && margin == 0) return true;
    if (context->first == NUM_EXACT) return false;
    const double reach = (margin + r->set.radius) * SURE;
    switch (r->kind) {
    case GEOM_RANGE_BOX:
    case GEOM_RANGE_BALL:
        return furthest(r, lo, hi) < filter_capped(reach * reach) * SURE - NUM_BALL_TINY;
    case GEOM_RANGE_SOLID:
        if (!r->set.count) return in_facets(r, margin, lo, hi);
        return facets_hold(r, margin, lo, hi) && corners_held(context, r, margin, lo, hi);
    default:
        return false;
    }
}
