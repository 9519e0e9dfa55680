/* bodies.c: see bodies.h. */
#include "formats/input/bodies.h"
#include "support/array.h"
#include "support/fail.h"

/* The last body that had a vertex of the plane, and its number then. */
typedef struct body_vertex {
    uint32_t body, number;
} body_vertex;

typedef struct body_batch {
    ARRAY(double) corners, zeros, births, deaths;
    ARRAY(size_t) plans;
    ARRAY(uint32_t) bodies, groups, vertices; /* vertices: of segments; triangles have their own, in order */
    ARRAY(body_vertex) known;                 /* [vertex of the model] in the plane */
} body_batch;

static bool put_vertex(body_batch *b, const froe_allocator *alloc, const double *at, size_t dim, uint32_t body) {
    const size_t vertex = b->plans.count;
    return array_append(alloc, &b->corners, at, dim) && array_push(alloc, &b->zeros, 0) &&
           array_push(alloc, &b->plans, vertex) && array_push(alloc, &b->bodies, body);
}

static bool put_life(body_batch *b, const froe_allocator *alloc, const formats_life *life, uint32_t group) {
    return array_push(alloc, &b->births, life->birth) && array_push(alloc, &b->deaths, life->death) &&
           array_push(alloc, &b->groups, group);
}

/* Triangle k of a polygon's fan. What is no more than an edge or a point has corners twice. */
static bool put_triangle(body_batch *b, const froe_allocator *alloc, const froe_scene *model, uint32_t object,
                         uint32_t k, const formats_life *life) {
    const froe_object o = froe_scene_object(model, object);
    for (uint32_t i = 0; i < 3; i++) {
        const uint32_t corner = i ? k + i - 1 : 0, most = o.corners - 1;
        const double *at = froe_scene_vertex(model, froe_scene_corner(model, object, corner < most ? corner : most));
        if (!put_vertex(b, alloc, at, 3, life->body)) return false;
    }
    return put_life(b, alloc, life, o.group);
}

/* A segment of the plane; a point is one from itself to itself. */
static bool put_bar(body_batch *b, const froe_allocator *alloc, const froe_scene *model, uint32_t object,
                    const formats_life *life) {
    const froe_object o = froe_scene_object(model, object);
    for (uint32_t i = 0; i < 2; i++) {
        const uint32_t corner = froe_scene_corner(model, object, i < o.corners ? i : 0);
        body_vertex *known = b->known.data + corner;
        if (known->body != life->body) {
            *known = (body_vertex){life->body, (uint32_t)b->plans.count};
            if (!put_vertex(b, alloc, froe_scene_vertex(model, corner), 2, life->body)) return false;
        }
        if (!array_push(alloc, &b->vertices, known->number)) return false;
    }
    return put_life(b, alloc, life, o.group);
}

static bool put_lives(body_batch *b, const froe_allocator *alloc, const froe_scene *model, uint32_t object,
                      const formats_life *life, size_t lives) {
    const uint32_t corners = froe_scene_object(model, object).corners;
    bool room = true;
    if (froe_scene_dim(model) == 2) {
        for (size_t i = 0; i < lives && room; i++) room = put_bar(b, alloc, model, object, life + i);
        return room;
    }
    for (uint32_t k = 1; (k == 1 || k + 1 < corners) && room; k++)
        for (size_t i = 0; i < lives && room; i++) room = put_triangle(b, alloc, model, object, k, life + i);
    return room;
}

static froe_status gather(body_batch *b, const froe_scene *model, const formats_bodies *bodies,
                          const froe_allocator *alloc, froe_diagnostic *diag) {
    const bool flat = froe_scene_dim(model) == 2;
    const size_t corners = flat ? froe_scene_vertex_count(model) : 0;
    if (!array_reserve(alloc, &b->known, corners)) return support_fail_memory(diag);
    while (b->known.count < corners) b->known.data[b->known.count++] = (body_vertex){FROE_NONE, 0};
    for (uint32_t i = 0; i < froe_scene_object_count(model); i++) {
        const froe_object o = froe_scene_object(model, i);
        if (o.kind != (flat ? FROE_SEGMENT : FROE_POLYGON))
            return support_fail(diag, FROE_E_UNSUPPORTED, "object %u: It is no %s, and only those are parts.", i,
                                flat ? "segment" : "polygon");
        const size_t first = bodies->starts[bodies->parts[i]], end = bodies->starts[bodies->parts[i] + 1];
        if (!put_lives(b, alloc, model, i, bodies->lives + first, end - first)) return support_fail_memory(diag);
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
        if (b.vertices.count) batch.vertices = b.vertices.data;
        status = froe_motion_add(motion, &batch, diag);
    }
    array_free(alloc, &b.corners), array_free(alloc, &b.zeros), array_free(alloc, &b.births);
    array_free(alloc, &b.deaths), array_free(alloc, &b.plans), array_free(alloc, &b.bodies);
    array_free(alloc, &b.groups), array_free(alloc, &b.vertices), array_free(alloc, &b.known);
    return status;
}
