/* Scenes from files by the core alone: froe_read_own() and froe_reads_own(). */
#include "support/scenes.h"

static void each_format_that_needs_no_library_is_read(void **state) {
    (void)state;
    static const struct {
        const char *path, *text, *format;
        int dim;
        size_t objects;
    } files[] = {
        {"own.csv", "x,y,r\n0,1,2\n3,4,5\n", "CSV balls", 2, 2},
        {"own.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nl 3 4\n", "OBJ", 3, 3},
        {"own.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "OFF", 3, 1},
        {"own.ply",
         "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
         "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
         "PLY", 3, 1},
        {"own.geojson",
         "{\"type\":\"FeatureCollection\",\"features\":[{\"type\":\"Feature\",\"properties\":{},\"geometry\":"
         "{\"type\":\"LineString\",\"coordinates\":[[0,0],[1,0],[0,1]]}}]}",
         "GeoJSON", 2, 2},
        {"own", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "OFF", 3, 1}, /* by its content */
        {"counts.off", "# no word\n3 1\n0 0 0\n1 0 0 # a corner\n0 1 0\n3 0 1 2\n", "OFF", 3, 1},
        {"lines.off", "OFF\n3\n1\n0\n0 0 0 1 0 0 0 1 0\n3 0 1 2\n", "OFF", 3, 1},
        {"cloud.off", "OFF 3 0 0\n0 0 0\n1 0 0\n0 1 0\n", "OFF", 3, 3},
        {"cloud.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", "OBJ", 3, 3},
        {"own", " # one\n# OFF\n\nOFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "OFF", 3, 1},
    };
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        froe_read_report report;
        write_text(files[i].path, files[i].text);
        assert_true(froe_reads_own(files[i].path));
        froe_scene *scene = read_scene(files[i].path, &report);
        assert_string_equal(report.format, files[i].format);
        assert_int_equal(froe_scene_dim(scene), files[i].dim);
        assert_int_equal(froe_scene_object_count(scene), files[i].objects);
        froe_scene_free(scene);
    }
}

/* The mark is no part of the text: a word, a number or a header behind it is read as without it. */
static void a_byte_order_mark_before_a_text_is_passed_over(void **state) {
    (void)state;
    static const char *const files[][2] = {
        {"mark.csv", "\xef\xbb\xbfx,y,z\n0,0,0\n1,1,1\n"},
        {"mark.obj", "\xef\xbb\xbfv 0 0 0\nv 1 0 1\nv 0 1 0\nv 7 7 7\nmtllib mark.mtl\nusemtl red\nf 1 2 3\n"},
        {"mark.off", "\xef\xbb\xbfOFF\n3 1 0\n0 0 0\n1 0 1\n0 1 0\n3 0 1 2\n"},
        {"mark.ply", "\xef\xbb\xbfply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\n"
                     "property double z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
                     "0 0 0\n1 0 1\n0 1 0\n3 0 1 2\n"},
    };
    write_text("mark.mtl", "\xef\xbb\xbfnewmtl red\nKd 1 0 0\n");
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        froe_read_report report;
        double lo[3], hi[3];
        write_text(files[i][0], files[i][1]);
        assert_true(froe_reads_own(files[i][0]));
        froe_scene *scene = read_scene(files[i][0], &report);
        assert_true(froe_scene_bounds(scene, lo, hi));
        for (int k = 0; k < 3; k++) assert_true(lo[k] == 0 && hi[k] == 1);
        if (froe_scene_group_count(scene)) assert_int_equal(froe_scene_group(scene, 0).colour, 0xff0000ff);
        froe_scene_free(scene);
    }
}

/* Colours of a face, as written behind it, and of its corners. */
static void faces_of_off_have_their_colours(void **state) {
    (void)state;
    static const char head[] = "4 4 6\n",
                      tail[] = "3 0 1 2\n3 0 1 3 255 0 0 # red\n3 0 2 3 0.0 0.5 1 0.25\n3 1 2 3 255 0 0\n";
    static const struct {
        const char *word, *corners;
        uint32_t colour; /* of the first face; FROE_NONE: it has no group */
    } files[] = {
        {"OFF\n", "0 0 0\n1 0 0\n0 1 0\n0 0 1\n", FROE_NONE},
        {"COFF # colours\n", "0 0 0 255 0 0 255\n1 0 0 0 255 0 255\n0 1 0 0 0 255 255\n0 0 1 0 0 0 0\n", 0x555555ff},
        {"CNOFF\n", "0 0 0 1 1 1 .5 .5 .5\n1 0 0 1 1 1 0.5 0.5 0.5\n0 1 0 1 1 1 0.5 0.5 0.5 1\n0 0 1 0 0 1 0 0 0 0\n",
         0x808080ff},
        {"STOFF\n", "0 0 0 0.1 0.2\n1 0 0 0 0\n0 1 0 1 1\n0 0 1 0 0\n", FROE_NONE},
    };
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        char text[400];
        snprintf(text, sizeof text, "%s%s%s%s", files[i].word, head, files[i].corners, tail);
        write_text("paint.off", text);
        froe_scene *scene = read_scene("paint.off", NULL);
        assert_int_equal(froe_scene_object_count(scene), 4);
        const uint32_t first = froe_scene_object(scene, 0).group, red = froe_scene_object(scene, 1).group;
        if (files[i].colour == FROE_NONE)
            assert_int_equal(first, FROE_NONE);
        else
            assert_int_equal(froe_scene_group(scene, first).colour, files[i].colour);
        assert_int_equal(froe_scene_group(scene, red).colour, 0xff0000ff);
        assert_int_equal(froe_scene_group(scene, froe_scene_object(scene, 2).group).colour, 0x0080ff40);
        assert_int_equal(froe_scene_object(scene, 3).group, red);
        froe_scene_free(scene);
    }
}

