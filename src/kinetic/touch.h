/* touch.h: how far a partition in space can go: until two of its triangles meet. It is right for triangles that do not
 * cross, and nothing in it notices when two do, as none of its certificates is about heights. */
#ifndef FROE_KINETIC_TOUCH_H
#define FROE_KINETIC_TOUCH_H
#include "kinetic/event/event.h"
#include <froe/kinetic.h>

typedef struct touch_state {
    bool known;         /**< the contact is that of the plans of this edition of the motion */
    uint64_t edition;   /**< of the motion */
    int64_t last;       /**< the last odd tick before the first contact, at least -1; NOW_NEVER: there is none */
    froe_contact first; /**< or the one that is told */
    bool again;         /**< ghosts may not be those of the present, as memory ran out or the call was cancelled */
    bool reporting;     /**< a visitor is in the callback of that contact */
} touch_state;

/** Finds the first contact from the present on, or all if ghosts are wanted, if plans have changed since. Then ghosts
 * are those of the present. The failures of froe_motion_contacts(). */
froe_status touch_find(froe_kinetic *k, froe_diagnostic *diag);
/** The next tick by which triangles meet, leave or return, or may do so as plans have changed; NOW_NEVER: none do. */
int64_t touch_next(const froe_kinetic *k);
/** The last odd tick at which a time has not come yet. */
int64_t touch_tick_before(const now_state *now, double time);
/** Calls a visitor for a contact. False: it asked to stop. */
bool touch_tell(froe_kinetic *k, const event_watcher *watcher, const froe_contact *contact);
/** FROE_E_INPUT: tells which triangles meet, and when. */
froe_status touch_refuse(const froe_kinetic *k, froe_diagnostic *diag);
#endif
