/* bar_cut.h: the cut of a BAR cell: both parts fat, and neither with too many of the points.
 *
 *     +-----+-------+        For each direction, cuts within an interval leave both parts with an aspect of at most
 *     |    :|:    . |        `aspect`. The median of the points, or the end of the interval nearest to it, is the
 *     |    :|:   ...|        candidate. If no candidate leaves few enough of the points on each side, the
 *     |    :|:    . |        shortest sequence of such cuts is looked for after which one does: up to three, each of
 *     +-----+-------+        the part that has most of the points.
 *
 * Duncan, Goodrich and Kobourov (1999): with these directions a sequence of constant length exists. Keys are the
 * points' n . x of every direction, row by row. All counts are by keys; a rounded key costs balance, nothing else. */
#ifndef FROE_BUILD_BAR_BAR_CUT_H
#define FROE_BUILD_BAR_BAR_CUT_H
#include "build/bar/bar_shape.h"

typedef struct bar_rule {
    split_directions directions;
    double aspect; /**< of all cells, at most */
    double floor;  /**< cells narrower than this, or than 2^-40 of their coordinates, are not cut */
    bool through;  /**< cuts go through points, which are then in neither part; or else between them */
} bar_rule;

/** A cell that a sequence of cuts leads to. */
typedef struct bar_step {
    bar_region region;
    size_t row; /**< its points' keys */
    uint32_t count;
    double weight; /**< points that each of them stands for */
    int cuts, first;
} bar_step;

typedef struct bar_candidate {
    int direction;    /**< -1: none */
    double value;     /**< n . x of the cut */
    double aspect[2]; /**< of the parts */
    double larger;    /**< points in the fuller part */
} bar_candidate;

/** What a thread works with; all zero at first. */
typedef struct bar_search {
    ARRAY(double) keys; /**< row after row; the caller puts those of the cell first */
    ARRAY(double) column;
    ARRAY(bar_step) steps;
    bar_shape shape;
} bar_search;

typedef enum bar_found {
    BAR_NONE,       /**< no cut leaves both parts fat, or the cell is at the floor */
    BAR_CUT,        /**< the first of at most three cuts until no part has more points than the target */
    BAR_UNBALANCED, /**< the best there is */
    BAR_MEMORY
} bar_found;

/** The cut of a region with `count` points, at least one, of which a part is to have `target` at most. Deterministic.
 */
bar_found bar_search_cut(const bar_rule *rule, const froe_allocator *alloc, bar_search *search,
                         const bar_region *region, uint32_t count, double target, bar_candidate *out);
/** Between the median of some keys and the key before or after it, whichever leaves the parts more even. */
double bar_between(const double *column, uint32_t count, double median);
void bar_search_free(const froe_allocator *alloc, bar_search *search);
#endif
