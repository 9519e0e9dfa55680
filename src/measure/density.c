/* density.c: bounds on the density lambda of a scene.
 *
 *          ____             Only balls of exactly the size of an object matter: growing a ball to the
 *        /      \           next size loses nothing. So for each object o of radius r:
 *       |  o  r  | 2r
 *        \      /             N(o) = objects of at least the size of o within 3 r of its centre
 *          ----
 *                           Every ball of radius r that meets o has its contents in N(o): lambda <= max N(o).
 *
 * For the lower bound balls of radius r are tried around points near the objects with the largest N(o). Distances are
 * compared exactly; sizes are rounded to doubles, so lambda is that of the scene with these sizes. */
#include "base/floats.h"
#include "base/random.h"
#include "geom/meet/distance.h"
#include "geom/selftest.h"
#include "measure/enclosing.h"
#include "measure/hierarchy.h"
#include "measure/sample.h"
#include "support/fail.h"
#include <math.h>
#include <string.h>

enum { TRIES = 48, TRIED = 500 }; /* balls tried at an object; objects, at most */

typedef struct candidate {
    uint32_t load; /* N(o) */
    uint32_t object;
    uint64_t key;
} candidate;

typedef struct density_survey {
    measure_sample sample;
    measure_hierarchy objects;
    num_context context;
    froe_size kind;
    measure_bounds bounds;
    double *size;
    uint64_t *keys;
    ARRAY(uint32_t) near;  /* N(o) */
    candidate best[TRIED]; /* most loaded first; of equal ones that of the lower key */
    uint32_t best_count;
    froe_density out;
} density_survey;

static bool is_within_radius(density_survey *s, const double *point, double radius, uint32_t object) {
    const froe_scene *scene = s->sample.scene;
    const bool corners = scene_form(scene, object) != FROE_BALL;
    for (uint32_t i = 0; i < scene_corners(scene, object) && corners; i++) { /* is one certainly within? */
        const double *p = scene_point(scene, object, i);
        double square = 0;
        for (int k = 0; k < scene->dim; k++) square += (p[k] - point[k]) * (p[k] - point[k]);
        if (square * (1 + 0x1p-40) < radius * radius - 0x1p-1000) return true; /* no denormal squares */
    }
    geom_body body = scene_body(scene, object);
    geom_distance distance = geom_distance_from(&s->context, point, &body);
    return geom_distance_compare_to(&s->context, point, &distance, radius) <= 0;
}

/* Counts what a ball of the size of the object meets; keeps the best ball. */
static void try_ball(density_survey *s, const double *centre, double radius) {
    uint32_t count = 0;
    for (size_t i = 0; i < s->near.count && count + (s->near.count - i) > s->out.lower; i++)
        count += is_within_radius(s, centre, radius, s->near.data[i]);
    if (count <= s->out.lower) return;
    s->out.lower = count;
    s->out.radius = radius;
    memcpy(s->out.centre, centre, (size_t)s->objects.dim * sizeof(double));
}

/* Balls half-way to points of the objects near by, and around points of the object. */
static void try_balls(density_survey *s, uint32_t object, const double *centre, double radius) {
    double at[FROE_MAX_DIM];
    for (uint64_t try = 0; try < TRIES && s->near.count > s->out.lower; try++) {
        uint64_t key = base_hash(s->keys[object], 0, try);
        bool between = try % 3 != 0;
        uint32_t chosen = object;
        uint64_t least = UINT64_MAX;
        for (size_t i = 0; i < s->near.count && between; i++) { /* of N(o) that with the least hash: in no order */
            uint64_t hash = base_mix(s->keys[s->near.data[i]] ^ key);
            if (hash < least || !i) least = hash, chosen = s->near.data[i];
        }
        size_t of = (size_t)chosen * (size_t)s->objects.dim;
        for (size_t k = 0; k < (size_t)s->objects.dim; k++) { /* a point of its box, at random */
            double share = (double)(base_hash(key, 1, k) >> 11) * 0x1p-53;
            at[k] = s->bounds.lo[of + k] * (1 - share) + s->bounds.hi[of + k] * share;
            if (between) at[k] = 0.5 * at[k] + 0.5 * centre[k];
        }
        try_ball(s, at, radius);
    }
}

