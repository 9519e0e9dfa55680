/* growth.c: how size and time of a tree grow with n: exponents fitted on a log-log scale.
 *
 *     bench_growth [KIND [SMALLEST [LARGEST [LEAF [METHOD]]]]]
 *
 * Default: cuboids of triangles, 10^4 to 10^6, leaf 1, density.
 *
 * de Berg, theorem 2.5: linear size on uncluttered scenes. Seconds are processor time. */
#include "bench.h"
#include <stdio.h>
#include <stdlib.h>

enum { MOST = 32 };

typedef struct series {
    double n[MOST], size[MOST], pieces[MOST], seconds[MOST];
    size_t count;
} series;

static void measure(const char *kind, size_t want, uint32_t leaf, const char *method, series *s) {
    froe_scene *scene = bench_generate(kind, want, 1);
    const double start = bench_cpu();
    froe_tree *tree = bench_build(scene, method, NULL, leaf, 1, NULL);
    const double seconds = bench_cpu() - start;
    const froe_report r = froe_tree_report(tree);
    const double n = (double)r.objects, size = (double)r.size, pieces = (double)r.fragments;
    printf("%-16s %9.0f %9.3f %7llu %9.3f %9.3f %9.3f\n", kind, n, pieces / n, (unsigned long long)r.height, size / n,
           (double)r.bytes / n, 1e6 * seconds / n);
    fflush(stdout);
    if (s->count < MOST) {
        s->n[s->count] = n, s->size[s->count] = size, s->pieces[s->count] = pieces, s->seconds[s->count] = seconds;
        s->count++;
    }
    froe_tree_free(tree);
    froe_scene_free(scene);
}

static size_t least_of(size_t a, size_t b) {
    return a < b ? a : b;
}

int main(int argc, char **argv) {
    const char *kind = argc > 1 ? argv[1] : "cuboids";
    const size_t smallest = argc > 2 ? strtoull(argv[2], NULL, 10) : 10000;
    const size_t largest = argc > 3 ? strtoull(argv[3], NULL, 10) : 1000000;
    const uint32_t leaf = argc > 4 ? (uint32_t)strtoul(argv[4], NULL, 10) : 1;
    const char *method = argc > 5 ? argv[5] : "density";
    char title[64];
    series s = {0};
    snprintf(title, sizeof title, "growth with n, %.20s, one thread", method);
    bench_head(title, 1);
    printf("%-16s %9s %9s %7s %9s %9s %9s\n", "scene", "n", "pieces/n", "height", "size/n", "bytes/n", "cpu us/n");
    for (size_t ten = smallest; ten <= largest; ten *= 10) {
        measure(kind, ten, leaf, method, &s);
        if (ten < largest) measure(kind, least_of(ten * 316 / 100, largest), leaf, method, &s);
    }
    if (s.count > 1)
        printf("size grows as n^%.3f, pieces as n^%.3f, time as n^%.3f\n", bench_exponent(s.n, s.size, s.count),
               bench_exponent(s.n, s.pieces, s.count), bench_exponent(s.n, s.seconds, s.count));
    return 0;
}
