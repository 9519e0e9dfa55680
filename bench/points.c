/* points.c: nearest points and points in balls: trees of froe beside nanoflann.
 *
 *     bench_points [N [FILE...]]        default: 10^6 random points in the plane and in space
 *
 * Of a FILE its vertices. One thread, processor time. In every round each program answers the same questions, one
 * program after the other; a rate is the median of 5 rounds, a ratio that of the medians. Answers are compared, all of
 * them: doubles that say which of two points is nearer, or that one is in a ball, are right for all but ties. */
#include "peers/points.h"
#include "bench.h"
#include <froe/query.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { ROUNDS = 5, QUESTIONS = 10000 };

/* One of froe's, by method and leaf. */
static const struct {
    const char *method;
    uint32_t leaf;
} trees[] = {{"index", FROE_LEAF_OWN}, {"kd", 32}, {"bar", 32}};
enum { TREES = sizeof trees / sizeof *trees };

typedef struct column {
    double rate[ROUNDS], sum;
} column;

typedef struct run {
    const char *name;
    int dim;
    size_t n;
    double *points, *asked;
    froe_scene *scene;
    froe_tree *tree[TREES];
    froe_query *query[TREES];
    const points_peer *peer;
    void *index;
    uint32_t *out;
    column columns[TREES + 1]; /* the peer last */
} run;

/* ------------------------------------------------------------------- output -- */

static void print(run *r, const char *what, bool less) {
    double median[TREES + 1], best = 0;
    bool equal = true;
    printf("%-16s %-12s", r->name, what);
    for (int t = 0; t <= TREES; t++) {
        median[t] = bench_median(r->columns[t].rate, ROUNDS);
        equal = equal && r->columns[t].sum == r->columns[TREES].sum;
        printf(" %10.4g", median[t]);
    }
    for (int t = 0; t < TREES; t++) {
        const double ratio = less ? median[TREES] / median[t] : median[t] / median[TREES];
        if (ratio > best) best = ratio;
        printf("  %6.2f", ratio);
    }
    printf("  %6.2f %s\n", best, equal ? "equal" : "ANSWERS DIFFER");
    fflush(stdout);
}

static void print_title(const run *r) {
    printf("\n%s: %zu points, dim %d\n%-16s %-12s", r->name, r->n, r->dim, "", "");
    for (int t = 0; t < TREES; t++) printf(" %10s", trees[t].method);
    printf(" %10s", r->peer->name);
    for (int t = 0; t < TREES; t++) printf(" %7s", trees[t].method);
    printf(" best : %s\n", r->peer->name);
}

/* ------------------------------------------------------------------- scenes -- */

/* Places all over the bounds of the points. */
static void make_questions(run *r, uint64_t *state) {
    double lo[3], hi[3];
    froe_scene_bounds(r->scene, lo, hi);
    r->asked = bench_take((size_t)QUESTIONS * ROUNDS * (size_t)r->dim, sizeof *r->asked);
    for (size_t i = 0; i < (size_t)QUESTIONS * ROUNDS; i++) {
        const size_t near = bench_draw(state) % r->n; /* every other one near a point */
        for (int k = 0; k < r->dim; k++) {
            const double reach = hi[k] - lo[k], shift = (bench_unit(state) - 0.5) * reach / sqrt((double)r->n);
            r->asked[i * (size_t)r->dim + (size_t)k] =
                i % 2 ? r->points[near * (size_t)r->dim + (size_t)k] + shift : lo[k] + bench_unit(state) * reach;
        }
    }
}

static void make_scene(run *r) {
    froe_diagnostic diag = {0};
    froe_objects o = froe_objects_defaults();
    o.kind = FROE_POINT, o.count = r->n, o.coords = r->points;
    bench_must(froe_scene_new(r->dim, NULL, &r->scene), NULL);
    bench_must(froe_scene_add(r->scene, &o, &diag), &diag);
    r->peer = r->dim == 2 ? &peer_nanoflann_2 : &peer_nanoflann_3;
    r->out = bench_take(r->n, sizeof *r->out);
}

static run random_points(int dim, size_t n) {
    run r = {.name = dim == 2 ? "plane" : "space", .dim = dim, .n = n};
    uint64_t state = bench_state((uint64_t)dim << 40);
    r.points = bench_take(n * (size_t)dim, sizeof *r.points);
    for (size_t i = 0; i < n * (size_t)dim; i++) r.points[i] = bench_unit(&state);
    return r;
}

static run vertices(const char *path, size_t most, char name[32]) {
    froe_scene *scene = bench_read(path);
    run r = {.name = name, .dim = froe_scene_dim(scene), .n = froe_scene_vertex_count(scene)};
    const size_t dim = (size_t)r.dim;
    if (r.n > most) r.n = most;
    bench_name(path, name);
    r.points = bench_take(r.n * dim, sizeof *r.points);
    for (size_t i = 0; i < r.n * dim; i++) r.points[i] = froe_scene_vertex(scene, (uint32_t)(i / dim))[i % dim];
    froe_scene_free(scene);
    return r;
}

