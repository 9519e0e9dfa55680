/* animated.h: glTF files with animations, written from arrays, and where such a file puts its points: an evaluation of
 * its own, in long double, by sines and matrices. */
#ifndef FROE_TESTS_IO_ANIMATED_H
#define FROE_TESTS_IO_ANIMATED_H
#include "support.h"
#include <math.h>

enum { ANIMATED_NODES = 6, ANIMATED_KEYS = 5 };
enum { STEP, LINEAR, CUBIC };

typedef struct animated_track {
    int count, between; /* keys; 0: none */
    float times[ANIMATED_KEYS];
    float values[3 * ANIMATED_KEYS][4]; /* of CUBIC three a key */
} animated_track;

typedef struct animated_node {
    int parent; /* -1: a root */
    bool mesh;
    bool matrix; /* at rest it is moved by `place` and otherwise by `map`; else by place, turn and scale */
    float place[3], turn[4], scale[3], map[9]; /* map: rows */
    animated_track track[3];                   /* place, turn, scale */
} animated_node;

typedef struct animated_model {
    int nodes;
    animated_node node[ANIMATED_NODES];
    float corners[3][3];
} animated_model;

/* ---------------------------------------------------------------------- the file -- */

typedef struct animated_file {
    unsigned char bytes[1 << 16];
    size_t used;
    char views[1 << 14], accessors[1 << 14];
    int count;
} animated_file;

static inline void animated_say(char *out, size_t room, const char *text, ...) __attribute__((format(printf, 3, 4)));
static inline void animated_say(char *out, size_t room, const char *text, ...) {
    va_list args;
    va_start(args, text);
    const size_t used = strlen(out);
    vsnprintf(out + used, room - used, text, args);
    va_end(args);
}

static inline int animated_accessor(animated_file *f, const void *values, size_t size, int type, const char *kind,
                                    int count) {
    while (f->used % 4) f->bytes[f->used++] = 0;
    memcpy(f->bytes + f->used, values, size);
    const char *comma = f->count ? "," : "";
    animated_say(f->views, sizeof f->views, "%s{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu}", comma, f->used,
                 size);
    animated_say(f->accessors, sizeof f->accessors,
                 "%s{\"bufferView\":%d,\"componentType\":%d,\"count\":%d,\"type\":\"%s\"%s}", comma, f->count, type,
                 count, kind, f->count ? "" : ",\"min\":[-100,-100,-100],\"max\":[100,100,100]");
    f->used += size;
    return f->count++;
}

static inline void animated_base64(const animated_file *f, FILE *out) {
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < f->used; i += 3) {
        unsigned bits = 0;
        for (size_t k = 0; k < 3; k++) bits = bits << 8 | (i + k < f->used ? f->bytes[i + k] : 0u);
        for (size_t k = 0; k < 4; k++) fputc(i + k > f->used ? '=' : digits[bits >> (18 - 6 * k) & 63], out);
    }
}

static inline void animated_numbers(char *out, size_t room, const char *name, const float *at, int count) {
    animated_say(out, room, ",\"%s\":[", name);
    for (int i = 0; i < count; i++) animated_say(out, room, "%s%.17g", i ? "," : "", (double)at[i]);
    animated_say(out, room, "]");
}

typedef struct animated_text {
    char nodes[1 << 14], samplers[1 << 14], channels[1 << 14], roots[256];
    int sampled;
} animated_text;

static inline void animated_put_node(animated_text *t, const animated_model *m, int n) {
    const animated_node *node = m->node + n;
    char *nodes = t->nodes;
    const size_t room = sizeof t->nodes;
    animated_say(nodes, room, "%s{\"name\":\"node %d\"", n ? "," : "", n);
    if (node->mesh) animated_say(nodes, room, ",\"mesh\":0");
    if (node->matrix) { /* columns */
        float all[16] = {[15] = 1};
        for (int i = 0; i < 9; i++) all[i % 3 * 4 + i / 3] = node->map[i];
        for (int i = 0; i < 3; i++) all[12 + i] = node->place[i];
        animated_numbers(nodes, room, "matrix", all, 16);
    } else {
        animated_numbers(nodes, room, "translation", node->place, 3);
        animated_numbers(nodes, room, "rotation", node->turn, 4);
        animated_numbers(nodes, room, "scale", node->scale, 3);
    }
    bool any = false;
    for (int c = n + 1; c < m->nodes; c++) {
        if (m->node[c].parent != n) continue;
        animated_say(nodes, room, "%s%d", any ? "," : ",\"children\":[", c);
        any = true;
    }
    animated_say(nodes, room, any ? "]}" : "}");
    if (node->parent < 0) animated_say(t->roots, sizeof t->roots, "%s%d", *t->roots ? "," : "", n);
}

