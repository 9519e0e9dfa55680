/* The groups that a point lies in, against brute force in rationals: maps, polygons that overlap and degenerate, lines
 * and solids beside them, on the trees of every builder, points anywhere, on corners, borders and cuts. */
#include "oracle/segment.h"
#include "query/exact_world.h"
#include "query/point/areas.h"
#include <unistd.h>

enum { DECISIONS = 1000000, MOST_GROUPS = 256 };

static uint64_t decisions, members, touching;

/* ------------------------------------------------------------------ oracle -- */

/** A scene with what its groups are. */
typedef struct map {
    world w;
    bool lines[MOST_GROUPS]; /* has the group no area? */
} map;

static bool between(double a, double x, double b) {
    return (a <= x && x <= b) || (b <= x && x <= a);
}

/* Is x on the closed segment? */
static bool is_on(const double *u, const double *v, const double *x) {
    return between(u[0], x[0], v[0]) && between(u[1], x[1], v[1]) && oracle_turn(u, v, x) == 0;
}

/* Does the ray from x upwards cross the segment, whose left end belongs to it and whose right end does not? */
static bool is_below(const double *u, const double *v, const double *x) {
    if ((u[0] <= x[0]) == (v[0] <= x[0])) return false;
    return oracle_turn(u[0] < v[0] ? u : v, u[0] < v[0] ? v : u, x) < 0;
}

static void brute_force(const map *m, const double *x, bool *in) {
    bool on[MOST_GROUPS] = {false}, odd[MOST_GROUPS] = {false};
    const size_t groups = froe_scene_group_count(m->w.scene);
    oracle_set point = oracle_points(2, x, 1, 0);
    for (uint32_t i = 0; i < m->w.count; i++) {
        const froe_object o = froe_scene_object(m->w.scene, i);
        if (o.group == FROE_NONE) continue;
        const double *u = froe_scene_vertex(m->w.scene, froe_scene_corner(m->w.scene, i, 0));
        const double *v = froe_scene_vertex(m->w.scene, froe_scene_corner(m->w.scene, i, o.form == FROE_SEGMENT));
        if (o.form > FROE_SEGMENT) {
            on[o.group] |= oracle_meet(&m->w.objects[i], &point);
            continue;
        }
        on[o.group] |= is_on(u, v, x);
        odd[o.group] ^= o.form == FROE_SEGMENT && is_below(u, v, x);
    }
    for (size_t g = 0; g < groups; g++) in[g] = on[g] || (odd[g] && !m->lines[g]), touching += on[g];
    oracle_set_free(&point);
}

/* ---------------------------------------------------------------- checking -- */

static void check_point(const map *m, const double *x) {
    const size_t groups = froe_scene_group_count(m->w.scene);
    bool in[MOST_GROUPS];
    brute_force(m, x, in);
    for (size_t t = 0; t < m->w.tree_count; t++) {
        froe_list got;
        bool found[MOST_GROUPS] = {false};
        froe_diagnostic why;
        if (froe_query_groups(m->w.queries[t], x, &got, &why)) fail_msg("%s: %s", m->w.name, why.message);
        for (size_t i = 0; i < got.count; i++) {
            assert_true(got.ids[i] < groups && (!i || got.ids[i] > got.ids[i - 1]));
            found[got.ids[i]] = true;
        }
        for (size_t g = 0; g < groups; g++)
            if (found[g] != in[g])
                fail_msg("%s, %s: group %zu is%s found at %a %a", m->w.name, froe_tree_report(m->w.trees[t]).method, g,
                         found[g] ? "" : " not", x[0], x[1]);
        members += got.count;
    }
    decisions += groups * m->w.tree_count;
}

/* A point to ask about; one of three in the middle of a segment, or nearly so. */
static void draw_point(const map *m, world_dice *d, double *x) {
    world_point(&m->w, d, x);
    const froe_object o = froe_scene_object(m->w.scene, world_below(d, (uint32_t)m->w.count + 1));
    if (world_below(d, 3) || o.corners != 2) return;
    const uint32_t i = world_below(d, (uint32_t)m->w.count);
    const double *u = froe_scene_vertex(m->w.scene, froe_scene_corner(m->w.scene, i, 0));
    const double *v = froe_scene_vertex(m->w.scene, froe_scene_corner(m->w.scene, i, 1));
    for (int k = 0; k < 2 && v; k++) x[k] = 0.5 * u[k] + 0.5 * v[k];
}

