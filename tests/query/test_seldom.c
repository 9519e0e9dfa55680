/* test_seldom.c: answers where searches seldom go: windows and rays without ends, points beside tables, equal sums of
 * sets, deep trees of oblique cuts, blocks that cannot be read, areas with loose objects; compared with brute force, or
 * with what is asked in another way. */
#include "asked.h"
#include "query/members.h"
#include "support/forge.h"
#include "support/large.h"
#include "support/tree_file.h"
#include <math.h>

/* ------------------------------------------------------------------------- batches -- */

/* Windows that reach beyond everything, one by one and together, in order and in flocks. */
static void batches_of_windows_without_ends_are_single_questions(void **state) {
    static const double ends[] = {-INFINITY, 0.3, 0.6, INFINITY};
    double boxes[256 * 4];
    size_t count = 0;
    (void)state;
    for (int i = 0; i < 256; i++) {
        const double box[4] = {ends[i & 3], ends[i >> 2 & 3], ends[i >> 4 & 3], ends[i >> 6]};
        if (!(box[0] <= box[2] && box[1] <= box[3]) || box[0] == INFINITY || box[1] == INFINITY) continue;
        if (box[2] == -INFINITY || box[3] == -INFINITY) continue;
        memcpy(boxes + 4 * count++, box, sizeof box);
    }
    for (int large = 0; large < 2; large++)
        for (uint32_t leaf = 1; leaf < 30; leaf += 23) {
            froe_query *q = ask(trees_grow(2, FROE_SEGMENT, 3000, 0, 0.02, "index", leaf));
            froe_answers all;
            large_ask(q, large);
            assert_int_equal(froe_batch_boxes(q, boxes, count, NULL, &all, NULL), FROE_OK);
            for (size_t i = 0; i < count; i++) {
                froe_list one;
                froe_range r = froe_range_defaults();
                r.points = boxes + 4 * i;
                for (int again = 0; again < 2; again++) assert_int_equal(froe_query_range(q, &r, &one, NULL), FROE_OK);
                assert_same_ids(one.ids, one.count, all.ids + all.starts[i], all.starts[i + 1] - all.starts[i]);
            }
            froe_answers_free(&all);
            end_query(q);
        }
}

/* Points beside the scene on all sides: their cells are not in the table. */
static void batches_of_neighbours_of_points_outside_are_single_questions(void **state) {
    enum { SIDE = 24, COUNT = SIDE * SIDE };
    double points[COUNT][2];
    (void)state;
    for (int i = 0; i < COUNT; i++) points[i][0] = i % SIDE * 0.3 - 3, points[i][1] = i / SIDE * 0.3 - 3;
    for (int large = 0; large < 2; large++) {
        froe_query *q = ask(trees_grow(2, FROE_SEGMENT, 400, 0, 0.05, "index", 8));
        froe_answers all;
        large_ask(q, large);
        assert_int_equal(froe_batch_near(q, points[0], COUNT, 3, INFINITY, NULL, &all, NULL), FROE_OK);
        for (size_t i = 0; i < COUNT; i++) {
            froe_neighbours one;
            assert_int_equal(froe_query_near(q, points[i], 3, INFINITY, &one, NULL), FROE_OK);
            assert_int_equal(one.count, 3);
            for (size_t k = 0; k < 3; k++) {
                assert_int_equal(all.ids[3 * i + k], one.items[k].object);
                assert_true(all.values[3 * i + k] == one.items[k].distance);
            }
        }
        froe_answers_free(&all);
        end_query(q);
    }
}

/* Of some chunks of questions nothing is found, of others much, by several threads. */
static void chunks_of_questions_without_answers_leave_no_gaps(void **state) {
    enum { CHUNK = 256, CHUNKS = 40, COUNT = CHUNK * CHUNKS };
    static double points[COUNT][2];
    (void)state;
    froe_query *q = ask(trees_grow(2, FROE_SEGMENT, 400, 0, 0.05, "autopartition", 4));
    for (size_t i = 0; i < COUNT; i++)
        for (size_t k = 0; k < 2; k++) points[i][k] = trees_unit(7, 2 * i + k) + (i / CHUNK % 2 ? 50 : 0);
    froe_batch_options o = froe_batch_defaults();
    for (o.threads = 1; o.threads <= 4; o.threads += 3)
        for (int round = 0; round < 5; round++) {
            froe_answers all;
            assert_int_equal(froe_batch_near(q, points[0], COUNT, 2, 1, &o, &all, NULL), FROE_OK);
            for (size_t i = 0; i < COUNT; i++)
                assert_int_equal(all.starts[i + 1] - all.starts[i], i / CHUNK % 2 ? 0 : 2);
            froe_answers_free(&all);
        }
    end_query(q);
}

static bool stop_at(void *user, double done) {
    (void)done;
    return --*(int *)user != 0;
}

