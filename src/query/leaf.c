/* leaf.c: from a head start down to the leaf. */
#include "query/leaf.h"
#include "geom/predicates.h"
#include "query/centroids.h"
#include "query/cuts.h"
#include "query/descent.h"
#include "tree/table.h"
#include <string.h>

/* Side of a point beside the cut of a node: -1, 0, 1. planes may be NULL. */
static int side_of(froe_query *q, const query_planes *planes, uint32_t node, const double *x) {
    const query_cut cut = planes ? query_cut_at(q->tree, planes, q->tree->nodes + node) : (query_cut){.axis = -1};
    if (cut.axis >= 0) return (x[cut.axis] > cut.value) - (x[cut.axis] < cut.value);
    double at[3] = {0}, error = INFINITY, value = 0;
    memcpy(at, x, (size_t)q->tree->scene->dim * sizeof *x);
    if (planes) value = query_plane_value(cut.plane, at, &error);
    if (q->numbers.first == NUM_FILTER && fabs(value) > error) return value > 0 ? 1 : -1;
    const geom_plane plane = tree_plane_at(q->tree, node);
    return geom_side_vertex(&q->numbers, &plane, x);
}

/* Down the tree itself. */
static query_leaf go_down(froe_query *q, const query_planes *planes, uint32_t node, const double *x) {
    bool on_cut = false;
    for (; !tree_is_leaf(q->tree->nodes + node); q->stats.nodes++) {
        const int side = side_of(q, planes, node, x);
        on_cut |= side == 0;
        node = q->tree->nodes[node].child + (side > 0);
    }
    return (query_leaf){.place = query_leaf_place(q->tree, node), .on_cut = on_cut};
}

/* ------------------------------------------------------------------- table -- */

/* The entry of the jump table of a packed tree for a point in the core of a cell. */
static bool find_entry(const tree_table *table, const double *x, tree_entry *out) {
    uint32_t cell[2];
    for (int k = 0; k < 2; k++) {
        const double place = tree_table_place(table, k, x[k]);
        if (!(place >= 0 && place < table->cells[k])) return false;
        cell[k] = (uint32_t)place;
        if (place < cell[k] + TABLE_HAIR || place > cell[k] + 1 - TABLE_HAIR) return false;
    }
    *out = tree_table_at(table, cell[0], cell[1]);
    return true;
}

static query_leaf find_packed(froe_query *q, const query_planes *planes, const double *x) {
    tree_entry entry;
    if (!q->tree->packed.table || !find_entry(q->tree->packed.table, x, &entry)) return go_down(q, planes, 0, x);
    return entry.kind & TABLE_LEAF ? (query_leaf){.place = entry.at} : go_down(q, planes, entry.at, x);
}

/* ----------------------------------------------------------------- descent -- */

/* Passes a cut; one that floats cannot tell from the point as the tree has it. */
static void pass(froe_query *q, const query_descent *d, descent_point *p, const double *x, bool *on_cut) {
    const descent_cut *cut = d->cuts + p->next;
    const float value = query_descent_value(cut, p->at);
    bool right = value > 0;
    q->stats.nodes++;
    if (!(fabsf(value) > DESCENT_DOUBT)) {
        const uint32_t node = d->nodes[p->next];
        const int side = side_of(q, NULL, node & ~DESCENT_BACK, x);
        *on_cut |= side == 0;
        right = (side > 0) != !!(node & DESCENT_BACK);
    }
    p->next = query_descent_next(cut, right);
}

static query_leaf arrive(const descent_point *p, bool on_cut) {
    return (query_leaf){.place = p->next & DESCENT_NODE, .on_cut = on_cut, .empty = p->next & DESCENT_EMPTY};
}

static query_leaf find_by_descent(froe_query *q, const query_descent *d, const double *x) {
    descent_point p;
    bool on_cut = false;
    if (!query_descent_begin(d, x, &p)) return go_down(q, NULL, 0, x);
    while (!(p.next & DESCENT_LEAF)) pass(q, d, &p, x, &on_cut);
    return arrive(&p, on_cut);
}

