/* test_write.c: scenes that are written are read back as they were, and parts of trees are what the tree has. */
#include "../tree/trees.h"
#include "support/scenes.h"
#include <math.h>

/* Objects of one kind, of no group or of two in turn, of which each has two objects in a row. */
static froe_scene *make(int dim, froe_kind kind, bool grouped, uint32_t grid) {
    froe_scene *plain = trees_scene(dim, kind, 12, grid, 1, 1), *scene;
    uint32_t ids[2];
    assert_int_equal(froe_scene_new(dim, NULL, &scene), FROE_OK);
    for (int g = 0; g < 2; g++) {
        const froe_group group = {.name = g ? "a \"wall\"\n" : "door", .material = g ? "wood" : ""};
        assert_int_equal(froe_scene_add_group(scene, &group, ids + g), FROE_OK);
    }
    for (uint32_t i = 0; i < 12; i++) {
        double x[9], radius = 0.25;
        const froe_object object = froe_scene_object(plain, i);
        froe_objects o = froe_objects_defaults();
        const uint32_t least = kind == FROE_BOX || kind == FROE_SEGMENT ? 2 : kind == FROE_POLYGON ? 3 : 1;
        const size_t starts[2] = {0, object.corners < least ? least : object.corners};
        for (uint32_t c = 0; c < starts[1]; c++)
            memcpy(x + (size_t)dim * c, corner(plain, i, c < object.corners ? c : object.corners - 1),
                   (size_t)dim * sizeof *x);
        o.kind = kind, o.count = 1, o.coords = x, o.group = grouped ? ids[i / 2 % 2] : FROE_NONE;
        o.starts = kind == FROE_HULL ? starts : NULL, o.radii = kind == FROE_BALL ? &radius : NULL;
        assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
    }
    froe_scene_free(plain);
    return scene;
}

static void assert_comes_back(const froe_scene *scene, const char *path, bool boxes) {
    froe_diagnostic why;
    froe_read_options o = froe_read_defaults();
    o.boxes = boxes;
    if (froe_write_scene(scene, path, &why)) fail_msg("%s", why.message);
    froe_scene *read = read_with(path, &o, NULL);
    assert_int_equal(froe_scene_object_count(read), froe_scene_object_count(scene));
    if (scene_hash(read) != scene_hash(scene))
        fail_msg("%s: %d is another scene", path, froe_scene_object(scene, 0).kind);
    froe_scene_free(read);
}

/* Anywhere, and on a lattice, where segments have no length, boxes no width and triangles no area. */
static void scenes_of_the_plane_come_back(void **state) {
    (void)state;
    static const froe_kind kinds[] = {FROE_POINT, FROE_SEGMENT, FROE_BOX};
    for (int i = 0; i < 12; i++) {
        froe_scene *scene = make(2, kinds[i % 3], i / 3 % 2, i / 6 ? 2 : 0);
        assert_comes_back(scene, "out.csv", false);
        if (i < 6 || kinds[i % 3] == FROE_POINT) /* lines of one point are passed over, and boxes are shapes */
            assert_comes_back(scene, i % 2 ? "out.geojson" : "out.json", kinds[i % 3] == FROE_BOX);
        froe_scene_free(scene);
    }
    for (int kind = FROE_BALL; kind <= FROE_HULL; kind += FROE_HULL - FROE_BALL) {
        froe_scene *scene = make(2, (froe_kind)kind, false, 0);
        assert_comes_back(scene, "out.csv", false);
        froe_scene_free(scene);
    }
}

static void scenes_of_space_come_back(void **state) {
    (void)state;
    for (int i = 0; i < 4; i++)
        for (int kind = FROE_POINT; kind <= FROE_POLYGON; kind++) {
            froe_scene *scene = make(3, (froe_kind)kind, i % 2, i / 2 ? 2 : 0);
            if (kind != FROE_POLYGON) assert_comes_back(scene, "out.csv", false);
            if (i < 2) { /* what has no extent has the form of a smaller kind, and is read as that */
                assert_comes_back(scene, "out.obj", false);
                assert_comes_back(scene, "out.off", false);
            }
            froe_scene_free(scene);
        }
}

