/* view.h: a cell laid out for scoring: images of all corners as flat arrays.
 *
 * Candidates are many and only one becomes the cut, so they are counted in plain
 * doubles; the chosen one is then classified exactly (cell.c). A wrong count here costs a
 * worse cut, never a wrong tree. Large cells are represented by a sample. */
#ifndef FROE_SPLIT_VIEW_H
#define FROE_SPLIT_VIEW_H
#include "split/grow.h"

typedef struct split_view {
    ARRAY(double) x[3];      /**< coordinates of the corners, by axis (2D: two of them) */
    ARRAY(double) radius;    /**< per corner, where `round`: balls are shown by their centres */
    ARRAY(uint32_t) start;   /**< count + 1 offsets of the fragments' corners */
    ARRAY(uint8_t) side;     /**< bit 0: negative, bit 1: positive, per corner: of the last count */
    ARRAY(double) values;    /**< ends of extents, for axis candidates */
    ARRAY(double) low, high; /**< extents of the fragments on the current axis */
    uint32_t count;          /**< fragments shown */
    bool pairs;              /**< every fragment has two corners, in the plane */
    bool round;              /**< there are balls */
    double weight;           /**< fragments of the cell per fragment shown, >= 1 */
    double reach[3];         /**< largest |coordinate| by axis */
} split_view;

/** How a cut would deal with the fragments shown. */
typedef struct split_tally {
    uint32_t negative, positive, on, both; /**< disjoint classes */
} split_tally;

void split_view_free(const froe_allocator *alloc, split_view *view);
/** Shows the cell, or `sample` fragments of it drawn (with replacement) by `seed` when it has more. */
bool split_view_fill(split_view *view, const split_set *set, const split_cell *cell, uint32_t sample, uint64_t seed);
/** Counts for any cut; dimensions 2 and 3. */
split_tally split_view_count(split_view *view, const froe_scene *scene, const froe_cut *cut);
/** Counts for the plane x[axis] = value from the extents on that axis; any dimension. */
split_tally split_view_count_axis(const split_view *view, double value);
/** Where the image of a fragment begins and ends on an axis; solids with all of themselves. */
void split_extent(const split_set *set, const split_fragment *fragment, int axis, double *low, double *high);
/** Computes the extents on an axis, and their ends, sorted, as `values`. */
bool split_view_extents(split_view *view, const split_set *set, const split_cell *cell, int axis);
#endif