/* ---------------------------------------------------------------- questions -- */

/* What is asked: k neighbours, or balls of a radius. */
typedef struct question {
    const char *name;
    size_t k;
    double radius;
} question;

static size_t ask_froe(froe_query *query, const question *what, const double *x, uint32_t *out) {
    if (what->k) {
        froe_neighbours found;
        bench_must(froe_query_near(query, x, what->k, INFINITY, &found, NULL), NULL);
        for (size_t i = 0; i < found.count; i++) out[i] = found.items[i].object;
        return found.count;
    }
    froe_range range = froe_range_defaults();
    froe_list found;
    range.shape = FROE_SHAPE_BALL, range.points = x, range.radius = what->radius;
    bench_must(froe_query_range(query, &range, &found, NULL), NULL);
    for (size_t i = 0; i < found.count; i++) out[i] = found.ids[i];
    return found.count;
}

static size_t ask(run *r, int t, const question *what, const double *x) {
    if (t < TREES) return ask_froe(r->query[t], what, x, r->out);
    return what->k ? r->peer->near(r->index, x, what->k, r->out) : r->peer->ball(r->index, x, what->radius, r->out);
}

static double checksum(const uint32_t *ids, size_t count) {
    double sum = (double)count;
    for (size_t i = 0; i < count; i++) sum += (double)(ids[i] * 2654435761u >> 12);
    return sum;
}

/* All programs in turn, on a share of the places. */
static void time_question(run *r, const question *what, size_t share) {
    for (int t = 0; t <= TREES; t++) r->columns[t].sum = 0;
    for (size_t round = 0; round < ROUNDS; round++)
        for (int t = 0; t <= TREES; t++) {
            const double *x = r->asked + round * QUESTIONS * (size_t)r->dim, start = bench_cpu();
            double sum = 0;
            for (size_t i = 0; i < share; i++) sum += checksum(r->out, ask(r, t, what, x + i * (size_t)r->dim));
            r->columns[t].rate[round] = (double)share / (bench_cpu() - start);
            r->columns[t].sum += sum;
        }
    print(r, what->name, false);
}

/* Of balls that hold so many of points spread evenly over the bounds. */
static double radius_for(const run *r, double count) {
    double lo[3], hi[3], volume = 1;
    froe_scene_bounds(r->scene, lo, hi);
    for (int k = 0; k < r->dim; k++) volume *= hi[k] - lo[k];
    const double share = volume * count / (double)r->n;
    return r->dim == 2 ? sqrt(share / 3.141592653589793) : cbrt(share * 3 / 4 / 3.141592653589793);
}

static void time_builds(run *r) {
    for (int round = 0; round < ROUNDS; round++) {
        for (int t = 0; t < TREES; t++) {
            froe_tree_free(r->tree[t]);
            const double start = bench_cpu();
            r->tree[t] = bench_build(r->scene, trees[t].method, NULL, trees[t].leaf, 1, NULL);
            r->columns[t].rate[round] = bench_cpu() - start;
        }
        if (r->index) r->peer->free(r->index);
        const double start = bench_cpu();
        r->index = r->peer->build(r->points, r->n);
        r->columns[TREES].rate[round] = bench_cpu() - start;
    }
    for (int t = 0; t < TREES; t++) bench_must(froe_query_new(r->tree[t], r->query + t, NULL), NULL);
    print(r, "build, s", true);
}

/* -------------------------------------------------------------------- whole -- */

static void bench(run r) {
    uint64_t state = bench_state(7);
    make_scene(&r);
    make_questions(&r, &state);
    print_title(&r);
    time_builds(&r);
    const question questions[] = {{"nearest", 1, 0},
                                  {"10 nearest", 10, 0},
                                  {"ball of 10", 0, radius_for(&r, 10)},
                                  {"ball of 1000", 0, radius_for(&r, 1000)}};
    for (int i = 0; i < 4; i++) time_question(&r, questions + i, i == 3 ? QUESTIONS / 20 : QUESTIONS);
    for (int t = 0; t < TREES; t++) froe_query_free(r.query[t]), froe_tree_free(r.tree[t]);
    r.peer->free(r.index);
    froe_scene_free(r.scene);
    free(r.points), free(r.asked), free(r.out);
}

int main(int argc, char **argv) {
    const size_t n = argc > 1 ? strtoull(argv[1], NULL, 10) : 1000000;
    char name[32];
    bench_head("nearest points and points in balls, one thread, medians of 5 rounds by processor time", 1);
    printf("# rates are questions a second\n");
    for (int dim = 2; dim <= 3 && argc <= 2; dim++) bench(random_points(dim, n));
    for (int i = 2; i < argc; i++) bench(vertices(argv[i], n, name));
    return 0;
}
