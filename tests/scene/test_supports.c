/* Supports, planes of cuts, equal objects, and scenes over arrays that may lie. */
#include "support/memory.h"

#include "base/random.h"
#include "geom/predicates.h"
#include "scene/scene.h"
#include <math.h>
#include <string.h>

static froe_scene *new_scene(int dim) {
    froe_scene *s = NULL;
    assert_int_equal(froe_scene_new(dim, NULL, &s), FROE_OK);
    return s;
}

static void add(froe_scene *s, froe_kind kind, size_t count, const double *coords, const size_t *starts) {
    froe_objects b = froe_objects_defaults();
    b.kind = kind;
    b.count = count;
    b.coords = coords;
    b.starts = starts;
    assert_int_equal(froe_scene_add(s, &b, NULL), FROE_OK);
}

static void add_balls(froe_scene *s, size_t count, const double *coords, const double *radii) {
    froe_objects b = froe_objects_defaults();
    b.kind = FROE_BALL;
    b.count = count;
    b.coords = coords;
    b.radii = radii;
    assert_int_equal(froe_scene_add(s, &b, NULL), FROE_OK);
}

/* ---------------------------------------------------------------- supports -- */

static num_context context;

static int begin_context(void **state) {
    (void)state;
    froe_allocator alloc = support_allocator(NULL);
    return num_context_new(&alloc, &context) != FROE_OK;
}

static int end_context(void **state) {
    (void)state;
    num_context_free(&context);
    return 0;
}

/** Every corner of the object lies in its support, which is a plane. */
static froe_cut check_support(const froe_scene *s, uint32_t object) {
    geom_plane plane;
    froe_cut cut = scene_support(s, object, &plane);
    assert_int_not_equal(cut.kind, FROE_CUT_NONE);
    assert_true(geom_plane_valid(&context, &plane));
    for (uint32_t i = 0; i < scene_corners(s, object); i++)
        assert_int_equal(geom_side_vertex(&context, &plane, scene_point(s, object, i)), 0);
    return cut;
}

static void objects_lie_in_their_supports(void **state) {
    (void)state;
    froe_scene *s = new_scene(2);
    add(s, FROE_SEGMENT, 3, (const double[]){0, 0, 3, 1, 2, 2, 2, 2, 0, 0, 0, 5}, NULL);
    add(s, FROE_POINT, 1, (const double[]){7, 8}, NULL);
    assert_int_equal(check_support(s, 0).kind, FROE_CUT_OBJECT);
    assert_int_equal(check_support(s, 1).kind, FROE_CUT_AXIS);
    assert_int_equal(check_support(s, 2).kind, FROE_CUT_OBJECT);
    assert_int_equal(check_support(s, 3).kind, FROE_CUT_AXIS);
    geom_plane left;
    scene_support(s, 0, &left);
    assert_int_equal(geom_side_vertex(&context, &left, (const double[]){0, 1}), 1);
    froe_scene_free(s);

    s = new_scene(3);
    add(s, FROE_SEGMENT, 4, (const double[]){0, 0, 0, 1, 2, 3, /**/ 1, 1, 0, 1, 1, 5, /**/ 0, 1, 0, 2, 2, 0, /**/
                                             4, 4, 4, 4, 4, 4},
        NULL);
    add(s, FROE_POLYGON, 3, (const double[]){0, 0, 0, 1, 0, 0, 0, 1, 0, /**/ 0, 0, 0, 1, 1, 1, 2, 2, 2, /**/
                                             5, 5, 5, 5, 5, 5, 5, 5, 5},
        NULL);
    const froe_cut_kind kinds[] = {FROE_CUT_EDGE,   FROE_CUT_AXIS, FROE_CUT_AXIS, FROE_CUT_AXIS,
                                   FROE_CUT_OBJECT, FROE_CUT_EDGE, FROE_CUT_AXIS};
    for (uint32_t i = 0; i < 7; i++) assert_int_equal(check_support(s, i).kind, kinds[i]);
    assert_int_equal(check_support(s, 2).axis, 2);
    scene_support(s, 4, &left);
    assert_int_equal(geom_side_vertex(&context, &left, (const double[]){0, 0, 1}), 1);
    froe_scene_free(s);
}

