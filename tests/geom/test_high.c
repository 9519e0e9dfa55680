/* Polytopes of R^4 .. R^8 against the oracle: how they meet, how far points are from them, where rays meet them; every
 * class of coordinates, every stage of the decisions. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "geom/high/guess.h"
#include "geom/high/high.h"
#include "geom/meet/contact.h"
#include "geom/meet/distance.h"
#include "geom/meet/meet.h"
#include "oracle/high.h"
#include "support/fuzz.h"
#include "support/sanitized.h"

enum { SHARE = SANITIZED_SHARE(8) };

enum { POINTS = 24, MOST = FROE_MAX_DIM + 4 };

typedef struct fixture {
    num_context context;
    fuzz_source r;
    int dim;
    bool slow;
    double points[POINTS * FROE_MAX_DIM], box[2][2 * FROE_MAX_DIM];
    uint32_t corners[2][MOST];
    geom_body body[2];
    uint64_t counts[4], corner, meets, hits, starts;
} fixture;

static int setup(void **state) {
    fixture *f = calloc(1, sizeof *f);
    *state = f;
    return !f || num_context_new(NULL, &f->context) != FROE_OK;
}

static int teardown(void **state) {
    fixture *f = *state;
    const froe_predicate_stats *s = &f->context.stats;
    print_message("  %llu calls, %llu exact, %zu limbs\n", (unsigned long long)s->calls, (unsigned long long)s->exact,
                  f->context.arena.high);
    assert_true(f->context.arena.high <= f->context.arena.capacity);
    num_context_free(&f->context);
    free(f);
    return 0;
}

/* Some points are sums of others, so that they lie in planes of these. */
static void draw_points(fixture *f, fuzz_class kind) {
    const size_t dim = (size_t)f->dim;
    for (size_t i = 0; i < POINTS * dim; i++) f->points[i] = fuzz_coordinate(&f->r, kind) + 0.0;
    if (kind > FUZZ_LATTICE) return;
    for (size_t i = 0; i < POINTS / 2; i++) {
        const double *p = f->points + base_below(fuzz_bits(&f->r), POINTS) * dim,
                     *q = f->points + base_below(fuzz_bits(&f->r), POINTS) * dim,
                     *s = f->points + base_below(fuzz_bits(&f->r), POINTS) * dim;
        for (size_t k = 0; k < dim; k++)
            f->points[i * dim + k] = i % 2 ? p[k] + (q[k] - s[k]) : 0.5 * p[k] + 0.5 * q[k];
    }
}

/* Two segments that cross in the middle of both. */
static void draw_crossing(fixture *f) {
    const size_t dim = (size_t)f->dim, last = (POINTS - 1) * dim;
    for (size_t k = 0; k < dim; k++) f->points[last + k] = f->points[k] + (f->points[dim + k] - f->points[2 * dim + k]);
    for (int i = 0; i < 2; i++) {
        f->corners[i][0] = i ? 2 : 0;
        f->corners[i][1] = i ? POINTS - 1 : 1;
        f->body[i] = (geom_body){.form = FROE_HULL, .dim = f->dim, .coords = f->points, .count = 2};
        f->body[i].corners = f->corners[i];
    }
}

