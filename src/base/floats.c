/* floats.c: the floating point of the caller, kept for each thread while froe computes with its own.
 * It is the only state that froe keeps by the thread. An object cannot hold it: an allocator is called from everywhere,
 * and a tree is used by many threads at once. */
#include "base/floats.h"

static _Thread_local base_floats_held
    caller_floats; /* held only while the thread is froe's and its settings had to change */

unsigned base_floats_change_to_own(void) {
    base_floats_held *caller = &caller_floats;
    const unsigned changed = caller->held ? 0 : BASE_FLOATS_CHANGED; /* held: changed by something that froe called */
    if (changed) *caller = (base_floats_held){true, base_floats_now()};
    base_floats_set_own();
    return changed;
}

unsigned base_floats_begin_caller(void) {
    base_floats_held *caller = &caller_floats;
    if (!caller->held) return base_floats_are_own(base_floats_now()) ? BASE_FLOATS_LENT : 0;
    caller->held = false;
    base_floats_set(caller->floats);
    return BASE_FLOATS_LENT | BASE_FLOATS_CHANGED;
}

/* After a callback: flags that it raised stay the caller's; settings that it changed are as before. */
static void take_again(bool changed) {
    base_floats_held *caller = &caller_floats;
    const base_floats now = base_floats_now();
    if (changed) *caller = (base_floats_held){true, base_floats_flagged(caller->floats, now)};
    if (!base_floats_are_own(now)) base_floats_set_own();
}

void base_floats_undo(unsigned began) {
    if (began & BASE_FLOATS_LENT)
        take_again(began & BASE_FLOATS_CHANGED);
    else if (began)
        base_floats_begin_caller();
}

base_floats_held base_floats_of_caller(void) {
    return caller_floats;
}

void base_floats_begin_thread(base_floats_held caller) {
    base_floats_set_own();
    caller_floats = caller;
}

unsigned froe_floats_begin(bool own) {
    return own ? base_floats_begin_own() : base_floats_begin_caller();
}

void froe_floats_end(unsigned began) {
    base_floats_end(&began);
}
