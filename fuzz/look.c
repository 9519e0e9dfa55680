/* look.c: see look.h. */
#include "look.h"
#include <froe/view.h>
#include <stdlib.h>

typedef struct view {
    const froe_tree *tree;
    const froe_surface *surface;
    bool right;
    fuzz_bytes *bytes;
} view;

static void expect(const view *v, bool holds, const char *what, const froe_diagnostic *why) {
    if (v->right && !holds) fuzz_complain(what, why);
}

static bool count_pieces(void *user, size_t piece) {
    (void)piece;
    ++*(size_t *)user;
    return true;
}

static bool look_at_region(void *user, uint32_t patch, const double *coords, const size_t *starts, size_t rings) {
    (void)user, (void)patch, (void)coords;
    return rings > 0 && starts[rings] >= 3 * rings;
}

/* A picture of any kind, from any camera, read to the last point. */
static void take_picture(const view *v) {
    froe_camera c = froe_camera_defaults();
    froe_projection projection;
    froe_picture_options o = froe_picture_defaults();
    froe_picture *picture = NULL;
    uint8_t clear[256];
    froe_diagnostic why;
    for (int k = 0; k < 3; k++) c.eye[k] = fuzz_double(v->bytes), c.target[k] = fuzz_double(v->bytes);
    const uint8_t bits = fuzz_byte(v->bytes);
    c.parallel = bits & 1, c.fit = bits & 2;
    if (froe_camera_place(&c, froe_tree_scene(v->tree), &projection, &why)) return;
    for (size_t i = 0; i < 256; i++) clear[i] = bits & 4 && i % 3 == 0;
    o.view = &projection;
    o.paint = (froe_paint)(fuzz_byte(v->bytes) % FROE_PAINT_COUNT);
    o.lines = 31 | FROE_LINE_WIRE | FROE_LINE_POINT, o.hidden = true, o.underlap = 1;
    if (froe_surface_patch_count(v->surface) <= 256) o.clear = clear;
    if (froe_picture_new(v->tree, v->surface, &o, &picture, &why) == FROE_OK)
        for (size_t i = 0; i < froe_picture_shape_count(picture); i++) {
            const froe_shape s = froe_picture_shape(picture, i);
            for (size_t r = 0, n = 0; r < s.ring_count; r++)
                expect(v, froe_picture_ring(picture, s.first_ring + r, &n) && n >= 3, "ring", &why);
        }
    froe_picture_free(picture);
}

static void look_at_lines(const view *v, const froe_visibility *seen) {
    const froe_diagnostic why = {0};
    const size_t edges = froe_surface_edge_count(v->surface), lines = edges + froe_surface_wire_count(v->surface);
    for (size_t l = 0; l < lines; l++) {
        size_t count;
        const froe_interval *x = l < edges ? froe_visibility_of_edge(seen, (uint32_t)l, &count)
                                           : froe_visibility_of_wire(seen, (uint32_t)(l - edges), &count);
        for (size_t i = 0; i < count; i++)
            expect(v, x[i].from <= x[i].to && (!i || x[i - 1].to <= x[i].from), "intervals", &why);
    }
    size_t points = 0;
    for (uint32_t i = 0; i < froe_surface_point_count(v->surface); i++) points += froe_visibility_of_point(seen, i);
    expect(v, points == froe_visibility_statistics(seen).visible_points, "points", &why);
}

/* What an eye sees of a scene in space, all around or through a window, read to the last interval. */
static void see(const view *v, const froe_eye *eye) {
    froe_visibility *seen = NULL;
    froe_visibility_options o = froe_visibility_defaults();
    double window[9], corners[60];
    froe_diagnostic why;
    o.eye = *eye;
    o.cull_back = fuzz_byte(v->bytes) % 2;
    for (int k = 0; k < 9; k++) window[k] = fuzz_double(v->bytes);
    if (fuzz_byte(v->bytes) % 2) o.window = window, o.window_corners = 3;
    if (froe_visibility_new(v->tree, v->surface, &o, &seen, &why) == FROE_OK) {
        for (size_t i = 0; i < froe_visibility_piece_count(seen); i++)
            expect(v, froe_visibility_corners(seen, i, corners, 20) >= 3, "piece without area", &why);
        look_at_lines(v, seen);
        expect(v, froe_visibility_regions(seen, 0, UINT32_MAX, look_at_region, NULL, &why) == FROE_OK, "regions", &why);
    }
    froe_visibility_free(seen);
    take_picture(v);
}

/* All pieces in depth order, or a refusal. */
static void look_in_order(const view *v, const froe_eye *eye) {
    froe_order_options o = froe_order_defaults();
    const size_t pieces = froe_tree_piece_count(v->tree);
    uint32_t *order = calloc(pieces + 1, sizeof *order);
    size_t count = 0;
    froe_diagnostic why = {.message = "pieces left out"};
    o.front_to_back = fuzz_byte(v->bytes) % 2;
    o.threads = 1;
    if (froe_tree_order(v->tree, eye, &o, count_pieces, &count, &why) == FROE_OK) {
        expect(v, count == pieces, "order", &why);
        expect(v, order && froe_tree_orders(v->tree, eye, 1, &o, order, &why) == FROE_OK, "orders", &why);
    }
    free(order);
}

void look(const froe_tree *tree, bool right, fuzz_bytes *bytes) {
    view v = {.tree = tree, .right = right, .bytes = bytes};
    froe_eye eye = {.parallel = fuzz_byte(bytes) % 2};
    froe_surface *surface = NULL;
    froe_diagnostic why;
    for (int k = 0; k < 3; k++) eye.at[k] = fuzz_double(bytes);
    look_in_order(&v, &eye);
    if (froe_surface_new(froe_tree_scene(tree), NULL, &surface, &why)) return;
    v.surface = surface;
    see(&v, &eye);
    froe_surface_free(surface);
}
