/* test_images.c: rounded points are the nearest doubles; images keep their certified error. */
#include "geom/sides.h"

typedef struct fixture {
    num_context context;
    sides_oracle oracle;
    sides_case c;
} fixture;

typedef struct quality {
    int points, certain, tight; /* tight: error below 1e-12 of the scene's size, random classes */
} quality;

static void assert_rounded(rational_point *x, const double *out) {
    mpq_t exact;
    mpq_init(exact);
    for (int k = 0; k < x->dim; k++) {
        rational_coordinate(exact, x, k);
        assert_true(rational_rounds_to(exact, out[k]));
        assert_true(out[k] != 0 || !signbit(out[k]));
    }
    mpq_clear(exact);
}

/* What geom_side_image is sure of must be true of every point within the error, so of x. */
static void assert_image(fixture *f, const double *out, double error, quality *q) {
    rational_point *x = &f->oracle.x;
    assert_true(rational_within(x, out, error));
    q->points++;
    q->certain += error < INFINITY;
    q->tight += error < 1e-11;
    int sure = geom_side_image(&f->c.planes[0], out, error);
    assert_int_not_equal(sure, 0);
    if (sure != NUM_UNSURE) assert_int_equal(sure, rational_side(&f->oracle.planes[0], x));
}

static void try_crossing(fixture *f, quality *q) {
    sides_oracle *o = &f->oracle;
    const geom_plane *a = &f->c.planes[1];
    double out[3];
    int at_u = rational_side(&o->planes[1], &o->u), at_v = rational_side(&o->planes[1], &o->v);
    if (at_u == at_v || !rational_meet(&o->x, &o->planes[1], &o->u, &o->v)) return;
    geom_round_crossing(&f->context, f->c.u, f->c.v, a, out);
    assert_rounded(&o->x, out);
    if (at_u * at_v > 0) return;
    double error = geom_image_crossing(f->c.u, f->c.v, a, out);
    for (int k = 0; k < f->c.dim; k++)
        assert_true(fmin(f->c.u[k], f->c.v[k]) <= out[k] && out[k] <= fmax(f->c.u[k], f->c.v[k]));
    if (a->form == GEOM_AXIS) assert_true(out[a->axis] == a->c);
    assert_image(f, out, error, q);
}

static void try_corner(fixture *f, quality *q) {
    sides_oracle *o = &f->oracle;
    const geom_plane *s = &f->c.planes[1], *a = s + 1, *b = s + 2;
    double out[3];
    if (!rational_corner(&o->x, &o->planes[1], &o->planes[2], &o->planes[3])) return;
    geom_round_corner(&f->context, s, a, b, out);
    assert_rounded(&o->x, out);
    double error = geom_image_corner(s, a, b, out);
    assert_image(f, out, error, q);
}

static quality run(fixture *f, fuzz_class kind, int dim, int trials, void (*fn)(fixture *, quality *)) {
    fuzz_source r = {(uint64_t)(kind * 10 + dim)};
    quality q = {0};
    for (int i = 0; i < trials; i++) {
        sides_draw(&r, kind, dim, &f->c);
        sides_oracle_set(&f->oracle, &f->c, SIDES_PLANES);
        fn(f, &q);
    }
    return q;
}

static void crossings_round_to_the_nearest_double_and_images_keep_their_error(void **state) {
    for (int dim = 2; dim <= 3; dim++)
        for (int kind = 0; kind < FUZZ_CLASSES; kind++) {
            quality q = run(*state, (fuzz_class)kind, dim, 1000, try_crossing);
            if (kind == FUZZ_RANDOM) assert_true(q.points > 300 && q.tight > 0.98 * q.points);
        }
}

static void corners_round_to_the_nearest_double_and_images_keep_their_error(void **state) {
    for (int kind = 0; kind < FUZZ_CLASSES; kind++) {
        quality q = run(*state, (fuzz_class)kind, 3, 700, try_corner);
        if (kind == FUZZ_RANDOM) assert_true(q.points > 600 && q.tight > 0.95 * q.points);
    }
}

static void i1_i2_images_of_vertices_are_sure_only_of_the_truth(void **state) {
    fixture *f = *state;
    int sure[FUZZ_CLASSES] = {0};
    for (int kind = 0; kind < FUZZ_CLASSES; kind++) {
        fuzz_source r = {(uint64_t)kind};
        for (int i = 0; i < 2000; i++) {
            sides_draw(&r, (fuzz_class)kind, 2 + i % 2, &f->c);
            sides_oracle_set(&f->oracle, &f->c, 1);
            int side = geom_side_image(&f->c.planes[0], f->c.u, 0);
            if (side == NUM_UNSURE) continue;
            assert_int_equal(side, rational_side(&f->oracle.planes[0], &f->oracle.u));
            sure[kind]++;
        }
    }
    assert_int_equal(sure[FUZZ_RANDOM], 2000);
}

/* A point anywhere in the box of an image: shifted by its whole error, the worst it may be. */
static void i1_images_allow_for_their_whole_error(void **state) {
    fixture *f = *state;
    int sure = 0;
    for (int kind = 0; kind < FUZZ_WIDE; kind++) {
        fuzz_source r = {(uint64_t)kind + 77};
        for (int i = 0; i < 2000; i++) {
            sides_draw(&r, (fuzz_class)kind, 3, &f->c);
            double error = ldexp(1, fuzz_int(&r, -50, 2)), x[3];
            int side = geom_side_image(&f->c.planes[0], f->c.u, error);
            if (side == NUM_UNSURE) continue;
            for (int k = 0; k < 3; k++) x[k] = f->c.u[k] - copysign(error, side * f->c.planes[0].n[k]) * (1 - 0x1p-30);
            rational_plane_set(&f->oracle.planes[0], &f->c.planes[0]);
            rational_point_set(&f->oracle.x, 3, x);
            assert_int_equal(rational_side(&f->oracle.planes[0], &f->oracle.x), side);
            sure++;
        }
    }
    assert_true(sure > 10000);
}

static int setup(void **state) {
    static fixture f;
    sides_oracle_init(&f.oracle);
    *state = &f;
    return num_context_new(NULL, &f.context) != FROE_OK;
}

static int teardown(void **state) {
    fixture *f = *state;
    sides_oracle_clear(&f->oracle);
    num_context_free(&f->context);
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(crossings_round_to_the_nearest_double_and_images_keep_their_error),
        cmocka_unit_test(corners_round_to_the_nearest_double_and_images_keep_their_error),
        cmocka_unit_test(i1_i2_images_of_vertices_are_sure_only_of_the_truth),
        cmocka_unit_test(i1_images_allow_for_their_whole_error),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
