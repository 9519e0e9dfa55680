/* halfspaces.c: see halfspaces.h. */
#include "oracle/halfspaces.h"
#include <stdlib.h>

enum { ROWS = 13, COLUMNS = HIGH_CORNERS + 2 * ROWS + 1 };

static void value_at(const double *n, double c, const double *x, int dim, mpq_t out) {
    mpq_t a, b;
    mpq_inits(a, b, NULL);
    mpq_set_d(out, -c);
    for (int k = 0; k < dim; k++) {
        mpq_set_d(a, n[k]);
        mpq_set_d(b, x[k]);
        mpq_mul(a, a, b);
        mpq_add(out, out, a);
    }
    mpq_clears(a, b, NULL);
}

/* --------------------------------------------------------------------- hulls -- */

typedef struct table {
    int rows, columns; /* the last column is the right side; the last row counts what is infeasible */
    mpq_t (*at)[COLUMNS];
    int basis[ROWS];
} table;

static void pivot(table *t, int row, int column) {
    mpq_t f, x;
    mpq_inits(f, x, NULL);
    mpq_set(f, t->at[row][column]);
    for (int j = 0; j < t->columns; j++) mpq_div(t->at[row][j], t->at[row][j], f);
    for (int i = 0; i <= t->rows; i++) {
        if (i == row || !mpq_sgn(t->at[i][column])) continue;
        mpq_set(f, t->at[i][column]);
        for (int j = 0; j < t->columns; j++) {
            if (!mpq_sgn(t->at[row][j])) continue;
            mpq_mul(x, f, t->at[row][j]);
            mpq_sub(t->at[i][j], t->at[i][j], x);
        }
    }
    t->basis[row] = column;
    mpq_clears(f, x, NULL);
}

/* Are there numbers >= 0 for the columns that give the right side, which is >= 0? The last `rows` columns before it are
 * unit vectors to begin with. */
static bool solve(table *t) {
    const int free_columns = t->columns - 1 - t->rows;
    mpq_t least, ratio;
    mpq_inits(least, ratio, NULL);
    for (int i = 0; i < t->rows; i++) t->basis[i] = free_columns + i;
    for (int j = 0; j < t->columns; j++)
        for (int i = 0; i < t->rows; i++)
            if (j < free_columns || j == t->columns - 1) mpq_sub(t->at[t->rows][j], t->at[t->rows][j], t->at[i][j]);
    for (;;) {
        int column = 0, row = -1;
        while (column < free_columns && mpq_sgn(t->at[t->rows][column]) >= 0) column++;
        if (column == free_columns) break;
        for (int i = 0; i < t->rows; i++) {
            if (mpq_sgn(t->at[i][column]) <= 0) continue;
            mpq_div(ratio, t->at[i][t->columns - 1], t->at[i][column]);
            const int order = row < 0 ? -1 : mpq_cmp(ratio, least);
            if (order > 0 || (order == 0 && t->basis[i] > t->basis[row])) continue;
            mpq_set(least, ratio);
            row = i;
        }
        pivot(t, row, column);
    }
    const bool feasible = !mpq_sgn(t->at[t->rows][t->columns - 1]);
    mpq_clears(least, ratio, NULL);
    return feasible;
}

/* Weights of corners, what each halfspace lacks: sum of weights 1, sum of weight (n . v - c) and the lack 0. */
static bool hull_meets(const high_set *set, const double *normals, const double *offsets, size_t count) {
    table t = {.rows = (int)count + 1, .columns = (int)(set->count + 2 * count + 2)};
    t.at = malloc((ROWS + 1) * sizeof *t.at);
    for (int i = 0; i <= t.rows; i++)
        for (int j = 0; j < t.columns; j++) mpq_init(t.at[i][j]);
    const size_t lacks = set->count, units = lacks + count, right = units + count + 1;
    for (size_t i = 0; i <= count; i++) {
        for (size_t j = 0; j < set->count; j++)
            if (i < count)
                value_at(normals + i * (size_t)set->dim, offsets[i], set->x[j], set->dim, t.at[i][j]);
            else
                mpq_set_ui(t.at[i][j], 1, 1);
        if (i < count) mpq_set_ui(t.at[i][lacks + i], 1, 1);
        mpq_set_ui(t.at[i][units + i], 1, 1);
    }
    mpq_set_ui(t.at[count][right], 1, 1);
    const bool meets = solve(&t);
    for (int i = 0; i <= t.rows; i++)
        for (int j = 0; j < t.columns; j++) mpq_clear(t.at[i][j]);
    free(t.at);
    return meets;
}

