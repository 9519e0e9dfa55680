/* high.c: see high.h. */
#include "oracle/high.h"
#include "scene/scene.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ------------------------------------------------------------------- sets -- */

high_set high_box(int dim, const double *lo, const double *hi) {
    high_set s = {.dim = dim, .count = (size_t)1 << dim};
    for (size_t i = 0; i < s.count; i++)
        for (int k = 0; k < dim; k++) s.x[i][k] = i >> k & 1 ? hi[k] : lo[k];
    return s;
}

high_set high_point(int dim, const double *x) {
    high_set s = {.dim = dim, .count = 1};
    memcpy(s.x[0], x, (size_t)dim * sizeof *x);
    return s;
}

high_set high_of(const geom_body *body) {
    if (body->form == FROE_BOX) return high_box(body->dim, geom_body_point(body, 0), geom_body_point(body, 1));
    high_set s = {.dim = body->dim, .count = body->count, .radius = body->form == FROE_BALL ? body->radius : 0};
    if (s.count > HIGH_CORNERS) abort();
    for (uint32_t i = 0; i < body->count; i++)
        memcpy(s.x[i], geom_body_point(body, i), (size_t)body->dim * sizeof(double));
    return s;
}

high_set high_object(const froe_scene *scene, uint32_t object) {
    const geom_body body = scene_body(scene, object);
    return high_of(&body);
}

/* ---------------------------------------------------------- linear programs -- */

/* Rows of a table: `columns` numbers and the right side; the last row is the cost. Each row begins with an artificial
 * column as its basis, columns + row, which is never written down: it does not come back. */
typedef struct table {
    int rows, columns;
    mpq_t *at;
    int *basis;
} table;

static mpq_t *at(const table *t, int i, int j) {
    return t->at + (size_t)i * (size_t)(t->columns + 1) + j;
}

static table table_new(int rows, int columns) {
    table t = {.rows = rows, .columns = columns};
    const size_t count = (size_t)(rows + 1) * (size_t)(t.columns + 1);
    t.at = malloc(count * sizeof *t.at);
    t.basis = malloc((size_t)rows * sizeof *t.basis);
    for (size_t i = 0; i < count; i++) mpq_init(t.at[i]);
    return t;
}

static void table_free(table *t) {
    for (size_t i = 0; i < (size_t)(t->rows + 1) * (size_t)(t->columns + 1); i++) mpq_clear(t->at[i]);
    free(t->at), free(t->basis);
}

/* row i -= factor * row r */
static void subtract(table *t, int i, int r, mpq_t factor) {
    mpq_t x, f;
    mpq_inits(x, f, NULL);
    mpq_set(f, factor);
    for (int j = 0; j <= t->columns && mpq_sgn(f); j++) {
        if (!mpq_sgn(*at(t, r, j))) continue;
        mpq_mul(x, f, *at(t, r, j));
        mpq_sub(*at(t, i, j), *at(t, i, j), x);
    }
    mpq_clears(x, f, NULL);
}

static void pivot(table *t, int r, int c) {
    mpq_t p;
    mpq_init(p);
    mpq_set(p, *at(t, r, c));
    for (int j = 0; j <= t->columns; j++) mpq_div(*at(t, r, j), *at(t, r, j), p);
    for (int i = 0; i <= t->rows; i++)
        if (i != r) subtract(t, i, r, *at(t, i, c));
    t->basis[r] = c;
    mpq_clear(p);
}

/* Makes the cost least. */
static void descend(table *t) {
    mpq_t share, least;
    mpq_inits(share, least, NULL);
    for (;;) {
        int c = 0, r = -1;
        while (c < t->columns && mpq_sgn(*at(t, t->rows, c)) >= 0) c++;
        if (c == t->columns) break;
        for (int i = 0; i < t->rows; i++) {
            if (mpq_sgn(*at(t, i, c)) <= 0) continue;
            mpq_div(share, *at(t, i, t->columns), *at(t, i, c));
            const int order = r < 0 ? -1 : mpq_cmp(share, least);
            if (order < 0 || (order == 0 && t->basis[i] < t->basis[r])) r = i, mpq_set(least, share);
        }
        if (r < 0) abort(); /* unbounded */
        pivot(t, r, c);
    }
    mpq_clears(share, least, NULL);
}

