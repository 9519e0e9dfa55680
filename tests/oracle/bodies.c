/* bodies.c: see bodies.h. Numbers are never changed and live until exact_begin(): formulas read as on paper. */
#include "oracle/bodies.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef mpz_srcptr num;
typedef exact_point vec;

static struct {
    mpz_t *chunks[4096];
    size_t used, made;
    int shift;
} pool;

enum { CHUNK = 4096 };

void exact_begin(int shift) {
    pool.used = 0;
    pool.shift = shift;
}

size_t exact_mark(void) {
    return pool.used;
}

void exact_release(size_t mark) {
    pool.used = mark;
}

static mpz_ptr fresh(void) {
    size_t chunk = pool.used / CHUNK, at = pool.used++ % CHUNK;
    if (pool.used > pool.made) {
        if (at == 0) pool.chunks[chunk] = malloc(CHUNK * sizeof(mpz_t));
        if (chunk >= 4096 || !pool.chunks[chunk]) abort();
        mpz_init(pool.chunks[chunk][at]);
        pool.made++;
    }
    return pool.chunks[chunk][at];
}

/* ----------------------------------------------------------------- numbers -- */

static num whole(long x) {
    mpz_ptr z = fresh();
    mpz_set_si(z, x);
    return z;
}
static num add(num a, num b) {
    mpz_ptr z = fresh();
    mpz_add(z, a, b);
    return z;
}
static num sub(num a, num b) {
    mpz_ptr z = fresh();
    mpz_sub(z, a, b);
    return z;
}
static num mul(num a, num b) {
    mpz_ptr z = fresh();
    mpz_mul(z, a, b);
    return z;
}
static num neg(num a) {
    mpz_ptr z = fresh();
    mpz_neg(z, a);
    return z;
}
static int sgn(num a) {
    return mpz_sgn(a);
}

/* x 2^power; must be whole. */
static num scaled(double x, int power) {
    int exponent;
    mpz_ptr z = fresh();
    double mantissa = frexp(x, &exponent);
    mpz_set_d(z, ldexp(mantissa, 53));
    exponent += power - 53;
    if (exponent >= 0)
        mpz_mul_2exp(z, z, (mp_bitcnt_t)exponent);
    else if (mpz_sgn(z) && !mpz_divisible_2exp_p(z, (mp_bitcnt_t)-exponent))
        abort();
    else
        mpz_tdiv_q_2exp(z, z, (mp_bitcnt_t)-exponent);
    return z;
}

int exact_shift(int shift, const double *x, size_t count) {
    for (size_t i = 0; i < count; i++) {
        int exponent;
        double mantissa = frexp(x[i], &exponent);
        if (x[i] == 0 || !isfinite(x[i])) continue;
        const int bits = 53 - __builtin_ctzll((uint64_t)fabs(ldexp(mantissa, 53)));
        if (bits - exponent > shift) shift = bits - exponent;
    }
    return shift;
}

static vec point_of(const double *x, int dim) {
    vec v;
    for (int k = 0; k < FROE_MAX_DIM; k++) v.x[k] = k < dim ? scaled(x[k], pool.shift) : whole(0);
    return v;
}

static vec minus(vec a, vec b) {
    vec v;
    for (int k = 0; k < FROE_MAX_DIM; k++) v.x[k] = sub(a.x[k], b.x[k]);
    return v;
}

static num dot(vec a, vec b, int dim) {
    num sum = whole(0);
    for (int k = 0; k < dim; k++) sum = add(sum, mul(a.x[k], b.x[k]));
    return sum;
}

static vec cross(vec a, vec b) {
    vec v = a;
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        v.x[k] = sub(mul(a.x[i], b.x[j]), mul(a.x[j], b.x[i]));
    }
    return v;
}

static num det(vec a, vec b, vec c) {
    return dot(cross(a, b), c, 3);
}

static bool is_zero(vec a, int dim) {
    for (int k = 0; k < dim; k++)
        if (sgn(a.x[k])) return false;
    return true;
}

static bool equal(vec a, vec b, int dim) {
    for (int k = 0; k < dim; k++)
        if (mpz_cmp(a.x[k], b.x[k])) return false;
    return true;
}

/* ------------------------------------------------------------------ values -- */

static exact_value quotient(num p, num s) {
    return sgn(s) > 0 ? (exact_value){p, whole(0), whole(0), s} : (exact_value){neg(p), whole(0), whole(0), neg(s)};
}

