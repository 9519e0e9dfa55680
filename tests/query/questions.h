/* questions.h: every question there is, to any tree whose objects lie in about [0, 1]^dim, and what comes out as one
 * number. */
#ifndef FROE_TESTS_QUERY_QUESTIONS_H
#define FROE_TESTS_QUERY_QUESTIONS_H
#include "query/context.h"
#include "tree/trees.h"
#include <froe/query.h>
#include <math.h>

enum { QUESTIONS_EACH = 6 }; /* places that each question is asked about */

/** What came out so far (FNV-1a). */
typedef uint64_t told;

static inline void tell(told *t, const void *bytes, size_t count) {
    for (size_t i = 0; i < count; i++) *t = (*t ^ ((const unsigned char *)bytes)[i]) * 0x100000001b3u;
}
static inline void tell_list(told *t, froe_status status, const froe_list *list) {
    if (status == FROE_OK) tell(t, list->ids, list->count * sizeof *list->ids);
}
static inline void tell_answers(told *t, froe_status status, froe_answers *a) {
    if (status) return;
    tell(t, a->starts, (a->queries + 1) * sizeof *a->starts);
    tell(t, a->ids, a->starts[a->queries] * sizeof *a->ids);
    if (a->values) tell(t, a->values, a->starts[a->queries] * sizeof *a->values);
    froe_answers_free(a);
}

/** The places: points, and twice as many as ends of boxes and rays. */
typedef struct places {
    double x[QUESTIONS_EACH * 2 * FROE_MAX_DIM], way[QUESTIONS_EACH * 2 * FROE_MAX_DIM];
    froe_range ranges[QUESTIONS_EACH];
    size_t dim;
} places;

static inline places places_of(const froe_query *q) {
    places p = {.dim = (size_t)q->tree->scene->dim};
    for (size_t i = 0; i < sizeof p.x / sizeof *p.x; i++) {
        p.x[i] = trees_unit(5, i);
        p.way[i] = trees_unit(6, i) - 0.5;
    }
    for (size_t i = 0; i < QUESTIONS_EACH; i++) /* boxes */
        for (size_t k = 0; k < p.dim; k++) {
            double *at = p.x + 2 * i * p.dim + k;
            if (at[0] > at[p.dim]) {
                const double lo = at[p.dim];
                at[p.dim] = at[0], at[0] = lo;
            }
        }
    return p;
}

/** Ranges of one shape; p->x and p->way are their corners. */
static inline void places_take(places *p, froe_range_shape shape, froe_walk walk, double eps) {
    static const double offsets[] = {0.3, 0.6, 0.2, 0.7, 0.5, 0.4, 0.9, 0.1, 0.8, 0.35};
    for (size_t i = 0; i < QUESTIONS_EACH; i++) {
        froe_range *r = &p->ranges[i];
        *r = froe_range_defaults();
        r->shape = shape, r->walk = walk, r->eps = eps, r->radius = 0.1, r->count = 4, r->offsets = offsets + i % 3;
        r->points = shape == FROE_SHAPE_HALFSPACES ? p->way : p->x + 2 * i % 4 * p->dim;
        if (shape == FROE_SHAPE_BOX) r->points = p->x + 2 * i * p->dim;
    }
}

static inline froe_batch_options on_one_thread(void) {
    froe_batch_options o = froe_batch_defaults();
    o.threads = 1;
    return o;
}

typedef froe_status question_fn(froe_query *q, places *p, told *t);

static inline froe_status ask_ranges(froe_query *q, places *p, told *t) {
    froe_list list;
    uint64_t count = 0;
    uint32_t any = 0;
    for (size_t i = 0; i < QUESTIONS_EACH; i++) {
        froe_status status = froe_query_range(q, &p->ranges[i], &list, NULL);
        tell_list(t, status, &list);
        if (!status) status = froe_query_count(q, &p->ranges[i], &count, NULL);
        tell(t, &count, sizeof count);
        if (!status) status = froe_query_any(q, &p->ranges[i], &any, NULL);
        const bool none = any == FROE_NONE; /* any may be another one by another walk */
        tell(t, &none, sizeof none);
        if (status) return status;
    }
    return FROE_OK;
}

static inline froe_status ask_ranges_of_batches(froe_query *q, places *p, told *t) {
    froe_answers a;
    uint64_t counts[QUESTIONS_EACH] = {0};
    uint32_t any[QUESTIONS_EACH];
    const froe_batch_options o = on_one_thread();
    froe_status status = froe_batch_range(q, p->ranges, QUESTIONS_EACH, &o, &a, NULL);
    tell_answers(t, status, &a);
    if (!status) status = froe_batch_count(q, p->ranges, QUESTIONS_EACH, &o, counts, NULL);
    tell(t, counts, sizeof counts);
    if (!status) status = froe_batch_any(q, p->ranges, QUESTIONS_EACH, &o, any, NULL);
    if (!status) status = froe_batch_boxes(q, p->x, QUESTIONS_EACH, &o, &a, NULL);
    tell_answers(t, status, &a);
    return status;
}

