/* ktree.h: a cylindrical partition of moving segments (Agarwal, Erickson and Guibas, "Kinetic BSPs for intersecting
 * segments and disjoint triangles", SODA 1998), as nodes and cells.
 *
 *      left wall :       top        : right wall      A node is a cell and the segment s that cuts it first. Where
 *                :__________________:                 s ends inside, at a vertex of its own (END_0, END_1) or where
 *                : LEFT : UP /: RI- :                 it crosses top or bottom (the number of that segment), there
 *                :      :  s/ : GHT :                 is a wall; so a node has up to four children. Walls, top and
 *                :______:__/__:_____:                 bottom of a cell are not stored, but found from the nodes
 *                   DOWN  bottom                      above.
 *
 * In space segments are the edges of triangles, as seen from above. Where a triangle spans its cell, its surface comes
 * next: a node without walls, whose children are what is above (UP) and below (DOWN) the triangle.
 *
 * The tree is a function of the order of the segments (their keys) and of where they are. This header knows neither
 * how it is changed when that changes (event/surgery.h) nor how such a change is noticed (certificate/cert.h). It keeps
 * what these two exchange: stamps of what a surgery touched, and the numbers of certificates of regions. */
#ifndef FROE_KINETIC_KTREE_H
#define FROE_KINETIC_KTREE_H
#include "kinetic/call.h"
#include "kinetic/now/now.h"

/** The children of a node, and the sides of a cell. */
enum { KTREE_LEFT, KTREE_RIGHT, KTREE_UP, KTREE_DOWN };

/** Ends of a segment in a cell that are not crossings. */
#define KTREE_END_0 0xfffffffeu
#define KTREE_END_1 0xfffffffdu
#define KTREE_NO_WALL 0xffffffffu

/** Leaves are node 0. The root is child 0 of KTREE_ROOT; KTREE_PARTS has as children what surgery has cut out. */
enum { KTREE_LEAF, KTREE_ROOT, KTREE_PARTS, KTREE_FIRST };
enum { KTREE_MOST = 1 << 30 }; /* nodes, which alone take 64 GB: numbers of visits to them have 32 bits, too */

typedef struct ktree_node {
    uint32_t segment;
    uint32_t wall[2]; /**< left and right: an end, KTREE_NO_WALL, or the segment that is crossed there */
    uint32_t child[4];
    uint32_t parent;
    uint32_t next, previous; /**< nodes of the same segment; next also links free nodes */
    uint32_t cert[3]; /**< certificates: order of the walls of the regions to the left, in the middle, to the right */
    uint32_t stamp;   /**< of the last surgery that touched it */
    uint32_t turner;  /**< the segment in whose direction its walls are named (turns.h), or FROE_NONE */
    uint8_t slot;     /**< which child of its parent it is: ktree_slot_of() */
    bool cut;         /**< the subtree has a wall of its own */
    bool half;        /**< the right part of a node that was cut; to be joined again */
    bool turned;      /**< `turned` of the turner when left and right were last set */
} ktree_node;

typedef struct ktree_cell {
    name_point wall[2];
    uint32_t top, bottom;    /**< segments or FROE_NONE */
    uint32_t ceiling, floor; /**< in space: surfaces, or FROE_NONE */
} ktree_cell;

typedef struct ktree_end {
    uint32_t node; /**< with a wall through this end; KTREE_LEAF: there is none */
    uint32_t next; /**< end of another segment at the same vertex: 2 segment + end */
    uint32_t stamp;
} ktree_end;

typedef struct ktree_segment {
    uint64_t key;
    uint32_t nodes;   /**< the first of its nodes */
    uint32_t stamp;   /**< of the last list that it is on */
    bool alive;       /**< its life has begun and not ended */
    bool here;        /**< the tree is made of it and others: it is alive and not a single point */
    bool bound;       /**< a point of it coincides with a point of another segment for as long as the plans last */
    bool stays;       /**< its plan goes on at the next tick, and it is not taken out for that (event/renew.h) */
    uint32_t leaving; /**< its place among those that leave, if it is one of them */
    ktree_end end[2];
} ktree_segment;

/** What is left to be done on a walk through cells: a subtree, or the node itself on the way back. */
typedef struct ktree_visit {
    ktree_cell cell;
    uint32_t node;
    bool back;
} ktree_visit;

/** A place in the tree: its cell, and what the nodes above depend on of what was there. */
typedef struct ktree_site {
    uint32_t parent;
    uint8_t slot;
    bool cut; /**< there were walls */
    ktree_cell cell;
} ktree_site;

typedef struct ktree {
    kinetic_call *call;
    now_state *now;
    bool augmented; /**< walls are named in the direction of segments (turns.h) */
    bool broken;    /**< parts do not fit: the tree is not what it should be */
    ARRAY(ktree_node) nodes;
    uint32_t free_node;
    size_t node_count;
    ARRAY(ktree_segment) segments;
    ARRAY(uint32_t) vertices; /**< first end at each vertex: 2 segment + end, or FROE_NONE */
    uint32_t stamp;           /**< of the present surgery */
    ARRAY(uint32_t) touched;  /**< ends whose walls came or went: 2 segment + end */
    uint32_t list_stamp;
    ARRAY(uint32_t) list;      /**< segments waiting to be built with */
    ARRAY(uint32_t) stack;     /**< nodes still to be visited */
    ARRAY(ktree_visit) visits; /**< the same with their cells */
} ktree;

