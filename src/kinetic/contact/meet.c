/* meet.c: see meet.h. Error bounds first: most pairs stay apart for a simple reason. Then exactly: the roots of all
 * turns in their order, and signs at them and between them. */
#include "kinetic/contact/meet.h"

#define T num_ball
#define CURVE motion_ball_curve
#define POLY num_ball_poly
#define FORMULA(f) f##_ball
#define ADD(a, b) num_ball_add(a, b)
#define SUB(a, b) num_ball_sub(a, b)
#define MUL(a, b) num_ball_mul(a, b)
#include "kinetic/contact/sides_body.inc"

#define T num_dyadic
#define CURVE motion_dyadic_curve
#define POLY num_poly
#define FORMULA(f) f##_dyadic
#define ADD(a, b) num_dyadic_add(arena, a, b)
#define SUB(a, b) num_dyadic_sub(arena, a, b)
#define MUL(a, b) num_dyadic_mul(arena, a, b)
#include "kinetic/contact/sides_body.inc"

/* An instant at which a turn (or a gap) vanishes; the bits of those whose isolated root it is. */
typedef struct meet_event {
    num_isolated *at;
    uint32_t vanishing;
} meet_event;

typedef struct meeting {
    const froe_motion *m;
    meet_worker *w;
    double a, b;
    motion_piece piece[4]; /* of p0, p1, q0, q1 */
    const num_poly *f;     /* what decides: the turns, or the gaps where all turns are 0 for good */
    int f_count;
    meet_event events[MEET_EVENTS];
    int event_count;
} meeting;

/* --------------------------------------------------------------- error bounds -- */

/* The sign of a polynomial all over 0 .. 1, if Bernstein's coefficients have one and the same; else NUM_UNSURE. */
static int sign_throughout(const num_ball_poly *f) {
    static const double to_bernstein[5][5] = {
        {1}, {4, 1}, {6, 3, 1}, {4, 3, 2, 1}, {1, 1, 1, 1, 1}}; /* row j: C(j, i) / C(4, i), times a whole number */
    int sign = num_ball_sign(f->c[0]);
    if (!sign) return NUM_UNSURE;
    for (int j = 1; j < 5 && sign != NUM_UNSURE; j++) {
        num_ball sum = num_ball_from(0);
        for (int i = 0; i <= j && i <= f->degree; i++)
            sum = num_ball_add(sum, num_ball_mul(num_ball_from(to_bernstein[j][i]), f->c[i]));
        if (num_ball_sign(sum) != sign) sign = NUM_UNSURE;
    }
    return sign;
}

/* Do these keep one and the same sign? */
static bool all_alike(const num_ball_poly *f, int count) {
    int sign = sign_throughout(f);
    for (int i = 1; i < count && sign != NUM_UNSURE; i++)
        if (sign_throughout(f + i) != sign) sign = NUM_UNSURE;
    return sign != NUM_UNSURE;
}

static bool surely_apart(const meeting *g) {
    motion_ball_curve v[4];
    num_ball_poly gap[MEET_GAPS], turn[MEET_TURNS];
    for (int i = 0; i < 4; i++) motion_span_ball(g->m, &g->piece[i], g->a, g->b, &v[i]);
    gaps_ball(NULL, v, v + 2, gap);
    if (all_alike(gap, 4) || all_alike(gap + 4, 4)) return true;
    turns_ball(NULL, v, v + 2, gap, turn);
    return all_alike(turn, 2) || all_alike(turn + 2, 2);
}

/* ------------------------------------------------------------------- exactly -- */

static void take_polynomials(meeting *g) {
    meet_worker *w = g->w;
    motion_dyadic_curve v[4];
    for (int i = 0; i < 4; i++) motion_span_dyadic(&w->arena, g->m, &g->piece[i], g->a, g->b, &v[i]);
    gaps_dyadic(&w->arena, v, v + 2, w->gap);
    turns_dyadic(&w->arena, v, v + 2, w->gap, w->turn);
    bool flat = true;
    for (int i = 0; i < MEET_TURNS; i++) {
        num_poly_trim(&w->turn[i], 4);
        if (w->turn[i].degree >= 0) flat = false;
    }
    for (int i = 0; i < MEET_GAPS; i++) {
        num_poly_trim(&w->gap[i], 2);
        w->near_gap[i] = num_poly_balls(&w->arena, &w->gap[i]);
    }
    g->f = flat ? w->gap : w->turn;
    g->f_count = flat ? MEET_GAPS : MEET_TURNS;
}

