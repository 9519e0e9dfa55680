/* contest.c: see contest.h. */
#include "split/score/contest.h"
#include "split/score/exact.h"
#include "split/score/mark.h"
#include <string.h>

void split_contest_show(split_contest *c, uint32_t sample, uint64_t seed, uint32_t checks) {
    c->failed |= !split_view_fill(c->view, &c->work->set, c->cell, sample, seed, c->exact);
    c->room = c->exact && c->view->weight != 1 ? SPLIT_FINALISTS : 1;
    c->count = 0;
    c->refuted = 0;
    c->checks = c->exact && c->room == 1 ? 0 : checks;
    c->done = false;
}

bool split_contest_price(const split_contest *c, split_candidate *k, split_tally tally) {
    k->due = 0;
    c->work->tests += c->view->count;
    k->tally = tally;
    k->cost =
        c->solids ? split_price_of_copies(tally, c->copy) : split_price_of(c->price, &c->terms, tally, c->view->weight);
    return split_tally_useful(tally);
}

bool split_contest_score(split_contest *c, split_candidate *k, split_view_plane *plane) {
    if (!split_view_cut(c->view, c->work->set.scene, &k->cut, plane)) return false;
    const bool support = k->cut.kind == FROE_CUT_OBJECT && c->view->marks;
    return split_contest_price(c, k,
                               support ? split_mark_count_support(c->view, &c->work->set, c->cell, k->cut.id[0], plane)
                                       : split_view_count(c->view, plane));
}

/* ------------------------------------------------------------------ checks -- */

/** The entry of a cut; where there is none yet, *known is false, and the entry NULL if there is no room. */
static split_checked *find_checked(const split_contest *c, const froe_cut *cut, bool *known) {
    split_view *v = c->view;
    split_checked new = {cut->kind, {cut->id[0]}, false};
    const int n = cut->kind == FROE_CUT_VERTICES ? v->dim : 1;
    for (int i = 1; i < n; i++) {
        int at = i;
        for (; at && new.id[at - 1] > cut->id[i]; at--) new.id[at] = new.id[at - 1];
        new.id[at] = cut->id[i];
    }
    *known = true;
    for (uint32_t i = 0; i < v->checked_count; i++)
        if (v->checked[i].kind == new.kind && !memcmp(v->checked[i].id, new.id, sizeof new.id)) return v->checked + i;
    *known = false;
    if (v->checked_count == SPLIT_CHECKED) return NULL;
    v->checked[v->checked_count] = new;
    return v->checked + v->checked_count++;
}

static bool is_plane_of_vertices(const froe_cut *cut) {
    return cut->kind == FROE_CUT_OBJECT || cut->kind == FROE_CUT_VERTICES;
}

/** Checks the fragments that seem to lie in the plane of a candidate that would be the best, and prices it again if
 * some do not. `classes`: exact ones, if they are known. False: it separates nothing. */
static bool check_flat(split_contest *c, split_candidate *k, const uint8_t *classes) {
    const uint32_t marks = c->view->marks;
    const uint64_t tests = c->work->tests;
    split_view_plane plane;
    const double due = k->due;
    if (!split_view_cut(c->view, c->work->set.scene, &k->cut, &plane)) return false;
    c->failed |= !split_mark(c->view, c->work, c->cell, &k->cut, &plane, classes);
    if (c->failed) return false;
    if (c->view->marks == marks || classes) return true;
    const bool useful = split_contest_score(c, k, &plane);
    c->work->tests = tests; /* the candidate has been counted as one */
    if (!useful) return false;
    k->due = due;
    k->cost -= due;
    return true;
}

/** Prices a candidate by its exact count. False: it separates nothing. */
static bool price_exactly(split_contest *c, split_candidate *k) {
    split_tally tally;
    c->failed |= !split_exact_tally(c->view, c->work, c->cell, &k->cut, &tally);
    if (c->failed || !split_tally_useful(tally)) return false;
    k->tally = tally;
    k->cost = split_price_of(c->price, &c->terms, tally, 1) - k->due;
    return true;
}

/** Of candidates that are not counted exactly. Where walls are flat only up to a rounding, rings of vertices are, too:
 * they are met by planes that hold none of the pieces. So there what would be the best is counted. */
static bool doubt(split_contest *c, split_candidate *k) {
    bool known;
    const bool near = c->view->marks && !c->exact && c->view->weight == 1 && !c->view->pairs;
    if (!is_plane_of_vertices(&k->cut) || !c->checks || (k->tally.on < 2 && !near)) return true;
    if (c->count && c->best->cost <= k->cost) return true;
    (void)find_checked(c, &k->cut, &known);
    if (known) return true;
    c->checks--;
    if (k->tally.on > 1 && !check_flat(c, k, NULL)) return false;
    return near ? price_exactly(c, k) : true;
}

/** Counts again, exactly. False: it is no plane, for three vertices may lie on a line, or it separates nothing, or it
 * was counted before: then it is no better than the best. */
static bool verify(split_contest *c, split_candidate *k) {
    num_context *context = &c->work->set.context;
    split_checked *checked = NULL;
    bool known = false;
    if (c->exact && is_plane_of_vertices(&k->cut)) checked = find_checked(c, &k->cut, &known);
    if (known) {
        c->refuted += checked->refuted;
        return false;
    }
    if (k->cut.kind == FROE_CUT_VERTICES) {
        geom_plane plane = scene_cut_plane(c->work->set.scene, &k->cut);
        if (!geom_plane_valid(context, &plane)) return false;
    }
    if (!c->exact) return true;
    const uint32_t flat = k->tally.on;
    c->failed |= !split_exact_tally(c->view, c->work, c->cell, &k->cut, &k->tally);
    if (c->failed) return false;
    if (flat > 1 && k->tally.on < flat && !c->deceived && !check_flat(c, k, c->work->set.classes.data)) return false;
    if (!split_tally_useful(k->tally)) return false;
    const double seemed = k->cost;
    k->cost = split_price_of(c->price, &c->terms, k->tally, 1) - k->due;
    c->refuted += k->cost > seemed;
    if (checked) checked->refuted = k->cost > seemed;
    return true;
}

/** Nothing is much better than a cut that makes only unavoidable splits and leaves at most 7/10 on a side, or any of at
 * most four fragments. Where the fewest pieces are not sought, 3/4 of those beside it will do. */
static bool hard_to_beat(const split_contest *c, const split_candidate *k) {
    const split_tally t = k->tally;
    uint64_t all = split_tally_all(t), beside = all - t.on, larger = split_tally_larger(t);
    return t.both <= k->due && (c->exact ? all <= 4 || 10 * larger <= 7 * all : 4 * larger <= 3 * beside + 2);
}

void split_contest_enter(split_contest *c, const split_candidate *candidate) {
    split_candidate k = *candidate;
    if (c->count == c->room && c->best[c->count - 1].cost <= k.cost) return;
    if (!doubt(c, &k) || (c->count == c->room && c->best[c->count - 1].cost <= k.cost)) return;
    if (c->room == 1) {
        if (!verify(c, &k) || (c->count && c->best[0].cost <= k.cost)) return;
        c->done = hard_to_beat(c, &k);
    }
    uint32_t at = c->count < c->room ? c->count++ : c->room - 1;
    for (; at && c->best[at - 1].cost > k.cost; at--) c->best[at] = c->best[at - 1];
    c->best[at] = k;
}
