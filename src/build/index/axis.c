/* axis.c: sides, halves and clippings of fragments. */
#include "build/index/axis.h"

int axis_crossing_side(num_context *context, const double *u, const double *v, int axis, double at, double value) {
    geom_plane plane = geom_plane_axis(2, axis, value), made = geom_plane_axis(2, 1 - axis, at);
    return geom_side_crossing(context, &plane, u, v, &made);
}

/* -------------------------------------------------------------------- ends -- */

/* On which axis is the cut that made this end? The end lies in a side of the box. Where its image does so on both axes,
 * the crossing with the one on axis 0 tells: it is beyond the corner, or it is the end. */
static int cut_axis(axis_work *work, const packed_fragment *f, bool last, const packed_box *box) {
    const double *x = last ? f->q : f->p;
    bool vertical = x[0] == (last ? box->hi : box->lo)[0], top = x[1] == box->hi[1];
    if (!vertical) return 1;
    if (!top && x[1] != box->lo[1]) return 0;
    const axis_ends ends = axis_sorted(work, f->id & PACKED_OBJECT);
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

/* Where the segment enters the box (last: leaves it), in *x; its own end u is outside. */
static double clip_end(axis_work *work, const axis_ends *ends, bool last, const packed_box *box, double x[2]) {
    const double *u = last ? ends->q : ends->p, *v = last ? ends->p : ends->q;
    double side = last ? box->hi[0] : box->lo[0], level = u[1] > box->hi[1] ? box->hi[1] : box->lo[1];
    bool beside = last ? u[0] > side : u[0]<side, beyond = u[1]> box->hi[1] || u[1] < box->lo[1];
    double error = 0;
    if (beside) {
        x[0] = side;
        x[1] = axis_crossing(u, v, 0, side, &error);
        double gap = u[1] > level ? level - x[1] : x[1] - level; /* how far inside */
        bool sure = work->context.first == NUM_FILTER && (gap > error || gap < -error);
        if (!beyond) return error;
        int inside = u[1] > level ? -1 : 1;
        if (sure ? gap > 0 : axis_crossing_side(&work->context, u, v, 1, side, level) == inside) return error;
    }
    x[1] = level;
    x[0] = axis_crossing(u, v, 1, level, &error);
    return error;
}

/* Corners lie in no cut, but they may lie in the border of the root box. */
static bool is_inside_box(const double *x, const packed_box *box) {
    return (x[0] >= box->lo[0]) & (x[0] <= box->hi[0]) & (x[1] >= box->lo[1]) & (x[1] <= box->hi[1]);
}

void axis_clip(axis_work *work, uint32_t object, const packed_box *box, packed_fragment *out) {
    const axis_ends ends = axis_sorted(work, object);
    out->id = object;
    out->error = 0;
    for (int last = 0; last < 2; last++) {
        const double *u = last ? ends.q : ends.p;
        double *x = last ? out->q : out->p;
        if (is_inside_box(u, box)) {
            x[0] = u[0], x[1] = u[1];
            out->id |= last ? PACKED_END : PACKED_START;
            continue;
        }
        const uint32_t error = packed_half(clip_end(work, &ends, last, box, x));
        for (int k = 0; k < 2; k++) {
            x[k] = x[k] > box->lo[k] ? x[k] : box->lo[k];
            x[k] = x[k] < box->hi[k] ? x[k] : box->hi[k];
        }
        out->error = error > out->error ? error : out->error;
    }
}
