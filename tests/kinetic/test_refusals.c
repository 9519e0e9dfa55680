/* test_refusals.c: what motions and partitions of them refuse: what is not given, options of other sizes, times outside
 * the window; and what they say of a motion that is not there. */
#include <math.h>

#include "kinetic/moving.h"
#include "kinetic/space.h"
#include "support/refusals.h"

static const moving_kind few = {.name = "few", .count = 6, .grid = 8, .length = 4, .speed = 1};
static const space_kind layers = {.form = SPACE_LAYERS, .count = 3, .grid = 900, .reach = 300, .speed = 300};
static const double origin[3] = {0, 0, 0};

static bool never_event(void *user, const froe_event *event) {
    (void)user, (void)event;
    fail();
    return false;
}
static bool never_contact(void *user, const froe_contact *contact) {
    (void)user, (void)contact;
    fail();
    return false;
}
static bool never_sight(void *user, double low, double high) {
    (void)user, (void)low, (void)high;
    fail();
    return false;
}

/* ------------------------------------------------------------------------ motions -- */

static void a_motion_that_is_not_there_has_nothing(void **state) {
    (void)state;
    double at[3];
    froe_motion *m = moving_new(&few, 1, NULL);
    assert_int_equal(froe_motion_add_group(NULL, &(froe_group){.name = "car"}, NULL), FROE_E_ARG);
    assert_int_equal(froe_motion_group_count(NULL), 0);
    assert_int_equal(froe_motion_object_count(NULL), 0);
    assert_int_equal(froe_motion_vertex_count(NULL), 0);
    assert_int_equal(froe_motion_body_count(NULL), 0);
    assert_int_equal(froe_motion_vertex_body(NULL, 0), FROE_NONE);
    assert_int_equal(froe_motion_vertex_body(m, 12), FROE_NONE);
    assert_int_equal(froe_motion_body_knot_count(NULL, 0), 0);
    assert_int_equal(froe_motion_body_knot_count(m, 0), 0);
    assert_int_equal(froe_motion_knot_count(NULL, 0), 0);
    assert_int_equal(froe_motion_knot_count(m, 12), 0);
    assert_int_equal(froe_motion_knot_count(m, 11), 2);
    assert_int_equal(froe_motion_object(NULL, 0).vertices[0], FROE_NONE);
    assert_false(froe_motion_position(NULL, 0, 0, at));
    assert_false(froe_motion_position(m, 12, 0, at));
    assert_false(froe_motion_position(m, 0, NAN, at));
    assert_true(froe_motion_position(m, 11, 0, at));
    froe_motion_free(m);
}

static void motions_need_all_they_are_made_of(void **state) {
    (void)state;
    froe_motion_options o = froe_motion_defaults();
    froe_motion *m = NULL;
    NULLS(froe_motion_new(NULL, NULL, &m, &why));
    NULLS(froe_motion_new(&o, NULL, NULL, &why));
    o.begin = 0, o.end = 8, o.size--;
    expect(froe_motion_new(&o, NULL, &m, &why), FROE_E_OPTIONS, "froe_motion_defaults");
    o.size++, o.tick = INFINITY;
    expect(froe_motion_new(&o, NULL, &m, &why), FROE_E_OPTIONS, "not a power of 2");
    assert_null(m);
    o.tick = 0;
    assert_int_equal(froe_motion_new(&o, NULL, &m, NULL), FROE_OK);
    const size_t starts[] = {0, 1, 2};
    const double times[2] = {0}, coords[4] = {1, 2, 3, 4};
    froe_moving good = froe_moving_defaults(), b;
    good.vertex_count = 2, good.count = 1, good.starts = starts, good.times = times, good.coords = coords;
    NULLS(froe_motion_add(NULL, &good, &why));
    NULLS(froe_motion_add(m, NULL, &why));
    for (int i = 0; i < 4; i++) {
        b = good;
        if (i == 0) b.vertex_count = 0;
        if (i == 1) b.starts = NULL;
        if (i == 2) b.times = NULL;
        if (i == 3) b.coords = NULL;
        expect(froe_motion_add(m, &b, &why), FROE_E_ARG, "without flight plans");
    }
    const double never[2][2] = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    for (int i = 0; i < 2; i++) {
        b = good, b.births = never[i], b.deaths = never[i] + 1;
        expect(froe_motion_add(m, &b, &why), FROE_E_INPUT, "is none");
    }
    assert_int_equal(froe_motion_object_count(m), 0);
    froe_moving none = froe_moving_defaults();
    assert_int_equal(froe_motion_add(m, &none, NULL), FROE_OK);
    assert_int_equal(froe_motion_add(m, &good, NULL), FROE_OK);
    assert_int_equal(froe_motion_object_count(m), 1);
    froe_body body = froe_body_defaults();
    NULLS(froe_motion_add_body(NULL, &body, NULL, &why));
    NULLS(froe_motion_add_body(m, NULL, NULL, &why));
    body.count = 1, body.coords = coords;
    NULLS(froe_motion_add_body(m, &body, NULL, &why));
    body.times = times, body.coords = NULL;
    NULLS(froe_motion_add_body(m, &body, NULL, &why));
    assert_int_equal(froe_motion_body_count(m), 0);
    froe_motion *out = NULL;
    NULLS(froe_motion_without_bodies(NULL, 1, NULL, &out, NULL, &why));
    NULLS(froe_motion_without_bodies(m, 1, NULL, NULL, NULL, &why));
    froe_motion_free(m);
}

