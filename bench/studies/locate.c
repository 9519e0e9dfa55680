/* locate.c: which way to the leaf of a point is the fastest, in shallow trees of the plane and in deep ones?
 *
 *     bench_locate
 *
 * Points a second of processor time, one thread; `doubt`: the share of them that are too near to a cut of their way for
 * floats. `tree`: from the root, cut by cut. `laid out`: query/point/descent.h without a look at cuts in doubt.
 * `centroids`: query/range/centroids.h, in trees that are deep. `chosen`: what queries do, exactly, one at a time, and
 * many together. */
#include "bench.h"
#include "build/options.h"
#include "geom/predicates.h"
#include "query/point/descent.h"
#include "query/point/leaf.h"
#include "query/range/centroids.h"
#include "tree/draft.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { POINTS = 200000, CHAIN = 20000, CHUNK = 256 };

/* Points 0, 1, ... of a line, and a cut through every one: the right child is always cut again. */
static froe_tree *chain(froe_scene *scene) {
    const tree_meta meta = {.method = "chain", .leaf = 1};
    tree_draft draft;
    froe_tree *tree;
    uint32_t node = 0, child;
    bench_must(draft_new(NULL, 2, 0, &draft), NULL);
    for (uint32_t i = 0; i < CHAIN; i++, node = child + 1) {
        const froe_cut cut = {.kind = FROE_CUT_AXIS, .value = i};
        bench_must(draft_split(&draft, node, &cut, 0, &child), NULL);
        bench_must(draft_list(&draft, node), NULL);
        bench_must(draft_piece(&draft, node, i, NULL, 0), NULL);
        draft_leaf(&draft, child, 0);
    }
    draft_leaf(&draft, node, 0);
    bench_must(draft_seal(&draft, NULL, 0, scene, &meta, &tree), NULL);
    draft_free(&draft);
    return tree;
}

static froe_scene *row(void) {
    double *x = bench_take((size_t)2 * CHAIN, sizeof *x);
    froe_objects o = froe_objects_defaults();
    froe_scene *scene;
    for (size_t i = 0; i < CHAIN; i++) x[2 * i] = (double)i, x[2 * i + 1] = (double)(i % 7);
    o.kind = FROE_POINT, o.count = CHAIN, o.coords = x;
    bench_must(froe_scene_new(2, NULL, &scene), NULL);
    bench_must(froe_scene_add(scene, &o, NULL), NULL);
    free(x);
    return scene;
}

/* -------------------------------------------------------------------- ways -- */

typedef struct asker {
    froe_query *q;
    const froe_tree *tree;
    const query_centroids *centroids;
    const query_descent *descent;
} asker;

static uint32_t go_down(const asker *a, uint32_t node, const double *x) {
    while (!tree_is_leaf(a->tree->nodes + node)) {
        const tree_node *n = a->tree->nodes + node;
        const geom_plane h = tree_plane_at(a->tree, node);
        node = n->child + (geom_side_vertex(&a->q->numbers, &h, x) > 0);
    }
    return node;
}

static uint32_t by_tree(const asker *a, const double *x) {
    return go_down(a, 0, x);
}
static uint32_t by_descent(const asker *a, const double *x) {
    descent_point p;
    if (!query_descent_begin(a->descent, x, &p)) return go_down(a, 0, x);
    while (!(p.next & DESCENT_LEAF)) {
        const descent_cut *cut = a->descent->cuts + p.next;
        p.next = query_descent_next(cut, query_descent_value(cut, p.at) > 0);
    }
    return p.next & DESCENT_NODE;
}
static uint32_t by_centroids(const asker *a, const double *x) {
    uint64_t steps = 0;
    return go_down(a, query_centroid_find(a->centroids, x, x, &steps), x);
}
static uint32_t as_chosen(const asker *a, const double *x) {
    query_leaf leaf;
    bench_must(query_leaf_find(a->q, x, &leaf), NULL);
    return leaf.place;
}

static bool in_doubt(const asker *a, const double *x) {
    descent_point p;
    if (!query_descent_begin(a->descent, x, &p)) return true;
    while (!(p.next & DESCENT_LEAF)) {
        const descent_cut *cut = a->descent->cuts + p.next;
        const float value = query_descent_value(cut, p.at);
        if (!(fabsf(value) > DESCENT_DOUBT)) return true;
        p.next = query_descent_next(cut, value > 0);
    }
    return false;
}

typedef uint32_t way_fn(const asker *a, const double *x);

