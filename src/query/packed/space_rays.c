/* space_rays.c: rays in batches: while one waits for memory, others go on.
 *
 *     ray 0   [node] ........ [node] ........ [leaf] ........ [object] ........ [decided]
 *     ray 1     [node] ........ [leaf] ........ [node] ........ [leaf] ........ [node]
 *     ray 2       [node] ....
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
    for (int i = 0; i < RAYS_AT_ONCE; i++) array_free(alloc, &rays[i].walk.stack);
    support_free(alloc, rays, RAYS_AT_ONCE * sizeof *rays);
}

/* Begins the next ray; *flies false: none is left. */
static froe_status launch_ray(ray_batch *f, space_ray_state *r, bool *flies) {
    *flies = false;
    while (f->next < f->count && !*flies) {
        r->at = f->next++;
        r->ray = (geom_ray){.dim = 3};
        memcpy(r->ray.o, f->origins + 3 * r->at, 3 * sizeof(double));
        memcpy(r->ray.d, f->directions + 3 * r->at, 3 * sizeof(double));
        r->limit = f->t_max;
        r->best.object = r->pending = FROE_NONE;
        if (space_walk_ray(f->query, &r->walk, &r->ray, flies)) return support_fail_memory(f->diag);
        if (*flies) break;
        /* A ray whose numbers single precision cannot hold: the general walk answers it. */
        const double *o = r->ray.o, *d = r->ray.d;
        const froe_status status = f->hits ? froe_query_ray(f->query, o, d, f->t_max, f->hits + r->at, f->diag)
                                           : froe_query_ray_any(f->query, o, d, f->t_max, f->objects + r->at, f->diag);
        if (status) return status;
    }
    f->query->stats.queries += *flies;
    return FROE_OK;
}

/* Decides the object that is pending exactly, then takes a step. SPACE_END: the ray is answered. */
static space_step step_ray(const ray_batch *f, space_ray_state *r) {
    const uint32_t object = r->pending;
    query_met met;
    r->pending = FROE_NONE;
    if (object != FROE_NONE && object != r->best.object && query_ray_meets(f->query, &r->ray, object, f->t_max, &met) &&
        (r->best.object == FROE_NONE || query_ray_nearer(f->query, &r->ray, &met, &r->best))) {
        r->best = met;
        const double limit = query_ray_latest(&met.hit);
        if (limit < r->limit) r->limit = limit;
        if (!f->hits) return SPACE_END;
    }
    const space_step did = space_walk_step(f->query, &r->walk, r->limit);
    if (did != SPACE_OBJECT) return did;
    r->pending = r->walk.object;
    scene_ask_points(f->query->tree->scene, r->pending);
    return SPACE_ON;
}

froe_status space_rays(froe_query *q, const double *origins, const double *directions, size_t count, double t_max,
                       froe_hit *hits, uint32_t *objects, froe_diagnostic *diag) {
    const uint64_t exact = q->numbers.stats.exact;
    ray_batch f = {q, origins, directions, t_max, hits, objects, count, 0, diag};
    if (!q->space->batch) q->space->batch = support_calloc(&q->alloc, RAYS_AT_ONCE, sizeof *q->space->batch);
    if (!q->space->batch) return support_fail_memory(diag);
    /* The next ray takes the place of one that is answered; where none is left, the last ray of the batch does. */
    space_ray_state *rays = q->space->batch;
    size_t flying = 0;
    bool flies = true;
    froe_status status = FROE_OK;
    for (; flying < RAYS_AT_ONCE && flies && !status; flying += flies) status = launch_ray(&f, rays + flying, &flies);
    for (size_t i = 0; flying && !status; i = i + 1 < flying ? i + 1 : 0) {
        space_ray_state *r = rays + i;
        const space_step did = step_ray(&f, r);
        if (did == SPACE_NO_MEMORY) return support_fail_memory(diag);
        if (did != SPACE_END) continue;
        if (objects) objects[r->at] = r->best.object;
        if (hits) hits[r->at] = (froe_hit){.object = r->best.object};
        if (hits && r->best.object != FROE_NONE) hits[r->at].t = geom_hit_round(&q->numbers, &r->ray, &r->best.hit);
        status = launch_ray(&f, r, &flies);
        if (flies || status) continue;
        const space_ray_state gone = *r;
        *r = rays[--flying];
        rays[flying] = gone;
        if (i == flying) i = 0;
    }
    q->stats.exact += q->numbers.stats.exact - exact;
    return status;
}
