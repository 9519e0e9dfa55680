/* motion.c: Agarwal, Erickson and Guibas, section 3: partitions that follow moving segments and triangles. */
#include "claims.h"
#include <math.h>
#include <stdlib.h>

/* -------------------------------------------------------------------- scenes -- */

/** Segments that go straight from one place to another in the window 0 .. 1: 8 numbers each, x and y of both ends
 * before and after. */
static froe_motion *straight(const double *ends, size_t n) {
    froe_diagnostic diag = {0};
    froe_motion *motion = NULL;
    froe_motion_options w = froe_motion_defaults();
    froe_moving b = froe_moving_defaults();
    size_t *starts = bench_take(2 * n + 1, sizeof *starts);
    double *times = bench_take(4 * n, sizeof *times), *coords = bench_take(8 * n, sizeof *coords);
    for (size_t v = 0; v < 2 * n; v++) {
        const double *before = ends + 8 * (v / 2) + 2 * (v % 2), *after = before + 4;
        starts[v + 1] = 2 * v + 2;
        times[2 * v] = 0, times[2 * v + 1] = 1;
        for (int k = 0; k < 2; k++) coords[4 * v + (size_t)k] = before[k], coords[4 * v + 2 + (size_t)k] = after[k];
    }
    w.begin = 0, w.end = 1;
    b.vertex_count = 2 * n, b.starts = starts, b.times = times, b.coords = coords, b.count = n;
    bench_must(froe_motion_new(&w, NULL, &motion, &diag), &diag);
    bench_must(froe_motion_add(motion, &b, &diag), &diag);
    free(starts), free(times), free(coords);
    return motion;
}

static void put_moving(double *out, double x, double y, double dx, double dy, double go_x, double go_y) {
    const double numbers[8] = {x, y, x + dx, y + dy, x + go_x, y + go_y, x + dx + go_x, y + dy + go_y};
    for (int k = 0; k < 8; k++) out[k] = numbers[k];
}

/** n - m long segments above one another, and m short ones below that pass one another; the short ones come first. */
static froe_motion *passing(size_t n, size_t m) {
    double *ends = bench_take(8 * n, sizeof *ends);
    uint64_t state = 1;
    for (size_t i = 0; i < n; i++) {
        const double t = ((double)i + 0.5) / (double)n, e = 0.01 * bench_unit(&state) / (double)n;
        if (i < m) {
            const double go = bench_unit(&state) - 0.5, x = bench_unit(&state);
            put_moving(ends + 8 * i, x, -1 + 0.9 * t, 0.1 / (double)n, e, go, 0);
        } else {
            put_moving(ends + 8 * i, -2 - t, 1 + t, 5 + 2 * t, e, 0, 0);
        }
    }
    froe_motion *motion = straight(ends, n);
    free(ends);
    return motion;
}

/** Half of all pass. */
static froe_motion *half_passing(size_t n) {
    return passing(n, n / 2);
}

/** n - m short segments that stand still, and m that pass below all of them at speeds of their own. */
static froe_motion *sweeping(size_t n, size_t m) {
    double *ends = bench_take(8 * n, sizeof *ends);
    uint64_t state = 1;
    for (size_t i = 0; i < n; i++) {
        const double t = ((double)i + 0.5) / (double)n, e = 0.01 / (double)n;
        const double x = bench_unit(&state), go = i < m ? 1.5 + bench_unit(&state) : 0;
        put_moving(ends + 8 * i, i < m ? x - 1.1 : x, i < m ? t - 1 : t, 3 * e, e * bench_unit(&state), go, 0);
    }
    froe_motion *motion = straight(ends, n);
    free(ends);
    return motion;
}

/** A lattice of level and upright segments, and another above it that passes over. Each begins with what lies farthest
 * from the other: in this order the walls of all crossings reach those of the other lattice. */
static froe_motion *lattices(size_t n) {
    const size_t quarter = n / 4;
    double *ends = bench_take(8 * n, sizeof *ends);
    uint64_t state = 1;
    for (size_t k = 0; k < n; k++) {
        const double t = ((double)(k % quarter) + 0.5) / (double)quarter,
                     e = 0.2 * bench_unit(&state) / (double)quarter;
        const bool upright = k < n / 2, above = k / quarter % 2;
        const double side = above ? 1 : -1, go = above ? 1.5 : 0, from = above ? -0.75 : 0;
        if (upright)
            put_moving(ends + 8 * k, from + t + e, side * 0.9, e, side * 1.2, go, 0);
        else
            put_moving(ends + 8 * k, from - 0.1, side * (2 - t) + 0.1 * e, 1.2, 0.1 * e, go, 0);
    }
    froe_motion *motion = straight(ends, n);
    free(ends);
    return motion;
}

