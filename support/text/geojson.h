/* geojson.h: which coordinate system a GeoJSON file is in.
 *
 * RFC 7946 knows longitudes and latitudes of WGS 84 alone. The specification of 2008, which GDAL and QGIS follow where
 * they have to, has a member `crs` for other systems, by their codes; null says that nothing is known. */
#ifndef FROE_SUPPORT_TEXT_GEOJSON_H
#define FROE_SUPPORT_TEXT_GEOJSON_H
#include <froe/froe.h>

/** How a collection of features begins, up to the bracket before the first. */
typedef struct support_geojson {
    char text[400];
} support_geojson;
support_geojson support_geojson_begin(const froe_crs *crs);
/** Can GeoJSON name the system? It has a code, or nothing is known. */
bool support_geojson_names(const froe_crs *crs);
#endif
