/* svg.c: the picture as compact SVG: relative coordinates on a grid, shared separators, one element per path.
 *
 * Coordinates are whole numbers of steps of the grid, scaled to the page by a group around everything: no decimal
 * points. Differences are taken between rounded points, so that errors do not add up. All rings turn the same way and
 * fill by the nonzero rule: faces seen from behind and from the front may share a path. */
#include "render.h"
#include <stdlib.h>
#include <string.h>

/* A ring of the path in the making. Paths are unions: their rings may come in any order. */
typedef struct svg_ring {
    const froe_outline *outline;
    double x, y; /* of its first point */
} svg_ring;

/* A group of paths, which may be a layer. */
typedef struct svg_group {
    bool any, lines, hidden;
    froe_line kind;  /* by kind */
    uint32_t object; /* by object: the first group of its name; FROE_NONE */
} svg_group;

typedef struct svg_writer {
    vector_render *render;
    vector_output *output;
    ARRAY(svg_ring) rings;
    int64_t at[2];   /* where the last path command ended, on the grid */
    char command;    /* the last one written; numbers may follow without repeating it */
    bool number;     /* the last thing written is a number */
    svg_group group; /* that is open */
    bool twice;      /* within it or around it, fills that are painted twice are a group, which is open */
    size_t frame, layers;
} svg_writer;

static void put_text(svg_writer *w, const char *text) {
    vector_put(w->output, text, strlen(text));
}

static void put_number(svg_writer *w, int64_t steps) {
    vector_print(w->output, "%s%lld", w->number && steps >= 0 ? " " : "", (long long)steps);
    w->number = true;
}

static void put_command(svg_writer *w, char command) {
    if (w->command != command) {
        vector_put(w->output, &command, 1);
        w->number = false;
    }
    w->command = command;
}

/* One ring or polyline, from point `start` on. The first move of a path is absolute; lines may follow a move without
 * saying so. */
static void put_outline(svg_writer *w, const froe_outline *o, size_t start) {
    const bool first = w->command == 0;
    int64_t begin[2] = {0, 0};
    for (size_t i = 0; i < o->count; i++) {
        const double *p = o->points + 2 * ((start + i) % o->count);
        const int64_t x = vector_step(w->render, p[0]), y = vector_step(w->render, p[1]);
        const int64_t dx = x - w->at[0], dy = y - w->at[1];
        if (i == 0) {
            w->command = 0;
            put_command(w, 'm');
            put_number(w, first ? x : dx);
            put_number(w, first ? y : dy);
            w->command = 'l';
            begin[0] = x, begin[1] = y;
        } else if (dx || dy) {
            put_command(w, dy == 0 ? 'h' : dx == 0 ? 'v' : 'l');
            if (dx) put_number(w, dx);
            if (dy) put_number(w, dy);
        }
        w->at[0] = x, w->at[1] = y;
    }
    if (!o->closed) return;
    put_command(w, 'z');
    memcpy(w->at, begin, sizeof begin); /* closing leads back */
}

/* ------------------------------------------------------------------------ parts -- */

static void begin_path(svg_writer *w) {
    w->command = 0;
    w->number = false;
    w->render->report.paths++;
}

static void put_colour(vector_output *output, uint32_t colour) {
    const uint32_t r = colour >> 16 & 255, g = colour >> 8 & 255, b = colour & 255;
    if (r % 17 == 0 && g % 17 == 0 && b % 17 == 0)
        vector_print(output, "#%x%x%x", r / 17, g / 17, b / 17);
    else
        vector_print(output, "#%02x%02x%02x", r, g, b);
}

static int compare_along_strips(const void *a, const void *b) {
    const svg_ring *p = a, *q = b;
    if (p->x != q->x) return p->x < q->x ? -1 : 1;
    if (p->y != q->y) return p->y < q->y ? -1 : 1;
    return p->outline->points < q->outline->points ? -1 : p->outline->points > q->outline->points;
}

