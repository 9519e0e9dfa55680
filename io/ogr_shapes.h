/* ogr_shapes.h: geometries of OGR become points and segments. */
#ifndef FROE_IO_OGR_SHAPES_H
#define FROE_IO_OGR_SHAPES_H

#include "formats/input/outline.h"
#include <ogr_api.h>

/** Scratch memory, kept from feature to feature. */
typedef struct io_shapes {
    ARRAY(OGRGeometryH) stack;
    ARRAY(double) points; /**< xy */
    bool cuts;            /**< are whole numbers of the file cut to 64 bits, as json-c does it for OGR? */
    formats_outlines outlines;
} io_shapes;
void io_shapes_free(const froe_allocator *alloc, io_shapes *shapes);

froe_status io_shapes_sides(formats_sink *sink, io_shapes *shapes, OGRGeometryH geometry, formats_sides *sides);

/** Adds all points and segments of a geometry without curves, in order; behind those of each polygon what closes it
 * along the antimeridian. */
froe_status io_shapes_add(formats_sink *sink, io_shapes *shapes, OGRGeometryH geometry, const formats_sides *sides);

#endif
