/* test_wires.c: segments and points of a scene in files: their colours, widths and order, and how they are counted. */
#include "support/memory.h"
#include <froe/render.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct text {
    char *data;
    size_t count;
} text;

static bool keep(void *user, const void *bytes, size_t count) {
    text *t = user;
    t->data = realloc(t->data, t->count + count + 1);
    memcpy(t->data + t->count, bytes, count);
    t->data[t->count += count] = '\0';
    return true;
}

static void add(froe_scene *scene, froe_kind kind, size_t count, const double *coords, uint32_t group) {
    const size_t starts[2] = {0, 4};
    const uint32_t groups[8] = {group, group, group, group, group, group, group, group};
    froe_objects o = froe_objects_defaults();
    o.kind = kind, o.count = count, o.coords = coords, o.groups = groups;
    if (kind == FROE_POLYGON) o.starts = starts;
    assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
}

/* A plate, x and y from 0 to 4, z = 0. Red segments through it and beside it, blue ones that meet the red ones' ends;
 * points before, behind and beside it. */
static froe_tree *plate(void) {
    const double square[] = {0, 0, 0, 4, 0, 0, 4, 4, 0, 0, 4, 0}, red[] = {1, 1, 1, 3, 1, -1, 5, 0, 0, 5, 2, 0},
                 blue[] = {5, 2, 0, 5, 4, 0}, dots[] = {1, 2, 2, 2, 2, 1, 2, 2, -1, 6, 2, 0};
    froe_scene *scene;
    uint32_t group;
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    assert_int_equal(froe_scene_add_group(scene, &(froe_group){.name = "red", .colour = 0xff0000ff}, &group), FROE_OK);
    assert_int_equal(froe_scene_add_group(scene, &(froe_group){.name = "blue", .colour = 0x0000ffff}, &group), FROE_OK);
    add(scene, FROE_POLYGON, 1, square, FROE_NONE);
    add(scene, FROE_SEGMENT, 2, red, 0);
    add(scene, FROE_SEGMENT, 1, blue, 1);
    add(scene, FROE_POINT, 3, dots, 1);
    add(scene, FROE_POINT, 1, dots + 9, FROE_NONE);
    froe_build_options o = froe_build_defaults();
    froe_tree *tree;
    o.purpose = "draw";
    assert_int_equal(froe_build(scene, &o, &tree, NULL), FROE_OK);
    froe_scene_free(scene);
    return tree;
}

static froe_render_options from_above(void) {
    froe_render_options o = froe_render_defaults();
    const double eye[3] = {0, 0, 1}, up[3] = {0, 1, 0};
    memcpy(o.camera.eye, eye, sizeof eye);
    memcpy(o.camera.up, up, sizeof up);
    o.camera.parallel = true, o.camera.scale = 10, o.camera.width = o.camera.height = 100;
    o.decimals = 0;
    return o;
}

static text write_as(const froe_tree *tree, froe_render_format format, const froe_render_options *o,
                     froe_render_report *report) {
    text out = {NULL, 0};
    froe_diagnostic why = {.message = ""};
    if (froe_render_write(tree, format, keep, &out, o, report, &why)) fail_msg("%s", why.message);
    return out;
}

static void expect(const text *t, const char *words) {
    if (!strstr(t->data, words)) fail_msg("'%s' is not in\n%s", words, t->data);
}

