/* test_crossings.c: lines along which triangles pass through each other, against each pair of triangles by itself. */
#include "rays.h"
#include <math.h>

typedef double point[3];

static void sub(const double *a, const double *b, double *out) {
    for (int k = 0; k < 3; k++) out[k] = a[k] - b[k];
}

static double dot(const double *a, const double *b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double *a, const double *b, double *out) {
    for (int k = 0; k < 3; k++) out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

static void normal_of(const froe_scene *s, uint32_t object, double *n) {
    point u, v;
    sub(scene_point(s, object, 1), scene_point(s, object, 0), u);
    sub(scene_point(s, object, 2), scene_point(s, object, 0), v);
    cross(u, v, n);
}

/* How far inside a triangle a point of its plane is, in shares: negative outside. */
static double inside(const froe_scene *s, uint32_t object, const double *x) {
    point n, u, v, w;
    double least = 1;
    normal_of(s, object, n);
    for (uint32_t i = 0; i < 3; i++) {
        sub(scene_point(s, object, (i + 1) % 3), scene_point(s, object, i), u);
        sub(x, scene_point(s, object, i), v);
        cross(u, v, w);
        least = fmin(least, dot(w, n) / dot(n, n));
    }
    return least;
}

/* Appends where edges of a pierce b. */
static int pierce(const froe_scene *s, uint32_t a, uint32_t b, point *out, int count) {
    point n, u;
    normal_of(s, b, n);
    for (uint32_t i = 0; i < 3; i++) {
        const double *p = scene_point(s, a, i), *q = scene_point(s, a, (i + 1) % 3), *o = scene_point(s, b, 0);
        sub(p, o, u);
        const double at_p = dot(n, u);
        sub(q, o, u);
        const double at_q = dot(n, u);
        if ((at_p > 0) == (at_q > 0)) continue;
        for (int k = 0; k < 3; k++) out[count][k] = p[k] + at_p / (at_p - at_q) * (q[k] - p[k]);
        if (inside(s, b, out[count]) > 0) count++;
    }
    return count;
}

static bool is_edge_on(const froe_scene *s, const froe_eye *eye, uint32_t object) {
    point n, u;
    normal_of(s, object, n);
    sub(eye->at, scene_point(s, object, 0), u);
    return fabs(dot(n, eye->parallel ? eye->at : u)) < 1e-12;
}

/* How one looks at a tree. */
typedef struct looking {
    froe_eye eye;
    bool hidden, cull_back;
    int section; /* the side of the plane that is there: of `plane`, by its sign */
    const double *plane;
    const double *window; /* of four corners; NULL: none */
} looking;

/* How far inside the window the eye sees a point, in lengths of its sides: negative outside; without a window, 1. */
static double inside_window(const looking *l, const double *x) {
    double least = 1;
    for (int i = 0; i < 4 && l->window; i++) {
        const double *a = l->window + 3 * i, *b = l->window + (i + 1) % 4 * 3, *far = l->window + (i + 2) % 4 * 3;
        point u, way, n, to_far, to_x;
        sub(b, a, u);
        for (int k = 0; k < 3; k++) way[k] = l->eye.parallel ? l->eye.at[k] : l->eye.at[k] - a[k];
        cross(u, way, n);
        sub(far, a, to_far);
        sub(x, a, to_x);
        least = fmin(least, dot(n, to_x) / dot(n, to_far));
    }
    return least;
}

/* A square amid the scene across the line of sight. */
static void set_window(const froe_scene *s, const froe_eye *eye, double size, const double shift[2], double out[12]) {
    point middle, n, u, v;
    for (int k = 0; k < 3; k++) {
        middle[k] = 0.5 * (s->lo[k] + s->hi[k]);
        n[k] = eye->parallel ? eye->at[k] : eye->at[k] - middle[k];
    }
    cross(n, (const double[]){0.3, 0.9, 0.1}, u);
    cross(n, u, v);
    for (int i = 0; i < 12; i++) {
        const double a = shift[0] + (i / 3 % 3 ? size : -size), b = shift[1] + (i / 6 ? size : -size);
        out[i] = middle[i % 3] + a * u[i % 3] / sqrt(dot(u, u)) + b * v[i % 3] / sqrt(dot(v, v));
    }
}

/* How far a point is on the side of the section that is there, in lengths of its normal; without a section, 1. */
static double beside_section(const looking *l, const double *x) {
    return l->section ? l->section * (dot(l->plane, x) - l->plane[3]) / sqrt(dot(l->plane, l->plane)) : 1;
}

/* Segments and points, and polygons that are edge-on, cross nothing. */
static bool may_cross(const froe_scene *s, const looking *l, uint32_t object) {
    return scene_corners(s, object) > 2 && !is_edge_on(s, &l->eye, object);
}

/* Nor do those that are culled: they are not there. */
static bool is_shown(const froe_scene *s, const looking *l, uint32_t object) {
    point n, u;
    if (!may_cross(s, l, object)) return false;
    normal_of(s, object, n);
    sub(l->eye.at, scene_point(s, object, 0), u);
    return !l->cull_back || dot(n, l->eye.parallel ? l->eye.at : u) > 0;
}

/* Is a point before everything but two triangles? 1, 0, or -1: too close to call. */
static int in_sight(const froe_scene *s, const looking *l, const double *x, uint32_t a, uint32_t b) {
    const froe_eye *eye = &l->eye;
    int seen = 1;
    for (uint32_t o = 0; o < s->object_count; o++) {
        point n, way, u, hit;
        if (o == a || o == b || !is_shown(s, l, o)) continue;
        normal_of(s, o, n);
        for (int k = 0; k < 3; k++) way[k] = eye->parallel ? eye->at[k] : eye->at[k] - x[k];
        sub(scene_point(s, o, 0), x, u);
        const double t = dot(n, u) / dot(n, way);
        for (int k = 0; k < 3; k++) hit[k] = x[k] + t * way[k];
        const double depth = fmin(inside(s, o, hit), beside_section(l, hit));
        if (t < -1e-6 || (!eye->parallel && t > 1 + 1e-6) || depth < -1e-6) continue;
        if (t < 1e-6 || depth < 1e-6) return -1;
        seen = 0;
    }
    return seen;
}

static bool is_found(const froe_visibility *v, const double *x, bool section, bool hidden) {
    size_t count;
    const froe_crossing *c = froe_visibility_crossings(v, &count);
    for (size_t i = 0; i < count; i++) {
        point u, w;
        if (c[i].hidden != hidden || c[i].section != section) continue;
        sub(c[i].to, c[i].from, u);
        sub(x, c[i].from, w);
        const double t = dot(w, u) / dot(u, u);
        if (!(t > -1e-9 && t < 1 + 1e-9)) continue;
        for (int k = 0; k < 3; k++) w[k] -= t * u[k];
        if (dot(w, w) < 1e-18) return true;
    }
    return false;
}

/* Points of the line from one end to the other, which two triangles share, or (b = a) one and the section. Where hidden
 * ones are wanted, each is in one list. */
static void check_line(const froe_scene *s, const froe_visibility *v, const looking *l, uint32_t a, uint32_t b,
                       point ends[2], uint32_t counts[2]) {
    const bool section = a == b;
    for (int k = 1; k < 8; k++) {
        point x;
        for (int c = 0; c < 3; c++) x[c] = ends[0][c] + (k + 0.03) / 8 * (ends[1][c] - ends[0][c]);
        const double depth = fmin(section ? 1 : beside_section(l, x), inside_window(l, x));
        const int seen = in_sight(s, l, x, a, b);
        if (seen < 0 || fabs(depth) < 1e-6) continue;
        const bool there = depth > 0 && is_shown(s, l, a) && is_shown(s, l, b);
        if (is_found(v, x, section, false) != (there && seen) ||
            is_found(v, x, section, true) != (there && !seen && l->hidden))
            fail_msg("triangles %u and %u, share %d/8: %s", b, a, k,
                     !there ? "there is nothing"
                     : seen ? "missing"
                            : "hidden");
        counts[seen] += there;
    }
}

/* The two points in which the border of a triangle passes through the section. */
static bool cross_section(const froe_scene *s, const looking *l, uint32_t object, point ends[2]) {
    int count = 0;
    for (uint32_t i = 0; i < 3; i++) {
        const double *p = scene_point(s, object, i), *q = scene_point(s, object, (i + 1) % 3);
        const double at_p = dot(l->plane, p) - l->plane[3], at_q = dot(l->plane, q) - l->plane[3];
        if ((at_p > 0) == (at_q > 0)) continue;
        for (int k = 0; k < 3; k++) ends[count][k] = p[k] + at_p / (at_p - at_q) * (q[k] - p[k]);
        count++;
    }
    return count == 2;
}

static void check_look(const froe_tree *tree, const froe_surface *surface, const looking *l, uint32_t counts[2]) {
    const froe_scene *s = tree->scene;
    froe_visibility_options o = froe_visibility_defaults();
    froe_visibility *v;
    o.eye = l->eye;
    o.crossings = true;
    o.hidden_crossings = l->hidden;
    o.cull_back = l->cull_back;
    o.section = l->section;
    o.window = l->window, o.window_corners = l->window ? 4 : 0;
    assert_int_equal(froe_visibility_new(tree, surface, &o, &v, NULL), FROE_OK);
    for (uint32_t a = 0; a < s->object_count; a++) {
        point ends[6];
        if (!may_cross(s, l, a)) continue;
        if (l->section && cross_section(s, l, a, ends)) check_line(s, v, l, a, a, ends, counts);
        for (uint32_t b = 0; b < a; b++)
            if (may_cross(s, l, b) && pierce(s, b, a, ends, pierce(s, a, b, ends, 0)) == 2)
                check_line(s, v, l, a, b, ends, counts);
    }
    froe_visibility_free(v);
}

/* Looks at a tree from so many places: with hidden crossings and without, with polygons that turn away and without,
 * through a window and without. The plane is that of its root's cut, for both of its sides; NULL: all is there. */
static void look_around(const froe_tree *tree, const double *plane, uint32_t eyes, uint32_t counts[2]) {
    froe_surface *surface;
    assert_int_equal(froe_surface_new(tree->scene, NULL, &surface, NULL), FROE_OK);
    for (uint32_t e = 0; e < eyes; e++)
        for (int how = 0; how < 8; how++)
            for (int section = plane ? -1 : 0; section <= (plane ? 1 : 0); section += 2) {
                const double span = tree->scene->hi[2] - tree->scene->lo[2],
                             shift[2] = {0.1 * span * (e % 2), -0.2 * span * (e % 3)};
                double window[12];
                looking l = {rays_eye(tree, e), how & 1, how & 2, section, plane, how & 4 ? window : NULL};
                set_window(tree->scene, &l.eye, (0.1 + 0.1 * (e % 4)) * span, shift, window);
                check_look(tree, surface, &l, counts);
            }
    froe_surface_free(surface);
}

static froe_tree *section_of(const froe_tree *tree, const double *plane) {
    froe_tree *out;
    assert_int_equal(froe_tree_section(tree, plane, NULL, &out, NULL), FROE_OK);
    return out;
}

/* All of a tree, and what a plane leaves of it on both sides. Frees it. */
static void check_tree(froe_tree *tree, const double *plane, uint32_t eyes, uint32_t counts[2]) {
    froe_tree *cut = section_of(tree, plane);
    look_around(tree, NULL, eyes, counts);
    look_around(cut, plane, eyes, counts);
    froe_tree_free(cut);
    froe_tree_free(tree);
}

static void check_counts(const uint32_t counts[2]) {
    print_message("  %u points seen, %u hidden\n", counts[1], counts[0]);
    assert_true(counts[0] > 50 && counts[1] > 50);
}

/* Triangles, and segments behind them in the scene. */
static froe_scene *scene_of(const double *triangles, size_t count, const double *segments, size_t segment_count) {
    froe_scene *scene;
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_POLYGON, count, triangles, NULL, NULL), FROE_OK);
    if (segment_count) assert_int_equal(trees_add(scene, FROE_SEGMENT, segment_count, segments, NULL, NULL), FROE_OK);
    return scene;
}

