/* segment.c: see segment.h. */
#include "query/segment.h"
#include <math.h>

/* Rounding changes the two products and their difference by less than 2^-50 of the products together, underflow by
 * less than 2^-1070; an overflow makes the bound infinite or NaN, which nothing exceeds. */
int query_turn(num_context *numbers, const double *u, const double *v, const double *x) {
    double a = (v[0] - u[0]) * (x[1] - u[1]), b = (v[1] - u[1]) * (x[0] - u[0]);
    double turn = a - b, bound = 0x1p-50 * (fabs(a) + fabs(b)) + 0x1p-1070;
    if (numbers->first == NUM_FILTER && fabs(turn) > bound) return turn > 0 ? 1 : -1;
    if (u[0] == v[0] && u[1] == v[1]) return 0;
    geom_plane line = geom_plane_points(2, (const double *const[]){u, v});
    return geom_side_vertex(numbers, &line, x);
}

static bool interval_holds(const double *lo, const double *hi, const double *x) {
    return lo[0] <= x[0] && x[0] <= hi[0] && lo[1] <= x[1] && x[1] <= hi[1];
}

/* A diagonal of its bounding box meets a part of that if it does not leave both of the part's other corners on one
 * side. */
bool query_segment_meets_box(num_context *numbers, const double *u, const double *v, const double *lo,
                             const double *hi) {
    double box[2][2]; /* the part of the segment's bounding box within the box */
    for (int k = 0; k < 2; k++) {
        const double low = u[k] < v[k] ? u[k] : v[k], high = u[k] < v[k] ? v[k] : u[k];
        box[0][k] = low > lo[k] ? low : lo[k];
        box[1][k] = high < hi[k] ? high : hi[k];
        if (!(box[0][k] <= box[1][k])) return false;
    }
    if (u[0] == v[0] || u[1] == v[1] || interval_holds(lo, hi, u) || interval_holds(lo, hi, v)) return true;
    bool rising = (u[0] < v[0]) == (u[1] < v[1]);
    const double one[2] = {box[0][0], box[rising][1]}, other[2] = {box[1][0], box[!rising][1]};
    return query_turn(numbers, u, v, one) * query_turn(numbers, u, v, other) <= 0;
}

static bool apart_on_axis(int k, const double *a, const double *b, const double *u, const double *v) {
    const double lo = u[k] < v[k] ? u[k] : v[k], hi = u[k] < v[k] ? v[k] : u[k];
    return (a[k] < lo && b[k] < lo) || (a[k] > hi && b[k] > hi);
}

/* On one line they meet if their boxes do. */
bool query_segments_meet(num_context *numbers, const double *a, const double *b, const double *u, const double *v) {
    if (apart_on_axis(0, a, b, u, v) || apart_on_axis(1, a, b, u, v)) return false;
    return query_turn(numbers, a, b, u) * query_turn(numbers, a, b, v) <= 0 &&
           query_turn(numbers, u, v, a) * query_turn(numbers, u, v, b) <= 0;
}

/* ------------------------------------------------------------------ heights -- */

static bool known_height(double x, double y, const double *point, int direction, query_height *out) {
    *out = (query_height){.known = true, .x = x, .y = y};
    return direction > 0 ? y >= point[1] : y <= point[1];
}

bool query_height_at(num_context *numbers, const double *u, const double *v, const double *point, int direction,
                     query_height *out) {
    double x = point[0];
    if (!(u[0] <= x && x <= v[0])) return false;
    if (u[0] == v[0]) { /* upright */
        const double low = u[1], high = v[1], y = point[1];
        if (direction > 0 ? high < y : low > y) return false;
        *out = (query_height){.known = true, .x = x};
        out->y = direction > 0 ? (low > y ? low : y) : high < y ? high : y;
        return true;
    }
    if (x == u[0] || u[1] == v[1]) return known_height(x, u[1], point, direction, out);
    if (x == v[0]) return known_height(x, v[1], point, direction, out);
    int turn = query_turn(numbers, u, v, point); /* left is above */
    *out = (query_height){.known = turn == 0, .x = x, .y = point[1], .u = u, .v = v};
    return turn * direction <= 0;
}

/* Is the line of a, at its x, above (1), below (-1) or at b? */
static int height_beside(num_context *numbers, const query_height *a, const query_height *b) {
    geom_plane column = geom_plane_axis(2, 0, a->x);
    geom_plane plane =
        b->known ? geom_plane_axis(2, 1, b->y) : geom_plane_points(2, (const double *const[]){b->u, b->v});
    return geom_side_crossing(numbers, &plane, a->u, a->v, &column);
}

int query_height_compare(num_context *numbers, const query_height *a, const query_height *b) {
    if (a->known && b->known) return (a->y > b->y) - (a->y < b->y);
    return a->known ? -height_beside(numbers, b, a) : height_beside(numbers, a, b);
}
