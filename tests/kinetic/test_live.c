/* test_live.c: partitions of moving segments against partitions made from scratch, after every event. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "support/memory.h"
#include "support/patterns.h"
#include "support/sanitized.h"

static bool augmented; /* all tests run in both variants */

static froe_kinetic *start(froe_motion *m, uint64_t seed) {
    froe_kinetic_options o = froe_kinetic_defaults();
    froe_kinetic *k = NULL;
    froe_diagnostic why = {0};
    o.seed = seed;
    o.augmented = augmented;
    if (froe_kinetic_new(m, &o, NULL, &k, &why)) fail_msg("%s", why.message);
    return k;
}

static void audit(froe_kinetic *k, const char *what) {
    froe_diagnostic why = {0};
    if (froe_kinetic_audit(k, &why)) fail_msg("%s at %.12g: %s", what, froe_kinetic_time(k), why.message);
}

static void run(froe_kinetic *k, const char *what, uint64_t most, pattern_counter *counter) {
    froe_diagnostic why = {0};
    if (following_run(k, most, counter, &why)) fail_msg("%s at %.12g: %s", what, froe_kinetic_time(k), why.message);
}

static void expect_all_patterns(const pattern_counter *counter) {
    for (int i = 0; i < PATTERN_KINDS; i++)
        for (int j = 0; j < pattern_counts[i]; j++)
            if (!counter->seen[i][j]) fail_msg("no event of pattern %s %d", pattern_names[i], j);
}

static void test_every_event(void **state) {
    (void)state;
    uint64_t kind_events[FROE_EVENT_KINDS] = {0};
    pattern_counter counter = {0};
    for (size_t i = 0; i < MOVING_KINDS; i++) {
        const uint64_t before = counter.events;
        for (uint64_t seed = 1; seed <= 3; seed++) {
            froe_motion *m = moving_new(moving_kinds + i, seed, NULL);
            froe_kinetic *k = start(m, seed);
            run(k, moving_kinds[i].name, SANITIZED ? 20 : 100, &counter);
            froe_kinetic_stats s = froe_kinetic_statistics(k);
            assert_int_equal(s.stuck, 0);
            for (int j = 0; j < FROE_EVENT_KINDS; j++) kind_events[j] += s.events[j];
            froe_kinetic_free(k);
            froe_motion_free(m);
        }
        const bool still = moving_kinds[i].rigid && !moving_kinds[i].against; /* nothing moves past anything */
        if (still != (counter.events == before)) fail_msg("%s: no events, or some", moving_kinds[i].name);
    }
    if (SANITIZED) return; /* too few events for every kind and pattern */
    for (int j = 0; j < FROE_EVENT_KINDS; j++)
        if (!kind_events[j] && j < FROE_EVENT_FLOP)
            fail_msg("no event of kind %s", froe_event_name((froe_event_kind)j));
    assert_true(counter.events >= 4000);
    expect_all_patterns(&counter);
}

/* Segments on an integer lattice that do not turn: whole edges lie in one line for an instant, ends ride on others.
 * What happens to those that have no certificates of their own was missed once, in these runs. */
static void follow_lattice(const moving_kind *kind, uint64_t seed) {
    pattern_counter counter = {0};
    froe_motion *m = moving_new(kind, seed, NULL);
    froe_kinetic *k = start(m, seed);
    run(k, kind->name, 180, &counter);
    froe_kinetic_stats s = froe_kinetic_statistics(k);
    assert_int_equal(s.restarts + s.stuck, 0);
    froe_kinetic_free(k);
    froe_motion_free(m);
}

static void test_coincidences(void **state) {
    (void)state;
    static const struct {
        int length, spin, count;
        uint64_t seeds[8];
    } missed[] = {{3, 0, 8, {1, 15, 18, 31, 49, 69, 95, 125}},
                  {4, 0, 1, {21}},
                  {4, 1, 1, {21}},
                  {5, 0, 5, {15, 59, 81, 85, 128}}};
    for (size_t i = 0; i < sizeof missed / sizeof *missed; i++)
        for (int j = 0; j < missed[i].count; j++) {
            const moving_kind kind = {.name = "lattice",
                                      .count = 30,
                                      .grid = 8,
                                      .length = missed[i].length,
                                      .speed = 1,
                                      .spin = missed[i].spin};
            follow_lattice(&kind, missed[i].seeds[j]);
        }
}

