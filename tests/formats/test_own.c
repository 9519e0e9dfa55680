/* Scenes from files by the core alone: froe_read_own() and froe_reads_own(). */
#include "support/scenes.h"

typedef struct read_text {
    const char *path, *text, *format;
    int dim;
    size_t objects;
} read_text;

static void check_reads(const read_text *files, size_t count) {
    for (size_t i = 0; i < count; i++) {
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

typedef struct refused_text {
    const char *text;
    froe_status status;
    const char *words;
} refused_text;

static void check_refusals(const char *path, const refused_text *files, size_t count) {
    for (size_t i = 0; i < count; i++) {
        write_text(path, files[i].text);
        refuse(path, files[i].status, files[i].words);
    }
}

static void each_format_that_needs_no_library_is_read(void **state) {
    (void)state;
    static const read_text files[] = {
        {"own.csv", "x,y,r\n0,1,2\n3,4,5\n", "CSV balls", 2, 2},
        {"own.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nl 3 4\n", "OBJ", 3, 3},
        {"own.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "OFF", 3, 1},
        {"own.ply",
         "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
         "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
         "PLY", 3, 1},
        {"returns.obj", "v 0 0 0\rv 1 0 0\rv 0 1 0\rv 0 0 1\rf 1 2 3\rf 1 2 4\rl 3 4\r", "OBJ", 3, 3},
        {"mixed.obj", "v 0 0 0\rv 1 0 0\r\nv 0 1 0\rv 0 0 1\rf 1 2 3\rf 1 2 4\rl 3 4\n", "OBJ", 3, 3},
        {"mixed.off", "OFF # corners\r3 1 0\r\n0 0 0\r1 0 0 # a corner\r0 1 0\r3 0 1 2\n", "OFF", 3, 1},
        {"returns.off", "OFF # corners\r3 1 0\r0 0 0\r1 0 0 # a corner\r0 1 0\r3 0 1 2\r", "OFF", 3, 1},
        {"returns.csv", "x,y\r1,2\r3,4\r", "CSV points", 2, 2},
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
    check_reads(files, sizeof files / sizeof *files);
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

#define PLY_VERTICES "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
#define PLY_FACE "element face 1\nproperty list uchar int vertex_indices\n"
#define PLY_CORNERS "end_header\n0 0 0\n1 0 0\n0 1 0\n"
#define PLY_ELEMENT "ply\nformat ascii 1.0\nelement vertex "

static void broken_ply_is_refused_with_its_reason(void **state) {
    (void)state;
    static const char *const files[][2] = {
        {"no ply\n", "broken.ply: The file does not begin like PLY."},
        {"ply\nformat ascii 1.0\nproperty float x\nend_header\n", "A property belongs to no element."},
        {PLY_ELEMENT "\nend_header\n", "An element has no count."},
        {PLY_ELEMENT "-1\nend_header\n", "An element has no count."},
        {PLY_ELEMENT "many\nend_header\n", "An element has no count."},
        {PLY_ELEMENT "3e0\nend_header\n", "An element has no count."},
        {PLY_ELEMENT "3\nproperty half x\nend_header\n", "A property is of unknown type."},
        {PLY_ELEMENT "3\nproperty list uchar half x\nend_header\n", "A property is of unknown type."},
        {PLY_ELEMENT "3\nproperty list half uchar x\nend_header\n", "A property is of unknown type."},
        {PLY_ELEMENT "3\nproperty list float uchar x\nend_header\n", "A property is of unknown type."},
        {PLY_ELEMENT "3\nproperty an_utterly_long_word_that_is_no_type_of_numbers x\nend_header\n",
         "A property is of unknown type."},
        {PLY_VERTICES PLY_FACE PLY_CORNERS, "The data end too early."},
        {PLY_VERTICES PLY_FACE PLY_CORNERS "3 0 1\n", "The data end too early, or hold no number."},
        {PLY_VERTICES PLY_FACE PLY_CORNERS "3 0 1 two\n", "The data end too early, or hold no number."},
        {PLY_VERTICES PLY_FACE PLY_CORNERS "-3 0 1 2\n", "The length of a list is no whole number."},
        {PLY_VERTICES PLY_FACE PLY_CORNERS "2.5 0 1 2\n", "The length of a list is no whole number."},
        {PLY_VERTICES PLY_FACE PLY_CORNERS "nan 0 1 2\n", "The length of a list is no whole number."},
        {PLY_VERTICES PLY_FACE PLY_CORNERS "300 0 1 2\n", "A list is longer than the file."},
        {PLY_VERTICES PLY_FACE PLY_CORNERS "3 0 1 2\n\n3 2 1 0\n", "There is more than its counts say."},
        {PLY_VERTICES PLY_FACE PLY_CORNERS "3 0 1 3\n", "face 0: A face or edge names a vertex that does not exist"},
        {PLY_VERTICES PLY_FACE PLY_CORNERS "3 0 1 -1\n", "A face or edge names a vertex that does not exist"},
        {PLY_VERTICES PLY_FACE PLY_CORNERS "3 0 1 1.5\n", "A face or edge names a vertex that does not exist"},
        {PLY_VERTICES "element edge 1\nproperty int vertex1\nproperty int vertex2\n" PLY_CORNERS "7 1\n",
         "A face or edge names a vertex that does not exist"},
    };
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        write_text("broken.ply", files[i][0]);
        refuse("broken.ply", FROE_E_FORMAT, files[i][1]);
    }
#define PLY_BINARY(vertices, faces)                                                                                    \
    "ply\nformat binary_big_endian 1.0\nelement vertex " vertices "\nproperty uchar x\nproperty uchar y\nproperty "    \
    "uchar z\nelement face " faces "\nproperty list uchar short vertex_index\nend_header\n"
    static const char whole[] = PLY_BINARY("3", "1") "000100110\3\0\0\0\1\0\2\0\0\0",
                      points[] = PLY_BINARY("3", "0") "000100110";
    const size_t faces = sizeof whole - 4, all = sizeof points - 1; /* without what stands behind */
    for (size_t behind = 0; behind < 4; behind++) {
        write_bytes("binary.ply", whole, faces + behind);
        if (behind < 3)
            froe_scene_free(read_scene("binary.ply", NULL));
        else
            refuse("binary.ply", FROE_E_FORMAT, "binary.ply: There is more than its counts say.");
    }
    write_bytes("binary.ply", points, all);
    froe_scene_free(read_scene("binary.ply", NULL));
    write_bytes("binary.ply", PLY_BINARY("2", "0") "000100110", all);
    refuse("binary.ply", FROE_E_FORMAT, "binary.ply: There is more than its counts say.");
    FILE *file = fopen("broken.ply", "w");
    assert_non_null(file);
    fputs(PLY_ELEMENT "1\n", file);
    for (int i = 0; i < 65; i++) fprintf(file, "property float x%d\n", i);
    assert_int_equal(fclose(file), 0);
    refuse("broken.ply", FROE_E_FORMAT, "An element has more than 64 properties.");
}

/* Lines that end like old ones of the Mac; elements, lists and properties that are of other names or sorts. */
static void what_ply_has_beside_faces_is_passed_over(void **state) {
    (void)state;
    static const char *const files[] = {
        "ply\rformat ascii 1.0\relement vertex 3\rproperty float x\rproperty float y\rproperty float z\relement face "
        "1\r"
        "property list uchar int vertex_index\rend_header\r0 0 0\r1 0 2\r0 1 0\r3 0 1 2\r",
        "ply\r\nformat ascii 1.0\r\ncomment two\r\nelement rows 2\r\nproperty list uint8 int16 of\r\nproperty float "
        "x\r\n"
        "element vertex 3\r\nproperty list uchar float x\r\nproperty double x\r\nproperty double xy\r\n"
        "property float y\r\nproperty float w\r\nproperty float z\r\nproperty list char char red\r\n"
        "element face 2\r\nproperty int vertex_index\r\nproperty list char uint neighbours\r\n"
        "property list char uint vertex_index\r\nelement edge 1\r\nproperty list uchar int vertex1\r\n"
        "property int vertex1\r\nproperty list uchar int vertex2\r\nproperty int vertex2\r\nproperty int x\r\n"
        "end_header\r\n2 1 2 7\r\n0 7\r\n1 9 0 9 0 9 0 0\r\n0 1 9 0 9 2 0\r\n0 0 9 1 9 0 1 5\r\n9 1 9 3 0 1 2\r\n"
        "9 0 0\r\n1 9 2 1 9 0 9\r\n",
    };
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        froe_read_report report;
        double lo[3], hi[3];
        write_text("beside.ply", files[i]);
        froe_scene *scene = read_scene("beside.ply", &report);
        assert_int_equal(froe_scene_object_count(scene), 1 + i);
        assert_int_equal(froe_scene_object(scene, 0).corners, 3);
        assert_int_equal(report.skipped, i); /* a face without corners */
        assert_true(froe_scene_bounds(scene, lo, hi));
        assert_true(lo[0] == 0 && lo[1] == 0 && lo[2] == 0 && hi[0] == 1 && hi[1] == 1 && hi[2] == 2);
        if (i) assert_int_equal(froe_scene_object(scene, 1).form, FROE_SEGMENT);
        froe_scene_free(scene);
    }
}

/* Every type of numbers in binary, in both orders of bytes: the coordinates of a point. */
static void numbers_of_ply_have_eight_types(void **state) {
    (void)state;
    static const struct {
        const char *type, *bytes; /* the most significant first */
        int size;
        double value;
    } types[] = {
        {"char", "\x80", 1, -128},
        {"int8", "\x7f", 1, 127},
        {"uchar", "\xff", 1, 255},
        {"uint8", "\x80", 1, 128},
        {"short", "\x80\x01", 2, -32767},
        {"int16", "\x01\x02", 2, 258},
        {"ushort", "\x80\x01", 2, 32769},
        {"uint16", "\x01\x02", 2, 258},
        {"int", "\xff\xff\xff\xfe", 4, -2},
        {"int32", "\x7f\xff\xff\xff", 4, 2147483647},
        {"uint", "\xff\xff\xff\xfe", 4, 4294967294},
        {"uint32", "\x01\x02\x03\x04", 4, 16909060},
        {"float", "\xbf\xc0\x00\x00", 4, -1.5},
        {"float32", "\x40\x20\x00\x00", 4, 2.5},
        {"double", "\xbf\xb9\x99\x99\x99\x99\x99\x9a", 8, -0.1},
        {"float64", "\x40\x09\x21\xfb\x54\x44\x2d\x18", 8, 3.141592653589793},
    };
    for (size_t i = 0; i < 2 * sizeof types / sizeof *types; i++) {
        const bool big = i % 2;
        double lo[3], hi[3];
        FILE *file = fopen("types.ply", "wb");
        assert_non_null(file);
        fprintf(file,
                "ply\nformat binary_%s_endian 1.0\nelement vertex 1\nproperty uchar x\nproperty %s y\n"
                "property uchar z\nend_header\n",
                big ? "big" : "little", types[i / 2].type);
        fputc(7, file);
        for (int k = 0, n = types[i / 2].size; k < n; k++) fputc(types[i / 2].bytes[big ? k : n - 1 - k], file);
        fputc(9, file);
        assert_int_equal(fclose(file), 0);
        froe_scene *scene = read_scene("types.ply", NULL);
        assert_true(froe_scene_bounds(scene, lo, hi));
        assert_true(lo[0] == 7 && lo[1] == types[i / 2].value && lo[2] == 9);
        froe_scene_free(scene);
    }
}

static void broken_off_is_refused_with_its_line(void **state) {
    (void)state;
    static const refused_text files[] = {
        {"4OFF\n1 0 0\n0 0 0 0\n", FROE_E_UNSUPPORTED, "Vertices with more than 3 coordinates are not read."},
        {"nOFF\n4\n1 0 0\n", FROE_E_UNSUPPORTED, "Vertices with more than 3 coordinates are not read."},
        {"OFF BINARY\n", FROE_E_UNSUPPORTED, "Binary OFF is not read."},
        {"nobody\n", FROE_E_FORMAT, "line 1: The counts of vertices and faces are missing."},
        {"OFF\n3\n", FROE_E_FORMAT, "line 3: The counts of vertices and faces are missing."},
        {"OFF\n99 1 0\n0 0 0\n", FROE_E_FORMAT, "line 2: The file is shorter than its counts say."},
        {"OFF\n1 99999999999999999999 0\n0 0 0\n", FROE_E_FORMAT, "line 2: The file is shorter than its counts say."},
        {"OFF\n2 0 0\n0 0 0\n", FROE_E_FORMAT, "line 4: Vertices are missing."},
        {"OFF\n2 0 0\n0 0 0\n0 one 0\n", FROE_E_FORMAT, "line 4: A coordinate is not a number."},
        {"NOFF\n1 0 0\n0 0 0 0 1\n", FROE_E_FORMAT, "line 4: A normal is not a number."},
        {"OFF\n1 1 0\n0 0 0\n", FROE_E_FORMAT, "line 4: Faces are missing."},
        {"OFF\n1 1 0\n0 0 0\none 0\n", FROE_E_FORMAT, "line 4: A count of corners is not a number."},
        {"OFF\n1 1 0\n0 0 0\n2 0\n", FROE_E_FORMAT, "line 5: Faces are missing."},
        {"OFF\n1 1 0\n0 0 0\n2 0 x\n", FROE_E_FORMAT, "line 4: An index is not a number."},
        {"OFF\n1 1 0\n0 0 0\n1 0\n# two\n1 0\n", FROE_E_FORMAT, "line 6: There is more than its counts say."},
        {"OFF\n1 0 0\n0 0 0\n1 1 1\n", FROE_E_FORMAT, "line 4: There is more than its counts say."},
        {"OFF\n1 1 0\n0 0 0\n2 0 1\n", FROE_E_FORMAT, "line 4: A face names a vertex that does not exist."},
    };
    check_refusals("broken.off", files, sizeof files / sizeof *files);
}

/* Tabs and carriage returns between numbers; faces without corners; colours that end in no number. */
static void blanks_and_rests_of_off_are_passed_over(void **state) {
    (void)state;
    froe_read_report report;
    write_text("blanks.off", "OFF\r\n3\t3\t0\r\n0\t0 0\r\n1 0 0\r\n\t0 1 0\r\n0\r\n3 0 1 2\t1e0\t0.0\t0 . end\r\n"
                             "3 0 1 2 -\r\n");
    froe_scene *scene = read_scene("blanks.off", &report);
    assert_int_equal(froe_scene_object_count(scene), 2);
    assert_int_equal(report.skipped, 1);
    assert_int_equal(colour_of(scene, 0), 0xff0000ff);
    assert_int_equal(colour_of(scene, 1), 0);
    froe_scene_free(scene);
}

static void broken_obj_is_refused_with_its_line(void **state) {
    (void)state;
    static const char *const files[][2] = {
        {"v 0 0\n", "line 1: A vertex needs three coordinates."},
        {"v 0 0 0\n# \\\n\nf 1 -\n", "line 4: An index is not a number."},
        {"v 0 0 0\nf 1 1 2\n", "line 2: An index names a vertex that does not exist."},
        {"v 0 0 0\nf 1 1 -2\n", "line 2: An index names a vertex that does not exist."},
        {"v 0 0 0\nf 1 1 99999999999999999999\n", "line 2: An index names a vertex that does not exist."},
        {"v 0 0 0\nf 1 1 -99999999999999999999\n", "line 2: An index names a vertex that does not exist."},
        {"v 0 0 0\nf 1 1 18446744073709551617\n", "line 2: An index names a vertex that does not exist."},
        {"vt 0 0\n", "The file has no vertices, and is not OBJ."},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nF 1 2 3\n", "broken.obj: line 5: Words such as 'v' and 'f' are not"},
        {"v 0 0 0\nV\t1 0 0\n", "broken.obj: line 2: Words such as 'v' and 'f' are not read in capital letters."},
        {"v 0 0 0\nv 1 0 0\n L 1 2\n", "broken.obj: line 3: Words such as 'v' and 'f' are not"},
        {"v 0 0 0\nP 1\n", "broken.obj: line 2: Words such as 'v' and 'f' are not"},
    };
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        write_text("broken.obj", files[i][0]);
        refuse("broken.obj", FROE_E_FORMAT, files[i][1]);
    }
}

/* Faces of version 2, comments behind elements, and what version 2 and other files have. */
static void faces_of_old_obj_are_read_and_its_surfaces_counted(void **state) {
    (void)state;
    froe_read_report report;
    write_text("old.obj",
               "v 0 0 0 # one\nv 1 0 0\nv 0 1 0\nfo 1 2 3\nf 1 2 3# three\nf 3 2 1 # one\nl 1 2 #3\np 1 # 2\n"
               "bzp 1 2 3\nbsp 1\ncdc 1\ncdp 1\ncall other.obj\ncdq 1\nfoo 1 2 3\n");
    froe_scene *scene = read_scene("old.obj", &report);
    assert_int_equal(froe_scene_object_count(scene), 5);
    assert_int_equal(report.skipped, 5);
    froe_scene_free(scene);
}

/* Elements without enough corners, free forms, and words that only begin like others. */
static void what_obj_has_beside_elements_is_passed_over(void **state) {
    (void)state;
    froe_read_report report;
    write_text("beside.obj", "v\t0 0 0\r\nv\t1 0 0 \r\nv 0 1 0\nvertex 5 5 5\nvn 0 0 1\nf\nl 2\np\nsurf 1\ncurv 1\n"
                             "curv2 1\ncurvature\ng a\t\r\nf\t1\t2 \\\r\n 000000000000000000003\nl 1 2 3\np 1 2\n");
    froe_scene *scene = read_scene("beside.obj", &report);
    assert_int_equal(report.skipped, 6);
    assert_int_equal(froe_scene_object_count(scene), 5);
    static const froe_kind forms[] = {FROE_POLYGON, FROE_SEGMENT, FROE_SEGMENT, FROE_POINT, FROE_POINT};
    for (uint32_t i = 0; i < 5; i++) assert_int_equal(froe_scene_object(scene, i).form, forms[i]);
    assert_string_equal(froe_scene_group(scene, froe_scene_object(scene, 0).group).name, "a");
    froe_scene_free(scene);
}

/* ------------------------------------------------------------------------- CSV -- */

static void headers_of_csv_say_what_rows_are(void **state) {
    (void)state;
    static const read_text files[] = {
        {"tabs.tsv", "x\ty\n1\t2\n", "CSV points", 2, 1},
        {"ends.csv", "from_x,from_y,x,y\n1,2,3,4\n", "CSV points", 2, 1}, /* beside x,y the other columns are none */
        {"boxes.csv", "from_x,lo_x,lo_y,hi_x,hi_y,r,hull\n9,0,0,1,1,q,q\n", "CSV boxes", 2, 1},
        {"bounds.csv", ",minx,miny,maxx,maxy\n0,1,2,3,4\n", "CSV boxes", 2, 1},
        {"behind.csv", "name,Z_MAX,X_MIN,Y_MIN,Z_MIN,X_MAX,Y_MAX\nA,6,1,2,3,4,5\n", "CSV boxes", 3, 1},
        {"degrees.csv", "lon_min,lat_min,lon_max,lat_max\n1,2,3,4\n", "CSV boxes", 2, 1},
        {"centres.csv", "x,y,xmin,ymin,xmax,ymax\n1,2,q,q,q,q\n", "CSV points", 2, 1},
        {"eight.csv",
         "lo_x1,lo_x2,lo_x3,lo_x4,lo_x5,lo_x6,lo_x7,lo_x8,hi_x1,hi_x2,hi_x3,hi_x4,hi_x5,hi_x6,hi_x7,hi_x8\n"
         "0,0,0,0,0,0,0,0,1,1,1,1,1,1,1,1\n",
         "CSV boxes", 8, 1},
        {"blank.csv", "x,y\n1,2\n \t\n\r\n3,4\n  ", "CSV points", 2, 2},
    };
    check_reads(files, sizeof files / sizeof *files);
    write_text("names.csv", "x,y,name,name\n1,2,first,second\n"); /* the first column of that name counts */
    froe_scene *scene = read_scene("names.csv", NULL);
    assert_string_equal(froe_scene_group(scene, froe_scene_object(scene, 0).group).name, "first");
    froe_scene_free(scene);
}

static void broken_csv_is_refused_with_its_row(void **state) {
    (void)state;
    static const refused_text files[] = {
        {"x,y,x\n1,2,3\n", FROE_E_FORMAT, "The header names x, y, x."},
        {"x,z\n1,2\n", FROE_E_FORMAT, "The header names x, z."},
        {"lo_x,lo_y,hi_x,hi_z\n1,2,3,4\n", FROE_E_FORMAT, "of the same two or more axes"},
        {"xmin,ymin,xmax\n1,2,3\n", FROE_E_FORMAT, "The header names xmin, ymin, xmax."},
        {"xmin,ymin,xmax,ymax,ymax\n1,2,3,4,4\n", FROE_E_FORMAT, "The header names xmin, ymin, xmax, ymax, ymax."},
        {"xmin,ymin,xmax,ymax\n3,2,1,4\n", FROE_E_INPUT, "row 1"},
        {"lo_x,hi_x,WKT\n1,2,POINT (1 2)\n", FROE_E_UNSUPPORTED, "other.csv"},
        {"x,y,tag\n1,2,12a\n", FROE_E_FORMAT, "row 1: The tag '12a' is not a whole number"},
        {"x,y,tag\n1,2,-1\n", FROE_E_FORMAT, "row 1: The tag '-1' is not a whole number"},
        {"x,y\n1,2\n ,3\n", FROE_E_FORMAT, "row 2: A coordinate is missing."},
        {"x,y,r\nnan,0,1\n", FROE_E_INPUT, "row 1: Coordinate x of corner 0 is nan"},
        {"x,y,r\n-1.7e308,0,1e308\n", FROE_E_INPUT, "row 1: It reaches beyond the range of doubles."},
        {"x,y,r\n1.7e308,0,1e308\n", FROE_E_INPUT, "row 1: It reaches beyond the range of doubles."},
        {"hull,x,y\n1,inf,0\n1,1,1\n2,0,0\n", FROE_E_INPUT, "row 1: Coordinate x of corner 0 is inf"},
        {"x,y\n", FROE_E_INPUT, "no objects"},
    };
    check_refusals("other.csv", files, sizeof files / sizeof *files);
    static const char zero[] = "x,\0y\n1,2\n";
    write_bytes("other.csv", zero, sizeof zero - 1);
    refuse("other.csv", FROE_E_FORMAT, "byte 2 is zero");
}

typedef struct batches {
    size_t objects, count;
    double sum;
    froe_status status; /* of the function */
    bool silent;
} batches;

static froe_status take_batch(void *user, int dim, const froe_objects *batch, froe_diagnostic *diag) {
    batches *b = user;
    assert_true(batch->kind == FROE_POINT && dim == 2);
    for (size_t i = 0; i < 2 * batch->count; i++) b->sum += batch->coords[i];
    b->objects += batch->count, b->count++;
    if (b->status && !b->silent) snprintf(diag->message, sizeof diag->message, "Enough.");
    return b->status;
}

/* A file of more than 4 MB, behind a mark, is given back page by page while it is read. */
static void rows_come_in_batches(void **state) {
    const int rows = 150000;
    (void)state;
    froe_diagnostic why = {.message = ""};
    batches b = {.objects = 0};
    FILE *file = fopen("large.csv", "w");
    assert_non_null(file);
    fputs("\xef\xbb\xbfx,y\n", file);
    for (int i = 0; i < rows; i++) fprintf(file, "%d.0000000000000000000,%d.00000000\n", i, -2 * i);
    assert_int_equal(fclose(file), 0);
    if (froe_read_batches("large.csv", NULL, take_batch, &b, NULL, &why)) fail_msg("%s", why.message);
    assert_true(b.objects == (size_t)rows && b.sum == -(rows - 1.0) * rows / 2);
    b = (batches){.status = FROE_E_CANCELLED};
    assert_int_equal(froe_read_batches("large.csv", NULL, take_batch, &b, NULL, &why), FROE_E_CANCELLED);
    assert_string_equal(why.message, "Enough.");
    assert_true(why.status == FROE_E_CANCELLED && why.object == FROE_NONE);
    assert_int_equal(froe_read_batches("large.csv", NULL, take_batch, &b, NULL, NULL), FROE_E_CANCELLED);
    assert_int_equal(b.count, 2);
    b = (batches){.status = FROE_E_BUDGET, .silent = true};
    assert_int_equal(froe_read_batches("large.csv", NULL, take_batch, &b, NULL, &why), FROE_E_BUDGET);
    assert_string_equal(why.message, "large.csv: The function that takes the objects returned FROE_E_BUDGET.");
    assert_int_equal(why.status, FROE_E_BUDGET);
    static const struct {
        const char *text;
        froe_status status;
        const char *words;
    } others[] = {
        {"x,y,name\n1,2,a\n", FROE_E_UNSUPPORTED, "The rows name groups"},
        {"x", FROE_E_FORMAT, "The header names x."},
        {"x,y\n1,2\n3,\"4\n", FROE_E_FORMAT, "line 3: A quotation mark is not closed."},
        {"x,y\n", FROE_E_INPUT, "no objects"},
    };
    b.status = FROE_OK;
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        write_text("other.csv", others[i].text);
        assert_int_equal(froe_read_batches("other.csv", NULL, take_batch, &b, NULL, &why), others[i].status);
        if (!strstr(why.message, others[i].words)) fail_msg("%s", why.message);
    }
    static const char zero[] = "x,y\n1,2\n\0003,4\n";
    write_bytes("other.csv", zero, sizeof zero - 1);
    assert_int_equal(froe_read_batches("other.csv", NULL, take_batch, &b, NULL, &why), FROE_E_FORMAT);
    assert_non_null(strstr(why.message, "zero"));
}

/* --------------------------------------------------------------------- GeoJSON -- */

#define COLLECTION(members, features) "{\"type\":\"FeatureCollection\"," members "\"features\":[" features "]}"
#define FEATURE(members, properties, geometry)                                                                         \
    "{\"type\":\"Feature\"," members "\"properties\":{" properties "},\"geometry\":{" geometry "}}"
#define POINT "\"type\":\"Point\",\"coordinates\":[1,2]"

static void geojson_that_is_not_plain_is_refused(void **state) {
    (void)state;
    static const char *const texts[] = {
        COLLECTION("\"crs\":null,\"crs\":null,", FEATURE("", "", POINT)),
        COLLECTION("\"CRS\":null,", FEATURE("", "", POINT)),
        COLLECTION("\"crs\":{\"type\":\"name\"},", FEATURE("", "", POINT)),
        COLLECTION("\"\\u0078\":null,", FEATURE("", "", POINT)),
        COLLECTION("\"other\":-x,", FEATURE("", "", POINT)),
        COLLECTION("\"type\":\"FeatureCollection\",", FEATURE("", "", POINT)),
        COLLECTION("", FEATURE("\"id\":1,\"id\":1,", "", POINT)),
        COLLECTION("", FEATURE("\"id\":-1,", "", POINT)),
        COLLECTION("", FEATURE("\"id\":1234567890123456789,", "", POINT)),
        COLLECTION("", FEATURE("", "\"name\":\"-5-6\"", POINT)),
        COLLECTION("", FEATURE("", "\"name\":\"+5:6\"", POINT)),
        COLLECTION("", FEATURE("", "", "\"type\":\"Point\",\"coordinates\":[1e999,2]")),
        COLLECTION("", FEATURE("", "", POINT ",\"bbox\":[1,")),
        COLLECTION("", FEATURE("", "", "\"type\":\"GeometryCollection\",\"geometries\":[],\"geometries\":[]")),
        COLLECTION("", FEATURE("", "", "\"type\":\"GeometryCollection\",\"geometries\":[],\"coordinates\":[1,2]")),
        COLLECTION("", FEATURE("", "", "\"type\":\"GeometryCollection\",\"geometries\":[1]")),
        COLLECTION("", FEATURE("", "", POINT)) " x",
    };
    char text[8000], deep[4001];
    memset(deep, '[', 4000), deep[4000] = 0;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        write_text("other.geojson", texts[i]);
        refuse("other.geojson", FROE_E_UNSUPPORTED, "other.geojson: line 1: ");
    }
    snprintf(text, sizeof text, COLLECTION("\"deep\":%s,", ""), deep);
    write_text("other.geojson", text);
    refuse("other.geojson", FROE_E_UNSUPPORTED, "not plain GeoJSON");
    memset(deep, 'a', 4000);
    snprintf(text, sizeof text, COLLECTION("\"long\":\"%s\",\"crs\":null,", FEATURE("", "", POINT)), deep);
    write_text("other.geojson", text); /* GDAL does not find it there */
    refuse("other.geojson", FROE_E_UNSUPPORTED, "Other coordinate systems");
    snprintf(text, sizeof text, COLLECTION("\"long\":\"%s\",\"more\":\"%.2000s\",", FEATURE("", "", POINT)), deep,
             deep);
    write_text("other.geojson", text);
    refuse("other.geojson", FROE_E_UNSUPPORTED, "not plain GeoJSON");
}

