/* originals.c: which objects are equal? Corners are vertex ids, so this is a matter of ids. */
#include "base/random.h"
#include "scene/scene.h"
#include "scene/table.h"
#include <string.h>

/** Rings equal up to where they start and which way they go. Convex rings visit no vertex twice. */
static bool equal_rings(const uint32_t *a, const uint32_t *b, uint32_t count) {
    uint32_t start = 0, forward = 0, backward = 0;
    while (start < count && b[start] != a[0]) start++;
    if (start == count) return false;
    while (forward < count && a[forward] == b[(start + forward) % count]) forward++;
    while (backward < count && a[backward] == b[(start + count - backward) % count]) backward++;
    return forward == count || backward == count;
}

bool scene_equal(const froe_scene *s, uint32_t a, uint32_t b) {
    uint32_t count = scene_corners(s, a);
    if (!s->vertex_of) return a == b; /* all vertices differ */
    const uint32_t *x = s->vertex_of + scene_start(s, a), *y = s->vertex_of + scene_start(s, b);
    if (scene_form(s, a) != scene_form(s, b) || count != scene_corners(s, b)) return false;
    switch (scene_form(s, a)) {
    case FROE_BALL:
        return x[0] == y[0] && scene_radius(s, a) == scene_radius(s, b);
    case FROE_SEGMENT:
    case FROE_POLYGON:
        return equal_rings(x, y, count);
    default:
        return memcmp(x, y, count * sizeof *x) == 0;
    }
}

/** Does not depend on the order of corners. */
static uint32_t tag_of(const froe_scene *s, uint32_t object) {
    uint64_t sum = 0;
    uint32_t count = scene_form(s, object) == FROE_BALL ? 1 : scene_corners(s, object);
    for (uint32_t i = 0; i < count; i++) sum += base_mix(scene_corner(s, object, i) + 1u);
    if (scene_form(s, object) == FROE_BALL) {
        double radius = scene_radius(s, object);
        uint64_t bits;
        memcpy(&bits, &radius, sizeof bits);
        sum += bits;
    }
    return (uint32_t)(base_mix(sum + scene_form(s, object)) >> 32);
}

froe_status scene_originals(const froe_scene *s, const froe_allocator *alloc, uint32_t *out) {
    scene_table table = {0};
    for (uint32_t object = 0; object < s->object_count; object++) {
        if (!scene_table_reserve(alloc, &table, 1)) {
            scene_table_free(alloc, &table);
            return FROE_E_MEMORY;
        }
        uint32_t tag = tag_of(s, object);
        size_t at = scene_table_first(&table, tag);
        uint32_t other = scene_table_find(&table, tag, &at);
        while (other != FROE_NONE && !scene_equal(s, object, other)) other = scene_table_find_next(&table, tag, &at);
        if (other == FROE_NONE) scene_table_put(&table, at, tag, object);
        out[object] = other == FROE_NONE ? object : other;
    }
    scene_table_free(alloc, &table);
    return FROE_OK;
}
