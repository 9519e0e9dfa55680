/* Parts of trees, one by one and in the formats of OGR: every kind of shape, what stops, and what is left then. */
#include "support.h"

#include <cpl_conv.h>
#include <dirent.h>
#include <errno.h>
#include <gdal.h>
#include <ogr_api.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

static froe_tree *tree_of(const char *kind, size_t n) {
    froe_scene *scene = NULL;
    froe_tree *tree = NULL;
    froe_diagnostic why;
    if (froe_generate(kind, n, 1, NULL, &scene, &why) || froe_build(scene, NULL, &tree, &why))
        fail_msg("%s", why.message);
    froe_scene_free(scene);
    return tree;
}

static size_t temporary_files(void) {
    DIR *folder = opendir(".");
    size_t count = 0;
    assert_non_null(folder);
    for (struct dirent *entry; (entry = readdir(folder));) count += strncmp(entry->d_name, ".froe", 5) == 0;
    closedir(folder);
    return count;
}

/* ------------------------------------------------------------------- parts -- */

typedef struct tally {
    size_t count, most;
    double sum;
} tally;

static bool count_part(void *user, const froe_part *part) {
    tally *t = user;
    const froe_part like = froe_part_like(part->kind == FROE_KIND_NONE ? FROE_EXPORT_CELLS : FROE_EXPORT_FRAGMENTS);
    assert_int_equal(part->attribute_count, like.attribute_count);
    for (int i = 0; i < like.attribute_count; i++) {
        assert_string_equal(part->attributes[i].name, like.attributes[i].name);
        assert_int_equal(part->attributes[i].text != NULL, like.attributes[i].text != NULL);
    }
    for (size_t i = 0; i < part->corners * (size_t)part->dim; i++) t->sum += part->coords[i];
    return ++t->count < t->most;
}

static bool give_up(void *user, double done) {
    (void)user, (void)done;
    return false;
}

static void parts_are_given_until_it_is_enough(void **state) {
    (void)state;
    froe_tree *tree = tree_of("segments", 2000);
    const froe_report report = froe_tree_report(tree);
    for (int what = 0; what < 3; what++) {
        tally all = {.most = SIZE_MAX}, again = all, few = {.most = 5};
        assert_int_equal(froe_tree_parts(tree, (froe_export_what)what, NULL, count_part, &all, NULL), FROE_OK);
        assert_int_equal(froe_tree_parts(tree, (froe_export_what)what, NULL, count_part, &again, NULL), FROE_OK);
        assert_int_equal(froe_tree_parts(tree, (froe_export_what)what, NULL, count_part, &few, NULL), FROE_OK);
        assert_true(all.count == again.count && all.sum == again.sum && few.count == 5);
        if (what == FROE_EXPORT_FRAGMENTS) assert_int_equal(all.count, report.fragments);
        if (what == FROE_EXPORT_CELLS) assert_true(all.count <= report.leaves && all.count > report.leaves / 2);
    }
    froe_export_options o = froe_export_defaults(), wrong = {0};
    tally all = {.most = SIZE_MAX};
    o.progress = give_up;
    assert_int_equal(froe_tree_parts(tree, FROE_EXPORT_FRAGMENTS, &o, count_part, &all, NULL), FROE_E_CANCELLED);
    assert_true(all.count < report.fragments);
    assert_int_equal(froe_tree_parts(tree, (froe_export_what)3, NULL, count_part, &all, NULL), FROE_E_ARG);
    assert_int_equal(froe_tree_parts(tree, FROE_EXPORT_CUTS, &wrong, count_part, &all, NULL), FROE_E_OPTIONS);
    assert_int_equal(froe_tree_parts(tree, FROE_EXPORT_CUTS, NULL, NULL, NULL, NULL), FROE_E_ARG);
    assert_int_equal(froe_tree_parts(NULL, FROE_EXPORT_CUTS, NULL, count_part, &all, NULL), FROE_E_ARG);
    froe_tree_free(tree);
}

/* -------------------------------------------------------------------- maps -- */

