/* Plane maps: the same features through every format of OGR that can be written here,
 * and by hand those that cannot; order, names, sides, curves, and what is counted. */
#include "support.h"
#include <cpl_vsi.h>
#include <gdal.h>
#include <ogr_api.h>
#include <ogr_srs_api.h>
#include <unistd.h>

/* Two polygons, one of them with a hole, and one of two parts: 4 + 4 + 3 + 4 + 3 segments. */
static const char *const shapes[] = {
    "POLYGON ((0 0,8 0,8 8,0 8,0 0),(2 2,2 4,4 4,4 2,2 2))",
    "POLYGON ((10 0,12.5 0,11 1e-3,10 0))",
    "MULTIPOLYGON (((20 0,21 0,21 1,20 1,20 0)),((30 0,31 0,30 0.1,30 0)))",
};
static const char *const names[] = {"Holed", "Sliver", "Two parts"};
enum { SHAPES = 3, SEGMENTS = 18 };

static OGRLayerH new_layer(GDALDatasetH data, OGRwkbGeometryType type, bool named, const char *const *options) {
    OGRLayerH layer = GDALDatasetCreateLayer(data, "places", NULL, type, (char **)(uintptr_t)options);
    assert_non_null(layer);
    if (!named) return layer;
    OGRFieldDefnH field = OGR_Fld_Create("NAME", OFTString);
    assert_int_equal(OGR_L_CreateField(layer, field, TRUE), OGRERR_NONE);
    OGR_Fld_Destroy(field);
    return layer;
}

static void add_feature(OGRLayerH layer, const char *wkt, const char *name) {
    OGRFeatureH feature = OGR_F_Create(OGR_L_GetLayerDefn(layer));
    OGRGeometryH geometry = NULL;
    char *text = (char *)(uintptr_t)wkt;
    assert_int_equal(OGR_G_CreateFromWkt(&text, NULL, &geometry), OGRERR_NONE);
    if (name) OGR_F_SetFieldString(feature, 0, name);
    OGR_F_SetGeometryDirectly(feature, geometry);
    assert_int_equal(OGR_L_CreateFeature(layer, feature), OGRERR_NONE);
    OGR_F_Destroy(feature);
}

static GDALDatasetH new_data(const char *driver, const char *path) {
    GDALAllRegister();
    GDALDriverH handle = GDALGetDriverByName(driver);
    assert_non_null(handle);
    unlink(path);
    GDALDatasetH data = GDALCreate(handle, path, 0, 0, 0, GDT_Unknown, NULL);
    assert_non_null(data);
    return data;
}

static void make_polygons(const char *driver, const char *path, const char *const *options) {
    GDALDatasetH data = new_data(driver, path);
    OGRLayerH layer = new_layer(data, options ? wkbUnknown : wkbMultiPolygon, true, options);
    for (int i = 0; i < SHAPES; i++) {
        bool wrap = !options && strncmp(shapes[i], "MULTI", 5) != 0;
        char wkt[256];
        snprintf(wkt, sizeof wkt, "%s%s%s", wrap ? "MULTIPOLYGON (" : "", wrap ? shapes[i] + 8 : shapes[i],
                 wrap ? ")" : "");
        add_feature(layer, wkt, names[i]);
    }
    GDALClose(data);
}

static bool has_edge(const froe_scene *scene, double ax, double ay, double bx, double by) {
    const edge wanted = {{ax, ay, bx, by}};
    for (uint32_t i = 0; i < froe_scene_object_count(scene); i++) {
        edge found = edge_of(scene, i);
        if (!compare_edges(&found, &wanted)) return true;
    }
    return false;
}