/* Solves the rows filled in the first columns and the right side. Artificial columns that have no weight leave the
 * basis, or their rows say nothing. False: there is no solution. */
static bool find_start(table *t) {
    for (int i = 0; i < t->rows; i++) {
        if (mpq_sgn(*at(t, i, t->columns)) < 0)
            for (int j = 0; j <= t->columns; j++) mpq_neg(*at(t, i, j), *at(t, i, j));
        t->basis[i] = t->columns + i;
    }
    for (int j = 0; j <= t->columns; j++)
        for (int i = 0; i < t->rows; i++) mpq_sub(*at(t, t->rows, j), *at(t, t->rows, j), *at(t, i, j));
    descend(t);
    if (mpq_sgn(*at(t, t->rows, t->columns)) != 0) return false;
    for (int i = 0; i < t->rows; i++)
        for (int j = 0; j < t->columns && t->basis[i] >= t->columns; j++)
            if (mpq_sgn(*at(t, i, j))) pivot(t, i, j);
    return true;
}

/* The greatest (-1) or least (1) value of a column, from a start. */
static void best_value(table *t, int column, int sense, mpq_t out) {
    for (int j = 0; j <= t->columns; j++) mpq_set_si(*at(t, t->rows, j), j == column ? sense : 0, 1);
    for (int i = 0; i < t->rows; i++)
        if (t->basis[i] == column) subtract(t, t->rows, i, *at(t, t->rows, column));
    descend(t);
    mpq_set_ui(out, 0, 1);
    for (int i = 0; i < t->rows; i++)
        if (t->basis[i] == column) mpq_set(out, *at(t, i, t->columns));
}

static void put(table *t, int i, int j, int sign, double x) {
    mpq_set_d(*at(t, i, j), sign * x);
}

/* Weights of a, then of b, that make the same point; so many columns more. */
static table meeting(const high_set *a, const high_set *b, int more) {
    const int n = (int)a->count, m = (int)b->count, d = a->dim;
    table t = table_new(d + 2, n + m + more);
    for (int k = 0; k < d; k++) {
        for (int i = 0; i < n; i++) put(&t, k, i, 1, a->x[i][k]);
        for (int i = 0; i < m; i++) put(&t, k, n + i, -1, b->x[i][k]);
    }
    for (int i = 0; i < n; i++) put(&t, d, i, 1, 1);
    for (int i = 0; i < m; i++) put(&t, d + 1, n + i, 1, 1);
    put(&t, d, t.columns, 1, 1), put(&t, d + 1, t.columns, 1, 1);
    return t;
}

bool high_hulls_meet(const high_set *a, const high_set *b) {
    table t = meeting(a, b, 0);
    const bool meet = find_start(&t);
    table_free(&t);
    return meet;
}

static bool interiors_meet(const high_set *a, const high_set *b) {
    const int corners = (int)(a->count + b->count);
    table t = meeting(a, b, 1);
    mpq_t most;
    mpq_init(most);
    for (int i = 0; i < t.rows; i++)
        for (int j = 0; j < corners; j++) mpq_add(*at(&t, i, corners), *at(&t, i, corners), *at(&t, i, j));
    bool meet = find_start(&t);
    if (meet) best_value(&t, corners, -1, most);
    meet = meet && mpq_sgn(most) > 0;
    mpq_clear(most);
    table_free(&t);
    return meet;
}

bool high_ray(const double *origin, const double *direction, const high_set *a, mpq_t out) {
    const int n = (int)a->count, d = a->dim;
    table t = table_new(d + 1, n + 1);
    for (int k = 0; k < d; k++) {
        for (int i = 0; i < n; i++) put(&t, k, i, 1, a->x[i][k]);
        put(&t, k, n, -1, direction[k]);
        put(&t, k, t.columns, 1, origin[k]);
    }
    for (int i = 0; i < n; i++) put(&t, d, i, 1, 1);
    put(&t, d, t.columns, 1, 1);
    const bool meets = find_start(&t);
    if (meets) best_value(&t, n, 1, out);
    table_free(&t);
    return meets;
}

/* The greatest distance from the walls that a point of the hull can have, not above 1:
 * sum v x + s + r = hi  and  sum v x - s - r' = lo  on each axis. */
