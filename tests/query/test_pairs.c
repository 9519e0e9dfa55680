/* Which objects meet, and how, against brute force in whole numbers: every builder. And the same questions asked in
 * batches. */
#include "geom/meet/contact.h"
#include "query/context.h"
#include "query/pairs/pair_lists.h"
#include "query/tours.h"

static uint64_t decisions, counts[GEOM_CONTACTS], corners;

typedef struct pair {
    uint32_t a, b;
    int kind;
    bool corner;
} pair;

static bool boxes_meet(const froe_scene *s, uint32_t a, uint32_t b) {
    double lo[2][FROE_MAX_DIM], hi[2][FROE_MAX_DIM];
    scene_object_bounds(s, a, lo[0], hi[0]);
    scene_object_bounds(s, b, lo[1], hi[1]);
    for (int k = 0; k < s->dim; k++)
        if (lo[0][k] > hi[1][k] || lo[1][k] > hi[0][k]) return false;
    return true;
}

static size_t brute_force(const world *w, const exact_body *bodies, pair *out) {
    size_t count = 0;
    for (uint32_t a = 0; a < w->count; a++)
        for (uint32_t b = a + 1; b < w->count; b++) {
            pair p = {a, b, 0, false};
            decisions += w->tree_count;
            const size_t mark = exact_mark();
            if (boxes_meet(w->scene, a, b)) p.kind = exact_contact(&bodies[a], &bodies[b], &p.corner);
            exact_release(mark);
            counts[p.kind]++;
            corners += p.corner;
            if (p.kind) out[count++] = p;
        }
    return count;
}

typedef struct reader {
    const pair *next, *end;
    bool shared;
    const char *world;
} reader;

static bool read_pair(void *user, const froe_pair *p) {
    static const int kinds[] = {[FROE_MEET_CROSS] = 1, [FROE_MEET_TOUCH] = 2, [FROE_MEET_OVERLAP] = 3};
    reader *r = user;
    while (!r->shared && r->next < r->end && r->next->corner) r->next++;
    assert_true(r->next < r->end);
    if (p->a != r->next->a || p->b != r->next->b || kinds[p->kind] != r->next->kind)
        fail_msg("%s: pair %u %u kind %d, not %u %u kind %d", r->world, p->a, p->b, kinds[p->kind], r->next->a,
                 r->next->b, r->next->kind);
    r->next++;
    return true;
}

static bool stop_at_once(void *user, const froe_pair *p) {
    (void)p;
    ++*(int *)user;
    return false;
}

/** All pairs at once: there is nothing to ask more than once. */
static void check_world(world w, int questions) {
    (void)questions;
    const size_t room = w.count * w.count / 2 + 1;
    pair *expected = calloc(room, sizeof *expected);
    exact_body *bodies = calloc(w.count + 1, sizeof *bodies);
    exact_world_begin(&w, exact_world_shift(&w), bodies);
    const size_t count = brute_force(&w, bodies, expected);
    for (size_t t = 0; t < w.tree_count; t++) {
        for (int shared = 0; shared < 2; shared++) {
            reader r = {expected, expected + count, shared, w.name};
            assert_int_equal(froe_query_pairs(w.queries[t], shared, read_pair, &r, NULL), FROE_OK);
            while (!r.shared && r.next < r.end && r.next->corner) r.next++;
            assert_true(r.next == r.end);
        }
        int calls = 0;
        assert_int_equal(froe_query_pairs(w.queries[t], true, stop_at_once, &calls, NULL), FROE_OK);
        assert_int_equal(calls, count > 0);
    }
    free(bodies);
    free(expected);
    world_end(&w);
}

static void pairs_in_generated_scenes(void **state) {
    (void)state;
    for (size_t g = 0; froe_generator_at(g); g++) {
        const char *name = froe_generator_at(g)->name;
        const bool slow = strstr(name, "huge") || strstr(name, "denormal") || strstr(name, "star");
        if (!tour_knows(froe_generator_at(g))) continue;
        check_world(world_begin(name, world_generate(name, slow ? 20 : EXACT_SHARE > 1 ? 24 : 56)), 0);
    }
}

static void pairs_of_all_kinds_on_lattices_and_off(void **state) {
    (void)state;
    tour_mixtures(check_world, 4, 0);
}

