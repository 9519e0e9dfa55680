/* test_near.c: faces that are nearly in one plane, and objects that poke through others by a few last places. */
#include <froe/formats.h>
#include <froe/measure.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "split/meshes.h"

#define WITHIN 0x1p-48

static froe_near near_of(int dim, const double *coords, size_t n, double share) {
    froe_scene *scene = mesh_of(dim, coords, n);
    froe_near one, three;
    assert_int_equal(froe_measure_near(scene, share, 1, NULL, NULL, &one, NULL), FROE_OK);
    assert_int_equal(froe_measure_near(scene, share, 3, NULL, NULL, &three, NULL), FROE_OK);
    assert_true(one.coplanar == three.coplanar && one.poking == three.poking);
    assert_true(one.first_poking[1] == three.first_poking[1] && one.first_coplanar[1] == three.first_coplanar[1]);
    froe_scene_free(scene);
    return one;
}

/** Two triangles with a common edge, the far corner of the second at height z. */
static froe_near roof(double z) {
    const double x[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, z, 0, 1, 0};
    return near_of(3, x, 2, WITHIN);
}

static void faces_are_nearly_coplanar_if_a_corner_is_just_beside(void **state) {
    (void)state;
    assert_int_equal(roof(0).coplanar, 0);
    assert_int_equal(roof(0x1p-50).coplanar, 1);
    assert_int_equal(roof(-0x1p-60).coplanar, 1);
    assert_int_equal(roof(0x1p-40).coplanar, 0);
    const froe_near near = roof(0x1p-50);
    assert_true(near.first_coplanar[0] == 0 && near.first_coplanar[1] == 1 && near.first_poking[0] == UINT32_MAX);
    assert_true(near.within == WITHIN && near.poking == 0);
}

/** A wall from below to height z above a floor. */
static froe_near wall(double z) {
    const double x[] = {-1, -1, 0, 1, -1, 0, 0, 1, 0, -0.1, 0, -1, 0.1, 0, -1, 0, 0, z};
    return near_of(3, x, 2, WITHIN);
}

static void walls_poke_through_floors_by_little_or_much(void **state) {
    (void)state;
    assert_int_equal(wall(0).poking, 0);
    assert_int_equal(wall(-0x1p-50).poking, 0);
    assert_int_equal(wall(0x1p-50).poking, 1);
    assert_int_equal(wall(0.5).poking, 0);
    assert_true(wall(0x1p-50).first_poking[0] == 0 && wall(0x1p-50).first_poking[1] == 1);
}

static void segments_poke_through_segments(void **state) {
    const double ends[] = {0, -0x1p-50, 0x1p-50, 0.5};
    const uint64_t poking[] = {0, 0, 1, 0};
    (void)state;
    for (int i = 0; i < 4; i++) {
        const double x[] = {-1, 0, 1, 0, 0, -1, 0, ends[i]};
        const froe_near near = near_of(2, x, 2, WITHIN);
        assert_int_equal(near.poking, poking[i]);
        assert_int_equal(near.coplanar, 0);
    }
}

/** Each square of a turned cuboid is two triangles that share an edge; most are no longer in one plane. */
static void walls_that_were_turned_are_counted(void **state) {
    const double c = 0.7648421872844885, s = 0.644217687237691;
    froe_scene *from = NULL;
    (void)state;
    assert_int_equal(froe_generate("cuboids", 240, 1, NULL, &from, NULL), FROE_OK);
    const uint32_t n = (uint32_t)froe_scene_object_count(from);
    double *x = test_malloc(9 * (size_t)n * sizeof *x);
    for (int turned = 0; turned < 2; turned++) {
        for (uint32_t i = 0; i < 3 * n; i++) {
            const double *p = froe_scene_vertex(from, froe_scene_corner(from, i / 3, i % 3));
            const double u = c * p[0] - s * p[1], v = s * p[0] + c * p[1];
            const double q[3] = {u, c * v - s * p[2], s * v + c * p[2]};
            for (int k = 0; k < 3; k++) x[3 * (size_t)i + (size_t)k] = turned ? q[k] : p[k];
        }
        const froe_near near = near_of(3, x, n, WITHIN);
        assert_true(turned ? near.coplanar > n / 4 && near.coplanar <= n / 2 : near.coplanar == 0);
    }
    test_free(x);
    froe_scene_free(from);
}

static void bad_arguments_are_refused(void **state) {
    const double x[] = {0, 0, 1, 0};
    froe_scene *scene = mesh_of(2, x, 1);
    froe_near near;
    (void)state;
    assert_int_equal(froe_measure_near(scene, -1, 1, NULL, NULL, &near, NULL), FROE_E_ARG);
    assert_int_equal(froe_measure_near(scene, NAN, 1, NULL, NULL, &near, NULL), FROE_E_ARG);
    assert_int_equal(froe_measure_near(scene, WITHIN, 1, NULL, NULL, NULL, NULL), FROE_E_ARG);
    froe_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(faces_are_nearly_coplanar_if_a_corner_is_just_beside),
        cmocka_unit_test(walls_poke_through_floors_by_little_or_much),
        cmocka_unit_test(segments_poke_through_segments),
        cmocka_unit_test(walls_that_were_turned_are_counted),
        cmocka_unit_test(bad_arguments_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
