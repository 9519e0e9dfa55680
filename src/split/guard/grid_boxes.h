/* grid_boxes.h: where on a grid the boxes of a scene's objects lie, found once for guard trees and for lowest_nodes.h.
 *
 *     +---+---+---+---+      An object is two codes (guard_grid.h): of the cell where its box begins, and of the one
 *     |   |   | ..|...|hi    where it ends. The codes of its other corners are mixed of these, axis by axis, and the
 *     +---+---+-:-+--:+      bits in which they begin alike tell the smallest octree cube that holds it.
 *     |   |   | :.|..:|
 *     +---+---+---+---+lo    Boxes that touch a plane of the grid are set apart: for them comparisons decide. */
#ifndef FROE_SPLIT_GUARD_GRID_BOXES_H
#define FROE_SPLIT_GUARD_GRID_BOXES_H
#include "base/task.h"
#include "scene/scene.h"
#include "split/guard/guard_grid.h"

/* In the first code: bits from here on, axis 0 lowest, say where the box is flat. */
enum { GRID_BOXES_FLAT = GUARD_CODE_BITS };
#define GRID_BOXES_APART 0x80000000u /* in the first code: the box touches a plane */

typedef struct split_grid_boxes {
    const froe_scene *scene;
    guard_cube root;
    guard_grid grid; /* levels 0: no grid is worth while, or possible */
    uint32_t (*codes)[2];
    char *tables;
    size_t object_count, table_bytes;
} split_grid_boxes;

/** Time O(d n). FROE_E_MEMORY, FROE_E_CANCELLED. */
froe_status split_grid_boxes_make(const froe_allocator *alloc, base_task *task, const froe_scene *scene,
                                  split_grid_boxes *out);
void split_grid_boxes_free(const froe_allocator *alloc, split_grid_boxes *grid_boxes);
#endif
