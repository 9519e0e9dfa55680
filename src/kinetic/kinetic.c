/* kinetic.c: the public calls: a partition is made, time goes on, segments and plans come and go. */
#include "base/floats.h"
#include "base/random.h"
#include "kinetic/live.h"
#include "support/fail.h"
#include <math.h>

froe_kinetic_options froe_kinetic_defaults(void) {
    return (froe_kinetic_options){.size = sizeof(froe_kinetic_options), .seed = 1};
}

const char *froe_event_name(froe_event_kind kind) {
    static const char *const names[] = {"vertices", "vertex-crossing", "crossings", "contact", "triple",
                                        "turn",     "batch",           "plan",      "appear",  "disappear"};
    return kind < FROE_EVENT_KINDS ? names[kind] : NULL;
}

/* -------------------------------------------------------------------- start -- */

static froe_status check_order(froe_kinetic *k, size_t n, froe_diagnostic *diag) {
    const uint32_t *order = k->options.order;
    if (order && k->options.epoch)
        return support_fail(diag, FROE_E_OPTIONS, "a given order cannot be drawn anew in epochs");
    for (size_t i = 0; order && i < n; i++) {
        if (order[i] >= n || segment_at(k, order[i])->key != UINT64_MAX)
            return support_fail(diag, FROE_E_OPTIONS, "the order has object %u twice, or there is none", order[i]);
        segment_at(k, order[i])->key = i;
    }
    return FROE_OK;
}

static uint64_t random_key(const froe_kinetic *k, uint32_t segment) {
    return base_hash(k->options.seed, k->epoch, segment);
}

/* Room for everything that the motion has by now. */
static froe_status grow_tables(froe_kinetic *k) {
    const froe_motion *m = k->now.motion;
    if (now_grow(&k->now) || !array_reserve(&k->alloc, &k->segments, m->objects.count - k->segments.count) ||
        !array_reserve(&k->alloc, &k->vertices, m->plans.count - k->vertices.count) ||
        !array_reserve(&k->alloc, &k->courses, m->plans.count - k->courses.count))
        return FROE_E_MEMORY;
    const live_end end = {LEAF, {CERT_NONE, CERT_NONE}, FROE_NONE, 0};
    while (k->vertices.count < m->plans.count) k->vertices.data[k->vertices.count++] = FROE_NONE;
    while (k->courses.count < m->plans.count) k->courses.data[k->courses.count++] = CERT_NONE;
    while (k->segments.count < m->objects.count)
        k->segments.data[k->segments.count++] = (live_segment){
            .key = UINT64_MAX, .turn = CERT_NONE, .life = CERT_NONE, .pairs = FROE_NONE, .end = {end, end}};
    return FROE_OK;
}

bool live_is_there(const froe_kinetic *k, uint32_t segment) {
    const motion_object *o = k->now.motion->objects.data + segment;
    return o->first <= k->now.tick && k->now.tick <= o->last;
}

static froe_status make_tables(froe_kinetic *k) {
    static const live_node none = {.turner = FROE_NONE};
    k->recent = support_calloc(&k->alloc, RECENT, sizeof *k->recent);
    if (!k->recent || grow_tables(k)) return FROE_E_MEMORY;
    while (k->nodes.count < FIRST_NODE)
        if (!array_push(&k->alloc, &k->nodes, none)) return FROE_E_MEMORY;
    return FROE_OK;
}

static froe_status new_at(froe_motion *motion, const froe_allocator *memory, int64_t tick, froe_kinetic **out) {
    froe_kinetic *k = support_calloc(memory, 1, sizeof *k);
    if (!k) return FROE_E_MEMORY;
    k->alloc = *memory;
    k->free_cert = CERT_NONE;
    k->free_pair = FROE_NONE;
    if (now_new(motion, memory, &k->now)) {
        support_free(memory, k, sizeof *k);
        return FROE_E_MEMORY;
    }
    k->now.tick = tick;
    if (make_tables(k)) {
        froe_kinetic_free(k);
        return FROE_E_MEMORY;
    }
    *out = k;
    return FROE_OK;
}

froe_status live_copy(froe_kinetic *k, froe_kinetic **out, froe_diagnostic *diag) {
    froe_kinetic *copy;
    if (new_at(k->now.motion, &k->alloc, k->now.tick, &copy)) return support_fail_memory(diag);
    copy->options = k->options;
    base_task_init(&copy->task, 1, k->options.progress, k->options.user);
    for (uint32_t s = 0; s < k->segments.count; s++) {
        segment_at(copy, s)->key = segment_at(k, s)->key;
        if (segment_at(k, s)->alive) live_enroll(copy, s);
        live_poll(copy);
    }
    if (!copy->short_of_memory) live_restart(copy);
    if (!copy->short_of_memory) {
        *out = copy;
        return FROE_OK;
    }
    const froe_status status = live_fail(copy, diag);
    froe_kinetic_free(copy);
    return status;
}

