/* test_picture.c: pictures of whole faces, regions and fragments, their lines and cameras, against exact rays
 * (pages.h). */
#include "pages.h"
#include "view/visibility/order.h"
#include <froe/formats.h>

static froe_picture_report check_tree(froe_tree *tree, uint32_t eyes, uint32_t samples, froe_paint paint,
                                      bool through) {
    page p;
    froe_picture_report sum = {.late = 0};
    open_page(&p, tree);
    uint8_t *clear = calloc(p.surface->patch_count + 1, 1);
    for (uint32_t i = 0; i < p.surface->patch_count; i++) clear[i] = through && trees_random(11, i, 2);
    p.options.paint = paint;
    p.options.underlap = 3;
    if (through) p.options.clear = clear;
    for (uint32_t e = 0; e < eyes; e++) {
        set_view(&p, e);
        check_view(&p, samples, e);
        const froe_picture_report r = froe_picture_statistics(p.picture);
        assert_int_equal(r.paint, paint);
        sum.late += r.late, sum.cyclic += r.cyclic, sum.whole += r.whole, sum.shapes += r.shapes, sum.arcs += r.arcs;
        froe_picture_free(p.picture);
    }
    print_message("  %s: %d samples show something, %d nothing, %.2f layers; %d shapes, %d whole, %d late\n",
                  froe_paint_name(paint), (int)p.shown, (int)p.empty, (double)p.layers / (double)(p.shown + 1),
                  (int)sum.shapes, (int)sum.whole, (int)sum.late);
    assert_true(p.shown > eyes);
    free(clear);
    close_page(&p);
    froe_tree_free(tree);
    return sum;
}

static froe_tree *random_tree(void) {
    return trees_grow(3, FROE_POLYGON, 80, 0, 1, "density", 1);
}

static froe_tree *lattice_tree(void) {
    return trees_grow(3, FROE_POLYGON, 80, 3, 2, "density", 1);
}

/* Triangles that hang together, so that underlap has somewhere to go: a rough landscape. */
static froe_tree *landscape(void) {
    enum { N = 9 };
    froe_scene *scene;
    double x[N * N * 3];
    uint32_t ids[(N - 1) * (N - 1) * 6], count = 0;
    for (uint32_t i = 0; i < N * N; i++)
        x[3 * i] = i % N, x[3 * i + 1] = (double)i / N, x[3 * i + 2] = 4 * trees_unit(2, i);
    for (uint32_t i = 0; i < N * N; i++)
        if (i % N < N - 1 && i / N < N - 1) {
            const uint32_t quad[6] = {i, i + 1, i + N, i + 1, i + N + 1, i + N};
            for (int k = 0; k < 6; k++) ids[count++] = quad[k];
        }
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    froe_objects o = froe_objects_defaults();
    o.count = count / 3, o.coords = x, o.point_count = N * N, o.indices = ids;
    assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
    froe_tree *tree = trees_build(scene, "density", 1);
    froe_scene_free(scene);
    return tree;
}

/* Six triangles of one plane, one patch, round a corner and back over each other: A B C and A B D lie on the same side
 * of their edge A B, which therefore is border. A wall stands behind them.
 *
 *      X -------- Y
 *      | \      / |
 *      |   C - D  |
 *      | / `\/` \ |
 *      A -------- B */
static froe_tree *folded_patch(void) {
    enum { A, B, C, D, X, Y };
    const double points[9][3] = {{0, 0, 0}, {4, 0, 0},    {1, 3, 0},    {3, 3, 0},  {0, 6, 0},
                                 {6, 6, 0}, {-9, -8, -1}, {17, -8, -1}, {3, 20, -1}};
    const uint32_t ids[21] = {A, B, C, A, B, D, A, C, X, C, Y, X, C, D, Y, D, B, Y, 6, 7, 8};
    froe_scene *scene;
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    froe_objects o = froe_objects_defaults();
    o.count = 7, o.coords = points[0], o.point_count = 9, o.indices = ids;
    assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
    froe_tree *tree = trees_build(scene, "density", 1);
    froe_scene_free(scene);
    return tree;
}

