/* samples.c: see samples.h. */
#include "support/samples.h"
#include "build/options.h"
#include "support/scatter.h"
#include <froe/kinetic.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void need(froe_status status, const char *what) {
    if (status == FROE_OK) return;
    fprintf(stderr, "samples: %s: %s\n", what, froe_status_name(status));
    exit(2);
}

/* ------------------------------------------------------------------ scenes -- */

typedef struct sample_scene {
    const char *name;
    int dim;
    unsigned kinds; /* `each` objects of each */
    size_t each;
    uint32_t grid; /* 0: anywhere */
    double size;
} sample_scene;

enum {
    POINTS = 1 << FROE_POINT,
    SEGMENTS = 1 << FROE_SEGMENT,
    POLYGONS = 1 << FROE_POLYGON,
    BOXES = 1 << FROE_BOX,
    BALLS = 1 << FROE_BALL,
    HULLS = 1 << FROE_HULL,
};

static const sample_scene scenes[] = {
    {"segments", 2, SEGMENTS, 8, 0, 0.6},
    {"lattice", 2, SEGMENTS, 9, 4, 0.9},
    {"points", 2, POINTS, 9, 0, 0},
    {"points-and-segments", 2, POINTS | SEGMENTS, 5, 3, 0.9},
    {"boxes", 2, BOXES, 8, 5, 0.5},
    {"balls", 2, BALLS, 7, 0, 0.5},
    {"hulls", 2, HULLS, 5, 0, 0.5},
    {"mixed", 2, POINTS | SEGMENTS | BOXES | BALLS | HULLS, 2, 5, 0.6},
    {"triangles", 3, POLYGONS, 7, 0, 0.8},
    {"lattice-triangles", 3, POLYGONS, 7, 3, 0.9},
    {"segments-3d", 3, SEGMENTS, 7, 0, 0.7},
    {"points-3d", 3, POINTS, 9, 4, 0},
    {"boxes-3d", 3, BOXES, 7, 5, 0.6},
    {"balls-3d", 3, BALLS, 6, 0, 0.6},
    {"hulls-3d", 3, HULLS, 5, 3, 0.8},
    {"mixed-3d", 3, POINTS | SEGMENTS | POLYGONS | BOXES | BALLS | HULLS, 2, 0, 0.6},
    {"points-4d", 4, POINTS, 8, 0, 0},
    {"boxes-4d", 4, BOXES, 7, 4, 0.7},
    {"balls-5d", 5, BALLS, 6, 0, 0.7},
    {"boxes-5d", 5, BOXES, 5, 0, 0.7},
};

static froe_scene *scatter(const sample_scene *s) {
    froe_scene *scene;
    need(froe_scene_new(s->dim, NULL, &scene), s->name);
    for (int kind = 0; kind < FROE_KIND_COUNT; kind++)
        if (s->kinds >> kind & 1)
            need(trees_scatter(scene, (froe_kind)kind, s->each, s->grid, s->size, 5 + (uint64_t)kind), s->name);
    return scene;
}

static void add_ring(froe_scene *scene, const char *name, uint32_t face, const double *points, uint32_t count) {
    uint32_t ends[16], faces[8];
    const froe_group group = {.name = name, .material = "land", .left = "in", .right = "out", .colour = 0x336699ff};
    froe_objects o = froe_objects_defaults();
    o.kind = FROE_SEGMENT, o.count = o.point_count = count, o.coords = points, o.indices = ends;
    for (uint32_t i = 0; i < count; i++) faces[i] = face, ends[2 * i] = i, ends[2 * i + 1] = (i + 1) % count;
    if (face != FROE_NONE) o.faces = faces;
    need(froe_scene_add_group(scene, &group, &o.group), name);
    need(froe_scene_add(scene, &o, NULL), name);
}

/* Two countries with a border in common, and an area of which no faces are known. */
static froe_scene *areas(void) {
    static const double west[] = {0, 0, 4, 0, 4, 4, 0, 4}, east[] = {4, 0, 7, 1, 4, 4}, lake[] = {1, 1, 5, 2, 2, 3};
    const uint64_t tag = 77;
    const double pier[] = {3, 3, 6, 6};
    froe_objects o = froe_objects_defaults();
    froe_scene *scene;
    const froe_crs degrees = {FROE_CRS_GEOGRAPHIC, "GEOGCRS[]", "WGS 84", "EPSG:4326", "degree"};
    need(froe_scene_new(2, NULL, &scene), "areas");
    need(froe_scene_set_crs(scene, &degrees), "areas");
    add_ring(scene, "west", 3, west, 4);
    add_ring(scene, "east", 4, east, 3);
    add_ring(scene, "lake", FROE_NONE, lake, 3);
    o.kind = FROE_SEGMENT, o.count = 1, o.coords = pier, o.tags = &tag;
    need(froe_scene_add(scene, &o, NULL), "areas");
    return scene;
}

