/* test_space.c: partitions of moving triangles against trees of `cylindrical`, after every event. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "kinetic/space.h"
#include "support/memory.h"
#include <string.h>

static froe_kinetic *start(froe_motion *m, uint64_t seed) {
    froe_kinetic_options o = froe_kinetic_defaults();
    froe_kinetic *k = NULL;
    froe_diagnostic why = {0};
    o.seed = seed;
    if (froe_kinetic_new(m, &o, NULL, &k, &why)) fail_msg("%s", why.message);
    return k;
}

static void follow(froe_kinetic *k, const space_kind *kind, uint64_t seed, uint64_t most, space_counts *counts) {
    froe_diagnostic why = {0};
    if (!space_follow(k, most, counts, &why))
        fail_msg("%s %d at %.17g: %s", kind->name, (int)seed, froe_kinetic_time(k), why.message);
    assert_int_equal(froe_kinetic_statistics(k).stuck, 0);
}

static const space_kind *kind_named(const char *name) {
    for (size_t i = 0; i < SPACE_KINDS; i++)
        if (!strcmp(space_kinds[i].name, name)) return space_kinds + i;
    fail_msg("There is no kind %s.", name);
    return NULL;
}

static void trees_are_those_of_cylindrical_after_every_event(void **state) {
    (void)state;
    space_counts counts = {0};
    for (size_t i = 0; i < SPACE_KINDS; i++)
        for (uint64_t seed = 1; seed <= 2; seed++) {
            const uint64_t before = counts.all;
            froe_motion *m = space_new(space_kinds + i, seed, NULL);
            froe_kinetic *k = start(m, seed);
            follow(k, space_kinds + i, seed, 90, &counts);
            if (counts.all == before && space_kinds[i].count > 1) fail_msg("%s: no events", space_kinds[i].name);
            froe_kinetic_free(k);
            froe_motion_free(m);
        }
    for (int j = 0; j < FROE_EVENT_KINDS; j++)
        if (!counts.events[j]) fail_msg("no event of kind %s", froe_event_name((froe_event_kind)j));
    assert_true(counts.all >= 3000 && counts.compared >= 3000);
}

/* Of a tetrahedron that changes its form a face turns over while another vertex is behind it. Its edges enter cells
 * where the face was not: certificates that were renewed while a part of the tree was old hid that once. */
static void faces_turn_over_into_other_cells(void **state) {
    static const uint64_t missed[] = {1, 2, 3, 5};
    space_counts counts = {0};
    (void)state;
    for (size_t i = 0; i < sizeof missed / sizeof *missed; i++) {
        froe_motion *m = space_new(kind_named("soft"), missed[i], NULL);
        froe_kinetic *k = start(m, missed[i]);
        follow(k, kind_named("soft"), missed[i], 200, &counts);
        froe_kinetic_free(k);
        froe_motion_free(m);
    }
    assert_true(counts.events[FROE_EVENT_FLOP] >= 5);
}

/* In general position there is nothing to fall back to. */
static void nothing_is_made_anew_in_general_position(void **state) {
    static const char *const general[] = {"layers", "small", "swarm", "soft", "still", "curved"};
    (void)state;
    for (size_t i = 0; i < sizeof general / sizeof *general; i++) {
        froe_motion *m = space_new(kind_named(general[i]), 9, NULL);
        froe_kinetic *k = start(m, 9);
        assert_int_equal(froe_kinetic_advance(k, SPACE_WINDOW, NULL, NULL, NULL), FROE_OK);
        const froe_kinetic_stats s = froe_kinetic_statistics(k);
        assert_int_equal(s.restarts + s.stuck, 0);
        assert_true(s.surgeries > 20);
        froe_kinetic_free(k);
        froe_motion_free(m);
    }
}

