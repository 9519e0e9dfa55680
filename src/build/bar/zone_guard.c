/* zone_guard.c: by ranks: the way amid the chamber of an order of the coordinates has their ranks for entries. */
#include "build/bar/zone_guard.h"
#include <math.h>

static double coordinate(const double *x, int i, int dim) {
    return i < dim ? x[i] : 0;
}

/** The largest x_i - x_j of an object, for each pair. */
static void support_of(const froe_scene *scene, uint32_t object, double most[ZONE_NODES][ZONE_NODES]) {
    const int dim = scene->dim;
    const froe_kind form = scene_form(scene, object);
    const bool box = form == FROE_BOX;
    const double radius = form == FROE_BALL ? scene_radius(scene, object) : 0;
    const uint32_t corners = box || form == FROE_BALL ? 1 : scene_corners(scene, object);
    for (int i = 0; i <= dim; i++)
        for (int j = 0; j <= dim; j++) {
            const double reach = radius * sqrt((i < dim) + (j < dim));
            most[i][j] = -INFINITY;
            for (uint32_t c = 0; c < corners && i != j; c++) {
                const double *lo = scene_point(scene, object, c), *hi = box ? scene_point(scene, object, 1) : lo;
                most[i][j] = fmax(most[i][j], coordinate(hi, i, dim) - coordinate(lo, j, dim) + reach);
            }
        }
}

/** Numbers the coordinates of a vector, and the 0 after them, by size. */
static void rank_coordinates(const double *x, int dim, int *rank) {
    for (int i = 0; i <= dim; i++) {
        rank[i] = 0;
        for (int j = 0; j <= dim; j++) {
            const double a = coordinate(x, i, dim), b = coordinate(x, j, dim);
            rank[i] += b < a || (b == a && j < i);
        }
    }
}

bool zone_guard_of(const froe_scene *scene, uint32_t object, const bar_zone *zone, double *out) {
    const int dim = scene->dim;
    double most[ZONE_NODES][ZONE_NODES], middle[FROE_MAX_DIM], way[FROE_MAX_DIM], t = 0;
    int rank[ZONE_NODES];
    support_of(scene, object, most);
    for (int k = 0; k < dim; k++) {
        middle[k] = 0.5 * most[k][dim] - 0.5 * most[dim][k];
        way[k] = zone->centre[k] - middle[k];
    }
    rank_coordinates(way, dim, rank);
    for (int i = 0; i <= dim; i++)
        for (int j = 0; j <= dim; j++)
            if (rank[i] > rank[j]) {
                const double from = coordinate(middle, i, dim) - coordinate(middle, j, dim);
                t = fmax(t, (most[i][j] - from) / (rank[i] - rank[j]));
            }
    for (int k = 0; k < dim; k++) out[k] = middle[k] + t * (rank[k] - rank[dim]) + 0.0;
    for (int i = 0; i <= dim; i++)
        for (int j = 0; j <= dim; j++)
            if (i != j && !(coordinate(out, i, dim) - coordinate(out, j, dim) < zone->most[i][j])) return false;
    return true;
}
