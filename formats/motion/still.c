/* still.c: froe_motion_scene: what moves, as it is at an instant. */
#include "support/array.h"
#include "support/fail.h"
#include "support/floats.h"
#include <froe/formats.h>
#include <math.h>

typedef struct still_batch {
    ARRAY(double) coords;
    ARRAY(size_t) starts;
    ARRAY(uint64_t) tags;
    ARRAY(uint32_t) groups;
} still_batch;

/* Objects that are there, in the instant itself: what ends then is gone, unless the window ends, too. */
static froe_status gather_still(const froe_motion *motion, double time, const froe_allocator *alloc, still_batch *b,
                                froe_diagnostic *diag) {
    const froe_motion_options window = froe_motion_window(motion);
    const size_t corners = window.dim == 3 ? 3 : 2;
    bool room = array_push(alloc, &b->starts, 0);
    for (uint32_t i = 0; i < froe_motion_object_count(motion) && room; i++) {
        const froe_moving_object o = froe_motion_object(motion, i);
        if (!(o.birth <= time && (time < o.death || (time == o.death && time == window.end)))) continue;
        for (size_t k = 0; k < corners && room; k++) {
            double at[3];
            if (!froe_motion_position(motion, o.vertices[k], time, at))
                return support_fail_at(diag, FROE_E_INPUT, i, FROE_NONE, FROE_NONE,
                                       "object %u: Its plan does not cover the time %.17g.", i, time);
            room = array_append(alloc, &b->coords, at, window.dim);
        }
        const size_t end = b->starts.data[b->starts.count - 1] + corners;
        room = room && array_push(alloc, &b->starts, end) && array_push(alloc, &b->tags, i) &&
               array_push(alloc, &b->groups, o.group);
    }
    return room ? FROE_OK : support_fail_memory(diag);
}

froe_status froe_motion_scene(const froe_motion *motion, double time, const froe_allocator *allocator, froe_scene **out,
                              froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (!motion || !out) return support_fail_null(diag, __func__);
    const froe_allocator alloc = support_allocator(allocator);
    const froe_motion_options window = froe_motion_window(motion);
    if (!(time >= window.begin && time <= window.end))
        return support_fail(diag, FROE_E_ARG, "The time %.17g is not in the window.", time);
    froe_scene *scene = NULL;
    still_batch b = {.coords = {0}};
    froe_status status = gather_still(motion, time, &alloc, &b, diag);
    if (!status) {
        status = froe_scene_new((int)window.dim, &alloc, &scene);
        if (status) status = support_fail_memory(diag);
    }
    for (uint32_t g = 0; g < froe_motion_group_count(motion) && !status; g++) {
        const froe_group group = froe_motion_group(motion, g);
        uint32_t id;
        if (froe_scene_add_group(scene, &group, &id)) status = support_fail_memory(diag);
    }
    if (!status && b.tags.count) {
        froe_objects objects = froe_objects_defaults();
        objects.kind = window.dim == 3 ? FROE_POLYGON : FROE_SEGMENT;
        objects.count = b.tags.count, objects.coords = b.coords.data, objects.tags = b.tags.data;
        objects.starts = window.dim == 3 ? b.starts.data : NULL, objects.groups = b.groups.data;
        status = froe_scene_add(scene, &objects, diag);
    }
    array_free(&alloc, &b.coords), array_free(&alloc, &b.starts);
    array_free(&alloc, &b.tags), array_free(&alloc, &b.groups);
    if (status) {
        froe_scene_free(scene);
        return status;
    }
    *out = scene;
    return FROE_OK;
}
