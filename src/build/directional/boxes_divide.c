/* boxes_divide.c: dealing the boxes of a cell to both sides of a cut.
 *
 * Fragments and ends keep their order, so nothing is sorted again. What lies above closes up in place, what lies below
 * goes on top of it: that side comes next. */
#include "build/directional/boxes.h"
#include <string.h>

enum { MARK_BELOW = 1, MARK_ABOVE = 2, MARK_KEEPS = 4 }; /* sides; from KEEPS on: which ends stay, below, then above */

static unsigned kept(boxes_end end, bool above) {
    return (unsigned)MARK_KEEPS << (above ? 4 : 0) << end;
}

/** Where the cut leaves each fragment: its sides, and which of its ends on the axis stay strictly inside there. */
static void mark(boxes *b, const boxes_cell *cell, const boxes_cut *cut) {
    const boxes_event *e = b->events[cut->axis].data + cell->event[cut->axis];
    uint16_t *marks = b->marks.data;
    for (uint32_t i = 0; i < cell->count; i++) marks[i] = MARK_BELOW | MARK_ABOVE;
    for (uint32_t i = 0; i < cell->events[cut->axis]; i++) {
        uint16_t *m = marks + e[i].fragment;
        boxes_end end = (boxes_end)e[i].end;
        bool below = e[i].x<cut->c, above = e[i].x> cut->c;
        if (end == BOXES_FLAT) {
            *m = (uint16_t)(below   ? MARK_BELOW | kept(BOXES_LO, false) | kept(BOXES_HI, false)
                            : above ? MARK_ABOVE | kept(BOXES_LO, true) | kept(BOXES_HI, true)
                                    : 0);
            continue;
        }
        if (end == BOXES_LO && !below) *m &= (uint16_t)~MARK_BELOW;
        if (end == BOXES_HI && !above) *m &= (uint16_t)~MARK_ABOVE;
        if (below || above) *m |= (uint16_t)kept(end, above);
    }
}

/** The fragment as its side sees it; mark: see mark(). */
static boxes_fragment part(boxes_fragment f, unsigned mark, bool above, int axis) {
    unsigned keeps = mark / kept(BOXES_BEFORE, above), bits = 3u << 2 * axis;
    unsigned inside = (keeps >> BOXES_LO & 1) | (keeps >> BOXES_HI & 1) << 1;
    unsigned alive = (keeps >> BOXES_BEFORE & 1) | (keeps >> BOXES_AFTER & 1) << 1;
    f.inside = (uint16_t)((f.inside & ~bits) | inside << 2 * axis);
    f.alive = (uint16_t)((f.alive & ~bits) | alive << 2 * axis);
    return f;
}

/** Writes the event as a side sees it; returns 1 if its fragment is there. That is unpredictable, so
 * branch-free: the next event overwrites one whose fragment is not there. */
static size_t hand_on(const boxes_event *e, const boxes_parts *parts, int side, bool across, boxes_event *to) {
    *to = *e;
    to->fragment = parts->name[side];
    to->change = (uint16_t)(to->change + parts->shift[side][across]);
    return parts->name[side] != FROE_NONE;
}

static bool deal_events(boxes *b, const boxes_cell *cell, const boxes_cut *cut, int axis, boxes_cell side[2]) {
    uint32_t count = cell->events[axis];
    b->spare_events.count = 0;
    if (!array_reserve(&b->alloc, &b->spare_events, (size_t)count + 1) ||
        !array_reserve(&b->alloc, &b->events[axis], count))
        return false;
    /* those above close up in place, the others go aside */
    boxes_event *item = b->events[axis].data + cell->event[axis], *spare = b->spare_events.data;
    size_t above = 0, below = 0, i = 0;
    if (axis == cut->axis) { /* each to the side on which it lies */
        for (; i < count && item[i].x < cut->c; i++)
            below += hand_on(item + i, b->parts.data + item[i].fragment, 0, true, spare + below);
        while (i < count && item[i].x == cut->c) i++;
        for (; i < count; i++) {
            boxes_event e = item[i];
            above += hand_on(&e, b->parts.data + e.fragment, 1, true, item + above);
        }
    }
    for (; i < count; i++) { /* on other axes each to both sides */
        boxes_event e = item[i];
        const boxes_parts *parts = b->parts.data + e.fragment;
        above += hand_on(&e, parts, 1, false, item + above); /* at most item[i] */
        below += hand_on(&e, parts, 0, false, spare + below);
    }
    side[0].events[axis] = (uint32_t)below;
    side[1].events[axis] = (uint32_t)above;
    side[0].event[axis] = cell->event[axis] + above;
    if (below) memcpy(item + above, spare, below * sizeof *item);
    b->events[axis].count = side[0].event[axis] + below;
    return true;
}

