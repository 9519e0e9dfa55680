/* test_pages.c: PDF and EPS byte by byte: tables that point where they say, operators that paint what the paths are,
 * receivers that refuse, memory that runs out, locales with commas. */
#include "support/small_scenes.h"
#include "vector/pages.h"
#include <locale.h>
#include <math.h>
#include <stdio.h>

static froe_tree *triangles(void) {
    return tree_of(random_triangles(40, 0.6), "density", 1);
}

/* Lines of every kind, hidden ones too, a background, and points between whole steps. */
static froe_render_options rich_options(void) {
    froe_render_options o = froe_render_defaults();
    o.hidden = true;
    o.background = 0x336699;
    o.camera.width = 333.3;
    o.camera.height = 250.7;
    o.millimetres = true;
    return o;
}

/* ------------------------------------------------------------------------ structure -- */

static void every_object_of_a_pdf_is_where_its_table_says(void **state) {
    (void)state;
    froe_tree *tree = triangles();
    froe_render_options o = rich_options();
    o.title = "St\xC3\xA4lle (\xF0\x9F\x8F\xA0)\\";
    o.description = "(\xE2\x82\xAC";
    page_bytes p = page_of(tree, FROE_RENDER_PDF, &o, NULL);
    const char *start = strstr(p.text, "startxref\n");
    assert_memory_equal(p.text, "%PDF-1.4\n", 9);
    assert_non_null(start);
    const size_t table = strtoul(start + 10, NULL, 10);
    assert_true(table < p.count);
    char *at = p.text + table;
    assert_memory_equal(at, "xref\n0 ", 7);
    const unsigned long count = strtoul(at + 7, &at, 10);
    assert_int_equal(count, 7);
    assert_memory_equal(++at, "0000000000 65535 f \n", 20);
    for (unsigned long i = 1; i < count; i++) {
        char head[32], *end;
        const size_t place = strtoul(at + 20 * i, &end, 10);
        assert_memory_equal(end, " 00000 n \n", 10);
        const int length = snprintf(head, sizeof head, "%lu 0 obj\n", i);
        assert_true(place < p.count);
        assert_memory_equal(p.text + place, head, (size_t)length);
        assert_memory_equal(p.text + place - 1, "\n", 1);
    }
    assert_memory_equal(at + 20 * count, "trailer\n<</Size 7/Root 1 0 R/Info 6 0 R>>", 40);
    const char *end, *content = page_content(&p, &end);
    assert_int_equal(strtoul(strstr(p.text, "5 0 obj\n") + 8, NULL, 10), end - content);
    assert_non_null(strstr(p.text, "/MediaBox[0 0 944.7874016 710.6456693]"));
    assert_non_null(strstr(p.text, "/Title<FEFF0053007400E4006C006C006500200028D83CDFE00029005C>"));
    assert_non_null(strstr(p.text, "/Subject<FEFF002820AC>"));
    free(p.text);
    o.title = NULL, o.description = "";
    p = page_of(tree, FROE_RENDER_PDF, &o, NULL);
    assert_null(strstr(p.text, "/Title"));
    assert_null(strstr(p.text, "/Subject"));
    free(p.text);
    froe_tree_free(tree);
}

/* Viewers show no more than 14,400 units. */
static void a_large_page_has_large_units(void **state) {
    (void)state;
    froe_tree *tree = triangles();
    froe_render_options o = rich_options();
    o.millimetres = false;
    o.camera.width = 14400;
    page_bytes p = page_of(tree, FROE_RENDER_PDF, &o, NULL);
    assert_memory_equal(p.text, "%PDF-1.4\n", 9);
    assert_null(strstr(p.text, "/UserUnit"));
    free(p.text);
    o.camera.width = 32000;
    p = page_of(tree, FROE_RENDER_PDF, &o, NULL);
    assert_memory_equal(p.text, "%PDF-1.6\n", 9);
    assert_non_null(strstr(p.text, "/MediaBox[0 0 8000 "));
    assert_non_null(strstr(p.text, "/UserUnit 4\n"));
    assert_non_null(strstr(p.text, "stream\n0.25 0 0 0.25 0 0 cm\n"));
    free(p.text);
    froe_tree_free(tree);
}

