/* fuzz_import.c: files for GDAL and assimp, written from bytes so that these libraries take them. What comes back from
 * the libraries is what froe has to cope with: maps as GeoJSON with geometries of every type, right and nearly so, and
 * models as glTF with nodes, animations and numbers of any kind. */
#include "support.h"
#include <froe/io.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_TEXT = 1 << 16, FLOATS = 96, MOST_NODES = 5, MOST_CHANNELS = 4 };

typedef struct written {
    fuzz_bytes bytes;
    size_t size;
    char text[MOST_TEXT];
} written;

static void put(written *w, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void put(written *w, const char *format, ...) {
    va_list list;
    va_start(list, format);
    const int count = vsnprintf(w->text + w->size, MOST_TEXT - w->size, format, list);
    va_end(list);
    if (count > 0) w->size += (size_t)count < MOST_TEXT - w->size ? (size_t)count : MOST_TEXT - w->size - 1;
}

static int any(written *w, int most) {
    return fuzz_byte(&w->bytes) % (most + 1);
}

static void put_number(written *w) {
    const double x = fuzz_double(&w->bytes);
    put(w, isfinite(x) ? "%.17g" : "null", x);
}

/* -------------------------------------------------------------------- maps -- */

static void put_position(written *w) {
    const int axes = any(w, 7) ? 2 : any(w, 4);
    put(w, "[");
    for (int k = 0; k < axes; k++) {
        if (k) put(w, ",");
        put_number(w);
    }
    put(w, "]");
}

static void put_line(written *w, bool ring) {
    const int count = any(w, 5);
    put(w, "[");
    const size_t first = w->size;
    put_position(w);
    const int length = (int)(w->size - first);
    for (int i = 0; i < count; i++) {
        put(w, ",");
        put_position(w);
    }
    if (ring && any(w, 7)) put(w, ",%.*s", length, w->text + first);
    put(w, "]");
}

static void put_lines(written *w, bool rings) {
    put(w, "[");
    for (int i = any(w, 2); i >= 0; i--) {
        put_line(w, rings);
        if (i) put(w, ",");
    }
    put(w, "]");
}

static void put_geometry(written *w) {
    static const char *const types[] = {"Point",      "LineString",      "Polygon",
                                        "MultiPoint", "MultiLineString", "MultiPolygon"};
    const int type = any(w, 5), shape = any(w, 15) ? type : any(w, 5); /* now and then that of another type */
    put(w, "{\"type\":\"%s\",\"coordinates\":", types[type]);
    if (shape == 0) put_position(w);
    if (shape == 1 || shape == 3) put_line(w, false);
    if (shape == 2 || shape == 4) put_lines(w, shape == 2);
    if (shape == 5) {
        put(w, "[");
        put_lines(w, true);
        if (any(w, 1)) put(w, ","), put_lines(w, true);
        put(w, "]");
    }
    put(w, "}");
}

static void put_map(written *w) {
    put(w, "{\"type\":\"FeatureCollection\",\"name\":\"l\",\"features\":[");
    for (int i = any(w, 5); i >= 0; i--) {
        put(w, "{\"type\":\"Feature\",\"properties\":{\"name\":\"%c\",\"n\":", 'a' + any(w, 3));
        put_number(w);
        put(w, "},\"geometry\":");
        const int what = any(w, 15);
        if (what == 0) put(w, "null");
        if (what == 1) put(w, "{\"type\":\"GeometryCollection\",\"geometries\":["), put_geometry(w), put(w, "]}");
        if (what > 1) put_geometry(w);
        put(w, i ? "}," : "}");
    }
    put(w, "]}");
}

static void read_map(const char *path, const written *w) {
    froe_read_options o = froe_read_defaults();
    froe_scene *scene;
    froe_read_report report;
    froe_diagnostic why;
    o.layer = "l"; /* by GDAL, not by froe's own reader */
    o.boxes = w->size % 3 == 0;
    const froe_status status = froe_read(path, &o, &scene, &report, &why);
    if (status == FROE_OK) froe_scene_free(scene);
    if (status && !memchr(why.message, '.', sizeof why.message)) fuzz_complain("no sentence", &why);
}

/* ------------------------------------------------------------------ models -- */

/* A square, times from 0 on, and any numbers, as base64 (RFC 4648). */
static void put_floats(written *w) {
    static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    static const float square[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0};
    float x[FLOATS];
    unsigned char raw[sizeof x];
    for (int i = 0; i < FLOATS; i++) {
        const double value = fuzz_double(&w->bytes);
        x[i] = i < 18 ? square[i] : i < 24 ? (float)(i - 18) : fabs(value) < 1e30 ? (float)value : 0;
    }
    for (int i = 28; i + 4 <= FLOATS && any(w, 3); i += 4) x[i] = 0, x[i + 1] = 0, x[i + 2] = 0.6f, x[i + 3] = 0.8f;
    memcpy(raw, x, sizeof raw);
    for (size_t i = 0; i < sizeof raw; i += 3) {
        const unsigned word = (unsigned)raw[i] << 16 | (unsigned)raw[i + 1] << 8 | raw[i + 2];
        put(w, "%c%c%c%c", letters[word >> 18], letters[word >> 12 & 63], letters[word >> 6 & 63], letters[word & 63]);
    }
}

static void put_triple(written *w, const char *name, int count) {
    put(w, ",\"%s\":[", name);
    for (int i = 0; i < count; i++) {
        if (i) put(w, ",");
        put_number(w);
    }
    put(w, "]");
}

/* Children come after their parents, each once: assimp does not bear circles. */
static void put_nodes(written *w, int count) {
    int next = 1;
    put(w, "\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[");
    for (int i = 0; i < count; i++) {
        put(w, "%s{\"name\":\"n%d\"", i ? "," : "", i);
        if (any(w, 3)) put(w, ",\"mesh\":0");
        if (!any(w, 3)) put_triple(w, "translation", 3);
        if (!any(w, 3)) put(w, ",\"rotation\":[0,0.6,0,0.8]");
        if (!any(w, 7)) put_triple(w, "scale", 3);
        const int last = any(w, 1) ? next + 1 : count; /* at least the next node, so that none is left out */
        if (next < count && next == i + 1) {
            put(w, ",\"children\":[%d", next++);
            while (next < last && next < count) put(w, ",%d", next++);
            put(w, "]");
        }
        put(w, "}");
    }
    put(w, "],");
}

/* Assimp reads a value for each instant, and three where the way is a spline, however many there are. So there are
 * never too few. */
static void put_animation(written *w, int nodes, bool splines) {
    static const char *const paths[] = {"translation", "rotation", "scale", "weights"};
    static const char *const ways[] = {"LINEAR", "STEP", "CUBICSPLINE"};
    const int channels = 1 + any(w, MOST_CHANNELS - 1);
    put(w, "\"animations\":[{\"channels\":[");
    for (int i = 0; i < channels; i++)
        put(w, "%s{\"sampler\":%d,\"target\":{\"node\":%d,\"path\":\"%s\"}}", i ? "," : "", any(w, channels - 1),
            any(w, nodes - 1), paths[any(w, 15) ? any(w, 1) : any(w, 3)]);
    put(w, "],\"samplers\":[");
    for (int i = 0; i < channels; i++)
        put(w, "%s{\"input\":1,\"output\":%d,\"interpolation\":\"%s\"}", i ? "," : "", 2 + any(w, 2),
            ways[any(w, splines ? 2 : 1)]);
    put(w, "]}],");
}

static void put_model(written *w) {
    const int nodes = 1 + any(w, MOST_NODES - 1), keys = 1 + any(w, 4);
    const bool splines = any(w, 2) == 0;
    const int values = keys * (splines ? 3 : 1);
    put(w, "{\"asset\":{\"version\":\"2.0\"},");
    put_nodes(w, nodes);
    put_animation(w, nodes, splines);
    put(w, "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"accessors\":[");
    put(w, "{\"bufferView\":0,\"componentType\":5126,\"count\":6,\"type\":\"VEC3\",\"min\":[0,0,0],\"max\":[1,1,0]},");
    put(w, "{\"bufferView\":1,\"componentType\":5126,\"count\":%d,\"type\":\"SCALAR\"},", keys);
    put(w, "{\"bufferView\":2,\"componentType\":5126,\"count\":%d,\"type\":\"VEC3\"},", values);
    put(w, "{\"bufferView\":2,\"componentType\":5126,\"count\":%d,\"type\":\"VEC4\"},", values);
    put(w, "{\"bufferView\":%d,\"componentType\":%d,\"count\":%d,\"type\":\"VEC4\"}],", any(w, 3), 5120 + any(w, 6),
        values + any(w, 20));
    put(w, "\"bufferViews\":[{\"buffer\":0,\"byteLength\":72},{\"buffer\":0,\"byteOffset\":72,\"byteLength\":24},");
    put(w, "{\"buffer\":0,\"byteOffset\":112,\"byteLength\":%zu}],", sizeof(float) * FLOATS - 112);
    put(w, "\"buffers\":[{\"byteLength\":%zu,\"uri\":\"data:application/octet-stream;base64,", sizeof(float) * FLOATS);
    put_floats(w);
    put(w, "\"}]}");
}

static void read_model(const char *path) {
    froe_motion_read_options o = froe_motion_read_defaults();
    froe_motion *motion;
    froe_diagnostic why;
    froe_scene *scene;
    if (froe_read(path, NULL, &scene, NULL, &why) == FROE_OK) froe_scene_free(scene);
    const froe_status status = froe_read_animation(path, &o, &motion, NULL, &why);
    if (status == FROE_OK) {
        const froe_motion_options window = froe_motion_window(motion);
        if (!(window.begin < window.end) || !froe_motion_object_count(motion)) fuzz_complain("an empty motion", &why);
        froe_motion_free(motion);
    } else if (!memchr(why.message, '.', sizeof why.message)) {
        fuzz_complain("no sentence", &why);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    written *w = calloc(1, sizeof *w);
    char path[256];
    if (!w) return 0;
    w->bytes = (fuzz_bytes){data, size};
    const bool map = any(w, 1);
    if (map)
        put_map(w);
    else
        put_model(w);
    fuzz_file("", map ? ".geojson" : ".gltf", (const uint8_t *)w->text, w->size, path, sizeof path);
    if (map)
        read_map(path, w);
    else
        read_model(path);
    remove(path);
    free(w);
    return 0;
}