froe_status boxes_list_covers(boxes *b, boxes_cell *cell) {
    froe_status status = cell->covers ? draft_list(&b->draft, cell->node) : FROE_OK;
    for (uint32_t i = cell->cover; i != FROE_NONE && !status; i = b->covers.data[i].next)
        status = draft_cover(&b->draft, cell->node, b->covers.data[i].object);
    cell->cover = FROE_NONE;
    cell->covers = 0;
    return status;
}

froe_status boxes_split_node(boxes *b, boxes_cell *cell, const boxes_cut *cut, uint32_t *child) {
    froe_cut plane = {.kind = FROE_CUT_AXIS, .axis = cut->axis, .value = cut->c};
    const froe_status status = draft_split(&b->draft, cell->node, &plane, 0, child);
    return status ? status : boxes_list_covers(b, cell);
}

/** Deals the fragments: those above close up in place, those below go on top of them. */
static bool deal_boxes(boxes *b, const boxes_cell *cell, const boxes_cut *cut, boxes_cell side[2]) {
    boxes_fragment *item = b->fragments.data + cell->first;
    boxes_parts *parts = b->parts.data;
    bool ok = true;
    b->fragments.count = cell->first;
    for (uint32_t i = 0; i < cell->count && ok; i++) {
        boxes_fragment whole = item[i];
        unsigned mark = b->marks.data[i];
        for (int s = 0; s < 2; s++) {
            parts[i].name[s] = FROE_NONE;
            if (!(mark & (s ? MARK_ABOVE : MARK_BELOW))) continue;
            boxes_fragment f = part(whole, mark, s, cut->axis);
            if (!f.inside) {
                ok = ok && boxes_add_cover(b, &side[s], f.object);
                continue;
            }
            parts[i].name[s] = side[s].count++;
            (s ? item : b->spare.data)[parts[i].name[s]] = f;
            /* from the numbers of its changes to those of a fragment with other rooms on the axis of the cut */
            int from = (int)(whole.alive >> 2 * cut->axis & 3), to = (int)(f.alive >> 2 * cut->axis & 3);
            int some = (to > 0) - (from > 0), both = (to == 3) - (from == 3);
            parts[i].shift[s][0] = (int16_t)(some * BOXES_SOME + both * BOXES_BOTH);
            parts[i].shift[s][1] = (int16_t)((to - from) * BOXES_ROOMS);
        }
    }
    if (side[0].count) memcpy(item + side[1].count, b->spare.data, side[0].count * sizeof *item);
    side[0].first = side[1].first + side[1].count;
    b->fragments.count = (size_t)side[0].first + side[0].count;
    return ok;
}

froe_status boxes_divide(boxes *b, boxes_cell *cell, const boxes_cut *cut) {
    const froe_allocator *alloc = &b->alloc;
    const uint32_t count = cell->count;
    uint32_t child = 0;
    if (b->fragments.count + count > BOXES_MOST) return FROE_E_LIMIT;
    b->marks.count = b->parts.count = b->spare.count = 0;
    if (!array_reserve(alloc, &b->marks, count) || !array_reserve(alloc, &b->parts, count) ||
        !array_reserve(alloc, &b->spare, count) || !array_reserve(alloc, &b->fragments, count) ||
        !array_reserve(alloc, &b->cells, 2))
        return FROE_E_MEMORY;
    mark(b, cell, cut);
    /* the weight of what a forced cut divides, but for boxes with both rooms: those pay for themselves */
    for (uint32_t i = 0; i < count && cut->forced; i++) {
        uint16_t alive = b->fragments.data[cell->first + i].alive;
        bool divided = (b->marks.data[i] & 3) == 3, both = (alive >> 2 * cut->axis & 3) == 3;
        if (divided && !both) b->paid += (uint64_t)boxes_weight(b, alive, cut->axis);
    }
    bool begun = cell->covers;
    froe_status status = boxes_split_node(b, cell, cut, &child);
    if (!status) {
        /* lists the boxes without extent that lie in the cut */
        const boxes_fragment *item = b->fragments.data + cell->first;
        for (uint32_t i = 0; i < cell->count && !status; i++) {
            if (b->marks.data[i]) continue;
            if (!begun) status = draft_list(&b->draft, cell->node);
            begun = true;
            if (!status) status = draft_piece(&b->draft, cell->node, item[i].object, NULL, 0);
        }
    }
    if (status) return status;
    boxes_cell side[2] = {*cell, *cell};
    for (uint32_t s = 0; s < 2; s++) {
        side[s].node = child + s;
        side[s].count = 0;
        (s ? side[s].lo : side[s].hi)[cut->axis] = cut->c;
    }
    bool ok = deal_boxes(b, cell, cut, side);
    for (int k = 0; k < b->dim && ok; k++) ok = deal_events(b, cell, cut, k, side);
    if (!ok) return FROE_E_MEMORY;
    b->cells.data[b->cells.count++] = side[1];
    b->cells.data[b->cells.count++] = side[0];
    return FROE_OK;
}
