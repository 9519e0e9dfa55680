/* test_wires.c: segments and points among polygons, against exact rays.
 *
 * A point, also one of a segment, is hidden if and only if a polygon lies between it and the eye, border included, that
 * is not seen edge-on: the oracle asks every polygon, in rationals. Intervals leave out what is hidden at single
 * points, where a corner touches the line of sight. So points of segments are asked for within intervals and gaps, at
 * places that no lattice has; points of the scene are asked for anywhere. */
#include "rays.h"
#include "support/sanitized.h"
#include "view/visibility/visibility.h"
#include <math.h>

typedef struct stage {
    const froe_tree *tree;
    froe_surface *surface;
    froe_visibility *v;
    froe_eye eye;
    const uint8_t *ignored; /* per object, not 0: hides nothing */
    rational_point from, to;
    uint64_t visible, hidden, dots_visible, dots_hidden;
} stage;

static void open_stage(stage *s, const froe_tree *tree) {
    *s = (stage){.tree = tree};
    assert_int_equal(froe_surface_new(tree->scene, NULL, &s->surface, NULL), FROE_OK);
    rational_point_init(&s->from);
    rational_point_init(&s->to);
}

static void close_stage(stage *s) {
    froe_surface_free(s->surface);
    rational_point_clear(&s->from);
    rational_point_clear(&s->to);
}

/* Does a polygon lie between the eye and s->to? */
static bool blocked(stage *s) {
    const froe_scene *scene = s->tree->scene;
    bool found = false;
    mpq_t t;
    rational_point x;
    mpq_init(t);
    rational_point_init(&x);
    for (uint32_t o = 0; o < scene->object_count && !found; o++) {
        if ((s->ignored && s->ignored[o]) || rays_meet(scene, &s->from, &s->to, o, t, &x) < 0) continue;
        found = s->eye.parallel ? mpq_sgn(t) < 0 : mpq_cmp_ui(t, 1, 1) < 0;
    }
    mpq_clear(t);
    rational_point_clear(&x);
    return found;
}

static void check_share(stage *s, uint32_t wire, double t, bool visible) {
    const uint32_t object = froe_surface_wire(s->surface, wire);
    const double *u = scene_point(s->tree->scene, object, 0), *v = scene_point(s->tree->scene, object, 1);
    rational_point_between(&s->to, 3, u, v, t);
    if (blocked(s) == visible)
        fail_msg("segment %u at %.17g should be %s; eye %s(%g, %g, %g)", object, t, visible ? "hidden" : "visible",
                 s->eye.parallel ? "along " : "", s->eye.at[0], s->eye.at[1], s->eye.at[2]);
    ++*(visible ? &s->visible : &s->hidden);
}

/* Near the middle and both ends of every interval and gap that is no rounding error wide. */
static void check_wire(stage *s, uint32_t wire) {
    size_t count;
    const froe_interval *x = froe_visibility_of_wire(s->v, wire, &count);
    const double places[] = {0.48713, 0.00137, 0.99871};
    double last = 0;
    for (size_t i = 0; i <= count; i++) {
        const double from = i < count ? x[i].from : 1, to = i < count ? x[i].to : 1;
        assert_true(last <= from && from <= to && to <= 1);
        for (int k = 0; k < 3; k++) {
            if (from - last > 1e-9) check_share(s, wire, last + places[k] * (from - last), false);
            if (to - from > 1e-9) check_share(s, wire, from + places[k] * (to - from), true);
        }
        last = to;
    }
}

/* Is a segment, or a point, seen as nothing? */
static bool is_void(const stage *s, const double *u, const double *v) {
    const geom_eye eye = geom_eye_make(s->eye.parallel, s->eye.at, NULL);
    rational_point p, q;
    mpq_t cross[3];
    bool none = true;
    rational_point_init(&p), rational_point_init(&q);
    rational_point_set(&p, 3, u), rational_point_set(&q, 3, v);
    for (int k = 0; k < 3; k++) mpq_init(cross[k]);
    for (int k = 0; k < 3; k++) { /* the directions to both, or along it and to the eye */
        mpq_t e;
        mpq_init(e);
        mpq_set_d(e, eye.at[k]);
        if (eye.parallel) {
            mpq_sub(q.x[k], q.x[k], p.x[k]);
            mpq_set(p.x[k], e);
        } else {
            mpq_sub(p.x[k], p.x[k], e);
            mpq_sub(q.x[k], q.x[k], e);
        }
        mpq_clear(e);
    }
    rational_cross(cross, p.x, q.x);
    for (int k = 0; k < 3; k++) none = none && !mpq_sgn(cross[k]);
    for (int k = 0; k < 3; k++) mpq_clear(cross[k]);
    rational_point_clear(&p), rational_point_clear(&q);
    return none;
}

