/* cube_cut.c: halves and shrinks. All lengths are halved, so that no difference overflows. */
#include "build/bar/cube_cut.h"
#include <math.h>

static double side_length(const bar_region *box, int k) {
    return 0.5 * box->hi[k] - 0.5 * box->lo[k];
}

/** Where the guards lie on an axis: how far they reach from the nearer end, and which one that is. */
static double reach_of(const bar_region *box, const cube_guards *g, int k, bool *high) {
    const double from_lo = 0.5 * g->hi[k] - 0.5 * box->lo[k], from_hi = 0.5 * box->hi[k] - 0.5 * g->lo[k];
    *high = from_hi < from_lo;
    return *high ? from_hi : from_lo;
}

static bool make_axis_cut(const bar_region *box, int k, double value, froe_cut *out) {
    *out = (froe_cut){.kind = FROE_CUT_AXIS, .axis = k, .value = value};
    return value > box->lo[k] && value < box->hi[k];
}

static bool halve_side(const bar_region *box, int k, froe_cut *out) {
    return make_axis_cut(box, k, 0.5 * box->lo[k] + 0.5 * box->hi[k], out);
}

/** The box is a cube: shrink it to the corner near which all guards are, unless they are in several orthants. */
static bool cut_cube(const bar_region *box, int dim, const cube_guards *g, bool through, froe_cut *out) {
    int far = 0;
    double most = -1;
    bool at_high = false;
    for (int k = 0; k < dim; k++) {
        bool high;
        const double reach = reach_of(box, g, k, &high);
        if (reach >= 0.5 * side_length(box, k)) return halve_side(box, 0, out);
        if (reach > most) most = reach, far = k, at_high = high;
    }
    const double value = at_high ? g->lo[far] : g->hi[far];
    return make_axis_cut(box, far, through ? value : nextafter(value, at_high ? -INFINITY : INFINITY), out);
}

/** The box is longer on axis k than on the shortest: make it as short there, if all guards are at one end of it. */
static bool cut_longer(const bar_region *box, const cube_guards *g, int k, double least, froe_cut *out) {
    bool high;
    const double reach = reach_of(box, g, k, &high);
    if (reach > least || side_length(box, k) < 2 * least) return halve_side(box, k, out);
    double value = high ? box->hi[k] - 2 * least : box->lo[k] + 2 * least; /* rounded: but no guard is cut off */
    if (high ? value > g->lo[k] : value < g->hi[k]) value = high ? g->lo[k] : g->hi[k];
    return make_axis_cut(box, k, value, out);
}

bool cube_cut(const bar_region *box, int dim, const cube_guards *g, bool through, froe_cut *out) {
    double least = INFINITY, most = 0;
    int longest = 0;
    for (int k = 0; k < dim; k++) {
        const double side = side_length(box, k);
        if (side < least) least = side;
        if (side > 1.0000001 * most) most = side, longest = k; /* of about equal ones the first */
    }
    if (!(least > 0) || !isfinite(most)) return false;
    return most < 1.5 * least ? cut_cube(box, dim, g, through, out) : cut_longer(box, g, longest, least, out);
}