/* One of each kind: what OGR reads from the file is the type, and the WKT. */
static void every_kind_has_its_shape(void **state) {
    (void)state;
    static const struct {
        froe_kind kind;
        double coords[6];
        size_t corners;
        OGRwkbGeometryType type;
        const char *wkt;
    } cases[] = {
        {FROE_POINT, {1, 2}, 1, wkbPoint, "POINT (1 2)"},
        {FROE_SEGMENT, {1, 2, 3, 4.5}, 2, wkbLineString, "LINESTRING (1 2,3.0 4.5)"},
        {FROE_SEGMENT, {1, 2, 1, 2}, 2, wkbLineString, "LINESTRING (1 2,1 2)"},
        {FROE_BOX, {1, 2, 3, 4}, 2, wkbPolygon, NULL},
        {FROE_HULL, {1, 2, 3, 4, 1, 4}, 3, wkbMultiPoint, NULL},
    };
    static const char *const endings[] = {"gpkg", "fgb", "shp"};
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++)
        for (size_t e = 0; e < 3; e++) {
            char path[32], *wkt = NULL;
            froe_scene *scene;
            froe_tree *tree;
            froe_diagnostic why;
            const size_t starts[2] = {0, cases[c].corners};
            froe_objects o = froe_objects_defaults();
            o.kind = cases[c].kind, o.count = 1, o.coords = cases[c].coords;
            if (o.kind == FROE_HULL) o.starts = starts;
            assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
            assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
            assert_int_equal(froe_build(scene, NULL, &tree, NULL), FROE_OK);
            snprintf(path, sizeof path, "kind.%s", endings[e]);
            if (froe_export_map(tree, path, FROE_EXPORT_FRAGMENTS, NULL, &why)) fail_msg("%s", why.message);
            GDALDatasetH data = GDALOpenEx(path, GDAL_OF_VECTOR, NULL, NULL, NULL);
            assert_non_null(data);
            OGRLayerH layer = GDALDatasetGetLayer(data, 0);
            OGRFeatureH feature = OGR_L_GetNextFeature(layer);
            assert_int_equal(OGR_L_GetGeomType(layer), cases[c].type);
            OGR_G_ExportToWkt(OGR_F_GetGeometryRef(feature), &wkt);
            if (cases[c].wkt) assert_string_equal(wkt, cases[c].wkt);
            if (cases[c].type == wkbPolygon) { /* rings may begin anywhere and turn either way */
                OGREnvelope box;
                OGR_G_GetEnvelope(OGR_F_GetGeometryRef(feature), &box);
                assert_true(box.MinX == 1 && box.MinY == 2 && box.MaxX == 3 && box.MaxY == 4);
                assert_true(OGR_G_Area(OGR_F_GetGeometryRef(feature)) == 4);
            }
            CPLFree(wkt);
            OGR_F_Destroy(feature);
            GDALClose(data);
            froe_tree_free(tree);
            froe_scene_free(scene);
        }
    assert_int_equal(temporary_files(), 0);
}

static void what_is_cancelled_leaves_the_old_file(void **state) {
    (void)state;
    static const char *const paths[] = {"old.gpkg", "old.fgb", "old.shp"};
    froe_tree *small = tree_of("segments", 10), *large = tree_of("segments", 3000);
    froe_export_options o = froe_export_defaults(), wrong = {0};
    o.progress = give_up;
    for (int i = 0; i < 3; i++) {
        froe_scene *before, *after;
        froe_diagnostic why;
        if (froe_export_map(small, paths[i], FROE_EXPORT_FRAGMENTS, NULL, &why)) fail_msg("%s", why.message);
        assert_int_equal(froe_read(paths[i], NULL, &before, NULL, NULL), FROE_OK);
        assert_int_equal(froe_export_map(large, paths[i], FROE_EXPORT_FRAGMENTS, &o, &why), FROE_E_CANCELLED);
        assert_int_equal(froe_export_map(large, paths[i], FROE_EXPORT_FRAGMENTS, &wrong, &why), FROE_E_OPTIONS);
        assert_int_equal(froe_export_map(large, paths[i], (froe_export_what)7, NULL, &why), FROE_E_ARG);
        assert_int_equal(froe_read(paths[i], NULL, &after, NULL, NULL), FROE_OK);
        assert_int_equal(froe_scene_object_count(before), froe_scene_object_count(after));
        froe_scene_free(before);
        froe_scene_free(after);
    }
    assert_int_equal(froe_export_map(NULL, "x.gpkg", FROE_EXPORT_CELLS, NULL, NULL), FROE_E_ARG);
    assert_int_equal(froe_export_map(small, NULL, FROE_EXPORT_CELLS, NULL, NULL), FROE_E_ARG);
    assert_int_equal(froe_export_map(small, "x.csv", FROE_EXPORT_CELLS, NULL, NULL), FROE_OK); /* by the core */
    assert_int_equal(temporary_files(), 0);
    froe_tree_free(small);
    froe_tree_free(large);
}

