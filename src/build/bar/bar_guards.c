/* bar_guards.c: guards from supporting lines and planes. */
#include "build/bar/bar_guards.h"
#include <math.h>
#include <string.h>

enum { GRID = 4 }; /* directions inside sectors are sought among whole numbers up to this */

/* Least and largest n . x of the object, for each direction. */
typedef struct bar_support {
    double lo[DIRECTIONS_MOST], hi[DIRECTIONS_MOST];
} bar_support;

static void support_of(const split_directions *d, const froe_scene *scene, uint32_t object, bar_support *s) {
    const froe_kind form = scene_form(scene, object);
    if (form == FROE_BOX) {
        const double *lo = scene_point(scene, object, 0), *hi = scene_point(scene, object, 1);
        for (int i = 0; i < d->count; i++) {
            double least[3] = {0}, most[3] = {0};
            for (int k = 0; k < d->dim; k++) {
                bool falls = d->normals[i][k] < 0;
                least[k] = falls ? hi[k] : lo[k];
                most[k] = falls ? lo[k] : hi[k];
            }
            s->lo[i] = split_key(d, i, least);
            s->hi[i] = split_key(d, i, most);
        }
        return;
    }
    uint32_t corners = form == FROE_BALL ? 1 : scene_corners(scene, object);
    double radius = form == FROE_BALL ? scene_radius(scene, object) : 0;
    for (uint32_t c = 0; c < corners; c++)
        for (int i = 0; i < d->count; i++) {
            double key = split_key(d, i, scene_point(scene, object, c));
            double lo = key - radius * d->lengths[i], hi = key + radius * d->lengths[i];
            s->lo[i] = !c || lo < s->lo[i] ? lo : s->lo[i];
            s->hi[i] = !c || hi > s->hi[i] ? hi : s->hi[i];
        }
}

/* ------------------------------------------------------------------- sectors -- */

/** Steepest least slope first: that keeps guards near the object. */
static void offer_sector(bar_guards *g, const double *u, double *steep) {
    const split_directions *d = &g->directions;
    bar_sector s = {{u[0], u[1], u[2]}, {0}};
    double length = sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]), least = INFINITY;
    for (int k = 0; k < 3; k++) s.u[k] /= length;
    for (int i = 0; i < d->count; i++) {
        s.slope[i] = split_key(d, i, s.u);
        least = fmin(least, fabs(s.slope[i]) / d->lengths[i]);
    }
    if (!(length > 0 && least > 0x1p-40)) return; /* on a plane between sectors */
    for (uint32_t j = 0; j < g->count; j++) {
        int i = 0;
        while (i < d->count && (g->sectors[j].slope[i] < 0) == (s.slope[i] < 0)) i++;
        if (i < d->count) continue;
        if (least > steep[j]) g->sectors[j] = s, steep[j] = least;
        return;
    }
    if (g->count == BAR_GUARDS_MOST) return;
    steep[g->count] = least;
    g->sectors[g->count++] = s;
}

void bar_guards_make(const split_directions *directions, bar_guard_kind kind, bar_guards *out) {
    double steep[BAR_GUARDS_MOST];
    *out = (bar_guards){.directions = *directions, .kind = kind};
    int g = directions->count;
    if (directions->dim == 3 && kind == BAR_PAIRS) out->kind = BAR_HEMISPHERE;
    if (kind == BAR_BOXES) out->count = 1u << directions->dim;
    if (directions->dim == 2 && kind != BAR_BOXES) out->count = (uint32_t)(kind == BAR_PAIRS ? 2 * g * (g - 1) : 2 * g);
    if (directions->dim == 2 || kind == BAR_BOXES) return;
    for (int x = -GRID; x <= GRID; x++)
        for (int y = -GRID; y <= GRID; y++)
            for (int z = -GRID; z <= GRID; z++) offer_sector(out, (double[]){x, y, z}, steep);
}

/* -------------------------------------------------------------------- guards -- */

/** Appends a guard that is not there yet. */
static uint32_t append_guard(double *out, uint32_t count, const double *x, int dim) {
    const size_t d = (size_t)dim;
    for (uint32_t i = 0; i < count; i++)
        if (!memcmp(out + i * d, x, d * sizeof *x)) return count;
    memcpy(out + count * d, x, d * sizeof *x);
    return count + 1;
}