static void check_polygons(const char *path, const char *format) {
    froe_read_report report;
    froe_scene *scene = read_scene(path, &report);
    assert_string_equal(report.format, format);
    assert_int_equal(froe_scene_object_count(scene), SEGMENTS);
    assert_int_equal(froe_scene_kind_count(scene, FROE_SEGMENT), SEGMENTS);
    assert_int_equal(distinct_edges(scene), SEGMENTS);
    assert_true(has_edge(scene, 2, 2, 2, 4) && has_edge(scene, 11, 1e-3, 12.5, 0) && has_edge(scene, 30, 0, 30, 0.1));
    assert_int_equal(report.features, SHAPES);
    assert_int_equal(froe_scene_group_count(scene), SHAPES);
    for (uint32_t g = 0; g < SHAPES; g++) { /* an index may have changed their order */
        froe_group group = froe_scene_group(scene, g);
        int known = 0;
        for (int i = 0; i < SHAPES; i++) known += !strcmp(group.name, names[i]);
        assert_int_equal(known, 1);
        assert_true(!strcmp(group.left, group.name) != !strcmp(group.right, group.name));
    }
    froe_scene_free(scene);
}

static void polygons_come_through_every_format(void **state) {
    (void)state;
    const char *const as_wkt[] = {"GEOMETRY=AS_WKT", NULL};
    make_polygons("GeoJSON", "polygons.geojson", NULL);
    check_polygons("polygons.geojson", "GeoJSON");
    make_polygons("ESRI Shapefile", "polygons.shp", NULL);
    check_polygons("polygons.shp", "ESRI Shapefile");
    make_polygons("GPKG", "polygons.gpkg", NULL);
    check_polygons("polygons.gpkg", "GPKG");
    make_polygons("FlatGeobuf", "polygons.fgb", NULL);
    check_polygons("polygons.fgb", "FlatGeobuf");
    make_polygons("GML", "polygons.gml", NULL);
    check_polygons("polygons.gml", "GML");
    make_polygons("CSV", "polygons.csv", as_wkt);
    check_polygons("polygons.csv", "CSV");
}

static void drawings_keep_their_layers_as_materials(void **state) {
    (void)state;
    GDALDatasetH data = new_data("DXF", "lines.dxf");
    OGRLayerH layer = GDALDatasetGetLayerByName(data, "entities");
    if (!layer) layer = GDALDatasetCreateLayer(data, "entities", NULL, wkbUnknown, NULL);
    OGRFeatureH feature = OGR_F_Create(OGR_L_GetLayerDefn(layer));
    OGRGeometryH line = NULL;
    char wkt[] = "LINESTRING (0 0,1.5 0,1.5 2)", *text = wkt;
    assert_int_equal(OGR_G_CreateFromWkt(&text, NULL, &line), OGRERR_NONE);
    OGR_F_SetGeometryDirectly(feature, line);
    assert_int_equal(OGR_L_CreateFeature(layer, feature), OGRERR_NONE);
    OGR_F_Destroy(feature);
    GDALClose(data);
    froe_read_report report;
    froe_scene *scene = read_scene("lines.dxf", &report);
    assert_string_equal(report.format, "DXF");
    assert_int_equal(froe_scene_object_count(scene), 2);
    assert_true(has_edge(scene, 0, 0, 1.5, 0) && has_edge(scene, 1.5, 0, 1.5, 2));
    froe_scene_free(scene);
}

static void a_street_map_gives_nodes_and_ways(void **state) {
    (void)state;
    write_text("street.osm",
               "<?xml version=\"1.0\"?><osm version=\"0.6\">"
               "<node id=\"1\" lat=\"1\" lon=\"2\" version=\"1\"><tag k=\"name\" v=\"Well\"/></node>"
               "<node id=\"2\" lat=\"1\" lon=\"3\" version=\"1\"/><node id=\"3\" lat=\"2\" lon=\"3\" version=\"1\"/>"
               "<way id=\"7\" version=\"1\"><nd ref=\"1\"/><nd ref=\"2\"/><nd ref=\"3\"/>"
               "<tag k=\"highway\" v=\"path\"/><tag k=\"name\" v=\"Lane\"/></way></osm>");
    froe_read_report report;
    froe_scene *scene = read_scene("street.osm", &report);
    assert_string_equal(report.format, "OSM");
    assert_int_equal(froe_scene_kind_count(scene, FROE_POINT), 1);
    assert_int_equal(froe_scene_kind_count(scene, FROE_SEGMENT), 2);
    assert_int_equal(froe_scene_group_count(scene), 2);
    froe_scene_free(scene);
    froe_read_options options = froe_read_defaults();
    options.layer = "lines";
    scene = read_with("street.osm", &options, &report);
    assert_int_equal(froe_scene_object_count(scene), 2);
    assert_string_equal(froe_scene_group(scene, 0).name, "Lane");
    froe_scene_free(scene);
}

