/* boxes.c: filling cells with boxes, and dealing them to both sides of a cut. */
#include "split/boxes.h"
#include <math.h>
#include <string.h>

enum { INSERTION = 24 };      /* so few events are sorted by insertion */
#define BOXES_MOST (1u << 30) /* fragments on the stack: far below what node and piece numbers allow */

froe_status boxes_new(const froe_scene *scene, const froe_allocator *alloc, const boxes_options *options, boxes *out) {
    *out = (boxes){.scene = scene, .alloc = *alloc, .dim = scene->dim, .options = *options};
    for (int some = 0; some <= scene->dim; some++) {
        out->weight[some][0] = some ? out->weight[some - 1][0] * (1 + options->trade) : 1;
        for (int both = 1; both <= some; both++) out->weight[some][both] = 2 * out->weight[some][both - 1];
    }
    return draft_new(alloc, scene->dim, 0, &out->draft);
}

void boxes_free(boxes *b) {
    if (b->draft.nodes.data) draft_free(&b->draft);
    for (int k = 0; k < b->dim; k++) array_free(&b->alloc, &b->events[k]);
    array_free(&b->alloc, &b->fragments);
    array_free(&b->alloc, &b->cells);
    array_free(&b->alloc, &b->covers);
    array_free(&b->alloc, &b->marks);
    array_free(&b->alloc, &b->parts);
    array_free(&b->alloc, &b->objects);
    array_free(&b->alloc, &b->spare);
    array_free(&b->alloc, &b->spare_events);
    array_free(&b->alloc, &b->pairs);
}

/* ----------------------------------------------------------------- weights -- */

/** How many of the bits 0, 2, 4, ... are set. */
static uint8_t pairs_set(unsigned bits) {
    bits = (bits & 0x1111) + (bits >> 2 & 0x1111);
    return (uint8_t)((bits * 0x1111u >> 12) & 15);
}

/** Fills in what an event tells of the rooms of its fragment. */
static void grade(boxes_event *e, uint16_t alive, int axis) {
    unsigned others = alive & ~(3u << 2 * axis);
    e->rooms = alive >> 2 * axis & 3;
    e->some = pairs_set(others | others >> 1);
    e->both = pairs_set(others & others >> 1);
}

int64_t boxes_weight(const boxes *b, uint16_t alive, int axis) {
    boxes_event e;
    grade(&e, alive, axis);
    return b->weight[e.some][e.both];
}

double boxes_bound(const boxes *b, uint32_t n) {
    double most = 1;
    for (int k = 0; k < b->dim; k++) most *= (double)(2 + 2 * b->options.trade);
    return most * (double)b->options.trade <= 0x1p31 ? most * n : 0; /* times 2^31 fragments: no sum overflows */
}

/* ------------------------------------------------------------ opening a cell -- */

void boxes_ends(const boxes *b, uint32_t object, double end[FROE_MAX_DIM][4]) {
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    scene_object_bounds(b->scene, object, lo, hi);
    for (int k = 0; k < b->dim; k++) {
        double room = b->options.delta * (hi[k] - lo[k]); /* infinite at worst: then there is no room */
        end[k][BOXES_BEFORE] = lo[k] - room;
        end[k][BOXES_LO] = lo[k];
        end[k][BOXES_HI] = hi[k];
        end[k][BOXES_AFTER] = hi[k] + room;
    }
}

/** Appends an event of the fragment added last. */
static void note(boxes *b, boxes_cell *cell, int axis, boxes_end end, double x) {
    b->events[axis].data[b->events[axis].count++] = (boxes_event){.x = x, .fragment = cell->count, .end = (uint8_t)end};
    cell->events[axis]++;
}

/** What a box has on one axis strictly inside the cell. */
static void note_axis(boxes *b, boxes_cell *cell, int axis, const double end[4], boxes_fragment *f) {
    double lo = end[BOXES_LO], hi = end[BOXES_HI], least = cell->lo[axis], most = cell->hi[axis];
    if (lo == hi) {
        f->inside |= (uint16_t)(3u << 2 * axis);
        note(b, cell, axis, BOXES_FLAT, lo);
        return;
    }
    bool inside[2] = {lo > least, hi < most};
    bool alive[2] = {end[BOXES_BEFORE] > least && end[BOXES_BEFORE] < lo,
                     end[BOXES_AFTER] < most && end[BOXES_AFTER] > hi};
    f->inside |= (uint16_t)((inside[0] | inside[1] << 1) << 2 * axis);
    f->alive |= (uint16_t)((alive[0] | alive[1] << 1) << 2 * axis);
    if (alive[0]) note(b, cell, axis, BOXES_BEFORE, end[BOXES_BEFORE]);
    if (inside[0]) note(b, cell, axis, BOXES_LO, lo);
    if (inside[1]) note(b, cell, axis, BOXES_HI, hi);
    if (alive[1]) note(b, cell, axis, BOXES_AFTER, end[BOXES_AFTER]);
}

