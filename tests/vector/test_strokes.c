/* test_strokes.c: width, colour and dashes of lines by kind: what a style does not say stays, the last one counts, and
 * every format shows it. */
#include "support/small_scenes.h"
#include "vector/render.h"
#include <froe/render.h>
#include <math.h>

/* A cube: silhouettes and creases, visible and hidden. */
static froe_tree *cube(void) {
    static const int face[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    double x[6 * 12];
    size_t starts[7] = {0};
    for (int f = 0; f < 6; f++) {
        starts[f + 1] = 4 * (size_t)f + 4;
        for (int i = 0; i < 12; i++) x[12 * f + i] = face[f][i / 3] >> i % 3 & 1;
    }
    froe_scene *scene = scene_of(3);
    froe_objects o = froe_objects_defaults();
    o.count = 6, o.coords = x, o.starts = starts;
    assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
    return tree_of(scene, "density", 1);
}

typedef struct found {
    froe_render_path silhouette, crease, hidden_silhouette, hidden_crease;
    size_t lines;
} found;

static bool note_path(void *user, const froe_render_path *path) {
    found *f = user;
    if (!path->lines) return true;
    f->lines++;
    if (path->kind == FROE_LINE_SILHOUETTE) *(path->hidden ? &f->hidden_silhouette : &f->silhouette) = *path;
    if (path->kind == FROE_LINE_CREASE) *(path->hidden ? &f->hidden_crease : &f->crease) = *path;
    return true;
}

static found paths_with(const froe_line_style *styles, size_t count) {
    froe_tree *tree = cube();
    froe_render_options o = froe_render_defaults();
    found f = {.lines = 0};
    o.hidden = true;
    o.line_styles = styles, o.line_style_count = count;
    assert_int_equal(froe_render_paths(tree, 100, note_path, &f, &o, NULL, NULL), FROE_OK);
    froe_tree_free(tree);
    return f;
}

static void without_a_style_widths_go_by_kind(void **state) {
    (void)state;
    const found f = paths_with(NULL, 0);
    assert_int_equal(f.lines, 3); /* a cube hides no silhouette */
    assert_true(f.silhouette.width == 1 && f.crease.width == 0.6 && f.hidden_crease.width == 0.6 * 0.6);
    assert_true(f.hidden_crease.dash == 4 * f.hidden_crease.width && f.hidden_crease.gap == 3 * f.hidden_crease.width);
    assert_true(f.silhouette.dash == 0 && f.silhouette.gap == 0);
    assert_int_equal(f.crease.colour, 0xFF1B2630);
}

static void a_style_changes_what_it_says_and_nothing_else(void **state) {
    (void)state;
    froe_line_style s[3];
    for (int i = 0; i < 3; i++) s[i] = froe_line_style_defaults();
    s[0].visible = FROE_LINE_SILHOUETTE, s[0].width = 2.5;
    s[1].hidden = UINT32_MAX, s[1].width = 0.4;
    s[2].visible = FROE_LINE_CREASE, s[2].colour = 0xFF0000, s[2].dash = 5, s[2].gap = 1;
    const found f = paths_with(s, 3);
    assert_true(f.silhouette.width == 2.5 && f.silhouette.dash == 0);
    assert_int_equal(f.silhouette.colour, 0xFF1B2630);
    assert_true(f.hidden_crease.width == 0.4 && f.hidden_crease.dash == 4 * 0.4); /* dashes go by the new width */
    assert_true(f.crease.width == 0.6 && f.crease.dash == 5 && f.crease.gap == 1);
    assert_int_equal(f.crease.colour, 0xFFFF0000);
    assert_int_equal(f.hidden_crease.colour, 0xFF1B2630);
}

static void the_last_style_of_a_kind_counts(void **state) {
    (void)state;
    froe_line_style s[2] = {froe_line_style_defaults(), froe_line_style_defaults()};
    s[0].visible = s[0].hidden = UINT32_MAX, s[0].width = 3, s[0].colour = 0;
    s[1].hidden = FROE_LINE_CREASE, s[1].width = 1, s[1].dash = s[1].gap = 0;
    const found f = paths_with(s, 2);
    assert_true(f.silhouette.width == 3 && f.crease.width == 3 && f.hidden_crease.width == 1);
    assert_true(f.hidden_crease.dash == 0); /* a hidden line may be solid */
    assert_int_equal(f.hidden_crease.colour, 0xFF000000);
}

static bool put_text(void *user, const void *bytes, size_t count) {
    char *text = user;
    const size_t used = strlen(text);
    memcpy(text + used, bytes, count);
    text[used + count] = '\0';
    return true;
}

static void svg_and_pdf_and_eps_show_styles(void **state) {
    (void)state;
    static const char *const expected[3][2] = {
        {"<path class=\"crease hidden\" stroke=\"#a0b0c0\" stroke-width=\"70\" stroke-dasharray=\"900 200\"",
         "#1b2630"},
        {"0.6275 0.6902 0.7529 RG\n179.2 w\n[2304 512] 0 d\n", "0.1059 0.149 0.1882 RG"},
        {"0.6275 0.6902 0.7529 RG\n179.2 w\n[2304 512] 0 d\n", "0.1059 0.149 0.1882 RG"}};
    froe_tree *tree = cube();
    froe_line_style s = froe_line_style_defaults();
    froe_render_options o = froe_render_defaults();
    s.hidden = FROE_LINE_CREASE, s.width = 0.7, s.colour = 0xA0B0C0, s.dash = 9, s.gap = 2;
    o.hidden = true;
    o.line_styles = &s, o.line_style_count = 1;
    for (int format = 0; format <= FROE_RENDER_EPS; format++) {
        char *text = calloc(1, 1 << 16);
        assert_int_equal(froe_render_write(tree, (froe_render_format)format, put_text, text, &o, NULL, NULL), FROE_OK);
        for (int i = 0; i < 2; i++)
            if (!strstr(text, expected[format][i])) fail_msg("'%s' is not in\n%s", expected[format][i], text);
        free(text);
    }
    froe_tree_free(tree);
}

/* Lines go under what is nearer than half their width, whichever style makes them wide. */
static void wide_styles_are_interleaved_as_wide_lines_are(void **state) {
    (void)state;
    froe_tree *tree = tree_of(random_triangles(12, 0.6), "density", 1);
    froe_line_style s = froe_line_style_defaults();
    froe_render_options o = froe_render_defaults();
    froe_render_report wide, styled;
    o.interleaved = true;
    o.line_width = 30;
    assert_int_equal(froe_render(tree, "wide.svg", &o, &wide, NULL), FROE_OK);
    s.visible = UINT32_MAX, s.width = 30;
    o.line_width = 1;
    o.line_styles = &s, o.line_style_count = 1;
    assert_int_equal(froe_render(tree, "styled.svg", &o, &styled, NULL), FROE_OK);
    assert_int_equal(wide.paths, styled.paths);
    o.line_style_count = 0;
    assert_int_equal(froe_render(tree, "narrow.svg", &o, &wide, NULL), FROE_OK);
    assert_true(wide.paths < styled.paths);
    froe_tree_free(tree);
}

/* Lines of a section count where there is one, and points never. */
static void reach_is_that_of_the_widest_line_drawn(void **state) {
    (void)state;
    froe_line_style wide = froe_line_style_defaults();
    froe_render_options o = froe_render_defaults();
    wide.visible = FROE_LINE_SECTION | FROE_LINE_POINT, wide.width = 9;
    const double usual = vector_line_reach(&o);
    o.line_styles = &wide, o.line_style_count = 1;
    assert_true(usual > 0 && usual < 4.5 && vector_line_reach(&o) == usual);
    o.section = 1;
    assert_true(vector_line_reach(&o) == 4.5);
    o.lines &= ~(uint32_t)FROE_LINE_SECTION;
    assert_true(vector_line_reach(&o) == usual);
}

static void bad_styles_are_refused(void **state) {
    (void)state;
    froe_tree *tree = cube();
    froe_line_style s[7];
    for (int i = 0; i < 7; i++) s[i] = froe_line_style_defaults();
    s[0].width = 0;
    s[1].width = INFINITY;
    s[2].colour = 0x1000000;
    s[3].dash = 1;
    s[4].dash = 1, s[4].gap = 0;
    s[5].dash = s[5].gap = -1;
    s[6].dash = 1, s[6].gap = -1;
    froe_render_options o = froe_render_defaults();
    for (int i = 0; i < 7; i++) {
        froe_diagnostic why = {.message = ""};
        o.line_styles = s + i, o.line_style_count = 1;
        assert_int_equal(froe_render(tree, "bad.svg", &o, NULL, &why), FROE_E_OPTIONS);
        assert_memory_equal(why.message, "line style 0: ", 14);
    }
    o.line_styles = NULL;
    assert_int_equal(froe_render(tree, "bad.svg", &o, NULL, NULL), FROE_E_ARG);
    froe_tree_free(tree);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(without_a_style_widths_go_by_kind),
        cmocka_unit_test(a_style_changes_what_it_says_and_nothing_else),
        cmocka_unit_test(the_last_style_of_a_kind_counts),
        cmocka_unit_test(svg_and_pdf_and_eps_show_styles),
        cmocka_unit_test(wide_styles_are_interleaved_as_wide_lines_are),
        cmocka_unit_test(reach_is_that_of_the_widest_line_drawn),
        cmocka_unit_test(bad_styles_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
