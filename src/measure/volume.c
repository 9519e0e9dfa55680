/* volume.c: convex hulls, corner by corner: new facets from each replace those that see it, up to their border.
 *
 *        x               Signs are exact, so that corners in the plane of a facet, which are common, lead to no
 *       / \              contradictions: a facet whose plane holds the corner does not see it.
 *      a---b  gone       (Incremental construction; in the plane by wrapping, Jarvis 1973.)
 *     /     \
 */
#include "measure/volume.h"
#include "geom/predicates.h"
#include "support/array.h"
#include <math.h>

typedef struct facet {
    const double *p[3]; /* turn left, seen from outside */
    geom_plane plane;   /* positive outside */
    bool seen;
} facet;

typedef struct hull_edge {
    const double *a, *b;
} hull_edge;

typedef struct hull {
    num_context *context;
    const froe_allocator *alloc;
    const froe_scene *scene;
    uint32_t object;
    ARRAY(facet) facets;
    ARRAY(hull_edge) border;
} hull;

static const double *hull_corner(const hull *h, uint32_t i) {
    return scene_point(h->scene, h->object, i);
}

/* ----------------------------------------------------------------- in the plane -- */

/* The corner after `at`, counterclockwise: no other lies right of the line to it, nor farther on it. */
static const double *next_on_hull(const hull *h, const double *at) {
    const double *best = NULL;
    for (uint32_t i = 0; i < scene_corners(h->scene, h->object); i++) {
        const double *p = hull_corner(h, i);
        if (p == at) continue;
        int side = -1;
        if (best) {
            const double *const line[] = {at, best};
            geom_plane plane = geom_plane_points(2, line);
            side = geom_side_vertex(h->context, &plane, p);
        }
        if (side == 0) { /* in one line: is p beyond? By coordinates, exactly */
            const int k = best[0] == at[0];
            side = (best[k] > at[k] ? p[k] > best[k] : p[k] < best[k]) ? -1 : 1;
        }
        if (side < 0) best = p;
    }
    return best;
}

static double area(const hull *h, double scale) {
    const double *start = hull_corner(h, 0);
    for (uint32_t i = 1; i < scene_corners(h->scene, h->object); i++) {
        const double *p = hull_corner(h, i);
        if (p[0] < start[0] || (p[0] == start[0] && p[1] < start[1])) start = p;
    }
    double sum = 0;
    const double *a = next_on_hull(h, start);
    for (const double *b; a && (b = next_on_hull(h, a)) != start; a = b)
        sum += (a[0] * scale - start[0] * scale) * (b[1] * scale - start[1] * scale) -
               (a[1] * scale - start[1] * scale) * (b[0] * scale - start[0] * scale);
    return fabs(sum) / 2;
}

/* --------------------------------------------------------------------- in space -- */

static bool add_facet(hull *h, const double *a, const double *b, const double *c) {
    const double *const p[] = {a, b, c};
    const facet f = {{a, b, c}, geom_plane_points(3, p), false};
    return array_push(h->alloc, &h->facets, f);
}

/* Does one of the facets that see the corner run along an edge in this direction? */
static bool seen_along(const hull *h, const double *a, const double *b) {
    bool found = false;
    for (size_t i = 0; i < h->facets.count && !found; i++) {
        const facet *f = h->facets.data + i;
        for (int k = 0; k < 3 && f->seen; k++) found |= f->p[k] == a && f->p[(k + 1) % 3] == b;
    }
    return found;
}

static bool add_hull_corner(hull *h, const double *x) {
    for (size_t i = 0; i < h->facets.count; i++)
        h->facets.data[i].seen = geom_side_vertex(h->context, &h->facets.data[i].plane, x) > 0;
    h->border.count = 0; /* the edges between facets that see the corner and facets that do not */
    size_t kept = 0;
    for (size_t i = 0; i < h->facets.count; i++) {
        const facet *f = h->facets.data + i;
        for (int k = 0; k < 3 && f->seen; k++) {
            const hull_edge e = {f->p[k], f->p[(k + 1) % 3]};
            if (!seen_along(h, e.b, e.a) && !array_push(h->alloc, &h->border, e)) return false;
        }
    }
    for (size_t i = 0; i < h->facets.count; i++)
        if (!h->facets.data[i].seen) h->facets.data[kept++] = h->facets.data[i];
    h->facets.count = kept;
    for (size_t i = 0; i < h->border.count; i++)
        if (!add_facet(h, h->border.data[i].a, h->border.data[i].b, x)) return false;
    return true;
}

