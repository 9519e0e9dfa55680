/* ogr.c: the points of a map by OGR: every feature, every part, every point. */
#include "reading.h"
#include <gdal.h>
#include <ogr_api.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

typedef struct points {
    double *xy;
    size_t count, room;
} points;

static void take_line(points *p, OGRGeometryH geometry) {
    const int count = OGR_G_GetPointCount(geometry);
    if (!count) return;
    if (p->count + (size_t)count > p->room) {
        p->room = 2 * p->room + (size_t)count;
        p->xy = realloc(p->xy, p->room * 2 * sizeof *p->xy);
        if (!p->xy) abort();
    }
    OGR_G_GetPoints(geometry, p->xy + 2 * p->count, 2 * sizeof *p->xy, p->xy + 2 * p->count + 1, 2 * sizeof *p->xy,
                    NULL, 0);
    p->count += (size_t)count;
}

/* A geometry within geometries: a ring, its polygon, and that one's multipolygon or collection. */
enum { NESTED = 16 };

/* Takes the points of all parts, from the first to the last, without recursion. */
static void take(points *p, OGRGeometryH geometry) {
    struct {
        OGRGeometryH geometry;
        int next, parts;
    } open[NESTED] = {{geometry, 0, OGR_G_GetGeometryCount(geometry)}};
    take_line(p, geometry);
    for (int depth = 0; depth >= 0;) {
        if (open[depth].next == open[depth].parts) {
            depth--;
            continue;
        }
        const OGRGeometryH part = OGR_G_GetGeometryRef(open[depth].geometry, open[depth].next++);
        const int parts = OGR_G_GetGeometryCount(part);
        if (!parts) {
            take_line(p, part);
            continue;
        }
        if (++depth == NESTED) abort();
        open[depth].geometry = part;
        open[depth].next = 0;
        open[depth].parts = parts;
    }
}

size_t reading_by_ogr(const char *path) {
    static char x[] = "X_POSSIBLE_NAMES=x", y[] = "Y_POSSIBLE_NAMES=y";
    const char *const options[] = {x, y, NULL};
    points p = {NULL, 0, 0};
    GDALAllRegister();
    const char *ending = strrchr(path, '.');
    const bool table = ending && !strcmp(ending, ".csv");
    const GDALDatasetH file = GDALOpenEx(path, GDAL_OF_VECTOR, NULL, table ? options : NULL, NULL);
    if (!file) return 0;
    for (int i = 0; i < GDALDatasetGetLayerCount(file); i++) {
        const OGRLayerH layer = GDALDatasetGetLayer(file, i);
        for (OGRFeatureH feature; (feature = OGR_L_GetNextFeature(layer)); OGR_F_Destroy(feature))
            if (OGR_F_GetGeometryRef(feature)) take(&p, OGR_F_GetGeometryRef(feature));
    }
    GDALClose(file);
    free(p.xy);
    return p.count;
}
