/* ray_walk.c: which lists does a ray come by, in which order?
 *
 *     child 0  |  child 1        A cut parts the ray at one parameter. What is known of it is an interval; before it,
 *        o-----|=====>           the ray is on one side, after it on the other, and within it perhaps in the cut. So
 *      enter  lo hi   leave      the first child, the list of the cut and the second child are visited in this order,
 *              |                 each for its own interval, cut down to that of the node.
 *
 * A node with covers is visited with its whole list before its children are.
 *
 * Intervals are rounded outwards, and a ray that may be parallel to a cut is on both sides throughout, unless it is
 * further from the cut than it can come within its interval, which ends with the scene: with objects listed where they
 * meet open cells, and regions closed, no object is missed. The stack is as deep as the tree at most. */
#include "query/cuts.h"
#include "query/packed/space.h"
#include "query/ray/ray.h"
#include "support/fail.h"

/* Where the ray crosses a cut, at most; first: the side it comes from. */
typedef struct crossing {
    double lo, hi;
    int first;
    bool both; /* in or beside the cut all the way */
} crossing;

/* On the side where the origin is throughout. */
static crossing crossing_at(double value) {
    const double side = value < 0 ? INFINITY : -(double)INFINITY;
    return (crossing){side, side, 0, false};
}

static crossing cross_axis(const geom_ray *ray, int axis, double value) {
    const double ahead = value - ray->o[axis], d = ray->d[axis];
    if (d == 0) return ahead == 0 ? (crossing){.both = true} : crossing_at(-ahead);
    const double t = ahead / d, e = 0x1p-51 * fabs(t) + 0x1p-1070;
    if (!isfinite(t)) return (crossing){.both = true};
    return (crossing){t - e, t + e, d < 0, false};
}

/* Up to the parameter `leave`. */
static crossing cross_plane(const geom_ray *ray, const query_plane *plane, double leave) {
    double value_error, slope_error;
    const double value = query_plane_value(plane, ray->dim, ray->o, &value_error);
    const double slope = query_plane_slope(plane, ray->dim, ray->d, &slope_error);
    const num_ball t = filter_div((num_ball){-value, value_error}, (num_ball){slope, slope_error});
    if (t.e < INFINITY) /* an infinite quotient has no other error, as the slope has an error > 0 */
        return (crossing){t.x - t.e * (1 + 0x1p-50), t.x + t.e * (1 + 0x1p-50), slope < 0, false};
    const double reach = value_error + (fabs(slope) + slope_error) * leave;
    return fabs(value) > reach * (1 + 0x1p-50) ? crossing_at(value) : (crossing){.both = true};
}

/* REQUIRES: room. */
static void push_step(froe_query *q, query_step step) {
    if (step.enter > step.leave || step.enter > q->ray.limit || step.enter == INFINITY) return;
    q->ray.steps.data[q->ray.steps.count++] = step;
}

froe_status query_walk_begin(froe_query *q, froe_diagnostic *diag) {
    const query_planes *planes;
    q->ray.packed = false;
    if (q->space && space_walk_ray(q, &q->space->walk, &q->ray.ray, q->ray.limit, SPACE_ALL, &q->ray.packed))
        return support_fail_memory(diag);
    if (q->ray.packed) return FROE_OK;
    froe_status status = query_planes_of(q, &planes, diag);
    /* The part of the ray that may be within the bounds of the scene. */
    const froe_scene *s = q->tree->scene;
    const geom_ray *ray = &q->ray.ray;
    query_step root = {0, false, 0, INFINITY};
    for (int k = 0; k < s->dim; k++) {
        if (ray->d[k] == 0) {
            if (ray->o[k] < s->lo[k] || ray->o[k] > s->hi[k]) root.leave = -1;
            continue;
        }
        const bool falls = ray->d[k] < 0;
        const crossing in = cross_axis(ray, k, falls ? s->hi[k] : s->lo[k]),
                       out = cross_axis(ray, k, falls ? s->lo[k] : s->hi[k]);
        if (!in.both && in.lo > root.enter) root.enter = in.lo;
        if (!out.both && out.hi < root.leave) root.leave = out.hi;
    }
    q->ray.steps.count = 0;
    if (!status && !array_reserve(&q->alloc, &q->ray.steps, 1)) status = support_fail_memory(diag);
    if (!status) push_step(q, root);
    return status;
}

froe_status query_walk_next(froe_query *q, tree_objects *list) {
    const query_planes *planes;
    if (q->ray.packed) return space_walk_next(q, &q->space->walk, q->ray.limit, list);
    froe_status status = query_planes_of(q, &planes, NULL);
    list->count = 0;
    /* one way: query_walk_begin() has prepared the planes */
    while (!status && q->ray.steps.count) {
        const query_step s = q->ray.steps.data[--q->ray.steps.count];
        if (s.enter > q->ray.limit) continue;
        const bool leaf = tree_is_leaf(q->tree->nodes + s.node);
        q->stats.nodes += !s.list;
        q->stats.leaves += leaf;
        if (leaf || s.list) {
            *list = tree_list(q->tree, s.node);
            if (list->count) return FROE_OK;
            continue;
        }
        /* An inner node is replaced by what the ray visits of it: the first to come on top. */
        const froe_tree *t = q->tree;
        const tree_node *node = t->nodes + s.node;
        const query_cut cut = query_cut_at(t, planes, node);
        const crossing c =
            cut.axis >= 0 ? cross_axis(&q->ray.ray, cut.axis, cut.value) : cross_plane(&q->ray.ray, cut.plane, s.leave);
        query_step first = {node->child + (uint32_t)c.first, false, s.enter, s.leave}, in_cut = s, second = first;
        second.node = node->child + 1 - (uint32_t)c.first;
        in_cut.list = true;
        if (!c.both) {
            in_cut.enter = second.enter = c.lo > s.enter ? c.lo : s.enter;
            in_cut.leave = first.leave = c.hi < s.leave ? c.hi : s.leave;
        }
        const uint32_t covers = tree_covers(t, node);
        const bool listed = node->type == TREE_TABLED && t->cuts[node->u.cut].count && !covers;
        if (!array_reserve(&q->alloc, &q->ray.steps, 3)) return FROE_E_MEMORY;
        push_step(q, second);
        if (listed) push_step(q, in_cut);
        push_step(q, first);
        if (covers) {
            *list = tree_list(t, s.node);
            return FROE_OK;
        }
    }
    return status;
}
