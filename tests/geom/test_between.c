/* test_between.c: planes between two sets of points, against trying all planes through dim of them in rationals. */
#include "geom/between.h"
#include "geom/sets.h"
#include "support/context.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static geom_answer ask(num_context *context, const sets *s, geom_member *members) {
    for (uint32_t i = 0; i < s->count; i++) members[i] = (geom_member){s->x[i], i, s->set[i]};
    return geom_between(context, s->dim, members, s->count);
}

static void assert_right(num_context *context, const sets *s) {
    geom_member members[SETS_MOST];
    geom_answer answer = ask(context, s, members);
    if ((int)answer != (int)sets_oracle(s)) fail_msg("%d instead of %d", (int)answer, (int)sets_oracle(s));
    if (answer != GEOM_YES) return;
    uint32_t id[3] = {members[0].id, members[1].id, s->dim == 3 ? members[2].id : 0};
    rational_plane h;
    rational_plane_init(&h);
    assert_true(sets_plane(s, id, &h));
    assert_int_equal(sets_sides(s, &h), SETS_APART);
    rational_plane_clear(&h);
}

/* -------------------------------------------------------------------- sets -- */

static void both_dimensions_and_stages(num_context *context, sets *s, void (*make)(sets *, fuzz_source *, int),
                                       int runs) {
    fuzz_source r = {5};
    for (int i = 0; i < runs; i++) {
        s->dim = 2 + i % 2;
        make(s, &r, i);
        context->first = (num_stage)(i / 2 % 3);
        assert_right(context, s);
    }
    context->first = NUM_FILTER;
}

static void answers_are_those_of_brute_force_on_nasty_points(void **state) {
    static sets s;
    both_dimensions_and_stages(*state, &s, sets_make_nasty, 6000);
}

static void answers_are_those_of_brute_force_on_sets_that_touch(void **state) {
    static sets s;
    both_dimensions_and_stages(*state, &s, sets_make_touching, 6000);
}

/** A square pyramid on top of another: separable by the plane of their bases alone. */
static void hulls_that_share_a_facet_are_apart(void **state) {
    static const sets s = {
        3,
        9,
        {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {.5, .5, 1}, {0.5, 0, 0}, {0.5, 1, 0}, {1, 0.5, 0}, {.5, .5, -1}},
        {1, 1, 1, 1, 1, -1, -1, -1, -1}};
    geom_member members[SETS_MOST];
    assert_int_equal(ask(*state, &s, members), GEOM_YES);
    for (int i = 0; i < 3; i++) assert_true(members[i].x[2] == 0);
}

static void hulls_with_a_common_point_inside_are_not(void **state) {
    sets s = {3,
              8,
              {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}, {1, 1, 1}, {9, 9, 9}, {9, 9, 8}, {9, 8, 9}},
              {-1, -1, -1, -1, 1, 1, 1, 1}};
    geom_member members[SETS_MOST];
    assert_int_equal(ask(*state, &s, members), GEOM_NO);
    s.x[4][0] = 2;
    assert_int_equal(ask(*state, &s, members), GEOM_YES); /* now it is on the facet */
}

static void what_lies_in_one_plane_is_flat(void **state) {
    static const sets one = {3, 2, {{1, 2, 3}, {1, 2, 3}}, {-1, 1}},
                      line = {2, 3, {{0, 0}, {1, 1}, {3, 3}}, {-1, 1, 1}},
                      plane = {3, 4, {{0, 0, 7}, {1, 0, 7}, {5, 5, 7}, {6, 5, 7}}, {-1, -1, 1, 1}};
    geom_member members[SETS_MOST];
    assert_int_equal(ask(*state, &one, members), GEOM_FLAT);
    assert_int_equal(ask(*state, &line, members), GEOM_FLAT);
    assert_int_equal(ask(*state, &plane, members), GEOM_FLAT);
}

/* ------------------------------------------------------------------- large -- */

/** n points of each of two spheres of radius 1, their centres apart by `gap`; along a spiral, the worst order there is
 * for coming one by one. */
static geom_answer spheres(num_context *context, uint32_t n, double gap, uint64_t *calls) {
    double(*x)[3] = test_malloc(2 * (size_t)n * sizeof *x);
    geom_member *members = test_malloc(2 * (size_t)n * sizeof *members);
    for (uint32_t i = 0; i < 2 * n; i++) {
        double z = (2.0 * (i % n) + 1) / n - 1, turn = 0.1 * (i % n), r = sqrt(1 - z * z);
        x[i][0] = r * cos(turn) + (i < n ? 0 : gap);
        x[i][1] = r * sin(turn);
        x[i][2] = z;
        members[i] = (geom_member){x[i], i, i < n ? -1 : 1};
    }
    uint64_t before = context->stats.calls;
    geom_answer answer = geom_between(context, 3, members, 2 * n);
    *calls = context->stats.calls - before;
    test_free(members);
    test_free(x);
    return answer;
}

/** Trying all planes would ask some (2 n)^4 / 12 questions: 10^15. */
static void large_hulls_take_few_questions(void **state) {
    enum { CORNERS = 5000 };
    uint64_t calls;
    assert_int_equal(spheres(*state, CORNERS, 2.001, &calls), GEOM_YES);
    assert_true(calls < 100 * CORNERS);
    assert_int_equal(spheres(*state, CORNERS, 1.99, &calls), GEOM_NO);
    assert_true(calls < 100 * CORNERS);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(answers_are_those_of_brute_force_on_nasty_points),
        cmocka_unit_test(answers_are_those_of_brute_force_on_sets_that_touch),
        cmocka_unit_test(hulls_that_share_a_facet_are_apart),
        cmocka_unit_test(hulls_with_a_common_point_inside_are_not),
        cmocka_unit_test(what_lies_in_one_plane_is_flat),
        cmocka_unit_test(large_hulls_take_few_questions),
    };
    return cmocka_run_group_tests(tests, context_open, context_close);
}
