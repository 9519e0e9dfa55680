/* test_questions.c: every question to every kind of tree: without memory, by exact numbers alone, on trees from files,
 * and with arguments left out. */
#include "num/ball.h"
#include "query/questions.h"
#include "support/tree_file.h"
#include <stdio.h>
#include <string.h>

enum { KINDS = 9 };

/* Rings of segments, each a group; two have a face. */
static froe_scene *rings(void) {
    static const double rings[3][5][2] = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}},
                                          {{0.2, 0.2}, {0.2, 0.8}, {0.8, 0.8}, {0.8, 0.2}, {0.2, 0.2}},
                                          {{0.3, 0.3}, {0.6, 0.25}, {0.5, 0.5}, {0.4, 0.7}, {0.3, 0.3}}};
    froe_scene *scene;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    for (int r = 0; r < 3; r++) {
        double coords[4][4];
        const froe_group group = {.name = "ring"};
        froe_objects o = froe_objects_defaults();
        assert_int_equal(froe_scene_add_group(scene, &group, &o.group), FROE_OK);
        for (int i = 0; i < 4; i++) {
            memcpy(coords[i], rings[r][i], 2 * sizeof(double));
            memcpy(coords[i] + 2, rings[r][i + 1], 2 * sizeof(double));
        }
        const uint32_t faces[4] = {(uint32_t)r, (uint32_t)r, (uint32_t)r, (uint32_t)r};
        o.kind = FROE_SEGMENT, o.count = 4, o.coords = coords[0], o.faces = r < 2 ? faces : NULL;
        assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
    }
    return scene;
}

static froe_tree *tree_of(int kind) {
    froe_tree *tree;
    froe_scene *scene;
    switch (kind) {
    case 0:
        return trees_grow(2, FROE_SEGMENT, 40, 0, 0.4, "index", 6);
    case 1:
        return trees_grow(2, FROE_SEGMENT, 30, 8, 0.4, "autopartition", 1);
    case 2:
        return trees_grow(3, FROE_POLYGON, 40, 0, 0.4, "index", 6);
    case 3:
        return trees_grow(3, FROE_POLYGON, 25, 0, 0.4, "autopartition", 1);
    case 4:
        return trees_grow(2, FROE_POINT, 40, 0, 0, "density", 3);
    case 5:
        return trees_grow(4, FROE_BOX, 20, 0, 0.4, "density", 3);
    case 6:
        return trees_grow(3, FROE_BALL, 20, 0, 0.2, "density", 3);
    case 7:
        scene = rings(), tree = trees_build(scene, "index", 2);
        break;
    default:
        scene = rings(), tree = trees_build(scene, "autopartition", 0);
        break;
    }
    froe_scene_free(scene);
    return tree;
}

/* -------------------------------------------------------------------------- memory -- */

typedef struct asking {
    const froe_tree *tree;
    int question;
    told expected;
} asking;

static froe_status ask_with(void *user, const froe_allocator *alloc) {
    asking *a = user;
    froe_tree tree = *a->tree;
    froe_query *q = NULL;
    told t = 0;
    tree.alloc = *alloc;
    froe_status status = froe_query_new(&tree, &q, NULL);
    if (status) return status;
    status = ask_question(q, a->question, &t);
    if (!status && !a->expected) a->expected = t;
    if (!status) assert_true(t == a->expected);
    froe_query_free(q);
    return status;
}

static void any_allocation_of_any_question_may_fail(void **state) {
    (void)state;
    for (int kind = 0; kind < KINDS; kind++) {
        froe_tree *tree = tree_of(kind);
        for (int question = 0; question < QUESTIONS; question++)
            if (question < QUESTIONS_PLAIN || question % 3 == kind % 3)
                assert_true(test_memory_each(ask_with, &(asking){tree, question, 0}) > 2);
        froe_tree_free(tree);
    }
}

/* -------------------------------------------------------------------------- stages -- */

/* Filters, balls and exact numbers give the same answers to every question. */
static void no_answer_depends_on_the_stage_that_decides(void **state) {
    (void)state;
    for (int kind = 0; kind < KINDS; kind++) {
        froe_tree *tree = tree_of(kind);
        for (int question = 0; question < QUESTIONS; question++) {
            told expected = 0;
            for (int stage = NUM_FILTER; stage <= NUM_EXACT; stage++) {
                froe_query *q;
                told t = 0;
                assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
                q->numbers.first = (num_stage)stage;
                assert_int_equal(ask_question(q, question, &t), FROE_OK);
                if (stage == NUM_FILTER) expected = t;
                if (t != expected && question_is_exact(question))
                    fail_msg("tree %d, question %d, stage %d", kind, question, stage);
                froe_query_free(q);
            }
        }
        froe_tree_free(tree);
    }
}