/* p + q sqrt(r) */
static int surd_sign(num p, num q, num r) {
    int a = sgn(p), b = sgn(q) * sgn(r);
    if (!b || a == b) return a;
    return a ? a * mpz_cmp(mul(p, p), mul(mul(q, q), r)) : b;
}

static int compare(const exact_value *a, const exact_value *b) {
    num p = sub(mul(a->p, b->s), mul(b->p, a->s)), x = mul(a->q, b->s), y = neg(mul(b->q, a->s));
    int first = surd_sign(p, x, a->r), second = sgn(y) * sgn(b->r); /* (p + x sqrt(r)) + y sqrt(r') */
    if (!second || first == second) return first;
    if (!first) return second;
    num rest = sub(add(mul(p, p), mul(mul(x, x), a->r)), mul(mul(y, y), b->r));
    return first * surd_sign(rest, mul(whole(2), mul(p, x)), a->r);
}

int exact_compare(const exact_value *a, const exact_value *b) {
    const size_t mark = pool.used;
    const int order = compare(a, b);
    pool.used = mark;
    return order;
}

exact_value exact_value_of(double x, int power) {
    int need = exact_shift(0, &x, 1), more = need > power ? need - power : 0;
    mpz_ptr s = fresh();
    mpz_set_ui(s, 1);
    mpz_mul_2exp(s, s, (mp_bitcnt_t)more);
    return quotient(scaled(x, power + more), s);
}

/* Half way between two neighbours, 2^1024 after the greatest double. */
static exact_value middle(double low, double high, int power) {
    exact_value a = exact_value_of(low, power + 1), b = exact_value_of(isinf(high) ? ldexp(1, 1023) : high, power + 1);
    num top = isinf(high) ? add(b.p, b.p) : b.p;
    num sum = add(mul(a.p, b.s), mul(top, a.s)), bottom = mul(mul(a.s, b.s), whole(4));
    return quotient(sum, bottom);
}

bool exact_rounds_to(const exact_value *v, double x, int power) {
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    bool even = (bits & 1) == 0;
    if (!(x >= 0)) return false;
    if (!isinf(x)) {
        exact_value high = middle(x, nextafter(x, INFINITY), power);
        int above = exact_compare(v, &high);
        if (above > 0 || (above == 0 && !even)) return false;
    }
    if (x == 0) return surd_sign(v->p, v->q, v->r) >= 0;
    exact_value low = middle(nextafter(x, 0), x, power);
    int above = exact_compare(v, &low);
    return above > 0 || (above == 0 && even);
}

exact_value exact_keep(size_t mark, const exact_value *v) {
    mpz_t copy[4];
    num from[4] = {v->p, v->q, v->r, v->s}, to[4];
    for (int i = 0; i < 4; i++) mpz_init_set(copy[i], from[i]);
    pool.used = mark;
    for (int i = 0; i < 4; i++) {
        mpz_ptr z = fresh();
        mpz_swap(z, copy[i]);
        mpz_clear(copy[i]);
        to[i] = z;
    }
    return (exact_value){to[0], to[1], to[2], to[3]};
}

/* ------------------------------------------------------------------ bodies -- */

exact_body exact_body_of(const geom_body *body) {
    exact_body b = {.form = body->form, .dim = body->dim, .radius = scaled(body->radius, pool.shift)};
    b.lo = b.hi = point_of(geom_body_point(body, 0), b.dim);
    if (b.form == FROE_BOX) b.hi = point_of(geom_body_point(body, 1), b.dim);
    if (b.form == FROE_BOX && b.dim > 3) return b;
    b.count = b.form == FROE_BOX ? 1 << b.dim : (int)body->count;
    if (b.count > EXACT_CORNERS) abort();
    for (int i = 0; i < b.count; i++) {
        if (b.form != FROE_BOX) b.corner[i] = point_of(geom_body_point(body, (uint32_t)i), b.dim);
        for (int k = 0; k < FROE_MAX_DIM && b.form == FROE_BOX; k++) b.corner[i].x[k] = (i >> k & 1 ? b.hi : b.lo).x[k];
    }
    return b;
}

