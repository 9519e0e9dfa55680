/* test_normals.c: the audit's answer whether a plane lies between two sets, against trying all planes in rationals, and
 * against the builders' answer. */
#include "geom/between.h"
#include "geom/sets.h"
#include "support/memory.h"
#include "tree/audit/normals.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static bool take(normals *m, const sets *s) {
    m->dim = s->dim;
    m->points.count = 0;
    for (int set = -1; set < 2; set += 2) {
        for (uint32_t i = 0; i < s->count; i++)
            if (s->set[i] == set && !array_push(&m->alloc, &m->points, s->x[i])) return false;
        if (set < 0) m->first = (uint32_t)m->points.count;
    }
    return true;
}

static void compare(normals *m, void (*make)(sets *, fuzz_source *, int), int runs) {
    static sets s;
    fuzz_source r = {9};
    for (int i = 0; i < runs; i++) {
        bool apart;
        s.dim = 2 + i % 2;
        make(&s, &r, i);
        m->context->first = (num_stage)(i / 2 % 3);
        assert_true(take(m, &s));
        assert_int_equal(normals_apart(m, &apart), FROE_OK);
        if (apart != (sets_oracle(&s) == SETS_APART)) fail_msg("run %d, dim %d: %d", i, s.dim, apart);
    }
    m->context->first = NUM_FILTER;
}

static void answers_are_those_of_brute_force_on_nasty_points(void **state) {
    compare(*state, sets_make_nasty, 6000);
}

static void answers_are_those_of_brute_force_on_sets_that_touch(void **state) {
    compare(*state, sets_make_touching, 6000);
}

/** Points of two spheres of radius 1. */
static void make_spheres(sets *s, fuzz_source *r, int i) {
    s->count = SETS_MOST;
    for (uint32_t at = 0; at < s->count; at++) {
        double square = 0;
        for (int k = 0; k < s->dim; k++) {
            s->x[at][k] = fuzz_unit(r);
            square += s->x[at][k] * s->x[at][k];
        }
        for (int k = 0; k < s->dim; k++) s->x[at][k] /= sqrt(square);
        s->set[at] = at % 2 ? 1 : -1;
        if (at % 2) s->x[at][0] += 0.1 * (i % 22);
    }
}

static void builders_and_audit_agree_on_round_hulls(void **state) {
    static sets s;
    normals *m = *state;
    fuzz_source r = {4};
    int apart_count = 0;
    for (int i = 0; i < 4000; i++) {
        geom_member members[SETS_MOST];
        bool apart;
        s.dim = 2 + i % 2;
        make_spheres(&s, &r, i);
        for (uint32_t k = 0; k < s.count; k++) members[k] = (geom_member){s.x[k], k, s.set[k]};
        assert_true(take(m, &s));
        assert_int_equal(normals_apart(m, &apart), FROE_OK);
        assert_int_equal(apart, geom_between(m->context, s.dim, members, s.count) == GEOM_YES);
        apart_count += apart;
    }
    assert_in_range(apart_count, 500, 3500);
}

/** A point against a hull: strictly inside or not. */
static void a_point_is_a_hull_too(void **state) {
    sets s = {2, 5, {{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 1}}, {-1, -1, -1, -1, 1}};
    bool apart;
    assert_true(take(*state, &s));
    assert_int_equal(normals_apart(*state, &apart), FROE_OK);
    assert_false(apart);
    s.x[4][0] = 2;
    assert_true(take(*state, &s));
    assert_int_equal(normals_apart(*state, &apart), FROE_OK);
    assert_true(apart);
}

/* Two hulls, of which `user` has the dimension, and how many cuts it takes until nothing is left between them. */
typedef struct round_hulls {
    num_context *context;
    int dim;
    size_t vectors;
} round_hulls;

static froe_status in_memory(void *user, const froe_allocator *alloc) {
    static sets s;
    round_hulls *hulls = user;
    fuzz_source r = {7};
    bool apart;
    normals m = {.context = hulls->context, .alloc = *alloc};
    s.dim = hulls->dim;
    froe_status status = FROE_OK;
    for (int i = 0; i < 40 && !status; i++) {
        make_spheres(&s, &r, i);
        status = take(&m, &s) ? normals_apart(&m, &apart) : FROE_E_MEMORY;
        if (m.vectors.count > hulls->vectors) hulls->vectors = m.vectors.count;
    }
    normals_free(&m);
    return status;
}

/* Among other calls, those for the rays of a cone that many differences bound. */
static void any_allocation_may_fail(void **state) {
    for (int dim = 2; dim <= 3; dim++) {
        round_hulls hulls = {((normals *)*state)->context, dim, 0};
        assert_true(test_memory_each(in_memory, &hulls) > 3);
        if (dim == 3) assert_true(hulls.vectors > 8);
    }
}

static int begin(void **state) {
    static num_context context;
    static normals m;
    m = (normals){.context = &context, .alloc = support_allocator(NULL)};
    *state = &m;
    return num_context_new(NULL, &context);
}

static int end(void **state) {
    normals *m = *state;
    num_context_free(m->context);
    normals_free(m);
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(answers_are_those_of_brute_force_on_nasty_points),
        cmocka_unit_test(answers_are_those_of_brute_force_on_sets_that_touch),
        cmocka_unit_test(builders_and_audit_agree_on_round_hulls),
        cmocka_unit_test(a_point_is_a_hull_too),
        cmocka_unit_test(any_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, begin, end);
}
