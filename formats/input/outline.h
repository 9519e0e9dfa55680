/* outline.h: points, lines and polygons of maps become objects of the scene, the same for all readers of maps. */
#ifndef FROE_FORMATS_OUTLINE_H
#define FROE_FORMATS_OUTLINE_H

#include "formats/input/wrap.h"

/** What can be said of a feature before its objects are added. */
typedef struct formats_sides {
    bool polygons;    /**< it has rings */
    bool left, right; /**< the interior is on this side of every ring; both false: it differs, or no rings */
} formats_sides;

/** How outlines are added, and scratch memory, kept from feature to feature. */
typedef struct formats_outlines {
    bool wrap;              /**< set by the owner: what crosses the antimeridian is cut there */
    bool wrapped;           /**< something was, since the owner set this to false */
    formats_wrap_cuts cuts; /**< of the line or polygon at hand */
    ARRAY(double) points;   /**< a ring that is changed */
} formats_outlines;
void formats_outlines_free(const froe_allocator *alloc, formats_outlines *outlines);

/** Sides of no ring yet. */
formats_sides formats_sides_begin(void);
/** Takes a ring into account: `count` points xy, of which the last may repeat the first. A hole has the interior
 * outside. FROE_E_MEMORY. */
froe_status formats_sides_add(formats_sink *sink, formats_outlines *outlines, const double *xy, size_t count, bool hole,
                              formats_sides *sides);
/** No ring will come: where there was none, no side is named. */
void formats_sides_end(formats_sides *sides);

/** What a feature is called by. No string is NULL. */
typedef struct formats_feature_names {
    const char *name, *id; /**< its name; what stands for one that is empty; where both are, its number does */
    int64_t number;
    const char *material;
} formats_feature_names;
/** Every feature that has polygons or a name is a group. The interior of its rings is named where it is on one side of
 * all of them. FROE_E_MEMORY, FROE_E_LIMIT. */
froe_status formats_feature_group(formats_sink *sink, const formats_feature_names *names, const formats_sides *sides);

froe_status formats_outline_point(formats_sink *sink, const formats_outlines *outlines, const double *xy);
/** The segments of a line, or of a ring, which is closed where it is open. Less than two points: counted as skipped. */
froe_status formats_outline_line(formats_sink *sink, formats_outlines *outlines, const double *xy, size_t count,
                                 bool ring);
/** After a line, or after all rings of a polygon, of which `sides` is not NULL: adds what closes it along the
 * antimeridian. */
froe_status formats_outline_end(formats_sink *sink, formats_outlines *outlines, const formats_sides *sides);

#endif
