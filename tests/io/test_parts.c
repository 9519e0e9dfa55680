/* Files of which parts are missing, damaged, or elsewhere: meshes and nodes of glTF that do not belong to the scene,
 * buffers in other files, whose names are escaped (RFC 3986, 2.1); arcs of TopoJSON and nodes of OSM that do not exist;
 * what is stored in archives. */
#include "support.h"
#include <cpl_vsi.h>
#include <sys/stat.h>

/* ------------------------------------------------------------------------ glTF -- */

/* A quadrilateral of two triangles, and another one whose last corner is not there; %s are nodes, more meshes, more
 * members, and where the numbers are. */
static const char model[] =
    "{\"asset\": {\"version\": \"2.0\"}, \"scenes\": [{\"nodes\": [0]}, {\"nodes\": [1]}], \"nodes\": [%s],\n"
    "\"meshes\": [{\"primitives\": [{\"attributes\": {\"POSITION\": 0}, \"indices\": 1}]},\n"
    "{\"primitives\": [{\"attributes\": {\"POSITION\": 0}, \"indices\": 2}]}],\n"
    "\"accessors\": [{\"bufferView\": 0, \"componentType\": 5126, \"type\": \"VEC3\", \"count\": 4},\n"
    "{\"bufferView\": 1, \"componentType\": 5123, \"type\": \"SCALAR\", \"count\": 6},\n"
    "{\"bufferView\": 2, \"componentType\": 5123, \"type\": \"SCALAR\", \"count\": 6}],\n"
    "\"bufferViews\": [{\"buffer\": 0, \"byteOffset\": 0, \"byteLength\": 48},\n"
    "{\"buffer\": 0, \"byteOffset\": 48, \"byteLength\": 12}, {\"buffer\": 0, \"byteOffset\": 60, \"byteLength\": "
    "12}],\n"
    "%s\"buffers\": [{\"byteLength\": 72, \"uri\": \"%s\"}]}\n";

static void write_model(const char *path, const char *nodes, const char *more, const char *uri) {
    char text[sizeof model + 512];
    assert_true((size_t)snprintf(text, sizeof text, model, nodes, more, uri) < sizeof text);
    write_text(path, text);
}

/* Writes those numbers, with a right last corner or with one that is not there. */
static void write_numbers(const char *path, unsigned short last) {
    static const float corners[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
    const unsigned short indices[12] = {0, 1, 2, 1, 3, 2, 0, 1, 2, 1, last, 2};
    char bytes[sizeof corners + sizeof indices];
    memcpy(bytes, corners, sizeof corners);
    memcpy(bytes + sizeof corners, indices, sizeof indices);
    write_bytes(path, bytes, sizeof bytes);
}

static void expect_objects(const char *path, size_t count) {
    froe_scene *scene = read_scene(path, NULL);
    assert_int_equal(froe_scene_object_count(scene), count);
    froe_scene_free(scene);
}

/* Mesh 0 is right. Mesh 1 matters wherever assimp reads it, and nowhere else. */
static void meshes_that_nothing_shows_do_not_hide_wrong_indices(void **state) {
    (void)state;
    static const struct {
        const char *nodes, *more;
        size_t objects; /* 0: refused */
    } files[] = {
        {"{\"mesh\": 0}", "", 2},
        {"{\"mesh\": 1}", "", 0},
        {"{\"mesh\": 0}, {\"mesh\": 1}", "", 2},
        {"{\"mesh\": 1}, {\"mesh\": 0}", "", 0},
        {"{\"mesh\": 0}, {\"mesh\": 1}", "\"scene\": 0, ", 2},
        {"{\"mesh\": 0}, {\"mesh\": 1}", "\"scene\": 1, ", 0},
        {"{\"mesh\": 1}, {\"mesh\": 0}", "\"scene\": 1, ", 2},
        {"{\"mesh\": 0, \"children\": [1, 2]}, {\"children\": [3]}, {}, {\"mesh\": 1}", "", 0},
        {"{\"mesh\": 0, \"children\": [1, 2]}, {\"children\": [3]}, {}, {\"mesh\": 0}, {\"mesh\": 1}", "", 4},
        {"{\"mesh\": 0}, {\"mesh\": 1}", "\"skins\": [{\"joints\": [0, 1]}], ", 0},
        {"{\"mesh\": 0}, {\"mesh\": 1}", "\"skins\": [{\"joints\": [0]}], ", 2},
        {"{\"mesh\": 0}, {\"mesh\": 1}", "\"animations\": [{\"channels\": [{\"target\": {\"node\": 1}}]}], ", 0},
        {"{\"mesh\": 0}, {\"mesh\": 1}", "\"animations\": [{\"channels\": [{\"target\": {\"node\": 0}}]}], ", 2},
        {"{\"mesh\": 0}, {\"mesh\": 1}", "\"animations\": [{\"channels\": [{\"target\": {\"path\": \"scale\"}}]}], ",
         2},
    };
    write_numbers("numbers.bin", 4);
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        write_model("parts.gltf", files[i].nodes, files[i].more, "numbers.bin");
        if (files[i].objects)
            expect_objects("parts.gltf", files[i].objects);
        else
            refuse("parts.gltf", FROE_E_FORMAT, "points, edges or triangles 1 name vertices that do not exist.");
    }
}

