/* Ranges of every shape on trees of every builder, against brute force in rationals. */
#include "query/standing.h"

enum { DECISIONS = 1000000 };

static void check_shape(froe_range_shape shape) {
    size_t decisions = 0;
    for (uint64_t seed = 0; decisions < DECISIONS; seed++)
        for (size_t i = 0; i < world_count; i++) decisions += ask(&worlds[i], shape, 1000 * seed + i);
    print_message("%s: %zu decisions\n", froe_range_shape_name(shape), decisions);
}

static void boxes(void **state) {
    (void)state;
    check_shape(FROE_SHAPE_BOX);
}
static void balls(void **state) {
    (void)state;
    check_shape(FROE_SHAPE_BALL);
}
static void simplices(void **state) {
    (void)state;
    check_shape(FROE_SHAPE_SIMPLEX);
}
static void capsules(void **state) {
    (void)state;
    check_shape(FROE_SHAPE_CAPSULE);
}
static void halfspaces(void **state) {
    (void)state;
    check_shape(FROE_SHAPE_HALFSPACES);
}
static void hulls(void **state) {
    (void)state;
    check_shape(FROE_SHAPE_HULL);
}
static void segments(void **state) {
    (void)state;
    check_shape(FROE_SHAPE_SEGMENT);
}
static void rays(void **state) {
    (void)state;
    check_shape(FROE_SHAPE_RAY);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(boxes),      cmocka_unit_test(balls), cmocka_unit_test(simplices), cmocka_unit_test(capsules),
        cmocka_unit_test(halfspaces), cmocka_unit_test(hulls), cmocka_unit_test(segments),  cmocka_unit_test(rays),
    };
    return cmocka_run_group_tests(tests, standing_begin, standing_end);
}
