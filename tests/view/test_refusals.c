/* test_refusals.c: calls about views with arguments that are none: a status with a sentence. What is read beyond the
 * end is nothing. */
#include "../tree/trees.h"
#include "support/tree_file.h"
#include <froe/view.h>
#include <math.h>

#include "support/refusals.h" /* last: others have variables called `why` */

#define REFUSED(call, words) expect(call, FROE_E_OPTIONS, words)
#define DAMAGED(call) expect(call, FROE_E_FORMAT, "")

/* A tree of triangles in space, its surface, and what a camera makes of it. */
typedef struct stage {
    froe_tree *tree;
    froe_surface *surface;
    froe_projection view;
} stage;

static stage open_stage(void) {
    stage s = {.tree = trees_grow(3, FROE_POLYGON, 20, 0, 1, "density", 1)};
    const froe_camera camera = froe_camera_defaults();
    assert_int_equal(froe_surface_new(s.tree->scene, NULL, &s.surface, &why), FROE_OK);
    assert_int_equal(froe_camera_place(&camera, s.tree->scene, &s.view, &why), FROE_OK);
    return s;
}

static void close_stage(stage *s) {
    froe_surface_free(s->surface);
    froe_tree_free(s->tree);
}

/* -------------------------------------------------------------------- cameras -- */

static void place(const froe_camera *camera, froe_status wanted, const char *words) {
    froe_scene *scene = trees_scene(3, FROE_POLYGON, 3, 0, 1, 1);
    froe_projection view;
    expect(froe_camera_place(camera, scene, &view, &why), wanted, words);
    froe_scene_free(scene);
}

static void cameras_are_checked(void **state) {
    (void)state;
    stage s = open_stage();
    froe_camera c = froe_camera_defaults();
    froe_scene *plane = trees_scene(2, FROE_SEGMENT, 3, 0, 1, 1);
    NULLS(froe_camera_place(NULL, s.tree->scene, &s.view, &why));
    NULLS(froe_camera_place(&c, NULL, &s.view, &why));
    NULLS(froe_camera_place(&c, s.tree->scene, NULL, &why));
    expect(froe_camera_place(&c, plane, &s.view, &why), FROE_E_UNSUPPORTED, "not in 2");
    froe_scene_free(plane);
    c.size = 1, place(&c, FROE_E_OPTIONS, "froe_camera_defaults");
    for (int i = 0; i < 9; i++) {
        c = froe_camera_defaults();
        (i < 3 ? c.eye : i < 6 ? c.target : c.up)[i % 3] = i % 2 ? NAN : INFINITY;
        place(&c, FROE_E_ARG, (const char *const[]){"Coordinate 0", "Coordinate 1", "Coordinate 2"}[i % 3]);
    }
    static const double sides[] = {0, -1, 2e9, NAN};
    for (int i = 0; i < 8; i++) {
        c = froe_camera_defaults();
        *(i % 2 ? &c.width : &c.height) = sides[i / 2];
        place(&c, FROE_E_OPTIONS, "is none");
    }
    static const double margins[] = {-1, 500, NAN}, angles[] = {0.5, 171, NAN}, scales[] = {-1, NAN, INFINITY};
    for (int i = 0; i < 3; i++) {
        c = froe_camera_defaults(), c.margin = margins[i], place(&c, FROE_E_OPTIONS, "margin");
        c = froe_camera_defaults(), c.fov = angles[i], place(&c, FROE_E_OPTIONS, "angle of view");
        c = froe_camera_defaults(), c.scale = scales[i], place(&c, FROE_E_OPTIONS, "scale");
    }
    static const double planes[][4] = {{0, 0, 0, 1}, {NAN, 0, 0, 0}, {1, -INFINITY, 0, 0}, {0, 0, 1, NAN}};
    static const char *const why_not[] = {"length 0", "Number 0", "Number 1", "Number 3"};
    for (int i = 0; i < 4; i++) c = froe_camera_defaults(), c.section = planes[i], place(&c, FROE_E_ARG, why_not[i]);
    c = froe_camera_defaults(), c.parallel = true, c.scale = 1e-308; /* one unit of the page is more than a double */
    place(&c, FROE_E_ARG, "too small");
    c.scale = 1;
    for (int k = 0; k < 3; k++) c.eye[k] = c.target[k];
    place(&c, FROE_E_ARG, "where it looks");
    close_stage(&s);
}

