/* grow.c: the shared loop, cell by cell or level by level down to small cells, then one task per small cell. */
#include "split/charge/thin.h"
#include "split/guard/trial.h"
#include "split/step.h"
#include "split/waiting.h"
#include "support/fail.h"
#include <math.h>
#include <string.h>

/* Cells of at most max(least, n / share) fragments become tasks, except tiny ones, which do not pay for a task. */
enum { TASK_TINY = 16, TASK_LEAST = 1024, TASK_LEAST_AHEAD = 256, TASK_SHARE = 64, REGROWN = 4 };

typedef struct grow {
    const split_job *job;
    const split_method *method;
    tree_draft main;
    split_work *workers; /**< one per thread; the first also does the main part */
    unsigned worker_count;
    grow_tasks tasks;
    grow_tasks level, next; /**< large cells: of the level at hand, and those found below it */
    uint32_t task_size;
    atomic_uint_least64_t emitted; /**< pieces in final drafts */
} grow;

/* --------------------------------------------------------------- one cell -- */

/** A draft is final. */
static froe_status count_pieces(grow *g, const tree_draft *draft) {
    uint64_t most = g->job->max_fragments, count = draft->pieces.count;
    uint64_t emitted = atomic_fetch_add(&g->emitted, count) + count;
    return most && emitted > most ? FROE_E_BUDGET : FROE_OK;
}

/** Cuts or ends a cell below the guard stage. */
static froe_status refine_cell(grow *g, split_work *work, split_cell *cell) {
    froe_status status = cell_take(work, g->job->lowest, cell, cell->wholes);
    bool done = false;
    if (!status) status = cover_find(&work->set, cell);
    const size_t pending = work->cells.count;
    if (g->method->finish && !status) status = g->method->finish(g->method->config, work, cell, &done);
    if (done && !status) status = step_empty_rooms(g->method, work, pending);
    return status || done ? status : split_step(g->method, work, cell);
}

static froe_status grow_cell(grow *g, split_work *work, split_cell *cell) {
    froe_status status = FROE_OK;
    if (cell->thin) {
        status = thin_cut(work, cell);
    } else if (trial_cuts_by_guard(g->job, g->method, cell)) {
        status = cell_cut_guard(work, g->job, cell);
    } else {
        if (trial_is_due(g->job, cell)) status = trial_begin(g->job, work, cell);
        if (!status) status = refine_cell(g, work, cell);
    }
    if (!status && work->first.open) status = trial_judge(g->job, work);
    if (status || work->first.open) return status;
    /* each pending fragment will be one piece at least, and a subtree grown again has half as many as before at
     * least: a refusal here is a refusal in any order of work */
    uint64_t most = g->job->max_fragments, count = work->set.draft->pieces.count + work->set.items.count;
    if (work->most) return count > work->most ? FROE_E_BUDGET : FROE_OK;
    if (g->method->height > 0 && work->set.draft != &g->main) count /= 2;
    return most && atomic_load(&g->emitted) + count > most ? FROE_E_BUDGET : FROE_OK;
}

/** Is the turn of a cell of the main part to come later? Small ones become tasks, and their nodes leaves for now; large
 * ones wait for the others of their level. */
static froe_status put_off_if_due(grow *g, split_work *work, const split_cell *cell, bool *due) {
    const uint32_t load = split_load(cell);
    const bool whole = trial_is_due(g->job, cell) && !trial_cuts_by_guard(g->job, g->method, cell);
    const bool small = load <= g->task_size || whole;
    *due = !work->first.open && !cell->thin && load > TASK_TINY && (small || g->method->ahead);
    if (!*due) return FROE_OK;
    if (small) draft_leaf(work->set.draft, cell->node, 0);
    return waiting_put_off(g->method->room, work, cell, small ? &g->tasks : &g->next);
}

