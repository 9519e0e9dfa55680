/* fuzzy.h: what a library does to answer approximate range queries among points in `bench approximate`: one struct of
 * these for each dimension. */
#ifndef FROE_BENCH_PEERS_FUZZY_H
#define FROE_BENCH_PEERS_FUZZY_H
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct fuzzy_peer {
    const char *name;
    /** n points of 2 or 3 numbers each. */
    void *(*build)(const double *points, size_t n);
    void (*free)(void *index);
    /** Writes the numbers of all points nearer to the centre than radius - fuzz and of none further away than radius +
     * fuzz; how many. There is room for all. */
    size_t (*ball)(void *index, const double *centre, double radius, double fuzz, uint32_t *out);
} fuzzy_peer;

extern const fuzzy_peer peer_fuzzy_2, peer_fuzzy_3;

#ifdef __cplusplus
}
#endif
#endif
