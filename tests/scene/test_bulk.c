/* Large batches give the scene that the same objects give one by one: ids, coordinates, forms and bounds. */
#include "support/memory.h"

#include "base/random.h"
#include "scene/store.h"
#include <float.h>
#include <math.h>
#include <string.h>

enum { MOST = 4096 };

static uint64_t state_of;

static uint32_t below(uint32_t n) {
    state_of = base_mix(state_of + 0x9e3779b97f4a7c15u);
    return base_below(state_of, n);
}

static froe_scene *new_scene(int dim, match_plan plan) {
    froe_scene *s = NULL;
    assert_int_equal(froe_scene_new(dim, NULL, &s), FROE_OK);
    s->store->plan = plan;
    return s;
}

static const match_plan never = {
    .least = UINT32_MAX, .chunk = 16, .part = 4, .careful = UINT32_MAX, .mask = UINT64_MAX};
static const match_plan small = {.least = 1, .chunk = 16, .part = 4, .careful = 300, .mask = UINT64_MAX};

/* ------------------------------------------------------------------ samples -- */

/** A number of one of the kinds on which batches may go wrong. */
static double a_number(uint32_t kind) {
    static const double odd[] = {0.0,   -0.0, 5e-324, -5e-324, DBL_MIN,  -DBL_MIN,        0x1p-1050,
                                 1e308, 1,    -1e308, DBL_MAX, -DBL_MAX, 1 + DBL_EPSILON, 0x1p-300};
    switch (kind) {
    case 0:
        return (double)below(4) - 1; /* most points are equal */
    case 1:
        return (double)below(100) * (below(2) ? 1 : -1); /* -0, too */
    case 2:
        return (double)below(1u << 31) * 0x1p-31;
    default:
        return odd[below(sizeof odd / sizeof *odd)];
    }
}

typedef struct sample {
    froe_objects batch;
    double coords[MOST * FROE_MAX_DIM], radii[MOST];
    uint32_t indices[MOST];
    size_t starts[MOST + 1];
} sample;

/** A batch of `count` objects of any kind; in `from` the numbers of its points are of one kind. */
static void make_sample(sample *x, int dim, size_t count, uint32_t from) {
    static const froe_kind flat[] = {FROE_POINT, FROE_SEGMENT, FROE_SEGMENT, FROE_BOX, FROE_BALL, FROE_HULL};
    static const size_t each[] = {1, 2, 3, 2, 1, 3};
    froe_kind kind = dim == 3 && below(3) == 0 ? FROE_POLYGON : flat[below(6)];
    size_t corners = 0;
    x->batch = froe_objects_defaults();
    x->batch.kind = kind;
    x->batch.count = count;
    x->batch.coords = x->coords;
    const bool starts = (kind == FROE_HULL || kind == FROE_POLYGON) && below(2), mixed = kind == FROE_HULL && below(2);
    x->starts[0] = 0;
    for (size_t j = 0; j < count; j++) {
        corners += mixed && starts ? 1 + below(4) : each[kind];
        x->starts[j + 1] = corners;
    }
    assert_true(corners <= MOST);
    for (size_t i = 0; i < MOST * (size_t)dim; i++) x->coords[i] = a_number(from);
    if (kind == FROE_BOX && below(4)) /* else some may be inside out */
        for (size_t i = 0; i < 2 * count; i += 2)
            for (size_t k = i * (size_t)dim; k < (i + 1) * (size_t)dim; k++)
                if (x->coords[k] > x->coords[k + (size_t)dim]) x->coords[k + (size_t)dim] = x->coords[k];
    if (starts) x->batch.starts = x->starts;
    for (size_t j = 0; j < count; j++) x->radii[j] = from == 3 ? 0 : below(3);
    if (kind == FROE_BALL) x->batch.radii = x->radii;
    if (kind == FROE_BOX || below(2)) return;
    x->batch.indices = x->indices;
    x->batch.point_count = 1 + below((uint32_t)(2 * corners < MOST ? 2 * corners : MOST));
    for (size_t i = 0; i < corners; i++) x->indices[i] = below((uint32_t)x->batch.point_count);
}

