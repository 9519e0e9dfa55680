/* index.c: trees of the builder `index` beside what people use as an index of segments.
 *
 *     bench_index [N [KIND...]]        default: 10^6, of short, mixed, tin, cross; FILE: see plane.c
 *
 * One thread, processor time, but for a line that says what two do for pairs. In every round each program answers the
 * same queries, one program after the other; a rate is the median of 5 rounds, a ratio that of the medians. Answers are
 * compared, all of them. */
#include "bench.h"
#include "plane.h"
#include <froe/query.h>
#include <malloc.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ROUNDS = 5, MOST_PEERS = 8, MOST_TRAPEZOIDS = 100000 };

static const peer *const peers[] = {
#ifdef HAVE_BOOST
    &peer_boost,
#endif
#ifdef HAVE_GEOS
    &peer_geos,
#endif
    &peer_grid,
#ifdef HAVE_CGAL
    &peer_trapezoids, &peer_boxes,
#endif
};
enum { PEERS = sizeof peers / sizeof *peers };

typedef struct run {
    plane_scene plane;
    froe_scene *scene;
    froe_tree *tree;
    froe_query *query;
    void *index[PEERS];
    uint32_t *out;
    double rate[PEERS + 1][ROUNDS]; /* froe first */
    double sum[PEERS + 1];          /* checksums of the answers, -1: did not take part */
} run;

/* ------------------------------------------------------------------- output -- */

/* Rates or, `less` being better, seconds; and froe's ratio to the best peer. */
static void print(run *r, const char *what, bool less) {
    double best = 0, froe = bench_median(r->rate[0], ROUNDS);
    const char *who = "-", *equal = "equal";
    printf("%-10s %-12s %10.4g", r->plane.name, what, froe);
    for (int p = 0; p < PEERS; p++) {
        if (r->sum[p + 1] < 0) {
            printf(" %10s", "-");
            continue;
        }
        double rate = bench_median(r->rate[p + 1], ROUNDS);
        if (best == 0 || (less ? rate < best : rate > best)) best = rate, who = peers[p]->name;
        if (r->sum[p + 1] != r->sum[0]) equal = "ANSWERS DIFFER";
        printf(" %10.4g", rate);
    }
    if (best > 0) printf("   %6.2f x %-10s %s", less ? best / froe : froe / best, who, equal);
    printf("\n");
}

static void begin(run *r) {
    for (int p = 0; p <= PEERS; p++) r->sum[p] = -1;
}

/* -------------------------------------------------------------------- build -- */

static size_t heap(void) {
    struct mallinfo2 m = mallinfo2();
    return m.uordblks + m.hblkhd;
}

static void time_builds(run *r) {
    double bytes[PEERS + 1] = {0};
    begin(r);
    r->sum[0] = 0;
    r->scene = bench_segments(&r->plane.s[0].ax, r->plane.n);
    for (int i = 0; i < ROUNDS; i++) {
        double start = bench_cpu();
        froe_tree_free(r->tree);
        start = bench_cpu();
        r->tree = bench_build(r->scene, "index", NULL, FROE_LEAF_OWN, 1, NULL);
        r->rate[0][i] = bench_cpu() - start;
        for (int p = 0; p < PEERS; p++) {
            if (!peers[p]->build ||
                (peers[p] == &peer_trapezoids && (!r->plane.disjoint || r->plane.n > MOST_TRAPEZOIDS)))
                continue;
            if (r->index[p]) peers[p]->free(r->index[p]);
            size_t before = heap();
            start = bench_cpu();
            r->index[p] = peers[p]->build(r->plane.s, r->plane.n);
            r->rate[p + 1][i] = bench_cpu() - start;
            bytes[p + 1] = (double)(heap() - before);
            if (peers[p]->bytes) bytes[p + 1] = (double)peers[p]->bytes(r->index[p]);
            r->sum[p + 1] = r->sum[0];
        }
    }
    print(r, "build, s", true);
    bytes[0] = (double)froe_tree_report(r->tree).bytes;
    for (int p = 0; p <= PEERS; p++)
        for (int i = 0; i < ROUNDS; i++) r->rate[p][i] = bytes[p] / (double)r->plane.n;
    print(r, "bytes each", true);
    bench_must(froe_query_new(r->tree, &r->query, NULL), NULL);
}