/* The roots of all polynomials in order. False: two are too close to be told apart. */
static bool find_events(meeting *g) {
    for (int i = 0; i < g->f_count; i++) {
        num_isolation *r = &g->w->roots[i];
        if (g->f[i].degree < 0) continue;
        num_isolate(&g->w->arena, &g->f[i], r);
        if (r->count < 0) return false;
        for (num_isolated *root = r->root; root < r->root + r->count; root++) {
            int k = g->event_count, order = 1;
            for (; k > 0; k--) {
                order = num_isolated_compare(&g->w->arena, root, g->events[k - 1].at);
                if (order == NUM_UNSURE) return false;
                if (order >= 0) break;
            }
            if (!order) {
                g->events[k - 1].vanishing |= 1u << i;
                continue;
            }
            for (int j = g->event_count++; j > k; j--) g->events[j] = g->events[j - 1];
            g->events[k] = (meet_event){root, 1u << i};
        }
    }
    return true;
}

/* --------------------------------------------------------------------- signs -- */

/* An instant: a dyadic share of the time, or an event. */
typedef struct moment {
    num_dyadic share;
    const meet_event *event; /* NULL: share */
} moment;

static int sign_of_gap(meeting *g, const moment *at, int i) {
    meet_worker *w = g->w;
    if (!at->event) return num_poly_sign(&w->arena, &w->gap[i], at->share);
    return num_isolated_sign(&w->arena, at->event->at, &w->gap[i], &w->near_gap[i]);
}

/* `share`: an instant, or for an event one just before or after it, where turns that do not vanish have the same sign.
 */
static bool meet_at(meeting *g, const moment *at) {
    int sign[MEET_TURNS];
    bool flat = true;
    for (int i = 0; i < MEET_TURNS; i++) {
        bool vanishes = at->event && g->f == g->w->turn && (at->event->vanishing >> i & 1);
        sign[i] = vanishes ? 0 : num_poly_sign(&g->w->arena, &g->w->turn[i], at->share);
        if (sign[i]) flat = false;
    }
    if (sign[0] * sign[1] > 0 || sign[2] * sign[3] > 0) return false;
    for (int k = 0; k < 2 && flat; k++) { /* boxes are apart if on one axis all of q is on one side of all of p */
        int first = sign_of_gap(g, at, 4 * k), alike = 1;
        for (int i = 1; i < 4; i++) alike += sign_of_gap(g, at, 4 * k + i) == first;
        if (first && alike == 4) return false;
    }
    return true;
}

/* ------------------------------------------------------------------- between -- */

/* The middle between the upper end of one interval and the lower end of the next; NULL: 0 and 1. False: too close. */
static bool middle_between(meeting *g, num_isolated *before, num_isolated *after, num_dyadic *out) {
    num_arena *arena = &g->w->arena;
    for (;;) {
        size_t mark = arena->top;
        num_dyadic low = before ? num_isolated_high(arena, before) : (num_dyadic){0};
        num_dyadic high = after ? num_isolated_low(after) : num_dyadic_scaled(arena, 1, 1, 0);
        if (num_dyadic_compare(low, high) < 0) {
            num_dyadic sum = num_dyadic_add(arena, low, high);
            *out = num_dyadic_mul(arena, sum, num_dyadic_scaled(arena, 1, 1, -1));
            return true;
        }
        arena->top = mark;
        bool refined = false;
        if (before && !before->exact) refined = num_isolated_refine(arena, before);
        if (after && !after->exact) refined = num_isolated_refine(arena, after) || refined;
        if (!refined) return false;
    }
}

/* From share to time: an enclosure of two doubles. */
static bool time_of_root(const meeting *g, num_isolated *root, meet_time *out) {
    int length, size;
    frexp(g->b - g->a, &length);
    frexp(fabs(g->a) > fabs(g->b) ? g->a : g->b, &size);
    int depth = length - size + 55; /* a quarter of the last place of the greater end */
    if (!num_isolated_narrow(&g->w->arena, root, depth > 1 ? depth : 1)) return false;
    num_ball a = num_ball_from(g->a), length_ball = num_ball_sub(num_ball_from(g->b), a);
    num_ball t = num_ball_add(a, num_ball_mul(length_ball, num_isolated_ball(root)));
    double low = t.x - t.e, high = t.x + t.e;
    if (t.e > 0) low = nextafter(low, -(double)INFINITY), high = nextafter(high, (double)INFINITY);
    *out = (meet_time){low > g->a ? low : g->a, high < g->b ? high : g->b};
    return true;
}

