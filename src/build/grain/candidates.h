/* candidates.h: planes that may be good cuts. All enter the contest; drawing ends when it is done. */
#ifndef FROE_BUILD_GRAIN_CANDIDATES_H
#define FROE_BUILD_GRAIN_CANDIDATES_H
#include "build/grain/grain.h"
#include "build/grain/pencils.h"
#include "split/score/contest.h"

enum { SPLIT_LATER = 128, SPLIT_KEPT = 64 };

/** A plane through vertices on its way: priced by sweeps. */
typedef struct split_start {
    split_candidate k;
    uint32_t marks; /**< of the view when it was priced */
} split_start;

/** What the search for one cell notes; kept per thread. */
typedef struct split_grain_notebook {
    split_candidate later[SPLIT_LATER];              /**< supporting planes that were not entered yet */
    split_start drawn[SPLIT_KEPT], kept[SPLIT_KEPT]; /**< the best starts, among a few fragments and among all */
    split_pencils pencils;
    uint32_t later_count;
} split_grain_notebook;

/** The search for the cut of one cell. */
typedef struct split_grain_search {
    split_contest contest;
    const split_grain *config;
    split_sweep *sweep;
    split_grain_notebook *notes;
    uint64_t draws;         /**< made so far for this cell */
    split_prices prices[2]; /**< in all that is shown, and in a few fragments of it */
} split_grain_search;

/** Prepares for what the contest shows now. */
void split_grain_begin(split_grain_search *search);

/** Finds the cost of a candidate in what is shown, without the splits that are due (crossing.h). False: it is no
 * plane, or separates nothing. */
bool split_grain_score(split_grain_search *search, split_candidate *candidate);
/** Supporting planes of some fragments; of all, where there are few. Those that win at most because their splits are
 * due are left for later, when few of them can still win. */
void split_enter_supports(split_grain_search *search);
void split_enter_late_supports(split_grain_search *search);
/** Of each axis the best plane across it, through an input vertex. */
void split_enter_axes(split_grain_search *search);
/** Planes through three vertices. Starts at some edges of the mesh, with the best plane through the edge a-b and any
 * vertex c; the best of these planes are improved: through b-c and any vertex, and so on, as long as one of the three
 * exchanges makes a plane better. In the plane lines through two vertices, from some vertices on. */
void split_enter_through(split_grain_search *search);
#endif
