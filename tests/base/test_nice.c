/* test_nice.c: round numbers: the next one up or down, and themselves. */
#include "support/nice.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static void numbers_are_rounded_to_1_2_and_5_times_powers_of_ten(void **state) {
    static const double cases[][3] = {{1, 1, 1},          {1.0000001, 1, 2},
                                      {1.9, 1, 2},        {2, 2, 2},
                                      {3, 2, 5},          {5, 5, 5},
                                      {7, 5, 10},         {9.99, 5, 10},
                                      {10, 10, 10},       {0.3, 0.2, 0.5},
                                      {0.1, 0.1, 0.1},    {1234, 1000, 2000},
                                      {4e-9, 2e-9, 5e-9}, {6e300, 5e300, 1e301},
                                      {96, 50, 100},      {0.00095, 0.0005, 0.001}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        assert_true(support_nice_below(cases[i][0]) == cases[i][1]);
        assert_true(support_nice_above(cases[i][0]) == cases[i][2]);
    }
}

static void beyond_all_doubles_there_is_none(void **state) {
    (void)state;
    assert_true(support_nice_above(1.7976931348623157e308) > 1.7976931348623157e308);
    assert_true(support_nice_below(5e-324) == 0 || support_nice_below(5e-324) <= 5e-324);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_are_rounded_to_1_2_and_5_times_powers_of_ten),
        cmocka_unit_test(beyond_all_doubles_there_is_none),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
