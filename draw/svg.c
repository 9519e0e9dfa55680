/* svg.c: the picture as compact SVG: relative coordinates on a grid, shared separators, one path per run of a style.
 *
 * Coordinates are whole numbers of steps of the grid, scaled to the page by a group around everything: no decimal
 * points. Differences are taken between rounded points, so that errors do not add up. All rings turn the same way and
 * fill by the nonzero rule: faces seen from behind and from the front may share a path. */
#include "render.h"
#include "support/xml.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A ring of the path in the making. Paths are unions: their rings may come in any order. */
typedef struct svg_ring {
    const double *points;
    size_t count;
    double x, y; /* of its first point */
} svg_ring;

typedef struct svg_writer {
    draw_render *render;
    draw_output *output;
    DRAW_ARRAY(svg_ring) rings;
    int64_t at[2]; /* where the last path command ended, on the grid */
    char command;  /* the last one written; numbers may follow without repeating it */
    bool number;   /* the last thing written is a number */
    bool ok;
    size_t frame;
    uint32_t layer; /* that is open; FROE_NONE */
} svg_writer;

static void put_svg(svg_writer *w, const char *text, size_t length) {
    w->ok = w->ok && draw_reserve(&w->output->alloc, &w->output->bytes, length);
    if (!w->ok) return;
    memcpy(w->output->bytes.data + w->output->bytes.count, text, length);
    w->output->bytes.count += length;
}

static void put_text(svg_writer *w, const char *text) {
    put_svg(w, text, strlen(text));
}

static void put_escaped(svg_writer *w, const char *text) {
    char out[8];
    for (size_t n; (n = support_xml_escape(&text, out));) put_svg(w, out, n);
}

static void put_number(svg_writer *w, int64_t steps) {
    char text[32];
    const int length = snprintf(text, sizeof text, "%s%lld", w->number && steps >= 0 ? " " : "", (long long)steps);
    put_svg(w, text, (size_t)length);
    w->number = true;
}

static void put_command(svg_writer *w, char command) {
    if (w->command != command) {
        put_svg(w, &command, 1);
        w->number = false;
    }
    w->command = command;
}

static int64_t step_of(const svg_writer *w, double x) {
    return draw_step(w->render, x);
}

static void line_to(svg_writer *w, int64_t x, int64_t y) {
    const int64_t dx = x - w->at[0], dy = y - w->at[1];
    if (!dx && !dy) return;
    put_command(w, dy == 0 ? 'h' : dx == 0 ? 'v' : 'l');
    if (dx) put_number(w, dx);
    if (dy) put_number(w, dy);
    w->at[0] = x, w->at[1] = y;
}

/* One ring or polyline, from point `start` on. The first move of a path is absolute; lines may follow a move without
 * saying so. */
static void put_points(svg_writer *w, const double *points, size_t count, size_t start, bool closed) {
    const int64_t x = step_of(w, points[2 * start]), y = step_of(w, points[2 * start + 1]);
    const bool first = w->command == 0;
    w->command = 0;
    put_command(w, 'm');
    put_number(w, first ? x : x - w->at[0]);
    put_number(w, first ? y : y - w->at[1]);
    w->command = 'l';
    w->at[0] = x, w->at[1] = y;
    for (size_t i = 1; i < count; i++) {
        const double *p = points + 2 * ((start + i) % count);
        line_to(w, step_of(w, p[0]), step_of(w, p[1]));
    }
    if (!closed) return;
    put_text(w, "z");
    w->command = 'z';
    w->number = false;
    w->at[0] = x, w->at[1] = y; /* closing leads back */
}

/* ------------------------------------------------------------------------ parts -- */

static void begin_path(svg_writer *w) {
    w->command = 0;
    w->number = false;
    w->render->report.paths++;
}

static void put_colour(svg_writer *w, uint32_t colour) {
    char text[16];
    const uint32_t r = colour >> 16 & 255, g = colour >> 8 & 255, b = colour & 255;
    if (r % 17 == 0 && g % 17 == 0 && b % 17 == 0)
        snprintf(text, sizeof text, "#%x%x%x", r / 17, g / 17, b / 17);
    else
        snprintf(text, sizeof text, "#%02x%02x%02x", r, g, b);
    put_text(w, text);
}

static void put_style(svg_writer *w, draw_style style) {
    char text[48];
    put_text(w, "<path fill=\"");
    put_colour(w, style);
    if (style >> 24 < 255) {
        snprintf(text, sizeof text, "\" fill-opacity=\"0.%02u", (style >> 24) * 100 / 255);
        put_text(w, text);
    }
}