static void objects_keep_the_order_of_feature_part_ring_vertex(void **state) {
    (void)state;
    write_text(
        "order.geojson",
        "{\"type\":\"FeatureCollection\",\"features\":["
        "{\"type\":\"Feature\",\"id\":40,\"properties\":{\"name\":\"b\"},\"geometry\":{\"type\":\"GeometryCollection\","
        "\"geometries\":[{\"type\":\"MultiPoint\",\"coordinates\":[[5,5],[6,6]]},"
        "{\"type\":\"MultiLineString\",\"coordinates\":[[[0,0],[1,0],[2,0]],[[3,0],[4,0]]]}]}},"
        "{\"type\":\"Feature\",\"id\":7,\"properties\":{\"name\":\"a\"},\"geometry\":{\"type\":\"Polygon\","
        "\"coordinates\":[[[0,0],[9,0],[0,9],[0,0]],[[1,1],[1,2],[2,1],[1,1]]]}},"
        "{\"type\":\"Feature\",\"properties\":{},\"geometry\":null}]}");
    froe_read_report report;
    froe_scene *scene = read_scene("order.geojson", &report);
    static const double starts[][2] = {{5, 5}, {6, 6}, {0, 0}, {1, 0}, {3, 0}, {0, 0},
                                       {9, 0}, {0, 9}, {1, 1}, {1, 2}, {2, 1}};
    assert_int_equal(froe_scene_object_count(scene), 11);
    for (uint32_t i = 0; i < 11; i++) {
        froe_object o = froe_scene_object(scene, i);
        const double *at = corner(scene, i, 0);
        assert_true(at[0] == starts[i][0] && at[1] == starts[i][1]);
        assert_int_equal(o.kind, i < 2 ? FROE_POINT : FROE_SEGMENT);
        assert_int_equal(o.tag, i < 5 ? 40 : 7);
        assert_int_equal(o.group, i < 5 ? 0 : 1);
        assert_int_equal(o.face, i < 5 ? i : 5);
    }
    assert_int_equal(report.no_geometry, 1);
    assert_int_equal(report.features, 3);
    assert_string_equal(froe_scene_group(scene, 0).left, "");
    assert_string_equal(froe_scene_group(scene, 1).left, "a");
    assert_string_equal(froe_scene_group(scene, 1).right, "");
    froe_scene_free(scene);
}

static void rings_that_disagree_have_no_side(void **state) {
    (void)state;
    write_text("sides.geojson",
               "{\"type\":\"Feature\",\"properties\":{\"id\":12},\"geometry\":{\"type\":\"MultiPolygon\","
               "\"coordinates\":[[[[0,0],[1,0],[0,1],[0,0]]],[[[5,0],[5,1],[6,0],[5,0]]]]}}");
    froe_scene *scene = read_scene("sides.geojson", NULL);
    froe_group group = froe_scene_group(scene, 0);
    assert_string_equal(group.name, "12");
    assert_string_equal(group.left, "");
    assert_string_equal(group.right, "");
    froe_scene_free(scene);
}

static void curves_become_chords_and_are_counted(void **state) {
    (void)state;
    write_text("curve.csv", "id,WKT\n1,\"CIRCULARSTRING (0 0,1 1,2 0)\"\n2,\"LINESTRING (5 5,6 6)\"\n");
    froe_read_report report;
    froe_scene *scene = read_scene("curve.csv", &report);
    assert_int_equal(report.linearised, 1);
    assert_true(froe_scene_object_count(scene) > 10);
    assert_true(has_edge(scene, 5, 5, 6, 6));
    froe_scene_free(scene);
}

/* A row that OGR cannot read would be as if it were not there. */
static void broken_geometries_of_a_table_are_refused(void **state) {
    (void)state;
    static const char *const texts[] = {"POINT (1", "POINT (nan 1)", "SRID=3857;POINT (1 2)", "CIRCLE (1 2 3)", "x"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        char text[128];
        snprintf(text, sizeof text, "id,Geometry\n1,POINT (0 0)\n2,%s\n", texts[i]);
        write_text("broken.csv", text);
        snprintf(text, sizeof text, "broken.csv: feature 2 of 'broken': Its geometry '%s' cannot be read.", texts[i]);
        refuse("broken.csv", FROE_E_FORMAT, text);
    }
}

