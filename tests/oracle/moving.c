/* moving.c: see moving.h. */
#include "oracle/moving.h"
#include <assert.h>
#include <math.h>
#include <stdlib.h>

/* -------------------------------------------------------- polynomials over Z -- */

enum { MOST_DEGREE = 64, CLOSE = 56 };

typedef struct poly { /* degree -1: zero */
    int degree;
    mpz_t c[MOST_DEGREE + 1];
} poly;

static void poly_init(poly *f) {
    f->degree = -1;
    for (int i = 0; i <= MOST_DEGREE; i++) mpz_init(f->c[i]);
}

static void poly_clear(poly *f) {
    for (int i = 0; i <= MOST_DEGREE; i++) mpz_clear(f->c[i]);
}

static void poly_trim(poly *f, int most) {
    f->degree = most;
    while (f->degree >= 0 && !mpz_sgn(f->c[f->degree])) f->degree--;
}

static void poly_copy(poly *out, const poly *f) {
    out->degree = f->degree;
    for (int i = 0; i <= f->degree; i++) mpz_set(out->c[i], f->c[i]);
}

/* Divides by the greatest common divisor of the coefficients. */
static void poly_primitive(poly *f) {
    mpz_t g;
    mpz_init(g);
    for (int i = 0; i <= f->degree; i++) mpz_gcd(g, g, f->c[i]);
    for (int i = 0; i <= f->degree && mpz_sgn(g); i++) mpz_divexact(f->c[i], f->c[i], g);
    mpz_clear(g);
}

static void poly_mul(poly *out, const poly *f, const poly *g) {
    assert(f->degree + g->degree <= MOST_DEGREE && out != f && out != g);
    for (int i = 0; i <= MOST_DEGREE; i++) mpz_set_ui(out->c[i], 0);
    for (int i = 0; i <= f->degree; i++)
        for (int j = 0; j <= g->degree; j++) mpz_addmul(out->c[i + j], f->c[i], g->c[j]);
    poly_trim(out, f->degree < 0 || g->degree < 0 ? -1 : f->degree + g->degree);
}

static void poly_derivative(poly *out, const poly *f) {
    for (int i = 1; i <= f->degree; i++) mpz_mul_ui(out->c[i - 1], f->c[i], (unsigned long)i);
    poly_trim(out, f->degree - 1);
}

/* f becomes a positive multiple of its remainder by g; `quotient`, if given, the quotient up to a factor. */
static void poly_reduce(poly *f, const poly *g, poly *quotient) {
    mpz_t lead, top;
    mpz_inits(lead, top, NULL);
    mpz_abs(lead, g->c[g->degree]);
    if (quotient)
        for (int i = 0; i <= MOST_DEGREE; i++) mpz_set_ui(quotient->c[i], 0);
    int most = f->degree - g->degree;
    while (f->degree >= g->degree) {
        int shift = f->degree - g->degree;
        mpz_set(top, f->c[f->degree]);
        if (mpz_sgn(g->c[g->degree]) < 0) mpz_neg(top, top);
        for (int i = 0; i <= f->degree; i++) mpz_mul(f->c[i], f->c[i], lead);
        for (int i = 0; i <= g->degree; i++) mpz_submul(f->c[i + shift], top, g->c[i]);
        for (int i = 0; i <= MOST_DEGREE && quotient; i++) mpz_mul(quotient->c[i], quotient->c[i], lead);
        if (quotient) mpz_add(quotient->c[shift], quotient->c[shift], top);
        poly_trim(f, f->degree - 1);
    }
    if (quotient) poly_trim(quotient, most), poly_primitive(quotient);
    poly_primitive(f);
    mpz_clears(lead, top, NULL);
}

static void poly_gcd(poly *out, const poly *f, const poly *g) {
    poly a, b;
    poly_init(&a), poly_init(&b);
    poly_copy(&a, f), poly_copy(&b, g);
    while (b.degree >= 0) {
        poly_reduce(&a, &b, NULL);
        poly swap = a;
        a = b;
        b = swap;
    }
    poly_copy(out, &a);
    poly_clear(&a), poly_clear(&b);
}