static void draw_body(fixture *f, int which) {
    static const froe_kind kinds[] = {FROE_SEGMENT, FROE_HULL, FROE_HULL, FROE_HULL, FROE_BOX, FROE_POINT};
    geom_body *b = &f->body[which];
    /* the oracle knows boxes by their corners, and numbers of great span make it slow */
    *b = (geom_body){.form = kinds[fuzz_int(&f->r, 0, f->dim > 5 || f->slow ? 3 : 5)],
                     .dim = f->dim,
                     .coords = f->points,
                     .count = 1};
    b->corners = f->corners[which];
    uint32_t *corner = f->corners[which], count = 0;
    const bool whole = fuzz_int(&f->r, 0, 1);
    for (uint32_t i = 0; i < MOST; i++) corner[i] = base_below(fuzz_bits(&f->r), POINTS);
    if (b->form == FROE_SEGMENT) count = 2;
    if (b->form == FROE_HULL) count = whole ? (uint32_t)f->dim + 1 : (uint32_t)fuzz_int(&f->r, 1, f->dim + 3);
    if (count) b->count = count;
    if (b->form == FROE_SEGMENT && geom_same_point(geom_body_point(b, 0), geom_body_point(b, 1), f->dim))
        b->form = FROE_HULL; /* scenes have no such segments */
    if (b->form != FROE_BOX) return;
    const double *p = f->points + corner[0] * (size_t)f->dim, *q = f->points + corner[1] * (size_t)f->dim;
    for (int k = 0; k < f->dim; k++) {
        f->box[which][k] = fmin(p[k], q[k]);
        f->box[which][f->dim + k] = fmax(p[k], q[k]);
    }
    *b = (geom_body){.form = FROE_BOX, .dim = f->dim, .coords = f->box[which], .count = 2};
}

typedef void trial_fn(fixture *f, fuzz_class kind);

static void run_trials(fixture *f, int trials, trial_fn *fn) {
    static const fuzz_class classes[] = {FUZZ_RANDOM,   FUZZ_FAR,  FUZZ_SMALL_LATTICE, FUZZ_LATTICE,
                                         FUZZ_ULPS,     FUZZ_WIDE, FUZZ_DENORMAL,      FUZZ_HUGE,
                                         FUZZ_EXTREMES, FUZZ_BITS, FUZZ_MIXED};
    for (f->dim = 4; f->dim <= FROE_MAX_DIM; f->dim++)
        for (size_t c = 0; c < sizeof classes / sizeof *classes; c++) {
            f->slow = classes[c] >= FUZZ_WIDE && classes[c] != FUZZ_DENORMAL;
            if (f->slow && f->dim > 4 && f->dim < FROE_MAX_DIM) continue;
            const int count = trials / SHARE / (f->dim > 5 ? 2 : 1) / (f->slow ? 12 * (f->dim - 3) : 1);
            f->r.state = c * 1000 + (size_t)f->dim;
            for (int i = 0; i <= count; i++) {
                draw_points(f, classes[c]);
                for (int k = 0; k < 2; k++) draw_body(f, k);
                if (i % 8 == 7 && classes[c] <= FUZZ_LATTICE) draw_crossing(f);
                fn(f, classes[c]);
            }
        }
}

static void try_contact(fixture *f, fuzz_class kind) {
    const geom_body *a = &f->body[0], *b = &f->body[1];
    const high_set x = high_of(a), y = high_of(b);
    bool corner;
    const int expected = high_contact(&x, &y, &corner);
    const geom_convex p = geom_convex_of(a), q = geom_convex_of(b);
    f->counts[expected]++, f->corner += corner;
    for (num_stage first = NUM_FILTER; first <= NUM_EXACT; first++) {
        f->context.first = first;
        const geom_contact m = geom_contact_of(&f->context, a, b, NULL);
        if ((int)m.kind != expected || (m.kind == GEOM_TOUCH && (m.touch == GEOM_TOUCH_AT_CORNER) != corner))
            fail_msg("%s, R^%d: %s of %u and %s of %u: %d, not %d (corner %d)", fuzz_names[kind], f->dim,
                     froe_kind_name(a->form), a->count, froe_kind_name(b->form), b->count, (int)m.kind, expected,
                     corner);
        assert_int_equal(geom_meet(&f->context, &p, &q), expected != 0);
        if (geom_meet_surely(&f->context, &p, &q)) assert_true(expected != 0);
        assert_int_equal(geom_body_rank(&f->context, a), high_rank(&x));
    }
}

