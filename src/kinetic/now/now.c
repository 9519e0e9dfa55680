/* now.c: places, order and sides just after a tick: in doubles with error bounds, then exactly. */
#include "kinetic/now/now.h"
#include "geom/selftest.h"
#include "kinetic/now/turning.h"
#include <math.h>

froe_status now_new(froe_motion *motion, const froe_allocator *alloc, now_state *out) {
    now_state now = {.motion = motion, .duration = ldexp(1, motion->power)};
    froe_status status = geom_context_new(alloc, &now.context);
    if (status) return status;
    now.memories = support_calloc(&now.context.alloc, NOW_MEMORIES, sizeof *now.memories);
    now.points = support_calloc(&now.context.alloc, 1, sizeof *now.points);
    if (!now.memories || !now.points || num_arena_reserve(&now.context.alloc, &now.context.arena, POLY_LIMBS) ||
        now_grow(&now)) {
        now_free(&now);
        return FROE_E_MEMORY;
    }
    *out = now;
    return FROE_OK;
}

void now_free(now_state *now) {
    const froe_allocator *alloc = &now->context.alloc;
    array_free(alloc, &now->courses);
    array_free(alloc, &now->bends);
    array_free(alloc, &now->segments);
    array_free(alloc, &now->faces);
    support_free(alloc, now->memories, NOW_MEMORIES * sizeof *now->memories);
    support_free(alloc, now->points, sizeof *now->points);
    num_context_free(&now->context);
}

static void forget(now_state *now) {
    for (size_t v = 0; v < now->courses.count; v++) now->courses.data[v].base = 0, now->courses.data[v].last = -1;
    for (size_t i = 0; i < NOW_MEMORIES; i++) now->memories[i].tick = -1;
    now->edition = now->motion->edition;
    now->lift = now->motion->top == INT16_MIN ? 0 : NOW_TOP - now->motion->top;
    const int first = now->lift < 600 ? now->lift : 600;
    now->lifts[0] = ldexp(1, first), now->lifts[1] = ldexp(1, now->lift - first);
}

void now_catch_up(now_state *now) {
    if (now->edition != now->motion->edition) forget(now);
}

froe_status now_grow(now_state *now) {
    const froe_allocator *alloc = &now->context.alloc;
    const froe_motion *m = now->motion;
    if (!array_reserve(alloc, &now->courses, m->plans.count + 2 - now->courses.count) ||
        !array_reserve(alloc, &now->bends, m->plans.count + 2 - now->bends.count))
        return FROE_E_MEMORY;
    now->courses.count = now->bends.count = m->plans.count + 2;
    forget(now);
    if (m->dim == 3) return now_grow_faces(now);
    if (!array_reserve(alloc, &now->segments, m->objects.count + 1 - now->segments.count)) return FROE_E_MEMORY;
    for (size_t s = now->segments.count ? now->segments.count - 1 : 0; s < m->objects.count; s++) {
        const uint32_t *v = m->objects.data[s].vertices;
        now->segments.data[s] = (now_segment){{v[0], v[1]}, (uint32_t)s, false, false};
    }
    now->segments.count = m->objects.count + 1;
    return FROE_OK;
}

/* Both points of the segment stand still for ever. */
uint32_t now_ask(now_state *now, const double *from, const double *to) {
    uint32_t segment = (uint32_t)now->segments.count - 1, first = (uint32_t)now->courses.count - 2;
    for (uint32_t i = 0; i < 2; i++) {
        const double *at = i ? to : from;
        double place[3] = {0, 0, 0};
        bool finite = true; /* it may be far away from all that moves */
        motion_knot *knot = now->asked + i;
        *knot = (motion_knot){.control = {(double)NAN, (double)NAN}, .second = FROE_NONE};
        for (int k = 0; k < now->motion->dim; k++) {
            knot->at[k] = at[k];
            place[k] = now_lifted(now, at[k]);
            finite = finite && isfinite(place[k]);
        }
        for (int k = 0; k < 3 && !finite; k++) place[k] = 0;
        const double error = finite ? NUM_BALL_TINY : (double)INFINITY;
        now->courses.data[first + i] =
            (now_course){.last = INT64_MAX, .x = {place[0]}, .y = {place[1]}, .error = error};
        now->bends.data[first + i] =
            (now_bend){.z = {place[2]}, .error = error, .piece = {.from = knot, .to = knot, .last = MOTION_FAR}};
    }
    now_segment *s = now->segments.data + segment;
    *s = (now_segment){{first, first + 1}, segment, false, false};
    s->turned = now_compare(now, (name_point){first, NAME_VERTEX}, (name_point){first + 1, NAME_VERTEX}) > 0;
    return segment;
}

