/* test_map.c: maps are read as maps: areas of features, degrees, marks with names, and no line that is no object. */
#include "pictures.h"
#include "support/memory.h"
#include <stdio.h>

/* A square ring with a square hole, of one feature, and a bent line of another. */
static froe_scene *features(void) {
    static const double ring[] = {0, 0, 8, 0, 8, 8, 0, 8, 8, 8, 8, 0, 0, 0, 0, 8,
                                  3, 3, 5, 3, 5, 3, 5, 5, 5, 5, 3, 5, 3, 5, 3, 3};
    static const double bent[] = {10, 0, 14, 8, 14, 8, 18, 0, 18, 0, 19, 4};
    froe_scene *scene = scene_of(2);
    const froe_group names[] = {{.name = "ring"}, {.name = "line"}};
    const double *const coords[] = {ring, bent};
    const size_t counts[] = {8, 3};
    for (int g = 0; g < 2; g++) {
        uint32_t id;
        assert_int_equal(froe_scene_add_group(scene, &names[g], &id), FROE_OK);
        uint32_t groups[8];
        for (size_t i = 0; i < counts[g]; i++) groups[i] = id;
        froe_objects objects = froe_objects_defaults();
        objects.kind = FROE_SEGMENT, objects.count = counts[g], objects.coords = coords[g], objects.groups = groups;
        assert_int_equal(froe_scene_add(scene, &objects, NULL), FROE_OK);
    }
    return scene;
}

static froe_draw_options bare(double width, double lo_x, double lo_y, double hi_x, double hi_y) {
    froe_draw_options o = froe_draw_defaults();
    o.show = FROE_DRAW_OBJECTS;
    o.legend = false;
    o.margin = 0;
    o.width = width;
    o.lo[0] = lo_x, o.lo[1] = lo_y, o.hi[0] = hi_x, o.hi[1] = hi_y;
    return o;
}

static bool is_land(uint32_t rgb) {
    return (rgb >> 16) > 0xE0 && (rgb & 255) < 0xD8 && (rgb & 255) > 0x90;
}

static bool is_accent(uint32_t rgb) {
    return (rgb >> 16) > 0xA0 && (rgb >> 8 & 255) < 0x90 && (rgb & 255) < 0x80;
}

static void closed_features_are_filled_with_their_holes_left_out_and_lines_are_not(void **state) {
    (void)state;
    froe_tree *tree = tree_of(features(), "density", 1);
    froe_draw_options o = bare(200, 0, 0, 20, 20);
    image_bytes png = picture_of(tree, FROE_DRAW_PNG, &o);
    cairo_surface_t *image = image_of(png);
    assert_true(is_land(pixel(image, 10, 190)));   /* 1, 1: within the ring */
    assert_false(is_land(pixel(image, 40, 160)));  /* 4, 4: in its hole */
    assert_false(is_land(pixel(image, 140, 180))); /* 14, 2: under the bent line */
    assert_false(is_land(pixel(image, 100, 50)));
    cairo_surface_destroy(image);
    free(png.bytes);
    o = bare(200, 1, 1, 4, 4); /* the ring goes around the window; the hole reaches into it */
    png = picture_of(tree, FROE_DRAW_PNG, &o);
    image = image_of(png);
    assert_true(is_land(pixel(image, 20, 180)) && is_land(pixel(image, 180, 180)));
    assert_false(is_land(pixel(image, 180, 20)));
    cairo_surface_destroy(image);
    free(png.bytes);
    froe_tree_free(tree);
}

static size_t count_of(const char *text, const char *word) {
    size_t count = 0;
    for (; (text = strstr(text, word)) != NULL; text += strlen(word)) count++;
    return count;
}

static void no_line_is_drawn_that_is_no_object(void **state) {
    (void)state;
    froe_scene *scene = scene_of(2);
    add(scene, FROE_SEGMENT, 1, (const double[]){0, 0, 1, 1}, NULL, NULL);
    froe_tree *tree = tree_of(scene, "density", 1);
    froe_draw_options o = froe_draw_defaults();
    o.legend = false;
    o.show = FROE_DRAW_OBJECTS;
    image_bytes svg = picture_of(tree, FROE_DRAW_SVG, &o);
    assert_int_equal(count_of(svg.bytes, "stroke:rgb"), 1);
    free(svg.bytes);
    froe_tree_free(tree);
}

