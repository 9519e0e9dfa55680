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

static double most_of(const filter_vector v[3]) {
    return filter_greater(filter_greater(v[0].most, v[1].most), v[2].most);
}

static geom_feature at_edge(const double *p, const double *q, const filter_vector *e, const filter_vector *v) {
    const filter_vector across = filter_cross(v, e);
    return (geom_feature){2, {p, q}, filter_div(filter_dot(&across, &across), filter_dot(e, e))};
}

static geom_feature at_interior(const double *const corner[3], const filter_vector e[3], const filter_vector *v) {
    const filter_vector n = filter_cross(&e[0], &e[1]);
    const num_ball height = filter_dot(&n, v);
    return (geom_feature){
        3, {corner[0], corner[1], corner[2]}, filter_div(filter_mul(height, height), filter_dot(&n, &n))};
}

/* One bound B for all a_i = e_i . v_i and b_i = e_i . v_i+1: that of filter_dot() for the longest vectors, whose
 * components err by 2u of these. Let M be the product of their lengths. As e_i + e_i+1 + e_i-1 = 0, Lagrange's identity
 * makes of the side of edge i on which x is, seen along the normal n = e_i x e_i+1,
 *
 *     n . (v_i x e_i) = a_i a_i+1 + b_i (a_i + b_i-1)
 *
 * where |a|, |b| <= 3 M: off by 18 M B + 3 B^2, and by 72 u M^2 for what is rounded here, which is less than 3 M B.
 * Bounds are not finite where anything overflows. */
bool geom_feature_nearest(const double *point, const double *const corner[3], geom_feature *out) {
    filter_vector e[3], v[3];
    double a[3], b[3];
    unsigned inside = 0;
    for (int i = 0; i < 3; i++) {
        e[i] = filter_between(corner[i], corner[next(i)]);
        v[i] = filter_between(point, corner[i]);
    }
    const double size = most_of(e) * most_of(v), bound = 25 * FILTER_U * size + NUM_BALL_TINY;
    const double bound_of_side = 24 * size * bound + NUM_BALL_TINY;
    for (int i = 0; i < 3; i++) a[i] = plain_dot(&e[i], &v[i]), b[i] = plain_dot(&e[i], &v[next(i)]);
    for (int i = 0; i < 3; i++) {
        const int k = next(i);
        if (!(a[k] > bound && b[i] < -bound)) continue;
        *out = (geom_feature){1, {corner[k]}, filter_dot(&v[k], &v[k])};
        return true;
    }
    for (int i = 0; i < 3; i++) {
        const int k = next(i);
        const double side = a[i] * a[k] + b[i] * (a[i] + b[next(k)]);
        inside += side > bound_of_side;
        if (!(a[i] < -bound && b[i] > bound && side < -bound_of_side)) continue;
        *out = at_edge(corner[i], corner[k], &e[i], &v[i]);
        return true;
    }
    if (inside < 3) return false;
    *out = at_interior(corner, e, &v[0]);
    return true;
}

/* The point c of a convex set is the nearest to x if (c - x) . (y - c) >= 0 for all corners y. Of an edge e from p to
 * another corner this is 0. For a third one, y = p + g, it has the sign of (v . g) (e . e) - (e . v) (e . g), with v
 * from x to p. The bounds of these hold however doubles are rounded. */
bool geom_feature_shared(const double *point, const double *const corner[3], const double *const *nearest, int count) {
    const double *other[3];
    const filter_vector v = filter_between(point, nearest[0]);
    int others = 0;
    for (int i = 0; i < 3; i++) {
        other[others] = corner[i];
        others += corner[i] != nearest[0] && corner[i] != nearest[count - 1];
    }
    if (others != 3 - count) return false;
    const filter_vector g = filter_between(nearest[0], other[0]);
    const num_ball along = filter_dot(&v, &g);
    if (count == 2) {
        const filter_vector e = filter_between(nearest[0], nearest[1]);
        const num_ball back = filter_mul(filter_dot(&e, &v), filter_dot(&e, &g));
        return filter_sign(filter_sub(filter_mul(along, filter_dot(&e, &e)), back)) == 1;
    }
    const filter_vector f = filter_between(nearest[0], other[1]);
    return filter_sign(along) == 1 && filter_sign(filter_dot(&v, &f)) == 1;
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
