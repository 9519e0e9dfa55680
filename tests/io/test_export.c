/* Files from trees: fragments, cells and cuts in every format, read back by this
 * library and by OGR; atomic writing; full disks. */
#include "support.h"
#include <gdal.h>
#include <math.h>
#include <ogr_api.h>
#include <sys/stat.h>
#include <unistd.h>

static froe_scene *generated(const char *kind, size_t n) {
    froe_scene *scene = NULL;
    froe_diagnostic why;
    if (froe_generate(kind, n, 1, NULL, &scene, &why)) fail_msg("%s", why.message);
    return scene;
}

static froe_tree *tree_of(froe_scene *scene, uint32_t leaf) {
    froe_tree *tree = NULL;
    froe_diagnostic why;
    froe_build_options options = froe_build_defaults();
    options.leaf = leaf;
    if (froe_build(scene, &options, &tree, &why)) fail_msg("%s", why.message);
    froe_scene_free(scene);
    return tree;
}

static void export_to(const froe_tree *tree, const char *path, froe_export_what what) {
    froe_diagnostic why;
    if (froe_export(tree, path, what, NULL, &why)) fail_msg("%s", why.message);
}

static double length_of(const froe_scene *scene) {
    double sum = 0;
    for (uint32_t i = 0; i < froe_scene_object_count(scene); i++) {
        edge e = edge_of(scene, i);
        sum += hypot(e.at[2] - e.at[0], e.at[3] - e.at[1]);
    }
    return sum;
}

static void fragments_of_segments_make_up_the_scene(void **state) {
    (void)state;
    froe_tree *tree = tree_of(generated("segments", 500), 0);
    froe_report report = froe_tree_report(tree);
    static const char *const paths[] = {"pieces.geojson", "pieces.csv"};
    for (int i = 0; i < 2; i++) {
        export_to(tree, paths[i], FROE_EXPORT_FRAGMENTS);
        froe_scene *back = read_scene(paths[i], NULL);
        assert_int_equal(froe_scene_object_count(back), report.fragments);
        assert_float_equal(length_of(back), length_of(froe_tree_scene(tree)), 1e-9);
        froe_scene_free(back);
    }
    froe_tree_free(tree);
}

/* The attributes of every exported piece name the object it came from, and its corners lie there. */
static void fragments_carry_ids_and_names(void **state) {
    (void)state;
    froe_tree *tree = tree_of(read_scene(FROE_TEST_DATA "/states-albers-10m.json", NULL), 1);
    const froe_scene *scene = froe_tree_scene(tree);
    export_to(tree, "states.geojson", FROE_EXPORT_FRAGMENTS);
    GDALDatasetH data = GDALOpenEx("states.geojson", GDAL_OF_VECTOR, NULL, NULL, NULL);
    assert_non_null(data);
    OGRLayerH layer = GDALDatasetGetLayer(data, 0);
    assert_int_equal(OGR_L_GetFeatureCount(layer, TRUE), froe_tree_report(tree).fragments);
    OGRFeatureH feature;
    while ((feature = OGR_L_GetNextFeature(layer))) {
        uint32_t id = (uint32_t)OGR_F_GetFieldAsInteger64(feature, OGR_F_GetFieldIndex(feature, "object"));
        froe_object object = froe_scene_object(scene, id);
        assert_int_equal(OGR_F_GetFieldAsInteger64(feature, OGR_F_GetFieldIndex(feature, "face")), object.face);
        assert_int_equal(OGR_F_GetFieldAsInteger64(feature, OGR_F_GetFieldIndex(feature, "group")), object.group);
        assert_int_equal(OGR_F_GetFieldAsInteger64(feature, OGR_F_GetFieldIndex(feature, "tag")), object.tag);
        assert_string_equal(OGR_F_GetFieldAsString(feature, OGR_F_GetFieldIndex(feature, "name")),
                            froe_scene_group(scene, object.group).name);
        OGRGeometryH piece = OGR_F_GetGeometryRef(feature);
        edge whole = edge_of(scene, id);
        for (int i = 0; i < OGR_G_GetPointCount(piece); i++) {
            assert_true(OGR_G_GetX(piece, i) >= whole.at[0] - 1e-9 && OGR_G_GetX(piece, i) <= whole.at[2] + 1e-9);
        }
        OGR_F_Destroy(feature);
    }
    GDALClose(data);
    froe_tree_free(tree);
}

