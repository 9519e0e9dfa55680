/* cells.c: the cells of a tree as polygons and polyhedra in doubles, for pictures and exports.
 *
 * Depth first; the shapes of right children wait on a stack of packed arrays, so the walk needs
 * heap for one shape a level and no recursion. Shapes live in a frame (shape.h) in which the box
 * has size 1, so that no coordinate a double can hold overflows. */
#include "base/floats.h"
#include "support/fail.h"
#include "tree/gate.h"
#include "tree/shape.h"
#include <math.h>
#include <string.h>

typedef struct cell_pending {
    uint32_t node, depth;
    size_t points, loops, starts; /* of its shape, on top of the packed ones */
} cell_pending;

typedef struct cell_walk {
    const froe_tree *tree;
    froe_allocator alloc;
    int dim;
    shape_frame frame;
    froe_cell_fn *fn;
    void *user;
    ARRAY(cell_pending) pending;
    shape packed;            /* shapes of all that is pending, behind one another */
    shape now, part[2], cut; /* the cell, its halves, the cut within it */
    shape_scratch scratch;
    ARRAY(double) coords, cut_coords; /* as shown to the visitor */
    ARRAY(size_t) starts;
    bool stopped;
} cell_walk;

static bool push_cell_shape(cell_walk *w, uint32_t node, uint32_t depth, const shape *s) {
    cell_pending item = {node, depth, s->points.count, s->loops.count, s->starts.count};
    shape *to = &w->packed;
    if (!array_reserve(&w->alloc, &to->points, item.points) || !array_reserve(&w->alloc, &to->loops, item.loops) ||
        !array_reserve(&w->alloc, &to->starts, item.starts) || !array_push(&w->alloc, &w->pending, item))
        return false;
    memcpy(to->points.data + to->points.count, s->points.data, item.points * sizeof(double));
    memcpy(to->loops.data + to->loops.count, s->loops.data, item.loops * sizeof(uint32_t));
    memcpy(to->starts.data + to->starts.count, s->starts.data, item.starts * sizeof(uint32_t));
    to->points.count += item.points;
    to->loops.count += item.loops;
    to->starts.count += item.starts;
    return true;
}

/* Shows a cell as the visitor sees it: corner by corner, in the scene's units. */
static bool show(cell_walk *w, const cell_pending *at) {
    const shape *s = &w->now;
    size_t dim = (size_t)w->dim;
    w->coords.count = w->starts.count = w->cut_coords.count = 0;
    if (!array_reserve(&w->alloc, &w->coords, s->loops.count * dim) ||
        !array_reserve(&w->alloc, &w->starts, s->starts.count) ||
        !array_reserve(&w->alloc, &w->cut_coords, w->cut.points.count))
        return false;
    for (size_t i = 0; i < s->loops.count; i++)
        for (size_t k = 0; k < dim; k++)
            w->coords.data[w->coords.count++] =
                shape_coordinate(&w->frame, (int)k, s->points.data[s->loops.data[i] * dim + k]);
    for (size_t i = 0; i < s->starts.count; i++) w->starts.data[w->starts.count++] = s->starts.data[i];
    for (size_t i = 0; i < w->cut.points.count; i++)
        w->cut_coords.data[w->cut_coords.count++] = shape_coordinate(&w->frame, (int)(i % dim), w->cut.points.data[i]);
    froe_cell cell = {.node = {at->node + 1}, .depth = at->depth};
    cell.leaf = tree_is_leaf(w->tree->nodes + at->node);
    cell.coords = w->coords.data;
    cell.corners = w->now.loops.count;
    cell.face_starts = w->starts.data;
    cell.face_count = w->now.starts.count - 1;
    cell.cut_coords = w->cut_coords.data;
    cell.cut_corners = w->cut.points.count / (size_t)w->dim;
    w->stopped = !base_callback(w->fn(w->user, &cell));
    return true;
}

/* Takes the node on top, shows it and leaves its children pending, the negative one on top. */
static bool visit_cell(cell_walk *w) {
    const cell_pending pending = w->pending.data[--w->pending.count], *at = &pending;
    const tree_node *n = w->tree->nodes + at->node;
    shape *from = &w->packed, top;
    unsigned reached;
    memset(&top, 0, sizeof top);
    from->points.count -= top.points.count = at->points;
    from->loops.count -= top.loops.count = at->loops;
    from->starts.count -= top.starts.count = at->starts;
    top.points.data = from->points.data + from->points.count;
    top.loops.data = from->loops.data + from->loops.count;
    top.starts.data = from->starts.data + from->starts.count;
    if (!shape_copy(&w->alloc, &top, &w->now)) return false;
    w->cut.points.count = 0;
    if (tree_is_leaf(n)) return show(w, at);
    geom_plane exact = tree_plane_at(w->tree, at->node);
    shape_plane plane = shape_plane_from(&exact, &w->frame);
    if (!shape_sides(&w->alloc, w->dim, &w->now, &plane, &w->scratch, &reached)) return false;
    bool both = reached == 3;
    for (int i = 0; both && i < 2; i++)
        if (!shape_clip(&w->alloc, w->dim, &w->now, &plane, i ? 1 : -1, &w->scratch, &w->part[i], i ? NULL : &w->cut))
            return false;
    if (!show(w, at)) return false;
    if (reached != 1 && !push_cell_shape(w, n->child + 1, at->depth + 1, both ? &w->part[1] : &w->now)) return false;
    return reached == 2 || push_cell_shape(w, n->child, at->depth + 1, both ? &w->part[0] : &w->now);
}

froe_status froe_tree_cells(const froe_tree *tree, const double *lo, const double *hi, froe_cell_fn *fn, void *user,
                            froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!tree || !lo || !hi || !fn) return support_fail_null(diag, __func__);
    const froe_status settled = tree_settle(tree, diag);
    if (settled) return settled;
    cell_walk w = {.tree = tree, .alloc = tree->alloc, .dim = tree->scene->dim, .fn = fn, .user = user};
    if (w.dim > 3)
        return support_fail(diag, FROE_E_UNSUPPORTED, "Cells exist in 2 and 3 dimensions, not in %d.", w.dim);
    for (int k = 0; k < w.dim; k++) {
        if (!(lo[k] <= hi[k]) || !isfinite(lo[k]) || !isfinite(hi[k]))
            return support_fail_at(diag, FROE_E_ARG, FROE_NONE, FROE_NONE, (uint32_t)k,
                                   "The box has no extent on axis %d, from %g to %g.", k, lo[k], hi[k]);
    }
    w.frame = shape_frame_of(w.dim, lo, hi);
    bool ok = shape_box(&w.alloc, w.dim, lo, hi, &w.frame, &w.now) && push_cell_shape(&w, 0, 0, &w.now);
    while (ok && w.pending.count && !w.stopped) ok = visit_cell(&w);
    array_free(&w.alloc, &w.pending);
    shape_free(&w.alloc, &w.packed);
    shape_free(&w.alloc, &w.now);
    shape_free(&w.alloc, &w.part[0]);
    shape_free(&w.alloc, &w.part[1]);
    shape_free(&w.alloc, &w.cut);
    shape_scratch_free(&w.alloc, &w.scratch);
    array_free(&w.alloc, &w.coords);
    array_free(&w.alloc, &w.cut_coords);
    array_free(&w.alloc, &w.starts);
    return ok ? FROE_OK : support_fail_memory(diag);
}