/** One segment that turns through the vertical, and n - 1 that cross it. */
static froe_motion *turning(size_t n) {
    double *ends = bench_take(8 * n, sizeof *ends);
    const double turn[8] = {-0.1, -1, 0.1, 1, 0.1, -1, -0.1, 1};
    uint64_t state = 1;
    for (size_t i = 0; i < n; i++)
        put_moving(ends + 8 * i, -1 - 0.5 * bench_unit(&state), 0.9 * (2 * ((double)i + 0.5) / (double)n - 1),
                   2 + 0.5 * bench_unit(&state), 0.1 * bench_unit(&state) / (double)n, 0, 0);
    for (int k = 0; k < 8; k++) ends[k] = turn[k];
    froe_motion *motion = straight(ends, n);
    free(ends);
    return motion;
}

/** Triangles in layers of their own over the unit square, so small that about as many lie above one another whatever n
 * is. The first m of them move, each corner on its own way. The window is so short that events grow like n. */
static froe_motion *layers(size_t n, size_t m) {
    froe_diagnostic diag = {0};
    froe_motion *motion = NULL;
    froe_motion_options w = froe_motion_defaults();
    froe_moving b = froe_moving_defaults();
    size_t *starts = bench_take(3 * n + 1, sizeof *starts);
    double *times = bench_take(6 * n, sizeof *times), *coords = bench_take(18 * n, sizeof *coords);
    uint64_t state = 1;
    const double reach = 0.7 / sqrt((double)n);
    double middle[2] = {0, 0}, drift[2] = {0, 0};
    for (size_t v = 0; v < 3 * n; v++) {
        const size_t triangle = v / 3;
        starts[v + 1] = 2 * v + 2;
        times[2 * v] = 0, times[2 * v + 1] = 1;
        for (size_t k = 0; k < 2; k++) {
            if (v % 3 == 0) middle[k] = bench_unit(&state), drift[k] = bench_unit(&state) - 0.5;
            const double at = middle[k] + reach * (2 * bench_unit(&state) - 1);
            const double go = drift[k] + reach * (2 * bench_unit(&state) - 1);
            coords[6 * v + k] = at, coords[6 * v + 3 + k] = triangle < m ? at + go : at;
        }
        coords[6 * v + 2] = coords[6 * v + 5] = (double)triangle + 0.5 * bench_unit(&state);
    }
    w.dim = 3, w.begin = 0, w.end = 2 / (double)n;
    b.vertex_count = 3 * n, b.starts = starts, b.times = times, b.coords = coords, b.count = n;
    bench_must(froe_motion_new(&w, NULL, &motion, &diag), &diag);
    bench_must(froe_motion_add(motion, &b, &diag), &diag);
    free(starts), free(times), free(coords);
    return motion;
}

static froe_motion *all_layers(size_t n) {
    return layers(n, n);
}

/* --------------------------------------------------------------------- rides -- */

typedef struct ride {
    double n;
    froe_kinetic_stats start, end;
    double events;
    uint32_t height; /* the greatest seen */
} ride;

typedef struct ride_order {
    bool sorted; /* not random */
    bool augmented;
    uint64_t epoch, swap; /* as in froe_kinetic_options */
} ride_order;

static ride ride_along(froe_motion *motion, uint64_t seed, const ride_order *how) {
    enum { STOPS = 8 };
    const froe_motion_options window = froe_motion_window(motion);
    const size_t n = froe_motion_object_count(motion);
    uint32_t *order = bench_take(n, sizeof *order);
    froe_kinetic *kinetic = NULL;
    froe_kinetic_options options = froe_kinetic_defaults();
    froe_diagnostic diag = {0};
    for (size_t i = 0; i < n; i++) order[i] = (uint32_t)i;
    options.seed = seed, options.order = how->sorted ? order : NULL, options.augmented = how->augmented;
    options.epoch = how->epoch, options.swap = how->swap;
    bench_must(froe_kinetic_new(motion, &options, NULL, &kinetic, &diag), &diag);
    ride r = {.n = (double)n, .start = froe_kinetic_statistics(kinetic)};
    r.height = r.start.height;
    for (int i = 1; i <= STOPS; i++) {
        const double time = window.begin + (window.end - window.begin) * i / STOPS;
        bench_must(froe_kinetic_advance(kinetic, time, NULL, NULL, &diag), &diag);
        r.end = froe_kinetic_statistics(kinetic);
        if (r.end.height > r.height) r.height = r.end.height;
    }
    for (int k = 0; k < FROE_EVENT_KINDS; k++) r.events += (double)r.end.events[k];
    froe_kinetic_free(kinetic);
    free(order);
    return r;
}

