/* test_isolate.c: roots of polynomials that are made of known roots. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "num/isolate.h"
#include "support/fuzz.h"

/* A polynomial with roots  top / bottom, repeated or not, and perhaps the factor x^2 - 2 x + 3 or x^2 + 3, which
 * have none. */
typedef struct made {
    int top[NUM_DEGREE], bottom[NUM_DEGREE], count; /* with repetitions */
    int64_t c[NUM_DEGREE + 1];
    int degree;
} made;

static void multiply(made *p, const int *factor, int degree) {
    int64_t product[NUM_DEGREE + 1] = {0};
    for (int i = 0; i <= p->degree; i++)
        for (int j = 0; j <= degree; j++) product[i + j] += p->c[i] * factor[j];
    p->degree += degree;
    memcpy(p->c, product, sizeof product);
}

static void multiply_root(made *p, int top, int bottom) {
    multiply(p, (const int[]){-top, bottom}, 1);
    p->top[p->count] = top;
    p->bottom[p->count++] = bottom;
}

/* One in four has every second coefficient 0, so that its chain skips degrees. */
static made make(fuzz_source *r) {
    made p = {.c = {fuzz_int(r, 0, 1) ? 3 : -5}};
    const bool even = fuzz_int(r, 0, 3) == 0;
    const int degree = fuzz_int(r, 0, NUM_DEGREE);
    if (degree >= 2 && fuzz_int(r, 0, 3) == 0) multiply(&p, even ? (const int[]){3, 0, 1} : (const int[]){3, -2, 1}, 2);
    while (p.degree + even < degree) {
        int top = fuzz_int(r, -4, 17), bottom = fuzz_int(r, 1, 15); /* 5 (17 + 15)^12 < 2^63 */
        if (p.count && fuzz_int(r, 0, 2) == 0) top = p.top[p.count - 1], bottom = p.bottom[p.count - 1];
        multiply_root(&p, top, bottom);
        if (even) multiply_root(&p, -top, bottom);
    }
    return p;
}

static num_dyadic whole(num_arena *arena, int64_t x) {
    return num_dyadic_scaled(arena, x < 0 ? -1 : 1, (uint64_t)(x < 0 ? -x : x), 0);
}

static num_poly poly_of(num_arena *arena, const made *p) {
    num_poly f = {.degree = p->degree};
    for (int i = 0; i <= p->degree; i++) f.c[i] = whole(arena, p->c[i]);
    return f;
}

static int compare(int top, int bottom, int top2, int bottom2) {
    return (top * bottom2 > top2 * bottom) - (top * bottom2 < top2 * bottom);
}

/* The different roots strictly between 0 and 1, ascending; by their positions in the list. */
static int inside(const made *p, int *out) {
    int count = 0;
    for (int i = 0; i < p->count; i++) {
        bool there = p->top[i] > 0 && p->top[i] < p->bottom[i];
        for (int j = 0; j < i; j++) there = there && compare(p->top[i], p->bottom[i], p->top[j], p->bottom[j]);
        if (!there) continue;
        int at = count++;
        for (; at && compare(p->top[i], p->bottom[i], p->top[out[at - 1]], p->bottom[out[at - 1]]) < 0; at--)
            out[at] = out[at - 1];
        out[at] = i;
    }
    return count;
}

/* Sign of p at top / bottom. */
static int sign_at(const made *p, int top, int bottom) {
    __extension__ __int128 sum = 0, power = 1;
    for (int i = p->degree; i >= 0; i--) {
        sum = sum * top + p->c[i] * power;
        power *= bottom;
    }
    return (sum > 0) - (sum < 0);
}

static void check_place(num_arena *arena, const num_isolated *root, int top, int bottom) {
    size_t mark = arena->top;
    num_dyadic x = whole(arena, top), y = whole(arena, bottom);
    int low = num_dyadic_compare(num_dyadic_mul(arena, num_isolated_low(root), y), x);
    int high = num_dyadic_compare(num_dyadic_mul(arena, num_isolated_high(arena, root), y), x);
    if (root->exact)
        assert_true(low == 0 && high == 0);
    else
        assert_true(low < 0 && high > 0);
    num_ball ball = num_isolated_ball(root);
    assert_true(fabs(ball.x - (double)top / bottom) <= ball.e + 1e-15);
    arena->top = mark;
}

