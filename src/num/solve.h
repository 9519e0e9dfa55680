/* solve.h: linear equations in dyadic numbers, exactly.
 *
 * Elimination without fractions (Bareiss: Sylvester's identity and multistep integer-preserving Gaussian elimination,
 * 1968), for all rows at once (Gauss and Jordan). After each step every number of the table is a minor of what it was
 * in the beginning, so that numbers grow no more than their degrees do, and every division leaves no remainder:
 *
 *     | a b c : r |          | p . . : s |         x = s / p,  y = t / p,  z = u / p
 *     | d e f : q |   --->   | . p . : t |         p: the determinant, or of a table of less rank a minor
 *     | g h i : v |          | . . p : u |
 */
#ifndef FROE_NUM_SOLVE_H
#define FROE_NUM_SOLVE_H
#include "num/dyadic.h"

enum { NUM_TABLE_ROWS = FROE_MAX_DIM + 2, NUM_TABLE_COLUMNS = FROE_MAX_DIM + 4 };

typedef struct num_table {
    int rows, columns; /**< columns: right sides included */
    num_dyadic at[NUM_TABLE_ROWS][NUM_TABLE_COLUMNS];
    int rank;                  /**< after num_table_solve(): the first rows are those of the pivots */
    int pivot[NUM_TABLE_ROWS]; /**< the column of each of them */
    num_dyadic scale;          /**< what stands in it: the same in all */
} num_table;

/** Eliminates in the first `unknowns` columns. A column without a pivot depends on those before it: its numbers, over
 * the scale, say how. The arena holds the table alone behind where it stood when the table was filled (`mark`), twice
 * and more while this runs: for entries of degree k, rows x columns x rank x k x 33 limbs at most, and as many again.
 */
void num_table_solve(num_arena *arena, size_t mark, num_table *table, int unknowns);

/** The same in plain doubles, for guesses: rows of `columns` numbers, of which the first `rows` are eliminated in
 * place, by pivots. Right sides are then the answers. False: (nearly) singular. */
bool num_plain_solve(int rows, int columns, double table[][NUM_TABLE_COLUMNS]);
#endif
