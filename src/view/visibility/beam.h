/* beam.h: one piece of the tree as the eye sees it: a beam, and stretches of the edges of its polygon. */
#ifndef FROE_VIEW_VISIBILITY_BEAM_H
#define FROE_VIEW_VISIBILITY_BEAM_H
#include "view/visibility/screen.h"

typedef ARRAY(view_corner) view_ring;

/** The beam of a piece; the eye is not in its plane. Empty where the piece has no width. False without memory. */
bool view_beam_of(view_sightlines *sights, uint32_t piece, view_ring *ring);
/** The beam of a whole polygon. */
bool view_beam_of_object(view_sightlines *sights, uint32_t object, view_ring *ring);
/** Does the border of a polygon go straight on at some corner? */
bool view_goes_straight(const view_sightlines *sights, uint32_t object);
/** The stretch of an edge of a polygon along the beam of one of its pieces; false: there is none. *status:
 * FROE_E_MEMORY. */
bool view_stretch_of(view_sightlines *sights, uint32_t object, uint32_t side, const view_ring *ring, view_stretch *out,
                     froe_status *status);
#endif