/** What a measure follows: n doubled so many times. */
typedef double ride_value(const ride *r);
typedef struct course {
    froe_motion *(*motion)(size_t n);
    size_t from;
    int doublings;
    ride_value *value;
} course;

static double touched(const ride *r) {
    return (double)(r->end.nodes_touched - r->start.nodes_touched);
}
static double touched_an_event(const ride *r) {
    return touched(r) / r->events;
}
static double made_an_event(const ride *r) {
    return (double)(r->end.certificates_made - r->start.certificates_made) / r->events;
}
static double certificates_over_n(const ride *r) {
    return (double)r->start.certificates / r->n;
}
static double nodes_over_n(const ride *r) {
    return (double)r->start.nodes / r->n;
}
static double events(const ride *r) {
    return r->events;
}
static double high(const ride *r) {
    return (double)r->height / log2(r->n);
}

/** The mean of some random orders. */
static claims_series follow(const course *c, bool sorted, uint64_t epoch) {
    enum { ORDERS = 5 };
    claims_series s = {.count = 0};
    for (int i = 0; i <= c->doublings; i++) {
        double sum = 0, n = 0;
        for (uint64_t seed = 1; seed <= ORDERS; seed++) {
            froe_motion *motion = c->motion(c->from << i);
            const ride r = ride_along(motion, seed, &(ride_order){.sorted = sorted, .epoch = epoch});
            sum += c->value(&r) / ORDERS, n = r.n;
            froe_motion_free(motion);
        }
        claims_add(&s, n, sum);
    }
    return s;
}

/** Exponent in n; bare: in the order of the objects. */
static double ride_growth(const claims_way *way, const void *of) {
    const claims_series s = follow(of, way->bare, 0);
    return claims_slope(&s);
}
/** The same; bare: the whole partition is made anew after each event. */
static double repair_growth(const claims_way *way, const void *of) {
    const claims_series s = follow(of, false, way->bare ? 1 : 0);
    return claims_slope(&s);
}
/** Exponent of certificates an object in n; bare: of nodes. */
static double certificate_growth(const claims_way *way, const void *of) {
    const claims_series s =
        follow(&(const course){half_passing, 32, 3, way->bare ? nodes_over_n : certificates_over_n}, false, 0);
    (void)of;
    return claims_slope(&s);
}
static double ride_most(const claims_way *way, const void *of) {
    const claims_series s = follow(of, way->bare, 0);
    double most = 0;
    for (size_t i = 0; i < s.count; i++) most = fmax(most, s.y[i]);
    return most;
}

typedef froe_motion *partly_moving(size_t n, size_t m);

/** Exponent of events in m, of m of 256 objects that move; bare: all move. */
static double events_by_m(const claims_way *way, const void *of) {
    enum { N = 256 };
    claims_series s = {.count = 0};
    partly_moving *const *motion_of = of;
    for (size_t m = 16; m <= N / 2; m *= 2) {
        froe_motion *motion = (*motion_of)(N, way->bare ? N : m);
        const ride r = ride_along(motion, 1, &(ride_order){0});
        claims_add(&s, (double)m, r.events);
        froe_motion_free(motion);
    }
    return claims_slope(&s);
}

/** Exponent in k of the nodes touched when a segment that k others cross turns upright; the mean of orders. */
static double touched_by_turns(const claims_way *way, const void *of) {
    claims_series s = {.count = 0};
    (void)of;
    for (size_t k = 8; k <= 256; k *= 2) {
        double sum = 1; /* the turn itself */
        for (uint64_t seed = 1; seed <= 16; seed++) {
            froe_motion *motion = turning(k + 1);
            const ride r = ride_along(motion, seed, &(ride_order){.augmented = !way->bare});
            sum += touched(&r) / 16;
            froe_motion_free(motion);
        }
        claims_add(&s, (double)k, sum);
    }
    return claims_slope(&s);
}

/** Height / log2 n at the end, from the worst order at the beginning, with a swap after each event; bare: without. */
static double height_after_swaps(const claims_way *way, const void *of) {
    double most = 0;
    (void)of;
    for (size_t n = 32; n <= 256; n *= 2) {
        double sum = 0;
        for (uint64_t seed = 1; seed <= 5; seed++) {
            froe_motion *motion = half_passing(n);
            const ride r = ride_along(motion, seed, &(ride_order){.sorted = true, .swap = !way->bare});
            sum += (double)r.end.height / log2(r.n) / 5;
            froe_motion_free(motion);
        }
        most = fmax(most, sum);
    }
    return most;
}

