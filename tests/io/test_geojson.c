/* GeoJSON by the reader of the core and by GDAL: equal scenes and reports of everything that the core does not leave to
 * GDAL, and no file that only one of them reads. */
#include "formats/input/source.h"
#include "readers.h"
#include "support.h"
#include <dirent.h>

static formats_reader *choose_ogr(const formats_source *source) {
    (void)source;
    return io_read_ogr;
}

static froe_status read_by_gdal(const char *path, const froe_read_options *options, froe_scene **out,
                                froe_read_report *report, froe_diagnostic *why) {
    static const formats_readers gdal = {.choose = choose_ogr, .maps = io_read_ogr, .beyond = true};
    return formats_read(&gdal, path, options, out, report, why);
}

/* ---------------------------------------------------------------- comparison -- */

static bool same_text(const char *a, const char *b) {
    return !strcmp(a, b);
}

static bool same_crs(const froe_scene *a, const froe_scene *b) {
    const froe_crs x = froe_scene_crs(a), y = froe_scene_crs(b);
    return x.kind == y.kind && same_text(x.wkt, y.wkt) && same_text(x.name, y.name) && same_text(x.code, y.code) &&
           same_text(x.unit, y.unit);
}

static bool same_groups(const froe_scene *a, const froe_scene *b) {
    if (froe_scene_group_count(a) != froe_scene_group_count(b)) return false;
    for (uint32_t i = 0; i < froe_scene_group_count(a); i++) {
        const froe_group x = froe_scene_group(a, i), y = froe_scene_group(b, i);
        if (!same_text(x.name, y.name) || !same_text(x.material, y.material) || !same_text(x.left, y.left) ||
            !same_text(x.right, y.right) || x.colour != y.colour)
            return false;
    }
    return true;
}

static bool same_objects(const froe_scene *a, const froe_scene *b) {
    if (froe_scene_object_count(a) != froe_scene_object_count(b)) return false;
    if (froe_scene_vertex_count(a) != froe_scene_vertex_count(b)) return false;
    for (uint32_t i = 0; i < froe_scene_vertex_count(a); i++)
        if (memcmp(froe_scene_vertex(a, i), froe_scene_vertex(b, i), 2 * sizeof(double)) != 0) return false;
    for (uint32_t i = 0; i < froe_scene_object_count(a); i++) {
        const froe_object x = froe_scene_object(a, i), y = froe_scene_object(b, i);
        if (x.kind != y.kind || x.form != y.form || x.corners != y.corners || x.face != y.face || x.group != y.group ||
            x.tag != y.tag)
            return false;
        for (uint32_t c = 0; c < x.corners; c++)
            if (froe_scene_corner(a, i, c) != froe_scene_corner(b, i, c)) return false;
    }
    return true;
}

static bool same_report(const froe_read_report *a, const froe_read_report *b) {
    return same_text(a->format, b->format) && same_text(a->precision, b->precision) && a->layers == b->layers &&
           a->layers_left == b->layers_left && a->features == b->features && a->groups == b->groups &&
           a->linearised == b->linearised && a->flattened == b->flattened && a->closed == b->closed &&
           a->skipped == b->skipped && a->no_geometry == b->no_geometry && a->wrapped == b->wrapped &&
           a->no_degrees == b->no_degrees;
}

/* Reads a file both ways. True: the core reads or refuses it; false: it leaves it to GDAL. */
static bool compare_with(const char *path, const froe_read_options *options) {
    froe_scene *a = NULL, *b = NULL;
    froe_read_report of_a = {.format = ""}, of_b = {.format = ""};
    froe_diagnostic why_a = {.message = ""}, why_b = {.message = ""};
    const froe_status own = froe_read_own(path, options, &a, &of_a, &why_a);
    if (own == FROE_E_UNSUPPORTED) return false;
    const froe_status gdal = read_by_gdal(path, options, &b, &of_b, &why_b);
    if (own != gdal) fail_msg("%s: %s by the core, by GDAL %s", path, froe_status_name(own), why_b.message);
    if (own) {
        assert_string_equal(why_a.message, why_b.message);
        return true;
    }
    if (!same_objects(a, b)) fail_msg("%s: objects differ", path);
    if (!same_groups(a, b)) fail_msg("%s: groups differ", path);
    if (!same_crs(a, b)) fail_msg("%s: coordinate systems differ", path);
    if (!same_report(&of_a, &of_b)) fail_msg("%s: reports differ", path);
    froe_scene_free(a), froe_scene_free(b);
    return true;
}

