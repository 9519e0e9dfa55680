/* test_measures.c: what a scene is said to be like, beside brute force: bounds that hold, counts that are right, and
 * nothing that depends on the order or the scale of the objects. */
#include "geom/meet/meet.h"
#include "measure/enclosing.h"
#include "measure/volume.h"
#include "scene/convex.h"
#include <froe/measure.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "support/fuzz.h"
#include "support/memory.h"

static froe_measure_options all_objects(void) {
    froe_measure_options o = froe_measure_defaults();
    o.samples = 0;
    return o;
}

/* A scene of boxes or segments with small whole coordinates, in the order of a permutation, times a scale. */
enum { MOST = 64 };
static froe_scene *make(froe_kind kind, int dim, int n, uint64_t seed, int turn, double scale) {
    double coords[MOST][2][FROE_MAX_DIM], flat[MOST * 2 * FROE_MAX_DIM];
    fuzz_source random = {seed};
    for (int i = 0; i < n; i++)
        for (int k = 0; k < dim; k++) {
            double at = floor(fuzz_unit(&random) * 32), extent = floor(fuzz_unit(&random) * 12);
            coords[i][0][k] = scale * at;
            coords[i][1][k] = scale * (at + (kind == FROE_BOX ? fabs(extent) : extent));
        }
    double *to = flat;
    for (int i = 0; i < n; i++)
        for (int e = 0; e < 2; e++)
            for (int k = 0; k < dim; k++) *to++ = coords[(i * turn + turn / 2) % n][e][k];
    froe_objects objects = froe_objects_defaults();
    froe_scene *scene = NULL;
    objects.kind = kind;
    objects.count = (size_t)n;
    objects.coords = flat;
    assert_int_equal(froe_scene_new(dim, NULL, &scene), FROE_OK);
    assert_int_equal(froe_scene_add(scene, &objects, NULL), FROE_OK);
    return scene;
}

/* ---------------------------------------------------- clutter, exactly, in the plane -- */

/* Does an object meet the open square? Everything is a multiple of 1/4 and small: doubles are exact. */
static bool meets(num_context *context, const froe_scene *scene, uint32_t object, double x, double y, double side) {
    const double points[4] = {x + 0x1p-20, y + 0x1p-20, x + side - 0x1p-20, y + side - 0x1p-20};
    geom_convex square = {.core = GEOM_CORE_BOX, .dim = 2, .count = 4, .coords = points};
    geom_convex body = scene_convex(scene, object);
    return geom_meet(context, &square, &body);
}

/* The most objects that meet an open square with its left and right, or upper and lower, sides at two guards: the
 * square slides in steps of 1/4, which meets every place between two coordinates. */
static uint32_t exact_clutter(froe_scene *scene, int axis) {
    double guards[4 * MOST][2];
    uint32_t n = scene->object_count, most = 0;
    num_context context;
    assert_int_equal(num_context_new(NULL, &context), FROE_OK);
    for (uint32_t i = 0; i < n; i++) {
        double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
        scene_object_bounds(scene, i, lo, hi);
        for (int c = 0; c < 4; c++)
            guards[4 * i + (uint32_t)c][0] = c & 1 ? hi[0] : lo[0],
                           guards[4 * i + (uint32_t)c][1] = c & 2 ? hi[1] : lo[1];
    }
    for (uint32_t i = 0; i < 4 * n; i++)
        for (uint32_t j = 0; j < 4 * n; j++) {
            double a = guards[i][axis], side = guards[j][axis] - a;
            for (double y = -12 - side; side > 0 && y < 44; y += 0.25) {
                double from[2] = {a, y};
                if (axis) from[0] = y, from[1] = a;
                bool empty = true;
                for (uint32_t g = 0; g < 4 * n && empty; g++)
                    empty = guards[g][0] <= from[0] || guards[g][0] >= from[0] + side || guards[g][1] <= from[1] ||
                            guards[g][1] >= from[1] + side;
                if (!empty) continue;
                uint32_t met = 0;
                for (uint32_t o = 0; o < n; o++) met += meets(&context, scene, o, from[0], from[1], side);
                if (met > most) most = met;
            }
        }
    num_context_free(&context);
    return most;
}