static void an_eps_file_has_the_comments_that_programs_look_for(void **state) {
    (void)state;
    froe_tree *tree = triangles();
    const froe_render_options o = rich_options();
    page_bytes p = page_of(tree, FROE_RENDER_EPS, &o, NULL);
    assert_memory_equal(p.text, "%!PS-Adobe-3.0 EPSF-3.0\n", 24);
    assert_non_null(strstr(p.text, "\n%%LanguageLevel: 2\n"));
    assert_non_null(strstr(p.text, "\n%%BoundingBox: 0 0 945 711\n"));
    assert_non_null(strstr(p.text, "\n%%HiResBoundingBox: 0 0 944.7874016 710.6456693\n"));
    static const char tail[] = "restore\nshowpage\n%%Trailer\nend\n%%EOF\n";
    assert_string_equal(p.text + p.count - (sizeof tail - 1), tail);
    const char *end, *at = page_content(&p, &end);
    for (page_operator op; page_next(&at, end, &op);) {
        char defined[16];
        snprintf(defined, sizeof defined, "/%s{", op.name);
        if (!strstr(p.text, defined)) fail_msg("the prolog does not define '%s'", op.name);
    }
    free(p.text);
    froe_tree_free(tree);
}

/* -------------------------------------------------------------------------- painting -- */

static void assert_near(double x, double y, double apart) {
    if (!(fabs(x - y) <= apart)) fail_msg("%.17g is not within %g of %.17g", x, apart, y);
}

typedef struct replay {
    const char *at, *end;
    double alpha;
    size_t paths, points;
} replay;

static page_operator must_be(replay *r, const char *name, int count) {
    page_operator op;
    assert_true(page_next(&r->at, r->end, &op));
    assert_string_equal(op.name, name);
    assert_int_equal(op.count, count);
    return op;
}

static void must_be_colour(replay *r, const char *name, uint32_t colour) {
    const page_operator op = must_be(r, name, 3);
    for (int k = 0; k < 3; k++) assert_near(op.number[k] * 255, colour >> (16 - 8 * k) & 255, 0.02);
}

/* Follows an outline; points that are equal in 1/256 of a point may be left out. */
static void must_be_outline(replay *r, const froe_outline *o, double unit) {
    double last[2] = {0, 0};
    for (size_t i = 0; i < o->count; i++) {
        const double x = floor(o->points[2 * i] * 256 * unit + 0.5), y = floor(o->points[2 * i + 1] * 256 * unit + 0.5);
        if (i && x == last[0] && y == last[1]) continue;
        const page_operator op = must_be(r, i ? "l" : "m", 2);
        assert_true(op.number[0] == x && op.number[1] == y);
        last[0] = x, last[1] = y;
        r->points++;
    }
    if (o->closed) must_be(r, "h", 0);
}

/* A ring without area is left out. */
static bool has_area(const froe_outline *o, double unit) {
    double area = 0;
    for (size_t i = 0; i < o->count; i++) {
        const double *p = o->points + 2 * i, *q = o->points + 2 * ((i + 1) % o->count);
        const double k = 256 * unit;
        area += floor(p[0] * k + 0.5) * floor(q[1] * k + 0.5) - floor(p[1] * k + 0.5) * floor(q[0] * k + 0.5);
    }
    return area != 0;
}

static bool follow_path(void *user, const froe_render_path *path) {
    replay *r = user;
    const double unit = 72 / 25.4, grid = 256 * unit;
    if ((path->colour >> 24) != r->alpha) {
        const page_operator op = must_be(r, "gs", 1);
        assert_true(op.number[0] == path->colour >> 24);
        r->alpha = op.number[0];
    }
    if (!path->lines) must_be_colour(r, "rg", path->colour);
    if (path->width > 0) {
        must_be_colour(r, "RG", path->colour);
        assert_near(must_be(r, "w", 1).number[0], path->width * grid, 1e-3 * path->width * grid);
        const page_operator dashes = must_be(r, "d", path->hidden ? 3 : 1);
        if (path->hidden) assert_near(dashes.number[1], path->gap * grid, 1e-3 * path->gap * grid);
    }
    for (size_t i = 0; i < path->count; i++)
        if (path->lines || has_area(path->outlines + i, unit)) must_be_outline(r, path->outlines + i, unit);
    must_be(r, path->lines ? "S" : path->width > 0 ? "B" : "f", 0);
    r->paths++;
    return true;
}

