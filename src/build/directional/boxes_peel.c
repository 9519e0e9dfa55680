/* boxes_peel.c: where boxes hold or overlap each other: peeling one off, and leaving others together.
 *
 *     +-------------------+  a cut along each face of a box that holds     +------+      three boxes that mostly
 *     |  +--+    +-----+  |  all others in the cell divides none of        |   +--|---+  overlap: a cut between
 *     |  +--+    +-----+  |  them, and turns it into a cover. Any cut      +---|--+ --|--+  two of them divides
 *     +-------------------+  between the others would divide it.               +--|---+  | the others
 *
 * Concentric boxes, the example of Tobola and Nechvile (section 5), are peeled one after the other: a piece each.
 * Cells of few boxes are not worth the cuts. */
#include "build/directional/boxes.h"
#include "tree/crowd.h"
#include <math.h>

enum {
    PEEL_LEAST = 8, /* boxes in a cell: about as many as cuts that peel one off */
    HOLDERS = 16    /* so many boxes with one outermost face are looked at */
};
/* What one more piece costs, in comparisons with all of its cell (split/price.h). */
static const double COPY = 1;

bool boxes_may_peel(uint32_t count) {
    return count > PEEL_LEAST;
}

bool boxes_hold(const boxes *b, uint32_t object, boxes_extent *e) {
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    bool hold = e->tried++ < HOLDERS;
    scene_object_bounds(b->scene, object, lo, hi);
    for (int k = 0; k < b->dim && hold; k++) hold = lo[k] <= e->lo[k] && hi[k] >= e->hi[k];
    e->held = (e->held || hold) && e->tried <= HOLDERS;
    return e->tried <= HOLDERS;
}

/* -------------------------------------------------------------------- peeling -- */

/* The first and the last face on an axis, or the borders of the cell where boxes go beyond them. */
static void find_extent(const boxes *b, const boxes_cell *cell, int axis, bool beyond[2], boxes_extent *out) {
    const boxes_event *e = b->events[axis].data + cell->event[axis], *end = e + cell->events[axis];
    out->lo[axis] = cell->lo[axis];
    out->hi[axis] = cell->hi[axis];
    if (!beyond[0]) {
        while (e->end == BOXES_BEFORE || e->end == BOXES_AFTER) e++;
        out->lo[axis] = e->x;
    }
    if (!beyond[1]) {
        do end--;
        while (end->end == BOXES_BEFORE || end->end == BOXES_AFTER);
        out->hi[axis] = end->x;
    }
}

/* Is there a box that holds the extent, among those with a face on its side? side: 0 below, 1 above. */
static bool is_held(const boxes *b, const boxes_cell *cell, int axis, int side, boxes_extent *extent) {
    const boxes_event *e = b->events[axis].data + cell->event[axis];
    const uint32_t count = cell->events[axis];
    const double x = (side ? extent->hi : extent->lo)[axis];
    bool more = true;
    for (uint32_t i = 0; i < count && more; i++) {
        const boxes_event *at = e + (side ? count - 1 - i : i);
        if (side ? at->x < x : at->x > x) break;
        if (at->x == x && at->end == (side ? BOXES_HI : BOXES_LO))
            more = boxes_hold(b, b->fragments.data[cell->first + at->fragment].object, extent);
    }
    return extent->held;
}

boxes_cut boxes_peel(const boxes *b, const boxes_cell *cell) {
    boxes_extent extent = {.held = false};
    boxes_cut none = {.found = false};
    uint16_t inside = UINT16_MAX; /* of all boxes */
    if (!boxes_may_peel(cell->count)) return none;
    for (uint32_t i = 0; i < cell->count; i++) inside &= b->fragments.data[cell->first + i].inside;
    for (int k = 0; k < b->dim; k++) {
        bool beyond[2] = {!(inside >> 2 * k & 1), !(inside >> (2 * k + 1) & 1)};
        find_extent(b, cell, k, beyond, &extent);
    }
    for (int k = 0; k < b->dim; k++)
        for (int side = 0; side < 2; side++) {
            const double x = (side ? extent.hi : extent.lo)[k];
            if (x == (side ? cell->hi : cell->lo)[k]) continue;
            if (!is_held(b, cell, k, side, &extent)) return none; /* a box that holds all has a face there */
            return (boxes_cut){
                .found = true, .axis = k, .c = x, .below = side ? cell->count : 0, .above = side ? 0 : cell->count};
        }
    return none;
}

/* ------------------------------------------------------------------- crowding -- */

bool boxes_crowd(const boxes *b, const boxes_cut *cut, const uint32_t *objects, uint32_t count) {
    const double m = count, below = m - cut->above, above = m - cut->below;
    const bool pays = below * below + above * above + COPY * m * cut->divided <= m * m;
    if (b->options.faces || !cut->divided || pays || count > BOXES_CROWD || count <= b->options.leaf) return false;
    tree_crowd crowd = tree_crowd_of(count);
    while (!tree_crowd_known(&crowd)) {
        double lo[2][FROE_MAX_DIM], hi[2][FROE_MAX_DIM];
        bool apart = false;
        scene_object_bounds(b->scene, objects[crowd.a], lo[0], hi[0]);
        scene_object_bounds(b->scene, objects[crowd.b], lo[1], hi[1]);
        for (int k = 0; k < b->dim; k++) /* one has no extent on the axis, or they touch at most */
            apart |= fmin(hi[0][k], hi[1][k]) <= fmax(lo[0][k], lo[1][k]);
        tree_crowd_tell(&crowd, apart);
    }
    return tree_crowd_is(&crowd);
}
