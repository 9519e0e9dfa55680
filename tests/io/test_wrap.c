/* Borders across the antimeridian: what --wrap makes of them, beside GDAL's own cuts, beside rings that are continued
 * over 180 degrees, and on the countries of the world. */
#include "support.h"

#include "base/random.h"
#include <froe/query.h>
#include <gdal.h>
#include <math.h>
#include <ogr_api.h>
#include <ogr_srs_api.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { CORNERS = 12, POLYGONS = 60, POINTS = 400 };

/* ------------------------------------------------------------------- tools -- */

static double fraction(uint64_t hash) {
    return (double)(hash >> 11) * 0x1p-53;
}

static void write_map(const char *path, const char *const *wkt, size_t count) {
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs("name,WKT\n", file);
    for (size_t i = 0; i < count; i++) fprintf(file, "%c,\"%s\"\n", (int)('a' + i % 26), wkt[i]);
    assert_int_equal(fclose(file), 0);
}

static froe_scene *read_wrapped(const char *path, bool boxes, froe_read_report *report) {
    froe_read_options o = froe_read_defaults();
    froe_scene *scene = NULL;
    froe_diagnostic why;
    o.wrap = true;
    o.boxes = boxes;
    if (froe_read(path, &o, &scene, report, &why)) fail_msg("%s", why.message);
    return scene;
}

static froe_scene *wrap_one(const char *wkt, froe_read_report *report) {
    write_map("wrap.csv", &wkt, 1);
    froe_scene *scene = read_wrapped("wrap.csv", false, report);
    unlink("wrap.csv");
    return scene;
}

static void assert_segment(const froe_scene *scene, uint32_t object, double x0, double y0, double x1, double y1) {
    const double *a = froe_scene_vertex(scene, froe_scene_corner(scene, object, 0));
    const double *b = froe_scene_vertex(scene, froe_scene_corner(scene, object, 1));
    if (a[0] != x0 || a[1] != y0 || b[0] != x1 || b[1] != y1)
        fail_msg("segment %u is %.17g %.17g to %.17g %.17g", object, a[0], a[1], b[0], b[1]);
}

static froe_query *asked(froe_scene *scene, froe_tree **tree) {
    froe_build_options o = froe_build_defaults();
    froe_query *query = NULL;
    froe_diagnostic why;
    o.purpose = "query";
    if (froe_build(scene, &o, tree, &why) || froe_query_new(*tree, &query, &why)) fail_msg("%s", why.message);
    return query;
}

static bool lies_in(froe_query *query, double x, double y, uint32_t group) {
    const double at[2] = {x, y};
    froe_list found;
    bool in = false;
    assert_int_equal(froe_query_groups(query, at, &found, NULL), FROE_OK);
    for (size_t i = 0; i < found.count; i++) in = in || found.ids[i] == group;
    return in;
}

/* --------------------------------------------------------------- by itself -- */

static void edges_end_where_they_cross(void **state) {
    (void)state;
    froe_read_report report;
    froe_scene *s = wrap_one("LINESTRING (179 0,-179 1,-178 1)", &report);
    assert_int_equal(froe_scene_object_count(s), 3);
    assert_segment(s, 0, 179, 0, 180, 0.5);
    assert_segment(s, 1, -180, 0.5, -179, 1);
    assert_segment(s, 2, -179, 1, -178, 1);
    assert_int_equal(report.wrapped, 1);
    froe_scene_free(s);

    s = wrap_one("LINESTRING (-90 0,90 1)", &report); /* either way is as long: it stays */
    assert_int_equal(froe_scene_object_count(s), 1);
    assert_int_equal(report.wrapped, 0);
    froe_scene_free(s);

    s = wrap_one("LINESTRING (-180 3,179 4)", &report); /* one end is the crossing */
    assert_int_equal(froe_scene_object_count(s), 1);
    assert_segment(s, 0, 180, 3, 179, 4);
    froe_scene_free(s);

    s = wrap_one("LINESTRING (170 0,190 20)", &report); /* the Pacific in the middle */
    assert_int_equal(froe_scene_object_count(s), 2);
    assert_segment(s, 0, 170, 0, 180, 10);
    assert_segment(s, 1, -180, 10, -170, 20);
    froe_scene_free(s);

    s = wrap_one("MULTIPOINT (190 1,-180 2,180 3)", &report);
    assert_int_equal(froe_scene_object_count(s), 3);
    assert_true(froe_scene_vertex(s, froe_scene_corner(s, 0, 0))[0] == -170);
    assert_int_equal(report.wrapped, 0);
    froe_scene_free(s);
}