static void check_scene(froe_scene *scene, const double *plane, uint32_t eyes) {
    uint32_t counts[2] = {0, 0};
    for (int method = 0; method < 2; method++)
        check_tree(trees_build(scene, method ? "autopartition" : "density", 1), plane, eyes, counts);
    check_counts(counts);
    froe_scene_free(scene);
}

static void lines_of_crossing_triangles_are_found_where_they_are_seen(void **state) {
    (void)state;
    const double plane[] = {0.3, -0.2, 1, 0.6};
    check_scene(trees_scene(3, FROE_POLYGON, 60, 0, 1, 1), plane, 3);
}

/* Pairs of triangles that cross, and above each pair a third in whose plane their crossing lies. Where that plane is
 * cut first, it divides both, and neither is in the list of a cut of the other. */
enum { SIDE = 4, THREES = 3 * SIDE * SIDE };

static froe_scene *threes(void) {
    static const double three[3][3][3] = {
        {{-1, -1, 0}, {1, 1, 0}, {0, 0, 2}}, {{-1, 2, -1}, {1, -2, -1}, {0, 0, 3}}, {{0, -2, 4}, {0, 2, 4}, {0, 0, 6}}};
    double x[THREES][3][3];
    for (size_t i = 0; i < THREES; i++)
        for (size_t k = 0; k < 3; k++) {
            x[i][k][0] = 5 * (double)(i / 3 % SIDE) + three[i % 3][k][0];
            x[i][k][1] = 7 * (double)(i / 3 / SIDE) + three[i % 3][k][1];
            x[i][k][2] = three[i % 3][k][2];
        }
    return scene_of(x[0][0], THREES, NULL, 0);
}

