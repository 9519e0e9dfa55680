/* guess.c: see guess.h. */
#include "geom/high/guess.h"
#include "num/solve.h"
#include <float.h>
#include <string.h>

enum { STEPS = 64, SIZE = FROE_MAX_DIM };

/* Relative error of a sum of products with up to dim + 5 roundings, more than twice over. */
#define SUM_ERROR 0x1p-48

/* -------------------------------------------------------------- coordinates -- */

static double scaled(const geom_guess *g, const geom_convex *c, uint32_t i, int k) {
    return geom_convex_coordinate(c, i, k) * g->scale - g->origin[k];
}

static double greatest(const geom_convex *c) {
    double most = 0;
    const uint32_t points = c->core == GEOM_CORE_BOX ? 2 : c->count;
    for (uint32_t i = 0; i < points; i++)
        for (int k = 0; k < c->dim; k++) most = fmax(most, fabs(geom_convex_point(c, i)[k]));
    return most;
}

/* The lowest value of sign * n . x among the corners x of a set, and its corner; *size: the greatest sum of the sizes
 * of its terms. */
static double lowest_corner(const geom_guess *g, const geom_convex *c, const double *n, int sign, uint32_t *at,
                            double *size) {
    double least = INFINITY;
    *at = 0;
    if (c->core == GEOM_CORE_BOX) { /* on each axis by itself */
        least = 0;
        for (int k = 0; k < c->dim; k++) {
            const bool high = sign * n[k] < 0;
            const double x = scaled(g, c, high ? c->count - 1 : 0, k), y = scaled(g, c, high ? 0 : c->count - 1, k);
            *at |= (uint32_t)high << k;
            least += sign * n[k] * x;
            *size += fabs(n[k]) * fmax(fabs(x), fabs(y));
        }
        return least;
    }
    double largest = 0;
    for (uint32_t i = 0; i < c->count; i++) {
        double sum = 0, terms = 0;
        for (int k = 0; k < c->dim; k++) {
            const double term = sign * n[k] * scaled(g, c, i, k);
            sum += term;
            terms += fabs(term);
        }
        largest = fmax(largest, terms);
        if (sum < least) least = sum, *at = i;
    }
    *size += largest;
    return least;
}

static double dot(int dim, const double *a, const double *b) {
    double sum = 0;
    for (int k = 0; k < dim; k++) sum += a[k] * b[k];
    return sum;
}

/* ------------------------------------------------------------------- faces -- */

/* Weights of the point of the affine hull that is nearest to 0, of dim + 1 corners at most. */
static bool affine_weights(int dim, double y[GEOM_SIMPLEX][SIZE], int count, double *weight) {
    double e[SIZE][SIZE], a[SIZE][NUM_TABLE_COLUMNS];
    const int m = count - 1;
    for (int i = 0; i < m; i++)
        for (int k = 0; k < dim; k++) e[i][k] = y[i + 1][k] - y[0][k];
    for (int i = 0; i < m; i++) {
        for (int j = 0; j < m; j++) a[i][j] = dot(dim, e[i], e[j]);
        a[i][m] = -dot(dim, e[i], y[0]);
    }
    if (!num_plain_solve(m, m + 1, a)) return false;
    weight[0] = 1;
    for (int i = 0; i < m; i++) weight[i + 1] = a[i][m], weight[0] -= a[i][m];
    return true;
}

typedef struct guess_search {
    geom_guess *g;
    int dim;
    double y[GEOM_SIMPLEX][SIZE];
} guess_search;

static void drop(guess_search *s, int i) {
    geom_simplex *at = &s->g->simplex;
    const int last = --at->count;
    at->a[i] = at->a[last];
    at->b[i] = at->b[last];
    s->g->weight[i] = s->g->weight[last];
    memcpy(s->y[i], s->y[last], sizeof s->y[i]);
}

/* Goes towards the point of the affine hull nearest to 0, and drops what keeps it from getting there. False: the last
 * difference depends on the others, and is dropped. */