/** Where n . x = a meets m . x = b, for normals of the plane. */
static void meet(const double *n, double a, const double *m, double b, double x[2]) {
    double det = n[0] * m[1] - n[1] * m[0];
    x[0] = (a * m[1] - b * n[1]) / det + 0.0;
    x[1] = (b * n[0] - a * m[0]) / det + 0.0;
}

static uint32_t pairs_of(const split_directions *d, const bar_support *s, double *out) {
    uint32_t count = 0;
    for (int i = 0; i < d->count; i++)
        for (int j = i + 1; j < d->count; j++)
            for (int corner = 0; corner < 4; corner++) {
                double x[2];
                meet(d->normals[i], corner & 1 ? s->hi[i] : s->lo[i], d->normals[j], corner & 2 ? s->hi[j] : s->lo[j],
                     x);
                count = append_guard(out, count, x, 2);
            }
    return count;
}

/* Signed directions of the plane by angle: x, (x + y), y, -(x - y), and their opposites: half a turn is `count` of
 * them. The supporting line of n facing the sector is n . x = least. */
static uint32_t half_circles_of(const split_directions *d, const bar_support *s, double *out) {
    static const int order[2][4] = {{0, 1, 2, 0}, {0, 3, 1, 2}}, sign[2][4] = {{1, 1, -1, 0}, {1, 1, 1, -1}};
    const int g = d->count, *by = order[g == 4], *to = sign[g == 4];
    uint32_t count = 0;
    for (int k = 0; k < 2 * g; k++) {
        double line[2], x[2];
        int i[2];
        for (int e = 0; e < 2; e++) { /* the first and the last of half a turn that begins at k */
            int at = k + e * (g - 1);
            i[e] = by[at % g];
            line[e] = to[at % g] * (at / g % 2 ? -1 : 1) > 0 ? s->lo[i[e]] : s->hi[i[e]];
        }
        meet(d->normals[i[0]], line[0], d->normals[i[1]], line[1], x);
        count = append_guard(out, count, x, 2);
    }
    return count;
}

uint32_t bar_guards_of(const bar_guards *g, const froe_scene *scene, uint32_t object, double *out) {
    bar_support s;
    if (scene_form(scene, object) == FROE_POINT) {
        memcpy(out, scene_point(scene, object, 0), (size_t)scene->dim * sizeof *out);
        return 1;
    }
    support_of(&g->directions, scene, object, &s);
    if (g->kind == BAR_BOXES) {
        /* the corners of the bounding box */
        uint32_t count = 0;
        for (uint32_t corner = 0; corner < 1u << scene->dim; corner++) {
            double x[3] = {0};
            for (int k = 0; k < scene->dim; k++) x[k] = corner >> k & 1 ? s.hi[k] : s.lo[k];
            count = append_guard(out, count, x, scene->dim);
        }
        return count;
    }
    if (scene->dim == 3) {
        /* from the middle of the object along u until all supporting planes that face u are passed */
        const split_directions *d = &g->directions;
        double c[3], x[3] = {0};
        uint32_t count = 0;
        for (int k = 0; k < 3; k++) c[k] = 0.5 * s.lo[k] + 0.5 * s.hi[k];
        for (uint32_t j = 0; j < g->count; j++) {
            const bar_sector *sector = g->sectors + j;
            double t = -INFINITY;
            for (int i = 0; i < DIRECTIONS_MOST; i++) { /* in space, all */
                double key = split_key(d, i, c), slope = sector->slope[i];
                double way = slope < 0 ? (key - s.lo[i]) / -slope : (s.hi[i] - key) / slope;
                t = way > t ? way : t;
            }
            for (int k = 0; k < 3; k++) x[k] = c[k] + t * sector->u[k] + 0.0;
            count = append_guard(out, count, x, 3);
        }
        return count;
    }
    return g->kind == BAR_PAIRS ? pairs_of(&g->directions, &s, out) : half_circles_of(&g->directions, &s, out);
}
