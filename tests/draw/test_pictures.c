/* test_pictures.c: what comes out: formats, sizes, the same bytes again, every combination of options. */
#include "pictures.h"
#include "tree/draft.h"
#include <cairo.h>
#include <math.h>
#include <stdio.h>

/* -------------------------------------------------------------- inspection -- */

/* Elements nest, attributes are quoted, nothing follows the root: enough XML for what Cairo writes. */
static void assert_well_formed(const char *svg) {
    const char *stack[64];
    int depth = 0, elements = 0;
    for (const char *s = strchr(svg, '<'); s; s = strchr(s + 1, '<')) {
        const char *end = strchr(s, '>');
        assert_non_null(end);
        if (s[1] == '?' || s[1] == '!') continue;
        if (s[1] == '/') {
            assert_true(depth > 0);
            const char *open = stack[--depth];
            size_t length = (size_t)(end - s - 2);
            assert_memory_equal(open + 1, s + 2, length);
            continue;
        }
        elements++;
        int quotes = 0;
        for (const char *c = s; c < end; c++) quotes += *c == '"';
        assert_int_equal(quotes % 2, 0);
        if (end[-1] != '/') {
            assert_true(depth < 64);
            stack[depth++] = s;
        }
    }
    assert_int_equal(depth, 0);
    assert_true(elements > 2);
}

/* All path coordinates are numbers on, or just beyond, the page. */
static void assert_on_page(const char *svg, double width, double height) {
    double most = fmax(width, height) + 64;
    assert_null(strstr(svg, "nan"));
    assert_null(strstr(svg, "inf"));
    for (const char *d = strstr(svg, " d=\""); d; d = strstr(d + 1, " d=\"")) {
        for (const char *c = d + 4; *c != '"';) {
            char *next;
            double x = strtod(c, &next);
            if (next != c) assert_true(x >= -64 && x <= most);
            c = next == c ? c + 1 : next;
        }
    }
}

static void assert_pdf(image_bytes p) {
    assert_memory_equal(p.bytes, "%PDF-", 5);
    assert_memory_equal(p.bytes + p.count - 6, "%%EOF\n", 6);
}

/* ------------------------------------------------------------------- tests -- */

static void the_extension_names_the_format_in_any_case(void **state) {
    (void)state;
    froe_draw_format f = FROE_DRAW_FORMAT_COUNT;
    assert_true(froe_draw_format_of("a/b.c/x.SVG", &f) && f == FROE_DRAW_SVG);
    assert_true(froe_draw_format_of("x.pdf", &f) && f == FROE_DRAW_PDF);
    assert_true(froe_draw_format_of("x.y.Png", &f) && f == FROE_DRAW_PNG);
    f = FROE_DRAW_PDF;
    assert_false(froe_draw_format_of("x.jpeg", &f) || froe_draw_format_of("svg", &f) || froe_draw_format_of("", &f));
    assert_false(froe_draw_format_of("x.svgz", &f) || froe_draw_format_of("x.sv", &f) || froe_draw_format_of(NULL, &f));
    assert_int_equal(f, FROE_DRAW_PDF);
}

static void names_are_those_of_the_command_line(void **state) {
    (void)state;
    assert_string_equal(froe_draw_style_name(FROE_DRAW_EXPLODED), "exploded");
    assert_null(froe_draw_style_name(FROE_DRAW_STYLE_COUNT));
    assert_string_equal(froe_draw_layer_name(FROE_DRAW_OBJECTS), "objects");
    assert_null(froe_draw_layer_name((froe_draw_layer)3));
    assert_null(froe_draw_layer_name((froe_draw_layer)16));
}

