/* range_walk.c: from the root to all lists that may hold objects which meet the range.
 *
 * At a cut the range is on one side for certain, or both children and the list of the cut are visited: with
 * objects listed where they meet open cells, and ranges and regions closed, that misses nothing (if an object and
 * the range share a point, some list visited has the object). Where a region lies in the range, all lists below it
 * are one slice, reported without a test.
 *
 * A node that is visited has the covers of its list tested; its region meets the range, so they do, too, as a rule.
 *
 * In deep trees, after 16 missed cuts the search jumps to the next one that the range meets (jump.h).
 *
 * A waiting node has its region's bounds and, for solid ranges, those of the range within the region. Thin ranges
 * (segments, rays) have an interval of their parameter instead: origin + t direction. */
#include "query/covers.h"
#include "query/cuts.h"
#include "query/pieces.h"
#include "query/range/jump.h"
#include "tree/list.h"
#include "tree/packed/space.h"
#include <string.h>

typedef struct range_walk {
    froe_query *q;
    const froe_tree *tree;
    const query_planes *planes;
    const query_covers *covers; /* NULL: the tree has none */
    query_jump jump;
    const query_pieces *pieces;
    query_range *r;
    int dim;
    bool points;  /* are leaves tested by coordinates? */
    size_t width; /* doubles of a waiting node */
    bool memory;  /* ran out */
} range_walk;

static bool done(const range_walk *w) {
    return w->memory || (w->r->any && w->q->found.count);
}

/* ------------------------------------------------------------------- lists -- */

/* Reports those objects that meet the range, of the list of a leaf, or of a cut that the range may touch; or of the
 * covers of an inner node, which are visited before its cut. */
static void visit_list(range_walk *w, uint32_t node, bool covers) {
    tree_objects list = tree_list(w->tree, node);
    if (w->covers && covers) list = tree_cover_list(w->tree, node);
    if (w->covers && !covers && !tree_is_leaf(w->tree->nodes + node)) list = tree_own_list(w->tree, node);
    froe_query *q = w->q;
    if (!w->points) {
        if (!query_expect(q, list.count)) w->memory = true;
        for (uint32_t i = 0; i < list.count && !w->memory; i++) {
            const uint32_t object = tree_object(&list, i);
            if (query_seen(q, &list, i, object)) continue;
            if (query_range_meets(q, object, &w->memory)) query_found(q, object);
            if (w->r->any && q->found.count) return;
        }
        return;
    }
    /* Each point is in no other list. Which of them are in the range is unpredictable, so the loop is branch-free. */
    const double *x = w->pieces->points + (size_t)list.first * (size_t)w->dim;
    if (!array_reserve(&q->alloc, &q->found, list.count)) {
        w->memory = true;
        return;
    }
    for (uint32_t i = 0; i < list.count; i++, x += w->dim) {
        const uint32_t object = tree_object(&list, i);
        int has = geom_range_has(&w->r->range, x);
        if (has == NUM_UNSURE)
            has = query_range_meets(q, object, &w->memory);
        else
            q->stats.tests++;
        q->found.data[q->found.count] = object;
        q->found.count += (size_t)has;
    }
}

/* The covers of an inner node that is visited. */
static inline void visit_covers(range_walk *w, uint32_t node) {
    if (w->covers && tree_covers(w->tree, w->tree->nodes + node)) visit_list(w, node, true);
}

/* Those of the nodes from `from` on that a jump from there to `to` has passed. */
static void visit_passed(range_walk *w, uint32_t from, uint32_t to) {
    if (!w->covers || from == to) return;
    for (uint32_t v = to; (v = query_covers_above(w->covers, v)) != FROE_NONE && v >= from;) visit_covers(w, v);
}

/* Of a list whose region is in the range: only solids, and whatever packed trees of space hold, may be listed where
 * they are not. */
static void take_list(range_walk *w, const tree_objects *list) {
    froe_query *q = w->q;
    if (!query_expect(q, list->count)) w->memory = true;
    for (uint32_t i = 0; i < list->count && !w->memory; i++) {
        const uint32_t object = tree_object(list, i);
        if (query_seen(q, list, i, object)) continue;
        const bool there = scene_form(w->tree->scene, object) < FROE_BOX && !tree_is_space(w->tree);
        if (there || query_range_meets(q, object, &w->memory)) query_found(q, object);
        if (w->r->any && q->found.count) return;
    }
}

