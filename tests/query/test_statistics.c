/* Statistics of every query on trees of every builder: what was asked, and that nodes or leaves were counted (lists of
 * leaves may be empty, and cells be found without a cut); batches count the same on any number of threads. */
#include "query/worlds.h"

enum { MANY = 300 };

/* Queries in the unit cube. */
typedef struct questions {
    double points[3 * MANY], directions[3 * MANY], windows[MANY][6];
    froe_range ranges[MANY];
} questions;

static void draw(questions *ask, size_t dim) {
    for (uint64_t i = 0; i < 3 * MANY; i++)
        ask->points[i] = trees_unit(9, i), ask->directions[i] = trees_unit(10, i) - 0.5;
    for (size_t i = 0; i < MANY; i++) {
        for (size_t k = 0; k < dim; k++) {
            ask->windows[i][k] = 0.9 * trees_unit(11, 3 * i + k);
            ask->windows[i][dim + k] = ask->windows[i][k] + 0.1;
        }
        ask->ranges[i] = froe_range_defaults();
        ask->ranges[i].points = ask->windows[i];
        ask->ranges[i].radius = 0.1;
        ask->ranges[i].shape = i % 2 ? FROE_SHAPE_BOX : FROE_SHAPE_BALL;
    }
}

/* --------------------------------------------------------------------- asking -- */

typedef froe_status single_fn(froe_query *q, const questions *ask, size_t dim, size_t i);
typedef froe_status batch_fn(froe_query *q, const questions *ask, const froe_batch_options *o);

static bool go_on(void *user, const froe_pair *pair) {
    (void)user, (void)pair;
    return true;
}

static froe_status ask_range(froe_query *q, const questions *ask, size_t dim, size_t i) {
    froe_list list;
    (void)dim;
    return froe_query_range(q, ask->ranges + i, &list, NULL);
}
static froe_status ask_count(froe_query *q, const questions *ask, size_t dim, size_t i) {
    uint64_t count;
    (void)dim;
    return froe_query_count(q, ask->ranges + i, &count, NULL);
}
static froe_status ask_any(froe_query *q, const questions *ask, size_t dim, size_t i) {
    uint32_t object;
    (void)dim;
    return froe_query_any(q, ask->ranges + i, &object, NULL);
}
static froe_status ask_near_range(froe_query *q, const questions *ask, size_t dim, size_t i) {
    froe_range range = ask->ranges[i];
    froe_list list;
    (void)dim;
    range.eps = 0.2;
    return froe_query_range(q, &range, &list, NULL);
}
static froe_status ask_locate(froe_query *q, const questions *ask, size_t dim, size_t i) {
    froe_list list;
    return froe_query_locate(q, ask->points + i * dim, &list, NULL);
}
static froe_status ask_groups(froe_query *q, const questions *ask, size_t dim, size_t i) {
    froe_list list;
    return froe_query_groups(q, ask->points + i * dim, &list, NULL);
}
static froe_status ask_ray(froe_query *q, const questions *ask, size_t dim, size_t i) {
    froe_hit hit;
    return froe_query_ray(q, ask->points + i * dim, ask->directions + i * dim, INFINITY, &hit, NULL);
}
static froe_status ask_ray_all(froe_query *q, const questions *ask, size_t dim, size_t i) {
    froe_hits hits;
    return froe_query_ray_all(q, ask->points + i * dim, ask->directions + i * dim, INFINITY, &hits, NULL);
}
static froe_status ask_ray_any(froe_query *q, const questions *ask, size_t dim, size_t i) {
    uint32_t object;
    return froe_query_ray_any(q, ask->points + i * dim, ask->directions + i * dim, INFINITY, &object, NULL);
}
static froe_status ask_vertical(froe_query *q, const questions *ask, size_t dim, size_t i) {
    uint32_t object;
    return froe_query_vertical(q, ask->points + i * dim, 1, &object, NULL);
}
static froe_status ask_near(froe_query *q, const questions *ask, size_t dim, size_t i) {
    froe_neighbours near;
    return froe_query_near(q, ask->points + i * dim, 3, INFINITY, &near, NULL);
}

