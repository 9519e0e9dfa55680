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

/* Corner i, 0 .. 3, of the rectangle across `axis` at `at` times the half extent. */
static draw_point rectangle(const key_view *key, int axis, double at, int i) {
    double p[3];
    p[axis] = at;
    p[(axis + 1) % 3] = i == 1 || i == 2 ? 1 : -1;
    p[(axis + 2) % 3] = i >= 2 ? 1 : -1;
    return corner(key, p[0], p[1], p[2]);
}

static void rectangle_path(const key_view *key, cairo_t *cr, int axis, double at) {
    cairo_new_sub_path(cr);
    for (int i = 0; i < 4; i++) {
        draw_point p = rectangle(key, axis, at, i);
        cairo_line_to(cr, p.x, p.y);
    }
    cairo_close_path(cr);
}

static void letter(const draw_page *page, cairo_t *cr, const key_view *key, int axis, int name) {
    const char text[2] = {"xyz"[name], 0};
    /* Outside the box: below upright sections, to the right of the level one. */
    draw_point p = axis == 0 ? corner(key, 0, -1, -1) : axis == 1 ? corner(key, 1, 0, -1) : corner(key, 1, 1, 0);
    bool level = axis == 2;
    draw_set_color(cr, DRAW_SOFT, 1);
    draw_text(cr, text, p.x + (level ? 0.6 : 0) * page->text, p.y + (level ? 0.25 : 1.2) * page->text, page->text,
              level ? 0 : 0.5);
}

/* Scales the key so that the whole box, seen from the corner, fills the rectangle. */
static void place_key(key_view *key, double left, double top, double width, double height) {
    draw_point lo = {0, 0};
    for (int i = 0; i < 8; i++) {
        const double p[3] = {(i & 1 ? 1 : -1) * key->half[0], (i & 2 ? 1 : -1) * key->half[1],
                             (i & 4 ? 1 : -1) * key->half[2]};
        draw_point q = draw_camera_project(&key->camera, p);
        lo = (draw_point){fmin(lo.x, q.x), fmin(lo.y, q.y)};
    }
    key->view = (draw_view){.lo = lo, .hi = {-lo.x, -lo.y}};
    draw_view_place(&key->view, left, top, width, height);
}

void draw_paint_key(const draw_page *page, cairo_t *cr, const draw_space *space, const double *half, double left,
                    double top, double width, double height) {
    key_view key = {.half = half, .camera = draw_camera_from(space, (const double[3]){0, 0, 0})};
    place_key(&key, left + 0.24 * width, top + 0.24 * height, 0.52 * width, 0.52 * height);
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
    for (int axis = 0; axis < 3; axis++) letter(page, cr, &key, axis, space->from[axis]);
}
