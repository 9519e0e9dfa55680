/* floats.h: the floating point of a thread, froe's own or the caller's.
 *
 * froe's arithmetic needs round to nearest, denormal numbers and no traps. A program may have set its thread otherwise:
 * denormals flushed (loading a library that was linked with -ffast-math is enough), another rounding mode, traps.
 * So every public function that computes begins with BASE_FLOATS_OWN, and what calls a function of the caller does it
 * under BASE_FLOATS_CALLER. Both last as long as the block they stand in. scripts/check-floats finds public functions
 * that compute without.
 *
 * Reading the register takes a nanosecond, writing it tens of them: it is written where it differs only.
 * Compilers know nothing of the register, and move arithmetic across whatever changes it; they keep the order of
 * accesses to memory. So doubles that a function with BASE_FLOATS_OWN returns, or hands to base_callback(), and that it
 * computed itself, go through volatile variables. */
#ifndef FROE_BASE_FLOATS_H
#define FROE_BASE_FLOATS_H
#include "support/arithmetic.h"
#include <froe/froe.h>

#if defined(__x86_64__) && !defined(BASE_FLOATS_BY_C) /* MXCSR; froe uses no x87 registers */
typedef uint32_t base_floats;
static inline base_floats base_floats_now(void) {
    base_floats now;
    __asm__ volatile("stmxcsr %0" : "=m"(now)::"memory");
    return now;
}
static inline void base_floats_set(base_floats floats) {
    __asm__ volatile("ldmxcsr %0" ::"m"(floats) : "memory");
}
static inline void base_floats_set_own(void) {
    base_floats_set(0x1f80);
}
/** All but the six exception flags: traps masked, and nothing else. */
static inline bool base_floats_are_own(base_floats now) {
    return (now & ~(base_floats)0x3f) == 0x1f80;
}
/** The settings of the first, and the exception flags of both. */
static inline base_floats base_floats_flagged(base_floats floats, base_floats flags) {
    return floats | (flags & 0x3f);
}
#elif defined(__aarch64__) && !defined(BASE_FLOATS_BY_C) /* FPCR in the upper half, FPSR in the lower */
typedef uint64_t base_floats;
static inline base_floats base_floats_now(void) {
    uint64_t control, status;
    __asm__ volatile("mrs %0, fpcr\n\tmrs %1, fpsr" : "=r"(control), "=r"(status)::"memory");
    return control << 32 | (status & UINT32_MAX);
}
static inline void base_floats_set(base_floats floats) {
    __asm__ volatile("msr fpcr, %0\n\tmsr fpsr, %1" ::"r"(floats >> 32), "r"(floats & UINT32_MAX) : "memory");
}
static inline void base_floats_set_own(void) {
    base_floats_set(0);
}
static inline bool base_floats_are_own(base_floats now) {
    return !(now >> 32);
}
static inline base_floats base_floats_flagged(base_floats floats, base_floats flags) {
    return floats | (flags & UINT32_MAX);
}
#elif defined(__wasm__)                                  /* nothing can be set */
typedef uint32_t base_floats;
static inline base_floats base_floats_now(void) {
    return 0;
}
static inline void base_floats_set(base_floats floats) {
    (void)floats;
}
static inline void base_floats_set_own(void) {
}
static inline bool base_floats_are_own(base_floats now) {
    return !now;
}
static inline base_floats base_floats_flagged(base_floats floats, base_floats flags) {
    return floats | flags;
}
#else /* standard C: a program starts with the default, and cannot find out whether another one is equal to it */
#include <fenv.h>
typedef fenv_t base_floats;
static inline base_floats base_floats_now(void) {
    base_floats now;
    fegetenv(&now);
    return now;
}
static inline void base_floats_set(base_floats floats) {
    fesetenv(&floats);
}
static inline void base_floats_set_own(void) {
    fesetenv(FE_DFL_ENV);
}
static inline bool base_floats_are_own(base_floats now) {
    (void)now;
    return false;
}
static inline base_floats base_floats_flagged(base_floats floats, base_floats flags) {
    (void)flags;
    return floats;
}
#endif

/** What to undo, as bits: settings were changed; froe's own were replaced by the caller's for a while. */
enum { BASE_FLOATS_CHANGED = 1, BASE_FLOATS_LENT = 2 };

unsigned base_floats_change_to_own(void);
/** froe's own floating point from now on. */
static inline unsigned base_floats_begin_own(void) {
    return base_floats_are_own(base_floats_now()) ? 0 : base_floats_change_to_own();
}
/** The caller's floating point from now on. */
unsigned base_floats_begin_caller(void);
void base_floats_undo(unsigned began);
static inline void base_floats_end(const unsigned *began) {
    if (*began) base_floats_undo(*began);
}

/** What the caller computes with, for threads that work for it. */
typedef struct base_floats_held {
    bool held; /**< no: the caller computes as froe does */
    base_floats floats;
} base_floats_held;
base_floats_held base_floats_of_caller(void);
/** For the first moment of a new thread: froe's own from now on; callbacks see the caller's. */
void base_floats_begin_thread(base_floats_held caller);

#define BASE_FLOATS_OWN                                                                                                \
    __attribute__((cleanup(base_floats_end), unused)) const unsigned floats_own = base_floats_begin_own()
#define BASE_FLOATS_CALLER                                                                                             \
    __attribute__((cleanup(base_floats_end), unused)) const unsigned floats_caller = base_floats_begin_caller()
/** A call of the caller's function, as an expression; its arguments compute nothing. A function of
 * froe's own that is handed on as a callback begins with BASE_FLOATS_OWN. */
#define base_callback(call)                                                                                            \
    __extension__({                                                                                                    \
        BASE_FLOATS_CALLER;                                                                                            \
        (call);                                                                                                        \
    })
#endif
