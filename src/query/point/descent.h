/* descent.h: a tree of the plane, laid out for points that go down to their leaves.
 *
 *     jump table                cuts, four and more to a visit of memory
 *     +--+--+--+--+             +----------------------------+
 *     |  |  | o----------->     |  o-.    o-.    o    o      | --> leaf: a node of the tree
 *     +--+--+--+--+             +------\-----\---------------+
 *     |  |  |  |  |                     another group of cuts
 *     +--+--+--+--+
 *
 * A cut is two floats: a line a x + b y + c = 0 divided by the greater of |a| and |b|, in units of the scene. Floats
 * tell the side of all points but those within DESCENT_DOUBT of the line; these are decided exactly by the cut of the
 * tree. So no answer is wrong, and a doubtful point costs one more look at the tree.
 *
 * Cuts lie where they are needed together: a group is a cut and those below it that most leaves are under (as van
 * Emde Boas lays out trees, but these trees are not balanced). The table names, for every cell of a grid, the first cut
 * below the root that may meet it. */
#ifndef FROE_QUERY_POINT_DESCENT_H
#define FROE_QUERY_POINT_DESCENT_H
#include "query/context.h"

/** x[major] + slope * x[other] + c: negative, the side next[0]; positive, next[1]. */
typedef struct descent_cut {
    float slope, c; /**< |slope| <= 1; c is NaN: floats cannot tell */
    uint32_t next[2];
} descent_cut;
#define DESCENT_LEAF 0x80000000u  /**< of next: a node of the tree, a leaf; otherwise a cut */
#define DESCENT_STEEP 0x40000000u /**< of next[0]: y is major */
#define DESCENT_EMPTY 0x20000000u /**< of a leaf: it lists nothing */
#define DESCENT_NODE 0x1fffffffu
#define DESCENT_BACK 0x80000000u /**< of nodes: the cut's sides are those of the node in reverse */

/** Points this near to a cut are decided exactly. A float of 0 .. 1 and c (below 2) are wrong by at most 2^-25 and
 * 2^-24, and so are their products and sums: 2^-22 together, and four times that in all rounding modes. */
#define DESCENT_DOUBT 0x1p-20f

typedef struct query_descent {
    query_part part;
    bool there; /**< false: not in the plane, packed (which has its own table), or beyond what floats can tell */
    double lo[2], scale;
    uint32_t cut_count, columns, rows;
    float grid; /**< cells of the table on the side of the unit square */
    descent_cut *cuts;
    uint32_t *nodes; /**< [cut]: of the tree */
    uint32_t *table; /**< [column * rows + row]: where points of that cell begin, as in descent_cut */
} query_descent;

/** Prepares it. FROE_E_MEMORY. O(nodes), once for all forks. */
froe_status query_descent_of(froe_query *query, const query_descent **out, froe_diagnostic *diag);

/** A point in progress. */
typedef struct descent_point {
    float at[2];   /**< in units */
    uint32_t next; /**< as in descent_cut */
} descent_point;

/** Where a point is, and the place in the table where it begins; SIZE_MAX: it is outside of the scene. */
static inline size_t query_descent_cell(const query_descent *d, const double *x, float at[2]) {
    for (int k = 0; k < 2; k++) at[k] = (float)((x[k] - d->lo[k]) * d->scale);
    const float column = at[0] * d->grid, row = at[1] * d->grid;
    if (!(column >= 0 && row >= 0 && column < (float)d->columns && row < (float)d->rows)) return SIZE_MAX;
    return (size_t)(uint32_t)column * d->rows + (uint32_t)row;
}
/** Begins with a point; false: it is outside of the scene. */
static inline bool query_descent_begin(const query_descent *d, const double *x, descent_point *out) {
    const size_t cell = query_descent_cell(d, x, out->at);
    if (cell == SIZE_MAX) return false;
    out->next = d->table[cell];
    return true;
}
/** Prefetches the table entry that a point begins with. */
static inline void query_descent_ask(const query_descent *d, const double *x) {
    float at[2];
    const size_t cell = query_descent_cell(d, x, at);
    if (cell != SIZE_MAX) __builtin_prefetch(d->table + cell);
}
/** The value of a cut at a point. */
static inline float query_descent_value(const descent_cut *cut, const float at[2]) {
    const bool steep = cut->next[0] & DESCENT_STEEP;
    return at[steep] + cut->slope * at[!steep] + cut->c;
}
static inline uint32_t query_descent_next(const descent_cut *cut, bool right) {
    return cut->next[right] & ~DESCENT_STEEP;
}
#endif
