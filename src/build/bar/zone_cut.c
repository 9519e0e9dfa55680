/* zone_cut.c: medians first, then the cluster. All counts are of rounded numbers; that costs balance, nothing else. */
#include "build/bar/zone_cut.h"
#include "base/select.h"
#include <math.h>
#include <string.h>

#define FLOOR 0x1p-40    /* cells narrower than this share of their coordinates have no doubles between them */
#define ROUNDING 0x1p-51 /* of a cut, as a share of the coordinates, at most */
#define EASY 0.5         /* of the aspect, for cuts at medians, where that is enough */
enum { FATTENINGS = 64 };

/** Keep y_i - y_j <= value. */
typedef struct zone_candidate {
    int i, j;
    double value;
    double width;    /* of direction (i, j), or of the part */
    uint32_t larger; /* points in the fuller part */
} zone_candidate;

typedef struct zone_extent {
    double most[ZONE_NODES][ZONE_NODES]; /* of y_i - y_j of the points of the cluster */
} zone_extent;

/** The least width that a cut may leave of a part of this width. */
static double thin(const zone_shape *s, double width, double aspect) {
    return width / aspect + ROUNDING * s->reach;
}

static double key_of(const double *row, int i, int j, int dim) {
    return row[i] - (j < dim ? row[j] : 0);
}

/* ----------------------------------------------------------------- medians -- */

/** The cut at the median of a direction, or at the nearest place that leaves both parts fat. i -1: there is none. */
static zone_candidate median_candidate(zone_search *z, uint32_t count, int i, int j, double aspect) {
    const zone_shape *s = &z->shape;
    const double room = thin(s, s->widest, aspect), lo = room - s->most[j][i], hi = s->most[i][j] - room;
    zone_candidate c = {.i = -1, .j = j, .width = zone_shape_width(s, i, j)};
    if (!(lo <= hi)) return c;
    const double *row = z->rows.data;
    for (uint32_t k = 0; k < count; k++, row += s->dim) z->column.data[k] = key_of(row, i, j, s->dim);
    const double median = base_select(z->column.data, count, count / 2);
    const double value = bar_between(z->column.data, count, median);
    c.i = i;
    c.value = value < lo ? lo : value > hi ? hi : value;
    uint32_t below = 0, above = 0;
    for (uint32_t k = 0; k < count; k++) {
        below += z->column.data[k] < c.value;
        above += z->column.data[k] > c.value;
    }
    c.larger = below > above ? below : above;
    return c;
}

/** Of those that leave few enough points on each side, the one across the widest direction; an axis, if possible:
 * other cuts cost more to store and to ask. */
static bool find_median(zone_search *z, uint32_t count, uint32_t goal, double aspect, zone_candidate *best) {
    const int dim = z->shape.dim;
    best->i = -1;
    for (int i = 0; i < dim; i++) {
        const zone_candidate c = median_candidate(z, count, i, dim, aspect);
        if (c.i >= 0 && c.larger <= goal && (best->i < 0 || c.width > best->width)) *best = c;
    }
    if (best->i >= 0) return true;
    for (int i = 0; i < dim; i++)
        for (int j = i + 1; j < dim; j++) {
            const zone_candidate c = median_candidate(z, count, i, j, aspect);
            if (c.i >= 0 && c.larger <= goal && (best->i < 0 || c.width > best->width)) *best = c;
        }
    return best->i >= 0;
}

/* ----------------------------------------------------------------- cluster -- */

static double distance_from(const double *row, const double *middle, int dim) {
    double most = 0;
    for (int k = 0; k < dim; k++) most = fmax(most, fabs(row[k] - middle[k]));
    return most;
}

/** The median of each axis. */
static void find_middle(zone_search *z, uint32_t count, int dim) {
    for (int k = 0; k < dim; k++) {
        const double *x = z->rows.data + k;
        for (uint32_t p = 0; p < count; p++, x += dim) z->column.data[p] = *x;
        z->cluster.middle[k] = base_select(z->column.data, count, count / 2);
    }
}

