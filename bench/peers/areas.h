/* areas.h: polygons that do not overlap: which one is a point in? */
#ifndef FROE_BENCH_PEERS_AREAS_H
#define FROE_BENCH_PEERS_AREAS_H
#include <stddef.h>
#include <stdint.h>

/** `count` rings of `corners` points each, without the first once more. */
void *peer_areas_new(const double *rings, size_t count, size_t corners);
/** The number of the polygon, -1 if there is none. */
int64_t peer_areas_find(void *areas, double x, double y);
void peer_areas_free(void *areas);
#endif
