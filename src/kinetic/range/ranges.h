/* ranges.h: time goes on in ranges of x, on threads at once or one range after the other. The partition stands still
 * meanwhile, and is made anew at the end. */
#ifndef FROE_KINETIC_RANGE_RANGES_H
#define FROE_KINETIC_RANGE_RANGES_H
#include "kinetic/event/event.h"

/** When it pays, and how far it goes. Tests set it otherwise. */
typedef struct ranges_tuning {
    uint32_t least;    /**< with fewer segments it does not, */
    uint32_t alone;    /**< and with fewer than so many it does not on one thread */
    double pays, most; /**< events for each segment that it has to pay for, and that a window has */
    double making;     /**< making a part takes as long as so many events for each of its segments */
    double again;      /**< all parts together have so many times the segments, at most */
    double gaps;       /**< guard at first: so many mean distances from segment to segment; */
    double guard[2];   /**< share of the whole width, at least and at most */
    uint32_t size;     /**< more ranges than threads where each has so many segments: small partitions are in nearer
                        * caches */
    bool unguarded;    /**< crippled: segments belong to a range by where they are at the beginning */
    bool wide;         /**< crippled: what is wider than the guard is told, too */
} ranges_tuning;

typedef struct ranges_state {
    ranges_tuning tuning;
    uint64_t events;      /**< there were so many, */
    int64_t tick;         /**< at this tick: since then their rate is measured */
    uint64_t next, wait;  /**< nothing is tried before there are so many; it grows by that where nothing was gained */
    double guard;         /**< share of the whole width; it grows where events were wider */
    ARRAY(double) places; /**< where some events of the last window were */
    uint64_t windows, stopped; /**< so many were gone through, and so many of these not to the end */
} ranges_state;

ranges_tuning ranges_defaults(void);
/** Lets time go on towards a tick in ranges, if that pays. False: it does not, and nothing has changed. *go_on: the
 * visitor did not ask to stop. *status: FROE_E_CANCELLED. */
bool ranges_advance(froe_kinetic *k, int64_t tick, const event_watcher *watcher, bool *go_on, froe_diagnostic *diag,
                    froe_status *status);
#endif
