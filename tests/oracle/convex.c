/* convex.c: brute force over simplices. */
#include "oracle/convex.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* -------------------------------------------------------------------- sets -- */

static oracle_set set_new(int dim, size_t count, double radius) {
    oracle_set s = {.dim = dim, .count = count, .radius = radius};
    s.x = malloc((count * (size_t)dim + 1) * sizeof *s.x);
    s.image = malloc((count * (size_t)dim + 1) * sizeof *s.image);
    for (size_t i = 0; i < count * (size_t)dim; i++) mpq_init(s.x[i]);
    return s;
}

void oracle_set_free(oracle_set *s) {
    for (size_t i = 0; i < s->count * (size_t)s->dim; i++) mpq_clear(s->x[i]);
    free(s->x);
    free(s->image);
}

/* Images and bounds from the exact coordinates. mpq_get_d rounds towards zero, so that its neighbours enclose. */
static oracle_set finish(oracle_set s) {
    for (int k = 0; k < 3; k++) s.lo[k] = INFINITY, s.hi[k] = -INFINITY;
    for (size_t i = 0; i < s.count * (size_t)s.dim; i++) {
        size_t k = i % (size_t)s.dim;
        mpq_t back;
        mpq_init(back);
        double x = s.image[i] = mpq_get_d(s.x[i]);
        bool whole = isfinite(x);
        if (whole) mpq_set_d(back, x);
        whole = whole && mpq_equal(back, s.x[i]);
        s.lo[k] = fmin(s.lo[k], whole ? x : nextafter(x, -INFINITY));
        s.hi[k] = fmax(s.hi[k], whole ? x : nextafter(x, INFINITY));
        mpq_clear(back);
    }
    return s;
}

oracle_set oracle_points(int dim, const double *coords, size_t count, double radius) {
    oracle_set s = set_new(dim, count, radius);
    for (size_t i = 0; i < count * (size_t)dim; i++) mpq_set_d(s.x[i], coords[i]);
    return finish(s);
}

oracle_set oracle_box(int dim, const double *lo, const double *hi) {
    oracle_set s = set_new(dim, (size_t)1 << dim, 0);
    for (size_t i = 0; i < s.count; i++)
        for (int k = 0; k < dim; k++) mpq_set_d(s.x[i * (size_t)dim + (size_t)k], i >> k & 1 ? hi[k] : lo[k]);
    return finish(s);
}

/* The ray as far as `reach` along the axis where it is fastest. */
static oracle_set ray_within(int dim, const double *origin, const double *direction, mpq_t reach) {
    oracle_set s = set_new(dim, 2, 0);
    mpq_t factor, most;
    mpq_init(factor);
    mpq_init(most);
    for (int k = 0; k < dim; k++) { /* reach / |largest component| */
        mpq_set_d(factor, fabs(direction[k]));
        if (mpq_cmp(factor, most) > 0) mpq_set(most, factor);
    }
    mpq_div(factor, reach, most);
    for (int k = 0; k < dim; k++) {
        mpq_set_d(s.x[k], origin[k]);
        mpq_set_d(s.x[dim + k], direction[k]);
        mpq_mul(s.x[dim + k], s.x[dim + k], factor);
        mpq_add(s.x[dim + k], s.x[dim + k], s.x[k]);
    }
    mpq_clear(factor);
    mpq_clear(most);
    return finish(s);
}

oracle_set oracle_ray(int dim, const double *origin, const double *direction, double reach) {
    mpq_t length;
    mpq_init(length);
    mpq_set_d(length, reach);
    oracle_set s = ray_within(dim, origin, direction, length);
    mpq_clear(length);
    return s;
}

