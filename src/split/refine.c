/* refine.c: the cut of a cell, the best of its candidates. */
#include "split/refine.h"
#include "base/log2.h"
#include "base/random.h"
#include "split/cell.h"
#include "split/finish.h"
#include "split/resort.h"
#include <math.h>
#include <string.h>

/* Candidates in cells of solids: ends of extents an axis, planes between pairs. */
enum { QUANTILES = 10, SEPARATORS = 32 };

froe_status split_scratch_begin(const froe_allocator *alloc, split_scratch *s) {
    split_price_init(&s->price);
    s->table = split_table_new(alloc);
    return s->table ? FROE_OK : FROE_E_MEMORY;
}

void split_scratch_end(const froe_allocator *alloc, split_scratch *s) {
    split_view_free(alloc, &s->view);
    split_axes_free(alloc, &s->axes);
    split_separator_free(alloc, &s->separator);
    split_table_free(alloc, s->table);
}

froe_status split_scratch_new(const void *config, split_work *work) {
    (void)config;
    work->scratch = support_calloc(&work->set.alloc, 1, sizeof(split_scratch));
    return work->scratch ? split_scratch_begin(&work->set.alloc, work->scratch) : FROE_E_MEMORY;
}

void split_scratch_free(split_work *work) {
    if (!work->scratch) return;
    split_scratch_end(&work->set.alloc, work->scratch);
    support_free(&work->set.alloc, work->scratch, sizeof(split_scratch));
    work->scratch = NULL;
}

/** The best candidate so far. */
typedef struct choice {
    froe_cut cut;
    double cost;
    bool any, good; /**< good: splits nothing and leaves at most three quarters on a side; no better one is sought */
} choice;

/** The rules that hold for all candidates of one cell. */
typedef struct contest {
    const split_refine *config;
    split_work *work;
    split_scratch *scratch;
    const split_cell *cell;
    split_terms terms; /**< with `most` where balance is due */
    bool solids;       /**< there is nothing but boxes, balls and hulls */
    choice best;
} contest;

/** Comparisons of pairs that are left, of all, and copies, at their price. 1: as much as without the cut. */
static double solids_cost(split_tally t, double copy) {
    double m = t.negative + t.positive + t.on + t.both, a = t.negative + t.both, b = t.positive + t.both;
    return (a * a + b * b) / (m * m) + copy * t.both / m;
}

static void enter_cut(contest *c, const froe_cut *cut, split_tally tally) {
    if (!split_tally_useful(tally)) return;
    double cost = c->solids ? solids_cost(tally, c->config->copy)
                            : split_price_of(&c->scratch->price, &c->terms, tally, c->scratch->view.weight);
    if (c->best.any && cost >= c->best.cost) return;
    uint32_t larger = tally.negative > tally.positive ? tally.negative : tally.positive;
    c->best = (choice){*cut, cost, true,
                       !tally.both && 4 * (uint64_t)larger <= 3 * ((uint64_t)tally.negative + tally.positive) + 2};
    if (cut->kind != FROE_CUT_PLANE) return;
    split_separator *s = &c->scratch->separator;
    memcpy(s->best, cut->normal, sizeof s->best);
    c->best.cut.normal = s->best;
}

static void enter_support(contest *c, uint32_t item) {
    const split_set *set = &c->work->set;
    if (set->scene->dim > 3) return;
    froe_cut cut = scene_support_cut(set->scene, set->items.data[c->cell->first + item].object);
    if (cut.kind != FROE_CUT_NONE) enter_cut(c, &cut, split_view_count(&c->scratch->view, set->scene, &cut));
}

/** All fragments of a small cell, or a draw from a large one. */
static void enter_supports(contest *c) {
    uint32_t m = c->cell->count, tries = c->config->supports;
    for (uint32_t i = 0; i < (m <= tries ? m : tries) && !c->best.good; i++) {
        if (m <= tries)
            enter_support(c, i);
        else
            enter_support(c, base_below(base_hash(c->config->seed, c->cell->path, i), m));
    }
}

/** Free cuts: a few, evenly chosen from all, so that one of them balances. */
static void enter_free_cuts(contest *c) {
    const split_fragment *items = c->work->set.items.data + c->cell->first;
    uint32_t all = 0, seen = 0, most = c->config->supports > 4 ? c->config->supports : 4;
    for (uint32_t i = 0; i < c->cell->count; i++) all += split_is_free(&c->work->set, items + i);
    for (uint32_t i = 0, next = 0; seen < all && !c->best.good; i++) {
        if (!split_is_free(&c->work->set, items + i)) continue;
        if (all <= most || seen >= (uint32_t)((2 * (uint64_t)next + 1) * all / (2 * most))) enter_support(c, i), next++;
        seen++;
    }
}

