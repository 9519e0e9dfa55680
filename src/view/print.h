/* print.h: polygons on the page, in doubles: projected, and cut to what is before the eye and near the page.
 *
 * These do not decide what is visible. They find pairs that may overlap, and become output. Rings are cut one by one
 * (Sutherland and Hodgman 1974); where a ring is not convex that leaves doubled lines along the cut, without area. */
#ifndef FROE_VIEW_PRINT_H
#define FROE_VIEW_PRINT_H
#include "support/array.h"
#include "view/camera.h"

typedef struct print_point {
    double x, y;
} print_point;

typedef ARRAY(print_point) print_ring;
/** Per ring of several: where its points end. */
typedef ARRAY(uint32_t) print_ends;

/** A ring in the camera's coordinates on its way to the page. */
typedef struct print_press {
    froe_allocator alloc;
    const froe_projection *view;
    ARRAY(double) at[2]; /**< 3 a point; cut from one to the other */
} print_press;

/** How far beyond the sides of the page whole faces are cut, in sizes of the page. */
#define PRINT_BEYOND 1.5

void print_free(print_press *press);
static inline void print_begin(print_press *press) {
    press->at[0].count = 0;
}
/** Adds a point of space to the ring. False without memory. */
bool print_add(print_press *press, const double *point);
/** The same, by the way to it from the eye, or from the point that a parallel projection begins at. */
bool print_add_way(print_press *press, const double *way);
/** Appends the ring to `out`; *cut: it had to be cut, or lies wholly away. False without memory. */
bool print_end(print_press *press, print_ring *out, bool *cut);
/** Narrows a segment of space, from + t (to - from) with t in share[0] .. share[1], to what is before the eye and on
 * the page itself, `beyond` further. False when nothing is left. */
bool print_clip_segment(const froe_projection *view, const double *from, const double *to, double beyond,
                        double share[2]);
/** The share of a segment of space before the eye at which it is seen at share `t` of its image on the page. */
double print_share(const froe_projection *view, const double *from, const double *to, double t);
/** Twice the signed area; positive when it turns left on a page with y upwards, as the eye sees it. */
double print_area(const print_point *ring, size_t count);
/** Do two convex rings, turning left, overlap by more than `margin` in every direction? (Separating axes.) */
bool print_overlap(const print_point *a, size_t a_count, const print_point *b, size_t b_count, double margin);
#endif