oracle_set oracle_ray_past(int dim, const double *origin, const double *direction, const double *lo, const double *hi) {
    mpq_t length, x, step;
    mpq_init(length);
    mpq_init(x);
    mpq_init(step);
    for (int k = 0; k < 2 * dim; k++) {
        mpq_set_d(x, origin[k / 2]);
        mpq_set_d(step, k % 2 ? hi[k / 2] : lo[k / 2]);
        mpq_sub(step, step, x);
        mpq_abs(step, step);
        mpq_add(length, length, step);
    }
    oracle_set s = ray_within(dim, origin, direction, length);
    mpq_clear(length);
    mpq_clear(x);
    mpq_clear(step);
    return s;
}

oracle_set oracle_object(const froe_scene *scene, uint32_t object) {
    froe_object o = froe_scene_object(scene, object);
    int dim = froe_scene_dim(scene);
    size_t count = o.form == FROE_BALL ? 1 : o.corners;
    double *coords = malloc(count * (size_t)dim * sizeof *coords);
    for (uint32_t i = 0; i < count; i++)
        memcpy(coords + i * (size_t)dim, froe_scene_vertex(scene, froe_scene_corner(scene, object, i)),
               (size_t)dim * sizeof *coords);
    oracle_set s =
        o.form == FROE_BOX ? oracle_box(dim, coords, coords + dim) : oracle_points(dim, coords, count, o.radius);
    free(coords);
    return s;
}

/* -------------------------------------------------------------- halfspaces -- */

/* n . x <= c, dim + 1 rationals a row. */
typedef struct rows {
    int dim;
    size_t count;
    mpq_t *at;
} rows;

static mpq_t *row(const rows *r, size_t i) {
    return r->at + i * ((size_t)r->dim + 1);
}

/* Solves the equations of `dim` rows by Gauss and Jordan; false when they are dependent. */
static bool solve(const rows *r, const size_t *chosen, mpq_t *x) {
    mpq_t m[3][4], t;
    int dim = r->dim;
    bool found = true;
    mpq_init(t);
    for (int i = 0; i < dim; i++)
        for (int k = 0; k <= dim; k++) mpq_init(m[i][k]), mpq_set(m[i][k], row(r, chosen[i])[k]);
    for (int c = 0; c < dim && found; c++) {
        int pivot = c;
        while (pivot < dim && mpq_sgn(m[pivot][c]) == 0) pivot++;
        found = pivot < dim;
        for (int k = 0; k <= dim && found; k++) mpq_swap(m[pivot][k], m[c][k]);
        for (int i = 0; i < dim && found; i++) {
            if (i == c) continue;
            mpq_t f;
            mpq_init(f);
            mpq_div(f, m[i][c], m[c][c]);
            for (int k = 0; k <= dim; k++) mpq_mul(t, f, m[c][k]), mpq_sub(m[i][k], m[i][k], t);
            mpq_clear(f);
        }
    }
    for (int i = 0; i < dim && found; i++) mpq_div(x[i], m[i][dim], m[i][i]);
    for (int i = 0; i < dim; i++)
        for (int k = 0; k <= dim; k++) mpq_clear(m[i][k]);
    mpq_clear(t);
    return found;
}

static bool satisfies(const rows *r, mpq_t *x) {
    mpq_t sum, t;
    bool all = true;
    mpq_init(sum);
    mpq_init(t);
    for (size_t i = 0; i < r->count && all; i++) {
        mpq_set_ui(sum, 0, 1);
        for (int k = 0; k < r->dim; k++) mpq_mul(t, row(r, i)[k], x[k]), mpq_add(sum, sum, t);
        all = mpq_cmp(sum, row(r, i)[r->dim]) <= 0;
    }
    mpq_clear(sum);
    mpq_clear(t);
    return all;
}

/* Is point n of a set equal to one before? */
static bool is_repeated(const oracle_set *s, size_t n) {
    size_t dim = (size_t)s->dim;
    for (size_t i = 0; i < n; i++) {
        size_t equal = 0;
        while (equal < dim && mpq_equal(s->x[i * dim + equal], s->x[n * dim + equal])) equal++;
        if (equal == dim) return true;
    }
    return false;
}

