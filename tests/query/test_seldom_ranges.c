/* test_seldom_ranges.c: ranges that lead to rare parts of searches, by all walks: cubes on both sides of the origin or
 * as large as numbers allow, cells that refer to others, hulls of many corners, an eps without a margin; and every kind
 * of question without memory. */
#include "asked.h"
#include "support/sanitized.h"
#include <math.h>

/* The scene around the origin, times 2^power: of objects of one kind that have corners alone. */
static froe_scene *around_origin(const froe_scene *from, froe_kind kind, int power) {
    const size_t dim = (size_t)from->dim, count = from->object_count, each = from->corner_count / count;
    double *coords = malloc(from->corner_count * dim * sizeof *coords);
    size_t starts[200];
    froe_scene *scene;
    assert_non_null(coords);
    for (size_t i = 0; i <= count; i++) starts[i] = each * i;
    for (uint32_t c = 0; c < from->corner_count; c++)
        for (size_t k = 0; k < dim; k++)
            coords[c * dim + k] = ldexp(scene_vertex(from, scene_corner_vertex(from, c))[k] - 0.5, power);
    assert_int_equal(froe_scene_new((int)dim, NULL, &scene), FROE_OK);
    assert_int_equal(trees_add(scene, kind, count, coords, NULL, kind == FROE_HULL ? starts : NULL), FROE_OK);
    free(coords);
    return scene;
}

/* All walks, for one and for all, in scenes on both sides of 0; above dimension 3 segments are divided among cubes. */
static void walks_agree_about_one_and_all_around_the_origin(void **state) {
    static const struct {
        int dim;
        froe_kind kind;
        double size;
    } cases[] = {{2, FROE_SEGMENT, 0.2}, {3, FROE_HULL, 0.2}, {4, FROE_SEGMENT, 0.7}, {5, FROE_BOX, 0.5}};
    (void)state;
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++)
        for (int power = 0; power <= 1020; power += 1020) {
            const int dim = cases[c].dim;
            froe_scene *raw = trees_scene(dim, cases[c].kind, 150, 0, cases[c].size, 2), *scene;
            froe_query *q;
            scene = around_origin(raw, cases[c].kind, power);
            q = ask(trees_build(scene, "density", 2));
            for (uint64_t i = 0; i < 40; i++) {
                double box[2 * FROE_MAX_DIM];
                froe_list all[FROE_WALK_COUNT];
                uint32_t ids[200];
                size_t count = 0;
                for (int k = 0; k < dim; k++) {
                    const double at = trees_unit(8, 16 * i + (uint64_t)k) - 0.5;
                    box[k] = ldexp(at, power), box[dim + k] = ldexp(at + (i % 4 ? 0.25 : 0.75), power);
                }
                for (int walk = 0; walk < FROE_WALK_COUNT; walk++) {
                    uint32_t one = FROE_NONE;
                    froe_range r = froe_range_defaults();
                    r.points = box, r.walk = (froe_walk)walk;
                    const froe_status status = froe_query_range(q, &r, &all[walk], NULL);
                    if (status == FROE_E_UNSUPPORTED) continue;
                    assert_int_equal(status, FROE_OK);
                    if (!walk) count = all[0].count, memcpy(ids, all[0].ids, count * sizeof *ids);
                    assert_same_ids(all[walk].ids, all[walk].count, ids, count);
                    assert_int_equal(froe_query_any(q, &r, &one, NULL), FROE_OK);
                    assert_int_equal(one != FROE_NONE, count > 0);
                }
            }
            end_query(q);
            froe_scene_free(raw), froe_scene_free(scene);
        }
}

