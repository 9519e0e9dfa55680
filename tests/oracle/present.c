/* present.c: see present.h. */
#include "oracle/present.h"
#include <math.h>
#include <stdlib.h>

enum { QUERY_BITS = 40 };

/* --------------------------------------------------------------------- numbers -- */

static void germ_init(germ *a) {
    a->d = a->e = 0;
    for (int j = 0; j < GERM_E; j++)
        for (int i = 0; i < GERM_D; i++) mpz_init(a->c[j][i]);
}

static void germ_clear(germ *a) {
    for (int j = 0; j < GERM_E; j++)
        for (int i = 0; i < GERM_D; i++) mpz_clear(a->c[j][i]);
}

static int germ_sign(const germ *a) {
    for (int j = 0; j <= a->e; j++)
        for (int i = 0; i <= a->d; i++)
            if (mpz_sgn(a->c[j][i])) return mpz_sgn(a->c[j][i]);
    return 0;
}

static void germ_zero(germ *a, int d, int e) {
    if (d >= GERM_D || e >= GERM_E) abort();
    a->d = d, a->e = e;
    for (int j = 0; j <= e; j++)
        for (int i = 0; i <= d; i++) mpz_set_ui(a->c[j][i], 0);
}

/* out += sign a e^shift */
static void germ_accumulate(germ *out, int sign, const germ *a, int shift) {
    if (a->d > out->d || a->e + shift > out->e) abort();
    for (int j = 0; j <= a->e; j++)
        for (int i = 0; i <= a->d; i++) {
            mpz_t *to = &out->c[j + shift][i];
            if (sign > 0)
                mpz_add(*to, *to, a->c[j][i]);
            else
                mpz_sub(*to, *to, a->c[j][i]);
        }
}

/* out += sign a b e^shift */
static void germ_add_product(germ *out, int sign, const germ *a, const germ *b, int shift) {
    if (a->d + b->d > out->d || a->e + b->e + shift > out->e) abort();
    for (int j = 0; j <= a->e; j++)
        for (int i = 0; i <= a->d; i++)
            for (int l = 0; l <= b->e; l++)
                for (int k = 0; k <= b->d; k++) {
                    mpz_t *to = &out->c[j + l + shift][i + k];
                    if (sign > 0)
                        mpz_addmul(*to, a->c[j][i], b->c[l][k]);
                    else
                        mpz_submul(*to, a->c[j][i], b->c[l][k]);
                }
}

static void germ_minus(germ *a) {
    for (int j = 0; j <= a->e; j++)
        for (int i = 0; i <= a->d; i++) mpz_neg(a->c[j][i], a->c[j][i]);
}

static void add_coefficient(mpz_t sum, int sign, const germ *a, const germ *b, int i, int j) {
    for (int l = 0; l <= a->e && l <= j; l++)
        for (int k = 0; k <= a->d && k <= i; k++) {
            if (j - l > b->e || i - k > b->d) continue;
            if (sign > 0)
                mpz_addmul(sum, a->c[l][k], b->c[j - l][i - k]);
            else
                mpz_submul(sum, a->c[l][k], b->c[j - l][i - k]);
        }
}

static int most(int a, int b) {
    return a > b ? a : b;
}

/* The sign of a b - c d, made no further than it takes. */
static int germ_det_sign(const germ *a, const germ *b, const germ *c, const germ *d) {
    mpz_t sum;
    mpz_init(sum);
    int sign = 0;
    for (int j = 0; j <= most(a->e + b->e, c->e + d->e) && !sign; j++)
        for (int i = 0; i <= most(a->d + b->d, c->d + d->d) && !sign; i++) {
            mpz_set_ui(sum, 0);
            add_coefficient(sum, 1, a, b, i, j);
            add_coefficient(sum, -1, c, d, i, j);
            sign = mpz_sgn(sum);
        }
    mpz_clear(sum);
    return sign;
}

/* a / b but for rounding, however long they are. */
static double quotient_near(const mpz_t a, const mpz_t b) {
    long up, down;
    const double top = mpz_get_d_2exp(&up, a), bottom = mpz_get_d_2exp(&down, b);
    return ldexp(top / bottom, (int)(up - down));
}

static void point_init(germ_point *p) {
    germ_init(&p->x), germ_init(&p->y), germ_init(&p->w);
}
static void point_clear(germ_point *p) {
    germ_clear(&p->x), germ_clear(&p->y), germ_clear(&p->w);
}

