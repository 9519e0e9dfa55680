/* test_strokes.c: what a line says of itself: its points in the scene are seen where it is drawn, they lie on the
 * object that it belongs to, and that object is the one that the rule names. Lines kept apart by object are the same
 * lines. */
#include "support/small_scenes.h"
#include <froe/formats.h>
#include <froe/view.h>
#include <math.h>

enum { SIDE = 7 };

/* Hills, one mesh, with triangles that pass through them and each other. */
static froe_tree *hills(void) {
    froe_scene *scene = random_triangles(12, 0.6);
    double x[SIDE * SIDE * 18];
    size_t n = 0;
    for (int i = 0; i < SIDE; i++)
        for (int j = 0; j < SIDE; j++)
            for (int k = 0; k < 6; k++) {
                static const int corner[6][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
                const int u = i + corner[k][0], v = j + corner[k][1];
                x[n++] = u / 7.0, x[n++] = v / 7.0, x[n++] = 0.25 + 0.25 * ((u * u + 3 * v + u * v) % 5) / 5.0;
            }
    froe_objects o = froe_objects_defaults();
    o.count = n / 9, o.coords = x;
    assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
    return tree_of(scene, "density", 1);
}

typedef struct sight {
    const froe_scene *scene;
    froe_surface *surface;
    froe_projection view;
    froe_picture *picture;
} sight;

static sight look_by(const froe_tree *tree, const froe_camera *camera, const froe_picture_options *options) {
    sight s = {.scene = froe_tree_scene(tree)};
    froe_picture_options o = *options;
    assert_int_equal(froe_camera_place(camera, s.scene, &s.view, NULL), FROE_OK);
    assert_int_equal(froe_surface_new(s.scene, NULL, &s.surface, NULL), FROE_OK);
    o.view = &s.view;
    o.no_fills = true;
    assert_int_equal(froe_picture_new(tree, s.surface, &o, &s.picture, NULL), FROE_OK);
    return s;
}

static sight look_at(const froe_tree *tree, bool parallel, const uint32_t *chains, double halo) {
    froe_camera camera = froe_camera_defaults();
    froe_picture_options o = froe_picture_defaults();
    camera.parallel = parallel;
    o.lines = 127;
    o.hidden = true;
    o.halo = halo;
    o.chains = chains;
    return look_by(tree, &camera, &o);
}

static sight look_for(const froe_tree *tree, uint32_t lines) {
    const froe_camera camera = froe_camera_defaults();
    froe_picture_options o = froe_picture_defaults();
    o.lines = lines;
    return look_by(tree, &camera, &o);
}

static void close_sight(sight *s) {
    froe_picture_free(s->picture);
    froe_surface_free(s->surface);
}

static const double *corner(const sight *s, uint32_t object, uint32_t i) {
    return froe_scene_vertex(s->scene, froe_scene_corner(s->scene, object, i));
}

/* Twice the area of a triangle of space as a vector. */
static void normal_of(const double *a, const double *b, const double *c, double n[3]) {
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        n[k] = (b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]);
    }
}

static bool faces_the_eye(const sight *s, uint32_t object) {
    double n[3], to_eye = 0;
    const double *a = corner(s, object, 0);
    normal_of(a, corner(s, object, 1), corner(s, object, 2), n);
    for (int k = 0; k < 3; k++) to_eye += n[k] * (s->view.eye.at[k] - (s->view.eye.parallel ? 0 : a[k]));
    return to_eye > 0;
}

static double distance_to_plane(const sight *s, uint32_t object, const double *p) {
    double n[3], length = 0, dot = 0;
    const double *a = corner(s, object, 0);
    normal_of(a, corner(s, object, 1), corner(s, object, 2), n);
    for (int k = 0; k < 3; k++) length += n[k] * n[k], dot += n[k] * (p[k] - a[k]);
    return fabs(dot) / sqrt(length);
}

static bool is_between(const double *p, const double *a, const double *b) {
    double n[3], area = 0, square = 0, along = 0;
    normal_of(p, a, b, n);
    for (int k = 0; k < 3; k++)
        area += n[k] * n[k], square += (b[k] - a[k]) * (b[k] - a[k]), along += (p[k] - a[k]) * (b[k] - a[k]);
    return sqrt(area / square) < 1e-9 && along > -1e-9 * square && along < (1 + 1e-9) * square;
}

