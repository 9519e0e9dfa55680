/* patches.c: polygons connected by edges within one plane, by union-find. */
#include "geom/eye.h"
#include "geom/predicates.h"
#include "view/visibility/surface.h"

static uint32_t find_patch_root(uint32_t *parent, uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]]; /* path halving */
    return i;
}

/* One plane, and the two sides of the edge: then each is left of the edge as it runs, so they run in opposite ways
 * if they turn the same way. */
static bool continues(const froe_surface *s, num_context *context, uint32_t edge, uint32_t a, uint32_t b) {
    geom_plane plane, other;
    scene_support(s->scene, a, &plane);
    for (uint32_t i = 0; i < scene_corners(s->scene, b); i++)
        if (geom_side_vertex(context, &plane, scene_point(s->scene, b, i)) != 0) return false;
    scene_support(s->scene, b, &other);
    bool same = false; /* do they turn the same way, seen from the same side? */
    for (int k = 0, side = 0; k < 3 && !side; k++) {
        const double direction[3] = {k == 0, k == 1, k == 2};
        const geom_eye eye = geom_eye_make(true, direction, NULL);
        side = geom_side_of_eye(context, &plane, &eye);
        same = side && side == geom_side_of_eye(context, &other, &eye);
    }
    return same == (surface_ascends(s, a, edge) != surface_ascends(s, b, edge));
}

static uint32_t group_of(const froe_scene *s, uint32_t object) {
    return s->groups ? s->groups[object] : FROE_NONE;
}

/* Numbers the roots in ascending order and lists the members of each. */
static void number(froe_surface *s, uint32_t *parent) {
    const uint32_t n = s->scene->object_count;
    uint32_t *starts = s->patch_starts;
    for (uint32_t o = 0; o < n; o++) {
        const bool polygon = scene_form(s->scene, o) == FROE_POLYGON;
        const uint32_t root = find_patch_root(parent, o);
        s->patch_of[o] = !polygon ? FROE_NONE : root == o ? s->patch_count++ : s->patch_of[root];
        if (polygon) starts[s->patch_of[o] + 1]++;
    }
    for (uint32_t p = 0; p < s->patch_count; p++) starts[p + 1] += starts[p];
    s->member_count = starts[s->patch_count];
    for (uint32_t o = n; o-- > 0;) { /* downwards, by lowering the ends */
        const uint32_t p = s->patch_of[o];
        if (p != FROE_NONE) s->members[--starts[p + 1]] = o;
    }
    for (uint32_t p = 0; p < s->patch_count; p++) starts[p] = starts[p + 1]; /* ends were lowered to the starts */
    starts[s->patch_count] = s->member_count;
}

froe_status surface_find_patches(froe_surface *s, num_context *context) {
    const size_t n = s->scene->object_count, corners = s->scene->corner_count;
    uint32_t *parent = support_calloc(&s->alloc, n + 1, sizeof *parent);
    s->patch_of = support_calloc(&s->alloc, n + 1, sizeof *s->patch_of);
    s->patch_starts = support_calloc(&s->alloc, n + 2, sizeof *s->patch_starts);
    s->members = support_calloc(&s->alloc, n + 1, sizeof *s->members);
    s->straight = support_calloc(&s->alloc, corners + 1, sizeof *s->straight);
    s->inside = support_calloc(&s->alloc, (size_t)s->edge_count + 1, sizeof *s->inside);
    const bool ok = parent && s->patch_of && s->patch_starts && s->members && s->straight && s->inside;
    if (ok) {
        for (uint32_t o = 0; o < n; o++) parent[o] = o;
        for (uint32_t e = 0; e < s->edge_count; e++) {
            const uint32_t *use = s->uses + s->edge_starts[e];
            if (s->edge_starts[e + 1] - s->edge_starts[e] != 2 || use[0] == use[1]) continue;
            s->inside[e] =
                group_of(s->scene, use[0]) == group_of(s->scene, use[1]) && continues(s, context, e, use[0], use[1]);
            if (!s->inside[e]) continue;
            /* The lower number stays the root, so that a patch is named by its first object. */
            const uint32_t a = find_patch_root(parent, use[0]), b = find_patch_root(parent, use[1]);
            parent[a < b ? b : a] = a < b ? a : b;
        }
        number(s, parent);
    }
    for (uint32_t o = 0; ok && o < n; o++) { /* corners where a polygon of more than three goes straight on */
        const froe_scene *scene = s->scene;
        const uint32_t count = scene_corners(scene, o);
        if (scene_form(scene, o) != FROE_POLYGON || count == 3) continue;
        for (uint32_t i = 0; i < count; i++) {
            const double *const p[3] = {scene_point(scene, o, i ? i - 1 : count - 1), scene_point(scene, o, i),
                                        scene_point(scene, o, i + 1 < count ? i + 1 : 0)};
            const geom_plane plane = geom_plane_points(3, p);
            s->straight[scene_start(scene, o) + i] = !geom_plane_valid(context, &plane);
        }
    }
    support_free(&s->alloc, parent, (n + 1) * sizeof *parent);
    return ok ? FROE_OK : FROE_E_MEMORY;
}