static void batches_can_be_cancelled_at_every_call(void **state) {
    static double points[2000][2];
    (void)state;
    froe_query *q = ask(trees_grow(2, FROE_SEGMENT, 400, 0, 0.05, "autopartition", 4));
    for (size_t i = 0; i < 2000; i++)
        for (size_t k = 0; k < 2; k++) points[i][k] = trees_unit(7, 2 * i + k);
    for (unsigned threads = 1; threads <= 2; threads++) {
        froe_status status = FROE_E_CANCELLED;
        for (int stop = 1; status; stop++) {
            int left = stop;
            froe_answers all;
            froe_diagnostic why = {0};
            froe_batch_options o = froe_batch_defaults();
            o.threads = threads, o.progress = stop_at, o.user = &left;
            status = froe_batch_near(q, points[0], 2000, 2, INFINITY, &o, &all, &why);
            assert_true(status == FROE_OK || status == FROE_E_CANCELLED);
            assert_true(status ? why.message[0] != 0 : stop > 2);
            if (!status) froe_answers_free(&all);
        }
    }
    end_query(q);
}

/* ------------------------------------------------------------------- opened trees -- */

/* Blocks whose first object is none: whatever reads one says so, in a batch as well. */
static void blocks_that_cannot_be_read_are_told_by_every_question(void **state) {
    (void)state;
    const tree_file f = tree_file_of(trees_grow(2, FROE_SEGMENT, 3000, 0, 0.02, "index", 4));
    const file_section s = tree_file_section(&f, FILE_BLOCKS);
    for (uint64_t at = s.offset; at < s.offset + s.size; at += PACKED_BLOCK)
        memset(f.bytes + at + sizeof(packed_header), 0x7f, PACKED_BLOCK - sizeof(packed_header));
    forge_checksums(f.bytes, f.size);
    for (int which = 0; which < 8; which++) {
        static const double box[4] = {0.1, 0.1, 0.9, 0.9}, x[2] = {0.5, 0.5};
        froe_tree *tree;
        froe_diagnostic why = {0};
        froe_answers many;
        froe_list found;
        froe_neighbours near;
        froe_range r = froe_range_defaults();
        uint64_t sum;
        uint32_t object;
        froe_status status = FROE_OK;
        r.points = box;
        assert_int_equal(froe_tree_open_memory(f.bytes, f.size, NULL, &tree, NULL), FROE_OK);
        froe_query *q = ask(tree);
        if (which == 0) status = froe_query_range(q, &r, &found, &why);
        if (which == 1) status = froe_query_count(q, &r, &sum, &why);
        if (which == 2) status = froe_query_any(q, &r, &object, &why);
        if (which == 3) status = froe_query_near(q, x, 4, INFINITY, &near, &why);
        if (which == 4) status = froe_query_vertical(q, x, 1, &object, &why);
        if (which == 5) status = froe_batch_boxes(q, box, 1, NULL, &many, &why);
        if (which == 6) status = froe_batch_near(q, x, 1, 4, INFINITY, NULL, &many, &why);
        if (which == 7) status = froe_batch_vertical(q, x, 1, 1, NULL, &object, &why);
        assert_int_equal(status, FROE_E_FORMAT);
        assert_non_null(strstr(why.message, "corrupted"));
        froe_query_free(q), froe_tree_free(tree);
    }
    free(f.bytes);
}

/* Owners that are no objects: windows that hold the whole tree read them without its blocks. */
static void owners_that_do_not_exist_are_told_by_every_window(void **state) {
    static const double box[4] = {-1, -1, 3, 3};
    (void)state;
    const tree_file f = tree_file_of(trees_grow(2, FROE_SEGMENT, 3000, 0, 0.02, "index", 4));
    const file_section s = tree_file_section(&f, FILE_OWNERS);
    memset(f.bytes + s.offset, 0x7f, s.size);
    forge_checksums(f.bytes, f.size);
    for (int which = 0; which < 3; which++) {
        froe_tree *tree;
        froe_diagnostic why = {0};
        froe_answers many;
        froe_list found;
        froe_range r = froe_range_defaults();
        uint64_t sum;
        froe_status status = FROE_OK;
        r.points = box;
        assert_int_equal(froe_tree_open_memory(f.bytes, f.size, NULL, &tree, NULL), FROE_OK);
        froe_query *q = ask(tree);
        if (which == 0) status = froe_query_range(q, &r, &found, &why);
        if (which == 1) status = froe_query_count(q, &r, &sum, &why);
        if (which == 2) status = froe_batch_boxes(q, box, 1, NULL, &many, &why);
        assert_int_equal(status, FROE_E_FORMAT);
        assert_non_null(strstr(why.message, "owners that do not exist"));
        froe_query_free(q), froe_tree_free(tree);
    }
    free(f.bytes);
}

