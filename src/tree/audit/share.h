/* share.h: have two solids a point in common? The audit's own way above dimension 3: builders find distances
 * (geom/meet/apart.h), the audit solves a linear program.
 *
 *     sum of v_i a_i  -  sum of w_j b_j  =  0,    sum of v_i  =  sum of w_j  =  1,    v, w >= 0
 *
 * for corners a_i of one and b_j of the other. It has a solution if and only if there is a common point. */
#ifndef FROE_TREE_AUDIT_SHARE_H
#define FROE_TREE_AUDIT_SHARE_H
#include "geom/convex.h"

/** Have they? Points, boxes and balls by their distance along the axes, polytopes above dimension 3 by the program, all
 * others by geom_meet(), another search than the builders' in 2D and 3D. Exact. Arena: num_arena_bound. */
bool share_point(num_context *context, const geom_convex *a, const geom_convex *b);
#endif
