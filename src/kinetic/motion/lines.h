/* lines.h: points and lines of the plane as polynomials in time, exactly, where bodies turn.
 *
 *     a x + b y + c w = 0          A segment of a body has a line of degree (2, 2; 4), as one whose ends fly along
 *        ---o======o---            parabolas. Its ends have degree (4, 4; 2), and the line through them, by two points,
 *                                  would have 6 and 8. So all formulas begin with lines, and the order of two
 * crossings has degree 10, as where nothing turns. */
#ifndef FROE_KINETIC_LINES_H
#define FROE_KINETIC_LINES_H
#include "kinetic/motion/poly.h"

/** Of the points (x/w, y/w) with a x + b y + c w = 0; where that is > 0, they are on the left. */
typedef struct exact_line {
    poly_exact a, b, c;
} exact_line;

/** A vertex of a body of the plane, time being counted in ticks from `tick`; or at that tick alone. */
void exact_vertex_in(num_arena *arena, const froe_motion *m, const motion_piece *piece, int64_t tick, bool along,
                     exact_point *out);
/** From the first vertex to the second: both of one body, or any two. */
void exact_line_from(num_arena *arena, const froe_motion *m, const motion_piece end[2], int64_t tick, bool along,
                     exact_line *out);
/** Where two lines cross; w > 0: the second goes on to the left of where the first goes. */
void exact_meeting(num_arena *arena, const exact_line line[2], exact_point *out);
/** > 0: the point is on the left. */
void exact_beside(num_arena *arena, const exact_line *line, const exact_point *point, poly_exact *out);
#endif
