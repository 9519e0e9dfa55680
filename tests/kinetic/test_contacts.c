/* test_contacts.c: contacts of moving segments against whole numbers, pair by pair; and beside the events of a
 * partition, which finds them another way. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "kinetic/contact/meet.h"
#include "kinetic/moving.h"
#include "motions.h"
#include "support/contacts.h"
#include "support/memory.h"

/* ------------------------------------------------------------ against the oracle -- */

static void contacts_are_those_of_exact_brute_force(void **state) {
    (void)state;
    static motion_arrays arrays;
    fuzz_source r = {11};
    for (int kind = 0; kind < MOTION_KINDS; kind++) {
        judged_contacts t = {0};
        for (int round = 0; round < 2; round++) {
            froe_moving batch =
                motion_make(&r, (motion_kind)kind, kind == MOTION_QUADRATIC || kind == MOTION_CUBIC ? 4 : 6, &arrays);
            froe_motion *m = motion_of(&batch, NULL);
            judge_contacts(m, &t);
            froe_motion_free(m);
        }
        assert_true(t.contacts >= 8);
        const bool small = kind >= MOTION_LATTICE && kind != MOTION_RIGID && kind != MOTION_CUBIC;
        if (small) assert_true(t.instants > 3 && t.lasting > 10);
    }
}

/* ------------------------------------------------------------------- known cases -- */

static size_t contacts_of(const froe_moving *batch, const froe_contact_options *o, found *out) {
    froe_motion *m = motion_of(batch, NULL);
    found_in(m, o, out);
    froe_motion_free(m);
    return out->count;
}

/* A parabola that touches a standing segment in one point at t = 4, known exactly; from y = 8 down to 0 and up. */
static void a_grazing_contact_is_one_instant(void **state) {
    (void)state;
    static found f;
    const double times[] = {0, 8, 0, 8, 0, 0}, xy[] = {0, 8, 8, 8, 0, 12, 8, 12, -1, 0, 9, 0};
    const double controls[] = {4, -8, 0, 0, 4, -4, 0, 0, 0, 0, 0, 0};
    froe_moving b = froe_moving_defaults();
    b.vertex_count = 4;
    b.count = 2;
    b.starts = (const size_t[]){0, 2, 4, 5, 6};
    b.times = times;
    b.coords = xy;
    b.controls = controls;
    assert_int_equal(contacts_of(&b, NULL, &f), 1);
    const froe_contact *c = &f.list[0];
    assert_true(c->begin[0] == 4 && c->begin[1] == 4 && c->end[0] == 4 && c->end[1] == 4);
    assert_true(c->instant && !c->since_start && !c->to_stop);
}

/* A wall, and a bar that comes through it at t = 2. Between 4 and the next double it leaves the wall, comes back and
 * leaves it again, in quarters of that time. So the first contact goes on in the second piece, although both spans
 * there begin and end between the same doubles. */
static void contacts_within_neighbouring_doubles_are_kept_in_order(void **state) {
    (void)state;
    static found f;
    const double next = nextafter(4, 8), no = (double)NAN;
    const double times[] = {0, 4, next, 8, 0, 4, next, 8, 0, 0};
    const double xy[] = {0, 9, 0, -9, 0, 9, 0, 9, 0, 20, 0, 20, 0, 20, 0, 20, -1, 0, 1, 0};
    const double controls[] = {no, no, 0, 13, no, no, no, no, no, no, no, no, no, no, no, no, no, no, no, no};
    const double seconds[] = {no, no, 0, -13, no, no, no, no, no, no, no, no, no, no, no, no, no, no, no, no};
    froe_moving b = froe_moving_defaults();
    b.vertex_count = 4;
    b.count = 2;
    b.starts = (const size_t[]){0, 4, 8, 9, 10};
    b.times = times;
    b.coords = xy;
    b.controls = controls;
    b.second_controls = seconds;
    assert_int_equal(contacts_of(&b, NULL, &f), 2);
    const froe_contact *c = f.list;
    assert_true(c[0].begin[0] == 2 && c[0].begin[1] == 2 && !c[0].instant && !c[1].instant);
    assert_true(c[0].end[0] >= 4 && c[0].end[1] == next && c[1].begin[0] >= 4 && c[1].end[1] == next);
}

