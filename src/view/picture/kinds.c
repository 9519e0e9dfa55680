/* kinds.c: the edges that are lines of the picture.
 *
 * Edges within a patch never are. An edge between two polygons is a silhouette when the eye is in front of one and
 * behind the other, their corners taken to turn the same way along a surface: exact signs. Angles, in doubles, only
 * tell creases from the rest. */
#include "view/picture/picture.h"
#include <math.h>
#include <string.h>

static uint32_t group_of(const froe_scene *s, uint32_t object) {
    return s->groups ? s->groups[object] : FROE_NONE;
}

static double cosine(const froe_scene *s, uint32_t a, uint32_t b) {
    const geom_plane p = view_support(s, a), q = view_support(s, b);
    double dot = 0, pp = 0, qq = 0;
    for (int k = 0; k < 3; k++) {
        const double x = p.n[k] / p.n_max, y = q.n[k] / q.n_max;
        dot += x * y, pp += x * x, qq += y * y;
    }
    return dot / sqrt(pp * qq);
}

/* The kind of an edge between two polygons across which no patch goes on. */
static froe_line kind_of_pair(view_sightlines *sights, uint32_t edge, uint32_t a, uint32_t b, uint32_t wanted,
                              double limit) {
    const froe_surface *s = sights->surface;
    const bool turned = surface_ascends(s, a, edge) ==
                        surface_ascends(s, b, edge); /* the second runs the other way than its neighbour asks */
    const int x = view_facing(sights, a), y = view_facing(sights, b) * (turned ? -1 : 1);
    if (wanted & FROE_LINE_SILHOUETTE && (x > 0) != (y > 0)) return FROE_LINE_SILHOUETTE;
    const uint32_t p = group_of(s->scene, a), q = group_of(s->scene, b);
    froe_line change = p == q ? (froe_line)0 : FROE_LINE_OBJECT;
    if (p != q && p != FROE_NONE && q != FROE_NONE) {
        const froe_group of_a = froe_scene_group(s->scene, p), of_b = froe_scene_group(s->scene, q);
        const bool name = !strcmp(of_a.name, of_b.name), material = !strcmp(of_a.material, of_b.material);
        if (name && !material) change = FROE_LINE_MATERIAL;
        if (name && material && of_a.colour != of_b.colour)
            change = (froe_line)0; /* parts of one, by colours of faces */
    }
    if (wanted & change) return change;
    const double c = cosine(s->scene, a, b) * (turned ? -1 : 1);
    return wanted & FROE_LINE_CREASE && c <= limit ? FROE_LINE_CREASE : FROE_LINE_MESH;
}

int view_strength(uint32_t kind, bool hidden) {
    static const uint16_t kinds[] = {FROE_LINE_MESH,   FROE_LINE_CREASE,   FROE_LINE_MATERIAL,
                                     FROE_LINE_OBJECT, FROE_LINE_CROSSING, FROE_LINE_SILHOUETTE,
                                     FROE_LINE_BORDER, FROE_LINE_WIRE,     FROE_LINE_SECTION};
    enum { COUNT = sizeof kinds / sizeof *kinds };
    int i = COUNT - 1;
    while (i && kinds[i] != kind) i--;
    return i + (hidden ? 0 : COUNT);
}

void view_line_kinds(view_sightlines *sights, uint32_t wanted, double crease, uint8_t *kinds) {
    const froe_surface *s = sights->surface;
    const double t = crease < 180 ? view_tan(crease / 2) : INFINITY; /* cos a = (1 - t^2) / (1 + t^2) */
    const double limit = crease < 180 ? (1 - t * t) / (1 + t * t) : -1;
    for (uint32_t e = 0; e < s->edge_count; e++) {
        const uint32_t *use = s->uses + s->edge_starts[e], count = s->edge_starts[e + 1] - s->edge_starts[e];
        froe_line kind = FROE_LINE_BORDER;
        if (count == 2 && use[0] != use[1])
            kind = s->inside[e] ? (froe_line)0 : kind_of_pair(sights, e, use[0], use[1], wanted, limit);
        kinds[e] = (uint8_t)(kind & wanted);
    }
}
