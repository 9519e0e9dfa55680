/* scenes.h: files made on the spot, scenes read back by FROE_TEST_READ, and the set of their objects. */
#ifndef FROE_TESTS_SUPPORT_SCENES_H
#define FROE_TESTS_SUPPORT_SCENES_H
#include "support/memory.h"

#include <froe/formats.h>
#include <stdio.h>
#include <string.h>

#ifndef FROE_TEST_READ
#define FROE_TEST_READ froe_read_own
#endif

static inline void write_bytes(const char *path, const void *bytes, size_t size) {
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

static inline void write_text(const char *path, const char *text) {
    write_bytes(path, text, strlen(text));
}

/** Reads what must be readable. `report` may be NULL. */
static inline froe_scene *read_with(const char *path, const froe_read_options *options, froe_read_report *report) {
    froe_scene *scene = NULL;
    froe_diagnostic why;
    if (FROE_TEST_READ(path, options, &scene, report, &why)) fail_msg("%s", why.message);
    return scene;
}

static inline froe_scene *read_scene(const char *path, froe_read_report *report) {
    return read_with(path, NULL, report);
}

/** Reads what must be refused, with a status and words of the message. */
static inline void refuse_with(const char *path, const froe_read_options *options, froe_status expected,
                               const char *words) {
    froe_scene *scene = NULL;
    froe_diagnostic why = {.message = ""};
    froe_read_report report = {.features = 4711};
    froe_status status = FROE_TEST_READ(path, options, &scene, &report, &why);
    if (status != expected || !strstr(why.message, words))
        fail_msg("%s: expected %s '%s', got %s '%s'", path, froe_status_name(expected), words, froe_status_name(status),
                 status ? why.message : "");
    assert_null(scene);
    assert_int_equal(report.features, 4711);
    assert_int_equal(why.status, expected);
}

static inline void refuse(const char *path, froe_status expected, const char *words) {
    refuse_with(path, NULL, expected, words);
}

static inline const double *corner(const froe_scene *scene, uint32_t object, uint32_t at) {
    return froe_scene_vertex(scene, froe_scene_corner(scene, object, at));
}

/** Every kind, form, corner, radius and tag, in order: equal for equal scenes, whatever their vertex ids. */
static inline uint64_t scene_hash(const froe_scene *scene) {
    uint64_t hash = 14695981039346656037u; /* FNV-1a over words, stirred */
    const size_t objects = froe_scene_object_count(scene);
    const int dim = froe_scene_dim(scene);
    for (uint32_t i = 0; i < objects; i++) {
        const froe_object o = froe_scene_object(scene, i);
        hash = (hash ^ (uint64_t)(o.kind * 64 + o.form)) * 1099511628211u;
        for (uint32_t c = 0; c < o.corners; c++)
            for (int k = 0; k < dim; k++) {
                uint64_t bits;
                memcpy(&bits, &corner(scene, i, c)[k], sizeof bits);
                hash = (hash ^ bits) * 1099511628211u;
                hash ^= hash >> 29;
            }
        uint64_t radius;
        memcpy(&radius, &o.radius, sizeof radius);
        hash = (hash ^ radius) * 1099511628211u;
    }
    return hash;
}

/** A segment or its reverse, with the smaller end first. */
typedef struct edge {
    double at[4];
} edge;

static inline int compare_edges(const void *a, const void *b) {
    for (int i = 0; i < 4; i++) {
        double x = ((const edge *)a)->at[i], y = ((const edge *)b)->at[i];
        if (x != y) return x < y ? -1 : 1;
    }
    return 0;
}

static inline edge edge_of(const froe_scene *scene, uint32_t object) {
    const double *a = corner(scene, object, 0),
                 *b = corner(scene, object, froe_scene_object(scene, object).corners - 1);
    if (a[0] > b[0] || (a[0] == b[0] && a[1] > b[1])) {
        const double *swap = a;
        a = b;
        b = swap;
    }
    return (edge){{a[0], a[1], b[0], b[1]}};
}

/** Number of distinct segments of a plane scene, direction apart; those without length do not count. */
static inline size_t distinct_edges(const froe_scene *scene) {
    size_t count = froe_scene_object_count(scene), distinct = 0;
    edge *edges = malloc((count + 1) * sizeof *edges);
    assert_non_null(edges);
    size_t kept = 0;
    for (uint32_t i = 0; i < count; i++)
        if (froe_scene_object(scene, i).form == FROE_SEGMENT) edges[kept++] = edge_of(scene, i);
    qsort(edges, kept, sizeof *edges, compare_edges);
    for (size_t i = 0; i < kept; i++) distinct += !i || compare_edges(&edges[i - 1], &edges[i]);
    free(edges);
    return distinct;
}
#endif
