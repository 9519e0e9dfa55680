/* Every batch form gives the statuses, sentences and answers of single calls, in their order: to good questions, to
 * none, one and many, to many equal ones, and to bad ones in any place; on one thread and on several. */
#include "query/context.h"
#include "support/large.h"
#include "tree/trees.h"
#include <math.h>

enum { MANY = 600, ROOM = 1 << 20 }; /* three chunks of a batch */

typedef struct questions {
    double points[3 * MANY], directions[3 * MANY], windows[MANY][6];
    froe_range ranges[MANY];
    double limit; /* t_max; bound */
    size_t k;
    int direction;
} questions;

/* Answers, one after the other. */
typedef struct answers_found {
    size_t starts[MANY + 1], queries;
    uint32_t ids[ROOM];
    double values[ROOM];
} answers_found;

static void put(answers_found *out, uint32_t id, double value) {
    const size_t at = out->starts[out->queries + 1]++;
    assert_true(at < ROOM);
    out->ids[at] = id;
    out->values[at] = value;
}

/* The next query has no answers yet. */
static void open_list(answers_found *out) {
    out->starts[out->queries + 1] = out->starts[out->queries];
}

static void put_list(answers_found *out, const froe_list *list) {
    for (size_t i = 0; i < list->count; i++) put(out, list->ids[i], 0);
}

/* ------------------------------------------------------------------- questions -- */

/* In the unit cube; every second range a window, or all. */
static void draw(questions *ask, size_t dim, bool windows, bool equal) {
    ask->limit = INFINITY, ask->k = 3, ask->direction = 1;
    for (uint64_t i = 0; i < 3 * MANY; i++) {
        ask->points[i] = trees_unit(9, equal ? i % dim : i);
        ask->directions[i] = trees_unit(10, equal ? i % dim : i) - 0.5;
    }
    for (size_t i = 0; i < MANY; i++) {
        const size_t draw = equal ? 0 : i;
        const double size = draw % 50 == 7 ? 0.8 : 0.1 * trees_unit(12, draw);
        for (size_t k = 0; k < dim; k++) {
            ask->windows[i][k] = trees_unit(11, 3 * draw + k) * 1.1 - 0.1;
            ask->windows[i][dim + k] = ask->windows[i][k] + size;
        }
        if (draw % 40 == 3) ask->windows[i][draw % dim] = -INFINITY;
        if (draw % 60 == 5) ask->windows[i][dim + draw % dim] = INFINITY;
        ask->ranges[i] = froe_range_defaults();
        ask->ranges[i].points = ask->windows[i];
        ask->ranges[i].radius = 0.1;
        const bool unbounded = draw % 40 == 3 || draw % 60 == 5;
        ask->ranges[i].shape = windows || unbounded || draw % 2 ? FROE_SHAPE_BOX : FROE_SHAPE_BALL;
    }
}

/* ----------------------------------------------------------------------- forms -- */

/* A question alone: its answers are appended. */
typedef froe_status single_fn(froe_query *q, const questions *ask, size_t i, answers_found *out, froe_diagnostic *why);
/* The first `count` of them together. */
typedef froe_status batch_fn(froe_query *q, const questions *ask, size_t count, const froe_batch_options *o,
                             answers_found *out, froe_diagnostic *why);

static size_t dim_of(const froe_query *q) {
    return (size_t)q->tree->scene->dim;
}

static froe_status take(froe_status status, froe_answers *answers, answers_found *out) {
    if (status) return status;
    for (size_t i = 0; i < answers->queries; i++, out->queries++) {
        open_list(out);
        for (size_t n = answers->starts[i]; n < answers->starts[i + 1]; n++)
            put(out, answers->ids[n], answers->values ? answers->values[n] : 0);
    }
    froe_answers_free(answers);
    assert_null(answers->ids);
    return FROE_OK;
}

/* Ids of one answer a query. */
static froe_status take_ids(froe_status status, const uint32_t *ids, size_t count, answers_found *out) {
    for (size_t i = 0; i < count && !status; i++, out->queries++) open_list(out), put(out, ids[i], 0);
    return status;
}