static void every_combination_of_layers_and_styles_draws_in_every_format(void **state) {
    (void)state;
    froe_tree *trees[] = {tree_of(random_segments(40, 0.4, 1, 0), "autopartition", 0),
                          tree_of(random_triangles(12, 0.8), "density", 1), tree_of(mixed_scene(2), "density", 1),
                          tree_of(mixed_scene(3), "density", 1)};
    for (size_t t = 0; t < 4; t++)
        for (int style = FROE_DRAW_FLAT; style < FROE_DRAW_STYLE_COUNT; style++) {
            int dim = froe_scene_dim(froe_tree_scene(trees[t]));
            if ((style == FROE_DRAW_FLAT) != (dim == 2)) continue;
            for (uint32_t show = 0; show < 16; show++) {
                froe_draw_options o = froe_draw_defaults();
                o.style = (froe_draw_style)style;
                o.show = show;
                o.width = 240;
                o.title = show % 2 ? "All (of it) & <more>" : NULL;
                o.legend = show % 3;
                o.max_depth = show % 5;
                o.axis = (int)(show % 4) - 1;
                o.at = 0.4;
                o.up = (int)(show % 3);
                image_bytes svg = picture_of(trees[t], FROE_DRAW_SVG, &o),
                            pdf = picture_of(trees[t], FROE_DRAW_PDF, &o);
                assert_well_formed(svg.bytes);
                assert_on_page(svg.bytes, 240, 480);
                assert_pdf(pdf);
                image_bytes png = picture_of(trees[t], FROE_DRAW_PNG, &o);
                cairo_surface_t *image = image_of(png);
                assert_int_equal(cairo_image_surface_get_width(image), 240);
                cairo_surface_destroy(image);
                free(svg.bytes);
                free(pdf.bytes);
                free(png.bytes);
            }
        }
    for (size_t t = 0; t < 4; t++) froe_tree_free(trees[t]);
}

static void the_same_tree_gives_the_same_bytes(void **state) {
    (void)state;
    for (int dim = 2; dim <= 3; dim++) {
        froe_draw_options o = froe_draw_defaults();
        if (dim == 3) o.style = FROE_DRAW_EXPLODED;
        o.title = "Same";
        for (int f = 0; f < FROE_DRAW_FORMAT_COUNT; f++) {
            froe_tree *a =
                tree_of(dim == 2 ? random_segments(300, 0.2, 1, 0) : random_triangles(60, 0.5), "density", 1);
            froe_tree *b =
                tree_of(dim == 2 ? random_segments(300, 0.2, 1, 0) : random_triangles(60, 0.5), "density", 1);
            assert_same_picture(picture_of(a, (froe_draw_format)f, &o), picture_of(b, (froe_draw_format)f, &o));
            assert_same_picture(picture_of(a, (froe_draw_format)f, NULL), picture_of(a, (froe_draw_format)f, NULL));
            froe_tree_free(a);
            froe_tree_free(b);
        }
    }
}

/* The long segment cuts the square in two, the short one the lower half. */
static froe_tree *two_cuts(double factor) {
    froe_scene *scene = scene_of(2);
    double c[] = {0, 0.5, 1, 0.5, 0.5, 0, 0.5, 0.375};
    const froe_cut cuts[2] = {{.kind = FROE_CUT_OBJECT, .id = {0}}, {.kind = FROE_CUT_OBJECT, .id = {1}}};
    const tree_meta meta = {.method = "hand", .leaf = 0};
    froe_allocator alloc = support_allocator(NULL);
    tree_draft draft;
    froe_tree *tree = NULL;
    uint32_t half, quarter;
    for (int i = 0; i < 8; i++) c[i] *= factor;
    add(scene, FROE_SEGMENT, 2, c, NULL, NULL);
    assert_int_equal(draft_new(&alloc, 2, 0, &draft), FROE_OK);
    assert_int_equal(draft_split(&draft, 0, cuts, 0, &half), FROE_OK);
    assert_int_equal(draft_list(&draft, 0) || draft_piece(&draft, 0, 0, NULL, 0), FROE_OK);
    assert_int_equal(draft_split(&draft, half, cuts + 1, 0, &quarter), FROE_OK);
    assert_int_equal(draft_list(&draft, half) || draft_piece(&draft, half, 1, NULL, 0), FROE_OK);
    draft_leaf(&draft, half + 1, 0);
    draft_leaf(&draft, quarter, 0);
    draft_leaf(&draft, quarter + 1, 0);
    assert_int_equal(draft_seal(&draft, NULL, 0, scene, &meta, &tree), FROE_OK);
    draft_free(&draft);
    froe_scene_free(scene);
    return tree;
}

