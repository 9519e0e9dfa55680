/* range_meet.c: does an object meet the range? By fast tests first, then exactly. */
#include "geom/meet/meet.h"
#include "geom/predicates.h"
#include "query/context.h"
#include "query/segment.h"
#include "scene/convex.h"
#include <string.h>

/* ------------------------------------------------------------------- boxes -- */

static bool in_box(const double *x, const double *lo, const double *hi, int dim) {
    for (int k = 0; k < dim; k++)
        if (x[k] < lo[k] || x[k] > hi[k]) return false;
    return true;
}

/* Do the boxes lo, hi and a, b have no point in common? */
static bool boxes_apart(const double *lo, const double *hi, const double *a, const double *b, int dim) {
    for (int k = 0; k < dim; k++)
        if (hi[k] < a[k] || b[k] < lo[k]) return true;
    return false;
}

/* The line of u and v, seen along an axis of space (-1: in the plane): is the box strictly on one side of it? It is
 * enough to look at the two corners furthest across. */
static bool segment_beside_box(num_context *context, int axis, const double *u, const double *v, const double *lo,
                               const double *hi) {
    const int x = axis == 0 ? 1 : 0, y = axis < 0 || axis == 2 ? 1 : 2;
    const double p[2] = {u[x], u[y]}, q[2] = {v[x], v[y]};
    const bool rising = (q[0] > p[0]) == (q[1] > p[1]);
    const double a[2] = {lo[x], rising ? hi[y] : lo[y]}, b[2] = {hi[x], rising ? lo[y] : hi[y]};
    if (p[0] == q[0] || p[1] == q[1]) return false; /* the bounds decide this */
    const geom_plane line = geom_plane_points(2, (const double *const[]){p, q});
    const int side = geom_side_vertex(context, &line, a);
    return side && side == geom_side_vertex(context, &line, b);
}

/* Points, balls and boxes are boxes lo, hi, grown by a radius. */
typedef struct boxlike {
    bool is;
    const double *lo, *hi;
    double radius;
} boxlike;

static boxlike boxlike_of(const froe_scene *s, uint32_t object) {
    const froe_kind form = scene_form(s, object);
    boxlike b = {.is = form == FROE_POINT || form == FROE_BALL || form == FROE_BOX};
    b.lo = scene_point(s, object, 0);
    b.hi = form == FROE_BOX ? scene_point(s, object, 1) : b.lo;
    b.radius = form == FROE_BALL ? scene_radius(s, object) : 0;
    return b;
}

/* Only what lies within the bounds of the object counts, so that no bound is infinite. */
bool query_object_meets_box(froe_query *q, uint32_t object, const double *lo, const double *hi) {
    const froe_scene *s = q->tree->scene;
    const boxlike box = boxlike_of(s, object);
    double ends[2 * FROE_MAX_DIM], a[FROE_MAX_DIM], b[FROE_MAX_DIM];
    if (box.is) return geom_meet_boxes(&q->numbers, s->dim, box.lo, box.hi, box.radius, lo, hi, 0);
    scene_object_bounds(s, object, a, b);
    if (boxes_apart(lo, hi, a, b, s->dim)) return false;
    for (int k = 0; k < s->dim; k++) {
        ends[k] = lo[k] > a[k] ? lo[k] : a[k];
        ends[s->dim + k] = hi[k] < b[k] ? hi[k] : b[k];
    }
    if (scene_form(s, object) == FROE_SEGMENT) { /* its bounds meet the box; above dimension 3 it is a hull */
        const double *u = scene_point(s, object, 0), *v = scene_point(s, object, 1), *far = ends + s->dim;
        if (in_box(u, ends, far, s->dim) || in_box(v, ends, far, s->dim)) return true;
        if (s->dim == 2) return !segment_beside_box(&q->numbers, -1, u, v, ends, far);
        for (int axis = 0; axis < 3; axis++)
            if (segment_beside_box(&q->numbers, axis, u, v, ends, far)) return false;
        return true;
    }
    for (uint32_t i = 0, n = scene_corners(s, object); i < n; i++)
        if (in_box(scene_point(s, object, i), lo, hi, s->dim)) return true;
    const geom_convex part = {.core = GEOM_CORE_BOX, .dim = s->dim, .count = 1u << s->dim, .coords = ends};
    const geom_convex set = scene_convex(s, object);
    return geom_meet(&q->numbers, &set, &part);
}

/* -------------------------------------------------------------- halfspaces -- */