static void boxes_balls_and_hulls_have_no_support(void **state) {
    (void)state;
    froe_scene *s = new_scene(3);
    const double xyz[] = {0, 0, 0, 1, 1, 1, 2, 2, 2}, radius = 1;
    geom_plane plane;
    add(s, FROE_BOX, 1, xyz, NULL);
    add(s, FROE_HULL, 1, xyz, NULL);
    add_balls(s, 1, xyz, &radius);
    for (uint32_t i = 0; i < 3; i++) assert_int_equal(scene_support(s, i, &plane).kind, FROE_CUT_NONE);
    froe_scene_free(s);
}

static void cuts_name_their_planes(void **state) {
    (void)state;
    froe_scene *s = new_scene(3);
    const double normal[] = {1, 2, 3};
    add(s, FROE_POLYGON, 1, (const double[]){1, 2, 3, 4, 4, 6, 7, 8, 8}, NULL);
    const froe_cut vertices = {.kind = FROE_CUT_VERTICES, .id = {0, 1, 2}},
                   edge = {.kind = FROE_CUT_EDGE, .id = {2, 0}};
    const froe_cut vector = {.kind = FROE_CUT_PLANE, .normal = normal, .value = 14};
    geom_plane a = scene_cut_plane(s, &vertices), b = scene_cut_plane(s, &edge), c = scene_cut_plane(s, &vector);
    const double *p = scene_vertex(s, 0), *r = scene_vertex(s, 2);
    assert_int_equal(geom_side_vertex(&context, &a, r), 0);
    assert_int_equal(geom_side_vertex(&context, &b, (const double[]){1, 2, 99}), 0);
    assert_int_equal(geom_side_vertex(&context, &b, r), 0);
    assert_int_equal(geom_side_vertex(&context, &c, p), 0);
    assert_int_equal(geom_side_vertex(&context, &c, r), 1);
    froe_scene_free(s);
}

/* --------------------------------------------------------------- originals -- */

static void equal_objects_find_their_first(void **state) {
    (void)state;
    froe_scene *s = new_scene(3);
    const double a[] = {0, 0, 0}, b[] = {1, 1, 1};
    double ab[6], ba[6];
    memcpy(ab, a, 24), memcpy(ab + 3, b, 24), memcpy(ba, b, 24), memcpy(ba + 3, a, 24);
    add(s, FROE_SEGMENT, 1, ab, NULL);                                 /* 0 */
    add(s, FROE_SEGMENT, 1, ba, NULL);                                 /* 1 = 0 */
    add(s, FROE_BOX, 1, ab, NULL);                                     /* 2 */
    add(s, FROE_POINT, 1, a, NULL);                                    /* 3 */
    add(s, FROE_SEGMENT, 1, (const double[]){0, 0, 0, 0, 0, 0}, NULL); /* 4 = 3: a zero-length segment is a point */
    add_balls(s, 3, (const double[]){0, 0, 0, 0, 0, 0, 0, 0, 0}, (const double[]){1, 2, 1}); /* 5, 6, 7 = 5 */
    add(s, FROE_POLYGON, 4,
        (const double[]){0, 0, 0, 1, 0, 0, 1, 1, 0, 0,      1, 0, /**/ 1, 1, 0, 1, 0, 0, 0, 0, 0, 0, 1, 0, /**/
                         0, 0, 0, 1, 0, 0, 1, 1, 0, /**/ 1, 1, 1, 0,      0, 0, 1, 1, 1},
        (const size_t[]){0, 4, 8, 11, 14}); /* 8, 9 = 8, 10, 11 = 0: a flat polygon is a segment */
    add(s, FROE_HULL, 2, (const double[]){1, 1, 1, 0, 0, 0, 0, 0, 0, 1, 1, 1}, (const size_t[]){0, 2, 4}); /* 12, 13 */
    const uint32_t expected[] = {0, 0, 2, 3, 3, 5, 6, 5, 8, 8, 10, 0, 12, 12};
    uint32_t out[14];
    assert_int_equal(scene_originals(s, &s->alloc, out), FROE_OK);
    assert_memory_equal(out, expected, sizeof out);
    froe_scene_free(s);
}

