/* paths.c: a picture as paths, in the order in which they are painted: shapes of one colour share one, strokes of one
 * kind another. Every format, froe's own and others, is written from these. */
#include "render.h"

static uint32_t colour_of_shape(const vector_render *r, const froe_shape *shape) {
    return r->styles.data[r->style_of[shape->patch]];
}

static uint32_t group_of_shape(const vector_render *r, const froe_shape *shape) {
    return froe_surface_patch(r->surface, shape->patch).group;
}

static uint32_t layer_of_shape(const vector_render *r, const froe_shape *shape) {
    const uint32_t group = group_of_shape(r, shape);
    return r->layer_of && group != FROE_NONE ? r->layer_of[group] : FROE_NONE;
}

/* May a shape share the path of another that it follows? */
static bool shares_path(const vector_render *r, const froe_shape *first, const froe_shape *next) {
    const froe_ids ids = r->options->ids;
    if (ids == FROE_IDS_FACE || colour_of_shape(r, first) >> 24 < 255) return false;
    if (colour_of_shape(r, first) != colour_of_shape(r, next) || layer_of_shape(r, first) != layer_of_shape(r, next))
        return false;
    return ids == FROE_IDS_NONE || group_of_shape(r, first) == group_of_shape(r, next);
}

/* ----------------------------------------------------------------------- showing -- */

__extension__ typedef __int128 step_area; /* products of steps on a page of any size */

bool vector_ring_shows(const vector_render *r, const froe_outline *ring) {
    const double *points = ring->points;
    step_area area = 0;
    for (size_t i = 1; i + 1 < ring->count; i++) {
        const int64_t x = vector_step(r, points[0]), y = vector_step(r, points[1]);
        const step_area a = vector_step(r, points[2 * i]) - x, b = vector_step(r, points[2 * i + 1]) - y,
                        c = vector_step(r, points[2 * i + 2]) - x, d = vector_step(r, points[2 * i + 3]) - y;
        area += a * d - b * c;
    }
    return area != 0;
}

bool vector_stroke_shows(const vector_render *r, const froe_stroke *s) {
    if (s->kind == FROE_LINE_POINT) return true;
    for (size_t i = 1; i < s->count; i++)
        for (int k = 0; k < 2; k++)
            if (vector_step(r, s->points[2 * i + k]) != vector_step(r, s->points[k])) return true;
    return false;
}

static froe_outline ring_of(const vector_render *r, const froe_shape *shape, size_t i) {
    froe_outline ring = {.closed = true};
    ring.points = froe_picture_ring(r->picture, shape->first_ring + i, &ring.count);
    return ring;
}

static bool shape_shows(const vector_render *r, const froe_shape *shape) {
    for (size_t i = 0; i < shape->ring_count; i++) {
        const froe_outline ring = ring_of(r, shape, i);
        if (vector_ring_shows(r, &ring)) return true;
    }
    return false;
}

froe_status vector_count_shown(vector_render *r) {
    const size_t shapes = froe_picture_shape_count(r->picture), strokes = froe_picture_stroke_count(r->picture);
    size_t rings = 0;
    for (size_t i = 0; i < shapes; i++) {
        const froe_shape shape = froe_picture_shape(r->picture, i);
        ++*(shape_shows(r, &shape) ? &r->report.shapes : &r->report.thin_shapes);
        rings += shape.ring_count;
    }
    for (size_t i = 0; i < strokes; i++) {
        const froe_stroke stroke = froe_picture_stroke(r->picture, i);
        ++*(vector_stroke_shows(r, &stroke) ? &r->report.strokes : &r->report.short_strokes);
        r->report.dots += stroke.kind == FROE_LINE_POINT;
    }
    r->room = rings > strokes ? rings : strokes;
    r->outlines = support_calloc(&r->alloc, r->room, sizeof *r->outlines);
    return r->outlines ? FROE_OK : FROE_E_MEMORY;
}

/* ------------------------------------------------------------------------- paths -- */

static size_t place_of_stroke(const vector_render *r, size_t stroke) {
    return stroke < froe_picture_stroke_count(r->picture) ? vector_stroke(r, stroke).place : SIZE_MAX;
}

static uint32_t owner_of(const vector_render *r, const froe_stroke *s) {
    return r->owners ? r->owners[s->objects[0]] : FROE_NONE;
}

