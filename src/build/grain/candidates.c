/* candidates.c: see candidates.h. Draws depend on the path of the cell, not on threads. */
#include "build/grain/candidates.h"
#include <math.h>
#include <string.h>

static uint32_t drawn_object(split_contest *c) {
    return c->work->set.items.data[c->cell->first + split_draw(c, c->cell->count)].object;
}

static void score_and_enter(split_contest *c, split_candidate k) {
    if (split_contest_score(c, &k)) split_contest_enter(c, &k);
}

/* --------------------------------------------------------------- supports -- */

static void enter_support(split_contest *c, uint32_t object) {
    const froe_scene *scene = c->work->set.scene;
    froe_cut cut = scene_support_cut(scene, object);
    split_candidate k = {.kind = SPLIT_SUPPORT, .object = object};
    if (cut.kind == FROE_CUT_AXIS) {
        k.kind = SPLIT_AXIS;
        k.axis = cut.axis;
        k.value = cut.value;
    } else if (cut.kind == FROE_CUT_OBJECT) {
        for (uint32_t i = 0; i < (uint32_t)scene->dim; i++) k.id[i] = scene_corner(scene, object, i);
    } else {
        return; /* a segment askew in space: left to split_any_support() */
    }
    score_and_enter(c, k);
}

void split_enter_supports(split_contest *c) {
    const split_fragment *items = c->work->set.items.data + c->cell->first;
    uint32_t m = c->cell->count, tries = c->config->effort.supports;
    for (uint32_t i = 0; i < (m <= tries ? m : tries) && !c->done && !c->failed; i++)
        enter_support(c, m <= tries ? items[i].object : drawn_object(c));
}

/* ------------------------------------------------------------------- axes -- */

void split_enter_axes(split_contest *c) {
    for (int axis = 0; axis < c->work->set.scene->dim && !c->done && !c->failed; axis++) {
        split_candidate k = {.kind = SPLIT_AXIS, .axis = axis};
        uint32_t corner;
        c->failed |= !split_sweep_axis(c->sweep, &c->work->set, c->facets, c->price, &c->terms, axis, &corner);
        if (c->failed || corner == FROE_NONE) continue;
        k.value = split_facets_coordinate(c->facets, c->work->set.scene, corner, axis);
        if (isfinite(k.value)) score_and_enter(c, k);
    }
}

/* ------------------------------------------------------- through vertices -- */

/** An edge of some object of the cell, in the plane an end of one; false: it has none. */
static bool drawn_axle(split_contest *c, uint32_t axle[2]) {
    const froe_scene *scene = c->work->set.scene;
    uint32_t object = drawn_object(c), n = scene_corners(scene, object), i = split_draw(c, n);
    axle[0] = scene_corner(scene, object, i);
    axle[1] = scene_corner(scene, object, i + 1 < n ? i + 1 : 0);
    return n > 1 || scene->dim == 2;
}

/** The best plane through the axle and another vertex. False: there is none. */
static bool turn_about(split_contest *c, const uint32_t *axle, split_candidate *out) {
    uint32_t v, last = (uint32_t)c->work->set.scene->dim - 1;
    c->failed |= !split_sweep_pencil(c->sweep, &c->work->set, c->facets, c->price, &c->terms, axle, &v);
    *out = (split_candidate){.kind = SPLIT_THROUGH};
    memcpy(out->id, axle, last * sizeof *axle);
    out->id[last] = v;
    return !c->failed && v != FROE_NONE && v != axle[0] && v != axle[last - 1] && split_contest_score(c, out);
}

/** Exchanges vertices of k, whose last is the best for the others, until none of them can be improved. */
static void improve(split_contest *c, split_candidate *k) {
    uint32_t failures = 0, last = (uint32_t)c->work->set.scene->dim - 1;
    for (uint32_t i = 1; i < c->config->effort.turns && failures < last && !c->failed; i++) {
        split_candidate next;
        if (turn_about(c, k->id + 1, &next) && next.cost < k->cost) {
            *k = next;
            failures = 0;
        } else {
            uint32_t first = k->id[0];
            memmove(k->id, k->id + 1, last * sizeof first);
            k->id[last] = first;
            failures++;
        }
    }
}

void split_enter_through(split_contest *c) {
    for (uint32_t i = 0; i < c->config->effort.starts && !c->done && !c->failed; i++) {
        uint32_t axle[2];
        split_candidate k;
        if (!drawn_axle(c, axle) || !turn_about(c, axle, &k)) continue;
        improve(c, &k);
        split_contest_enter(c, &k);
    }
}
