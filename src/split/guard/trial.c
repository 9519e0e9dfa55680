/* trial.c: see trial.h.
 *
 * Levels. Refinement of x fragments may go 4 (log2 x + 4) levels down, and in a leaf of the guard tree x: each of its
 * cuts leaves a fragment less on either side.
 * Tests. So many fragments may be compared with cuts, candidates included, as when every piece were compared with all
 * candidates of a cell on log2 x + 1 levels. */
#include "split/guard/trial.h"
#include "base/log2.h"
#include <math.h>

/* Half the pieces a fragment, in the plane and elsewhere; pieces a guard leaf; by how much guard cuts may exceed what
 * refinement exceeds, in halves; the next allowance; levels. Measured: docs/design/density.md. */
enum { IN_PLANE = 6, IN_SPACE = 3, A_LEAF = 4, HALVES = 3, NEXT = 8, LEVELS = 4 };

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

static bool is_guard_leaf(const split_job *job, const split_cell *cell) {
    return !job->guard->nodes.data[cell->guard].child;
}

bool trial_cuts_by_guard(const split_job *job, const split_method *method, const split_cell *cell) {
    if (cell->guard == FROE_NONE) return false;
    bool halved = 2 * (uint64_t)split_load(cell) <= cell->tried;
    return (cell->tried && !halved && !is_guard_leaf(job, cell)) || method->in_guard_stage(method->config, cell);
}

bool trial_is_due(const split_job *job, const split_cell *cell) {
    return job->trials && cell->guard != FROE_NONE;
}

/* -------------------------------------------------------------- allowances -- */

static split_allowance allowance_of(const split_job *job, const split_cell *cell) {
    const double x = split_load(cell), bits = base_log2(x + 1);
    const double fragment = 0.5 * (job->guard->dim == 2 ? IN_PLANE : IN_SPACE);
    const double pieces = ceil(fragment * x) + A_LEAF * job->trials->leaves[cell->guard];
    return (split_allowance){pieces, floor(pieces * (bits + 1) * job->trials->candidates), LEVELS * (bits + LEVELS)};
}

/** In a leaf of the guard tree: x lines of the plane meet each other in x - 1 points at most, and x planes of space
 * divide each of x polygons into at most 1 + (x - 1) + (x - 1) (x - 2) / 2 parts. */
static split_allowance final_allowance(const split_job *job, const split_cell *cell) {
    const double x = split_load(cell);
    double pieces = 1;
    for (int i = 0; i < job->guard->dim; i++) pieces *= x;
    return (split_allowance){pieces, pieces * (x + 1) * job->trials->candidates, x};
}

static split_allowance next_of(const split_allowance *a) {
    return (split_allowance){NEXT * a->pieces, NEXT * a->tests, NEXT * a->levels};
}

/* ------------------------------------------------------------------ states -- */

static split_stand stand_of(const split_work *work) {
    return (split_stand){draft_mark(work->set.draft), work->set.items.count, work->cells.count, work->deepest,
                         work->books};
}

static uint32_t local_root(const split_work *work, const split_trial *t) {
    return t->cell.node - work->set.draft->outer;
}

/** What now grows began here. */
static const split_stand *start_of(const split_trial *t) {
    return t->by_guard ? &t->waiting : &t->before;
}

/** Removes all that came after. */
static void return_to(split_work *work, const split_trial *t, const split_stand *stand) {
    work->carried += work->set.items.count - stand->items;
    draft_cut_back(work->set.draft, &stand->draft, local_root(work, t));
    work->set.items.count = stand->items;
    work->cells.count = stand->cells;
    work->deepest = stand->deepest;
    work->books = stand->books;
}

