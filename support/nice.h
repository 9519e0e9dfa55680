/* nice.h: round numbers for axes and scale bars: 1, 2 or 5 times a power of ten. */
#ifndef FROE_SUPPORT_NICE_H
#define FROE_SUPPORT_NICE_H

/** The least round number that is not below x, or the largest one not above it; x > 0 and finite. The same double on
 * every platform and in every locale; infinity or 0 where there is none. */
double support_nice_above(double x);
double support_nice_below(double x);
#endif
