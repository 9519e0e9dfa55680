/* hierarchy.h: boxes, each with a size, to be found by place and size.
 *
 *     level 2              [ all ]                     eight neighbours along a curve make a node (Kamel and Faloutsos
 *     level 1      [ 8 ] [ 8 ] [ 8 ] ...               1993), which holds their common box and their greatest size:
 *     level 0     b b b b b b b b b ...                a search for large boxes skips nodes of small ones
 *
 * For measures of scenes, where building must be quick and all dimensions occur. */
#ifndef FROE_MEASURE_HIERARCHY_H
#define FROE_MEASURE_HIERARCHY_H
#include "support/alloc.h"

enum { MEASURE_FAN = 8, MEASURE_LEVELS = 12 };

typedef struct measure_hierarchy {
    froe_allocator alloc;
    int dim;
    uint32_t count, entries, levels;
    uint32_t first[MEASURE_LEVELS + 1]; /**< entries of each level */
    uint32_t *ids;                      /**< [count], of the boxes of level 0 */
    double *lo, *hi, *size;             /**< dim, dim and 1 for each entry */
} measure_hierarchy;

/** Box i is lo[i dim ..] .. hi[i dim ..], finite; size NULL: all 0. FROE_E_MEMORY. O(count). */
froe_status measure_hierarchy_new(const froe_allocator *alloc, int dim, uint32_t count, const double *lo,
                                  const double *hi, const double *size, measure_hierarchy *out);
void measure_hierarchy_free(measure_hierarchy *h);

/** A search for the boxes that meet a closed box and have at least a size. */
typedef struct measure_search {
    const measure_hierarchy *in;
    const double *lo, *hi;
    double least;
    uint32_t top, stack[MEASURE_FAN * MEASURE_LEVELS];
} measure_search;

measure_search measure_search_begin(const measure_hierarchy *h, const double *lo, const double *hi, double least);
/** The next one, or FROE_NONE. */
uint32_t measure_search_next(measure_search *search);
#endif
