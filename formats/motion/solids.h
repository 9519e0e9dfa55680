/* solids.h: bodies and triangles in motion as MF-JSON. */
#ifndef FROE_FORMATS_MOTION_SOLIDS_H
#define FROE_FORMATS_MOTION_SOLIDS_H
#include "formats/input/source.h"
#include "formats/write/writer.h"
#include "support/fail.h"
#include <froe/kinetic.h>

/** What is listed of each point at each instant. */
typedef enum formats_listed { FORMATS_PLACES, FORMATS_CONTROLS, FORMATS_SECOND_CONTROLS } formats_listed;
/** Of the piece that begins at a knot: 1, 2 or 3. */
int formats_degree_of(const froe_moving_knot *knot);
/** The end of "type", and which interpolation pieces of up to this degree have. */
void formats_put_interpolation(formats_writer *w, int degree);
/** A place or a control point, in `dim` coordinates, of the piece from one knot to the next. Where parabolas are the
 * most (degree 2), the control points of straight pieces are their middles; where cubics are, what is no control point
 * is null, so that nothing is rounded. */
void formats_put_listed(formats_writer *w, const froe_moving_knot *knot, const froe_moving_knot *next, int dim,
                        formats_listed what, int degree);

/** Writes a feature that begins with an object of no body of the plane. Returns the first object after it. */
typedef uint32_t formats_other_fn(const froe_motion *motion, formats_writer *w, uint32_t first);

/** Writes all features, with `other` for those of the plane that are of no body. FROE_E_UNSUPPORTED, FROE_E_MEMORY. */
froe_status formats_write_solids(const froe_motion *motion, formats_writer *w, formats_other_fn *other,
                                 froe_diagnostic *diag);

/** All of a file, and behind it a NUL and as many more as numbers are read ahead; `count` is without them. FROE_E_IO,
 * FROE_E_MEMORY. */
froe_status formats_load_motion(const char *path, const froe_allocator *alloc, formats_text *text,
                                froe_diagnostic *diag);
#endif