oracle_set oracle_halfspaces(int dim, const double *normals, const double *offsets, size_t count, const double *lo,
                             const double *hi) {
    rows r = {dim, count + 2 * (size_t)dim, NULL};
    size_t width = (size_t)dim + 1, found = 0, most = r.count * r.count * r.count;
    r.at = malloc(r.count * width * sizeof *r.at);
    for (size_t i = 0; i < r.count * width; i++) mpq_init(r.at[i]);
    for (size_t i = 0; i < count; i++) {
        for (int k = 0; k < dim; k++) mpq_set_d(row(&r, i)[k], normals[i * (size_t)dim + (size_t)k]);
        mpq_set_d(row(&r, i)[dim], offsets[i]);
    }
    for (int k = 0; k < 2 * dim; k++) {
        mpq_set_si(row(&r, count + (size_t)k)[k / 2], k % 2 ? -1 : 1, 1);
        mpq_set_d(row(&r, count + (size_t)k)[dim], k % 2 ? -lo[k / 2] : hi[k / 2]);
    }
    oracle_set s = set_new(dim, most, 0); /* generous */
    size_t chosen[3];
    for (chosen[0] = 0; chosen[0] < r.count; chosen[0]++)
        for (chosen[1] = chosen[0] + 1; chosen[1] < r.count; chosen[1]++)
            for (chosen[2] = dim == 3 ? chosen[1] + 1 : r.count - 1; chosen[2] < r.count; chosen[2]++)
                if (solve(&r, chosen, s.x + found * (size_t)dim) && satisfies(&r, s.x + found * (size_t)dim) &&
                    !is_repeated(&s, found))
                    found++;
    for (size_t i = found * (size_t)dim; i < most * (size_t)dim; i++) mpq_clear(s.x[i]);
    s.count = found;
    for (size_t i = 0; i < r.count * width; i++) mpq_clear(r.at[i]);
    free(r.at);
    return finish(s);
}

int oracle_halfspaces_hold(int dim, const double *normals, const double *offsets, size_t count, const oracle_set *set) {
    mpq_t sum, t;
    bool *inside = calloc(set->count, sizeof *inside), all_outside = false, one_inside = false;
    mpq_init(sum);
    mpq_init(t);
    for (size_t i = 0; i < set->count; i++) inside[i] = true;
    for (size_t h = 0; h < count; h++) {
        size_t outside = 0;
        for (size_t i = 0; i < set->count; i++) {
            mpq_set_d(sum, -offsets[h]);
            for (size_t k = 0; k < (size_t)dim; k++) {
                mpq_set_d(t, normals[h * (size_t)dim + k]);
                mpq_mul(t, t, set->x[i * (size_t)dim + k]);
                mpq_add(sum, sum, t);
            }
            outside += mpq_sgn(sum) > 0;
            inside[i] = inside[i] && mpq_sgn(sum) <= 0;
        }
        all_outside = all_outside || outside == set->count;
    }
    for (size_t i = 0; i < set->count; i++) one_inside = one_inside || inside[i];
    mpq_clear(sum);
    mpq_clear(t);
    free(inside);
    return one_inside ? 1 : all_outside && set->radius == 0 ? 0 : -1;
}

/* ---------------------------------------------------------------- guessing -- */

/* Numbers of up to 4 points of a set of differences. */
typedef struct simplex {
    size_t at[5];
    int count;
} simplex;

/* Goes through all simplices of n points, small ones first; begins with count 0. */
static bool next_simplex(simplex *s, size_t n, int most) {
    int i = s->count - 1;
    while (i >= 0 && s->at[i] == n - (size_t)(s->count - i)) i--;
    if (i < 0) {
        if (s->count == most || (size_t)s->count == n) return false;
        s->count++;
        for (int j = 0; j < s->count; j++) s->at[j] = (size_t)j;
        return true;
    }
    s->at[i]++;
    for (int j = i + 1; j < s->count; j++) s->at[j] = s->at[j - 1] + 1;
    return true;
}

