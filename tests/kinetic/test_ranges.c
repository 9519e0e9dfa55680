/* test_ranges.c: partitions whose time goes on in ranges of x at once, on threads, against those that go from event to
 * event: the same events in the same order, and the same tree with the same certificates. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "kinetic/moving.h"
#include "support/memory.h"
#include "support/sanitized.h"
#include "support/turning.h"

/* What is compared: each event, and when it happened between two doubles. */
typedef struct told {
    froe_event event;
    double instant[2];
} told;

typedef struct record {
    froe_kinetic *kinetic;
    ARRAY(told) events;
    size_t stop; /* the visitor asks to stop after so many events */
} record;

static bool note(void *user, const froe_event *event) {
    record *r = user;
    const froe_allocator alloc = support_allocator(NULL);
    told t = {.event = *event};
    assert_int_equal(froe_kinetic_instant(r->kinetic, t.instant, NULL), FROE_OK);
    assert_true(froe_kinetic_time(r->kinetic) == event->late);
    assert_true(array_push(&alloc, &r->events, t));
    return r->events.count < r->stop;
}

/* As one partition, in ranges, and in ranges that are not guarded or do not stop at what is wider than the guard. */
typedef enum manner { ONE, RANGES, UNGUARDED, WIDE } manner;

static void set_tuning(froe_kinetic *k, manner how) {
    k->ranges.tuning = (ranges_tuning){.least = 4,
                                       .alone = 4,
                                       .pays = 0.02,
                                       .making = 0.1,

                                       .most = 3,
                                       .again = 100,
                                       .gaps = 0,
                                       .guard = {0x1p-8, 0x1p-5},
                                       .size = 16};
    k->ranges.tuning.unguarded = how == UNGUARDED;
    k->ranges.tuning.wide = how == WIDE;
}

static froe_kinetic *start(froe_motion *m, unsigned threads, uint64_t seed, manner how) {
    froe_kinetic_options o = froe_kinetic_defaults();
    froe_kinetic *k = NULL;
    froe_diagnostic why = {0};
    o.seed = seed;
    o.threads = how == ONE ? 1 : threads;
    o.ahead = how != ONE;
    if (froe_kinetic_new(m, &o, NULL, &k, &why)) fail_msg("%s", why.message);
    set_tuning(k, how);
    return k;
}

static void go(froe_kinetic *k, record *r, double time) {
    froe_diagnostic why = {0};
    r->kinetic = k;
    const froe_status status = froe_kinetic_advance(k, time, note, r, &why);
    if (status != (r->events.count >= r->stop ? FROE_E_CANCELLED : FROE_OK)) fail_msg("%s", why.message);
}

/* ---------------------------------------------------------------- comparing -- */

static bool is_same_event(const told *s, const told *t) {
    return s->event.kind == t->event.kind && s->event.object_count == t->event.object_count &&
           s->event.tick == t->event.tick && !memcmp(s->event.objects, t->event.objects, sizeof s->event.objects) &&
           s->event.early == t->event.early && s->event.late == t->event.late && s->instant[0] == t->instant[0] &&
           s->instant[1] == t->instant[1];
}

static bool is_same(const record *r, const froe_kinetic *const k[2]) {
    uint32_t found[2];
    if (r[0].events.count != r[1].events.count) return false;
    for (size_t i = 0; i < r[0].events.count; i++)
        if (!is_same_event(r[0].events.data + i, r[1].events.data + i)) return false;
    for (int i = 0; i < FROE_EVENT_KINDS; i++)
        if (k[0]->counts.events[i] != k[1]->counts.events[i]) return false;
    assert_int_equal(kinetic_compare(k[0], k[1], true, found), FROE_OK);
    return k[0]->now.tick == k[1]->now.tick && !found[0] && !found[1];
}

typedef struct sums {
    uint64_t windows, stopped, events, kinds[FROE_EVENT_KINDS];
} sums;

/* Are events and trees of both the same throughout? In thirds, one of which ends where the visitor stops. The motion is
 * freed. */
