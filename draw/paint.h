/* paint.h: what a flat view shows, painted. */
#ifndef FROE_DRAW_PAINT_H
#define FROE_DRAW_PAINT_H
#include "page.h"
#include "shape.h"

/** Cells, then cuts, of a partition (several views at once). */
froe_status draw_paint_partition(const draw_page *page, cairo_t *cr, const draw_partition *partition, uint32_t show);
/** Objects, then fragments, in one view. */
froe_status draw_paint_objects(const draw_page *page, cairo_t *cr, const draw_view *view, uint32_t show);
/** A box of these half extents with its three middle sections, in a rectangle of the page. */
void draw_paint_key(const draw_page *page, cairo_t *cr, const draw_space *space, const double *half, double left,
                    double top, double width, double height);
#endif
