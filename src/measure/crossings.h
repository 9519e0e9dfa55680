/* crossings.h: counts the boxes whose insides meet a window, for many windows, in two ways with the same answers.
 *
 *     search    each window searches a packed hierarchy: O(log n + what it finds), the plain method
 *     trees     inclusion and exclusion. On an axis a box meets lo .. hi if it begins before hi, but not if it also
 *               ends up to lo. Of the 2^d products of these each is a number of points below a corner, which range
 *               trees count in O(log^(d - 1) n) however many there are (Tobola and Nechvile, section 5.1)
 *
 * A flat box, or a flat window, counts where it lies strictly inside the other. */
#ifndef FROE_MEASURE_CROSSINGS_H
#define FROE_MEASURE_CROSSINGS_H
#include "measure/sample.h"

/** Window i, lo[k] <= hi[k] on each axis k. */
typedef void measure_window_fn(const void *user, size_t i, double *lo, double *hi);

typedef struct measure_windows {
    const measure_bounds *bounds; /**< of all objects of the sample's scene, at least one */
    size_t count;
    measure_window_fn *get;
    const void *user;
} measure_windows;

/** out[i]: boxes that meet window i. FROE_E_MEMORY, FROE_E_CANCELLED. */
froe_status measure_count_by_search(measure_sample *sample, const measure_windows *windows, uint32_t *out);
/** The same. O((n + windows) 2^d log^(d - 1) n) time, O(n log^(d - 1) n) space. */
froe_status measure_count_by_trees(measure_sample *sample, const measure_windows *windows, uint32_t *out);
#endif
