/* test_directional.c: directional density beside brute force: both ways to count find the same numbers. */
#include "measure/dominance.h"
#include "scene/scene.h"
#include <froe/measure.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "support/fuzz.h"
#include "support/memory.h"

/* ----------------------------------------------------------------- range trees -- */

enum { POINTS = 200 };

static void shuffle(fuzz_source *random, uint32_t *ranks, uint32_t count) {
    for (uint32_t i = 0; i < count; i++) ranks[i] = i;
    for (uint32_t i = count; i-- > 1;) {
        uint32_t j = base_below(fuzz_bits(random), i + 1), rank = ranks[i];
        ranks[i] = ranks[j];
        ranks[j] = rank;
    }
}

static void check_dominance(int dim, uint32_t count) {
    static uint32_t ranks[FROE_MAX_DIM][POINTS];
    uint32_t *rank[FROE_MAX_DIM], below[FROE_MAX_DIM];
    froe_allocator alloc = support_allocator(NULL);
    fuzz_source random = {count + 1000 * (uint64_t)dim};
    measure_dominance tree;
    for (int k = 0; k < dim; k++) shuffle(&random, rank[k] = ranks[k], count);
    assert_int_equal(measure_dominance_new(&alloc, dim, count, rank, &tree), FROE_OK);
    for (int q = 0; q < 300; q++) {
        uint32_t brute = 0;
        for (int k = 0; k < dim; k++) below[k] = (uint32_t)fuzz_int(&random, q % 2 ? 0 : (int)count / 2, (int)count);
        for (uint32_t i = 0; i < count; i++) {
            bool in = true;
            for (int k = 0; k < dim; k++) in = in && ranks[k][i] < below[k];
            brute += in;
        }
        assert_int_equal(measure_dominance_count(&tree, below), brute);
    }
    measure_dominance_free(&tree);
}

static void range_trees_count_as_brute_force(void **state) {
    static const uint32_t counts[] = {1, 2, 3, 7, 64, 65, 128, POINTS};
    (void)state;
    for (int dim = 2; dim <= 5; dim++)
        for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) check_dominance(dim, counts[i]);
    check_dominance(8, 40);
}

/* ---------------------------------------------------------- forms of the density -- */

static bool overlap(double lo, double hi, double from, double to) {
    return lo < to && hi > from;
}

/* Boxes that cross the plane of a face of e, widened by room, and keep out of e. */
static double crossings(const froe_scene *s, uint32_t e, int axis, int end, const double *room) {
    double lo[2][FROE_MAX_DIM], hi[2][FROE_MAX_DIM], count = 0;
    scene_object_bounds(s, e, lo[0], hi[0]);
    for (uint32_t f = 0; f < s->object_count; f++) {
        bool near = true, within = true;
        scene_object_bounds(s, f, lo[1], hi[1]);
        for (int k = 0; k < s->dim; k++) {
            double c = end ? hi[0][k] : lo[0][k];
            near = near && (k == axis ? lo[1][k] < c && c < hi[1][k]
                                      : overlap(lo[1][k], hi[1][k], lo[0][k] - room[k], hi[0][k] + room[k]));
            within = within && overlap(lo[1][k], hi[1][k], lo[0][k], hi[0][k]);
        }
        count += f != e && near && !within;
    }
    return count;
}

static double worse(const froe_scene *s, uint32_t e, int axis, const double *room) {
    return fmax(crossings(s, e, axis, 0, room), crossings(s, e, axis, 1, room));
}

typedef struct forms {
    double simple, extended, two_directional, paired;
} forms;