/* The bytes of a page beside the paths that froe_render_paths() gives. */
static void follow(const froe_tree *tree, froe_render_format format, const froe_render_options *o) {
    froe_render_report written, given;
    page_bytes p = page_of(tree, format, o, &written);
    replay r = {.alpha = 255};
    r.at = page_content(&p, &r.end);
    must_be_colour(&r, "rg", o->background);
    must_be(&r, "re", 4);
    must_be(&r, "f", 0);
    const page_operator matrix = must_be(&r, "cm", 6);
    assert_true(matrix.number[0] == 0x1p-8 && matrix.number[3] == -0x1p-8);
    assert_near(matrix.number[5], o->camera.height * 72 / 25.4, 1e-6);
    must_be(&r, "j", 1);
    assert_int_equal(froe_render_paths(tree, 256 * 72 / 25.4, follow_path, &r, o, &given, NULL), FROE_OK);
    page_operator none;
    assert_false(page_next(&r.at, r.end, &none));
    assert_int_equal(r.paths, written.paths);
    assert_int_equal(given.paths, written.paths);
    assert_int_equal(given.shapes, written.shapes);
    assert_int_equal(given.bytes, 0);
    assert_int_equal(written.bytes, p.count);
    assert_true(r.points > 10);
    free(p.text);
}

static void pages_paint_the_paths_of_the_picture(void **state) {
    (void)state;
    froe_tree *tree = triangles();
    for (int f = FROE_RENDER_PDF; f <= FROE_RENDER_EPS; f++) {
        froe_render_options o = rich_options();
        follow(tree, (froe_render_format)f, &o);
        o.seams = FROE_SEAMS_TWICE;
        follow(tree, (froe_render_format)f, &o);
        o.seams = FROE_SEAMS_STROKE;
        o.interleaved = true;
        follow(tree, (froe_render_format)f, &o);
    }
    froe_tree_free(tree);
}

/* Two walls, one behind the other, of which the one in front is glass. */
static void opacity_is_a_state_that_the_page_defines(void **state) {
    (void)state;
    froe_scene *scene = scene_of(3);
    const froe_group glass = {.name = "glass", .material = "glass", .colour = 0x11223380},
                     stone = {.name = "stone", .material = "stone", .colour = 0x445566FF};
    for (int i = 0; i < 2; i++) {
        const double z = i, x[12] = {0, 0, z, 1, 0, z, 1, 1, z, 0, 1, z};
        const size_t starts[2] = {0, 4};
        froe_objects objects = froe_objects_defaults();
        assert_int_equal(froe_scene_add_group(scene, i ? &glass : &stone, &objects.group), FROE_OK);
        objects.count = 1, objects.coords = x, objects.starts = starts;
        assert_int_equal(froe_scene_add(scene, &objects, NULL), FROE_OK);
    }
    froe_tree *tree = tree_of(scene, "density", 1);
    froe_render_options o = rich_options();
    o.camera.eye[0] = 0.3, o.camera.eye[1] = 0.2, o.camera.eye[2] = 5;
    follow(tree, FROE_RENDER_PDF, &o);
    page_bytes p = page_of(tree, FROE_RENDER_PDF, &o, NULL);
    assert_non_null(strstr(p.text, "/a128<</ca 0.502/CA 0.502>>"));
    assert_non_null(strstr(p.text, "/a255<</ca 1/CA 1>>"));
    assert_null(strstr(p.text, "/a51<<"));
    free(p.text);
    froe_tree_free(tree);
}

typedef struct path_tally {
    uint64_t paths, rings, points; /* of faces */
} path_tally;

static bool tally_path(void *user, const froe_render_path *path) {
    path_tally *t = user;
    for (size_t i = 0; !path->lines && i < path->count; i++) t->rings++, t->points += path->outlines[i].count;
    t->paths += !path->lines;
    return true;
}

