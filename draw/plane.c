/* plane.c: pictures in the plane: the plane itself, one section, or a sheet of
 * three, arranged as in an engineer's drawing so that edges line up:
 *
 *     plan    z = middle      .
 *     front   y = middle      side   x = middle                                    */
#include "lettering.h"
#include "map/map.h"
#include "paint.h"
#include "palette.h"
#include "picture.h"
#include <math.h>
#include <stdio.h>

#define GAP 2.0   /* between the views of a sheet, in text sizes */
#define LABEL 2.2 /* room for the label below a view */

typedef struct draw_panel {
    draw_view view;
    char label[64];
} draw_panel;

static bool is_sheet(const draw_picture *picture) {
    return picture->space.dim == 3 && picture->page.options->axis < 0;
}

/* The axes of a view: a section across z shows x, y; across y: x, z; across x: y, z. */
static void axes_of(int axis, int *across, int *up) {
    *across = axis == 0 ? 1 : 0;
    *up = axis == 2 || axis < 0 ? 1 : 2;
}

/* The drawing axis across a single section; -1 in the plane. */
static int section_axis(const draw_picture *picture) {
    return picture->space.dim == 3 ? draw_space_axis(&picture->space, picture->page.options->axis) : -1;
}

/* axis: of the drawing; at: in the scene's coordinates. */
static void set_view(const draw_picture *picture, int axis, double at, draw_panel *out) {
    draw_view *view = &out->view;
    *view = (draw_view){.space = picture->space, .axis = axis, .at = 0, .detail = picture->page.options->detail};
    axes_of(axis, &view->across, &view->up);
    view->hi = (draw_point){picture->wide[view->across], picture->wide[view->up]};
    view->lo = (draw_point){-view->hi.x, -view->hi.y};
    out->label[0] = 0;
    if (axis < 0) return;
    view->at = draw_space_map(&picture->space, axis, at);
    char number[44];
    draw_number(number, at);
    snprintf(out->label, sizeof out->label, "%c = %s", "xyz"[picture->space.from[axis]], number);
}

/* Of a single view with a legend. */
static draw_axis_room axis_room(const draw_picture *picture) {
    draw_panel panel;
    if (!picture->page.options->legend) return (draw_axis_room){0, 0};
    set_view(picture, section_axis(picture), picture->page.options->at, &panel);
    return draw_map_room(&panel.view, froe_tree_scene(picture->page.tree));
}

froe_status draw_plane_plan(draw_picture *picture) {
    const double *wide = picture->wide;
    if (is_sheet(picture)) {
        draw_page_plan(&picture->page, (wide[1] + wide[2]) / (wide[0] + wide[1]), GAP, GAP + 2 * LABEL);
        return FROE_OK;
    }
    int across, up;
    axes_of(section_axis(picture), &across, &up);
    const draw_axis_room room = axis_room(picture);
    draw_page_plan(&picture->page, wide[up] / (wide[across] * picture->space.squeeze), room.left,
                   room.below + (picture->space.dim == 3 ? LABEL : 0));
    return FROE_OK;
}

/* Views in their places; returns how many. */
static int arrange(const draw_picture *picture, draw_panel *panels) {
    const draw_page *page = &picture->page;
    const double *wide = picture->wide;
    const draw_space *space = &picture->space;
    double gap = GAP * page->text, label = LABEL * page->text;
    if (!is_sheet(picture)) {
        const draw_axis_room room = axis_room(picture);
        const double left = room.left * page->text, below = room.below * page->text + (space->dim == 3 ? label : 0);
        set_view(picture, section_axis(picture), page->options->at, panels);
        draw_view_place(&panels[0].view, page->left + left, page->top, fmax(page->inner_width - left, 1),
                        fmax(page->inner_height - below, 1));
        return 1;
    }
    double scale = fmin((page->inner_width - gap) / (2 * (wide[0] + wide[1])),
                        (page->inner_height - gap - 2 * label) / (2 * (wide[1] + wide[2])));
    scale = fmax(scale, 0);
    double x = 2 * wide[0] * scale, y = 2 * wide[1] * scale, z = 2 * wide[2] * scale;
    double left = page->left + 0.5 * fmax(page->inner_width - x - y - gap, 0), top = page->top;
    for (int i = 0; i < 3; i++) {
        const int axis = 2 - i;
        set_view(picture, axis, space->sign[axis] * ldexp(space->mid[axis], -space->shift), panels + i);
    }
    draw_view_place(&panels[0].view, left, top, x, y);
    draw_view_place(&panels[1].view, left, top + y + label + gap, x, z);
    draw_view_place(&panels[2].view, left + x + gap, top + y + label + gap, y, z);
    return 3;
}

