/* kinetic.c: the public calls: a partition is made, time goes on, segments and plans come and go. A call may be
 * cancelled, and it may run out of memory. Either leaves the tree incomplete, and the next call makes it anew. */
#include "kinetic/kinetic.h"
#include "base/floats.h"
#include "base/random.h"
#include "kinetic/event/change.h"
#include "kinetic/event/triangle.h"
#include "support/fail.h"

void froe_kinetic_defaults_into(froe_kinetic_options *out, size_t size) {
    const froe_kinetic_options all = {.size = size, .seed = 1, .threads = 1};
    support_defaults(out, size, &all, sizeof all);
}

const char *froe_event_name(froe_event_kind kind) {
    static const char *const names[] = {
        "vertices", "vertex-crossing", "crossings", "contact", "triple", "turn", "batch",
        "plan",     "appear",          "disappear", "flop",    "touch"};
    return kind < FROE_EVENT_KINDS ? names[kind] : NULL;
}

/* -------------------------------------------------------------------- calls -- */

void froe_kinetic_watch(froe_kinetic *k, froe_progress_fn *progress, void *user) {
    if (!k) return;
    k->options.progress = progress;
    k->options.user = user;
}

void kinetic_make_anew(froe_kinetic *k) {
    const bool space = now_is_in_space(&k->now);
    if (space) triangle_enroll_all(k);
    for (uint32_t s = 0; s < k->tree.segments.count && !space; s++) {
        collinear_forget(k, s);
        for (int i = 0; i < 4; i++) /* certificates of ends may be about pieces of plans that have ended since */
            cert_forget(&k->certs, k->certs.segments.data[s].end[i / 2] + i % 2);
        change_unroll(k, s);
        change_schedule(k, s);
        if (now_is_alive(&k->now, s)) change_enroll(k, s);
        call_poll(&k->call);
    }
    if (!k->call.stopped) surgery_restart(k);
}

froe_status kinetic_settle(froe_kinetic *k, froe_diagnostic *diag) {
    if (k->call.stopped && !base_cancelled(&k->call.task)) {
        k->call.stopped = false;
        kinetic_make_anew(k);
    }
    return k->call.stopped ? call_fail(&k->call, diag) : FROE_OK;
}

froe_status kinetic_begin(froe_kinetic *k, froe_diagnostic *diag) {
    base_task_init(&k->call.task, k->options.threads, k->options.progress, k->options.user);
    now_catch_up(&k->now);
    const froe_status status = kinetic_settle(k, diag);
    return status || !k->touch.again ? status : touch_find(k, diag);
}

/* Ends a change of what there is. */
static froe_status end_change(froe_kinetic *k, froe_diagnostic *diag) {
    k->touch.again = k->options.ghosts; /* unless they are found now */
    const froe_status status = kinetic_settle(k, diag);
    return status || !k->options.ghosts ? status : touch_find(k, diag);
}

froe_status kinetic_refuse_space(froe_diagnostic *diag) {
    return support_fail(diag, FROE_E_UNSUPPORTED, "A partition in space does not do that yet.");
}

/* -------------------------------------------------------------------- start -- */

static uint64_t random_key(const froe_kinetic *k, uint32_t segment) {
    return base_hash(k->options.seed, k->epoch, segment);
}

/* How many segments there are at most once all objects of the motion are known. That of questions does not count. */
static size_t most_segments(const froe_kinetic *k) {
    const bool space = k->now.motion->dim == 3;
    const size_t known = k->now.segments.count - 1, objects = space ? k->now.faces.count : known;
    return known + (space ? 4 : 1) * (k->now.motion->objects.count - objects);
}