/* --------------------------------------------------------------- where it all is -- */

enum { TERMS = 4 };

/* A vertex as polynomials in the time since the instant: x[0] to x[3] and y[0], .. */
typedef struct flight {
    mpq_t c[2][TERMS];
} flight;

static void flight_init(flight *f) {
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < TERMS; i++) mpq_init(f->c[k][i]);
}
static void flight_clear(flight *f) {
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < TERMS; i++) mpq_clear(f->c[k][i]);
}

/* The point of two on a line of the parameter a + b d: (1 - a) p + a q, and what comes with d. p and q have one power
 * of d less than out. */
static void blend(mpq_t *out, mpq_t *p, mpq_t *q, const mpq_t a, const mpq_t b) {
    mpq_t step, term;
    mpq_init(step), mpq_init(term);
    for (int i = TERMS - 1; i >= 0; i--) {
        mpq_sub(step, q[i], p[i]);
        mpq_mul(term, step, a);
        mpq_add(out[i], p[i], term);
        if (!i) break;
        mpq_sub(step, q[i - 1], p[i - 1]);
        mpq_mul(term, step, b);
        mpq_add(out[i], out[i], term);
    }
    mpq_clear(step), mpq_clear(term);
}

/* The share of the way between two knots that has passed at a time, and by how much it grows. */
static void share_of(mpq_t share, mpq_t speed, double from, double to, double time) {
    mpq_t length;
    mpq_init(length);
    mpq_set_d(length, to), mpq_set_d(speed, from), mpq_sub(length, length, speed);
    mpq_set_d(share, time), mpq_sub(share, share, speed), mpq_div(share, share, length);
    mpq_inv(speed, length);
    mpq_clear(length);
}

/* De Casteljau's algorithm, with the share of the way as a polynomial of degree 1. `to` NULL: it stands still. */
static void fly_between(flight *f, const froe_moving_knot *from, const froe_moving_knot *to, double time) {
    const int degree = !to ? 0 : isnan(from->control[0]) ? 1 : isnan(from->second[0]) ? 2 : 3;
    mpq_t share, speed, p[TERMS][TERMS], next[TERMS];
    mpq_init(share), mpq_init(speed);
    for (int n = 0; n < TERMS; n++) {
        mpq_init(next[n]);
        for (int i = 0; i < TERMS; i++) mpq_init(p[n][i]);
    }
    if (to) share_of(share, speed, from->time, to->time, time);
    for (int k = 0; k < 2; k++) {
        for (int n = 0; n < TERMS; n++)
            for (int i = 0; i < TERMS; i++) mpq_set_ui(p[n][i], 0, 1);
        mpq_set_d(p[0][0], from->at[k]);
        if (degree > 1) mpq_set_d(p[1][0], from->control[k]);
        if (degree > 2) mpq_set_d(p[2][0], from->second[k]);
        if (degree) mpq_set_d(p[degree][0], to->at[k]);
        for (int n = degree; n > 0; n--)
            for (int j = 0; j < n; j++) {
                blend(next, p[j], p[j + 1], share, speed);
                for (int i = 0; i < TERMS; i++) mpq_set(p[j][i], next[i]);
            }
        for (int i = 0; i < TERMS; i++) mpq_set(f->c[k][i], p[0][i]);
    }
    for (int n = 0; n < TERMS; n++) {
        mpq_clear(next[n]);
        for (int i = 0; i < TERMS; i++) mpq_clear(p[n][i]);
    }
    mpq_clear(share), mpq_clear(speed);
}

/* out += sign a b, up to the square. */
static void add_series(mpq_t out[3], int sign, mpq_t a[3], mpq_t b[3]) {
    mpq_t term;
    mpq_init(term);
    for (int i = 0; i < 3; i++)
        for (int j = 0; i + j < 3; j++) {
            mpq_mul(term, a[i], b[j]);
            if (sign < 0) mpq_neg(term, term);
            mpq_add(out[i + j], out[i + j], term);
        }
    mpq_clear(term);
}

/* a /= b, up to the square, by long division. */
static void divide_series(mpq_t a[3], mpq_t b[3]) {
    mpq_t term;
    mpq_init(term);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < i; j++) {
            mpq_mul(term, a[j], b[i - j]);
            mpq_sub(a[i], a[i], term);
        }
        mpq_div(a[i], a[i], b[0]);
    }
    mpq_clear(term);
}

