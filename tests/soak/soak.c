/* soak.c: does blocks of work of one kind, from a seed on, until so many seconds of processor time have passed, at
 * least one. Prints one line: the kind, the first seed, and how many blocks, decisions, hard and wrong ones, and
 * seconds.
 *
 *     soak KIND FIRST SECONDS
 *     soak --list                 the kinds
 *
 * The same seed makes the same block on every machine. Ends with 1 if anything is wrong; standard error has the seeds.
 * scripts/soak calls it again and again and keeps what was counted. */
#include "soak.h"
#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static const struct {
    const char *name;
    soak_fn *run;
} kinds[] = {
    {"whole", soak_whole},       {"rational", soak_rational}, {"walls", soak_walls}, {"answers", soak_answers},
    {"pictures", soak_pictures}, {"contacts", soak_contacts}, {"plane", soak_plane}, {"space", soak_space},
};
enum { KINDS = sizeof kinds / sizeof *kinds };

/* What is being done, for when an assertion ends the program. */
static struct {
    const char *kind;
    uint64_t seed;
    bool over;
} now;

static void tell_where(void) {
    if (!now.over) fprintf(stderr, "soak: %s, seed %" PRIu64 ": an assertion fails\n", now.kind, now.seed);
}

void soak_complain(soak_block *block, const char *format, ...) {
    va_list list;
    va_start(list, format);
    if (!block->wrong) vsnprintf(block->why, sizeof block->why, format, list);
    va_end(list);
    block->wrong++;
}

static double seconds_used(void) {
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int run(size_t kind, uint64_t first, double seconds) {
    soak_block sum = {.seed = first};
    uint64_t blocks = 0;
    now.kind = kinds[kind].name;
    atexit(tell_where);
    do {
        soak_block block = {.seed = now.seed = first + blocks++};
        kinds[kind].run(&block);
        sum.decisions += block.decisions, sum.hard += block.hard, sum.wrong += block.wrong;
        if (block.wrong) fprintf(stderr, "soak: %s, seed %" PRIu64 ": %s\n", now.kind, block.seed, block.why);
    } while (seconds_used() < seconds);
    now.over = true;
    printf("%s\t%" PRIu64 "\t%" PRIu64 "\t%" PRIu64 "\t%" PRIu64 "\t%" PRIu64 "\t%.1f\n", now.kind, first, blocks,
           sum.decisions, sum.hard, sum.wrong, seconds_used());
    return sum.wrong || !sum.decisions;
}

int main(int argc, char **argv) {
    if (argc == 2 && !strcmp(argv[1], "--list")) {
        for (size_t i = 0; i < KINDS; i++) puts(kinds[i].name);
        return 0;
    }
    for (size_t i = 0; i < KINDS && argc == 4; i++)
        if (!strcmp(argv[1], kinds[i].name)) return run(i, strtoull(argv[2], NULL, 10), strtod(argv[3], NULL));
    fprintf(stderr, "usage: %s KIND FIRST SECONDS, or --list\n", argv[0]);
    return 2;
}
