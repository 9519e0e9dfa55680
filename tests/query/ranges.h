/* ranges.h: ranges of every shape, made at random, and what brute force in rationals says about them. */
#ifndef FROE_TESTS_QUERY_RANGES_H
#define FROE_TESTS_QUERY_RANGES_H
#include "query/worlds.h"

enum { MOST_POINTS = 12 };

/* A range with the doubles it is made of. */
typedef struct question {
    froe_range range;
    double points[MOST_POINTS * FROE_MAX_DIM], offsets[MOST_POINTS];
    oracle_set set;
} question;

/* ------------------------------------------------------------------ making -- */

static inline double size_of(world_dice *d) {
    static const double sizes[] = {0, 0.01, 0.05, 0.2, 0.6, 2};
    return sizes[world_below(d, 6)];
}

static inline void make_box(const world *w, world_dice *d, question *q) {
    double *lo = q->points, *hi = q->points + w->dim, a[FROE_MAX_DIM];
    memcpy(a, lo, sizeof a);
    world_near(w, d, size_of(d), a, hi);
    for (int k = 0; k < w->dim; k++) {
        double x = a[k], y = hi[k];
        lo[k] = fmin(x, y);
        hi[k] = fmax(x, y);
        if (!world_below(d, 20)) lo[k] = -INFINITY;
        if (!world_below(d, 20)) hi[k] = INFINITY;
    }
}

/* From one place to another, or any vector; not 0. */
static inline void make_vector(const world *w, world_dice *d, double *v) {
    double from[FROE_MAX_DIM], to[FROE_MAX_DIM], most = 0;
    fuzz_source r = world_fuzz(d);
    const bool any = fuzz_int(&r, 0, 1);
    world_point(w, d, from);
    world_point(w, d, to);
    for (int k = 0; k < w->dim; k++) {
        v[k] = any ? extreme_number(&r, w->scene) : extreme_finite(to[k] - from[k]);
        most = fmax(most, fabs(v[k]));
    }
    if (most == 0) v[world_below(d, (uint32_t)w->dim)] = extreme_scale(&r, w->scene);
}

/* Halfspaces whose planes run by a point, as nearly as doubles let them, or anywhere. */
static inline void make_extreme_halfspaces(const world *w, world_dice *d, question *q) {
    double centre[3], size[3];
    memcpy(centre, q->points, sizeof centre);
    q->range.count = 1 + world_below(d, w->dim == 2 ? 6 : 5);
    for (size_t i = 0; i < q->range.count; i++) {
        double *n = q->points + i * (size_t)w->dim, value = 0;
        make_vector(w, d, n);
        for (int k = 0; k < w->dim; k++) value += n[k] * centre[k];
        world_point(w, d, size);
        q->offsets[i] = world_below(d, 4) ? extreme_finite(value) : size[0];
    }
}

/* Halfspaces around a point, at lattice distances on lattices; unbounded, flat or empty ones among them. */
static inline void make_halfspaces(const world *w, world_dice *d, question *q) {
    double centre[3], size = size_of(d);
    size_t dim = (size_t)w->dim;
    if (w->extreme) {
        make_extreme_halfspaces(w, d, q);
        return;
    }
    memcpy(centre, q->points, sizeof centre);
    q->range.count = 1 + world_below(d, w->dim == 2 ? 6 : 5);
    for (size_t i = 0; i < q->range.count; i++) {
        double *n = q->points + i * dim, value = 0;
        for (size_t k = 0; k < dim; k++) n[k] = w->lattice ? (double)world_below(d, 5) - 2 : 2 * world_unit(d) - 1;
        for (size_t k = 0; k < dim; k++) value += n[k] * centre[k];
        q->offsets[i] = value + (world_below(d, 5) ? w->scale * size * world_unit(d) : 0);
        if (w->lattice) q->offsets[i] = floor(q->offsets[i]);
        if (!world_below(d, 20)) q->offsets[i] -= 0.1 * w->scale;
    }
}

