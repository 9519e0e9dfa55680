/* predicates.c: nanoseconds a call of each predicate, from each stage on, and which stages decide.
 *
 * "filter" is the predicate as used: filter, coincidences, balls, dyadic numbers. "ball" and
 * "exact" skip what comes before. Planes are made beforehand ("plane": what that costs). */
#include "geom/predicates.h"
#include "support/fuzz.h"
#include <stdio.h>
#include <time.h>

enum { CASES = 512, POINTS = 14 };

typedef struct bench_case {
    double p[POINTS * 3];
    geom_plane h, s, a, b;
    const double *u, *v;
    int at_u, at_v; /* sides of a */
    bool corner;    /* three independent planes */
} bench_case;

typedef int predicate_fn(num_context *context, const bench_case *c);

static int vertex(num_context *context, const bench_case *c) {
    return geom_side_vertex(context, &c->h, c->u);
}
static int crossing(num_context *context, const bench_case *c) {
    return c->at_u * c->at_v < 0 ? geom_side_crossing(context, &c->h, c->u, c->v, &c->a) : 3;
}
static int corner(num_context *context, const bench_case *c) {
    return c->corner ? geom_side_corner(context, &c->h, &c->s, &c->a, &c->b) : 3;
}
static int ball(num_context *context, const bench_case *c) {
    return geom_side_ball(context, &c->h, c->u, 0.5);
}
static int image(num_context *context, const bench_case *c) {
    context->stats.calls++;
    return geom_side_image(&c->h, c->u, 1e-15);
}
static int image_of_crossing(num_context *context, const bench_case *c) {
    double out[3];
    context->stats.calls++;
    return geom_image_crossing(c->u, c->v, &c->a, out) < 1;
}
static int image_of_corner(num_context *context, const bench_case *c) {
    double out[3];
    context->stats.calls++;
    return geom_image_corner(&c->s, &c->a, &c->b, out) < 1;
}
static int rounded_crossing(num_context *context, const bench_case *c) {
    double out[3];
    if (c->at_u * c->at_v >= 0) return 3;
    context->stats.calls++;
    geom_round_crossing(context, c->u, c->v, &c->a, out);
    return out[0] > 0;
}
static int rounded_corner(num_context *context, const bench_case *c) {
    double out[3];
    if (!c->corner) return 3;
    context->stats.calls++;
    geom_round_corner(context, &c->s, &c->a, &c->b, out);
    return out[0] > 0;
}
static int plane(num_context *context, const bench_case *c) {
    const double *p[3] = {c->p, c->p + c->h.dim, c->p + 2 * c->h.dim};
    context->stats.calls++;
    return geom_plane_points(c->h.dim, p).n_err == 0;
}

static const struct {
    const char *name;
    predicate_fn *fn;
    int dim;
    bool staged;
} predicates[] = {
    {"vertex", vertex, 2, true},
    {"vertex", vertex, 3, true},
    {"crossing", crossing, 2, true},
    {"crossing", crossing, 3, true},
    {"corner", corner, 3, true},
    {"ball", ball, 3, true},
    {"side_image", image, 3, false},
    {"image_crossing", image_of_crossing, 3, false},
    {"image_corner", image_of_corner, 3, false},
    {"round_crossing", rounded_crossing, 3, false},
    {"round_corner", rounded_corner, 3, false},
    {"plane_points", plane, 3, false},
};

static double seconds(void) {
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* No corner where the exact divisor vanishes: then s is on the wrong side of being a question. */
static bool independent(const bench_case *c) {
    double out[3];
    return geom_image_corner(&c->s, &c->a, &c->b, out) < INFINITY;
}

static void draw(num_context *context, fuzz_class kind, int dim, bench_case *cases) {
    fuzz_source r = {(uint64_t)kind};
    for (int i = 0; i < CASES; i++) {
        bench_case *c = &cases[i];
        geom_plane *planes[4] = {&c->h, &c->s, &c->a, &c->b};
        fuzz_points(&r, kind, dim, c->p, POINTS);
        for (int k = 0; k < 4; k++) {
            const double *at = c->p + k * dim * dim;
            *planes[k] = geom_plane_points(dim, (const double *const[]){at, at + dim, at + 2 * dim});
        }
        c->u = c->p + 12 * dim;
        c->v = c->u + dim;
        c->at_u = geom_side_vertex(context, &c->a, c->u);
        c->at_v = geom_side_vertex(context, &c->a, c->v);
        c->corner = dim == 3 && independent(c);
    }
}

/* Best of several rounds, ns a call. */
static double measure(num_context *context, num_stage first, predicate_fn *fn, const bench_case *cases) {
    double best = INFINITY;
    int sum = 0;
    context->first = first;
    for (int round = 0; round < 7; round++) {
        context->stats = (froe_predicate_stats){0};
        double start = seconds();
        for (int k = 0; k < (first == NUM_EXACT ? 2 : 8); k++)
            for (int i = 0; i < CASES; i++) sum += fn(context, &cases[i]);
        double ns = 1e9 * (seconds() - start) / (double)context->stats.calls;
        best = ns < best ? ns : best;
    }
    return sum == -12345 ? 0 : best;
}

int main(void) {
    static bench_case cases[CASES];
    static const fuzz_class classes[] = {FUZZ_RANDOM,    FUZZ_FAR,        FUZZ_LATTICE,         FUZZ_FLAT,
                                         FUZZ_NEAR_FLAT, FUZZ_CONCURRENT, FUZZ_NEAR_CONCURRENT, FUZZ_WIDE};
    num_context context;
    if (num_context_new(NULL, &context) != FROE_OK) return 1;
    printf("%-15s %-3s %-15s %8s %8s %8s   %7s %7s %7s %7s\n", "predicate", "dim", "class", "filter", "ball", "exact",
           "%filter", "%id", "%ball", "%exact");
    for (size_t i = 0; i < sizeof predicates / sizeof *predicates; i++)
        for (size_t k = 0; k < sizeof classes / sizeof *classes; k++) {
            if (!predicates[i].staged && k > 0) break;
            context.first = NUM_FILTER;
            draw(&context, classes[k], predicates[i].dim, cases);
            double ns = measure(&context, NUM_FILTER, predicates[i].fn, cases);
            froe_predicate_stats s = context.stats;
            if (!s.calls) continue; /* every such question is degenerate */
            double share = 100.0 / (double)s.calls;
            printf("%-15s %-3d %-15s %8.1f", predicates[i].name, predicates[i].dim, fuzz_names[classes[k]], ns);
            if (predicates[i].staged)
                printf(" %8.1f %8.1f   %7.2f %7.2f %7.2f %7.2f", measure(&context, NUM_BALL, predicates[i].fn, cases),
                       measure(&context, NUM_EXACT, predicates[i].fn, cases), share * (double)s.filtered,
                       share * (double)s.by_id, share * (double)s.refined, share * (double)s.exact);
            printf("\n");
        }
    num_context_free(&context);
    return 0;
}
