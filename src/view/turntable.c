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

/* A way that the coordinates of a large scene, or of one far away, do not swallow when it is added to them. */
static void lengthen(const froe_scene *scene, double *way) {
    enum { MOST = 16 }; /* bits of the way that they may */
    const int exponent = support_exponent(way, 3);
    int most = exponent;
    if (scene->object_count) {
        const int lo = support_exponent(scene->lo, 3), hi = support_exponent(scene->hi, 3);
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
    *distance = fmax(*distance, support_length(way));
    *scale = fmin(*scale, c->scale > 0 ? c->scale : view.scale * shrink);
    return FROE_OK;
}

/* The axis of a turntable, of length 1. */
static froe_status find_axis(const froe_camera *camera, double axis[3], froe_diagnostic *diag) {
    const double up = support_length(camera->up);
    if (!(up > 0) || !isfinite(up)) return support_fail(diag, FROE_E_ARG, "A turntable needs an axis, and up is none.");
    for (int k = 0; k < 3; k++) axis[k] = camera->up[k] / up;
    return FROE_OK;
}

/* Cosine and sine of half of the i-th angle, i < count. */
static void half_angle(size_t i, size_t count, double out[2]) {
    const double t = view_tan(90.0 * (double)i / (double)count);
    out[0] = (1 - t * t) / (1 + t * t), out[1] = 2 * t / (1 + t * t);
}

froe_status froe_camera_turns(const froe_camera *camera, size_t count, double *turns, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    double axis[3] = {0}, half[2];
    if (!camera || !count || !turns)
        return support_fail(diag, FROE_E_ARG, "An argument of froe_camera_turns is NULL or 0.");
    if (camera->size != sizeof *camera) return support_fail_defaults(diag, "froe_camera_defaults");
    const froe_status status = find_axis(camera, axis, diag);
    for (size_t i = 0; i <= count && !status; i++) {
        half_angle(i < count ? i : 0, count, half);
        for (size_t k = 0; k < 3; k++) turns[4 * i + k] = axis[k] * half[1];
        turns[4 * i + 3] = i < count ? half[0] : -half[0];
    }
    return status;
}

froe_status froe_camera_turn(const froe_camera *camera, const froe_scene *scene, size_t count, froe_camera *cameras,
                             froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!camera || !scene || !cameras || !count)
        return support_fail(diag, FROE_E_ARG, "An argument of froe_camera_turn is NULL or 0.");
    if (camera->size != sizeof *camera) return support_fail_defaults(diag, "froe_camera_defaults");
    double middle[3] = {0, 0, 0}, axis[3] = {0}, half[2], way[3], distance = 0, scale = INFINITY;
    const froe_status aimed = find_axis(camera, axis, diag);
    if (aimed) return aimed;
    for (int k = 0; k < 3 && scene->object_count; k++) middle[k] = 0.5 * scene->lo[k] + 0.5 * scene->hi[k];
    support_way(camera->target, camera->eye, way);
    lengthen(scene, way);
    for (size_t i = 0; i < count; i++) {
        half_angle(i, count, half);
        cameras[i] = *camera;
        cameras[i].fit = true;
        turn_about(axis, half[0] * half[0] - half[1] * half[1], 2 * half[0] * half[1], way, cameras[i].eye);
        for (int k = 0; k < 3; k++) cameras[i].target[k] = middle[k], cameras[i].eye[k] += middle[k];
        const froe_status status = fit(&cameras[i], scene, middle, &distance, &scale, diag);
        if (status) return status;
    }
    for (size_t i = 0; i < count; i++) {
        froe_camera *c = cameras + i;
        const double length = support_length(way);
        c->fit = false;
        if (c->parallel) c->scale = scale;
        for (int k = 0; k < 3 && !c->parallel; k++)
            c->eye[k] = middle[k] + (c->eye[k] - middle[k]) * (distance / length);
    }
    return FROE_OK;
}
