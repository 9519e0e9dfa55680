/* map.h: what a picture of the plane shows beside cells and objects, so that a map is read as one. */
#ifndef FROE_DRAW_MAP_H
#define FROE_DRAW_MAP_H
#include "page.h"

/** How much shorter a length along x is drawn than one along y: on maps in degrees the cosine of the middle latitude,
 * so that shapes there are right (an equidistant cylindrical projection); else 1. */
double draw_map_squeeze(const froe_scene *scene, double low_y, double high_y);

/** Room for the numbers of the axes left of a view and below it, in text sizes. */
typedef struct draw_axis_room {
    double left, below;
} draw_axis_room;
draw_axis_room draw_map_room(const draw_view *view, const froe_scene *scene);
/** Ticks and numbers left of a view and below it: degrees on maps in degrees. */
void draw_map_axes(const draw_page *page, cairo_t *cr, const draw_view *view);

/** Fills each feature whose borders are closed rings. */
froe_status draw_map_areas(const draw_page *page, cairo_t *cr, const draw_view *view);

/** The marks of the options, and their labels. */
froe_status draw_map_marks(const draw_page *page, cairo_t *cr, const draw_view *view);

/** The whole scene, small, in the upper right corner of the page's picture, and where the view is in it. */
froe_status draw_map_locator(const draw_page *page, cairo_t *cr, const draw_view *view);
#endif
