/* share.c: see share.h. */
#include "tree/audit/share.h"
#include "geom/high/program.h"
#include "geom/meet/meet.h"

typedef struct polytopes {
    geom_convex a, b;
} polytopes;

/* The sign, the corner and the set of a column. */
static const geom_convex *corner_of_column(const polytopes *p, uint32_t j, uint32_t *corner, int *sign) {
    const bool first = j < p->a.count;
    *corner = first ? j : j - p->a.count;
    *sign = first ? 1 : -1;
    return first ? &p->a : &p->b;
}

static void column_exactly(const void *user, num_arena *arena, uint32_t j, num_dyadic *out) {
    const polytopes *p = user;
    const int dim = p->a.dim;
    const bool right = j == GEOM_RIGHT_SIDE;
    const num_dyadic zero = {0}, one = num_dyadic_scaled(arena, 1, 1, 0);
    uint32_t corner;
    int sign;
    const geom_convex *set = right ? NULL : corner_of_column(p, j, &corner, &sign);
    for (int k = 0; k < dim; k++)
        out[k] = right ? zero : num_dyadic_from(arena, sign * geom_convex_coordinate(set, corner, k));
    const bool of_a = right || set == &p->a, of_b = right || set == &p->b;
    out[dim] = of_a ? one : zero;
    out[dim + 1] = of_b ? one : zero;
}

/* About that, measured from a corner. */
static void column_image(const void *user, uint32_t j, double *out) {
    const polytopes *p = user;
    const int dim = p->a.dim;
    const bool right = j == GEOM_RIGHT_SIDE;
    uint32_t corner;
    int sign;
    const geom_convex *set = right ? NULL : corner_of_column(p, j, &corner, &sign);
    for (int k = 0; k < dim; k++)
        out[k] = right ? 0 : sign * (geom_convex_coordinate(set, corner, k) - geom_convex_coordinate(&p->a, 0, k));
    out[dim] = right || set == &p->a;
    out[dim + 1] = right || set == &p->b;
}

static bool is_list(const geom_convex *c) {
    return c->core == GEOM_CORE_LIST && c->count > 1;
}

bool share_point(num_context *context, const geom_convex *a, const geom_convex *b) {
    if (!is_list(a) && !is_list(b)) {
        const double *lo_a = geom_convex_point(a, 0), *lo_b = geom_convex_point(b, 0);
        const double *hi_a = a->core == GEOM_CORE_BOX ? geom_convex_point(a, 1) : lo_a;
        const double *hi_b = b->core == GEOM_CORE_BOX ? geom_convex_point(b, 1) : lo_b;
        return geom_meet_boxes(context, a->dim, lo_a, hi_a, a->radius, lo_b, hi_b, b->radius);
    }
    if (a->dim <= 3 || a->radius > 0 || b->radius > 0) return geom_meet(context, a, b);
    const polytopes p = {*a, *b};
    const geom_program program = {.rows = a->dim + 2,
                                  .columns = a->count + b->count,
                                  .goal = GEOM_RIGHT_SIDE,
                                  .user = &p,
                                  .column = column_exactly,
                                  .image = column_image};
    return geom_program_solve(context, &program).feasible;
}