/* Puts rings, or points, into an order down one strip of the page and up the next, so that moves are short. */
static bool sort_along_strips(svg_writer *w, const froe_render_path *path) {
    const double wide = w->render->options->camera.width / ceil(sqrt(0.5 * (double)path->count));
    if (!array_reserve(&w->render->alloc, &w->rings, path->count)) {
        w->output->status = FROE_E_MEMORY;
        return false;
    }
    for (size_t i = 0; i < path->count; i++) {
        const froe_outline *outline = path->outlines + i;
        svg_ring ring = {outline, floor(outline->points[0] / wide), outline->points[1]};
        if (fmod(ring.x, 2) != 0) ring.y = -ring.y;
        w->rings.data[i] = ring;
    }
    qsort(w->rings.data, path->count, sizeof *w->rings.data, compare_along_strips);
    return true;
}

static void put_rings(svg_writer *w, const froe_render_path *path) {
    if (!sort_along_strips(w, path)) return;
    for (size_t i = 0; i < path->count; i++) {
        const froe_outline *ring = w->rings.data[i].outline;
        if (!vector_ring_shows(w->render, ring)) continue;
        /* It begins at the corner that is nearest to where the last one ended. */
        int64_t least = INT64_MAX;
        size_t nearest = 0;
        for (size_t k = 0; k < ring->count; k++) {
            const int64_t far = llabs(vector_step(w->render, ring->points[2 * k]) - w->at[0]) +
                                llabs(vector_step(w->render, ring->points[2 * k + 1]) - w->at[1]);
            if (far < least) least = far, nearest = k;
        }
        put_outline(w, ring, nearest);
    }
}

/* Points of the scene; several that fall together on the grid are one. */
static void put_points(svg_writer *w, const froe_render_path *path) {
    if (!sort_along_strips(w, path)) return;
    int64_t last[2] = {INT64_MIN, 0};
    for (size_t i = 0; i < path->count; i++) {
        const froe_outline *point = w->rings.data[i].outline;
        const int64_t at[2] = {vector_step(w->render, point->points[0]), vector_step(w->render, point->points[1])};
        if (at[0] != last[0] || at[1] != last[1]) put_outline(w, point, 0);
        memcpy(last, at, sizeof last);
    }
}

/* What shapes and lines say of the objects they belong to. */
static void put_ids(svg_writer *w, const froe_render_path *path) {
    const froe_ids ids = w->render->options->ids;
    if (ids == FROE_IDS_FACE) vector_print(w->output, " data-object=\"%u\"", path->object);
    if (ids == FROE_IDS_NONE) return;
    put_text(w, " data-group=\"");
    if (path->group != FROE_NONE) vector_put_escaped(w->output, froe_scene_group(w->render->scene, path->group).name);
    put_text(w, "\"");
}

static void put_shapes(svg_writer *w, const froe_render_path *path) {
    const vector_render *r = w->render;
    const uint32_t alpha = path->colour >> 24;
    put_text(w, "<path fill=\"");
    put_colour(w->output, path->colour);
    if (alpha < 255) vector_print(w->output, "\" fill-opacity=\"0.%02u", alpha * 100 / 255);
    if (r->options->seams == FROE_SEAMS_STROKE) { /* of the fill's own colour, as wide as seams may be */
        put_text(w, "\" stroke=\"");
        put_colour(w->output, path->colour);
        vector_print(w->output, "\" stroke-width=\"%s", vector_real(3, r->grid * path->width).text);
    }
    put_text(w, "\"");
    put_ids(w, path);
    put_text(w, " d=\"");
    begin_path(w);
    put_rings(w, path);
    put_text(w, "\"/>\n");
}

static void put_strokes(svg_writer *w, const froe_render_path *path) {
    /* Not from path->width: three digits depend on the order of rounding. */
    const froe_line_style style = vector_line_style(w->render->options, path->kind, path->hidden, w->render->grid);
    vector_print(w->output, "<path class=\"%s%s\"", froe_line_name(path->kind), path->hidden ? " hidden" : "");
    if ((path->colour & 0xFFFFFF) != FROE_LINE_COLOUR) {
        put_text(w, " stroke=\"");
        put_colour(w->output, path->colour);
        put_text(w, "\"");
    }
    vector_print(w->output, " stroke-width=\"%s\"", vector_real(path->dots ? 6 : 3, style.width).text);
    if (path->dots) put_text(w, " stroke-linecap=\"round\"");
    if (style.dash > 0)
        vector_print(w->output, " stroke-dasharray=\"%s %s\"", vector_real(3, style.dash).text,
                     vector_real(3, style.gap).text);
    if (w->render->options->ids != FROE_IDS_NONE)
        vector_print(w->output, " data-kind=\"%s\"", froe_line_name(path->kind));
    put_ids(w, path);
    put_text(w, " d=\"");
    begin_path(w);
    if (path->dots) put_points(w, path);
    for (size_t i = 0; i < path->count && !path->dots; i++) put_outline(w, path->outlines + i, 0);
    put_text(w, "\"/>\n");
}

