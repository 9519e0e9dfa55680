/* places.h: where on a grid the boxes of a scene's objects lie, found once for guard trees and for homes.h.
 *
 *     +---+---+---+---+      An object is two codes (guard_grid.h): of the cell where its box begins, and of the one
 *     |   |   | ..|...|hi    where it ends. The codes of its other corners are mixed of these, axis by axis, and the
 *     +---+---+-:-+--:+      bits in which they begin alike tell the smallest octree cube that holds it.
 *     |   |   | :.|..:|
 *     +---+---+---+---+lo    Boxes that touch a plane of the grid are set apart: for them comparisons decide. */
#ifndef FROE_SPLIT_GUARD_PLACES_H
#define FROE_SPLIT_GUARD_PLACES_H
#include "base/task.h"
#include "scene/scene.h"
#include "split/guard/guard_grid.h"

enum { PLACES_FLAT = GUARD_CODE_BITS }; /* in the first code: bits from here on, axis 0 lowest, say where it is flat */
#define PLACES_APART 0x80000000u        /* in the first code: the box touches a plane */

typedef struct split_places {
    const froe_scene *scene;
    guard_cube root;
    guard_grid grid; /* levels 0: no grid is worth while, or possible */
    uint32_t (*codes)[2];
    char *tables;
    size_t object_count, table_bytes;
} split_places;

/** Time O(d n). FROE_E_MEMORY, FROE_E_CANCELLED. */
froe_status split_places_make(const froe_allocator *alloc, base_task *task, const froe_scene *scene, split_places *out);
void split_places_free(const froe_allocator *alloc, split_places *places);
#endif
