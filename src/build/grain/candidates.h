/* candidates.h: planes that may be good cuts. All enter the contest; drawing ends when it is done. */
#ifndef FROE_BUILD_GRAIN_CANDIDATES_H
#define FROE_BUILD_GRAIN_CANDIDATES_H
#include "build/grain/grain.h"
#include "build/grain/sweep.h"
#include "split/contest.h"

/** The search for the cut of one cell. */
typedef struct split_grain_search {
    split_contest contest;
    const split_grain *config;
    split_sweep *sweep;
    uint64_t draws; /**< made so far for this cell */
} split_grain_search;

/** Finds the cost of a candidate in what is shown, without the splits that are due (crossing.h). False: it is no
 * plane, or separates nothing. */
bool split_grain_score(split_grain_search *search, split_candidate *candidate);
/** Supporting planes of some fragments; of all, where there are few. */
void split_enter_supports(split_grain_search *search);
/** Of each axis the best plane across it, through an input vertex. */
void split_enter_axes(split_grain_search *search);
/** Planes through three vertices. Starts at some edges of the mesh: the best plane through the edge a-b and any vertex
 * c; then through b-c and any vertex, and so on, as long as one of the three exchanges makes it better. In the plane
 * lines through two vertices, from some vertices on. */
void split_enter_through(split_grain_search *search);
#endif
