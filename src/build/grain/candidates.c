/* candidates.c: see candidates.h. Draws depend on the path of the cell, not on threads. */
#include "build/grain/candidates.h"
#include "base/random.h"
#include "build/grain/crossing.h"
#include <math.h>
#include <string.h>

/** A number below n > 0: the next of this cell's. */
static uint32_t draw_below(split_grain_search *s, uint32_t n) {
    return base_below(base_hash(s->config->seed, s->contest.cell->path, s->draws++), n);
}

static uint32_t drawn_object(split_grain_search *s) {
    const split_cell *cell = s->contest.cell;
    return s->contest.work->set.items.data[cell->first + draw_below(s, cell->count)].object;
}

bool split_grain_score(split_grain_search *s, split_candidate *k) {
    split_contest *c = &s->contest;
    split_view_plane plane;
    bool useful = split_contest_score(c, k, &plane);
    if (useful && k->cut.kind == FROE_CUT_OBJECT && k->tally.both) {
        k->due = c->view->weight * split_crossing_count(c->view, c->work->set.scene, k->cut.id[0], &plane);
        k->cost -= k->due;
    }
    return useful;
}

static void score_and_enter(split_grain_search *s, split_candidate k) {
    if (split_grain_score(s, &k)) split_contest_enter(&s->contest, &k);
}

void split_enter_supports(split_grain_search *s) {
    const split_contest *c = &s->contest;
    const split_fragment *items = c->work->set.items.data + c->cell->first;
    uint32_t m = c->cell->count, tries = m <= s->config->effort.supports ? m : s->config->effort.supports;
    for (uint32_t i = 0; i < tries && !c->done && !c->failed; i++) {
        froe_cut cut = scene_support_cut(c->work->set.scene, m <= tries ? items[i].object : drawn_object(s));
        /* segments askew in space are left to split_any_support() */
        if (cut.kind == FROE_CUT_AXIS || cut.kind == FROE_CUT_OBJECT) score_and_enter(s, (split_candidate){.cut = cut});
    }
}

void split_enter_axes(split_grain_search *s) {
    split_contest *c = &s->contest;
    const split_set *set = &c->work->set;
    for (int axis = 0; axis < set->scene->dim && !c->done && !c->failed; axis++) {
        split_candidate k = {.cut = {.kind = FROE_CUT_AXIS, .axis = axis}};
        uint32_t corner;
        c->failed |= !split_sweep_axis(s->sweep, set, c->view, c->price, &c->terms, axis, &corner);
        if (c->failed || corner == FROE_NONE) continue;
        k.cut.value = split_view_coordinate(c->view, set->scene, corner, axis);
        if (isfinite(k.cut.value)) score_and_enter(s, k);
    }
}

/* ------------------------------------------------------- through vertices -- */

/** The best plane through the axle and another vertex. False: there is none. */
static bool turn_about(split_grain_search *s, const uint32_t *axle, split_candidate *out) {
    split_contest *c = &s->contest;
    uint32_t v, last = (uint32_t)c->view->dim - 1;
    c->failed |= !split_sweep_pencil(s->sweep, &c->work->set, c->view, c->price, &c->terms, axle, &v);
    *out = (split_candidate){.cut = {.kind = FROE_CUT_VERTICES}};
    memcpy(out->cut.id, axle, last * sizeof *axle);
    out->cut.id[last] = v;
    return !c->failed && v != FROE_NONE && v != axle[0] && v != axle[last - 1] && split_grain_score(s, out);
}

/** Exchanges vertices of k, whose last is the best for the others, until none of them can be improved. */
static void improve(split_grain_search *s, split_candidate *k) {
    uint32_t failures = 0, last = (uint32_t)s->contest.view->dim - 1, *id = k->cut.id;
    for (uint32_t i = 1; i < s->config->effort.turns && failures < last && !s->contest.failed; i++) {
        split_candidate next;
        if (turn_about(s, id + 1, &next) && next.cost < k->cost) {
            *k = next;
            failures = 0;
        } else {
            uint32_t first = id[0];
            memmove(id, id + 1, last * sizeof first);
            id[last] = first;
            failures++;
        }
    }
}

void split_enter_through(split_grain_search *s) {
    split_contest *c = &s->contest;
    const froe_scene *scene = c->work->set.scene;
    for (uint32_t i = 0; i < s->config->effort.starts && !c->done && !c->failed; i++) {
        /* an edge of some object of the cell, in the plane an end of one */
        uint32_t object = drawn_object(s), n = scene_corners(scene, object), corner = draw_below(s, n);
        uint32_t axle[2] = {scene_corner(scene, object, corner),
                            scene_corner(scene, object, corner + 1 < n ? corner + 1 : 0)};
        split_candidate k;
        if ((n == 1 && scene->dim == 3) || !turn_about(s, axle, &k)) continue;
        improve(s, &k);
        split_contest_enter(c, &k);
    }
}