static bool compare_motion(froe_motion *m, uint64_t seed, unsigned threads, manner how, sums *all) {
    const froe_allocator alloc = support_allocator(NULL);
    froe_kinetic *const k[2] = {start(m, 1, seed, ONE), start(m, threads, seed, how)};
    record r[2] = {{.stop = SIZE_MAX}, {.stop = SIZE_MAX}};
    bool same = true;
    for (int part = 1; part <= 4 && same; part++) {
        const size_t stop = part == 2 ? r[0].events.count + 20 : SIZE_MAX;
        for (int i = 0; i < 2; i++) {
            r[i].stop = stop;
            go(k[i], r + i, part == 4 ? MOVING_TIME : MOVING_TIME * (part == 1 ? 0.3 : 0.7));
        }
        same = is_same(r, (const froe_kinetic *const *)k);
    }
    if (same) assert_int_equal(froe_kinetic_audit(k[1], NULL), FROE_OK);
    all->windows += k[1]->ranges.windows, all->stopped += k[1]->ranges.stopped;
    all->events += r[0].events.count;
    for (int i = 0; i < FROE_EVENT_KINDS; i++) all->kinds[i] += k[0]->counts.events[i];
    for (int i = 0; i < 2; i++) {
        froe_kinetic_free(k[i]);
        array_free(&alloc, &r[i].events);
    }
    froe_motion_free(m);
    return same;
}

static bool compare_runs(const moving_kind *kind, uint64_t seed, unsigned threads, manner how, sums *all) {
    return compare_motion(moving_new(kind, seed, NULL), seed, threads, how, all);
}

/* Bodies that turn, among segments that fly by themselves. */
static void test_bodies_turn_in_ranges_as_in_one_partition(void **state) {
    (void)state;
    static const turning_kind many = {
        .name = "many bodies", .bodies = 8, .each = 5, .free = 20, .grid = 9000, .size = 500, .speed = 3000, .legs = 3};
    sums all = {0};
    for (uint64_t seed = 1; seed <= (SANITIZED ? 1 : 2); seed++)
        if (!compare_motion(turning_new(&many, seed), seed, 3, RANGES, &all)) fail_msg("seed %u", (unsigned)seed);
    assert_true(all.windows > all.stopped && all.kinds[FROE_EVENT_TURN] && all.kinds[FROE_EVENT_CONTACT]);
}

enum { RESTING = 48, VISITS = 16 };

/* Segments at rest, and one that flies over ten of them and back, again and again, along cubics of which the second
 * control point alone is far away. */
static froe_motion *make_visits(void) {
    enum { KNOTS = 2 * RESTING + 2 * (VISITS + 1) };
    size_t starts[2 * RESTING + 3] = {0}, at = 0;
    double times[KNOTS] = {0}, coords[2 * KNOTS], controls[2 * KNOTS] = {0}, seconds[2 * KNOTS] = {0};
    for (size_t v = 0; v < 2 * RESTING + 2; v++, starts[v] = at)
        for (size_t i = 0; i < (v < 2 * RESTING ? 1 : VISITS + 1); i++, at++) {
            const double x[2] = {100.0 * (double)(v / 2 % RESTING) + 30.0 * (double)(v % 2), 7.0 * (double)(v % 11)};
            times[at] = (double)(i * MOVING_TIME) / VISITS;
            for (size_t c = 0; c < 2; c++) coords[2 * at + c] = controls[2 * at + c] = seconds[2 * at + c] = x[c];
            seconds[2 * at] += 2000;
        }
    froe_motion_options w = froe_motion_defaults();
    froe_moving b = froe_moving_defaults();
    w.begin = 0, w.end = MOVING_TIME;
    b.vertex_count = 2 * RESTING + 2, b.count = RESTING + 1;
    b.starts = starts, b.times = times, b.coords = coords, b.controls = controls, b.second_controls = seconds;
    return batch_motion(&w, &b, NULL);
}

/* A range knows who comes into it during a window, however far that one is before and after. */
static void test_visitors_of_a_range(void **state) {
    (void)state;
    sums all = {0};
    for (unsigned threads = 1; threads <= 8; threads++)
        assert_true(compare_motion(make_visits(), 1, threads, RANGES, &all));
    assert_true(all.windows > all.stopped && all.events > 1000);
}

