/* cylindrical.c: trapezoids between the objects, in random order (Agarwal, Erickson and Guibas 1998).
 *
 *     o------:------o     Every object, in turn, is cut out of the cells it meets: walls up and down from
 *       :    :   :        its ends and from where it crosses others, then its own line; in space from its
 *       :  o-:---:--o     edges, then its own plane. In random order the tree has O(n log n + k) nodes for
 *       :    :   :        n segments with k crossings, and height O(log n) with high probability.
 *
 * The tree is a function of the order and the coordinates alone. An order that gets too deep, or in the plane makes too
 * many nodes, is dropped for another: that hardly ever happens, and whether it does depends on nothing but scene and
 * seed.
 *
 * Too many are twice as many as are expected of n segments with k crossings, so one order in two is small enough. There
 * are 2 n walls of ends, 2 k of crossings, and n + k cuts along segments, besides one for each segment that a wall
 * crosses. A wall upwards from an end crosses the first i segments above if they all come later: with probability
 * 1 / (i + 1), H_n - 1 in all; one from a crossing if they come after both that cross: 2 / ((i + 1)(i + 2)), 1 in all
 * (lemma 2.1). Downwards is the same: 3 n + 4 n (H_n - 1) + 5 k cuts. */
#include "base/log2.h"
#include "base/radix.h"
#include "base/random.h"
#include "base/sort.h"
#include "build/cylindrical/cylinder.h"
#include "build/cylindrical/plane.h"
#include "build/method.h"
#include "support/fail.h"
#include <math.h>
#include <string.h>

enum { HEIGHT, DRAWS, CROSSING, EDGES, TUNING, SIZE };

static const char *const crossing[] = {"refuse", "split", NULL};
static const char *const edges[] = {"longest", "given", NULL};
static const froe_option_info options[] = {
    [HEIGHT] = {"height", "redraw the order beyond height * log2(n + 2) + 24; -1: by dimension", -1, -1, 100, NULL,
                false},
    [DRAWS] = {"draws", "orders to try before taking one of any height", 4, 1, 100, NULL, true},
    [CROSSING] = {"crossing", "what to do with polygons that cross others", 0, 0, 1, crossing, true},
    [EDGES] = {"edges", "the edge of a polygon that cuts first in a cell: the longest, or the first as given", 0, 0, 1,
               edges, true},
    [TUNING] = {0},
    [SIZE] = {"size", "redraw the order beyond so many times the nodes that are expected", 2, 0, 1e9, NULL, false},
    {0},
};

static void resolve_cylindrical(const froe_scene *scene, uint32_t leaf, double *option) {
    (void)leaf;
    if (option[HEIGHT] < 0) option[HEIGHT] = scene->dim == 2 ? 6 : 10;
}

static double height_wanted(const build_job *job) {
    return job->option[HEIGHT] * base_log2((double)job->scene->object_count + 2) + 24;
}

typedef struct draw {
    uint32_t *order; /**< NULL: it is the caller's */
    base_pair *keys; /**< two for each object */
} draw;

/** The order for an attempt. */
static const uint32_t *draw_order(const build_job *job, draw *d, uint32_t attempt) {
    uint32_t n = job->scene->object_count;
    if (job->order) return job->order;
    for (uint32_t i = 0; i < n; i++) d->keys[i] = (base_pair){base_hash(job->seed, attempt, i), i};
    base_radix_sort(d->keys, d->keys + n, n);
    for (uint32_t i = 0; i < n; i++) d->order[i] = d->keys[i].value;
    return d->order;
}

/** Grows the tree to a given height at most (0: any). *too_deep: that was too little. */
static froe_status grow_cylindrical(build_job *job, const uint32_t *order, uint32_t deepest, bool *too_deep,
                                    froe_diagnostic *why, froe_tree **out) {
    atomic_bool deep;
    atomic_init(&deep, false);
    const plane_rules plane = {.leaf = job->leaf, .deepest = deepest, .too_deep = &deep};
    const split_cylinder cylinder = {.leaf = job->leaf,
                                     .deepest = deepest,
                                     .refuse = job->option[CROSSING] == 0,
                                     .given = job->option[EDGES] == 1,
                                     .too_deep = &deep};
    const split_method method = {.config = &cylinder,
                                 .choose = split_cylinder_choose,
                                 .room = sizeof(split_cylinder_frame),
                                 .divided = split_cylinder_divided};
    split_job split = build_split_job(job);
    split.order = order;
    split.diag = why;
    froe_status status = job->scene->dim == 2 ? plane_grow(&split, &plane, out) : split_grow(&split, &method, out);
    *too_deep = status == FROE_E_BUDGET && atomic_load(&deep);
    return status;
}

/* ------------------------------------------------------------------ size -- */

