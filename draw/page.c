/* page.c: title, legend, scale bar. All lengths are multiples of one unit, so that a page
 * of any size keeps its proportions. */
#include "page.h"
#include "lettering.h"
#include "palette.h"
#include "support/fail.h"
#include "support/nice.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { LINE = 240 };
#define ROW 1.75 /* of the legend, in text sizes */

static bool has_title(const draw_page *page) {
    return page->options->title && *page->options->title;
}

void draw_page_plan(draw_page *page, double aspect, double text_across, double text_down) {
    const froe_draw_options *o = page->options;
    page->width = o->width;
    page->unit = fmin(fmax(o->width / 960, 0.4), 4);
    page->margin = o->margin < 0 ? o->width / 32 : o->margin;
    page->text = 14 * page->unit;
    page->left = page->margin;
    page->top = page->margin + (has_title(page) ? 3.2 * page->text : 0);
    double below = o->legend ? fmax(0.6 * page->margin, ROW * page->text) + 2.2 * ROW * page->text : page->margin;
    page->inner_width = fmax(page->width - 2 * page->margin, 1);
    page->height = o->height;
    if (page->height == 0) {
        double picture = aspect * (page->inner_width - text_across * page->text) + text_down * page->text;
        double wanted = page->top + below + picture;
        page->height = ceil(fmin(fmax(wanted, page->width / 4), 2 * page->width));
    }
    page->inner_height = fmax(page->height - page->top - below, 1);
}

uint32_t draw_cell_color(const draw_page *page, int tone) {
    const uint32_t paper = page->options->background;
    return draw_mix(draw_tone(tone), paper == FROE_DRAW_CLEAR ? DRAW_PAPER : paper, page->faint);
}

void draw_ellipse(cairo_t *cr, draw_point c, draw_point r) {
    const double share = 0.5522847498307936; /* 4/3 (sqrt 2 - 1): four cubics, 0.03 % off a circle */
    const double kx = share * r.x, ky = share * r.y;
    cairo_move_to(cr, c.x + r.x, c.y);
    cairo_curve_to(cr, c.x + r.x, c.y + ky, c.x + kx, c.y + r.y, c.x, c.y + r.y);
    cairo_curve_to(cr, c.x - kx, c.y + r.y, c.x - r.x, c.y + ky, c.x - r.x, c.y);
    cairo_curve_to(cr, c.x - r.x, c.y - ky, c.x - kx, c.y - r.y, c.x, c.y - r.y);
    cairo_curve_to(cr, c.x + kx, c.y - r.y, c.x + r.x, c.y - ky, c.x + r.x, c.y);
    cairo_close_path(cr);
}

