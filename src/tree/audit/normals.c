/* normals.c: see normals.h. */
#include "tree/audit/normals.h"
#include "geom/predicates.h"

static const double origin[3] = {0, 0, 0}, axes[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

void normals_free(normals *m) {
    array_free(&m->alloc, &m->points);
    array_free(&m->alloc, &m->vectors);
    array_free(&m->alloc, &m->rays);
    array_free(&m->alloc, &m->padded);
}

/* The sign of (one x other) . d. */
static int sign_along(normals *m, const normals_ray *ray, const geom_vector *d) {
    return geom_turn_of_vectors(m->context, m->vectors.data + ray->one, m->vectors.data + ray->other, d);
}

/* -------------------------------------------------------------------- rays -- */

/* Adds one x other, for which there is room, unless some difference speaks against it, or it is 0. */
static void add_ray(normals *m, uint32_t one, uint32_t other) {
    normals_ray ray = {.one = one, .other = other};
    for (uint32_t i = 3; i < m->vectors.count; i++)
        if (i != one && i != other && sign_along(m, &ray, m->vectors.data + i) < 0) return;
    int k = 0;
    while (k < 3 && !sign_along(m, &ray, &(geom_vector){origin, axes[k]})) k++;
    if (k == 3) return;
    const geom_vector *a = m->vectors.data + one, *b = m->vectors.data + other;
    double most = 0, *x = ray.image;
    for (k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        x[k] = (a->to[i] - a->from[i]) * (b->to[j] - b->from[j]) - (a->to[j] - a->from[j]) * (b->to[i] - b->from[i]);
        most = fabs(x[k]) > most ? fabs(x[k]) : most;
    }
    bool fit = most > 0x1p-900 && most < 0x1p900;
    for (k = 0; k < 3; k++) x[k] = fit ? x[k] / most : 0;
    m->rays.data[m->rays.count++] = ray;
}

/* One x other and other x one. */
static void add_rays(normals *m, uint32_t one, uint32_t other) {
    add_ray(m, one, other);
    add_ray(m, other, one);
}

/* Cuts off what has a negative product with d. Any extreme ray of what is left is an old one, or lies across d and
 * another vector (an axis, where all differences lie in a plane). False: no memory. */
static bool cut_off(normals *m, geom_vector d) {
    uint32_t kept = 0, last = (uint32_t)m->vectors.count;
    for (uint32_t i = 0; i < m->rays.count; i++)
        if (sign_along(m, m->rays.data + i, &d) >= 0) m->rays.data[kept++] = m->rays.data[i];
    m->rays.count = kept;
    if (!array_push(&m->alloc, &m->vectors, d) || !array_reserve(&m->alloc, &m->rays, 2 * last)) return false;
    for (uint32_t i = m->dim == 2 ? 2 : 0; i < (m->dim == 2 ? 3 : last); i++) add_rays(m, i, last);
    return true;
}

/* ------------------------------------------------------------- asking normals -- */

/* A difference that some ray of the cone speaks against; false: the first ray is right, and no difference does.
 * The points tried first are the last of A and the first of B along a normal somewhere in the middle of the cone.
 * They are found in doubles, and so may be any pair. Where they cut nothing off, the points are those of the first ray,
 * exactly. */
static bool find_worst(normals *m, geom_vector *worst) {
    const double *const *x = m->points.data;
    const normals_ray *rays = m->rays.data;
    double n[3] = {0, 0, 0}, best[2] = {0, 0};
    uint32_t at[2] = {0, m->first};
    for (uint32_t i = 0; i < m->rays.count; i++)
        for (int k = 0; k < 3; k++) n[k] += rays[i].image[k];
    for (uint32_t i = 0; i < m->points.count; i++) {
        bool b = i >= m->first;
        double along = (n[0] * x[i][0] + n[1] * x[i][1] + n[2] * x[i][2]) * (b ? -1 : 1);
        if (i != at[b] && !(along > best[b])) continue;
        best[b] = along;
        at[b] = i;
    }
    *worst = (geom_vector){x[at[0]], x[at[1]]};
    for (uint32_t i = 0; i < m->rays.count; i++)
        if (sign_along(m, rays + i, worst) < 0) return true;
    *worst = (geom_vector){x[0], x[m->first]};
    for (uint32_t i = 1; i < m->points.count; i++) {
        if (i < m->first && sign_along(m, rays, &(geom_vector){worst->from, x[i]}) > 0) worst->from = x[i];
        if (i > m->first && sign_along(m, rays, &(geom_vector){worst->to, x[i]}) < 0) worst->to = x[i];
    }
    return sign_along(m, rays, worst) < 0;
}

/* ------------------------------------------------------------------- whole -- */

/* Do the points lie in one plane (2D: on one line)? */
static bool flat(normals *m) {
    const double *const *x = m->points.data, *corner[3] = {x[0], x[0], x[0]};
    geom_plane plane = geom_plane_points(m->dim, corner);
    int found = 1;
    for (uint32_t i = 1; i < m->points.count; i++) {
        if (found == m->dim && geom_side_vertex(m->context, &plane, x[i])) return false;
        if (found == m->dim || (x[i][0] == x[0][0] && x[i][1] == x[0][1] && (m->dim == 2 || x[i][2] == x[0][2])))
            continue;
        corner[found] = x[i];
        plane = geom_plane_points(m->dim, corner);
        if (++found == m->dim && !geom_plane_valid(m->context, &plane)) found--;
    }
    return true;
}

froe_status normals_apart(normals *m, bool *apart) {
    size_t n = m->points.count;
    *apart = false;
    m->padded.count = m->vectors.count = m->rays.count = 0;
    if (m->dim == 2 && !array_reserve(&m->alloc, &m->padded, 3 * n)) return FROE_E_MEMORY;
    for (size_t i = 0; m->dim == 2 && i < n; i++) { /* points of the plane get a third coordinate */
        double *x = m->padded.data + 3 * i;
        x[0] = m->points.data[i][0];
        x[1] = m->points.data[i][1];
        x[2] = 0;
        m->points.data[i] = x;
    }
    if (flat(m)) return FROE_OK;
    /* the cone of all normals: the axes, in both directions */
    if (!array_reserve(&m->alloc, &m->vectors, 3) || !array_reserve(&m->alloc, &m->rays, 6)) return FROE_E_MEMORY;
    for (int k = 0; k < 3; k++) m->vectors.data[m->vectors.count++] = (geom_vector){origin, axes[k]};
    for (uint32_t i = 0; i < (uint32_t)m->dim; i++) add_rays(m, i, m->dim == 2 ? 2 : (i + 1) % 3);
    while (m->rays.count && !*apart) {
        geom_vector worst;
        if (!find_worst(m, &worst))
            *apart = true;
        else if (!cut_off(m, worst))
            return FROE_E_MEMORY;
    }
    return FROE_OK;
}