static bool halfspaces_meet(froe_query *q, uint32_t object, bool *memory) {
    query_range *r = &q->range;
    const froe_range *from = r->from;
    const froe_scene *s = q->tree->scene;
    const geom_convex set = scene_convex(s, object);
    if (s->dim > 3) {
        const geom_halfspaces of = query_halfspaces(r);
        return geom_halfspaces_meet(&q->numbers, &q->alloc, &of, &set, memory);
    }
    /* A corner of the object in all halfspaces decides, and so does a halfspace that has none of it. */
    const uint32_t watched = set.count < 64 ? set.count : 64;
    uint64_t in_all = watched < 64 ? ((uint64_t)1 << watched) - 1 : UINT64_MAX;
    for (size_t h = 0; h < from->count; h++) {
        const geom_plane plane = geom_plane_vector(set.dim, from->points + h * (size_t)set.dim, from->offsets[h]);
        uint32_t outside = 0;
        for (uint32_t i = 0; i < set.count; i++) {
            double x[3];
            for (int k = 0; k < set.dim; k++) x[k] = geom_convex_coordinate(&set, i, k);
            if (geom_side_vertex(&q->numbers, &plane, x) <= 0) continue;
            outside++;
            if (i < watched) in_all &= ~((uint64_t)1 << i);
        }
        if (outside == set.count && set.radius == 0) return false;
    }
    if (in_all) return true;
    if (!r->polytope_made) { /* the corners of the halfspaces within the bounds of the scene, when first needed */
        r->polytope_made = geom_polytope_make(&q->numbers, &q->alloc, s->dim, from->points, from->offsets, from->count,
                                              s->lo, s->hi, &r->polytope);
        r->range.set = geom_polytope_convex(&r->polytope, s->dim);
    }
    if (!r->polytope_made) return *memory = true, false;
    return r->range.set.count && geom_meet(&q->numbers, &set, &r->range.set);
}

/* -------------------------------------------------------------------- rays -- */

/* How often a ray's direction must be doubled to lead beyond the bounds of the object. */
static int power_beyond(const geom_convex *ray, const double *lo, const double *hi) {
    const double *o = geom_convex_point(ray, 0), *d = geom_convex_point(ray, 1);
    int axis = 0, span_exponent, step_exponent;
    for (int k = 1; k < ray->dim; k++)
        if (fabs(d[k]) > fabs(d[axis])) axis = k;
    const double below = fabs(lo[axis] / 4 - o[axis] / 4), above = fabs(hi[axis] / 4 - o[axis] / 4);
    frexp(below > above ? below : above, &span_exponent);
    frexp(d[axis], &step_exponent);
    const int power = span_exponent + 2 - step_exponent + 2;
    return power > 0 ? power : 0;
}

/* ----------------------------------------------------------------- meeting -- */

static bool set_meets(froe_query *q, uint32_t object) {
    const froe_scene *s = q->tree->scene;
    const geom_range *range = &q->range.range;
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    scene_object_bounds(s, object, lo, hi);
    if (boxes_apart(range->lo, range->hi, lo, hi, s->dim)) return false;
    const geom_convex object_set = scene_convex(s, object);
    geom_convex set = range->set;
    if (set.core == GEOM_CORE_RAY) set.power = power_beyond(&set, lo, hi);
    return geom_meet(&q->numbers, &object_set, &set);
}

static bool decide_object(froe_query *q, uint32_t object, bool *memory) {
    const froe_scene *s = q->tree->scene;
    const froe_range *from = q->range.from;
    const boxlike b = boxlike_of(s, object);
    /* Is a corner of the object within the margin of the range for certain? Of boxes and balls. Then an object of many
     * corners need not be tested against the range itself. */
    const query_range *r = &q->range;
    const bool margin = r->range.kind == GEOM_RANGE_BALL || (r->range.kind == GEOM_RANGE_BOX && r->margin != 0);
    for (uint32_t i = 0, n = !b.is && margin ? scene_corners(s, object) : 0; i < n; i++) {
        const double *x = scene_point(s, object, i);
        if (geom_range_holds(&q->numbers, &r->range, r->margin, x, x)) return true;
    }
    switch (from->shape) {
    case FROE_SHAPE_BOX:
        return query_object_meets_box(q, object, from->points, from->points + s->dim);
    case FROE_SHAPE_BALL: {
        double least[FROE_MAX_DIM], most[FROE_MAX_DIM];
        if (b.is)
            return geom_meet_boxes(&q->numbers, s->dim, b.lo, b.hi, b.radius, from->points, from->points, from->radius);
        scene_object_bounds(s, object, least, most);
        return !geom_range_misses(&q->range.range, least, most) && set_meets(q, object);
    }
    case FROE_SHAPE_SEGMENT:
        if (s->dim != 2 || scene_form(s, object) != FROE_SEGMENT) return set_meets(q, object);
        return query_segments_meet(&q->numbers, from->points, from->points + 2, scene_point(s, object, 0),
                                   scene_point(s, object, 1));
    case FROE_SHAPE_HALFSPACES:
        return halfspaces_meet(q, object, memory);
    default:
        return set_meets(q, object);
    }
}

bool query_range_meets(froe_query *q, uint32_t object, bool *memory) {
    const uint64_t exact = q->numbers.stats.exact;
    const bool meets = decide_object(q, object, memory);
    q->stats.tests++;
    q->stats.exact += q->numbers.stats.exact != exact;
    return meets;
}