/* Neighbours share the cut, whichever way their border goes. */
static void both_directions_cross_in_the_same_point(void **state) {
    (void)state;
    for (uint64_t i = 0; i < 1000; i++) {
        const double a = 170 + 10 * fraction(base_hash(3, 1, i)), b = -180 + 10 * fraction(base_hash(3, 2, i));
        const double p = 160 * fraction(base_hash(3, 3, i)) - 80, q = 160 * fraction(base_hash(3, 4, i)) - 80;
        char wkt[200];
        froe_read_report report;
        snprintf(wkt, sizeof wkt, "LINESTRING (%.17g %.17g,%.17g %.17g,%.17g %.17g)", a, p, b, q, a, p);
        froe_scene *s = wrap_one(wkt, &report);
        assert_int_equal(froe_scene_object_count(s), 4);
        assert_int_equal(froe_scene_vertex_count(s), 4);
        froe_scene_free(s);
    }
}

static void polygons_are_closed_on_both_sides(void **state) {
    (void)state;
    froe_read_report report;
    for (int turned = 0; turned < 2; turned++) {
        froe_scene *s = wrap_one(turned ? "POLYGON ((179 0,179 2,-179 2,-179 0,179 0))"
                                        : "POLYGON ((179 0,-179 0,-179 2,179 2,179 0))",
                                 &report);
        assert_int_equal(froe_scene_object_count(s), 8);
        assert_int_equal(report.wrapped, 1);
        assert_segment(s, 6, 180, turned ? 2 : 0, 180, turned ? 0 : 2);
        assert_segment(s, 7, -180, turned ? 0 : 2, -180, turned ? 2 : 0);
        for (uint32_t i = 0; i < 8; i++) assert_int_equal(froe_scene_object(s, i).face, 0);
        const froe_group group = froe_scene_group(s, 0); /* the interior stays on its side of every segment */
        assert_string_equal(turned ? group.right : group.left, "a");
        assert_string_equal(turned ? group.left : group.right, "");
        froe_scene_free(s);
    }
}

static void rings_around_a_pole_go_there(void **state) {
    (void)state;
    static const char *const rings[] = {
        "POLYGON ((-120 -70,0 -60,120 -65,-120 -70))", /* eastwards around the south pole: it is on the right */
        "POLYGON ((120 -65,0 -60,-120 -70,120 -65))",  /* westwards: on the left */
        "POLYGON ((-120 70,0 60,120 65,-120 70))", "POLYGON ((120 65,0 60,-120 70,120 65))"};
    for (int i = 0; i < 4; i++) {
        froe_read_report report;
        froe_tree *tree;
        froe_scene *s = wrap_one(rings[i], &report);
        const double north = i < 2 ? -1 : 1;
        assert_int_equal(report.wrapped, 1);
        assert_string_equal(froe_scene_group(s, 0).left, i == 1 || i == 2 ? "a" : "");
        assert_string_equal(froe_scene_group(s, 0).right, i == 0 || i == 3 ? "a" : "");
        /* every segment has the interior on the side that is said */
        double area = 0;
        for (uint32_t k = 0; k < froe_scene_object_count(s); k++) {
            const double *a = froe_scene_vertex(s, froe_scene_corner(s, k, 0));
            const double *b = froe_scene_vertex(s, froe_scene_corner(s, k, 1));
            area += a[0] * b[1] - a[1] * b[0];
        }
        assert_true((area > 0) == (i == 1 || i == 2));
        froe_query *query = asked(s, &tree);
        assert_true(lies_in(query, 0, north * 89, 0) && lies_in(query, -180, north * 89, 0));
        assert_true(lies_in(query, 179, north * 80, 0) && lies_in(query, 180, north * 90, 0));
        assert_false(lies_in(query, 0, north * 59, 0) || lies_in(query, 179, north * 40, 0));
        froe_query_free(query);
        froe_tree_free(tree);
        froe_scene_free(s);
    }
}

