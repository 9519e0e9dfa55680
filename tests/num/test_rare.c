/* test_rare.c: polynomials, roots and quotients that motions seldom or never lead to. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "num/isolate.h"
#include "support/memory.h"
#include <math.h>

static num_arena arena;

static int begin(void **state) {
    (void)state;
    const froe_allocator alloc = support_allocator(NULL);
    return num_arena_new(&alloc, &arena) || num_arena_reserve(&alloc, &arena, num_poly_arena(8, 8, 8));
}

static int end(void **state) {
    (void)state;
    const froe_allocator alloc = support_allocator(NULL);
    const bool room = arena.high <= arena.capacity;
    num_arena_free(&alloc, &arena);
    return room ? 0 : -1;
}

static num_dyadic number(double x) {
    return num_dyadic_from(&arena, x);
}

static num_poly poly(int degree, const double *c) {
    num_poly f = {.degree = degree};
    for (int i = 0; i <= degree; i++) f.c[i] = number(c[i]);
    return f;
}

/* (x - roots[0]) (x - roots[1]) ..., each root a dyadic number that is a sum of two doubles. */
static num_poly with_roots(int count, const double (*roots)[2]) {
    num_poly f = {.degree = 0, .c = {number(1)}};
    for (int r = 0; r < count; r++) {
        const num_dyadic root = num_dyadic_add(&arena, number(roots[r][0]), number(roots[r][1]));
        num_poly next = {.degree = f.degree + 1};
        for (int i = 0; i <= f.degree; i++) {
            next.c[i + 1] = num_dyadic_add(&arena, next.c[i + 1], f.c[i]);
            next.c[i] = num_dyadic_sub(&arena, next.c[i], num_dyadic_mul(&arena, f.c[i], root));
        }
        f = next;
    }
    return f;
}

/* ------------------------------------------------------------------- quotients -- */

/* Quotients with limbs of zeros within, by divisors with and without zero bits at their end. */
static void exact_quotients_may_have_zeros_within(void **state) {
    static const double tops[] = {1, 0x1p64, 0x1p128, 0x1p200, 3}, bottoms[] = {1, 12, 0x1p70, 0x1.8p-90};
    (void)state;
    for (int i = 0; i < 5; i++)
        for (int j = 0; j < 5; j++)
            for (int k = 0; k < 4; k++) {
                arena.top = 0;
                const num_dyadic q = num_dyadic_add(&arena, number(tops[i]), number(-tops[j] * 0x1p-60));
                const num_dyadic b = num_dyadic_add(&arena, number(bottoms[k]), number(5));
                const num_dyadic a = num_dyadic_mul(&arena, q, b);
                assert_int_equal(num_dyadic_compare(num_dyadic_divide(&arena, a, b), q), 0);
            }
}

/* ---------------------------------------------------------------------- chains -- */

/* Sturm's count, with f' times 1, with f' times 0, and of constants. */
static void chains_of_constants_and_of_zero(void **state) {
    (void)state;
    arena.top = 0;
    const num_poly f = poly(4, (const double[]){-0.0625, 0, 0, 0, 1}),
                   one = poly(0, (const double[]){1}); /* x^4 = 1/16 */
    const num_poly zero = {.degree = -1}, five = poly(0, (const double[]){5});
    num_chain sturm, same, chain;
    num_chain_of(&arena, &f, NULL, &sturm);
    num_chain_of(&arena, &f, &one, &same);
    for (int i = 0; i <= 4; i++) {
        const num_dyadic x = number(i / 4.0);
        assert_int_equal(num_chain_variations(&arena, &sturm, x), num_chain_variations(&arena, &same, x));
    }
    assert_int_equal(
        num_chain_variations(&arena, &sturm, (num_dyadic){0}) - num_chain_variations(&arena, &sturm, number(1)), 1);
    num_chain_of(&arena, &f, &zero, &chain);
    assert_int_equal(chain.count, 1);
    num_chain_of(&arena, &five, NULL, &chain);
    assert_int_equal(chain.count, 1);
    num_chain_of(&arena, &five, &f, &chain);
    assert_int_equal(chain.count, 1);
}

