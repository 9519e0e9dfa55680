/* boxes_carve.c: cutting small parts off a large cell, at the price of the small parts.
 *
 *     +--+-----------------------------+
 *     |  |   what is left stays in its |      nested boxes, rows, stairs: a sweep over all events for each cut would
 *     |  |   trees (boxes_axis.h)      |      be quadratic. Here a cut takes the boxes of the smaller side out of the
 *     +--+-----------------------------+      trees, O(d log^2 n) each, and opens a cell for them.
 *
 * (Tobola and Nechvile, section 5.2: the smaller half is rebuilt.) A box that is taken out lands in a cell of at most
 * half the fragments, and when half are left the rest is opened again, too: so each pays O(log n) times. */
#include "base/sort.h"
#include "build/directional/boxes_axis.h"

typedef ARRAY(uint32_t) carve_list; /* of boxes, as they are numbered in the cell */

typedef struct carve {
    boxes *b;
    boxes_cell cell;                             /* what is left: node, bounds, covers */
    uint32_t count, left;                        /* boxes at first; now */
    uint32_t lo[FROE_MAX_DIM], hi[FROE_MAX_DIM]; /* its bounds as positions */
    boxes_fragment *fragments;                   /* [count] */
    bool *gone;                                  /* [count] */
    boxes_axis axis[FROE_MAX_DIM];
    carve_list small, divided, changed, covers, spare;
} carve;

/* ------------------------------------------------------------------ the trees -- */

static unsigned rooms(const carve *c, uint32_t box, int axis) {
    return c->fragments[box].alive >> 2 * axis & 3u;
}

static void weigh_box(carve *c, uint32_t box, int axis, int sign) {
    int64_t weight = boxes_weight(c->b, c->fragments[box].alive, axis);
    boxes_axis_weigh(c->axis + axis, box, rooms(c, box, axis), sign * weight, c->b->options.trade);
}

static void give(carve *c, uint32_t box, bool there) {
    for (int k = 0; k < c->b->dim; k++) {
        weigh_box(c, box, k, there ? 1 : -1);
        boxes_axis_list(c->axis + k, box, rooms(c, box, k), there);
    }
    c->gone[box] = !there;
    c->left += there ? 1 : UINT32_MAX;
}

/* A room dies: the box weighs less on the other axes. */
static void kill_room(carve *c, uint32_t box, int axis, int room) {
    if (!(rooms(c, box, axis) >> room & 1)) return;
    for (int k = 0; k < c->b->dim; k++) weigh_box(c, box, k, -1);
    boxes_axis_forget_room(c->axis + axis, box, room);
    c->fragments[box].alive &= (uint16_t) ~(1u << (2 * axis + room));
    for (int k = 0; k < c->b->dim; k++) weigh_box(c, box, k, 1);
}

static froe_status begin_carving(carve *c, const boxes_cell *cell) {
    boxes *b = c->b;
    const froe_allocator *alloc = &b->alloc;
    c->fragments = support_calloc(alloc, c->count, sizeof *c->fragments);
    c->gone = support_calloc(alloc, c->count, sizeof *c->gone);
    if (!c->fragments || !c->gone) return FROE_E_MEMORY;
    for (uint32_t i = 0; i < c->count; i++) c->fragments[i] = b->fragments.data[cell->first + i];
    for (int k = 0; k < b->dim; k++) {
        froe_status status = boxes_axis_new(b, cell, k, c->axis + k);
        if (status) return status;
        c->hi[k] = c->axis[k].size + 1;
    }
    for (uint32_t i = 0; i < c->count; i++) give(c, i, true);
    return FROE_OK;
}

/* ------------------------------------------------------------------ reading off -- */

