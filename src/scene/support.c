/* support.c: where objects lie: bounding boxes, supporting hyperplanes, and the planes of cuts. */
#include "scene/scene.h"
#include <math.h>

/* ------------------------------------------------------------------ bounds -- */

/** The least double >= a + b (up 1), or minus the least >= -a - b, that is the greatest <= a + b (up -1).
 * The residue of a sum is a double and known exactly (Knuth's TwoSum). */
static double sum_towards(double a, double b, int up) {
    double s = a + b, t = s - a, residue = (a - (s - t)) + (b - t);
    bool inward = up > 0 ? residue > 0 : residue < 0;
    return inward ? nextafter(s, up > 0 ? INFINITY : -INFINITY) : s;
}

void scene_ball_bounds(int dim, const double *centre, double radius, double *lo, double *hi) {
    for (int k = 0; k < dim; k++) {
        lo[k] = sum_towards(centre[k], -radius, -1);
        hi[k] = sum_towards(centre[k], radius, 1);
    }
}

void scene_object_bounds(const froe_scene *s, uint32_t object, double *lo, double *hi) {
    scene_bounds_in(s, s->dim, object, lo, hi);
}

/* ----------------------------------------------------------------- support -- */

static froe_cut axis_cut(int axis, double value) {
    return (froe_cut){.kind = FROE_CUT_AXIS, .axis = axis, .value = value};
}

/** 3D: the axis plane that holds the segment, else the vertical plane through it. */
static froe_cut segment_cut(const froe_scene *s, uint32_t object) {
    const double *u = scene_point(s, object, 0), *v = scene_point(s, object, 1);
    for (int k = 0; k < 3; k++)
        if (u[k] == v[k]) return axis_cut(k, u[k]);
    return (froe_cut){.kind = FROE_CUT_EDGE, .id = {scene_corner(s, object, 0), scene_corner(s, object, 1)}};
}

froe_cut scene_support_cut(const froe_scene *s, uint32_t object) {
    switch (scene_form(s, object)) {
    case FROE_POINT:
        return axis_cut(0, scene_point(s, object, 0)[0]);
    case FROE_SEGMENT:
        return s->dim == 2 ? (froe_cut){.kind = FROE_CUT_OBJECT, .id = {object}} : segment_cut(s, object);
    case FROE_POLYGON:
        return (froe_cut){.kind = FROE_CUT_OBJECT, .id = {object}};
    default:
        return (froe_cut){.kind = FROE_CUT_NONE};
    }
}

froe_cut scene_support(const froe_scene *s, uint32_t object, geom_plane *plane) {
    froe_cut cut = scene_support_cut(s, object);
    if (cut.kind != FROE_CUT_NONE) *plane = scene_cut_plane(s, &cut);
    return cut;
}

uint32_t scene_object_of(const froe_scene *s, uint32_t corner) {
    uint32_t lo = 0, hi = s->object_count, guess = corner / 3; /* start of lo <= corner < start of hi */
    if (!s->start_of) return corner / s->each;
    if (guess < hi && s->start_of[guess] <= corner && corner < s->start_of[guess + 1]) return guess;
    while (hi - lo > 1) {
        uint32_t middle = lo + (hi - lo) / 2;
        *(s->start_of[middle] <= corner ? &lo : &hi) = middle;
    }
    return lo;
}

bool froe_scene_edge(const froe_scene *s, uint32_t edge, uint32_t vertices[2]) {
    if (edge >= s->corner_count || !s->object_count) return false;
    uint32_t object = scene_object_of(s, edge), first = scene_start(s, object);
    if (!scene_is_checked(s) && (first > edge || scene_start(s, object + 1) <= edge || !scene_object_fits(s, object)))
        return false;
    uint32_t next = edge + 1 < scene_start(s, object + 1) ? edge + 1 : first;
    if (scene_form(s, object) != FROE_SEGMENT && scene_form(s, object) != FROE_POLYGON) return false;
    vertices[0] = scene_corner_vertex(s, edge);
    vertices[1] = scene_corner_vertex(s, next);
    return true;
}

void scene_crossing_line(const froe_scene *s, uint32_t id, const double *ends[2]) {
    uint32_t vertices[2];
    froe_scene_edge(s, s->dim == 2 ? scene_start(s, id) : id, vertices);
    for (int i = 0; i < 2; i++) ends[i] = scene_vertex(s, vertices[i]);
}

geom_plane scene_cut_plane(const froe_scene *s, const froe_cut *cut) {
    const double *points[4] = {NULL};
    switch (cut->kind) {
    case FROE_CUT_AXIS:
        return geom_plane_axis(s->dim, cut->axis, cut->value);
    case FROE_CUT_OBJECT:
        for (int i = 0; i < s->dim; i++) points[i] = scene_point(s, cut->id[0], (uint32_t)i);
        return geom_plane_points(s->dim, points);
    case FROE_CUT_VERTICES:
        for (int i = 0; i < s->dim; i++) points[i] = scene_vertex(s, cut->id[i]);
        return geom_plane_points(s->dim, points);
    case FROE_CUT_EDGE:
        return geom_plane_vertical(scene_vertex(s, cut->id[0]), scene_vertex(s, cut->id[1]));
    case FROE_CUT_PLANE:
        return geom_plane_vector(s->dim, cut->normal, cut->value);
    case FROE_CUT_FINE:
        return geom_plane_fine(s->dim, cut->normal, (int)cut->id[0]);
    case FROE_CUT_VERTEX:
        return geom_plane_at_vertex(s->dim, scene_vertex(s, cut->id[0]));
    case FROE_CUT_CROSSING:
        scene_crossing_line(s, cut->id[0], points);
        scene_crossing_line(s, cut->id[1], points + 2);
        return geom_plane_at_crossing(s->dim, points);
    default: /* one way: leaves have no plane, and other kinds of cuts do not get into a tree */
        return (geom_plane){.dim = s->dim};
    }
}