static void polytopes_meet_as_they_do_in_rationals(void **state) {
    fixture *f = *state;
    run_trials(f, 10, try_contact);
    if (SHARE > 1) return; /* too few pairs for every kind */
    for (int i = 0; i < 4; i++) assert_true(f->counts[i] > 3);
    assert_true(f->corner > 3);
}

static void try_radii(fixture *f, fuzz_class kind) {
    high_set x = high_of(&f->body[0]), y = high_of(&f->body[1]);
    geom_convex p = geom_convex_of(&f->body[0]), q = geom_convex_of(&f->body[1]);
    mpq_t square;
    mpq_init(square);
    high_distance2(&x, &y, square);
    const double gap = sqrt(mpq_get_d(square)), shares[] = {0, 0x1p-1074, 0.5, 1 - 0x1p-52, 1, 1 + 0x1p-52, 2};
    for (size_t i = 0; i < sizeof shares / sizeof *shares; i++) {
        p.radius = x.radius = i == 1 ? shares[1] : 0.25 * gap * shares[i];
        q.radius = y.radius = 0.75 * gap * shares[i];
        if (!isfinite(p.radius + q.radius) || (f->slow && f->dim > 4 && i % 3)) continue;
        const bool expected = i ? high_reach(&x, &y, square) : high_hulls_meet(&x, &y);
        for (num_stage first = NUM_FILTER; first <= NUM_EXACT; first++) {
            f->context.first = first;
            if (geom_meet(&f->context, &p, &q) != expected)
                fail_msg("%s, R^%d, stage %d, radii %.17g and %.17g, gap %.17g: %d expected", fuzz_names[kind], f->dim,
                         (int)first, p.radius, q.radius, gap, expected);
        }
        f->meets += expected;
    }
    mpq_clear(square);
}

static void grown_by_radii_they_meet_as_in_rationals(void **state) {
    fixture *f = *state;
    run_trials(f, 2, try_radii);
    assert_true(f->meets > 60);
}

static void try_distance(fixture *f, fuzz_class kind) {
    const double *point = f->points + base_below(fuzz_bits(&f->r), POINTS) * (size_t)f->dim;
    const high_set at = high_point(f->dim, point);
    mpq_t square[2];
    mpq_inits(square[0], square[1], NULL);
    for (int i = 0; i < 2; i++) {
        const high_set x = high_of(&f->body[i]);
        high_distance2(&x, &at, square[i]);
    }
    for (num_stage first = NUM_FILTER; first <= NUM_EXACT; first++) {
        f->context.first = first;
        geom_distance d[2];
        for (int i = 0; i < 2; i++) {
            d[i] = geom_distance_from(&f->context, point, &f->body[i]);
            const double rounded = geom_distance_round(&f->context, point, &d[i]);
            if (isfinite(rounded) && !high_is_root(rounded, square[i]))
                fail_msg("%s, R^%d: %.17g is not the distance of a %s of %u", fuzz_names[kind], f->dim, rounded,
                         froe_kind_name(f->body[i].form), f->body[i].count);
            if (!isfinite(rounded)) continue;
            mpq_t bound;
            mpq_init(bound);
            mpq_set_d(bound, rounded);
            mpq_mul(bound, bound, bound);
            const int order = mpq_cmp(square[i], bound);
            const int found = geom_distance_compare_to(&f->context, point, &d[i], rounded);
            if (found != (order > 0) - (order < 0))
                fail_msg("%s, R^%d, stage %d: %.17g, of a %s, whose square is %.17g +- %g, is compared as %d",
                         fuzz_names[kind], f->dim, (int)first, rounded, froe_kind_name(f->body[i].form), d[i].square.x,
                         d[i].square.e, found);
            mpq_clear(bound);
        }
        const int order = mpq_cmp(square[0], square[1]);
        const int found = geom_distance_compare(&f->context, point, &d[0], &d[1]);
        if (found != (order > 0) - (order < 0))
            fail_msg("%s, R^%d, stage %d: %.17g +- %g and %.17g +- %g are compared as %d", fuzz_names[kind], f->dim,
                     (int)first, d[0].square.x, d[0].square.e, d[1].square.x, d[1].square.e, found);
    }
    mpq_clears(square[0], square[1], NULL);
}

