/* segment.c: see segment.h. */
#include "oracle/segment.h"

/* -------------------------------------------------------------------- turns -- */

int oracle_turn(const double *u, const double *v, const double *x) {
    mpq_t t[6];
    for (int i = 0; i < 6; i++) mpq_init(t[i]);
    for (int k = 0; k < 2; k++) {
        mpq_set_d(t[4], u[k]);
        mpq_set_d(t[5], v[k]);
        mpq_sub(t[k], t[5], t[4]);
        mpq_set_d(t[5], x[k]);
        mpq_sub(t[2 + k], t[5], t[4]);
    }
    mpq_mul(t[0], t[0], t[3]);
    mpq_mul(t[1], t[1], t[2]);
    int sign = mpq_cmp(t[0], t[1]);
    for (int i = 0; i < 6; i++) mpq_clear(t[i]);
    return (sign > 0) - (sign < 0);
}

static bool on_segment(const double *u, const double *v, const double *x) {
    for (int k = 0; k < 2; k++)
        if (x[k] < fmin(u[k], v[k]) || x[k] > fmax(u[k], v[k])) return false;
    return oracle_turn(u, v, x) == 0;
}

/* -------------------------------------------------------------------- boxes -- */

/* Apart when a side of the box or the line of the segment has them strictly on two sides (Gottschalk, Lin and Manocha
 * 1996: for convex polygons these are all candidates). Infinite bounds come as near as the segment lets them. */
bool oracle_segment_meets_box(const double *u, const double *v, const double *lo, const double *hi) {
    double corner[2][2];
    int turns = 0;
    for (int k = 0; k < 2; k++) {
        double low = fmin(u[k], v[k]), high = fmax(u[k], v[k]);
        if (high < lo[k] || low > hi[k]) return false;
        corner[0][k] = isinf(lo[k]) ? low : lo[k];
        corner[1][k] = isinf(hi[k]) ? high : hi[k];
    }
    for (int i = 0; i < 4; i++) {
        const double x[2] = {corner[i & 1][0], corner[i >> 1][1]};
        int turn = oracle_turn(u, v, x);
        turns |= turn > 0 ? 2 : turn < 0 ? 1 : 3;
    }
    return turns == 3;
}

/* ------------------------------------------------------------------ heights -- */

static bool vertical_height(const double *u, const double *v, const double *point, int direction, mpq_t height) {
    double low = fmin(u[1], v[1]), high = fmax(u[1], v[1]);
    if (direction > 0 ? high < point[1] : low > point[1]) return false;
    mpq_set_d(height, direction > 0 ? fmax(low, point[1]) : fmin(high, point[1]));
    return true;
}

bool oracle_height(const double *u, const double *v, const double *point, int direction, mpq_t height) {
    if (point[0] < fmin(u[0], v[0]) || point[0] > fmax(u[0], v[0])) return false;
    if (u[0] == v[0]) return vertical_height(u, v, point, direction, height);
    mpq_t t[4];
    for (int i = 0; i < 4; i++) mpq_init(t[i]);
    mpq_set_d(t[0], u[0]), mpq_set_d(t[1], v[0]), mpq_set_d(t[2], point[0]);
    mpq_sub(t[2], t[2], t[0]);
    mpq_sub(t[1], t[1], t[0]);
    mpq_div(t[2], t[2], t[1]); /* the share of the way */
    mpq_set_d(t[0], u[1]), mpq_set_d(t[1], v[1]), mpq_set_d(t[3], point[1]);
    mpq_sub(t[1], t[1], t[0]);
    mpq_mul(t[1], t[1], t[2]);
    mpq_add(height, t[0], t[1]);
    bool met = mpq_cmp(height, t[3]) * direction >= 0;
    for (int i = 0; i < 4; i++) mpq_clear(t[i]);
    return met;
}

/* -------------------------------------------------------------------- pairs -- */

static bool same(const double *a, const double *b) {
    return a[0] == b[0] && a[1] == b[1];
}

/* Is x a point of the segment that is none of its ends? */
static bool within(const double *const s[2], const double *x) {
    return !same(x, s[0]) && !same(x, s[1]) && on_segment(s[0], s[1], x);
}

/* Two segments of one line share more than a point if an inner point of one is an end of the other, or all ends are
 * equal. */
static bool overlap(const double *const a[2], const double *const b[2]) {
    bool equal = (same(a[0], b[0]) && same(a[1], b[1])) || (same(a[0], b[1]) && same(a[1], b[0]));
    return equal || within(a, b[0]) || within(a, b[1]) || within(b, a[0]) || within(b, a[1]);
}

static bool touch(const double *const a[2], const double *const b[2]) {
    return on_segment(a[0], a[1], b[0]) || on_segment(a[0], a[1], b[1]) || on_segment(b[0], b[1], a[0]) ||
           on_segment(b[0], b[1], a[1]);
}

/* A point in a segment is met as a whole: its relative interior is itself. */
static int point_meets(const double *point, const double *const s[2]) {
    if (!on_segment(s[0], s[1], point)) return 0;
    return same(s[0], s[1]) || within(s, point) ? 3 : 2;
}

int oracle_segments_meet(const double *const a[2], const double *const b[2]) {
    for (int k = 0; k < 2; k++)
        if (fmax(a[0][k], a[1][k]) < fmin(b[0][k], b[1][k]) || fmax(b[0][k], b[1][k]) < fmin(a[0][k], a[1][k]))
            return 0;
    if (same(a[0], a[1])) return point_meets(a[0], b);
    if (same(b[0], b[1])) return point_meets(b[0], a);
    int p = oracle_turn(a[0], a[1], b[0]), q = oracle_turn(a[0], a[1], b[1]);
    if (!p && !q) return overlap(a, b) ? 3 : touch(a, b) ? 2 : 0;
    int r = oracle_turn(b[0], b[1], a[0]), s = oracle_turn(b[0], b[1], a[1]);
    if (p * q < 0 && r * s < 0) return 1;
    return touch(a, b) ? 2 : 0;
}