static void opened_trees_of_nothing_have_no_neighbours(void **state) {
    static const double x[3] = {0};
    (void)state;
    for (int dim = 2; dim <= 3; dim++)
        for (size_t k = 1; k < 4; k++) {
            const tree_file f =
                tree_file_of(trees_grow(dim, dim == 2 ? FROE_SEGMENT : FROE_POLYGON, 0, 0, 0.02, "index", 4));
            froe_tree *tree;
            froe_neighbours near = {.count = 1};
            assert_int_equal(froe_tree_open_memory(f.bytes, f.size, NULL, &tree, NULL), FROE_OK);
            froe_query *q = ask(tree);
            assert_int_equal(froe_query_near(q, x, k, INFINITY, &near, NULL), FROE_OK);
            assert_int_equal(near.count, 0);
            froe_query_free(q), froe_tree_free(tree);
            free(f.bytes);
        }
}

/* ---------------------------------------------------------------------------- sets -- */

/* So many sets of one number and of two that some have the same tag. */
static void sets_with_the_same_tag_are_told_apart(void **state) {
    enum { SETS = 300000 };
    query_sets sets = {0};
    query_members set = {0}, again = {0};
    const froe_allocator alloc = support_allocator(NULL);
    (void)state;
    for (int round = 0; round < 2; round++)
        for (uint32_t i = 0; i < SETS; i++) {
            uint32_t kept;
            set.count = 0;
            assert_true(query_members_add(&set, &alloc, i / 2));
            if (i % 2) assert_true(query_members_add(&set, &alloc, SETS + i));
            assert_true(query_sets_keep(&sets, &alloc, &set, &kept));
            assert_int_equal(kept, i);
            assert_true(query_sets_copy(&sets, &alloc, kept, &again));
            assert_int_equal(again.count, set.count);
            assert_memory_equal(again.data, set.data, set.count * sizeof *set.data);
        }
    query_sets_free(&sets, &alloc);
    array_free(&alloc, &set), array_free(&alloc, &again);
}

/* --------------------------------------------------------------------------- pairs -- */

/* Segments on few lines, in both directions, which lie upon one another. */
static void pairs_of_segments_on_one_line_are_told_once(void **state) {
    enum { COUNT = 160, GRID = 16 };
    double coords[COUNT][4];
    (void)state;
    for (uint64_t i = 0; i < COUNT; i++) {
        const int line = (int)(trees_unit(3, 4 * i) * 5), a = (int)(trees_unit(3, 4 * i + 1) * GRID);
        const int way = i % 3 ? 1 : -1, b = a + (trees_unit(3, 4 * i + 2) < 0.5 ? 3 : -3);
        coords[i][0] = a, coords[i][1] = way * a + line - 2, coords[i][2] = b, coords[i][3] = way * b + line - 2;
    }
    size_t counts[2];
    for (int packed = 0; packed < 2; packed++) {
        froe_scene *scene;
        froe_pairs all;
        assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
        assert_int_equal(trees_add(scene, FROE_SEGMENT, COUNT, coords[0], NULL, NULL), FROE_OK);
        froe_query *q = ask(trees_build(scene, packed ? "index" : "autopartition", 2));
        bool met[COUNT][COUNT] = {{false}};
        assert_int_equal(froe_batch_pair_array(q, true, NULL, &all, NULL), FROE_OK);
        counts[packed] = all.count;
        for (size_t i = 0; i < all.count; i++) {
            assert_false(met[all.pairs[i].a][all.pairs[i].b]);
            met[all.pairs[i].a][all.pairs[i].b] = true;
        }
        for (uint32_t a = 0; a < COUNT; a++) {
            froe_list found;
            froe_range r = froe_range_defaults();
            r.shape = FROE_SHAPE_SEGMENT, r.points = coords[a];
            assert_int_equal(froe_query_range(q, &r, &found, NULL), FROE_OK);
            for (size_t i = 0; i < found.count; i++)
                if (found.ids[i] > a) assert_true(met[a][found.ids[i]]), met[a][found.ids[i]] = false;
        }
        for (size_t i = 0; i < (size_t)COUNT * COUNT; i++) assert_false(met[i / COUNT][i % COUNT]);
        froe_pairs_free(&all);
        end_query(q);
        froe_scene_free(scene);
    }
    assert_int_equal(counts[0], counts[1]);
}

/* --------------------------------------------------------------------------- areas -- */

static void groups_of_one_scene_are_joined_beside_loose_objects(void **state) {
    static const bool meets[4][4] = {{1, 1, 1, 0}, {1, 1, 1, 0}, {1, 1, 1, 0}, {0}};
    static const bool within[4][4] = {{1, 1, 1, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0}}; /* [question][answer] */
    static const char *const methods[] = {"index", "autopartition"};
    (void)state;
    froe_scene *scene = areas();
    for (int m = 0; m < 2; m++) {
        froe_query *q = ask(trees_build(scene, methods[m], 1)), *other = ask(trees_build(scene, methods[!m], 4));
        for (froe_relation r = FROE_MEETS; r <= FROE_COVERS; r++) {
            froe_answers join;
            assert_int_equal(froe_batch_groups_join(q, other, r, NULL, &join, NULL), FROE_OK);
            assert_int_equal(join.queries, 4);
            for (uint32_t i = 0; i < 4; i++) {
                bool found[4] = {false};
                for (size_t k = join.starts[i]; k < join.starts[i + 1]; k++) found[join.ids[k]] = true;
                for (uint32_t k = 0; k < 4; k++)
                    assert_int_equal(found[k], r == FROE_MEETS    ? meets[i][k]
                                               : r == FROE_WITHIN ? within[i][k]
                                                                  : within[k][i]);
            }
            froe_answers_free(&join);
        }
        end_query(q), end_query(other);
    }
    froe_scene_free(scene);
}