static void what_is_mended_or_left_out_is_counted(void **state) {
    (void)state;
    write_text("odd.csv",
               "id,WKT\n1,\"POLYGON ((0 0,4 0,4 4))\"\n2,\"LINESTRING Z (5 5 1,6 6 2)\"\n3,\"LINESTRING (1 1)\"\n"
               "4,POLYGON EMPTY\n5,\"LINESTRING Z (3 3 0,3 3 0)\"\n6,\n");
    froe_read_report report;
    froe_scene *scene = read_scene("odd.csv", &report);
    assert_int_equal(froe_scene_object_count(scene), 5);
    assert_true(has_edge(scene, 0, 0, 4, 4)); /* the edge that was missing */
    assert_int_equal(report.closed, 1);
    assert_int_equal(report.flattened, 1);
    assert_int_equal(report.skipped, 2);
    assert_int_equal(report.no_geometry, 1);
    assert_int_equal(froe_scene_object(scene, 4).kind, FROE_SEGMENT);
    assert_int_equal(froe_scene_object(scene, 4).form, FROE_POINT);
    froe_scene_free(scene);
    write_text("odd.geojson", "{\"type\":\"FeatureCollection\",\"features\":["
                              "{\"type\":\"Feature\",\"properties\":{\"name\":\"without heights\"},\"geometry\":"
                              "{\"type\":\"LineString\",\"coordinates\":[[0,0,NaN],[1,1,NaN]]}},"
                              "{\"type\":\"Feature\",\"properties\":{\"name\":\"below\"},\"geometry\":"
                              "{\"type\":\"Point\",\"coordinates\":[2,2,-1]}}]}");
    scene = read_scene("odd.geojson", &report);
    assert_int_equal(froe_scene_object_count(scene), 2);
    assert_int_equal(report.flattened, 1);
    froe_scene_free(scene);
}

static void coordinates_are_taken_exactly(void **state) {
    (void)state;
    write_text("exact.geojson",
               "{\"type\":\"LineString\",\"coordinates\":[[0.1,1e308],[-1e308,4.9406564584124654e-324],"
               "[0.30000000000000004,-0.0],[9007199254740993,2.2250738585072011e-308]]}");
    froe_scene *scene = read_scene("exact.geojson", NULL);
    assert_int_equal(froe_scene_object_count(scene), 3);
    assert_true(corner(scene, 0, 0)[0] == 0.1 && corner(scene, 0, 0)[1] == 1e308);
    assert_true(corner(scene, 0, 1)[0] == -1e308 && corner(scene, 0, 1)[1] == 0x1p-1074);
    assert_true(corner(scene, 1, 1)[0] == 0.30000000000000004 && corner(scene, 1, 1)[1] == 0);
    assert_true(corner(scene, 2, 1)[1] == 2.2250738585072011e-308);
    froe_scene_free(scene);
}

static void every_feature_can_be_its_box(void **state) {
    (void)state;
    make_polygons("GeoJSON", "boxed.geojson", NULL);
    froe_read_options options = froe_read_defaults();
    options.boxes = true;
    froe_scene *scene = read_with("boxed.geojson", &options, NULL);
    assert_int_equal(froe_scene_kind_count(scene, FROE_BOX), SHAPES);
    assert_int_equal(froe_scene_object_count(scene), SHAPES);
    const double *lo = corner(scene, 2, 0), *hi = corner(scene, 2, 1);
    assert_true(lo[0] == 20 && lo[1] == 0 && hi[0] == 31 && hi[1] == 1);
    assert_string_equal(froe_scene_group(scene, froe_scene_object(scene, 2).group).name, "Two parts");
    froe_scene_free(scene);
}

