/* Do convex sets meet? Every pair of cores, at every stage, against brute force in rationals. */
#include "base/random.h"
#include "geom/meet/meet.h"
#include "geom/polytope.h"
#include "geom/range.h"
#include "oracle/convex.h"
#include <gmp.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

/* ------------------------------------------------------------------- cases -- */

typedef struct dice {
    uint64_t seed, counter;
    int style;
} dice;
enum { ANYWHERE, LATTICE, FLAT, GREAT, TINY, MIXED, STYLES };

static uint32_t below(dice *d, uint32_t n) {
    return base_below(base_hash(d->seed, 3, d->counter++), n);
}

static double coordinate(dice *d) {
    double unit = (double)(base_hash(d->seed, 4, d->counter++) >> 11) * 0x1p-53;
    switch (d->style) {
    case LATTICE:
        return (double)below(d, 4);
    case FLAT:
        return below(d, 2) ? 1 : unit;
    case GREAT:
        return (unit - 0.5) * 1e300;
    case TINY:
        return (double)below(d, 4) * 0x1p-1074;
    case MIXED:
        return ldexp(unit, (int)below(d, 2000) - 1000) * (below(d, 2) ? 1 : -1);
    default:
        return unit;
    }
}

static double radius(dice *d) {
    return below(d, 2) ? 0 : d->style == LATTICE ? (double)below(d, 3) : 0.3 * fabs(coordinate(d));
}

/* A random set with the doubles that it is made of. */
typedef struct sample {
    double coords[8 * 3];
    geom_convex set;
    oracle_set oracle;
    geom_polytope polytope;
} sample;

/* Halfspaces within a box that holds all other samples; some leave a flat set, or nothing. */
static void make_polytope(dice *d, int dim, sample *s) {
    enum { MOST = 5 };
    static const double lo[3] = {-8, -8, -8}, hi[3] = {8, 8, 8};
    double normals[3 * MOST], offsets[MOST];
    uint32_t count = 1 + below(d, MOST);
    num_context context;
    for (uint32_t i = 0; i < count * (uint32_t)dim; i++) normals[i] = coordinate(d) - (d->style == LATTICE ? 1 : 0.5);
    for (uint32_t i = 0; i < count; i++) offsets[i] = coordinate(d) * 0.5;
    if (count > 1 && !below(d, 3)) { /* flat */
        for (int k = 0; k < dim; k++) normals[dim + k] = -normals[k];
        offsets[1] = -offsets[0];
    }
    s->polytope = (geom_polytope){0};
    assert_int_equal(num_context_new(NULL, &context), 0);
    froe_allocator alloc = support_allocator(NULL);
    assert_true(geom_polytope_make(&context, &alloc, dim, normals, offsets, count, lo, hi, &s->polytope));
    num_context_free(&context);
    s->set = geom_polytope_convex(&s->polytope, dim);
    s->oracle = oracle_halfspaces(dim, normals, offsets, count, lo, hi);
    assert_int_equal(s->set.count > 0, s->oracle.count > 0);
}

static void make(dice *d, int dim, geom_core core, sample *s) {
    s->polytope = (geom_polytope){0};
    if (core == GEOM_CORE_PLANES) {
        make_polytope(d, dim, s);
        return;
    }
    size_t points = core == GEOM_CORE_LIST ? 1 + below(d, 5) : 2;
    s->set = (geom_convex){.core = core, .dim = dim, .coords = s->coords, .count = (uint32_t)points};
    for (size_t i = 0; i < points * (size_t)dim; i++) s->coords[i] = coordinate(d);
    if (core == GEOM_CORE_LIST) {
        s->set.radius = radius(d);
        s->oracle = oracle_points(dim, s->coords, points, s->set.radius);
    } else if (core == GEOM_CORE_BOX) {
        s->set.count = 1u << dim;
        for (int k = 0; k < dim; k++) {
            double lo = s->coords[k], hi = s->coords[dim + k];
            s->coords[k] = fmin(lo, hi);
            s->coords[dim + k] = fmax(lo, hi);
        }
        s->oracle = oracle_box(dim, s->coords, s->coords + dim);
    } else {
        bool zero = true;
        double most = 0;
        for (int k = 0; k < dim; k++) s->coords[dim + k] -= d->style == LATTICE ? 1 : 0.5 * coordinate(d);
        for (int k = 0; k < dim; k++)
            zero = zero && s->coords[dim + k] == 0, most = fmax(most, fabs(s->coords[dim + k]));
        if (zero) s->coords[dim] = most = 1;
        s->set.power = (int)below(d, 4);
        s->oracle = oracle_ray(dim, s->coords, s->coords + dim, ldexp(most, s->set.power));
    }
}

static bool meets(num_context *context, const sample *a, const sample *b, num_stage first) {
    context->first = first;
    return geom_meet(context, &a->set, &b->set);
}

