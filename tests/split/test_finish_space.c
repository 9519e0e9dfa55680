/* Small cells of polygons: whatever the table of sides cannot hold or be sure of, the tree is right. */
#include "finish_trees.h"

#include "base/random.h"
#include <froe/formats.h>
#include <math.h>

enum { TRIANGLES = 48, NUMBERS = 9 * TRIANGLES };

/** Polygons of so many corners each. */
static froe_scene *scene_of(const double *coords, size_t count, size_t corners) {
    froe_scene *scene = NULL;
    froe_objects o = froe_objects_defaults();
    size_t starts[TRIANGLES + 1];
    for (size_t i = 0; i <= count; i++) starts[i] = corners * i;
    o.count = count;
    o.coords = coords;
    o.starts = starts;
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
    return scene;
}

static uint64_t check(const double *coords, size_t count, size_t corners) {
    froe_scene *scene = scene_of(coords, count, corners);
    const uint64_t pieces = check_scene(scene, 0);
    froe_scene_free(scene);
    return pieces;
}

static void triangles_that_touch_or_lie_in_a_plane_are_told_exactly(void **state) {
    double coords[NUMBERS];
    (void)state;
    for (uint64_t round = 0; round < 12; round++) {
        for (uint32_t i = 0; i < NUMBERS; i++) coords[i] = base_below(base_hash(round, 1, i), 2 + (uint32_t)round % 5);
        check(coords, TRIANGLES, 3);
    }
}

static double near_plane(double x, double y, uint64_t draw) {
    return 0.3 * x + 0.2 * y + 0.1 + 0x1p-53 * base_below(draw, 3);
}

static void triangles_beside_a_plane_by_less_than_rounding_are_told_exactly(void **state) {
    double coords[NUMBERS];
    (void)state;
    for (uint64_t round = 0; round < 2; round++) {
        for (uint32_t i = 0; i < NUMBERS; i += 3) {
            coords[i] = base_below(base_hash(round, 2, i), 30) * 0.1;
            coords[i + 1] = base_below(base_hash(round, 3, i), 30) * 0.1;
            coords[i + 2] = near_plane(coords[i], coords[i + 1], base_hash(round, 4, i));
        }
        check(coords, TRIANGLES, 3);
    }
}

static void of_equal_triangles_the_lowest_is_the_cut(void **state) {
    double coords[NUMBERS];
    (void)state;
    for (uint64_t round = 0; round < 8; round++) {
        for (uint32_t i = 0; i < NUMBERS; i++) coords[i] = base_below(base_hash(round, 8, i), 1000) * 0.001;
        for (uint32_t i = 0; i < TRIANGLES / 2; i++) /* the same the other way round */
            for (uint32_t k = 0; k < 9; k++)
                coords[9 * (i + TRIANGLES / 2) + k] = coords[9 * i + 3 * (2 - k / 3) + k % 3];
        check(coords, TRIANGLES, 3);
    }
}

static void cells_that_outgrow_the_table_are_handed_back(void **state) {
    double coords[NUMBERS];
    (void)state;
    for (uint32_t i = 0; i < TRIANGLES; i++) /* all of them cross near the middle */
        for (uint32_t k = 0; k < 9; k++) {
            const double at = base_below(base_hash(3, i, k), 1000) * 0.001 - 0.5;
            coords[9 * i + k] = 100 * (k / 3 == k % 3) - 33 + at;
        }
    assert_true(check(coords, TRIANGLES / 2, 3) > 64 + TRIANGLES);
}

/** A polygon inscribed in a circle of level z; corners are doubles, and the plane is exact. */
static void put_ring(double *to, size_t corners, double shift, double z) {
    for (size_t j = 0; j < corners; j++) {
        const double angle = 6.283185307179586 * (double)j / (double)corners;
        to[3 * j] = cos(angle) + shift;
        to[3 * j + 1] = sin(angle) - shift;
        to[3 * j + 2] = z;
    }
}

static void polygons_with_more_corners_than_the_table_has_are_cut_all_the_same(void **state) {
    (void)state;
    for (size_t corners = 7; corners <= 9; corners++) {
        double coords[3 * 9 * 12];
        for (uint32_t i = 0; i < 12; i++) {
            double *ring = coords + 3 * corners * i;
            put_ring(ring, corners, 0.03 * i, 0);
            for (size_t j = 0; j < corners && i % 2; j++) /* upright ones cut corners off the others */
                ring[3 * j + 2] = ring[3 * j + 1], ring[3 * j + 1] = 0.1 * i - 0.5;
            for (size_t j = 0; j < corners && i % 2 == 0; j++) ring[3 * j + 2] = 0.125 * i - 0.5;
        }
        assert_true(check(coords, 12, corners) > 12);
    }
}

static void a_power_of_two_changes_nothing(void **state) {
    double coords[NUMBERS], scaled[NUMBERS];
    (void)state;
    for (uint32_t i = 0; i < NUMBERS; i++) coords[i] = base_below(base_hash(5, 4, i), 1u << 20);
    froe_scene *scene = scene_of(coords, TRIANGLES, 3);
    froe_tree *tree = build(scene, 1, "stop=64", NUM_FILTER);
    for (int power = -100; power <= 100; power += 40) {
        for (uint32_t i = 0; i < NUMBERS; i++) scaled[i] = ldexp(coords[i], power);
        froe_scene *other = scene_of(scaled, TRIANGLES, 3);
        froe_tree *same = build(other, 1, "stop=64", NUM_FILTER);
        assert_int_equal(tree->node_count, same->node_count);
        assert_int_equal(tree->piece_count, same->piece_count);
        assert_memory_equal(tree->pieces, same->pieces, tree->piece_count * sizeof *tree->pieces);

        froe_tree_free(same);
        froe_scene_free(other);
    }
    froe_tree_free(tree);
    froe_scene_free(scene);
}

/** Pieces of a generated scene with some settings. */
static double pieces_of(const char *kind, const char *settings) {
    froe_scene *scene = NULL;
    assert_int_equal(froe_generate(kind, 1000, 3, NULL, &scene, NULL), FROE_OK);
    froe_tree *tree = build(scene, 0, settings, NUM_FILTER);
    audit(tree);
    const double pieces = tree->piece_count;
    froe_tree_free(tree);
    froe_scene_free(scene);
    return pieces;
}

/* More planes compete there, so there are about as many pieces or fewer. */
static void small_0_leaves_all_cells_to_cuts_one_by_one(void **state) {
    static const char *const kinds[] = {"terrain", "triangles", "mixed-3d", "cuboids"};
    (void)state;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        const double table = pieces_of(kinds[i], NULL), cuts = pieces_of(kinds[i], "small=0");
        assert_true(table != cuts);
        assert_true(table <= 1.02 * cuts);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(triangles_that_touch_or_lie_in_a_plane_are_told_exactly),
        cmocka_unit_test(triangles_beside_a_plane_by_less_than_rounding_are_told_exactly),
        cmocka_unit_test(of_equal_triangles_the_lowest_is_the_cut),
        cmocka_unit_test(cells_that_outgrow_the_table_are_handed_back),
        cmocka_unit_test(polygons_with_more_corners_than_the_table_has_are_cut_all_the_same),
        cmocka_unit_test(a_power_of_two_changes_nothing),
        cmocka_unit_test(small_0_leaves_all_cells_to_cuts_one_by_one),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
