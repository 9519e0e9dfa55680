/* format.c: GeoJSON (RFC 7946, without its axis: froe's plane is no globe), Wavefront
 * OBJ, and CSV with well-known text (OGC Simple Features). */
#include "format.h"
#include <string.h>

static void put_attribute(io_writer *w, const io_attribute *a, void (*put_text)(io_writer *, const char *)) {
    if (a->text) {
        put_text(w, a->text);
    } else {
        io_put_whole(w, a->number);
    }
}

/* --------------------------------------------------------------- GeoJSON -- */

static void geojson_positions(io_writer *w, const io_shape *s) {
    for (size_t i = 0; i < s->corners; ++i) {
        io_put(w, i ? ",[" : "[");
        io_put_point(w, s->coords + i * (size_t)s->dim, s->dim, ",");
        io_put(w, "]");
    }
}

static void geojson_geometry(io_writer *w, const io_shape *s) {
    static const char *const types[] = {"MultiPoint", "LineString", "Polygon", "Polygon"};
    bool point = s->sort == IO_POINTS && s->corners == 1, polygon = s->sort == IO_POLYGON;
    io_put(w, "{\"type\":");
    io_put_json(w, point ? "Point" : types[s->sort]);
    io_put(w, ",\"coordinates\":");
    io_put(w, point ? "" : polygon ? "[[" : "[");
    geojson_positions(w, s);
    if (polygon) {
        io_put(w, ",[");
        io_put_point(w, s->coords, s->dim, ",");
        io_put(w, "]]");
    }
    io_put(w, point ? "}" : "]}");
}

static void geojson_begin(io_writer *w, const io_shape *like) {
    (void)like;
    io_put(w, "{\"type\":\"FeatureCollection\",\"features\":[");
}

static void geojson_shape(io_writer *w, const io_shape *s, bool first) {
    io_put(w, first ? "\n" : ",\n");
    io_put(w, "{\"type\":\"Feature\",\"properties\":{");
    for (int i = 0; i < s->attribute_count; ++i) {
        io_put(w, i ? "," : "");
        io_put_json(w, s->attributes[i].name);
        io_put(w, ":");
        if (s->attributes[i].missing) {
            io_put(w, "null");
        } else {
            put_attribute(w, &s->attributes[i], io_put_json);
        }
    }
    io_put(w, "},\"geometry\":");
    geojson_geometry(w, s);
    io_put(w, "}");
}

static void geojson_end(io_writer *w) {
    io_put(w, "\n]}\n");
}

/* ------------------------------------------------------------------- OBJ -- */

/* Corners count backwards from the last vertex, so that nothing needs to be remembered. */
static void obj_element(io_writer *w, const char *word, size_t first, size_t end, size_t corners) {
    io_put(w, word);
    for (size_t i = first; i < end; ++i) {
        io_put(w, " -");
        io_put_whole(w, corners - i);
    }
    io_put(w, "\n");
}

static void obj_begin(io_writer *w, const io_shape *like) {
    (void)like;
    io_put(w, "# written by froe; group names carry the attributes\n");
}

static void obj_shape(io_writer *w, const io_shape *s, bool first) {
    (void)first;
    io_put(w, "g");
    for (int i = 0; i < s->attribute_count; ++i) {
        if (s->attributes[i].missing) continue;
        io_put(w, " ");
        io_put_word(w, s->attributes[i].name);
        io_put(w, "=");
        put_attribute(w, &s->attributes[i], io_put_word);
    }
    io_put(w, "\n");
    for (size_t i = 0; i < s->corners; ++i) {
        io_put(w, "v ");
        io_put_point(w, s->coords + i * (size_t)s->dim, s->dim, " ");
        io_put(w, "\n");
    }
    static const char *const words[] = {"p", "l", "f", "f"};
    size_t whole[2] = {0, s->corners};
    const size_t *starts = s->sort == IO_SURFACE ? s->starts : whole;
    size_t faces = s->sort == IO_SURFACE ? s->faces : 1;
    for (size_t f = 0; f < faces; ++f) obj_element(w, words[s->sort], starts[f], starts[f + 1], s->corners);
}

static void obj_end(io_writer *w) {
    (void)w;
}

/* ------------------------------------------------------------------- CSV -- */

static void wkt_run(io_writer *w, const io_shape *s, size_t first, size_t end, bool close) {
    io_put(w, "(");
    for (size_t i = first; i < end; ++i) {
        if (i > first) io_put(w, ",");
        io_put_point(w, s->coords + i * (size_t)s->dim, s->dim, " ");
    }
    if (close) {
        io_put(w, ",");
        io_put_point(w, s->coords + first * (size_t)s->dim, s->dim, " ");
    }
    io_put(w, ")");
}

static void wkt(io_writer *w, const io_shape *s) {
    static const char *const types[] = {"MULTIPOINT", "LINESTRING", "POLYGON", "POLYHEDRALSURFACE"};
    io_put(w, s->sort == IO_POINTS && s->corners == 1 ? "POINT" : types[s->sort]);
    io_put(w, s->dim == 3 ? " Z " : " ");
    if (s->sort == IO_POLYGON) io_put(w, "(");
    if (s->sort != IO_SURFACE) wkt_run(w, s, 0, s->corners, s->sort == IO_POLYGON);
    if (s->sort == IO_POLYGON) io_put(w, ")");
    for (size_t f = 0; s->sort == IO_SURFACE && f < s->faces; ++f) {
        io_put(w, f ? ",(" : "((");
        wkt_run(w, s, s->starts[f], s->starts[f + 1], true);
        io_put(w, f + 1 < s->faces ? ")" : "))");
    }
}

static void csv_begin(io_writer *w, const io_shape *like) {
    for (int i = 0; i < like->attribute_count; ++i) {
        io_put_csv(w, like->attributes[i].name);
        io_put(w, ",");
    }
    io_put(w, like->dim <= 3 ? "WKT\n" : "corners\n");
}

static void csv_shape(io_writer *w, const io_shape *s, bool first) {
    (void)first;
    for (int i = 0; i < s->attribute_count; ++i) {
        if (!s->attributes[i].missing) put_attribute(w, &s->attributes[i], io_put_csv);
        io_put(w, ",");
    }
    io_put(w, "\"");
    if (s->dim <= 3) {
        wkt(w, s);
    } else {
        wkt_run(w, s, 0, s->corners, false);
    }
    io_put(w, "\"\n");
}

static void csv_end(io_writer *w) {
    (void)w;
}

const io_format *io_format_of(const char *path) {
    static const io_format geojson = {"GeoJSON", 2, 2, geojson_begin, geojson_shape, geojson_end};
    static const io_format obj = {"OBJ", 3, 3, obj_begin, obj_shape, obj_end};
    static const io_format csv = {"CSV", 2, FROE_MAX_DIM, csv_begin, csv_shape, csv_end};
    io_extension extension = io_path_extension(path);
    if (!strcmp(extension.text, "geojson") || !strcmp(extension.text, "json")) return &geojson;
    if (!strcmp(extension.text, "obj")) return &obj;
    return strcmp(extension.text, "csv") ? NULL : &csv;
}
