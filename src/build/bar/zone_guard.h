/* zone_guard.h: one point for each object of a zone: the guard that is inside, unless the object is large beside it.
 *
 *         |  . centre        The hyperplanes x_i = x_j through the object, x_dim = 0, divide space into (dim + 1)!
 *         | /                chambers. The guard of a chamber lies in it, beyond all supporting hyperplanes of the
 *         |v                 object that face it (build/bar/bar_guards.h: hemisphere guards, and why a fat cell that
 *      .__|.                 meets a small object has one of them inside: that of the chamber with the centre of the
 *      |__|_____/            cell). So that one is all a cell has to look at.
 *
 * De Berg and Streppel, section 4, ask for O(1) guards an object. Here these are (dim + 1)! at most, 120 in R^4 and
 * 362,880 in R^8, none of which is kept. */
#ifndef FROE_BUILD_BAR_ZONE_GUARD_H
#define FROE_BUILD_BAR_ZONE_GUARD_H
#include "build/bar/zone.h"
#include "scene/scene.h"

/** Writes the guard of an object that faces the centre of a zone; false: it is not strictly inside. O(dim^2 corners).
 */
bool zone_guard_of(const froe_scene *scene, uint32_t object, const bar_zone *zone, double *out);
#endif
