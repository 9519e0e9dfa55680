/* plot.c: figures of numbers as SVG.
 *
 *      title                          The frame takes what title and labels leave of the width and height asked for;
 *      |        __o                   the key comes below, in as many rows as it needs.
 *    y |   __o--                      Coordinates are whole numbers of tenths of a pixel, written as such.
 *      |o--
 *      +-----------
 *            x        o a  + b
 */
#include "report/plot.h"
#include "report/axis.h"
#include "support/escape.h"
#include <math.h>
#include <string.h>

enum { COLOURS = 8, MARKERS = 5, LETTER = 7, ROW = 18 };
/* After M. Okabe and K. Ito (Color Universal Design, 2008), whose colours differ for all kinds of sight; yellow and
 * black give way to violet and brown, so that all are seen on white and on dark pages. */
static const char *const colours[COLOURS] = {"#0a7ac2", "#d55e00", "#009e73", "#cc79a7",
                                             "#e69f00", "#56b4e9", "#8a63d2", "#8c6d46"};

typedef struct plot {
    FILE *out;
    const plot_options *o;
    const plot_series *series;
    size_t count;
    plot_axis x, y;
} plot;

/* ------------------------------------------------------------------ writing -- */

static void put_markup(plot *p, const char *text) {
    fputs(text, p->out);
}

static void put_escaped(plot *p, const char *text) {
    char out[8];
    for (size_t n; (n = support_xml_escape(&text, out));) fwrite(out, 1, n, p->out);
}

/* "12.3" in every locale: a place or a size on the page, which is not negative. */
static void put_number(plot *p, double value) {
    const long long tenths = llround(value * 10);
    fprintf(p->out, "%lld", tenths / 10);
    if (tenths % 10) fprintf(p->out, ".%lld", tenths % 10);
}

static void put_attribute(plot *p, const char *name, double value) {
    fprintf(p->out, " %s=\"", name);
    put_number(p, value);
    put_markup(p, "\"");
}

static void put_pair(plot *p, const char *command, double x, double y) {
    put_markup(p, command);
    put_number(p, x);
    put_markup(p, " ");
    put_number(p, y);
}

/* anchor: start, middle or end. */
static void put_label(plot *p, double x, double y, const char *anchor, const char *more, const char *text) {
    if (!text || !*text) return;
    put_markup(p, "<text");
    put_attribute(p, "x", x);
    put_attribute(p, "y", y);
    put_markup(p, " text-anchor=\"");
    put_markup(p, anchor);
    put_markup(p, "\"");
    put_markup(p, more);
    put_markup(p, ">");
    put_escaped(p, text);
    put_markup(p, "</text>\n");
}

static void put_line(plot *p, double x0, double y0, double x1, double y1, const char *more) {
    put_markup(p, "<path d=\"");
    put_pair(p, "M", x0, y0);
    put_pair(p, "L", x1, y1);
    put_markup(p, "\" stroke=\"currentColor\"");
    put_markup(p, more);
    put_markup(p, "/>\n");
}

/* -------------------------------------------------------------------- frame -- */

/* Is there a point that can be shown? */
static bool fit_axes(plot *p) {
    const bool columns = p->o->kind == PLOT_COLUMNS;
    p->x = plot_axis_new(p->o->log_x);
    p->y = plot_axis_new(p->o->log_y);
    for (size_t s = 0; s < p->count; s++)
        for (size_t i = 0; i < p->series[s].count; i++) {
            const double x = p->series[s].x[i], y = p->series[s].y[i];
            if (!plot_axis_shows(&p->x, x) || !plot_axis_shows(&p->y, y)) continue;
            plot_axis_add(&p->x, x);
            plot_axis_add(&p->y, y);
        }
    const bool any = p->x.lo <= p->x.hi;
    if (any && columns && !p->o->log_x) p->x.lo -= p->o->column / 2, p->x.hi += p->o->column / 2;
    if (!columns || p->o->log_x || !any) plot_axis_round(&p->x);
    plot_axis_round(&p->y);
    p->x.from = p->o->y_label ? 64 : 46, p->x.to = p->o->width - 14;
    p->y.from = p->o->height - (p->o->x_label ? 40 : 24), p->y.to = p->o->title ? 30 : 10;
    return any;
}

static void put_frame(plot *p) {
    double ticks[PLOT_TICKS];
    char label[24];
    for (size_t i = 0, n = plot_axis_ticks(&p->x, ticks); i < n; i++) {
        const double x = plot_axis_at(&p->x, ticks[i]);
        plot_axis_label(ticks[i], label);
        put_line(p, x, p->y.from, x, p->y.to, " stroke-opacity=\".12\"");
        put_label(p, x, p->y.from + 15, "middle", "", label);
    }
    for (size_t i = 0, n = plot_axis_ticks(&p->y, ticks); i < n; i++) {
        const double y = plot_axis_at(&p->y, ticks[i]);
        plot_axis_label(ticks[i], label);
        put_line(p, p->x.from, y, p->x.to, y, " stroke-opacity=\".12\"");
        put_label(p, p->x.from - 6, y + 4, "end", "", label);
    }
    put_line(p, p->x.from, p->y.from, p->x.to, p->y.from, " stroke-opacity=\".6\"");
    put_line(p, p->x.from, p->y.from, p->x.from, p->y.to, " stroke-opacity=\".6\"");
    put_label(p, p->x.from, 18, "start", " font-weight=\"600\" font-size=\"13\"", p->o->title);
    put_label(p, (p->x.from + p->x.to) / 2, p->o->height - 8, "middle", "", p->o->x_label);
    if (!p->o->y_label) return;
    put_markup(p, "<g transform=\"translate(14 ");
    put_number(p, (p->y.from + p->y.to) / 2);
    put_markup(p, ") rotate(-90)\">");
    put_label(p, 0, 0, "middle", "", p->o->y_label);
    put_markup(p, "</g>\n");
}

