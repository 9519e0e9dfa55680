/* view.h: a plane of the scene on a rectangle of the page. */
#ifndef FROE_DRAW_VIEW_H
#define FROE_DRAW_VIEW_H
#include "space.h"
#include "task.h"

typedef struct draw_point {
    double x, y;
} draw_point;

/** Page x = x0 + scale * squeeze * p[across], page y = y0 - scale * p[up] in drawing coordinates. */
typedef struct draw_view {
    draw_space space;
    int across, up;
    int axis;          /**< a section p[axis] = at; -1: the plane itself */
    double at;         /**< in drawing coordinates */
    double x0, y0;     /**< where drawing coordinates 0, 0 are on the page */
    double scale;      /**< page units per drawing unit */
    draw_point lo, hi; /**< window in drawing coordinates */
    double detail;     /**< in page units */
} draw_view;

/** Places the window, which must be set, into a rectangle of the page. */
void draw_view_place(draw_view *view, double left, double top, double width, double height);
draw_point draw_view_map(const draw_view *view, draw_point p);

/** The part of a segment inside the window; false: none. */
bool draw_view_clip_line(const draw_view *view, draw_point *p, draw_point *q);
/** The part of a convex ring inside the window. `ring` and `spare` need room for
 * count + 4 points; the result is in ring. Returns its number of corners. */
size_t draw_view_clip_ring(const draw_view *view, draw_point *ring, draw_point *spare, size_t count);
/** The part of a convex ring where side * (n . p - c) >= 0 (out: room for count + 1). */
size_t draw_clip_half(const draw_point *ring, size_t count, draw_point n, double c, double side, draw_point *out);

/** Dots of the page that something tiny has already filled: of a million objects
 * smaller than a dot one a dot is enough. */
typedef struct draw_dots {
    froe_allocator alloc;
    unsigned char *bits;
    size_t across, down;
    double left, top, detail;
} draw_dots;
bool draw_dots_new(const froe_allocator *alloc, double left, double top, double width, double height, double detail,
                   draw_dots *out);
void draw_dots_free(draw_dots *dots);
/** Is a thing that spans lo .. hi smaller than a dot whose place is taken? Takes it if not. */
bool draw_dots_taken(draw_dots *dots, draw_point lo, draw_point hi);
#endif