/* Room for everything that the motion has by now. Without memory nothing more of it is known than before. */
static froe_status grow_tables(froe_kinetic *k) {
    const froe_allocator *alloc = &k->call.alloc;
    const froe_motion *m = k->now.motion;
    ktree *tree = &k->tree;
    const size_t segments = most_segments(k) - tree->segments.count, vertices = m->plans.count - tree->vertices.count;
    if (!array_reserve(alloc, &tree->segments, segments) || !array_reserve(alloc, &k->certs.segments, segments) ||
        !array_reserve(alloc, &k->collinear.first, segments) ||
        !array_reserve(alloc, &k->participants.stamps, segments) || !array_reserve(alloc, &tree->vertices, vertices) ||
        !array_reserve(alloc, &k->certs.courses, vertices) || now_grow(&k->now))
        return FROE_E_MEMORY;
    const size_t all = k->now.segments.count - 1;
    const ktree_end end = {KTREE_LEAF, FROE_NONE, 0};
    const cert_segment none = {FROE_NONE, FROE_NONE, {{FROE_NONE, FROE_NONE}, {FROE_NONE, FROE_NONE}}};
    while (tree->vertices.count < m->plans.count) {
        tree->vertices.data[tree->vertices.count++] = FROE_NONE;
        k->certs.courses.data[k->certs.courses.count++] = FROE_NONE;
    }
    while (tree->segments.count < all) {
        tree->segments.data[tree->segments.count++] = (ktree_segment){.key = UINT64_MAX, .end = {end, end}};
        k->certs.segments.data[k->certs.segments.count++] = none;
        k->collinear.first.data[k->collinear.first.count++] = FROE_NONE;
        k->participants.stamps.data[k->participants.stamps.count++] = 0;
    }
    return FROE_OK;
}

froe_status kinetic_new_at(froe_motion *motion, const froe_allocator *memory, const froe_kinetic_options *options,
                           int64_t tick, froe_kinetic **out) {
    froe_kinetic *k = support_calloc(memory, 1, sizeof *k);
    if (!k) return FROE_E_MEMORY;
    k->call.alloc = *memory;
    k->options = *options;
    k->collinear.first_free = FROE_NONE;
    k->participants.call = &k->call;
    k->ranges.tuning = ranges_defaults();
    k->tree = (ktree){.call = &k->call, .now = &k->now, .augmented = options->augmented};
    base_task_init(&k->call.task, 1, options->progress, options->user);
    if (now_new(motion, memory, &k->now)) {
        support_free(memory, k, sizeof *k);
        return FROE_E_MEMORY;
    }
    k->now.tick = tick;
    bool room = !cert_table_new(&k->call, &k->now, &k->certs) && !grow_tables(k);
    while (room && k->tree.nodes.count < KTREE_FIRST)
        room = array_push(memory, &k->tree.nodes, (ktree_node){.turner = FROE_NONE});
    if (room)
        *out = k;
    else
        froe_kinetic_free(k);
    return room ? FROE_OK : FROE_E_MEMORY;
}

froe_status kinetic_copy(froe_kinetic *k, froe_kinetic **out, froe_diagnostic *diag) {
    froe_kinetic *copy;
    if (kinetic_new_at(k->now.motion, &k->call.alloc, &k->options, k->now.tick, &copy))
        return support_fail_memory(diag);
    for (uint32_t s = 0; s < k->tree.segments.count; s++) {
        ktree_segment_at(&copy->tree, s)->key = ktree_segment_at(&k->tree, s)->key;
        if (ktree_segment_at(&k->tree, s)->alive && k->now.motion->dim == 2) change_enroll(copy, s);
        call_poll(&copy->call);
    }
    for (size_t o = 0; o < copy->now.faces.count; o++) /* what has not been taken up takes no part here, too */
        copy->now.faces.data[o].ghost = o >= k->now.faces.count || k->now.faces.data[o].ghost;
    if (k->now.motion->dim == 3) triangle_enroll_all(copy);
    if (!copy->call.stopped) surgery_restart(copy);
    if (!copy->call.stopped) {
        *out = copy;
        return FROE_OK;
    }
    const froe_status status = call_fail(&copy->call, diag);
    froe_kinetic_free(copy);
    return status;
}

