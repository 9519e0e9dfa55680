/* wrap.h: borders that cross the antimeridian are cut there.
 *
 * An edge between longitudes that differ by more than 180 degrees runs the other way around, through 180 = -180:
 *
 *          179     180 | -180    -179                     179     180   -180    -179
 *           .------------------------------ ... ------------.      .---.     .---.
 *           '------------------------------ ... ------------'      '---'     '---'
 *                           as its file says                        as it is meant
 *
 * Each such edge becomes two, which end at its crossing; along both sides of the antimeridian the interior of a polygon
 * lies between the first and the second crossing of its rings, counted from the south, the third and the fourth, and so
 * on. An odd number of crossings goes around a pole, of which the polygon contains the one nearer to its outermost
 * crossing: Antarctica gets edges along 180 and -180 to the pole, and one along the pole.
 *
 * GDAL's -wrapdateline makes the same cuts where it makes any; it leaves edges alone that differ by less than 350
 * degrees, rings around poles, and rings that end in 180 or -180, as those of Fiji and Russia do. A crossing's latitude
 * is rounded to a double, the same one in both directions; all other coordinates stay what they are. Longitudes beyond
 * 180, of maps that have the Pacific in the middle, become those within. */
#ifndef FROE_FORMATS_WRAP_H
#define FROE_FORMATS_WRAP_H

#include "formats/input/sink.h"

/** Latitudes in which the rings of a polygon cross. */
typedef ARRAY(double) formats_wrap_cuts;

/** Longitude and latitude of a point, the longitude within 180. FROE_E_INPUT: it is beyond 360, or the latitude beyond
 * 90. */
froe_status formats_wrap_point(formats_sink *sink, const double *point, double *out);
/** Adds the segments of a line or a ring, and its crossings to the cuts. */
froe_status formats_wrap_line(formats_sink *sink, const double *xy, size_t count, formats_wrap_cuts *cuts);
/** Adds the segments along the antimeridian between the crossings of a polygon, of which none are left. Its interior is
 * on their right, or otherwise on their left. */
froe_status formats_wrap_close(formats_sink *sink, formats_wrap_cuts *cuts, bool right);
/** On which side of a ring is its interior, on the Earth? As formats_ring_side(). The longitudes become continuous. */
int formats_wrap_ring_side(double *xy, size_t count);

#endif
