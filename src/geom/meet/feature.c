/* feature.c: Voronoi regions of a triangle, by signs.
 *
 *          \     / p2            e_i from p_i to p_i+1, v_i from the point x to p_i
 *           \   /\               corner i    e_i . v_i > 0   and   e_i-1 . v_i < 0
 *            \ /  \              edge i      e_i . v_i < 0 < e_i . v_i+1   and   n . (v_i x v_i+1) < 0
 *         ----+----+----         interior    n . (v_i x v_i+1) > 0 for all edges
 *          p0 |    | p1
 *
 * Where one of these is certain, x is strictly in that region. In between nothing is. */
#include "geom/meet/feature.h"
#include "geom/filter.h"

static int next(int i) {
    return i == 2 ? 0 : i + 1;
}

static double plain_dot(const filter_vector *a, const filter_vector *b) {
    return a->x[0] * b->x[0] + a->x[1] * b->x[1] + a->x[2] * b->x[2];
}

static int sign_beyond(double x, double bound) {
    return x > bound ? 1 : x < -bound ? -1 : NUM_UNSURE;
}

static double most_of(const filter_vector v[3]) {
    return filter_greater(filter_greater(v[0].most, v[1].most), v[2].most);
}

/* One bound for all e . v: that of filter_dot() for the longest vectors, whose components err by 2u of these. It is
 * not finite where anything overflows. */
bool geom_feature_nearest(const double *point, const double *const corner[3], geom_feature *out) {
    filter_vector e[3], v[3];
    int ahead[3], past[3]; /* of e_i . v_i and e_i . v_i+1 */
    bool inside = true;
    for (int i = 0; i < 3; i++) {
        e[i] = filter_between(corner[i], corner[next(i)]);
        v[i] = filter_between(point, corner[i]);
    }
    const double bound = 25 * FILTER_U * (most_of(e) * most_of(v)) + NUM_BALL_TINY;
    for (int i = 0; i < 3; i++) {
        ahead[i] = sign_beyond(plain_dot(&e[i], &v[i]), bound);
        past[i] = sign_beyond(plain_dot(&e[i], &v[next(i)]), bound);
    }
    for (int i = 0; i < 3; i++) {
        const int k = next(i);
        if (ahead[k] != 1 || past[i] != -1) continue;
        *out = (geom_feature){1, {corner[k]}, filter_dot(&v[k], &v[k])};
        return true;
    }
    const filter_vector n = filter_cross(&e[0], &e[1]);
    for (int i = 0; i < 3; i++) {
        const filter_vector across = filter_cross(&v[i], &e[i]); /* v_i x v_i+1, too */
        const int side = filter_sign(filter_dot(&n, &across));   /* of edge i on which x is, seen along the normal */
        inside = inside && side == 1;
        if (ahead[i] != -1 || past[i] != 1 || side != -1) continue;
        *out = (geom_feature){2, {corner[i], corner[next(i)]}, {0, 0}};
        out->square = filter_div(filter_dot(&across, &across), filter_dot(&e[i], &e[i]));
        return true;
    }
    if (!inside) return false;
    const num_ball height = filter_dot(&n, &v[0]);
    *out = (geom_feature){3, {corner[0], corner[1], corner[2]}, {0, 0}};
    out->square = filter_div(filter_mul(height, height), filter_dot(&n, &n));
    return true;
}

/* A sum of two products of differences, each of which is rounded once: 4u of the products' sizes. */
static num_ball sum_of_products(double p, double q) {
    return (num_ball){p + q, 5 * FILTER_U * (fabs(p) + fabs(q)) + NUM_BALL_TINY};
}

/* The same for a segment pq of the plane, e from p to q, v and w from the point to p and q: p where e . v > 0, q where
 * e . w < 0, the interior where e . v < 0 < e . w, and the square of the distance from it is (e x v)^2 / e^2. */
bool geom_feature_of_segment(const double *point, const double *const corner[2], geom_feature *out) {
    const double *p = corner[0], *q = corner[1], ex = q[0] - p[0], ey = q[1] - p[1], vx = p[0] - point[0],
                 vy = p[1] - point[1], wx = q[0] - point[0], wy = q[1] - point[1];
    const int ahead = filter_sign(sum_of_products(ex * vx, ey * vy));
    const int past = filter_sign(sum_of_products(ex * wx, ey * wy));
    if (ahead == 1 || past == -1) {
        *out = ahead == 1 ? (geom_feature){1, {p}, sum_of_products(vx * vx, vy * vy)}
                          : (geom_feature){1, {q}, sum_of_products(wx * wx, wy * wy)};
        return true;
    }
    const num_ball across = sum_of_products(ex * vy, -ey * vx);
    if (ahead != -1 || past != 1 || filter_sign(across) == NUM_UNSURE) return false; /* it may be on the segment */
    *out = (geom_feature){2, {p, q}, filter_div(filter_mul(across, across), sum_of_products(ex * ex, ey * ey))};
    return true;
}