/* Three moving points that meet a wall at 1/3, 2 and 7 of the window, and one that never does. */
static const double wall_times[] = {0, 0, 0, 8, 0, 8, 0, 8, 0, 8, 0, 8, 0, 8, 0, 8, 0, 8};
static const double wall_xy[] = {0,  -9, 0, 9, 1,  1, -23, 1, 2, 1, -22, 1, 2, 3, -6, 3, 3, 3,
                                 -5, 3,  7, 5, -1, 5, 8,   5, 0, 5, 9,   7, 9, 7, 9,  8, 9, 8};

static froe_moving wall(void) {
    static const size_t starts[] = {0, 1, 2, 4, 6, 8, 10, 12, 14, 16, 18};
    froe_moving b = froe_moving_defaults();
    b.vertex_count = 10;
    b.count = 5;
    b.starts = starts;
    b.times = wall_times;
    b.coords = wall_xy;
    return b;
}

static void times_are_enclosed_and_the_first_is_found(void **state) {
    (void)state;
    static found f;
    froe_moving b = wall();
    assert_int_equal(contacts_of(&b, NULL, &f), 3);
    assert_true(f.list[0].b == 1 && f.list[1].b == 2 && f.list[2].b == 3);
    assert_true(f.list[0].begin[0] < 1.0 / 3 + 1e-15 && f.list[0].begin[1] >= 1.0 / 3 && !f.list[0].to_stop);
    assert_true(f.list[0].begin[1] - f.list[0].begin[0] < 4e-16 * 8);
    assert_true(f.list[1].begin[0] <= 2 && f.list[1].begin[1] >= 2 && f.list[1].end[0] <= 3 && f.list[1].end[1] >= 3);
    assert_true(f.list[2].to_stop && f.list[2].end[1] == 8 && !f.list[2].instant);
    froe_contact_options o = froe_contact_defaults();
    froe_contact_statistics statistics;
    o.first = true;
    o.statistics = &statistics;
    assert_int_equal(contacts_of(&b, &o, &f), 1);
    assert_int_equal(f.list[0].b, 1);
    assert_true(statistics.boxes >= 5 && statistics.candidates >= 3 && statistics.exact >= 3);
    o.first = false;
    o.from = 2.5;
    o.to = 7;
    assert_int_equal(contacts_of(&b, &o, &f), 2);
    assert_true(f.list[0].b == 2 && f.list[0].since_start && f.list[0].begin[0] == 2.5);
    assert_true(f.list[1].b == 3 && f.list[1].to_stop && f.list[1].instant && f.list[1].begin[1] == 7);
}

static void objects_of_one_group_or_vertex_may_be_left_out(void **state) {
    (void)state;
    static found f;
    froe_moving b = wall();
    b.vertices = (const uint32_t[]){0, 1, 2, 3, 0, 5, 6, 7, 8, 9}; /* the third hangs on the wall */
    assert_int_equal(contacts_of(&b, NULL, &f), 2);
    for (size_t i = 0; i < f.count; i++) assert_false(f.list[i].a == 0 && f.list[i].b == 2);
    froe_motion_options w = froe_motion_defaults();
    w.begin = 0;
    w.end = 8;
    froe_motion *m = NULL;
    assert_int_equal(froe_motion_new(&w, NULL, &m, NULL), FROE_OK);
    for (int i = 0; i < 2; i++) assert_int_equal(froe_motion_add_group(m, &(froe_group){.name = "g"}, NULL), FROE_OK);
    b = wall();
    b.groups = (const uint32_t[]){0, 0, 1, FROE_NONE, FROE_NONE};
    assert_int_equal(froe_motion_add(m, &b, NULL), FROE_OK);
    froe_contact_options o = froe_contact_defaults();
    o.apart = true;
    found_in(m, &o, &f);
    assert_int_equal(f.count, 2);
    assert_int_equal(f.list[0].b, 2);
    froe_motion_free(m);
}

/* ------------------------------------------------------------- refusals and limits -- */

static bool stop_at_once(void *user, const froe_contact *c) {
    (void)c;
    ++*(int *)user;
    return false;
}

static bool no_progress(void *user, double done) {
    (void)user;
    (void)done;
    return false;
}