static bool compare(const char *path) {
    froe_read_options options = froe_read_defaults();
    const bool own = compare_with(path, &options);
    options.boxes = true;
    assert_int_equal(compare_with(path, &options), own);
    options.wrap = true;
    assert_int_equal(compare_with(path, &options), own);
    options.boxes = false;
    assert_int_equal(compare_with(path, &options), own);
    return own;
}

static bool compare_bytes(const void *bytes, size_t size) {
    remove("both.geojson"); /* some file systems wait for the disk where a file becomes another */
    write_bytes("both.geojson", bytes, size);
    return compare("both.geojson");
}

/* --------------------------------------------------------------------- cases -- */

#define FEATURE(members, properties, geometry)                                                                         \
    "{\"type\":\"Feature\"," members "\"properties\":" properties ",\"geometry\":" geometry "}"
#define POINT "{\"type\":\"Point\",\"coordinates\":[1,2]}"
#define SQUARE "{\"type\":\"Polygon\",\"coordinates\":[[[0,0],[4,0],[4,4],[0,4],[0,0]],[[1,1],[1,2],[2,2],[1,1]]]}"
#define ALL(features) "{\"type\":\"FeatureCollection\",\"features\":[" features "]}"
#define SHAPE(geometry) ALL(FEATURE("", "{\"name\":\"a\"}", geometry))
#define SHAPED(type, coordinates) SHAPE("{\"type\":\"" type "\",\"coordinates\":" coordinates "}")
#define TWO(one, of_one, two, of_two) ALL(FEATURE(one, of_one, SQUARE) "," FEATURE(two, of_two, SQUARE))

