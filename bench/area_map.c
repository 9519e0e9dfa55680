/* area_map.c: see area_map.h. */
#include "area_map.h"
#include "bench.h"
#include <stdlib.h>
#include <string.h>

/* Has the ring that began with `first` come round with object i, or can it not go on? */
static bool ends_ring(const froe_scene *s, uint32_t first, uint32_t i) {
    const uint32_t end = froe_scene_corner(s, i, froe_scene_object(s, i).corners - 1);
    if (end == froe_scene_corner(s, first, 0) && froe_scene_object(s, i).corners == 2) return true;
    return i + 1 == froe_scene_object_count(s) || froe_scene_corner(s, i + 1, 0) != end ||
           froe_scene_object(s, i + 1).group != froe_scene_object(s, i).group;
}

/* A ring is of the polygon before if the two share their face. */
static void add_ring(const froe_scene *s, peer_map *m, uint32_t first, uint32_t last) {
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
        add_ring(s, &m, first, i);
        first = i + 1;
    }
    return m;
}

static int compare(const void *a, const void *b) {
    const double *s = a, *t = b;
    for (int k = 0; k < 4; k++)
        if (s[k] != t[k]) return s[k] < t[k] ? -1 : 1;
    return 0;
}

static void take_borders(const froe_scene *s, area_map *m) {
    const uint32_t n = (uint32_t)froe_scene_object_count(s);
    peer_segment *all = bench_take(n, sizeof *all);
    size_t count = 0;
    for (uint32_t i = 0; i < n; i++) {
        if (froe_scene_object(s, i).corners != 2) continue;
        const double *a = froe_scene_vertex(s, froe_scene_corner(s, i, 0)),
                     *b = froe_scene_vertex(s, froe_scene_corner(s, i, 1));
        const bool swap = b[0] < a[0] || (b[0] == a[0] && b[1] < a[1]);
        all[count++] = swap ? (peer_segment){b[0], b[1], a[0], a[1]} : (peer_segment){a[0], a[1], b[0], b[1]};
    }
    qsort(all, count, sizeof *all, compare);
    for (size_t i = 0; i < count; i++)
        if (!i || compare(all + i, all + i - 1)) all[m->border_count++] = all[i];
    m->borders = all;
}

area_map area_map_of(const froe_scene *scene) {
    area_map m = {.rings = trace_rings(scene)};
    take_borders(scene, &m);
    return m;
}

void area_map_free(area_map *m) {
    free(m->rings.points), free(m->rings.rings), free(m->rings.polygons), free(m->rings.areas), free(m->borders);
}

static bool stop(void *user, const froe_pair *pair) {
    (void)pair;
    *(bool *)user = false;
    return false;
}

bool area_map_is_plain(const area_map *m) {
    froe_scene *scene = bench_segments(&m->borders->ax, m->border_count);
    froe_tree *tree = bench_build(scene, "index", NULL, FROE_LEAF_OWN, 1, NULL);
    froe_query *query;
    bool plain = true;
    bench_must(froe_query_new(tree, &query, NULL), NULL);
    bench_must(froe_query_pairs(query, false, stop, &plain, NULL), NULL);
    froe_query_free(query);
    froe_tree_free(tree);
    froe_scene_free(scene);
    return plain;
}