/* Where lists lie in blocks: leaf after leaf. */
static void take_blocks(range_walk *w, uint32_t node) {
    query_range *r = w->r;
    const size_t base = r->nodes.count;
    w->memory |= !array_push(&w->q->alloc, &r->nodes, node);
    while (!done(w) && r->nodes.count > base) {
        const uint32_t at = r->nodes.data[--r->nodes.count];
        const tree_node *n = w->tree->nodes + at;
        if (tree_is_leaf(n)) {
            const tree_objects list = tree_list(w->tree, at);
            take_list(w, &list);
        } else {
            w->memory |=
                !array_push(&w->q->alloc, &r->nodes, n->child + 1) || !array_push(&w->q->alloc, &r->nodes, n->child);
        }
    }
}

/* Takes all of the lists below a node whose region is in the range. */
static void take_slice(range_walk *w, uint32_t node) {
    const froe_tree *t = w->tree;
    w->q->stats.slices++;
    if (tree_is_packed(t)) {
        take_blocks(w, node);
        return;
    }
    /* The lists of a subtree lie between that of its first cut or leaf and that of its last leaf. */
    uint32_t left = node, right = node;
    while (t->nodes[left].type == TREE_PLAIN) left = t->nodes[left].child;
    while (t->nodes[right].type != TREE_LEAF) right = t->nodes[right].child + 1;
    const tree_node *from = t->nodes + left, *last = t->nodes + right;
    const uint32_t first = from->type == TREE_LEAF ? from->u.list.first : t->cuts[from->u.cut].first;
    tree_objects list = {.stride = sizeof(tree_piece) / sizeof(uint32_t), .mask = UINT32_MAX};
    list.first = first;
    list.count = last->u.list.first + last->u.list.count - first;
    if (list.count) list.at = &t->pieces[first].object;
    if (!w->pieces->flat) {
        take_list(w, &list);
        return;
    }
    /* Objects are where they are listed. */
    froe_query *q = w->q;
    const bool whole = w->pieces->whole;
    if (!(whole ? array_reserve(&q->alloc, &q->found, list.count) : query_expect(q, list.count))) {
        w->memory = true;
        return;
    }
    uint32_t *found = q->found.data + q->found.count;
    for (uint32_t i = 0; whole && i < list.count; i++) found[i] = list.at[(size_t)i * list.stride];
    q->found.count += whole ? list.count : query_mark_all(&q->marks, list.at, list.stride, list.count, found);
}

/* ------------------------------------------------------------------- stack -- */

static void push_state(range_walk *w, uint32_t node, const double *state) {
    query_range *r = w->r;
    if (!array_push(&w->q->alloc, &r->nodes, node) || !array_reserve(&w->q->alloc, &r->boxes, w->width)) {
        w->memory = true;
        return;
    }
    memcpy(r->boxes.data + r->boxes.count, state, w->width * sizeof *state);
    r->boxes.count += w->width;
}

/* ------------------------------------------------------------------ solids -- */

enum { BOX = 2 * FROE_MAX_DIM };

/* The parts of a waiting node's state. */
typedef struct solid_state {
    double *lo, *hi;           /* bounds of the region */
    double *part_lo, *part_hi; /* bounds of the range within; for boxes and balls those of the region */
} solid_state;

static solid_state solid_state_of(const range_walk *w, double *state) {
    const size_t dim = (size_t)w->dim, part = w->width > 2 * dim ? 2 * dim : 0;
    return (solid_state){state, state + dim, state + part, state + part + dim};
}

/* As go_beside(), of a cut that is parallel to an axis. */
static bool go_beside_axis(const range_walk *w, const query_cut *cut, int side, double *state) {
    const geom_range *range = &w->r->range;
    const solid_state p = solid_state_of(w, state);
    (side ? p.lo : p.hi)[cut->axis] = cut->value;
    switch (range->kind) {
    case GEOM_RANGE_BOX:
        return side ? range->hi[cut->axis] >= cut->value : range->lo[cut->axis] <= cut->value;
    case GEOM_RANGE_BALL:
        return !geom_range_misses(range, p.lo, p.hi);
    default:
        if (side ? p.part_hi[cut->axis] < cut->value : p.part_lo[cut->axis] > cut->value) return false;
        if (side ? p.part_lo[cut->axis] < cut->value : p.part_hi[cut->axis] > cut->value) {
            (side ? p.part_lo : p.part_hi)[cut->axis] = cut->value;
            return geom_range_shrink(range, p.part_lo, p.part_hi);
        }
        return true;
    }
}