static inline void make_points(const world *w, world_dice *d, question *q, size_t count) {
    double size = size_of(d);
    size_t dim = (size_t)w->dim;
    for (size_t i = 1; i < count; i++) {
        world_near(w, d, size, q->points, q->points + i * dim);
        if (!world_below(d, 5)) world_point(w, d, q->points + i * dim);
        if (!world_below(d, 20)) memcpy(q->points + i * dim, q->points, dim * sizeof(double));
    }
}

static inline void make_radius(const world *w, world_dice *d, question *q) {
    const double size = size_of(d);
    q->range.radius = world_length(w, d, size, q->points);
}

static inline void make_direction(const world *w, world_dice *d, question *q) {
    double *e = q->points + w->dim;
    if (w->extreme) {
        make_vector(w, d, e);
        return;
    }
    for (int k = 0; k < w->dim; k++)
        e[k] = w->lattice || !world_below(d, 3) ? (double)world_below(d, 5) - 2 : world_unit(d) - 0.5;
    bool zero = true;
    for (int k = 0; k < w->dim; k++) zero = zero && e[k] == 0;
    if (zero) e[world_below(d, (uint32_t)w->dim)] = -1;
}

/* The box around the scene, and a little more, where the range is unbounded. */
static inline void clip(const world *w, const question *q, double *lo, double *hi) {
    froe_scene_bounds(w->scene, lo, hi);
    for (int k = 0; k < w->dim; k++) {
        if (q->range.shape != FROE_SHAPE_BOX) continue;
        lo[k] = isinf(q->points[k]) ? fmin(lo[k], q->points[w->dim + k]) : q->points[k];
        hi[k] = isinf(q->points[w->dim + k]) ? fmax(hi[k], lo[k]) : q->points[w->dim + k];
    }
}

static inline void make_oracle(const world *w, question *q) {
    double lo[FROE_MAX_DIM] = {0}, hi[FROE_MAX_DIM] = {0};
    size_t points[FROE_SHAPE_COUNT] = {[FROE_SHAPE_BALL] = 1,
                                       [FROE_SHAPE_SIMPLEX] = (size_t)w->dim + 1,
                                       [FROE_SHAPE_CAPSULE] = 2,
                                       [FROE_SHAPE_HULL] = q->range.count,
                                       [FROE_SHAPE_SEGMENT] = 2};
    clip(w, q, lo, hi);
    switch (q->range.shape) {
    case FROE_SHAPE_BOX:
        q->set = oracle_box(w->dim, lo, hi);
        break;
    case FROE_SHAPE_HALFSPACES:
        q->set = oracle_halfspaces(w->dim, q->points, q->offsets, q->range.count, lo, hi);
        break;
    case FROE_SHAPE_RAY:
        q->set = oracle_ray_past(w->dim, q->points, q->points + w->dim, lo, hi);
        break;
    default:
        q->set = oracle_points(w->dim, q->points, points[q->range.shape], q->range.radius);
    }
}

static inline void make(const world *w, world_dice *d, froe_range_shape shape, question *q) {
    memset(q, 0, sizeof *q);
    q->range = froe_range_defaults();
    q->range.shape = shape;
    q->range.points = q->points;
    q->range.offsets = q->offsets;
    world_point(w, d, q->points);
    switch (shape) {
    case FROE_SHAPE_BOX:
        make_box(w, d, q);
        break;
    case FROE_SHAPE_HALFSPACES:
        make_halfspaces(w, d, q);
        break;
    case FROE_SHAPE_RAY:
        make_direction(w, d, q);
        break;
    case FROE_SHAPE_HULL:
        q->range.count = 1 + world_below(d, w->dim == 2 ? 8 : 5);
        make_points(w, d, q, q->range.count);
        break;
    default:
        make_points(w, d, q, shape == FROE_SHAPE_SIMPLEX ? (size_t)w->dim + 1 : 2);
    }
    if (shape == FROE_SHAPE_BALL || shape == FROE_SHAPE_CAPSULE) make_radius(w, d, q);
    if (w->dim <= 3) make_oracle(w, q);
}

/* ----------------------------------------------------------------- checking -- */