/* Also of shapes with holes, and once more of each where faces are painted twice. */
static void paths_hold_every_ring_of_every_shape(void **state) {
    (void)state;
    froe_tree *tree = tree_of(random_triangles(200, 0.6), "density", 1);
    bool holes = false;
    for (int paint = 0; paint <= FROE_PAINT_FRAGMENTS; paint++) {
        path_tally once = {0, 0, 0}, twice = once;
        froe_render_options o = froe_render_defaults();
        froe_render_report r;
        o.paint = (froe_paint)paint;
        o.seams = FROE_SEAMS_NONE;
        o.shading = FROE_SHADE_WHITE; /* so that a shape too thin to show shares the path of one that shows */
        o.lines = 0;
        assert_int_equal(froe_render_paths(tree, 1e6, tally_path, &once, &o, &r, NULL), FROE_OK);
        assert_int_equal(once.points, r.picture.points);
        holes = holes || once.rings > r.picture.shapes;
        o.seams = FROE_SEAMS_TWICE;
        assert_int_equal(froe_render_paths(tree, 1e6, tally_path, &twice, &o, NULL, NULL), FROE_OK);
        assert_int_equal(twice.paths, 2 * once.paths);
        assert_int_equal(twice.points, 2 * once.points);
    }
    assert_true(holes);
    froe_tree_free(tree);
}

/* Areas in squares of the finest steps of the largest page exceed 64 bits: UndefinedBehaviorSanitizer sees to that. */
static void the_largest_page_takes_the_finest_steps(void **state) {
    (void)state;
    froe_tree *tree = triangles();
    froe_render_options o = froe_render_defaults();
    froe_render_report r;
    o.camera.width = o.camera.height = 32000;
    o.decimals = 6;
    page_bytes p = page_of(tree, FROE_RENDER_SVG, &o, &r);
    assert_int_equal(r.thin_shapes, 0);
    assert_true(r.shapes > 10);
    free(p.text);
    froe_tree_free(tree);
}

/* ------------------------------------------------------------------------- receiving -- */

static bool stop_at_second(void *user, const void *bytes, size_t count) {
    (void)bytes, (void)count;
    return ++*(int *)user < 2;
}

static bool stop_at_third_path(void *user, const froe_render_path *path) {
    (void)path;
    return ++*(int *)user < 3;
}

static void bytes_come_as_they_stand_in_a_file(void **state) {
    (void)state;
    static const char *const names[] = {"bytes.svg", "bytes.pdf", "bytes.EPS", "bytes.csv", "bytes.geojson"};
    froe_tree *tree = tree_of(random_triangles(200, 0.6), "density", 1);
    froe_diagnostic why;
    for (int f = 0; f < FROE_RENDER_FORMAT_COUNT; f++) {
        int calls = 0;
        page_bytes p = page_of(tree, (froe_render_format)f, NULL, NULL), again = {calloc(1, 1 << 22), 0, 0};
        assert_int_equal(froe_render(tree, names[f], NULL, NULL, NULL), FROE_OK);
        FILE *file = fopen(names[f], "rb");
        again.count = fread(again.text, 1, 1 << 22, file);
        fclose(file);
        assert_int_equal(p.count, again.count);
        assert_memory_equal(p.text, again.text, p.count);
        assert_true(p.calls > 1);
        assert_int_equal(froe_render_write(tree, (froe_render_format)f, stop_at_second, &calls, NULL, NULL, &why),
                         FROE_E_IO);
        assert_int_equal(calls, 2);
        free(p.text), free(again.text);
    }
    int calls = 0;
    assert_int_equal(froe_render_paths(tree, 1, stop_at_third_path, &calls, NULL, NULL, &why), FROE_OK);
    assert_int_equal(calls, 3);
    froe_tree_free(tree);
}

