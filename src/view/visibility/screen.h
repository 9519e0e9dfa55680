/* screen.h: the part of the picture that is still open, as a BSP of the screen: a beam tree
 * (Heckbert and Hanrahan 1984; Naylor, "Partitioning tree image representation", 1992).
 *
 *      +-------------+          Its cuts are lines of sight, planes through the eye: a beam is cut as exactly as
 *      |    /\ open  |          any fragment. Faces come front to back; each is cut by the tree, a part in
 *      |   /  \      |          an open leaf is visible, and an opaque face then covers it there.
 *      |  /####\     |
 *      +-------------+
 *
 * Beams are convex: a ring of corners in the order in which they turn left, each with the way, the directed line whose
 * positive side is inside, that leaves it. Corner i is the meeting of ways i - 1 and i, or a vertex.
 *
 * TILES. The sides of a face that covers an open leaf go on as cuts through all of the leaf, and divide faces far away.
 * So a leaf that is large beside the face is divided first, in the middle of its box of tiles, by lines across the
 * window. What is in the tree then is about as large as its leaf, and the tree is about as high as a tree of places.
 *
 * CLOSED. A node below which nothing is open is closed, and what comes to it ends there: hidden faces do not meet the
 * details of what hides them. */
#ifndef FROE_VIEW_VISIBILITY_SCREEN_H
#define FROE_VIEW_VISIBILITY_SCREEN_H
#include "view/visibility/sightlines.h"

typedef struct view_corner {
    filter_vector ray;
    view_way way;    /**< of the side leaving this corner */
    uint32_t vertex; /**< FROE_NONE: a meeting */
    uint32_t bound;  /**< this side lies on a line of the tree above: no cut is needed there */
} view_corner;

/** Leaves, where children have no number. */
#define VIEW_OPEN ((uint32_t)INT32_MAX)
#define VIEW_COVERED (VIEW_OPEN + 1) /**< + the object whose part of it is visible there */
#define VIEW_OUTSIDE UINT32_MAX      /**< of the window */

typedef struct view_screen_node {
    uint32_t line, child[2]; /**< child 0: negative side */
    uint32_t above;          /**< 2 * the parent, of the root UINT32_MAX - 1; + 1: closed */
} view_screen_node;

/** Tiles, lo .. hi - 1 along both axes of the window. */
typedef struct view_box {
    uint16_t lo[2], hi[2];
} view_box;

/** An end of a stretch of an edge: one of the edge's own ends, or its meeting with a way. */
typedef struct view_end {
    filter_vector ray;
    uint32_t vertex; /**< FROE_NONE: the meeting  edge x way, the edge running from its lower vertex to the higher */
    view_way way;
} view_end;

static inline view_mark view_mark_of(const view_end *end) {
    return (view_mark){end->vertex, end->way};
}

typedef struct view_stretch {
    uint32_t edge; /**< or a line where it is no edge: see crossings.h */
    view_end end[2];
} view_stretch;

typedef struct view_pending {
    uint32_t node, slot; /**< slot: 2 * parent + child */
    size_t first;
    uint32_t count;
    view_box box; /**< in which the region of the node lies */
} view_pending;

typedef struct view_pending_stretch {
    uint32_t node;
    view_stretch part;
} view_pending_stretch;

/** A convex part of a beam. */
typedef struct view_opening {
    uint32_t slot; /**< of the open leaf in which it lies */
    uint32_t first, count;
} view_opening;

typedef struct view_screen {
    view_sightlines *sights;
    ARRAY(view_screen_node) nodes;
    uint32_t root;
    uint64_t open;         /**< leaves */
    int turn;              /**< of the window, as the eye sees it: 1 left, -1 right */
    uint32_t first_across; /**< the first of the lines across the window */
    double sides[2][2][3]; /**< of the window, by axis: covectors that are 0 on the lower (upper) side, 1 opposite */
    /* what is open of the beam looked at last, as parts, and as few of these as tell all: one, where all is open */
    ARRAY(view_opening) leaves;
    ARRAY(view_opening) seen;
    ARRAY(view_corner) ring; /**< corners of both */
    bool lost;               /**< some of the beam is not open */
    /* on their way down: beams with the corners of all, the topmost last; stretches */
    ARRAY(view_pending) beams;
    ARRAY(view_corner) corners;
    ARRAY(int8_t) where; /**< sides of the corners of the topmost beam */
    double extent[2];    /**< of the beam, in tiles; below 0: not known yet */
    ARRAY(view_pending_stretch) stretches;
} view_screen;

/** Everything open, or only what lies in the window of `sights`. */
froe_status view_screen_new(view_screen *screen, view_sightlines *sights);
void view_screen_free(view_screen *screen);

/** Finds what is open of a beam, for `seen`. `opaque`: it is going to be covered. FROE_E_MEMORY, FROE_E_LIMIT. */
froe_status view_screen_look(view_screen *screen, const view_corner *ring, uint32_t count, bool opaque);
/** An object, below 2^31 - 1, covers what view_screen_look() has just found. FROE_E_MEMORY. */
froe_status view_screen_cover(view_screen *screen, uint32_t object);
/** A side of a ring along its line, from the corner i. */
view_stretch view_side_of_ring(const view_corner *ring, uint32_t count, uint32_t i);
/** Receives an open stretch. */
typedef bool view_stretch_fn(void *user, const view_stretch *part);
/** The open stretches of a side of that beam, given by its way: those beside which the beam is seen. (What is on the
 * other side does not decide: with the eye in a cut, the part beyond that cut may not have been visited yet.) */
bool view_screen_side(const view_screen *screen, view_way way, view_stretch_fn *fn, void *user);

/** Cuts a stretch of a line to the positive side of a way, or to the window; false: nothing is left, or it runs along
 * the way. */
bool view_cut_stretch(view_sightlines *sights, uint32_t line, view_way way, view_stretch *part);
bool view_cut_to_window(view_sightlines *sights, uint32_t line, view_stretch *part);
/** Sends a stretch of a line `own` beside a face, which is no side of its beam but lies on one, down the tree; `ring`
 * is that beam. On a line of the tree it goes to the side where the face is. */
froe_status view_screen_classify(view_screen *screen, const view_stretch *stretch, uint32_t own,
                                 const view_corner *ring, uint32_t count, view_stretch_fn *fn, void *user);
#endif
