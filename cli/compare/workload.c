/* workload.c: queries near objects, where something is to be found, drawn from the seed alone.
 *
 * Each kind is asked twice: once to count nodes, query by query, which also warms the caches, and once by the clock
 * of the processor. */
#include "compare/workload.h"
#include "compare/part.h"
#include "progress.h"
#include "report/report.h"
#include <math.h>
#include <stdlib.h>

typedef enum query_kind { POINT, WINDOW, RAY, APPROXIMATE } query_kind;

typedef struct workload_state {
    const workload *load;
    const froe_scene *scene;
    froe_query *query;
    froe_diagnostic *diag;
    int dim;
    double side[FROE_MAX_DIM]; /* of the scene */
    uint64_t key, draws;       /* of random numbers */
    uint64_t *nodes;           /* by each query */
} workload_state;

/* ------------------------------------------------------------------- drawing -- */

/* A random number in [0, 1) (Steele, Lea and Flood 2014: splitmix64). */
static double draw_workload(workload_state *r) {
    uint64_t x = r->key + ++r->draws * 0x9E3779B97F4A7C15u;
    x = (x ^ x >> 30) * 0xBF58476D1CE4E5B9u;
    x = (x ^ x >> 27) * 0x94D049BB133111EBu;
    return (double)((x ^ x >> 31) >> 11) * 0x1p-53;
}

/* A place near a corner of an object, `away` sides of the scene from it at most. */
static void draw_place(workload_state *r, double away, double *out) {
    const uint32_t object = (uint32_t)(draw_workload(r) * (double)froe_scene_object_count(r->scene));
    const double *corner = part_corner(r->scene, object, (uint32_t)(draw_workload(r) * 8));
    for (int k = 0; k < r->dim; k++) out[k] = corner[k] + away * (2 * draw_workload(r) - 1) * r->side[k];
}

/* -------------------------------------------------------------------- asking -- */

static froe_status ask_range(workload_state *r, double share, double eps, uint64_t *found) {
    double points[2 * FROE_MAX_DIM];
    froe_range window = froe_range_defaults();
    froe_list list;
    draw_place(r, 0.5 * share, points);
    for (int k = 0; k < r->dim; k++) {
        const double half = 0.5 * share * r->side[k], middle = points[k];
        points[k] = middle - half;
        points[r->dim + k] = middle + half;
    }
    window.points = points;
    window.eps = eps;
    const froe_status status = froe_query_range(r->query, &window, &list, r->diag);
    if (!status) *found += list.count;
    return status;
}

static froe_status ask_workload(workload_state *r, query_kind kind, double eps, uint64_t i, uint64_t *found) {
    double place[FROE_MAX_DIM], direction[FROE_MAX_DIM];
    froe_list list;
    froe_hit hit;
    froe_status status;
    r->key = r->load->seed * 0xD1342543DE82EF95u + (uint64_t)kind;
    r->draws = i << 8;
    switch (kind) { /* one way: each kind has a case */
    case POINT:
        draw_place(r, 0.01, place);
        status = froe_query_locate(r->query, place, &list, r->diag);
        if (!status) *found += list.count;
        return status;
    case WINDOW:
        return ask_range(r, 1.0 / 32, 0, found);
    case RAY:
        draw_place(r, 0.1, place);
        for (int k = 0; k < r->dim; k++) direction[k] = draw_workload(r) - 0.5;
        status = froe_query_ray(r->query, place, direction, INFINITY, &hit, r->diag);
        if (!status) *found += hit.object != FROE_NONE;
        return status;
    case APPROXIMATE:
        break;
    }
    return ask_range(r, 1.0 / 8, eps, found);
}

/* ------------------------------------------------------------------ counting -- */

static int by_value(const void *a, const void *b) {
    const uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return x < y ? -1 : x > y;
}

/* Counts first, then times: those of this thread, which runs all queries, so that other work of the machine counts
 * less. Counting ends early when the time is over or the program is interrupted. */
static json_t *measure(workload_state *r, query_kind kind, double eps, uint64_t count, froe_status *status) {
    froe_query_stats sum = {.queries = 0};
    uint64_t found = 0, asked = 0;
    const double started = cli_thread_seconds();
    froe_query_statistics(r->query);
    while (asked < count && !*status && !cli_interrupted() && cli_thread_seconds() - started <= r->load->seconds) {
        *status = ask_workload(r, kind, eps, asked, &found);
        const froe_query_stats one = froe_query_statistics(r->query);
        sum.nodes += one.nodes, sum.leaves += one.leaves, sum.tests += one.tests;
        r->nodes[asked++] = one.nodes;
    }
    if (*status) return NULL;
    const double each = asked ? 1 / (double)asked : 0;
    qsort(r->nodes, asked, sizeof *r->nodes, by_value);
    json_t *out =
        json_pack("{s:I, s:f, s:I, s:f, s:f, s:f}", "asked", (json_int_t)asked, "nodes", each * (double)sum.nodes,
                  "nodes_p99", (json_int_t)(asked ? r->nodes[asked * 99 / 100] : 0), "leaves",
                  each * (double)sum.leaves, "tests", each * (double)sum.tests, "found", each * (double)found);
    if (!r->load->times || !asked) return out;
    const double start = cli_thread_seconds();
    for (uint64_t i = 0; i < asked && !*status; i++) *status = ask_workload(r, kind, eps, i, &found);
    json_object_set_new(out, "microseconds", json_real(1e6 * (cli_thread_seconds() - start) / (double)asked));
    return out;
}

static json_t *measure_all(workload_state *r, froe_status *status) {
    json_t *out = json_object(), *by_eps = json_array();
    const uint64_t count = r->load->count;
    json_object_set_new(out, "point", measure(r, POINT, 0, count, status));
    if (!*status) json_object_set_new(out, "window", measure(r, WINDOW, 0, count, status));
    if (!*status && r->dim <= 3) json_object_set_new(out, "ray", measure(r, RAY, 0, count, status));
    for (int i = 0; i <= 7 && !*status; i++) {
        const double eps = i < 7 ? ldexp(1, -i) : 0;
        json_t *costs = measure(r, APPROXIMATE, eps, count / 4 + 1, status);
        json_object_set_new(costs, "eps", json_real(eps));
        json_array_append_new(by_eps, costs);
    }
    json_object_set(out, "by_eps", by_eps);
    json_object_set(out, "approximate", json_array_get(by_eps, 3)); /* eps = 1/8 */
    json_decref(by_eps);
    if (!*status) return out;
    json_decref(out);
    return NULL;
}

json_t *workload_run(const froe_tree *tree, const workload *load, froe_status *status, froe_diagnostic *diag) {
    workload_state r = {.load = load, .scene = froe_tree_scene(tree), .diag = diag};
    double lo[FROE_MAX_DIM] = {0}, hi[FROE_MAX_DIM] = {0};
    r.dim = froe_scene_dim(r.scene);
    froe_scene_bounds(r.scene, lo, hi);
    for (int k = 0; k < r.dim; k++) r.side[k] = fmin(hi[k] - lo[k], 0x1p1000); /* windows stay finite */
    r.nodes = calloc(load->count + 1, sizeof *r.nodes);
    *status = r.nodes ? froe_query_new(tree, &r.query, diag) : FROE_E_MEMORY;
    json_t *out = *status ? NULL : measure_all(&r, status);
    if (r.query) froe_query_free(r.query);
    free(r.nodes);
    return out;
}
