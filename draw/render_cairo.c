/* render_cairo.c: the picture through Cairo, for PDF, EPS and PNG: the same shapes, the same runs as in SVG. */
#include "render.h"

static void add_path(cairo_t *cr, const double *points, size_t count, bool closed) {
    cairo_move_to(cr, points[0], points[1]);
    for (size_t i = 1; i < count; i++) cairo_line_to(cr, points[2 * i], points[2 * i + 1]);
    if (closed) cairo_close_path(cr);
}

static void add_shape(const draw_render *r, cairo_t *cr, const froe_shape *s) {
    for (size_t i = 0; i < s->ring_count; i++) {
        size_t count;
        const double *ring = froe_picture_ring(r->picture, s->first_ring + i, &count);
        add_path(cr, ring, count, true);
    }
}

static void set_colour(cairo_t *cr, uint32_t colour, double opacity) {
    const double r = (colour >> 16 & 255) / 255.0, g = (colour >> 8 & 255) / 255.0, b = (colour & 255) / 255.0;
    if (opacity < 1)
        cairo_set_source_rgba(cr, r, g, b, opacity);
    else
        cairo_set_source_rgb(cr, r, g, b);
}

static void paint_shapes(draw_render *r, cairo_t *cr, const draw_run *run) {
    const froe_shape first = froe_picture_shape(r->picture, run->first);
    const draw_style style = draw_style_of(r, &first);
    set_colour(cr, style, (style >> 24) / 255.0);
    for (size_t i = run->first; i < run->end; i++) {
        const froe_shape shape = froe_picture_shape(r->picture, i);
        add_shape(r, cr, &shape);
    }
    cairo_set_line_width(cr, r->options->seam_width);
    if (r->options->seams == FROE_SEAMS_STROKE) cairo_stroke_preserve(cr);
    cairo_fill(cr);
}

static void paint_strokes(draw_render *r, cairo_t *cr, const draw_run *run) {
    const froe_stroke first = froe_picture_stroke(r->picture, run->first);
    const double width = draw_line_width(r->options, first.kind) * (first.hidden ? 0.6 : 1);
    const double dashes[2] = {4 * width, 3 * width};
    set_colour(cr, 0x1B2630, 1);
    cairo_set_line_width(cr, width);
    cairo_set_dash(cr, dashes, first.hidden ? 2 : 0, 0);
    for (size_t i = run->first; i < run->end; i++) {
        const froe_stroke s = froe_picture_stroke(r->picture, i);
        if (draw_stroke_shows(r, &s)) add_path(cr, s.points, s.count, s.closed);
    }
    cairo_stroke(cr);
    cairo_set_dash(cr, dashes, 0, 0);
}

static void paint_runs(draw_render *r, cairo_t *cr, bool lines) {
    draw_cursor at = {0, 0};
    draw_run run;
    while (draw_next_run(r, &at, &run)) {
        if (run.lines && !lines) continue;
        if (run.lines)
            paint_strokes(r, cr, &run);
        else
            paint_shapes(r, cr, &run);
        r->report.paths++;
    }
}

void draw_cairo(draw_render *r, cairo_t *cr) {
    if (r->options->background != FROE_DRAW_CLEAR) {
        set_colour(cr, r->options->background, 1);
        cairo_paint(cr);
    }
    cairo_set_fill_rule(cr, CAIRO_FILL_RULE_WINDING);
    cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
    if (r->options->seams == FROE_SEAMS_TWICE) paint_runs(r, cr, false);
    paint_runs(r, cr, true);
}
