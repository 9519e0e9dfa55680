/* contact.c: see high.h.
 *
 * Polytopes A and B meet iff 0 is in C, the hull of the differences of their corners. Their relative interiors meet iff
 * some point is a sum of all corners of A with positive weights, and of all of B: iff a weight that all corners have
 * can be positive, which is a linear program. They meet in one common corner x alone iff their cones there do: iff 0 is
 * not in the hull of the generators a - x and x - b (geom/meet/contact.c). */
#include "geom/high/guess.h"
#include "geom/high/high.h"
#include "geom/high/program.h"
#include "num/ladder.h"

typedef struct pair {
    num_context *context;
    int dim;
    geom_convex a, b;
} pair;

/* -------------------------------------------------------------------- ranks -- */

/* Vectors that are independent, as ends of which one is the first corner of its body. */
typedef struct span {
    int rank;
    double from[FROE_MAX_DIM][FROE_MAX_DIM], to[FROE_MAX_DIM][FROE_MAX_DIM];
} span;

/* Takes the vector from p to q up if it is independent of those before, which are less than dim. */
static void widen(num_context *context, span *s, int dim, const double *p, const double *q) {
    num_arena *arena = num_fresh(context);
    num_table t = {.rows = s->rank + 1, .columns = dim};
    for (int k = 0; k < dim; k++) s->from[s->rank][k] = p[k], s->to[s->rank][k] = q[k];
    for (int i = 0; i < t.rows; i++)
        for (int k = 0; k < dim; k++)
            t.at[i][k] =
                num_dyadic_sub(arena, num_dyadic_from(arena, s->to[i][k]), num_dyadic_from(arena, s->from[i][k]));
    num_table_solve(arena, 0, &t, dim);
    s->rank = t.rank;
}

static void widen_by(num_context *context, span *s, const geom_convex *c) {
    double first[FROE_MAX_DIM], x[FROE_MAX_DIM];
    for (int k = 0; k < c->dim; k++) first[k] = geom_convex_coordinate(c, 0, k);
    /* of a box the corners along its edges from the first one are enough */
    for (uint32_t i = 1; i < c->count && s->rank < c->dim; i = c->core == GEOM_CORE_BOX ? 2 * i : i + 1) {
        for (int k = 0; k < c->dim; k++) x[k] = geom_convex_coordinate(c, i, k);
        widen(context, s, c->dim, first, x);
    }
}

int geom_high_rank(num_context *context, const geom_body *body) {
    const geom_convex c = geom_convex_of(body);
    span s = {.rank = 0};
    widen_by(context, &s, &c);
    return s.rank;
}

/* Do relative interiors that meet overlap? rank of the meet = rank of a + rank of b - rank of C */
static bool overlap(num_context *context, const geom_convex *a, const geom_convex *b) {
    span of_a = {.rank = 0}, of_b = {.rank = 0}, of_both;
    widen_by(context, &of_a, a);
    if (of_a.rank == a->dim) return true;
    of_both = of_a;
    widen_by(context, &of_b, b);
    widen_by(context, &of_both, b);
    return of_both.rank == (of_a.rank > of_b.rank ? of_a.rank : of_b.rank);
}

/* ---------------------------------------------------------- relative interiors -- */

/* Rows: the coordinates of  sum v_i a_i - sum w_j b_j = 0,  and  sum v = 1, sum w = 1. The last column has the sums of
 * all others: its weight is one that all corners have. */
static void pair_column(const void *user, num_arena *arena, uint32_t j, num_dyadic *out) {
    const pair *p = user;
    const uint32_t n = p->a.count, m = p->b.count;
    const num_dyadic zero = {0}, one = num_dyadic_scaled(arena, 1, 1, 0);
    for (int k = 0; k < p->dim; k++) {
        const size_t mark = arena->top;
        out[k] = zero;
        if (j < n) out[k] = num_dyadic_from(arena, geom_convex_coordinate(&p->a, j, k));
        if (j >= n && j < n + m) out[k] = num_dyadic_from(arena, -geom_convex_coordinate(&p->b, j - n, k));
        for (uint32_t i = 0; i < n + m && j == n + m; i++) {
            const double x = i < n ? geom_convex_coordinate(&p->a, i, k) : -geom_convex_coordinate(&p->b, i - n, k);
            out[k] = num_dyadic_keep(arena, mark, num_dyadic_add(arena, out[k], num_dyadic_from(arena, x)));
        }
    }
    const bool both = j == n + m || j == GEOM_RIGHT_SIDE;
    out[p->dim] = both || j < n ? one : zero;
    out[p->dim + 1] = both || j >= n ? one : zero;
    if (j == n + m)
        out[p->dim] = num_dyadic_scaled(arena, 1, n, 0), out[p->dim + 1] = num_dyadic_scaled(arena, 1, m, 0);
}

