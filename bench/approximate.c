/* approximate.c: what is gained by asking within eps, and how fast that is beside CGAL.
 *
 *     bench_approximate [FILE...]
 *
 * Points, in the plane and in space: those that lie in balls of about 10 and 1000 points, in trees of bar and by CGAL's
 * Fuzzy_sphere, which take turns. Then objects of the files, by way of windows with about 1000 of them, and the
 * vertices of the files as points.
 *
 * One thread, processor time, medians of ROUNDS rounds. Surplus: reported beyond the exact answer, of which it is the
 * share. Both answers are checked: what they must have and what they may have, and the same when eps is 0. */
#include "bench.h"
#include "peers/fuzzy.h"
#include <froe/query.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ROUNDS = 5, BALLS = 400, HALVINGS = 40, EPSILONS = 4 };
static const double epsilons[EPSILONS] = {0, 0.01, 0.1, 1};

/* ------------------------------------------------------------------- ranges -- */

/** Ranges around points of the scene, each with about as many objects as asked for. */
typedef struct ranges {
    froe_range range[BALLS];
    double points[BALLS][2 * FROE_MAX_DIM];
    uint64_t exact[BALLS];
    double found; /* on average */
} ranges;

static uint64_t count(froe_query *q, const froe_range *range) {
    froe_diagnostic why;
    uint64_t found;
    bench_must(froe_query_count(q, range, &found, &why), &why);
    return found;
}

static void resize(froe_range *r, double *points, int dim, const double *centre, double size) {
    r->radius = size;
    for (int k = 0; k < dim; k++) {
        points[k] = r->shape == FROE_SHAPE_BALL ? centre[k] : centre[k] - size;
        points[dim + k] = centre[k] + size;
    }
}

/** Halves between nothing and everything, by size. */
static void fit(froe_query *q, froe_range *r, double *points, int dim, const double *centre, double most,
                uint64_t target) {
    double low = 0, high = most;
    r->points = points;
    for (int i = 0; i < HALVINGS; i++) {
        const double size = i < HALVINGS / 2 && low == 0 ? high / 4 : (low + high) / 2;
        resize(r, points, dim, centre, size);
        const uint64_t found = count(q, r);
        if (found == target) return;
        *(found < target ? &low : &high) = size;
    }
    resize(r, points, dim, centre, high);
}

static void make_ranges(const froe_tree *tree, froe_range_shape shape, uint64_t target, ranges *out) {
    const froe_scene *scene = froe_tree_scene(tree);
    const int dim = froe_scene_dim(scene);
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM], most = 0;
    uint64_t state = 5;
    froe_query *q;
    froe_diagnostic why;
    bench_must(froe_query_new(tree, &q, &why), &why);
    froe_scene_bounds(scene, lo, hi);
    for (int k = 0; k < dim; k++) most += hi[k] - lo[k];
    out->found = 0;
    for (int i = 0; i < BALLS; i++) {
        const uint32_t object = (uint32_t)(bench_unit(&state) * (double)froe_scene_object_count(scene));
        const double *centre = froe_scene_vertex(scene, froe_scene_corner(scene, object, 0));
        out->range[i] = froe_range_defaults();
        out->range[i].shape = shape;
        fit(q, out->range + i, out->points[i], dim, centre, most, target);
        out->exact[i] = count(q, out->range + i);
        out->found += (double)out->exact[i] / BALLS;
    }
    froe_query_free(q);
}

/* ------------------------------------------------------------------- asking -- */

/** One of those that take turns: a tree, or a library's index of the points. */
typedef struct column {
    const char *name;
    froe_query *query;
    froe_tree *tree;
    const fuzzy_peer *peer;
    void *index;
    double seconds[EPSILONS][ROUNDS], reported[EPSILONS];
} column;

