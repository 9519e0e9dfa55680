/* floats.h: the floating point of a thread, for libraries on top of the core.
 *
 * It is froe's own as long as the block lasts that SUPPORT_FLOATS_OWN stands in, and the caller's while a function of
 * the caller is called. src/base/floats.h says why, and what compilers make of it: doubles handed to
 * support_callback() that were computed just before go through volatile variables. A function that is handed to the
 * core as a callback begins with SUPPORT_FLOATS_OWN, as public functions do. */
#ifndef FROE_SUPPORT_FLOATS_H
#define FROE_SUPPORT_FLOATS_H
#include <froe/froe.h>

static inline void support_floats_end(const unsigned *began) {
    froe_floats_end(*began);
}
#define SUPPORT_FLOATS(own) __attribute__((cleanup(support_floats_end), unused)) const unsigned own##_floats
#define SUPPORT_FLOATS_OWN SUPPORT_FLOATS(own) = froe_floats_begin(true)
#define support_callback(call)                                                                                         \
    __extension__({                                                                                                    \
        SUPPORT_FLOATS(callers) = froe_floats_begin(false);                                                            \
        (call);                                                                                                        \
    })
#endif
