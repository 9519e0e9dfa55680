/* claims.c: reproduces what the sources claim: each claim as a number in a range, measured now.
 *
 *     bench_claims [--quick] [FILE [WORD]]
 *
 * Prints claim, range, both numbers and verdict; writes the same as a table for the documents into FILE ("-": none).
 * With WORD only claims whose source, text or method holds it. --quick: only what is counted in a second. Exit status 1
 * if a claim fails. About five minutes on one core. */
#include "claims.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

typedef struct account {
    int held, failed;
    FILE *file;       /* NULL: none */
    const char *word; /* NULL: all claims */
    bool quick;
} account;

static const claim *const all[] = {claims_berg,      claims_sacks,  claims_boxes,
                                   claims_cylinders, claims_ranges, claims_motion};

static void put_range(char *text, size_t size, const claim *c) {
    if (c->least <= 0 && (c->least == 0 || isinf(c->least)))
        snprintf(text, size, "at most %g", c->most);
    else if (isinf(c->most))
        snprintf(text, size, "at least %g", c->least);
    else
        snprintf(text, size, "%g to %g", c->least, c->most);
}

/** As "method settings", empty without a method. */
static void put_way(char *text, size_t size, const claims_way *way) {
    const bool settings = way->method && way->settings;
    snprintf(text, size, "%s%s%s", way->method ? way->method : "", settings ? " " : "", settings ? way->settings : "");
}

static void tell(account *a, const claim *c, const double value[2], double seconds) {
    char range[48], with[128], without[256], by[128];
    const bool in[2] = {value[0] >= c->least && value[0] <= c->most, value[1] >= c->least && value[1] <= c->most};
    const bool holds = in[0] && !in[1] && !isnan(value[1]);
    const char *verdict = holds ? "holds" : !in[0] ? "fails" : "cannot fail";
    a->held += holds, a->failed += !holds;
    put_range(range, sizeof range, c);
    put_way(with, sizeof with, &c->with);
    put_way(by, sizeof by, &c->without);
    const bool other = *by && strcmp(by, with) != 0;
    snprintf(without, sizeof without, "%s%s%s%s", c->needs, other ? " (`" : "", other ? by : "", other ? "`)" : "");
    printf("%-11s %8.3g  %-14s without %8.3g  %s: %s%s%s: %s. Breaks without %s (%.1f s)\n", verdict, value[0], range,
           value[1], c->source, with, *with ? ", " : "", c->says, c->measured, without, seconds);
    fflush(stdout);
    if (!a->file) return;
    fprintf(a->file, "| %s | %s | %s%s%s | %s | %s | %.3g | %s | %.3g | %s%s%s |\n", c->source, c->says,
            *with ? "`" : "", with, *with ? "`" : "", c->measured, range, value[0], without, value[1],
            holds ? "" : "**", verdict, holds ? "" : "**");
}

static bool is_wanted(const account *a, const claim *c) {
    if (a->quick && c->kind != CLAIM_QUICK) return false;
    if (!a->word || strstr(c->source, a->word) || strstr(c->says, a->word)) return true;
    return c->with.method && strstr(c->with.method, a->word);
}

static void run(account *a, const claim *claims) {
    for (const claim *c = claims; c->source; c++) {
        if (!is_wanted(a, c)) continue;
        const double start = bench_now();
        const double value[2] = {c->measure(&c->with, c->of), c->measure(&c->without, c->of)};
        tell(a, c, value, bench_now() - start);
    }
}

static void put_head(FILE *file) {
    char day[32];
    const time_t now = time(NULL);
    strftime(day, sizeof day, "%Y-%m-%d", gmtime(&now));
    fprintf(
        file,
        "# Claims of the sources, measured\n\n"
        "`make claims` measures the claims of the five sources that [CITATION.cff](../../CITATION.cff) lists, and four "
        "of\n"
        "Paterson and Yao, and writes this page. Each row is one number. `build/bench/bin/bench_claims - \"lemma "
        "3.4\"`\n"
        "measures again the rows whose source, claim or method has these words, and writes nothing.\n\n"
        "- **is** is the number by the method. The claim holds if it lies in the **range**.\n"
        "- **breaks without** names what the claim rests on, and in brackets the method or settings that lack it.\n"
        "- **without** is the same number, of the same scenes, measured that way. It must lie outside the range.\n"
        "- The verdict is *holds* if both are so, *fails* if **is** lies outside, and *cannot fail* if both lie in\n"
        "  the range: then the row says nothing about the method.\n\n"
        "Ranges have room for small n and for lower terms. An exponent is a least-squares slope on log-log scales\n"
        "over at least three doublings. Nodes and pieces are counted. Times are processor times, the least of\n"
        "three. *Sorted* is a partition along the objects in the order of the scene. The number n is that of\n"
        "objects, lambda the density, k in the rows of Agarwal et al. the number of crossings.\n\n"
        "froe %s, %s, one thread.\n\n"
        "| source | claim | method | measured | range | is | breaks without | without | verdict |\n"
        "|---|---|---|---|---|---|---|---|---|\n",
        froe_version(), day);
}

int main(int argc, char **argv) {
    account a = {.quick = argc > 1 && !strcmp(argv[1], "--quick")};
    argc -= a.quick, argv += a.quick;
    const bool written = argc > 1 && strcmp(argv[1], "-") != 0;
    a.file = written ? fopen(argv[1], "w") : NULL;
    a.word = argc > 2 ? argv[2] : NULL;
    if (written && !a.file) {
        perror(argv[1]);
        return 1;
    }
    const double start = bench_now();
    bench_head("claims", 1);
    if (a.file) put_head(a.file);
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) run(&a, all[i]);
    printf("%d hold, %d fail; %.0f s\n", a.held, a.failed, bench_now() - start);
    if (a.file) fprintf(a.file, "\n%d hold, %d fail.\n", a.held, a.failed);
    return (a.file && fclose(a.file)) || a.failed || !(a.held + a.failed) ? 1 : 0;
}
