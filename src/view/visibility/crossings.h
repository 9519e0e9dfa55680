/* crossings.h: the lines along which polygons pass through each other, and their visible parts.
 *
 *        __B__                A tree has cut A along the plane of B, and keeps B in the list of that cut. So the line
 *       /  :  /               is the part of A's cut side that lies inside pieces of the list; from the eye these
 *   A--/---*-/--A             are beams, and the side is a stretch of a sightline like any other.
 *     /____:/ */
#ifndef FROE_VIEW_VISIBILITY_CROSSINGS_H
#define FROE_VIEW_VISIBILITY_CROSSINGS_H
#include "view/visibility/visibility.h"

typedef struct view_crosser {
    view_sightlines *sights;
    view_screen *screen;
    bool section;        /**< sides in the root's cut count, too */
    bool hidden;         /**< hidden parts are wanted, too */
    bool cull_back;      /**< polygons seen from behind are not there */
    view_stretches seen; /**< found so far, each with the number of its line for an edge */
    view_stretches all;  /**< visible and hidden, where hidden ones are wanted */
    view_stretches open; /**< of one side */
    view_ring list_ring; /**< of a piece in the cut */
} view_crosser;
/** Finds the stretches along which polygons in cuts cross a piece whose beam is `ring`, as far as they are open, and
 * with a section the parts of its sides that lie in that. REQUIRES: view_screen_look() has just found what is open of
 * the beam. FROE_E_MEMORY. */
froe_status view_look_at_crossings(view_crosser *crosser, uint32_t piece, const view_ring *ring);
/** Appends where the section cuts a polygon that is seen edge-on, to the crossings of the visibility: all of it, since
 * REQUIRES: the eye is on the side of the section that is left out. FROE_E_MEMORY. */
froe_status view_look_along_section(froe_visibility *visibility, uint32_t object);
/** Finds where patches cross in a line along which a third cut has divided both: neither is in the list of that. After
 * all has been looked at. FROE_E_MEMORY, FROE_E_LIMIT. */
froe_status view_look_between_patches(froe_visibility *visibility, view_crosser *crosser);
/** Joins what was found to the crossings of the visibility. FROE_E_MEMORY. */
froe_status view_join_crossings(froe_visibility *v, view_crosser *crosser);
void view_crosser_free(view_crosser *crosser);
#endif