static inline void animated_put_track(animated_text *t, animated_file *f, const animated_track *track, int n, int k) {
    static const char *const between[] = {"STEP", "LINEAR", "CUBICSPLINE"};
    static const char *const paths[] = {"translation", "rotation", "scale"};
    const int width = k == 1 ? 4 : 3, each = track->between == CUBIC ? 3 : 1, count = track->count;
    const char *comma = t->sampled ? "," : "";
    float values[12 * ANIMATED_KEYS];
    for (int i = 0; i < each * count; i++) memcpy(values + width * i, track->values[i], (size_t)width * sizeof *values);
    const size_t size = (size_t)(width * each * count) * sizeof *values;
    const int input = animated_accessor(f, track->times, (size_t)count * sizeof *track->times, 5126, "SCALAR", count);
    const int output = animated_accessor(f, values, size, 5126, k == 1 ? "VEC4" : "VEC3", each * count);
    animated_say(t->samplers, sizeof t->samplers, "%s{\"input\":%d,\"output\":%d,\"interpolation\":\"%s\"}", comma,
                 input, output, between[track->between]);
    animated_say(t->channels, sizeof t->channels, "%s{\"sampler\":%d,\"target\":{\"node\":%d,\"path\":\"%s\"}}", comma,
                 t->sampled, n, paths[k]);
    t->sampled++;
}

/** Where the bytes are: within the text, in a file beside it, or behind the text in a file of chunks. */
typedef enum animated_container { ANIMATED_WITHIN, ANIMATED_BESIDE, ANIMATED_CHUNKS } animated_container;

static inline void animated_put_word(FILE *out, size_t word) {
    for (int k = 0; k < 4; k++) fputc((int)(word >> 8 * k & 255), out);
}

static inline void animated_put_chunk(FILE *out, const char *name, const void *bytes, size_t size) {
    animated_put_word(out, (size + 3) / 4 * 4);
    fwrite(name, 1, 4, out);
    fwrite(bytes, 1, size, out);
    for (; size % 4; size++) fputc(*name == 'J' ? ' ' : 0, out);
}

/** The file beside is `beside`, which the text calls `uri`. */
static inline void animated_write_as(const animated_model *m, const char *path, animated_container container,
                                     const char *beside, const char *uri) {
    static const unsigned short corners[] = {0, 1, 2};
    static animated_file f;
    static animated_text t;
    memset(&f, 0, sizeof f);
    memset(&t, 0, sizeof t);
    animated_accessor(&f, m->corners, sizeof m->corners, 5126, "VEC3", 3);
    animated_accessor(&f, corners, sizeof corners, 5123, "SCALAR", 3);
    for (int n = 0; n < m->nodes; n++) {
        animated_put_node(&t, m, n);
        for (int k = 0; k < 3; k++)
            if (m->node[n].track[k].count) animated_put_track(&t, &f, m->node[n].track + k, n, k);
    }
    char *text = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&text, &length);
    assert_non_null(out);
    fprintf(out,
            "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[%s]}],\"nodes\":[%s],\"meshes\":[{"
            "\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}],\"animations\":[{\"name\":\"go\","
            "\"samplers\":[%s],\"channels\":[%s]}],\"accessors\":[%s],\"bufferViews\":[%s],\"buffers\":[{"
            "\"byteLength\":%zu",
            t.roots, t.nodes, t.samplers, t.channels, f.accessors, f.views, f.used);
    if (container == ANIMATED_WITHIN) {
        fputs(",\"uri\":\"data:application/octet-stream;base64,", out);
        animated_base64(&f, out);
        fputc('"', out);
    }
    if (container == ANIMATED_BESIDE) fprintf(out, ",\"uri\":\"%s\"", uri);
    fputs("}]}\n", out);
    fclose(out);
    if (container == ANIMATED_BESIDE) write_bytes(beside, f.bytes, f.used);
    out = fopen(path, "wb");
    assert_non_null(out);
    if (container == ANIMATED_CHUNKS) {
        fputs("glTF", out);
        animated_put_word(out, 2);
        animated_put_word(out, 12 + 16 + (length + 3) / 4 * 4 + (f.used + 3) / 4 * 4);
        animated_put_chunk(out, "JSON", text, length);
        animated_put_chunk(out, "BIN", f.bytes, f.used);
    } else {
        fwrite(text, 1, length, out);
    }
    fclose(out);
    free(text);
}

