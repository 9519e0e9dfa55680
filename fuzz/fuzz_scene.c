/* fuzz_scene.c: bytes as a program that fills a scene and builds trees of it. Whatever
 * the scene, a build succeeds and passes the audit, or it is refused with a sentence. */
#include "support.h"
#include <froe/froe.h>
#include <froe/view.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_OBJECTS = 24, MOST_CORNERS = 6 };

static void complain(const char *what, const froe_diagnostic *why) {
    fprintf(stderr, "%s: %s: %s\n", what, froe_status_name(why->status), why->message);
    abort();
}

static size_t corners_of(froe_kind kind, fuzz_bytes *bytes) {
    switch (kind) {
    case FROE_POINT:
    case FROE_BALL:
        return 1;
    case FROE_SEGMENT:
    case FROE_BOX:
        return 2;
    default:
        return 1 + fuzz_byte(bytes) % MOST_CORNERS;
    }
}

/* One batch of one kind. Refusals are fine; boxes get their corners in order half of the time. */
static void add_batch(froe_scene *scene, int dim, fuzz_bytes *bytes) {
    double coords[MOST_OBJECTS * MOST_CORNERS * FROE_MAX_DIM], radii[MOST_OBJECTS];
    size_t starts[MOST_OBJECTS + 1] = {0};
    froe_objects o = froe_objects_defaults();
    o.kind = (froe_kind)(fuzz_byte(bytes) % FROE_KIND_COUNT);
    o.count = 1 + fuzz_byte(bytes) % MOST_OBJECTS;
    const size_t corners = corners_of(o.kind, bytes);
    for (size_t i = 0; i < o.count; i++) starts[i + 1] = starts[i] + corners, radii[i] = fuzz_double(bytes);
    for (size_t i = 0; i < starts[o.count] * (size_t)dim; i++) coords[i] = fuzz_double(bytes);
    o.coords = coords;
    o.point_count = starts[o.count];
    if (o.kind == FROE_POLYGON || o.kind == FROE_HULL) o.starts = starts;
    if (o.kind == FROE_BALL) o.radii = radii;
    froe_diagnostic why;
    if (froe_scene_add(scene, &o, &why) && !memchr(why.message, '\0', sizeof why.message))
        complain("message without an end", &why);
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
static void take_picture(const froe_tree *tree, const froe_surface *surface, fuzz_bytes *bytes) {
    froe_camera c = froe_camera_defaults();
    froe_projection view;
    froe_picture_options o = froe_picture_defaults();
    froe_picture *picture = NULL;
    uint8_t clear[256];
    froe_diagnostic why;
    for (int k = 0; k < 3; k++) c.eye[k] = fuzz_double(bytes), c.target[k] = fuzz_double(bytes);
    const uint8_t bits = fuzz_byte(bytes);
    c.parallel = bits & 1, c.fit = bits & 2;
    if (froe_camera_place(&c, froe_tree_scene(tree), &view, &why)) return;
    for (size_t i = 0; i < 256; i++) clear[i] = bits & 4 && i % 3 == 0;
    o.view = &view;
    o.paint = (froe_paint)(fuzz_byte(bytes) % FROE_PAINT_COUNT);
    o.lines = 31, o.hidden = true, o.underlap = 1;
    if (froe_surface_patch_count(surface) <= 256) o.clear = clear;
    if (froe_picture_new(tree, surface, &o, &picture, &why) == FROE_OK)
        for (size_t i = 0; i < froe_picture_shape_count(picture); i++) {
            const froe_shape s = froe_picture_shape(picture, i);
            for (size_t r = 0, n = 0; r < s.ring_count; r++)
                if (!froe_picture_ring(picture, s.first_ring + r, &n) || n < 3) complain("ring", &why);
        }
    froe_picture_free(picture);
}

/* What an eye sees of a scene in space, all around or through a window, read to the last interval. */
static void see(const froe_tree *tree, const froe_eye *eye, fuzz_bytes *bytes) {
    froe_surface *surface = NULL;
    froe_visibility *v = NULL;
    froe_visibility_options o = froe_visibility_defaults();
    double window[9], corners[60];
    froe_diagnostic why;
    o.eye = *eye;
    o.cull_back = fuzz_byte(bytes) % 2;
    for (int k = 0; k < 9; k++) window[k] = fuzz_double(bytes);
    if (fuzz_byte(bytes) % 2) o.window = window, o.window_corners = 3;
    if (froe_surface_new(froe_tree_scene(tree), NULL, &surface, &why)) return;
    if (froe_visibility_new(tree, surface, &o, &v, &why) == FROE_OK) {
        for (size_t i = 0; i < froe_visibility_piece_count(v); i++)
            if (froe_visibility_corners(v, i, corners, 20) < 3) complain("piece without area", &why);
        for (uint32_t e = 0; e < froe_surface_edge_count(surface); e++) {
            size_t count;
            const froe_interval *x = froe_visibility_of_edge(v, e, &count);
            for (size_t i = 0; i < count; i++)
                if (!(x[i].from <= x[i].to) || (i && !(x[i - 1].to <= x[i].from))) complain("intervals", &why);
        }
        if (froe_visibility_regions(v, 0, UINT32_MAX, look_at_region, NULL, &why)) complain("regions", &why);
    }
    froe_visibility_free(v);
    take_picture(tree, surface, bytes);
    froe_surface_free(surface);
}

/* All pieces in depth order, or a refusal. */
static void look(const froe_tree *tree, fuzz_bytes *bytes) {
    froe_eye eye = {.parallel = fuzz_byte(bytes) % 2};
    froe_order_options o = froe_order_defaults();
    uint32_t *pieces = calloc(froe_tree_piece_count(tree) + 1, sizeof *pieces);
    size_t count = 0;
    froe_diagnostic why = {.message = "pieces left out"};
    for (int k = 0; k < 3; k++) eye.at[k] = fuzz_double(bytes);
    o.front_to_back = fuzz_byte(bytes) % 2;
    o.threads = 1;
    if (froe_tree_order(tree, &eye, &o, count_pieces, &count, &why) == FROE_OK &&
        (count != froe_tree_piece_count(tree) || !pieces || froe_tree_orders(tree, &eye, 1, &o, pieces, &why)))
        complain("order", &why);
    free(pieces);
    see(tree, &eye, bytes);
}

static void build_and_audit(froe_scene *scene, fuzz_bytes *bytes) {
    froe_build_options b = froe_build_defaults();
    size_t methods = 0;
    while (froe_method_at(methods)) methods++;
    const uint8_t which = fuzz_byte(bytes);
    if (methods && which % 4) b.method = froe_method_at(which % methods)->name;
    b.leaf = fuzz_byte(bytes) % 4;
    b.seed = fuzz_byte(bytes);
    b.threads = 1 + fuzz_byte(bytes) % 2;
    b.max_fragments = 20000;
    froe_tree *tree;
    froe_diagnostic why;
    if (froe_build(scene, &b, &tree, &why)) return;
    if (froe_tree_audit(tree, NULL, &why)) complain("audit", &why);
    look(tree, bytes);
    froe_tree_free(tree);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_bytes bytes = {data, size};
    const uint8_t d = fuzz_byte(&bytes);
    const int dim = d < 0x60 ? 2 : d < 0xc0 ? 3 : 2 + d % 7;
    froe_scene *scene;
    if (froe_scene_new(dim, NULL, &scene)) return 0;
    for (int batches = 1 + fuzz_byte(&bytes) % 3; batches; batches--) add_batch(scene, dim, &bytes);
    froe_defects defects = {.size = sizeof defects};
    froe_diagnostic why;
    (void)froe_scene_defects(scene, 1, NULL, NULL, &defects, &why);
    build_and_audit(scene, &bytes);
    froe_scene_free(scene);
    return 0;
}
