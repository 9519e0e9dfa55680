/* polytope.c: all lines where two planes meet, and what the other halfspaces leave of each. */
#include "geom/polytope.h"
#include "base/sort.h"
#include "geom/formulas.h"
#include "geom/predicates.h"
#include <string.h>

/* ------------------------------------------------------------------ planes -- */

/* There is room. */
static void add_plane(geom_polytope *p, geom_plane plane, int sense) {
    p->planes.data[p->planes.count++] = plane;
    p->senses.data[p->senses.count++] = (int8_t)sense;
}

/* The box, z = 0 in the plane, then the halfspaces. Halfspaces without a direction hold everything or nothing: then
 * *empty. */
static bool lay_planes(const froe_allocator *alloc, int dim, const double *normals, const double *offsets, size_t count,
                       const double *lo, const double *hi, geom_polytope *p, bool *empty) {
    const size_t most = 2 * (size_t)dim + count + 1;
    if (!array_reserve(alloc, &p->planes, most) || !array_reserve(alloc, &p->senses, most)) return false;
    for (int k = 0; k < dim; k++) {
        add_plane(p, geom_plane_axis(3, k, lo[k]), -1);
        add_plane(p, geom_plane_axis(3, k, hi[k]), 1);
    }
    for (size_t i = 0; i < count; i++) {
        double n[3] = {0};
        memcpy(n, normals + i * (size_t)dim, (size_t)dim * sizeof *n);
        if (n[0] == 0 && n[1] == 0 && n[2] == 0)
            *empty |= offsets[i] < 0;
        else
            add_plane(p, geom_plane_vector(3, n, offsets[i]), 1);
    }
    add_plane(p, geom_plane_axis(3, 2, 0), 1); /* in space unused */
    return true;
}

/* ------------------------------------------------------------------- lines -- */

static int turn_of_planes(num_context *context, const geom_plane *a, const geom_plane *b, const geom_plane *c) {
    int sign;
    context->stats.calls++;
    return NUM_DECIDE(context, sign, NUM_UNSURE, NUM_UNSURE, turn_of_normals, a, b, c);
}

/* The line where planes a and b meet, and the planes that end what is left of it: after[1] in the direction
 * n_a x n_b, after[0] against it. */
typedef struct polytope_line {
    num_context *context;
    const geom_polytope *polytope;
    uint32_t a, b, after[2];
    bool put_off; /* was a plane parallel to it while it had no end? */
} polytope_line;

/* Is the point where the line meets plane `at` within halfspace `of`? Outside -1, on its border 0, inside 1. */
static int is_within_line(const polytope_line *l, uint32_t of, uint32_t at) {
    const geom_plane *planes = l->polytope->planes.data;
    int side = geom_side_corner(l->context, planes + of, planes + l->a, planes + l->b, planes + at);
    return -side * l->polytope->senses.data[of];
}

/* Takes from the line what a halfspace does not hold; false: nothing is left. */
static bool cut_line(polytope_line *l, uint32_t plane) {
    const geom_plane *planes = l->polytope->planes.data;
    int way =
        turn_of_planes(l->context, planes + plane, planes + l->a, planes + l->b) * l->polytope->senses.data[plane];
    if (!way && l->after[0] == FROE_NONE) return l->put_off = true;
    if (!way) return is_within_line(l, plane, l->after[0]) >= 0;
    uint32_t *end = &l->after[way > 0], other = l->after[way < 0];
    if (*end != FROE_NONE && is_within_line(l, *end, plane) <= 0) return true;
    *end = plane;
    return other == FROE_NONE || is_within_line(l, plane, other) >= 0;
}

