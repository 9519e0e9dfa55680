/* nearest.c: see nearest.h. All in dyadic numbers; doubles only tell which of two dyadic numbers need not be computed.
 */
#include "geom/high/nearest.h"
#include "num/ball.h"
#include "num/solve.h"
#include <string.h>

typedef struct nearest_search {
    num_context *context;
    num_arena *arena; /* its own */
    const geom_gaps *gaps;
    int dim;
    geom_simplex simplex;                        /* affinely independent */
    num_dyadic first[FROE_MAX_DIM];              /* its difference 0 */
    num_dyadic edge[GEOM_SIMPLEX][FROE_MAX_DIM]; /* from there to each other one */
} nearest_search;

/* ------------------------------------------------------------------- faces -- */

static num_dyadic difference_at(num_arena *arena, const geom_gaps *gaps, uint32_t i, uint32_t j, int k) {
    return num_dyadic_sub(arena, num_dyadic_from(arena, geom_convex_coordinate(gaps->a, i, k)),
                          num_dyadic_from(arena, geom_convex_coordinate(gaps->b, j, k)));
}

static num_dyadic dot(num_arena *arena, int dim, const num_dyadic *a, const num_dyadic *b) {
    const size_t mark = arena->top;
    num_dyadic sum = {0};
    for (int k = 0; k < dim; k++) sum = num_dyadic_add(arena, sum, num_dyadic_mul(arena, a[k], b[k]));
    return num_dyadic_keep(arena, mark, sum);
}

/* The differences of the simplex as vectors. */
static void place_simplex(nearest_search *s) {
    const geom_simplex *at = &s->simplex;
    for (int k = 0; k < s->dim; k++) {
        s->first[k] = difference_at(s->arena, s->gaps, at->a[0], at->b[0], k);
        s->edge[0][k] = (num_dyadic){0};
        for (int i = 1; i < at->count; i++)
            s->edge[i][k] =
                num_dyadic_sub(s->arena, difference_at(s->arena, s->gaps, at->a[i], at->b[i], k), s->first[k]);
    }
}

static void vector_between(nearest_search *s, int from, int to, num_dyadic *out) {
    for (int k = 0; k < s->dim; k++) out[k] = num_dyadic_sub(s->arena, s->edge[to][k], s->edge[from][k]);
}

/* The point nearest to 0 of the affine hull of the differences in `mask`, times the scale, and its weights. False:
 * they are dependent. With e from difference f to each other one:  sum of t_i e_i . e_j = - f . e_j. */
static bool face_nearest(nearest_search *s, unsigned mask, geom_nearest *out) {
    num_arena *arena = s->arena;
    num_dyadic e[GEOM_SIMPLEX][FROE_MAX_DIM], f[FROE_MAX_DIM];
    int of[GEOM_SIMPLEX], from = __builtin_ctz(mask), m = 0;
    for (int i = from + 1; i < s->simplex.count; i++) {
        if (!(mask >> i & 1)) continue;
        vector_between(s, from, i, e[m]);
        of[m++] = i;
    }
    for (int k = 0; k < s->dim; k++) f[k] = num_dyadic_add(arena, s->first[k], s->edge[from][k]);
    num_table t = {.rows = m, .columns = m + 1};
    const size_t mark = arena->top;
    for (int i = 0; i < m; i++) {
        for (int j = 0; j < m; j++) t.at[i][j] = j < i ? t.at[j][i] : dot(arena, s->dim, e[i], e[j]);
        t.at[i][m] = dot(arena, s->dim, e[i], f);
        t.at[i][m].sign *= -1;
    }
    num_table_solve(arena, mark, &t, m);
    if (t.rank < m) return false;
    const int sign = t.scale.sign; /* rows may have changed places */
    out->scale = t.scale;
    out->scale.sign = 1;
    num_dyadic rest = out->scale;
    for (int i = 0; i < GEOM_SIMPLEX; i++) out->weight[i] = (num_dyadic){0};
    for (int i = 0; i < m; i++) {
        num_dyadic *weight = &out->weight[of[i]];
        *weight = t.at[i][m];
        weight->sign *= sign;
        rest = num_dyadic_sub(arena, rest, *weight);
    }
    out->weight[from] = rest;
    for (int k = 0; k < s->dim; k++) {
        const size_t top = arena->top;
        num_dyadic sum = num_dyadic_mul(arena, out->scale, f[k]);
        for (int i = 0; i < m; i++)
            sum = num_dyadic_add(arena, sum, num_dyadic_mul(arena, out->weight[of[i]], e[i][k]));
        out->x[k] = num_dyadic_keep(arena, top, sum);
    }
    return true;
}