static void nested_collections_are_no_recursion(void **state) {
    (void)state;
    write_text("nest.csv", "id,WKT\n1,\"GEOMETRYCOLLECTION (POINT (1 1),GEOMETRYCOLLECTION (POINT (2 2),"
                           "GEOMETRYCOLLECTION (LINESTRING (0 0,1 0),POINT (3 3))),POINT (4 4))\"\n");
    froe_scene *scene = read_scene("nest.csv", NULL);
    assert_int_equal(froe_scene_object_count(scene), 5);
    assert_true(corner(scene, 2, 1)[0] == 1 && corner(scene, 3, 0)[0] == 3 && corner(scene, 4, 0)[0] == 4);
    froe_scene_free(scene);
}

/* A folder of Shapefiles, one or two of them. */
static void write_folder(const char *path, bool roads) {
    VSIRmdirRecursive(path);
    GDALDatasetH data = new_data("ESRI Shapefile", path);
    add_feature(new_layer(data, wkbPolygon, true, NULL), shapes[0], names[0]);
    if (roads)
        add_feature(GDALDatasetCreateLayer(data, "roads", NULL, wkbLineString, NULL), "LINESTRING (0 0,1 0,2 1)", NULL);
    GDALClose(data);
}

static void a_folder_of_several_layers_needs_the_name_of_one(void **state) {
    (void)state;
    write_folder("alone", false);
    froe_scene *scene = read_scene("alone", NULL);
    assert_int_equal(froe_scene_object_count(scene), 8);
    froe_scene_free(scene);
    write_folder("both", true);
    refuse("both", FROE_E_OPTIONS, "both: A layer must be named, because there are several: places, roads.");
    froe_read_options options = froe_read_defaults();
    options.layer = "roads";
    scene = read_with("both", &options, NULL);
    assert_int_equal(froe_scene_object_count(scene), 2);
    froe_scene_free(scene);
}

/* ------------------------------------------------------------- coordinate systems -- */

/* A file of one point in a system. */
static void write_in(const char *driver, const char *path, const char *wkt) {
    OGRSpatialReferenceH system = wkt ? OSRNewSpatialReference(wkt) : NULL;
    GDALDatasetH data = new_data(driver, path);
    OGRLayerH layer = GDALDatasetCreateLayer(data, "places", system, wkbPoint, NULL);
    assert_non_null(layer);
    add_feature(layer, "POINT (1 2)", NULL);
    if (system) OSRRelease(system);
    GDALClose(data);
}

static void systems_are_of_degrees_or_of_something_else(void **state) {
    (void)state;
    static const char grads[] =
        "GEOGCS[\"own grads\",DATUM[\"own\",SPHEROID[\"ball\",6371000,0]],PRIMEM[\"Greenwich\",0],"
        "UNIT[\"grad\",0.015707963267948967]]",
                      degrees[] = "GEOGCS[\"own degrees\",DATUM[\"own\",SPHEROID[\"ball\",6371000,0]],PRIMEM["
                                  "\"Greenwich\",0],UNIT[\"degree\",0.017453292519943295]]",
                      local[] = "LOCAL_CS[\"a hall\",UNIT[\"metre\",1]]";
    static const struct {
        const char *driver, *path, *wkt;
        froe_crs_kind kind;
        const char *name, *unit;
    } cases[] = {
        {"GPKG", "grads.gpkg", grads, FROE_CRS_OTHER, "own grads", "grad"},
        {"GPKG", "degrees.gpkg", degrees, FROE_CRS_GEOGRAPHIC, "own degrees", "degree"},
        {"GPKG", "local.gpkg", local, FROE_CRS_OTHER, "a hall", "metre"},
        {"GPKG", "plane.gpkg", "LOCAL_CS[\"Undefined Cartesian SRS\",UNIT[\"metre\",1]]", FROE_CRS_UNKNOWN, "", ""},
        {"GPKG", "none.gpkg", NULL, FROE_CRS_UNKNOWN, "", ""},
    };
    froe_read_options wrap = froe_read_defaults();
    wrap.wrap = true;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        write_in(cases[i].driver, cases[i].path, cases[i].wkt);
        froe_scene *scene = read_scene(cases[i].path, NULL);
        const froe_crs crs = froe_scene_crs(scene);
        if (crs.kind != cases[i].kind) fail_msg("%s: %d, '%s'", cases[i].path, (int)crs.kind, crs.name);
        if (crs.kind) {
            assert_string_equal(crs.name, cases[i].name);
            assert_string_equal(crs.unit, cases[i].unit);
            assert_string_equal(crs.code, "");
        }
        froe_scene_free(scene);
        if (cases[i].kind == FROE_CRS_OTHER)
            refuse_with(cases[i].path, &wrap, FROE_E_OPTIONS, "are no longitudes and latitudes in degrees");
    }
}