/* At 60 degrees a degree of longitude is half as long as one of latitude. */
static void degrees_of_longitude_are_shorter_away_from_the_equator(void **state) {
    (void)state;
    for (int geographic = 0; geographic < 2; geographic++) {
        froe_scene *scene = features();
        const froe_crs crs = {.kind = FROE_CRS_GEOGRAPHIC, .name = "WGS 84", .wkt = "", .code = "", .unit = "degree"};
        if (geographic) assert_int_equal(froe_scene_set_crs(scene, &crs), FROE_OK);
        froe_tree *tree = tree_of(scene, "density", 1);
        const froe_draw_options o = bare(200, 0, 55, 10, 65);
        image_bytes png = picture_of(tree, FROE_DRAW_PNG, &o);
        cairo_surface_t *image = image_of(png);
        assert_int_equal(cairo_image_surface_get_height(image), geographic ? 400 : 200);
        cairo_surface_destroy(image);
        free(png.bytes);
        froe_draw_options whole = froe_draw_defaults(); /* numbers of axes and the scale bar */
        image_bytes svg = picture_of(tree, FROE_DRAW_SVG, &whole);
        assert_null(strstr(svg.bytes, "nan"));
        free(svg.bytes);
        froe_tree_free(tree);
    }
}

static void marks_and_accented_objects_are_seen(void **state) {
    (void)state;
    froe_tree *tree = tree_of(features(), "density", 1);
    froe_draw_options o = bare(200, 0, 0, 20, 20);
    const froe_draw_mark marks[] = {{.lo = {12, 15}, .hi = {12, 15}, .kind = FROE_DRAW_MARK_LINE, .label = "Here"},
                                    {.lo = {2, 16}, .hi = {8, 16}, .kind = FROE_DRAW_MARK_LINE},
                                    {.lo = {16, 10}, .hi = {18, 12}, .kind = FROE_DRAW_MARK_BOX}};
    const uint32_t accented[] = {9, 4000000000u};
    o.marks = marks, o.mark_count = 3;
    o.accented = accented, o.accented_count = 2;
    o.scale = 4;
    image_bytes png = picture_of(tree, FROE_DRAW_PNG, &o);
    cairo_surface_t *image = image_of(png);
    assert_true(is_accent(pixel(image, 480, 200)));  /* the dot */
    assert_true(is_accent(pixel(image, 320, 160)));  /* the end of the line */
    assert_true(is_accent(pixel(image, 640, 360)));  /* the edge of the box */
    assert_true(is_accent(pixel(image, 640, 640)));  /* object 9, from 14, 8 to 18, 0, in its middle 16, 4 */
    assert_false(is_accent(pixel(image, 480, 640))); /* object 8 in its middle 12, 4 */
    int dark = 0;
    for (int x = 500; x < 640; x++)
        for (int y = 180; y < 220; y++) dark += lightness(pixel(image, x, y)) < 250;
    assert_true(dark > 40); /* the label */
    cairo_surface_destroy(image);
    free(png.bytes);
    froe_tree_free(tree);
}

/* At 60 degrees half as wide as high: as an object, as one in the accent colour, as a mark. */
static void balls_on_maps_in_degrees_are_ellipses(void **state) {
    (void)state;
    froe_scene *scene = scene_of(2);
    const froe_crs crs = {.kind = FROE_CRS_GEOGRAPHIC, .name = "WGS 84", .wkt = "", .code = "", .unit = "degree"};
    assert_int_equal(froe_scene_set_crs(scene, &crs), FROE_OK);
    add(scene, FROE_BALL, 1, (const double[]){5, 60}, (const double[]){3}, NULL);
    froe_tree *tree = tree_of(scene, "density", 1);
    const froe_draw_mark ball = {.lo = {2, 57}, .hi = {8, 63}, .kind = FROE_DRAW_MARK_BALL};
    const uint32_t object = 0;
    for (int way = 0; way < 3; way++) {
        froe_draw_options o = bare(200, 0, 55, 10, 65);
        o.marks = &ball, o.mark_count = way == 2;
        o.accented = &object, o.accented_count = way == 1;
        image_bytes png = picture_of(tree, FROE_DRAW_PNG, &o);
        cairo_surface_t *image = image_of(png);
        for (int side = -1; side <= 1; side += 2) {
            assert_true(lightness(pixel(image, 100 + 60 * side, 200)) < 640);
            assert_true(lightness(pixel(image, 100, 200 + 120 * side)) < 640);
        }
        cairo_surface_destroy(image);
        free(png.bytes);
    }
    froe_tree_free(tree);
}