/* An instant at which they meet or not. What is before it has been seen. */
static void pass_instant(meet_worker *w, bool *now, bool meets, meet_time at) {
    if (meets && !*now) w->spans[w->span_count++] = (meet_span){.begin = at, .instant = true};
    if (meets) w->spans[w->span_count - 1].end = at;
    *now = meets;
}

/* Both ends, the events, and the gaps between them, one after the other. */
static bool walk_roots(meeting *g) {
    meet_worker *w = g->w;
    moment at = {.share = {0}};
    bool now = false;
    pass_instant(w, &now, meet_at(g, &at), (meet_time){g->a, g->a});
    for (int k = 0; k <= g->event_count; k++) {
        num_isolated *before = k ? g->events[k - 1].at : NULL, *after = k < g->event_count ? g->events[k].at : NULL;
        meet_time then = {g->b, g->b};
        size_t mark = w->arena.top;
        if (!middle_between(g, before, after, &at.share) || (after && !time_of_root(g, after, &then))) return false;
        at.event = NULL;
        now = meet_at(g, &at); /* in the gap: contacts are closed, they begin and end in instants */
        if (now) w->spans[w->span_count - 1].instant = false;
        at.event = after ? &g->events[k] : NULL;
        if (!after) at.share = num_dyadic_scaled(&w->arena, 1, 1, 0);
        pass_instant(w, &now, meet_at(g, &at), then);
        w->arena.top = mark;
    }
    return true;
}

froe_status meet_find(const froe_motion *m, meet_worker *worker, uint32_t p, uint32_t q, double a, double b) {
    meeting g = {.m = m, .w = worker, .a = a, .b = b};
    const motion_object *objects[2] = {m->objects.data + p, m->objects.data + q};
    for (int i = 0; i < 4; i++) g.piece[i] = motion_piece_at_time(m, objects[i / 2]->vertices[i % 2], a);
    worker->span_count = 0;
    worker->arena.top = 0;
    worker->stats.pairs++;
    if (surely_apart(&g)) return FROE_OK;
    worker->stats.exact++;
    take_polynomials(&g);
    moment start = {.share = {0}}, end = {.share = num_dyadic_scaled(&worker->arena, 1, 1, 0)};
    const bool at_start = meet_at(&g, &start), at_end = meet_at(&g, &end);
    meet_span *spans = worker->spans;
    if (a < b) {
        if (!find_events(&g) || !walk_roots(&g)) return FROE_E_LIMIT;
    } else if (at_start) { /* an instant alone */
        const meet_time at = {a, a};
        spans[worker->span_count++] = (meet_span){.begin = at, .end = at, .instant = true};
    }
    const int count = worker->span_count;
    for (int i = 0; i < count; i++) {
        spans[i].from_start = at_start && i == 0;
        spans[i].to_end = at_end && i == count - 1;
    }
    return FROE_OK;
}

/* -------------------------------------------------------------------- workers -- */

froe_status meet_worker_new(const froe_motion *m, meet_worker *out) {
    enum { SPARE_BITS = 64, CUT_BITS = 32, NUMBERS = 500, CHAINS = 4 };
    /* A turn is the product of two differences  (Xq Wp - Xp Wq):  coordinates once and times up to four times in each.
     */
    const size_t coordinate = m->top > m->unit ? (size_t)(m->top - m->unit) : 1;
    const size_t time = (size_t)(m->time_top - m->time_unit) + CUT_BITS;
    const size_t limbs = (2 * coordinate + 8 * time + SPARE_BITS) / 64 + 3;
    *out = (meet_worker){.span_count = 0};
    return num_arena_reserve(&m->alloc, &out->arena,
                             NUMBERS * limbs + CHAINS * num_poly_arena(limbs, NUM_FRACTION_LIMBS));
}

void meet_worker_free(const froe_motion *m, meet_worker *worker) {
    num_arena_free(&m->alloc, &worker->arena);
}