bool boxes_add_cover(boxes *b, boxes_cell *cell, uint32_t object) {
    if (!array_push(&b->alloc, &b->covers, (boxes_cover){object, cell->cover})) return false;
    cell->cover = (uint32_t)b->covers.count - 1;
    cell->covers++;
    return true;
}

static void insert_sorted(boxes_event *e, uint32_t count) {
    for (uint32_t i = 1; i < count; i++) {
        boxes_event x = e[i];
        uint32_t k = i;
        for (; k && e[k - 1].x > x.x; k--) e[k] = e[k - 1];
        e[k] = x;
    }
}

/** What all events of a new cell on one axis, still in the order of their fragments, tell of them. */
static void grade_events(boxes *b, const boxes_cell *cell, int axis) {
    boxes_event *e = b->events[axis].data + cell->event[axis];
    const boxes_fragment *item = b->fragments.data + cell->first;
    for (uint32_t i = 0; i < cell->events[axis]; i++) grade(e + i, item[e[i].fragment].alive, axis);
}

/** Sorts the events of a new cell on one axis. */
static bool sort_events(boxes *b, const boxes_cell *cell, int axis) {
    uint32_t count = cell->events[axis];
    boxes_event *e = b->events[axis].data + cell->event[axis];
    if (count <= INSERTION) {
        if (count) insert_sorted(e, count);
        return true;
    }
    b->pairs.count = b->spare_events.count = 0;
    if (!array_reserve(&b->alloc, &b->pairs, 2 * (size_t)count) || !array_reserve(&b->alloc, &b->spare_events, count))
        return false;
    base_pair *pairs = b->pairs.data;
    for (uint32_t i = 0; i < count; i++) pairs[i] = (base_pair){base_double_key(e[i].x), i};
    memcpy(b->spare_events.data, e, count * sizeof *e);
    base_radix_sort(pairs, pairs + count, count);
    for (uint32_t i = 0; i < count; i++) e[i] = b->spare_events.data[pairs[i].value];
    return true;
}

froe_status boxes_open(boxes *b, boxes_cell cell, const uint32_t *objects, uint32_t count) {
    cell.first = (uint32_t)b->fragments.count;
    cell.count = 0;
    if (b->fragments.count + count > BOXES_MOST) return FROE_E_LIMIT;
    if (!array_reserve(&b->alloc, &b->fragments, count)) return FROE_E_MEMORY;
    for (int k = 0; k < b->dim; k++) {
        cell.event[k] = b->events[k].count;
        cell.events[k] = 0;
        if (!array_reserve(&b->alloc, &b->events[k], 4 * (size_t)count)) return FROE_E_MEMORY;
    }
    for (uint32_t i = 0; i < count; i++) {
        boxes_fragment f = {.object = objects[i]};
        double end[FROE_MAX_DIM][4];
        boxes_ends(b, objects[i], end);
        for (int k = 0; k < b->dim; k++) note_axis(b, &cell, k, end[k], &f);
        if (f.inside) {
            b->fragments.data[b->fragments.count++] = f;
            cell.count++;
        } else if (!boxes_add_cover(b, &cell, f.object)) /* it has no events */
            return FROE_E_MEMORY;
    }
    for (int k = 0; k < b->dim; k++) {
        grade_events(b, &cell, k);
        if (!sort_events(b, &cell, k)) return FROE_E_MEMORY;
    }
    return array_push(&b->alloc, &b->cells, cell) ? FROE_OK : FROE_E_MEMORY;
}

void boxes_drop(boxes *b, const boxes_cell *cell) {
    b->fragments.count = cell->first;
    for (int k = 0; k < b->dim; k++) b->events[k].count = cell->event[k];
}

/* --------------------------------------------------------------- dividing it -- */

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

/** Deals the fragments: those above close up in place, those below go on top of them. */
static bool deal_fragments(boxes *b, const boxes_cell *cell, const boxes_cut *cut, boxes_cell side[2]) {
    boxes_fragment *item = b->fragments.data + cell->first;
    boxes_parts *parts = b->parts.data;
    bool ok = true;
    b->fragments.count = cell->first;
    for (uint32_t i = 0; i < cell->count && ok; i++) {
        boxes_fragment whole = item[i];
        unsigned mark = b->marks.data[i];
        for (int s = 0; s < 2; s++) {
            parts[i].name[s] = FROE_NONE;
            parts[i].alive[s] = parts[i].was = whole.alive;
            if (!(mark & (s ? MARK_ABOVE : MARK_BELOW))) continue;
            boxes_fragment f = part(whole, mark, s, cut->axis);
            if (!f.inside) {
                ok = ok && boxes_add_cover(b, &side[s], f.object);
                continue;
            }
            parts[i].name[s] = side[s].count++;
            parts[i].alive[s] = f.alive;
            (s ? item : b->spare.data)[parts[i].name[s]] = f;
        }
    }
    if (side[0].count) memcpy(item + side[1].count, b->spare.data, side[0].count * sizeof *item);
    side[0].first = side[1].first + side[1].count;
    b->fragments.count = (size_t)side[0].first + side[0].count;
    return ok;
}

