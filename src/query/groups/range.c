/* range.c: the groups that meet a convex range, lie in it, or cover it.
 *
 *     meets     an object of the group meets the range; or none does, and the group has one point of it, hence all
 *     within    all objects of the group lie in the range, which is convex, and what they bound does, too
 *     covers    the group has a corner of the range; and no object of it meets the range, or overlay.c finds it good */
#include "base/floats.h"
#include "geom/meet/meet.h"
#include "query/groups/relation.h"
#include "query/heap.h"
#include "query/segment.h"
#include "scene/convex.h"
#include "support/fail.h"
#include <string.h>

/* ------------------------------------------------------------------- meets -- */

/* A range with a point beyond the bounds of all objects is in no area that it does not meet the border of. */
static froe_status relate_met(froe_query *q, const query_relating *r, const froe_range *range, froe_diagnostic *diag) {
    const bool here = query_in_scene(q->tree->scene, range->points);
    const froe_status status = here ? query_relate_point(q, r, range->points, diag) : FROE_OK;
    return status ? status : query_relate_objects(q, range, diag);
}

/* ------------------------------------------------------------------ within -- */

static bool box_has(const froe_range *box, const double *x) {
    return box->points[0] <= x[0] && x[0] <= box->points[2] && box->points[1] <= x[1] && x[1] <= box->points[3];
}

/* Does a ball lie in a box? No bound of the box may part it, or lie beyond it. */
static bool box_has_ball(num_context *numbers, const froe_range *box, const double *centre, double radius) {
    for (int i = 0; i < 4; i++) {
        if (isinf(box->points[i])) continue;
        const geom_plane bound = geom_plane_axis(2, i % 2, box->points[i]);
        const int side = geom_side_ball(numbers, &bound, centre, radius), out = i < 2 ? -1 : 1;
        if (side == 2 || side == out) return false;
    }
    return true;
}

/* Is the object, which meets the range, within it? Its corners have to be. */
static froe_status test_within(froe_query *q, const froe_range *range, uint32_t object, bool *in,
                               froe_diagnostic *diag) {
    const froe_scene *s = q->tree->scene;
    const geom_convex set = scene_convex(s, object);
    *in = true;
    if (set.radius > 0 && range->shape != FROE_SHAPE_BOX)
        return support_fail_at(diag, FROE_E_UNSUPPORTED, object, FROE_NONE, FROE_NONE,
                               "group %u (%.80s): Whether it lies in a %s is not told, because object %u is a ball.",
                               s->groups[object], froe_scene_group(s, s->groups[object]).name,
                               froe_range_shape_name(range->shape), object);
    if (set.radius > 0) *in = box_has_ball(&q->numbers, range, geom_convex_point(&set, 0), set.radius);
    for (uint32_t i = 0; *in && set.radius == 0 && i < set.count; i++) {
        const double x[2] = {geom_convex_coordinate(&set, i, 0), geom_convex_coordinate(&set, i, 1)};
        const geom_convex corner = {.core = GEOM_CORE_LIST, .dim = 2, .count = 1, .coords = x};
        *in = range->shape == FROE_SHAPE_BOX ? box_has(range, x) : geom_meet(&q->numbers, &corner, &q->range.range.set);
    }
    return FROE_OK;
}

static froe_status relate_within(froe_query *q, const query_relating *r, const froe_range *range,
                                 froe_diagnostic *diag) {
    const uint32_t *groups = q->tree->scene->groups;
    froe_status status = query_range_ask(q, range, false, diag);
    for (size_t i = 0; !status && i < q->found.count; i++) {
        const uint32_t object = q->found.data[i], group = groups[object];
        bool in;
        if (group == FROE_NONE) continue;
        status = test_within(q, range, object, &in, diag);
        if (!status && in && query_groups_count(&q->work, group) == query_roster_size(r->roster, group) &&
            !query_groups_put(&q->work, &q->alloc, group))
            return support_fail_memory(diag);
    }
    return status;
}

/* ------------------------------------------------------------------ corners -- */

static bool comes_after(void *user, uint32_t a, uint32_t b) {
    const double *x = (const double *)user + 2 * (size_t)a, *y = (const double *)user + 2 * (size_t)b;
    return x[0] != y[0] ? x[0] > y[0] : x[1] > y[1];
}

/* Appends x to a chain that turns left at every corner, from place `first` on. There is room. */
static void turn_left_to(froe_query *q, size_t first, const double *x) {
    query_groups_work *w = &q->work;
    for (; w->corners.count >= first + 4; w->corners.count -= 2) {
        const double *last = w->corners.data + w->corners.count - 4;
        if (query_turn(&q->numbers, last, last + 2, x) > 0) break;
    }
    memcpy(w->corners.data + w->corners.count, x, 2 * sizeof *x);
    w->corners.count += 2;
}

/* The corners of a range without radius, counter-clockwise: the lower chain of its points, then the upper one (Andrew:
 * Another efficient algorithm for convex hulls in two dimensions, 1979). */