/* It would be more than assimp counts. */
static void counts_have_32_bits(void **state) {
    (void)state;
    write_text("count.gltf",
               "{\"asset\": {\"version\": \"2.0\"}, \"scenes\": [{\"nodes\": [0]}], \"nodes\": [{\"mesh\": 0}],\n"
               "\"meshes\": [{\"primitives\": [{\"attributes\": {\"POSITION\": 0}}]}],\n"
               "\"accessors\": [{\"componentType\": 5126, \"type\": \"VEC3\", \"count\": 4294967296}]}\n");
    refuse("count.gltf", FROE_E_FORMAT, "The reader assimp reports '");
}

/* A name is first taken without its escapes, and then as it is written. */
static void escaped_names_of_buffers_are_found(void **state) {
    (void)state;
    static const struct {
        const char *file, *uri;
    } names[] = {
        {"parts of it/has space.bin", "has%20space.bin"},
        {"parts of it/bl%C3%BCte.bin", "bl%C3%BCte.bin"},
        {"parts of it/blute\xcc\x88.bin", "blute%cc%88.bin"},
        {"parts of it/below/n.bin", "below%2Fn.bin"},
        {"parts of it/100%.bin", "100%.bin"},
        {"parts of it/100%a.bin", "100%a.bin"},
        {"parts of it/100%g0.bin", "100%g0.bin"},
        {"parts of it/100%@0.bin", "100%@0.bin"},
        {"parts of it/100%G0.bin", "100%G0.bin"},
        {"parts of it/100%:0.bin", "100%:0.bin"},
        {"parts of it/100%25.bin", "100%2525.bin"},
        {"parts of it/no%00.bin", "no%00.bin"},
    };
    (void)mkdir("parts of it", 0777);
    (void)mkdir("parts of it/below", 0777);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        write_numbers(names[i].file, 3);
        write_model("parts of it/m.gltf", "{\"mesh\": 1}", "", names[i].uri);
        froe_scene *scene = read_scene("parts of it/m.gltf", NULL);
        if (froe_scene_object_count(scene) != 2) fail_msg("%s", names[i].uri);
        froe_scene_free(scene);
    }
    /* both are there: the name without escapes counts. That of the folder is taken as it is. */
    (void)mkdir("of%20it", 0777);
    write_numbers("of%20it/two names.bin", 3);
    write_numbers("of%20it/two%20names.bin", 4);
    write_model("of%20it/two%20names.gltf", "{\"mesh\": 1}", "", "two%20names.bin");
    expect_objects("of%20it/two%20names.gltf", 2);
    write_model("of%20it/two%20names.gltf", "{\"mesh\": 1}", "", "other%20names.bin");
    refuse("of%20it/two%20names.gltf", FROE_E_FORMAT, "could not open referenced file \"other%20names.bin\"");
}

