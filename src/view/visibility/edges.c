/* edges.c: equal pairs of vertices are found by sorting them; segments and points are listed. */
#include "base/radix.h"
#include "view/visibility/surface.h"

static uint32_t *take_numbers(const froe_allocator *alloc, size_t count, bool *ok) {
    uint32_t *out = support_calloc(alloc, count ? count : 1, sizeof *out);
    *ok = *ok && out;
    return out;
}

/* Is it a segment, or a point, that was added as one of both? A polygon without area is neither. */
static bool is_wire(const froe_scene *s, uint32_t object) {
    return scene_kind(s, object) == FROE_SEGMENT && scene_form(s, object) == FROE_SEGMENT;
}

static bool is_point(const froe_scene *s, uint32_t object) {
    return scene_kind(s, object) <= FROE_SEGMENT && scene_form(s, object) == FROE_POINT;
}

static void list_wires_and_points(froe_surface *out) {
    const froe_scene *s = out->scene;
    uint32_t wires = 0, points = 0;
    for (uint32_t o = 0; o < s->object_count; o++) {
        if (is_point(s, o)) out->points[points++] = o;
        if (!is_wire(s, o)) continue;
        for (uint32_t i = 0; i < 2; i++)
            out->vertices[2 * (size_t)(out->edge_count + wires) + i] = scene_corner(s, o, i);
        out->wires[wires++] = o;
    }
}

froe_status surface_find_edges(froe_surface *out) {
    const froe_scene *s = out->scene;
    const froe_allocator *alloc = &out->alloc;
    const uint32_t corners = s->corner_count, most = corners ? corners : 1;
    base_pair *pairs = support_calloc(alloc, 2 * (size_t)most, sizeof *pairs);
    bool ok = pairs != NULL;
    uint32_t *object_of = take_numbers(alloc, most, &ok);
    out->edge_of = take_numbers(alloc, most, &ok);
    if (ok) {
        for (uint32_t o = 0; o < s->object_count; o++) {
            const uint32_t n = scene_form(s, o) == FROE_POLYGON ? scene_corners(s, o) : 0;
            for (uint32_t i = 0; i < n; i++) { /* lower vertex, higher vertex; the corner that the edge leaves */
                const uint32_t a = scene_corner(s, o, i), b = scene_corner(s, o, i + 1 < n ? i + 1 : 0);
                const uint64_t key = (uint64_t)(a < b ? a : b) << 32 | (a < b ? b : a);
                pairs[out->use_count++] = (base_pair){key, scene_start(s, o) + i};
            }
        }
        base_radix_sort(pairs, pairs + most, out->use_count);
        for (uint32_t i = 0; i < out->use_count; i++) out->edge_count += !i || pairs[i].key != pairs[i - 1].key;
    }
    for (uint32_t o = 0; o < s->object_count; o++) {
        out->wire_count += is_wire(s, o);
        out->point_count += is_point(s, o);
    }
    out->vertices = take_numbers(alloc, 2 * surface_line_count(out), &ok);
    out->wires = take_numbers(alloc, out->wire_count, &ok);
    out->points = take_numbers(alloc, out->point_count, &ok);
    out->edge_starts = take_numbers(alloc, (size_t)out->edge_count + 1, &ok);
    out->uses = take_numbers(alloc, out->use_count, &ok);
    if (ok) {
        for (uint32_t i = 0; i < corners; i++) out->edge_of[i] = FROE_NONE;
        for (uint32_t o = 0; o < s->object_count; o++)
            for (uint32_t i = scene_start(s, o); i < scene_start(s, o + 1); i++) object_of[i] = o;
        uint32_t edge = 0;
        for (uint32_t i = 0; i < out->use_count; i++) {
            if (i == 0 || pairs[i].key != pairs[i - 1].key) {
                edge += i > 0;
                out->edge_starts[edge] = i;
                out->vertices[2 * edge] = (uint32_t)(pairs[i].key >> 32);
                out->vertices[2 * edge + 1] = (uint32_t)pairs[i].key;
            }
            out->edge_of[pairs[i].value] = edge;
            out->uses[i] = object_of[pairs[i].value];
        }
        out->edge_starts[out->edge_count] = out->use_count;
        list_wires_and_points(out);
    }
    support_free(alloc, object_of, most * sizeof *object_of);
    support_free(alloc, pairs, 2 * (size_t)most * sizeof *pairs);
    return ok ? FROE_OK : FROE_E_MEMORY;
}
