/* shapes.c: GeoJSON, Wavefront OBJ, and CSV with well-known text (OGC Simple Features). */
#include "formats/write/shapes.h"
#include <string.h>

static void put_attribute(formats_writer *w, const froe_attribute *a,
                          void (*put_text)(formats_writer *, const char *)) {
    if (a->text) {
        put_text(w, a->text);
    } else {
        formats_put_whole(w, a->number);
    }
}

/* --------------------------------------------------------------- GeoJSON -- */

static void geojson_begin(formats_writer *w, const froe_scene *scene, const froe_part *like) {
    (void)like;
    formats_geojson_begin(w, scene);
}

static void geojson_shape(formats_writer *w, const froe_part *s, bool first) {
    static const char *const types[] = {"MultiPoint", "LineString", "Polygon", "Polygon"};
    bool point = s->sort == FROE_PART_POINTS && s->corners == 1, polygon = s->sort == FROE_PART_POLYGON;
    formats_put(w, first ? "\n" : ",\n");
    formats_put(w, "{\"type\":\"Feature\",\"properties\":{");
    for (int i = 0; i < s->attribute_count; ++i) {
        formats_put(w, i ? "," : "");
        formats_put_json(w, s->attributes[i].name);
        formats_put(w, ":");
        if (s->attributes[i].missing) {
            formats_put(w, "null");
        } else {
            put_attribute(w, &s->attributes[i], formats_put_json);
        }
    }
    formats_put(w, "},\"geometry\":");
    formats_put(w, "{\"type\":");
    formats_put_json(w, point ? "Point" : types[s->sort]);
    formats_put(w, ",\"coordinates\":");
    formats_put(w, point ? "" : polygon ? "[[" : "[");
    for (size_t i = 0; i < s->corners; ++i) {
        formats_put(w, i ? ",[" : "[");
        formats_put_point(w, s->coords + i * (size_t)s->dim, s->dim, ",");
        formats_put(w, "]");
    }
    if (polygon) {
        formats_put(w, ",[");
        formats_put_point(w, s->coords, s->dim, ",");
        formats_put(w, "]]");
    }
    formats_put(w, point ? "}" : "]}");
    formats_put(w, "}");
}

/* ------------------------------------------------------------------- OBJ -- */

static void obj_begin(formats_writer *w, const froe_scene *scene, const froe_part *like) {
    (void)scene, (void)like;
    formats_put(w, "# written by froe; group names carry the attributes\n");
}

static void obj_shape(formats_writer *w, const froe_part *s, bool first) {
    (void)first;
    formats_put(w, "g");
    for (int i = 0; i < s->attribute_count; ++i) {
        if (s->attributes[i].missing) continue;
        formats_put(w, " ");
        formats_put_word(w, s->attributes[i].name);
        formats_put(w, "=");
        put_attribute(w, &s->attributes[i], formats_put_word);
    }
    formats_put(w, "\n");
    for (size_t i = 0; i < s->corners; ++i) {
        formats_put(w, "v ");
        formats_put_point(w, s->coords + i * (size_t)s->dim, s->dim, " ");
        formats_put(w, "\n");
    }
    static const char *const words[] = {"p", "l", "f", "f"};
    size_t whole[2] = {0, s->corners};
    const size_t *starts = s->sort == FROE_PART_SURFACE ? s->starts : whole;
    size_t faces = s->sort == FROE_PART_SURFACE ? s->faces : 1;
    for (size_t f = 0; f < faces; ++f) {
        formats_put(w, words[s->sort]);
        for (size_t i = starts[f]; i < starts[f + 1]; ++i) {
            formats_put(w, " -"); /* corners count backwards from the last vertex, so that nothing is remembered */
            formats_put_whole(w, s->corners - i);
        }
        formats_put(w, "\n");
    }
}

/* ------------------------------------------------------------------- CSV -- */

static void wkt_run(formats_writer *w, const froe_part *s, size_t first, size_t end, bool close) {
    formats_put(w, "(");
    for (size_t i = first; i < end; ++i) {
        if (i > first) formats_put(w, ",");
        formats_put_point(w, s->coords + i * (size_t)s->dim, s->dim, " ");
    }
    if (close) {
        formats_put(w, ",");
        formats_put_point(w, s->coords + first * (size_t)s->dim, s->dim, " ");
    }
    formats_put(w, ")");
}

static void csv_begin(formats_writer *w, const froe_scene *scene, const froe_part *like) {
    (void)scene;
    for (int i = 0; i < like->attribute_count; ++i) {
        formats_put_csv(w, like->attributes[i].name);
        formats_put(w, ",");
    }
    formats_put(w, like->dim <= 3 ? "WKT\n" : "corners\n");
}

static void csv_shape(formats_writer *w, const froe_part *s, bool first) {
    static const char *const types[] = {"MULTIPOINT", "LINESTRING", "POLYGON", "POLYHEDRALSURFACE"};
    (void)first;
    for (int i = 0; i < s->attribute_count; ++i) {
        if (!s->attributes[i].missing) put_attribute(w, &s->attributes[i], formats_put_csv);
        formats_put(w, ",");
    }
    formats_put(w, "\"");
    if (s->dim > 3) {
        wkt_run(w, s, 0, s->corners, false);
    } else {
        formats_put(w, s->sort == FROE_PART_POINTS && s->corners == 1 ? "POINT" : types[s->sort]);
        formats_put(w, s->dim == 3 ? " Z " : " ");
        if (s->sort == FROE_PART_POLYGON) formats_put(w, "(");
        if (s->sort != FROE_PART_SURFACE) wkt_run(w, s, 0, s->corners, s->sort == FROE_PART_POLYGON);
        if (s->sort == FROE_PART_POLYGON) formats_put(w, ")");
        for (size_t f = 0; s->sort == FROE_PART_SURFACE && f < s->faces; ++f) {
            formats_put(w, f ? ",(" : "((");
            wkt_run(w, s, s->starts[f], s->starts[f + 1], true);
            formats_put(w, f + 1 < s->faces ? ")" : "))");
        }
    }
    formats_put(w, "\"\n");
}

const formats_shape_file *formats_shape_file_of(const char *path) {
    static const formats_shape_file geojson = {
        2, 2, formats_geojson_check, geojson_begin, geojson_shape, FORMATS_GEOJSON_END};
    static const formats_shape_file obj = {3, 3, NULL, obj_begin, obj_shape, ""};
    static const formats_shape_file csv = {2, FROE_MAX_DIM, NULL, csv_begin, csv_shape, ""};
    support_extension extension = support_path_extension(path);
    if (!strcmp(extension.text, "geojson") || !strcmp(extension.text, "json")) return &geojson;
    if (!strcmp(extension.text, "obj")) return &obj;
    return strcmp(extension.text, "csv") ? NULL : &csv;
}
