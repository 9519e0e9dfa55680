/* walks.c: what ranges cost by each walk: from cut to cut, by box location, by lowest common ancestors.
 *
 *     bench_walks [N [KIND...]]        default: 200,000, of scatter, nested
 *
 * Windows around corners of objects, small beside the object and larger. Trees with one object in a leaf. One thread,
 * processor time; the walks take turns, medians of ROUNDS rounds. Nodes are those visited, steps those of searches by
 * centroids, which cost as much. Answers are compared. */
#include "bench.h"
#include <froe/query.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { ROUNDS = 5, WINDOWS = 4000, SIZES = 3 };
static const double sizes[SIZES] = {0.01, 1, 4}; /* of the object at whose corner a window is */
static const froe_walk walks[] = {FROE_WALK_PLAIN, FROE_WALK_BOX, FROE_WALK_LCA};
enum { WALKS = sizeof walks / sizeof *walks };

/* A window at the first corner of a random object. */
static void window_at(const froe_scene *scene, double size, uint64_t *state, double *window) {
    const uint32_t object = (uint32_t)(bench_unit(state) * (double)froe_scene_object_count(scene));
    const double *a = froe_scene_vertex(scene, froe_scene_corner(scene, object, 0));
    const double *b = froe_scene_vertex(scene, froe_scene_corner(scene, object, 1));
    const double reach = size * fmax(fabs(b[0] - a[0]), fabs(b[1] - a[1]));
    const double shift[2] = {reach * (bench_unit(state) - 0.5), reach * (bench_unit(state) - 0.5)};
    for (int k = 0; k < 2; k++) {
        window[k] = a[k] + shift[k] - reach / 2;
        window[2 + k] = a[k] + shift[k] + reach / 2;
    }
}

/* All windows by one walk; returns the sum of the answers. */
static uint64_t ask(froe_query *q, const double *windows, froe_walk walk) {
    uint64_t sum = 0, count;
    froe_range range = froe_range_defaults();
    range.walk = walk;
    for (size_t i = 0; i < WINDOWS; i++) {
        range.points = windows + 4 * i;
        bench_must(froe_query_count(q, &range, &count, NULL), NULL);
        sum += count;
    }
    return sum;
}

static void time_size(froe_query *q, const froe_scene *scene, double size) {
    static double windows[4 * WINDOWS];
    double seconds[WALKS][ROUNDS];
    uint64_t state = 3, sums[WALKS];
    froe_query_stats stats[WALKS];
    for (size_t i = 0; i < WINDOWS; i++) window_at(scene, size, &state, windows + 4 * i);
    for (size_t w = 0; w < WALKS; w++) ask(q, windows, walks[w]);
    for (int round = 0; round < ROUNDS; round++)
        for (size_t w = 0; w < WALKS; w++) {
            froe_query_statistics(q);
            const double start = bench_cpu();
            sums[w] = ask(q, windows, walks[w]);
            seconds[w][round] = bench_cpu() - start;
            stats[w] = froe_query_statistics(q);
        }
    printf("%8.2f %8.1f %8.1f", size, (double)sums[0] / WINDOWS, (double)stats[0].leaves / WINDOWS);
    for (size_t w = 0; w < WALKS; w++)
        printf("  %8.1f %8.1f %8.2f", (double)stats[w].nodes / WINDOWS, (double)stats[w].steps / WINDOWS,
               1e6 * bench_median(seconds[w], ROUNDS) / WINDOWS);
    printf("  %s\n", sums[1] == sums[0] && sums[2] == sums[0] ? "equal" : "ANSWERS DIFFER");
    fflush(stdout);
}

static void bench(const char *kind, size_t n, const char *method) {
    froe_scene *scene = bench_generate(kind, n, 1);
    froe_tree *tree = bench_build(scene, method, NULL, 1, 1, NULL);
    const froe_report report = froe_tree_report(tree);
    froe_query *q;
    bench_must(froe_query_new(tree, &q, NULL), NULL);
    printf("\n%s, %zu objects, %s: %llu nodes, height %llu\n", kind, froe_scene_object_count(scene), method,
           (unsigned long long)report.nodes, (unsigned long long)report.height);
    printf("%26s", "");
    for (size_t w = 0; w < WALKS; w++) printf("  %-26s", froe_walk_name(walks[w]));
    printf("\n%8s %8s %8s", "size", "found", "leaves");
    for (size_t w = 0; w < WALKS; w++) printf("  %8s %8s %8s", "nodes", "steps", "us");
    printf("\n");
    for (int i = 0; i < SIZES; i++) time_size(q, scene, sizes[i]);
    froe_query_free(q);
    froe_tree_free(tree);
    froe_scene_free(scene);
}

int main(int argc, char **argv) {
    static char *all[] = {"scatter", "nested"};
    const size_t n = argc > 1 ? strtoull(argv[1], NULL, 10) : 200000;
    char **kinds = argc > 2 ? argv + 2 : all;
    bench_head("walks of ranges, one thread, medians of 5 rounds by processor time", 1);
    for (int i = 0, count = argc > 2 ? argc - 2 : 2; i < count; i++) bench(kinds[i], n, "quad");
    return 0;
}
