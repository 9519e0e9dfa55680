/* opened.h: questions to an opened tree of which nothing has been checked yet: searches that check what they read.
 *
 * The file may be wrong: then a call returns FROE_E_FORMAT, or answers with objects that exist. Nothing here asks for
 * all of the tree, so that what has been read so far is what the searches have read. */
#ifndef FROE_TESTS_SUPPORT_OPENED_H
#define FROE_TESTS_SUPPORT_OPENED_H
#include "base/random.h"
#include "support/memory.h"
#include <froe/query.h>
#include <math.h>

/** A place in the bounds of the scene, which may be any finite numbers, or beside them. */
static inline void opened_place(const froe_scene *scene, uint64_t seed, uint64_t i, double *x) {
    double lo[FROE_MAX_DIM] = {0}, hi[FROE_MAX_DIM] = {0};
    froe_scene_bounds(scene, lo, hi);
    for (int k = 0; k < froe_scene_dim(scene); k++) {
        const double share = (double)base_below(base_hash(seed, i, (uint64_t)k), 1000) / 900 - 0.05;
        x[k] = lo[k] * (1 - share) + hi[k] * share;
    }
}

static inline void opened_check(froe_status status) {
    assert_true(status == FROE_OK || status == FROE_E_FORMAT || status == FROE_E_UNSUPPORTED || status == FROE_E_INPUT);
}

/** Every object that is found can be looked at. */
static inline void opened_look(const froe_scene *scene, froe_status status, const uint32_t *ids, size_t count) {
    opened_check(status);
    for (size_t i = 0; !status && i < count; i++) {
        assert_true(ids[i] < froe_scene_object_count(scene));
        const froe_object object = froe_scene_object(scene, ids[i]);
        for (uint32_t c = 0; c < object.corners; c++)
            assert_non_null(froe_scene_vertex(scene, froe_scene_corner(scene, ids[i], c)));
        if (object.group != FROE_NONE) assert_non_null(froe_scene_group(scene, object.group).name);
    }
}

static inline void opened_ask_places(froe_query *q, const froe_scene *scene, uint64_t seed, uint64_t round) {
    const size_t dim = (size_t)froe_scene_dim(scene);
    double box[2 * FROE_MAX_DIM], x[FROE_MAX_DIM], way[FROE_MAX_DIM], other[FROE_MAX_DIM];
    froe_range window = froe_range_defaults();
    froe_list found = {0};
    froe_neighbours near = {0};
    froe_answers many = {0};
    froe_hit hit = {.object = FROE_NONE};
    uint32_t one = FROE_NONE;
    uint64_t count;
    opened_place(scene, seed, 2 * round, x);
    opened_place(scene, seed, 2 * round + 1, other);
    for (size_t k = 0; k < dim; k++) {
        box[k] = x[k] < other[k] ? x[k] : other[k];
        box[dim + k] = round % 2 ? box[k] : x[k] < other[k] ? other[k] : x[k];
        way[k] = other[k] - x[k];
    }
    window.points = box;
    opened_check(froe_query_count(q, &window, &count, NULL));
    froe_status status = froe_query_any(q, &window, &one, NULL);
    opened_look(scene, status, &one, !status && one != FROE_NONE);
    status = froe_query_range(q, &window, &found, NULL);
    opened_look(scene, status, found.ids, found.count);
    status = froe_batch_boxes(q, box, 1, NULL, &many, NULL);
    opened_look(scene, status, many.ids, status ? 0 : many.starts[1]);
    if (!status) froe_answers_free(&many);
    status = froe_query_near(q, x, 1 + round % 3, INFINITY, &near, NULL);
    opened_check(status);
    for (size_t i = 0; !status && i < near.count; i++) opened_look(scene, status, &near.items[i].object, 1);
    if (dim == 2) status = froe_query_vertical(q, x, round % 2 ? 1 : -1, &one, NULL);
    if (dim == 2) opened_look(scene, status, &one, !status && one != FROE_NONE);
    if (dim == 3) status = froe_query_ray(q, x, way, INFINITY, &hit, NULL);
    if (dim == 3) opened_look(scene, status, &hit.object, !status && hit.object != FROE_NONE);
}

static inline void opened_ask(const froe_tree *tree, uint64_t seed, int rounds) {
    const froe_scene *scene = froe_tree_scene(tree);
    froe_query *q;
    if (froe_query_new(tree, &q, NULL)) return;
    for (int round = 0; round < rounds; round++) opened_ask_places(q, scene, seed, (uint64_t)round);
    froe_query_free(q);
}
#endif
