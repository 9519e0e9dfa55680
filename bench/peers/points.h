/* points.h: what a library does to be a column of `bench points`: one struct of these for each dimension. */
#ifndef FROE_BENCH_PEERS_POINTS_H
#define FROE_BENCH_PEERS_POINTS_H
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct points_peer {
    const char *name;
    /** n points of 2 or 3 numbers each, which stay. */
    void *(*build)(const double *points, size_t n);
    void (*free)(void *index);
    /** Writes the k nearest points, nearest first; how many. */
    size_t (*near)(void *index, const double *x, size_t k, uint32_t *out);
    /** Writes the points in a ball, each once; how many. There is room for all. */
    size_t (*ball)(void *index, const double *centre, double radius, uint32_t *out);
} points_peer;

extern const points_peer peer_nanoflann_2, peer_nanoflann_3;

#ifdef __cplusplus
}
#endif
#endif
