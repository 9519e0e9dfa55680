/* refine.c: the cut of a cell, the best of its candidates. */
#include "split/refine.h"
#include "base/log2.h"
#include "base/random.h"
#include "split/cell.h"
#include "split/fallback.h"
#include "split/finish/finish.h"
#include "split/score/contest.h"
#include <math.h>
#include <string.h>

/* Candidates in cells of solids: ends of extents an axis, planes between pairs. */
enum { QUANTILES = 10, SEPARATORS = 32, FAR_OBJECTS = 32 };

uint32_t split_refine_candidates(const split_refine *config, const froe_scene *scene) {
    const uint32_t dim = (uint32_t)scene->dim, supports = config->supports > 4 ? config->supports : 4;
    const uint32_t edges = dim == 3 ? config->edges : 0;
    const uint32_t quantiles = config->quantiles > QUANTILES ? config->quantiles : QUANTILES;
    bool solids = false;
    for (uint32_t i = 0; i < scene->object_count && !solids; i++) solids = scene_form(scene, i) >= FROE_BOX;
    const uint32_t cut = 2 * supports + dim * config->quantiles + edges; /* free cuts may be scored before supports */
    const uint32_t listed = dim * quantiles + SEPARATORS;
    return 4 + (solids && listed > cut ? listed : cut);
}

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

/** The search for the cut of one cell: a contest of what the options say. */
typedef struct refine_search {
    split_contest contest;
    const split_refine *config;
    split_scratch *scratch;
    const split_set *set;
    const split_cell *cell;
} refine_search;

static uint64_t draw_of(const refine_search *s, uint64_t i) {
    return base_hash(s->config->seed, s->cell->path, i);
}

static uint32_t object_of(const refine_search *s, uint32_t i) {
    return s->set->items.data[s->cell->first + i].object;
}

/** With the count of the cut in what is shown, or NULL. */
static void enter_cut(refine_search *s, const froe_cut *cut, const split_tally *tally) {
    split_separator *separator = &s->scratch->separator;
    split_candidate k = {.cut = *cut}, *best = s->contest.best;
    split_view_plane plane;
    if (!(tally ? split_contest_price(&s->contest, &k, *tally) : split_contest_score(&s->contest, &k, &plane))) return;
    split_contest_enter(&s->contest, &k);
    if (best->cut.normal != separator->rows) return;
    const size_t rows = cut->kind == FROE_CUT_FINE ? cut->id[0] : 1, width = (size_t)s->set->scene->dim + 1;
    memcpy(separator->best, separator->rows, rows * width * sizeof *separator->rows);
    best->cut.normal = separator->best;
}

static void enter_support(refine_search *s, uint32_t item) {
    froe_cut cut = s->set->scene->dim <= 3 ? scene_support_cut(s->set->scene, object_of(s, item)) : (froe_cut){0};
    if (cut.kind != FROE_CUT_NONE) enter_cut(s, &cut, NULL);
}

/** Planes through an edge of one polygon and a vertex of another: what balances the fan around a common
 * vertex, where every supporting plane has all others on one side. */
static void enter_edges(refine_search *s) {
    const froe_scene *scene = s->set->scene;
    for (uint32_t i = 0; i < s->config->edges; i++) {
        uint64_t draw = draw_of(s, 100000 + i);
        uint32_t one = object_of(s, base_below(draw, s->cell->count));
        uint32_t other = object_of(s, base_below(base_mix(draw + 1), s->cell->count));
        if (scene_form(scene, one) != FROE_POLYGON || scene_form(scene, other) != FROE_POLYGON) continue;
        uint32_t n = scene_corners(scene, one), corner = base_below(base_mix(draw + 2), n);
        uint32_t third = base_below(base_mix(draw + 3), scene_corners(scene, other));
        froe_cut cut = {.kind = FROE_CUT_VERTICES};
        cut.id[0] = scene_corner(scene, one, corner);
        cut.id[1] = scene_corner(scene, one, corner + 1 < n ? corner + 1 : 0);
        cut.id[2] = scene_corner(scene, other, third);
        if (cut.id[2] != cut.id[0] && cut.id[2] != cut.id[1]) enter_cut(s, &cut, NULL);
    }
}

/** Planes through an edge of an object and an outermost vertex of the scene, in the plane lines through a vertex and
 * one: they run across walls that are flat only up to a rounding, where no other plane may do. As tests they are not
 * counted, so that trials go as those of a scene without such walls. */
