/* test_render_png.c: the picture as PNG: the same bytes again, and the pixels that the PDF of the same picture has when
 * Cairo paints its operators. */
#include "pictures.h"
#include "vector/pages.h"
#include <cairo.h>
#include <math.h>
#include <stdio.h>

enum { WIDTH = 400, HEIGHT = 300 };

static void paint_operator(cairo_t *cr, const page_operator *op, double *fill, double *alpha) {
    const double *n = op->number;
    const char *name = op->name;
    if (!strcmp(name, "m")) cairo_move_to(cr, n[0], n[1]);
    if (!strcmp(name, "l")) cairo_line_to(cr, n[0], n[1]);
    if (!strcmp(name, "h")) cairo_close_path(cr);
    if (!strcmp(name, "re")) cairo_rectangle(cr, n[0], n[1], n[2], n[3]);
    if (!strcmp(name, "w")) cairo_set_line_width(cr, n[0]);
    if (!strcmp(name, "d")) cairo_set_dash(cr, n, op->count == 3 ? 2 : 0, 0);
    if (!strcmp(name, "j")) cairo_set_line_join(cr, (cairo_line_join_t)n[0]);
    if (!strcmp(name, "gs")) *alpha = n[0] / 255;
    if (!strcmp(name, "cm")) {
        const cairo_matrix_t matrix = {n[0], n[1], n[2], n[3], n[4], n[5]};
        cairo_transform(cr, &matrix);
    }
    if (!strcmp(name, "rg") || !strcmp(name, "RG")) memcpy(fill + (name[0] == 'R' ? 3 : 0), n, 3 * sizeof *n);
    if (!strcmp(name, "S") || !strcmp(name, "B")) {
        cairo_set_source_rgba(cr, fill[3], fill[4], fill[5], *alpha);
        cairo_stroke_preserve(cr);
    }
    if (!strcmp(name, "f") || !strcmp(name, "B")) {
        cairo_set_source_rgba(cr, fill[0], fill[1], fill[2], *alpha);
        cairo_fill_preserve(cr);
    }
    if (strchr("SBf", name[0]) && !name[1]) cairo_new_path(cr);
}

/* The page of a PDF, turned so that its y points up, as images have it. */
static cairo_surface_t *image_of_pdf(const page_bytes *pdf) {
    cairo_surface_t *image = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, WIDTH, HEIGHT);
    cairo_t *cr = cairo_create(image);
    double colours[6] = {0}, alpha = 1;
    const char *end, *at = page_content(pdf, &end);
    cairo_translate(cr, 0, HEIGHT);
    cairo_scale(cr, 1, -1);
    for (page_operator op; page_next(&at, end, &op);) paint_operator(cr, &op, colours, &alpha);
    assert_int_equal(cairo_status(cr), CAIRO_STATUS_SUCCESS);
    cairo_destroy(cr);
    cairo_surface_flush(image);
    return image;
}

/* Coordinates of the PDF are rounded to 1/256 of a pixel, and colours to 255 steps: no pixel is far off. */
static void compare(const froe_tree *tree, const froe_render_options *o) {
    page_bytes pdf = page_of(tree, FROE_RENDER_PDF, o, NULL);
    froe_diagnostic why = {.message = ""};
    if (froe_render_png(tree, "page.png", o, NULL, &why)) fail_msg("%s", why.message);
    cairo_surface_t *png = cairo_image_surface_create_from_png("page.png"), *page = image_of_pdf(&pdf);
    assert_int_equal(cairo_image_surface_get_width(png), WIDTH);
    assert_int_equal(cairo_image_surface_get_height(png), HEIGHT);
    size_t painted = 0;
    for (int y = 0; y < HEIGHT; y++) {
        const uint8_t *a = cairo_image_surface_get_data(png) + y * cairo_image_surface_get_stride(png),
                      *b = cairo_image_surface_get_data(page) + y * cairo_image_surface_get_stride(page);
        for (int x = 0; x < 4 * WIDTH; x++) {
            painted += a[x] != 0;
            if (abs(a[x] - b[x]) > 6) fail_msg("byte %d of line %d is %d, but %d in PDF", x, y, a[x], b[x]);
        }
    }
    assert_true(painted > 10000);
    cairo_surface_destroy(png), cairo_surface_destroy(page);
    free(pdf.text);
}

static void png_and_pdf_show_the_same_pixels(void **state) {
    (void)state;
    froe_tree *tree = tree_of(random_triangles(40, 0.6), "density", 1);
    froe_render_options o = froe_render_defaults();
    o.camera.width = WIDTH, o.camera.height = HEIGHT;
    o.background = FROE_DRAW_CLEAR;
    compare(tree, &o);
    o.hidden = true;
    o.line_width = 3;
    o.background = 0xFFEEDD;
    compare(tree, &o);
    o.seams = FROE_SEAMS_STROKE;
    o.interleaved = true;
    compare(tree, &o);
    o.interleaved = false;
    o.seams = FROE_SEAMS_TWICE;
    compare(tree, &o);
    froe_tree_free(tree);
}

