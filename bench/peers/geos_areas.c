/* geos_areas.c: GEOS as most programs use it to find the polygon around a point: an STR tree of bounds, and prepared
 * polygons for the few that it finds. */
#include "areas.h"
#include <geos_c.h>
#include <stdlib.h>

typedef struct areas {
    GEOSContextHandle_t context;
    GEOSSTRtree *tree;
    const peer_map *map;
    GEOSGeometry **polygons;
    const GEOSPreparedGeometry **prepared;
    GEOSGeometry *point;
    int64_t found;
} areas;

static GEOSGeometry *ring_of(const areas *a, size_t ring) {
    const size_t first = a->map->rings[ring], corners = a->map->rings[ring + 1] - first;
    GEOSCoordSequence *s = GEOSCoordSeq_create_r(a->context, (unsigned)corners + 1, 2);
    for (size_t i = 0; i <= corners; i++) {
        const double *x = a->map->points + 2 * (first + i % corners);
        GEOSCoordSeq_setXY_r(a->context, s, (unsigned)i, x[0], x[1]);
    }
    return GEOSGeom_createLinearRing_r(a->context, s);
}

static GEOSGeometry *polygon_of(const areas *a, size_t polygon) {
    const size_t first = a->map->polygons[polygon], count = a->map->polygons[polygon + 1] - first;
    GEOSGeometry **rings = calloc(count, sizeof *rings);
    if (!rings) exit(1);
    for (size_t i = 0; i < count; i++) rings[i] = ring_of(a, first + i);
    GEOSGeometry *out = GEOSGeom_createPolygon_r(a->context, rings[0], rings + 1, (unsigned)count - 1);
    free(rings);
    return out;
}

void *peer_areas_new(const peer_map *map) {
    areas *a = calloc(1, sizeof *a);
    if (!a) exit(1);
    a->context = GEOS_init_r();
    a->map = map;
    a->tree = GEOSSTRtree_create_r(a->context, 10);
    a->polygons = calloc(map->polygon_count, sizeof *a->polygons);
    a->prepared = calloc(map->polygon_count, sizeof *a->prepared);
    if (!a->polygons || !a->prepared) exit(1);
    for (size_t i = 0; i < map->polygon_count; i++) {
        a->polygons[i] = polygon_of(a, i);
        a->prepared[i] = GEOSPrepare_r(a->context, a->polygons[i]);
        GEOSSTRtree_insert_r(a->context, a->tree, a->polygons[i], (void *)(i + 1));
    }
    return a;
}

/* Where parts of one area overlap (Russia beyond the antimeridian) is none of it, as froe has it. */
static void look_at(void *item, void *user) {
    areas *a = user;
    const size_t i = (size_t)item - 1;
    const int64_t area = a->map->areas[i];
    if (GEOSPreparedIntersects_r(a->context, a->prepared[i], a->point) == 1) a->found = a->found == area ? -1 : area;
}

int64_t peer_areas_find(void *index, double x, double y) {
    areas *a = index;
    a->found = -1;
    a->point = GEOSGeom_createPointFromXY_r(a->context, x, y);
    GEOSSTRtree_query_r(a->context, a->tree, a->point, look_at, a);
    GEOSGeom_destroy_r(a->context, a->point);
    return a->found;
}

void peer_areas_free(void *index) {
    areas *a = index;
    for (size_t i = 0; i < a->map->polygon_count; i++) {
        GEOSPreparedGeom_destroy_r(a->context, a->prepared[i]);
        GEOSGeom_destroy_r(a->context, a->polygons[i]);
    }
    GEOSSTRtree_destroy_r(a->context, a->tree);
    GEOS_finish_r(a->context);
    free(a->polygons), free(a->prepared), free(a);
}