/* --------------------------------------------------------------------- balls -- */

/* Where the chosen planes meet, nearest to x: out. False: their normals depend on each other. */
static bool foot(const double *x, int dim, const double *normals, const double *offsets, const int *chosen, int n,
                 mpq_t *out) {
    mpq_t a[FROE_MAX_DIM][FROE_MAX_DIM + 1], f, y;
    bool there = true;
    mpq_inits(f, y, NULL);
    for (int i = 0; i < n; i++)
        for (int j = 0; j <= n; j++) {
            mpq_init(a[i][j]);
            const double *ni = normals + (size_t)chosen[i] * (size_t)dim;
            if (j < n)
                value_at(ni, 0, normals + (size_t)chosen[j] * (size_t)dim, dim, a[i][j]);
            else
                value_at(ni, offsets[chosen[i]], x, dim, a[i][j]);
        }
    for (int i = 0; i < n && there; i++) {
        int row = i;
        while (row < n && !mpq_sgn(a[row][i])) row++;
        there = row < n;
        for (int j = 0; j <= n && there; j++) mpq_swap(a[i][j], a[row][j]);
        for (int k = 0; k < n && there; k++) {
            if (k == i) continue;
            mpq_div(f, a[k][i], a[i][i]);
            for (int j = 0; j <= n; j++) mpq_mul(y, f, a[i][j]), mpq_sub(a[k][j], a[k][j], y);
        }
    }
    for (int k = 0; k < dim && there; k++) {
        mpq_set_d(out[k], x[k]);
        for (int i = 0; i < n; i++) {
            mpq_div(f, a[i][n], a[i][i]);
            mpq_set_d(y, normals[(size_t)chosen[i] * (size_t)dim + (size_t)k]);
            mpq_mul(y, y, f);
            mpq_sub(out[k], out[k], y);
        }
    }
    for (int i = 0; i < n; i++)
        for (int j = 0; j <= n; j++) mpq_clear(a[i][j]);
    mpq_clears(f, y, NULL);
    return there;
}

static bool in_all(const mpq_t *p, int dim, const double *normals, const double *offsets, size_t count) {
    bool in = true;
    mpq_t sum, x;
    mpq_inits(sum, x, NULL);
    for (size_t i = 0; i < count && in; i++) {
        mpq_set_d(sum, -offsets[i]);
        for (int k = 0; k < dim; k++) {
            mpq_set_d(x, normals[i * (size_t)dim + (size_t)k]);
            mpq_mul(x, x, p[k]);
            mpq_add(sum, sum, x);
        }
        in = mpq_sgn(sum) <= 0;
    }
    mpq_clears(sum, x, NULL);
    return in;
}

static bool ball_meets(const high_set *set, const double *normals, const double *offsets, size_t count) {
    mpq_t p[FROE_MAX_DIM], square, x, most;
    bool meets = false;
    for (int k = 0; k < set->dim; k++) mpq_init(p[k]);
    mpq_inits(square, x, most, NULL);
    mpq_set_d(most, set->radius);
    mpq_mul(most, most, most);
    for (uint32_t choice = 0; choice < 1u << count && !meets; choice++) {
        int chosen[ROWS], n = 0;
        for (int i = 0; i < (int)count; i++)
            if (choice >> i & 1) chosen[n++] = i;
        if (n > set->dim || !foot(set->x[0], set->dim, normals, offsets, chosen, n, p)) continue;
        if (!in_all(p, set->dim, normals, offsets, count)) continue;
        mpq_set_ui(square, 0, 1);
        for (int k = 0; k < set->dim; k++) {
            mpq_set_d(x, set->x[0][k]);
            mpq_sub(x, x, p[k]);
            mpq_mul(x, x, x);
            mpq_add(square, square, x);
        }
        meets = mpq_cmp(square, most) <= 0;
    }
    for (int k = 0; k < set->dim; k++) mpq_clear(p[k]);
    mpq_clears(square, x, most, NULL);
    return meets;
}

bool halfspaces_meet(const high_set *set, const double *normals, const double *offsets, size_t count) {
    return set->radius > 0 ? ball_meets(set, normals, offsets, count) : hull_meets(set, normals, offsets, count);
}