/** A plane through an edge of one polygon and a vertex of another: what balances the fan around a common
 * vertex, where every supporting plane has all others on one side. */
static void enter_edge(contest *c, uint64_t draw) {
    const split_set *set = &c->work->set;
    const froe_scene *scene = set->scene;
    const split_fragment *items = set->items.data + c->cell->first;
    uint32_t one = items[base_below(draw, c->cell->count)].object;
    uint32_t other = items[base_below(base_mix(draw + 1), c->cell->count)].object;
    if (scene_form(scene, one) != FROE_POLYGON || scene_form(scene, other) != FROE_POLYGON) return;
    uint32_t n = scene_corners(scene, one), i = base_below(base_mix(draw + 2), n);
    uint32_t j = base_below(base_mix(draw + 3), scene_corners(scene, other));
    froe_cut cut = {.kind = FROE_CUT_VERTICES};
    cut.id[0] = scene_corner(scene, one, i);
    cut.id[1] = scene_corner(scene, one, i + 1 < n ? i + 1 : 0);
    cut.id[2] = scene_corner(scene, other, j);
    if (cut.id[2] == cut.id[0] || cut.id[2] == cut.id[1]) return;
    enter_cut(c, &cut, split_view_count(&c->scratch->view, scene, &cut));
}

static void enter_edges(contest *c) {
    for (uint32_t i = 0; i < c->config->edges; i++)
        enter_edge(c, base_hash(c->config->seed, c->cell->path, 100000 + i));
}

static bool enter_axes(contest *c, size_t quantiles) {
    split_view *view = &c->scratch->view;
    for (int axis = 0; axis < c->work->set.scene->dim && !c->best.good; axis++) {
        if (!split_view_extents(view, &c->work->set, c->cell, axis)) return false;
        size_t n = view->values.count, tries = quantiles;
        if (tries > n) tries = n;
        for (size_t i = 0, last = n; i < tries; i++) {
            size_t at = (2 * i + 1) * n / (2 * tries);
            froe_cut cut = {.kind = FROE_CUT_AXIS, .axis = axis, .value = view->values.data[at]};
            if (!isfinite(cut.value) || (last < n && view->values.data[last] == cut.value)) continue;
            enter_cut(c, &cut, split_view_count_axis(view, cut.value));
            last = at;
        }
    }
    return true;
}

static uint32_t item_object(const contest *c, uint32_t i) {
    return c->work->set.items.data[c->cell->first + i].object;
}

static double centre_distance(const froe_scene *scene, uint32_t a, uint32_t b) {
    double lo[2][FROE_MAX_DIM], hi[2][FROE_MAX_DIM], square = 0;
    scene_object_bounds(scene, a, lo[0], hi[0]);
    scene_object_bounds(scene, b, lo[1], hi[1]);
    for (int k = 0; k < scene->dim; k++) {
        double d = 0.5 * lo[0][k] + 0.5 * hi[0][k] - (0.5 * lo[1][k] + 0.5 * hi[1][k]);
        square += d * d;
    }
    return square;
}

/** Planes between an object and the nearest of 1, 2, 4, ... 128 others. */
static void enter_separators(contest *c) {
    const froe_scene *scene = c->work->set.scene;
    uint32_t m = c->cell->count;
    for (uint64_t i = 0; i < SEPARATORS && scene->dim <= 3 && !c->best.good; i++) {
        uint64_t draw = base_hash(c->config->seed, c->cell->path, 200000 + i);
        uint32_t a = item_object(c, base_below(draw, m)), b = FROE_NONE;
        for (uint32_t t = 0; t < 1u << i % 8; t++) {
            uint32_t other = item_object(c, base_below(base_mix(draw + 1 + t), m));
            if (other == a || (b != FROE_NONE && centre_distance(scene, a, other) >= centre_distance(scene, a, b)))
                continue;
            b = other;
        }
        froe_cut cut;
        if (b != FROE_NONE && split_separate_pair(c->work, a, b, &c->scratch->separator, &cut))
            enter_cut(c, &cut, split_view_count(&c->scratch->view, scene, &cut));
    }
}

/** Planes of facets, drawn at random: of the box around an object, one that lies in the cell or not. */
static bool enter_facets(contest *c) {
    const froe_scene *scene = c->work->set.scene;
    for (uint32_t i = 0; i < c->config->supports && !c->best.good; i++) {
        uint64_t draw = base_hash(c->config->seed, c->cell->path, 300000 + i);
        double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
        int axis = (int)base_below(base_mix(draw + 1), (uint32_t)scene->dim);
        scene_object_bounds(scene, item_object(c, base_below(draw, c->cell->count)), lo, hi);
        froe_cut cut = {.kind = FROE_CUT_AXIS, .axis = axis, .value = (base_mix(draw + 2) & 1 ? hi : lo)[axis]};
        if (!split_view_extents(&c->scratch->view, &c->work->set, c->cell, axis)) return false;
        enter_cut(c, &cut, split_view_count_axis(&c->scratch->view, cut.value));
    }
    return true;
}

