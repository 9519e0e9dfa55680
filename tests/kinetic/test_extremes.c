/* test_extremes.c: motions at the ends of what doubles are: coordinates next to the largest and the smallest, windows
 * of one tick, of 2^52 and of any length. All is answered, or refused with a sentence. The unit of time changes nothing
 * of what happens. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <float.h>
#include <math.h>

#include "support/fuzz.h"
#include <froe/kinetic.h>

enum { SEGMENTS = 4, KNOTS = 3 };

typedef struct tally {
    unsigned windows, plans, partitions, contacts, snapshots, limits;
} tally;

static double extreme(fuzz_source *r) {
    const double some[] = {0, 1, 3, DBL_MAX, 0x1p1023, 0x1.8p1020, 0x1p1018, 0x1p-1074, 0x1p-1022, 0x1p511, 0x1p-540};
    const int what = fuzz_int(r, 0, 14);
    double x = what < 11 ? some[what] : what < 13 ? fuzz_int(r, 0, 8) : fuzz_finite(r);
    return fuzz_int(r, 0, 1) ? -x : x;
}

/* A window, from which all times of plans are taken. */
static froe_motion_options window_of(fuzz_source *r) {
    froe_motion_options w = froe_motion_defaults();
    const double lengths[] = {16, 0x1p63, 0x1p1023, 0x1p-1060, 0x1p-1074, 0x1p-1022, 3, 0x1p52};
    const double length = lengths[fuzz_int(r, 0, 7)];
    w.begin = fuzz_int(r, 0, 1) ? 0 : fuzz_int(r, 0, 1) ? -0.5 * length : extreme(r);
    w.end = w.begin + length;
    const double ticks[] = {0, 1, length * 0x1p-52, length * 0.5, length, length * 0x1p-20};
    w.tick = ticks[fuzz_int(r, 0, 5)];
    return w;
}

static bool told(const froe_diagnostic *why) {
    return why->message[0] != 0;
}

/* False: the batch is refused. */
static bool add(fuzz_source *r, froe_motion *m, const froe_motion_options *w) {
    size_t starts[2 * SEGMENTS + 1] = {0};
    double times[2 * SEGMENTS * KNOTS], coords[4 * SEGMENTS * KNOTS], controls[4 * SEGMENTS * KNOTS];
    uint32_t vertices[2 * SEGMENTS];
    for (size_t v = 0; v < 2 * SEGMENTS; v++) {
        const int pieces = fuzz_int(r, 0, KNOTS - 1);
        const size_t at = starts[v];
        for (size_t i = 0; i <= (size_t)pieces; i++) {
            times[at + i] = i == 0 ? w->begin : i == (size_t)pieces ? w->end : 0.5 * w->begin + 0.5 * w->end;
            if (!fuzz_int(r, 0, 7)) times[at + i] = i ? DBL_MAX : -DBL_MAX;
            const bool straight = fuzz_int(r, 0, 2);
            for (size_t k = 0; k < 2; k++) {
                coords[2 * (at + i) + k] = extreme(r);
                controls[2 * (at + i) + k] = straight ? (double)NAN : extreme(r);
            }
        }
        starts[v + 1] = at + (size_t)pieces + 1;
        vertices[v] = (uint32_t)(v && fuzz_int(r, 0, 3) == 0 ? v - 1 : v);
    }
    froe_moving b = froe_moving_defaults();
    froe_diagnostic why = {0};
    b.vertex_count = 2 * SEGMENTS, b.count = SEGMENTS, b.starts = starts, b.times = times;
    b.coords = coords, b.controls = controls, b.vertices = vertices;
    const froe_status status = froe_motion_add(m, &b, &why);
    if (status) assert_true(status == FROE_E_INPUT && told(&why));
    return status == FROE_OK;
}

static bool count_fragment(void *user, uint32_t object, const double ends[4]) {
    (void)object;
    (void)ends;
    ++*(unsigned *)user;
    return true;
}

