/* geojson_shapes.h: the geometry of a feature of GeoJSON (RFC 7946, section 3.1) as points, rings and parts, before it
 * is known what the feature is called. */
#ifndef FROE_FORMATS_GEOJSON_SHAPES_H
#define FROE_FORMATS_GEOJSON_SHAPES_H
#include "support/array.h"

typedef enum geojson_kind { GEOJSON_POINTS, GEOJSON_LINE, GEOJSON_AREA } geojson_kind;

/** Points, a line, or a polygon with its holes. */
typedef struct geojson_part {
    geojson_kind kind;
    size_t end; /**< behind its last ring; points and lines are one ring */
} geojson_part;

/** The parts of a geometry in the order of the file, those of collections, too. */
typedef struct geojson_shapes {
    ARRAY(double) points; /**< xy */
    ARRAY(size_t) rings;  /**< behind the last number of each */
    ARRAY(size_t) areas;  /**< behind the last ring of each, while coordinates are read */
    ARRAY(geojson_part) parts;
} geojson_shapes;
void geojson_shapes_free(const froe_allocator *alloc, geojson_shapes *shapes);
/** Reads the geometry object that stands at *at, behind its brace, in place of the one before. FROE_E_UNSUPPORTED: it
 * is not of this form, or has positions of other than two numbers, empty arrays, or collections within collections
 * beyond the sixteenth. FROE_E_MEMORY. */
froe_status geojson_shapes_read(const froe_allocator *alloc, char **at, geojson_shapes *shapes);

#endif
