/* orient.h: on which side of a line does a point of the plane lie? */
#ifndef FROE_FORMATS_ORIENT_H
#define FROE_FORMATS_ORIENT_H

#include "support/arithmetic.h"
#include <math.h>

#define FORMATS_ORIENT_BOUND 4e-16 /**< Shewchuk's bound on the error of the ccw filter, rounded up */

/* Adds x to an expansion of *n nonoverlapping doubles (Shewchuk 1997, GROW-EXPANSION). */
static inline void formats_grow(double *e, int *n, double x) {
    double q = x;
    for (int i = 0; i < *n; ++i) {
        double sum = q + e[i], tail = sum - q, error = (q - (sum - tail)) + (e[i] - tail);
        e[i] = error;
        q = sum;
    }
    e[(*n)++] = q;
}

static inline void formats_grow_product(double *e, int *n, double x, double y) {
    double product = x * y;
    formats_grow(e, n, fma(x, y, -product));
    formats_grow(e, n, product);
}

/** The side of c seen along the line from a to b: 1 left, -1 right, 0 on it. Exact unless a product
 * overflows or underflows. */
static inline int formats_orient(const double *a, const double *b, const double *c) {
    double left = (b[0] - a[0]) * (c[1] - a[1]), right = (b[1] - a[1]) * (c[0] - a[0]);
    double det = left - right, bound = FORMATS_ORIENT_BOUND * (fabs(left) + fabs(right));
    if (det > bound) return 1;
    if (-det > bound) return -1;
    double e[12];
    int n = 0;
    formats_grow_product(e, &n, a[0], b[1]);
    formats_grow_product(e, &n, -a[1], b[0]);
    formats_grow_product(e, &n, b[0], c[1]);
    formats_grow_product(e, &n, -b[1], c[0]);
    formats_grow_product(e, &n, c[0], a[1]);
    formats_grow_product(e, &n, -c[1], a[0]);
    for (int i = n - 1; i >= 0; --i)
        if (e[i] != 0) return e[i] > 0 ? 1 : -1;
    return 0;
}

#endif