/* A spire from above: its top, in the middle, is nearest to the eye, and its base does not keep the eye away. So it is
 * with a segment along the line of view; a point is seen from as far as its scene would be wide. */
static void what_points_at_the_eye_is_before_it(void **state) {
    (void)state;
    static const double spire[] = {-1, -1, 0, 1, -1, 0, 0, 0, 10, 1, 1, 0, -1, 1, 0, 0, 0, 10};
    static const double segment[] = {0, 0, 0, 0, 0, 10}, point[] = {0, 0, 5};
    static const struct {
        froe_kind kind;
        size_t count, corners;
        const double *coords;
        double least, most; /* of the height of the eye */
    } cases[] = {{FROE_POLYGON, 2, 6, spire, 10, 10.001},
                 {FROE_SEGMENT, 1, 2, segment, 10, 10.001},
                 {FROE_POINT, 1, 1, point, 6, 6}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        froe_scene *scene;
        froe_projection view;
        froe_camera c = froe_camera_defaults();
        assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
        assert_int_equal(trees_add(scene, cases[i].kind, cases[i].count, cases[i].coords, NULL, NULL), FROE_OK);
        c.eye[0] = c.eye[1] = 0, c.eye[2] = 1;
        if (froe_camera_place(&c, scene, &view, &why)) fail_msg("%s", why.message);
        assert_true(view.eye.at[2] >= cases[i].least && view.eye.at[2] <= cases[i].most);
        for (size_t k = 0; k < cases[i].corners; k++) { /* all of it is on the page */
            double page[2];
            assert_true(cases[i].coords[3 * k + 2] < view.eye.at[2] - view.near);
            assert_true(froe_project(&view, cases[i].coords + 3 * k, page));
            assert_true(fabs(page[0] - 500) <= 480.001 && fabs(page[1] - 500) <= 480.001);
        }
        froe_scene_free(scene);
    }
}

static void scenes_beyond_doubles_have_no_camera(void **state) {
    (void)state;
    static const double coords[] = {-1.5e308, 0, 0, 1.5e308, 0, 0, 0, 1, 0};
    const froe_camera camera = froe_camera_defaults();
    froe_projection view;
    froe_scene *scene;
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_POLYGON, 1, coords, NULL, NULL), FROE_OK);
    expect(froe_camera_place(&camera, scene, &view, &why), FROE_E_UNSUPPORTED, "extends over inf");
    froe_scene_free(scene);
}

static void turntables_are_checked(void **state) {
    (void)state;
    stage s = open_stage();
    froe_camera c = froe_camera_defaults(), out[2];
    double turns[12];
    NULLS(froe_camera_turns(NULL, 2, turns, &why));
    NULLS(froe_camera_turns(&c, 0, turns, &why));
    NULLS(froe_camera_turns(&c, 2, NULL, &why));
    NULLS(froe_camera_turn(NULL, s.tree->scene, 2, out, &why));
    NULLS(froe_camera_turn(&c, NULL, 2, out, &why));
    NULLS(froe_camera_turn(&c, s.tree->scene, 2, NULL, &why));
    NULLS(froe_camera_turn(&c, s.tree->scene, 0, out, &why));
    const froe_camera none = {0};
    expect(froe_camera_turns(&none, 2, turns, &why), FROE_E_OPTIONS, "froe_camera_defaults");
    expect(froe_camera_turn(&none, s.tree->scene, 2, out, &why), FROE_E_OPTIONS, "froe_camera_defaults");
    c.size++;
    expect(froe_camera_turns(&c, 2, turns, &why), FROE_E_OPTIONS, "froe_camera_defaults");
    c.size--;
    for (int i = 0; i < 3; i++) {
        c.up[2] = (const double[]){0, NAN, INFINITY}[i];
        expect(froe_camera_turns(&c, 2, turns, &why), FROE_E_ARG, "axis");
        expect(froe_camera_turn(&c, s.tree->scene, 2, out, &why), FROE_E_ARG, "axis");
    }
    close_stage(&s);
}

/* --------------------------------------------------------------------- orders -- */

static bool any_piece(void *user, size_t piece) {
    (void)user, (void)piece;
    return true;
}

