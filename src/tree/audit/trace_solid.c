/* trace_solid.c: carrying boxes, balls and hulls down a tree; they go to both sides as a whole.
 *
 * Where one cut divides a solid it is on both sides for certain. Where several do, its part between them
 * may be empty:
 *
 *         \  o /        axis-parallel cuts   boxes: the part is a box, exact; balls: distance to the cell, exact
 *       ---\--/---      any other            a witness, strictly inside all cuts so far, tells where it must be;
 *           \/                               without one, trace_cell.c
 *
 * A witness w of a box stands for points near it: its part is a box P with w in it, so on an axis
 * where P extends beyond w, w may be moved a little. */
#include "geom/meet/meet.h"
#include "tree/audit/trace.h"
#include <math.h>
#include <string.h>

/* ------------------------------------------------------------------- boxes -- */

/* The sides of an oblique plane that a box reaches, and for each a corner strictly there. */
static unsigned box_reach(tree_trace *t, const geom_plane *plane, const double *lo, const double *hi,
                          double strict[2][FROE_MAX_DIM]) {
    unsigned reached = 0;
    int dim = t->tree->scene->dim;
    for (unsigned i = 0; i < 1u << dim && reached != 3; i++) {
        double x[FROE_MAX_DIM] = {0};
        for (int k = 0; k < dim; k++) x[k] = i >> k & 1 ? hi[k] : lo[k];
        int side = geom_side_vertex(&t->context, plane, x);
        if (!side || reached >> (side > 0) & 1) continue;
        reached |= side > 0 ? 2 : 1;
        memcpy(strict[side > 0], x, sizeof x);
    }
    return reached;
}

static unsigned interval_reach(double lo, double hi, double c) {
    return (lo < c ? 1u : 0) | (hi > c ? 2u : 0);
}

/* Below an oblique cut the whole box may be listed on every side it reaches; the part says where it must be. */
static unsigned cut_box(tree_trace *t, const geom_plane *plane, const trace_solid *at, trace_solid child[2]) {
    const int axis = plane->axis;
    const double c = plane->c;
    double strict[2][FROE_MAX_DIM], any[2][FROE_MAX_DIM], lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    unsigned part, whole;
    scene_object_bounds(t->tree->scene, t->object, lo, hi);
    if (plane->form == GEOM_AXIS) {
        child[0].inside = at->inside && at->witness[axis] <= c;
        child[1].inside = at->inside && at->witness[axis] >= c;
        part = interval_reach(at->lo[axis], at->hi[axis], c);
        whole = interval_reach(lo[axis], hi[axis], c);
        if (part == 3) child[0].hi[axis] = child[1].lo[axis] = c;
        if (c <= hi[axis]) child[0].bounded |= (uint16_t)(2u << 2 * axis);
        if (c >= lo[axis]) child[1].bounded |= (uint16_t)(1u << 2 * axis);
    } else {
        part = box_reach(t, plane, at->lo, at->hi, strict);
        whole = box_reach(t, plane, lo, hi, any);
        child[0].oblique = child[1].oblique = true;
        int side = part == 3 && at->inside && !at->exact ? geom_side_vertex(&t->context, plane, at->witness) : 0;
        for (int i = 0; part == 3 && i < 2; i++) {
            child[i].exact = false;
            child[i].inside = at->exact || (at->inside && side == (i ? 1 : -1));
            if (at->exact) memcpy(child[i].witness, strict[i], sizeof strict[i]);
        }
    }
    if (!child[0].oblique) return part;
    for (unsigned i = 0; i < 2; i++)
        if (!(part >> i & 1)) child[i].exact = child[i].inside = false;
    return whole;
}

/* ------------------------------------------------------------------- balls -- */

/* Does the closed ball, r > 0, meet the open cell? */
static bool ball_meets(tree_trace *t, const trace_solid *at) {
    const froe_scene *s = t->tree->scene;
    const double *c = scene_point(s, t->object, 0);
    double from[FROE_MAX_DIM], to[FROE_MAX_DIM];
    int gaps = 0;
    for (int k = 0; k < s->dim; k++) {
        if (at->lo[k] >= at->hi[k]) return false; /* a cut beside its cell leaves an empty one */
        if (c[k] >= at->lo[k] && c[k] <= at->hi[k]) continue;
        from[gaps] = c[k];
        to[gaps++] = c[k] < at->lo[k] ? at->lo[k] : at->hi[k];
    }
    return geom_reach_over_gaps(&t->context, gaps, from, to, scene_radius(s, t->object), 0) > 0;
}

static unsigned cut_ball(tree_trace *t, const geom_plane *plane, const trace_solid *at, trace_solid child[2]) {
    const froe_scene *s = t->tree->scene;
    const double *centre = scene_point(s, t->object, 0);
    int side = geom_side_ball(&t->context, plane, centre, scene_radius(s, t->object));
    bool axis = plane->form == GEOM_AXIS;
    if (axis) {
        child[0].hi[plane->axis] = fmin(at->hi[plane->axis], plane->c);
        child[1].lo[plane->axis] = fmax(at->lo[plane->axis], plane->c);
    }
    if (side != 2) return side < 0 ? 1 : side > 0 ? 2 : 0;
    int middle = geom_side_vertex(&t->context, plane, centre);
    for (int i = 0; i < 2; i++) {
        child[i].exact = at->exact && axis;
        child[i].inside = at->inside && middle == (i ? 1 : -1);
    }
    return 3;
}

/* ------------------------------------------------------------------- hulls -- */

/* Corners of the hull on each side of the cut; those strictly on a side, of the corners known to be inside, follow
 * one another behind the waiting ones: first the positive, then the negative. */
