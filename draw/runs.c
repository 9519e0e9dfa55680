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

static size_t place_of(const draw_render *r, size_t stroke) {
    return stroke < froe_picture_stroke_count(r->picture) ? froe_picture_stroke(r->picture, stroke).place : SIZE_MAX;
}

/* Strokes of one kind that are due before the next shape. */
static draw_run stroke_run(const draw_render *r, const draw_cursor *at) {
    const froe_stroke first = froe_picture_stroke(r->picture, at->stroke);
    draw_run run = {true, at->shape >= froe_picture_shape_count(r->picture), at->stroke, at->stroke + 1};
    while (place_of(r, run.end) <= at->shape) {
        const froe_stroke next = froe_picture_stroke(r->picture, run.end);
        if (next.kind != first.kind || next.hidden != first.hidden) break;
        run.end++;
    }
    return run;
}

/* Shapes up to one that may not share their path, or that a stroke comes before. */
static draw_run shape_run(const draw_render *r, const draw_cursor *at) {
    const size_t count = froe_picture_shape_count(r->picture), place = place_of(r, at->stroke);
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

bool draw_next_run(const draw_render *r, draw_cursor *at, draw_run *run) {
    const bool lines = place_of(r, at->stroke) <= at->shape;
    if (!lines && at->shape >= froe_picture_shape_count(r->picture)) return false;
    *run = lines ? stroke_run(r, at) : shape_run(r, at);
    *(lines ? &at->stroke : &at->shape) = run->end;
    return true;
}
