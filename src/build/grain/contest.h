/* contest.h: candidates for one cell's cut, of which the cheapest wins.
 *
 * They are scored on what is shown of the cell. Planes through three vertices often pass others so closely that doubles
 * cannot tell on which side, and where they do not run through them, as all around the pole of a sphere in
 * rounded coordinates, each split is real. So no candidate becomes the best before its exact count says so. On a
 * sample, where counts are uncertain, several of the best are kept to be entered again when all is shown. */
#ifndef FROE_BUILD_GRAIN_CONTEST_H
#define FROE_BUILD_GRAIN_CONTEST_H
#include "base/random.h"
#include "build/grain/grain.h"
#include "build/grain/sweep.h"

enum { SPLIT_FINALISTS = 16 };

typedef enum split_candidate_kind { SPLIT_SUPPORT, SPLIT_THROUGH, SPLIT_AXIS } split_candidate_kind;

typedef struct split_candidate {
    split_candidate_kind kind;
    uint32_t id[3];  /**< SUPPORT, THROUGH: the vertices that span the plane, as many as dimensions */
    uint32_t object; /**< SUPPORT */
    int axis;        /**< AXIS */
    double value;
    double due; /**< SUPPORT: splits that no other cut saves (crossing.h) */
    double cost;
} split_candidate;

typedef struct split_contest {
    const split_grain *config;
    const split_cell *cell;
    split_work *work;
    split_facets *facets;
    split_sweep *sweep;
    const split_price *price;
    split_terms terms;
    uint64_t draws;
    split_candidate best[SPLIT_FINALISTS]; /**< by cost, ascending */
    uint32_t count, room;
    split_tally tally; /**< exact, of the best, unless the cell is only sampled */
    bool done;         /**< the best can hardly be beaten: no need to look on */
    bool failed;       /**< out of memory */
} split_contest;

/** A number below n > 0: the next of this cell's. */
static inline uint32_t split_draw(split_contest *c, uint32_t n) {
    return base_below(base_hash(c->config->seed, c->cell->path, c->draws++), n);
}
/** Shows the cell, or a sample of at most so many fragments. */
void split_contest_show(split_contest *contest, uint32_t sample);
/** Finds the cost of a candidate in what is shown. False: it is no plane, or separates nothing. */
bool split_contest_score(split_contest *contest, split_candidate *candidate);
/** A candidate with its cost takes part. */
void split_contest_enter(split_contest *contest, const split_candidate *candidate);
froe_cut split_candidate_cut(const split_candidate *candidate);
#endif