static void enter_across(refine_search *s) {
    const froe_scene *scene = s->set->scene;
    const uint64_t tests = s->contest.work->tests;
    split_view *view = &s->scratch->view;
    const uint32_t last = (uint32_t)scene->dim - 1;
    split_view_find_outermost(view, scene);
    for (uint32_t i = 0; i < 2 * s->config->supports && !s->contest.done && !s->contest.failed; i++) {
        uint64_t draw = draw_of(s, 400000 + i);
        uint32_t object = object_of(s, base_below(draw, s->cell->count)), n = scene_corners(scene, object);
        uint32_t corner = base_below(base_mix(draw + 1), n);
        froe_cut cut = {.kind = FROE_CUT_VERTICES};
        cut.id[0] = scene_corner(scene, object, corner);
        if (last > 1) cut.id[1] = scene_corner(scene, object, corner + 1 < n ? corner + 1 : 0);
        cut.id[last] = view->outermost[base_below(base_mix(draw + 2), view->outermost_count)];
        if (n > 1 && cut.id[last] != cut.id[0] && cut.id[last] != cut.id[last - 1]) enter_cut(s, &cut, NULL);
    }
    s->contest.work->tests = tests;
}

static void enter_axes(refine_search *s, size_t quantiles) {
    split_view *view = &s->scratch->view;
    for (int axis = 0; axis < s->set->scene->dim && !s->contest.done && !s->contest.failed; axis++) {
        s->contest.failed |= !split_view_extents(view, s->set, s->cell, axis);
        size_t n = view->values.count, tries = quantiles < n ? quantiles : n;
        for (size_t i = 0, last = n; i < tries && !s->contest.failed; i++) {
            size_t at = (2 * i + 1) * n / (2 * tries);
            froe_cut cut = {.kind = FROE_CUT_AXIS, .axis = axis, .value = view->values.data[at]};
            if (!isfinite(cut.value) || (last < n && view->values.data[last] == cut.value)) continue;
            split_tally tally = split_view_count_axis(view, cut.value);
            enter_cut(s, &cut, &tally);
            last = at;
        }
    }
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

/** With its exact count: above dimension 3 nothing is shown. */
static void enter_counted(refine_search *s, const froe_cut *cut) {
    split_tally tally;
    if (cell_tally(s->contest.work, s->cell, cut, &tally))
        s->contest.failed = true;
    else
        enter_cut(s, cut, &tally);
}

/** Planes between an object and the nearest of 1, 2, 4, ... 128 others. */
static void enter_separators(refine_search *s) {
    const froe_scene *scene = s->set->scene;
    uint32_t m = s->cell->count;
    const bool far = scene->dim > 3;
    if (far && m > FAR_OBJECTS) return;
    for (uint64_t i = 0; i < SEPARATORS && !s->contest.done && !s->contest.failed; i++) {
        uint64_t draw = draw_of(s, 200000 + i);
        uint32_t a = object_of(s, base_below(draw, m)), b = FROE_NONE;
        for (uint32_t t = 0; t < 1u << i % 8 && !(far && t >= m); t++) {
            uint32_t other = object_of(s, base_below(base_mix(draw + 1 + t), m));
            if (other == a || (b != FROE_NONE && centre_distance(scene, a, other) >= centre_distance(scene, a, b)))
                continue;
            b = other;
        }
        froe_cut cut;
        if (b == FROE_NONE || !split_separate_pair(s->contest.work, a, b, &s->scratch->separator, &cut)) continue;
        far ? enter_counted(s, &cut) : enter_cut(s, &cut, NULL);
    }
}

/** Planes of facets, drawn at random: of the box around an object, one that lies in the cell or not. */
static void enter_facets(refine_search *s) {
    const froe_scene *scene = s->set->scene;
    split_view *view = &s->scratch->view;
    for (uint32_t i = 0; i < s->config->supports && !s->contest.done && !s->contest.failed; i++) {
        uint64_t draw = draw_of(s, 300000 + i);
        double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
        int axis = (int)base_below(base_mix(draw + 1), (uint32_t)scene->dim);
        scene_object_bounds(scene, object_of(s, base_below(draw, s->cell->count)), lo, hi);
        froe_cut cut = {.kind = FROE_CUT_AXIS, .axis = axis, .value = (base_mix(draw + 2) & 1 ? hi : lo)[axis]};
        s->contest.failed |= !split_view_extents(view, s->set, s->cell, axis);
        if (s->contest.failed) return;
        split_tally tally = split_view_count_axis(view, cut.value);
        enter_cut(s, &cut, &tally);
    }
}

/** When no candidate separates anything: any plane that does. Facets are complete for boxes. */
static split_verdict enter_any_separator(refine_search *s) {
    froe_cut cut;
    split_verdict verdict = SPLIT_INSEPARABLE;
    for (int k = 0; k < s->set->scene->dim && s->config->facets && verdict != SPLIT_CUT; k++) {
        double from, to;
        if (!split_axes_gap(s->set, s->cell, k, &from, &to)) continue;
        cut = (froe_cut){.kind = FROE_CUT_AXIS, .axis = k, .value = from};
        verdict = SPLIT_CUT;
    }
    if (verdict != SPLIT_CUT) verdict = split_separate(s->contest.work, s->cell, &s->scratch->separator, &cut);
    if (verdict != SPLIT_CUT) return verdict;
    enter_counted(s, &cut);
    return s->contest.failed ? SPLIT_MEMORY : SPLIT_CUT;
}

/** The cheapest of some cuts, unless none pays and the cell is crowded. */
static split_verdict choose_among_solids(refine_search *s, froe_cut *cut) {
    const split_refine *config = s->config;
    const split_contest *c = &s->contest;
    split_separator *separator = &s->scratch->separator;
    if (!split_separator_ready(s->set, s->cell, separator)) return SPLIT_MEMORY;
    if (!s->cell->attempt && config->facets) {
        enter_facets(s);
    } else if (!s->cell->attempt) {
        enter_axes(s, config->quantiles > QUANTILES ? config->quantiles : QUANTILES);
        if (!c->failed) enter_separators(s);
    }
    if (c->failed) return SPLIT_MEMORY;
    split_verdict verdict = c->count ? SPLIT_CUT : enter_any_separator(s);
    if (verdict != SPLIT_CUT) return verdict;
    if (c->best->cost > 1 && config->copy > 0 && split_crowded(c->work, s->cell, separator)) return SPLIT_CROWDED;
    *cut = c->best->cut;
    return SPLIT_CUT;
}

/** A cut that certainly separates something, or the verdict that none exists. */
static split_verdict last_resort(refine_search *s, froe_cut *cut) {
    if (split_any_support(s->set, s->cell, draw_of(s, 77), cut)) return SPLIT_CUT;
    return split_separate(s->contest.work, s->cell, &s->scratch->separator, cut);
}

split_verdict split_refine_choose(const split_refine *config, split_work *work, const split_cell *cell, froe_cut *cut) {
    const uint32_t m = cell->count, tries = m <= config->supports ? m : config->supports;
    split_scratch *scratch = work->scratch;
    refine_search s = {.config = config, .scratch = scratch, .set = &work->set, .cell = cell};
    s.contest = (split_contest){.work = work,
                                .cell = cell,
                                .view = &scratch->view,
                                .price = &scratch->price,
                                .copy = config->copy,
                                .solids = true};
    if (m <= config->leaf) return SPLIT_LEAF;
    if (config->leaf && split_one_point(&work->set, cell)) return SPLIT_INSEPARABLE;
    for (uint32_t i = 0; i < m && s.contest.solids; i++)
        s.contest.solids = scene_form(work->set.scene, object_of(&s, i)) >= FROE_BOX;
    bool single = cell->plain || (config->supports == 1 && !config->quantiles && !config->free_cuts);
    if (!s.contest.solids && (cell->attempt || single)) return last_resort(&s, cut);
    const bool strict = split_balance_due(config, cell->depth, base_log2(m));
    s.contest.terms = (split_terms){config->weight, strict && m > 4 ? 0.75 * m : (double)INFINITY};
    split_contest_show(&s.contest, config->sample, config->seed, config->checks);
    if (s.contest.failed) return SPLIT_MEMORY;
    if (s.contest.solids) return choose_among_solids(&s, cut);
    if (config->free_cuts) {
        /* free cuts: a few, evenly chosen from all, so that one of them balances */
        const split_fragment *items = s.set->items.data + s.cell->first;
        uint32_t all = 0, seen = 0, most = s.config->supports > 4 ? s.config->supports : 4;
        for (uint32_t i = 0; i < s.cell->count; i++) all += split_is_free(s.set, items + i);
        for (uint32_t i = 0, next = 0; seen < all && !s.contest.done; i++) {
            if (!split_is_free(s.set, items + i)) continue;
            if (all <= most || seen >= (uint32_t)((2 * (uint64_t)next + 1) * all / (2 * most)))
                enter_support(&s, i), next++;
            seen++;
        }
    }
    if (!s.contest.count) {
        /* all fragments of a small cell, or a draw from a large one */
        for (uint32_t i = 0; i < tries && !s.contest.done; i++)
            enter_support(&s, m <= tries ? i : base_below(draw_of(&s, i), m));
        if (config->quantiles) enter_axes(&s, config->quantiles);
        if (strict && work->set.scene->dim == 3 && !s.contest.failed) enter_edges(&s);
        if (scratch->view.marks) enter_across(&s);
    }
    if (s.contest.failed) return SPLIT_MEMORY;
    if (!s.contest.count) return last_resort(&s, cut);
    *cut = s.contest.best->cut;
    return SPLIT_CUT;
}