static void what_cannot_be_written_is_refused(void **state) {
    (void)state;
    froe_tree *tree = triangles();
    froe_diagnostic why;
    froe_render_options o = froe_render_defaults();
    int calls = 0;
#define REFUSED(call, expected, says) (assert_int_equal(call, expected), assert_non_null(strstr(why.message, says)))
    o.title = "\xFF";
    REFUSED(froe_render(tree, "none.pdf", &o, NULL, &why), FROE_E_OPTIONS, "title");
    o.title = NULL, o.description = "\xC3(";
    REFUSED(froe_render(tree, "none.pdf", &o, NULL, &why), FROE_E_OPTIONS, "description");
    o = froe_render_defaults();
    REFUSED(froe_render_write(tree, FROE_RENDER_FORMAT_COUNT, keep_bytes, NULL, &o, NULL, &why), FROE_E_OPTIONS, "5");
    REFUSED(froe_render_write(tree, FROE_RENDER_SVG, NULL, NULL, &o, NULL, &why), FROE_E_ARG, "NULL");
    REFUSED(froe_render_paths(tree, 0, stop_at_third_path, &calls, &o, NULL, &why), FROE_E_OPTIONS, "steps");
    REFUSED(froe_render_paths(tree, NAN, stop_at_third_path, &calls, &o, NULL, &why), FROE_E_OPTIONS, "steps");
    REFUSED(froe_render_paths(tree, 1, NULL, &calls, &o, NULL, &why), FROE_E_ARG, "NULL");
    o.halo = -1;
    REFUSED(froe_render_paths(tree, 1, stop_at_third_path, &calls, &o, NULL, &why), FROE_E_OPTIONS, "halo");
#undef REFUSED
    assert_int_equal(calls, 0);
    assert_null(fopen("none.pdf", "rb"));
    froe_tree_free(tree);
}

static bool count_bytes(void *user, const void *bytes, size_t count) {
    (void)bytes;
    *(size_t *)user += count;
    return true;
}

static froe_status write_each(void *user, const froe_allocator *alloc) {
    froe_render_options o = rich_options();
    froe_status status = FROE_OK;
    size_t bytes = 0;
    o.alloc = alloc;
    o.layers = FROE_LAYERS_OBJECT;
    for (int f = 0; !status && f < FROE_RENDER_FORMAT_COUNT; f++)
        status = froe_render_write(user, (froe_render_format)f, count_bytes, &bytes, &o, NULL, NULL);
    return status;
}

static void every_allocation_may_fail(void **state) {
    (void)state;
    froe_tree *tree = tree_of(random_triangles(6, 0.6), "density", 1);
    assert_true(test_memory_each(write_each, tree) > 60);
    froe_tree_free(tree);
}

static void a_locale_with_commas_changes_no_byte(void **state) {
    (void)state;
    static const char *const locales[] = {"de_DE.UTF-8", "de_DE.utf8", "de_DE", "fr_FR.UTF-8"};
    froe_tree *tree = triangles();
    froe_render_options o = rich_options();
    page_bytes p[2][FROE_RENDER_FORMAT_COUNT];
    bool found = false;
    for (int i = 0; i < 2; i++) {
        for (size_t k = 0; i && !found && k < sizeof locales / sizeof *locales; k++)
            found = setlocale(LC_NUMERIC, locales[k]);
        for (int f = 0; f < FROE_RENDER_FORMAT_COUNT; f++) p[i][f] = page_of(tree, (froe_render_format)f, &o, NULL);
    }
    setlocale(LC_NUMERIC, "C");
    for (int f = 0; f < FROE_RENDER_FORMAT_COUNT; f++) {
        assert_int_equal(p[0][f].count, p[1][f].count);
        assert_memory_equal(p[0][f].text, p[1][f].text, p[0][f].count);
        free(p[0][f].text), free(p[1][f].text);
    }
    froe_tree_free(tree);
    if (!found) skip();
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_object_of_a_pdf_is_where_its_table_says),
        cmocka_unit_test(a_large_page_has_large_units),
        cmocka_unit_test(an_eps_file_has_the_comments_that_programs_look_for),
        cmocka_unit_test(pages_paint_the_paths_of_the_picture),
        cmocka_unit_test(opacity_is_a_state_that_the_page_defines),
        cmocka_unit_test(paths_hold_every_ring_of_every_shape),
        cmocka_unit_test(the_largest_page_takes_the_finest_steps),
        cmocka_unit_test(bytes_come_as_they_stand_in_a_file),
        cmocka_unit_test(what_cannot_be_written_is_refused),
        cmocka_unit_test(every_allocation_may_fail),
        cmocka_unit_test(a_locale_with_commas_changes_no_byte),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
