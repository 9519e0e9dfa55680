/* plot.c: figures of numbers as SVG.
 *
 *      title                          The frame takes what title and labels leave of the width and height asked for;
 *      |        __o                   the key comes below, in as many rows as it needs.
 *    y |   __o--                      Coordinates are whole numbers of tenths of a pixel, written as such.
 *      |o--
 *      +-----------
 *            x        o a  + b
 */
#include <froe/plot.h>

#include "axis.h"
#include "support/fail.h"
#include "support/floats.h"
#include "support/xml.h"
#include "task.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { COLOURS = 8, MARKERS = 5, LETTER = 7, ROW = 18 };
static const char *const colours[COLOURS] = {"#3b82c4", "#e07b39", "#2f9e77", "#c04f8f",
                                             "#8a6fd1", "#b0912a", "#d1495b", "#4fa3a5"};

typedef struct plot {
    const froe_plot_options *o;
    const froe_plot_series *series;
    size_t count;
    froe_allocator alloc;
    ARRAY(char) text;
    bool ok;
    draw_axis x, y;
} plot;

/* ------------------------------------------------------------------ writing -- */

static void put_plot_text(plot *p, const char *text, size_t length) {
    p->ok = p->ok && array_reserve(&p->alloc, &p->text, length);
    if (!p->ok) return;
    memcpy(p->text.data + p->text.count, text, length);
    p->text.count += length;
}

static void put_plot_label(plot *p, const char *text) {
    put_plot_text(p, text, strlen(text));
}

static void put_escaped(plot *p, const char *text) {
    char out[8];
    for (size_t n; (n = support_xml_escape(&text, out));) put_plot_text(p, out, n);
}

/* "12.3" in every locale. */
static void put_number(plot *p, double value) {
    char text[32];
    const long long tenths = llround(value * 10), size = tenths < 0 ? -tenths : tenths;
    int used = snprintf(text, sizeof text, "%s%lld", tenths < 0 ? "-" : "", size / 10);
    if (size % 10) used += snprintf(text + used, sizeof text - (size_t)used, ".%lld", size % 10);
    put_plot_text(p, text, (size_t)used);
}

static void put_attribute(plot *p, const char *name, double value) {
    put_plot_label(p, " ");
    put_plot_label(p, name);
    put_plot_label(p, "=\"");
    put_number(p, value);
    put_plot_label(p, "\"");
}

static void put_pair(plot *p, const char *command, double x, double y) {
    put_plot_label(p, command);
    put_number(p, x);
    put_plot_label(p, " ");
    put_number(p, y);
}

/* anchor: start, middle or end. */
static void put_label(plot *p, double x, double y, const char *anchor, const char *more, const char *text) {
    if (!text || !*text) return;
    put_plot_label(p, "<text");
    put_attribute(p, "x", x);
    put_attribute(p, "y", y);
    put_plot_label(p, " text-anchor=\"");
    put_plot_label(p, anchor);
    put_plot_label(p, "\"");
    put_plot_label(p, more);
    put_plot_label(p, ">");
    put_escaped(p, text);
    put_plot_label(p, "</text>\n");
}

static void put_plot_line(plot *p, double x0, double y0, double x1, double y1, const char *more) {
    put_plot_label(p, "<path d=\"");
    put_pair(p, "M", x0, y0);
    put_pair(p, "L", x1, y1);
    put_plot_label(p, "\" stroke=\"currentColor\"");
    put_plot_label(p, more);
    put_plot_label(p, "/>\n");
}

/* -------------------------------------------------------------------- frame -- */

static void fit_axes(plot *p) {
    const bool columns = p->o->kind == FROE_PLOT_COLUMNS;
    p->x = draw_axis_new(p->o->log_x);
    p->y = draw_axis_new(p->o->log_y);
    for (size_t s = 0; s < p->count; s++)
        for (size_t i = 0; i < p->series[s].count; i++) {
            const double x = p->series[s].x[i], y = p->series[s].y[i];
            if (!draw_axis_shows(&p->x, x) || !draw_axis_shows(&p->y, y)) continue;
            draw_axis_add(&p->x, x);
            draw_axis_add(&p->y, y);
        }
    const bool any = p->x.lo <= p->x.hi;
    if (any && columns && !p->o->log_x) p->x.lo -= p->o->column / 2, p->x.hi += p->o->column / 2;
    if (!columns || p->o->log_x || !any) draw_axis_round(&p->x);
    draw_axis_round(&p->y);
    p->x.from = p->o->y_label ? 64 : 46, p->x.to = p->o->width - 14;
    p->y.from = p->o->height - (p->o->x_label ? 40 : 24), p->y.to = p->o->title ? 30 : 10;
}