static void check_all(stage *s) {
    const froe_scene *scene = s->tree->scene;
    for (uint32_t w = 0; w < s->surface->wire_count; w++) {
        const uint32_t object = s->surface->wires[w];
        size_t count;
        if (!is_void(s, scene_point(scene, object, 0), scene_point(scene, object, 1))) {
            check_wire(s, w);
            continue;
        }
        froe_visibility_of_wire(s->v, w, &count);
        assert_int_equal(count, 0);
    }
    for (uint32_t p = 0; p < s->surface->point_count; p++) {
        const uint32_t object = s->surface->points[p];
        const double *x = scene_point(scene, object, 0);
        const bool seen = froe_visibility_of_point(s->v, p);
        bool at_eye = !s->eye.parallel;
        for (int k = 0; k < 3; k++) at_eye = at_eye && x[k] == s->eye.at[k];
        rational_point_set(&s->to, 3, x);
        if (seen == (at_eye || blocked(s)))
            fail_msg("point %u (%g, %g, %g) should be %s; eye %s(%g, %g, %g)", object, x[0], x[1], x[2],
                     seen ? "hidden" : "visible", s->eye.parallel ? "along " : "", s->eye.at[0], s->eye.at[1],
                     s->eye.at[2]);
        ++*(seen ? &s->dots_visible : &s->dots_hidden);
    }
}

static void look_from(stage *s, froe_eye eye, froe_visibility_options o) {
    froe_diagnostic why = {.message = ""};
    s->eye = o.eye = eye;
    rational_point_set(&s->from, 3, eye.at);
    if (eye.parallel) mpq_set_ui(s->from.w, 0, 1);
    if (froe_visibility_new(s->tree, s->surface, &o, &s->v, &why)) fail_msg("%s", why.message);
}

static void check_eyes(froe_tree *tree, uint32_t eyes) {
    stage s;
    open_stage(&s, tree);
    for (uint32_t e = 0; e < eyes; e++) {
        look_from(&s, rays_eye(tree, e), froe_visibility_defaults());
        check_all(&s);
        const froe_visibility_report r = froe_visibility_statistics(s.v);
        assert_int_equal(r.segments + r.visible_segments, s.surface->wire_count);
        assert_int_equal(r.points + r.visible_points, s.surface->point_count);
        froe_visibility_free(s.v);
    }
    print_message("  %u objects: %d and %d places of segments, %d and %d points visible and hidden\n",
                  tree->scene->object_count, (int)s.visible, (int)s.hidden, (int)s.dots_visible, (int)s.dots_hidden);
    assert_true(s.visible > 50 && s.dots_visible > 10);
    if (tree->scene->object_count > s.surface->wire_count + s.surface->point_count)
        assert_true(s.hidden > 50 && s.dots_hidden > 10);
    close_stage(&s);
    froe_tree_free(tree);
}

/* ---------------------------------------------------------------------- scenes -- */

static froe_tree *mixed(size_t faces, size_t wires, size_t dots, uint32_t grid, double size, const char *method) {
    froe_scene *scene = trees_scene(3, FROE_SEGMENT, wires, grid, 2 * size, 5);
    assert_int_equal(trees_scatter(scene, FROE_POLYGON, faces, grid, size, 6), FROE_OK);
    assert_int_equal(trees_scatter(scene, FROE_POINT, dots, grid, size, 7), FROE_OK);
    froe_tree *tree = trees_build(scene, method, 1);
    froe_scene_free(scene);
    return tree;
}

static void random_scenes(void **state) {
    (void)state;
    check_eyes(mixed(30, 25, 30, 0, 1, "density"), 5);
    check_eyes(mixed(40, 25, 40, 0, 0.5, "grain"), 5);
}