static void bad_options_are_refused_and_calls_can_be_stopped(void **state) {
    (void)state;
    froe_moving b = wall();
    froe_motion *m = motion_of(&b, NULL);
    int told = 0;
    froe_diagnostic diag;
    assert_int_equal(froe_motion_contacts(m, NULL, stop_at_once, &told, NULL), FROE_OK);
    assert_int_equal(told, 1);
    assert_int_equal(froe_motion_contacts(m, NULL, NULL, NULL, NULL), FROE_E_ARG);
    froe_contact_options o = froe_contact_defaults();
    o.from = 9;
    assert_int_equal(froe_motion_contacts(m, &o, stop_at_once, &told, &diag), FROE_E_OPTIONS);
    assert_string_equal(diag.message, "The time 9 .. 8 does not lie in the window 0 .. 8.");
    o = froe_contact_defaults();
    o.progress = no_progress;
    assert_int_equal(froe_motion_contacts(m, &o, stop_at_once, &told, NULL), FROE_E_CANCELLED);
    o.size = 0;
    assert_int_equal(froe_motion_contacts(m, &o, stop_at_once, &told, NULL), FROE_E_OPTIONS);
    assert_int_equal(told, 1);
    froe_motion_free(m);
}

/* Without objects no coordinate and no time has a width. */
static void a_motion_without_objects_has_no_contacts(void **state) {
    (void)state;
    for (unsigned dim = 2; dim <= 3; dim++) {
        froe_motion_options w = froe_motion_defaults();
        froe_motion *m = NULL;
        int told = 0;
        w.dim = dim, w.begin = 0, w.end = 8;
        assert_int_equal(froe_motion_new(&w, NULL, &m, NULL), FROE_OK);
        assert_int_equal(froe_motion_contacts(m, NULL, stop_at_once, &told, NULL), FROE_OK);
        assert_int_equal(told, 0);
        froe_motion_free(m);
    }
}

/* The widest numbers that doubles make: the arena must hold whatever comes. */
static void nasty_coordinates_stay_within_the_arena(void **state) {
    (void)state;
    static motion_arrays arrays;
    fuzz_source r = {5};
    for (int kind = 0; kind < FUZZ_CLASSES; kind++) {
        froe_moving batch = motion_make(&r, kind % 2 ? MOTION_PARABOLIC : MOTION_LATTICE, 2, &arrays);
        fuzz_points(&r, (fuzz_class)kind, 2, arrays.xy, arrays.starts[4]);
        for (size_t i = 0; i < 2 * arrays.starts[4]; i++)
            if (!isnan(arrays.controls[i])) arrays.controls[i] = fuzz_coordinate(&r, (fuzz_class)kind);
        froe_motion *m = motion_of(&batch, NULL);
        meet_worker *w = calloc(1, sizeof *w);
        assert_non_null(w);
        assert_int_equal(meet_worker_new(m, w), FROE_OK);
        for (int t = 0; t < 8; t++) { /* no knot within */
            froe_status status = meet_find(m, w, 0, 1, t, t + 1);
            assert_true(status == FROE_OK || status == FROE_E_LIMIT);
        }
        assert_true(w->arena.high < w->arena.capacity / 2);
        meet_worker_free(m, w);
        free(w);
        froe_motion_free(m);
    }
}

/* ------------------------------------------------------------- beside the events -- */

enum { MOST_EVENTS = 1 << 16, SEEDS = 1 };

typedef struct told_event {
    froe_event event;
    double time[2];
} told_event;

typedef struct event_log {
    froe_kinetic *kinetic;
    told_event *list;
    size_t count;
} event_log;

static bool keep(void *user, const froe_event *event) {
    event_log *log = user;
    told_event *e = log->list + log->count++;
    assert_true(log->count < MOST_EVENTS);
    *e = (told_event){*event, {event->early, event->late}};
    assert_int_equal(froe_kinetic_instant(log->kinetic, e->time, NULL), FROE_OK);
    return true;
}

/* Whether an event tells that the two meet or part at a time: in place, or as a change of a plan or life of theirs. */
static bool is_told(const event_log *log, const froe_contact *c, const double time[2]) {
    for (size_t i = 0; i < log->count; i++) {
        const froe_event *e = &log->list[i].event;
        if (e->late < time[0] || e->early > time[1]) continue;
        if (e->kind == FROE_EVENT_CONTACT || e->kind == FROE_EVENT_BATCH) return true;
        const bool theirs = e->objects[0] == c->a || e->objects[0] == c->b;
        if (e->kind >= FROE_EVENT_PLAN && e->kind <= FROE_EVENT_DISAPPEAR && theirs) return true;
    }
    return false;
}

