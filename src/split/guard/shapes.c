/* shapes.c: the shape of each object, and the boxes of shapes as a scene. */
#include "split/guard/shapes.h"
#include "support/alloc.h"
#include <float.h>
#include <math.h>

/* Numbers groups in the order in which objects name them, and counts objects that have none. */
static froe_status number_shapes(const froe_allocator *alloc, const froe_scene *s, split_shapes *out) {
    uint32_t *of_group = support_calloc(alloc, s->group_count, sizeof *of_group); /* 1 more, 0: none yet */
    if (!of_group) return FROE_E_MEMORY;
    for (uint32_t i = 0; i < s->object_count; i++) {
        const uint32_t group = s->groups ? s->groups[i] : FROE_NONE;
        uint32_t alone = 0, *shape = group < s->group_count ? of_group + group : &alone;
        if (!*shape) *shape = ++out->count;
        out->of[i] = *shape - 1;
    }
    support_free(alloc, of_group, s->group_count * sizeof *of_group);
    return FROE_OK;
}

/* lo and hi of each shape, within the finite numbers. */
static void bound_shapes(const froe_scene *s, const split_shapes *shapes, double *ends) {
    const size_t dim = (size_t)s->dim;
    for (size_t i = 0; i < shapes->count * 2 * dim; i++) ends[i] = i / dim % 2 ? -DBL_MAX : DBL_MAX;
    for (uint32_t i = 0; i < s->object_count; i++) {
        double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM], *least = ends + shapes->of[i] * 2 * dim, *most = least + dim;
        scene_object_bounds(s, i, lo, hi);
        for (size_t k = 0; k < dim; k++) {
            least[k] = fmax(fmin(least[k], lo[k]), -DBL_MAX);
            most[k] = fmin(fmax(most[k], hi[k]), DBL_MAX);
        }
    }
}

static froe_status make_boxes(const froe_allocator *alloc, const froe_scene *s, split_shapes *out) {
    const size_t numbers = (size_t)out->count * 2 * (size_t)s->dim;
    froe_objects boxes = froe_objects_defaults();
    double *ends = support_calloc(alloc, numbers, sizeof *ends);
    if (!ends) return FROE_E_MEMORY;
    bound_shapes(s, out, ends);
    boxes.kind = FROE_BOX;
    boxes.count = out->count;
    boxes.coords = ends;
    froe_status status = froe_scene_new(s->dim, alloc, &out->boxes);
    if (!status) status = froe_scene_add(out->boxes, &boxes, NULL);
    support_free(alloc, ends, numbers * sizeof *ends);
    return status;
}

froe_status split_shapes_make(const froe_allocator *alloc, const froe_scene *scene, split_shapes *out) {
    split_shapes shapes = {.object_count = scene->object_count};
    shapes.of = support_calloc(alloc, scene->object_count, sizeof *shapes.of);
    froe_status status = shapes.of ? number_shapes(alloc, scene, &shapes) : FROE_E_MEMORY;
    if (!status) status = make_boxes(alloc, scene, &shapes);
    if (status)
        split_shapes_free(alloc, &shapes);
    else
        *out = shapes;
    return status;
}

void split_shapes_free(const froe_allocator *alloc, split_shapes *shapes) {
    support_free(alloc, shapes->of, shapes->object_count * sizeof *shapes->of);
    froe_scene_free(shapes->boxes);
    *shapes = (split_shapes){0};
}

froe_status split_shape_marks_make(const froe_allocator *alloc, const split_shapes *shapes, split_shape_marks *out) {
    *out = (split_shape_marks){.count = shapes->count};
    out->turns = support_calloc(alloc, shapes->count, sizeof *out->turns);
    return out->turns ? FROE_OK : FROE_E_MEMORY;
}

void split_shape_marks_free(const froe_allocator *alloc, split_shape_marks *marks) {
    support_free(alloc, marks->turns, marks->count * sizeof *marks->turns);
    *marks = (split_shape_marks){0};
}
