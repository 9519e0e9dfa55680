/* Ranges of every shape on trees of every builder, against brute force in rationals. */
#include "query/ranges.h"

enum { DECISIONS = 1000000 };

/* ------------------------------------------------------------------- worlds -- */

static world worlds[16];
static size_t world_count;

static void add_world(const char *name, froe_scene *scene, bool lattice) {
    worlds[world_count] = world_begin(name, scene);
    worlds[world_count++].lattice = lattice;
}

static int begin(void **state) {
    (void)state;
    add_world("segments", world_mixture(2, 1 << FROE_SEGMENT, 300, 0, 0.15, 1), false);
    add_world("lattice", world_mixture(2, FLAT_KINDS, 80, 12, 0.4, 2), true);
    add_world("solids in the plane", world_mixture(2, FLAT_KINDS | SOLID_KINDS | 1 << FROE_HULL, 50, 0, 0.15, 3),
              false);
    add_world("lattice of solids", world_mixture(2, FLAT_KINDS | SOLID_KINDS | 1 << FROE_HULL, 30, 12, 0.4, 4), true);
    add_world("polygons", world_mixture(3, 1 << FROE_POLYGON, 150, 0, 0.2, 5), false);
    add_world("lattice in space", world_mixture(3, FLAT_KINDS | 1 << FROE_POLYGON, 40, 6, 0.6, 6), true);
    add_world("solids in space",
              world_mixture(3, FLAT_KINDS | SOLID_KINDS | 1 << FROE_HULL | 1 << FROE_POLYGON, 30, 0, 0.2, 7), false);
    add_world("floor plan", world_read("freedoom-e1m1.geojson"), false);
    return 0;
}

static int end(void **state) {
    (void)state;
    for (size_t i = 0; i < world_count; i++) world_end(&worlds[i]);
    return 0;
}

static void check_shape(froe_range_shape shape) {
    size_t decisions = 0;
    for (uint64_t seed = 0; decisions < DECISIONS; seed++)
        for (size_t i = 0; i < world_count; i++) decisions += ask(&worlds[i], shape, 1000 * seed + i);
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
    return cmocka_run_group_tests(tests, begin, end);
}
