/* claims.c: reproduces what the sources claim: each claim as a number in a range, measured now.
 *
 *     bench_claims [FILE [WORD]]
 *
 * Prints claim, range, number and verdict; writes the same as a table for the documents into FILE ("-": none).
 * With WORD only claims of sources and methods whose names hold it. Exit status 1 if a claim fails. Claims of methods
 * that are not built are told as such. A couple of minutes on one core. */
#include "claims.h"
#include "build/options.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

void claims_add(claims_series *s, double x, double y) {
    if (s->count == CLAIMS_SERIES) exit(1);
    s->x[s->count] = x, s->y[s->count++] = y;
}

double claims_slope(const claims_series *s) {
    return bench_exponent(s->x, s->y, s->count);
}

claims_tree claims_build(const char *kind, size_t n, const char *method, const char *settings, uint32_t leaf) {
    claims_tree t = {.scene = bench_generate(kind, n, 1)};
    const double start = bench_cpu();
    t.tree = bench_build_by(build_tuned, t.scene, method, settings, leaf, 1, NULL);
    t.seconds = bench_cpu() - start;
    t.report = froe_tree_report(t.tree);
    return t;
}

void claims_free(claims_tree *t) {
    froe_tree_free(t->tree);
    froe_scene_free(t->scene);
}

bool claims_has(const char *method) {
    const froe_method_info *m;
    for (size_t i = 0; (m = froe_method_at(i)) != NULL; i++)
        if (strcmp(m->name, method) == 0) return true;
    return false;
}

bool claims_serves(const froe_method_info *method, const froe_scene *scene) {
    return froe_method_serves(method, scene, FROE_LEAF_OWN);
}

/* ------------------------------------------------------------------- printing -- */

typedef struct account {
    int held, failed, absent;
    FILE *file;       /* NULL: none */
    const char *word; /* NULL: all claims */
} account;

static void put_range(char *text, size_t size, const claim *c) {
    if (c->least <= 0 && (c->least == 0 || isinf(c->least)))
        snprintf(text, size, "at most %g", c->most);
    else
        snprintf(text, size, "%g to %g", c->least, c->most);
}

static void tell(account *a, const claim *c, double value, double seconds) {
    char range[40], number[24] = "-";
    const bool absent = isnan(value) && c->method && !claims_has(c->method);
    const bool holds = value >= c->least && value <= c->most; /* not for NaN */
    const char *verdict = absent ? "not built" : holds ? "holds" : "FAILS";
    a->absent += absent, a->held += holds, a->failed += !absent && !holds;
    put_range(range, sizeof range, c);
    if (!absent) snprintf(number, sizeof number, "%.3g", value);
    printf("%-9s %8s  %-14s %s: %s%s%s: %s (%.1f s)\n", verdict, number, range, c->source, c->method ? c->method : "",
           c->method ? ", " : "", c->says, c->measured, seconds);
    fflush(stdout);
    if (a->file)
        fprintf(a->file, "| %s | %s | %s | %s | %s | %s | %s |\n", c->source, c->says, c->method ? c->method : "",
                c->measured, range, number, holds || absent ? verdict : "**fails**");
}

static void run(account *a, const claim *claims) {
    for (const claim *c = claims; c->source; c++) {
        if (a->word && !strstr(c->source, a->word) && !(c->method && strstr(c->method, a->word))) continue;
        const double start = bench_now();
        const bool there = !c->method || claims_has(c->method);
        const double value = there ? c->fn() : NAN;
        tell(a, c, value, bench_now() - start);
    }
}

static void put_head(FILE *file) {
    char day[32];
    const time_t now = time(NULL);
    strftime(day, sizeof day, "%Y-%m-%d", gmtime(&now));
    fprintf(file,
            "# Claims of the sources, measured\n\n"
            "This page compares the claims of the five sources with measurements. `make claims` measures them, as far\n"
            "as they are built, and writes this page. Each claim is a number and the range in which it must lie.\n"
            "Ranges have room for small n and lower terms, and many have two ends: an exponent below 0.9 does not\n"
            "show *linear*, and a scene that is quadratic in theory must be quadratic here. Exponents are least-\n"
            "squares slopes on log-log scales over at least three doublings. Nodes and pieces are counted. Times are\n"
            "processor times, the least of three.\n\n"
            "froe %s, %s, one thread.\n\n"
            "| source | claim | method | measured | range | is | verdict |\n|---|---|---|---|---|---|---|\n",
            froe_version(), day);
}

int main(int argc, char **argv) {
    const bool written = argc > 1 && strcmp(argv[1], "-") != 0;
    account a = {.file = written ? fopen(argv[1], "w") : NULL, .word = argc > 2 ? argv[2] : NULL};
    if (written && !a.file) {
        perror(argv[1]);
        return 1;
    }
    const double start = bench_now();
    bench_head("claims", 1);
    if (a.file) put_head(a.file);
    run(&a, claims_size);
    run(&a, claims_query);
    run(&a, claims_motion);
    printf("%d hold, %d fail, %d are of methods not built; %.0f s\n", a.held, a.failed, a.absent, bench_now() - start);
    if (a.file) fprintf(a.file, "\n%d hold, %d fail, %d are of methods not built.\n", a.held, a.failed, a.absent);
    return (a.file && fclose(a.file)) || a.failed ? 1 : 0;
}