static void poly_squarefree(poly *out, const poly *f) {
    poly d, g, rest;
    poly_init(&d), poly_init(&g), poly_init(&rest);
    poly_derivative(&d, f);
    if (f->degree < 2) {
        poly_copy(out, f);
    } else {
        poly_gcd(&g, f, &d);
        poly_copy(&rest, f);
        poly_reduce(&rest, &g, out);
        assert(rest.degree < 0);
    }
    poly_clear(&d), poly_clear(&g), poly_clear(&rest);
}

static int poly_sign(const poly *f, const mpq_t x) {
    mpz_t sum, term, power; /* homogeneous Horner */
    mpz_inits(sum, term, NULL);
    mpz_init_set_ui(power, 1);
    for (int i = f->degree; i >= 0; i--) {
        mpz_mul(sum, sum, mpq_numref(x));
        mpz_mul(term, f->c[i], power);
        mpz_add(sum, sum, term);
        mpz_mul(power, power, mpq_denref(x));
    }
    int sign = mpz_sgn(sum);
    mpz_clears(sum, term, power, NULL);
    return sign;
}

/* ----------------------------------------------------------------- Sturm -- */

typedef struct chain {
    int count;
    poly p[MOST_DEGREE + 1];
} chain;

static chain *chain_of(const poly *f) { /* square-free */
    chain *c = malloc(sizeof *c);
    c->count = 1;
    poly_init(&c->p[0]);
    poly_copy(&c->p[0], f);
    poly next;
    poly_init(&next);
    poly_derivative(&next, f);
    while (next.degree >= 0) {
        poly_init(&c->p[c->count]);
        poly_copy(&c->p[c->count++], &next);
        poly_copy(&next, &c->p[c->count - 2]);
        poly_reduce(&next, &c->p[c->count - 1], NULL);
        for (int i = 0; i <= next.degree; i++) mpz_neg(next.c[i], next.c[i]);
    }
    poly_clear(&next);
    return c;
}

static void chain_free(chain *c) {
    for (int i = 0; i < c->count; i++) poly_clear(&c->p[i]);
    free(c);
}

static int variations(const chain *c, const mpq_t x) {
    int last = 0, count = 0;
    for (int i = 0; i < c->count; i++) {
        int sign = poly_sign(&c->p[i], x);
        count += sign * last < 0;
        if (sign) last = sign;
    }
    return count;
}

/* Between two instants, these included? */
static bool has_roots(const poly *f, const mpq_t from, const mpq_t to) {
    chain *c = chain_of(f);
    bool any = !poly_sign(f, from) || variations(c, from) != variations(c, to);
    chain_free(c);
    return any;
}

/* ------------------------------------------------------- segments in motion -- */

/* Coordinates of one vertex: x[k] / w, polynomials in t with a common denominator, which is positive. */
typedef struct curve {
    poly x[2], w;
} curve;

/* c *= u0 + u1 t; what there is beyond the fourth term is lost. */
static void times_line(mpq_t c[4], const mpq_t u0, int u1) {
    mpq_t term, slope;
    mpq_inits(term, slope, NULL);
    mpq_set_si(slope, u1, 1);
    for (int i = 3; i >= 0; i--) {
        mpq_mul(c[i], c[i], u0);
        if (!i) break;
        mpq_mul(term, c[i - 1], slope);
        mpq_add(c[i], c[i], term);
    }
    mpq_clears(term, slope, NULL);
}

/* out += factor (t1 - t)^(degree - i) (t - t0)^i / (t1 - t0)^degree */
static void add_weighted(mpq_t out[4], const mpq_t factor, double t0, double t1, int degree, int i) {
    mpq_t c[4], a, b, span;
    mpq_inits(c[0], c[1], c[2], c[3], a, b, span, NULL);
    mpq_set(c[0], factor);
    mpq_set_d(a, t1);
    mpq_set_d(b, t0);
    mpq_sub(span, a, b);
    mpq_neg(b, b);
    for (int k = 0; k < degree; k++) {
        times_line(c, k < i ? b : a, k < i ? 1 : -1);
        for (int n = 0; n < 4; n++) mpq_div(c[n], c[n], span);
    }
    for (int n = 0; n < 4; n++) mpq_add(out[n], out[n], c[n]);
    mpq_clears(c[0], c[1], c[2], c[3], a, b, span, NULL);
}