static void ask(froe_kinetic *k, fuzz_source *r, tally *t) {
    froe_diagnostic why = {0};
    for (int i = 0; i < 4; i++) {
        const double from[2] = {extreme(r), extreme(r)}, to[2] = {extreme(r), extreme(r)};
        froe_kinetic_place place;
        uint32_t hit;
        unsigned count = 0;
        assert_int_equal(froe_kinetic_locate(k, from, &place, NULL), FROE_OK);
        assert_int_equal(froe_kinetic_ray(k, from, to, &hit, NULL), FROE_OK);
        assert_int_equal(froe_kinetic_order(k, from, count_fragment, &count, NULL), FROE_OK);
    }
    froe_snapshot s = {.tree = NULL};
    const froe_status status = froe_kinetic_snapshot(k, NULL, &s, &why);
    if (status) fail_msg("%d %s", status, why.message);
    t->snapshots++;
    froe_tree_free(s.tree), froe_places_free(s.places);
}

static void follow(fuzz_source *r, froe_motion *m, tally *t) {
    froe_kinetic_options o = froe_kinetic_defaults();
    froe_diagnostic why = {0};
    froe_kinetic *k = NULL;
    o.augmented = fuzz_int(r, 0, 1);
    if (froe_kinetic_new(m, &o, NULL, &k, &why)) fail_msg("%s", why.message);
    t->partitions++;
    const froe_motion_options w = froe_motion_window(m);
    for (int i = 0; i < 6; i++) {
        const double share = i / 5.0, next = froe_kinetic_next(k);
        double time = (1 - share) * w.begin + share * w.end;
        if (i % 2 && next <= w.end) time = next;
        if (time < froe_kinetic_time(k)) time = froe_kinetic_time(k);
        if (froe_kinetic_advance(k, time, NULL, NULL, &why)) fail_msg("%s", why.message);
        if (froe_kinetic_audit(k, &why)) fail_msg("%s", why.message);
        ask(k, r, t);
    }
    assert_int_equal(froe_kinetic_statistics(k).stuck, 0);
    froe_kinetic_free(k);
}

static bool count_contact(void *user, const froe_contact *contact) {
    (void)contact;
    ++*(unsigned *)user;
    return true;
}

static void find_contacts(froe_motion *m, tally *t) {
    froe_contact_options o = froe_contact_defaults();
    froe_diagnostic why = {0};
    o.threads = 1;
    const froe_status status = froe_motion_contacts(m, &o, count_contact, &t->contacts, &why);
    if (status && (status != FROE_E_LIMIT || !told(&why))) fail_msg("%d %s", status, why.message);
    t->limits += status == FROE_E_LIMIT;
}

static void run(uint64_t seed, tally *t) {
    fuzz_source r = {seed};
    const froe_motion_options w = window_of(&r);
    froe_motion *m = NULL;
    froe_diagnostic why = {0};
    const froe_status status = froe_motion_new(&w, NULL, &m, &why);
    if (status) {
        assert_true((status == FROE_E_OPTIONS || status == FROE_E_INPUT) && told(&why));
        return;
    }
    t->windows++;
    if (add(&r, m, &w)) {
        t->plans++;
        follow(&r, m, t);
        if (seed % 8 == 0) find_contacts(m, t);
    }
    froe_motion_free(m);
}

static void test_all_is_answered_or_refused(void **state) {
    (void)state;
    tally t = {0};
    for (uint64_t seed = 1; seed <= 120; seed++) run(seed, &t);
    assert_true(t.windows > 30 && t.plans > 20 && t.partitions == t.plans && t.snapshots > 100);
}

