/* grain.c: the cut of a cell, found by a contest. */
#include "build/grain/grain.h"
#include "base/log2.h"
#include "base/random.h"
#include "build/grain/candidates.h"
#include "split/cell.h"
#include "split/charge/thin.h"
#include "split/fallback.h"
#include <string.h>

#define SHARE 0.7 /* of a cell that a balanced cut may leave on a side, whatever the budget */
static const double halving[] = {0.05, 0.15}; /* splits that one bit is worth while a cell is too large for the levels
                                                 left, in the plane and in space; */
#define PEELING 0.02                          /* and once it is not */
#define DEAR 0.04                             /* splits for a bit that are worth looking again */
enum { PEEL = 4, PEEL_MOST = 100, FEW = 4, CHECKS = 16 };

typedef struct scratch {
    split_view view;
    split_price price;
    split_sweep sweep;
    split_grain_notebook notes;
} scratch;

froe_status split_grain_scratch_new(const void *config, split_work *work) {
    (void)config;
    scratch *s = support_calloc(&work->set.alloc, 1, sizeof *s);
    if (!s) return FROE_E_MEMORY;
    work->scratch = s;
    split_price_init(&s->price);
    return FROE_OK;
}

void split_grain_scratch_free(split_work *work) {
    scratch *s = work->scratch;
    if (!s) return;
    split_view_free(&work->set.alloc, &s->view);
    split_sweep_free(&work->set.alloc, &s->sweep);
    support_free(&work->set.alloc, s, sizeof *s);
    work->scratch = NULL;
}

/* ----------------------------------------------------------------- levels -- */

/* A cell of FEW fragments loses one at every cut, so it needs FEW levels, or `leaf` less. A larger one is cut with
 * balance: each level leaves at most SHARE of it. */

static uint32_t few(uint32_t leaf) {
    return leaf > FEW ? leaf : FEW;
}

static double need_of_few(uint32_t leaf) {
    return leaf < FEW ? FEW - leaf : 0;
}

double split_grain_need(uint32_t leaf, double n) {
    const double per_bit = 1.9433582098747317; /* 1 / log2(1 / SHARE) */
    return need_of_few(leaf) + (n > few(leaf) ? per_bit * base_log2(n / few(leaf)) : 0);
}

static split_terms terms_of(const split_grain *config, int dim, const split_cell *cell) {
    double m = cell->count, most = m;
    const double height = cell->thinned ? 0 : config->height; /* few fragments are left there */
    bool peel = m <= config->peel || (height <= 0 && m <= PEEL_MOST);
    if (m > config->peel && height > 0) {
        double levels = height - cell->depth, left = levels - 1 - need_of_few(config->leaf);
        most = few(config->leaf); /* what can be separated in the levels left, but at least SHARE */
        for (; left >= 1 && most < m; left--) most /= SHARE;
        most = most > SHARE * m ? most : SHARE * m;
        peel = m <= PEEL * levels && m <= PEEL_MOST;
    }
    return (split_terms){peel ? PEELING : halving[dim == 3], most};
}

/* ------------------------------------------------------------ last resorts -- */

/** A piece that crosses its cell, or any other: its supporting plane takes it, at least, out of the cell. */
static split_verdict take_one(const split_grain_search *s, froe_cut *cut) {
    const split_cell *cell = s->contest.cell;
    const split_set *set = &s->contest.work->set;
    uint64_t draw = base_hash(s->config->seed, cell->path, 0x30000000);
    bool found = split_any_free(set, cell, draw, cut) || split_any_support(set, cell, draw, cut);
    return found ? SPLIT_CUT : SPLIT_INSEPARABLE;
}

/** Notes that a cell has no balanced cut. */
static void note_unbalanced(const split_grain_search *s) {
    const split_contest *c = &s->contest;
    atomic_uint *unbalanced = &s->config->notes->unbalanced;
    unsigned most = atomic_load(unbalanced);
    if (c->count && thin_refuses(&s->config->thin, c->cell, c->best->tally.both)) return; /* nor will it be cut so */
    while (c->cell->count > most && !atomic_compare_exchange_weak(unbalanced, &most, c->cell->count)) continue;
}

