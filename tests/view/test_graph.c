/* test_graph.c: random graphs: after breaking no circle is left, the order keeps every arc that counts, and
 * graphs without circles lose nothing. */
#include "../tree/trees.h"
#include "view/picture/graph.h"
#include <stdlib.h>

enum { MOST = 3000 };

static void check_order(const view_graph *g, const uint32_t *order) {
    static uint32_t place[MOST];
    for (uint32_t i = 0; i < g->count; i++) place[i] = UINT32_MAX;
    for (uint32_t i = 0; i < g->count; i++) {
        assert_true(order[i] < g->count && place[order[i]] == UINT32_MAX);
        place[order[i]] = i;
    }
    for (uint32_t v = 0; v < g->count; v++)
        for (uint32_t i = g->out_starts[v]; i < g->out_starts[v + 1] && !g->late[v]; i++)
            assert_true(place[v] < place[g->outs[i]]);
}

static uint32_t switches(const uint32_t *order, const uint32_t *styles, uint32_t count) {
    uint32_t n = 0;
    for (uint32_t i = 1; i < count; i++) n += styles[order[i]] != styles[order[i - 1]];
    return n;
}

/* Returns how many nodes were made late. */
static uint32_t try_graph(uint32_t nodes, size_t arcs, bool circles, uint64_t seed) {
    graph_arc *list = calloc(arcs + 1, sizeof *list);
    uint32_t *order = calloc(nodes + 1, sizeof *order), *styles = calloc(nodes + 1, sizeof *styles);
    froe_allocator alloc = support_allocator(NULL);
    view_graph g;
    for (size_t i = 0; i < arcs; i++) {
        uint32_t a = trees_random(seed, 2 * i, nodes), b = trees_random(seed, 2 * i + 1, nodes);
        if (a == b) b = (a + 1) % nodes;
        if (!circles && a > b)
            list[i] = (graph_arc){b, a};
        else
            list[i] = (graph_arc){a, b};
    }
    for (uint32_t v = 0; v < nodes; v++) styles[v] = trees_random(seed, v + 100000, 7);
    assert_int_equal(view_graph_new(&alloc, nodes, list, arcs, &g), FROE_OK);
    assert_int_equal(view_graph_break(&alloc, &g, NULL), FROE_OK);
    assert_int_equal(view_graph_sort(&alloc, &g, styles, 7, order), FROE_OK);
    check_order(&g, order);
    const uint32_t late = g.late_count;
    if (!circles) assert_int_equal(late, 0);
    assert_true(late < nodes && g.cyclic >= late);
    if (!arcs && nodes > 100) assert_int_equal(switches(order, styles, nodes), 6);
    view_graph_free(&alloc, &g);
    free(list), free(order), free(styles);
    return late;
}

static void graphs_without_circles_stay_whole(void **state) {
    (void)state;
    try_graph(1, 0, false, 1);
    try_graph(200, 0, false, 1);
    for (uint64_t seed = 0; seed < 20; seed++) try_graph(300, 1500, false, seed);
}

static void circles_are_broken(void **state) {
    (void)state;
    for (uint64_t seed = 0; seed < 40; seed++) assert_true(try_graph(100, 130 + 10 * seed, true, seed) > 0);
    try_graph(MOST, 4 * MOST, true, 1);
}

/* Two nodes of which each must come after the other cost one; so do many circles through one node. */
static void few_nodes_break_many_circles(void **state) {
    (void)state;
    froe_allocator alloc = support_allocator(NULL);
    graph_arc two[2] = {{0, 1}, {1, 0}}, star[100];
    view_graph g;
    assert_int_equal(view_graph_new(&alloc, 2, two, 2, &g), FROE_OK);
    assert_int_equal(view_graph_break(&alloc, &g, NULL), FROE_OK);
    assert_int_equal(g.late_count, 1);
    assert_int_equal(g.late[0], 1);
    view_graph_free(&alloc, &g);
    const uint8_t fixed[2] = {1, 0};
    assert_int_equal(view_graph_new(&alloc, 2, two, 2, &g), FROE_OK);
    assert_int_equal(view_graph_break(&alloc, &g, fixed), FROE_OK);
    assert_int_equal(g.late[1], 1);
    view_graph_free(&alloc, &g);
    for (uint32_t i = 0; i < 50; i++) star[2 * i] = (graph_arc){50, i}, star[2 * i + 1] = (graph_arc){i, 50};
    assert_int_equal(view_graph_new(&alloc, 51, star, 100, &g), FROE_OK);
    assert_int_equal(view_graph_break(&alloc, &g, NULL), FROE_OK);
    assert_int_equal(g.late_count, 1);
    assert_int_equal(g.late[50], 1);
    assert_int_equal(g.cyclic, 51);
    view_graph_free(&alloc, &g);
}

/* A path of a million nodes that closes: no stack of the machine is used up. */
static void long_circles_need_no_deep_stack(void **state) {
    (void)state;
    enum { LONG = 300000 };
    froe_allocator alloc = support_allocator(NULL);
    graph_arc *list = calloc(LONG, sizeof *list);
    view_graph g;
    for (uint32_t i = 0; i < LONG; i++) list[i] = (graph_arc){i, (i + 1) % LONG};
    assert_int_equal(view_graph_new(&alloc, LONG, list, LONG, &g), FROE_OK);
    assert_int_equal(view_graph_break(&alloc, &g, NULL), FROE_OK);
    assert_true(g.late_count > 0);
    view_graph_free(&alloc, &g);
    free(list);
}

static froe_status graph_with(void *user, const froe_allocator *alloc) {
    graph_arc arcs[400];
    uint32_t order[50];
    view_graph g;
    (void)user;
    for (size_t i = 0; i < 400; i++) {
        arcs[i] = (graph_arc){trees_random(3, 2 * i, 50), trees_random(3, 2 * i + 1, 50)};
        if (arcs[i].from == arcs[i].to) arcs[i].to = (arcs[i].from + 1) % 50;
    }
    froe_status status = view_graph_new(alloc, 50, arcs, 400, &g);
    if (!status) status = view_graph_break(alloc, &g, NULL);
    if (!status) status = view_graph_sort(alloc, &g, NULL, 1, order);
    view_graph_free(alloc, &g);
    return status;
}

static void every_allocation_may_fail(void **state) {
    (void)state;
    assert_true(test_memory_each(graph_with, NULL) > 15);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(graphs_without_circles_stay_whole), cmocka_unit_test(circles_are_broken),
        cmocka_unit_test(few_nodes_break_many_circles),      cmocka_unit_test(long_circles_need_no_deep_stack),
        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