/* Is there an edge with both points on it whose first object that faces the eye, or else whose first, is this one? */
static bool is_first_of_an_edge(const sight *s, uint32_t object, const double *p, const double *q) {
    for (uint32_t c = 0; c < 3; c++) {
        const froe_edge edge = froe_surface_edge(s->surface, froe_surface_edge_of(s->surface, object, c));
        const double *a = froe_scene_vertex(s->scene, edge.vertex[0]), *b = froe_scene_vertex(s->scene, edge.vertex[1]);
        if (!is_between(p, a, b) || !is_between(q, a, b)) continue;
        uint32_t first = edge.objects[0];
        for (size_t i = edge.object_count; i-- > 0;)
            if (faces_the_eye(s, edge.objects[i])) first = edge.objects[i];
        if (first == object) return true;
    }
    return false;
}

static void lines_lie_on_the_objects_that_they_name(void **state) {
    (void)state;
    froe_tree *tree = hills();
    const size_t objects = froe_scene_object_count(froe_tree_scene(tree));
    uint32_t *each = calloc(objects, sizeof *each);
    for (uint32_t i = 0; i < objects; i++) each[i] = i;
    for (int look = 0; look < 4; look++) {
        sight s = look_at(tree, look % 2, each, look / 2 ? 6 : 0);
        size_t edges = 0, crossings = 0, hidden = 0;
        for (size_t i = 0; i < froe_picture_stroke_count(s.picture); i++) {
            const froe_stroke stroke = froe_picture_stroke(s.picture, i);
            hidden += stroke.hidden;
            for (size_t k = 0; k < stroke.count; k++) {
                double page[2];
                const double *p = stroke.space + 3 * k, *q = stroke.space + 3 * (k + 1 < stroke.count ? k + 1
                                                                                 : stroke.closed      ? 0
                                                                                                      : k);
                assert_true(froe_project(&s.view, p, page));
                assert_true(hypot(page[0] - stroke.points[2 * k], page[1] - stroke.points[2 * k + 1]) < 1e-6);
                assert_int_equal(stroke.objects[k], stroke.objects[0]);
                const bool crosses = stroke.kind == FROE_LINE_CROSSING;
                if (crosses) assert_true(distance_to_plane(&s, stroke.objects[k], p) < 1e-9);
                if (!crosses) assert_true(is_first_of_an_edge(&s, stroke.objects[k], p, q));
                ++*(crosses ? &crossings : &edges);
            }
        }
        assert_true(edges > 100 && crossings > 10 && hidden > 10);
        close_sight(&s);
    }
    free(each);
    froe_tree_free(tree);
}

static void lines_of_objects_apart_are_the_same_lines(void **state) {
    (void)state;
    froe_tree *tree = hills();
    const size_t objects = froe_scene_object_count(froe_tree_scene(tree));
    uint32_t *numbers = calloc(objects, sizeof *numbers);
    double length[3][2] = {{0}};
    size_t strokes[3];
    for (uint32_t i = 0; i < objects; i++) numbers[i] = i;
    for (int round = 0; round < 3; round++) { /* all together; of two halves; one by one */
        for (uint32_t i = 0; i < objects && round == 1; i++) numbers[i] = i % 2;
        for (uint32_t i = 0; i < objects && round == 2; i++) numbers[i] = i;
        sight s = look_at(tree, false, round ? numbers : NULL, 0);
        strokes[round] = froe_picture_stroke_count(s.picture);
        for (size_t i = 0; i < strokes[round]; i++) {
            const froe_stroke x = froe_picture_stroke(s.picture, i);
            for (size_t k = 0; k + !x.closed < x.count; k++) {
                const double *p = x.points + 2 * k, *q = x.points + 2 * ((k + 1) % x.count);
                length[round][x.hidden] += hypot(q[0] - p[0], q[1] - p[1]);
                if (round == 1) assert_int_equal(x.objects[k] % 2, x.objects[0] % 2);
            }
        }
        close_sight(&s);
    }
    assert_true(strokes[0] < strokes[1] && strokes[1] < strokes[2]);
    for (int round = 1; round < 3; round++)
        for (int hidden = 0; hidden < 2; hidden++)
            assert_true(fabs(length[round][hidden] - length[0][hidden]) < 1e-9 * length[0][hidden]);
    free(numbers);
    froe_tree_free(tree);
}