static void distances_are_those_of_rationals(void **state) {
    run_trials(*state, 8, try_distance);
}

/* Is x the double nearest to t, ties to even? */
static bool rounds_to(mpq_t t, double x) {
    mpq_t low, high, middle;
    mpq_inits(low, high, middle, NULL);
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    bool right = isfinite(x);
    for (int i = 0; i < 2 && right; i++) {
        const double next = nextafter(x, i ? INFINITY : -INFINITY);
        if (!isfinite(next)) continue;
        mpq_set_d(low, x), mpq_set_d(high, next);
        mpq_add(middle, low, high);
        mpq_div_2exp(middle, middle, 1);
        const int order = mpq_cmp(t, middle) * (i ? -1 : 1);
        right = order > 0 || (order == 0 && !(bits & 1));
    }
    mpq_clears(low, high, middle, NULL);
    return right;
}

/* Every second ray is aimed at a point of a body. */
static void try_ray(fixture *f, fuzz_class kind) {
    geom_ray ray = {.dim = f->dim};
    const uint32_t o = base_below(fuzz_bits(&f->r), POINTS), aim = fuzz_int(&f->r, 0, 1) ? f->corners[0][0] : o / 2;
    bool goes = false;
    for (int k = 0; k < f->dim; k++) {
        ray.o[k] = f->points[o * (size_t)f->dim + (size_t)k];
        const double q = f->points[aim * (size_t)f->dim + (size_t)k];
        ray.d[k] = aim == o || !isfinite(q - ray.o[k]) ? q : q - ray.o[k];
        goes = goes || ray.d[k] != 0;
    }
    if (!goes) return;
    mpq_t t[2];
    mpq_inits(t[0], t[1], NULL);
    bool meets[2];
    for (int i = 0; i < 2; i++) {
        const high_set x = high_of(&f->body[i]);
        meets[i] = high_ray(ray.o, ray.d, &x, t[i]);
    }
    for (num_stage first = NUM_FILTER; first <= NUM_EXACT; first++) {
        f->context.first = first;
        geom_hit hit[2];
        for (int i = 0; i < 2; i++) {
            const bool found = geom_ray_meets(&f->context, &ray, &f->body[i], &hit[i]);
            if (found != meets[i])
                fail_msg("%s, R^%d: a ray and a %s of %u: %d expected", fuzz_names[kind], f->dim,
                         froe_kind_name(f->body[i].form), f->body[i].count, meets[i]);
            if (!found) continue;
            const double x = geom_hit_round(&f->context, &ray, &hit[i]);
            f->hits++, f->starts += x == 0;
            if (isfinite(x)) assert_true(rounds_to(t[i], x));
            if (isfinite(x)) {
                mpq_t y;
                mpq_init(y);
                mpq_set_d(y, x);
                const int order = mpq_cmp(t[i], y);
                assert_int_equal(geom_hit_compare_to(&f->context, &ray, &hit[i], x), (order > 0) - (order < 0));
                mpq_clear(y);
            }
        }
        if (!meets[0] || !meets[1]) continue;
        const int order = mpq_cmp(t[0], t[1]);
        assert_int_equal(geom_hit_compare(&f->context, &ray, &hit[0], &hit[1]), (order > 0) - (order < 0));
    }
    mpq_clears(t[0], t[1], NULL);
}

static void rays_meet_them_where_they_do_in_rationals(void **state) {
    fixture *f = *state;
    run_trials(f, 12, try_ray);
    assert_true(f->hits > 100 && f->hits - f->starts > 40);
}