static const struct {
    bool own; /* is it read, or refused, by the core? */
    const char *text;
} cases[] = {
    /* geometries */
    {true, SHAPE(POINT)},
    {true, SHAPE(SQUARE)},
    {true, SHAPE("null")},
    {true, SHAPED("MultiPoint", "[[1,2],[3,4]]")},
    {true, SHAPED("LineString", "[[1,2],[3,4],[5,6]]")},
    {true, SHAPED("LineString", "[[1,2]]")},
    {true, SHAPED("MultiLineString", "[[[1,2],[3,4]],[[5,6],[7,8],[9,9]]]")},
    {true,
     SHAPED("MultiPolygon", "[[[[0,0],[1,0],[0,1],[0,0]]],[[[5,5],[6,5],[5,6]],[[5.1,5.1],[5.2,5.1],[5.1,5.2]]]]")},
    {true, SHAPED("Polygon", "[[[0,0]]]")},
    {true, SHAPED("Polygon", "[[[0,0],[0,0],[0,0]]]")},
    {true, "{\"type\":\"FeatureCollection\",\"features\":[{\"geometry\":{\"coordinates\":[[1,2],[3,4]],\"type\":"
           "\"LineString\"},\"properties\":{\"name\":\"order\"},\"id\":7,\"type\":\"Feature\"}]}"},
    {true, SHAPE("{\"type\":\"GeometryCollection\",\"geometries\":[" POINT "," SQUARE "]}")},
    {true, SHAPE("{\"type\":\"GeometryCollection\",\"geometries\":[]}")},
    {true, SHAPE("{\"geometries\":[{\"type\":\"GeometryCollection\",\"geometries\":[" POINT "]}," SQUARE "],\"bbox\":"
                 "[0,0,1,1],\"type\":\"GeometryCollection\"}")},
    {false, SHAPED("Point", "[1]")},
    {false, SHAPED("Point", "[]")},
    {false, SHAPED("Point", "[1,2,3]")},
    {false, SHAPED("Point", "[1,2,3,4]")},
    {false, SHAPED("Point", "[1,null]")},
    {false, SHAPED("Point", "[1,\"2\"]")},
    {false, SHAPED("Point", "[[1,2]]")},
    {false, SHAPED("LineString", "[1,2]")},
    {false, SHAPED("LineString", "[]")},
    {false, SHAPED("LineString", "[[1,2],null]")},
    {false, SHAPED("LineString", "[[1,2],[[3,4]]]")},
    {false, SHAPED("Polygon", "[]")},
    {false, SHAPED("Polygon", "[[]]")},
    {false, SHAPED("Polygon", "[[[0,0],[1,0],[0,1],[0,0]],[]]")},
    {false, SHAPED("MultiPolygon", "[[]]")},
    {false, SHAPED("Circle", "[1,2]")},
    {false, SHAPED("point", "[1,2]")},
    {false, SHAPE("{\"type\":\"Point\",\"coordinates\":[1,2],\"coordinates\":[3,4]}")},
    {false, SHAPE("{\"type\":\"Point\",\"Coordinates\":[1,2]}")},
    {false, SHAPE("{\"type\":\"Point\",\"coordinates\":[1,2],\"crs\":null}")},
    {false, SHAPE("{\"coordinates\":[1,2]}")},
    {false, SHAPE("{\"type\":\"GeometryCollection\",\"geometries\":[null]}")},
    {false, SHAPE("[]")},
    {false, ALL("{\"type\":\"Feature\",\"properties\":{}}")},
    {false, ALL("{\"type\":\"Feature\",\"geometry\":" POINT "}")},
    {false, ALL("{\"type\":\"feature\",\"properties\":{},\"geometry\":" POINT "}")},
    {false, ALL("{\"type\":\"Feature\",\"properties\":{},\"Geometry\":null,\"geometry\":" POINT "}")},
    {false, ALL("null")},
    {false, ALL("[]")},
    /* numbers */
    {true, SHAPED("LineString", "[[-0,0],[-0.0,1e2],[1E-2,1.5e+1],[0.1234567890123456789012,-12345678901234567]]")},
    {true, SHAPED("MultiPoint", "[[179.99999999999997,-1e-99],[0.000000000000000000000000000001,3.0]]")},
    {true, SHAPED("Point", "[ 1.00 ,\n\t2\r]")},
    {true, SHAPED("Point", "[500000.1,1e10]")},
    {false, SHAPED("Point", "[1e400,0]")},
    {true, SHAPED("MultiPoint", "[[1e100,0],[1e-100,5e-324],[1e-400,1.7976931348623157e+0308]]")},
    {false, SHAPED("Point", "[12345678901234567890,0]")},
    {false, SHAPED("Point", "[+1,0]")},
    {false, SHAPED("Point", "[.5,0]")},
    {false, SHAPED("Point", "[5.,0]")},
    {false, SHAPED("Point", "[05,0]")},
    {false, SHAPED("Point", "[-,0]")},
    {false, SHAPED("Point", "[0x10,0]")},
    {false, SHAPED("Point", "[NaN,0]")},
    {false, SHAPED("Point", "[Infinity,0]")},
    {false, SHAPED("Point", "[1 2]")},
    {false, SHAPED("Point", "[1,2,]")},
    /* numbers of features */
    {true, TWO("\"id\":7,", "{}", "\"id\":7,", "{}")},
    {true, TWO("\"id\":123456789012,", "{\"id\":3}", "", "{\"id\":\"x\"}")},
    {true, TWO("", "{}", "\"id\":5,", "{}")},
    {true, TWO("\"id\":null,", "{\"name\":null}", "\"id\":5,", "{}")},
    {true, TWO("", "{\"id\":9}", "", "{\"id\":null}")},
    {true, TWO("", "{\"id\":\"nine\"}", "", "{}")},
    {true, TWO("", "{\"ID\":9}", "", "{\"ID\":\"ten\"}")},
    {true, TWO("\"id\":\"one\",", "{}", "", "{\"name\":\"two\"}")},
    {true, TWO("\"id\":\"2020-01-01\",", "{}", "\"id\":\"\",", "{}")},
    {false, TWO("", "{\"id\":9}", "", "{\"id\":\"ten\"}")},
    {false, TWO("", "{\"id\":9}", "\"id\":1,", "{}")},
    {false, TWO("\"id\":1,", "{}", "\"id\":\"one\",", "{}")},
    {false, TWO("\"id\":\"one\",", "{\"id\":2}", "", "{}")},
    {false, TWO("\"id\":\"one\",", "{\"ID\":2}", "", "{}")},
    {false, TWO("\"id\":-1,", "{}", "", "{}")},
    {false, TWO("\"id\":1.0,", "{}", "", "{}")},
    {false, TWO("\"id\":true,", "{}", "", "{}")},
    {false, TWO("\"id\":[1],", "{}", "", "{}")},
    {false, TWO("\"ID\":1,", "{}", "", "{}")},
    {false, TWO("\"id\":1,\"id\":2,", "{}", "", "{}")},
    {false, TWO("\"id\":12345678901234567890,", "{}", "", "{}")},
    {false, TWO("\"id\":12345678901234567890123.5,", "{}", "", "{}")},
    {false, TWO("", "{\"id\":-5}", "", "{}")},
    {false, TWO("", "{\"id\":true}", "", "{}")},
    {false, TWO("\"id\":1,", "null", "", "{}")},
    /* names */
    {true, TWO("", "{\"NAME\":\"a\",\"label\":\"b\"}", "", "{\"title\":\"c\",\"NAME\":null}")},
    {true, TWO("", "{\"label\":\"b\"}", "", "{\"label\":12,\"Layer\":\"roads\"}")},
    {true, TWO("", "{\"name\":12}", "", "{\"name\":-12345678901}")},
    {true, TWO("", "{\"name\":\"\",\"id\":4}", "", "{\"layer\":17}")},
    {true, TWO("", "{\"name\":\"tab\\t, \\\"q\\\" \\u00fc\\ud83d\\ude00 \\/\"}", "", "{\"nam\":1}")},
    {true, TWO("", "{\"name\":\"2020-01-01\"}", "", "{\"name\":\"May\"}")},
    {true, TWO("", "{\"name\":\"1st\",\"other\":{\"name\":[1,{\"a\":null}],\"x\":[]}}", "", "{\"name\":\"\\\\\"}")},
    {true, TWO("", "{\"name\":\"\xff\xc3(\"}", "", "{\"name\":\"\x7f\"}")},
    {false, TWO("", "{\"name\":\"\x01\"}", "", "{}")},
    {true, TWO("", "{\"x\":true,\"y\":false,\"z\":-1.5e3,\"name\":\"n\",\"e\":\"\"}", "", "{}")},
    {false, TWO("", "{\"name\":\"2020-01-01\"}", "", "{\"name\":\"12:30\"}")},
    {false, TWO("", "{\"name\":\" 2020/01/01\"}", "", "{}")},
    {false, TWO("", "{\"title\":\"a\"}", "", "{\"name\":\"b\"}")},
    {false, TWO("", "{\"name\":\"a\",\"NAME\":\"b\"}", "", "{}")},
    {false, TWO("", "{\"name\":\"a\"}", "", "{\"Name\":\"b\"}")},
    {false, TWO("", "{\"name\":\"a\",\"name\":\"b\"}", "", "{}")},
    {false, TWO("", "{\"name\":1.5}", "", "{}")},
    {false, TWO("", "{\"name\":true}", "", "{}")},
    {false, TWO("", "{\"name\":[1]}", "", "{}")},
    {false, TWO("", "{\"name\":{}}", "", "{}")},
    {false, TWO("", "{\"\":7}", "", "{}")},
    {false, TWO("", "{\"name\":-0}", "", "{}")},
    {false, TWO("", "{\"name\":\"\\u0000\"}", "", "{}")},
    {false, TWO("", "{\"name\":\"\\ud800\"}", "", "{}")},
    {false, TWO("", "{\"name\":\"\\x\"}", "", "{}")},
    {false, TWO("", "{\"other\":\"\\u12g4\"}", "", "{}")},
    {false, TWO("", "{\"_id\":1,\"_rev\":2,\"type\":\"Feature\",\"properties\":{\"name\":\"b\"}}", "", "{}")},
    {false, TWO("", "[]", "", "{}")},
    {false, TWO("", "{\"a\":1,}", "", "{}")},
    {false, TWO("", "{\"a\" 1}", "", "{}")},
    {true, TWO("", "null", "", "{\"name\":\"a\"}")},
    {false, TWO("\"name\":\"b\",", "null", "", "{\"name\":\"a\"}")},
    /* collections */
    {true, ALL("")},
    {true, "{\"type\":\"FeatureCollection\",\"properties\":{\"kind\":\"state\"},\"features\":[" FEATURE("", "{}",
                                                                                                        SQUARE) "]}"},
    {true, "\xef\xbb\xbf \n" SHAPE(SQUARE) "\n\t "},
    {true, "{\"type\":\"FeatureCollection\",\"name\":\"the layer\",\"crs\":null,\"features\":[" FEATURE(
               "\"bbox\":[0,0,1,1],", "{}", SQUARE) "],\"bbox\":[0,0,4,4]}"},
    {true, "{ \"type\" : \"FeatureCollection\" , \"crs\" : { \"type\" : \"name\" , \"properties\" : { \"name\" : "
           "\"urn:ogc:def:crs:OGC:1.3:CRS84\" } } , \"features\" : [ " FEATURE("", "{}", SQUARE) " ] }"},
    {true, "{\"type\":\"FeatureCollection\",\"features\":[" FEATURE(
               "", "{}", SQUARE) "],\"totalFeatures\":1,\"crs\":"
                                 "{\"type\":\"name\",\"properties\":{\"name\":\"urn:ogc:def:crs:OGC:1.3:CRS84\"}}}"},
    {false, "{\"type\":\"FeatureCollection\",\"crs\":{\"type\":\"name\",\"properties\":{\"name\":\"urn:ogc:def:crs:"
            "EPSG::32632\"}},\"features\":[" FEATURE("", "{}", SQUARE) "]}"},
    {false, "{\"type\":\"FeatureCollection\",\"features\":[" FEATURE("", "{\"crs\":null}", SQUARE) "]}"},
    {false, "{\"type\":\"FeatureCollection\",\"features\":[" FEATURE("", "{}", SQUARE) "],\"name\":\"late\"}"},
    {false, "{\"type\":\"FeatureCollection\",\"name\":5,\"features\":[" FEATURE("", "{}", SQUARE) "]}"},
    {false, "{\"type\":\"FeatureCollection\",\"features\":[" FEATURE("", "{}", SQUARE) "],\"features\":[]}"},
    {false, "{\"type\":\"FeatureCollection\",\"features\":[" FEATURE("", "{\"type\":\"Topology\"}", SQUARE) "]}"},
    {false, "{\"type\":\"FeatureCollection\",\"x\":{\"features\":[]},\"features\":[" FEATURE("", "{}", SQUARE) "]}"},
    {false, "{\"type\":\"FeatureCollection\",\"Features\":[],\"features\":[" FEATURE("", "{}", SQUARE) "]}"},
    {false, "{\"type\":\"FeatureCollection\",\"features\":{}}"},
    {false, "{\"type\":\"FeatureCollection\"}"},
    {false, "{\"features\":[],\"type\":\"FeatureCollection\"}"},
    {false, SHAPE(SQUARE) "x"},
    {false, SHAPE(SQUARE) SHAPE(SQUARE)},
    {false, SHAPE(SQUARE) "\n" SHAPE(SQUARE)},
    {false, FEATURE("", "{}", SQUARE)},
    {false, SQUARE},
    {false, "{\"type\":\"Topology\",\"objects\":{},\"arcs\":[]}"},
    {false, "loadGeoJSON(" SHAPE(SQUARE) ")"},
};

