/* test_sides.c: law A1 of geom/predicates.h: every predicate, started at every stage, against exact rationals. */
#include "geom/sides.h"
#include "support/sanitized.h"
#include <stdlib.h>

enum { SHARE = SANITIZED_SHARE(8) };

typedef struct fixture {
    num_context context;
    sides_oracle oracle;
    sides_case c;
    sides_tally tally;
} fixture;

static uint64_t total;

static int setup(void **state) {
    fixture *f = calloc(1, sizeof *f);
    if (!f || num_context_new(NULL, &f->context) != FROE_OK) return 1;
    sides_oracle_init(&f->oracle);
    *state = f;
    return 0;
}

static int teardown(void **state) {
    fixture *f = *state;
    froe_predicate_stats *s = &f->context.stats;
    print_message("  %llu comparisons, %llu zeros certified by balls, %llu cases skipped\n",
                  (unsigned long long)f->tally.compared, (unsigned long long)f->tally.certified_zeros,
                  (unsigned long long)f->tally.skipped);
    assert_int_equal(s->calls, f->tally.compared);
    total += f->tally.compared;
    assert_int_equal(s->calls, s->by_id + s->filtered + s->refined + s->exact);
    assert_true(f->context.arena.high <= f->context.arena.capacity);
    sides_oracle_clear(&f->oracle);
    num_context_free(&f->context);
    free(f);
    return 0;
}

typedef void trial_fn(fixture *f, fuzz_class kind);

static void run_trials(fixture *f, int dim, int trials, trial_fn *fn) {
    for (int kind = 0; kind < FUZZ_CLASSES; kind++) {
        fuzz_source r = {(uint64_t)(kind * 1000 + dim)};
        for (int i = 0; i < trials / SHARE; i++) {
            sides_draw(&r, (fuzz_class)kind, dim, &f->c);
            fn(f, (fuzz_class)kind);
        }
    }
}

static void try_vertex(fixture *f, fuzz_class kind) {
    sides_oracle_set(&f->oracle, &f->c, 1);
    int expected = rational_side(&f->oracle.planes[0], &f->oracle.u);
    SIDES_CHECK(&f->context, &f->tally, expected, kind, geom_side_vertex(&f->context, &f->c.planes[0], f->c.u));
}

static void try_crossing(fixture *f, fuzz_class kind) {
    sides_oracle *o = &f->oracle;
    const geom_plane *h = &f->c.planes[0], *a = &f->c.planes[1];
    sides_oracle_set(o, &f->c, 2);
    int at_u = rational_side(&o->planes[1], &o->u), at_v = rational_side(&o->planes[1], &o->v);
    if (at_u == at_v || !rational_meet(&o->x, &o->planes[1], &o->u, &o->v)) {
        f->tally.skipped++;
        return;
    }
    int expected = rational_side(&o->planes[0], &o->x);
    SIDES_CHECK(&f->context, &f->tally, expected, kind, geom_side_crossing(&f->context, h, f->c.u, f->c.v, a));
}

static void try_corner(fixture *f, fuzz_class kind) {
    sides_oracle *o = &f->oracle;
    const geom_plane *p = f->c.planes;
    sides_oracle_set(o, &f->c, 4);
    if (!rational_corner(&o->x, &o->planes[1], &o->planes[2], &o->planes[3])) {
        f->tally.skipped++;
        return;
    }
    int expected = rational_side(&o->planes[0], &o->x);
    SIDES_CHECK(&f->context, &f->tally, expected, kind, geom_side_corner(&f->context, p, p + 1, p + 2, p + 3));
}

static void try_ball(fixture *f, fuzz_class kind) {
    sides_oracle_set(&f->oracle, &f->c, 1);
    if (!geom_plane_valid(&f->context, &f->c.planes[0])) {
        f->tally.skipped++;
        return;
    }
    int expected = rational_side_ball(&f->oracle.planes[0], &f->oracle.u, f->c.radius);
    SIDES_CHECK(&f->context, &f->tally, expected, kind,
                geom_side_ball(&f->context, &f->c.planes[0], f->c.u, f->c.radius));
}

static void sides_of_vertices_in_the_plane(void **state) {
    run_trials(*state, 2, 3000, try_vertex);
}
static void sides_of_vertices_in_space(void **state) {
    run_trials(*state, 3, 3000, try_vertex);
}
static void sides_of_crossings_in_the_plane(void **state) {
    run_trials(*state, 2, 6000, try_crossing);
}
static void sides_of_crossings_in_space(void **state) {
    run_trials(*state, 3, 6000, try_crossing);
}
static void sides_of_corners(void **state) {
    run_trials(*state, 3, 1000, try_corner);
}
static void sides_of_balls_in_the_plane(void **state) {
    run_trials(*state, 2, 2000, try_ball);
}
static void sides_of_balls_in_space(void **state) {
    run_trials(*state, 3, 2000, try_ball);
}

/* Normals so small that their products underflow, beside others so large that it matters. */
static void sides_of_corners_whose_cross_products_underflow(void **state) {
    fixture *f = *state;
    fuzz_source r = {4711};
    for (int i = 0; i < 8000 / SHARE; i++) {
        int sum = fuzz_int(&r, -1080, -1060), first = fuzz_int(&r, -700, -400);
        int powers[SIDES_PLANES] = {fuzz_int(&r, -10, 10), fuzz_int(&r, 0, 900), first, sum - first};
        sides_draw(&r, FUZZ_RANDOM, 3, &f->c);
        for (int k = 0; k < SIDES_PLANES; k++) {
            double n[3], *p = f->c.points + 9 * k;
            for (int j = 0; j < 3; j++) n[j] = ldexp(p[j], powers[k]);
            f->c.planes[k] = geom_plane_vector(3, n, ldexp(fuzz_unit(&r), powers[k]));
            for (int j = 0; j < 9; j++) p[j] = ldexp(p[j], powers[k] / 2);
            if (k == 1 && i % 2) f->c.planes[k] = geom_plane_points(3, (const double *const[]){p, p + 3, p + 6});
        }
        try_corner(f, FUZZ_RANDOM);
    }
}

static void half_a_million_answers_were_compared(void **state) {
    (void)state;
    assert_true(total >= 500000 / SHARE);
}

int main(void) {
#define TRIAL(name) cmocka_unit_test_setup_teardown(name, setup, teardown)
    const struct CMUnitTest tests[] = {
        TRIAL(sides_of_vertices_in_the_plane),
        TRIAL(sides_of_vertices_in_space),
        TRIAL(sides_of_crossings_in_the_plane),
        TRIAL(sides_of_crossings_in_space),
        TRIAL(sides_of_corners),
        TRIAL(sides_of_balls_in_the_plane),
        TRIAL(sides_of_balls_in_space),
        TRIAL(sides_of_corners_whose_cross_products_underflow),
        cmocka_unit_test(half_a_million_answers_were_compared),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