static void check_map(map m, size_t points) {
    world_dice d = {3, 0};
    for (size_t i = 0; i < points; i++) {
        double x[FROE_MAX_DIM];
        draw_point(&m, &d, x);
        if (isfinite(x[0]) && isfinite(x[1])) check_point(&m, x);
    }
    world_end(&m.w);
}

/* ------------------------------------------------------------------- scenes -- */

static uint32_t add_group(froe_scene *scene, const char *name) {
    uint32_t id;
    assert_int_equal(froe_scene_add_group(scene, &(froe_group){.name = name}, &id), FROE_OK);
    return id;
}

/* Segments between successive points; closed: and back to the first. `face` FROE_NONE: no faces. */
static void add_path(froe_scene *scene, uint32_t group, uint32_t face, const double *points, uint32_t count,
                     bool closed) {
    uint32_t faces[64], ends[128];
    froe_objects o = froe_objects_defaults();
    o.kind = FROE_SEGMENT;
    o.count = closed ? count : count - 1;
    for (uint32_t i = 0; i < o.count; i++) faces[i] = face, ends[2 * i] = i, ends[2 * i + 1] = (i + 1) % count;
    o.coords = points;
    o.point_count = count;
    o.indices = ends;
    o.faces = face == FROE_NONE ? NULL : faces;
    o.group = group;
    assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
}

/* Rings through random points, which cross themselves and each other; on a lattice they overlap, too. */
static froe_scene *random_rings(uint32_t groups, uint32_t grid, double scale, uint64_t seed) {
    world_dice d = {seed, 0};
    froe_scene *scene;
    double points[32];
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    for (uint32_t g = 0; g < groups; g++) {
        const uint32_t group = add_group(scene, "ring"), rings = 1 + world_below(&d, 3), faced = world_below(&d, 2);
        const double centre[2] = {world_unit(&d), world_unit(&d)};
        for (uint32_t r = 0; r < rings; r++) {
            const uint32_t count = 3 + world_below(&d, 6);
            for (uint32_t i = 0; i < 2 * count; i++) {
                const double x = centre[i % 2] + 0.5 * world_unit(&d);
                points[i] = (grid ? floor(x * grid) : x) * scale;
            }
            add_path(scene, group, faced ? 1000 + group : FROE_NONE, points, count, true);
        }
    }
    return scene;
}

/* The first groups of a file. */
static froe_scene *cut_out(const char *file, uint32_t groups) {
    froe_scene *whole = world_read(file), *scene;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    for (uint32_t g = 0; g < groups; g++) add_group(scene, froe_scene_group(whole, g).name);
    for (uint32_t i = 0; i < froe_scene_object_count(whole); i++) {
        const froe_object o = froe_scene_object(whole, i);
        double ends[4];
        if (o.group >= groups || o.form != FROE_SEGMENT) continue;
        for (uint32_t end = 0; end < 2; end++)
            memcpy(ends + 2 * end, froe_scene_vertex(whole, froe_scene_corner(whole, i, end)), 2 * sizeof *ends);
        add_path(scene, o.group, o.face, ends, 2, false);
    }
    froe_scene_free(whole);
    return scene;
}

static map map_of(const char *name, froe_scene *scene, bool lattice) {
    map m = {.w = world_begin(name, scene)};
    assert_true(froe_scene_group_count(scene) <= MOST_GROUPS);
    m.w.lattice = lattice;
    return m;
}

/* ------------------------------------------------------------------- cases -- */

static void countries_and_states(void **state) {
    (void)state;
    for (uint32_t g = 10; g <= 40; g += 30)
        check_map(map_of("countries", cut_out("countries-110m.json", g), false), 150 / EXACT_SHARE);
    check_map(map_of("states", cut_out("states-albers-10m.json", 4), false), 150 / EXACT_SHARE);
}

static void rings_that_overlap_and_cross(void **state) {
    (void)state;
    for (uint64_t seed = 1; seed <= 4; seed++) {
        check_map(map_of("anywhere", random_rings(30, 0, 1, seed), false), 150 / EXACT_SHARE);
        check_map(map_of("lattice", random_rings(20, 4 + (uint32_t)seed, 1, seed), true), 150 / EXACT_SHARE);
    }
    check_map(map_of("many on few points", random_rings(100, 3, 1, 9), true), 150 / EXACT_SHARE);
}