/* The pixel in the upper left corner, which no face covers, as 0xAARRGGBB. */
static uint32_t corner_pixel(const froe_tree *tree, const froe_render_options *o) {
    uint32_t pixel;
    assert_int_equal(froe_render_png(tree, "corner.png", o, NULL, NULL), FROE_OK);
    cairo_surface_t *png = cairo_image_surface_create_from_png("corner.png");
    const bool opaque = cairo_image_surface_get_format(png) == CAIRO_FORMAT_RGB24;
    memcpy(&pixel, cairo_image_surface_get_data(png), sizeof pixel);
    cairo_surface_destroy(png);
    return opaque ? pixel | 0xFF000000 : pixel;
}

static void a_png_is_white_unless_it_is_to_be_clear(void **state) {
    (void)state;
    froe_tree *tree = tree_of(random_triangles(1, 0.01), "density", 1);
    froe_render_options o = froe_render_defaults();
    o.camera.width = WIDTH, o.camera.height = HEIGHT;
    assert_int_equal(corner_pixel(tree, &o), 0xFFFFFFFF);
    o.background = 0x010203;
    assert_int_equal(corner_pixel(tree, &o), 0xFF010203);
    o.background = FROE_DRAW_CLEAR;
    assert_int_equal(corner_pixel(tree, &o), 0);
    froe_tree_free(tree);
}

static void what_one_sees_through_has_the_same_pixels(void **state) {
    (void)state;
    froe_scene *scene = scene_of(3);
    for (int i = 0; i < 5; i++) {
        const froe_group group = {
            .name = "pane", .material = "pane", .colour = 0x10305060u + 0x20102005u * (uint32_t)i};
        const double z = i, x[9] = {0, 0, z, 2, 0.1 * z, z, 1, 2 - 0.2 * z, z};
        froe_objects objects = froe_objects_defaults();
        assert_int_equal(froe_scene_add_group(scene, &group, &objects.group), FROE_OK);
        objects.count = 1, objects.coords = x;
        assert_int_equal(froe_scene_add(scene, &objects, NULL), FROE_OK);
    }
    froe_tree *tree = tree_of(scene, "density", 1);
    froe_render_options o = froe_render_defaults();
    o.camera.width = WIDTH, o.camera.height = HEIGHT;
    o.background = FROE_DRAW_CLEAR;
    compare(tree, &o);
    froe_tree_free(tree);
}

static void the_same_bytes_again(void **state) {
    (void)state;
    froe_tree *tree = tree_of(random_triangles(60, 0.6), "density", 1);
    static const char *const names[2] = {"a.png", "b"};
    char *bytes[2];
    froe_render_report report;
    for (int i = 0; i < 2; i++) {
        assert_int_equal(froe_render_png(tree, names[i], NULL, &report, NULL), FROE_OK);
        FILE *file = fopen(names[i], "rb");
        bytes[i] = calloc(1, report.bytes + 1);
        assert_int_equal(fread(bytes[i], 1, report.bytes + 1, file), report.bytes);
        fclose(file);
    }
    assert_memory_equal(bytes[0], bytes[1], report.bytes);
    free(bytes[0]), free(bytes[1]);
    froe_tree_free(tree);
}

static froe_status png_with(void *user, const froe_allocator *alloc) {
    froe_render_options o = froe_render_defaults();
    o.alloc = alloc;
    return froe_render_png(user, "memory.png", &o, NULL, NULL);
}

static void every_allocation_may_fail(void **state) {
    (void)state;
    froe_tree *tree = tree_of(random_triangles(6, 0.6), "density", 1);
    assert_true(test_memory_each(png_with, tree) > 20);
    froe_tree_free(tree);
}

static void pixels_out_of_range_are_refused_by_name(void **state) {
    (void)state;
    froe_tree *tree = tree_of(random_triangles(6, 0.6), "density", 1);
    froe_diagnostic why;
    froe_render_options o = froe_render_defaults();
    o.pixels = 0;
    assert_int_equal(froe_render_png(tree, "none.png", &o, NULL, &why), FROE_E_OPTIONS);
    assert_non_null(strstr(why.message, "'pixels'"));
    o.pixels = 64;
    assert_int_equal(froe_render_png(tree, "none.png", &o, NULL, &why), FROE_E_OPTIONS);
    assert_non_null(strstr(why.message, "'width'"));
    memset(&o, 0xA5, sizeof o); /* pointers that lead nowhere are not followed */
    assert_int_equal(froe_render_png(tree, "none.png", &o, NULL, &why), FROE_E_OPTIONS);
    assert_non_null(strstr(why.message, "froe_render_defaults"));
    assert_int_equal(froe_render_png(tree, NULL, NULL, NULL, &why), FROE_E_ARG);
    assert_null(fopen("none.png", "rb"));
    froe_tree_free(tree);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(png_and_pdf_show_the_same_pixels),
        cmocka_unit_test(a_png_is_white_unless_it_is_to_be_clear),
        cmocka_unit_test(what_one_sees_through_has_the_same_pixels),
        cmocka_unit_test(the_same_bytes_again),
        cmocka_unit_test(every_allocation_may_fail),
        cmocka_unit_test(pixels_out_of_range_are_refused_by_name),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