/* Pixels of labels, which are of ink, in a part of a picture of marks over nothing. */
static int label_pixels(const froe_draw_mark *marks, size_t count, int left, int right) {
    froe_tree *tree = tree_of(features(), "density", 1);
    froe_draw_options o = bare(800, 20, 20, 40, 40); /* nothing is in the window */
    o.marks = marks, o.mark_count = count;
    image_bytes png = picture_of(tree, FROE_DRAW_PNG, &o);
    cairo_surface_t *image = image_of(png);
    int ink = 0;
    for (int x = left; x < right; x++)
        for (int y = 0; y < 800; y++) ink += lightness(pixel(image, x, y)) < 250;
    cairo_surface_destroy(image);
    free(png.bytes);
    froe_tree_free(tree);
    return ink;
}

static void a_border_of_many_marks_has_one_label(void **state) {
    (void)state;
    const froe_draw_mark ring[] = {
        {.lo = {25, 25}, .hi = {30, 25}, .kind = FROE_DRAW_MARK_LINE, .label = "Here"},
        {.lo = {30, 25}, .hi = {30, 35}, .kind = FROE_DRAW_MARK_LINE, .label = "Here"},
        {.lo = {30, 35}, .hi = {25, 25}, .kind = FROE_DRAW_MARK_LINE, .label = "Here"},
        {.lo = {22, 38}, .hi = {22, 38}, .kind = FROE_DRAW_MARK_LINE, .label = "Here"},
        {.lo = {36, 38}, .hi = {36, 38}, .kind = FROE_DRAW_MARK_LINE, .label = "Here"},
    };
    const int one = label_pixels(ring, 1, 0, 800);
    assert_true(one > 20);
    assert_int_equal(label_pixels(ring, 3, 0, 800), one);
    assert_true(label_pixels(ring + 3, 2, 0, 800) > one * 3 / 2); /* places have one each */
}

/* Where every place is taken, too, a label ends before the edge of the page. */
static void labels_at_the_right_edge_are_whole(void **state) {
    (void)state;
    froe_draw_mark marks[9];
    for (int i = 0; i < 9; i++)
        marks[i] = (froe_draw_mark){
            .lo = {39.5, 30}, .hi = {39.5, 30}, .kind = FROE_DRAW_MARK_LINE, .label = "A long name of a town"};
    const int one = label_pixels(marks, 1, 0, 800);
    assert_true(one > 100);
    assert_int_equal(label_pixels(marks, 9, 790, 800), 0);
}

static void marks_outside_of_the_window_are_counted(void **state) {
    (void)state;
    froe_tree *tree = tree_of(features(), "density", 1);
    froe_draw_options o = bare(100, 0, 0, 10, 10);
    size_t outside = 99;
    const froe_draw_mark marks[] = {{.lo = {5, 5}, .hi = {5, 5}, .kind = FROE_DRAW_MARK_LINE},
                                    {.lo = {-5, 5}, .hi = {15, 6}, .kind = FROE_DRAW_MARK_BOX},
                                    {.lo = {10.5, 5}, .hi = {12, 6}, .kind = FROE_DRAW_MARK_BOX},
                                    {.lo = {5, -9}, .hi = {6, -8}, .kind = FROE_DRAW_MARK_BALL}};
    o.marks = marks, o.mark_count = 4, o.marks_outside = &outside;
    free(picture_of(tree, FROE_DRAW_SVG, &o).bytes);
    assert_int_equal(outside, 2);
    froe_tree_free(tree);
}

