/* forms.h: a batch on its way into the scene: its vertices, and what each of its objects really is. */
#ifndef FROE_SCENE_FORMS_H
#define FROE_SCENE_FORMS_H
#include "base/task.h"
#include "scene/store.h"

typedef struct scene_adding {
    froe_scene *scene;
    const froe_objects *batch;
    froe_diagnostic *diag;
    base_task task;
    size_t each;           /**< corners of every object; 0: batch->starts tells */
    size_t first, corners; /**< the batch's corners are first .. first + corners - 1 */
    size_t gap;            /**< room that the forms need beyond the corners: radii of balls */
    size_t used;           /**< corners of the forms made so far */
    uint32_t vertices;     /**< of the scene with this batch */
    bool in_order;         /**< its corners are new vertices, one after the other; then they have no ids yet */
    bool plain;            /**< every object keeps its `each` corners and has the form `form` */
    froe_kind form;
    bool kinds, forms, starts, ids; /**< which arrays of the scene have to tell */
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
} scene_adding;

/** The batch's first corner of its object j. */
static inline size_t scene_adding_corner(const scene_adding *a, size_t j) {
    return a->each ? a->first + j * a->each : a->batch->starts[j];
}
/** The point of a corner of the batch. */
static inline const double *scene_adding_point(const scene_adding *a, size_t corner) {
    const froe_objects *b = a->batch;
    return b->coords + (b->indices ? b->indices[corner] : corner) * (size_t)a->scene->dim;
}
/** The vertices of its corners, unless they are in order: behind the ids of the scene, and the gap. */
static inline uint32_t *scene_adding_ids(const scene_adding *a) {
    return a->scene->store->vertex_of.data + a->scene->store->vertex_of.count + a->gap;
}
/** Room for these ids. */
static inline bool scene_adding_room(const scene_adding *a) {
    return array_reserve(&a->scene->alloc, &a->scene->store->vertex_of, a->corners + a->gap);
}

/** FROE_E_CANCELLED, with its sentence, where the caller's function says so. */
froe_status scene_adding_progress(scene_adding *a, double share);

/** The vertices of all corners, those that are new behind the others. FROE_E_INPUT names object, corner, axis and
 * reason; also FROE_E_LIMIT, FROE_E_MEMORY, FROE_E_CANCELLED. */
froe_status scene_take_corners(scene_adding *a);
/** The same for large batches, several times as fast. *done false: not for this one, and nothing has changed.
 * FROE_E_MEMORY, FROE_E_CANCELLED. */
froe_status scene_take_corners_at_once(scene_adding *a, bool *done);

/** Takes the context for exact numbers that polygons need, unless doubles settle their forms. FROE_E_MEMORY. */
froe_status scene_adding_context(const scene_adding *a);
/** Finds out whether the batch is plain. FROE_E_MEMORY, FROE_E_CANCELLED. */
froe_status scene_look_at_forms(scene_adding *a);
/** Turns the vertices of object j of the batch into the corners of its form, in place;
 * *count grows for balls only. FROE_E_INPUT names object, corner, axis and reason. */
froe_status scene_form_object(scene_adding *a, size_t j, uint32_t *ring, uint32_t *count, froe_kind *form);

/** Makes room in all arrays that have to tell, and lets them tell of the objects there are. FROE_E_MEMORY. */
froe_status scene_adding_settle(scene_adding *a);
/** Lets the store tell of the batch. */
void scene_adding_commit(const scene_adding *a);
#endif
