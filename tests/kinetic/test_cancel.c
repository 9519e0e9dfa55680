/* test_cancel.c: every call that may take long asks whether to go on, and what was cancelled can be gone on with. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "kinetic/moving.h"
#include "support/memory.h"

static const moving_kind crowd = {
    .name = "crowd", .count = 80, .grid = 3000, .length = 900, .speed = 40, .spin = 20, .legs = 2};

/* Says no when it is asked for the `last` time. */
typedef struct patience {
    int asked, last;
    double done;
} patience;

static bool go_on(void *user, double done) {
    patience *p = user;
    assert_true(done >= 0 && done <= 1);
    p->done = done;
    return ++p->asked != p->last;
}

static froe_kinetic *made(froe_motion *m, patience *p) {
    froe_kinetic_options o = froe_kinetic_defaults();
    froe_kinetic *k = NULL;
    o.progress = go_on, o.user = p;
    assert_int_equal(froe_kinetic_new(m, &o, NULL, &k, NULL), FROE_OK);
    return k;
}

static void test_a_new_partition(void **state) {
    (void)state;
    froe_motion *m = moving_new(&crowd, 1, NULL);
    patience all = {0, -1, 0};
    froe_kinetic_free(made(m, &all));
    assert_true(all.asked > 40);
    for (int last = 1; last <= all.asked; last += 1 + all.asked / 20) {
        test_memory memory;
        const froe_allocator alloc = test_memory_begin(&memory);
        patience p = {0, last, 0};
        froe_kinetic_options o = froe_kinetic_defaults();
        froe_kinetic *k = NULL;
        froe_diagnostic why = {0};
        o.progress = go_on, o.user = &p;
        assert_int_equal(froe_kinetic_new(m, &o, &alloc, &k, &why), FROE_E_CANCELLED);
        assert_non_null(strstr(why.message, "Cancelled."));
        assert_null(k);
        assert_int_equal(p.asked, last); /* no more after it was told */
        test_memory_end(&memory);
    }
    froe_motion_free(m);
}

typedef froe_status call(froe_kinetic *k, froe_diagnostic *why);

static froe_status advance(froe_kinetic *k, froe_diagnostic *why) {
    return froe_kinetic_advance(k, MOVING_TIME / 3, NULL, NULL, why);
}
static froe_status audit(froe_kinetic *k, froe_diagnostic *why) {
    return froe_kinetic_audit(k, why);
}
static froe_status snapshot(froe_kinetic *k, froe_diagnostic *why) {
    froe_snapshot s = {.tree = NULL};
    const froe_status status = froe_kinetic_snapshot(k, NULL, &s, why);
    froe_tree_free(s.tree), froe_places_free(s.places);
    return status;
}
static froe_status replan(froe_kinetic *k, froe_diagnostic *why) {
    for (uint32_t v = 0; v < 20; v++) {
        const double times[] = {froe_kinetic_time(k)}, at[] = {100.0 * v, 77 * (v % 3)};
        const froe_status status = froe_kinetic_replan(k, v, 1, times, at, NULL, NULL, why);
        if (status) return status;
    }
    return FROE_OK;
}
static froe_status take_out(froe_kinetic *k, froe_diagnostic *why) {
    for (uint32_t s = 0; s < 40; s++) {
        const froe_status status = froe_kinetic_remove(k, s, why);
        if (status) return status;
    }
    return FROE_OK;
}
static froe_status bring_in(froe_kinetic *k, froe_diagnostic *why) {
    enum { MORE = 30 };
    size_t starts[2 * MORE + 1] = {0};
    double times[2 * MORE] = {0}, coords[4 * MORE];
    for (int i = 0; i < 2 * MORE; i++) {
        starts[i + 1] = (size_t)i + 1;
        coords[2 * i] = 97 * i % 3000, coords[2 * i + 1] = 1009 * i % 3000;
    }
    froe_moving b = froe_moving_defaults();
    b.vertex_count = 2 * MORE, b.count = MORE, b.starts = starts, b.times = times, b.coords = coords;
    assert_int_equal(froe_motion_add(k->now.motion, &b, why), FROE_OK);
    return froe_kinetic_update(k, why);
}

/* Cancels a call at several moments; then the partition goes on as if nothing had been. */
static void cancel(const char *name, call *what, int least) {
    patience all = {0, -1, 0};
    froe_motion *m = moving_new(&crowd, 2, NULL);
    froe_kinetic *k = made(m, &all);
    all.asked = 0;
    if (what(k, NULL)) fail_msg("%s", name);
    if (all.asked < least) fail_msg("%s asks %d times", name, all.asked);
    froe_kinetic_free(k);
    froe_motion_free(m);
    for (int last = 1; last <= all.asked; last += 1 + all.asked / 7) {
        patience p = {0, -1, 0};
        froe_diagnostic why = {0};
        m = moving_new(&crowd, 2, NULL);
        k = made(m, &p);
        p.asked = 0, p.last = last;
        if (what(k, &why) != FROE_E_CANCELLED || !strstr(why.message, "Cancelled."))
            fail_msg("%s, cancelled at %d of %d: %s", name, last, all.asked, why.message);
        froe_kinetic_watch(k, NULL, NULL);
        if (froe_kinetic_audit(k, &why)) fail_msg("%s, cancelled: %s", name, why.message);
        assert_int_equal(froe_kinetic_advance(k, MOVING_TIME / 3, NULL, NULL, NULL), FROE_OK);
        if (froe_kinetic_audit(k, &why)) fail_msg("%s, cancelled and gone on with: %s", name, why.message);
        assert_int_equal(p.asked, last);
        froe_kinetic_free(k);
        froe_motion_free(m);
    }
}

