/* camera.c: parallel projection along the axes that render uses, too. */
#include "exploded/solid.h"
#include "support/axes.h"
#include <string.h>

draw_camera draw_camera_from(const draw_space *space, const double *view) {
    draw_camera camera;
    double up[3] = {0, 0, 1};
    for (int k = 0; k < 3; k++) camera.eye[k] = space->sign[k] * view[space->from[k]];
    if (!support_normalize(camera.eye)) {
        memcpy(camera.eye, (const double[3]){1, -1.6, 1.1}, sizeof camera.eye);
        support_normalize(camera.eye);
    }
    if (camera.eye[0] * camera.eye[0] + camera.eye[1] * camera.eye[1] <= 1e-12) up[1] = 1, up[2] = 0; /* a plan */
    support_page_axes(camera.eye, up, camera.right, camera.up);
    for (int k = 0; k < 3; k++) camera.light[k] = 0.55 * camera.eye[k] + 0.75 * camera.up[k] - 0.45 * camera.right[k];
    support_normalize(camera.light);
    return camera;
}

draw_point draw_camera_project(const draw_camera *camera, const double *p) {
    return (draw_point){support_dot(camera->right, p), support_dot(camera->up, p)};
}

double draw_camera_shade(const draw_camera *camera, const double *normal) {
    double n[3] = {normal[0], normal[1], normal[2]};
    if (!support_normalize(n)) return 0.5;
    double lit = support_dot(n, camera->light);
    if (support_dot(n, camera->eye) < 0) lit = -lit;
    return lit > 0 ? lit : 0;
}
