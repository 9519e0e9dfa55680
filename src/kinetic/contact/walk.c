/* walk.c: see walk.h. */
#include "kinetic/contact/walk.h"

void walk_begin(walk_room *w, double from, double to) {
    w->from = from;
    w->to = to;
    w->root_count = w->event_count = w->span_count = 0;
    for (int i = 0; i < WALK_POLYNOMIALS; i++) {
        w->sign[i] = NUM_UNSURE;
        w->listed[i] = w->has_near[i] = false;
    }
}

/* -------------------------------------------------------------------- events -- */

/* Puts a root among the events. */
static bool put_event(num_arena *arena, walk_room *w, num_isolated *root, int i) {
    int k = w->event_count, order = 1;
    for (; k > 0; k--) {
        order = num_isolated_compare(arena, root, w->events[k - 1].at);
        if (order == NUM_UNSURE) return false;
        if (order >= 0) break;
    }
    if (order) {
        for (int j = w->event_count++; j > k; j--) w->events[j] = w->events[j - 1];
        w->events[k] = (walk_event){.at = root};
    } else {
        k--;
    }
    w->events[k].vanishing[i / 64] |= (uint64_t)1 << (i % 64);
    return true;
}

bool walk_list(num_arena *arena, walk_room *w, int i) {
    w->listed[i] = true;
    if (w->f[i].degree < 0) return true;
    num_isolation *r = &w->roots[w->root_count++];
    num_isolate(arena, &w->f[i], r);
    for (int k = 0; k < r->count; k++)
        if (!put_event(arena, w, &r->root[k], i)) return false;
    return r->count >= 0;
}

/* --------------------------------------------------------------------- signs -- */

static const num_ball_poly *near_of(num_arena *arena, walk_room *w, int i) {
    if (!w->has_near[i]) w->near[i] = num_poly_balls(arena, &w->f[i]);
    w->has_near[i] = true;
    return &w->near[i];
}

int walk_sign(num_arena *arena, walk_room *w, const walk_moment *at, int i) {
    if (w->sign[i] != NUM_UNSURE) return w->sign[i];
    if (w->f[i].degree < 0) return 0;
    if (at->event && !w->listed[i]) return num_isolated_sign(arena, at->event->at, &w->f[i], near_of(arena, w, i));
    if (at->event && (at->event->vanishing[i / 64] >> (i % 64) & 1)) return 0;
    const int sign = num_ball_sign(num_ball_poly_at(near_of(arena, w, i), at->near));
    return sign == NUM_UNSURE ? num_poly_sign(arena, &w->f[i], at->share) : sign;
}

walk_moment walk_start(void) {
    return (walk_moment){.share = {0}};
}

walk_moment walk_end(num_arena *arena) {
    return (walk_moment){.share = num_dyadic_scaled(arena, 1, 1, 0), .near = num_ball_from(1)};
}

/* ------------------------------------------------------------------- between -- */

/* The middle between the upper end of one interval and the lower end of the next; NULL: 0 and 1. False: too close. */
static bool middle_between(num_arena *arena, num_isolated *before, num_isolated *after, walk_moment *out) {
    for (;;) {
        const size_t mark = arena->top;
        const num_dyadic low = before ? num_isolated_high(arena, before) : (num_dyadic){0};
        const num_dyadic high = after ? num_isolated_low(after) : num_dyadic_scaled(arena, 1, 1, 0);
        if (num_dyadic_compare(low, high) < 0) {
            const num_dyadic sum = num_dyadic_add(arena, low, high);
            *out = (walk_moment){.share = num_dyadic_mul(arena, sum, num_dyadic_scaled(arena, 1, 1, -1))};
            const double near = num_dyadic_quotient(arena, out->share, num_dyadic_scaled(arena, 1, 1, 0));
            out->near = (num_ball){near, near * 0x1p-53 + 0x1p-1074};
            return true;
        }
        arena->top = mark;
        bool refined = false;
        if (before && !before->exact) refined = num_isolated_refine(arena, before);
        if (after && !after->exact) refined = num_isolated_refine(arena, after) || refined;
        if (!refined) return false;
    }
}

