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
/** gl2ps with best root and occlusion cull: a picture of triangles of 9 numbers each in the coordinates of a window of
 * 1000 x 1000, y upwards, z from 0 (near) to 1, colours 0xRRGGBB, to a file. False on failure. */
bool peer_gl2ps_picture(const double *triangles, const unsigned *colours, size_t n, const char *path);
/** Boost's R-tree of the bounding boxes of segments. How many there are in the tree. */
size_t peer_boost_rtree(const double *xyxy, size_t n);
#ifdef __cplusplus
}
#endif
#endif
