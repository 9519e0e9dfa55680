/* ranges.c: time goes on in ranges of x at once, on threads.
 *
 *     t  |   range 0   :   range 1   :   range 2      In a window of time each range goes on by itself (range.h). What
 *     ^  |=============:=============:==========      all have told is told again in order of time, and from left to
 *     |  |   window    :             :                right within a tick, as one partition would have told it. So
 *        |=============:=============:==========      neither events nor their order depend on how many ranges there
 *        +------------------------------------> x     are. The shorter a window, the fewer segments come near a border
 *                                                     and belong to two ranges; but each window makes its parts anew.
 *
 * Like the conservative simulation of events in independent regions (Chandy and Misra 1979), but without any message
 * between regions: what lies beyond a border is known from the plans. */
#include "kinetic/range/ranges.h"
#include "base/select.h"
#include "kinetic/kinetic.h"
#include "kinetic/range/range.h"
#include "support/fail.h"
#include <math.h>

enum { SAMPLES = 2048, EXTENTS_PER_JOB = 256 };

ranges_tuning ranges_defaults(void) {
    return (ranges_tuning){.least = 512,
                           .alone = 4096,
                           .pays = 3,
                           .making = 5,
                           .most = 32,
                           .again = 1.3,
                           .gaps = 6,
                           .guard = {0x1p-12, 0x1p-4},
                           .size = 1024};
}

/* Where a segment is during the window, as now_lifted(). */
typedef struct range_extent {
    double low, high; /* low > high: it is not there */
} range_extent;

typedef struct window {
    froe_kinetic *k;
    int64_t tick; /* its end */
    size_t n, count, members;
    range_extent *extents; /* [n] */
    uint32_t *home;        /* [n]: the first range that a segment comes into */
    double *samples;       /* [2 SAMPLES]: where segments are, and where events were */
    kinetic_range *ranges;
    kinetic_range **heap; /* those that have something to tell, the first to tell on top */
    size_t room;          /* of these */
} window;

static void free_ranges(window *w) {
    for (size_t i = 0; i < w->count; i++) range_free(w->ranges + i);
    w->count = 0;
}

static void free_window(window *w) {
    const froe_allocator *alloc = &w->k->call.alloc;
    free_ranges(w);
    if (w->extents) support_free(alloc, w->extents, w->n * sizeof *w->extents);
    if (w->home) support_free(alloc, w->home, w->n * sizeof *w->home);
    if (w->samples) support_free(alloc, w->samples, 2 * SAMPLES * sizeof *w->samples);
    if (w->ranges) support_free(alloc, w->ranges, w->room * sizeof *w->ranges);
    if (w->heap) support_free(alloc, w->heap, w->room * sizeof(kinetic_range *));
}

static bool new_window(froe_kinetic *k, window *out) {
    const froe_allocator *alloc = &k->call.alloc;
    const size_t n = k->tree.segments.count, many = n / k->ranges.tuning.size;
    const size_t some = k->call.task.threads > 2 ? k->call.task.threads : 2;
    *out = (window){.k = k, .n = n, .room = many > some ? many : some};
    out->extents = support_calloc(alloc, out->n, sizeof *out->extents);
    out->home = support_calloc(alloc, out->n, sizeof *out->home);
    out->samples = support_calloc(alloc, 2 * SAMPLES, sizeof *out->samples);
    out->ranges = support_calloc(alloc, out->room, sizeof *out->ranges);
    out->heap = support_calloc(alloc, out->room, sizeof(kinetic_range *));
    return out->extents && out->home && out->samples && out->ranges && out->heap;
}

/* ----------------------------------------------------------------- extents -- */

static void extend_by(double x, double *low, double *high) {
    if (x < *low) *low = x;
    if (x > *high) *high = x; /* NaN: there is none */
}

