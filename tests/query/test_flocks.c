/* Windows in space, many in a call: the answers, their order, the statistics and the statuses of single calls, on all
 * kernels; with windows that meet nothing at each place of a flock, and where memory, a block or patience ends. */
#include "asked.h"
#include "query/packed/space.h"
#include "support/forge.h"
#include "support/memory.h"
#include "support/sanitized.h"
#include "support/tree_file.h"
#include <math.h>

enum { MOST = 300 }; /* more than a thread takes at a time */

typedef struct windows {
    double boxes[MOST][6];
    froe_range ranges[MOST];
} windows;

/* ------------------------------------------------------------------------ scenes -- */

/* Of triangles alone, and with boxes and balls, which lie in many leaves, and triangles that are there twice. */
static froe_tree *tree_of(bool mixed, uint32_t count, double size, double scale, uint32_t leaf) {
    froe_scene *scene;
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    for (uint64_t i = 0; i < count; i++) {
        double c[9], box[6], radius = 0.04 * scale;
        for (uint64_t j = 0; j < 9; j++)
            c[j] = scale * (trees_unit(1, 9 * i + j % 3) + size * (trees_unit(2, 9 * i + j) - 0.5));
        for (int k = 0; k < 3; k++) box[k] = fmin(c[k], c[3 + k]), box[3 + k] = fmax(c[k], c[3 + k]);
        add_to(scene, FROE_NONE, FROE_POLYGON, 1, c, NULL);
        if (mixed && i % 9 == 1) add_to(scene, FROE_NONE, FROE_POLYGON, 1, c, NULL);
        if (mixed && i % 9 == 3) add_to(scene, FROE_NONE, FROE_BOX, 1, box, NULL);
        if (mixed && i % 9 == 5) add_to(scene, FROE_NONE, FROE_BALL, 1, c, &radius);
        if (mixed && i % 9 == 7) add_to(scene, FROE_NONE, FROE_POINT, 1, c, NULL);
    }
    froe_tree *tree = trees_build(scene, "index", leaf);
    froe_scene_free(scene);
    return tree;
}

/* ------------------------------------------------------------------------ windows -- */

typedef enum window_kind { EVERYWHERE, EQUAL, AROUND_ALL, BESIDE, KINDS } window_kind;

/* Small, thin, flat, without ends, or around everything; many of them, or all, meet nothing. */
static void draw(windows *w, window_kind kind, double scale) {
    for (uint64_t i = 0; i < MOST; i++) {
        const uint64_t d = kind == EQUAL ? 4 : i;
        double *box = w->boxes[i];
        for (uint64_t k = 0; k < 3; k++) {
            const double extent = d % 23 == 7 ? 0.9 : 0.2 * trees_unit(5, d);
            box[k] = trees_unit(4, 3 * d + k) * 1.2 - 0.1;
            box[3 + k] = d % 5 == k ? box[k] : box[k] + extent;
            if (kind == AROUND_ALL || d % 29 == 11) box[k] = -2, box[3 + k] = 3;
            if (kind == BESIDE || d % 3 == 2 || (d > 40 && d < 80)) box[k] += 9, box[3 + k] += 9;
            box[k] *= scale, box[3 + k] *= scale;
        }
        if (d % 17 == 6 && kind != BESIDE) box[d % 3] = -INFINITY;
        if (d % 19 == 4 && kind != BESIDE) box[3 + d % 3] = INFINITY;
        w->ranges[i] = froe_range_defaults();
        w->ranges[i].points = box;
    }
}

static froe_status ask_batch(froe_query *q, const windows *w, size_t count, bool boxes, const froe_batch_options *o,
                             froe_answers *out, froe_diagnostic *why) {
    return boxes ? froe_batch_boxes(q, w->boxes[0], count, o, out, why)
                 : froe_batch_range(q, w->ranges, count, o, out, why);
}

/* ------------------------------------------------------------------------ answers -- */

typedef struct single_answers {
    size_t starts[MOST + 1];
    uint32_t ids[1 << 19];
    froe_query_stats stats[MOST + 1]; /* of the first ones */
} single_answers;

