/* arithmetic.h: what the compiler must not do, and must have. Every file of the core includes it.
 *
 * Exactness rests on doubles that are rounded once in each operation, in the order written. What no macro of a compiler
 * tells (fused multiply-add by -ffp-contract, clang's -fassociative-math), the selftest of src/num detects. */
#ifndef FROE_SUPPORT_ARITHMETIC_H
#define FROE_SUPPORT_ARITHMETIC_H
#include <float.h>

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) ||                               \
    defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || defined(__NO_SIGNED_ZEROS__)
#error                                                                                                                 \
    "froe is exact only if doubles are computed as written: compile it without -ffast-math, -Ofast and what they imply."
#endif
#if FLT_EVAL_METHOD != 0
#error                                                                                                                 \
    "froe is exact only if doubles are rounded to double in each operation: compile it with FLT_EVAL_METHOD 0 (-mfpmath=sse)."
#endif
#ifndef __SIZEOF_INT128__
#error "froe needs __int128, which gcc and clang have for processors of 64 bits and for WebAssembly."
#endif
#endif
