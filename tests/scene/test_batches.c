/* Life of a scene, its vertex table, labels and groups, and every refusal of a batch. */
#include "support/memory.h"

#include "scene/store.h"
#include <float.h>
#include <math.h>
#include <string.h>

static froe_scene *new_scene(int dim) {
    froe_scene *s = NULL;
    assert_int_equal(froe_scene_new(dim, NULL, &s), FROE_OK);
    return s;
}

static froe_objects batch_of(froe_kind kind, size_t count, const double *coords) {
    froe_objects b = froe_objects_defaults();
    b.kind = kind;
    b.count = count;
    b.coords = coords;
    return b;
}

static void add(froe_scene *s, froe_objects b) {
    froe_diagnostic diag;
    froe_status status = froe_scene_add(s, &b, &diag);
    if (status) fail_msg("%s", diag.message);
}

/** Adds, expects the refusal and that the scene is as it was. */
static froe_diagnostic refuse(froe_scene *s, froe_objects b, froe_status expected) {
    froe_diagnostic diag = {.status = FROE_OK};
    size_t objects = froe_scene_object_count(s), vertices = froe_scene_vertex_count(s);
    assert_int_equal(froe_scene_add(s, &b, &diag), expected);
    assert_int_equal(diag.status, expected);
    assert_true(strlen(diag.message) > 0);
    assert_int_equal(froe_scene_object_count(s), objects);
    assert_int_equal(froe_scene_vertex_count(s), vertices);
    return diag;
}

static void dimensions_from_2_to_8_exist(void **state) {
    (void)state;
    froe_scene *s = NULL;
    assert_int_equal(froe_scene_new(1, NULL, &s), FROE_E_ARG);
    assert_int_equal(froe_scene_new(9, NULL, &s), FROE_E_ARG);
    assert_int_equal(froe_scene_new(2, NULL, NULL), FROE_E_ARG);
    assert_null(s);
    for (int dim = 2; dim <= 8; dim++) {
        double lo[8], hi[8];
        s = new_scene(dim);
        assert_int_equal(froe_scene_dim(s), dim);
        assert_int_equal(froe_scene_object_count(s), 0);
        assert_false(froe_scene_bounds(s, lo, hi));
        froe_scene_free(s);
    }
    froe_scene_free(NULL);
}

static void equal_points_share_a_vertex_and_minus_zero_is_zero(void **state) {
    (void)state;
    froe_scene *s = new_scene(2);
    const double xy[] = {0.0, 1, -0.0, 2, /**/ -0.0, 1, 3, -0.0, /**/ 3, 0.0, 0, 2};
    add(s, batch_of(FROE_SEGMENT, 3, xy));
    assert_int_equal(froe_scene_vertex_count(s), 3);
    assert_int_equal(froe_scene_corner(s, 1, 0), froe_scene_corner(s, 0, 0));
    assert_int_equal(froe_scene_corner(s, 2, 0), froe_scene_corner(s, 1, 1));
    for (uint32_t v = 0; v < 3; v++)
        for (int k = 0; k < 2; k++) assert_false(signbit(froe_scene_vertex(s, v)[k]));
    froe_scene_free(s);
}

static void objects_say_what_they_were_and_what_they_are(void **state) {
    (void)state;
    froe_scene *s = new_scene(2);
    const double xy[] = {0, 0, 1, 1, 2, 2, 2, 2};
    add(s, batch_of(FROE_SEGMENT, 2, xy));
    const double radius = 0.5;
    froe_objects balls = batch_of(FROE_BALL, 1, xy);
    balls.radii = &radius;
    add(s, balls);
    add(s, batch_of(FROE_BOX, 1, xy));
    add(s, batch_of(FROE_POINT, 4, xy));
    froe_object o = froe_scene_object(s, 1);
    assert_int_equal(o.kind, FROE_SEGMENT);
    assert_int_equal(o.form, FROE_POINT);
    assert_int_equal(o.corners, 1);
    assert_int_equal(o.face, 1);
    assert_int_equal(o.group, FROE_NONE);
    assert_int_equal(o.tag, 1);
    assert_int_equal(froe_scene_corner(s, 1, 1), FROE_NONE);
    o = froe_scene_object(s, 2);
    assert_int_equal(o.form, FROE_BALL);
    assert_int_equal(o.corners, 1);
    assert_true(o.radius == 0.5);
    assert_int_equal(froe_scene_corner(s, 2, 1), FROE_NONE);
    assert_int_equal(froe_scene_kind_count(s, FROE_SEGMENT), 2);
    assert_int_equal(froe_scene_kind_count(s, FROE_POINT), 4);
    assert_int_equal(froe_scene_kind_count(s, FROE_HULL), 0);
    assert_int_equal(froe_scene_object(s, 8).kind, FROE_KIND_NONE);
    assert_null(froe_scene_vertex(s, 3));
    froe_scene_free(s);
}

