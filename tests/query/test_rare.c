/* test_rare.c: questions of kinds that scenes and ranges of ordinary sizes do not lead to: joins with boxes, balls and
 * objects without groups, ranges of many corners, windows without ends, and coordinates too large for units. */
#include "asked.h"
#include "query/context.h"
#include "query/groups/work.h"
#include <math.h>

static froe_query *ask_by(froe_scene *scene, const char *method, uint32_t leaf) {
    froe_query *q;
    froe_tree *tree = trees_build(scene, method, leaf);
    assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
    return q;
}

/* What was found, in ascending order. */
static size_t sorted(const froe_list *found, uint32_t *ids) {
    for (size_t i = 0; i < found->count; i++) {
        size_t j = i;
        for (; j && ids[j - 1] > found->ids[i]; j--) ids[j] = ids[j - 1];
        ids[j] = found->ids[i];
    }
    return found->count;
}

/* ---------------------------------------------------------------------------- joins -- */

static const double boxes[] = {1, 1, 2, 2, -1, -1, 6, 6, 0, 0, 4, 4, 3, 3, 3, 3}, centres[] = {2, 2, 0, 4};
static const double radii[] = {0.25, 10};

/* Each group of the other tree is one box or ball: the join says what single questions say. */
static void joins_with_boxes_and_balls_are_single_questions(void **state) {
    (void)state;
    froe_scene *scene = areas(), *other;
    assert_int_equal(froe_scene_new(2, NULL, &other), FROE_OK);
    for (size_t i = 0; i < 4; i++) add_to(other, add_group(other), FROE_BOX, 1, boxes + 4 * i, NULL);
    for (size_t i = 0; i < 2; i++) add_to(other, add_group(other), FROE_BALL, 1, centres + 2 * i, radii + i);
    add_to(other, FROE_NONE, FROE_BOX, 1, boxes, NULL);
    froe_query *q[] = {ask_by(scene, "index", 4), ask_by(scene, "autopartition", 1)},
               *asked = ask_by(other, "density", 2);
    size_t found = 0;
    for (size_t t = 0; t < 2; t++)
        for (froe_relation r = 0; r < FROE_RELATION_COUNT; r++) {
            froe_answers join;
            const froe_status status = froe_batch_groups_join(q[t], asked, r, NULL, &join, NULL);
            assert_int_equal(status, r == FROE_MEETS ? FROE_OK : FROE_E_UNSUPPORTED); /* solids are met only */
            if (status) continue;
            assert_int_equal(join.queries, 6);
            for (size_t i = 0; i < 6; i++) {
                froe_list one;
                froe_range range = froe_range_defaults();
                range.shape = i < 4 ? FROE_SHAPE_BOX : FROE_SHAPE_BALL;
                range.points = i < 4 ? boxes + 4 * i : centres + 2 * (i - 4);
                range.radius = i < 4 ? 0 : radii[i - 4];
                assert_int_equal(froe_query_groups_range(q[t], &range, r, &one, NULL), FROE_OK);
                assert_int_equal(join.starts[i + 1] - join.starts[i], one.count);
                if (one.count) assert_memory_equal(join.ids + join.starts[i], one.ids, one.count * sizeof *one.ids);
                found += one.count;
            }
            froe_answers_free(&join);
        }
    assert_true(found > 10);
    for (size_t t = 0; t < 2; t++) end_query(q[t]);
    end_query(asked);
    froe_scene_free(scene), froe_scene_free(other);
}

/* Nothing is asked, or of nothing. */
static void joins_of_nothing_are_empty(void **state) {
    (void)state;
    froe_scene *scene = areas(), *none, *loose;
    assert_int_equal(froe_scene_new(2, NULL, &none), FROE_OK);
    assert_int_equal(froe_scene_new(2, NULL, &loose), FROE_OK);
    add_to(loose, FROE_NONE, FROE_SEGMENT, 1, boxes, NULL);
    froe_query *q[] = {ask_by(scene, "index", 4), ask_by(none, "index", 4), ask_by(loose, "index", 4)};
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++)
            for (froe_relation r = 0; r < FROE_RELATION_COUNT && (a || b); r++) {
                froe_answers join;
                assert_int_equal(froe_batch_groups_join(q[a], q[b], r, NULL, &join, NULL), FROE_OK);
                assert_int_equal(join.queries, b ? 0 : 4);
                assert_int_equal(join.starts[join.queries], 0);
                froe_answers_free(&join);
            }
    for (int i = 0; i < 3; i++) end_query(q[i]);
    froe_scene_free(scene), froe_scene_free(none), froe_scene_free(loose);
}

