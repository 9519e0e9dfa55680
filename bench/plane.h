/* plane.h: segments and queries of `bench index`: whole coordinates below 2^30. */
#ifndef FROE_BENCH_PLANE_H
#define FROE_BENCH_PLANE_H
#include "peers/index.h"

typedef struct plane_scene {
    char name[32];
    peer_segment *s;
    size_t n;
    double lo[2], hi[2];
    double *windows[2]; /**< of about 10 and 1000 results: lo, hi */
    size_t window_count[2];
    double *points; /**< x at half-integers */
    size_t point_count;
    bool disjoint; /**< no two segments cross: faces are well defined */
} plane_scene;

/** short, mixed, tin, cross, of about n segments; or the first n segments of a file that froe reads. Exits on failure.
 */
plane_scene plane_make(const char *kind, size_t n, uint64_t seed);
void plane_free(plane_scene *scene);
#endif
