/* solve.c: see solve.h. */
#include "num/solve.h"
#include <math.h>

#define FLAT 0x1p-40 /* a pivot below this share of the greatest number counts as 0 */

/* (p a - b c) / last, which leaves no remainder. */
static num_dyadic next_minor(num_arena *arena, num_dyadic p, num_dyadic a, num_dyadic b, num_dyadic c,
                             const num_dyadic *last) {
    const size_t mark = arena->top;
    num_dyadic x = num_dyadic_sub(arena, num_dyadic_mul(arena, p, a), num_dyadic_mul(arena, b, c));
    if (last) x = num_dyadic_divide(arena, x, *last);
    return num_dyadic_keep(arena, mark, x);
}

/* A row that has a number in the column, from `rank` on; or one that there is not. Short numbers are better. */
static int pivot_row(const num_table *t, int column) {
    int best = t->rows;
    for (int i = t->rank; i < t->rows; i++) {
        const num_dyadic x = t->at[i][column];
        if (x.sign && (best == t->rows || x.count < t->at[best][column].count)) best = i;
    }
    return best;
}

/* Moves the table down to the mark, over the one before. All numbers lie in the order in which they were made. */
static void compact(num_arena *arena, size_t mark, num_table *t) {
    const size_t top = arena->top;
    size_t at = mark;
    for (int i = 0; i < t->rows; i++)
        for (int j = 0; j < t->columns; j++) {
            t->at[i][j] = num_dyadic_keep(arena, at, t->at[i][j]);
            at = arena->top;
            arena->top = top;
        }
    arena->top = at;
}

void num_table_solve(num_arena *arena, size_t mark, num_table *t, int unknowns) {
    num_dyadic next[NUM_TABLE_ROWS][NUM_TABLE_COLUMNS];
    t->rank = 0;
    t->scale = num_dyadic_scaled(arena, 1, 1, 0);
    for (int column = 0; column < unknowns && t->rank < t->rows; column++) {
        const int row = pivot_row(t, column), r = t->rank;
        if (row == t->rows) continue;
        for (int j = 0; j < t->columns; j++) {
            const num_dyadic x = t->at[row][j];
            t->at[row][j] = t->at[r][j];
            t->at[r][j] = x;
        }
        const num_dyadic p = t->at[r][column], *last = r ? &t->scale : NULL;
        for (int i = 0; i < t->rows; i++)
            for (int j = 0; j < t->columns; j++) {
                /* copied, so that the new table has all of its numbers, one after the other */
                const num_dyadic zero = {0}, of_row = i == r ? zero : t->at[i][column];
                next[i][j] = i == r ? num_dyadic_mul(arena, t->at[i][j], num_dyadic_scaled(arena, 1, 1, 0))
                                    : next_minor(arena, p, t->at[i][j], of_row, t->at[r][j], last);
            }
        for (int i = 0; i < t->rows; i++)
            for (int j = 0; j < t->columns; j++) t->at[i][j] = next[i][j];
        compact(arena, mark, t);
        t->pivot[t->rank++] = column;
        t->scale = t->at[r][column];
    }
}

static void swap_rows(double *a, double *b, int columns) {
    for (int k = 0; k < columns; k++) {
        const double x = a[k];
        a[k] = b[k];
        b[k] = x;
    }
}

bool num_plain_solve(int rows, int columns, double a[][NUM_TABLE_COLUMNS]) {
    double most = 0;
    for (int i = 0; i < rows; i++)
        for (int j = 0; j < rows; j++) most = fmax(most, fabs(a[i][j]));
    for (int i = 0; i < rows; i++) {
        int pivot = i;
        for (int j = i + 1; j < rows; j++)
            if (fabs(a[j][i]) > fabs(a[pivot][i])) pivot = j;
        if (!(fabs(a[pivot][i]) > FLAT * most)) return false;
        swap_rows(a[i], a[pivot], columns);
        for (int j = 0; j < rows; j++) {
            const double factor = j == i ? 0 : a[j][i] / a[i][i];
            for (int k = i; k < columns && factor != 0; k++) a[j][k] -= factor * a[i][k];
        }
    }
    for (int i = 0; i < rows; i++)
        for (int k = rows; k < columns; k++) a[i][k] /= a[i][i];
    return true;
}