/* So many segments, whose ends move straight from place to place. */
static froe_motion *straight_motion(size_t count, const size_t *starts, const double *times, const double *coords) {
    froe_motion_options w = froe_motion_defaults();
    froe_moving b = froe_moving_defaults();
    w.begin = 0, w.end = MOVING_TIME;
    b.vertex_count = 2 * count, b.count = count;
    b.starts = starts, b.times = times, b.coords = coords;
    return batch_motion(&w, &b, NULL);
}

enum { CORNER = 8, BESIDE = 40 };

/* At t = 32 three ends pass one another at x = 11. What may be there with them reaches to where two of these segments
 * cross, x = 9.89, and that is on the other side of a border at 9.9375, where most segments are. Two other ends pass at
 * x = 10 at the same time. */
static froe_motion *make_two_events_beside_a_border(void) {
    enum { SEGMENTS = CORNER + BESIDE };
    static const double moving[CORNER][4][2] = {/* both ends at the beginning, and at the end of the window */
                                                {{11, 0}, {9, 10}, {11, 0}, {9, 10}},
                                                {{10, 5}, {8, 6}, {12, 5}, {10, 6}},
                                                {{12, 20}, {13.5, 21}, {10, 20}, {11.5, 21}},
                                                {{10, -20}, {10.5, -25}, {10, -20}, {10.5, -25}},
                                                {{9.75, -30}, {10.25, -36}, {10.25, -30}, {10.75, -36}},
                                                {{-60, 0}, {-59, 1}, {-60, 0}, {-59, 1}},
                                                {{60, 0}, {61, 1}, {60, 0}, {61, 1}},
                                                {{55, -9}, {56, -8}, {64, -9}, {65, -8}}};
    size_t starts[2 * SEGMENTS + 1] = {0};
    double times[4 * SEGMENTS], coords[8 * SEGMENTS];
    for (size_t v = 0; v < (size_t)2 * SEGMENTS; v++) {
        const size_t s = v / 2, e = v % 2;
        const double width = (double)(s + 1) / 64;
        for (size_t i = 0; i < 2; i++) {
            times[2 * v + i] = (double)(i * MOVING_TIME);
            coords[4 * v + 2 * i] = s < CORNER ? moving[s][2 * i + e][0] : 9.9375 + (e ? width : -width);
            coords[4 * v + 2 * i + 1] = s < CORNER ? moving[s][2 * i + e][1] : 100 + 3 * (double)s + (double)e;
        }
        starts[v + 1] = 2 * v + 2;
    }
    return straight_motion(SEGMENTS, starts, times, coords);
}

/* Events of one tick are told by where their certificates are, however far what may be there with them reaches. */
static void test_events_of_one_tick_keep_their_order(void **state) {
    (void)state;
    sums all = {0};
    for (uint64_t seed = 1; seed <= 8; seed++)
        for (unsigned threads = 1; threads <= 2; threads++)
            assert_true(compare_motion(make_two_events_beside_a_border(), seed, threads, RANGES, &all));
    assert_true(all.windows > all.stopped && all.kinds[FROE_EVENT_BATCH]);
}

/* At t = 32 the plan of segment 0 goes on, which is above the end of another one on the left, and between two ends on
 * the right. Just then the end on the left passes its own end, so that it leaves and enters; and the two ends on the
 * right pass, with nothing between them. Most segments are in the middle, where half of them move. */
static froe_motion *make_pass_where_a_plan_goes_on(void) {
    enum { AROUND = 4, SEGMENTS = AROUND + BESIDE, KNOTS = 2 * SEGMENTS * 2 + 2 };
    static const double moving[AROUND][4][2] = {/* both ends at the beginning, and at the end of the window */
                                                {{-60, 0}, {60, 1}, {-60, 0}, {60, 1}},
                                                {{-64, -10}, {-70, -12}, {-56, -10}, {-62, -12}},
                                                {{36, 5}, {46, 6}, {44, 5}, {54, 6}},
                                                {{44, -5}, {56, -6}, {36, -5}, {48, -6}}};
    size_t starts[2 * SEGMENTS + 1] = {0}, at = 0;
    double times[KNOTS], coords[2 * KNOTS];
    for (size_t v = 0; v < (size_t)2 * SEGMENTS; v++, starts[v] = at) {
        const size_t s = v / 2, e = v % 2, knots = s ? 2 : 3;
        const double width = (double)(s + 1) / 64;
        for (size_t i = 0; i < knots; i++, at++) {
            const double away = s % 2 ? 0 : 0.83 * (double)i - 0.4;
            times[at] = (double)(i * MOVING_TIME) / (double)(knots - 1);
            coords[2 * at] = s < AROUND ? moving[s][i / (knots - 1) * 2 + e][0] : away + (e ? width : -width);
            coords[2 * at + 1] = s < AROUND ? moving[s][i / (knots - 1) * 2 + e][1] + (double)(knots == 3 && i == 1)
                                            : 100 + 3 * (double)s + (double)e;
        }
    }
    return straight_motion(SEGMENTS, starts, times, coords);
}