/* ----------------------------------------------------------------------- groups -- */

static svg_group group_of_path(const svg_writer *w, const froe_render_path *path) {
    const froe_layers layers = w->render->options->layers;
    svg_group group = {.any = path->lines || layers, .lines = path->lines, .object = FROE_NONE};
    if (layers) group.hidden = path->hidden;
    if (layers == FROE_LAYERS_OBJECT) group.object = path->layer;
    if (layers == FROE_LAYERS_KIND) group.kind = path->kind;
    return group;
}

static bool same_group(const svg_group *a, const svg_group *b) {
    return a->any == b->any && a->lines == b->lines && a->hidden == b->hidden && a->kind == b->kind &&
           a->object == b->object;
}

/* Inkscape's layers are groups of its own mode, each with a label and, as every element, an id of its own. They have to
 * be the outermost groups, and so each is scaled. */
static void put_layer(svg_writer *w, const svg_group *group) {
    const froe_render_options *o = w->render->options;
    put_text(w, " inkscape:groupmode=\"layer\" inkscape:label=\"");
    const char *name = group->object == FROE_NONE ? "" : froe_scene_group(w->render->scene, group->object).name;
    vector_put_escaped(w->output, name);
    put_text(w, *name ? ": " : "");
    if (group->kind)
        vector_print(w->output, "%s-%s", group->hidden ? "hidden" : "visible", froe_line_name(group->kind));
    else
        put_text(w, !group->lines ? "faces" : group->hidden ? "hidden lines" : "lines");
    put_text(w, "\" id=\"");
    if (w->frame) vector_print(w->output, "frame%zu-", w->frame);
    vector_print(w->output, "layer%zu\"", ++w->layers);
    if (*name) {
        put_text(w, " data-layer=\"");
        vector_put_escaped(w->output, name);
        put_text(w, "\"");
    }
    if (o->decimals) vector_print(w->output, " transform=\"scale(0.%0*d)\"", o->decimals, 1);
}

static void begin_twice(svg_writer *w) {
    vector_print(w->output, "<g id=\"fills%zu\">\n", w->frame);
    w->twice = true;
}

static void end_twice(svg_writer *w) {
    vector_print(w->output, "</g>\n<use href=\"#fills%zu\"/>\n", w->frame);
    w->twice = false;
}

/* Ends the group that is open, and begins that of a path; NULL: nothing follows. Fills that are painted twice are a
 * group around layers by object, and within that of all faces. */
static void enter_group(svg_writer *w, const froe_render_path *path) {
    const froe_render_options *o = w->render->options;
    const bool within = o->layers == FROE_LAYERS_KIND, fills = path && !path->lines;
    const svg_group next = path ? group_of_path(w, path) : (svg_group){.object = FROE_NONE};
    const bool done = w->twice && !fills;
    if (same_group(&next, &w->group) && !done) return;
    if (done && within) end_twice(w);
    if (w->group.any) put_text(w, "</g>\n");
    if (done && !within) end_twice(w);
    if (next.any) {
        put_text(w, "<g");
        if (o->layers) put_layer(w, &next);
        put_text(w, next.lines ? " fill=\"none\" stroke=\"#1b2630\" stroke-linejoin=\"round\">\n" : ">\n");
    }
    if (within && fills && o->seams == FROE_SEAMS_TWICE) begin_twice(w);
    w->group = next;
}

/* Shown for the i-th of `count` equal times, again and again; the first also where nothing moves, or where the reader
 * wants less motion. */