/** Writes the event as a side sees it; returns 1 if it is there: its fragment and, on the axis of the cut, its end. No
 * branches on that, which nobody could predict: what is not there will be written over. */
static size_t hand_on(const boxes_event *e, const boxes_parts *parts, bool above, bool in, int axis, boxes_event *to) {
    *to = *e;
    to->fragment = parts->name[above];
    if (parts->alive[above] != parts->was) grade(to, parts->alive[above], axis);
    return in & (parts->name[above] != FROE_NONE);
}

static bool deal_events(boxes *b, const boxes_cell *cell, const boxes_cut *cut, int axis, boxes_cell side[2]) {
    uint32_t count = cell->events[axis];
    size_t above = 0, below = 0;
    b->spare_events.count = 0;
    if (!array_reserve(&b->alloc, &b->spare_events, (size_t)count + 1) ||
        !array_reserve(&b->alloc, &b->events[axis], count))
        return false;
    boxes_event *item = b->events[axis].data + cell->event[axis], *spare = b->spare_events.data;
    bool other = axis != cut->axis;
    for (uint32_t i = 0; i < count; i++) {
        boxes_event e = item[i];
        const boxes_parts *parts = b->parts.data + e.fragment;
        above += hand_on(&e, parts, true, other | (e.x > cut->c), axis, item + above); /* at most item[i] */
        below += hand_on(&e, parts, false, other | (e.x < cut->c), axis, spare + below);
    }
    side[1].events[axis] = (uint32_t)above;
    side[0].events[axis] = (uint32_t)below;
    side[0].event[axis] = cell->event[axis] + above;
    if (below) memcpy(item + above, spare, below * sizeof *item);
    b->events[axis].count = side[0].event[axis] + below;
    return true;
}

/** Lists the boxes without extent that lie in the cut. */
static froe_status emit_in_cut(boxes *b, const boxes_cell *cell) {
    const boxes_fragment *item = b->fragments.data + cell->first;
    froe_status status = FROE_OK;
    bool begun = false;
    for (uint32_t i = 0; i < cell->count && !status; i++) {
        if (b->marks.data[i]) continue;
        if (!begun) status = draft_list(&b->draft, cell->node);
        begun = true;
        if (!status) status = draft_piece(&b->draft, cell->node, item[i].object, NULL, 0);
    }
    return status;
}

/** The weight of what a forced cut divides, but for boxes with both rooms: those pay for themselves. */
static void pay(boxes *b, const boxes_cell *cell, const boxes_cut *cut) {
    for (uint32_t i = 0; i < cell->count && cut->forced; i++) {
        uint16_t alive = b->fragments.data[cell->first + i].alive;
        bool divided = (b->marks.data[i] & 3) == 3, both = (alive >> 2 * cut->axis & 3) == 3;
        if (divided && !both) b->paid += (uint64_t)boxes_weight(b, alive, cut->axis);
    }
}

froe_status boxes_split_node(boxes *b, uint32_t node, const boxes_cut *cut, uint32_t *child) {
    froe_cut plane = {.kind = FROE_CUT_AXIS, .axis = cut->axis, .value = cut->c};
    return draft_split(&b->draft, node, &plane, 0, child);
}

static bool make_room(boxes *b, const boxes_cell *cell) {
    b->marks.count = b->parts.count = b->spare.count = 0;
    return array_reserve(&b->alloc, &b->marks, cell->count) && array_reserve(&b->alloc, &b->parts, cell->count) &&
           array_reserve(&b->alloc, &b->spare, cell->count) && array_reserve(&b->alloc, &b->fragments, cell->count) &&
           array_reserve(&b->alloc, &b->cells, 2);
}

froe_status boxes_divide(boxes *b, const boxes_cell *cell, const boxes_cut *cut) {
    uint32_t child = 0;
    if (b->fragments.count + cell->count > BOXES_MOST) return FROE_E_LIMIT;
    if (!make_room(b, cell)) return FROE_E_MEMORY;
    mark(b, cell, cut);
    pay(b, cell, cut);
    froe_status status = boxes_split_node(b, cell->node, cut, &child);
    if (!status) status = emit_in_cut(b, cell);
    if (status) return status;
    boxes_cell side[2] = {*cell, *cell};
    for (uint32_t s = 0; s < 2; s++) {
        side[s].node = child + s;
        side[s].count = 0;
        (s ? side[s].lo : side[s].hi)[cut->axis] = cut->c;
    }
    bool ok = deal_fragments(b, cell, cut, side);
    for (int k = 0; k < b->dim && ok; k++) ok = deal_events(b, cell, cut, k, side);
    if (!ok) return FROE_E_MEMORY;
    b->cells.data[b->cells.count++] = side[1];
    b->cells.data[b->cells.count++] = side[0];
    return FROE_OK;
}
