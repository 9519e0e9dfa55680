/* bar_shape.h: a cell of a BAR tree, as a convex polytope in doubles: its aspect, and the cuts that keep it fat.
 *
 *        +------+          A cell is what its facets say: lo <= n . x <= hi for each direction, doubles that some cut
 *       /       |          brought, or the root; nothing in it is ever rounded. The polytope is made of them when it
 *      /        |          is needed, seen from a point near the cell: facets are moved there in twice the precision
 *     +---------+          (num/pair.h), so corners are good to some 2^-48 of the cell, wherever it lies.
 *
 * Width in a direction is the distance of the two tight planes across it; aspect is the largest of the widths over the
 * least. */
#ifndef FROE_BUILD_BAR_BAR_SHAPE_H
#define FROE_BUILD_BAR_BAR_SHAPE_H
#include "build/bar/directions.h"
#include "num/pair.h"
#include "split/grow.h"

enum { BAR_CORNERS = 48, BAR_EDGES = 144 };

typedef struct bar_corner {
    double at[DIRECTIONS_MOST]; /**< n . y of every direction, for y = x - origin */
    uint32_t facets;            /**< bits 2 i, 2 i + 1: it lies in facets lo, hi of direction i */
} bar_corner;

typedef struct bar_shape {
    const split_directions *directions;
    num_pair shift[DIRECTIONS_MOST]; /**< n . origin */
    uint32_t count, edge_count;
    bar_corner corners[BAR_CORNERS];
    uint8_t edges[BAR_EDGES][2];
    double lo[DIRECTIONS_MOST], hi[DIRECTIONS_MOST]; /**< tight */
    double width, aspect;                            /**< least width */
} bar_shape;

/** What bounds a cell, or a box: n . x of its facets, per direction, or per axis. */
typedef struct bar_region {
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    uint32_t goal, cuts; /**< this many guards at most are to be left in it, and how many cuts that has taken so far */
} bar_region;

/** The region without any facet but those of a box of R^dim. */
bar_region bar_region_of(int dim, const double *lo, const double *hi);
/** False: the region has no interior that doubles would show. */
bool bar_shape_of(const split_directions *directions, const bar_region *region, bar_shape *out);
/** Largest coordinate of a point of the cell, about. */
double bar_shape_reach(const bar_shape *shape);
/** n . y of a cut n . x = value, and back, rounded once. */
double bar_shape_local(const bar_shape *shape, int direction, double value);
double bar_shape_global(const bar_shape *shape, int direction, double local);
/** Aspects of the parts below and above the plane n . y = local; infinite for a part without interior. */
void bar_shape_halves(const bar_shape *shape, int direction, double local, double aspect[2]);
/** The cuts that leave both parts with an aspect of `most` at most lie within [*lo, *hi]; false: there are none. The
 * borders are found by bisection: to be tried. */
bool bar_shape_interval(const bar_shape *shape, int direction, double most, double *lo, double *hi);
#endif