/* Layers of a file are read together where all are in one system, or in none. */
static void layers_in_different_systems_are_refused(void **state) {
    (void)state;
    static const struct {
        const char *systems[2], *message;
    } cases[] = {
        {{"<LayerSRS>EPSG:4326</LayerSRS>", "<LayerSRS>EPSG:4326</LayerSRS>"}, NULL},
        {{"", ""}, NULL},
        {{"", "<LayerSRS>EPSG:4326</LayerSRS>"}, "of 'one' none, of 'two' WGS 84."},
        {{"<LayerSRS>EPSG:4326</LayerSRS>", ""}, "of 'one' WGS 84, of 'two' none."},
        {{"<LayerSRS>EPSG:4326</LayerSRS>", "<LayerSRS>EPSG:3857</LayerSRS>"}, "of 'two' WGS 84 / Pseudo-Mercator."},
    };
    write_text("points.csv", "x,y\n1,2\n");
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        FILE *file = fopen("layers.vrt", "w");
        assert_non_null(file);
        fputs("<OGRVRTDataSource>", file);
        for (int k = 0; k < 2; k++)
            fprintf(
                file,
                "<OGRVRTLayer name=\"%s\"><SrcDataSource relativeToVRT=\"1\">points.csv</SrcDataSource><SrcLayer>"
                "points</SrcLayer><GeometryType>wkbPoint</GeometryType>%s<GeometryField encoding=\"PointFromColumns\" "
                "x=\"x\" y=\"y\"/></OGRVRTLayer>",
                k ? "two" : "one", cases[i].systems[k]);
        fputs("</OGRVRTDataSource>", file);
        fclose(file);
        if (cases[i].message) {
            refuse("layers.vrt", FROE_E_OPTIONS, cases[i].message);
            continue;
        }
        froe_scene *scene = read_scene("layers.vrt", NULL);
        assert_int_equal(froe_scene_object_count(scene), 2);
        assert_int_equal(froe_scene_crs(scene).kind != FROE_CRS_UNKNOWN, i == 0);
        froe_scene_free(scene);
    }
}

/* Of several layers, each is filtered. */
static void wrong_filters_are_told_in_a_line(void **state) {
    (void)state;
    froe_read_options o = froe_read_defaults();
    o.where = "x >\r\n";
    write_text("point.csv", "id,WKT\n1,POINT (1 2)\n");
    refuse_with("point.csv", &o, FROE_E_OPTIONS, "point.csv: OGR reports 'SQL Expression Parsing Error: ");
    GDALDatasetH data = new_data("KML", "two.kml");
    for (int k = 0; k < 2; k++)
        add_feature(GDALDatasetCreateLayer(data, k ? "one" : "two", NULL, wkbPoint, NULL), "POINT (1 2)", NULL);
    GDALClose(data);
    o.where = "nothing = 1";
    refuse_with("two.kml", &o, FROE_E_OPTIONS, "nothing");
}

#define NAMED(name) "\"crs\":{\"type\":\"name\",\"properties\":{\"name\":\"" name "\"}},"

/* The system is what a member of the collection says. GDAL takes WGS 84 for what it cannot look up, which is not
 * believed then. A member with the value "crs" is none of that name. */
