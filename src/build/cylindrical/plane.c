/* plane.c: the loop of split/grow.h for cells of the plane alone (trapezoid.h). One thread cuts cells in the order in
 * which the tree numbers them, so that its draft is the tree.
 *
 *     pending cells   [ ... | cell | cell | current ]
 *     parts           [ ... | its parts on top      ]
 *
 * The loop that all builders share keeps for each cell and fragment what any of them may need. Cells of a cylindrical
 * partition have five fragments on average, so that cells and fragments of its own kind make it several times as
 * fast. */
#include "build/cylindrical/plane.h"
#include "base/apart.h"
#include "build/cylindrical/trapezoid.h"

/* Cells of at most max(least, n / share) parts become tasks, except tiny ones, which do not pay for a task. */
enum { TASK_TINY = 16, TASK_LEAST = 1024, TASK_SHARE = 64 };

typedef struct plane_task {
    trapezoid_cell cell;
    size_t first; /**< of its parts, in the store */
    tree_draft draft;
    base_apart apart;
} plane_task;

typedef struct plane_growth {
    const split_job *job;
    const plane_rules *rules;
    tree_draft main;
    trapezoid_work *workers; /**< one per thread; the first also does the main part */
    unsigned worker_count;
    uint32_t task_size; /**< 0: one thread does all, and the main draft is in the order of the tree */
    double begun;       /**< progress before */
    ARRAY(plane_task) tasks;
    ARRAY(trapezoid_part) store;
    atomic_uint_least64_t pieces; /**< in drafts that are done */
} plane_growth;

static froe_status count_draft_pieces(plane_growth *g, const tree_draft *draft) {
    const uint64_t most = g->job->max_fragments, count = draft->pieces.count;
    const uint64_t pieces = atomic_fetch_add(&g->pieces, count) + count;
    return most && pieces > most ? FROE_E_BUDGET : FROE_OK;
}

/** Moves a small cell's parts to the store, for a task. */
static froe_status store_task(plane_growth *g, trapezoid_work *w, const trapezoid_cell *cell) {
    const froe_allocator *alloc = &g->job->alloc;
    const plane_task task = {.cell = *cell, .first = g->store.count};
    if (!array_append(alloc, &g->store, w->parts.data + cell->first, cell->count)) return FROE_E_MEMORY;
    draft_leaf(w->set.draft, cell->node, 0);
    w->parts.count = cell->first;
    return array_push(alloc, &g->tasks, task) ? FROE_OK : FROE_E_MEMORY;
}

/** Works off all pending cells; those of at most `small` parts become tasks. */
static froe_status work_off(plane_growth *g, trapezoid_work *w, uint32_t small) {
    base_task *task = g->job->task;
    const uint32_t deepest = g->rules->deepest, n = g->job->scene->object_count;
    const uint64_t most = g->job->max_fragments;
    froe_status status = FROE_OK;
    for (uint32_t turn = 0; w->cells.count && !status; turn++) {
        const trapezoid_cell cell = w->cells.data[--w->cells.count];
        if (cell.count <= small && cell.count > TASK_TINY) {
            status = store_task(g, w, &cell);
        } else if (deepest && cell.depth >= deepest && cell.count > w->leaf) {
            atomic_store(g->rules->too_deep, true);
            status = FROE_E_BUDGET;
        } else {
            status = trapezoid_step(w, &cell);
        }
        /* each pending part will be one piece at least: a refusal here is a refusal in any order of work */
        const uint64_t pieces = w->set.draft->pieces.count + w->parts.count;
        if (!status && most && atomic_load(&g->pieces) + pieces > most) status = FROE_E_BUDGET;
        const bool ask = small || turn % 64 == 63;
        if (status || !ask) continue;
        const double left = g->task_size ? 1 : (double)w->parts.count / n,
                     done = g->begun + g->job->span * task->scale * (1 - left);
        const bool go_on = w == g->workers ? base_progress(task, done) : !base_cancelled(task);
        if (!go_on) status = FROE_E_CANCELLED;
    }
    return status;
}

