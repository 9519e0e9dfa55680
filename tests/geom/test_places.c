/* Where on a body: the point nearest to a query and the place where a ray hits, against exact rationals: every kind,
 * every class of coordinates, every stage. The nearest point of a polytope is the nearest among those of all simplices
 * of its corners. */
#include "geom/bodies.h"
#include "geom/meet/foot.h"
#include "geom/ray/ray.h"
#include "support/rational.h"
#include <stdlib.h>

enum { MOST_ROOM = 9 };

static uint64_t outside, inside, edges, normals, sources[GEOM_BASIS + 1], roots;

/* ---------------------------------------------------------------- rational -- */

typedef struct oracle {
    mpq_t p, q, r; /* a value p + q sqrt(r) */
    mpq_t a, b, c; /* scratch */
    mpq_t best, square, at[FROE_MAX_DIM], foot[FROE_MAX_DIM], corner[MOST_ROOM][FROE_MAX_DIM];
    mpq_t table[MOST_ROOM][MOST_ROOM + 1], weight[MOST_ROOM];
} oracle;

static void each_number(oracle *o, void (*fn)(mpq_t)) {
    mpq_t *first = (mpq_t *)o;
    for (size_t i = 0; i < sizeof *o / sizeof *first; i++) fn(first[i]);
}
static void start_number(mpq_t x) {
    mpq_init(x);
}
static void end_number(mpq_t x) {
    mpq_clear(x);
}

/* Sign of p + q sqrt(r) - m. */
static int sign_beyond(oracle *o, const mpq_t m) {
    mpq_sub(o->a, o->p, m);
    const int p = mpq_sgn(o->a), q = mpq_sgn(o->r) ? mpq_sgn(o->q) : 0;
    if (!q || p == q) return p ? p : q;
    if (!p) return q;
    mpq_mul(o->a, o->a, o->a);
    mpq_mul(o->b, o->q, o->q);
    mpq_mul(o->b, o->b, o->r);
    return p * mpq_cmp(o->a, o->b);
}

/* Half way from x to the next double upwards, into o->c; beyond the greatest one there would be a power of 2. */
static void half_above(oracle *o, double x) {
    const double next = nextafter(x, INFINITY), low = isinf(x) ? next : x, high = isinf(next) ? x : next;
    mpq_set_d(o->c, low);
    mpq_set_d(o->a, high);
    mpq_add(o->c, o->c, o->a);
    mpq_div_2exp(o->c, o->c, 1);
    mpq_set_d(o->a, isinf(x) ? -0x1p970 : isinf(next) ? 0x1p970 : 0);
    mpq_add(o->c, o->c, o->a);
}

/* Is x the double nearest to p + q sqrt(r), ties to even? */
static bool surd_rounds_to(oracle *o, double x) {
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    const bool even = (bits & 1) == 0;
    bool right = !(x == 0 && signbit(x));
    if (x < INFINITY) {
        half_above(o, x);
        const int above = sign_beyond(o, o->c);
        right = right && (above < 0 || (!above && even));
    }
    if (x > -INFINITY) {
        half_above(o, nextafter(x, -INFINITY));
        const int above = sign_beyond(o, o->c);
        right = right && (above > 0 || (!above && even));
    }
    return right;
}

/* ----------------------------------------------------------------- nearest -- */

/* Weights of the simplex's corners at its point nearest to 0, from the normal equations; false: dependent, or the
 * point is not in the simplex. */
