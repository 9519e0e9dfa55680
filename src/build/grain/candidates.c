/* candidates.c: see candidates.h. Draws depend on the path of the cell, not on threads. */
#include "build/grain/candidates.h"
#include "base/random.h"
#include "build/grain/crossing.h"
#include <math.h>
#include <string.h>

#define TINY 0x1p-40 /* sweeps round directions to 40 bits */
enum { TRIES = 64 };

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
        uint32_t vertex;
        c->failed |= !split_sweep_axis(s->sweep, set, c->view, c->price, &c->terms, axis, &vertex);
        if (c->failed || vertex == FROE_NONE) continue;
        k.cut.value = scene_vertex(set->scene, vertex)[axis];
        score_and_enter(s, k);
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

void split_enter_through(split_grain_search *s) {
    split_contest *c = &s->contest;
    const froe_scene *scene = c->work->set.scene;
    for (uint32_t i = 0; i < s->config->effort.starts && !c->done && !c->failed; i++) {
        uint32_t axle[2] = {FROE_NONE, FROE_NONE}, tries = 0, n = 0;
        while (tries++ < TRIES && (n = draw_axle(s, axle), tiny(c->view, scene, axle))) continue;
        split_candidate k;
        if ((n == 1 && scene->dim == 3) || !turn_about(s, axle, &k)) continue;
        improve(s, &k);
        split_contest_enter(c, &k);
    }
}
