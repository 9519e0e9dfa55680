/* collinear.h: segments in one line, as cars in one lane. Where two of them overlap only the earlier in order is in the
 * tree. The tree does not show when an end of the other comes out, so the order of their ends has certificates. */
#ifndef FROE_KINETIC_COLLINEAR_H
#define FROE_KINETIC_COLLINEAR_H
#include "kinetic/call.h"
#include "kinetic/now/now.h"

typedef struct collinear_pair {
    uint32_t segment[2]; /**< the earlier first */
    uint32_t next[2];    /**< pairs of the same segment; next[0] also links free pairs */
    uint32_t cert;
} collinear_pair;

typedef struct collinear_table {
    ARRAY(collinear_pair) pairs;
    uint32_t first_free;
    size_t count;             /**< pairs that are not free */
    ARRAY(uint32_t) first;    /**< pair of each segment: 2 pair + which of the two it is, or FROE_NONE */
    ARRAY(uint32_t) partners; /**< what collinear_find_partners() has found */
} collinear_table;

/** Makes the certificate of two segments in one line. */
void collinear_watch(froe_kinetic *k, uint32_t s, uint32_t t);
/** When the ends of two such change their order. */
int64_t collinear_tick(now_state *now, const uint32_t segment[2]);
/** The other segments in the line of s, as collinear.partners. */
void collinear_find_partners(froe_kinetic *k, uint32_t s);
void collinear_forget(froe_kinetic *k, uint32_t s);
#endif
