/* gl2ps.h: gl2ps, as a sorter of triangles and as a painter. */
#ifndef FROE_BENCH_PEERS_GL2PS_H
#define FROE_BENCH_PEERS_GL2PS_H
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
#ifdef __cplusplus
}
#endif
#endif