/* A disc that touches the window from outside meets it, and is not within; from inside it is. */
static void discs_that_touch_windows_are_within_from_inside_only(void **state) {
    static const double window[4] = {0, 0, 4, 4}, radius = 1;
    static const double centres[][2] = {{3, 2}, {5, 2}, {-1, 2}, {2, 5}, {2, -1}, {1, 1}, {2, 3.5}, {2, 2}};
    static const bool within[] = {true, false, false, false, false, true, false, true};
    (void)state;
    for (size_t i = 0; i < sizeof centres / sizeof *centres; i++) {
        froe_scene *scene;
        froe_list found;
        froe_range r = froe_range_defaults();
        r.points = window;
        assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
        add_to(scene, add_group(scene), FROE_BALL, 1, centres[i], &radius);
        froe_query *q = ask(trees_build(scene, "density", 1));
        assert_int_equal(froe_query_groups_range(q, &r, FROE_MEETS, &found, NULL), FROE_OK);
        assert_int_equal(found.count, 1);
        assert_int_equal(froe_query_groups_range(q, &r, FROE_WITHIN, &found, NULL), FROE_OK);
        assert_int_equal(found.count, within[i]);
        end_query(q);
        froe_scene_free(scene);
    }
}

/* Balls and capsules without a radius are points and segments. The loose segment passes through the first of them. */
static void areas_cover_ranges_without_a_radius(void **state) {
    static const double points[][4] = {
        {0.5, 0.5, 0.5, 0.5}, {1.5, 1.25, 1.5, 1.25}, {0.5, 0.5, 3.5, 3.5}, {1.25, 1.25, 1.5, 1.25}, {3, 3, 5, 3}};
    static const size_t counts[] = {1, 2, 1, 2, 0};
    static const char *const methods[] = {"index", "autopartition"};
    (void)state;
    froe_scene *scene = areas();
    for (int m = 0; m < 2; m++) {
        froe_query *q = ask(trees_build(scene, methods[m], 1));
        for (int i = 0; i < 5; i++)
            for (int shape = 0; shape < 4; shape++) {
                static const froe_range_shape shapes[] = {FROE_SHAPE_BOX, FROE_SHAPE_BALL, FROE_SHAPE_CAPSULE,
                                                          FROE_SHAPE_SEGMENT};
                froe_list found;
                froe_range r = froe_range_defaults();
                r.shape = shapes[shape], r.points = points[i], r.radius = 0;
                if (shape == 1 && i > 1) continue;
                assert_int_equal(froe_query_groups_range(q, &r, FROE_COVERS, &found, NULL), FROE_OK);
                assert_int_equal(found.count, shape == 0 && i == 2 ? 1 : counts[i] + (i == 1));
            }
        end_query(q);
    }
    froe_scene_free(scene);
}

/* Of a convex polygon of many edges every cut leaves all others on one side: the tree is as high as it is long. */
static void groups_are_found_in_deep_trees_of_oblique_cuts(void **state) {
    enum { EDGES = 400 };
    static double coords[EDGES][4];
    (void)state;
    for (int i = 0; i < EDGES; i++)
        for (int end = 0; end < 2; end++) {
            const double t = 6.283185307179586 * ((i + end) % EDGES) / EDGES;
            coords[i][2 * end] = cos(t), coords[i][2 * end + 1] = sin(t);
        }
    froe_scene *scene;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    add_to(scene, add_group(scene), FROE_SEGMENT, EDGES, coords[0], NULL);
    froe_query *q = ask(trees_build(scene, "autopartition", 1));
    assert_true(q->tree->report.height > EDGES / 2);
    for (int stage = NUM_FILTER; stage <= NUM_EXACT; stage++)
        for (uint64_t i = 0; i < 500; i++) {
            const double x[2] = {2 * trees_unit(5, 2 * i) - 1, 2 * trees_unit(5, 2 * i + 1) - 1};
            const double square = x[0] * x[0] + x[1] * x[1];
            froe_list found;
            q->numbers.first = (num_stage)stage;
            if (square > 0.9998 && square < 1.0001) continue;
            assert_int_equal(froe_query_groups(q, x, &found, NULL), FROE_OK);
            assert_int_equal(found.count, square < 1);
        }
    end_query(q);
    froe_scene_free(scene);
}