/* With ticks so long that all is elsewhere after each: crossings leave their segments, pass infinity and are back. That
 * their order may change by that was missed once, in the first two. */
static void test_long_ticks(void **state) {
    (void)state;
    for (uint64_t seed = 1; seed <= 60; seed++) {
        const bool curved = seed % 2;
        const uint64_t missed[2] = {511, 35}, number = seed > 2 ? seed : missed[seed - 1];
        const moving_kind wild = {.name = "wild",
                                  .count = 3 + (int)(number % 5),
                                  .grid = 1000,
                                  .length = 1500,
                                  .speed = 3,
                                  .spin = 300,
                                  .legs = 5,
                                  .curved = curved,
                                  .tick = curved ? 1 : 2};
        froe_motion *m = moving_new(&wild, number, NULL);
        froe_kinetic *k = start(m, number);
        run(k, wild.name, 1000, &(pattern_counter){0});
        assert_int_equal(froe_kinetic_statistics(k).stuck, 0);
        froe_kinetic_free(k);
        froe_motion_free(m);
    }
}

/* In general position there is nothing to fall back to. */
static void test_general_position(void **state) {
    (void)state;
    static const moving_kind general = {
        .name = "general", .count = 120, .grid = 1 << 16, .length = 1 << 13, .speed = 300, .spin = 100};
    froe_motion *m = moving_new(&general, 5, NULL);
    froe_kinetic *k = start(m, 5);
    assert_int_equal(froe_kinetic_advance(k, MOVING_TIME / 4, NULL, NULL, NULL), FROE_OK);
    audit(k, "general");
    froe_kinetic_stats s = froe_kinetic_statistics(k);
    assert_int_equal(s.restarts + s.stuck, 0);
    assert_true(s.crowds <= s.batches);
    assert_true(s.surgeries > 1000);
    froe_kinetic_free(k);
    froe_motion_free(m);
}

/* There and back again: positions at tick t and at the last but t are the same, and so is the tree. */
static void test_reversal(void **state) {
    (void)state;
    static const moving_kind ways[] = {
        {.name = "back", .count = 30, .grid = 4096, .length = 2000, .speed = 64, .spin = 32, .legs = 2, .back = true},
        {.name = "curved back",
         .count = 16,
         .grid = 4096,
         .length = 2000,
         .speed = 64,
         .spin = 32,
         .legs = 2,
         .curved = true,
         .back = true},
        {.name = "cubic back",
         .count = 16,
         .grid = 4096,
         .length = 2000,
         .speed = 64,
         .spin = 32,
         .legs = 2,
         .curved = true,
         .cubic = true,
         .back = true},
        {.name = "lattice back", .count = 24, .grid = 16, .length = 6, .speed = 2, .spin = 1, .legs = 2, .back = true},
    };
    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++) {
        froe_motion *m = moving_new(ways + i, 3 + i, NULL);
        froe_kinetic *k = start(m, 9), *first = start(m, 9);
        assert_int_equal(froe_kinetic_advance(k, MOVING_TIME, NULL, NULL, NULL), FROE_OK);
        assert_int_equal(k->now.tick, m->last_tick - 1);
        audit(k, ways[i].name);
        uint32_t node[2];
        assert_int_equal(kinetic_compare(k, first, false, node), FROE_OK);
        assert_int_equal(node[0], KTREE_LEAF);
        assert_int_equal(k->tree.node_count, first->tree.node_count);
        froe_kinetic_free(first);
        froe_kinetic_free(k);
        froe_motion_free(m);
    }
}

/* -------------------------------------------------------------------- changes -- */

