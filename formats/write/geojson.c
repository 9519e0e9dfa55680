/* geojson.c: see geojson.h. */
#include "formats/write/geojson.h"
#include <stdio.h>
#include <string.h>

static bool is_wgs84(const froe_crs *crs) {
    return crs->kind == FROE_CRS_GEOGRAPHIC && (!strcmp(crs->code, "EPSG:4326") || !strcmp(crs->code, "OGC:CRS84"));
}

froe_status formats_geojson_check(const froe_scene *scene, const char *path, froe_diagnostic *diag) {
    const froe_crs crs = froe_scene_crs(scene);
    if (!crs.kind || strchr(crs.code, ':')) return FROE_OK;
    return support_fail(diag, FROE_E_UNSUPPORTED,
                        "%s: GeoJSON cannot name the coordinate system '%.60s', because it has no code.",
                        support_short(path), crs.name);
}

void formats_geojson_begin(formats_writer *w, const froe_scene *scene) {
    const froe_crs crs = froe_scene_crs(scene);
    const char *colon = strchr(crs.code, ':');
    formats_put(w, "{\"type\":\"FeatureCollection\",");
    if (!crs.kind) {
        formats_put(w, "\"crs\":null,");
    } else if (!is_wgs84(&crs) && colon) { /* a name as of OGC 09-048r5: EPSG's codes need no version, OGC's own do */
        char name[128];
        snprintf(name, sizeof name, "urn:ogc:def:crs:%.*s:%s:%s", (int)(colon - crs.code), crs.code,
                 strncmp(crs.code, "OGC:", 4) != 0 ? "" : "1.3", colon + 1);
        formats_put(w, "\"crs\":{\"type\":\"name\",\"properties\":{\"name\":");
        formats_put_json(w, name);
        formats_put(w, "}},");
    }
    formats_put(w, "\"features\":[");
}
