/* odd_pairs.h: pairs of objects that may cross, overlap or meet in a T-junction, each once.
 *
 *     few boxes meet     all pairs of boxes that touch
 *     many               triangles of one source polygon, and segments of the plane, are swept first (sheet.h). Objects
 *                        that certainly lie side by side are paired only where corners touch edges; all others are
 *                        paired where boxes touch */
#ifndef FROE_MEASURE_ODD_PAIRS_H
#define FROE_MEASURE_ODD_PAIRS_H
#include "geom/meet/box_pairs.h"
#include "num/context.h"
#include "scene/scene.h"

typedef struct measure_candidates {
    const froe_scene *scene;
    const uint32_t *objects; /**< segments of the plane or polygons of space, ascending, no two equal */
    uint32_t count;
    const double *lo, *hi; /**< their bounds, dim numbers each */
} measure_candidates;

/** Passes pairs of places in the list to fn, from several workers at once, as geom_box_pairs() does; all numbers are
 * below 2^31. Of two objects that lie side by side in a sheet it passes at most what touches, so it takes
 * O(n log^(dim - 1) n + other pairs of boxes that touch). FROE_E_MEMORY, FROE_E_CANCELLED. */
froe_status measure_odd_pairs(base_task *task, num_context *context, const measure_candidates *of, geom_pair_fn *fn,
                              void *user);
#endif
