/* classes.h: small ranges by one location in cubes of all sizes.
 *
 *       .-------------------.
 *       |   A      .----.   |   An object's class is the level of the least cubes longer than it (cubes.h; longer yet
 *       |          | b  |   |   above four dimensions). It has a cell at each cube of that level that it meets, 2^dim
 *       |    a     |.-. |   |   at most: A, B and C are the cells of a, b and c. A cell lists the objects of its class
 *       |          ||c| |   |   and of all larger classes that meet its closed cube.
 *       |          |'-'B|   |
 *       |          '----'   |   A range lies in one to 2^dim cubes of a level. An object of that class or a larger one
 *       '-------------------'   that meets the range there has a cell that holds the cube, so the smallest cell that
 *                               does lists it. In a scene of low density that list is bounded, and finding the cell by
 * its place along the curve takes O(log n): de Berg's Corollary 3.2 (Linear size binary space partitions for
 * uncluttered scenes, 2000), for ranges as small as the objects around them instead of the smallest of all. The cells
 * of smaller objects follow the cube's place along the curve. They are searched as a compressed quadtree: between the
 * first and the last of a run the highest digit that differs says where to divide it.
 *
 * The lists are copies of those of the next larger cell as far as they meet the cube. Where these have more than
 * CLASSES_MOST ids, which low density excludes, a cell refers to them instead, so that bytes stay linear.
 *
 * It speaks for classes.c (the cells) and class_search.c (a range is searched for in them). */
#ifndef FROE_QUERY_RANGE_CLASSES_H
#define FROE_QUERY_RANGE_CLASSES_H
#include "query/context.h"
#include "query/range/cubes.h"

enum { CLASSES_MOST = 512 };

typedef struct query_cell {
    uint32_t first, own, count; /**< its ids: `own` of its class, then those of larger classes */
    uint32_t parent;            /**< the next larger cell that holds it, or FROE_NONE */
    uint32_t jump, depth;       /**< a cell further up: O(log depth) jumps and parents lead to any (Myers 1983) */
    int16_t level;
    bool refers; /**< are the lists of its parent its own, too? */
} query_cell;

typedef struct query_classes {
    query_part part;
    int dim;
    uint32_t count;
    query_cell *cells; /**< along the curve; a larger one before those it holds */
    double *corners;   /**< [cell][axis] */
    ARRAY(uint32_t) ids;
} query_classes;

/** Prepares them. FROE_E_MEMORY. O(objects log objects) where density is low, once for all forks. */
froe_status query_classes_of(froe_query *query, const query_classes **out, froe_diagnostic *diag);
/** Reports the objects that meet query->range. FROE_E_MEMORY. */
froe_status query_classes_search(froe_query *query, froe_diagnostic *diag);

static inline const double *query_cell_corner(const query_classes *p, uint32_t cell) {
    return p->corners + (size_t)cell * (size_t)p->dim;
}
/** Does the cell hold a cube that does not come before it? */
static inline bool query_cell_holds(const query_classes *p, uint32_t cell, const double *corner) {
    return cube_holds(p->dim, query_cell_corner(p, cell), p->cells[cell].level, corner);
}
#endif