/* Names that are no UTF-8 come out as text, whose broken bytes are marked. */
static void broken_names_are_marked(void **state) {
    (void)state;
    const double x[4] = {0, 0, 1, 1};
    froe_objects o = froe_objects_defaults();
    froe_scene *scene;
    froe_tree *tree;
    o.kind = FROE_SEGMENT, o.count = 1, o.coords = x;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    assert_int_equal(froe_scene_add_group(scene, &(froe_group){.name = "a\xff\xc3\xa9"}, &o.group), FROE_OK);
    assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
    assert_int_equal(froe_build(scene, NULL, &tree, NULL), FROE_OK);
    assert_int_equal(froe_export_map(tree, "names.gpkg", FROE_EXPORT_FRAGMENTS, NULL, NULL), FROE_OK);
    froe_tree_free(tree);
    froe_scene_free(scene);
    assert_int_equal(froe_read("names.gpkg", NULL, &scene, NULL, NULL), FROE_OK);
    assert_string_equal(froe_scene_group(scene, 0).name, "a\xef\xbf\xbd\xc3\xa9");
    froe_scene_free(scene);
}

/* A definition from a tree file must not make GDAL open a file or a connection, as the names of systems may. */
static void definitions_are_read_and_no_names(void **state) {
    (void)state;
    static const char *const definitions[] = {"EPSG:4326", "system.prj", "ESRI::system.prj", ""};
    const double x[4] = {0, 0, 1, 1};
    write_text("system.prj", "GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\",6378137,298.257223563]],"
                             "PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433]]");
    for (size_t i = 0; i < sizeof definitions / sizeof *definitions; i++) {
        froe_objects o = froe_objects_defaults();
        froe_scene *scene;
        froe_tree *tree;
        froe_diagnostic why;
        const froe_crs crs = {FROE_CRS_GEOGRAPHIC, definitions[i], "WGS 84", "EPSG:4326", "degree"};
        o.kind = FROE_SEGMENT, o.count = 1, o.coords = x;
        assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
        assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
        assert_int_equal(froe_scene_set_crs(scene, &crs), FROE_OK);
        assert_int_equal(froe_build(scene, NULL, &tree, NULL), FROE_OK);
        assert_int_equal(froe_export_map(tree, "names.fgb", FROE_EXPORT_FRAGMENTS, NULL, &why), FROE_E_UNSUPPORTED);
        froe_tree_free(tree);
        froe_scene_free(scene);
    }
    unlink("system.prj");
    assert_int_equal(temporary_files(), 0);
}

/* ------------------------------------------------------------------- faults -- */

static size_t objects_of(const char *path) {
    froe_scene *scene = NULL;
    froe_diagnostic why;
    if (froe_read(path, NULL, &scene, NULL, &why)) fail_msg("%s", why.message);
    const size_t count = froe_scene_object_count(scene);
    froe_scene_free(scene);
    return count;
}

/* A disk that is full after some bytes, at every size: OGR tells of it or not. */
static void a_full_disk_leaves_the_old_file(void **state) {
    (void)state;
    static const char *const paths[] = {"full.gpkg", "full.fgb", "full.shp"};
    froe_tree *small = tree_of("segments", 10), *large = tree_of("segments", 1000);
    struct rlimit limit;
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &limit), 0);
    signal(SIGXFSZ, SIG_IGN);
    for (int i = 0; i < 3; i++) {
        assert_int_equal(froe_export_map(small, paths[i], FROE_EXPORT_FRAGMENTS, NULL, NULL), FROE_OK);
        const size_t before = objects_of(paths[i]);
        size_t failed = 0;
        froe_status status = FROE_E_IO;
        for (size_t most = 0; status; most += most / 2 + 64) {
            const struct rlimit few = {most, limit.rlim_max};
            froe_diagnostic why = {.message = ""};
            assert_int_equal(setrlimit(RLIMIT_FSIZE, &few), 0);
            status = froe_export_map(large, paths[i], FROE_EXPORT_FRAGMENTS, NULL, &why);
            assert_int_equal(setrlimit(RLIMIT_FSIZE, &limit), 0);
            if (!status) break;
            if (status != FROE_E_IO || strncmp(why.message, paths[i], strlen(paths[i])) != 0)
                fail_msg("%s, %zu bytes: %s", paths[i], most, why.message);
            assert_int_equal(temporary_files(), 0);
            assert_int_equal(objects_of(paths[i]), before);
            failed++;
        }
        assert_true(failed > 10 && objects_of(paths[i]) > before);
    }
    signal(SIGXFSZ, SIG_DFL);
    froe_tree_free(small), froe_tree_free(large);
}

