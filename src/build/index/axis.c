/* axis.c: sides, halves and clippings of fragments. */
#include "build/index/axis.h"

int axis_crossing_side(num_context *context, const double *u, const double *v, int axis, double at, double value) {
    geom_plane plane = geom_plane_axis(2, axis, value), made = geom_plane_axis(2, 1 - axis, at);
    return geom_side_crossing(context, &plane, u, v, &made);
}

/* -------------------------------------------------------------------- ends -- */

/* On which axis is the cut that made this end? The end lies in a side of the box. Where its image does so on both axes,
 * the crossing with the one on axis 0 tells: it is beyond the corner, or it is the end. No cut on axis 0 makes an end
 * of an upright segment, but all of that may lie in the border of the root box, which far from the origin is no wider
 * than the scene. */
static int cut_axis(axis_work *work, const packed_fragment *f, bool last, const packed_box *box) {
    const double *x = last ? f->q : f->p;
    bool vertical = x[0] == (last ? box->hi : box->lo)[0], top = x[1] == box->hi[1];
    if (!vertical) return 1;
    if (!top && x[1] != box->lo[1]) return 0;
    const axis_ends ends = axis_sorted(work, f->id & PACKED_OBJECT);
    if (ends.p[0] == ends.q[0]) return 1;
    int beyond = axis_crossing_side(&work->context, ends.p, ends.q, 1, x[0], x[1]);
    return beyond == (top ? 1 : -1) ? 1 : 0;
}

int axis_side(axis_work *work, const packed_fragment *f, bool last, const packed_box *box, int axis, double value) {
    int side = work->context.first == NUM_FILTER ? axis_sure_side(f, last, axis, value) : 0;
    if (side) return side;
    const double *x = last ? f->q : f->p;
    bool own = f->id & (last ? PACKED_END : PACKED_START);
    int made = own ? axis : cut_axis(work, f, last, box);
    if (made == axis) return (x[axis] > value) - (x[axis] < value);
    const axis_ends ends = axis_sorted(work, f->id & PACKED_OBJECT);
    return axis_crossing_side(&work->context, ends.p, ends.q, axis, x[made], value);
}

/* --------------------------------------------------------------- dividing -- */

void axis_divide(const axis_work *work, const packed_fragment *f, int axis, double value, packed_fragment *negative,
                 packed_fragment *positive) {
    const axis_ends ends = axis_sorted(work, f->id & PACKED_OBJECT);
    double error, x = axis_crossing(ends.p, ends.q, axis, value, &error);
    bool rising = axis == 0 || ends.p[1] < ends.q[1];
    packed_fragment first = *f, second = *f;
    first.q[axis] = second.p[axis] = value;
    first.q[1 - axis] = second.p[1 - axis] = x;
    first.id &= ~PACKED_END;
    second.id &= ~PACKED_START;
    first.error = second.error = packed_half(error) > f->error ? packed_half(error) : f->error;
    *negative = rising ? first : second;
    *positive = rising ? second : first;
}

/* --------------------------------------------------------------- clipping -- */

/* Where the segment uv leaves the box towards its end u, which is beyond a vertical side and beyond a horizontal one:
 * at the vertical one, if it is inside there. */
static double clip_corner(axis_work *work, const double *u, const double *v, double side, double level, bool over,
                          double x[2]) {
    double error;
    x[0] = side;
    x[1] = axis_crossing(u, v, 0, side, &error);
    const double gap = over ? level - x[1] : x[1] - level; /* how far inside */
    const bool sure = work->context.first == NUM_FILTER && (gap > error || gap < -error);
    const int inside = over ? -1 : 1;
    if (sure ? gap > 0 : axis_crossing_side(&work->context, u, v, 1, side, level) == inside) return error;
    x[1] = level;
    x[0] = axis_crossing(u, v, 1, level, &error);
    return error;
}

/* An end of the fragment, and its error: the end u of the segment uv, or where that leaves the box. Which of these it
 * is, and by which side, is unpredictable: so all is computed, and taken without a branch where there is one side. */
static inline uint32_t clip_end(axis_work *work, const double *u, const double *v, bool last, const packed_box *box,
                                double x[2], bool *own) {
    const double side = last ? box->hi[0] : box->lo[0];
    const bool beside = last ? u[0] > side : u[0]<side, over = u[1]> box->hi[1], beyond = over | (u[1] < box->lo[1]);
    const double level = over ? box->hi[1] : box->lo[1];
    const int axis = !beside;
    const double value[2] = {side, level};
    double error, made[2];
    made[axis] = value[axis];
    made[1 - axis] = axis_crossing(u, v, axis, value[axis], &error);
    if (beside & beyond) error = clip_corner(work, u, v, side, level, over, made);
    *own = !(beside | beyond);
    const double *from = *own ? u : made;
    for (int k = 0; k < 2; k++) {
        const double y = from[k] > box->lo[k] ? from[k] : box->lo[k];
        x[k] = y < box->hi[k] ? y : box->hi[k];
    }
    return *own ? 0 : packed_half(error);
}

void axis_clip(axis_work *work, uint32_t object, const packed_box *box, packed_fragment *out) {
    const axis_ends ends = axis_sorted(work, object);
    bool start, end;
    const uint32_t first = clip_end(work, ends.p, ends.q, false, box, out->p, &start);
    const uint32_t last = clip_end(work, ends.q, ends.p, true, box, out->q, &end);
    out->id = object | (start ? PACKED_START : 0) | (end ? PACKED_END : 0);
    out->error = first > last ? first : last;
}