static bool any_node(void *user, froe_node node, froe_order_stage at) {
    (void)user, (void)node, (void)at;
    return true;
}

static bool no_more(void *user, double done) {
    return done < *(const double *)user;
}

static void orders_are_checked(void **state) {
    (void)state;
    stage s = open_stage();
    const froe_eye eye = {.at = {1, 2, 3}}, bad = {.at = {1, NAN, 3}};
    froe_order_options o = froe_order_defaults();
    uint32_t pieces[2000];
    NULLS(froe_tree_order(NULL, &eye, NULL, any_piece, NULL, &why));
    NULLS(froe_tree_order(s.tree, NULL, NULL, any_piece, NULL, &why));
    NULLS(froe_tree_order(s.tree, &eye, NULL, NULL, NULL, &why));
    NULLS(froe_tree_order_nodes(NULL, &eye, NULL, any_node, NULL, &why));
    NULLS(froe_tree_order_nodes(s.tree, NULL, NULL, any_node, NULL, &why));
    NULLS(froe_tree_order_nodes(s.tree, &eye, NULL, NULL, NULL, &why));
    expect(froe_tree_order_nodes(s.tree, &bad, NULL, any_node, NULL, &why), FROE_E_ARG, "Coordinate 1");
    NULLS(froe_tree_orders(NULL, &eye, 1, NULL, pieces, &why));
    NULLS(froe_tree_orders(s.tree, NULL, 1, NULL, pieces, &why));
    NULLS(froe_tree_orders(s.tree, &eye, 1, NULL, NULL, &why));
    assert_int_equal(froe_tree_orders(s.tree, NULL, 0, NULL, NULL, &why), FROE_OK);
    froe_eye eyes[40];
    for (int i = 0; i < 40; i++) eyes[i] = i < 39 ? eye : bad;
    uint32_t *all = calloc(40 * froe_tree_piece_count(s.tree), sizeof *all);
    expect(froe_tree_orders(s.tree, eyes, 40, NULL, all, &why), FROE_E_ARG, "Coordinate 1");
    eyes[39] = eye;
    for (double done = 0; done < 1; done += 0.25) {
        o.progress = no_more, o.user = &done;
        expect(froe_tree_orders(s.tree, eyes, 40, &o, all, &why), FROE_E_CANCELLED, "Cancelled");
    }
    free(all);
    o = froe_order_defaults(), o.size = 1;
    REFUSED(froe_tree_order(s.tree, &eye, &o, any_piece, NULL, &why), "froe_order_defaults");
    REFUSED(froe_tree_order_nodes(s.tree, &eye, &o, any_node, NULL, &why), "froe_order_defaults");
    REFUSED(froe_tree_orders(s.tree, &eye, 1, &o, pieces, &why), "froe_order_defaults");
    close_stage(&s);
}

/* ------------------------------------------------------- surfaces, visibility -- */

static void surfaces_are_checked(void **state) {
    (void)state;
    stage s = open_stage();
    froe_surface *out;
    froe_scene *plane = trees_scene(2, FROE_SEGMENT, 3, 0, 1, 1);
    NULLS(froe_surface_new(NULL, NULL, &out, &why));
    NULLS(froe_surface_new(s.tree->scene, NULL, NULL, &why));
    expect(froe_surface_new(plane, NULL, &out, &why), FROE_E_UNSUPPORTED, "not in 2");
    froe_scene_free(plane);
    const uint32_t patches = (uint32_t)froe_surface_patch_count(s.surface),
                   edges = (uint32_t)froe_surface_edge_count(s.surface);
    assert_true(patches == 20 && edges == 60);
    assert_true(froe_surface_patch(s.surface, patches - 1).object_count == 1);
    assert_true(froe_surface_patch(s.surface, patches).object_count == 0);
    assert_true(froe_surface_edge(s.surface, edges - 1).object_count == 1);
    assert_true(froe_surface_edge(s.surface, edges).object_count == 0);
    assert_int_equal(froe_surface_patch_of(s.surface, 19), 19);
    assert_int_equal(froe_surface_patch_of(s.surface, 20), FROE_NONE);
    assert_int_not_equal(froe_surface_edge_of(s.surface, 19, 2), FROE_NONE);
    assert_int_equal(froe_surface_edge_of(s.surface, 19, 3), FROE_NONE);
    assert_int_equal(froe_surface_edge_of(s.surface, 20, 0), FROE_NONE);
    assert_int_equal(froe_surface_wire(s.surface, 0), FROE_NONE);
    assert_int_equal(froe_surface_point(s.surface, 0), FROE_NONE);
    close_stage(&s);
    froe_surface_free(NULL);
}

