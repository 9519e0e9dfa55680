/* test_memory.c: memory that runs out in the middle of a search, when what it keeps has to grow: many groups at one
 * point, many covers of one cell, many nodes that wait. Each allocation fails once, and for ever from there on; what is
 * answered is what is answered undisturbed. */
#include "asked.h"
#include "query/questions.h"
#include "query/range/centroids.h"

enum { MANY = 18 }; /* arrays begin with room for 16 items */

/* Triangles that are groups, all with a corner in (0.5, 0.5), and as many balls around it. */
static froe_scene *fan(bool balls) {
    static const double middle[2] = {0.5, 0.5};
    froe_scene *scene;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    for (int i = 0; i < MANY; i++) {
        const double turn = 0.25 * i, far = 0.2 + 0.01 * i, radius = 0.1 + 0.012 * i;
        const double a[2] = {0.5 + far * cos(turn), 0.5 + far * sin(turn)};
        const double b[2] = {0.5 + far * cos(turn + 0.7), 0.5 + far * sin(turn + 0.7)};
        const double ring[12] = {0.5, 0.5, a[0], a[1], a[0], a[1], b[0], b[1], b[0], b[1], 0.5, 0.5};
        add_to(scene, add_group(scene), FROE_SEGMENT, 3, ring, NULL);
        if (balls) add_to(scene, add_group(scene), FROE_BALL, 1, middle, &radius);
    }
    return scene;
}

/* Boxes one in the other: most are covers. */
static froe_scene *nested(void) {
    froe_scene *scene;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    for (int i = 0; i < MANY; i++) {
        const double r = 0.02 * (i + 1), box[4] = {0.5 - r, 0.5 - r, 0.5 + r, 0.5 + r};
        add_to(scene, add_group(scene), FROE_BOX, 1, box, NULL);
    }
    return scene;
}

/* Triangles around one point, each with the sides of its neighbours: most borders are those of two groups. */
static froe_scene *shared_fan(void) {
    froe_scene *scene;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    for (int i = 0; i < 2 * MANY; i++) {
        double c[2][2];
        for (int end = 0; end < 2; end++) {
            const double turn = 6.283185307179586 * ((i + end) % (2 * MANY)) / (2 * MANY);
            c[end][0] = 0.5 + 0.4 * cos(turn), c[end][1] = 0.5 + 0.4 * sin(turn);
        }
        const double ring[12] = {0.5,     0.5,     c[0][0], c[0][1], c[0][0], c[0][1],
                                 c[1][0], c[1][1], c[1][0], c[1][1], 0.5,     0.5};
        add_to(scene, add_group(scene), FROE_SEGMENT, 3, ring, NULL);
    }
    return scene;
}

/* Adds a ring of segments as a group. */
static void add_ring(froe_scene *scene, const double (*corners)[2], size_t count) {
    const uint32_t group = add_group(scene);
    for (size_t i = 0; i < count; i++) {
        const double *u = corners[i], *v = corners[(i + 1) % count], ends[4] = {u[0], u[1], v[0], v[1]};
        add_to(scene, group, FROE_SEGMENT, 1, ends, NULL);
    }
}

/* Triangles on both sides of lines through one point, but for one side of the first line: where there is room for one
 * more group, it is taken by the first of a border's two. */
static froe_scene *star(void) {
    froe_scene *scene;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    for (int i = 0; i < MANY; i++) {
        const double p = (MANY - i) / 64.0, q = (i + 1) / 64.0, a[2] = {0.5 - p, 0.5 - q}, b[2] = {0.5 + p, 0.5 + q};
        add_ring(scene, (const double[][2]){{a[0], a[1]}, {b[0], b[1]}, {0.5 - q, 0.5 + p}}, 3);
        if (i) add_ring(scene, (const double[][2]){{b[0], b[1]}, {a[0], a[1]}, {0.5 + q, 0.5 - p}}, 3);
    }
    return scene;
}

/* Squares one in the other around all that is asked for. */
static froe_scene *rings(void) {
    froe_scene *scene;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    for (int i = 0; i < MANY; i++) {
        const double lo = -0.1 - 0.01 * i, hi = 1.1 + 0.01 * i;
        add_ring(scene, (const double[][2]){{lo, lo}, {hi, lo}, {hi, hi}, {lo, hi}}, 4);
    }
    return scene;
}