/** Puts a cell, that of the trial, with its fragments on top, as if nothing had been made of it. */
static froe_status lay(split_work *work, const split_trial *t, split_cell cell) {
    split_set *set = &work->set;
    cell.first = (uint32_t)set->items.count;
    if (t->by_guard) cell.corner_top = (uint32_t)set->corners.count;
    if (!array_append(&set->alloc, &set->items, t->items.data, cell.count)) return FROE_E_MEMORY;
    set->draft->nodes.data[local_root(work, t)] = (tree_node){0};
    return array_push(&set->alloc, &work->cells, cell) ? FROE_OK : FROE_E_MEMORY;
}

/** Pieces of what grows now, pending ones included. */
static double pieces_of(const split_work *work, const split_trial *t) {
    const split_stand *start = start_of(t);
    return (double)(work->set.draft->pieces.count - start->draft.pieces + work->set.items.count - start->items);
}

static bool is_done(const split_work *work, const split_trial *t) {
    return work->cells.count == start_of(t)->cells;
}

static void allow(split_work *work, split_trial *t, split_allowance allowed) {
    t->allowed = allowed;
    work->tests_allowed += allowed.tests;
}

static double most_by_guard(const split_trial *t) {
    return 0.5 * HALVES * t->allowed.pieces;
}

static bool refinement_exceeds(const split_work *work, const split_trial *t) {
    return pieces_of(work, t) > t->allowed.pieces || (double)(work->tests - t->tested) > t->allowed.tests ||
           (double)work->deepest - (t->cell.depth - t->cell.peels) > t->allowed.levels;
}

/** Refinement is complete, and stays. */
static void close_trial(split_work *work, split_trial *t) {
    split_books *b = &work->books;
    b->fragments += split_load(&t->cell);
    b->pieces += t->allowed.pieces;
    b->height = fmax(b->height, t->cell.depth + t->allowed.levels);
    work->deepest = work->deepest > t->before.deepest ? work->deepest : t->before.deepest;
    t->open = false;
}

/* ------------------------------------------------------------------ trials -- */

froe_status trial_begin(const split_job *job, split_work *work, const split_cell *cell) {
    split_trial *t = work->first.open ? &work->later : &work->first;
    t->items.count = 0;
    if (!array_append(&work->set.alloc, &t->items, work->set.items.data + cell->first, cell->count))
        return FROE_E_MEMORY;
    t->open = true;
    t->by_guard = false;
    t->final = cell->plain;
    t->other = 0;
    t->cell = *cell;
    t->before = stand_of(work);
    t->before.items = cell->first;
    allow(work, t, cell->plain ? final_allowance(job, cell) : allowance_of(job, cell));
    t->tested = work->tests;
    work->deepest = cell->depth - cell->peels;
    work->carried += split_load(cell);
    return FROE_OK;
}

static froe_status take_back(split_work *work, split_trial *t) {
    return_to(work, t, &t->before);
    t->open = false;
    return lay(work, t, t->cell);
}

/** Is it known that what grows now has more pieces than the whole tree may have? Each pending fragment will be one
 * piece at least. */
static bool exceeds_limit(const split_job *job, const split_work *work, const split_trial *t) {
    return job->max_fragments && pieces_of(work, t) > (double)job->max_fragments;
}

/** A cell that guard cuts cannot divide is allowed more and more up to the final allowance, which at the latest cuts
 * along its fragments alone keep to. `ends`: nothing else waits, so a limit on all pieces ends the build where these
 * cuts exceed it, too. */
static froe_status judge_in_leaf(const split_job *job, split_work *work, split_trial *t, bool ends) {
    while (refinement_exceeds(work, t) && !t->final) {
        const split_allowance last = final_allowance(job, &t->cell), next = next_of(&t->allowed);
        t->final = next.pieces >= last.pieces;
        allow(work, t, t->final ? last : next);
    }
    const bool limited = ends && exceeds_limit(job, work, t);
    if (limited && t->cell.plain) return FROE_E_BUDGET;
    if ((limited || refinement_exceeds(work, t)) && !t->cell.plain) {
        t->cell.plain = true;
        return take_back(work, t);
    }
    if (is_done(work, t)) close_trial(work, t);
    return FROE_OK;
}

