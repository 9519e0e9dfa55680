/* ghost.c: which triangles are left out, as they meet others. */
#include "kinetic/ghost.h"
#include "base/floats.h"
#include "base/sort.h"
#include "kinetic/event/change.h"
#include "kinetic/kinetic.h"
#include "support/fail.h"

void ghost_free(froe_kinetic *k) {
    const froe_allocator *alloc = &k->call.alloc;
    array_free(alloc, &k->ghosts.all);
    array_free(alloc, &k->ghosts.lasting);
    array_free(alloc, &k->ghosts.concerned);
}

/* The first odd tick at which a time has passed. */
static int64_t odd_tick_behind(const now_state *now, double time) {
    int64_t tick = motion_tick_after(now->motion, time);
    if (now_time_of(now, tick) <= time) tick++;
    return tick | 1;
}

static bool take_contact(void *user, const froe_contact *c) {
    froe_kinetic *k = user;
    const now_state *now = &k->now;
    if (c->b >= now->faces.count) return true; /* added to the motion since, and not taken up yet */
    ghost_contact own = {*c, touch_tick_before(now, c->begin[0]), odd_tick_behind(now, c->end[1])};
    if (own.from < now->tick) own.from = now->tick; /* they meet already */
    if (own.to > now_last_tick(now)) own.to = NOW_NEVER;
    k->ghosts.out_of_memory = !array_push(&k->call.alloc, &k->ghosts.all, own);
    return !k->ghosts.out_of_memory;
}

froe_status ghost_find(froe_kinetic *k, froe_diagnostic *diag) {
    ghost_state *g = &k->ghosts;
    froe_contact_options o = froe_contact_defaults();
    o.from = now_time_of(&k->now, k->now.tick), o.neighbours = true, o.threads = 1;
    o.progress = k->options.progress, o.user = k->options.user;
    g->all.count = g->lasting.count = g->next = 0;
    g->out_of_memory = false;
    g->anew = true;
    const froe_status status = froe_motion_contacts(k->now.motion, &o, take_contact, k, diag);
    if (status || !g->out_of_memory) return status;
    return support_fail_memory(diag);
}

int64_t ghost_next(const froe_kinetic *k) {
    const ghost_state *g = &k->ghosts;
    int64_t next = g->next < g->all.count ? g->all.data[g->next].from : NOW_NEVER;
    for (size_t i = 0; i < g->lasting.count; i++) {
        const int64_t to = g->all.data[g->lasting.data[i]].to;
        next = to < next ? to : next;
    }
    return next;
}

static void concern(froe_kinetic *k, const froe_contact *c) {
    call_push(&k->call, &k->ghosts.concerned, c->a);
    call_push(&k->call, &k->ghosts.concerned, c->b);
}

/* Contacts that begin and end now. */
static bool pass_contacts(froe_kinetic *k, const event_watcher *watcher) {
    ghost_state *g = &k->ghosts;
    bool go_on = true;
    size_t kept = 0;
    for (size_t i = 0; i < g->lasting.count; i++) {
        const ghost_contact *c = g->all.data + g->lasting.data[i];
        if (c->to <= k->now.tick)
            concern(k, &c->contact);
        else
            g->lasting.data[kept++] = g->lasting.data[i];
    }
    g->lasting.count = kept;
    for (; g->next < g->all.count && g->all.data[g->next].from <= k->now.tick && !k->call.stopped; g->next++) {
        const ghost_contact *c = g->all.data + g->next;
        if (c->to <= k->now.tick) continue;
        concern(k, &c->contact);
        call_push(&k->call, &g->lasting, (uint32_t)g->next);
        if (watcher) go_on &= touch_tell(k, watcher, &c->contact);
    }
    return go_on;
}

/* ---------------------------------------------------------------------- leaving -- */

static int by_second(void *user, uint32_t a, uint32_t b) {
    const ghost_contact *all = ((const ghost_state *)user)->all.data;
    const froe_contact *c = &all[a].contact, *d = &all[b].contact;
    return c->b != d->b ? (c->b < d->b ? -1 : 1) : (c->a > d->a) - (c->a < d->a);
}

/* Marks those that are to be left out. By the second of each pair, so that it is known whether the first is there. */
static void choose(froe_kinetic *k) {
    ghost_state *g = &k->ghosts;
    now_face *faces = k->now.faces.data;
    const size_t count = g->lasting.count;
    for (size_t i = 0; i < count; i++) concern(k, &g->all.data[g->lasting.data[i]].contact);
    for (size_t i = 0; i < g->concerned.count; i++) faces[g->concerned.data[i]].leaves = false;
    if (!call_reserve(&k->call, &g->lasting, count)) return;
    base_merge_sort(g->lasting.data, g->lasting.data + count, count, by_second, g);
    for (size_t i = 0; i < count; i++) {
        const froe_contact *c = &g->all.data[g->lasting.data[i]].contact;
        if (!faces[c->a].leaves) faces[c->b].leaves = true;
    }
}

static bool tell_one(froe_kinetic *k, const event_watcher *watcher, froe_event_kind kind, uint32_t object) {
    froe_event event = event_now(&k->now, kind);
    event.objects[0] = object, event.object_count = 1;
    return !watcher || event_tell(k, watcher, &event, &event_no_points);
}

static bool leave(froe_kinetic *k, const event_watcher *watcher, uint32_t object) {
    const uint32_t surface = k->now.faces.data[object].surface;
    const bool here = ktree_segment_at(&k->tree, surface)->here;
    change_remove(k, surface);
    k->now.faces.data[object].ghost = true;
    change_schedule(k, surface);
    return !here || tell_one(k, watcher, FROE_EVENT_DISAPPEAR, object);
}

static bool come_back(froe_kinetic *k, const event_watcher *watcher, uint32_t object) {
    const uint32_t surface = k->now.faces.data[object].surface;
    k->now.faces.data[object].ghost = false;
    change_schedule(k, surface);
    if (!now_is_alive(&k->now, object)) return true;
    change_insert(k, surface);
    return tell_one(k, watcher, FROE_EVENT_APPEAR, object);
}

bool ghost_apply(froe_kinetic *k, const event_watcher *watcher) {
    ghost_state *g = &k->ghosts;
    const now_face *faces = k->now.faces.data;
    g->concerned.count = 0;
    for (uint32_t o = 0; g->anew && o < k->now.faces.count; o++)
        if (faces[o].ghost) call_push(&k->call, &g->concerned, o);
    g->anew = false;
    bool go_on = pass_contacts(k, watcher);
    if (!k->call.stopped) choose(k);
    for (int back = 0; back < 2; back++) /* first those that leave */
        for (size_t i = 0; i < g->concerned.count && !k->call.stopped; i++) {
            const uint32_t o = g->concerned.data[i];
            if (faces[o].ghost == faces[o].leaves || faces[o].ghost != (back == 1)) continue;
            go_on &= back ? come_back(k, watcher, o) : leave(k, watcher, o);
        }
    if (k->call.stopped) k->touch.known = false, k->touch.again = true;
    return go_on;
}
