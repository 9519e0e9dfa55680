/* bar_guards.h: a few points for each object, one of which any fat cell that meets the object has inside, unless the
 * object is large beside it.
 *
 *      v-----------v         The cell has facets of a few directions only. Seen from a point p that it shares with the
 *       \  ._____./ \        object, its middle lies in some sector between the planes n . u = 0. Only facets that face
 *        \ |object|  \       that way may be near p; a guard that is beyond the object in all of these at once
 *         `v-----v----v      is inside, too.
 *
 * HEMISPHERE: one guard a sector: 6 or 8 in the plane, 32 in space. In the plane it is where the two outermost of the
 * supporting lines that face the sector meet. PAIRS: the corners of the bounding parallelogram of every two
 * directions, in the plane: the 12 guards that de Berg and Streppel count (24 for four directions). BOXES: the
 * corners of the bounding box, which guard nothing but boxes: for comparison. Guards of some of the objects
 * guard these. */
#ifndef FROE_BUILD_BAR_BAR_GUARDS_H
#define FROE_BUILD_BAR_BAR_GUARDS_H
#include "build/bar/directions.h"
#include "scene/scene.h"

typedef enum bar_guard_kind { BAR_HEMISPHERE, BAR_PAIRS, BAR_BOXES } bar_guard_kind;

enum { BAR_GUARDS_MOST = 32 };

typedef struct bar_sector {
    double u[3];                   /**< a direction inside, of length 1 */
    double slope[DIRECTIONS_MOST]; /**< n . u of every direction, never 0 */
} bar_sector;

typedef struct bar_guards {
    split_directions directions;
    bar_guard_kind kind;
    uint32_t count; /**< guards of an object, at most */
    bar_sector sectors[BAR_GUARDS_MOST];
} bar_guards;

/** PAIRS in space are HEMISPHERE. */
void bar_guards_make(const split_directions *directions, bar_guard_kind kind, bar_guards *out);
/** Writes the guards of an object, dim doubles each, none twice; returns how many. O(directions x corners). */
uint32_t bar_guards_of(const bar_guards *guards, const froe_scene *scene, uint32_t object, double *out);
#endif
