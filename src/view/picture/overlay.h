/* overlay.h: lines that lie on each other on the page are drawn once.
 *
 *     o=========o              a   Where polygons touch in edges of different lengths, or one is behind the
 *          o=========o         b   other, edges have parts of their sightlines in common. There, the strongest
 *     o----|----|----|----o    c   line is drawn: a visible one before a hidden one, then by kind.
 *
 *     aaaaaaaaaabbbbbcccccc        Which lines are one, and in which order ends lie on it, is decided exactly. */
#ifndef FROE_VIEW_PICTURE_OVERLAY_H
#define FROE_VIEW_PICTURE_OVERLAY_H
#include "view/picture/strokes.h"
#include "view/visibility/visibility.h"

/** A stretch that is to be drawn. Where it lies follows from these, so that it is not kept (view_item_end). */
typedef struct view_item {
    view_run run;
    uint32_t source; /**< its edge or wire; by kind, its crossing */
    double share[2]; /**< of that */
    uint32_t object; /**< that it is a line of */
    uint16_t kind;
    uint8_t hidden;
} view_item;
typedef ARRAY(view_item) view_items;

/** What all items come from. */
typedef struct view_drawing {
    view_sightlines *sights;
    const froe_projection *view;
    const froe_crossing *crossings;
} view_drawing;

/** The ends of an edge, wire or crossing in the scene. */
typedef struct view_ends {
    const double *from, *to;
} view_ends;
view_ends view_item_source(const view_drawing *drawing, const view_item *item);
/** An end of an item, as in view_segment: on the page, how near, and in the scene. */
print_point view_item_end(const view_drawing *drawing, const view_item *item, int end, double *near, double space[3]);

/** Appends their drawn parts as segments, which have at most points in common where they lie on one line.
 * `depths`: parts at which different items are nearest to the eye stay apart.
 * FROE_E_MEMORY, FROE_E_LIMIT. */
froe_status view_overlay(const view_drawing *drawing, const view_items *items, const view_chains *chains, bool depths,
                         view_segments *out);
#endif
