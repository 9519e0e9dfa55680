/* test_selftest.c: the hard cases are right, and they are hard: neither filter nor balls decide any of them. (Builds
 * that get them wrong: scripts/check-selftest.) */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "geom/selftest.h"

static void this_build_gets_the_hard_cases_right_from_every_stage(void **state) {
    num_context context;
    (void)state;
    assert_int_equal(geom_context_new(NULL, &context), FROE_OK);
    assert_int_equal(context.first, NUM_FILTER);
    assert_int_equal(context.stats.calls, 0);
    for (int stage = NUM_FILTER; stage <= NUM_EXACT; stage++) {
        context.first = (num_stage)stage;
        assert_null(geom_formula_at_fault(&context));
    }
    num_context_free(&context);
}

static void only_exact_numbers_decide_the_hard_cases(void **state) {
    num_context context;
    (void)state;
    assert_int_equal(geom_context_new(NULL, &context), FROE_OK);
    assert_null(geom_formula_at_fault(&context));
    assert_true(context.stats.exact >= 13);
    assert_true(context.stats.filtered + context.stats.refined + context.stats.by_id <= 1); /* how the ray is met */
    num_context_free(&context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(this_build_gets_the_hard_cases_right_from_every_stage),
        cmocka_unit_test(only_exact_numbers_decide_the_hard_cases),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
