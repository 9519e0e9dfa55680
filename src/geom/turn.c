/* turn.c: see turn.h. */
#include "geom/turn.h"
#include "geom/formulas.h"
#include "geom/predicates.h"

/* Three roundings of each product and one of their difference (Shewchuk: Adaptive precision floating-point arithmetic,
 * 1997, ccw filter); the constant swallows underflows, and nothing exceeds a bound that has overflowed. */
static int turn_filter(const double *a, const double *b, const double *c) {
    double left = (a[0] - c[0]) * (b[1] - c[1]), right = (a[1] - c[1]) * (b[0] - c[0]);
    return filter_sign((num_ball){left - right, 0x1p-51 * (fabs(left) + fabs(right)) + NUM_BALL_TINY});
}

int geom_turn(num_context *context, const double *a, const double *b, const double *c) {
    if (context->first == NUM_FILTER && num_rounding_trusted()) {
        const int sure = num_filtered_call(context, turn_filter(a, b, c));
        if (sure != NUM_UNSURE) return sure;
    }
    geom_plane line = geom_plane_points(2, (const double *const[]){a, b});
    return geom_side_vertex(context, &line, c);
}

int geom_projected_turn(num_context *context, int axis, const double *a, const double *b, const double *c) {
    int u = (axis + 1) % 3, v = (axis + 2) % 3;
    return geom_turn(context, (const double[]){a[u], a[v]}, (const double[]){b[u], b[v]}, (const double[]){c[u], c[v]});
}

int geom_projection_axis(num_context *context, const double *a, const double *b, const double *c) {
    int first = 0; /* along which the triangle looks largest */
    double most = -1;
    for (int k = 0; k < 3; k++) {
        int u = (k + 1) % 3, v = (k + 2) % 3;
        double area = fabs((b[u] - a[u]) * (c[v] - a[v]) - (b[v] - a[v]) * (c[u] - a[u]));
        if (area > most) most = area, first = k;
    }
    for (int i = 0; i < 3; i++) {
        int axis = (first + i) % 3;
        if (geom_projected_turn(context, axis, a, b, c) != 0) return axis;
    }
    return -1;
}

bool geom_surely_turns(const double *a, const double *b, const double *c) {
    bool sure = false;
    for (int k = 0; k < 3; k++) { /* turn_filter() along each axis */
        const int u = (k + 1) % 3, v = (k + 2) % 3;
        const double left = (a[u] - c[u]) * (b[v] - c[v]), right = (a[v] - c[v]) * (b[u] - c[u]);
        sure |= fabs(left - right) > 0x1p-51 * (fabs(left) + fabs(right)) + NUM_BALL_TINY;
    }
    return sure;
}

int geom_turn_of_vectors(num_context *context, const geom_vector *a, const geom_vector *b, const geom_vector *c) {
    int sign;
    context->stats.calls++;
    return NUM_DECIDE(context, sign, NUM_UNSURE, NUM_UNSURE, turn_of_vectors, a, b, c);
}