static froe_status grow_main_part(plane_growth *g) {
    trapezoid_work *w = g->workers;
    const froe_scene *scene = g->job->scene;
    const uint32_t n = scene->object_count, *order = g->job->order;
    const trapezoid_wall none = {.node = FROE_NONE};
    const uint32_t task_size = n / TASK_SHARE > TASK_LEAST ? n / TASK_SHARE : TASK_LEAST;
    w->set.draft = &g->main;
    g->task_size = g->job->task->threads > 1 && n > task_size ? task_size : 0;
    g->begun = g->job->task->done;
    if (!array_reserve(&g->job->alloc, &w->parts, n)) return FROE_E_MEMORY;
    for (uint32_t i = 0; i < n; i++) w->parts.data[i] = trapezoid_whole(scene, order ? order[i] : i);
    w->parts.count = n;
    if (!array_push(&g->job->alloc, &w->cells, (trapezoid_cell){.count = n, .wall = {none, none}}))
        return FROE_E_MEMORY;
    const froe_status status = work_off(g, w, g->task_size);
    return status ? status : count_draft_pieces(g, &g->main);
}

/** Finishes the subtree of a small cell in a draft of its own. */
static froe_status grow_small_cell(void *user, unsigned worker, size_t index) {
    plane_growth *g = user;
    trapezoid_work *w = g->workers + worker;
    plane_task *task = g->tasks.data + index;
    const froe_allocator *alloc = &g->job->alloc;
    trapezoid_cell cell = task->cell;
    froe_status status = draft_new(alloc, g->main.dim, (uint32_t)g->main.nodes.count, &task->draft);
    if (status) return status;
    w->set.main = &g->main;
    w->set.draft = &task->draft;
    w->parts.count = w->cells.count = 0;
    cell.node = task->draft.outer;
    cell.first = 0;
    if (!array_append(alloc, &w->parts, g->store.data + task->first, cell.count) || !array_push(alloc, &w->cells, cell))
        return FROE_E_MEMORY;
    status = work_off(g, w, 0);
    return status ? status : count_draft_pieces(g, &task->draft);
}

static froe_status seal_growth(plane_growth *g, froe_tree **out) {
    const size_t count = g->tasks.count;
    for (unsigned i = 0; i < g->worker_count; i++) num_stats_add(&g->main.predicates, &g->workers[i].set.context.stats);
    if (!g->task_size) return draft_seal_ordered(&g->main, g->job->scene, g->job->meta, out);
    tree_graft *grafts = support_calloc(&g->job->alloc, count, sizeof *grafts);
    if (!grafts) return FROE_E_MEMORY;
    for (size_t i = 0; i < count; i++) grafts[i] = (tree_graft){g->tasks.data[i].cell.node, &g->tasks.data[i].draft};
    const froe_status status = draft_seal(&g->main, grafts, count, g->job->scene, g->job->meta, out);
    support_free(&g->job->alloc, grafts, count ? count * sizeof *grafts : 1);
    return status;
}

froe_status plane_grow(const split_job *job, const plane_rules *rules, froe_tree **out) {
    plane_growth g = {.job = job, .rules = rules};
    const froe_allocator *alloc = &job->alloc;
    const unsigned threads = job->task->threads;
    froe_status status = draft_new(alloc, job->scene->dim, 0, &g.main);
    g.workers = support_calloc(alloc, threads, sizeof *g.workers);
    if (!g.workers && !status) status = FROE_E_MEMORY;
    while (!status && g.worker_count < threads) {
        status = trapezoid_work_new(job->scene, alloc, job->first, rules->leaf, g.workers + g.worker_count);
        if (!status) g.worker_count++;
    }
    if (!status) status = grow_main_part(&g);
    if (!status) status = base_run(job->task, job->span, g.tasks.count, grow_small_cell, &g);
    if (!status) status = seal_growth(&g, out);
    for (unsigned i = 0; i < g.worker_count; i++) trapezoid_work_free(g.workers + i);
    support_free(alloc, g.workers, threads * sizeof *g.workers);
    for (size_t i = 0; i < g.tasks.count; i++) draft_free(&g.tasks.data[i].draft);
    array_free(alloc, &g.tasks);
    array_free(alloc, &g.store);
    draft_free(&g.main);
    return split_explain(job->diag, job->max_fragments, status);
}
