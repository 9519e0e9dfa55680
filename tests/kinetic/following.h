/* following.h: a partition goes from event to event, and is compared with one made from scratch after each. */
#ifndef FROE_TESTS_KINETIC_FOLLOWING_H
#define FROE_TESTS_KINETIC_FOLLOWING_H
#include "kinetic/moving.h"
#include "kinetic/patterns.h"

/** Over `most` instants at which something happens, and over a tick between each two now and then. Not FROE_OK: why. */
static inline froe_status following_run(froe_kinetic *k, uint64_t most, pattern_counter *counter,
                                        froe_diagnostic *diag) {
    fuzz_source r = {1};
    froe_status status = froe_kinetic_audit(k, diag);
    counter->kinetic = k;
    for (uint64_t steps = 0; steps < most && !status; steps++) {
        double next = froe_kinetic_next(k), now = froe_kinetic_time(k);
        if (!(next <= MOVING_TIME)) break;
        if (fuzz_int(&r, 0, 7) == 0) {
            status = froe_kinetic_advance(k, now + 0.4 * (next - now), pattern_count, counter, diag);
            if (!status && froe_kinetic_time(k) < next) status = froe_kinetic_audit(k, diag);
        }
        if (!status) status = froe_kinetic_advance(k, next, pattern_count, counter, diag);
        if (!status) status = froe_kinetic_audit(k, diag);
    }
    return status;
}
#endif