/* Two cubes with rounded corners as close as 1e-15, turned; and far from the origin: the filters must not be fooled. */
static void filters_are_right_at_small_gaps(void **state) {
    fixture *f = *state;
    f->context.first = NUM_FILTER;
    f->r.state = 5;
    for (int dim = 4; dim <= FROE_MAX_DIM; dim++)
        for (int i = 0; i < 30 / SHARE; i++) {
            double points[2 * (FROE_MAX_DIM + 1) * FROE_MAX_DIM];
            const int corners = dim + 1;
            const double gap = pow(10, -fuzz_int(&f->r, 12, 17)), far = fuzz_int(&f->r, 0, 1) ? 1000 : 0;
            for (int j = 0; j < 2 * corners; j++) {
                double *x = points + j * dim, sum = 0;
                for (int k = 0; k < dim; k++) x[k] = far + fuzz_unit(&f->r);
                for (int k = 1; k < dim; k++) sum += x[k] * (k % 3 - 1);
                x[0] = sum + (j < corners ? -gap : gap) * (fuzz_int(&f->r, 0, 2) ? 1 : 1e16);
            }
            const geom_body a = {.form = FROE_HULL, .dim = dim, .count = (uint32_t)corners, .coords = points},
                            b = {.form = FROE_HULL,
                                 .dim = dim,
                                 .count = (uint32_t)corners,
                                 .coords = points + corners * dim};
            const geom_convex p = geom_convex_of(&a), q = geom_convex_of(&b);
            const high_set x = high_of(&a), y = high_of(&b);
            assert_int_equal(geom_meet(&f->context, &p, &q), high_hulls_meet(&x, &y));
        }
}

/* Is 0 certainly inside of the simplex of differences of its corners from 0? */
static bool is_inside(int dim, const double *corners) {
    const double origin[FROE_MAX_DIM] = {0};
    const geom_body simplex = {.form = FROE_HULL, .dim = dim, .count = (uint32_t)dim + 1, .coords = corners},
                    point = {.form = FROE_POINT, .dim = dim, .count = 1, .coords = origin};
    const geom_convex a = geom_convex_of(&simplex), b = geom_convex_of(&point);
    geom_guess guess = {.simplex = {.count = dim + 1}, .scale = 1};
    for (uint32_t i = 0; i <= (uint32_t)dim; i++) guess.simplex.a[i] = i;
    return geom_guess_inside(&guess, &a, &b);
}

/* A simplex around 0 that is more and more flat along one axis: at some time doubles are sure no more, and they never
 * are again, although the inverse of its edges grows beyond all that their error bounds allow. */
static void flat_simplices_are_left_to_exact_numbers(void **state) {
    (void)state;
    for (int dim = 4; dim <= FROE_MAX_DIM; dim++) {
        bool sure = true;
        for (int flat = 0; flat < 160; flat++) {
            double corners[(FROE_MAX_DIM + 1) * FROE_MAX_DIM] = {0};
            for (int k = 0; k < dim; k++) corners[k] = -1, corners[(k + 1) * dim + k] = 1;
            for (int i = 0; i <= dim; i++) corners[i * dim] = ldexp(corners[i * dim], -flat);
            const bool now = is_inside(dim, corners);
            assert_true(sure || !now);
            sure = now;
            if (flat < 20) assert_true(sure);
        }
        assert_false(sure);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(flat_simplices_are_left_to_exact_numbers),
        cmocka_unit_test_setup_teardown(polytopes_meet_as_they_do_in_rationals, setup, teardown),
        cmocka_unit_test_setup_teardown(grown_by_radii_they_meet_as_in_rationals, setup, teardown),
        cmocka_unit_test_setup_teardown(distances_are_those_of_rationals, setup, teardown),
        cmocka_unit_test_setup_teardown(rays_meet_them_where_they_do_in_rationals, setup, teardown),
        cmocka_unit_test_setup_teardown(filters_are_right_at_small_gaps, setup, teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