static void a_patch_may_lie_over_itself(void **state) {
    (void)state;
    froe_tree *tree = folded_patch();
    page p;
    open_page(&p, tree);
    assert_int_equal(froe_surface_patch_count(p.surface), 2);
    uint8_t kinds[32];
    for (uint32_t e = 0; e < 6; e++) {
        view_sightlines sights;
        geom_eye eye;
        set_view(&p, e);
        assert_int_equal(view_eye_of(tree, &p.view.eye, &eye, NULL), FROE_OK);
        assert_int_equal(view_sightlines_new(&sights, tree, p.surface, &eye, NULL, 0, &tree->alloc), FROE_OK);
        assert_true(froe_surface_edge_count(p.surface) <= sizeof kinds);
        view_line_kinds(&sights, FROE_LINE_SILHOUETTE, 30, kinds);
        assert_int_equal(kinds[0], FROE_LINE_SILHOUETTE); /* A B */
        view_sightlines_free(&sights);
    }
    close_page(&p);
    check_tree(tree, 6, 200, FROE_PAINT_WHOLE, false);
    check_tree(folded_patch(), 6, 200, FROE_PAINT_REGIONS, false);
}

static void whole_patches_paint_each_other_over(void **state) {
    (void)state;
    froe_picture_report r = check_tree(random_tree(), 5, 40, FROE_PAINT_WHOLE, false);
    assert_true(r.late > 0 && r.whole > r.late && r.whole + r.late == r.shapes);
    check_tree(lattice_tree(), 5, 40, FROE_PAINT_WHOLE, false);
    r = check_tree(landscape(), 5, 40, FROE_PAINT_WHOLE, false);
    assert_int_equal(r.late, 0);
}

/* Pieces between a sheared wall and the upright face that it touches have no width, and some had corners that are no
 * numbers. */
static void corners_of_pieces_without_width_are_numbers(void **state) {
    (void)state;
    static const char *const kinds[] = {"cells-3d", "degenerate-3d"};
    for (int i = 0; i < 2; i++)
        for (int paint = 0; paint < FROE_PAINT_COUNT; paint++) {
            page p;
            froe_scene *scene;
            froe_tree *tree;
            froe_build_options o = froe_build_defaults();
            o.method = "cylindrical", o.settings = "crossing=split", o.leaf = 1;
            assert_int_equal(froe_generate(kinds[i], 48, 5, NULL, &scene, NULL), FROE_OK);
            assert_int_equal(froe_build(scene, &o, &tree, NULL), FROE_OK);
            open_page(&p, tree);
            p.options.paint = (froe_paint)paint;
            for (uint32_t e = 0; e < 8; e++) {
                set_view(&p, e);
                check_view(&p, 0, e);
                froe_picture_free(p.picture);
            }
            close_page(&p);
            froe_tree_free(tree);
            froe_scene_free(scene);
        }
}

static void regions_and_fragments_show_the_same(void **state) {
    (void)state;
    check_tree(random_tree(), 5, 40, FROE_PAINT_REGIONS, false);
    check_tree(lattice_tree(), 5, 40, FROE_PAINT_REGIONS, false);
    check_tree(random_tree(), 1, 40, FROE_PAINT_REGIONS, true); /* overlap then, in an order of their own */
    check_tree(lattice_tree(), 1, 40, FROE_PAINT_REGIONS, true);
    check_tree(random_tree(), 5, 40, FROE_PAINT_FRAGMENTS, false);
    check_tree(lattice_tree(), 5, 40, FROE_PAINT_FRAGMENTS, false);
}

static void layers_that_one_sees_through_come_in_their_order(void **state) {
    (void)state;
    const froe_picture_report r = check_tree(random_tree(), 5, 30, FROE_PAINT_WHOLE, true);
    assert_true(r.late > 0);
    check_tree(lattice_tree(), 5, 30, FROE_PAINT_WHOLE, true);
    check_tree(landscape(), 5, 30, FROE_PAINT_WHOLE, true);
}