/** The same objects one by one. */
static void add_singly(froe_scene *s, const froe_objects *batch) {
    static const size_t each[] = {1, 2, 3, 2, 1, 3};
    for (size_t j = 0; j < batch->count; j++) {
        froe_objects one = *batch;
        one.count = 1;
        const size_t first = batch->starts ? batch->starts[j] : j * each[batch->kind];
        if (batch->starts)
            one.starts = batch->starts + j;
        else if (batch->indices)
            one.indices = batch->indices + first;
        else
            one.coords = batch->coords + first * (size_t)s->dim;
        if (batch->radii) one.radii = batch->radii + j;
        assert_int_equal(froe_scene_add(s, &one, NULL), FROE_OK);
    }
}

static void assert_same(const froe_scene *a, const froe_scene *b) {
    double lo[2][FROE_MAX_DIM], hi[2][FROE_MAX_DIM];
    const size_t bytes = (size_t)a->dim * sizeof(double);
    assert_int_equal(a->object_count, b->object_count);
    assert_int_equal(a->vertex_count, b->vertex_count);
    assert_int_equal(a->corner_count, b->corner_count);
    if (a->vertex_count) assert_memory_equal(a->coords, b->coords, a->vertex_count * bytes);
    for (uint32_t i = 0; i < a->object_count; i++) {
        const froe_object x = froe_scene_object(a, i), y = froe_scene_object(b, i);
        assert_int_equal(x.kind, y.kind);
        assert_int_equal(x.form, y.form);
        assert_int_equal(x.corners, y.corners);
        assert_true(x.radius == y.radius);
        for (uint32_t c = 0; c < x.corners; c++) assert_int_equal(scene_corner(a, i, c), scene_corner(b, i, c));
        assert_int_equal(scene_start(a, i), scene_start(b, i));
    }
    if (!a->object_count) return;
    assert_true(froe_scene_bounds(a, lo[0], hi[0]) && froe_scene_bounds(b, lo[1], hi[1]));
    assert_memory_equal(lo[0], lo[1], bytes);
    assert_memory_equal(hi[0], hi[1], bytes);
    assert_int_equal(scene_validate(a, &a->alloc, NULL), FROE_OK);
}

/* -------------------------------------------------------------------- cases -- */

/** Some batches, large and small, of which those that are refused are refused alike. */
static size_t add_many(int dim, match_plan plan, uint32_t rounds) {
    sample *x = malloc(sizeof *x);
    assert_non_null(x);
    froe_scene *together = new_scene(dim, plan), *singly = new_scene(dim, never);
    size_t at_once = 0;
    for (uint32_t round = 0; round < rounds; round++) {
        froe_diagnostic why[2] = {{.message = ""}, {.message = ""}};
        make_sample(x, dim, 1 + below(below(3) ? 400 : 4), below(4));
        froe_scene *trial = new_scene(dim, never);
        const froe_status wanted = froe_scene_add(trial, &x->batch, &why[0]);
        froe_scene_free(trial);
        assert_int_equal(froe_scene_add(together, &x->batch, &why[1]), wanted);
        assert_string_equal(why[0].message, why[1].message);
        if (!wanted) add_singly(singly, &x->batch);
        at_once += !wanted && !together->store->table.count;
        assert_same(together, singly);
    }
    froe_scene_free(together);
    froe_scene_free(singly);
    free(x);
    return at_once;
}

static void ids_are_those_of_objects_added_one_by_one(void **state) {
    (void)state;
    size_t at_once = 0;
    for (uint32_t round = 0; round < 60; round++) {
        match_plan plan = small;
        state_of = round;
        plan.least = below(2) ? 1 : 50;
        plan.chunk = 16u << below(5);
        plan.part = 4u << below(6);
        at_once += add_many(2 + (int)(round % 7), plan, 8);
    }
    assert_true(at_once > 150);
}

