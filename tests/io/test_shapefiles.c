/* test_shapefiles.c: Shapefiles whose parts do not fit together: indices and tables that are missing, cut off, or say
 * other numbers than there are shapes. */
#include "support.h"
#include <gdal.h>
#include <ogr_api.h>
#include <unistd.h>

static const char *const parts[] = {"shp", "shx", "dbf"};
enum { SHP, SHX, DBF, PARTS, MOST = 4096, SHAPES = 3 };
enum { LENGTH = 27, ROWS = 4 }; /* where the last byte of the length of an index is, and the first of rows */
static char bytes[PARTS][MOST];
static size_t sizes[PARTS];

/* Lines from (i, 0) to (i, 1), as GDAL writes them. */
static int write_whole(void **state) {
    (void)state;
    GDALAllRegister();
    GDALDatasetH data = GDALCreate(GDALGetDriverByName("ESRI Shapefile"), "whole.shp", 0, 0, 0, GDT_Unknown, NULL);
    assert_non_null(data);
    OGRLayerH layer = GDALDatasetCreateLayer(data, "whole", NULL, wkbLineString, NULL);
    assert_non_null(layer);
    for (int i = 0; i < SHAPES; i++) {
        OGRFeatureH feature = OGR_F_Create(OGR_L_GetLayerDefn(layer));
        OGRGeometryH line = OGR_G_CreateGeometry(wkbLineString);
        for (int k = 0; k < 2; k++) OGR_G_AddPoint_2D(line, i, k);
        OGR_F_SetGeometryDirectly(feature, line);
        assert_int_equal(OGR_L_CreateFeature(layer, feature), OGRERR_NONE);
        OGR_F_Destroy(feature);
    }
    GDALClose(data);
    for (int i = 0; i < PARTS; i++) {
        char path[16];
        snprintf(path, sizeof path, "whole.%s", parts[i]);
        FILE *file = fopen(path, "rb");
        assert_non_null(file);
        sizes[i] = fread(bytes[i], 1, MOST, file);
        assert_true(sizes[i] > 28 && sizes[i] < MOST);
        fclose(file);
    }
    return 0;
}

/* Writes heads.shp and the files beside it: the first `size` bytes of one, with another byte; -1: it is missing. */
static void write_heads(int changed, long size, int at, int value) {
    for (int i = 0; i < PARTS; i++) {
        char path[16], copy[MOST];
        snprintf(path, sizeof path, "heads.%s", parts[i]);
        unlink(path);
        memcpy(copy, bytes[i], MOST);
        if (i == changed && at) copy[at] = (char)value;
        if (i != changed || size >= 0) write_bytes(path, copy, i == changed && size < MOST ? (size_t)size : sizes[i]);
    }
}

static void parts_that_do_not_fit_are_refused(void **state) {
    (void)state;
    static const struct {
        int changed;
        long size;
        int at, value;
        froe_status status;
        const char *message;
    } cases[] = {
        {DBF, MOST, ROWS, 1, FROE_E_FORMAT, "heads.shp: The table 'heads.dbf' has 1 row, and there are 3 shapes."},
        {DBF, MOST, ROWS, 0, FROE_E_FORMAT, "heads.shp: The table 'heads.dbf' has 0 rows, and there are 3 shapes."},
        {SHX, -1, 0, 0, FROE_E_FORMAT, "heads.shp: OGR reports 'Unable to open heads.shx"},
        {SHX, 0, 0, 0, FROE_E_FORMAT, "heads.shp: OGR reports '.shx file is unreadable, or corrupt.'."},
        {SHX, 20, 0, 0, FROE_E_FORMAT, "heads.shp: OGR reports '.shx file is unreadable, or corrupt.'."},
        {SHX, 104, 0, 0, FROE_E_FORMAT, "heads.shp: OGR reports 'Failed to read all values for 3 records in .shx"},
        {SHX, MOST, LENGTH, 10, FROE_E_FORMAT, "heads.shp: OGR reports 'Record count in .shx header is -10"},
        {SHX, MOST, LENGTH, 48, FROE_E_FORMAT, "heads.shp: The head of the index 'heads.shx' counts 0 shapes, and"},
        {SHX, MOST, LENGTH, 50, FROE_E_FORMAT, "heads.shp: The head of the index 'heads.shx' counts 0 shapes, and"},
        {SHX, MOST, LENGTH, 54, FROE_E_FORMAT, "index 'heads.shx' counts 1 shape, and there are 3."},
        {SHX, MOST, LENGTH, 58, FROE_E_FORMAT, "index 'heads.shx' counts 2 shapes, and there are 3."},
        {SHX, MOST, LENGTH - 1, 1, FROE_E_FORMAT, "heads.shp: OGR reports 'Failed to read all values for 67 records"},
        {SHP, 20, 0, 0, FROE_E_FORMAT, "heads.shp: OGR reports '.shp file is unreadable, or corrupt.'."},
        {SHP, 100, 0, 0, FROE_E_FORMAT, "heads.shp: OGR reports 'Error in fread() reading object of size 88"},
        {SHP, 130, 0, 0, FROE_E_FORMAT, "heads.shp: OGR reports 'Error in fread() reading object of size 88"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        write_heads(cases[i].changed, cases[i].size, cases[i].at, cases[i].value);
        refuse("heads.shp", cases[i].status, cases[i].message);
    }
}

/* GDAL reads all shapes where there is no table that it can read, or one of more rows. */
static void shapes_need_no_table(void **state) {
    (void)state;
    static const struct {
        long size;
        int at, value;
    } cases[] = {{MOST, 0, 0}, {-1, 0, 0}, {0, 0, 0}, {20, 0, 0}, {28, 0, 0}, {MOST, ROWS, 9}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        froe_read_report report;
        write_heads(DBF, cases[i].size, cases[i].at, cases[i].value);
        froe_scene *scene = read_scene("heads.shp", &report);
        assert_string_equal(report.format, "ESRI Shapefile");
        assert_int_equal(froe_scene_object_count(scene), SHAPES);
        for (uint32_t k = 0; k < SHAPES; k++)
            assert_true(corner(scene, k, 0)[0] == k && corner(scene, k, 0)[1] == 0 && corner(scene, k, 1)[1] == 1);
        froe_scene_free(scene);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parts_that_do_not_fit_are_refused),
        cmocka_unit_test(shapes_need_no_table),
    };
    return cmocka_run_group_tests(tests, write_whole, NULL);
}
