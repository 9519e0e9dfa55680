/* halfspaces.h: does a convex set meet an intersection of halfspaces, above dimension 3? Exactly.
 *
 * There are too many corners of such an intersection to look at. By Farkas' lemma (Theorie der einfachen Ungleichungen,
 * 1902) there is no common point if and only if the inequalities, times numbers >= 0, add up to a contradiction:
 *
 *     box            inequalities of x: n . x <= c, and the sides of the box         0 x <= -1
 *     few corners    of the weights of corners: sum of weight_j (n . v_j - c) <= 0   more than 0 at each corner
 *     many corners   the same, where there are few halfspaces: the weights are looked for
 *     ball           the point of the intersection nearest to the centre is in dim planes at most, and the way there is
 *                    a sum of their normals, times numbers >= 0 (Karush 1939; Kuhn and Tucker 1951)
 *
 * The first three are linear programs of few rows (program.h). Where corners and halfspaces are many, any dim + 1 of
 * the latter have to meet the set, which is enough (Helly 1923). */
#ifndef FROE_GEOM_HIGH_HALFSPACES_H
#define FROE_GEOM_HIGH_HALFSPACES_H
#include "geom/convex.h"

typedef struct geom_halfspaces {
    int dim;
    size_t count;
    const double *normals, *offsets; /**< normals[i * dim ..] . x <= offsets[i] */
} geom_halfspaces;

/** Of a list or a box without a radius, or a ball. *memory: there was none to find out. O(count) where a corner, or the
 * centre, is in all of them, or one of them has nothing of the set. Else as long as a linear program takes; of a ball,
 * and of many corners, as long as the choices among those take that cut the set. */
bool geom_halfspaces_meet(num_context *context, const froe_allocator *alloc, const geom_halfspaces *halfspaces,
                          const geom_convex *set, bool *memory);
/** The radius of a ball in all of them, certain, and not the largest; 0: none was found. x becomes its centre; the
 * search begins there. Doubles alone. O(dim^2 count). */
double geom_halfspaces_ball(const geom_halfspaces *halfspaces, double *x);
/** Is there a point in all of them? */
bool geom_halfspaces_any(num_context *context, const geom_halfspaces *halfspaces);
/** Are all such points, if there are any, within some distance? */
bool geom_halfspaces_bounded(num_context *context, const geom_halfspaces *halfspaces);
#endif
