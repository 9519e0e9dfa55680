/* live.h: a cylindrical partition that is kept right while its segments move (Agarwal, Erickson and Guibas, "Kinetic
 * BSPs for intersecting segments and disjoint triangles", SODA 1998).
 *
 *      left wall :       top        : right wall      A node is a cell and the segment s that cuts it first. Where
 *                :__________________:                 s ends inside, at a vertex of its own (END_0, END_1) or where
 *                : LEFT : UP /: RI- :                 it crosses top or bottom (the number of that segment), there
 *                :      :  s/ : GHT :                 is a wall; so a node has up to four children. Walls, top and
 *                :______:__/__:_____:                 bottom of a cell are not stored, but found from the nodes
 *                   DOWN  bottom                      above.
 *
 * The tree is a function of the order of the segments (their keys) and of where they are. How it is changed when that
 * changes is in event/surgery.c, and how such a change is noticed in certificate/certify.c. */
#ifndef FROE_KINETIC_LIVE_H
#define FROE_KINETIC_LIVE_H
#include "base/task.h"
#include "kinetic/now/now.h"

enum { LEFT, RIGHT, UP, DOWN };

/** Ends of a segment in a cell that are not crossings. */
#define END_0 0xfffffffeu
#define END_1 0xfffffffdu
#define END_NONE 0xffffffffu
#define CERT_NONE 0xffffffffu

/** Leaves are node 0. The root is child 0 of ROOT; the other places hold what is not in the tree. */
enum { LEAF, ROOT, PARTS, FIRST_NODE };

typedef struct live_node {
    uint32_t segment;
    uint32_t wall[2]; /**< LEFT and RIGHT: END_0, END_1, END_NONE, or the segment that is crossed there */
    uint32_t child[4];
    uint32_t parent;
    uint32_t next, previous; /**< nodes of the same segment; next also links free nodes */
    uint32_t cert[3];        /**< order of the walls of the regions to the left, in the middle, to the right */
    uint32_t stamp;          /**< of the last surgery that touched it */
    uint32_t turner;         /**< the segment in whose direction its walls are named (turns.c), or FROE_NONE */
    uint8_t slot;            /**< which child of its parent it is: live_slot_of() */
    bool cut;                /**< the subtree has a wall of its own */
    bool half;               /**< the right part of a node that was cut; to be joined again */
    bool turned;             /**< `turned` of the turner when left and right were last set */
} live_node;

typedef struct live_cell {
    now_name wall[2];
    uint32_t top, bottom; /**< segments or FROE_NONE */
} live_cell;

typedef struct live_end {
    uint32_t node;    /**< with a wall through this end; LEAF: there is none */
    uint32_t cert[2]; /**< next segment above, below */
    uint32_t next;    /**< end of another segment at the same vertex: 2 segment + end */
    uint32_t stamp;
} live_end;

typedef struct live_segment {
    uint64_t key;
    uint32_t nodes; /**< the first of its nodes */
    uint32_t turn;  /**< certificate: left end before right end */
    uint32_t life;  /**< certificate: appears, disappears */
    uint32_t pairs; /**< the first pair with a segment in the same line: 2 pair + which of the two it is */
    uint32_t stamp;
    uint32_t crew; /**< stamp of the last event that it takes part in */
    bool alive;    /**< its life has begun and not ended */
    bool here;     /**< the tree is made of it and others: it is alive and not a single point */
    bool bound;    /**< a point of it coincides with a point of another segment for as long as the plans last */
    live_end end[2];
} live_segment;

typedef enum cert_kind {
    CERT_LEFT, /**< owner: node; order of the walls of its left region */
    CERT_MIDDLE,
    CERT_RIGHT,
    CERT_ABOVE, /**< owner: 2 segment + end; the vertex is below the next segment above */
    CERT_BELOW,
    CERT_TURN,   /**< owner: segment; the order of its ends */
    CERT_PAIR,   /**< owner: pair; two segments in one line, whose ends keep their order */
    CERT_COURSE, /**< owner: vertex; the piece of its plan lasts */
    CERT_LIFE,   /**< owner: segment; there or not */
    CERT_FREE
} cert_kind;