/* n . x <= c for all points of a box on that side of the plane, rounded outwards. */
static double plane_bound(const query_plane *h, int side, int dim, const double *lo, const double *hi) {
    static const double origin[FROE_MAX_DIM];
    const double *n = query_plane_normal(h, dim), *o = dim > 3 ? origin : h->o;
    double size = fabs(h->c), spread = 0, shift = 0;
    for (int k = 0; k < dim; k++) {
        const double most = filter_greater(fabs(lo[k] - o[k]), fabs(hi[k] - o[k]));
        spread += most;
        size += fabs(n[k]) * (most + fabs(o[k]));
        shift += n[k] * o[k];
    }
    const double error = (16 * FILTER_U * size + h->n_err * spread + NUM_BALL_TINY) * FILTER_UP;
    return (side ? -(h->c + shift) : h->c + shift) + error;
}

/* As go_beside(), of any other cut. */
static bool go_beside_plane(const range_walk *w, const query_cut *cut, int side, double *state) {
    const geom_range *range = &w->r->range;
    const query_plane *h = cut->plane;
    const solid_state p = solid_state_of(w, state);
    const double *normal = query_plane_normal(h, w->dim);
    double n[FROE_MAX_DIM];
    for (int k = 0; k < w->dim; k++) n[k] = side ? -normal[k] : normal[k];
    if (range->kind == GEOM_RANGE_BALL) { /* is it certainly on the other side? */
        double x[FROE_MAX_DIM], error;
        x[2] = 0;
        for (int k = 0; k < w->dim; k++) x[k] = range->set.coords[k];
        const double value = query_plane_value(h, w->dim, x, &error);
        const double length = filter_length_in(w->dim, n) + 3 * h->n_err;
        const double reach = range->set.radius * length * (1 + 0x1p-45) + error + NUM_BALL_TINY;
        if ((side ? -value : value) > reach) return false;
    }
    if (!geom_shrink_box(n, plane_bound(h, side, w->dim, p.lo, p.hi), w->dim, p.lo, p.hi)) return false;
    switch (range->kind) {
    case GEOM_RANGE_BOX: {
        double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
        for (int k = 0; k < w->dim; k++) {
            lo[k] = filter_greater(p.lo[k], range->lo[k]);
            hi[k] = p.hi[k] < range->hi[k] ? p.hi[k] : range->hi[k];
        }
        return geom_shrink_box(n, plane_bound(h, side, w->dim, lo, hi), w->dim, lo, hi);
    }
    case GEOM_RANGE_BALL:
        return !geom_range_misses(range, p.lo, p.hi);
    default:
        return geom_shrink_box(n, plane_bound(h, side, w->dim, p.part_lo, p.part_hi), w->dim, p.part_lo, p.part_hi) &&
               geom_range_shrink(range, p.part_lo, p.part_hi);
    }
}

/* Cuts the state of a region down to side 0 or 1 of a cut. False: the range is not there. */
static bool go_beside(const range_walk *w, const query_cut *cut, int side, double *state) {
    return cut->axis >= 0 ? go_beside_axis(w, cut, side, state) : go_beside_plane(w, cut, side, state);
}

/* The node where the range meets the next cut, below this one, which becomes the region of the state. */
static uint32_t jump(range_walk *w, uint32_t node, double *state) {
    const geom_range *range = &w->r->range;
    const solid_state p = solid_state_of(w, state);
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    for (int k = 0; k < w->dim; k++) {
        lo[k] = filter_greater(p.part_lo[k], range->lo[k]);
        hi[k] = p.part_hi[k] < range->hi[k] ? p.part_hi[k] : range->hi[k];
    }
    const uint32_t found = query_jump_below(&w->jump, node, lo, hi);
    if (found == node) return node;
    visit_passed(w, node, found);
    const double *box = query_centroid_box(w->jump.centroids, found);
    for (int k = 0; k < w->dim; k++) {
        p.lo[k] = filter_greater(p.lo[k], box[k]);
        p.hi[k] = p.hi[k] < box[w->dim + k] ? p.hi[k] : box[w->dim + k];
    }
    return found;
}