static void memory_may_end_in_gltf(void **state) {
    (void)state;
    write_numbers("its numbers.bin", 3);
    write_model("memory.gltf", "{\"mesh\": 0, \"children\": [1, 2, 3]}, {\"mesh\": 1}, {\"mesh\": 0}, {\"mesh\": 1}",
                "\"skins\": [{\"joints\": [1]}], ", "its%20numbers.bin");
    test_memory_each(read_with_memory, "memory.gltf");
}

/* -------------------------------------------------------------------- TopoJSON -- */

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

static void what_gdal_leaves_out_of_topojson_is_told(void **state) {
    (void)state;
    static const struct {
        const char *geometry, *left;
        unsigned without;
    } cases[] = {
        {"{\"type\": \"GeometryCollection\", \"geometries\": [{\"type\": \"LineString\", \"arcs\": [1]}]}",
         "GeometryCollection", 0},
        {"{\"type\": \"GeometryCollection\", \"geometries\": []}", "", 1},
        {"{\"type\": null, \"properties\": {\"name\": \"nowhere\"}}", "", 1},
        {"{\"type\": \"Polygon\"}", "", 1},
        {"{\"type\": \"Point\", \"coordinates\": [1, 2]}", "", 0},
        {"{\"type\": \"Polygon\", \"arcs\": [[1]]}", "", 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[600];
        froe_read_report report;
        snprintf(
            text, sizeof text,
            "{\"type\": \"Topology\", \"objects\": {\"a\": {\"type\": \"GeometryCollection\", \"geometries\": [%s, "
            "{\"type\": \"LineString\", \"arcs\": [0]}]}, \"b\": {\"type\": \"GeometryCollection\", \"geometries\": "
            "[{\"type\": null}]}},\n\"arcs\": [[[0, 0], [1, 2]], [[5, 0], [9, 0], [5, 0]]]}",
            cases[i].geometry);
        write_text("left.json", text);
        froe_scene_free(read_scene("left.json", &report));
        assert_string_equal(report.sorts_left, cases[i].left);
        assert_int_equal(report.no_geometry, cases[i].without);
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

static void memory_may_end_in_topojson(void **state) {
    (void)state;
    write_topology("t.json", "{\"type\": \"Polygon\", \"arcs\": [[1]]}");
    test_memory_each(read_with_memory, "t.json");
}

/* ------------------------------------------------------------------------- OSM -- */

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

/* --------------------------------------------------------------------- MapInfo -- */

static const char mif[] = "Version 300\nCharset \"Neutral\"\nDelimiter \",\"\nColumns 1\n  id Integer\nData\n\n"
                          "Pline 3\n1 1\n2 -2.5\n3 +3\n    Pen (1,2,0)\n"
                          "PLINE Multiple 2\n  2\n1 1\n2 2\n  2\n3 3\n4 4\n"
                          "Region 1\n  4\n0 0\n4 0\n4 4\n0 0\n    Brush (1,0)\n"
                          "Multipoint 2\n.5 9\n9 8\n"
                          "Arc 0 0 2 2\n0 90\n"
                          "Point 9 9\n";

static void write_mif(const char *word, const char *other, const char *rows) {
    char text[sizeof mif + 64];
    const char *at = strstr(mif, word);
    assert_non_null(at);
    snprintf(text, sizeof text, "%.*s%s%s", (int)(at - mif), mif, other, at + strlen(word));
    write_text("m.mif", text);
    write_text("m.mid", rows);
}

static void points_of_mapinfo_fit_their_counts(void **state) {
    (void)state;
    static const char six[] = "1\n2\n3\n4\n5\n6\n";
    static const struct {
        const char *word, *other;
        int line; /* 0: it is read */
        const char *sentence;
    } changes[] = {
        {"Pline 3", "Pline 4", 12, "A point is missing, or it is not two numbers."},
        {"2 -2.5", "2 x", 10, "A point is missing, or it is not two numbers."},
        {"2 -2.5", "2 2x", 10, "A point is missing, or it is not two numbers."},
        {"2 -2.5", "x -2.5", 10, "A point is missing, or it is not two numbers."},
        {"2 -2.5", "2 -2,5", 10, "A point is missing, or it is not two numbers."},
        {"2 -2.5", "2 ,5", 10, "A point is missing, or it is not two numbers."},
        {"Pline 3", "Pline 2", 11, "There are more points than were counted."},
        {"Multiple 2", "Multiple 3", 20, "A count of points is missing."},
        {"Multiple 2", "Multiple 1", 17, "There are more points than were counted."},
        {"9 8\nArc 0 0 2 2\n0 90\nPoint 9 9\n", "", 28, "The file ends before all is there that was counted."},
        {"Multipoint 2\n.5 9\n9 8\nArc 0 0 2 2\n0 90\nPoint 9 9\n", "Region 2\n1\n1 1\n", 29,
         "The file ends before all is there that was counted."},
        {"Arc 0 0 2 2\n0 90\nPoint 9 9\n", "  ", 0, NULL},
        {"Arc 0 0 2 2", "Arc 0 0 2,5 2", 30, "A coordinate is not a number with a decimal point."},
        {"Arc 0 0 2 2\n0 90", "Arc 0 0 2 2\n0,5 90", 31, "A coordinate is not a number with a decimal point."},
        {"Point 9 9", "Point 9,5 9", 32, "A coordinate is not a number with a decimal point."},
        {"2 -2.5", "2", 10, "A point is missing, or it is not two numbers."},
        {"Point 9 9", "point x 9", 32, "A coordinate is not a number with a decimal point."},
        {"Arc 0 0 2 2\n0 90", "Line 0 0 1,5 1", 30, "A coordinate is not a number with a decimal point."},
        {"Point 9 9", "Point 9, 9\n    Symbol (35,0,12)", 0, NULL},
        {"Pline 3", "Pline 3 ", 0, NULL},
        {"Pline 3", "Pline\n3", 0, NULL},
        {"Brush", "Regional", 0, NULL},
        {"Pline 3", "pline 3", 0, NULL},
        {"Multiple 2\n  2", "Multiple 2 2", 0, NULL},
        {"4 0", "4, 0", 0, NULL},
        {"Point 9 9\n", "Point 9 9\n  \n", 0, NULL},
    };
    for (size_t i = 0; i < sizeof changes / sizeof *changes; i++) {
        char sentence[120];
        snprintf(sentence, sizeof sentence, "m.mif: line %d: %s", changes[i].line, changes[i].sentence);
        const size_t rows = i >= 9 && i <= 11 ? 4 : 6;
        char table[16];
        snprintf(table, sizeof table, "%.*s", (int)(2 * rows), six);
        write_mif(changes[i].word, changes[i].other, table);
        if (changes[i].line)
            refuse("m.mif", FROE_E_FORMAT, sentence);
        else
            froe_scene_free(read_scene("m.mif", NULL));
    }
    write_mif("Data", "Data", six);
    test_memory_each(read_with_memory, "m.mif");
    froe_scene_free(read_scene("/vsisubfile/0_10000,m.mif", NULL));
}

static void columns_of_mapinfo_have_any_names(void **state) {
    (void)state;
    write_text("m.mif", "Version 300\nDelimiter \",\"\nColumns 2\n  data Integer\n  name Integer\nData\nPoint 1 1\n");
    write_text("m.mid", "1,2\n");
    expect_objects("m.mif", 1);
}

static void tables_of_mapinfo_have_a_row_for_each_object(void **state) {
    (void)state;
    write_mif("Data", "Data", "1\n2\n3\n4\n5\n6\n  \n");
    froe_scene_free(read_scene("m.mif", NULL));
    write_mif("Data", "Data", "1\n2\n3\n4\n5\n6\n7");
    refuse("m.mif", FROE_E_FORMAT, "m.mif: The table 'm.mid' has 7 rows, and there are 6 objects.");
    write_text("m.mif", "Version 300\nColumns 1\n  id Integer\nData\nPoint 1 1\n");
    refuse("m.mif", FROE_E_FORMAT, "m.mif: The table 'm.mid' has 7 rows, and there is 1 object.");
}

/* ------------------------------------------------------------- stored archives -- */

static const char relations[] = "<Relationships xmlns=\"r\"><Relationship Target=\"/m\" Id=\"a\" "
                                "Type=\"http://x/3dmodel\"/></Relationships>";
static const char mesh[] = "<model xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\"><resources>"
                           "<object id=\"1\"><mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/>"
                           "<vertex x=\"1\" y=\"0\" z=\"0\"/><vertex x=\"0\" y=\"1\" z=\"0\"/></vertices>"
                           "<triangles><triangle v1=\"0\" v2=\"1\" v3=\"2\"/></triangles></mesh></object></resources>"
                           "<build><item objectid=\"1\"/></build></model>";

static size_t crc_of(const char *bytes, size_t count) {
    size_t sum = UINT32_MAX;
    for (size_t i = 0; i < count; i++) {
        sum ^= (unsigned char)bytes[i];
        for (int bit = 0; bit < 8; bit++) sum = sum >> 1 ^ (sum & 1 ? 0xedb88320 : 0);
    }
    return sum ^ UINT32_MAX;
}

static void put(char **to, size_t value, int bytes) {
    for (; bytes; bytes--, value >>= 8) *(*to)++ = (char)value;
}

typedef struct archive {
    char bytes[1 << 21], directory[512];
    char *end, *entry; /* of both so far */
    size_t count;
} archive;

static void begin_archive(archive *a) {
    a->count = 0;
    a->end = a->bytes, a->entry = a->directory;
}

/* Stores a file, without compression. */
static void store(archive *a, const char *name, const char *text, size_t size) {
    const size_t at = (size_t)(a->end - a->bytes), length = strlen(name), sum = crc_of(text, size);
    put(&a->end, 0x04034b50, 4), put(&a->end, 10, 2), put(&a->end, 0, 8), put(&a->end, sum, 4);
    put(&a->end, size, 4), put(&a->end, size, 4), put(&a->end, length, 2), put(&a->end, 0, 2);
    memcpy(a->end, name, length), a->end += length;
    memcpy(a->end, text, size), a->end += size;
    put(&a->entry, 0x02014b50, 4), put(&a->entry, 10, 2), put(&a->entry, 10, 2), put(&a->entry, 0, 8);
    put(&a->entry, sum, 4), put(&a->entry, size, 4), put(&a->entry, size, 4), put(&a->entry, length, 2);
    put(&a->entry, 0, 12), put(&a->entry, at, 4);
    memcpy(a->entry, name, length), a->entry += length;
    a->count++;
}

static void write_archive(archive *a, const char *path) {
    const size_t at = (size_t)(a->end - a->bytes), size = (size_t)(a->entry - a->directory);
    memcpy(a->end, a->directory, size), a->end += size;
    put(&a->end, 0x06054b50, 4), put(&a->end, 0, 4), put(&a->end, a->count, 2), put(&a->end, a->count, 2);
    put(&a->end, size, 4), put(&a->end, at, 4), put(&a->end, 0, 2);
    write_bytes(path, a->bytes, (size_t)(a->end - a->bytes));
}

static void store_model(archive *a) {
    begin_archive(a);
    store(a, "_rels/.rels", relations, sizeof relations - 1);
    store(a, "m", mesh, sizeof mesh - 1);
}

static void stored_files_have_their_checksums(void **state) {
    (void)state;
    static archive a;
    static const char table[] = "x,y\n1,2\n", long_name[] =
                                                  "a-name-of-more-than-eighty-letters-that-says-nothing-of-what-"
                                                  "is-in-the-file-but-that-it-is-a-table.csv";
    store_model(&a);
    write_archive(&a, "stored.3mf");
    expect_objects("stored.3mf", 1);
    store_model(&a);
    a.end[strstr(mesh, "\"1\" y=") + 1 - mesh - (ptrdiff_t)(sizeof mesh - 1)] = '7';
    write_archive(&a, "stored.3mf");
    refuse("stored.3mf", FROE_E_FORMAT, "stored.3mf: 'm' is damaged in the archive.");
    for (int good = 0; good < 2; good++) {
        begin_archive(&a);
        store(&a, long_name, table, sizeof table - 1);
        if (!good) a.end[-2] = '3';
        write_archive(&a, "stored.zip");
        if (good)
            expect_objects("stored.zip", 1);
        else
            refuse("stored.zip", FROE_E_FORMAT, "is-in-the-file-but-' is damaged in the archive.");
    }
}

static bool cancel(void *user, double done) {
    (void)user, (void)done;
    return false;
}

/* It is looked at in pieces. */
static void large_files_may_be_stored(void **state) {
    (void)state;
    enum { ROWS = 1 << 18 };
    static archive a;
    static char table[4 + 5 * ROWS];
    memcpy(table, "x,y\n", 4);
    for (int i = 0; i < ROWS; i++) memcpy(table + 4 + 5 * i, "1,23\n", 5);
    for (int good = 0; good < 2; good++) {
        begin_archive(&a);
        store(&a, "t.csv", table, sizeof table);
        if (!good) a.end[-2] = '4';
        write_archive(&a, "large.zip");
        if (good)
            expect_objects("large.zip", ROWS);
        else
            refuse("large.zip", FROE_E_FORMAT, "large.zip: 't.csv' is damaged in the archive.");
    }
    froe_read_options o = froe_read_defaults();
    froe_scene *scene = NULL;
    o.progress = cancel;
    assert_int_equal(froe_read("large.zip", &o, &scene, NULL, NULL), FROE_E_CANCELLED);
}

/* There is a scene, or a sentence. */
static void read_any(const char *path) {
    froe_scene *scene = NULL;
    froe_diagnostic why = {.message = ""};
    const froe_status status = froe_read(path, NULL, &scene, NULL, &why);
    if (!status == !scene || (status && !*why.message)) fail_msg("%s: status %d: %s", path, status, why.message);
    if (status) assert_null(strstr(why.message, "is damaged in the archive"));
    froe_scene_free(scene);
}

/* What the check does not know is left to the readers. */
static void archives_of_other_kinds_are_left_to_their_readers(void **state) {
    (void)state;
    static archive a;
    static const struct {
        size_t place; /* in the first entry of the directory */
        unsigned char bytes[4];
    } changes[] = {{0, "QK\1\2"},        {8, {1, 0, 8, 0}}, {8, {1}},          {10, {8}}, {20, "\xff\xff\xff\xff"},
                   {28, {127, 1, 0, 0}}, {42, {1}},         {42, {0, 0, 1, 0}}};
    for (size_t i = 0; i < sizeof changes / sizeof *changes; i++) {
        store_model(&a);
        memcpy(a.directory + changes[i].place, changes[i].bytes, 4);
        write_archive(&a, "other.3mf");
        read_any("other.3mf");
    }
    write_text("other.3mf", "PK\3\4");
    read_any("other.3mf");
    write_text("other.3mf", "PK\3\4 and no directory behind it");
    read_any("other.3mf");
    write_text("other.zae", "PK\3\4 and no directory behind it");
    read_any("other.zae");
}

#define COLLADA(kind)                                                                                                  \
    "<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\"><asset/><library_geometries>"   \
    "<geometry id=\"g\"><mesh><source id=\"p\"><float_array id=\"a\" count=\"12\">0 0 0 4 0 0 4 4 0 0 4 "              \
    "0</float_array>"                                                                                                  \
    "<technique_common><accessor source=\"#a\" count=\"4\" stride=\"3\"><param name=\"X\" type=\"float\"/>"            \
    "<param name=\"Y\" type=\"float\"/><param name=\"Z\" type=\"float\"/></accessor></technique_common></source>"      \
    "<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/></vertices><" kind " count=\"1\">"                 \
    "<input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>0 1 2</p></" kind "></mesh></geometry>"                 \
    "</library_geometries>\n<library_visual_scenes><visual_scene id=\"s\"><node><instance_geometry url=\"#g\"/>"       \
    "</node></visual_scene></library_visual_scenes><scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>"

static void collada_in_archives_is_looked_through(void **state) {
    (void)state;
    enum { ENTRY = 46, NOTES = 9, PLACE = 42 }; /* of an entry, a name, and of what tells where the file begins */
    static const char *const texts[] = {COLLADA("triangles"), COLLADA("trifans")};
    static archive a;
    for (int fan = 0; fan < 2; fan++) {
        begin_archive(&a);
        store(&a, "notes.txt", "notes", 5);
        store(&a, "models/a.dae", texts[fan], strlen(texts[fan]));
        write_archive(&a, "models.zae");
        if (!fan) assert_true(test_memory_each(read_with_memory, "models.zae") > 5);
        if (!fan)
            expect_objects("models.zae", 1);
        else
            refuse("models.zae", FROE_E_UNSUPPORTED, "models.zae: line 1: Fans of triangles (trifans) are not read.");
    }
    begin_archive(&a);
    store(&a, "notes.txt", "notes", 5);
    store(&a, "models/a.dae", texts[0], strlen(texts[0]));
    a.directory[ENTRY + NOTES + PLACE + 2] = 1;
    write_archive(&a, "lost.zae");
    refuse("lost.zae", FROE_E_FORMAT, "lost.zae: ");
    write_text("text.zae", texts[1]); /* assimp reads it */
    refuse("text.zae", FROE_E_UNSUPPORTED, "text.zae: line 1: Fans of triangles (trifans) are not read.");
}

static void memory_may_end_in_archives(void **state) {
    (void)state;
    static archive a;
    store_model(&a);
    write_archive(&a, "memory.3mf");
    test_memory_each(read_with_memory, "memory.3mf");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(meshes_that_nothing_shows_do_not_hide_wrong_indices),
        cmocka_unit_test(counts_have_32_bits),
        cmocka_unit_test(escaped_names_of_buffers_are_found),
        cmocka_unit_test(memory_may_end_in_gltf),
        cmocka_unit_test(arcs_that_do_not_exist_are_refused),
        cmocka_unit_test(arcs_that_exist_are_read),
        cmocka_unit_test(archives_are_looked_into),
        cmocka_unit_test(what_gdal_leaves_out_of_topojson_is_told),
        cmocka_unit_test(memory_may_end_in_topojson),
        cmocka_unit_test(ways_without_all_their_nodes_are_refused),
        cmocka_unit_test(relations_without_all_their_ways_are_told_of),
        cmocka_unit_test(points_of_mapinfo_fit_their_counts),
        cmocka_unit_test(columns_of_mapinfo_have_any_names),
        cmocka_unit_test(tables_of_mapinfo_have_a_row_for_each_object),
        cmocka_unit_test(stored_files_have_their_checksums),
        cmocka_unit_test(large_files_may_be_stored),
        cmocka_unit_test(archives_of_other_kinds_are_left_to_their_readers),
        cmocka_unit_test(collada_in_archives_is_looked_through),
        cmocka_unit_test(memory_may_end_in_archives),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