/* --------------------------------------------------------------------------- windows -- */

static void check_windows(bool round) {
    static const double ends[] = {-INFINITY, -9, 0, 2, 4, 9, INFINITY};
    enum { ENDS = sizeof ends / sizeof *ends };
    froe_scene *scene = areas();
    if (round) add_to(scene, add_group(scene), FROE_BALL, 1, (const double[]){2, 3.5}, (const double[]){0.25});
    froe_query *q[] = {ask_by(scene, round ? "density" : "index", 4),
                       ask_by(scene, round ? "density" : "autopartition", 1)};
    for (size_t i = 0; i < ENDS * ENDS * ENDS * ENDS; i++) {
        const size_t at[4] = {i % ENDS, i / ENDS % ENDS, i / ENDS / ENDS % ENDS, i / ENDS / ENDS / ENDS};
        double window[2][4];
        if (at[0] > at[2] || at[1] > at[3]) continue;
        for (int k = 0; k < 4; k++) {
            window[0][k] = ends[at[k]];
            window[1][k] = fmax(-9, fmin(9, ends[at[k]]));
        }
        if (window[0][0] == INFINITY || window[0][1] == INFINITY || window[0][2] == -INFINITY ||
            window[0][3] == -INFINITY)
            continue;
        for (size_t t = 0; t < 2; t++)
            for (froe_relation r = FROE_MEETS; r <= FROE_WITHIN; r++) {
                froe_list got;
                uint32_t ids[4];
                size_t count = 0;
                for (int finite = 0; finite < 2; finite++) {
                    froe_range range = froe_range_defaults();
                    range.points = window[finite];
                    assert_int_equal(froe_query_groups_range(q[t], &range, r, &got, NULL), FROE_OK);
                    assert_true(got.count <= 4);
                    if (finite) assert_int_equal(count, got.count);
                    if (finite && count) assert_memory_equal(ids, got.ids, count * sizeof *ids);
                    count = got.count;
                    if (count) memcpy(ids, got.ids, count * sizeof *ids);
                }
            }
    }
    for (size_t t = 0; t < 2; t++) end_query(q[t]);
    froe_scene_free(scene);
}

static void windows_without_ends_hold_what_large_ones_hold(void **state) {
    (void)state;
    check_windows(false);
    check_windows(true); /* with a ball */
}

/* ---------------------------------------------------------------------------- memory */

/* Squares one in the other, each a group, around a point. */
static froe_scene *nested(uint32_t count, double half) {
    froe_scene *scene;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    for (uint32_t g = 0; g < count; g++) {
        const double r = count == 1 ? half : half * (g + 1);
        const double c[] = {-r, -r, r, -r, r, -r, r, r, r, r, -r, r, -r, r, -r, -r};
        add_to(scene, add_group(scene), FROE_SEGMENT, 4, c, NULL);
    }
    return scene;
}

enum { NESTED = 80 };

static froe_status ask_of_many(void *user, const froe_allocator *alloc) {
    froe_tree tree = *(const froe_tree *)user;
    static const double points[] = {-0.5, -0.5, 0.5, 0.5, -0.25, 0.5}, all[] = {-99, -99, 99, 99};
    froe_query *q;
    tree.alloc = *alloc;
    froe_status status = froe_query_new(&tree, &q, NULL);
    if (status) return status;
    for (int which = 0; which < 5 && !status; which++) {
        froe_list got = {NULL, NESTED};
        froe_answers join = {NULL, NULL, NULL, 0, *alloc};
        froe_range range = froe_range_defaults();
        range.shape = which < 2 ? FROE_SHAPE_BOX : FROE_SHAPE_SIMPLEX, range.points = which < 2 ? all : points;
        if (which == 0) status = froe_query_groups_range(q, &range, FROE_WITHIN, &got, NULL);
        if (which == 1) status = froe_query_groups_range(q, &range, FROE_MEETS, &got, NULL);
        if (which == 2) status = froe_query_groups_range(q, &range, FROE_COVERS, &got, NULL);
        if (which == 3) status = froe_query_groups(q, points, &got, NULL);
        if (which == 4) status = froe_batch_groups_join(q, q, FROE_WITHIN, NULL, &join, NULL);
        if (!status) assert_int_equal(got.count, NESTED);
        if (!status && which == 4) assert_int_equal(join.starts[NESTED], NESTED * (NESTED + 1) / 2);
        if (!status && which == 4) froe_answers_free(&join);
    }
    froe_query_free(q);
    return status;
}

