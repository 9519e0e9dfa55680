/* join.c: the groups of a tree that meet a group of another tree, lie in it, or cover it.
 *
 *     meets     an object of the one meets an object of the other; or a point of either lies in the other
 *     covers    candidates have the first corner of the question; overlay.c decides
 *     within    all objects of candidates meet the question's bounds; overlay.c decides, with the roles exchanged
 *
 * Objects of one ring follow each other, end to end: what lies around one of them lies around all of them, unless they
 * meet something. So only the first corner of such a chain is located. */
#include "query/groups/relation.h"
#include "scene/convex.h"
#include "support/fail.h"
#include <string.h>

/** A question while it is answered. */
typedef struct asking {
    froe_query *q, *t; /* of the tree, of the questions */
    const query_relating *r, *questions;
    uint32_t group;
    froe_diagnostic *diag;
} asking;

static uint32_t question_size(const asking *a) {
    return query_roster_size(a->questions->roster, a->group);
}
static uint32_t question_object(const asking *a, uint32_t i) {
    const query_roster *r = a->questions->roster;
    return r->objects[r->starts[a->group] + i];
}

/* An object as a range. A box has lo and hi, a hull its corners. */
static bool range_of_object(asking *a, uint32_t object, froe_range *out) {
    query_groups_work *w = &a->q->work;
    const froe_scene *s = a->t->tree->scene;
    const geom_convex set = scene_convex(s, object);
    const bool box = set.core == GEOM_CORE_BOX;
    const uint32_t points = box ? 2 : set.count;
    w->points.count = 0;
    for (uint32_t i = 0; i < points; i++)
        if (!array_append(&a->q->alloc, &w->points, geom_convex_point(&set, i), 2)) return false;
    *out = froe_range_defaults();
    out->shape = box              ? FROE_SHAPE_BOX
                 : set.radius > 0 ? FROE_SHAPE_BALL
                 : points == 2    ? FROE_SHAPE_SEGMENT
                                  : FROE_SHAPE_HULL;
    out->points = w->points.data;
    out->count = points;
    out->radius = set.radius;
    return true;
}

/* ------------------------------------------------------------------- meets -- */

/* Does an object begin where the one of the number before it ends? */
static bool continues(const froe_scene *s, uint32_t object) {
    return object && scene_form(s, object) == FROE_SEGMENT && scene_form(s, object - 1) == FROE_SEGMENT &&
           s->groups[object] == s->groups[object - 1] && scene_corner(s, object, 0) == scene_corner(s, object - 1, 1);
}

static froe_status put_groups_at(asking *a, const double *x) {
    const froe_status status = query_groups_at(a->q, a->r->areas, x, a->diag);
    for (size_t i = 0; !status && i < a->q->groups.inside.count; i++)
        if (!query_groups_put_once(&a->q->work, &a->q->alloc, a->q->groups.inside.data[i]))
            return support_fail_memory(a->diag);
    return status;
}

/* The groups whose objects meet an object of the question, or that have its first corner. */
static froe_status put_groups_of(asking *a, uint32_t object) {
    const froe_scene *own = a->t->tree->scene, *s = a->q->tree->scene;
    froe_range range;
    if (!range_of_object(a, object, &range)) return support_fail_memory(a->diag);
    froe_status status = query_range_ask(a->q, &range, false, a->diag);
    for (size_t i = 0; !status && i < a->q->found.count; i++) {
        const uint32_t group = s->groups[a->q->found.data[i]];
        if (group != FROE_NONE && !query_groups_put_once(&a->q->work, &a->q->alloc, group))
            return support_fail_memory(a->diag);
    }
    return status || continues(own, object) ? status : put_groups_at(a, scene_point(own, object, 0));
}

static void bound_question(const asking *a, double box[4]) {
    for (int k = 0; k < 2; k++) box[k] = INFINITY, box[2 + k] = -INFINITY;
    for (uint32_t i = 0; i < question_size(a); i++) {
        double lo[2], hi[2];
        scene_object_bounds(a->t->tree->scene, question_object(a, i), lo, hi);
        for (int k = 0; k < 2; k++) {
            box[k] = fmin(box[k], lo[k]);
            box[2 + k] = fmax(box[2 + k], hi[k]);
        }
    }
}

static froe_status ask_window(asking *a, const double box[4]) {
    froe_range window = froe_range_defaults();
    window.points = box;
    return query_range_ask(a->q, &window, false, a->diag);
}

