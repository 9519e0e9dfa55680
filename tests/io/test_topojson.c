/* TopoJSON whose geometries name arcs that do not exist: GDAL leaves them out. */
#include "support.h"
#include <cpl_vsi.h>

/* Arc 0 is a line, arc 1 a ring. */
static void write_topology(const char *path, const char *geometry) {
    char text[1024];
    assert_true((size_t)snprintf(text, sizeof text,
                                 "{\"type\": \"Topology\", \"transform\": {\"scale\": [1, 1], \"translate\": [0, 0]},\n"
                                 "\"objects\": {\"a\": {\"type\": \"GeometryCollection\", \"geometries\": [{\"type\": "
                                 "\"LineString\", \"arcs\": [0]}]}, \"b\": %s},\n"
                                 "\"arcs\": [[[0, 0], [1, 2]], [[5, 0], [4, 0], [0, 4], [-4, -4]]]}\n",
                                 geometry) < sizeof text);
    write_text(path, text);
}

static void arcs_that_do_not_exist_are_refused(void **state) {
    (void)state;
    static const struct {
        const char *geometry, *arc;
    } cases[] = {
        {"{\"type\": \"LineString\", \"arcs\": [2]}", "2"},
        {"{\"type\": \"LineString\", \"arcs\": [ 0, 9 ]}", "9"},
        {"{\"type\": \"LineString\", \"arcs\": [-3]}", "-3"},
        {"{\"type\": \"LineString\", \"arcs\": [0.5]}", "0.5"},
        {"{\"type\": \"LineString\", \"arcs\": [1e0]}", "1e0"},
        {"{\"type\": \"LineString\", \"arcs\": [null]}", "null"},
        {"{\"type\": \"LineString\", \"arcs\": [0, \"one\"]}", "one"},
        {"{\"type\": \"MultiLineString\", \"arcs\": [[0], [2]]}", "2"},
        {"{\"type\": \"Polygon\", \"arcs\": [[1], [7]]}", "7"},
        {"{\"type\": \"MultiPolygon\", \"arcs\": [[[1]], [[8]]]}", "8"},
        {"{\"type\": \"GeometryCollection\", \"geometries\": [{\"type\": \"Polygon\", \"arcs\": [[3]]}]}", "3"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char sentence[100];
        write_topology("t.json", cases[i].geometry);
        snprintf(sentence, sizeof sentence, "t.json: object 'b': A geometry names arc '%s', and there are 2 of them.",
                 cases[i].arc);
        refuse("t.json", FROE_E_FORMAT, sentence);
    }
    write_text("one.json", "{\"type\": \"Topology\", \"objects\": {\"b\": {\"type\": \"LineString\", \"arcs\": [1]}},\n"
                           "\"arcs\": [[[0, 0], [1, 2]]]}");
    refuse("one.json", FROE_E_FORMAT, "arc '1', and there is 1 of them.");
}

static void arcs_that_exist_are_read(void **state) {
    (void)state;
    static const char *const geometries[] = {
        "{\"type\": \"LineString\", \"arcs\": [-1, -2]}",
        "{\"type\": \"MultiLineString\", \"arcs\": [[0], [ 1 ]]}",
        "{\"type\": \"Polygon\", \"arcs\": [[1]], \"properties\": {\"arcs\": [7]}}",
        "{\"type\": \"Polygon\", \"arcs\": [[1]], \"properties\": {\"name\": \"caf\xe9\"}}", /* which is no JSON */
        "{\"type\": \"Point\", \"coordinates\": [3, 3], \"arcs\": [7]}",
        "{\"type\": \"Polygon\"}",
        "{\"other\": 1}",
    };
    for (size_t i = 0; i < sizeof geometries / sizeof *geometries; i++) {
        write_topology("t.json", geometries[i]);
        froe_scene *scene = read_scene("t.json", NULL);
        assert_true(froe_scene_object_count(scene) > 0);
        froe_scene_free(scene);
    }
}

static void archives_are_looked_into(void **state) {
    (void)state;
    static const char text[] =
        "{\"type\": \"Topology\", \"objects\": {\"b\": {\"type\": \"LineString\", \"arcs\": [1]}},\n"
        "\"arcs\": [[[0, 0], [1, 2]]]}";
    VSILFILE *file = VSIFOpenL("/vsigzip/t.json.gz", "wb");
    assert_int_equal(VSIFWriteL(text, 1, sizeof text - 1, file), sizeof text - 1);
    assert_int_equal(VSIFCloseL(file), 0);
    refuse("t.json.gz", FROE_E_FORMAT, "arc '1', and there is 1 of them.");
}

static void every_failing_allocation_gives_a_status(void **state) {
    (void)state;
    write_topology("t.json", "{\"type\": \"Polygon\", \"arcs\": [[1]]}");
    test_memory_each(read_with_memory, "t.json");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(arcs_that_do_not_exist_are_refused),
        cmocka_unit_test(arcs_that_exist_are_read),
        cmocka_unit_test(archives_are_looked_into),
        cmocka_unit_test(every_failing_allocation_gives_a_status),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