/* ------------------------------------------------------------------ places -- */

typedef struct ball2 {
    num_ball x, y;
} ball2;

static ball2 vertex_ball(now_state *now, uint32_t vertex) {
    now_spot s = now_vertex_spot(now, vertex);
    return (ball2){{s.x, s.error}, {s.y, s.error}};
}

static ball2 minus(ball2 a, ball2 b) {
    return (ball2){num_ball_sub(a.x, b.x), num_ball_sub(a.y, b.y)};
}

static num_ball cross_balls(ball2 a, ball2 b) {
    return num_ball_sub(num_ball_mul(a.x, b.y), num_ball_mul(a.y, b.x));
}

void now_exact_named(now_state *now, name_point p, bool along, exact_point *out) {
    exact_point v[4];
    const bool vertex = p.b == NAME_VERTEX;
    now->context.arena.top = 0;
    if (now_is_turning_name(now, p)) {
        uint32_t end[4];
        const int count = now_vertices_of(now, p, end);
        now_turning_point(now, end, count, along, out);
        return;
    }
    for (int i = 0; i < (vertex ? 1 : 4); i++) {
        const uint32_t end = vertex ? p.a : now->segments.data[i < 2 ? p.a : (uint32_t)p.b].end[i % 2];
        if (along)
            now_exact_along(now, end, v + i);
        else
            now_exact_at(now, end, v + i);
    }
    if (vertex)
        *out = v[0];
    else
        exact_crossing(&now->context.arena, v, out);
}

static num_dyadic power_of_two(num_arena *arena, int power) {
    return num_dyadic_scaled(arena, 1, 1, power);
}

static now_spot crossing_spot(now_state *now, name_point p) {
    const uint32_t *s = now->segments.data[p.a].end, *t = now->segments.data[p.b].end;
    ball2 a = vertex_ball(now, s[0]), d = minus(vertex_ball(now, s[1]), a);
    ball2 c = vertex_ball(now, t[0]), e = minus(vertex_ball(now, t[1]), c);
    num_ball turn = cross_balls(d, e), shift = cross_balls(minus(c, a), e);
    if (turn.x < 0) turn.x = -turn.x, shift.x = -shift.x;
    num_ball share = now_divide(shift, turn);
    num_ball x = num_ball_add(a.x, num_ball_mul(share, d.x)), y = num_ball_add(a.y, num_ball_mul(share, d.y));
    double error = x.e > y.e ? x.e : y.e, size = fabs(d.x.x) + fabs(d.y.x);
    if (error < size * 0x1p-20 && isfinite(x.x) && isfinite(y.x)) return (now_spot){x.x, y.x, error};
    num_arena *arena = &now->context.arena; /* rounded from exact numbers, where the filter says little */
    exact_point exact;
    now_exact_named(now, p, false, &exact);
    const num_dyadic w = num_dyadic_mul(arena, exact.w.c[0], power_of_two(arena, -now->lift));
    if (!w.sign) return (now_spot){0, 0, (double)INFINITY};
    now_spot spot = {num_dyadic_quotient(arena, exact.x.c[0], w), num_dyadic_quotient(arena, exact.y.c[0], w), 0};
    spot.error = (fabs(spot.x) + fabs(spot.y)) * 0x1p-52 + NUM_BALL_TINY;
    return spot;
}

now_spot now_crossing_spot(now_state *now, name_point p) {
    if (now_is_question(now, (uint32_t)p.b)) return crossing_spot(now, p);
    uint64_t hash = ((uint64_t)p.a << 32 | (uint32_t)p.b) * 0x9e3779b97f4a7c15u;
    now_memory *known = now->memories + (hash >> (64 - NOW_MEMORY_BITS));
    if (known->tick != now->tick || !name_is(known->name, p))
        *known = (now_memory){p, now->tick, crossing_spot(now, p)};
    return known->spot;
}

/* ------------------------------------------------------------------- order -- */

/* Do two vertices have the same x for as long as their pieces last? */
static bool is_above_for_good(now_state *now, uint32_t p, uint32_t q) {
    const motion_piece *a = &now->bends.data[p].piece, *b = &now->bends.data[q].piece;
    if (a->corner || b->corner) return false; /* exact numbers tell */
    if (a->degree != b->degree || a->from->at[0] != b->from->at[0] || a->to->at[0] != b->to->at[0]) return false;
    if (!a->degree) return true;
    if (a->from->time != b->from->time || a->to->time != b->to->time) return false;
    if (a->degree > 1 && a->from->control[0] != b->from->control[0]) return false;
    return a->degree < 3 || a->second[0] == b->second[0];
}