/** With few bits different points collide: some are told apart, and where that would take long the batch goes the way
 * of small ones. */
static void points_that_share_a_hash_are_told_apart(void **state) {
    (void)state;
    static const uint64_t masks[] = {
        ~(UINT64_MAX >> 16), ~(UINT64_MAX >> 13), ~(UINT64_MAX >> 10), ~(UINT64_MAX >> 4), 0,
        UINT64_MAX >> 8}; /* the last: all in one part */
    size_t at_once[6] = {0};
    for (uint32_t round = 0; round < 60; round++) {
        match_plan plan = small;
        plan.mask = masks[round % 6];
        plan.chunk = 64;
        state_of = 1000 + round;
        at_once[round % 6] += add_many(2 + (int)(round / 6 % 2), plan, 8);
    }
    assert_true(at_once[0] > 20 && at_once[2] > 10); /* repaired */
    assert_true(at_once[4] < at_once[0]);            /* given up */
}

/** A batch that is refused is refused in the same words, and leaves nothing. */
static void what_is_wrong_is_named_as_in_small_batches(void **state) {
    (void)state;
    sample *x = malloc(sizeof *x);
    assert_non_null(x);
    for (uint32_t round = 0; round < 200; round++) {
        state_of = 5000 + round;
        const int dim = 2 + (int)below(3);
        make_sample(x, dim, 300, below(4));
        const size_t corners = x->starts[300];
        const uint32_t which = below((uint32_t)corners);
        static const double bad[] = {NAN, INFINITY, -INFINITY};
        if (x->batch.indices && below(2))
            x->indices[which] = (uint32_t)x->batch.point_count + below(2);
        else
            x->coords[(x->batch.indices ? x->indices[which] : which) * (uint32_t)dim + below((uint32_t)dim)] =
                bad[round % 3];
        froe_scene *large = new_scene(dim, small), *old = new_scene(dim, never);
        froe_diagnostic why[2];
        sample *before = malloc(sizeof *before);
        assert_non_null(before);
        do make_sample(before, dim, 40, 1);
        while (froe_scene_add(old, &before->batch, NULL) != FROE_OK);
        assert_int_equal(froe_scene_add(large, &before->batch, NULL), FROE_OK);
        assert_int_equal(froe_scene_add(large, &x->batch, &why[0]), FROE_E_INPUT);
        assert_int_equal(froe_scene_add(old, &x->batch, &why[1]), FROE_E_INPUT);
        assert_string_equal(why[0].message, why[1].message);
        assert_int_equal(why[0].object, why[1].object);
        assert_int_equal(why[0].corner, why[1].corner);
        assert_int_equal(why[0].axis, why[1].axis);
        assert_same(large, old);
        froe_scene_free(large);
        froe_scene_free(old);
        free(before);
    }
    free(x);
}

static void points_that_no_corner_names_may_be_anything(void **state) {
    (void)state;
    froe_scene *s = new_scene(2, small);
    const double xy[] = {0, 0, NAN, INFINITY, 1, 1, 0, 1};
    const uint32_t corners[] = {3, 0, 0, 2};
    froe_objects b = froe_objects_defaults();
    b.kind = FROE_SEGMENT, b.count = 2, b.coords = xy, b.indices = corners, b.point_count = 4;
    assert_int_equal(froe_scene_add(s, &b, NULL), FROE_OK);
    assert_int_equal(froe_scene_vertex_count(s), 3);
    assert_int_equal(froe_scene_corner(s, 0, 0), 0);
    assert_true(froe_scene_vertex(s, 0)[1] == 1);
    froe_scene_free(s);
}

/* ------------------------------------------------------------------ threads -- */

