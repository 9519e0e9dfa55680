/* test_rare.c: what scenes of ordinary sizes reach by chance at most: full tables, equal hashes, wrong arguments, edges
 * by number, and memory that ends while many polygons are looked at. */
#include "scene/polygon.h"
#include "scene/store.h"
#include "scene/table.h"
#include "support/memory.h"
#include <math.h>
#include <string.h>

enum { MANY = 200000 };

static froe_scene *new_scene(int dim) {
    froe_scene *s;
    assert_int_equal(froe_scene_new(dim, NULL, &s), FROE_OK);
    return s;
}

static froe_status add(froe_scene *s, froe_kind kind, size_t count, const double *coords, const size_t *starts,
                       const double *radii) {
    froe_objects b = froe_objects_defaults();
    b.kind = kind, b.count = count, b.coords = coords, b.starts = starts, b.radii = radii;
    return froe_scene_add(s, &b, NULL);
}

/* ------------------------------------------------------------------------- hashes -- */

static void a_table_that_no_memory_could_hold_is_refused(void **state) {
    scene_table table = {.count = 5};
    (void)state;
    const froe_allocator alloc = support_allocator(NULL);
    assert_false(scene_table_reserve(&alloc, &table, SIZE_MAX));
    assert_false(scene_table_reserve(&alloc, &table, SIZE_MAX - 5));
    assert_int_equal(table.size, 0);
}

