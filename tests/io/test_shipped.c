/* The real scenes in data/, object by object. */
#include "support.h"

#define DATA(name) FROE_TEST_DATA "/" name

static froe_scene *expect(const char *path, const char *format, const char *precision, froe_kind kind, size_t objects,
                          size_t features) {
    froe_read_report report;
    froe_scene *scene = read_scene(path, &report);
    assert_string_equal(report.format, format);
    assert_string_equal(report.precision, precision);
    assert_int_equal(froe_scene_object_count(scene), objects);
    assert_int_equal(froe_scene_kind_count(scene, kind), objects);
    assert_int_equal(report.features, features);
    assert_int_equal(report.groups, froe_scene_group_count(scene));
    assert_int_equal(report.skipped + report.no_geometry + report.closed + report.linearised + report.flattened, 0);
    assert_true(report.seconds > 0);
    return scene;
}

static void the_floor_plans_have_all_their_segments(void **state) {
    (void)state;
    froe_scene *scene = expect(DATA("freedoom-e1m1.geojson"), "GeoJSON", "float64", FROE_SEGMENT, 812, 812);
    const double *a = corner(scene, 0, 0), *b = corner(scene, 811, 1);
    assert_true(a[0] == 2672 && a[1] == 608);
    assert_true(b[0] == 2496 && b[1] == 640);
    assert_int_equal(froe_scene_object(scene, 811).tag, 811);
    froe_scene_free(scene);
    froe_scene_free(expect(DATA("freedoom-e1m5.geojson"), "GeoJSON", "float64", FROE_SEGMENT, 6951, 6951));
}

static void a_topology_gives_its_first_layer_with_borders_twice(void **state) {
    (void)state;
    froe_scene *states = expect(DATA("states-albers-10m.json"), "TopoJSON", "float64", FROE_SEGMENT, 9147, 51);
    assert_int_equal(distinct_edges(states), 6872);
    assert_int_equal(froe_scene_group_count(states), 51);
    assert_string_equal(froe_scene_group(states, 0).name, "Alabama");
    assert_string_equal(froe_scene_group(states, 0).material, "states");
    froe_scene_free(states);
    froe_scene *countries = expect(DATA("countries-110m.json"), "TopoJSON", "float64", FROE_SEGMENT, 10301, 177);
    assert_int_equal(distinct_edges(countries), 7650);
    froe_scene_free(countries);
}

static void another_layer_is_read_when_it_is_named(void **state) {
    (void)state;
    froe_read_options options = froe_read_defaults();
    froe_read_report report;
    options.layer = "nation";
    froe_scene *nation = read_with(DATA("states-albers-10m.json"), &options, &report);
    assert_int_equal(report.features, 1);
    assert_int_equal(report.layers, 1);
    assert_int_equal(report.layers_left, 1);
    assert_int_equal(distinct_edges(nation), froe_scene_object_count(nation));
    froe_scene_free(nation);
    options.layer = "moon";
    refuse_with(DATA("states-albers-10m.json"), &options, FROE_E_OPTIONS, "There are: states, nation.");
}

static void a_filter_leaves_the_features_that_pass(void **state) {
    (void)state;
    froe_read_options options = froe_read_defaults();
    froe_read_report report;
    options.where = "name IN ('Utah', 'Colorado')";
    froe_scene *scene = read_with(DATA("states-albers-10m.json"), &options, &report);
    assert_int_equal(froe_scene_group_count(scene), 2);
    froe_scene_free(scene);
    options.where = "name = ";
    refuse_with(DATA("states-albers-10m.json"), &options, FROE_E_OPTIONS, "");
    options.where = "size > 3";
    refuse_with(DATA("states-albers-10m.json"), &options, FROE_E_OPTIONS, "size");
    options.where = "name = 'Atlantis'";
    refuse_with(DATA("states-albers-10m.json"), &options, FROE_E_INPUT, "holds no objects");
}

static void the_teapot_is_read_in_double_precision(void **state) {
    (void)state;
    froe_scene *scene = expect(DATA("utah-teapot.obj"), "OBJ", "float64", FROE_POLYGON, 6320, 1);
    assert_int_equal(froe_scene_vertex_count(scene), 3241);
    for (uint32_t v = 0; v < froe_scene_vertex_count(scene); v++) /* its file has 6 decimals */
        for (int k = 0; k < 3; k++) {
            char text[32];
            snprintf(text, sizeof text, "%.6f", froe_scene_vertex(scene, v)[k]);
            assert_true(strtod(text, NULL) == froe_scene_vertex(scene, v)[k]);
        }
    froe_scene_free(scene);
}

static void the_house_has_110_objects_with_names_and_materials(void **state) {
    (void)state;
    froe_scene *scene = expect(DATA("fzk-haus.glb"), "glTF2 (assimp)", "float32", FROE_POLYGON, 35906, 110);
    froe_group first = froe_scene_group(scene, 0);
    assert_true(!strncmp(first.name, "IfcSite_Gel", 11));
    assert_string_equal(first.material, "Erde");
    for (uint32_t i = 0; i < 35906; i++) assert_true(froe_scene_object(scene, i).group != FROE_NONE);
    froe_scene_free(scene);
}

static void the_boxes_of_the_house_are_the_boxes_of_its_objects(void **state) {
    (void)state;
    froe_scene *table = expect(DATA("fzk-haus-boxes.csv"), "CSV boxes", "float64", FROE_BOX, 110, 110);
    froe_read_options options = froe_read_defaults();
    options.boxes = true;
    froe_scene *house = read_with(DATA("fzk-haus.glb"), &options, NULL);
    assert_int_equal(froe_scene_kind_count(house, FROE_BOX), 110);
    assert_int_equal(froe_scene_group_count(house), 110);
    double lo[2][3], hi[2][3];
    assert_true(froe_scene_bounds(table, lo[0], hi[0]) && froe_scene_bounds(house, lo[1], hi[1]));
    for (int k = 0; k < 3; k++) { /* the table has 9 digits */
        assert_float_equal(lo[0][k], lo[1][k], 1e-6);
        assert_float_equal(hi[0][k], hi[1][k], 1e-6);
    }
    froe_scene_free(table);
    froe_scene_free(house);
}

static void moving_cars_are_no_scene(void **state) {
    (void)state;
    refuse(DATA("cars-bologna.mfjson"), FROE_E_UNSUPPORTED, "moving");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_floor_plans_have_all_their_segments),
        cmocka_unit_test(a_topology_gives_its_first_layer_with_borders_twice),
        cmocka_unit_test(another_layer_is_read_when_it_is_named),
        cmocka_unit_test(a_filter_leaves_the_features_that_pass),
        cmocka_unit_test(the_teapot_is_read_in_double_precision),
        cmocka_unit_test(the_house_has_110_objects_with_names_and_materials),
        cmocka_unit_test(the_boxes_of_the_house_are_the_boxes_of_its_objects),
        cmocka_unit_test(moving_cars_are_no_scene),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