/* Each kind of eye, or under sanitizers each other one. */
enum { EYES = 10 / SANITIZED_SHARE(2) };

static void scenes_on_a_lattice(void **state) {
    (void)state;
    check_eyes(mixed(40, 30, 40, 3, 2, "density"), EYES);
    check_eyes(mixed(30, 30, 40, 2, 2, "grain"), EYES);
    check_eyes(mixed(40, 30, 40, 4, 2, "autopartition"), EYES);
}

static void scenes_without_polygons_on_any_tree(void **state) {
    (void)state;
    check_eyes(mixed(0, 40, 40, 3, 2, "density"), 5);
    check_eyes(mixed(0, 40, 40, 0, 1, "index"), 5);
}

/* Boxes on a lattice, whose edges are segments of the scene as well, as are diagonals of faces and of the boxes. From
 * along an axis all are behind each other. */
static void boxes_with_their_edges_and_diagonals(void **state) {
    (void)state;
    static const int face[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    const size_t starts[2] = {0, 4};
    froe_scene *scene;
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    for (uint32_t b = 0; b < 8; b++) {
        double corner[8][3], coords[12];
        for (int i = 0; i < 8; i++)
            for (uint32_t k = 0; k < 3; k++)
                corner[i][k] = trees_random(b, 2 * k, 4) + (i >> k & 1) * (1.0 + trees_random(b, 2 * k + 1, 3));
        for (int f = 0; f < 6; f++) {
            for (int i = 0; i < 4; i++) memcpy(coords + 3 * i, corner[face[f][i]], sizeof corner[0]);
            assert_int_equal(trees_add(scene, FROE_POLYGON, 1, coords, NULL, starts), FROE_OK);
        }
        for (int i = 0; i < 8; i++)
            for (int j = i + 1; j < 8; j++) {
                memcpy(coords, corner[i], sizeof corner[0]);
                memcpy(coords + 3, corner[j], sizeof corner[0]);
                assert_int_equal(trees_add(scene, FROE_SEGMENT, 1, coords, NULL, NULL), FROE_OK);
            }
        for (int i = 0; i < 8; i++) assert_int_equal(trees_add(scene, FROE_POINT, 1, corner[i], NULL, NULL), FROE_OK);
    }
    check_eyes(trees_build(scene, "density", 1), 5);
    froe_tree *tree = trees_build(scene, "grain", 1);
    stage s;
    open_stage(&s, tree);
    for (int axis = 0; axis < 3; axis++)
        for (int side = -1; side < 2; side += 2) {
            froe_eye eye = {.parallel = true};
            eye.at[axis] = side;
            look_from(&s, eye, froe_visibility_defaults());
            check_all(&s);
            froe_visibility_free(s.v);
        }
    close_stage(&s);
    froe_tree_free(tree);
    froe_scene_free(scene);
}

/* ----------------------------------------------------------------------- rules -- */

/* A square, x and y from 0 to 4, in the plane z = 0, after `count` segments; seen from far above or below. */
static void expect(const double *segments, size_t count, double below, const double (*expected)[2]) {
    const double square[12] = {0, 0, 0, 4, 0, 0, 4, 4, 0, 0, 4, 0};
    const size_t starts[2] = {0, 4};
    froe_scene *scene;
    stage s;
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_SEGMENT, count, segments, NULL, NULL), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_POLYGON, 1, square, NULL, starts), FROE_OK);
    froe_tree *tree = trees_build(scene, "density", 1);
    froe_scene_free(scene);
    open_stage(&s, tree);
    look_from(&s, (froe_eye){.at = {0, 0, below != 0 ? -1 : 1}, .parallel = true}, froe_visibility_defaults());
    for (uint32_t i = 0; i < count; i++) {
        size_t n;
        const froe_interval *x = froe_visibility_of_wire(s.v, i, &n);
        assert_int_equal(n, expected[i][0] < expected[i][1]);
        for (size_t k = 0; k < n; k++) {
            assert_true(x[k].from == expected[i][0]);
            assert_true(x[k].to == expected[i][1]);
        }
    }
    froe_visibility_free(s.v);
    close_stage(&s);
    froe_tree_free(tree);
}