static void hulls_keep_each_vertex_once_in_ascending_order(void **state) {
    (void)state;
    froe_scene *s = new_scene(3);
    double xyz[3 * 40];
    for (int i = 0; i < 40; i++)
        for (int k = 0; k < 3; k++) xyz[3 * i + k] = (i * 7) % 20 + k;
    const size_t starts[] = {0, 39, 40};
    froe_objects b = batch_of(FROE_HULL, 2, xyz);
    b.starts = starts;
    add(s, b);
    assert_int_equal(froe_scene_object(s, 0).corners, 20);
    assert_int_equal(froe_scene_object(s, 1).corners, 1);
    for (uint32_t i = 1; i < 20; i++) assert_true(froe_scene_corner(s, 0, i - 1) < froe_scene_corner(s, 0, i));
    froe_scene_free(s);
}

static void indices_and_starts_select_corners(void **state) {
    (void)state;
    froe_scene *s = new_scene(2);
    const double xy[] = {0, 0, 1, 0, 1, 1, 0, 1};
    const uint32_t indices[] = {9, 9, 0, 1, 2, 2, 3};
    const size_t starts[] = {2, 5, 7};
    froe_objects b = batch_of(FROE_HULL, 2, xy);
    b.indices = indices;
    b.point_count = 4;
    b.starts = starts;
    add(s, b);
    assert_int_equal(froe_scene_object(s, 0).corners, 3);
    assert_int_equal(froe_scene_object(s, 1).corners, 2);
    b.point_count = 3;
    froe_diagnostic diag = refuse(s, b, FROE_E_INPUT);
    assert_int_equal(diag.object, 1);
    assert_int_equal(diag.corner, 1);
    assert_string_equal(diag.message, "corner 1 of hull 1: There is no point 3.");
    b.indices = (const uint32_t[]){0, 1, 0, 1, 2, 1234567, 0};
    assert_string_equal(refuse(s, b, FROE_E_INPUT).message, "corner 0 of hull 1: There is no point 1234567.");
    froe_scene_free(s);
}

static void labels_appear_with_the_first_object_that_has_them(void **state) {
    (void)state;
    froe_scene *s = new_scene(2);
    const double xy[] = {0, 0, 1, 1};
    const uint64_t tags[] = {77, 88};
    const uint32_t faces[] = {5, 5}, groups[] = {FROE_NONE, 1}, wrong[] = {0, 2};
    uint32_t id;
    froe_group group = {.name = "first", .left = "kitchen"};
    add(s, batch_of(FROE_POINT, 2, xy));
    assert_int_equal(froe_scene_add_group(s, &group, &id), FROE_OK);
    assert_int_equal(id, 0);
    group = (froe_group){.material = "wood", .right = "", .colour = 0xA0522DFF};
    assert_int_equal(froe_scene_add_group(s, &group, &id), FROE_OK);
    assert_int_equal(id, 1);
    assert_null(s->tags);
    assert_null(s->faces);
    assert_null(s->groups);
    froe_objects b = batch_of(FROE_POINT, 2, xy);
    b.groups = wrong;
    b.tags = tags;
    assert_int_equal(refuse(s, b, FROE_E_INPUT).object, 1);
    assert_null(s->tags);
    b.groups = groups;
    b.faces = faces;
    add(s, b);
    b = batch_of(FROE_POINT, 1, xy);
    b.group = 0;
    add(s, b);
    assert_int_equal(froe_scene_object(s, 1).tag, 1);
    assert_int_equal(froe_scene_object(s, 3).tag, 88);
    assert_int_equal(froe_scene_object(s, 4).tag, 4);
    assert_int_equal(froe_scene_object(s, 2).face, 5);
    assert_int_equal(froe_scene_object(s, 4).face, 4);
    assert_int_equal(froe_scene_object(s, 1).group, FROE_NONE);
    assert_int_equal(froe_scene_object(s, 2).group, FROE_NONE);
    assert_int_equal(froe_scene_object(s, 3).group, 1);
    assert_int_equal(froe_scene_object(s, 4).group, 0);
    assert_int_equal(froe_scene_group_count(s), 2);
    assert_string_equal(froe_scene_group(s, 0).name, "first");
    assert_string_equal(froe_scene_group(s, 0).left, "kitchen");
    assert_string_equal(froe_scene_group(s, 0).right, "");
    assert_string_equal(froe_scene_group(s, 1).material, "wood");
    assert_string_equal(froe_scene_group(s, 9).name, "");
    assert_int_equal(froe_scene_add_group(s, NULL, &id), FROE_E_ARG);
    b.group = 2;
    refuse(s, b, FROE_E_INPUT);
    froe_scene_free(s);
}

