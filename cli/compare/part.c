/* part.c: parts of a scene: the objects nearest the middle, so that a part is as dense as the whole and only smaller.
 * (A random sample would be sparser: another kind of scene.) */
#include "compare/part.h"
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

const double *part_corner(const froe_scene *scene, uint32_t object, uint32_t corner) {
    const uint32_t corners = froe_scene_object(scene, object).corners;
    return froe_scene_vertex(scene, froe_scene_corner(scene, object, corner % corners));
}

typedef struct ranked {
    double key;
    uint32_t id;
} ranked;

static int by_key(const void *a, const void *b) {
    const ranked *x = a, *y = b;
    if (x->key != y->key) return x->key < y->key ? -1 : 1;
    return (x->id > y->id) - (x->id < y->id);
}

/* Half the place of an object along an axis, between its first corners: halves, so that nothing overflows. */
static double place(const froe_scene *scene, uint32_t object, int axis) {
    return 0.25 * part_corner(scene, object, 0)[axis] + 0.25 * part_corner(scene, object, 1)[axis];
}

uint32_t *part_order(const froe_scene *scene) {
    const size_t n = froe_scene_object_count(scene);
    const int dim = froe_scene_dim(scene);
    double middle[FROE_MAX_DIM], lo[FROE_MAX_DIM] = {0}, hi[FROE_MAX_DIM] = {0};
    ranked *work = calloc(n + 1, sizeof *work);
    uint32_t *order = calloc(n + 1, sizeof *order);
    if (!work || !order) {
        free(work);
        free(order);
        return NULL;
    }
    froe_scene_bounds(scene, lo, hi);
    /* The middle is that of the objects, axis by axis: half of them lie below it. */
    for (int k = 0; k < dim; k++) {
        for (uint32_t i = 0; i < n; i++) work[i] = (ranked){place(scene, i, k), i};
        qsort(work, n, sizeof *work, by_key);
        middle[k] = work[n / 2].key;
    }
    for (uint32_t i = 0; i < n; i++) {
        double far = 0;
        for (int k = 0; k < dim; k++) {
            const double extent = 0.5 * hi[k] - 0.5 * lo[k];
            if (extent > 0) far = fmax(far, fabs(place(scene, i, k) - middle[k]) / extent);
        }
        work[i] = (ranked){far, i};
    }
    qsort(work, n, sizeof *work, by_key);
    for (size_t i = 0; i < n; i++) order[i] = work[i].id;
    free(work);
    return order;
}

/* Copies as many corners as the kind has, or more; those of a degenerate object are repeated. */
static froe_status copy_object(const froe_scene *from, uint32_t id, froe_scene *to, double *coords,
                               froe_diagnostic *diag) {
    static const uint32_t least[FROE_KIND_COUNT] = {1, 2, 3, 2, 1, 1};
    const froe_object object = froe_scene_object(from, id);
    const bool any = object.kind == FROE_POLYGON || object.kind == FROE_HULL; /* number of corners, from the least on */
    const uint32_t fixed = least[object.kind], corners = any && object.corners > fixed ? object.corners : fixed;
    const size_t dim = (size_t)froe_scene_dim(from), starts[2] = {0, corners};
    for (uint32_t i = 0; i < corners; i++) {
        const uint32_t there = i < object.corners ? i : object.corners - 1;
        for (size_t k = 0; k < dim; k++) coords[i * dim + k] = part_corner(from, id, there)[k];
    }
    froe_objects o = froe_objects_defaults();
    o.kind = object.kind;
    o.count = 1;
    o.coords = coords;
    o.starts = any ? starts : NULL;
    o.radii = object.kind == FROE_BALL ? &object.radius : NULL;
    return froe_scene_add(to, &o, diag);
}

froe_status part_new(const froe_scene *scene, const uint32_t *order, size_t count, froe_scene **out,
                     froe_diagnostic *diag) {
    const int dim = froe_scene_dim(scene);
    size_t most = 3;
    for (uint32_t i = 0; i < froe_scene_object_count(scene); i++) {
        const size_t corners = froe_scene_object(scene, i).corners;
        if (corners > most) most = corners;
    }
    double *coords = calloc(most * (size_t)dim, sizeof *coords);
    froe_status status = coords ? froe_scene_new(dim, NULL, out) : FROE_E_MEMORY;
    for (size_t i = 0; i < count && !status; i++) {
        status = copy_object(scene, order[i], *out, coords, diag);
        if (status) froe_scene_free(*out);
    }
    free(coords);
    return status;
}
