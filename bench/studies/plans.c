/* plans.c: segments by way of their endpoints: what searches cost on trees converted from different plans.
 *
 *     bench_plans [KIND [N]]      default: disjoint 50000
 *
 * Nodes visited a search, at fixed ranges, against 1/eps and against n; fat windows and long thin ranges askew, which
 * kd-trees have no bound for (de Berg and Streppel: Approximate range searching using binary space partitions, 2004,
 * theorem 1 and corollary 2). */
#include "bench.h"
#include <froe/query.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { PLACES = 100, STEPS = 9, DOUBLINGS = 5 };

/* What stands in a column: a method with its settings. */
typedef struct column {
    const char *name, *method, *settings;
} column;
static const column columns[] = {{"from kd", "converted", "from=kd"},
                                 {"from bar", "converted", "from=bar"},
                                 {"from quad", "converted", "from=quad"},
                                 {"from median", "converted", "from=median"},
                                 {"ham-sandwich", "converted", "from=hamsandwich"},
                                 {"kd", "kd", NULL},
                                 {"bar", "bar", NULL},
                                 {"density", "density", NULL}};
enum { COLUMNS = sizeof columns / sizeof *columns };

/* A window of a third of the scene, or a capsule as long as that and a thousandth as wide, at 30 degrees. */
static froe_range range_at(const double *lo, const double *hi, bool thin, double eps, uint64_t *state,
                           double points[4]) {
    froe_range r = froe_range_defaults();
    const double side = fmax(hi[0] - lo[0], hi[1] - lo[1]), turn[2] = {0.8660254037844386, 0.5};
    for (int k = 0; k < 2; k++) {
        points[k] = lo[k] + 0.6 * bench_unit(state) * (hi[k] - lo[k]);
        points[2 + k] = points[k] + side / 3 * (thin ? turn[k] : 1);
    }
    r.shape = thin ? FROE_SHAPE_CAPSULE : FROE_SHAPE_BOX;
    r.radius = thin ? side / 3000 : 0;
    r.points = points;
    r.eps = eps;
    return r;
}

/* Nodes visited by a search, on average; *found: objects counted. */
static double visits(const froe_tree *tree, bool thin, double eps, double *found) {
    uint64_t state = 1, sum = 0;
    double lo[2], hi[2];
    froe_query *q;
    froe_diagnostic why = {0};
    if (froe_query_new(tree, &q, &why) || !froe_scene_bounds(froe_tree_scene(tree), lo, hi)) exit(1);
    for (int i = 0; i < PLACES; i++) {
        double points[4];
        uint64_t count;
        const froe_range r = range_at(lo, hi, thin, eps, &state, points);
        if (froe_query_count(q, &r, &count, &why)) {
            fprintf(stderr, "bench_plans: %s\n", why.message);
            exit(1);
        }
        sum += count;
    }
    *found = (double)sum / PLACES;
    const double nodes = (double)froe_query_statistics(q).nodes / PLACES;
    froe_query_free(q);
    return nodes;
}

static void head(const char *first, const char *last) {
    printf("%10s", first);
    for (size_t i = 0; i < COLUMNS; i++) printf("%14s", columns[i].name);
    printf("%14s\n", last);
}

static void table_of_eps(froe_tree *const *trees, bool thin) {
    double found = 0;
    printf("\nnodes visited a search, %s\n", thin ? "long thin ranges askew" : "windows of a third of the scene");
    head("1/eps", "counted");
    for (int step = 0; step <= STEPS; step++) {
        const double eps = step < STEPS ? ldexp(1, -step) : 0;
        step < STEPS ? printf("%10.0f", 1 / eps) : printf("%10s", "exact");
        for (size_t i = 0; i < COLUMNS; i++) printf("%14.1f", visits(trees[i], thin, eps, &found));
        printf("%14.1f\n", found);
    }
}

static void table_of_trees(froe_tree *const *trees) {
    printf("\n%16s%10s%10s%10s%16s\n", "", "pieces/n", "nodes/n", "height", "size/(n log n)");
    for (size_t i = 0; i < COLUMNS; i++) {
        const froe_report r = froe_tree_report(trees[i]);
        const double n = (double)r.objects;
        printf("%16s%10.2f%10.2f%10.0f%16.3f\n", columns[i].name, (double)r.fragments / n, (double)r.nodes / n,
               (double)r.height, (double)r.size / (n * log2(n)));
    }
}

static void table_of_n(const char *kind, size_t n) {
    double found = 0;
    printf("\nnodes visited a search, windows of a third of the scene, eps = 1/8\n");
    head("n", "counted");
    for (int doubling = 0; doubling <= DOUBLINGS; doubling++) {
        const size_t objects = n >> (DOUBLINGS - doubling);
        froe_scene *scene = bench_generate(kind, objects, 1);
        printf("%10zu", objects);
        for (size_t i = 0; i < COLUMNS; i++) {
            froe_tree *tree = bench_build(scene, columns[i].method, columns[i].settings, 1, 1, NULL);
            printf("%14.1f", visits(tree, false, 0.125, &found));
            froe_tree_free(tree);
        }
        printf("%14.1f\n", found);
        froe_scene_free(scene);
    }
}

int main(int argc, char **argv) {
    const char *kind = argc > 1 ? argv[1] : "disjoint";
    const size_t n = argc > 2 ? strtoul(argv[2], NULL, 10) : 50000;
    froe_scene *scene = bench_generate(kind, n, 1);
    froe_tree *trees[COLUMNS] = {NULL};
    bench_head("plans", 1);
    printf("%s, %zu segments\n", kind, froe_scene_object_count(scene));
    for (size_t i = 0; i < COLUMNS; i++)
        trees[i] = bench_build(scene, columns[i].method, columns[i].settings, 1, 1, NULL);
    table_of_trees(trees);
    table_of_eps(trees, false);
    table_of_eps(trees, true);
    for (size_t i = 0; i < COLUMNS; i++) froe_tree_free(trees[i]);
    froe_scene_free(scene);
    table_of_n(kind, n);
    return 0;
}
