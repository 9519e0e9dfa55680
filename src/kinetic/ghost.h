/* ghost.h: partitions in space that go on where triangles meet (`ghosts` in the options): of two that meet the one with
 * the greater number is left out, until it meets none any more that is there.
 *
 *     begin[0]      end[1]            A contact is watched from the last tick before it to the first after it, so
 *     ---|============|---            what is in the tree never meets, not even between two ticks.
 *     :  |            |  :
 *   from                 to
 *
 * Which triangles are left out is a function of time and of the plans alone, not of what happened before. */
#ifndef FROE_KINETIC_GHOST_H
#define FROE_KINETIC_GHOST_H
#include "kinetic/event/event.h"
#include <froe/kinetic.h>

typedef struct ghost_contact {
    froe_contact contact;
    int64_t from, to; /**< ticks: they meet somewhere between the two, or NOW_NEVER */
} ghost_contact;

typedef struct ghost_state {
    ARRAY(ghost_contact) all;  /**< in the order of `from` */
    ARRAY(uint32_t) lasting;   /**< of these, those that have begun and not ended */
    size_t next;               /**< the first that has not begun */
    ARRAY(uint32_t) concerned; /**< objects that may leave or return */
    bool anew;                 /**< contacts have been found anew: what is left out may return although nothing ends */
    bool out_of_memory;
} ghost_state;

void ghost_free(froe_kinetic *k);
/** Finds all contacts from the present on, in place of those known. The failures of froe_motion_contacts(). */
froe_status ghost_find(froe_kinetic *k, froe_diagnostic *diag);
/** The next tick at which triangles leave or return; NOW_NEVER: none do. */
int64_t ghost_next(const froe_kinetic *k);
/** Lets triangles leave and return that do so at the present tick, and tells it to a visitor (may be NULL). False: the
 * visitor wants to stop. */
bool ghost_apply(froe_kinetic *k, const event_watcher *watcher);
#endif