/* Fitted about the middle of the scene, (3, 2): x is 20 + 10 x, y is 70 - 10 y. */
static void each_colour_is_a_path_in_svg(void **state) {
    (void)state;
    froe_tree *tree = plate();
    froe_render_options o = from_above();
    froe_render_report report;
    o.hidden = true;
    text t = write_as(tree, FROE_RENDER_SVG, &o, &report);
    assert_int_equal(report.dots, 3);
    assert_int_equal(report.picture.visibility.points, 1);
    assert_int_equal(report.picture.visibility.visible_points, 3);
    assert_int_equal(report.picture.visibility.segments, 0);
    assert_int_equal(report.picture.visibility.visible_segments, 3);
    expect(&t,
           "class=\"wire hidden\" stroke=\"#f00\" stroke-width=\"0.6\" stroke-dasharray=\"2.4 1.8\" d=\"m40 60h10\"");
    expect(&t, "class=\"wire\" stroke=\"#f00\" stroke-width=\"1\" d=\"m30 60h10m30 10v-20\"");
    expect(&t, "class=\"wire\" stroke=\"#00f\" stroke-width=\"1\" d=\"m70 50v-20\"");
    expect(&t, "class=\"point\" stroke=\"#00f\" stroke-width=\"3\" stroke-linecap=\"round\" d=\"m");
    expect(&t, "class=\"point\" stroke-width=\"3\" stroke-linecap=\"round\" d=\"m80 50z\"");
    free(t.data);
    o.own_colours = true; /* then all are of the colour of lines */
    t = write_as(tree, FROE_RENDER_SVG, &o, &report);
    assert_null(strstr(t.data, "#f00"));
    expect(&t, "class=\"wire\" stroke-width=\"1\" d=\"m");
    free(t.data);
    froe_tree_free(tree);
}

static void kinds_and_widths_are_obeyed(void **state) {
    (void)state;
    froe_tree *tree = plate();
    froe_render_options o = from_above();
    froe_render_report report;
    const uint32_t all = o.lines;
    o.lines = all & ~(uint32_t)FROE_LINE_WIRE;
    text t = write_as(tree, FROE_RENDER_SVG, &o, &report);
    assert_null(strstr(t.data, "\"wire"));
    expect(&t, "\"point\"");
    free(t.data);
    o.lines = all & ~(uint32_t)(FROE_LINE_WIRE | FROE_LINE_POINT);
    t = write_as(tree, FROE_RENDER_SVG, &o, &report);
    assert_int_equal(report.picture.visibility.points + report.picture.visibility.segments, 7); /* nothing was asked */
    assert_null(strstr(t.data, "\"point\""));
    free(t.data);
    o.lines = all, o.point_width = 0;
    t = write_as(tree, FROE_RENDER_SVG, &o, &report);
    assert_null(strstr(t.data, "\"point\""));
    free(t.data);
    o.point_width = 7.5, o.line_width = 0; /* points are no lines */
    t = write_as(tree, FROE_RENDER_SVG, &o, &report);
    assert_null(strstr(t.data, "\"wire"));
    expect(&t, "class=\"point\" stroke=\"#00f\" stroke-width=\"7.5\"");
    free(t.data);
    o.point_width = -1;
    froe_diagnostic why;
    assert_int_equal(froe_render_write(tree, FROE_RENDER_SVG, keep, &t, &o, NULL, &why), FROE_E_OPTIONS);
    assert_non_null(strstr(why.message, "point_width"));
    froe_line_style style = froe_line_style_defaults();
    o = from_above();
    style.visible = FROE_LINE_WIRE | FROE_LINE_POINT, style.colour = 0x00ff00, style.width = 2;
    o.line_styles = &style, o.line_style_count = 1;
    t = write_as(tree, FROE_RENDER_SVG, &o, &report);
    expect(&t, "class=\"wire\" stroke=\"#0f0\" stroke-width=\"2\"");
    expect(&t, "class=\"point\" stroke=\"#0f0\" stroke-width=\"2\"");
    free(t.data);
    froe_tree_free(tree);
}

/* A point is a path of one place, closed, with round caps: 1/256 of a point in PDF and EPS. */
static void points_are_round_in_pdf_and_eps(void **state) {
    (void)state;
    froe_tree *tree = plate();
    const froe_render_options o = from_above();
    froe_render_report report;
    for (int f = FROE_RENDER_PDF; f <= FROE_RENDER_EPS; f++) {
        text t = write_as(tree, (froe_render_format)f, &o, &report);
        expect(&t, "1 J\n");
        expect(&t, "20480 12800 m\nh\nS\n0 J\n");
        expect(&t, "1 0 0 RG\n256 w\n");
        if (f == FROE_RENDER_EPS) expect(&t, "/J{setlinecap}bind def");
        free(t.data);
    }
    froe_tree_free(tree);
}

