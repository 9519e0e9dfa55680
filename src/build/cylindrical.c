/* cylindrical.c: trapezoids between the objects, in random order (Agarwal, Erickson and Guibas 1998).
 *
 *     o------:------o     Every object, in turn, is cut out of the cells it meets: walls up and down from
 *       :    :   :        its ends and from where it crosses others, then its own line; in space from its
 *       :  o-:---:--o     edges, then its own plane. In random order the tree has O(n log n + k) nodes for
 *       :    :   :        n segments with k crossings, and height O(log n) with high probability.
 *
 * The tree is a function of the order and the coordinates alone. An order that gets too deep is dropped for another:
 * that hardly ever happens, and whether it does depends on nothing but scene and seed. */
#include "base/log2.h"
#include "base/radix.h"
#include "base/random.h"
#include "build/cylindrical/cylinder.h"
#include "build/method.h"
#include "support/fail.h"

enum { HEIGHT, DRAWS, CROSSING };

static const char *const crossing[] = {"refuse", "split", NULL};
static const froe_option_info options[] = {
    [HEIGHT] = {"height", "redraw the order beyond height * log2(n + 2) + 24; -1: by dimension", -1, -1, 100, NULL,
                false},
    [DRAWS] = {"draws", "orders to try before taking one of any height", 4, 1, 100, NULL, true},
    [CROSSING] = {"crossing", "what to do with polygons that cross others", 0, 0, 1, crossing, true},
    {0},
};

static void resolve_cylindrical(const froe_scene *scene, uint32_t leaf, double *option) {
    (void)leaf;
    if (option[HEIGHT] < 0) option[HEIGHT] = scene->dim == 2 ? 6 : 10;
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
    split_cylinder cylinder = {
        .leaf = job->leaf, .deepest = deepest, .refuse = job->option[CROSSING] == 0, .too_deep = &deep};
    split_method method = {.config = &cylinder,
                           .choose = split_cylinder_choose,
                           .room = sizeof(split_cylinder_frame),
                           .divided = split_cylinder_divided};
    split_job split = build_split_job(job);
    split.order = order;
    split.diag = why;
    froe_status status = split_grow(&split, &method, out);
    *too_deep = status == FROE_E_BUDGET && atomic_load(&deep);
    return status;
}

static froe_status build_cylindrical(build_job *job, froe_tree **out) {
    draw d = {NULL, NULL};
    froe_diagnostic why = {0};
    froe_status status = FROE_OK;
    const size_t n = job->scene->object_count;
    const uint32_t draws = job->order ? 0 : (uint32_t)job->option[DRAWS];
    const double height = job->option[HEIGHT] * base_log2((double)n + 2) + 24;
    if (!job->order) {
        d.order = support_calloc(&job->alloc, n, sizeof *d.order);
        d.keys = support_calloc(&job->alloc, 2 * n, sizeof *d.keys);
    }
    if (job->order || (d.order && d.keys)) {
        double *promised = &job->meta.promises[job->meta.promise_count].promised;
        bool too_deep = true;
        build_promise(job, "height", height, 0);
        for (uint32_t i = 0; i < draws && too_deep; i++)
            status = grow_cylindrical(job, draw_order(job, &d, i), (uint32_t)height, &too_deep, &why, out);
        if (too_deep) {
            /* a bound on the height: no wall, edge or plane comes twice on a path */
            *promised = 3.0 * job->scene->corner_count + job->scene->object_count;
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
             .guarantee = "2D: O(n log n + k) nodes expected for k crossings, height O(log n) with high probability",
             .kinds = BUILD_SERVES(1u << 2 | 1u << 3, 1u << FROE_POINT | 1u << FROE_SEGMENT | 1u << FROE_POLYGON),
             .options = options},
    .resolve = resolve_cylindrical,
    .ordered = true,
    .build = build_cylindrical,
};