/** Moves the origin to the point that is nearest to the middle: what lies near that is not lost in rounding. */
static void see_from_middle(zone_search *z, const bar_zone *zone, uint32_t count, int dim) {
    double origin[FROE_MAX_DIM], least = INFINITY, *row = z->rows.data, *nearest = row;
    for (uint32_t p = 0; p < count; p++, row += dim) {
        const double distance = distance_from(row, z->cluster.middle, dim);
        if (distance < least) least = distance, nearest = row;
    }
    memcpy(origin, nearest, (size_t)dim * sizeof *origin);
    row = z->rows.data;
    for (uint32_t p = 0; p < count; p++, row += dim)
        for (int k = 0; k < dim; k++) row[k] -= origin[k];
    zone_shape_of(zone, dim, origin, &z->shape);
}

/** Bounds the points of the cluster: those nearest to the middle, just more than the goal, when a sequence begins.
 * Every set of as many points, at least half of all, has the middle within its bounds; so none is in a box with sides
 * of less than the radius. Returns how many of them are still there. */
static uint32_t find_extent(zone_search *z, uint32_t count, uint32_t goal, zone_extent *e) {
    const int dim = z->shape.dim;
    double middle[FROE_MAX_DIM];
    uint32_t members = 0;
    const double *row = z->rows.data;
    for (int k = 0; k < dim; k++) middle[k] = z->cluster.middle[k] - z->shape.origin[k];
    for (uint32_t p = 0; p < count; p++, row += dim) z->column.data[p] = distance_from(row, middle, dim);
    if (z->cluster.radius < 0) z->cluster.radius = base_select(z->column.data, count, goal) * (1 + 0x1p-40);
    for (int i = 0; i <= dim; i++)
        for (int j = 0; j <= dim; j++) e->most[i][j] = i == j ? 0 : -INFINITY;
    row = z->rows.data;
    for (uint32_t p = 0; p < count; p++, row += dim) {
        if (distance_from(row, middle, dim) > z->cluster.radius) continue;
        members++;
        for (int i = 0; i < dim; i++)
            for (int j = i + 1; j <= dim; j++) {
                const double key = key_of(row, i, j, dim);
                e->most[i][j] = fmax(e->most[i][j], key);
                e->most[j][i] = fmax(e->most[j][i], -key);
            }
    }
    return members;
}

/** The least value from c->value on that leaves a fat part below; its width. */
static void fatten(const zone_shape *s, double aspect, zone_candidate *c) {
    for (int n = 0; n < FATTENINGS; n++) {
        c->width = zone_shape_widest_below(s, c->i, c->j, c->value);
        const double least = thin(s, c->width, aspect) - s->most[c->j][c->i];
        if (c->value >= least) return;
        c->value = least + 0x1p-40 * c->width;
    }
}

/** How far the cluster is from the nearer end of direction (i, j), in the part of the zone that a cut leaves; without
 * a cut, in all of it. */
static double depth_of(const zone_shape *s, const zone_extent *e, int i, int j, const zone_candidate *cut) {
    double most = s->most[i][j], back = s->most[j][i];
    if (cut) {
        most = fmin(most, s->most[i][cut->i] + cut->value + s->most[cut->j][j]);
        back = fmin(back, s->most[j][cut->i] + cut->value + s->most[cut->j][i]);
    }
    return fmin(most - e->most[i][j], back - e->most[j][i]);
}

/** The greatest such depth, and in how many directions it is `room` and more. */
static double deepest(const zone_shape *s, const zone_extent *e, const zone_candidate *cut, double room,
                      uint32_t *deep) {
    double most = 0;
    *deep = 0;
    for (int i = 0; i <= s->dim; i++)
        for (int j = 0; j < i; j++) {
            const double depth = depth_of(s, e, i, j, cut);
            *deep += depth >= room;
            most = fmax(most, depth);
        }
    return most;
}