/* Marks of groups begin anew when their stamps have been used up. */
static void questions_go_on_when_stamps_end(void **state) {
    (void)state;
    froe_tree *tree = tree_of(7);
    for (int question = 0; question < QUESTIONS; question++) {
        told t[2] = {0, 0};
        for (int late = 0; late < 2; late++) {
            froe_query *q;
            assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
            for (int round = 0; round < 2; round++) {
                if (late) q->work.stamp = UINT32_MAX - (uint32_t)round;
                assert_int_equal(ask_question(q, question, &t[late]), FROE_OK);
            }
            froe_query_free(q);
        }
        assert_true(t[0] == t[1]);
    }
    froe_tree_free(tree);
}

/* --------------------------------------------------------------------- opened trees -- */

typedef struct saved {
    tree_file file;
    int question;
    told expected;
} saved;

static froe_status ask_opened(void *user, const froe_allocator *alloc) {
    const saved *b = user;
    froe_tree *tree = NULL;
    froe_query *q = NULL;
    told t = 0;
    froe_status status = froe_tree_open_memory(b->file.bytes, b->file.size, alloc, &tree, NULL);
    if (!status) status = froe_query_new(tree, &q, NULL);
    if (!status) status = ask_question(q, b->question, &t);
    if (!status) assert_true(t == b->expected);
    froe_query_free(q);
    froe_tree_free(tree);
    return status;
}

static void opened_trees_answer_alike_and_may_lack_memory(void **state) {
    (void)state;
    for (int kind = 0; kind < KINDS; kind++) {
        froe_tree *tree = tree_of(kind);
        saved b = {0};
        assert_int_equal(froe_tree_write(tree, tree_file_receive, &b.file, NULL), FROE_OK);
        for (b.question = 0; b.question < QUESTIONS_PLAIN; b.question++) {
            froe_query *q;
            assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
            b.expected = 0;
            assert_int_equal(ask_question(q, b.question, &b.expected), FROE_OK);
            froe_query_free(q);
            assert_true(test_memory_each(ask_opened, &b) > 5);
        }
        free(b.file.bytes);
        froe_tree_free(tree);
    }
}

/* ------------------------------------------------------------------------ arguments -- */

static bool stop(void *user, const froe_pair *pair) {
    (void)user, (void)pair;
    return false;
}

#define REFUSED(call)                                                                                                  \
    do {                                                                                                               \
        froe_diagnostic why = {0};                                                                                     \
        assert_int_equal(call, FROE_E_ARG);                                                                            \
        assert_true(why.message[0] != 0);                                                                              \
    } while (0)

static void every_pointer_that_a_search_needs_is_asked_for(void **state) {
    const double x[2] = {0.5, 0.5};
    const froe_range r = {.size = sizeof r, .shape = FROE_SHAPE_BALL, .points = x};
    uint32_t object;
    uint64_t number;
    froe_query *made;
    froe_list list;
    froe_query *q;
    froe_tree *tree = tree_of(7);
    (void)state;
    assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
    REFUSED(froe_query_new(NULL, &made, &why));
    REFUSED(froe_query_new(tree, NULL, &why));
    REFUSED(froe_query_fork(NULL, &made, &why));
    REFUSED(froe_query_fork(q, NULL, &why));
    REFUSED(froe_query_range(NULL, &r, &list, &why));
    REFUSED(froe_query_range(q, NULL, &list, &why));
    REFUSED(froe_query_range(q, &r, NULL, &why));
    REFUSED(froe_query_count(NULL, &r, &number, &why));
    REFUSED(froe_query_count(q, NULL, &number, &why));
    REFUSED(froe_query_count(q, &r, NULL, &why));
    REFUSED(froe_query_any(NULL, &r, &object, &why));
    REFUSED(froe_query_any(q, NULL, &object, &why));
    REFUSED(froe_query_any(q, &r, NULL, &why));
    REFUSED(froe_query_locate(NULL, x, &list, &why));
    REFUSED(froe_query_locate(q, NULL, &list, &why));
    REFUSED(froe_query_locate(q, x, NULL, &why));
    REFUSED(froe_query_groups(NULL, x, &list, &why));
    REFUSED(froe_query_groups(q, NULL, &list, &why));
    REFUSED(froe_query_groups(q, x, NULL, &why));
    REFUSED(froe_query_groups_range(NULL, &r, FROE_MEETS, &list, &why));
    REFUSED(froe_query_groups_range(q, NULL, FROE_MEETS, &list, &why));
    REFUSED(froe_query_groups_range(q, &r, FROE_MEETS, NULL, &why));
    froe_query_free(q);
    froe_tree_free(tree);
}

