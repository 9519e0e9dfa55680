/* fuzz.h: the classes of nasty coordinates that every exact predicate is tried on.
 *
 *     fuzz_source r = {seed};
 *     fuzz_points(&r, FUZZ_NEAR_FLAT, dim, points, count);
 *
 * "Flat" points lie on one common hyperplane (a line, a plane), "concurrent" ones in pairs
 * (2D) or triples (3D) whose lines and planes all run through one centre. */
#ifndef FROE_TESTS_SUPPORT_FUZZ_H
#define FROE_TESTS_SUPPORT_FUZZ_H
#include "base/random.h"
#include <math.h>
#include <string.h>

typedef enum fuzz_class {
    FUZZ_RANDOM,          /* [-1, 1) */
    FUZZ_FAR,             /* the same, 10^6 away */
    FUZZ_SMALL_LATTICE,   /* 0 .. 3 */
    FUZZ_LATTICE,         /* 0 .. 1000 */
    FUZZ_FLAT,            /* integers on one line or plane */
    FUZZ_NEAR_FLAT,       /* the same times 0.1, rounded */
    FUZZ_CONCURRENT,      /* integers, through one centre */
    FUZZ_NEAR_CONCURRENT, /* the same times 0.1, rounded */
    FUZZ_VERTICAL,        /* few different x */
    FUZZ_DUPLICATES,      /* few different random points */
    FUZZ_SLIVERS,         /* random, then neighbours within some ulps */
    FUZZ_ULPS,            /* 1 + k 2^-52 */
    FUZZ_WIDE,            /* exponents -1000 .. 1000 */
    FUZZ_DENORMAL,        /* k 2^-1074 */
    FUZZ_HUGE,            /* near +-1.8e308, and 0 */
    FUZZ_EXTREMES,        /* +-1.8e308 and +-2^-1074: differences of the greatest span */
    FUZZ_BITS,            /* any finite bit pattern */
    FUZZ_MIXED,           /* any of these, coordinate by coordinate */
    FUZZ_CLASSES
} fuzz_class;

static const char *const fuzz_names[FUZZ_CLASSES] = {
    "random",   "far",        "small lattice", "lattice", "flat", "near flat", "concurrent", "near concurrent",
    "vertical", "duplicates", "slivers",       "ulps",    "wide", "denormal",  "huge",       "extremes",
    "bits",     "mixed"};

typedef struct fuzz_source {
    uint64_t state;
} fuzz_source;

static inline uint64_t fuzz_bits(fuzz_source *r) {
    return base_mix(r->state += 0x9e3779b97f4a7c15u);
}
/** low .. high */
static inline int fuzz_int(fuzz_source *r, int low, int high) {
    return low + (int)base_below(fuzz_bits(r), (uint32_t)(high - low + 1));
}
/** [-1, 1), 53 random bits */
static inline double fuzz_unit(fuzz_source *r) {
    return (double)(int64_t)(fuzz_bits(r) >> 10) * 0x1p-53 - 1;
}
/** Any finite double. */
static inline double fuzz_finite(fuzz_source *r) {
    double x;
    do {
        uint64_t bits = fuzz_bits(r);
        memcpy(&x, &bits, sizeof x);
    } while (!isfinite(x));
    return x;
}

static inline double fuzz_coordinate(fuzz_source *r, fuzz_class kind) {
    if (kind == FUZZ_MIXED) kind = (fuzz_class)fuzz_int(r, 0, FUZZ_MIXED - 1);
    switch (kind) {
    case FUZZ_FAR:
        return 1e6 + fuzz_unit(r);
    case FUZZ_SMALL_LATTICE:
        return fuzz_int(r, 0, 3);
    case FUZZ_LATTICE:
        return fuzz_int(r, 0, 1000);
    case FUZZ_ULPS:
        return 1 + fuzz_int(r, 0, 3) * 0x1p-52;
    case FUZZ_WIDE:
        return ldexp(fuzz_int(r, -4, 4), fuzz_int(r, -1000, 1000));
    case FUZZ_DENORMAL:
        return fuzz_int(r, -3, 3) * 0x1p-1074;
    case FUZZ_HUGE:
        return fuzz_int(r, -2, 2) * 0x1.fffffffffffffp1022;
    case FUZZ_EXTREMES:
        return fuzz_int(r, 0, 1) ? copysign(0x1.fffffffffffffp1023, fuzz_unit(r)) : copysign(0x1p-1074, fuzz_unit(r));
    case FUZZ_BITS:
        return fuzz_finite(r);
    default:
        return fuzz_unit(r);
    }
}