static void each_case_is_read_alike_or_left_to_gdal(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        if (compare_bytes(cases[i].text, strlen(cases[i].text)) != cases[i].own)
            fail_msg("case %zu, %s: %s", i, cases[i].own ? "not read by the core" : "not left to GDAL", cases[i].text);
}

static void maps_of_the_project_are_read_alike(void **state) {
    (void)state;
    size_t own = 0;
    DIR *folder = opendir(FROE_TEST_DATA);
    assert_non_null(folder);
    for (struct dirent *entry; (entry = readdir(folder));) {
        const char *dot = strrchr(entry->d_name, '.');
        char path[512];
        snprintf(path, sizeof path, "%s/%s", FROE_TEST_DATA, entry->d_name);
        if (dot && (!strcmp(dot, ".geojson") || !strcmp(dot, ".json"))) own += compare(path);
    }
    closedir(folder);
    assert_int_equal(own, 2); /* the other two are TopoJSON */
}

/* ------------------------------------------------------------------ made up -- */

/* A text that grows, and random choices. */
typedef struct maker {
    char text[1 << 16];
    size_t length;
    uint64_t random;
    bool loose;      /* blanks between words */
    unsigned oddity; /* one choice in so many is odd; 0: none */
    int ids, names;  /* which kinds all features have */
    bool degrees;
} maker;

