/* test_render.c: rendered files: the same bytes again, SVG that says what the picture holds, refusals. */
#include "support/small_scenes.h"
#include <froe/render.h>
#include <math.h>
#include <stdio.h>

static char *read_file(const char *path, size_t *count) {
    FILE *f = fopen(path, "rb");
    assert_non_null(f);
    char *bytes = calloc(1, 1 << 22);
    *count = fread(bytes, 1, (1 << 22) - 1, f);
    fclose(f);
    return bytes;
}

static char *render(const froe_tree *tree, const char *path, const froe_render_options *o, froe_render_report *report,
                    size_t *count) {
    froe_diagnostic why = {.message = ""};
    if (froe_render(tree, path, o, report, &why)) fail_msg("%s", why.message);
    return read_file(path, count);
}

static size_t occurrences(const char *text, const char *word) {
    size_t n = 0;
    for (const char *at = text; (at = strstr(at, word)) != NULL; at++) n++;
    return n;
}

/* A cube of two materials, one of them glass, of the colour given. */
static froe_tree *cube_with(uint32_t colour) {
    static const int face[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    froe_scene *scene = scene_of(3);
    uint32_t group[2];
    const froe_group stone = {.name = "cube", .material = "stone"},
                     glass = {.name = "cube", .material = "glass", .colour = colour};
    assert_int_equal(froe_scene_add_group(scene, &stone, &group[0]), FROE_OK);
    assert_int_equal(froe_scene_add_group(scene, &glass, &group[1]), FROE_OK);
    for (int f = 0; f < 6; f++) {
        double x[12];
        const size_t starts[2] = {0, 4};
        for (int i = 0; i < 4; i++)
            for (int k = 0; k < 3; k++) x[3 * i + k] = face[f][i] >> k & 1;
        froe_objects o = froe_objects_defaults();
        o.count = 1, o.coords = x, o.starts = starts, o.group = group[f % 2];
        assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
    }
    return tree_of(scene, "density", 1);
}

static froe_tree *cube(void) {
    return cube_with(0);
}

static void the_same_bytes_in_every_format(void **state) {
    (void)state;
    froe_tree *tree = tree_of(random_triangles(60, 0.6), "density", 1);
    const char *const names[][2] = {{"a.svg", "b.svg"}, {"a.pdf", "b.pdf"}, {"a.eps", "b.eps"}};
    for (int f = 0; f < 3; f++) {
        size_t count[2];
        froe_render_report report;
        char *a = render(tree, names[f][0], NULL, &report, &count[0]),
             *b = render(tree, names[f][1], NULL, NULL, &count[1]);
        assert_int_equal(count[0], count[1]);
        assert_int_equal(count[0], report.bytes);
        assert_memory_equal(a, b, count[0]);
        free(a), free(b);
    }
    froe_tree_free(tree);
}

/* Enough faces for several jobs of each kind; some are in circles, and clipped. With glass, pieces are painted. */
static void the_same_bytes_with_any_number_of_threads(void **state) {
    (void)state;
    for (int glass = 0; glass < 2; glass++) {
        const double opacity[1] = {0.5};
        froe_scene *scene = scene_of(3);
        uint32_t group;
        assert_int_equal(froe_scene_add_group(scene, &(froe_group){.name = "glass", .material = "glass"}, &group),
                         FROE_OK);
        froe_scene *triangles = random_triangles(glass ? 700 : 2500, glass ? 0.2 : 0.06);
        for (uint32_t i = 0; i < froe_scene_object_count(triangles); i++) {
            double x[9];
            for (uint32_t c = 0; c < 3; c++)
                memcpy(x + 3 * c, froe_scene_vertex(triangles, froe_scene_corner(triangles, i, c)), 3 * sizeof *x);
            froe_objects o = froe_objects_defaults();
            const size_t starts[2] = {0, 3};
            o.count = 1, o.coords = x, o.starts = starts, o.group = group;
            assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
        }
        froe_scene_free(triangles);
        froe_tree *tree = tree_of(scene, "density", 1);
        froe_render_options o = froe_render_defaults();
        froe_render_report report;
        size_t count[2];
        o.opacity = glass ? opacity : NULL;
        o.threads = 1;
        char *one = render(tree, "one.svg", &o, &report, &count[0]);
        assert_true(report.picture.late > 10 && report.picture.whole > 10);
        assert_true(glass || report.picture.shapes > 1200);
        const froe_picture_report alone = report.picture;
        for (o.threads = 2; o.threads < 6; o.threads += 3) {
            char *several = render(tree, "several.svg", &o, &report, &count[1]);
            assert_int_equal(count[0], count[1]);
            assert_memory_equal(one, several, count[0]);
            assert_memory_equal(&alone, &report.picture, sizeof alone);
            free(several);
        }
        free(one);
        froe_tree_free(tree);
    }
}

static void a_cube_shows_three_faces_and_nine_edges(void **state) {
    (void)state;
    froe_tree *tree = cube();
    froe_render_options o = froe_render_defaults();
    froe_render_report report;
    size_t count;
    o.ids = FROE_IDS_FACE;
    o.title = "a < b & c";
    char *svg = render(tree, "cube.svg", &o, &report, &count);
    assert_int_equal(report.picture.shapes, 3);
    assert_int_equal(report.picture.late, 0);
    assert_int_equal(report.picture.points, 12 + 2 * 3); /* seams of the three inner edges, two points each */
    assert_int_equal(occurrences(svg, "<title>a &lt; b &amp; c</title>"), 1);
    assert_int_equal(occurrences(svg, "data-object="), occurrences(svg, "<path "));
    assert_int_equal(occurrences(svg, "<path fill="), 3);
    assert_int_equal(occurrences(svg, "class=\"silhouette\""), 3); /* two edges of each face */
    assert_int_equal(report.picture.strokes, 3 + 3);
    free(svg);
    o = froe_render_defaults();
    o.hidden = true;
    o.shading = FROE_SHADE_NONE;
    svg = render(tree, "lines.svg", &o, &report, &count);
    assert_int_equal(report.picture.shapes, 0);
    assert_int_equal(occurrences(svg, " hidden\""), 2);
    assert_int_equal(occurrences(svg, "stroke-dasharray"), 2);
    free(svg);
    froe_tree_free(tree);
}

static void through_glass_one_sees_what_is_behind(void **state) {
    (void)state;
    froe_tree *tree = cube();
    froe_render_options o = froe_render_defaults();
    froe_render_report report;
    const double opacity[2] = {1, 0.25}, bad[2] = {1, 2};
    size_t count;
    froe_diagnostic why;
    o.opacity = opacity;
    char *svg = render(tree, "glass.svg", &o, &report, &count);
    assert_true(report.picture.shapes > 3);
    assert_true(occurrences(svg, "fill-opacity=\"0.25\"") > 0);
    free(svg);
    free(render(tree, "glass.pdf", &o, &report, &count));
    assert_int_equal(froe_render(tree, "glass.eps", &o, NULL, &why), FROE_E_OPTIONS);
    assert_non_null(strstr(why.message, "EPS has no opacity"));
    o.opacity = bad;
    assert_int_equal(froe_render(tree, "glass.svg", &o, NULL, &why), FROE_E_OPTIONS);
    froe_tree_free(tree);
}

/* Colours and opacity of the scene hold unless told otherwise, also of a tree that was saved. */
static void a_scene_brings_its_colours(void **state) {
    (void)state;
    froe_tree *tree = cube_with(0x123456CC), *opened;
    froe_render_options o = froe_render_defaults();
    froe_render_report report;
    const double opacity[2] = {NAN, 1};
    size_t count;
    assert_int_equal(froe_tree_save(tree, "cube.froe", NULL), FROE_OK);
    froe_tree_free(tree);
    assert_int_equal(froe_tree_open("cube.froe", NULL, &opened, NULL), FROE_OK);
    o.shading = FROE_SHADE_PLAIN;
    char *svg = render(opened, "colours.svg", &o, &report, &count);
    assert_true(occurrences(svg, "#123456") > 0);
    assert_true(occurrences(svg, "fill-opacity=\"0.80\"") > 0);
    free(svg);
    o.opacity = opacity;
    svg = render(opened, "opaque.svg", &o, &report, &count);
    assert_true(occurrences(svg, "#123456") > 0);
    assert_int_equal(occurrences(svg, "fill-opacity"), 0);
    free(svg);
    o.opacity = NULL;
    o.own_colours = true;
    svg = render(opened, "own.svg", &o, &report, &count);
    assert_int_equal(occurrences(svg, "#123456"), 0);
    assert_int_equal(occurrences(svg, "fill-opacity"), 0);
    free(svg);
    froe_tree_free(opened);
}

/* Rounding to the grid moves points by half a step at most, however long a path is. */
static void coordinates_do_not_drift(void **state) {
    (void)state;
    froe_tree *tree = tree_of(random_triangles(200, 0.2), "density", 1);
    froe_render_options o = froe_render_defaults();
    froe_render_report report;
    size_t count[3];
    for (int decimals = 0; decimals < 3; decimals++) {
        o.decimals = decimals;
        free(render(tree, "decimals.svg", &o, &report, &count[decimals]));
    }
    assert_true(count[0] < count[1] && count[1] < count[2]);
    /* Followed step by step, hundredths of a unit, a path of hundreds of rings stays on the page. */
    o.lines = 0, o.seam_width = 0, o.shading = FROE_SHADE_WHITE;
    char *svg = render(tree, "drift.svg", &o, &report, &count[0]), *at = strstr(svg, " d=\"") + 4;
    double x = 0, y = 0, start[2] = {0, 0}, lo = 1e9, hi = -1e9;
    for (char command = 0; *at != '"';) {
        if (*at >= 'a' && *at <= 'z') {
            command = *at++;
            if (command == 'z') x = start[0], y = start[1];
            continue;
        }
        if (*at == ' ') at++;
        const double first = strtod(at, &at);
        if (*at == ' ') at++;
        const double second = command == 'h' || command == 'v' ? 0 : strtod(at, &at);
        x += command == 'v' ? 0 : first;
        y += command == 'v' ? first : command == 'h' ? 0 : second;
        if (command == 'm') start[0] = x, start[1] = y, command = 'l'; /* the first is from (0, 0) */
        lo = x < lo ? x : lo, hi = x > hi ? x : hi;
        assert_true(x > -100 && x < 100100 && y > -100 && y < 100100);
    }
    assert_true(hi - lo > 30000);
    free(svg);
    froe_tree_free(tree);
}

/* Two squares in one place: the one of the group with higher priority is seen. */
static void the_group_of_higher_priority_is_seen(void **state) {
    (void)state;
    static const double square[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    const size_t starts[2] = {0, 4};
    froe_scene *scene = scene_of(3);
    for (int i = 0; i < 2; i++) {
        froe_objects one = froe_objects_defaults();
        assert_int_equal(froe_scene_add_group(scene, &(froe_group){.name = i ? "upper" : "lower"}, &one.group),
                         FROE_OK);
        one.count = 1, one.coords = square, one.starts = starts;
        assert_int_equal(froe_scene_add(scene, &one, NULL), FROE_OK);
    }
    froe_tree *tree = tree_of(scene, "density", 1);
    for (int32_t first = -1; first <= 1; first += 2) {
        const int32_t priorities[2] = {first, 0};
        froe_render_options o = froe_render_defaults();
        froe_render_report report;
        size_t count;
        o.priorities = priorities, o.ids = FROE_IDS_OBJECT, o.lines = 0;
        char *svg = render(tree, "priority.svg", &o, &report, &count);
        assert_int_equal(report.picture.shapes, 1);
        assert_int_equal(occurrences(svg, first > 0 ? "data-group=\"lower\"" : "data-group=\"upper\""), 1);
        free(svg);
    }
    froe_tree_free(tree);
}

/* Each layer is scaled by itself, and none where a step of the page is 1. */
static void layers_are_scaled_by_decimals(void **state) {
    (void)state;
    froe_tree *tree = cube();
    for (int decimals = 0; decimals < 3; decimals++) {
        froe_render_options o = froe_render_defaults();
        froe_render_report report;
        size_t count;
        o.layers = FROE_LAYERS_OBJECT, o.decimals = decimals;
        char *svg = render(tree, "layers.svg", &o, &report, &count);
        const size_t layers = occurrences(svg, "inkscape:groupmode=\"layer\"");
        assert_true(layers > 1);
        assert_int_equal(occurrences(svg, decimals == 1 ? "scale(0.1)" : "scale(0.01)"), decimals ? layers : 0);
        free(svg);
    }
    froe_tree_free(tree);
}

static bool count_line(void *user, const froe_stroke *line) {
    (void)line;
    ++*(int *)user;
    return true;
}

/* Where all ends of a line come to the same step of the page it is left out, of files and of what is told. */
static void lines_shorter_than_a_step_are_left_out(void **state) {
    (void)state;
    static const double grain[] = {0.25, 0.25, 0.01, 0.25 + 1e-9, 0.25, 0.01, 0.25, 0.25 + 1e-9, 0.01},
                        whole[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    froe_scene *scene = scene_of(3);
    froe_objects one = froe_objects_defaults();
    froe_render_options o = froe_render_defaults();
    froe_render_report report;
    size_t count;
    int told = 0;
    one.count = 1, one.coords = whole;
    assert_int_equal(froe_scene_add(scene, &one, NULL), FROE_OK);
    one.coords = grain;
    assert_int_equal(froe_scene_add(scene, &one, NULL), FROE_OK);
    froe_tree *tree = tree_of(scene, "density", 1);
    o.decimals = 0, o.shading = FROE_SHADE_NONE, o.hidden = true;
    assert_int_equal(froe_render_lines(tree, count_line, &told, &o, &report, NULL), FROE_OK);
    assert_true(report.picture.strokes > 1 && (uint64_t)told < report.picture.strokes && told > 0);
    free(render(tree, "grain.csv", &o, &report, &count));
    assert_int_equal(report.paths, told);
    froe_tree_free(tree);
}

static void bad_options_are_refused_and_leave_no_file(void **state) {
    (void)state;
    froe_tree *tree = cube(), *flat = tree_of(random_segments(10, 0.1, 1, 0), "density", 1);
    froe_diagnostic why;
    froe_render_options o = froe_render_defaults();
    o.decimals = 7;
    assert_int_equal(froe_render(tree, "none.svg", &o, NULL, &why), FROE_E_OPTIONS);
    o = froe_render_defaults();
    o.lines |= FROE_LINE_END;
    assert_int_equal(froe_render(tree, "none.svg", &o, NULL, &why), FROE_E_OPTIONS);
    assert_non_null(strstr(why.message, "0x400"));
    o = froe_render_defaults();
    o.camera.width = 0;
    assert_int_equal(froe_render(tree, "none.svg", &o, NULL, &why), FROE_E_OPTIONS);
    o = froe_render_defaults();
    memcpy(o.camera.eye, o.camera.target, sizeof o.camera.eye);
    assert_int_equal(froe_render(tree, "none.svg", &o, NULL, &why), FROE_E_ARG);
    o.size = 1;
    assert_int_equal(froe_render(tree, "none.svg", &o, NULL, &why), FROE_E_OPTIONS);
    assert_int_equal(froe_render(tree, "none.gif", NULL, NULL, &why), FROE_E_OPTIONS);
    assert_int_equal(froe_render(tree, "none.png", NULL, NULL, &why), FROE_E_UNSUPPORTED);
    assert_non_null(strstr(why.message, "froe_render_png()"));
    assert_int_equal(froe_render(flat, "none.svg", NULL, NULL, &why), FROE_E_UNSUPPORTED);
    assert_int_equal(froe_render(tree, "no/such/folder/none.svg", NULL, NULL, &why), FROE_E_IO);
    assert_null(fopen("none.svg", "rb"));
    froe_tree_free(tree), froe_tree_free(flat);
}

static froe_status render_with(void *user, const froe_allocator *alloc) {
    froe_render_options o = froe_render_defaults();
    o.alloc = alloc;
    return froe_render(user, "memory.svg", &o, NULL, NULL);
}

/* With what is given for each group: one is glass, and has priority. */
static froe_status render_groups_with(void *user, const froe_allocator *alloc) {
    static const double opacity[2] = {1, 0.5};
    static const int32_t priorities[2] = {0, 1};
    froe_render_options o = froe_render_defaults();
    o.alloc = alloc, o.opacity = opacity, o.priorities = priorities;
    return froe_render(user, "memory.svg", &o, NULL, NULL);
}

static froe_status animate_with(void *user, const froe_allocator *alloc) {
    froe_render_options o = froe_render_defaults();
    froe_camera cameras[2];
    o.alloc = alloc;
    o.layers = FROE_LAYERS_OBJECT;
    o.ids = FROE_IDS_OBJECT;
    const froe_status status = froe_camera_turn(&o.camera, froe_tree_scene(user), 2, cameras, NULL);
    return status ? status : froe_render_animation(user, "memory.svg", &o, cameras, 2, 4, NULL, NULL);
}

static void an_animation_shows_each_picture_for_its_time(void **state) {
    (void)state;
    froe_tree *tree = cube();
    froe_render_options o = froe_render_defaults();
    froe_camera cameras[4];
    froe_render_report report;
    froe_diagnostic why = {.message = ""};
    size_t size;
    assert_int_equal(froe_camera_turn(&o.camera, froe_tree_scene(tree), 4, cameras, NULL), FROE_OK);
    if (froe_render_animation(tree, "turn.svg", &o, cameras, 4, 2, &report, &why)) fail_msg("%s", why.message);
    char *text = read_file("turn.svg", &size);
    assert_int_equal(size, report.bytes);
    assert_int_equal(occurrences(text, "<animate "), 4);
    assert_int_equal(occurrences(text, "<g class=\"other\" display=\"none\">"), 3);
    assert_int_equal(occurrences(text, "<path "), report.paths);
    assert_int_equal(occurrences(text, "<g"), occurrences(text, "</g>"));
    assert_int_equal(froe_render_animation(tree, "turn.png", &o, cameras, 4, 2, NULL, &why), FROE_E_OPTIONS);
    assert_int_equal(froe_render_animation(tree, "none.svg", &o, cameras, 4, 0, NULL, &why), FROE_E_OPTIONS);
    assert_int_equal(froe_render_animation(tree, "none.svg", &o, cameras, 0, 1, NULL, &why), FROE_E_ARG);
    free(text);
    froe_tree_free(tree);
}

static void every_allocation_may_fail(void **state) {
    (void)state;
    froe_tree *tree = cube();
    assert_true(test_memory_each(render_with, tree) > 30);
    assert_true(test_memory_each(render_groups_with, tree) > 30);
    assert_true(test_memory_each(animate_with, tree) > 60);
    froe_tree_free(tree);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_same_bytes_in_every_format),
        cmocka_unit_test(the_same_bytes_with_any_number_of_threads),
        cmocka_unit_test(a_cube_shows_three_faces_and_nine_edges),
        cmocka_unit_test(through_glass_one_sees_what_is_behind),
        cmocka_unit_test(a_scene_brings_its_colours),
        cmocka_unit_test(coordinates_do_not_drift),
        cmocka_unit_test(the_group_of_higher_priority_is_seen),
        cmocka_unit_test(lines_shorter_than_a_step_are_left_out),
        cmocka_unit_test(layers_are_scaled_by_decimals),
        cmocka_unit_test(bad_options_are_refused_and_leave_no_file),
        cmocka_unit_test(an_animation_shows_each_picture_for_its_time),
        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