static void originals_agree_with_comparing_all_pairs(void **state) {
    (void)state;
    enum { N = 3000 };
    froe_scene *s = new_scene(2);
    double xy[4 * N];
    for (size_t i = 0; i < 4 * N; i++) xy[i] = base_below(base_hash(3, i, 0), 6);
    add(s, FROE_SEGMENT, N, xy, NULL);
    uint32_t out[N];
    assert_int_equal(scene_originals(s, &s->alloc, out), FROE_OK);
    for (uint32_t i = 0; i < N; i++) {
        uint32_t first = 0;
        while (!scene_equal(s, first, i)) first++;
        assert_int_equal(out[i], first);
    }
    froe_scene_free(s);
}

/* ------------------------------------------------------------------ mapped -- */

/** A scene with something of everything. */
static froe_scene *motley(void) {
    froe_scene *s = new_scene(3);
    const froe_group group = {.name = "roof", .material = "slate"};
    uint32_t id;
    assert_int_equal(froe_scene_add_group(s, &group, &id), FROE_OK);
    add(s, FROE_POINT, 1, (const double[]){1, 2, 3}, NULL);
    add(s, FROE_SEGMENT, 2, (const double[]){1, 2, 3, 4, 5, 6, 7, 7, 7, 7, 7, 7}, NULL);
    add(s, FROE_POLYGON, 2, (const double[]){0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0, 0, 0, 0, 1, 1, 1, 3, 3, 3},
        (const size_t[]){0, 4, 7});
    add(s, FROE_BOX, 1, (const double[]){-1, 0, 0, 4, 4, 4}, NULL);
    add_balls(s, 2, (const double[]){0, 0, 0, 9, 9, 9}, (const double[]){1, 0.25});
    add(s, FROE_HULL, 1, (const double[]){0, 0, 0, 5, 0, 0, 0, 5, 0}, NULL);
    froe_objects b = froe_objects_defaults();
    b.kind = FROE_POINT;
    b.count = 1;
    b.coords = (const double[]){0, 0, 1};
    b.group = 0;
    assert_int_equal(froe_scene_add(s, &b, NULL), FROE_OK);
    return s;
}

/* The scene over those arrays, checked whole. */
static froe_status map_whole(const froe_scene *arrays, const froe_allocator *alloc, froe_scene **out,
                             froe_diagnostic *diag) {
    froe_status status = scene_mapped(arrays, alloc, out, diag);
    if (!status) status = froe_scene_check(*out, diag);
    if (status && *out) froe_scene_free(*out);
    return status;
}

static void a_mapped_scene_reads_like_the_one_it_came_from(void **state) {
    (void)state;
    froe_scene *s = motley(), *m = NULL;
    test_memory memory;
    froe_allocator alloc = test_memory_begin(&memory);
    assert_int_equal(map_whole(s, &alloc, &m, NULL), FROE_OK);
    double lo[2][3], hi[2][3];
    froe_scene_bounds(s, lo[0], hi[0]);
    froe_scene_bounds(m, lo[1], hi[1]);
    assert_memory_equal(lo[0], lo[1], sizeof lo[0]);
    assert_memory_equal(hi[0], hi[1], sizeof hi[0]);
    for (uint32_t i = 0; i < froe_scene_object_count(s); i++) {
        froe_object a = froe_scene_object(s, i), b = froe_scene_object(m, i);
        assert_true(a.kind == b.kind && a.form == b.form && a.corners == b.corners && a.radius == b.radius);
        assert_true(a.face == b.face && a.group == b.group && a.tag == b.tag);
    }
    froe_objects b = froe_objects_defaults();
    froe_group group = {0};
    assert_int_equal(froe_scene_add(m, &b, NULL), FROE_E_FROZEN);
    assert_int_equal(froe_scene_add_group(m, &group, NULL), FROE_E_FROZEN);
    froe_scene_free(m);
    test_memory_end(&memory);
    froe_scene_free(s);
}