bool high_meets_inside(const high_set *a, const double *lo, const double *hi) {
    const int n = (int)a->count, d = a->dim;
    int walls = 0;
    for (int k = 0; k < d; k++) walls += isfinite(lo[k]) + isfinite(hi[k]);
    table t = table_new(walls + 2, n + 1 + walls + 1); /* weights, s, slacks */
    int row = 0;
    for (int k = 0; k < d; k++)
        for (int side = 0; side < 2; side++) {
            const double wall = side ? hi[k] : lo[k];
            if (!isfinite(wall)) continue;
            for (int i = 0; i < n; i++) put(&t, row, i, 1, a->x[i][k]);
            put(&t, row, n, side ? 1 : -1, 1);
            put(&t, row, n + 1 + row, side ? 1 : -1, 1);
            put(&t, row++, t.columns, 1, wall);
        }
    for (int i = 0; i < n; i++) put(&t, row, i, 1, 1);
    put(&t, row++, t.columns, 1, 1);
    put(&t, row, n, 1, 1), put(&t, row, n + 1 + walls, 1, 1), put(&t, row, t.columns, 1, 1);
    mpq_t most;
    mpq_init(most);
    bool meets = find_start(&t);
    if (meets) best_value(&t, n, -1, most);
    meets = meets && mpq_sgn(most) > 0;
    mpq_clear(most);
    table_free(&t);
    return meets;
}

/* ------------------------------------------------------------------ contact -- */

/* Rank of `count` rows of dim numbers. */
static int rank_of(mpq_t *rows, size_t count, int dim) {
    int rank = 0;
    mpq_t f, x;
    mpq_inits(f, x, NULL);
    for (int c = 0; c < dim; c++) {
        size_t r = (size_t)rank;
        while (r < count && !mpq_sgn(rows[r * (size_t)dim + (size_t)c])) r++;
        if (r == count) continue;
        for (int k = 0; k < dim; k++) mpq_swap(rows[r * (size_t)dim + (size_t)k], rows[(size_t)(rank * dim + k)]);
        for (size_t i = (size_t)rank + 1; i < count; i++) {
            mpq_div(f, rows[i * (size_t)dim + (size_t)c], rows[rank * dim + c]);
            for (int k = 0; k < dim; k++) {
                mpq_mul(x, f, rows[rank * dim + k]);
                mpq_sub(rows[i * (size_t)dim + (size_t)k], rows[i * (size_t)dim + (size_t)k], x);
            }
        }
        rank++;
    }
    mpq_clears(f, x, NULL);
    return rank;
}

/* Of the corners of one or two sets, each from its first one. */
static int rank_of_sets(const high_set *a, const high_set *b) {
    const size_t count = a->count + (b ? b->count : 0), dim = (size_t)a->dim;
    mpq_t *rows = malloc(count * dim * sizeof *rows), x;
    mpq_init(x);
    for (size_t i = 0; i < count; i++)
        for (size_t k = 0; k < dim; k++) {
            const high_set *s = i < a->count ? a : b;
            mpq_init(rows[i * dim + k]);
            mpq_set_d(rows[i * dim + k], s->x[i < a->count ? i : i - a->count][k]);
            mpq_set_d(x, s->x[0][k]);
            mpq_sub(rows[i * dim + k], rows[i * dim + k], x);
        }
    const int rank = rank_of(rows, count, a->dim);
    for (size_t i = 0; i < count * dim; i++) mpq_clear(rows[i]);
    free(rows);
    mpq_clear(x);
    return rank;
}

int high_rank(const high_set *a) {
    return rank_of_sets(a, NULL);
}

static bool same(const high_set *a, size_t i, const high_set *b, size_t j) {
    for (int k = 0; k < a->dim; k++)
        if (a->x[i][k] != b->x[j][k]) return false;
    return true;
}

/* Are there weights of the vectors a - x and x - b, without those that are 0, that make 0? */
static bool cones_meet(const high_set *a, const high_set *b, const double *x) {
    const int d = a->dim;
    int columns = 0;
    table t = table_new(d + 1, (int)(a->count + b->count));
    mpq_t p;
    mpq_init(p);
    for (size_t i = 0; i < a->count + b->count; i++) {
        const double *y = i < a->count ? a->x[i] : b->x[i - a->count];
        bool zero = true;
        for (int k = 0; k < d; k++) zero = zero && x[k] == y[k];
        if (zero) continue;
        for (int k = 0; k < d; k++) {
            mpq_set_d(*at(&t, k, columns), i < a->count ? y[k] : x[k]);
            mpq_set_d(p, i < a->count ? x[k] : y[k]);
            mpq_sub(*at(&t, k, columns), *at(&t, k, columns), p);
        }
        mpq_set_ui(*at(&t, d, columns++), 1, 1);
    }
    mpq_set_ui(*at(&t, d, t.columns), 1, 1);
    const bool meet = columns && find_start(&t);
    mpq_clear(p);
    table_free(&t);
    return meet || !columns;
}

