/* runs.c: a picture as paths, in the order in which they are painted: shapes of one colour share one, strokes of one
 * kind another. */
#include "render.h"

/* May a shape share the path of another that it follows? */
static bool joins(const draw_render *r, const froe_shape *first, const froe_shape *next) {
    const froe_ids ids = r->options->ids;
    if (ids == FROE_IDS_FACE || draw_style_of(r, first) >> 24 < 255) return false;
    if (draw_style_of(r, first) != draw_style_of(r, next) || draw_layer_of(r, first) != draw_layer_of(r, next))
        return false;
    return ids == FROE_IDS_NONE ||
           froe_surface_patch(r->surface, first->patch).group == froe_surface_patch(r->surface, next->patch).group;
}

static size_t place_of_stroke(const draw_render *r, size_t stroke) {
    return stroke < froe_picture_stroke_count(r->picture) ? froe_picture_stroke(r->picture, stroke).place : SIZE_MAX;
}

/* Strokes of one kind that are due before the next shape. */
static draw_run stroke_run(const draw_render *r, const draw_cursor *at) {
    const froe_stroke first = froe_picture_stroke(r->picture, at->stroke);
    draw_run run = {true, at->shape >= froe_picture_shape_count(r->picture), at->stroke, at->stroke + 1};
    while (place_of_stroke(r, run.end) <= at->shape) {
        const froe_stroke next = froe_picture_stroke(r->picture, run.end);
        if (next.kind != first.kind || next.hidden != first.hidden) break;
        run.end++;
    }
    return run;
}

/* Shapes up to one that may not share their path, or that a stroke comes before. */
static draw_run shape_run(const draw_render *r, const draw_cursor *at) {
    const size_t count = froe_picture_shape_count(r->picture), place = place_of_stroke(r, at->stroke);
    const froe_shape first = froe_picture_shape(r->picture, at->shape);
    draw_run run = {false, false, at->shape, at->shape + 1};
    while (run.end < count && run.end < place) {
        const froe_shape next = froe_picture_shape(r->picture, run.end);
        if (!joins(r, &first, &next)) break;
        run.end++;
    }
    run.last = run.end == count;
    return run;
}

static bool run_shows(const draw_render *r, const draw_run *run) {
    for (size_t i = run->first; i < run->end; i++) {
        const froe_stroke stroke = froe_picture_stroke(r->picture, i);
        const froe_shape shape = froe_picture_shape(r->picture, i);
        if (run->lines ? draw_stroke_shows(r, &stroke) : draw_shape_shows(r, &shape)) return true;
    }
    return false;
}

bool draw_next_run(const draw_render *r, draw_cursor *at, draw_run *run) {
    do {
        const bool lines = place_of_stroke(r, at->stroke) <= at->shape;
        if (!lines && at->shape >= froe_picture_shape_count(r->picture)) return false;
        *run = lines ? stroke_run(r, at) : shape_run(r, at);
        *(lines ? &at->stroke : &at->shape) = run->end;
    } while (!run_shows(r, run));
    return true;
}

/* ---------------------------------------------------------------------- showing -- */

bool draw_ring_shows(const draw_render *r, const double *points, size_t count) {
    int64_t area = 0;
    for (size_t i = 1; i + 1 < count; i++) {
        const int64_t x = draw_step(r, points[0]), y = draw_step(r, points[1]);
        const int64_t a = draw_step(r, points[2 * i]) - x, b = draw_step(r, points[2 * i + 1]) - y,
                      c = draw_step(r, points[2 * i + 2]) - x, d = draw_step(r, points[2 * i + 3]) - y;
        area += a * d - b * c;
    }
    return area != 0;
}

bool draw_shape_shows(const draw_render *r, const froe_shape *shape) {
    for (size_t i = 0; i < shape->ring_count; i++) {
        size_t count;
        const double *ring = froe_picture_ring(r->picture, shape->first_ring + i, &count);
        if (draw_ring_shows(r, ring, count)) return true;
    }
    return false;
}

bool draw_stroke_shows(const draw_render *r, const froe_stroke *s) {
    for (size_t i = 1; i < s->count; i++)
        for (int k = 0; k < 2; k++)
            if (draw_step(r, s->points[2 * i + k]) != draw_step(r, s->points[k])) return true;
    return false;
}

void draw_count_shown(draw_render *r) {
    const size_t shapes = froe_picture_shape_count(r->picture), strokes = froe_picture_stroke_count(r->picture);
    for (size_t i = 0; i < shapes; i++) {
        const froe_shape shape = froe_picture_shape(r->picture, i);
        ++*(draw_shape_shows(r, &shape) ? &r->report.shapes : &r->report.thin_shapes);
    }
    for (size_t i = 0; i < strokes; i++) {
        const froe_stroke stroke = froe_picture_stroke(r->picture, i);
        ++*(draw_stroke_shows(r, &stroke) ? &r->report.strokes : &r->report.short_strokes);
    }
}
