/* ring.c: what meets at the corners of a ring. */
#include "tree/ring.h"

static ring_point vertex(const froe_scene *s, uint32_t object, uint32_t corner) {
    return (ring_point){.kind = RING_VERTEX, .x = scene_point(s, object, corner)};
}

/* The own edge that begins at `corner` meets the cut of `node`. */
static ring_point crossing(const froe_scene *s, uint32_t object, uint32_t corner, uint32_t node) {
    uint32_t next = corner + 1 < scene_corners(s, object) ? corner + 1 : 0;
    return (ring_point){.kind = RING_CROSSING,
                        .u = scene_point(s, object, corner),
                        .v = scene_point(s, object, next),
                        .a = node & ~TREE_EDGE_CUT};
}

ring_point ring_end(const froe_scene *s, uint32_t object, uint32_t end) {
    return end & TREE_EDGE_CUT ? crossing(s, object, 0, end) : vertex(s, object, end);
}

ring_point ring_corner(const froe_scene *s, uint32_t object, uint32_t before, uint32_t after) {
    bool cut_before = before & TREE_EDGE_CUT, cut_after = after & TREE_EDGE_CUT;
    if (!cut_before && !cut_after) return vertex(s, object, after);
    if (!cut_before) return crossing(s, object, before, after);
    if (!cut_after) return crossing(s, object, after, before);
    return (ring_point){.kind = RING_CORNER, .a = before & ~TREE_EDGE_CUT, .b = after & ~TREE_EDGE_CUT};
}

ring_point ring_point_at(const froe_scene *s, uint32_t object, const uint32_t *ring, uint32_t count, uint32_t i) {
    if (scene_form(s, object) == FROE_SEGMENT) return ring_end(s, object, ring[i]);
    return ring_corner(s, object, ring[i ? i - 1 : count - 1], ring[i]);
}
