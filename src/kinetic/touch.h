/* touch.h: how far a partition in space can go: until two of its triangles meet. It is right for triangles that do not
 * cross, and nothing in it notices when two do, as none of its certificates is about heights. */
#ifndef FROE_KINETIC_TOUCH_H
#define FROE_KINETIC_TOUCH_H
#include "kinetic/event/event.h"
#include <froe/kinetic.h>

typedef struct touch_state {
    bool known;       /**< the contact is that of the plans of this edition of the motion */
    uint64_t edition; /**< of the motion */
    int64_t last;     /**< the last odd tick before the first contact, at least -1; NOW_NEVER: there is none */
    froe_contact first;
    bool reporting; /**< a visitor is in the callback of that contact */
} touch_state;

/** Finds the first contact from the present on, if plans have changed since. The failures of froe_motion_contacts(). */
froe_status touch_find(froe_kinetic *k, froe_diagnostic *diag);
/** Calls a visitor for the first contact. */
void touch_tell(froe_kinetic *k, const event_watcher *watcher);
/** FROE_E_INPUT: tells which triangles meet, and when. */
froe_status touch_refuse(const froe_kinetic *k, froe_diagnostic *diag);
#endif
