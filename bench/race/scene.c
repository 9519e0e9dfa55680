/* scene.c: the scenes of a race: points and boxes here, others by their makers. */
#include "bench.h"
#include "race.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

size_t race_corners(peer_kind kind) {
    static const size_t corners[PEER_KINDS] = {1, 2, 2, 3, 2, 2};
    return corners[kind];
}

void race_direction(uint64_t *state, double d[3]) {
    const double z = 2 * bench_unit(state) - 1, a = 6.283185307179586 * bench_unit(state), r = sqrt(1 - z * z);
    d[0] = r * cos(a), d[1] = r * sin(a), d[2] = z;
}

/* Anywhere in the unit square ("plane") or cube ("space"). */
static void make_points(race_scene *scene, const char *name, size_t n, uint64_t *state) {
    const int dim = !strcmp(name, "space") ? 3 : 2;
    scene->data.count = n, scene->data.dim = dim;
    scene->coords = bench_take(n * (size_t)dim, sizeof *scene->coords);
    for (size_t i = 0; i < n * (size_t)dim; i++) scene->coords[i] = bench_unit(state);
    scene->near = true;
}

/* Boxes of a kind of froe_generate(). */
static void make_boxes(race_scene *scene, const char *name, size_t n) {
    froe_scene *s = bench_generate(name, n, 1);
    const size_t dim = (size_t)froe_scene_dim(s);
    scene->data.count = froe_scene_object_count(s), scene->data.dim = (int)dim;
    scene->coords = bench_take(scene->data.count * 2 * dim, sizeof *scene->coords);
    for (uint32_t i = 0; i < scene->data.count; i++)
        for (uint32_t c = 0; c < 2; c++)
            memcpy(scene->coords + (2 * (size_t)i + c) * dim, froe_scene_vertex(s, froe_scene_corner(s, i, c)),
                   dim * sizeof *scene->coords);
    scene->near = true;
    froe_scene_free(s);
}

static void find_bounds(race_scene *scene) {
    const size_t dim = (size_t)scene->data.dim, count = scene->data.count * race_corners(scene->data.kind);
    for (size_t k = 0; k < dim; k++) {
        scene->lo[k] = INFINITY, scene->hi[k] = -(double)INFINITY;
        for (size_t i = 0; i < count; i++) {
            scene->lo[k] = fmin(scene->lo[k], scene->coords[i * dim + k]);
            scene->hi[k] = fmax(scene->hi[k], scene->coords[i * dim + k]);
        }
        scene->size = fmax(scene->size, scene->hi[k] - scene->lo[k]);
    }
}

race_scene race_scene_make(peer_kind kind, const char *name, size_t n) {
    race_scene scene = {.size = 0};
    uint64_t state = bench_state((uint64_t)1 << 40);
    bench_name(name, scene.name);
    if (kind == PEER_POINTS) make_points(&scene, name, n, &state);
    if (kind == PEER_SEGMENTS || kind == PEER_TRAPEZOIDS) race_make_segments(&scene, name, n, &state);
    if (kind == PEER_TRIANGLES) race_make_triangles(&scene, name, n, &state);
    if (kind == PEER_BOXES) make_boxes(&scene, name, n);
    if (kind == PEER_AREAS) race_make_areas(&scene, name, n, &state);
    scene.data.kind = kind;
    find_bounds(&scene);
    return scene;
}

peer_data race_data(const race_scene *scene) {
    peer_data data = scene->data;
    data.coords = scene->coords, data.groups = scene->groups, data.faces = scene->faces;
    if (data.kind == PEER_AREAS) data.map = &scene->map;
    return data;
}

void race_scene_free(race_scene *scene) {
    free(scene->coords), free(scene->groups), free(scene->faces);
    free(scene->map.points), free(scene->map.rings), free(scene->map.polygons), free(scene->map.areas);
}
