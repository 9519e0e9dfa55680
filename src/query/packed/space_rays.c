/* space_rays.c: the first hit of rays, or any hit: of one ray, or of many, of which others go on while one waits for
 * memory.
 *
 *     ray 0   [node] ........ [node] ........ [leaf] ........ [object] ........ [decided]
 *     ray 1     [node] ........ [leaf] ........ [node] ........ [leaf] ........ [node]
 *     ray 2       [node] ....
 *
 * Where the tree fits into the caches, rays are answered one after the other.
 *
 * Each ray in turn takes one step of its walk (space_walk.c) and prefetches what its next step needs. The points of an
 * object are prefetched before the object is decided. Answers do not depend on the other rays of the batch: each ray
 * has a walk and a limit of its own. */
#include "query/packed/space.h"
#include "support/fail.h"
#include <string.h>

enum { RAYS_AT_ONCE = 12 };
/** A ray in progress. */
struct space_ray_state {
    space_walk walk;
    geom_ray ray;
    double limit;
    query_met best;   /* object FROE_NONE: none so far */
    uint32_t pending; /* an object to be decided; FROE_NONE: none */
    bool walked;      /* only hits are left */
    size_t at;        /* of the ray among all */
};

typedef struct ray_batch {
    froe_query *query;
    const double *origins, *directions;
    double t_max;
    froe_hit *hits;
    uint32_t *objects;
    size_t count, next;
    froe_diagnostic *diag;
} ray_batch;

void space_batch_free(space_ray_state *rays, const froe_allocator *alloc) {
    if (!rays) return;
    for (int i = 0; i < RAYS_AT_ONCE; i++) {
        array_free(alloc, &rays[i].walk.stack);
        array_free(alloc, &rays[i].walk.hits);
    }
    support_free(alloc, rays, RAYS_AT_ONCE * sizeof *rays);
}

/* Begins the next ray; *flies false: none is left. */
static froe_status launch_ray(ray_batch *f, space_ray_state *r, bool *flies) {
    *flies = false;
    while (f->next < f->count) {
        r->at = f->next++;
        r->ray.dim = 3;
        const double *origin = f->origins + 3 * r->at, *direction = f->directions + 3 * r->at;
        memcpy(r->ray.o, origin, 3 * sizeof *origin);
        memcpy(r->ray.d, direction, 3 * sizeof *direction);
        r->limit = f->t_max;
        r->best.object = r->pending = FROE_NONE;
        r->walked = false;
        const space_wanted wanted = f->hits ? SPACE_FIRST : SPACE_ANY;
        if (space_walk_ray(f->query, &r->walk, &r->ray, f->t_max, wanted, flies)) return support_fail_memory(f->diag);
        if (*flies) break;
        /* A ray whose numbers single precision cannot hold: the general walk answers it. */
        const froe_status status =
            query_ray_walked(f->query, origin, direction, f->t_max, f->hits ? f->hits + r->at : NULL,
                             f->hits ? NULL : f->objects + r->at, f->diag);
        if (status) return status;
    }
    f->query->stats.queries += *flies;
    return FROE_OK;
}

/* Decides an object exactly. */
static void decide_object(const ray_batch *f, space_ray_state *r, uint32_t object) {
    query_met met;
    if (object == r->best.object || !query_ray_meets(f->query, &r->ray, object, f->t_max, &met)) return;
    if (r->best.object != FROE_NONE && !query_ray_nearer(f->query, &r->ray, &met, &r->best)) return;
    r->best = met;
    const double limit = query_ray_latest(&met.hit);
    if (limit < r->limit) r->limit = limit;
}

/* The first of the hits of the walk and the best so far. One hit alone is the first, without a decision. */
static void decide_hits(const ray_batch *f, space_ray_state *r) {
    const space_hit *hits = r->walk.hits.data;
    const size_t count = r->walk.hits.count;
    bool alone = r->best.object == FROE_NONE;
    for (size_t i = 1; i < count && alone; i++) alone = hits[i].object == hits[0].object;
    if (alone) {
        const geom_body body = scene_body(f->query->tree->scene, hits[0].object);
        r->best = (query_met){geom_ray_through(&body), hits[0].object};
        return;
    }
    for (size_t i = 0; i < count; i++) decide_object(f, r, hits[i].object);
}

