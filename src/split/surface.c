/* surface.c: choosing, counting and dealing.
 *
 * Clipping a triangle by x[axis] = c. A point of an edge pq in the cut is p + s (q - p) with s = (c - p) / (q - p) on
 * the axis. In doubles s is off by 3u in proportion, so a coordinate by at most 6u (|p| + |q|): bounds are moved out by
 * 2^-50 of that. */
#include "split/surface.h"
#include <math.h>

enum { BINS = 32, FEW_BINS = 16, FEW = 64, SAMPLES = 4096, TRIES = 8, AHEAD = 12 };

/* -------------------------------------------------------------------- choose -- */

typedef struct binning {
    double lo[3], hi[3], size[3], per_bin[3];
    int bins;
    uint32_t begin[3][BINS], end[3][BINS]; /* items that begin, that end in a bin */
    uint32_t samples;
} binning;

/* Borders of bins lie off the round numbers of which models are made. */
static double border(const binning *b, int axis, int i) {
    return b->lo[axis] + b->size[axis] * ((i + 0.0173) / b->bins);
}

static int bin_of(const binning *b, int axis, double x) {
    double place = (x - b->lo[axis]) * b->per_bin[axis] - 0.0173;
    return place > 0 ? place < b->bins ? (int)place : b->bins - 1 : 0;
}

static void fill_bins(binning *b, const space_item *items, uint32_t count) {
    uint32_t step = count > 2 * SAMPLES ? count / SAMPLES : 1;
    *b = (binning){.lo = {INFINITY, INFINITY, INFINITY}, .hi = {-INFINITY, -INFINITY, -INFINITY}};
    b->bins = count < FEW ? FEW_BINS : BINS;
    for (uint32_t i = 0; i < count; i++)
        for (int k = 0; k < 3; k++) {
            b->lo[k] = items[i].lo[k] < b->lo[k] ? items[i].lo[k] : b->lo[k];
            b->hi[k] = items[i].hi[k] > b->hi[k] ? items[i].hi[k] : b->hi[k];
        }
    for (int k = 0; k < 3; k++) {
        b->size[k] = b->hi[k] - b->lo[k];
        b->per_bin[k] = b->size[k] > 0 ? b->bins / b->size[k] : 0;
    }
    for (uint32_t i = 0; i < count; i += step, b->samples++)
        for (int k = 0; k < 3; k++) {
            b->begin[k][bin_of(b, k, items[i].lo[k])]++;
            b->end[k][bin_of(b, k, items[i].hi[k])]++;
        }
}

/* Cuts that leave one side empty are worth more than their surface says. */
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
        if (cost < best->cost) *best = (surface_cut){.axis = k, .value = border(b, k, i), .cost = cost};
    }
}

bool surface_choose(const space_item *items, uint32_t count, surface_cut *cut) {
    binning b;
    fill_bins(&b, items, count);
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
        if (!flat) return true;
    }
    return false;
}

/* ---------------------------------------------------------------------- deal -- */

static void reach(space_item *b, int k, double x, double slack) {
    bool tame = fabs(x) <= 0x1p1000; /* false for NaN: then nothing is clipped */
    double lo = tame ? x - slack : -(double)INFINITY, hi = tame ? x + slack : (double)INFINITY;
    if (lo < b->lo[k]) b->lo[k] = lo;
    if (hi > b->hi[k]) b->hi[k] = hi;
}

/* Bounds of a triangle's part on one side. */
static space_item part_of(const double *const p[3], int axis, double c, int side) {
    space_item b = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}, 0};
    for (int i = 0; i < 3; i++) {
        const double *u = p[i], *v = p[i == 2 ? 0 : i + 1];
        bool u_in = side ? u[axis] >= c : u[axis] <= c, v_in = side ? v[axis] >= c : v[axis] <= c;
        for (int k = 0; u_in && k < 3; k++) reach(&b, k, u[k], 0);
        if (u_in == v_in) continue;
        double s = (c - u[axis]) / (v[axis] - u[axis]);
        for (int k = 0; k < 3; k++) reach(&b, k, u[k] + s * (v[k] - u[k]), 0x1p-50 * (fabs(u[k]) + fabs(v[k])));
    }
    return b;
}

/* Is the plane of a triangle certainly beside the box? With w from a corner to the middle of the box and h its half
 * extents, n . w errs by less than 2^-47 |e| |f| (|w| + |h|), in sums of coordinates. */
static bool plane_misses(const double *const p[3], const space_item *b) {
    double e[3], f[3], w[3], h[3], value = 0, reach = 0, e_size = 0, f_size = 0, w_size = 0;
    for (int k = 0; k < 3; k++) {
        e[k] = p[1][k] - p[0][k], f[k] = p[2][k] - p[0][k];
        w[k] = (0.5 * b->lo[k] + 0.5 * b->hi[k]) - p[0][k];
        h[k] = (0.5 * b->hi[k] - 0.5 * b->lo[k]) * (1 + 0x1p-50) + 0x1p-50 * (fabs(b->lo[k]) + fabs(b->hi[k]));
        e_size += fabs(e[k]), f_size += fabs(f[k]), w_size += fabs(w[k]) + h[k];
    }
    for (int k = 0; k < 3; k++) {
        int i = k == 2 ? 0 : k + 1, j = k ? k - 1 : 2;
        double n = e[i] * f[j] - e[j] * f[i];
        value += n * w[k];
        reach += fabs(n) * h[k];
    }
    return fabs(value) - reach > 0x1p-47 * e_size * f_size * w_size + 0x1p-900;
}

/* What is left of an item on one side; false: nothing. */
static bool clip(const froe_scene *s, const space_item *item, const surface_cut *cut, int side, bool thorough,
                 space_item *out) {
    *out = *item;
    (side ? out->lo : out->hi)[cut->axis] = cut->value;
    if (!space_is_triangle(s, item->object)) return true;
    const double *const p[3] = {scene_point(s, item->object, 0), scene_point(s, item->object, 1),
                                scene_point(s, item->object, 2)};
    space_item part = part_of(p, cut->axis, cut->value, side);
    for (int k = 0; k < 3; k++) {
        if (k == cut->axis) continue;
        if (part.lo[k] > out->lo[k]) out->lo[k] = part.lo[k];
        if (part.hi[k] < out->hi[k]) out->hi[k] = part.hi[k];
        if (out->lo[k] > out->hi[k]) return false;
    }
    return !thorough || !plane_misses(p, out);
}

void surface_deal(const froe_scene *s, const space_item *items, uint32_t count, surface_cut *cut,
                  const uint8_t *classes, bool thorough, space_item *negative, space_item *positive) {
    uint32_t below = 0, above = 0;
    for (uint32_t i = 0; i < count; i++) {
        const space_item item = items[i]; /* positive may be items */
        if (i + AHEAD < count && classes[i + AHEAD] == 3) scene_ask(s, items[i + AHEAD].object);
        if (classes[i] == 3) {
            below += clip(s, &item, cut, 0, thorough, negative + below);
            above += clip(s, &item, cut, 1, thorough, positive + above);
        } else if (classes[i] == 1) {
            negative[below++] = item;
        } else {
            positive[above++] = item;
        }
    }
    cut->sides[0] = below;
    cut->sides[1] = above;
}
