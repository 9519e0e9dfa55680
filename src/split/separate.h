/* separate.h: planes between objects that are never cut: boxes, balls, hulls (and points). */
#ifndef FROE_SPLIT_SEPARATE_H
#define FROE_SPLIT_SEPARATE_H
#include "split/grow.h"

/** A cut with some object of the cell wholly on each side, touching it at most; or SPLIT_INSEPARABLE
 * when there is none among
 *   - axis-parallel planes: exact and complete for boxes, which always have a facet between them
 *     unless their interiors meet;
 *   - for balls in R^2 and R^3, the plane across the line of two centres, between the balls, in doubles;
 *   - for hulls in R^2 and R^3, all planes through input vertices of a pair, complete (two polytopes
 *     with disjoint interiors have a separating plane through dim of their vertices).
 * `normal` receives 3 doubles that the cut may point to. Exhaustive: O(m d) first, O(m^2) pairs of balls or
 * of hulls only when axis planes fail. SPLIT_MEMORY, SPLIT_CANCELLED. */
split_verdict split_separate(split_work *work, const split_cell *cell, double *normal, froe_cut *cut);
#endif