/* The name is that of a link, or of one of the other files that belong to it. */
static void places_that_cannot_be_taken_are_told(void **state) {
    (void)state;
    froe_tree *tree = tree_of("segments", 100);
    froe_diagnostic why;
    assert_int_equal(symlink("/dev/full", "device.fgb"), 0);
    assert_int_equal(froe_export_map(tree, "device.fgb", FROE_EXPORT_FRAGMENTS, NULL, &why), FROE_E_IO);
    assert_string_equal(why.message, "device.fgb: The file cannot be written: No space left on device.");
    unlink("device.fgb");
    assert_int_equal(system("rm -rf side.*"), 0);                /* of an earlier run */
    static const char *const sides[] = {"side.dbf", "side.qix"}; /* written, and removed */
    for (int i = 0; i < 2; i++) {
        char message[100];
        snprintf(message, sizeof message, "%s: The file cannot be %s: %s.", sides[i], i ? "removed" : "written",
                 strerror(EISDIR));
        assert_int_equal(mkdir(sides[i], 0777), 0);
        assert_int_equal(froe_export_map(tree, "side.shp", FROE_EXPORT_FRAGMENTS, NULL, &why), FROE_E_IO);
        assert_string_equal(why.message, message);
        assert_int_equal(access("side.shp", F_OK), i - 1); /* the one with the shapes is the last that is written */
        rmdir(sides[i]);
    }
    assert_int_equal(temporary_files(), 0);
    froe_tree_free(tree);
}

/* Where no folder can be beside the file, OGR writes where temporary files are. */
static void long_paths_need_another_folder(void **state) {
    (void)state;
    enum { LONG = 4092 };
    static char path[LONG + 1], temporary[LONG + 1], target[LONG + 1];
    froe_tree *tree = tree_of("segments", 100);
    froe_diagnostic why;
    assert_non_null(getcwd(target, sizeof target - 20));
    const size_t here = strlen(target);
    strcat(target, "/behind.fgb");
    assert_int_equal(symlink(target, "x.fgb"), 0);
    for (size_t i = 0; i < LONG; i++) path[i] = "/."[i % 2 == 0];
    memcpy(path + LONG - 6, "/x.fgb", 6);
    const char *old = getenv("TMPDIR");
    char *kept = old ? strdup(old) : NULL;
    const char *const folders[] = {NULL, "", ".", "no/such/folder", temporary};
    snprintf(temporary, sizeof temporary, "%.*s", (int)here, target);
    while (strlen(temporary) < LONG - 12) strcat(temporary, "/.");
    for (size_t i = 0; i < 5; i++) {
        if (folders[i])
            setenv("TMPDIR", folders[i], 1);
        else
            unsetenv("TMPDIR");
        unlink("behind.fgb");
        const froe_status status = froe_export_map(tree, path, FROE_EXPORT_FRAGMENTS, NULL, &why);
        if (status != (i < 3 ? FROE_OK : FROE_E_IO)) fail_msg("%zu: %s", i, why.message);
        if (!status) assert_true(objects_of("behind.fgb") >= 100);
        if (status) assert_non_null(strstr(why.message, i == 3 ? "No such file" : "File name too long"));
        if (status) assert_int_not_equal(access("behind.fgb", F_OK), 0);
    }
    if (kept)
        setenv("TMPDIR", kept, 1);
    else
        unsetenv("TMPDIR");
    free(kept);
    unlink("x.fgb");
    froe_tree_free(tree);
}

