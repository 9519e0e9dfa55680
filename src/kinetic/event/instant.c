/* instant.c: the time of an event, between two neighbouring doubles.
 *
 *     early        f > 0                The certificate holds just after one odd tick and does not after the next. It
 *     ---|-------o---------|---- t      is a polynomial in between, so halving with its exact signs closes in on
 *       u-2      : f <= 0  u            a root, until no double is left inside. */
#include "base/floats.h"
#include "kinetic/kinetic.h"
#include "support/fail.h"
#include <math.h>

enum { HALVINGS = 200 };

/* p(numerator / 2^bits) */
static int sign_at(num_arena *arena, const poly_exact *p, num_dyadic s) {
    num_dyadic y = p->c[p->degree];
    for (int i = p->degree - 1; i >= 0; i--) y = num_dyadic_add(arena, num_dyadic_mul(arena, y, s), p->c[i]);
    return y.sign;
}

/* The time s ticks after a tick, rounded down (side 0) or up (side 1). */
static double time_beside(const now_state *now, num_arena *arena, int64_t tick, num_dyadic s, int side) {
    const froe_motion *m = now->motion;
    const num_dyadic ticks = num_dyadic_add(arena, num_dyadic_scaled(arena, 1, (uint64_t)tick, 0), s);
    const num_dyadic since = num_dyadic_mul(arena, ticks, num_dyadic_scaled(arena, 1, 1, m->power));
    const num_dyadic time = num_dyadic_add(arena, num_dyadic_from(arena, m->begin), since);
    const double t = num_dyadic_quotient(arena, time, num_dyadic_scaled(arena, 1, 1, 0));
    const int way = side ? 1 : -1, off = num_dyadic_compare(num_dyadic_from(arena, t), time);
    return off * way < 0 ? nextafter(t, way * (double)INFINITY) : t;
}

/* A step moves one end to the middle; the time of the other end is known. The arena holds the polynomial up to `top`;
 * what is above is for each step anew. */
static void narrow(now_state *now, const poly_exact *p, int64_t tick, double out[2]) {
    num_arena *arena = &now->context.arena;
    const size_t top = arena->top;
    uint64_t low = 0;
    int bits = 0; /* the root is in low / 2^bits .. (low + 2) / 2^bits */
    for (int i = 0; i < HALVINGS && nextafter(out[0], (double)INFINITY) < out[1] && low < UINT64_MAX / 4; i++) {
        arena->top = top;
        const num_dyadic middle = num_dyadic_scaled(arena, 1, low + 1, -bits);
        const int sign = sign_at(arena, p, middle);
        if (sign >= 0) out[0] = time_beside(now, arena, tick, middle, 0);
        if (sign <= 0) out[1] = time_beside(now, arena, tick, middle, 1);
        if (!sign) break;
        low = 2 * low + (sign > 0 ? 2 : 0);
        bits++;
    }
}

static void refine(froe_kinetic *k, now_claim claim, double out[2]) {
    num_arena *arena = &k->now.context.arena;
    const int64_t tick = k->now.tick, before = tick - 2;
    poly_exact p;
    if (claim.p.b != NAME_SEGMENT && now_holds(&k->now, &claim) > 0) claim = (now_claim){claim.q, claim.p, 0};
    k->now.tick = before;
    if (before > 0 && now_holds(&k->now, &claim) > 0) {
        int axis = now_claim_axis(&k->now, &claim);
        now_claim_exact(&k->now, &claim, axis, &p);
        int end = sign_at(arena, &p, num_dyadic_scaled(arena, 1, 2, 0));
        if (exact_sign(&p) > 0 && end <= 0) narrow(&k->now, &p, before, out);
    }
    k->now.tick = tick;
}

froe_status froe_kinetic_instant(froe_kinetic *k, double out[2], froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!k || !out) return support_fail_null(diag, __func__);
    if (k->touch.reporting) {
        out[0] = k->touch.first.begin[0], out[1] = k->touch.first.begin[1];
        return FROE_OK;
    }
    if (!k->events.reporting) return support_fail(diag, FROE_E_ARG, "No event is being reported.");
    now_catch_up(&k->now);
    num_arena *arena = &k->now.context.arena;
    arena->top = 0;
    const int64_t before = k->now.tick > 2 ? k->now.tick - 2 : 0;
    double bracket[2];
    for (int side = 0; side < 2; side++) {
        const int64_t tick = side ? k->now.tick : before;
        bracket[side] = time_beside(&k->now, arena, tick, (num_dyadic){0}, side);
    }
    if (k->events.reported.q.b != NAME_NONE) refine(k, k->events.reported, bracket);
    out[0] = bracket[0], out[1] = bracket[1];
    return FROE_OK;
}
