/* boxes.h: an index of boxes beside trees of froe, in `bench boxes`. Boost.Geometry's R-tree, packed. */
#ifndef FROE_BENCH_PEERS_BOXES_H
#define FROE_BENCH_PEERS_BOXES_H
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Box i is lo[dim i ..] .. hi[dim i ..]; dim 2 or 3. */
void *peer_boxes_build(int dim, size_t n, const double *lo, const double *hi);
void peer_boxes_free(int dim, void *index);
/** Boxes that meet the closed one; how many. There is room for all. */
size_t peer_boxes_window(int dim, void *index, const double *lo, const double *hi, uint32_t *out);

#ifdef __cplusplus
}
#endif
#endif