static froe_status with_memory(void *user, const froe_allocator *alloc) {
    froe_kinetic *k = NULL;
    froe_snapshot s = {0};
    froe_kinetic_options o = froe_kinetic_defaults();
    froe_status status = froe_kinetic_new(user, &o, alloc, &k, NULL);
    if (status) return status;
    status = froe_kinetic_advance(k, SPACE_WINDOW / 3.0, NULL, NULL, NULL);
    if (!status) status = froe_kinetic_snapshot(k, NULL, &s, NULL);
    if (!status) status = froe_kinetic_audit(k, NULL);
    froe_tree_free(s.tree);
    froe_kinetic_free(k);
    return status;
}

static void memory_may_run_out(void **state) {
    static const space_kind few[] = {
        {.form = SPACE_TETRAHEDRA, .count = 8, .grid = 900, .reach = 250, .speed = 600, .spin = 40},
        {.form = SPACE_LAYERS, .count = 4, .grid = 900, .reach = 300, .speed = 300, .mortal = true, .legs = 2}};
    (void)state;
    for (size_t i = 0; i < sizeof few / sizeof *few; i++) {
        froe_motion *m = space_new(few + i, 2, NULL);
        test_memory_each(with_memory, m);
        froe_motion_free(m);
    }
}

static froe_motion *flying_body(void) {
    static const double times[] = {0, 1}, centres[] = {0, 0, 0, 9, 0, 0}, turns[] = {0, 0, 0, 1, 0, 0, 0, 1};
    static const double corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0}, always[] = {0, 0, 0};
    static const size_t starts[] = {0, 1, 2, 3};
    static const uint32_t of[] = {0, 0, 0};
    uint32_t id;
    froe_motion_options w = froe_motion_defaults();
    froe_motion *m = NULL;
    w.dim = 3, w.begin = 0, w.end = 1;
    froe_body body = froe_body_defaults();
    body.count = 2, body.times = times, body.coords = centres, body.turns = turns;
    froe_moving b = froe_moving_defaults();
    b.vertex_count = 3, b.count = 1, b.starts = starts, b.times = always, b.coords = corners;
    b.bodies = of;
    assert_int_equal(froe_motion_new(&w, NULL, &m, NULL), FROE_OK);
    assert_int_equal(froe_motion_add_body(m, &body, &id, NULL), FROE_OK);
    assert_int_equal(froe_motion_add(m, &b, NULL), FROE_OK);
    return m;
}

static void what_is_not_there_is_refused(void **state) {
    const double at[3] = {0, 0, 0};
    froe_motion *m = space_new(kind_named("small"), 1, NULL);
    froe_kinetic *k = start(m, 1), *none = NULL;
    froe_kinetic_place place;
    uint32_t hit;
    froe_kinetic_options o = froe_kinetic_defaults();
    (void)state;
    assert_int_equal(froe_kinetic_locate(k, at, &place, NULL), FROE_E_UNSUPPORTED);
    assert_int_equal(froe_kinetic_ray(k, at, at, &hit, NULL), FROE_E_UNSUPPORTED);
    assert_int_equal(froe_kinetic_update(k, NULL), FROE_E_UNSUPPORTED);
    assert_int_equal(froe_kinetic_remove(k, 0, NULL), FROE_E_UNSUPPORTED);
    assert_int_equal(froe_kinetic_replan(k, 0, 0, NULL, NULL, NULL, NULL), FROE_E_UNSUPPORTED);
    o.augmented = true;
    assert_int_equal(froe_kinetic_new(m, &o, NULL, &none, NULL), FROE_E_UNSUPPORTED);
    assert_null(none);
    o.augmented = false;
    froe_motion *bodies = flying_body();
    assert_int_equal(froe_kinetic_new(bodies, &o, NULL, &none, NULL), FROE_E_UNSUPPORTED);
    assert_null(none);
    froe_motion_free(bodies);
    froe_kinetic_free(k);
    froe_motion_free(m);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(trees_are_those_of_cylindrical_after_every_event),
        cmocka_unit_test(faces_turn_over_into_other_cells),
        cmocka_unit_test(nothing_is_made_anew_in_general_position),
        cmocka_unit_test(memory_may_run_out),
        cmocka_unit_test(what_is_not_there_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