/* Memory that grows is always another, and what was there is gone. */
static void *move_block(void *user, void *block, size_t old_size, size_t new_size) {
    char *moved = new_size ? malloc(new_size) : NULL;
    (void)user;
    if (moved && block) memcpy(moved, block, old_size < new_size ? old_size : new_size);
    if (block) memset(block, '?', old_size);
    free(block);
    return moved;
}

static void groups_may_have_the_strings_of_others(void **state) {
    (void)state;
    const froe_allocator moving = {move_block, NULL};
    froe_scene *s = NULL;
    const froe_group first = {"a name", "a material that is a longer text than the name is", "left", "right", 7};
    enum { GROUPS = 60 };
    uint32_t id;
    assert_int_equal(froe_scene_new(2, &moving, &s), FROE_OK);
    assert_int_equal(froe_scene_add_group(s, &first, &id), FROE_OK);
    for (uint32_t i = 1; i < GROUPS; i++) {
        froe_group other = froe_scene_group(s, i - 1);
        if (i == 1) other.name += 2, other.left = other.material; /* parts of strings, too */
        assert_int_equal(froe_scene_add_group(s, &other, &id), FROE_OK);
    }
    for (uint32_t i = 1; i < GROUPS; i++) {
        const froe_group group = froe_scene_group(s, i);
        assert_string_equal(group.name, "name");
        assert_string_equal(group.material, first.material);
        assert_string_equal(group.left, first.material);
        assert_string_equal(group.right, "right");
        assert_int_equal(group.colour, 7);
    }
    froe_scene_free(s);
}

static void a_struct_that_is_not_from_defaults_is_refused(void **state) {
    (void)state;
    froe_scene *s = new_scene(2);
    const double xy[] = {0, 0};
    froe_objects zero = {0}, b = batch_of(FROE_POINT, 1, xy);
    refuse(s, zero, FROE_E_OPTIONS);
    b.size--;
    refuse(s, b, FROE_E_OPTIONS);
    froe_scene_free(s);
}

static void a_struct_from_before_it_had_threads_is_taken(void **state) {
    (void)state;
    froe_scene *s = new_scene(2);
    const double xy[] = {0, 0, 1, 1};
    froe_objects b = batch_of(FROE_POINT, 2, xy);
    b.size = offsetof(froe_objects, threads);
    b.threads = 0xdeadbeef; /* memory of the caller's behind the struct */
    add(s, b);
    assert_int_equal(froe_scene_object_count(s), 2);
    froe_scene_free(s);
}

static void wrong_arguments_are_refused(void **state) {
    (void)state;
    froe_scene *s = new_scene(2), *deep = new_scene(4);
    const double xy[] = {0, 0, 1, 1, 2, 0, 0, 0, 1, 1, 1, 1}, radius = 1;
    const size_t starts[] = {0, 1};
    froe_objects b = batch_of(FROE_POINT, 1, NULL);
    refuse(s, b, FROE_E_ARG);
    assert_int_equal(froe_scene_add(NULL, &b, NULL), FROE_E_ARG);
    assert_int_equal(froe_scene_add(s, NULL, NULL), FROE_E_ARG);
    refuse(s, batch_of((froe_kind)6, 1, xy), FROE_E_ARG);
    refuse(s, batch_of((froe_kind)-1, 1, xy), FROE_E_ARG);
    refuse(s, batch_of(FROE_BALL, 1, xy), FROE_E_ARG);
    b = batch_of(FROE_POINT, 1, xy);
    b.radii = &radius;
    refuse(s, b, FROE_E_ARG);
    b.radii = NULL;
    b.starts = starts;
    refuse(s, b, FROE_E_ARG);
    refuse(s, batch_of(FROE_POLYGON, 1, xy), FROE_E_UNSUPPORTED);
    refuse(deep, batch_of(FROE_POLYGON, 1, xy), FROE_E_UNSUPPORTED);
    add(deep, batch_of(FROE_BOX, 1, (const double[]){0, 0, 0, 0, 1, 1, 1, 1}));
    add(s, batch_of(FROE_SEGMENT, 0, NULL));
    froe_scene_free(s);
    froe_scene_free(deep);
}