/* Does difference i keep the face of `mask` from being the one with the nearest point: has it a negative weight, or
 * lies it before the plane across x? */
static bool is_wrong(nearest_search *s, unsigned mask, int i, const geom_nearest *at) {
    if (mask >> i & 1) return at->weight[i].sign < 0;
    const size_t top = s->arena->top;
    num_dyadic e[FROE_MAX_DIM];
    vector_between(s, __builtin_ctz(mask), i, e);
    const int sign = dot(s->arena, s->dim, at->x, e).sign;
    s->arena->top = top;
    return sign < 0;
}

/* Reduces the simplex to the face with the point nearest to 0. False: its differences are dependent. */
static bool reduce_simplex(nearest_search *s, geom_nearest *out) {
    unsigned mask = (1u << s->simplex.count) - 1;
    place_simplex(s);
    const size_t top = s->arena->top;
    for (;;) {
        s->arena->top = top;
        if (!face_nearest(s, mask, out)) return false;
        int wrong = s->simplex.count - 1;
        while (wrong >= 0 && !is_wrong(s, mask, wrong, out)) wrong--;
        if (wrong < 0) break;
        mask ^= 1u << wrong;
    }
    int count = 0;
    for (int i = 0; i < s->simplex.count; i++) {
        if (!out->weight[i].sign) continue;
        s->simplex.a[count] = s->simplex.a[i];
        s->simplex.b[count] = s->simplex.b[i];
        out->weight[count++] = out->weight[i];
    }
    s->simplex.count = count;
    return true;
}

/* -------------------------------------------------------------- improving -- */

/* A direction, exactly and in doubles of which the greatest is 1: NaN where doubles are not to be trusted. */
typedef struct direction {
    const num_dyadic *x;
    int dim;
    double image[FROE_MAX_DIM];
} direction;

static direction direction_of(num_context *context, int dim, const num_dyadic *x) {
    num_arena *arena = &context->arena;
    direction d = {.x = x, .dim = dim, .image = {NAN}};
    num_dyadic most = {0};
    const size_t top = arena->top;
    if (context->first == NUM_EXACT) return d;
    for (int k = 0; k < dim; k++) {
        num_dyadic size = x[k];
        size.sign = size.count > 0;
        if (num_dyadic_compare(size, most) > 0) most = size;
    }
    for (int k = 0; k < dim; k++) d.image[k] = num_dyadic_quotient(arena, x[k], most);
    arena->top = top;
    return d;
}

/* sign * x . (p - q), whose terms have relative errors of three roundings; and its sign. */
static int sign_along(num_arena *arena, const direction *d, int sign, const double *p, const double *q, double *value) {
    double sum = 0, size = 0, spread = 0;
    for (int k = 0; k < d->dim; k++) {
        const double step = p[k] - q[k], term = d->image[k] * step;
        sum += term;
        size += fabs(term);
        spread += fabs(step);
    }
    /* dim + 3 roundings at most, and images that underflow */
    const double error = 0x1p-48 * size + 0x1p-1073 * spread + NUM_BALL_TINY;
    *value = sign * sum;
    if (*value > error) return 1;
    if (*value < -error) return -1;
    const size_t top = arena->top;
    num_dyadic exact = {0};
    for (int k = 0; k < d->dim; k++) {
        const num_dyadic step = num_dyadic_sub(arena, num_dyadic_from(arena, p[k]), num_dyadic_from(arena, q[k]));
        exact = num_dyadic_add(arena, exact, num_dyadic_mul(arena, d->x[k], step));
    }
    arena->top = top;
    return sign * exact.sign;
}

static void put_corner_of(const geom_convex *c, uint32_t i, double *out) {
    for (int k = 0; k < c->dim; k++) out[k] = geom_convex_coordinate(c, i, k);
}

/* A corner of the set further back along sign * x than corner `from`, about the furthest; `from` if there is none. */
static uint32_t further_back(num_arena *arena, const geom_convex *c, const direction *d, int sign, uint32_t from) {
    double p[FROE_MAX_DIM], q[FROE_MAX_DIM], value, least = 0;
    uint32_t best = from, corner = 0;
    if (c->core == GEOM_CORE_BOX) {
        for (int k = 0; k < d->dim; k++) {
            const double lo = geom_convex_coordinate(c, 0, k), hi = geom_convex_coordinate(c, c->count - 1, k);
            const bool level = lo == hi || !d->x[k].sign;
            if (level ? from >> k & 1 : sign * d->x[k].sign < 0) corner |= 1u << k;
        }
        return corner;
    }
    put_corner_of(c, from, q);
    for (uint32_t i = 0; i < c->count; i++) {
        if (i == from) continue;
        put_corner_of(c, i, p);
        if (sign_along(arena, d, sign, p, q, &value) >= 0) continue;
        if (best == from || value < least) best = i, least = value;
    }
    return best;
}