static void scenes_do_not_depend_on_threads(void **state) {
    (void)state;
    enum { COUNT = 60000 };
    double *xyz = malloc(sizeof(double) * 9 * COUNT);
    uint32_t *indices = malloc(sizeof(uint32_t) * 3 * COUNT);
    assert_true(xyz && indices);
    for (int kind = 0; kind < 4; kind++) {
        froe_scene *s[2];
        state_of = 77 + (uint64_t)kind;
        for (size_t i = 0; i < 9 * (size_t)COUNT; i++) xyz[i] = kind == 3 ? below(1u << 30) : below(30);
        for (size_t i = 0; i < 3 * (size_t)COUNT; i++) indices[i] = below(2 * COUNT);
        for (int i = 0; i < 2; i++) {
            froe_objects b = froe_objects_defaults();
            s[i] = new_scene(3, match_usual);
            b.kind = kind % 3 == 0 ? FROE_SEGMENT : kind == 1 ? FROE_POLYGON : FROE_HULL;
            b.count = COUNT;
            b.coords = xyz;
            b.indices = kind == 2 ? indices : NULL;
            b.point_count = 3 * COUNT;
            b.threads = i ? 4 : 1;
            assert_int_equal(froe_scene_add(s[i], &b, NULL), FROE_OK);
            assert_int_equal(froe_scene_add(s[i], &b, NULL), FROE_OK);
        }
        assert_same(s[0], s[1]);
        froe_scene_free(s[0]);
        froe_scene_free(s[1]);
    }
    free(xyz);
    free(indices);
}

/* ------------------------------------------------------------------- memory -- */

static void arrays_that_would_say_nothing_are_not_kept(void **state) {
    (void)state;
    froe_scene *s = new_scene(2, small);
    const double xy[] = {0, 0, 1, 0, /**/ 2, 0, 3, 0, /**/ 4, 0, 4, 1, /**/ 7, 7, 7, 7};
    froe_objects b = froe_objects_defaults();
    b.kind = FROE_SEGMENT, b.count = 2, b.coords = xy;
    assert_int_equal(froe_scene_add(s, &b, NULL), FROE_OK);
    b.count = 1, b.coords = xy + 8;
    assert_int_equal(froe_scene_add(s, &b, NULL), FROE_OK);
    assert_true(!s->kind_of && !s->form_of && !s->start_of && !s->vertex_of && scene_in_order(s));
    assert_int_equal(scene_object_of(s, 5), 2);
    b.coords = xy;
    assert_int_equal(froe_scene_add(s, &b, NULL), FROE_OK); /* vertices there are */
    assert_true(!s->kind_of && !s->form_of && !s->start_of && s->vertex_of && !scene_in_order(s));
    assert_int_equal(scene_corner(s, 2, 1), 5);
    assert_int_equal(scene_corner(s, 3, 1), 1);
    b.coords = xy + 12;
    assert_int_equal(froe_scene_add(s, &b, NULL), FROE_OK); /* a point in truth */
    assert_true(!s->kind_of && s->form_of && s->start_of);
    assert_int_equal(froe_scene_object(s, 3).form, FROE_SEGMENT);
    assert_int_equal(froe_scene_object(s, 4).form, FROE_POINT);
    b.kind = FROE_POINT;
    assert_int_equal(froe_scene_add(s, &b, NULL), FROE_OK);
    assert_non_null(s->kind_of);
    assert_int_equal(froe_scene_kind_count(s, FROE_SEGMENT), 5);
    assert_int_equal(scene_validate(s, &s->alloc, NULL), FROE_OK);
    froe_scene_free(s);
}

