/* boxes_sweep.c: the cut of a cell of boxes, by one walk over the ends on each axis.
 *
 *     divided    ___/---\_____/--\__/-----\___      boxes that x[axis] = c would divide: open intervals
 *     rooms      /---\ /---\ ...                    rooms alive that contain c: closed intervals
 *
 * Both are weighted sums that change at events only, and at an event they are no worse than beside it, so events are
 * all candidates there are. With below and above, the numbers of boxes wholly on the two sides, in this order of
 * preference:
 *
 *     free      divides nothing, and has boxes on both sides            the best balanced over all axes
 *     peel      along a face of a box that holds all others in the cell (boxes_peel.c)
 *     lemma     divided <= trade * rooms, boxes on both sides           the best balanced; or with slack, of all that
 *                                                                       are nearly as balanced one that divides fewest
 *     forced    through a face, dividing fewest boxes                   (boxes on both sides, but in faces mode)
 *
 * Balance is min(below, above). Of equals on an axis the outermost is taken, on the side where it lies: it divides
 * fewest. (Tobola and Nechvile, section 5: lemma 3.3, weighted; the specification's order of stages.) Where no end of a
 * box lies before another's beginning, all boxes share a point: nothing separates them, and the cell is a leaf. */
#include "build/directional/boxes.h"
#include <math.h>

enum { NARROW_MOST = 4096 }; /* boxes: what larger cells divide is a small part of all, but reading them is not */

typedef struct axis_sweep {
    int64_t slack; /* trade * rooms - boxes divided, weighted */
    uint32_t divided, below, above;
} axis_sweep;

typedef struct sweep_found {
    boxes_cut least, lemma;
    uint32_t most, enough; /* divided and on the smaller side, of what could be better */
    bool paid;             /* do rooms pay for the least? */
} sweep_found;

/* -------------------------------------------------------------- comparisons -- */

static uint32_t balance(const boxes_cut *cut) {
    return cut->below < cut->above ? cut->below : cut->above;
}

bool boxes_better_on_axis(const boxes_cut *a, const boxes_cut *best, bool fewest) {
    if (!best->found) return true;
    if (fewest && a->divided != best->divided) return a->divided < best->divided;
    if (balance(a) != balance(best)) return balance(a) > balance(best);
    if (best->below <= best->above) return a->below > a->above && a->divided < best->divided;
    return true; /* both beyond the median: the outer one */
}

bool boxes_better(const boxes_cut *a, const boxes_cut *best, bool fewest) {
    if (!a->found || !best->found) return a->found;
    if (fewest && a->divided != best->divided) return a->divided < best->divided;
    return balance(a) != balance(best) ? balance(a) > balance(best) : a->divided < best->divided;
}

bool boxes_free_cut(const boxes *b, const boxes_cut *least, const boxes_cut *lemma) {
    double enough = lemma->found ? b->options.balance * balance(lemma) : 0;
    return least->found && !least->divided && balance(least) && balance(least) >= enough;
}

uint32_t boxes_narrow(const boxes *b, uint32_t count, const boxes_cut *least, const boxes_cut *lemma) {
    if (b->options.slack <= 0 || count > NARROW_MOST || !lemma->found || !lemma->divided ||
        boxes_free_cut(b, least, lemma))
        return 0;
    double most = (1 - b->options.slack) * balance(lemma);
    return most > 1 ? (uint32_t)ceil(most) : 1;
}

boxes_cut boxes_decide(const boxes *b, const boxes_cut *least, const boxes_cut *lemma) {
    bool free = boxes_free_cut(b, least, lemma);
    boxes_cut cut = lemma->found && !free ? *lemma : *least;
    cut.forced = !free && !lemma->found;
    return cut;
}

/* ------------------------------------------------------------------ sweeping -- */

static boxes_cut cut_at(const axis_sweep *s, int axis, double x) {
    return (boxes_cut){
        .found = true, .axis = axis, .c = x, .below = s->below, .above = s->above, .divided = s->divided};
}

