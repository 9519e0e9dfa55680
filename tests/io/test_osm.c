/* OSM: ways that name nodes which are not in the file are refused, and relations without all their ways are told of. */
#include "support.h"

static void write_osm(const char *path, const char *ways) {
    char text[2048];
    assert_true((size_t)snprintf(text, sizeof text,
                                 "<?xml version=\"1.0\"?>\n<osm version=\"0.6\">\n"
                                 "<node id=\"1\" lat=\"5\" lon=\"5\"/><node id=\"2\" lat=\"5\" lon=\"6\"/>\n"
                                 "<node id=\"3\" lat=\"6\" lon=\"6\"/>\n%s\n</osm>\n",
                                 ways) < sizeof text);
    write_text(path, text);
}

#define ROAD "<tag k=\"highway\" v=\"residential\"/></way>"
#define RING "<way id=\"11\"><nd ref=\"1\"/><nd ref=\"2\"/><nd ref=\"3\"/><nd ref=\"1\"/></way>"
#define FOREST "<tag k=\"type\" v=\"multipolygon\"/><tag k=\"landuse\" v=\"forest\"/></relation>"

static void ways_without_all_their_nodes_are_refused(void **state) {
    (void)state;
    write_osm("cut.osm", "<way id=\"10\"><nd ref=\"1\"/><nd ref=\"99\"/><nd ref=\"2\"/>" ROAD);
    refuse("cut.osm", FROE_E_FORMAT, "cut.osm: OGR reports 'OSM: For way 10, got only 2 nodes instead of 3'.");
    write_osm("cut.osm", "<way id=\"10\"><nd ref=\"98\"/><nd ref=\"2\"/>" ROAD
                         "<way id=\"11\"><nd ref=\"97\"/><nd ref=\"2\"/>" ROAD);
    refuse("cut.osm", FROE_E_FORMAT, "OSM: Way 10 with 1 nodes that could be found. Discarding it'.");
}

static void relations_without_all_their_ways_are_told_of(void **state) {
    (void)state;
    froe_read_report report;
    write_osm("part.osm", "<way id=\"10\"><nd ref=\"1\"/><nd ref=\"2\"/>" ROAD RING
                          "<relation id=\"20\"><member type=\"way\" ref=\"11\" role=\"outer\"/>" FOREST
                          "<relation id=\"21\"><member type=\"way\" ref=\"77\" role=\"outer\"/>" FOREST
                          "<relation id=\"22\"><member type=\"way\" ref=\"78\" role=\"outer\"/>" FOREST);
    froe_scene *scene = read_scene("part.osm", &report);
    assert_int_equal(froe_scene_object_count(scene), 4); /* a line and a ring */
    assert_string_equal(report.sorts_left, "incomplete relations");
    froe_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ways_without_all_their_nodes_are_refused),
        cmocka_unit_test(relations_without_all_their_ways_are_told_of),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