static void coordinates_of_any_size(void **state) {
    (void)state;
    check_map(map_of("huge", random_rings(8, 0, 1e300, 5), false), 60);
    check_map(map_of("largest", random_rings(8, 2, 0x1.8p1021, 6), false), 60);
    check_map(map_of("denormal", random_rings(8, 5, 0x1p-1074, 7), false), 60);
}

/* Rings of every scale: tiny areas beside huge ones, inside of them, and on their borders. */
static froe_scene *extreme_rings(uint64_t seed) {
    extreme_scene s = extreme_begin(2, (int)(seed % EXTREME_STYLES), seed);
    const int groups = fuzz_int(&s.random, 2, 6);
    for (int g = 0; g < groups; g++) {
        const uint32_t group = add_group(s.scene, "area"), face = fuzz_int(&s.random, 0, 1) ? 1000 + group : FROE_NONE;
        for (int ring = fuzz_int(&s.random, 1, 2); ring > 0; ring--) {
            double points[EXTREME_CORNERS * 2];
            const int count = fuzz_int(&s.random, 3, EXTREME_CORNERS);
            extreme_corners(&s, points, (size_t)count);
            add_path(s.scene, group, face, points, (uint32_t)count, true);
        }
    }
    return s.scene;
}

/* Areas are told from a point outside, which scenes do not have that reach as far as doubles do on all sides. */
static bool has_outside(const froe_scene *scene) {
    double lo[2], hi[2];
    froe_scene_bounds(scene, lo, hi);
    return lo[0] > -DBL_MAX || lo[1] > -DBL_MAX || hi[0] < DBL_MAX || hi[1] < DBL_MAX;
}

static void areas_at_every_scale(void **state) {
    const uint64_t first = extreme_seed(), last = first + 27 * extreme_rounds() / EXACT_SHARE;
    (void)state;
    for (uint64_t seed = first; seed < last; seed++) {
        char name[64];
        snprintf(name, sizeof name, "areas, FROE_SEED=%llu", (unsigned long long)seed);
        map m = map_of(name, extreme_rings(seed), false);
        m.w.extreme = true;
        check_map(m, has_outside(m.w.scene) ? 30 : 0);
    }
}

static void lines_and_solids_have_their_own_points_only(void **state) {
    (void)state;
    world_dice d = {11, 0};
    froe_scene *scene;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    double points[24];
    bool lines[MOST_GROUPS] = {false};
    for (uint32_t i = 0; i < 24; i++) points[i] = world_below(&d, 9);
    for (uint32_t g = 0; g < 12; g++) { /* rivers, closed lines, rivers beside a lake, boxes and balls */
        const uint32_t group = add_group(scene, "line");
        for (uint32_t i = 0; i < 24; i++) points[i] = world_below(&d, 9);
        lines[group] = g % 3 == 0;
        if (g % 3 == 1) add_path(scene, group, FROE_NONE, points, 5, true);
        if (g % 3 == 0) add_path(scene, group, FROE_NONE, points, 5, false);
        if (g % 3 == 2) add_path(scene, group, 900 + g, points, 6, true);
        froe_objects o = froe_objects_defaults();
        const double radius = 1 + world_below(&d, 2), box[4] = {points[4], points[5], points[4] + 1, points[5] + 2};
        o.count = 1, o.group = group, o.coords = box, o.kind = g % 2 ? FROE_BALL : FROE_BOX,
        o.radii = g % 2 ? &radius : NULL;
        if (g % 4) assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
    }
    const double loose[] = {0, 0, 9, 9, 3, 3, 3, 3};
    assert_int_equal(trees_add(scene, FROE_SEGMENT, 2, loose, NULL, NULL), FROE_OK);
    map m = map_of("lines and solids", scene, true);
    memcpy(m.lines, lines, sizeof lines);
    check_map(m, 800 / EXACT_SHARE);
}

static void rings_bound_areas_and_lines_of_the_same_group_do_not(void **state) {
    (void)state;
    const double ring[] = {0, 0, 4, 0, 4, 4, 0, 4}, river[] = {-3, 2, 8, 2.5, 9, 9};
    froe_scene *scene;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    const uint32_t group = add_group(scene, "lake and river");
    add_path(scene, group, 7, ring, 4, true);
    add_path(scene, group, FROE_NONE, river, 3, false);
    world w = world_begin("lake and river", scene);
    const struct {
        double x[2];
        size_t count;
    } cases[] = {{{1, 1}, 1}, {{5, 1}, 0}, {{9, 9}, 1}, {{-3, 2}, 1}, {{4, 4}, 1}, {{-3.5, 2}, 0}, {{8.5, 3}, 0}};
    for (size_t t = 0; t < w.tree_count; t++)
        for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
            froe_list got;
            assert_int_equal(froe_query_groups(w.queries[t], cases[i].x, &got, NULL), FROE_OK);
            assert_int_equal(got.count, cases[i].count);
        }
    world_end(&w);
}

