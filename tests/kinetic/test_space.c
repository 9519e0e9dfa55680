/* test_space.c: partitions of moving triangles, made from scratch at many times, against trees of `cylindrical`. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "support/fuzz.h"
#include "support/memory.h"
#include <froe/kinetic.h>

enum { MOST = 64, WINDOW = 64 };

typedef enum space_kind { SMALL, LAYERS, RIGID, STEEP, BODIES, KINDS } space_kind;
static const char *const names[] = {"small", "layers", "rigid", "steep", "bodies"};

typedef struct space_data {
    size_t starts[3 * MOST + 1];
    double times[6 * MOST], coords[18 * MOST];
    uint32_t vertices[3 * MOST];
    size_t vertex_count, count;
} space_data;

/* A vertex on its way through the window: whole places at both ends, and so at all ticks in doubles. */
static void add_vertex(space_data *d, const int at[3], const int speed[3]) {
    const size_t v = d->vertex_count++;
    for (size_t end = 0; end < 2; end++) {
        d->times[2 * v + end] = end ? WINDOW : 0;
        for (size_t k = 0; k < 3; k++) d->coords[3 * (2 * v + end) + k] = at[k] + (end ? WINDOW * speed[k] : 0);
    }
    d->starts[v + 1] = 2 * v + 2;
}

/* Triangles in layers of z, or of y, none of which any leaves; or tetrahedra. */
static void add_triangle(space_data *d, space_kind kind, fuzz_source *r, int layer) {
    const int reach = kind == SMALL ? 120 : 500, corners = kind == BODIES ? 4 : 3;
    const int centre[2] = {fuzz_int(r, 0, 1000), fuzz_int(r, 0, 1000)};
    const int drift[2] = {fuzz_int(r, -9, 9), fuzz_int(r, -9, 9)};
    const uint32_t first = (uint32_t)d->vertex_count;
    for (int i = 0; i < corners; i++) {
        int at[3] = {centre[0] + fuzz_int(r, -reach, reach), centre[1] + fuzz_int(r, -reach, reach),
                     1000 * layer + fuzz_int(r, 0, 900)};
        int speed[3] = {drift[0], drift[1], 0};
        for (int k = 0; k < 2 && (kind == SMALL || kind == LAYERS || kind == STEEP); k++)
            speed[k] += fuzz_int(r, -9, 9);
        if (kind == STEEP) {
            const int y = at[2], v = speed[1];
            at[2] = at[1], at[1] = y, speed[2] = v, speed[1] = 0;
        }
        add_vertex(d, at, speed);
    }
    static const uint32_t faces[4][3] = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
    for (int i = 0; i < (kind == BODIES ? 4 : 1); i++, d->count++)
        for (size_t k = 0; k < 3; k++) d->vertices[3 * d->count + k] = first + faces[i][k];
}

static froe_motion *space_new(space_kind kind, size_t n, uint64_t seed) {
    static space_data d;
    fuzz_source r = {seed};
    d.vertex_count = d.count = 0;
    for (int layer = 0; d.count < n; layer++) add_triangle(&d, kind, &r, layer);
    froe_motion_options w = froe_motion_defaults();
    w.dim = 3, w.begin = 0, w.end = WINDOW, w.tick = 0x1p-16;
    froe_moving b = froe_moving_defaults();
    b.vertex_count = d.vertex_count, b.starts = d.starts, b.times = d.times, b.coords = d.coords;
    b.count = d.count, b.vertices = d.vertices;
    froe_motion *m = NULL;
    assert_int_equal(froe_motion_new(&w, NULL, &m, NULL), FROE_OK);
    assert_int_equal(froe_motion_add(m, &b, NULL), FROE_OK);
    return m;
}

static froe_kinetic *start(froe_motion *m, uint64_t seed) {
    froe_kinetic_options o = froe_kinetic_defaults();
    froe_kinetic *k = NULL;
    froe_diagnostic why = {0};
    o.seed = seed;
    if (froe_kinetic_new(m, &o, NULL, &k, &why)) fail_msg("%s", why.message);
    return k;
}

