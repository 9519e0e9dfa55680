/* candidates.c: see candidates.h. Draws depend on the path of the cell, not on threads. */
#include "build/grain/candidates.h"
#include "base/random.h"
#include "build/grain/crossing.h"
#include <math.h>
#include <string.h>

#define TINY 0x1p-40 /* sweeps round directions to 40 bits */
enum { TRIES = 64, HOPES = 2 };
enum { ALL, FEW }; /* parts of the view */
/* Starts: judged on all after they were the best of a few fragments; kept for where no cut is good. */
enum { AGAIN = 8, KEPT = 24 };

/** A number below n > 0: the next of this cell's. */
static uint32_t draw_below(split_grain_search *s, uint32_t n) {
    return base_below(base_hash(s->config->seed, s->contest.cell->path, s->draws++), n);
}

static uint32_t drawn_object(split_grain_search *s) {
    const split_cell *cell = s->contest.cell;
    return s->contest.work->set.items.data[cell->first + draw_below(s, cell->count)].object;
}

void split_grain_begin(split_grain_search *s) {
    const split_contest *c = &s->contest;
    for (int part = ALL; part <= FEW; part++) {
        const split_view_part of = split_view_part_of(c->view, part == FEW);
        s->prices[part] = split_prices_of(c->price, &c->terms, of.count, of.weight);
    }
    split_pencils_begin(&s->notes->pencils);
}

/** Takes the splits that are due off the price of a supporting plane, which has just been counted. */
static void spare_due(split_grain_search *s, split_candidate *k, const split_view_plane *plane) {
    const split_contest *c = &s->contest;
    if (k->cut.kind != FROE_CUT_OBJECT || !k->tally.both) return;
    k->due = c->view->weight * split_crossing_count(c->view, c->work->set.scene, k->cut.id[0], plane);
    k->cost -= k->due;
}

bool split_grain_score(split_grain_search *s, split_candidate *k) {
    split_view_plane plane;
    const bool useful = split_contest_score(&s->contest, k, &plane);
    if (useful) spare_due(s, k, &plane);
    return useful;
}

static void score_and_enter(split_grain_search *s, split_candidate k) {
    if (split_grain_score(s, &k)) split_contest_enter(&s->contest, &k);
}

/** Would it leave at most 7/10 on a side? */
static bool balanced(const split_candidate *k) {
    return 10 * (uint64_t)split_tally_larger(k->tally) <= 7 * (uint64_t)split_tally_all(k->tally);
}

/** Counting crossings is dear, and vain where objects do not cross. So only planes that split nothing take part at
 * once, and those that may end the contest if their splits are due, unless HOPES of them were not. */
static void enter_support(split_grain_search *s, uint32_t object, uint32_t *hopes) {
    split_contest *c = &s->contest;
    split_candidate k = {.cut = scene_support_cut(c->work->set.scene, object)};
    split_view_plane plane;
    /* segments askew in space are left to split_any_support() */
    if ((k.cut.kind != FROE_CUT_AXIS && k.cut.kind != FROE_CUT_OBJECT) || !split_contest_score(c, &k, &plane)) return;
    const bool hope = *hopes && balanced(&k);
    if (k.tally.both && !hope && s->notes->later_count < SPLIT_LATER) {
        s->notes->later[s->notes->later_count++] = k;
        return;
    }
    if (k.tally.both) spare_due(s, &k, &plane);
    *hopes -= hope && k.tally.both && k.due == 0;
    split_contest_enter(c, &k);
}

void split_enter_supports(split_grain_search *s) {
    const split_contest *c = &s->contest;
    const split_fragment *items = c->work->set.items.data + c->cell->first;
    uint32_t m = c->cell->count, tries = m <= s->config->effort.supports ? m : s->config->effort.supports;
    uint32_t hopes = HOPES;
    s->notes->later_count = 0;
    for (uint32_t i = 0; i < tries && !c->done && !c->failed; i++)
        enter_support(s, m <= tries ? items[i].object : drawn_object(s), &hopes);
}