static void clutter_is_at_most_what_it_is(void **state) {
    uint32_t found = 0;
    enum { SCENES = 3 };
    (void)state;
    for (uint64_t seed = 1; seed <= SCENES; seed++) {
        froe_scene *scene = make(FROE_SEGMENT, 2, 5, seed, 1, 1);
        froe_measure_options o = all_objects();
        froe_clutter clutter;
        uint32_t best = 0, across = exact_clutter(scene, 0), along = exact_clutter(scene, 1);
        uint32_t exact = across > along ? across : along;
        for (o.seed = 1; o.seed <= 40; o.seed++) { /* as many starts as a scene of 200 objects has */
            assert_int_equal(froe_measure_clutter(scene, &o, &clutter, NULL), FROE_OK);
            assert_true(clutter.lower <= exact);
            if (clutter.lower > best) best = clutter.lower;
        }
        found += best == exact;
        froe_scene_free(scene);
    }
    assert_true(found >= SCENES - 1);
}

/* ------------------------------------------------------------------------ density -- */

static double distance(const froe_scene *scene, const double *x, uint32_t object) { /* segments */
    const double *a = scene_point(scene, object, 0), *b = scene_point(scene, object, scene_corners(scene, object) - 1);
    double d[2] = {b[0] - a[0], b[1] - a[1]}, length = d[0] * d[0] + d[1] * d[1];
    double t = length > 0 ? ((x[0] - a[0]) * d[0] + (x[1] - a[1]) * d[1]) / length : 0;
    t = fmin(1, fmax(0, t));
    return hypot(a[0] + t * d[0] - x[0], a[1] + t * d[1] - x[1]);
}

static uint32_t load_of_ball(const froe_scene *scene, const double *centre, double radius, double slack) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < scene->object_count; i++)
        count += measure_enclosing(scene, i).radius >= radius * (1 - slack) &&
                 distance(scene, centre, i) <= radius * (1 + slack);
    return count;
}

static void density_is_between_its_bounds(void **state) {
    (void)state;
    for (uint64_t seed = 1; seed <= 8; seed++) {
        froe_scene *scene = make(FROE_SEGMENT, 2, 40, seed, 1, 1);
        froe_measure_options o = all_objects();
        froe_density density;
        fuzz_source random = {seed + 99};
        assert_int_equal(froe_measure_density(scene, FROE_SIZE_RADIUS, &o, &density, NULL), FROE_OK);
        assert_true(density.lower <= density.upper);
        assert_true(load_of_ball(scene, density.centre, density.radius, 1e-9) >= density.lower);
        uint32_t most = 0;
        for (int i = 0; i < 4000; i++) {
            const double centre[2] = {35 * fuzz_unit(&random), 35 * fuzz_unit(&random)};
            double radius = measure_enclosing(scene, (uint32_t)i % 40).radius;
            uint32_t load = load_of_ball(scene, centre, radius, 0);
            if (load > most) most = load;
        }
        assert_true(most <= density.upper);
        assert_true(density.lower + 1 >= most); /* 4,000 balls are hardly better */
        froe_scene_free(scene);
    }
}

/* ---------------------------------------------------------------------- fatness -- */

static void fatness_of_known_shapes(void **state) {
    const double coords[] = {0, 0, 0, 1, 1, 1, 0, 0, 0, 2, 1, 0}; /* a cube; a flat box */
    const double triangle[] = {0, 0, 0, 1, 0, 0, 0.5, 0.8660254037844386, 0};
    const size_t starts[] = {0, 3};
    froe_objects boxes = froe_objects_defaults(), polygon = froe_objects_defaults();
    froe_scene *scene;
    froe_fatness fatness;
    (void)state;
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    boxes.kind = FROE_BOX, boxes.count = 2, boxes.coords = coords;
    polygon.kind = FROE_POLYGON, polygon.count = 1, polygon.coords = triangle, polygon.starts = starts;
    assert_int_equal(froe_scene_add(scene, &boxes, NULL), FROE_OK);
    assert_int_equal(froe_scene_add(scene, &polygon, NULL), FROE_OK);
    assert_int_equal(froe_measure_fatness(scene, NULL, &fatness, NULL), FROE_OK);
    assert_int_equal(fatness.full.count, 2);
    assert_int_equal(fatness.thin, 2);
    assert_true(fabs(fatness.full.most - 0.36755259694786) < 1e-9); /* 2 / (sqrt(3) pi) */
    assert_true(fatness.full.least == 0);
    assert_true(fabs(fatness.flat.most - 0.41349667) < 1e-7); /* 3 sqrt(3) / (4 pi) */
    assert_true(fabs(fatness.sliver.most - 0.8660254037844386) < 1e-12);
    froe_scene_free(scene);
}

