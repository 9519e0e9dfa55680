/* touch.c: how far a partition in space can go. */
#include "kinetic/touch.h"
#include "base/floats.h"
#include "kinetic/kinetic.h"
#include "support/fail.h"

static bool take_first(void *user, const froe_contact *contact) {
    *(froe_contact *)user = *contact;
    return false;
}

int64_t touch_tick_before(const now_state *now, double time) {
    int64_t tick = motion_tick_before(now->motion, time);
    if (now_time_of(now, tick) >= time) tick--;
    return tick & 1 ? tick : tick - 1;
}

/* Finds all contacts from the present on, and the ghosts of the present. */
static froe_status find_ghosts(froe_kinetic *k, froe_diagnostic *diag) {
    touch_state *t = &k->touch;
    t->known = false;
    froe_status status = ghost_find(k, diag);
    if (!status) {
        *t = (touch_state){.known = true, .edition = k->now.motion->edition, .last = NOW_NEVER};
        ghost_apply(k, NULL);
        status = kinetic_settle(k, diag);
        if (!status && !t->known) status = support_fail_memory(diag);
    }
    t->again = status == FROE_E_MEMORY || status == FROE_E_CANCELLED;
    return status;
}

froe_status touch_find(froe_kinetic *k, froe_diagnostic *diag) {
    touch_state *t = &k->touch;
    const froe_motion *m = k->now.motion;
    if (!now_is_in_space(&k->now) || k->options.unchecked) return FROE_OK;
    t->again = false;
    if (t->known && t->edition == m->edition) return FROE_OK;
    if (k->options.ghosts) return find_ghosts(k, diag);
    froe_contact_options o = froe_contact_defaults();
    o.from = now_time_of(&k->now, k->now.tick), o.first = o.neighbours = true, o.threads = 1;
    o.progress = k->options.progress, o.user = k->options.user;
    froe_contact first = {.a = FROE_NONE};
    const froe_status status = froe_motion_contacts(m, &o, take_first, &first, diag);
    if (status) return status;
    *t = (touch_state){.known = true, .edition = m->edition, .last = NOW_NEVER, .first = first};
    if (first.a != FROE_NONE) t->last = touch_tick_before(&k->now, first.begin[0]);
    return FROE_OK;
}

int64_t touch_next(const froe_kinetic *k) {
    const touch_state *t = &k->touch;
    const int64_t soon = k->now.tick + 2;
    if (!now_is_in_space(&k->now) || k->options.unchecked) return NOW_NEVER;
    if (!t->known || t->edition != k->now.motion->edition) return soon;
    if (k->options.ghosts) return ghost_next(k);
    if (t->last == NOW_NEVER) return NOW_NEVER;
    return t->last >= k->now.tick ? t->last + 2 : soon;
}

bool touch_tell(froe_kinetic *k, const event_watcher *watcher, const froe_contact *c) {
    bool go_on = true;
    k->touch.first = *c;
    const froe_event event = {.kind = FROE_EVENT_TOUCH,
                              .objects = {c->a, c->b},
                              .object_count = 2,
                              .tick = k->now.tick,
                              .early = c->begin[0],
                              .late = c->begin[1]};
    k->counts.events[FROE_EVENT_TOUCH]++;
    k->touch.reporting = true;
    if (watcher->visit) go_on = base_callback(watcher->visit(watcher->user, &event));
    k->touch.reporting = false;
    now_catch_up(&k->now);
    return go_on;
}

froe_status touch_refuse(const froe_kinetic *k, froe_diagnostic *diag) {
    const froe_contact *c = &k->touch.first;
    return support_fail_at(diag, FROE_E_INPUT, c->a, FROE_NONE, FROE_NONE,
                           "Triangles %u and %u meet between %.17g and %.17g: the partition ends before that.", c->a,
                           c->b, c->begin[0], c->begin[1]);
}
