/* guards.h: the guards of a scene: the vertices of every object's bounding box.
 *
 * A box that is flat on an axis has each of its distinct vertices once (a point 1, a segment
 * along an axis 2). Guards of different objects at one place stay different guards: they are
 * counted to bound the number of objects. */
#ifndef FROE_SPLIT_GUARD_GUARDS_H
#define FROE_SPLIT_GUARD_GUARDS_H
#include "base/task.h"
#include "scene/scene.h"

typedef struct split_guards {
    int dim;
    size_t count, capacity;
    double *points; /**< dim doubles a guard; objects in order */
} split_guards;

/** The guards of the objects ids[0 .. count-1]; ids NULL: of the objects 0 .. count-1. Advances task by `span`. */
froe_status split_guards_of(const froe_allocator *alloc, base_task *task, double span, const froe_scene *scene,
                            const uint32_t *ids, size_t count, split_guards *out);
/** Writes the different vertices of a box, 2^dim at most, dim doubles each; returns how many. */
size_t guards_of_box(int dim, const double *lo, const double *hi, double *out);
void split_guards_free(const froe_allocator *alloc, split_guards *guards);
#endif
