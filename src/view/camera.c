/* camera.c: from eye, target and page to a projection. */
#include "view/camera.h"
#include "base/floats.h"
#include "scene/scene.h"
#include "support/axes.h"
#include "support/fail.h"
#include <math.h>
#include <string.h>

void froe_camera_defaults_into(froe_camera *out, size_t size) {
    const froe_camera all = {.size = size,
                             .fit = true,
                             .eye = {3, -5, 2},
                             .up = {0, 0, 1},
                             .fov = 35,
                             .width = 1000,
                             .height = 1000,
                             .margin = 20};
    support_defaults(out, size, &all, sizeof all);
}

/* ---------------------------------------------------------------------- vectors -- */

/* tan x = x / (1 - x^2 / (3 - x^2 / (5 - ...))) (Lambert 1761): converges for every x, fast below pi / 2. */
double view_tan(double degrees) {
    const double x = degrees * (3.14159265358979323846 / 180), square = x * x;
    double below = 61;
    for (int k = 59; k > 0; k -= 2) below = k - square / below;
    return x / below;
}

/* -------------------------------------------------------------------- projecting -- */

void view_camera_point(const froe_projection *view, const double *point, double out[3]) {
    double w[3];
    for (int k = 0; k < 3; k++) w[k] = point[k] - view->origin[k];
    out[0] = support_dot(w, view->right);
    out[1] = support_dot(w, view->up);
    out[2] = -support_dot(w, view->back);
}

void view_camera_page(const froe_projection *view, const double at[3], double page[2]) {
    const double scale = view->eye.parallel ? view->scale : view->scale / at[2];
    page[0] = view->centre[0] + scale * at[0];
    page[1] = view->centre[1] - scale * at[1];
}

bool froe_project(const froe_projection *view, const double *point, double page[2]) {
    BASE_FLOATS_OWN;
    double at[3];
    view_camera_point(view, point, at);
    if (!view->eye.parallel && !(at[2] > 0)) return false;
    view_camera_page(view, at, page);
    return true;
}

void view_camera_ray(const froe_projection *view, const geom_eye *eye, const double ray[3], double page[2]) {
    double at[3];
    if (eye->parallel) {
        double point[3] = {eye->origin[0], eye->origin[1], eye->origin[2]};
        for (int c = 0; c < 2; c++) point[(eye->axis + 1 + c) % 3] += ray[c] / ray[2] * eye->size;
        view_camera_point(view, point, at);
    } else { /* the ray runs from the point to the eye */
        at[0] = -support_dot(ray, view->right), at[1] = -support_dot(ray, view->up),
        at[2] = support_dot(ray, view->back);
    }
    view_camera_page(view, at, page);
}

/* ---------------------------------------------------------------------- placing -- */

static froe_status set_axes(const froe_camera *c, froe_projection *out, froe_diagnostic *diag) {
    support_way(c->target, c->eye, out->back);
    if (!support_normalize(out->back))
        return support_fail(diag, FROE_E_ARG, "The eye is where it looks at, which is no direction.");
    out->up_axis = support_page_axes(out->back, c->up, out->right, out->up);
    return FROE_OK;
}

/* Points that the page shall hold: all vertices, or what a section leaves of them and where it cuts edges. */
typedef struct fit_points {
    const double *at; /* 3 a point */
    size_t count;
    ARRAY(double) own;
} fit_points;

static bool keep_fit_point(const froe_allocator *alloc, fit_points *points, const double *x) {
    if (!array_reserve(alloc, &points->own, 3)) return false;
    memcpy(points->own.data + points->own.count, x, 3 * sizeof *x);
    points->own.count += 3;
    return true;
}

static bool fit_points_new(const froe_camera *c, const froe_scene *scene, fit_points *out) {
    const froe_allocator *alloc = &scene->alloc;
    *out = (fit_points){.at = scene->coords, .count = scene->vertex_count};
    if (!c->section) return true;
    for (uint32_t o = 0; o < scene->object_count; o++) {
        const uint32_t n = scene_corners(scene, o);
        if (scene_form(scene, o) > FROE_POLYGON) continue; /* such pictures do not show it */
        for (uint32_t i = 0; i < n; i++) {                 /* what the section leaves of an edge */
            const double *a = scene_point(scene, o, i), *b = scene_point(scene, o, i + 1 < n ? i + 1 : 0);
            const double at_a = support_dot(c->section, a) - c->section[3],
                         at_b = support_dot(c->section, b) - c->section[3];
            double x[3];
            if (at_a <= 0 && !keep_fit_point(alloc, out, a)) return false;
            if ((at_a <= 0) == (at_b <= 0)) continue;
            for (int k = 0; k < 3; k++) x[k] = a[k] + at_a / (at_a - at_b) * (b[k] - a[k]);
            if (!keep_fit_point(alloc, out, x)) return false;
        }
    }
    out->at = out->own.data;
    out->count = out->own.count / 3;
    return true;
}