/* Polynomials whose coefficients are infinite as doubles were halved for ever, in the hope that they become sure. */
static void test_a_segment_near_the_largest_double(void **state) {
    (void)state;
    tally t = {0};
    for (int turn = 0; turn < 2; turn++) {
        const size_t starts[] = {0, 3, 6};
        const double times[] = {0, 8, 16, 0, 8, 16};
        const double coords[] = {turn ? -DBL_MAX : 1e308, 3, 0.1, -8, -8, -8, -8, -8, -8, -8, -8, turn ? DBL_MAX : -8};
        froe_motion_options w = froe_motion_defaults();
        froe_motion *m = NULL;
        w.begin = 0, w.end = 16;
        assert_int_equal(froe_motion_new(&w, NULL, &m, NULL), FROE_OK);
        froe_moving b = froe_moving_defaults();
        b.vertex_count = 2, b.count = 1, b.starts = starts, b.times = times, b.coords = coords;
        assert_int_equal(froe_motion_add(m, &b, NULL), FROE_OK);
        fuzz_source r = {1};
        follow(&r, m, &t);
        froe_motion_free(m);
    }
    assert_int_equal(t.partitions, 2);
}

/* Slices of a window whose halves are 0 had no length, and there was no end of them. */
static void test_contacts_in_the_shortest_window(void **state) {
    (void)state;
    const size_t starts[] = {0, 2, 4, 5, 6};
    const double times[] = {0, 0x1p-1074, 0, 0x1p-1074, 0, 0}, coords[] = {0, 0, 8, 0, 0, 8, 8, 8, 4, 4, 5, 4};
    froe_motion_options w = froe_motion_defaults();
    froe_motion *m = NULL;
    tally t = {0};
    w.begin = 0, w.end = 0x1p-1074, w.tick = 0x1p-1074;
    assert_int_equal(froe_motion_new(&w, NULL, &m, NULL), FROE_OK);
    froe_moving b = froe_moving_defaults();
    b.vertex_count = 4, b.count = 2, b.starts = starts, b.times = times, b.coords = coords;
    assert_int_equal(froe_motion_add(m, &b, NULL), FROE_OK);
    find_contacts(m, &t);
    assert_int_equal(t.contacts, 1);
    froe_motion_free(m);
}

static bool keep(void *user, const froe_contact *c) {
    *(froe_contact *)user = *c;
    return true;
}

/* A third of the window: no double. Error bounds, which end at 2^-1000, said no more than that it was in the window. */
static void test_contacts_in_tiny_windows_are_close(void **state) {
    (void)state;
    const double windows[] = {0x1p-500, 0x1p-960, 0x1p-1000, 0x1p-1040, 0x1p-1060};
    for (size_t i = 0; i < sizeof windows / sizeof *windows; i++) {
        const size_t starts[] = {0, 2, 4, 5, 6};
        const double end = windows[i], coords[] = {0, 0, 0, 3, 8, 0, 8, 3, 4, 1, 5, 1};
        const double times[] = {0, end, 0, end, 0, 0};
        froe_motion_options w = froe_motion_defaults();
        froe_motion *m = NULL;
        froe_contact c = {.begin = {-1, -1}};
        w.begin = 0, w.end = end;
        assert_int_equal(froe_motion_new(&w, NULL, &m, NULL), FROE_OK);
        froe_moving b = froe_moving_defaults();
        b.vertex_count = 4, b.count = 2, b.starts = starts, b.times = times, b.coords = coords;
        assert_int_equal(froe_motion_add(m, &b, NULL), FROE_OK);
        assert_int_equal(froe_motion_contacts(m, NULL, keep, &c, NULL), FROE_OK);
        const double low = c.begin[0], high = c.begin[1];
        assert_true(c.instant && low <= end / 3 && high >= end / 3);
        assert_true(high - low <= end * 0x1p-50 + 0x1p-1072);
        froe_motion_free(m);
    }
}

/* ---------------------------------------------------------------- units of time -- */

enum { BARS = 8, NOTED = 512 };

typedef struct diary {
    size_t count;
    froe_event events[NOTED];
} diary;