/* The key of an object. In space three before it are for its edges. */
static uint64_t *key_of(froe_kinetic *k, uint32_t object) {
    return &ktree_segment_at(&k->tree, now_segment_of(&k->now, object))->key;
}

/* Of the keys of edges that come before that of each surface. */
static uint64_t edges_before(const froe_kinetic *k) {
    return now_is_in_space(&k->now) ? 3 : 0;
}

uint32_t kinetic_object_count(const froe_kinetic *k) {
    return (uint32_t)(now_is_in_space(&k->now) ? k->now.faces.count : k->tree.segments.count);
}

static froe_status refuse_bodies(froe_diagnostic *diag) {
    return support_fail(diag, FROE_E_UNSUPPORTED,
                        "The motion has bodies: a partition in space takes triangles whose corners have plans, as "
                        "froe_motion_without_bodies() makes them.");
}

static froe_status take_order(froe_kinetic *k, froe_diagnostic *diag) {
    const size_t n = k->now.motion->objects.count;
    const uint64_t edges = edges_before(k);
    const uint32_t *order = k->options.order;
    if (order && k->options.epoch)
        return support_fail(diag, FROE_E_OPTIONS, "A given order cannot be drawn anew in epochs.");
    for (size_t i = 0; i < n; i++) {
        if (!order) {
            *key_of(k, (uint32_t)i) = random_key(k, (uint32_t)i) | edges;
            continue;
        }
        if (order[i] >= n || *key_of(k, order[i]) != UINT64_MAX)
            return support_fail(diag, FROE_E_OPTIONS, "The order has object %u twice, or there is no such object.",
                                order[i]);
        *key_of(k, order[i]) = i * (1 + edges) + edges;
    }
    return FROE_OK;
}

static froe_status start(froe_kinetic *k, froe_diagnostic *diag) {
    const bool space = k->now.motion->dim == 3;
    froe_status status = take_order(k, diag);
    if (status) return status;
    if (k->options.ghosts) status = touch_find(k, diag);
    if (status) return status;
    if (space) triangle_enroll_all(k);
    for (uint32_t s = 0; s < k->tree.segments.count && !space; s++) {
        change_schedule(k, s);
        if (now_is_alive(&k->now, s)) change_enroll(k, s);
        call_poll(&k->call);
    }
    if (!k->call.stopped) surgery_restart(k);
    k->counts = (froe_kinetic_stats){0};
    if (k->call.stopped) return call_fail(&k->call, diag);
    status = touch_find(k, diag);
    return !status && k->touch.known && k->touch.last < k->now.tick ? touch_refuse(k, diag) : status;
}

froe_status froe_kinetic_new(froe_motion *motion, const froe_kinetic_options *options, const froe_allocator *alloc,
                             froe_kinetic **out, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!motion || !options || !out) return support_fail_null(diag, __func__);
    if (options->size != sizeof *options) return support_fail_defaults(diag, "froe_kinetic_defaults");
    if (motion->dim == 3 && options->augmented)
        return support_fail(diag, FROE_E_UNSUPPORTED, "A partition in space is not augmented.");
    if (motion->dim == 3 && options->swap)
        return support_fail(diag, FROE_E_UNSUPPORTED, "The order of a partition in space changes in epochs alone.");
    if (options->ghosts && (options->unchecked || motion->dim == 2))
        return support_fail(diag, FROE_E_OPTIONS, "Ghosts are triangles in space, whose contacts are looked for.");
    if (motion->dim == 3 && motion->bodies.count) return refuse_bodies(diag);
    froe_allocator memory = support_allocator(alloc);
    froe_kinetic *k;
    if (kinetic_new_at(motion, &memory, options, 1, &k)) return support_fail_memory(diag);
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
    const froe_allocator alloc = k->call.alloc;
    ktree_free(&k->tree);
    cert_table_free(&k->certs);
    array_free(&alloc, &k->collinear.pairs);
    array_free(&alloc, &k->collinear.first);
    array_free(&alloc, &k->collinear.partners);
    array_free(&alloc, &k->turns.halves);
    array_free(&alloc, &k->participants.list);
    array_free(&alloc, &k->participants.stamps);
    array_free(&alloc, &k->participants.places);
    array_free(&alloc, &k->ranges.places);
    array_free(&alloc, &k->surgery.tasks);
    array_free(&alloc, &k->surgery.cuttings);
    array_free(&alloc, &k->surgery.scratch);
    array_free(&alloc, &k->surgery.beside);
    array_free(&alloc, &k->surgery.kept);
    array_free(&alloc, &k->surgery.parts);
    array_free(&alloc, &k->surgery.orders);
    array_free(&alloc, &k->events.items);
    array_free(&alloc, &k->events.order);
    array_free(&alloc, &k->events.roots);
    array_free(&alloc, &k->events.leaving);
    array_free(&alloc, &k->events.staying);
    array_free(&alloc, &k->events.meeting);
    array_free(&alloc, &k->events.renewed);
    array_free(&alloc, &k->events.turning);
    array_free(&alloc, &k->events.flopping);
    ghost_free(k);
    now_free(&k->now);
    support_free(&alloc, k, sizeof *k);
}

