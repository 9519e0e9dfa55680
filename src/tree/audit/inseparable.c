/* inseparable.c: looking for a cut between the objects of a leaf that claims there is none. */
#include "tree/audit/inseparable.h"
#include "scene/convex.h"
#include "tree/audit/normals.h"
#include "tree/audit/share.h"
#include "tree/crowd.h"
#include <math.h>

typedef struct solid_pair {
    num_context *context;
    base_task *task;
    const froe_scene *scene;
    normals *normals;
    uint32_t a, b;
} solid_pair;

/* False: cancelled. For long loops. */
static bool pair_may_go_on(const solid_pair *p) {
    return base_progress(p->task, p->task->done);
}

/* ------------------------------------------------------------------- pairs -- */

static bool add_corners(normals *m, const froe_scene *s, uint32_t object) {
    uint32_t n = scene_corners(s, object);
    if (!array_reserve(&m->alloc, &m->points, n)) return false;
    for (uint32_t i = 0; i < n; i++) m->points.data[m->points.count++] = scene_point(s, object, i);
    return true;
}

/* Have they no point in common, so that builders have to find a plane; or is there one between two hulls that touch? */
static froe_status separated(const solid_pair *p, bool *out) {
    const froe_scene *s = p->scene;
    normals *m = p->normals;
    *out = false;
    if (s->dim <= 3 && scene_form(s, p->a) == FROE_HULL && scene_form(s, p->b) == FROE_HULL) {
        m->points.count = 0;
        if (!add_corners(m, p->scene, p->a)) return FROE_E_MEMORY;
        m->first = (uint32_t)m->points.count;
        const froe_status status = add_corners(m, p->scene, p->b) ? normals_apart(m, out) : FROE_E_MEMORY;
        if (status || *out) return status;
    }
    const geom_convex a = scene_convex(s, p->a), b = scene_convex(s, p->b);
    *out = !share_point(p->context, &a, &b);
    return FROE_OK;
}

/* --------------------------------------------------------------- the leaf -- */

/* What objects are between on each axis: the first end of one, and the last beginning. */
typedef struct gauge {
    double least_hi[FROE_MAX_DIM], most_lo[FROE_MAX_DIM];
} gauge;

static void gauge_take(gauge *g, const froe_scene *s, uint32_t object, bool first) {
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    scene_object_bounds(s, object, lo, hi);
    for (int k = 0; k < s->dim; k++) {
        g->least_hi[k] = !first && g->least_hi[k] <= hi[k] ? g->least_hi[k] : hi[k];
        g->most_lo[k] = !first && g->most_lo[k] >= lo[k] ? g->most_lo[k] : lo[k];
    }
}

/* On some axis one object ends before, or where, one begins. */
static bool gauge_separates(const gauge *g, int dim) {
    for (int k = 0; k < dim; k++)
        if (g->least_hi[k] <= g->most_lo[k]) return true;
    return false;
}

/* Balls that all certainly hold one point inside cannot be separated two by two: the centre of the smallest is tried.
 */
static bool share_a_point(const froe_scene *s, const tree_objects *list) {
    uint32_t least = 0;
    for (uint32_t i = 0; i < list->count; i++) {
        if (scene_form(s, tree_object(list, i)) != FROE_BALL) return false;
        if (scene_radius(s, tree_object(list, i)) < scene_radius(s, tree_object(list, least))) least = i;
    }
    const double *x = scene_point(s, tree_object(list, least), 0);
    for (uint32_t i = 0; i < list->count; i++) {
        num_ball sum = num_ball_mul(num_ball_from(scene_radius(s, tree_object(list, i))),
                                    num_ball_from(scene_radius(s, tree_object(list, i))));
        for (int k = 0; k < s->dim; k++) {
            num_ball d = num_ball_sub(num_ball_from(scene_point(s, tree_object(list, i), 0)[k]), num_ball_from(x[k]));
            sum = num_ball_sub(sum, num_ball_mul(d, d));
        }
        if (num_ball_sign(sum) != 1) return false;
    }
    return true;
}

froe_status inseparable_refuted(num_context *context, base_task *task, const froe_tree *tree, const tree_objects *list,
                                const char **why) {
    const froe_scene *s = tree->scene;
    gauge g;
    uint32_t same = 0;
    *why = NULL;
    while (same < list->count && scene_form(s, tree_object(list, same)) == FROE_POINT &&
           scene_corner(s, tree_object(list, same), 0) == scene_corner(s, tree_object(list, 0), 0))
        same++;
    if (same == list->count) return FROE_OK; /* all are one and the same point */
    *why = "the support of one of its objects would divide it";
    for (uint32_t i = 0; i < list->count; i++)
        if (scene_form(s, tree_object(list, i)) <= FROE_POLYGON) return FROE_OK;
    *why = "an axis-parallel plane separates two of its objects";
    for (uint32_t i = 0; i < list->count; i++) gauge_take(&g, s, tree_object(list, i), !i);
    if (gauge_separates(&g, s->dim)) return FROE_OK;
    *why = NULL;
    if (share_a_point(s, list)) return FROE_OK;
    normals m = {.context = context, .alloc = tree->alloc, .dim = s->dim};
    solid_pair p = {.context = context, .task = task, .scene = s, .normals = &m};
    bool found = false;
    froe_status status = FROE_OK;
    for (uint32_t i = 0; i < list->count && !found && !status && pair_may_go_on(&p); i++) {
        p.a = tree_object(list, i);
        if (scene_form(s, p.a) == FROE_BOX) continue; /* no axis separates it from another box; from others, below */
        for (uint32_t j = 0; j < list->count && !found && !status; j++) {
            p.b = tree_object(list, j);
            if (j < i || scene_form(s, p.b) == FROE_BOX) status = separated(&p, &found);
        }
    }
    normals_free(&m);
    if (!status && found) *why = "a plane separates two of its objects";
    return status;
}

froe_status crowded_refuted(num_context *context, base_task *task, const froe_tree *tree, const tree_objects *list,
                            const char **why) {
    const froe_scene *s = tree->scene;
    *why = "the support of one of its objects would divide it";
    for (uint32_t i = 0; i < list->count; i++)
        if (scene_form(s, tree_object(list, i)) <= FROE_POLYGON) return FROE_OK;
    normals m = {.context = context, .alloc = tree->alloc, .dim = s->dim};
    solid_pair p = {.context = context, .task = task, .scene = s, .normals = &m};
    tree_crowd crowd = tree_crowd_of(list->count);
    froe_status status = FROE_OK;
    while (!status && !tree_crowd_known(&crowd) && pair_may_go_on(&p)) {
        gauge g;
        p.a = tree_object(list, crowd.a);
        p.b = tree_object(list, crowd.b);
        gauge_take(&g, s, p.a, true);
        gauge_take(&g, s, p.b, false);
        bool apart = gauge_separates(&g, s->dim);
        if (!apart) status = separated(&p, &apart);
        if (!status) tree_crowd_tell(&crowd, apart);
    }
    normals_free(&m);
    *why = tree_crowd_is(&crowd) || base_cancelled(task) ? NULL : "most pairs of its objects can be separated";
    return status;
}
