/* cylinders.c: trees of the builder `cylindrical` beside CGAL's trapezoids, and how they grow.
 *
 *     bench_cylinders peer [N]                 default 100,000 disjoint segments: short ones, and some that are long
 *     bench_cylinders growth FOLDER [LARGEST]  into FOLDER: cylinders-size.svg, cylinders-height.svg; default 10^6, of
 *                                              segments that cross much a third of it: more take 12 GB and minutes
 *
 * One thread, processor time. CGAL's map keeps faces, and exact numbers; froe's tree has cells, and exact numbers where
 * they are needed. Both are asked where points are that lie on no segment: in which cell, in which face. */
#include "bench.h"
#include "figure.h"
#include "plane.h"
#include <froe/query.h>
#include <malloc.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* --------------------------------------------------------------------- peer -- */

#ifdef HAVE_CGAL
enum { POINTS = 100000, WARM = 2000 };

static size_t heap(void) {
    struct mallinfo2 m = mallinfo2();
    return m.uordblks + m.hblkhd;
}

typedef struct result {
    double build, prepare, bytes, more, rate, batch; /* more: what is prepared for points */
} result;

static double in_a_batch(froe_query *query, const double *points) {
    froe_batch_options o = froe_batch_defaults();
    froe_answers found;
    o.threads = 1;
    const double start = bench_cpu();
    bench_must(froe_batch_locate(query, points, POINTS, &o, &found, NULL), NULL);
    const double rate = POINTS / (bench_cpu() - start);
    froe_answers_free(&found);
    return rate;
}

static result of_froe(const plane_scene *p) {
    result r;
    froe_scene *scene = bench_segments(&p->s[0].ax, p->n);
    double start = bench_cpu();
    froe_tree *tree = bench_build(scene, "cylindrical", NULL, 0, 1, NULL);
    r.build = bench_cpu() - start;
    r.bytes = (double)froe_tree_report(tree).bytes / (double)p->n;
    froe_query *query = NULL;
    bench_must(froe_query_new(tree, &query, NULL), NULL);
    froe_list found;
    const size_t before = heap();
    start = bench_cpu();
    bench_must(froe_query_locate(query, p->points, &found, NULL), NULL);
    r.prepare = bench_cpu() - start;
    r.more = (double)(heap() - before) / (double)p->n;
    for (size_t i = 0; i < POINTS + WARM; i++) {
        if (i == WARM) start = bench_cpu();
        bench_must(froe_query_locate(query, p->points + 2 * i, &found, NULL), NULL);
    }
    r.rate = POINTS / (bench_cpu() - start);
    r.batch = in_a_batch(query, p->points + 2 * (size_t)WARM);
    froe_query_free(query);
    froe_tree_free(tree);
    froe_scene_free(scene);
    return r;
}

static result of_cgal(const plane_scene *p) {
    result r;
    size_t before = heap();
    double start = bench_cpu();
    void *index = peer_trapezoids.build(p->s, p->n);
    r.build = bench_cpu() - start;
    r.bytes = (double)(heap() - before) / (double)p->n;
    for (size_t i = 0; i < POINTS + WARM; i++) {
        if (i == WARM) start = bench_cpu();
        peer_trapezoids.locate(index, p->points[2 * i], p->points[2 * i + 1]);
    }
    r.rate = POINTS / (bench_cpu() - start);
    peer_trapezoids.free(index);
    return r;
}

static void beside(const char *kind, size_t n) {
    plane_scene p = plane_make(kind, n, 1);
    result froe = of_froe(&p), cgal = of_cgal(&p);
    printf("%-8s %8zu %9.3f %9.3f %9.3f %7.1f %7.0f %7.0f %7.0f %7.1f %9.0f %9.0f %9.0f %7.1f\n", kind, p.n, froe.build,
           froe.prepare, cgal.build, cgal.build / froe.build, froe.bytes, froe.more, cgal.bytes,
           cgal.bytes / froe.bytes, froe.rate, froe.batch, cgal.rate, froe.rate / cgal.rate);
    plane_free(&p);
    fflush(stdout);
}

static void peer_table(size_t n) {
    printf("%-8s %8s %9s %9s %9s %7s %7s %7s %7s %7s %9s %9s %9s %7s\n", "", "n", "build, s", "prepare", "CGAL",
           "ratio", "bytes", "+", "CGAL", "ratio", "cells/s", "in batch", "CGAL", "ratio");
    beside("short", n);
    beside("mixed", n);
}
#else
static void peer_table(size_t n) {
    (void)n;
    printf("CGAL is not there\n");
}
#endif

/* ------------------------------------------------------------------- growth -- */

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
    bench_head("cylindrical trees, one thread, processor time", 1);
    if (argc > 2 && !strcmp(argv[1], "growth"))
        growth(argv[2], argc > 3 ? strtoull(argv[3], NULL, 10) : 1000000, argc > 3 ? (double)INFINITY : 2e6);
    else
        peer_table(argc > 2 ? strtoull(argv[2], NULL, 10) : 100000);
    return 0;
}
