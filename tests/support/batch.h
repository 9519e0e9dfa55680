/* batch.h: a motion of one batch of objects. */
#ifndef FROE_TESTS_SUPPORT_BATCH_H
#define FROE_TESTS_SUPPORT_BATCH_H
#include <froe/kinetic.h>
#include <stdlib.h>

/** NULL: there is not enough memory. The caller frees it. */
static inline froe_motion *batch_motion(const froe_motion_options *window, const froe_moving *batch,
                                        const froe_allocator *alloc) {
    froe_motion *m = NULL;
    froe_status status = froe_motion_new(window, alloc, &m, NULL);
    if (!status) status = froe_motion_add(m, batch, NULL);
    if (!status) return m;
    if (status != FROE_E_MEMORY) abort();
    froe_motion_free(m);
    return NULL;
}
#endif