/* The outlines of a terrain. Cuts that go through vertices end edges there, too, and different cuts different edges. */
static void lines_do_not_depend_on_the_tree(void **state) {
    static const char *const methods[] = {"density", "autopartition", "kd", "grain", "auto"};
    size_t strokes = 0, points = 0, pieces = 0;
    (void)state;
    for (int m = 0; m < 5; m++) {
        froe_scene *scene;
        froe_tree *tree;
        froe_build_options o = froe_build_defaults();
        o.method = methods[m];
        o.purpose = "draw";
        assert_int_equal(froe_generate("terrain", 1000, 1, NULL, &scene, NULL), FROE_OK);
        assert_int_equal(froe_build(scene, &o, &tree, NULL), FROE_OK);
        froe_scene_free(scene); /* the tree holds it */
        sight s = look_for(tree, FROE_LINE_BORDER | FROE_LINE_SILHOUETTE | FROE_LINE_CREASE);
        size_t sum = 0;
        for (size_t i = 0; i < froe_picture_stroke_count(s.picture); i++)
            sum += froe_picture_stroke(s.picture, i).count;
        if (!m) pieces = froe_tree_piece_count(tree);
        if (m == 4) assert_true(froe_tree_piece_count(tree) != pieces); /* density with fewer candidates */
        if (!m) strokes = froe_picture_stroke_count(s.picture), points = sum;
        assert_int_equal(froe_picture_stroke_count(s.picture), strokes);
        assert_int_equal(sum, points);
        close_sight(&s);
        froe_tree_free(tree);
    }
    assert_true(strokes > 10 && points > 5 * strokes);
}

/* Strips side by side, up and down in turn, of these groups; kinds of the edges between them, as they are drawn. */
static void kinds_of_edges_follow_groups_and_angles(void **state) {
    enum { STRIPS = 6 };
    (void)state;
    static const froe_group groups[STRIPS] = {
        {.name = "none"}, /* the first strip is of no group */
        {.name = "wall", .material = "brick", .colour = 1},
        {.name = "wall", .material = "brick", .colour = 1},
        {.name = "wall", .material = "brick", .colour = 2},
        {.name = "wall", .material = "wood", .colour = 2},
        {.name = "door", .material = "wood", .colour = 2},
    };
    static const froe_line rest = (froe_line)0; /* a crease or a line of the mesh, by the angle */
    const froe_line expected[STRIPS] = {rest, FROE_LINE_OBJECT,   FROE_LINE_OBJECT,
                                        rest, FROE_LINE_MATERIAL, FROE_LINE_OBJECT};
    const size_t starts[2] = {0, 4};
    froe_scene *scene;
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    for (uint32_t i = 0; i < STRIPS; i++) {
        const double x = i, z = i % 2 * 0.5, strip[12] = {x, 0, z, x + 1, 0, 0.5 - z, x + 1, 1, 0.5 - z, x, 1, z};
        froe_objects o = froe_objects_defaults();
        uint32_t id;
        assert_int_equal(froe_scene_add_group(scene, groups + i, &id), FROE_OK);
        o.count = 1, o.coords = strip, o.starts = starts, o.group = i ? id : FROE_NONE;
        assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
    }
    froe_tree *tree = tree_of(scene, "density", 1);
    static const double creases[] = {0, 30, 180};
    for (int i = 0; i < 6; i++) { /* from above, and from beside, where every second strip is seen from behind */
        froe_picture_options o = froe_picture_defaults();
        froe_camera camera = froe_camera_defaults();
        o.lines = FROE_LINE_OBJECT | FROE_LINE_MATERIAL | FROE_LINE_CREASE | FROE_LINE_MESH;
        o.crease = creases[i % 3], o.hidden = true;
        camera.parallel = true;
        camera.eye[0] = i / 3 ? 3 : 0, camera.eye[1] = -0.3, camera.eye[2] = 1;
        sight s = look_by(tree, &camera, &o);
        uint32_t found = 0;
        for (size_t k = 0; k < froe_picture_stroke_count(s.picture); k++) {
            const froe_stroke line = froe_picture_stroke(s.picture, k);
            const uint32_t edge = (uint32_t)line.space[0];
            const uint32_t by_angle = creases[i % 3] < 180 ? FROE_LINE_CREASE : FROE_LINE_MESH;
            assert_true(edge > 0 && edge < STRIPS && line.space[0] == line.space[3]);
            assert_int_equal(line.kind, expected[edge] ? expected[edge] : by_angle);
            found |= 1u << edge;
        }
        assert_int_equal(found, (1u << STRIPS) - 2);
        close_sight(&s);
    }
    froe_tree_free(tree);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_lie_on_the_objects_that_they_name),
        cmocka_unit_test(lines_of_objects_apart_are_the_same_lines),
        cmocka_unit_test(lines_do_not_depend_on_the_tree),
        cmocka_unit_test(kinds_of_edges_follow_groups_and_angles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
