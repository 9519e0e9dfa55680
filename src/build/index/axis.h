/* axis.h: fragments of segments among axis-parallel cuts in the plane.
 *
 *          |  box  |
 *     -----+-------+----     A fragment is what a segment has in a box, between an entry p and an exit q (ends are
 *          |     __q         sorted by x, then y). An end is the object's own or lies in one side of the box, that is
 *          p----'  |         in a cut; then one of its coordinates is exact and the other an image with a bound.
 *     -----+-------+----     Where the bound leaves a decision open, the exact predicate decides.
 *
 * Cuts are in general position (tree/packed/packed.h): none contains a corner of the object or an end made by another
 * cut. A cut that would is detected by a side of 0, and the builder takes another. */
#ifndef FROE_BUILD_INDEX_AXIS_H
#define FROE_BUILD_INDEX_AXIS_H
#include "geom/predicates.h"
#include "tree/packed/packed.h"
#include <math.h>

/** The two ends of an object, side by side because they are read together, often. */
typedef struct axis_ends {
    double p[2], q[2];
} axis_ends;
_Static_assert(sizeof(axis_ends) == 4 * sizeof(double), "as coordinates lie in a scene");

typedef struct axis_work {
    const axis_ends *ends; /**< of all objects, as they lie in the scene */
    num_context context;
} axis_work;

/** The ends of an object by x, then y. Which one is first is unpredictable, so there is no branch. */
static inline axis_ends axis_sorted(const axis_work *work, uint32_t object) {
    const double *e = work->ends[object].p;
    const size_t swap = ((e[2] < e[0]) | ((e[2] == e[0]) & (e[3] < e[1]))) * 2u;
    return (axis_ends){{e[swap], e[swap + 1]}, {e[2 - swap], e[3 - swap]}};
}
static inline packed_fragment axis_whole(const axis_work *work, uint32_t object) {
    const axis_ends e = axis_sorted(work, object);
    return (packed_fragment){{e.p[0], e.p[1]}, {e.q[0], e.q[1]}, object | PACKED_START | PACKED_END, 0};
}
/** Where the line through u and v, which lie on different sides of x[axis] = value, meets that: the other
 * coordinate, between theirs, within *error. The computation has five roundings of relative size at most 2^-52 in any
 * rounding mode, each of a number no larger than the step from u, and one of the result; underflows change it by
 * less than 2^-1073 times what they are multiplied with, which is counted as 2^-960: processors take a hundred cycles
 * for a product that is no normal number. Infinity where an overflow makes it uncertain. */
static inline double axis_crossing(const double *u, const double *v, int axis, double value, double *error) {
    double rise = v[1 - axis] - u[1 - axis], run = v[axis] - u[axis];
    double step = rise * ((value - u[axis]) / run), x = u[1 - axis] + step;
    double low = rise < 0 ? v[1 - axis] : u[1 - axis], high = rise < 0 ? u[1 - axis] : v[1 - axis];
    double e = 0x1p-49 * fabs(step) + 0x1p-51 * fabs(x) + 0x1p-960 + 0x1p-960 * fabs(rise) + 0 * run;
    *error = e < 0x1p1000 ? e : (double)INFINITY; /* NaN, too */
    x = x > low ? x : low;
    return x < high ? x : high;
}

/** Side of an end of a fragment of `box` beside x[axis] = value: -1, 0, 1. Exact. */
int axis_side(axis_work *work, const packed_fragment *f, bool last, const packed_box *box, int axis, double value);
/** The same when the images are sure, 0 otherwise. */
static inline int axis_sure_side(const packed_fragment *f, bool last, int axis, double value) {
    double beyond = (last ? f->q : f->p)[axis] - value, error = packed_error(f->error);
    return beyond > error ? 1 : beyond < -error ? -1 : 0;
}
/** Divides a fragment with ends on different sides of x[axis] = value. */
void axis_divide(const axis_work *work, const packed_fragment *f, int axis, double value, packed_fragment *negative,
                 packed_fragment *positive);
/** Writes the fragment of a segment or point that has a point inside the box. */
void axis_clip(axis_work *work, uint32_t object, const packed_box *box, packed_fragment *out);
/** Side of x[axis] = value on which the crossing of a segment with x[1 - axis] = at lies: -1, 0, 1. Exact. */
int axis_crossing_side(num_context *context, const double *u, const double *v, int axis, double at, double value);
#endif