static froe_status one_range(froe_query *q, const questions *ask, size_t i, answers_found *out, froe_diagnostic *why) {
    froe_list list = {0};
    const froe_status status = froe_query_range(q, ask->ranges + i, &list, why);
    put_list(out, &list);
    return status;
}
static froe_status all_ranges(froe_query *q, const questions *ask, size_t count, const froe_batch_options *o,
                              answers_found *out, froe_diagnostic *why) {
    froe_answers answers;
    return take(froe_batch_range(q, ask->ranges, count, o, &answers, why), &answers, out);
}

static froe_status one_box(froe_query *q, const questions *ask, size_t i, answers_found *out, froe_diagnostic *why) {
    froe_range box = froe_range_defaults();
    froe_list list = {0};
    box.points = ask->windows[i];
    const froe_status status = froe_query_range(q, &box, &list, why);
    put_list(out, &list);
    return status;
}
static froe_status all_boxes(froe_query *q, const questions *ask, size_t count, const froe_batch_options *o,
                             answers_found *out, froe_diagnostic *why) {
    static double boxes[6 * MANY];
    const size_t numbers = 2 * dim_of(q);
    froe_answers answers;
    for (size_t i = 0; i < count; i++) memcpy(boxes + i * numbers, ask->windows[i], numbers * sizeof *boxes);
    return take(froe_batch_boxes(q, boxes, count, o, &answers, why), &answers, out);
}

static froe_status one_count(froe_query *q, const questions *ask, size_t i, answers_found *out, froe_diagnostic *why) {
    uint64_t met = 0;
    const froe_status status = froe_query_count(q, ask->ranges + i, &met, why);
    if (!status) put(out, (uint32_t)met, 0);
    return status;
}
static froe_status all_counts(froe_query *q, const questions *ask, size_t count, const froe_batch_options *o,
                              answers_found *out, froe_diagnostic *why) {
    static uint64_t counts[MANY];
    static uint32_t ids[MANY];
    const froe_status status = froe_batch_count(q, ask->ranges, count, o, counts, why);
    for (size_t i = 0; i < count && !status; i++) ids[i] = (uint32_t)counts[i];
    return take_ids(status, ids, count, out);
}

static froe_status one_any(froe_query *q, const questions *ask, size_t i, answers_found *out, froe_diagnostic *why) {
    uint32_t object = 0;
    const froe_status status = froe_query_any(q, ask->ranges + i, &object, why);
    if (!status) put(out, object, 0);
    return status;
}
static froe_status any_of_all(froe_query *q, const questions *ask, size_t count, const froe_batch_options *o,
                              answers_found *out, froe_diagnostic *why) {
    static uint32_t ids[MANY];
    return take_ids(froe_batch_any(q, ask->ranges, count, o, ids, why), ids, count, out);
}

static froe_status one_locate(froe_query *q, const questions *ask, size_t i, answers_found *out, froe_diagnostic *why) {
    froe_list list = {0};
    const froe_status status = froe_query_locate(q, ask->points + i * dim_of(q), &list, why);
    put_list(out, &list);
    return status;
}
static froe_status all_locate(froe_query *q, const questions *ask, size_t count, const froe_batch_options *o,
                              answers_found *out, froe_diagnostic *why) {
    froe_answers answers;
    return take(froe_batch_locate(q, ask->points, count, o, &answers, why), &answers, out);
}

static froe_status one_groups(froe_query *q, const questions *ask, size_t i, answers_found *out, froe_diagnostic *why) {
    froe_list list = {0};
    const froe_status status = froe_query_groups(q, ask->points + i * dim_of(q), &list, why);
    put_list(out, &list);
    return status;
}
static froe_status all_groups(froe_query *q, const questions *ask, size_t count, const froe_batch_options *o,
                              answers_found *out, froe_diagnostic *why) {
    froe_answers answers;
    return take(froe_batch_groups(q, ask->points, count, o, &answers, why), &answers, out);
}

static froe_status one_relation(froe_query *q, const questions *ask, size_t i, answers_found *out,
                                froe_diagnostic *why) {
    froe_list list = {0};
    const froe_status status = froe_query_groups_range(q, ask->ranges + i, FROE_WITHIN, &list, why);
    put_list(out, &list);
    return status;
}
static froe_status all_relations(froe_query *q, const questions *ask, size_t count, const froe_batch_options *o,
                                 answers_found *out, froe_diagnostic *why) {
    froe_answers answers;
    return take(froe_batch_groups_range(q, ask->ranges, count, FROE_WITHIN, o, &answers, why), &answers, out);
}

