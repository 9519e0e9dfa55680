/* participants.h: the segments that take part in an event.
 *
 *        \ |            The participants of an event are first the segments that its certificates name. Neighbours may
 *     ----\o====        be at the same place without walls and certificates of their own, because their vertices lie
 *         |\  d         on the walls of others or ride on segments. Every segment that comes within a margin of the
 *         | b           place is added to the participants. The margin is more than anything there moves in two ticks,
 * which is the time since all certificates held. The event lies between those ends and crossings of the participants
 * that are near. Doubles suffice, since the set of participants may be too large, but not too small. */
#ifndef FROE_KINETIC_PARTICIPANTS_H
#define FROE_KINETIC_PARTICIPANTS_H
#include "kinetic/event/slab.h"

/** Where something happens: a box, and how far its points move in a tick. */
typedef struct participants_place {
    double low[2], high[2], speed;
} participants_place;

/** A segment: its ends, how far off and how fast they are, and at most one of them. */
typedef struct participants_line {
    now_spot spot[2];
    double speeds[2], error, speed;
} participants_line;

typedef struct participants_table {
    kinetic_call *call;
    ARRAY(uint32_t) list;   /**< segments that take part */
    ARRAY(uint32_t) stamps; /**< of each segment: of the last event that it takes part in */
    uint32_t stamp;
    ARRAY(participants_place) places; /**< where things happen */
    bool pair;                        /**< they are two segments, and two ends of these that pass: */
    participants_line line[2];
    uint32_t which[2]; /**< number of the end that passes */
} participants_table;

/** Empties the lists of participants and places. */
void participants_clear(participants_table *all);
bool participants_have(const participants_table *all, uint32_t segment);
/** Adds the segments that a certificate is about, and the places of its points. False: the points may be in one place,
 * although their segments are unrelated. */
bool participants_add_item(froe_kinetic *k, const slab_item *item);
/** Adds those segments that come near a place, and in space those edges, also of surfaces. False: nothing was added. */
bool participants_add_near(froe_kinetic *k, const uint32_t *segments, size_t count);
/** May a participant have an end in one of the places that is not a point of the certificate? */
bool participants_have_loose_ends(froe_kinetic *k, const slab_item *item);
/** Widens a slab by where two segments meet, or may have met two ticks ago. */
void participants_reach_pair(now_state *now, double slab[2], uint32_t s, uint32_t t);
/** Widens a slab by those ends and crossings of the participants that are near the places. */
void participants_reach(froe_kinetic *k, double slab[2]);
#endif