/* Bernstein's form with as many control points as the piece has. */
static void set_coordinate(mpq_t c[4], const froe_moving_knot *p, const froe_moving_knot *q, int k) {
    static const unsigned long choose[4][4] = {{1}, {1, 1}, {1, 2, 1}, {1, 3, 3, 1}};
    const int degree = !q ? 0 : isnan(p->control[0]) ? 1 : isnan(p->second[0]) ? 2 : 3;
    const double points[4] = {p->at[k], degree > 1 ? p->control[k] : 0, degree > 2 ? p->second[k] : 0};
    mpq_t factor, times;
    mpq_inits(factor, times, NULL);
    for (int i = 0; i < 4; i++) mpq_set_ui(c[i], 0, 1);
    for (int i = 0; i <= degree; i++) {
        mpq_set_d(factor, degree && i == degree ? q->at[k] : points[i]);
        mpq_set_ui(times, choose[degree][i], 1);
        mpq_mul(factor, factor, times);
        add_weighted(c, factor, p->time, q ? q->time : p->time, degree, i);
    }
    mpq_clears(factor, times, NULL);
}

/* Number of the piece that is in force just after the time t, or at it at the end of the plan. */
static size_t piece_at(const froe_motion *m, uint32_t vertex, double t) {
    size_t count = froe_motion_knot_count(m, vertex), i = 0;
    while (i + 2 < count && froe_motion_knot(m, vertex, i + 1).time <= t) i++;
    return i;
}

/* Is one object on one side of the other along an axis, by the hulls of the pieces that are in force at t? */
static bool hulls_apart(const froe_motion *m, const uint32_t v[4], double t) {
    double lo[2][2], hi[2][2];
    for (int n = 0; n < 4; n++)
        if (froe_motion_vertex_body(m, v[n]) != FROE_NONE) return false;
    for (int n = 0; n < 4; n++) lo[n / 2][n % 2] = INFINITY, hi[n / 2][n % 2] = -INFINITY;
    for (int n = 0; n < 4; n++) {
        size_t i = piece_at(m, v[n], t);
        for (size_t j = i; j < i + 2 && j < froe_motion_knot_count(m, v[n]); j++) {
            froe_moving_knot p = froe_motion_knot(m, v[n], j);
            for (int k = 0; k < 2; k++) {
                const double all[3] = {p.at[k], j > i ? NAN : p.control[k], j > i ? NAN : p.second[k]};
                for (int c = 0; c < 3; c++) { /* NaN: there is none */
                    lo[n / 2][k] = fmin(lo[n / 2][k], all[c]);
                    hi[n / 2][k] = fmax(hi[n / 2][k], all[c]);
                }
            }
        }
    }
    for (int k = 0; k < 2; k++)
        if (lo[0][k] > hi[1][k] || lo[1][k] > hi[0][k]) return true;
    return false;
}

/* Rational polynomials become whole by a common factor. */
static void take_whole(curve *out, mpq_t x[2][5], mpq_t w[5]) {
    mpq_t *const from[3] = {x[0], x[1], w};
    poly *const to[3] = {&out->x[0], &out->x[1], &out->w};
    mpz_t scale;
    mpz_init_set_ui(scale, 1);
    for (int n = 0; n < 3; n++)
        for (int j = 0; j < 5; j++) mpz_lcm(scale, scale, mpq_denref(from[n][j]));
    for (int n = 0; n < 3; n++) {
        for (int j = 0; j < 5; j++) {
            mpz_divexact(to[n]->c[j], scale, mpq_denref(from[n][j]));
            mpz_mul(to[n]->c[j], to[n]->c[j], mpq_numref(from[n][j]));
        }
        poly_trim(to[n], 4);
    }
    mpz_clear(scale);
}

/* out += factor a b */
static void add_product(mpq_t out[5], int factor, mpq_t a[5], mpq_t b[5]) {
    mpq_t term, by;
    mpq_inits(term, by, NULL);
    mpq_set_si(by, factor, 1);
    for (int i = 0; i < 5; i++)
        for (int j = 0; i + j < 5; j++) {
            mpq_mul(term, a[i], b[j]);
            mpq_mul(term, term, by);
            mpq_add(out[i + j], out[i + j], term);
        }
    mpq_clears(term, by, NULL);
}

static void numbers(mpq_t *all, int count, bool make) {
    for (int i = 0; i < count; i++)
        if (make)
            mpq_init(all[i]);
        else
            mpq_clear(all[i]);
}