/* Segments of one group are one feature: where one begins at the end of the last, a line goes on. */
static void lines_go_on_where_segments_do(void **state) {
    (void)state;
    static const double x[] = {0, 0, 1, 0, 1, 0, 1, 1, 5, 5, 6, 6};
    froe_scene *scene;
    froe_objects o = froe_objects_defaults();
    char text[4096];
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    assert_int_equal(froe_scene_add_group(scene, &(froe_group){.name = "path"}, &o.group), FROE_OK);
    o.kind = FROE_SEGMENT, o.count = 3, o.coords = x;
    assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
    assert_comes_back(scene, "lines.geojson", false);
    FILE *file = fopen("lines.geojson", "r");
    assert_non_null(file);
    text[fread(text, 1, sizeof text - 1, file)] = 0;
    fclose(file);
    assert_non_null(strstr(text, "\"MultiLineString\",\"coordinates\":[[[0,0],[1,0],[1,1]],[[5,5],[6,6]]]"));
    froe_scene_free(scene);
}

static void what_a_format_does_not_have_is_refused(void **state) {
    (void)state;
    froe_diagnostic why;
    froe_scene *scene = make(3, FROE_POINT, false, 0), *plane = make(2, FROE_SEGMENT, false, 0);
    static const double segment[] = {0, 0, 0, 1, 1, 1};
    assert_int_equal(froe_write_scene(scene, "out.geojson", &why), FROE_E_UNSUPPORTED);
    assert_non_null(strstr(why.message, "dimension 3"));
    assert_int_equal(froe_write_scene(plane, "out.off", &why), FROE_E_UNSUPPORTED);
    assert_int_equal(froe_write_scene(plane, "out.stl", &why), FROE_E_UNSUPPORTED);
    assert_non_null(strstr(why.message, ".off or .obj"));
    assert_int_equal(trees_add(scene, FROE_SEGMENT, 1, segment, NULL, NULL), FROE_OK);
    assert_int_equal(froe_write_scene(scene, "out.csv", &why), FROE_E_UNSUPPORTED);
    assert_int_equal(why.object, 12);
    assert_int_equal(froe_write_scene(scene, "out.csv", NULL), FROE_E_UNSUPPORTED);
    froe_scene_free(scene), froe_scene_free(plane);
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK); /* nothing at all */
    assert_int_equal(froe_write_scene(scene, "empty.csv", &why), FROE_OK);
    assert_int_equal(froe_write_scene(scene, "empty.geojson", &why), FROE_OK);
    froe_scene_free(scene);
}

/* ---------------------------------------------------------------------- parts -- */

typedef struct tally {
    size_t parts, corners, most, covers, stop;
    double done;
} tally;

static bool count_part(void *user, const froe_part *part) {
    tally *t = user;
    t->corners += part->corners;
    if (part->corners > t->most) t->most = part->corners;
    for (int i = 0; i < part->attribute_count; i++)
        if (!strcmp(part->attributes[i].name, "in_cut")) t->covers += !part->attributes[i].number;
    return ++t->parts != t->stop;
}

static bool go_on(void *user, double done) {
    ((tally *)user)->done = done;
    return true;
}

static bool give_up(void *user, double done) {
    ((tally *)user)->done = done;
    return false;
}

/* Of a tree of its own; stop: after so many parts. */
static froe_status tell(froe_scene *scene, froe_export_what what, froe_progress_fn *progress, size_t stop, tally *t) {
    froe_export_options o = froe_export_defaults();
    froe_tree *tree = trees_build(scene, "density", 1);
    *t = (tally){.stop = stop};
    o.progress = progress, o.user = t;
    froe_scene_free(scene);
    const froe_status status = froe_tree_parts(tree, what, &o, count_part, t, NULL);
    if (what == FROE_EXPORT_FRAGMENTS && !progress && !stop) assert_int_equal(t->parts, froe_tree_piece_count(tree));
    froe_tree_free(tree);
    return status;
}

static void parts_are_told_until_one_has_heard_enough(void **state) {
    (void)state;
    tally t;
    for (int what = FROE_EXPORT_FRAGMENTS; what <= FROE_EXPORT_CUTS; what++) {
        assert_int_equal(tell(trees_scene(2, FROE_SEGMENT, 1500, 0, 0.1, 1), (froe_export_what)what, go_on, 0, &t),
                         FROE_OK);
        assert_true(t.parts > 1024 && t.done > 0 && t.done <= 1);
        assert_int_equal(tell(trees_scene(2, FROE_SEGMENT, 1500, 0, 0.1, 1), (froe_export_what)what, give_up, 0, &t),
                         FROE_E_CANCELLED);
        assert_int_equal(t.parts, 1024);
        assert_int_equal(tell(trees_scene(2, FROE_SEGMENT, 20, 0, 0.1, 1), (froe_export_what)what, NULL, 7, &t),
                         FROE_OK);
        assert_int_equal(t.parts, 7);
    }
}

