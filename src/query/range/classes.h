/* classes.h: small ranges by one point location in each class of sizes.
 *
 *     class    objects with         boxes around them, larger by    asked about ranges that reach
 *     none     size 0               0                               never: searched
 *     ...      2^j <= size < 2^j+1  2^j                             2^j from their centre, or less
 *
 * Size and reach are half the greatest extent along an axis. What meets a range that reaches no further than 2^j has a
 * box that, so enlarged, holds the range's centre: de Berg (Linear size binary space partitions for uncluttered scenes,
 * 2000, Corollary 3.2), after Schwarzkopf and Vleugels (Range searching in low-density environments, 1996), whose boxes
 * grow by the size of the smallest object of the scene; in classes, one small object does not make all others look
 * large. Each class has a tree of its boxes, and in a scene of low density a leaf lists a bounded number of them. Of
 * classes whose objects are smaller than the range the tree is searched for the range's bounds.
 *
 * Boxes are a little larger still, so that the centre is not on their border: then every leaf whose closed cell has the
 * centre lists them.
 *
 * It speaks for classes.c (their trees) and class_search.c (a range is searched for in them). */
#ifndef FROE_QUERY_RANGE_CLASSES_H
#define FROE_QUERY_RANGE_CLASSES_H
#include "query/context.h"

typedef struct query_class {
    double step; /**< 2^j, or 0 */
    uint32_t count;
    uint32_t *ids;     /**< [object of its scene]: the object that it stands for */
    froe_tree *tree;   /**< of its boxes */
    froe_query *query; /**< to be forked */
} query_class;

typedef struct query_classes {
    query_part part;
    uint32_t count;
    query_class *classes; /**< by step */
} query_classes;

/** Prepares them. FROE_E_MEMORY, and what building refuses. O(objects log objects), once for all forks. */
froe_status query_classes_of(froe_query *query, const query_classes **out, froe_diagnostic *diag);
/** Reports the objects that meet query->range. FROE_E_MEMORY, and what building refuses. */
froe_status query_classes_search(froe_query *query, froe_diagnostic *diag);
#endif
