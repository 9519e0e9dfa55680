/* zone.h: a cell of a BAR tree beyond space: a zone, bounded by coordinates and differences of two of them.
 *
 *      x_j
 *       |   /|         most[i][j]:  x_i - x_j <= most[i][j],  with one more coordinate x_dim = 0, so that x_i <= c and
 *       |  / |                      x_i >= c are of this form, too
 *       | /__|
 *       +------ x_i    tight:       most[i][j] <= most[i][k] + most[k][j]: shortest paths (Floyd and Warshall 1962)
 *
 * Zones are the polytopes of difference bounds (Dill, "Timing assumptions and verification of finite-state concurrent
 * systems", 1989; Lam and Postnikov, "Alcoved polytopes", 2007). All about them is in sums of few bounds, in any
 * dimension; that of other polytopes is in their corners, of which there are far too many. docs/design/bar.md proves
 * what follows. Width of (i, j) is most[i][j] + most[j][i]. Aspect is the largest width over the least.
 *
 * A cut x_i - x_j = c leaves two zones. In each of them the least width is that before or the part's own in (i, j),
 * whichever is less: a cut makes no other direction thin. Around its centre a zone has a ball of radius (least width) /
 * ((dim + 1) sqrt 2), and it lies in a cube with sides of the largest width. */
#ifndef FROE_BUILD_BAR_ZONE_H
#define FROE_BUILD_BAR_ZONE_H
#include <froe/froe.h>

enum { ZONE_NODES = FROE_MAX_DIM + 1 };

/** Points within `radius` of the middle on each axis; less than 0: not yet known. */
typedef struct zone_cluster {
    double middle[FROE_MAX_DIM], radius;
} zone_cluster;

/** What cuts and the root say of a cell, in their own doubles. */
typedef struct bar_zone {
    double most[ZONE_NODES][ZONE_NODES]; /**< INFINITY: there is no such facet */
    double centre[FROE_MAX_DIM];         /**< rounded */
    uint32_t goal, cuts;  /**< this many points at most are to be left in it, how many cuts that has taken so far, */
    zone_cluster cluster; /**< and which points are in the way */
} bar_zone;

/** The same as geometry, tight, seen from one of its points. Nothing cancels in sums of such bounds: each is good to
 * 2^-48 of itself, as far as it is above 2^-100 of the coordinates. */
typedef struct zone_shape {
    int dim;
    double origin[FROE_MAX_DIM];
    double most[ZONE_NODES][ZONE_NODES]; /**< of y_i - y_j, for y = x - origin; >= 0 */
    double widest, narrowest;
    double reach; /**< no coordinate is larger, about */
} zone_shape;

/** The zone of a box. */
bar_zone bar_zone_of(int dim, const double *lo, const double *hi);
/** `origin`: a point of the zone, dim doubles. O(dim^3). */
void zone_shape_of(const bar_zone *zone, int dim, const double *origin, zone_shape *out);
/** Of all points of the zone with y_i - y_j <= value: the largest width. O(dim^2). */
double zone_shape_widest_below(const zone_shape *shape, int i, int j, double value);
static inline double zone_shape_width(const zone_shape *shape, int i, int j) {
    return shape->most[i][j] + shape->most[j][i];
}

/** The cut y_i - y_j = value, j <= dim; its normal is in a table that is always there. */
froe_cut zone_shape_cut(const zone_shape *shape, int i, int j, double value);
/** Makes of a zone, and its shape, the part below (side 0) or above such a cut. O(dim^2). */
void bar_zone_divide(bar_zone *zone, const zone_shape *shape, const froe_cut *cut, int side);
#endif