static double area_of_polygons(const char *path, uint64_t *count) {
    GDALDatasetH data = GDALOpenEx(path, GDAL_OF_VECTOR, NULL, NULL, NULL);
    assert_non_null(data);
    OGRLayerH layer = GDALDatasetGetLayer(data, 0);
    OGRFeatureH feature;
    double sum = 0;
    for (*count = 0; (feature = OGR_L_GetNextFeature(layer)); ++*count) {
        sum += OGR_G_Area(OGR_F_GetGeometryRef(feature));
        OGR_F_Destroy(feature);
    }
    GDALClose(data);
    return sum;
}

static void cells_tile_the_box(void **state) {
    (void)state;
    froe_tree *tree = tree_of(generated("rooms", 300), 1);
    const double lo[2] = {-10, -20}, hi[2] = {990, 980};
    froe_export_options options = froe_export_defaults();
    options.lo = lo;
    options.hi = hi;
    froe_diagnostic why;
    if (froe_export(tree, "cells.geojson", FROE_EXPORT_CELLS, &options, &why)) fail_msg("%s", why.message);
    uint64_t cells;
    assert_float_equal(area_of_polygons("cells.geojson", &cells), 1000.0 * 1000, 1e-3);
    const froe_report report = froe_tree_report(tree);
    assert_in_range(cells, report.leaves / 2, report.leaves); /* regions without inside are no cells to show */
    export_to(tree, "cuts.geojson", FROE_EXPORT_CUTS);
    froe_scene *cuts = read_scene("cuts.geojson", NULL);
    assert_in_range(froe_scene_object_count(cuts), (report.nodes - report.leaves) / 2, report.nodes - report.leaves);
    froe_scene_free(cuts);
    froe_tree_free(tree);
}

static double surface_of(const froe_scene *scene) {
    double sum = 0;
    for (uint32_t i = 0; i < froe_scene_object_count(scene); i++) {
        froe_object o = froe_scene_object(scene, i);
        if (o.form != FROE_POLYGON) continue;
        const double *a = corner(scene, i, 0), *b = corner(scene, i, 1), *c = corner(scene, i, 2);
        double u[3], v[3];
        for (int k = 0; k < 3; k++) u[k] = b[k] - a[k], v[k] = c[k] - a[k];
        double x = u[1] * v[2] - u[2] * v[1], y = u[2] * v[0] - u[0] * v[2], z = u[0] * v[1] - u[1] * v[0];
        sum += 0.5 * sqrt(x * x + y * y + z * z);
    }
    return sum;
}

static void polygons_in_space_go_to_obj_and_csv(void **state) {
    (void)state;
    froe_tree *tree = tree_of(generated("cuboids", 240), 0);
    export_to(tree, "pieces.obj", FROE_EXPORT_FRAGMENTS);
    froe_scene *back = read_scene("pieces.obj", NULL);
    assert_float_equal(surface_of(back), surface_of(froe_tree_scene(tree)), 1e-9);
    assert_true(froe_scene_group_count(back) > 0);
    assert_non_null(strstr(froe_scene_group(back, 0).name, "object="));
    froe_scene_free(back);
    export_to(tree, "cells.obj", FROE_EXPORT_CELLS);
    back = read_scene("cells.obj", NULL);
    assert_true(froe_scene_object_count(back) >= 2 * froe_tree_report(tree).leaves);
    froe_scene_free(back);
    export_to(tree, "cells-3d.csv", FROE_EXPORT_CELLS);
    froe_read_report report;
    froe_scene_free(read_scene("cells-3d.csv", &report));
    assert_in_range(report.features, froe_tree_report(tree).leaves / 2, froe_tree_report(tree).leaves);
    froe_tree_free(tree);
}

