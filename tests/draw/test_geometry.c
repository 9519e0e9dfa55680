/* test_geometry.c: what is behind the pictures: cells that fill the page, cuts on the right side,
 * shapes of sections, and the painter's order against a ray caster. */
#include "exploded/solid.h"
#include "lettering.h"
#include "partition.h"
#include "pictures.h"
#include "shape.h"
#include "support/axes.h"
#include <math.h>

static draw_view view_of(const froe_tree *tree, int axis, double at, int up) {
    double lo[3] = {0}, hi[3] = {0};
    const froe_scene *scene = froe_tree_scene(tree);
    assert_true(froe_scene_bounds(scene, lo, hi));
    draw_view view = {.space = draw_space_over(froe_scene_dim(scene), up, lo, hi), .axis = axis, .at = at};
    view.across = axis == 0 ? 1 : 0;
    view.up = axis == 2 || axis < 0 ? 1 : 2;
    view.lo = (draw_point){-1.1, -1.1};
    view.hi = (draw_point){1.1, 1.1};
    draw_view_place(&view, 0, 0, 220, 220);
    return view;
}

static double area_of(const draw_point *p, size_t count) {
    double sum = 0;
    for (size_t i = 0; i < count; i++) {
        draw_point q = p[(i + 1) % count];
        sum += p[i].x * q.y - q.x * p[i].y;
    }
    return fabs(0.5 * sum);
}

static void assert_cells_fill(const froe_tree *tree, const draw_view *view, uint32_t max_depth) {
    draw_task task = {.total = 1};
    draw_partition part = {.alloc = support_allocator(NULL)};
    assert_int_equal(draw_partition_add(&part, tree, view, max_depth, &task), FROE_OK);
    assert_true(draw_partition_scale(&part));
    double area = 0;
    for (size_t i = 0; i < part.cells.count; i++) {
        const draw_cell *cell = part.cells.data + i;
        assert_true(cell->count >= 3);
        area += area_of(part.points.data + cell->first, cell->count);
    }
    assert_true(fabs(area - 220.0 * 220) < 1e-6);
    assert_true(part.lo_depth <= part.hi_depth);
    if (!max_depth && view->axis < 0) assert_int_equal(part.cells.count, froe_tree_report(tree).leaves);
    draw_partition_free(&part);
}

static void the_cells_of_a_view_fill_its_window(void **state) {
    (void)state;
    static const char *const methods[] = {"autopartition", "density"};
    for (int m = 0; m < 2; m++) {
        froe_tree *flat = tree_of(random_segments(200, 0.5, 1, 0), methods[m], 1);
        draw_view view = view_of(flat, -1, 0, 2);
        assert_cells_fill(flat, &view, 3);
        view.detail = 5;
        assert_cells_fill(flat, &view, 3);
        froe_tree_free(flat);
        froe_tree *solid = tree_of(random_triangles(60, 0.5), methods[m], 1);
        for (int up = 0; up < 3; up++)
            for (int axis = 0; axis < 3; axis++)
                for (int k = -2; k <= 2; k++) {
                    view = view_of(solid, axis, 0.4 * k, up);
                    assert_cells_fill(solid, &view, (uint32_t)(k + 2));
                }
        froe_tree_free(solid);
    }
}