/* x 2^-lift, rounded down, or up where `way` is 1. */
static double lower_by(double x, int lift, int way) {
    const double y = ldexp(x, -lift), back = ldexp(y, lift);
    if (way < 0 ? back > x : back < x) return nextafter(y, way * (double)INFINITY);
    return y;
}

/* From share to time: an enclosure of two doubles. Small times are raised by a power of 2 meanwhile, since error bounds
 * of balls do not become as small as they are. */
bool walk_time(num_arena *arena, double from, double to, num_isolated *root, meet_time *out) {
    int length, size;
    frexp(to - from, &length);
    frexp(fabs(from) > fabs(to) ? from : to, &size);
    const int depth = length - size + 55; /* a quarter of the last place of the greater end */
    const int lift = size < -400 ? -size : 0;
    if (!num_isolated_narrow(arena, root, depth > 1 ? depth : 1)) return false;
    const num_ball a = num_ball_from(ldexp(from, lift)), b = num_ball_from(ldexp(to, lift));
    const num_ball t = num_ball_add(a, num_ball_mul(num_ball_sub(b, a), num_isolated_ball(root)));
    double low = t.x - t.e, high = t.x + t.e;
    if (t.e > 0) low = nextafter(low, -(double)INFINITY), high = nextafter(high, (double)INFINITY);
    if (lift) low = lower_by(low, lift, -1), high = lower_by(high, lift, 1);
    *out = (meet_time){low > from ? low : from, high < to ? high : to};
    return true;
}

static bool time_of_event(num_arena *arena, walk_room *w, int k, meet_time *out) {
    *out = k < 0 ? (meet_time){w->from, w->from} : (meet_time){w->to, w->to};
    return k < 0 || k == w->event_count || walk_time(arena, w->from, w->to, w->events[k].at, out);
}

/* An event (or end) at which they meet or not. What is before it has been seen. */
static void pass_instant(walk_room *w, bool *now, bool meets, int k) {
    if (meets && !*now) {
        w->first[w->span_count] = k;
        w->spans[w->span_count++] = (meet_span){.instant = true};
    }
    if (meets) w->last[w->span_count - 1] = k;
    *now = meets;
}

static bool walk_events(num_arena *arena, walk_room *w, walk_fn *meets, void *user) {
    walk_moment at = walk_start();
    bool now = false;
    pass_instant(w, &now, meets(user, &at), -1);
    for (int k = 0; k <= w->event_count; k++) {
        num_isolated *before = k ? w->events[k - 1].at : NULL, *after = k < w->event_count ? w->events[k].at : NULL;
        const size_t mark = arena->top;
        if (!middle_between(arena, before, after, &at)) return false;
        const bool between = meets(user, &at); /* contacts are taken as closed: they begin and end in instants */
        if (between) pass_instant(w, &now, true, k - 1);
        if (between) w->spans[w->span_count - 1].instant = false;
        now = between;
        if (after)
            at.event = &w->events[k];
        else
            at = walk_end(arena);
        pass_instant(w, &now, between || meets(user, &at), k);
        arena->top = mark;
    }
    for (int i = 0; i < w->span_count; i++) {
        w->spans[i].from_start = w->first[i] < 0;
        w->spans[i].to_end = w->last[i] == w->event_count;
        if (!time_of_event(arena, w, w->first[i], &w->spans[i].begin) ||
            !time_of_event(arena, w, w->last[i], &w->spans[i].end))
            return false;
    }
    return true;
}

bool walk_through(num_arena *arena, walk_room *w, walk_fn *meets, void *user) {
    const walk_moment start = walk_start();
    if (w->from < w->to) return walk_events(arena, w, meets, user);
    if (!meets(user, &start)) return true;
    const meet_time at = {w->from, w->from}; /* an instant alone */
    w->spans[w->span_count++] =
        (meet_span){.begin = at, .end = at, .instant = true, .from_start = true, .to_end = true};
    return true;
}
