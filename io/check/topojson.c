/* topojson.c: whether geometries of a TopoJSON file (version 1.0.0) name arcs that exist. GDAL leaves out others, and
 * so parts of lines and rings. An index below zero stands for an arc that is passed backwards: -1 for the first. It
 * leaves out collections within a collection, and features without a geometry, which are counted.
 *
 *     {"type": "Topology", "objects": {"a": {"type": "LineString", "arcs": [0, -2]}}, "arcs": [[[0, 0], [1, 2]], ...]}
 *
 * A text that is no JSON is left to GDAL. */
#include "check/check.h"
#include <string.h>

static bool has_arcs(const formats_json *value) {
    static const char *const types[] = {"LineString", "MultiLineString", "Polygon", "MultiPolygon"};
    const char *type = formats_json_string(formats_json_get(value, "type"));
    for (size_t i = 0; type && i < sizeof types / sizeof *types; i++)
        if (!strcmp(type, types[i])) return true;
    return false;
}

/* The first value in the arcs of a geometry that is neither an array nor an index of an arc; NULL: there is none. */
static const formats_json *find_no_arc(const formats_json *geometry, double count) {
    const formats_json *arcs = formats_json_get(geometry, "arcs");
    for (size_t i = 0; arcs && i < arcs->span; i++) {
        const double number = arcs[i].number;
        const bool is_index = formats_json_is(arcs + i, FORMATS_JSON_NUMBER) && number >= -count && number < count &&
                              strcspn(arcs[i].text, ".eE") >= strcspn(arcs[i].text, ",] \t\r\n");
        if (!is_index && !formats_json_is(arcs + i, FORMATS_JSON_ARRAY)) return arcs + i;
    }
    return NULL;
}

/* What GDAL leaves out of a collection of features. */
static void count_left(formats_sink *sink, const formats_json *features) {
    static const char collection[] = "GeometryCollection";
    FORMATS_JSON_EACH(feature, features) {
        const char *type = formats_json_string(formats_json_get(feature, "type"));
        const bool nested = type && !strcmp(type, collection);
        const bool placed = formats_json_get(feature, "arcs") || formats_json_get(feature, "coordinates");
        if (nested && formats_json_size(formats_json_get(feature, "geometries")))
            io_leave(sink, collection, strlen(collection));
        else if (!type || !placed)
            sink->report.no_geometry++;
    }
}

static froe_status check_objects(formats_sink *sink, const formats_json *root, const char *layer) {
    bool counted = false; /* the layer that is read: that of the name, or the first */
    const formats_json *objects = formats_json_get(root, "objects");
    if (!objects) return FROE_OK; /* one way: GDAL takes no such file for TopoJSON */
    const formats_json *name = objects + 1;
    const size_t count = formats_json_size(formats_json_get(root, "arcs"));
    for (size_t i = 0; i < objects->count; i++, name = formats_json_next(name + 1)) {
        const formats_json *features = formats_json_get(name + 1, "geometries");
        if (features && !counted && (!layer || !strcmp(name->text, layer))) counted = true, count_left(sink, features);
        for (const formats_json *value = name + 1; value < formats_json_next(name + 1); value++) {
            const formats_json *fault = has_arcs(value) ? find_no_arc(value, (double)count) : NULL;
            if (!fault) continue;
            return support_fail(sink->diag, FROE_E_FORMAT,
                                "%s: object '%.60s': A geometry names arc '%.*s', and there %s %zu of them.",
                                support_short(sink->path), name->text, (int)strcspn(fault->text, ",] \t\r\n"),
                                fault->text, count == 1 ? "is" : "are", count);
        }
    }
    return FROE_OK;
}

froe_status io_topojson_check(const char *path, const char *layer, formats_sink *sink) {
    formats_text text = {0};
    formats_json_values values = {0};
    formats_json_error error;
    froe_status status = io_virtual_load(path, sink, &text);
    if (status == FROE_E_FORMAT) status = support_fail_memory(sink->diag); /* one way: GDAL has read it just now */
    const froe_status read = status ? status : formats_json_read(&sink->alloc, text.data, text.count, &values, &error);
    if (!status && read == FROE_E_MEMORY) status = support_fail_memory(sink->diag);
    if (!read) status = check_objects(sink, values.data, layer);
    array_free(&sink->alloc, &text);
    array_free(&sink->alloc, &values);
    return status;
}
