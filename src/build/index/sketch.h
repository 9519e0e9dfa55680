/* sketch.h: the upper nodes of a tree of space, by a sample of the objects; and all objects dealt to them at once.
 *
 *             *           Cutting one cell after the other reads all objects at each level. The choice of a cut needs
 *           /   \         few of them. So the upper cuts are found with a sample (build/index/space.c). Each object
 *          *     *        then goes down to the nodes that are left without a cut, and is listed there by its id.
 *         / \   / \       Where such a node is filled, those objects are clipped again that the cuts on its way
 *        ids   ...        divided. */
#ifndef FROE_BUILD_INDEX_SKETCH_H
#define FROE_BUILD_INDEX_SKETCH_H
#include "build/index/deal.h"
#include "build/index/surface.h"
#include "build/method.h"

/** An object of its own, as an item. */
static inline space_item sketch_item(const froe_scene *s, uint32_t object) {
    space_item item = {.object = object, .corner = space_is_triangle(s, object) ? scene_start(s, object) : FROE_NONE};
    scene_bounds_in(s, 3, object, item.lo, item.hi);
    return item;
}

typedef struct space_sketch {
    const tree_node *nodes; /**< of cuts; child 0: without one */
    uint32_t count;
    uint32_t *parents; /**< node -> node */
    uint32_t *listed;  /**< node -> objects that come to it */
    uint32_t *starts;  /**< node without a cut -> ids; others have none */
    uint32_t *ids;
} space_sketch;

/** Deals all objects of the job's scene to the nodes, which have to stay. FROE_E_MEMORY, FROE_E_LIMIT,
 * FROE_E_CANCELLED. */
froe_status sketch_new(build_job *job, const tree_node *nodes, uint32_t count, space_sketch *out);
void sketch_free(const build_job *job, space_sketch *sketch);
/** The items of a node without a cut: for each of its ids, the bounds of the object's part in the cell. FROE_E_MEMORY.
 */
froe_status sketch_fill(const build_job *job, const space_sketch *sketch, uint32_t node, space_item *out);
#endif