/* With the scale bar away, nothing on the page tells how large the scene is. */
static void scaling_a_scene_by_a_power_of_two_does_not_change_its_picture(void **state) {
    (void)state;
    froe_draw_options o = froe_draw_defaults();
    o.legend = false;
    static const double factors[] = {0x1p-1070, 0x1p-1000, 0x1p-30, 8, 0x1p900, 0x1p1022};
    for (size_t i = 0; i < sizeof factors / sizeof *factors; i++) {
        bool far = factors[i] < 0x1p-60 || factors[i] > 0x1p60; /* then builders may choose other cuts */
        froe_tree *one = far ? two_cuts(1) : tree_of(random_segments(100, 0.3, 1, 0), "density", 1);
        froe_tree *other = far ? two_cuts(factors[i]) : tree_of(random_segments(100, 0.3, factors[i], 0), "density", 1);
        assert_same_picture(picture_of(one, FROE_DRAW_SVG, &o), picture_of(other, FROE_DRAW_SVG, &o));
        froe_tree_free(one);
        froe_tree_free(other);
    }
}

static void a_page_has_the_size_that_was_asked_for(void **state) {
    (void)state;
    froe_tree *tree = tree_of(random_segments(50, 0.2, 1, 0), "density", 1);
    froe_draw_options o = froe_draw_defaults();
    o.width = 301;
    o.height = 97;
    o.margin = 0;
    o.scale = 2.5;
    image_bytes png = picture_of(tree, FROE_DRAW_PNG, &o);
    cairo_surface_t *image = image_of(png);
    assert_int_equal(cairo_image_surface_get_width(image), 753);
    assert_int_equal(cairo_image_surface_get_height(image), 243);
    cairo_surface_destroy(image);
    free(png.bytes);
    image_bytes svg = picture_of(tree, FROE_DRAW_SVG, &o);
    assert_non_null(strstr(svg.bytes, "width=\"301px\" height=\"97px\" viewBox=\"0 0 301 97\""));
    free(svg.bytes);
    froe_tree_free(tree);
}

static void cells_are_darker_the_deeper_they_lie(void **state) {
    (void)state;
    froe_tree *tree = two_cuts(1);
    froe_draw_options o = froe_draw_defaults();
    o.show = FROE_DRAW_CELLS;
    o.legend = false;
    o.margin = 0;
    o.width = o.height = 200;
    o.lo[0] = o.lo[1] = 0;
    o.hi[0] = o.hi[1] = 1;
    image_bytes png = picture_of(tree, FROE_DRAW_PNG, &o);
    cairo_surface_t *image = image_of(png);
    uint32_t shallow = pixel(image, 100, 50), left = pixel(image, 50, 150), right = pixel(image, 150, 150);
    assert_int_equal(left, right);
    assert_true(lightness(shallow) > lightness(left) + 100);
    assert_int_equal(pixel(image, 3, 3), shallow);
    assert_int_equal(pixel(image, 197, 197), right);
    cairo_surface_destroy(image);
    free(png.bytes);
    o.show = FROE_DRAW_OBJECTS;
    o.scale = 4;
    png = picture_of(tree, FROE_DRAW_PNG, &o);
    image = image_of(png);
    assert_true(lightness(pixel(image, 120, 400)) < 300); /* ink on the long segment */
    assert_true(lightness(pixel(image, 400, 680)) < 300);
    assert_true(lightness(pixel(image, 400, 450)) > 700); /* paper between them: y points up */
    cairo_surface_destroy(image);
    free(png.bytes);
    froe_tree_free(tree);
}

