/* turning.h: what is decided in the plane where bodies turn. Doubles come first, as everywhere: a vertex is where a
 * ball has it (now_turning_spot). Where they do not decide, dyadic numbers do, by lines and points (motion/lines.h). */
#ifndef FROE_KINETIC_TURNING_H
#define FROE_KINETIC_TURNING_H
#include "kinetic/motion/lines.h"
#include "kinetic/now/now.h"

/** Does a vertex belong to a body? */
static inline bool now_is_turning(const now_state *now, uint32_t vertex) {
    const froe_motion *m = now->motion;
    return m->bodies.count && vertex < m->plans.count && m->plans.data[vertex].body != FROE_NONE;
}
/** Does one of the vertices behind a point, or a segment, belong to one? Those of a segment do both, or none. */
bool now_is_turning_name(const now_state *now, name_point p);
bool now_is_turning_claim(const now_state *now, const now_claim *claim);

/** The vertices behind a name: returns 1 or, of a crossing, 4. */
int now_vertices_of(const now_state *now, name_point p, uint32_t out[4]);
/** A vertex (count 1), or where the lines through two and two cross (4); at the tick, or as polynomials from it on. */
void now_turning_point(now_state *now, const uint32_t *vertex, int count, bool along, exact_point *out);
void now_turning_line(now_state *now, const uint32_t vertex[2], bool along, exact_line *out);
/** As now_side_of_spots() asks: of the third vertex and the line through two. */
void now_turning_side(now_state *now, const uint32_t vertex[3], bool along, poly_exact *out);
/** How the second line of a crossing turns from the first. */
void now_turning_lines(now_state *now, const uint32_t vertex[4], bool along, poly_exact *out);
#endif