static void test_changes(void **state) {
    (void)state;
    fuzz_source r = {77};
    const moving_kind *kind = moving_kind_named("rigid against rigid");
    froe_motion *m = moving_new(kind, 4, NULL);
    froe_kinetic *k = start(m, 4);
    for (int i = 0; i < 60; i++) {
        double now = froe_kinetic_time(k);
        assert_int_equal(froe_kinetic_advance(k, now + 0.9, NULL, NULL, NULL), FROE_OK);
        now = froe_kinetic_time(k);
        uint32_t vertex = (uint32_t)fuzz_int(&r, 0, (int)froe_motion_vertex_count(m) - 1);
        double times[2] = {now - 1, MOVING_TIME}, at[2], xy[4];
        if (!froe_motion_position(m, vertex, now, at)) continue;
        for (int c = 0; c < 2; c++) xy[c] = at[c], xy[2 + c] = fuzz_int(&r, 0, 3000);
        if (i % 3 == 0) {
            assert_int_equal(froe_kinetic_replan(k, vertex, 2, times, xy, NULL, NULL, NULL), FROE_OK);
        } else if (i % 3 == 1) {
            times[1] = now; /* too short */
            froe_diagnostic why = {0};
            froe_status status = froe_kinetic_replan(k, vertex, 2, times, xy, NULL, NULL, &why);
            assert_true(status == FROE_E_INPUT || status == FROE_OK);
        } else {
            uint32_t gone = (uint32_t)fuzz_int(&r, 0, kind->count - 1);
            assert_int_equal(froe_kinetic_remove(k, gone, NULL), FROE_OK);
            froe_moving b = froe_moving_defaults();
            const size_t starts[3] = {0, 2, 4};
            const double when[4] = {now - 1, MOVING_TIME, now - 1, MOVING_TIME};
            double where[8];
            for (int c = 0; c < 8; c++) where[c] = fuzz_int(&r, 0, 3000);
            const double birth = now + (i % 2);
            b.vertex_count = 2, b.count = 1, b.starts = starts, b.times = when, b.coords = where, b.births = &birth;
            assert_int_equal(froe_motion_add(m, &b, NULL), FROE_OK);
            assert_int_equal(froe_kinetic_update(k, NULL), FROE_OK);
        }
        audit(k, "changes");
    }
    froe_kinetic_free(k);
    froe_motion_free(m);
}

static void test_epochs(void **state) {
    (void)state;
    froe_motion *m = moving_new(moving_kinds, 2, NULL);
    froe_kinetic_options o = froe_kinetic_defaults();
    froe_kinetic *k = NULL;
    o.epoch = 50;
    o.augmented = augmented;
    assert_int_equal(froe_kinetic_new(m, &o, NULL, &k, NULL), FROE_OK);
    uint64_t key = ktree_segment_at(&k->tree, 0)->key;
    run(k, "epochs", 120, &(pattern_counter){0});
    assert_true(ktree_segment_at(&k->tree, 0)->key != key);
    froe_kinetic_free(k);
    froe_motion_free(m);
}

/* An order that is given, too; and lists of events and trees stay right. */
static void test_swaps(void **state) {
    (void)state;
    enum { N = 24 };
    uint32_t order[N];
    uint64_t keys[N];
    for (uint32_t i = 0; i < N; i++) order[i] = i;
    for (size_t i = 0; i < MOVING_KINDS; i++) {
        const moving_kind *kind = moving_kinds + i;
        froe_motion *m = moving_new(kind, 2, NULL);
        froe_kinetic_options o = froe_kinetic_defaults();
        froe_kinetic *k = NULL;
        size_t moved = 0;
        o.swap = 3;
        o.order = kind->count == N ? order : NULL;
        o.augmented = augmented;
        assert_int_equal(froe_kinetic_new(m, &o, NULL, &k, NULL), FROE_OK);
        for (uint32_t s = 0; s < N && s < (uint32_t)kind->count; s++) keys[s] = ktree_segment_at(&k->tree, s)->key;
        run(k, kind->name, 40, &(pattern_counter){0});
        for (uint32_t s = 0; s < N && s < (uint32_t)kind->count; s++)
            moved += ktree_segment_at(&k->tree, s)->key != keys[s];
        const froe_kinetic_stats stats = froe_kinetic_statistics(k);
        uint64_t events = 0;
        for (int j = 0; j < FROE_EVENT_KINDS; j++) events += stats.events[j];
        if (events >= 3 && !moved) fail_msg("%s: the order stayed", kind->name);
        froe_kinetic_free(k);
        froe_motion_free(m);
    }
}