static void boxes_become_polygons_and_surfaces(void **state) {
    (void)state;
    froe_tree *tree = tree_of(generated("boxes", 50), 4);
    export_to(tree, "boxes.geojson", FROE_EXPORT_FRAGMENTS);
    froe_scene *back = read_scene("boxes.geojson", NULL);
    assert_int_equal(froe_scene_object_count(back), 4 * froe_tree_report(tree).fragments);
    froe_scene_free(back);
    froe_tree_free(tree);
    tree = tree_of(generated("boxes-3d", 50), 4);
    export_to(tree, "boxes.obj", FROE_EXPORT_FRAGMENTS);
    froe_read_report report;
    back = read_scene("boxes.obj", &report);
    assert_int_equal(report.triangulated, 6 * froe_tree_report(tree).fragments);
    assert_int_equal(froe_scene_object_count(back), 12 * froe_tree_report(tree).fragments);
    froe_scene_free(back);
    froe_tree_free(tree);
    tree = tree_of(generated("points-8d", 50), 4);
    export_to(tree, "points.csv", FROE_EXPORT_FRAGMENTS);
    froe_tree_free(tree);
}

/* --------------------------------------------------------------- refusals -- */

static void refuse_export(const froe_tree *tree, const char *path, froe_export_what what, froe_status expected) {
    froe_diagnostic why = {.message = ""};
    assert_int_equal(froe_export(tree, path, what, NULL, &why), expected);
    assert_int_equal(why.status, expected);
    assert_non_null(strstr(why.message, path));
}

static void what_does_not_fit_is_refused(void **state) {
    (void)state;
    froe_tree *plane = tree_of(generated("segments", 20), 1), *space = tree_of(generated("triangles", 20), 1);
    froe_tree *beyond = tree_of(generated("points-8d", 20), 1);
    refuse_export(plane, "no.obj", FROE_EXPORT_FRAGMENTS, FROE_E_UNSUPPORTED);
    refuse_export(space, "no.geojson", FROE_EXPORT_FRAGMENTS, FROE_E_UNSUPPORTED);
    refuse_export(beyond, "no.csv", FROE_EXPORT_CELLS, FROE_E_UNSUPPORTED);
    refuse_export(plane, "no.xyz", FROE_EXPORT_CUTS, FROE_E_UNSUPPORTED);
    refuse_export(plane, "nowhere/no.csv", FROE_EXPORT_CUTS, FROE_E_IO);
    mkdir("folder.csv", 0777);
    refuse_export(plane, "folder.csv", FROE_EXPORT_CUTS, FROE_E_IO);
    froe_export_options options = {.size = 1};
    assert_int_equal(froe_export(plane, "no.csv", FROE_EXPORT_CUTS, &options, NULL), FROE_E_OPTIONS);
    assert_int_equal(froe_export(NULL, "no.csv", FROE_EXPORT_CUTS, NULL, NULL), FROE_E_ARG);
    assert_int_equal(froe_export(plane, "no.csv", (froe_export_what)9, NULL, NULL), FROE_E_ARG);
    assert_int_not_equal(access("no.csv", F_OK), 0);
    froe_tree_free(plane);
    froe_tree_free(space);
    froe_tree_free(beyond);
}

static void scenes_that_do_not_fit_their_file_are_refused(void **state) {
    (void)state;
    static const char *const pairs[][2] = {{"triangles", "t.csv"}, {"segments", "a.obj"}, {"triangles", "a.geojson"},
                                           {"balls", "a.geojson"}, {"boxes-3d", "a.off"}, {"points", "a.txt"}};
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        froe_scene *scene = generated(pairs[i][0], 5);
        froe_diagnostic why;
        assert_int_equal(froe_write_scene(scene, pairs[i][1], &why), FROE_E_UNSUPPORTED);
        assert_non_null(strstr(why.message, pairs[i][1]));
        assert_int_not_equal(access(pairs[i][1], F_OK), 0);
        froe_scene_free(scene);
    }
}

static bool stop_late(void *user, double done) {
    int *calls = user;
    assert_true(done >= 0 && done <= 1);
    return --*calls > 0;
}

static void a_file_is_whole_or_as_it_was(void **state) {
    (void)state;
    froe_tree *tree = tree_of(generated("segments", 5000), 1);
    write_text("kept.csv", "precious");
    int calls = 2;
    froe_export_options options = froe_export_defaults();
    options.progress = stop_late;
    options.user = &calls;
    assert_int_equal(froe_export(tree, "kept.csv", FROE_EXPORT_FRAGMENTS, &options, NULL), FROE_E_CANCELLED);
    char text[16] = "";
    FILE *file = fopen("kept.csv", "r");
    assert_non_null(fgets(text, sizeof text, file));
    fclose(file);
    assert_string_equal(text, "precious");
    calls = 1 << 30;
    chmod("kept.csv", 0640);
    assert_int_equal(froe_export(tree, "kept.csv", FROE_EXPORT_FRAGMENTS, &options, NULL), FROE_OK);
    struct stat about;
    assert_int_equal(stat("kept.csv", &about), 0);
    assert_int_equal(about.st_mode & 0777, 0640);
    froe_tree_free(tree);
}