/* The turn by (w + i z)^2 / |w + i z|^2 as a complex number. */
static void turn_series(const froe_body_knot *from, const froe_body_knot *to, double time, mpq_t cosine[3],
                        mpq_t sine[3]) {
    mpq_t share, speed, step, square[3], q[2][3];
    mpq_init(share), mpq_init(speed), mpq_init(step);
    for (int i = 0; i < 3; i++) mpq_init(square[i]), mpq_init(q[0][i]), mpq_init(q[1][i]);
    if (to) share_of(share, speed, from->time, to->time, time);
    for (int k = 0; k < 2; k++) {
        mpq_set_d(q[k][0], from->turn[2 + k]);
        mpq_set_d(step, (to ? to : from)->turn[2 + k]);
        mpq_sub(step, step, q[k][0]);
        mpq_mul(q[k][1], step, speed);
        mpq_mul(step, step, share);
        mpq_add(q[k][0], q[k][0], step);
        add_series(square, 1, q[k], q[k]);
        add_series(cosine, k ? 1 : -1, q[k], q[k]);
    }
    for (int i = 0; i < 2; i++) add_series(sine, 1, q[0], q[1]);
    divide_series(cosine, square), divide_series(sine, square);
    for (int i = 0; i < 3; i++) mpq_clear(square[i]), mpq_clear(q[0][i]), mpq_clear(q[1][i]);
    mpq_clear(share), mpq_clear(speed), mpq_clear(step);
}

/* A place in a body, up to the square of the time since the instant. */
static void fly_in_body(flight *f, const froe_motion *m, uint32_t vertex, double time) {
    const uint32_t body = froe_motion_vertex_body(m, vertex);
    const size_t count = froe_motion_body_knot_count(m, body);
    size_t knot = 0;
    while (knot + 2 < count && froe_motion_body_knot(m, body, knot + 1).time <= time) knot++;
    const froe_body_knot from = froe_motion_body_knot(m, body, knot);
    const froe_body_knot to = count > 1 ? froe_motion_body_knot(m, body, knot + 1) : from;
    const froe_moving_knot centre[2] = {
        {from.time, {from.at[0], from.at[1]}, {from.control[0], from.control[1]}, {NAN}},
        {to.time, {to.at[0], to.at[1]}, {NAN}, {NAN}}};
    const froe_moving_knot place = froe_motion_knot(m, vertex, 0);
    mpq_t turn[2][3], at[2][3];
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < 3; i++) mpq_init(turn[k][i]), mpq_init(at[k][i]);
    fly_between(f, centre, count > 1 ? centre + 1 : NULL, time);
    turn_series(&from, count > 1 ? &to : NULL, time, turn[0], turn[1]);
    for (int k = 0; k < 2; k++) mpq_set_d(at[k][0], place.at[k]);
    for (int k = 0; k < 2; k++) {
        add_series(f->c[k], 1, turn[k], at[0]);
        add_series(f->c[k], k ? 1 : -1, turn[!k], at[1]);
    }
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < 3; i++) mpq_clear(turn[k][i]), mpq_clear(at[k][i]);
}

static void fly(flight *f, const froe_motion *m, uint32_t vertex, double time) {
    if (froe_motion_vertex_body(m, vertex) != FROE_NONE) {
        fly_in_body(f, m, vertex, time);
        return;
    }
    const size_t count = froe_motion_knot_count(m, vertex);
    size_t knot = 0;
    while (knot + 2 < count && froe_motion_knot(m, vertex, knot + 1).time <= time) knot++;
    const froe_moving_knot from = froe_motion_knot(m, vertex, knot);
    const froe_moving_knot to = count > 1 ? froe_motion_knot(m, vertex, knot + 1) : from;
    fly_between(f, &from, count > 1 ? &to : NULL, time);
}

/* The polynomial times the scale, which makes it whole. */
static void take_whole(germ *out, mpq_t c[TERMS], const mpz_t scale) {
    germ_zero(out, TERMS - 1, 0);
    for (int i = 0; i < TERMS; i++) {
        mpz_divexact(out->c[0][i], scale, mpq_denref(c[i]));
        mpz_mul(out->c[0][i], out->c[0][i], mpq_numref(c[i]));
    }
}

static void take_end(germ_point *out, flight *f, const mpz_t scale) {
    take_whole(&out->x, f->c[0], scale);
    take_whole(&out->y, f->c[1], scale);
    germ_zero(&out->w, 0, 0);
    mpz_set_ui(out->w.c[0][0], 1);
}

