/* near.c: claims as polynomials in doubles. Half a unit in the last place is 2^-53. Each bound counts the roundings of
 * its formula and rounds up to a power of two, which leaves room for those of the bounds themselves. */
#include "kinetic/now/near.h"
#include "kinetic/now/turning.h"

/* -------------------------------------------------------------- polynomials -- */

static void constant(double x, near_poly *out) {
    *out = (near_poly){.size = fabs(x), .c = {x}};
}

/* Without the room for higher degrees. */
static void copy(const near_poly *p, near_poly *out) {
    out->degree = p->degree, out->size = p->size, out->error = p->error;
    for (int i = 0; i <= p->degree; i++) out->c[i] = p->c[i];
}

/* One rounding a coefficient. */
static void subtract(const near_poly *a, const near_poly *b, near_poly *out) {
    const int both = a->degree < b->degree ? a->degree : b->degree;
    double size = 0;
    out->degree = a->degree + b->degree - both;
    for (int i = 0; i <= both; i++) size += fabs(out->c[i] = a->c[i] - b->c[i]);
    for (int i = both + 1; i <= a->degree; i++) size += fabs(out->c[i] = a->c[i]);
    for (int i = both + 1; i <= b->degree; i++) size += fabs(out->c[i] = -b->c[i]);
    out->size = size;
    out->error = a->error + b->error + size * 0x1p-52;
}

/* Sums of up to seven products. */
static void multiply(const near_poly *a, const near_poly *b, near_poly *out) {
    out->degree = a->degree + b->degree;
    for (int i = 0; i <= out->degree; i++) out->c[i] = 0;
    for (int i = 0; i <= a->degree; i++)
        for (int j = 0; j <= b->degree; j++) out->c[i + j] += a->c[i] * b->c[j];
    out->size = a->size * b->size;
    out->error = out->size * 0x1p-49 + (a->size * b->error + a->error * b->size + a->error * b->error) + NUM_BALL_TINY;
}

/* a d - b c */
static void determinant(const near_poly *a, const near_poly *b, const near_poly *c, const near_poly *d,
                        near_poly *out) {
    near_poly ad, bc;
    multiply(a, d, &ad);
    multiply(b, c, &bc);
    subtract(&ad, &bc, out);
}

static void negate(near_poly *p) {
    for (int i = 0; i <= p->degree; i++) p->c[i] = -p->c[i];
}

/* ------------------------------------------------------------------- places -- */

/* x and y. */
typedef struct near_point {
    near_poly at[2];
} near_point;

/* As place_vertex(). */
static void place_on_cubic(now_state *now, uint32_t vertex, double span, near_point *out) {
    const now_course *c = now->courses.data + vertex;
    const now_bend *bend = now->bends.data + vertex;
    const double s = (double)(now->tick - c->base), *const x[2] = {c->x, c->y}, *const b[2] = {bend->x, bend->y};
    for (int i = 0; i < 2; i++) {
        near_poly *p = out->at + i;
        p->degree = 3;
        p->c[0] = x[i][0] + s * (x[i][1] + s * (b[i][0] + s * b[i][1]));
        p->c[1] = (x[i][1] + s * (2 * b[i][0] + 3 * s * b[i][1])) * span;
        p->c[2] = (b[i][0] + 3 * s * b[i][1]) * span * span;
        p->c[3] = b[i][1] * span * span * span;
        p->size = fabs(p->c[0]) + fabs(p->c[1]) + fabs(p->c[2]) + fabs(p->c[3]);
        p->error = 2 * c->error;
    }
}