/* Node for node the tree that `cylindrical` builds of the triangles where they are, in which every place is exact. */
static void expect_alike(froe_kinetic *k, const char *name, uint64_t seed) {
    froe_snapshot s = {0};
    froe_diagnostic why = {0};
    if (froe_kinetic_snapshot(k, NULL, &s, &why)) fail_msg("%s %d: %s", name, (int)seed, why.message);
    if (!s.alike || s.rounded)
        fail_msg("%s %d at %g: alike %d, rounded %zu", name, (int)seed, froe_kinetic_time(k), s.alike, s.rounded);
    froe_tree_free(s.tree);
    if (froe_kinetic_audit(k, &why)) fail_msg("%s", why.message);
}

static void trees_are_those_of_cylindrical(void **state) {
    (void)state;
    for (int kind = 0; kind < KINDS; kind++)
        for (uint64_t seed = 1; seed <= 6; seed++) {
            froe_motion *m = space_new((space_kind)kind, 12 + 6 * seed, seed);
            froe_kinetic *k = start(m, seed);
            assert_true(froe_kinetic_statistics(k).nodes > 3 * (12 + 6 * seed));
            for (int i = 0; i <= 12; i++) {
                assert_int_equal(froe_kinetic_advance(k, i * WINDOW / 12.0, NULL, NULL, NULL), FROE_OK);
                expect_alike(k, names[kind], seed);
            }
            froe_kinetic_free(k);
            froe_motion_free(m);
        }
}

static froe_status with_memory(void *user, const froe_allocator *alloc) {
    froe_kinetic *k = NULL;
    froe_snapshot s = {0};
    froe_kinetic_options o = froe_kinetic_defaults();
    froe_status status = froe_kinetic_new(user, &o, alloc, &k, NULL);
    if (status) return status;
    status = froe_kinetic_advance(k, WINDOW / 2.0, NULL, NULL, NULL);
    if (!status) status = froe_kinetic_snapshot(k, NULL, &s, NULL);
    if (!status) status = froe_kinetic_audit(k, NULL);
    froe_tree_free(s.tree);
    froe_kinetic_free(k);
    return status;
}

static void memory_may_run_out(void **state) {
    froe_motion *m = space_new(BODIES, 4, 2);
    (void)state;
    test_memory_each(with_memory, m);
    froe_motion_free(m);
}

static bool never(void *user, const froe_event *event) {
    (void)user;
    (void)event;
    return true;
}

static void what_is_not_there_is_refused(void **state) {
    const double at[3] = {0, 0, 0};
    froe_motion *m = space_new(SMALL, 4, 1);
    froe_kinetic *k = start(m, 1), *none = NULL;
    froe_kinetic_place place;
    uint32_t hit;
    froe_kinetic_options o = froe_kinetic_defaults();
    (void)state;
    assert_int_equal(froe_kinetic_advance(k, 1, never, NULL, NULL), FROE_E_UNSUPPORTED);
    assert_int_equal(froe_kinetic_locate(k, at, &place, NULL), FROE_E_UNSUPPORTED);
    assert_int_equal(froe_kinetic_ray(k, at, at, &hit, NULL), FROE_E_UNSUPPORTED);
    assert_int_equal(froe_kinetic_update(k, NULL), FROE_E_UNSUPPORTED);
    assert_int_equal(froe_kinetic_remove(k, 0, NULL), FROE_E_UNSUPPORTED);
    assert_int_equal(froe_kinetic_replan(k, 0, 0, NULL, NULL, NULL, NULL), FROE_E_UNSUPPORTED);
    o.augmented = true;
    assert_int_equal(froe_kinetic_new(m, &o, NULL, &none, NULL), FROE_E_UNSUPPORTED);
    assert_null(none);
    froe_kinetic_free(k);
    froe_motion_free(m);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(trees_are_those_of_cylindrical),
        cmocka_unit_test(memory_may_run_out),
        cmocka_unit_test(what_is_not_there_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