/* So many large boxes that cells refer to theirs, smaller ones within, and smaller ones within these. */
static void classes_refer_to_large_cells_across_small_ones(void **state) {
    enum { LARGE = 700, COUNT = LARGE + 20 };
    static double boxes[COUNT][4];
    froe_scene *scene;
    (void)state;
    for (size_t i = 0; i < COUNT; i++) {
        const double half = i < LARGE ? 0.4 + 1e-4 * (double)i : i < LARGE + 10 ? 0.06 : 0.004;
        const double x = i < LARGE ? 0.5 : 0.46 + 0.01 * (double)(i % 10),
                     box[] = {x - half, x - half, x + half, x + half};
        memcpy(boxes[i], box, sizeof box);
    }
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_BOX, COUNT, boxes[0], NULL, NULL), FROE_OK);
    froe_query *q = ask(trees_build(scene, "density", 4));
    for (uint64_t i = 0; i < 200; i++) {
        const double x = trees_unit(41, 2 * i), y = trees_unit(41, 2 * i + 1), size = i % 4 ? 0.01 : 0.2;
        const double box[] = {x, y, x + size, y + size};
        uint32_t expected[COUNT];
        size_t count = 0;
        for (uint32_t b = 0; b < COUNT; b++)
            if (boxes[b][0] <= box[2] && box[0] <= boxes[b][2] && boxes[b][1] <= box[3] && box[1] <= boxes[b][3])
                expected[count++] = b;
        for (int walk = 0; walk < FROE_WALK_COUNT; walk++) {
            froe_list found;
            froe_range r = froe_range_defaults();
            r.points = box, r.walk = (froe_walk)walk;
            const froe_status status = froe_query_range(q, &r, &found, NULL);
            if (status == FROE_E_UNSUPPORTED) continue;
            assert_same_ids(found.ids, found.count, expected, count);
            uint32_t one = FROE_NONE;
            bool is_one = !count;
            assert_int_equal(froe_query_any(q, &r, &one, NULL), FROE_OK);
            for (size_t k = 0; k < count; k++) is_one = is_one || expected[k] == one;
            assert_true(is_one);
        }
    }
    end_query(q);
    froe_scene_free(scene);
}

/* A triangle as halfspaces finds what it finds as a simplex, also of hulls with more corners than a word has bits. */
static void halfspaces_find_hulls_of_many_corners(void **state) {
    enum { HULLS = 60, CORNERS = 100 };
    static double coords[HULLS * CORNERS][2];
    static const double corners[] = {0.2, 0.2, 0.8, 0.2, 0.2, 0.8}, normals[] = {-1, 0, 0, -1, 1, 1};
    static const double offsets[] = {-0.2, -0.2, 1};
    size_t starts[HULLS + 1];
    froe_scene *scene;
    (void)state;
    for (size_t i = 0; i < HULLS * CORNERS; i++) {
        const size_t h = i / CORNERS;
        const double t = 6.283185307179586 * (double)(i % CORNERS) / CORNERS, r = h % 3 ? 0.05 : 0.3 + 0.02 * (double)h;
        coords[i][0] = trees_unit(51, 2 * h) + r * cos(t), coords[i][1] = trees_unit(51, 2 * h + 1) + r * sin(t);
    }
    for (size_t h = 0; h <= HULLS; h++) starts[h] = h * CORNERS;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_HULL, HULLS, coords[0], NULL, starts), FROE_OK);
    froe_query *q = ask(trees_build(scene, "density", 2));
    froe_list found;
    uint32_t ids[HULLS];
    froe_range r = froe_range_defaults();
    r.shape = FROE_SHAPE_SIMPLEX, r.points = corners;
    assert_int_equal(froe_query_range(q, &r, &found, NULL), FROE_OK);
    const size_t count = found.count;
    assert_true(count > 10 && count < HULLS);
    memcpy(ids, found.ids, count * sizeof *ids);
    r.shape = FROE_SHAPE_HALFSPACES, r.points = normals, r.offsets = offsets, r.count = 3;
    assert_int_equal(froe_query_range(q, &r, &found, NULL), FROE_OK);
    assert_same_ids(found.ids, found.count, ids, count);
    end_query(q);
    froe_scene_free(scene);
}

