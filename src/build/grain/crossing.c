/* crossing.c: chords of fragments in the plane of an object, clipped by its edges. */
#include "build/grain/crossing.h"
#include "support/axes.h"
#include <math.h>
#include <string.h>

#define TOUCHING 0x1p-36 /* neighbours in a mesh have a vertex in common, or an edge: they do not cross */

/** Shortens a chord to a halfspace that is smaller by TOUCHING. False: nothing is left. */
static bool clip_chord(double chord[2][3], const double at[3], const double inward[3]) {
    double border = support_dot(at, inward) + TOUCHING * sqrt(support_dot(inward, inward));
    double u = support_dot(chord[0], inward) - border, v = support_dot(chord[1], inward) - border;
    if (!(u > 0) && !(v > 0)) return false;
    if (u > 0 && v > 0) return true;
    double *outer = chord[u > 0];
    double p[3] = {chord[0][0], chord[0][1], chord[0][2]};
    for (int k = 0; k < 3; k++) outer[k] = p[k] + (chord[1][k] - p[k]) * (u / (u - v));
    return true;
}

static bool crosses(const split_view *f, const froe_scene *scene, uint32_t object, const split_view_plane *plane,
                    uint32_t fragment) {
    double chord[2][3];
    const uint32_t corners = scene_corners(scene, object);
    const double *n = plane->n;
    bool some = true;
    /* where the plane meets a fragment that has corners on both sides; in the plane a point, twice */
    const double *const x[3] = {f->x.data, f->y.data, f->z.data};
    uint32_t from = f->start.data[fragment], to = f->start.data[fragment + 1], found = 0;
    memset(chord, 0, 2 * sizeof *chord);
    for (uint32_t j = from; j < to && found < 2; j++) {
        uint32_t a = f->corner.data[j], b = f->corner.data[j + 1 < to ? j + 1 : from];
        double p[3] = {x[0][a], x[1][a], x[2][a]}, q[3] = {x[0][b], x[1][b], x[2][b]};
        double u = support_dot(n, p) - plane->d, v = support_dot(n, q) - plane->d;
        if ((u > 0) == (v > 0)) continue;
        for (int k = 0; k < 3; k++) chord[found][k] = p[k] + (q[k] - p[k]) * (u / (u - v));
        found++;
    }
    if (found == 1) memcpy(chord[1], chord[0], sizeof chord[1]);
    for (uint32_t i = 0; i < corners && some; i++) {
        /* what bounds the object in its plane at its i-th corner: the edge from there, or the end of a segment */
        double at[3], next[3], e[3], inward[3];
        split_view_local(f, scene_point(scene, object, i), at);
        split_view_local(f, scene_point(scene, object, i + 1 < corners ? i + 1 : 0), next);
        for (int k = 0; k < 3; k++) e[k] = inward[k] = next[k] - at[k];
        if (f->dim == 3) {
            inward[0] = n[1] * e[2] - n[2] * e[1];
            inward[1] = n[2] * e[0] - n[0] * e[2];
            inward[2] = n[0] * e[1] - n[1] * e[0];
        }
        some = clip_chord(chord, at, inward);
    }
    return some;
}

uint32_t split_crossing_count(const split_view *f, const froe_scene *scene, uint32_t object,
                              const split_view_plane *plane) {
    const uint32_t *start = f->start.data, *corner = f->corner.data;
    uint32_t count = 0;
    for (uint32_t i = 0; i < f->count; i++) {
        unsigned seen = 0;
        for (uint32_t j = start[i]; j < start[i + 1]; j++) seen |= f->side.data[corner[j]];
        count += seen == 3 && crosses(f, scene, object, plane, i);
    }
    return count;
}