static froe_status start(froe_kinetic *k, froe_diagnostic *diag) {
    size_t n = k->segments.count;
    froe_status status = check_order(k, n, diag);
    if (status) return status;
    for (uint32_t s = 0; s < n; s++) {
        if (!k->options.order) segment_at(k, s)->key = random_key(k, s);
        live_schedule(k, s);
        if (live_is_there(k, s)) live_enroll(k, s);
        live_poll(k);
    }
    if (!k->short_of_memory) live_restart(k);
    k->counts = (froe_kinetic_stats){0};
    return k->short_of_memory ? live_fail(k, diag) : FROE_OK;
}

froe_status froe_kinetic_new(froe_motion *motion, const froe_kinetic_options *options, const froe_allocator *alloc,
                             froe_kinetic **out, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!motion || !options || !out) return support_fail(diag, FROE_E_ARG, "froe_kinetic_new: NULL");
    if (options->size != sizeof *options)
        return support_fail(diag, FROE_E_OPTIONS, "options that do not come from froe_kinetic_defaults()");
    froe_allocator memory = support_allocator(alloc);
    froe_kinetic *k;
    if (new_at(motion, &memory, 1, &k)) return support_fail_memory(diag);
    k->options = *options;
    base_task_init(&k->task, 1, options->progress, options->user);
    froe_status status = start(k, diag);
    k->options.order = NULL; /* the caller's */
    if (status)
        froe_kinetic_free(k);
    else
        *out = k;
    return status;
}

void froe_kinetic_free(froe_kinetic *k) {
    if (!k) return;
    const froe_allocator alloc = k->alloc;
    array_free(&alloc, &k->nodes);
    array_free(&alloc, &k->segments);
    array_free(&alloc, &k->vertices);
    array_free(&alloc, &k->courses);
    array_free(&alloc, &k->certs);
    array_free(&alloc, &k->pairs);
    array_free(&alloc, &k->queue);
    array_free(&alloc, &k->list);
    array_free(&alloc, &k->tasks);
    array_free(&alloc, &k->visits);
    array_free(&alloc, &k->cuttings);
    array_free(&alloc, &k->ends);
    array_free(&alloc, &k->order);
    array_free(&alloc, &k->items);
    array_free(&alloc, &k->places);
    array_free(&alloc, &k->crew);
    array_free(&alloc, &k->roots);
    array_free(&alloc, &k->leaving);
    array_free(&alloc, &k->turning);
    array_free(&alloc, &k->halves);
    if (k->recent) support_free(&alloc, k->recent, RECENT * sizeof *k->recent);
    now_free(&k->now);
    support_free(&alloc, k, sizeof *k);
}

/* --------------------------------------------------------------------- time -- */

static double time_at_tick(const froe_kinetic *k, int64_t tick) {
    return k->now.motion->begin + ldexp((double)tick, k->now.motion->power);
}

double froe_kinetic_time(const froe_kinetic *k) {
    BASE_FLOATS_OWN;
    volatile const double time = time_at_tick(k, k->now.tick); /* see base/floats.h */
    return time;
}

double froe_kinetic_next(const froe_kinetic *k) {
    BASE_FLOATS_OWN;
    int64_t tick = live_next_tick(k);
    volatile const double time = tick > live_last_tick(k) ? (double)INFINITY : time_at_tick(k, tick);
    return time;
}

/* A new random order for everything. */
static void new_epoch(froe_kinetic *k) {
    k->epoch++;
    k->epoch_events = 0;
    for (uint32_t s = 0; s < k->segments.count; s++) segment_at(k, s)->key = random_key(k, s);
    live_restart(k);
}

static void end_epoch(froe_kinetic *k) {
    uint64_t events = 0;
    for (int i = 0; i < FROE_EVENT_KINDS; i++) events += k->counts.events[i];
    if (!k->options.epoch || events - k->epoch_events < k->options.epoch) return;
    new_epoch(k);
    k->epoch_events = events;
}