/* Every child on its side of every cut: the corners of a node's pieces lie in its region. */
static void planes_in_drawing_coordinates_keep_their_sides(void **state) {
    (void)state;
    froe_tree *tree = tree_of(random_triangles(80, 0.6), "autopartition", 0);
    const froe_scene *scene = froe_tree_scene(tree);
    size_t nodes = froe_tree_report(tree).nodes, tested = 0;
    for (int up = 0; up < 3; up++) {
        draw_view view = view_of(tree, -1, 0, up);
        draw_shaper shaper = {.alloc = support_allocator(NULL), .tree = tree, .scene = scene, .view = &view};
        for (uint32_t id = 1; id <= nodes; id++) {
            froe_node_info info = froe_tree_node(tree, (froe_node){id});
            if (info.cut.kind == FROE_CUT_NONE) continue;
            draw_plane plane = draw_space_plane(&view.space, scene, &info.cut);
            for (int side = 0; side < 2; side++) {
                froe_node_info child = froe_tree_node(tree, info.child[side]);
                for (size_t i = 0; i < child.piece_count; i++) {
                    assert_true(draw_corners_of_piece(&shaper, child.first_piece + i));
                    for (size_t k = 0; k + 2 < shaper.solid.count; k += 3) {
                        double d = support_dot(plane.n, shaper.solid.data + k) - plane.c;
                        assert_true(side ? d > -1e-9 : d < 1e-9);
                        tested++;
                    }
                }
            }
        }
        draw_shaper_free(&shaper);
    }
    assert_true(tested > 500);
    froe_tree_free(tree);
}

static void plane_equations_of_every_kind_of_cut_agree(void **state) {
    (void)state;
    froe_scene *scene = scene_of(3);
    const double triangle[] = {0, 0, 0, 4, 0, 0, 0, 4, 4}, far[] = {-8, -8, -8};
    const double normal[] = {0, -2, 2}, x_normal[] = {4, 4, 0};
    add(scene, FROE_POLYGON, 1, triangle, NULL, NULL);
    add(scene, FROE_POINT, 1, far, NULL, NULL);
    froe_tree *tree = tree_of(scene, "density", 1);
    const froe_scene *s = froe_tree_scene(tree);
    uint32_t v[3];
    for (uint32_t i = 0; i < 3; i++) v[i] = froe_scene_corner(s, 0, i);
    const froe_cut slope[] = {{.kind = FROE_CUT_OBJECT, .id = {0}},
                              {.kind = FROE_CUT_VERTICES, .id = {v[0], v[1], v[2]}},
                              {.kind = FROE_CUT_PLANE, .normal = normal, .value = 0}};
    const froe_cut upright[] = {{.kind = FROE_CUT_EDGE, .id = {v[2], v[1]}},
                                {.kind = FROE_CUT_PLANE, .normal = x_normal, .value = 16}};
    for (int up = 0; up < 3; up++) {
        draw_view view = view_of(tree, -1, 0, up);
        draw_plane first = draw_space_plane(&view.space, s, slope);
        for (int i = 1; i < 3; i++) {
            draw_plane p = draw_space_plane(&view.space, s, slope + i);
            for (int k = 0; k < 3; k++) assert_true(fabs(p.n[k] - first.n[k]) < 1e-12);
            assert_true(fabs(p.c - first.c) < 1e-12);
        }
        draw_plane a = draw_space_plane(&view.space, s, upright), b = draw_space_plane(&view.space, s, upright + 1);
        for (int k = 0; k < 3; k++) assert_true(fabs(a.n[k] - b.n[k]) < 1e-12);
        assert_true(fabs(a.c - b.c) < 1e-12);
        for (int axis = 0; axis < 3; axis++) {
            const froe_cut cut = {.kind = FROE_CUT_AXIS, .axis = axis, .value = 1};
            draw_plane p = draw_space_plane(&view.space, s, &cut);
            double x[3] = {1, 1, 1}, y[3] = {1, 1, 1}, u[3];
            draw_space_point(&view.space, x, u);
            assert_true(support_dot(p.n, u) == p.c);
            y[axis] = 2;
            draw_space_point(&view.space, y, u);
            assert_true(support_dot(p.n, u) > p.c);
        }
    }
    froe_tree_free(tree);
}

