/* apart.c: see apart.h. */
#include "geom/meet/apart.h"
#include "geom/high/guess.h"
#include "geom/meet/gap.h"
#include "geom/meet/meet.h"
#include "geom/predicates.h"
#include "num/pair.h"

typedef struct apart_search {
    num_context *context;
    const geom_body *a, *b;
    geom_convex set_a, set_b;
    geom_simplex simplex; /* of the guess */
    bool meeting;         /* for certain, without their radii */
    double *rows;
} apart_search;

/* ------------------------------------------------------------------- checking -- */

/* -1 or 1 where the body lies on one side of the plane, not wholly in it; else 0. */
static int side_of_body(num_context *context, const geom_plane *plane, const geom_body *body) {
    int side = 0;
    if (body->form == FROE_BALL || body->form == FROE_BOX) {
        side = body->form == FROE_BALL
                   ? geom_side_ball(context, plane, geom_body_point(body, 0), body->radius)
                   : geom_side_box(context, plane, geom_body_point(body, 0), geom_body_point(body, 1));
        return side == 2 ? 0 : side;
    }
    for (uint32_t i = 0; i < body->count; i++) {
        const int of_corner = geom_side_vertex(context, plane, geom_body_point(body, i));
        if (side * of_corner < 0) return 0;
        if (of_corner) side = of_corner;
    }
    return side;
}

static bool is_between(const apart_search *s, int row_count) {
    const int dim = s->a->dim;
    const geom_plane plane =
        row_count > 1 ? geom_plane_fine(dim, s->rows, row_count) : geom_plane_vector(dim, s->rows, s->rows[dim]);
    return side_of_body(s->context, &plane, s->a) == -1 && side_of_body(s->context, &plane, s->b) == 1;
}

/* -------------------------------------------------------------------- guessing -- */

/* The body without its radius. */
static geom_body core_of(const geom_body *body) {
    geom_body core = *body;
    if (core.form == FROE_BALL) core.form = FROE_POINT, core.radius = 0;
    return core;
}

/* The largest coordinate of both, radii included. */
static double greatest_coordinate(const geom_body *a, const geom_body *b) {
    double most = fmax(a->radius, b->radius);
    for (int side = 0; side < 2; side++) {
        const geom_body *body = side ? b : a;
        for (uint32_t i = 0; i < body->count; i++)
            for (int k = 0; k < body->dim; k++) most = fmax(most, fabs(geom_body_point(body, i)[k]));
    }
    return most;
}

/* About the direction from a to b, its longest coordinate 1. False: there is none, or it over- or underflows. */
static bool guess_direction(apart_search *s, double direction[FROE_MAX_DIM]) {
    const int dim = s->a->dim;
    if (dim <= 3) {
        const geom_body core_a = core_of(s->a), core_b = core_of(s->b);
        const geom_gap gap = geom_gap_between(s->context, &core_a, &core_b);
        s->meeting = gap.zero;
        s->simplex.count = gap.count;
        for (int i = 0; i < gap.count; i++) s->simplex.a[i] = gap.a[i], s->simplex.b[i] = gap.b[i];
        return !gap.zero && geom_gap_guess(&core_a, &core_b, &gap, direction);
    }
    const geom_guess guess = geom_guess_between(&s->set_a, &s->set_b);
    double most = 0;
    s->simplex = guess.simplex;
    for (int k = 0; k < dim; k++) most = fmax(most, fabs(guess.x[k]));
    if (most <= 0x1p-900) return false;
    for (int k = 0; k < dim; k++) direction[k] = guess.x[k] / -most;
    return true;
}

/* Halfway between what the two bodies reach along the direction, from corners of the simplex, times 2^power. */
static double value_between(const apart_search *s, const double *direction, int power) {
    num_pair sum = {0, 0}, square = {0, 0};
    for (int k = 0; k < s->a->dim; k++) {
        const double p = geom_convex_coordinate(&s->set_a, s->simplex.a[0], k),
                     q = geom_convex_coordinate(&s->set_b, s->simplex.b[0], k);
        sum = num_pair_add(sum, num_pair_product(direction[k], ldexp(p, power - 1)));
        sum = num_pair_add(sum, num_pair_product(direction[k], ldexp(q, power - 1)));
        square = num_pair_add(square, num_pair_product(direction[k], direction[k]));
    }
    const double ra = s->set_a.radius, rb = s->set_b.radius;
    const num_pair more = num_pair_sum(ldexp(ra, power - 1), -ldexp(rb, power - 1));
    if (ra != rb) sum = num_pair_add(sum, num_pair_mul(num_pair_sqrt(square), more));
    return sum.hi + sum.lo;
}