static void put_times(vector_output *output, const vector_frame *f) {
    const vector_digits from = vector_real(6, (double)f->i / (double)f->count),
                        to = vector_real(6, (double)(f->i + 1) / (double)f->count);
    if (f->i == 0) vector_print(output, VECTOR_SVG_STILL);
    vector_print(output,
                 "<g class=%s>\n<animate attributeName=\"display\" calcMode=\"discrete\" dur=\"%ss\" "
                 "repeatCount=\"indefinite\" ",
                 f->i ? "\"other\" display=\"none\"" : "\"first\"", vector_real(6, f->seconds).text);
    if (f->i == 0)
        vector_print(output, "values=\"inline;none\" keyTimes=\"0;%s\"/>\n", to.text);
    else if (f->i + 1 < f->count)
        vector_print(output, "values=\"none;inline;none\" keyTimes=\"0;%s;%s\"/>\n", from.text, to.text);
    else
        vector_print(output, "values=\"none;inline\" keyTimes=\"0;%s\"/>\n", from.text);
}

void vector_svg_picture(vector_render *render, vector_output *output, const vector_frame *frame) {
    svg_writer w = {.render = render, .output = output, .group.object = FROE_NONE, .frame = frame->i};
    vector_cursor at = {0, 0};
    if (frame->count > 1) put_times(output, frame);
    if (render->options->seams == FROE_SEAMS_TWICE && render->options->layers != FROE_LAYERS_KIND) begin_twice(&w);
    for (froe_render_path path; !output->status && vector_next_path(render, &at, &path);) {
        enter_group(&w, &path);
        if (path.lines)
            put_strokes(&w, &path);
        else
            put_shapes(&w, &path);
    }
    enter_group(&w, NULL);
    if (frame->count > 1) put_text(&w, "</g>\n");
    array_free(&render->alloc, &w.rings);
}

bool vector_svg_each(vector_render *render, vector_output *output, bool (*fn)(void *user, bool lines), void *user) {
    svg_writer w = {.render = render, .output = output, .group.object = FROE_NONE};
    vector_cursor at = {0, 0};
    bool more = true;
    for (froe_render_path path; more && !output->status && vector_next_path(render, &at, &path);) {
        w.at[0] = w.at[1] = 0;
        if (path.lines)
            put_strokes(&w, &path);
        else
            put_shapes(&w, &path);
        vector_flush(output);
        more = fn(user, path.lines);
    }
    array_free(&render->alloc, &w.rings);
    return more;
}

/* Is there one scaled group around everything? Layers are scaled one by one. */
static bool scales_all(const froe_render_options *o) {
    return o->decimals && !o->layers;
}

void vector_svg_begin(const vector_render *render, vector_output *output) {
    const froe_render_options *o = render->options;
    const char *unit = o->millimetres ? "mm" : "";
    const vector_digits width = vector_real(10, o->camera.width), height = vector_real(10, o->camera.height);
    vector_print(output,
                 "<svg xmlns=\"http://www.w3.org/2000/svg\"%s width=\"%s%s\" height=\"%s%s\" viewBox=\"0 0 %s %s\" "
                 "role=\"img\">\n",
                 o->layers ? " xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\"" : "", width.text, unit,
                 height.text, unit, width.text, height.text);
    const char *const parts[2][2] = {{"title", o->title}, {"desc", o->description}};
    for (int i = 0; i < 2; i++) {
        if (!parts[i][1]) continue;
        vector_print(output, "<%s>", parts[i][0]);
        vector_put_escaped(output, parts[i][1]);
        vector_print(output, "</%s>\n", parts[i][0]);
    }
    if (o->background < FROE_DRAW_BY_FORMAT) {
        vector_print(output, "<rect width=\"100%%\" height=\"100%%\" fill=\"");
        put_colour(output, o->background);
        vector_print(output, "\"/>\n");
    }
    /* Everything else is in steps of the grid. */
    if (scales_all(o)) vector_print(output, "<g transform=\"scale(0.%0*d)\">\n", o->decimals, 1);
}

void vector_svg_end(const vector_render *render, vector_output *output) {
    vector_print(output, scales_all(render->options) ? "</g>\n</svg>\n" : "</svg>\n");
}