static column column_of_tree(const char *name, froe_scene *scene, const char *method, uint32_t leaf) {
    column c = {.name = name};
    froe_diagnostic why;
    c.tree = bench_build(scene, method, NULL, leaf, 1, NULL);
    bench_must(froe_query_new(c.tree, &c.query, &why), &why);
    return c;
}

static void column_free(column *c) {
    froe_query_free(c->query);
    froe_tree_free(c->tree);
    if (c->index) c->peer->free(c->index);
}

/** Everything in the range and nothing further than eps diameters from it: written to out by a library, kept by the
 * query of a tree. */
static froe_list answer(const column *c, const froe_range *exact, double eps, uint32_t *out) {
    froe_range range = *exact;
    froe_list found;
    froe_diagnostic why;
    const double margin = eps * 2 * range.radius;
    range.eps = eps;
    if (c->peer)
        return (froe_list){out, c->peer->ball(c->index, range.points, range.radius + margin / 2, margin / 2, out)};
    bench_must(froe_query_range(c->query, &range, &found, &why), &why);
    return found;
}

static void ask_all(column *c, const ranges *r, int e, int round, uint32_t *out) {
    uint64_t sum = 0;
    const double start = bench_cpu();
    for (int i = 0; i < BALLS; i++) sum += answer(c, r->range + i, epsilons[e], out).count;
    c->seconds[e][round] = (bench_cpu() - start) / BALLS;
    c->reported[e] = (double)sum / BALLS;
}

/** Marks the objects found in the range, grown by so many of its diameters, with a bit; how many. Of a box corners are
 * not rounded: that is more than what lies so near. */
static size_t mark(froe_query *q, const froe_range *exact, int dim, double eps, uint8_t bit, uint8_t *marks) {
    froe_range range = *exact;
    froe_list found;
    froe_diagnostic why;
    double points[2 * FROE_MAX_DIM];
    const bool ball = range.shape == FROE_SHAPE_BALL;
    const double margin = eps * 2 * range.radius * (ball ? 1 : sqrt(dim)) * (1 + 1e-12);
    for (int k = 0; k < dim; k++) {
        points[k] = range.points[k] - (ball ? 0 : margin);
        points[dim + k] = range.points[dim + k] + (ball ? 0 : margin);
    }
    range.points = points;
    range.radius += margin;
    bench_must(froe_query_range(q, &range, &found, &why), &why);
    for (size_t j = 0; j < found.count; j++) marks[found.ids[j]] |= bit;
    return found.count;
}

/** Has an answer all that it must have, and nothing that it must not? Some of them; marks: 1 must, 2 may. */
static void check(const column *c, const column *judge, const ranges *r, double eps, uint32_t *out, uint8_t *marks) {
    const froe_scene *scene = froe_tree_scene(judge->tree);
    for (int i = 0; i < BALLS; i += 20) {
        size_t strange = 0;
        memset(marks, 0, froe_scene_object_count(scene));
        size_t missing = mark(judge->query, r->range + i, froe_scene_dim(scene), 0, 1, marks);
        mark(judge->query, r->range + i, froe_scene_dim(scene), eps, 2, marks);
        const froe_list found = answer(c, r->range + i, eps, out);
        for (size_t j = 0; j < found.count; j++) missing -= marks[found.ids[j]] & 1, strange += !marks[found.ids[j]];
        if (missing || strange) printf("%s: WRONG: %zu missing, %zu too far\n", c->name, missing, strange);
    }
}

