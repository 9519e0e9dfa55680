/* locator.c: the whole scene, small, and where the picture is in it. */
#include "map/map.h"
#include "paint.h"
#include "palette.h"
#include <math.h>

/* The point of the whole picture that is nearest. */
static draw_point within(const draw_view *all, const double *p) {
    return (draw_point){fmin(fmax(p[0], all->lo.x), all->hi.x), fmin(fmax(p[1], all->lo.y), all->hi.y)};
}

froe_status draw_map_locator(const draw_page *page, cairo_t *cr, const draw_view *view) {
    const froe_scene *scene = froe_tree_scene(page->tree);
    double lo[FROE_MAX_DIM] = {0}, hi[FROE_MAX_DIM] = {0};
    if (!page->options->locator || view->axis >= 0 || !froe_scene_bounds(scene, lo, hi)) return FROE_OK;
    draw_view all = *view;
    all.space = draw_space_over(2, -1, lo, hi);
    all.space.squeeze = draw_map_squeeze(scene, lo[1], hi[1]);
    all.detail = 1;
    all.hi = (draw_point){fmax(all.space.reach[0], 0.02) * 1.04, fmax(all.space.reach[1], 0.02) * 1.04};
    all.lo = (draw_point){-all.hi.x, -all.hi.y};
    const double wide = 0.26 * page->inner_width, aspect = all.hi.y / (all.hi.x * all.space.squeeze);
    const double high = fmin(wide * aspect, 0.4 * page->inner_height);
    const double right = page->left + page->inner_width, pad = 0.5 * page->text;
    draw_view_place(&all, right - wide, page->top, wide, high);
    const draw_point p = draw_view_map(&all, all.lo), q = draw_view_map(&all, all.hi);
    draw_set_color(cr, DRAW_PAPER, 1);
    cairo_rectangle(cr, p.x - pad, q.y - pad, q.x - p.x + 2 * pad, p.y - q.y + 2 * pad);
    cairo_fill(cr);
    froe_draw_options plain = *page->options;
    plain.accented_count = 0;
    draw_page small = *page;
    small.options = &plain, small.unit = 0.6 * page->unit, small.inner_width = wide, small.inner_height = high;
    froe_status status = draw_map_areas(&small, cr, &all);
    if (status == FROE_OK) status = draw_paint_objects(&small, cr, &all, FROE_DRAW_OBJECTS);
    /* The window; one that is too small to be seen is drawn larger. */
    double a[3], b[3];
    draw_space_point(&all.space, page->options->lo, a);
    draw_space_point(&all.space, page->options->hi, b);
    const draw_point from = draw_view_map(&all, within(&all, a)), to = draw_view_map(&all, within(&all, b));
    const double least = 0.6 * page->text;
    const draw_point middle = {0.5 * (from.x + to.x), 0.5 * (from.y + to.y)};
    const double half_x = fmax(0.5 * fabs(to.x - from.x), least), half_y = fmax(0.5 * fabs(to.y - from.y), least);
    cairo_new_path(cr);
    cairo_rectangle(cr, middle.x - half_x, middle.y - half_y, 2 * half_x, 2 * half_y);
    draw_set_color(cr, DRAW_ACCENT, 0.15);
    cairo_fill_preserve(cr);
    draw_set_color(cr, DRAW_ACCENT, 1);
    cairo_set_line_width(cr, 1.8 * page->unit);
    cairo_stroke(cr);
    return status;
}