static void to_common_scale(mpz_t scale, flight *f) {
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < TERMS; i++) mpz_lcm(scale, scale, mpq_denref(f->c[k][i]));
}

/* The sign of a - b by x, then y. */
static int compare_ends(const germ_point *a, const germ_point *b) {
    const int sign = germ_det_sign(&a->x, &b->w, &b->x, &a->w);
    return sign ? sign : germ_det_sign(&a->y, &b->w, &b->y, &a->w);
}

static void put_in_order(present *p, uint32_t s) {
    const int order = compare_ends(&p->end[s][0], &p->end[s][1]);
    p->here[s] = order != 0;
    p->left[s] = order > 0;
    if (order <= 0) return;
    const germ_point other = p->end[s][0];
    p->end[s][0] = p->end[s][1], p->end[s][1] = other;
}

void present_init(present *p, const froe_motion *m, double time, const bool *there, const uint64_t *key) {
    flight f[PRESENT_MOST][2];
    *p = (present){.count = (uint32_t)froe_motion_object_count(m)};
    if (p->count > PRESENT_MOST) abort();
    mpz_init_set_ui(p->scale, 1);
    mpz_mul_2exp(p->scale, p->scale, QUERY_BITS);
    for (uint32_t s = 0; s < p->count; s++)
        for (int e = 0; e < 2; e++) {
            point_init(&p->end[s][e]);
            flight_init(&f[s][e]);
            if (!there[s]) continue;
            fly(&f[s][e], m, froe_motion_object(m, s).vertices[e], time);
            to_common_scale(p->scale, &f[s][e]);
        }
    for (uint32_t s = 0; s < p->count; s++) {
        p->key[s] = key[s];
        for (int e = 0; e < 2; e++) {
            if (there[s]) take_end(&p->end[s][e], &f[s][e], p->scale);
            flight_clear(&f[s][e]);
        }
        if (there[s]) put_in_order(p, s);
    }
}

void present_clear(present *p) {
    for (uint32_t s = 0; s < p->count; s++) {
        for (int e = 0; e < 2; e++) point_clear(&p->end[s][e]);
        for (uint32_t t = 0; t < p->count; t++) {
            if (p->crossing[s][t]) point_clear(p->crossing[s][t]);
            free(p->crossing[s][t]);
        }
    }
    mpz_clear(p->scale);
    free(p->nodes);
}

/* (b - a) x (q - a) */
static void turn(germ *out, const germ_point *a, const germ_point *b, const germ_point *q) {
    germ ux, uy, vx, vy;
    germ_init(&ux), germ_init(&uy), germ_init(&vx), germ_init(&vy);
    germ_zero(&ux, 3, 0), germ_zero(&uy, 3, 0), germ_zero(&vx, 3, 0), germ_zero(&vy, 3, 0);
    germ_accumulate(&ux, 1, &b->x, 0), germ_accumulate(&ux, -1, &a->x, 0);
    germ_accumulate(&uy, 1, &b->y, 0), germ_accumulate(&uy, -1, &a->y, 0);
    germ_accumulate(&vx, 1, &q->x, 0), germ_accumulate(&vx, -1, &a->x, 0);
    germ_accumulate(&vy, 1, &q->y, 0), germ_accumulate(&vy, -1, &a->y, 0);
    germ_zero(out, 6, 0);
    germ_add_product(out, 1, &ux, &vy, 0);
    germ_add_product(out, -1, &uy, &vx, 0);
    germ_clear(&ux), germ_clear(&uy), germ_clear(&vx), germ_clear(&vy);
}

/* Where the lines of two segments cross: with the turns u and v of one of them against the ends a and b of the other
 * (u b - v a) / (u - v). */
static void cross_lines(germ_point *out, const germ_point s[2], const germ_point t[2]) {
    germ u, v;
    germ_init(&u), germ_init(&v);
    turn(&u, t, t + 1, s), turn(&v, t, t + 1, s + 1);
    germ_zero(&out->x, 9, 0), germ_zero(&out->y, 9, 0), germ_zero(&out->w, 6, 0);
    germ_add_product(&out->x, 1, &u, &s[1].x, 0), germ_add_product(&out->x, -1, &v, &s[0].x, 0);
    germ_add_product(&out->y, 1, &u, &s[1].y, 0), germ_add_product(&out->y, -1, &v, &s[0].y, 0);
    germ_accumulate(&out->w, 1, &u, 0), germ_accumulate(&out->w, -1, &v, 0);
    if (germ_sign(&out->w) < 0) germ_minus(&out->x), germ_minus(&out->y), germ_minus(&out->w);
    germ_clear(&u), germ_clear(&v);
}