/* The directions between corners; appends. */
static int directions(const exact_body *b, vec *out) {
    int n = 0;
    for (int i = 0; i < b->count; i++)
        for (int j = i + 1; j < b->count; j++) {
            vec d = minus(b->corner[j], b->corner[i]);
            if (!is_zero(d, 3)) out[n++] = d;
        }
    return n;
}

/* Rank of a set of vectors; *normal: of their plane, for rank 2. */
static int rank_of(const vec *d, int count, vec *normal) {
    if (!count) return 0;
    int second = 1;
    while (second < count && is_zero(cross(d[0], d[second]), 3)) second++;
    if (second >= count) return 1;
    *normal = cross(d[0], d[second]);
    for (int i = 0; i < count; i++)
        if (sgn(dot(*normal, d[i], 3))) return 3;
    return 2;
}

/* Along n, how do a and b lie? 2: apart, 1: touching at most, 0: interiors overlap. In both senses of n. */
static int separation(const exact_body *a, const exact_body *b, vec n) {
    const size_t mark = pool.used;
    num lo[2] = {NULL, NULL}, hi[2] = {NULL, NULL};
    const exact_body *body[2] = {a, b};
    for (int s = 0; s < 2; s++)
        for (int i = 0; i < body[s]->count; i++) {
            num h = dot(n, body[s]->corner[i], 3);
            if (!lo[s] || mpz_cmp(h, lo[s]) < 0) lo[s] = h;
            if (!hi[s] || mpz_cmp(h, hi[s]) > 0) hi[s] = h;
        }
    int before = mpz_cmp(hi[0], lo[1]), after = mpz_cmp(hi[1], lo[0]);
    exact_release(mark);
    return before < 0 || after < 0 ? 2 : before == 0 || after == 0;
}

/* Is w in the cone of these vectors? By Caratheodory some three independent ones, or fewer, do. */
static bool find_cone(const vec *g, int count, vec w) {
    if (is_zero(w, 3)) return true;
    for (int i = 0; i < count; i++) {
        if (is_zero(cross(g[i], w), 3) && sgn(dot(g[i], w, 3)) > 0) return true;
        for (int j = 0; j < i; j++) {
            vec n = cross(g[i], g[j]);
            if (is_zero(n, 3)) continue;
            if (!sgn(dot(n, w, 3)) && sgn(det(g[i], w, n)) * sgn(det(g[i], g[j], n)) >= 0 &&
                sgn(det(w, g[j], n)) * sgn(det(g[i], g[j], n)) >= 0)
                return true;
            for (int k = 0; k < j; k++) {
                int way = sgn(det(g[i], g[j], g[k]));
                if (way && sgn(det(w, g[j], g[k])) * way >= 0 && sgn(det(g[i], w, g[k])) * way >= 0 &&
                    sgn(det(g[i], g[j], w)) * way >= 0)
                    return true;
            }
        }
    }
    return false;
}

static bool in_cone(const vec *g, int count, vec w) {
    const size_t mark = pool.used;
    const bool in = find_cone(g, count, w);
    exact_release(mark);
    return in;
}

static int generators(const exact_body *b, vec x, vec *out) {
    int n = 0;
    for (int i = 0; i < b->count; i++) {
        vec d = minus(b->corner[i], x);
        if (!is_zero(d, 3)) out[n++] = d;
    }
    return n;
}

static bool pointed(const vec *g, int count) {
    for (int i = 0; i < count; i++)
        if (in_cone(g, count,
                    minus((vec){.x = {whole(0), whole(0), whole(0), whole(0), whole(0), whole(0), whole(0), whole(0)}},
                          g[i])))
            return false;
    return true;
}

/* Bodies with the corner x in common: nothing else? Their cones share no ray: none of the edges of either, and no
 * line where faces of both meet. */
static bool alone(const exact_body *a, const exact_body *b, vec x) {
    vec g[EXACT_CORNERS], h[EXACT_CORNERS];
    int n = generators(a, x, g), m = generators(b, x, h);
    if (!pointed(g, n) || !pointed(h, m)) return false;
    for (int i = 0; i < n; i++)
        if (in_cone(h, m, g[i])) return false;
    for (int j = 0; j < m; j++)
        if (in_cone(g, n, h[j])) return false;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < i; j++)
            for (int k = 0; k < m; k++)
                for (int l = 0; l < k; l++) {
                    const size_t mark = pool.used;
                    vec ray = cross(cross(g[i], g[j]), cross(h[k], h[l])),
                        back = cross(cross(h[k], h[l]), cross(g[i], g[j]));
                    if (is_zero(ray, 3)) continue;
                    if (in_cone(g, n, ray) && in_cone(h, m, ray)) return false;
                    if (in_cone(g, n, back) && in_cone(h, m, back)) return false;
                    exact_release(mark);
                }
    return true;
}

