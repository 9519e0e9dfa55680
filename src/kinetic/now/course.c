/* course.c: pieces of flight plans in doubles, each looked up when it is asked for. They begin at the first tick of the
 * piece, so that no number depends on what was asked before.
 *
 * Positions, times 2^lift, are x[0] + x[1] s + x[2] s^2 + x[3] s^3 for s from 0 to span, and nowhere further off than
 * `error`. */
#include "kinetic/now/now.h"
#include <math.h>

/* The coefficients in doubles, and what is lost by that until s = span. */
static double in_doubles(const num_ball p[MOTION_TERMS], int degree, num_ball w, double span,
                         double out[MOTION_TERMS]) {
    double error = 0, size = 0, power = 1;
    for (int i = 0; i < MOTION_TERMS; i++, power *= span) {
        num_ball c = i <= degree ? now_divide(p[i], w) : num_ball_from(0);
        out[i] = c.x;
        error += c.e * power;
        size += fabs(c.x) * power;
    }
    return (error + size * 0x1p-50) * NUM_BALL_UP + NUM_BALL_TINY;
}

/* A piece, and room for what it refers to. */
typedef struct lifted_piece {
    motion_piece piece;
    motion_knot knot[2];
    double second[3];
} lifted_piece;

static void lift_piece(const now_state *now, const motion_piece *piece, lifted_piece *out) {
    out->piece = *piece;
    out->knot[0] = *piece->from, out->knot[1] = *piece->to;
    for (int k = 0; k < now->motion->dim; k++) {
        out->knot[0].at[k] = now_lifted(now, piece->from->at[k]);
        if (piece->degree > 1) out->knot[0].control[k] = now_lifted(now, piece->from->control[k]);
        out->knot[1].at[k] = now_lifted(now, piece->to->at[k]);
        if (piece->second) out->second[k] = now_lifted(now, piece->second[k]);
    }
    out->piece.from = out->knot, out->piece.to = out->knot + (piece->to != piece->from);
    if (piece->second) out->piece.second = out->second;
}

static double span_of(const now_course *c) {
    return (double)(c->last - c->base);
}

/* The piece that the present tick belongs to: most often the next one. */
static motion_piece find_piece(const now_state *now, uint32_t vertex) {
    const froe_motion *m = now->motion;
    const now_course *c = now->courses.data + vertex;
    const motion_piece *last = &now->bends.data[vertex].piece;
    if (c->base <= c->last && last->last < now->tick && !last->corner) { /* it was looked up, and has ended */
        const size_t first = m->plans.data[vertex].first;
        const motion_piece next = motion_piece_after(m, vertex, (uint32_t)(last->to - (m->knots.data + first)));
        if (now->tick <= next.last) return next;
    }
    return motion_piece_at(m, vertex, now->tick);
}

/* Of a piece, within the window of the motion. Before a plan begins nothing holds but at the present tick. */
static int64_t first_tick(const now_state *now, const motion_piece *piece) {
    const int64_t first = piece->degree && piece->from->tick > 0 ? piece->from->tick : 0;
    return first < now->tick ? first : now->tick;
}

void now_look_up(now_state *now, uint32_t vertex) {
    const froe_motion *m = now->motion;
    now_course *c = now->courses.data + vertex;
    now_bend *bend = now->bends.data + vertex;
    bend->piece = find_piece(now, vertex);
    c->last = bend->piece.last < m->last_tick ? bend->piece.last : m->last_tick | 1;
    c->base = first_tick(now, &bend->piece);
    c->degree = (uint32_t)bend->piece.degree;
    if (bend->piece.corner) {
        *c = (now_course){.base = c->base, .last = c->last, .degree = NOW_TURNING};
        bend->tick = INT64_MIN;
        return;
    }
    motion_ball_curve p;
    const int degree = bend->piece.degree;
    double x[MOTION_TERMS], y[MOTION_TERMS];
    lifted_piece lifted;
    lift_piece(now, &bend->piece, &lifted);
    motion_curve_ball(m, &lifted.piece, c->base, &p);
    const double ex = in_doubles(p.x, degree, p.w, span_of(c), x), ey = in_doubles(p.y, degree, p.w, span_of(c), y);
    if (m->dim == 3) bend->error = in_doubles(p.z, degree, p.w, span_of(c), bend->z);
    for (int i = 0; i < 2; i++) c->x[i] = x[i], c->y[i] = y[i], bend->x[i] = x[2 + i], bend->y[i] = y[2 + i];
    c->error = ex > ey ? ex : ey;
    if (!(c->error < (double)INFINITY)) c->error = (double)INFINITY;
}

int64_t now_course_last(now_state *now, uint32_t vertex) {
    return now_course_of(now, vertex)->last;
}

now_spot now_bent_spot(now_state *now, uint32_t vertex) {
    const now_course *c = now->courses.data + vertex;
    const now_bend *b = now->bends.data + vertex;
    if (c->degree == NOW_TURNING) return now_turning_spot(now, vertex);
    const double s = (double)(now->tick - c->base), bend[2] = {b->x[0] + s * b->x[1], b->y[0] + s * b->y[1]};
    return (now_spot){c->x[0] + s * (c->x[1] + s * bend[0]), c->y[0] + s * (c->y[1] + s * bend[1]), c->error};
}

double now_bent_speed(now_state *now, uint32_t vertex) {
    const now_course *c = now->courses.data + vertex;
    const now_bend *bend = now->bends.data + vertex;
    if (c->degree == NOW_TURNING) return now_turning_speed(now, vertex);
    double x = fabs(c->x[1]), y = fabs(c->y[1]), s = span_of(c);
    for (uint32_t i = 0; i + 2 <= c->degree; i++, s *= span_of(c))
        x += (i + 2) * s * fabs(bend->x[i]), y += (i + 2) * s * fabs(bend->y[i]);
    return (x > y ? x : y) * (1 + 0x1p-20);
}

void now_exact_at(now_state *now, uint32_t vertex, exact_point *out) {
    now_course_of(now, vertex);
    exact_vertex_at(&now->context.arena, now->motion, &now->bends.data[vertex].piece, now->tick, out);
}

void now_exact_along(now_state *now, uint32_t vertex, exact_point *out) {
    now_course_of(now, vertex);
    exact_vertex(&now->context.arena, now->motion, &now->bends.data[vertex].piece, now->tick, out);
}

bool now_round(now_state *now, uint32_t vertex, double *out) {
    num_arena *arena = &now->context.arena;
    arena->top = 0;
    exact_point e;
    bool exact = true;
    now_exact_at(now, vertex, &e);
    for (int i = 0; i < now->motion->dim; i++) {
        num_dyadic x = i == 2 ? e.z.c[0] : i ? e.y.c[0] : e.x.c[0];
        out[i] = num_dyadic_quotient(arena, x, e.w.c[0]);
        num_dyadic back = num_dyadic_mul(arena, num_dyadic_from(arena, out[i]), e.w.c[0]);
        exact &= !num_dyadic_compare(x, back);
    }
    return exact;
}