/* An eps whose margin is no number, or that of a range without inside, adds nothing; an infinite one is refused. */
static void an_eps_without_a_margin_adds_nothing(void **state) {
    static const double cube[8][4] = {{1, 0, 0, 0}, {-1, 0, 0, 0}, {0, 1, 0, 0}, {0, -1, 0, 0},
                                      {0, 0, 1, 0}, {0, 0, -1, 0}, {0, 0, 0, 1}, {0, 0, 0, -1}};
    static const double half[] = {0.5, 0, 0.5, 0, 0.5, 0, 0.5, 0}, flat[] = {0.5, -0.5, 0.5, 0, 0.5, 0, 0.5, 0};
    static const double apart[] = {0, -1, 0, -1, 0, -1, 0, -1}, huge[8] = {-64, -64, -64, -64, 0.5, 0.5, 0.5, 0.5};
    static const double wide[] = {0.5, 64, 0.5, 64, 0.5, 64, 0.5, 64};
    (void)state;
    for (int tree = 0; tree < 3; tree++)
        for (int which = 1; which < 7; which++) {
            const size_t objects = tree ? 80 : 0;
            froe_query *q = ask(tree < 2 ? trees_grow(4, FROE_BOX, objects, 0, 0.9, "density", 2)
                                         : trees_grow(4, FROE_POINT, objects, 0, 0, "kd", 1));
            froe_list found;
            size_t count = 0;
            for (int eps = 0; eps < 2; eps++) {
                froe_range r = froe_range_defaults();
                r.shape = which != 5 ? FROE_SHAPE_HALFSPACES : FROE_SHAPE_BOX;
                r.points = which != 5 ? cube[0] : huge;
                r.offsets = which == 1 ? flat : which == 2 || which == 3 ? apart : which == 6 ? wide : half;
                r.count = which == 3 ? 2 : 8;
                r.eps = !eps ? 0 : which >= 5 ? 0x1p1023 : 0.125;
                if (which == 4) r.eps = eps ? INFINITY : 0;
                const froe_status status = froe_query_range(q, &r, &found, NULL);
                assert_int_equal(status, which == 4 && eps ? FROE_E_INPUT : FROE_OK);
                if (status) continue;
                if (!eps) count = found.count;
                assert_int_equal(found.count, count);
            }
            size_t met = 0;
            for (uint32_t i = 0; i < objects && which != 2 && which != 3; i++) {
                double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
                bool meets = true;
                scene_object_bounds(q->tree->scene, i, lo, hi);
                for (int k = 0; k < 4; k++)
                    meets = meets && lo[k] <= 0.5 && hi[k] >= (which >= 5 ? -64 : which == 1 && k == 0 ? 0.5 : 0);
                met += meets;
            }
            assert_int_equal(count, met);
            end_query(q);
        }
}

/* A segment to the largest double, past which its rounded bounds reach, in a deep tree: all walks find the same. */
static void segments_may_end_at_the_largest_double(void **state) {
    (void)state;
    froe_query *q = ask(trees_grow(2, FROE_SEGMENT, 4000, 0, 0.02, "kd", 1));
    size_t count = 0;
    for (int axis = 0; axis < 2; axis++)
        for (int walk = 0; walk < FROE_WALK_COUNT; walk++) {
            double ends[4] = {0.1, 0.1, 0.1, 0.1};
            froe_list found;
            froe_range r = froe_range_defaults();
            ends[axis] = 0, ends[2 + axis] = 0x1.fffffffffffffp1023;
            r.shape = FROE_SHAPE_SEGMENT, r.points = ends, r.walk = (froe_walk)walk;
            const froe_status status = froe_query_range(q, &r, &found, NULL);
            if (status == FROE_E_UNSUPPORTED) continue;
            assert_int_equal(status, FROE_OK);
            if (!walk) count = found.count;
            assert_true(found.count > 10);
            assert_int_equal(found.count, count);
        }
    end_query(q);
}

/* Boxes one in the other, of all sizes up to one that reaches as far as doubles do, in five dimensions: the cell around
 * a small range has one of them already, and refers to others. */
