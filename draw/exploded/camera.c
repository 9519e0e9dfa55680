/* camera.c: parallel projection without a sine in it, so that it is the same on every machine. */
#include "exploded/solid.h"
#include <math.h>

double draw_dot(const double *a, const double *b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double *a, const double *b, double *out) {
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        out[k] = a[i] * b[j] - a[j] * b[i];
    }
}

/* To length 1; false for a zero vector. First to largest component 1, against overflow. */
static bool normalize(double *v) {
    double largest = fmax(fabs(v[0]), fmax(fabs(v[1]), fabs(v[2])));
    if (!(largest > 0)) return false;
    for (int k = 0; k < 3; k++) v[k] /= largest;
    double length = sqrt(draw_dot(v, v));
    for (int k = 0; k < 3; k++) v[k] /= length;
    return true;
}

draw_camera draw_camera_from(const draw_space *space, const double *view) {
    draw_camera camera;
    const double z[3] = {0, 0, 1}, y[3] = {0, 1, 0}, standard[3] = {1, -1.6, 1.1};
    for (int k = 0; k < 3; k++) camera.eye[k] = space->sign[k] * view[space->from[k]];
    if (!normalize(camera.eye)) {
        for (int k = 0; k < 3; k++) camera.eye[k] = standard[k];
        normalize(camera.eye);
    }
    cross(z, camera.eye, camera.right);
    if (!normalize(camera.right)) {
        cross(y, camera.eye, camera.right);
        normalize(camera.right);
    }
    cross(camera.eye, camera.right, camera.up);
    for (int k = 0; k < 3; k++) camera.light[k] = 0.55 * camera.eye[k] + 0.75 * camera.up[k] - 0.45 * camera.right[k];
    normalize(camera.light);
    return camera;
}

draw_point draw_camera_project(const draw_camera *camera, const double *p) {
    return (draw_point){draw_dot(camera->right, p), draw_dot(camera->up, p)};
}

double draw_camera_shade(const draw_camera *camera, const double *normal) {
    double n[3] = {normal[0], normal[1], normal[2]};
    if (!normalize(n)) return 0.5;
    double lit = draw_dot(n, camera->light);
    if (draw_dot(n, camera->eye) < 0) lit = -lit;
    return lit > 0 ? lit : 0;
}