/* Finds N(o), in s->near, and the ball around the object. */
static bool look_around(density_survey *s, uint32_t object, measure_ball *ball, double *radius) {
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    *radius = s->kind == FROE_SIZE_RADIUS ? s->size[object] : 0.5 * s->size[object];
    *ball = measure_enclosing(s->sample.scene, object);
    const double reach = (3 * *radius + fmax(0, ball->radius - *radius)) * (1 + 0x1p-40); /* 3 r, rounded up */
    for (int k = 0; k < s->objects.dim; k++) lo[k] = ball->centre[k] - reach, hi[k] = ball->centre[k] + reach;
    measure_search search = measure_search_begin(&s->objects, lo, hi, s->size[object]);
    s->near.count = 0;
    for (uint32_t i; (i = measure_search_next(&search)) != FROE_NONE;)
        if (is_within_radius(s, ball->centre, reach, i) && !array_push(&s->sample.alloc, &s->near, i)) return false;
    return true;
}

static froe_status begin_density(density_survey *s) {
    const froe_scene *scene = s->sample.scene;
    const froe_allocator *alloc = &s->sample.alloc;
    size_t n = scene->object_count;
    froe_status status = geom_context_new(alloc, &s->context);
    if (!status) status = measure_bounds_new(&s->sample, &s->bounds);
    if (status) return status;
    s->size = support_calloc(alloc, n, sizeof *s->size);
    s->keys = support_calloc(alloc, n, sizeof *s->keys);
    if (!s->size || !s->keys) return FROE_E_MEMORY;
    for (uint32_t i = 0; i < n; i++) {
        s->keys[i] = measure_sample_key(&s->sample, i);
        s->size[i] = s->kind == FROE_SIZE_RADIUS ? measure_enclosing(scene, i).radius : measure_diameter(scene, i);
    }
    return measure_hierarchy_new(alloc, scene->dim, (uint32_t)n, s->bounds.lo, s->bounds.hi, s->size, &s->objects);
}

froe_status froe_measure_density(const froe_scene *scene, froe_size size, const froe_measure_options *options,
                                 froe_density *out, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (size != FROE_SIZE_RADIUS && size != FROE_SIZE_DIAMETER)
        return support_fail(diag, FROE_E_ARG, "There is no size of number %d.", (int)size);
    density_survey s = {.kind = size};
    froe_status status = measure_sample_begin(scene, options, out, &s.sample, diag);
    if (status) return status;
    status = begin_density(&s);
    for (uint32_t i = 0; i < s.sample.count && !status; i++) {
        const uint32_t object = measure_sample_object(&s.sample, i);
        measure_ball ball;
        double radius;
        if (!measure_sample_go_on(&s.sample, i)) status = FROE_E_CANCELLED;
        if (!status && !look_around(&s, object, &ball, &radius)) status = FROE_E_MEMORY;
        if (status) break;
        const uint32_t count = (uint32_t)s.near.count;
        if (count > s.out.upper) s.out.upper = count;
        if (count > s.out.lower) try_ball(&s, ball.centre, radius);
        if (!array_push(&s.sample.alloc, &s.sample.values[0], count)) status = FROE_E_MEMORY;
        const candidate new = {count, object, s.keys[object]};
        uint32_t at = s.best_count < TRIED ? s.best_count++ : TRIED;
        for (; at; at--) { /* behind all that are better */
            const candidate *c = s.best + at - 1;
            if (c->load > new.load || (c->load == new.load && c->key <= new.key)) break;
            if (at < TRIED) s.best[at] = *c;
        }
        if (at < TRIED) s.best[at] = new;
    }
    for (uint32_t i = 0; i < s.best_count && s.best[i].load > s.out.lower && !status; i++) {
        measure_ball ball;
        double radius;
        if (look_around(&s, s.best[i].object, &ball, &radius))
            try_balls(&s, s.best[i].object, ball.centre, radius);
        else
            status = FROE_E_MEMORY;
    }
    s.out.count = s.sample.count;
    if (!status) status = measure_sample_spread(&s.sample, 0, &s.out.load);
    if (!status) *out = s.out;
    const size_t n = scene->object_count;
    if (s.context.alloc.fn) num_context_free(&s.context);
    measure_bounds_free(&s.sample, &s.bounds);
    support_free(&s.sample.alloc, s.size, n ? n * sizeof *s.size : 1);
    support_free(&s.sample.alloc, s.keys, n ? n * sizeof *s.keys : 1);
    measure_hierarchy_free(&s.objects);
    array_free(&s.sample.alloc, &s.near);
    return measure_sample_end(&s.sample, status, diag);
}
