/* box_pairs.h: all pairs of boxes that touch. */
#ifndef FROE_GEOM_MEET_BOX_PAIRS_H
#define FROE_GEOM_MEET_BOX_PAIRS_H
#include "base/task.h"

/** Gets each pair once, in no particular order, from several workers at once; false stops. */
typedef bool geom_pair_fn(void *user, unsigned worker, uint32_t a, uint32_t b);

/** Closed boxes in R^2, R^3 or R^4: box i is lo[i*dim ..] .. hi[i*dim ..], finite, count below 2^31.
 * Takes `span` of the task's progress, and lets it be cancelled however many pairs there are.
 * O(n log^(dim-1) n + pairs) time whatever the boxes, O(n) memory for each thread.
 * FROE_E_MEMORY, FROE_E_CANCELLED (also when fn stops). */
froe_status geom_box_pairs(const froe_allocator *alloc, base_task *task, double span, int dim, uint32_t count,
                           const double *lo, const double *hi, geom_pair_fn *fn, void *user);
#endif