static bool reduce(guess_search *s) {
    double aim[GEOM_SIMPLEX], *weight = s->g->weight;
    int *const count = &s->g->simplex.count;
    for (;;) {
        if (!affine_weights(s->dim, s->y, *count, aim)) return --*count, false;
        double step = 1;
        int first = -1;
        for (int i = 0; i < *count; i++) {
            if (aim[i] > 0) continue;
            const double share = weight[i] / (weight[i] - aim[i]);
            if (first < 0 || share < step) step = share, first = i;
        }
        for (int i = 0; i < *count; i++)
            weight[i] = fmax(0, first < 0 ? aim[i] : weight[i] + step * (aim[i] - weight[i]));
        if (first < 0) break;
        drop(s, first);
        if (*count == 1) weight[0] = 1;
    }
    for (int k = 0; k < s->dim; k++) {
        s->g->x[k] = 0;
        for (int i = 0; i < *count; i++) s->g->x[k] += weight[i] * s->y[i][k];
    }
    return true;
}

static bool is_in_simplex(const geom_simplex *s, uint32_t a, uint32_t b) {
    for (int i = 0; i < s->count; i++)
        if (s->a[i] == a && s->b[i] == b) return true;
    return false;
}

static void place(guess_search *s, const geom_convex *a, const geom_convex *b, int i) {
    const geom_simplex *at = &s->g->simplex;
    for (int k = 0; k < s->dim; k++) s->y[i][k] = scaled(s->g, a, at->a[i], k) - scaled(s->g, b, at->b[i], k);
}

geom_guess geom_guess_between(const geom_convex *a, const geom_convex *b) {
    geom_guess g = {.simplex = {.count = 1}, .weight = {1}};
    guess_search s = {.g = &g, .dim = a->dim};
    int power;
    frexp(fmax(greatest(a), greatest(b)), &power);
    g.scale = ldexp(1, power > 1000 ? -1000 : power < -1000 ? 1000 : -power);
    for (int k = 0; k < s.dim; k++) g.origin[k] = geom_convex_coordinate(a, 0, k) * g.scale;
    place(&s, a, b, 0);
    memcpy(g.x, s.y[0], sizeof g.x);
    /* one way: each step is nearer to 0, so that the limit is one of time alone */
    for (int step = 0; step < STEPS; step++) {
        double size = 0, before = dot(s.dim, g.x, g.x);
        uint32_t i, j;
        const double low = lowest_corner(&g, a, g.x, 1, &i, &size) + lowest_corner(&g, b, g.x, -1, &j, &size);
        const int last = g.simplex.count;
        if (last > s.dim || before == 0 || !(low < before * (1 - 0x1p-50)) || is_in_simplex(&g.simplex, i, j)) break;
        g.simplex.a[last] = i;
        g.simplex.b[last] = j;
        g.weight[last] = 0;
        g.simplex.count++;
        place(&s, a, b, last);
        if (!reduce(&s) || !(dot(s.dim, g.x, g.x) < before)) break;
    }
    return g;
}

/* ----------------------------------------------------------------- certainty -- */

void geom_guess_bounds(const geom_guess *g, const geom_convex *a, const geom_convex *b, double *least, double *most) {
    const int dim = a->dim;
    double n[SIZE], reach[SIZE], longest = 0, size = 0, sum = 0, square = 0, furthest = 0;
    uint32_t i, j;
    *least = 0;
    *most = INFINITY;
    for (int k = 0; k < dim; k++) longest = fmax(longest, fabs(g->x[k]));
    /* what both reach along x, of length 1 or a little more */
    if (longest > 0x1p-500) { /* where x is not finite nothing is sure */
        for (int k = 0; k < dim; k++) n[k] = g->x[k] / longest, square += n[k] * n[k];
        const double length = sqrt(square) * (1 + SUM_ERROR);
        const double low = lowest_corner(g, a, n, 1, &i, &size) + lowest_corner(g, b, n, -1, &j, &size);
        const double sure = (low - SUM_ERROR * size - NUM_BALL_TINY) * (1 - SUM_ERROR) / length;
        if (sure > 0) *least = sure;
    }
    /* the point by the weights, of which the sum need not be 1: it is divided by that, so that the point is in the hull
     */
    for (int m = 0; m < g->simplex.count; m++) sum += g->weight[m];
    square = 0;
    for (int k = 0; k < dim; k++) {
        double x = 0, error = 0;
        for (int m = 0; m < g->simplex.count; m++) {
            const double p = scaled(g, a, g->simplex.a[m], k), q = scaled(g, b, g->simplex.b[m], k);
            x += g->weight[m] * (p - q);
            error += g->weight[m] * (fabs(p) + fabs(q));
        }
        reach[k] = fabs(x) + SUM_ERROR * error + NUM_BALL_TINY;
        furthest = fmax(furthest, reach[k]);
    }
    for (int k = 0; k < dim; k++) square += reach[k] / furthest * (reach[k] / furthest); /* does not underflow */
    const double far = furthest * sqrt(square) / sum * (1 + SUM_ERROR);
    if (far >= 0) *most = far; /* one way: weights are numbers, which is not relied on */
    *least = *least / g->scale * (1 - 0x1p-50) - 0x1p-1070;
    *most = *most / g->scale * (1 + 0x1p-50) + 0x1p-1070;
    *least = *least > 0 ? fmin(*least, DBL_MAX) : 0;
}

