/* test_memory.c: memory that runs out in the middle of a search, when what it keeps has to grow: many groups at one
 * point, many covers of one cell, many nodes that wait. Each allocation fails once, and for ever from there on; what is
 * answered is what is answered undisturbed. */
#include "asked.h"
#include "query/questions.h"

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

static froe_status ask_with(void *user, const froe_allocator *alloc) {
    asking *a = user;
    froe_tree tree = *a->tree;
    froe_query *q = NULL;
    told t = 1;
    tree.alloc = *alloc;
    froe_status status = froe_query_new(&tree, &q, NULL);
    if (status) return status;
    status = a->question == QUESTIONS       ? ask_all_neighbours(q, &t)
             : a->question == QUESTIONS + 1 ? ask_middle(q, &t)
                                            : ask_question(q, a->question, &t);
    if (!status && !a->expected) a->expected = t;
    if (!status) assert_true(t == a->expected);
    froe_query_free(q);
    return status;
}

static void ask_everything(froe_tree *tree, int step) {
    size_t calls = 0;
    for (int question = 0; question < QUESTIONS + 2; question++)
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
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(memory_may_end_among_many_groups),
        cmocka_unit_test(memory_may_end_among_many_covers),
        cmocka_unit_test(memory_may_end_where_many_nodes_wait),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