/* Solids have no borders: points are located in them. */
static void batches_of_groups_without_borders_are_single_questions(void **state) {
    static const double boxes[] = {0, 0, 2, 2, 1, 1, 3, 3};
    double points[49][2];
    (void)state;
    froe_scene *scene;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    for (size_t i = 0; i < 2; i++) add_to(scene, add_group(scene), FROE_BOX, 1, boxes + 4 * i, NULL);
    for (int i = 0; i < 49; i++) points[i][0] = i % 7 * 0.5, points[i][1] = i / 7 * 0.5;
    froe_query *q = ask(trees_build(scene, "density", 1));
    froe_answers all;
    assert_int_equal(froe_batch_groups(q, points[0], 49, NULL, &all, NULL), FROE_OK);
    for (size_t i = 0; i < 49; i++) {
        size_t count = 0;
        for (size_t b = 0; b < 2; b++) {
            const double *box = boxes + 4 * b, *x = points[i];
            const bool in = x[0] >= box[0] && x[0] <= box[2] && x[1] >= box[1] && x[1] <= box[3];
            if (in) assert_int_equal(all.ids[all.starts[i] + count++], b);
        }
        assert_int_equal(all.starts[i + 1] - all.starts[i], count);
    }
    froe_answers_free(&all);
    end_query(q);
    froe_scene_free(scene);
}

/* ---------------------------------------------------------------------------- rays -- */

/* Of halves that have a corner in the middle the cut is moved by the least that there is; others, beside them, are cut
 * in the middle. Tables of columns do not say what is above such lines. */
static void segments_are_found_above_cuts_that_are_not_quite_on_one_line(void **state) {
    enum { COUNT = 600, POINTS = 400 };
    static double coords[COUNT][4], points[POINTS][2];
    static const char *const methods[] = {"index", "autopartition"};
    static uint32_t found[2][POINTS];
    froe_scene *scene;
    (void)state;
    for (uint64_t i = 0; i < COUNT; i++)
        for (uint64_t k = 0; k < 4; k++) {
            const double x = trees_unit(21, 4 * i + k % 2) * 0.45 + (k < 2 ? 0 : 0.03 * trees_unit(22, 4 * i + k));
            coords[i][k] = i % 2 ? x + (k % 2 ? trees_unit(23, i) * 0.5 : 0.5) : x * (k % 2 ? 2 : 1);
            if (i % 2 == 0) coords[i][k] = floor(coords[i][k] * 64) / 64;
        }
    memcpy(coords[0], (const double[]){0, 0, 0.01, 0.01}, sizeof coords[0]);
    memcpy(coords[1], (const double[]){1, 1, 0.99, 0.99}, sizeof coords[1]);
    for (size_t i = 0; i < POINTS; i++)
        for (size_t k = 0; k < 2; k++) points[i][k] = trees_unit(24, 2 * i + k);
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_SEGMENT, COUNT, coords[0], NULL, NULL), FROE_OK);
    for (int way = -1; way <= 1; way += 2) {
        for (int m = 0; m < 2; m++) {
            froe_query *q = ask(trees_build(scene, methods[m], 2));
            assert_int_equal(froe_batch_vertical(q, points[0], POINTS, way, NULL, found[m], NULL), FROE_OK);
            end_query(q);
        }
        assert_memory_equal(found[0], found[1], sizeof found[0]);
    }
    froe_scene_free(scene);
}

/* Moves a horizontal cut, and with it the cells beside it. */
static void move_cut(froe_tree *tree, uint32_t node, double to) {
    const double from = tree->nodes[node].u.value;
    uint32_t stack[64] = {node};
    tree->nodes[node].u.value = to;
    for (size_t count = 1; count;) {
        const tree_node *n = tree->nodes + stack[--count];
        if (!tree_is_leaf(n)) {
            stack[count++] = n->child, stack[count++] = n->child + 1;
            continue;
        }
        packed_box cell;
        packed_header *block = (packed_header *)(uintptr_t)packed_block(tree, n);
        if (block->lo[1] == from) block->lo[1] = to;
        packed_cell(tree, block, &cell);
        if (block->scale > 0) block->scale = packed_scale(&cell);
    }
}

/* A cut that is moved by a unit in the last place, between all coordinates, makes its line of the table crooked: what
 * is met above and below points is what was met before. */
