/* boxes_axis.c: the cuts of boxes_sweep.c, found in logarithmic time. */
#include "build/directional/boxes_axis.h"

#define NO_FACE ((int64_t)1 << 40) /* taken off `least` where no face is */

/* --------------------------------------------------------------- positions -- */

/* Orders the boxes by one end, by counting. first[p] becomes the number of boxes that have it before p. */
static void order_box_ends(boxes_axis *a, boxes_end end, uint32_t *first, uint32_t *sorted) {
    for (uint32_t i = 0; i < a->count; i++) first[a->places[i].at[end] + 2]++;
    for (uint32_t p = 1; p < a->size + 4; p++) first[p] += first[p - 1];
    for (uint32_t i = 0; i < a->count; i++) { /* first[p + 1] walks from the first box at p to the first one behind */
        uint32_t rank = first[a->places[i].at[end] + 1]++;
        sorted[rank] = i;
        a->places[i].rank[end == BOXES_HI] = rank;
    }
}

/* ------------------------------------------------------------ making, freeing -- */

froe_status boxes_axis_new(const boxes *b, const boxes_cell *cell, int axis, boxes_axis *out) {
    const boxes_event *e = b->events[axis].data + cell->event[axis];
    uint32_t events = cell->events[axis];
    *out = (boxes_axis){.count = cell->count};
    for (uint32_t i = 0; i < events; i++) out->size += !i || e[i].x != e[i - 1].x;
    size_t positions = (size_t)out->size + 4;
    out->x = support_calloc(&b->alloc, positions, sizeof *out->x);
    out->faces = support_calloc(&b->alloc, positions, sizeof *out->faces);
    out->places = support_calloc(&b->alloc, out->count, sizeof *out->places);
    for (int i = 0; i < 2; i++) {
        out->first[i] = support_calloc(&b->alloc, positions, sizeof *out->first[i]);
        out->order[i] = support_calloc(&b->alloc, out->count, sizeof *out->order[i]);
        out->ends[i] = base_fenwick_new(&b->alloc, out->size + 1);
        if (!out->first[i] || !out->order[i] || !out->ends[i].sum) return FROE_E_MEMORY;
    }
    if (!(out->x && out->faces && out->places && !base_max_tree_new(&b->alloc, out->size + 2, &out->slack) &&
          !base_max_tree_new(&b->alloc, out->size + 2, &out->least) &&
          !base_max_tree_new(&b->alloc, out->count, &out->reach) &&
          !base_max_tree_new(&b->alloc, out->count, &out->before) &&
          !base_max_tree_new(&b->alloc, out->count, &out->after)))
        return FROE_E_MEMORY;
    /* numbers the coordinates, and notes where each box has its ends */
    uint32_t position = 0;
    for (uint32_t i = 0; i < out->count; i++) out->places[i].at[BOXES_HI] = out->size + 1;
    for (uint32_t i = 0; i < events; i++) {
        if (!i || e[i].x != e[i - 1].x) out->x[++position] = e[i].x;
        uint32_t *at = out->places[e[i].fragment].at;
        if (e[i].end == BOXES_FLAT)
            at[BOXES_LO] = at[BOXES_HI] = position;
        else
            at[e[i].end] = position;
    }
    order_box_ends(out, BOXES_LO, out->first[0], out->order[0]);
    order_box_ends(out, BOXES_HI, out->first[1], out->order[1]);
    base_max_tree_raise(&out->least, 0, out->size + 2, -NO_FACE);
    return FROE_OK;
}

void boxes_axis_free(const froe_allocator *alloc, boxes_axis *a) {
    size_t positions = (size_t)a->size + 4, count = a->count;
    support_free(alloc, a->x, positions * sizeof *a->x);
    support_free(alloc, a->faces, positions * sizeof *a->faces);
    support_free(alloc, a->places, count * sizeof *a->places);
    for (int i = 0; i < 2; i++) {
        support_free(alloc, a->first[i], positions * sizeof *a->first[i]);
        support_free(alloc, a->order[i], count * sizeof *a->order[i]);
        base_fenwick_free(alloc, &a->ends[i]);
    }
    base_max_tree *trees[] = {&a->slack, &a->least, &a->reach, &a->before, &a->after};
    for (size_t i = 0; i < sizeof trees / sizeof *trees; i++) base_max_tree_free(alloc, trees[i]);
}

/* ---------------------------------------------------------- giving and taking -- */

void boxes_axis_weigh(boxes_axis *a, uint32_t box, unsigned alive, int64_t weight, int64_t trade) {
    const uint32_t *at = a->places[box].at;
    if (at[BOXES_LO] == at[BOXES_HI]) return;
    base_max_tree_raise(&a->slack, at[BOXES_LO] + 1, at[BOXES_HI], -weight);
    if (alive & 1) base_max_tree_raise(&a->slack, at[BOXES_BEFORE], at[BOXES_LO] + 1, trade * weight);
    if (alive & 2) base_max_tree_raise(&a->slack, at[BOXES_HI], at[BOXES_AFTER] + 1, trade * weight);
}

static void set(base_max_tree *s, uint32_t at, uint32_t value, bool there) {
    base_max_tree_raise(s, at, at + 1, there ? (int64_t)value : -(int64_t)value);
}