typedef struct live_cert {
    int64_t tick;   /**< first odd tick after which it does not hold */
    uint32_t place; /**< in the queue; CERT_NONE: never */
    uint32_t owner;
    uint32_t next; /**< free certificates */
    cert_kind kind;
    now_claim claim;
    uint32_t covered[2]; /**< walls that will be borders when their segments have turned, or END_NONE: it is about them,
                            too, and `claim` may be about what the borders were when it was made */
} live_cert;

/** A certificate's entry in the queue. It holds the tick, too, so that sorting reads nothing else. */
typedef struct live_turn {
    int64_t tick;
    uint32_t cert;
} live_turn;

/** Two segments in one line: where they overlap, the later one in order is not in the tree. */
typedef struct live_pair {
    uint32_t segment[2]; /**< the earlier first */
    uint32_t next[2];    /**< pairs of the same segment; next[0] also links free pairs */
    uint32_t cert;
} live_pair;

typedef struct live_task {
    live_cell cell;
    size_t first, count; /**< of the list: segments by key */
    uint32_t parent;
    uint8_t slot;
} live_task;

typedef struct live_visit {
    live_cell cell;
    uint32_t node;
    bool back;
} live_visit;

/** A part of a tree that is split or joined, and where the results go. */
typedef struct live_cutting {
    uint32_t a, b; /**< nodes */
    uint32_t parent[2];
    uint8_t slot[2];
} live_cutting;

/** What a cut node keeps behind one of its walls, and what its other wall was. */
typedef struct live_half {
    uint32_t child, other;
    uint8_t side;
} live_half;

/** Fail ticks of certificates dropped since the last surgery began: many claims are made again at another node. */
typedef struct live_recent {
    now_claim claim;
    uint32_t stamp;
    int64_t tick;
} live_recent;
enum { RECENT = 1 << 10 };

/** The callback that gets the events. */
typedef struct live_watcher {
    froe_event_fn *visit;
    void *user;
} live_watcher;

/** Certificates that fail together at nearby places, as one: a group. */
typedef struct live_item {
    uint32_t cert;
    cert_kind kind;
    now_claim claim;
    double slab[2]; /**< of x */
} live_item;

/** Where something happens: a box, and how far its points move in a tick. */
typedef struct live_place {
    double low[2], high[2], speed;
} live_place;

struct froe_kinetic {
    froe_allocator alloc;
    now_state now;
    froe_kinetic_options options;
    uint64_t epoch, epoch_events; /**< orders drawn so far, events until the last */
    uint32_t stamp, list_stamp, crew_stamp;
    bool short_of_memory; /**< the tree may be incomplete; so it is after a call that was cancelled */
    base_task task;       /**< the call that is under way */
    uint32_t polls;
    bool broken; /**< parts do not fit: the tree is not what it should be */
    ARRAY(live_node) nodes;
    uint32_t free_node;
    size_t node_count;
    ARRAY(live_segment) segments;
    ARRAY(uint32_t) vertices; /**< first end at each vertex: 2 segment + end, or FROE_NONE */
    ARRAY(uint32_t) courses;  /**< certificate of each vertex */
    ARRAY(live_cert) certs;
    uint32_t free_cert;
    ARRAY(live_pair) pairs;
    uint32_t free_pair;
    ARRAY(live_turn) queue; /**< the first to fail on top */
    ARRAY(uint32_t) list;   /**< segments waiting to be built with */
    ARRAY(live_task) tasks;
    ARRAY(live_visit) visits;
    ARRAY(live_cutting) cuttings;
    ARRAY(uint32_t) ends;  /**< ends whose walls came or went: 2 segment + end */
    ARRAY(uint32_t) order; /**< scratch */
    ARRAY(live_item) items;
    ARRAY(live_place) places; /**< where things happen */
    ARRAY(uint32_t) crew;     /**< segments that take part */
    ARRAY(uint32_t) roots;    /**< nodes where surgery is needed */
    ARRAY(uint32_t) leaving;  /**< 2 segment + 1: its plan or life changes now; 2 segment: it may come into the tree */
    ARRAY(uint32_t) turning;  /**< segments whose ends change sides now */
    ARRAY(live_half) halves;  /**< of nodes that were cut */
    bool told;                /**< a visitor is in the callback of an event, */
    now_claim told_claim;     /**< about this; no points: appearances and the like */
    live_recent *recent;
    froe_kinetic_stats counts;
};

