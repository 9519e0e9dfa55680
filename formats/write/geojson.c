/* geojson.c: see geojson.h. */
#include "formats/write/geojson.h"
#include "support/text/geojson.h"

froe_status formats_geojson_check(const froe_scene *scene, const char *path, froe_diagnostic *diag) {
    const froe_crs crs = froe_scene_crs(scene);
    if (support_geojson_names(&crs)) return FROE_OK;
    return support_fail(diag, FROE_E_UNSUPPORTED,
                        "%s: GeoJSON cannot name the coordinate system '%.60s', because it has no code.",
                        support_short(path), crs.name);
}

void formats_geojson_begin(formats_writer *w, const froe_scene *scene) {
    const froe_crs crs = froe_scene_crs(scene);
    formats_put(w, support_geojson_begin(&crs).text);
}