static bool weigh(oracle *o, int dim, const int *of, int count) {
    const int m = count - 1;
    for (int i = 0; i < m; i++)
        for (int j = 0; j <= m; j++) {
            mpq_set_ui(o->table[i][j], 0, 1);
            for (int k = 0; k < dim; k++) {
                mpq_sub(o->a, o->corner[of[i + 1]][k], o->corner[of[0]][k]);
                if (j < m)
                    mpq_sub(o->b, o->corner[of[j + 1]][k], o->corner[of[0]][k]);
                else
                    mpq_neg(o->b, o->corner[of[0]][k]);
                mpq_mul(o->a, o->a, o->b);
                mpq_add(o->table[i][j], o->table[i][j], o->a);
            }
        }
    for (int i = 0; i < m; i++) { /* Gram matrices need no exchange of rows */
        if (!mpq_sgn(o->table[i][i])) return false;
        for (int r = 0; r < m; r++) {
            if (r == i) continue;
            mpq_div(o->a, o->table[r][i], o->table[i][i]);
            for (int j = i; j <= m; j++) {
                mpq_mul(o->b, o->a, o->table[i][j]);
                mpq_sub(o->table[r][j], o->table[r][j], o->b);
            }
        }
    }
    mpq_set_ui(o->weight[0], 1, 1);
    for (int i = 0; i < m; i++) {
        mpq_div(o->weight[i + 1], o->table[i][m], o->table[i][i]);
        mpq_sub(o->weight[0], o->weight[0], o->weight[i + 1]);
    }
    for (int i = 0; i < count; i++)
        if (mpq_sgn(o->weight[i]) < 0) return false;
    return true;
}

/* Takes the point of the weights if it is nearer than the best. */
static void take(oracle *o, int dim, const int *of, int count, bool first) {
    mpq_set_ui(o->square, 0, 1);
    for (int k = 0; k < dim; k++) {
        mpq_set_ui(o->at[k], 0, 1);
        for (int i = 0; i < count; i++) {
            mpq_mul(o->a, o->weight[i], o->corner[of[i]][k]);
            mpq_add(o->at[k], o->at[k], o->a);
        }
        mpq_mul(o->a, o->at[k], o->at[k]);
        mpq_add(o->square, o->square, o->a);
    }
    if (!first && mpq_cmp(o->square, o->best) >= 0) return;
    mpq_set(o->best, o->square);
    for (int k = 0; k < dim; k++) mpq_set(o->foot[k], o->at[k]);
}

/* The point of the hull of corners that is nearest to x, as a difference from x. */
static void nearest_by_trying(oracle *o, const geom_body *body, const double *x) {
    const int corners = (int)geom_body_corners(body), dim = body->dim;
    assert_true(corners <= MOST_ROOM);
    for (int i = 0; i < corners; i++)
        for (int k = 0; k < dim; k++) {
            const bool box = body->form == FROE_BOX;
            mpq_set_d(o->corner[i][k], geom_body_point(body, box ? (uint32_t)(i >> k & 1) : (uint32_t)i)[k]);
            mpq_set_d(o->a, x[k]);
            mpq_sub(o->corner[i][k], o->corner[i][k], o->a);
        }
    bool first = true;
    for (unsigned mask = 1; mask < 1u << corners; mask++) {
        int of[MOST_ROOM], count = 0;
        for (int i = 0; i < corners; i++)
            if (mask >> i & 1) of[count++] = i;
        if (count > dim + 1 || !weigh(o, dim, of, count)) continue;
        take(o, dim, of, count, first);
        first = false;
    }
}