/* Component k of the quaternion at the time t: q0 + (t - t0) (q1 - q0) / (t1 - t0). */
static void set_turn(mpq_t c[5], const froe_body_knot *p, const froe_body_knot *q, int k) {
    mpq_t step, start;
    mpq_inits(step, start, NULL);
    mpq_set_d(c[0], p->turn[k]);
    if (q) {
        mpq_set_d(c[1], q->turn[k]);
        mpq_sub(c[1], c[1], c[0]);
        mpq_set_d(step, q->time), mpq_set_d(start, p->time);
        mpq_sub(step, step, start);
        mpq_div(c[1], c[1], step);
        mpq_mul(step, start, c[1]);
        mpq_sub(c[0], c[0], step);
    }
    mpq_clears(step, start, NULL);
}

/* With q = (z, w), a place (u, v) in a body goes to (w w - z z) u - 2 z w v and 2 z w u + (w w - z z) v, over |q|^2. */
static void curve_in_body(curve *out, const froe_motion *m, uint32_t vertex, double t) {
    const uint32_t body = froe_motion_vertex_body(m, vertex);
    const size_t count = froe_motion_body_knot_count(m, body);
    size_t i = 0;
    while (i + 2 < count && froe_motion_body_knot(m, body, i + 1).time <= t) i++;
    const froe_body_knot a = froe_motion_body_knot(m, body, i), b = froe_motion_body_knot(m, body, i + (count > 1));
    const froe_moving_knot p = {a.time, {a.at[0], a.at[1]}, {a.control[0], a.control[1]}, {NAN}};
    const froe_moving_knot q = {b.time, {b.at[0], b.at[1]}, {NAN}, {NAN}}, in = froe_motion_knot(m, vertex, 0);
    mpq_t z[5], w[5], cosine[5], sine[5], square[5], place[2][5], centre[2][5], x[2][5];
    mpq_t *const all[] = {z, w, cosine, sine, square, place[0], place[1], centre[0], centre[1], x[0], x[1]};
    for (size_t n = 0; n < sizeof all / sizeof *all; n++) numbers(all[n], 5, true);
    set_turn(z, &a, count > 1 ? &b : NULL, 2), set_turn(w, &a, count > 1 ? &b : NULL, 3);
    add_product(cosine, 1, w, w), add_product(cosine, -1, z, z), add_product(sine, 2, z, w);
    add_product(square, 1, w, w), add_product(square, 1, z, z);
    for (int k = 0; k < 2; k++) {
        mpq_set_d(place[k][0], in.at[k]);
        set_coordinate(centre[k], &p, count > 1 ? &q : NULL, k);
        add_product(x[k], 1, centre[k], square);
    }
    for (int k = 0; k < 2; k++) {
        add_product(x[k], 1, k ? sine : cosine, place[0]);
        add_product(x[k], k ? 1 : -1, k ? cosine : sine, place[1]);
    }
    take_whole(out, x, square);
    for (size_t n = 0; n < sizeof all / sizeof *all; n++) numbers(all[n], 5, false);
}

static void curve_set(curve *out, const froe_motion *m, uint32_t vertex, double t) {
    if (froe_motion_vertex_body(m, vertex) != FROE_NONE) {
        curve_in_body(out, m, vertex, t);
        return;
    }
    size_t count = froe_motion_knot_count(m, vertex), i = piece_at(m, vertex, t);
    froe_moving_knot p = froe_motion_knot(m, vertex, i), q = p;
    if (count > 1) q = froe_motion_knot(m, vertex, i + 1);
    mpq_t c[2][5], w[5];
    mpq_t *const all[3] = {c[0], c[1], w};
    for (int n = 0; n < 3; n++) numbers(all[n], 5, true);
    for (int k = 0; k < 2; k++) set_coordinate(c[k], &p, count > 1 ? &q : NULL, k);
    mpq_set_ui(w[0], 1, 1);
    take_whole(out, c, w);
    for (int n = 0; n < 3; n++) numbers(all[n], 5, false);
}

/* (b - a) times both denominators */
static void difference(poly *out, const curve *a, const curve *b, int k) {
    poly left, right;
    poly_init(&left), poly_init(&right);
    poly_mul(&left, &b->x[k], &a->w);
    poly_mul(&right, &a->x[k], &b->w);
    const int most = left.degree > right.degree ? left.degree : right.degree;
    for (int i = 0; i <= most; i++) {
        mpz_set_ui(out->c[i], 0);
        if (i <= left.degree) mpz_set(out->c[i], left.c[i]);
        if (i <= right.degree) mpz_sub(out->c[i], out->c[i], right.c[i]);
    }
    poly_trim(out, most);
    poly_clear(&left), poly_clear(&right);
}

