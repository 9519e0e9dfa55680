/* index.c: trees of the builder `index` beside what people use as an index of segments.
 *
 *     bench_index [N [KIND...]]        default: 10^6, of short, mixed, tin, cross; FILE: see plane.c
 *
 * One thread, processor time, but for a line that says what two do for pairs. In every round each program answers the
 * same number of queries, one program after the other; a rate is the median of 5 rounds, a ratio that of the medians.
 * Answers are compared, all of them. froe takes part once with each set of kernels that the machine can run; ratios are
 * those of the first, which it takes by itself. */
#include "bench.h"
#include "plane.h"
#include "query/packed/packed.h"
#include <malloc.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ROUNDS = 5, MOST_PATHS = 3, MOST_TRAPEZOIDS = 100000 };

static const peer *const peers[] = {
    &peer_grid,
#ifdef HAVE_BOOST
    &peer_boost,
#endif
#ifdef HAVE_GEOS
    &peer_geos,
#endif
#ifdef HAVE_CGAL
    &peer_boxes, &peer_trapezoids,
#endif
};
enum { PEERS = sizeof peers / sizeof *peers };

/* One column. */
typedef struct column {
    double rate[ROUNDS];
    double sum; /* checksum of the answers, -1: did not take part */
} column;

typedef struct run {
    plane_scene plane;
    froe_scene *scene;
    froe_tree *tree;
    size_t paths;
    froe_query *query[MOST_PATHS]; /* by sets of kernels */
    void *index[PEERS];
    uint32_t *out;
    column froe[MOST_PATHS], peer[PEERS];
} run;

/* ------------------------------------------------------------------- output -- */

static void print_title(const run *r) {
    printf("\n%s: %zu segments\n%-14s %-11s", r->plane.name, r->plane.n, "", "froe:");
    for (size_t k = 0; k < r->paths; k++) printf(" %9s", packed_kernels_at(k)->name);
    for (int p = 0; p < PEERS; p++) printf(" %10.10s", peers[p]->name);
    printf("  froe : %s   : best peer\n", PEERS > 1 ? peers[1]->name : "");
}

static void print_column(column *c) {
    if (c->sum < 0)
        printf(" %9s", "-");
    else
        printf(" %9.4g", bench_median(c->rate, ROUNDS));
}

/* How many times as good as a column the first one is. */
static double ratio(run *r, column *c, bool less) {
    const double froe = bench_median(r->froe[0].rate, ROUNDS), other = bench_median(c->rate, ROUNDS);
    return less ? other / froe : froe / other;
}

/* Rates or, `less` being better, seconds; and froe's ratio to Boost and to the best peer. */
static void print(run *r, const char *what, bool less) {
    const char *who = NULL, *equal = "equal";
    double best = 0;
    printf("%-14s %-11s", r->plane.name, what);
    for (size_t k = 0; k < r->paths; k++) {
        print_column(r->froe + k);
        if (r->froe[k].sum >= 0 && r->froe[k].sum != r->froe[0].sum) equal = "ANSWERS DIFFER";
    }
    for (int p = 0; p < PEERS; p++) {
        printf(" ");
        print_column(r->peer + p);
        if (r->peer[p].sum < 0) continue;
        const double here = ratio(r, r->peer + p, less);
        if (!who || here < best) best = here, who = peers[p]->name;
        if (r->peer[p].sum != r->froe[0].sum) equal = "ANSWERS DIFFER";
    }
    if (PEERS > 1 && r->peer[1].sum >= 0)
        printf("  %11.2f", ratio(r, r->peer + 1, less));
    else
        printf("  %11s", "-");
    if (who) printf("   %6.2f %-10s %s", best, who, equal);
    printf("\n");
    fflush(stdout);
}

static void begin(run *r) {
    for (int k = 0; k < MOST_PATHS; k++) r->froe[k].sum = -1;
    for (int p = 0; p < PEERS; p++) r->peer[p].sum = -1;
}

