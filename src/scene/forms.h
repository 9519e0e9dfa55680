/* forms.h: a batch on its way into the scene, and what each of its objects really is. */
#ifndef FROE_SCENE_FORMS_H
#define FROE_SCENE_FORMS_H
#include "scene/store.h"

typedef struct scene_adding {
    froe_scene *scene;
    const froe_objects *batch;
    froe_diagnostic *diag;
    size_t each;           /**< corners of every object; 0: batch->starts tells */
    size_t first, corners; /**< the batch's corners are first .. first + corners - 1 */
    size_t gap;            /**< room that the forms need beyond the corners: radii of balls */
    size_t used;           /**< corners of the forms made so far */
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
} scene_adding;

/** The batch's first corner of its object j. */
static inline size_t scene_adding_corner(const scene_adding *a, size_t j) {
    return a->batch->starts ? a->batch->starts[j] : j * a->each;
}

/** Turns the vertices of object j of the batch into the corners of its form, in place;
 * *count grows for balls only. FROE_E_INPUT names object, corner, axis and reason. */
froe_status scene_form_object(scene_adding *a, size_t j, uint32_t *ring, uint32_t *count, froe_kind *form);
#endif
