/* slab.h: the range of x in which the points of a failed certificate are. */
#ifndef FROE_KINETIC_SLAB_H
#define FROE_KINETIC_SLAB_H
#include "kinetic/certificate/cert.h"
#include "kinetic/tree/ktree.h"
#include <froe/kinetic.h>

/** A certificate that fails, or a segment that turns, or a triangle that turns over. */
typedef struct slab_item {
    uint32_t cert; /**< CERT_TURN: the segment; CERT_FLOP: the surface */
    cert_kind kind;
    now_claim claim;
    now_spot spot[2];      /**< where the points of the claim are; of a segment nothing */
    double slab[2];        /**< of x */
    froe_event_kind event; /**< by itself */
} slab_item;

/** Widens a slab by a point. Lines without a crossing: not at all. */
void slab_reach(now_state *now, double slab[2], name_point p);
/** Finds where the points of an item are. */
void slab_locate(now_state *now, slab_item *item);
/** Of an item with that: finds the slab and the kind of event that it is by itself. */
void slab_find(ktree *tree, slab_item *item);
/** Are its points about the same segments, so that they meet in one place? */
static inline bool slab_is_one_place(const slab_item *item) {
    return item->event != FROE_EVENT_VERTICES && item->event != FROE_EVENT_VERTEX_CROSSING &&
           item->event != FROE_EVENT_CROSSINGS;
}
/** Sorts the items of an event from left to right, in an order that is a function of the present. */
void slab_sort(froe_kinetic *k);
#endif