static const germ_point *crossing_of(present *p, uint32_t s, uint32_t t) {
    germ_point **at = &p->crossing[s < t ? s : t][s < t ? t : s];
    if (*at) return *at;
    *at = malloc(sizeof **at);
    if (!*at) abort();
    point_init(*at);
    cross_lines(*at, p->end[s], p->end[t]);
    return *at;
}

/* ------------------------------------------------------------------------- cells -- */

typedef struct cell {
    const germ_point *wall[2]; /* NULL: none */
    int top, bottom;           /* segments, -1: none */
} cell;

/* A share num / den of a segment, den > 0, and what is there: as a wall of a node. */
typedef struct bound {
    germ num, den;
    uint32_t what;
} bound;

/* The part of a segment in a cell: between two shares, from the left. */
typedef struct part {
    bound at[2];
} part;

static void part_init(part *i) {
    for (int k = 0; k < 2; k++) germ_init(&i->at[k].num), germ_init(&i->at[k].den);
}
static void part_clear(part *i) {
    for (int k = 0; k < 2; k++) germ_clear(&i->at[k].num), germ_clear(&i->at[k].den);
}

static void germ_copy(germ *out, const germ *a) {
    germ_zero(out, a->d, a->e);
    germ_accumulate(out, 1, a, 0);
}

/* a + b t > 0 for the shares t of the part. What comes last takes the place of an equal one, if it `wins`. False: for
 * none. */
static bool restrict_part(part *i, const germ *a, const germ *b, uint32_t what, bool wins) {
    const int slope = germ_sign(b);
    if (!slope) return germ_sign(a) > 0;
    bound *side = &i->at[slope > 0 ? PRESENT_LEFT : PRESENT_RIGHT];
    bound new = {.what = what};
    germ_init(&new.num), germ_init(&new.den);
    germ_copy(&new.num, a), germ_copy(&new.den, b);
    if (slope > 0)
        germ_minus(&new.num);
    else
        germ_minus(&new.den);
    const int order = germ_det_sign(&new.num, &side->den, &side->num, &new.den) * slope; /* > 0: nearer */
    if (order > 0 || (!order && wins)) {
        const bound old = *side;
        *side = new, new = old;
    }
    germ_clear(&new.num), germ_clear(&new.den);
    return germ_det_sign(&i->at[0].num, &i->at[1].den, &i->at[1].num, &i->at[0].den) < 0;
}

static bool restrict_by_border(present *p, part *i, uint32_t s, uint32_t border, int above) {
    germ a, b, end;
    germ_init(&a), germ_init(&b), germ_init(&end);
    const germ_point *line = p->end[border];
    turn(&a, line, line + 1, &p->end[s][0]);
    turn(&end, line, line + 1, &p->end[s][1]);
    germ_zero(&b, 6, 0);
    germ_accumulate(&b, 1, &end, 0), germ_accumulate(&b, -1, &a, 0);
    if (above < 0) germ_minus(&a), germ_minus(&b);
    const bool some = restrict_part(i, &a, &b, border, false);
    germ_clear(&a), germ_clear(&b), germ_clear(&end);
    return some;
}

/* Behind a left wall: the x + e y of the point is greater than that of the wall. */
static bool restrict_by_wall(present *p, part *i, uint32_t s, const germ_point *wall, int side) {
    const germ_point *from = &p->end[s][0], *to = &p->end[s][1];
    germ a, b;
    germ_init(&a), germ_init(&b);
    germ_zero(&a, 9, 1), germ_zero(&b, 9, 1);
    germ_add_product(&a, 1, &from->x, &wall->w, 0), germ_accumulate(&a, -1, &wall->x, 0);
    germ_add_product(&a, 1, &from->y, &wall->w, 1), germ_accumulate(&a, -1, &wall->y, 1);
    germ_add_product(&b, 1, &to->x, &wall->w, 0), germ_add_product(&b, -1, &from->x, &wall->w, 0);
    germ_add_product(&b, 1, &to->y, &wall->w, 1), germ_add_product(&b, -1, &from->y, &wall->w, 1);
    if (side == PRESENT_RIGHT) germ_minus(&a), germ_minus(&b);
    const bool some = restrict_part(i, &a, &b, PRESENT_NO_WALL, true);
    germ_clear(&a), germ_clear(&b);
    return some;
}