/* A segment and a point beside a triangle: no edges and no patches of theirs. */
static void wires_and_points_have_numbers(void **state) {
    (void)state;
    static const double triangle[] = {0, 0, 0, 4, 0, 0, 0, 4, 0}, segment[] = {0, 0, 1, 1, 0, 1}, point[] = {2, 2, 2};
    froe_scene *scene;
    froe_surface *surface;
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_SEGMENT, 1, segment, NULL, NULL), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_POINT, 1, point, NULL, NULL), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_POLYGON, 1, triangle, NULL, NULL), FROE_OK);
    assert_int_equal(froe_surface_new(scene, NULL, &surface, NULL), FROE_OK);
    assert_true(froe_surface_wire(surface, 0) == 0 && froe_surface_wire(surface, 1) == FROE_NONE);
    assert_true(froe_surface_point(surface, 0) == 1 && froe_surface_point(surface, 1) == FROE_NONE);
    assert_true(froe_surface_patch_of(surface, 0) == FROE_NONE && froe_surface_patch_of(surface, 2) == 0);
    assert_true(froe_surface_edge_of(surface, 0, 0) == FROE_NONE && froe_surface_edge_of(surface, 2, 0) != FROE_NONE);
    froe_surface_free(surface);
    froe_scene_free(scene);
}

static bool any_region(void *user, uint32_t patch, const double *coords, const size_t *starts, size_t rings) {
    (void)patch, (void)coords, (void)starts, (void)rings;
    ++*(uint32_t *)user;
    return true;
}

static void visibility_is_checked(void **state) {
    (void)state;
    stage s = open_stage();
    froe_tree *leaf = trees_grow(3, FROE_POLYGON, 0, 0, 1, "density", 1);
    froe_surface *of_leaf;
    froe_visibility_options o = froe_visibility_defaults();
    froe_visibility *v;
    double window[3 * (FROE_WINDOW_MOST + 1)] = {0};
    assert_int_equal(froe_surface_new(leaf->scene, NULL, &of_leaf, NULL), FROE_OK);
    o.eye.at[2] = 3;
    NULLS(froe_visibility_new(NULL, s.surface, &o, &v, &why));
    NULLS(froe_visibility_new(s.tree, NULL, &o, &v, &why));
    NULLS(froe_visibility_new(s.tree, s.surface, &o, NULL, &why));
    REFUSED(froe_visibility_new(s.tree, s.surface, NULL, &v, &why), "froe_visibility_defaults");
    expect(froe_visibility_new(s.tree, of_leaf, &o, &v, &why), FROE_E_ARG, "not of the tree's scene");
    o.section = -2;
    REFUSED(froe_visibility_new(s.tree, s.surface, &o, &v, &why), "not -2");
    o.section = 1;
    REFUSED(froe_visibility_new(leaf, of_leaf, &o, &v, &why), "single leaf");
    o.section = 0, o.window = window, o.window_corners = FROE_WINDOW_MOST + 1;
    REFUSED(froe_visibility_new(s.tree, s.surface, &o, &v, &why), "not 65");
    o.window = NULL;
    assert_int_equal(froe_visibility_new(s.tree, s.surface, &o, &v, &why), FROE_OK);

    const size_t pieces = froe_visibility_piece_count(v);
    size_t first = 1, count = 1;
    double corners[9] = {0}, same[9] = {0};
    assert_true(pieces > 0 && froe_visibility_piece(v, pieces - 1).corners >= 3);
    assert_int_equal(froe_visibility_piece(v, pieces).corners, 0);
    assert_int_equal(froe_visibility_corners(v, pieces, corners, 3), 0);
    assert_true(froe_visibility_corners(v, 0, corners, 2) >= 3); /* as many as there is room for */
    assert_memory_equal(corners + 6, same, sizeof *same);
    assert_int_equal(froe_visibility_of_patch(v, 20, &first), 0);
    assert_int_equal(first, 0);
    (void)froe_visibility_of_edge(v, 60, &count), assert_int_equal(count, 0);
    (void)froe_visibility_of_wire(v, 0, &count), assert_int_equal(count, 0);
    assert_false(froe_visibility_of_point(v, 0));

    uint32_t regions = 0, some = 0;
    NULLS(froe_visibility_regions(NULL, 0, 20, any_region, &regions, &why));
    NULLS(froe_visibility_regions(v, 0, 20, NULL, &regions, &why));
    assert_int_equal(froe_visibility_regions(v, 0, 20, any_region, &regions, &why), FROE_OK);
    assert_int_equal(regions, froe_visibility_statistics(v).visible_patches);
    for (uint32_t i = 0; i < 25; i += 5)
        assert_int_equal(froe_visibility_regions(v, i, 5, any_region, &some, &why), FROE_OK);
    assert_int_equal(some, regions); /* in parts, and beyond the end */
    froe_visibility_free(v);
    froe_visibility_free(NULL);
    froe_surface_free(of_leaf);
    froe_tree_free(leaf);
    close_stage(&s);
}

