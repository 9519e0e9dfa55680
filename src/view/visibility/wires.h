/* wires.h: segments and points of a scene, held against the faces that an eye sees.
 *
 *        u o                  When all faces have been looked at, each leaf of the beam tree is open, or belongs to
 *           \  open           the face that is visible there. A wire goes down that tree; in the leaf of a face it
 *     ,------\------.         ends at the plane of the face, beyond which it is hidden: by exact sides of u and v, and
 *     | face  x     |         a line of sight through the point x where the plane stops it (VIEW_STOP).
 *     |         ` . |
 *     `-----------`-'         What lies in the plane of a face, or ends there, is not behind it.
 *                   ` o v
 *
 * A point of a wire is hidden if and only if a face, its border included, lies between it and the eye. So a wire that
 * runs along a line of the tree goes to both sides, and only what is visible on both is visible. */
#ifndef FROE_VIEW_VISIBILITY_WIRES_H
#define FROE_VIEW_VISIBILITY_WIRES_H
#include "view/visibility/visibility.h"

/** Appends the visible stretches of all wires, with the numbers of their lines for edges, and notes in points_seen
 * which points are visible. The screen is complete. FROE_E_MEMORY, FROE_E_CANCELLED. */
froe_status view_look_at_wires(froe_visibility *v, const view_screen *screen, base_task *task, view_runs *stretches);
#endif