/* OGR takes 2047 bytes. Of a longer path it loses the folder, and would write into the one where the program runs. */
static void ogr_is_spared_long_paths(void **state) {
    (void)state;
    static const char *const endings[] = {"shp", "fgb", "gpkg"};
    static const size_t lengths[] = {2000, 2020, 2021, 2047, 2048, 3000};
    static char path[3001];
    froe_tree *tree = tree_of("segments", 100);
    assert_int_equal(system("rm -rf deep far.*; mkdir deep"), 0);
    for (size_t i = 0; i < 3 * (sizeof lengths / sizeof *lengths); i++) {
        const size_t length = lengths[i / 3];
        char name[16];
        froe_diagnostic why;
        snprintf(name, sizeof name, "/far.%s", endings[i % 3]);
        memset(path, '/', length); /* slashes mean one */
        memcpy(path, "deep", 4), strcpy(path + length - strlen(name), name);
        if (froe_export_map(tree, path, FROE_EXPORT_FRAGMENTS, NULL, &why))
            fail_msg("%zu, %s: %s", length, name, why.message);
        snprintf(path, sizeof path, "deep%s", name);
        assert_true(objects_of(path) >= 100);
        assert_int_equal(system("! ls -A deep | grep ^.froe && ! ls -A | grep ^far && rm -r deep/far.*"), 0);
        assert_int_not_equal(access(path, F_OK), 0);
    }
    rmdir("deep");
    froe_tree_free(tree);
}

/* What is no GeoPackage is replaced, and one with other layers is kept. */
static void other_layers_are_not_lost(void **state) {
    (void)state;
    froe_tree *tree = tree_of("segments", 10);
    froe_diagnostic why;
    write_text("junk.gpkg", "this is text");
    assert_int_equal(froe_export_map(tree, "junk.gpkg", FROE_EXPORT_FRAGMENTS, NULL, &why), FROE_OK);
    assert_true(objects_of("junk.gpkg") >= 10);
    GDALDatasetH data = GDALCreate(GDALGetDriverByName("GPKG"), "home.gpkg", 0, 0, 0, GDT_Unknown, NULL);
    assert_non_null(data);
    for (int i = 0; i < 6; i++) {
        char name[40];
        snprintf(name, sizeof name, "a layer whose name is so long: %d", i);
        assert_non_null(GDALDatasetCreateLayer(data, name, NULL, wkbPoint, NULL));
    }
    GDALClose(data);
    assert_int_equal(froe_export_map(tree, "home.gpkg", FROE_EXPORT_FRAGMENTS, NULL, &why), FROE_E_UNSUPPORTED);
    assert_string_equal(why.message,
                        "home.gpkg: Other layers in the file would be lost: a layer whose name is so long: 0, a layer "
                        "whose name is so long: 1, a layer whose name is so long: 2, a layer whose name is so .");
    froe_tree_free(tree);
}

static void a_gdal_without_the_driver_is_told(void **state) {
    (void)state;
    froe_tree *tree = tree_of("segments", 10);
    froe_diagnostic why;
    GDALDriverH driver = GDALGetDriverByName("FlatGeobuf");
    GDALDeregisterDriver(driver);
    unlink("none.fgb"); /* of an earlier run */
    assert_int_equal(froe_export_map(tree, "none.fgb", FROE_EXPORT_FRAGMENTS, NULL, &why), FROE_E_UNSUPPORTED);
    assert_string_equal(why.message, "none.fgb: This GDAL does not write its format.");
    assert_int_not_equal(access("none.fgb", F_OK), 0);
    GDALRegisterDriver(driver);
    assert_int_equal(froe_export_map(tree, "none.fgb", FROE_EXPORT_FRAGMENTS, NULL, &why), FROE_OK);
    froe_tree_free(tree);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parts_are_given_until_it_is_enough),
        cmocka_unit_test(every_kind_has_its_shape),
        cmocka_unit_test(what_is_cancelled_leaves_the_old_file),
        cmocka_unit_test(broken_names_are_marked),
        cmocka_unit_test(definitions_are_read_and_no_names),
        cmocka_unit_test(a_full_disk_leaves_the_old_file),
        cmocka_unit_test(places_that_cannot_be_taken_are_told),
        cmocka_unit_test(long_paths_need_another_folder),
        cmocka_unit_test(ogr_is_spared_long_paths),
        cmocka_unit_test(other_layers_are_not_lost),
        cmocka_unit_test(a_gdal_without_the_driver_is_told),
    };
    GDALAllRegister();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
