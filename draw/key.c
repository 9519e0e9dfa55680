/* key.c: the small drawing beside a sheet of sections that shows where they cut the scene. */
#include "exploded/solid.h"
#include "lettering.h"
#include "paint.h"
#include "palette.h"
#include <math.h>

typedef struct key_view {
    draw_camera camera;
    draw_view view;
    const double *half; /* half extents of the scene */
} key_view;

static draw_point corner(const key_view *key, double x, double y, double z) {
    const double p[3] = {x * key->half[0], y * key->half[1], z * key->half[2]};
    return draw_view_map(&key->view, draw_camera_project(&key->camera, p));
}

/* The rectangle across `axis` at `at` times the half extent. */
static void rectangle_path(const key_view *key, cairo_t *cr, int axis, double at) {
    cairo_new_sub_path(cr);
    for (int i = 0; i < 4; i++) {
        double p[3];
        p[axis] = at;
        p[(axis + 1) % 3] = i == 1 || i == 2 ? 1 : -1;
        p[(axis + 2) % 3] = i >= 2 ? 1 : -1;
        const draw_point at_page = corner(key, p[0], p[1], p[2]);
        cairo_line_to(cr, at_page.x, at_page.y);
    }
    cairo_close_path(cr);
}

void draw_paint_key(const draw_page *page, cairo_t *cr, const draw_space *space, const double *half, double left,
                    double top, double width, double height) {
    key_view key = {
        .half = half, .view.space.squeeze = 1, .camera = draw_camera_from(space, (const double[3]){0, 0, 0})};
    /* The whole box, seen from the corner, fills the middle of the rectangle. */
    for (int i = 0; i < 8; i++) {
        const double p[3] = {(i & 1 ? 1 : -1) * half[0], (i & 2 ? 1 : -1) * half[1], (i & 4 ? 1 : -1) * half[2]};
        const draw_point q = draw_camera_project(&key.camera, p);
        key.view.lo = (draw_point){fmin(key.view.lo.x, q.x), fmin(key.view.lo.y, q.y)};
    }
    key.view.hi = (draw_point){-key.view.lo.x, -key.view.lo.y};
    draw_view_place(&key.view, left + 0.24 * width, top + 0.24 * height, 0.52 * width, 0.52 * height);
    cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
    for (int axis = 0; axis < 3; axis++) {
        rectangle_path(&key, cr, axis, 0);
        draw_set_color(cr, draw_tone(DRAW_TONES / 2), 0.22);
        cairo_fill_preserve(cr);
        draw_set_color(cr, DRAW_LINE, 0.8);
        cairo_set_line_width(cr, 0.6 * page->unit);
        cairo_stroke(cr);
    }
    draw_set_color(cr, DRAW_LINE, 0.35);
    cairo_set_line_width(cr, 0.4 * page->unit);
    for (int axis = 0; axis < 3; axis++)
        for (int side = -1; side <= 1; side += 2) rectangle_path(&key, cr, axis, side);
    cairo_stroke(cr);
    draw_set_color(cr, DRAW_SOFT, 1);
    for (int axis = 0; axis < 3; axis++) { /* outside the box: below upright sections, to the right of the level one */
        const char name[2] = {"xyz"[space->from[axis]], 0};
        const bool level = axis == 2;
        const draw_point p = corner(&key, axis > 0, axis == 1 ? 0 : axis == 0 ? -1 : 1, level ? 0 : -1);
        draw_text(cr, name, p.x + (level ? 0.6 : 0) * page->text, p.y + (level ? 0.25 : 1.2) * page->text, page->text,
                  level ? 0 : 0.5);
    }
}