static void sections_of_solids_have_the_right_shape(void **state) {
    (void)state;
    froe_scene *scene = scene_of(3);
    const double box[] = {0, 0, 0, 4, 2, 2}, ball[] = {2, 1, 1}, quad[] = {0, 0, 1, 4, 0, 1, 4, 2, 1, 0, 2, 1};
    const double hull[] = {0, 0, 0, 4, 0, 0, 0, 2, 0, 0, 0, 2}, needle[] = {1, 1, 0, 3, 1, 2},
                 corner[] = {1, 1, 1, 2, 1, 2, 1, 2, 2};
    const size_t four[] = {0, 4};
    const double radius = 1;
    add(scene, FROE_BOX, 1, box, NULL, NULL);
    add(scene, FROE_BALL, 1, ball, &radius, NULL);
    add(scene, FROE_POLYGON, 1, quad, NULL, four);
    add(scene, FROE_HULL, 1, hull, NULL, four);
    add(scene, FROE_SEGMENT, 1, needle, NULL, NULL);
    add(scene, FROE_POLYGON, 1, corner, NULL, NULL);
    froe_tree *tree = tree_of(scene, "density", 1);
    const struct {
        double z; /* in the scene */
        draw_sort sort[6];
    } cases[] = {{1, {DRAW_RING, DRAW_DISC, DRAW_RING, DRAW_RING, DRAW_DOT, DRAW_NOTHING}},
                 {1.5, {DRAW_RING, DRAW_DISC, DRAW_NOTHING, DRAW_RING, DRAW_DOT, DRAW_STROKE}},
                 {2, {DRAW_RING, DRAW_DOT, DRAW_NOTHING, DRAW_DOT, DRAW_DOT, DRAW_STROKE}},
                 {2.5, {DRAW_NOTHING, DRAW_NOTHING, DRAW_NOTHING, DRAW_NOTHING, DRAW_NOTHING, DRAW_NOTHING}}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        draw_view view = view_of(tree, 2, 0, 2);
        view.at = draw_space_map(&view.space, 2, cases[i].z);
        draw_shaper shaper = {
            .alloc = support_allocator(NULL), .tree = tree, .scene = froe_tree_scene(tree), .view = &view};
        for (uint32_t object = 0; object < 6; object++) {
            draw_shape shape;
            assert_true(draw_shape_of_object(&shaper, object, &shape));
            assert_int_equal(shape.sort, cases[i].sort[object]);
            /* The box spans 4 of 4.4 drawing units ... across 200 of 220 on the page. */
            if (shape.sort == DRAW_RING && object == 0) assert_true(fabs(area_of(shape.points, 4) - 200 * 100) < 1e-6);
            if (shape.sort == DRAW_DISC)
                assert_true(fabs(shape.half.y - 50 * sqrt(1 - (cases[i].z - 1) * (cases[i].z - 1))) < 1e-9);
        }
        draw_shaper_free(&shaper);
    }
    froe_tree_free(tree);
}

/* ------------------------------------------------------- painter's order -- */

static bool inside(const draw_point *p, size_t count, draw_point at) {
    int left = 0, right = 0;
    for (size_t i = 0; i < count; i++) {
        draw_point q = p[(i + 1) % count];
        double side = (q.x - p[i].x) * (at.y - p[i].y) - (q.y - p[i].y) * (at.x - p[i].x);
        left += side > 1e-9;
        right += side < -1e-9;
    }
    return (left == 0) != (right == 0); /* corners of a piece may coincide once rounded */
}

/* Shade of the triangle that a ray from the eye meets first, by looking at all; -1: none. */
static double first_hit(const froe_scene *scene, const draw_space *space, const draw_camera *camera, draw_point at) {
    double nearest = -HUGE_VAL, shade = -1;
    for (uint32_t t = 0; t < froe_scene_object_count(scene); t++) {
        double p[3][3], n[3];
        draw_point q[3];
        for (uint32_t i = 0; i < 3; i++) {
            draw_space_point(space, froe_scene_vertex(scene, froe_scene_corner(scene, t, i)), p[i]);
            q[i] = draw_camera_project(camera, p[i]);
        }
        if (!inside(q, 3, at)) continue;
        for (int k = 0; k < 3; k++) {
            int a = (k + 1) % 3, b = (k + 2) % 3;
            n[k] = (p[1][a] - p[0][a]) * (p[2][b] - p[0][b]) - (p[1][b] - p[0][b]) * (p[2][a] - p[0][a]);
        }
        /* at.x right + at.y up + d eye lies in the triangle's plane. */
        double d = support_dot(n, p[0]) - at.x * support_dot(n, camera->right) - at.y * support_dot(n, camera->up);
        d /= support_dot(n, camera->eye);
        if (d > nearest) nearest = d, shade = draw_camera_shade(camera, n);
    }
    return shade;
}