/* The turn of a, b, c. */
static void turn(poly *out, const curve *a, const curve *b, const curve *c) {
    poly u[2], v[2], left, right;
    for (int k = 0; k < 2; k++) {
        poly_init(&u[k]), poly_init(&v[k]);
        difference(&u[k], a, b, k);
        difference(&v[k], a, c, k);
    }
    poly_init(&left), poly_init(&right);
    poly_mul(&left, &u[0], &v[1]);
    poly_mul(&right, &u[1], &v[0]);
    int most = left.degree > right.degree ? left.degree : right.degree;
    for (int i = 0; i <= most; i++) {
        mpz_set_ui(out->c[i], 0);
        if (i <= left.degree) mpz_add(out->c[i], out->c[i], left.c[i]);
        if (i <= right.degree) mpz_sub(out->c[i], out->c[i], right.c[i]);
    }
    poly_trim(out, most);
    for (int k = 0; k < 2; k++) poly_clear(&u[k]), poly_clear(&v[k]);
    poly_clear(&left), poly_clear(&right);
}

/* ------------------------------------------------------ one stretch of time -- */

typedef struct stretch {
    poly turn[4], gap[8], all; /* all: the product of what is critical, square-free */
    chain *sturm;
    mpq_t from, to;
    bool flat;
} stretch;

/* Is q on one side of p along an axis? Signs of the gaps. */
static bool boxes_apart(const int gap[8]) {
    for (int k = 0; k < 2; k++)
        for (int s = -1; s <= 1; s += 2)
            if (gap[4 * k] == s && gap[4 * k + 1] == s && gap[4 * k + 2] == s && gap[4 * k + 3] == s) return true;
    return false;
}

static bool meet_by_signs(const int turn[4], const int gap[8]) {
    if (turn[0] * turn[1] > 0 || turn[2] * turn[3] > 0) return false;
    return turn[0] || turn[1] || turn[2] || turn[3] || !boxes_apart(gap);
}

static bool meet_at(const stretch *s, const mpq_t t) {
    int turns[4], gaps[8];
    for (int i = 0; i < 4; i++) turns[i] = poly_sign(&s->turn[i], t);
    for (int i = 0; i < 8; i++) gaps[i] = poly_sign(&s->gap[i], t);
    return meet_by_signs(turns, gaps);
}

/* Sign of f at the only root of `all` between low and high, which are none: 0 if the common divisor has that root. */
static int sign_at_root(const stretch *s, const poly *f, mpq_t low, mpq_t high) {
    if (f->degree < 0) return 0;
    poly g;
    poly_init(&g);
    poly_gcd(&g, f, &s->all);
    bool common = g.degree > 0 && poly_sign(&g, low) != poly_sign(&g, high); /* square-free */
    int sign = 0;
    poly_squarefree(&g, f);
    chain *sturm = chain_of(&g);
    mpq_t l, h, middle;
    mpq_inits(l, h, middle, NULL);
    mpq_set(l, low), mpq_set(h, high);
    while (!common && !sign) { /* until f has no root there */
        if (poly_sign(f, l) && poly_sign(f, h) && variations(sturm, l) == variations(sturm, h)) sign = poly_sign(f, l);
        mpq_add(middle, l, h);
        mpq_div_2exp(middle, middle, 1);
        int at = poly_sign(&s->all, middle);
        if (!at) { /* the root itself */
            sign = poly_sign(f, middle);
            break;
        }
        if (at == poly_sign(&s->all, l))
            mpq_set(l, middle);
        else
            mpq_set(h, middle);
    }
    mpq_clears(l, h, middle, NULL);
    chain_free(sturm);
    poly_clear(&g);
    return sign;
}

static bool meet_at_root(const stretch *s, mpq_t low, mpq_t high) {
    int turns[4], gaps[8] = {0};
    for (int i = 0; i < 4; i++) turns[i] = sign_at_root(s, &s->turn[i], low, high);
    bool flat = !turns[0] && !turns[1] && !turns[2] && !turns[3];
    for (int i = 0; i < 8 && flat; i++) gaps[i] = sign_at_root(s, &s->gap[i], low, high);
    return meet_by_signs(turns, gaps);
}

