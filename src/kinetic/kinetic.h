/* kinetic.h: a cylindrical partition that is kept right while its segments move, and its parts (Agarwal, Erickson and
 * Guibas, "Kinetic BSPs for intersecting segments and disjoint triangles", SODA 1998). It speaks for kinetic.c,
 * ask.c, audit.c and snapshot.c here, and for instant.c of event/. */
#ifndef FROE_KINETIC_KINETIC_H
#define FROE_KINETIC_KINETIC_H
#include "kinetic/call.h"
#include "kinetic/certificate/cert.h"
#include "kinetic/certificate/collinear.h"
#include "kinetic/certificate/turns.h"
#include "kinetic/event/event.h"
#include "kinetic/event/participants.h"
#include "kinetic/event/surgery.h"
#include "kinetic/ghost.h"
#include "kinetic/now/now.h"
#include "kinetic/range/ranges.h"
#include "kinetic/touch.h"
#include "kinetic/tree/ktree.h"

struct froe_kinetic {
    kinetic_call call;
    now_state now;    /**< where everything is */
    ktree tree;       /**< the partition */
    cert_table certs; /**< what proves it right, and the queue of what fails next */
    collinear_table collinear;
    turn_table turns;
    participants_table participants; /**< of the event that is handled */
    surgery_work surgery;
    event_state events;
    touch_state touch;
    ghost_state ghosts;
    froe_kinetic_options options;
    uint64_t epoch, epoch_events; /**< orders drawn so far, events until the last */
    uint64_t swaps;               /**< of two objects in the order, so far */
    ranges_state ranges;
    froe_kinetic_stats counts;
};

/** Begins a public call: brings the state up to date and completes the tree. FROE_E_MEMORY, FROE_E_CANCELLED. */
froe_status kinetic_begin(froe_kinetic *k, froe_diagnostic *diag);
/** Ends a call or a part of it: where memory ran out, makes everything anew, for which memory may suffice now. */
froe_status kinetic_settle(froe_kinetic *k, froe_diagnostic *diag);
/** A partition at a tick that nothing takes part in yet, and no object has a place in the order. FROE_E_MEMORY. */
froe_status kinetic_new_at(froe_motion *motion, const froe_allocator *memory, const froe_kinetic_options *options,
                           int64_t tick, froe_kinetic **out);
/** Makes the tree and all certificates anew of what is there at the present tick. May stop the call. */
void kinetic_make_anew(froe_kinetic *k);
/** How many of the motion's objects it knows: those added since the last froe_kinetic_update() it does not. */
uint32_t kinetic_object_count(const froe_kinetic *k);
/** How many events there were so far. */
uint64_t kinetic_event_count(const froe_kinetic *k);
/** The same segments in the same order at the same time, made from scratch, as a part of the call under way. */
froe_status kinetic_copy(froe_kinetic *k, froe_kinetic **out, froe_diagnostic *diag);
/** FROE_E_UNSUPPORTED: what is there in the plane alone. */
froe_status kinetic_refuse_space(froe_diagnostic *diag);
/** The first node of each that differs from that of the other, with `certificates` also in these; KTREE_LEAF: none.
 * FROE_E_MEMORY. */
froe_status kinetic_compare(const froe_kinetic *k, const froe_kinetic *other, bool certificates, uint32_t found[2]);
#endif