static void pairs_in_real_scenes(void **state) {
    (void)state;
    static const char *const files[] = {"freedoom-e1m1.geojson", "fzk-haus-boxes.csv"};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++)
        check_world(world_begin(files[i], world_read(files[i])), 0);
}

static void pairs_at_every_scale(void **state) {
    (void)state;
    tour_extremes(check_world, 80, 0);
}

static void pairs_in_scenes_of_one_object_or_none(void **state) {
    (void)state;
    check_world(world_begin("none", world_mixture(2, 0, 0, 0, 1, 1)), 0);
    check_world(world_begin("one", world_mixture(3, 1u << FROE_BALL, 1, 0, 1, 1)), 0);
}

static bool count_pair(void *user, const froe_pair *p) {
    (void)p;
    ++*(size_t *)user;
    return true;
}

static froe_status ask_without_memory(void *user, const froe_allocator *alloc) {
    froe_tree tree = *(const froe_tree *)user;
    froe_query *q;
    size_t count = 0;
    tree.alloc = *alloc;
    froe_status status = froe_query_new(&tree, &q, NULL);
    if (status) return status;
    status = froe_query_pairs(q, true, count_pair, &count, NULL);
    if (!status) assert_true(count > 20);
    froe_query_free(q);
    return status;
}

static void every_allocation_may_fail(void **state) {
    (void)state;
    froe_tree *tree = trees_grow(3, FROE_POLYGON, 30, 0, 0.9, "density", 1);
    assert_true(test_memory_each(ask_without_memory, tree) > 5);
    froe_tree_free(tree);
    assert_int_equal(froe_query_pairs(NULL, true, count_pair, NULL, NULL), FROE_E_ARG);
}

/* ----------------------------------------------------------------- batches -- */

enum { QUERIES = 1500, K = 3 };

static double origins[2 * QUERIES], directions[2 * QUERIES];

static void draw_batch(void) {
    world_dice d = {9, 0};
    for (int i = 0; i < 2 * QUERIES; i++) origins[i] = world_unit(&d), directions[i] = world_unit(&d) - 0.5;
}

static void check_batch(froe_query *q, unsigned threads) {
    static froe_hit hits[QUERIES];
    static uint32_t above[QUERIES], any[QUERIES];
    froe_batch_options o = froe_batch_defaults();
    froe_answers near, all;
    o.threads = threads;
    assert_int_equal(froe_batch_ray_any(q, origins, directions, QUERIES, 2, &o, any, NULL), FROE_OK);
    assert_int_equal(froe_batch_ray_all(q, origins, directions, QUERIES, 2, &o, &all, NULL), FROE_OK);
    assert_int_equal(froe_batch_ray(q, origins, directions, QUERIES, 2, &o, hits, NULL), FROE_OK);
    assert_int_equal(froe_batch_vertical(q, origins, QUERIES, 1, &o, above, NULL), FROE_OK);
    assert_int_equal(froe_batch_near(q, origins, QUERIES, K, 0.2, &o, &near, NULL), FROE_OK);
    assert_int_equal(near.queries, QUERIES);
    for (size_t i = 0; i < QUERIES; i++) {
        const double *x = origins + 2 * i;
        froe_hit hit;
        uint32_t object;
        froe_neighbours items;
        assert_int_equal(froe_query_ray(q, x, directions + 2 * i, 2, &hit, NULL), FROE_OK);
        assert_true(hit.object == hits[i].object && (hit.object == FROE_NONE || hit.t == hits[i].t));
        assert_int_equal(froe_query_vertical(q, x, 1, &object, NULL), FROE_OK);
        assert_int_equal(object, above[i]);
        assert_int_equal(froe_query_ray_any(q, x, directions + 2 * i, 2, &object, NULL), FROE_OK);
        assert_int_equal(object, any[i]);
        froe_hits hits_all;
        assert_int_equal(froe_query_ray_all(q, x, directions + 2 * i, 2, &hits_all, NULL), FROE_OK);
        assert_int_equal(hits_all.count, all.starts[i + 1] - all.starts[i]);
        for (size_t n = 0; n < hits_all.count; n++) {
            assert_int_equal(hits_all.hits[n].object, all.ids[all.starts[i] + n]);
            assert_true(hits_all.hits[n].t == all.values[all.starts[i] + n]);
        }
        assert_int_equal(froe_query_near(q, x, K, 0.2, &items, NULL), FROE_OK);
        assert_int_equal(items.count, near.starts[i + 1] - near.starts[i]);
        for (size_t n = 0; n < items.count; n++) {
            assert_int_equal(items.items[n].object, near.ids[near.starts[i] + n]);
            assert_true(items.items[n].distance == near.values[near.starts[i] + n]);
        }
    }
    froe_answers_free(&near);
    froe_answers_free(&all);
}

