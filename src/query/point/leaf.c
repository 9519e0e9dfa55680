/* leaf.c: from a table or a search by centroids down to the leaf. */
#include "query/point/leaf.h"
#include "geom/predicates.h"
#include "query/cuts.h"
#include "query/point/descent.h"
#include "query/range/centroids.h"
#include "query/segment.h"
#include "tree/packed/table.h"

/* Side of a point beside a tabled cut of the plane, as geom/plane.h has it, without laying it out; NUM_UNSURE: that
 * it must be. */
static int side_in_plane(froe_query *q, const tree_cut *cut, const double *x) {
    const froe_scene *s = q->tree->scene;
    const double *u;
    switch (cut->kind) {
    case FROE_CUT_OBJECT: /* a segment: other objects of the plane have no line */
        return query_turn(&q->numbers, scene_point(s, cut->a, 0), scene_point(s, cut->a, 1), x);
    case FROE_CUT_VERTICES:
        return query_turn(&q->numbers, scene_vertex(s, cut->a), scene_vertex(s, cut->u.id.b), x);
    case FROE_CUT_VERTEX:
        u = scene_vertex(s, cut->a);
        return x[0] != u[0] ? (x[0] > u[0]) - (x[0] < u[0]) : (x[1] > u[1]) - (x[1] < u[1]);
    default:
        return NUM_UNSURE;
    }
}

/* Side of a point beside the cut of a node: -1, 0, 1. No planes are needed but in space. */
static int side_of_point(froe_query *q, const query_planes *planes, uint32_t node, const double *x) {
    const froe_tree *t = q->tree;
    const tree_node *n = t->nodes + node;
    if (n->type == TREE_PLAIN) return (x[n->axis] > n->u.value) - (x[n->axis] < n->u.value);
    if (planes) {
        const query_cut cut = query_cut_at(t, planes, n);
        double error;
        if (cut.axis >= 0) return (x[cut.axis] > cut.value) - (x[cut.axis] < cut.value);
        const double value = query_plane_value(cut.plane, 3, x, &error);
        if (q->numbers.first == NUM_FILTER && fabs(value) > error) return value > 0 ? 1 : -1;
    } else {
        const int side = side_in_plane(q, t->cuts + n->u.cut, x);
        if (side != NUM_UNSURE) return side;
    }
    const geom_plane plane = tree_plane_at(t, node);
    return geom_side_vertex(&q->numbers, &plane, x);
}

/* Down the tree itself. */
static query_leaf go_down(froe_query *q, const query_planes *planes, uint32_t node, const double *x) {
    bool on_cut = false;
    for (; !tree_is_leaf(q->tree->nodes + node); q->stats.nodes++) {
        const int side = side_of_point(q, planes, node, x);
        on_cut |= side == 0;
        node = q->tree->nodes[node].child + (side > 0);
    }
    return (query_leaf){.place = query_leaf_place(q->tree, node), .on_cut = on_cut};
}

/* In a packed tree, by the entry of its jump table for a point in the core of a cell. */
static query_leaf find_packed(froe_query *q, const query_planes *planes, const double *x) {
    const tree_table *table = q->tree->packed.table;
    uint32_t cell[2];
    for (int k = 0; k < 2; k++) {
        const double place = table ? tree_table_place(table, k, x[k]) : -1;
        if (!(place >= 0 && place < table->cells[k])) return go_down(q, planes, 0, x);
        cell[k] = (uint32_t)place;
        if (place < cell[k] + TABLE_MARGIN || place > cell[k] + 1 - TABLE_MARGIN) return go_down(q, planes, 0, x);
    }
    const tree_entry entry = tree_table_at(table, cell[0], cell[1]);
    return entry.kind & TABLE_LEAF ? (query_leaf){.place = entry.at} : go_down(q, planes, entry.at, x);
}

/* -------------------------------------------------------------------- ways -- */

/** What leads to leaves. */
typedef struct ways {
    const query_centroids *centroids; /* of deep trees; NULL for others */
    const query_descent *descent;
    const query_planes *planes; /* in space; elsewhere the planes of the tree do */
    bool descends;
} ways;

static froe_status find_ways(froe_query *q, ways *w) {
    froe_status status = query_is_deep(q->tree) ? query_centroids_of(q, &w->centroids, NULL) : FROE_OK;
    if (!status) status = query_descent_of(q, &w->descent, NULL);
    if (!status && q->tree->scene->dim == 3) status = query_planes_of(q, &w->planes, NULL);
    if (!status) w->descends = w->descent->there && q->numbers.first == NUM_FILTER;
    return status;
}

/* Without a descent, or where it leads too far. */
static query_leaf find_by_tree(froe_query *q, const ways *w, const double *x) {
    if (tree_is_packed(q->tree) && !w->centroids) return find_packed(q, w->planes, x);
    const uint32_t node = w->centroids ? query_centroid_find(w->centroids, x, x, &q->stats.steps) : 0;
    return go_down(q, w->planes, node, x);
}

