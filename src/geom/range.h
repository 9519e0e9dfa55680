/* range.h: a convex range as a search meets it: fast tests that may err on the safe side only.
 *
 *     geom_range_shrink   a box around the range, as far as it is within a box
 *     geom_range_misses   is a ball certainly apart from a box?
 *     geom_range_holds    is a box certainly within the range, grown by a margin?
 *
 * What an object and a range have in common is decided exactly, by geom/meet/meet.h on `set`. Here a range is known by
 * its bounds and by facets: directions, and how far it extends there at most. A box shrinks facet by facet,
 *
 *     n . x <= c,  lo <= x <= hi      =>      n_k x_k  <=  c - sum of the others' least n_j x_j,
 *
 * as in interval constraint propagation (Benhamou and others: Revising hull and box consistency, 1999). */
#ifndef FROE_GEOM_RANGE_H
#define FROE_GEOM_RANGE_H
#include "geom/convex.h"
#include "geom/filter.h"
#include "support/array.h"

/** n . x <= c for all points of the range; norm >= |n|. */
typedef struct geom_facet {
    double n[FROE_MAX_DIM], c, norm;
} geom_facet;

typedef enum geom_range_kind {
    GEOM_RANGE_BOX,  /**< any dimension; bounds may be infinite */
    GEOM_RANGE_BALL, /**< any dimension */
    GEOM_RANGE_THIN, /**< segment or ray: searched by parameters, without boxes */
    GEOM_RANGE_SOLID /**< anything else */
} geom_range_kind;

typedef struct geom_range {
    geom_range_kind kind;
    int dim;
    bool empty;      /**< there is no such point */
    geom_convex set; /**< not for boxes with infinite bounds; without corners: what the facets leave */
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    ARRAY(geom_facet) facets; /**< of SOLID; there may be none */
} geom_range;

void geom_range_free(geom_range *range, const froe_allocator *alloc);

/** Bounds of a SOLID from its corners and radius, rounded outwards. */
void geom_range_bound(geom_range *range);
/** Adds a facet in direction n, dim doubles, from the corners and the radius. False without memory. */
bool geom_range_add_facet(geom_range *range, const froe_allocator *alloc, const double *n);

/** Shrinks a box of finite numbers around the part of a SOLID within it. False: there is none. */
bool geom_range_shrink(const geom_range *range, double *lo, double *hi);
/** Shrinks a box around its part with n . x <= c, rounding outwards. False: there is none. Any dimension. */
bool geom_shrink_box(const double *n, double c, int dim, double *lo, double *hi);
/** Is the closed ball certainly apart from the box? */
bool geom_range_misses(const geom_range *range, const double *lo, const double *hi);
/** Is the point in the range? Of boxes and balls, by doubles; NUM_UNSURE. */
static inline int geom_range_has(const geom_range *range, const double *x) {
    const double sure = 1 - 0x1p-46; /* as geom_meet_boxes */
    double sum = 0;
    bool in = true;
    switch (range->kind) {
    case GEOM_RANGE_BOX:
        for (int k = 0; k < range->dim; k++) in &= (x[k] >= range->lo[k]) & (x[k] <= range->hi[k]);
        return in;
    case GEOM_RANGE_BALL: {
        const double square = filter_capped(range->set.radius * range->set.radius);
        for (int k = 0; k < range->dim; k++) {
            const double gap = x[k] - range->set.coords[k];
            sum += gap * gap;
        }
        sum = filter_capped(sum);
        in = sum < square * sure - NUM_BALL_TINY;
        return (in | (sum * sure > square + NUM_BALL_TINY)) ? in : NUM_UNSURE;
    }
    default:
        return NUM_UNSURE;
    }
}
/** Is every point of the box certainly within `margin` of the range? Not for THIN ranges. */
bool geom_range_holds(num_context *context, const geom_range *range, double margin, const double *lo, const double *hi);
#endif