/* Determinant of the m x m matrix g, with column c replaced by r unless c < 0. */
static double determinant(int m, double g[3][3], const double r[3], int c) {
    double a[3][3];
    for (int i = 0; i < m; i++)
        for (int j = 0; j < m; j++) a[i][j] = j == c ? r[i] : g[i][j];
    if (m == 0) return 1;
    if (m == 1) return a[0][0];
    if (m == 2) return a[0][0] * a[1][1] - a[0][1] * a[1][0];
    return a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) - a[0][1] * (a[1][0] * a[2][2] - a[1][2] * a[2][0]) +
           a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0]);
}

/* Where the simplex is nearest to the origin, about, and the corners' shares in it; false when that is not inside. */
static bool nearest_point(int dim, const double *points, const simplex *s, double *nearest, double *shares) {
    double e[3][3], g[3][3], r[3] = {0}; /* m may be 0, where gcc is not sure that nothing is asked of r */
    const double *p = points + s->at[0] * (size_t)dim;
    int m = s->count - 1;
    bool inside = true;
    for (int i = 0; i < m; i++)
        for (int k = 0; k < dim; k++) e[i][k] = points[s->at[i + 1] * (size_t)dim + (size_t)k] - p[k];
    for (int i = 0; i < m; i++) {
        r[i] = 0;
        for (int k = 0; k < dim; k++) r[i] -= e[i][k] * p[k];
        for (int j = 0; j < m; j++) {
            g[i][j] = 0;
            for (int k = 0; k < dim; k++) g[i][j] += e[i][k] * e[j][k];
        }
    }
    double d = determinant(m, g, r, -1);
    if (!(d > 0)) return false;
    shares[0] = 1;
    for (int k = 0; k < dim; k++) nearest[k] = p[k];
    for (int i = 0; i < m; i++) {
        shares[i + 1] = determinant(m, g, r, i) / d;
        shares[0] -= shares[i + 1];
        for (int k = 0; k < dim; k++) nearest[k] += shares[i + 1] * e[i][k];
        inside = inside && shares[i + 1] >= 0;
    }
    return inside && shares[0] >= 0;
}

/* About the squared distance of the simplex and the origin, if its nearest point is inside; else infinity. Of simplices
 * around the origin those that hold it best come first. */
static double guess_distance(int dim, const double *points, const simplex *s) {
    double p[3], shares[4], least = 1, square = 0;
    if (!nearest_point(dim, points, s, p, shares)) return INFINITY;
    for (int i = 0; i < s->count; i++) least = fmin(least, shares[i]);
    for (int k = 0; k < dim; k++) square += p[k] * p[k];
    return s->count == dim + 1 ? -least : square;
}

/* The best simplex with corners among those of `from`, and its distance. */
static simplex best_of(int dim, const double *points, const simplex *from, double *least) {
    simplex s = {.count = 0}, best = {.count = 0};
    *least = INFINITY;
    while (next_simplex(&s, (size_t)from->count, dim + 1)) {
        simplex named = s;
        for (int i = 0; i < s.count; i++) named.at[i] = from->at[s.at[i]];
        double d = guess_distance(dim, points, &named);
        if (d < *least) *least = d, best = named;
    }
    return best;
}

/* The point furthest back from where the simplex is nearest to the origin. */
static size_t furthest_back(int dim, const double *points, size_t n, const simplex *s) {
    double p[3], shares[4], least = INFINITY;
    size_t at = 0;
    nearest_point(dim, points, s, p, shares);
    for (size_t i = 0; i < n; i++) {
        double value = 0;
        for (int k = 0; k < dim; k++) value += p[k] * points[i * (size_t)dim + (size_t)k];
        if (value < least) least = value, at = i;
    }
    return at;
}

/* Adds the point furthest back until that does not help. */
static simplex guess(int dim, const double *points, size_t n) {
    simplex s = {.at = {0}, .count = 1};
    double least = guess_distance(dim, points, &s), better;
    for (int step = 0; step < 100 && least > 0 && s.count <= dim; step++) {
        simplex more = s;
        more.at[more.count++] = furthest_back(dim, points, n, &s);
        more = best_of(dim, points, &more, &better);
        if (!(better < least)) break;
        s = more;
        least = better;
    }
    return s;
}

