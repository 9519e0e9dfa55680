/* range.c: a part of a partition in motion, of all that comes into a range of x within a window of time. */
#include "kinetic/range/range.h"
#include "kinetic/event/change.h"
#include "kinetic/kinetic.h"
#include <math.h>

/* ------------------------------------------------------------------ motion -- */

/* The vertices of the members, ascending; and which number each has in the part. */
static bool number_vertices(kinetic_range *range, uint32_t *number) {
    const froe_motion *m = range->whole->now.motion;
    const froe_allocator *alloc = &range->whole->call.alloc;
    for (size_t v = 0; v < m->plans.count; v++) number[v] = FROE_NONE;
    for (size_t i = 0; i < range->members.count; i++)
        for (int e = 0; e < 2; e++) number[m->objects.data[range->members.data[i]].vertices[e]] = 0;
    for (uint32_t v = 0; v < m->plans.count; v++) {
        if (number[v] == FROE_NONE) continue;
        number[v] = (uint32_t)range->vertices.count;
        if (!array_push(alloc, &range->vertices, v)) return false;
    }
    return true;
}

static froe_status make_motion_of_members(kinetic_range *range) {
    const froe_motion *m = range->whole->now.motion;
    const froe_allocator *alloc = &range->whole->call.alloc;
    uint32_t *number = support_calloc(alloc, m->plans.count, sizeof *number);
    range->motion = *m;
    range->motion.plans.data = NULL, range->motion.plans.count = range->motion.plans.capacity = 0;
    range->motion.objects.data = NULL, range->motion.objects.count = range->motion.objects.capacity = 0;
    bool room = number && number_vertices(range, number) &&
                array_reserve(alloc, &range->motion.plans, range->vertices.count) &&
                array_reserve(alloc, &range->motion.objects, range->members.count);
    for (size_t v = 0; room && v < range->vertices.count; v++)
        range->motion.plans.data[range->motion.plans.count++] = m->plans.data[range->vertices.data[v]];
    for (size_t i = 0; room && i < range->members.count; i++) {
        motion_object object = m->objects.data[range->members.data[i]];
        for (int e = 0; e < 2; e++) object.vertices[e] = number[object.vertices[e]];
        range->motion.objects.data[range->motion.objects.count++] = object;
    }
    if (number) support_free(alloc, number, m->plans.count * sizeof *number);
    return room ? FROE_OK : FROE_E_MEMORY;
}

/* --------------------------------------------------------------- partition -- */

static froe_status make_part(kinetic_range *range) {
    const froe_kinetic *whole = range->whole;
    froe_kinetic_options options = froe_kinetic_defaults();
    options.seed = whole->options.seed;
    froe_status status = make_motion_of_members(range);
    if (!status) status = kinetic_new_at(&range->motion, &whole->call.alloc, &options, whole->now.tick, &range->part);
    if (status) return status;
    froe_kinetic *part = range->part;
    for (uint32_t s = 0; s < range->members.count; s++) {
        const uint32_t object = range->members.data[s];
        ktree_segment_at(&part->tree, s)->key = ktree_segment_at(&whole->tree, object)->key;
        change_schedule(part, s);
        if (now_is_alive(&part->now, s)) change_enroll(part, s);
    }
    if (!part->call.stopped) surgery_restart(part);
    part->counts = (froe_kinetic_stats){0};
    return part->call.stopped ? FROE_E_MEMORY : FROE_OK;
}

/* ------------------------------------------------------------------ events -- */

static name_point name_in_whole(const kinetic_range *range, name_point p) {
    if (name_is_vertex(p)) p.a = range->vertices.data[p.a];
    if (p.b >= 0 || p.b == NAME_SEGMENT) p.a = range->members.data[p.a];
    if (p.b >= 0) p.b = (int32_t)range->members.data[p.b];
    return p;
}

typedef struct range_visitor {
    kinetic_range *range;
    const uint32_t *home;
} range_visitor;

/* Is an event told by this range? False where the whole has to decide: the range has stopped. */
static bool is_own(const range_visitor *visitor, const froe_event *event, bool *own) {
    const kinetic_range *range = visitor->range;
    const event_state *events = &range->part->events;
    const double low = events->slab[0], high = events->slab[1];
    *own = false;
    if (events->phase == EVENT_MEETING) return false;
    if (events->phase == EVENT_CHANGE) {
        *own = visitor->home[range->members.data[event->objects[0]]] == range->number;
        return true;
    }
    if (high < range->low - range->guard || low > range->high + range->guard) return true; /* not all is known there */
    *own = low >= range->low && low < range->high;
    return high - low <= range->guard / 2 || range->whole->ranges.tuning.wide; /* NaN: no */
}

static bool keep_event(void *user, const froe_event *event) {
    const range_visitor *visitor = user;
    kinetic_range *range = visitor->range;
    froe_kinetic *part = range->part;
    bool own;
    if (!is_own(visitor, event, &own)) {
        range->meets = part->events.phase == EVENT_MEETING;
        range->wide = range->meets ? 0 : part->events.slab[1] - part->events.slab[0];
        return false;
    }
    if (!own) return true;
    const now_claim *claim = &part->events.reported;
    range_event kept = {.tick = event->tick,
                        .place = part->events.place,
                        .claim = {name_in_whole(range, claim->p), name_in_whole(range, claim->q), claim->above},
                        .count = event->object_count,
                        .kind = (uint8_t)event->kind,
                        .phase = (uint8_t)part->events.phase};
    if (claim->p.b == NAME_SEGMENT) kept.turned = part->now.segments.data[claim->p.a].turned;
    for (unsigned i = 0; i < 4 && i < event->object_count; i++)
        kept.objects[i] = range->members.data[event->objects[i]];
    call_push(&part->call, &range->events, kept);
    return true;
}

/* ------------------------------------------------------------------- range -- */

/* Frees all but what the whole is told: the next range finds the same memory in the nearer caches. */
static void free_part(kinetic_range *range) {
    const froe_allocator *alloc = &range->whole->call.alloc;
    froe_kinetic_free(range->part);
    range->part = NULL;
    array_free(alloc, &range->vertices);
    array_free(alloc, &range->motion.plans);
    array_free(alloc, &range->motion.objects);
}

/* Stops at a tick, and tells the others. */
static void stop_at(kinetic_range *range, range_window *window, int64_t tick) {
    long long first = atomic_load(&window->stopped);
    range->stopped = tick;
    while (tick < first && !atomic_compare_exchange_weak(&window->stopped, &first, tick)) continue;
}

froe_status range_follow(kinetic_range *range, range_window *window) {
    range_visitor visitor = {range, window->home};
    const event_watcher watcher = {keep_event, &visitor};
    const froe_status status = make_part(range);
    range->stopped = NOW_NEVER;
    if (status) return status;
    froe_kinetic *part = range->part;
    while (part->now.tick < window->tick && part->now.tick < atomic_load(&window->stopped) &&
           !base_cancelled(window->task)) {
        event_step(part, window->tick, &watcher);
        /* Where a wide segment leaves after all, ranges that do not know why let it stay, and tell other events. */
        if (!(part->events.ousted <= range->guard / 2)) range->wide = fmax(range->wide, part->events.ousted);
        /* which of the pairs in one line are known depends on what happened before */
        if (part->call.stopped || part->collinear.count || range->wide != 0 || range->meets)
            stop_at(range, window, part->now.tick);
    }
    range->counts = part->counts;
    free_part(range);
    return FROE_OK;
}

void range_free(kinetic_range *range) {
    free_part(range);
    array_free(&range->whole->call.alloc, &range->members);
    array_free(&range->whole->call.alloc, &range->events);
}
