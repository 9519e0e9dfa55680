/* pairs.c: which objects meet, and how?
 *
 * Objects that touch across a cut need not share a list, so each object in turn is asked for as a closed range,
 * which misses nothing (range_walk.c); of two that meet, the one with the lower id finds the other. How they meet is
 * then decided exactly (geom/contact.h). */
#include "base/status.h"
#include "geom/contact.h"
#include "query/context.h"
#include "query/heap.h"
#include "query/packed.h"
#include <string.h>

typedef struct search {
    froe_query *q;
    ARRAY(double) points;     /* of the object that asks */
    ARRAY(signed char) sides; /* for geom_contact_of() */
} search;

/* An object as a range. False without memory. */
static bool take(search *s, const geom_body *b, froe_range *range) {
    const size_t dim = (size_t)b->dim, count = b->form == FROE_POINT ? 2 : b->count;
    s->points.count = 0;
    if (!array_reserve(&s->q->alloc, &s->points, count * dim)) return false;
    for (uint32_t i = 0; i < count; i++)
        memcpy(s->points.data + i * dim, geom_body_point(b, b->form == FROE_POINT ? 0 : i), dim * sizeof(double));
    *range = froe_range_defaults();
    range->points = s->points.data;
    range->count = b->count;
    range->radius = b->radius;
    range->shape = b->form == FROE_BALL                              ? FROE_SHAPE_BALL
                   : b->form == FROE_SEGMENT                         ? FROE_SHAPE_SEGMENT
                   : b->form == FROE_HULL || b->form == FROE_POLYGON ? FROE_SHAPE_HULL
                                                                     : FROE_SHAPE_BOX;
    return true;
}

static bool greater(void *user, uint32_t a, uint32_t b) {
    (void)user;
    return a > b;
}

/* Keeps what was found with an id above that of the object, in order. */
static void keep_later(froe_query *q, uint32_t object) {
    size_t kept = 0;
    for (size_t i = 0; i < q->found.count; i++)
        if (q->found.data[i] > object) q->found.data[kept++] = q->found.data[i];
    q->found.count = kept;
    query_heap_sort(q->found.data, kept, greater, NULL);
}

/* Tells the pairs of one object with later ones; *more: does the caller want others? */
static froe_status tell(search *s, uint32_t object, const geom_body *a, bool shared, froe_pair_fn *fn, void *user,
                        bool *more) {
    static const froe_meeting kinds[GEOM_CONTACTS] = {
        [GEOM_CROSS] = FROE_MEET_CROSS, [GEOM_TOUCH] = FROE_MEET_TOUCH, [GEOM_OVERLAP] = FROE_MEET_OVERLAP};
    froe_query *q = s->q;
    for (size_t i = 0; i < q->found.count && *more; i++) {
        const geom_body b = scene_body(q->tree->scene, q->found.data[i]);
        s->sides.count = 0;
        if (!array_reserve(&q->alloc, &s->sides, (size_t)a->count + b.count)) return FROE_E_MEMORY;
        const geom_contact c = geom_contact_of(&q->numbers, a, &b, s->sides.data);
        if (!shared && c.kind == GEOM_TOUCH && c.touch == GEOM_TOUCH_AT_CORNER) continue;
        *more = fn(user, &(froe_pair){object, q->found.data[i], kinds[c.kind]});
    }
    return FROE_OK;
}

static froe_status find(search *s, bool shared, froe_pair_fn *fn, void *user, froe_diagnostic *diag) {
    const froe_scene *scene = s->q->tree->scene;
    froe_status status = FROE_OK;
    bool more = true;
    for (uint32_t i = 0; i < scene->object_count && more && !status; i++) {
        const geom_body body = scene_body(scene, i);
        froe_range range;
        if (!take(s, &body, &range)) return base_fail_memory(diag);
        status = query_range_ask(s->q, &range, false, diag);
        if (status) return status;
        keep_later(s->q, i);
        if (tell(s, i, &body, shared, fn, user, &more)) return base_fail_memory(diag);
    }
    return status;
}

froe_status froe_query_pairs(froe_query *query, bool shared, froe_pair_fn *fn, void *user, froe_diagnostic *diag) {
    if (!query || !fn) return base_fail(diag, FROE_E_ARG, "froe_query_pairs: NULL argument.");
    froe_status status = query->packed ? packed_pairs(query, shared, fn, user) : FROE_E_LIMIT;
    if (status != FROE_E_LIMIT) return status ? base_fail_memory(diag) : FROE_OK;
    search s = {.q = query};
    status = find(&s, shared, fn, user, diag);
    array_free(&query->alloc, &s.points);
    array_free(&query->alloc, &s.sides);
    return status;
}
