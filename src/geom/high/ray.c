/* ray.c: see high.h.
 *
 * The ray o + t d meets the hull of corners c first at the least t >= 0 with
 *
 *     sum of v_i c_i - t d = o,   sum of v_i = 1,   v >= 0
 *
 * The corners of the basis span what is met there, and with it t, whatever their weights. */
#include "geom/filter.h"
#include "geom/high/guess.h"
#include "geom/high/high.h"
#include "geom/high/program.h"

typedef struct flight {
    const geom_ray *ray;
    geom_convex set;
} flight;

static void flight_column(const void *user, num_arena *arena, uint32_t j, num_dyadic *out) {
    const flight *f = user;
    const uint32_t n = f->set.count;
    for (int k = 0; k < f->ray->dim; k++)
        out[k] = num_dyadic_from(arena, j < n    ? geom_convex_coordinate(&f->set, j, k)
                                        : j == n ? -f->ray->d[k]
                                                 : f->ray->o[k]);
    out[f->ray->dim] = j == n ? (num_dyadic){0} : num_dyadic_scaled(arena, 1, 1, 0);
}

static void flight_image(const void *user, uint32_t j, double *out) {
    const flight *f = user;
    const uint32_t n = f->set.count;
    for (int k = 0; k < f->ray->dim; k++)
        out[k] = j < n ? geom_convex_coordinate(&f->set, j, k) - f->ray->o[k] : j == n ? -f->ray->d[k] : 0;
    out[f->ray->dim] = j == n ? 0 : 1;
}

/* Does the ray pass the hull by for certain? As a segment from its origin to beyond all corners, along the axis on
 * which it is fastest. Its end is rounded. */
static bool passes_by(const flight *f) {
    const geom_ray *ray = f->ray;
    double ends[2 * FROE_MAX_DIM], far = 0, error = 0, least, most;
    int axis = 0;
    for (int k = 1; k < ray->dim; k++)
        if (fabs(ray->d[k]) > fabs(ray->d[axis])) axis = k;
    for (uint32_t i = 0; i < f->set.count; i++)
        far = fmax(far, fabs(geom_convex_coordinate(&f->set, i, axis) - ray->o[axis]));
    const double t = far / fabs(ray->d[axis]) * (1 + 0x1p-50);
    for (int k = 0; k < ray->dim; k++) {
        ends[k] = ray->o[k];
        ends[ray->dim + k] = ray->o[k] + t * ray->d[k];
        error += fabs(ray->o[k]) + fabs(t * ray->d[k]);
    }
    if (!(error < 0x1p1000)) return false;
    const geom_convex path = {.core = GEOM_CORE_LIST, .dim = ray->dim, .count = 2, .coords = ends};
    const geom_guess guess = geom_guess_between(&path, &f->set);
    geom_guess_bounds(&guess, &path, &f->set, &least, &most);
    return least > 0x1p-50 * error + NUM_BALL_TINY;
}

bool geom_high_ray(num_context *context, const geom_ray *ray, const geom_body *body, geom_hit *first) {
    const flight f = {.ray = ray, .set = geom_convex_of(body)};
    const geom_program program = {.rows = ray->dim + 1,
                                  .columns = f.set.count + 1,
                                  .goal = f.set.count,
                                  .sense = 1,
                                  .user = &f,
                                  .column = flight_column,
                                  .image = flight_image};
    if (context->first != NUM_EXACT && num_filtered_call(context, passes_by(&f) ? 1 : NUM_UNSURE) == 1) return false;
    const geom_solution s = geom_program_solve(context, &program);
    *first = (geom_hit){.source = GEOM_START};
    if (!s.feasible) return false;
    if (!s.sign) return true; /* the origin is in it */
    *first = (geom_hit){.source = GEOM_BASIS, .p = body->coords};
    for (int i = 0; i < program.rows; i++)
        if (s.basis[i] < f.set.count)
            first->basis[first->count++] = body->corners ? body->corners[s.basis[i]] : s.basis[i];
    geom_hit_image(context, ray, first);
    return true;
}

/* By the equations above in the corners of the basis and t: more of them than unknowns, but without contradiction. */
num_ratio geom_high_parameter(num_arena *arena, const geom_ray *ray, const geom_hit *hit) {
    const geom_convex set = {
        .core = GEOM_CORE_LIST, .dim = ray->dim, .count = (uint32_t)hit->count, .coords = hit->p, .ids = hit->basis};
    const flight f = {.ray = ray, .set = set};
    const int unknowns = hit->count + 1;
    num_table t = {.rows = ray->dim + 1, .columns = unknowns + 1};
    num_dyadic column[NUM_TABLE_ROWS];
    const size_t mark = arena->top;
    for (int c = 0; c <= unknowns; c++) {
        flight_column(&f, arena, c == unknowns ? GEOM_RIGHT_SIDE : (uint32_t)c, column);
        for (int i = 0; i < t.rows; i++) t.at[i][c] = column[i];
    }
    num_table_solve(arena, mark, &t, unknowns);
    num_ratio out = {t.at[t.rank - 1][unknowns], t.scale};
    if (out.bottom.sign < 0) out.bottom.sign = 1, out.top.sign = -out.top.sign;
    return out;
}