static void check_foot(oracle *o, num_context *context, const geom_body *body, const double *x) {
    double got[3][FROE_MAX_DIM];
    for (num_stage first = NUM_FILTER; first <= NUM_EXACT; first++) {
        context->first = first;
        geom_foot(context, x, body, got[first]);
        assert_memory_equal(got[0], got[first], (size_t)body->dim * sizeof(double));
    }
    const double *centre = geom_body_point(body, 0);
    if (body->form == FROE_BOX && body->dim > 3) { /* of too many corners */
        const double *lo = centre, *hi = geom_body_point(body, 1);
        for (int k = 0; k < body->dim; k++) assert_true(got[0][k] == fmin(fmax(x[k], lo[k]), hi[k]));
        return;
    }
    if (body->form != FROE_BALL) {
        nearest_by_trying(o, body, x);
        outside += mpq_sgn(o->best) != 0;
        inside += mpq_sgn(o->best) == 0;
    } else {
        mpq_set_ui(o->square, 0, 1);
        for (int k = 0; k < body->dim; k++) {
            mpq_set_d(o->a, x[k]);
            mpq_set_d(o->b, centre[k]);
            mpq_sub(o->at[k], o->a, o->b);
            mpq_mul(o->a, o->at[k], o->at[k]);
            mpq_add(o->square, o->square, o->a);
        }
        mpq_set_d(o->c, body->radius);
        mpq_mul(o->a, o->c, o->c);
        if (mpq_cmp(o->square, o->a) <= 0) {
            inside++;
            assert_memory_equal(got[0], x, (size_t)body->dim * sizeof *x);
            return;
        }
        roots++;
    }
    for (int k = 0; k < body->dim; k++) {
        mpq_set_ui(o->q, 0, 1);
        mpq_set_ui(o->r, 0, 1);
        if (body->form == FROE_BALL) { /* c + r (x - c) / sqrt(S) */
            mpq_set_d(o->p, centre[k]);
            mpq_set_d(o->q, body->radius);
            mpq_mul(o->q, o->q, o->at[k]);
            mpq_div(o->q, o->q, o->square);
            mpq_set(o->r, o->square);
        } else {
            mpq_set_d(o->p, x[k]);
            mpq_add(o->p, o->p, o->foot[k]);
        }
        if (!surd_rounds_to(o, got[0][k]))
            fail_msg("%s, axis %d: %.17g is not the nearest double", froe_kind_name(body->form), k, got[0][k]);
    }
}

/* -------------------------------------------------------------------- hits -- */

/* value = factor * t + rest, where t = (p + q sqrt(r)) / s. */
static void set_affine(oracle *o, const exact_value *t, const mpq_t factor, const mpq_t rest) {
    mpq_set_z(o->a, t->s);
    mpq_set_z(o->p, t->p);
    mpq_set_z(o->q, t->q);
    mpq_set_z(o->r, t->r);
    mpq_div(o->p, o->p, o->a);
    mpq_div(o->q, o->q, o->a);
    mpq_mul(o->p, o->p, factor);
    mpq_mul(o->q, o->q, factor);
    mpq_add(o->p, o->p, rest);
}

/* Is x the double nearest to t |d|? Its square is compared: (p^2 + q^2 r + 2 p q sqrt(r)) d^2. */
static bool length_rounds_to(oracle *o, const geom_ray *ray, const exact_value *t, double x) {
    mpq_set_ui(o->square, 0, 1);
    for (int k = 0; k < ray->dim; k++) {
        mpq_set_d(o->a, ray->d[k]);
        mpq_mul(o->a, o->a, o->a);
        mpq_add(o->square, o->square, o->a);
    }
    mpq_set_ui(o->best, 0, 1);
    mpq_set_ui(o->at[0], 1, 1);
    set_affine(o, t, o->at[0], o->best);
    mpq_mul(o->at[0], o->p, o->q);
    mpq_add(o->at[0], o->at[0], o->at[0]);
    mpq_mul(o->p, o->p, o->p);
    mpq_mul(o->q, o->q, o->q);
    mpq_mul(o->q, o->q, o->r);
    mpq_add(o->p, o->p, o->q);
    mpq_mul(o->p, o->p, o->square);
    mpq_mul(o->q, o->at[0], o->square);
    bool right = true;
    for (int up = 0; up < 2; up++) {
        const double from = up ? x : nextafter(x, -1);
        uint64_t bits;
        memcpy(&bits, &x, sizeof bits);
        if (from < 0 || isinf(from)) continue;
        half_above(o, from);
        mpq_mul(o->c, o->c, o->c);
        const int above = sign_beyond(o, o->c) * (up ? 1 : -1);
        right = right && (above < 0 || (!above && !(bits & 1)));
    }
    return right;
}