/* A square around small triangles, a comb of many sides on one line, and triangles with a longer side on that line. */
static froe_scene *yard(void) {
    enum { TEETH = 20 };
    double comb[TEETH + 3][2];
    froe_scene *scene;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    add_ring(scene, (const double[][2]){{-0.1, -0.1}, {1.1, -0.1}, {1.1, 1.1}, {-0.1, 1.1}}, 4);
    for (int i = 0; i < MANY; i++) {
        const double x = 0.05 * i, y = 0.8;
        add_ring(scene, (const double[][2]){{x, y}, {x + 0.01, y}, {x, y + 0.01}}, 3);
    }
    for (int i = 0; i <= TEETH; i++) comb[i][0] = 0.25 + i / 40.0, comb[i][1] = 0.25;
    comb[TEETH + 1][0] = 0.75, comb[TEETH + 2][0] = 0.25, comb[TEETH + 1][1] = comb[TEETH + 2][1] = 0.5;
    add_ring(scene, (const double(*)[2])comb, TEETH + 3);
    for (int i = 0; i < 2; i++) /* beginning before the comb, or in its first side */
        add_ring(scene, (const double[][2]){{i ? 0.26 : 0.125, 0.25}, {0.875, 0.25}, {0.5, 0.375}}, 3);
    return scene;
}

/* Points each half as far from the corner as the one before: in cubes one in the other. */
static froe_tree *halving(void) {
    froe_scene *scene;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    for (int i = 0; i < 40; i++) {
        const double x[2] = {0.125 + ldexp(0.25, -i), 0.125 + ldexp(0.25, -i)};
        add_to(scene, FROE_NONE, FROE_POINT, 1, x, NULL);
    }
    froe_tree *tree = trees_build(scene, "kd", 1);
    froe_scene_free(scene);
    return tree;
}

static const tree_meta meta = {.method = "by hand", .leaf = 1};

/* Points in a row, or segments one above the other, below cuts between them or through them: each cut takes off the
 * last one, so that all of them wait where the first is asked for. */
static froe_tree *chain(froe_kind kind) {
    enum { DEPTH = 40 };
    froe_scene *scene;
    tree_draft draft;
    froe_tree *tree;
    uint32_t node = 0, child;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    assert_int_equal(draft_new(NULL, 2, 0, &draft), FROE_OK);
    for (int i = 0; i <= DEPTH; i++) {
        const double y = (i + 1) * 0.0625, at[4] = {kind == FROE_POINT ? y + 0x1p-5 : 0, y, 1, y};
        assert_int_equal(trees_add(scene, kind, 1, at, NULL, NULL), FROE_OK);
    }
    if (kind == FROE_SEGMENT) { /* one cut without a list */
        const froe_cut cut = {.kind = FROE_CUT_AXIS, .axis = 1, .value = (DEPTH + 0.5) * 0.0625};
        assert_int_equal(draft_split(&draft, node, &cut, 0, &child), FROE_OK);
        assert_int_equal(draft_list(&draft, child + 1), FROE_OK);
        assert_int_equal(draft_piece(&draft, child + 1, DEPTH, NULL, 0), FROE_OK);
        node = child;
    }
    for (uint32_t i = DEPTH + (kind == FROE_POINT); i-- > 0; node = child) {
        const froe_cut across = {.kind = FROE_CUT_AXIS, .value = (i + 1) * 0.0625},
                       along = {.kind = FROE_CUT_OBJECT, .id = {i}};
        assert_int_equal(draft_split(&draft, node, kind == FROE_POINT ? &across : &along, 0, &child), FROE_OK);
        const uint32_t lists = kind == FROE_POINT ? child + 1 : node;
        assert_int_equal(draft_list(&draft, lists), FROE_OK);
        assert_int_equal(draft_piece(&draft, lists, i, NULL, 0), FROE_OK);
    }
    assert_int_equal(draft_seal(&draft, NULL, 0, scene, &meta, &tree), FROE_OK);
    assert_int_equal(froe_tree_audit(tree, NULL, NULL), FROE_OK);
    draft_free(&draft);
    froe_scene_free(scene);
    return tree;
}

typedef struct asking {
    const froe_tree *tree;
    int question;
    told expected;
} asking;

