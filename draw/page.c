/* page.c: title, legend, scale bar. All lengths are multiples of one unit, so that a page
 * of any size keeps its proportions. */
#include "page.h"
#include "lettering.h"
#include "palette.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LINE = 240 };

static bool has_title(const draw_page *page) {
    return page->options->title && *page->options->title;
}

void draw_page_plan(draw_page *page, double aspect, double text_across, double text_down) {
    const froe_draw_options *o = page->options;
    page->width = o->width;
    page->unit = fmin(fmax(o->width / 960, 0.4), 4);
    page->margin = o->margin < 0 ? o->width / 32 : o->margin;
    page->text = 11.5 * page->unit;
    page->left = page->margin;
    page->top = page->margin + (has_title(page) ? 3.2 * page->text : 0);
    double below = o->legend ? fmax(page->margin, 1.9 * page->text) + 2.1 * page->text : page->margin;
    page->inner_width = fmax(page->width - 2 * page->margin, 1);
    page->height = o->height;
    if (page->height == 0) {
        double picture = aspect * (page->inner_width - text_across * page->text) + text_down * page->text;
        double wanted = page->top + below + picture;
        page->height = ceil(fmin(fmax(wanted, page->width / 4), 2 * page->width));
    }
    page->inner_height = fmax(page->height - page->top - below, 1);
}

void draw_set_color(cairo_t *cr, uint32_t rgb, double alpha) {
    cairo_set_source_rgba(cr, (rgb >> 16 & 255) / 255.0, (rgb >> 8 & 255) / 255.0, (rgb & 255) / 255.0, alpha);
}

void draw_circle(cairo_t *cr, draw_point c, double r) {
    const double k = 0.5522847498307936 * r; /* 4/3 (sqrt 2 - 1): four cubics, 0.03 % off a circle */
    cairo_move_to(cr, c.x + r, c.y);
    cairo_curve_to(cr, c.x + r, c.y + k, c.x + k, c.y + r, c.x, c.y + r);
    cairo_curve_to(cr, c.x - k, c.y + r, c.x - r, c.y + k, c.x - r, c.y);
    cairo_curve_to(cr, c.x - r, c.y - k, c.x - k, c.y - r, c.x, c.y - r);
    cairo_curve_to(cr, c.x + k, c.y - r, c.x + r, c.y - k, c.x + r, c.y);
    cairo_close_path(cr);
}

void draw_count(char *out, uint64_t value) {
    char digits[24];
    int count = snprintf(digits, sizeof digits, "%llu", (unsigned long long)value);
    for (int i = 0; i < count; i++) {
        if (i && (count - i) % 3 == 0) *out++ = ',';
        *out++ = digits[i];
    }
    *out = 0;
}

void draw_number(char *out, double value) {
    if (fabs(value) < 1e9 && value == floor(value)) {
        if (value < 0) *out++ = '-';
        draw_count(out, (uint64_t)fabs(value));
        return;
    }
    snprintf(out, 40, "%.4g", value);
    /* The decimal point of no locale. */
    for (char *c = out; *c; c++)
        if (!strchr("0123456789+-einfa", *c)) *c = '.';
}

void draw_page_open(const draw_page *page, cairo_t *cr) {
    if (page->options->background != FROE_DRAW_CLEAR) {
        draw_set_color(cr, page->options->background, 1);
        cairo_paint(cr);
    }
    if (!has_title(page)) return;
    double size = 1.75 * page->text, length = draw_text_length(cr, page->options->title, size);
    if (length > page->inner_width) size *= page->inner_width / length;
    draw_set_color(cr, DRAW_INK, 1);
    draw_text(cr, page->options->title, page->left, page->margin + 1.25 * page->text, size, 0);
}

/* Returns the left end of what it drew. */
static double scale_bar(const draw_page *page, cairo_t *cr, const draw_legend *legend, double right, double y) {
    double wanted = legend->length * (0.14 * page->inner_width / legend->unit);
    if (!(legend->unit > 0) || !(wanted > 0) || !(wanted < 1e308)) return right;
    /* The largest 1, 2 or 5 times a power of ten that is not above what is wanted. */
    char label[44];
    snprintf(label, sizeof label, "%.0e", wanted);
    if (strtod(label, NULL) > wanted) snprintf(label, sizeof label, "%.0e", wanted * 0.9);
    label[0] = label[0] >= '5' ? '5' : label[0] >= '2' ? '2' : '1';
    double length = strtod(label, NULL), across = length / legend->length * legend->unit;
    if (!(across >= 2 && across < page->inner_width)) return right;
    draw_number(label, length);
    double u = page->unit, left = right - across, tick = 0.3 * page->text;
    draw_set_color(cr, DRAW_INK, 1);
    cairo_set_line_width(cr, 0.9 * u);
    cairo_set_line_cap(cr, CAIRO_LINE_CAP_BUTT);
    cairo_set_line_join(cr, CAIRO_LINE_JOIN_MITER);
    cairo_move_to(cr, left, y - tick);
    cairo_line_to(cr, left, y);
    cairo_line_to(cr, right, y);
    cairo_line_to(cr, right, y - tick);
    cairo_stroke(cr);
    draw_set_color(cr, DRAW_SOFT, 1);
    draw_text(cr, label, left - 0.7 * page->text, y, page->text, 1);
    return left - 0.7 * page->text - draw_text_length(cr, label, page->text);
}

