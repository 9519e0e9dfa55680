/* rigid.h: a part of a model whose nodes move, as rigid bodies.
 *
 *     world = T0 R0 L0  T1 R1 L1 ... Tn Rn Ln      a chain of nodes, from the root to the last that moves: moved by T,
 *                                                  turned by R, before that a constant linear map L (scales)
 *
 * The part is rigid if every map above the last turn that changes keeps all angles: it is a number s times a rotation Q
 * (s < 0: mirrored). Then the part turns by R0 Q0 R1 Q1 ... Rm, and all else is a constant map of its corners.
 *
 * Between keys, the body's centre, the origin of the last moving node, goes straight, and it turns along the arc of
 * froe_body. How far both are from the chain is bounded: at 32 instants by a comparison, in between by the second
 * derivatives. Where that is more than what is allowed, the piece is halved. Where a track steps, a life of the part
 * ends, and another begins. */
#ifndef FROE_IO_ANIMATION_RIGID_H
#define FROE_IO_ANIMATION_RIGID_H
#include "animation/animation.h"

typedef struct io_joint {
    const io_channel *channel; /**< NULL: it stands still, and has no turn */
    double place[3];           /**< where it stands still */
    double linear[9];          /**< L, rows */
    double keeps[4];           /**< Q */
    double size;               /**< not less than the factor by which L makes anything longer */
} io_joint;

typedef struct io_part {
    const io_animation *animation;
    ARRAY(io_joint) joints; /**< from the root on; none: it stands still */
    size_t turns;           /**< joints up to the last turn that changes; 0: none */
    double constant[9];     /**< from the meshes of its last node to the body */
    double flaw;            /**< share of lengths by which maps are not what they are taken for */
    double lo[3], hi[3];    /**< of its corners in the body; the caller's */
    double tolerance;       /**< how far a corner may be from its place; the caller's */
    double deviation;       /**< how far one is at most */
    size_t halvings;        /**< of pieces, so many are left; the caller's */
} io_part;

/** Makes the chain down to a node, which moves. `channel_of`: of each node, or NULL. FROE_E_UNSUPPORTED: it is not
 * rigid, the node is named. FROE_E_MEMORY. */
froe_status io_part_make(const io_animation *animation, const io_nodes *nodes, const io_channel *const *channel_of,
                         size_t node, double begin, io_part *out);
void io_part_free(io_part *part);
/** Halvings that the parts of a model may take together. Pieces are as many as the square root of 1 / deviation, and
 * what is asked about the motion takes time for each. */
enum { IO_HALVINGS = 1 << 16 };
/** Does a node with this channel move? */
bool io_channel_moves(const io_animation *animation, const io_channel *channel);
/** Makes *flaw as large as the scale of the node of that name changes, as a share of it. FROE_E_UNSUPPORTED: that is
 * more than a thousandth. */
froe_status io_channel_scale(const io_animation *animation, const io_channel *channel, const char *name, double *flaw);
/** The matrix of a node that stands still with a channel. */
void io_channel_matrix(const io_animation *animation, const io_channel *channel, double out[12]);

/** Times at which the part jumps, ascending, strictly between two; appended. False: no memory. */
bool io_part_jumps(const io_part *part, double from, double to, io_numbers *out);
/** Appends t, x, y, z and the turn x, y, z, w of each knot from one time to another, between which the part does not
 * jump. FROE_E_LIMIT: the tolerance cannot be kept, or not by the halvings that are left. FROE_E_MEMORY. */
froe_status io_part_follow(io_part *part, double from, double to, io_numbers *out);
/** Where the body is at a time. */
void io_part_pose(const io_part *part, double time, double place[3], double turn[4]);
#endif
