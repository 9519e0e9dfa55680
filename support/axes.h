/* axes.h: directions of space in plain doubles, for pictures, measures and scores, which decide nothing; and the
 * axes of a page that is seen along one of them.
 *
 *        up |
 *           |____ right        back points from the page to the eye: the three are a right-handed frame
 *          /
 *         back                 No sine is in it, so that pictures are the same on every machine. */
#ifndef FROE_SUPPORT_AXES_H
#define FROE_SUPPORT_AXES_H
#include <math.h>
#include <stdbool.h>

static inline double support_dot(const double *a, const double *b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void support_cross(const double *a, const double *b, double *out) {
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        out[k] = a[i] * b[j] - a[j] * b[i];
    }
}

/** The way from a point to another; 2^-30 of it where its length, or turning it, might overflow. */
static inline void support_way(const double *from, const double *to, double out[3]) {
    double most = 0;
    for (int k = 0; k < 3; k++) most = fmax(most, fmax(fabs(from[k]), fabs(to[k])));
    const double share = most > 0x1p1000 ? 0x1p-30 : 1;
    for (int k = 0; k < 3; k++) out[k] = share * to[k] - share * from[k];
}

/** Gives a vector the length 1, first the largest component 1, against overflow. False: it is zero or not finite. */
static inline bool support_normalize(double *v) {
    const double most = fmax(fabs(v[0]), fmax(fabs(v[1]), fabs(v[2])));
    if (!(most > 0) || !isfinite(most)) return false;
    for (int k = 0; k < 3; k++) v[k] /= most;
    const double length = sqrt(support_dot(v, v));
    for (int k = 0; k < 3; k++) v[k] /= length;
    return true;
}

/** Of the largest of some numbers: squares of them divided by 2^that neither overflow nor vanish. */
static inline int support_exponent(const double *v, int count) {
    double most = 0;
    int exponent;
    for (int k = 0; k < count; k++) most = fmax(most, fabs(v[k]));
    frexp(most, &exponent);
    return exponent;
}

/** Multiplies numbers by a power of two, so that the largest is 1/2 .. 1. */
static inline void support_scale(double *v, int count) {
    const int exponent = support_exponent(v, count);
    for (int k = 0; k < count; k++) v[k] = ldexp(v[k], -exponent);
}

/** The length of a vector, whose squares may be no doubles. */
static inline double support_length(const double *v) {
    double share[3] = {v[0], v[1], v[2]};
    support_scale(share, 3);
    return ldexp(sqrt(support_dot(share, share)), support_exponent(v, 3));
}

/** A normal of the triangle p, q, r, which turns counterclockwise as seen from where that leads. Its length is no
 * extreme one, however large or small the triangle is; 0 where that has no area. */
static inline void support_triangle_normal(const double *p, const double *q, const double *r, double out[3]) {
    double sides[6];
    for (int k = 0; k < 3; k++) sides[k] = q[k] - p[k], sides[3 + k] = r[k] - p[k];
    support_scale(sides, 6);
    support_cross(sides, sides + 3, out);
    support_scale(out, 3);
}

/** The axes of the page for an eye in the direction `back`, of length 1, with `up`, of any length, upwards. An up along
 * the line of view is replaced by the first axis that is not along it, which is returned; -1: none had to be. */
static inline int support_page_axes(const double back[3], const double up[3], double right[3], double page_up[3]) {
    double upwards[3] = {up[0], up[1], up[2]};
    int axis = -1;
    while (true) {
        if (support_normalize(upwards)) {
            support_cross(upwards, back, right);
            if (axis == 2 || support_dot(right, right) > 1e-12) break;
        }
        axis++;
        for (int k = 0; k < 3; k++) upwards[k] = k == axis;
    }
    support_normalize(right);
    support_cross(back, right, page_up);
    return axis;
}
#endif
