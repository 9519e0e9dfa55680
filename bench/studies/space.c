/* space.c: the long run of what tests/kinetic/test_space.c and test_parabolas.c check: partitions of moving triangles
 * of all kinds, among them bodies that turn, each compared after every event with the tree of `cylindrical` and with
 * one made from scratch, certificates too.
 *
 *     bench_space [SEEDS [EVENTS [KIND]]]       default: 30 motions of each kind, up to 400 events each
 *
 * Prints a line for each kind: triangles, events, comparisons, trees made anew as a whole, nodes touched an event, how
 * often `cylindrical` made another tree of where rounded corners are (of scenes in which much coincides), and how many
 * motions went wrong. Ends with 1 if any did. Ten minutes. */
#include "bench.h"
#include "support/flights.h"

typedef struct study {
    size_t triangles;
    space_counts counts;
    uint64_t restarts, touched;
    int wrong;
} study;

/* Follows a motion, and frees it. */
static void follow_one(const char *name, froe_motion *motion, uint64_t seed, uint64_t events, study *all) {
    froe_kinetic_options options = froe_kinetic_defaults();
    froe_kinetic *kinetic = NULL;
    froe_diagnostic why = {0};
    options.seed = seed;
    bench_must(froe_kinetic_new(motion, &options, NULL, &kinetic, &why), &why);
    if (!space_follow(kinetic, events, &all->counts, &why)) {
        fprintf(stderr, "%s %d at %.17g: %s\n", name, (int)seed, froe_kinetic_time(kinetic), why.message);
        all->wrong++;
    }
    const froe_kinetic_stats stats = froe_kinetic_statistics(kinetic);
    all->triangles = froe_motion_object_count(motion);
    all->restarts += stats.restarts, all->touched += stats.nodes_touched;
    froe_kinetic_free(kinetic);
    froe_motion_free(motion);
}

int main(int argc, char **argv) {
    const uint64_t seeds = argc > 1 ? strtoull(argv[1], NULL, 10) : 30;
    const uint64_t events = argc > 2 ? strtoull(argv[2], NULL, 10) : 400;
    int wrong = 0;
    for (size_t i = 0; i < SPACE_KINDS + FLIGHT_KINDS; i++) {
        study all = {0};
        const flight_kind *flight = i < SPACE_KINDS ? NULL : flight_kinds + (i - SPACE_KINDS);
        const char *name = flight ? flight->name : space_kinds[i].name;
        double reached;
        all.counts.blurs = flight && flight->quarters;
        if (argc > 3 && strcmp(argv[3], name) != 0) continue;
        for (uint64_t seed = 1; seed <= seeds; seed++)
            follow_one(name,
                       flight ? flight_on_parabolas(flight, seed, &reached) : space_new(space_kinds + i, seed, NULL),
                       seed, events, &all);
        printf("%-15s n %3zu  events %6llu  compared %6llu  anew %3llu  touched %6.1f  blurred %2llu  wrong %d\n", name,
               all.triangles, (unsigned long long)all.counts.all, (unsigned long long)all.counts.compared,
               (unsigned long long)all.restarts, (double)all.touched / (double)(all.counts.all + !all.counts.all),
               (unsigned long long)all.counts.blurred, all.wrong);
        fflush(stdout);
        wrong += all.wrong;
    }
    return wrong > 0;
}
