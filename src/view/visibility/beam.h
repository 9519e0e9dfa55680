/* beam.h: one piece of the tree as the eye sees it: a beam, and stretches of the edges of its polygon. */
#ifndef FROE_VIEW_VISIBILITY_BEAM_H
#define FROE_VIEW_VISIBILITY_BEAM_H
#include "view/visibility/screen.h"

typedef ARRAY(view_corner) view_ring;

/** The beam of a piece; the eye is not in its plane. Empty where the piece has no width. False without memory. */
bool view_beam_of(view_sightlines *sights, uint32_t piece, view_ring *ring);
/** The beam of a whole polygon. */
bool view_beam_of_object(view_sightlines *sights, uint32_t object, view_ring *ring);
/** How many sides the ring of such a piece has, and the stretch of the i-th: false when that is no part of an edge of
 * the polygon. *status: FROE_E_MEMORY. */
uint32_t view_side_count(const view_sightlines *sights, uint32_t piece);
bool view_stretch_of(view_sightlines *sights, uint32_t piece, uint32_t i, view_stretch *out, froe_status *status);
#endif
