/* apart.c: see apart.h. */
#include "geom/meet/apart.h"
#include "geom/meet/gap.h"
#include "geom/meet/meet.h"
#include "geom/predicates.h"
#include "num/pair.h"

enum { LENGTHS = 256 }; /* at which the direction is rounded */

/* The body without its radius. */
static geom_body core_of(const geom_body *body) {
    geom_body core = *body;
    if (core.form == FROE_BALL) core.form = FROE_POINT, core.radius = 0;
    return core;
}

/* The largest coordinate of both, radii included. */
static double greatest_coordinate(const geom_body *a, const geom_body *b) {
    double most = fmax(a->form == FROE_BALL ? a->radius : 0, b->form == FROE_BALL ? b->radius : 0);
    for (int side = 0; side < 2; side++) {
        const geom_body *body = side ? b : a;
        for (uint32_t i = 0; i < body->count; i++)
            for (int k = 0; k < body->dim; k++) most = fmax(most, fabs(geom_body_point(body, i)[k]));
    }
    return most;
}

/* -1 or 1 where the body lies on one side of the plane, not wholly in it; else 0. */
static int side_of_body(num_context *context, const geom_plane *plane, const geom_body *body) {
    if (body->form == FROE_BALL) return geom_side_ball(context, plane, geom_body_point(body, 0), body->radius);
    int side = 0;
    for (uint32_t i = 0; i < geom_body_corners(body); i++) {
        double corner[3];
        geom_body_corner(body, i, corner);
        const int of_corner = geom_side_ball(context, plane, corner, 0);
        if (side * of_corner < 0) return 0;
        if (of_corner) side = of_corner;
    }
    return side;
}

/* Halfway between what the two bodies reach along the direction, from the corners of the gap, times 2^power. */
static double value_between(const geom_body *a, const geom_body *b, const geom_gap *gap, const double direction[3],
                            int power) {
    double p[3], q[3];
    geom_body_corner(a, gap->a[0], p);
    geom_body_corner(b, gap->b[0], q);
    num_pair sum = {0, 0}, square = {0, 0};
    for (int k = 0; k < a->dim; k++) {
        sum = num_pair_add(sum, num_pair_product(direction[k], ldexp(p[k], power - 1)));
        sum = num_pair_add(sum, num_pair_product(direction[k], ldexp(q[k], power - 1)));
        square = num_pair_add(square, num_pair_product(direction[k], direction[k]));
    }
    const double ra = a->form == FROE_BALL ? a->radius : 0, rb = b->form == FROE_BALL ? b->radius : 0;
    const num_pair more = num_pair_sum(ldexp(ra, power - 1), -ldexp(rb, power - 1));
    if (ra != rb) sum = num_pair_add(sum, num_pair_mul(num_pair_sqrt(square), more));
    return sum.hi + sum.lo;
}

/* The direction from a to b, its longest coordinate `length`: each coordinate is rounded once. */
static void round_direction(num_context *context, const geom_body *a, const geom_body *b, const geom_gap *gap,
                            double length, double out[3]) {
    num_arena *arena = num_fresh(context);
    num_dyadic x[3], most = {0};
    geom_gap_direction(arena, a, b, gap, x);
    for (int k = 0; k < 3; k++) {
        num_dyadic size = x[k];
        size.sign = size.count > 0;
        if (num_dyadic_compare(size, most) > 0) most = size;
    }
    for (int k = 0; k < 3; k++) {
        num_dyadic part = num_dyadic_mul(arena, x[k], num_dyadic_from(arena, -length));
        out[k] = num_dyadic_quotient(arena, part, most);
    }
}

/* The plane across a direction, checked. */
static bool try_direction(num_context *context, const geom_body *a, const geom_body *b, const geom_gap *gap,
                          const double direction[3], int power, double normal[3], double *value) {
    *value = value_between(a, b, gap, direction, power);
    if (!isfinite(*value)) return false;
    for (int k = 0; k < 3; k++) normal[k] = ldexp(direction[k], power);
    const geom_plane plane = geom_plane_vector(a->dim, normal, *value);
    return side_of_body(context, &plane, a) == -1 && side_of_body(context, &plane, b) == 1;
}

bool geom_apart(num_context *context, const geom_body *a, const geom_body *b, double normal[3], double *value) {
    const geom_body core_a = core_of(a), core_b = core_of(b);
    const geom_gap gap = geom_gap_between(context, &core_a, &core_b);
    double direction[3];
    int power;
    if (gap.zero) return false;
    frexp(greatest_coordinate(a, b), &power);
    power = power > 1000 ? -1000 : power < -1000 ? 1000 : -power;
    if (geom_gap_guess(&core_a, &core_b, &gap, direction) &&
        try_direction(context, a, b, &gap, direction, power, normal, value))
        return true;
    const geom_convex set_a = geom_convex_of(a), set_b = geom_convex_of(b);
    if (geom_meet(context, &set_a, &set_b)) return false;
    for (int i = 0; i < LENGTHS; i++) {
        round_direction(context, &core_a, &core_b, &gap, 1 - 0.4 * i / LENGTHS, direction);
        if (try_direction(context, a, b, &gap, direction, power, normal, value)) return true;
    }
    return false;
}
