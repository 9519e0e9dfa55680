/* cylinders.c: how trees of the builder `cylindrical` grow.
 *
 *     bench_cylinders FOLDER [LARGEST]  into FOLDER: cylinders-size.svg, cylinders-height.svg; default 10^6, of
 *                                       segments that cross much a third of it: more take 12 GB and minutes
 *
 * One thread, processor time. */
#include "bench.h"
#include "figure.h"
#include <froe/query.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 8, RATIOS = 4 };
static const double ratios[RATIOS] = {0, 1, 3, 10}; /* crossings a segment, about */
static const char *const names[RATIOS] = {"disjoint", "k = n", "k = 3 n", "k = 10 n"};

typedef struct line {
    double n[MOST], size[MOST], height[MOST];
    size_t count;
} line;

static bool count_pair(void *user, const froe_pair *pair) {
    (void)pair;
    ++*(double *)user;
    return true;
}

static double crossings(froe_scene *scene) {
    double count = 0;
    froe_query *query = NULL;
    froe_tree *tree = bench_build(scene, "index", NULL, FROE_LEAF_OWN, 1, NULL);
    bench_must(froe_query_new(tree, &query, NULL), NULL);
    bench_must(froe_query_pairs(query, true, count_pair, &count, NULL), NULL);
    froe_query_free(query);
    froe_tree_free(tree);
    return count;
}

/* n^2 length^2 / pi pairs of segments that lie anywhere in the unit square cross. */
static froe_scene *scene_of(size_t n, double ratio) {
    if (ratio == 0) return bench_generate("disjoint", n, 1);
    double *xyxy = bench_scatter(n, 1), length = sqrt(3.14159265358979 * ratio / (double)n);
    unsigned long long state = 1;
    for (size_t i = 0; i < 4 * n; i += 4) {
        double u[3];
        for (int j = 0; j < 3; j++) {
            state = state * 6364136223846793005u + 1442695040888963407u;
            u[j] = (double)(state >> 11) * 0x1p-53;
        }
        double dx = 0.5 * length * cos(6.283185307179586 * u[2]), dy = 0.5 * length * sin(6.283185307179586 * u[2]);
        xyxy[i] = u[0] - dx, xyxy[i + 1] = u[1] - dy, xyxy[i + 2] = u[0] + dx, xyxy[i + 3] = u[1] + dy;
    }
    froe_scene *scene = bench_segments(xyxy, n);
    free(xyxy);
    return scene;
}

static void grow(line *l, size_t n, double ratio) {
    froe_scene *scene = scene_of(n, ratio);
    n = froe_scene_object_count(scene);
    double k = ratio > 0 ? crossings(scene) : 0, start = bench_cpu();
    froe_tree *tree = bench_build(scene, "cylindrical", NULL, 0, 1, NULL);
    double seconds = bench_cpu() - start;
    froe_report r = froe_tree_report(tree);
    double logn = log2((double)n), bound = (double)n * logn + k;
    l->n[l->count] = (double)n;
    l->size[l->count] = (double)r.nodes / bound;
    l->height[l->count++] = (double)r.height / logn;
    printf("%9zu %9.0f %10llu %9.3f %7llu %8.2f %9.2f %9.1f\n", n, k, (unsigned long long)r.nodes,
           (double)r.nodes / bound, (unsigned long long)r.height, (double)r.height / logn, seconds,
           (double)r.bytes / (double)r.nodes);
    fflush(stdout);
    froe_tree_free(tree);
    froe_scene_free(scene);
}

static void figure(const char *folder, const char *name, const char *title, const char *y_label, const line *lines,
                   bool heights) {
    plot_series series[RATIOS];
    plot_options o = plot_defaults();
    for (size_t i = 0; i < RATIOS; i++)
        series[i] = (plot_series){names[i], lines[i].n, heights ? lines[i].height : lines[i].size, lines[i].count};
    o.title = title, o.x_label = "segments n", o.y_label = y_label, o.log_x = true;
    bench_figure(folder, name, series, RATIOS, &o);
}

static void growth(const char *folder, size_t largest, double most_crossings) {
    static line lines[RATIOS];
    printf("%9s %9s %10s %9s %7s %8s %9s %9s\n", "n", "k", "nodes", "/(nlogn+k)", "height", "/log2 n", "build, s",
           "bytes/node");
    for (int i = 0; i < RATIOS; i++)
        for (size_t n = 1000; n <= largest && ratios[i] * (double)n <= most_crossings; n *= 10) {
            grow(lines + i, n, ratios[i]);
            if (3.16 * (double)n <= (double)largest) grow(lines + i, n * 316 / 100, ratios[i]);
        }
    figure(folder, "cylinders-size.svg", "Nodes of cylindrical trees", "nodes / (n log2 n + k)", lines, false);
    figure(folder, "cylinders-height.svg", "Height of cylindrical trees", "height / log2 n", lines, true);
}

int main(int argc, char **argv) {
    if (argc < 2) return fprintf(stderr, "usage: bench_cylinders FOLDER [LARGEST]\n"), 2;
    bench_head("cylindrical trees, one thread, processor time", 1);
    growth(argv[1], argc > 2 ? strtoull(argv[2], NULL, 10) : 1000000, argc > 2 ? (double)INFINITY : 2e6);
    return 0;
}
