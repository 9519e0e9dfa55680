/* cert.h: certificates, each a claim that holds until a tick, in a queue by that tick (Basch, Guibas and Hershberger,
 * "Data structures for mobile data", 1999). Which claims prove a partition right is in certify.h. */
#ifndef FROE_KINETIC_CERT_H
#define FROE_KINETIC_CERT_H
#include "kinetic/call.h"
#include "kinetic/certificate/queue.h"
#include "kinetic/now/now.h"

typedef enum cert_kind {
    CERT_LEFT, /**< owner: node; order of the walls of its left region */
    CERT_MIDDLE,
    CERT_RIGHT,
    CERT_ABOVE, /**< owner: 2 segment + end; the vertex is below the next segment above */
    CERT_BELOW,
    CERT_TURN,      /**< owner: segment; the order of its ends */
    CERT_FLOP,      /**< owner: surface; on which side of its first edge the third corner is, as seen from above */
    CERT_COLLINEAR, /**< owner: pair; two segments in one line, whose ends keep their order */
    CERT_COURSE,    /**< owner: vertex; the piece of its plan lasts */
    CERT_LIFE,      /**< owner: segment; there or not */
    CERT_FREE
} cert_kind;

typedef struct cert_record {
    int64_t tick; /**< first odd tick after which it does not hold */
    uint32_t owner;
    uint32_t next;  /**< of the same list: those of an end, or free ones */
    cert_kind kind; /**< of a region: which one it was when it was made; which it is now, certify_kind() tells */
    now_claim claim;
    uint32_t covered[2]; /**< walls that will be borders when their segments have turned, or FROE_NONE: it is about
                            them, too, and `claim` may be about what the borders were when it was made */
} cert_record;

/** The certificates of a segment, or FROE_NONE. */
typedef struct cert_segment {
    uint32_t turn;      /**< left end before right end; of a surface CERT_FLOP */
    uint32_t life;      /**< appears, disappears */
    uint32_t end[2][2]; /**< of each end: next segment above, below; in space the first of a list, as there is one in
                             each layer of surfaces */
} cert_segment;

/** Fail ticks of certificates dropped since the last surgery began: many claims are made again at another node. */
typedef struct cert_recent {
    now_claim claim;
    uint32_t stamp;
    int64_t tick;
} cert_recent;

/** An end with a wall of which a surgery knows what is next to it from now on. */
typedef struct cert_known {
    uint32_t end;     /**< 2 segment + end */
    uint32_t next[2]; /**< segments above and below, or FROE_NONE */
} cert_known;

typedef struct cert_table {
    kinetic_call *call;
    const now_state *now;
    ARRAY(cert_record) all;
    uint32_t first_free;
    queue_heap queue;
    ARRAY(cert_segment) segments;
    ARRAY(uint32_t) courses;       /**< certificate of each vertex */
    ARRAY(uint32_t) neighbours[2]; /**< of the end that gets certificates: next segments above, below */
    cert_known known[2];           /**< of the surgery that certify_sites() is called for */
    unsigned known_count;
    cert_recent *recent;
    uint32_t stamp; /**< of the present surgery */
    bool forgets;   /**< `recent` is not used in it: hardly any claim is made again */
} cert_table;

/** FROE_E_MEMORY. */
froe_status cert_table_new(kinetic_call *call, const now_state *now, cert_table *out);
void cert_table_free(cert_table *certs);
/** FROE_NONE: no memory. */
uint32_t cert_new(cert_table *certs, cert_kind kind, uint32_t owner, int64_t tick, const now_claim *claim);
void cert_drop(cert_table *certs, uint32_t cert);
/** Drops the one of this number, if there is one, and those after it in its list, and sets the number to FROE_NONE. */
void cert_forget(cert_table *certs, uint32_t *cert);
void cert_set_tick(cert_table *certs, uint32_t cert, int64_t tick);
/** When a claim fails that was dropped in this surgery; -1: unknown. */
int64_t cert_recall(const cert_table *certs, const now_claim *claim);
/** The certificates due at a tick, as queue.due. */
void cert_find_due(cert_table *certs, int64_t tick);
/** The next tick at which something happens; NOW_NEVER: nothing does. */
int64_t cert_next_tick(const cert_table *certs);

static inline bool cert_covers_turns(const cert_record *cert) {
    return cert->covered[0] != FROE_NONE || cert->covered[1] != FROE_NONE;
}
#endif