static void what_lies_in_a_face_is_seen_from_both_sides(void **state) {
    (void)state;
    const double segments[] = {1,  1, 0, 3, 2, 0,  /* within */
                               -2, 2, 0, 6, 2, 0,  /* from beyond to beyond */
                               0,  0, 0, 4, 0, 0,  /* along an edge */
                               -1, 4, 0, 5, 4, 0}; /* along it and further */
    const double all[4][2] = {{0, 1}, {0, 1}, {0, 1}, {0, 1}};
    expect(segments, 4, 0, all);
    expect(segments, 4, 1, all);
}

static void what_passes_through_a_face_is_hidden_from_there_on(void **state) {
    (void)state;
    const double segments[] = {1, 1, 1,  3, 2, -1,  /* in its middle */
                               1, 1, -3, 3, 1, 1,   /* from behind */
                               1, 1, 2,  3, 1, 0,   /* ends on it */
                               2, 0, 1,  2, 2, -1}; /* through a side of other faces, here of none */
    const double above[4][2] = {{0, 0.5}, {0.75, 1}, {0, 1}, {0, 0.5}};
    const double below[4][2] = {{0.5, 1}, {0, 0.75}, {1, 0}, {0.5, 1}};
    expect(segments, 4, 0, above);
    expect(segments, 4, 1, below);
}

static void a_border_hides_what_runs_exactly_behind_it(void **state) {
    (void)state;
    const double segments[] = {0,  1, -1, 0, 3, -1,  /* behind its left edge */
                               4,  1, 1,  4, 3, 1,   /* before its right edge */
                               -1, 0, -1, 1, 0, -1}; /* the first half is beyond the lower edge */
    const double above[3][2] = {{1, 0}, {0, 1}, {0, 0.5}};
    expect(segments, 3, 0, above);
}

static void what_is_seen_as_a_point_is_not_seen(void **state) {
    (void)state;
    const double segments[] = {1, 1, 1, 1, 1, 2, 6, 6, -3, 6, 6, 3};
    const double none[2][2] = {{1, 0}, {1, 0}};
    expect(segments, 2, 0, none);
}

/* Three pages meet in a spine, two of them towards the eye: all hold the segment along it. */
static void the_spine_of_a_book_is_seen_whatever_the_tree(void **state) {
    (void)state;
    const double pages[] = {0, 0, 0, 4, 0, 0, 4, 3, 2,  0, 3, 2,  0,  0,  0,  4, 0,  0,  4, -3, 2,  0,  -3, 2,
                            0, 0, 0, 4, 0, 0, 4, 0, -3, 0, 0, -3, -1, -4, -1, 5, -4, -1, 5, 4,  -1, -1, 4,  -1};
    const double spine[] = {0, 0, 0, 4, 0, 0};
    const size_t starts[] = {0, 4, 8, 12, 16};
    for (uint32_t seed = 0; seed < 6; seed++) {
        froe_scene *scene;
        stage s;
        size_t n;
        assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
        assert_int_equal(trees_add(scene, FROE_POLYGON, 4, pages, NULL, starts), FROE_OK);
        assert_int_equal(trees_add(scene, FROE_SEGMENT, 1, spine, NULL, NULL), FROE_OK);
        froe_build_options o = froe_build_defaults();
        o.method = seed % 2 ? "autopartition" : "density";
        o.seed = seed;
        froe_tree *tree;
        assert_int_equal(froe_build(scene, &o, &tree, NULL), FROE_OK);
        froe_scene_free(scene);
        open_stage(&s, tree);
        look_from(&s, (froe_eye){.at = {2.5, 0.25, 9}}, froe_visibility_defaults());
        const froe_interval *x = froe_visibility_of_wire(s.v, 0, &n);
        assert_int_equal(n, 1);
        assert_true(x->from == 0 && x->to == 1);
        check_all(&s);
        froe_visibility_free(s.v);
        close_stage(&s);
        froe_tree_free(tree);
    }
}