static void a_clear_background_is_transparent(void **state) {
    (void)state;
    froe_tree *tree = tree_of(random_segments(5, 0.2, 1, 0), "density", 1);
    froe_draw_options o = froe_draw_defaults();
    o.background = FROE_DRAW_CLEAR;
    image_bytes png = picture_of(tree, FROE_DRAW_PNG, &o);
    cairo_surface_t *image = image_of(png);
    uint32_t corner;
    memcpy(&corner, cairo_image_surface_get_data(image), 4);
    assert_int_equal(corner, 0);
    cairo_surface_destroy(image);
    free(png.bytes);
    froe_tree_free(tree);
}

static void max_depth_and_detail_leave_out_cells_and_say_so(void **state) {
    (void)state;
    froe_tree *tree = tree_of(random_segments(3000, 0.01, 1, 0), "density", 1);
    froe_draw_options o = froe_draw_defaults();
    o.show = FROE_DRAW_CELLS | FROE_DRAW_CUTS;
    o.detail = 0;
    image_bytes all = picture_of(tree, FROE_DRAW_SVG, &o);
    o.detail = 64;
    image_bytes coarse = picture_of(tree, FROE_DRAW_SVG, &o);
    assert_true(coarse.count < all.count * 3 / 4);
    o.detail = 0;
    o.max_depth = 4;
    o.show = FROE_DRAW_CELLS;
    image_bytes shallow = picture_of(tree, FROE_DRAW_SVG, &o);
    o.legend = false;
    image_bytes silent = picture_of(tree, FROE_DRAW_SVG, &o);
    assert_true(silent.count + 2000 < shallow.count); /* the sentence, in strokes */
    size_t rings = 0;
    for (const char *z = strstr(silent.bytes, " Z"); z; z = strstr(z + 1, " Z")) rings++;
    assert_true(rings > 2 && rings <= 16 + 1); /* cells of depth 4 at most, and the frame */
    free(all.bytes);
    free(coarse.bytes);
    free(shallow.bytes);
    free(silent.bytes);
    froe_tree_free(tree);
}

/* ---------------------------------------------------------------- extremes -- */

static void draw_everything(froe_tree *tree) {
    int dim = froe_scene_dim(froe_tree_scene(tree));
    for (int style = FROE_DRAW_FLAT; style < FROE_DRAW_STYLE_COUNT; style++) {
        froe_draw_options o = froe_draw_defaults();
        if ((style == FROE_DRAW_FLAT) != (dim == 2)) continue;
        o.style = (froe_draw_style)style;
        o.show = 15;
        o.detail = 0;
        image_bytes svg = picture_of(tree, FROE_DRAW_SVG, &o), png = picture_of(tree, FROE_DRAW_PNG, &o);
        assert_well_formed(svg.bytes);
        assert_on_page(svg.bytes, 960, 1920);
        free(svg.bytes);
        free(png.bytes);
    }
    froe_tree_free(tree);
}

static void empty_scenes_and_single_points_have_pictures(void **state) {
    (void)state;
    const double points[] = {3, 4, 5, 0, 0, 0, 1e308, -1e308, 1e308, 5e-324, 5e-324, 5e-324};
    for (int dim = 2; dim <= 3; dim++) {
        draw_everything(tree_of(scene_of(dim), "density", 1));
        for (int i = 0; i < 4; i++) {
            froe_scene *scene = scene_of(dim);
            add(scene, FROE_POINT, 1, points + 3 * i, NULL, NULL);
            draw_everything(tree_of(scene, "density", 1));
        }
    }
}