/* Hulls of the corners of a box, of points on its sides and inside, in any order: the volume of the box, exactly, for
 * coordinates are small whole numbers. And flat ones. */
static void volumes_of_hulls(void **state) {
    fuzz_source random = {5};
    (void)state;
    for (int round = 0; round < 300; round++) {
        const int dim = 2 + round % 2, flat = round % 7 == 0;
        double coords[40 * 3], side[3], volume = 1;
        size_t starts[2] = {0, 40};
        for (int k = 0; k < dim; k++) side[k] = 1 + floor(fabs(fuzz_unit(&random)) * 8);
        if (flat) side[round % dim] = 0;
        for (int k = 0; k < dim; k++) volume *= side[k];
        for (int i = 0; i < 40; i++)
            for (int k = 0; k < dim; k++) {
                const int at = (i * 13 + round) % 40; /* the first 2^dim of them, somewhere in between: corners */
                double share = fabs(fuzz_unit(&random)) < 0.5 ? 0 : floor(fabs(fuzz_unit(&random)) * (side[k] + 1));
                coords[i * dim + k] = 3 + (at < 1 << dim ? (at >> k & 1) * side[k] : share);
            }
        froe_objects hull = froe_objects_defaults();
        froe_scene *scene;
        num_context context;
        double found;
        hull.kind = FROE_HULL, hull.count = 1, hull.coords = coords, hull.starts = starts;
        assert_int_equal(froe_scene_new(dim, NULL, &scene), FROE_OK);
        assert_int_equal(froe_scene_add(scene, &hull, NULL), FROE_OK);
        assert_int_equal(num_context_new(NULL, &context), FROE_OK);
        assert_int_equal(measure_hull_volume(&context, &scene->alloc, scene, 0, 1, &found), FROE_OK);
        assert_true(fabs(found - volume) < 1e-9);
        froe_fatness fatness;
        assert_int_equal(froe_measure_fatness(scene, NULL, &fatness, NULL), FROE_OK);
        assert_int_equal(fatness.thin, flat);
        num_context_free(&context);
        froe_scene_free(scene);
    }
}

static void enclosing_balls_enclose_and_touch(void **state) {
    fuzz_source random = {12};
    (void)state;
    for (int round = 0; round < 500; round++) {
        enum { N = 12 };
        double coords[N * 3];
        size_t starts[2] = {0, N};
        froe_objects hull = froe_objects_defaults();
        froe_scene *scene;
        for (int i = 0; i < N * 3; i++) coords[i] = fuzz_unit(&random);
        assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
        hull.kind = FROE_HULL, hull.count = 1, hull.coords = coords, hull.starts = starts;
        assert_int_equal(froe_scene_add(scene, &hull, NULL), FROE_OK);
        measure_ball ball = measure_enclosing(scene, 0);
        int touching = 0;
        for (int i = 0; i < N; i++) {
            double d = 0;
            for (int k = 0; k < 3; k++)
                d += (coords[3 * i + k] - ball.centre[k]) * (coords[3 * i + k] - ball.centre[k]);
            assert_true(sqrt(d) <= ball.radius * (1 + 1e-9));
            touching += sqrt(d) >= ball.radius * (1 - 1e-9);
        }
        assert_true(touching >= 2 && ball.radius >= measure_diameter(scene, 0) / 2 * (1 - 1e-9));
        assert_true(ball.radius <= measure_diameter(scene, 0) * 0.6123724356957946); /* Jung: sqrt(3 / 8) */
        froe_scene_free(scene);
    }
}

