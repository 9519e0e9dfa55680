/* candidates.c: see candidates.h. Draws depend on the path of the cell, not on threads. */
#include "split/candidates.h"
#include <math.h>

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
        for (uint32_t i = 0; i < 3; i++) k.id[i] = scene_corner(scene, object, i);
    } else {
        return; /* a segment askew in space: split_any_support() knows it */
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
    for (int axis = 0; axis < 3 && !c->done && !c->failed; axis++) {
        split_candidate k = {.kind = SPLIT_AXIS, .axis = axis};
        uint32_t corner;
        c->failed |= !split_sweep_axis(c->sweep, &c->work->set, c->facets, c->price, &c->terms, axis, &corner);
        if (c->failed || corner == FROE_NONE) continue;
        k.value = split_facets_coordinate(c->facets, c->work->set.scene, corner, axis);
        if (isfinite(k.value)) score_and_enter(c, k);
    }
}

/* ---------------------------------------------------------- three vertices -- */

/** An edge of some object of the cell; false: it has none. */
static bool drawn_edge(split_contest *c, uint32_t *a, uint32_t *b) {
    const froe_scene *scene = c->work->set.scene;
    uint32_t object = drawn_object(c), n = scene_corners(scene, object), i = split_draw(c, n);
    *a = scene_corner(scene, object, i);
    *b = scene_corner(scene, object, i + 1 < n ? i + 1 : 0);
    return n > 1;
}

/** The best plane through a, b and another vertex. False: there is none. */
static bool turn_about(split_contest *c, uint32_t a, uint32_t b, split_candidate *out) {
    uint32_t v;
    c->failed |= !split_sweep_pencil(c->sweep, &c->work->set, c->facets, c->price, &c->terms, a, b, &v);
    *out = (split_candidate){.kind = SPLIT_TRIPLE, .id = {a, b, v}};
    return !c->failed && v != FROE_NONE && v != a && v != b && split_contest_score(c, out);
}

/** Exchanges vertices of k, whose last is the best with the others, until none of the three can be improved. */
static void improve(split_contest *c, split_candidate *k) {
    uint32_t failures = 0;
    for (uint32_t i = 1; i < c->config->effort.turns && failures < 2 && !c->failed; i++) {
        split_candidate next;
        if (turn_about(c, k->id[1], k->id[2], &next) && next.cost < k->cost) {
            *k = next;
            failures = 0;
        } else {
            uint32_t kept = k->id[0];
            k->id[0] = k->id[1];
            k->id[1] = k->id[2];
            k->id[2] = kept;
            failures++;
        }
    }
}

void split_enter_triples(split_contest *c) {
    for (uint32_t i = 0; i < c->config->effort.starts && !c->done && !c->failed; i++) {
        uint32_t a, b;
        split_candidate k;
        if (!drawn_edge(c, &a, &b) || !turn_about(c, a, b, &k)) continue;
        improve(c, &k);
        split_contest_enter(c, &k);
    }
}
