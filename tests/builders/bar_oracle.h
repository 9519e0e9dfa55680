/* bar_oracle.h: how fat is a cell whose facets have few directions? In exact rationals, from the definition: corners
 * are what dim facets share and all others have on their inner side. */
#ifndef FROE_TESTS_BUILDERS_BAR_ORACLE_H
#define FROE_TESTS_BUILDERS_BAR_ORACLE_H
#include "build/bar/bar_shape.h"
#include "build/bar/directions.h"
#include "split/grow.h"
#include <gmp.h>
#include <math.h>

enum { BAR_PLANES = 2 * DIRECTIONS_MOST };

typedef struct bar_oracle {
    const split_directions *directions;
    mpq_t c[BAR_PLANES]; /* facet 2 i: n . x = lo, 2 i + 1: n . x = hi */
    bool there[BAR_PLANES];
    mpq_t lo[DIRECTIONS_MOST], hi[DIRECTIONS_MOST]; /* least and largest n . x of the cell */
    mpq_t x[3], t;
    bool any;
} bar_oracle;

static inline void bar_oracle_init(bar_oracle *o, const split_directions *d) {
    o->directions = d;
    for (int i = 0; i < BAR_PLANES; i++) mpq_init(o->c[i]);
    for (int i = 0; i < DIRECTIONS_MOST; i++) mpq_inits(o->lo[i], o->hi[i], NULL);
    mpq_inits(o->x[0], o->x[1], o->x[2], o->t, NULL);
}
static inline void bar_oracle_clear(bar_oracle *o) {
    for (int i = 0; i < BAR_PLANES; i++) mpq_clear(o->c[i]);
    for (int i = 0; i < DIRECTIONS_MOST; i++) mpq_clears(o->lo[i], o->hi[i], NULL);
    mpq_clears(o->x[0], o->x[1], o->x[2], o->t, NULL);
}

static inline int bar_oracle_entry(const bar_oracle *o, int facet, int k) {
    return (int)o->directions->normals[facet / 2][k];
}

/* Entry (row, column) of the matrix of facets f, with column `swap` replaced by their values: to `out`. */
static inline void bar_oracle_at(bar_oracle *o, mpq_t out, const int *f, int row, int column, int swap) {
    if (column == swap)
        mpq_set(out, o->c[f[row]]);
    else
        mpq_set_si(out, bar_oracle_entry(o, f[row], column), 1);
}

/* Determinant by its definition: a sum over permutations. */
static inline void bar_oracle_determinant(bar_oracle *o, mpq_t out, const int *f, int swap) {
    static const int order[6][4] = {{0, 1, 2, 1},  {1, 2, 0, 1},  {2, 0, 1, 1},
                                    {0, 2, 1, -1}, {2, 1, 0, -1}, {1, 0, 2, -1}};
    const int dim = o->directions->dim;
    mpq_t product, entry;
    mpq_inits(product, entry, NULL);
    mpq_set_ui(out, 0, 1);
    for (int p = 0; p < 6; p++) {
        if (dim == 2 && order[p][2] != 2) continue;
        mpq_set_si(product, order[p][3], 1);
        for (int row = 0; row < dim; row++) {
            bar_oracle_at(o, entry, f, row, order[p][row], swap);
            mpq_mul(product, product, entry);
        }
        mpq_add(out, out, product);
    }
    mpq_clears(product, entry, NULL);
}

static inline void bar_oracle_key(bar_oracle *o, mpq_t out, int direction) {
    mpq_set_ui(out, 0, 1);
    for (int k = 0; k < o->directions->dim; k++) {
        int n = bar_oracle_entry(o, 2 * direction, k);
        if (n > 0) mpq_add(out, out, o->x[k]);
        if (n < 0) mpq_sub(out, out, o->x[k]);
    }
}

/* Takes the point where facets f meet, if it is one and in the cell. */
static inline void bar_oracle_corner(bar_oracle *o, const int *f) {
    mpq_t bottom;
    mpq_init(bottom);
    bar_oracle_determinant(o, bottom, f, -1);
    bool in = mpq_sgn(bottom) != 0;
    for (int k = 0; k < o->directions->dim && in; k++) {
        bar_oracle_determinant(o, o->x[k], f, k);
        mpq_div(o->x[k], o->x[k], bottom);
    }
    mpq_clear(bottom);
    for (int i = 0; i < o->directions->count && in; i++) {
        bar_oracle_key(o, o->t, i);
        if (o->there[2 * i] && mpq_cmp(o->t, o->c[2 * i]) < 0) in = false;
        if (o->there[2 * i + 1] && mpq_cmp(o->t, o->c[2 * i + 1]) > 0) in = false;
    }
    for (int i = 0; i < o->directions->count && in; i++) {
        bar_oracle_key(o, o->t, i);
        if (!o->any || mpq_cmp(o->t, o->lo[i]) < 0) mpq_set(o->lo[i], o->t);
        if (!o->any || mpq_cmp(o->t, o->hi[i]) > 0) mpq_set(o->hi[i], o->t);
    }
    o->any |= in;
}

/** The square of the region's aspect, exactly; 0 for a region without interior. */
static inline void bar_oracle_aspect(bar_oracle *o, const bar_region *region, mpq_t out) {
    const split_directions *d = o->directions;
    const int facets = 2 * d->count;
    mpq_t least, most;
    mpq_inits(least, most, NULL);
    o->any = false;
    for (int f = 0; f < facets; f++) {
        const double c = f % 2 ? region->hi[f / 2] : region->lo[f / 2];
        o->there[f] = isfinite(c);
        if (o->there[f]) mpq_set_d(o->c[f], c);
    }
    for (int a = 0; a < facets; a++)
        for (int b = a + 1; b < facets; b++)
            for (int c = d->dim == 3 ? b + 1 : facets - 1; c < facets; c++)
                if (o->there[a] && o->there[b] && (d->dim == 2 || o->there[c])) bar_oracle_corner(o, (int[]){a, b, c});
    mpq_set_ui(out, 0, 1);
    for (int i = 0; i < d->count && o->any; i++) {
        mpq_sub(o->t, o->hi[i], o->lo[i]);
        mpq_mul(o->t, o->t, o->t);
        mpq_set_ui(o->x[0], i < d->dim ? 1 : (unsigned long)d->dim, 1);
        mpq_div(o->t, o->t, o->x[0]);
        if (i == 0 || mpq_cmp(o->t, least) < 0) mpq_set(least, o->t);
        if (i == 0 || mpq_cmp(o->t, most) > 0) mpq_set(most, o->t);
    }
    if (o->any && mpq_sgn(least) > 0) mpq_div(out, most, least);
    mpq_clears(least, most, NULL);
}
#endif