/* --------------------------------------------------------------- order and scale -- */

/* Polygons and hulls with three corners in one line, the middle one first, so small or so large that no square of
 * theirs is a normal number. */
static void shapes_are_as_fat_at_every_scale(void **state) {
    static const double plane[] = {1, 0, 0, 0, 2, 0, 2, 2, 0, 2, 1, 2}, space[] = {0, 0, 0, 2, 0, 1, 0, 2, 3};
    static const double tent[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0.5, 0.5, 1};
    static const int powers[] = {0, -1000, -700, -540, 540, 1020};
    (void)state;
    for (int dim = 2; dim <= 3; dim++) {
        froe_fatness first = {.thin = 0};
        for (size_t i = 0; i < sizeof powers / sizeof *powers; i++) {
            double corners[15], polygon[9];
            const size_t starts[2] = {0, dim == 2 ? 6 : 5};
            froe_scene *scene;
            froe_fatness found;
            for (int k = 0; k < (dim == 2 ? 12 : 15); k++) corners[k] = ldexp(dim == 2 ? plane[k] : tent[k], powers[i]);
            for (int k = 0; k < 9; k++) polygon[k] = ldexp(space[k], powers[i]);
            froe_objects hull = froe_objects_defaults(), triangle = hull;
            hull.kind = FROE_HULL, hull.count = 1, hull.coords = corners, hull.starts = starts;
            triangle.count = 1, triangle.coords = polygon;
            assert_int_equal(froe_scene_new(dim, NULL, &scene), FROE_OK);
            assert_int_equal(froe_scene_add(scene, &hull, NULL), FROE_OK);
            if (dim == 3) assert_int_equal(froe_scene_add(scene, &triangle, NULL), FROE_OK);
            const froe_measure_options o = all_objects();
            assert_int_equal(froe_measure_fatness(scene, &o, &found, NULL), FROE_OK);
            if (i == 0) first = found;
            assert_true(found.full.median > 0 && fabs(found.full.median - first.full.median) < 1e-9);
            if (dim == 3) assert_true(found.flat.median > 0 && fabs(found.flat.median - first.flat.median) < 1e-9);
            froe_scene_free(scene);
        }
    }
}

static void order_and_scale_change_nothing(void **state) {
    enum { SCENES = 6 };
    static const double scales[SCENES] = {1, 1, 0x1p-200, 0x1p-960, 0x1p-600, 0x1p980};
    (void)state;
    for (int kind = 0; kind < 2; kind++) {
        froe_scene *scenes[SCENES];
        froe_kind form = kind ? FROE_BOX : FROE_SEGMENT;
        for (int i = 0; i < SCENES; i++) scenes[i] = make(form, 2, 50, 9, i == 1 ? 7 : 1, scales[i]);
        froe_measure_options o = all_objects();
        froe_clutter clutter[SCENES];
        froe_density density[SCENES];
        froe_directional directional[SCENES];
        froe_fatness fatness[SCENES];
        for (int i = 0; i < SCENES; i++) {
            assert_int_equal(froe_measure_fatness(scenes[i], &o, &fatness[i], NULL), FROE_OK);
            assert_memory_equal(&fatness[i], &fatness[0], sizeof fatness[0]);
            assert_int_equal(froe_measure_clutter(scenes[i], &o, &clutter[i], NULL), FROE_OK);
            assert_int_equal(froe_measure_density(scenes[i], FROE_SIZE_DIAMETER, &o, &density[i], NULL), FROE_OK);
            assert_int_equal(froe_measure_directional(scenes[i], 0.5, &o, &directional[i], NULL), FROE_OK);
            assert_int_equal(clutter[i].lower, clutter[0].lower);
            assert_int_equal(density[i].lower, density[0].lower);
            assert_int_equal(density[i].upper, density[0].upper);
            assert_memory_equal(&clutter[i].load, &clutter[0].load, sizeof clutter[0].load);
            assert_memory_equal(&density[i].load, &density[0].load, sizeof density[0].load);
            assert_memory_equal(&directional[i].extended, &directional[0].extended, sizeof directional[0].extended);
        }
        for (int i = 0; i < SCENES; i++) froe_scene_free(scenes[i]);
    }
}