static void put_frame(plot *p) {
    double ticks[DRAW_TICKS];
    char label[24];
    for (size_t i = 0, n = draw_axis_ticks(&p->x, ticks); i < n; i++) {
        const double x = draw_axis_at(&p->x, ticks[i]);
        draw_axis_label(ticks[i], label);
        put_plot_line(p, x, p->y.from, x, p->y.to, " stroke-opacity=\".12\"");
        put_label(p, x, p->y.from + 15, "middle", "", label);
    }
    for (size_t i = 0, n = draw_axis_ticks(&p->y, ticks); i < n; i++) {
        const double y = draw_axis_at(&p->y, ticks[i]);
        draw_axis_label(ticks[i], label);
        put_plot_line(p, p->x.from, y, p->x.to, y, " stroke-opacity=\".12\"");
        put_label(p, p->x.from - 6, y + 4, "end", "", label);
    }
    put_plot_line(p, p->x.from, p->y.from, p->x.to, p->y.from, " stroke-opacity=\".6\"");
    put_plot_line(p, p->x.from, p->y.from, p->x.from, p->y.to, " stroke-opacity=\".6\"");
    put_label(p, p->x.from, 18, "start", " font-weight=\"600\" font-size=\"13\"", p->o->title);
    put_label(p, (p->x.from + p->x.to) / 2, p->o->height - 8, "middle", "", p->o->x_label);
    if (!p->o->y_label) return;
    put_plot_label(p, "<g transform=\"translate(14 ");
    put_number(p, (p->y.from + p->y.to) / 2);
    put_plot_label(p, ") rotate(-90)\">");
    put_label(p, 0, 0, "middle", "", p->o->y_label);
    put_plot_label(p, "</g>\n");
}

/* ------------------------------------------------------------------- series -- */

static void put_plot_style(plot *p, size_t series, bool line) {
    const char *colour = colours[series % COLOURS];
    put_plot_label(p, line ? "\" fill=\"none\" stroke-width=\"1.6\" stroke=\"" : "\" stroke=\"none\" fill=\"");
    put_plot_label(p, colour);
    if (line && series >= COLOURS) put_plot_label(p, "\" stroke-dasharray=\"5 3");
    put_plot_label(p, "\"/>\n");
}

/* A small shape around a point, closed. */
static void put_marker(plot *p, size_t series, double x, double y) {
    static const signed char shapes[MARKERS][9] = {{4, -3, -3, 3, -3, 3, 3, -3, 3},  /* square */
                                                   {4, 0, -4, 4, 0, 0, 4, -4, 0},    /* diamond */
                                                   {3, 0, -4, 4, 3, -4, 3, 0, 0},    /* triangle up */
                                                   {3, 0, 4, 4, -3, -4, -3, 0, 0},   /* triangle down */
                                                   {4, -2, -4, 2, -4, 2, 4, -2, 4}}; /* bar */
    const signed char *shape = shapes[series % MARKERS];
    for (int i = 0; i < shape[0]; i++) put_pair(p, i ? "L" : "M", x + shape[2 * i + 1], y + shape[2 * i + 2]);
    put_plot_label(p, "Z");
}

static bool place_on_plot(const plot *p, const froe_plot_series *s, size_t i, double *x, double *y) {
    if (!draw_axis_shows(&p->x, s->x[i]) || !draw_axis_shows(&p->y, s->y[i])) return false;
    *x = draw_axis_at(&p->x, s->x[i]);
    *y = draw_axis_at(&p->y, s->y[i]);
    return true;
}

static void put_lines(plot *p, size_t series) {
    const froe_plot_series *s = p->series + series;
    double x, y;
    bool joined = false;
    put_plot_label(p, "<path d=\"");
    for (size_t i = 0; i < s->count; i++) {
        const bool shown = place_on_plot(p, s, i, &x, &y);
        if (shown) put_pair(p, joined ? "L" : "M", x, y);
        joined = shown;
    }
    put_plot_style(p, series, true);
}

static void put_markers(plot *p, size_t series) {
    const froe_plot_series *s = p->series + series;
    double x, y;
    put_plot_label(p, "<path d=\"");
    for (size_t i = 0; i < s->count; i++)
        if (place_on_plot(p, s, i, &x, &y)) put_marker(p, series, x, y);
    put_plot_style(p, series, false);
}

static void put_columns(plot *p, size_t series) {
    const froe_plot_series *s = p->series + series;
    const double each = p->o->column / (double)p->count;
    double x, y;
    put_plot_label(p, "<path d=\"");
    for (size_t i = 0; i < s->count; i++) {
        if (!place_on_plot(p, s, i, &x, &y)) continue;
        const double from = s->x[i] - p->o->column / 2 + each * (double)series;
        const double left = draw_axis_at(&p->x, from), right = draw_axis_at(&p->x, from + each);
        put_pair(p, "M", left, p->y.from);
        put_pair(p, "L", left, y);
        put_pair(p, "L", right, y);
        put_pair(p, "L", right, p->y.from);
        put_plot_label(p, "Z");
    }
    put_plot_style(p, series, false);
}

