/* guard_shrink.h: the exact shrink rule, shared by the ways to build the guard tree. */
#ifndef FROE_SPLIT_GUARD_GUARD_SHRINK_H
#define FROE_SPLIT_GUARD_GUARD_SHRINK_H
#include "split/guard/guard_work.h"

/** A source of the cube's guards in the order of each axis. */
typedef struct guard_peeler {
    /** The guard farthest from the corner along an axis that is not peeled yet; NULL: none is left. Of equally
     * far ones the last (corner below) or first (corner above) in lexicographic order of coordinates. */
    const double *(*farthest)(struct guard_peeler *self, int axis);
    /** Peels the guard that farthest() returned for this axis. */
    void (*peel)(struct guard_peeler *self, int axis);
} guard_peeler;

/** What a shrink does to a cube. */
typedef struct guard_shrunk {
    int count;                  /* planes: at least one */
    uint8_t axes[FROE_MAX_DIM]; /* rising */
    double values[FROE_MAX_DIM];
    uint32_t inner;  /* code of the inner cube in the cross of the planes */
    guard_cube cube; /* the inner cube */
} guard_shrunk;

/** Peels `kill` guards and places the planes. */
void guard_shrink_rule(const guard_cube *cube, int dim, uint32_t corner, uint32_t kill, guard_peeler *peeler,
                       guard_shrunk *out);
/** Makes the nodes of the shrink; *inner is the inner cube's. */
froe_status guard_shrink_nodes(guard_worker *w, const guard_item *item, const guard_shrunk *shrunk, uint32_t *inner);
#endif