static inline bool truth(const world *w, const question *q, uint32_t object) {
    int known = -1;
    if (q->range.shape == FROE_SHAPE_HALFSPACES)
        known = oracle_halfspaces_hold(w->dim, q->points, q->offsets, q->range.count, &w->objects[object]);
    if (known >= 0) return known;
    if (w->dim <= 3) return oracle_meet(&w->objects[object], &q->set);
    froe_object o = froe_scene_object(w->scene, object);
    const double *lo = froe_scene_vertex(w->scene, froe_scene_corner(w->scene, object, 0));
    const double *hi = o.form == FROE_BOX ? froe_scene_vertex(w->scene, froe_scene_corner(w->scene, object, 1)) : lo;
    bool box = q->range.shape == FROE_SHAPE_BOX;
    return oracle_meet_boxes(w->dim, lo, hi, o.radius, q->points, box ? q->points + w->dim : q->points,
                             q->range.radius);
}

static inline void explain(const world *w, const question *q, size_t tree, uint32_t object, bool found) {
    char text[1000] = "";
    size_t length = 0;
    for (size_t i = 0; i < 4 * (size_t)w->dim && length < sizeof text - 40; i++)
        length += (size_t)snprintf(text + length, sizeof text - length, " %a", q->points[i]);
    fail_msg("%s, %s, walk %s, tree %zu: object %u %s, but should%s be; radius %a, points%s", w->name,
             froe_range_shape_name(q->range.shape), froe_walk_name(q->range.walk), tree, object,
             found ? "found" : "not found", found ? " not" : "", q->range.radius, text);
}

/* Asks all trees; true[] says which objects meet the range. */
static inline void compare(const world *w, question *q, const bool *meets, size_t expected) {
    bool *found = calloc(w->count + 1, sizeof *found);
    for (size_t t = 0; t < w->tree_count; t++) {
        froe_list list;
        froe_diagnostic diag;
        uint64_t count;
        uint32_t any;
        if (froe_query_range(w->queries[t], &q->range, &list, &diag)) fail_msg("%s", diag.message);
        memset(found, 0, w->count);
        for (size_t i = 0; i < list.count; i++) {
            assert_false(found[list.ids[i]]); /* once */
            found[list.ids[i]] = true;
        }
        for (uint32_t i = 0; i < w->count; i++)
            if (found[i] != meets[i]) explain(w, q, t, i, found[i]);
        assert_int_equal(froe_query_count(w->queries[t], &q->range, &count, NULL), FROE_OK);
        assert_int_equal(count, expected);
        assert_int_equal(froe_query_any(w->queries[t], &q->range, &any, NULL), FROE_OK);
        assert_true(expected ? any < w->count && meets[any] : any == FROE_NONE);
    }
    free(found);
}

/* What brute force says about an object. */
typedef bool range_truth(const world *w, const question *q, uint32_t object);

/* By walks first .. last. Returns the number of decisions. */
static inline size_t ask_by(const world *w, froe_range_shape shape, uint64_t seed, froe_walk first, froe_walk last,
                            range_truth *true_of) {
    world_dice d = {seed, 0};
    question q;
    bool *meets = calloc(w->count + 1, sizeof *meets);
    size_t expected = 0;
    make(w, &d, shape, &q);
    for (uint32_t i = 0; i < w->count; i++) expected += meets[i] = true_of(w, &q, i);
    for (q.range.walk = first; q.range.walk <= last; q.range.walk++) compare(w, &q, meets, expected);
    if (w->dim <= 3) oracle_set_free(&q.set);
    free(meets);
    return w->count * w->tree_count * (size_t)(last - first + 1);
}

static inline size_t ask(const world *w, froe_range_shape shape, uint64_t seed) {
    return ask_by(w, shape, seed, FROE_WALK_AUTO, FROE_WALK_AUTO, truth);
}

/** Kinds that lie flat, and kinds that do not. */
enum { FLAT_KINDS = 1 << FROE_POINT | 1 << FROE_SEGMENT, SOLID_KINDS = 1 << FROE_BOX | 1 << FROE_BALL };
#endif