static void an_eye_at_a_point_or_in_a_segment_does_not_see_it(void **state) {
    (void)state;
    froe_tree *tree = mixed(40, 40, 40, 3, 2, "density");
    stage s;
    open_stage(&s, tree);
    for (uint32_t i = 0; i < 10; i++) {
        const double *u = scene_point(tree->scene, i, 0), *v = scene_point(tree->scene, i, 1);
        froe_eye eye = {.parallel = false};
        for (int k = 0; k < 3; k++) eye.at[k] = i % 2 ? u[k] : 0.5 * (u[k] + v[k]); /* exact on the lattice */
        look_from(&s, eye, froe_visibility_defaults());
        check_all(&s);
        froe_visibility_free(s.v);
    }
    for (uint32_t i = 0; i < s.surface->point_count; i += 10) {
        const double *x = scene_point(tree->scene, s.surface->points[i], 0);
        look_from(&s, (froe_eye){.at = {x[0], x[1], x[2]}}, froe_visibility_defaults());
        assert_false(froe_visibility_of_point(s.v, i));
        check_all(&s);
        froe_visibility_free(s.v);
    }
    close_stage(&s);
    froe_tree_free(tree);
}

static void clear_and_culled_polygons_hide_nothing(void **state) {
    (void)state;
    froe_tree *tree = mixed(50, 50, 50, 3, 2, "density");
    stage s;
    open_stage(&s, tree);
    uint8_t *ignored = calloc(tree->scene->object_count, 1), *clear = calloc(s.surface->patch_count + 1, 1);
    for (int way = 0; way < 2; way++)
        for (uint32_t e = 0; e < 5; e++) {
            froe_visibility_options o = froe_visibility_defaults();
            const froe_eye eye = rays_eye(tree, e);
            const geom_eye from = geom_eye_make(eye.parallel, eye.at, NULL);
            num_context context;
            assert_int_equal(num_context_new(&tree->alloc, &context), FROE_OK);
            o.cull_back = way == 0;
            if (way) o.clear = clear;
            for (uint32_t i = 0; i < tree->scene->object_count; i++) {
                const uint32_t patch = s.surface->patch_of[i];
                if (patch == FROE_NONE) continue;
                geom_plane plane;
                scene_support(tree->scene, i, &plane);
                clear[patch] = trees_random(e, patch, 2) > 0;
                ignored[i] = way ? clear[patch] : geom_side_of_eye(&context, &plane, &from) < 0;
            }
            s.ignored = ignored;
            look_from(&s, eye, o);
            check_all(&s);
            froe_visibility_free(s.v);
            num_context_free(&context);
        }
    assert_true(s.hidden > 50 && s.visible > 50);
    free(ignored), free(clear);
    close_stage(&s);
    froe_tree_free(tree);
}

/* Sections through lattice points: what lies in them stays; behind them all is as in a scene without the rest. */
static void a_section_takes_away_what_is_before_it(void **state) {
    (void)state;
    froe_tree *whole = mixed(0, 60, 60, 3, 2, "density");
    const double plane[4] = {1, 1, 0, 3};
    froe_tree *tree;
    stage s;
    uint64_t kept = 0, cut = 0;
    assert_int_equal(froe_tree_section(whole, plane, NULL, &tree, NULL), FROE_OK);
    open_stage(&s, tree);
    froe_visibility_options o = froe_visibility_defaults();
    o.section = -1;
    look_from(&s, (froe_eye){.at = {0.3, 0.2, 1}, .parallel = true}, o);
    for (uint32_t w = 0; w < s.surface->wire_count; w++) {
        const double *u = scene_point(tree->scene, s.surface->wires[w], 0),
                     *v = scene_point(tree->scene, s.surface->wires[w], 1);
        const double a = u[0] + u[1] - 3, b = v[0] + v[1] - 3; /* exact */
        size_t n;
        const froe_interval *x = froe_visibility_of_wire(s.v, w, &n);
        if (is_void(&s, u, v)) continue;
        if ((a > 0 && b >= 0) || (a >= 0 && b > 0)) {
            assert_int_equal(n, 0);
            continue;
        }
        assert_int_equal(n, 1);
        assert_true(fabs(x->from - (a > 0 ? a / (a - b) : 0)) < 1e-15);
        assert_true(fabs(x->to - (b > 0 ? a / (a - b) : 1)) < 1e-15);
        ++*(a > 0 || b > 0 ? &cut : &kept);
    }
    for (uint32_t p = 0; p < s.surface->point_count; p++) {
        const double *x = scene_point(tree->scene, s.surface->points[p], 0);
        assert_int_equal(froe_visibility_of_point(s.v, p), x[0] + x[1] <= 3);
    }
    assert_true(kept > 5 && cut > 5);
    froe_visibility_free(s.v);
    close_stage(&s);
    froe_tree_free(tree);
    froe_tree_free(whole);
}