/* Is the normal that of these corners, or its opposite, rounded? */
static bool normal_of(oracle *o, const geom_ray *ray, const double *const p[3], int way, const double *got) {
    mpq_t *n = o->foot;
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        if (ray->dim == 2) { /* to the left of p[0] p[1] */
            mpq_set_d(n[k], k == 0 ? p[0][1] : k == 1 ? p[1][0] : 0);
            mpq_set_d(o->a, k == 0 ? p[1][1] : k == 1 ? p[0][0] : 0);
            mpq_sub(n[k], n[k], o->a);
            continue;
        }
        mpq_t *e = o->corner[0], *f = o->corner[1];
        for (int axis = 0; axis < 3; axis++) {
            mpq_set_d(o->a, p[0][axis]);
            mpq_set_d(e[axis], p[1][axis]);
            mpq_set_d(f[axis], p[2][axis]);
            mpq_sub(e[axis], e[axis], o->a);
            mpq_sub(f[axis], f[axis], o->a);
        }
        mpq_mul(n[k], e[i], f[j]);
        mpq_mul(o->a, e[j], f[i]);
        mpq_sub(n[k], n[k], o->a);
    }
    mpq_set_ui(o->square, 0, 1);
    for (int k = 0; k < 3; k++) {
        mpq_mul(o->a, n[k], n[k]);
        mpq_add(o->square, o->square, o->a);
    }
    if (!mpq_sgn(o->square)) return false;
    for (int k = 0; k < ray->dim; k++) {
        mpq_set_ui(o->p, 0, 1);
        mpq_div(o->q, n[k], o->square);
        if (way < 0) mpq_neg(o->q, o->q);
        mpq_set(o->r, o->square);
        if (!surd_rounds_to(o, got[k])) return false;
    }
    return true;
}

/* n . (x - p), for the normal that normal_of() left. */
static int beside(oracle *o, int dim, const double *p, const double *x) {
    mpq_set_ui(o->square, 0, 1);
    for (int k = 0; k < dim; k++) {
        mpq_set_d(o->a, x[k]);
        mpq_set_d(o->b, p[k]);
        mpq_sub(o->a, o->a, o->b);
        mpq_mul(o->a, o->a, o->foot[k]);
        mpq_add(o->square, o->square, o->a);
    }
    return mpq_sgn(o->square);
}

/* Does the ray, at t, lie on the face of the normal through p? */
static bool on_face(oracle *o, const geom_ray *ray, const exact_value *t, const double *p) {
    mpq_set_ui(o->at[0], 0, 1);
    mpq_set_ui(o->at[1], 0, 1);
    for (int k = 0; k < ray->dim; k++) {
        mpq_set_d(o->a, ray->d[k]);
        mpq_mul(o->a, o->a, o->foot[k]);
        mpq_add(o->at[0], o->at[0], o->a);
        mpq_set_d(o->a, ray->o[k]);
        mpq_set_d(o->b, p[k]);
        mpq_sub(o->a, o->a, o->b);
        mpq_mul(o->a, o->a, o->foot[k]);
        mpq_add(o->at[1], o->at[1], o->a);
    }
    set_affine(o, t, o->at[0], o->at[1]);
    return mpq_sgn(o->p) == 0;
}

/* The outward normals of a hull's faces that the ray enters: is the one that was found among them, or is there none? */
static bool normal_of_hull(oracle *o, const geom_ray *ray, const geom_body *body, const exact_value *t, bool faced,
                           const double *got) {
    const uint32_t n = body->count, dim = (uint32_t)ray->dim;
    const double zero[3] = {0, 0, 0};
    bool any = false, found = false;
    if (!mpz_sgn(t->p)) return !faced;
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t j = i + 1; j < n; j++)
            for (uint32_t k = dim == 3 ? j + 1 : n - 1; k < n; k++) {
                const double *const p[3] = {geom_body_point(body, i), geom_body_point(body, j),
                                            geom_body_point(body, k)};
                (void)normal_of(o, ray, p, 1, got);
                const int along = beside(o, ray->dim, zero, ray->d);
                bool supports = along != 0 && on_face(o, ray, t, p[0]);
                for (uint32_t c = 0; c < n && supports; c++)
                    supports = beside(o, ray->dim, p[0], geom_body_point(body, c)) * along >= 0;
                if (!supports) continue;
                any = true;
                found = found || normal_of(o, ray, p, -along, got);
            }
    return faced ? found : !any;
}

