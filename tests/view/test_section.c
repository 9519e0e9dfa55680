/* test_section.c: pictures of what a plane has left, against exact rays; and where such trees come from. */
#include "pages.h"
#include "support/memory.h"

static froe_tree *section_of(const froe_tree *tree, const double *plane) {
    froe_diagnostic why = {.message = ""};
    froe_tree *out;
    if (froe_tree_section(tree, plane, NULL, &out, &why)) fail_msg("%s", why.message);
    if (froe_tree_audit(out, NULL, &why)) fail_msg("%s", why.message);
    return out;
}

static double plane_at(const double *plane, const double *x) {
    return plane[0] * x[0] + plane[1] * x[1] + plane[2] * x[2] - plane[3];
}

/* Random planes, and such as hold vertices or polygons: the first three corners of an object are small whole numbers on
 * the lattice, and so is their plane. */
static void plane_of(const froe_scene *s, uint32_t i, double plane[4]) {
    const double *a = scene_point(s, i, 0), *b = scene_point(s, i, 1), *c = scene_point(s, i, 2);
    plane[3] = 0;
    for (int k = 0; k < 3; k++) {
        const int m = (k + 1) % 3, n = (k + 2) % 3;
        plane[k] = i % 3 == 0   ? (b[m] - a[m]) * (c[n] - a[n]) - (b[n] - a[n]) * (c[m] - a[m])
                   : i % 3 == 1 ? k == (int)(i % 2)
                                : trees_unit(7, 3 * i + (uint32_t)k) - 0.5;
        plane[3] += plane[k] * (i % 3 == 2 ? 0.5 * (s->lo[k] + s->hi[k]) : a[k]);
    }
}

static void check(froe_tree *tree, const char *method, froe_paint paint, bool through) {
    uint64_t shown = 0, clipped = 0;
    froe_tree *other = trees_build(tree->scene, method, 1);
    froe_tree_free(tree);
    for (uint32_t i = 0; i < 6; i++) {
        double plane[4];
        page p;
        plane_of(other->scene, i, plane);
        tree = section_of(other, plane);
        open_page(&p, tree);
        uint8_t *clear = calloc(p.surface->patch_count + 1, 1);
        for (uint32_t k = 0; k < p.surface->patch_count; k++) clear[k] = through && trees_random(11, k, 2);
        p.section = plane;
        p.options.section = -1;
        p.options.paint = paint;
        p.options.underlap = 2;
        p.options.lines = 255;
        p.options.hidden = true;
        if (through) p.options.clear = clear;
        set_view(&p, 3 * i + 1);
        check_view(&p, 60, i);
        const froe_picture_report r = froe_picture_statistics(p.picture);
        shown += p.shown, clipped += r.shapes - r.whole - r.late;
        froe_picture_free(p.picture);
        free(clear);
        close_page(&p);
        froe_tree_free(tree);
    }
    assert_true(shown > 20);
    assert_true(clipped > 0);
    froe_tree_free(other);
}

static void what_is_left_is_seen(void **state) {
    (void)state;
    check(trees_grow(3, FROE_POLYGON, 40, 0, 1, "density", 1), "grain", FROE_PAINT_WHOLE, false);
    check(trees_grow(3, FROE_POLYGON, 40, 3, 2, "density", 1), "density", FROE_PAINT_WHOLE, false);
    check(trees_grow(3, FROE_POLYGON, 40, 0, 3, "density", 1), "autopartition", FROE_PAINT_REGIONS, false);
    check(trees_grow(3, FROE_POLYGON, 35, 3, 4, "density", 1), "grain", FROE_PAINT_FRAGMENTS, false);
}

static void one_sees_through_what_is_left(void **state) {
    (void)state;
    check(trees_grow(3, FROE_POLYGON, 40, 0, 5, "density", 1), "grain", FROE_PAINT_WHOLE, true);
}

