/* zone.c: shortest paths. */
#include "build/bar/zone.h"
#include "num/pair.h"
#include "support/arithmetic.h"
#include <math.h>

/* e_i - e_j for i < j, by rows (i, j) in order. */
#define AT(i, j, k) (((i) == (k)) - ((j) == (k)))
#define ROW(i, j)                                                                                                      \
    { AT(i, j, 0), AT(i, j, 1), AT(i, j, 2), AT(i, j, 3), AT(i, j, 4), AT(i, j, 5), AT(i, j, 6), AT(i, j, 7) }
static const double differences[FROE_MAX_DIM][FROE_MAX_DIM][FROE_MAX_DIM] = {
    {[1] = ROW(0, 1), ROW(0, 2), ROW(0, 3), ROW(0, 4), ROW(0, 5), ROW(0, 6), ROW(0, 7)},
    {[2] = ROW(1, 2), ROW(1, 3), ROW(1, 4), ROW(1, 5), ROW(1, 6), ROW(1, 7)},
    {[3] = ROW(2, 3), ROW(2, 4), ROW(2, 5), ROW(2, 6), ROW(2, 7)},
    {[4] = ROW(3, 4), ROW(3, 5), ROW(3, 6), ROW(3, 7)},
    {[5] = ROW(4, 5), ROW(4, 6), ROW(4, 7)},
    {[6] = ROW(5, 6), ROW(5, 7)},
    {[7] = ROW(6, 7)}};

bar_zone bar_zone_of(int dim, const double *lo, const double *hi) {
    bar_zone z = {.goal = 0};
    for (int i = 0; i < ZONE_NODES; i++)
        for (int j = 0; j < ZONE_NODES; j++) z.most[i][j] = i == j ? 0 : INFINITY;
    for (int k = 0; k < dim; k++) {
        z.most[k][dim] = hi[k];
        z.most[dim][k] = -lo[k];
        z.centre[k] = 0.5 * lo[k] + 0.5 * hi[k];
    }
    return z;
}

void zone_shape_of(const bar_zone *zone, int dim, const double *origin, zone_shape *s) {
    s->dim = dim;
    for (int k = 0; k < dim; k++) s->origin[k] = origin[k];
    for (int i = 0; i <= dim; i++)
        for (int j = 0; j <= dim; j++) {
            const num_pair at = num_pair_sum(i < dim ? origin[i] : 0, j < dim ? -origin[j] : 0);
            const double most = zone->most[i][j];
            const double slack = most < INFINITY ? num_pair_sub((num_pair){most, 0}, at).hi : most;
            s->most[i][j] = slack > 0 ? slack : 0;
        }
    for (int k = 0; k <= dim; k++)
        for (int i = 0; i <= dim; i++)
            for (int j = 0; j <= dim; j++) {
                const double by = s->most[i][k] + s->most[k][j];
                if (by < s->most[i][j]) s->most[i][j] = by;
            }
    s->widest = 0;
    s->narrowest = INFINITY;
    for (int i = 0; i <= dim; i++)
        for (int j = 0; j < i; j++) {
            const double width = zone_shape_width(s, i, j);
            if (width > s->widest) s->widest = width;
            if (width < s->narrowest) s->narrowest = width;
        }
    s->reach = 0;
    for (int k = 0; k < dim; k++) s->reach = fmax(s->reach, fabs(origin[k]) + s->widest);
}

double zone_shape_widest_below(const zone_shape *s, int i, int j, double value) {
    double widest = 0;
    for (int k = 0; k <= s->dim; k++)
        for (int l = 0; l < k; l++) {
            const double there = s->most[k][i] + value + s->most[j][l], back = s->most[l][i] + value + s->most[j][k];
            const double width = fmin(s->most[k][l], there) + fmin(s->most[l][k], back);
            if (width > widest) widest = width;
        }
    return widest;
}

/* -------------------------------------------------------------------- cuts -- */

froe_cut zone_shape_cut(const zone_shape *s, int from, int to, double given) {
    const int i = from < to ? from : to, j = from < to ? to : from;
    const double value = from < to ? given : -given;
    const num_pair at = num_pair_sum(s->origin[i], j < s->dim ? -s->origin[j] : 0);
    const double global = num_pair_add(at, (num_pair){value, 0}).hi + 0.0;
    if (j == s->dim) return (froe_cut){.kind = FROE_CUT_AXIS, .axis = i, .value = global};
    return (froe_cut){.kind = FROE_CUT_PLANE, .value = global, .normal = differences[i][j]};
}

/** Makes the centre that of a shape: the mean of dim + 1 points, in the k-th of which y_i - y_k is as large as it can
 * be for each i. So it is a share 1 / (dim + 1) of each width away from each facet at least. */
static void find_centre(bar_zone *zone, const zone_shape *s) {
    for (int i = 0; i < s->dim; i++) {
        double sum = 0;
        for (int k = 0; k <= s->dim; k++) sum += s->most[i][k] - s->most[s->dim][k];
        zone->centre[i] = s->origin[i] + sum / (s->dim + 1);
    }
}

void bar_zone_divide(bar_zone *zone, const zone_shape *shape, const froe_cut *cut, int side) {
    int i = cut->axis, j = shape->dim;
    for (int k = 0; k < shape->dim && cut->kind == FROE_CUT_PLANE; k++) {
        if (cut->normal[k] > 0) i = k;
        if (cut->normal[k] < 0) j = k;
    }
    const num_pair at = num_pair_sum(shape->origin[i], j < shape->dim ? -shape->origin[j] : 0);
    double value = num_pair_sub((num_pair){cut->value, 0}, at).hi;
    zone_shape part = *shape;
    *(side ? &zone->most[j][i] : &zone->most[i][j]) = side ? -cut->value : cut->value;
    if (side) {
        const int swap = i;
        i = j;
        j = swap;
        value = -value;
    }
    for (int k = 0; k <= shape->dim; k++)
        for (int l = 0; l <= shape->dim; l++)
            part.most[k][l] = fmin(part.most[k][l], shape->most[k][i] + value + shape->most[j][l]);
    find_centre(zone, &part);
}