/* A tall wall beside two low ones, in one plane: they share no edge, for the middle of the tall one's is no corner. */
static froe_tree *junction(void) {
    const double x[] = {0, 0, 0, 2, 0, 0, 2, 0, 2, 0, 0, 2, 2, 0, 0, 3, 0, 0,
                        3, 0, 1, 2, 0, 1, 2, 0, 1, 3, 0, 1, 3, 0, 2, 2, 0, 2};
    const size_t starts[] = {0, 4, 8, 12};
    froe_tree *tree = trees_of_polygons(x, starts, 3, "density");
    return tree;
}

static uint32_t shapes_at(const page *p, double x, double y) {
    uint32_t count = 0;
    for (size_t i = 0; i < froe_picture_shape_count(p->picture); i++) {
        const froe_shape s = froe_picture_shape(p->picture, i);
        count += inside_shape(p, &s, x, y);
    }
    return count;
}

/* Seen close, on either side of the border, one of the two is extended under the other. */
static void shapes_go_under_later_ones_where_corners_are_not_shared(void **state) {
    (void)state;
    froe_tree *tree = junction();
    const uint32_t styles[] = {0, 1, 2};
    page p;
    open_page(&p, tree);
    p.options.styles = styles;
    look_from(&p, 0, -5, 0, 0);
    for (int with = 0; with < 2; with++) {
        p.options.underlap = with;
        check_view(&p, 50, 1);
        for (int k = 1; k < 8; k++) {
            const double at[3] = {2, 0, 0.25 * k + 0.01};
            double spot[2];
            assert_true(froe_project(&p.view, at, spot));
            assert_int_equal(shapes_at(&p, spot[0] - 0.4, spot[1]) + shapes_at(&p, spot[0] + 0.4, spot[1]), 2 + with);
        }
        froe_picture_free(p.picture);
    }
    close_page(&p);
    froe_tree_free(tree);
}

/* A wall beside a triangle in its plane, whose border leads away at a sharp angle. A board passes from before the wall
 * to behind the triangle, which therefore is painted last. */
static void shapes_go_under_later_ones_with_sharp_corners(void **state) {
    (void)state;
    const double x[] = {0, 0, 0, 2, 0,    0,      2,   0,    2,     0,   0,    2,     2,   0,    0,      2.75, 0,
                        1, 2, 0, 1, 1.75, -0.125, 0.6, 2.25, 0.125, 0.6, 2.25, 0.125, 0.8, 1.75, -0.125, 0.8};
    const size_t starts[] = {0, 4, 7, 11};
    const uint32_t styles[] = {0, 1, 2};
    page p;
    froe_tree *tree = trees_of_polygons(x, starts, 3, "density");
    open_page(&p, tree);
    p.options.styles = styles;
    look_from(&p, 0, -5, 0, 30);
    for (int with = 0; with < 2; with++) {
        p.options.underlap = with;
        check_view(&p, 50, 1);
        for (int k = 1; k < 6; k++) {
            const double at[3] = {2, 0, 0.1 * k};
            double spot[2];
            assert_true(froe_project(&p.view, at, spot));
            assert_int_equal(shapes_at(&p, spot[0] - 0.2, spot[1]), 1);
            assert_int_equal(shapes_at(&p, spot[0] + 0.2, spot[1]), 1 + with);
        }
        froe_picture_free(p.picture);
    }
    close_page(&p);
    froe_tree_free(tree);
}

/* Two roofs from one ridge, the farther one seen below the eaves of the nearer one: along the ridge
 * it is hidden and would shine through. */