/* What answers for one point, and for many. */
typedef froe_status point_fn(froe_query *q, const double *point, froe_list *out, froe_diagnostic *diag);
typedef froe_status points_fn(froe_query *q, const double *points, size_t count, const froe_batch_options *options,
                              froe_answers *out, froe_diagnostic *diag);
static inline froe_status ask_places(froe_query *q, places *p, told *t, point_fn *one, points_fn *many) {
    froe_list list;
    froe_answers a;
    const froe_batch_options o = on_one_thread();
    froe_status status = FROE_OK;
    for (size_t i = 0; i < QUESTIONS_EACH && !status; i++) {
        status = one(q, p->x + i * p->dim, &list, NULL);
        tell_list(t, status, &list);
    }
    if (!status) status = many(q, p->x, QUESTIONS_EACH, &o, &a, NULL);
    tell_answers(t, status, &a);
    return status;
}
static inline froe_status ask_points(froe_query *q, places *p, told *t) {
    return ask_places(q, p, t, froe_query_locate, froe_batch_locate);
}
static inline froe_status ask_groups(froe_query *q, places *p, told *t) {
    return ask_places(q, p, t, froe_query_groups, froe_batch_groups);
}

static inline froe_status ask_relations(froe_query *q, places *p, told *t) {
    froe_list list;
    froe_answers a;
    const froe_batch_options o = on_one_thread();
    for (froe_relation r = 0; r < FROE_RELATION_COUNT; r++) {
        froe_status status = FROE_OK;
        for (size_t i = 0; i < QUESTIONS_EACH && !status; i++) {
            status = froe_query_groups_range(q, &p->ranges[i], r, &list, NULL);
            tell_list(t, status, &list);
        }
        if (!status) status = froe_batch_groups_range(q, p->ranges, QUESTIONS_EACH, r, &o, &a, NULL);
        tell_answers(t, status, &a);
        if (!status) status = froe_batch_groups_boxes(q, p->x, QUESTIONS_EACH, r, &o, &a, NULL);
        tell_answers(t, status, &a);
        if (status) return status;
    }
    return FROE_OK;
}

static inline froe_status ask_join(froe_query *q, places *p, told *t) {
    froe_answers a;
    const froe_batch_options o = on_one_thread();
    froe_status status = FROE_OK;
    (void)p;
    for (froe_relation r = 0; r < FROE_RELATION_COUNT && !status; r++) {
        status = froe_batch_groups_join(q, q, r, &o, &a, NULL);
        tell_answers(t, status, &a);
    }
    return status;
}

static inline froe_status ask_rays(froe_query *q, places *p, told *t) {
    froe_hit hits[QUESTIONS_EACH], hit;
    froe_hits all;
    froe_answers a;
    uint32_t any;
    froe_hit_place place;
    const froe_batch_options o = on_one_thread();
    froe_status status = FROE_OK;
    for (size_t i = 0; i < QUESTIONS_EACH && !status; i++) {
        const double *origin = p->x + i * p->dim, *way = p->way + i * p->dim;
        status = froe_query_ray(q, origin, way, INFINITY, &hit, NULL);
        if (!status) tell(t, &hit.object, sizeof hit.object), tell(t, &hit.t, sizeof hit.t);
        if (!status && hit.object != FROE_NONE) {
            status = froe_query_hit_place(q, hit.object, origin, way, &place, NULL);
            if (!status) tell(t, place.point, p->dim * sizeof *place.point);
        }
        if (!status) status = froe_query_ray_any(q, origin, way, INFINITY, &any, NULL);
        if (!status) status = froe_query_ray_all(q, origin, way, INFINITY, &all, NULL);
        for (size_t h = 0; !status && h < all.count; h++) tell(t, &all.hits[h].object, sizeof all.hits[h].object);
    }
    if (!status) status = froe_batch_ray(q, p->x, p->way, QUESTIONS_EACH, INFINITY, &o, hits, NULL);
    for (size_t i = 0; i < QUESTIONS_EACH && !status; i++) tell(t, &hits[i].object, sizeof hits[i].object);
    uint32_t many[QUESTIONS_EACH];
    if (!status) status = froe_batch_ray_any(q, p->x, p->way, QUESTIONS_EACH, INFINITY, &o, many, NULL);
    if (!status) status = froe_batch_ray_all(q, p->x, p->way, QUESTIONS_EACH, INFINITY, &o, &a, NULL);
    tell_answers(t, status, &a);
    return status;
}

