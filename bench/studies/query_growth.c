/* query_growth.c: how the cost of a question grows with n: exponents fitted on a log-log scale, and what is visited.
 *
 *     bench_query_growth [METHOD [SMALLEST [LARGEST]]]      default: index, 10^4 to 10^7
 *
 * Disjoint short segments at random. Windows hold about ten of them, places are anywhere, points to locate are ends of
 * segments, and of pairs there is one question, given for each segment; so answers stay as large, and whatever grows is
 * the search. One thread, the least processor time of three rounds. */
#include "bench.h"
#include <froe/query.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { ROUNDS = 3, QUESTIONS = 50000, MOST = 16 };

typedef struct subject {
    size_t n;
    froe_scene *scene;
    froe_query *query;
    double lo[2], hi[2], side;
    uint64_t state;
} subject;

/* Asks one question; how many answers there were. */
typedef size_t ask_fn(subject *s);

static void anywhere(subject *s, double x[2]) {
    for (int k = 0; k < 2; k++) x[k] = s->lo[k] + bench_unit(&s->state) * (s->hi[k] - s->lo[k]);
}

static size_t ask_window(subject *s) {
    double w[4];
    froe_range range = froe_range_defaults();
    froe_list found;
    anywhere(s, w);
    w[2] = w[0] + s->side, w[3] = w[1] + s->side;
    range.points = w;
    bench_must(froe_query_range(s->query, &range, &found, NULL), NULL);
    return found.count;
}

static size_t ask_above(subject *s) {
    double x[2];
    uint32_t object;
    anywhere(s, x);
    bench_must(froe_query_vertical(s->query, x, 1, &object, NULL), NULL);
    return object != FROE_NONE;
}

static size_t ask_locate(subject *s) {
    froe_list found;
    const uint32_t object = (uint32_t)(bench_draw(&s->state) % s->n);
    const double *x = froe_scene_vertex(s->scene, froe_scene_corner(s->scene, object, 0));
    bench_must(froe_query_locate(s->query, x, &found, NULL), NULL);
    return found.count;
}

static size_t ask_near(subject *s) {
    double x[2];
    froe_neighbours found;
    anywhere(s, x);
    bench_must(froe_query_near(s->query, x, 1, INFINITY, &found, NULL), NULL);
    return found.count;
}

static bool count_pair(void *user, const froe_pair *pair) {
    (void)pair;
    ++*(size_t *)user;
    return true;
}

static size_t ask_pairs(subject *s) {
    size_t count = 0;
    bench_must(froe_query_pairs(s->query, true, count_pair, &count, NULL), NULL);
    return count;
}

static const struct {
    const char *name;
    ask_fn *ask;
    bool once; /* for all objects */
} kinds[] = {{"window", ask_window, false},
             {"above", ask_above, false},
             {"locate", ask_locate, false},
             {"near", ask_near, false},
             {"pairs", ask_pairs, true}};
enum { KINDS = sizeof kinds / sizeof *kinds };

/* Per question, or per object where one question is about all. */
typedef struct cost {
    double n[MOST], time[MOST], nodes[MOST], leaves[MOST], found[MOST];
    size_t count;
} cost;

static double round_of(subject *s, int kind, size_t questions, size_t *found) {
    const double start = bench_cpu();
    s->state = bench_state((uint64_t)kind << 40);
    *found = 0;
    for (size_t i = 0; i < questions; i++) *found += kinds[kind].ask(s);
    return bench_cpu() - start;
}

static void measure(subject *s, int kind, cost *c) {
    const size_t questions = kinds[kind].once ? 1 : QUESTIONS;
    const double each = kinds[kind].once ? (double)s->n : QUESTIONS;
    double least = INFINITY;
    size_t found = 0;
    kinds[kind].ask(s); /* prepares what is prepared once */
    froe_query_statistics(s->query);
    for (int round = 0; round < ROUNDS; round++) least = fmin(least, round_of(s, kind, questions, &found));
    const froe_query_stats stats = froe_query_statistics(s->query);
    c->n[c->count] = (double)s->n;
    c->time[c->count] = 1e6 * least / each;
    c->nodes[c->count] = (double)stats.nodes / (ROUNDS * each);
    c->leaves[c->count] = (double)stats.leaves / (ROUNDS * each);
    c->found[c->count] = (double)found / each;
    printf("%10zu %-8s %10.3f %10.2f %10.2f %10.2f\n", s->n, kinds[kind].name, c->time[c->count], c->nodes[c->count],
           c->leaves[c->count], c->found[c->count]);
    fflush(stdout);
    c->count++;
}

static void measure_all(const char *method, size_t n, cost *costs) {
    subject s = {.n = n, .scene = bench_generate("scatter", n, 1)};
    froe_tree *tree = bench_build(s.scene, method, NULL, FROE_LEAF_OWN, 1, NULL);
    bench_must(froe_query_new(tree, &s.query, NULL), NULL);
    froe_scene_bounds(s.scene, s.lo, s.hi);
    s.side = sqrt(6.5 * (s.hi[0] - s.lo[0]) * (s.hi[1] - s.lo[1]) / (double)n);
    for (int k = 0; k < KINDS; k++) measure(&s, k, costs + k);
    froe_query_free(s.query);
    froe_tree_free(tree);
    froe_scene_free(s.scene);
}

int main(int argc, char **argv) {
    static cost costs[KINDS];
    const char *method = argc > 1 ? argv[1] : "index";
    const double smallest = argc > 2 ? strtod(argv[2], NULL) : 1e4, largest = argc > 3 ? strtod(argv[3], NULL) : 1e7;
    char title[64];
    snprintf(title, sizeof title, "growth of queries with n, %.20s, one thread", method);
    bench_head(title, 1);
    printf("%10s %-8s %10s %10s %10s %10s\n", "n", "", "cpu us", "nodes", "leaves", "found");
    for (double n = smallest; n <= 1.01 * largest && costs[0].count < MOST; n *= 10)
        measure_all(method, (size_t)n, costs);
    for (int k = 0; k < KINDS && costs[k].count > 1; k++)
        printf("%-8s time grows as n^%.3f, leaves as n^%.3f; %.2f nodes more for ten times as many\n", kinds[k].name,
               bench_exponent(costs[k].n, costs[k].time, costs[k].count),
               bench_exponent(costs[k].n, costs[k].leaves, costs[k].count),
               (costs[k].nodes[costs[k].count - 1] - costs[k].nodes[0]) / (double)(costs[k].count - 1));
    return 0;
}