/* --------------------------------------------------------------------- time -- */

double froe_kinetic_time(const froe_kinetic *k) {
    BASE_FLOATS_OWN;
    volatile const double time = now_time_of(&k->now, k->now.tick); /* see base/floats.h */
    return time;
}

double froe_kinetic_next(const froe_kinetic *k) {
    BASE_FLOATS_OWN;
    int64_t tick = cert_next_tick(&k->certs);
    const int64_t touch = touch_next(k);
    if (touch < tick) tick = touch;
    volatile const double time = tick > now_last_tick(&k->now) ? (double)INFINITY : now_time_of(&k->now, tick);
    return time;
}

uint64_t kinetic_event_count(const froe_kinetic *k) {
    uint64_t events = 0;
    for (int i = 0; i < FROE_EVENT_KINDS; i++) events += k->counts.events[i];
    return events;
}

/* In the plane: two segments change places in the order. Both are taken out, and put in again. */
static void swap_two(froe_kinetic *k) {
    const uint64_t n = kinetic_object_count(k), random = base_hash(k->options.seed, ++k->swaps, UINT32_MAX);
    if (n < 2) return;
    const uint32_t s = (uint32_t)(random % n), next = (uint32_t)((random >> 32) % (n - 1)), t = next + (next >= s);
    change_remove(k, s), change_remove(k, t);
    const uint64_t key = *key_of(k, s);
    *key_of(k, s) = *key_of(k, t), *key_of(k, t) = key;
    if (now_is_alive(&k->now, s)) change_insert(k, s);
    if (now_is_alive(&k->now, t)) change_insert(k, t);
}

/* Random transpositions after so many events (Diaconis and Shahshahani, "Generating a random permutation with random
 * transpositions", 1981: n log n / 2 of them make any order as good as random). */
static void swap_order(froe_kinetic *k) {
    if (!k->options.swap) return;
    while (k->swaps < kinetic_event_count(k) / k->options.swap && !k->call.stopped) swap_two(k);
}

/* After enough events, a new random order for everything. */
static void end_epoch(froe_kinetic *k) {
    const uint64_t events = kinetic_event_count(k);
    if (!k->options.epoch || events - k->epoch_events < k->options.epoch) return;
    k->epoch++;
    for (uint32_t o = 0; o < kinetic_object_count(k); o++) *key_of(k, o) = random_key(k, o) | edges_before(k);
    if (now_is_in_space(&k->now)) triangle_enroll_all(k);
    if (!k->call.stopped) surgery_restart(k);
    k->epoch_events = events;
}

