/* ranges.c: how much sooner a partition in motion is there where time goes on in ranges of x, on threads.
 *
 *     bench_ranges [KIND [N [EVENTS [THREADS]]]]       default: moving, 10,000 segments, 300,000 events, 4 threads
 *     bench_ranges FILE.mfjson [0 [EVENTS [THREADS]]]  of a file
 *
 * With one thread ranges go on one after the other. The same events are found twice, and have to be the same. Time by
 * the clock says something where no other work keeps the processors busy; processor time says what ranges cost, or save
 * because small partitions are in nearer caches. */
#include "bench.h"
#include "kinetic/kinetic.h"
#include <froe/formats.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct ride {
    uint64_t most, events, hash;
} ride;

static bool count(void *user, const froe_event *e) {
    ride *r = user;
    r->hash = r->hash * 0x9e3779b97f4a7c15u + (uint64_t)e->tick * 31 + (uint64_t)e->kind;
    for (unsigned i = 0; i < 4 && i < e->object_count; i++) r->hash = r->hash * 31 + e->objects[i];
    return ++r->events < r->most;
}

typedef struct lap {
    double cpu, clock;
    ride ride;
} lap;

/* To a time, or until the visitor stops. */
static froe_kinetic *go(froe_motion *m, unsigned threads, bool ahead, double to, lap *out) {
    froe_diagnostic diag = {0};
    froe_kinetic *k;
    froe_kinetic_options o = froe_kinetic_defaults();
    o.threads = threads, o.ahead = ahead;
    bench_must(froe_kinetic_new(m, &o, NULL, &k, &diag), &diag);
    const double cpu = bench_cpu(), clock = bench_now();
    const froe_status status = froe_kinetic_advance(k, to, count, &out->ride, &diag);
    if (status != FROE_E_CANCELLED) bench_must(status, &diag);
    out->cpu = bench_cpu() - cpu, out->clock = bench_now() - clock;
    return k;
}

static void print(const char *what, const lap *l) {
    const double events = (double)l->ride.events;
    printf("%-8s %9.0f events  %7.3f s of all processors  %7.3f s by the clock  %8.0f events a second\n", what, events,
           l->cpu, l->clock, events / l->clock);
}

int main(int argc, char **argv) {
    const char *kind = argc > 1 ? argv[1] : "moving";
    const size_t n = argc > 2 ? strtoull(argv[2], NULL, 10) : 10000;
    lap first = {.ride = {.most = argc > 3 ? strtoull(argv[3], NULL, 10) : 300000}},
        one = {.ride = {.most = UINT64_MAX}}, many = one;
    const unsigned threads = argc > 4 ? (unsigned)strtoul(argv[4], NULL, 10) : 4;
    froe_diagnostic diag = {0};
    froe_motion *m;
    if (strchr(kind, '.')) {
        const froe_motion_read_options read = froe_motion_read_defaults();
        froe_motion_report report;
        bench_must(froe_read_motion(kind, &read, &m, &report, &diag), &diag);
    } else {
        bench_must(froe_generate_motion(kind, n, 1, NULL, &m, &diag), &diag);
    }
    froe_kinetic *k = go(m, 1, false, froe_motion_window(m).end, &first);
    const double to = froe_kinetic_time(k);
    froe_kinetic_free(k);
    froe_kinetic_free(go(m, 1, false, to, &one)); /* again: the first has met fresh pages */
    k = go(m, threads, true, to, &many);
    printf("%s, %zu segments, %u threads, %" PRIu64 " windows, %" PRIu64 " of them stopped\n", kind,
           froe_motion_object_count(m), threads, k->ranges.windows, k->ranges.stopped);
    print("one", &one);
    print("ranges", &many);
    froe_kinetic_free(k);
    froe_motion_free(m);
    if (one.ride.hash == many.ride.hash) return 0;
    printf("The events differ.\n");
    return 1;
}