/* Where a vertex comes between two times, in x. */
static void extend_by_plan(const froe_motion *m, uint32_t vertex, double from, double to, double *low, double *high) {
    const motion_plan *plan = m->plans.data + vertex;
    const bool own = plan->body == FROE_NONE;
    const motion_knot *first = m->knots.data + (own ? plan : &m->bodies.data[plan->body].plan)->first;
    motion_piece piece = motion_piece_at_time(m, vertex, from);
    for (;;) {
        const bool ends = piece.last != MOTION_FAR && piece.to->time < to;
        if (own && ends && piece.from->time >= from) { /* all of it */
            extend_by(piece.from->at[0], low, high), extend_by(piece.to->at[0], low, high);
            extend_by(piece.from->control[0], low, high);
            if (piece.second) extend_by(piece.second[0], low, high);
        } else {
            motion_extend(m, &piece, from, ends ? piece.to->time : to, 1, low, high);
        }
        if (!ends) return;
        from = piece.to->time;
        piece = motion_piece_after(m, vertex, (uint32_t)(piece.to - first));
    }
}

static range_extent extent_of(const window *w, uint32_t object) {
    const now_state *now = &w->k->now;
    const motion_object *o = now->motion->objects.data + object;
    const double begin = now_time_of(now, now->tick), end = now_time_of(now, w->tick);
    const double from = fmax(begin, o->birth), to = w->k->ranges.tuning.unguarded ? from : fmin(end, o->death);
    double low = (double)INFINITY, high = -low;
    if (!(from <= to)) return (range_extent){1, -1};
    for (int e = 0; e < 2; e++) extend_by_plan(now->motion, o->vertices[e], from, to, &low, &high);
    return (range_extent){now_lifted(now, low), now_lifted(now, high)};
}

static froe_status find_extents(void *user, unsigned worker, size_t job) {
    const window *w = user;
    const size_t first = job * EXTENTS_PER_JOB, end = first + EXTENTS_PER_JOB < w->n ? first + EXTENTS_PER_JOB : w->n;
    (void)worker;
    for (size_t i = first; i < end; i++) w->extents[i] = extent_of(w, (uint32_t)i);
    return FROE_OK;
}

/* ----------------------------------------------------------------- borders -- */

/* Samples of where segments are, and of where events were, which take most of the time. Returns how many. */
static size_t take_samples(const window *w, double *low, double *high) {
    const ranges_state *r = &w->k->ranges;
    size_t sampled = 0;
    const size_t step = w->n / SAMPLES + 1, seldom = r->places.count ? 8 : 1;
    *low = (double)INFINITY, *high = -(double)INFINITY;
    for (size_t i = 0; i < w->n; i++) {
        const range_extent *e = w->extents + i;
        if (!(e->low <= e->high)) continue;
        *low = fmin(*low, e->low), *high = fmax(*high, e->high);
        if (i % (step * seldom) == 0) w->samples[sampled++] = 0.5 * e->low + 0.5 * e->high;
    }
    for (size_t i = 0; i < r->places.count; i++) w->samples[sampled++] = r->places.data[i];
    return sampled;
}

/* Divides x so that each range has about as much to do. */
static void place_borders(window *w, size_t most) {
    double low, high;
    const size_t sampled = take_samples(w, &low, &high);
    double border = -(double)INFINITY;
    for (size_t i = 0, first = 0; i < most && sampled; i++) {
        const size_t end = sampled * (i + 1) / most; /* of what lies before its high border */
        const double next =
            end < sampled ? base_select(w->samples + first, sampled - first, end - first) : (double)INFINITY;
        first = end;
        if (!(next > border)) continue;
        const double guard = (high - low) * w->k->ranges.guard;
        w->ranges[w->count] =
            (kinetic_range){.whole = w->k, .number = (uint32_t)w->count, .low = border, .high = next, .guard = guard};
        w->count++;
        border = next;
    }
}

/* How far beyond its borders a range knows all segments. */
static double guard_of(const window *w, const kinetic_range *r) {
    return w->k->ranges.tuning.unguarded ? 0 : 1.25 * r->guard;
}

