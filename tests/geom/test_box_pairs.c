/* Pairs of touching boxes against comparing all with all, on boxes that like to go wrong. */
#include "support/alloc.h"

#include "base/random.h"
#include "geom/meet/box_pairs.h"
#include "support/memory.h"
#include <string.h>

enum { MOST = 3000 };

typedef struct boxes {
    int dim;
    uint32_t count;
    double lo[4 * MOST], hi[4 * MOST];
} boxes;

typedef struct matrix {
    uint32_t count;
    unsigned char *seen; /* [a * count + b], a < b */
    _Atomic uint64_t pairs;
} matrix;

static bool note(void *user, unsigned worker, uint32_t a, uint32_t b) {
    matrix *m = user;
    (void)worker;
    if (a > b) {
        uint32_t c = a;
        a = b;
        b = c;
    }
    m->seen[(size_t)a * m->count + b]++;
    m->pairs++;
    return true;
}

static bool touch(const boxes *x, uint32_t a, uint32_t b) {
    size_t dim = (size_t)x->dim;
    for (size_t k = 0; k < dim; k++)
        if (x->lo[a * dim + k] > x->hi[b * dim + k] || x->lo[b * dim + k] > x->hi[a * dim + k]) return false;
    return true;
}

static uint64_t check(const boxes *x, unsigned threads) {
    matrix m = {.count = x->count, .seen = calloc(x->count, x->count)};
    test_memory memory;
    froe_allocator alloc = test_memory_begin(&memory);
    base_task task;
    uint64_t pairs = 0;
    base_task_init(&task, threads, NULL, NULL);
    assert_non_null(m.seen);
    assert_int_equal(geom_box_pairs(&alloc, &task, 1, x->dim, x->count, x->lo, x->hi, note, &m), FROE_OK);
    for (uint32_t b = 0; b < x->count; b++)
        for (uint32_t a = 0; a < b; a++) {
            bool expected = touch(x, a, b);
            assert_int_equal(m.seen[(size_t)a * x->count + b], expected);
            pairs += expected;
        }
    assert_int_equal(m.pairs, pairs); /* none twice, none with itself */
    free(m.seen);
    test_memory_end(&memory);
    return pairs;
}

/** Boxes with corners in 0 .. range and sides up to `side`. */
static void random_boxes(boxes *x, int dim, uint32_t count, uint32_t range, uint32_t side, uint64_t seed) {
    x->dim = dim;
    x->count = count;
    for (uint32_t i = 0; i < count * (uint32_t)dim; i++) {
        x->lo[i] = base_below(base_hash(seed, i, 0), range);
        x->hi[i] = x->lo[i] + base_below(base_hash(seed, i, 1), side + 1);
    }
}

static boxes x; /* too large for small stacks */

static void random_and_lattice_boxes(void **state) {
    (void)state;
    for (int dim = 2; dim <= 4; dim++)
        for (uint64_t seed = 0; seed < 4; seed++)
            for (uint32_t range = 3; range <= 30000; range *= 10)
                for (uint32_t part = 1; part <= 1000; part *= 10) {
                    random_boxes(&x, dim, 400 + (uint32_t)seed * 100, range, range / part, seed);
                    check(&x, 1 + (unsigned)(seed % 3));
                }
}

static void few_boxes(void **state) {
    (void)state;
    for (uint32_t count = 0; count < 60; count++) {
        random_boxes(&x, 2 + (int)count % 3, count, 4, 2, count);
        check(&x, 2);
    }
}

static void many_slabs_find_each_pair_once(void **state) {
    (void)state;
    for (int dim = 2; dim <= 4; dim++)
        for (uint32_t side = 1; side <= 10000; side *= 10) {
            random_boxes(&x, dim, MOST, 10000, side, side);
            assert_true(check(&x, 2) > 0 || side < 1000);
        }
}

static void nested_equal_and_flat_boxes(void **state) {
    (void)state;
    x.dim = 3;
    x.count = 1500;
    for (int shape = 0; shape < 6; shape++) {
        for (uint32_t i = 0; i < x.count; i++)
            for (uint32_t k = 0; k < 3; k++) {
                double c = i, *lo = x.lo + 3 * i + k, *hi = x.hi + 3 * i + k;
                if (shape == 0) *lo = -c, *hi = c;                                     /* nested */
                if (shape == 1) *lo = 5, *hi = 5;                                      /* all one point */
                if (shape == 2) *lo = k == 1 ? 7 : c, *hi = *lo;                       /* points on a line */
                if (shape == 3) *lo = k == 0 ? 0 : c, *hi = k == 0 ? 9 : c;            /* parallel rods */
                if (shape == 4) *lo = k == i % 3 ? 0 : c, *hi = k == i % 3 ? 9999 : c; /* rods three ways */
                if (shape == 5) *lo = c, *hi = c + 1;                                  /* a staircase, touching */
            }
        check(&x, 2);
    }
}

static bool count_only(void *user, unsigned worker, uint32_t a, uint32_t b) {
    (void)worker, (void)a, (void)b;
    ++*(_Atomic uint64_t *)user;
    return true;
}