/* The distance from which the angle of view takes in every point, and the nearest one is not too near to be drawn; 0:
 * all are in one place. */
static double distance_for(const froe_projection *view, const froe_camera *c, const fit_points *points,
                           const double *aim) {
    const double most_y = view_tan(c->fov / 2),
                 most_x = most_y * (c->width - 2 * c->margin) / (c->height - 2 * c->margin);
    double distance = 0, nearest = 0;
    for (size_t i = 0; i < points->count; i++) {
        double w[3];
        for (int k = 0; k < 3; k++) w[k] = points->at[3 * i + (size_t)k] - aim[k];
        const double out = support_dot(w, view->back);
        nearest = fmax(nearest, out);
        distance = fmax(distance, out + fabs(support_dot(w, view->right)) / most_x);
        distance = fmax(distance, out + fabs(support_dot(w, view->up)) / most_y);
    }
    return distance > 0 ? fmax(distance, nearest + 2 * view->near) : 0;
}

/* Scale (unless it is given) and centre, so that the scene fills the page within its margin. */
static froe_status fill_page(const froe_camera *c, const fit_points *points, froe_projection *out,
                             froe_diagnostic *diag) {
    double lo[2], hi[2];
    out->scale = c->parallel && c->scale > 0 ? c->scale : 1;
    out->centre[0] = out->centre[1] = 0;
    bool before = points->count > 0; /* all points before the eye, and there is one? */
    for (size_t i = 0; i < points->count && before; i++) {
        double page[2];
        before = froe_project(out, points->at + 3 * i, page);
        for (int k = 0; k < 2 && before; k++) {
            lo[k] = i ? fmin(lo[k], page[k]) : page[k];
            hi[k] = i ? fmax(hi[k], page[k]) : page[k];
        }
    }
    if (!before) return support_fail(diag, FROE_E_INPUT, "There is nothing before the eye to fit.");
    if (!(c->parallel && c->scale > 0)) {
        const double x = hi[0] - lo[0], y = hi[1] - lo[1], room_x = c->width - 2 * c->margin,
                     room_y = c->height - 2 * c->margin;
        const double scale = x * room_y > y * room_x ? room_x / x : room_y / y;
        out->scale = isfinite(scale) && scale > 0 ? scale : 1;
    }
    const double given = c->parallel && c->scale > 0 ? c->scale : 1;
    for (int k = 0; k < 2; k++)
        out->centre[k] = 0.5 * (k ? c->height : c->width) - 0.5 * (lo[k] + hi[k]) * (out->scale / given);
    return FROE_OK;
}

/* The diagonal of the scene's box: sides are multiplied by a power of two, so that no square underflows or overflows.
 * Infinite where a side is. 1 for a scene of a single point, or of none. */
static double extent_of(const froe_scene *scene) {
    double most = 0, sum = 0;
    int exponent = 0;
    for (int k = 0; k < 3 && scene->object_count; k++) most = fmax(most, scene->hi[k] - scene->lo[k]);
    if (!(most > 0)) return 1;
    frexp(most, &exponent); /* any number where `most` is infinite */
    for (int k = 0; k < 3; k++) {
        const double side = ldexp(scene->hi[k] - scene->lo[k], -exponent);
        sum += side * side;
    }
    return ldexp(sqrt(sum), exponent);
}

/* Extents whose projections on any page neither overflow nor lose visible bits: the camera multiplies and divides
 * them by sines, by tangents of angles of view and by scales of a page. */
#define LEAST_EXTENT 0x1p-1000
#define MOST_EXTENT 0x1p1000