/* ----------------------------------------------------------------- proving -- */

typedef struct proof {
    int dim;
    size_t n;
    mpq_t *points; /* the differences */
    mpq_t e[3][3], g[3][4], p[3], t, share[3];
} proof;

static mpq_t *difference(proof *f, size_t i) {
    return f->points + i * (size_t)f->dim;
}

static void dot(proof *f, mpq_t *a, mpq_t *b, mpq_t out) {
    mpq_set_ui(out, 0, 1);
    for (int k = 0; k < f->dim; k++) mpq_mul(f->t, a[k], b[k]), mpq_add(out, out, f->t);
}

/* Solves the m equations of g for the shares; false when they are dependent. */
static bool find_shares(proof *f, int m) {
    mpq_t q;
    bool found = true;
    mpq_init(q);
    for (int c = 0; c < m && found; c++) { /* the matrix of a simplex is positive definite: no pivoting */
        found = mpq_sgn(f->g[c][c]) != 0;
        for (int i = 0; i < m && found; i++) {
            if (i == c) continue;
            mpq_div(q, f->g[i][c], f->g[c][c]);
            for (int k = 0; k <= m; k++) mpq_mul(f->t, q, f->g[c][k]), mpq_sub(f->g[i][k], f->g[i][k], f->t);
        }
    }
    for (int i = 0; i < m && found; i++) mpq_div(f->share[i], f->g[i][m], f->g[i][i]);
    mpq_clear(q);
    return found;
}

/* Does the simplex hold the point nearest to the origin? Then f->p is it. */
static bool prove(proof *f, const simplex *s) {
    int m = s->count - 1;
    mpq_t *first = difference(f, s->at[0]), rest, square, side;
    mpq_init(rest);
    mpq_init(square);
    mpq_init(side);
    for (int i = 0; i < m; i++)
        for (int k = 0; k < f->dim; k++) mpq_sub(f->e[i][k], difference(f, s->at[i + 1])[k], first[k]);
    for (int i = 0; i < m; i++) {
        for (int j = 0; j < m; j++) dot(f, f->e[i], f->e[j], f->g[i][j]);
        dot(f, f->e[i], first, f->g[i][m]);
        mpq_neg(f->g[i][m], f->g[i][m]);
    }
    bool holds = find_shares(f, m);
    mpq_set_ui(rest, 1, 1);
    for (int k = 0; k < f->dim; k++) mpq_set(f->p[k], first[k]);
    for (int i = 0; i < m && holds; i++) {
        holds = mpq_sgn(f->share[i]) >= 0;
        mpq_sub(rest, rest, f->share[i]);
        for (int k = 0; k < f->dim; k++) mpq_mul(f->t, f->share[i], f->e[i][k]), mpq_add(f->p[k], f->p[k], f->t);
    }
    holds = holds && mpq_sgn(rest) >= 0;
    dot(f, f->p, f->p, square);
    for (size_t i = 0; i < f->n && holds && mpq_sgn(square); i++) {
        dot(f, f->p, difference(f, i), side);
        holds = mpq_cmp(side, square) >= 0;
    }
    mpq_clear(rest);
    mpq_clear(square);
    mpq_clear(side);
    return holds;
}

static void proof_begin(proof *f, const oracle_set *a, const oracle_set *b) {
    size_t dim = (size_t)a->dim;
    f->dim = a->dim;
    f->n = a->count * b->count;
    f->points = malloc(f->n * dim * sizeof *f->points);
    for (size_t i = 0; i < f->n * dim; i++) {
        mpq_init(f->points[i]);
        mpq_sub(f->points[i], a->x[i / dim / b->count * dim + i % dim], b->x[i / dim % b->count * dim + i % dim]);
    }
    mpq_init(f->t);
    for (int i = 0; i < 3; i++) {
        mpq_init(f->p[i]);
        mpq_init(f->share[i]);
        for (int k = 0; k < 3; k++) mpq_init(f->e[i][k]);
        for (int k = 0; k < 4; k++) mpq_init(f->g[i][k]);
    }
}