/* Goes down from a node to the first leaf, or to nothing; leaves what is beside for later. */
static void follow_solid(range_walk *w, uint32_t node, double *state) {
    double other[2 * BOX];
    for (int passed = 0; !done(w); passed++) {
        if (query_jump_is_due(&w->jump, passed)) node = jump(w, node, state);
        const tree_node *n = w->tree->nodes + node;
        const solid_state p = solid_state_of(w, state);
        w->q->stats.nodes++;
        if (geom_range_holds(&w->q->numbers, &w->r->range, w->r->margin, p.lo, p.hi)) {
            take_slice(w, node);
            return;
        }
        if (tree_is_leaf(n)) {
            w->q->stats.leaves++;
            visit_list(w, node, false);
            return;
        }
        visit_covers(w, node);
        const query_cut cut = query_cut_at(w->tree, w->planes, n);
        memcpy(other, state, w->width * sizeof *state);
        const bool left = go_beside(w, &cut, 0, state), right = go_beside(w, &cut, 1, other);
        if (!left && !right) return;
        if (left && right) {
            push_state(w, n->child + 1, other);
            if (n->type == TREE_TABLED) visit_list(w, node, false);
            passed = -1;
        }
        if (!left) memcpy(state, other, w->width * sizeof *state);
        node = n->child + !left;
    }
}

/* ------------------------------------------------------------- thin ranges -- */

/* The sides of a cut that the range reaches for t[0] <= t <= t[1], which is divided for both. */
static unsigned divide_interval(const range_walk *w, const query_cut *cut, const double *t, double below[2],
                                double above[2]) {
    const geom_convex *set = &w->r->range.set;
    const double *o = geom_convex_point(set, 0), *e = geom_convex_point(set, 1);
    num_ball value, slope;
    memcpy(below, t, 2 * sizeof *t);
    memcpy(above, t, 2 * sizeof *t);
    if (cut->axis >= 0) {
        const double d = set->core == GEOM_CORE_RAY ? e[cut->axis] : e[cut->axis] - o[cut->axis];
        value = filter_difference(o[cut->axis], cut->value);
        slope = (num_ball){d, set->core == GEOM_CORE_RAY ? 0 : 2 * FILTER_U * fabs(d)};
    } else {
        double x[FROE_MAX_DIM], d[FROE_MAX_DIM];
        x[2] = d[2] = 0;
        for (int k = 0; k < w->dim; k++) x[k] = o[k], d[k] = set->core == GEOM_CORE_RAY ? e[k] : e[k] - o[k];
        value.x = query_plane_value(cut->plane, w->dim, x, &value.e);
        slope.x = query_plane_slope(cut->plane, w->dim, d, &slope.e);
        slope.e += slope.e; /* pays for the differences in d, too */
    }
    if (fabs(slope.x) > slope.e) {
        const num_ball crossing = filter_div(value, slope);
        const double at = -crossing.x;
        if (isfinite(at) && isfinite(crossing.e)) {
            const bool rising = slope.x > 0;
            double *first = rising ? below : above, *last = rising ? above : below;
            const double late = nextafter(at + crossing.e, INFINITY), early = nextafter(at - crossing.e, -INFINITY);
            if (late < t[0]) return rising ? 2 : 1;
            if (early > t[1]) return rising ? 1 : 2;
            if (late < t[1]) first[1] = late;
            if (early > t[0]) last[0] = early;
            return 3;
        }
    }
    /* Nothing is known of where the cut lies on the range. */
    const double most = slope.x == 0 && slope.e == 0 ? 0 : (fabs(slope.x) + slope.e) * t[1] * (1 + 0x1p-45);
    const double reach = (value.e + most) * FILTER_UP;
    return value.x > reach ? 2 : value.x < -reach ? 1 : 3; /* on both for a NaN */
}

/* The same for the part of a thin range with parameters in an interval: its bounds, rounded outwards. An infinite
 * parameter is in no region. */
