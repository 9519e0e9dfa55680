/* surface.c: choosing, counting and dealing.
 *
 * Clipping a triangle by x[axis] = c. A point of an edge pq in the cut is p + s (q - p) with s = (c - p) / (q - p) on
 * the axis. In doubles s is off by 3u in proportion, so a coordinate by at most 6u (|p| + |q|): bounds are moved out by
 * 2^-50 of that. */
#include "build/index/surface.h"
#include <float.h>
#include <math.h>
#include <string.h>

enum { BINS = 32, FEW_BINS = 16, FEW = 64, SAMPLES = 1024, TRIES = 8, AHEAD = 8 };

/* -------------------------------------------------------------------- choose -- */

typedef struct binning {
    double lo[3], hi[3], size[3], per_bin[3];
    int bins;
    uint32_t begin[3][BINS], end[3][BINS]; /* items that begin, that end in a bin */
    uint32_t samples;
} binning;

static int bin_of(const binning *b, int axis, double x) {
    double place = (x - b->lo[axis]) * b->per_bin[axis] - 0.0173;
    return place > 0 ? place < b->bins ? (int)place : b->bins - 1 : 0;
}

/* Cuts that leave one side empty are worth more than their surface says. Borders of bins lie off the round numbers of
 * which models are made. */
static void try_axis(const binning *b, int k, surface_cut *best) {
    double most = b->size[0] > b->size[1] ? b->size[0] : b->size[1];
    most = most > b->size[2] ? most : b->size[2];
    double w = b->size[k] / most, u = b->size[(k + 1) % 3] / most, v = b->size[(k + 2) % 3] / most;
    double cap = u * v, whole = (cap + w * (u + v)) * b->samples;
    uint32_t left = 0, right = b->samples;
    for (int i = 1; i < b->bins; i++) {
        double share = (i + 0.0173) / b->bins;
        left += b->begin[k][i - 1];
        right -= b->end[k][i - 1];
        double cost = (cap + (u + v) * w * share) * left + (cap + (u + v) * w * (1 - share)) * right;
        cost /= whole;
        if (cost < best->cost) *best = (surface_cut){.axis = k, .value = b->lo[k] + b->size[k] * share, .cost = cost};
    }
}