static void ask_singly(froe_query *q, const windows *w, single_answers *out) {
    (void)froe_query_statistics(q);
    for (size_t i = 0; i < MOST; i++) {
        froe_list list;
        assert_int_equal(froe_query_range(q, w->ranges + i, &list, NULL), FROE_OK);
        assert_true(out->starts[i] + list.count <= sizeof out->ids / sizeof *out->ids);
        if (list.count) memcpy(out->ids + out->starts[i], list.ids, list.count * sizeof *list.ids);
        out->starts[i + 1] = out->starts[i] + list.count;
        const froe_query_stats s = froe_query_statistics(q);
        froe_query_stats *sum = out->stats + i + 1;
        *sum = out->stats[i];
        sum->queries += s.queries, sum->nodes += s.nodes, sum->leaves += s.leaves, sum->tests += s.tests;
        sum->exact += s.exact, sum->slices += s.slices, sum->steps += s.steps;
        assert_int_equal(sum->queries, i + 1);
    }
}

static void check_batch(froe_query *q, const windows *w, size_t count, unsigned way, const single_answers *alone) {
    froe_batch_options o = froe_batch_defaults();
    froe_answers all;
    o.threads = way < 2 ? 1 : 3;
    (void)froe_query_statistics(q);
    assert_int_equal(ask_batch(q, w, count, way % 2, &o, &all, NULL), FROE_OK);
    const froe_query_stats stats = froe_query_statistics(q);
    assert_memory_equal(&stats, alone->stats + count, sizeof stats);
    for (size_t i = 0; i <= count; i++)
        if (all.starts[i] != alone->starts[i])
            fail_msg("%zu windows: %zu answers before window %zu, alone %zu", count, all.starts[i], i,
                     alone->starts[i]);
    assert_memory_equal(all.ids, alone->ids, alone->starts[count] * sizeof *all.ids);
    froe_answers_free(&all);
}

/* A window around everything looks at all nodes, and one beside it at the first. */
static void check_nodes(const tree_wide *wide, const windows *w, const single_answers *alone, double scale) {
    for (size_t i = 0; i < MOST; i++) {
        const bool beside = w->boxes[i][0] > 5 * scale || w->boxes[i][1] > 5 * scale;
        assert_int_equal(alone->stats[i + 1].nodes - alone->stats[i].nodes, beside ? 1 : wide->count);
    }
}

static void check_tree(froe_tree *tree, double scale) {
    static const size_t counts[] = {1, 2, 31, 32, 33, 65, 256, MOST};
    static windows w;
    for (size_t kernel = 0; space_kernels_at(kernel); kernel++)
        for (window_kind kind = EVERYWHERE; kind < KINDS; kind++) {
            single_answers *alone = calloc(1, sizeof *alone);
            froe_query *q = ask(tree);
            q->space->kernels = space_kernels_at(kernel);
            draw(&w, kind, scale);
            ask_singly(q, &w, alone);
            if (kind == AROUND_ALL && tree->packed.wide) check_nodes(tree->packed.wide, &w, alone, scale);
            assert_true(kind == EQUAL || (kind == BESIDE) == !alone->starts[MOST]);
            for (size_t c = 0; c < sizeof counts / sizeof *counts; c++)
                for (unsigned way = 0; way < 4; way++) check_batch(q, &w, counts[c], way, alone);
            froe_query_free(q);
            free(alone);
        }
    froe_tree_free(tree);
}

static void flocks_answer_as_windows_alone(void **state) {
    (void)state;
    check_tree(tree_of(false, 1500, 0.1, 1, 4), 1);
    check_tree(tree_of(true, 700 / SANITIZED_SHARE(4), 0.2, 1, 8), 1);
    check_tree(tree_of(true, 300, 0.3, 0x1p390, 24), 0x1p390);
    check_tree(tree_of(false, 1, 0.1, 1, 24), 1);
    froe_tree *large = tree_of(true, 100, 0.3, 0x1p900, 8); /* is asked in the general way */
    assert_null(large->packed.wide);
    check_tree(large, 0x1p900);
}

/* Among other shapes windows are asked one by one, in their order. */
static void ranges_of_all_shapes_are_answered_in_order(void **state) {
    static windows w;
    (void)state;
    froe_query *q = ask(tree_of(true, 400, 0.2, 1, 8));
    froe_answers all;
    draw(&w, EVERYWHERE, 1);
    for (size_t i = 35; i < MOST; i += 50) w.ranges[i].shape = FROE_SHAPE_BALL, w.ranges[i].radius = 0.25;
    for (size_t i = 35; i < MOST; i += 50)
        for (size_t k = 0; k < 3; k++) w.boxes[i][k] = 0.5;
    assert_int_equal(froe_batch_range(q, w.ranges, MOST, NULL, &all, NULL), FROE_OK);
    for (size_t i = 0; i < MOST; i++) {
        froe_list one;
        assert_int_equal(froe_query_range(q, w.ranges + i, &one, NULL), FROE_OK);
        assert_int_equal(all.starts[i + 1] - all.starts[i], one.count);
        if (one.count) assert_memory_equal(all.ids + all.starts[i], one.ids, one.count * sizeof *one.ids);
    }
    froe_answers_free(&all);
    end_query(q);
}