/* Members whose names begin like known ones are others; a number as an id and as a property counts once. */
static void geojson_has_other_members_too(void **state) {
    (void)state;
    write_text("more.geojson",
               COLLECTION("\"featured\":1,", FEATURE("\"typed\":true,\"id\":7,", "\"names\":1,\"id\":3", POINT)));
    froe_scene *scene = read_scene("more.geojson", NULL);
    assert_int_equal(froe_scene_object_count(scene), 1);
    assert_int_equal(froe_scene_object(scene, 0).tag, 7);
    froe_scene_free(scene);
    write_text(".geojson", COLLECTION("", FEATURE("\"id\":5,", "", POINT) "," FEATURE("", "\"id\":3", POINT)));
    scene = read_scene(".geojson", NULL); /* where features have numbers, properties are none */
    assert_int_equal(froe_scene_object(scene, 0).tag, 5);
    assert_int_equal(froe_scene_object(scene, 1).tag, 0);
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
        {"other.json", "{\"temporalGeometry\":{}}", "holds moving features"},
        {"other.json", "{\"type\":\"MovingLineString\"}", "holds moving features"},
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
        cmocka_unit_test(broken_ply_is_refused_with_its_reason),
        cmocka_unit_test(what_ply_has_beside_faces_is_passed_over),
        cmocka_unit_test(numbers_of_ply_have_eight_types),
        cmocka_unit_test(broken_off_is_refused_with_its_line),
        cmocka_unit_test(blanks_and_rests_of_off_are_passed_over),
        cmocka_unit_test(broken_obj_is_refused_with_its_line),
        cmocka_unit_test(faces_of_old_obj_are_read_and_its_surfaces_counted),
        cmocka_unit_test(what_obj_has_beside_elements_is_passed_over),
        cmocka_unit_test(headers_of_csv_say_what_rows_are),
        cmocka_unit_test(broken_csv_is_refused_with_its_row),
        cmocka_unit_test(rows_come_in_batches),
        cmocka_unit_test(geojson_that_is_not_plain_is_refused),
        cmocka_unit_test(geojson_has_other_members_too),
        cmocka_unit_test(other_formats_are_refused),
        cmocka_unit_test(what_cannot_be_read_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