/* False: nothing of the segment is in the cell. */
static bool part_in(present *p, part *i, uint32_t s, const cell *c) {
    for (int k = 0; k < 2; k++) { /* the whole segment, from 0 to 1 */
        germ_zero(&i->at[k].num, 0, 0), germ_zero(&i->at[k].den, 0, 0);
        mpz_set_ui(i->at[k].num.c[0][0], (unsigned)k), mpz_set_ui(i->at[k].den.c[0][0], 1);
        i->at[k].what = (p->left[s] ^ k) ? PRESENT_END_1 : PRESENT_END_0;
    }
    if (c->top == (int)s || c->bottom == (int)s) return false;
    return (c->top < 0 || restrict_by_border(p, i, s, (uint32_t)c->top, -1)) &&
           (c->bottom < 0 || restrict_by_border(p, i, s, (uint32_t)c->bottom, 1)) &&
           (!c->wall[0] || restrict_by_wall(p, i, s, c->wall[0], PRESENT_LEFT)) &&
           (!c->wall[1] || restrict_by_wall(p, i, s, c->wall[1], PRESENT_RIGHT));
}

/* ----------------------------------------------------------------------- the tree -- */

static const germ_point *wall_point(present *p, uint32_t s, uint32_t what) {
    if (what == PRESENT_NO_WALL) return NULL;
    if (what == PRESENT_END_0 || what == PRESENT_END_1) return &p->end[s][p->left[s] ^ (what == PRESENT_END_1)];
    return crossing_of(p, s, what);
}

static int new_node(present *p) {
    if (p->node_count == p->room) {
        p->room = 2 * p->room + 64;
        p->nodes = realloc(p->nodes, (size_t)p->room * sizeof *p->nodes);
        if (!p->nodes) abort();
    }
    return p->node_count++;
}

static bool cuts_before(const present *p, uint32_t s, uint32_t t) {
    return p->key[s] < p->key[t] || (p->key[s] == p->key[t] && s < t);
}

/* The first in order that has something in the cell cuts it. */
static int build(present *p, const cell *c, const uint32_t *list, int count) {
    uint32_t in[PRESENT_MOST];
    int kept = 0, first = -1, node = -1;
    part i;
    part_init(&i);
    for (int n = 0; n < count; n++) {
        if (!part_in(p, &i, list[n], c)) continue;
        if (first < 0 || cuts_before(p, list[n], in[first])) first = kept;
        in[kept++] = list[n];
    }
    if (kept) {
        const uint32_t s = in[first];
        present_node made = {.segment = s};
        node = new_node(p);
        part_in(p, &i, s, c);
        cell inner[4];
        for (int k = 0; k < 4; k++) inner[k] = *c;
        for (int side = 0; side < 2; side++) {
            made.wall[side] = i.at[side].what;
            const germ_point *wall = wall_point(p, s, made.wall[side]);
            if (!wall) continue;
            inner[side].wall[1 - side] = wall;
            inner[PRESENT_UP].wall[side] = inner[PRESENT_DOWN].wall[side] = wall;
        }
        inner[PRESENT_UP].bottom = inner[PRESENT_DOWN].top = (int)s;
        in[first] = in[--kept];
        for (int k = 0; k < 4; k++)
            made.child[k] = k < 2 && made.wall[k] == PRESENT_NO_WALL ? -1 : build(p, inner + k, in, kept);
        p->nodes[node] = made;
    }
    part_clear(&i);
    return node;
}

void present_build(present *p) {
    uint32_t list[PRESENT_MOST];
    int count = 0;
    for (uint32_t s = 0; s < p->count; s++)
        if (p->here[s]) list[count++] = s;
    p->node_count = 0;
    build(p, &(cell){{NULL, NULL}, -1, -1}, list, count);
}

/* --------------------------------------------------------------------- questions -- */

bool present_takes(const double at[2]) {
    for (int k = 0; k < 2; k++)
        if (!(fabs(at[k]) < 0x1p60) || ldexp(at[k], QUERY_BITS) != floor(ldexp(at[k], QUERY_BITS))) return false;
    return true;
}

