/* ranges.c: what ranges cost: nodes visited against 1/eps at fixed ranges, and processor time against n.
 *
 *     bench_ranges [KIND [N [LARGEST]]]      default: scatter, 200,000 for eps, up to 1,000,000 for growth
 *
 * de Berg and Streppel (Approximate range searching using binary space partitions, 2004): on scenes of low density
 * the cells to visit grow no faster than 1/eps in the plane, and stop where the exact search stops. */
#include "bench.h"
#include <froe/query.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { PLACES = 64, STEPS = 12, RISING = 6, WINDOWS = 20000, MOST = 16 };

static void fail(const froe_diagnostic *why) {
    fprintf(stderr, "bench_ranges: %s\n", why->message);
    exit(1);
}

/* Places are given in the unit square; the scene may be elsewhere. */
typedef struct frame {
    double lo[2], hi[2];
} frame;

static frame frame_of(const froe_scene *scene) {
    frame f = {{0, 0}, {1, 1}};
    froe_scene_bounds(scene, f.lo, f.hi);
    return f;
}

static void put(const frame *f, double x, double y, double *point) {
    point[0] = f->lo[0] + x * (f->hi[0] - f->lo[0]);
    point[1] = f->lo[1] + y * (f->hi[1] - f->lo[1]);
}

static froe_query *ask(const froe_tree *tree) {
    froe_query *q;
    froe_diagnostic why;
    if (froe_query_new(tree, &q, &why)) fail(&why);
    return q;
}

/* A shape of diameter about half the scene, at a random place. */
static froe_range place(const frame *f, froe_range_shape shape, uint64_t *state, double points[6]) {
    froe_range r = froe_range_defaults();
    const double x = 0.25 + 0.1 * bench_unit(state), y = 0.25 + 0.1 * bench_unit(state);
    r.shape = shape;
    r.points = points;
    r.radius = 0.2 * (f->hi[0] - f->lo[0]);
    const double shift = shape == FROE_SHAPE_BALL ? 0.2 : 0;
    put(f, x + shift, y + shift, points);
    put(f, x + 0.35, y + 0.3, points + 2);
    put(f, x + 0.351, y + 0.3, points + 4);
    return r;
}

static double nodes_per_query(froe_query *q, const frame *f, froe_range_shape shape, double eps, double *found) {
    uint64_t state = 1, sum = 0;
    froe_query_statistics(q);
    for (int i = 0; i < PLACES; i++) {
        double points[6];
        uint64_t count;
        froe_diagnostic why;
        froe_range r = place(f, shape, &state, points);
        r.eps = eps;
        if (froe_query_count(q, &r, &count, &why)) fail(&why);
        sum += count;
    }
    *found = (double)sum / PLACES;
    return (double)froe_query_statistics(q).nodes / PLACES;
}

static void table_of_eps(const char *kind, size_t n) {
    static const froe_range_shape shapes[] = {FROE_SHAPE_BOX, FROE_SHAPE_BALL, FROE_SHAPE_SIMPLEX};
    froe_scene *scene = bench_generate(kind, n, 1);
    froe_tree *tree = bench_build(scene, "density", NULL, 8, 1, NULL);
    froe_query *q = ask(tree);
    const frame f = frame_of(scene);
    double inverse[3][STEPS], nodes[3][STEPS], found;
    printf("nodes visited a query, %s, n = %zu, leaf 8\n%10s %12s %12s %12s\n", kind, n, "1/eps", "box", "ball",
           "thin triangle");
    for (int step = 0; step <= STEPS; step++) {
        const double eps = step < STEPS ? ldexp(1, -1 - step) : 0;
        step < STEPS ? printf("%10.0f", 1 / eps) : printf("%10s", "exact");
        for (int s = 0; s < 3; s++) {
            const double visited = nodes_per_query(q, &f, shapes[s], eps, &found);
            if (step < STEPS) inverse[s][step] = 1 / eps, nodes[s][step] = visited;
            printf(" %12.1f", visited);
        }
        printf("\n");
    }
    printf("%10s", "slope");
    for (int s = 0; s < 3; s++) printf(" %12.2f", bench_exponent(inverse[s], nodes[s], RISING));
    printf("   (of logarithms, the first %d rows)\n\n", RISING);
    froe_query_free(q);
    froe_tree_free(tree);
    froe_scene_free(scene);
}

/* Windows with about ten objects each. */
static double microseconds(froe_query *q, const frame *f, double side, double *found) {
    uint64_t state = 7, sum = 0;
    const double start = bench_cpu();
    for (int i = 0; i < WINDOWS; i++) {
        const double x = bench_unit(&state), y = bench_unit(&state);
        double points[4];
        put(f, x, y, points);
        put(f, x + side, y + side, points + 2);
        froe_range r = froe_range_defaults();
        uint64_t count;
        froe_diagnostic why;
        r.points = points;
        if (froe_query_count(q, &r, &count, &why)) fail(&why);
        sum += count;
    }
    *found = (double)sum / WINDOWS;
    return 1e6 * (bench_cpu() - start) / WINDOWS;
}

static void table_of_growth(const char *kind, size_t largest) {
    double sizes[MOST], times[MOST];
    size_t count = 0;
    printf("windows of about ten objects, %s, leaf 8\n%10s %12s %12s %12s\n", kind, "n", "found", "nodes", "cpu us");
    for (double n = 10000; n <= 1.01 * (double)largest && count < MOST; n *= 3.1623) {
        froe_scene *scene = bench_generate(kind, (size_t)n, 1);
        froe_tree *tree = bench_build(scene, "density", NULL, 8, 1, NULL);
        froe_query *q = ask(tree);
        const frame f = frame_of(scene);
        double found, least = INFINITY;
        for (int round = 0; round < 5; round++) least = fmin(least, microseconds(q, &f, sqrt(7 / n), &found));
        const double nodes = (double)froe_query_statistics(q).nodes / (5.0 * WINDOWS);
        printf("%10.0f %12.1f %12.1f %12.3f\n", n, found, nodes, least);
        fflush(stdout);
        sizes[count] = n, times[count++] = least;
        froe_query_free(q);
        froe_tree_free(tree);
        froe_scene_free(scene);
    }
    if (count > 1) printf("time grows as n^%.3f\n", bench_exponent(sizes, times, count));
}

int main(int argc, char **argv) {
    const char *kind = argc > 1 ? argv[1] : "scatter";
    const size_t n = argc > 2 ? strtoull(argv[2], NULL, 10) : 200000;
    const size_t largest = argc > 3 ? strtoull(argv[3], NULL, 10) : 1000000;
    bench_head("ranges, density, one thread", 1);
    table_of_eps(kind, n);
    table_of_growth(kind, largest);
    return 0;
}