/* The contestants of a round in turn: froe's sets of kernels, then those peers that are there. */
typedef struct contestant {
    froe_query *query; /* or NULL */
    const peer *peer;
    void *index;
    column *column;
} contestant;

/* Paths of froe and peers in turn, so that no path finds warm what another has asked of the same tree. */
static bool contestant_at(run *r, size_t i, contestant *out) {
    if (i >= r->paths + PEERS) return false;
    const bool mixed = i < 2 * r->paths;
    const size_t p = mixed ? i / 2 : i - r->paths;
    *out = mixed && i % 2 == 0 ? (contestant){r->query[p], NULL, NULL, r->froe + p}
                               : (contestant){NULL, peers[p], r->index[p], r->peer + p};
    return true;
}

/* -------------------------------------------------------------------- build -- */

static size_t heap(void) {
    struct mallinfo2 m = mallinfo2();
    return m.uordblks + m.hblkhd;
}

static bool builds(const run *r, const peer *p) {
    return p->build && (p != &peer_trapezoids || (r->plane.disjoint && r->plane.n <= MOST_TRAPEZOIDS));
}

static void build_peer(run *r, int p, int round, double *bytes) {
    if (r->index[p]) peers[p]->free(r->index[p]);
    size_t before = heap();
    double start = bench_cpu();
    r->index[p] = peers[p]->build(r->plane.s, r->plane.n);
    r->peer[p].rate[round] = bench_cpu() - start;
    r->peer[p].sum = 0;
    *bytes = peers[p]->bytes ? (double)peers[p]->bytes(r->index[p]) : (double)(heap() - before);
}

static void ask_by_paths(run *r) {
    for (; packed_kernels_at(r->paths); r->paths++) {
        bench_must(froe_query_new(r->tree, r->query + r->paths, NULL), NULL);
        r->query[r->paths]->packed->kernels = packed_kernels_at(r->paths);
    }
}

static void time_builds(run *r) {
    double bytes[PEERS] = {0};
    begin(r);
    r->froe[0].sum = 0;
    r->scene = bench_segments(&r->plane.s[0].ax, r->plane.n);
    for (int i = 0; i < ROUNDS; i++) {
        froe_tree_free(r->tree);
        double start = bench_cpu();
        r->tree = bench_build(r->scene, "index", NULL, FROE_LEAF_OWN, 1, NULL);
        r->froe[0].rate[i] = bench_cpu() - start;
        for (int p = 0; p < PEERS; p++)
            if (builds(r, peers[p])) build_peer(r, p, i, bytes + p);
    }
    ask_by_paths(r);
    print_title(r);
    print(r, "build, s", true);
    for (int i = 0; i < ROUNDS; i++) {
        r->froe[0].rate[i] = (double)froe_tree_report(r->tree).bytes / (double)r->plane.n;
        for (int p = 0; p < PEERS; p++) r->peer[p].rate[i] = bytes[p] / (double)r->plane.n;
    }
    print(r, "bytes each", true);
}

/* ------------------------------------------------------------------ windows -- */

static double checksum(const uint32_t *ids, size_t count) {
    double sum = (double)count;
    for (size_t i = 0; i < count; i++) sum += (double)(ids[i] * 2654435761u >> 12);
    return sum;
}

static size_t window(const run *r, const contestant *c, const double *w) {
    if (c->peer) return c->peer->window(c->index, w, w + 2, r->out);
    froe_range range = froe_range_defaults();
    froe_list found;
    range.points = w;
    bench_must(froe_query_range(c->query, &range, &found, NULL), NULL);
    memcpy(r->out, found.ids, found.count * sizeof *r->out);
    return found.count;
}

/* Shares of the queries in turn: none answers what another has just brought into the caches; in the end all have
 * answered all. */
static size_t share_of(int round, size_t place) {
    return ((size_t)round + place) % ROUNDS;
}

