/* boxes_axis.h: the boxes of one cell on one axis, added and removed one by one, and the best cut among them.
 *
 *     position    0 | 1   2   3   4   5 ... | size + 1      the ends of the boxes when this was made, numbered; 0 and
 *                 border of the cell    border              size + 1 stand for all beyond the borders of the cell
 *     slack       trade * rooms - boxes divided, weighted:   a lemma cut is where it is >= 0
 *     least       - boxes divided, at positions of faces;    a free cut is where it is 0
 *     reach       by beginning: where boxes end;             from it all boxes across a cut are read off
 *     before      by beginning: where their rooms before begin, counted from size + 1 downwards
 *     after       by end: where their rooms after end, or they themselves
 *
 * Sums with a fixed trade commute with maxima; quotients, which Tobola and Nechvile store, do not. All positions stay
 * when the cell becomes smaller; what lies outside is never asked for. */
#ifndef FROE_BUILD_DIRECTIONAL_BOXES_AXIS_H
#define FROE_BUILD_DIRECTIONAL_BOXES_AXIS_H
#include "base/fenwick.h"
#include "base/max_tree.h"
#include "build/directional/boxes.h"

/** Positions of a box, in the order of boxes_end, and its places in the orders by beginning and by end. */
typedef struct boxes_places {
    uint32_t at[4], rank[2];
} boxes_places;

typedef struct boxes_axis {
    uint32_t size, count; /**< positions; boxes */
    double *x;            /**< [size + 4], coordinates of 1 .. size */
    uint32_t *faces;      /**< [size + 4], faces at each position */
    boxes_places *places; /**< [count] */
    uint32_t *first[2];   /**< [size + 4], by beginning and by end: how many boxes have it before a position */
    uint32_t *order[2];   /**< [count], the boxes in these orders */
    base_fenwick ends[2]; /**< beginnings and ends inside the cell */
    base_max_tree slack, least, reach, before, after;
} boxes_axis;

/** Best cuts on an axis, with their positions. */
typedef struct boxes_spot {
    boxes_cut cut;
    uint32_t at;
} boxes_spot;

/** Takes the places of all boxes of a cell from its events; no box is in it yet. FROE_E_MEMORY; free it all the same.
 */
froe_status boxes_axis_new(const boxes *b, const boxes_cell *cell, int axis, boxes_axis *out);
void boxes_axis_free(const froe_allocator *alloc, boxes_axis *a);

/** Adds (weight > 0) or takes away (weight < 0) what a box divides and pays; alive: bits 0 and 1, its rooms. */
void boxes_axis_weigh(boxes_axis *a, uint32_t box, unsigned alive, int64_t weight, int64_t trade);
/** Adds (there) or removes a box everywhere but in the slack. */
void boxes_axis_list(boxes_axis *a, uint32_t box, unsigned alive, bool there);
/** Forgets a room: 0 before, 1 after. The weights are the caller's. */
void boxes_axis_forget_room(boxes_axis *a, uint32_t box, int room);

/** Boxes wholly below and above a position strictly inside the cell. */
static inline uint32_t boxes_axis_below(const boxes_axis *a, uint32_t at) {
    return base_fenwick_prefix(&a->ends[1], at);
}
static inline uint32_t boxes_axis_above(const boxes_axis *a, uint32_t at) {
    return a->ends[0].total - base_fenwick_prefix(&a->ends[0], at - 1);
}
/** The best cuts strictly between two positions; anywhere: also with boxes on one side only. */
void boxes_axis_best(const boxes_axis *a, int axis, uint32_t lo, uint32_t hi, bool anywhere, boxes_spot *least,
                     boxes_spot *lemma);
/** The face that divides fewest with so many boxes on both sides, if rooms pay for it. */
void boxes_axis_narrow(const boxes_axis *a, int axis, uint32_t lo, uint32_t hi, uint32_t least, boxes_spot *out);
#endif