static void test_order(void **state) {
    (void)state;
    enum { N = 24 };
    froe_motion *m = moving_new(moving_kinds, 2, NULL);
    froe_kinetic_options o = froe_kinetic_defaults();
    froe_kinetic *k = NULL;
    froe_diagnostic why = {0};
    uint32_t order[N];
    o.augmented = augmented;
    for (uint32_t i = 0; i < N; i++) order[i] = N - 1 - i;
    o.order = order;
    assert_int_equal(froe_kinetic_new(m, &o, NULL, &k, NULL), FROE_OK);
    assert_int_equal(ktree_node_at(&k->tree, ktree_node_at(&k->tree, KTREE_ROOT)->child[0])->segment, N - 1);
    run(k, "order", 50, &(pattern_counter){0});
    froe_kinetic_free(k);
    order[3] = 5;
    assert_int_equal(froe_kinetic_new(m, &o, NULL, &k, &why), FROE_E_OPTIONS);
    o.order = NULL;
    o.size = 0;
    assert_int_equal(froe_kinetic_new(m, &o, NULL, &k, &why), FROE_E_OPTIONS);
    froe_motion_free(m);
}

/* ------------------------------------------------------------------- refusals -- */

static bool count_three(void *user, const froe_event *event) {
    assert_true(event->early < event->late && event->object_count);
    return ++*(int *)user < 3;
}

/* A wall at the crossing of two segments, which become parallel and stay so from the next piece on; a vertex that would
 * come to it a tick later if they did not. A test of that tick has to find where parallel lines cross. */
static void test_trials_within_pieces(void **state) {
    (void)state;
    const size_t starts[] = {0, 1, 2, 3, 6, 8, 9};
    const double times[] = {0, 0, 0, 0, 22, 64, 0, 69, 0};
    const double coords[] = {0, 0, 10, 10, 0, 10, 10, 0, 10, 20, 10, 20, 0, -20, -330, -20, 0, -30};
    const uint32_t vertices[] = {0, 1, 2, 3, 4, 5};
    froe_motion_options window = froe_motion_defaults();
    window.begin = 0, window.end = 64, window.tick = 1;
    froe_moving batch = froe_moving_defaults();
    batch.vertex_count = 6, batch.count = 3;
    batch.starts = starts, batch.times = times, batch.coords = coords, batch.vertices = vertices;
    froe_motion *m = NULL;
    assert_int_equal(froe_motion_new(&window, NULL, &m, NULL), FROE_OK);
    assert_int_equal(froe_motion_add(m, &batch, NULL), FROE_OK);
    froe_kinetic *k = start(m, 1);
    const now_claim claim = {{4, NAME_VERTEX}, name_crossing(0, 1), 0};
    assert_int_equal(now_holds(&k->now, &claim), 1);
    assert_true(now_first_failure(&k->now, &claim) == NOW_NEVER);
    assert_false(k->now.lost);
    froe_kinetic_free(k);
    froe_motion_free(m);
}

static void test_calls(void **state) {
    (void)state;
    froe_motion *m = moving_new(moving_kinds, 1, NULL);
    froe_kinetic *k = start(m, 1);
    int seen = 0;
    froe_diagnostic why = {0};
    assert_int_equal(froe_kinetic_advance(k, MOVING_TIME, count_three, &seen, &why), FROE_E_CANCELLED);
    assert_true(seen >= 3);
    audit(k, "cancelled");
    assert_int_equal(froe_kinetic_advance(k, 0, NULL, NULL, &why), FROE_E_ARG);
    assert_int_equal(froe_kinetic_advance(k, MOVING_TIME + 1, NULL, NULL, &why), FROE_E_ARG);
    assert_int_equal(froe_kinetic_advance(k, (double)NAN, NULL, NULL, &why), FROE_E_ARG);
    assert_int_equal(froe_kinetic_remove(k, 1000, &why), FROE_E_ARG);
    assert_int_equal(froe_kinetic_replan(k, 1000, 0, NULL, NULL, NULL, NULL, &why), FROE_E_ARG);
    froe_kinetic *none = NULL;
    assert_int_equal(froe_kinetic_new(NULL, &(froe_kinetic_options){0}, NULL, &none, &why), FROE_E_ARG);
    assert_int_equal(froe_kinetic_new(m, NULL, NULL, &none, &why), FROE_E_ARG);
    assert_int_equal(froe_kinetic_new(m, &(froe_kinetic_options){0}, NULL, &none, &why), FROE_E_OPTIONS);
    assert_null(none);
    assert_null(froe_event_name(FROE_EVENT_KINDS));
    froe_kinetic_free(k);
    froe_kinetic_free(NULL);
    froe_motion_free(m);
}