static void put_ids(svg_writer *w, uint32_t patch) {
    const froe_patch p = froe_surface_patch(w->render->surface, patch);
    char text[64];
    if (w->render->options->ids == FROE_IDS_NONE) return;
    if (w->render->options->ids == FROE_IDS_FACE) {
        snprintf(text, sizeof text, "\" data-object=\"%u", p.objects[0]);
        put_text(w, text);
    }
    put_text(w, "\" data-group=\"");
    if (p.group != FROE_NONE) put_escaped(w, froe_scene_group(w->render->scene, p.group).name);
}

static void take_shape(svg_writer *w, const froe_shape *s) {
    for (size_t i = 0; i < s->ring_count; i++) {
        size_t count;
        const double *ring = froe_picture_ring(w->render->picture, s->first_ring + i, &count);
        w->ok = w->ok && draw_push(&w->output->alloc, &w->rings, (svg_ring){ring, count, ring[0], ring[1]});
    }
}

static int along_strips(const void *a, const void *b) {
    const svg_ring *p = a, *q = b;
    if (p->x != q->x) return p->x < q->x ? -1 : 1;
    if (p->y != q->y) return p->y < q->y ? -1 : 1;
    return p->points < q->points ? -1 : p->points > q->points;
}

/* Down one strip of the page and up the next, so that moves are short. */
static void sort_rings(svg_writer *w) {
    const double wide = w->render->options->camera.width / ceil(sqrt(0.5 * (double)w->rings.count));
    for (size_t i = 0; i < w->rings.count; i++) {
        svg_ring *r = w->rings.data + i;
        r->x = floor(r->x / wide);
        if (fmod(r->x, 2) != 0) r->y = -r->y;
    }
    if (w->rings.count) qsort(w->rings.data, w->rings.count, sizeof *w->rings.data, along_strips);
}

/* The corner of a ring that is nearest to where the last one ended. */
static size_t nearest_corner(const svg_writer *w, const svg_ring *r) {
    int64_t least = INT64_MAX;
    size_t found = 0;
    for (size_t i = 0; i < r->count; i++) {
        const int64_t far =
            llabs(step_of(w, r->points[2 * i]) - w->at[0]) + llabs(step_of(w, r->points[2 * i + 1]) - w->at[1]);
        if (far < least) least = far, found = i;
    }
    return found;
}

static void put_rings(svg_writer *w) {
    sort_rings(w);
    for (size_t i = 0; i < w->rings.count; i++) {
        const svg_ring *r = w->rings.data + i;
        if (draw_ring_shows(w->render, r->points, r->count))
            put_points(w, r->points, r->count, nearest_corner(w, r), true);
    }
    w->rings.count = 0;
}

/* A stroke of the fill's own colour, as wide as seams may be. */
static void put_own_stroke(svg_writer *w, draw_style style) {
    char text[48];
    if (w->render->options->seams != FROE_SEAMS_STROKE) return;
    put_text(w, "\" stroke=\"");
    put_colour(w, style);
    snprintf(text, sizeof text, "\" stroke-width=\"%.3g", w->render->grid * w->render->options->seam_width);
    put_text(w, text);
}

/* Ends the layer that is open, and begins that of a shape. */
static void put_layer(svg_writer *w, uint32_t layer) {
    if (w->layer == layer) return;
    if (w->layer != FROE_NONE) put_text(w, "</g>\n");
    if (layer != FROE_NONE) {
        put_text(w, "<g data-layer=\"");
        put_escaped(w, froe_scene_group(w->render->scene, layer).name);
        put_text(w, "\">\n");
    }
    w->layer = layer;
}

static void put_shapes(svg_writer *w, const draw_run *run) {
    const draw_render *r = w->render;
    const froe_shape first = froe_picture_shape(r->picture, run->first);
    const draw_style style = draw_style_of(r, &first);
    put_layer(w, draw_layer_of(r, &first));
    put_style(w, style);
    put_own_stroke(w, style);
    put_ids(w, first.patch);
    put_text(w, "\" d=\"");
    begin_path(w);
    for (size_t i = run->first; i < run->end; i++) {
        const froe_shape shape = froe_picture_shape(r->picture, i);
        take_shape(w, &shape);
    }
    put_rings(w);
    put_text(w, "\"/>\n");
}

static void put_strokes(svg_writer *w, const draw_run *run) {
    const draw_render *r = w->render;
    const froe_stroke first = froe_picture_stroke(r->picture, run->first);
    const double width = w->render->grid * draw_line_width(r->options, first.kind) * (first.hidden ? 0.6 : 1);
    char text[160];
    snprintf(text, sizeof text, "<path class=\"%s%s\" stroke-width=\"%.3g\"", froe_line_name(first.kind),
             first.hidden ? " hidden" : "", width);
    put_text(w, text);
    if (first.hidden) {
        snprintf(text, sizeof text, " stroke-dasharray=\"%.3g %.3g\"", 4 * width, 3 * width);
        put_text(w, text);
    }
    put_text(w, " d=\"");
    begin_path(w);
    for (size_t i = run->first; i < run->end; i++) {
        const froe_stroke s = froe_picture_stroke(r->picture, i);
        if (draw_stroke_shows(r, &s)) put_points(w, s.points, s.count, 0, s.closed);
    }
    put_text(w, "\"/>\n");
}

