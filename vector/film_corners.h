/* film_corners.h: a scene of points that holds all that is ever there in a motion, for cameras. */
#ifndef FROE_VECTOR_FILM_CORNERS_H
#define FROE_VECTOR_FILM_CORNERS_H
#include <froe/kinetic.h>

/** Points whose hull holds every corner of every object as long as that is there, hardly larger than need be. Of more
 * than a million, bodies stand with the box of all that they carry. FROE_E_INPUT: nothing is ever there. FROE_E_MEMORY.
 * *out is the caller's, on failure, too. */
froe_status vector_film_corners(const froe_motion *motion, froe_scene **out, froe_diagnostic *diag);
#endif
