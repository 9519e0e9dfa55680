/* views.c: cameras, and one picture from each. */
#include "oracle/views.h"
#include <stdlib.h>
#include <string.h>

froe_status oracle_view(const froe_scene *scene, unsigned number, froe_projection *out, froe_diagnostic *diag) {
    static const double ways[ORACLE_VIEWS][3] = {{3, -5, 2},   {-4, -3, 2.5}, {-2, 5, 1}, {4.5, 3, -1}, {0.3, 0.2, 5},
                                                 {2, -3, 1.7}, {0, -1, 0},    {0, 0, 0},  {0, 0, 0}};
    static const double amid[2][3] = {{0.46, 0.52, 0.43}, {0.71, 0.33, 0.2}};
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    froe_camera c = froe_camera_defaults();
    if (number >= ORACLE_VIEWS || !froe_scene_bounds(scene, lo, hi)) return FROE_E_ARG;
    c.parallel = number == 5 || number == 6;
    c.fit = number < 7;
    c.fov = c.fit ? 35 : 80;
    for (int k = 0; k < 3; k++) {
        c.target[k] = 0.5 * (lo[k] + hi[k]);
        c.eye[k] = c.target[k] + ways[number][k];
        if (!c.fit) {
            c.eye[k] = lo[k] + amid[number - 7][k] * (hi[k] - lo[k]);
            c.target[k] = c.eye[k] + (k == 0 ? 1 : k == 1 ? 0.37 : -0.11) * (number == 7 ? 1 : -1);
        }
    }
    return froe_camera_place(&c, scene, out, diag);
}

/* One patch in `one_of`, scattered by a multiplicative hash (Knuth, volume 3, 6.4). */
static uint8_t *choose_clear(uint32_t patches, uint32_t one_of) {
    uint8_t *clear = calloc((size_t)patches + 1, 1);
    for (uint32_t i = 0; clear && i < patches; i++) clear[i] = (i * UINT32_C(2654435769) >> 16) % one_of == 0;
    return clear;
}

static froe_status paint(const oracle_task *task, const froe_projection *view, const uint8_t *clear,
                         froe_picture **picture, froe_diagnostic *diag) {
    froe_picture_options o = froe_picture_defaults();
    o.view = view;
    o.paint = task->paint;
    o.underlap = task->underlap;
    o.clear = clear;
    o.alloc = task->alloc;
    return froe_picture_new(task->tree, task->surface, &o, picture, diag);
}

static void compare(const oracle_task *task, const oracle_triangles *triangles, const froe_picture *picture,
                    const uint8_t *clear, oracle_report *sum) {
    const oracle_grid grid = {task->samples, task->samples, {0.31415926, -0.27182818}};
    oracle_hits hits = oracle_hits_new(triangles, grid);
    oracle_canvas canvas = oracle_canvas_new(grid, triangles->view);
    oracle_paint(&canvas, picture, clear);
    oracle_compare(&canvas, &hits, clear, &sum->faces);
    oracle_canvas_free(&canvas);
    oracle_hits_free(&hits);
    sum->last = froe_picture_statistics(picture);
    sum->shapes += sum->last.shapes;
    sum->whole += sum->last.whole;
    sum->late += sum->last.late;
    sum->fallbacks += sum->last.paint != task->paint;
}

static froe_status check_edges(const oracle_task *task, const oracle_triangles *triangles, const froe_projection *view,
                               oracle_report *sum, froe_diagnostic *diag) {
    froe_visibility_options o = froe_visibility_defaults();
    froe_visibility *visibility;
    o.eye = view->eye;
    o.window = view->window;
    o.window_corners = 4;
    o.alloc = task->alloc;
    const froe_status status = froe_visibility_new(task->tree, task->surface, &o, &visibility, diag);
    if (status) return status;
    oracle_check_edges(triangles, froe_tree_scene(task->tree), task->surface, visibility, task->edge_step, &sum->lines);
    froe_visibility_free(visibility);
    return FROE_OK;
}

froe_status oracle_check_view(const oracle_task *task, unsigned number, oracle_report *sum, froe_diagnostic *diag) {
    const froe_scene *scene = froe_tree_scene(task->tree);
    froe_projection view;
    froe_picture *picture;
    froe_status status = oracle_view(scene, number, &view, diag);
    if (status) return status;
    uint8_t *clear = task->clear ? choose_clear((uint32_t)froe_surface_patch_count(task->surface), task->clear) : NULL;
    status = paint(task, &view, clear, &picture, diag);
    if (!status) {
        oracle_triangles triangles = oracle_triangles_new(scene, task->surface, &view, false);
        compare(task, &triangles, picture, clear, sum);
        froe_picture_free(picture);
        if (task->edge_step) status = check_edges(task, &triangles, &view, sum, diag);
        oracle_triangles_free(&triangles);
    }
    free(clear);
    return status;
}