static bool one_corner(const exact_body *a, const exact_body *b) {
    for (int i = 0; i < a->count; i++)
        for (int j = 0; j < b->count; j++)
            if (equal(a->corner[i], b->corner[j], 3)) return alone(a, b, a->corner[i]);
    return false;
}

static int polytopes_contact(const exact_body *a, const exact_body *b, bool *corner) {
    static vec d[EXACT_CORNERS * EXACT_CORNERS];
    vec normal, gap = minus(b->corner[0], a->corner[0]);
    int of_a = directions(a, d), count = of_a + directions(b, d + of_a), worst = 0;
    int rank_a = rank_of(d, of_a, &normal), rank_b = rank_of(d + of_a, count - of_a, &normal);
    int rank = rank_of(d, count, &normal);
    if (rank == 0 && !is_zero(gap, 3)) return 0;
    if (rank == 1 && !is_zero(cross(d[0], gap), 3)) return 0;
    if (rank == 2 && sgn(dot(normal, gap, 3))) return 0;
    for (int i = 0; i < count && rank; i++) {
        if (rank == 1) worst = separation(a, b, d[0]);
        for (int j = 0; j < i && rank == 3; j++) {
            vec n = cross(d[i], d[j]);
            int s = is_zero(n, 3) ? 0 : separation(a, b, n);
            worst = s > worst ? s : worst;
        }
        int s = rank == 2 ? separation(a, b, cross(d[i], normal)) : 0;
        worst = s > worst ? s : worst;
        if (worst == 2) return 0;
    }
    *corner = worst == 1 && one_corner(a, b);
    return worst == 1 ? 2 : rank == (rank_a > rank_b ? rank_a : rank_b) ? 3 : 1;
}

/* Any dimension, from the definitions: intervals, whose relative interiors are open or single points. */
static int boxes_contact(const exact_body *a, const exact_body *b, bool *corner) {
    int ranks[3] = {0, 0, 0};
    bool inner = true;
    *corner = true;
    for (int k = 0; k < a->dim; k++) {
        num lo = mpz_cmp(a->lo.x[k], b->lo.x[k]) > 0 ? a->lo.x[k] : b->lo.x[k];
        num hi = mpz_cmp(a->hi.x[k], b->hi.x[k]) < 0 ? a->hi.x[k] : b->hi.x[k];
        int wide_a = mpz_cmp(a->lo.x[k], a->hi.x[k]) < 0, wide_b = mpz_cmp(b->lo.x[k], b->hi.x[k]) < 0;
        int shared = mpz_cmp(lo, hi);
        if (shared > 0) return 0;
        ranks[0] += wide_a, ranks[1] += wide_b, ranks[2] += wide_a && wide_b;
        bool in_a = !wide_a || (mpz_cmp(a->lo.x[k], hi) < 0 && mpz_cmp(lo, a->hi.x[k]) < 0);
        bool in_b = !wide_b || (mpz_cmp(b->lo.x[k], hi) < 0 && mpz_cmp(lo, b->hi.x[k]) < 0);
        inner = inner && in_a && in_b && !(wide_a && wide_b && shared == 0);
        bool end_a = !mpz_cmp(lo, a->lo.x[k]) || !mpz_cmp(lo, a->hi.x[k]);
        bool end_b = !mpz_cmp(lo, b->lo.x[k]) || !mpz_cmp(lo, b->hi.x[k]);
        *corner = *corner && shared == 0 && end_a && end_b;
    }
    *corner = *corner && !inner;
    return !inner ? 2 : ranks[2] == (ranks[0] < ranks[1] ? ranks[0] : ranks[1]) ? 3 : 1;
}

/* --------------------------------------------------------------- distances -- */

static exact_value least(exact_value best, exact_value other) {
    return !best.s || exact_compare(&other, &best) < 0 ? other : best;
}