/** Where no candidate is balanced: a plane at the median of vertices, if it does better. All fragments are shown. */
static split_verdict balance_vertices(split_grain_search *s, froe_cut *cut) {
    const split_contest *c = &s->contest;
    split_tally tally;
    froe_cut median;
    if (split_vertex_median(c->view, c->work->set.scene, &median)) {
        if (cell_tally(c->work, c->cell, &median, &tally)) return SPLIT_MEMORY;
        uint32_t larger = c->count ? split_tally_larger(c->best->tally) : c->cell->count;
        if (split_tally_useful(tally) && split_tally_larger(tally) < larger) {
            if (!thin_refuses(&s->config->thin, c->cell, tally.both)) atomic_store(&s->config->notes->medians, true);
            *cut = median;
            return SPLIT_CUT;
        }
    }
    note_unbalanced(s);
    return c->count ? SPLIT_CUT : take_one(s, cut);
}

/* ----------------------------------------------------------------- choice -- */

static void hold(split_grain_search *s) {
    split_contest_show(&s->contest, s->config->effort.sample, s->config->seed, s->config->deceived ? 0 : CHECKS);
    if (s->contest.failed) return;
    split_grain_begin(s);
    split_enter_supports(s);
    split_enter_axes(s);
    split_enter_through(s);
    split_enter_late_supports(s);
    /* Scores the best of a sample on all fragments. Where corners lie closer together than doubles tell, a sample is
     * full of cuts that seem to split nothing and split all: if no finalist is worth its splits, supports are,
     * perhaps. */
    split_contest *c = &s->contest;
    split_candidate last[SPLIT_FINALISTS];
    uint32_t count = c->count;
    if (c->view->weight == 1 || c->failed) return;
    memcpy(last, c->best, count * sizeof *last);
    split_contest_show(c, c->cell->count, s->config->seed, 0);
    for (uint32_t i = 0; i < count && !c->failed; i++)
        if (split_grain_score(s, &last[i])) split_contest_enter(c, &last[i]);
    if (c->count && c->best[0].cost <= 0) return;
    split_enter_supports(s);
    split_enter_late_supports(s);
}

/** Where the best cut makes more splits for each bit than the weight assumes, the contest is held once more with that
 * weight: a step of Dinkelbach's method (1967) towards the fewest splits per bit. */
static void hold_at_actual_price(split_grain_search *s) {
    split_contest *c = &s->contest;
    const split_candidate *best = c->best;
    if (!s->config->effort.again || c->failed || !c->count) return;
    const split_terms bits = {1, c->cell->count};
    double gain = best->tally.both - split_price_of(c->price, &bits, best->tally, 1);
    double actual = gain > 0 ? (best->tally.both - best->due) / gain : 0;
    if (actual <= DEAR || actual <= c->terms.weight) return;
    c->terms.weight = actual;
    hold(s);
}

split_verdict split_grain_choose(const void *config, split_work *work, const split_cell *cell, froe_cut *cut) {
    scratch *own = work->scratch;
    split_grain_search s = {.config = config, .sweep = &own->sweep, .notes = &own->notes};
    split_contest *c = &s.contest;
    *c = (split_contest){.work = work, .cell = cell, .view = &own->view, .price = &own->price, .exact = true};
    if (cell->count <= s.config->leaf) return SPLIT_LEAF;
    if (s.config->leaf && split_one_point(&work->set, cell)) return SPLIT_INSEPARABLE;
    if (cell->attempt || cell->count == 1) return take_one(&s, cut);
    c->deceived = s.config->deceived;
    c->terms = terms_of(s.config, work->set.scene->dim, cell);
    hold(&s);
    hold_at_actual_price(&s);
    if (c->failed) return SPLIT_MEMORY;
    if (c->count) *cut = c->best->cut;
    bool limited = c->terms.most < cell->count && cell->count > FEW;
    if (limited && (!c->count || split_tally_larger(c->best->tally) > c->terms.most)) return balance_vertices(&s, cut);
    return c->count ? SPLIT_CUT : take_one(&s, cut);
}