static bool guess_plane(apart_search *s) {
    const int dim = s->a->dim;
    double direction[FROE_MAX_DIM];
    int power;
    frexp(greatest_coordinate(s->a, s->b), &power);
    power = power > 1000 ? -1000 : power < -1000 ? 1000 : -power;
    if (!guess_direction(s, direction)) return false;
    s->rows[dim] = value_between(s, direction, power);
    for (int k = 0; k < dim; k++) s->rows[k] = ldexp(direction[k], power);
    return isfinite(s->rows[dim]) && is_between(s, 1);
}

/* --------------------------------------------------------------------- exactly -- */

/* The least power of two beyond |x|; that of 0 is far below those of other numbers. */
static int power_of(num_dyadic x) {
    return x.sign ? 64 * (x.exponent + (int)x.count) - __builtin_clzll(x.limbs[x.count - 1]) : INT32_MIN / 2;
}

/* The coefficients of the plane: the normal, then the value. The bodies do not meet. */
static void find_coefficients(apart_search *s, num_dyadic out[FROE_MAX_DIM + 1]) {
    num_arena *arena = num_fresh(s->context);
    const int dim = s->a->dim;
    const geom_gaps gaps = {.a = &s->set_a, .b = &s->set_b};
    geom_nearest at;
    num_dyadic value = {0};
    geom_nearest_find(s->context, &gaps, &s->simplex, &at);
    for (int k = 0; k < dim; k++) {
        const double p = geom_convex_coordinate(&s->set_a, at.simplex.a[0], k),
                     q = geom_convex_coordinate(&s->set_b, at.simplex.b[0], k);
        num_dyadic n = at.x[k], sum = num_dyadic_add(arena, num_dyadic_from(arena, p), num_dyadic_from(arena, q));
        n.sign = -n.sign;
        value = num_dyadic_add(arena, value, num_dyadic_mul(arena, n, sum));
        out[k] = num_dyadic_add(arena, n, n);
    }
    const num_dyadic ra = num_dyadic_from(arena, s->set_a.radius), rb = num_dyadic_from(arena, s->set_b.radius);
    const num_dyadic more =
        num_dyadic_mul(arena, num_dyadic_sub(arena, ra, rb), num_dyadic_add(arena, ra, rb)); /* r_a^2 - r_b^2 */
    out[dim] = num_dyadic_add(arena, value, num_dyadic_mul(arena, more, at.scale));
}

/* Each coefficient as the sum of one double a row, times 2^(-53 row). The greatest of the normal becomes about 1, or
 * less, so that the value is below 2^500. */
static void cut_into_rows(apart_search *s, const num_dyadic coefficients[FROE_MAX_DIM + 1]) {
    enum { MOST_VALUE = 500 };
    num_arena *arena = &s->context->arena;
    const int dim = s->a->dim;
    int power = power_of(coefficients[dim]) - MOST_VALUE;
    for (int k = 0; k < dim; k++)
        if (power_of(coefficients[k]) > power) power = power_of(coefficients[k]);
    for (int k = 0; k <= dim; k++) {
        num_dyadic rest = coefficients[k];
        const size_t top = arena->top;
        for (int i = 0; i < GEOM_FINE_ROWS; i++) {
            double *number = s->rows + i * (dim + 1) + k;
            const num_dyadic unit = num_dyadic_scaled(arena, 1, 1, power - 53 * i);
            *number = num_dyadic_quotient(arena, rest, unit);
            rest = num_dyadic_sub(arena, rest, num_dyadic_mul(arena, num_dyadic_from(arena, *number), unit));
            rest = num_dyadic_keep(arena, top, rest);
        }
        arena->top = top;
    }
}

int geom_apart(num_context *context, const geom_body *a, const geom_body *b, double rows[GEOM_APART_NUMBERS]) {
    apart_search s = {.context = context, .a = a, .b = b, .rows = rows};
    num_dyadic coefficients[FROE_MAX_DIM + 1];
    s.set_a = geom_convex_of(a);
    s.set_b = geom_convex_of(b);
    if (guess_plane(&s)) return 1;
    if (s.meeting || geom_meet(context, &s.set_a, &s.set_b)) return 0;
    find_coefficients(&s, coefficients);
    cut_into_rows(&s, coefficients);
    for (int count = 1; count < GEOM_FINE_ROWS; count *= 2)
        if (is_between(&s, count)) return count;
    return is_between(&s, GEOM_FINE_ROWS) ? GEOM_FINE_ROWS : 0;
}