/* ------------------------------------------------------------------------ failures -- */

static froe_status ask_without_memory(void *user, const froe_allocator *alloc) {
    static windows w;
    froe_tree tree = *(const froe_tree *)user;
    froe_answers all;
    froe_query *q = NULL;
    draw(&w, EVERYWHERE, 1);
    tree.alloc = *alloc;
    froe_status status = froe_query_new(&tree, &q, NULL);
    for (unsigned way = 0; way < 4 && !status; way++) {
        froe_batch_options o = froe_batch_defaults();
        o.threads = way < 2 ? 1 : 2;
        status = ask_batch(q, &w, MOST, way % 2, &o, &all, NULL);
        if (!status) froe_answers_free(&all);
    }
    froe_query_free(q);
    return status;
}

static void memory_may_end_at_every_allocation(void **state) {
    (void)state;
    froe_tree *tree = tree_of(true, 500, 0.2, 1, 4);
    assert_true(test_memory_each(ask_without_memory, tree) > 20);
    froe_tree_free(tree);
}

static bool stop_at(void *user, double done) {
    (void)done;
    return --*(int *)user != 0;
}

static void flocks_can_be_cancelled_at_every_call(void **state) {
    static windows w;
    (void)state;
    froe_query *q = ask(tree_of(false, 500, 0.1, 1, 4));
    draw(&w, EVERYWHERE, 1);
    for (unsigned threads = 1; threads <= 2; threads++) {
        froe_status status = FROE_E_CANCELLED;
        for (int stop = 1; status; stop++) {
            int left = stop;
            froe_answers all;
            froe_diagnostic why = {0};
            froe_batch_options o = froe_batch_defaults();
            o.threads = threads, o.progress = stop_at, o.user = &left;
            status = ask_batch(q, &w, MOST, stop % 2, &o, &all, &why);
            assert_true(status == FROE_OK || status == FROE_E_CANCELLED);
            assert_true(status ? why.message[0] != 0 : stop > 2);
            if (!status) froe_answers_free(&all);
        }
    }
    end_query(q);
}

/* A block whose first objects are none: who meets it is told so, alone and in a flock; others are answered. */
static void blocks_that_cannot_be_read_are_told(void **state) {
    static windows w;
    (void)state;
    const tree_file f = tree_file_of(tree_of(false, 1500, 0.1, 1, 4));
    const file_section s = tree_file_section(&f, FILE_BLOCKS);
    memset(f.bytes + s.offset + s.size / 2, 0x7f, 4 * PACKED_BLOCK);
    forge_checksums(f.bytes, f.size);
    draw(&w, EVERYWHERE, 1);
    size_t bad = 0, first = MOST;
    for (size_t i = 0; i < MOST; i++) { /* each of a tree that nothing is known of */
        froe_tree *tree;
        froe_list one;
        froe_answers all = {0};
        froe_diagnostic why = {0}, its = {0};
        assert_int_equal(froe_tree_open_memory(f.bytes, f.size, NULL, &tree, NULL), FROE_OK);
        froe_query *q = ask(tree);
        const froe_status status = froe_query_range(q, w.ranges + i, &one, &why);
        froe_query_free(q);
        q = ask(tree);
        assert_int_equal(ask_batch(q, &w, i + 1, i % 2, NULL, &all, &its), status || bad ? FROE_E_FORMAT : FROE_OK);
        if (status) assert_int_equal(status, FROE_E_FORMAT);
        if (status && !bad) assert_string_equal(why.message, its.message), first = i;
        bad += status != FROE_OK;
        froe_answers_free(&all);
        froe_query_free(q), froe_tree_free(tree);
        if (bad > 5) break;
    }
    assert_true(first > 0 && first < MOST);
    free(f.bytes);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(flocks_answer_as_windows_alone),
        cmocka_unit_test(ranges_of_all_shapes_are_answered_in_order),
        cmocka_unit_test(memory_may_end_at_every_allocation),
        cmocka_unit_test(flocks_can_be_cancelled_at_every_call),
        cmocka_unit_test(blocks_that_cannot_be_read_are_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