/* ---------------------------------------------------------------------- partitions -- */

static void partitions_need_all_they_are_made_of(void **state) {
    (void)state;
    froe_motion *m = moving_new(&few, 1, NULL), *space = space_new(&layers, 1, NULL);
    const uint32_t order[] = {5, 4, 3, 2, 1, 0}, twice[] = {0, 1, 2, 3, 4, 4}, beyond[] = {0, 1, 2, 3, 4, 6};
    froe_kinetic_options o = froe_kinetic_defaults();
    froe_kinetic *k = NULL;
    NULLS(froe_kinetic_new(m, &o, NULL, NULL, &why));
    o.order = twice;
    expect(froe_kinetic_new(m, &o, NULL, &k, &why), FROE_E_OPTIONS, "object 4 twice");
    o.order = beyond;
    expect(froe_kinetic_new(m, &o, NULL, &k, &why), FROE_E_OPTIONS, "object 6 twice, or there is no such");
    o.order = order, o.epoch = 9;
    expect(froe_kinetic_new(m, &o, NULL, &k, &why), FROE_E_OPTIONS, "anew in epochs");
    o.order = NULL, o.epoch = 0, o.ghosts = true;
    expect(froe_kinetic_new(m, &o, NULL, &k, &why), FROE_E_OPTIONS, "Ghosts are triangles in space");
    o.unchecked = true;
    expect(froe_kinetic_new(space, &o, NULL, &k, &why), FROE_E_OPTIONS, "contacts are looked for");
    assert_null(k);
    froe_motion_free(space);
    froe_motion_free(m);
}

static void calls_of_no_partition_are_refused(void **state) {
    (void)state;
    double at[2];
    froe_motion *m = moving_new(&few, 1, NULL);
    const froe_kinetic_options o = froe_kinetic_defaults();
    froe_kinetic *k = NULL;
    assert_int_equal(froe_kinetic_new(m, &o, NULL, &k, NULL), FROE_OK);
    froe_kinetic_watch(NULL, NULL, NULL);
    NULLS(froe_kinetic_audit(NULL, &why));
    NULLS(froe_kinetic_update(NULL, &why));
    NULLS(froe_kinetic_instant(NULL, at, &why));
    NULLS(froe_kinetic_instant(k, NULL, &why));
    NULLS(froe_kinetic_advance(NULL, 1, never_event, NULL, &why));
    NULLS(froe_kinetic_remove(NULL, 0, &why));
    NULLS(froe_kinetic_replan(NULL, 0, 1, origin, origin, NULL, NULL, &why));
    NULLS(froe_kinetic_replan(k, 0, 1, NULL, origin, NULL, NULL, &why));
    NULLS(froe_kinetic_replan(k, 0, 1, origin, NULL, NULL, NULL, &why));
    expect(froe_kinetic_advance(k, 1e9, never_event, NULL, &why), FROE_E_ARG,
           "Time 1000000000 is not in the window, which ends at");
    expect(froe_kinetic_remove(k, 6, &why), FROE_E_ARG, "There is no object 6.");
    expect(froe_kinetic_replan(k, 1000, 1, origin, origin, NULL, NULL, &why), FROE_E_ARG, "There is no vertex 1000.");
    froe_kinetic_free(k);
    froe_motion_free(m);
}