static int by_number(const void *a, const void *b) {
    uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

/* There is room. */
static void add_polytope_corner(geom_polytope *p, uint32_t a, uint32_t b, uint32_t c) {
    geom_meeting corner = {{a, b, c}};
    base_sort(corner.planes, 3, sizeof *corner.planes, by_number);
    p->corners.data[p->corners.count++] = corner;
}

static bool add_polytope_line(num_context *context, const froe_allocator *alloc, geom_polytope *p, uint32_t a,
                              uint32_t b, uint32_t count) {
    polytope_line l = {.context = context, .polytope = p, .a = a, .b = b, .after = {FROE_NONE, FROE_NONE}};
    const geom_plane *planes = p->planes.data;
    bool parallel = true;
    for (int k = 0; k < 3 && parallel; k++) {
        geom_plane axis = geom_plane_axis(3, k, 0);
        parallel = !turn_of_planes(context, planes + a, planes + b, &axis);
    }
    if (parallel) return true;
    for (uint32_t i = 0; i < count; i++) /* the box ends every line */
        if (i != a && i != b && !cut_line(&l, i)) return true;
    for (uint32_t i = 0; i < count && l.put_off; i++) {
        if (i == a || i == b || turn_of_planes(context, planes + i, planes + a, planes + b)) continue;
        if (is_within_line(&l, i, l.after[0]) < 0) return true;
    }
    if (!array_reserve(alloc, &p->corners, 2)) return false;
    for (int end = 0; end < 2; end++) add_polytope_corner(p, a, b, l.after[end]);
    return true;
}

/* ----------------------------------------------------------------- corners -- */

static int by_planes(const void *a, const void *b) {
    return memcmp(a, b, sizeof(geom_meeting));
}

static bool add_images(const froe_allocator *alloc, int dim, geom_polytope *p) {
    if (!array_reserve(alloc, &p->images, p->corners.count * (size_t)dim)) return false;
    p->error = 0;
    for (size_t i = 0; i < p->corners.count; i++) {
        const uint32_t *of = p->corners.data[i].planes;
        const geom_plane *planes = p->planes.data;
        double x[3] = {0}; /* where nothing is certain, it may stay so */
        const double error = geom_image_corner(planes + of[0], planes + of[1], planes + of[2], x);
        memcpy(p->images.data + p->images.count, x, (size_t)dim * sizeof *x);
        p->images.count += (size_t)dim;
        if (!(error <= p->error)) p->error = error;
    }
    return true;
}

bool geom_polytope_make(num_context *context, const froe_allocator *alloc, int dim, const double *normals,
                        const double *offsets, size_t count, const double *lo, const double *hi, geom_polytope *out) {
    bool empty = false, ok;
    out->planes.count = out->senses.count = out->corners.count = out->images.count = 0;
    ok = lay_planes(alloc, dim, normals, offsets, count, lo, hi, out, &empty);
    if (!ok || empty) return ok;
    uint32_t most = (uint32_t)out->planes.count - 1;
    for (uint32_t a = 0; a < most && ok; a++) {
        if (dim == 2)
            ok = add_polytope_line(context, alloc, out, a, most, most);
        else
            for (uint32_t b = a + 1; b < most && ok; b++) ok = add_polytope_line(context, alloc, out, a, b, most);
    }
    /* a corner is found on each of its lines */
    size_t kept = 0;
    geom_meeting *corners = out->corners.data;
    base_sort(corners, out->corners.count, sizeof *corners, by_planes);
    for (size_t i = 0; i < out->corners.count; i++)
        if (!i || by_planes(corners + i, corners + kept - 1)) corners[kept++] = corners[i];
    out->corners.count = kept;
    return ok && add_images(alloc, dim, out);
}

void geom_polytope_free(geom_polytope *p, const froe_allocator *alloc) {
    array_free(alloc, &p->planes);
    array_free(alloc, &p->senses);
    array_free(alloc, &p->corners);
    array_free(alloc, &p->images);
}

geom_convex geom_polytope_convex(const geom_polytope *p, int dim) {
    return (geom_convex){.core = GEOM_CORE_PLANES,
                         .dim = dim,
                         .count = (uint32_t)p->corners.count,
                         .coords = p->images.data,
                         .error = p->error,
                         .planes = p->planes.data,
                         .meetings = p->corners.data};
}