/* ------------------------------------------------------------------ windows -- */

static double checksum(const uint32_t *ids, size_t count) {
    double sum = (double)count;
    for (size_t i = 0; i < count; i++) sum += (double)(ids[i] * 2654435761u >> 12);
    return sum;
}

static size_t froe_window(run *r, const double *w) {
    froe_range range = froe_range_defaults();
    froe_list found;
    range.points = w;
    bench_must(froe_query_range(r->query, &range, &found, NULL), NULL);
    memcpy(r->out, found.ids, found.count * sizeof *r->out);
    return found.count;
}

/* All programs on queries [from, to); the sums tell in the end whether they said the same. */
static void windows_round(run *r, int k, int round, size_t from, size_t to) {
    for (int p = -1; p < PEERS; p++) {
        if (p >= 0 && (!peers[p]->window || !r->index[p])) continue;
        double start = bench_cpu(), *sum = &r->sum[p + 1];
        for (size_t i = from; i < to; i++) {
            const double *w = r->plane.windows[k] + 4 * i;
            if (p < 0)
                froe_window(r, w);
            else
                peers[p]->window(r->index[p], w, w + 2, r->out);
        }
        r->rate[p + 1][round] = (double)(to - from) / (bench_cpu() - start);
        if (round == 0)
            for (size_t i = from; i < to && i < from + 2000; i++) {
                const double *w = r->plane.windows[k] + 4 * i;
                *sum = (i == from ? 0 : *sum) +
                       checksum(r->out, p < 0 ? froe_window(r, w) : peers[p]->window(r->index[p], w, w + 2, r->out));
            }
    }
}

static void time_windows(run *r, int k) {
    size_t share = r->plane.window_count[k] / ROUNDS;
    begin(r);
    for (int round = 0; round < ROUNDS; round++)
        windows_round(r, k, round, (size_t)round * share, ((size_t)round + 1) * share);
    print(r, k ? "window 1000" : "window 10", false);
}

/* ----------------------------------------------------------------- verticals -- */

static int64_t froe_above(run *r, const double *point) {
    uint32_t object;
    bench_must(froe_query_vertical(r->query, point, 1, &object, NULL), NULL);
    return object == FROE_NONE ? -1 : (int64_t)object;
}

static void above_round(run *r, int round, size_t from, size_t to) {
    for (int p = -1; p < PEERS; p++) {
        if (p >= 0 && (!peers[p]->above || !r->index[p])) continue;
        double start = bench_cpu(), sum = 0;
        for (size_t i = from; i < to; i++) {
            const double *x = r->plane.points + 2 * i;
            sum +=
                (double)(p < 0 ? froe_above(r, x) : peers[p]->above(r->index[p], x[0], x[1])) * (double)(i % 1009 + 1);
        }
        r->rate[p + 1][round] = (double)(to - from) / (bench_cpu() - start);
        r->sum[p + 1] = round ? r->sum[p + 1] + sum : sum;
    }
}

static void time_above(run *r) {
    size_t share = r->plane.point_count / ROUNDS;
    begin(r);
    for (int round = 0; round < ROUNDS; round++)
        above_round(r, round, (size_t)round * share, ((size_t)round + 1) * share);
    print(r, "above", false);
}

/* The same questions in a batch: the column of a peer is its single rate. */
static void time_above_batch(run *r) {
    size_t share = r->plane.point_count / ROUNDS;
    uint32_t *objects = malloc(r->plane.point_count * sizeof *objects);
    froe_batch_options o = froe_batch_defaults();
    o.threads = 1;
    if (!objects) exit(1);
    double sum = 0;
    for (int round = 0; round < ROUNDS; round++) {
        size_t from = (size_t)round * share;
        double start = bench_cpu();
        bench_must(froe_batch_vertical(r->query, r->plane.points + 2 * from, share, 1, &o, objects + from, NULL), NULL);
        r->rate[0][round] = (double)share / (bench_cpu() - start);
        for (size_t i = from; i < from + share; i++)
            sum += (objects[i] == FROE_NONE ? -1.0 : (double)objects[i]) * (double)(i % 1009 + 1);
    }
    r->sum[0] = sum;
    print(r, "above batch", false);
    free(objects);
}