static forms of_box(const froe_scene *s, uint32_t e, double delta) {
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM], side[FROE_MAX_DIM], room[FROE_MAX_DIM], most = 1 + 2 * delta;
    forms out = {0, 0, INFINITY, INFINITY};
    int longest = 0;
    scene_object_bounds(s, e, lo, hi);
    for (int k = 0; k < s->dim; k++) side[k] = hi[k] - lo[k];
    for (int k = 1; k < s->dim; k++)
        if (side[k] > side[longest]) longest = k;
    for (int axis = 0; axis < s->dim; axis++) {
        double face = 0, all = 0;
        for (int k = 0; k < s->dim; k++) room[k] = delta * side[k];
        out.simple = fmax(out.simple, worse(s, e, axis, room));
        for (int k = 0; k < s->dim; k++) face = k == axis ? face : fmax(face, side[k]);
        for (int k = 0; k < s->dim; k++) room[k] = face > 0 ? most * face : 0;
        out.extended = fmax(out.extended, worse(s, e, axis, room));
        if (axis == longest) continue;
        for (int k = 0; k < s->dim; k++)
            room[k] = k == axis ? delta * side[k] : side[longest] > 0 ? most * side[longest] : 0;
        for (int k = 0; k < s->dim; k++) all = fmax(all, worse(s, e, k, room));
        out.two_directional = fmin(out.two_directional, all);
        out.paired = fmin(out.paired, worse(s, e, axis, room));
    }
    return out;
}

static froe_directional measure(const froe_scene *s, double delta, froe_counting counting) {
    froe_measure_options o = froe_measure_defaults();
    froe_directional found;
    o.samples = 0;
    o.counting = counting;
    assert_int_equal(froe_measure_directional(s, delta, &o, &found, NULL), FROE_OK);
    return found;
}

static void check_spread(const froe_spread *found, double most, double sum) {
    assert_true(found->most == most);
    assert_true(fabs(found->mean * (double)found->count - sum) < 1e-6);
}

static void check_scene(const froe_scene *s, double delta) {
    froe_directional search = measure(s, delta, FROE_COUNT_SEARCH), trees = measure(s, delta, FROE_COUNT_TREES);
    forms most = {0}, sum = {0};
    for (uint32_t e = 0; e < s->object_count; e++) {
        forms f = of_box(s, e, delta);
        most = (forms){fmax(most.simple, f.simple), fmax(most.extended, f.extended),
                       fmax(most.two_directional, f.two_directional), fmax(most.paired, f.paired)};
        sum = (forms){sum.simple + f.simple, sum.extended + f.extended, sum.two_directional + f.two_directional,
                      sum.paired + f.paired};
    }
    check_spread(&search.simple, most.simple, sum.simple);
    check_spread(&search.extended, most.extended, sum.extended);
    check_spread(&search.two_directional, most.two_directional, sum.two_directional);
    check_spread(&search.paired, most.paired, sum.paired);
    assert_memory_equal(&search, &trees, sizeof search);
}

/* Boxes on a lattice: many touch, coincide, overlap, are flat; each longest on some axis. */
static froe_status make(int dim, uint32_t n, int lattice, int longest, const froe_allocator *alloc, froe_scene **out) {
    double coords[160][2][FROE_MAX_DIM], flat[160 * 2 * FROE_MAX_DIM], *to = flat;
    fuzz_source random = {n + (uint64_t)lattice};
    for (uint32_t i = 0; i < n; i++)
        for (int k = 0; k < dim; k++) {
            int most = fuzz_int(&random, 0, 3) ? 2 : longest;
            coords[i][0][k] = fuzz_int(&random, 0, lattice);
            coords[i][1][k] = coords[i][0][k] + fuzz_int(&random, 0, most);
        }
    for (uint32_t i = 0; i < n; i++)
        for (int e = 0; e < 2; e++)
            for (int k = 0; k < dim; k++) *to++ = coords[i][e][k];
    froe_objects objects = froe_objects_defaults();
    objects.kind = FROE_BOX, objects.count = n, objects.coords = flat;
    froe_status status = froe_scene_new(dim, alloc, out);
    return status ? status : froe_scene_add(*out, &objects, NULL);
}