/* Everything of that many neighbours, which wait in large numbers. */
static froe_status ask_all_neighbours(froe_query *q, told *t) {
    static const double x[FROE_MAX_DIM] = {0.4, 0.6, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5};
    froe_neighbours near;
    const froe_status status = froe_query_near(q, x, q->tree->scene->object_count, INFINITY, &near, NULL);
    for (size_t i = 0; !status && i < near.count; i++) tell(t, &near.items[i].distance, sizeof(double));
    return status;
}

/* What lies at the point where all meet, asked first of a context of its own. */
static froe_status ask_middle(froe_query *q, told *t) {
    static const double x[FROE_MAX_DIM] = {0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5};
    froe_list list;
    froe_status status = froe_query_groups(q, x, &list, NULL);
    tell_list(t, status, &list);
    if (!status || status == FROE_E_UNSUPPORTED) status = froe_query_locate(q, x, &list, NULL);
    tell_list(t, status, &list);
    return status;
}

/* A window around most objects, among cubes of all sizes. */
static froe_status ask_cubes(froe_query *q, told *t) {
    double box[2 * FROE_MAX_DIM];
    froe_list list;
    froe_range r = froe_range_defaults();
    const int dim = q->tree->scene->dim;
    for (int k = 0; k < dim; k++) box[k] = 0.01 + 0.01 * k, box[dim + k] = 0.9 - 0.01 * k;
    r.points = box, r.walk = FROE_WALK_CLASSES;
    const froe_status status = froe_query_range(q, &r, &list, NULL);
    tell_list(t, status, &list);
    return status;
}

/* All that a ray up from below meets. */
static froe_status ask_ray_up(froe_query *q, told *t) {
    static const double from[2] = {0.5, -1}, up[2] = {0, 1};
    froe_hits all;
    const froe_status status = froe_query_ray_all(q, from, up, INFINITY, &all, NULL);
    for (size_t h = 0; !status && h < all.count; h++) tell(t, &all.hits[h].object, sizeof all.hits[h].object);
    return status;
}

/* The groups around a small box. */
static froe_status ask_covers(froe_query *q, told *t) {
    static const double box[4] = {0.5, 0.5, 0.6, 0.6};
    froe_list list;
    froe_range r = froe_range_defaults();
    r.points = box;
    const froe_status status = froe_query_groups_range(q, &r, FROE_COVERS, &list, NULL);
    tell_list(t, status, &list);
    return status;
}

/* The groups that each group meets, and that lie in it. */
static froe_status ask_groups_of_groups(froe_query *q, told *t) {
    froe_answers a;
    const froe_batch_options o = on_one_thread();
    froe_status status = FROE_OK;
    for (froe_relation r = FROE_MEETS; r <= FROE_WITHIN && !status; r++) {
        status = froe_batch_groups_join(q, q, r, &o, &a, NULL);
        tell_answers(t, status, &a);
    }
    return status;
}

/* How many segments reach a window whose side touches all of them, or just does not: units decide none of them. */
static froe_status ask_count_along(froe_query *q, told *t) {
    static const double sides[] = {0.5, 0x1.0000000000001p-1};
    froe_range r = froe_range_defaults();
    froe_status status = FROE_OK;
    for (int i = 0; i < 2 && !status; i++) {
        const double box[4] = {-1, sides[i], 2, 0.75};
        uint64_t count = 0;
        r.points = box;
        status = froe_query_count(q, &r, &count, NULL);
        if (!status) assert_int_equal(count, i ? 0 : q->tree->scene->object_count);
        tell(t, &count, sizeof count);
    }
    return status;
}

/* What has no number among the questions: those after them. */
static froe_status (*const others[])(froe_query *q, told *t) = {
    ask_all_neighbours, ask_middle, ask_cubes, ask_ray_up, ask_covers, ask_groups_of_groups, ask_count_along};
enum { ALL_NEIGHBOURS = QUESTIONS, MIDDLE, CUBES, RAY_UP, COVERS, GROUPS, COUNT_ALONG };

static froe_status ask_with(void *user, const froe_allocator *alloc) {
    asking *a = user;
    froe_tree tree = *a->tree;
    froe_query *q = NULL;
    told t = 1;
    tree.alloc = *alloc;
    froe_status status = froe_query_new(&tree, &q, NULL);
    if (status) return status;
    status = a->question < QUESTIONS ? ask_question(q, a->question, &t) : others[a->question - QUESTIONS](q, &t);
    if (!status && !a->expected) a->expected = t;
    if (!status) assert_true(t == a->expected);
    froe_query_free(q);
    return status;
}