/* Of what rounding adds there is less than the error of the course once more. */
static void place_vertex(now_state *now, uint32_t vertex, double span, near_point *out) {
    const now_course *c = now_course_of(now, vertex);
    const double s = (double)(now->tick - c->base), *const x[2] = {c->x, c->y};
    double b[2] = {0, 0};
    if (c->degree > 2) {
        place_on_cubic(now, vertex, span, out);
        return;
    }
    if (c->degree > 1) b[0] = now->bends.data[vertex].x[0], b[1] = now->bends.data[vertex].y[0];
    for (int i = 0; i < 2; i++) {
        near_poly *p = out->at + i;
        p->degree = (int)c->degree;
        p->c[0] = x[i][0] + s * (x[i][1] + s * b[i]);
        p->c[1] = (x[i][1] + 2 * s * b[i]) * span;
        p->c[2] = b[i] * span * span;
        p->size = fabs(p->c[0]) + fabs(p->c[1]) + fabs(p->c[2]);
        p->error = 2 * c->error;
    }
}

static void step_between(const near_point *p, const near_point *q, near_point *out) {
    for (int i = 0; i < 2; i++) subtract(q->at + i, p->at + i, out->at + i);
}

static void turn_between(const near_point *d, const near_point *e, near_poly *out) {
    determinant(d->at, d->at + 1, e->at, e->at + 1, out);
}

/* How the line of a segment turns to a vertex: > 0 on its left. */
static void turn_to(now_state *now, const uint32_t end[2], uint32_t vertex, double span, near_poly *out) {
    near_point a, b, q, d, e;
    place_vertex(now, end[0], span, &a), place_vertex(now, end[1], span, &b), place_vertex(now, vertex, span, &q);
    step_between(&a, &b, &d), step_between(&a, &q, &e);
    turn_between(&d, &e, out);
}

/* A point in one coordinate: base + off / turn; of a vertex base alone. */
typedef struct near_name {
    near_poly base, off, turn;
    bool crossing;
} near_name;

static void lines_turn(now_state *now, name_point p, double span, near_point v[4], near_point step[2], near_poly *out) {
    const uint32_t *s = now->segments.data[p.a].end, *t = now->segments.data[p.b].end;
    for (int i = 0; i < 4; i++) place_vertex(now, i < 2 ? s[i] : t[i - 2], span, v + i);
    for (int i = 0; i < 2; i++) step_between(v + 2 * i, v + 2 * i + 1, step + i);
    turn_between(step, step + 1, out);
}

static void find_named(now_state *now, name_point p, int axis, double span, near_name *out) {
    near_point v[4], step[2], between;
    near_poly shift;
    out->crossing = name_is_crossing(p);
    if (!out->crossing) {
        place_vertex(now, p.a, span, v);
        copy(v->at + axis, &out->base);
        return;
    }
    lines_turn(now, p, span, v, step, &out->turn);
    step_between(v, v + 2, &between);
    turn_between(&between, step + 1, &shift);
    multiply(&shift, step->at + axis, &out->off);
    copy(v->at + axis, &out->base);
}

/* ------------------------------------------------------------------- claims -- */

static void times_turn(const near_name *p, near_poly *value) {
    near_poly was;
    if (!p->crossing) return;
    copy(value, &was);
    multiply(&was, &p->turn, value);
}

/* (q - p) times both denominators:  (q0 - p0) p_turn q_turn + q_off p_turn - p_off q_turn. */
static void find_order(now_state *now, const now_claim *claim, int axis, double span, near_claim *out) {
    const name_point name[2] = {claim->p, claim->q};
    near_name p[2];
    near_poly off[2], sum;
    for (int i = 0; i < 2; i++) find_named(now, name[i], axis, span, p + i);
    subtract(&p[1].base, &p[0].base, &out->value);
    for (int i = 0; i < 2; i++) {
        times_turn(p + i, &out->value);
        if (!p[i].crossing) continue;
        copy(&p[i].off, off + i), copy(&p[i].turn, out->turn + i), out->has_turn[i] = true;
        times_turn(p + (1 - i), off + i);
    }
    for (int i = 0; i < 2; i++) {
        if (!p[i].crossing) continue;
        if (i) negate(off + i);
        copy(&out->value, &sum);
        subtract(&sum, off + i, &out->value);
    }
    int sign = 1;
    for (int i = 0; i < 2 && sign; i++)
        if (p[i].crossing) sign *= near_sign_at(&p[i].turn, 0);
    if (!sign) sign = now_judge_denominators(now, claim);
    if (sign < 0) negate(&out->value);
}