/** Works off all pending cells; in the main part, some are put off. */
static froe_status grow_cells(grow *g, split_work *work, bool main_part) {
    froe_status status = FROE_OK;
    for (uint32_t turn = 0; work->cells.count && !status; turn++) {
        split_cell cell = work->cells.data[--work->cells.count];
        const size_t room = g->method->room;
        if (room) memcpy(work->rooms.data, work->rooms.data + room * (work->cells.count + 1), room);
        work->set.corners.count = cell.corner_top;
        const uint32_t levels = cell.depth - cell.peels;
        work->books.peels = cell.peels > work->books.peels ? cell.peels : work->books.peels;
        work->deepest = levels > work->deepest && !cell.thinned ? levels : work->deepest;
        bool later = false;
        if (main_part) status = put_off_if_due(g, work, &cell, &later);
        if (!status && !later) status = grow_cell(g, work, &cell);
        bool ask = main_part || turn % 64 == 63; /* in tasks, too: one task may be nearly the whole build */
        if (ask && !status && !split_go_on(work)) status = FROE_E_CANCELLED;
    }
    return status;
}

/* ------------------------------------------------------------- the stages -- */

static froe_status start_workers(grow *g) {
    const split_job *job = g->job;
    g->workers = support_calloc(&job->alloc, job->task->threads, sizeof *g->workers);
    if (!g->workers) return FROE_E_MEMORY;
    froe_status status = FROE_OK;
    bool boxes = false;
    for (uint32_t i = 0; i < job->scene->object_count && !boxes; i++) boxes = scene_form(job->scene, i) == FROE_BOX;
    for (; g->worker_count < job->task->threads && !status; g->worker_count++) {
        split_work *work = g->workers + g->worker_count;
        status = split_set_new(job->scene, &job->alloc, &work->set);
        if (status) break;
        work->set.boxes = boxes;
        work->task = job->task;
        work->calling = work == g->workers;
        if (job->first > work->set.context.first) work->set.context.first = job->first;
        if (g->method->scratch_new) status = g->method->scratch_new(g->method->config, work);
    }
    return status;
}

/** The root cell: all objects, not yet cut, in the order of lowest_nodes.h; or as fragments without a guard stage. */
static froe_status push_root(grow *g, split_work *work) {
    uint32_t n = g->job->scene->object_count;
    split_cell root = {.path = 1, .guard = FROE_NONE, .growth = g->job->root ? 0 : 1};
    for (int k = 0; k < g->job->scene->dim; k++) root.lo[k] = -INFINITY, root.hi[k] = INFINITY;
    if (g->job->guard && n && !g->job->root) {
        root.guard = 0;
        root.wholes = n;
    } else {
        if (!array_reserve(&g->job->alloc, &work->set.items, n)) return FROE_E_MEMORY;
        const uint32_t *order = g->job->order;
        for (uint32_t i = 0; i < n; i++) work->set.items.data[i] = (split_fragment){.object = order ? order[i] : i};
        work->set.items.count = root.count = n;
    }
    if (!array_push(&g->job->alloc, &work->cells, root) || !step_fit_rooms(g->method, work)) return FROE_E_MEMORY;
    if (g->method->room) memset(work->rooms.data, 0, work->rooms.count);
    return FROE_OK;
}

/** Makes the cut that the job begins with. */
static froe_status cut_root(grow *g, split_work *work) {
    if (!g->job->root) return FROE_OK;
    const split_cell root = work->cells.data[--work->cells.count];
    return step_divide(g->method, work, &root, g->job->root, 0, NULL);
}

/** Names the cut of a large cell. */
static froe_status choose_ahead(void *user, unsigned worker, size_t index) {
    grow *g = user;
    split_work *work = g->workers + worker;
    grow_task *task = g->level.data + index;
    work->set.draft = &g->main;
    const froe_status status = waiting_take_up(work, task);
    if (!status) task->choice.verdict = g->method->choose(g->method->config, work, &task->cell, &task->choice.cut);
    return status;
}

