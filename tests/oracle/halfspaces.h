/* halfspaces.h: the oracle for intersections of halfspaces in any dimension, in exact rationals (GMP).
 *
 * Whether one meets a hull is a linear program of the weights of corners, in a dense table, by Bland's rule. The point
 * of one that is nearest to another point is found among all points nearest to it in which planes meet. */
#ifndef FROE_TESTS_ORACLE_HALFSPACES_H
#define FROE_TESTS_ORACLE_HALFSPACES_H
#include "oracle/high.h"

/** Does the set, a hull or a ball, meet all of normals[i] . x <= offsets[i]? 12 of them at most. */
bool halfspaces_meet(const high_set *set, const double *normals, const double *offsets, size_t count);
#endif