static void what_is_hidden_ends_before_what_hides_it(void **state) {
    (void)state;
    const double x[] = {0, 0, 4, 9, 0, 4, 9, -6, -2, 0, -6, -2, 0, 0, 4, 9, 0, 4, 9, -4.5, 1.5, 0, -4.5, 1.5};
    const size_t starts[] = {0, 4, 8};
    const uint32_t styles[] = {0, 1};
    page p;
    froe_tree *tree = trees_of_polygons(x, starts, 2, "density");
    open_page(&p, tree);
    p.options.styles = styles;
    look_from(&p, 0, -1, 0.2, 0);
    for (int with = 0; with < 2; with++) {
        double at[3] = {4.5, 0, 4}, spot[2];
        p.options.underlap = with;
        check_view(&p, 50, 1);
        assert_int_equal(froe_picture_shape_count(p.picture), 2);
        assert_true(froe_project(&p.view, at, spot));
        assert_int_equal(shapes_at(&p, spot[0], spot[1] + 0.4), 2 - with);
        assert_int_equal(shapes_at(&p, spot[0], spot[1] + 2), 2);
        froe_picture_free(p.picture);
    }
    close_page(&p);
    froe_tree_free(tree);
}

static void beyond_its_budget_a_picture_is_made_of_fragments_and_says_so(void **state) {
    (void)state;
    froe_tree *tree = random_tree();
    page p;
    open_page(&p, tree);
    p.options.max_graph = 10;
    set_view(&p, 1);
    check_view(&p, 40, 1);
    assert_int_equal(froe_picture_statistics(p.picture).paint, FROE_PAINT_FRAGMENTS);
    froe_picture_free(p.picture);
    close_page(&p);
    froe_tree_free(tree);
}

/* Shapes of one style lie next to each other where nothing is in the way. */
static void styles_come_together(void **state) {
    (void)state;
    froe_tree *tree = landscape();
    page p;
    open_page(&p, tree);
    uint32_t *styles = calloc(p.surface->patch_count, sizeof *styles), runs[2] = {0, 0};
    for (uint32_t i = 0; i < p.surface->patch_count; i++) styles[i] = i % 3;
    set_view(&p, 1);
    for (int with = 0; with < 2; with++) {
        p.options.styles = with ? styles : NULL;
        check_view(&p, 20, 1);
        for (size_t i = 1; i < froe_picture_shape_count(p.picture); i++)
            runs[with] +=
                styles[froe_picture_shape(p.picture, i).patch] != styles[froe_picture_shape(p.picture, i - 1).patch];
        froe_picture_free(p.picture);
    }
    assert_true(3 * runs[1] < runs[0]);
    free(styles);
    close_page(&p);
    froe_tree_free(tree);
}

/* All strokes of a kind together are as long as the intervals they come from, and far fewer. */
static void strokes_are_the_intervals_chained(void **state) {
    (void)state;
    froe_tree *tree = landscape();
    page p;
    open_page(&p, tree);
    p.options.lines = 127;
    p.options.hidden = true;
    for (uint32_t e = 1; e < 6; e++) {
        if (e % 3 == 0) continue;
        set_view(&p, e);
        check_view(&p, 1, 1);
        froe_visibility_options o = froe_visibility_defaults();
        froe_visibility *v;
        double expected[2] = {0, 0}, found[2] = {0, 0};
        uint64_t pieces = 0;
        o.eye = p.view.eye;
        o.window = p.view.window, o.window_corners = 4;
        assert_int_equal(froe_visibility_new(tree, p.surface, &o, &v, NULL), FROE_OK);
        for (uint32_t i = 0; i < p.surface->edge_count; i++) {
            size_t count;
            const froe_interval *x = froe_visibility_of_edge(v, i, &count);
            const froe_edge edge = froe_surface_edge(p.surface, i);
            double last[2], at[2];
            const double *a = scene_vertex(tree->scene, edge.vertex[0]), *b = scene_vertex(tree->scene, edge.vertex[1]);
            if (p.surface->patch_of[edge.objects[0]] == p.surface->patch_of[edge.objects[edge.object_count - 1]] &&
                edge.object_count == 2)
                continue;
            assert_true(froe_project(&p.view, a, last));
            for (size_t k = 0; k < 2 * count + 1; k++) {
                const double t = k == 2 * count ? 1 : k % 2 ? x[k / 2].to : x[k / 2].from;
                double point[3];
                for (int c = 0; c < 3; c++) point[c] = a[c] + t * (b[c] - a[c]);
                assert_true(froe_project(&p.view, point, at));
                expected[k % 2 == 0] += hypot(at[0] - last[0], at[1] - last[1]);
                memcpy(last, at, sizeof at);
            }
            pieces += 2 * count + 1;
        }
        for (size_t i = 0; i < froe_picture_stroke_count(p.picture); i++) {
            const froe_stroke s = froe_picture_stroke(p.picture, i);
            assert_true(s.count >= 2 && froe_line_name(s.kind));
            found[s.hidden] += length_of(&s);
        }
        assert_true(expected[0] > 100 && expected[1] > 100);
        assert_true(fabs(found[0] - expected[0]) < 1e-3 * expected[0]);
        assert_true(found[1] < 1.001 * expected[1] &&
                    found[1] > 0.7 * expected[1]); /* what lies on others is left out */
        assert_true(2 * froe_picture_stroke_count(p.picture) < pieces);
        froe_visibility_free(v);
        froe_picture_free(p.picture);
    }
    close_page(&p);
    froe_tree_free(tree);
}