static void offsets_must_ascend_by_enough_corners(void **state) {
    (void)state;
    froe_scene *s = new_scene(3);
    const double xyz[30] = {0};
    const size_t two[] = {0, 3, 5}, back[] = {0, 6, 3, 9}, none[] = {4, 4}, wrapped[] = {9, 3};
    const size_t endless[] = {0, SIZE_MAX};
    froe_objects b = batch_of(FROE_POLYGON, 2, xyz);
    b.starts = two;
    assert_int_equal(refuse(s, b, FROE_E_INPUT).object, 1);
    b.count = 3;
    b.starts = back;
    assert_int_equal(refuse(s, b, FROE_E_INPUT).object, 1);
    b.count = 1;
    b.starts = wrapped;
    refuse(s, b, FROE_E_INPUT);
    b.starts = endless;
    refuse(s, b, FROE_E_LIMIT);
    b.kind = FROE_HULL;
    b.starts = none;
    assert_int_equal(refuse(s, b, FROE_E_INPUT).object, 0);
    froe_scene_free(s);
}

static void more_than_the_limit_is_refused_before_anything_is_read(void **state) {
    (void)state;
    froe_scene *s = new_scene(2);
    const double xy[] = {0, 0};
    refuse(s, batch_of(FROE_POINT, 2147483647u, xy), FROE_E_LIMIT);
    refuse(s, batch_of(FROE_POINT, SIZE_MAX, xy), FROE_E_LIMIT);
    refuse(s, batch_of(FROE_HULL, 2000000000u, xy), FROE_E_LIMIT); /* 3 corners each */
    froe_scene_free(s);
}

static void numbers_that_are_not_finite_are_named(void **state) {
    (void)state;
    froe_scene *s = new_scene(3);
    double xyz[2 * 3 * 200];
    const double bad[] = {NAN, INFINITY, -INFINITY};
    for (size_t i = 0; i < 1200; i++) xyz[i] = (double)i;
    for (size_t i = 0; i < 1200; i += 37) {
        double old = xyz[i];
        xyz[i] = bad[i % 3];
        froe_diagnostic diag = refuse(s, batch_of(FROE_SEGMENT, 200, xyz), FROE_E_INPUT);
        assert_int_equal(diag.object, i / 6);
        assert_int_equal(diag.corner, i / 3 % 2);
        assert_int_equal(diag.axis, i % 3);
        xyz[i] = old;
    }
    add(s, batch_of(FROE_SEGMENT, 200, xyz));
    froe_scene_free(s);
}

static void boxes_and_balls_must_not_be_inside_out(void **state) {
    (void)state;
    froe_scene *s = new_scene(2);
    const double xy[] = {0, 0, 1, 1, 0, 2, 1, 1};
    froe_diagnostic diag = refuse(s, batch_of(FROE_BOX, 2, xy), FROE_E_INPUT);
    assert_int_equal(diag.object, 1);
    assert_int_equal(diag.axis, 1);
    const double bad[] = {-1, NAN, INFINITY, -5e-324};
    for (int i = 0; i < 4; i++) {
        const double radii[] = {1, bad[i]};
        froe_objects b = batch_of(FROE_BALL, 2, xy);
        b.radii = radii;
        assert_int_equal(refuse(s, b, FROE_E_INPUT).object, 1);
    }
    const double far[] = {DBL_MAX, 0}, radii[] = {DBL_MAX};
    froe_objects b = batch_of(FROE_BALL, 1, far);
    b.radii = radii;
    diag = refuse(s, b, FROE_E_INPUT);
    assert_int_equal(diag.axis, 0);
    b.radii = (const double[]){-0.0};
    add(s, b);
    froe_scene_free(s);
}

