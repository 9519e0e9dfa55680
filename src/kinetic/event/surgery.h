/* surgery.h: how a partition is changed: made from scratch (grow.c), cut along a vertical line and joined again.
 *
 *          x1    x2           What happens at an instant changes the partition only near one x, so the tree of
 *     _____:______:_____      a cell is cut in three there, the middle is made from scratch, and the three are
 *     |  A |  T   | B  |      joined again. Cut and join are exact inverses: both walk down the nodes that the line
 *     |    | x o  |    |      crosses. The slab holds little besides what crosses it, as both lines are as
 *     |____:______:____|      close to the event as doubles can be.
 *
 * The result is the very tree that is made from scratch, because of one fact: a node's segment is the first, in order,
 * of those that reach into its cell. If the roots of two neighbours differ, the earlier of the two segments does not
 * reach the border between them, so it ends at a wall of its own, and the other tree belongs behind that wall. */
#ifndef FROE_KINETIC_SURGERY_H
#define FROE_KINETIC_SURGERY_H
#include "kinetic/tree/ktree.h"

/** What of a segment is in a cell of the plane. */
typedef struct surgery_part {
    uint32_t segment, end[2]; /**< ends as those of nodes */
    now_spot vertex[2];       /**< the left and right end of the segment, */
    now_spot at[2];           /**< and of the part, where that is not a wall of the cell */
} surgery_part;

/** How a part lies to a node of its cell. */
typedef struct surgery_orders {
    int8_t order[2][2]; /**< of its ends to the left and right wall of the node, if there are any */
    int8_t side[2];     /**< on which side of the node's segment are the ends of its own, if it comes */
    bool middle;        /**< between the walls */
} surgery_orders;

/** A subtree that is to be made, of a part of the list, or of the parts. */
typedef struct surgery_task {
    ktree_cell cell;
    size_t first, count; /**< of the list: segments by key */
    uint32_t parent;
    uint8_t slot;
} surgery_task;

/** A part of a tree that is split or joined, and where the results go. */
typedef struct surgery_cutting {
    uint32_t a, b; /**< nodes */
    uint32_t parent[2];
    uint8_t slot[2];
} surgery_cutting;

/** What is left to be done. */
typedef struct surgery_work {
    ARRAY(surgery_task) tasks;
    ARRAY(surgery_cutting) cuttings;
    ARRAY(uint32_t) scratch;
    ARRAY(uint32_t) beside; /**< nodes with walls that are next to a wall that is passed */
    ARRAY(uint32_t) kept;   /**< segments that are listed twice */
    ARRAY(surgery_part) parts;
    ARRAY(surgery_orders) orders; /**< of those of one cell */
} surgery_work;

/** Begins one: what is touched from now on gets a new stamp. */
void surgery_begin(froe_kinetic *k);
/** A node, or all of a subtree, with their certificates. */
void surgery_free_node(froe_kinetic *k, uint32_t node);
void surgery_free_tree(froe_kinetic *k, uint32_t node);
/** Whether a segment reaches into a cell, or where it passes by. */
typedef enum surgery_way { SURGERY_INSIDE, SURGERY_BESIDE, SURGERY_ABOVE, SURGERY_BELOW } surgery_way;
/** The same, and where the segment ends if it reaches into the cell. */
surgery_way surgery_find(froe_kinetic *k, uint32_t segment, const ktree_cell *cell, uint32_t end[2]);
/** Where the segment ends in a cell. False: it does not reach into it. */
bool surgery_clip(froe_kinetic *k, uint32_t segment, const ktree_cell *cell, uint32_t end[2]);
/** Does it reach into a cell; of a surface: does its triangle meet the cell? */
bool surgery_reaches(froe_kinetic *k, uint32_t segment, const ktree_cell *cell);
/** The tree of the segments on the list, those that reach into the cell, made from scratch. Empties the list. */
void surgery_grow(froe_kinetic *k, const ktree_cell *cell, uint32_t parent, uint8_t slot);
/** The same in the plane, of a list by key. */
void surgery_grow_plane(froe_kinetic *k, const ktree_cell *cell, uint32_t parent, uint8_t slot);
/** The order of two points; if they coincide, their segments are bound to each other. */
int surgery_order(ktree *tree, name_point p, name_point q);
/** Cuts the tree of a node along now.line[line]; where the parts go. REQUIRES: its place in the tree is given up. */
void surgery_split(froe_kinetic *k, uint32_t node, int line, const uint32_t parent[2], const uint8_t slot[2]);
/** The inverse. Sets tree.broken where the parts do not fit. */
void surgery_join(froe_kinetic *k, uint32_t a, uint32_t b, uint32_t parent, uint8_t slot);
/** Makes anew what lies between the two lines in the cell of a node. False: segments that were not participants come
 * near. They are participants now, and the tree is as it was. */
bool surgery_slab(froe_kinetic *k, uint32_t node);
/** The whole tree, whatever state it is in. */
void surgery_restart(froe_kinetic *k);
#endif