/* Fills that are painted twice are one group, which ends before the lines. */
static void put_twice(svg_writer *w, bool begin) {
    char text[64];
    if (w->render->options->seams != FROE_SEAMS_TWICE) return;
    snprintf(text, sizeof text, begin ? "<g id=\"fills%zu\">\n" : "</g>\n<use href=\"#fills%zu\"/>\n", w->frame);
    put_text(w, text);
}

static void put_runs(svg_writer *w) {
    draw_cursor at = {0, 0};
    draw_run run;
    bool lines = false;
    w->layer = FROE_NONE;
    put_twice(w, true);
    while (w->ok && draw_next_run(w->render, &at, &run)) {
        if (run.lines && !lines) {
            put_layer(w, FROE_NONE);
            if (run.last) put_twice(w, false);
            put_text(w, "<g fill=\"none\" stroke=\"#1b2630\" stroke-linejoin=\"round\">\n");
        }
        if (!run.lines && lines) put_text(w, "</g>\n");
        lines = run.lines;
        if (lines)
            put_strokes(w, &run);
        else
            put_shapes(w, &run);
    }
    put_layer(w, FROE_NONE);
    if (lines)
        put_text(w, "</g>\n");
    else
        put_twice(w, false);
}

static void put_head(svg_writer *w) {
    const froe_render_options *o = w->render->options;
    const char *unit = o->millimetres ? "mm" : "";
    char text[256];
    snprintf(
        text, sizeof text,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.10g%s\" height=\"%.10g%s\" viewBox=\"0 0 %.10g %.10g\" "
        "role=\"img\">\n",
        o->camera.width, unit, o->camera.height, unit, o->camera.width, o->camera.height);
    put_text(w, text);
    const char *const parts[2][2] = {{"title", o->title}, {"desc", o->description}};
    for (int i = 0; i < 2; i++) {
        if (!parts[i][1]) continue;
        put_text(w, "<"), put_text(w, parts[i][0]), put_text(w, ">");
        put_escaped(w, parts[i][1]);
        put_text(w, "</"), put_text(w, parts[i][0]), put_text(w, ">\n");
    }
    if (o->background == FROE_DRAW_CLEAR) return;
    put_text(w, "<rect width=\"100%\" height=\"100%\" fill=\"");
    put_colour(w, o->background);
    put_text(w, "\"/>\n");
}

/* Everything else is in steps of the grid. */
static void put_scale(svg_writer *w) {
    char text[64];
    if (w->render->grid == 1) return;
    snprintf(text, sizeof text, "<g transform=\"scale(%.*f)\">\n", w->render->options->decimals, 1 / w->render->grid);
    put_text(w, text);
}

/* Shown for the i-th of `count` equal times, again and again; the first also where nothing moves. */
static void put_times(svg_writer *w, const draw_frame *f) {
    const double from = (double)f->i / (double)f->count, to = (double)(f->i + 1) / (double)f->count;
    char text[256];
    snprintf(
        text, sizeof text,
        "<g%s>\n<animate attributeName=\"display\" calcMode=\"discrete\" dur=\"%.6gs\" repeatCount=\"indefinite\" ",
        f->i ? " display=\"none\"" : "", f->seconds);
    put_text(w, text);
    if (f->i == 0)
        snprintf(text, sizeof text, "values=\"inline;none\" keyTimes=\"0;%.6g\"/>\n", to);
    else if (f->i + 1 < f->count)
        snprintf(text, sizeof text, "values=\"none;inline;none\" keyTimes=\"0;%.6g;%.6g\"/>\n", from, to);
    else
        snprintf(text, sizeof text, "values=\"none;inline\" keyTimes=\"0;%.6g\"/>\n", from);
    put_text(w, text);
}

static svg_writer writer_of(draw_render *render, draw_output *output) {
    return (svg_writer){.render = render, .output = output, .ok = true};
}

bool draw_svg_begin(draw_render *render, draw_output *output) {
    svg_writer w = writer_of(render, output);
    put_head(&w);
    put_scale(&w);
    return w.ok;
}

bool draw_svg_picture(draw_render *render, draw_output *output, const draw_frame *frame) {
    svg_writer w = writer_of(render, output);
    w.frame = frame->i;
    if (frame->count > 1) put_times(&w, frame);
    put_runs(&w);
    if (frame->count > 1) put_text(&w, "</g>\n");
    draw_release(&output->alloc, &w.rings);
    return w.ok;
}

bool draw_svg_end(draw_render *render, draw_output *output) {
    svg_writer w = writer_of(render, output);
    put_text(&w, render->grid == 1 ? "</svg>\n" : "</g>\n</svg>\n");
    return w.ok;
}