static void window_path(cairo_t *cr, const draw_view *view) {
    draw_point p = draw_view_map(view, view->lo), q = draw_view_map(view, view->hi);
    cairo_rectangle(cr, p.x, q.y, q.x - p.x, p.y - q.y);
}

static froe_status paint_panels(const draw_picture *picture, cairo_t *cr, const draw_panel *panels, int count,
                                draw_partition *part) {
    const draw_page *page = &picture->page;
    froe_status status = FROE_OK;
    for (int i = 0; i < count && status == FROE_OK; i++)
        status = draw_partition_add(part, page->tree, &panels[i].view, page->options->max_depth, page->task);
    if (status == FROE_OK && !draw_partition_scale(part)) status = FROE_E_MEMORY;
    if (status == FROE_OK) status = draw_paint_partition(page, cr, part, picture->show);
    for (int i = 0; i < count && status == FROE_OK; i++) {
        const draw_view *view = &panels[i].view;
        cairo_save(cr);
        window_path(cr, view);
        cairo_clip(cr);
        if (view->space.dim == 2 && picture->show & FROE_DRAW_OBJECTS) status = draw_map_areas(page, cr, view);
        if (status == FROE_OK) status = draw_paint_objects(page, cr, view, picture->show);
        cairo_restore(cr);
        if (status == FROE_OK) status = draw_map_marks(page, cr, view);
        if (status == FROE_OK) status = draw_map_locator(page, cr, view);
        const bool axes = count == 1 && page->options->legend;
        if (axes) draw_map_axes(page, cr, view);
        const draw_point corner = draw_view_map(view, view->lo);
        draw_set_color(cr, DRAW_SOFT, 1);
        draw_text(cr, panels[i].label, corner.x, corner.y + (axes ? 3.1 : 1.5) * page->text, page->text, 0);
    }
    return status;
}

froe_status draw_plane_paint(draw_picture *picture, cairo_t *cr) {
    const draw_page *page = &picture->page;
    draw_panel panels[3];
    int count = arrange(picture, panels);
    draw_partition part = {.alloc = page->alloc};
    draw_page_open(page, cr);
    if (count == 3) { /* a key in the corner that a sheet leaves free: right of the plan, above the side view */
        const draw_view *plan = &panels[0].view, *side = &panels[2].view;
        const draw_point left = draw_view_map(side, side->lo), right = draw_view_map(side, side->hi);
        const double top = draw_view_map(plan, plan->hi).y, height = draw_view_map(plan, plan->lo).y - top;
        const double width = right.x - left.x;
        if (width > 8 * page->text && height > 8 * page->text)
            draw_paint_key(page, cr, &picture->space, picture->wide, left.x, top, width, height);
    }
    froe_status status = paint_panels(picture, cr, panels, count, &part);
    const bool regions = picture->show & (FROE_DRAW_CELLS | FROE_DRAW_CUTS);
    draw_legend legend = {.scale_of_depths = picture->show & FROE_DRAW_CELLS,
                          .lo_depth = part.lo_depth,
                          .hi_depth = part.hi_depth,
                          .below = part.below,
                          .above = part.above,
                          .unit = panels[0].view.scale * picture->space.squeeze,
                          .length = picture->space.unit,
                          .squeeze = picture->space.squeeze,
                          .merged = regions ? part.merged : 0,
                          .merged_leaves = part.merged_leaves};
    draw_page_close(page, cr, &legend);
    draw_partition_free(&part);
    return status;
}