static void test_all_calls(void **state) {
    (void)state;
    cancel("advance", advance, 100);
    cancel("audit", audit, 20);
    cancel("snapshot", snapshot, 3);
    cancel("replan", replan, 3);
    cancel("remove", take_out, 3);
    cancel("update", bring_in, 3);
}

static bool count_event(void *user, const froe_event *event) {
    (void)event;
    ++*(size_t *)user;
    return true;
}

/* Memory that is refused once may be done without, but then all events have been told, or the status says so. */
static void test_no_event_is_lost_in_silence(void **state) {
    (void)state;
    static const moving_kind few = {
        .name = "few", .count = 24, .grid = 600, .length = 300, .speed = 40, .spin = 20, .legs = 2};
    froe_motion *m = moving_new(&few, 1, NULL);
    size_t undisturbed = 0, refused = 0, calls = 1;
    for (size_t fail_at = 0; fail_at <= calls; fail_at++) {
        test_memory memory;
        const froe_allocator alloc = test_memory_begin(&memory);
        froe_kinetic *k = NULL;
        size_t events = 0;
        const froe_kinetic_options o = froe_kinetic_defaults();
        assert_int_equal(froe_kinetic_new(m, &o, &alloc, &k, NULL), FROE_OK);
        const size_t before = memory.calls;
        memory.fail_at = fail_at ? before + fail_at : 0;
        const froe_status status = froe_kinetic_advance(k, MOVING_TIME, count_event, &events, NULL);
        if (!fail_at) undisturbed = events, calls = memory.calls - before;
        assert_true(status == FROE_OK || (fail_at && status == FROE_E_MEMORY));
        if (!status) assert_int_equal(events, undisturbed);
        refused += status != FROE_OK;
        if (status) assert_int_equal(froe_kinetic_advance(k, MOVING_TIME, count_event, &events, NULL), FROE_OK);
        assert_int_equal(froe_kinetic_audit(k, NULL), FROE_OK);
        froe_kinetic_free(k);
        test_memory_end(&memory);
    }
    if (undisturbed < 50 || calls < 20 || refused < 5)
        fail_msg("%zu events, %zu calls, %zu refused", undisturbed, calls, refused);
    froe_motion_free(m);
}

enum { SOME = 17 };

/* Objects at rest, in space each at a height of its own. */
static void add_some(froe_motion *m, int dim, double height) {
    static const double times[3 * SOME];
    const size_t each = (size_t)dim;
    size_t starts[3 * SOME + 1];
    double coords[9 * SOME];
    for (size_t i = 0; i <= 3 * SOME; i++) starts[i] = i;
    for (size_t i = 0; i < each * SOME; i++)
        for (size_t c = 0; c < each; c++)
            coords[each * i + c] = c == 2 ? height + (double)(i / each) : (double)(i * (c + 13) * 97 % 1009);
    froe_moving b = froe_moving_defaults();
    b.vertex_count = each * SOME, b.count = SOME, b.starts = starts, b.times = times, b.coords = coords;
    assert_int_equal(froe_motion_add(m, &b, NULL), FROE_OK);
}

/* Takes up objects while an allocation fails, and again. Returns how many allocations there were. 0: none fails. */
static size_t take_up(int dim, size_t fail_at, bool for_ever, froe_kinetic **out, froe_motion **motion,
                      test_memory *memory) {
    const froe_allocator alloc = test_memory_begin(memory);
    froe_motion_options w = froe_motion_defaults();
    froe_kinetic_options o = froe_kinetic_defaults();
    w.begin = 0, w.end = 1, w.dim = (unsigned)dim;
    o.unchecked = dim == 3;
    assert_int_equal(froe_motion_new(&w, NULL, motion, NULL), FROE_OK);
    add_some(*motion, dim, 0);
    assert_int_equal(froe_kinetic_new(*motion, &o, &alloc, out, NULL), FROE_OK);
    add_some(*motion, dim, SOME);
    const size_t before = memory->calls;
    memory->fail_at = fail_at ? before + fail_at : 0, memory->fail_on = for_ever;
    const froe_status status = froe_kinetic_update(*out, NULL);
    assert_true(status == FROE_OK || (fail_at && status == FROE_E_MEMORY));
    const size_t calls = memory->calls - before;
    memory->fail_at = 0;
    assert_int_equal(froe_kinetic_update(*out, NULL), FROE_OK);
    return calls;
}

/* Memory that is refused while objects are taken up: the next call takes up all of them, in the same order. */
static void test_objects_are_not_lost(void **state) {
    (void)state;
    for (int dim = 2; dim <= 3; dim++) {
        test_memory memory[2];
        froe_motion *m[2];
        froe_kinetic *k[2];
        uint32_t found[2];
        const size_t calls = take_up(dim, 0, false, k, m, memory);
        assert_true(calls > 5);
        for (size_t i = 0; i < 2 * calls; i++) {
            take_up(dim, 1 + i / 2, i % 2, k + 1, m + 1, memory + 1);
            assert_int_equal(kinetic_compare(k[0], k[1], false, found), FROE_OK);
            if (found[0] || found[1]) fail_msg("dimension %d, allocation %d", dim, (int)i / 2);
            assert_int_equal(froe_kinetic_audit(k[1], NULL), FROE_OK);
            froe_kinetic_free(k[1]);
            froe_motion_free(m[1]);
            test_memory_end(memory + 1);
        }
        froe_kinetic_free(k[0]);
        froe_motion_free(m[0]);
        test_memory_end(memory);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_a_new_partition),
                                       cmocka_unit_test(test_no_event_is_lost_in_silence),
                                       cmocka_unit_test(test_objects_are_not_lost), cmocka_unit_test(test_all_calls)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
