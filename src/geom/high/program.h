/* program.h: linear programs with few constraints, exactly.
 *
 *     find v >= 0  with  sum of v_j column_j = right side  and v_goal least, or greatest
 *
 * by the simplex method: a basis of as many columns as there are rows; a column that makes the goal better comes, one
 * that would become negative goes. Always those with the lowest numbers (Bland: New finite pivoting rules for the
 * simplex method, 1977), so that it ends, however degenerate the columns. It begins with unit vectors, which must go
 * again where they have weight. Those without weight may stay: then the columns do not span all rows. The search in
 * plain doubles comes first; the exact one goes on from its basis, where that is one. */
#ifndef FROE_GEOM_HIGH_PROGRAM_H
#define FROE_GEOM_HIGH_PROGRAM_H
#include "num/context.h"
#include "num/solve.h"

enum { GEOM_RIGHT_SIDE = 0x7fffff00, GEOM_UNIT }; /* numbers of columns; from GEOM_UNIT on unit vectors */

typedef struct geom_program {
    int rows;         /**< NUM_TABLE_ROWS at most */
    uint32_t columns; /**< numbered from 0 */
    uint32_t goal;    /**< a column; GEOM_RIGHT_SIDE: any solution will do */
    int sense;        /**< 1: least, -1: greatest; it must be bounded */
    const void *user;
    void (*column)(const void *user, num_arena *arena, uint32_t j, num_dyadic *out);
    /** About that, each row scaled as it likes. */
    void (*image)(const void *user, uint32_t j, double *out);
} geom_program;

typedef struct geom_solution {
    bool feasible;
    int sign;                       /**< of v_goal */
    uint32_t basis[NUM_TABLE_ROWS]; /**< columns; v is 0 elsewhere */
} geom_solution;

/** Takes the arena: what it held is lost. */
geom_solution geom_program_solve(num_context *context, const geom_program *program);
#endif