static void check_roots(num_arena *arena, const made *p, num_isolation *f, const made *q, const num_poly *g) {
    int known[NUM_DEGREE], count = inside(p, known);
    num_ball_poly near = num_poly_balls(arena, g);
    assert_int_equal(f->count, count);
    for (int k = 0; k < count; k++) {
        num_isolated *root = &f->root[k];
        int top = p->top[known[k]], bottom = p->bottom[known[k]], sign = sign_at(q, top, bottom);
        check_place(arena, root, top, bottom);
        assert_int_equal(num_isolated_sign(arena, root, g, &near), sign);
        assert_true(num_isolated_narrow(arena, root, 70));
        assert_true(root->exact || root->depth >= 70);
        check_place(arena, root, top, bottom);
        assert_int_equal(num_isolated_sign(arena, root, g, &near), sign);
    }
}

/* A factor without a root in [0, 1] has Bernstein coefficients of one sign there, and so has a product of these. */
static void check_sign_throughout(num_arena *arena, const made *p, const num_poly *f) {
    enum { EXACT_DEGREE = 4 }; /* doubles hold all that is computed of these */
    const size_t mark = arena->top;
    const num_ball_poly near = num_poly_balls(arena, f);
    const int sign = num_ball_poly_sign_throughout(&near);
    bool apart = true;
    for (int i = 0; i < p->count; i++) apart = apart && (p->top[i] < 0 || p->top[i] > p->bottom[i]);
    if (!apart || p->degree <= EXACT_DEGREE || sign != NUM_UNSURE)
        assert_int_equal(sign, apart ? sign_at(p, 1, 2) : NUM_UNSURE);
    arena->top = mark;
}

static void check_order(num_arena *arena, const made *p, num_isolation *f, const made *q, num_isolation *g) {
    int a[NUM_DEGREE], b[NUM_DEGREE], m = inside(p, a), n = inside(q, b);
    for (int i = 0; i < m; i++)
        for (int j = 0; j < n; j++) {
            num_isolated x = f->root[i], y = g->root[j];
            assert_int_equal(num_isolated_compare(arena, &x, &y),
                             compare(p->top[a[i]], p->bottom[a[i]], q->top[b[j]], q->bottom[b[j]]));
        }
}

static void roots_are_isolated_compared_and_asked_exactly(void **state) {
    (void)state;
    fuzz_source r = {3};
    num_arena arena = {0};
    froe_allocator alloc = support_allocator(NULL);
    assert_int_equal(num_arena_reserve(&alloc, &arena, 4 * num_poly_arena(NUM_DEGREE, 2, NUM_FRACTION_LIMBS)), FROE_OK);
    for (int round = 0; round < 4000; round++) {
        arena.top = 0;
        made p = make(&r), q = make(&r);
        if (p.count && q.count && round % 2 && q.degree <= 2) /* a common root */
            multiply_root(&q, p.top[0], p.bottom[0]);
        num_poly f = poly_of(&arena, &p), g = poly_of(&arena, &q);
        num_isolation in_f, in_g;
        check_sign_throughout(&arena, &p, &f);
        num_isolate(&arena, &f, &in_f);
        num_isolate(&arena, &g, &in_g);
        check_order(&arena, &p, &in_f, &q, &in_g);
        check_roots(&arena, &p, &in_f, &q, &g);
    }
    assert_true(arena.high < arena.capacity / 2);
    num_arena_free(&alloc, &arena);
}

/* (3 x - 1)^2 - 2^-power: two roots around 1/3. */
static void roots_that_are_too_close_are_said_to_be_so(void **state) {
    (void)state;
    num_arena arena = {0};
    froe_allocator alloc = support_allocator(NULL);
    assert_int_equal(num_arena_reserve(&alloc, &arena, num_poly_arena(NUM_DEGREE, 80, NUM_FRACTION_LIMBS)), FROE_OK);
    for (int power = 1199; power <= 5000; power += 3801) {
        num_poly f = {.degree = 2};
        f.c[2] = whole(&arena, 9);
        f.c[1] = whole(&arena, -6);
        f.c[0] = num_dyadic_sub(&arena, whole(&arena, 1), num_dyadic_scaled(&arena, 1, 1, -power));
        num_isolation roots;
        num_isolate(&arena, &f, &roots);
        assert_int_equal(roots.count, power == 1199 ? 2 : -1);
        if (roots.count > 0) assert_true(roots.root[0].depth >= 590);
    }
    assert_true(arena.high < arena.capacity / 2);
    num_arena_free(&alloc, &arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(roots_are_isolated_compared_and_asked_exactly),
        cmocka_unit_test(roots_that_are_too_close_are_said_to_be_so),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
