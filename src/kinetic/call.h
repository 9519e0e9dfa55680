/* call.h: a public call while it is under way: its memory, and whether it goes on. */
#ifndef FROE_KINETIC_CALL_H
#define FROE_KINETIC_CALL_H
#include "base/task.h"
#include "support/array.h"

typedef struct kinetic_call {
    froe_allocator alloc;
    base_task task;
    uint32_t polls;
    bool stopped; /**< memory ran out or the caller cancelled: the tree may be incomplete */
} kinetic_call;

/** Is a long operation to go on? Asks the caller now and then. */
bool call_goes_on(kinetic_call *call);
/** The failure of a call that could not go on. */
froe_status call_fail(kinetic_call *call, froe_diagnostic *diag);

/** Stops it. Always false. */
static inline bool call_stop(kinetic_call *call) {
    call->stopped = true;
    return false;
}
/** Asks while the tree is made: a cancelled call leaves the tree incomplete. */
static inline void call_poll(kinetic_call *call) {
    if (!call_goes_on(call)) call_stop(call);
}

/** Room for `extra` more items of an array. False: no memory, and the call has stopped. */
#define call_reserve(call, a, extra) (array_reserve(&(call)->alloc, a, extra) || call_stop(call))
/** Appends an item, or stops the call. */
#define call_push(call, a, ...) ((void)(array_push(&(call)->alloc, a, __VA_ARGS__) || call_stop(call)))
#endif