static void check(num_context *context, dice *d, int dim, geom_core core_a, geom_core core_b) {
    sample a, b;
    make(d, dim, core_a, &a);
    make(d, dim, core_b, &b);
    if (b.set.count) { /* nothing meets the empty set, which no caller passes */
        bool truth = oracle_meet(&a.oracle, &b.oracle);
        bool right = meets(context, &a, &b, NUM_FILTER) == truth && meets(context, &b, &a, NUM_FILTER) == truth &&
                     meets(context, &a, &b, NUM_EXACT) == truth;
        if (!right)
            fail_msg("seed %u, style %d, dim %d, cores %d %d: not %d", (unsigned)d->seed, d->style, dim, core_a, core_b,
                     truth);
    }
    oracle_set_free(&a.oracle);
    oracle_set_free(&b.oracle);
    froe_allocator alloc = support_allocator(NULL);
    geom_polytope_free(&b.polytope, &alloc);
}

static void check_all(int dim, int style, int rounds) {
    num_context context;
    uint64_t decided = 0;
    assert_int_equal(num_context_new(NULL, &context), 0);
    for (int i = 0; i < rounds; i++)
        for (geom_core a = GEOM_CORE_LIST; a <= GEOM_CORE_RAY; a++)
            for (geom_core b = a; b <= GEOM_CORE_RAY; b++) {
                dice d = {.seed = (uint64_t)(i * 64 + style * 16) + a * 4 + b, .style = style};
                if (dim == 3 && a == GEOM_CORE_BOX && b == GEOM_CORE_BOX) continue; /* 64 differences: see below */
                check(&context, &d, dim, a, b);
                decided++;
            }
    assert_true(context.arena.high < num_arena_bound / 2);
    num_context_free(&context);
}

static void sets_in_the_plane_meet_as_in_rationals(void **state) {
    (void)state;
    for (int style = 0; style < STYLES; style++) check_all(2, style, style == MIXED ? 15 : 200);
}

static void sets_in_space_meet_as_in_rationals(void **state) {
    (void)state;
    for (int style = 0; style < STYLES; style++) check_all(3, style, style == MIXED ? 2 : 25);
}

static void intersections_of_halfspaces_meet_as_in_rationals(void **state) {
    (void)state;
    for (int dim = 2; dim <= 3; dim++)
        for (int style = 0; style <= FLAT; style++) {
            num_context context;
            assert_int_equal(num_context_new(NULL, &context), 0);
            for (int i = 0; i < (dim == 2 ? 20 : 2); i++)
                for (geom_core a = GEOM_CORE_LIST; a <= GEOM_CORE_RAY; a++) {
                    dice d = {.seed = (uint64_t)(i * 64 + style * 16) + a, .style = style};
                    check(&context, &d, dim, a, GEOM_CORE_PLANES);
                }
            assert_true(context.arena.high < num_arena_bound / 4);
            num_context_free(&context);
        }
}

/* Is a point within the radius of the centre? */
static bool is_within(int dim, const double *centre, double radius, const double *x) {
    mpq_t a, b, sum;
    mpq_inits(a, b, sum, NULL);
    for (int k = 0; k < dim; k++) {
        mpq_set_d(a, centre[k]), mpq_set_d(b, x[k]);
        mpq_sub(a, a, b);
        mpq_mul(a, a, a);
        mpq_add(sum, sum, a);
    }
    mpq_set_d(b, radius);
    mpq_mul(b, b, b);
    const bool within = mpq_cmp(sum, b) <= 0;
    mpq_clears(a, b, sum, NULL);
    return within;
}

/* Radii within a few roundings of the distance, or of a 2^-44th part of it: on either side of what filters are sure of.
 */
static void points_on_the_border_of_balls_are_told_as_in_rationals(void **state) {
    enum { ROUNDS = 3000 };
    num_context context;
    (void)state;
    assert_int_equal(num_context_new(NULL, &context), 0);
    for (int i = 0, sure = 0; i < ROUNDS; i++) {
        dice d = {.seed = (uint64_t)i, .style = i % STYLES};
        const int dim = 1 + i % 8;
        double centre[8], x[8], sum = 0;
        for (int k = 0; k < dim; k++) centre[k] = coordinate(&d), x[k] = coordinate(&d);
        for (int k = 0; k < dim; k++) sum = hypot(sum, centre[k] - x[k]);
        const double step = below(&d, 2) ? 0x1p-52 : 0x1p-45, r = sum * (1 + step * ((double)below(&d, 9) - 4));
        if (!isfinite(r)) continue;
        const bool within = is_within(dim, centre, r, x);
        for (num_stage first = NUM_FILTER; first <= NUM_EXACT; first++) {
            context.first = first;
            assert_int_equal(geom_meet_boxes(&context, dim, x, x, 0, centre, centre, r), within);
            assert_int_equal(geom_meet_boxes(&context, dim, x, x, r, centre, centre, 0), within);
        }
        const geom_range range = {.kind = GEOM_RANGE_BALL, .dim = dim, .set = {.coords = centre, .radius = r}};
        const int has = geom_range_has(&range, x);
        assert_true(has == NUM_UNSURE || has == within);
        sure += has != NUM_UNSURE;
        assert_true(i < ROUNDS - 1 || (sure > ROUNDS / 20 && sure < ROUNDS - ROUNDS / 20));
    }
    num_context_free(&context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_on_the_border_of_balls_are_told_as_in_rationals),
        cmocka_unit_test(sets_in_the_plane_meet_as_in_rationals),
        cmocka_unit_test(sets_in_space_meet_as_in_rationals),
        cmocka_unit_test(intersections_of_halfspaces_meet_as_in_rationals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
