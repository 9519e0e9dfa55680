/* touching.h: whether two moving triangles meet at a rational instant, by other means than froe's: where their corners
 * are in rationals (GMP), and whether some point is a mean of both, which is a linear program; solved by the simplex
 * method with Bland's rule. No plane, no edge and no polynomial in time is in it. */
#ifndef FROE_TESTS_ORACLE_TOUCHING_H
#define FROE_TESTS_ORACLE_TOUCHING_H
#include <froe/kinetic.h>
#include <gmp.h>

/** The sign of `time` - x. */
int oracle_compare_time(const mpq_t time, double x);
/** Where a vertex is. REQUIRES: its plan covers the time. */
void oracle_corner(const froe_motion *m, uint32_t vertex, const mpq_t time, mpq_t out[3]);
/** Do two triangles come closer to one another than `slack` along each axis, or (0) meet? */
bool oracle_triangles_meet(const froe_motion *m, uint32_t a, uint32_t b, const mpq_t time, const mpq_t slack);
/** Have two triangles that share vertices a point in common that is no mean of these? All basic solutions of the linear
 * program are tried: among them are all corners of what they have in common. */
bool oracle_neighbours_meet(const froe_motion *m, uint32_t a, uint32_t b, const mpq_t time);
#endif