static void take_query(const present *p, const double at[2], germ_point *out) {
    mpq_t x;
    mpq_init(x);
    point_init(out);
    germ_zero(&out->w, 0, 0), mpz_set_ui(out->w.c[0][0], 1);
    for (int k = 0; k < 2; k++) {
        germ *to = k ? &out->y : &out->x;
        germ_zero(to, 0, 0);
        mpq_set_d(x, at[k]);
        mpz_divexact(to->c[0][0], p->scale, mpq_denref(x));
        mpz_mul(to->c[0][0], to->c[0][0], mpq_numref(x));
    }
    mpq_clear(x);
}

/* Is the middle one of three whole numbers between the others? */
static bool is_between(const mpz_t a, const mpz_t q, const mpz_t b) {
    return mpz_cmp(a, q) * mpz_cmp(q, b) >= 0;
}

bool present_is_on(const present *p, uint32_t s, const double at[2]) {
    germ_point q;
    germ area;
    if (!p->here[s]) return false;
    take_query(p, at, &q);
    germ_init(&area);
    const germ_point *a = &p->end[s][0], *b = &p->end[s][1];
    turn(&area, a, b, &q);
    const bool on = !mpz_sgn(area.c[0][0]) && is_between(a->x.c[0][0], q.x.c[0][0], b->x.c[0][0]) &&
                    is_between(a->y.c[0][0], q.y.c[0][0], b->y.c[0][0]);
    germ_clear(&area);
    point_clear(&q);
    return on;
}

static double near(const present *p, const germ *a) {
    return quotient_near(a->c[0][0], p->scale);
}

bool present_is_near(const present *p, uint32_t s, const double at[2]) {
    const double a[2] = {near(p, &p->end[s][0].x), near(p, &p->end[s][0].y)};
    const double way[2] = {near(p, &p->end[s][1].x) - a[0], near(p, &p->end[s][1].y) - a[1]};
    const double gone[2] = {at[0] - a[0], at[1] - a[1]}, length = way[0] * way[0] + way[1] * way[1];
    const double along = gone[0] * way[0] + gone[1] * way[1], aside = gone[0] * way[1] - gone[1] * way[0];
    const double slack = 1e-9 * (1 + length);
    if (!(length > 0)) return fabs(gone[0]) + fabs(gone[1]) < slack;
    return fabs(aside) < slack && along > -slack && along < length + slack;
}

/* How far straight up a line is: the way is (-e, 1). False: the segment does not reach over or under the point. */
static bool height_of(const present *p, uint32_t s, const germ_point *q, bound *out) {
    const germ_point *a = &p->end[s][0], *b = &p->end[s][1];
    if (!p->here[s] || compare_ends(a, q) >= 0 || compare_ends(q, b) >= 0) return false;
    turn(&out->num, a, b, q);
    germ_minus(&out->num);
    germ_zero(&out->den, 3, 1);
    germ_accumulate(&out->den, 1, &b->x, 0), germ_accumulate(&out->den, -1, &a->x, 0);
    germ_accumulate(&out->den, 1, &b->y, 1), germ_accumulate(&out->den, -1, &a->y, 1);
    return true;
}

uint32_t present_next(present *p, const double at[2], int up) {
    germ_point q;
    part i;
    uint32_t best = FROE_NONE;
    take_query(p, at, &q);
    part_init(&i);
    for (uint32_t s = 0; s < p->count; s++) {
        if (!height_of(p, s, &q, &i.at[1]) || germ_sign(&i.at[1].num) != up) continue;
        int order = -1;
        if (best != FROE_NONE) order = germ_det_sign(&i.at[1].num, &i.at[0].den, &i.at[0].num, &i.at[1].den) * up;
        if (order > 0 || (!order && !cuts_before(p, s, best))) continue;
        const bound other = i.at[0];
        i.at[0] = i.at[1], i.at[1] = other;
        best = s;
    }
    part_clear(&i);
    point_clear(&q);
    return best;
}