static void scenes_without_groups_or_objects_have_none(void **state) {
    (void)state;
    froe_list got;
    const double x[2] = {1, 1};
    world w[] = {world_begin("none", world_mixture(2, 0, 0, 0, 1, 1)),
                 world_begin("no groups", world_mixture(2, 1u << FROE_SEGMENT, 20, 4, 1, 1))};
    for (int i = 0; i < 2; i++) {
        for (size_t t = 0; t < w[i].tree_count; t++) {
            froe_answers all;
            assert_int_equal(froe_query_groups(w[i].queries[t], x, &got, NULL), FROE_OK);
            assert_int_equal(got.count, 0);
            assert_int_equal(froe_batch_groups(w[i].queries[t], x, 1, NULL, &all, NULL), FROE_OK);
            assert_int_equal(all.starts[1], 0);
            froe_answers_free(&all);
        }
        world_end(&w[i]);
    }
    for (uint32_t seed = 0; seed < 6; seed++) check_map(map_of("one", random_rings(1, 3, 1, seed), true), 100);
}

static void rings_that_do_not_close_are_refused(void **state) {
    (void)state;
    const double ring[] = {0, 0, 4, 0, 4, 4, 0.5, 4};
    froe_scene *scene;
    froe_list got;
    froe_diagnostic why;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    add_path(scene, add_group(scene, "whole"), 1, ring, 4, true);
    add_path(scene, add_group(scene, "Atlantis"), 2, ring, 4, false);
    world w = world_begin("broken", scene);
    for (int again = 0; again < 2; again++) {
        assert_int_equal(froe_query_groups(w.queries[0], ring, &got, &why), FROE_E_UNSUPPORTED);
        assert_string_equal(
            why.message,
            "group 1 (Atlantis): It bounds no area, because an odd number of its segments ends at (0, 0).");
        assert_int_equal(why.object, 4);
    }
    world_end(&w);
}

static void bad_questions_are_refused(void **state) {
    (void)state;
    froe_list got;
    froe_answers answers;
    froe_diagnostic why;
    const double bad[] = {0, 0, 1, 1, INFINITY, 0};
    world w = world_begin("rings", random_rings(3, 5, 1, 1)),
          space = world_begin("space", world_mixture(3, 2, 3, 0, 1, 1));
    assert_int_equal(froe_query_groups(w.queries[0], bad + 4, &got, &why), FROE_E_INPUT);
    assert_string_equal(why.message, "Coordinate 0 of a point is inf, not a finite number.");
    assert_int_equal(froe_query_groups(w.queries[0], NULL, &got, NULL), FROE_E_ARG);
    assert_int_equal(froe_query_groups(NULL, bad, &got, NULL), FROE_E_ARG);
    assert_int_equal(froe_query_groups(space.queries[0], bad, &got, &why), FROE_E_UNSUPPORTED);
    assert_int_equal(froe_batch_groups(w.queries[0], bad, 3, NULL, &answers, &why), FROE_E_INPUT);
    assert_int_equal(why.object, 2);
    assert_int_equal(froe_batch_groups(space.queries[0], bad, 1, NULL, &answers, NULL), FROE_E_UNSUPPORTED);
    assert_int_equal(froe_batch_groups(w.queries[0], NULL, 1, NULL, &answers, NULL), FROE_E_ARG);
    world_end(&w), world_end(&space);
}

/* ------------------------------------------------------------- other ways -- */

enum { MANY = 600 };

