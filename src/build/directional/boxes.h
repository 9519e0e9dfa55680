/* boxes.h: boxes in a cell, each with the room beside it, seen along one axis at a time.
 *
 *      before         lo     the box      hi         after
 *         [............[==================]............]         room: delta times the side, as it was before
 *                                                                any cut, on both sides; closed intervals
 *              |                          |
 *           a cut here ends            a cut here divides nothing
 *           the room before
 *
 * A room is alive as long as no cut has touched it: while it lies strictly inside the cell. A cut may divide boxes
 * in exchange for rooms, which die for ever: that bounds how often (Tobola and Nechvile, lemma 3.3). Alive is
 * what the coordinates say, so fragments carry no history.
 *
 *     fragments         [ ... | of a cell | ... | of the current cell ]
 *     events[axis]      [ ... | ends on the axis, ascending | ... | of the current cell ]
 *
 * An event is an end strictly inside the cell; those of rooms only as long as they are alive. */
#ifndef FROE_BUILD_DIRECTIONAL_BOXES_H
#define FROE_BUILD_DIRECTIONAL_BOXES_H
#include "base/radix.h"
#include "base/task.h"
#include "scene/scene.h"
#include "support/array.h"
#include "tree/draft.h"

#define BOXES_MOST (1u << 30) /**< fragments on the stack: far below what node and piece numbers allow */

typedef enum boxes_end { BOXES_BEFORE, BOXES_LO, BOXES_HI, BOXES_AFTER, BOXES_FLAT } boxes_end;

typedef struct boxes_event {
    double x;
    uint32_t fragment; /**< counted from the cell's first */
    uint16_t change;   /**< what it changes in a sweep: see boxes_change */
    uint8_t end;       /**< boxes_end; FLAT: a box without extent on this axis, both of its ends */
} boxes_event;

/** What changes in a sweep along an axis at an event: [0] on arriving there, [1] on leaving it behind. The same for
 * all events of one kind of end, with the same rooms alive on the axis, and as many axes besides on which a room is
 * alive, and both are: these number the changes. So a sweep reads events and a small table. */
typedef struct boxes_change {
    int64_t slack[2];   /**< trade * rooms - boxes divided, weighted */
    int32_t divided[2]; /**< boxes */
    uint32_t below, above;
} boxes_change;

/** Steps of their numbers. */
enum { BOXES_ROOMS = 5, BOXES_BOTH = 4 * BOXES_ROOMS, BOXES_SOME = FROE_MAX_DIM * BOXES_BOTH };

typedef struct boxes_fragment {
    uint32_t object;
    uint16_t inside; /**< bits 2 k, 2 k + 1: are lo and hi on axis k strictly inside the cell? */
    uint16_t alive;  /**< bits 2 k, 2 k + 1: are the rooms before and after alive? */
} boxes_fragment;

/** What becomes of a fragment in a cut, below and above. */
typedef struct boxes_parts {
    uint32_t name[2];    /**< counted from the first of its side, or FROE_NONE: not there, or a cover */
    int16_t shift[2][2]; /**< [side]: from the numbers of its changes to those there, [1] on the axis of the cut */
} boxes_parts;

/** A box that covers a cell, but not the cell above. It is listed at the node of the cell. */
typedef struct boxes_cover {
    uint32_t object, next; /**< next: of the same cell, or FROE_NONE */
} boxes_cover;

typedef struct boxes_cell {
    uint32_t node;
    uint32_t first, count; /**< fragments */
    uint32_t cover, covers;
    size_t event[FROE_MAX_DIM];
    uint32_t events[FROE_MAX_DIM];
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
} boxes_cell;

/** A cut x[axis] = c with what it does: boxes wholly below, wholly above (flat ones in the cut are both), divided. */
typedef struct boxes_cut {
    bool found;
    bool crowded; /**< not found, because to separate the boxes would not pay (tree/crowd.h) */
    bool forced;  /**< no lemma bounds what it divides */
    int axis;
    double c;
    uint32_t below, above, divided;
} boxes_cut;

typedef struct boxes_options {
    double delta;   /**< room per side */
    int64_t trade;  /**< weight of boxes that may be divided for one weight of rooms */
    double balance; /**< of a free cut, at least this share of that of a lemma cut; 0: any */
    double slack;   /**< balance given up to divide less: a share of it */
    bool faces;     /**< until no face is left in a cell, in place of: until no cut separates boxes */
    uint32_t leaf;  /**< boxes that a leaf may have besides covers */
} boxes_options;

typedef struct boxes {
    const froe_scene *scene;
    froe_allocator alloc;
    int dim;
    boxes_options options;
    tree_draft draft;
    uint64_t paid;  /**< weight of what forced cuts divided: see boxes_bound() */
    uint64_t taken; /**< boxes that sweeps and trees took up, cell by cell */
    bool flat;      /**< is any box without extent on some axis? */
    ARRAY(boxes_fragment) fragments;
    ARRAY(boxes_event) events[FROE_MAX_DIM];
    ARRAY(boxes_cell) cells;
    ARRAY(boxes_cover) covers;
    int64_t weight[FROE_MAX_DIM + 1][FROE_MAX_DIM + 1]; /**< [some][both]: axes with a room alive, with both */
    boxes_change *changes;
    /* scratch of the cell at hand */
    ARRAY(uint16_t) marks;
    ARRAY(boxes_parts) parts;
    ARRAY(uint32_t) objects;
    ARRAY(boxes_fragment) spare;
    ARRAY(boxes_event) spare_events;
    ARRAY(base_pair) pairs;
} boxes;

