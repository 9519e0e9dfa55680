/* guard_work.h: inside the guard tree: a worker takes items off its stack and splits them.
 *
 * An item is a cube with more than k guards strictly inside. A step turns it into nodes and
 * smaller items; which step is a matter of speed alone:
 *
 *     guard_octree   one octree level, by a partition of the guards      guard_octree.c
 *     guard_bucket   several levels at once, by a histogram              guard_bucket.c
 *     guard_shrink   the shrink, by heaps                                guard_shrink.c
 *     guard_phase    many levels with O(d) sorts, however deep they go   guard_phase.c
 *
 * An orthant's code has a bit for each axis, axis 0 first (the highest of dim bits): 1 is above
 * the middle. The corner of a cube is named by the orthant that it belongs to. */
#ifndef FROE_SPLIT_GUARD_GUARD_WORK_H
#define FROE_SPLIT_GUARD_GUARD_WORK_H
#include "split/guard/grid_boxes.h"
#include "split/guard/guard_grid.h"
#include "split/guard/guard_tree.h"

#define GUARD_CELLS (1u << FROE_MAX_DIM)
#define GUARD_LIMIT 2147483646u /* guards, nodes */

typedef struct guard_plan {
    const froe_allocator *alloc;
    base_task *task;
    int dim;
    uint32_t k, kill; /* a shrink leaves out kill = max(k, 1) guards, the last of them on its border */
    split_form form;
    split_guard_way way;
} guard_plan;

/* A step reads the item's guards on its side and writes those of smaller items at the same place on the other. */
enum { GUARD_SPARE, GUARD_MAIN, GUARD_INPUT };

typedef struct guard_item {
    uint32_t node, height;
    uint32_t begin, count; /* its guards, of the worker's array */
    uint32_t ration;       /* the count when credit was given: new credit comes at half of it */
    uint8_t side;
    bool shrink;     /* known to need one */
    uint64_t credit; /* guards that steps may still move before a phase is due */
} guard_item;

typedef ARRAY(split_guard_node) guard_nodes;

typedef struct guard_worker {
    const guard_plan *plan;
    double *side[2];     /* spare, main */
    const double *input; /* is only read */
    guard_nodes *nodes;
    uint32_t origin; /* of node numbers in nodes */
    ARRAY(guard_item) items;
    ARRAY(double) cubes; /* of the items: lo and hi, dim doubles each */
    ARRAY(uint64_t) scratch;
    bool parallel; /* steps may use base_run() */
    uint64_t octree_steps, shrinks, phases;
    uint32_t height;
} guard_worker;

void guard_worker_free(guard_worker *w);
/** Makes `part` of `whole` (NULL: the root) an item with credit, or a leaf when it has at most k guards. */
froe_status guard_push(guard_worker *w, const guard_item *whole, const guard_item *part, const guard_cube *cube);
/** Puts an item on the stack as it is. */
froe_status guard_stack(guard_worker *w, const guard_item *item, const guard_cube *cube);
/** Takes the topmost item; there is one. */
void guard_pop(guard_worker *w, guard_item *item, guard_cube *cube);
/** One step on an item. */
froe_status guard_step(guard_worker *w, const guard_item *item, const guard_cube *cube);
/** Steps until no items are left. */
froe_status guard_run(guard_worker *w);
/** Room for `bytes`, valid until the next call; NULL without memory. */
void *guard_scratch(guard_worker *w, size_t bytes);

static inline const double *guard_points(const guard_worker *w, const guard_item *item) {
    const double *points = item->side == GUARD_INPUT ? w->input : w->side[item->side];
    return points + (size_t)item->begin * (size_t)w->plan->dim;
}
static inline uint8_t guard_other_side(uint8_t side) {
    return side == GUARD_MAIN ? GUARD_SPARE : GUARD_MAIN;
}
static inline split_guard_node *guard_node(const guard_worker *w, uint32_t node) {
    return &w->nodes->data[w->origin + node];
}
/** Cuts the cube down to one of its orthants. */
static inline void guard_orthant(guard_cube *cube, const double *mid, uint32_t code, int dim) {
    for (int i = 0; i < dim; i++) {
        if (guard_above(code, dim, i))
            cube->lo[i] = mid[i];
        else
            cube->hi[i] = mid[i];
    }
}

/* ---- nodes (guard_nodes.c) */
/** Splits a leaf by a cross of `count` planes; cell c of the 2^count cells (bit of axes[0] first) is *first + c. */
froe_status guard_cross(guard_worker *w, uint32_t node, int count, const uint8_t *axes, const double *values,
                        uint32_t *first);
/** Splits a leaf slab by slab; `inner` says for each plane if the rest lies above. *rest is the rest's node. */
froe_status guard_slabs(guard_worker *w, uint32_t node, int count, const uint8_t *axes, const double *values,
                        uint32_t inner, uint32_t *rest);
/** An octree split of a whole cube. */
froe_status guard_octants(guard_worker *w, uint32_t node, uint32_t height, const double *mid, uint32_t *first);
/** Counts a guard in the leaf below `node` that has it strictly inside, unless there is none or it is `except`. */
void guard_count(guard_worker *w, uint32_t node, const double *point, uint32_t except);
void guard_leaf(guard_worker *w, uint32_t node, uint32_t guards);

/* ---- steps; each spends credit and pushes what is left */
froe_status guard_octree(guard_worker *w, const guard_item *item, const guard_cube *cube);
/** levels >= 1, dim * levels <= GUARD_CODE_BITS */
froe_status guard_bucket(guard_worker *w, const guard_item *item, const guard_cube *cube, int levels);
/** The first step of all, on the guards of a scene, whose number becomes *count. Guards that go on are written to
 * *main, whose memory, *bytes, is the caller's from then on. *count 0: nothing was done, since the root shrinks. */
froe_status guard_bucket_scene(guard_worker *w, const split_grid_boxes *grid_boxes, double **main, size_t *bytes,
                               uint32_t *count);
froe_status guard_shrink(guard_worker *w, const guard_item *item, const guard_cube *cube, uint32_t corner);
froe_status guard_phase(guard_worker *w, const guard_item *item, const guard_cube *cube);
#endif