static void densities_are_those_of_brute_force(void **state) {
    static const struct {
        int dim, lattice, longest;
        uint32_t n;
    } scenes[] = {{2, 40, 3, 80},   {2, 4, 2, 120}, {2, 30, 30, 60}, {3, 20, 3, 120}, {3, 3, 2, 100},
                  {3, 20, 20, 100}, {4, 8, 5, 60},  {5, 6, 9, 40},   {8, 3, 2, 12}};
    static const double deltas[] = {0, 0.5, 2, 1e308};
    (void)state;
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        froe_scene *s = NULL;
        assert_int_equal(make(scenes[i].dim, scenes[i].n, scenes[i].lattice, scenes[i].longest, NULL, &s), FROE_OK);
        for (size_t d = 0; d < sizeof deltas / sizeof *deltas; d++) check_scene(s, deltas[d]);
        froe_scene_free(s);
    }
}

/* A wide slab, and beside it a row of small boxes of which 6 cross the plane of its top, none those of its rims. */
static void a_box_in_a_known_place(void **state) {
    double coords[12][2][3] = {{{0, 0, 0}, {8, 8, 1}}};
    for (int i = 1; i < 12; i++) {
        double at = i - 2.5;
        memcpy(coords[i], (double[2][3]){{9, at, 0.25}, {10, at + 0.5, 0.75}}, sizeof coords[i]); /* beside, between */
        if (i % 2) coords[i][1][2] = 1.5;                                                         /* across its top */
    }
    froe_objects objects = froe_objects_defaults();
    froe_scene *s = NULL;
    objects.kind = FROE_BOX, objects.count = 12, objects.coords = &coords[0][0][0];
    (void)state;
    assert_int_equal(froe_scene_new(3, NULL, &s), FROE_OK);
    assert_int_equal(froe_scene_add(s, &objects, NULL), FROE_OK);
    forms f = of_box(s, 0, 0.25);
    assert_true(f.simple == 6 && f.extended == 6 && f.two_directional == 6 && f.paired == 0);
    check_scene(s, 0.25);
    froe_scene_free(s);
}

/* ------------------------------------------------------------------------ limits -- */

static froe_status measure_in(void *user, const froe_allocator *alloc) {
    froe_scene *scene = NULL;
    froe_directional found;
    froe_measure_options o = froe_measure_defaults();
    (void)user;
    o.counting = FROE_COUNT_TREES;
    froe_status status = make(3, 6, 4, 3, alloc, &scene);
    if (!status) status = froe_measure_directional(scene, 1, &o, &found, NULL);
    froe_scene_free(scene);
    return status;
}

static bool refuse(void *user, double done) {
    (void)user;
    (void)done;
    return false;
}

static void what_cannot_be_done_is_refused(void **state) {
    froe_measure_options o = froe_measure_defaults();
    froe_directional found;
    froe_scene *s = NULL;
    (void)state;
    test_memory_each(measure_in, NULL);
    assert_int_equal(froe_scene_new(3, NULL, &s), FROE_OK);
    o.counting = FROE_COUNT_TREES;
    assert_int_equal(froe_measure_directional(s, 1, &o, &found, NULL), FROE_OK);
    assert_int_equal(found.count, 0);
    froe_scene_free(s);
    assert_int_equal(make(3, 100, 9, 9, NULL, &s), FROE_OK);
    o.progress = refuse;
    assert_int_equal(froe_measure_directional(s, 1, &o, &found, NULL), FROE_E_CANCELLED);
    o.counting = (froe_counting)7;
    assert_int_equal(froe_measure_directional(s, 1, &o, &found, NULL), FROE_E_OPTIONS);
    froe_scene_free(s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(range_trees_count_as_brute_force),
        cmocka_unit_test(densities_are_those_of_brute_force),
        cmocka_unit_test(a_box_in_a_known_place),
        cmocka_unit_test(what_cannot_be_done_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
