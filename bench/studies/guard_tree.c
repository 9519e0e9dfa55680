/* guard_tree.c: processor seconds of the ways to build the guard tree, on one thread.
 *
 * The first column is the plain way, one octree level at a time; the others are ratios to it. */
#include "split/guard/guard_tree.h"
#include "split/guard_scenes.h"
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { WAYS = 4, RUNS = 3 };

typedef struct bench_row {
    const char *name;
    guard_scene scene;
    int dim;
    size_t count;
    uint32_t k;
} bench_row;

static const bench_row rows[] = {
    {"uniform", SCENE_UNIFORM, 2, 400000, 8},        {"uniform", SCENE_UNIFORM, 2, 4000000, 8},
    {"uniform", SCENE_UNIFORM, 2, 1000000, 0},       {"uniform", SCENE_UNIFORM, 3, 4000000, 16},
    {"uniform", SCENE_UNIFORM, 8, 100000, 16},       {"20 clusters", SCENE_CLUSTERS, 2, 1000000, 4},
    {"lattice", SCENE_LATTICE, 2, 1000000, 4},       {"nested", SCENE_NESTED, 2, 100000, 4},
    {"nested", SCENE_NESTED, 2, 1000000, 4},         {"nested", SCENE_NESTED, 3, 500000, 0},
    {"half far inside", SCENE_CHAIN, 2, 1000000, 0},
};

static void stop(const char *what) {
    fprintf(stderr, "guard_tree: %s\n", what);
    exit(1);
}

/* Seconds of the quickest run. */
static double seconds(const double *guards, const bench_row *row, split_guard_way way, uint64_t *leaves) {
    double best = INFINITY;
    for (int run = 0; run < RUNS; run++) {
        froe_allocator alloc = support_allocator(NULL);
        split_guard_options options = {.dim = row->dim, .k = row->k, .way = way};
        split_guard_tree tree;
        base_task task;
        base_task_init(&task, 1, NULL, NULL);
        clock_t begin = clock();
        if (split_guard_tree_build(&alloc, &task, 1, &options, guards, row->count, &tree)) stop("no memory");
        best = fmin(best, (double)(clock() - begin) / CLOCKS_PER_SEC);
        *leaves = tree.leaves;
        split_guard_tree_free(&alloc, &tree);
    }
    return best;
}

static void bench(const bench_row *row) {
    double *guards = malloc(row->count * (size_t)row->dim * sizeof *guards), time[WAYS];
    uint64_t leaves = 0;
    if (!guards) stop("no memory");
    scene_fill(row->scene, 1, guards, row->count, row->dim);
    for (int way = 0; way < WAYS; way++) time[way] = seconds(guards, row, (split_guard_way)way, &leaves);
    double plain = time[SPLIT_GUARD_PLAIN];
    printf("%-16s %3d %9zu %4u %9llu %8.3f %10.2f %8.2f %8.2f\n", row->name, row->dim, row->count, row->k,
           (unsigned long long)leaves, plain, time[SPLIT_GUARD_PARTITION] / plain, time[SPLIT_GUARD_PHASES] / plain,
           time[SPLIT_GUARD_HYBRID] / plain);
    fflush(stdout);
    free(guards);
}

int main(void) {
    printf("guard tree: seconds of the plain way, ratios of the others to it\n");
    printf("%-16s %3s %9s %4s %9s %8s %10s %8s %8s\n", "guards", "dim", "count", "k", "leaves", "plain", "partition",
           "phases", "hybrid");
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) bench(&rows[i]);
    return 0;
}