int high_contact(const high_set *a, const high_set *b, bool *corner) {
    *corner = false;
    if (!high_hulls_meet(a, b)) return 0;
    const bool inner = interiors_meet(a, b);
    for (size_t i = 0; i < a->count; i++)
        for (size_t j = 0; j < b->count; j++)
            if (!inner && same(a, i, b, j) && !cones_meet(a, b, a->x[i])) *corner = true;
    if (!inner) return 2;
    const int x = high_rank(a), y = high_rank(b);
    return rank_of_sets(a, b) == (x > y ? x : y) ? 3 : 1;
}

/* ----------------------------------------------------------------- distance -- */

enum { SIMPLEX = FROE_MAX_DIM + 1 };

typedef struct wolfe {
    int dim, count;
    mpq_t y[SIMPLEX][FROE_MAX_DIM], w[SIMPLEX], aim[SIMPLEX], x[FROE_MAX_DIM];
    mpq_t a[SIMPLEX + 1][SIMPLEX + 2], f, g;
} wolfe;

static void wolfe_each(wolfe *s, void (*fn)(mpq_ptr)) {
    for (int i = 0; i < SIMPLEX; i++) {
        for (int k = 0; k < FROE_MAX_DIM; k++) fn(s->y[i][k]);
        fn(s->w[i]), fn(s->aim[i]);
    }
    for (int i = 0; i <= SIMPLEX; i++)
        for (int j = 0; j < SIMPLEX + 2; j++) fn(s->a[i][j]);
    for (int k = 0; k < FROE_MAX_DIM; k++) fn(s->x[k]);
    fn(s->f), fn(s->g);
}

static void dot_of(wolfe *s, mpq_t *p, mpq_t *q, mpq_t out) {
    mpq_t z;
    mpq_init(z);
    mpq_set_ui(out, 0, 1);
    for (int k = 0; k < s->dim; k++) mpq_mul(z, p[k], q[k]), mpq_add(out, out, z);
    mpq_clear(z);
}

/* Weights of the nearest point of the affine hull: (y_i . y_j) aim + l = 0, sum aim = 1. */
static void aim(wolfe *s) {
    const int n = s->count;
    for (int i = 0; i <= n; i++)
        for (int j = 0; j <= n + 1; j++) {
            if (i < n && j < n)
                dot_of(s, s->y[i], s->y[j], s->a[i][j]);
            else
                mpq_set_ui(s->a[i][j], i == n ? j != n : j == n, 1);
        }
    for (int c = 0; c <= n; c++) {
        int r = c;
        while (r <= n && !mpq_sgn(s->a[r][c])) r++;
        if (r > n) abort(); /* dependent: does not happen */
        for (int j = 0; j <= n + 1; j++) mpq_swap(s->a[r][j], s->a[c][j]);
        for (int i = 0; i <= n; i++) {
            if (i == c) continue;
            mpq_div(s->f, s->a[i][c], s->a[c][c]);
            for (int j = c; j <= n + 1; j++) {
                mpq_mul(s->g, s->f, s->a[c][j]);
                mpq_sub(s->a[i][j], s->a[i][j], s->g);
            }
        }
    }
    for (int i = 0; i < n; i++) mpq_div(s->aim[i], s->a[i][n + 1], s->a[i][i]);
}

/* Moves towards the aim until a weight vanishes, and drops that. */
static void shrink(wolfe *s) {
    for (;;) {
        int first = -1;
        mpq_t step, share;
        mpq_inits(step, share, NULL);
        aim(s);
        for (int i = 0; i < s->count; i++) {
            if (mpq_sgn(s->aim[i]) > 0) continue;
            mpq_sub(share, s->w[i], s->aim[i]);
            if (mpq_sgn(share)) mpq_div(share, s->w[i], share);
            if (first < 0 || mpq_cmp(share, step) < 0) mpq_set(step, share), first = i;
        }
        for (int i = 0; i < s->count; i++) {
            mpq_sub(share, s->aim[i], s->w[i]);
            if (first >= 0) mpq_mul(share, share, step);
            mpq_add(s->w[i], s->w[i], share);
        }
        mpq_clears(step, share, NULL);
        if (first < 0) return;
        s->count--;
        mpq_swap(s->w[first], s->w[s->count]);
        for (int k = 0; k < s->dim; k++) mpq_swap(s->y[first][k], s->y[s->count][k]);
    }
}

