/* segment.h: the oracle for segments and points of the plane, in exact rationals (GMP), by definitions that share
 * nothing with the code under test but comparisons of doubles. */
#ifndef FROE_TESTS_ORACLE_SEGMENT_H
#define FROE_TESTS_ORACLE_SEGMENT_H
#include <gmp.h>
#include <math.h>
#include <stdbool.h>

/** Sign of (v - u) x (x - u). */
int oracle_turn(const double *u, const double *v, const double *x);
/** Does the closed segment meet the closed box, whose bounds may be infinite? */
bool oracle_segment_meets_box(const double *u, const double *v, const double *lo, const double *hi);
/** The height at which a ray from a point, upwards (1) or downwards (-1), first meets the segment; false: it does not.
 */
bool oracle_height(const double *u, const double *v, const double *point, int direction, mpq_t height);
/** How two segments meet: 0 apart, 1 cross (inner points of both, one only), 2 touch, 3 overlap (or equal). */
int oracle_segments_meet(const double *const a[2], const double *const b[2]);
#endif