/* A box of six squares. */
static froe_tree *box(void) {
    static const int face[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    double x[72];
    const size_t starts[7] = {0, 4, 8, 12, 16, 20, 24};
    froe_scene *scene;
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    for (int i = 0; i < 72; i++) x[i] = (face[i / 12][i / 3 % 4] >> i % 3 & 1) * (i % 3 == 2 ? 30 : 10);
    froe_objects o = froe_objects_defaults();
    o.count = 6, o.coords = x, o.starts = starts;
    assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
    froe_tree *tree = trees_build(scene, "grain", 1);
    froe_scene_free(scene);
    return tree;
}

/* From above, one looks into it: its walls are lines, seen edge-on, and drawn for the section alone. From beside, the
 * section is one line, and hidden lines end there. */
static void sections_are_lines(void **state) {
    (void)state;
    const double plane[4] = {0, 0, 2, 24};
    froe_tree *whole = box(), *tree = section_of(whole, plane);
    froe_tree_free(whole);
    for (int beside = 0; beside < 2; beside++) {
        double length[2] = {0, 0}, hidden = 0;
        page p;
        open_page(&p, tree);
        p.section = plane;
        p.options.section = -1;
        p.options.lines = FROE_LINE_SECTION | FROE_LINE_BORDER | FROE_LINE_SILHOUETTE | FROE_LINE_CREASE;
        p.options.hidden = true;
        look_from(&p, 0, beside ? -1 : 0, beside ? 0 : 1, 10);
        check_view(&p, 20, 1);
        for (size_t i = 0; i < froe_picture_stroke_count(p.picture); i++) {
            const froe_stroke s = froe_picture_stroke(p.picture, i);
            for (size_t k = 0; s.kind == FROE_LINE_SECTION && k < s.count; k++)
                assert_true(fabs(s.space[3 * k + 2] - 12) < 1e-9);
            if (s.hidden)
                hidden += length_of(&s);
            else
                length[s.kind == FROE_LINE_SECTION] += length_of(&s);
        }
        assert_true(fabs(length[1] - (beside ? 100 : 400)) < 1e-6);
        if (beside) assert_true(fabs(length[0] - (2 * 120 + 100)) < 1e-6 && hidden < 2 * 120 + 100 + 1e-6);
        froe_picture_free(p.picture);
        close_page(&p);
    }
    froe_tree_free(tree);
}

/* Two walls are seen edge-on and cut from corner to corner, and two are only touched. Nearer, both are beside
 * the page. */
static void sections_from_corner_to_corner_are_lines(void **state) {
    (void)state;
    const double plane[4] = {0, -3, 1, 0};
    froe_tree *whole = box(), *tree = section_of(whole, plane);
    for (int near = 0; near < 2; near++) {
        double length = 0;
        page p;
        open_page(&p, tree);
        p.section = plane;
        p.options.section = -1;
        p.options.lines = FROE_LINE_SECTION;
        p.options.hidden = near;
        look_from(&p, 0, 0, 1, near ? 200 : 10);
        check_view(&p, 20, 1);
        for (size_t i = 0; i < froe_picture_stroke_count(p.picture); i++) {
            const froe_stroke s = froe_picture_stroke(p.picture, i);
            length += length_of(&s);
        }
        assert_true(fabs(length - (near ? 0 : 200)) < 1e-6);
        froe_picture_free(p.picture);
        close_page(&p);
    }
    froe_tree_free(tree);
    froe_tree_free(whole);
}

/* An upright sheet, of which a side has corners along it, seen as a line from above. Where the section only touches it,
 * along that side or at a corner, there is nothing; where it goes through corners, its line ends at them. */
static void a_section_that_touches_a_sheet_makes_no_line(void **state) {
    static const double sheet[] = {0, 0, 0, 4, 0, 0, 6, 0, 2, 4, 0, 4, 3, 0, 4, 2, 0, 4, 1, 0, 4, 0, 0, 4};
    static const size_t starts[] = {0, 8};
    static const struct {
        double plane[4], from, to; /* x of the ends of the line; nowhere: none */
    } cases[] = {
        {{0, 0, 1, 4}, 0, 0},  {{0, 0, 1, 2}, 0, 6},   {{0, 0, 1, 1}, 0, 5},   {{0, 1, 1, 3}, 0, 5},
        {{1, 0, 1, 8}, 0, 0},  {{1, 0, 0.5, 7}, 0, 0}, {{-1, 0, 1, 4}, 0, 0},  {{-1, 0, 1, 2}, 0, 2},
        {{-1, 0, 1, 0}, 0, 4}, {{1, 1, 1, 6}, 2, 5},   {{-4, 0, 1, -8}, 2, 3}, {{-4, 0, 1, 0}, 0, 1},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        froe_tree *whole = trees_of_polygons(sheet, starts, 1, "density"), *tree = section_of(whole, cases[i].plane);
        froe_visibility_options look = froe_visibility_defaults();
        froe_surface *surface;
        froe_visibility *v;
        size_t count;
        assert_int_equal(froe_surface_new(tree->scene, NULL, &surface, NULL), FROE_OK);
        look.eye = (froe_eye){.at = {0, 0, 1}, .parallel = true};
        look.crossings = true;
        look.section = -1;
        assert_int_equal(froe_visibility_new(tree, surface, &look, &v, NULL), FROE_OK);
        const froe_crossing *c = froe_visibility_crossings(v, &count);
        assert_int_equal(count, cases[i].from < cases[i].to);
        if (count) {
            assert_true(c->section && fabs(fmin(c->from[0], c->to[0]) - cases[i].from) < 1e-12 &&
                        fabs(fmax(c->from[0], c->to[0]) - cases[i].to) < 1e-12);
            assert_true(fabs(plane_at(cases[i].plane, c->from)) < 1e-12 &&
                        fabs(plane_at(cases[i].plane, c->to)) < 1e-12);
        }
        froe_visibility_free(v);
        froe_surface_free(surface);
        froe_tree_free(tree);
        froe_tree_free(whole);
    }
}

/* The direction of the eye is rounded, so that the eye is not in the plane of the sheet, but all but. */
static void a_sheet_seen_all_but_edge_on_is_cut_where_the_section_is(void **state) {
    (void)state;
    const double sheet[] = {1, 3, -1, -1, 4, -2, -2, 2, -2, 0, 1, -1}, plane[4] = {0, 1, 0, 3};
    const size_t starts[] = {0, 4};
    froe_tree *whole = trees_of_polygons(sheet, starts, 1, "density"), *tree = section_of(whole, plane);
    froe_visibility_options look = froe_visibility_defaults();
    froe_surface *surface;
    assert_int_equal(froe_surface_new(tree->scene, NULL, &surface, NULL), FROE_OK);
    for (int exact = 0; exact < 2; exact++) {
        froe_visibility *v;
        size_t count;
        const froe_eye all_but = {.at = {0x1.a20bd700c2c3fp-1, -0x1.a20bd700c2c4p-2, 0x1.a20bd700c2c4p-2}};
        look.eye = exact ? (froe_eye){.at = {2, -1, 1}} : all_but;
        look.eye.parallel = look.crossings = true;
        look.section = 1;
        assert_int_equal(froe_visibility_new(tree, surface, &look, &v, NULL), FROE_OK);
        const froe_crossing *c = froe_visibility_crossings(v, &count);
        assert_int_equal(count, 1);
        assert_true(fabs(c->from[1] - 3) < 1e-9 && fabs(c->to[1] - 3) < 1e-9);
        for (size_t i = 0; i < froe_visibility_piece_count(v); i++) {
            double x[12];
            const size_t corners = froe_visibility_corners(v, i, x, 4);
            for (size_t k = 0; k < 3 * corners; k++) assert_true(fabs(x[k]) < 1e3);
        }
        froe_visibility_free(v);
    }
    froe_surface_free(surface);
    froe_tree_free(tree);
    froe_tree_free(whole);
}

static void a_section_outlives_the_file_it_comes_from(void **state) {
    (void)state;
    const double plane[4] = {1, 1, 0, 7};
    froe_tree *tree = box(), *opened, *section;
    assert_int_equal(froe_tree_save(tree, "section.froe", NULL), FROE_OK);
    froe_tree_free(tree);
    assert_int_equal(froe_tree_open("section.froe", NULL, &opened, NULL), FROE_OK);
    section = section_of(opened, plane);
    froe_tree_free(opened);
    assert_int_equal(froe_tree_audit(section, NULL, NULL), FROE_OK);
    const froe_cut cut = froe_tree_node(section, froe_tree_root(section)).cut;
    assert_int_equal(cut.kind, FROE_CUT_PLANE);
    assert_true(cut.value == 7 && cut.normal[0] == 1 && cut.normal[1] == 1 && cut.normal[2] == 0);
    assert_int_equal(froe_tree_save(section, "section.froe", NULL), FROE_OK);
    froe_tree_free(section);
    assert_int_equal(froe_tree_open("section.froe", NULL, &opened, NULL), FROE_OK);
    froe_tree_free(opened);
}

/* ---------------------------------------------------------- degenerate scenes -- */

/* `count` objects of one kind: at one place, in one line, or anywhere of a plane that the first section is. */
static froe_scene *degenerate(int dim, froe_kind kind, uint32_t count, int how) {
    froe_scene *scene;
    assert_int_equal(froe_scene_new(dim, NULL, &scene), FROE_OK);
    for (uint32_t i = 0; i < count; i++) {
        double x[9] = {0};
        for (int k = 0; k < 3 * dim; k++) {
            const int corner = k / dim, axis = k % dim;
            const double along = how > 1 ? i : 0, beside = corner * (how > 0) + (axis == 0) * (corner == 2);
            x[k] = axis == dim - 1 && how == 3 ? 0 : -8 + along + beside;
        }
        assert_int_equal(trees_add(scene, kind, 1, x, NULL, NULL), FROE_OK);
    }
    return scene;
}

static void check_sections(froe_scene *scene, const char *method, uint32_t leaf) {
    static const double planes[][4] = {{-8, -8, -8, -8}, {0, 1, 0, 0},  {0, 0, 1, 0},  {1, -1, 0, 0},
                                       {1, 1, 1, 0},     {1, 0, 0, -8}, {1, 0, 0, 1e9}};
    froe_build_options o = froe_build_defaults();
    froe_tree *tree;
    o.method = method;
    o.leaf = leaf;
    if (froe_build(scene, &o, &tree, NULL)) return; /* of kinds that the method does not serve, or not with this leaf */
    for (size_t i = 0; i < sizeof planes / sizeof *planes; i++) {
        double plane[4];
        memcpy(plane, planes[i], sizeof plane);
        if (scene->dim == 2) plane[2] = plane[3];
        if (scene->dim == 3 || plane[0] != 0 || plane[1] != 0) froe_tree_free(section_of(tree, plane));
    }
    froe_tree_free(tree);
}

/* The first cut adds a level that no object answers for. */
static void sections_of_degenerate_scenes_keep_their_promises(void **state) {
    static const char *const methods[] = {"grain", "density", "autopartition"};
    static const uint32_t counts[] = {0, 1, 2, 3, 7};
    (void)state;
    for (int dim = 2; dim <= 3; dim++)
        for (int kind = FROE_POINT; kind <= FROE_POLYGON; kind++)
            for (int how = 0; how <= 3; how++)
                for (size_t n = 0; n < 5 * 9; n++) {
                    if (kind == FROE_POLYGON && (dim == 2 || how == 0)) continue; /* without an area they are refused */
                    froe_scene *scene = degenerate(dim, (froe_kind)kind, counts[n / 9], how);
                    check_sections(scene, methods[n % 3], (uint32_t)(n / 3 % 3));
                    froe_scene_free(scene);
                }
}

static void refuse(const froe_tree *tree, const double *plane, froe_status expected, const char *sentence) {
    froe_diagnostic why = {.message = ""};
    froe_tree *out = NULL;
    assert_int_equal(froe_tree_section(tree, plane, NULL, &out, &why), expected);
    assert_null(out);
    assert_non_null(strstr(why.message, sentence));
}

static void bad_sections_are_refused(void **state) {
    (void)state;
    const double bad[3][4] = {{0, 0, 0, 1}, {1, NAN, 0, 1}, {1, 0, 0, INFINITY}}, good[4] = {1, 0, 0, 5};
    froe_tree *tree = box(), *other = trees_build(tree->scene, "index", 8);
    refuse(tree, bad[0], FROE_E_ARG, "length 0");
    refuse(tree, bad[1], FROE_E_ARG, "Number 1");
    refuse(tree, bad[2], FROE_E_ARG, "Number 3");
    refuse(tree, NULL, FROE_E_ARG, "NULL");
    refuse(other, good, FROE_E_UNSUPPORTED, "'index' takes no first cut");
    froe_visibility_options o = froe_visibility_defaults();
    froe_visibility *v;
    froe_surface *surface;
    assert_int_equal(froe_surface_new(tree->scene, NULL, &surface, NULL), FROE_OK);
    o.section = 2;
    assert_int_equal(froe_visibility_new(tree, surface, &o, &v, NULL), FROE_E_OPTIONS);
    froe_surface_free(surface);
    froe_tree_free(tree);
    froe_tree_free(other);
}

static void every_allocation_may_fail(void **state) {
    (void)state;
    const double plane[4] = {0, 0, 2, 24};
    froe_tree *whole = box(), *tree = section_of(whole, plane);
    page p;
    open_page(&p, tree);
    p.options.section = -1;
    p.options.lines = 255;
    p.options.hidden = true;
    look_from(&p, 0, 0, 1, 0);
    assert_true(test_memory_each(make_picture, &p) > 20);
    close_page(&p);
    froe_tree_free(tree);
    froe_tree_free(whole);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_left_is_seen),
        cmocka_unit_test(one_sees_through_what_is_left),
        cmocka_unit_test(sections_are_lines),
        cmocka_unit_test(sections_from_corner_to_corner_are_lines),
        cmocka_unit_test(a_sheet_seen_all_but_edge_on_is_cut_where_the_section_is),
        cmocka_unit_test(a_section_that_touches_a_sheet_makes_no_line),
        cmocka_unit_test(a_section_outlives_the_file_it_comes_from),
        cmocka_unit_test(sections_of_degenerate_scenes_keep_their_promises),
        cmocka_unit_test(bad_sections_are_refused),
        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
