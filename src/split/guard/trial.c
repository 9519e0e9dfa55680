/* trial.c: see trial.h. */
#include "split/guard/trial.h"
#include <string.h>

/* Good enough, and the most, as the head of trial.h says. Measured: the house of the benchmarks has cells of up to
 * 2,600 fragments that are worth their pieces. */
enum { GOOD = 3, GOOD_PARTS = 3, SMALL = 3000, MOST = 8 };

uint32_t *trial_leaves(const froe_allocator *alloc, const split_guard_tree *guard) {
    const size_t count = guard->nodes.count;
    uint32_t *leaves = support_calloc(alloc, count, sizeof *leaves);
    for (size_t i = count; leaves && i-- > 0;) {
        uint32_t child = guard->nodes.data[i].child;
        leaves[i] = child ? leaves[child] + leaves[child + 1] : 1;
    }
    return leaves;
}

void trial_leaves_free(const froe_allocator *alloc, const split_guard_tree *guard, uint32_t *leaves) {
    if (leaves) support_free(alloc, leaves, guard->nodes.count * sizeof *leaves);
}

bool trial_cuts_by_guard(const split_job *job, const split_method *method, const split_cell *cell) {
    if (cell->guard == FROE_NONE || cell->settled) return false;
    bool halved = 2 * (uint64_t)split_load(cell) <= cell->tried;
    bool divisible = job->guard->nodes.data[cell->guard].child != 0;
    return (cell->tried && !halved && divisible) || method->in_guard_stage(method->config, cell);
}

bool trial_is_due(const split_job *job, const split_cell *cell) {
    return job->guard_leaves && cell->guard != FROE_NONE && !cell->settled && job->guard->nodes.data[cell->guard].child;
}

/* ------------------------------------------------------------------ trials -- */

static uint64_t guards_below(const split_job *job, const split_cell *cell) {
    return (uint64_t)job->guard_leaves[cell->guard] * job->guard->k;
}

static uint64_t good_pieces(const split_job *job, const split_cell *cell) {
    uint64_t by_load = GOOD * (uint64_t)split_load(cell), by_guards = guards_below(job, cell) / GOOD_PARTS;
    return split_load(cell) <= SMALL && by_guards > by_load ? by_guards : by_load;
}

static uint64_t most_pieces(const split_job *job, const split_cell *cell) {
    return MOST * (uint64_t)split_load(cell) + guards_below(job, cell);
}

/** Pieces made below the cell on trial, pending ones included. */
static uint64_t pieces_of(const split_work *work, const split_trial *t) {
    return work->set.draft->pieces.count - t->before.pieces + work->set.items.count - t->cell.first;
}

static froe_status note(split_work *work, split_trial *t, const split_cell *cell) {
    t->items.count = 0;
    if (!array_reserve(&work->set.alloc, &t->items, cell->count)) return FROE_E_MEMORY;
    if (cell->count) memcpy(t->items.data, work->set.items.data + cell->first, cell->count * sizeof *t->items.data);
    t->open = true;
    t->by_guard = false;
    t->cell = *cell;
    t->before = draft_mark(work->set.draft);
    t->pending = work->cells.count;
    t->deepest = work->deepest;
    t->guarded = work->guarded;
    return FROE_OK;
}

/** Everything is as it was when the trial began, and the cell is pending. */
static froe_status take_back(split_work *work, split_trial *t) {
    split_set *set = &work->set;
    const split_cell *cell = &t->cell;
    draft_cut_back(set->draft, &t->before, cell->node - set->draft->outer);
    set->items.count = cell->first;
    work->cells.count = t->pending;
    work->deepest = t->deepest;
    work->guarded = t->guarded;
    if (!array_reserve(&set->alloc, &set->items, cell->count)) return FROE_E_MEMORY;
    if (cell->count) memcpy(set->items.data + cell->first, t->items.data, cell->count * sizeof *t->items.data);
    set->items.count += cell->count;
    return array_push(&set->alloc, &work->cells, *cell) ? FROE_OK : FROE_E_MEMORY;
}

froe_status trial_begin(const split_job *job, split_work *work, const split_cell *cell) {
    split_trial *t = work->first.open ? &work->later : &work->first;
    t->most = t == &work->first ? most_pieces(job, cell) : good_pieces(job, cell);
    return note(work, t, cell);
}

/** The refinement below guard cuts. */
static froe_status judge_later(split_work *work) {
    split_trial *t = &work->later;
    bool done = work->cells.count == t->pending;
    if (pieces_of(work, t) <= t->most) {
        if (done) work->guarded += split_load(&t->cell);
        t->open = !done;
        return FROE_OK;
    }
    t->open = false;
    t->cell.tried = split_load(&t->cell);
    return take_back(work, t);
}

/** The refinement of v, and then v by guard cuts. */
static froe_status judge_first(const split_job *job, split_work *work) {
    split_trial *t = &work->first;
    uint64_t pieces = pieces_of(work, t);
    bool done = work->cells.count == t->pending;
    if (!done && pieces <= t->most) return FROE_OK;
    if (pieces <= (t->by_guard ? t->most : good_pieces(job, &t->cell))) {
        if (t->by_guard)
            work->allowed += t->most;
        else
            work->guarded += split_load(&t->cell);
        t->open = false;
        return FROE_OK;
    }
    t->cell.tried = split_load(&t->cell);
    t->cell.settled = t->by_guard;
    t->open = !t->by_guard;
    t->by_guard = true;
    t->most = pieces < t->most ? pieces : t->most;
    work->later.open = false;
    return take_back(work, t);
}

froe_status trial_judge(const split_job *job, split_work *work) {
    froe_status status = work->later.open ? judge_later(work) : FROE_OK;
    return status ? status : judge_first(job, work);
}

void trial_free(const froe_allocator *alloc, split_work *work) {
    array_free(alloc, &work->first.items);
    array_free(alloc, &work->later.items);
}