static void one_of_many_boxes_around_a_small_range_is_enough(void **state) {
    enum { BOXES = 40 };
    (void)state;
    for (int dim = 2; dim <= 5; dim += 3) {
        froe_scene *scene;
        assert_int_equal(froe_scene_new(dim, NULL, &scene), FROE_OK);
        for (int i = 0; i < BOXES; i++) {
            double box[2 * FROE_MAX_DIM];
            for (int k = 0; k < dim; k++) {
                const double r = i ? ldexp(1, 8 - i) : 0x1.fffffffffffffp1023;
                box[k] = i ? 1.0 / 3 - r : -r, box[dim + k] = i ? 1.0 / 3 + r : r;
            }
            assert_int_equal(trees_add(scene, FROE_BOX, 1, box, NULL, NULL), FROE_OK);
        }
        froe_query *q = ask(trees_build(scene, "density", 4));
        for (int size = 0; size < BOXES; size++) {
            double box[2 * FROE_MAX_DIM];
            froe_list found;
            uint32_t one = FROE_NONE;
            froe_range r = froe_range_defaults();
            for (int k = 0; k < dim; k++) box[k] = box[dim + k] = 1.0 / 3 + ldexp(0.75, 8 - size);
            r.points = box, r.walk = FROE_WALK_CLASSES;
            assert_int_equal(froe_query_range(q, &r, &found, NULL), FROE_OK);
            assert_int_equal(found.count, size ? size + 1 : 1);
            assert_int_equal(froe_query_any(q, &r, &one, NULL), FROE_OK);
            assert_true(one <= (uint32_t)size);
        }
        end_query(q);
        froe_scene_free(scene);
    }
}

/* A ball that is listed on both sides of a cut, although it is on one of them, and one that is on the other. */
static void one_is_found_behind_what_is_listed_and_is_not_there(void **state) {
    static const tree_meta meta = {.method = "by hand", .leaf = 2};
    static const double centres[4] = {5, 0, -0.5, 0}, radii[2] = {0.125, 0.125}, left[4] = {-2, -2, -0.25, 2};
    static const froe_cut cut = {.kind = FROE_CUT_AXIS, .value = -0.25};
    (void)state;
    for (uint32_t balls = 1; balls <= 2; balls++)
        for (int walk = 0; walk < 3; walk++) {
            froe_scene *scene;
            tree_draft draft;
            froe_tree *tree;
            uint32_t child, one = 0;
            froe_range r = froe_range_defaults();
            assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
            assert_int_equal(trees_add(scene, FROE_BALL, balls, centres, radii, NULL), FROE_OK);
            assert_int_equal(draft_new(NULL, 2, 0, &draft), FROE_OK);
            assert_int_equal(draft_split(&draft, 0, &cut, 0, &child), FROE_OK);
            for (uint32_t side = 0; side < 2; side++) {
                draft_leaf(&draft, child + side, 0);
                assert_int_equal(draft_list(&draft, child + side), FROE_OK);
                for (uint32_t i = 0; i < (side ? 1 : balls); i++)
                    assert_int_equal(draft_piece(&draft, child + side, i, NULL, 0), FROE_OK);
            }
            assert_int_equal(draft_seal(&draft, NULL, 0, scene, &meta, &tree), FROE_OK);
            draft_free(&draft), froe_scene_free(scene);
            froe_query *q = ask(tree);
            r.points = left, r.walk = (froe_walk)walk;
            assert_int_equal(froe_query_any(q, &r, &one, NULL), FROE_OK);
            assert_int_equal(one, balls == 2 ? 1 : FROE_NONE);
            end_query(q);
        }
}

