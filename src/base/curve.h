/* curve.h: places of boxes along a Z-curve (Morton 1966): what is near on it is mostly near in space. */
#ifndef FROE_BASE_CURVE_H
#define FROE_BASE_CURVE_H
#include "support/arithmetic.h"
#include <stdint.h>

/** Of a box within the finite bounds from .. to: the bits of its centre in a grid over them, axis by axis in turn; up
 * to 60 bits, 16 an axis. Scaling all by a power of two changes nothing. O(dim). */
uint64_t base_curve_place(int dim, const double *lo, const double *hi, const double *from, const double *to);
#endif