/* Decides the object that is pending, then takes a step. SPACE_END: the ray is answered. */
static space_step step_ray(const ray_batch *f, space_ray_state *r, bool alone) {
    const froe_scene *scene = f->query->tree->scene;
    if (r->walked) {
        decide_hits(f, r);
        return SPACE_END;
    }
    if (r->pending != FROE_NONE) decide_object(f, r, r->pending);
    r->pending = FROE_NONE;
    if (!f->hits && r->best.object != FROE_NONE) return SPACE_END;
    space_step did = space_walk_step(f->query, &r->walk, r->limit, alone);
    if (did == SPACE_MET) r->best.object = r->walk.object;
    if (did == SPACE_OBJECT) scene_ask_points(scene, r->pending = r->walk.object);
    r->walked = did == SPACE_END && space_walk_settle(&r->walk, r->limit);
    for (size_t i = 0; r->walked && i < r->walk.hits.count; i++) scene_ask_points(scene, r->walk.hits.data[i].object);
    return did == SPACE_NO_MEMORY ? did : did == SPACE_MET || (did == SPACE_END && !r->walked) ? SPACE_END : SPACE_ON;
}

static void answer_ray(const ray_batch *f, const space_ray_state *r) {
    if (f->objects) f->objects[r->at] = r->best.object;
    if (!f->hits) return;
    f->hits[r->at] = (froe_hit){.object = r->best.object};
    if (r->best.object != FROE_NONE) f->hits[r->at].t = geom_hit_round(&f->query->numbers, &r->ray, &r->best.hit);
}

/* One ray after the other, each up to its end. */
static froe_status answer_alone(ray_batch *f, space_ray_state *r) {
    bool flies;
    froe_status status;
    while (!(status = launch_ray(f, r, &flies)) && flies) {
        space_step did = SPACE_ON;
        while (did == SPACE_ON) did = step_ray(f, r, true);
        if (did == SPACE_NO_MEMORY) return query_failed(f->query, f->diag);
        answer_ray(f, r);
        if (f->next == f->count) break;
    }
    return status;
}

/* The next ray takes the place of one that is answered; where none is left, the last ray of the batch does. */
static froe_status answer_in_turns(ray_batch *f, space_ray_state *rays) {
    size_t flying = 0;
    bool flies = true;
    froe_status status = FROE_OK;
    for (; flying < RAYS_AT_ONCE && flies && !status; flying += flies) status = launch_ray(f, rays + flying, &flies);
    for (size_t i = 0; flying && !status; i = i + 1 < flying ? i + 1 : 0) {
        space_ray_state *r = rays + i;
        const space_step did = step_ray(f, r, false);
        if (did == SPACE_NO_MEMORY) return query_failed(f->query, f->diag);
        if (did != SPACE_END) continue;
        answer_ray(f, r);
        status = launch_ray(f, r, &flies);
        if (flies) continue;
        if (i == --flying) {
            i = 0;
            continue;
        }
        const space_ray_state gone = *r;
        *r = rays[flying];
        rays[flying] = gone;
    }
    return status;
}

froe_status space_ray_any(froe_query *q, const double *origin, const double *direction, double t_max, uint32_t *object,
                          froe_diagnostic *diag) {
    space_walk *w = &q->space->walk;
    geom_ray *ray = &q->ray.ray;
    query_met met;
    bool begun;
    ray->dim = 3;
    memcpy(ray->o, origin, 3 * sizeof *origin);
    memcpy(ray->d, direction, 3 * sizeof *direction);
    if (space_walk_ray(q, w, ray, t_max, SPACE_ANY, &begun)) return support_fail_memory(diag);
    if (!begun) return query_ray_walked(q, origin, direction, t_max, NULL, object, diag);
    const uint64_t exact = q->numbers.stats.exact;
    space_step step;
    q->stats.queries++;
    while ((step = space_walk_step(q, w, t_max, true)) == SPACE_OBJECT)
        if (query_ray_meets(q, ray, w->object, t_max, &met)) break;
    q->stats.exact += q->numbers.stats.exact - exact;
    if (step == SPACE_NO_MEMORY) return query_failed(q, diag);
    *object = step == SPACE_END ? FROE_NONE : w->object;
    return FROE_OK;
}

froe_status space_rays(froe_query *q, const double *origins, const double *directions, size_t count, double t_max,
                       froe_hit *hits, uint32_t *objects, froe_diagnostic *diag) {
    const uint64_t exact = q->numbers.stats.exact;
    ray_batch f = {q, origins, directions, t_max, hits, objects, count, 0, diag};
    if (!q->space->batch) q->space->batch = support_calloc(&q->alloc, RAYS_AT_ONCE, sizeof *q->space->batch);
    if (!q->space->batch) return support_fail_memory(diag);
    space_ray_state *rays = q->space->batch;
    const tree_packed *packed = &q->tree->packed;
    const uint64_t bytes = (uint64_t)packed->block_count * PACKED_BLOCK + packed->wide->count * sizeof(wide_node);
    const bool alone = count == 1 || bytes < q->space->turns_from[hits != NULL];
    const froe_status status = alone ? answer_alone(&f, rays) : answer_in_turns(&f, rays);
    q->stats.exact += q->numbers.stats.exact - exact;
    return status;
}