static froe_status find_corners(froe_query *q, const froe_range *range, froe_diagnostic *diag) {
    query_groups_work *w = &q->work;
    const double *x = range->points, box[8] = {x[0], x[1], x[2], x[1], x[2], x[3], x[0], x[3]};
    const bool is_box = range->shape == FROE_SHAPE_BOX;
    const size_t count = is_box                               ? 4
                         : range->shape == FROE_SHAPE_HULL    ? range->count
                         : range->shape == FROE_SHAPE_SIMPLEX ? 3
                         : range->shape == FROE_SHAPE_BALL    ? 1
                                                              : 2;
    w->points.count = w->corners.count = w->order.count = 0;
    if (!array_append(&q->alloc, &w->points, is_box ? box : x, 2 * count) ||
        !array_reserve(&q->alloc, &w->corners, 4 * count + 4) || !array_reserve(&q->alloc, &w->order, count))
        return support_fail_memory(diag);
    for (uint32_t i = 0; i < count; i++) w->order.data[i] = i;
    query_heap_sort(w->order.data, count, comes_after, w->points.data);
    for (size_t i = 0; i < count; i++) turn_left_to(q, 0, w->points.data + 2 * (size_t)w->order.data[i]);
    const size_t upper = w->corners.count - 2;
    for (size_t i = count - 1; i-- > 0;) turn_left_to(q, upper, w->points.data + 2 * (size_t)w->order.data[i]);
    /* The chains begin where the other one ends, except for a point; equal points are no corners. */
    const double *c = w->corners.data;
    if (w->corners.count > 2) w->corners.count -= 2;
    if (w->corners.count == 4 && c[0] == c[2] && c[1] == c[3]) w->corners.count = 2;
    return FROE_OK;
}

/* ------------------------------------------------------------------ covers -- */

/* Groups that have the first corner are candidates; those without an object that meets the range cover it. */
static froe_status relate_cover(froe_query *q, const query_relating *r, const froe_range *range,
                                froe_diagnostic *diag) {
    query_groups_work *w = &q->work;
    const froe_scene *s = q->tree->scene;
    for (int k = 0; k < 2 && range->shape == FROE_SHAPE_BOX; k++)
        if (range->points[k] < s->lo[k] || range->points[2 + k] > s->hi[k]) return FROE_OK;
    froe_status status = find_corners(q, range, diag);
    if (!status) status = query_relate_candidates(q, r, w->corners.data, diag);
    const bool point = w->corners.count == 2;
    if (!status && !point && w->candidates.count) status = query_range_ask(q, range, false, diag);
    for (size_t i = 0; !status && !point && w->candidates.count && i < q->found.count; i++)
        if (s->groups[q->found.data[i]] != FROE_NONE) query_groups_count(w, s->groups[q->found.data[i]]);
    for (size_t i = 0; !status && i < w->candidates.count; i++) {
        const uint32_t group = w->candidates.data[i];
        const query_region inner = {.corners = w->corners.data, .count = (uint32_t)(w->corners.count / 2)},
                           outer = {q, r->areas, r->roster, group, NULL, 0};
        bool covers = true;
        if (!point && query_groups_count(w, group) > 1) status = query_region_inside(&inner, &outer, &covers, diag);
        if (!status && covers && !query_groups_put(w, &q->alloc, group)) return support_fail_memory(diag);
    }
    return status;
}

/* ------------------------------------------------------------------- calls -- */

static froe_status check_range(const froe_range *range, froe_relation relation, froe_diagnostic *diag) {
    const froe_status status = query_range_check(range, 2, diag);
    if (status) return status;
    const char *shape = froe_range_shape_name(range->shape);
    const bool round = range->shape == FROE_SHAPE_BALL || range->shape == FROE_SHAPE_CAPSULE;
    if (range->eps > 0)
        return support_fail(diag, FROE_E_UNSUPPORTED, "Groups are related to exact ranges only, and eps is %g.",
                            range->eps);
    if (range->shape == FROE_SHAPE_HALFSPACES || (range->shape == FROE_SHAPE_RAY && relation != FROE_MEETS) ||
        (round && range->radius > 0 && relation == FROE_COVERS))
        return support_fail(diag, FROE_E_UNSUPPORTED, "The relation '%s' of groups is not told of a range of shape %s.",
                            froe_relation_name(relation), shape);
    return FROE_OK;
}

froe_status query_relate_range(froe_query *q, const query_relating *r, const froe_range *range, froe_diagnostic *diag) {
    const uint64_t queries = q->stats.queries + 1;
    const froe_scene *s = q->tree->scene;
    froe_status status = check_range(range, r->relation, diag);
    if (status) return status;
    if (!query_groups_begin(&q->work, &q->alloc, s->group_count)) return support_fail_memory(diag);
    if (s->object_count && s->groups)
        status = r->relation == FROE_MEETS    ? relate_met(q, r, range, diag)
                 : r->relation == FROE_WITHIN ? relate_within(q, r, range, diag)
                                              : relate_cover(q, r, range, diag);
    query_groups_end(&q->work);
    q->stats.queries = queries;
    return status;
}

froe_status froe_query_groups_range(froe_query *query, const froe_range *range, froe_relation relation, froe_list *out,
                                    froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    query_relating r;
    if (!query || !range || !out) return support_fail_null(diag, __func__);
    froe_status status = query_relating_begin(query, relation, &r, diag);
    if (!status) status = query_relate_range(query, &r, range, diag);
    if (!status) *out = (froe_list){query->work.groups.data, query->work.groups.count};
    return status;
}
