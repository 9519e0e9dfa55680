/* test_turned.c: models whose walls are flat only up to a rounding. Turned by 0.7 about two axes and rounded, they have
 * few more pieces than the same models rounded to floats, which doubles see as they are; without marks (split/mark.h)
 * they have more. All counts are the same on every machine. */
#include "build/options.h"
#include <froe/formats.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "meshes.h"

typedef enum place { AS_IT_IS, SHIFTED, TURNED, TURNED_FLOATS } place;

/** The sine and cosine of 0.7, rounded. */
static const double sine = 0.644217687237691, cosine = 0.7648421872844885;

static void put_point(const double *p, place where, double *q) {
    const double x = cosine * p[0] - sine * p[1], y = sine * p[0] + cosine * p[1];
    const double turned[3] = {x, cosine * y - sine * p[2], sine * y + cosine * p[2]};
    for (int k = 0; k < 3; k++) {
        q[k] = where < TURNED ? p[k] + (where == SHIFTED ? 0x1p20 : 0) : turned[k];
        if (where == TURNED_FLOATS) q[k] = (double)(float)q[k];
    }
}

static froe_scene *placed(const char *kind, size_t n, place where) {
    froe_scene *from = NULL, *scene = NULL;
    froe_objects o = froe_objects_defaults();
    assert_int_equal(froe_generate(kind, n, 3, NULL, &from, NULL), FROE_OK);
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    const size_t count = froe_scene_object_count(from);
    size_t *starts = test_malloc((count + 1) * sizeof *starts);
    starts[0] = 0;
    for (uint32_t i = 0; i < count; i++) starts[i + 1] = starts[i] + froe_scene_object(from, i).corners;
    double *x = test_malloc(3 * starts[count] * sizeof *x);
    for (uint32_t i = 0; i < count; i++)
        for (size_t k = starts[i]; k < starts[i + 1]; k++)
            put_point(froe_scene_vertex(from, froe_scene_corner(from, i, (uint32_t)(k - starts[i]))), where, x + 3 * k);
    o.count = count;
    o.coords = x;
    o.starts = starts;
    assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
    test_free(x);
    test_free(starts);
    froe_scene_free(from);
    return scene;
}

static froe_report report_of(const char *kind, size_t n, place where, const char *method, const char *settings) {
    froe_scene *scene = placed(kind, n, where);
    froe_build_options o = froe_build_defaults();
    froe_diagnostic diag = {0};
    froe_tree *tree = NULL;
    o.method = method;
    o.settings = settings;
    o.leaf = 0;
    o.threads = 1;
    if (build_tuned(scene, &o, &tree, &diag)) fail_msg("%s", diag.message);
    const froe_report r = froe_tree_report(tree);
    froe_tree_free(tree);
    froe_scene_free(scene);
    return r;
}

static double pieces_each(const char *kind, size_t n, place where, const char *method, const char *settings) {
    const froe_report r = report_of(kind, n, where, method, settings);
    return (double)r.fragments / (double)r.objects;
}

/** The models: those with walls first. */
static const struct {
    const char *kind;
    size_t n;
    double least; /* density without marks makes so many times the pieces of the model in floats, at least; 0: not
                     looked at */
} models[] = {{"city", 4000, 1.15},   {"cuboids", 3000, 1.07}, {"terrain", 1200, 0},
              {"triangles", 1000, 0}, {"clusters-3d", 800, 0}, {"disjoint-3d", 800, 0},
              {"mixed-3d", 400, 0},   {"sphere", 4000, 1.1}}; /* whose rings of vertices are flat but for a rounding */
enum { MODELS = sizeof models / sizeof *models };

static void within(size_t i, const char *what, double is, double least, double most) {
    if (!(is >= least && is <= most))
        fail_msg("%s: %s: %g is not from %g to %g", models[i].kind, what, is, least, most);
}

static void turned_models_have_few_more_pieces(void **state) {
    (void)state;
    for (size_t i = 0; i < MODELS; i++) {
        const char *kind = models[i].kind;
        const size_t n = models[i].n;
        const double grain = pieces_each(kind, n, TURNED_FLOATS, "grain", NULL);
        const double density = pieces_each(kind, n, TURNED_FLOATS, "density", NULL);
        within(i, "grain", pieces_each(kind, n, TURNED, "grain", NULL) / grain, 0, 1.1);
        within(i, "density", pieces_each(kind, n, TURNED, "density", NULL) / density, 0, 1.07);
        if (models[i].least > 0)
            within(i, "density, checks=0", pieces_each(kind, n, TURNED, "density", "checks=0") / density,
                   models[i].least, 100);
    }
}

/** One refutation stands for all planes along a wall: exact numbers are asked less than half as often. */
static void marks_spare_grain_exact_counts(void **state) {
    (void)state;
    const uint64_t with = report_of("city", 4000, TURNED, "grain", NULL).predicates.exact;
    const uint64_t without = report_of("city", 4000, TURNED, "grain", "marks=0").predicates.exact;
    if (without < 2 * with) fail_msg("%llu, %llu", (unsigned long long)with, (unsigned long long)without);
}

/** A shift by 2^20 rounds these models; that costs little either way. */
static void shifted_models_have_few_more_pieces(void **state) {
    (void)state;
    for (size_t i = 0; i < MODELS; i++) {
        const double here = pieces_each(models[i].kind, models[i].n, AS_IT_IS, "grain", NULL);
        within(i, "shifted", pieces_each(models[i].kind, models[i].n, SHIFTED, "grain", NULL) / here, 0, 1.04);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(turned_models_have_few_more_pieces),
        cmocka_unit_test(marks_spare_grain_exact_counts),
        cmocka_unit_test(shifted_models_have_few_more_pieces),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
