/* surface.c: the public calls for patches, edges, wires and points. */
#include "view/visibility/surface.h"
#include "base/floats.h"
#include "geom/selftest.h"
#include "support/fail.h"

static void free_words(const froe_surface *s, uint32_t *words, size_t count) {
    support_free(&s->alloc, words, (count ? count : 1) * sizeof *words);
}

void froe_surface_free(froe_surface *s) {
    if (!s) return;
    const froe_allocator alloc = s->alloc;
    const size_t n = s->scene->object_count, corners = s->scene->corner_count;
    free_words(s, s->edge_of, corners);
    free_words(s, s->vertices, 2 * surface_line_count(s));
    free_words(s, s->wires, s->wire_count);
    free_words(s, s->points, s->point_count);
    free_words(s, s->edge_starts, (size_t)s->edge_count + 1);
    free_words(s, s->uses, s->use_count);
    support_free(&alloc, s->inside, (size_t)s->edge_count + 1);
    free_words(s, s->patch_of, n + 1);
    free_words(s, s->patch_starts, n + 2);
    free_words(s, s->members, n + 1);
    support_free(&alloc, s->straight, corners + 1);
    support_free(&alloc, s, sizeof *s);
}

froe_status froe_surface_new(const froe_scene *scene, const froe_allocator *alloc, froe_surface **out,
                             froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!scene || !out) return support_fail_null(diag, __func__);
    if (scene->dim != 3)
        return support_fail(diag, FROE_E_UNSUPPORTED, "Surfaces exist in 3 dimensions, not in %d.", scene->dim);
    const froe_status settled = scene_settle(scene, diag);
    if (settled) return settled;
    const froe_allocator own = support_allocator(alloc);
    froe_surface *s = support_calloc(&own, 1, sizeof *s);
    if (!s) return support_fail_memory(diag);
    s->alloc = own;
    s->scene = scene;
    num_context context;
    froe_status status = surface_find_edges(s);
    if (!status) status = geom_context_new(&own, &context);
    if (!status) {
        status = surface_find_patches(s, &context);
        num_context_free(&context);
    }
    if (status) {
        froe_surface_free(s);
        return support_fail_memory(diag);
    }
    *out = s;
    return FROE_OK;
}

size_t froe_surface_patch_count(const froe_surface *s) {
    return s->patch_count;
}

froe_patch froe_surface_patch(const froe_surface *s, uint32_t patch) {
    if (patch >= s->patch_count) return (froe_patch){.group = FROE_NONE};
    const uint32_t first = surface_first(s, patch);
    return (froe_patch){.group = s->scene->groups ? s->scene->groups[first] : FROE_NONE,
                        .objects = s->members + s->patch_starts[patch],
                        .object_count = s->patch_starts[patch + 1] - s->patch_starts[patch]};
}

uint32_t froe_surface_patch_of(const froe_surface *s, uint32_t object) {
    return object < s->scene->object_count ? s->patch_of[object] : FROE_NONE;
}

size_t froe_surface_edge_count(const froe_surface *s) {
    return s->edge_count;
}

froe_edge froe_surface_edge(const froe_surface *s, uint32_t edge) {
    if (edge >= s->edge_count) return (froe_edge){.vertex = {FROE_NONE, FROE_NONE}};
    return (froe_edge){.vertex = {s->vertices[2 * (size_t)edge], s->vertices[2 * (size_t)edge + 1]},
                       .objects = s->uses + s->edge_starts[edge],
                       .object_count = s->edge_starts[edge + 1] - s->edge_starts[edge]};
}

uint32_t froe_surface_edge_of(const froe_surface *s, uint32_t object, uint32_t corner) {
    const froe_scene *scene = s->scene;
    if (object >= scene->object_count || scene_form(scene, object) != FROE_POLYGON ||
        corner >= scene_corners(scene, object))
        return FROE_NONE;
    return s->edge_of[scene_start(scene, object) + corner];
}

size_t froe_surface_wire_count(const froe_surface *s) {
    return s->wire_count;
}

uint32_t froe_surface_wire(const froe_surface *s, uint32_t wire) {
    return wire < s->wire_count ? s->wires[wire] : FROE_NONE;
}

size_t froe_surface_point_count(const froe_surface *s) {
    return s->point_count;
}

uint32_t froe_surface_point(const froe_surface *s, uint32_t point) {
    return point < s->point_count ? s->points[point] : FROE_NONE;
}

bool surface_ascends(const froe_surface *s, uint32_t object, uint32_t edge) {
    const froe_scene *scene = s->scene;
    for (uint32_t i = 0; i < scene_corners(scene, object); i++)
        if (s->edge_of[scene_start(scene, object) + i] == edge)
            return scene_corner(scene, object, i) == s->vertices[2 * (size_t)edge];
    return false;
}