static const double across_threes[] = {0.1, 0.05, 1, 2.3};

static void a_third_plane_through_a_crossing_takes_nothing_away(void **state) {
    (void)state;
    check_scene(threes(), across_threes, 12);
}

/* Of triangles around one line, some in one plane, each is cut along it by the plane of another. One is before them,
 * and segments lie in their planes and in that line. */
static froe_scene *around_a_line(void) {
    enum { AROUND = 16, TRIANGLES, SEGMENTS = 4 };
    double x[TRIANGLES][3][3] = {[AROUND] = {{-30, -8, -5}, {30, -8, -5}, {0, -8, 60}}}, w[SEGMENTS][2][3];
    for (size_t i = 0; i < AROUND; i++) {
        const double a = (double)(i % 12) - 6, low = (double)(7 * i % AROUND), high = low + 1 + (double)(i % 5);
        const double corners[3][3] = {{a, 7, low}, {-a, -7, low}, {0, 0, high}};
        memcpy(x[i], corners, sizeof corners);
    }
    for (size_t i = 0; i < SEGMENTS; i++) {
        const double a = (double)(i % 3), low = (double)i;
        const double ends[2][3] = {{a * (i > 0), 7 * (i > 0), low}, {-a * (i > 1), -7 * (i > 1), low + 9}};
        memcpy(w[i], ends, sizeof ends);
    }
    return scene_of(x[0][0], TRIANGLES, w[0][0], SEGMENTS);
}

