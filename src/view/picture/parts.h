/* parts.h: what will be painted, before its order is known: nodes of the order graph, and the convex parts
 * that each of them paints.
 *
 * A node is a whole patch, painted with all its polygons, or the visible part of one that a section cuts, or of a
 * single piece of the tree. Pieces are nodes only where something is clear and whole patches would form cycles.
 *
 * It speaks for parts.c and arcs.c (which pairs of nodes have an order). */
#ifndef FROE_VIEW_PICTURE_PARTS_H
#define FROE_VIEW_PICTURE_PARTS_H
#include "view/picture/graph.h"
#include "view/print.h"
#include "view/visibility/visibility.h"

typedef struct paint_node {
    uint32_t patch;
    uint32_t piece; /**< of the tree; FROE_NONE: the whole patch */
    uint32_t first; /**< visible piece: those of a node follow each other */
} paint_node;

typedef struct paint_part {
    uint32_t node;
    uint32_t place;        /**< front to back, as of visible pieces; 0 where whole patches are opaque: it is behind */
    uint32_t source;       /**< see kind */
    uint32_t first, count; /**< its ring on the page, in `points` */
} paint_part;

/** How a patch is painted: `split` of view_parts. */
enum { PARTS_WHOLE, PARTS_PIECES, PARTS_REGION };

/** What `source` of a part is. */
enum { PART_OBJECT, PART_PIECE, PART_VISIBLE };

typedef struct view_parts {
    const froe_visibility *v;
    const froe_projection *view;
    bool clear; /**< some patches are not opaque: parts are pieces of the tree, with places */
    bool cull_back;
    uint32_t *places;        /**< clear: per piece of the tree, its place front to back */
    uint8_t *split;          /**< per patch: PARTS_... */
    uint32_t *node_of_patch; /**< per patch: its node (its first, when split); FROE_NONE: not visible */
    uint32_t *node_of;       /**< per visible piece */
    ARRAY(paint_node) nodes;
    ARRAY(paint_part) parts;
    ARRAY(uint32_t) tour; /**< all nodes along a curve over the page: what is near there is mostly near in the caches */
    ARRAY(uint8_t) kinds; /**< per part */
    print_ring points;
    print_press press;
    view_ring ring;
    geom_plane plane; /**< of the patch whose visible piece was printed last */
    uint32_t plane_of;
} view_parts;

/** `sights` are those of the visibility, which may grow. places NULL: nothing is clear. FROE_E_MEMORY. */
froe_status view_parts_new(view_parts *parts, const froe_visibility *v, const froe_projection *view, uint32_t *places,
                           bool cull_back);
void view_parts_free(view_parts *parts);
/** Frees the parts, where only nodes are still asked for. */
void view_parts_drop(view_parts *parts);
/** Makes nodes and parts anew, as `split` says. */
froe_status view_parts_make(view_parts *parts, view_sightlines *sights);
/** Appends the ring of a visible piece on the page. */
bool view_print_visible(view_parts *parts, uint32_t visible, print_ring *out);
/** Appends the ring of a tree's piece. */
bool view_print_piece(view_parts *parts, view_sightlines *sights, uint32_t piece, print_ring *out);

/** The same parts for another thread, with scratch of its own, which is freed by view_parts_close(). */
view_parts view_parts_fork(const view_parts *parts);
void view_parts_close(view_parts *fork);

/** Shares of the work, as progress tells them: where looking, finding what lies before what, and painting end. */
#define VIEW_LOOKED 0.5
#define VIEW_PLANNED 0.7
#define VIEW_PAINTED 0.9

/** Finds the pairs of nodes whose order matters: all arcs of the graph, in any order. *tests counts pairs that were
 * compared; FROE_E_BUDGET when they would exceed `most`. Overlaps are decided exactly. */
typedef ARRAY(graph_arc) view_arcs;
froe_status view_find_arcs(view_parts *parts, view_sightlines *sights, base_task *task, uint64_t most, view_arcs *arcs,
                           uint64_t *tests);
#endif
