/* exact_ranges.h: what brute force in whole numbers says about a range, whatever its scale. */
#ifndef FROE_TESTS_QUERY_EXACT_RANGES_H
#define FROE_TESTS_QUERY_EXACT_RANGES_H
#include "query/exact_world.h"
#include "query/ranges.h"

/* A range as a body, where it is one. */
static inline geom_body exact_range_body(const world *w, const question *q) {
    static const froe_kind forms[FROE_SHAPE_COUNT] = {[FROE_SHAPE_BOX] = FROE_BOX,
                                                      [FROE_SHAPE_BALL] = FROE_BALL,
                                                      [FROE_SHAPE_SIMPLEX] = FROE_HULL,
                                                      [FROE_SHAPE_HULL] = FROE_HULL,
                                                      [FROE_SHAPE_SEGMENT] = FROE_SEGMENT};
    const uint32_t counts[FROE_SHAPE_COUNT] = {[FROE_SHAPE_BOX] = 2,
                                               [FROE_SHAPE_BALL] = 1,
                                               [FROE_SHAPE_SIMPLEX] = (uint32_t)w->dim + 1,
                                               [FROE_SHAPE_HULL] = (uint32_t)q->range.count,
                                               [FROE_SHAPE_SEGMENT] = 2};
    const froe_range_shape shape = q->range.shape;
    return (geom_body){
        .form = forms[shape], .dim = w->dim, .count = counts[shape], .coords = q->points, .radius = q->range.radius};
}

/** Does the object meet the range? Whole numbers where the shape lets them: rationals of thousands of bits are slow. */
static inline bool exact_range_meets(const world *w, const question *q, uint32_t object) {
    const froe_range_shape shape = q->range.shape;
    const size_t dim = (size_t)w->dim;
    if (shape == FROE_SHAPE_CAPSULE || shape == FROE_SHAPE_HALFSPACES) return truth(w, q, object);
    const geom_body body = scene_body(w->scene, object);
    question bounded = *q;
    if (shape == FROE_SHAPE_BOX) clip(w, q, bounded.points, bounded.points + dim);
    int shift = exact_shift(exact_shift(0, bounded.points, MOST_POINTS * FROE_MAX_DIM), &q->range.radius, 1);
    shift = exact_shift(shift, &body.radius, 1);
    for (uint32_t c = 0; c < body.count; c++) shift = exact_shift(shift, geom_body_point(&body, c), dim);
    exact_begin(shift);
    const geom_body range = exact_range_body(w, &bounded);
    const exact_body a = exact_body_of(&body);
    exact_value at;
    bool corner;
    if (shape == FROE_SHAPE_RAY) return exact_ray(q->points, q->points + dim, &a, &at);
    if (shape == FROE_SHAPE_BALL) {
        const exact_value reach = exact_value_of(q->range.radius, shift);
        at = exact_distance(q->points, &a);
        return exact_compare(&at, &reach) <= 0;
    }
    const exact_body b = exact_body_of(&range);
    return exact_contact(&a, &b, &corner) != 0;
}
#endif