static const double across_a_line[] = {0.15, 0.1, 1, 8.7};

static void many_planes_cross_in_one_line(void **state) {
    (void)state;
    check_scene(around_a_line(), across_a_line, 12);
}

/* A sheet that ends on another, or passes beside it, crosses nothing. */
static void touching_is_no_crossing(void **state) {
    (void)state;
    const double x[] = {0, 0, 0, 4, 0, 0, 4, 4, 0,  0, 4, 0,  1, 1, 0, 3, 1, 0,
                        3, 1, 2, 1, 1, 2, 5, 1, -1, 7, 1, -1, 7, 1, 1, 5, 1, 1};
    const size_t starts[] = {0, 4, 8, 12};
    froe_surface *surface;
    froe_visibility *v;
    size_t count;
    froe_tree *tree = trees_of_polygons(x, starts, 3, "density");
    assert_int_equal(froe_surface_new(tree->scene, NULL, &surface, NULL), FROE_OK);
    froe_visibility_options look = froe_visibility_defaults();
    look.eye = (froe_eye){.at = {1, -3, 2}, .parallel = true};
    look.crossings = true;
    assert_int_equal(froe_visibility_new(tree, surface, &look, &v, NULL), FROE_OK);
    (void)froe_visibility_crossings(v, &count);
    assert_int_equal(count, 0);
    froe_visibility_free(v);
    froe_surface_free(surface);
    froe_tree_free(tree);
}

