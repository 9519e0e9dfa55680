/* test_dyadic.c: dyadic numbers and their one division against GMP. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "num/dyadic.h"
#include "support/fuzz.h"
#include "support/rational.h"

enum { NUMBERS = 6 };

typedef struct pool { /* the same numbers twice */
    num_dyadic ours[NUMBERS];
    mpq_t theirs[NUMBERS];
} pool;

static void to_rational(mpq_t out, num_dyadic a) {
    mpz_import(mpq_numref(out), a.count, -1, sizeof *a.limbs, 0, 0, a.limbs);
    mpz_set_ui(mpq_denref(out), 1);
    if (a.exponent >= 0)
        mpq_mul_2exp(out, out, 64 * (mp_bitcnt_t)a.exponent);
    else
        mpq_div_2exp(out, out, 64 * (mp_bitcnt_t)-a.exponent);
    if (a.sign < 0) mpq_neg(out, out);
}

static void assert_equal(num_dyadic a, const mpq_t b) {
    mpq_t value;
    mpq_init(value);
    to_rational(value, a);
    assert_true(mpq_equal(value, b));
    assert_int_equal(a.sign, mpq_sgn(b));
    assert_int_equal(a.count == 0, a.sign == 0);
    if (a.count) assert_true(a.limbs[0] != 0 && a.limbs[a.count - 1] != 0);
    mpq_clear(value);
}

static void fill(fuzz_source *r, fuzz_class kind, num_arena *arena, pool *p) {
    double x[NUMBERS * 3];
    fuzz_points(r, kind, 3, x, NUMBERS);
    arena->top = 0;
    for (int i = 0; i < NUMBERS; i++) {
        p->ours[i] = num_dyadic_from(arena, x[i]);
        mpq_set_d(p->theirs[i], x[i]);
    }
}

/* p[to] = p[i] op p[j] */
static void step(fuzz_source *r, num_arena *arena, pool *p) {
    int i = fuzz_int(r, 0, NUMBERS - 1), j = fuzz_int(r, 0, NUMBERS - 1), to = fuzz_int(r, 0, NUMBERS - 1);
    num_dyadic a = p->ours[i], b = p->ours[j];
    assert_int_equal(num_dyadic_compare(a, b),
                     (mpq_cmp(p->theirs[i], p->theirs[j]) > 0) - (mpq_cmp(p->theirs[i], p->theirs[j]) < 0));
    switch (fuzz_int(r, 0, 2)) {
    case 0:
        p->ours[to] = num_dyadic_add(arena, a, b);
        mpq_add(p->theirs[to], p->theirs[i], p->theirs[j]);
        break;
    case 1:
        p->ours[to] = num_dyadic_sub(arena, a, b);
        mpq_sub(p->theirs[to], p->theirs[i], p->theirs[j]);
        break;
    default:
        if (a.count > 200 || b.count > 200) return;
        p->ours[to] = num_dyadic_mul(arena, a, b);
        mpq_mul(p->theirs[to], p->theirs[i], p->theirs[j]);
    }
    assert_equal(p->ours[to], p->theirs[to]);
}

typedef struct fixture {
    num_arena arena;
    pool p;
    froe_allocator alloc;
} fixture;

static void every_double_and_every_ring_operation_is_exact(void **state) {
    fixture *f = *state;
    fuzz_source r = {1};
    for (int i = 0; i < 400 * FUZZ_CLASSES; i++) {
        fill(&r, (fuzz_class)(i % FUZZ_CLASSES), &f->arena, &f->p);
        for (int k = 0; k < NUMBERS; k++) assert_equal(f->p.ours[k], f->p.theirs[k]);
        for (int k = 0; k < 12; k++) step(&r, &f->arena, &f->p);
    }
}

static void assert_quotient(fixture *f, int i, int j) {
    mpq_t exact;
    if (!f->p.ours[j].sign) return;
    mpq_init(exact);
    mpq_div(exact, f->p.theirs[i], f->p.theirs[j]);
    double q = num_dyadic_quotient(&f->arena, f->p.ours[i], f->p.ours[j]);
    assert_true(rational_rounds_to(exact, q));
    assert_true(q != 0 || !signbit(q));
    mpq_clear(exact);
}