static void geojson_has_the_system_that_its_member_names(void **state) {
    (void)state;
    static const char format[] =
        "{\"type\":\"FeatureCollection\",\"kind\":\"crs\",%s\"features\":[{\"type\":\"Feature\","
        "\"properties\":{\"crs\":null},\"geometry\":{\"type\":\"Point\",\"coordinates\":[1,2%s]}}]}";
    static const struct {
        const char *member;
        froe_crs_kind kind;
    } cases[] = {
        {"", FROE_CRS_GEOGRAPHIC},
        {"\"other\":{\"crs\":\"EPSG:99999\"},", FROE_CRS_GEOGRAPHIC},
        {"\"crs\" : null,", FROE_CRS_UNKNOWN},
        {"\"CRS\":null,", FROE_CRS_UNKNOWN},
        {NAMED("urn:ogc:def:crs:EPSG::3857"), FROE_CRS_PROJECTED},
        {NAMED("urn:ogc:def:crs:EPSG::99999"), FROE_CRS_UNKNOWN},
        {NAMED("EPSG:14326"), FROE_CRS_UNKNOWN},
        {NAMED("EPSG:43260"), FROE_CRS_UNKNOWN},
        {"\"note\":\"of \\\" and \\\\\"," NAMED("EPSG:99999") "\"more\":\"EPSG:4326\",", FROE_CRS_UNKNOWN},
        {NAMED(""), FROE_CRS_UNKNOWN},
        {"\"crs\":{\"type\":\"EPSG\",\"properties\":{\"code\":99999}},", FROE_CRS_UNKNOWN},
        {"\"crs\":{\"type\":\"EPSG\",\"properties\":{\"code\":4326}},", FROE_CRS_GEOGRAPHIC},
        {"\"crs\":\"EPSG:3857\",", FROE_CRS_UNKNOWN},
        {"\"crs\":5,", FROE_CRS_UNKNOWN},
        {NAMED("urn:ogc:def:crs:OGC:1.3:CRS84"), FROE_CRS_GEOGRAPHIC},
        {NAMED("urn:ogc:def:crs:OGC::CRS84"), FROE_CRS_GEOGRAPHIC},
        {NAMED("urn:ogc:def:crs:EPSG:6.6:4326"), FROE_CRS_GEOGRAPHIC},
        {NAMED("EPSG:4979"), FROE_CRS_GEOGRAPHIC},
        {NAMED("WGS84"), FROE_CRS_GEOGRAPHIC},
    };
    unlink("denied.zip");                                             /* of an earlier run */
    for (size_t i = 0; i < 2 * (sizeof cases / sizeof *cases); i++) { /* flat, and with heights */
        char text[600];
        const char *member = cases[i / 2].member;
        snprintf(text, sizeof text, format, member, i % 2 ? ",3" : "");
        VSILFILE *archive = VSIFOpenL("/vsizip/{denied.zip}/denied.geojson", "wb"); /* GDAL reads what is in archives */
        assert_int_equal(VSIFWriteL(text, 1, strlen(text), archive), strlen(text));
        VSIFCloseL(archive);
        froe_scene *scene = read_scene("denied.zip", NULL);
        const froe_crs crs = froe_scene_crs(scene);
        if (crs.kind != cases[i / 2].kind) fail_msg("%s: %s, %s", member, crs.name, crs.code);
        froe_scene_free(scene);
        unlink("denied.zip");
    }
}

/* Surfaces of triangles, and polygons with rings of no vertices. */
static void triangles_and_empty_rings_are_read(void **state) {
    (void)state;
    write_text("tin.csv",
               "id,WKT\n1,\"TIN (((0 0,1 0,0 1,0 0)),((1 0,1 1,0 1,1 0)))\"\n2,\"TRIANGLE ((5 5,6 5,5 6,5 5))\"\n"
               "3,\"POLYGON ((8 8,9 8,9 9,8 8),EMPTY)\"\n");
    froe_read_report report;
    froe_scene *scene = read_scene("tin.csv", &report);
    assert_int_equal(froe_scene_object_count(scene), 12);
    assert_true(has_edge(scene, 5, 5, 6, 5) && has_edge(scene, 8, 8, 9, 9));
    froe_scene_free(scene);
    static const char long_name[] = "a map with a name of more than 32 bytes.csv";
    VSILFILE *packed = VSIFOpenL("/vsigzip/a map with a name of more than 32 bytes.csv.gz", "wb");
    static const char text[] = "id,WKT\n1,\"LINESTRING (0 0,1 0)\"\n";
    assert_true(packed && sizeof long_name > 32);
    assert_int_equal(VSIFWriteL(text, 1, strlen(text), packed), strlen(text));
    VSIFCloseL(packed);
    scene = read_scene("a map with a name of more than 32 bytes.csv.gz", NULL);
    assert_int_equal(froe_scene_object_count(scene), 1);
    froe_scene_free(scene);
    write_text("rows.tsv", "id\tWKT\n1\tLINESTRING (0 0,1 0)\n");
    scene = read_scene("rows.tsv", NULL);
    assert_int_equal(froe_scene_object_count(scene), 1);
    froe_scene_free(scene);
}