static unsigned choose(maker *m, unsigned count) {
    m->random += UINT64_C(0x9e3779b97f4a7c15);
    uint64_t z = m->random;
    z = (z ^ z >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ z >> 27) * UINT64_C(0x94d049bb133111eb);
    return (unsigned)((z ^ z >> 31) >> 11) % count;
}

static bool is_odd(maker *m) {
    return m->oddity && !choose(m, m->oddity);
}

static void put(maker *m, const char *text) {
    static const char *const blanks[] = {" ", "\n", "\t", "\r\n  "};
    const int length = snprintf(m->text + m->length, sizeof m->text - m->length, "%s%s", text,
                                m->loose && !choose(m, 3) ? blanks[choose(m, 4)] : "");
    assert_true(length >= 0 && (size_t)length < sizeof m->text - m->length);
    m->length += (size_t)length;
}

static void put_one(maker *m, const char *const *texts, size_t count) {
    put(m, texts[choose(m, (unsigned)count)]);
}
#define PUT_ONE(m, ...)                                                                                                \
    put_one(m, (const char *const[]){__VA_ARGS__}, sizeof(const char *[]){__VA_ARGS__} / sizeof(char *))

static void put_number(maker *m) {
    char number[64];
    const double most = m->degrees ? 180 : 1e6, value = ((double)choose(m, 1u << 30) / (1u << 29) - 1) * most;
    static const char *const forms[] = {"%.0f", "%.1f", "%.6f", "%.17g", "%.9e", "%.20g", "%.3E"};
    if (is_odd(m)) {
        PUT_ONE(m, "null", "1e500", "-", "01", "\"1\"", "123456789012345678901", "[]", "1e-200", "+1", "NaN", ".1");
        return;
    }
    snprintf(number, sizeof number, forms[choose(m, 7)], m->degrees && choose(m, 2) ? value / 2 : value);
    put(m, number);
}

