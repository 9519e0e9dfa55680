/* segments.c: a million disjoint short segments: time and bytes to build, beside Boost's packed R-tree.
 *
 *     bench_segments [N [KIND [SETTINGS]]]        default: 10^6 of "scatter", the defaults of density
 *
 * One thread. froe and Boost take turns; ratios are taken pair by pair, by the wall clock and by processor time,
 * because on a shared machine only the second is ours. Both start from coordinates in memory: Boost's time includes
 * its boxes; froe's is given without and with making the scene (which finds equal vertices). */
#include "bench.h"
#include "peers/peers.h"
#include <stdio.h>
#include <stdlib.h>

enum { RUNS = 7 };
enum { WALL, CPU, CLOCKS };
typedef struct times {
    double add[CLOCKS][RUNS], build[CLOCKS][RUNS], peer[CLOCKS][RUNS];
} times;

/** The end points of all segments, 4 numbers each. */
static double *flatten(const froe_scene *scene, size_t n) {
    double *out = malloc(4 * n * sizeof *out);
    for (uint32_t i = 0; out && i < n; i++)
        for (uint32_t k = 0; k < 4; k++)
            out[4 * (size_t)i + k] = froe_scene_vertex(scene, froe_scene_corner(scene, i, k / 2))[k % 2];
    return out;
}

static void read_clocks(double at[CLOCKS]) {
    at[WALL] = bench_now(), at[CPU] = bench_cpu();
}

static froe_report one_pair(const double *xyxy, size_t n, const char *settings, times *t, int run) {
    double at[4][CLOCKS];
    read_clocks(at[0]);
    froe_scene *scene = bench_segments(xyxy, n);
    read_clocks(at[1]);
    froe_tree *tree = bench_build(scene, "density", settings, 1, 1, NULL);
    read_clocks(at[2]);
    const froe_report r = froe_tree_report(tree);
    froe_tree_free(tree);
    froe_scene_free(scene);
    double start[CLOCKS];
    read_clocks(start);
#ifdef HAVE_BOOST
    if (peer_boost_rtree(xyxy, n) != n) printf("the peer lost segments\n");
#endif
    read_clocks(at[3]);
    for (int c = 0; c < CLOCKS; c++) {
        t->add[c][run] = at[1][c] - at[0][c];
        t->build[c][run] = at[2][c] - at[1][c];
        t->peer[c][run] = at[3][c] - start[c];
    }
    return r;
}

static void print(const char *clock, const double *add, const double *build, const double *peer) {
    double a[RUNS], b[RUNS], p[RUNS], ratio[RUNS], whole[RUNS];
    for (int i = 0; i < RUNS; i++) {
        a[i] = add[i], b[i] = build[i], p[i] = peer[i];
        ratio[i] = build[i] / peer[i], whole[i] = (add[i] + build[i]) / peer[i];
    }
    printf("%-10s %9.3f %9.3f", clock, bench_median(a, RUNS), bench_median(b, RUNS));
#ifdef HAVE_BOOST
    printf(" %9.3f %9.2f %9.2f\n", bench_median(p, RUNS), bench_median(ratio, RUNS), bench_median(whole, RUNS));
#else
    printf(" %9s %9s %9s\n", "-", "-", "-");
#endif
}

int main(int argc, char **argv) {
    size_t n = argc > 1 ? strtoull(argv[1], NULL, 10) : 1000000;
    const char *kind = argc > 2 ? argv[2] : "scatter";
    static times t;
    bench_head("segments in the plane, one thread, medians of 7 pairs of runs", 1);
    froe_scene *scene = bench_generate(kind, n, 1);
    n = froe_scene_object_count(scene);
    double *xyxy = flatten(scene, n);
    froe_scene_free(scene);
    froe_report r = {0};
    for (int i = 0; i < RUNS; i++) r = one_pair(xyxy, n, argc > 3 ? argv[3] : NULL, &t, i);
    printf("%zu of %s, density, leaf 1: %.1f bytes and %.3f pieces an object, height %llu\n", n, kind,
           (double)r.bytes / (double)n, (double)r.fragments / (double)n, (unsigned long long)r.height);
    printf("%-10s %9s %9s %9s %9s %9s\n", "seconds", "scene", "build", "Boost", "ratio", "+ scene");
    print("wall", t.add[WALL], t.build[WALL], t.peer[WALL]);
    print("processor", t.add[CPU], t.build[CPU], t.peer[CPU]);
    free(xyxy);
    return 0;
}
