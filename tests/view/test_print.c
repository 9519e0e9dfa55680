/* Convex rings on the page. */
#include "../tree/trees.h"
#include "view/print.h"

static const print_point square[] = {
    {0, 0}, {0, 2}, {2, 2}, {2, 0}}; /* y points down: this turns left as one sees it */

static bool overlap(const print_point *a, size_t a_count, double x, double y, double margin) {
    print_point b[4];
    for (int i = 0; i < 4; i++) b[i] = (print_point){square[i].x + x, square[i].y + y};
    const bool there = print_overlap(a, a_count, b, 4, margin);
    assert_int_equal(there, print_overlap(b, 4, a, a_count, margin));
    return there;
}

static void rings_overlap_by_more_than_a_margin(void **state) {
    (void)state;
    assert_true(print_area(square, 4) > 0);
    assert_true(overlap(square, 4, 1, 1, 0.5));
    assert_true(overlap(square, 4, 1.75, 0, 0.125));
    assert_false(overlap(square, 4, 1.75, 0, 0.5));
    assert_false(overlap(square, 4, 2, 0, 0));
    assert_true(overlap(square, 4, 2, 0, -0.125));
    assert_false(overlap(square, 4, 2.5, 0, -0.125));
    assert_false(overlap(square, 4, -3, 5, -0.125));
}

/* Rounding makes one point of the page from two, or two with any direction between them: that no side has it says
 * nothing about the ring. Once a face of a house was painted over one before it for that. */
static void corners_that_all_but_coincide_separate_nothing(void **state) {
    (void)state;
    for (int way = 0; way < 9; way++) {
        const double dx = (way % 3 - 1) * 0x1p-50, dy = (way / 3 - 1) * 0x1p-50;
        const print_point five[] = {{0, 0}, {dx, dy}, {0, 2}, {2, 2}, {2, 0}};
        assert_true(overlap(five, 5, 1, 1, -1e-6));
        assert_true(overlap(five, 5, -1, -1, -1e-6));
        assert_true(overlap(five, 5, 1, -1, -1e-6));
        assert_false(overlap(five, 5, 3, 0, -1e-6));
        assert_false(overlap(five, 5, -3, -1, -1e-6));
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rings_overlap_by_more_than_a_margin),
        cmocka_unit_test(corners_that_all_but_coincide_separate_nothing),
    };
    return cmocka_run_group_tests_name("view/print", tests, NULL, NULL);
}