/* ---------------------------------------------------------------- above space -- */

/* Of a simplex: the product of its heights, each above the span of the edges before, over dim!. */
static double simplex_volume(const hull *h, double scale) {
    const int dim = h->scene->dim;
    double edge[FROE_MAX_DIM][FROE_MAX_DIM], volume = 1;
    for (int i = 0; i < dim; i++) {
        double square = 0;
        for (int k = 0; k < dim; k++)
            edge[i][k] = hull_corner(h, (uint32_t)i + 1)[k] * scale - hull_corner(h, 0)[k] * scale;
        for (int j = 0; j < i; j++) {
            double along = 0, length = 0;
            for (int k = 0; k < dim; k++) along += edge[i][k] * edge[j][k], length += edge[j][k] * edge[j][k];
            for (int k = 0; k < dim && length > 0; k++) edge[i][k] -= along / length * edge[j][k];
        }
        for (int k = 0; k < dim; k++) square += edge[i][k] * edge[i][k];
        volume *= sqrt(square) / (i + 1);
    }
    return volume;
}

froe_status measure_hull_volume(num_context *context, const froe_allocator *alloc, const froe_scene *scene,
                                uint32_t object, double scale, double *out) {
    hull h = {.context = context, .alloc = alloc, .scene = scene, .object = object};
    if (scene->dim > 3) {
        const geom_body body = scene_body(scene, object);
        const bool full = geom_body_rank(context, &body) == scene->dim;
        *out = full ? simplex_volume(&h, scale) : 0;
        return full && body.count > (uint32_t)scene->dim + 1 ? FROE_E_UNSUPPORTED : FROE_OK;
    }
    if (scene->dim == 2) {
        *out = area(&h, scale);
        return FROE_OK;
    }
    /* begins with a tetrahedron of four corners that are not in one plane; none: no facets */
    const uint32_t n = scene_corners(scene, object);
    const double *o = hull_corner(&h, 0), *p[3] = {o, n > 1 ? hull_corner(&h, 1) : NULL, NULL};
    geom_plane plane;
    uint32_t next = 2;
    bool spans = false, ok = true;
    for (; next < n && !spans; next++) {
        p[2] = hull_corner(&h, next);
        plane = geom_plane_points(3, p);
        spans = geom_plane_valid(context, &plane);
    }
    for (; next < n && ok && !h.facets.count; next++) {
        const double *x = hull_corner(&h, next);
        const int side = geom_side_vertex(context, &plane, x);
        if (!side) continue;
        const double *a = p[0], *b = side > 0 ? p[2] : p[1], *c = side > 0 ? p[1] : p[2]; /* x is behind a, b, c */
        ok = add_facet(&h, a, b, c) && add_facet(&h, b, a, x) && add_facet(&h, c, b, x) && add_facet(&h, a, c, x);
    }
    for (uint32_t i = 0; i < n && ok && h.facets.count; i++) ok = add_hull_corner(&h, hull_corner(&h, i));
    double sum = 0, v[3][3]; /* of the tetrahedra between o and the facets, six times */
    for (size_t i = 0; i < h.facets.count && ok; i++) {
        for (int j = 0; j < 3; j++)
            for (int k = 0; k < 3; k++) v[j][k] = h.facets.data[i].p[j][k] * scale - o[k] * scale;
        sum += v[0][0] * (v[1][1] * v[2][2] - v[1][2] * v[2][1]) - v[0][1] * (v[1][0] * v[2][2] - v[1][2] * v[2][0]) +
               v[0][2] * (v[1][0] * v[2][1] - v[1][1] * v[2][0]);
    }
    if (ok) *out = sum / 6;
    array_free(alloc, &h.facets);
    array_free(alloc, &h.border);
    return ok ? FROE_OK : FROE_E_MEMORY;
}