static void the_small_map_shows_where_a_window_is(void **state) {
    (void)state;
    froe_tree *tree = tree_of(features(), "density", 1);
    froe_draw_options o = bare(400, 8.2, 0, 9.8, 1.6); /* nothing is in the window */
    o.scale = 4;
    for (int locator = 0; locator < 2; locator++) {
        o.locator = locator;
        image_bytes png = picture_of(tree, FROE_DRAW_PNG, &o);
        cairo_surface_t *image = image_of(png);
        int accents = 0;
        for (int x = 800; x < 1600; x++)
            for (int y = 0; y < 800; y++) accents += is_accent(pixel(image, x, y));
        if (locator ? accents <= 40 : accents > 0) fail_msg("%d pixels in the accent colour", accents);
        cairo_surface_destroy(image);
        free(png.bytes);
    }
    froe_tree_free(tree);
}

/* Points, balls and segments beside a window, in every direction; the last ones touch it. */
static void what_is_beside_the_window_is_not_drawn(void **state) {
    (void)state;
    static const double ways[][2] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}, {0, 0}};
    for (int kind = 0; kind < 3; kind++)
        for (int i = 0; i < 5; i++) {
            static const froe_kind kinds[] = {FROE_POINT, FROE_BALL, FROE_SEGMENT};
            const double x = 5 + 20 * ways[i][0], y = 5 + 20 * ways[i][1];
            froe_scene *scene = scene_of(2);
            add(scene, kinds[kind], 1, (const double[]){x, y, x + 1, y},
                kinds[kind] == FROE_BALL ? (const double[]){1} : NULL, NULL);
            add(scene, FROE_SEGMENT, 2, (const double[]){5, -30, 5, -20, 20, 5, 30, 5}, NULL, NULL);
            froe_tree *tree = tree_of(scene, "density", 1);
            const froe_draw_options o = bare(100, 0, 0, 10, 10);
            image_bytes png = picture_of(tree, FROE_DRAW_PNG, &o);
            cairo_surface_t *image = image_of(png);
            int ink = 0;
            for (int at = 0; at < 100 * 100; at++) ink += lightness(pixel(image, at % 100, at / 100)) < 650;
            if ((ink > 0) != (i == 4)) fail_msg("kind %d, way %d: %d pixels", kind, i, ink);
            cairo_surface_destroy(image);
            free(png.bytes);
            froe_tree_free(tree);
        }
}

/* A segment across a square, in a system of this kind and unit. */
static froe_tree *square_in(froe_crs_kind kind, const char *unit, double x, double y, double size) {
    const froe_crs crs = {.kind = kind, .name = "n", .wkt = "", .code = "", .unit = unit};
    froe_scene *scene = scene_of(2);
    add(scene, FROE_SEGMENT, 1, (const double[]){x, y, x + size, y + size}, NULL, NULL);
    if (kind) assert_int_equal(froe_scene_set_crs(scene, &crs), FROE_OK);
    return tree_of(scene, "density", 1);
}

static bool same_legends(froe_tree *a, froe_tree *b, const froe_draw_options *o) {
    image_bytes p = picture_of(a, FROE_DRAW_SVG, o), q = picture_of(b, FROE_DRAW_SVG, o);
    const bool same = p.count == q.count && !memcmp(p.bytes, q.bytes, p.count);
    free(p.bytes), free(q.bytes);
    froe_tree_free(a), froe_tree_free(b);
    return same;
}

/* Of a unit only its name counts, but for metres, of which thousand are a kilometre, and degrees. */
static void lengths_have_the_unit_of_the_scene(void **state) {
    (void)state;
    const froe_crs_kind plane = FROE_CRS_PROJECTED, globe = FROE_CRS_GEOGRAPHIC;
    assert_true(same_legends(square_in(plane, "metre", 0, 0, 8), square_in(plane, "meter", 0, 0, 8), NULL));
    assert_true(same_legends(square_in(plane, "", 0, 0, 8), square_in(FROE_CRS_UNKNOWN, NULL, 0, 0, 8), NULL));
    assert_false(same_legends(square_in(plane, "metre", 0, 0, 8), square_in(plane, "foot", 0, 0, 8), NULL));
    assert_false(same_legends(square_in(plane, "unit", 0, 0, 8), square_in(plane, "units", 0, 0, 80), NULL));
    assert_false(same_legends(square_in(plane, "metre", 0, 0, 8e4), square_in(plane, "m", 0, 0, 8e4), NULL)); /* km */
    assert_false(same_legends(square_in(globe, "degree", 0, 0, 1e-4), square_in(globe, "degree", 0, 0, 1), NULL));
}