/* ------------------------------------------------------------------- series -- */

/* From the ninth series on lines are dashed, and markers hollow. */
static void put_series_style(plot *p, size_t series, bool line) {
    const bool hollow = !line && series >= COLOURS && p->o->kind != PLOT_COLUMNS;
    put_markup(p, line     ? "\" fill=\"none\" stroke-width=\"1.8\" stroke=\""
                  : hollow ? "\" fill=\"none\" stroke-width=\"1.5\" stroke=\""
                           : "\" stroke=\"none\" fill=\"");
    put_markup(p, colours[series % COLOURS]);
    if (line && series >= COLOURS) put_markup(p, "\" stroke-dasharray=\"5 3");
    put_markup(p, "\"/>\n");
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
    put_markup(p, "Z");
}

static bool place_on_plot(const plot *p, const plot_series *s, size_t i, double *x, double *y) {
    if (!plot_axis_shows(&p->x, s->x[i]) || !plot_axis_shows(&p->y, s->y[i])) return false;
    *x = plot_axis_at(&p->x, s->x[i]);
    *y = plot_axis_at(&p->y, s->y[i]);
    return true;
}

static void put_series(plot *p, size_t series) {
    const plot_series *s = p->series + series;
    const double each = p->o->column / (double)p->count;
    double x, y;
    if (p->o->kind == PLOT_LINES) {
        bool joined = false;
        put_markup(p, "<path d=\"");
        for (size_t i = 0; i < s->count; i++) {
            const bool shown = place_on_plot(p, s, i, &x, &y);
            if (shown) put_pair(p, joined ? "L" : "M", x, y);
            joined = shown;
        }
        put_series_style(p, series, true);
    }
    put_markup(p, "<path d=\"");
    for (size_t i = 0; i < s->count; i++) {
        if (!place_on_plot(p, s, i, &x, &y)) continue;
        if (p->o->kind != PLOT_COLUMNS) {
            put_marker(p, series, x, y);
            continue;
        }
        const double from = s->x[i] - p->o->column / 2 + each * (double)series;
        const double left = plot_axis_at(&p->x, from), right = plot_axis_at(&p->x, from + each);
        put_pair(p, "M", left, p->y.from);
        put_pair(p, "L", left, y);
        put_pair(p, "L", right, y);
        put_pair(p, "L", right, p->y.from);
        put_markup(p, "Z");
    }
    put_series_style(p, series, false);
}

/* ---------------------------------------------------------------------- key -- */

/* Lays the key out below the figure; draws it if asked to. Returns its height. A figure of one series, or with a series
 * that has points but no name, has no key. */
static double key(plot *p, bool draw) {
    bool named = p->count > 1;
    for (size_t s = 0; s < p->count && named; s++)
        named = !p->series[s].count || (p->series[s].name && *p->series[s].name);
    if (!named) return 0;
    double x = p->x.from, y = p->o->height + 12;
    for (size_t s = 0; s < p->count; s++) {
        if (!p->series[s].count) continue; /* it only keeps its place among the colours */
        const double sample = p->o->kind == PLOT_LINES ? 24 : 8;
        double width = sample + 18;
        for (const char *c = p->series[s].name; *c; c++) /* letters count by their first bytes */
            width += ((unsigned char)*c & 0xC0) != 0x80 ? LETTER : 0;
        if (x + width > p->o->width && x > p->x.from) x = p->x.from, y += ROW;
        if (draw) {
            if (p->o->kind == PLOT_LINES) {
                put_markup(p, "<path d=\"");
                put_pair(p, "M", x, y - 4);
                put_pair(p, "L", x + sample, y - 4);
                put_series_style(p, s, true);
            }
            put_markup(p, "<path d=\"");
            put_marker(p, s, x + sample / 2, y - 4);
            put_series_style(p, s, false);
            put_label(p, x + sample + 4, y, "start", "", p->series[s].name);
        }
        x += width;
    }
    return y + 8 - p->o->height;
}

plot_options plot_defaults(void) {
    return (plot_options){.column = 0.8, .width = 460, .height = 300};
}

void plot_put(FILE *out, const plot_series *series, size_t count, const plot_options *options) {
    plot figure = {.out = out, .o = options, .series = series, .count = count}, *p = &figure;
    const bool any = fit_axes(p);
    const double height = p->o->height + key(p, false);
    put_markup(p, "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\"");
    put_attribute(p, "width", p->o->width);
    put_attribute(p, "height", height);
    put_markup(p, " viewBox=\"0 0 ");
    put_pair(p, "", p->o->width, height);
    put_markup(p, "\" font-family=\"system-ui,sans-serif\" font-size=\"11\" fill=\"currentColor\" aria-label=\"");
    put_escaped(p, p->o->title ? p->o->title : "");
    put_markup(p, "\">\n");
    put_frame(p);
    for (size_t s = 0; s < p->count; s++) put_series(p, s);
    if (!any) put_label(p, (p->x.from + p->x.to) / 2, (p->y.from + p->y.to) / 2, "middle", "", "nothing to show");
    key(p, true);
    put_markup(p, "</svg>\n");
}
