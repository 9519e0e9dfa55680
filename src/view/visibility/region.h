/* region.h: the visible region of a patch as rings, from its visible pieces.
 *
 *      +----+--------+          Sides of pieces lie on lines of the picture. On each line, a stretch with a piece of
 *      |    |        |          the patch on both sides is inside the region and is dropped; a stretch with a piece on
 *      |    +----+---+          one side is border, directed so that the region is on its left. Ends are compared
 *      |    |    |   |          exactly, so the remaining stretches join: every ring closes.
 *      +----+----+---+
 */
#ifndef FROE_VIEW_VISIBILITY_REGION_H
#define FROE_VIEW_VISIBILITY_REGION_H
#include "base/radix.h"
#include "view/visibility/visibility.h"

/** A side of a piece: the line it lies on, and its ends in the order of the line, each line x across. */
typedef struct region_side {
    uint32_t line;
    uint32_t turned; /**< the piece is on the right of the line */
    uint32_t end[2]; /**< corners of the patch */
    view_way across[2];
} region_side;

typedef struct region_border {
    uint32_t from, to; /**< corners of the patch */
    uint32_t next;     /**< border that begins at the same point; FROE_NONE */
} region_border;

/** Rings of one patch at a time, and the arrays to make them. All zero at first. */
typedef struct view_region {
    ARRAY(view_turn) corners; /**< of all rings */
    ARRAY(uint32_t) starts;   /**< ring i: corners[starts[i] .. starts[i+1]) */
    /* in the making */
    ARRAY(region_side) sides;   /**< of all pieces; side i leaves corner i of the patch */
    ARRAY(view_turn) corner_of; /**< per corner of the patch */
    ARRAY(base_pair) by_line;
    ARRAY(uint32_t) ends;  /**< of the sides on one line: 2 * side + end */
    ARRAY(uint32_t) point; /**< per corner: the representative of its point (union-find) */
    ARRAY(region_border) borders;
    ARRAY(uint32_t) first_border; /**< per corner: a border that begins at the point it stands for */
} view_region;

/** Makes the rings of a patch; outer rings turn left as the eye sees them, holes right. `sights` are those of the
 * visibility with a number context of the caller's. FROE_E_MEMORY. */
froe_status view_region_make(view_region *region, const froe_visibility *v, view_sightlines *sights, uint32_t patch);
void view_region_free(const froe_allocator *alloc, view_region *region);
#endif