static void segments_are_found_across_lines_that_were_made_crooked(void **state) {
    enum { POINTS = 400 };
    static double points[POINTS][2];
    static uint32_t found[2][2][POINTS];
    (void)state;
    froe_tree *tree = trees_grow(2, FROE_SEGMENT, 600, 0, 0.03, "index", 2);
    for (size_t i = 0; i < POINTS; i++)
        for (size_t k = 0; k < 2; k++) points[i][k] = trees_unit(24, 2 * i + k);
    for (int moved = 0; moved < 2; moved++) {
        size_t crooked = 0;
        if (moved)
            for (uint32_t i = 1; i < tree->node_count; i++) { /* of two cuts at one place the later one */
                tree_node *n = tree->nodes + i;
                bool again = false;
                for (uint32_t j = 0; j < i && !again && !tree_is_leaf(n) && n->axis == 1; j++)
                    again = !tree_is_leaf(tree->nodes + j) && tree->nodes[j].axis == 1 &&
                            tree->nodes[j].u.value == n->u.value;
                if (again) move_cut(tree, i, nextafter(n->u.value, 2));
            }
        froe_diagnostic why;
        if (froe_tree_audit(tree, NULL, &why)) fail_msg("%s", why.message);
        tree_table_free(&tree->alloc, tree->packed.table);
        assert_int_equal(tree_table_new(tree, &tree->packed.table), FROE_OK);
        for (uint32_t i = 0; i <= tree->packed.table->cells[1]; i++) crooked += tree->packed.table->crooked[1][i];
        assert_int_equal(crooked > 2, moved);
        froe_query *q;
        assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
        for (int up = 0; up < 2; up++)
            assert_int_equal(froe_batch_vertical(q, points[0], POINTS, up ? 1 : -1, NULL, found[moved][up], NULL),
                             FROE_OK);
        froe_query_free(q);
    }
    assert_memory_equal(found[0], found[1], sizeof found[0]);
    froe_tree_free(tree);
}

/* A heap of segments just above the cut of the root. The next cut lies just above the heap, on the same line of the
 * table, and no core of a cell has what is between them: rays find it all the same. */
static void segments_between_cuts_of_a_crooked_line_are_found(void **state) {
    enum { HEAP = 64, OTHERS = 4000, POINTS = 100 };
    static const double width = 0x1p-8, heap = 0x1p-40;
    static double coords[HEAP + OTHERS][4], points[POINTS][2];
    double cut = 0.5;
    uint32_t found[2][2][POINTS]; /* by index, and by another method; down, and up */
    (void)state;
    for (int i = 0; i < OTHERS; i++) {
        const double y = i ? 0.5 * i / OTHERS : 1; /* all but one below the cut, so that there are many lines */
        memcpy(coords[HEAP + i], (double[]){0, y, width / 4, y}, sizeof *coords);
    }
    for (int i = 0; i < POINTS; i++) points[i][0] = width * 0.75, points[i][1] = (i + 0.5) / POINTS;
    for (int turn = 0; turn < 3; turn++) { /* the first tells the cut of the root */
        froe_build_options o = froe_build_defaults();
        froe_scene *scene;
        froe_tree *tree;
        froe_query *q;
        o.method = turn < 2 ? "index" : "autopartition", o.leaf = 2;
        for (int i = 0; i < HEAP; i++) {
            const double x = width * 0.75, y = cut + heap * (i + 1) / HEAP;
            memcpy(coords[i], (double[]){x - heap, y, x + heap, y}, sizeof *coords);
        }
        assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
        assert_int_equal(trees_add(scene, FROE_SEGMENT, HEAP + OTHERS, coords[0], NULL, NULL), FROE_OK);
        assert_int_equal(froe_build(scene, &o, &tree, NULL), FROE_OK);
        if (turn < 2) {
            const tree_table *table = tree->packed.table;
            assert_int_equal(tree->nodes->axis, 1);
            assert_int_equal(table->crooked[1][table->cells[1] / 2], turn);
            cut = tree->nodes->u.value;
        }
        assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
        for (int up = 0; up < 2 && turn; up++)
            assert_int_equal(froe_batch_vertical(q, points[0], POINTS, up ? 1 : -1, NULL, found[turn - 1][up], NULL),
                             FROE_OK);
        froe_query_free(q), froe_tree_free(tree), froe_scene_free(scene);
    }
    assert_memory_equal(found[0], found[1], sizeof found[0]);
    assert_true(found[0][0][POINTS - 1] == HEAP - 1 && found[0][1][0] == 0);
}

/* Objects that touch in the upper sides of cells, where the next cell begins: each pair is told once. */
static void pairs_that_touch_in_sides_of_cells_are_told_once(void **state) {
    enum { LINES = 17 };
    (void)state;
    froe_scene *scene;
    size_t counts[2];
    static const char *const methods[] = {"index", "autopartition"};
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    for (int i = 0; i < LINES; i++)
        for (int j = 0; j < LINES; j++) { /* T-shapes, which end in lines of halves, quarters and so on, and touch */
            const double x = i, y = j, post[4] = {x, y - 0.25, x, y + 0.25}, arm[4] = {x - 0.375, y, x, y},
                         roof[4] = {x - 0.25, y + 0.5, x + 0.25, y + 0.5}, below[4] = {x, y + 0.375, x, y + 0.5};
            add_to(scene, FROE_NONE, FROE_SEGMENT, 1, post, NULL);
            add_to(scene, FROE_NONE, FROE_SEGMENT, 1, arm, NULL);
            add_to(scene, FROE_NONE, FROE_SEGMENT, 1, roof, NULL);
            add_to(scene, FROE_NONE, FROE_SEGMENT, 1, below, NULL);
        }
    for (int m = 0; m < 2; m++) {
        froe_pairs all;
        froe_query *q = ask(trees_build(scene, methods[m], 4));
        assert_int_equal(froe_batch_pair_array(q, true, NULL, &all, NULL), FROE_OK);
        counts[m] = all.count;
        froe_pairs_free(&all);
        end_query(q);
    }
    assert_int_equal(counts[0], 2 * LINES * LINES);
    assert_int_equal(counts[1], 2 * LINES * LINES);
    froe_scene_free(scene);
}

