/* measures.c: exponents and greatest values of numbers of trees. */
#include "build/options.h"
#include "claims.h"
#include <froe/measure.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

claims_tree claims_build_of(froe_scene *scene, const claims_way *way, uint32_t leaf) {
    claims_tree t = {.scene = scene, .way = *way};
    const double start = bench_cpu();
    t.tree = claims_lacking(scene, way->method, leaf);
    if (!t.tree) t.tree = bench_build_by(build_tuned, scene, way->method, way->settings, leaf, 1, NULL);
    t.seconds = bench_cpu() - start;
    t.report = froe_tree_report(t.tree);
    t.n = (double)t.report.objects;
    return t;
}

claims_tree claims_build(const char *kind, size_t n, size_t lambda, const claims_way *way, uint32_t leaf) {
    claims_tree t = claims_build_of(claims_scene(kind, n, lambda), way, leaf);
    t.lambda = (double)lambda;
    return t;
}

void claims_free(claims_tree *t) {
    froe_tree_free(t->tree);
    froe_scene_free(t->scene);
}

void claims_add(claims_series *s, double x, double y) {
    if (s->count == CLAIMS_SERIES) {
        fputs("claims: A series has too many numbers.\n", stderr);
        exit(1);
    }
    s->x[s->count] = x, s->y[s->count++] = y;
}

double claims_slope(const claims_series *s) {
    return bench_exponent(s->x, s->y, s->count);
}

double claims_size(const claims_tree *t) {
    return (double)t->report.size;
}
double claims_pieces(const claims_tree *t) {
    return (double)t->report.fragments;
}
double claims_height(const claims_tree *t) {
    return (double)t->report.height;
}
double claims_per_object(const claims_tree *t) {
    return claims_pieces(t) / t->n;
}
double claims_high(const claims_tree *t) {
    return claims_height(t) / log2(t->n);
}

double claims_n_log_n(const claims_tree *t) {
    return t->n * log(t->n);
}

double claims_density(const froe_scene *scene) {
    froe_measure_options o = froe_measure_defaults();
    froe_density d = {.upper = 0};
    o.samples = 0;
    bench_must(froe_measure_density(scene, FROE_SIZE_DIAMETER, &o, &d, NULL), NULL);
    return (double)d.upper;
}

/** The greatest over kinds of what `fn` finds of one. */
typedef double kind_fn(const claims_way *way, const claims_plan *plan, const char *kind);
static double worst(const claims_way *way, const claims_plan *plan, kind_fn *fn) {
    double most = -INFINITY;
    for (const char *const *kind = plan->kinds; *kind; kind++) most = fmax(most, fn(way, plan, *kind));
    return most;
}

static uint32_t leaf_of(const claims_plan *plan) {
    return plan->leaf ? plan->leaf : plan->cuts ? 0 : FROE_LEAF_OWN;
}

/** n doubled, or lambda. */
static claims_series series(const claims_way *way, const claims_plan *plan, const char *kind, bool lambda) {
    claims_series s = {.count = 0};
    for (int i = 0; i <= plan->doublings; i++) {
        const size_t n = lambda ? plan->from : plan->from << i, groups = lambda ? plan->lambda << i : plan->lambda;
        claims_tree t = claims_build(kind, n, groups, way, leaf_of(plan));
        claims_add(&s, lambda ? t.lambda : t.n, plan->value(&t));
        claims_free(&t);
    }
    return s;
}

static double growth_of(const claims_way *way, const claims_plan *plan, const char *kind) {
    const claims_series s = series(way, plan, kind, false);
    return claims_slope(&s);
}
double claims_growth(const claims_way *way, const void *of) {
    return worst(way, of, growth_of);
}

double claims_of_two(const claims_way *way, const void *of) {
    const claims_plan *two = of;
    return claims_growth(way, two + way->bare);
}

static double growth_in_log(const claims_way *way, const claims_plan *plan, const char *kind) {
    claims_series s = series(way, plan, kind, false);
    for (size_t i = 0; i < s.count; i++) s.x[i] = log(s.x[i]);
    return claims_slope(&s);
}
double claims_by_log_n(const claims_way *way, const void *of) {
    return worst(way, of, growth_in_log);
}

static double growth_in_lambda(const claims_way *way, const claims_plan *plan, const char *kind) {
    const claims_series s = series(way, plan, kind, true);
    return claims_slope(&s);
}
double claims_by_lambda(const claims_way *way, const void *of) {
    return worst(way, of, growth_in_lambda);
}

static double most_of(const claims_way *way, const claims_plan *plan, const char *kind) {
    const claims_series s = series(way, plan, kind, false);
    double most = -INFINITY;
    for (size_t i = 0; i < s.count; i++) most = fmax(most, s.y[i]);
    return most;
}
double claims_most(const claims_way *way, const void *of) {
    return worst(way, of, most_of);
}

/** Time is noisy: the least of three. */
static double time_of(const claims_way *way, const claims_plan *plan, const char *kind) {
    claims_series s = {.count = 0};
    for (int i = 0; i <= plan->doublings; i++) {
        double least = INFINITY, n = 0;
        for (int round = 0; round < 3; round++) {
            claims_tree t = claims_build(kind, plan->from << i, plan->lambda, way, leaf_of(plan));
            least = fmin(least, t.seconds / plan->value(&t));
            n = t.n;
            claims_free(&t);
        }
        claims_add(&s, n, least);
    }
    return claims_slope(&s);
}
double claims_time(const claims_way *way, const void *of) {
    return worst(way, of, time_of);
}
