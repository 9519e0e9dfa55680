/* space_walk.c: objects along a ray, or around a point, in the order of lower bounds.
 *
 * In the coordinates of the wide tree the scene is within [-1/2, 1/2]. A ray o + t d becomes o' + u d' with u = t *
 * per, by powers of 2 alone but for o' = (o - middle) * scale; keys are u - start, where it comes to the scene. */
#include "query/packed/space.h"
#include "tree/list.h"
#include <float.h>
#include <math.h>
#include <string.h>

#define SPACE_ITEM_OBJECT 0x40000000u
enum { MOST_SORTED = 64 };

froe_status space_work_new(const froe_tree *t, space_work **out) {
    *out = support_calloc(&t->alloc, 1, sizeof **out);
    if (!*out) return FROE_E_MEMORY;
    (*out)->kernels = space_kernels_at(0);
    return FROE_OK;
}

void space_work_free(space_work *work, const froe_allocator *alloc) {
    if (!work) return;
    space_batch_free(work->batch, alloc);
    array_free(alloc, &work->walk.stack);
    array_free(alloc, &work->walk.hits);
    array_free(alloc, &work->objects);
    array_free(alloc, &work->others);
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

/* Finds where the ray comes to the scene; from there on planes are at most |entry| + 1/2 away. False: it misses the
 * scene. */
static bool enter_scene(space_ray *r, const tree_meta *m) {
    double enter = 0, leave = INFINITY;
    for (int k = 0; k < 3; k++) {
        const double a = (m->root_lo[k] - r->wide->middle[k]) * r->wide->scale;
        const double b = (m->root_hi[k] - r->wide->middle[k]) * r->wide->scale;
        const double s = (a - r->o[k]) * r->inverse[k], t = (b - r->o[k]) * r->inverse[k];
        const double first = (s < t ? s : t) - r->slack[k], last = (s < t ? t : s) + r->slack[k];
        enter = first > enter ? first : enter;
        leave = last < leave ? last : leave;
    }
    r->start = enter;
    for (int k = 0; k < 3; k++) {
        r->slack[k] += 0x1p-50 * r->start;
        r->entry[k] = r->o[k] + r->start * r->d[k];
        r->step[k] = (float)r->inverse[k];
        r->rest[k] = (float)(r->slack[k] + 0x1p-21 * fabs(r->inverse[k]) * (fabs(r->entry[k]) + 0.5)) * (1 + 0x1p-20f);
    }
    return enter <= leave;
}

/* The least one above x > 0, if neither is denormal. */
static double power_of_2(double x) {
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    bits = (bits >> 52) + 1;
    bits <<= 52;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* A key that is certainly no later than t; -1: none is. */
static float key_within(const space_walk *w, double t) {
    const double start = w->ray.start, u = t * w->per;
    const double x = (u - 0x1p-20 * fabs(u - start) - 0x1p-50 * start - start) * (1 - 0x1p-22) - (double)FLT_MIN;
    return isinf(t) ? FLT_MAX : x > 0 ? x < FLT_MAX ? (float)x : FLT_MAX : -1;
}

froe_status space_walk_ray(froe_query *q, space_walk *w, const geom_ray *ray, double t_max, space_wanted wanted,
                           bool *begun) {
    const tree_wide *wide = q->tree->packed.wide;
    space_ray *r = &w->ray;
    double most = 0;
    for (int k = 0; k < 3; k++) most = fabs(ray->d[k]) > most ? fabs(ray->d[k]) : most;
    const double size = power_of_2(most);
    *begun = wide && size > 0x1p-300 && size < 0x1p300;
    r->wide = wide;
    /* Rounding of o', of planes and of their difference costs 2^-51 of their sizes; where the ray hardly moves along an
     * axis, it is taken to move by 2^-60, which is nothing beside 2^-37. */
    for (int k = 0; *begun && k < 3; k++) {
        r->d[k] = ray->d[k] / size;
        r->o[k] = (ray->o[k] - wide->middle[k]) * wide->scale;
        const bool slow = fabs(r->d[k]) < 0x1p-60;
        r->inverse[k] = slow ? copysign(0x1p60, r->d[k]) : 1 / r->d[k];
        r->slack[k] = fabs(r->inverse[k]) * (0x1p-48 * (fabs(r->o[k]) + 1) + (slow ? 0x1p-37 : 0));
        r->up[k] = r->inverse[k] > 0;
        *begun = fabs(r->o[k]) <= 0x1p20;
    }
    if (!*begun) return FROE_OK;
    int last = fabs(r->d[1]) > fabs(r->d[0]) ? 1 : 0;
    if (fabs(r->d[2]) > fabs(r->d[last])) last = 2;
    r->axis[0] = last == 0;
    r->axis[1] = 2 - (last == 2);
    r->axis[2] = last;
    r->largest = r->d[last];
    for (int i = 0; i < 2; i++) r->shear[i] = (float)(r->d[r->axis[i]] / r->largest);
    w->per = wide->scale * size;
    w->wanted = wanted;
    const bool meets = enter_scene(r, &q->tree->meta);
    w->within = key_within(w, t_max);
    return begin_space_walk(q, w, false, meets);
}

froe_status space_walk_near(froe_query *q, space_walk *w, bool *begun) {
    const tree_wide *wide = q->tree->packed.wide;
    space_point *p = &w->point;
    *begun = wide;
    p->wide = wide;
    for (int k = 0; *begun && k < 3; k++) {
        p->x[k] = q->near.point[k];
        p->at[k] = (p->x[k] - wide->middle[k]) * wide->scale;
        *begun = fabs(p->at[k]) <= 0x1p10;
    }
    if (!*begun) return FROE_OK;
    w->per = (wide->scale / q->near.scale) * (wide->scale / q->near.scale);
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

static uint64_t entry(float key, uint32_t what) {
    uint32_t bits;
    memcpy(&bits, &key, sizeof bits); /* of numbers that are not negative: in their order */
    return (uint64_t)bits << 32 | what;
}

static float key_of(uint64_t entry) {
    const uint32_t bits = (uint32_t)(entry >> 32);
    float key;
    memcpy(&key, &bits, sizeof key);
    return key;
}

/* The last entries, so that the least is on top. */
static void sort_top(space_walk *w, size_t from) {
    uint64_t *e = w->stack.data;
    if (w->stack.count - from > MOST_SORTED) return;
    for (size_t i = from + 1; i < w->stack.count; i++) {
        uint64_t x = e[i];
        size_t j = i;
        for (; j > from && e[j - 1] < x; j--) e[j] = e[j - 1];
        e[j] = x;
    }
}

/* Prefetches all of a node, or as much of a leaf as one of 24 triangles has; objects have been prefetched before. It is
 * inlined, since gcc drops calls of functions that only prefetch. */
__attribute__((always_inline)) static inline void ask_for(const froe_tree *t, uint32_t what) {
    const bool leaf = what & WIDE_LEAF;
    const uint8_t *at = leaf ? t->packed.blocks + (size_t)(what & WIDE_INDEX) * PACKED_BLOCK
                             : (const uint8_t *)(t->packed.wide->nodes + what);
    if (!leaf && what & SPACE_ITEM_OBJECT) return;
    for (int i = 0; i < (leaf ? 640 : 192); i += 64) __builtin_prefetch(at + i);
}

/* Pushes the children of a node that may be met. False without memory. */
static bool push_children(froe_query *q, space_walk *w, uint32_t index, bool ask) {
    const wide_node *n = q->tree->packed.wide->nodes + index;
    const space_kernels *kernels = q->space->kernels;
    float keys[PACKED_LANES];
    size_t from = w->stack.count;
    uint32_t bits =
        w->near ? kernels->near_node(n, &w->point, w->limit, keys) : kernels->ray_node(n, &w->ray, w->limit, keys);
    q->stats.nodes++;
    if (!array_reserve(&q->alloc, &w->stack, PACKED_LANES)) return false;
    for (; bits; bits &= bits - 1) {
        uint32_t i = (uint32_t)__builtin_ctz(bits);
        if (ask) ask_for(q->tree, n->child[i]);
        w->stack.data[w->stack.count++] = entry(keys[i], n->child[i]);
    }
    if (!w->near || w->stack.count <= from) {
        sort_top(w, from);
        return true;
    }
    /* The least on top; of few that wait the others need no order, as the first leaf lowers the limit. */
    uint64_t *e = w->stack.data, *top = e + w->stack.count - 1;
    size_t least = from;
    for (size_t i = from + 1; i < w->stack.count; i++) least = e[i] < e[least] ? i : least;
    const uint64_t x = e[least];
    e[least] = *top;
    *top = x;
    return true;
}

/* The object is certainly met, and no later than `end`. */
static bool take_hit(froe_query *q, space_walk *w, uint32_t object, float key, float end) {
    lower_limit(w, end);
    const space_hit hit = {object, key, end};
    return array_push(&q->alloc, &w->hits, hit);
}

/* Replaces a leaf by its objects. SPACE_MET: any is wanted, and one is met. */
static space_step push_objects(froe_query *q, space_walk *w, uint32_t block, float key) {
    space_work *work = q->space;
    const space_header *h = space_block(q->tree, block);
    const size_t room = h->count + PACKED_LANES, from = w->stack.count;
    if (!array_reserve(&q->alloc, &work->objects, room) || !array_reserve(&q->alloc, &work->keys, room) ||
        !array_reserve(&q->alloc, &work->ends, room) || !array_reserve(&q->alloc, &w->stack, room))
        return SPACE_NO_MEMORY;
    space_found found = {work->objects.data, work->keys.data, work->ends.data, 0, (float)INFINITY};
    if (w->near)
        work->kernels->near(h, &w->point, key, w->limit, &found);
    else
        work->kernels->ray(h, &w->ray, key, w->limit, &found);
    q->stats.leaves++;
    if (w->near && q->near.one) lower_limit(w, found.least);
    for (size_t i = 0; i < found.count; i++) {
        w->object = found.objects[i];
        if (found.keys[i] > w->limit) continue;
        const bool sure = !w->near && found.ends[i] <= w->within;
        if (sure && w->wanted == SPACE_ANY) return SPACE_MET;
        scene_ask(q->tree->scene, w->object);
        if (!sure || w->wanted == SPACE_ALL)
            w->stack.data[w->stack.count++] = entry(found.keys[i], SPACE_ITEM_OBJECT | w->object);
        else if (!take_hit(q, w, w->object, found.keys[i], found.ends[i]))
            return SPACE_NO_MEMORY;
    }
    sort_top(w, from);
    return SPACE_ON;
}

/* Takes the entry on top: an object is handed out; a node or a leaf is replaced by what may be met of it. */
static space_step take_space_item(froe_query *q, space_walk *w, bool ask) {
    const uint64_t top = w->stack.data[--w->stack.count];
    const uint32_t what = (uint32_t)top;
    if (what & WIDE_LEAF) return push_objects(q, w, what & WIDE_INDEX, key_of(top));
    if (!(what & SPACE_ITEM_OBJECT)) return push_children(q, w, what, ask) ? SPACE_ON : SPACE_NO_MEMORY;
    w->object = what & WIDE_INDEX;
    return SPACE_OBJECT;
}

/* Drops entries beyond the limit. False: none is left. */
static bool settle_item(space_walk *w) {
    while (w->stack.count && key_of(w->stack.data[w->stack.count - 1]) > w->limit) w->stack.count--;
    return w->stack.count;
}

space_step space_walk_step(froe_query *q, space_walk *w, double limit, bool alone) {
    space_step step = SPACE_ON;
    update_limit(w, limit);
    if (!alone && !settle_item(w)) return SPACE_END;
    if (!alone) step = take_space_item(q, w, false);
    while (alone && step == SPACE_ON) step = settle_item(w) ? take_space_item(q, w, true) : SPACE_END;
    if (step == SPACE_ON && settle_item(w)) ask_for(q->tree, (uint32_t)w->stack.data[w->stack.count - 1]);
    return step;
}

froe_status space_walk_next(froe_query *q, space_walk *w, double limit, tree_objects *list) {
    const space_step step = space_walk_step(q, w, limit, true);
    *list = (tree_objects){.at = &w->object, .stride = 1, .mask = UINT32_MAX, .count = step == SPACE_OBJECT};
    return step == SPACE_NO_MEMORY ? FROE_E_MEMORY : FROE_OK;
}

size_t space_walk_settle(space_walk *w, double limit) {
    size_t kept = 0;
    update_limit(w, limit);
    for (size_t i = 0; i < w->hits.count; i++)
        if (w->hits.data[i].key <= w->limit) w->hits.data[kept++] = w->hits.data[i];
    return w->hits.count = kept;
}
