/* finish.h: the whole subtree of a small cell of segments in the plane, or polygons in space, from one table of sides.
 *
 *                  a b c d e        A row for the line of each piece, a column for each piece: below (-), above (+),
 *     line of a    0 - + + -        in the line (0), or across it (x). What the filters are sure of is asked once for
 *     line of b    + 0 x + +        all levels of the subtree.
 *     line of c    - - 0 + x
 *     line of d    ...              A row is two bit masks and a cell is another, so counting bits tells how a line
 *                                   would deal with a cell. The line of b splits c: its halves get a column each,
 *     { a b c d e }  by b:          and inherit whatever c was not across.
 *     { c- } and { a c+ d e }
 *
 * The best line or plane by split_price_of() wins, free cuts first, as in refine.h, but all compete that lie along
 * pieces. In space planes across axes take part, and where balance is due or walls are flat only up to a rounding
 * (score/mark.h), planes through vertices (others.c); there a cut is counted exactly before it wins. */
#ifndef FROE_SPLIT_FINISH_H
#define FROE_SPLIT_FINISH_H
#include "split/refine.h"

enum { FINISH_MOST = 48 }; /* pieces of a cell that can be finished, at most */

/** Memory for a worker's table. */
split_table *split_table_new(const froe_allocator *alloc);
void split_table_free(const froe_allocator *alloc, split_table *table);

/** Grows the subtree of a cell of few segments in the plane, or polygons. *done false: it is no such cell, nothing was
 * done. */
froe_status split_finish(const split_refine *config, split_work *work, const split_cell *cell, bool *done);
#endif