/* Do two segments lie in one line? Then a third one may hide both from the partition. */
static bool in_one_line(const froe_motion *m, const froe_contact *c, double time) {
    double at[4][2];
    for (uint32_t i = 0; i < 4; i++)
        froe_motion_position(m, froe_motion_object(m, i < 2 ? c->a : c->b).vertices[i % 2], time, at[i]);
    for (int i = 2; i < 4; i++) {
        const double u = at[1][0] - at[0][0], v = at[1][1] - at[0][1];
        if (fabs(u * (at[i][1] - at[0][1]) - v * (at[i][0] - at[0][0])) > 1e-9 * (fabs(u) + fabs(v))) return false;
    }
    return true;
}

/* Counts begins and ends of contacts, and those that are hidden. */
static void compare(const char *name, froe_motion *m, bool augmented, event_log *log, size_t seen[2]) {
    static found all;
    const froe_motion_options window = froe_motion_window(m);
    froe_kinetic_options o = froe_kinetic_defaults();
    o.augmented = augmented;
    log->count = 0;
    assert_int_equal(froe_kinetic_new(m, &o, NULL, &log->kinetic, NULL), FROE_OK);
    assert_int_equal(froe_kinetic_advance(log->kinetic, window.end, keep, log, NULL), FROE_OK);
    found_in(m, NULL, &all);
    for (size_t i = 0; i < 2 * all.count; i++) {
        const froe_contact *c = all.list + i / 2;
        const double *time = i % 2 ? c->end : c->begin;
        if (i % 2 ? c->to_stop : c->since_start) continue;
        if (time[0] <= window.begin + 1e-6 || time[1] >= window.end - 1e-6)
            continue; /* beside the first or last tick */
        seen[0]++;
        if (is_told(log, c, time)) continue;
        if (!in_one_line(m, c, time[0])) fail_msg("%s: %u and %u at %.17g: no event", name, c->a, c->b, time[0]);
        seen[1]++;
    }
    froe_kinetic_free(log->kinetic);
}

/* Wherever a contact begins or ends, an event says so. */
static void every_contact_is_an_event(void **state) {
    (void)state;
    size_t seen[2] = {0};
    event_log log = {.list = malloc(MOST_EVENTS * sizeof *log.list)};
    assert_non_null(log.list);
    for (size_t i = 0; i < 2 * SEEDS * MOVING_KINDS; i++) {
        const moving_kind *kind = moving_kinds + i / (2 * SEEDS);
        froe_motion *m = moving_new(kind, 1 + i / 2 % SEEDS, NULL);
        compare(kind->name, m, i % 2, &log, seen);
        froe_motion_free(m);
    }
    free(log.list);
    assert_true(seen[0] > 6000 && 200 * seen[1] < seen[0]);
}

/* ------------------------------------------------------------------------ faults -- */

static froe_status find_with(void *user, const froe_allocator *alloc) {
    static found f;
    froe_motion_options w = froe_motion_defaults();
    w.begin = 0;
    w.end = 8;
    froe_motion *m = NULL;
    froe_moving b = wall();
    froe_contact_options o = froe_contact_defaults();
    o.threads = 2;
    f.count = 0;
    froe_status status = froe_motion_new(&w, alloc, &m, NULL);
    if (!status) status = froe_motion_add(m, &b, NULL);
    if (!status) status = froe_motion_contacts(m, &o, found_note, &f, NULL);
    if (!status) assert_int_equal(f.count, 3);
    (void)user;
    froe_motion_free(m);
    return status;
}

static void every_allocation_may_fail(void **state) {
    (void)state;
    assert_true(test_memory_each(find_with, NULL) > 10);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(contacts_are_those_of_exact_brute_force),
        cmocka_unit_test(a_grazing_contact_is_one_instant),
        cmocka_unit_test(contacts_within_neighbouring_doubles_are_kept_in_order),
        cmocka_unit_test(times_are_enclosed_and_the_first_is_found),
        cmocka_unit_test(objects_of_one_group_or_vertex_may_be_left_out),
        cmocka_unit_test(bad_options_are_refused_and_calls_can_be_stopped),
        cmocka_unit_test(a_motion_without_objects_has_no_contacts),
        cmocka_unit_test(nasty_coordinates_stay_within_the_arena),
        cmocka_unit_test(every_contact_is_an_event),
        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
