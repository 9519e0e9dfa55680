/* plane.h: grows a cylindrical partition of the plane: one thread down to small cells, then a task per small cell. */
#ifndef FROE_BUILD_CYLINDRICAL_PLANE_H
#define FROE_BUILD_CYLINDRICAL_PLANE_H
#include "split/grow.h"

/** Settings, and what all threads note. */
typedef struct plane_rules {
    uint32_t leaf;         /**< cells with so many fragments are done */
    uint32_t deepest;      /**< give up at this depth; 0: never */
    atomic_bool *too_deep; /**< set when `deepest` was why */
} plane_rules;

/** Of a job without guards and first cut: the same tree for any number of threads. Statuses as split_grow(). */
froe_status plane_grow(const split_job *job, const plane_rules *rules, froe_tree **out);
#endif