/* ------------------------------------------------------------------- pictures -- */

static void pictures_are_checked(void **state) {
    (void)state;
    stage s = open_stage();
    froe_picture_options o = froe_picture_defaults();
    froe_picture *p;
    NULLS(froe_picture_new(NULL, s.surface, &o, &p, &why));
    NULLS(froe_picture_new(s.tree, NULL, &o, &p, &why));
    NULLS(froe_picture_new(s.tree, s.surface, &o, NULL, &why));
    REFUSED(froe_picture_new(s.tree, s.surface, NULL, &p, &why), "froe_picture_defaults");
    expect(froe_picture_new(s.tree, s.surface, &o, &p, &why), FROE_E_ARG, "no view");
    o.view = &s.view;
    for (int i = -1; i <= FROE_PAINT_COUNT; i += 1 + FROE_PAINT_COUNT) {
        o.paint = (froe_paint)i;
        REFUSED(froe_picture_new(s.tree, s.surface, &o, &p, &why), "no paint");
    }
    static const char *const words[] = {"underlap", "area", "halo", "Lines that reach", "Points that reach", "crease"};
    for (int i = 0; i < 18; i++) {
        o = froe_picture_defaults();
        o.view = &s.view;
        double *const numbers[] = {&o.underlap, &o.min_area, &o.halo, &o.interleave, &o.interleave_points, &o.crease};
        *numbers[i / 3] = (const double[]){-1, NAN, INFINITY}[i % 3];
        REFUSED(froe_picture_new(s.tree, s.surface, &o, &p, &why), words[i / 3]);
    }
    o = froe_picture_defaults(), o.size = 1;
    REFUSED(froe_picture_new(s.tree, s.surface, &o, &p, &why), "froe_picture_defaults");

    o = froe_picture_defaults(), o.view = &s.view, o.lines = FROE_LINE_END - 1;
    assert_int_equal(froe_picture_new(s.tree, s.surface, &o, &p, &why), FROE_OK);
    const size_t shapes = froe_picture_shape_count(p), strokes = froe_picture_stroke_count(p);
    size_t points = 1;
    assert_true(shapes > 0 && strokes > 0);
    assert_true(froe_picture_shape(p, shapes - 1).ring_count > 0 && froe_picture_stroke(p, strokes - 1).count > 0);
    assert_int_equal(froe_picture_shape(p, shapes).ring_count, 0);
    assert_int_equal(froe_picture_stroke(p, strokes).count, 0);
    assert_null(froe_picture_ring(p, 1000, &points));
    assert_int_equal(points, 0);
    froe_picture_free(p);
    froe_picture_free(NULL);
    close_stage(&s);
    assert_string_equal(froe_paint_name(FROE_PAINT_FRAGMENTS), "fragments");
    assert_null(froe_paint_name(FROE_PAINT_COUNT));
    assert_string_equal(froe_line_name(FROE_LINE_POINT), "point");
    assert_null(froe_line_name(FROE_LINE_END));
    assert_null(froe_line_name((froe_line)3));
}