/* ------------------------------------------------------------------- flock -- */

enum { FLIGHT = 16, AHEAD = 8 };

/** A point on its way, and which of them it is. */
typedef struct flyer {
    descent_point p;
    bool on_cut;
    size_t number;
} flyer;

/* Begins the next of the points that are in the scene. */
static size_t launch(froe_query *q, const query_descent *d, const double *points, size_t count, size_t next, flyer *f,
                     query_leaf *leaves, bool *flies) {
    for (*flies = false; next < count && !*flies; next++) {
        *f = (flyer){.number = next};
        if (next + AHEAD < count) query_descent_ask(d, points + 2 * (next + AHEAD));
        *flies = query_descent_begin(d, points + 2 * next, &f->p);
        if (!*flies) leaves[next] = go_down(q, NULL, 0, points + 2 * next);
    }
    return next;
}

/* Points go down in turns: each asks for its next cut, which has come when it is its turn again. */
static void find_flock(froe_query *q, const query_descent *d, const double *points, size_t count, query_leaf *leaves) {
    flyer flock[FLIGHT];
    size_t next = 0, flying = 0;
    for (bool flies = true; flying < FLIGHT && flies; flying += flies)
        next = launch(q, d, points, count, next, flock + flying, leaves, &flies);
    for (size_t i = 0; flying; i = i + 1 < flying ? i + 1 : 0) {
        flyer *f = flock + i;
        bool flies;
        if (!(f->p.next & DESCENT_LEAF)) {
            pass(q, d, &f->p, points + 2 * f->number, &f->on_cut);
            if (!(f->p.next & DESCENT_LEAF)) __builtin_prefetch(d->cuts + f->p.next);
            continue;
        }
        leaves[f->number] = arrive(&f->p, f->on_cut);
        next = launch(q, d, points, count, next, f, leaves, &flies);
        if (!flies) *f = flock[--flying];
        if (i == flying) i = 0;
    }
}

/* ------------------------------------------------------------------- whole -- */

static bool descends(const froe_query *q, const query_centroids *centroids, const query_descent *descent) {
    return descent->there && !centroids && q->numbers.first == NUM_FILTER;
}

/* Centroids for deep trees only: NULL for others. */
static froe_status prepare(froe_query *q, const query_centroids **centroids, const query_descent **descent) {
    *centroids = NULL;
    const froe_status status = query_is_deep(q->tree) ? query_centroids_of(q, centroids, NULL) : FROE_OK;
    return status ? status : query_descent_of(q, descent, NULL);
}

static froe_status find_slowly(froe_query *q, const query_centroids *centroids, const double *x, query_leaf *out) {
    const query_planes *planes;
    const froe_status status = query_planes_of(q, &planes, NULL);
    if (status) return status;
    if (centroids)
        *out = go_down(q, planes, query_centroid_find(centroids, x, x, &q->stats.steps), x);
    else
        *out = tree_is_packed(q->tree) ? find_packed(q, planes, x) : go_down(q, planes, 0, x);
    return FROE_OK;
}

froe_status query_leaf_find(froe_query *q, const double *point, query_leaf *out) {
    const query_centroids *centroids;
    const query_descent *descent;
    froe_status status = prepare(q, &centroids, &descent);
    if (status) return status;
    q->stats.leaves++;
    if (!descends(q, centroids, descent)) return find_slowly(q, centroids, point, out);
    *out = find_by_descent(q, descent, point);
    return FROE_OK;
}

froe_status query_leaf_find_all(froe_query *q, const double *points, size_t count, query_leaf *leaves) {
    const query_centroids *centroids;
    const query_descent *descent;
    const size_t dim = (size_t)q->tree->scene->dim;
    froe_status status = prepare(q, &centroids, &descent);
    if (status) return status;
    q->stats.leaves += count;
    if (descends(q, centroids, descent)) {
        find_flock(q, descent, points, count, leaves);
        return FROE_OK;
    }
    for (size_t i = 0; i < count && !status; i++) status = find_slowly(q, centroids, points + i * dim, leaves + i);
    return status;
}
