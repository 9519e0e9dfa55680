/* packed_audit.c: flags, general position and units of a fragment, by exact predicates.
 *
 * Units. A coordinate is right when it lies between lo + (unit -+ error) / scale. These two are computed in doubles, so
 * they are taken apart by 2^-50 of the size of the cell's coordinates, which is next to nothing but in cells of
 * a few units in the last place. */
#include "tree/packed_audit.h"
#include "geom/predicates.h"
#include "tree/ring.h"
#include <math.h>

typedef struct packed_end {
    num_context *context;
    const froe_tree *tree;
    ring_point point;
    const packed_box *box;
} packed_end;

/* Exact side beside x[axis] = value. */
static int side_of(const packed_end *e, int axis, double value) {
    geom_plane plane = geom_plane_axis(2, axis, value);
    if (e->point.kind == RING_VERTEX) return geom_side_vertex(e->context, &plane, e->point.x);
    geom_plane made = tree_plane_at(e->tree, e->point.a);
    return geom_side_crossing(e->context, &plane, e->point.u, e->point.v, &made);
}

/* Is the side of the cell a cut? The root's are none: objects may touch them. */
static bool is_cut(const packed_end *e, int axis, bool upper) {
    const tree_meta *m = &e->tree->meta;
    return upper ? e->box->hi[axis] != m->root_hi[axis] : e->box->lo[axis] != m->root_lo[axis];
}

/* Strictly inside, but for the cut that makes it an end. */
static bool in_general_position(const packed_end *e) {
    const tree_node *made = e->point.kind == RING_VERTEX ? NULL : e->tree->nodes + e->point.a;
    for (int axis = 0; axis < 2; axis++) {
        if (made && made->axis == axis) {
            if (made->u.value != e->box->lo[axis] && made->u.value != e->box->hi[axis]) return false;
            continue;
        }
        for (int upper = 0; upper < 2; upper++) {
            int side = side_of(e, axis, (upper ? e->box->hi : e->box->lo)[axis]) * (upper ? -1 : 1);
            if (is_cut(e, axis, upper) ? side <= 0 : side < 0) return false;
        }
    }
    return true;
}

static bool unit_fits(const packed_end *e, const packed_header *h, int axis, uint16_t unit) {
    double lo = e->box->lo[axis], hi = e->box->hi[axis], slack = 0x1p-50 * (fabs(lo) + fabs(hi));
    double low = lo + (unit - (double)h->error) / h->scale - slack;
    double high = lo + (unit + (double)h->error) / h->scale + slack;
    return side_of(e, axis, low) >= 0 && side_of(e, axis, high) <= 0;
}

static bool units_fit(const packed_end *e, const packed_header *h, const uint16_t *x, uint32_t count) {
    return h->scale == 0 || (unit_fits(e, h, 0, x[0]) && unit_fits(e, h, 1, x[count]));
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
        if (!units_fit(&e, h, packed_units(h) + 2 * (size_t)count * last + i, count))
            return "a fragment with wrong units";
    }
    return NULL;
}