static inline void animated_write(const animated_model *m, const char *path) {
    animated_write_as(m, path, ANIMATED_WITHIN, NULL, NULL);
}

/* --------------------------------------------------------------------- the truth -- */

static inline void animated_slerp(const float *p, const float *q, long double share, long double *out) {
    long double a[4], b[4], dot = 0, pp = 0, qq = 0;
    for (int k = 0; k < 4; k++) pp += (long double)p[k] * p[k], qq += (long double)q[k] * q[k];
    for (int k = 0; k < 4; k++) a[k] = p[k] / sqrtl(pp), b[k] = q[k] / sqrtl(qq), dot += a[k] * b[k];
    const long double sign = dot < 0 ? -1 : 1, angle = acosl(fminl(fabsl(dot), 1)), sine = sinl(angle);
    for (int k = 0; k < 4; k++)
        out[k] = sine < 1e-9L ? a[k] * (1 - share) + sign * b[k] * share
                              : (a[k] * sinl((1 - share) * angle) + sign * b[k] * sinl(share * angle)) / sine;
}

/* A property at a time, just before it where it jumps there and `before` is set. */
static inline void animated_property(const animated_track *t, const float *rest, int width, double time, bool before,
                                     long double *out) {
    int key = 0;
    for (int k = 0; k < width; k++) out[k] = t->count ? (long double)t->values[t->between == CUBIC][k] : rest[k];
    if (!t->count || time < (double)t->times[0]) return;
    while (key + 1 < t->count &&
           (before && t->between == STEP ? (double)t->times[key + 1] < time : (double)t->times[key + 1] <= time))
        key++;
    const int each = t->between == CUBIC ? 3 : 1, middle = each / 2;
    const float *p = t->values[each * key + middle];
    for (int k = 0; k < width; k++) out[k] = p[k];
    if (key + 1 == t->count || t->between == STEP) return;
    const long double step = (long double)t->times[key + 1] - t->times[key],
                      s = (time - (long double)t->times[key]) / step;
    const float *q = t->values[each * (key + 1) + middle];
    if (t->between == LINEAR && width == 4) return animated_slerp(p, q, s, out);
    for (int k = 0; k < width; k++) {
        out[k] = p[k] + s * ((long double)q[k] - p[k]);
        if (t->between == CUBIC)
            out[k] = (2 * s * s * s - 3 * s * s + 1) * p[k] +
                     step * (s * s * s - 2 * s * s + s) * t->values[3 * key + 2][k] +
                     (3 * s * s - 2 * s * s * s) * q[k] + step * (s * s * s - s * s) * t->values[3 * key + 3][k];
    }
}

/* Where a corner of the mesh of a node is. */
static inline void animated_point(const animated_model *m, int n, int corner, double time, bool before,
                                  long double out[3]) {
    long double x[3];
    for (int k = 0; k < 3; k++) x[k] = m->corners[corner][k];
    for (; n >= 0; n = m->node[n].parent) {
        const animated_node *node = m->node + n;
        long double place[3], q[4], scale[3], y[3], map[9], square = 0;
        animated_property(node->track, node->place, 3, time, before, place);
        animated_property(node->track + 1, node->turn, 4, time, before, q);
        animated_property(node->track + 2, node->scale, 3, time, before, scale);
        for (int k = 0; k < 4; k++) square += q[k] * q[k];
        for (int k = 0; k < 4; k++) q[k] /= sqrtl(square);
        const long double turned[9] = {1 - 2 * (q[1] * q[1] + q[2] * q[2]), 2 * (q[0] * q[1] - q[2] * q[3]),
                                       2 * (q[0] * q[2] + q[1] * q[3]),     2 * (q[0] * q[1] + q[2] * q[3]),
                                       1 - 2 * (q[0] * q[0] + q[2] * q[2]), 2 * (q[1] * q[2] - q[0] * q[3]),
                                       2 * (q[0] * q[2] - q[1] * q[3]),     2 * (q[1] * q[2] + q[0] * q[3]),
                                       1 - 2 * (q[0] * q[0] + q[1] * q[1])};
        for (int i = 0; i < 9; i++) map[i] = node->matrix ? (long double)node->map[i] : turned[i] * scale[i % 3];
        for (int k = 0; k < 3; k++) y[k] = map[3 * k] * x[0] + map[3 * k + 1] * x[1] + map[3 * k + 2] * x[2] + place[k];
        memcpy(x, y, sizeof x);
    }
    memcpy(out, x, 3 * sizeof *out);
}
#endif