static void questions_with_many_groups_as_answers_may_lack_memory(void **state) {
    (void)state;
    static const char *methods[] = {"index", "autopartition"};
    froe_scene *scene = nested(NESTED, 1);
    for (size_t m = 0; m < 2; m++) {
        froe_tree *tree = trees_build(scene, methods[m], 4);
        assert_true(test_memory_each(ask_of_many, tree) > 20);
        froe_tree_free(tree);
    }
    froe_scene_free(scene);
}

/* Which groups a point lies in is found out from outside of everything, which has to be a place. */
static void nothing_is_outside_of_a_scene_of_all_doubles(void **state) {
    (void)state;
    static const double x[2] = {0, 0};
    for (int full = 0; full < 2; full++) {
        froe_scene *scene = nested(1, full ? 0x1.fffffffffffffp1023 : 0x1p1023);
        froe_query *q = ask_by(scene, "autopartition", 1);
        froe_list got;
        froe_diagnostic why = {0};
        assert_int_equal(froe_query_groups(q, x, &got, &why), full ? FROE_E_UNSUPPORTED : FROE_OK);
        if (full) assert_non_null(strstr(why.message, "Nothing is outside"));
        if (!full) assert_int_equal(got.count, 1);
        end_query(q);
        froe_scene_free(scene);
    }
}

/* ---------------------------------------------------------------------------- ranges -- */

/* A hull of very many points is that of its four corners. */
static void hulls_of_many_points_find_what_their_corners_find(void **state) {
    (void)state;
    enum { MANY = 700 };
    static double points[3 * MANY];
    for (int dim = 2; dim <= 3; dim++) {
        froe_scene *scene = trees_scene(dim, dim == 2 ? FROE_SEGMENT : FROE_POLYGON, 200, 0, 0.2, 3);
        const char *methods[] = {"index", "autopartition"};
        for (size_t i = 0; i < MANY; i++)
            for (int k = 0; k < dim; k++)
                points[i * (size_t)dim + (size_t)k] =
                    i < 8 ? (i >> k & 1 ? 0.7 : 0.2) : 0.2 + 0.5 * trees_unit(9, 3 * i + (size_t)k);
        for (size_t m = 0; m < 2; m++) {
            froe_query *q = ask_by(scene, methods[m], 4);
            uint32_t few[200] = {0}, again[200] = {0};
            size_t count = 0;
            for (size_t n = 8; n <= MANY; n += n < 80 ? 18 : 155)
                for (int near = 0; near < 2; near++) {
                    froe_list got;
                    froe_range range = froe_range_defaults();
                    range.shape = FROE_SHAPE_HULL, range.points = points, range.count = n, range.eps = near ? 1e-9 : 0;
                    assert_int_equal(froe_query_range(q, &range, &got, NULL), FROE_OK);
                    if (n == 8 && !near) count = sorted(&got, few);
                    assert_int_equal(sorted(&got, again), count);
                    assert_memory_equal(again, few, count * sizeof *few);
                }
            assert_true(count > 20);
            end_query(q);
        }
        froe_scene_free(scene);
    }
}