static void no_sign_is_sure_of_zero(void **state) {
    (void)state;
    const num_ball_poly zero = {.degree = -1}, one = {.degree = 0, .c = {{1, 0}}};
    assert_int_equal(num_ball_poly_sign_throughout(&zero), NUM_UNSURE);
    assert_int_equal(num_ball_poly_sign_throughout(&one), 1);
}

/* ----------------------------------------------------------------------- roots -- */

/* Roots beside the ends of intervals: guesses of doubles lie outside, and bisection finds them. */
static void roots_beside_powers_of_two_are_narrowed(void **state) {
    static const double roots[4][2] = {{1, -0x1p-60}, {0.5, -0x1p-60}, {0.5, 0x1p-60}, {1, -0x1p-50}};
    (void)state;
    for (int which = 0; which < 4; which++)
        for (int depth = 5; depth <= 70; depth += 13) {
            num_isolation f;
            arena.top = 0;
            const double pair[2][2] = {{roots[which][0], roots[which][1]}, {which == 2 ? 0.2 : 0.9, 0}};
            const int count = which % 3 ? 2 : 1;
            const num_poly p = with_roots(count, pair);
            const num_dyadic root = num_dyadic_add(&arena, number(pair[0][0]), number(pair[0][1]));
            num_isolate(&arena, &p, &f);
            assert_int_equal(f.count, count);
            num_isolated *at = &f.root[which == 2];
            assert_true(num_isolated_narrow(&arena, at, depth));
            assert_true(at->exact || at->depth >= depth);
            assert_true(num_dyadic_compare(num_isolated_low(at), root) <= 0);
            assert_true(num_dyadic_compare(num_isolated_high(&arena, at), root) >= 0);
        }
}

/* x^2 = 1/2 + 2^power, or 1/2 for power 0. */
static num_poly near_root_of_half(int power) {
    num_poly f = poly(2, (const double[]){-0.5, 0, 1});
    if (power) f.c[0] = num_dyadic_sub(&arena, f.c[0], num_dyadic_scaled(&arena, 1, 1, power));
    return f;
}

/* An interval as narrow as its limbs allow stays; and roots that lie in the same one cannot be compared. */
static void no_root_is_narrowed_beyond_its_limbs(void **state) {
    static const int powers[] = {0, -200, -3000}, orders[] = {0, -1, NUM_UNSURE};
    (void)state;
    for (int i = 0; i < 3; i++) {
        num_isolation f, g;
        arena.top = 0;
        const num_poly p = near_root_of_half(0), q = near_root_of_half(powers[i]);
        num_isolate(&arena, &p, &f);
        num_isolate(&arena, &q, &g);
        assert_int_equal(f.count, 1);
        assert_int_equal(g.count, 1);
        num_isolated wide = f.root[0], narrow = g.root[0];
        assert_true(num_isolated_narrow(&arena, &narrow, 100));
        assert_int_equal(num_isolated_compare(&arena, &wide, &narrow), orders[i]);
        assert_int_equal(num_isolated_compare(&arena, &f.root[0], &g.root[0]), orders[i]);
        assert_true(num_isolated_narrow(&arena, &f.root[0], NUM_MOST_DEPTH));
        assert_int_equal(f.root[0].depth, NUM_MOST_DEPTH);
        assert_false(num_isolated_narrow(&arena, &f.root[0], NUM_MOST_DEPTH + 1));
        assert_int_equal(num_isolated_sign(&arena, &f.root[0], &p, &f.near), 0);
    }
}