static bool same_corner(const geom_convex *a, uint32_t i, const geom_convex *b, uint32_t j) {
    for (int k = 0; k < a->dim; k++)
        if (geom_convex_coordinate(a, i, k) != geom_convex_coordinate(b, j, k)) return false;
    return true;
}

/* Of a star: is a_i - b_j one of its differences, that lies before the plane across x? */
static bool before_in_star(nearest_search *s, const geom_nearest *at, uint32_t i, uint32_t j) {
    num_arena *arena = s->arena;
    const size_t top = arena->top;
    num_dyadic sum = {0};
    if (same_corner(s->gaps->a, i, s->gaps->b, j)) return false;
    for (int k = 0; k < s->dim; k++) {
        num_dyadic step = num_dyadic_sub(arena, difference_at(arena, s->gaps, i, j, k),
                                         difference_at(arena, s->gaps, s->simplex.a[0], s->simplex.b[0], k));
        sum = num_dyadic_add(arena, sum, num_dyadic_mul(arena, at->x[k], step));
    }
    arena->top = top;
    return sum.sign < 0;
}

/* Adds a difference that lies before the plane across x. False: there is none. */
static bool extend_simplex(nearest_search *s, const geom_nearest *at) {
    const geom_gaps *gaps = s->gaps;
    uint32_t i = s->simplex.a[0], j = s->simplex.b[0];
    if (gaps->star) {
        const uint32_t n = gaps->a->count, all = n + gaps->b->count;
        uint32_t found = 0;
        for (; found < all; found++) {
            i = found < n ? found : gaps->star_a;
            j = found < n ? gaps->star_b : found - n;
            if (before_in_star(s, at, i, j)) break;
        }
        if (found == all) return false;
    } else {
        const direction d = direction_of(s->context, s->dim, at->x);
        i = further_back(s->arena, gaps->a, &d, 1, i);
        j = further_back(s->arena, gaps->b, &d, -1, j);
        if (i == s->simplex.a[0] && j == s->simplex.b[0]) return false;
    }
    s->simplex.a[s->simplex.count] = i;
    s->simplex.b[s->simplex.count++] = j;
    return true;
}

/* Any difference that counts. */
static bool first_difference(const geom_gaps *gaps, geom_simplex *out) {
    *out = (geom_simplex){.count = 1};
    if (!gaps->star) return true;
    for (uint32_t n = gaps->a->count, i = 0; i < n + gaps->b->count; i++) {
        out->a[0] = i < n ? i : gaps->star_a;
        out->b[0] = i < n ? gaps->star_b : i - n;
        if (!same_corner(gaps->a, out->a[0], gaps->b, out->b[0])) return true;
    }
    return false;
}

bool geom_nearest_find(num_context *context, const geom_gaps *gaps, const geom_simplex *guess, geom_nearest *out) {
    num_arena *arena = &context->arena;
    nearest_search s = {.context = context, .arena = arena, .gaps = gaps, .dim = gaps->a->dim, .simplex = *guess};
    const size_t base = arena->top;
    for (int k = 0; k < FROE_MAX_DIM; k++) out->x[k] = (num_dyadic){0};
    if (!s.simplex.count && !first_difference(gaps, &s.simplex)) return false;
    do {
        arena->top = base;
        if (!reduce_simplex(&s, out)) { /* the guess was no simplex */
            first_difference(gaps, &s.simplex);
            arena->top = base;
            reduce_simplex(&s, out);
        }
        out->zero = true;
        for (int k = 0; k < s.dim; k++) out->zero = out->zero && !out->x[k].sign;
    } while (!out->zero && extend_simplex(&s, out));
    out->simplex = s.simplex;
    /* x / scale is across the simplex: its square is that of any of the differences along it */
    num_dyadic first[FROE_MAX_DIM];
    for (int k = 0; k < s.dim; k++) first[k] = difference_at(arena, gaps, s.simplex.a[0], s.simplex.b[0], k);
    out->square = (num_ratio){dot(arena, s.dim, out->x, first), out->scale};
    return true;
}