/* Boxes one in the other, which become covers, around two segments. */
static froe_scene *nested(void) {
    const double segments[8] = {0.25, 0.5, 1, 1.5, 2, 0, 3, 3};
    double boxes[4 * 12];
    froe_objects o = froe_objects_defaults();
    froe_scene *scene;
    need(froe_scene_new(2, NULL, &scene), "nested");
    for (int i = 0; i < 48; i++) boxes[i] = i % 4 < 2 ? -i / 4 : 4 + i / 4 + i % 3;
    o.kind = FROE_BOX, o.count = 12, o.coords = boxes;
    need(froe_scene_add(scene, &o, NULL), "nested");
    o.kind = FROE_SEGMENT, o.count = 2, o.coords = segments;
    need(froe_scene_add(scene, &o, NULL), "nested");
    return scene;
}

/* Two balls 2^-101 of their size apart, which no plane of doubles separates, across a direction of 3, 4. */
static froe_scene *narrow(int dim) {
    const double k = 0x1p49, radii[2] = {5 * k, 5 * k};
    double centres[2 * FROE_MAX_DIM] = {0};
    froe_objects o = froe_objects_defaults();
    froe_scene *scene;
    centres[dim] = 6 * k + 4;
    centres[dim + 1] = 8 * k - 3;
    need(froe_scene_new(dim, NULL, &scene), "narrow");
    o.kind = FROE_BALL, o.count = 2, o.coords = centres, o.radii = radii;
    need(froe_scene_add(scene, &o, NULL), "narrow");
    return scene;
}

/* ------------------------------------------------------------------- trees -- */

/* False: that was enough. A method that does not serve the scene is passed over. */
static bool build(froe_scene *scene, const char *method, const char *name, samples_fn *fn, void *user) {
    froe_build_options o = froe_build_defaults();
    froe_tree *tree;
    o.method = method;
    o.threads = 1;
    o.leaf = strcmp(method, "index") ? 1 : 3;
    if (!strcmp(method, "density")) o.settings = "k=4 stop=1 growth=4"; /* so that there is a guard stage */
    if (!strcmp(method, "cylindrical")) o.settings = "crossing=split";
    const froe_status status = build_tuned(scene, &o, &tree, NULL);
    if (status == FROE_E_UNSUPPORTED || status == FROE_E_OPTIONS) return true;
    need(status, method);
    const bool on = fn(user, method, name, tree);
    froe_tree_free(tree);
    return on;
}

static bool build_all(froe_scene *scene, const char *name, samples_fn *fn, void *user) {
    bool on = true;
    for (size_t m = 0; on && froe_method_at(m); m++) on = build(scene, froe_method_at(m)->name, name, fn, user);
    froe_scene_free(scene);
    return on;
}

static bool section(samples_fn *fn, void *user) {
    const sample_scene triangles = {"triangles", 3, POLYGONS, 6, 0, 0.8};
    const double plane[] = {0.25, 0.5, 1, 0.9};
    froe_build_options o = froe_build_defaults();
    froe_scene *scene = scatter(&triangles);
    froe_tree *whole, *tree;
    o.threads = 1, o.method = "grain";
    need(froe_build(scene, &o, &whole, NULL), "section");
    need(froe_tree_section(whole, plane, NULL, &tree, NULL), "section");
    const bool on = fn(user, "section", triangles.name, tree);
    froe_tree_free(tree);
    froe_tree_free(whole);
    froe_scene_free(scene);
    return on;
}

static bool snapshot(samples_fn *fn, void *user) {
    enum { COUNT = 6, VERTICES = 2 * COUNT };
    double times[2 * VERTICES], coords[4 * VERTICES];
    size_t starts[VERTICES + 1];
    froe_motion_options w = froe_motion_defaults();
    froe_kinetic_options o = froe_kinetic_defaults();
    froe_moving moving = froe_moving_defaults();
    froe_motion *motion;
    froe_kinetic *kinetic;
    froe_snapshot now;
    for (size_t v = 0; v <= VERTICES; v++) starts[v] = 2 * v;
    for (size_t i = 0; i < 2 * VERTICES; i++) times[i] = i % 2 ? 8 : 0;
    for (size_t i = 0; i < 4 * VERTICES; i++) coords[i] = trees_random(3, i, 12);
    w.begin = 0, w.end = 8;
    need(froe_motion_new(&w, NULL, &motion, NULL), "snapshot");
    moving.vertex_count = VERTICES, moving.count = COUNT;
    moving.starts = starts, moving.times = times, moving.coords = coords;
    need(froe_motion_add(motion, &moving, NULL), "snapshot");
    need(froe_kinetic_new(motion, &o, NULL, &kinetic, NULL), "snapshot");
    need(froe_kinetic_advance(kinetic, 3, NULL, NULL, NULL), "snapshot");
    need(froe_kinetic_snapshot(kinetic, NULL, &now, NULL), "snapshot");
    const bool on = fn(user, "snapshot", "moving", now.tree);
    froe_tree_free(now.tree);
    froe_places_free(now.places);
    froe_kinetic_free(kinetic);
    froe_motion_free(motion);
    return on;
}

void samples_each(samples_fn *fn, void *user) {
    bool on = build_all(areas(), "areas", fn, user) && build_all(nested(), "nested", fn, user) &&
              build_all(narrow(2), "narrow", fn, user) && build_all(narrow(5), "narrow-5d", fn, user);
    for (size_t i = 0; on && i < sizeof scenes / sizeof *scenes; i++)
        on = build_all(scatter(scenes + i), scenes[i].name, fn, user);
    if (on && section(fn, user)) (void)snapshot(fn, user);
}
