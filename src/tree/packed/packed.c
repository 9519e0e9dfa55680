/* packed.c: writing blocks, and what general code asks of them: which leaf, which cell, which ring.
 *
 * Quantisation. unit = floor((x - lo) * scale + 0.5) in doubles. Of its four roundings each changes the result by at
 * most 2^-53 of a number below 2^17, together less than 2^-20; the image x may be off by `error`, so
 * |unit - (true x - lo) * scale| <= 0.5 + 2^-20 + error * scale. Clamping to the cell brings nothing further from a
 * point of it. */
#include "tree/packed/packed.h"
#include "geom/predicates.h"
#include <math.h>

/* ----------------------------------------------------------------- writing -- */

double packed_scale(const packed_box *box) {
    double x = box->hi[0] - box->lo[0], y = box->hi[1] - box->lo[1], side = x > y ? x : y;
    double scale = PACKED_UNITS / side * (1 - 0x1p-40);
    bool tame = side <= 0x1p1000 && side >= 0x1p-1000; /* false for infinity: the cell is too large */
    return tame ? scale : 0;
}

void packed_write(packed_header *block, const packed_box *box, uint32_t owner, const packed_fragment *f,
                  uint32_t count) {
    const double lo[4] = {box->lo[0], box->lo[1], box->lo[0], box->lo[1]};
    double scale = packed_scale(box);
    uint32_t most = 0;
    for (uint32_t i = 0; i < count; i++) most = f[i].error > most ? f[i].error : most;
    const double units = (0.5 + 0x1p-20 + packed_error(most) * scale) * (1 + 0x1p-20);
    float error = units < 0x1p15 ? (float)units : PACKED_COARSE; /* infinity and NaN are coarse */
    if (error >= PACKED_COARSE || scale == 0) scale = 0, error = PACKED_COARSE;
    *block = (packed_header){.lo = {lo[0], lo[1]}, .scale = scale, .owner = owner, .error = error};
    uint16_t *rows = (uint16_t *)(void *)(block + 1);
    uint32_t *ids = (uint32_t *)(void *)(rows + 4 * (size_t)count);
    for (uint32_t i = 0; i < count; i++) {
        const double x[4] = {f[i].p[0], f[i].p[1], f[i].q[0], f[i].q[1]};
        int32_t unit[4];
        for (int k = 0; k < 4; k++) { /* in a form that compilers do all four of at once */
            const double u = (x[k] - lo[k]) * scale + 0.5, v = u > 0 ? u : 0;
            unit[k] = (int32_t)(v < PACKED_UNITS ? v : PACKED_UNITS);
        }
        for (size_t k = 0; k < 4; k++) rows[k * count + i] = (uint16_t)unit[k];
        ids[i] = f[i].id;
    }
}

/* ----------------------------------------------------------------- finding -- */

uint32_t packed_leaf_in(const froe_tree *t, uint32_t piece, double *lo, double *hi) {
    uint32_t node = 0;
    for (int k = 0; k < t->scene->dim; k++) lo[k] = t->meta.root_lo[k], hi[k] = t->meta.root_hi[k];
    while (!tree_is_leaf(t->nodes + node)) {
        const tree_node *n = t->nodes + node, *first = t->nodes + n->child + 1;
        while (!tree_is_leaf(first)) first = t->nodes + first->child;
        bool upper = piece >= first->u.list.first;
        (upper ? lo : hi)[n->axis] = n->u.value;
        node = n->child + upper;
    }
    return node;
}

uint32_t packed_leaf(const froe_tree *t, uint32_t piece) {
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    return packed_leaf_in(t, piece, lo, hi);
}

/* The child that holds a cell with this lower corner. */
static uint32_t step_towards(const tree_node *n, const double *lo) {
    return n->child + (n->u.value <= lo[n->axis]);
}

uint32_t packed_cell(const froe_tree *t, const packed_header *block, packed_box *box) {
    uint32_t node = 0, next;
    for (int k = 0; k < 2; k++) box->lo[k] = t->meta.root_lo[k], box->hi[k] = t->meta.root_hi[k];
    for (const tree_node *n = t->nodes; !tree_is_leaf(n); node = next, n = t->nodes + node) {
        next = step_towards(n, block->lo);
        (next == n->child ? box->hi : box->lo)[n->axis] = n->u.value;
    }
    return node;
}

/* ------------------------------------------------------------------- rings -- */

void packed_ring(const froe_tree *t, num_context *context, uint32_t leaf, uint32_t object, uint32_t ring[2]) {
    const double *lo = packed_block(t, t->nodes + leaf)->lo;
    const double *ends[2] = {scene_point(t->scene, object, 0), scene_point(t->scene, object, 1)};
    uint32_t node = 0, next;
    ring[0] = 0;
    ring[1] = 1;
    for (const tree_node *n = t->nodes; !tree_is_leaf(n); node = next, n = t->nodes + node) {
        next = step_towards(n, lo);
        for (int i = 0; i < 2; i++) { /* an end on the other side of the cut is ended by it */
            double side = ring[i] & TREE_EDGE_CUT ? 0 : ends[ring[i]][n->axis] - n->u.value;
            if (ring[i] & TREE_EDGE_CUT) {
                geom_plane plane = geom_plane_axis(2, n->axis, n->u.value);
                geom_plane made = tree_plane_at(t, ring[i] & ~TREE_EDGE_CUT);
                side = geom_side_crossing(context, &plane, ends[0], ends[1], &made);
            }
            if (next == n->child ? side > 0 : side < 0) ring[i] = TREE_EDGE_CUT | node;
        }
    }
}