static void proof_end(proof *f) {
    for (size_t i = 0; i < f->n * (size_t)f->dim; i++) mpq_clear(f->points[i]);
    free(f->points);
    mpq_clear(f->t);
    for (int i = 0; i < 3; i++) {
        mpq_clear(f->p[i]);
        mpq_clear(f->share[i]);
        for (int k = 0; k < 3; k++) mpq_clear(f->e[i][k]);
        for (int k = 0; k < 4; k++) mpq_clear(f->g[i][k]);
    }
}

void oracle_distance2(const oracle_set *a, const oracle_set *b, mpq_t out) {
    proof f;
    proof_begin(&f, a, b);
    double *images = malloc((f.n * (size_t)f.dim + 1) * sizeof *images);
    double most = 0;
    for (size_t i = 0; i < f.n * (size_t)f.dim; i++) most = fmax(most, fabs(images[i] = mpq_get_d(f.points[i])));
    int exponent = 0;
    if (isfinite(most)) frexp(most, &exponent); /* so that products neither overflow nor vanish */
    for (size_t i = 0; i < f.n * (size_t)f.dim; i++) images[i] = ldexp(images[i], -exponent);
    simplex s = guess(f.dim, images, f.n);
    if (!s.count || !prove(&f, &s)) {
        s.count = 0;
        while (next_simplex(&s, f.n, f.dim + 1) && !prove(&f, &s)) {
        }
    }
    dot(&f, f.p, f.p, out);
    free(images);
    proof_end(&f);
}

/* ----------------------------------------------------------------- meeting -- */

static bool within(mpq_t square, double radius_a, double radius_b) {
    mpq_t r, s;
    mpq_init(r);
    mpq_init(s);
    mpq_set_d(r, radius_a);
    mpq_set_d(s, radius_b);
    mpq_add(r, r, s);
    mpq_mul(r, r, r);
    bool is = mpq_cmp(square, r) <= 0;
    mpq_clear(r);
    mpq_clear(s);
    return is;
}

/* Are the bounds certainly further apart than the radii on some axis? */
static bool clearly_apart(const oracle_set *a, const oracle_set *b) {
    double reach = (a->radius + b->radius) * (1 + 0x1p-50);
    for (int k = 0; k < a->dim; k++) {
        double gap = fmax(a->lo[k] - b->hi[k], b->lo[k] - a->hi[k]); /* a positive difference is never rounded to 0 */
        if (gap * (1 - 0x1p-50) > reach) return true;
    }
    return false;
}

bool oracle_meet(const oracle_set *a, const oracle_set *b) {
    if (!a->count || !b->count || clearly_apart(a, b)) return false;
    mpq_t square;
    mpq_init(square);
    oracle_distance2(a, b, square);
    bool meets = within(square, a->radius, b->radius);
    mpq_clear(square);
    return meets;
}

bool oracle_meet_boxes(int dim, const double *lo_a, const double *hi_a, double radius_a, const double *lo_b,
                       const double *hi_b, double radius_b) {
    mpq_t sum, gap, t;
    mpq_init(sum);
    mpq_init(gap);
    mpq_init(t);
    for (int k = 0; k < dim; k++) {
        if (hi_a[k] >= lo_b[k] && hi_b[k] >= lo_a[k]) continue;
        bool below = hi_a[k] < lo_b[k];
        mpq_set_d(gap, below ? lo_b[k] : lo_a[k]);
        mpq_set_d(t, below ? hi_a[k] : hi_b[k]);
        mpq_sub(gap, gap, t);
        mpq_mul(gap, gap, gap);
        mpq_add(sum, sum, gap);
    }
    bool meets = within(sum, radius_a, radius_b);
    mpq_clear(sum);
    mpq_clear(gap);
    mpq_clear(t);
    return meets;
}