static void put_position(maker *m) {
    put(m, "[");
    put_number(m);
    put(m, ",");
    put_number(m);
    if (is_odd(m)) put(m, ",7.5");
    put(m, "]");
}

/* Positions, of which the last may repeat the first. */
static void put_positions(maker *m, unsigned most) {
    put(m, "[");
    const size_t first = m->length;
    put_position(m);
    const size_t end = m->length;
    for (unsigned i = choose(m, most); i--;) put(m, ","), put_position(m);
    if (choose(m, 2)) {
        char again[256];
        snprintf(again, sizeof again, ",%.*s", (int)(end - first), m->text + first);
        put(m, again);
    }
    put(m, "]");
}

static void put_rings(maker *m) {
    put(m, "[");
    for (unsigned i = choose(m, 3) + 1; i--;) put_positions(m, 6), put(m, i ? "," : "]");
}

static void put_geometry(maker *m, int depth) {
    static const char *const names[] = {"Point",   "MultiPoint",   "LineString",        "MultiLineString",
                                        "Polygon", "MultiPolygon", "GeometryCollection"};
    const unsigned type = choose(m, depth < 4 ? 7 : 6);
    const bool last = choose(m, 4) == 0; /* the type is the last member */
    char name[64];
    snprintf(name, sizeof name, "\"type\":\"%s\"", names[is_odd(m) ? choose(m, 7) : type]);
    put(m, "{");
    if (!last) put(m, name), put(m, ",");
    put(m, type == 6 ? "\"geometries\":" : "\"coordinates\":");
    if (is_odd(m))
        PUT_ONE(m, "[]", "null", "[null]", "[[]]", "{}", "5");
    else if (type == 0)
        put_position(m);
    else if (type < 3)
        put_positions(m, 8);
    else if (type < 5)
        put_rings(m);
    else {
        put(m, "[");
        unsigned i = type == 5 ? choose(m, 3) + 1 : choose(m, 4);
        while (i--) {
            if (type == 5)
                put_rings(m);
            else
                put_geometry(m, depth + 1);
            if (i) put(m, ",");
        }
        put(m, "]");
    }
    if (last) put(m, ","), put(m, name);
    if (is_odd(m)) PUT_ONE(m, ",\"bbox\":[0,0,1,1]", ",\"crs\":null", ",\"coordinates\":[1,2]", ",\"type\":7", ",");
    put(m, "}");
}