/* ----------------------------------------------------------------- descent -- */

enum {
    POINTS_AT_ONCE = 16, /* points that go down in turns */
    POINTS_AHEAD = 8,    /* points whose table entries are prefetched before their turn */
    MOST_FLOAT_CUTS = 32 /* cuts in deep trees before the search by centroids: about its cost */
};

/** A point in progress, and its number. */
typedef struct leaf_search {
    descent_point p;
    uint32_t steps;
    bool on_cut;
    size_t number;
} leaf_search;

/* Passes a cut: by floats, or, where these are in doubt, by the exact cut of the tree. */
static void pass_cut(froe_query *q, const query_descent *d, leaf_search *f, const double *x) {
    const descent_cut *cut = d->cuts + f->p.next;
    const float value = query_descent_value(cut, f->p.at);
    bool right = value > 0;
    q->stats.nodes++;
    f->steps++;
    if (!(fabsf(value) > DESCENT_DOUBT)) {
        const uint32_t node = d->nodes[f->p.next];
        const int side = side_of_point(q, NULL, node & ~DESCENT_BACK, x);
        f->on_cut |= side == 0;
        right = (side > 0) != !!(node & DESCENT_BACK);
    }
    f->p.next = query_descent_next(cut, right);
}

/* Has the point come to its leaf, or passed MOST_FLOAT_CUTS cuts? Centroids say nothing of oblique cuts. */
static bool has_come(const ways *w, const leaf_search *f) {
    return f->p.next & DESCENT_LEAF ||
           (f->steps >= MOST_FLOAT_CUTS && w->centroids && !(w->centroids->root & CENTROID_END));
}

static query_leaf arrive_at_leaf(froe_query *q, const ways *w, const leaf_search *f, const double *x) {
    if (!(f->p.next & DESCENT_LEAF)) return find_by_tree(q, w, x);
    return (query_leaf){.place = f->p.next & DESCENT_NODE, .on_cut = f->on_cut, .empty = f->p.next & DESCENT_EMPTY};
}

/* Begins the next of the points that are in the scene. */
static inline size_t launch_points(froe_query *q, const ways *w, const double *points, size_t count, size_t next,
                                   leaf_search *f, query_leaf *leaves, bool *flies) {
    for (*flies = false; next < count && !*flies; next++) {
        *f = (leaf_search){.number = next};
        if (next + POINTS_AHEAD < count) query_descent_ask(w->descent, points + 2 * (next + POINTS_AHEAD));
        *flies = query_descent_begin(w->descent, points + 2 * next, &f->p);
        if (!*flies) leaves[next] = find_by_tree(q, w, points + 2 * next);
    }
    return next;
}

/* ------------------------------------------------------------------- whole -- */

froe_status query_leaf_find(froe_query *q, const double *point, query_leaf *out) {
    leaf_search f = {.number = 0};
    ways w = {.planes = NULL};
    const froe_status status = find_ways(q, &w);
    if (status) return status;
    q->stats.leaves++;
    if (w.descends && query_descent_begin(w.descent, point, &f.p)) {
        while (!has_come(&w, &f)) pass_cut(q, w.descent, &f, point);
        *out = arrive_at_leaf(q, &w, &f, point);
    } else {
        *out = find_by_tree(q, &w, point);
    }
    return FROE_OK;
}

/* Each point in turn passes a cut and prefetches its next one, which is in the cache at its next turn. */
froe_status query_leaf_find_all(froe_query *q, const double *points, size_t count, query_leaf *leaves) {
    const size_t dim = (size_t)q->tree->scene->dim;
    ways w = {.planes = NULL};
    leaf_search batch[POINTS_AT_ONCE];
    size_t next = 0, flying = 0;
    const froe_status status = find_ways(q, &w);
    if (status) return status;
    q->stats.leaves += count;
    for (size_t i = 0; i < count && !w.descends; i++) leaves[i] = find_by_tree(q, &w, points + i * dim);
    for (bool flies = w.descends; flying < POINTS_AT_ONCE && flies; flying += flies)
        next = launch_points(q, &w, points, count, next, batch + flying, leaves, &flies);
    for (size_t i = 0; flying; i = i + 1 < flying ? i + 1 : 0) {
        leaf_search *f = batch + i;
        const double *x = points + 2 * f->number;
        bool flies;
        if (!has_come(&w, f)) {
            pass_cut(q, w.descent, f, x);
            if (!(f->p.next & DESCENT_LEAF)) __builtin_prefetch(w.descent->cuts + f->p.next);
            continue;
        }
        leaves[f->number] = arrive_at_leaf(q, &w, f, x);
        next = launch_points(q, &w, points, count, next, f, leaves, &flies);
        if (!flies) *f = batch[--flying];
        if (i == flying) i = 0;
    }
    return FROE_OK;
}
