/* key.c: the small drawing beside a sheet of sections that shows where they cut the scene, or, as a locator, where
 * their window is in the whole scene. */
#include "exploded/solid.h"
#include "lettering.h"
#include "paint.h"
#include "palette.h"
#include <math.h>

typedef struct key_view {
    draw_camera camera;
    draw_view view;
    double half[3];           /* half extents of what is shown */
    double middle[3], own[3]; /* of the window: its middle and half extents, in parts of these */
} key_view;

static draw_point corner(const key_view *key, double x, double y, double z) {
    const double p[3] = {x * key->half[0], y * key->half[1], z * key->half[2]};
    return draw_view_map(&key->view, draw_camera_project(&key->camera, p));
}

/* The rectangle across `axis` through a point of the box that has this middle and half extents. */
static void rectangle_path(const key_view *key, cairo_t *cr, int axis, double at, const double *middle,
                           const double *half) {
    cairo_new_sub_path(cr);
    for (int i = 0; i < 4; i++) {
        const int next = (axis + 1) % 3, last = (axis + 2) % 3;
        double p[3];
        p[axis] = at;
        p[next] = middle[next] + (i == 1 || i == 2 ? half[next] : -half[next]);
        p[last] = middle[last] + (i >= 2 ? half[last] : -half[last]);
        const draw_point at_page = corner(key, p[0], p[1], p[2]);
        cairo_line_to(cr, at_page.x, at_page.y);
    }
    cairo_close_path(cr);
}

/* What is shown: the window alone, or the whole scene with the window in it. */
static key_view view_of(const draw_page *page, const draw_space *space, const double *wide) {
    key_view key = {.view.space.squeeze = 1, .camera = draw_camera_from(space, (const double[3]){0, 0, 0})};
    double lo[FROE_MAX_DIM] = {0}, hi[FROE_MAX_DIM] = {0}, a[3], b[3];
    for (int k = 0; k < 3; k++) key.half[k] = wide[k], key.own[k] = 1;
    if (!page->options->locator || !froe_scene_bounds(froe_tree_scene(page->tree), lo, hi)) return key;
    const draw_space whole = draw_space_over(3, space->from[2], lo, hi);
    draw_space_point(&whole, page->options->lo, a);
    draw_space_point(&whole, page->options->hi, b);
    for (int k = 0; k < 3; k++) {
        key.half[k] = fmax(whole.reach[k], 0.02);
        const double low = fmax(fmin(a[k], b[k]) / key.half[k], -1), high = fmin(fmax(a[k], b[k]) / key.half[k], 1);
        key.middle[k] = 0.5 * (low + high);
        key.own[k] = fmax(0.5 * (high - low), 0.02);
    }
    return key;
}

void draw_paint_key(const draw_page *page, cairo_t *cr, const draw_space *space, const double *wide, double left,
                    double top, double width, double height) {
    static const double none[3] = {0, 0, 0}, all[3] = {1, 1, 1};
    key_view key = view_of(page, space, wide);
    const double *half = key.half;
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
        rectangle_path(&key, cr, axis, key.middle[axis], none, all);
        draw_set_color(cr, draw_tone(DRAW_TONES / 2), 0.22);
        cairo_fill_preserve(cr);
        draw_set_color(cr, DRAW_LINE, 0.8);
        cairo_set_line_width(cr, 0.6 * page->unit);
        cairo_stroke(cr);
    }
    draw_set_color(cr, DRAW_LINE, 0.35);
    cairo_set_line_width(cr, 0.4 * page->unit);
    for (int axis = 0; axis < 3; axis++)
        for (int side = -1; side <= 1; side += 2) rectangle_path(&key, cr, axis, side, none, all);
    cairo_stroke(cr);
    if (page->options->locator) {
        draw_set_color(cr, DRAW_ACCENT, 1);
        cairo_set_line_width(cr, 1.2 * page->unit);
        for (int axis = 0; axis < 3; axis++)
            for (int side = -1; side <= 1; side += 2)
                rectangle_path(&key, cr, axis, key.middle[axis] + side * key.own[axis], key.middle, key.own);
        cairo_stroke(cr);
    }
    draw_set_color(cr, DRAW_SOFT, 1);
    for (int axis = 0; axis < 3; axis++) { /* outside the box: below upright sections, to the right of the level one */
        const char name[2] = {"xyz"[space->from[axis]], 0};
        const bool level = axis == 2;
        const draw_point p = corner(&key, axis > 0, axis == 1 ? 0 : axis == 0 ? -1 : 1, level ? 0 : -1);
        draw_text(cr, name, p.x + (level ? 0.6 : 0) * page->text, p.y + (level ? 0.25 : 1.2) * page->text, page->text,
                  level ? 0 : 0.5);
    }
}