/* Boxes in [from, end) of an order (0 by beginning, 1 by end) whose number in `tree` is at least `level`. */
static bool collect_boxes(const carve *c, const boxes_axis *a, const base_max_tree *tree, int by, uint32_t from,
                          uint32_t end, int64_t level, carve_list *out) {
    for (; (from = base_max_tree_first(tree, from, end, level)) != BASE_MAX_TREE_NONE; from++)
        if (!array_push(&c->b->alloc, out, a->order[by][from])) return false;
    return true;
}

/* Boxes that begin (by 0) or end (1) at a position. */
static bool collect_at(const carve *c, const boxes_axis *a, int by, uint32_t at, carve_list *out) {
    for (uint32_t i = a->first[by][at]; i < a->first[by][at + 1]; i++)
        if (!c->gone[a->order[by][i]] && !array_push(&c->b->alloc, out, a->order[by][i])) return false;
    return true;
}

static int compare_numbers(void *user, uint32_t a, uint32_t b) {
    (void)user;
    return a < b ? -1 : a > b;
}

static bool sort_carve_list(carve *c, carve_list *list) {
    c->spare.count = 0;
    if (!array_reserve(&c->b->alloc, &c->spare, list->count)) return false;
    if (list->count) base_merge_sort(list->data, c->spare.data, list->count, compare_numbers, NULL);
    return true;
}

/* Opens a cell with these boxes, ascending. */
static froe_status open_cell(carve *c, const boxes_cell *cell, const carve_list *list) {
    boxes *b = c->b;
    b->objects.count = 0;
    if (!array_reserve(&b->alloc, &b->objects, list->count)) return FROE_E_MEMORY;
    for (size_t i = 0; i < list->count; i++) b->objects.data[i] = c->fragments[list->data[i]].object;
    return boxes_open(b, *cell, b->objects.data, (uint32_t)list->count);
}

/* ----------------------------------------------------------------------- one cut -- */

/* Lists the boxes without extent that lie in the cut, and takes them away. begun: is the list? */
static froe_status emit_carved_in_cut(carve *c, const boxes_axis *a, uint32_t at, bool begun) {
    boxes *b = c->b;
    froe_status status = FROE_OK;
    c->changed.count = 0;
    if (!collect_at(c, a, 0, at, &c->changed) || !sort_carve_list(c, &c->changed)) return FROE_E_MEMORY;
    for (size_t i = 0; i < c->changed.count && !status; i++) {
        uint32_t box = c->changed.data[i];
        if (a->places[box].at[BOXES_HI] != at) continue;
        if (!begun) status = draft_list(&b->draft, c->cell.node);
        begun = true;
        if (!status) status = draft_piece(&b->draft, c->cell.node, c->fragments[box].object, NULL, 0);
        give(c, box, false);
    }
    return status;
}

/* What the cut does to the boxes that stay: rooms that it touches die, faces in it are faces inside no more. */
static bool touch_rooms(carve *c, int axis, uint32_t at, bool above) {
    boxes_axis *a = c->axis + axis;
    c->changed.count = c->covers.count = 0;
    bool ok = collect_boxes(c, a, &a->before, 0, a->first[0][at], c->count, (int64_t)a->size + 1 - at, &c->changed);
    size_t before = c->changed.count;
    ok = ok && collect_boxes(c, a, &a->after, 1, 0, a->first[1][at + 1], at, &c->changed);
    for (size_t i = 0; i < c->changed.count && ok; i++) kill_room(c, c->changed.data[i], axis, i >= before);
    c->changed.count = 0;
    ok = ok && collect_at(c, a, above, at, &c->changed);
    for (size_t i = 0; i < c->divided.count && ok; i++) {
        kill_room(c, c->divided.data[i], axis, above);
        ok = array_push(&c->b->alloc, &c->changed, c->divided.data[i]);
    }
    for (size_t i = 0; i < c->changed.count && ok; i++) {
        boxes_fragment *f = c->fragments + c->changed.data[i];
        f->inside &= (uint16_t) ~(1u << (2 * axis + above));
        if (!f->inside) ok = array_push(&c->b->alloc, &c->covers, c->changed.data[i]);
    }
    return ok && sort_carve_list(c, &c->covers);
}

