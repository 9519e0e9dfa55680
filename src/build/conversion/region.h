/* region.h: convex regions of the plane in doubles, whose sides have names.
 *
 * For judgements only, such as what may be pruned (convert.h): a corner may be off by its rounding, and nothing that a
 * tree says depends on it. A region whose corners cannot be trusted, because coordinates leave the range of doubles or
 * because there are too many, has none, and is unknown. */
#ifndef FROE_BUILD_CONVERSION_REGION_H
#define FROE_BUILD_CONVERSION_REGION_H
#include "geom/plane.h"

enum { REGION_MOST = 64 };

typedef struct region_corner {
    double x[2];
    uint32_t side; /**< name of the side that leaves this corner */
} region_corner;

typedef struct region {
    uint32_t count; /**< 0: unknown, or nothing */
    region_corner corner[REGION_MOST];
} region;

/** The box, as large again on all sides; all of them have this name. */
void region_around(const double *lo, const double *hi, uint32_t side, region *out);
/** Where a line enters and leaves the region, with the names of the sides there. False: it does not, or is unknown. */
bool region_section(const region *r, const geom_plane *line, region_corner end[2]);
/** The part on side -1 or 1 of a line, which is a side of it by that name. */
void region_clip(const region *r, const geom_plane *line, int which, uint32_t side, region *out);
/** The coordinate by which points of the line are told apart best. */
int region_along(const geom_plane *line);
#endif