/* Squared distance of 0 from the affine hull of vectors, if its nearest point is in their hull; s NULL if not. */
static exact_value from_simplex(const vec *v, int count) {
    exact_value none = {NULL, NULL, NULL, NULL};
    if (count == 1) return quotient(dot(v[0], v[0], 3), whole(1));
    vec e = minus(v[1], v[0]);
    if (count == 2) {
        num t = neg(dot(v[0], e, 3)), ee = dot(e, e, 3);
        if (!sgn(ee) || sgn(t) < 0 || mpz_cmp(t, ee) > 0) return none;
        return quotient(sub(mul(dot(v[0], v[0], 3), ee), mul(t, t)), ee);
    }
    vec f = minus(v[2], v[0]), n = cross(e, f);
    num nn = dot(n, n, 3), h = dot(n, v[0], 3);
    if (!sgn(nn)) return none;
    for (int i = 0; i < 3; i++)
        if (sgn(det(v[i], v[(i + 1) % 3], n)) < 0) return none;
    return quotient(mul(h, h), nn);
}

static bool in_tetrahedron(const vec v[4]) {
    int way = sgn(det(minus(v[1], v[0]), minus(v[2], v[0]), minus(v[3], v[0])));
    return way && sgn(det(v[1], v[2], v[3])) * way >= 0 && sgn(det(v[0], v[3], v[2])) * way >= 0 &&
           sgn(det(v[0], v[1], v[3])) * way >= 0 && sgn(det(v[0], v[2], v[1])) * way >= 0;
}

/* Squared distance of a point from the hull of the corners: some simplex of them holds the nearest point. */
static exact_value square_from_hull(vec point, const exact_body *b) {
    exact_value best = {NULL, NULL, NULL, NULL};
    vec v[4];
    for (int i = 0; i < b->count; i++) {
        v[0] = minus(b->corner[i], point);
        best = least(best, from_simplex(v, 1));
        for (int j = 0; j < i; j++) {
            v[1] = minus(b->corner[j], point);
            exact_value d = from_simplex(v, 2);
            if (d.s) best = least(best, d);
            for (int k = 0; k < j; k++) {
                v[2] = minus(b->corner[k], point);
                d = from_simplex(v, 3);
                if (d.s) best = least(best, d);
                for (int l = 0; l < k && b->form != FROE_POLYGON; l++) {
                    v[3] = minus(b->corner[l], point);
                    if (in_tetrahedron(v)) return quotient(whole(0), whole(1));
                }
            }
        }
    }
    return best;
}

static exact_value square_from_box(vec point, const exact_body *b) {
    num sum = whole(0);
    for (int k = 0; k < b->dim; k++) {
        num below = sub(b->lo.x[k], point.x[k]), above = sub(point.x[k], b->hi.x[k]);
        if (sgn(below) > 0) sum = add(sum, mul(below, below));
        if (sgn(above) > 0) sum = add(sum, mul(above, above));
    }
    return quotient(sum, whole(1));
}

exact_value exact_distance(const double *point, const exact_body *b) {
    vec x = point_of(point, b->dim);
    bool hull = b->form == FROE_SEGMENT || b->form == FROE_POLYGON || b->form == FROE_HULL;
    exact_value square = hull ? square_from_hull(x, b) : square_from_box(x, b);
    /* sqrt(p / s) - radius = (sqrt(p s) - radius s) / s */
    exact_value d = {b->form == FROE_BALL ? neg(mul(b->radius, square.s)) : whole(0), whole(1), mul(square.p, square.s),
                     square.s};
    exact_value zero = quotient(whole(0), whole(1));
    return exact_compare(&d, &zero) < 0 ? zero : d;
}

static int ball_contact(const exact_body *ball, const exact_body *b) {
    exact_body centre = *ball;
    bool hull = b->form == FROE_SEGMENT || b->form == FROE_POLYGON || b->form == FROE_HULL;
    exact_value s = hull ? square_from_hull(centre.lo, b) : square_from_box(centre.lo, b);
    num reach = b->form == FROE_BALL ? add(ball->radius, b->radius) : ball->radius;
    int sign = mpz_cmp(s.p, mul(mul(reach, reach), s.s));
    return sign > 0 ? 0 : sign < 0 ? 3 : 2;
}

int exact_contact(const exact_body *a, const exact_body *b, bool *corner) {
    bool boxes = (a->form == FROE_BOX || a->form == FROE_POINT) && (b->form == FROE_BOX || b->form == FROE_POINT);
    *corner = false;
    if (a->form == FROE_BALL) return ball_contact(a, b);
    if (b->form == FROE_BALL) return ball_contact(b, a);
    return boxes ? boxes_contact(a, b, corner) : polytopes_contact(a, b, corner);
}

