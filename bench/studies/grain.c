/* grain.c: what the grain builder's efforts give, and what should not matter to it but might: seed, order, scale,
 * turns.
 *
 *     bench_grain [-s SEEDS] SCENE...           files of polygons
 *
 * One thread, leaf 0, processor time. "apart" is the largest deviation from the mean of the seeds; the three columns
 * after it are deviations of the default from that mean: polygons shuffled, everything 2^40 times as large, turned by a
 * quarter about z and then about x. */
#include "bench.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef enum change { SHUFFLED, SCALED, TURNED, CHANGES } change;

static void change_point(const double *p, change what, double *q) {
    const double factor = what == SCALED ? 0x1p40 : 1;
    q[0] = factor * (what == TURNED ? -p[1] : p[0]);
    q[1] = factor * (what == TURNED ? -p[2] : p[1]);
    q[2] = factor * (what == TURNED ? p[0] : p[2]);
}

/** Objects in an order drawn by splitmix64 (Steele, Lea, Flood 2014), or as they are. */
static uint32_t *order_of(size_t n, bool shuffled) {
    uint32_t *order = malloc(n * sizeof *order);
    uint64_t state = 1;
    for (uint32_t i = 0; order && i < n; i++) order[i] = i;
    for (size_t i = n; order && shuffled && i > 1; i--) {
        const size_t j = (size_t)(bench_draw(&state) % i);
        const uint32_t swap = order[j];
        order[j] = order[i - 1];
        order[i - 1] = swap;
    }
    return order;
}

/** The same polygons, changed. */
static froe_scene *changed(const froe_scene *from, change what) {
    const size_t n = froe_scene_object_count(from);
    uint32_t *order = order_of(n, what == SHUFFLED);
    froe_scene *scene = NULL;
    double *x = NULL;
    size_t *starts = calloc(n + 1, sizeof *starts);
    for (size_t i = 0; order && starts && i < n; i++)
        starts[i + 1] = starts[i] + froe_scene_object(from, order[i]).corners;
    if (order && starts) x = calloc(starts[n], 3 * sizeof *x);
    if (!x || froe_scene_new(3, NULL, &scene)) exit(1);
    for (size_t i = 0; i < n; i++)
        for (size_t k = starts[i]; k < starts[i + 1]; k++)
            change_point(froe_scene_vertex(from, froe_scene_corner(from, order[i], (uint32_t)(k - starts[i]))), what,
                         x + 3 * k);
    froe_objects o = froe_objects_defaults();
    o.count = n;
    o.coords = x;
    o.starts = starts;
    if (froe_scene_add(scene, &o, NULL)) exit(1);
    free(x);
    free(starts);
    free(order);
    return scene;
}

static double pieces(froe_scene *scene, const char *settings, uint64_t seed, double *height) {
    froe_build_options o = froe_build_defaults();
    froe_diagnostic diag = {0};
    froe_tree *tree = NULL;
    o.method = "grain";
    o.settings = settings;
    o.leaf = 0;
    o.threads = 1;
    o.seed = seed;
    if (froe_build(scene, &o, &tree, &diag)) {
        fprintf(stderr, "bench: %s\n", diag.message);
        exit(1);
    }
    const froe_report r = froe_tree_report(tree);
    froe_tree_free(tree);
    if (height) *height = (double)r.height;
    return (double)r.fragments / (double)r.objects;
}

static void print_efforts(froe_scene *scene, double n) {
    static const char *const efforts[] = {"effort=fast", "effort=default", "effort=log", "effort=min"};
    for (size_t i = 0; i < sizeof efforts / sizeof *efforts; i++) {
        double height;
        const double start = bench_cpu(), p = pieces(scene, efforts[i], 1, &height);
        printf(" %6.3f (%3.0f) %6.1f", p, height, 1e6 * (bench_cpu() - start) / n);
        fflush(stdout);
    }
}

/** Mean over seeds; *apart: largest relative deviation from it. */
static double mean_of_seeds(froe_scene *scene, uint64_t seeds, double *apart) {
    double sum = 0, least = 1e300, most = 0;
    for (uint64_t seed = 1; seed <= seeds; seed++) {
        const double p = pieces(scene, NULL, seed, NULL);
        sum += p;
        least = fmin(least, p);
        most = fmax(most, p);
    }
    const double mean = sum / (double)seeds;
    *apart = fmax(most - mean, mean - least) / mean;
    return mean;
}

static void print_changes(froe_scene *scene, uint64_t seeds) {
    double apart;
    const double mean = mean_of_seeds(scene, seeds, &apart);
    printf("  %6.3f %5.2f%%", mean, 100 * apart);
    for (change what = 0; what < CHANGES; what++) {
        froe_scene *other = changed(scene, what);
        printf(" %+6.2f%%", 100 * (pieces(other, NULL, 1, NULL) / mean - 1));
        froe_scene_free(other);
    }
    printf("\n");
}

int main(int argc, char **argv) {
    uint64_t seeds = 20;
    int at = 1;
    if (argc > 2 && !strcmp(argv[1], "-s")) seeds = strtoull(argv[2], NULL, 10), at = 3;
    bench_head("grain: pieces per polygon (height), microseconds per polygon, by effort; and what should not matter",
               1);
    printf("%-16s %7s %20s %20s %20s %20s  %6s %6s %7s %7s %7s\n", "scene", "n", "fast", "default", "log", "min",
           "mean", "apart", "order", "scale", "turns");
    for (; at < argc; at++) {
        char name[32];
        froe_scene *scene = bench_read(argv[at]);
        const double n = (double)froe_scene_object_count(scene);
        bench_name(argv[at], name);
        printf("%-16s %7.0f", name, n);
        print_efforts(scene, n);
        print_changes(scene, seeds);
        fflush(stdout);
        froe_scene_free(scene);
    }
    return 0;
}
