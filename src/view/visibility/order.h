/* order.h: the pieces of a tree one after the other, from one eye.
 *
 *              cut
 *       near    |    far          front to back: the side of the eye, then the pieces in the cut, then
 *      eye o    |                 the other side; back to front is the same read backwards
 *
 *     view_order order;
 *     status = view_order_begin(&order, tree, &eye, front_to_back, ranks);
 *     while (view_order_next(&order, &piece)) ...
 *     status = view_order_end(&order);
 *
 * With the eye in a cut its two sides cannot hide each other; the positive one counts as near.
 *
 * It speaks for order.c and orders.c (the public calls). */
#ifndef FROE_VIEW_VISIBILITY_ORDER_H
#define FROE_VIEW_VISIBILITY_ORDER_H
#include "base/radix.h"
#include "geom/eye.h"
#include "tree/tree.h"
#include <froe/view.h>

typedef struct view_visit {
    uint32_t node;
    bool list; /**< only its in-cut list */
} view_visit;

typedef struct view_order {
    const froe_tree *tree;
    geom_eye eye;
    num_context context;
    froe_status status;
    bool front_to_back;
    int section;           /**< of the root's children only that one, see froe_visibility_options; set after begin */
    const uint32_t *ranks; /**< per object; NULL: the face */
    const uint64_t *sides; /**< per node, two bits per eye from `shift` on: side + 1. NULL: computed on the way */
    unsigned shift;
    ARRAY(view_visit) visits;
    ARRAY(base_pair) list; /**< the list being handed out, twice its length: the rest is scratch */
    size_t list_at, list_end;
} view_order;

/** The eye for predicates: FROE_E_ARG when it is not one. */
froe_status view_eye_of(const froe_tree *tree, const froe_eye *eye, geom_eye *out, froe_diagnostic *diag);
/** Side of a node's cut on which the eye is. */
int view_side_of_eye(num_context *context, const froe_tree *tree, uint32_t node, const geom_eye *eye);
/** Can the pieces of this tree be ordered, or (faces) those of its polygons, if it has any? FROE_E_UNSUPPORTED. */
froe_status view_order_check(const froe_tree *tree, bool faces, froe_diagnostic *diag);

froe_status view_order_begin(view_order *order, const froe_tree *tree, const geom_eye *eye, bool front_to_back,
                             const uint32_t *ranks);
/** Starts again from the root, with the same arrays. FROE_E_MEMORY. */
froe_status view_order_restart(view_order *order);
/** False after the last piece, and without memory. */
bool view_order_next(view_order *order, uint32_t *piece);
/** Frees everything; FROE_E_MEMORY when the walk ended for lack of memory. */
froe_status view_order_end(view_order *order);
#endif
