/* ray_hull.c: where does a line enter the hull of unordered corners?
 *
 *         o  d -->        Seen along d, the hull is that of the corners' shadows, and the line is a point. Of all
 *            .  c         triangles of corners whose shadow holds it, the one met first is looked for: a linear
 *      -----+-|---->      program with three constraints, solved by the simplex method. The gap search modulo d
 *            a|  b        finds a first triangle; a corner before its plane takes the place of one of the three.
 *
 * Always the corner with the lowest number comes and goes (Bland: New finite pivoting rules for the simplex method,
 * 1977), so that it ends although shadows coincide. Corners whose shadows lie on a line, or on one point, are
 * completed by unit vectors, which have no weight: no corner could ever take their places. */
#include "geom/filter.h"
#include "geom/formulas.h"
#include "geom/meet/gap.h"
#include "geom/ray/ray.h"
#include <string.h>

enum { UNIT = 0x7ffffffd, BALL_STEPS = 256 }; /* ids from UNIT on: the three unit vectors */

typedef struct program {
    const geom_ray *ray;
    const geom_body *body;
    int count;
    uint32_t basis[3];
} program;

#include "num/ball_terms.inc"

#include "geom/ray/ray_hull_body.inc"

#include "num/dyadic_terms.inc"

#include "geom/ray/ray_hull_body.inc"

/* 1, or NUM_UNSURE: then *solved may be anything. */
static int solve_ball(const program *lp, program *solved) {
    *solved = *lp;
    return hull_complete_ball(NULL, solved) == 1 ? hull_descend_ball(NULL, solved, BALL_STEPS) : NUM_UNSURE;
}

static int solve_dyadic(num_arena *arena, const program *lp, program *solved) {
    *solved = *lp;
    hull_complete_dyadic(arena, solved);
    return hull_descend_dyadic(arena, solved, UINT32_MAX);
}

/* Are the shadows of p and q different, seen along this axis as well? */
static bool apart(num_context *context, const geom_ray *ray, int i, int j, const double *p, const double *q) {
    num_arena *arena = num_fresh(context);
    num_dyadic a, b;
    a = num_dyadic_sub(arena, num_dyadic_from(arena, q[j]), num_dyadic_from(arena, p[j]));
    b = num_dyadic_sub(arena, num_dyadic_from(arena, q[i]), num_dyadic_from(arena, p[i]));
    a = num_dyadic_mul(arena, a, num_dyadic_from(arena, ray->d[i]));
    b = num_dyadic_mul(arena, b, num_dyadic_from(arena, ray->d[j]));
    return num_dyadic_compare(a, b) != 0;
}

/* The parameter where the line meets the plane, line or point of the basis. */
static geom_hit hit_of(num_context *context, const program *lp) {
    const double *corner[3];
    int count = 0;
    for (int i = 0; i < 3; i++)
        if (lp->basis[i] < UNIT) corner[count++] = geom_body_point(lp->body, lp->basis[i]);
    geom_hit h = {.source = count == 3 ? GEOM_PLANE : count == 2 ? GEOM_LINE : GEOM_COORDINATE};
    h.p = corner[0];
    if (count > 1) h.q = corner[1];
    if (count > 2) h.r = corner[2];
    for (int axis = 2, last = lp->ray->dim == 3 ? 0 : 2; count == 2; axis--) {
        h.axis = (axis + 1) % 3, h.other = (axis + 2) % 3;
        if (axis == last || apart(context, lp->ray, h.axis, h.other, h.p, h.q)) break;
    }
    if (count == 1) {
        for (int k = 0; k < lp->ray->dim; k++)
            if (fabs(lp->ray->d[k]) > fabs(lp->ray->d[h.axis])) h.axis = k;
        h.c = h.p[h.axis];
    }
    geom_hit_image(context, lp->ray, &h);
    return h;
}

bool geom_ray_meets_hull(num_context *context, const geom_ray *ray, const geom_body *body, geom_hit *first) {
    geom_body start = geom_body_at(ray->dim, ray->o);
    geom_differences shadows = {.a = body, .b = &start, .along = true};
    geom_gap gap;
    int solved;
    memcpy(shadows.from, ray->d, sizeof shadows.from);
    geom_gap_among(context, &shadows, &gap);
    if (!gap.zero) return false;                                              /* the line misses the hull */
    program first_basis = {.ray = ray, .body = body, .count = gap.count}, lp; /* corners whose shadows hold the line */
    memcpy(first_basis.basis, gap.a, sizeof first_basis.basis);
    context->stats.calls++;
    (void)NUM_LADDER(context, solved, NUM_UNSURE, NUM_UNSURE, solve_ball(&first_basis, &lp),
                     solve_dyadic(&context->arena, &first_basis, &lp));
    geom_hit hit = hit_of(context, &lp);
    if (geom_hit_sign(context, ray, &hit) < 0) { /* entered before it begins: is the origin inside, or all behind it? */
        hit = (geom_hit){.source = GEOM_START};
        if (!geom_gap_between(context, body, &start).zero) return false;
    }
    *first = hit;
    return true;
}
