/* areas.c: maps of areas: a crooked grid, in which every border is there twice, or the polygons of a file. */
#include "bench.h"
#include "race.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { EDGE = 4, RING = 4 * EDGE }; /* segments of a border, and of an area */

/* ---------------------------------------------------------------------- grid -- */

/* Point i of the border that begins at lattice point (x, y) and goes right (axis 0) or up (1): whole numbers, the same
 * from both sides. */
static void border_point(uint64_t x, uint64_t y, int axis, int i, double out[2]) {
    const double step = 4096;
    const uint64_t at[2] = {x + (axis == 0 && i == EDGE), y + (axis == 1 && i == EDGE)};
    const uint64_t part = i == EDGE ? 0 : (uint64_t)i;
    uint64_t state = bench_state(((at[0] * 1000003 + at[1]) * 2 + (part ? (uint64_t)axis : 0)) * EDGE + part);
    const double reach = part ? step / 16 : step / 8;
    for (int k = 0; k < 2; k++)
        out[k] = floor((double)at[k] * step + (part && k == axis ? step / EDGE * (double)part : 0) +
                       reach * bench_unit(&state));
}

static void add_ring(froe_scene *scene, uint64_t x, uint64_t y) {
    double ring[2 * RING], ends[4 * RING];
    for (int i = 0; i < EDGE; i++) {
        border_point(x, y, 0, i, ring + 2 * i);
        border_point(x + 1, y, 1, i, ring + 2 * (EDGE + i));
        border_point(x, y + 1, 0, EDGE - i, ring + 2 * (2 * EDGE + i));
        border_point(x, y, 1, EDGE - i, ring + 2 * (3 * EDGE + i));
    }
    for (size_t i = 0; i < RING; i++) {
        memcpy(ends + 4 * i, ring + 2 * i, 2 * sizeof *ends);
        memcpy(ends + 4 * i + 2, ring + 2 * ((i + 1) % RING), 2 * sizeof *ends);
    }
    froe_objects o = froe_objects_defaults();
    o.kind = FROE_SEGMENT, o.count = RING, o.coords = ends;
    bench_must(froe_scene_add_group(scene, &(froe_group){.name = "area"}, &o.group), NULL);
    bench_must(froe_scene_add(scene, &o, NULL), NULL);
}

static froe_scene *make_grid(size_t segments) {
    const uint64_t side = (uint64_t)sqrt((double)segments / RING);
    froe_scene *scene;
    bench_must(froe_scene_new(2, NULL, &scene), NULL);
    for (uint64_t y = 0; y < side; y++)
        for (uint64_t x = 0; x < side; x++) add_ring(scene, x, y);
    return scene;
}

/* --------------------------------------------------------------------- rings -- */

/* Has the ring that began with `first` come round with object i, or can it not go on? */
static bool ends_ring(const froe_scene *s, uint32_t first, uint32_t i) {
    const uint32_t end = froe_scene_corner(s, i, froe_scene_object(s, i).corners - 1);
    if (end == froe_scene_corner(s, first, 0) && froe_scene_object(s, i).corners == 2) return true;
    return i + 1 == froe_scene_object_count(s) || froe_scene_corner(s, i + 1, 0) != end ||
           froe_scene_object(s, i + 1).group != froe_scene_object(s, i).group;
}

/* A ring is of the polygon before if the two share their face. */
static void take_ring(const froe_scene *s, peer_map *m, uint32_t first, uint32_t last) {
    const froe_object o = froe_scene_object(s, first), before = first ? froe_scene_object(s, first - 1) : o;
    size_t point = m->rings[m->ring_count];
    if (!first || o.face != before.face || o.group != before.group) {
        m->polygons[m->polygon_count] = m->ring_count;
        m->areas[m->polygon_count++] = o.group;
    }
    for (uint32_t i = first; i <= last; i++, point++)
        memcpy(m->points + 2 * point, froe_scene_vertex(s, froe_scene_corner(s, i, 0)), 2 * sizeof *m->points);
    m->rings[++m->ring_count] = point;
    m->polygons[m->polygon_count] = m->ring_count;
}

static peer_map trace_rings(const froe_scene *s) {
    const uint32_t n = (uint32_t)froe_scene_object_count(s);
    peer_map m = {.points = bench_take(2 * (size_t)n, sizeof *m.points),
                  .rings = bench_take((size_t)n + 1, sizeof *m.rings),
                  .polygons = bench_take((size_t)n + 1, sizeof *m.polygons),
                  .areas = bench_take((size_t)n + 1, sizeof *m.areas)};
    for (uint32_t i = 0, first = 0; i < n; i++) {
        if (!ends_ring(s, first, i)) continue;
        take_ring(s, &m, first, i);
        first = i + 1;
    }
    return m;
}

void race_make_areas(race_scene *scene, const char *name, size_t n, uint64_t *state) {
    const bool grid = !strcmp(name, "grid of areas");
    froe_scene *s = grid ? make_grid(n) : bench_read(name);
    const uint32_t count = (uint32_t)froe_scene_object_count(s);
    (void)state;
    scene->coords = bench_take(4 * (size_t)count, sizeof *scene->coords);
    scene->groups = bench_take(count, sizeof *scene->groups);
    scene->faces = bench_take(count, sizeof *scene->faces);
    for (uint32_t i = 0; i < count; i++) {
        const froe_object o = froe_scene_object(s, i);
        for (uint32_t c = 0; c < 2; c++)
            memcpy(scene->coords + 4 * (size_t)i + 2 * (size_t)c,
                   froe_scene_vertex(s, froe_scene_corner(s, i, c < o.corners ? c : 0)), 2 * sizeof *scene->coords);
        scene->groups[i] = o.group, scene->faces[i] = o.face;
    }
    scene->map = trace_rings(s);
    scene->data = (peer_data){.count = count, .dim = 2, .disjoint = grid, .areas = froe_scene_group_count(s)};
    froe_scene_free(s);
}