/* turns.c */
/** Its segment has turned: puts left and right of a node in their places. */
void live_turn_node(const froe_kinetic *k, uint32_t node);

/** Left and right as they are now. */
static inline live_node *node_at(const froe_kinetic *k, uint32_t node) {
    live_node *n = k->nodes.data + node;
    if (n->turner != FROE_NONE && n->turned != k->now.segments.data[n->turner].turned) live_turn_node(k, node);
    return n;
}
static inline uint8_t live_slot_of(const froe_kinetic *k, uint32_t node) {
    const live_node *n = node_at(k, node);
    (void)node_at(k, n->parent); /* where the children of that one are */
    return n->slot;
}
static inline live_segment *segment_at(const froe_kinetic *k, uint32_t segment) {
    return k->segments.data + segment;
}
/** Is s before t in the order in which segments cut? */
static inline bool comes_before(const froe_kinetic *k, uint32_t s, uint32_t t) {
    uint64_t a = segment_at(k, s)->key, b = segment_at(k, t)->key;
    return a < b || (a == b && s < t);
}
/** The point that a segment ends at in a cell. */
static inline now_name wall_name(const froe_kinetic *k, uint32_t segment, uint32_t end) {
    if (end >= END_1)
        return end == END_NONE ? (now_name){0, NAME_NONE}
                               : (now_name){k->now.segments.data[segment].end[END_0 - end], NAME_VERTEX};
    return name_crossing(segment, end);
}
static inline bool live_covers_turns(const live_cert *cert) {
    return cert->covered[LEFT] != END_NONE || cert->covered[RIGHT] != END_NONE;
}
static inline bool is_end(uint32_t wall) {
    return wall == END_0 || wall == END_1;
}

/* tree/ktree.c */
/** LEAF: no memory. Linked to its segment, not to a parent. */
uint32_t live_new_node(froe_kinetic *k, uint32_t segment, const uint32_t wall[2]);
void live_free_node(froe_kinetic *k, uint32_t node);
void live_attach(froe_kinetic *k, uint32_t parent, uint8_t slot, uint32_t node);
/** Gives a node a wall, or END_NONE. */
void live_set_wall(froe_kinetic *k, uint32_t node, int side, uint32_t wall);
/** Which end's wall this node has; the node of an END wall is known by its end. */
void live_own_end(froe_kinetic *k, uint32_t node, int side);
live_cell live_plane(void);
live_cell live_cell_of(const froe_kinetic *k, uint32_t node);
/** The ancestor that gives a node's cell its wall on a side, and below which child of it the node is. LEAF: none. */
uint32_t live_wall_owner(const froe_kinetic *k, uint32_t node, int side, uint8_t *slot);
/** The cell of a child. REQUIRES: there is a wall on that side. */
live_cell live_child_cell(const froe_kinetic *k, const live_cell *cell, uint32_t node, int slot);
/** Adds the segments of a subtree to the list, each once. */
void live_collect(froe_kinetic *k, uint32_t node);
void live_free_tree(froe_kinetic *k, uint32_t node);
/** Adds one. */
void live_list(froe_kinetic *k, uint32_t segment);
/** An empty list. */
void live_new_list(froe_kinetic *k);
/** A wall came or went that runs through an end: 2 segment + end. */
void live_touch_end(froe_kinetic *k, uint32_t end);
/** What is next to a wall came or went: it may be the next segment above or below its vertex, if it has one. */
void live_touch_wall(froe_kinetic *k, now_name wall);

/* grow.c */
/** Where the segment ends in a cell. False: it does not reach into it. */
bool live_clip(froe_kinetic *k, uint32_t segment, const live_cell *cell, uint32_t end[2]);
/** The tree of the segments on the list from `first` on, those that reach into the cell, made from scratch. The list
 * is cut back to `first`. */
void live_grow(froe_kinetic *k, const live_cell *cell, size_t first, uint32_t parent, uint8_t slot);

/* surgery.c */
/** Cuts the tree `node` along now.line[line]. REQUIRES: its place in the tree is given up. */
void live_split(froe_kinetic *k, uint32_t node, int line, const uint32_t parent[2], const uint8_t slot[2]);
/** The inverse. Sets `broken` where the parts do not fit. */
void live_join(froe_kinetic *k, uint32_t a, uint32_t b, uint32_t parent, uint8_t slot);
/** Makes anew what lies between the two lines in the cell of a node. False: segments that were not participants come
 * near. They are participants now, and the tree is as it was. */
