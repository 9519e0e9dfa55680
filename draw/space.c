/* space.c: from any finite coordinates to -1 .. 1, without overflow or loss. */
#include "space.h"
#include <math.h>

#define FAR 1e100 /* squares and sums of squares of it are still finite */

static double finite(double x) {
    return x > FAR ? FAR : x < -FAR ? -FAR : x == x ? x : 0;
}

/* Turns that keep right-handed scenes right-handed. Up along y is the custom of glTF: x to
 * the right and z towards the viewer. */
static const int turned_from[3][3] = {{1, 2, 0}, {0, 2, 1}, {0, 1, 2}};

int draw_space_axis(const draw_space *space, int scene_axis) {
    int k = 0;
    while (k < 2 && space->from[k] != scene_axis) k++;
    return k;
}

draw_space draw_space_over(int dim, int up, const double *lo, const double *hi) {
    draw_space space = {.dim = dim, .sign = {1, dim == 3 && up == 1 ? -1 : 1, 1}, .squeeze = 1};
    double largest = 0, half[3] = {0};
    for (int k = 0; k < 3; k++) space.from[k] = turned_from[dim == 3 ? up : 2][k];
    for (int k = 0; k < dim; k++) {
        half[k] = 0.5 * hi[space.from[k]] - 0.5 * lo[space.from[k]];
        largest = fmax(largest, half[k]);
    }
    /* A window that is one point: show a unit around it. */
    if (!(largest > 0)) largest = 1;
    frexp(largest, &space.shift);
    space.shift = -space.shift;
    space.half = ldexp(largest, space.shift);
    space.unit = largest;
    for (int k = 0; k < dim; k++) {
        int axis = space.from[k];
        space.mid[k] = space.sign[k] * ldexp(0.5 * lo[axis] + 0.5 * hi[axis], space.shift);
        space.reach[k] = ldexp(half[k], space.shift) / space.half;
    }
    return space;
}

double draw_space_map(const draw_space *space, int k, double x) {
    return finite((space->sign[k] * ldexp(x, space->shift) - space->mid[k]) / space->half);
}

void draw_space_point(const draw_space *space, const double *x, double *out) {
    out[2] = 0;
    for (int k = 0; k < space->dim; k++) out[k] = draw_space_map(space, k, x[space->from[k]]);
}

/* The difference q - p to largest component 1: taken before the middle is
 * subtracted, so that tiny edges far from the middle keep their direction. */
static void direction(const draw_space *space, const double *p, const double *q, double *out) {
    double largest = 0;
    out[2] = 0;
    for (int k = 0; k < space->dim; k++) {
        int axis = space->from[k];
        out[k] = finite(space->sign[k] * (ldexp(q[axis], space->shift) - ldexp(p[axis], space->shift)));
        largest = fmax(largest, fabs(out[k]));
    }
    if (largest > 0)
        for (int k = 0; k < 3; k++) out[k] /= largest;
}

static draw_plane through(const draw_space *space, const double *point, const double *normal) {
    draw_plane plane = {{normal[0], normal[1], normal[2]}, 0};
    double p[3], largest = fmax(fabs(normal[0]), fmax(fabs(normal[1]), fabs(normal[2])));
    for (int k = 0; k < 3 && largest > 0; k++) plane.n[k] /= largest;
    draw_space_point(space, point, p);
    for (int k = 0; k < 3; k++) plane.c += plane.n[k] * p[k];
    return plane;
}

/* The line through p and q, or the plane through them and their translates along the
 * scene's third axis: positive on the left. */
static draw_plane along(const draw_space *space, const double *p, const double *q) {
    double d[3], n[3] = {0};
    direction(space, p, q, d);
    int x = draw_space_axis(space, 0), y = draw_space_axis(space, 1);
    n[x] = -d[y] * space->sign[x] * space->sign[y];
    n[y] = d[x] * space->sign[x] * space->sign[y];
    return through(space, p, n);
}

/* The plane of a convex polygon. The sum over its fan is never cancelled (all
 * terms point the same way) and collinear first corners do no harm. */
static draw_plane spanned(const draw_space *space, const double *const *corners, uint32_t count) {
    double n[3] = {0}, d[3], e[3];
    direction(space, corners[0], corners[1], d);
    for (uint32_t i = 2; i < count; i++) {
        direction(space, corners[0], corners[i], e);
        for (int k = 0; k < 3; k++) {
            int a = (k + 1) % 3, b = (k + 2) % 3;
            n[k] += d[a] * e[b] - d[b] * e[a];
        }
        for (int k = 0; k < 3; k++) d[k] = e[k];
    }
    return through(space, corners[0], n);
}

static draw_plane of_object(const draw_space *space, const froe_scene *scene, uint32_t id) {
    enum { SOME = 16 };
    const double *corners[SOME];
    uint32_t count = froe_scene_object(scene, id).corners, used = count < SOME ? count : SOME;
    if (used < 2) return (draw_plane){{0}, 0};
    /* Of a polygon with many corners, evenly chosen ones do. */
    for (uint32_t i = 0; i < used; i++) {
        uint32_t corner = (uint32_t)((uint64_t)i * count / used);
        corners[i] = froe_scene_vertex(scene, froe_scene_corner(scene, id, corner));
    }
    return used == 2 || space->dim == 2 ? along(space, corners[0], corners[1]) : spanned(space, corners, used);
}

draw_plane draw_space_plane(const draw_space *space, const froe_scene *scene, const froe_cut *cut) {
    draw_plane plane = {{0}, 0};
    const double *p[3] = {NULL, NULL, NULL};
    int axis, count = cut->kind == FROE_CUT_VERTICES ? space->dim : cut->kind == FROE_CUT_EDGE ? 2 : 0;
    for (int i = 0; i < count; i++) p[i] = froe_scene_vertex(scene, cut->id[i]);
    switch (cut->kind) {
    case FROE_CUT_AXIS:
    case FROE_CUT_VERTEX:
    case FROE_CUT_CROSSING: /* walls, x[0] = value as far as can be seen */
        axis = draw_space_axis(space, cut->axis);
        plane.n[axis] = space->sign[axis];
        plane.c = space->sign[axis] * draw_space_map(space, axis, cut->value);
        return plane;
    case FROE_CUT_OBJECT:
        return of_object(space, scene, cut->id[0]);
    case FROE_CUT_VERTICES:
        return space->dim == 3 ? spanned(space, p, 3) : along(space, p[0], p[1]);
    case FROE_CUT_EDGE:
        return along(space, p[0], p[1]);
    case FROE_CUT_PLANE:
    case FROE_CUT_FINE:
        break;
    default:
        return plane;
    }
    /* normal . x = value, with x = (mid + half * p) / 2^shift. */
    double largest = 0;
    for (int k = 0; k < space->dim; k++) largest = fmax(largest, fabs(cut->normal[k]));
    if (!(largest > 0)) return plane;
    int exponent;
    double scale = frexp(largest, &exponent), c = ldexp(cut->value, space->shift - exponent) / scale;
    for (int k = 0; k < space->dim; k++) {
        plane.n[k] = space->sign[k] * ldexp(cut->normal[space->from[k]], -exponent) / scale;
        c -= plane.n[k] * space->mid[k];
    }
    plane.c = finite(c / space->half);
    return plane;
}