/* East and west, north and south, and steps that divide the circle; near the poles nothing is squeezed. */
static void degrees_are_named_by_their_halves(void **state) {
    (void)state;
    const froe_crs_kind globe = FROE_CRS_GEOGRAPHIC;
    assert_false(
        same_legends(square_in(globe, "degree", 0.25, 0.25, 0.5), square_in(globe, "degree", -0.75, -0.75, 0.5), NULL));
    froe_draw_options o = froe_draw_defaults();
    for (int i = 0; i < 7; i++) {
        o.width = 60 + 40 * i;
        assert_false(same_legends(square_in(globe, "degree", -180, -90, 180),
                                  square_in(FROE_CRS_OTHER, "degree", -180, -90, 180), &o));
    }
    froe_tree *polar = square_in(globe, "degree", 10, 84, 2);
    const froe_draw_options window = bare(200, 10, 84, 12, 86);
    image_bytes png = picture_of(polar, FROE_DRAW_PNG, &window);
    cairo_surface_t *image = image_of(png);
    assert_int_equal(cairo_image_surface_get_height(image), 200);
    cairo_surface_destroy(image);
    free(png.bytes);
    o = froe_draw_defaults(), o.lo[0] = 11.0000000001, o.lo[1] = 85, o.hi[0] = 11.0000000002, o.hi[1] = 85.0000000001;
    png = picture_of(polar, FROE_DRAW_SVG, &o); /* steps with more than nine digits */
    assert_null(strstr(png.bytes, "nan"));
    free(png.bytes);
    froe_tree_free(polar);
}

static void titles_may_be_empty_long_or_in_any_script(void **state) {
    (void)state;
    static char long_title[100];
    memset(long_title, 'w', sizeof long_title - 1);
    for (int format = 0; format < 2; format++) {
        froe_tree *tree = tree_of(features(), "density", 1);
        froe_draw_options o = froe_draw_defaults(), empty = o;
        empty.title = "";
        assert_same_picture(picture_of(tree, (froe_draw_format)format, &o),
                            picture_of(tree, (froe_draw_format)format, &empty));
        froe_tree_free(tree);
    }
    static const char *const titles[] = {long_title, "\xE6\x9D\xB1\xE4\xBA\xAC", "Z\xC3\xBCrich"};
    for (size_t i = 0; i < 3; i++) {
        froe_tree *tree = tree_of(features(), "density", 1);
        froe_draw_options o = froe_draw_defaults();
        int ink = 0, beside = 0;
        o.title = titles[i], o.width = 400, o.legend = false;
        image_bytes png = picture_of(tree, FROE_DRAW_PNG, &o);
        cairo_surface_t *image = image_of(png);
        for (int y = 0; y < 30; y++)
            for (int x = 0; x < 400; x++) {
                const bool dark = lightness(pixel(image, x, y)) < 500;
                ink += dark, beside += dark && x >= 395;
            }
        if (ink < 5 || beside) fail_msg("title %zu: %d pixels, %d of them at the edge", i, ink, beside);
        cairo_surface_destroy(image);
        free(png.bytes);
        froe_tree_free(tree);
    }
}

/* Labels at every edge, where others are, and so many that not all can mind each other. */
static void labels_keep_to_the_page(void **state) {
    (void)state;
    static const double at[][2] = {{20.1, 30},   {39.9, 30},   {30, 20.1}, {30, 39.9},
                                   {20.1, 20.1}, {39.9, 39.9}, {30, 30}};
    enum { SITES = sizeof at / sizeof *at, MANY = 2100 };
    static froe_draw_mark marks[MANY];
    for (int i = 0; i < MANY; i++) {
        const double x = at[i % SITES][0], y = at[i % SITES][1];
        marks[i] =
            (froe_draw_mark){.lo = {x, y}, .hi = {x, y}, .kind = FROE_DRAW_MARK_LINE, .label = "A label\xE6\x9D\xB1"};
    }
    const int labelled = label_pixels(marks, SITES, 0, 800);
    assert_int_equal(label_pixels(marks, MANY, 0, 2) + label_pixels(marks, MANY, 798, 800), 0);
    for (int i = 0; i < SITES; i++) marks[i].label = "";
    const int dots = label_pixels(marks, SITES, 0, 800);
    if (labelled < dots + 100) fail_msg("%d pixels with labels, %d without", labelled, dots);
    for (int i = 0; i < SITES; i++) marks[i].label = NULL;
    assert_int_equal(label_pixels(marks, SITES, 0, 800), dots);
    for (int i = 0; i < SITES; i++) { /* beyond the window in every direction: nothing is seen */
        for (int k = 0; k < 2; k++) marks[i].hi[k] = marks[i].lo[k] = 30 + 40 * (at[i][k] > 30) - 40 * (at[i][k] < 30);
        marks[i].label = "gone";
    }
    assert_int_equal(label_pixels(marks, SITES - 1, 0, 800), 0);
    froe_draw_mark line = {.lo = {50, 50}, .hi = {60, 70}, .kind = FROE_DRAW_MARK_LINE, .label = "gone"};
    assert_int_equal(label_pixels(&line, 1, 0, 800), 0);
}