/* A map of so many leaves that windows wait for memory: they count what lies in them. */
static void windows_of_a_large_map_hold_what_lies_in_them(void **state) {
    enum { SIDE = 256, WINDOWS = 64 };
    static double coords[SIDE * SIDE][4], boxes[WINDOWS][4];
    (void)state;
    froe_scene *scene;
    froe_answers all;
    for (int i = 0; i < SIDE * SIDE; i++) {
        coords[i][0] = i % SIDE, coords[i][1] = i / SIDE;
        coords[i][2] = coords[i][0] + 0.5, coords[i][3] = coords[i][1] + 0.25;
    }
    for (int i = 0; i < WINDOWS; i++) {
        boxes[i][0] = 3 * i - 0.25, boxes[i][1] = 200 - 2 * i - 0.25;
        boxes[i][2] = boxes[i][0] + i % 5, boxes[i][3] = boxes[i][1] + 3;
    }
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_SEGMENT, SIDE * SIDE, coords[0], NULL, NULL), FROE_OK);
    froe_query *q = ask(trees_build(scene, "index", 4));
    assert_true(q->tree->packed.block_count >= 1 << 14);
    assert_int_equal(froe_batch_boxes(q, boxes[0], WINDOWS, NULL, &all, NULL), FROE_OK);
    for (int i = 0; i < WINDOWS; i++) {
        size_t met = 0;
        for (int c = 0; c < SIDE * SIDE; c++) { /* a segment and a window meet as their bounds do, or it is long */
            const double *s = coords[c], *b = boxes[i];
            if (s[0] > b[2] || s[2] < b[0] || s[1] > b[3] || s[3] < b[1]) continue;
            const double lo = fmax(s[0], b[0]), hi = fmin(s[2], b[2]), y = s[1] + 0.5 * (lo - s[0]),
                         z = y + 0.5 * (hi - lo);
            met += y <= b[3] && z >= b[1];
        }
        froe_list one;
        froe_range r = froe_range_defaults();
        r.points = boxes[i];
        assert_int_equal(all.starts[i + 1] - all.starts[i], met);
        assert_int_equal(froe_query_range(q, &r, &one, NULL), FROE_OK);
        assert_int_equal(one.count, met);
    }
    froe_answers_free(&all);
    end_query(q);
    froe_scene_free(scene);
}

/* Triangles whose sides all come near a square, and which begin or end outside of all of its scene. */
static void areas_that_begin_outside_of_the_question_are_not_within(void **state) {
    static const double square[16] = {0, 0, 1, 0, 1, 0, 1, 1, 1, 1, 0, 1, 0, 1, 0, 0};
    (void)state;
    froe_scene *scene, *asked;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    assert_int_equal(froe_scene_new(2, NULL, &asked), FROE_OK);
    add_to(asked, add_group(asked), FROE_SEGMENT, 4, square, NULL);
    for (int i = 0; i < 4; i++) { /* the last one is within */
        const double far = i == 3 ? 0.875 : 2, corners[3][2] = {{0.5, far}, {0.25, 0.5}, {0.75, 0.5}};
        double ring[3][4];
        for (int k = 0; k < 3; k++)
            for (int c = 0; c < 4; c++) ring[k][c] = corners[(i + k + c / 2) % 3][c % 2];
        add_to(scene, add_group(scene), FROE_SEGMENT, 3, ring[0], NULL);
    }
    froe_query *q = ask(trees_build(scene, "autopartition", 1)), *questions = ask(trees_build(asked, "kd", 1));
    for (froe_relation r = FROE_MEETS; r <= FROE_COVERS; r++) {
        froe_answers all;
        assert_int_equal(froe_batch_groups_join(q, questions, r, NULL, &all, NULL), FROE_OK);
        assert_int_equal(all.starts[1], r == FROE_MEETS ? 4 : r == FROE_WITHIN ? 1 : 0);
        if (r == FROE_WITHIN) assert_int_equal(all.ids[0], 3);
        froe_answers_free(&all);
    }
    end_query(q), end_query(questions);
    froe_scene_free(scene), froe_scene_free(asked);
}