/* The leading bits of the low end are 1/2, and say nothing of the root's place within 2^-64. */
static void balls_of_roots_hold_what_lies_below_their_bits(void **state) {
    static const double beside[1][2] = {{0.5, 0x1p-100}};
    (void)state;
    for (int depth = 66; depth <= 130; depth += 32) {
        num_isolation f;
        arena.top = 0;
        const num_poly p = with_roots(1, beside);
        num_isolate(&arena, &p, &f);
        assert_true(num_isolated_narrow(&arena, &f.root[0], depth));
        const num_ball ball = num_isolated_ball(&f.root[0]);
        assert_true(ball.x - ball.e <= 0.5 && ball.x + ball.e > 0.5);
    }
}

/* The number at 0 is less than any double, so that no error bound tells its sign. */
static void roots_smaller_than_doubles_are_isolated(void **state) {
    (void)state;
    for (int power = -1104; power >= -2000; power -= 448) {
        num_isolation f;
        arena.top = 0;
        num_poly p = poly(1, (const double[]){0, 1});
        const num_dyadic tiny = num_dyadic_scaled(&arena, 1, 1, power);
        p.c[0] = num_dyadic_sub(&arena, p.c[0], tiny);
        num_isolate(&arena, &p, &f);
        assert_int_equal(f.count, 1);
        assert_true(num_isolated_narrow(&arena, &f.root[0], NUM_MOST_DEPTH));
        assert_true(f.root[0].exact);
        assert_int_equal(num_dyadic_compare(num_isolated_low(&f.root[0]), tiny), 0);
    }
}

/* A root that was hit, and roots of other polynomials that no 24 halvings tell from it. */
static void exact_roots_are_compared_with_near_ones(void **state) {
    static const double quarters[3][2] = {{0.25, 0}, {0.5, 0}, {0.75, 0}};
    static const double near[4][2] = {{0.5, 0x1p-40}, {0.5, -0x1p-40}, {0.5, 0}, {0.5, 0x1p-100}};
    static const int order[4] = {-1, 1, 0, -1};
    (void)state;
    for (int i = 0; i < 4; i++)
        for (int twice = 1; twice <= 2; twice++) {
            num_isolation f, g;
            arena.top = 0;
            const double pair[2][2] = {{near[i][0], near[i][1]}, {near[i][0], near[i][1]}};
            const num_poly p = with_roots(3, quarters), q = with_roots(twice, pair);
            num_isolate(&arena, &p, &f);
            num_isolate(&arena, &q, &g);
            assert_int_equal(f.count, 3);
            assert_int_equal(g.count, 1);
            num_isolated *half = &f.root[1], *other = &g.root[0];
            while (!half->exact) assert_true(num_isolated_refine(&arena, half));
            assert_true(num_isolated_refine(&arena, half)); /* is what it was */
            num_isolated a = *half, b = *other;
            assert_int_equal(num_isolated_compare(&arena, &a, &b), order[i]);
            a = *half, b = *other;
            assert_int_equal(num_isolated_compare(&arena, &b, &a), -order[i]);
        }
}

/* A point that halving finds late: 24 halvings of the other interval still hold it, and the polynomial decides. */
static void roots_that_are_hit_late_are_compared_by_signs(void **state) {
    static const double late[1][2] = {{0.5, 0x1p-30}};
    static const double others[3][2] = {{0x1p-30, 0}, {0x1p-30, 0x1p-60}, {0x1p-30, -0x1p-60}};
    static const int orders[3] = {0, -1, 1};
    (void)state;
    for (int i = 0; i < 3; i++) {
        num_isolation f, g;
        arena.top = 0;
        const num_poly p = with_roots(1, late);
        num_poly q = with_roots(1, others + i); /* and 1/2 more */
        q.c[0] = num_dyadic_sub(&arena, q.c[0], number(0.5));
        num_isolate(&arena, &p, &f);
        num_isolate(&arena, &q, &g);
        while (!f.root[0].exact) assert_true(num_isolated_refine(&arena, &f.root[0]));
        num_isolated a = f.root[0], b = g.root[0];
        assert_int_equal(num_isolated_compare(&arena, &a, &b), orders[i]);
        a = f.root[0], b = g.root[0];
        assert_int_equal(num_isolated_compare(&arena, &b, &a), -orders[i]);
        assert_int_equal(num_isolated_sign(&arena, &f.root[0], &q, &g.near), orders[i]);
    }
}