static froe_status cut_off_side(carve *c, const boxes_spot *spot) {
    boxes_axis *a = c->axis + spot->cut.axis;
    uint32_t child = 0, at = spot->at;
    bool above = boxes_axis_below(a, at) > boxes_axis_above(a, at); /* the smaller side, without those divided */
    const bool listed = c->cell.covers;
    froe_status status = boxes_split_node(c->b, &c->cell, &spot->cut, &child);
    if (!status) status = emit_carved_in_cut(c, a, at, listed);
    if (status) return status;
    /* the boxes across the cut, and all on the smaller side, these among them */
    uint32_t begun = a->first[0][at], ended = a->first[1][at + 1];
    c->small.count = c->divided.count = 0;
    bool ok = collect_boxes(c, a, &a->reach, 0, 0, begun, (int64_t)at + 1, &c->divided);
    ok = ok && (above ? collect_boxes(c, a, &a->after, 1, ended, c->count, 1, &c->small)
                      : collect_boxes(c, a, &a->reach, 0, 0, begun, 1, &c->small));
    if (!(ok && sort_carve_list(c, &c->small))) return FROE_E_MEMORY;
    /* what a forced cut costs */
    for (size_t i = 0; i < c->divided.count && spot->cut.forced; i++) {
        uint32_t box = c->divided.data[i];
        if (rooms(c, box, spot->cut.axis) == 3) continue;
        c->b->paid += (uint64_t)boxes_weight(c->b, c->fragments[box].alive, spot->cut.axis);
    }
    boxes_cell small = c->cell;
    small.node = child + above;
    (above ? small.lo : small.hi)[spot->cut.axis] = spot->cut.c;
    status = open_cell(c, &small, &c->small);
    if (status) return status;
    /* takes the smaller side out */
    for (size_t i = 0; i < c->small.count; i++) {
        const uint32_t *p = a->places[c->small.data[i]].at;
        bool divided = above ? p[BOXES_LO] < at : p[BOXES_HI] > at;
        if (!divided) give(c, c->small.data[i], false);
    }
    if (!touch_rooms(c, spot->cut.axis, at, above)) return FROE_E_MEMORY;
    /* the rest goes on as the larger child */
    (above ? c->cell.hi : c->cell.lo)[spot->cut.axis] = spot->cut.c;
    (above ? c->hi : c->lo)[spot->cut.axis] = at;
    c->cell.node = child + !above;
    for (size_t i = 0; i < c->covers.count; i++) {
        give(c, c->covers.data[i], false);
        if (!boxes_add_cover(c->b, &c->cell, c->fragments[c->covers.data[i]].object)) return FROE_E_MEMORY;
    }
    return FROE_OK;
}

/* As boxes_peel(). */
static bool find_peel(const carve *c, boxes_spot *out) {
    boxes_extent extent = {.held = false};
    uint32_t at[FROE_MAX_DIM][2]; /* the outermost faces; at the borders of the cell: those */
    if (!boxes_may_peel(c->left)) return false;
    for (int k = 0; k < c->b->dim; k++) {
        const boxes_axis *a = c->axis + k;
        const uint32_t first = a->order[0][base_max_tree_first(&a->reach, 0, c->count, 1)],
                       last = a->order[1][base_max_tree_last(&a->after, 0, c->count, 1)];
        const uint32_t lo = a->places[first].at[BOXES_LO], hi = a->places[last].at[BOXES_HI];
        at[k][0] = lo > c->lo[k] ? lo : c->lo[k];
        at[k][1] = hi < c->hi[k] ? hi : c->hi[k];
        extent.lo[k] = lo > c->lo[k] ? a->x[lo] : c->cell.lo[k];
        extent.hi[k] = hi < c->hi[k] ? a->x[hi] : c->cell.hi[k];
    }
    for (int k = 0; k < c->b->dim; k++)
        for (int side = 0; side < 2; side++) {
            const boxes_axis *a = c->axis + k;
            const uint32_t p = at[k][side], *first = a->first[side];
            bool more = true;
            if (p == (side ? c->hi : c->lo)[k]) continue;
            for (uint32_t i = first[p]; i < first[p + 1] && more; i++) {
                const uint32_t box = a->order[side][i], *end = a->places[box].at;
                if (!c->gone[box] && end[BOXES_LO] != end[BOXES_HI])
                    more = boxes_hold(c->b, c->fragments[box].object, &extent);
            }
            if (extent.held) *out = (boxes_spot){{.found = true, .axis = k, .c = a->x[p]}, p};
            return extent.held;
        }
    return false;
}