static void put_name(maker *m) {
    if (is_odd(m))
        PUT_ONE(m, "2.5", "true", "[1]", "{}", "\"\\ud800\"", "\"2020-10-10\"", "\"12:30\"", "-0");
    else
        PUT_ONE(m, "null", "\"\"", "\"Rome\"", "\"a\\u00e9\\n\\\"b\\\\\"", "\"1. FC\"", "7", "-123456789012",
                "\"\xc3\xa9\xff\"");
}

static void put_properties(maker *m, unsigned index) {
    static const char *const columns[] = {"name", "Title", "label", "LAYER", "id"};
    char text[64];
    put(m, "{");
    bool any = false;
    for (int column = 0; column < 5; column++) {
        const bool id = column == 4;
        if (id ? m->ids < 3 || (index && !choose(m, 4)) : !(m->names >> column & 1) || (index && !choose(m, 3)))
            continue;
        snprintf(text, sizeof text, "%s\"%s\":", any ? "," : "", is_odd(m) ? "Name" : columns[column]);
        put(m, text);
        snprintf(text, sizeof text, m->ids == 3 ? "%u" : "\"p%u\"", 3 * index + choose(m, 3));
        if (id)
            put(m, is_odd(m) ? "-4" : text);
        else
            put_name(m);
        any = true;
    }
    if (choose(m, 2))
        put(m, any ? "," : ""), PUT_ONE(m, "\"x\":[1,{\"name\":2}]", "\"y\":1.5e3", "\"z\":{\"id\":[]}", "\"t\":true");
    put(m, "}");
}

static void put_feature(maker *m, unsigned index) {
    char id[64];
    put(m, "{\"type\":");
    put(m, is_odd(m) ? "\"Feat\"" : "\"Feature\"");
    snprintf(id, sizeof id, m->ids == 1 ? ",\"id\":%u" : ",\"id\":\"s%u\"", 5 * index + choose(m, 5));
    if (is_odd(m))
        PUT_ONE(m, ",\"id\":-3", ",\"id\":1.5", ",\"id\":{}", ",\"ID\":3", ",\"id\":\"a\"", ",\"id\":4");
    else if ((m->ids == 1 || m->ids == 2) && choose(m, 8))
        put(m, id);
    put(m, is_odd(m) ? ",\"prop\":" : ",\"properties\":");
    put_properties(m, index);
    put(m, ",\"geometry\":");
    if (choose(m, 12))
        put_geometry(m, 0);
    else
        put(m, "null");
    put(m, "}");
}

static void make_collection(maker *m, uint64_t seed, unsigned oddity) {
    *m = (maker){.random = seed, .oddity = oddity};
    m->loose = choose(m, 2), m->ids = (int)choose(m, 5), m->names = (int)choose(m, 16), m->degrees = choose(m, 3) > 0;
    put(m, choose(m, 8) ? "{" : "\xef\xbb\xbf{");
    put(m, "\"type\":");
    put(m, "\"FeatureCollection\"");
    if (!choose(m, 4)) put(m, ",\"name\":\"l\\u00e4yer\"");
    if (!choose(m, 4)) put(m, choose(m, 2) ? ",\"crs\":null" : ",\"bbox\":[1,2,3,4]");
    if (is_odd(m)) PUT_ONE(m, ",\"crs\":{}", ",\"type\":1", ",\"features\":null", ",\"name\":7");
    put(m, ",\"features\":[");
    const unsigned count = choose(m, 7);
    for (unsigned i = 0; i < count; i++) {
        if (i) put(m, ",");
        put_feature(m, i);
    }
    put(m, "]}");
    if (is_odd(m)) PUT_ONE(m, "x", "}", ",", "{}");
}

static void made_up_collections_are_read_alike(void **state) {
    (void)state;
    static maker m;
    enum { FILES = 400 };
    size_t odd = 0;
    for (uint64_t i = 0; i < FILES; i++) {
        make_collection(&m, 2 * i, 0);
        if (!compare_bytes(m.text, m.length)) fail_msg("left to GDAL: %s", m.text);
    }
    for (uint64_t i = 0; i < 4 * FILES; i++) {
        make_collection(&m, 2 * i + 1, 60);
        odd += !compare_bytes(m.text, m.length);
    }
    assert_in_range(odd, FILES, 3 * FILES);
}