/* ------------------------------------------------------------------- in doubles -- */

/* Whole numbers of one limb, some of which no double is; and numbers beside them. */
static void balls_of_polynomials_hold_their_numbers(void **state) {
    static const double sums[][2] = {{0x1p60, 1},   {0x1p60, -1},  {0x1p53, 0},  {0x1p53, -1}, {0x1p63, 0x1p10 + 1},
                                     {0x1p-3, 0},   {0x1p64, 1},   {1, 0x1p-60}, {0, 0},       {-7, 0},
                                     {-0x1p61, -3}, {0x1p-1074, 0}};
    enum { SUMS = sizeof sums / sizeof *sums };
    (void)state;
    for (int i = 0; i < SUMS; i++) {
        arena.top = 0;
        num_poly f = {.degree = 0, .c = {num_dyadic_add(&arena, number(sums[i][0]), number(sums[i][1]))}};
        const num_ball_poly near = num_poly_balls(&arena, &f);
        const num_dyadic off = num_dyadic_sub(&arena, f.c[0], number(near.c[0].x));
        assert_true(num_dyadic_compare(off, number(near.c[0].e)) <= 0);
        assert_true(num_dyadic_compare(off, number(-near.c[0].e)) >= 0);
        if (sums[i][1] == 0 && sums[i][0] == floor(sums[i][0]) && fabs(sums[i][0]) < 0x1p53)
            assert_true(near.c[0].e == 0);
    }
}

static void nothing_is_divided_by_zero(void **state) {
    (void)state;
    arena.top = 0;
    assert_true(isnan(num_dyadic_quotient(&arena, number(1), number(0))));
    assert_true(isnan(num_dyadic_quotient(&arena, number(0), number(0))));
    assert_true(num_dyadic_quotient(&arena, number(0), number(-3)) == 0);
}

static froe_status reserve_more(void *user, const froe_allocator *alloc) {
    num_arena small;
    (void)user;
    froe_status status = num_arena_new(alloc, &small);
    if (status) return status;
    const size_t before = small.capacity;
    status = num_arena_reserve(alloc, &small, before + 1);
    assert_int_equal(small.capacity, before + !status);
    assert_int_equal(num_arena_reserve(alloc, &small, before), FROE_OK); /* it has that */
    num_arena_free(alloc, &small);
    return status;
}

static void arenas_without_memory_stay_as_they_were(void **state) {
    (void)state;
    assert_int_equal(test_memory_each(reserve_more, NULL), 2);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(exact_quotients_may_have_zeros_within),
        cmocka_unit_test(chains_of_constants_and_of_zero),
        cmocka_unit_test(no_sign_is_sure_of_zero),
        cmocka_unit_test(roots_beside_powers_of_two_are_narrowed),
        cmocka_unit_test(no_root_is_narrowed_beyond_its_limbs),
        cmocka_unit_test(balls_of_roots_hold_what_lies_below_their_bits),
        cmocka_unit_test(roots_smaller_than_doubles_are_isolated),
        cmocka_unit_test(exact_roots_are_compared_with_near_ones),
        cmocka_unit_test(roots_that_are_hit_late_are_compared_by_signs),
        cmocka_unit_test(balls_of_polynomials_hold_their_numbers),
        cmocka_unit_test(nothing_is_divided_by_zero),
        cmocka_unit_test(arenas_without_memory_stay_as_they_were),
    };
    return cmocka_run_group_tests(tests, begin, end);
}
