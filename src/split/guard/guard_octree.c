/* guard_octree.c: one octree level by a partition of the guards.
 *
 * Every guard gets the code of its orthant, or one code more when it lies on a middle plane and
 * dies; the counts decide between octree split and shrink, and only then are guards moved. */
#include "split/guard/guard_work.h"
#include <string.h>

typedef struct octree {
    double mid[FROE_MAX_DIM];
    uint32_t counts[GUARD_CELLS + 1]; /* the last: dead */
    uint16_t *codes;                  /* [guard] */
} octree;

/* Items and leaves for the orthants, the first on top of the stack; *any: some are items. */
static froe_status push_orthants(guard_worker *w, const guard_item *item, const guard_cube *cube, const octree *o,
                                 bool *any) {
    int dim = w->plan->dim;
    uint32_t first, end = item->begin + item->count - o->counts[1u << dim];
    froe_status status = guard_octants(w, item->node, item->height, o->mid, &first);
    for (uint32_t code = 1u << dim; code-- > 0 && !status;) {
        uint32_t count = o->counts[code];
        end -= count;
        if (count <= w->plan->k) {
            guard_leaf(w, first + code, count);
            continue;
        }
        guard_cube part = *cube;
        guard_orthant(&part, o->mid, code, dim);
        status = guard_push(w, item,
                            &(guard_item){.node = first + code,
                                          .height = item->height + (uint32_t)dim,
                                          .begin = end,
                                          .count = count,
                                          .side = guard_other_side(item->side)},
                            &part);
        *any = true;
    }
    return status;
}

static inline froe_status octree_step(guard_worker *w, const guard_item *item, const guard_cube *cube, int dim) {
    const guard_plan *plan = w->plan;
    const double *points = guard_points(w, item);
    octree o;
    memset(o.mid, 0, sizeof o.mid);
    memset(o.counts, 0, ((1u << dim) + 1) * sizeof *o.counts);
    o.codes = guard_scratch(w, item->count * sizeof *o.codes);
    if (!o.codes) return FROE_E_MEMORY;
    for (int i = 0; i < dim; i++) o.mid[i] = guard_middle(cube->lo[i], cube->hi[i]);
    /* the orthant of each guard; 2^dim: it lies in a cut */
    for (uint32_t p = 0; p < item->count; p++) {
        const double *x = points + (size_t)p * (size_t)dim;
        uint32_t code = 0, dead = 0;
        for (int i = 0; i < dim; i++) {
            code = 2 * code + (x[i] > o.mid[i]);
            dead |= x[i] == o.mid[i];
        }
        code = dead ? 1u << dim : code;
        o.codes[p] = (uint16_t)code;
        o.counts[code]++;
    }
    uint32_t best = 0;
    for (uint32_t code = 1; code < 1u << dim; code++)
        if (o.counts[code] > o.counts[best]) best = code;
    if (item->count - o.counts[best] < plan->kill && o.counts[best] > plan->k) return guard_shrink(w, item, cube, best);
    bool any = false;
    froe_status status = push_orthants(w, item, cube, &o, &any);
    if (any && !status) {
        double *to = w->side[guard_other_side(item->side)] + (size_t)item->begin * (size_t)dim;
        uint32_t at[GUARD_CELLS + 1];
        for (uint32_t code = 0, sum = 0; code <= 1u << dim; code++) {
            at[code] = sum;
            sum += o.counts[code];
        }
        for (uint32_t p = 0; p < item->count; p++)
            memcpy(to + (size_t)at[o.codes[p]]++ * (size_t)dim, points + (size_t)p * (size_t)dim,
                   (size_t)dim * sizeof *to);
    }
    return status;
}

froe_status guard_octree(guard_worker *w, const guard_item *item, const guard_cube *cube) {
    switch (w->plan->dim) { /* one source, compiled for the common dimensions */
    case 2:
        return octree_step(w, item, cube, 2);
    case 3:
        return octree_step(w, item, cube, 3);
    default:
        return octree_step(w, item, cube, w->plan->dim);
    }
}