/** Beside the cluster, in a direction in which both ends are far: so that there are as few of these as can be left. */
static zone_candidate find_border(const zone_shape *s, const zone_extent *e, double pad, double room) {
    zone_candidate best = {.i = -1};
    for (int i = 0; i <= s->dim; i++)
        for (int j = 0; j <= s->dim; j++) {
            zone_candidate c = {.i = i, .j = j, .value = e->most[i][j] + pad};
            if (i == j || depth_of(s, e, i, j, NULL) - pad < room) continue;
            deepest(s, e, &c, room, &c.larger);
            c.width = zone_shape_widest_below(s, i, j, c.value);
            const bool fewer = best.i < 0 || c.larger < best.larger;
            if (fewer || (c.larger == best.larger && c.width < best.width)) best = c;
        }
    return best;
}

/** The smallest fat part with the cluster, no nearer to it than its depth. */
static zone_candidate find_zoom(const zone_shape *s, const zone_extent *e, double depth, double room, double aspect) {
    zone_candidate best = {.i = -1};
    for (int i = 0; i <= s->dim; i++)
        for (int j = 0; j <= s->dim; j++) {
            zone_candidate c = {.i = i, .j = j, .value = e->most[i][j] + depth};
            if (i == j) continue;
            fatten(s, aspect, &c);
            if (s->most[i][j] - c.value >= room && (best.i < 0 || c.width < best.width)) best = c;
        }
    return best;
}

/** The middle of the widest direction; or beside a cluster that is in the way, or nearly, and small. */
static zone_candidate halve(const zone_shape *s, const zone_extent *e, double pad) {
    zone_candidate c = {.width = -1};
    for (int i = 0; i < s->dim; i++)
        for (int j = s->dim; j > i; j--)
            if (zone_shape_width(s, i, j) > c.width)
                c = (zone_candidate){i, j, 0.5 * s->most[i][j] - 0.5 * s->most[j][i], zone_shape_width(s, i, j), 0};
    const double hi = e->most[c.i][c.j] + pad, lo = -e->most[c.j][c.i] - pad, near = 0.125 * c.width;
    if (lo < c.value + near && c.value - near < hi && hi - lo < 2 * near) c.value = hi;
    return c;
}

/** A cut that has the whole cluster on one side, while the zone is much larger. */
static zone_candidate cut_at_cluster(const zone_shape *s, const zone_extent *e, double pad, double aspect) {
    const double room = thin(s, s->widest, aspect);
    uint32_t deep;
    const zone_candidate border = find_border(s, e, pad, room);
    if (border.i >= 0) return border;
    const zone_candidate zoom = find_zoom(s, e, fmax(deepest(s, e, NULL, room, &deep), pad), room, aspect);
    return zoom.i >= 0 && zoom.width <= 0.5 * s->widest ? zoom : halve(s, e, pad);
}

/* -------------------------------------------------------------------- both -- */

bar_found zone_search_cut(const froe_allocator *alloc, zone_search *z, const bar_zone *zone, int dim, uint32_t count,
                          uint32_t goal, double aspect, froe_cut *out) {
    const zone_shape *s = &z->shape;
    const bool begins = zone->goal != goal;
    z->column.count = 0;
    if (!array_reserve(alloc, &z->column, count)) return BAR_MEMORY;
    z->cluster = begins ? (zone_cluster){.radius = -1} : zone->cluster;
    if (begins) find_middle(z, count, dim);
    see_from_middle(z, zone, count, dim);
    if (!(s->narrowest > FLOOR * s->reach)) return BAR_NONE;
    zone_candidate c;
    if (!find_median(z, count, goal, EASY * aspect, &c) && !find_median(z, count, goal, aspect, &c)) {
        zone_extent extent;
        const bool whole = find_extent(z, count, goal, &extent) > goal;
        const double pad = 0.5 * fmax(z->cluster.radius, FLOOR * s->reach);
        c = whole ? cut_at_cluster(s, &extent, pad, aspect) : halve(s, &extent, pad);
    }
    *out = zone_shape_cut(s, c.i, c.j, c.value);
    return BAR_CUT;
}

void zone_search_free(const froe_allocator *alloc, zone_search *z) {
    array_free(alloc, &z->rows);
    array_free(alloc, &z->column);
}
