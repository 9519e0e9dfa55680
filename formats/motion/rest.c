/* rest.c: froe_motion_at_rest: a model as a motion in which nothing moves, for eyes that do. */
#include "support/array.h"
#include "support/fail.h"
#include "support/floats.h"
#include <froe/formats.h>

typedef struct rest_batch {
    ARRAY(double) times, coords;
    ARRAY(size_t) starts;
    ARRAY(uint32_t) vertices, groups;
} rest_batch;

static bool gather_vertices(const froe_scene *model, const froe_allocator *alloc, double time, rest_batch *b) {
    const size_t count = froe_scene_vertex_count(model);
    bool room = array_reserve(alloc, &b->starts, count + 1);
    for (uint32_t v = 0; v < count && room; v++) {
        room = array_push(alloc, &b->starts, v) && array_push(alloc, &b->times, time) &&
               array_append(alloc, &b->coords, froe_scene_vertex(model, v), 3);
    }
    return room && array_push(alloc, &b->starts, count);
}

static froe_status gather_triangles(const froe_scene *model, const froe_allocator *alloc, rest_batch *b,
                                    froe_diagnostic *diag) {
    for (uint32_t i = 0; i < froe_scene_object_count(model); i++) {
        const froe_object o = froe_scene_object(model, i);
        if (o.kind != FROE_POLYGON)
            return support_fail_at(diag, FROE_E_UNSUPPORTED, i, FROE_NONE, FROE_NONE,
                                   "object %u: It is a %s, and only polygons can be a motion at rest.", i,
                                   froe_kind_name(o.kind));
        for (uint32_t k = 2; k < o.corners; k++) {
            const uint32_t corners[3] = {froe_scene_corner(model, i, 0), froe_scene_corner(model, i, k - 1),
                                         froe_scene_corner(model, i, k)};
            if (!array_append(alloc, &b->vertices, corners, 3) || !array_push(alloc, &b->groups, o.group))
                return support_fail_memory(diag);
        }
    }
    return FROE_OK;
}

static froe_status add_all(const froe_scene *model, const rest_batch *b, froe_motion *motion, froe_diagnostic *diag) {
    for (uint32_t g = 0; g < froe_scene_group_count(model); g++) {
        const froe_group group = froe_scene_group(model, g);
        uint32_t id;
        if (froe_motion_add_group(motion, &group, &id)) return support_fail_memory(diag);
    }
    froe_moving batch = froe_moving_defaults();
    batch.vertex_count = b->times.count, batch.starts = b->starts.data, batch.times = b->times.data;
    batch.coords = b->coords.data, batch.count = b->groups.count, batch.vertices = b->vertices.data;
    batch.groups = b->groups.data;
    return froe_motion_add(motion, &batch, diag);
}

froe_status froe_motion_at_rest(const froe_scene *model, double begin, double end, const froe_allocator *allocator,
                                froe_motion **out, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (!model || !out) return support_fail_null(diag, __func__);
    if (froe_scene_dim(model) != 3)
        return support_fail(diag, FROE_E_UNSUPPORTED,
                            "The model is in %d dimensions, and only polygons in space can be "
                            "a motion at rest.",
                            froe_scene_dim(model));
    const froe_status checked = froe_scene_check(model, diag);
    if (checked) return checked;
    const froe_allocator alloc = support_allocator(allocator);
    froe_motion_options window = froe_motion_defaults();
    window.dim = 3, window.begin = begin, window.end = end;
    froe_motion *motion = NULL;
    rest_batch b = {.times = {0}};
    froe_status status = froe_motion_new(&window, &alloc, &motion, diag);
    if (!status && !gather_vertices(model, &alloc, begin, &b)) status = support_fail_memory(diag);
    if (!status) status = gather_triangles(model, &alloc, &b, diag);
    if (!status) status = add_all(model, &b, motion, diag);
    array_free(&alloc, &b.times), array_free(&alloc, &b.coords), array_free(&alloc, &b.starts);
    array_free(&alloc, &b.vertices), array_free(&alloc, &b.groups);
    if (status) {
        froe_motion_free(motion);
        return status;
    }
    *out = motion;
    return FROE_OK;
}
