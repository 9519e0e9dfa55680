/* crossing.c: see crossing.h. */
#include "kinetic/sight/crossing.h"

enum { ENDS = 6 };

/* Numbers are products of up to 9 coordinates, of which a product of two has 2 and more. */
size_t crossing_arena(int unit, int top) {
    enum { NUMBERS = 4000, FACTORS = 9, SPARE_BITS = 128 };
    return NUMBERS * (((size_t)FACTORS * (size_t)(top > unit ? top - unit : 1) + SPARE_BITS) / 64 + 3);
}

static int side_of_face(num_arena *arena, const double *const face[3], const double *p) {
    const size_t mark = arena->top;
    const int sign = volume_dyadic(arena, face, p).sign;
    arena->top = mark;
    return sign;
}

/* Does the line of an edge pass through a triangle, which it is not parallel to? */
static bool passes(num_arena *arena, const crossing_end *c) {
    bool left = false, right = false;
    for (int i = 0; i < 3; i++) {
        const double *const wall[3] = {c->edge[0], c->edge[1], c->face[i]};
        const int sign = side_of_face(arena, wall, c->face[(i + 1) % 3]);
        left = left || sign > 0, right = right || sign < 0;
    }
    return !(left && right);
}

/* Adds where edges of a pass b. */
static int add_ends(num_arena *arena, const double *const a[3], const double *const b[3], crossing_end *out) {
    int side[3], count = 0;
    for (int i = 0; i < 3; i++) side[i] = side_of_face(arena, b, a[i]);
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3;
        if (side[i] * side[j] > 0 || side[i] == side[j]) continue;
        const bool up = side[i] < side[j];
        const crossing_end end = {{a[up ? i : j], a[up ? j : i]}, {b[0], b[1], b[2]}};
        if (passes(arena, &end)) out[count++] = end;
    }
    return count;
}

/* The sign of q - p along an axis. */
static int compare_crossings(num_arena *arena, const crossing_end *p, const crossing_end *q, int axis) {
    const size_t mark = arena->top;
    motion_dyadic_curve at[2];
    cross_at_dyadic(arena, p, &at[0]);
    cross_at_dyadic(arena, q, &at[1]);
    const num_dyadic first = axis == 0 ? at[0].x[0] : axis == 1 ? at[0].y[0] : at[0].z[0];
    const num_dyadic last = axis == 0 ? at[1].x[0] : axis == 1 ? at[1].y[0] : at[1].z[0];
    const int sign = num_dyadic_compare(num_dyadic_mul(arena, last, at[0].w), num_dyadic_mul(arena, first, at[1].w));
    arena->top = mark;
    return sign;
}

bool crossing_find(num_arena *arena, const double *const a[3], const double *const b[3], crossing_end out[2]) {
    crossing_end ends[ENDS];
    arena->top = 0;
    int count = add_ends(arena, a, b, ends);
    count += add_ends(arena, b, a, ends + count);
    for (int axis = 0; axis < 3; axis++) { /* all are in one line, which some axis is not upright to */
        int low = 0, high = 0;
        for (int i = 1; i < count; i++) {
            if (compare_crossings(arena, ends + i, ends + low, axis) > 0) low = i;
            if (compare_crossings(arena, ends + high, ends + i, axis) > 0) high = i;
        }
        if (low == high) continue;
        out[0] = ends[low], out[1] = ends[high];
        return true;
    }
    return false;
}
