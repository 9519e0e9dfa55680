/* turns.c: what it costs that a segment turns upright, ordinary and in an augmented partition (Agarwal, Erickson and
 * Guibas, lemma 3.6 and what follows), and what the augmented one costs elsewhere.
 *
 *     bench_turns [K...]                default: 10, 100, 1,000 and 10,000 crossings
 *
 * A segment turns over K bars once, in an order of cuts that is random; the median of five orders. */
#include "bench.h"
#include <froe/kinetic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ORDERS = 5, ROUNDS = 5, EVENTS = 20000 };

static froe_motion *hand_over_bars(size_t bars) {
    const size_t n = bars + 1;
    size_t *starts = bench_take(2 * n + 1, sizeof *starts);
    double *times = bench_take(2 * n + 2, sizeof *times), *xy = bench_take(4 * n + 4, sizeof *xy);
    const double turning[] = {-7, -1, 9, -2, 3, (double)bars + 1, -6, (double)bars + 2};
    froe_motion_options w = froe_motion_defaults();
    froe_moving b = froe_moving_defaults();
    froe_motion *m = NULL;
    froe_diagnostic diag = {0};
    uint64_t state = 1;
    w.begin = 0, w.end = 8;
    memcpy(xy, turning, sizeof turning);
    starts[1] = 2, starts[2] = 4, times[1] = times[3] = 8;
    for (size_t i = 0; i < 2 * bars; i++) {
        const size_t bar = i / 2;
        xy[8 + 2 * i] = (i % 2 ? 20 : -20) + bench_unit(&state);
        xy[9 + 2 * i] = (double)bar;
        starts[3 + i] = starts[2 + i] + 1;
    }
    b.vertex_count = 2 * n, b.count = n, b.starts = starts, b.times = times, b.coords = xy;
    bench_must(froe_motion_new(&w, NULL, &m, &diag), &diag);
    bench_must(froe_motion_add(m, &b, &diag), &diag);
    free(starts);
    free(times);
    free(xy);
    return m;
}

static bool count(void *user, const froe_event *event) {
    (void)event;
    return --*(uint64_t *)user > 0;
}

typedef struct cost {
    double touched, made, seconds;
} cost;

/* Of so many events. */
static cost follow(froe_kinetic *k, double end, uint64_t events) {
    froe_diagnostic diag = {0};
    const froe_kinetic_stats before = froe_kinetic_statistics(k);
    const double start = bench_cpu();
    const froe_status status = froe_kinetic_advance(k, end, count, &events, &diag);
    const double seconds = bench_cpu() - start;
    if (status != FROE_E_CANCELLED) bench_must(status, &diag);
    const froe_kinetic_stats after = froe_kinetic_statistics(k);
    return (cost){(double)(after.nodes_touched - before.nodes_touched),
                  (double)(after.certificates_made - before.certificates_made), seconds};
}

static froe_kinetic *begin(froe_motion *m, uint64_t seed, bool augmented) {
    froe_kinetic_options o = froe_kinetic_defaults();
    froe_kinetic *k = NULL;
    froe_diagnostic diag = {0};
    o.seed = seed, o.augmented = augmented;
    bench_must(froe_kinetic_new(m, &o, NULL, &k, &diag), &diag);
    return k;
}

static void measure_turn(size_t bars) {
    froe_motion *m = hand_over_bars(bars);
    printf("%7zu", bars);
    for (int augmented = 0; augmented < 2; augmented++) {
        double touched[ORDERS], made[ORDERS], seconds[ORDERS];
        for (size_t i = 0; i < ORDERS; i++) {
            froe_kinetic *k = begin(m, i + 1, augmented);
            const cost c = follow(k, 8, 1);
            touched[i] = c.touched, made[i] = c.made, seconds[i] = c.seconds;
            froe_kinetic_free(k);
        }
        printf(" %10.0f %10.0f %12.1f", bench_median(touched, ORDERS), bench_median(made, ORDERS),
               1e6 * bench_median(seconds, ORDERS));
    }
    printf("\n");
    fflush(stdout);
    froe_motion_free(m);
}

/* Both in turns, over the same events. */
static void measure_elsewhere(size_t n) {
    froe_motion *m = NULL;
    froe_diagnostic diag = {0};
    double ratio[ROUNDS], seconds[2][ROUNDS];
    cost c[2];
    bench_must(froe_generate_motion("moving", n, 1, NULL, &m, &diag), &diag);
    froe_kinetic *k[2] = {begin(m, 1, false), begin(m, 1, true)};
    const double end = froe_motion_window(m).end;
    for (size_t round = 0; round < ROUNDS; round++) {
        for (size_t i = 0; i < 2; i++) {
            const size_t which = (i + round) % 2;
            c[which] = follow(k[which], end, EVENTS);
            seconds[which][round] = c[which].seconds;
        }
        ratio[round] = c[1].seconds / c[0].seconds;
    }
    for (size_t i = 0; i < 2; i++)
        printf("%7zu %10s %10.0f %9.2f %9.2f\n", n, i ? "augmented" : "ordinary",
               EVENTS / bench_median(seconds[i], ROUNDS), c[i].touched / EVENTS, c[i].made / EVENTS);
    printf("%7zu %10s %10.3f\n", n, "ratio", bench_median(ratio, ROUNDS));
    froe_kinetic_free(k[0]);
    froe_kinetic_free(k[1]);
    froe_motion_free(m);
}

int main(int argc, char **argv) {
    static const size_t crossings[] = {10, 100, 1000, 10000};
    bench_head("a segment turns upright: ordinary and augmented partitions, one thread, processor time", 1);
    printf("%7s %10s %10s %12s %10s %10s %12s\n", "crossed", "touched", "made", "us", "touched", "made", "us");
    for (int i = 1; i < argc; i++) measure_turn(strtoull(argv[i], NULL, 10));
    for (size_t i = 0; argc < 2 && i < sizeof crossings / sizeof *crossings; i++) measure_turn(crossings[i]);
    printf("# random linear motion, %d events a round\n%7s %10s %10s %9s %9s\n", EVENTS, "n", "variant", "events/s",
           "touched", "made");
    for (size_t n = 1000; n <= 10000; n *= 10) measure_elsewhere(n);
    return 0;
}