static bool normal_is_right(oracle *o, const geom_ray *ray, const geom_body *body, const exact_value *t, bool faced,
                            const double *got) {
    const double *p[3];
    for (uint32_t i = 0; i < 3; i++) p[i] = i < body->count ? geom_body_point(body, i) : NULL;
    const bool starts = !mpz_sgn(t->p) && !mpz_sgn(t->q);
    bool zero = true, right = true;
    for (int k = 0; k < ray->dim; k++) zero = zero && got[k] == 0;
    if (zero == faced) return false;
    if (body->form == FROE_POLYGON || (body->form == FROE_SEGMENT && ray->dim == 2))
        return faced && normal_of(o, ray, p, 1, got);
    if (body->form == FROE_HULL) return normal_of_hull(o, ray, body, t, faced, got);
    if (body->form == FROE_POINT || body->form == FROE_SEGMENT || starts) return !faced;
    if (body->form == FROE_BOX) {
        int axes = 0;
        for (int k = 0; k < ray->dim; k++) {
            if (got[k] == 0) continue;
            axes++;
            mpq_set_d(o->at[0], ray->d[k]);
            mpq_set_d(o->at[1], ray->o[k]);
            mpq_set_d(o->at[2], p[ray->d[k] < 0][k]);
            mpq_sub(o->at[1], o->at[1], o->at[2]);
            set_affine(o, t, o->at[0], o->at[1]);
            right = right && !mpq_sgn(o->p) && got[k] == (ray->d[k] < 0 ? 1 : -1);
        }
        return right && axes == 1;
    }
    for (int k = 0; k < ray->dim; k++) { /* a ball: (o - c + t d) / r */
        mpq_set_d(o->at[0], ray->d[k]);
        mpq_set_d(o->at[1], ray->o[k]);
        mpq_set_d(o->at[2], p[0][k]);
        mpq_sub(o->at[1], o->at[1], o->at[2]);
        mpq_set_d(o->at[2], body->radius);
        mpq_div(o->at[0], o->at[0], o->at[2]);
        mpq_div(o->at[1], o->at[1], o->at[2]);
        set_affine(o, t, o->at[0], o->at[1]);
        right = right && surd_rounds_to(o, got[k]);
    }
    return right;
}

static void check_place(oracle *o, num_context *context, const geom_ray *ray, const geom_body *body,
                        const exact_value *t) {
    for (num_stage first = NUM_FILTER; first <= NUM_EXACT; first++) {
        geom_hit hit;
        double point[FROE_MAX_DIM], normal[FROE_MAX_DIM];
        context->first = first;
        assert_true(geom_ray_meets(context, ray, body, &hit));
        sources[hit.source]++;
        geom_hit_point(context, ray, &hit, point);
        const bool faced = geom_hit_normal(context, ray, body, &hit, normal);
        const double distance = geom_hit_distance(context, ray, &hit);
        for (int k = 0; k < ray->dim; k++) {
            mpq_set_d(o->at[0], ray->d[k]);
            mpq_set_d(o->at[1], ray->o[k]);
            set_affine(o, t, o->at[0], o->at[1]);
            if (!surd_rounds_to(o, point[k]))
                fail_msg("%s, axis %d: %.17g is not where it is hit", froe_kind_name(body->form), k, point[k]);
        }
        if (!length_rounds_to(o, ray, t, distance))
            fail_msg("%s: %.17g is not the distance", froe_kind_name(body->form), distance);
        if (!normal_is_right(o, ray, body, t, faced, normal))
            fail_msg("%s, source %d: (%.17g, %.17g, %.17g) is no normal", froe_kind_name(body->form), hit.source,
                     normal[0], normal[1], ray->dim > 2 ? normal[2] : 0);
        normals += faced;
        edges += !faced;
    }
}

/* ------------------------------------------------------------------- cases -- */

typedef struct fixture {
    num_context context;
    bodies_case c;
    oracle o;
} fixture;

static int setup(void **state) {
    fixture *f = calloc(1, sizeof *f);
    *state = f;
    if (!f) return 1;
    each_number(&f->o, start_number);
    return num_context_new(NULL, &f->context) != FROE_OK;
}

