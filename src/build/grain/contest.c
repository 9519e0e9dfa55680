/* contest.c: see contest.h. */
#include "build/grain/contest.h"
#include "build/grain/crossing.h"
#include "split/cell.h"

#define THIN 1e-5 /* triples thinner than this give no plane worth trying */

void split_contest_show(split_contest *c, uint32_t sample) {
    const split_set *set = &c->work->set;
    c->failed |= !split_facets_fill(c->facets, set, c->cell, sample, c->config->seed);
    c->room = c->facets->weight == 1 ? 1 : SPLIT_FINALISTS;
    c->count = 0;
    c->done = false;
}

bool split_contest_score(split_contest *c, split_candidate *k) {
    const froe_scene *scene = c->work->set.scene;
    split_facet_plane plane;
    if (k->kind == SPLIT_AXIS)
        plane = split_facets_axis(c->facets, k->axis, k->value);
    else if (!split_facets_plane(c->facets, scene, k->id, k->kind == SPLIT_SUPPORT ? 0 : THIN, &plane))
        return false;
    split_tally tally = split_facets_count(c->facets, &plane);
    k->due = 0;
    if (k->kind == SPLIT_SUPPORT && tally.both)
        k->due = c->facets->weight * split_crossing_count(c->facets, scene, k->object, &plane);
    k->cost = split_price_of(c->price, &c->terms, tally, c->facets->weight) - k->due;
    return split_tally_useful(tally);
}

/** Three vertices may lie on a line, which scores do not see. */
static bool is_plane(split_work *work, const froe_cut *cut) {
    if (cut->kind != FROE_CUT_VERTICES) return true;
    geom_plane plane = scene_cut_plane(work->set.scene, cut);
    return geom_plane_valid(&work->set.context, &plane);
}

/** Counts again, exactly. False: it separates nothing. */
static bool verify(split_contest *c, split_candidate *k, split_tally *tally) {
    froe_cut cut = split_candidate_cut(k);
    if (!is_plane(c->work, &cut)) return false;
    if (cell_tally(c->work, c->cell, &cut, tally)) c->failed = true;
    if (c->failed || !split_tally_useful(*tally)) return false;
    k->cost = split_price_of(c->price, &c->terms, *tally, 1) - k->due;
    return true;
}

/** Nothing is much better than a cut that makes only unavoidable splits and leaves at most 7/10 on a side. */
static bool hard_to_beat(split_tally t, double due) {
    uint64_t all = split_tally_all(t), larger = split_tally_larger(t);
    return t.both <= due && (all <= 4 || 10 * larger <= 7 * all);
}

static void insert(split_contest *c, const split_candidate *k) {
    uint32_t at = c->count < c->room ? c->count++ : c->room - 1;
    for (; at && c->best[at - 1].cost > k->cost; at--) c->best[at] = c->best[at - 1];
    c->best[at] = *k;
}

void split_contest_enter(split_contest *c, const split_candidate *candidate) {
    split_candidate k = *candidate;
    if (c->count == c->room && c->best[c->count - 1].cost <= k.cost) return;
    if (c->room == 1) {
        split_tally tally;
        if (!verify(c, &k, &tally) || (c->count && c->best[0].cost <= k.cost)) return;
        c->tally = tally;
        c->done = hard_to_beat(tally, k.due);
    }
    insert(c, &k);
}

froe_cut split_candidate_cut(const split_candidate *k) {
    if (k->kind == SPLIT_AXIS) return (froe_cut){.kind = FROE_CUT_AXIS, .axis = k->axis, .value = k->value};
    if (k->kind == SPLIT_SUPPORT) return (froe_cut){.kind = FROE_CUT_OBJECT, .id = {k->object}};
    return (froe_cut){.kind = FROE_CUT_VERTICES, .id = {k->id[0], k->id[1], k->id[2]}};
}
