/* space_walk.c: objects along a ray, or around a point, in the order of lower bounds.
 *
 * In the coordinates of the wide tree the scene is within [-1/2, 1/2]. A ray o + t d becomes o' + u d' with u = t *
 * per, by powers of 2 alone but for o' = (o - middle) * scale; keys are u - start, where it comes to the scene. */
#include "query/packed/space.h"
#include "tree/list.h"
#include <float.h>
#include <math.h>
#include <string.h>

enum { MOST_SORTED = 64 };
/* Smaller trees are in the caches: rays hardly wait, and turns cost up to a quarter. A first hit reads corners, too. */
enum { BYTES_CACHED_ANY = 16 << 20, BYTES_CACHED_FIRST = 4 << 20 };

froe_status space_work_new(const froe_tree *t, space_work **out) {
    *out = support_calloc(&t->alloc, 1, sizeof **out);
    if (!*out) return FROE_E_MEMORY;
    (*out)->kernels = space_kernels_at(0);
    (*out)->turns_from[0] = BYTES_CACHED_ANY;
    (*out)->turns_from[1] = BYTES_CACHED_FIRST;
    return FROE_OK;
}

void space_work_free(space_work *work, const froe_allocator *alloc) {
    if (!work) return;
    space_batch_free(work->batch, alloc);
    array_free(alloc, &work->walk.stack);
    array_free(alloc, &work->walk.hits);
    array_free(alloc, &work->objects);
    array_free(alloc, &work->nodes);
    array_free(alloc, &work->leaves);
    array_free(alloc, &work->keys);
    array_free(alloc, &work->ends);
    support_free(alloc, work, sizeof *work);
}

/* ------------------------------------------------------------------- begin -- */

static froe_status begin_space_walk(froe_query *q, space_walk *w, bool near, bool meets) {
    w->near = near;
    w->told = -1;
    w->limit = (float)INFINITY;
    w->stack.count = w->hits.count = 0;
    return !meets || array_push(&q->alloc, &w->stack, 0) ? FROE_OK : FROE_E_MEMORY;
}

/* The least power of 2 above x > 0, and 1 by it, if nothing of that is denormal. */
static void powers_of_2(double x, double *above, double *inverse) {
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    const uint64_t exponent = (bits >> 52) + 1, of_both[2] = {exponent << 52, (2046 - exponent) << 52};
    memcpy(above, of_both, sizeof *above);
    memcpy(inverse, of_both + 1, sizeof *inverse);
}

/* Along which axis the ray moves most, and by how much along the others meanwhile. */
static void shear_ray(space_ray *r) {
    const double x = fabs(r->d[0]), y = fabs(r->d[1]), z = fabs(r->d[2]);
    const int up = (z > x) & (z > y), last = 2 * up | (!up & (y > x)); /* without a branch */
    r->axis[0] = last == 0;
    r->axis[1] = 2 - (last == 2);
    r->axis[2] = last;
    r->largest = r->d[last];
    for (int i = 0; i < 2; i++) r->shear[i] = r->d[r->axis[i]] * r->inverse[last];
}

/* A key that is certainly no later than t; -1: none is. */
static float key_within(const space_walk *w, double t) {
    const double start = w->ray.start, u = t * w->per;
    const double x = (u - 0x1p-20 * fabs(u - start) - 0x1p-50 * start - start) * (1 - 0x1p-22) - (double)FLT_MIN;
    return isinf(t) ? FLT_MAX : x > 0 ? x < FLT_MAX ? (float)x : FLT_MAX : -1;
}

froe_status space_walk_ray(froe_query *q, space_walk *w, const geom_ray *ray, double t_max, space_wanted wanted,
                           bool *begun) {
    space_ray *r = &w->ray;
    double most = 0, size, per;
    bool meets = false;
    for (int k = 0; k < 3; k++) most = fabs(ray->d[k]) > most ? fabs(ray->d[k]) : most;
    r->wide = q->tree->packed.wide;
    *begun = r->wide && most > 0x1p-300 && most < 0x1p299;
    if (!*begun) return FROE_OK;
    powers_of_2(most, &size, &per);
    *begun = q->space->kernels->aim(r, ray->o, ray->d, per, &meets);
    if (!*begun) return FROE_OK;
    shear_ray(r);
    w->per = r->wide->scale * size;
    w->wanted = wanted;
    w->within = key_within(w, t_max);
    r->any = wanted == SPACE_ANY ? w->within : -1;
    return begin_space_walk(q, w, false, meets);
}