/* Is what is left a crowded leaf, if this is its best cut? */
static bool is_crowd(const carve *c, const boxes_cut *cut) {
    uint32_t objects[BOXES_CROWD], count = 0;
    if (c->left > BOXES_CROWD || !cut->divided) return false;
    for (uint32_t i = 0; i < c->count; i++)
        if (!c->gone[i]) objects[count++] = c->fragments[i].object;
    return boxes_crowd(c->b, cut, objects, count);
}

froe_status boxes_carve(boxes *b, const boxes_cell *cell, base_task *task) {
    carve c = {.b = b, .cell = *cell, .count = cell->count};
    froe_status status = begin_carving(&c, cell);
    boxes_drop(b, cell);
    while (!status && c.left > c.count / 2) {
        /* the best cut of all axes */
        boxes_spot least = {.at = 0}, lemma = {.at = 0};
        for (int k = 0; k < c.b->dim; k++) {
            boxes_spot here[2];
            boxes_axis_best(c.axis + k, k, c.lo[k], c.hi[k], c.b->options.faces, here, here + 1);
            if (boxes_better(&here[0].cut, &least.cut, true)) least = here[0];
            if (boxes_better(&here[1].cut, &lemma.cut, false)) lemma = here[1];
        }
        uint32_t enough = boxes_narrow(c.b, c.left, &least.cut, &lemma.cut);
        for (int k = 0; k < c.b->dim && enough; k++) {
            boxes_spot here;
            boxes_axis_narrow(c.axis + k, k, c.lo[k], c.hi[k], enough, &here);
            if (boxes_better(&here.cut, &lemma.cut, true)) lemma = here;
        }
        boxes_cut cut = boxes_decide(c.b, &least.cut, &lemma.cut);
        bool by_lemma = lemma.cut.found && cut.axis == lemma.cut.axis && cut.c == lemma.cut.c;
        boxes_spot spot = (boxes_spot){cut, by_lemma ? lemma.at : least.at};
        const bool free = boxes_free_cut(c.b, &least.cut, &lemma.cut), peels = !free && find_peel(&c, &spot);
        if (!spot.cut.found || (!free && !peels && is_crowd(&c, &spot.cut))) break;
        status = base_progress(task, task->done) ? cut_off_side(&c, &spot) : FROE_E_CANCELLED;
    }
    /* what is left becomes a cell again */
    const froe_allocator *alloc = &c.b->alloc;
    c.small.count = 0;
    if (!status && !array_reserve(alloc, &c.small, c.left)) status = FROE_E_MEMORY;
    for (uint32_t i = 0; i < c.count && !status; i++)
        if (!c.gone[i]) c.small.data[c.small.count++] = i;
    if (!status) status = open_cell(&c, &c.cell, &c.small);
    for (int k = 0; k < c.b->dim; k++) boxes_axis_free(alloc, c.axis + k);
    support_free(alloc, c.fragments, c.count * sizeof *c.fragments);
    support_free(alloc, c.gone, c.count * sizeof *c.gone);
    array_free(alloc, &c.small);
    array_free(alloc, &c.divided);
    array_free(alloc, &c.changed);
    array_free(alloc, &c.covers);
    array_free(alloc, &c.spare);
    return status;
}