/* Nearer points lie over farther ones. */
static bool note_dots(void *user, const froe_render_path *path) {
    double *last = user;
    if (!path->dots) return true;
    assert_true(path->lines && path->kind == FROE_LINE_POINT && !path->hidden);
    for (size_t i = 0; i < path->count; i++) {
        assert_true(path->outlines[i].count == 1 && path->outlines[i].closed);
        assert_true(path->outlines[i].points[0] >= *last); /* x grows towards the eye */
        *last = path->outlines[i].points[0];
    }
    return true;
}

static void nearer_points_lie_over_farther_ones(void **state) {
    (void)state;
    double dots[3 * 50], last = -1;
    froe_scene *scene;
    froe_tree *tree;
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    for (int i = 0; i < 50; i++) /* 37 i modulo 50: all heights, in disorder, the height being x */
        dots[3 * i] = dots[3 * i + 2] = 37 * i % 50, dots[3 * i + 1] = i;
    for (int i = 0; i < 50; i += 5) add(scene, FROE_POINT, 5, dots + 3 * i, FROE_NONE);
    assert_int_equal(froe_build(scene, NULL, &tree, NULL), FROE_OK);
    froe_scene_free(scene);
    froe_render_options o = from_above();
    o.camera.scale = 1;
    assert_int_equal(froe_render_paths(tree, 256, note_dots, &last, &o, NULL, NULL), FROE_OK);
    assert_true(last > 0);
    o.camera.parallel = false, last = -1;
    assert_int_equal(froe_render_paths(tree, 256, note_dots, &last, &o, NULL, NULL), FROE_OK);
    froe_tree_free(tree);
}

/* With lines among faces, a wide line and a wide point at the far side of a nearer plate are painted before it. */
static bool note_order(void *user, const froe_render_path *path) {
    char *order = user;
    const size_t used = strlen(order);
    order[used] = !path->lines ? 'f' : path->dots ? 'p' : path->kind == FROE_LINE_WIRE ? 'w' : 'b';
    return true;
}

static void what_is_among_faces_is_painted_there(void **state) {
    (void)state;
    const double far[] = {-9, -9, 0, 9, -9, 0, 9, 9, 0, -9, 9, 0}, near[] = {0, -2, 5, 2, -2, 5, 2, 2, 5, 0, 2, 5},
                 wire[] = {-0.05, -1, 1, -0.05, 1, 1}, dot[] = {-0.05, 1.5, 1};
    froe_scene *scene;
    froe_tree *tree;
    uint32_t group;
    char order[32] = "";
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    assert_int_equal(froe_scene_add_group(scene, &(froe_group){.name = "near", .colour = 0x00ff00ff}, &group), FROE_OK);
    add(scene, FROE_POLYGON, 1, far, FROE_NONE);
    add(scene, FROE_POLYGON, 1, near, 0);
    add(scene, FROE_SEGMENT, 1, wire, FROE_NONE);
    add(scene, FROE_POINT, 1, dot, FROE_NONE);
    assert_int_equal(froe_build(scene, NULL, &tree, NULL), FROE_OK);
    froe_scene_free(scene);
    froe_render_options o = from_above();
    o.lines = FROE_LINE_WIRE | FROE_LINE_POINT;
    o.line_width = 2;
    assert_int_equal(froe_render_paths(tree, 256, note_order, order, &o, NULL, NULL), FROE_OK);
    assert_string_equal(order, "ffwp");
    o.interleaved = true;
    memset(order, 0, sizeof order);
    assert_int_equal(froe_render_paths(tree, 256, note_order, order, &o, NULL, NULL), FROE_OK);
    assert_string_equal(order, "fwpf");
    froe_tree_free(tree);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_colour_is_a_path_in_svg),         cmocka_unit_test(kinds_and_widths_are_obeyed),
        cmocka_unit_test(points_are_round_in_pdf_and_eps),      cmocka_unit_test(nearer_points_lie_over_farther_ones),
        cmocka_unit_test(what_is_among_faces_is_painted_there),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
