/* point_tree.h: a BSP of points as a plan for a BSP of segments (convert.h).
 *
 *     nodes      pairs of children, negative first, after their parents
 *     locations  of each endpoint: the leaf whose open region it lies in, or the inner node whose cut it lies in
 *
 * An endpoint lies in the open region of a node if its leaf or inner node is in the subtree of that node: one
 * comparison, once nodes are numbered in the order of a walk.
 *
 *        |  h         T-junctions on the cut of h are the ends of cuts below h that end there. They are kept in
 *     ---+            order along h, apart for both sides: what lies on one side of h does not end on the other. */
#ifndef FROE_BUILD_CONVERSION_POINT_TREE_H
#define FROE_BUILD_CONVERSION_POINT_TREE_H
#include "build/conversion/region.h"
#include "num/context.h"
#include "scene/scene.h"
#include "support/array.h"

typedef struct point_node {
    froe_cut cut;          /**< kind NONE: a leaf */
    uint32_t child;        /**< of an inner node */
    uint32_t enter, leave; /**< when a walk, negative child first, comes to it and has left it */
} point_node;

typedef struct point_tree {
    froe_allocator alloc;
    const froe_scene *scene; /**< the segments' own: cuts name its vertices */
    ARRAY(point_node) nodes;
    uint32_t height;
    uint32_t *locations;     /**< by vertex: `enter` of that node; FROE_NONE: no endpoint */
    uint32_t *starts;        /**< junctions on node v from its side s (0 negative): starts[2 v + s] .. */
    ARRAY(double) junctions; /**< by the coordinate region_along() the cut, ascending */
} point_tree;

/** A tree of one leaf, to be grown by point_tree_split() in any order. */
froe_status point_tree_new(const froe_allocator *alloc, const froe_scene *scene, point_tree *out);
void point_tree_free(point_tree *tree);
/** Makes a leaf inner; *child: the negative child, *child + 1 the positive one. A normal stays the caller's. */
froe_status point_tree_split(point_tree *tree, uint32_t node, const froe_cut *cut, uint32_t *child);
/** Finds the node of each endpoint, exactly, and junctions. O(n height). */
froe_status point_tree_finish(point_tree *tree, num_context *context);

/** Does the vertex lie in the open region of the node? Of endpoints of the scene's objects. */
static inline bool point_tree_holds(const point_tree *tree, uint32_t node, uint32_t vertex) {
    const point_node *n = tree->nodes.data + node;
    return tree->locations[vertex] >= n->enter && tree->locations[vertex] < n->leave;
}
/** Is there a T-junction, made from that side, on the cut of a node, strictly between two coordinates along it? */
bool point_tree_junction(const point_tree *tree, uint32_t node, int side, double from, double to);
#endif