static void ask_this(froe_tree *tree, int question) {
    assert_true(test_memory_each(ask_with, &(asking){tree, question, 0}) > 5);
    froe_tree_free(tree);
}

static void ask_everything(froe_tree *tree, int step) {
    size_t calls = 0;
    for (int question = 0; question < CUBES; question++)
        if (question < QUESTIONS_PLAIN || question >= QUESTIONS || question % step == 0)
            calls += test_memory_each(ask_with, &(asking){tree, question, 0});
    assert_true(calls > 200);
    froe_tree_free(tree);
}

static void memory_may_end_among_many_groups(void **state) {
    (void)state;
    for (int balls = 0; balls < 2; balls++) {
        froe_scene *scene = fan(balls);
        ask_everything(trees_build(scene, balls ? "density" : "index", 4), 29);
        ask_everything(trees_build(scene, balls ? "kd" : "autopartition", 1), 29);
        froe_scene_free(scene);
    }
}

static void memory_may_end_among_many_areas(void **state) {
    static const struct {
        froe_scene *(*make)(void);
        const char *method;
        int leaf, question;
    } cases[] = {{shared_fan, "kd", 200, MIDDLE},
                 {star, "kd", 200, MIDDLE},
                 {rings, "kd", 1, COVERS},
                 {yard, "autopartition", 4, GROUPS}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        froe_scene *scene = cases[i].make();
        ask_this(trees_build(scene, cases[i].method, (uint32_t)cases[i].leaf), cases[i].question);
        froe_scene_free(scene);
    }
}

static void memory_may_end_among_many_covers(void **state) {
    (void)state;
    froe_scene *scene = nested();
    ask_everything(trees_build(scene, "density", 4), 29);
    froe_scene_free(scene);
}

static void memory_may_end_where_many_nodes_wait(void **state) {
    (void)state;
    ask_everything(trees_grow(2, FROE_POINT, 80, 0, 0, "kd", 1), 29);
    ask_everything(trees_grow(2, FROE_SEGMENT, 40, 0, 0.5, "autopartition", 1), 29);
    ask_everything(trees_grow(3, FROE_POLYGON, 16, 0, 0.5, "autopartition", 1), 29);
    ask_everything(trees_grow(3, FROE_POLYGON, 80, 0, 0.5, "index", 2), 29);
    ask_everything(trees_grow(6, FROE_BOX, 20, 0, 0.5, "density", 1), 11);
    ask_this(halving(), CUBES);
    ask_this(trees_grow(2, FROE_SEGMENT, 400, 0, 0.05, "index", 6), ALL_NEIGHBOURS);
    ask_this(chain(FROE_POINT), ALL_NEIGHBOURS);
    ask_this(chain(FROE_SEGMENT), RAY_UP);
}

/* More segments are in doubt than any leaf has. */
static void memory_may_end_where_much_is_in_doubt(void **state) {
    (void)state;
    froe_scene *scene;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    for (int i = 0; i < 400; i++) {
        const double ends[4] = {i / 400.0, 0.5 - i % 7 / 64.0, (i + 0.5) / 400, 0.5};
        add_to(scene, FROE_NONE, FROE_SEGMENT, 1, ends, NULL);
    }
    ask_this(trees_build(scene, "index", 6), COUNT_ALONG);
    froe_scene_free(scene);
}

/* A point is found by the centroids of the tree, for which memory is asked first. */
static void memory_may_end_while_centroids_are_made(void **state) {
    (void)state;
    froe_tree *tree = chain(FROE_POINT);
    assert_true(query_is_deep(tree));
    ask_this(tree, MIDDLE);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(memory_may_end_among_many_groups),
        cmocka_unit_test(memory_may_end_among_many_areas),
        cmocka_unit_test(memory_may_end_among_many_covers),
        cmocka_unit_test(memory_may_end_where_many_nodes_wait),
        cmocka_unit_test(memory_may_end_where_much_is_in_doubt),
        cmocka_unit_test(memory_may_end_while_centroids_are_made),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
