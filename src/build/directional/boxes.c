/* boxes.c: filling cells with boxes. */
#include "build/directional/boxes.h"
#include <string.h>

enum {
    INSERTION = 24, /* so few events are sorted by insertion */
    CHANGES = FROE_MAX_DIM * BOXES_SOME
};

/* ----------------------------------------------------------------- weights -- */

int64_t boxes_weight(const boxes *b, uint16_t alive, int axis) {
    uint32_t some, both;
    boxes_count_rooms(alive & ~(3u << 2 * axis), &some, &both);
    return b->weight[some][both];
}

/** The change at an end, with these rooms alive on the axis, of a box of this weight. */
static boxes_change change(boxes_end end, unsigned rooms, int64_t weight, int64_t trade) {
    switch (end) {
    case BOXES_BEFORE:
        return (boxes_change){.slack = {trade * weight, 0}};
    case BOXES_LO:
        return (boxes_change){{0, -weight - (rooms & 1 ? trade * weight : 0)}, {0, 1}, 0, 1};
    case BOXES_HI:
        return (boxes_change){{weight + (rooms & 2 ? trade * weight : 0), 0}, {-1, 0}, 1, 0};
    case BOXES_AFTER:
        return (boxes_change){.slack = {0, -trade * weight}};
    case BOXES_FLAT:
        return (boxes_change){.below = 1, .above = 1};
    }
    return (boxes_change){.below = 0};
}

froe_status boxes_new(const froe_scene *scene, const froe_allocator *alloc, const boxes_options *options, boxes *out) {
    *out = (boxes){.scene = scene, .alloc = *alloc, .dim = scene->dim, .options = *options};
    for (int some = 0; some <= scene->dim; some++) {
        out->weight[some][0] = some ? out->weight[some - 1][0] * (1 + options->trade) : 1;
        for (int both = 1; both <= some; both++) out->weight[some][both] = 2 * out->weight[some][both - 1];
    }
    froe_status status = draft_new(alloc, scene->dim, 0, &out->draft);
    if (status) return status;
    out->changes = support_calloc(alloc, CHANGES, sizeof *out->changes);
    if (!out->changes) return FROE_E_MEMORY;
    for (uint32_t i = 0; i < CHANGES; i++) {
        uint32_t some = i / BOXES_SOME, both = i % BOXES_SOME / BOXES_BOTH, rooms = i % BOXES_BOTH / BOXES_ROOMS;
        out->changes[i] = change((boxes_end)(i % BOXES_ROOMS), rooms, out->weight[some][both], options->trade);
    }
    return FROE_OK;
}

void boxes_free(boxes *b) {
    if (b->draft.nodes.data) draft_free(&b->draft);
    for (int k = 0; k < b->dim; k++) array_free(&b->alloc, &b->events[k]);
    support_free(&b->alloc, b->changes, CHANGES * sizeof *b->changes);
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

/** The number of the change at an end of a fragment. */
static uint16_t change_at(boxes_end end, uint16_t alive, int axis) {
    uint32_t some, both;
    boxes_count_rooms(alive & ~(3u << 2 * axis), &some, &both);
    return (uint16_t)(some * BOXES_SOME + both * BOXES_BOTH + (alive >> 2 * axis & 3u) * BOXES_ROOMS + end);
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
static void note_box_end(boxes *b, boxes_cell *cell, int axis, boxes_end end, double x) {
    b->events[axis].data[b->events[axis].count++] = (boxes_event){.x = x, .fragment = cell->count, .end = (uint8_t)end};
    cell->events[axis]++;
}

/** What a box has on one axis strictly inside the cell. */
static void note_axis(boxes *b, boxes_cell *cell, int axis, const double end[4], boxes_fragment *f) {
    double lo = end[BOXES_LO], hi = end[BOXES_HI], least = cell->lo[axis], most = cell->hi[axis];
    if (lo == hi) {
        f->inside |= (uint16_t)(3u << 2 * axis);
        b->flat = true;
        note_box_end(b, cell, axis, BOXES_FLAT, lo);
        return;
    }
    bool inside[2] = {lo > least, hi < most};
    bool alive[2] = {end[BOXES_BEFORE] > least && end[BOXES_BEFORE] < lo,
                     end[BOXES_AFTER] < most && end[BOXES_AFTER] > hi};
    f->inside |= (uint16_t)((inside[0] | inside[1] << 1) << 2 * axis);
    f->alive |= (uint16_t)((alive[0] | alive[1] << 1) << 2 * axis);
    if (alive[0]) note_box_end(b, cell, axis, BOXES_BEFORE, end[BOXES_BEFORE]);
    if (inside[0]) note_box_end(b, cell, axis, BOXES_LO, lo);
    if (inside[1]) note_box_end(b, cell, axis, BOXES_HI, hi);
    if (alive[1]) note_box_end(b, cell, axis, BOXES_AFTER, end[BOXES_AFTER]);
}

bool boxes_add_cover(boxes *b, boxes_cell *cell, uint32_t object) {
    if (!array_push(&b->alloc, &b->covers, (boxes_cover){object, cell->cover})) return false;
    cell->cover = (uint32_t)b->covers.count - 1;
    cell->covers++;
    return true;
}

/** Sorts the events of a new cell on one axis. */
static bool sort_events(boxes *b, const boxes_cell *cell, int axis) {
    uint32_t count = cell->events[axis];
    boxes_event *e = b->events[axis].data + cell->event[axis];
    if (count <= INSERTION) {
        if (count) {
            /* insertion sort: few events */
            for (uint32_t i = 1; i < count; i++) {
                boxes_event x = e[i];
                uint32_t k = i;
                for (; k && e[k - 1].x > x.x; k--) e[k] = e[k - 1];
                e[k] = x;
            }
        }
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
        /* of all events of a new cell on one axis, still in the order of their fragments */
        boxes_event *e = b->events[k].data + cell.event[k];
        const boxes_fragment *item = b->fragments.data + cell.first;
        for (uint32_t i = 0; i < cell.events[k]; i++)
            e[i].change = change_at((boxes_end)e[i].end, item[e[i].fragment].alive, k);
        if (!sort_events(b, &cell, k)) return FROE_E_MEMORY;
    }
    return array_push(&b->alloc, &b->cells, cell) ? FROE_OK : FROE_E_MEMORY;
}

void boxes_drop(boxes *b, const boxes_cell *cell) {
    b->fragments.count = cell->first;
    for (int k = 0; k < b->dim; k++) b->events[k].count = cell->event[k];
}