/* How a line turns to the two ends of a segment that it crosses at p, or at the end p; see along.c. */
static void turns_along(now_state *now, uint32_t segment, name_point p, double span, near_poly out[2]) {
    const uint32_t *end = now->segments.data[segment].end;
    for (int i = 0; i < 2; i++) {
        if (name_is_vertex(p))
            constant((end[0] == p.a) == i, out + i);
        else
            turn_to(now, now->segments.data[p.a == segment ? (uint32_t)p.b : p.a].end, end[i], span, out + i);
    }
}

static void find_along(now_state *now, const now_claim *claim, double span, near_poly *out) {
    const uint32_t s = now_shared(now, claim->p, claim->q);
    near_poly p[2], q[2];
    turns_along(now, s, claim->p, span, p);
    turns_along(now, s, claim->q, span, q);
    determinant(p, p + 1, q, q + 1, out);
    int sign = near_sign_at(out, 0);
    if (!sign) sign = now_along_sign(now, claim);
    if (sign < 0) negate(out);
}

/* |x| < 2^this, x != 0. */
static int top_of(num_dyadic x) {
    return 64 * (x.exponent + (int)x.count) - __builtin_clzll(x.limbs[x.count - 1]);
}

/* The exact polynomial in doubles, times a power of two that makes its largest term about 1. What is too small for a
 * double beside that is far below the error. */
static void round_exact(num_arena *arena, const poly_exact *p, double span, near_poly *out) {
    int top = INT32_MIN, wide;
    frexp(span, &wide);
    for (int i = 0; i <= p->degree; i++)
        if (p->c[i].sign && top_of(p->c[i]) + i * wide > top) top = top_of(p->c[i]) + i * wide;
    const num_dyadic one = num_dyadic_scaled(arena, 1, 1, 0);
    double power = 1;
    *out = (near_poly){.degree = p->degree};
    for (int i = 0; i <= p->degree; i++, power *= span) {
        if (p->c[i].sign)
            out->c[i] = power * num_dyadic_quotient(
                                    arena, num_dyadic_mul(arena, p->c[i], num_dyadic_scaled(arena, 1, 1, -top)), one);
        out->size += fabs(out->c[i]);
    }
    out->size *= 1 + 0x1p-40;
    out->error = out->size * 0x1p-46 + 0x1p-400; /* a product and up to fifteen of powers */
}

static void find_turning(now_state *now, const now_claim *claim, int axis, double span, near_poly *out) {
    poly_exact exact;
    if (near_find_turning(now, claim, axis, span, out)) return;
    now_claim_exact(now, claim, axis, &exact);
    round_exact(&now->context.arena, &exact, span, out);
}

void near_find(now_state *now, const now_claim *claim, int axis, double span, near_claim *out) {
    out->has_turn[0] = out->has_turn[1] = false;
    if (now_is_turning_claim(now, claim)) {
        find_turning(now, claim, axis, span, &out->value);
        return;
    }
    if (claim->q.b == NAME_NONE) {
        near_point v[4], step[2];
        lines_turn(now, claim->p, span, v, step, &out->value);
    } else if (claim->p.b == NAME_SEGMENT) {
        const uint32_t end[2] = {now_vertex(now, claim->p.a, 0), now_vertex(now, claim->p.a, 1)};
        turn_to(now, end, claim->q.a, span, &out->value);
    } else if (claim->above == NOW_ALONG) {
        find_along(now, claim, span, &out->value);
        return;
    } else {
        find_order(now, claim, axis, span, out);
        return;
    }
    if (claim->above < 0) negate(&out->value);
}