static void a_frozen_scene_keeps_no_table_and_grows_again(void **state) {
    (void)state;
    froe_scene *s = new_scene(2, never);
    const double xy[] = {0, 0, 1, 0, 0, 0, 2, 0};
    froe_objects b = froe_objects_defaults();
    b.kind = FROE_SEGMENT, b.count = 1, b.coords = xy;
    assert_int_equal(froe_scene_add(s, &b, NULL), FROE_OK);
    assert_int_equal(s->store->table.count, 2);
    scene_hold(s);
    assert_int_equal(s->store->table.size, 0);
    froe_scene_free(s);
    b.coords = xy + 4;
    assert_int_equal(froe_scene_add(s, &b, NULL), FROE_OK);
    assert_int_equal(froe_scene_vertex_count(s), 3);
    assert_int_equal(scene_corner(s, 1, 0), 0);
    froe_scene_free(s);
}

static froe_status add_large(void *user, const froe_allocator *alloc) {
    froe_scene *s;
    sample *x = user;
    froe_status status = froe_scene_new(3, alloc, &s);
    if (status) return status;
    s->store->plan = small;
    for (int kind = 0; kind < 4 && !status; kind++) {
        const size_t objects = froe_scene_object_count(s), vertices = froe_scene_vertex_count(s);
        froe_objects b = froe_objects_defaults();
        b.kind = kind == 3 ? FROE_POLYGON : kind == 2 ? FROE_BALL : FROE_SEGMENT;
        b.count = 100, b.coords = x->coords + (kind ? 0 : 3000), b.radii = kind == 2 ? x->radii : NULL;
        if (kind == 3) b.indices = x->indices, b.point_count = 200;
        status = froe_scene_add(s, &b, NULL);
        assert_int_equal(froe_scene_object_count(s), objects + (status ? 0 : 100));
        if (status) assert_int_equal(froe_scene_vertex_count(s), vertices);
    }
    froe_scene_free(s);
    return status;
}

static void every_failing_allocation_is_survived(void **state) {
    (void)state;
    sample *x = malloc(sizeof *x);
    assert_non_null(x);
    state_of = 9;
    for (size_t i = 0; i < MOST * FROE_MAX_DIM; i++) x->coords[i] = i < 3000 ? below(20) : (double)i;
    for (size_t i = 0; i < MOST; i++) x->indices[i] = below(200), x->radii[i] = 1;
    assert_true(test_memory_each(add_large, x) > 20);
    free(x);
}

/** Progress that says no at the n-th call. */
static bool stop_at(void *user, double done) {
    int *left = user;
    assert_true(done >= 0 && done <= 1);
    return --*left != 0;
}

static void cancelling_leaves_no_trace(void **state) {
    (void)state;
    froe_scene *s = new_scene(2, small);
    double xy[4000];
    int calls = 0;
    state_of = 3;
    for (int i = 0; i < 4000; i++) xy[i] = below(40);
    froe_objects b = froe_objects_defaults();
    b.kind = FROE_SEGMENT, b.count = 1000, b.coords = xy, b.progress = stop_at;
    for (froe_status status = FROE_E_CANCELLED; status; calls++) {
        int left = calls + 1;
        b.user = &left;
        status = froe_scene_add(s, &b, NULL);
        assert_true(status == FROE_OK || status == FROE_E_CANCELLED);
        assert_int_equal(froe_scene_object_count(s), status ? 0 : 1000);
        if (status) assert_int_equal(froe_scene_vertex_count(s), 0);
    }
    assert_true(calls > 4);
    froe_scene_free(s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ids_are_those_of_objects_added_one_by_one),
        cmocka_unit_test(points_that_share_a_hash_are_told_apart),
        cmocka_unit_test(what_is_wrong_is_named_as_in_small_batches),
        cmocka_unit_test(points_that_no_corner_names_may_be_anything),
        cmocka_unit_test(scenes_do_not_depend_on_threads),
        cmocka_unit_test(arrays_that_would_say_nothing_are_not_kept),
        cmocka_unit_test(a_frozen_scene_keeps_no_table_and_grows_again),
        cmocka_unit_test(every_failing_allocation_is_survived),
        cmocka_unit_test(cancelling_leaves_no_trace),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