/* Of a ray from a to b, not of length 0: the share num / den at which it meets a segment first. False: not at all. */
static bool meet(const present *p, uint32_t s, const germ_point *a, const germ_point *b, bound *out) {
    const germ_point *from = &p->end[s][0], *to = &p->end[s][1];
    if (!p->here[s]) return false;
    germ u, v, f, g;
    germ_init(&u), germ_init(&v), germ_init(&f), germ_init(&g);
    turn(&u, from, to, a), turn(&v, from, to, b); /* the ray's ends against the segment, */
    turn(&f, a, b, from), turn(&g, a, b, to);     /* and the segment's against the ray */
    bool some = germ_sign(&u) * germ_sign(&v) <= 0 && germ_sign(&f) * germ_sign(&g) <= 0;
    if (some && (germ_sign(&u) || germ_sign(&v))) {
        germ_copy(&out->num, &u); /* u / (u - v) */
        germ_zero(&out->den, 6, 0);
        germ_accumulate(&out->den, 1, &u, 0), germ_accumulate(&out->den, -1, &v, 0);
        if (germ_sign(&out->den) < 0) germ_minus(&out->num), germ_minus(&out->den);
    } else if (some) { /* in one line: how far along the ray the segment's ends are */
        germ rx, ry, along[2];
        germ_init(&rx), germ_init(&ry), germ_zero(&rx, 0, 0), germ_zero(&ry, 0, 0);
        germ_accumulate(&rx, 1, &b->x, 0), germ_accumulate(&rx, -1, &a->x, 0);
        germ_accumulate(&ry, 1, &b->y, 0), germ_accumulate(&ry, -1, &a->y, 0);
        for (int k = 0; k < 2; k++) {
            const germ_point *end = &p->end[s][k];
            germ_init(&along[k]), germ_zero(&along[k], 3, 0);
            germ_add_product(&along[k], 1, &end->x, &rx, 0), germ_add_product(&along[k], -1, &a->x, &rx, 0);
            germ_add_product(&along[k], 1, &end->y, &ry, 0), germ_add_product(&along[k], -1, &a->y, &ry, 0);
        }
        germ_zero(&out->den, 0, 0);
        germ_add_product(&out->den, 1, &rx, &rx, 0), germ_add_product(&out->den, 1, &ry, &ry, 0);
        germ one;
        germ_init(&one), germ_zero(&one, 0, 0), mpz_set_ui(one.c[0][0], 1);
        const int order = germ_det_sign(&along[0], &one, &along[1], &one);
        const germ *low = &along[order > 0], *high = &along[order <= 0];
        some = germ_sign(high) >= 0 && germ_det_sign(low, &one, &out->den, &one) <= 0;
        germ_zero(&out->num, 3, 0);
        if (germ_sign(low) > 0) germ_copy(&out->num, low);
        germ_clear(&rx), germ_clear(&ry), germ_clear(&along[0]), germ_clear(&along[1]), germ_clear(&one);
    }
    germ_clear(&u), germ_clear(&v), germ_clear(&f), germ_clear(&g);
    return some;
}

/* A ray without length: the segment passes through the point. */
static bool is_through(const present *p, uint32_t s, const germ_point *q) {
    const germ_point *a = &p->end[s][0], *b = &p->end[s][1];
    if (!p->here[s] || compare_ends(a, q) > 0 || compare_ends(q, b) > 0) return false;
    germ area;
    germ_init(&area);
    turn(&area, a, b, q);
    const bool through = !germ_sign(&area);
    germ_clear(&area);
    return through;
}

bool present_ray(present *p, const double from[2], const double to[2], bool *first) {
    germ_point a, b;
    part i; /* the best so far, and the one looked at */
    bool found = false;
    const bool is_point = from[0] == to[0] && from[1] == to[1];
    take_query(p, from, &a), take_query(p, to, &b);
    part_init(&i);
    for (uint32_t s = 0; s < p->count; s++) {
        first[s] = is_point ? is_through(p, s, &a) : meet(p, s, &a, &b, &i.at[1]);
        if (!first[s]) continue;
        int order = is_point && found ? 0 : -1;
        if (found && !is_point) order = germ_det_sign(&i.at[1].num, &i.at[0].den, &i.at[0].num, &i.at[1].den);
        found = true;
        if (order > 0) first[s] = false;
        if (order >= 0) continue;
        for (uint32_t t = 0; t < s; t++) first[t] = false;
        const bound other = i.at[0];
        i.at[0] = i.at[1], i.at[1] = other;
    }
    part_clear(&i);
    point_clear(&a), point_clear(&b);
    return found;
}

bool present_share(present *p, uint32_t segment, const double from[2], const double to[2], double *share) {
    germ_point a, b;
    part i;
    take_query(p, from, &a), take_query(p, to, &b);
    part_init(&i);
    const bool some = meet(p, segment, &a, &b, &i.at[0]) && mpz_sgn(i.at[0].den.c[0][0]);
    if (some) *share = quotient_near(i.at[0].num.c[0][0], i.at[0].den.c[0][0]);
    part_clear(&i);
    point_clear(&a), point_clear(&b);
    return some;
}