static void *copy(const void *from, size_t size) {
    void *to = malloc(size ? size : 1);
    assert_non_null(to);
    if (size) memcpy(to, from, size);
    return to;
}

/** A copy whose arrays are exactly as large as the counts say, so that reading past them shows. */
static froe_scene exact_copy(const froe_scene *s) {
    froe_scene c = *s;
    c.coords = copy(s->coords, (size_t)s->vertex_count * (size_t)s->dim * 8);
    c.kind_of = copy(s->kind_of, s->object_count);
    c.form_of = copy(s->form_of, s->object_count);
    c.start_of = copy(s->start_of, 4 * ((size_t)s->object_count + 1));
    c.vertex_of = copy(s->vertex_of, 4 * (size_t)s->corner_count);
    c.radii = copy(s->radii, 8 * (size_t)s->radius_count);
    c.groups = copy(s->groups, 4 * (size_t)s->object_count);
    c.group_table = copy(s->group_table, sizeof(scene_group) * s->group_count);
    c.text = copy(s->text, s->text_size);
    return c;
}

static void free_copy(froe_scene *c) {
    free(c->coords), free(c->kind_of), free(c->form_of), free(c->start_of), free(c->vertex_of);
    free(c->radii), free(c->groups), free(c->group_table), free(c->text);
}

/** Whatever is accepted must be safe to use. */
static void use(const froe_scene *s) {
    double lo[8], hi[8];
    uint32_t *originals = malloc(4 * (size_t)s->object_count + 1);
    assert_non_null(originals);
    froe_allocator alloc = support_allocator(NULL);
    assert_int_equal(scene_originals(s, &alloc, originals), FROE_OK);
    for (uint32_t i = 0; i < s->object_count; i++) {
        geom_plane plane;
        froe_object o = froe_scene_object(s, i);
        scene_object_bounds(s, i, lo, hi);
        if (scene_support(s, i, &plane).kind) assert_true(geom_plane_valid(&context, &plane));
        for (uint32_t c = 0; c < o.corners; c++) assert_non_null(froe_scene_vertex(s, froe_scene_corner(s, i, c)));
        froe_group g = froe_scene_group(s, o.group);
        assert_true(strlen(g.name) + strlen(g.material) + strlen(g.left) + strlen(g.right) < 1000);
    }
    free(originals);
}

/** Overwrites 1, 4 or 8 bytes somewhere in the arrays. */
static void corrupt(froe_scene *c, uint64_t hash) {
    const struct {
        void *data;
        size_t size;
    } arrays[] = {{c->coords, (size_t)c->vertex_count * 24},
                  {c->kind_of, c->object_count},
                  {c->form_of, c->object_count},
                  {c->start_of, 4 * ((size_t)c->object_count + 1)},
                  {c->vertex_of, 4 * (size_t)c->corner_count},
                  {c->radii, 8 * (size_t)c->radius_count},
                  {c->groups, 4 * (size_t)c->object_count},
                  {c->group_table, sizeof(scene_group) * c->group_count},
                  {c->text, c->text_size}};
    const double doubles[] = {NAN, INFINITY, -0.0, 1e308, -1, 0};
    uint32_t pick = base_below(hash, 9), small = base_below(base_mix(hash + 1), 20);
    size_t unit = pick == 0 || pick == 5 ? 8 : pick == 1 || pick == 2 || pick == 8 ? 1 : 4;
    size_t at = base_below(base_mix(hash + 2), (uint32_t)(arrays[pick].size / unit)) * unit;
    if (hash % 5 == 0) small = UINT32_MAX - small;
    const void *value = unit == 8 ? (const void *)(doubles + small % 6) : (const void *)&small;
    memcpy((char *)arrays[pick].data + at, value, unit);
}