static froe_status one_vertical(froe_query *q, const questions *ask, size_t i, answers_found *out,
                                froe_diagnostic *why) {
    uint32_t object = 0;
    const froe_status status = froe_query_vertical(q, ask->points + i * dim_of(q), ask->direction, &object, why);
    if (!status) put(out, object, 0);
    return status;
}
static froe_status all_vertical(froe_query *q, const questions *ask, size_t count, const froe_batch_options *o,
                                answers_found *out, froe_diagnostic *why) {
    static uint32_t ids[MANY];
    return take_ids(froe_batch_vertical(q, ask->points, count, ask->direction, o, ids, why), ids, count, out);
}

static froe_status one_ray(froe_query *q, const questions *ask, size_t i, answers_found *out, froe_diagnostic *why) {
    const double *x = ask->points + i * dim_of(q), *d = ask->directions + i * dim_of(q);
    froe_hit hit = {0};
    const froe_status status = froe_query_ray(q, x, d, ask->limit, &hit, why);
    if (!status) put(out, hit.object, hit.object == FROE_NONE ? 0 : hit.t);
    return status;
}
static froe_status all_rays(froe_query *q, const questions *ask, size_t count, const froe_batch_options *o,
                            answers_found *out, froe_diagnostic *why) {
    static froe_hit hits[MANY];
    const froe_status status = froe_batch_ray(q, ask->points, ask->directions, count, ask->limit, o, hits, why);
    for (size_t i = 0; i < count && !status; i++, out->queries++)
        open_list(out), put(out, hits[i].object, hits[i].object == FROE_NONE ? 0 : hits[i].t);
    return status;
}

static froe_status one_ray_any(froe_query *q, const questions *ask, size_t i, answers_found *out,
                               froe_diagnostic *why) {
    const double *x = ask->points + i * dim_of(q), *d = ask->directions + i * dim_of(q);
    uint32_t object = 0;
    const froe_status status = froe_query_ray_any(q, x, d, ask->limit, &object, why);
    if (!status) put(out, object == FROE_NONE, 0); /* any object will do */
    return status;
}
static froe_status all_rays_any(froe_query *q, const questions *ask, size_t count, const froe_batch_options *o,
                                answers_found *out, froe_diagnostic *why) {
    static uint32_t ids[MANY];
    const froe_status status = froe_batch_ray_any(q, ask->points, ask->directions, count, ask->limit, o, ids, why);
    for (size_t i = 0; i < count && !status; i++) ids[i] = ids[i] == FROE_NONE;
    return take_ids(status, ids, count, out);
}

static froe_status one_ray_all(froe_query *q, const questions *ask, size_t i, answers_found *out,
                               froe_diagnostic *why) {
    const double *x = ask->points + i * dim_of(q), *d = ask->directions + i * dim_of(q);
    froe_hits hits = {0};
    const froe_status status = froe_query_ray_all(q, x, d, ask->limit, &hits, why);
    for (size_t n = 0; n < hits.count; n++) put(out, hits.hits[n].object, hits.hits[n].t);
    return status;
}
static froe_status all_rays_all(froe_query *q, const questions *ask, size_t count, const froe_batch_options *o,
                                answers_found *out, froe_diagnostic *why) {
    froe_answers answers;
    return take(froe_batch_ray_all(q, ask->points, ask->directions, count, ask->limit, o, &answers, why), &answers,
                out);
}

static froe_status one_near(froe_query *q, const questions *ask, size_t i, answers_found *out, froe_diagnostic *why) {
    froe_neighbours near = {0};
    const froe_status status = froe_query_near(q, ask->points + i * dim_of(q), ask->k, ask->limit, &near, why);
    for (size_t n = 0; n < near.count; n++) put(out, near.items[n].object, near.items[n].distance);
    return status;
}
static froe_status all_near(froe_query *q, const questions *ask, size_t count, const froe_batch_options *o,
                            answers_found *out, froe_diagnostic *why) {
    froe_answers answers;
    return take(froe_batch_near(q, ask->points, count, ask->k, ask->limit, o, &answers, why), &answers, out);
}

