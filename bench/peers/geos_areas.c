/* geos_areas.c: GEOS as most programs use it to find the polygon around a point: an STR tree of bounds, and prepared
 * polygons for the few that it finds. */
#include "areas.h"
#include <geos_c.h>
#include <stdlib.h>

typedef struct areas {
    GEOSContextHandle_t context;
    GEOSSTRtree *tree;
    size_t count;
    GEOSGeometry **polygons;
    const GEOSPreparedGeometry **prepared;
    GEOSGeometry *point;
    int64_t found;
} areas;

static GEOSGeometry *polygon_of(GEOSContextHandle_t context, const double *ring, size_t corners) {
    GEOSCoordSequence *s = GEOSCoordSeq_create_r(context, (unsigned)corners + 1, 2);
    for (size_t i = 0; i <= corners; i++)
        GEOSCoordSeq_setXY_r(context, s, (unsigned)i, ring[2 * (i % corners)], ring[2 * (i % corners) + 1]);
    return GEOSGeom_createPolygon_r(context, GEOSGeom_createLinearRing_r(context, s), NULL, 0);
}

void *peer_areas_new(const double *rings, size_t count, size_t corners) {
    areas *a = calloc(1, sizeof *a);
    if (!a) exit(1);
    a->context = GEOS_init_r();
    a->count = count;
    a->tree = GEOSSTRtree_create_r(a->context, 10);
    a->polygons = calloc(count, sizeof *a->polygons);
    a->prepared = calloc(count, sizeof *a->prepared);
    if (!a->polygons || !a->prepared) exit(1);
    for (size_t i = 0; i < count; i++) {
        a->polygons[i] = polygon_of(a->context, rings + i * 2 * corners, corners);
        a->prepared[i] = GEOSPrepare_r(a->context, a->polygons[i]);
        GEOSSTRtree_insert_r(a->context, a->tree, a->polygons[i], (void *)(i + 1));
    }
    return a;
}

static void look_at(void *item, void *user) {
    areas *a = user;
    const size_t i = (size_t)item - 1;
    if (GEOSPreparedIntersects_r(a->context, a->prepared[i], a->point) == 1) a->found = (int64_t)i;
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
    for (size_t i = 0; i < a->count; i++) {
        GEOSPreparedGeom_destroy_r(a->context, a->prepared[i]);
        GEOSGeom_destroy_r(a->context, a->polygons[i]);
    }
    GEOSSTRtree_destroy_r(a->context, a->tree);
    GEOS_finish_r(a->context);
    free(a->polygons), free(a->prepared), free(a);
}