/* A hole that crosses, too: the interior lies between the first crossing and the second, the third and the fourth. */
static void holes_stay_holes(void **state) {
    (void)state;
    froe_read_report report;
    froe_tree *tree;
    froe_scene *s =
        wrap_one("POLYGON ((170 0,-170 0,-170 20,170 20,170 0),(175 5,175 15,-175 15,-175 5,175 5))", &report);
    froe_query *query = asked(s, &tree);
    for (int side = -1; side <= 1; side += 2) {
        assert_true(lies_in(query, side * 179.5, 2, 0) && lies_in(query, side * 179.5, 18, 0));
        assert_true(lies_in(query, side * 172, 10, 0) && lies_in(query, side * 180, 0.5, 0));
        assert_false(lies_in(query, side * 179.5, 10, 0) || lies_in(query, side * 169, 10, 0));
        assert_false(lies_in(query, side * 180, 10, 0) || lies_in(query, 0, 10, 0));
    }
    froe_query_free(query);
    froe_tree_free(tree);
    froe_scene_free(s);
}

/* The frame of a map of the whole world is no sliver around the antimeridian. */
static void frames_stay_frames(void **state) {
    (void)state;
    froe_read_report report;
    froe_scene *s = wrap_one("POLYGON ((-180 -85,180 -85,180 85,-180 85,-180 -85))", &report);
    assert_int_equal(froe_scene_object_count(s), 4);
    assert_int_equal(report.wrapped, 0);
    froe_scene_free(s);
    s = wrap_one("POLYGON ((-180 -90,180 -90,180 -60,0 -70,-180 -60,-180 -90))", &report); /* along the pole */
    assert_int_equal(froe_scene_object_count(s), 5);
    assert_int_equal(report.wrapped, 0);
    froe_scene_free(s);
}

static void wide_boxes_become_two(void **state) {
    (void)state;
    static const char *const wkt[] = {"POLYGON ((179 0,-179 0,-179 2,178 3,179 0))", "LINESTRING (-10 0,10 5)",
                                      "POLYGON ((-120 -70,0 -60,120 -65,-120 -70))"};
    static const double expected[5][4] = {
        {-180, 0, -179, 3}, {178, 0, 180, 3}, {-10, 0, 10, 5}, {-180, -90, 0, -60}, {0, -90, 180, -60}};
    froe_read_report report;
    write_map("wrap.csv", wkt, 3);
    froe_scene *s = read_wrapped("wrap.csv", true, &report);
    assert_int_equal(froe_scene_object_count(s), 5);
    for (uint32_t i = 0; i < 5; i++)
        for (uint32_t k = 0; k < 4; k++) {
            const double is = froe_scene_vertex(s, froe_scene_corner(s, i, k / 2))[k % 2];
            if (k == 3 && i < 2 ? fabs(is - expected[i][k]) > 1 : is != expected[i][k])
                fail_msg("box %u, number %u: %.17g", i, k, is);
        }
    froe_scene_free(s);
    unlink("wrap.csv");
}

/* ------------------------------------------------------------------ beside -- */

typedef struct star {
    double xy[2 * CORNERS]; /**< longitudes from 176 to 184 */
    char wkt[1024];         /**< the same within 180 */
} star;

/* A star around a point of the antimeridian; numbers are whole multiples of 1/64. */
static star random_star(uint64_t seed) {
    star s;
    const double middle = (double)base_below(base_hash(seed, 5, 0), 100) - 50;
    char *end = s.wkt + sprintf(s.wkt, "POLYGON ((");
    for (int i = 0; i <= CORNERS; i++) {
        const int at = i % CORNERS;
        const double angle = 6.283185307179586 * (at + 0.4) / CORNERS; /* none in 180: GDAL leaves such rings alone */
        const double radius = 1 + 3 * fraction(base_hash(seed, 6, (uint64_t)at));
        s.xy[2 * at] = 180 + nearbyint(64 * radius * cos(angle)) / 64;
        s.xy[2 * at + 1] = middle + nearbyint(64 * radius * sin(angle)) / 64;
        const double x = s.xy[2 * at] > 180 ? s.xy[2 * at] - 360 : s.xy[2 * at];
        end += sprintf(end, "%s%.17g %.17g", i ? "," : "", x, s.xy[2 * at + 1]);
    }
    sprintf(end, "))");
    return s;
}

