/* peers.h: what froe is measured beside. */
#ifndef FROE_BENCH_PEERS_H
#define FROE_BENCH_PEERS_H
#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif
/** gl2ps: triangles of 9 numbers each, in a box of page size. The number of polygons it writes, 0 on failure. */
size_t peer_gl2ps(const double *triangles, size_t n, bool best_root);
/** Boost's R-tree of the bounding boxes of segments. How many there are in the tree. */
size_t peer_boost_rtree(const double *xyxy, size_t n);
#ifdef __cplusplus
}
#endif
#endif
