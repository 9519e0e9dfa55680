/* ask.c: see ask.h. */
#include "ask.h"
#include <froe/query.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_POINTS = 12, MOST_PAIRS = 2000, BATCH = 8 };

typedef struct asking {
    froe_query *q;
    const froe_scene *scene;
    int dim;
    bool right;
    fuzz_bytes *bytes;
} asking;

static void expect(const asking *a, bool holds, const char *what) {
    const froe_diagnostic why = {.message = "answers do not agree"};
    if (a->right && !holds) fuzz_complain(what, &why);
}

static int ascending(const void *a, const void *b) {
    const uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

/* A sorted copy, to be freed. */
static uint32_t *sorted(const asking *a, const froe_list *list) {
    uint32_t *ids = calloc(list->count + 1, sizeof *ids);
    if (!ids) abort();
    if (list->count) memcpy(ids, list->ids, list->count * sizeof *ids);
    qsort(ids, list->count, sizeof *ids, ascending);
    for (size_t i = 1; i < list->count; i++) expect(a, ids[i] != ids[i - 1], "an object twice");
    const froe_diagnostic why = {.message = "an object that is not there"};
    if (list->count && ids[list->count - 1] >= froe_scene_object_count(a->scene)) fuzz_complain("of any tree", &why);
    return ids;
}

/* ------------------------------------------------------------------ ranges -- */

static void ask_counts(const asking *a, const froe_range *r, size_t found) {
    uint64_t count;
    uint32_t any;
    const bool exact = r->eps == 0;
    if (froe_query_count(a->q, r, &count, NULL) == FROE_OK) expect(a, !exact || count == found, "count");
    if (froe_query_any(a->q, r, &any, NULL) == FROE_OK) expect(a, !exact || (any == FROE_NONE) == !found, "any");
}

/* By all walks; exact answers are the same. */
static void ask_walks(const asking *a, froe_range *r) {
    uint32_t *first = NULL;
    size_t count = 0;
    for (r->walk = FROE_WALK_AUTO; r->walk < FROE_WALK_COUNT; r->walk++) {
        froe_list list;
        if (froe_query_range(a->q, r, &list, NULL)) continue;
        uint32_t *ids = sorted(a, &list);
        if (first && r->eps == 0) expect(a, list.count == count && !memcmp(ids, first, count * sizeof *ids), "walks");
        if (!first)
            first = ids, count = list.count;
        else
            free(ids);
        ask_counts(a, r, count);
    }
    free(first);
}

static void order_corners(int dim, double *points) {
    for (int k = 0; k < dim; k++)
        if (points[k] > points[dim + k]) {
            const double x = points[k];
            points[k] = points[dim + k];
            points[dim + k] = x;
        }
}

static void ask_range(const asking *a) {
    double points[MOST_POINTS * FROE_MAX_DIM], offsets[MOST_POINTS];
    froe_range r = froe_range_defaults();
    const uint8_t what = fuzz_byte(a->bytes), eps = fuzz_byte(a->bytes);
    r.shape = (froe_range_shape)(what % (FROE_SHAPE_COUNT + (what > 0xf0)));
    r.count = fuzz_byte(a->bytes) % MOST_POINTS;
    for (int i = 0; i < MOST_POINTS * a->dim; i++) points[i] = fuzz_double(a->bytes);
    for (int i = 0; i < MOST_POINTS; i++) offsets[i] = fuzz_double(a->bytes);
    if (r.shape == FROE_SHAPE_BOX && what & 32) order_corners(a->dim, points);
    r.points = points, r.offsets = offsets, r.radius = fabs(fuzz_double(a->bytes));
    if (eps % 4 == 0) r.eps = fabs(fuzz_double(a->bytes));
    ask_walks(a, &r);
    for (froe_relation relation = 0; relation < FROE_RELATION_COUNT; relation++) {
        froe_list groups;
        (void)froe_query_groups_range(a->q, &r, relation, &groups, NULL);
    }
}

/* ------------------------------------------------------------------ points -- */

static void ask_point(const asking *a, const double *x) {
    double box[2 * FROE_MAX_DIM];
    froe_range r = froe_range_defaults();
    froe_list list;
    froe_neighbours near;
    uint32_t object;
    const uint8_t what = fuzz_byte(a->bytes);
    const double bound = what % 5 ? INFINITY : fuzz_double(a->bytes);
    for (int k = 0; k < a->dim; k++) box[k] = box[a->dim + k] = x[k];
    r.points = box;
    if (froe_query_locate(a->q, x, &list, NULL) == FROE_OK) {
        const size_t count = list.count;
        uint32_t *ids = sorted(a, &list);
        if (froe_query_range(a->q, &r, &list, NULL) == FROE_OK) {
            uint32_t *again = sorted(a, &list);
            expect(a, list.count == count && !memcmp(ids, again, count * sizeof *ids), "locate");
            free(again);
        }
        free(ids);
    }
    (void)froe_query_groups(a->q, x, &list, NULL);
    (void)froe_query_vertical(a->q, x, what & 1 ? 1 : what & 2 ? -1 : 0, &object, NULL);
    if (froe_query_near(a->q, x, what % 7 ? what % 7 : SIZE_MAX, bound, &near, NULL) == FROE_OK)
        for (size_t i = 1; i < near.count; i++)
            expect(a, near.items[i].distance >= near.items[i - 1].distance, "order of neighbours");
    if (froe_query_near(a->q, x, 1, INFINITY, &near, NULL) == FROE_OK && near.count) {
        const froe_neighbour first = near.items[0];
        double at[FROE_MAX_DIM];
        bool same = true;
        expect(a, froe_query_nearest_point(a->q, first.object, x, at, NULL) == FROE_OK, "nearest point");
        for (int k = 0; k < a->dim && a->right; k++) same = same && at[k] == x[k];
        expect(a, first.distance != 0 || same, "nearest point of an object around it");
    }
}

static void ask_ray(const asking *a, const double *origin, const double *direction) {
    const double end = fuzz_byte(a->bytes) % 3 ? INFINITY : fuzz_double(a->bytes);
    froe_hit first;
    froe_hits all;
    uint32_t any;
    if (froe_query_ray(a->q, origin, direction, end, &first, NULL)) return;
    if (froe_query_ray_all(a->q, origin, direction, end, &all, NULL) == FROE_OK) {
        expect(a,
               all.count ? all.hits[0].object == first.object && all.hits[0].t == first.t : first.object == FROE_NONE,
               "first hit");
        for (size_t i = 1; i < all.count; i++) expect(a, all.hits[i].t >= all.hits[i - 1].t, "order of hits");
    }
    if (froe_query_ray_any(a->q, origin, direction, end, &any, NULL) == FROE_OK)
        expect(a, (any == FROE_NONE) == (first.object == FROE_NONE), "any hit");
    froe_hit_place place;
    if (first.object != FROE_NONE)
        expect(a, froe_query_hit_place(a->q, first.object, origin, direction, &place, NULL) == FROE_OK,
               "place of a hit");
}

static bool see_pair(void *user, const froe_pair *pair) {
    (void)pair;
    return ++*(size_t *)user < MOST_PAIRS;
}

/* ------------------------------------------------------------------ batches -- */

static void ask_batches(const asking *a) {
    double x[BATCH * FROE_MAX_DIM], d[BATCH * FROE_MAX_DIM];
    froe_batch_options o = froe_batch_defaults();
    froe_answers answers;
    froe_hit hits[BATCH];
    uint32_t objects[BATCH];
    size_t pairs = 0;
    o.threads = 1 + fuzz_byte(a->bytes) % 3;
    for (int i = 0; i < BATCH * a->dim; i++) x[i] = fuzz_double(a->bytes), d[i] = fuzz_double(a->bytes);
    if (!froe_batch_locate(a->q, x, BATCH, &o, &answers, NULL)) froe_answers_free(&answers);
    if (!froe_batch_groups(a->q, x, BATCH, &o, &answers, NULL)) froe_answers_free(&answers);
    for (froe_relation relation = 0; relation < FROE_RELATION_COUNT; relation++)
        if (!froe_batch_groups_join(a->q, a->q, relation, &o, &answers, NULL)) froe_answers_free(&answers);
    if (!froe_batch_near(a->q, x, BATCH, 3, INFINITY, &o, &answers, NULL)) froe_answers_free(&answers);
    if (!froe_batch_ray_all(a->q, x, d, BATCH, INFINITY, &o, &answers, NULL)) froe_answers_free(&answers);
    (void)froe_batch_ray_any(a->q, x, d, BATCH, INFINITY, &o, objects, NULL);
    (void)froe_batch_vertical(a->q, x, BATCH, 1, &o, objects, NULL);
    (void)froe_batch_pairs(a->q, fuzz_byte(a->bytes) % 2, &o, see_pair, &pairs, NULL);
    if (froe_batch_ray(a->q, x, d, BATCH, INFINITY, &o, hits, NULL)) return;
    for (size_t i = 0; i < BATCH; i++) {
        const size_t at = i * (size_t)a->dim;
        froe_hit alone;
        if (froe_query_ray(a->q, x + at, d + at, INFINITY, &alone, NULL) == FROE_OK)
            expect(a, alone.object == hits[i].object && (alone.object == FROE_NONE || alone.t == hits[i].t), "batch");
    }
}

void ask(const froe_tree *tree, bool right, fuzz_bytes *bytes) {
    asking a = {.scene = froe_tree_scene(tree), .right = right, .bytes = bytes};
    a.dim = froe_scene_dim(a.scene);
    if (froe_query_new(tree, &a.q, NULL)) return;
    for (int rounds = 1 + fuzz_byte(bytes) % 3; rounds; rounds--) {
        double x[FROE_MAX_DIM], d[FROE_MAX_DIM];
        size_t pairs = 0;
        for (int k = 0; k < FROE_MAX_DIM; k++) x[k] = fuzz_double(bytes), d[k] = fuzz_double(bytes);
        ask_range(&a);
        ask_point(&a, x);
        ask_ray(&a, x, d);
        (void)froe_query_pairs(a.q, fuzz_byte(bytes) % 2, see_pair, &pairs, NULL);
    }
    ask_batches(&a);
    froe_query_free(a.q);
}