static void wrong_ranges_are_refused(void **state) {
    (void)state;
    froe_scene *scene = areas(), *none;
    assert_int_equal(froe_scene_new(2, NULL, &none), FROE_OK);
    froe_query *q = ask_by(scene, "index", 4), *of_none = ask_by(none, "index", 4);
    froe_range r = froe_range_defaults();
    froe_list got;
    const double x[8] = {1, 0, -1, 0, 0, 1, 0, -1}, offsets[4] = {0, -1, 1, 1}, square[4] = {1, 1, 1, 1};
    r.points = x;
    r.eps = INFINITY;
    assert_int_equal(froe_query_range(q, &r, &got, NULL), FROE_E_INPUT);
    r.eps = -1;
    assert_int_equal(froe_query_range(q, &r, &got, NULL), FROE_E_INPUT);
    r.eps = 0;
    r.shape = FROE_SHAPE_HALFSPACES, r.count = 2;
    assert_int_equal(froe_query_range(q, &r, &got, NULL), FROE_E_ARG); /* no offsets */
    r.shape = FROE_SHAPE_HULL, r.count = (size_t)UINT32_MAX / 8 + 1;
    assert_int_equal(froe_query_range(q, &r, &got, NULL), FROE_E_ARG);
    assert_null(froe_range_shape_name((froe_range_shape)-1));
    r.shape = FROE_SHAPE_HALFSPACES, r.count = 2, r.offsets = offsets, r.eps = 0.1; /* x <= 0, x >= 1: empty */
    assert_int_equal(froe_query_range(q, &r, &got, NULL), FROE_OK);
    assert_int_equal(got.count, 0);
    r.count = 1; /* a half-plane has no diameter */
    assert_int_equal(froe_query_range(q, &r, &got, NULL), FROE_E_INPUT);
    r.count = 4, r.offsets = square;
    assert_int_equal(froe_query_range(of_none, &r, &got, NULL), FROE_OK);
    assert_int_equal(got.count, 0);
    end_query(q), end_query(of_none);
    froe_scene_free(scene), froe_scene_free(none);
}

static void missing_arguments_of_rays_are_refused(void **state) {
    const double x[2] = {0.3, -2}, up[2] = {0, 1};
    uint32_t object = 7;
    froe_hit hit;
    (void)state;
    froe_scene *scene = areas();
    froe_query *q = ask_by(scene, "autopartition", 4);
    for (int missing = 0; missing < 4; missing++) {
        froe_query *const on = missing == 0 ? NULL : q;
        const double *from = missing == 1 ? NULL : x, *to = missing == 2 ? NULL : up;
        froe_diagnostic why = {0};
        assert_int_equal(froe_query_ray(on, from, to, 9, missing == 3 ? NULL : &hit, &why), FROE_E_ARG);
        assert_int_equal(froe_query_ray_any(on, from, to, 9, missing == 3 ? NULL : &object, &why), FROE_E_ARG);
        if (missing != 2)
            assert_int_equal(froe_query_vertical(on, from, 1, missing == 3 ? NULL : &object, &why), FROE_E_ARG);
        assert_true(why.message[0] != 0 && object == 7);
    }
    assert_int_equal(froe_query_vertical(q, x, 1, &object, NULL), FROE_OK);
    assert_int_equal(object, 0); /* the lower side of the square */
    end_query(q);
    froe_scene_free(scene);
}

/* ----------------------------------------------------------------------------- scale -- */