static double first_item(const draw_solid *solid, draw_point at) {
    for (size_t i = 0; i < solid->items.count; i++) {
        const draw_item *item = solid->items.data + i;
        if (inside(solid->points.data + item->first, item->count, at)) return item->shade;
    }
    return -1;
}

static void the_walk_finds_what_a_ray_finds(void **state) {
    (void)state;
    static const double views[][3] = {{0, 0, 0}, {0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {-1, 2, -0.5}};
    int hits = 0, misses = 0, wrong = 0;
    for (int v = 0; v < 5; v++) {
        froe_tree *tree = tree_of(random_triangles(70, 0.9), v % 2 ? "density" : "autopartition", 0);
        const froe_scene *scene = froe_tree_scene(tree);
        froe_draw_options o = froe_draw_defaults();
        double lo[3], hi[3];
        assert_true(froe_scene_bounds(scene, lo, hi));
        o.explode = 0;
        o.legend = false;
        memcpy(o.view, views[v], sizeof o.view);
        draw_task task = {.total = 1};
        draw_picture picture = {.show = FROE_DRAW_OBJECTS, .space = draw_space_over(3, v % 3, lo, hi)};
        picture.page = (draw_page){.tree = tree, .options = &o, .alloc = support_allocator(NULL), .task = &task};
        assert_int_equal(draw_solid_plan(&picture), FROE_OK);
        draw_camera camera = draw_camera_from(&picture.space, o.view);
        uint64_t random = 5;
        for (int i = 0; i < 2000; i++) {
            draw_point at = {2.4 * next_random(&random) - 1.2, 2.4 * next_random(&random) - 1.2};
            double seen = first_item(picture.solid, at), true_shade = first_hit(scene, &picture.space, &camera, at);
            hits += true_shade >= 0;
            misses += true_shade < 0;
            wrong += fabs(seen - true_shade) > 1e-3; /* rays within 1e-9 of an edge may differ */
        }
        draw_picture_free(&picture);
        froe_tree_free(tree);
    }
    assert_true(hits > 2000 && misses > 500);
    assert_true(wrong <= 2);
}

/* What the painter's order rests on: after the move, a plane parallel to the cut still separates the
 * parts below it from those above. */
static void parts_pulled_apart_stay_separated_by_their_cuts(void **state) {
    (void)state;
    froe_tree *tree = tree_of(random_triangles(50, 0.4), "autopartition", 1);
    const froe_scene *scene = froe_tree_scene(tree);
    froe_draw_options o = froe_draw_defaults();
    double lo[3], hi[3];
    assert_true(froe_scene_bounds(scene, lo, hi));
    o.explode = 0.7;
    o.explode_depth = 5;
    draw_task task = {.total = 1};
    draw_picture picture = {.show = 15, .space = draw_space_over(3, 2, lo, hi)};
    picture.page = (draw_page){.tree = tree, .options = &o, .alloc = support_allocator(NULL), .task = &task};
    assert_int_equal(draw_solid_plan(&picture), FROE_OK);
    const draw_solid *solid = picture.solid;
    froe_node_info root = froe_tree_node(tree, froe_tree_root(tree));
    draw_plane plane = draw_space_plane(&picture.space, scene, &root.cut);
    int sides[2] = {0, 0};
    double gap[2] = {-HUGE_VAL, HUGE_VAL}; /* highest moved corner below the root's cut, lowest above it */
    for (size_t i = 0; i < solid->parts.count; i++) {
        const draw_part *part = solid->parts.data + i;
        size_t corners = solid->face_ends.data[part->first_face + part->face_count - 1];
        int side = support_dot(plane.n, part->middle) > plane.c;
        sides[side]++;
        for (size_t k = 0; k < corners; k++) {
            double at = support_dot(plane.n, solid->corners.data + part->first_corner + 3 * k) +
                        o.explode * support_dot(plane.n, part->middle);
            gap[side] = side ? fmin(gap[1], at) : fmax(gap[0], at);
        }
    }
    assert_true(sides[0] > 1 && sides[1] > 1);
    assert_true(gap[0] < gap[1]);
    draw_picture_free(&picture);
    froe_tree_free(tree);
}

/* --------------------------------------------------------------- lettering -- */

/* The system's fonts serve titles beyond ASCII; fontconfig keeps what it found. */
const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void) {
    return "leak:libfontconfig";
}