/* Is a point inside a ring, which goes on beyond 180? By counting the edges east of it. */
static bool inside(const star *s, double x, double y) {
    bool in = false;
    for (int i = 0, j = CORNERS - 1; i < CORNERS; j = i++) {
        const double *a = s->xy + 2 * i, *b = s->xy + 2 * j;
        if ((a[1] > y) != (b[1] > y) && x < (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1]) + a[0]) in = !in;
    }
    return in;
}

static OGRGeometryH cut_by_gdal(const char *wkt) {
    static const char *const options[] = {"WRAPDATELINE=YES", NULL};
    OGRSpatialReferenceH system = OSRNewSpatialReference(NULL);
    assert_int_equal(OSRImportFromEPSG(system, 4326), OGRERR_NONE);
    OSRSetAxisMappingStrategy(system, OAMS_TRADITIONAL_GIS_ORDER);
    OGRGeomTransformerH transformer = OGR_GeomTransformer_Create(NULL, (char **)(uintptr_t)options);
    OGRGeometryH geometry = NULL;
    char *text = (char *)(uintptr_t)wkt;
    assert_int_equal(OGR_G_CreateFromWkt(&text, system, &geometry), OGRERR_NONE);
    OGRGeometryH cut = OGR_GeomTransformer_Transform(transformer, geometry);
    assert_non_null(cut);
    OGR_G_DestroyGeometry(geometry);
    OGR_GeomTransformer_Destroy(transformer);
    OSRRelease(system);
    return cut;
}

static bool in_geometry(OGRGeometryH geometry, double x, double y) {
    OGRGeometryH point = OGR_G_CreateGeometry(wkbPoint);
    OGR_G_SetPoint_2D(point, 0, x, y);
    const bool in = OGR_G_Intersects(geometry, point);
    OGR_G_DestroyGeometry(point);
    return in;
}

static void polygons_contain_what_gdal_says_and_what_their_rings_do(void **state) {
    (void)state;
    size_t cut_by_both = 0;
    for (uint64_t i = 0; i < POLYGONS; i++) {
        const star s = random_star(i);
        froe_read_report report;
        froe_tree *tree;
        froe_scene *scene = wrap_one(s.wkt, &report);
        froe_query *query = asked(scene, &tree);
        OGRGeometryH gdal = cut_by_gdal(s.wkt);
        const bool both = OGR_G_GetGeometryCount(gdal) > 1; /* GDAL cuts some of them only */
        cut_by_both += both;
        assert_int_equal(report.wrapped, 1);
        for (uint64_t k = 0; k < POINTS; k++) { /* off the antimeridian, and hardly ever on a border */
            const double x = 175.9 + 8.2 * fraction(base_hash(i, 7, k));
            const double y = s.xy[1] - 4 + 8 * fraction(base_hash(i, 8, k)), at = x > 180 ? x - 360 : x;
            const bool in = lies_in(query, at, y, 0);
            if (in != inside(&s, x, y)) fail_msg("polygon %zu, point %.17g %.17g", (size_t)i, x, y);
            if (both && in != in_geometry(gdal, at, y)) fail_msg("polygon %zu, GDAL, %.17g %.17g", (size_t)i, x, y);
        }
        OGR_G_DestroyGeometry(gdal);
        froe_query_free(query);
        froe_tree_free(tree);
        froe_scene_free(scene);
    }
    assert_true(cut_by_both > POLYGONS / 2);
}

static void countries_are_where_they_are(void **state) {
    (void)state;
    static const struct {
        double x, y;
        const char *name, *without; /* NULL: none */
    } points[] = {{0, -16.5, NULL, "Fiji"},          {178.4, -17.8, "Fiji", "Fiji"}, {-179.9, -16.3, "Fiji", NULL},
                  {179.9, -16.3, "Fiji", NULL},      {-175, 67, "Russia", NULL},     {179, 67, "Russia", NULL},
                  {0, -88, "Antarctica", NULL},      {180, -85, "Antarctica", NULL}, {-180, -90, "Antarctica", NULL},
                  {2.35, 48.86, "France", "France"}, {-90, -16.5, NULL, "Fiji"}};
    for (int wrap = 0; wrap < 2; wrap++) {
        froe_read_options o = froe_read_defaults();
        froe_scene *scene;
        froe_tree *tree;
        uint32_t first;
        froe_read_report report;
        o.layer = "countries";
        o.wrap = wrap;
        assert_int_equal(froe_read(FROE_TEST_DATA "/countries-110m.json", &o, &scene, &report, NULL), FROE_OK);
        assert_int_equal(froe_scene_across(scene, &first), wrap ? 0 : 3);
        assert_int_equal(report.wrapped, wrap ? 3 : 0);
        if (!wrap) assert_string_equal(froe_scene_group(scene, froe_scene_object(scene, first).group).name, "Fiji");
        froe_query *query = asked(scene, &tree);
        for (size_t i = 0; i < sizeof points / sizeof *points; i++) {
            const double at[2] = {points[i].x, points[i].y};
            const char *expected = wrap ? points[i].name : points[i].without;
            froe_list found;
            assert_int_equal(froe_query_groups(query, at, &found, NULL), FROE_OK);
            if (found.count != (expected != NULL) ||
                (expected && strcmp(froe_scene_group(scene, found.ids[0]).name, expected) != 0))
                fail_msg("point %zu, wrap %d: %zu groups", i, wrap, found.count);
        }
        froe_query_free(query);
        froe_tree_free(tree);
        froe_scene_free(scene);
    }
}