bool live_slab(froe_kinetic *k, uint32_t node);
/** The whole tree, whatever state it is in. */
void live_restart(froe_kinetic *k);

/* event/participants.c */
/** Empties the lists of participants and places. */
void live_new_crew(froe_kinetic *k);
bool live_in_crew(const froe_kinetic *k, uint32_t segment);
void live_join_crew(froe_kinetic *k, uint32_t segment);
/** Adds the segments that a certificate is about, and the places of its points. False: the points may be in one place,
 * although their segments are unrelated. */
bool live_join_item(froe_kinetic *k, const live_item *item);
/** Are its points about the same segments, so that they meet in one place? */
bool live_belong_together(const froe_kinetic *k, const live_item *item);
/** May a participant have an end in one of the places that is not a point of the certificate? */
bool live_has_loose_ends(froe_kinetic *k, const live_item *item);
/** Adds those segments that come near a place. False: nothing was added. */
bool live_find_strangers(froe_kinetic *k, const uint32_t *segments, size_t count);
/** Widens a slab by where two segments meet, or may have met two ticks ago. */
void live_reach_pair(froe_kinetic *k, double slab[2], uint32_t s, uint32_t t);
/** Widens a slab by those ends and crossings of the participants that are near the places. */
void live_reach_crew(froe_kinetic *k, double slab[2]);

/* slab.c */
/** Widens a slab by a point. Lines without a crossing: not at all. */
void live_reach(froe_kinetic *k, double slab[2], now_name p);
void live_find_slab(froe_kinetic *k, live_item *item);
/** Of two crossings on one segment, where the other two cross. */
bool live_third_crossing(now_name p, now_name q, now_name *out);
/** A vertex, and a crossing of a segment that ends at it with another: which one? FROE_NONE: it is not so. */
uint32_t live_met_segment(const froe_kinetic *k, now_name p, now_name q);
/** Are they the two ends of one segment? */
bool live_is_one_segment(const froe_kinetic *k, now_name p, now_name q);
bool live_has_end(const froe_kinetic *k, uint32_t segment, uint32_t vertex);

/* event/pass.c */
typedef enum live_outcome {
    LIVE_DONE,
    LIVE_STRANGERS, /**< neighbours were added to the participants; the tree is as it was */
    LIVE_NOT_NARROW /**< nothing was done */
} live_outcome;
/** The point of a node passes a wall of its cell, away from the point that the wall belongs to. */
live_outcome live_pass(froe_kinetic *k, const live_item *item);

/* queue.c */
uint32_t live_new_cert(froe_kinetic *k, cert_kind kind, uint32_t owner, int64_t tick, const now_claim *claim);
void live_drop_cert(froe_kinetic *k, uint32_t cert);
void live_set_tick(froe_kinetic *k, uint32_t cert, int64_t tick);
/** When a claim fails that was dropped in this surgery; -1: unknown. */
int64_t live_recall(const froe_kinetic *k, const now_claim *claim);
/** The certificates due at a tick, as k->order. */
void live_due(froe_kinetic *k, int64_t tick);

/* certificate/certify.c */
/** A place in the tree: its cell, and what the nodes above depend on of what was there. */
typedef struct live_site {
    uint32_t parent;
    uint8_t slot;
    bool cut; /**< there were walls */
    live_cell cell;
} live_site;
live_site live_site_of(const froe_kinetic *k, uint32_t node);
/** After surgery at the site: certificates of all that was touched, and above. */
void live_certify(froe_kinetic *k, const live_site *site);
/** What a certificate says now. */
now_claim live_claim_of(const froe_kinetic *k, uint32_t cert);
/** For a certificate that was due, but holds: finds when it fails next. */
void live_rearm(froe_kinetic *k, uint32_t cert);
/** When a claim fails. */
int64_t live_fail_tick(froe_kinetic *k, const now_claim *claim);
/** The names of the walls of a region: CERT_LEFT, CERT_MIDDLE, CERT_RIGHT. */
void live_borders(const froe_kinetic *k, uint32_t node, const live_cell *cell, cert_kind region, now_name out[2]);
/** Looks up which end is on the left, and makes the certificate of that. */
void live_certify_turn(froe_kinetic *k, uint32_t segment);
void live_forget_turn(froe_kinetic *k, uint32_t segment);
void live_forget_ends(froe_kinetic *k, uint32_t segment);

