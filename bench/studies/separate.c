/* separate.c: are all pairs of disjoint bodies separated, and what does a plane between them cost?
 *
 *     bench_separate [PAIRS]     so many pairs of every two kinds in R^2 .. R^8, 10^5 unless told otherwise
 *
 * Each pair is disjoint by exact rationals (tests/support/gaps.h). A row is two kinds: for how many pairs no plane was
 * found, the share of planes of more than one row of doubles, the most rows, and microseconds a pair. */
#include "geom/meet/apart.h"
#include "support/gaps.h"
#include <stdlib.h>
#include <time.h>

static const gaps_place places[] = {{1e-1, 1, 0},       {1e-3, 1, 0},       {1e-6, 1, 0},      {1e-9, 1, 0},
                                    {1e-12, 1, 0},      {1e-15, 1, 0},      {1e-15, 1, 1e6},   {1e-300, 1, 0},
                                    {1e-12, 1e-300, 0}, {1e-15, 1e-300, 1}, {1e-12, 1e307, 0}, {1e-15, 1e307, 3}};
enum { PLACES = sizeof places / sizeof *places };

static double microseconds(void) {
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return 1e6 * (double)t.tv_sec + 1e-3 * (double)t.tv_nsec;
}

static unsigned long measure(num_context *context, fuzz_source *r, froe_kind a, froe_kind b, unsigned long pairs) {
    static double rows[GEOM_APART_NUMBERS];
    unsigned long missed = 0, fine = 0;
    int most = 0;
    double spent = 0;
    for (unsigned long i = 0; i < pairs; i++) {
        gaps_pair pair;
        gaps_draw(r, 2 + (int)(i % (FROE_MAX_DIM - 1)), a, b, places[i / (FROE_MAX_DIM - 1) % PLACES], &pair);
        const double begin = microseconds();
        const int count = geom_apart(context, &pair.body[0], &pair.body[1], rows);
        spent += microseconds() - begin;
        missed += !count;
        fine += count > 1;
        most = count > most ? count : most;
    }
    printf("| %s | %s | %lu | %lu | %.2f %% | %d | %.1f |\n", froe_kind_name(a), froe_kind_name(b), pairs, missed,
           100 * (double)fine / (double)pairs, most, spent / (double)pairs);
    fflush(stdout);
    return missed;
}

int main(int argc, char **argv) {
    const unsigned long pairs = argc > 1 ? strtoul(argv[1], NULL, 10) : 100000;
    fuzz_source r = {1};
    num_context context;
    unsigned long missed = 0;
    if (num_context_new(NULL, &context) != FROE_OK) return 1;
    printf("| kinds | | pairs | not separated | finer than doubles | most rows | us a pair "
           "|\n|---|---|---|---|---|---|---|\n");
    for (int a = 0; a < GAPS_KINDS; a++)
        for (int b = 0; b <= a; b++) missed += measure(&context, &r, gaps_kinds[a], gaps_kinds[b], pairs);
    num_context_free(&context);
    return missed > 0;
}
