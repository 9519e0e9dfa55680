/* cubes.h: the cubes of grids of all powers of two, and their order along a Z-curve (Morton 1966), exactly.
 *
 *         level 1           level 0              A cube of level j has edges of 2^j. Of two cubes that have a common
 *      .---------.       .----.----.             interior point, one holds the other (Gargantini: An effective way to
 *      |         |       | 2  | 3  |             represent quadtrees, 1982). It is known by its corner next to the
 *      |         |       |----|----|             origin: the binary digits below 2^j of its points' coordinates are
 *      |         |       | 0  | 1  |             left out. Cubes do not reach across 0, so that on either side of it
 *      '---------'       '----'----'             digits alone decide; -0 is the corner of a cube below 0.
 *
 * The order looks at the highest digit in which two corners differ, along whichever axis it is (Chan: Closest-point
 * problems simplified on the RAM, 2002). All that lies in a cube is a run of that order, beginning at its corner. */
#ifndef FROE_QUERY_RANGE_CUBES_H
#define FROE_QUERY_RANGE_CUBES_H
#include "support/arithmetic.h"
#include <froe/froe.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

enum {
    CUBE_LEAST = -1074, /**< the level of cubes that hold one double */
    CUBE_MOST = 1025,   /**< ... of cubes that are larger than any extent */
    CUBE_SIGN = 2000,   /**< the digit that stands for the sign */
    CUBE_ALIKE = -2000  /**< no digit */
};

static inline uint64_t cube_bits(double x) {
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}
/** The level of the least cubes whose edge is longer than the extent, hi - lo as rounded. An interval of that length
 * meets at most two of them along its axis. */
static inline int cube_level(double extent) {
    int exponent;
    if (extent == 0) return CUBE_LEAST;
    if (!isfinite(extent)) return CUBE_MOST;
    frexp(extent, &exponent);
    return exponent;
}
/** The coordinate of the corner of the cube of x; x is not -0. */
static inline double cube_corner(double x, int level) {
    uint64_t bits = cube_bits(x);
    const int field = (int)(bits >> 52 & 0x7ff), drop = level - ((field ? field : 1) - 1075);
    if (drop <= 0) return x;
    bits &= drop > 52 ? UINT64_C(1) << 63 : ~((UINT64_C(1) << drop) - 1);
    memcpy(&x, &bits, sizeof x);
    return x;
}
/** The power of two of the highest binary digit in which corners differ. */
static inline int cube_digit(double a, double b) {
    const uint64_t p = cube_bits(a), q = cube_bits(b), differ = p ^ q;
    if (!differ) return CUBE_ALIKE;
    if (differ >> 63) return CUBE_SIGN;
    const int field = (int)((p > q ? p : q) >> 52 & 0x7ff); /* of the greater */
    if (differ >> 52) return field - 1023;
    return 63 - __builtin_clzll(differ) + (field ? field : 1) - 1075;
}
/** The highest digit in which corners differ. *axis, unless NULL: its axis; of axes with the same digit the first. */
static inline int cube_highest_digit(int dim, const double *a, const double *b, int *axis) {
    int highest = CUBE_ALIKE, first = 0;
    for (int k = 0; k < dim; k++) {
        const int digit = cube_digit(a[k], b[k]);
        if (digit > highest) highest = digit, first = k;
    }
    if (axis) *axis = first;
    return highest;
}
/** Is the corner of another cube in the cube, whose corner may be any point of it? */
static inline bool cube_holds(int dim, const double *corner, int level, const double *other) {
    return cube_highest_digit(dim, corner, other, NULL) < level;
}
/** < 0, 0, > 0 as cube a comes before, with or after b: by corners along the curve, larger cubes first. */
static inline int cube_compare(int dim, const double *a, int level_a, const double *b, int level_b) {
    int k;
    const int digit = cube_highest_digit(dim, a, b, &k);
    if (digit == CUBE_ALIKE) return (level_a < level_b) - (level_a > level_b);
    if (digit == CUBE_SIGN) return signbit(a[k]) ? -1 : 1;
    return fabs(a[k]) < fabs(b[k]) ? -1 : 1;
}
/** The cubes of a level that bounds shorter than an edge meet: one or two along each axis. */
typedef struct cube_cover {
    int dim;
    uint32_t divided; /**< bit k: are there two along axis k? */
    double ends[2][FROE_MAX_DIM];
} cube_cover;

static inline cube_cover cube_cover_of(int dim, const double *lo, const double *hi, int level) {
    cube_cover c = {.dim = dim};
    for (int k = 0; k < dim; k++) {
        c.ends[0][k] = cube_corner(lo[k] + 0.0, level); /* -0 becomes 0 */
        c.ends[1][k] = cube_corner(hi[k] + 0.0, level);
        c.divided |= (uint32_t)(cube_digit(c.ends[0][k], c.ends[1][k]) != CUBE_ALIKE) << k;
    }
    return c;
}
/** The corner of cube 0 .. 2^dim - 1 of them, bit k for the second along axis k. False: there are not two. */
static inline bool cube_cover_at(const cube_cover *c, uint32_t which, double *corner) {
    for (int k = 0; k < c->dim; k++) corner[k] = c->ends[which >> k & 1][k];
    return !(which & ~c->divided);
}
/** The bounds of the closed cube; where its far side is no double, beyond it. */
static inline void cube_bounds(int dim, const double *corner, int level, double *lo, double *hi) {
    const double edge = level > 1023 ? INFINITY : ldexp(1, level);
    for (int k = 0; k < dim; k++) {
        const double near = fabs(corner[k]), sum = near + edge, far = sum > near ? sum : nextafter(near, INFINITY);
        lo[k] = signbit(corner[k]) ? -far : near;
        hi[k] = signbit(corner[k]) ? -near : far;
    }
}
#endif
