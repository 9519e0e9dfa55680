/* segment.h: exact questions about segments and points of the plane. A point is a segment with equal ends. */
#ifndef FROE_QUERY_SEGMENT_H
#define FROE_QUERY_SEGMENT_H
#include "geom/predicates.h"

/** Side of x beside the line from u to v: 1 left, -1 right, 0 on it or u = v. */
int query_turn(num_context *numbers, const double *u, const double *v, const double *x);
/** Does the closed segment meet the closed box? Bounds of the box may be infinite. */
bool query_segment_meets_box(num_context *numbers, const double *u, const double *v, const double *lo,
                             const double *hi);

/** Do the closed segments ab and uv meet? */
bool query_segments_meet(num_context *numbers, const double *a, const double *b, const double *u, const double *v);

/** Where a vertical ray first meets a segment: at (x, y), or where the line uv is at x. */
typedef struct query_height {
    bool known; /**< y is it */
    double x, y;
    const double *u, *v; /**< u[0] < x < v[0] */
} query_height;

/** The height at which the ray from `point`, upwards (1) or downwards (-1), first meets the segment from u to v, which
 * ascend by x, then y; false: nowhere. */
bool query_height_at(num_context *numbers, const double *u, const double *v, const double *point, int direction,
                     query_height *out);
/** Sign of a - b; both of one x. */
int query_height_compare(num_context *numbers, const query_height *a, const query_height *b);
#endif