/* As geom_guess has coordinates. */
static void pair_image(const void *user, uint32_t j, double *out) {
    const pair *p = user;
    const uint32_t n = p->a.count, m = p->b.count;
    for (int k = 0; k < p->dim; k++) {
        const double origin = geom_convex_coordinate(&p->a, 0, k);
        out[k] = 0;
        for (uint32_t i = 0; i < n + m; i++) {
            if (i != j && j != n + m) continue;
            out[k] +=
                i < n ? geom_convex_coordinate(&p->a, i, k) - origin : origin - geom_convex_coordinate(&p->b, i - n, k);
        }
        if (j == n + m) out[k] /= n + m;
    }
    const bool all = j == n + m, right = j == GEOM_RIGHT_SIDE;
    out[p->dim] = right || j < n ? 1 : all ? (double)n / (n + m) : 0;
    out[p->dim + 1] = right || (j >= n && !all) ? 1 : all ? (double)m / (n + m) : 0;
}

/* The polytopes meet. */
static bool interiors_meet(const pair *p) {
    const uint32_t corners = p->a.count + p->b.count;
    const geom_program program = {.rows = p->dim + 2,
                                  .columns = corners + 1,
                                  .goal = corners,
                                  .sense = -1,
                                  .user = p,
                                  .column = pair_column,
                                  .image = pair_image};
    return geom_program_solve(p->context, &program).sign > 0;
}

/* --------------------------------------------------------------------- both -- */

/* The first corner of both. */
static bool common_corner(const pair *p, uint32_t *i, uint32_t *j) {
    for (*i = 0; *i < p->a.count; ++*i)
        for (*j = 0; *j < p->b.count; ++*j) {
            int k = 0;
            while (k < p->dim && geom_convex_coordinate(&p->a, *i, k) == geom_convex_coordinate(&p->b, *j, k)) k++;
            if (k == p->dim) return true;
        }
    return false;
}

/* Do they meet in this corner of both alone? */
static bool meet_there_alone(const pair *p, uint32_t i, uint32_t j) {
    const geom_gaps star = {.a = &p->a, .b = &p->b, .star = true, .star_a = i, .star_b = j};
    const geom_simplex none = {.count = 0};
    geom_nearest at;
    num_fresh(p->context);
    return geom_nearest_find(p->context, &star, &none, &at) && !at.zero;
}

geom_contact geom_high_contact(num_context *context, const geom_body *a, const geom_body *b) {
    const geom_contact apart = {GEOM_APART, GEOM_TOUCH_SOMEHOW};
    const pair p = {.context = context, .dim = a->dim, .a = geom_convex_of(a), .b = geom_convex_of(b)};
    geom_guess guess = {.simplex = {.count = 0}};
    bool inside = false;
    uint32_t i, j;
    if (context->first != NUM_EXACT) {
        double least, most;
        guess = geom_guess_between(&p.a, &p.b);
        geom_guess_bounds(&guess, &p.a, &p.b, &least, &most);
        inside = geom_guess_inside(&guess, &p.a, &p.b);
        if (num_filtered_call(context, least > 0 || inside ? 1 : NUM_UNSURE) == 1 && !inside) return apart;
    }
    if (!inside && common_corner(&p, &i, &j)) {
        context->stats.calls++, context->stats.exact++;
        if (meet_there_alone(&p, i, j)) return (geom_contact){GEOM_TOUCH, GEOM_TOUCH_AT_CORNER};
    } else if (!inside) {
        const geom_gaps gaps = {.a = &p.a, .b = &p.b};
        geom_nearest at;
        num_fresh(context);
        context->stats.calls++, context->stats.exact++;
        geom_nearest_find(context, &gaps, &guess.simplex, &at);
        if (!at.zero) return apart;
    }
    if (!inside && !interiors_meet(&p)) return (geom_contact){GEOM_TOUCH, GEOM_TOUCH_SOMEHOW};
    return (geom_contact){overlap(context, &p.a, &p.b) ? GEOM_OVERLAP : GEOM_CROSS, GEOM_TOUCH_SOMEHOW};
}