/* A bar behind a post: a halo parts it on both sides of the post, by as much as was asked for; and a second bar right
 * behind the first leaves no hidden line of its own. */
static void halos_part_lines_and_hidden_ones_are_drawn_once(void **state) {
    (void)state;
    const double x[] = {0, 0,  4,  10, 0,  4,  10, 0, 6, 0,  0, 6, 4,  -9, 0, 6, -9, 0,
                        6, -9, 10, 4,  -9, 10, 0,  2, 4, 10, 2, 4, 10, 2,  6, 0, 2,  6};
    const size_t starts[] = {0, 4, 8, 12};
    page p;
    froe_tree *tree = trees_of_polygons(x, starts, 3, "density");
    open_page(&p, tree);
    p.options.lines = FROE_LINE_BORDER;
    p.options.hidden = true;
    look_from(&p, 0, -5, 0, 10);
    for (int halo = 0; halo <= 3; halo += 3) {
        double length[2] = {0, 0};
        p.options.halo = halo;
        check_view(&p, 20, 1);
        for (size_t i = 0; i < froe_picture_stroke_count(p.picture); i++) {
            const froe_stroke s = froe_picture_stroke(p.picture, i);
            length[s.hidden] += length_of(&s);
        }
        assert_true(fabs(length[0] - (240 + 200 - 4 * halo)) < 1e-6);
        assert_true(fabs(length[1] - 2 * 20) < 1e-6);
        froe_picture_free(p.picture);
    }
    close_page(&p);
    froe_tree_free(tree);
}

/* Two walls, the far one beginning just beyond the side of the near one: what begins there goes under the near wall,
 * whose own lines stay on top. On a landscape lines are as long as before, and come in the order of their places. */
static void lines_may_go_under_what_is_nearer(void **state) {
    (void)state;
    const double x[] = {0, 0, 0, 10, 0, 0, 10, 0, 10, 0, 0, 10, 10.1, 9, 0, 20, 9, 0, 20, 9, 10, 10.1, 9, 10};
    const size_t starts[] = {0, 4, 8};
    page p;
    froe_tree *tree = trees_of_polygons(x, starts, 2, "density");
    open_page(&p, tree);
    p.options.lines = FROE_LINE_BORDER;
    look_from(&p, 0, -5, 0, 10);
    for (int reach = 0; reach <= 2; reach += 2) {
        double under = 0;
        p.options.interleave = reach;
        check_view(&p, 20, 1);
        assert_int_equal(froe_picture_shape_count(p.picture), 2);
        for (size_t i = 0; i < froe_picture_stroke_count(p.picture); i++) {
            const froe_stroke s = froe_picture_stroke(p.picture, i);
            assert_true(s.place == 1 || s.place == 2);
            if (s.place == 1) under += length_of(&s);
        }
        if (reach) assert_int_equal(froe_picture_shape(p.picture, 1).patch, 0);
        assert_true(fabs(under - (reach ? 100 + 2 * 99 : 0)) < 1e-6);
        froe_picture_free(p.picture);
    }
    close_page(&p);
    froe_tree_free(tree);
}

