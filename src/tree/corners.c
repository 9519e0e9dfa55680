/* corners.c: pieces as coordinates, for output: every corner is rounded once, from what meets there.
 *
 * Rounding needs a number context. Each tree keeps one to spare, so that the usual caller, one
 * thread, pays nothing for it; a thread that finds it taken makes its own. Without memory
 * for that it waits, since this call cannot fail. */
#include "base/floats.h"
#include "geom/predicates.h"
#include "geom/selftest.h"
#include "tree/gate.h"
#include "tree/packed/packed.h"
#include "tree/ring.h"
#include <sched.h>
#include <stdatomic.h>
#include <string.h>

struct tree_spare {
    num_context context;
    atomic_flag taken;
};

froe_status tree_spare_new(const froe_allocator *alloc, tree_spare **out) {
    tree_spare *spare = support_calloc(alloc, 1, sizeof *spare);
    if (!spare) return FROE_E_MEMORY;
    froe_status status = geom_context_new(alloc, &spare->context);
    if (status) {
        support_free(alloc, spare, sizeof *spare);
        return status;
    }
    atomic_flag_clear(&spare->taken);
    *out = spare;
    return FROE_OK;
}

void tree_spare_free(const froe_allocator *alloc, tree_spare *spare) {
    if (!spare) return;
    num_context_free(&spare->context);
    support_free(alloc, spare, sizeof *spare);
}

/* `length` entries make the ring; the first `count` corners are wanted. */
static void ring_corners(num_context *context, const froe_tree *t, uint32_t object, const uint32_t *ring,
                         uint32_t length, size_t count, double *coords, froe_node *made) {
    size_t dim = (size_t)t->scene->dim;
    for (uint32_t i = 0; i < count; i++) {
        const ring_point p = ring_point_at(t->scene, object, ring, length, i);
        double *out = coords + i * dim;
        if (p.kind == RING_VERTEX) {
            memcpy(out, p.x, dim * sizeof *out);
        } else {
            geom_plane a = tree_plane_at(t, p.a), b, s;
            if (p.kind == RING_CROSSING) {
                geom_round_crossing(context, p.u, p.v, &a, out);
            } else {
                b = tree_plane_at(t, p.b);
                scene_support(t->scene, object, &s);
                geom_round_corner(context, &s, &a, &b, out);
            }
        }
        if (made) made[i].id1 = ring[i] & TREE_EDGE_CUT ? (ring[i] & ~TREE_EDGE_CUT) + 1 : 0;
    }
}

size_t froe_tree_piece_corners(const froe_tree *tree, size_t piece, double *coords, froe_node *made, size_t capacity) {
    BASE_FLOATS_OWN;
    if (piece >= tree->piece_count || tree_settle(tree, NULL)) return 0;
    froe_piece p = froe_tree_piece(tree, piece);
    size_t count = p.corners < capacity ? p.corners : capacity;
    size_t dim = (size_t)tree->scene->dim;
    for (uint32_t i = 0; p.whole && i < count; i++) {
        memcpy(coords + i * dim, scene_point(tree->scene, p.object, i), dim * sizeof *coords);
        if (made) made[i] = (froe_node){0};
    }
    if (p.whole) return p.corners;
    num_context own, *context = &tree->spare->context;
    if (atomic_flag_test_and_set(&tree->spare->taken)) {
        if (geom_context_new(&tree->alloc, &own) == FROE_OK)
            context = &own;
        else
            while (atomic_flag_test_and_set(&tree->spare->taken)) sched_yield();
    }
    if (tree_is_packed(tree)) {
        uint32_t leaf = packed_leaf(tree, (uint32_t)piece), ring[2];
        packed_ring(tree, context, leaf, p.object, ring);
        ring_corners(context, tree, p.object, ring, 2, count, coords, made);
    } else {
        const uint32_t *ring = tree->bounds + tree->pieces[piece].ring;
        ring_corners(context, tree, p.object, ring + 1, ring[0], count, coords, made);
    }
    if (context == &own)
        num_context_free(&own);
    else
        atomic_flag_clear(&tree->spare->taken);
    return p.corners;
}