static void a_held_scene_is_frozen_until_it_is_let_go(void **state) {
    (void)state;
    froe_scene *s = new_scene(2);
    const double xy[] = {0, 0};
    const froe_group group = {.name = "late"};
    uint32_t id;
    scene_hold(s);
    refuse(s, batch_of(FROE_POINT, 1, xy), FROE_E_FROZEN);
    assert_int_equal(froe_scene_add_group(s, &group, &id), FROE_E_FROZEN);
    froe_scene_free(s);
    add(s, batch_of(FROE_POINT, 1, xy));
    assert_int_equal(froe_scene_add_group(s, &group, &id), FROE_OK);
    froe_scene_free(s);
}

static void extreme_coordinates_are_kept_exactly(void **state) {
    (void)state;
    froe_scene *s = new_scene(2);
    const double xy[] = {1e308, -1e308, 5e-324, -5e-324, DBL_MAX, DBL_MIN, 1e308, -1e308};
    double lo[2], hi[2];
    add(s, batch_of(FROE_SEGMENT, 2, xy));
    for (uint32_t i = 0; i < 4; i++)
        assert_memory_equal(froe_scene_vertex(s, froe_scene_corner(s, i / 2, i % 2)), xy + 2 * i, 16);
    assert_true(froe_scene_bounds(s, lo, hi));
    assert_true(lo[0] == 5e-324 && lo[1] == -1e308 && hi[0] == DBL_MAX && hi[1] == DBL_MIN);
    froe_scene_free(s);
}

static void balls_bound_outwards(void **state) {
    (void)state;
    froe_scene *s = new_scene(2);
    const double xy[] = {1, 0}, radius = 0x1p-60;
    double lo[2], hi[2];
    froe_objects b = batch_of(FROE_BALL, 1, xy);
    b.radii = &radius;
    add(s, b);
    froe_scene_bounds(s, lo, hi);
    assert_true(lo[0] == 1 - DBL_EPSILON / 2 && hi[0] == 1 + DBL_EPSILON);
    assert_true(lo[1] == -radius && hi[1] == radius); /* exact: not widened */
    scene_object_bounds(s, 0, lo, hi);
    assert_true(lo[0] == 1 - DBL_EPSILON / 2 && hi[0] == 1 + DBL_EPSILON);
    froe_scene_free(s);
}

/** Progress that says no at the n-th call. */
static bool stop_at(void *user, double done) {
    int *left = user;
    assert_true(done >= 0 && done <= 1);
    return --*left != 0;
}

static void cancelling_leaves_no_trace(void **state) {
    (void)state;
    froe_scene *s = new_scene(2);
    double xy[400];
    for (int i = 0; i < 400; i++) xy[i] = i * i % 97;
    for (int n = 1; n <= 3; n++) {
        int left = n;
        froe_objects b = batch_of(FROE_SEGMENT, 100, xy);
        b.progress = stop_at;
        b.user = &left;
        refuse(s, b, FROE_E_CANCELLED);
    }
    assert_int_equal(s->store->table.count, 0);
    for (size_t i = 0; i < s->store->table.size; i++) assert_int_equal(s->store->table.slots[i].next_id, 0);
    add(s, batch_of(FROE_SEGMENT, 100, xy));
    froe_scene_free(s);
}

static void a_refused_batch_leaves_the_vertex_table_as_it_was(void **state) {
    (void)state;
    froe_scene *s = new_scene(2);
    double xy[2 * 1000];
    for (size_t i = 0; i < 2000; i++) xy[i] = (double)(i * i * 31 % 1009);
    for (size_t n = 100; n <= 900; n += 100) {
        double old = xy[2 * n];
        xy[2 * n] = NAN;
        refuse(s, batch_of(FROE_POINT, 1000, xy), FROE_E_INPUT);
        xy[2 * n] = old;
        size_t before = froe_scene_vertex_count(s);
        add(s, batch_of(FROE_POINT, n, xy));
        size_t after = froe_scene_vertex_count(s);
        add(s, batch_of(FROE_POINT, n, xy));
        assert_int_equal(froe_scene_vertex_count(s), after);
        assert_true(after > before);
    }
    for (uint32_t i = 0; i < s->vertex_count; i++)
        for (uint32_t j = 0; j < i; j++) assert_memory_not_equal(scene_vertex(s, i), scene_vertex(s, j), 16);
    froe_scene_free(s);
}