/* A point has no extent, and a cell around it has; a polygon of many corners, and boxes that are points. */
static void parts_of_odd_objects_are_told(void **state) {
    enum { MANY = 40 };
    (void)state;
    tally t;
    double x[3 * MANY];
    const size_t starts[2] = {0, MANY};
    froe_scene *scene;
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    for (int i = 0; i < MANY; i++) x[3 * i] = i, x[3 * i + 1] = i * (MANY - i), x[3 * i + 2] = 0; /* on a parabola */
    assert_int_equal(trees_add(scene, FROE_POLYGON, 1, x, NULL, starts), FROE_OK);
    assert_int_equal(tell(scene, FROE_EXPORT_FRAGMENTS, NULL, 0, &t), FROE_OK);
    assert_int_equal(t.most, MANY);
    assert_int_equal(tell(trees_scene(2, FROE_POINT, 1, 0, 1, 1), FROE_EXPORT_CELLS, NULL, 0, &t), FROE_OK);
    assert_true(t.parts == 1 && t.corners == 4);
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    static const double boxes[] = {1, 1, 1, 1, 0, 0, 2, 3, 0, 1, 0, 4};
    assert_int_equal(trees_add(scene, FROE_BOX, 3, boxes, NULL, NULL), FROE_OK);
    assert_int_equal(tell(scene, FROE_EXPORT_FRAGMENTS, NULL, 0, &t), FROE_OK);
    assert_true(t.parts >= 3 && t.most == 4);
    assert_int_equal(tell(trees_scene(4, FROE_BOX, 5, 0, 1, 1), FROE_EXPORT_FRAGMENTS, NULL, 0, &t), FROE_OK);
    assert_int_equal(t.most, 2); /* beyond space two corners say it all */
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    for (int i = 0; i < 60; i++) { /* one in the other: covers */
        const double nested[] = {i, i, 120 - i, 120 - i};
        assert_int_equal(trees_add(scene, FROE_BOX, 1, nested, NULL, NULL), FROE_OK);
    }
    assert_int_equal(tell(scene, FROE_EXPORT_FRAGMENTS, NULL, 0, &t), FROE_OK);
    assert_true(t.covers > 0);
}

/* Around a scene that reaches to the greatest doubles there is no tenth more of room, and it is shown all the same. */
static void parts_of_a_scene_at_the_end_of_doubles_are_told(void **state) {
    static const double scenes[2][6] = {{-1.79e308, -1.7e308, 1.7e308, 1.79e308, 1.2e308, 1.5e308},
                                        {1e308, 1e308, 1.7e308, 1.6e308, 1.2e308, 1.5e308}};
    (void)state;
    tally t;
    for (int i = 0; i < 2; i++) {
        for (int what = FROE_EXPORT_CELLS; what <= FROE_EXPORT_CUTS; what++) {
            froe_scene *scene;
            assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
            assert_int_equal(trees_add(scene, FROE_POINT, 3, scenes[i], NULL, NULL), FROE_OK);
            assert_int_equal(tell(scene, (froe_export_what)what, NULL, 0, &t), FROE_OK);
            assert_int_equal(t.parts, what == FROE_EXPORT_CELLS ? 3 : 2);
        }
    }
}

static void parts_are_clipped_to_a_box_of_numbers_alone(void **state) {
    (void)state;
    const double numbers[] = {0, 0}, bad[] = {0.5, NAN}, endless[] = {INFINITY, 1}, low[] = {1, -1};
    const double *const highs[] = {bad, endless, low};
    froe_tree *tree = trees_grow(2, FROE_SEGMENT, 20, 0, 1, "density", 1);
    froe_export_options o = froe_export_defaults();
    tally t = {.parts = 0};
    for (int i = 0; i < 3; i++) {
        o.lo = numbers, o.hi = highs[i];
        assert_int_equal(froe_tree_parts(tree, FROE_EXPORT_CELLS, &o, count_part, &t, NULL), FROE_E_ARG);
    }
    assert_int_equal(t.parts, 0);
    froe_tree_free(tree);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scenes_of_the_plane_come_back),
        cmocka_unit_test(scenes_of_space_come_back),
        cmocka_unit_test(lines_go_on_where_segments_do),
        cmocka_unit_test(what_a_format_does_not_have_is_refused),
        cmocka_unit_test(parts_are_told_until_one_has_heard_enough),
        cmocka_unit_test(parts_of_odd_objects_are_told),
        cmocka_unit_test(parts_of_a_scene_at_the_end_of_doubles_are_told),
        cmocka_unit_test(parts_are_clipped_to_a_box_of_numbers_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