/* ---------------------------------------------------------------- refusals -- */

static void assert_refused(const char *path, froe_status status, const char *sentence) {
    froe_read_options o = froe_read_defaults();
    froe_scene *scene = NULL;
    froe_diagnostic why;
    o.wrap = true;
    assert_int_equal(froe_read(path, &o, &scene, NULL, &why), status);
    if (!strstr(why.message, sentence)) fail_msg("%s", why.message);
    assert_null(scene);
}

static void what_has_no_antimeridian_is_refused(void **state) {
    (void)state;
    const char *beyond = "LINESTRING (0 0,361 0)", *above = "POINT (0 90.5)";
    write_map("wrap.csv", &beyond, 1);
    assert_refused("wrap.csv", FROE_E_INPUT,
                   "wrap.csv: feature 1 of 'wrap': The numbers 361 and 0 are no longitude and latitude");
    write_map("wrap.csv", &above, 1);
    assert_refused("wrap.csv", FROE_E_INPUT, "numbers 0 and 90.5 are no longitude and latitude");
    FILE *file = fopen("wrap.geojson", "w");
    assert_non_null(file);
    fputs("{\"type\":\"FeatureCollection\",\"crs\":{\"type\":\"name\",\"properties\":{\"name\":\"EPSG:25832\"}},"
          "\"features\":[{\"type\":\"Feature\",\"properties\":{},\"geometry\":{\"type\":\"Point\",\"coordinates\":[1,2]"
          "}}]}",
          file);
    assert_int_equal(fclose(file), 0);
    assert_refused("wrap.geojson", FROE_E_OPTIONS, "Coordinates in 'ETRS89 / UTM zone 32N' are no longitudes");
    assert_refused(FROE_TEST_DATA "/utah-teapot.obj", FROE_E_OPTIONS, "has no antimeridian to be cut at");
    unlink("wrap.csv");
    unlink("wrap.geojson");
}

static froe_status read_countries(void *user, const froe_allocator *alloc) {
    froe_read_options o = froe_read_defaults();
    froe_scene *scene;
    (void)user;
    o.wrap = true;
    o.alloc = alloc;
    const froe_status status = froe_read("wrap.csv", &o, &scene, NULL, NULL);
    if (!status) froe_scene_free(scene);
    return status;
}

static void every_failing_allocation_is_survived(void **state) {
    (void)state;
    const char *const wkt[] = {"POLYGON ((-120 -70,0 -60,120 -65,-120 -70))", "LINESTRING (179 0,-179 1)"};
    write_map("wrap.csv", wkt, 2);
    assert_true(test_memory_each(read_countries, NULL) >= 10);
    unlink("wrap.csv");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(edges_end_where_they_cross),
        cmocka_unit_test(both_directions_cross_in_the_same_point),
        cmocka_unit_test(polygons_are_closed_on_both_sides),
        cmocka_unit_test(rings_around_a_pole_go_there),
        cmocka_unit_test(holes_stay_holes),
        cmocka_unit_test(frames_stay_frames),
        cmocka_unit_test(wide_boxes_become_two),
        cmocka_unit_test(polygons_contain_what_gdal_says_and_what_their_rings_do),
        cmocka_unit_test(countries_are_where_they_are),
        cmocka_unit_test(what_has_no_antimeridian_is_refused),
        cmocka_unit_test(every_failing_allocation_is_survived),
    };
    GDALAllRegister();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