/** Names the cuts of all large cells that wait, and makes them. */
static froe_status grow_level(grow *g, split_work *work) {
    const grow_tasks level = g->next;
    g->next = g->level;
    g->level = level;
    froe_status status = base_run(g->job->task, 0, level.count, choose_ahead, g);
    for (size_t i = 0; i < level.count; i++) {
        grow_task *task = level.data + i;
        if (!status) status = waiting_take_up(work, task);
        work->chosen = &task->choice;
        if (!status) status = grow_cell(g, work, &task->cell);
        work->chosen = NULL;
        if (!status) status = grow_cells(g, work, true);
        waiting_free(&g->job->alloc, task);
    }
    g->level.count = 0;
    return status;
}

static froe_status main_part(grow *g) {
    split_work *work = g->workers;
    uint32_t n = g->job->scene->object_count;
    const uint32_t least = g->method->ahead ? TASK_LEAST_AHEAD : TASK_LEAST;
    work->set.draft = &g->main;
    g->task_size = n / TASK_SHARE > least ? n / TASK_SHARE : least;
    froe_status status = push_root(g, work);
    if (!status) status = cut_root(g, work);
    if (!status) status = grow_cells(g, work, n > g->task_size || g->method->height > 0);
    while (g->next.count && !status) status = grow_level(g, work);
    return status ? status : count_pieces(g, &g->main);
}

/** Loads a task's fragments into a worker and finishes the subtree in the task's own draft, as if it began `sunk`
 * levels further down. */
static froe_status grow_task_from(grow *g, split_work *work, grow_task *task, uint32_t sunk) {
    split_set *set = &work->set;
    const froe_allocator *alloc = &g->job->alloc;
    task->draft = (tree_draft){0};
    froe_status status = draft_new(alloc, g->main.dim, (uint32_t)g->main.nodes.count, &task->draft);
    if (status) return status;
    set->main = &g->main;
    set->draft = &task->draft;
    status = waiting_take_up(work, task);
    if (status) return status;
    split_cell cell = task->cell;
    cell.node = task->draft.outer;
    cell.depth += sunk;
    work->deepest = 0;
    if (!array_push(alloc, &work->cells, cell) || !step_fit_rooms(g->method, work)) return FROE_E_MEMORY;
    const size_t room = g->method->room;
    if (room) memcpy(work->rooms.data + room, task->room.data, room);
    status = grow_cells(g, work, false);
    if (status == FROE_E_INPUT) memcpy(task->crossing, work->crossing, sizeof task->crossing);
    return status;
}

/** Levels by which the subtree just grown goes beyond the height of the method. */
static uint32_t levels_over(const grow *g, const split_work *work, uint32_t sunk) {
    uint32_t deepest = work->deepest - sunk;
    return g->method->height > 0 && deepest > g->method->height ? (uint32_t)ceil(deepest - g->method->height) : 0;
}

static froe_status do_task(void *user, unsigned worker, size_t index) {
    grow *g = user;
    split_work *work = g->workers + worker;
    grow_task *task = g->tasks.data + index;
    const split_thin_notes before_task = work->thinned;
    froe_status status = grow_task_from(g, work, task, 0);
    /* A subtree that is `over` levels too deep is grown again, each time as if it began as much further down as the
     * last reached too far, while that helps. The lowest stays. */
    uint32_t over = levels_over(g, work, 0);
    for (uint32_t turn = 0, sunk = 0; turn < REGROWN && over && !status; turn++) {
        tree_draft before = task->draft;
        const split_thin_notes noted = work->thinned;
        work->thinned = before_task;
        size_t pieces = before.pieces.count;
        sunk += over;
        work->most = 2 * (uint64_t)pieces;
        status = grow_task_from(g, work, task, sunk);
        work->most = 0;
        bool lower = !status && levels_over(g, work, sunk) < over && 2 * task->draft.pieces.count >= pieces;
        if (status == FROE_E_BUDGET) status = FROE_OK;
        draft_free(lower ? &before : &task->draft);
        if (!lower) task->draft = before, work->thinned = noted;
        over = lower ? levels_over(g, work, sunk) : 0;
    }
    return status ? status : count_pieces(g, &task->draft);
}