/** FROE_E_MEMORY; free it whatever happens. */
froe_status boxes_new(const froe_scene *scene, const froe_allocator *alloc, const boxes_options *options, boxes *out);
void boxes_free(boxes *b);

/** Ends on all axes, in the order of boxes_end. Computed once, in doubles: whatever rounding does, a box is the same
 * in every cell. */
void boxes_ends(const boxes *b, uint32_t object, double end[FROE_MAX_DIM][4]);
/** Pushes a cell whose node, bounds and covers are given, and fills it with what `count` ascending objects, each with
 * a point strictly inside, have in it. */
froe_status boxes_open(boxes *b, boxes_cell cell, const uint32_t *objects, uint32_t count);
/** Replaces the cell on top, taken off b->cells, by its children; emits what lies in the cut. */
froe_status boxes_divide(boxes *b, boxes_cell *cell, const boxes_cut *cut);
/** Takes the fragments and events of the topmost cell off their stacks. */
void boxes_drop(boxes *b, const boxes_cell *cell);
/** One more box that covers the cell. */
bool boxes_add_cover(boxes *b, boxes_cell *cell, uint32_t object);
/** Makes the cell's node inner, x[axis] = c, and lists the covers of the cell there. */
froe_status boxes_split_node(boxes *b, boxes_cell *cell, const boxes_cut *cut, uint32_t *child);
/** Begins the list of a node, a leaf or split, with the covers of the cell, which then has none. */
froe_status boxes_list_covers(boxes *b, boxes_cell *cell);

/** Weight of a fragment for cuts across `axis`: the product over the other axes of g[rooms alive there],
 * g = 1, 1 + trade, 2 + 2 trade. With it no lemma cut and no cut that divides nothing raises the sum over all
 * fragments of the product over all axes; at the start that is at most boxes_bound(), and each fragment counts 1 at
 * least: so there are never more fragments than that, and what forced cuts divided (paid). */
int64_t boxes_weight(const boxes *b, uint16_t alive, int axis);
/** On how many axes are rooms alive (*some), and both (*both)? */
static inline void boxes_count_rooms(unsigned alive, uint32_t *some, uint32_t *both) {
    unsigned one = (alive | alive >> 1) & 0x5555, two = alive & alive >> 1 & 0x5555;
    one = (one & 0x3333) + (one >> 2 & 0x3333), two = (two & 0x3333) + (two >> 2 & 0x3333);
    *some = (one * 0x1111u >> 12) & 15, *both = (two * 0x1111u >> 12) & 15;
}
/** n (2 + 2 trade)^dim, or 0 where weights would not fit. */
double boxes_bound(const boxes *b, uint32_t n);

/** Is `a`, beside what was found so far on the same axis, walking upwards, the better one? See boxes_sweep.c. */
bool boxes_better_on_axis(const boxes_cut *a, const boxes_cut *best, bool fewest);
/** Is `a` better than the best of the axes before? */
bool boxes_better(const boxes_cut *a, const boxes_cut *best, bool fewest);
/** Of what two stages found (`least`: fewest divided; `lemma`: paid for by rooms), is the first one free? */
bool boxes_free_cut(const boxes *b, const boxes_cut *least, const boxes_cut *lemma);
/** How many boxes on both sides of a cell of `count` are enough for a lemma cut that divides less; 0: the one found
 * will be taken as it is. Such a cut is the face that divides fewest on its axis, if rooms pay for it: not the best of
 * all cuts that rooms pay for, which no tree finds in logarithmic time. */
uint32_t boxes_narrow(const boxes *b, uint32_t count, const boxes_cut *least, const boxes_cut *lemma);
/** The choice between what both stages found. */
boxes_cut boxes_decide(const boxes *b, const boxes_cut *least, const boxes_cut *lemma);
/** What boxes of a cell reach over within it, and whether one of them holds all of that. */
typedef struct boxes_extent {
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    uint32_t tried; /**< boxes with one outermost face */
    bool held;
} boxes_extent;

enum { BOXES_CROWD = 64 }; /* boxes in a crowded leaf, at most */

/** Has a cell so many boxes that one of them is worth being peeled off? */
bool boxes_may_peel(uint32_t count);
/** Looks at one more of the boxes with a certain outermost face, of which one must be that which holds all. False:
 * that is enough of them, and none is taken for it. */
bool boxes_hold(const boxes *b, uint32_t object, boxes_extent *extent);
/** A cut along a face of a box that holds all others in the cell: it divides none, and after 2 d of them the box is a
 * cover. O(boxes). */
boxes_cut boxes_peel(const boxes *b, const boxes_cell *cell);
/** Is a cell of these objects, whose best cut is not free, better left as a crowded leaf? O(BOXES_CROWD^2). */
bool boxes_crowd(const boxes *b, const boxes_cut *cut, const uint32_t *objects, uint32_t count);
/** The cut of a cell by sweeping over its events; not found: it is a leaf. O(events). */
boxes_cut boxes_sweep(const boxes *b, const boxes_cell *cell);

/** Cuts the cell on top, taken off b->cells, until half of its fragments are left, in trees that add and remove single
 * boxes: the same cuts as sweeps, in time for the smaller side of each. Pushes all cells that result. */
froe_status boxes_carve(boxes *b, const boxes_cell *cell, base_task *task);
#endif