static const struct form {
    const char *name;
    single_fn *single;
    batch_fn *batch;
} forms[] = {
    {"range", one_range, all_ranges},
    {"box", one_box, all_boxes},
    {"count", one_count, all_counts},
    {"any", one_any, any_of_all},
    {"locate", one_locate, all_locate},
    {"groups", one_groups, all_groups},
    {"relation", one_relation, all_relations},
    {"vertical", one_vertical, all_vertical},
    {"ray", one_ray, all_rays},
    {"ray any", one_ray_any, all_rays_any},
    {"ray all", one_ray_all, all_rays_all},
    {"near", one_near, all_near},
};
enum { FORMS = sizeof forms / sizeof *forms };

/* ------------------------------------------------------------------- comparing -- */

static answers_found expected, found;

/* One by one, up to the first that fails: which that is, or `count`. */
static size_t ask_singly(froe_query *q, const struct form *form, const questions *ask, size_t count,
                         froe_status *status, froe_diagnostic *why) {
    *status = FROE_OK;
    expected.queries = expected.starts[0] = 0;
    for (; expected.queries < count; expected.queries++) {
        open_list(&expected);
        *status = form->single(q, ask, expected.queries, &expected, why);
        if (*status) break;
    }
    return expected.queries;
}

static void compare(froe_query *q, const struct form *form, const questions *ask, size_t count, const char *what) {
    froe_diagnostic why = {0}, its = {0};
    froe_status status;
    const size_t failed = ask_singly(q, form, ask, count, &status, &why);
    for (unsigned way = 0; way < 3; way++) {
        froe_batch_options o = froe_batch_defaults();
        o.threads = way < 2 ? 1 : 3;
        large_ask(q, way == 1);
        found.queries = found.starts[0] = 0;
        const froe_status came = form->batch(q, ask, count, &o, &found, &its);
        const char *method = froe_tree_report(q->tree).method;
        if (came != status)
            fail_msg("%s, %s, %s: %s, alone %s", method, form->name, what, froe_status_name(came),
                     froe_status_name(status));
        if (status) {
            assert_string_equal(its.message, why.message);
            if (status != FROE_E_UNSUPPORTED) assert_int_equal(its.object, failed);
            continue;
        }
        assert_int_equal(found.queries, count);
        for (size_t i = 0; i < count; i++)
            if (found.starts[i + 1] != expected.starts[i + 1])
                fail_msg("%s, %s, %s: %zu answers up to question %zu, alone %zu", method, form->name, what,
                         found.starts[i + 1], i, expected.starts[i + 1]);
        assert_memory_equal(found.ids, expected.ids, found.starts[count] * sizeof *found.ids);
        assert_memory_equal(found.values, expected.values, found.starts[count] * sizeof *found.values);
    }
}

/* ------------------------------------------------------------------------ bad -- */

/* Makes question i a bad one, for one form at least. */
typedef void spoil_fn(questions *ask, size_t i, size_t dim);

static void nan_point(questions *ask, size_t i, size_t dim) {
    ask->points[i * dim + i % dim] = ask->windows[i][i % dim] = NAN;
}
static void nan_end(questions *ask, size_t i, size_t dim) {
    ask->directions[i * dim + i % dim] = ask->windows[i][dim + i % dim] = NAN;
}
static void infinite_point(questions *ask, size_t i, size_t dim) {
    ask->points[i * dim] = ask->windows[i][0] = ask->windows[i][dim] = INFINITY;
}
static void infinite_end(questions *ask, size_t i, size_t dim) {
    ask->directions[i * dim] = ask->windows[i][0] = ask->windows[i][dim] = -INFINITY;
}
static void infinite_last(questions *ask, size_t i, size_t dim) {
    ask->points[i * dim + dim - 1] = -INFINITY;
    ask->ranges[i].radius = INFINITY;
}
static void no_extent(questions *ask, size_t i, size_t dim) {
    for (size_t k = 0; k < dim; k++) ask->directions[i * dim + k] = 0;
    ask->windows[i][dim] = -9, ask->windows[i][0] = 9;
}
static void no_points(questions *ask, size_t i, size_t dim) {
    (void)dim;
    ask->ranges[i].points = NULL;
}
static void nan_radius(questions *ask, size_t i, size_t dim) {
    (void)dim;
    ask->ranges[i].radius = NAN, ask->ranges[i].eps = -1;
}
static void no_defaults(questions *ask, size_t i, size_t dim) {
    (void)dim;
    ask->ranges[i].size = 0;
}
static void no_such_shape(questions *ask, size_t i, size_t dim) {
    (void)dim;
    ask->ranges[i].shape = (froe_range_shape)99;
}
static void no_such_walk(questions *ask, size_t i, size_t dim) {
    (void)dim;
    ask->ranges[i].walk = (froe_walk)99;
}
static void bad_limit(questions *ask, size_t i, size_t dim) {
    (void)dim;
    ask->limit = i % 2 ? NAN : -1;
    ask->direction = 0;
}
static void none_wanted(questions *ask, size_t i, size_t dim) {
    (void)i, (void)dim;
    ask->k = 0;
    ask->limit = 0;
}