/* With the edges E of the simplex from its first difference y, and about their inverse R, the weights are R (-y), and
 * off by at most |R| |E R y - y| / (1 - |E R - 1|) (in the norm of the greatest sum of a row). */
bool geom_guess_inside(const geom_guess *g, const geom_convex *a, const geom_convex *b) {
    const int dim = a->dim;
    double y[GEOM_SIMPLEX][SIZE], reach = 0;
    if (g->simplex.count != dim + 1) return false;
    for (int i = 0; i <= dim; i++)
        for (int k = 0; k < dim; k++) {
            const double p = scaled(g, a, g->simplex.a[i], k), q = scaled(g, b, g->simplex.b[i], k);
            y[i][k] = p - q;
            reach = fmax(reach, fabs(p) + fabs(q));
        }
    /* The error of any entry of E and y, and of products with them: generous, as well-shaped simplices have room. */
    const double error = 0x1p-44 * reach + NUM_BALL_TINY;
    double r[SIZE][SIZE], norm = 0, excess = 0, residue = 0;
    double table[SIZE][NUM_TABLE_COLUMNS];
    for (int c = 0; c < dim; c++) { /* column c of R: E R_c = unit vector c */
        for (int k = 0; k < dim; k++) {
            for (int i = 0; i < dim; i++) table[k][i] = y[i + 1][k] - y[0][k];
            table[k][dim] = k == c;
        }
        if (!num_plain_solve(dim, dim + 1, table)) return false;
        for (int i = 0; i < dim; i++) r[i][c] = table[i][dim];
    }
    double weight[SIZE], rest = 1, least = INFINITY;
    for (int i = 0; i < dim; i++) {
        double sum = 0;
        weight[i] = 0;
        for (int k = 0; k < dim; k++) sum += fabs(r[i][k]), weight[i] -= r[i][k] * y[0][k];
        if (!(sum < 0x1p80 / reach)) return false; /* one way: flatter edges were refused above; not a number, too */
        norm = fmax(norm, sum);
        rest -= weight[i];
        least = fmin(least, weight[i]);
    }
    least = fmin(least, rest);
    for (int k = 0; k < dim; k++) {
        double row = 0, off = y[0][k], sizes = 0;
        for (int i = 0; i < dim; i++) {
            const double e = y[i + 1][k] - y[0][k];
            off += e * weight[i];
            sizes += fabs(weight[i]);
        }
        for (int c = 0; c < dim; c++) {
            double sum = k == c ? -1 : 0;
            for (int i = 0; i < dim; i++) sum += (y[i + 1][k] - y[0][k]) * r[i][c];
            row += fabs(sum);
        }
        excess = fmax(excess, row);
        residue = fmax(residue, fabs(off) + (1 + sizes) * error);
    }
    excess += dim * norm * error;
    const double doubt = norm * residue / (1 - excess);
    return excess < 0.5 && dim * 2 * doubt < least; /* also of the rest, which sums them up */
}