/* -------------------------------------------------------------------- rays -- */

/* Slabs, any dimension: where the ray is within all of them. */
static bool ray_box(vec o, vec d, const exact_body *b, exact_value *t) {
    exact_value in = quotient(whole(0), whole(1)), out = {NULL, NULL, NULL, NULL};
    for (int k = 0; k < b->dim; k++) {
        int way = sgn(d.x[k]);
        if (!way && (mpz_cmp(o.x[k], b->lo.x[k]) < 0 || mpz_cmp(o.x[k], b->hi.x[k]) > 0)) return false;
        if (!way) continue;
        exact_value near = quotient(sub((way > 0 ? b->lo : b->hi).x[k], o.x[k]), d.x[k]);
        exact_value far = quotient(sub((way > 0 ? b->hi : b->lo).x[k], o.x[k]), d.x[k]);
        if (exact_compare(&near, &in) > 0) in = near;
        if (!out.s || exact_compare(&far, &out) < 0) out = far;
    }
    *t = in;
    return !out.s || exact_compare(&in, &out) <= 0;
}

static bool ray_ball(vec o, vec d, const exact_body *b, exact_value *t) {
    vec p = minus(o, b->lo);
    num a = dot(d, d, b->dim), h = dot(d, p, b->dim), c = sub(dot(p, p, b->dim), mul(b->radius, b->radius));
    num root = sub(mul(h, h), mul(a, c));
    *t = sgn(c) <= 0 ? quotient(whole(0), whole(1)) : (exact_value){neg(h), whole(-1), root, a};
    return sgn(c) <= 0 || (sgn(root) >= 0 && sgn(h) < 0);
}

/* Keeps the least parameter >= 0. */
static void keep(num top, num bottom, exact_value *best) {
    exact_value t = quotient(top, bottom);
    if (sgn(t.p) >= 0) *best = least(*best, t);
}

/* A corner, seen from the origin. */
static void ray_corner(vec d, vec v, int dim, exact_value *best) {
    if (!is_zero(cross(v, d), 3)) return;
    for (int k = 0; k < dim; k++)
        if (sgn(d.x[k])) {
            keep(v.x[k], d.x[k], best);
            return;
        }
}

static void ray_edge(vec d, vec v, vec w, exact_value *best) {
    vec e = minus(w, v), n = cross(d, e);
    if (is_zero(n, 3) || sgn(dot(n, v, 3))) return;    /* parallel: corners will do */
    num s = dot(cross(v, d), n, 3), nn = dot(n, n, 3); /* v + s/nn e = t d */
    if (sgn(s) < 0 || mpz_cmp(s, nn) > 0) return;
    keep(dot(cross(v, e), n, 3), nn, best);
}

static void ray_triangle(vec d, vec u, vec v, vec w, exact_value *best) {
    vec n = cross(minus(v, u), minus(w, u));
    num slope = dot(n, d, 3);
    int way = sgn(slope);
    if (!way || sgn(det(d, u, v)) * way < 0 || sgn(det(d, v, w)) * way < 0 || sgn(det(d, w, u)) * way < 0) return;
    keep(dot(n, u, 3), slope, best);
}

bool exact_ray(const double *origin, const double *direction, const exact_body *b, exact_value *t) {
    vec o = point_of(origin, b->dim), d = point_of(direction, b->dim), v[EXACT_CORNERS];
    if (b->form == FROE_BALL) return ray_ball(o, d, b, t);
    if (b->form == FROE_BOX || b->form == FROE_POINT) return ray_box(o, d, b, t);
    exact_value square = square_from_hull(o, b);
    *t = quotient(whole(0), whole(1));
    if (!sgn(square.p)) return true;
    t->s = NULL;
    for (int i = 0; i < b->count; i++) v[i] = minus(b->corner[i], o);
    for (int i = 0; i < b->count; i++) {
        ray_corner(d, v[i], b->dim, t);
        for (int j = 0; j < i; j++) {
            ray_edge(d, v[i], v[j], t);
            for (int k = 0; k < j; k++) ray_triangle(d, v[i], v[j], v[k], t);
        }
    }
    return t->s != NULL;
}
