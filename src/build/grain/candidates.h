/* candidates.h: planes that may be good cuts. All enter the contest; drawing ends when it is done. */
#ifndef FROE_BUILD_GRAIN_CANDIDATES_H
#define FROE_BUILD_GRAIN_CANDIDATES_H
#include "build/grain/contest.h"

/** Supporting planes of some fragments; of all, where there are few. */
void split_enter_supports(split_contest *contest);
/** Of each axis the best plane across it, through a corner. */
void split_enter_axes(split_contest *contest);
/** Planes through three vertices. Starts at some edges of the mesh: the best plane through the edge a-b and any vertex
 * c; then through b-c and any vertex, and so on, as long as one of the three exchanges makes it better. In the plane
 * lines through two vertices, from some vertices on. */
void split_enter_through(split_contest *contest);
#endif
