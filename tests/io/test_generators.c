/* Generated scenes: every kind is made as it says, twice the same, different by seed,
 * sound, and comes back from a file bit for bit. */
#include "support.h"
#include <math.h>

static froe_scene *make(const char *kind, size_t n, uint64_t seed) {
    froe_scene *scene = NULL;
    froe_diagnostic why;
    if (froe_generate(kind, n, seed, NULL, &scene, &why)) fail_msg("%s", why.message);
    return scene;
}

static void every_kind_is_made_as_it_says(void **state) {
    (void)state;
    const froe_generator_info *info;
    size_t kinds = 0;
    for (; (info = froe_generator_at(kinds)); kinds++) {
        static const size_t sizes[] = {1, 2, 13, 1000};
        for (int i = 0; i < 4; i++) {
            froe_scene *scene = make(info->name, sizes[i], 3);
            size_t objects = froe_scene_object_count(scene);
            assert_int_equal(froe_scene_dim(scene), info->dim);
            assert_int_equal(froe_scene_kind_count(scene, info->kind), objects);
            if (strcmp(info->name, "sphere") != 0) assert_in_range(objects, sizes[i], sizes[i] + 24);
            froe_scene_free(scene);
        }
        assert_true(strlen(info->summary) > 10);
        for (size_t j = 0; j < kinds; j++) assert_string_not_equal(froe_generator_at(j)->name, info->name);
    }
    assert_true(kinds >= 50);
}

static void the_same_seed_gives_the_same_scene(void **state) {
    (void)state;
    /* all kinds of n = 500 and seed 7 together: one number on every platform and with every compiler */
    uint64_t all = 0;
    const froe_generator_info *info;
    for (size_t i = 0; (info = froe_generator_at(i)); i++) {
        froe_scene *a = make(info->name, 500, 7), *b = make(info->name, 500, 7), *c = make(info->name, 500, 8);
        uint64_t hash = scene_hash(a);
        assert_true(hash == scene_hash(b));
        static const char *const without_chance = " nested wedge lattice tiles collinear spiral nested-3d lattice-3d "
                                                  "tiles-3d grid-3d sphere shells bars bricks ";
        char word[32];
        snprintf(word, sizeof word, " %s ", info->name);
        assert_int_equal(hash == scene_hash(c), strstr(without_chance, word) != NULL);
        all = (all ^ hash) * 1099511628211u;
        froe_scene_free(a);
        froe_scene_free(b);
        froe_scene_free(c);
    }
    assert_int_equal(all, 0xacc2547ff032ff7d);
}

static const char *ending(const froe_generator_info *info) {
    if (info->dim > 3 || info->kind == FROE_POINT || info->kind == FROE_BOX || info->kind == FROE_BALL) return "csv";
    return info->dim == 2 ? "geojson" : "off";
}

static void every_kind_comes_back_from_its_file(void **state) {
    (void)state;
    const froe_generator_info *info;
    for (size_t i = 0; (info = froe_generator_at(i)); i++) {
        froe_scene *scene = make(info->name, 300, 5);
        char path[64];
        froe_diagnostic why;
        snprintf(path, sizeof path, "%s.%s", info->name, ending(info));
        if (froe_write_scene(scene, path, &why)) fail_msg("%s", why.message);
        froe_read_report report;
        froe_scene *back = read_scene(path, &report);
        assert_string_equal(report.precision, "float64");
        if (scene_hash(scene) != scene_hash(back)) fail_msg("%s differs after reading", path);
        froe_scene_free(back);
        froe_scene_free(scene);
        remove(path);
    }
}

static void disjoint_segments_are_disjoint(void **state) {
    (void)state;
    froe_scene *scene = make("disjoint", 2000, 1);
    froe_defects found = {.size = sizeof found};
    assert_int_equal(froe_scene_defects(scene, 1, NULL, NULL, &found, NULL), FROE_OK);
    assert_int_equal(found.crossings + found.t_junctions + found.overlaps + found.duplicates + found.zero_length, 0);
    froe_scene_free(scene);
    scene = make("slats", 60, 1);
    assert_int_equal(froe_scene_defects(scene, 1, NULL, NULL, &found, NULL), FROE_OK);
    assert_int_equal(found.crossings, 900);
    froe_scene_free(scene);
    scene = make("identical", 60, 1);
    assert_int_equal(froe_scene_defects(scene, 1, NULL, NULL, &found, NULL), FROE_OK);
    assert_int_equal(found.duplicates, 59);
    froe_scene_free(scene);
}

/* Each edge of a closed surface belongs to two triangles, once in each direction. */
static void the_sphere_is_closed_and_round(void **state) {
    (void)state;
    froe_scene *scene = make("sphere", 39600, 1);
    assert_int_equal(froe_scene_object_count(scene), 39600);
    assert_int_equal(froe_scene_vertex_count(scene), 2 + 39600 / 2); /* Euler: V = 2 + F / 2 */
    for (uint32_t v = 0; v < froe_scene_vertex_count(scene); v++) {
        const double *p = froe_scene_vertex(scene, v);
        assert_float_equal(sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]), 1, 1e-14);
    }
    froe_scene_free(scene);
}

static void bad_orders_are_refused(void **state) {
    (void)state;
    froe_scene *scene = NULL;
    froe_diagnostic why;
    assert_int_equal(froe_generate("segmets", 10, 1, NULL, &scene, &why), FROE_E_OPTIONS);
    assert_non_null(strstr(why.message, "segmets"));
    assert_int_equal(froe_generate("segments", 0, 1, NULL, &scene, &why), FROE_E_ARG);
    assert_int_equal(froe_generate("segments", (size_t)1 << 31, 1, NULL, &scene, &why), FROE_E_LIMIT);
    assert_int_equal(froe_generate(NULL, 10, 1, NULL, &scene, NULL), FROE_E_ARG);
    assert_null(scene);
    assert_null(froe_generator_at(1000));
}

static froe_status generate_and_free(void *user, const froe_allocator *alloc) {
    froe_scene *scene = NULL;
    froe_status status = froe_generate(user, 100, 1, alloc, &scene, NULL);
    froe_scene_free(scene);
    return status;
}

static void failing_memory_gives_a_status(void **state) {
    (void)state;
    const char *const kinds[] = {"segments", "cells", "blocks", "cells-3d", "city", "balls"};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        test_memory_each(generate_and_free, (void *)(uintptr_t)kinds[i]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_kind_is_made_as_it_says),       cmocka_unit_test(the_same_seed_gives_the_same_scene),
        cmocka_unit_test(every_kind_comes_back_from_its_file), cmocka_unit_test(disjoint_segments_are_disjoint),
        cmocka_unit_test(the_sphere_is_closed_and_round),      cmocka_unit_test(bad_orders_are_refused),
        cmocka_unit_test(failing_memory_gives_a_status),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