froe_status space_walk_near(froe_query *q, space_walk *w, space_wanted wanted, bool *begun) {
    const tree_wide *wide = q->tree->packed.wide;
    space_point *p = &w->point;
    *begun = wide;
    p->wide = wide;
    p->one = wanted == SPACE_FIRST;
    for (int k = 0; *begun && k < 3; k++) {
        p->x[k] = q->near.point[k];
        p->at[k] = (p->x[k] - wide->middle[k]) * wide->scale;
        *begun = fabs(p->at[k]) <= 0x1p10;
    }
    if (!*begun) return FROE_OK;
    w->per = (wide->scale / q->near.scale) * (wide->scale / q->near.scale);
    w->wanted = wanted;
    w->within = FLT_MAX;
    return begin_space_walk(q, w, true, true);
}

/* -------------------------------------------------------------------- limit -- */

static void lower_limit(space_walk *w, float limit) {
    if (limit < w->limit) w->limit = limit;
}

/* The caller's limit may have fallen; for keys it is rounded up. */
static void update_limit(space_walk *w, double limit) {
    if (limit == w->told) return;
    const double start = w->near ? 0 : w->ray.start;
    double x = limit * w->per;
    w->told = limit;
    x = x + 0x1p-20 * fabs(x - start) + 0x1p-50 * start - start;
    lower_limit(w, x < 0 ? -1 : x < FLT_MAX ? (float)(x * (1 + 0x1p-22)) + FLT_MIN : (float)INFINITY);
}

/* -------------------------------------------------------------------- stack -- */

/* The last entries, so that the least is on top; not of many, for which any order will do. */
static void sort_top(space_walk *w, size_t from) {
    uint64_t *e = w->stack.data;
    if (w->stack.count - from > MOST_SORTED) return;
    for (size_t i = from + 1; i < w->stack.count; i++) {
        const uint64_t x = e[i];
        size_t j = i;
        for (; j > from && e[j - 1] < x; j--) e[j] = e[j - 1];
        e[j] = x;
    }
}

/* Replaces nodes along a ray, until a leaf or an object is on top; or one of them. False without memory. */
static bool descend_along_ray(froe_query *q, space_walk *w, bool once) {
    uint64_t nodes = 0;
    if (!array_reserve(&q->alloc, &w->stack, w->ray.wide->levels * SPACE_ROOM)) return false;
    w->stack.count =
        q->space->kernels->ray_nodes(q->tree, &w->ray, w->limit, once, w->stack.data, w->stack.count, &nodes);
    q->stats.nodes += nodes;
    return true;
}

/* Replaces a node by its children within the limit. The least comes on top, and is prefetched; of few that wait the
 * others need no order, as the first leaf lowers the limit, and most are never read. False without memory. */
static bool push_near_children(froe_query *q, space_walk *w, uint32_t index) {
    const wide_node *n = q->tree->packed.wide->nodes + index;
    float keys[PACKED_LANES];
    if (!array_reserve(&q->alloc, &w->stack, PACKED_LANES)) return false;
    uint64_t *e = w->stack.data + w->stack.count;
    uint64_t least = UINT64_MAX;
    size_t count = 0, at = 0;
    for (uint32_t bits = q->space->kernels->near_node(n, &w->point, w->limit, keys); bits; bits &= bits - 1) {
        const uint32_t i = (uint32_t)__builtin_ctz(bits);
        const uint64_t entry = space_entry(keys[i], n->child[i]);
        at = entry < least ? count : at;
        least = entry < least ? entry : least;
        e[count++] = entry;
    }
    q->stats.nodes++;
    w->stack.count += count;
    if (!count) return true;
    space_prefetch(q->tree, (uint32_t)least);
    e[at] = e[count - 1];
    e[count - 1] = least;
    return true;
}

/* The object is certainly met, or this near, by the key `end`. */
static bool take_hit(froe_query *q, space_walk *w, uint32_t object, float key, float end) {
    lower_limit(w, end);
    const space_hit hit = {object, key, end};
    return array_push(&q->alloc, &w->hits, hit);
}