/* What two objects do, told instant by instant and gap by gap. */
typedef struct story {
    oracle_contacts *out;
    bool now, fresh; /* fresh: nothing told yet */
} story;

static void tell_instant(story *s, bool meets, const mpq_t low, const mpq_t high) {
    if (meets && !s->now) {
        assert(s->out->count < ORACLE_MOST);
        oracle_contact *c = &s->out->list[s->out->count++];
        mpq_set(c->begin[0], low), mpq_set(c->begin[1], high);
        c->instant = true;
        c->since_start = s->fresh;
    }
    if (meets) {
        oracle_contact *c = &s->out->list[s->out->count - 1];
        mpq_set(c->end[0], low), mpq_set(c->end[1], high);
    }
    s->now = meets;
    s->fresh = false;
}

static void tell_gap(story *s, bool meets) {
    assert(!meets || s->now);
    if (meets) s->out->list[s->out->count - 1].instant = false;
    s->now = meets;
}

/* Between low and high, and no root: mostly not the middle, which likes to be one. */
static void split(const stretch *s, const mpq_t low, const mpq_t high, mpq_t out) {
    mpq_t share;
    mpq_init(share);
    for (unsigned long eighths = 9; eighths; eighths += 2) {
        mpq_set_ui(share, eighths, 16);
        mpq_sub(out, high, low);
        mpq_mul(out, out, share);
        mpq_add(out, out, low);
        if (poly_sign(&s->all, out)) break;
        eighths = eighths == 15 ? 0 : eighths; /* 9, 11, 13, 15, 3, 5, 7 sixteenths */
    }
    mpq_clear(share);
}

/* The k-th root of `all` after `from`, narrowed; neither end is a root. */
static void find_root(const stretch *s, int before, int k, mpq_t low, mpq_t high) {
    mpq_t middle, width, least;
    mpq_inits(middle, width, least, NULL);
    mpq_sub(least, s->to, s->from);
    mpq_div_2exp(least, least, CLOSE);
    mpq_set(low, s->from), mpq_set(high, s->to);
    while (!poly_sign(&s->all, low) || !poly_sign(&s->all, high) || variations(s->sturm, high) - before != -k ||
           variations(s->sturm, low) - before != 1 - k) {
        split(s, low, high, middle);
        mpq_set(before - variations(s->sturm, middle) >= k ? high : low, middle);
    }
    int sign = poly_sign(&s->all, low);
    for (mpq_sub(width, high, low); mpq_cmp(width, least) > 0; mpq_sub(width, high, low)) {
        split(s, low, high, middle);
        mpq_set(poly_sign(&s->all, middle) == sign ? low : high, middle);
    }
    mpq_clears(middle, width, least, NULL);
}

static void tell_stretch(const stretch *s, story *tale, bool first) {
    if (first) tell_instant(tale, meet_at(s, s->from), s->from, s->from);
    mpq_t low, high, last, middle;
    mpq_inits(low, high, last, middle, NULL);
    mpq_set(last, s->from);
    int before = variations(s->sturm, s->from);
    int count = before - variations(s->sturm, s->to) - !poly_sign(&s->all, s->to);
    for (int k = 1; k <= count; k++) {
        find_root(s, before, k, low, high);
        if (mpq_cmp(low, last) < 0) mpq_set(low, last);
        mpq_add(middle, last, low);
        mpq_div_2exp(middle, middle, 1);
        while (!poly_sign(&s->all, middle)) mpq_add(middle, middle, low), mpq_div_2exp(middle, middle, 1);
        tell_gap(tale, meet_at(s, middle));
        tell_instant(tale, meet_at_root(s, low, high), low, high);
        mpq_set(last, high);
    }
    mpq_add(middle, last, s->to);
    mpq_div_2exp(middle, middle, 1);
    tell_gap(tale, meet_at(s, middle));
    tell_instant(tale, meet_at(s, s->to), s->to, s->to);
    mpq_clears(low, high, last, middle, NULL);
}