static void corrupted_arrays_are_refused_or_harmless(void **state) {
    (void)state;
    froe_scene *s = motley();
    size_t refused = 0, accepted = 0;
    for (uint64_t round = 0; round < 4000; round++) {
        froe_scene c = exact_copy(s), *m = NULL;
        froe_diagnostic diag;
        for (uint64_t i = 0; i <= round % 3; i++) corrupt(&c, base_hash(5, round, i));
        froe_status status = map_whole(&c, NULL, &m, &diag);
        assert_true(status == FROE_OK || status == FROE_E_FORMAT);
        if (status) {
            assert_non_null(strstr(diag.message, "corrupted"));
            refused++;
        } else {
            use(m);
            froe_scene_free(m);
            accepted++;
        }
        free_copy(&c);
    }
    assert_true(refused > 2000 && accepted > 100);
    froe_scene_free(s);
}

static void missing_parts_and_wrong_counts_are_refused(void **state) {
    (void)state;
    froe_scene *s = motley(), *m, c;
    for (int fault = 0; fault < 17; fault++) {
        c = *s;
        if (fault == 0) c.dim = 9;
        if (fault == 1) c.dim = 1;
        if (fault == 2) c.object_count = UINT32_MAX;
        if (fault == 3) c.vertex_count = 0;
        if (fault == 4) c.corner_count--;
        if (fault == 5) c.text_size--;
        if (fault == 6) c.kind_of = NULL;
        if (fault == 7) c.start_of = NULL;
        if (fault == 8) c.text_size = 0;
        if (fault == 9) c.vertex_count = UINT32_MAX;
        if (fault == 10) c.group_count = UINT32_MAX;
        if (fault == 11) c.corner_count = UINT32_MAX;
        if (fault == 12) c.coords = NULL;
        if (fault == 13) c.radii = NULL;
        if (fault == 14) c.group_table = NULL;
        if (fault == 15) c.text = NULL;
        if (fault == 16) c.form_of = NULL;
        m = NULL;
        assert_int_equal(map_whole(&c, NULL, &m, NULL), FROE_E_FORMAT);
    }
    froe_scene_free(s);
}

static froe_status map_and_compare(void *user, const froe_allocator *alloc) {
    const froe_scene *s = user;
    froe_scene *m = NULL;
    uint32_t originals[16];
    froe_status status = map_whole(s, alloc, &m, NULL);
    if (status) return status;
    status = scene_originals(m, alloc, originals);
    froe_scene_free(m);
    return status;
}

static froe_status add_polygons(void *user, const froe_allocator *alloc) {
    (void)user;
    froe_scene *s;
    froe_status status = froe_scene_new(3, alloc, &s);
    if (status) return status;
    froe_objects b = froe_objects_defaults();
    b.count = 1;
    b.coords = (const double[]){0, 0, 0, 1, 0, 0, 0, 1, 0};
    status = froe_scene_add(s, &b, NULL);
    assert_int_equal(froe_scene_object_count(s), status == FROE_OK);
    if (status) assert_int_equal(froe_scene_vertex_count(s), 0);
    froe_scene_free(s);
    return status;
}

static void every_failing_allocation_is_survived(void **state) {
    (void)state;
    froe_scene *s = motley();
    assert_true(test_memory_each(map_and_compare, s) >= 4);
    assert_true(test_memory_each(add_polygons, NULL) >= 5);
    froe_scene_free(s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(objects_lie_in_their_supports),
        cmocka_unit_test(boxes_balls_and_hulls_have_no_support),
        cmocka_unit_test(cuts_name_their_planes),
        cmocka_unit_test(equal_objects_find_their_first),
        cmocka_unit_test(originals_agree_with_comparing_all_pairs),
        cmocka_unit_test(a_mapped_scene_reads_like_the_one_it_came_from),
        cmocka_unit_test(corrupted_arrays_are_refused_or_harmless),
        cmocka_unit_test(missing_parts_and_wrong_counts_are_refused),
        cmocka_unit_test(every_failing_allocation_is_survived),
    };
    return cmocka_run_group_tests(tests, begin_context, end_context);
}