static uint32_t jump_thin(range_walk *w, uint32_t node, const double *t) {
    const geom_convex *set = &w->r->range.set;
    const double *o = geom_convex_point(set, 0), *e = geom_convex_point(set, 1);
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    for (int k = 0; k < w->dim; k++) {
        const double d = set->core == GEOM_CORE_RAY ? e[k] : e[k] - o[k], x = o[k] + t[0] * d, y = o[k] + t[1] * d;
        const double error = 8 * FILTER_U * (fabs(o[k]) + t[1] * fabs(d)) + NUM_BALL_TINY;
        lo[k] = (x < y ? x : y) - error;
        hi[k] = (x < y ? y : x) + error;
        if (!(lo[k] > -INFINITY && hi[k] < INFINITY)) return node; /* of numbers that are none, too */
    }
    const uint32_t found = query_jump_below(&w->jump, node, lo, hi);
    visit_passed(w, node, found);
    return found;
}

static void follow_thin(range_walk *w, uint32_t node, double *t) {
    for (int passed = 0; !done(w); passed++) {
        if (query_jump_is_due(&w->jump, passed)) node = jump_thin(w, node, t);
        const tree_node *n = w->tree->nodes + node;
        double below[2], above[2];
        w->q->stats.nodes++;
        if (tree_is_leaf(n)) {
            w->q->stats.leaves++;
            visit_list(w, node, false);
            return;
        }
        visit_covers(w, node);
        const query_cut cut = query_cut_at(w->tree, w->planes, n);
        const unsigned sides = divide_interval(w, &cut, t, below, above);
        if (sides == 3) {
            push_state(w, n->child + 1, above);
            if (n->type == TREE_TABLED) visit_list(w, node, false);
            passed = -1;
        }
        memcpy(t, sides == 2 ? above : below, 2 * sizeof *t);
        node = n->child + (sides == 2);
    }
}

/* -------------------------------------------------------------------- walk -- */

froe_status query_range_walk(froe_query *q) {
    range_walk w = {.q = q, .tree = q->tree, .r = &q->range, .dim = q->tree->scene->dim};
    double state[2 * BOX];
    froe_status status = query_planes_of(q, &w.planes, NULL);
    if (!status) status = query_jump_prepare(q, q->range.walk, &w.jump);
    if (!status) status = query_pieces_of(q, &w.pieces, NULL);
    if (!status && w.tree->report.covers) status = query_covers_of(q, &w.covers, NULL);
    if (status) return status;
    w.points = w.pieces->points && q->numbers.first == NUM_FILTER;
    q->range.nodes.count = q->range.boxes.count = 0;
    if (!q->tree->scene->object_count) return FROE_OK;
    /* The state of the root. */
    const froe_scene *s = w.tree->scene;
    const geom_range *range = &w.r->range;
    const size_t dim = (size_t)w.dim;
    const bool thin = range->kind == GEOM_RANGE_THIN, solid = range->kind == GEOM_RANGE_SOLID;
    w.width = thin ? 2 : solid ? 4 * dim : 2 * dim;
    if (thin) {
        state[0] = 0;
        state[1] = w.r->shape == FROE_SHAPE_RAY ? INFINITY : 1;
    } else {
        const solid_state p = solid_state_of(&w, state);
        memcpy(p.lo, s->lo, dim * sizeof *state);
        memcpy(p.hi, s->hi, dim * sizeof *state);
        for (size_t k = 0; k < dim; k++)
            if (range->lo[k] > s->hi[k] || range->hi[k] < s->lo[k]) return FROE_OK; /* apart from the scene */
        for (size_t k = 0; k < dim && solid; k++) {
            p.part_lo[k] = filter_greater(s->lo[k], range->lo[k]);
            p.part_hi[k] = s->hi[k] < range->hi[k] ? s->hi[k] : range->hi[k];
        }
        if (solid && !geom_range_shrink(range, p.part_lo, p.part_hi)) return FROE_OK;
    }
    push_state(&w, 0, state);
    while (!done(&w) && q->range.nodes.count) {
        const uint32_t node = q->range.nodes.data[--q->range.nodes.count];
        q->range.boxes.count -= w.width;
        memcpy(state, q->range.boxes.data + q->range.boxes.count, w.width * sizeof *state);
        thin ? follow_thin(&w, node, state) : follow_solid(&w, node, state);
    }
    return w.memory ? FROE_E_MEMORY : FROE_OK;
}
