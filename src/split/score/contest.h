/* contest.h: candidates for one cell's cut, of which the cheapest wins.
 *
 * They are scored on what is shown of the cell (view.h). Planes through three vertices often pass others so closely
 * that doubles cannot tell on which side, and where they do not run through them, as all around the pole of a sphere in
 * rounded coordinates, each split is real. So in an exact contest no candidate becomes the best before its exact count
 * says so; and on a sample, where counts are uncertain, several of the best are kept to be entered again when all is
 * shown. Other contests trust the view: their winner is counted exactly when the cell is cut (cell.c).
 *
 * Walls that are flat only up to a rounding deceive the view in all planes along them at once. So where a candidate
 * with several fragments in its plane would be the best, those are checked exactly, and marked if they are not in it
 * (mark.h): in exact contests always, in others a number of times. */
#ifndef FROE_SPLIT_SCORE_CONTEST_H
#define FROE_SPLIT_SCORE_CONTEST_H
#include "split/score/view.h"

enum { SPLIT_FINALISTS = 16 };

typedef struct split_candidate {
    froe_cut cut;
    double due; /**< splits that no other cut saves */
    double cost;
    split_tally tally; /**< in what is shown; exact of the best of an exact contest, unless the cell is only sampled */
} split_candidate;

typedef struct split_contest {
    split_work *work;
    const split_cell *cell;
    split_view *view;
    const split_price *price;
    split_terms terms;
    double copy;                           /**< of solids, with a price of their own */
    bool solids;                           /**< the cell holds nothing but boxes, balls and hulls */
    bool exact;                            /**< see above */
    uint32_t refuted;                      /**< candidates whose exact price was higher than it had seemed */
    bool deceived;                         /**< nothing is ever marked */
    uint32_t checks;                       /**< left, of planes that are checked besides exact counts; see above */
    split_candidate best[SPLIT_FINALISTS]; /**< by cost, ascending */
    uint32_t count, room;
    bool done;   /**< the best can hardly be beaten: no need to look on */
    bool failed; /**< out of memory */
} split_contest;

/** Begins, with the cell shown or a sample of at most so many fragments; no more than `checks` planes are checked. */
void split_contest_show(split_contest *contest, uint32_t sample, uint64_t seed, uint32_t checks);
/** Finds the cost of a cut that is known to deal so with what is shown. False: it separates nothing. */
bool split_contest_price(const split_contest *contest, split_candidate *candidate, split_tally tally);
/** The same by counting; `plane` is that of the cut. False: it is no plane, or separates nothing. */
bool split_contest_score(split_contest *contest, split_candidate *candidate, split_view_plane *plane);
/** A candidate with its cost takes part. */
void split_contest_enter(split_contest *contest, const split_candidate *candidate);
#endif