typedef struct look_again {
    const froe_tree *tree;
    froe_visibility_options options;
    size_t visible, hidden; /* crossings as they are told with memory */
} look_again;

static froe_status look_with(void *user, const froe_allocator *alloc) {
    look_again *l = user;
    froe_surface *surface = NULL;
    froe_visibility *v = NULL;
    size_t count = 0, hidden = 0;
    l->options.alloc = alloc;
    froe_status status = froe_surface_new(l->tree->scene, alloc, &surface, NULL);
    if (!status) status = froe_visibility_new(l->tree, surface, &l->options, &v, NULL);
    if (!status) {
        const froe_crossing *c = froe_visibility_crossings(v, &count);
        for (size_t i = 0; i < count; i++) hidden += c[i].hidden;
        if (!l->visible && !l->hidden) l->visible = count - hidden, l->hidden = hidden; /* the first time */
        assert_true(count - hidden == l->visible && hidden == l->hidden);
    }
    froe_visibility_free(v);
    froe_surface_free(surface);
    return status;
}

/* Eyes that see all lines, some, and none. */
static void every_allocation_may_fail(void **state) {
    static const struct {
        bool around;
        const char *method;
        int section;
        froe_eye eye;
        bool beside;            /* through a window that shows nothing of the scene */
        size_t visible, hidden; /* so many crossings at least, or none */
    } cases[] = {
        {false, "density", 0, {{0, -1, 0.01}, true}, false, 5, 20},
        {false, "autopartition", 1, {{1, 0.2, 9}, true}, false, 80, 50},
        {false, "density", 1, {{0, 0, -1}, true}, false, 25, 0},
        {false, "autopartition", 0, {{0.5, -9, 1}, true}, false, 10, 10},
        {true, "density", 0, {{30, -70, 9}, false}, false, 0, 8},
        {true, "density", 1, {{3, 2, 5}, true}, false, 10, 10},
        {true, "autopartition", -1, {{1, 8, -3}, true}, false, 5, 3},
        {true, "density", 0, {{3, 2, 5}, true}, true, 0, 0},
    };
    (void)state;
    froe_scene *scenes[2] = {threes(), around_a_line()};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        froe_tree *whole = trees_build(scenes[cases[i].around], cases[i].method, 1),
                  *cut = section_of(whole, cases[i].around ? across_a_line : across_threes);
        look_again l = {.tree = cases[i].section ? cut : whole, .options = froe_visibility_defaults()};
        l.options.eye = cases[i].eye;
        l.options.section = cases[i].section;
        double window[12];
        set_window(whole->scene, &l.options.eye, 1, (const double[]){900, 0}, window);
        if (cases[i].beside) l.options.window = window, l.options.window_corners = 4;
        l.options.crossings = l.options.hidden_crossings = true;
        assert_true(test_memory_each(look_with, &l) > 20);
        assert_true(l.visible >= cases[i].visible && l.hidden >= cases[i].hidden);
        assert_true((cases[i].visible || !l.visible) && (cases[i].hidden || !l.hidden));
        froe_tree_free(cut);
        froe_tree_free(whole);
    }
    for (int i = 0; i < 2; i++) froe_scene_free(scenes[i]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_of_crossing_triangles_are_found_where_they_are_seen),
        cmocka_unit_test(a_third_plane_through_a_crossing_takes_nothing_away),
        cmocka_unit_test(many_planes_cross_in_one_line),
        cmocka_unit_test(touching_is_no_crossing),
        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