static const struct {
    const char *name;
    spoil_fn *spoil;
} spoils[] = {
    {"NaN in a point", nan_point},    {"NaN in an end", nan_end},       {"infinite point", infinite_point},
    {"infinite end", infinite_end},   {"infinite last", infinite_last}, {"no extent", no_extent},
    {"no points", no_points},         {"NaN radius", nan_radius},       {"no defaults", no_defaults},
    {"no such shape", no_such_shape}, {"no such walk", no_such_walk},   {"bad limit", bad_limit},
    {"none wanted", none_wanted},
};
enum { SPOILS = sizeof spoils / sizeof *spoils };

/* ---------------------------------------------------------------------- scenes -- */

static void check_good(froe_query *q, size_t dim) {
    static const size_t counts[] = {0, 1, 2, 17, 256, MANY};
    static questions ask;
    for (size_t f = 0; f < FORMS; f++)
        for (int way = 0; way < 4; way++) {
            draw(&ask, dim, way & 1, way & 2);
            for (size_t c = 0; c < sizeof counts / sizeof *counts; c++)
                compare(q, forms + f, &ask, counts[c], way & 2 ? "equal questions" : "good questions");
        }
}

static void check_bad(froe_query *q, size_t dim) {
    static const size_t places[] = {0, 7, 255, 256, MANY - 1};
    static questions ask;
    for (size_t f = 0; f < FORMS; f++)
        for (size_t s = 0; s < SPOILS; s++)
            for (size_t p = (f + s) % 2; p < sizeof places / sizeof *places; p += 2) {
                draw(&ask, dim, s % 2, false);
                spoils[s].spoil(&ask, places[p], dim);
                spoils[(s + p) % SPOILS].spoil(&ask, MANY - 2, dim); /* the first one counts */
                compare(q, forms + f, &ask, places[p] + 1, spoils[s].name);
                if (p == 1) compare(q, forms + f, &ask, MANY, spoils[s].name);
                compare(q, forms + f, &ask, 0, spoils[s].name);
            }
}

/* A general tree and one to be queried. */
static void check_scene(froe_scene *scene) {
    static const char *const methods[] = {"index", "density"};
    const size_t dim = (size_t)froe_scene_dim(scene);
    for (size_t m = 0; m < 2; m++) {
        froe_tree *tree = trees_build(scene, methods[m], 6);
        froe_query *q;
        assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
        check_good(q, dim);
        check_bad(q, dim);
        froe_query_free(q);
        froe_tree_free(tree);
    }
    froe_scene_free(scene);
}

static void in_the_plane(void **state) {
    (void)state;
    check_scene(trees_scene(2, FROE_SEGMENT, 200, 0, 0.2, 1));
    check_scene(trees_scene(2, FROE_POINT, 200, 0, 0.2, 1));
}

static void in_space(void **state) {
    (void)state;
    check_scene(trees_scene(3, FROE_POLYGON, 100, 0, 0.3, 2));
}

static void among_no_objects(void **state) {
    (void)state;
    check_scene(trees_scene(2, FROE_SEGMENT, 0, 0, 0.2, 1));
    check_scene(trees_scene(3, FROE_POLYGON, 0, 0, 0.2, 1));
}

/* ----------------------------------------------------------------------- pairs -- */

typedef struct pair_list {
    froe_pair pairs[4096];
    size_t count, most;
} pair_list;