static froe_status put_in_place(const froe_camera *camera, const froe_scene *scene, const fit_points *points,
                                froe_projection *out, froe_diagnostic *diag) {
    froe_projection view = {.width = camera->width, .height = camera->height, .eye.parallel = camera->parallel};
    froe_status status = set_axes(camera, &view, diag);
    if (status) return status;
    const double extent = extent_of(scene);
    if (!(extent >= LEAST_EXTENT && extent <= MOST_EXTENT))
        return support_fail(diag, FROE_E_UNSUPPORTED,
                            "The scene extends over %g, and cameras look at scenes of 2^-1000 to 2^1000 only. Multiply "
                            "its coordinates by a power of two.",
                            extent);
    double distance = extent;
    view.near = 1e-6 * extent;
    for (int k = 0; k < 3; k++) {
        const double middle = scene->object_count ? 0.5 * scene->lo[k] + 0.5 * scene->hi[k] : 0;
        view.origin[k] = camera->fit ? middle : camera->parallel ? camera->target[k] : camera->eye[k];
    }
    if (camera->fit && !camera->parallel) {
        distance = distance_for(&view, camera, points, view.origin);
        if (!(distance > 0)) distance = extent;
        for (int k = 0; k < 3; k++) view.origin[k] += distance * view.back[k];
    }
    memcpy(view.eye.at, camera->parallel ? view.back : view.origin, sizeof view.eye.at);
    view.centre[0] = 0.5 * camera->width, view.centre[1] = 0.5 * camera->height;
    if (camera->fit || (camera->parallel && !(camera->scale > 0)))
        status = fill_page(camera, points, &view, diag);
    else
        view.scale =
            camera->parallel ? camera->scale : (0.5 * camera->height - camera->margin) / view_tan(camera->fov / 2);
    if (status) return status;
    /* The corners of the page, in space, at the distance of the scene. */
    for (int k = 0; k < 3; k++) /* a window so near to an eye so far away would have all corners in one place */
        if (!camera->fit && !camera->parallel) distance = fmax(distance, 0x1p-20 * fabs(view.origin[k]));
    for (int i = 0; i < 4; i++) {
        const double x = (i == 1 || i == 2 ? view.width : 0) - view.centre[0],
                     y = view.centre[1] - (i < 2 ? 0 : view.height);
        const double reach = camera->parallel ? 1 / view.scale : distance / view.scale,
                     depth = camera->parallel ? 0 : distance;
        for (int k = 0; k < 3; k++)
            view.window[3 * i + k] =
                view.origin[k] + reach * (x * view.right[k] + y * view.up[k]) - depth * view.back[k];
    }
    for (int i = 0; i < 12; i++)
        if (!isfinite(view.window[i]))
            return support_fail(diag, FROE_E_ARG,
                                "The page, put where the scene is, has corners beyond all doubles. The eye is too far "
                                "away, or the scale of %g is too small.",
                                view.scale);
    *out = view;
    return FROE_OK;
}

static froe_status check_section(const double *plane, froe_diagnostic *diag) {
    if (!plane) return FROE_OK;
    for (int k = 0; k < 4; k++)
        if (!isfinite(plane[k]))
            return support_fail_at(diag, FROE_E_ARG, FROE_NONE, FROE_NONE, (uint32_t)k,
                                   "Number %d of the plane of the section is %g, not a finite number.", k, plane[k]);
    if (plane[0] != 0 || plane[1] != 0 || plane[2] != 0) return FROE_OK;
    return support_fail(diag, FROE_E_ARG, "The normal of the plane of the section has length 0.");
}

froe_status froe_camera_place(const froe_camera *camera, const froe_scene *scene, froe_projection *out,
                              froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    fit_points points;
    if (!camera || !scene || !out) return support_fail_null(diag, __func__);
    if (scene->dim != 3)
        return support_fail(diag, FROE_E_UNSUPPORTED, "Cameras exist in 3 dimensions, not in %d.", scene->dim);
    const froe_camera *c = camera;
    if (c->size != sizeof *c) return support_fail_defaults(diag, "froe_camera_defaults");
    for (int k = 0; k < 3; k++)
        if (!isfinite(c->eye[k]) || !isfinite(c->target[k]) || !isfinite(c->up[k]))
            return support_fail_at(diag, FROE_E_ARG, FROE_NONE, FROE_NONE, (uint32_t)k,
                                   "Coordinate %d of eye, target or up is not a finite number.", k);
    if (!(c->width > 0 && c->height > 0 && c->width <= 1e9 && c->height <= 1e9))
        return support_fail(diag, FROE_E_OPTIONS, "A page of %g x %g is none.", c->width, c->height);
    if (!(c->margin >= 0 && 2 * c->margin < fmin(c->width, c->height)))
        return support_fail(diag, FROE_E_OPTIONS, "A margin of %g leaves nothing of a page of %g x %g.", c->margin,
                            c->width, c->height);
    if (!c->parallel && !(c->fov >= 1 && c->fov <= 170))
        return support_fail(diag, FROE_E_OPTIONS, "An angle of view of %g degrees is not in 1 .. 170.", c->fov);
    if (!(c->scale >= 0) || !isfinite(c->scale))
        return support_fail(diag, FROE_E_OPTIONS, "A scale of %g is none.", c->scale);
    froe_status status = check_section(c->section, diag);
    if (!status) status = scene_settle(scene, diag);
    if (status) return status;
    const bool ok = fit_points_new(camera, scene, &points);
    status = ok ? put_in_place(camera, scene, &points, out, diag) : support_fail_memory(diag);
    array_free(&scene->alloc, &points.own);
    return status;
}