static inline froe_status ask_verticals(froe_query *q, places *p, told *t) {
    uint32_t object, many[QUESTIONS_EACH];
    const froe_batch_options o = on_one_thread();
    froe_status status = FROE_OK;
    for (size_t i = 0; i < 2 * QUESTIONS_EACH && !status; i++) {
        status = froe_query_vertical(q, p->x + i / 2 * p->dim, i % 2 ? 1 : -1, &object, NULL);
        if (!status) tell(t, &object, sizeof object);
    }
    if (!status) status = froe_batch_vertical(q, p->x, QUESTIONS_EACH, 1, &o, many, NULL);
    if (!status) tell(t, many, sizeof many);
    return status;
}

static inline froe_status ask_neighbours(froe_query *q, places *p, told *t) {
    froe_neighbours near;
    froe_answers a;
    double point[FROE_MAX_DIM];
    const froe_batch_options o = on_one_thread();
    froe_status status = FROE_OK;
    for (size_t i = 0; i < 2 * QUESTIONS_EACH && !status; i++) {
        const double *x = p->x + i / 2 * p->dim;
        status = froe_query_near(q, x, i % 2 ? 1 : 5, i % 3 ? INFINITY : 0.3, &near, NULL);
        for (size_t n = 0; !status && n < near.count; n++) {
            tell(t, &near.items[n].object, sizeof near.items[n].object);
            tell(t, &near.items[n].distance, sizeof near.items[n].distance);
        }
        if (!status && near.count) status = froe_query_nearest_point(q, near.items[0].object, x, point, NULL);
        if (!status && near.count) tell(t, point, p->dim * sizeof *point);
    }
    if (!status) status = froe_batch_near(q, p->x, QUESTIONS_EACH, 3, INFINITY, &o, &a, NULL);
    tell_answers(t, status, &a);
    return status;
}

static inline bool tell_pair(void *user, const froe_pair *pair) {
    tell(user, &pair->a, sizeof pair->a), tell(user, &pair->b, sizeof pair->b),
        tell(user, &pair->kind, sizeof pair->kind);
    return true;
}
static inline froe_status ask_pairs(froe_query *q, places *p, told *t) {
    froe_pairs pairs;
    const froe_batch_options o = on_one_thread();
    told single = 0, batch = 0;
    (void)p;
    froe_status status = froe_query_pairs(q, true, tell_pair, &single, NULL);
    if (!status) status = froe_batch_pairs(q, true, &o, tell_pair, &batch, NULL);
    tell(t, &batch, sizeof batch);
    if (!status) status = froe_batch_pair_array(q, true, &o, &pairs, NULL);
    if (!status) {
        tell(t, &pairs.count, sizeof pairs.count);
        froe_pairs_free(&pairs);
    }
    return status;
}

static question_fn *const questions[] = {ask_points, ask_groups,     ask_rays,  ask_verticals,
                                         ask_join,   ask_neighbours, ask_pairs, ask_relations};
enum {
    QUESTIONS_PLAIN = sizeof questions / sizeof *questions,
    QUESTIONS_RANGES = FROE_SHAPE_COUNT * FROE_WALK_COUNT,
    QUESTIONS = QUESTIONS_PLAIN + 2 * QUESTIONS_RANGES + FROE_SHAPE_COUNT
};

/** Is there one answer to it? Ranges with eps > 0 have several. */
static inline bool question_is_exact(int which) {
    return which < QUESTIONS_PLAIN || which >= QUESTIONS_PLAIN + 2 * QUESTIONS_RANGES ||
           (which - QUESTIONS_PLAIN) % 2 == 0;
}

/** Asks question `which` of QUESTIONS; FROE_OK also where the tree does not serve it. */
static inline froe_status ask_question(froe_query *q, int which, told *t) {
    places p = places_of(q);
    froe_status status;
    if (which < QUESTIONS_PLAIN) {
        places_take(&p, FROE_SHAPE_SIMPLEX, FROE_WALK_AUTO, 0);
        status = questions[which](q, &p, t);
    } else if (which < QUESTIONS_PLAIN + 2 * QUESTIONS_RANGES) {
        const int at = which - QUESTIONS_PLAIN, range = at / 2;
        const froe_range_shape shape = (froe_range_shape)(range / FROE_WALK_COUNT);
        const bool near = at % 2 && shape != FROE_SHAPE_HALFSPACES && shape != FROE_SHAPE_RAY;
        places_take(&p, shape, (froe_walk)(range % FROE_WALK_COUNT), near ? 0.01 : 0);
        status = at % 2 ? ask_ranges(q, &p, t) : ask_ranges_of_batches(q, &p, t);
    } else {
        places_take(&p, (froe_range_shape)(which - QUESTIONS_PLAIN - 2 * QUESTIONS_RANGES), FROE_WALK_AUTO, 0);
        status = ask_relations(q, &p, t);
    }
    return status == FROE_E_UNSUPPORTED ? FROE_OK : status;
}
#endif