static void compare(const char *what, column *columns, int count, froe_scene *scene, froe_range_shape shape,
                    uint64_t target) {
    const size_t n = froe_scene_object_count(scene);
    uint32_t *out = bench_take(n, sizeof *out);
    uint8_t *marks = bench_take(n, 1);
    ranges *r = bench_take(1, sizeof *r);
    make_ranges(columns[0].tree, shape, target, r);
    for (int e = 0; e < EPSILONS; e++)
        for (int round = 0; round < ROUNDS; round++)
            for (int i = 0; i < count; i++) ask_all(columns + i, r, e, round, out);
    printf("\n%s, n = %zu, %s with %.1f: microseconds (surplus)\n\n| |", what, n, froe_range_shape_name(shape),
           r->found);
    for (int e = 0; e < EPSILONS; e++) printf(" eps = %g |", epsilons[e]);
    printf("\n|---|");
    for (int e = 0; e < EPSILONS; e++) printf("---|");
    for (int i = 0; i < count; i++) {
        column *c = columns + i;
        printf("\n| %s |", c->name);
        for (int e = 0; e < EPSILONS; e++) {
            check(c, columns, r, epsilons[e], out, marks);
            printf(" %.2f (%.1f%%) |", 1e6 * bench_median(c->seconds[e], ROUNDS),
                   100 * fmax(0, c->reported[e] / r->found - 1)); /* check() has seen that nothing lacks */
        }
    }
    printf("\n");
    fflush(stdout);
    free(r), free(marks), free(out);
}

/* ------------------------------------------------------------------- scenes -- */

static void bench_points(const char *what, int dim, double *points, size_t n) {
    froe_scene *scene;
    froe_diagnostic why;
    froe_objects o = froe_objects_defaults();
    o.kind = FROE_POINT, o.count = n, o.coords = points;
    bench_must(froe_scene_new(dim, NULL, &scene), &why);
    bench_must(froe_scene_add(scene, &o, &why), &why);
    const fuzzy_peer *peer = dim == 2 ? &peer_fuzzy_2 : &peer_fuzzy_3;
    column columns[] = {column_of_tree("bar", scene, "bar", FROE_LEAF_OWN),
                        column_of_tree("bar, leaf 32", scene, "bar", 32),
                        column_of_tree("kd, leaf 32", scene, "kd", 32),
                        {.name = peer->name, .peer = peer, .index = peer->build(points, n)}};
    const int count = sizeof columns / sizeof *columns;
    compare(what, columns, count, scene, FROE_SHAPE_BALL, 10);
    compare(what, columns, count, scene, FROE_SHAPE_BALL, 1000);
    for (int i = 0; i < count; i++) column_free(columns + i);
    froe_scene_free(scene);
    free(points);
}

static void bench_uniform(int dim, size_t n) {
    double *x = bench_take(n * (size_t)dim, sizeof *x);
    uint64_t state = 7;
    for (size_t i = 0; i < n * (size_t)dim; i++) x[i] = bench_unit(&state);
    bench_points(dim == 2 ? "Points in the plane" : "Points in space", dim, x, n);
}

/** Only for files of objects that are no points. */
static void bench_file(const char *path) {
    char name[32], what[64];
    froe_scene *scene = bench_read(path);
    const int dim = froe_scene_dim(scene);
    const size_t n = froe_scene_vertex_count(scene);
    bench_name(path, name);
    column columns[] = {column_of_tree("bar", scene, "bar", FROE_LEAF_OWN),
                        column_of_tree("bar, leaf 8", scene, "bar", 8),
                        column_of_tree("density, leaf 8", scene, "density", 8)};
    compare(name, columns, 3, scene, FROE_SHAPE_BOX, 1000);
    compare(name, columns, 3, scene, FROE_SHAPE_BALL, 1000);
    for (int i = 0; i < 3; i++) column_free(columns + i);
    double *points = bench_take(n * (size_t)dim, sizeof *points);
    for (uint32_t i = 0; i < n; i++)
        memcpy(points + i * (size_t)dim, froe_scene_vertex(scene, i), (size_t)dim * sizeof *points);
    froe_scene_free(scene);
    snprintf(what, sizeof what, "Vertices of %s", name);
    bench_points(what, dim, points, n);
}

int main(int argc, char **argv) {
    bench_head("approximate", 1);
    bench_uniform(2, 100000);
    bench_uniform(3, 100000);
    for (int i = 1; i < argc; i++) bench_file(argv[i]);
    return 0;
}
