/* strip.h: what lies in two cells next to the wall between them, in space.
 *
 *     ___:_________________         A point passes a wall that belongs to another point: see pass.h. The strips are
 *        :    |..:..|     :         what lies between the wall and the lines on both sides of both points, in the near
 *        :near|..:..| far :         and the far cell, through all layers of surfaces in these. Both are cut off, made
 *     ___:____|..:..|_____:         anew from the triangles of both, and joined again (section 3.2 of the paper, which
 *                                   has the plane's transient cells in mind). All that is not in them stays. */
#ifndef FROE_KINETIC_STRIP_H
#define FROE_KINETIC_STRIP_H
#include "kinetic/event/pass.h"
#include "kinetic/tree/ktree.h"

/** A place in the tree, and which of the walls of its cell is passed. */
typedef struct strip {
    ktree_site site;
    int side;
} strip;

/** Is a wall beyond the line that bounds a strip? */
bool strip_point_ends_before(now_state *now, const strip *s, name_point wall);
/** The same of a wall, if there is one; of a vertex in doubles, where these are sure. */
static inline bool strip_ends_before(now_state *now, const strip *s, name_point wall) {
    if (!name_exists(wall)) return true;
    if (name_is_vertex(wall)) {
        const now_spot spot = now_vertex_spot(now, wall.a);
        const double off = spot.x - now->line[1 - s->side], error = spot.error + fabs(off) * 0x1p-52;
        if (fabs(off) > error) return (s->side == KTREE_RIGHT) == (off < 0);
    }
    return strip_point_ends_before(now, s, wall);
}
/** Makes both strips anew, where one of them has `point` inside. Refused where another wall is in one. */
pass_outcome strip_pass(froe_kinetic *k, const strip both[2], name_point point);
#endif