/* What the path of a stroke says that it belongs to. */
static void set_owner(const vector_render *r, const froe_stroke *s, froe_render_path *path) {
    path->object = path->group = path->layer = FROE_NONE;
    if (!r->owners) return;
    const uint32_t group = vector_group(r, s->objects[0]);
    if (r->options->ids == FROE_IDS_FACE) path->object = owner_of(r, s);
    if (r->options->ids != FROE_IDS_NONE) path->group = group;
    if (r->layer_of && group != FROE_NONE) path->layer = r->layer_of[group];
}

/* Of wires and points that of their group, unless the style of their kind says it. */
static uint32_t colour_of_stroke(const vector_render *r, const froe_stroke *s, const froe_line_style *style) {
    if (style->colour != FROE_NONE) return style->colour;
    if (s->kind != FROE_LINE_WIRE && s->kind != FROE_LINE_POINT) return FROE_LINE_COLOUR;
    return vector_line_colour(r, froe_scene_object(r->scene, s->objects[0]).group);
}

/* Strokes of one kind, colour and owner that are due before the next shape. False: none of them shows. */
static bool take_strokes(const vector_render *r, vector_cursor *at, froe_render_path *path) {
    const froe_stroke first = vector_stroke(r, at->stroke);
    const froe_line_style style = vector_line_style(r->options, first.kind, first.hidden, 1);
    *path = (froe_render_path){.lines = true, .kind = first.kind, .hidden = first.hidden};
    path->dots = first.kind == FROE_LINE_POINT;
    path->colour = 0xFF000000 | colour_of_stroke(r, &first, &style);
    path->width = style.width, path->dash = style.dash, path->gap = style.gap;
    set_owner(r, &first, path);
    path->outlines = r->outlines;
    for (; place_of_stroke(r, at->stroke) <= at->shape; at->stroke++) {
        const froe_stroke next = vector_stroke(r, at->stroke);
        if (next.kind != first.kind || next.hidden != first.hidden || owner_of(r, &next) != owner_of(r, &first)) break;
        if (path->colour != (0xFF000000 | colour_of_stroke(r, &next, &style))) break;
        if (vector_stroke_shows(r, &next))
            r->outlines[path->count++] = (froe_outline){next.points, next.count, next.closed};
    }
    return path->count;
}

/* Shapes up to one that may not share their path, or that a stroke comes before. False: none of them shows. */
static bool take_shapes(const vector_render *r, vector_cursor *at, froe_render_path *path) {
    const size_t count = froe_picture_shape_count(r->picture), place = place_of_stroke(r, at->stroke);
    const froe_shape first = froe_picture_shape(r->picture, at->shape);
    bool shows = false;
    *path = (froe_render_path){.colour = colour_of_shape(r, &first), .outlines = r->outlines};
    path->width = r->options->seams == FROE_SEAMS_STROKE ? r->options->seam_width : 0;
    path->object = froe_surface_patch(r->surface, first.patch).objects[0];
    path->group = group_of_shape(r, &first);
    path->layer = layer_of_shape(r, &first);
    const size_t begin = at->shape;
    for (; at->shape < count && at->shape < place; at->shape++) {
        const froe_shape next = froe_picture_shape(r->picture, at->shape);
        if (at->shape > begin && !shares_path(r, &first, &next)) break;
        for (size_t i = 0; i < next.ring_count; i++) r->outlines[path->count++] = ring_of(r, &next, i);
        shows = shows || shape_shows(r, &next);
    }
    return shows;
}

bool vector_next_path(const vector_render *r, vector_cursor *at, froe_render_path *path) {
    for (;;) {
        const bool lines = place_of_stroke(r, at->stroke) <= at->shape;
        if (!lines && at->shape >= froe_picture_shape_count(r->picture)) return false;
        if (lines ? take_strokes(r, at, path) : take_shapes(r, at, path)) return true;
    }
}

bool vector_each_path(vector_render *r, froe_render_path_fn *fn, void *user) {
    for (int pass = r->options->seams == FROE_SEAMS_TWICE ? 0 : 1; pass < 2; pass++) {
        vector_cursor at = {0, 0};
        for (froe_render_path path; vector_next_path(r, &at, &path);) {
            if (path.lines && !pass) continue;
            r->report.paths++;
            if (!fn(user, &path)) return false;
        }
    }
    return true;
}