static uint32_t colour_of(const froe_scene *scene, uint32_t object) {
    const uint32_t group = froe_scene_object(scene, object).group;
    return group == FROE_NONE ? 0 : froe_scene_group(scene, group).colour;
}

static void faces_of_ply_have_their_colours(void **state) {
    (void)state;
    static const char vertices[] = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                                   "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n",
                      faces[] = "element face 2\nproperty list uchar int vertex_indices\n",
                      colours[] =
                          "property float red\nproperty float green\nproperty float blue\nproperty float alpha\n";
    char text[600];
    snprintf(text, sizeof text, "%s%send_header\n0 0 0 255 0 0\n1 0 0 0 255 0\n0 1 0 0 0 255\n3 0 1 2\n2 0 1\n",
             vertices, faces);
    write_text("vertices.ply", text);
    froe_scene *scene = read_scene("vertices.ply", NULL);
    assert_int_equal(colour_of(scene, 0), 0x555555ff);
    assert_int_equal(colour_of(scene, 1), 0x808000ff);
    froe_scene_free(scene);
    snprintf(text, sizeof text,
             "%s%s%send_header\n0 0 0 255 0 0\n1 0 0 0 255 0\n0 1 0 0 0 255\n3 0 1 2 0 0 1 0.5\n3 2 1 0 0 0 1 0.5\n",
             vertices, faces, colours);
    write_text("faces.ply", text);
    scene = read_scene("faces.ply", NULL);
    assert_int_equal(colour_of(scene, 0), 0x0000ff80);
    assert_int_equal(froe_scene_group_count(scene), 1);
    froe_scene_free(scene);
}

/* A thousand colours, each twice: the table of groups grows and finds them again. */
static void each_colour_is_one_group(void **state) {
    (void)state;
    FILE *file = fopen("many.off", "w");
    assert_non_null(file);
    fprintf(file, "OFF\n3 2000 0\n0 0 0\n1 0 0\n0 1 0\n");
    for (int i = 0; i < 2000; i++) fprintf(file, "3 0 1 2 %d %d 7\n", i % 1000 / 250, i % 250);
    assert_int_equal(fclose(file), 0);
    froe_scene *scene = read_scene("many.off", NULL);
    assert_int_equal(froe_scene_group_count(scene), 1000);
    for (uint32_t i = 0; i < 1000; i++) {
        assert_int_equal(colour_of(scene, i), i / 250 << 24 | i % 250 << 16 | 0x7ff);
        assert_int_equal(froe_scene_object(scene, i).group, froe_scene_object(scene, i + 1000).group);
    }
    froe_scene_free(scene);
}

#define OTHERS "is neither CSV, OFF, OBJ or PLY nor a collection of features in GeoJSON"
static void other_formats_are_refused(void **state) {
    (void)state;
    static const struct {
        const char *path, *text, *words;
    } files[] = {
        {"other.geojson", "{\"type\":\"Feature\",\"properties\":{},\"geometry\":null}", OTHERS},
        {"wkt.csv", "name,WKT\na,POINT (1 2)\n", OTHERS},
        {"other.stl", "solid a\nendsolid a\n", OTHERS},
        {"other.mfjson", "{}", "holds moving features"},
    };
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        write_text(files[i].path, files[i].text);
        assert_false(froe_reads_own(files[i].path));
        refuse(files[i].path, FROE_E_UNSUPPORTED, files[i].words);
    }
}

static void what_cannot_be_read_is_refused(void **state) {
    (void)state;
    assert_false(froe_reads_own(NULL));
    assert_false(froe_reads_own("nowhere.csv"));
    assert_false(froe_reads_own("."));
    refuse("nowhere.csv", FROE_E_IO, "No such file");
    refuse(".", FROE_E_IO, "is a directory, not a file");
    write_text("empty.csv", "");
    assert_false(froe_reads_own("empty.csv"));
    refuse("empty.csv", FROE_E_FORMAT, "is empty");
    write_text("layer.csv", "x,y\n1,2\n");
    froe_read_options options = froe_read_defaults();
    options.layer = "roads";
    refuse_with("layer.csv", &options, FROE_E_OPTIONS, "The file is not a map, and has no layers.");
    options.size = 1;
    refuse_with("layer.csv", &options, FROE_E_OPTIONS, "The options do not come");
    froe_diagnostic why;
    assert_int_equal(froe_read_own("layer.csv", NULL, NULL, NULL, &why), FROE_E_ARG);
    assert_non_null(strstr(why.message, "froe_read_own is NULL"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_format_that_needs_no_library_is_read),
        cmocka_unit_test(a_byte_order_mark_before_a_text_is_passed_over),
        cmocka_unit_test(faces_of_off_have_their_colours),
        cmocka_unit_test(faces_of_ply_have_their_colours),
        cmocka_unit_test(each_colour_is_one_group),
        cmocka_unit_test(other_formats_are_refused),
        cmocka_unit_test(what_cannot_be_read_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