static void batches_answer_as_single_questions_do(void **state) {
    (void)state;
    froe_tree *tree = trees_grow(2, FROE_SEGMENT, 200, 0, 0.2, "density", 1);
    froe_query *q;
    draw_batch();
    assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
    check_batch(q, 1);
    check_batch(q, 3);
    froe_query_free(q);
    froe_tree_free(tree);
}

/* Pairs as they were told. */
typedef struct told {
    froe_pair pairs[20000];
    size_t count, most;
} told;

static bool remember(void *user, const froe_pair *met) {
    told *t = user;
    assert_true(t->count < sizeof t->pairs / sizeof *t->pairs);
    t->pairs[t->count++] = *met;
    return t->count < t->most;
}

static void pairs_are_told_in_order_with_any_number_of_threads(void **state) {
    (void)state;
    static told one, many;
    for (int dim = 2; dim <= 3; dim++) {
        froe_tree *tree =
            trees_grow(dim, dim == 2 ? FROE_SEGMENT : FROE_POLYGON, 1500, 0, dim == 2 ? 0.1 : 0.3, "density", 1);
        froe_query *q;
        froe_batch_options o = froe_batch_defaults(), raw = {0};
        froe_diagnostic why;
        one.count = 0, one.most = SIZE_MAX;
        assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
        assert_int_equal(froe_query_pairs(q, true, remember, &one, NULL), FROE_OK);
        assert_true(one.count > 1000);
        for (o.threads = 1; o.threads <= 5; o.threads += 2) {
            many.count = 0, many.most = SIZE_MAX;
            assert_int_equal(froe_batch_pairs(q, true, &o, remember, &many, NULL), FROE_OK);
            assert_int_equal(many.count, one.count);
            assert_memory_equal(many.pairs, one.pairs, one.count * sizeof *one.pairs);
            many.count = 0, many.most = 77;
            assert_int_equal(froe_batch_pairs(q, true, &o, remember, &many, NULL), FROE_OK);
            assert_int_equal(many.count, 77);
        }
        assert_int_equal(froe_batch_pairs(q, true, &raw, remember, &many, &why), FROE_E_OPTIONS);
        assert_int_equal(froe_batch_pairs(q, true, NULL, NULL, NULL, &why), FROE_E_ARG);
        froe_query_free(q);
        froe_tree_free(tree);
    }
}

static void the_first_bad_question_of_a_batch_is_named(void **state) {
    (void)state;
    froe_tree *tree = trees_grow(2, FROE_SEGMENT, 50, 0, 0.2, "density", 1);
    froe_query *q;
    froe_diagnostic why;
    froe_answers near;
    static froe_hit hits[QUERIES];
    static uint32_t above[QUERIES];
    draw_batch();
    origins[2 * 700 + 1] = NAN;
    origins[2 * 1200] = INFINITY;
    assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
    assert_int_equal(froe_batch_ray(q, origins, directions, QUERIES, 1, NULL, hits, &why), FROE_E_INPUT);
    assert_int_equal(why.object, 700);
    assert_string_equal(why.message, "Coordinate 1 of the origin of a ray is nan, not a finite number.");
    assert_int_equal(froe_batch_near(q, origins, QUERIES, 1, 1, NULL, &near, &why), FROE_E_INPUT);
    assert_int_equal(why.object, 700);
    assert_int_equal(froe_batch_vertical(q, origins, QUERIES, -1, NULL, above, &why), FROE_E_INPUT);
    assert_int_equal(why.object, 700);
    assert_int_equal(froe_batch_vertical(q, NULL, 1, 1, NULL, above, &why), FROE_E_ARG);
    assert_int_equal(froe_batch_ray(q, origins, NULL, 1, 1, NULL, hits, &why), FROE_E_ARG);
    assert_int_equal(froe_batch_near(q, origins, 0, 1, 1, NULL, &near, NULL), FROE_OK);
    froe_answers_free(&near);
    froe_query_free(q);
    froe_tree_free(tree);
}

