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

static void take(points *p, OGRGeometryH geometry) {
    const int parts = OGR_G_GetGeometryCount(geometry), count = OGR_G_GetPointCount(geometry);
    for (int i = 0; i < parts; i++) take(p, OGR_G_GetGeometryRef(geometry, i));
    if (parts || !count) return;
    if (p->count + (size_t)count > p->room) {
        p->room = 2 * p->room + (size_t)count;
        p->xy = realloc(p->xy, p->room * 2 * sizeof *p->xy);
        if (!p->xy) abort();
    }
    OGR_G_GetPoints(geometry, p->xy + 2 * p->count, 2 * sizeof *p->xy, p->xy + 2 * p->count + 1, 2 * sizeof *p->xy,
                    NULL, 0);
    p->count += (size_t)count;
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
