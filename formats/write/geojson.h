/* geojson.h: how a GeoJSON file of a scene begins and ends (support/text/geojson.h). */
#ifndef FROE_FORMATS_GEOJSON_H
#define FROE_FORMATS_GEOJSON_H

#include "formats/write/writer.h"

/** Can GeoJSON name the coordinate system of a scene? FROE_E_UNSUPPORTED: it has no code. */
froe_status formats_geojson_check(const froe_scene *scene, const char *path, froe_diagnostic *diag);
/** The beginning of a collection of features, up to the bracket before the first. */
void formats_geojson_begin(formats_writer *writer, const froe_scene *scene);
/** What ends it. */
#define FORMATS_GEOJSON_END "\n]}\n"

#endif
