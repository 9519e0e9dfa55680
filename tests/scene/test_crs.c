/* Coordinate systems of scenes: kept as they were given, whatever memory does; and edges across the antimeridian. */
#include "support/memory.h"

#include "scene/scene.h"
#include <string.h>

static const froe_crs utm = {FROE_CRS_PROJECTED, "PROJCRS[...]", "UTM 32", "EPSG:25832", "metre"};
static const froe_crs wgs84 = {FROE_CRS_GEOGRAPHIC, "GEOGCRS[...]", "WGS 84", NULL, "degree"};

static void assert_crs(froe_crs is, const froe_crs *expected) {
    assert_int_equal(is.kind, expected->kind);
    assert_string_equal(is.wkt, expected->wkt ? expected->wkt : "");
    assert_string_equal(is.name, expected->name ? expected->name : "");
    assert_string_equal(is.code, expected->code ? expected->code : "");
    assert_string_equal(is.unit, expected->unit ? expected->unit : "");
}

static void what_is_set_is_there(void **state) {
    (void)state;
    const froe_crs none = {.kind = FROE_CRS_UNKNOWN}, beyond = {.kind = FROE_CRS_KIND_COUNT};
    froe_scene *s;
    assert_int_equal(froe_scene_new(2, NULL, &s), FROE_OK);
    assert_crs(froe_scene_crs(s), &none);
    assert_int_equal(froe_scene_set_crs(s, &utm), FROE_OK);
    assert_crs(froe_scene_crs(s), &utm);
    assert_int_equal(froe_scene_set_crs(s, &wgs84), FROE_OK);
    assert_crs(froe_scene_crs(s), &wgs84);
    const froe_crs own = froe_scene_crs(s); /* strings of the scene itself */
    assert_int_equal(froe_scene_set_crs(s, &own), FROE_OK);
    assert_crs(froe_scene_crs(s), &wgs84);
    assert_int_equal(froe_scene_set_crs(s, &beyond), FROE_E_ARG);
    assert_int_equal(froe_scene_set_crs(s, NULL), FROE_E_ARG);
    assert_int_equal(froe_scene_set_crs(NULL, &utm), FROE_E_ARG);
    assert_crs(froe_scene_crs(s), &wgs84);
    assert_int_equal(froe_scene_set_crs(s, &(froe_crs){.kind = FROE_CRS_UNKNOWN, .name = "not kept"}), FROE_OK);
    assert_crs(froe_scene_crs(s), &none);
    char *long_name = malloc((1u << 24) + 1);
    assert_non_null(long_name);
    memset(long_name, 'x', 1u << 24);
    long_name[1u << 24] = '\0';
    assert_int_equal(froe_scene_set_crs(s, &(froe_crs){.kind = FROE_CRS_OTHER, .wkt = long_name}), FROE_E_LIMIT);
    assert_crs(froe_scene_crs(s), &none);
    free(long_name);
    scene_hold(s);
    assert_int_equal(froe_scene_set_crs(s, &utm), FROE_E_FROZEN);
    froe_scene_free(s);
    froe_scene_free(s);
}

static froe_status set_twice(void *user, const froe_allocator *alloc) {
    froe_scene *s;
    (void)user;
    froe_status status = froe_scene_new(2, alloc, &s);
    if (status) return status;
    status = froe_scene_set_crs(s, &utm);
    if (!status) status = froe_scene_set_crs(s, &wgs84);
    froe_scene_free(s);
    return status;
}

static void every_failing_allocation_is_survived(void **state) {
    (void)state;
    assert_true(test_memory_each(set_twice, NULL) >= 2);
}

static void strings_of_a_file_must_be_four(void **state) {
    (void)state;
    static const char four[] = "a\0b\0c\0d";
    assert_true(scene_crs_fits(FROE_CRS_UNKNOWN, NULL, 0));
    assert_true(scene_crs_fits(FROE_CRS_OTHER, four, sizeof four));
    assert_false(scene_crs_fits(FROE_CRS_UNKNOWN, four, sizeof four));
    assert_false(scene_crs_fits(FROE_CRS_OTHER, NULL, 0));
    assert_false(scene_crs_fits(FROE_CRS_KIND_COUNT, four, sizeof four));
    assert_false(scene_crs_fits(FROE_CRS_OTHER, four, sizeof four - 1));
    assert_false(scene_crs_fits(FROE_CRS_OTHER, four, sizeof four - 2));
    assert_false(scene_crs_fits(FROE_CRS_OTHER, "a\0b\0c\0d\0", 9));
}

/* ------------------------------------------------------------ antimeridian -- */

static void add(froe_scene *s, froe_kind kind, uint32_t group, uint64_t tag, double x0, double y0, double x1,
                double y1) {
    const double corners[4] = {x0, y0, x1, y1};
    froe_objects b = froe_objects_defaults();
    b.kind = kind;
    b.count = 1;
    b.coords = corners;
    b.group = group;
    b.tags = &tag;
    assert_int_equal(froe_scene_add(s, &b, NULL), FROE_OK);
}

static void features_wider_than_half_the_earth_are_counted(void **state) {
    (void)state;
    uint32_t group, other, first;
    froe_scene *s;
    assert_int_equal(froe_scene_new(2, NULL, &s), FROE_OK);
    assert_int_equal(froe_scene_add_group(s, &(froe_group){.name = "Fiji"}, &group), FROE_OK);
    assert_int_equal(froe_scene_add_group(s, &(froe_group){.name = "Russia"}, &other), FROE_OK);
    add(s, FROE_SEGMENT, group, 0, -90, 10, 90, 10); /* 180 degrees: either way is as long */
    add(s, FROE_SEGMENT, group, 0, -180, -90, 180, -90);
    add(s, FROE_SEGMENT, group, 0, 180, 90, -180, 90);
    assert_int_equal(froe_scene_across(s, &first), 0); /* of an unknown system */
    assert_int_equal(first, FROE_NONE);
    assert_int_equal(froe_scene_set_crs(s, &wgs84), FROE_OK);
    assert_int_equal(froe_scene_across(s, &first), 0);
    add(s, FROE_SEGMENT, group, 0, 179, -17, -179, -17);
    assert_int_equal(froe_scene_across(s, &first), 1);
    assert_int_equal(first, 3);
    add(s, FROE_SEGMENT, group, 0, -179, -16, 179, -16); /* of the same feature */
    assert_int_equal(froe_scene_across(s, NULL), 1);
    add(s, FROE_BOX, other, 1, -180, 41, 180, 82);
    add(s, FROE_SEGMENT, FROE_NONE, 7, 170, 0, -170, 1);
    add(s, FROE_SEGMENT, FROE_NONE, 7, -170, 1, 170, 2);
    add(s, FROE_SEGMENT, FROE_NONE, 8, 170, 2, -170, 3);
    assert_int_equal(froe_scene_across(s, &first), 4);
    assert_int_equal(first, 3);
    assert_int_equal(froe_scene_set_crs(s, &utm), FROE_OK);
    assert_int_equal(froe_scene_across(s, &first), 0);
    froe_scene_free(s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_set_is_there),
        cmocka_unit_test(every_failing_allocation_is_survived),
        cmocka_unit_test(strings_of_a_file_must_be_four),
        cmocka_unit_test(features_wider_than_half_the_earth_are_counted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