static void lines_among_shapes_are_the_same_lines(void **state) {
    (void)state;
    froe_tree *tree = landscape();
    page p;
    double length[2] = {0, 0};
    size_t under = 0;
    open_page(&p, tree);
    p.options.lines = 127;
    set_view(&p, 1);
    for (int round = 0; round < 2; round++) {
        size_t last = 0;
        p.options.interleave = 2 * round;
        check_view(&p, 1, 1);
        for (size_t i = 0; i < froe_picture_stroke_count(p.picture); i++) {
            const froe_stroke s = froe_picture_stroke(p.picture, i);
            assert_true(s.place >= last && s.place <= froe_picture_shape_count(p.picture));
            under += s.place < froe_picture_shape_count(p.picture);
            length[round] += length_of(&s);
            last = s.place;
        }
        if (!round) assert_int_equal(under, 0);
        froe_picture_free(p.picture);
    }
    assert_true(under > 0);
    assert_true(fabs(length[0] - length[1]) < 1e-6 * length[0]);
    close_page(&p);
    froe_tree_free(tree);
}

static void bad_cameras_are_refused(void **state) {
    (void)state;
    froe_tree *tree = random_tree();
    froe_projection view;
    froe_diagnostic why;
    froe_camera c = froe_camera_defaults();
    memcpy(c.eye, c.target, sizeof c.eye);
    assert_int_equal(froe_camera_place(&c, tree->scene, &view, &why), FROE_E_ARG);
    assert_non_null(strstr(why.message, "where it looks"));
    c = froe_camera_defaults();
    c.fov = 180;
    assert_int_equal(froe_camera_place(&c, tree->scene, &view, &why), FROE_E_OPTIONS);
    c = froe_camera_defaults();
    c.scale = -1;
    assert_int_equal(froe_camera_place(&c, tree->scene, &view, &why), FROE_E_OPTIONS);
    c = froe_camera_defaults();
    c.width = 0;
    assert_int_equal(froe_camera_place(&c, tree->scene, &view, &why), FROE_E_OPTIONS);
    c = froe_camera_defaults();
    c.margin = 600;
    assert_int_equal(froe_camera_place(&c, tree->scene, &view, &why), FROE_E_OPTIONS);
    c = froe_camera_defaults();
    c.eye[1] = (double)NAN;
    assert_int_equal(froe_camera_place(&c, tree->scene, &view, &why), FROE_E_ARG);
    c = froe_camera_defaults();
    c.eye[0] = c.eye[1] = 0;
    assert_int_equal(froe_camera_place(&c, tree->scene, &view, &why), FROE_OK);
    assert_int_equal(view.up_axis, 0);
    froe_tree_free(tree);
    tree = trees_grow(3, FROE_POLYGON, 0, 0, 1, "density", 1);
    c = froe_camera_defaults();
    assert_int_equal(froe_camera_place(&c, tree->scene, &view, &why), FROE_E_INPUT);
    froe_tree_free(tree);
}

/* Every vertex within the margins, and two sides of the page reached. */
static void what_is_fitted_fills_the_page(void **state) {
    (void)state;
    froe_tree *tree = random_tree();
    for (int parallel = 0; parallel < 2; parallel++) {
        froe_camera c = froe_camera_defaults();
        froe_projection view;
        double lo[2] = {1e9, 1e9}, hi[2] = {0, 0};
        c.parallel = parallel;
        c.width = 600, c.height = 900, c.margin = 10;
        assert_int_equal(froe_camera_place(&c, tree->scene, &view, NULL), FROE_OK);
        for (uint32_t i = 0; i < tree->scene->vertex_count; i++) {
            double at[2];
            assert_true(froe_project(&view, scene_vertex(tree->scene, i), at));
            for (int k = 0; k < 2; k++) lo[k] = fmin(lo[k], at[k]), hi[k] = fmax(hi[k], at[k]);
        }
        assert_true(lo[0] > 10 - 1e-6 && lo[1] > 10 - 1e-6 && hi[0] < 590 + 1e-6 && hi[1] < 890 + 1e-6);
        assert_true(hi[0] - lo[0] > 580 - 1e-6 || hi[1] - lo[1] > 880 - 1e-6);
    }
    froe_tree_free(tree);
}