static void a_window_cuts_segments(void **state) {
    (void)state;
    const double segments[] = {-2, 1, 0, 6, 1, 0, 9, 9, 0, 12, 9, 0}, dots[] = {1, 1, 0, 9, 1, 0};
    const double window[12] = {0, 0, 3, 4, 0, 3, 4, 4, 3, 0, 4, 3};
    froe_scene *scene;
    stage s;
    size_t n;
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_SEGMENT, 2, segments, NULL, NULL), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_POINT, 2, dots, NULL, NULL), FROE_OK);
    froe_tree *tree = trees_build(scene, "density", 1);
    froe_scene_free(scene);
    open_stage(&s, tree);
    froe_visibility_options o = froe_visibility_defaults();
    o.window = window, o.window_corners = 4;
    look_from(&s, (froe_eye){.at = {0, 0, 1}, .parallel = true}, o);
    const froe_interval *x = froe_visibility_of_wire(s.v, 0, &n);
    assert_int_equal(n, 1);
    assert_true(x->from == 0.25 && x->to == 0.75);
    froe_visibility_of_wire(s.v, 1, &n);
    assert_int_equal(n, 0);
    assert_true(froe_visibility_of_point(s.v, 0) && !froe_visibility_of_point(s.v, 1));
    froe_visibility_free(s.v);
    o.faces_only = true;
    look_from(&s, (froe_eye){.at = {0, 0, 1}, .parallel = true}, o);
    froe_visibility_of_wire(s.v, 0, &n);
    assert_true(n == 0 && !froe_visibility_of_point(s.v, 0));
    froe_visibility_free(s.v);
    close_stage(&s);
    froe_tree_free(tree);
}

/* A comb of upright slats, seen from beside, and wires of each direction behind all of it, across it and through it:
 * many parts of one wire are on their way at once. So are points, which lie anywhere. */
static froe_tree *comb(uint32_t slats, uint32_t wires, uint32_t dots) {
    froe_scene *scene;
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    for (uint32_t i = 0; i < slats; i++) {
        const double x = 2 * i, slat[] = {x, 0, -9, x + 1, 0.01 * i, -9, x + 0.5, 0, 9};
        assert_int_equal(trees_add(scene, FROE_POLYGON, 1, slat, NULL, NULL), FROE_OK);
    }
    for (uint32_t i = 0; i < wires; i++) {
        const double z = 5 * trees_unit(4, i), far = i % 3 ? 3 : -2, end = 2 * slats;
        const double wire[] = {i % 2 ? -1 : end, far, z, i % 2 ? end : -1, 3, z - 0.1 * i};
        assert_int_equal(trees_add(scene, FROE_SEGMENT, 1, wire, NULL, NULL), FROE_OK);
    }
    for (uint32_t i = 0; i < dots; i++) {
        const double dot[] = {2 * slats * trees_unit(5, 3 * i), 5, 18 * trees_unit(5, 3 * i + 1) - 9};
        assert_int_equal(trees_add(scene, FROE_POINT, 1, dot, NULL, NULL), FROE_OK);
    }
    froe_tree *tree = trees_build(scene, "density", 1);
    froe_scene_free(scene);
    return tree;
}

typedef struct look_again {
    const froe_tree *tree;
    froe_visibility_options options;
    size_t intervals, points; /* that are visible, with memory */
    unsigned calls, stop;     /* of progress: the one that cancels; 0: none */
} look_again;

