/* separate.h: planes between objects that are never cut: boxes, balls, hulls (and points). */
#ifndef FROE_SPLIT_SEPARATE_H
#define FROE_SPLIT_SEPARATE_H
#include "geom/between.h"
#include "geom/meet/apart.h"
#include "split/grow.h"

/** What the search keeps per thread: the numbers of the plane found last and of the best, and corners being looked at.
 */
typedef struct split_separator {
    double rows[GEOM_APART_NUMBERS], best[GEOM_APART_NUMBERS];
    ARRAY(geom_member) corners;
    ARRAY(double) bounds; /**< of the objects of a crowd: dim lower, then dim upper ends each */
} split_separator;

/** A cut with some object of the cell wholly on each side, touching it at most, or one in it; or SPLIT_INSEPARABLE
 * when there is none among
 *   - axis-parallel planes: exact and complete for boxes, which always have a facet between them
 *     unless their interiors meet;
 *   - for hulls in R^2 and R^3, planes through corners of a pair: exact and complete, also where they touch, but for
 *     pairs that lie in one plane (geom/between.h);
 *   - for all pairs but boxes, the plane halfway between their nearest points: complete for pairs that have no point
 *     in common (geom/meet/apart.h).
 * The cut may point to the separator. O(m d) first, O(m^2) pairs only when axis planes fail.
 * SPLIT_MEMORY, SPLIT_CANCELLED. */
split_verdict split_separate(split_work *work, const split_cell *cell, split_separator *separator, froe_cut *cut);

/** Room for any pair of the cell, and for its bounds. False without memory. */
bool split_separator_ready(const split_set *set, const split_cell *cell, split_separator *separator);
/** A plane between two solids, of the second and third kinds above; none for two boxes. REQUIRES: ready. */
bool split_separate_pair(split_work *work, uint32_t a, uint32_t b, split_separator *separator, froe_cut *cut);
/** Can half of the pairs of the cell not be told apart? Of all pairs, in cells of many objects of those that stand
 * near each other (tree_crowd). REQUIRES: ready. O(m) pairs of them, at most m^2 / 2. */
bool split_crowded(split_work *work, const split_cell *cell, split_separator *separator);
void split_separator_free(const froe_allocator *alloc, split_separator *separator);
#endif