void split_enter_late_supports(split_grain_search *s) {
    const split_contest *c = &s->contest;
    for (uint32_t i = 0; i < s->notes->later_count && !c->done && !c->failed; i++) {
        const split_candidate *k = s->notes->later + i;
        const double least = k->cost - c->view->weight * k->tally.both; /* if all of its splits were due */
        if (c->count < c->room || least < c->best[c->count - 1].cost) score_and_enter(s, *k);
    }
    s->notes->later_count = 0;
}

void split_enter_axes(split_grain_search *s) {
    split_contest *c = &s->contest;
    const split_set *set = &c->work->set;
    for (int axis = 0; axis < set->scene->dim && !c->done && !c->failed; axis++) {
        split_candidate k = {.cut = {.kind = FROE_CUT_AXIS, .axis = axis}};
        split_sweep_best best;
        c->failed |= !split_sweep_axis(s->sweep, set, c->view, &s->prices[ALL], axis, &best);
        if (c->failed || best.vertex == FROE_NONE) continue;
        k.cut.value = scene_vertex(set->scene, best.vertex)[axis];
        score_and_enter(s, k);
    }
}

/* ------------------------------------------------------- through vertices -- */

static split_axle axle_of(const split_view *view, const uint32_t *axle, int part) {
    return split_axle_of(axle[0], axle[view->dim - 2], part == FEW);
}

/** The best of a pencil that costs less than the limit; where it was swept before, as it was found then. */
static split_sweep_best best_of_pencil(split_grain_search *s, int part, const uint32_t *axle, double limit) {
    split_contest *c = &s->contest;
    split_pencil *p = split_pencil_at(&s->notes->pencils, axle_of(c->view, axle, part));
    split_sweep_best best;
    if (p && p->limit >= limit && p->marks == c->view->marks) {
        best = p->best;
        if (!(best.cost < limit)) best.vertex = FROE_NONE;
        return best;
    }
    const split_view_part of = split_view_part_of(c->view, part == FEW); /* marks may have added vertices */
    c->work->tests += of.count;
    c->failed |= !split_sweep_pencil(s->sweep, &c->work->set, c->view, &of, &s->prices[part], axle, limit, &best);
    if (p) p->limit = limit, p->marks = c->view->marks, p->best = best;
    return best;
}

/** The best plane through the axle and another vertex, if it costs less than the limit. False: there is none. */
static bool turn_about(split_grain_search *s, int part, const uint32_t *axle, double limit, split_start *out) {
    const split_contest *c = &s->contest;
    const uint32_t last = (uint32_t)c->view->dim - 1;
    split_view_plane plane;
    const split_sweep_best best = best_of_pencil(s, part, axle, limit);
    if (c->failed || best.vertex == FROE_NONE || best.vertex == axle[0] || best.vertex == axle[last - 1]) return false;
    *out = (split_start){{.cut = {.kind = FROE_CUT_VERTICES}, .cost = best.cost, .tally = best.tally}, c->view->marks};
    memcpy(out->k.cut.id, axle, last * sizeof *axle);
    out->k.cut.id[last] = best.vertex;
    return split_view_cut(c->view, c->work->set.scene, &out->k.cut, &plane);
}

/** Exchanges vertices of a plane, whose last is the best for the others, until none of them can be improved. */
static void improve(split_grain_search *s, split_start *at) {
    uint32_t failures = 0, last = (uint32_t)s->contest.view->dim - 1, *id = at->k.cut.id;
    for (uint32_t i = 1; i < s->config->effort.turns && failures < last && !s->contest.failed; i++) {
        split_start next;
        if (turn_about(s, ALL, id + 1, at->k.cost, &next)) {
            *at = next;
            failures = 0;
        } else {
            uint32_t first = id[0];
            memmove(id, id + 1, last * sizeof first);
            id[last] = first;
            failures++;
        }
    }
}

/** An edge of some object of the cell, in the plane an end of one; returns the corners of the object. */
static uint32_t draw_axle(split_grain_search *s, uint32_t *axle) {
    const froe_scene *scene = s->contest.work->set.scene;
    uint32_t object = drawn_object(s), n = scene_corners(scene, object), corner = draw_below(s, n);
    axle[0] = scene_corner(scene, object, corner);
    axle[1] = scene_corner(scene, object, corner + 1 < n ? corner + 1 : 0);
    return n;
}

