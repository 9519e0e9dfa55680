/* contest.c: see contest.h. */
#include "split/contest.h"
#include "split/cell.h"

void split_contest_show(split_contest *c, uint32_t sample, uint64_t seed) {
    c->failed |= !split_view_fill(c->view, &c->work->set, c->cell, sample, seed, c->exact);
    c->room = c->exact && c->view->weight != 1 ? SPLIT_FINALISTS : 1;
    c->count = 0;
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
    return split_view_cut(c->view, c->work->set.scene, &k->cut, plane) &&
           split_contest_price(c, k, split_view_count(c->view, plane));
}

/** Counts again, exactly. False: it is no plane, for three vertices may lie on a line, or it separates nothing. */
static bool verify(split_contest *c, split_candidate *k) {
    num_context *context = &c->work->set.context;
    if (k->cut.kind == FROE_CUT_VERTICES) {
        geom_plane plane = scene_cut_plane(c->work->set.scene, &k->cut);
        if (!geom_plane_valid(context, &plane)) return false;
    }
    if (!c->exact) return true;
    if (cell_tally(c->work, c->cell, &k->cut, &k->tally)) c->failed = true;
    if (c->failed || !split_tally_useful(k->tally)) return false;
    k->cost = split_price_of(c->price, &c->terms, k->tally, 1) - k->due;
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
    if (c->room == 1) {
        if (!verify(c, &k) || (c->count && c->best[0].cost <= k.cost)) return;
        c->done = hard_to_beat(c, &k);
    }
    uint32_t at = c->count < c->room ? c->count++ : c->room - 1;
    for (; at && c->best[at - 1].cost > k.cost; at--) c->best[at] = c->best[at - 1];
    c->best[at] = k;
}
