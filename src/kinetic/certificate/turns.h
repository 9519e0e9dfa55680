/* turns.h: segments that turn upright and over, in an augmented partition (section 3.1.4 of the paper).
 *
 *      :b /:          :\ b:        When a segment turns, left and right of it change places all along it: of its own
 *      : / :    ->    : \ :        two walls in each cell, and of every wall at a crossing with a later segment, with
 *     -:/--:-        -:--\:-       what is behind it. So walls are named in the direction of a segment, from its
 *      :a  :          :  a:        end 0 to its end 1: two walls of a node in that of the node's own segment, one at
 * a crossing in that of the segment that is crossed. A turn reverses that direction. Left and right of a
 * node are updated when it is next read (ktree_node_at). Parts to the left and right of both walls of a node stay.
 *
 * Certificates must not change, either. Points of one segment are ordered along it (now/along.c). A region outside of
 * the segment, at one of its walls, borders on its other wall after the turn. Where the turn comes before the
 * certificate of the region fails, the certificate covers both walls.
 *
 * When nothing else fails at the tick and nearby, all certificates hold, and so the tree is right: all that lies
 * between the two walls of a node is ordered by certificates, and only points of the segment itself can change their
 * order by its turn. This does not cover points without a wall, which coincide with others for as long as plans last.
 * When some are found, their segments are bound: they turn by surgery, as all do in an ordinary partition. So do
 * segments that share a vertex. That walls of two nodes need names of different directions is from the specification.
 * That certificates must cover the turn is not in the paper. */
#ifndef FROE_KINETIC_TURNS_H
#define FROE_KINETIC_TURNS_H
#include "kinetic/tree/ktree.h"

/** What a cut node keeps behind one of its walls, and what its other wall was. */
typedef struct turn_half {
    uint32_t child, other;
    uint8_t side;
} turn_half;

typedef struct turn_table {
    ARRAY(turn_half) halves; /**< of nodes that were cut */
} turn_table;

/** Two points coincide: the segments that they are about cannot turn without surgery. */
void turn_bind(ktree *tree, name_point p, name_point q);
/** May the segment turn without surgery? */
bool turn_is_free(const ktree *tree, uint32_t segment);
/** States a region's claim so that a turn of the segment on which both borders lie does not change it. */
void turn_name_along(const ktree *tree, now_claim *claim);
/** Makes a region's certificate hold beyond the turns of the segments at its borders, if it does not yet. */
void turn_cover(froe_kinetic *k, uint32_t cert);
/** A node is cut, or one of its walls comes, and what it keeps on `side` stays: when both walls of the node are there
 * again, the regions at the kept one have to be certified, if the other one is not what it was. */
void turn_note_half(froe_kinetic *k, uint32_t node, int side);
/** Certifies the regions at all noted walls. */
void turn_certify_halves(froe_kinetic *k);
#endif