/* The way back needs what the way there did: nothing is allocated, but that a list that was just full may double. */
static void test_no_memory_per_event(void **state) {
    (void)state;
    static const moving_kind random = {
        .name = "random", .count = 40, .grid = 4096, .length = 2000, .speed = 64, .spin = 32, .legs = 2, .back = true};
    moving_kind ways[3] = {random, random, random};
    ways[1].curved = true;
    ways[2].grid = 32, ways[2].length = 8, ways[2].speed = 2, ways[2].spin = 1;
    for (size_t i = 0; i < 3; i++) {
        test_memory memory;
        const froe_allocator alloc = test_memory_begin(&memory);
        const froe_kinetic_options o = froe_kinetic_defaults();
        froe_motion *m = moving_new(ways + i, 3, NULL);
        froe_kinetic *k = NULL;
        assert_int_equal(froe_kinetic_new(m, &o, &alloc, &k, NULL), FROE_OK);
        pattern_counter counter = {.kinetic = k};
        assert_int_equal(froe_kinetic_advance(k, 0.5 * MOVING_TIME, pattern_count, &counter, NULL), FROE_OK);
        const size_t calls = memory.calls;
        const uint64_t events = counter.events;
        assert_int_equal(froe_kinetic_advance(k, MOVING_TIME, pattern_count, &counter, NULL), FROE_OK);
        assert_true(counter.events > events + 100);
        assert_true(memory.calls <= calls + 2);
        froe_kinetic_free(k);
        test_memory_end(&memory);
        froe_motion_free(m);
    }
}

static froe_status with_memory(void *user, const froe_allocator *alloc) {
    froe_motion *m = user;
    froe_kinetic *k = NULL;
    froe_kinetic_options o = froe_kinetic_defaults();
    o.augmented = augmented;
    froe_status status = froe_kinetic_new(m, &o, alloc, &k, NULL);
    if (status) return status;
    status = froe_kinetic_advance(k, MOVING_TIME / 4.0 + 0.5, NULL, NULL, NULL);
    if (!status) status = froe_kinetic_audit(k, NULL);
    froe_kinetic_free(k);
    return status;
}

static void test_memory_runs_out(void **state) {
    (void)state;
    static const moving_kind few = {
        .name = "few", .count = 4, .grid = 8, .length = 8, .speed = 1, .spin = 1, .legs = 4, .lanes = true};
    for (uint64_t seed = 1; seed <= 2; seed++) {
        moving_kind kind = few;
        kind.lanes = seed == 1;
        froe_motion *m = moving_new(&kind, seed, NULL);
        test_memory_each(with_memory, m);
        froe_motion_free(m);
    }
}

/* ---------------------------------------------------------------------- turns -- */

/* A segment that turns upright over bars, at the end of it first in order or last. */
static froe_motion *spinner(size_t bars) {
    enum { MOST = 300 };
    static size_t starts[2 * MOST + 3];
    static double times[2 * MOST + 4], xy[4 * MOST + 8];
    froe_motion_options w = froe_motion_defaults();
    froe_moving b = froe_moving_defaults();
    froe_motion *m = NULL;
    const double turning[] = {-7, -1, 9, -2, 3, (double)bars + 1, -6, (double)bars + 2};
    w.begin = 0, w.end = 8;
    memcpy(xy, turning, sizeof turning);
    starts[1] = 2, starts[2] = 4, times[1] = times[3] = 8;
    for (size_t i = 0; i < bars; i++)
        for (size_t e = 0; e < 2; e++) {
            xy[8 + 4 * i + 2 * e] = (e ? 20 : -20) + (double)(i * 7919 % 97) / 97;
            xy[9 + 4 * i + 2 * e] = (double)i;
            starts[3 + 2 * i + e] = starts[2 + 2 * i + e] + 1;
        }
    b.vertex_count = 2 + 2 * bars, b.count = 1 + bars, b.starts = starts, b.times = times, b.coords = xy;
    assert_int_equal(froe_motion_new(&w, NULL, &m, NULL), FROE_OK);
    assert_int_equal(froe_motion_add(m, &b, NULL), FROE_OK);
    return m;
}

static bool stop_at_turn(void *user, const froe_event *event) {
    *(froe_event *)user = *event;
    return false;
}