static bool note(void *user, const froe_event *event) {
    diary *d = user;
    assert_true(d->count < NOTED);
    d->events[d->count++] = *event;
    return true;
}

/* Bars on a grid that fly straight, on parabolas and on cubics, with times in units of 2^power. */
static froe_motion *bars_of(uint64_t seed, int power) {
    fuzz_source r = {seed};
    size_t starts[2 * BARS + 1] = {0};
    double times[4 * BARS], coords[8 * BARS], controls[8 * BARS], seconds[8 * BARS];
    for (size_t i = 0; i < 4 * BARS; i++) {
        const int degree = fuzz_int(&r, 1, 3);
        times[i] = i % 2 ? ldexp(4, power) : 0;
        starts[i / 2 + 1] = 2 * (i / 2 + 1);
        for (size_t k = 2 * i; k < 2 * i + 2; k++) {
            coords[k] = fuzz_int(&r, 0, 4);
            controls[k] = degree > 1 ? fuzz_int(&r, 0, 4) : (double)NAN;
            seconds[k] = degree > 2 ? fuzz_int(&r, 0, 4) : (double)NAN;
        }
    }
    froe_motion_options w = froe_motion_defaults();
    froe_motion *m = NULL;
    w.begin = 0, w.end = ldexp(4, power);
    assert_int_equal(froe_motion_new(&w, NULL, &m, NULL), FROE_OK);
    froe_moving b = froe_moving_defaults();
    b.vertex_count = 2 * BARS, b.count = BARS, b.starts = starts, b.times = times, b.coords = coords;
    b.controls = controls, b.second_controls = seconds;
    assert_int_equal(froe_motion_add(m, &b, NULL), FROE_OK);
    return m;
}

static void keep_diary(froe_motion *m, diary *out) {
    const double end = froe_motion_window(m).end;
    froe_kinetic_options o = froe_kinetic_defaults();
    froe_kinetic *k = NULL;
    froe_diagnostic why = {0};
    assert_int_equal(froe_kinetic_new(m, &o, NULL, &k, NULL), FROE_OK);
    for (int i = 1; i <= 8; i++) {
        assert_int_equal(froe_kinetic_advance(k, end * i / 8, note, out, NULL), FROE_OK);
        if (froe_kinetic_audit(k, &why)) fail_msg("until %g: %s", end * i / 8, why.message);
    }
    froe_kinetic_free(k);
}

/* Powers of such times, and their products with coordinates, are no doubles: places were unknown then, repairs left
 * out what was near, and partitions were wrong. */
static void test_events_do_not_depend_on_the_unit_of_time(void **state) {
    (void)state;
    const int powers[] = {0, 90, 110, 300, 600, 1000, -90, -110, -340, -600, -1000};
    size_t events = 0;
    for (uint64_t seed = 1; seed <= 12; seed++) {
        diary first = {0};
        for (size_t i = 0; i < sizeof powers / sizeof *powers; i++) {
            diary d = {0};
            froe_motion *m = bars_of(seed, powers[i]);
            keep_diary(m, i ? &d : &first);
            froe_motion_free(m);
            if (!i) continue;
            assert_int_equal(d.count, first.count);
            for (size_t j = 0; j < d.count; j++) {
                const froe_event *a = d.events + j, *b = first.events + j;
                assert_true(a->kind == b->kind && a->tick == b->tick && a->object_count == b->object_count);
                for (unsigned n = 0; n < a->object_count && n < 4; n++) assert_int_equal(a->objects[n], b->objects[n]);
            }
        }
        events += first.count;
    }
    assert_true(events > 300);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_all_is_answered_or_refused),
                                       cmocka_unit_test(test_a_segment_near_the_largest_double),
                                       cmocka_unit_test(test_contacts_in_the_shortest_window),
                                       cmocka_unit_test(test_contacts_in_tiny_windows_are_close),
                                       cmocka_unit_test(test_events_do_not_depend_on_the_unit_of_time)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