static froe_status seal(grow *g, froe_tree **out) {
    const froe_allocator *alloc = &g->job->alloc;
    size_t count = g->tasks.count;
    tree_graft *grafts = support_calloc(alloc, count, sizeof *grafts);
    if (!grafts) return FROE_E_MEMORY;
    for (size_t i = 0; i < count; i++) grafts[i] = (tree_graft){g->tasks.data[i].cell.node, &g->tasks.data[i].draft};
    for (unsigned i = 0; i < g->worker_count && g->job->sums; i++) trial_add_up(g->job->sums, g->workers + i);
    for (unsigned i = 0; i < g->worker_count && g->job->thinned; i++)
        thin_add_up(g->job->thinned, &g->workers[i].thinned);
    if (g->method->note) g->method->note(g->method->config);
    for (unsigned i = 0; i < g->worker_count; i++) num_stats_add(&g->main.predicates, &g->workers[i].set.context.stats);
    froe_status status = draft_seal(&g->main, grafts, count, g->job->scene, g->job->meta, out);
    support_free(alloc, grafts, (count ? count * sizeof *grafts : 1));
    return status;
}

/** Two objects that cross: those of the main part, or of the first task that was refused. */
static froe_status explain_crossing(const grow *g) {
    const uint32_t *ids = g->workers[0].crossing;
    for (size_t i = g->tasks.count; i-- > 0;)
        if (g->tasks.data[i].crossing[0] != FROE_NONE) ids = g->tasks.data[i].crossing;
    return support_fail_at(g->job->diag, FROE_E_INPUT, ids[0], FROE_NONE, FROE_NONE,
                           "object %u: It crosses object %u. The option crossing=split cuts such objects.", ids[0],
                           ids[1]);
}

froe_status split_explain(froe_diagnostic *diag, uint64_t max_fragments, froe_status status) {
    if (status == FROE_E_BUDGET)
        return support_fail(diag, status, "More than %llu pieces are needed, and no more are allowed.",
                            (unsigned long long)max_fragments);
    if (status == FROE_E_LIMIT) return support_fail(diag, status, "More than 2^31 nodes or pieces are needed.");
    if (status == FROE_E_CANCELLED) return support_fail_cancelled(diag);
    return status ? support_fail_memory(diag) : FROE_OK;
}

froe_status split_grow(const split_job *job, const split_method *method, froe_tree **out) {
    grow g = {.job = job, .method = method};
    froe_status status = draft_new(&job->alloc, job->scene->dim, 0, &g.main);
    if (!status) status = start_workers(&g);
    if (!status) status = main_part(&g);
    if (!status) status = base_run(job->task, job->span, g.tasks.count, do_task, &g);
    if (!status && out) status = seal(&g, out);
    if (status == FROE_E_INPUT) explain_crossing(&g);
    const froe_allocator *alloc = &g.job->alloc;
    for (unsigned i = 0; i < g.worker_count; i++) {
        split_work *work = g.workers + i;
        if (g.method->scratch_free) g.method->scratch_free(work);
        split_set_free(&work->set);
        array_free(alloc, &work->cells);
        array_free(alloc, &work->rooms);
        trial_free(alloc, work);
        split_guard_tree_free(alloc, &work->thin);
    }
    support_free(alloc, g.workers, g.job->task->threads * sizeof *g.workers);
    waiting_free_all(alloc, &g.tasks);
    waiting_free_all(alloc, &g.level);
    waiting_free_all(alloc, &g.next);
    draft_free(&g.main);
    return status == FROE_E_INPUT ? status : split_explain(job->diag, job->max_fragments, status);
}