static int compare_pairs(const void *a, const void *b) {
    const uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

/** How many crossings walls go through. */
static froe_status count_crossings(const build_job *job, const froe_tree *tree, uint64_t *out) {
    uint64_t *pairs = support_calloc(&job->alloc, tree->cut_count, sizeof *pairs), count = 0;
    if (!pairs) return FROE_E_MEMORY;
    for (uint32_t i = 0; i < tree->cut_count; i++) {
        const uint32_t a = tree->cuts[i].a, b = tree->cuts[i].u.id.b;
        if (tree->cuts[i].kind == FROE_CUT_CROSSING)
            pairs[count++] = a < b ? (uint64_t)a << 32 | b : (uint64_t)b << 32 | a;
    }
    base_sort(pairs, (size_t)count, sizeof *pairs, compare_pairs);
    *out = count > 0;
    for (uint64_t i = 1; i < count; i++) *out += pairs[i] != pairs[i - 1];
    support_free(&job->alloc, pairs, tree->cut_count ? tree->cut_count * sizeof *pairs : 1);
    return FROE_OK;
}

/** Promises the size of a tree of the plane, twice what is expected, and with it how many pieces cuts dealt. A larger
 * tree is freed, for another draw. */
static froe_status promise_size(const build_job *job, froe_tree **tree, bool *too_large) {
    uint64_t k = 0;
    const double n = job->scene->object_count;
    double harmonic = 0;
    froe_status status = count_crossings(job, *tree, &k);
    for (double i = n; i >= 1; i--) harmonic += 1 / i;
    const double cuts = 3 * n + 4 * n * fmax(harmonic - 1, 0) + 5 * (double)k;
    const double nodes = 2 * job->option[SIZE] * cuts + 1;
    const froe_report r = (*tree)->report;
    *too_large = !status && ((double)r.nodes > nodes || (double)r.fragments > nodes);
    if (status || *too_large) {
        froe_tree_free(*tree);
        *tree = NULL;
        return status;
    }
    tree_promise_anew(*tree, "nodes", nodes);
    tree_promise_anew(*tree, "fragments", nodes);
    tree_promise_anew(*tree, "path_length", nodes * floor(height_wanted(job)));
    return FROE_OK;
}

/* ----------------------------------------------------------------- build -- */

/** Of orders drawn at random the first whose tree is low and small, with the promises of that; *found false: there was
 * none, and no tree. */
static froe_status grow_as_promised(build_job *job, draw *d, froe_diagnostic *why, bool *found, froe_tree **out) {
    const uint32_t draws = job->order ? 0 : (uint32_t)job->option[DRAWS];
    const bool plane = job->scene->dim == 2;
    froe_status status = FROE_OK;
    build_promise(job, "height", height_wanted(job), 0);
    if (plane) {
        build_promise(job, "nodes", 0, 0); /* renewed when the crossings are known */
        build_promise(job, "fragments", 0, 0);
        build_promise(job, "path_length", 0, 0);
    }
    *found = false;
    for (uint32_t i = 0; i < draws && !*found && !status; i++) {
        bool too_much;
        status = grow_cylindrical(job, draw_order(job, d, i), (uint32_t)height_wanted(job), &too_much, why, out);
        if (too_much)
            status = FROE_OK;
        else if (!status && plane)
            status = promise_size(job, out, &too_much) ? support_fail_memory(why) : FROE_OK;
        *found = !status && !too_much;
    }
    return status;
}

static froe_status build_cylindrical(build_job *job, froe_tree **out) {
    draw d = {NULL, NULL};
    froe_diagnostic why = {0};
    froe_status status = FROE_OK;
    const size_t n = job->scene->object_count;
    if (!job->order) {
        d.order = support_calloc(&job->alloc, n, sizeof *d.order);
        d.keys = support_calloc(&job->alloc, 2 * n, sizeof *d.keys);
    }
    if (job->order || (d.order && d.keys)) {
        const uint32_t before = job->meta.promise_count;
        bool found = true, too_deep;
        status = grow_as_promised(job, &d, &why, &found, out);
        if (!status && !found) {
            /* nothing is promised of an order that the caller chose, or after so many unlucky draws */
            memset(job->meta.promises + before, 0, (job->meta.promise_count - before) * sizeof *job->meta.promises);
            job->meta.promise_count = before;
            status = grow_cylindrical(job, draw_order(job, &d, 0), 0, &too_deep, &why, out);
        }
        if (status && job->diag) *job->diag = why;
    } else {
        status = support_fail_memory(job->diag);
    }
    support_free(&job->alloc, d.order, n ? n * sizeof *d.order : 1);
    support_free(&job->alloc, d.keys, n ? 2 * n * sizeof *d.keys : 1);
    return status;
}

const build_method build_method_cylindrical = {
    .info = {.name = "cylindrical",
             .summary = "trapezoids between the objects, in random order",
             .source = "Agarwal, Erickson and Guibas 1998, theorems 2.3 and 2.5",
             .guarantee = "2D: O(n log n + k) nodes for k crossings; height O(log n); both by drawing again",
             .kinds = BUILD_SERVES(1u << 2 | 1u << 3, 1u << FROE_POINT | 1u << FROE_SEGMENT | 1u << FROE_POLYGON),
             .options = options},
    .tunable = true,
    .resolve = resolve_cylindrical,
    .ordered = true,
    .build = build_cylindrical,
};
