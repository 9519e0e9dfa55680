/* jump.c: see jump.h. */
#include "query/range/jump.h"
#include <math.h>
#include <string.h>

froe_status query_jump_prepare(froe_query *query, froe_walk walk, query_jump *out) {
    froe_status status = FROE_OK;
    *out = (query_jump){.stats = &query->stats};
    const bool asked = walk == FROE_WALK_BOX || walk == FROE_WALK_LCA;
    if (walk == FROE_WALK_PLAIN || (!asked && !query_is_deep(query->tree))) return FROE_OK;
    status = query_centroids_of(query, &out->centroids, NULL);
    if (!status && walk == FROE_WALK_LCA) status = query_ancestors_of(query, &out->ancestors, NULL);
    return status;
}

/* The highest of the lowest common ancestors of both ends along each axis. All of them are in the subtree of one. */
static uint32_t highest_cut(const query_jump *j, const double *lo, const double *hi) {
    const int dim = j->centroids->dim;
    double x[FROE_MAX_DIM];
    uint32_t highest = FROE_NONE;
    for (int k = 0; k < dim; k++) { /* a number between two, which halves of the least ones would miss */
        x[k] = 0.5 * lo[k] + 0.5 * hi[k];
        if (x[k] < lo[k] || x[k] > hi[k]) x[k] = lo[k];
    }
    for (int k = 0; k < dim; k++) {
        const double middle = x[k];
        x[k] = lo[k];
        const uint32_t a = query_centroid_find(j->centroids, x, x, &j->stats->steps);
        x[k] = hi[k];
        const uint32_t b = query_centroid_find(j->centroids, x, x, &j->stats->steps);
        x[k] = middle;
        const uint32_t common = query_ancestors_lowest(j->ancestors, a, b);
        if (highest == FROE_NONE || j->ancestors->of[common].order < j->ancestors->of[highest].order) highest = common;
    }
    return highest;
}

/* Where the box reaches the border of the region, cuts beyond do not matter: what is looked for ends just inside. */
uint32_t query_jump_below(const query_jump *j, uint32_t node, double *lo, double *hi) {
    const int dim = j->centroids->dim;
    const double *region = query_centroid_box(j->centroids, node); /* empty below oblique cuts */
    for (int k = 0; k < dim; k++) {
        const double inside[2] = {nextafter(region[k], INFINITY), nextafter(region[dim + k], -INFINITY)};
        if (inside[0] > inside[1]) return node;
        if (lo[k] < inside[0]) lo[k] = inside[0];
        if (hi[k] > inside[1]) hi[k] = inside[1];
        if (lo[k] > inside[1]) lo[k] = inside[1];
        if (hi[k] < inside[0]) hi[k] = inside[0];
    }
    const uint32_t found =
        j->ancestors ? highest_cut(j, lo, hi) : query_centroid_find(j->centroids, lo, hi, &j->stats->steps);
    return found > node ? found : node;
}
