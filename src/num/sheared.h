/* sheared.h: dyadic numbers with infinitesimals: a[0] + a[1] eps + a[2] eps^2, where eps > 0 is smaller
 * than any positive number.
 *
 * Cylindrical partitions order points by x + eps y, so that points that differ in y alone are ordered, too (the
 * symbolic shear of Edelsbrunner and Muecke's simulation of simplicity, in this one direction). A predicate about such
 * points is a polynomial in eps, and its sign that of the first coefficient that is not 0. At most two sheared planes
 * meet in a predicate, so degree 2 is enough. Coefficients that are 0 cost nothing. */
#ifndef FROE_NUM_SHEARED_H
#define FROE_NUM_SHEARED_H
#include "num/dyadic.h"

enum { NUM_SHEARED_TERMS = 3 };

typedef struct num_sheared {
    num_dyadic a[NUM_SHEARED_TERMS];
} num_sheared;

static inline num_sheared num_sheared_from(num_arena *arena, double x) {
    return (num_sheared){{num_dyadic_from(arena, x)}};
}

static inline num_sheared num_sheared_add(num_arena *arena, num_sheared x, num_sheared y) {
    for (int i = 0; i < NUM_SHEARED_TERMS; i++) x.a[i] = num_dyadic_add(arena, x.a[i], y.a[i]);
    return x;
}

static inline num_sheared num_sheared_sub(num_arena *arena, num_sheared x, num_sheared y) {
    for (int i = 0; i < NUM_SHEARED_TERMS; i++) x.a[i] = num_dyadic_sub(arena, x.a[i], y.a[i]);
    return x;
}

static inline num_sheared num_sheared_mul(num_arena *arena, num_sheared x, num_sheared y) {
    num_sheared out = {{{0}}};
    for (int i = 0; i < NUM_SHEARED_TERMS; i++)
        for (int j = 0; i + j < NUM_SHEARED_TERMS; j++)
            out.a[i + j] = num_dyadic_add(arena, out.a[i + j], num_dyadic_mul(arena, x.a[i], y.a[j]));
    return out;
}

/** eps x, for x of degree 1 at most. */
static inline num_sheared num_sheared_shear(num_sheared x) {
    return (num_sheared){{{0}, x.a[0], x.a[1]}};
}

/** The index of the first coefficient that is not 0; NUM_SHEARED_TERMS: there is none. */
static inline int num_sheared_order(const num_sheared *x) {
    int order = 0;
    while (order < NUM_SHEARED_TERMS && !x->a[order].sign) order++;
    return order;
}

static inline int num_sheared_sign(num_sheared x) {
    int order = num_sheared_order(&x);
    return order < NUM_SHEARED_TERMS ? x.a[order].sign : 0;
}
#endif
