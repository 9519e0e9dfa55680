/* render_png.c: the paths of a picture with hidden surfaces removed, painted by Cairo. */
#include "output.h"
#include "support/fail.h"
#include "support/floats.h"
#include "support/writer.h"

static void set_colour(cairo_t *cr, uint32_t colour, double opacity) {
    const double r = (colour >> 16 & 255) / 255.0, g = (colour >> 8 & 255) / 255.0, b = (colour & 255) / 255.0;
    if (opacity < 1)
        cairo_set_source_rgba(cr, r, g, b, opacity);
    else
        cairo_set_source_rgb(cr, r, g, b);
}

static bool paint_path(void *user, const froe_render_path *path) {
    SUPPORT_FLOATS_OWN;
    cairo_t *cr = user;
    const double dashes[2] = {path->dash, path->gap};
    set_colour(cr, path->colour, (path->colour >> 24) / 255.0);
    for (size_t i = 0; i < path->count; i++) {
        const froe_outline *o = path->outlines + i;
        cairo_move_to(cr, o->points[0], o->points[1]);
        for (size_t k = 1; k < o->count; k++) cairo_line_to(cr, o->points[2 * k], o->points[2 * k + 1]);
        if (o->closed) cairo_close_path(cr);
    }
    cairo_set_line_cap(cr, path->dots ? CAIRO_LINE_CAP_ROUND : CAIRO_LINE_CAP_BUTT);
    cairo_set_line_width(cr, path->width);
    cairo_set_dash(cr, dashes, path->dash > 0 ? 2 : 0, 0);
    if (path->lines || path->width > 0) cairo_stroke_preserve(cr);
    if (!path->lines) cairo_fill_preserve(cr);
    cairo_new_path(cr);
    return true;
}

froe_status froe_render_png(const froe_tree *tree, const char *path, const froe_render_options *options,
                            froe_render_report *report, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    const froe_render_options standard = froe_render_defaults(), *o = options ? options : &standard;
    froe_render_report found;
    if (!tree || !path) return support_fail_null(diag, __func__);
    if (o->size != sizeof *o) return support_fail_defaults(diag, "froe_render_defaults");
    draw_output output = {.alloc = support_allocator(o->alloc)};
    /* What froe_render_paths() leaves to its caller: the size in pixels. */
    const struct {
        const char *name;
        double value, lo, hi;
    } ranges[] = {{"pixels", o->pixels, 0.1, 64},
                  {"width", o->camera.width * o->pixels, 1, 32000},
                  {"height", o->camera.height * o->pixels, 1, 32000}};
    for (size_t i = 0; i < sizeof ranges / sizeof *ranges; i++)
        if (!(ranges[i].value >= ranges[i].lo && ranges[i].value <= ranges[i].hi))
            return support_fail(diag, FROE_E_OPTIONS, "option '%s': '%g' is not a number from %g to %g.",
                                ranges[i].name, ranges[i].value, ranges[i].lo, ranges[i].hi);
    froe_status status = draw_output_begin(&output, &output.alloc, FROE_DRAW_PNG, o->camera.width, o->camera.height,
                                           o->pixels, NULL, diag);
    if (!status) {
        if (o->background != FROE_DRAW_CLEAR) {
            set_colour(output.cr, o->background == FROE_DRAW_BY_FORMAT ? 0xFFFFFF : o->background, 1);
            cairo_paint(output.cr);
        }
        cairo_set_fill_rule(output.cr, CAIRO_FILL_RULE_WINDING);
        cairo_set_line_join(output.cr, CAIRO_LINE_JOIN_ROUND);
        /* Cairo's coordinates are whole 1/256 of a pixel. */
        status = froe_render_paths(tree, 256 * o->pixels, paint_path, output.cr, o, &found, diag);
    }
    if (!status) status = draw_output_finish(&output, diag);
    if (!status) status = support_write(path, output.bytes.data, output.bytes.count, &output.alloc, diag);
    if (!status && report) *report = found, report->bytes = output.bytes.count;
    draw_output_free(&output);
    return status;
}