/* All programs on a share each; the sums tell in the end whether they said the same. */
static void windows_round(run *r, int k, int round) {
    const size_t count = r->plane.window_count[k] / ROUNDS;
    contestant c;
    for (size_t i = 0; contestant_at(r, i, &c); i++) {
        if (c.peer && (!c.peer->window || !c.index)) continue;
        const size_t from = share_of(round, i) * count, to = from + count;
        double start = bench_cpu();
        for (size_t w = from; w < to; w++) window(r, &c, r->plane.windows[k] + 4 * w);
        c.column->rate[round] = (double)count / (bench_cpu() - start);
        if (from) continue;
        c.column->sum = 0;
        for (size_t w = from; w < to && w < from + 2000; w++)
            c.column->sum += checksum(r->out, window(r, &c, r->plane.windows[k] + 4 * w));
    }
}

static void time_windows(run *r, int k) {
    begin(r);
    for (int round = 0; round < ROUNDS; round++) windows_round(r, k, round);
    print(r, k ? "window 1000" : "window 10", false);
}

/* ----------------------------------------------------------------- verticals -- */

static int64_t above(const contestant *c, const double *x) {
    if (c->peer) return c->peer->above(c->index, x[0], x[1]);
    uint32_t object;
    bench_must(froe_query_vertical(c->query, x, 1, &object, NULL), NULL);
    return object == FROE_NONE ? -1 : (int64_t)object;
}

static void above_round(run *r, int round) {
    const size_t count = r->plane.point_count / ROUNDS;
    contestant c;
    for (size_t k = 0; contestant_at(r, k, &c); k++) {
        if (c.peer && (!c.peer->above || !c.index)) continue;
        const size_t from = share_of(round, k) * count, to = from + count;
        double start = bench_cpu(), sum = 0;
        for (size_t i = from; i < to; i++) sum += (double)above(&c, r->plane.points + 2 * i) * (double)(i % 1009 + 1);
        c.column->rate[round] = (double)count / (bench_cpu() - start);
        c.column->sum = round ? c.column->sum + sum : sum;
    }
}

static void time_above(run *r) {
    begin(r);
    for (int round = 0; round < ROUNDS; round++) above_round(r, round);
    print(r, "above", false);
}

/* The same questions in a batch: the column of a peer is its single rate. */
static void time_above_batch(run *r) {
    size_t share = r->plane.point_count / ROUNDS;
    uint32_t *objects = bench_take(r->plane.point_count, sizeof *objects);
    froe_batch_options o = froe_batch_defaults();
    o.threads = 1;
    for (size_t k = 0; k < r->paths; k++) r->froe[k].sum = 0;
    for (int round = 0; round < ROUNDS; round++)
        for (size_t k = 0; k < r->paths; k++) {
            const size_t from = share_of(round, k) * share;
            double start = bench_cpu();
            bench_must(froe_batch_vertical(r->query[k], r->plane.points + 2 * from, share, 1, &o, objects + from, NULL),
                       NULL);
            r->froe[k].rate[round] = (double)share / (bench_cpu() - start);
            for (size_t i = from; i < from + share; i++)
                r->froe[k].sum += (objects[i] == FROE_NONE ? -1.0 : (double)objects[i]) * (double)(i % 1009 + 1);
        }
    print(r, "above batch", false);
    free(objects);
}

/* Faces of a map of disjoint segments: froe finds one by the segment above. The numbers of faces are not comparable, so
 * this is a comparison of rates alone; `above` has shown that the segments are right. */
static void time_locate(run *r) {
    const size_t count = 20000 / ROUNDS;
    contestant c;
    bool any = false;
    begin(r);
    for (int round = 0; round < ROUNDS; round++)
        for (size_t k = 0; contestant_at(r, k, &c); k++) {
            if (c.peer && (!c.peer->locate || !c.index)) continue;
            double start = bench_cpu();
            volatile int64_t face = 0;
            for (size_t i = 0; i < count; i++) {
                const double *x = r->plane.points + 2 * ((size_t)round * count + i);
                face = c.peer ? c.peer->locate(c.index, x[0], x[1]) : above(&c, x);
            }
            (void)face;
            any |= c.peer != NULL;
            c.column->rate[round] = (double)count / (bench_cpu() - start);
            c.column->sum = 0;
        }
    if (any) print(r, "face", false);
}