bool surface_choose(const space_item *items, uint32_t count, surface_cut *cut) {
    binning b;
    /* where extents begin and end, by bins */
    uint32_t step = count > 2 * SAMPLES ? count / SAMPLES : 1;
    b = (binning){.bins = count < FEW ? FEW_BINS : BINS};
    /* the bounds of all items */
    double lo[3] = {INFINITY, INFINITY, INFINITY}, hi[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (uint32_t i = 0; i < count; i++)
        for (int k = 0; k < 3; k++) {
            lo[k] = items[i].lo[k] < lo[k] ? items[i].lo[k] : lo[k];
            hi[k] = items[i].hi[k] > hi[k] ? items[i].hi[k] : hi[k];
        }
    memcpy(b.lo, lo, sizeof lo);
    memcpy(b.hi, hi, sizeof hi);
    for (int k = 0; k < 3; k++) {
        b.size[k] = b.hi[k] - b.lo[k];
        b.per_bin[k] = b.size[k] > 0 ? b.bins / b.size[k] : 0;
    }
    for (uint32_t i = 0; i < count; i += step, b.samples++)
        for (int k = 0; k < 3; k++) {
            b.begin[k][bin_of(&b, k, items[i].lo[k])]++;
            b.end[k][bin_of(&b, k, items[i].hi[k])]++;
        }
    *cut = (surface_cut){.axis = -1, .cost = INFINITY};
    for (int k = 0; k < 3; k++)
        if (b.size[k] > 0 && b.size[k] <= 0x1p1000 && isfinite(b.per_bin[k])) try_axis(&b, k, cut);
    return cut->axis >= 0 && cut->value > b.lo[cut->axis] && cut->value < b.hi[cut->axis];
}

/* --------------------------------------------------------------------- count -- */

bool surface_count(const space_item *items, uint32_t count, surface_cut *cut, uint8_t *classes) {
    const int axis = cut->axis;
    for (int i = 0; i < TRIES; i++, cut->value = nextafter(cut->value, INFINITY)) {
        const double value = cut->value;
        uint32_t classed[4] = {0};
        bool flat = false;
        for (uint32_t j = 0; j < count; j++) {
            double lo = items[j].lo[axis], hi = items[j].hi[axis];
            unsigned class = (lo < value) | (unsigned)(hi > value) << 1;
            flat |= !class;
            classes[j] = (uint8_t) class;
            classed[class]++;
        }
        cut->both = classed[3];
        cut->sides[0] = classed[1] + classed[3];
        cut->sides[1] = classed[2] + classed[3];
        if (!flat) return cut->sides[0] && cut->sides[1]; /* a value that moved may have come to the end of all items */
    }
    return false;
}

/* ---------------------------------------------------------------------- deal -- */

static void reach_interval(space_item *b, int k, double lo, double hi) {
    b->lo[k] = lo < b->lo[k] ? lo : b->lo[k];
    b->hi[k] = hi > b->hi[k] ? hi : b->hi[k];
}

/* Bounds of a triangle's parts on both sides; corners in the cut belong to both. */
static void divide_triangle(const double *const p[3], int axis, double c, space_item part[2]) {
    part[0] = part[1] = (space_item){.lo = {INFINITY, INFINITY, INFINITY}, .hi = {-INFINITY, -INFINITY, -INFINITY}};
    for (int i = 0; i < 3; i++) {
        const double *u = p[i], *v = p[i == 2 ? 0 : i + 1];
        for (int k = 0; u[axis] <= c && k < 3; k++) reach_interval(part, k, u[k], u[k]);
        for (int k = 0; u[axis] >= c && k < 3; k++) reach_interval(part + 1, k, u[k], u[k]);
        if (!(u[axis] < c && v[axis] > c) && !(u[axis] > c && v[axis] < c)) continue;
        const double s = (c - u[axis]) / (v[axis] - u[axis]);
        for (int k = 0; k < 3; k++) {
            const double x = u[k] + s * (v[k] - u[k]), slack = 0x1p-50 * (fabs(u[k]) + fabs(v[k]));
            reach_interval(part, k, x - slack, x + slack);
            reach_interval(part + 1, k, x - slack, x + slack);
        }
    }
}

typedef struct plane {
    double p[3], n[3], doubt; /* doubt: 2^-47 |e| |f|, in sums of coordinates */
} plane;

/* Is a plane certainly beside the box? With w from a corner to the middle of the box and h its half extents, n . w errs
 * by less than 2^-47 |e| |f| (|w| + |h|), in sums of coordinates. */
static bool misses(const plane *a, const space_item *b) {
    double value = 0, reach = 0, size = 0;
    for (int k = 0; k < 3; k++) {
        const double w = (0.5 * b->lo[k] + 0.5 * b->hi[k]) - a->p[k];
        const double h =
            (0.5 * b->hi[k] - 0.5 * b->lo[k]) * (1 + 0x1p-50) + 0x1p-50 * (fabs(b->lo[k]) + fabs(b->hi[k]));
        value += a->n[k] * w;
        reach += fabs(a->n[k]) * h;
        size += fabs(w) + h;
    }
    return fabs(value) <= DBL_MAX && fabs(value) - reach > a->doubt * size + 0x1p-900; /* infinite: it says nothing */
}

/* Clips both copies of a triangle, one for each side; is anything left there? */
static void clip_listed(const froe_scene *s, const surface_cut *cut, bool thorough, space_item *const out[2],
                        bool left[2]) {
    const double *const p[3] = {space_corner(s, out[0], 0), space_corner(s, out[0], 1), space_corner(s, out[0], 2)};
    space_item part[2];
    divide_triangle(p, cut->axis, cut->value, part);
    /* cuts each item down to its part */
    for (int i = 0; i < 2; i++) {
        left[i] = true;
        for (int k = 0; k < 3; k++) {
            if (k == cut->axis) continue;
            out[i]->lo[k] = part[i].lo[k] > out[i]->lo[k] ? part[i].lo[k] : out[i]->lo[k];
            out[i]->hi[k] = part[i].hi[k] < out[i]->hi[k] ? part[i].hi[k] : out[i]->hi[k];
            left[i] = left[i] && out[i]->lo[k] <= out[i]->hi[k];
        }
    }
    if (!thorough) return;
    /* the plane of the triangle, and how far its sides may be trusted */
    plane a = {.doubt = 0};
    double e[3], f[3], e_size = 0, f_size = 0;
    for (int k = 0; k < 3; k++) {
        a.p[k] = p[0][k];
        e[k] = p[1][k] - p[0][k], f[k] = p[2][k] - p[0][k];
        e_size += fabs(e[k]), f_size += fabs(f[k]);
    }
    for (int k = 0; k < 3; k++) {
        int i = k == 2 ? 0 : k + 1, j = k ? k - 1 : 2;
        a.n[k] = e[i] * f[j] - e[j] * f[i];
    }
    a.doubt = 0x1p-47 * e_size * f_size;
    for (int i = 0; i < 2; i++) left[i] = left[i] && !misses(&a, out[i]);
}

bool surface_is_tame(const froe_scene *s) {
    double most = 0;
    for (int k = 0; k < 3; k++) most = fmax(most, fmax(fabs(s->lo[k]), fabs(s->hi[k])));
    return most <= 0x1p1000;
}

void surface_divide(const froe_scene *s, bool tame, const surface_cut *cut, bool thorough, const space_item *item,
                    space_item *const out[2], bool left[2]) {
    const bool triangle = item->corner != FROE_NONE && tame;
    *out[0] = *out[1] = *item;
    out[0]->hi[cut->axis] = out[1]->lo[cut->axis] = cut->value;
    left[0] = left[1] = true;
    if (triangle) clip_listed(s, cut, thorough, out, left);
}

void surface_deal(const froe_scene *s, const space_item *items, uint32_t count, surface_cut *cut,
                  const uint8_t *classes, bool thorough, space_item *negative, space_item *positive) {
    const bool tame = surface_is_tame(s);
    uint32_t below = 0, above = 0;
    for (uint32_t i = 0; i < count; i++) {
        const space_item item = items[i]; /* positive may be items */
        space_item *const out[2] = {negative + below, positive + above};
        bool left[2] = {classes[i] & 1, classes[i] & 2};
        if (i + 2 * AHEAD < count && classes[i + 2 * AHEAD] == 3) space_ask(s, items + i + 2 * AHEAD);
        if (i + AHEAD < count && classes[i + AHEAD] == 3) space_ask_corners(s, items + i + AHEAD);
        if (classes[i] == 3)
            surface_divide(s, tame, cut, thorough, &item, out, left);
        else
            *out[classes[i] - 1] = item;
        below += left[0];
        above += left[1];
    }
    cut->sides[0] = below;
    cut->sides[1] = above;
}
