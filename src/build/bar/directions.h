/* directions.h: the few directions that the cuts of BAR trees are perpendicular to.
 *
 *      plane, 3          plane, 4          space, 7
 *      |   /             \ | /             the axes and the four diagonals of a cube
 *      |  /               \|/
 *      +-----             -+-
 *
 * Duncan, Goodrich and Kobourov, "Balanced aspect ratio trees" (1999): with cuts along the axes alone some sets of
 * points have no cut that leaves both parts fat and not too full; with these few more there is always a short
 * sequence of them. Normals have entries 0, 1, -1: keys n . x are sums of coordinates. */
#ifndef FROE_BUILD_BAR_DIRECTIONS_H
#define FROE_BUILD_BAR_DIRECTIONS_H
#include "support/arithmetic.h"
#include <froe/froe.h>

enum { DIRECTIONS_MOST = 7 };

typedef struct split_directions {
    int dim, count;
    const double (*normals)[3];
    double lengths[DIRECTIONS_MOST];
} split_directions;

/** `count` directions: 3 or 4 in the plane, 7 in space. False: there is no such set. */
bool split_directions_of(int dim, int count, split_directions *out);
/** n . x of direction i, rounded, the same way for the same point wherever it is asked for; of an axis exact. */
static inline double split_key(const split_directions *d, int i, const double *x) {
    const double *n = d->normals[i];
    const double key = n[0] * x[0] + n[1] * x[1];
    return d->dim == 3 ? key + n[2] * x[2] : key;
}
/** The cut n . x = value: AXIS or PLANE, which refers to a table that is always there. */
froe_cut split_directions_cut(const split_directions *d, int i, double value);
/** The direction of a cut made by that; -1 for any other oblique cut. */
int split_direction_of(const split_directions *d, const froe_cut *cut);
#endif