static unsigned cut_hull(tree_trace *t, const geom_plane *plane, const trace_solid *at, trace_solid child[2]) {
    const froe_scene *s = t->tree->scene;
    uint32_t n = scene_corners(s, t->object);
    unsigned reached = 0;
    t->sides.count = 0;
    for (uint32_t i = 0; i < n; i++) {
        int side = geom_side_vertex(&t->context, plane, scene_point(s, t->object, i));
        t->sides.data[t->sides.count++] = (int8_t)side;
        if (side) reached |= side > 0 ? 2 : 1;
    }
    if (reached != 3) return reached; /* nothing changes: all corners stay where they are */
    uint32_t *known = t->ring.data + at->first;
    t->ring.count = at->first + at->count;
    for (int i = 1; i >= 0; i--) {
        child[i].exact = false;
        child[i].first = (uint32_t)t->ring.count;
        for (uint32_t k = 0; k < at->count; k++)
            if (t->sides.data[known[k]] == (i ? 1 : -1)) t->ring.data[t->ring.count++] = known[k];
        child[i].count = (uint32_t)t->ring.count - child[i].first;
        child[i].inside = child[i].count > 0;
    }
    return reached;
}

/* ----------------------------------------------------------------- tracing -- */

static void arrive_solid(tree_trace *t, const trace_solid *at, bool leaf) {
    trace_place place = {.node = at->node, .must = at->exact || at->inside};
    const bool ball = leaf && scene_form(t->tree->scene, t->object) == FROE_BALL && at->exact;
    if (ball && !at->inside) place.must = ball_meets(t, at);
    place.unsure = leaf && !ball && !place.must;
    t->stopped = !t->fn(t->user, &place);
}

/* Is the object a box that is listed here as a cover? */
static bool is_cover(tree_trace *t, const trace_solid *at) {
    if (!tree_covers(t->tree, t->tree->nodes + at->node)) return false;
    const unsigned all = (1u << 2 * t->tree->scene->dim) - 1;
    return t->cover_fn(t->user, at->node, at->bounded == all, &t->stopped);
}

/* A box wholly on one side of an axis-parallel cut goes there as it is, which is quick: boxes one in the other lie
 * below long rows of such cuts. False: the cut is another one, or the box is on both sides, or in it. */
static bool pass_cut(const tree_trace *t, trace_solid *at, const double *lo, const double *hi) {
    const tree_node *n = t->tree->nodes + at->node;
    const tree_cut *cut = n->type == TREE_TABLED ? t->tree->cuts + n->u.cut : NULL;
    if (at->oblique || (cut && cut->kind != FROE_CUT_AXIS)) return false;
    const uint32_t axis = cut ? cut->a : n->axis;
    const double c = cut ? cut->u.value : n->u.value;
    const unsigned reached = interval_reach(at->lo[axis], at->hi[axis], c);
    if (reached == 1 && c <= hi[axis]) at->bounded |= (uint16_t)(2u << 2 * axis);
    if (reached == 2 && c >= lo[axis]) at->bounded |= (uint16_t)(1u << 2 * axis);
    if (reached == 1 || reached == 2) at->node = n->child + (reached == 2);
    return reached == 1 || reached == 2;
}

/* Carries a waiting solid on; what is on the positive side of cuts on its way waits. False without memory. */
static bool follow_solid(tree_trace *t, trace_solid at) {
    const froe_kind form = scene_form(t->tree->scene, t->object);
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    scene_object_bounds(t->tree->scene, t->object, lo, hi);
    for (;;) {
        if (form == FROE_BOX && is_cover(t, &at)) return true;
        if (tree_is_leaf(t->tree->nodes + at.node)) break;
        if (form == FROE_BOX && pass_cut(t, &at, lo, hi)) continue;
        const geom_plane *plane = trace_plane(t, at.node);
        trace_solid child[2] = {at, at};
        child[0].node = t->tree->nodes[at.node].child;
        child[1].node = child[0].node + 1;
        if (form == FROE_HULL && !array_reserve(&t->alloc, &t->ring, 2 * (size_t)at.count)) return false;
        unsigned reached = form == FROE_BOX    ? cut_box(t, plane, &at, child)
                           : form == FROE_BALL ? cut_ball(t, plane, &at, child)
                                               : cut_hull(t, plane, &at, child);
        if (!reached) {
            arrive_solid(t, &at, false);
            return true;
        }
        if (reached == 3 && !array_push(&t->alloc, &t->solids, child[1])) return false;
        at = child[reached == 2];
    }
    arrive_solid(t, &at, true);
    return true;
}

froe_status trace_solid_object(tree_trace *t) {
    const froe_scene *s = t->tree->scene;
    const froe_kind form = scene_form(s, t->object);
    trace_solid root = {.exact = true, .inside = true};
    for (int k = 0; k < s->dim; k++) root.lo[k] = -INFINITY, root.hi[k] = INFINITY;
    if (form == FROE_BOX) {
        scene_object_bounds(s, t->object, root.lo, root.hi);
        memcpy(root.witness, root.lo, sizeof root.witness);
    }
    t->ring.count = t->solids.count = 0;
    if (form == FROE_HULL) {
        root.count = scene_corners(s, t->object);
        if (!array_reserve(&t->alloc, &t->sides, root.count) || !array_reserve(&t->alloc, &t->ring, root.count))
            return FROE_E_MEMORY;
        for (uint32_t i = 0; i < root.count; i++) t->ring.data[t->ring.count++] = i;
    }
    bool room = array_push(&t->alloc, &t->solids, root);
    while (room && !t->stopped && t->solids.count) {
        trace_solid at = t->solids.data[--t->solids.count];
        room = follow_solid(t, at);
    }
    return room ? FROE_OK : FROE_E_MEMORY;
}