/* Only lines of one label, one after the other, share it; only equal boxes are one place. */
static void other_neighbours_have_labels_of_their_own(void **state) {
    (void)state;
    const froe_draw_mark marks[] = {
        {.lo = {22, 25}, .hi = {24, 25}, .kind = FROE_DRAW_MARK_LINE, .label = "Here"},
        {.lo = {27, 25}, .hi = {29, 25}, .kind = FROE_DRAW_MARK_LINE, .label = "There"},
        {.lo = {22, 35}, .hi = {24, 36}, .kind = FROE_DRAW_MARK_BOX, .label = "There"},
        {.lo = {27, 35}, .hi = {29, 36}, .kind = FROE_DRAW_MARK_BALL, .label = "There"},
        {.lo = {27, 35}, .hi = {29, 37}, .kind = FROE_DRAW_MARK_BALL, .label = "There"},
        {.lo = {27, 35, 0}, .hi = {29, 37, 1}, .kind = FROE_DRAW_MARK_BALL, .label = "There"},
        {.lo = {34, 25}, .hi = {36, 25}, .kind = FROE_DRAW_MARK_LINE, .label = "There"},
    };
    int before = 0;
    for (size_t count = 1; count <= sizeof marks / sizeof *marks; count++) {
        const int ink = label_pixels(marks, count, 0, 800);
        if (count != 6) assert_true(ink > before + 20);
        before = ink;
    }
}

static froe_status draw_map(void *user, const froe_allocator *alloc) {
    static const froe_draw_mark marks[] = {{.lo = {1, 1}, .hi = {1, 1}, .kind = FROE_DRAW_MARK_LINE, .label = "a"},
                                           {.lo = {1, 2}, .hi = {1, 2}, .kind = FROE_DRAW_MARK_LINE, .label = "b"}};
    froe_draw_options o = bare(200, 0, 0, 9, 9);
    o.marks = marks, o.mark_count = 2, o.locator = true, o.legend = true, o.alloc = alloc;
    return froe_draw(user, "map.svg", &o, NULL);
}

static void every_allocation_may_fail(void **state) {
    (void)state;
    froe_tree *tree = tree_of(features(), "density", 1);
    assert_true(test_memory_each(draw_map, tree) > 10);
    froe_tree_free(tree);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(closed_features_are_filled_with_their_holes_left_out_and_lines_are_not),
        cmocka_unit_test(no_line_is_drawn_that_is_no_object),
        cmocka_unit_test(degrees_of_longitude_are_shorter_away_from_the_equator),
        cmocka_unit_test(marks_and_accented_objects_are_seen),
        cmocka_unit_test(balls_on_maps_in_degrees_are_ellipses),
        cmocka_unit_test(a_border_of_many_marks_has_one_label),
        cmocka_unit_test(labels_at_the_right_edge_are_whole),
        cmocka_unit_test(marks_outside_of_the_window_are_counted),
        cmocka_unit_test(the_small_map_shows_where_a_window_is),
        cmocka_unit_test(what_is_beside_the_window_is_not_drawn),
        cmocka_unit_test(lengths_have_the_unit_of_the_scene),
        cmocka_unit_test(degrees_are_named_by_their_halves),
        cmocka_unit_test(titles_may_be_empty_long_or_in_any_script),
        cmocka_unit_test(labels_keep_to_the_page),
        cmocka_unit_test(other_neighbours_have_labels_of_their_own),
        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