/** Refinement below guard cuts. */
static froe_status judge_later(split_work *work, split_trial *t) {
    if (refinement_exceeds(work, t)) {
        t->cell.tried = split_load(&t->cell);
        return take_back(work, t);
    }
    if (is_done(work, t)) close_trial(work, t);
    return FROE_OK;
}

/** Refinement waits, and its cell grows by guard cuts. */
static froe_status go_by_guard(split_work *work, split_trial *t) {
    split_cell cell = t->cell;
    cell.tried = split_load(&cell);
    t->waiting = stand_of(work);
    t->waiting_tests = work->tests - t->tested;
    t->other = pieces_of(work, t);
    work->deepest = t->before.deepest;
    t->root = work->set.draft->nodes.data[local_root(work, t)];
    t->by_guard = true;
    work->books = t->before.books;
    return lay(work, t, cell);
}

/** Guard cuts are taken back, and refinement goes on. */
static void go_on(split_work *work, split_trial *t) {
    t->other = pieces_of(work, t);
    return_to(work, t, &t->waiting);
    work->set.draft->nodes.data[local_root(work, t)] = t->root;
    work->later.open = t->by_guard = false;
    allow(work, t, next_of(&t->allowed));
    t->tested = work->tests - t->waiting_tests;
}

/** Guard cuts stay, and refinement is removed. */
static void stay_by_guard(split_work *work, split_trial *t) {
    draft_remove(work->set.draft, &t->before.draft, &t->waiting.draft, local_root(work, t));
    work->set.items.count = t->before.items;
    work->cells.count = t->before.cells;
    work->books.beyond += most_by_guard(t);
    t->open = false;
}

/** Refinement of the first cell, and guard cuts in its place. A limit on all pieces ends the build once both ways are
 * known to exceed it: guard cuts are tried as soon as refinement does. What waited may be complete, if its cell was
 * finished at once: then it is judged again. */
static froe_status judge_first(const split_job *job, split_work *work, split_trial *t) {
    const bool limited = exceeds_limit(job, work, t);
    if (limited && t->other > (double)job->max_fragments) return FROE_E_BUDGET;
    if (t->by_guard && pieces_of(work, t) > most_by_guard(t)) {
        go_on(work, t);
        if (!is_done(work, t)) return FROE_OK;
    }
    if (t->by_guard) {
        if (is_done(work, t)) stay_by_guard(work, t);
    } else if (refinement_exceeds(work, t) || (limited && t->other == 0)) {
        return go_by_guard(work, t);
    } else if (is_done(work, t)) {
        close_trial(work, t);
    }
    return FROE_OK;
}

froe_status trial_judge(const split_job *job, split_work *work) {
    split_trial *first = &work->first, *later = &work->later;
    froe_status status = FROE_OK;
    if (job->trials->idle) {
        if (exceeds_limit(job, work, first)) return FROE_E_BUDGET;
        if (is_done(work, first)) close_trial(work, first);
        return status;
    }
    if (later->open)
        status = is_guard_leaf(job, &later->cell) ? judge_in_leaf(job, work, later, false) : judge_later(work, later);
    if (status || !first->open) return status;
    return is_guard_leaf(job, &first->cell) ? judge_in_leaf(job, work, first, true) : judge_first(job, work, first);
}

void trial_add_up(split_sums *sums, const split_work *work) {
    split_books *sum = &sums->books;
    const split_books *b = &work->books;
    sum->fragments += b->fragments;
    sum->pieces += b->pieces;
    sum->beyond += b->beyond;
    sum->height = fmax(sum->height, b->height);
    sum->peels = fmax(sum->peels, b->peels);
    sums->tests += (double)work->tests;
    sums->tests_allowed += work->tests_allowed;
    sums->carried += (double)work->carried;
}

void trial_free(const froe_allocator *alloc, split_work *work) {
    array_free(alloc, &work->first.items);
    array_free(alloc, &work->later.items);
}