static void every_pointer_that_a_ray_or_a_neighbour_needs_is_asked_for(void **state) {
    const double x[2] = {0.5, 0.5};
    double nearest[2];
    uint32_t object;
    froe_hit hit;
    froe_hits hits;
    froe_hit_place place;
    froe_neighbours near;
    froe_query *q;
    froe_tree *tree = tree_of(7);
    (void)state;
    assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
    REFUSED(froe_query_ray(NULL, x, x, 1, &hit, &why));
    REFUSED(froe_query_ray(q, NULL, x, 1, &hit, &why));
    REFUSED(froe_query_ray(q, x, NULL, 1, &hit, &why));
    REFUSED(froe_query_ray(q, x, x, 1, NULL, &why));
    REFUSED(froe_query_ray_any(NULL, x, x, 1, &object, &why));
    REFUSED(froe_query_ray_any(q, NULL, x, 1, &object, &why));
    REFUSED(froe_query_ray_any(q, x, NULL, 1, &object, &why));
    REFUSED(froe_query_ray_any(q, x, x, 1, NULL, &why));
    REFUSED(froe_query_ray_all(NULL, x, x, 1, &hits, &why));
    REFUSED(froe_query_ray_all(q, NULL, x, 1, &hits, &why));
    REFUSED(froe_query_ray_all(q, x, NULL, 1, &hits, &why));
    REFUSED(froe_query_ray_all(q, x, x, 1, NULL, &why));
    REFUSED(froe_query_vertical(NULL, x, 1, &object, &why));
    REFUSED(froe_query_vertical(q, NULL, 1, &object, &why));
    REFUSED(froe_query_vertical(q, x, 1, NULL, &why));
    REFUSED(froe_query_near(NULL, x, 1, 1, &near, &why));
    REFUSED(froe_query_near(q, NULL, 1, 1, &near, &why));
    REFUSED(froe_query_near(q, x, 1, 1, NULL, &why));
    REFUSED(froe_query_nearest_point(NULL, 0, x, nearest, &why));
    REFUSED(froe_query_nearest_point(q, 0, NULL, nearest, &why));
    REFUSED(froe_query_nearest_point(q, 0, x, NULL, &why));
    REFUSED(froe_query_hit_place(NULL, 0, x, x, &place, &why));
    REFUSED(froe_query_hit_place(q, 0, NULL, x, &place, &why));
    REFUSED(froe_query_hit_place(q, 0, x, NULL, &place, &why));
    REFUSED(froe_query_hit_place(q, 0, x, x, NULL, &why));
    REFUSED(froe_query_pairs(NULL, true, stop, NULL, &why));
    REFUSED(froe_query_pairs(q, true, NULL, NULL, &why));
    froe_query_free(q);
    froe_tree_free(tree);
}

/* Arrays may be missing where there is nothing in them. */
static void every_array_that_a_batch_of_searches_needs_is_asked_for(void **state) {
    const double x[4] = {0.5, 0.5, 0.6, 0.6};
    const froe_range r = {.size = sizeof r, .shape = FROE_SHAPE_BALL, .points = x};
    uint32_t objects[1];
    uint64_t counts[1];
    froe_answers a;
    froe_query *q;
    froe_tree *tree = tree_of(7);
    (void)state;
    assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
    REFUSED(froe_batch_range(NULL, &r, 1, NULL, &a, &why));
    REFUSED(froe_batch_range(q, NULL, 1, NULL, &a, &why));
    REFUSED(froe_batch_range(q, &r, 1, NULL, NULL, &why));
    REFUSED(froe_batch_boxes(NULL, x, 1, NULL, &a, &why));
    REFUSED(froe_batch_boxes(q, NULL, 1, NULL, &a, &why));
    REFUSED(froe_batch_boxes(q, x, 1, NULL, NULL, &why));
    REFUSED(froe_batch_count(NULL, &r, 1, NULL, counts, &why));
    REFUSED(froe_batch_count(q, NULL, 1, NULL, counts, &why));
    REFUSED(froe_batch_count(q, &r, 1, NULL, NULL, &why));
    REFUSED(froe_batch_any(NULL, &r, 1, NULL, objects, &why));
    REFUSED(froe_batch_any(q, NULL, 1, NULL, objects, &why));
    REFUSED(froe_batch_any(q, &r, 1, NULL, NULL, &why));
    REFUSED(froe_batch_locate(NULL, x, 1, NULL, &a, &why));
    REFUSED(froe_batch_locate(q, NULL, 1, NULL, &a, &why));
    REFUSED(froe_batch_locate(q, x, 1, NULL, NULL, &why));
    REFUSED(froe_batch_groups(NULL, x, 1, NULL, &a, &why));
    REFUSED(froe_batch_groups(q, NULL, 1, NULL, &a, &why));
    REFUSED(froe_batch_groups(q, x, 1, NULL, NULL, &why));
    REFUSED(froe_batch_groups_range(NULL, &r, 1, FROE_MEETS, NULL, &a, &why));
    REFUSED(froe_batch_groups_range(q, NULL, 1, FROE_MEETS, NULL, &a, &why));
    REFUSED(froe_batch_groups_range(q, &r, 1, FROE_MEETS, NULL, NULL, &why));
    REFUSED(froe_batch_groups_boxes(NULL, x, 1, FROE_MEETS, NULL, &a, &why));
    REFUSED(froe_batch_groups_boxes(q, NULL, 1, FROE_MEETS, NULL, &a, &why));
    REFUSED(froe_batch_groups_boxes(q, x, 1, FROE_MEETS, NULL, NULL, &why));
    REFUSED(froe_batch_groups_join(NULL, q, FROE_MEETS, NULL, &a, &why));
    REFUSED(froe_batch_groups_join(q, NULL, FROE_MEETS, NULL, &a, &why));
    REFUSED(froe_batch_groups_join(q, q, FROE_MEETS, NULL, NULL, &why));
    assert_int_equal(froe_batch_range(q, NULL, 0, NULL, &a, NULL), FROE_OK);
    froe_answers_free(&a);
    assert_int_equal(froe_batch_count(q, NULL, 0, NULL, NULL, NULL), FROE_OK);
    assert_int_equal(froe_batch_any(q, NULL, 0, NULL, NULL, NULL), FROE_OK);
    froe_query_free(q);
    froe_tree_free(tree);
}