/* Powers of 2 change no answer: with them blocks of space have no units, and areas no numbers to compare. */
static void answers_are_the_same_at_any_scale(void **state) {
    (void)state;
    for (int dim = 2; dim <= 3; dim++) {
        froe_scene *scene = trees_scene(dim, dim == 2 ? FROE_SEGMENT : FROE_POLYGON, 120, 0, 0.3, 5);
        const size_t d = (size_t)dim, corners = scene->corner_count;
        double *coords = malloc(corners * d * sizeof *coords);
        assert_non_null(coords);
        froe_query *q[5];
        static const int powers[5] = {0, 700, 1000, -700, -1000};
        for (int p = 0; p < 5; p++) {
            froe_scene *scaled;
            assert_int_equal(froe_scene_new(dim, NULL, &scaled), FROE_OK);
            for (size_t c = 0; c < corners; c++)
                for (size_t k = 0; k < d; k++)
                    coords[c * d + k] =
                        ldexp(scene_vertex(scene, scene_corner_vertex(scene, (uint32_t)c))[k], powers[p]);
            assert_int_equal(trees_add(scaled, dim == 2 ? FROE_SEGMENT : FROE_POLYGON, 120, coords, NULL, NULL),
                             FROE_OK);
            q[p] = ask_by(scaled, "index", 6);
            froe_scene_free(scaled);
        }
        for (uint64_t i = 0; i < 60; i++) {
            uint32_t ids[120] = {0}, again[120] = {0}, nearest = 0, hit = 0;
            size_t count = 0;
            for (int p = 0; p < 5; p++) {
                double x[3], way[3], box[6];
                froe_list got;
                froe_neighbours near;
                froe_hit first;
                froe_range range = froe_range_defaults();
                for (size_t k = 0; k < d; k++) {
                    x[k] = ldexp(trees_unit(11, 9 * i + k), powers[p]);
                    way[k] = ldexp(trees_unit(11, 9 * i + 3 + k) - 0.5, powers[p]);
                    box[k] = x[k], box[d + k] = x[k] + ldexp(0.2, powers[p]);
                }
                range.points = box;
                assert_int_equal(froe_query_range(q[p], &range, &got, NULL), FROE_OK);
                assert_int_equal(froe_query_near(q[p], x, 1, INFINITY, &near, NULL), FROE_OK);
                assert_int_equal(froe_query_ray(q[p], x, way, INFINITY, &first, NULL), FROE_OK);
                if (!p) count = sorted(&got, ids), nearest = near.items[0].object, hit = first.object;
                assert_int_equal(sorted(&got, again), count);
                assert_memory_equal(again, ids, count * sizeof *ids);
                assert_int_equal(near.items[0].object, nearest);
                assert_int_equal(first.object, hit);
            }
        }
        for (int p = 0; p < 5; p++) end_query(q[p]);
        free(coords);
        froe_scene_free(scene);
    }
}

/* A context counts its calls by 32 bits. When they come round, no tally may have a stamp of a call to come. */
static void counts_of_groups_are_forgotten_when_calls_come_round(void **state) {
    (void)state;
    test_memory m;
    const froe_allocator alloc = test_memory_begin(&m);
    query_groups_work w = {.stamp = 0};
    assert_true(query_groups_begin(&w, &alloc, 2));
    assert_int_equal(query_groups_count(&w, 1), 1);
    assert_int_equal(query_groups_count(&w, 1), 2);
    w.stamp = UINT32_MAX;
    assert_true(query_groups_begin(&w, &alloc, 2));
    for (uint32_t group = 0; group < 2; group++) assert_int_equal(w.tallies[group].stamp, 0);
    assert_int_equal(query_groups_count(&w, 1), 1);
    query_groups_work_free(&w, &alloc);
    test_memory_end(&m);
}

/* A context numbers its queries by 32 bits, too. No object may be taken for one that an earlier query has looked at. */
static void marks_are_forgotten_when_queries_come_round(void **state) {
    static const uint32_t objects[] = {5, 7, 999};
    (void)state;
    test_memory m;
    const froe_allocator alloc = test_memory_begin(&m);
    for (int many = 0; many < 2; many++) {
        query_marks marks = {.query = 0};
        for (int turn = 0; turn < 2; turn++) {
            query_marks_clear(&marks);
            assert_int_equal(marks.query, 1);
            if (many) assert_true(query_marks_spread(&marks, &alloc, 1000));
            for (int i = 0; i < 3; i++) assert_true(query_mark(&marks, objects[i]));
            for (int i = 0; i < 3; i++) assert_false(query_mark(&marks, objects[i]));
            marks.query = UINT32_MAX;
        }
        query_marks_free(&marks, &alloc);
    }
    test_memory_end(&m);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(joins_with_boxes_and_balls_are_single_questions),
        cmocka_unit_test(joins_of_nothing_are_empty),
        cmocka_unit_test(windows_without_ends_hold_what_large_ones_hold),
        cmocka_unit_test(questions_with_many_groups_as_answers_may_lack_memory),
        cmocka_unit_test(nothing_is_outside_of_a_scene_of_all_doubles),
        cmocka_unit_test(hulls_of_many_points_find_what_their_corners_find),
        cmocka_unit_test(wrong_ranges_are_refused),
        cmocka_unit_test(missing_arguments_of_rays_are_refused),
        cmocka_unit_test(answers_are_the_same_at_any_scale),
        cmocka_unit_test(counts_of_groups_are_forgotten_when_calls_come_round),
        cmocka_unit_test(marks_are_forgotten_when_queries_come_round),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