static froe_status test_in_question(asking *a, const double *x, bool *in) {
    const froe_status status = query_groups_at(a->t, a->questions->areas, x, a->diag);
    *in = false;
    for (size_t i = 0; !status && i < a->t->groups.inside.count && !*in; i++)
        *in = a->t->groups.inside.data[i] == a->group;
    return status;
}

/* What lies within the question and meets no object of it. */
static froe_status put_groups_within(asking *a) {
    const froe_scene *s = a->q->tree->scene;
    query_groups_work *w = &a->q->work;
    double box[4];
    bound_question(a, box);
    froe_status status = ask_window(a, box);
    for (size_t i = 0; !status && i < a->q->found.count; i++) {
        const uint32_t object = a->q->found.data[i], group = s->groups[object];
        bool in;
        if (group == FROE_NONE || w->tallies[group].stamp == w->stamp || continues(s, object)) continue;
        status = test_in_question(a, scene_point(s, object, 0), &in);
        if (!status && in && !query_groups_put_once(w, &a->q->alloc, group)) return support_fail_memory(a->diag);
    }
    return status;
}

static froe_status relate_met(asking *a) {
    froe_status status = FROE_OK;
    for (uint32_t i = 0; !status && i < question_size(a); i++) status = put_groups_of(a, question_object(a, i));
    if (!status && a->questions->areas->borders) status = put_groups_within(a);
    return status;
}

/* ---------------------------------------------------------- within, covers -- */

static query_region region_of(froe_query *query, const query_relating *r, uint32_t group) {
    return (query_region){query, r->areas, r->roster, group, NULL, 0};
}

/* Puts the candidates that lie in the question, or the other way round. */
static froe_status put_candidates(asking *a, bool within) {
    query_groups_work *w = &a->q->work;
    const query_region question = region_of(a->t, a->questions, a->group);
    for (size_t i = 0; i < w->candidates.count; i++) {
        const query_region group = region_of(a->q, a->r, w->candidates.data[i]);
        bool in;
        const froe_status status =
            query_region_inside(within ? &group : &question, within ? &question : &group, &in, a->diag);
        if (status) return status;
        if (in && !query_groups_put(w, &a->q->alloc, group.group)) return support_fail_memory(a->diag);
    }
    return FROE_OK;
}

static froe_status relate_cover(asking *a) {
    const double *x = scene_point(a->t->tree->scene, question_object(a, 0), 0);
    const froe_status status = query_groups_at(a->q, a->r->areas, x, a->diag);
    if (status) return status;
    a->q->work.candidates.count = 0;
    if (!array_append(&a->q->alloc, &a->q->work.candidates, a->q->groups.inside.data, a->q->groups.inside.count))
        return support_fail_memory(a->diag);
    return put_candidates(a, false);
}

static froe_status relate_within(asking *a) {
    const froe_scene *s = a->q->tree->scene;
    query_groups_work *w = &a->q->work;
    double box[4];
    bound_question(a, box);
    w->candidates.count = 0;
    const froe_status status = ask_window(a, box);
    if (status) return status;
    for (size_t i = 0; i < a->q->found.count; i++) {
        const uint32_t group = s->groups[a->q->found.data[i]];
        if (group == FROE_NONE || query_groups_count(w, group) < query_roster_size(a->r->roster, group)) continue;
        if (!array_push(&a->q->alloc, &w->candidates, group)) return support_fail_memory(a->diag);
    }
    return put_candidates(a, true);
}

froe_status query_relate_group(froe_query *q, const query_relating *r, const query_relating *questions, uint32_t group,
                               froe_diagnostic *diag) {
    asking a = {.q = q, .t = q->work.questions, .r = r, .questions = questions, .group = group, .diag = diag};
    const froe_scene *s = q->tree->scene;
    const uint64_t queries = q->stats.queries + 1;
    froe_status status = FROE_OK;
    if (!query_groups_begin(&q->work, &q->alloc, s->group_count)) return support_fail_memory(diag);
    if (s->object_count && s->groups && question_size(&a))
        status = r->relation == FROE_MEETS    ? relate_met(&a)
                 : r->relation == FROE_WITHIN ? relate_within(&a)
                                              : relate_cover(&a);
    query_groups_end(&q->work);
    q->stats.queries = queries;
    return status;
}
