/* quad.c: compressed quadtrees and octrees, in any dimension (Finkel and Bentley 1974; Samet 2006).
 *
 *     +-------+-------+     Cuts are the planes of the dyadic grid, x[axis] = m 2^j, whole m: always exact. In every
 *     |       |   |   |     cell the coarsest one comes first, the one with the largest j, of equals the one across the
 *     |       +---+---+     lowest axis. That is the quadtree with binary cuts over a root square that begins at 0, but
 *     |       |   |   |     for the cuts that would leave all objects on one side, or on both: these are left out, so
 *     +-------+-+-+---+     that no chain of empty squares is ever built, whatever the spread of the scene.
 *     |       +-+-+   |
 *     |       +-+-+---+     Any interval of doubles holds a dyadic number.
 *     |       |   |   |
 *     +-------+---+---+
 *
 * Of planes that separate something, those on an axis are an interval (split/axes.h). */
#include "build/method.h"
#include "split/axial.h"
#include "support/fail.h"
#include <math.h>
#include <string.h>

enum { GROWTH };

static const froe_option_info options[] = {
    [GROWTH] = {"growth", "fragments per fragment at which a cell is cut along its objects", 4, 1, 1000, NULL, false},
    {0},
};

/* ------------------------------------------------------------ dyadic numbers -- */

enum { MANTISSA = 52, COARSEST = 4096 };
#define MANTISSA_BITS ((UINT64_C(1) << MANTISSA) - 1)

static uint64_t bits_of(double x) {
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static double double_of(uint64_t bits) {
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/** j + 1075 of x = m 2^j, m odd. */
static int level_of(double x) {
    uint64_t bits = bits_of(fabs(x)), mantissa = bits & MANTISSA_BITS;
    int exponent = (int)(bits >> MANTISSA);
    if (x == 0) return COARSEST;
    if (exponent) mantissa |= UINT64_C(1) << MANTISSA;
    return (exponent ? exponent : 1) + __builtin_ctzll(mantissa);
}

/** The coarsest dyadic number in [from, to], 0 < from <= to. With one exponent: the bits both have in common, and one
 * more, unless all further bits of `from` are 0. */
static double coarsest_positive(double from, double to) {
    uint64_t a = bits_of(from), b = bits_of(to), differ = a ^ b;
    if (!differ) return from;
    if (a >> MANTISSA != b >> MANTISSA) return double_of(b & ~MANTISSA_BITS); /* a power of two */
    uint64_t last = UINT64_C(1) << (63 - __builtin_clzll(differ));
    return double_of(a & (2 * last - 1) ? b & ~(last - 1) : a);
}

static double coarsest(double from, double to) {
    if (from <= 0 && to >= 0) return 0;
    return from > 0 ? coarsest_positive(from, to) : -coarsest_positive(-to, -from);
}

/* ------------------------------------------------------------------- build -- */

static split_verdict choose_quad_cut(const void *config, split_work *work, const split_cell *cell, froe_cut *cut) {
    const split_axial *axial = config;
    int best = -1;
    if (split_axial_over(axial, cell)) return split_refine_choose(&axial->refine, work, cell, cut);
    for (int k = 0; k < work->set.scene->dim; k++) {
        double from, to;
        if (!split_axes_gap(&work->set, cell, k, &from, &to)) continue;
        double value = coarsest(from, to);
        int level = level_of(value);
        if (level <= best) continue;
        best = level;
        *cut = (froe_cut){.kind = FROE_CUT_AXIS, .axis = k, .value = value};
    }
    return best >= 0 ? SPLIT_CUT : split_refine_choose(&axial->refine, work, cell, cut);
}

static froe_status build_quad(build_job *job, froe_tree **out) {
    split_axial axial = split_axial_of(job->scene, job->leaf, job->seed, job->option[GROWTH]);
    split_method method = {.config = &axial,
                           .choose = choose_quad_cut,
                           .scratch_new = split_scratch_new,
                           .scratch_free = split_scratch_free};
    split_job split = build_split_job(job);
    return split_grow(&split, &method, out);
}

const build_method build_method_quad = {
    .info = {.name = "quad",
             .summary = "a compressed quadtree or octree: the coarsest dyadic cut that separates anything",
             .source = "Finkel and Bentley 1974; Samet: Foundations of multidimensional data structures, 2006",
             .guarantee = "at most 2 growth n fragments by dyadic cuts; the rest is cut along the objects",
             .kinds = BUILD_SERVES(BUILD_DIMS_ALL, BUILD_KINDS_ALL),
             .options = options},
    .build = build_quad,
};