froe_status froe_kinetic_advance(froe_kinetic *k, double time, froe_event_fn *visit, void *user,
                                 froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!k) return support_fail_null(diag, __func__);
    if (!(time <= k->now.motion->end))
        return support_fail(diag, FROE_E_ARG, "Time %.15g is not in the window, which ends at %.15g.", time,
                            k->now.motion->end);
    int64_t tick = motion_tick_after(k->now.motion, time) | 1, last = now_last_tick(&k->now);
    if (tick > last) tick = last;
    if (tick < k->now.tick)
        return support_fail(diag, FROE_E_ARG, "Time %.15g has passed: the partition has reached %.15g.", time,
                            now_time_of(&k->now, k->now.tick));
    const event_watcher watcher = {visit, user};
    const int64_t from = k->now.tick;
    froe_status status = kinetic_begin(k, diag);
    if (!status) status = touch_find(k, diag);
    const bool touching = k->touch.known && k->touch.last < tick;
    if (touching) tick = k->touch.last > from ? k->touch.last : from;
    while (!status && k->now.tick < tick) {
        if (!base_progress(&k->call.task, (double)(k->now.tick - from) / (double)(tick - from)))
            return call_fail(&k->call, diag);
        bool go_on = true;
        const int64_t stop = ghost_next(k) < tick ? ghost_next(k) : tick;
        if (!ranges_advance(k, stop, &watcher, &go_on, diag, &status)) go_on = event_step(k, stop, &watcher);
        if (!status && !k->call.stopped && k->now.tick == ghost_next(k)) go_on &= ghost_apply(k, &watcher);
        const bool short_of_memory = k->call.stopped && !base_cancelled(&k->call.task);
        if (!status) status = kinetic_settle(k, diag);
        if (!status && k->touch.again) status = touch_find(k, diag);
        if (!status && short_of_memory && visit) status = support_fail_memory(diag); /* some were not told */
        if (!status) end_epoch(k), swap_order(k), status = kinetic_settle(k, diag);
        if (!go_on && !status) return support_fail(diag, FROE_E_CANCELLED, "The visitor stopped the call.");
    }
    if (status || !touching) return status;
    touch_tell(k, &watcher, &k->touch.first);
    return touch_refuse(k, diag);
}

/* ------------------------------------------------------------------ changes -- */

froe_status froe_kinetic_update(froe_kinetic *k, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!k) return support_fail_null(diag, __func__);
    const uint32_t first = kinetic_object_count(k);
    if (now_is_in_space(&k->now) && k->now.motion->bodies.count) return refuse_bodies(diag);
    froe_status status = kinetic_begin(k, diag);
    if (status) return status;
    if (grow_tables(k)) return support_fail_memory(diag);
    if (first < kinetic_object_count(k)) { /* contacts with what is new were left out */
        k->touch.known = false;
        k->touch.again = k->options.ghosts;
    }
    for (uint32_t o = first; o < kinetic_object_count(k); o++) *key_of(k, o) = random_key(k, o) | edges_before(k);
    for (uint32_t o = first; o < kinetic_object_count(k) && !status; o++) {
        const uint32_t s = now_segment_of(&k->now, o);
        change_schedule(k, s);
        if (now_is_alive(&k->now, o)) change_insert(k, s);
        status = kinetic_settle(k, diag);
    }
    return status ? status : end_change(k, diag);
}

froe_status froe_kinetic_remove(froe_kinetic *k, uint32_t object, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!k) return support_fail_null(diag, __func__);
    if (object >= kinetic_object_count(k)) return support_fail(diag, FROE_E_ARG, "There is no object %u.", object);
    froe_status status = kinetic_begin(k, diag);
    if (status) return status;
    motion_object *o = k->now.motion->objects.data + object;
    const uint32_t segment = now_segment_of(&k->now, object), life = k->certs.segments.data[segment].life;
    if (o->last >= k->now.tick) o->last = k->now.tick - 1;
    if (now_is_in_space(&k->now)) { /* it touches nothing any more */
        const double before = now_time_of(&k->now, k->now.tick - 1);
        if (o->death > before) o->death = before;
        k->touch.known = false;
    }
    if (life != FROE_NONE) cert_set_tick(&k->certs, life, NOW_NEVER);
    change_remove(k, segment);
    return end_change(k, diag);
}