froe_status froe_kinetic_advance(froe_kinetic *k, double time, froe_event_fn *visit, void *user,
                                 froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!k || !(time <= k->now.motion->end)) return support_fail(diag, FROE_E_ARG, "that time is not in the window");
    int64_t tick = motion_tick_after(k->now.motion, time) | 1, last = live_last_tick(k);
    if (tick > last) tick = last;
    if (tick < k->now.tick) return support_fail(diag, FROE_E_ARG, "time %g has passed", time);
    const live_watcher watcher = {visit, user};
    const int64_t from = k->now.tick;
    froe_status status = live_begin(k, diag);
    while (!status && k->now.tick < tick) {
        if (!base_progress(&k->task, (double)(k->now.tick - from) / (double)(tick - from))) return live_fail(k, diag);
        bool go_on = live_step(k, tick, &watcher);
        status = live_settle(k, diag);
        if (!status) end_epoch(k), status = live_settle(k, diag);
        if (!go_on && !status) return support_fail(diag, FROE_E_CANCELLED, "stopped by the visitor");
    }
    return status;
}

/* ------------------------------------------------------------------ changes -- */

froe_status froe_kinetic_update(froe_kinetic *k, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!k) return support_fail(diag, FROE_E_ARG, "froe_kinetic_update: NULL");
    uint32_t first = (uint32_t)k->segments.count;
    if (grow_tables(k)) return support_fail_memory(diag);
    froe_status status = live_begin(k, diag);
    for (uint32_t s = first; s < k->segments.count && !status; s++) {
        segment_at(k, s)->key = random_key(k, s);
        live_schedule(k, s);
        if (live_is_there(k, s)) live_insert(k, s);
        status = live_settle(k, diag);
    }
    return status;
}

froe_status froe_kinetic_remove(froe_kinetic *k, uint32_t object, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!k || object >= k->segments.count) return support_fail(diag, FROE_E_ARG, "there is no object %u", object);
    froe_status status = live_begin(k, diag);
    if (status) return status;
    motion_object *o = k->now.motion->objects.data + object;
    if (o->last >= k->now.tick) o->last = k->now.tick - 1;
    if (k->segments.data[object].life != CERT_NONE) live_set_tick(k, k->segments.data[object].life, NOW_NEVER);
    live_remove(k, object);
    return live_settle(k, diag);
}

/* From now to the end of the last life of a segment at the vertex. */
static void life_of(const froe_kinetic *k, uint32_t vertex, double life[2]) {
    const froe_motion *m = k->now.motion;
    life[0] = life[1] = time_at_tick(k, k->now.tick);
    for (size_t s = 0; s < k->segments.count; s++) {
        const motion_object *o = m->objects.data + s;
        const bool lives = o->first <= o->last && o->last >= k->now.tick;
        if ((o->vertices[0] == vertex || o->vertices[1] == vertex) && lives && o->death > life[1]) life[1] = o->death;
    }
}

froe_status froe_kinetic_replan(froe_kinetic *k, uint32_t vertex, size_t count, const double *times,
                                const double *coords, const double *controls, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!k || vertex >= k->vertices.count) return support_fail(diag, FROE_E_ARG, "there is no vertex %u", vertex);
    double life[2];
    froe_status status = live_begin(k, diag), settled;
    if (status) return status;
    life_of(k, vertex, life);
    k->leaving.count = 0;
    for (uint32_t e = k->vertices.data[vertex]; e != FROE_NONE; e = segment_at(k, e / 2)->end[e % 2].next)
        if (!array_push(&k->alloc, &k->leaving, e / 2)) return support_fail_memory(diag);
    for (size_t i = 0; i < k->leaving.count; i++) live_remove(k, k->leaving.data[i]);
    status = motion_replan(k->now.motion, vertex, count, times, coords, controls, life, diag);
    now_catch_up(&k->now);
    for (size_t i = 0; i < k->leaving.count; i++) {
        live_schedule(k, k->leaving.data[i]);
        live_insert(k, k->leaving.data[i]);
    }
    k->leaving.count = 0;
    settled = live_settle(k, status ? NULL : diag);
    return status ? status : settled;
}

/* --------------------------------------------------------------- statistics -- */

/* The height of the tree. */
static uint32_t height_of(const froe_kinetic *k) {
    uint32_t height = 0, depth = 1, node = node_at(k, ROOT)->child[0], slot = 0;
    if (!node) return 0;
    for (;;) { /* up and down by the links to parents */
        height = depth > height ? depth : height;
        while (slot < 4 && !node_at(k, node)->child[slot]) slot++;
        if (slot < 4) {
            node = node_at(k, node)->child[slot];
            slot = 0;
            depth++;
            continue;
        }
        slot = node_at(k, node)->slot + 1u;
        node = node_at(k, node)->parent;
        depth--;
        if (node == ROOT) return height;
    }
}

froe_kinetic_stats froe_kinetic_statistics(const froe_kinetic *k) {
    froe_kinetic_stats stats = k->counts;
    stats.nodes = k->node_count;
    stats.certificates = k->queue.count;
    stats.height = height_of(k);
    return stats;
}
