/* locate.c: the objects that contain a point. Where it is on no cut they are in the list of its leaf, or covers of a
 * node above: what contains it meets the leaf's open cell. On a cut it is a range of one point, which visits the list
 * there and both sides. */
#include "base/floats.h"
#include "query/check.h"
#include "query/covers.h"
#include "query/point/leaf.h"
#include "query/segment.h"
#include "support/fail.h"
#include <string.h>

/* Begins with a point, as the range that is asked. */
static void begin_point(froe_query *q, const froe_range *point) {
    query_begin(q);
    query_range_of_box(q, point);
}

/* Those of a list. */
static froe_status test_list(froe_query *q, const tree_objects *list, const double *x, froe_diagnostic *diag) {
    const froe_scene *s = q->tree->scene;
    bool memory = false; /* of which only halfspaces need some */
    if (!query_expect(q, list->count)) return support_fail_memory(diag);
    for (uint32_t i = 0; i < list->count; i++) {
        const uint32_t object = tree_object(list, i);
        if (query_seen(q, list, i, object)) continue;
        bool holds;
        if (s->dim == 2 && scene_form(s, object) == FROE_SEGMENT) {
            q->stats.tests++;
            holds = query_segment_meets_box(&q->numbers, scene_point(s, object, 0), scene_point(s, object, 1), x, x);
        } else {
            holds = query_range_meets(q, object, &memory);
        }
        if (holds) query_found(q, object);
    }
    return FROE_OK;
}

/* A point as a range. */
typedef struct point_range {
    froe_range range;
    double ends[2 * FROE_MAX_DIM];
} point_range;

static void take_point(const froe_query *q, const double *point, point_range *out) {
    const size_t dim = (size_t)q->tree->scene->dim;
    out->range = froe_range_defaults();
    out->range.points = out->ends;
    for (size_t k = 0; k < dim; k++) out->ends[k] = out->ends[dim + k] = point[k];
}

froe_status query_locate_in(froe_query *q, const double *point, const query_leaf *leaf, froe_diagnostic *diag) {
    point_range s;
    froe_status status = FROE_OK;
    take_point(q, point, &s);
    if (leaf->on_cut) return query_range_ask(q, &s.range, false, diag);
    begin_point(q, &s.range);
    if (!leaf->empty) {
        const tree_objects list = tree_list(q->tree, leaf->place);
        status = test_list(q, &list, point, diag);
    }
    const query_covers *covers = NULL;
    if (!status && q->tree->report.covers) status = query_covers_of(q, &covers, diag);
    for (uint32_t v = leaf->place; covers && !status && (v = query_covers_above(covers, v)) != FROE_NONE;) {
        const tree_objects list = tree_cover_list(q->tree, v);
        status = test_list(q, &list, point, diag);
    }
    return status;
}

froe_status query_locate(froe_query *q, const double *point, froe_diagnostic *diag) {
    query_leaf leaf;
    point_range s;
    const froe_status status = query_check_point(point, q->tree->scene->dim, "a point", diag);
    if (status) return status;
    take_point(q, point, &s);
    if (tree_is_packed(q->tree)) return query_range_ask(q, &s.range, false, diag);
    if (!query_in_scene(q->tree->scene, point)) {
        begin_point(q, &s.range);
        return FROE_OK;
    }
    if (query_leaf_find(q, point, &leaf)) return support_fail_memory(diag);
    return query_locate_in(q, point, &leaf, diag);
}

froe_status froe_query_locate(froe_query *query, const double *point, froe_list *out, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!query || !point || !out) return support_fail_null(diag, __func__);
    const froe_status status = query_locate(query, point, diag);
    if (!status) *out = query_list(query);
    return status;
}
