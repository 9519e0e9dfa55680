/* follow.c: partitions in motion, each compared, node for node, with one made from scratch after every event.
 *
 *     bench_follow [EVENTS [SEED [augmented]]]       default: 1,000,000 events, seeds from 1 on
 *
 * Over all kinds of motion that the tests know, with other seeds. Ends with 1 at the first difference. */
#include "support/patterns.h"
#include <inttypes.h>
#include <stdio.h>
#include <time.h>

enum { INSTANTS = 1000 };

static froe_kinetic_stats totals[MOVING_KINDS];
static uint64_t events[MOVING_KINDS];
static bool augmented;

static void follow(int kind, uint64_t seed, pattern_counter *counter) {
    froe_motion *m = moving_new(moving_kinds + kind, seed, NULL);
    froe_kinetic_options o = froe_kinetic_defaults();
    froe_kinetic *k = NULL;
    froe_diagnostic why = {0};
    const uint64_t before = counter->events;
    o.seed = seed;
    o.augmented = augmented;
    if (!m || froe_kinetic_new(m, &o, NULL, &k, &why) || following_run(k, INSTANTS, counter, &why)) {
        printf("%s, seed %" PRIu64 ", at %.17g: %s\n", moving_kinds[kind].name, seed, k ? froe_kinetic_time(k) : 0,
               why.message);
        exit(1);
    }
    froe_kinetic_stats s = froe_kinetic_statistics(k);
    events[kind] += counter->events - before;
    totals[kind].crowds += s.crowds;
    totals[kind].free_turns += s.free_turns;
    totals[kind].restarts += s.restarts;
    totals[kind].stuck += s.stuck;
    froe_kinetic_free(k);
    froe_motion_free(m);
}

static void print_patterns(const pattern_counter *counter) {
    printf("%-20s %8s %8s %12s\n", "pattern", "kinds", "seen", "least often");
    for (int i = 0; i < PATTERN_KINDS; i++) {
        uint64_t least = UINT64_MAX;
        int seen = 0;
        for (int j = 0; j < pattern_counts[i]; j++) {
            seen += counter->seen[i][j] > 0;
            least = counter->seen[i][j] < least ? counter->seen[i][j] : least;
        }
        printf("%-20s %8d %8d %12" PRIu64 "\n", pattern_names[i], pattern_counts[i], seen, least);
    }
}

int main(int argc, char **argv) {
    const uint64_t most = argc > 1 ? strtoull(argv[1], NULL, 10) : 1000000;
    const clock_t start = clock();
    augmented = argc > 3 && !strcmp(argv[3], "augmented");
    pattern_counter counter = {0};
    for (uint64_t seed = argc > 2 ? strtoull(argv[2], NULL, 10) : 1; counter.events < most; seed++)
        for (int i = 0; i < MOVING_KINDS && counter.events < most; i++) follow(i, seed, &counter);
    printf("%-20s %10s %10s %8s %8s %8s\n", "motion", "events", "free turns", "crowds", "restarts", "stuck");
    for (int i = 0; i < MOVING_KINDS; i++)
        printf("%-20s %10" PRIu64 " %10" PRIu64 " %8" PRIu64 " %8" PRIu64 " %8" PRIu64 "\n", moving_kinds[i].name,
               events[i], totals[i].free_turns, totals[i].crowds, totals[i].restarts, totals[i].stuck);
    print_patterns(&counter);
    printf("%" PRIu64 " events, all equal to what is made from scratch, in %.0f s\n", counter.events,
           (double)(clock() - start) / CLOCKS_PER_SEC);
    return 0;
}
