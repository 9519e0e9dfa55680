/* random.h: all randomness is a hash of (seed, path of the node, counter), so that
 * it depends neither on the order of work nor on the number of threads.
 * A path is 1 at the root; a child's comes from base_path(). */
#ifndef FROE_BASE_RANDOM_H
#define FROE_BASE_RANDOM_H
#include <stdint.h>

static inline uint64_t base_mix(uint64_t x) { /* the finaliser of splitmix64 (Steele, Lea, Flood 2014) */
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}
static inline uint64_t base_hash(uint64_t seed, uint64_t path, uint64_t counter) {
    return base_mix(base_mix(base_mix(seed + 0x9e3779b97f4a7c15u) ^ path) + counter * 0x9e3779b97f4a7c15u);
}
/** Path of child 0 or 1. */
static inline uint64_t base_path(uint64_t path, int side) {
    return base_mix(2 * path + (uint64_t)side + 0x632be59bd9b4e019u);
}
/** A number in 0 .. n-1 (n < 2^32) from a hash. */
static inline uint32_t base_below(uint64_t hash, uint32_t n) {
    return (uint32_t)(((hash >> 32) * n) >> 32);
}
#endif