/** Nothing here is quadratic but the number of pairs, which is small. */
static void many_boxes_of_awkward_shapes_are_quick(void **state) {
    (void)state;
    enum { N = 300000 };
    double *lo = malloc(3 * N * sizeof *lo), *hi = malloc(3 * N * sizeof *hi);
    assert_true(lo && hi);
    const uint64_t expected[] = {N - 1, 0, N / 2 - 1 + N / 2};
    for (int shape = 0; shape < 3; shape++) {
        for (uint32_t i = 0; i < N; i++)
            for (uint32_t k = 0; k < 3; k++) {
                double c = i, *l = lo + 3 * i + k, *h = hi + 3 * i + k;
                if (shape == 0) *l = c, *h = c + 1;                       /* staircase */
                if (shape == 1) *l = k == 2 ? c : 0, *h = k == 2 ? c : N; /* a stack of sheets */
                if (shape == 2) /* half of them clustered in one unit, half spread; neighbours touch */
                    *l = i < N / 2 ? c / N : c, *h = i < N / 2 ? (c + 1) / N : c + 1;
            }
        _Atomic uint64_t pairs = 0;
        froe_allocator alloc = support_allocator(NULL);
        base_task task;
        base_task_init(&task, 2, NULL, NULL);
        assert_int_equal(geom_box_pairs(&alloc, &task, 1, 3, N, lo, hi, count_only, &pairs), FROE_OK);
        if (shape < 2)
            assert_int_equal(pairs, expected[shape]);
        else
            assert_in_range(pairs, expected[2] - 2, expected[2]);
    }
    free(lo);
    free(hi);
}

static bool stop_after(void *user, double done) {
    (void)done;
    return ++*(int *)user < 3;
}

static void a_scene_with_far_too_many_pairs_can_be_cancelled(void **state) {
    (void)state;
    enum { N = 200000 }; /* 2 * 10^10 pairs */
    double *lo = malloc(2 * N * sizeof *lo), *hi = malloc(2 * N * sizeof *hi);
    assert_true(lo && hi);
    for (int i = 0; i < 2 * N; i++) lo[i] = -i, hi[i] = i;
    for (unsigned threads = 1; threads <= 3; threads++) {
        _Atomic uint64_t pairs = 0;
        int calls = 0;
        test_memory memory;
        froe_allocator alloc = test_memory_begin(&memory);
        base_task task;
        base_task_init(&task, threads, stop_after, &calls);
        assert_int_equal(geom_box_pairs(&alloc, &task, 1, 2, N, lo, hi, count_only, &pairs), FROE_E_CANCELLED);
        assert_true(pairs < 1000000000);
        test_memory_end(&memory);
    }
    free(lo);
    free(hi);
}

static froe_status enumerate(void *user, const froe_allocator *alloc) {
    const boxes *b = user;
    _Atomic uint64_t pairs = 0;
    base_task task;
    base_task_init(&task, 1, NULL, NULL);
    return geom_box_pairs(alloc, &task, 1, b->dim, b->count, b->lo, b->hi, count_only, &pairs);
}

static void every_failing_allocation_is_survived(void **state) {
    (void)state;
    random_boxes(&x, 3, 2000, 1000, 900, 1);
    assert_true(test_memory_each(enumerate, &x) > 4);
}

typedef struct few_calls {
    uint64_t calls, most;
} few_calls;

static bool count_few(void *user, unsigned worker, uint32_t a, uint32_t b) {
    few_calls *few = user;
    (void)worker, (void)a, (void)b;
    return ++few->calls < few->most;
}

/* Whichever pair the caller stops at is the last one. */
static void the_caller_may_stop_at_any_pair(void **state) {
    (void)state;
    const froe_allocator alloc = support_allocator(NULL);
    for (int dim = 2; dim <= 3; dim++)
        for (uint32_t count = 20; count <= 520; count += 250) {
            random_boxes(&x, dim, count, 20, 9, count);
            const uint64_t pairs = check(&x, 1);
            assert_true(pairs > 0);
            for (few_calls few = {.most = 1}; few.most <= pairs; few.most += 1 + pairs / 50) {
                base_task task;
                base_task_init(&task, 1, NULL, NULL);
                few.calls = 0;
                const froe_status status = geom_box_pairs(&alloc, &task, 1, dim, count, x.lo, x.hi, count_few, &few);
                assert_int_equal(status, FROE_E_CANCELLED);
                assert_int_equal(few.calls, few.most);
            }
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_and_lattice_boxes),
        cmocka_unit_test(few_boxes),
        cmocka_unit_test(many_slabs_find_each_pair_once),
        cmocka_unit_test(nested_equal_and_flat_boxes),
        cmocka_unit_test(many_boxes_of_awkward_shapes_are_quick),
        cmocka_unit_test(a_scene_with_far_too_many_pairs_can_be_cancelled),
        cmocka_unit_test(the_caller_may_stop_at_any_pair),
        cmocka_unit_test(every_failing_allocation_is_survived),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
