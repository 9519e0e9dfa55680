/* axes.c: numbers along the left and the lower edge of a view, and how a map in degrees is scaled. */
#include "lettering.h"
#include "map/map.h"
#include "palette.h"
#include "support/nice.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

#define SPACING_ACROSS 9.0 /* between numbers, in text sizes */
#define SPACING_UP 6.0

static bool is_geographic(const froe_scene *scene) {
    return froe_scene_dim(scene) == 2 && froe_scene_crs(scene).kind == FROE_CRS_GEOGRAPHIC;
}

/* cos(x) = 1 - 2 sin(x / 2)^2 by the series of the sine, the same bits everywhere; |x| < pi / 2. */
static double cosine(double x) {
    const double h = 0.5 * x, square = h * h;
    const double sine = h * (1 - square / 6 * (1 - square / 20 * (1 - square / 42 * (1 - square / 72))));
    return 1 - 2 * sine * sine;
}

double draw_map_squeeze(const froe_scene *scene, double low_y, double high_y) {
    const double middle = 0.5 * low_y + 0.5 * high_y;
    if (!is_geographic(scene) || !(fabs(middle) < 80)) return 1;
    return cosine(middle * 0.017453292519943295);
}

/* Where multiples of a step lie, of an axis of a view. */
typedef struct draw_axis {
    const draw_space *space;
    int axis;
    double from, to, step; /* in the scene's coordinates */
    int digits;
    bool degrees, up;
} draw_axis;

static double scene_value(const draw_space *space, int axis, double at) {
    return space->sign[axis] * ldexp(space->mid[axis] + at * space->half, -space->shift);
}

/* Steps of degrees above ten divide the circle. */
static double step_of_degrees(double least) {
    static const double steps[] = {15, 30, 45, 60, 90, 180};
    if (least <= 10) return support_nice_above(least);
    for (size_t i = 0; i < sizeof steps / sizeof *steps; i++)
        if (steps[i] >= least) return steps[i];
    return 360;
}

static draw_axis axis_of(const draw_view *view, const froe_scene *scene, bool up, double most) {
    draw_axis a = {.space = &view->space, .axis = up ? view->up : view->across, .up = up};
    const double low = scene_value(a.space, a.axis, up ? view->lo.y : view->lo.x);
    const double high = scene_value(a.space, a.axis, up ? view->hi.y : view->hi.x);
    a.from = fmin(low, high), a.to = fmax(low, high);
    a.degrees = is_geographic(scene);
    const double least = (a.to - a.from) / fmax(most, 1);
    if (!(least > 0) || !isfinite(least)) return a;
    a.step = a.degrees ? step_of_degrees(least) : support_nice_above(least);
    const double largest = fmax(fabs(a.from), fabs(a.to));
    if (!(largest / a.step < 1e12)) a.step = 0; /* doubles do not tell the ticks apart */
    a.digits = 1;
    for (double power = a.step; a.step > 0 && power <= largest; power *= 10) a.digits++;
    return a;
}

static void name_tick(const draw_axis *a, double value, char out[64]) {
    if (a->digits > 9 || value != floor(value)) {
        snprintf(out, 40, "%.*g", a->digits, value);
        for (char *c = out; *c; c++) /* the decimal point of no locale */
            if (!strchr("0123456789+-e", *c)) *c = '.';
    } else
        draw_number(out, a->degrees ? fabs(value) : value);
    if (!a->degrees) return;
    if (out[0] == '-') memmove(out, out + 1, strlen(out));
    const char *half = value == 0 ? "" : a->up ? value < 0 ? "S" : "N" : value < 0 ? "W" : "E";
    snprintf(out + strlen(out), 8, "\xC2\xB0%s", half);
}

draw_axis_room draw_map_room(const draw_view *view, const froe_scene *scene) {
    const draw_axis a = axis_of(view, scene, true, 6);
    size_t longest = 1;
    char number[64];
    for (int end = 0; end < 2 && a.step > 0; end++) {
        name_tick(&a, (end ? floor(a.to / a.step) : ceil(a.from / a.step)) * a.step, number);
        longest = strlen(number) > longest ? strlen(number) : longest;
    }
    return (draw_axis_room){0.9 + 0.6 * (double)longest, 1.6};
}

void draw_map_axes(const draw_page *page, cairo_t *cr, const draw_view *view) {
    const draw_point lo = draw_view_map(view, view->lo), hi = draw_view_map(view, view->hi);
    const froe_scene *scene = froe_tree_scene(page->tree);
    const double tick = 0.35 * page->text;
    char number[64];
    for (int up = 0; up < 2; up++) {
        const double length = up ? lo.y - hi.y : hi.x - lo.x;
        const draw_axis a = axis_of(view, scene, up, length / ((up ? SPACING_UP : SPACING_ACROSS) * page->text));
        for (double i = ceil(a.from / a.step); a.step > 0 && i * a.step <= a.to; i++) {
            const double at = draw_space_map(a.space, a.axis, i * a.step);
            const draw_point p = draw_view_map(view, up ? (draw_point){view->lo.x, at} : (draw_point){at, view->lo.y});
            draw_set_color(cr, DRAW_SOFT, 0.8);
            cairo_set_line_width(cr, 0.8 * page->unit);
            cairo_set_line_cap(cr, CAIRO_LINE_CAP_BUTT);
            cairo_move_to(cr, p.x, p.y);
            cairo_rel_line_to(cr, up ? -tick : 0, up ? 0 : tick);
            cairo_stroke(cr);
            name_tick(&a, i * a.step, number);
            draw_set_color(cr, DRAW_SOFT, 1);
            if (up)
                draw_text(cr, number, p.x - 1.8 * tick, p.y + 0.25 * page->text, 0.85 * page->text, 1);
            else
                draw_text(cr, number, p.x, p.y + 1.6 * tick + 0.65 * page->text, 0.85 * page->text, 0.5);
        }
    }
}
