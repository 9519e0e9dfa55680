/* boxes_sweep.c: which cut for a cell of boxes? One walk over the ends on each axis.
 *
 *     divided    ___/---\_____/--\__/-----\___      boxes that x[axis] = c would divide: open intervals
 *     rooms      /---\ /---\ ...                    rooms alive that contain c: closed intervals
 *
 * Both are weighted sums that change at events only, and at an event they are no worse than beside it, so events are
 * all candidates there are. With below and above, the numbers of boxes wholly on the two sides, in this order of
 * preference:
 *
 *     free      divides nothing, and has boxes on both sides            the best balanced over all axes
 *     lemma     divided <= trade * rooms, boxes on both sides           the best balanced; or with slack, of all that
 * are nearly as balanced one that divides fewest peel      divides nothing, a face in the cut (faces mode) forced
 * through a face, dividing fewest boxes                   (boxes on both sides, but in faces mode)
 *
 * Balance is min(below, above). Of equals on an axis the outermost is taken, on the side where it lies: it divides
 * fewest. (Tobola and Nechvile, section 5: lemma 3.3, weighted; the specification's order of stages.) Where no end of a
 * box lies before another's beginning, all boxes share a point: nothing separates them, and the cell is a leaf. */
#include "split/boxes.h"
#include <math.h>

typedef struct sweep {
    int64_t rooms, weight; /* weight: of the boxes divided */
    uint32_t divided, below, above;
} sweep;

typedef struct sweep_found {
    boxes_cut least, lemma;
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

uint32_t boxes_narrow(const boxes *b, const boxes_cut *least, const boxes_cut *lemma) {
    if (b->options.slack <= 0 || !lemma->found || !lemma->divided || boxes_free_cut(b, least, lemma)) return 0;
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

/* Before the first event: boxes that begin at the border of the cell or before. */
static sweep start(const boxes *b, const boxes_cell *cell, int axis) {
    sweep s = {0};
    for (uint32_t i = 0; i < cell->count; i++) {
        const boxes_fragment *f = b->fragments.data + cell->first + i;
        bool begins = f->inside >> 2 * axis & 1;
        s.above += begins;
        s.divided += !begins;
        s.weight += begins ? 0 : boxes_weight(b, f->alive, axis);
    }
    return s;
}

/* Arrives at the events of one coordinate; *face: is one of them a face? Returns the event behind them. No branches:
 * ends come in no order that could be predicted. */
static const boxes_event *arrive(const boxes *b, sweep *s, const boxes_event *e, const boxes_event *end, bool *face) {
    *face = false;
    for (double x = e->x; e < end && e->x == x; e++) {
        int64_t w = b->weight[e->some][e->both];
        bool before = e->end == BOXES_BEFORE, hi = e->end == BOXES_HI, flat = e->end == BOXES_FLAT;
        *face |= !before & (e->end != BOXES_AFTER);
        s->below += hi | flat;
        s->divided -= hi;
        s->weight -= hi ? w : 0;
        s->rooms += before | (hi & e->rooms >> 1) ? w : 0;
    }
    return e;
}

/* Leaves them behind. */
static void leave(const boxes *b, sweep *s, const boxes_event *e, const boxes_event *end) {
    for (; e < end; e++) {
        int64_t w = b->weight[e->some][e->both];
        bool after = e->end == BOXES_AFTER, lo = e->end == BOXES_LO, flat = e->end == BOXES_FLAT;
        s->above -= lo | flat;
        s->divided += lo;
        s->weight += lo ? w : 0;
        s->rooms -= after | (lo & e->rooms) ? w : 0;
    }
}

static void consider(const boxes *b, const sweep *s, int axis, double x, bool face, sweep_found *best) {
    boxes_cut cut = {.found = true, .axis = axis, .c = x, .below = s->below, .above = s->above, .divided = s->divided};
    bool separates = s->below && s->above;
    if (face && (separates || b->options.faces) && boxes_better_on_axis(&cut, &best->least, true)) best->least = cut;
    bool paid = b->options.trade * s->rooms >= s->weight;
    if (separates && paid && boxes_better_on_axis(&cut, &best->lemma, false)) best->lemma = cut;
}

/* Through the same events once more, for the face that divides fewest and leaves `least` boxes on both sides. */
static void narrow_axis(const boxes *b, const boxes_cell *cell, int axis, uint32_t least, boxes_cut *best) {
    sweep s = start(b, cell, axis);
    boxes_cut here = {.found = false};
    bool paid = false;
    const boxes_event *e = b->events[axis].data + cell->event[axis], *end = e + cell->events[axis];
    while (e < end && s.above >= least) {
        bool face;
        const boxes_event *next = arrive(b, &s, e, end, &face);
        boxes_cut cut = {true, false, axis, e->x, s.below, s.above, s.divided};
        if (face && s.below >= least && s.above >= least && boxes_better_on_axis(&cut, &here, true)) {
            here = cut;
            paid = b->options.trade * s.rooms >= s.weight;
        }
        leave(b, &s, e, next);
        e = next;
    }
    if (paid && boxes_better(&here, best, true)) *best = here;
}

static void sweep_axis(const boxes *b, const boxes_cell *cell, int axis, sweep_found *best) {
    sweep s = start(b, cell, axis);
    sweep_found here = {0};
    const boxes_event *e = b->events[axis].data + cell->event[axis], *end = e + cell->events[axis];
    while (e < end) {
        bool face;
        const boxes_event *next = arrive(b, &s, e, end, &face);
        consider(b, &s, axis, e->x, face, &here);
        leave(b, &s, e, next);
        e = next;
    }
    if (boxes_better(&here.least, &best->least, true)) best->least = here.least;
    if (boxes_better(&here.lemma, &best->lemma, false)) best->lemma = here.lemma;
}

boxes_cut boxes_sweep(const boxes *b, const boxes_cell *cell) {
    sweep_found best = {0};
    for (int k = 0; k < b->dim; k++)
        if (cell->events[k]) sweep_axis(b, cell, k, &best);
    uint32_t least = boxes_narrow(b, &best.least, &best.lemma);
    for (int k = 0; k < b->dim && least; k++)
        if (cell->events[k]) narrow_axis(b, cell, k, least, &best.lemma);
    return boxes_decide(b, &best.least, &best.lemma);
}
