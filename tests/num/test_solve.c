/* Elimination without fractions against rationals (GMP): ranks, and what depends on what. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "num/solve.h"
#include "support/fuzz.h"
#include <gmp.h>

static void to_rational(mpq_t out, num_dyadic a) {
    mpz_import(mpq_numref(out), a.count, -1, sizeof *a.limbs, 0, 0, a.limbs);
    mpz_set_ui(mpq_denref(out), 1);
    if (a.exponent >= 0)
        mpq_mul_2exp(out, out, 64 * (mp_bitcnt_t)a.exponent);
    else
        mpq_div_2exp(out, out, 64 * (mp_bitcnt_t)-a.exponent);
    if (a.sign < 0) mpq_neg(out, out);
}

/* sum over the pivots of  column of the pivot * number / scale  is the column itself, in every row as it was given. */
static void check_column(const num_table *t, double x[NUM_TABLE_ROWS][NUM_TABLE_COLUMNS], int column) {
    mpq_t sum, number, scale;
    mpq_inits(sum, number, scale, NULL);
    to_rational(scale, t->scale);
    for (int i = 0; i < t->rows; i++) {
        mpq_set_ui(sum, 0, 1);
        for (int r = 0; r < t->rank; r++) {
            mpq_t entry;
            mpq_init(entry);
            to_rational(number, t->at[r][column]);
            mpq_set_d(entry, x[i][t->pivot[r]]);
            mpq_mul(entry, entry, number);
            mpq_add(sum, sum, entry);
            mpq_clear(entry);
        }
        mpq_div(sum, sum, scale);
        mpq_set_d(number, x[i][column]);
        assert_true(mpq_equal(sum, number));
    }
    mpq_clears(sum, number, scale, NULL);
}

static void columns_are_sums_of_those_of_the_pivots(void **state) {
    static const fuzz_class classes[] = {FUZZ_RANDOM, FUZZ_SMALL_LATTICE, FUZZ_LATTICE,  FUZZ_ULPS,
                                         FUZZ_WIDE,   FUZZ_DENORMAL,      FUZZ_EXTREMES, FUZZ_MIXED};
    const froe_allocator alloc = support_allocator(NULL);
    num_arena arena;
    fuzz_source r = {1};
    uint64_t whole = 0, less = 0;
    (void)state;
    assert_int_equal(num_arena_new(&alloc, &arena), FROE_OK);
    for (int trial = 0; trial < 1600; trial++) {
        const fuzz_class kind = classes[trial % 8];
        double x[NUM_TABLE_ROWS][NUM_TABLE_COLUMNS];
        num_table t = {.rows = fuzz_int(&r, 1, NUM_TABLE_ROWS)};
        const int unknowns = fuzz_int(&r, 1, t.rows), copied = fuzz_int(&r, 0, unknowns - 1);
        t.columns = unknowns + 1;
        arena.top = 0;
        for (int i = 0; i < t.rows; i++) {
            for (int j = 0; j < t.columns; j++) x[i][j] = fuzz_coordinate(&r, kind);
            if (trial % 3 == 0) x[i][copied] = 0.5 * x[i][unknowns - 1]; /* a column that depends on another */
            if (trial % 5 == 0) x[i][unknowns] = x[i][0];
            for (int j = 0; j < t.columns; j++) t.at[i][j] = num_dyadic_from(&arena, x[i][j]);
        }
        num_table_solve(&arena, 0, &t, unknowns);
        *(t.rank == unknowns ? &whole : &less) += 1;
        for (int r0 = 0; r0 < t.rank; r0++)
            for (int i = 0; i < t.rows; i++)
                if (i == r0)
                    assert_int_equal(num_dyadic_compare(t.at[i][t.pivot[r0]], t.scale), 0);
                else
                    assert_int_equal(t.at[i][t.pivot[r0]].sign, 0);
        for (int j = 0; j < unknowns; j++) check_column(&t, x, j);
        bool right = true; /* is the right side a sum of columns? */
        for (int i = t.rank; i < t.rows; i++) right = right && !t.at[i][unknowns].sign;
        if (right) check_column(&t, x, unknowns);
    }
    assert_true(whole > 400 && less > 200);
    assert_true(arena.high < num_arena_bound / 2);
    num_arena_free(&alloc, &arena);
}

/* Quotients of products are the factors, whatever lowest bits they have. */
static void division_without_remainder_is_exact(void **state) {
    const froe_allocator alloc = support_allocator(NULL);
    num_arena arena;
    fuzz_source r = {2};
    (void)state;
    assert_int_equal(num_arena_new(&alloc, &arena), FROE_OK);
    for (int trial = 0; trial < 20000; trial++) {
        arena.top = 0;
        num_dyadic x[2];
        for (int i = 0; i < 2; i++) {
            x[i] = num_dyadic_scaled(&arena, 1, 1, 0);
            for (int n = fuzz_int(&r, 1, 6); n; n--) {
                const num_dyadic y = num_dyadic_from(&arena, fuzz_coordinate(&r, FUZZ_MIXED));
                x[i] = fuzz_int(&r, 0, 1) ? num_dyadic_mul(&arena, x[i], y) : num_dyadic_add(&arena, x[i], y);
            }
        }
        if (!x[1].sign) continue;
        const num_dyadic product = num_dyadic_mul(&arena, x[0], x[1]);
        assert_int_equal(num_dyadic_compare(num_dyadic_divide(&arena, product, x[1]), x[0]), 0);
    }
    num_arena_free(&alloc, &arena);
}

/* A number that lies at or behind the mark moves there, one before it stays; the rest is given back. */
static void numbers_kept_survive_the_mark(void **state) {
    const froe_allocator alloc = support_allocator(NULL);
    num_arena arena;
    (void)state;
    assert_int_equal(num_arena_new(&alloc, &arena), FROE_OK);
    const num_dyadic before = num_dyadic_from(&arena, 1e300);
    const size_t mark = arena.top;
    num_dyadic_from(&arena, 3);
    const num_dyadic behind = num_dyadic_mul(&arena, before, num_dyadic_from(&arena, 1e-300));
    num_dyadic kept = num_dyadic_keep(&arena, mark, behind);
    assert_int_equal(arena.top, mark + kept.count);
    assert_true(num_dyadic_quotient(&arena, kept, num_dyadic_from(&arena, 1)) == 1);
    kept = num_dyadic_keep(&arena, mark, before);
    assert_int_equal(arena.top, mark);
    assert_true(num_dyadic_quotient(&arena, kept, num_dyadic_from(&arena, 1)) == 1e300);
    num_arena_free(&alloc, &arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(columns_are_sums_of_those_of_the_pivots),
        cmocka_unit_test(division_without_remainder_is_exact),
        cmocka_unit_test(numbers_kept_survive_the_mark),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