static bool has_vertex(const motion_object *o, uint32_t vertex) {
    return o->vertices[0] == vertex || o->vertices[1] == vertex || o->vertices[2] == vertex;
}

/* Lists what is there and has a vertex, as events.leaving. */
static void find_at_vertex(froe_kinetic *k, uint32_t vertex) {
    k->events.leaving.count = 0;
    if (!now_is_in_space(&k->now)) {
        for (uint32_t e = k->tree.vertices.data[vertex]; e != FROE_NONE; e = ktree_next_end(&k->tree, e))
            call_push(&k->call, &k->events.leaving, e / 2);
        return;
    }
    for (uint32_t o = 0; o < kinetic_object_count(k); o++) {
        const uint32_t surface = now_segment_of(&k->now, o);
        if (ktree_segment_at(&k->tree, surface)->here && has_vertex(k->now.motion->objects.data + o, vertex))
            call_push(&k->call, &k->events.leaving, surface);
    }
}

froe_status froe_kinetic_replan(froe_kinetic *k, uint32_t vertex, size_t count, const double *times,
                                const double *coords, const double *controls, const double *second_controls,
                                froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!k || (count && (!times || !coords))) return support_fail_null(diag, __func__);
    if (vertex >= k->tree.vertices.count) return support_fail(diag, FROE_E_ARG, "There is no vertex %u.", vertex);
    const double now = now_time_of(&k->now, k->now.tick);
    const uint32_t body = k->now.motion->plans.data[vertex].body;
    if (body != FROE_NONE)
        return support_fail(diag, FROE_E_UNSUPPORTED, "Vertex %u flies with body %u, and takes no plan of its own.",
                            vertex, body);
    double life[2] = {now, now}; /* to the end of the last life of a segment at the vertex */
    froe_status status = kinetic_begin(k, diag), settled;
    if (status) return status;
    for (uint32_t i = 0; i < kinetic_object_count(k); i++) {
        const motion_object *o = k->now.motion->objects.data + i;
        const bool lives = o->first <= o->last && o->last >= k->now.tick;
        if (lives && has_vertex(o, vertex) && o->death > life[1]) life[1] = o->death;
    }
    find_at_vertex(k, vertex);
    if (k->call.stopped) return call_fail(&k->call, diag);
    for (size_t i = 0; i < k->events.leaving.count; i++) change_remove(k, k->events.leaving.data[i]);
    status = motion_replan(k->now.motion, vertex, count, times, coords, controls, second_controls, life, diag);
    now_catch_up(&k->now);
    for (size_t i = 0; i < k->events.leaving.count; i++) {
        change_schedule(k, k->events.leaving.data[i]);
        change_insert(k, k->events.leaving.data[i]);
    }
    k->events.leaving.count = 0;
    settled = end_change(k, status ? NULL : diag);
    return status ? status : settled;
}

/* --------------------------------------------------------------- statistics -- */

/* The height of the tree. */
static uint32_t height_of(const ktree *tree) {
    uint32_t height = 0, depth = 1, node = ktree_node_at(tree, KTREE_ROOT)->child[0], slot = 0;
    if (!node) return 0;
    for (;;) { /* up and down by the links to parents */
        height = depth > height ? depth : height;
        while (slot < 4 && !ktree_node_at(tree, node)->child[slot]) slot++;
        if (slot < 4) {
            node = ktree_node_at(tree, node)->child[slot];
            slot = 0;
            depth++;
            continue;
        }
        slot = ktree_node_at(tree, node)->slot + 1u;
        node = ktree_node_at(tree, node)->parent;
        depth--;
        if (node == KTREE_ROOT) return height;
    }
}

froe_kinetic_stats froe_kinetic_statistics(const froe_kinetic *k) {
    froe_kinetic_stats stats = k->counts;
    stats.nodes = k->tree.node_count;
    stats.certificates = k->certs.queue.entries.count;
    stats.height = height_of(&k->tree);
    return stats;
}
