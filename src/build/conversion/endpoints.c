/* endpoints.c: the endpoints become a scene of points, a method of the registry partitions them, and its cuts are the
 * plan. */
#include "build/conversion/endpoints.h"
#include "base/floats.h"
#include "build/conversion/convert.h"
#include "build/conversion/ham_sandwich.h"
#include "build/options.h"
#include "geom/selftest.h"
#include "support/fail.h"
#include <string.h>

typedef struct converter {
    build_job *job;
    num_context context;
    point_tree plan;
    froe_scene *points;
    froe_tree *tree; /* of points; its normals are those of the plan */
} converter;

/* ------------------------------------------------------------------ a method -- */

static bool tell_share(void *user, double done) {
    BASE_FLOATS_OWN;
    base_task *task = user;
    return base_progress(task, task->done + 0.2 * done * (1 - task->done));
}

static froe_status plan_by_method(converter *c, const convert_plan *plan) {
    const froe_scene *scene = c->job->scene;
    /* all vertices that objects have, as points */
    froe_objects batch = froe_objects_defaults();
    batch.kind = FROE_POINT;
    batch.count = scene->vertex_count;
    batch.coords = scene->coords;
    froe_status status = froe_scene_new(scene->dim, &c->job->alloc, &c->points);
    if (!status && batch.count) status = froe_scene_add(c->points, &batch, c->job->diag);
    if (status) return status;
    froe_build_options o = froe_build_defaults();
    o.method = plan->method;
    o.settings = plan->settings;
    o.leaf = 1;
    o.seed = c->job->seed;
    o.threads = c->job->task->threads;
    o.progress = tell_share;
    o.user = c->job->task;
    status = build_tuned(c->points, &o, &c->tree, c->job->diag);
    if (status) return status;
    /* cuts of points are axis-parallel or have normals: others would name objects of another scene */
    ARRAY(uint32_t) stack = {0}; /* nodes of the tree, and behind each the one of the plan */
    const froe_allocator *alloc = &c->job->alloc;
    status = array_push(alloc, &stack, 0) && array_push(alloc, &stack, 0) ? FROE_OK : FROE_E_MEMORY;
    while (stack.count && !status) {
        uint32_t at = stack.data[--stack.count], node = stack.data[--stack.count], child;
        froe_cut cut = tree_cut_at(c->tree, node);
        if (cut.kind == FROE_CUT_NONE) continue;
        if (cut.kind != FROE_CUT_AXIS && cut.kind != FROE_CUT_PLANE && cut.kind != FROE_CUT_FINE)
            status = support_fail(c->job->diag, FROE_E_UNSUPPORTED,
                                  "Method '%s' cuts points in another way than by planes.", c->tree->meta.method);
        if (!status) status = point_tree_split(&c->plan, at, &cut, &child);
        for (uint32_t s = 0; s < 2 && !status; s++)
            if (!array_push(alloc, &stack, c->tree->nodes[node].child + s) || !array_push(alloc, &stack, child + s))
                status = FROE_E_MEMORY;
    }
    array_free(alloc, &stack);
    return status == FROE_E_UNSUPPORTED ? status : split_explain(c->job->diag, 0, status);
}

/* ------------------------------------------------------------------- build -- */

froe_status build_converted(build_job *job, const convert_plan *plan, froe_tree **out) {
    converter c = {.job = job};
    if (geom_context_new(&job->alloc, &c.context)) return support_fail_memory(job->diag);
    if (job->first > c.context.first) c.context.first = job->first;
    c.plan.scene = job->scene;
    froe_status status = point_tree_new(&job->alloc, job->scene, &c.plan) ? support_fail_memory(job->diag) : FROE_OK;
    if (!status && plan->method)
        status = plan_by_method(&c, plan);
    else if (!status)
        status = split_explain(job->diag, 0, point_tree_by_ham_sandwich(&c.plan, &c.context, job->task));
    if (!status) status = split_explain(job->diag, 0, point_tree_finish(&c.plan, &c.context));
    if (!status) {
        /* each segment is split twice at most on each level of the plan, and by cuts along others as often as those
         * count */
        build_promise(job, "fragments", job->scene->object_count * (1 + 2 * (double)c.plan.height), 0);
        convert_job convert = {.scene = job->scene,
                               .alloc = job->alloc,
                               .task = job->task,
                               .plan = &c.plan,
                               .leaf = job->leaf,
                               .seed = job->seed,
                               .max_fragments = job->max_fragments,
                               .first = job->first,
                               .prune = plan->prune,
                               .fragments = &job->meta.promises[job->meta.promise_count - 1].promised,
                               .meta = &job->meta};
        status = split_explain(job->diag, job->max_fragments, split_convert(&convert, out));
    }
    point_tree_free(&c.plan);
    froe_tree_free(c.tree);
    froe_scene_free(c.points);
    num_context_free(&c.context);
    return status;
}