/* -------------------------------------------------------------------- pairs -- */

static bool count_pair(void *user, const froe_pair *pair) {
    (void)pair;
    ++*(size_t *)user;
    return true;
}

/* From the scene on: the tree is built anew. */
static size_t froe_pairs(const run *r, const packed_kernels *kernels) {
    size_t count = 0;
    froe_query *query = NULL;
    froe_tree *tree = bench_build(r->scene, "index", NULL, FROE_LEAF_OWN, 1, NULL);
    bench_must(froe_query_new(tree, &query, NULL), NULL);
    query->packed->kernels = kernels;
    bench_must(froe_query_pairs(query, true, count_pair, &count, NULL), NULL);
    froe_query_free(query);
    froe_tree_free(tree);
    return count;
}

static void time_pairs(run *r) {
    contestant c;
    begin(r);
    for (int round = 0; round < ROUNDS; round++)
        for (size_t k = 0; contestant_at(r, k, &c); k++) {
            if (c.peer && !c.peer->pairs) continue;
            double start = bench_cpu();
            c.column->sum =
                (double)(c.peer ? c.peer->pairs(r->plane.s, r->plane.n) : froe_pairs(r, c.query->packed->kernels));
            c.column->rate[round] = bench_cpu() - start;
        }
    print(r, "pairs, s", true);
}

/* From the tree on, by the clock: least times, since a second processor may be busy with something else. */
static void time_pairs_threads(run *r) {
    double least[2] = {INFINITY, INFINITY};
    size_t count[2];
    froe_batch_options o = froe_batch_defaults();
    for (int round = 0; round < 2 * ROUNDS; round++) {
        const int which = round % 2;
        o.threads = (unsigned)which + 1;
        count[which] = 0;
        const double start = bench_now();
        bench_must(froe_batch_pairs(r->query[0], true, &o, count_pair, &count[which], NULL), NULL);
        least[which] = fmin(least[which], bench_now() - start);
    }
    printf("%-14s pairs on two threads: %.4f s for %.4f s on one, %.2f x faster, %s\n", r->plane.name, least[1],
           least[0], least[0] / least[1], count[0] == count[1] ? "equal" : "ANSWERS DIFFER");
}

/* -------------------------------------------------------------------- whole -- */

static void bench(const char *kind, size_t n) {
    run r = {.plane = plane_make(kind, n, 1)};
    r.out = bench_take(r.plane.n, sizeof *r.out);
    time_builds(&r);
    time_windows(&r, 0);
    time_windows(&r, 1);
    time_above(&r);
    time_above_batch(&r);
    time_locate(&r);
    time_pairs(&r);
    time_pairs_threads(&r);
    for (int p = 0; p < PEERS; p++)
        if (r.index[p]) peers[p]->free(r.index[p]);
    for (size_t k = 0; k < r.paths; k++) froe_query_free(r.query[k]);
    froe_tree_free(r.tree);
    froe_scene_free(r.scene);
    plane_free(&r.plane);
    free(r.out);
}

int main(int argc, char **argv) {
    static char *all[] = {"short", "mixed", "tin", "cross"};
    size_t n = argc > 1 ? strtoull(argv[1], NULL, 10) : 1000000;
    bench_head("an index of segments, one thread, medians of 5 rounds by processor time", 1);
    printf("# rates are queries a second; pairs include the build\n");
    char **kinds = argc > 2 ? argv + 2 : all;
    for (int i = 0, count = argc > 2 ? argc - 2 : 4; i < count; i++) bench(kinds[i], n);
    return 0;
}