/* One is found if there is any: also where a range holds a whole cell, and the first that are listed there are not. */
static void one_is_found_where_any_is(void **state) {
    static const struct {
        const char *method;
        froe_kind kind;
        uint32_t leaf;
        double size;
    } cases[] = {{"index", FROE_POLYGON, 6, 0.3}, {"density", FROE_BALL, 2, 0.2}, {"density", FROE_HULL, 2, 0.3}};
    (void)state;
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        froe_query *q = ask(trees_grow(3, cases[c].kind, 120, 0, cases[c].size, cases[c].method, cases[c].leaf));
        size_t counts[2] = {0, 0};
        for (uint64_t i = 0; i < 4000; i++) {
            double box[6];
            froe_list found;
            uint32_t one = FROE_NONE;
            froe_range r = froe_range_defaults();
            for (int k = 0; k < 3; k++) {
                box[k] = trees_unit(8, 6 * i + (uint64_t)k) * 1.2 - 0.1;
                box[3 + k] = box[k] + 0.5 * pow(trees_unit(9, 6 * i), 2) * trees_unit(9, 6 * i + 1 + (uint64_t)k);
            }
            r.points = box, r.walk = (froe_walk)(i % 3);
            assert_int_equal(froe_query_range(q, &r, &found, NULL), FROE_OK);
            const size_t count = found.count;
            assert_int_equal(froe_query_any(q, &r, &one, NULL), FROE_OK);
            assert_int_equal(one != FROE_NONE, count > 0);
            counts[count > 0]++;
        }
        assert_true(counts[0] > 100 && counts[1] > 100);
        end_query(q);
    }
}

/* --------------------------------------------------------------------------- memory -- */

/* A square as four segments, and twice as sixteen a side: whole, and without the first part of each side. */
static froe_scene *parted_squares(void) {
    enum { PARTS = 8 };
    froe_scene *scene;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    for (int g = 0; g < 3; g++) {
        const uint32_t group = add_group(scene);
        const int parts = g ? PARTS : 1;
        for (int side = 0; side < 4; side++)
            for (int i = g == 2; i < parts; i++) {
                double ends[4];
                for (int end = 0; end < 2; end++) {
                    const double t = 16.0 * (i + end) / parts;
                    ends[2 * end] = side == 0 ? t : side == 1 ? 16 : side == 2 ? 16 - t : 0;
                    ends[2 * end + 1] = side == 0 ? 0 : side == 1 ? t : side == 2 ? 16 : 16 - t;
                }
                add_to(scene, group, FROE_SEGMENT, 1, ends, NULL);
            }
    }
    return scene;
}

enum { QUESTIONS = 14 };
typedef struct asking {
    const froe_tree *tree;
    int which;
    bool asked;
    size_t found; /* by the first call */
} asking;

