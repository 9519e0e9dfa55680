/* motion.h: moving objects, and the partition that is kept while they move. */
#ifndef FROE_CORE_MOTION_H
#define FROE_CORE_MOTION_H
#include "call.h"
#include "errors.h"
#include "input.h"
#include "memory.h"
#include <froe/kinetic.h>

typedef struct core_motion {
    PyObject_HEAD;
    froe_motion *motion;
    size_t dim;
    bool busy; /**< a call uses it, or a partition of it */
} core_motion;

/** The motion, for this call alone until core_motion_give(). false: it is in use, and an exception is set. */
bool core_motion_take(core_motion *self);
void core_motion_give(core_motion *self);
/** A motion that has just been made, which the object takes. NULL: an exception is set, and the motion is freed. */
PyObject *core_motion_object(froe_motion *motion);
/** The object as a motion; NULL: it is none, and an exception is set. */
core_motion *core_motion_of(PyObject *object);
#endif