#define PLACE(x) "{\"type\":\"Feature\",\"properties\":{\"name\":\"a]}\\\"\"}," POINT(x) "}"
#define POINT(x) "\"geometry\":{\"type\":\"Point\",\"coordinates\":[" #x ",2]}"

/* GDAL reads the first object of a text that it does not take for features in lines. */
static void nothing_stands_behind_an_object_of_json(void **state) {
    (void)state;
    static const struct {
        const char *path, *text, *words; /* words: of the refusal */
        size_t objects;
    } cases[] = {
        {"rows.json", PLACE(1) "\n" PLACE(3) "\n" PLACE(5), NULL, 3},
        {"row.json", PLACE(1) "\n \t\r\n", NULL, 1},
        {"call.json", "loadGeoJSON(" PLACE(1) ");\n", NULL, 1},
        {"mark.json", "\xef\xbb\xbf" PLACE(1) "\n" PLACE(3), "mark.json: line 2: Behind the first object there is", 0},
        {"commas.json", PLACE(1) ",\n" PLACE(3), "commas.json: line 1: Behind the first object", 0},
        {"words.json", PLACE(1) "\n\nwords\n" PLACE(3), "words.json: line 3: Behind the first object", 0},
        {"list.json", PLACE(1) "\n[" PLACE(3) "]", "list.json: line 2: Behind the first object", 0},
        {"lines.json", PLACE(1) " " PLACE(3) "\n" PLACE(5), "lines.json: line 1: Behind the first object", 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        write_text(cases[i].path, cases[i].text);
        if (cases[i].words) {
            refuse(cases[i].path, FROE_E_FORMAT, cases[i].words);
            continue;
        }
        froe_scene *scene = read_scene(cases[i].path, NULL);
        assert_int_equal(froe_scene_object_count(scene), cases[i].objects);
        froe_scene_free(scene);
    }
    write_text("memory.json", PLACE(1));
    assert_true(test_memory_each(read_with_memory, "memory.json") > 2);
}

static void every_allocation_may_fail(void **state) {
    (void)state;
    write_text("memory.csv",
               "id,WKT\n1,\"GEOMETRYCOLLECTION (POINT (1 1),LINESTRING (0 0,1 0))\"\n2,\"POLYGON ((0 0,4 0,4 "
               "4,0 0),(1 0,2 0,2 1,1 0))\"\n");
    write_in("GPKG", "memory.gpkg", "LOCAL_CS[\"a hall\",UNIT[\"metre\",1]]");
    assert_true(test_memory_each(read_with_memory, "memory.csv") > 5);
    assert_true(test_memory_each(read_with_memory, "memory.gpkg") > 3);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(polygons_come_through_every_format),
        cmocka_unit_test(drawings_keep_their_layers_as_materials),
        cmocka_unit_test(a_street_map_gives_nodes_and_ways),
        cmocka_unit_test(objects_keep_the_order_of_feature_part_ring_vertex),
        cmocka_unit_test(rings_that_disagree_have_no_side),
        cmocka_unit_test(curves_become_chords_and_are_counted),
        cmocka_unit_test(broken_geometries_of_a_table_are_refused),
        cmocka_unit_test(what_is_mended_or_left_out_is_counted),
        cmocka_unit_test(coordinates_are_taken_exactly),
        cmocka_unit_test(every_feature_can_be_its_box),
        cmocka_unit_test(nested_collections_are_no_recursion),
        cmocka_unit_test(a_folder_of_several_layers_needs_the_name_of_one),
        cmocka_unit_test(systems_are_of_degrees_or_of_something_else),
        cmocka_unit_test(layers_in_different_systems_are_refused),
        cmocka_unit_test(wrong_filters_are_told_in_a_line),
        cmocka_unit_test(geojson_has_the_system_that_its_member_names),
        cmocka_unit_test(triangles_and_empty_rings_are_read),
        cmocka_unit_test(nothing_stands_behind_an_object_of_json),
        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