/* A segment that was to stay while its plan goes on leaves in all of its ranges, or in none. */
static void test_segments_leave_everywhere(void **state) {
    (void)state;
    sums all = {0};
    for (uint64_t seed = 1; seed <= 8; seed++)
        for (unsigned threads = 1; threads <= 2; threads++)
            assert_true(compare_motion(make_pass_where_a_plan_goes_on(), seed, threads, RANGES, &all));
    assert_true(all.windows > 0);
}

/* On one to eight threads. */
static void test_events_and_trees_do_not_depend_on_threads(void **state) {
    (void)state;
    sums all = {0};
    for (size_t i = 0; i < MOVING_KINDS; i++)
        if (!compare_runs(moving_kinds + i, 1, 1 + (unsigned)(i + 1) % 8, RANGES, &all))
            fail_msg("%s", moving_kinds[i].name);
    assert_true(all.events > 16000);
    assert_true(all.windows - all.stopped > 100 && all.stopped > 30);
    for (int i = 0; i < FROE_EVENT_FLOP; i++) assert_true(all.kinds[i]);
}

/* How many of two runs of each kind are not what they should be, or at least enough. Sanitizers need not watch what is
 * crippled. */
static unsigned count_wrong(manner how, unsigned enough) {
    if (SANITIZED) skip();
    unsigned wrong = 0;
    sums all = {0};
    for (size_t i = 0; i < MOVING_KINDS && wrong < enough; i++)
        for (uint64_t seed = 1; seed <= 2; seed++) wrong += !compare_runs(moving_kinds + i, seed, 4, how, &all);
    return wrong;
}

static void test_ranges_need_their_guards(void **state) {
    (void)state;
    assert_true(count_wrong(UNGUARDED, 11) > 10);
}

static void test_ranges_need_to_stop_at_what_is_wide(void **state) {
    (void)state;
    assert_true(count_wrong(WIDE, 1) > 0);
}

/* -------------------------------------------------------------------- calls -- */

static const moving_kind many = {
    .name = "many", .count = 200, .grid = 8192, .length = 500, .speed = 64, .spin = 16, .legs = 2};

typedef struct asked {
    unsigned calls, most;
} asked;

static bool go_on(void *user, double done) {
    asked *a = user;
    (void)done;
    return ++a->calls < a->most;
}

/* Wherever the call is cancelled, the next one goes on. */
static void test_cancelled(void **state) {
    (void)state;
    froe_motion *m = moving_new(&many, 1, NULL);
    unsigned cancelled = 0;
    for (unsigned most = 1; most < 400; most = most * 2 + 1) {
        froe_kinetic *k = start(m, 3, 1, RANGES);
        asked a = {0, most};
        froe_kinetic_watch(k, go_on, &a);
        const froe_status status = froe_kinetic_advance(k, MOVING_TIME, NULL, NULL, NULL);
        assert_true(status == FROE_OK || status == FROE_E_CANCELLED);
        cancelled += status == FROE_E_CANCELLED;
        froe_kinetic_watch(k, NULL, NULL);
        assert_int_equal(froe_kinetic_advance(k, MOVING_TIME, NULL, NULL, NULL), FROE_OK);
        assert_int_equal(froe_kinetic_audit(k, NULL), FROE_OK);
        froe_kinetic_free(k);
    }
    assert_true(cancelled > 3);
    froe_motion_free(m);
}