static int by_tag(const void *a, const void *b) {
    const uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

/* Among 200,000 points some have equal tags of 32 bits. Each is found again by itself, and is its own original. */
static void points_with_equal_tags_stay_apart(void **state) {
    (void)state;
    double *x = malloc(2 * MANY * sizeof *x);
    uint64_t *tags = malloc(MANY * sizeof *tags);
    uint32_t *original = malloc(MANY * sizeof *original), collisions = 0;
    froe_scene *s = new_scene(2);
    assert_true(x && tags && original);
    for (uint32_t i = 0; i < MANY; i++) {
        x[2 * i] = i % 1000, x[2 * i + 1] = i / 1000;
        tags[i] = (uint64_t)scene_vertex_tag(x + 2 * (size_t)i, 2) << 32 | i;
    }
    assert_int_equal(add(s, FROE_POINT, MANY, x, NULL, NULL), FROE_OK);
    assert_int_equal(scene_originals(s, &s->alloc, original), FROE_OK);
    for (uint32_t i = 0; i < MANY; i++) assert_int_equal(original[i], i);
    qsort(tags, MANY, sizeof *tags, by_tag);
    for (uint32_t i = 1; i < MANY; i++) {
        if (tags[i] >> 32 != tags[i - 1] >> 32) continue;
        for (uint32_t j = i - 1; j <= i; j++) { /* alone, through the table that is made of all vertices */
            const uint32_t point = (uint32_t)tags[j], object = s->object_count;
            assert_int_equal(add(s, FROE_POINT, 1, x + 2 * (size_t)point, NULL, NULL), FROE_OK);
            assert_int_equal(froe_scene_corner(s, object, 0), point);
        }
        collisions++;
    }
    assert_true(collisions >= 2);
    assert_int_equal(s->vertex_count, MANY);
    froe_scene *m, c; /* as a file has it: its vertices are found to be different */
    assert_int_equal(scene_explicit(s, &s->alloc, &c), FROE_OK);
    assert_int_equal(scene_mapped(&c, NULL, &m, NULL), FROE_OK);
    assert_int_equal(froe_scene_check(m, NULL), FROE_OK);
    froe_scene_free(m);
    scene_explicit_free(s, &s->alloc, &c);
    froe_scene_free(s);
    free(x), free(tags), free(original);
}

static void equal_objects_have_equal_forms_corners_and_radii(void **state) {
    (void)state;
    froe_scene *s = new_scene(2);
    assert_int_equal(add(s, FROE_BALL, 3, (const double[]){0, 0, 0, 0, 1, 1}, NULL, (const double[]){1, 2, 1}),
                     FROE_OK);
    assert_int_equal(add(s, FROE_SEGMENT, 2, (const double[]){0, 0, 1, 1, 1, 1, 0, 0}, NULL, NULL), FROE_OK);
    assert_int_equal(add(s, FROE_HULL, 1, (const double[]){0, 0, 1, 1, 1, 0}, (const size_t[]){0, 3}, NULL), FROE_OK);
    for (uint32_t a = 0; a < 6; a++)
        for (uint32_t b = 0; b < 6; b++)
            assert_int_equal(scene_equal(s, a, b), a == b || (a >= 3 && a < 5 && b >= 3 && b < 5));
    assert_int_equal(add(s, FROE_HULL, 1, (const double[]){0, 0, 1, 1}, (const size_t[]){0, 2}, NULL), FROE_OK);
    assert_false(scene_equal(s, 5, 6)); /* which begins like the other, and has fewer corners */
    assert_false(scene_equal(s, 6, 5));
    froe_scene_free(s);
}

/* Where no filter is trusted, exact numbers tell what is a triangle, and it comes out the same. */
static void forms_do_not_depend_on_trust_in_filters(void **state) {
    static const double coords[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 5, 2, 0, 5, 1, 0, 5, 0, 0, 9, 1, 1, 9, 1, 1, 9};
    static const froe_kind forms[] = {FROE_POLYGON, FROE_SEGMENT, FROE_SEGMENT};
    (void)state;
    for (int count = 1; count <= 3; count += 2)
        for (int trusted = 0; trusted < 2; trusted++) {
            froe_scene *s = new_scene(3);
            s->store->trusted = trusted;
            assert_int_equal(add(s, FROE_POLYGON, (size_t)count, coords, (const size_t[]){0, 3, 6, 9}, NULL), FROE_OK);
            for (uint32_t i = 0; i < (uint32_t)count; i++) assert_int_equal(froe_scene_object(s, i).form, forms[i]);
            assert_int_equal(s->store->context_ready, !trusted || count > 1);
            froe_scene_free(s);
        }
}

/* ----------------------------------------------------------------------- arguments -- */

static void wrong_arguments_are_refused(void **state) {
    (void)state;
    froe_scene *none = new_scene(3);
    assert_int_equal(add(none, FROE_POLYGON, 0, (const double[]){0}, (const size_t[]){0}, NULL), FROE_OK);
    assert_int_equal(froe_scene_object_count(none), 0);
    froe_scene_free(none);
    froe_scene *s = new_scene(3), *flat = new_scene(2);
    const froe_group group = {.name = "a"};
    uint32_t id = 9, ends[2];
    assert_null(froe_kind_name(FROE_KIND_COUNT));
    assert_int_equal(froe_scene_set_up(NULL, 1), FROE_E_ARG);
    assert_int_equal(froe_scene_set_up(flat, 1), FROE_E_ARG);
    assert_int_equal(froe_scene_set_up(s, -1), FROE_E_ARG);
    assert_int_equal(froe_scene_set_up(s, 3), FROE_E_ARG);
    assert_int_equal(froe_scene_set_up(s, 1), FROE_OK);
    assert_int_equal(s->up, 1);
    scene_hold(s);
    assert_int_equal(froe_scene_set_up(s, 0), FROE_E_FROZEN);
    assert_int_equal(s->up, 1);
    froe_scene_free(s);
    assert_int_equal(froe_scene_add_group(NULL, &group, &id), FROE_E_ARG);
    assert_int_equal(froe_scene_add_group(s, NULL, &id), FROE_E_ARG);
    assert_int_equal(froe_scene_check(NULL, NULL), FROE_E_ARG);
    assert_false(froe_scene_edge(s, 0, ends));
    froe_scene_free(s);
    froe_scene_free(flat);
}

/* As if so many were there. */
static void more_groups_than_numbers_are_refused(void **state) {
    (void)state;
    froe_scene *s = new_scene(2);
    const froe_group group = {.name = "a"};
    uint32_t id = 9;
    assert_int_equal(froe_scene_add_group(s, &group, &id), FROE_OK);
    s->store->group_table.count = SCENE_LIMIT;
    assert_int_equal(froe_scene_add_group(s, &group, &id), FROE_E_LIMIT);
    s->store->group_table.count = 1;
    const size_t text = s->store->text.count;
    s->store->text.count = UINT32_MAX - 1;
    assert_int_equal(froe_scene_add_group(s, &group, &id), FROE_E_LIMIT);
    s->store->text.count = text;
    assert_int_equal(id, 0);
    assert_int_equal(froe_scene_group_count(s), 1);
    froe_scene_free(s);
}

static void strings_of_a_coordinate_system_end(void **state) {
    (void)state;
    assert_true(scene_crs_fits(FROE_CRS_GEOGRAPHIC, "a\0b\0c\0d", 8));
    assert_false(scene_crs_fits(FROE_CRS_GEOGRAPHIC, "a\0b\0c\0d\0e", 9));
    assert_false(scene_crs_fits(FROE_CRS_GEOGRAPHIC, "a\0b\0c", 6));
    assert_false(scene_crs_fits(FROE_CRS_KIND_COUNT, "a\0b\0c\0d", 8));
    assert_false(scene_crs_fits(FROE_CRS_UNKNOWN, "a", 2));
}

/* -------------------------------------------------------------------------- edges -- */

/* Objects of 1 to 6 corners: the object of each corner, and its edge. */
static void every_edge_is_found_by_its_number(void **state) {
    (void)state;
    froe_scene *s = new_scene(3);
    double coords[60 * 3];
    size_t starts[11] = {0}, corners = 0;
    for (size_t j = 0; j < 10; j++) { /* convex polygons of 3 to 6 corners on a parabola */
        for (size_t i = 0; i < 3 + j % 4; i++, corners++) {
            const double t = (double)i;
            coords[3 * corners] = t, coords[3 * corners + 1] = t * t, coords[3 * corners + 2] = (double)j;
        }
        starts[j + 1] = corners;
    }
    assert_int_equal(add(s, FROE_POLYGON, 10, coords, starts, NULL), FROE_OK);
    assert_int_equal(add(s, FROE_POINT, 2, coords, NULL, NULL), FROE_OK);
    assert_int_equal(add(s, FROE_SEGMENT, 1, coords, NULL, NULL), FROE_OK);
    for (uint32_t j = 0, edge = 0; j < s->object_count; j++) {
        const uint32_t count = scene_corners(s, j);
        scene_ask_points(s, j);
        for (uint32_t i = 0; i < count; i++, edge++) {
            uint32_t ends[2] = {FROE_NONE, FROE_NONE};
            assert_int_equal(scene_object_of(s, edge), j);
            assert_int_equal(froe_scene_edge(s, edge, ends), count > 1);
            assert_true(count == 1 ||
                        (ends[0] == scene_corner(s, j, i) && ends[1] == scene_corner(s, j, (i + 1) % count)));
        }
    }
    assert_false(froe_scene_edge(s, s->corner_count, (uint32_t[2]){0}));
    froe_scene_free(s);
}

/* A scene of polygons over arrays that a file could hold, with some of them wrong. */
static void edges_of_wrong_objects_do_not_exist(void **state) {
    (void)state;
    froe_scene *s = new_scene(3), *m, c;
    uint32_t ends[2];
    assert_int_equal(add(s, FROE_POLYGON, 3, (const double[]){0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 2, 0, 0,
                                                              3, 0, 0, 3, 1, 0, 2, 0, 5, 3, 0, 5, 3, 1, 5},
                         (const size_t[]){0, 4, 7, 10}, NULL),
                     FROE_OK);
    assert_int_equal(scene_explicit(s, &s->alloc, &c), FROE_OK);
    uint32_t starts[4], vertices[10];
    for (int wrong = 0; wrong < 5; wrong++) {
        memcpy(starts, c.start_of, sizeof starts);
        memcpy(vertices, c.vertex_of, sizeof vertices);
        if (wrong == 1) starts[0] = 5; /* before the first object, and behind the last one */
        if (wrong == 2) starts[3] = 8;
        if (wrong == 3) vertices[5] = 77;
        froe_scene arrays = c;
        arrays.start_of = starts, arrays.vertex_of = vertices;
        if (wrong == 4) arrays.object_count = 0;
        assert_int_equal(scene_mapped(&arrays, NULL, &m, NULL), FROE_OK);
        size_t found = 0;
        for (uint32_t edge = 0; edge < 10; edge++)
            if (froe_scene_edge(m, edge, ends)) {
                assert_true(ends[0] < 10 && ends[1] < 10);
                found++;
            }
        assert_true(wrong ? found < 10 : found == 10);
        if (wrong == 3) assert_int_equal(found, 7);
        froe_diagnostic why;
        assert_int_equal(froe_scene_check(m, NULL), wrong ? FROE_E_FORMAT : FROE_OK);
        assert_int_equal(froe_scene_check(m, NULL), wrong ? FROE_E_FORMAT : FROE_OK);
        assert_int_equal(froe_scene_check(m, &why), wrong ? FROE_E_FORMAT : FROE_OK);
        froe_scene_free(m);
    }
    scene_explicit_free(s, &s->alloc, &c);
    froe_scene_free(s);
}

static void objects_that_do_not_fit_cross_no_antimeridian(void **state) {
    (void)state;
    froe_scene *s = new_scene(2), *m, c;
    uint32_t first, vertices[4];
    const froe_crs crs = {.kind = FROE_CRS_GEOGRAPHIC, .name = "WGS 84"};
    assert_int_equal(add(s, FROE_SEGMENT, 2, (const double[]){-179, 1, 179, 2, -178, 3, 178, 4}, NULL, NULL), FROE_OK);
    assert_int_equal(froe_scene_set_crs(s, &crs), FROE_OK);
    assert_int_equal(froe_scene_across(s, &first), 2);
    assert_int_equal(scene_explicit(s, &s->alloc, &c), FROE_OK);
    froe_scene arrays = c;
    memcpy(vertices, c.vertex_of, sizeof vertices);
    vertices[1] = 99;
    arrays.vertex_of = vertices;
    assert_int_equal(scene_mapped(&arrays, NULL, &m, NULL), FROE_OK);
    assert_int_equal(froe_scene_across(m, &first), 1);
    assert_int_equal(first, 1);
    scene_hold(m); /* which frees nothing that a growing scene has */
    froe_scene_free(m);
    froe_scene_free(m);
    arrays.dim = FROE_MAX_DIM + 1;
    assert_int_equal(scene_validate(&arrays, &s->alloc, NULL), FROE_E_FORMAT);
    scene_explicit_free(s, &s->alloc, &c);
    froe_scene_free(s);
}

static void balls_reach_no_farther_than_numbers(void **state) {
    (void)state;
    static const double centres[2][2] = {{-0x1.8p1023, 0}, {0x1.8p1023, 0}};
    for (int side = 0; side < 2; side++) {
        froe_scene *s = new_scene(2), *m, c;
        assert_int_equal(add(s, FROE_BALL, 1, centres[side], NULL, (const double[]){1}), FROE_OK);
        assert_int_equal(scene_explicit(s, &s->alloc, &c), FROE_OK);
        double radius[1] = {0x1.8p1023};
        froe_scene arrays = c;
        arrays.radii = radius;
        assert_int_equal(scene_mapped(&arrays, NULL, &m, NULL), FROE_OK);
        assert_int_equal(froe_scene_check(m, NULL), FROE_E_FORMAT);
        froe_scene_free(m);
        scene_explicit_free(s, &s->alloc, &c);
        froe_scene_free(s);
    }
}

/* ----------------------------------------------------------------------- polygons -- */

static void rings_are_judged_by_their_corners_alone(void **state) {
    (void)state;
    num_context context;
    static const double bent[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 1}, square[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    assert_int_equal(num_context_new(NULL, &context), FROE_OK);
    assert_true(scene_polygon_valid(&context, square, NULL, 4));
    assert_false(scene_polygon_valid(&context, square, NULL, 2));
    assert_false(scene_polygon_valid(&context, bent, NULL, 4));
    num_context_free(&context);
}

typedef struct pile {
    double *coords;
    size_t count;
    uint32_t calls, stop;
} pile;

static bool go_on(void *user, double done) {
    pile *p = user;
    (void)done;
    return ++p->calls != p->stop;
}

/* So many triangles that they are looked at by jobs; on a lattice, so that filters doubt some. */
static froe_status add_pile(void *user, const froe_allocator *alloc) {
    pile *p = user;
    froe_scene *s;
    froe_status status = froe_scene_new(3, alloc, &s);
    if (status) return status;
    froe_objects b = froe_objects_defaults();
    b.count = p->count, b.coords = p->coords, b.progress = go_on, b.user = p;
    b.threads = 1;
    p->calls = 0;
    status = froe_scene_add(s, &b, NULL);
    assert_int_equal(froe_scene_object_count(s), status ? 0 : p->count);
    froe_scene_free(s);
    return status;
}

static void many_polygons_in_doubt_may_lack_memory_and_be_cancelled(void **state) {
    (void)state;
    pile p = {.count = 20000};
    p.coords = malloc(9 * p.count * sizeof *p.coords);
    assert_non_null(p.coords);
    for (size_t i = 0; i < p.count; i++) {
        const double x = (double)i;
        const double corners[9] = {x, 0, 0, x + 1, 1, 1, x, 1, 0};
        const double thin[9] = {x, 0, 0, x + 1, 1. / 3, 1. / 7, x + 2, 2. / 3, nextafter(2. / 7, 1)}; /* who knows */
        memcpy(p.coords + 9 * i, i % 50 ? corners : thin, sizeof corners);
    }
    assert_int_equal(add_pile(&p, NULL), FROE_OK);
    const uint32_t calls = p.calls;
    assert_true(calls > 4);
    for (p.stop = 1; p.stop <= calls; p.stop++) assert_int_equal(add_pile(&p, NULL), FROE_E_CANCELLED);
    p.stop = 0;
    assert_true(test_memory_each(add_pile, &p) > 5);
    free(p.coords);
}

static froe_status make_explicit(void *user, const froe_allocator *alloc) {
    froe_scene c;
    const froe_scene *s = user;
    const froe_status status = scene_explicit(s, alloc, &c);
    if (status) return status;
    for (uint32_t i = 0; i < s->object_count; i++) assert_int_equal(c.kind_of[i], FROE_SEGMENT);
    for (uint32_t i = 0; i < s->corner_count; i++) assert_int_equal(c.vertex_of[i], i);
    scene_explicit_free(s, alloc, &c);
    return FROE_OK;
}

static void arrays_that_say_nothing_are_made_or_not(void **state) {
    (void)state;
    froe_scene *s = new_scene(2);
    assert_int_equal(add(s, FROE_SEGMENT, 2, (const double[]){0, 0, 1, 1, 2, 2, 3, 4}, NULL, NULL), FROE_OK);
    assert_int_equal(test_memory_each(make_explicit, s), 4);
    froe_scene_free(s);
}

/* Points that no object names, and more parts than are made. */
static void large_batches_with_idle_points_give_the_same_scene(void **state) {
    (void)state;
    enum { POINTS = 20000, COUNT = 500 };
    double *x = malloc(2 * POINTS * sizeof *x);
    uint32_t indices[2 * COUNT];
    assert_non_null(x);
    for (uint32_t i = 0; i < POINTS; i++) x[2 * i] = i % 100, x[2 * i + 1] = i / 100;
    for (uint32_t i = 0; i < 2 * COUNT; i++) indices[i] = i * 37 % POINTS;
    for (uint32_t part = 0; part < 2; part++) {
        froe_scene *s = new_scene(2);
        froe_objects b = froe_objects_defaults();
        s->store->plan.least = 1, s->store->plan.part = part;
        b.kind = FROE_SEGMENT, b.count = COUNT, b.coords = x, b.indices = indices, b.point_count = POINTS;
        assert_int_equal(froe_scene_add(s, &b, NULL), FROE_OK);
        for (uint32_t i = 0; i < 2 * COUNT; i++)
            assert_memory_equal(scene_point(s, i / 2, i % 2), x + 2 * (size_t)indices[i], 2 * sizeof *x);
        assert_int_equal(add(s, FROE_POINT, POINTS, x, NULL, NULL), FROE_OK);
        assert_int_equal(s->vertex_count, POINTS);
        froe_scene_free(s);
    }
    free(x);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_table_that_no_memory_could_hold_is_refused),
        cmocka_unit_test(points_with_equal_tags_stay_apart),
        cmocka_unit_test(equal_objects_have_equal_forms_corners_and_radii),
        cmocka_unit_test(forms_do_not_depend_on_trust_in_filters),
        cmocka_unit_test(wrong_arguments_are_refused),
        cmocka_unit_test(more_groups_than_numbers_are_refused),
        cmocka_unit_test(strings_of_a_coordinate_system_end),
        cmocka_unit_test(every_edge_is_found_by_its_number),
        cmocka_unit_test(edges_of_wrong_objects_do_not_exist),
        cmocka_unit_test(objects_that_do_not_fit_cross_no_antimeridian),
        cmocka_unit_test(balls_reach_no_farther_than_numbers),
        cmocka_unit_test(rings_are_judged_by_their_corners_alone),
        cmocka_unit_test(many_polygons_in_doubt_may_lack_memory_and_be_cancelled),
        cmocka_unit_test(arrays_that_say_nothing_are_made_or_not),
        cmocka_unit_test(large_batches_with_idle_points_give_the_same_scene),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