const claim claims_motion[] = {
    {.source = "Agarwal et al., theorem 3.7",
     .says = "O(n^2 lambda_s(n)) events, however many crossings pass one another",
     .measured = "exponent of events in n, 8 to 64 segments of two lattices",
     .least = 1,
     .most = 2.6,
     .measure = ride_growth,
     .of = &(const course){lattices, 8, 3, events},
     .needs = "random order",
     .without = {.bare = true}},
    {.source = "Agarwal et al., theorem 3.7",
     .says = "O(m n) events when m of n move",
     .measured = "exponent of events in m, m = 16 .. 128 of 256",
     .least = 0.6,
     .most = 1.3,
     .measure = events_by_m,
     .of = &(partly_moving *const){sweeping},
     .needs = "segments that stand still: all move, whatever m",
     .without = {.bare = true},
     .kind = CLAIM_QUICK},
    {.source = "Agarwal et al., lemmas 3.2, 3.3, 3.5",
     .says = "O(log n) expected work an event",
     .measured = "exponent of nodes touched an event in n, half passing below the others",
     .least = -INFINITY,
     .most = 0.6,
     .measure = ride_growth,
     .of = &(const course){half_passing, 32, 3, touched_an_event},
     .needs = "random order",
     .without = {.bare = true}},
    {.source = "Agarwal et al., lemma 3.6",
     .says = "flips are free in the augmented partition",
     .measured = "exponent in k of the nodes touched when a segment that k others cross turns upright, k = 8 .. 256",
     .least = -INFINITY,
     .most = 0.2,
     .measure = touched_by_turns,
     .needs = "walls named in the direction of their segment: left and right",
     .without = {.bare = true},
     .kind = CLAIM_QUICK},
    {.source = "Agarwal et al., lemma 3.1",
     .says = "O(1) new certificates an event",
     .measured = "exponent of certificates made an event in n, half passing below the others",
     .least = -INFINITY,
     .most = 0.25,
     .measure = repair_growth,
     .of = &(const course){half_passing, 16, 3, made_an_event},
     .needs = "repair: the partition is made anew after each event",
     .without = {.bare = true}},
    {.source = "Agarwal et al., lemma 3.1",
     .says = "O(n + k) certificates",
     .measured = "exponent of certificates / n in n, half passing below the others (k = 0)",
     .least = -INFINITY,
     .most = 0.1,
     .measure = certificate_growth,
     .needs = "certificates for what can change: one for each node",
     .without = {.bare = true},
     .kind = CLAIM_QUICK},
    {.source = "Agarwal et al., theorem 2.3",
     .says = "height O(log n) at all times",
     .measured = "greatest height / log2 n, half passing below the others, 32 to 256 segments",
     .least = 1,
     .most = 6,
     .measure = ride_most,
     .of = &(const course){half_passing, 32, 3, high},
     .needs = "random order",
     .without = {.bare = true}},
    {.source = "Agarwal et al., theorem 3.8",
     .says = "O(log^2 n) expected work an event of triangles in space",
     .measured = "exponent of nodes touched an event in n, 16 to 128 small triangles in layers, all moving",
     .least = -INFINITY,
     .most = 0.6,
     .measure = repair_growth,
     .of = &(const course){all_layers, 16, 3, touched_an_event},
     .needs = "repair: the partition is made anew after each event",
     .without = {.bare = true}},
    {.source = "Agarwal et al., theorem 3.8",
     .says = "O(m n lambda_s(n)) events in space when m of n triangles move",
     .measured = "exponent of events in m, m = 16 .. 128 of 256 small triangles in layers",
     .least = 0.6,
     .most = 1.3,
     .measure = events_by_m,
     .of = &(partly_moving *const){layers},
     .needs = "triangles that stand still: all move, whatever m",
     .without = {.bare = true},
     .kind = CLAIM_QUICK},
    {.source = "Agarwal et al., theorem 3.8",
     .says = "O(1) new certificates an event in space",
     .measured = "exponent of certificates made an event in n, 16 to 128 small triangles in layers, all moving",
     .least = -INFINITY,
     .most = 0.25,
     .measure = repair_growth,
     .of = &(const course){all_layers, 16, 3, made_an_event},
     .needs = "repair: the partition is made anew after each event",
     .without = {.bare = true}},
    {.source = "Agarwal et al., section 4",
     .says = "an open problem: motion that depends on the order; two segments change places in it after each event",
     .measured = "greatest height / log2 n at the end, from the worst order, half passing below the others, 32 to 256",
     .least = 1,
     .most = 6,
     .measure = height_after_swaps,
     .needs = "random swaps of the order",
     .without = {.bare = true}},
    {0}};
