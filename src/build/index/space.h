/* space.h: what the builder `index` does in space. */
#ifndef FROE_BUILD_INDEX_SPACE_H
#define FROE_BUILD_INDEX_SPACE_H
#include "build/method.h"

/** Cuts by surface area down to leaves of job->leaf objects, unless cells have been multiplied `growth` times. From
 * `parts` objects on the upper cuts are found with a sample, and the subtrees below them are jobs. The tree does not
 * depend on the number of threads. FROE_E_MEMORY, FROE_E_LIMIT, FROE_E_BUDGET, FROE_E_CANCELLED, without a message. */
froe_status build_in_space(build_job *job, double growth, uint32_t parts, froe_tree **out);
#endif