void draw_circle(cairo_t *cr, draw_point centre, double radius) {
    draw_ellipse(cr, centre, (draw_point){radius, radius});
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

/* What a length of the scene is called: on maps in kilometres, where the coordinates are degrees, or in their unit. */
typedef struct length_name {
    double each; /* units of the scene */
    const char *unit;
} length_name;

static length_name name_length(const draw_page *page, const draw_legend *legend, double wanted) {
    const froe_crs crs = froe_scene_crs(froe_tree_scene(page->tree));
    const double degree = 111.19492664455873 * legend->squeeze; /* km of a sphere of 6,371 km, along x */
    if (crs.kind == FROE_CRS_GEOGRAPHIC && wanted * degree >= 1) return (length_name){1 / degree, "km"};
    if (crs.kind == FROE_CRS_GEOGRAPHIC) return (length_name){0.001 / degree, "m"};
    const bool metres = strcmp(crs.unit, "metre") == 0 || strcmp(crs.unit, "meter") == 0;
    if (metres) return wanted >= 1000 ? (length_name){1000, "km"} : (length_name){1, "m"};
    return (length_name){1, *crs.unit ? crs.unit : "units"};
}

/* Returns the left end of what it drew. */
static double scale_bar(const draw_page *page, cairo_t *cr, const draw_legend *legend, double right, double y) {
    const double wanted = legend->length * (0.16 * page->inner_width / legend->unit);
    if (!(legend->unit > 0) || !(wanted > 0) || !(wanted < 1e308)) return right;
    const length_name name = name_length(page, legend, wanted);
    char number[44], label[80];
    const double length = support_nice_below(wanted / name.each);
    const double across = length * name.each / legend->length * legend->unit;
    if (!(across >= 2 && across < page->inner_width)) return right;
    draw_number(number, length);
    const bool one = length == 1 && strcmp(name.unit, "units") == 0;
    snprintf(label, sizeof label, "%s %.32s", number, one ? "unit" : name.unit);
    const double left = right - across, tick = 0.35 * page->text;
    draw_set_color(cr, DRAW_INK, 1);
    cairo_set_line_width(cr, 1.2 * page->unit);
    cairo_set_line_cap(cr, CAIRO_LINE_CAP_BUTT);
    cairo_set_line_join(cr, CAIRO_LINE_JOIN_MITER);
    cairo_move_to(cr, left, y - tick);
    cairo_line_to(cr, left, y);
    cairo_line_to(cr, right, y);
    cairo_line_to(cr, right, y - tick);
    cairo_stroke(cr);
    draw_set_color(cr, DRAW_SOFT, 1);
    draw_text(cr, label, left - 0.6 * page->text, y, page->text, 1);
    return left - 0.6 * page->text - draw_text_length(cr, label, page->text);
}

/* Returns the right end of what it drew. */
static double depth_scale(const draw_page *page, cairo_t *cr, const draw_legend *legend, double y) {
    char lo[64], hi[48];
    const double span = legend->hi_depth - legend->lo_depth, high = 0.75 * page->text, gap = 0.5 * page->text;
    const int swatches = span < 1 ? 1 : span < 23 ? (int)span + 1 : 24;
    const double wide = fmin(9 * page->unit, 0.3 * page->inner_width / swatches);
    snprintf(lo, sizeof lo, "depth in the tree: %s%.0f", legend->below ? "\xE2\x89\xA4 " : "", legend->lo_depth);
    snprintf(hi, sizeof hi, "%s%.0f", legend->above ? "\xE2\x89\xA5 " : "", legend->hi_depth);
    const double left = page->left + draw_text_length(cr, lo, page->text) + gap, right = left + wide * swatches;
    draw_set_color(cr, DRAW_SOFT, 1);
    draw_text(cr, lo, page->left, y, page->text, 0);
    if (swatches > 1) draw_text(cr, hi, right + gap, y, page->text, 0);
    for (int i = 0; i < swatches; i++) {
        draw_set_color(cr, draw_cell_color(page, draw_tone_of(i, 0, swatches - 1)), 1);
        cairo_rectangle(cr, left + i * wide, y - high, wide, high);
        cairo_fill(cr);
    }
    draw_set_color(cr, DRAW_LINE, 0.5);
    cairo_set_line_width(cr, 0.5 * page->unit);
    cairo_rectangle(cr, left, y - high, wide * swatches, high);
    cairo_stroke(cr);
    return right + gap + (swatches > 1 ? draw_text_length(cr, hi, page->text) : 0);
}

static void fitted(const draw_page *page, cairo_t *cr, const char *text, double left, double y, double room) {
    double length = draw_text_length(cr, text, page->text), size = page->text;
    if (length > room) size *= room / length;
    if (size > 0) draw_text(cr, text, left, y, size, 0);
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
    const double y = page->height - fmax(0.6 * page->margin, ROW * page->text) - 0.75 * page->text;
    const double right = page->left + page->inner_width, gap = 1.5 * page->text;
    const double room = scale_bar(page, cr, legend, right, y) - gap;
    draw_set_color(cr, DRAW_SOFT, 1);
    fitted(page, cr, text, page->left, y, room - page->left);
    const double below = y + ROW * page->text;
    const double left = legend->scale_of_depths ? depth_scale(page, cr, legend, below) + gap : page->left;
    if (!legend->merged) return;
    draw_count(merged, legend->merged);
    draw_count(leaves, legend->merged_leaves);
    static const char *const notes[] = {
        "%s region%s too small or too deep to show: drawn as one each, in the mean depth of their %s cells",
        "%s part%s pulled apart, each in the mean depth of its cells, %s in all"};
    snprintf(text, sizeof text, notes[legend->parts], merged, support_plural(legend->merged), leaves);
    draw_set_color(cr, DRAW_SOFT, 1);
    fitted(page, cr, text, left, below, right - left);
}
