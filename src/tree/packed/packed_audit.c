/* packed_audit.c: the frame of a packed tree; flags, general position and units of a fragment. All in exact numbers. */
#include "tree/packed/packed_audit.h"
#include "geom/predicates.h"
#include "tree/ring.h"
#include <math.h>

typedef struct packed_end {
    num_context *context;
    const froe_tree *tree;
    ring_point point;
    const packed_box *box;
} packed_end;

/* Strictly inside, but for the cut that makes it an end. Sides of the root box are no cuts: objects may touch them. */
static bool in_general_position(const packed_end *e) {
    const tree_node *made = e->point.kind == RING_VERTEX ? NULL : e->tree->nodes + e->point.a;
    for (int axis = 0; axis < 2; axis++) {
        if (made && made->axis == axis) continue; /* the end is in the closed cell, and so that cut is a side of it */
        for (int upper = 0; upper < 2; upper++) {
            const double value = (upper ? e->box->hi : e->box->lo)[axis];
            const bool cut = value != (upper ? e->tree->meta.root_hi : e->tree->meta.root_lo)[axis];
            const geom_plane plane = geom_plane_axis(2, axis, value);
            int side;
            if (made) {
                geom_plane other = tree_plane_at(e->tree, e->point.a);
                side = geom_side_crossing(e->context, &plane, e->point.u, e->point.v, &other);
            } else {
                side = geom_side_vertex(e->context, &plane, e->point.x);
            }
            if (upper) side = -side;
            if (cut ? side <= 0 : side < 0) return false;
        }
    }
    return true;
}

/* numerator / denominator, the denominator positive. */
typedef struct packed_ratio {
    num_dyadic numerator, denominator;
} packed_ratio;

/* A coordinate of the end: a corner's, the cut's, or u + (c - u') (v - u) / (v' - u'), with ' for the axis of the cut.
 */
static packed_ratio coordinate_of(const packed_end *e, int axis) {
    num_arena *arena = &e->context->arena;
    const ring_point *p = &e->point;
    const num_dyadic one = num_dyadic_from(arena, 1);
    if (p->kind == RING_VERTEX) return (packed_ratio){num_dyadic_from(arena, p->x[axis]), one};
    const tree_node *made = e->tree->nodes + p->a;
    const num_dyadic c = num_dyadic_from(arena, made->u.value);
    if (made->axis == axis) return (packed_ratio){c, one};
    const num_dyadic u = num_dyadic_from(arena, p->u[axis]), from = num_dyadic_from(arena, p->u[made->axis]);
    num_dyadic rise = num_dyadic_sub(arena, num_dyadic_from(arena, p->v[axis]), u);
    num_dyadic run = num_dyadic_sub(arena, num_dyadic_from(arena, p->v[made->axis]), from);
    if (run.sign < 0) run.sign = 1, rise.sign = -rise.sign;
    const num_dyadic climb = num_dyadic_mul(arena, num_dyadic_sub(arena, c, from), rise);
    return (packed_ratio){num_dyadic_add(arena, num_dyadic_mul(arena, u, run), climb), run};
}

/* |(x - lo) scale - unit| <= error? */
static bool unit_fits(const packed_end *e, const packed_header *h, int axis, uint16_t unit) {
    num_arena *arena = &e->context->arena;
    arena->top = 0;
    const packed_ratio x = coordinate_of(e, axis);
    const num_dyadic lo = num_dyadic_mul(arena, num_dyadic_from(arena, e->box->lo[axis]), x.denominator);
    num_dyadic off = num_dyadic_mul(arena, num_dyadic_sub(arena, x.numerator, lo), num_dyadic_from(arena, h->scale));
    off = num_dyadic_sub(arena, off, num_dyadic_mul(arena, num_dyadic_from(arena, unit), x.denominator));
    if (off.sign < 0) off.sign = 1;
    const num_dyadic most = num_dyadic_mul(arena, num_dyadic_from(arena, (double)h->error), x.denominator);
    return num_dyadic_compare(off, most) <= 0;
}

const char *packed_refuted(num_context *context, const froe_tree *t, uint32_t leaf, uint32_t i,
                           const uint32_t ring[2]) {
    const packed_header *h = packed_block(t, t->nodes + leaf);
    uint32_t count = t->nodes[leaf].u.list.count, id = packed_ids(h, count)[i], object = id & PACKED_OBJECT;
    const double *ends[2];
    packed_box box;
    packed_cell(t, h, &box);
    packed_ends(t->scene, object, ends);
    bool swapped = ends[0] != scene_point(t->scene, object, 0);
    for (uint32_t last = 0; last < 2; last++) {
        uint32_t entry = ring[swapped ? 1 - last : last];
        bool own = id & (last ? PACKED_END : PACKED_START);
        if (own != !(entry & TREE_EDGE_CUT)) return "a fragment with wrong flags";
        packed_end e = {context, t, ring_end(t->scene, object, entry), &box};
        if (!in_general_position(&e)) return "a corner in a cut";
        const uint16_t *x = packed_units(h) + 2 * (size_t)count * last + i, *y = x + count;
        if (h->scale != 0 && (!unit_fits(&e, h, 0, *x) || !unit_fits(&e, h, 1, *y)))
            return "a fragment with wrong units";
    }
    return NULL;
}

/* ------------------------------------------------------------------- frame -- */

typedef struct packed_region {
    uint32_t node;
    double lo[3], hi[3];
} packed_region;

froe_status packed_frame_refuted(const froe_tree *t, uint32_t *node, const char **why) {
    ARRAY(packed_region) waiting = {NULL, 0, 0};
    packed_region at = {.node = 0};
    const froe_scene *s = t->scene;
    const double *lo = t->meta.root_lo, *hi = t->meta.root_hi;
    *node = 0;
    *why = NULL;
    /* in the plane the root box holds the scene; in space it is the scene's, since searches scale by it */
    for (int k = 0; k < FROE_MAX_DIM; k++) {
        const bool used = s->object_count && k < s->dim, exact = !used || s->dim == 3;
        const double least = used ? s->lo[k] : 0, most = used ? s->hi[k] : 0;
        if (exact ? lo[k] != least || hi[k] != most : lo[k] > least || hi[k] < most)
            *why = "a root box that does not fit the scene";
    }
    memcpy(at.lo, lo, sizeof at.lo);
    memcpy(at.hi, hi, sizeof at.hi);
    bool room = array_push(&t->alloc, &waiting, at);
    while (room && !*why && waiting.count) {
        at = waiting.data[--waiting.count];
        *node = at.node;
        const tree_node *n = t->nodes + at.node;
        const double value = n->u.value;
        packed_region side[2] = {at, at};
        if (tree_is_leaf(n)) continue;
        if (n->type != TREE_PLAIN)
            *why = "a cut of a kind that packed trees do not have";
        else if (!(at.lo[n->axis] < value && value < at.hi[n->axis]))
            *why = "a cut that does not divide its cell";
        if (*why) break;
        side[0].node = n->child;
        side[1].node = n->child + 1;
        side[0].hi[n->axis] = side[1].lo[n->axis] = value;
        room = array_push(&t->alloc, &waiting, side[0]) && array_push(&t->alloc, &waiting, side[1]);
    }
    array_free(&t->alloc, &waiting);
    return room ? FROE_OK : FROE_E_MEMORY;
}
