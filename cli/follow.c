/* follow.c: a motion followed event by event: the log of all, and the partition at one instant. */
#include "follow.h"
#include "exit.h"
#include <math.h>
#include <stdlib.h>

typedef struct events {
    froe_kinetic *kinetic;
    froe_event *data;
    size_t count, room;
    bool keep, full;
} events;

static bool keep(void *user, const froe_event *event) {
    events *e = user;
    double at[2];
    if (!e->keep) return true;
    if (e->count == e->room) {
        const size_t room = 2 * e->room + 64;
        froe_event *more = realloc(e->data, room * sizeof *more);
        e->full = !more;
        if (!more) return false;
        e->data = more;
        e->room = room;
    }
    e->data[e->count] = *event;
    if (froe_kinetic_instant(e->kinetic, at, NULL) == FROE_OK)
        e->data[e->count].early = at[0], e->data[e->count].late = at[1];
    e->count++;
    return true;
}

static int advance(events *e, double time) {
    froe_diagnostic diag;
    const froe_status status = froe_kinetic_advance(e->kinetic, time, keep, e, &diag);
    if (e->full) return cli_fail(CLI_RESOURCES, NULL, "out of memory");
    return status ? cli_fail_status(CLI_WORKING, NULL, status, &diag) : 0;
}

static int snapshot(const cli_follow *asked, const events *e, json_t *report) {
    froe_diagnostic diag;
    froe_snapshot s;
    froe_snapshot_options o = froe_snapshot_defaults();
    o.refuse = asked->unrounded, o.places = asked->places != NULL;
    froe_status status = froe_kinetic_snapshot(e->kinetic, &o, &s, &diag);
    if (status) return cli_fail_status(CLI_WORKING, NULL, status, &diag);
    const char *path = asked->tree;
    status = froe_tree_save(s.tree, path, &diag);
    if (!status && asked->places) status = froe_write_places(s.places, path = asked->places, &diag);
    froe_tree_free(s.tree);
    froe_places_free(s.places);
    if (status) return cli_fail_status(CLI_WRITING, path, status, &diag);
    json_object_set_new(report, "at", json_real(froe_kinetic_time(e->kinetic)));
    json_object_set_new(report, "rounded", json_integer((json_int_t)s.rounded));
    json_object_set_new(report, "alike", json_boolean(s.alike));
    return 0;
}

static void count_events(const events *e, json_t *report) {
    const froe_kinetic_stats s = froe_kinetic_statistics(e->kinetic);
    uint64_t all = 0;
    json_t *kinds = json_object();
    for (int i = 0; i < FROE_EVENT_KINDS; i++) {
        all += s.events[i];
        json_object_set_new(kinds, froe_event_name((froe_event_kind)i), json_integer((json_int_t)s.events[i]));
    }
    json_object_set_new(report, "all", json_integer((json_int_t)all));
    json_object_set_new(report, "kinds", kinds);
    json_object_set_new(report, "nodes", json_integer((json_int_t)s.nodes));
    json_object_set_new(report, "height", json_integer((json_int_t)s.height));
}

static int follow(const cli_follow *asked, events *e, double end, json_t *report) {
    froe_diagnostic diag;
    int code = 0;
    if (asked->tree) code = advance(e, asked->at);
    if (!code && asked->tree) code = snapshot(asked, e, report);
    if (!code && asked->events) code = advance(e, end);
    if (code) return code;
    count_events(e, report);
    if (!asked->events) return 0;
    const froe_status status = froe_write_events(e->data, e->count, asked->events, &diag);
    return status ? cli_fail_status(CLI_WRITING, asked->events, status, &diag) : 0;
}

int cli_follow_motion(const cli_common *common, const cli_follow *asked, froe_motion *motion, json_t **report) {
    const double end = froe_motion_window(motion).end;
    froe_diagnostic diag;
    events e = {.keep = asked->events != NULL};
    *report = json_null();
    if (!asked->events && !asked->tree) return 0;
    froe_kinetic_options o = froe_kinetic_defaults();
    o.seed = common->seed;
    o.augmented = asked->augmented;
    const froe_status status = froe_kinetic_new(motion, &o, NULL, &e.kinetic, &diag);
    if (status) return cli_fail_status(CLI_WORKING, NULL, status, &diag);
    *report = json_object();
    const int code = follow(asked, &e, end, *report);
    froe_kinetic_free(e.kinetic);
    free(e.data);
    return code;
}