static froe_status look_with(void *user, const froe_allocator *alloc) {
    look_again *l = user;
    froe_surface *surface = NULL;
    froe_visibility *v = NULL;
    size_t intervals = 0, points = 0, n;
    l->options.alloc = alloc;
    froe_status status = froe_surface_new(l->tree->scene, alloc, &surface, NULL);
    if (!status) status = froe_visibility_new(l->tree, surface, &l->options, &v, NULL);
    if (!status) {
        for (uint32_t i = 0; i < surface->wire_count; i++) (void)froe_visibility_of_wire(v, i, &n), intervals += n;
        for (uint32_t i = 0; i < surface->point_count; i++) points += froe_visibility_of_point(v, i);
        if (!l->intervals) l->intervals = intervals, l->points = points; /* the first time */
        assert_true(intervals == l->intervals && points == l->points);
    }
    froe_visibility_free(v);
    froe_surface_free(surface);
    return status;
}

static froe_tree *section_of(froe_tree *tree, const double *plane) {
    froe_tree *out;
    assert_int_equal(froe_tree_section(tree, plane, NULL, &out, NULL), FROE_OK);
    froe_tree_free(tree);
    return out;
}

/* Also where a section cuts wires: each needs two lines, so that with one wire more other ones are refused. */
static void every_allocation_may_fail(void **state) {
    static const double across[] = {1, 0.1, 0.2, 20.3}, amid[] = {1, 1, 1, 3};
    (void)state;
    const struct {
        froe_tree *tree;
        int section;
        froe_eye eye;
    } cases[] = {{mixed(20, 30, 20, 3, 2, "density"), 0, {{0, 0, 1}, true}},
                 {mixed(30, 10, 300, 2, 2, "density"), 0, {{0, 0, 1}, true}},
                 {comb(40, 30, 500), 0, {{0, -1, 0}, true}},
                 {comb(20, 21, 10), 0, {{15, -60, 1}, false}},
                 {section_of(comb(15, 60, 0), across), 1, {{0, -1, 0.1}, true}},
                 {section_of(comb(16, 60, 0), across), 1, {{0, -1, 0.1}, true}},
                 {section_of(mixed(0, 41, 40, 3, 2, "density"), amid), -1, {{0.3, 0.2, 1}, true}}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        look_again l = {.tree = cases[i].tree, .options = froe_visibility_defaults()};
        l.options.eye = cases[i].eye;
        l.options.section = cases[i].section;
        assert_true(test_memory_each(look_with, &l) > 20);
        assert_true(l.intervals > 5);
        froe_tree_free(cases[i].tree);
    }
}

static bool go_on(void *user, double done) {
    look_again *l = user;
    assert_true(done >= 0 && done <= 1);
    return ++l->calls != l->stop;
}

/* Wires, and points, are looked at in turn; each may be the last. */
static void looking_at_wires_can_be_cancelled(void **state) {
    (void)state;
    froe_tree *tree = mixed(20, 30, 40, 0, 1, "density");
    look_again l = {.tree = tree, .options = froe_visibility_defaults()};
    l.options.eye.at[2] = 3;
    l.options.progress = go_on, l.options.user = &l;
    assert_int_equal(look_with(&l, NULL), FROE_OK);
    const unsigned calls = l.calls;
    assert_true(calls > 1);
    for (l.stop = 1; l.stop <= calls; l.stop++) {
        l.calls = 0;
        assert_int_equal(look_with(&l, NULL), FROE_E_CANCELLED);
        assert_int_equal(l.calls, l.stop);
    }
    froe_tree_free(tree);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_scenes),
        cmocka_unit_test(scenes_on_a_lattice),
        cmocka_unit_test(scenes_without_polygons_on_any_tree),
        cmocka_unit_test(boxes_with_their_edges_and_diagonals),
        cmocka_unit_test(what_lies_in_a_face_is_seen_from_both_sides),
        cmocka_unit_test(what_passes_through_a_face_is_hidden_from_there_on),
        cmocka_unit_test(a_border_hides_what_runs_exactly_behind_it),
        cmocka_unit_test(what_is_seen_as_a_point_is_not_seen),
        cmocka_unit_test(the_spine_of_a_book_is_seen_whatever_the_tree),
        cmocka_unit_test(an_eye_at_a_point_or_in_a_segment_does_not_see_it),
        cmocka_unit_test(clear_and_culled_polygons_hide_nothing),
        cmocka_unit_test(a_section_takes_away_what_is_before_it),
        cmocka_unit_test(a_window_cuts_segments),
        cmocka_unit_test(every_allocation_may_fail),
        cmocka_unit_test(looking_at_wires_can_be_cancelled),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