/** Is it so short beside the cell that doubles cannot tell the planes through it from those through its neighbours?
 * Where objects shrink geometrically towards a point, so are nearly all. */
static bool tiny(const split_view *view, const froe_scene *scene, const uint32_t *axle) {
    double p[3], q[3], square = 0;
    if (scene->dim < 3) return false;
    split_view_local(view, scene_vertex(scene, axle[0]), p);
    split_view_local(view, scene_vertex(scene, axle[1]), q);
    for (int k = 0; k < 3; k++) square += (q[k] - p[k]) * (q[k] - p[k]);
    return square < TINY * TINY;
}

/** Keeps a start if it is among the cheapest so far, in order. */
static void keep_start(split_start *kept, uint32_t *count, uint32_t most, const split_start *k) {
    if (*count == most && kept[most - 1].k.cost <= k->k.cost) return;
    uint32_t at = *count < most ? (*count)++ : most - 1;
    for (; at && kept[at - 1].k.cost > k->k.cost; at--) kept[at] = kept[at - 1];
    kept[at] = *k;
}

/** A plane that might end the contest takes part at once. */
static void try_early(split_grain_search *s, const split_start *k) {
    if (!k->k.tally.both && balanced(&k->k)) score_and_enter(s, k->k);
}

/** Was the axle drawn before? In small cells most are. */
static bool drawn_before(split_grain_search *s, const uint32_t *axle, int part) {
    const split_pencil *p = split_pencil_at(&s->notes->pencils, axle_of(s->contest.view, axle, part));
    return p && p->limit > (double)-INFINITY;
}

/** Draws starts, judged on a part of the view. */
static uint32_t draw_starts(split_grain_search *s, int part, split_start *kept, uint32_t most) {
    split_contest *c = &s->contest;
    const froe_scene *scene = c->work->set.scene;
    uint32_t count = 0;
    for (uint32_t i = 0; i < s->config->effort.starts && !c->done && !c->failed; i++) {
        uint32_t axle[2] = {FROE_NONE, FROE_NONE}, tries = 0, n = 0;
        while (tries++ < TRIES && (n = draw_axle(s, axle), tiny(c->view, scene, axle))) continue;
        split_start k;
        const double limit = count == most ? kept[most - 1].k.cost : (double)INFINITY;
        if (scene->dim == 2) axle[1] = axle[0];
        if ((n == 1 && scene->dim == 3) || drawn_before(s, axle, part) || !turn_about(s, part, axle, limit, &k))
            continue;
        if (part == ALL) try_early(s, &k);
        keep_start(kept, &count, most, &k);
    }
    return count;
}

/** More starts are worth improving where walls deceive, or no cut so far is worth its splits. */
static bool no_good_cut(const split_grain_search *s) {
    const split_contest *c = &s->contest;
    return c->view->marks || !c->count || c->best->cost > 0;
}

void split_enter_through(split_grain_search *s) {
    split_contest *c = &s->contest;
    split_start *drawn = s->notes->drawn, *kept = s->notes->kept;
    const uint32_t improved = s->config->effort.improved, more = improved > KEPT ? improved : KEPT;
    const bool few = c->view->count > SPLIT_VIEW_FEW;
    uint32_t count = draw_starts(s, few ? FEW : ALL, few ? drawn : kept, more);
    if (few) {
        const uint32_t again = count;
        count = 0;
        for (uint32_t i = 0; i < again && (i < AGAIN || i < improved || no_good_cut(s)) && !c->done && !c->failed;
             i++) {
            split_start k;
            if (!turn_about(s, ALL, drawn[i].k.cut.id, INFINITY, &k)) continue;
            try_early(s, &k);
            keep_start(kept, &count, more, &k);
        }
    }
    const uint32_t before = c->refuted;
    for (uint32_t i = 0; i < count && (i < improved + c->refuted - before || no_good_cut(s)); i++) {
        if (c->done || c->failed) break;
        split_start k = kept[i];
        if (k.marks != c->view->marks && !turn_about(s, ALL, kept[i].k.cut.id, INFINITY, &k)) continue;
        improve(s, &k);
        score_and_enter(s, k.k);
    }
    if (c->view->marks && !c->done && !c->failed) {
        split_enter_late_supports(s);
        split_enter_supports(s);
    }
}
