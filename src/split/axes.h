/* axes.h: the fragments of a cell along one axis, and the axis-parallel planes that separate some of them.
 *
 *     low                high
 *      [------------------]      [------]          flat: low = high
 *               [--------------]            |
 *      ^        ^         ^    ^ ^      ^   ^      candidates: where something begins or ends
 *
 * Ends are images; what they say of a plane is found out exactly when it becomes the cut (cell.c). */
#ifndef FROE_SPLIT_AXES_H
#define FROE_SPLIT_AXES_H
#include "base/radix.h"
#include "split/grow.h"
#include "split/score/price.h"

typedef struct split_axes {
    ARRAY(double) low, high, flat; /**< of all fragments, ascending */
    ARRAY(double) spare;
    ARRAY(base_pair) pairs;
    size_t begun, ended, flats; /**< of the sweep: how many lie below value */
    double value;               /**< the candidate that the sweep has come to */
    split_tally tally;          /**< what it does */
} split_axes;

/** Where the image of a fragment begins and ends on an axis; solids with all of themselves. */
void split_extent(const split_set *set, const split_fragment *fragment, int axis, double *low, double *high);
void split_axes_free(const froe_allocator *alloc, split_axes *axes);
/** Sorts the ends on an axis, and sets the sweep before the first. False without memory. O(m). */
bool split_axes_fill(split_axes *axes, const split_set *set, const split_cell *cell, int axis);
/** Goes on to the next candidate, ascending, each value once. False: there is none. O(1) amortised. */
bool split_axes_next(split_axes *axes);
/** All planes x[axis] = c with from <= c <= to have a fragment wholly on each side, or one in them. False: no plane
 * has. O(m). */
bool split_axes_gap(const split_set *set, const split_cell *cell, int axis, double *from, double *to);
#endif