/* base + i d + j e for small integers: points of a lattice plane (2D: i d only, a line). */
static inline void fuzz_flat(fuzz_source *r, int dim, double *points, size_t count, double factor) {
    int base[3], d[3], e[3];
    for (int k = 0; k < 3; k++) base[k] = fuzz_int(r, -30, 30), d[k] = fuzz_int(r, -9, 9), e[k] = fuzz_int(r, -9, 9);
    for (size_t p = 0; p < count; p++) {
        int i = fuzz_int(r, -9, 9), j = dim == 3 ? fuzz_int(r, -9, 9) : 0;
        for (int k = 0; k < dim; k++) points[p * (size_t)dim + (size_t)k] = (base[k] + i * d[k] + j * e[k]) * factor;
    }
}

/* Groups of dim points, whose last is such a combination of the others that the centre lies
 * on their line or plane:  2D  c + i d, c - j d;   3D  c + d, c + e, c - i d - j e. */
static inline void fuzz_concurrent(fuzz_source *r, int dim, double *points, size_t count, double factor) {
    int centre[3], d[3] = {0}, e[3] = {0};
    for (int k = 0; k < 3; k++) centre[k] = fuzz_int(r, -30, 30);
    for (size_t p = 0; p < count; p++) {
        int place = (int)(p % (size_t)dim), i = fuzz_int(r, -3, 3), j = fuzz_int(r, -3, 3);
        for (int k = 0; k < dim; k++) {
            if (place == 0) d[k] = fuzz_int(r, -9, 9);
            if (place == 1 && dim == 3) e[k] = fuzz_int(r, -9, 9);
            int offset = place == 0 ? d[k] : place == 1 && dim == 3 ? e[k] : -i * d[k] - (dim == 3 ? j * e[k] : 0);
            points[p * (size_t)dim + (size_t)k] = (centre[k] + offset) * factor;
        }
    }
}

/* Points copied from, or within a few ulps of, earlier ones. */
static inline void fuzz_repeat(fuzz_source *r, int dim, double *points, size_t count, int ulps) {
    for (size_t p = 1; p < count; p++) {
        size_t from = base_below(fuzz_bits(r), (uint32_t)p);
        if (fuzz_int(r, 0, 2) == 0) continue;
        for (size_t k = 0; k < (size_t)dim; k++)
            points[p * (size_t)dim + k] = points[from * (size_t)dim + k] * (1 + fuzz_int(r, -ulps, ulps) * 0x1p-52);
    }
}

/** Fills count points of dim doubles. */
static inline void fuzz_points(fuzz_source *r, fuzz_class kind, int dim, double *points, size_t count) {
    if (kind == FUZZ_FLAT || kind == FUZZ_NEAR_FLAT) {
        fuzz_flat(r, dim, points, count, kind == FUZZ_FLAT ? 1 : 0.1);
        return;
    }
    if (kind == FUZZ_CONCURRENT || kind == FUZZ_NEAR_CONCURRENT) {
        fuzz_concurrent(r, dim, points, count, kind == FUZZ_CONCURRENT ? 1 : 0.1);
        return;
    }
    for (size_t i = 0; i < count * (size_t)dim; i++) points[i] = fuzz_coordinate(r, kind);
    for (size_t p = 0; p < count && kind == FUZZ_VERTICAL; p++) points[p * (size_t)dim] = fuzz_int(r, 0, 2) * 0.3;
    if (kind == FUZZ_DUPLICATES) fuzz_repeat(r, dim, points, count, 0);
    if (kind == FUZZ_SLIVERS) fuzz_repeat(r, dim, points, count, 2);
    if (kind > FUZZ_SLIVERS && fuzz_int(r, 0, 3) == 0) fuzz_repeat(r, dim, points, count, 0);
}
#endif
