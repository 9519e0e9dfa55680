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
 * positive side is inside, that leaves it. Corner i is the meeting of ways i - 1 and i, or a vertex. */
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
} view_screen_node;

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
} view_pending;

typedef struct view_pending_stretch {
    uint32_t node;
    view_stretch part;
} view_pending_stretch;

typedef struct view_screen {
    view_sightlines *sights;
    ARRAY(view_screen_node) nodes;
    uint32_t root;
    uint64_t open; /**< leaves */
    /* on their way down: beams with the corners of all, the topmost last; stretches */
    ARRAY(view_pending) beams;
    ARRAY(view_corner) corners;
    ARRAY(int8_t) sides; /**< of the corners of the topmost beam */
    ARRAY(view_pending_stretch) stretches;
} view_screen;

/** Everything open, or only what lies in the window of `sights`. */
froe_status view_screen_new(view_screen *screen, view_sightlines *sights);
void view_screen_free(view_screen *screen);

/** Receives a visible beam, `count` corners that live until it returns; false: without memory. */
typedef bool view_beam_fn(void *user, const view_corner *ring, uint32_t count);
/** Sends a beam down the tree; then an object covers what it reached, below 2^31 - 1, or (FROE_NONE) none does.
 * FROE_E_MEMORY, FROE_E_LIMIT. */
froe_status view_screen_insert(view_screen *screen, const view_corner *ring, uint32_t count, uint32_t cover,
                               view_beam_fn *fn, void *user);
/** Cuts a stretch of a line to the positive side of a way, or to the window; false: nothing is left, or it runs along
 * the way. */
bool view_cut_stretch(view_sightlines *sights, uint32_t line, view_way way, view_stretch *part);
bool view_cut_to_window(view_sightlines *sights, uint32_t line, view_stretch *part);
/** Receives an open stretch. */
typedef bool view_stretch_fn(void *user, const view_stretch *part);
/** Sends a stretch of a line `own` beside a face, such as one of its edges, down the tree; `ring` is the face's beam.
 * On a line of the tree it goes to the side where the face is: a line is seen where its face is seen beside it. (The
 * other side does not decide: with the eye in a cut, the part beyond that cut may not have been visited yet.) */
froe_status view_screen_classify(view_screen *screen, const view_stretch *stretch, uint32_t own,
                                 const view_corner *ring, uint32_t count, view_stretch_fn *fn, void *user);
#endif
