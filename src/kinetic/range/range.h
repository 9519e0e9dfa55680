/* range.h: a part of a partition in motion, of all that comes into a range of x within a window of time.
 *
 *            low            high         The tree of the segments that come into the range is, between its two borders,
 *      .  .  |_______________|  .  .     the tree of all segments: cutting along a line is exact (event/surgery.h), and
 *     guard  |  own          |  guard    no other segment comes between the borders. So whatever happens there is the
 *            :               :           same in both, certificate for certificate. A range has a partition of its own
 * of these segments, from scratch, which a thread lets go on to the end of the window.
 *
 * What happens is told by the range in which its slab begins. Next to its own, a range knows a guard: an event that
 * begins within its own borders and is no wider than the guard lies where all segments are known. Wider ones are left
 * to the whole partition: the range stops there. */
#ifndef FROE_KINETIC_RANGE_RANGE_H
#define FROE_KINETIC_RANGE_RANGE_H
#include "base/apart.h"
#include "kinetic/event/event.h"
#include "kinetic/motion/motion.h"
#include <stdatomic.h>

/** An event, in the numbers of the whole motion. */
typedef struct range_event {
    int64_t tick;
    double place; /**< of a group: where it begins, in x */
    now_claim claim;
    uint32_t objects[4];
    uint32_t count; /**< of objects: may be more than 4 */
    uint8_t kind, phase;
    bool turned; /**< of the segment that the claim is about */
} range_event;

typedef struct kinetic_range {
    const froe_kinetic *whole;
    uint32_t number;
    double low, high; /**< what begins at `low` is its own, what begins at `high` is not */
    double guard;
    ARRAY(uint32_t) members;   /**< [segment of the part]: object of the whole, ascending */
    ARRAY(uint32_t) vertices;  /**< [vertex of the part]: of the whole, ascending */
    froe_motion motion;        /**< of the members; it shares the knots of the whole */
    froe_kinetic *part;        /**< while it goes on; */
    froe_kinetic_stats counts; /**< of that, then */
    ARRAY(range_event) events; /**< in order */
    size_t told;               /**< of these */
    double wide;               /**< it has stopped at what is so wide, and wider than the guard; or 0 */
    bool meets;                /**< it has stopped where segments in one line meet */
    int64_t stopped;           /**< the tick at which it could not go on; NOW_NEVER: it could */
    base_apart apart;
} kinetic_range;

/** What all ranges of a window share. */
typedef struct range_window {
    int64_t tick;         /**< its end */
    const uint32_t *home; /**< [object]: the range that tells of its plans */
    base_task *task;      /**< says whether to go on */
    atomic_llong stopped; /**< the first tick at which a range has stopped so far; others need not go further */
} range_window;

/** Makes the part at the present tick of the whole, and lets it go on through the window. Reads nothing but what is the
 * same in all threads. FROE_E_MEMORY. */
froe_status range_follow(kinetic_range *range, range_window *window);
void range_free(kinetic_range *range);
#endif
