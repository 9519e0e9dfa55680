/* classes.c: small ranges by one location in cubes of all sizes, beside the search of a tree.
 *
 *     bench_classes [N]        default: 100,000
 *
 * Segments anywhere in the unit square whose lengths are drawn evenly by their logarithm from 2^-SPAN to 1 times the
 * greatest, in trees of density and of index; balls and windows around ends of random segments, as large as so many
 * times the segment, or of one size. One thread, processor time; both walks take turns, medians of ROUNDS rounds.
 * Answers are compared. */
#include "bench.h"
#include <froe/query.h>
#include <malloc.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { ROUNDS = 5, RANGES = 10000, WALKS = 2 };
static const froe_walk walks[WALKS] = {FROE_WALK_AUTO, FROE_WALK_CLASSES};

/* The greatest length: just below a power of two, about as long as it is from one segment to the next. */
static double longest(size_t n) {
    return 0.999 * exp2(ceil(-0.5 * log2((double)n)));
}

static froe_scene *segments(size_t n, int span) {
    double *xyxy = bench_take(n, 4 * sizeof *xyxy);
    uint64_t state = 1;
    for (size_t i = 0; i < n; i++) {
        const double length = exp2(-span * bench_unit(&state)) * longest(n), turn = 6.283 * bench_unit(&state);
        double *s = xyxy + 4 * i;
        s[0] = bench_unit(&state), s[1] = bench_unit(&state);
        s[2] = s[0] + length * cos(turn), s[3] = s[1] + length * sin(turn);
    }
    froe_scene *scene = bench_segments(xyxy, n);
    free(xyxy);
    return scene;
}

/* Around ends of random segments: `times` the segment, or, if that is 0, of size `fixed`. */
static void place(const froe_scene *scene, froe_range_shape shape, double times, double fixed, froe_range *ranges,
                  double *points) {
    uint64_t state = 7;
    for (size_t i = 0; i < RANGES; i++) {
        const uint32_t object = (uint32_t)(bench_unit(&state) * (double)froe_scene_object_count(scene));
        const double *a = froe_scene_vertex(scene, froe_scene_corner(scene, object, 0));
        const double *b = froe_scene_vertex(scene, froe_scene_corner(scene, object, 1));
        const double reach = times > 0 ? times * fmax(fabs(a[0] - b[0]), fabs(a[1] - b[1])) / 2 : fixed;
        double *p = points + 4 * i;
        const bool ball = shape == FROE_SHAPE_BALL;
        for (int k = 0; k < 2; k++) {
            p[k] = ball ? a[k] : a[k] - reach;
            p[2 + k] = a[k] + reach;
        }
        ranges[i] = froe_range_defaults();
        ranges[i].shape = shape;
        ranges[i].points = p;
        ranges[i].radius = reach;
    }
}

static uint64_t ask(froe_query *q, froe_range *ranges, froe_walk walk) {
    uint64_t sum = 0, count;
    for (size_t i = 0; i < RANGES; i++) {
        ranges[i].walk = walk;
        bench_must(froe_query_count(q, ranges + i, &count, NULL), NULL);
        sum += count;
    }
    return sum;
}

static void time_ranges(froe_query *q, const froe_scene *scene, froe_range_shape shape, double times, double fixed) {
    static froe_range ranges[RANGES];
    static double points[4 * RANGES];
    double seconds[WALKS][ROUNDS];
    uint64_t sums[WALKS] = {0};
    froe_query_stats stats[WALKS] = {{0}};
    place(scene, shape, times, fixed, ranges, points);
    for (int round = -1; round < ROUNDS; round++)
        for (int w = 0; w < WALKS; w++) {
            froe_query_statistics(q);
            const double start = bench_cpu();
            sums[w] = ask(q, ranges, walks[w]);
            if (round >= 0) seconds[w][round] = bench_cpu() - start;
            stats[w] = froe_query_statistics(q);
        }
    times > 0 ? printf("%-5s %6.2f x    ", froe_range_shape_name(shape), times)
              : printf("%-5s %9.2g  ", froe_range_shape_name(shape), fixed);
    printf("%8.2f", (double)sums[0] / RANGES);
    for (int w = 0; w < WALKS; w++)
        printf("  %8.1f %8.1f %8.1f %8.2f", (double)stats[w].nodes / RANGES, (double)stats[w].leaves / RANGES,
               (double)stats[w].tests / RANGES, 1e6 * bench_median(seconds[w], ROUNDS) / RANGES);
    printf("   %.2f %s\n", bench_median(seconds[0], ROUNDS) / bench_median(seconds[1], ROUNDS),
           sums[0] == sums[1] ? "equal" : "ANSWERS DIFFER");
    fflush(stdout);
}

static double heap(void) {
    const struct mallinfo2 m = mallinfo2();
    return (double)(m.uordblks + m.hblkhd);
}

static void bench(size_t n, int span, const char *method) {
    froe_scene *scene = segments(n, span);
    double seconds;
    froe_tree *tree = bench_build(scene, method, NULL, FROE_LEAF_OWN, 1, &seconds);
    const double point[2] = {0, 0};
    froe_query *q;
    froe_range first = froe_range_defaults();
    uint64_t count;
    bench_must(froe_query_new(tree, &q, NULL), NULL);
    first.shape = FROE_SHAPE_BALL, first.points = point, first.walk = FROE_WALK_CLASSES;
    const double before = heap(), start = bench_cpu();
    bench_must(froe_query_count(q, &first, &count, NULL), NULL);
    printf("\n%zu segments, lengths 2^-%d to 1, %s, built in %.2f s, %.0f bytes each; classes in %.2f s, %.0f bytes\n",
           n, span, method, seconds, (double)froe_tree_report(tree).bytes / (double)n, bench_cpu() - start,
           (heap() - before) / (double)n);
    printf("%-16s %8s  %-35s  %-35s   tree : classes\n%-16s %8s", "", "", "tree", "classes", "", "found");
    for (int w = 0; w < WALKS; w++) printf("  %8s %8s %8s %8s", "nodes", "leaves", "tests", "us");
    printf("\n");
    for (int shape = 0; shape < 2; shape++) {
        time_ranges(q, scene, (froe_range_shape)shape, 0.01, 0);
        time_ranges(q, scene, (froe_range_shape)shape, 0.5, 0);
        time_ranges(q, scene, (froe_range_shape)shape, 2, 0);
        time_ranges(q, scene, (froe_range_shape)shape, 0, longest(n) * exp2(-span - 2));
    }
    froe_query_free(q);
    froe_tree_free(tree);
    froe_scene_free(scene);
}

int main(int argc, char **argv) {
    const size_t n = argc > 1 ? strtoull(argv[1], NULL, 10) : 100000;
    bench_head("cells of all classes of sizes, one thread, medians of 5 rounds by processor time", 1);
    for (int span = 0; span <= 8; span += 4) bench(n, span, "density");
    bench(n, 0, "index");
    return 0;
}