static int teardown(void **state) {
    fixture *f = *state;
    assert_true(f->context.arena.high <= f->context.arena.capacity);
    each_number(&f->o, end_number);
    num_context_free(&f->context);
    free(f);
    return 0;
}

static void try_places(fixture *f, fuzz_source *r, fuzz_class kind, bool rays) {
    bodies_draw(r, kind, f->c.dim, &f->c);
    geom_ray ray = {.dim = f->c.dim};
    bool goes = false;
    const double *to = bodies_at(&f->c, (uint32_t)fuzz_int(r, 0, BODIES_POINTS - 3));
    const int way = fuzz_int(r, 0, 2), axis = fuzz_int(r, 0, f->c.dim - 1);
    for (int k = 0; k < f->c.dim; k++) {
        ray.o[k] = f->c.point[k];
        ray.d[k] = way == 0 ? (k == axis) * (to[0] < 0 ? -1.0 : 1.0) : to[k] - f->c.point[k];
        goes = goes || ray.d[k] != 0;
        if (!isfinite(ray.d[k])) return;
    }
    exact_begin(exact_shift(exact_shift(0, f->c.points, (size_t)(BODIES_POINTS * f->c.dim)), ray.d, FROE_MAX_DIM));
    for (int i = 0; i < 2; i++) {
        exact_value t;
        const exact_body b = exact_body_of(&f->c.body[i]);
        if (!rays)
            check_foot(&f->o, &f->context, &f->c.body[i], f->c.point);
        else if (goes && exact_ray(ray.o, ray.d, &b, &t))
            check_place(&f->o, &f->context, &ray, &f->c.body[i], &t);
    }
}

static void run(fixture *f, int dim, int trials, bool rays) {
    for (int kind = 0; kind < FUZZ_CLASSES; kind++) {
        fuzz_source r = {(uint64_t)(kind * 1000 + dim + 17 * rays)};
        f->c.dim = dim;
        for (int i = 0; i < bodies_trials((fuzz_class)kind, trials); i++) try_places(f, &r, (fuzz_class)kind, rays);
    }
}

static void the_nearest_point_is_rounded_once(void **state) {
    for (int dim = 2; dim <= 3; dim++) run(*state, dim, 240, false);
    run(*state, 5, 60, false);
    assert_true(outside > 400 / BODIES_SHARE && inside > 120 / BODIES_SHARE && roots > 120 / BODIES_SHARE);
}

static void the_nearest_point_of_hulls_above_dimension_3_is_rounded_once(void **state) {
    fixture *f = *state;
    for (int kind = 0; kind < FUZZ_CLASSES; kind++)
        for (int i = 0; i < bodies_trials((fuzz_class)kind, 40); i++) {
            fuzz_source r = {(uint64_t)(kind * 1000 + i)};
            const int dim = 4 + i % 2;
            double points[8 * FROE_MAX_DIM];
            for (int k = 0; k < 8 * dim; k++) points[k] = fuzz_coordinate(&r, (fuzz_class)kind) + 0.0;
            const geom_body hull = {
                .form = FROE_HULL, .dim = dim, .count = (uint32_t)fuzz_int(&r, 1, 6), .coords = points};
            check_foot(&f->o, &f->context, &hull, points + 7 * (size_t)dim);
        }
}

static void what_a_ray_hits_is_rounded_once(void **state) {
    for (int dim = 2; dim <= 3; dim++) run(*state, dim, 400, true);
    run(*state, 5, 160, true);
    assert_true(normals > 400 / BODIES_SHARE && edges > 120 / BODIES_SHARE);
    for (int i = 0; i < GEOM_BASIS; i++) assert_true(sources[i] > 40 / BODIES_SHARE);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(the_nearest_point_is_rounded_once, setup, teardown),
        cmocka_unit_test_setup_teardown(the_nearest_point_of_hulls_above_dimension_3_is_rounded_once, setup, teardown),
        cmocka_unit_test_setup_teardown(what_a_ray_hits_is_rounded_once, setup, teardown),
    };
    return cmocka_run_group_tests_name("geom/places", tests, NULL, NULL);
}
