/* event.h: what happens at a tick: which certificates fail together there, what kind of event that is, and how the
 * partition is repaired.
 *
 * All certificates that fail at a tick are taken together: those whose slabs overlap form a group. A group is repaired
 * by one surgery, or by several in unrelated cells. Where a group looks like one of the paper's events, the cells are
 * small. Any other group, and any group with points that coincide, gets a cell none of whose borders is involved. The
 * certificates show afterwards whether that was enough: those that still fail are due at once, and are repaired in a
 * larger cell each time, at last in the whole tree. */
#ifndef FROE_KINETIC_EVENT_H
#define FROE_KINETIC_EVENT_H
#include "kinetic/event/slab.h"
#include <froe/kinetic.h>

/** The callback that gets the events. */
typedef struct event_watcher {
    froe_event_fn *visit;
    void *user;
} event_watcher;

/** A certificate about a segment that stays (event/renew.h). */
typedef struct event_renewal {
    uint32_t cert;
    int turn[2];  /**< how the lines of the crossings turn that it is about */
    int64_t tick; /**< at which it fails from now on */
} event_renewal;

/** What is told at a tick, in this order. */
typedef enum event_phase {
    EVENT_BEFORE, /**< groups of certificates, by place, before plans go on and lives begin and end */
    EVENT_CHANGE, /**< plans and lives, by segment */
    EVENT_AFTER,  /**< groups, by place */
    EVENT_MEETING /**< ends of segments in one line */
} event_phase;

typedef struct event_state {
    ARRAY(slab_item) items;  /**< certificates that fail at this tick */
    ARRAY(uint32_t) order;   /**< of the items, while they are sorted */
    ARRAY(uint32_t) roots;   /**< places in the tree where surgery is needed: 4 parent + slot */
    ARRAY(uint32_t) leaving; /**< 2 segment + 1: its plan or life changes now; 2 segment: it may come into the tree */
    ARRAY(uint32_t) meeting; /**< segments in one line of which ends meet now, two and two */
    ARRAY(uint32_t) staying; /**< segments whose plans change now, and that stay in the tree */
    ARRAY(event_renewal) renewed;
    double ousted;            /**< of segments that were to stay and have left, as a certificate about them fails: how
                                   wide the widest was in x */
    ARRAY(uint32_t) turning;  /**< segments whose ends change sides now */
    ARRAY(uint32_t) flopping; /**< in space: surfaces of triangles that may turn over now */
    bool reporting;           /**< a visitor is in the callback of an event, */
    now_claim reported;       /**< about this; no points: appearances and the like */
    event_phase phase;        /**< of what is told */
    double slab[2];           /**< of the group that is told, in x, with all that may be in the same place */
    double place;             /**< where its certificates begin, in x, by which groups are told from left to right */
} event_state;

/** An event of this kind at the present tick, of no objects yet. */
froe_event event_now(const now_state *now, froe_event_kind kind);
/** The claim of events that are about none. */
extern const now_claim event_no_points;
/** Counts an event and tells it. `claim` is what froe_kinetic_instant() is about. False: the visitor asked to stop. */
bool event_tell(froe_kinetic *k, const event_watcher *watcher, const froe_event *event, const now_claim *claim);
/** Goes to the next tick at which something happens, or to `tick` if nothing happens before. False: the visitor asked
 * to stop. */
bool event_step(froe_kinetic *k, int64_t tick, const event_watcher *watcher);
#endif
