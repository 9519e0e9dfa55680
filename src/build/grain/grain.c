/* grain.c: the cut of a cell, found by a contest. */
#include "build/grain/grain.h"
#include "base/log2.h"
#include "build/grain/candidates.h"
#include "split/cell.h"
#include "split/resort.h"
#include <string.h>

#define SHARE 0.7 /* of a cell that a balanced cut may leave on a side, whatever the budget */
static const double halving[] = {0.05, 0.15}; /* splits that one bit is worth while a cell is too large for the levels
                                                 left, in the plane and in space; */
#define PEELING 0.02                          /* and once it is not */
#define DEAR 0.04                             /* splits for a bit that are worth looking again */
enum { PEEL = 4, PEEL_MOST = 100, FEW = 4 };

typedef struct scratch {
    split_facets facets;
    split_price price;
    split_sweep sweep;
} scratch;

froe_status split_grain_scratch_new(const void *config, split_work *work) {
    (void)config;
    scratch *s = support_calloc(&work->set.alloc, 1, sizeof *s);
    if (!s) return FROE_E_MEMORY;
    work->scratch = s;
    split_price_init(&s->price);
    return split_facets_new(&work->set.alloc, work->set.scene, &s->facets);
}

void split_grain_scratch_free(split_work *work) {
    scratch *s = work->scratch;
    if (!s) return;
    split_facets_free(&work->set.alloc, &s->facets);
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

/** Fragments that can be separated in so many levels. */
static double manageable(uint32_t leaf, double levels, double most) {
    double n = few(leaf);
    for (levels -= need_of_few(leaf); levels >= 1 && n < most; levels--) n /= SHARE;
    return n;
}

static split_terms terms_of(const split_grain *config, int dim, const split_cell *cell) {
    double m = cell->count, share = SHARE * m, most = m;
    bool peel = m <= config->peel || (config->height <= 0 && m <= PEEL_MOST);
    if (m > config->peel && config->height > 0) {
        double levels = config->height - cell->depth;
        most = manageable(config->leaf, levels - 1, m);
        most = most > share ? most : share;
        peel = m <= PEEL * levels && m <= PEEL_MOST;
    }
    return (split_terms){peel ? PEELING : halving[dim == 3], most};
}

static bool limited(const split_contest *c) {
    return c->terms.most < c->cell->count && c->cell->count > FEW;
}

/* ------------------------------------------------------------ last resorts -- */

/** A piece that crosses its cell, or any other: its supporting plane takes it, at least, out of the cell. */
static split_verdict take_one(const split_contest *c, froe_cut *cut) {
    const split_set *set = &c->work->set;
    uint64_t draw = base_hash(c->config->seed, c->cell->path, 0x30000000);
    bool found = split_any_free(set, c->cell, draw, cut) || split_any_support(set, c->cell, draw, cut);
    return found ? SPLIT_CUT : SPLIT_INSEPARABLE;
}

static void note_unbalanced(const split_contest *c) {
    unsigned most = atomic_load(&c->config->notes->unbalanced);
    while (c->cell->count > most && !atomic_compare_exchange_weak(&c->config->notes->unbalanced, &most, c->cell->count))
        continue;
}

/** Where no candidate is balanced: a plane at the median of vertices, if it does better. All fragments are shown. */
static split_verdict balance_vertices(split_contest *c, froe_cut *cut) {
    split_tally tally;
    froe_cut median;
    if (split_vertex_median(c->facets, c->work->set.scene, &median)) {
        if (cell_tally(c->work, c->cell, &median, &tally)) return SPLIT_MEMORY;
        uint32_t larger = c->count ? split_tally_larger(c->tally) : c->cell->count;
        if (split_tally_useful(tally) && split_tally_larger(tally) < larger) {
            atomic_store(&c->config->notes->medians, true);
            *cut = median;
            return SPLIT_CUT;
        }
    }
    note_unbalanced(c);
    return c->count ? SPLIT_CUT : take_one(c, cut);
}

/* ----------------------------------------------------------------- choice -- */

/** Scores the best of a sample on all fragments. Where corners lie closer together than doubles tell, a sample is
 * full of cuts that seem to split nothing and split all: if no finalist is worth its splits, supports are, perhaps. */
static void run_off(split_contest *c) {
    split_candidate last[SPLIT_FINALISTS];
    uint32_t count = c->count;
    if (c->facets->weight == 1 || c->failed) return;
    memcpy(last, c->best, count * sizeof *last);
    split_contest_show(c, c->cell->count);
    for (uint32_t i = 0; i < count && !c->failed; i++)
        if (split_contest_score(c, &last[i])) split_contest_enter(c, &last[i]);
    if (!c->count || c->best[0].cost > 0) split_enter_supports(c);
}

static void hold(split_contest *c) {
    split_contest_show(c, c->config->effort.sample);
    if (c->failed) return;
    split_enter_supports(c);
    split_enter_axes(c);
    split_enter_through(c);
    run_off(c);
}

/** Splits that the best cut makes for each bit that it tells; negative: it tells nothing. */
static double splits_per_bit(const split_contest *c) {
    const split_terms bits = {1, c->cell->count};
    double splits = c->tally.both - c->best[0].due;
    double gain = c->tally.both - split_price_of(c->price, &bits, c->tally, 1);
    return gain > 0 ? splits / gain : -1;
}

/** Where the best cut makes more splits for each bit than the weight assumes, the contest is held once more with that
 * weight: a step of Dinkelbach's method (1967) towards the fewest splits per bit. */
static void hold_at_actual_price(split_contest *c) {
    double actual = !c->config->effort.again || c->failed || !c->count ? 0 : splits_per_bit(c);
    if (actual <= DEAR || actual <= c->terms.weight) return;
    c->terms.weight = actual;
    hold(c);
}

split_verdict split_grain_choose(const void *config, split_work *work, const split_cell *cell, froe_cut *cut) {
    scratch *s = work->scratch;
    split_contest c = {
        .config = config, .cell = cell, .work = work, .facets = &s->facets, .sweep = &s->sweep, .price = &s->price};
    if (cell->count <= c.config->leaf) return SPLIT_LEAF;
    if (c.config->leaf && split_one_point(&work->set, cell)) return SPLIT_INSEPARABLE;
    if (cell->attempt || cell->count == 1) return take_one(&c, cut);
    c.terms = terms_of(c.config, work->set.scene->dim, cell);
    hold(&c);
    hold_at_actual_price(&c);
    if (c.failed) return SPLIT_MEMORY;
    if (c.count) *cut = split_candidate_cut(&c.best[0]);
    if (limited(&c) && (!c.count || split_tally_larger(c.tally) > c.terms.most)) return balance_vertices(&c, cut);
    return c.count ? SPLIT_CUT : take_one(&c, cut);
}