static bool first_of_layers(void *user, uint32_t object, const double corners[8]) {
    (void)object, (void)corners;
    ++*(int *)user;
    return false;
}
static bool first_of_order(void *user, uint32_t object, const double ends[4]) {
    (void)object, (void)ends;
    ++*(int *)user;
    return false;
}

static void questions_need_a_place_and_room_for_the_answer(void **state) {
    (void)state;
    int asked = 0;
    uint32_t hit = 7;
    froe_kinetic_place place = {7, 7, 7};
    froe_motion *m = moving_new(&few, 1, NULL), *space = space_new(&layers, 1, NULL);
    const froe_kinetic_options o = froe_kinetic_defaults();
    froe_kinetic *flat = NULL, *k = NULL;
    assert_int_equal(froe_kinetic_new(m, &o, NULL, &flat, NULL), FROE_OK);
    assert_int_equal(froe_kinetic_new(space, &o, NULL, &k, NULL), FROE_OK);
    NULLS(froe_kinetic_locate(flat, NULL, &place, &why));
    NULLS(froe_kinetic_ray(flat, origin, NULL, &hit, &why));
    NULLS(froe_kinetic_ray(flat, NULL, origin, &hit, &why));
    NULLS(froe_kinetic_order(flat, NULL, first_of_order, &asked, &why));
    NULLS(froe_kinetic_locate_in_space(NULL, origin, &place, &why));
    NULLS(froe_kinetic_locate_in_space(k, NULL, &place, &why));
    NULLS(froe_kinetic_layers(NULL, first_of_layers, &asked, &why));
    expect(froe_kinetic_locate_in_space(flat, origin, &place, &why), FROE_E_UNSUPPORTED, "has no heights");
    expect(froe_kinetic_layers(flat, first_of_layers, &asked, &why), FROE_E_UNSUPPORTED, "has no heights");
    assert_int_equal(hit, 7);
    assert_int_equal(place.on, 7);
    assert_int_equal(asked, 0);
    assert_int_equal(froe_kinetic_layers(k, first_of_layers, &asked, NULL), FROE_OK); /* it may stop at the first */
    assert_int_equal(asked, 1);
    assert_int_equal(froe_kinetic_order(flat, origin, first_of_order, &asked, NULL), FROE_OK);
    assert_int_equal(asked, 2);
    froe_kinetic_free(k), froe_kinetic_free(flat);
    froe_motion_free(space), froe_motion_free(m);
}

/* ---------------------------------------------------------------- contacts and sights -- */

static void searches_need_a_motion_and_times_within_it(void **state) {
    (void)state;
    froe_motion *m = moving_new(&few, 1, NULL), *space = space_new(&layers, 1, NULL);
    const double times[][2] = {{-1, 8}, {0, SPACE_WINDOW + 1}, {3, 2}};
    const froe_contact_options usual = froe_contact_defaults();
    NULLS(froe_motion_contacts(NULL, &usual, never_contact, NULL, &why));
    NULLS(froe_motion_contacts(m, &usual, NULL, NULL, &why));
    NULLS(froe_motion_sights(NULL, &(froe_sight_options){0}, never_sight, NULL, &why));
    NULLS(froe_motion_sights(space, NULL, never_sight, NULL, &why));
    expect(froe_motion_sights(space, &(froe_sight_options){.size = 1}, never_sight, NULL, &why), FROE_E_OPTIONS,
           "froe_sight_defaults");
    for (int i = 0; i < 3; i++) {
        froe_contact_options o = froe_contact_defaults();
        froe_sight_options s = froe_sight_defaults();
        o.from = s.from = times[i][0], o.to = s.to = times[i][1];
        expect(froe_motion_contacts(m, &o, never_contact, NULL, &why), FROE_E_OPTIONS, "does not lie in the window");
        expect(froe_motion_sights(space, &s, never_sight, NULL, &why), FROE_E_OPTIONS, "not within the window");
    }
    froe_contact_options o = froe_contact_defaults();
    o.neighbours = true;
    expect(froe_motion_contacts(m, &o, never_contact, NULL, &why), FROE_E_UNSUPPORTED, "share a vertex");
    froe_motion_free(space);
    froe_motion_free(m);
}