static bool stop_at_once(void *user, const froe_event *event) {
    (void)event;
    ++*(unsigned *)user;
    return false;
}

/* What is found ahead is lost where the visitor stops. So after each such window more events have to come before the
 * next one is tried: 50, 100, 200, ... */
static void test_visitors_that_stop_have_few_windows(void **state) {
    (void)state;
    froe_motion *m = moving_new(&many, 1, NULL);
    unsigned stops = 0;
    froe_kinetic *k = start(m, 2, 1, RANGES);
    while (stops < 400 && froe_kinetic_advance(k, MOVING_TIME, stop_at_once, &stops, NULL) == FROE_E_CANCELLED)
        continue;
    assert_int_equal(stops, 400);
    assert_in_range(k->ranges.windows, 2, 5);
    froe_kinetic_free(k);
    froe_motion_free(m);
}

static froe_status with_memory(void *user, const froe_allocator *alloc) {
    froe_kinetic *k = NULL;
    froe_kinetic_options o = froe_kinetic_defaults();
    o.threads = 2;
    froe_status status = froe_kinetic_new(user, &o, alloc, &k, NULL);
    if (status) return status;
    set_tuning(k, RANGES);
    status = froe_kinetic_advance(k, MOVING_TIME / 8.0, NULL, NULL, NULL);
    if (!status) status = froe_kinetic_audit(k, NULL);
    if (!status) assert_true(k->ranges.windows);
    froe_kinetic_free(k);
    return status;
}

static void test_memory_runs_out(void **state) {
    (void)state;
    moving_kind few = many;
    few.count = SANITIZED ? 10 : 20, few.length = 3000;
    froe_motion *m = moving_new(&few, 1, NULL);
    test_memory_each(with_memory, m);
    froe_motion_free(m);
}

/* Where that is not possible, time goes on in one partition. */
static void test_one_partition_otherwise(void **state) {
    (void)state;
    froe_motion *m = moving_new(&many, 1, NULL);
    for (int i = 0; i < 4; i++) {
        froe_kinetic_options o = froe_kinetic_defaults();
        froe_kinetic *k = NULL;
        o.threads = 4;
        o.augmented = i == 1, o.swap = i == 2 ? 100 : 0, o.epoch = i == 3 ? 100 : 0;
        assert_int_equal(froe_kinetic_new(m, &o, NULL, &k, NULL), FROE_OK);
        set_tuning(k, RANGES);
        assert_int_equal(froe_kinetic_advance(k, MOVING_TIME / 4.0, NULL, NULL, NULL), FROE_OK);
        assert_int_equal(k->ranges.windows > 0, i == 0);
        froe_kinetic_free(k);
    }
    froe_motion_free(m);
}

/* As many ranges as threads would have most segments in common, however short the window: fewer ranges have not. */
static void test_more_threads_than_ranges(void **state) {
    (void)state;
    froe_motion *m = moving_new(&many, 1, NULL);
    const unsigned threads[] = {2, 16, 64, 256};
    for (int i = 0; i < 4; i++) {
        froe_kinetic *k = start(m, threads[i], 1, RANGES);
        k->ranges.tuning.again = 1.5;
        k->ranges.tuning.pays = 0.5;
        assert_int_equal(froe_kinetic_advance(k, MOVING_TIME / 4.0, NULL, NULL, NULL), FROE_OK);
        assert_true(k->ranges.windows > 0);
        froe_kinetic_free(k);
    }
    froe_motion_free(m);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_events_and_trees_do_not_depend_on_threads),
        cmocka_unit_test(test_visitors_of_a_range),
        cmocka_unit_test(test_events_of_one_tick_keep_their_order),
        cmocka_unit_test(test_segments_leave_everywhere),
        cmocka_unit_test(test_bodies_turn_in_ranges_as_in_one_partition),
        cmocka_unit_test(test_ranges_need_their_guards),
        cmocka_unit_test(test_ranges_need_to_stop_at_what_is_wide),
        cmocka_unit_test(test_cancelled),
        cmocka_unit_test(test_visitors_that_stop_have_few_windows),
        cmocka_unit_test(test_memory_runs_out),
        cmocka_unit_test(test_one_partition_otherwise),
        cmocka_unit_test(test_more_threads_than_ranges),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