static bool keep_pair(void *user, const froe_pair *pair) {
    pair_list *l = user;
    assert_true(l->count < l->most);
    l->pairs[l->count++] = *pair;
    return l->count < l->most;
}

/* Of all pairs, and of the first few. */
static void check_pairs(froe_scene *scene, const char *method) {
    static pair_list alone, together;
    froe_tree *tree = trees_build(scene, method, 6);
    froe_query *q;
    froe_batch_options o = froe_batch_defaults();
    assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
    for (int way = 0; way < 4; way++) {
        alone.count = together.count = 0;
        alone.most = together.most = way & 2 ? 5 : 4096;
        o.threads = way & 1 ? 3 : 1;
        assert_int_equal(froe_query_pairs(q, true, keep_pair, &alone, NULL), FROE_OK);
        assert_int_equal(froe_batch_pairs(q, true, &o, keep_pair, &together, NULL), FROE_OK);
        assert_int_equal(alone.count, together.count);
        for (size_t i = 0; i < alone.count; i++) {
            assert_int_equal(alone.pairs[i].a, together.pairs[i].a);
            assert_int_equal(alone.pairs[i].b, together.pairs[i].b);
            assert_int_equal(alone.pairs[i].kind, together.pairs[i].kind);
        }
        froe_pairs array;
        assert_int_equal(froe_batch_pair_array(q, true, &o, &array, NULL), FROE_OK);
        assert_non_null(array.pairs);
        assert_true(alone.count == (alone.most < array.count ? alone.most : array.count));
        for (size_t i = 0; i < alone.count; i++) {
            assert_int_equal(alone.pairs[i].a, array.pairs[i].a);
            assert_int_equal(alone.pairs[i].b, array.pairs[i].b);
            assert_int_equal(alone.pairs[i].kind, array.pairs[i].kind);
        }
        froe_pairs_free(&array);
        froe_pairs_free(&array);
    }
    froe_query_free(q);
    froe_tree_free(tree);
    froe_scene_free(scene);
}

static void pairs_of_batches_are_those_of_single_calls(void **state) {
    static const size_t counts[] = {0, 1, 2, 300};
    (void)state;
    for (size_t c = 0; c < 4; c++) {
        check_pairs(trees_scene(2, FROE_SEGMENT, counts[c], 0, 0.1, 1), "index");
        check_pairs(trees_scene(2, FROE_SEGMENT, counts[c], 0, 0.1, 1), "density");
        check_pairs(trees_scene(3, FROE_POLYGON, counts[c], 0, 0.1, 1), "index");
    }
}

/* ---------------------------------------------------------------------- memory -- */

/* On one thread and on several: each failure is one of memory, and leaves nothing behind. */
static froe_status ask_without_memory(void *user, const froe_allocator *alloc) {
    static questions ask;
    froe_tree tree = *(const froe_tree *)user;
    froe_answers ranges = {0}, near = {0};
    froe_pairs pairs = {0};
    froe_query *q = NULL;
    draw(&ask, 2, true, false);
    tree.alloc = *alloc;
    froe_status status = froe_query_new(&tree, &q, NULL);
    for (unsigned threads = 1; threads <= 2 && !status; threads++) {
        froe_batch_options o = froe_batch_defaults();
        o.threads = threads;
        large_ask(q, threads == 1);
        status = froe_batch_range(q, ask.ranges, MANY, &o, &ranges, NULL);
        if (!status) status = froe_batch_near(q, ask.points, MANY, 2, INFINITY, &o, &near, NULL);
        if (!status) status = froe_batch_pair_array(q, true, &o, &pairs, NULL);
        froe_pairs_free(&pairs);
        froe_answers_free(&ranges);
        froe_answers_free(&near);
    }
    froe_query_free(q);
    return status;
}

static void every_allocation_of_a_batch_may_fail(void **state) {
    (void)state;
    froe_tree *tree = trees_grow(2, FROE_SEGMENT, 200, 0, 0.2, "index", 6);
    assert_true(test_memory_each(ask_without_memory, tree) > 20);
    froe_tree_free(tree);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(in_the_plane),
        cmocka_unit_test(in_space),
        cmocka_unit_test(among_no_objects),
        cmocka_unit_test(pairs_of_batches_are_those_of_single_calls),
        cmocka_unit_test(every_allocation_of_a_batch_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