void ktree_free(ktree *tree);
/** The segment in whose direction a node's walls are named has turned: puts left and right in their places. */
void ktree_turn_node(const ktree *tree, uint32_t node);

/** Left and right as they are now. */
static inline ktree_node *ktree_node_at(const ktree *tree, uint32_t node) {
    ktree_node *n = tree->nodes.data + node;
    if (n->turner != FROE_NONE && n->turned != tree->now->segments.data[n->turner].turned) ktree_turn_node(tree, node);
    return n;
}
static inline uint8_t ktree_slot_of(const ktree *tree, uint32_t node) {
    const ktree_node *n = ktree_node_at(tree, node);
    (void)ktree_node_at(tree, n->parent); /* where the children of that one are */
    return n->slot;
}
static inline ktree_segment *ktree_segment_at(const ktree *tree, uint32_t segment) {
    return tree->segments.data + segment;
}
/** The next end at the same vertex: 2 segment + end, or FROE_NONE. */
static inline uint32_t ktree_next_end(const ktree *tree, uint32_t end) {
    return tree->segments.data[end / 2].end[end % 2].next;
}
/** Is s before t in the order in which segments cut? */
static inline bool ktree_before(const ktree *tree, uint32_t s, uint32_t t) {
    uint64_t a = ktree_segment_at(tree, s)->key, b = ktree_segment_at(tree, t)->key;
    return a < b || (a == b && s < t);
}
static inline bool ktree_is_end(uint32_t wall) {
    return wall == KTREE_END_0 || wall == KTREE_END_1;
}
/** Is a node that of a segment; of a surface: of that, or of an edge that cuts as one of its triangle? */
static inline bool ktree_is_part(const ktree *tree, uint32_t node, uint32_t segment) {
    const uint32_t own = tree->nodes.data[node].segment;
    if (!now_is_surface(tree->now, segment)) return own == segment;
    return (ktree_segment_at(tree, own)->key | 3) == ktree_segment_at(tree, segment)->key;
}
/** The point that a segment ends at in a cell. */
static inline name_point ktree_wall_name(const ktree *tree, uint32_t segment, uint32_t end) {
    if (end >= KTREE_END_1)
        return end == KTREE_NO_WALL
                   ? (name_point){0, NAME_NONE}
                   : (name_point){tree->now->segments.data[segment].end[KTREE_END_0 - end], NAME_VERTEX};
    return name_crossing(segment, end);
}
/** Are two vertices the two ends of one segment? */
bool ktree_is_one_segment(const ktree *tree, name_point p, name_point q);

/* ------------------------------------------------------------------- nodes -- */

/** KTREE_LEAF: no memory. Linked to its segment, not to a parent. */
uint32_t ktree_new_node(ktree *tree, uint32_t segment, const uint32_t wall[2]);
/** REQUIRES: its certificates are dropped. */
void ktree_free_node(ktree *tree, uint32_t node);
void ktree_attach(ktree *tree, uint32_t parent, uint8_t slot, uint32_t node);
/** Gives a node a wall, or KTREE_NO_WALL. */
void ktree_set_wall(ktree *tree, uint32_t node, int side, uint32_t wall);
/** A wall came or went that runs through an end: 2 segment + end. */
void ktree_touch_end(ktree *tree, uint32_t end);
/** What is next to a wall came or went: it may be the next segment above or below its vertex, if it has one. */
void ktree_touch_wall(ktree *tree, name_point wall);

/* ------------------------------------------------------------------- cells -- */

ktree_cell ktree_plane(void);
ktree_cell ktree_cell_of(const ktree *tree, uint32_t node);
/** The cell of a child. REQUIRES: there is a wall on that side. */
ktree_cell ktree_child_cell(const ktree *tree, const ktree_cell *cell, uint32_t node, int slot);
ktree_site ktree_site_of(const ktree *tree, uint32_t node);
/** The ancestor that gives a node's cell its wall on a side, and below which child of it the node is. KTREE_LEAF:
 * none. */
uint32_t ktree_wall_owner(const ktree *tree, uint32_t node, int side, uint8_t *slot);
/** The wall of a node's cell on a side. */
name_point ktree_wall_beside(const ktree *tree, uint32_t node, int side);

/* ------------------------------------------------------------------- walks -- */

/** Begins a walk through the nodes of a subtree, from the top down. */
void ktree_walk(ktree *tree, uint32_t node);
/** The next one; KTREE_LEAF: there is none. It may be freed before the walk goes on. */
uint32_t ktree_walk_next(ktree *tree);
/** A node still to be visited, on tree->stack; KTREE_LEAF: none. */
static inline void ktree_push_node(ktree *tree, uint32_t node) {
    if (node) call_push(tree->call, &tree->stack, node);
}
/** The same of a node and its cell, on tree->visits. */
void ktree_push_visit(ktree *tree, uint32_t node, const ktree_cell *cell, bool back);
/** An empty list of segments. */
void ktree_new_list(ktree *tree);
/** Adds one, once. */
void ktree_list(ktree *tree, uint32_t segment);
/** Adds what the list has for a segment: in the plane that, in space the surfaces of all triangles that are there and
 * have it. */
void ktree_list_objects(ktree *tree, uint32_t segment);
/** Adds the segments of a subtree. In space: the surfaces of all triangles that are there and have one of its edges, or
 * whose surfaces it has. */
void ktree_collect(ktree *tree, uint32_t node);
#endif
