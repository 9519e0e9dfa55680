/* near_space.c: the one nearest object of a packed tree of space.
 *
 * Objects that the walk is sure of wait for its end. By then one or two are left as a rule, of which the squares of
 * distances tell the nearest. So there is no heap here, and no table of objects that were looked at already. */
#include "query/context.h"
#include "query/packed/space.h"

/* Hits among which an object of several leaves is looked for; further ones are measured again. */
enum { REPEATED = 16 };

/* Distances are not scaled: the coordinates of these trees leave room for squares. */
static double limit_at_distance(const query_near *n, const geom_distance *d) {
    if (d->radius == 0) return (d->square.x + d->square.e) * (1 + 0x1p-50);
    const num_ball image = geom_distance_image(d);
    return query_near_square(n, image.x + image.e);
}

/* Takes an object in place of the best so far, if it is nearer, and within the bound. Triangles side by side often have
 * their nearest corner or edge in common: it is measured once. */
static void take_nearer(froe_query *q, uint32_t object, double bound) {
    query_near *n = &q->near;
    query_neighbour *best = n->order.count ? n->found.data + n->order.data[0] : NULL;
    if (best && best->object == object) return;
    const geom_body body = scene_body(q->tree->scene, object);
    q->stats.tests++;
    if (best && geom_distance_shared(&q->numbers, n->point, &body, &best->distance)) {
        if (object < best->object) best->object = object;
        return;
    }
    query_neighbour *x = n->found.data + n->found.count;
    x->object = object;
    x->distance = geom_distance_from(&q->numbers, n->point, &body);
    if (geom_distance_compare_to(&q->numbers, n->point, &x->distance, bound) > 0) return;
    if (best) {
        const int order = geom_distance_compare(&q->numbers, n->point, &x->distance, &best->distance);
        if (order > 0 || (order == 0 && object > best->object)) return;
    }
    n->order.data[0] = (uint32_t)n->found.count;
    n->found.count = !n->found.count; /* the other of two places */
    n->order.count = 1;
    const double limit = limit_at_distance(n, &x->distance);
    if (limit < n->limit) n->limit = limit;
}

/* Is it one of the few hits before, of another leaf? */
static bool is_repeated(const space_hit *hit, size_t before) {
    const size_t few = before < REPEATED ? before : REPEATED;
    bool repeated = false;
    for (size_t i = 1; i <= few; i++) repeated |= hit[-(ptrdiff_t)i].object == hit->object;
    return repeated;
}

froe_status query_near_in_space(froe_query *q, double bound, bool *done) {
    query_near *n = &q->near;
    *done = false;
    if (!q->space) return FROE_OK;
    space_walk *w = &q->space->walk;
    n->scale = 1;
    if (space_walk_near(q, w, SPACE_FIRST, done)) return FROE_E_MEMORY;
    if (!*done) return FROE_OK;
    if (!array_reserve(&q->alloc, &n->found, 2) || !array_reserve(&q->alloc, &n->order, 1)) return FROE_E_MEMORY;
    if (bound < INFINITY) n->limit = query_near_square(n, bound);
    space_step step;
    while ((step = space_walk_step(q, w, n->limit, true)) == SPACE_OBJECT) take_nearer(q, w->object, bound);
    if (step == SPACE_NO_MEMORY) return FROE_E_MEMORY;
    space_walk_settle(w, n->limit);
    for (size_t i = 1; i < w->hits.count; i++) scene_ask_points(q->tree->scene, w->hits.data[i].object);
    for (size_t i = 0; i < w->hits.count; i++) {
        const space_hit *hit = w->hits.data + i;
        if (!is_repeated(hit, i) && space_walk_reaches(w, n->limit, hit->key)) take_nearer(q, hit->object, bound);
    }
    return FROE_OK;
}