void boxes_axis_list(boxes_axis *a, uint32_t box, unsigned alive, bool there) {
    const boxes_places *p = a->places + box;
    base_max_tree_raise(&a->least, p->at[BOXES_LO] + 1, p->at[BOXES_HI], there ? -1 : 1);
    for (int i = 0; i < 2; i++) {
        uint32_t at = p->at[i ? BOXES_HI : BOXES_LO];
        if (!at || at > a->size) continue;
        const bool changes = a->faces[at] == !there;
        a->faces[at] += there ? 1 : UINT32_MAX;
        if (changes) base_max_tree_raise(&a->least, at, at + 1, there ? NO_FACE : -NO_FACE);
        base_fenwick_add(&a->ends[i], at, there ? 1 : UINT32_MAX);
    }
    set(&a->reach, p->rank[0], p->at[BOXES_HI], there);
    if (alive & 1) set(&a->before, p->rank[0], a->size + 1 - p->at[BOXES_BEFORE], there);
    /* with a mark that it is there at all, above all positions */
    set(&a->after, p->rank[1], alive & 2 ? p->at[BOXES_AFTER] : p->at[BOXES_HI], there);
}

void boxes_axis_forget_room(boxes_axis *a, uint32_t box, int room) {
    const boxes_places *p = a->places + box;
    if (room)
        base_max_tree_raise(&a->after, p->rank[1], p->rank[1] + 1, (int64_t)p->at[BOXES_HI] - p->at[BOXES_AFTER]);
    else
        set(&a->before, p->rank[0], a->size + 1 - p->at[BOXES_BEFORE], false);
}

/* ------------------------------------------------------------------ searching -- */

/* The positions searched, the last one where not more boxes lie below than above, and the level to be reached. */
typedef struct axis_search {
    const boxes_axis *a;
    const base_max_tree *in;
    uint32_t from, end, middle; /* [from, end) is searched; the median side ends before `middle` */
    int64_t level;
} axis_search;

/* The first position where more boxes lie below than above. */
static uint32_t beyond_median(const boxes_axis *a, uint32_t from, uint32_t end) {
    while (from < end) {
        uint32_t at = from + (end - from) / 2;
        if (boxes_axis_below(a, at) <= boxes_axis_above(a, at))
            from = at + 1;
        else
            end = at;
    }
    return from;
}

static bool spot_at(const axis_search *s, int axis, uint32_t at, boxes_spot *out) {
    if (at == BASE_MAX_TREE_NONE) return false;
    int64_t divided = -base_max_tree_max(&s->a->least, at, at + 1);
    out->at = at;
    out->cut = (boxes_cut){.found = true,
                           .axis = axis,
                           .c = s->a->x[at],
                           .below = boxes_axis_below(s->a, at),
                           .above = boxes_axis_above(s->a, at),
                           .divided = (uint32_t)(s->a->faces[at] ? divided : divided - NO_FACE)};
    return true;
}

static void find_box_spot(const axis_search *s, int axis, bool fewest, boxes_spot *best) {
    const base_fenwick *begins = &s->a->ends[0], *ends = &s->a->ends[1];
    boxes_spot other;
    if (s->from >= s->end) return;
    /* Up to the median: the best balance is nearest to it, and the first position that has the same number below it. */
    uint32_t at = base_max_tree_last(s->in, s->from, s->middle, s->level);
    if (at != BASE_MAX_TREE_NONE) {
        const uint32_t below = boxes_axis_below(s->a, at), first = below ? base_fenwick_select(ends, below) : 0;
        at = base_max_tree_first(s->in, first > s->from ? first : s->from, at + 1, s->level);
        spot_at(s, axis, at, best);
    }
    /* Beyond it: the last position that has the same number above. */
    at = base_max_tree_first(s->in, s->middle, s->end, s->level);
    if (at == BASE_MAX_TREE_NONE) return;
    const uint32_t above = boxes_axis_above(s->a, at);
    const uint32_t last = above ? base_fenwick_select(begins, begins->total - above + 1) : s->end - 1;
    at = base_max_tree_last(s->in, at, last < s->end ? last + 1 : s->end, s->level);
    if (spot_at(s, axis, at, &other) && boxes_better_on_axis(&other.cut, &best->cut, fewest)) *best = other;
}

/* Positions with so many boxes on both sides, between two others; at least 1. */
static axis_search around(const boxes_axis *a, const base_max_tree *in, uint32_t lo, uint32_t hi, uint32_t least) {
    const base_fenwick *begins = &a->ends[0];
    uint32_t first = base_fenwick_select(&a->ends[1], least);
    uint32_t last = begins->total >= least ? base_fenwick_select(begins, begins->total - least + 1) : 0;
    uint32_t from = first > lo ? first : lo + 1, end = last < hi ? last + 1 : hi;
    return (axis_search){.a = a, .in = in, .from = from, .end = end, .middle = beyond_median(a, from, end)};
}

/* Sets the level to the fewest divided; is there a face at all? */
static bool fewest_divided(axis_search *s) {
    s->in = &s->a->least;
    if (s->from >= s->end) return false;
    s->level = base_max_tree_max(s->in, s->from, s->end);
    return s->level > -NO_FACE / 2;
}

void boxes_axis_best(const boxes_axis *a, int axis, uint32_t lo, uint32_t hi, bool anywhere, boxes_spot *least,
                     boxes_spot *lemma) {
    *least = *lemma = (boxes_spot){.at = 0};
    axis_search s = around(a, &a->slack, lo, hi, 1);
    find_box_spot(&s, axis, false, lemma);
    if (anywhere) s.from = lo + 1, s.end = hi, s.middle = beyond_median(a, s.from, s.end);
    if (fewest_divided(&s)) find_box_spot(&s, axis, true, least);
}

void boxes_axis_narrow(const boxes_axis *a, int axis, uint32_t lo, uint32_t hi, uint32_t least, boxes_spot *out) {
    axis_search s = around(a, &a->least, lo, hi, least);
    *out = (boxes_spot){.at = 0};
    if (fewest_divided(&s)) find_box_spot(&s, axis, true, out);
    if (out->cut.found && base_max_tree_max(&a->slack, out->at, out->at + 1) < 0) out->cut.found = false;
}
