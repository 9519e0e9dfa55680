/* trapezoid.h: cylindrical partitions of the plane, cut by cut (Agarwal, Erickson and Guibas, "Kinetic BSPs for
 * intersecting segments and disjoint triangles", SODA 1998).
 *
 *        left wall :        above         : right wall      The first fragment of a cell, in the order of
 *                  :______________________:                 priority, says how the cell is cut. Where it
 *                  :    :           :     :                 ends inside, at a vertex or where it crosses
 *                  :    o-----------+     :                 the edge below or above, walls go up and
 *                  :    :     s    /:\    :                 down to the borders of the cell; then comes
 *                  :____:_________/_:_\___:                 its own line.
 *                            below
 *
 * So every cell is a trapezoid: left and right of it are walls (which may meet at infinity), below and above edges that
 * span it. Walls are sheared (geom/plane.h), so that nothing needs a case of its own: vertical segments, equal x,
 * shared ends. An end on a wall that is there already needs no other. What lies in a line that cuts stays in its list.
 * Source and proofs: the paper's section 2. docs/design/cylindrical.md derives the form cell by cell and shows that it
 * gives the paper's tree. */
#ifndef FROE_BUILD_CYLINDRICAL_TRAPEZOID_H
#define FROE_BUILD_CYLINDRICAL_TRAPEZOID_H
#include "base/apart.h"
#include "split/fragment.h"

/** A point, or what a cell has of a segment. 64 bytes hold all that most comparisons read. */
typedef struct trapezoid_part {
    double p[2][2];  /**< the ends of the whole object, from left to right */
    double x[2];     /**< of the ends of the part, or images of that */
    float error;     /**< every x is as near to the true one */
    uint32_t object; /**< with TRAPEZOID_TURNED: corner 1 is the left end */
    uint32_t end[2]; /**< ring entries: number of the own end, or TREE_EDGE_CUT and the node whose cut ends it */
} trapezoid_part;
#define TRAPEZOID_TURNED 0x80000000u

typedef struct trapezoid_wall {
    double x;
    float error;
    uint32_t node; /**< whose cut it is (ring numbering); FROE_NONE: there is no wall */
} trapezoid_wall;

typedef struct trapezoid_cell {
    uint32_t node; /**< ring numbering */
    uint32_t depth;
    uint32_t first, count; /**< its parts, on top of the stack */
    trapezoid_wall wall[2];
} trapezoid_cell;

/** What one thread works with. */
typedef struct trapezoid_work {
    split_set set; /**< scene, numbers, drafts, classes */
    uint32_t leaf; /**< cells with so many parts are done */
    double span[2];
    bool filtered; /**< may filters decide? */
    ARRAY(trapezoid_cell) cells;
    ARRAY(trapezoid_part) parts, spare;
    base_apart apart;
} trapezoid_work;

/** FROE_E_MEMORY: there is nothing to free. */
froe_status trapezoid_work_new(const froe_scene *scene, const froe_allocator *alloc, num_stage first, uint32_t leaf,
                               trapezoid_work *out);
void trapezoid_work_free(trapezoid_work *work);
/** A whole object of the plane: a point or segment. */
trapezoid_part trapezoid_whole(const froe_scene *scene, uint32_t object);
/** Ends a cell, whose parts are on top, or cuts it and pushes its children. FROE_E_MEMORY, FROE_E_LIMIT. O(parts). */
froe_status trapezoid_step(trapezoid_work *work, const trapezoid_cell *cell);
#endif
