/* follow.c: a motion followed event by event: the log of all, and the partition at one instant. */
#include "motion/follow.h"
#include "exit.h"
#include "motion/bodies.h"
#include "motion/moving.h"
#include "progress.h"
#include <stdio.h>
#include <string.h>

typedef struct walk {
    const cli_follow *asked;
    cli_written *written;
    const char *file; /* of the motion */
    cli_progress bar;
    froe_kinetic *kinetic;
    froe_event_writer *writer; /* NULL: no events are asked for */
    bool may_ghost;            /* in space, without --ghosts */
    bool stuck;                /* the writer has failed */
    bool stopped;              /* triangles meet, which ends the walk: the events up to then are all there are */
} walk;

static bool write_event(void *user, const froe_event *happened) {
    walk *w = user;
    double at[2];
    froe_event event = *happened;
    if (froe_kinetic_instant(w->kinetic, at, NULL) == FROE_OK) event.early = at[0], event.late = at[1];
    w->stopped |= event.kind == FROE_EVENT_TOUCH && !w->asked->ghosts;
    w->stuck = !froe_event_writer_put(w->writer, &event);
    return !w->stuck;
}

/* What a call of the partition ended with; 0 for a writer that has failed, which tells so itself. */
static int finish_following(walk *w, froe_status status, const froe_diagnostic *diag) {
    froe_diagnostic told = *diag;
    cli_progress_end(&w->bar);
    if (!status || w->stuck) return 0;
    const size_t length = status == FROE_E_INPUT && w->may_ghost ? strlen(told.message) : sizeof told.message;
    if (length < sizeof told.message) /* triangles meet */
        snprintf(told.message + length, sizeof told.message - length,
                 " With --ghosts one of them is left out meanwhile.");
    return cli_fail_status(CLI_WORKING, w->file, status, &told);
}

/* A partition that tells no events can be followed as long as none are asked for. */
static int advance(walk *w, double time) {
    froe_diagnostic diag;
    w->bar.what = "following";
    return finish_following(w, froe_kinetic_advance(w->kinetic, time, w->writer ? write_event : NULL, w, &diag), &diag);
}

static int snapshot(walk *w, json_t *report) {
    froe_diagnostic diag;
    froe_snapshot s;
    froe_snapshot_options o = froe_snapshot_defaults();
    o.refuse = w->asked->unrounded, o.places = w->asked->places != NULL, o.up = w->asked->up;
    w->bar.what = "rounding";
    const int code = finish_following(w, froe_kinetic_snapshot(w->kinetic, &o, &s, &diag), &diag);
    if (code) return code;
    const char *path = w->asked->tree.path;
    froe_status status = froe_tree_save(s.tree, path, &diag);
    if (!status) w->written->names[w->written->count++] = w->asked->tree.name;
    if (!status && w->asked->places) status = froe_write_places(s.places, path = w->asked->places, &diag);
    if (!status && w->asked->places) w->written->names[w->written->count++] = w->asked->places;
    froe_tree_free(s.tree);
    froe_places_free(s.places);
    if (status) return cli_fail_status(CLI_WRITING, path, status, &diag);
    json_object_set_new(report, "at", json_real(froe_kinetic_time(w->kinetic)));
    json_object_set_new(report, "rounded", json_integer((json_int_t)s.rounded));
    json_object_set_new(report, "alike", json_boolean(s.alike));
    return 0;
}

static void count_events(const walk *w, json_t *report) {
    const froe_kinetic_stats s = froe_kinetic_statistics(w->kinetic);
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

static int follow(walk *w, const cli_common *common, froe_motion *motion, json_t *report) {
    froe_diagnostic diag;
    froe_kinetic_options o = froe_kinetic_defaults();
    o.seed = common->seed;
    o.augmented = w->asked->augmented;
    o.ghosts = w->asked->ghosts;
    o.threads = (unsigned)common->threads;
    o.ahead = true;
    o.progress = cli_progress_step;
    o.user = &w->bar;
    w->bar.what = "building";
    int code = finish_following(w, froe_kinetic_new(motion, &o, NULL, &w->kinetic, &diag), &diag);
    if (!code && w->asked->tree.name) code = advance(w, w->asked->at);
    if (!code && w->asked->tree.name && !w->stuck) code = snapshot(w, report);
    if (!code && w->writer && !w->stuck) code = advance(w, froe_motion_window(motion).end);
    if (!code) count_events(w, report);
    return code;
}

int cli_check_follow(const cli_follow *asked, const char *file, const froe_motion *motion) {
    const bool space = froe_motion_window(motion).dim == 3;
    if (asked->places && space)
        return cli_fail(CLI_USE, NULL, "--places: Exact places are told of motions in the plane, and '%s' is in space.",
                        file);
    if (asked->augmented && space)
        return cli_fail(CLI_USE, NULL, "--augmented: It is about segments in the plane, and '%s' is in space.", file);
    if (asked->ghosts && !space)
        return cli_fail(CLI_USE, NULL, "--ghosts: It is about triangles in space, and '%s' is in the plane.", file);
    return cli_check_at(asked->at, motion);
}

int cli_follow_motion(const cli_common *common, const cli_follow *asked, const char *file, froe_motion *motion,
                      json_t **report, cli_written *written) {
    froe_diagnostic diag;
    walk w = {.asked = asked, .written = written, .file = file, .bar = cli_progress_begin(common, "following")};
    const bool space = froe_motion_window(motion).dim == 3;
    *report = json_null();
    w.may_ghost = space && !asked->ghosts;
    if (!cli_follows(asked)) return 0;
    froe_status status = asked->events ? froe_event_writer_new(asked->events, NULL, &w.writer, &diag) : FROE_OK;
    if (status) return cli_fail_status(CLI_WRITING, asked->events, status, &diag);
    *report = json_object();
    froe_motion *replaced = NULL;
    double reached;
    int code = cli_replace_bodies(file, motion, asked->deviation, &replaced, &reached);
    if (replaced) json_object_set_new(*report, "deviation", json_real(reached));
    if (!code) code = follow(&w, common, replaced ? replaced : motion, *report);
    status = froe_event_writer_close(w.writer, code && !w.stopped ? FROE_E_CANCELLED : FROE_OK, &diag);
    froe_kinetic_free(w.kinetic);
    froe_motion_free(replaced);
    const bool unwritten = status && (!code || w.stopped);
    if (asked->events && !unwritten && (!code || w.stopped)) written->names[written->count++] = asked->events;
    return unwritten ? cli_fail_status(CLI_WRITING, asked->events, status, &diag) : code;
}