static void a_file_with_a_changed_byte_is_read_alike_or_left_to_gdal(void **state) {
    (void)state;
    static maker m;
    static const char bytes[] = "0123456789.eE+-[]{}:,\"\\ \n\tntfux\x01\x80\xff";
    size_t own = 0;
    for (uint64_t i = 0; i < 2000; i++) {
        make_collection(&m, 7 * i, 0);
        for (unsigned changes = choose(&m, 3) + 1; changes--;) {
            const size_t at = choose(&m, (unsigned)m.length), digits = strcspn(m.text + at, "0123456789");
            if (choose(&m, 4) && at + digits < m.length)
                m.text[at + digits] = (char)('0' + choose(&m, 10));
            else if (choose(&m, 4))
                m.text[at] = bytes[choose(&m, sizeof bytes)];
            else
                m.text[at] = (char)(m.text[at] ^ 1 << choose(&m, 8));
        }
        own += compare_bytes(m.text, m.length);
    }
    assert_in_range(own, 200, 1500);
}

static void a_file_that_ends_too_early_is_refused(void **state) {
    (void)state;
    static const char text[] = TWO("\"id\":1,", "{\"name\":\"\\u00fc\",\"x\":[1,{}]}", "\"id\":2,", "{}");
    static froe_diagnostic why;
    for (size_t length = 1; length < sizeof text - 1; length++) {
        froe_scene *scene = NULL;
        assert_false(compare_bytes(text, length));
        if (!froe_read("both.geojson", NULL, &scene, NULL, &why)) fail_msg("%zu bytes are read", length);
    }
    assert_true(compare_bytes(text, sizeof text - 1));
}

/* ------------------------------------------------------------------- the rest -- */

static void what_is_left_to_gdal_is_said_with_its_line(void **state) {
    (void)state;
    froe_scene *scene = NULL;
    froe_diagnostic why;
    write_text("line.geojson", "{\"type\":\"FeatureCollection\",\n\"features\":[\n" POINT "]}");
    assert_int_equal(froe_read_own("line.geojson", NULL, &scene, NULL, &why), FROE_E_UNSUPPORTED);
    assert_non_null(strstr(why.message, "line.geojson: line 3: What stands here is not plain GeoJSON"));
    write_text("line.geojson", SHAPE(POINT));
    froe_read_options options = froe_read_defaults();
    options.where = "name = 'a'";
    assert_int_equal(froe_read_own("line.geojson", &options, &scene, NULL, &why), FROE_E_UNSUPPORTED);
    assert_non_null(strstr(why.message, "Layers and filters of GeoJSON are left to GDAL"));
    assert_int_equal(froe_read("line.geojson", &options, &scene, NULL, &why), FROE_OK);
    froe_scene_free(scene);
}

static froe_status read_with_little_memory(void *user, const froe_allocator *alloc) {
    (void)user;
    froe_read_options options = froe_read_defaults();
    options.alloc = alloc;
    options.wrap = true;
    froe_scene *scene = NULL;
    const froe_status status = froe_read_own("memory.geojson", &options, &scene, NULL, NULL);
    froe_scene_free(scene);
    return status;
}

static void every_allocation_may_fail(void **state) {
    (void)state;
    write_text("memory.geojson", SHAPE("{\"type\":\"GeometryCollection\",\"geometries\":[" SQUARE "," POINT
                                       ",{\"type\":\"LineString\",\"coordinates\":[[179,0],[-179,0]]}]}"));
    test_memory_each(read_with_little_memory, NULL);
}

/* With names of files: are these read alike? */
int main(int argc, char **argv) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_case_is_read_alike_or_left_to_gdal),
        cmocka_unit_test(maps_of_the_project_are_read_alike),
        cmocka_unit_test(made_up_collections_are_read_alike),
        cmocka_unit_test(a_file_with_a_changed_byte_is_read_alike_or_left_to_gdal),
        cmocka_unit_test(a_file_that_ends_too_early_is_refused),
        cmocka_unit_test(what_is_left_to_gdal_is_said_with_its_line),
        cmocka_unit_test(every_allocation_may_fail),
    };
    for (int i = 1; i < argc; i++) printf("%s: %s\n", argv[i], compare(argv[i]) ? "alike" : "left to GDAL");
    return argc > 1 ? 0 : cmocka_run_group_tests(tests, NULL, NULL);
}
