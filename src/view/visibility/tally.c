/* tally.c: counts of what is visible and what is not, so that no part of a scene is left out uncounted. */
#include "geom/predicates.h"
#include "view/visibility/visibility.h"

/* Does the section leave out all of a patch? */
static bool is_cut_away(froe_visibility *v, uint32_t patch) {
    const froe_surface *s = v->surface;
    const geom_plane plane = tree_plane_at(v->tree, 0);
    bool away = false;
    for (uint32_t m = s->patch_starts[patch]; m < s->patch_starts[patch + 1]; m++)
        for (uint32_t i = 0; i < scene_corners(s->scene, s->members[m]); i++) {
            const double *x = scene_point(s->scene, s->members[m], i);
            const int side = v->section * geom_side_vertex(&v->sights.context, &plane, x);
            if (side > 0) return false;
            away = away || side < 0;
        }
    return away;
}

void view_tally(froe_visibility *v, bool cull_back) {
    const froe_scene *s = v->surface->scene;
    for (uint32_t o = 0; o < s->object_count; o++) {
        if (v->surface->patch_of[o] != FROE_NONE) continue;
        const froe_kind kind = froe_scene_object(s, o).kind;
        v->report.flat += kind == FROE_POLYGON;
    }
    for (uint32_t i = 0, line = v->surface->edge_count; i < v->surface->wire_count; i++, line++)
        ++*(v->edge_starts[line] < v->edge_starts[line + 1] ? &v->report.visible_segments : &v->report.segments);
    for (uint32_t i = 0; i < v->surface->point_count; i++)
        ++*(v->points_seen[i] ? &v->report.visible_points : &v->report.points);
    for (uint32_t p = 0; p < v->surface->patch_count; p++) {
        const int facing = view_facing(&v->sights, surface_first(v->surface, p));
        if (v->patch_starts[p] < v->patch_starts[p + 1])
            v->report.visible_patches++;
        else if (v->section && is_cut_away(v, p))
            v->report.cut_away++;
        else if (!facing)
            v->report.edge_on++;
        else if (cull_back && facing < 0)
            v->report.culled++;
        else
            v->report.hidden++;
    }
}