static void stretch_set(stretch *s, const froe_motion *m, const uint32_t v[4], double from, double to) {
    curve c[4];
    for (int i = 0; i < 4; i++) {
        poly_init(&c[i].x[0]), poly_init(&c[i].x[1]), poly_init(&c[i].w);
        curve_set(&c[i], m, v[i], from);
    }
    for (int i = 0; i < 2; i++) {
        turn(&s->turn[i], &c[0], &c[1], &c[2 + i]);
        turn(&s->turn[2 + i], &c[2], &c[3], &c[i]);
    }
    mpq_set_d(s->from, from), mpq_set_d(s->to, to);
    s->flat = true;
    for (int i = 0; i < 4; i++) s->flat = s->flat && s->turn[i].degree < 0;
    for (int i = 0; i < 8; i++) difference(&s->gap[i], &c[i >> 1 & 1], &c[2 + (i & 1)], i >> 2);
    poly product, part;
    poly_init(&product), poly_init(&part);
    mpz_set_ui(s->all.c[0], 1);
    s->all.degree = 0;
    for (int i = 0; i < (s->flat ? 8 : 4); i++) {
        const poly *f = s->flat ? &s->gap[i] : &s->turn[i];
        if (f->degree < 1) continue;
        poly_squarefree(&part, f);
        if (!has_roots(&part, s->from, s->to)) continue;
        poly_mul(&product, &s->all, &part);
        poly_squarefree(&s->all, &product);
    }
    s->sturm = chain_of(&s->all);
    poly_clear(&product), poly_clear(&part);
    for (int i = 0; i < 4; i++) {
        poly_clear(&c[i].x[0]), poly_clear(&c[i].x[1]), poly_clear(&c[i].w);
    }
}

static void stretch_init(stretch *s) {
    for (int i = 0; i < 4; i++) poly_init(&s->turn[i]);
    for (int i = 0; i < 8; i++) poly_init(&s->gap[i]);
    poly_init(&s->all);
    mpq_inits(s->from, s->to, NULL);
}

static void stretch_clear(stretch *s) {
    for (int i = 0; i < 4; i++) poly_clear(&s->turn[i]);
    for (int i = 0; i < 8; i++) poly_clear(&s->gap[i]);
    poly_clear(&s->all);
    mpq_clears(s->from, s->to, NULL);
}

/* ------------------------------------------------------------------ two objects -- */

void oracle_contacts_init(oracle_contacts *c) {
    c->count = 0;
    for (int i = 0; i < ORACLE_MOST; i++)
        for (int k = 0; k < 2; k++) mpq_inits(c->list[i].begin[k], c->list[i].end[k], NULL);
}

void oracle_contacts_clear(oracle_contacts *c) {
    for (int i = 0; i < ORACLE_MOST; i++)
        for (int k = 0; k < 2; k++) mpq_clears(c->list[i].begin[k], c->list[i].end[k], NULL);
}

static double next_knot(const froe_motion *m, const uint32_t v[4], double from, double to) {
    for (int i = 0; i < 4; i++) {
        const uint32_t body = froe_motion_vertex_body(m, v[i]);
        for (size_t k = 0; k < froe_motion_body_knot_count(m, body); k++) {
            double t = froe_motion_body_knot(m, body, k).time;
            if (t > from && t < to) to = t;
        }
        for (size_t k = 0; k < froe_motion_knot_count(m, v[i]); k++) {
            double t = froe_motion_knot(m, v[i], k).time;
            if (t > from && t < to) to = t;
        }
    }
    return to;
}

void oracle_contacts_find(oracle_contacts *out, const froe_motion *m, uint32_t a, uint32_t b) {
    froe_moving_object p = froe_motion_object(m, a), q = froe_motion_object(m, b);
    const uint32_t v[4] = {p.vertices[0], p.vertices[1], q.vertices[0], q.vertices[1]};
    double from = fmax(p.birth, q.birth), to = fmin(p.death, q.death);
    story tale = {out, false, true};
    stretch s;
    out->count = 0;
    if (from > to) return;
    stretch_init(&s);
    if (from == to) {
        stretch_set(&s, m, v, from, to);
        tell_instant(&tale, meet_at(&s, s.from), s.from, s.from);
        chain_free(s.sturm);
    }
    for (bool first = true; from < to; first = false) {
        double end = next_knot(m, v, from, to);
        if (hulls_apart(m, v, from)) {
            assert(!tale.now);
            tale.fresh = false;
        } else {
            stretch_set(&s, m, v, from, end);
            tell_stretch(&s, &tale, first);
            chain_free(s.sturm);
        }
        from = end;
    }
    for (int i = 0; i < out->count; i++) out->list[i].to_stop = tale.now && i + 1 == out->count;
    stretch_clear(&s);
}
