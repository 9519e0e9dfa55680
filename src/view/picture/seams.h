/* seams.h: strips and trims along the sides of shapes, so that antialiasing shows neither the background nor hidden
 * faces.
 *
 * STRIPS. Where A ends and a face B goes on that is painted later, A may be drawn into B: an addition at a point whose
 * visible face is painted later than A is covered by that face. So the strip beyond a side of A is cut to the
 * visible pieces of later faces. (Faces that share an edge have it shorter: outline.h.)
 *
 *        A    |////|  B            strip: beyond A's side, within what is visible of B
 *             |////|
 *
 * TRIMS. Where a border of A is hidden, but ends together with what hides it, the two coverages of a pixel compound,
 * and A's colour shows along the outline of the other. There A is drawn short, where nothing visible of it lies in
 * the part left out.
 *
 *        |::::: A, hidden by B     trim: the dotted part is left out
 *        |::::: B
 *
 * It speaks for seams.c (strips) and trims.c.
 */
#ifndef FROE_VIEW_PICTURE_SEAMS_H
#define FROE_VIEW_PICTURE_SEAMS_H
#include "view/grid.h"
#include "view/picture/parts.h"

/** The points of a visible piece, in those of all. */
typedef struct seam_span {
    uint32_t first, count;
} seam_span;

/** A stretch of a side, in shares of its length. */
typedef struct seam_range {
    double from, to;
} seam_range;
typedef ARRAY(seam_range) seam_ranges;

typedef struct view_seams {
    const view_parts *parts; /**< NULL: seams are not treated */
    const uint8_t *clear;    /**< per patch, or NULL */
    double width;
    uint32_t *place;            /**< per node: when it is painted */
    uint32_t *run;              /**< per node: nodes of one run share a path */
    print_ring points;          /**< of all visible pieces */
    ARRAY(uint32_t) starts;     /**< of each, and their end */
    view_grid grid;             /**< of them */
    uint32_t *marks, marked;    /**< per node; the last number that is one */
    ARRAY(uint32_t) near;       /**< pieces near a side */
    ARRAY(uint32_t) own;        /**< pieces of its node */
    seam_ranges inside, beyond; /**< of the side: where its node is visible inside; where something later is beyond */
    ARRAY(uint32_t) order;      /**< for sorting those */
    print_ring extra;           /**< strips of the shape in the making */
    ARRAY(uint32_t) extra_ends; /**< per strip: where its points end */
    print_ring clip[2];
} view_seams;

/** `order`: all nodes as they are painted; `breaks` per place in it: something else is painted before; `styles` per
 * patch; these two may be NULL. FROE_E_MEMORY. */
froe_status view_seams_new(view_seams *seams, view_parts *parts, const uint32_t *order, const uint8_t *breaks,
                           const uint32_t *styles, const uint8_t *clear, double width);
/** Puts the visible pieces, which are on the page now, into a grid, before anything is looked for. FROE_E_MEMORY. */
froe_status view_seams_spread(view_seams *seams);
void view_seams_free(view_seams *seams);
/** What a thread needs to look along sides; to be closed before the seams are freed. FROE_E_MEMORY. */
froe_status view_seams_fork(const view_seams *seams, view_seams *out);
void view_seams_close(view_seams *fork);
/** Looks along a side of a node's shape, which lies on its left as the eye sees it. *beside: the node is visible
 * inside; then strips are added. False without memory. */
bool view_seams_look(view_seams *seams, uint32_t node, print_point a, print_point b, bool *beside);
/** *ends: what is visible inside a side and painted later than the node ends there as well. False without memory. */
bool view_seams_end(view_seams *seams, uint32_t node, print_point a, print_point b, bool *ends);
/** *hidden: nothing is visible of a node in a convex ring, turning left. False without memory. */
bool view_seams_hidden(view_seams *seams, uint32_t node, const print_point *ring, size_t count, bool *hidden);
/** Appends the strips found since, as rings. False without memory. */
bool view_seams_flush(view_seams *seams, print_ring *points, print_ends *ends);

/* What strips and trims have in common. */

static inline seam_span view_seam_span(const view_seams *s, uint32_t visible) {
    return (seam_span){s->starts.data[visible], s->starts.data[visible + 1] - s->starts.data[visible]};
}

#define SEAM_MARGIN 0.02 /**< widths: rings that overlap by less only touch */
/** Lists, in `near`, the pieces that a walk finds. False without memory. */
bool view_seams_near(view_seams *seams, view_grid_walk walk);
/** Lists, in `own`, what is visible of a node: all of it where that is little, else what a walk finds. False without
 * memory. */
bool view_seams_own(view_seams *seams, uint32_t node, view_grid_walk walk);
/** Does a visible piece, or any of the list `own`, overlap a convex ring? */
bool view_seam_meets(const view_seams *seams, uint32_t visible, const print_point *ring, size_t count);
bool view_own_meets(const view_seams *seams, const print_point *ring, size_t count);
/** Is a visible piece painted later than the node, in another path, and opaque? */
bool view_seam_covers(const view_seams *seams, uint32_t visible, uint32_t node);
/** A strip of some width on the right of ab (on its left: negative), turning left. */
void view_make_strip(print_point a, print_point b, double width, print_point out[4]);
#endif