/* turns.c */
/** Sets the segment in whose direction the walls of a node are named, which is a function of these walls. */
void live_name_walls(const froe_kinetic *k, uint32_t node);
/** Two points coincide: the segments that they are about cannot turn without surgery. */
void live_bind(froe_kinetic *k, now_name p, now_name q);
/** May the segment turn without surgery? */
bool live_turns_freely(const froe_kinetic *k, uint32_t segment);
/** States a region's claim so that a turn of the segment on which both borders lie does not change it. */
void live_name_along(const froe_kinetic *k, now_claim *claim);
/** Makes a region's certificate hold beyond the turns of the segments at its borders, if it does not yet. */
void live_cover_turns(froe_kinetic *k, uint32_t cert);
/** When the first of the segments turns that a claim is about points of. */
int64_t live_first_turn(const froe_kinetic *k, const now_claim *claim);
/** A node is cut, or one of its walls comes, and what it keeps on `side` stays: when both walls of the node are there
 * again, the regions at the kept one have to be certified, if the other one is not what it was. */
void live_note_half(froe_kinetic *k, uint32_t node, int side);
/** Certifies the regions at all noted walls. */
void live_certify_halves(froe_kinetic *k);

/* pairs.c */
/** Makes the certificate of two segments in one line. */
void live_watch_pair(froe_kinetic *k, uint32_t s, uint32_t t);
/** When the ends of two such change their order. */
int64_t live_pair_tick(froe_kinetic *k, const uint32_t segment[2]);
/** The other segments in the line of s, as k->order. */
void live_partners(froe_kinetic *k, uint32_t s);
void live_forget_pairs(froe_kinetic *k, uint32_t s);

/* change.c */
/** Lets a segment take part from now on, if it has a length, without putting it into the tree. */
void live_enroll(froe_kinetic *k, uint32_t segment);
/** The inverse. */
void live_unroll(froe_kinetic *k, uint32_t segment);
/** Lets a segment take part, and puts it into the tree. */
void live_insert(froe_kinetic *k, uint32_t segment);
void live_remove(froe_kinetic *k, uint32_t segment);
/** (Re)sets when the segment appears or goes, and when the flight of its ends changes. */
void live_schedule(froe_kinetic *k, uint32_t segment);

/* kinetic.c */
/** The same segments in the same order at the same time, made from scratch, as a part of the call under way. */
froe_status live_copy(froe_kinetic *k, froe_kinetic **out, froe_diagnostic *diag);

/** Is the present within the life of the segment? */
bool live_is_there(const froe_kinetic *k, uint32_t segment);

/* call.c */
/** Begins a public call: brings the state up to date and completes the tree. FROE_E_MEMORY, FROE_E_CANCELLED. */
froe_status live_begin(froe_kinetic *k, froe_diagnostic *diag);
/** Ends a call or a part of it: where memory ran out, makes everything anew, for which memory may suffice now. */
froe_status live_settle(froe_kinetic *k, froe_diagnostic *diag);
/** Is a long operation to go on? Asks the caller now and then. */
bool live_goes_on(froe_kinetic *k);
/** The same while the tree is made: a cancelled call leaves the tree incomplete. */
static inline void live_poll(froe_kinetic *k) {
    if (!live_goes_on(k)) k->short_of_memory = true;
}
/** The failure of a call that could not go on. */
froe_status live_fail(froe_kinetic *k, froe_diagnostic *diag);

/* audit.c */
/** The first node of each that differs from that of the other, with `certificates` also in these; LEAF: none.
 * FROE_E_MEMORY. */
froe_status live_compare(const froe_kinetic *k, const froe_kinetic *other, bool certificates, uint32_t found[2]);

/* event/event.c */
/** The next tick at which something happens; NOW_NEVER: nothing does. */
int64_t live_next_tick(const froe_kinetic *k);
/** Goes to that tick, or to `tick` if nothing happens before. False: the visitor asked to stop. */
bool live_step(froe_kinetic *k, int64_t tick, const live_watcher *watcher);
/** The last odd tick of the window. */
int64_t live_last_tick(const froe_kinetic *k);
#endif