/* narrow: 0, or how many boxes are enough for what is looked for the second time. */
static sweep_found sweep_axis(const boxes *b, const boxes_cell *cell, int axis, axis_sweep s, uint32_t narrow) {
    sweep_found best = {.enough = narrow ? narrow : 1, .most = UINT32_MAX};
    const boxes_event *e = b->events[axis].data + cell->event[axis], *end = e + cell->events[axis];
    while (e < end) {
        /* Arrives at the events of one coordinate; the kinds of ends are unpredictable, so branch-free. */
        const boxes_event *next = e;
        unsigned kinds = 0;
        do {
            const boxes_change *change = b->changes + next->change;
            s.slack += change->slack[0];
            s.divided += (uint32_t)change->divided[0];
            s.below += change->below;
            kinds |= 1u << next->end;
        } while (++next < end && next->x == e->x);
        const bool face = kinds & (1u << BOXES_LO | 1u << BOXES_HI | 1u << BOXES_FLAT);
        const uint32_t less = s.below < s.above ? s.below : s.above; /* the balance of a cut here */
        /* The second time: a face that divides fewest, and leaves enough boxes on both sides; is it paid for? A quick
         * test of two numbers comes first, both times: hardly any cut is better than all before. */
        if (narrow && s.divided <= best.most && face && less >= best.enough) {
            boxes_cut cut = cut_at(&s, axis, e->x);
            if (boxes_better_on_axis(&cut, &best.least, true)) {
                best.least = cut;
                best.most = cut.divided;
                best.paid = s.slack >= 0;
            }
        }
        if (!narrow && s.divided <= best.most && face && (less || b->options.faces)) {
            boxes_cut cut = cut_at(&s, axis, e->x);
            if (boxes_better_on_axis(&cut, &best.least, true)) best.least = cut;
            best.most = best.least.divided;
        }
        if (!narrow && less >= best.enough && s.slack >= 0) {
            boxes_cut cut = cut_at(&s, axis, e->x);
            if (boxes_better_on_axis(&cut, &best.lemma, false)) best.lemma = cut;
            best.enough = balance(&best.lemma);
        }
        for (; e < next; e++) { /* leaves them behind */
            const boxes_change *change = b->changes + e->change;
            s.slack += change->slack[1];
            s.divided += (uint32_t)change->divided[1];
            s.above -= change->above;
        }
    }
    return best;
}

/* No cut is better than one that divides nothing and halves the boxes (those without extent may be on both sides). */
static bool perfect(const boxes *b, const boxes_cell *cell, const boxes_cut *least) {
    return least->found && !least->divided && !b->flat && cell->count > 1 && balance(least) == cell->count / 2;
}

boxes_cut boxes_sweep(const boxes *b, const boxes_cell *cell) {
    boxes_cut least = {.found = false}, lemma = {.found = false};
    uint32_t narrow = 0;
    axis_sweep from[FROE_MAX_DIM];
    /* before the first event on each axis: boxes that begin at the border of the cell or before */
    const boxes_fragment *f = b->fragments.data + cell->first, *end = f + cell->count;
    for (int k = 0; k < b->dim; k++) from[k] = (axis_sweep){0};
    for (; f < end; f++) {
        uint32_t some, both;
        boxes_count_rooms(f->alive, &some, &both);
        for (int k = 0; k < b->dim; k++) {
            unsigned rooms = f->alive >> 2 * k & 3, begins = f->inside >> 2 * k & 1;
            int64_t weight = b->weight[some - (rooms > 0)][both - (rooms == 3)];
            from[k].above += begins;
            from[k].divided += !begins;
            from[k].slack -= weight & ((int64_t)begins - 1);
        }
    }
    for (int turn = 0; turn < (narrow ? 2 : 1); turn++) {
        for (int k = 0; k < b->dim && !perfect(b, cell, &least); k++) {
            if (!cell->events[k]) continue;
            sweep_found here = sweep_axis(b, cell, k, from[k], narrow);
            if (!turn && boxes_better(&here.least, &least, true)) least = here.least;
            if (!turn && boxes_better(&here.lemma, &lemma, false)) lemma = here.lemma;
            if (turn && here.paid && boxes_better(&here.least, &lemma, true)) lemma = here.least;
        }
        if (!turn) narrow = boxes_narrow(b, cell->count, &least, &lemma);
    }
    boxes_cut cut = boxes_decide(b, &least, &lemma);
    if (boxes_free_cut(b, &least, &lemma)) return cut;
    const boxes_cut peel = boxes_peel(b, cell);
    if (peel.found || !cut.found || cell->count > BOXES_CROWD) return peel.found ? peel : cut;
    uint32_t objects[BOXES_CROWD];
    for (uint32_t i = 0; i < cell->count; i++) objects[i] = b->fragments.data[cell->first + i].object;
    cut.crowded = boxes_crowd(b, &cut, objects, cell->count);
    cut.found = !cut.crowded;
    return cut;
}