static void a_million_segments_load_and_share_vertices(void **state) {
    (void)state;
    enum { SIDE = 1000 };
    size_t count = (size_t)SIDE * SIDE;
    double *xy = malloc(count * 4 * sizeof *xy);
    assert_non_null(xy);
    for (size_t i = 0; i < count; i++) {
        double x = (double)(i % SIDE), y = (double)(i / SIDE);
        double edge[] = {x, y, x + 1, y};
        memcpy(xy + 4 * i, edge, sizeof edge);
    }
    froe_scene *s = new_scene(2);
    add(s, batch_of(FROE_SEGMENT, count, xy));
    assert_int_equal(froe_scene_object_count(s), count);
    assert_int_equal(froe_scene_vertex_count(s), SIDE * (SIDE + 1));
    for (size_t i = 0; i < count; i += 997)
        assert_memory_equal(scene_point(s, (uint32_t)i, 1), xy + 4 * i + 2, 2 * sizeof *xy);
    froe_scene_free(s);
    free(xy);
}

static froe_status fill(void *user, const froe_allocator *alloc) {
    (void)user;
    froe_scene *s;
    froe_status status = froe_scene_new(2, alloc, &s);
    if (status) return status;
    double xy[800];
    uint64_t tags[100];
    uint32_t faces[100];
    for (int i = 0; i < 800; i++) xy[i] = i * i % 101;
    for (uint32_t i = 0; i < 100; i++) tags[i] = i, faces[i] = i;
    const froe_group group = {"n", "m", "l", "r", 0x11223344};
    froe_objects b = batch_of(FROE_SEGMENT, 100, xy);
    for (int round = 0; round < 2 && !status; round++) {
        size_t objects = froe_scene_object_count(s), vertices = froe_scene_vertex_count(s);
        size_t groups = froe_scene_group_count(s);
        status = froe_scene_add_group(s, &group, &b.group);
        assert_int_equal(froe_scene_group_count(s), groups + (status == FROE_OK));
        if (status) break;
        b.tags = tags;
        b.faces = faces;
        status = froe_scene_add(s, &b, NULL);
        assert_int_equal(froe_scene_object_count(s), objects + (status ? 0 : 100));
        if (status) {
            assert_int_equal(froe_scene_vertex_count(s), vertices);
            assert_int_equal(s->tags == NULL, objects == 0);
        }
        b.coords += 400;
    }
    froe_scene_free(s);
    return status;
}

static void every_failing_allocation_is_survived(void **state) {
    (void)state;
    assert_true(test_memory_each(fill, NULL) > 10);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(dimensions_from_2_to_8_exist),
        cmocka_unit_test(equal_points_share_a_vertex_and_minus_zero_is_zero),
        cmocka_unit_test(objects_say_what_they_were_and_what_they_are),
        cmocka_unit_test(hulls_keep_each_vertex_once_in_ascending_order),
        cmocka_unit_test(indices_and_starts_select_corners),
        cmocka_unit_test(labels_appear_with_the_first_object_that_has_them),
        cmocka_unit_test(groups_may_have_the_strings_of_others),
        cmocka_unit_test(a_struct_that_is_not_from_defaults_is_refused),
        cmocka_unit_test(a_struct_from_before_it_had_threads_is_taken),
        cmocka_unit_test(wrong_arguments_are_refused),
        cmocka_unit_test(offsets_must_ascend_by_enough_corners),
        cmocka_unit_test(more_than_the_limit_is_refused_before_anything_is_read),
        cmocka_unit_test(numbers_that_are_not_finite_are_named),
        cmocka_unit_test(boxes_and_balls_must_not_be_inside_out),
        cmocka_unit_test(a_held_scene_is_frozen_until_it_is_let_go),
        cmocka_unit_test(extreme_coordinates_are_kept_exactly),
        cmocka_unit_test(balls_bound_outwards),
        cmocka_unit_test(cancelling_leaves_no_trace),
        cmocka_unit_test(a_refused_batch_leaves_the_vertex_table_as_it_was),
        cmocka_unit_test(a_million_segments_load_and_share_vertices),
        cmocka_unit_test(every_failing_allocation_is_survived),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
