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

typedef struct triangle {
    const double *const *corner;
    filter_vector e[3], v[3], n;
} triangle;

static int sign_of_dot(const filter_vector *a, const filter_vector *b) {
    return filter_sign(filter_dot(a, b));
}

static int next(int i) {
    return i == 2 ? 0 : i + 1;
}

/* The sign of n . (v_i x v_i+1): on which side of edge i x is, seen along the normal. */
static int inner(const triangle *t, int i) {
    const filter_vector c = filter_cross(&t->v[i], &t->v[next(i)]);
    return sign_of_dot(&t->n, &c);
}

static bool take_corner(const triangle *t, int i, geom_feature *out) {
    *out = (geom_feature){1, {t->corner[i]}, filter_dot(&t->v[i], &t->v[i])};
    return true;
}

static bool take_edge(const triangle *t, int i, geom_feature *out) {
    const filter_vector c = filter_cross(&t->v[i], &t->e[i]);
    *out = (geom_feature){2, {t->corner[i], t->corner[next(i)]}, {0, 0}};
    out->square = filter_div(filter_dot(&c, &c), filter_dot(&t->e[i], &t->e[i]));
    return true;
}

static bool take_interior(const triangle *t, geom_feature *out) {
    const num_ball height = filter_dot(&t->n, &t->v[0]);
    *out = (geom_feature){3, {t->corner[0], t->corner[1], t->corner[2]}, {0, 0}};
    out->square = filter_div(filter_mul(height, height), filter_dot(&t->n, &t->n));
    return true;
}

bool geom_feature_nearest(const double *point, const double *const corner[3], geom_feature *out) {
    triangle t = {.corner = corner};
    int ahead[3], past[3], side[3]; /* of e_i . v_i, e_i . v_i+1 and the edge */
    for (int i = 0; i < 3; i++)
        t.e[i] = filter_between(corner[i], corner[next(i)]), t.v[i] = filter_between(point, corner[i]);
    for (int i = 0; i < 3; i++) {
        ahead[i] = sign_of_dot(&t.e[i], &t.v[i]);
        past[i] = sign_of_dot(&t.e[i], &t.v[next(i)]);
    }
    for (int i = 0; i < 3; i++)
        if (ahead[next(i)] == 1 && past[i] == -1) return take_corner(&t, next(i), out);
    t.n = filter_cross(&t.e[0], &t.e[1]);
    for (int i = 0; i < 3; i++) {
        side[i] = inner(&t, i);
        if (ahead[i] == -1 && past[i] == 1 && side[i] == -1) return take_edge(&t, i, out);
    }
    return side[0] == 1 && side[1] == 1 && side[2] == 1 && take_interior(&t, out);
}