/* ------------------------------------------------------------------------- limits -- */

static void nothing_is_measured_without_objects(void **state) {
    froe_scene *scene;
    froe_clutter clutter;
    froe_density density;
    froe_fatness fatness;
    froe_directional directional;
    (void)state;
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    assert_int_equal(froe_measure_clutter(scene, NULL, &clutter, NULL), FROE_OK);
    assert_int_equal(froe_measure_density(scene, FROE_SIZE_RADIUS, NULL, &density, NULL), FROE_OK);
    assert_int_equal(froe_measure_fatness(scene, NULL, &fatness, NULL), FROE_OK);
    assert_int_equal(froe_measure_directional(scene, 1, NULL, &directional, NULL), FROE_OK);
    assert_int_equal(clutter.lower + density.upper + directional.count, 0);
    assert_int_equal(froe_measure_directional(scene, -1, NULL, &directional, NULL), FROE_E_ARG);
    assert_int_equal(froe_measure_density(scene, (froe_size)2, NULL, &density, NULL), FROE_E_ARG);
    assert_int_equal(froe_measure_directional(NULL, 1, NULL, &directional, NULL), FROE_E_ARG);
    froe_scene_free(scene);
}

static froe_status measure_in(void *user, const froe_allocator *alloc) {
    froe_scene *scene = NULL;
    froe_clutter clutter;
    froe_density density;
    froe_fatness fatness;
    froe_directional directional;
    (void)user;
    static const double coords[] = {0, 0, 0, 1, 1, 1, 0.5, 0.5, 0, 3, 1, 0, 1, 0, 2, 2, 2, 2};
    froe_objects boxes = froe_objects_defaults();
    boxes.kind = FROE_BOX, boxes.count = 3, boxes.coords = coords;
    froe_status status = froe_scene_new(3, alloc, &scene);
    static const double tent[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0.5, 0.5, 1};
    const size_t five[] = {0, 5};
    froe_objects hull = froe_objects_defaults();
    hull.kind = FROE_HULL, hull.count = 1, hull.coords = tent, hull.starts = five;
    if (!status) status = froe_scene_add(scene, &boxes, NULL);
    if (!status) status = froe_scene_add(scene, &hull, NULL);
    if (!status) status = froe_measure_clutter(scene, NULL, &clutter, NULL);
    if (!status) status = froe_measure_density(scene, FROE_SIZE_RADIUS, NULL, &density, NULL);
    if (!status) status = froe_measure_fatness(scene, NULL, &fatness, NULL);
    if (!status) status = froe_measure_directional(scene, 1, NULL, &directional, NULL);
    froe_scene_free(scene);
    return status;
}

static void measures_survive_every_failing_allocation(void **state) {
    (void)state;
    test_memory_each(measure_in, NULL);
}

static bool refuse(void *user, double done) {
    (void)user;
    (void)done;
    return false;
}

static void measures_can_be_cancelled(void **state) {
    froe_scene *scene = make(FROE_BOX, 3, 50, 3, 1, 1);
    froe_measure_options o = all_objects();
    froe_clutter clutter;
    froe_density density;
    (void)state;
    o.progress = refuse;
    assert_int_equal(froe_measure_clutter(scene, &o, &clutter, NULL), FROE_E_CANCELLED);
    assert_int_equal(froe_measure_density(scene, FROE_SIZE_RADIUS, &o, &density, NULL), FROE_E_CANCELLED);
    froe_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(clutter_is_at_most_what_it_is),
        cmocka_unit_test(density_is_between_its_bounds),
        cmocka_unit_test(fatness_of_known_shapes),
        cmocka_unit_test(volumes_of_hulls),
        cmocka_unit_test(enclosing_balls_enclose_and_touch),
        cmocka_unit_test(shapes_are_as_fat_at_every_scale),
        cmocka_unit_test(order_and_scale_change_nothing),
        cmocka_unit_test(nothing_is_measured_without_objects),
        cmocka_unit_test(measures_survive_every_failing_allocation),
        cmocka_unit_test(measures_can_be_cancelled),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