/* A point on the line is behind it. */
static int compare_to_line(now_state *now, name_point p, double line) {
    now_spot spot = now_spot_of(now, p);
    double d = spot.x - line, error = spot.error + fabs(d) * 0x1p-52;
    if (fabs(d) > error) return d < 0 ? -1 : 1;
    num_arena *arena = &now->context.arena;
    exact_point e;
    now_exact_named(now, p, false, &e);
    if (!e.w.c[0].sign) return now->lost = true, 1;
    num_dyadic at = num_dyadic_mul(arena, num_dyadic_from(arena, line), power_of_two(arena, -now->lift));
    at = num_dyadic_mul(arena, at, e.w.c[0]);
    int sign = num_dyadic_compare(e.x.c[0], at) * e.w.c[0].sign;
    return sign < 0 ? -1 : 1;
}

int now_compare(now_state *now, name_point p, name_point q) {
    now->context.stats.calls++;
    if (name_is(p, q)) return 0;
    if (p.b == NAME_LINE && q.b == NAME_LINE) return now->line[p.a] < now->line[q.a] ? -1 : 1;
    if (q.b == NAME_LINE) return compare_to_line(now, p, now->line[q.a]);
    if (p.b == NAME_LINE) return -compare_to_line(now, q, now->line[p.a]);
    now_spot a = now_spot_of(now, p), b = now_spot_of(now, q);
    const int quick = now_order_of_spots(a, b);
    if (quick != NUM_UNSURE) return quick;
    if (name_is_vertex(p) && name_is_vertex(q) && is_above_for_good(now, p.a, q.a)) {
        const double d = a.y - b.y, error = (a.error + b.error + fabs(d) * 0x1p-52) * NUM_BALL_UP;
        now->tied = true;
        if (fabs(d) > error) return d < 0 ? -1 : 1;
    }
    now->context.stats.exact++;
    int order = now_judge_order(now, p, q, false, false); /* at the tick, or else just after it */
    if (order != POLY_PARALLEL && order) return order;
    now->tied = true;
    order = now_judge_order(now, p, q, true, true);
    if (order == POLY_PARALLEL) now->lost = true, order = 1;
    return order;
}

int now_side(now_state *now, uint32_t segment, uint32_t vertex) {
    uint32_t u = now_vertex(now, segment, 0), v = now_vertex(now, segment, 1);
    now->context.stats.calls++;
    if (vertex == u || vertex == v) return 0;
    int quick = now_side_of_spots(now_vertex_spot(now, u), now_vertex_spot(now, v), now_vertex_spot(now, vertex));
    if (quick != NUM_UNSURE) return quick;
    ball2 a = vertex_ball(now, u), d = minus(vertex_ball(now, v), a);
    int sign = num_ball_sign(cross_balls(d, minus(vertex_ball(now, vertex), a)));
    if (sign == 1 || sign == -1) return sign;
    now->context.stats.exact++;
    sign = now_judge_side(now, segment, vertex, false);
    now->tied |= !sign;
    return sign ? sign : now_judge_side(now, segment, vertex, true);
}

/* ------------------------------------------------------------------ claims -- */

/* Of a crossing's lines, just after the tick: see now_claim. 0: parallel for as long as the pieces last. */
static int lines_turn(now_state *now, name_point crossing) {
    const uint32_t *s = now->segments.data[crossing.a].end, *t = now->segments.data[crossing.b].end;
    ball2 d = minus(vertex_ball(now, s[1]), vertex_ball(now, s[0]));
    ball2 e = minus(vertex_ball(now, t[1]), vertex_ball(now, t[0]));
    int sign = num_ball_sign(cross_balls(d, e));
    if (sign == 1 || sign == -1) return sign;
    sign = now_judge_lines(now, crossing, false);
    return sign ? sign : now_judge_lines(now, crossing, true);
}

int now_holds(now_state *now, const now_claim *claim) {
    if (claim->q.b == NAME_NONE) return lines_turn(now, claim->p) * claim->above;
    if (claim->p.b == NAME_SEGMENT) return now_side(now, claim->p.a, claim->q.a) * claim->above;
    if (claim->above == NOW_ALONG) return now_along_holds(now, claim);
    return now_compare(now, claim->p, claim->q) < 0 ? 1 : -1;
}

int now_claim_axis(now_state *now, const now_claim *claim) {
    if (claim->p.b == NAME_SEGMENT || claim->q.b == NAME_NONE || claim->above == NOW_ALONG) return 0;
    poly_wide wide;
    if (now_claim_wide(now, claim, 0, 0, &wide)) return !wide_sign(&wide);
    poly_exact p;
    now_claim_exact(now, claim, 0, &p);
    return !exact_sign(&p);
}