/* Replaces a leaf by its objects. SPACE_MET: any is wanted, and one is met. */
static space_step push_objects(froe_query *q, space_walk *w, uint32_t block, float key) {
    space_work *work = q->space;
    const space_header *h = space_block(q->tree, block);
    if (!query_leaf_is_good(q, block)) return SPACE_NO_MEMORY;
    const size_t room = h->count + PACKED_LANES, from = w->stack.count;
    if (!array_reserve(&q->alloc, &work->objects, room) || !array_reserve(&q->alloc, &work->keys, room) ||
        !array_reserve(&q->alloc, &work->ends, room) || !array_reserve(&q->alloc, &w->stack, room))
        return SPACE_NO_MEMORY;
    space_found found = {work->objects.data, work->keys.data, work->ends.data, 0};
    if (w->near && w->stack.count) space_prefetch(q->tree, (uint32_t)w->stack.data[w->stack.count - 1]); /* next */
    if (w->near)
        work->kernels->near(h, &w->point, key, w->limit, &found);
    else
        work->kernels->ray(h, &w->ray, key, w->limit, &found);
    q->stats.leaves++;
    for (size_t i = 0; i < found.count; i++) {
        w->object = found.objects[i];
        if (found.keys[i] > w->limit) continue;
        const bool sure = found.ends[i] <= w->within;
        if (sure && w->wanted == SPACE_ANY) return SPACE_MET;
        if (w->near) /* of many, few are measured */
            scene_ask(q->tree->scene, w->object);
        else
            scene_ask_points(q->tree->scene, w->object);
        if (!sure || w->wanted == SPACE_ALL)
            w->stack.data[w->stack.count++] = space_entry(found.keys[i], SPACE_ITEM_OBJECT | w->object);
        else if (!take_hit(q, w, w->object, found.keys[i], found.ends[i]))
            return SPACE_NO_MEMORY;
    }
    sort_top(w, from);
    return SPACE_ON;
}

/* Takes the entry on top, which is within the limit: an object is handed out; a node or a leaf is replaced by what may
 * be met of it. */
static space_step take_space_item(froe_query *q, space_walk *w, bool once) {
    const uint64_t top = w->stack.data[--w->stack.count];
    const uint32_t what = (uint32_t)top;
    w->object = what & WIDE_INDEX;
    if (what & WIDE_LEAF) return push_objects(q, w, w->object, space_key(top));
    if (what & SPACE_ITEM_OBJECT) return SPACE_OBJECT;
    if (w->near) return push_near_children(q, w, what) ? SPACE_ON : SPACE_NO_MEMORY;
    w->stack.count++;
    return descend_along_ray(q, w, once) ? SPACE_ON : SPACE_NO_MEMORY;
}

/* Drops entries beyond the limit. False: none is left. */
static bool settle_item(space_walk *w) {
    while (w->stack.count && space_key(w->stack.data[w->stack.count - 1]) > w->limit) w->stack.count--;
    return w->stack.count;
}

/* Up to an object that is handed out, or the end. */
static space_step step_alone(froe_query *q, space_walk *w) {
    space_step step = SPACE_ON;
    while (step == SPACE_ON && w->stack.count) {
        const uint64_t top = w->stack.data[w->stack.count - 1];
        if (space_key(top) > w->limit)
            settle_item(w);
        else
            step = take_space_item(q, w, false);
    }
    return step == SPACE_ON ? SPACE_END : step;
}

space_step space_walk_step(froe_query *q, space_walk *w, double limit, bool alone) {
    update_limit(w, limit);
    if (alone) return step_alone(q, w);
    if (!settle_item(w)) return SPACE_END;
    const space_step step = take_space_item(q, w, true);
    if (step == SPACE_ON && settle_item(w)) space_prefetch(q->tree, (uint32_t)w->stack.data[w->stack.count - 1]);
    return step;
}

froe_status space_walk_next(froe_query *q, space_walk *w, double limit, tree_objects *list) {
    const space_step step = space_walk_step(q, w, limit, true);
    *list = (tree_objects){.at = &w->object, .stride = 1, .mask = UINT32_MAX, .count = step == SPACE_OBJECT};
    return step == SPACE_NO_MEMORY ? FROE_E_MEMORY : FROE_OK;
}

bool space_walk_reaches(space_walk *w, double limit, float key) {
    update_limit(w, limit);
    return key <= w->limit;
}

size_t space_walk_settle(space_walk *w, double limit) {
    size_t kept = 0;
    update_limit(w, limit);
    for (size_t i = 0; i < w->hits.count; i++)
        if (w->hits.data[i].key <= w->limit) w->hits.data[kept++] = w->hits.data[i];
    return w->hits.count = kept;
}
