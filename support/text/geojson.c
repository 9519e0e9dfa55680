/* geojson.c: see geojson.h. */
#include "support/text/geojson.h"
#include "support/escape.h"
#include <stdio.h>
#include <string.h>

static bool is_wgs84(const froe_crs *crs) {
    return crs->kind == FROE_CRS_GEOGRAPHIC && (!strcmp(crs->code, "EPSG:4326") || !strcmp(crs->code, "OGC:CRS84"));
}

bool support_geojson_names(const froe_crs *crs) {
    return !crs->kind || strchr(crs->code, ':');
}

/* A name as of OGC 09-048r5: EPSG's codes need no version, OGC's own do. */
support_geojson support_geojson_begin(const froe_crs *crs) {
    char name[128], code[256], *to = code;
    const char *colon = strchr(crs->code, ':'), *at = name;
    support_geojson out = {"{\"type\":\"FeatureCollection\",\"crs\":null,\"features\":["};
    if (!crs->kind) return out;
    snprintf(out.text, sizeof out.text, "{\"type\":\"FeatureCollection\",\"features\":[");
    if (is_wgs84(crs) || !colon) return out;
    snprintf(name, sizeof name, "urn:ogc:def:crs:%.*s:%s:%s", (int)(colon - crs->code), crs->code,
             strncmp(crs->code, "OGC:", 4) != 0 ? "" : "1.3", colon + 1);
    for (size_t n; (size_t)(to - code) + 9 < sizeof code && (n = support_json_escape(&at, to)) > 0;) to += n;
    *to = '\0';
    snprintf(
        out.text, sizeof out.text,
        "{\"type\":\"FeatureCollection\",\"crs\":{\"type\":\"name\",\"properties\":{\"name\":\"%s\"}},\"features\":[",
        code);
    return out;
}
