/* areas.h: polygons that do not overlap: which area is a point in? */
#ifndef FROE_BENCH_PEERS_AREAS_H
#define FROE_BENCH_PEERS_AREAS_H
#include <stddef.h>
#include <stdint.h>

/** Polygons, each of one area, which may have several. */
typedef struct peer_map {
    double *points;   /**< x, y */
    size_t *rings;    /**< ring i: points rings[i] .. rings[i+1] - 1, without the first once more */
    size_t *polygons; /**< polygon i: rings polygons[i] .. polygons[i+1] - 1, the first around the others */
    uint32_t *areas;  /**< [polygon] */
    size_t ring_count, polygon_count;
} peer_map;

/** The map must outlive it. */
void *peer_areas_new(const peer_map *map);
/** The number of the area, -1 if there is none. */
int64_t peer_areas_find(void *areas, double x, double y);
void peer_areas_free(void *areas);
#endif