/* Batches make room for what they have found so far, up to many millions of answers. */
static void batches_have_millions_of_answers(void **state) {
    enum { OBJECTS = 3000, COUNT = 6000 };
    static double boxes[COUNT][4];
    froe_answers all;
    froe_batch_options o = froe_batch_defaults();
    (void)state;
    o.threads = 1;
    froe_query *q = ask(trees_grow(2, FROE_POINT, OBJECTS, 0, 0, "index", 24));
    for (size_t i = 0; i < COUNT; i++) memcpy(boxes[i], (const double[]){0, 0, 1, 1}, sizeof boxes[i]);
    assert_int_equal(froe_batch_boxes(q, boxes[0], COUNT, &o, &all, NULL), FROE_OK);
    for (size_t i = 0; i <= COUNT; i++) assert_int_equal(all.starts[i], i * OBJECTS);
    froe_answers_free(&all);
    end_query(q);
}

/* Rays along each axis and way, which leave the scene at an end that is no number; rays with a far limit. */
static void rays_that_never_end_meet_what_they_meet_before_a_far_end(void **state) {
    (void)state;
    for (int dim = 2; dim <= 3; dim++)
        for (int packed = 0; packed < 2; packed++) {
            const froe_kind kind = dim == 2 ? FROE_SEGMENT : FROE_POLYGON;
            froe_query *q = ask(trees_grow(dim, kind, 300, 0, 0.2, packed ? "index" : "autopartition", 3));
            for (uint64_t i = 0; i < 120; i++) {
                static const double limits[] = {INFINITY, 0x1p1000, 9};
                double ray[6] = {0};
                uint32_t ids[300];
                size_t count = 0;
                for (int k = 0; k < dim; k++) ray[k] = trees_unit(31, 8 * i + (uint64_t)k);
                for (int k = 0; k < dim; k++)
                    ray[dim + k] = i % 3 ? (int)(i / 6) % dim == k ? (i / 3 % 2 ? 1 : -1) : 0
                                         : trees_unit(32, 8 * i + (uint64_t)k) - 0.5;
                for (int walk = 0; walk < FROE_WALK_COUNT; walk++) {
                    froe_list found;
                    froe_range r = froe_range_defaults();
                    r.shape = FROE_SHAPE_RAY, r.points = ray, r.walk = (froe_walk)walk;
                    const froe_status status = froe_query_range(q, &r, &found, NULL);
                    if (status == FROE_E_UNSUPPORTED) continue;
                    assert_int_equal(status, FROE_OK);
                    if (!walk) count = found.count;
                    if (!walk && count) memcpy(ids, found.ids, count * sizeof *ids);
                    assert_same_ids(found.ids, found.count, ids, count);
                }
                for (int l = 0; l < 3; l++) {
                    froe_hits all;
                    froe_hit first;
                    double way[3];
                    for (int k = 0; k < dim; k++) way[k] = ray[dim + k] * (i % 3 ? 1 : 100);
                    assert_int_equal(froe_query_ray_all(q, ray, way, limits[l], &all, NULL), FROE_OK);
                    assert_int_equal(all.count, count);
                    assert_int_equal(froe_query_ray(q, ray, way, limits[l], &first, NULL), FROE_OK);
                    assert_int_equal(first.object != FROE_NONE, count > 0);
                    if (count) assert_true(first.t == all.hits[0].t);
                }
            }
            end_query(q);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(batches_of_windows_without_ends_are_single_questions),
        cmocka_unit_test(batches_of_neighbours_of_points_outside_are_single_questions),
        cmocka_unit_test(chunks_of_questions_without_answers_leave_no_gaps),
        cmocka_unit_test(batches_can_be_cancelled_at_every_call),
        cmocka_unit_test(blocks_that_cannot_be_read_are_told_by_every_question),
        cmocka_unit_test(owners_that_do_not_exist_are_told_by_every_window),
        cmocka_unit_test(opened_trees_of_nothing_have_no_neighbours),
        cmocka_unit_test(sets_with_the_same_tag_are_told_apart),
        cmocka_unit_test(pairs_of_segments_on_one_line_are_told_once),
        cmocka_unit_test(groups_of_one_scene_are_joined_beside_loose_objects),
        cmocka_unit_test(discs_that_touch_windows_are_within_from_inside_only),
        cmocka_unit_test(areas_cover_ranges_without_a_radius),
        cmocka_unit_test(groups_are_found_in_deep_trees_of_oblique_cuts),
        cmocka_unit_test(batches_of_groups_without_borders_are_single_questions),
        cmocka_unit_test(segments_are_found_above_cuts_that_are_not_quite_on_one_line),
        cmocka_unit_test(segments_are_found_across_lines_that_were_made_crooked),
        cmocka_unit_test(segments_between_cuts_of_a_crooked_line_are_found),
        cmocka_unit_test(pairs_that_touch_in_sides_of_cells_are_told_once),
        cmocka_unit_test(windows_of_a_large_map_hold_what_lies_in_them),
        cmocka_unit_test(areas_that_begin_outside_of_the_question_are_not_within),
        cmocka_unit_test(batches_have_millions_of_answers),
        cmocka_unit_test(rays_that_never_end_meet_what_they_meet_before_a_far_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