static void quotients_round_to_the_nearest_double(void **state) {
    fixture *f = *state;
    fuzz_source r = {2};
    for (int i = 0; i < 1500 * FUZZ_CLASSES; i++) {
        fill(&r, (fuzz_class)(i % FUZZ_CLASSES), &f->arena, &f->p);
        for (int k = 0; k < 4; k++) step(&r, &f->arena, &f->p);
        assert_quotient(f, 0, 1);
        assert_quotient(f, 2, 3);
    }
}

/* (m + t/8) 2^e over an odd divisor: exactly and nearly half way between doubles, in the
 * denormals, and where the largest double ends. */
static void quotients_round_ties_to_even(void **state) {
    fixture *f = *state;
    fuzz_source r = {3};
    static const int powers[] = {-1090, -1078, -1077, -1076, -1075, -1074, -1030, -60,
                                 0,     900,   966,   967,   968,   969,   970,   971};
    for (int i = 0; i < 40000; i++) {
        f->arena.top = 0;
        uint64_t whole = fuzz_bits(&r) >> fuzz_int(&r, 1, 64 - 4), divisor = 1 + (fuzz_bits(&r) >> fuzz_int(&r, 1, 63));
        if (fuzz_int(&r, 0, 3) == 0) whole = ((uint64_t)1 << 57) - (uint64_t)fuzz_int(&r, 1, 20);
        int power = powers[fuzz_int(&r, 0, 15)] - fuzz_int(&r, 0, 4);
        num_dyadic b = num_dyadic_scaled(&f->arena, 1, divisor, 0);
        num_dyadic a =
            num_dyadic_mul(&f->arena, num_dyadic_scaled(&f->arena, fuzz_int(&r, 0, 1) ? 1 : -1, whole, power), b);
        if (fuzz_int(&r, 0, 2) == 0) /* a hair more */
            a = num_dyadic_add(&f->arena, a, num_dyadic_scaled(&f->arena, 1, 1, power - 200));
        f->p.ours[0] = a, f->p.ours[1] = b;
        to_rational(f->p.theirs[0], a);
        to_rational(f->p.theirs[1], b);
        assert_quotient(f, 0, 1);
    }
}

static void quotients_know_their_edge_cases(void **state) {
    fixture *f = *state;
    static const double cases[][3] = {
        {0, 3, 0},
        {1, 3, 1.0 / 3},
        {-2, 3, -2.0 / 3},
        {0x1p-1074, 2, 0}, /* tie to even: 0 */
        {-0x1p-1074, 2, 0},
        {0x3p-1074, 2, 0x2p-1074},
        {0x1.fffffffffffffp1023, 0.5, INFINITY},
        {-0x1.fffffffffffffp1023, 0x1p-1074, -INFINITY},
        {0x1p-1074, 0x1.fffffffffffffp1023, 0},
        {0x1.fffffffffffffp1023, 1, 0x1.fffffffffffffp1023},
        {0x1p-1074, 0x1p-1074, 1},
        {7, -7, -1},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        num_dyadic a = num_dyadic_from(&f->arena, cases[i][0]), b = num_dyadic_from(&f->arena, cases[i][1]);
        assert_true(num_dyadic_quotient(&f->arena, a, b) == cases[i][2]);
    }
}

static int setup(void **state) {
    static fixture f;
    f.alloc = support_allocator(NULL);
    for (int i = 0; i < NUMBERS; i++) mpq_init(f.p.theirs[i]);
    *state = &f;
    return num_arena_new(&f.alloc, &f.arena) != FROE_OK;
}

static int teardown(void **state) {
    fixture *f = *state;
    for (int i = 0; i < NUMBERS; i++) mpq_clear(f->p.theirs[i]);
    num_arena_free(&f->alloc, &f->arena);
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_double_and_every_ring_operation_is_exact),
        cmocka_unit_test(quotients_round_to_the_nearest_double),
        cmocka_unit_test(quotients_round_ties_to_even),
        cmocka_unit_test(quotients_know_their_edge_cases),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
