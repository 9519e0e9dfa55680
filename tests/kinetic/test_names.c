/* test_names.c: the events of a partition beside the contacts of its motion, which are found without it: wherever a
 * contact begins or ends, an event says so. */
#include "kinetic/moving.h"
#include "support/found.h"
#include <math.h>

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

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_contact_is_an_event)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
