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

/** An object in local coordinates, and its box with a margin: it is mostly small beside the cell, and then most
 * fragments lie beside that. */
typedef struct support_outline {
    const split_view *view;
    const froe_scene *scene;
    const split_view_plane *plane;
    uint32_t object, corners;
    double lo[3], hi[3];
} support_outline;

static support_outline support_outline_of(const split_view *v, const froe_scene *scene, uint32_t object,
                                          const split_view_plane *plane) {
    support_outline out = {v, scene, plane, object, scene_corners(scene, object), {0}, {0}};
    for (uint32_t i = 0; i < out.corners; i++) {
        double at[3];
        split_view_local(v, scene_point(scene, object, i), at);
        for (int k = 0; k < 3; k++) {
            out.lo[k] = !i || at[k] < out.lo[k] ? at[k] : out.lo[k];
            out.hi[k] = !i || at[k] > out.hi[k] ? at[k] : out.hi[k];
        }
    }
    for (int k = 0; k < 3; k++) out.lo[k] -= TOUCHING, out.hi[k] += TOUCHING;
    return out;
}

/** Is there an axis on which the fragment ends before the object begins, or the other way round? */
static bool beside(const support_outline *o, uint32_t fragment) {
    const split_view *f = o->view;
    const double *const x[3] = {f->x.data, f->y.data, f->z.data};
    const uint32_t *corner = f->corner.data, from = f->start.data[fragment], to = f->start.data[fragment + 1];
    for (int k = 0; k < f->dim; k++) {
        bool below = true, above = true;
        for (uint32_t j = from; j < to; j++) {
            const double at = x[k][corner[j]];
            below &= at < o->lo[k];
            above &= at > o->hi[k];
        }
        if (below || above) return true;
    }
    return false;
}

/** Where the plane meets a fragment that has corners on both sides; in the plane a point, twice. */
static void chord_of(const split_view *f, const split_view_plane *plane, uint32_t fragment, double chord[2][3]) {
    const double *const x[3] = {f->x.data, f->y.data, f->z.data}, *n = plane->n;
    const uint32_t from = f->start.data[fragment], to = f->start.data[fragment + 1];
    uint32_t found = 0;
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
}

static bool crosses(const support_outline *o, uint32_t fragment) {
    const double *n = o->plane->n;
    double chord[2][3];
    bool some = true;
    chord_of(o->view, o->plane, fragment, chord);
    for (uint32_t i = 0; i < o->corners && some; i++) {
        /* what bounds the object in its plane at its i-th corner: the edge from there, or the end of a segment */
        double at[3], next[3], e[3], inward[3];
        split_view_local(o->view, scene_point(o->scene, o->object, i), at);
        split_view_local(o->view, scene_point(o->scene, o->object, i + 1 < o->corners ? i + 1 : 0), next);
        for (int k = 0; k < 3; k++) e[k] = inward[k] = next[k] - at[k];
        if (o->view->dim == 3) {
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
    const support_outline of = support_outline_of(f, scene, object, plane);
    uint32_t count = 0;
    for (uint32_t i = 0; i < f->count; i++) count += f->sides.data[i] == 3 && !beside(&of, i) && crosses(&of, i);
    return count;
}
