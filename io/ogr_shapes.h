/* ogr_shapes.h: geometries of OGR become points and segments. */
#ifndef FROE_IO_OGR_SHAPES_H
#define FROE_IO_OGR_SHAPES_H

#include "wrap.h"
#include <ogr_api.h>

/** Scratch memory, kept from feature to feature. */
typedef struct io_shapes {
    ARRAY(OGRGeometryH) stack;
    ARRAY(double) points; /**< xy */
    bool wrap;            /**< set by the owner: what crosses the antimeridian is cut there */
    bool wrapped;         /**< something of the last geometry was */
    io_wrap_cuts cuts;    /**< of the polygon at hand */
} io_shapes;
void io_shapes_free(const froe_allocator *alloc, io_shapes *shapes);

/** What can be said of a geometry before its objects are added. */
typedef struct io_sides {
    bool polygons;    /**< it has rings */
    bool left, right; /**< the interior is on this side of every ring; both false: it differs, or no rings */
} io_sides;
froe_status io_shapes_sides(formats_sink *sink, io_shapes *shapes, OGRGeometryH geometry, io_sides *sides);

/** Adds all points and segments of a geometry without curves, in order; behind those of each polygon what closes it
 * along the antimeridian. */
froe_status io_shapes_add(formats_sink *sink, io_shapes *shapes, OGRGeometryH geometry, const io_sides *sides);

#endif
