/* shapes.h: shapes of many parts, which the guard stage knows by one box each.
 *
 *      +--------------+      An island of a thousand segments has four guards instead of four thousand. The guard
 *      |   /\/\  _/\  |      tree then divides a scene by its shapes: (2^d - 1)(2 m / k - 1) + 1 cells for m guards
 *      |  /    \/  _\ |      of shapes, and a cube with at most k of them meets at most k + c_d lambda shapes, where
 *      |  \/\_/\/\/   |      lambda is the density of shapes, however many parts they have. Parts are carried down,
 *      +--------------+      and refinement separates them within the cells.
 *
 * Sacks, "Density sensitive BSP construction": low density shapes of arbitrary complexity, represented by the corners
 * of their bounding boxes (lemmas 12.6 and 12.7). A shape is a group of the scene; an object without a group is one. */
#ifndef FROE_SPLIT_GUARD_SHAPES_H
#define FROE_SPLIT_GUARD_SHAPES_H
#include "scene/scene.h"

typedef struct split_shapes {
    uint32_t count, object_count;
    uint32_t *of;      /**< [object]: its shape */
    froe_scene *boxes; /**< the boxes of shapes, in order */
} split_shapes;

/** O(d n). FROE_E_MEMORY. */
froe_status split_shapes_make(const froe_allocator *alloc, const froe_scene *scene, split_shapes *out);
void split_shapes_free(const froe_allocator *alloc, split_shapes *shapes);

/** What one thread needs to count shapes. */
typedef struct split_shape_marks {
    uint32_t turn, count;
    uint32_t *turns; /**< [shape]: when it was last counted */
} split_shape_marks;

/** FROE_E_MEMORY. */
froe_status split_shape_marks_make(const froe_allocator *alloc, const split_shapes *shapes, split_shape_marks *out);
void split_shape_marks_free(const froe_allocator *alloc, split_shape_marks *marks);
/** Begins to count anew. */
static inline void split_shapes_begin(split_shape_marks *marks) {
    if (++marks->turn) return;
    for (uint32_t i = 0; i < marks->count; i++) marks->turns[i] = 0;
    marks->turn = 1;
}
/** Is the object the first of its shape that is counted? */
static inline bool split_shapes_first(const split_shapes *shapes, split_shape_marks *marks, uint32_t object) {
    uint32_t *turn = marks->turns + shapes->of[object];
    const bool first = *turn != marks->turn;
    *turn = marks->turn;
    return first;
}
#endif