/* The first range that reaches to a place. */
static uint32_t first_range(const window *w, double place) {
    uint32_t low = 0, high = (uint32_t)w->count - 1;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        const kinetic_range *r = w->ranges + middle;
        if (place > r->high + guard_of(w, r))
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* Lists the members of each range. */
static bool list_members(window *w) {
    w->members = 0;
    for (uint32_t s = 0; s < w->n; s++) {
        const range_extent *e = w->extents + s;
        w->home[s] = FROE_NONE;
        if (!(e->low <= e->high)) continue;
        for (uint32_t i = w->home[s] = first_range(w, e->low); i < w->count; i++) {
            kinetic_range *r = w->ranges + i;
            if (e->high < r->low - guard_of(w, r)) break;
            if (!array_push(&w->k->call.alloc, &r->members, s)) return false;
            w->members++;
        }
    }
    return true;
}

/* Divides the window into so many ranges. False: their parts have too much in common, or there is no memory. */
static bool divide_into(window *w, size_t ranges) {
    free_ranges(w);
    place_borders(w, ranges);
    return w->count > 1 && list_members(w) && (double)w->members <= w->k->ranges.tuning.again * (double)w->n;
}

static froe_status set_end(window *w, int64_t tick) {
    w->tick = tick;
    return base_run(&w->k->call.task, 0, (w->n + EXTENTS_PER_JOB - 1) / EXTENTS_PER_JOB, find_extents, w);
}

/* About how many times as fast as one thread, where a window has so many events for each segment. */
static double gain_of(const window *w, size_t ranges, double events) {
    const size_t threads = w->k->call.task.threads > 1 ? w->k->call.task.threads : 1;
    return (double)(ranges < threads ? ranges : threads) / (1 + w->k->ranges.tuning.making / events);
}

/* Many ranges need short windows, in which parts have little in common, and few may go through long ones, in which
 * their making counts little: takes what gains most. No ranges: nothing does. */
static froe_status divide(window *w, double rate) {
    const int64_t now = w->k->now.tick;
    int64_t best = now;
    size_t chosen = 0;
    double gain = 0;
    bool divided = false; /* as chosen */
    for (int64_t tick = w->tick;; tick = now + (tick - now) / 4 * 2) {
        const double events = rate * (double)(tick - now) / (double)w->n;
        if (events < w->k->ranges.tuning.pays || gain_of(w, w->room, events) <= gain) break;
        const froe_status status = set_end(w, tick);
        if (status) return status;
        for (size_t ranges = w->room; ranges > 1 && gain_of(w, ranges, events) > gain;
             ranges = ranges > 3 ? ranges / 2 : ranges - 1) {
            divided = divide_into(w, ranges);
            if (divided) best = tick, chosen = ranges, gain = gain_of(w, ranges, events);
        }
    }
    if (!divided && chosen) {
        const froe_status status = set_end(w, best);
        if (status) return status;
        divided = divide_into(w, chosen);
    }
    if (!divided) free_ranges(w);
    return FROE_OK;
}

/* ------------------------------------------------------------------ window -- */

typedef struct following {
    window *w;
    range_window *shared;
} following;

static froe_status follow_range(void *user, unsigned worker, size_t job) {
    const following *f = user;
    (void)worker;
    return range_follow(f->w->ranges + job, f->shared);
}

/* All ranges go through the window, or until one of them stops. *end: the tick until which all have come. */
static froe_status follow_all(window *w, int64_t *end) {
    range_window shared = {.tick = w->tick, .home = w->home, .task = &w->k->call.task};
    following f = {w, &shared};
    atomic_init(&shared.stopped, NOW_NEVER);
    const froe_status status = base_run(&w->k->call.task, 0, w->count, follow_range, &f);
    const int64_t stopped = atomic_load(&shared.stopped);
    *end = stopped - 2 < w->tick ? stopped - 2 : w->tick;
    return status;
}

static bool comes_before(const range_event *a, const range_event *b) {
    if (a->tick != b->tick) return a->tick < b->tick;
    if (a->phase != b->phase) return a->phase < b->phase;
    return a->phase == EVENT_CHANGE ? a->objects[0] < b->objects[0] : a->place < b->place;
}

static bool tell(froe_kinetic *k, const event_watcher *watcher, const range_event *kept) {
    k->now.tick = kept->tick;
    if (kept->claim.p.b == NAME_SEGMENT) k->now.segments.data[kept->claim.p.a].turned = kept->turned;
    froe_event event = event_now(&k->now, (froe_event_kind)kept->kind);
    event.object_count = kept->count;
    for (unsigned i = 0; i < 4 && i < kept->count; i++) event.objects[i] = kept->objects[i];
    return event_tell(k, watcher, &event, &kept->claim);
}

static const range_event *next_of(const kinetic_range *r) {
    return r->events.data + r->told;
}

static void sink_range(kinetic_range **heap, size_t count, size_t at) {
    kinetic_range *r = heap[at];
    for (size_t child = 2 * at + 1; child < count; child = 2 * at + 1) {
        if (child + 1 < count && comes_before(next_of(heap[child + 1]), next_of(heap[child]))) child++;
        if (!comes_before(next_of(heap[child]), next_of(r))) break;
        heap[at] = heap[child];
        at = child;
    }
    heap[at] = r;
}

/* Tells the events of all ranges up to a tick in their order. False: the visitor asked to stop, and the tick is that
 * of the last event. */
static bool tell_all(window *w, int64_t *tick, const event_watcher *watcher) {
    bool go_on = true;
    size_t count = 0;
    for (size_t i = 0; i < w->count; i++)
        if (w->ranges[i].events.count) w->heap[count++] = w->ranges + i;
    for (size_t i = count / 2; i-- > 0;) sink_range(w->heap, count, i);
    while (count && next_of(w->heap[0])->tick <= *tick) {
        kinetic_range *first = w->heap[0];
        go_on &= tell(w->k, watcher, next_of(first));
        if (!go_on) *tick = next_of(first)->tick;
        if (++first->told == first->events.count) w->heap[0] = w->heap[--count];
        if (count) sink_range(w->heap, count, 0);
    }
    return go_on;
}

/* Remembers where events were, for the next window. Without memory it does not. */
static void note_places(window *w) {
    ranges_state *r = &w->k->ranges;
    size_t all = 0, next = 0;
    r->places.count = 0;
    if (!array_reserve(&w->k->call.alloc, &r->places, SAMPLES)) return;
    for (size_t i = 0; i < w->count; i++) all += w->ranges[i].events.count;
    for (size_t i = 0, done = 0; i < w->count; done += w->ranges[i++].events.count)
        for (; next < done + w->ranges[i].events.count; next += all / SAMPLES + 1) {
            const range_event *e = w->ranges[i].events.data + (next - done);
            if (e->phase != EVENT_CHANGE) r->places.data[r->places.count++] = e->place;
        }
}

static void add_counts(froe_kinetic_stats *all, const froe_kinetic_stats *part) {
    all->surgeries += part->surgeries, all->batches += part->batches, all->crowds += part->crowds;
    all->restarts += part->restarts, all->stuck += part->stuck;
    all->nodes_touched += part->nodes_touched, all->certificates_made += part->certificates_made;
}

/* The whole takes over where the ranges have come to. */
static void take_over(window *w, int64_t tick) {
    w->k->now.tick = tick;
    for (size_t i = 0; i < w->count; i++) add_counts(&w->k->counts, &w->ranges[i].counts);
}

/* ---------------------------------------------------------------- together -- */

typedef enum window_outcome {
    THROUGH, /* to the end of the window */
    STOPPED, /* a part of it, or the visitor asked to stop */
    NOT_AT_ALL
} window_outcome;

/* Guards become wide enough for what ranges stopped at first, and twice as wide at least. */
static void widen_guards(window *w, int64_t end) {
    const ranges_state *r = &w->k->ranges;
    double guard = 0;
    for (size_t i = 0; i < w->count; i++) {
        const kinetic_range *range = w->ranges + i;
        if (range->wide == 0 || range->stopped - 2 != end) continue;
        const double times = 2.25 * range->wide / range->guard; /* NaN, infinite: as wide as may be */
        guard = fmax(guard, times < r->tuning.guard[1] / r->guard ? fmax(2, times) * r->guard : r->tuning.guard[1]);
    }
    if (guard > 0) w->k->ranges.guard = fmin(guard, r->tuning.guard[1]);
}

/* Goes through one window, towards a tick. */
static window_outcome go_through(window *w, double rate, int64_t tick, const event_watcher *watcher, bool *go_on,
                                 froe_status *status) {
    froe_kinetic *k = w->k;
    const int64_t before = k->now.tick;
    const double share = k->ranges.places.count ? 1 : 0.25; /* soon, to learn where most happens */
    const double most = share * k->ranges.tuning.most * (double)w->n / rate;
    w->tick = most < (double)(tick - before) ? before + 2 * (int64_t)(0.5 * most) : tick;
    *status = divide(w, rate);
    if (*status || !w->count) return NOT_AT_ALL;
    int64_t end;
    *status = follow_all(w, &end);
    if (*status) return NOT_AT_ALL;
    widen_guards(w, end);
    k->ranges.windows++;
    k->ranges.stopped += end < w->tick;
    if (end <= before) return NOT_AT_ALL;
    *go_on = tell_all(w, &end, watcher);
    take_over(w, end);
    if (end < w->tick) return STOPPED;
    note_places(w);
    return THROUGH;
}

/* Events for a tick, since the last window began. */
static double rate_of(const froe_kinetic *k) {
    return (double)(kinetic_event_count(k) - k->ranges.events) / (double)(k->now.tick - k->ranges.tick);
}

static bool may_pay(const froe_kinetic *k, int64_t tick) {
    const ranges_state *r = &k->ranges;
    const froe_kinetic_options *o = &k->options;
    const double n = (double)k->tree.segments.count;
    const bool alone = k->call.task.threads < 2;
    if ((alone && !o->ahead) || now_is_in_space(&k->now) || o->epoch || o->swap || o->augmented) return false;
    if (k->collinear.count) return false; /* which pairs are known depends on what happened before */
    if (k->tree.segments.count < (alone ? r->tuning.alone : r->tuning.least)) return false;
    if (kinetic_event_count(k) < r->next) return false;
    return rate_of(k) * (double)(tick - k->now.tick) >= r->tuning.pays * n;
}

static window_outcome go_on_from(froe_kinetic *k, int64_t tick, const event_watcher *watcher, bool *go_on,
                                 froe_status *status) {
    window w;
    const uint64_t events = kinetic_event_count(k);
    const int64_t now = k->now.tick;
    const double rate = rate_of(k);
    *status = FROE_E_MEMORY;
    const window_outcome out = new_window(k, &w) ? go_through(&w, rate, tick, watcher, go_on, status) : NOT_AT_ALL;
    free_window(&w);
    if (out != NOT_AT_ALL) k->ranges.events = events, k->ranges.tick = now;
    return out;
}

/* The guard, which is chosen when it is needed first. */
static double first_guard(froe_kinetic *k) {
    const double gaps = k->ranges.tuning.gaps / (double)k->tree.segments.count, *limits = k->ranges.tuning.guard;
    if (!(k->ranges.guard > 0)) k->ranges.guard = fmin(fmax(gaps, limits[0]), limits[1]);
    return k->ranges.guard;
}

bool ranges_advance(froe_kinetic *k, int64_t tick, const event_watcher *watcher, bool *go_on, froe_diagnostic *diag,
                    froe_status *status) {
    const int64_t before = k->now.tick;
    window_outcome out = THROUGH;
    *status = FROE_OK;
    if (!may_pay(k, tick)) return false;
    const double guard = first_guard(k);
    while (out == THROUGH && *go_on && k->now.tick < tick && may_pay(k, tick))
        out = go_on_from(k, tick, watcher, go_on, status);
    if (*status == FROE_E_MEMORY) *status = FROE_OK;  /* one partition needs less */
    if (out != THROUGH && k->ranges.guard <= guard) { /* it does not pay here, or not now */
        k->ranges.wait = 2 * k->ranges.wait + k->tree.segments.count / 4;
        k->ranges.next = kinetic_event_count(k) + k->ranges.wait;
    } else {
        k->ranges.wait = 0;
    }
    if (k->now.tick > before && !*status) {
        const uint64_t restarts = k->counts.restarts;
        kinetic_make_anew(k);
        k->counts.restarts = restarts;
    } else if (k->now.tick > before) {
        call_stop(&k->call); /* the tree is to be made anew by the next call */
    }
    if (*status) support_fail_cancelled(diag);
    return *status || k->now.tick > before;
}