/* ---------------------------------------------------------------------- key -- */

/* Width of an entry; letters count by their first bytes. */
static double entry_width(const char *name) {
    double width = 26;
    for (; *name; name++) width += ((unsigned char)*name & 0xC0) != 0x80 ? LETTER : 0;
    return width;
}

static bool has_key(const plot *p) {
    bool named = p->count > 1;
    for (size_t s = 0; s < p->count && named; s++)
        named = !p->series[s].count || (p->series[s].name && *p->series[s].name);
    return named;
}

/* Lays the key out below the figure; draws it if asked to. Returns its height. */
static double key(plot *p, bool draw) {
    if (!has_key(p)) return 0;
    double x = p->x.from, y = p->o->height + 12;
    for (size_t s = 0; s < p->count; s++) {
        if (!p->series[s].count) continue; /* it only keeps its place among the colours */
        const double width = entry_width(p->series[s].name);
        if (x + width > p->o->width && x > p->x.from) x = p->x.from, y += ROW;
        if (draw) {
            put_plot_label(p, "<path d=\"");
            put_marker(p, s, x + 4, y - 4);
            put_plot_style(p, s, false);
            put_label(p, x + 12, y, "start", "", p->series[s].name);
        }
        x += width;
    }
    return y + 8 - p->o->height;
}

static void put_figure(plot *p) {
    fit_axes(p);
    const double height = p->o->height + key(p, false);
    put_plot_label(p, "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\"");
    put_attribute(p, "width", p->o->width);
    put_attribute(p, "height", height);
    put_plot_label(p, " viewBox=\"0 0 ");
    put_pair(p, "", p->o->width, height);
    put_plot_label(p, "\" font-family=\"system-ui,sans-serif\" font-size=\"11\" fill=\"currentColor\" aria-label=\"");
    put_escaped(p, p->o->title ? p->o->title : "");
    put_plot_label(p, "\">\n");
    put_frame(p);
    size_t points = 0;
    for (size_t s = 0; s < p->count; s++) {
        points += p->series[s].count;
        if (p->o->kind == FROE_PLOT_LINES) put_lines(p, s);
        p->o->kind == FROE_PLOT_COLUMNS ? put_columns(p, s) : put_markers(p, s);
    }
    if (!points) put_label(p, (p->x.from + p->x.to) / 2, (p->y.from + p->y.to) / 2, "middle", "", "nothing to show");
    key(p, true);
    put_plot_label(p, "</svg>\n");
}

/* ------------------------------------------------------------------- public -- */

froe_plot_options froe_plot_defaults(void) {
    return (froe_plot_options){.size = sizeof(froe_plot_options), .column = 0.8, .width = 460, .height = 300};
}

static froe_status check_plot(const froe_plot_options *o, froe_diagnostic *diag) {
    if (o->size != sizeof *o)
        return support_fail(diag, FROE_E_OPTIONS, "options do not come from froe_plot_defaults()");
    if ((unsigned)o->kind > FROE_PLOT_POINTS)
        return support_fail(diag, FROE_E_OPTIONS, "there is no kind of figure %d", (int)o->kind);
    if (!(o->width >= 60 && o->width <= 4000))
        return support_fail(diag, FROE_E_OPTIONS, "width %g is not in 60 .. 4000", o->width);
    if (!(o->height >= 60 && o->height <= 4000))
        return support_fail(diag, FROE_E_OPTIONS, "height %g is not in 60 .. 4000", o->height);
    if (!(o->column > 0 && o->column <= 1e9))
        return support_fail(diag, FROE_E_OPTIONS, "column %g is not in (0, 1e9]", o->column);
    return FROE_OK;
}

froe_status froe_plot_write(const froe_plot_series *series, size_t count, froe_draw_write_fn *fn, void *user,
                            const froe_plot_options *options, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    const froe_plot_options o = options ? *options : froe_plot_defaults();
    froe_status status = check_plot(&o, diag);
    if (status) return status;
    if (!fn || (!series && count)) return support_fail(diag, FROE_E_ARG, "series and fn must not be NULL");
    plot p = {.o = &o, .series = series, .count = count, .alloc = support_allocator(o.alloc), .ok = true};
    put_figure(&p);
    if (!p.ok)
        status = support_fail_memory(diag);
    else if (!support_callback(fn(user, p.text.data, p.text.count)))
        status = support_fail(diag, FROE_E_IO, "the receiver of the figure refused it");
    array_free(&p.alloc, &p.text);
    return status;
}