static void a_link_stays_a_link(void **state) {
    (void)state;
    froe_tree *tree = tree_of(generated("segments", 50), 1);
    write_text("behind.csv", "old");
    unlink("link.csv");
    assert_int_equal(symlink("behind.csv", "link.csv"), 0);
    assert_int_equal(froe_export(tree, "link.csv", FROE_EXPORT_FRAGMENTS, NULL, NULL), FROE_OK);
    froe_tree_free(tree);
    struct stat about;
    assert_int_equal(lstat("link.csv", &about), 0);
    assert_true(S_ISLNK(about.st_mode));
    assert_int_equal(stat("behind.csv", &about), 0);
    assert_true(about.st_size > 100);
}

static void a_full_disk_is_told(void **state) {
    (void)state;
    if (access("/dev/full", W_OK)) skip();
    unlink("full.csv");
    assert_int_equal(symlink("/dev/full", "full.csv"), 0);
    froe_tree *tree = tree_of(generated("segments", 50), 1);
    froe_diagnostic why;
    assert_int_equal(froe_export(tree, "full.csv", FROE_EXPORT_FRAGMENTS, NULL, &why), FROE_E_IO);
    assert_non_null(strstr(why.message, "No space left"));
    assert_int_equal(froe_write_scene(froe_tree_scene(tree), "full.csv", &why), FROE_E_IO);
    froe_scene *points = generated("points", 5000);
    assert_int_equal(froe_write_scene(points, "full.csv", &why), FROE_E_IO);
    froe_scene_free(points);
    froe_tree_free(tree);
    struct stat about;
    assert_int_equal(lstat("full.csv", &about), 0);
    assert_true(S_ISLNK(about.st_mode)); /* the device is still what it was */
}

static void names_are_quoted(void **state) {
    (void)state;
    froe_scene *scene = NULL;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    static const double coords[] = {0, 0, 1, 0, 1, 0, 1, 1};
    froe_group group = {.name = "say \"x\\y\",\n\tnow; \xc3\xa9 \xff", .material = "m"};
    uint32_t id;
    assert_int_equal(froe_scene_add_group(scene, &group, &id), FROE_OK);
    froe_objects batch = froe_objects_defaults();
    batch.kind = FROE_SEGMENT;
    batch.count = 2;
    batch.coords = coords;
    batch.group = id;
    assert_int_equal(froe_scene_add(scene, &batch, NULL), FROE_OK);
    assert_int_equal(froe_write_scene(scene, "quoted.geojson", NULL), FROE_OK);
    froe_scene *back = read_scene("quoted.geojson", NULL);
    assert_true(scene_hash(back) == scene_hash(scene));
    assert_string_equal(froe_scene_group(back, 0).name, "say \"x\\y\",\n\tnow; \xc3\xa9 \xef\xbf\xbd");
    assert_string_equal(froe_scene_group(back, 0).material, "m");
    froe_scene_free(back);
    froe_tree *tree = tree_of(scene, 1);
    export_to(tree, "quoted.csv", FROE_EXPORT_FRAGMENTS);
    back = read_scene("quoted.csv", NULL);
    assert_int_equal(froe_scene_object_count(back), froe_tree_report(tree).fragments);
    froe_scene_free(back);
    froe_tree_free(tree);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fragments_of_segments_make_up_the_scene),
        cmocka_unit_test(fragments_carry_ids_and_names),
        cmocka_unit_test(cells_tile_the_box),
        cmocka_unit_test(polygons_in_space_go_to_obj_and_csv),
        cmocka_unit_test(boxes_become_polygons_and_surfaces),
        cmocka_unit_test(what_does_not_fit_is_refused),
        cmocka_unit_test(scenes_that_do_not_fit_their_file_are_refused),
        cmocka_unit_test(a_file_is_whole_or_as_it_was),
        cmocka_unit_test(a_link_stays_a_link),
        cmocka_unit_test(a_full_disk_is_told),
        cmocka_unit_test(names_are_quoted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