static double rate(const asker *a, way_fn *way, const double *points, size_t count) {
    volatile uint32_t sum = 0;
    const double start = bench_cpu();
    for (size_t i = 0; i < count; i++) sum += way(a, points + 2 * i);
    (void)sum;
    return (double)count / (bench_cpu() - start);
}

static double rate_together(const asker *a, const double *points) {
    query_leaf leaves[CHUNK];
    const double start = bench_cpu();
    for (size_t i = 0; i + CHUNK <= POINTS; i += CHUNK)
        bench_must(query_leaf_find_all(a->q, points + 2 * i, CHUNK, leaves), NULL);
    return POINTS / (bench_cpu() - start);
}

/* --------------------------------------------------------------------- rows -- */

/* Half of the points anywhere, half near objects, where trees are deep. */
static double *draw_points(const froe_scene *s) {
    double lo[2], hi[2], *points = bench_take((size_t)2 * POINTS, sizeof *points);
    uint64_t state = 1;
    if (!froe_scene_bounds(s, lo, hi)) exit(1);
    for (size_t i = 0; i < POINTS; i++) {
        const uint32_t object = (uint32_t)(bench_unit(&state) * (double)froe_scene_object_count(s));
        const double *v = froe_scene_vertex(s, froe_scene_corner(s, object, 0));
        for (int k = 0; k < 2; k++)
            points[2 * i + (size_t)k] =
                i % 2 ? v[k] * (1 + 0x1p-12 * bench_unit(&state)) : lo[k] + (hi[k] - lo[k]) * bench_unit(&state);
    }
    return points;
}

static void print_row(const char *name, froe_scene *scene, froe_tree *tree) {
    enum { FEW = 2000 };
    asker a = {.tree = tree};
    const froe_report r = froe_tree_report(tree);
    double *points = draw_points(scene);
    bench_must(froe_query_new(tree, &a.q, NULL), NULL);
    if (query_is_deep(tree)) bench_must(query_centroids_of(a.q, &a.centroids, NULL), NULL);
    bench_must(query_descent_of(a.q, &a.descent, NULL), NULL);
    size_t doubts = 0;
    for (size_t i = 0; a.descent->there && i < POINTS; i++) doubts += in_doubt(&a, points + 2 * i);
    printf("%-24s %9llu %7llu %7.3f %10.4g", name, (unsigned long long)r.nodes, (unsigned long long)r.height,
           (double)doubts / POINTS, rate(&a, by_tree, points, r.height > 1000 ? FEW : POINTS));
    a.descent->there ? printf(" %10.4g", rate(&a, by_descent, points, POINTS)) : printf(" %10s", "");
    a.centroids ? printf(" %10.4g", rate(&a, by_centroids, points, POINTS)) : printf(" %10s", "");
    printf(" %10.4g %10.4g\n", rate(&a, as_chosen, points, POINTS), rate_together(&a, points));
    fflush(stdout);
    free(points);
    froe_query_free(a.q);
    froe_tree_free(tree);
    froe_scene_free(scene);
}

static void print_built(const char *name, froe_scene *scene, const char *method, const char *settings, uint32_t leaf) {
    print_row(name, scene, bench_build_by(build_tuned, scene, method, settings, leaf, 1, NULL));
}

int main(void) {
    bench_head("the leaf of a point, points a second, one thread, processor time", 1);
    printf("%-24s %9s %7s %7s %10s %10s %10s %10s %10s\n", "", "nodes", "height", "doubt", "tree", "laid out",
           "centroids", "chosen", "together");
    froe_scene *points = row();
    print_row("chain of 20,000 cuts", points, chain(points));
    print_built("nested 10^4, guards", bench_generate("nested", 10000, 1), "density", "k=1 stop=0 growth=0 height=0",
                FROE_LEAF_OWN);
    print_built("kd, 10^6 short segments", bench_generate("scatter", 1000000, 1), "kd", NULL, FROE_LEAF_OWN);
    print_built("density, 10^6", bench_generate("scatter", 1000000, 1), "density", NULL, FROE_LEAF_OWN);
    print_built("autopartition, 10^5", bench_generate("disjoint", 100000, 1), "autopartition", NULL, 0);
    print_built("cylindrical, 10^5", bench_generate("disjoint", 100000, 1), "cylindrical", NULL, 0);
    print_built("index, 10^6", bench_generate("scatter", 1000000, 1), "index", NULL, FROE_LEAF_OWN);
    return 0;
}
