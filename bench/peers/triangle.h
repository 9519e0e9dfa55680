/* triangle.h: triangles in space, in doubles, for libraries that know bounding boxes alone. */
#ifndef FROE_BENCH_PEERS_TRIANGLE_H
#define FROE_BENCH_PEERS_TRIANGLE_H
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct peer_triangle {
    double p[3][3];
} peer_triangle;

static inline void peer_bounds(const peer_triangle *t, double lo[3], double hi[3]) {
    for (int k = 0; k < 3; k++) {
        lo[k] = fmin(t->p[0][k], fmin(t->p[1][k], t->p[2][k]));
        hi[k] = fmax(t->p[0][k], fmax(t->p[1][k], t->p[2][k]));
    }
}

/** By separating axes, in doubles. */
static inline bool peer_meets_box(const peer_triangle *t, const double lo[3], const double hi[3]) {
    double v[3][3], h[3], a[3], b[3], n[3], reach = 0, at = 0;
    for (int k = 0; k < 3; k++) {
        double c = 0.5 * (lo[k] + hi[k]);
        h[k] = 0.5 * (hi[k] - lo[k]);
        for (int i = 0; i < 3; i++) v[i][k] = t->p[i][k] - c;
        if (fmin(v[0][k], fmin(v[1][k], v[2][k])) > h[k] || fmax(v[0][k], fmax(v[1][k], v[2][k])) < -h[k]) return false;
        a[k] = v[1][k] - v[0][k], b[k] = v[2][k] - v[0][k];
    }
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        n[k] = a[i] * b[j] - a[j] * b[i];
        reach += fabs(n[k]) * h[k];
        at += n[k] * v[0][k];
    }
    if (fabs(at) > reach) return false;
    for (int c = 0; c < 3; c++)
        for (int k = 0; k < 3; k++) {
            int i = (k + 1) % 3, j = (k + 2) % 3, d = (c + 1) % 3, e = (c + 2) % 3;
            double x = v[d][i] - v[c][i], y = v[d][j] - v[c][j];
            double p = x * v[c][j] - y * v[c][i], q = x * v[e][j] - y * v[e][i], r = fabs(x) * h[j] + fabs(y) * h[i];
            if (fmin(p, q) > r || fmax(p, q) < -r) return false;
        }
    return true;
}

/** The nearest point of a triangle (Ericson: Real-time collision detection, 2005, 5.1.5), as a squared distance. */
static inline double peer_square(const peer_triangle *t, const double x[3], double nearest[3]) {
    double ab[3], ac[3], ap[3], bp[3], cp[3], v = 0, w = 0;
    for (int k = 0; k < 3; k++) {
        ab[k] = t->p[1][k] - t->p[0][k], ac[k] = t->p[2][k] - t->p[0][k];
        ap[k] = x[k] - t->p[0][k], bp[k] = x[k] - t->p[1][k], cp[k] = x[k] - t->p[2][k];
    }
#define DOT(a, b) ((a)[0] * (b)[0] + (a)[1] * (b)[1] + (a)[2] * (b)[2])
    double d1 = DOT(ab, ap), d2 = DOT(ac, ap), d3 = DOT(ab, bp), d4 = DOT(ac, bp), d5 = DOT(ab, cp), d6 = DOT(ac, cp);
    double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
    if (d1 <= 0 && d2 <= 0)
        v = w = 0;
    else if (d3 >= 0 && d4 <= d3)
        v = 1;
    else if (d6 >= 0 && d5 <= d6)
        w = 1;
    else if (vc <= 0 && d1 >= 0 && d3 <= 0)
        v = d1 / (d1 - d3);
    else if (vb <= 0 && d2 >= 0 && d6 <= 0)
        w = d2 / (d2 - d6);
    else if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
        w = (d4 - d3) / ((d4 - d3) + (d5 - d6)), v = 1 - w;
    else
        v = vb / (va + vb + vc), w = vc / (va + vb + vc);
#undef DOT
    double sum = 0;
    for (int k = 0; k < 3; k++) {
        nearest[k] = t->p[0][k] + v * ab[k] + w * ac[k];
        sum += (x[k] - nearest[k]) * (x[k] - nearest[k]);
    }
    return sum;
}

#ifdef __cplusplus
}
#endif
#endif