/* What was found is of no interest. */
static froe_status drop(froe_status status, froe_answers *answers) {
    if (!status) froe_answers_free(answers);
    return status;
}
static froe_status batch_range(froe_query *q, const questions *ask, const froe_batch_options *o) {
    froe_answers answers;
    return drop(froe_batch_range(q, ask->ranges, MANY, o, &answers, NULL), &answers);
}
static froe_status batch_locate(froe_query *q, const questions *ask, const froe_batch_options *o) {
    froe_answers answers;
    return drop(froe_batch_locate(q, ask->points, MANY, o, &answers, NULL), &answers);
}
static froe_status batch_groups(froe_query *q, const questions *ask, const froe_batch_options *o) {
    froe_answers answers;
    return drop(froe_batch_groups(q, ask->points, MANY, o, &answers, NULL), &answers);
}
static froe_status batch_ray(froe_query *q, const questions *ask, const froe_batch_options *o) {
    static froe_hit hits[MANY];
    return froe_batch_ray(q, ask->points, ask->directions, MANY, INFINITY, o, hits, NULL);
}
static froe_status batch_ray_all(froe_query *q, const questions *ask, const froe_batch_options *o) {
    froe_answers answers;
    return drop(froe_batch_ray_all(q, ask->points, ask->directions, MANY, INFINITY, o, &answers, NULL), &answers);
}
static froe_status batch_ray_any(froe_query *q, const questions *ask, const froe_batch_options *o) {
    static uint32_t objects[MANY];
    return froe_batch_ray_any(q, ask->points, ask->directions, MANY, INFINITY, o, objects, NULL);
}
static froe_status batch_vertical(froe_query *q, const questions *ask, const froe_batch_options *o) {
    static uint32_t objects[MANY];
    return froe_batch_vertical(q, ask->points, MANY, 1, o, objects, NULL);
}
static froe_status batch_near(froe_query *q, const questions *ask, const froe_batch_options *o) {
    froe_answers answers;
    return drop(froe_batch_near(q, ask->points, MANY, 3, INFINITY, o, &answers, NULL), &answers);
}
static froe_status batch_pairs(froe_query *q, const questions *ask, const froe_batch_options *o) {
    (void)ask;
    return froe_batch_pairs(q, true, o, go_on, NULL, NULL);
}

/* A kind of query; the plane's own come last. */
static const struct kind {
    const char *name;
    single_fn *single;
    batch_fn *batch;
} kinds[] = {
    {"range", ask_range, batch_range},
    {"count", ask_count, NULL},
    {"any", ask_any, NULL},
    {"eps", ask_near_range, NULL},
    {"locate", ask_locate, batch_locate},
    {"ray", ask_ray, batch_ray},
    {"ray all", ask_ray_all, batch_ray_all},
    {"ray any", ask_ray_any, batch_ray_any},
    {"near", ask_near, batch_near},
    {"pairs", NULL, batch_pairs},
    {"groups", ask_groups, batch_groups},
    {"vertical", ask_vertical, batch_vertical},
};
enum { KINDS = sizeof kinds / sizeof *kinds, PLANE_KINDS = 2 };

/* ------------------------------------------------------------------- checking -- */

static void expect_visited(froe_query *q, const char *what, const char *method, uint64_t queries,
                           froe_query_stats *out) {
    *out = froe_query_statistics(q);
    if (out->queries != queries || out->nodes + out->leaves + out->steps < queries)
        fail_msg("%s, %s: %u queries for %u, %u nodes, %u steps, %u leaves", method, what, (unsigned)out->queries,
                 (unsigned)queries, (unsigned)out->nodes, (unsigned)out->steps, (unsigned)out->leaves);
}

static void check_kind(froe_query *q, const questions *ask, size_t dim, const struct kind *kind, const char *method) {
    froe_query_stats first = {0}, stats;
    if (kind->single) {
        for (size_t i = 0; i < MANY; i++) assert_int_equal(kind->single(q, ask, dim, i), FROE_OK);
        expect_visited(q, kind->name, method, MANY, &stats);
    }
    for (unsigned threads = 1; threads <= 3 && kind->batch; threads += 2) {
        froe_batch_options o = froe_batch_defaults();
        o.threads = threads;
        assert_int_equal(kind->batch(q, ask, &o), FROE_OK);
        expect_visited(q, kind->name, method, kind->single ? MANY : 1, &stats);
        if (threads > 1) assert_memory_equal(&stats, &first, sizeof stats);
        first = stats;
    }
}

static void check_scene(froe_scene *scene, size_t kind_count) {
    static questions ask;
    world w = world_begin("statistics", scene);
    draw(&ask, (size_t)w.dim);
    for (size_t t = 0; t < w.tree_count; t++) {
        froe_query_statistics(w.queries[t]);
        for (size_t k = 0; k < kind_count; k++)
            check_kind(w.queries[t], &ask, (size_t)w.dim, kinds + k, froe_tree_report(w.trees[t]).method);
    }
    world_end(&w);
}

static void every_query_says_what_it_visited(void **state) {
    (void)state;
    check_scene(trees_scene(2, FROE_SEGMENT, 250, 0, 0.1, 1), KINDS);
    check_scene(trees_scene(3, FROE_POLYGON, 150, 0, 0.3, 2), KINDS - PLANE_KINDS);
}

static void deep_trees_say_how_they_were_searched(void **state) {
    (void)state;
    check_scene(world_generate("nested", 600), KINDS);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_query_says_what_it_visited),
        cmocka_unit_test(deep_trees_say_how_they_were_searched),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
