/* bodies.c: see bodies.h. */
#include "formats/input/bodies.h"
#include "support/array.h"
#include "support/fail.h"

typedef struct body_batch {
    ARRAY(double) corners, zeros, births, deaths;
    ARRAY(size_t) plans;
    ARRAY(uint32_t) bodies, groups;
} body_batch;

/* Triangle k of a polygon's fan. What is no more than an edge or a point has corners twice. */
static bool put_triangle(body_batch *b, const froe_allocator *alloc, const froe_scene *model, uint32_t object,
                         uint32_t k, const formats_life *life) {
    const froe_object o = froe_scene_object(model, object);
    for (uint32_t i = 0; i < 3; i++) {
        const size_t vertex = b->plans.count;
        const uint32_t corner = i ? k + i - 1 : 0, most = o.corners - 1;
        const double *at = froe_scene_vertex(model, froe_scene_corner(model, object, corner < most ? corner : most));
        if (!array_append(alloc, &b->corners, at, 3) || !array_push(alloc, &b->zeros, 0) ||
            !array_push(alloc, &b->plans, vertex) || !array_push(alloc, &b->bodies, life->body))
            return false;
    }
    return array_push(alloc, &b->births, life->birth) && array_push(alloc, &b->deaths, life->death) &&
           array_push(alloc, &b->groups, o.group);
}

static froe_status gather(body_batch *b, const froe_scene *model, const formats_bodies *bodies,
                          const froe_allocator *alloc, froe_diagnostic *diag) {
    for (uint32_t i = 0; i < froe_scene_object_count(model); i++) {
        const froe_object o = froe_scene_object(model, i);
        if (o.kind != FROE_POLYGON)
            return support_fail(diag, FROE_E_UNSUPPORTED, "object %u: It is no polygon, and only those are parts.", i);
        const size_t first = bodies->starts[bodies->parts[i]], end = bodies->starts[bodies->parts[i] + 1];
        for (uint32_t k = 1; k == 1 || k + 1 < o.corners; k++)
            for (size_t life = first; life < end; life++)
                if (!put_triangle(b, alloc, model, i, k, bodies->lives + life)) return support_fail_memory(diag);
    }
    const size_t vertices = b->plans.count;
    return array_push(alloc, &b->plans, vertices) ? FROE_OK : support_fail_memory(diag);
}

froe_status formats_add_bodies(froe_motion *motion, const froe_scene *model, const formats_bodies *bodies,
                               const froe_allocator *alloc, froe_diagnostic *diag) {
    body_batch b = {.corners = {0}};
    froe_status status = FROE_OK;
    for (uint32_t g = 0; g < froe_scene_group_count(model) && !status; g++) {
        const froe_group group = froe_scene_group(model, g);
        uint32_t id;
        if (froe_motion_add_group(motion, &group, &id)) status = support_fail_memory(diag);
    }
    if (!status) status = gather(&b, model, bodies, alloc, diag);
    if (!status) {
        froe_moving batch = froe_moving_defaults();
        batch.vertex_count = b.zeros.count, batch.count = b.births.count, batch.starts = b.plans.data;
        batch.times = b.zeros.data, batch.coords = b.corners.data, batch.bodies = b.bodies.data;
        batch.births = b.births.data, batch.deaths = b.deaths.data, batch.groups = b.groups.data;
        status = froe_motion_add(motion, &batch, diag);
    }
    array_free(alloc, &b.corners), array_free(alloc, &b.zeros), array_free(alloc, &b.births);
    array_free(alloc, &b.deaths), array_free(alloc, &b.plans), array_free(alloc, &b.bodies);
    array_free(alloc, &b.groups);
    return status;
}
