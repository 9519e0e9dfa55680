/* geometry.h: the geometry of an answer as GeoJSON (RFC 7946, in the coordinates of the scene).
 *
 *     point, segment, polygon          Point, LineString, Polygon
 *     a segment without length         Point, as for the way to a nearest point and along a ray
 *     box                              Polygon, in space a MultiPolygon of its six faces
 *     ball                             Point, its centre
 *     hull                             MultiPoint, its corners
 *     a pair of objects                GeometryCollection */
#ifndef FROE_CLI_GEOMETRY_H
#define FROE_CLI_GEOMETRY_H
#include "queries/table.h"

void cli_put_geometry(cli_table *table, const cli_answer *answer);
#endif
