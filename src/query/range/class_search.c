/* class_search.c: a range is searched for in the classes, one after the other. */
#include "query/point/leaf.h"
#include "query/range/classes.h"
#include "support/fail.h"
#include "tree/list.h"

/* The cube around a range. */
typedef struct range_cube {
    double centre[FROE_MAX_DIM], reach;
} range_cube;

/* a - b, rounded up. */
static double difference_above(double a, double b) {
    const double x = a - b, b_about = a - x, rest = (a - (x + b_about)) + (b_about - b); /* Knuth: x + rest = a - b */
    return rest <= 0 ? x : nextafter(x, INFINITY);
}

/* Infinite for ranges without known bounds, halfspaces among them. */
static range_cube cube_of(const query_range *r) {
    const geom_range *range = &r->range;
    range_cube c = {.reach = r->shape == FROE_SHAPE_BALL ? r->from->radius : 0};
    for (int k = 0; k < range->dim; k++) {
        const double lo = range->lo[k], hi = range->hi[k];
        c.centre[k] = r->shape == FROE_SHAPE_BALL ? r->from->points[k] : 0.5 * lo + 0.5 * hi;
        if (!isfinite(lo) || !isfinite(hi)) c.reach = INFINITY;
        if (r->shape == FROE_SHAPE_BALL || c.reach == INFINITY) continue;
        const double up = difference_above(hi, c.centre[k]), down = difference_above(c.centre[k], lo);
        c.reach = fmax(c.reach, fmax(up, down));
    }
    return c;
}

/* ------------------------------------------------------------------ asking -- */

static bool done(const froe_query *q) {
    return q->range.any && q->found.count;
}

/* Tests one after the other what may meet the range. */
static froe_status test_objects(froe_query *q, const query_class *c, const tree_objects *list) {
    bool memory = false;
    if (!array_reserve(&q->alloc, &q->found, list->count)) return FROE_E_MEMORY;
    for (uint32_t i = 0; i < list->count && !memory && !done(q); i++) {
        const uint32_t object = c->ids[tree_object(list, i)];
        if (query_range_meets(q, object, &memory)) query_found(q, object);
    }
    return memory ? FROE_E_MEMORY : FROE_OK;
}

/* One point location. */
static froe_status locate(froe_query *q, const query_class *c, froe_query *fork, const range_cube *around) {
    query_leaf leaf;
    const froe_scene *s = c->tree->scene;
    for (int k = 0; k < s->dim; k++)
        if (around->centre[k] < s->lo[k] || around->centre[k] > s->hi[k]) return FROE_OK;
    if (query_leaf_find(fork, around->centre, &leaf)) return FROE_E_MEMORY;
    const tree_objects list = leaf.empty ? (tree_objects){0} : tree_list(c->tree, leaf.place);
    return test_objects(q, c, &list);
}

/* A search for the bounds of the range. */
static froe_status search(froe_query *q, const query_class *c, froe_query *fork) {
    double ends[2 * FROE_MAX_DIM];
    froe_range bounds = froe_range_defaults();
    bounds.points = ends;
    for (int k = 0; k < q->range.range.dim; k++) {
        ends[k] = q->range.range.lo[k];
        ends[q->range.range.dim + k] = q->range.range.hi[k];
    }
    froe_status status = query_range_take(fork, &bounds, NULL);
    if (status) return status;
    query_begin(fork);
    fork->range.any = false;
    status = query_range_walk(fork);
    if (status) return status;
    const tree_objects list = {
        .at = fork->found.data, .count = (uint32_t)fork->found.count, .stride = 1, .mask = UINT32_MAX};
    return test_objects(q, c, &list);
}

froe_status query_classes_search(froe_query *q, froe_diagnostic *diag) {
    const query_classes *p;
    const range_cube around = cube_of(&q->range);
    froe_status status = query_classes_of(q, &p, diag);
    if (status) return status;
    if (!q->classes.forks && p->count) {
        q->classes.forks = support_calloc(&q->alloc, p->count, sizeof *q->classes.forks);
        if (!q->classes.forks) return support_fail_memory(diag);
        q->classes.count = p->count;
        for (uint32_t i = 0; i < p->count && !status; i++)
            status = froe_query_fork(p->classes[i].query, q->classes.forks + i, diag);
        if (status) query_classes_give(q);
        if (status) return status;
    }
    if (!p->count || !(around.reach <= p->classes[p->count - 1].step))
        return query_range_walk(q) ? support_fail_memory(diag) : FROE_OK;
    for (uint32_t i = 0; i < p->count && !status && !done(q); i++) {
        const query_class *c = p->classes + i;
        const bool small = c->step > 0 && around.reach <= c->step;
        status = small ? locate(q, c, q->classes.forks[i], &around) : search(q, c, q->classes.forks[i]);
        const froe_query_stats stats = froe_query_statistics(q->classes.forks[i]);
        q->stats.nodes += stats.nodes; /* visits of a fork count as visits of the query */
        q->stats.leaves += stats.leaves;
        q->stats.steps += stats.steps;
    }
    return status ? support_fail_memory(diag) : FROE_OK;
}