static void huge_tiny_and_distant_scenes_stay_on_the_page(void **state) {
    (void)state;
    const double m = 1.7976931348623157e308, d = 5e-324;
    const double huge[] = {-m, -m, m, m, -m, m, m, -m, 0, 0, 1, 1, -m, 0, m, 0};
    const double tiny[] = {0, 0, d, d, d, 0, 0, d, 0, d, 3 * d, 2 * d, 0, 0, d, 0};
    const double far[] = {1e300, 1e300, 1e300 * (1 + 0x1p-52), 1e300, 1e300, 1e300, 1e300, 1e300 * (1 + 0x1p-52)};
    const double mixed[] = {0, 0, d, d, 1e308, 1e308, -1e308, 1e-308, 1, 1, 2, 2};
    const double flat[] = {-1, 0, 1, 0, -0.5, 0, 0.5, 0};
    const double thin[] = {0, 0, 1, 1e-300, 0, 1e-300, 1, 0};
    const struct {
        const double *coords;
        size_t count;
    } scenes[] = {{huge, 4}, {tiny, 4}, {far, 2}, {mixed, 3}, {flat, 2}, {thin, 2}};
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++)
        for (uint32_t leaf = 0; leaf < 2; leaf++) {
            froe_scene *scene = scene_of(2);
            add(scene, FROE_SEGMENT, scenes[i].count, scenes[i].coords, NULL, NULL);
            draw_everything(tree_of(scene, leaf ? "density" : "autopartition", leaf));
        }
    for (uint32_t leaf = 0; leaf < 2; leaf++) {
        const double solid[] = {-m, -m, -m, m, -m, -m, m, m, m, 0, 0, 0, d, 0, 0, 0, d, 0};
        froe_scene *scene = scene_of(3);
        add(scene, FROE_POLYGON, 2, solid, NULL, NULL);
        draw_everything(tree_of(scene, "autopartition", leaf));
    }
    const double centre[] = {0, 0}, radius = m / 2;
    froe_scene *scene = scene_of(2);
    add(scene, FROE_BALL, 1, centre, &radius, NULL);
    draw_everything(tree_of(scene, "density", 1));
}

static void a_window_deep_inside_stays_on_the_page(void **state) {
    (void)state;
    froe_scene *scene = scene_of(2);
    const double segments[] = {-1e300, -1e290, 1e300, 1e290, 0.5, -1, 0.5, 1}, centre[] = {1e10, 0}, radius = 1e10;
    const double box[] = {-1e200, -1e200, 1e-9, 1e-9};
    add(scene, FROE_SEGMENT, 2, segments, NULL, NULL);
    add(scene, FROE_BALL, 1, centre, &radius, NULL);
    add(scene, FROE_BOX, 1, box, NULL, NULL);
    froe_tree *tree = tree_of(scene, "density", 1);
    froe_draw_options o = froe_draw_defaults();
    o.lo[0] = o.lo[1] = -1e-6;
    o.hi[0] = o.hi[1] = 1e-6;
    image_bytes svg = picture_of(tree, FROE_DRAW_SVG, &o);
    assert_on_page(svg.bytes, 960, 1920);
    assert_well_formed(svg.bytes);
    free(svg.bytes);
    froe_tree_free(tree);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_extension_names_the_format_in_any_case),
        cmocka_unit_test(names_are_those_of_the_command_line),
        cmocka_unit_test(every_combination_of_layers_and_styles_draws_in_every_format),
        cmocka_unit_test(the_same_tree_gives_the_same_bytes),
        cmocka_unit_test(scaling_a_scene_by_a_power_of_two_does_not_change_its_picture),
        cmocka_unit_test(a_page_has_the_size_that_was_asked_for),
        cmocka_unit_test(cells_are_darker_the_deeper_they_lie),
        cmocka_unit_test(a_clear_background_is_transparent),
        cmocka_unit_test(max_depth_and_detail_leave_out_cells_and_say_so),
        cmocka_unit_test(empty_scenes_and_single_points_have_pictures),
        cmocka_unit_test(huge_tiny_and_distant_scenes_stay_on_the_page),
        cmocka_unit_test(a_window_deep_inside_stays_on_the_page),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
