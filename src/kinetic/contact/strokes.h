/* strokes.h: segments of the plane, some of bodies that turn, as polynomials of degree 6 at most that tell whether two
 * of them meet; as meet_segments.c has them of segments that fly by themselves. */
#ifndef FROE_KINETIC_STROKES_H
#define FROE_KINETIC_STROKES_H
#include "kinetic/motion/motion.h"
#include "num/poly.h"

/** The pieces of the ends of both segments, between two times; gap[4 k + 2 i + j] has the sign of coordinate k of the
 * way from end i of the first to end j of the second, turn[j] of the side of end j of the second from the first, and
 * turn[2 + i] of end i of the first from the second. */
void strokes_near(const froe_motion *m, const motion_piece piece[4], double from, double to, num_ball_poly gap[8],
                  num_ball_poly turn[4]);
void strokes_exact(num_arena *arena, const froe_motion *m, const motion_piece piece[4], double from, double to,
                   num_poly gap[8], num_poly turn[4]);
#endif
