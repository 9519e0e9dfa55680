/* segments.c: short disjoint-ish segments in the plane: time and bytes to build, beside Boost's packed R-tree.
 *
 *     bench_segments [N [KIND]]        default: 10^6 segments; runs take turns, ratios pair by pair */
#include "bench.h"
#include <stdio.h>
#include <stdlib.h>

enum { RUNS = 5 };

#ifdef HAVE_BOOST
double peer_boost_rtree(const double *xyxy, size_t n);
#endif

/** The end points of all segments, 4 doubles each. */
static double *flatten(const froe_scene *scene, size_t n) {
    double *out = malloc(4 * n * sizeof *out);
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t k = 0; k < 4; k++)
            out[4 * (size_t)i + k] = froe_scene_vertex(scene, froe_scene_corner(scene, i, k / 2))[k % 2];
    return out;
}

int main(int argc, char **argv) {
    size_t n = argc > 1 ? strtoull(argv[1], NULL, 10) : 1000000;
    const char *kind = argc > 2 ? argv[2] : "segments";
    double ours[RUNS], peer[RUNS], ratio[RUNS];
    bench_head("segments in the plane: one thread, median of 5 paired runs", 1);
    froe_scene *scene = bench_generate(kind, n, 1);
    n = froe_scene_object_count(scene);
    double *flat = flatten(scene, n);
    froe_report r = {0};
    for (int i = 0; i < RUNS; i++) {
        froe_tree *tree = bench_build(scene, "density", NULL, 1, 1, &ours[i]);
        r = froe_tree_report(tree);
        froe_tree_free(tree);
#ifdef HAVE_BOOST
        peer[i] = peer_boost_rtree(flat, n);
#else
        peer[i] = ours[i];
#endif
        ratio[i] = ours[i] / peer[i];
    }
    printf("%zu %s: froe density leaf 1 %.3f s, %.1f bytes, %.3f pieces an object, height %llu\n", n, kind,
           bench_median(ours, RUNS), (double)r.bytes / (double)n, (double)r.fragments / (double)n,
           (unsigned long long)r.height);
#ifdef HAVE_BOOST
    printf("Boost R-tree, packed: %.3f s; froe takes %.2f times as long\n", bench_median(peer, RUNS),
           bench_median(ratio, RUNS));
#endif
    free(flat);
    froe_scene_free(scene);
    return 0;
}