/* Seen from all around, everything stays within the margins; opposite pictures are turned by half a round. */
static void a_turntable_keeps_scale_and_page(void **state) {
    (void)state;
    enum { N = 6 };
    froe_tree *tree = random_tree();
    for (int parallel = 0; parallel < 2; parallel++) {
        froe_camera c = froe_camera_defaults(), turned[N];
        froe_projection view[N];
        c.parallel = parallel;
        c.margin = 10;
        assert_int_equal(froe_camera_turn(&c, tree->scene, N, turned, NULL), FROE_OK);
        for (int f = 0; f < N; f++) {
            assert_int_equal(froe_camera_place(&turned[f], tree->scene, &view[f], NULL), FROE_OK);
            assert_true(fabs(view[f].scale - view[0].scale) < 1e-9 * view[0].scale);
            for (uint32_t i = 0; i < tree->scene->vertex_count; i++) {
                double at[2];
                assert_true(froe_project(&view[f], scene_vertex(tree->scene, i), at));
                for (int k = 0; k < 2; k++) assert_true(at[k] > 10 - 1e-6 && at[k] < 990 + 1e-6);
            }
        }
        for (int k = 0; k < 3; k++) assert_true(fabs(view[0].right[k] + view[3].right[k]) < 1e-12);
        double turns[4 * N + 4];
        assert_int_equal(froe_camera_turns(&c, N, turns, NULL), FROE_OK);
        for (int f = 0; f <= N; f++) { /* v + 2 n x (n x v + w v) */
            const double *q = turns + 4 * f, *v = view[0].back;
            const double t[3] = {q[1] * v[2] - q[2] * v[1] + q[3] * v[0], q[2] * v[0] - q[0] * v[2] + q[3] * v[1],
                                 q[0] * v[1] - q[1] * v[0] + q[3] * v[2]};
            assert_true(fabs(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3] - 1) < 1e-14);
            for (int k = 0; k < 3; k++) {
                const int i = (k + 1) % 3, j = (k + 2) % 3;
                assert_true(fabs(v[k] + 2 * (q[i] * t[j] - q[j] * t[i]) - view[f % N].back[k]) < 1e-12);
            }
        }
        c.up[2] = 0;
        assert_int_equal(froe_camera_turn(&c, tree->scene, N, turned, NULL), FROE_E_ARG);
        assert_int_equal(froe_camera_turns(&c, N, turns, NULL), FROE_E_ARG);
    }
    froe_tree_free(tree);
}

/* What is left out is what the report says, and all of it with a limit above everything. */
static void small_faces_may_be_left_out(void **state) {
    (void)state;
    froe_tree *tree = random_tree();
    page p;
    open_page(&p, tree);
    set_view(&p, 1);
    size_t shapes[3];
    for (int i = 0; i < 3; i++) {
        p.options.min_area = i == 0 ? 0 : i == 1 ? 500 : 1e12;
        assert_int_equal(froe_picture_new(p.tree, p.surface, &p.options, &p.picture, NULL), FROE_OK);
        const froe_picture_report r = froe_picture_statistics(p.picture);
        shapes[i] = froe_picture_shape_count(p.picture);
        assert_int_equal(shapes[i] + r.left_out, shapes[0]);
        assert_true(i == 0 || (r.left_out > 0 && r.left_out_area <= (double)r.left_out * p.options.min_area));
        froe_picture_free(p.picture);
    }
    assert_true(shapes[1] > 0 && shapes[2] == 0);
    close_page(&p);
    froe_tree_free(tree);
}

typedef struct progress_log {
    double last;
    unsigned calls, stop; /* false at this call, from 1; 0: never */
} progress_log;

static bool note_progress(void *user, double done) {
    progress_log *log = user;
    assert_true(done >= log->last && done <= 1);
    log->last = done;
    return ++log->calls != log->stop;
}

