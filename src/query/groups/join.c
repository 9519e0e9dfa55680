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
    froe_query *q; /* of the tree */
    const query_relating *r;
    query_region question;
    froe_diagnostic *diag;
} asking;

static const froe_scene *question_scene(const asking *a) {
    return a->question.query->tree->scene;
}
static uint32_t question_size(const asking *a) {
    return query_roster_size(a->question.roster, a->question.group);
}
static uint32_t question_object(const asking *a, uint32_t i) {
    return query_roster_object(a->question.roster, a->question.group, i);
}

/* An object as a range. A box has lo and hi, a hull its corners. */
static bool range_of_object(asking *a, uint32_t object, froe_range *out) {
    query_groups_work *w = &a->q->work;
    const froe_scene *s = question_scene(a);
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

/* The groups whose objects meet an object of the question, or that have its first corner. */
static froe_status put_groups_of(asking *a, uint32_t object) {
    const froe_scene *own = question_scene(a);
    froe_range range;
    if (!range_of_object(a, object, &range)) return support_fail_memory(a->diag);
    const froe_status status = query_relate_objects(a->q, &range, a->diag);
    if (status || continues(own, object)) return status;
    return query_relate_point(a->q, a->r, scene_point(own, object, 0), a->diag);
}

/* What lies within the question and meets no object of it. */
static froe_status put_groups_within(asking *a) {
    const froe_scene *s = a->q->tree->scene;
    query_groups_work *w = &a->q->work;
    froe_status status = query_region_near(&a->question, a->q, a->diag);
    for (size_t i = 0; !status && i < a->q->found.count; i++) {
        const uint32_t object = a->q->found.data[i], group = s->groups[object];
        bool in;
        if (group == FROE_NONE || w->tallies[group].stamp == w->stamp || continues(s, object)) continue;
        status = query_region_has(&a->question, scene_point(s, object, 0), &in, a->diag);
        if (!status && in && !query_groups_put_once(w, &a->q->alloc, group)) return support_fail_memory(a->diag);
    }
    return status;
}

static froe_status relate_met(asking *a) {
    froe_status status = FROE_OK;
    for (uint32_t i = 0; !status && i < question_size(a); i++) status = put_groups_of(a, question_object(a, i));
    if (!status && a->question.areas->borders) status = put_groups_within(a);
    return status;
}

/* ---------------------------------------------------------- within, covers -- */

/* Puts the candidates that lie in the question, or the other way round. */
static froe_status put_candidates(asking *a, bool within) {
    query_groups_work *w = &a->q->work;
    for (size_t i = 0; i < w->candidates.count; i++) {
        const query_region group = {a->q, a->r->areas, a->r->roster, w->candidates.data[i], NULL, 0};
        const query_region *inner = within ? &group : &a->question, *outer = within ? &a->question : &group;
        bool in;
        const froe_status status = query_region_inside(inner, outer, &in, a->diag);
        if (status) return status;
        if (in && !query_groups_put(w, &a->q->alloc, group.group)) return support_fail_memory(a->diag);
    }
    return FROE_OK;
}

static froe_status relate_cover(asking *a) {
    const double *x = scene_point(question_scene(a), question_object(a, 0), 0);
    const froe_status status = query_relate_candidates(a->q, a->r, x, a->diag);
    return status ? status : put_candidates(a, false);
}

static froe_status relate_within(asking *a) {
    const froe_scene *s = a->q->tree->scene;
    query_groups_work *w = &a->q->work;
    w->candidates.count = 0;
    const froe_status status = query_region_near(&a->question, a->q, a->diag);
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
    asking a = {q, r, {q->work.questions, questions->areas, questions->roster, group, NULL, 0}, diag};
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
