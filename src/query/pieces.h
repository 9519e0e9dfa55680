/* pieces.h: facts about a tree's pieces that are prepared once for many queries.
 *
 * Where all objects are points, their coordinates in the order of the lists:
 *
 *     lists         ... | 7  4 | 12  0  9 | ...         objects
 *     points        ... | x  x |  x  x  x | ...         dim doubles each
 *
 * A search that tests the points of a leaf finds them beside each other, and not anywhere in the scene. */
#ifndef FROE_QUERY_PIECES_H
#define FROE_QUERY_PIECES_H
#include "query/context.h"

typedef struct query_pieces {
    query_part part;
    bool flat;      /**< lists lie in pieces, and no object is solid: each has a point in every cell that lists it */
    bool whole;     /**< ... and no object is divided: each is in one list only */
    double *points; /**< [number of the piece * dim]; NULL: some object is no point, or is in several lists */
    size_t size;    /**< of points */
} query_pieces;

/** Prepares them. FROE_E_MEMORY. O(objects), once for all forks. */
froe_status query_pieces_of(froe_query *query, const query_pieces **out, froe_diagnostic *diag);
#endif