/* A larger scene, whose edges are those of objects that the tree does not have. */
static void a_surface_is_of_the_scene_of_its_tree(void **state) {
    enum { STRIP = 2000 };
    (void)state;
    stage s = open_stage();
    froe_scene *other;
    double x[STRIP * 9];
    for (int i = 0; i < STRIP; i++) /* each shares an edge with the next */
        for (int k = 0; k < 3; k++)
            x[9 * i + 3 * k] = i + k, x[9 * i + 3 * k + 1] = (i + k) % 2, x[9 * i + 3 * k + 2] = (i + k) % 3;
    assert_int_equal(froe_scene_new(3, NULL, &other), FROE_OK);
    assert_int_equal(trees_add(other, FROE_POLYGON, STRIP, x, NULL, NULL), FROE_OK);
    froe_surface *surface;
    froe_picture *p = NULL;
    froe_picture_options o = froe_picture_defaults();
    assert_int_equal(froe_surface_new(other, NULL, &surface, NULL), FROE_OK);
    o.view = &s.view, o.lines = FROE_LINE_END - 1;
    expect(froe_picture_new(s.tree, surface, &o, &p, &why), FROE_E_ARG, "not of the tree's scene");
    assert_null(p);
    froe_surface_free(surface);
    froe_scene_free(other);
    close_stage(&s);
}

/* ------------------------------------------------------------- damaged files -- */

/* Files are checked when something is first asked of all of them. Each call may be that one. */
static void damaged_files_are_noticed_by_every_call(void **state) {
    (void)state;
    tree_file f;
    stage s = open_stage();
    const froe_eye eye = {.at = {1, 2, 3}};
    const froe_camera camera = froe_camera_defaults();
    froe_visibility_options look = froe_visibility_defaults();
    froe_picture_options paint = froe_picture_defaults();
    uint32_t pieces[2000];
    froe_tree *tree = tree_file_damaged(trees_grow(3, FROE_POLYGON, 20, 0, 1, "density", 1), &f);
    froe_surface *surface;
    froe_camera cameras[2];
    paint.view = &s.view;
    DAMAGED(froe_camera_place(&camera, tree->scene, &s.view, &why));
    froe_tree_free(tree);
    for (int i = 0; i < 5; i++) {
        assert_int_equal(froe_tree_open_memory(f.bytes, f.size, NULL, &tree, NULL), FROE_OK);
        if (i == 0) DAMAGED(froe_tree_order(tree, &eye, NULL, any_piece, NULL, &why));
        if (i == 1) DAMAGED(froe_tree_order_nodes(tree, &eye, NULL, any_node, NULL, &why));
        if (i == 2) DAMAGED(froe_tree_orders(tree, &eye, 1, NULL, pieces, &why));
        if (i == 3) DAMAGED(froe_surface_new(tree->scene, NULL, &surface, &why));
        if (i == 4) DAMAGED(froe_camera_turn(&camera, tree->scene, 2, cameras, &why));
        froe_tree_free(tree);
    }
    free(f.bytes);

    f = tree_file_of(trees_grow(3, FROE_POLYGON, 20, 0, 1, "density", 1));
    *(uint8_t *)tree_file_at(&f, FILE_PIECES) ^= 1; /* the scene is right, and the tree is not */
    for (int i = 0; i < 2; i++) {
        assert_int_equal(froe_tree_open_memory(f.bytes, f.size, NULL, &tree, NULL), FROE_OK);
        assert_int_equal(froe_surface_new(tree->scene, NULL, &surface, &why), FROE_OK);
        froe_visibility *v;
        froe_picture *p;
        if (i == 0) DAMAGED(froe_visibility_new(tree, surface, &look, &v, &why));
        if (i == 1) DAMAGED(froe_picture_new(tree, surface, &paint, &p, &why));
        froe_surface_free(surface);
        froe_tree_free(tree);
    }
    free(f.bytes);
    close_stage(&s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cameras_are_checked),
        cmocka_unit_test(what_points_at_the_eye_is_before_it),
        cmocka_unit_test(scenes_beyond_doubles_have_no_camera),
        cmocka_unit_test(turntables_are_checked),
        cmocka_unit_test(orders_are_checked),
        cmocka_unit_test(surfaces_are_checked),
        cmocka_unit_test(wires_and_points_have_numbers),
        cmocka_unit_test(visibility_is_checked),
        cmocka_unit_test(pictures_are_checked),
        cmocka_unit_test(a_surface_is_of_the_scene_of_its_tree),
        cmocka_unit_test(damaged_files_are_noticed_by_every_call),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