static void every_ascii_character_has_a_glyph(void **state) {
    (void)state;
    cairo_surface_t *surface = cairo_recording_surface_create(CAIRO_CONTENT_COLOR_ALPHA, NULL);
    cairo_t *cr = cairo_create(surface);
    for (char c = ' '; c <= '~'; c++) {
        const char text[2] = {c, 0}, twice[3] = {c, c, 0};
        double x, y, w, h;
        assert_true(draw_text_known(text));
        assert_true(draw_text_length(cr, twice, 100) > 2 * draw_text_length(cr, text, 100) - 1e-9);
        cairo_surface_t *one = cairo_recording_surface_create(CAIRO_CONTENT_COLOR_ALPHA, NULL);
        cairo_t *pen = cairo_create(one);
        draw_text(pen, text, 0, 0, 100, 0);
        cairo_recording_surface_ink_extents(one, &x, &y, &w, &h);
        if (c != ' ') {
            assert_true(w > 1 && h > 1);
            assert_true(x >= -12 && y >= -95 && x + w <= draw_text_length(cr, text, 100) + 12 && y + h <= 40);
        }
        cairo_destroy(pen);
        cairo_surface_destroy(one);
    }
    assert_true(draw_text_known("1,034 \xC2\xB7 2 \xC3\x97 \xE2\x89\xA4"));
    assert_false(draw_text_known("Z\xC3\xBCrich") || draw_text_known("\xC2") || draw_text_known("a\nb"));
    assert_true(draw_text_length(cr, "Z\xC3\xBCrich", 100) > 100);
    assert_true(draw_text_length(cr, "", 100) == 0);
    cairo_destroy(cr);
    cairo_surface_destroy(surface);
}

static void numbers_are_written_for_people(void **state) {
    (void)state;
    char text[44];
    const struct {
        double value;
        const char *text;
    } cases[] = {{0, "0"},     {-1234567, "-1,234,567"}, {0.5, "0.5"},       {1e-5, "1e-05"},
                 {999, "999"}, {1000, "1,000"},          {2.65925, "2.659"}, {1e300, "1e+300"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        draw_number(text, cases[i].value);
        assert_string_equal(text, cases[i].text);
    }
    draw_count(text, UINT64_MAX);
    assert_string_equal(text, "18,446,744,073,709,551,615");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_cells_of_a_view_fill_its_window),
        cmocka_unit_test(planes_in_drawing_coordinates_keep_their_sides),
        cmocka_unit_test(plane_equations_of_every_kind_of_cut_agree),
        cmocka_unit_test(sections_of_solids_have_the_right_shape),
        cmocka_unit_test(the_walk_finds_what_a_ray_finds),
        cmocka_unit_test(parts_pulled_apart_stay_separated_by_their_cuts),
        cmocka_unit_test(every_ascii_character_has_a_glyph),
        cmocka_unit_test(numbers_are_written_for_people),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