static void eyes_that_are_nowhere_are_refused(void **state) {
    (void)state;
    froe_motion *space = space_new(&layers, 1, NULL);
    const double keys[][2] = {{-1, 60}, {1, SPACE_WINDOW}}, way[6] = {0, 0, 0, 9, 0, 0};
    const uint32_t pairs[2] = {0, 1};
    froe_sight_options s = froe_sight_defaults();
    expect(froe_motion_sights(space, &s, never_sight, NULL, &why), FROE_E_OPTIONS, "Coordinate 0 is not a finite");
    for (int k = 0; k < 3; k++) s.at[k] = 0;
    s.parallel = true;
    expect(froe_motion_sights(space, &s, never_sight, NULL, &why), FROE_E_OPTIONS, "direction towards a parallel eye");
    s.parallel = false, s.pair_count = 1;
    NULLS(froe_motion_sights(space, &s, never_sight, NULL, &why));
    s.pairs = pairs;
    expect(froe_motion_sights(space, &s, never_sight, NULL, &why), FROE_E_INPUT, "no object that is at rest");
    s.pair_count = 0;
    for (int i = 0; i < 2; i++) {
        froe_body body = froe_body_defaults();
        body.count = 2, body.times = keys[i], body.coords = way;
        s.body = &body;
        expect(froe_motion_sights(space, &s, never_sight, NULL, &why), FROE_E_INPUT, "does not cover the window");
        body.size = 1;
        expect(froe_motion_sights(space, &s, never_sight, NULL, &why), FROE_E_OPTIONS, "froe_body_defaults");
    }
    froe_motion_free(space);
}

/* ------------------------------------------------------------------- whole numbers -- */

static void texts_of_whole_numbers_fit_their_room(void **state) {
    (void)state;
    const uint64_t limbs[] = {0, 1};
    const froe_whole number = {-1, 2, limbs};
    const char *digits = "-18446744073709551616"; /* 2^64 */
    char out[32];
    froe_exact_place place;
    for (size_t size = 0; size < sizeof out; size++) {
        memset(out, '?', sizeof out);
        assert_int_equal(froe_whole_text(&number, out, size), strlen(digits));
        if (size) assert_int_equal(strlen(out), size <= strlen(digits) ? size - 1 : strlen(digits));
        assert_int_equal(strncmp(out, digits, size ? size - 1 : 0), 0);
        assert_int_equal(out[size], '?');
    }
    assert_int_equal(froe_whole_text(NULL, out, sizeof out), 1);
    assert_string_equal(out, "0");
    assert_int_equal(froe_places_count(NULL), 0);
    assert_false(froe_places_end(NULL, 0, 0, &place));
    assert_false(froe_places_end(NULL, 0, -1, &place));
    assert_false(froe_places_end(NULL, 0, 0, NULL));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_motion_that_is_not_there_has_nothing),
        cmocka_unit_test(motions_need_all_they_are_made_of),
        cmocka_unit_test(partitions_need_all_they_are_made_of),
        cmocka_unit_test(calls_of_no_partition_are_refused),
        cmocka_unit_test(questions_need_a_place_and_room_for_the_answer),
        cmocka_unit_test(searches_need_a_motion_and_times_within_it),
        cmocka_unit_test(eyes_that_are_nowhere_are_refused),
        cmocka_unit_test(texts_of_whole_numbers_fit_their_room),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