static bool solids_only(const contest *c) {
    uint32_t i = 0;
    while (i < c->cell->count && scene_form(c->work->set.scene, item_object(c, i)) >= FROE_BOX) i++;
    return i == c->cell->count;
}

/** A facet that separates something; complete for boxes. */
static bool any_facet(const contest *c, froe_cut *cut) {
    for (int k = 0; k < c->work->set.scene->dim && c->config->facets; k++) {
        double from, to;
        if (!split_axes_gap(&c->work->set, c->cell, k, &from, &to)) continue;
        *cut = (froe_cut){.kind = FROE_CUT_AXIS, .axis = k, .value = from};
        return true;
    }
    return false;
}

/** When no candidate separates anything: any plane that does. */
static split_verdict enter_any_separator(contest *c) {
    split_tally tally;
    froe_cut cut;
    split_verdict verdict = SPLIT_CUT;
    if (!any_facet(c, &cut)) verdict = split_separate(c->work, c->cell, &c->scratch->separator, &cut);
    if (verdict != SPLIT_CUT) return verdict;
    if (cell_tally(c->work, c->cell, &cut, &tally)) return SPLIT_MEMORY;
    enter_cut(c, &cut, tally);
    return SPLIT_CUT;
}

/** The cheapest of some cuts, unless none pays and the cell is crowded. */
static split_verdict choose_among_solids(contest *c, froe_cut *cut) {
    const split_refine *config = c->config;
    split_separator *separator = &c->scratch->separator;
    if (!split_separator_ready(&c->work->set, c->cell, separator)) return SPLIT_MEMORY;
    if (!c->cell->attempt && config->facets) {
        if (!enter_facets(c)) return SPLIT_MEMORY;
    } else if (!c->cell->attempt) {
        if (!enter_axes(c, config->quantiles > QUANTILES ? config->quantiles : QUANTILES)) return SPLIT_MEMORY;
        enter_separators(c);
    }
    split_verdict verdict = c->best.any ? SPLIT_CUT : enter_any_separator(c);
    if (verdict != SPLIT_CUT) return verdict;
    if (c->best.cost > 1 && config->copy > 0 && split_crowded(c->work, c->cell, separator)) return SPLIT_CROWDED;
    *cut = c->best.cut;
    return SPLIT_CUT;
}

/** A cut that certainly separates something, or the verdict that none exists. */
static split_verdict last_resort(contest *c, froe_cut *cut) {
    uint64_t draw = base_hash(c->config->seed, c->cell->path, 77);
    if (split_any_support(&c->work->set, c->cell, draw, cut)) return SPLIT_CUT;
    return split_separate(c->work, c->cell, &c->scratch->separator, cut);
}

/** Three vertices may lie on a line, which scores do not see. Exact. */
static bool is_plane(const contest *c, const froe_cut *cut) {
    if (cut->kind != FROE_CUT_VERTICES) return true;
    geom_plane plane = scene_cut_plane(c->work->set.scene, cut);
    return geom_plane_valid(&c->work->set.context, &plane);
}

split_verdict split_refine_choose(const split_refine *config, split_work *work, const split_cell *cell, froe_cut *cut) {
    contest c = {.config = config, .work = work, .scratch = work->scratch, .cell = cell};
    if (cell->count <= config->leaf) return SPLIT_LEAF;
    if (config->leaf && split_one_point(&work->set, cell)) return SPLIT_INSEPARABLE;
    c.solids = solids_only(&c);
    if (cell->attempt && !c.solids) return last_resort(&c, cut);
    if (!c.solids && config->supports == 1 && !config->quantiles && !config->free_cuts) return last_resort(&c, cut);
    const bool strict = split_balance_due(config, cell->depth, base_log2(cell->count));
    c.terms = (split_terms){config->weight, strict && cell->count > 4 ? 0.75 * cell->count : (double)INFINITY};
    if (!split_view_fill(&c.scratch->view, &work->set, cell, config->sample, config->seed)) return SPLIT_MEMORY;
    if (c.solids) return choose_among_solids(&c, cut);
    if (config->free_cuts) enter_free_cuts(&c);
    if (!c.best.any) {
        enter_supports(&c);
        if (config->quantiles && !enter_axes(&c, config->quantiles)) return SPLIT_MEMORY;
        if (strict && work->set.scene->dim == 3) enter_edges(&c);
    }
    if (!c.best.any || !is_plane(&c, &c.best.cut)) return last_resort(&c, cut);
    *cut = c.best.cut;
    return SPLIT_CUT;
}
