/* turntable.c: cameras around a scene, at one distance and one scale, so that the scene alone appears to turn.
 *
 * Angles come from tan(angle / 4) and doubled angles: the same on every machine. */
#include "base/floats.h"
#include "scene/scene.h"
#include "support/axes.h"
#include "support/fail.h"
#include "view/camera.h"
#include <math.h>

/* v turned about an axis of length 1 (Rodrigues 1840). */
static void turn_about(const double *axis, double cosine, double sine, const double *v, double out[3]) {
    double along = 0;
    for (int k = 0; k < 3; k++) along += axis[k] * v[k];
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        out[k] = v[k] * cosine + (axis[i] * v[j] - axis[j] * v[i]) * sine + axis[k] * along * (1 - cosine);
    }
}

/* The exponent of the largest of three numbers, so that squares of shares of 2^that neither overflow nor vanish. */
static int exponent_of(const double *v) {
    int exponent = 0;
    frexp(fmax(fmax(fabs(v[0]), fabs(v[1])), fabs(v[2])), &exponent);
    return exponent;
}

static double length_of(const double *v) {
    const int exponent = exponent_of(v);
    double share[3];
    for (int k = 0; k < 3; k++) share[k] = ldexp(v[k], -exponent);
    return ldexp(sqrt(support_dot(share, share)), exponent);
}

/* A way that the coordinates of a large scene, or of one far away, do not swallow when it is added to them. */
static void lengthen(const froe_scene *scene, double *way) {
    enum { MOST = 16 }; /* bits of the way that they may */
    const int exponent = exponent_of(way);
    int most = exponent;
    if (scene->object_count) {
        const int lo = exponent_of(scene->lo), hi = exponent_of(scene->hi);
        most = lo > hi ? lo : hi;
    }
    for (int k = 0; k < 3 && most - exponent > MOST; k++) way[k] = ldexp(way[k], most - exponent);
}

/* One camera turned and fitted: the distance or the scale that it needs. */
static froe_status fit(const froe_camera *c, const froe_scene *scene, const double *middle, double *distance,
                       double *scale, froe_diagnostic *diag) {
    froe_projection view;
    const froe_status status = froe_camera_place(c, scene, &view, diag);
    if (status) return status;
    double way[3], shrink = 1; /* the factor by which a picture shrinks when centred on the middle of the scene */
    for (int k = 0; k < 2; k++) {
        const double size = k ? c->height : c->width, half = 0.5 * size - c->margin;
        shrink = fmin(shrink, half / (half + fabs(view.centre[k] - 0.5 * size)));
    }
    for (int k = 0; k < 3; k++) way[k] = view.origin[k] - middle[k];
    *distance = fmax(*distance, length_of(way));
    *scale = fmin(*scale, c->scale > 0 ? c->scale : view.scale * shrink);
    return FROE_OK;
}

froe_status froe_camera_turn(const froe_camera *camera, const froe_scene *scene, size_t count, froe_camera *cameras,
                             froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!camera || !scene || !cameras || !count)
        return support_fail(diag, FROE_E_ARG, "An argument of froe_camera_turn is NULL or 0.");
    double middle[3] = {0, 0, 0}, axis[3], way[3], distance = 0, scale = INFINITY;
    const double up = length_of(camera->up);
    if (!(up > 0) || !isfinite(up)) return support_fail(diag, FROE_E_ARG, "A turntable needs an axis, and up is none.");
    for (int k = 0; k < 3; k++) {
        if (scene->object_count) middle[k] = 0.5 * scene->lo[k] + 0.5 * scene->hi[k];
        axis[k] = camera->up[k] / up;
        way[k] = camera->eye[k] - camera->target[k];
    }
    lengthen(scene, way);
    for (size_t i = 0; i < count; i++) {
        const double t = view_tan(90.0 * (double)i / (double)count), half_c = (1 - t * t) / (1 + t * t),
                     half_s = 2 * t / (1 + t * t);
        cameras[i] = *camera;
        cameras[i].fit = true;
        turn_about(axis, half_c * half_c - half_s * half_s, 2 * half_c * half_s, way, cameras[i].eye);
        for (int k = 0; k < 3; k++) cameras[i].target[k] = middle[k], cameras[i].eye[k] += middle[k];
        const froe_status status = fit(&cameras[i], scene, middle, &distance, &scale, diag);
        if (status) return status;
    }
    for (size_t i = 0; i < count; i++) {
        froe_camera *c = cameras + i;
        const double length = length_of(way);
        c->fit = false;
        if (c->parallel) c->scale = scale;
        for (int k = 0; k < 3 && !c->parallel; k++)
            c->eye[k] = middle[k] + (c->eye[k] - middle[k]) * (distance / length);
    }
    return FROE_OK;
}