/* Each question by a context of its own, so that its arrays are small. */
static froe_status ask_alone(void *user, const froe_allocator *alloc) {
    static const double box[10] = {0.125, 0.125, 0.875, 0.875, 0.9, 0.9, 0.5, 0.5, 0.25, 0.75};
    static const double x[4] = {0.5, 0.5, 0.5, 0.5}, way[4] = {0.25, 1, 0.5, 0.125};
    static const froe_range_shape shapes[] = {FROE_SHAPE_SIMPLEX, FROE_SHAPE_CAPSULE, FROE_SHAPE_HULL};
    asking *a = user;
    froe_tree tree = *a->tree;
    const int dim = tree.scene->dim, which = a->which;
    const size_t groups = dim == 2 && tree.scene->group_count;
    froe_query *q;
    froe_list found = {NULL, 0};
    froe_neighbours near = {NULL, 0};
    froe_hits hits = {NULL, 0};
    uint32_t object = 0;
    froe_answers many = {NULL, NULL, NULL, 0, *alloc};
    froe_range r = froe_range_defaults();
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM], all[2 * FROE_MAX_DIM], simplex[FROE_MAX_DIM * (FROE_MAX_DIM + 1)];
    double normals[2 * FROE_MAX_DIM * FROE_MAX_DIM] = {0}, offsets[2 * FROE_MAX_DIM];
    tree.alloc = *alloc;
    froe_status status = froe_query_new(&tree, &q, NULL);
    if (status) return status;
    froe_scene_bounds(tree.scene, lo, hi);
    for (int k = 0; k < dim; k++) all[k] = lo[k], all[dim + k] = hi[k];
    for (int i = 0; i <= dim; i++)
        for (int k = 0; k < dim; k++) simplex[i * dim + k] = lo[k] + (hi[k] - lo[k]) * box[(3 * i + 7 * k) % 10];
    r.points = all;
    if (which == 1) r.walk = FROE_WALK_CLASSES;
    if (which >= 2 && which < 5)
        r.shape = shapes[which - 2], r.points = simplex, r.radius = 0.1, r.count = (size_t)dim + 1, r.eps = 0.01;
    if (which == 13) { /* the box of the scene, with an eps */
        for (int k = 0; k < dim; k++) {
            normals[k * dim + k] = 1, normals[(dim + k) * dim + k] = -1;
            offsets[k] = hi[k], offsets[dim + k] = -lo[k];
        }
        r.shape = FROE_SHAPE_HALFSPACES, r.points = normals, r.offsets = offsets, r.count = 2 * (size_t)dim;
        r.eps = 0.01;
    }
    if (which < 5 || which == 13) status = froe_query_range(q, &r, &found, NULL);
    if (status == FROE_E_UNSUPPORTED) status = FROE_OK;
    if (which == 5) status = froe_query_near(q, x, 9, INFINITY, &near, NULL);
    if (which == 6 && dim <= 3) status = froe_query_ray_all(q, x, way, INFINITY, &hits, NULL);
    if (which == 7) status = froe_query_locate(q, x, &found, NULL);
    if (which == 8 && dim == 2) status = froe_query_vertical(q, x, 1, &object, NULL);
    if (which == 9 && groups) status = froe_query_groups(q, simplex, &found, NULL);
    if (which >= 10 && which < 13 && groups)
        status = froe_batch_groups_join(q, q, (froe_relation)(which - 10), NULL, &many, NULL);
    if (!status) {
        const size_t sum =
            found.count + near.count + hits.count + object + (many.starts ? many.starts[many.queries] : 0);
        if (!a->asked) a->found = sum;
        a->asked = true;
        assert_int_equal(sum, a->found);
        if (many.starts) froe_answers_free(&many);
    }
    froe_query_free(q);
    return status;
}

static void any_question_may_lack_memory(void **state) {
    (void)state;
    froe_scene *scenes[] = {areas(),
                            parted_squares(),
                            trees_scene(2, FROE_SEGMENT, 30, 0, 0.2, 1),
                            trees_scene(3, FROE_POLYGON, 30, 0, 0.3, 1),
                            trees_scene(2, FROE_BOX, 30, 0, 0.7, 1),
                            trees_scene(2, FROE_POINT, 100, 0, 0, 1),
                            trees_scene(4, FROE_HULL, 10, 0, 0.7, 1)};
    static const char *const methods[][2] = {
        {"index", "autopartition"}, {"index", "autopartition"}, {"index", "autopartition"}, {"index", "autopartition"},
        {"density", "density"},     {"index", "density"},       {"density", "density"}};
    for (size_t s = 0; s < sizeof scenes / sizeof *scenes; s++) {
        for (size_t m = SANITIZED ? s % 2 : 0; m < (SANITIZED ? s % 2 + 1 : 2); m++) {
            froe_tree *tree = trees_build(scenes[s], methods[s][m], m ? 1 : 3);
            size_t refused = 0;
            for (int which = 0; which < QUESTIONS; which++) {
                asking a = {.tree = tree, .which = which};
                refused += test_memory_each(ask_alone, &a);
            }
            assert_true(refused > 20);
            froe_tree_free(tree);
        }
        froe_scene_free(scenes[s]);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(walks_agree_about_one_and_all_around_the_origin),
        cmocka_unit_test(classes_refer_to_large_cells_across_small_ones),
        cmocka_unit_test(halfspaces_find_hulls_of_many_corners),
        cmocka_unit_test(an_eps_without_a_margin_adds_nothing),
        cmocka_unit_test(segments_may_end_at_the_largest_double),
        cmocka_unit_test(one_of_many_boxes_around_a_small_range_is_enough),
        cmocka_unit_test(one_is_found_behind_what_is_listed_and_is_not_there),
        cmocka_unit_test(one_is_found_where_any_is),
        cmocka_unit_test(any_question_may_lack_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