void high_distance2(const high_set *a, const high_set *b, mpq_t out) {
    wolfe s = {.dim = a->dim, .count = 1};
    wolfe_each(&s, mpq_init);
    mpq_t y[FROE_MAX_DIM], value, least;
    mpq_inits(value, least, NULL);
    for (int k = 0; k < s.dim; k++) mpq_init(y[k]);
    size_t next = 0;
    for (bool more = true; more;) {
        /* the difference `next` joins, as the first one alone */
        const int at = next || s.count > 1 || mpq_sgn(s.w[0]) ? s.count : 0;
        for (int k = 0; k < s.dim; k++) {
            mpq_set_d(s.y[at][k], a->x[next / b->count][k]);
            mpq_set_d(s.f, b->x[next % b->count][k]);
            mpq_sub(s.y[at][k], s.y[at][k], s.f);
        }
        mpq_set_ui(s.w[at], at ? 0 : 1, 1);
        s.count = at + 1;
        shrink(&s);
        for (int k = 0; k < s.dim; k++) {
            mpq_set_ui(s.x[k], 0, 1);
            for (int i = 0; i < s.count; i++) mpq_mul(s.f, s.w[i], s.y[i][k]), mpq_add(s.x[k], s.x[k], s.f);
        }
        dot_of(&s, s.x, s.x, out);
        more = false;
        mpq_set(least, out);
        for (size_t i = 0; i < a->count * b->count && mpq_sgn(out); i++) {
            for (int k = 0; k < s.dim; k++) {
                mpq_set_d(y[k], a->x[i / b->count][k]);
                mpq_set_d(s.f, b->x[i % b->count][k]);
                mpq_sub(y[k], y[k], s.f);
            }
            dot_of(&s, s.x, y, value);
            if (mpq_cmp(value, least) < 0) mpq_set(least, value), next = i, more = true;
        }
    }
    for (int k = 0; k < s.dim; k++) mpq_clear(y[k]);
    mpq_clears(value, least, NULL);
    wolfe_each(&s, mpq_clear);
}

bool high_reach(const high_set *a, const high_set *b, mpq_t square) {
    mpq_t reach, more;
    mpq_inits(reach, more, NULL);
    mpq_set_d(reach, a->radius), mpq_set_d(more, b->radius);
    mpq_add(reach, reach, more);
    mpq_mul(reach, reach, reach);
    const bool meet = mpq_cmp(square, reach) <= 0;
    mpq_clears(reach, more, NULL);
    return meet;
}

bool high_meet(const high_set *a, const high_set *b) {
    if (a->radius == 0 && b->radius == 0) return high_hulls_meet(a, b);
    mpq_t square;
    mpq_init(square);
    high_distance2(a, b, square);
    const bool meet = high_reach(a, b, square);
    mpq_clear(square);
    return meet;
}

/* Sign of the square root minus the middle of x and y. */
static int beside_middle(mpq_t square, double x, double y) {
    mpq_t p, q;
    mpq_inits(p, q, NULL);
    mpq_set_d(p, x), mpq_set_d(q, y);
    mpq_add(p, p, q);
    mpq_div_2exp(p, p, 1);
    mpq_mul(q, p, p);
    const int sign = mpq_sgn(p) < 0 ? 1 : mpq_cmp(square, q);
    mpq_clears(p, q, NULL);
    return sign;
}

bool high_is_root(double x, mpq_t square) {
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    if (!isfinite(x)) return false;
    const int below = beside_middle(square, nextafter(x, -INFINITY), x), odd = bits & 1;
    if (x == 0 ? mpq_sgn(square) && beside_middle(square, 0, 0x1p-1074) > 0 : below < odd) return false;
    if (nextafter(x, INFINITY) == INFINITY) return true;
    const int above = beside_middle(square, x, nextafter(x, INFINITY));
    return above < 0 || (above == 0 && !odd);
}