static void batches_and_saved_trees_say_the_same(void **state) {
    (void)state;
    static double points[2 * MANY];
    map m = map_of("rings", random_rings(40, 9, 1, 21), true);
    world_dice d = {1, 0};
    for (size_t i = 0; i < MANY; i++) {
        double x[FROE_MAX_DIM];
        draw_point(&m, &d, x);
        memcpy(points + 2 * i, x, sizeof x[0] * 2);
    }
    for (size_t t = 0; t < m.w.tree_count; t++) {
        froe_tree *opened;
        froe_query *q, *fork;
        assert_int_equal(froe_tree_save(m.w.trees[t], "groups.froe", NULL), FROE_OK);
        assert_int_equal(froe_tree_open("groups.froe", NULL, &opened, NULL), FROE_OK);
        assert_int_equal(froe_query_new(opened, &q, NULL), FROE_OK);
        assert_int_equal(froe_query_fork(q, &fork, NULL), FROE_OK);
        for (unsigned threads = 1; threads <= 4; threads += 3) {
            froe_batch_options o = froe_batch_defaults();
            froe_answers answers;
            o.threads = threads;
            froe_query_statistics(q);
            assert_int_equal(froe_batch_groups(q, points, MANY, &o, &answers, NULL), FROE_OK);
            assert_int_equal(froe_query_statistics(q).queries, MANY);
            for (size_t i = 0; i < MANY; i++) {
                froe_list one;
                froe_query *single = i % 2 ? m.w.queries[t] : fork;
                assert_int_equal(froe_query_groups(single, points + 2 * i, &one, NULL), FROE_OK);
                assert_int_equal(answers.starts[i + 1] - answers.starts[i], one.count);
                if (one.count)
                    assert_memory_equal(answers.ids + answers.starts[i], one.ids, one.count * sizeof *one.ids);
            }
            froe_answers_free(&answers);
        }
        froe_query_free(fork), froe_query_free(q), froe_tree_free(opened);
    }
    unlink("groups.froe");
    world_end(&m.w);
}

static froe_status ask_without_memory(void *user, const froe_allocator *alloc) {
    froe_tree tree = *(const froe_tree *)user;
    froe_query *q;
    froe_list got;
    tree.alloc = *alloc;
    froe_status status = froe_query_new(&tree, &q, NULL);
    if (status) return status;
    for (int i = 0; i < 20 && !status; i++)
        status = froe_query_groups(q, (const double[]){0.3 + 0.02 * i, 0.6}, &got, NULL);
    froe_query_free(q);
    return status;
}

static void every_allocation_may_fail(void **state) {
    (void)state;
    world w = world_begin("rings", random_rings(12, 0, 1, 4));
    for (size_t t = 0; t < w.tree_count; t++) assert_true(test_memory_each(ask_without_memory, w.trees[t]) > 5);
    world_end(&w);
}

/* Most points must find their reference in their own cell, or the whole structure would be for nothing. */
static void references_lie_in_their_cells(void **state) {
    (void)state;
    map m = map_of("countries", cut_out("countries-110m.json", 40), false);
    for (size_t t = 0; t < m.w.tree_count; t++) {
        const query_areas *areas;
        uint32_t far = 0, leaves = 0;
        assert_int_equal(query_areas_of(m.w.queries[t], &areas, NULL), FROE_OK);
        for (uint32_t i = 0; i < m.w.trees[t]->node_count; i++) {
            if (!tree_is_leaf(m.w.trees[t]->nodes + i)) continue;
            leaves++;
            far += areas->slots[query_leaf_place(m.w.trees[t], i)] >= AREA_FAR;
        }
        assert_true(far <= leaves / 20);
    }
    world_end(&m.w);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(countries_and_states),
        cmocka_unit_test(rings_that_overlap_and_cross),
        cmocka_unit_test(coordinates_of_any_size),
        cmocka_unit_test(areas_at_every_scale),
        cmocka_unit_test(lines_and_solids_have_their_own_points_only),
        cmocka_unit_test(rings_bound_areas_and_lines_of_the_same_group_do_not),
        cmocka_unit_test(scenes_without_groups_or_objects_have_none),
        cmocka_unit_test(rings_that_do_not_close_are_refused),
        cmocka_unit_test(bad_questions_are_refused),
        cmocka_unit_test(batches_and_saved_trees_say_the_same),
        cmocka_unit_test(every_allocation_may_fail),
        cmocka_unit_test(references_lie_in_their_cells),
    };
    const int failed = cmocka_run_group_tests_name("query/groups", tests, NULL, NULL);
    print_message("%llu decisions, %llu members, %llu on borders\n", (unsigned long long)decisions,
                  (unsigned long long)members, (unsigned long long)touching);
    assert_true(failed || EXACT_SHARE > 1 || (decisions > DECISIONS && touching > 1000));
    return failed;
}