/* Faces of a map of disjoint segments: froe finds one by the segment above. The numbers of faces are not comparable, so
 * this is a comparison of rates alone; `above` has shown that the segments are right. */
static void time_locate(run *r) {
    begin(r);
    size_t count = 20000 / ROUNDS;
    bool any = false;
    for (int round = 0; round < ROUNDS; round++)
        for (int p = -1; p < PEERS; p++) {
            if (p >= 0 && (!peers[p]->locate || !r->index[p])) continue;
            double start = bench_cpu();
            volatile int64_t face = 0;
            for (size_t i = 0; i < count; i++) {
                const double *x = r->plane.points + 2 * ((size_t)round * count + i);
                face = p < 0 ? froe_above(r, x) : peers[p]->locate(r->index[p], x[0], x[1]);
            }
            (void)face;
            any |= p >= 0;
            r->rate[p + 1][round] = (double)count / (bench_cpu() - start);
            r->sum[p + 1] = 0;
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
static size_t froe_pairs(const run *r) {
    size_t count = 0;
    froe_query *query = NULL;
    froe_tree *tree = bench_build(r->scene, "index", NULL, FROE_LEAF_OWN, 1, NULL);
    bench_must(froe_query_new(tree, &query, NULL), NULL);
    bench_must(froe_query_pairs(query, true, count_pair, &count, NULL), NULL);
    froe_query_free(query);
    froe_tree_free(tree);
    return count;
}

static void time_pairs(run *r) {
    begin(r);
    for (int round = 0; round < ROUNDS; round++)
        for (int p = -1; p < PEERS; p++) {
            if (p >= 0 && !peers[p]->pairs) continue;
            double start = bench_cpu();
            r->sum[p + 1] = (double)(p < 0 ? froe_pairs(r) : peers[p]->pairs(r->plane.s, r->plane.n));
            r->rate[p + 1][round] = bench_cpu() - start;
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
        bench_must(froe_batch_pairs(r->query, true, &o, count_pair, &count[which], NULL), NULL);
        least[which] = fmin(least[which], bench_now() - start);
    }
    printf("%-10s pairs on two threads: %.4f s for %.4f s on one, %.2f x faster, %s\n", r->plane.name, least[1],
           least[0], least[0] / least[1], count[0] == count[1] ? "equal" : "ANSWERS DIFFER");
}

/* -------------------------------------------------------------------- whole -- */

static void bench(const char *kind, size_t n) {
    run r = {.plane = plane_make(kind, n, 1)};
    r.out = malloc((r.plane.n + 1) * sizeof *r.out);
    if (!r.out) exit(1);
    printf("\n%s: %zu segments\n%-10s %-12s %10s", r.plane.name, r.plane.n, "", "", "froe");
    for (int p = 0; p < PEERS; p++) printf(" %10.10s", peers[p]->name);
    printf("   froe : best peer\n");
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
    froe_query_free(r.query);
    froe_tree_free(r.tree);
    froe_scene_free(r.scene);
    plane_free(&r.plane);
    free(r.out);
    fflush(stdout);
}

int main(int argc, char **argv) {
    static char *all[] = {"short", "mixed", "tin", "cross"};
    size_t n = argc > 1 ? strtoull(argv[1], NULL, 10) : 1000000;
    bench_head("an index of segments, one thread, medians of 5 rounds by processor time", 1);
    printf("# rates are queries a second\n");
    char **kinds = argc > 2 ? argv + 2 : all;
    for (int i = 0, count = argc > 2 ? argc - 2 : 4; i < count; i++) bench(kinds[i], n);
    return 0;
}