static void a_picture_can_be_cancelled_at_every_report(void **state) {
    (void)state;
    froe_tree *tree = trees_grow(3, FROE_POLYGON, 1500, 0, 0.1, "density", 1);
    froe_surface *surface;
    froe_projection view;
    assert_int_equal(froe_surface_new(tree->scene, NULL, &surface, NULL), FROE_OK);
    froe_camera camera = froe_camera_defaults();
    camera.eye[0] = 3, camera.eye[1] = -2, camera.eye[2] = 2, camera.fit = true;
    assert_int_equal(froe_camera_place(&camera, tree->scene, &view, NULL), FROE_OK);
    for (int paint = 0; paint < FROE_PAINT_COUNT; paint++) {
        froe_picture_options o = froe_picture_defaults();
        progress_log log = {.last = 0};
        froe_picture *picture;
        o.view = &view, o.paint = (froe_paint)paint, o.threads = 1, o.progress = note_progress, o.user = &log;
        assert_int_equal(froe_picture_new(tree, surface, &o, &picture, NULL), FROE_OK);
        froe_picture_free(picture);
        assert_true(log.last == 1 && log.calls > 5);
        for (unsigned stop = 1, calls = log.calls; stop <= calls; stop++) {
            froe_diagnostic why;
            log = (progress_log){.stop = stop};
            assert_int_equal(froe_picture_new(tree, surface, &o, &picture, &why), FROE_E_CANCELLED);
            assert_string_equal(why.message, "Cancelled.");
            assert_int_equal(log.calls, stop);
        }
    }
    froe_surface_free(surface);
    froe_tree_free(tree);
}

static void every_allocation_may_fail(void **state) {
    (void)state;
    froe_tree *tree = trees_grow(3, FROE_POLYGON, 14, 0, 1, "density", 1);
    page p;
    open_page(&p, tree);
    uint8_t *clear = calloc(p.surface->patch_count, 1);
    set_view(&p, 1);
    p.options.lines = 127;
    p.options.underlap = 1;
    p.options.halo = 1;
    p.options.hidden = true;
    p.options.min_area = 1;
    p.options.interleave = 1;
    for (int paint = 0; paint < FROE_PAINT_COUNT; paint++) {
        p.options.paint = (froe_paint)paint;
        assert_true(test_memory_each(make_picture, &p) > 20);
    }
    clear[0] = clear[5] = 1;
    p.options.paint = FROE_PAINT_WHOLE;
    p.options.clear = clear;
    assert_true(test_memory_each(make_picture, &p) > 20);
    free(clear);
    close_page(&p);
    froe_tree_free(tree);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(whole_patches_paint_each_other_over),
        cmocka_unit_test(a_patch_may_lie_over_itself),
        cmocka_unit_test(corners_of_pieces_without_width_are_numbers),
        cmocka_unit_test(regions_and_fragments_show_the_same),
        cmocka_unit_test(layers_that_one_sees_through_come_in_their_order),
        cmocka_unit_test(shapes_go_under_later_ones_where_corners_are_not_shared),
        cmocka_unit_test(shapes_go_under_later_ones_with_sharp_corners),
        cmocka_unit_test(what_is_hidden_ends_before_what_hides_it),
        cmocka_unit_test(beyond_its_budget_a_picture_is_made_of_fragments_and_says_so),
        cmocka_unit_test(styles_come_together),
        cmocka_unit_test(strokes_are_the_intervals_chained),
        cmocka_unit_test(halos_part_lines_and_hidden_ones_are_drawn_once),
        cmocka_unit_test(lines_may_go_under_what_is_nearer),
        cmocka_unit_test(lines_among_shapes_are_the_same_lines),
        cmocka_unit_test(bad_cameras_are_refused),
        cmocka_unit_test(what_is_fitted_fills_the_page),
        cmocka_unit_test(a_turntable_keeps_scale_and_page),
        cmocka_unit_test(small_faces_may_be_left_out),
        cmocka_unit_test(a_picture_can_be_cancelled_at_every_report),
        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