/* What crosses it makes a turn no more expensive: no node is touched, no certificate is made. */
static void test_free_turns(void **state) {
    (void)state;
    for (size_t bars = 3; bars <= 300; bars *= 10)
        for (uint32_t last = 0; last < 2; last++) {
            uint32_t order[301];
            for (uint32_t i = 0; i <= bars; i++) order[i] = last ? ((uint32_t)bars - i) : i;
            froe_motion *m = spinner(bars);
            froe_kinetic_options o = froe_kinetic_defaults();
            froe_kinetic *k = NULL;
            froe_event event;
            o.augmented = augmented, o.order = order;
            assert_int_equal(froe_kinetic_new(m, &o, NULL, &k, NULL), FROE_OK);
            froe_kinetic_stats before = froe_kinetic_statistics(k), after;
            assert_int_equal(froe_kinetic_advance(k, 8, stop_at_turn, &event, NULL), FROE_E_CANCELLED);
            after = froe_kinetic_statistics(k);
            audit(k, "spinner");
            assert_int_equal(event.objects[0], 0);
            assert_int_equal(after.free_turns, augmented);
            if (augmented) {
                assert_int_equal(event.kind, FROE_EVENT_TURN);
                assert_int_equal(after.nodes_touched - before.nodes_touched, 0);
                assert_int_equal(after.certificates_made - before.certificates_made, 0);
            } else {
                assert_true(after.nodes_touched - before.nodes_touched > bars);
            }
            froe_kinetic_free(k);
            froe_motion_free(m);
        }
}

/* Segments that share a vertex, or whose ends coincide for good, turn by surgery. */
static void test_bound_turns(void **state) {
    (void)state;
    for (int shared = 0; shared < 2; shared++) {
        const size_t starts[] = {0, 2, 4, 5, 7};
        const double times[] = {0, 8, 0, 8, 0, 0, 8};
        const double xy[] = {-1, 0, 1, 0, 1, 4, -1, 4, 6, 5, 1, 4, -1, 4};
        const uint32_t vertices[] = {0, 1, shared ? 1 : 3, 2};
        froe_motion_options w = froe_motion_defaults();
        froe_moving b = froe_moving_defaults();
        froe_motion *m = NULL;
        w.begin = 0, w.end = 8;
        b.vertex_count = 4, b.count = 2, b.starts = starts, b.times = times, b.coords = xy, b.vertices = vertices;
        assert_int_equal(froe_motion_new(&w, NULL, &m, NULL), FROE_OK);
        assert_int_equal(froe_motion_add(m, &b, NULL), FROE_OK);
        for (uint64_t seed = 1; seed < 5; seed++) {
            froe_kinetic *k = start(m, seed);
            run(k, "bound", 9, &(pattern_counter){0});
            froe_kinetic_stats s = froe_kinetic_statistics(k);
            assert_true(s.events[FROE_EVENT_TURN] + s.events[FROE_EVENT_BATCH] > 0);
            assert_int_equal(s.free_turns, 0);
            froe_kinetic_free(k);
        }
        froe_motion_free(m);
    }
}

static int ordinary(void **state) {
    (void)state;
    augmented = false;
    return 0;
}

static int in_augmented(void **state) {
    (void)state;
    augmented = true;
    return 0;
}

/* With "ordinary" or "augmented" as argument: partitions of that kind alone. */
int main(int argc, char **argv) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_event),
        cmocka_unit_test(test_coincidences),
        cmocka_unit_test(test_long_ticks),
        cmocka_unit_test(test_general_position),
        cmocka_unit_test(test_reversal),
        cmocka_unit_test(test_changes),
        cmocka_unit_test(test_epochs),
        cmocka_unit_test(test_swaps),
        cmocka_unit_test(test_order),
        cmocka_unit_test(test_calls),
        cmocka_unit_test(test_no_memory_per_event),
        cmocka_unit_test(test_memory_runs_out),
        cmocka_unit_test(test_trials_within_pieces),
        cmocka_unit_test(test_free_turns),
        cmocka_unit_test(test_bound_turns),
    };
    int failed = 0;
    if (argc < 2 || !strcmp(argv[1], "ordinary"))
        failed += cmocka_run_group_tests_name("ordinary", tests, ordinary, NULL);
    if (argc < 2 || !strcmp(argv[1], "augmented"))
        failed += cmocka_run_group_tests_name("augmented", tests, in_augmented, NULL);
    return failed;
}