static void every_array_that_a_batch_of_rays_needs_is_asked_for(void **state) {
    const double x[4] = {0.5, 0.5, 0.6, 0.6};
    uint32_t objects[1];
    froe_hit hits[1];
    froe_answers a;
    froe_pairs pairs;
    froe_query *q;
    froe_tree *tree = tree_of(7);
    (void)state;
    assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
    REFUSED(froe_batch_vertical(NULL, x, 1, 1, NULL, objects, &why));
    REFUSED(froe_batch_vertical(q, NULL, 1, 1, NULL, objects, &why));
    REFUSED(froe_batch_vertical(q, x, 1, 1, NULL, NULL, &why));
    REFUSED(froe_batch_ray(NULL, x, x, 1, 1, NULL, hits, &why));
    REFUSED(froe_batch_ray(q, NULL, x, 1, 1, NULL, hits, &why));
    REFUSED(froe_batch_ray(q, x, NULL, 1, 1, NULL, hits, &why));
    REFUSED(froe_batch_ray(q, x, x, 1, 1, NULL, NULL, &why));
    REFUSED(froe_batch_ray_any(q, x, x, 1, 1, NULL, NULL, &why));
    REFUSED(froe_batch_ray_all(NULL, x, x, 1, 1, NULL, &a, &why));
    REFUSED(froe_batch_ray_all(q, NULL, x, 1, 1, NULL, &a, &why));
    REFUSED(froe_batch_ray_all(q, x, x, 1, 1, NULL, NULL, &why));
    REFUSED(froe_batch_near(NULL, x, 1, 1, 1, NULL, &a, &why));
    REFUSED(froe_batch_near(q, NULL, 1, 1, 1, NULL, &a, &why));
    REFUSED(froe_batch_near(q, x, 1, 1, 1, NULL, NULL, &why));
    REFUSED(froe_batch_pairs(NULL, true, NULL, stop, NULL, &why));
    REFUSED(froe_batch_pairs(q, true, NULL, NULL, NULL, &why));
    REFUSED(froe_batch_pair_array(NULL, true, NULL, &pairs, &why));
    REFUSED(froe_batch_pair_array(q, true, NULL, NULL, &why));
    assert_int_equal(froe_batch_ray(q, NULL, NULL, 0, 1, NULL, NULL, NULL), FROE_OK);
    froe_query_free(q);
    froe_tree_free(tree);
}

static void what_is_freed_may_be_nothing(void **state) {
    (void)state;
    froe_query_free(NULL);
    froe_answers_free(NULL);
    froe_pairs_free(NULL);
    assert_null(froe_range_shape_name(FROE_SHAPE_COUNT));
    assert_null(froe_relation_name(FROE_RELATION_COUNT));
    assert_null(froe_walk_name(FROE_WALK_COUNT));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_allocation_of_any_question_may_fail),
        cmocka_unit_test(no_answer_depends_on_the_stage_that_decides),
        cmocka_unit_test(questions_go_on_when_stamps_end),
        cmocka_unit_test(opened_trees_answer_alike_and_may_lack_memory),
        cmocka_unit_test(every_pointer_that_a_search_needs_is_asked_for),
        cmocka_unit_test(every_pointer_that_a_ray_or_a_neighbour_needs_is_asked_for),
        cmocka_unit_test(every_array_that_a_batch_of_searches_needs_is_asked_for),
        cmocka_unit_test(every_array_that_a_batch_of_rays_needs_is_asked_for),
        cmocka_unit_test(what_is_freed_may_be_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