static froe_status batch_without_memory(void *user, const froe_allocator *alloc) {
    froe_tree tree = *(const froe_tree *)user;
    froe_query *q;
    froe_answers near;
    froe_hit hits[20];
    froe_batch_options o = froe_batch_defaults();
    o.threads = 1;
    tree.alloc = *alloc;
    froe_status status = froe_query_new(&tree, &q, NULL);
    if (status) return status;
    status = froe_batch_ray(q, origins, directions, 20, 2, &o, hits, NULL);
    if (!status) status = froe_batch_near(q, origins, 20, K, 1, &o, &near, NULL);
    if (!status) froe_answers_free(&near);
    if (!status) status = froe_batch_ray_all(q, origins, directions, 20, 2, &o, &near, NULL);
    if (!status) froe_answers_free(&near);
    static told all;
    all.count = 0, all.most = SIZE_MAX;
    o.threads = 2;
    if (!status) status = froe_batch_pairs(q, true, &o, remember, &all, NULL);
    froe_query_free(q);
    return status;
}

static void every_allocation_of_a_batch_may_fail(void **state) {
    (void)state;
    froe_tree *tree = trees_grow(2, FROE_SEGMENT, 50, 0, 0.2, "density", 1);
    draw_batch();
    assert_true(test_memory_each(batch_without_memory, tree) > 5);
    froe_tree_free(tree);
}

/* 16 for each object and 2^20 more, but less than 2^32: their places are numbers of 32 bits. */
static void no_more_pairs_are_gathered_than_lists_have_room_for(void **state) {
    static const struct {
        uint32_t objects, most;
    } cases[] = {{0, 1 << 20},
                 {1, 16 + (1 << 20)},
                 {(1 << 28) - (1 << 16) - 1, UINT32_MAX - 15},
                 {(1 << 28) - (1 << 16), UINT32_MAX},
                 {1 << 30, UINT32_MAX}};
    test_memory m;
    const froe_allocator alloc = test_memory_begin(&m);
    pair_lists lists;
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        assert_int_equal(pair_lists_take(&lists, &alloc, cases[i].objects, 2), FROE_OK);
        assert_int_equal(atomic_load(&lists.left), cases[i].most);
        pair_lists_give(&lists);
    }
    assert_int_equal(pair_lists_take(&lists, &alloc, 9, 2), FROE_OK);
    for (uint32_t i = 0; i < 9 * 16 + (1 << 20); i++)
        assert_int_equal(pair_lists_add(&lists, 1, i % 8, 8, FROE_MEET_CROSS), FROE_OK);
    assert_int_equal(pair_lists_add(&lists, 1, 0, 8, FROE_MEET_CROSS), FROE_E_LIMIT);
    pair_lists_give(&lists);
    test_memory_end(&m);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pairs_in_generated_scenes),
        cmocka_unit_test(pairs_of_all_kinds_on_lattices_and_off),
        cmocka_unit_test(pairs_in_real_scenes),
        cmocka_unit_test(pairs_at_every_scale),
        cmocka_unit_test(pairs_in_scenes_of_one_object_or_none),
        cmocka_unit_test(every_allocation_may_fail),
        cmocka_unit_test(batches_answer_as_single_questions_do),
        cmocka_unit_test(pairs_are_told_in_order_with_any_number_of_threads),
        cmocka_unit_test(the_first_bad_question_of_a_batch_is_named),
        cmocka_unit_test(every_allocation_of_a_batch_may_fail),
        cmocka_unit_test(no_more_pairs_are_gathered_than_lists_have_room_for),
    };
    int failed = cmocka_run_group_tests_name("query/pairs", tests, NULL, NULL);
    print_message("%llu decisions: %llu cross, %llu touch (%llu in a corner alone), %llu overlap\n",
                  (unsigned long long)decisions, (unsigned long long)counts[GEOM_CROSS],
                  (unsigned long long)counts[GEOM_TOUCH], (unsigned long long)corners,
                  (unsigned long long)counts[GEOM_OVERLAP]);
    if (EXACT_SHARE == 1) assert_true(decisions > 1000000 && corners > 1000);
    return failed;
}
