/* test_dxf.c: drawings read back pair by pair: the lines are those that are data, to the last of DXF's 15 digits. Each
 * is on a layer that the header has, with the colour, dashes and width of its style. */
#include "support/memory.h"
#include "support/small_scenes.h"
#include <froe/io.h>
#include <gdal.h>
#include <math.h>
#include <stdio.h>

/* Two boxes of two objects that pass through each other; a name that is NULL: an object of no group. */
static froe_tree *boxes_named(const char *const names[2]) {
    static const int face[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    const size_t starts[7] = {0, 4, 8, 12, 16, 20, 24};
    froe_scene *scene = scene_of(3);
    for (int b = 0; b < 2; b++) {
        double x[72];
        const froe_group group = {.name = names[b], .material = ""};
        froe_objects o = froe_objects_defaults();
        for (int i = 0; i < 72; i++) x[i] = (face[i / 12][i / 3 % 4] >> i % 3 & 1 ? 4 : 0) + b * (1 + i % 3);
        if (names[b]) assert_int_equal(froe_scene_add_group(scene, &group, &o.group), FROE_OK);
        o.count = 6, o.coords = x, o.starts = starts;
        assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
    }
    return tree_of(scene, "density", 1);
}

/* The second has a name that DXF cannot have. */
static froe_tree *boxes(void) {
    return boxes_named((const char *const[]){"wall", "T\xC3\xBCr/2"});
}

/* ------------------------------------------------------------------------ reading -- */

typedef struct pair {
    int code;
    const char *value;
} pair;

typedef struct drawing {
    char *text;
    pair at[20000];
    size_t count;
} drawing;

static const char *end_line(char **at) {
    char *line = *at;
    *at += strcspn(line, "\n");
    if (**at) *(*at)++ = '\0';
    return line;
}

static drawing *read_drawing(const char *path) {
    drawing *d = calloc(1, sizeof *d);
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    d->text = calloc(1, 1 << 20);
    assert_true(fread(d->text, 1, (1 << 20) - 1, file) > 0);
    fclose(file);
    for (char *at = d->text; *at;) {
        assert_true(d->count < 20000);
        d->at[d->count].code = atoi(end_line(&at));
        const char *line = end_line(&at);
        d->at[d->count++].value = line + strspn(line, " ");
    }
    assert_string_equal(d->at[d->count - 1].value, "EOF");
    return d;
}

static void free_drawing(drawing *d) {
    free(d->text);
    free(d);
}

/* Where a record with a name begins: of code 0 and this type, which has it as code 2 (or, of variables, is code 9). */
static size_t find(const drawing *d, const char *type, const char *name) {
    for (size_t i = 0; i < d->count; i++) {
        if (d->at[i].code == 9 && !strcmp(d->at[i].value, name)) return i;
        if (d->at[i].code != 0 || strcmp(d->at[i].value, type) != 0) continue;
        for (size_t k = i + 1; k < d->count && d->at[k].code; k++)
            if (d->at[k].code == 2 && !strcmp(d->at[k].value, name)) return i;
    }
    fail_msg("there is no %s %s", type, name);
    return 0;
}

/* The n-th value of a code in the record that begins at i; NULL: there is none. */
static const char *value(const drawing *d, size_t i, int code, int n) {
    while (d->at[++i].code && d->at[i].code != 9)
        if (d->at[i].code == code && !n--) return d->at[i].value;
    return NULL;
}

static void must_have(const drawing *d, size_t i, int code, const char *expected) {
    const char *found = value(d, i, code, 0);
    if (!found || strcmp(found, expected) != 0) fail_msg("code %d is %s, not %s", code, found, expected);
}

/* ------------------------------------------------------------------------- lines -- */

typedef struct follower {
    const drawing *drawing;
    size_t at, lines, hidden;
    double height;
} follower;

static void must_be_number(const char *text, double x) {
    char expected[40];
    snprintf(expected, sizeof expected, "%.15g", x);
    if (!text || strtod(text, NULL) != strtod(expected, NULL)) fail_msg("%s is not %s", text, expected);
}

static bool follow_line(void *user, const froe_stroke *line) {
    follower *f = user;
    const drawing *d = f->drawing;
    char layer[80];
    while (d->at[f->at].code || strcmp(d->at[f->at].value, "LWPOLYLINE") != 0) assert_true(++f->at < d->count);
    snprintf(layer, sizeof layer, "%s-%s", line->hidden ? "HIDDEN" : "VISIBLE", froe_line_name(line->kind));
    for (char *c = layer; *c; c++) *c = *c >= 'a' && *c <= 'z' ? (char)(*c - 32) : *c;
    must_have(d, f->at, 8, layer);
    assert_int_equal(atoi(value(d, f->at, 90, 0)), line->count);
    assert_int_equal(atoi(value(d, f->at, 70, 0)), line->closed);
    assert_null(value(d, f->at, 62, 0)); /* as the layer has it */
    assert_null(value(d, f->at, 6, 0));
    for (size_t i = 0; i < line->count; i++) {
        must_be_number(value(d, f->at, 10, (int)i), line->points[2 * i]);
        must_be_number(value(d, f->at, 20, (int)i), f->height - line->points[2 * i + 1]);
    }
    find(d, "LAYER", layer);
    f->at++, f->lines++, f->hidden += line->hidden;
    return true;
}

static void the_lines_are_those_that_are_data(void **state) {
    (void)state;
    froe_tree *tree = boxes();
    for (int look = 0; look < 2; look++) {
        froe_render_options o = froe_render_defaults();
        froe_render_report report;
        o.camera.width = 200, o.camera.height = 160;
        o.camera.margin = 5;
        o.camera.parallel = look;
        o.hidden = true;
        assert_int_equal(froe_render_dxf(tree, "lines.dxf", &o, &report, NULL), FROE_OK);
        drawing *d = read_drawing("lines.dxf");
        follower f = {.drawing = d, .height = 160};
        assert_int_equal(froe_render_lines(tree, follow_line, &f, &o, NULL, NULL), FROE_OK);
        assert_int_equal(f.lines, report.strokes);
        assert_true(f.hidden > 2 && f.hidden < f.lines - 2);
        for (; f.at < d->count; f.at++) assert_true(d->at[f.at].code || strcmp(d->at[f.at].value, "LWPOLYLINE") != 0);
        must_have(d, find(d, "", "$INSUNITS"), 70, "0");
        free_drawing(d);
    }
    froe_tree_free(tree);
}

static void layers_have_the_styles_of_their_lines(void **state) {
    (void)state;
    froe_tree *tree = boxes();
    froe_render_options o = froe_render_defaults();
    froe_line_style s[2] = {froe_line_style_defaults(), froe_line_style_defaults()};
    s[0].visible = FROE_LINE_SILHOUETTE, s[0].colour = 0xFF0000, s[0].width = 0.36;
    s[1].hidden = FROE_LINE_CREASE, s[1].colour = 0x102080, s[1].dash = 3.5, s[1].gap = 1.25;
    o.camera.width = 200, o.camera.height = 160, o.camera.margin = 5;
    o.millimetres = true;
    o.line_width = 0.5;
    o.hidden = true;
    o.line_styles = s, o.line_style_count = 2;
    assert_int_equal(froe_render_dxf(tree, "styles.dxf", &o, NULL, NULL), FROE_OK);
    drawing *d = read_drawing("styles.dxf");
    must_have(d, find(d, "", "$INSUNITS"), 70, "4");
    must_have(d, find(d, "", "$MEASUREMENT"), 70, "1");
    const size_t silhouette = find(d, "LAYER", "VISIBLE-SILHOUETTE"), hidden = find(d, "LAYER", "HIDDEN-CREASE"),
                 crease = find(d, "LAYER", "VISIBLE-CREASE");
    must_have(d, silhouette, 62, "1");
    must_have(d, silhouette, 420, "16711680");
    must_have(d, silhouette, 370, "35"); /* the nearest of DXF's widths */
    must_have(d, silhouette, 6, "Continuous");
    must_have(d, crease, 62, "7");
    must_have(d, crease, 370, "30");
    assert_null(value(d, crease, 420, 0));
    must_have(d, hidden, 420, "1056896");
    assert_string_not_equal(value(d, hidden, 62, 0), "7");
    const size_t dashes = find(d, "LTYPE", value(d, hidden, 6, 0));
    assert_memory_equal(value(d, hidden, 6, 0), "DASHED", 6);
    must_have(d, dashes, 40, "4.75000");
    assert_string_equal(value(d, dashes, 49, 0), "3.50000");
    assert_string_equal(value(d, dashes, 49, 1), "-1.25000");
    /* No two records have one handle. */
    for (size_t i = 0; i < d->count; i++)
        for (size_t k = 0; k < i; k++)
            if (d->at[i].code == 5 && d->at[k].code == 5 && k > silhouette - 200)
                assert_string_not_equal(d->at[i].value, d->at[k].value);
    free_drawing(d);
    froe_tree_free(tree);
}

static void layers_by_object_have_names_that_dxf_can_have(void **state) {
    (void)state;
    froe_tree *tree = boxes();
    froe_render_options o = froe_render_defaults();
    o.hidden = true;
    o.layers = FROE_LAYERS_OBJECT;
    assert_int_equal(froe_render_dxf(tree, "objects.dxf", &o, NULL, NULL), FROE_OK);
    drawing *d = read_drawing("objects.dxf");
    static const char *const names[] = {"WALL-VISIBLE", "WALL-HIDDEN", "TU+00FCR_2-VISIBLE", "TU+00FCR_2-HIDDEN"};
    for (int i = 0; i < 4; i++) find(d, "LAYER", names[i]);
    size_t layers = 0;
    for (size_t i = 0; i < d->count; i++) layers += !d->at[i].code && !strcmp(d->at[i].value, "LAYER");
    assert_int_equal(layers, 1 + 4); /* and 0, which every drawing has: GDAL adds none of its own */
    free_drawing(d);
    /* What has another colour than its layer has that by itself. */
    froe_line_style s = froe_line_style_defaults();
    s.visible = FROE_LINE_CREASE, s.colour = 0xFF0000;
    o.line_styles = &s, o.line_style_count = 1;
    assert_int_equal(froe_render_dxf(tree, "colours.dxf", &o, NULL, NULL), FROE_OK);
    d = read_drawing("colours.dxf");
    size_t red = 0;
    for (size_t i = 0; i < d->count; i++) {
        const char *colour = d->at[i].code || strcmp(d->at[i].value, "LWPOLYLINE") ? NULL : value(d, i, 62, 0);
        if (!colour) continue;
        assert_true(!strcmp(colour, "1") || !strcmp(colour, "7"));
        assert_string_not_equal(colour, value(d, find(d, "LAYER", value(d, i, 8, 0)), 62, 0));
        red += !strcmp(colour, "1");
    }
    assert_true(red > 0);
    free_drawing(d);
    froe_tree_free(tree);
}

/* Signs that are none, and names that are too long; what has no group is named by its sight alone. */
static void any_name_becomes_one_of_dxf(void **state) {
    (void)state;
    char long_name[300];
    memset(long_name, 'x', sizeof long_name - 1), long_name[sizeof long_name - 1] = '\0';
    static const char *const none[] = {"VISIBLE", "HIDDEN"}, *const odd[] = {"A_B_C_D-VISIBLE", "A_B_C_D-HIDDEN"};
    froe_render_options o = froe_render_defaults();
    o.hidden = true;
    o.layers = FROE_LAYERS_OBJECT;
    froe_tree *tree = boxes_named((const char *const[]){NULL, "a\xff"
                                                              "b\x01"
                                                              "c\x7f"
                                                              "d"});
    assert_int_equal(froe_render_dxf(tree, "odd.dxf", &o, NULL, NULL), FROE_OK);
    drawing *d = read_drawing("odd.dxf");
    for (int i = 0; i < 2; i++) find(d, "LAYER", none[i]), find(d, "LAYER", odd[i]);
    free_drawing(d);
    froe_tree_free(tree);
    tree = boxes_named((const char *const[]){"short", long_name});
    assert_int_equal(froe_render_dxf(tree, "long.dxf", &o, NULL, NULL), FROE_OK);
    d = read_drawing("long.dxf");
    size_t cut = 0;
    for (size_t i = 0; i < d->count; i++) cut += d->at[i].code == 8 && !strncmp(d->at[i].value, "XXXXXXXX", 8);
    assert_true(cut > 0);
    free_drawing(d);
    froe_tree_free(tree);
}

/* Layers with the same dashes and gaps share a type of line. */
static void dashes_are_types_of_lines(void **state) {
    (void)state;
    static const double gaps[] = {1, 2, 1};
    froe_tree *tree = boxes();
    froe_render_options o = froe_render_defaults();
    froe_line_style s[3];
    for (int i = 0; i < 3; i++) s[i] = froe_line_style_defaults(), s[i].dash = 3, s[i].gap = gaps[i];
    s[0].visible = FROE_LINE_SILHOUETTE, s[1].visible = FROE_LINE_CREASE, s[2].hidden = FROE_LINE_CREASE;
    o.hidden = true;
    o.line_styles = s, o.line_style_count = 3;
    assert_int_equal(froe_render_dxf(tree, "dashes.dxf", &o, NULL, NULL), FROE_OK);
    drawing *d = read_drawing("dashes.dxf");
    static const char *const layers[] = {"VISIBLE-SILHOUETTE", "VISIBLE-CREASE", "HIDDEN-CREASE"};
    const char *types[3];
    for (int i = 0; i < 3; i++) {
        char gap[16];
        snprintf(gap, sizeof gap, "%.5f", -gaps[i]);
        types[i] = value(d, find(d, "LAYER", layers[i]), 6, 0);
        assert_string_equal(value(d, find(d, "LTYPE", types[i]), 49, 1), gap);
    }
    assert_string_equal(types[0], types[2]);
    assert_string_not_equal(types[0], types[1]);
    free_drawing(d);
    froe_tree_free(tree);
}

static void a_gdal_without_the_driver_is_told(void **state) {
    (void)state;
    froe_tree *tree = boxes();
    froe_diagnostic why;
    assert_int_equal(froe_render_dxf(tree, "with.dxf", NULL, NULL, NULL), FROE_OK);
    GDALDriverH driver = GDALGetDriverByName("DXF");
    GDALDeregisterDriver(driver);
    assert_int_equal(froe_render_dxf(tree, "without.dxf", NULL, NULL, &why), FROE_E_UNSUPPORTED);
    assert_string_equal(why.message, "without.dxf: GDAL has no driver that writes DXF.");
    assert_null(fopen("without.dxf", "rb"));
    GDALRegisterDriver(driver);
    froe_tree_free(tree);
}

static void options_that_are_none_are_refused(void **state) {
    (void)state;
    froe_tree *tree = boxes();
    froe_diagnostic why;
    froe_render_options o;
    memset(&o, 0xA5, sizeof o); /* pointers that lead nowhere are not followed */
    assert_int_equal(froe_render_dxf(tree, "none.dxf", &o, NULL, &why), FROE_E_OPTIONS);
    assert_non_null(strstr(why.message, "froe_render_defaults"));
    assert_null(fopen("none.dxf", "rb"));
    froe_tree_free(tree);
}

static void the_same_bytes_again(void **state) {
    (void)state;
    froe_tree *tree = boxes();
    drawing *d[2];
    assert_int_equal(froe_render_dxf(tree, "a.dxf", NULL, NULL, NULL), FROE_OK);
    assert_int_equal(froe_render_dxf(tree, "b.dxf", NULL, NULL, NULL), FROE_OK);
    for (int i = 0; i < 2; i++) d[i] = read_drawing(i ? "b.dxf" : "a.dxf");
    assert_int_equal(d[0]->count, d[1]->count);
    for (size_t i = 0; i < d[0]->count; i++) {
        assert_int_equal(d[0]->at[i].code, d[1]->at[i].code);
        assert_string_equal(d[0]->at[i].value, d[1]->at[i].value);
    }
    free_drawing(d[0]), free_drawing(d[1]);
    froe_tree_free(tree);
}

static void bad_options_leave_no_file(void **state) {
    (void)state;
    froe_tree *tree = boxes();
    froe_diagnostic why;
    froe_render_options o = froe_render_defaults();
    o.crease = -1;
    assert_int_equal(froe_render_dxf(tree, "none.dxf", &o, NULL, &why), FROE_E_OPTIONS);
    assert_int_equal(froe_render_dxf(NULL, "none.dxf", NULL, NULL, &why), FROE_E_ARG);
    assert_int_equal(froe_render_dxf(tree, NULL, NULL, NULL, &why), FROE_E_ARG);
    assert_int_equal(froe_render_dxf(tree, "no/such/folder/none.dxf", NULL, NULL, &why), FROE_E_IO);
    assert_int_equal(froe_render(tree, "none.dxf", NULL, NULL, &why), FROE_E_UNSUPPORTED);
    assert_non_null(strstr(why.message, "froe_render_dxf()"));
    assert_null(fopen("none.dxf", "rb"));
    froe_tree_free(tree);
}

static froe_status draw_with(void *user, const froe_allocator *alloc) {
    froe_render_options o = froe_render_defaults();
    o.alloc = alloc;
    return froe_render_dxf(user, "memory.dxf", &o, NULL, NULL);
}

static void every_allocation_may_fail(void **state) {
    (void)state;
    froe_tree *tree = boxes();
    assert_true(test_memory_each(draw_with, tree) > 30);
    froe_tree_free(tree);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_lines_are_those_that_are_data),
        cmocka_unit_test(layers_have_the_styles_of_their_lines),
        cmocka_unit_test(layers_by_object_have_names_that_dxf_can_have),
        cmocka_unit_test(any_name_becomes_one_of_dxf),
        cmocka_unit_test(dashes_are_types_of_lines),
        cmocka_unit_test(a_gdal_without_the_driver_is_told),
        cmocka_unit_test(options_that_are_none_are_refused),
        cmocka_unit_test(the_same_bytes_again),
        cmocka_unit_test(bad_options_leave_no_file),
        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