static double depth_scale(const draw_page *page, cairo_t *cr, const draw_legend *legend, double right, double y) {
    char lo[48], hi[48];
    double span = legend->hi_depth - legend->lo_depth, high = 0.7 * page->text;
    snprintf(lo, sizeof lo, "depth %s%.0f", legend->below ? "≤ " : "", legend->lo_depth);
    snprintf(hi, sizeof hi, "%s%.0f", legend->above ? "≥ " : "", legend->hi_depth);
    int swatches = span < 1 ? 1 : span < 23 ? (int)span + 1 : 24;
    double wide = 6.0 * page->unit, left = right - draw_text_length(cr, hi, page->text) - 0.6 * page->text;
    draw_set_color(cr, DRAW_SOFT, 1);
    if (swatches > 1) draw_text(cr, hi, right, y, page->text, 1);
    left = (swatches > 1 ? left : right) - wide * swatches;
    for (int i = 0; i < swatches; i++) {
        draw_set_color(cr, draw_tone(draw_tone_of(i, 0, swatches - 1)), 1);
        cairo_rectangle(cr, left + i * wide, y - high, wide, high);
        cairo_fill(cr);
    }
    draw_set_color(cr, DRAW_LINE, 0.5);
    cairo_set_line_width(cr, 0.4 * page->unit);
    cairo_rectangle(cr, left, y - high, wide * swatches, high);
    cairo_stroke(cr);
    draw_set_color(cr, DRAW_SOFT, 1);
    draw_text(cr, lo, left - 0.6 * page->text, y, page->text, 1);
    return left - 0.6 * page->text - draw_text_length(cr, lo, page->text);
}

static void fitted(const draw_page *page, cairo_t *cr, const char *text, double y, double room) {
    double length = draw_text_length(cr, text, page->text), size = page->text;
    if (length > room) size *= room / length;
    if (size > 0) draw_text(cr, text, page->left, y, size, 0);
}

void draw_page_close(const draw_page *page, cairo_t *cr, const draw_legend *legend) {
    if (!page->options->legend) return;
    char text[LINE], merged[40], leaves[40];
    static const char *const nouns[FROE_KIND_COUNT] = {"points", "segments", "polygons", "boxes", "balls", "hulls"};
    const froe_scene *scene = froe_tree_scene(page->tree);
    froe_report report = froe_tree_report(page->tree);
    const char *noun = "objects";
    char objects[40], pieces[40], cells[40], method[40];
    for (int kind = FROE_KIND_COUNT; kind-- > 0;)
        if (report.objects && froe_scene_kind_count(scene, (froe_kind)kind) == froe_scene_object_count(scene))
            noun = nouns[kind];
    draw_count(objects, report.objects);
    draw_count(pieces, report.fragments);
    draw_count(cells, report.leaves);
    snprintf(method, sizeof method, "%.32s%s", report.method ? report.method : "",
             report.method && *report.method ? " · " : "");
    snprintf(text, sizeof text, "%s%s %s in %s pieces · %s cells · height %llu", method, objects, noun, pieces, cells,
             (unsigned long long)report.height);
    double y = page->height - fmax(page->margin, 1.9 * page->text), right = page->left + page->inner_width;
    right = scale_bar(page, cr, legend, right, y);
    if (legend->scale_of_depths) right = depth_scale(page, cr, legend, right - 2.2 * page->text, y);
    draw_set_color(cr, DRAW_SOFT, 1);
    fitted(page, cr, text, y, right - page->left - 2 * page->text);
    if (!legend->merged) return;
    draw_count(merged, legend->merged);
    draw_count(leaves, legend->merged_leaves);
    static const char *const notes[] = {
        "%s region%s too small or too deep to show: drawn as one each, in the mean depth of their %s cells",
        "%s part%s pulled apart, each in the mean depth of its cells, %s in all"};
    snprintf(text, sizeof text, notes[legend->parts], merged, legend->merged == 1 ? "" : "s", leaves);
    fitted(page, cr, text, y + 1.5 * page->text, page->inner_width);
}
