/* extremes.h: scenes, places and lengths of every scale at once: a segment of denormal length beside one of 1e300,
 * tilted by odd angles; coordinates far from the origin; objects that coincide, or are one ulp apart.
 *
 *     style 0  one scale for all        2^-1074 .. 2^1023
 *     style 1  one scale an object      each around a centre of another scale
 *     style 2  beside one another       each around a corner of an earlier object, or its copy
 *     style 3  one scale a coordinate
 *     style 4  a class of support/fuzz.h
 *     style 5  one scale an object      each in the unit cube: cuts run along segments of no length to speak of
 *     style 6  one scale an object      up to that of the scene, and all over the scene, which has any scale
 *
 * Long runs: FROE_ROUNDS=100 multiplies the number of scenes, FROE_SEED=7000 begins elsewhere. */
#ifndef FROE_TESTS_QUERY_EXTREMES_H
#define FROE_TESTS_QUERY_EXTREMES_H
#include "support/fuzz.h"
#include "tree/trees.h"
#include <float.h>
#include <froe/froe.h>
#include <math.h>
#include <stdlib.h>

enum { EXTREME_CORNERS = 5, EXTREME_STYLES = 7 };

static inline uint64_t extreme_setting(const char *name, uint64_t otherwise) {
    const char *text = getenv(name);
    return text && *text ? strtoull(text, NULL, 10) : otherwise;
}
/** What numbers of rounds are multiplied by. */
static inline uint64_t extreme_rounds(void) {
    return extreme_setting("FROE_ROUNDS", 1);
}
static inline uint64_t extreme_seed(void) {
    return extreme_setting("FROE_SEED", 0);
}

/* ----------------------------------------------------------------- numbers -- */

static inline const double *extreme_vertex(fuzz_source *r, const froe_scene *scene) {
    const size_t count = froe_scene_vertex_count(scene);
    return count ? froe_scene_vertex(scene, base_below(fuzz_bits(r), (uint32_t)count)) : NULL;
}

/** A length of the scene, times 1/8 .. 8, so that scales meet again; or any power of two, or 1. */
static inline double extreme_scale(fuzz_source *r, const froe_scene *scene) {
    const double *u = extreme_vertex(r, scene), *v = extreme_vertex(r, scene);
    const int style = fuzz_int(r, 0, 7), k = fuzz_int(r, 0, froe_scene_dim(scene) - 1), power = fuzz_int(r, -3, 3);
    if (style == 0) return 1;
    if (style > 5 || !u) return ldexp(1, fuzz_int(r, -1074, 1023));
    const double length = fabs(style < 3 ? u[k] : u[k] - v[k]);
    return length > 0 ? fmin(ldexp(length, power), DBL_MAX) : 1;
}
/** Any finite number: of any scale, or of a class of fuzz.h. */
static inline double extreme_number(fuzz_source *r, const froe_scene *scene) {
    return fuzz_int(r, 0, 3) ? fuzz_unit(r) * extreme_scale(r, scene) : fuzz_coordinate(r, FUZZ_MIXED);
}
/** Instead of what is not finite, the greatest number. */
static inline double extreme_finite(double x) {
    return isnan(x) ? 0 : fmax(-DBL_MAX, fmin(DBL_MAX, x));
}

/* ------------------------------------------------------------------ scenes -- */

/** What is known while a scene grows. */
typedef struct extreme_scene {
    fuzz_source random;
    froe_scene *scene;
    int dim, style;
    double scale; /**< styles 0 and 6 */
    fuzz_class fuzz;
} extreme_scene;

/** x + scale times a vector of any direction. */
static inline void extreme_beside(fuzz_source *r, int dim, const double *x, double scale, double *out) {
    for (int k = 0; k < dim; k++) out[k] = extreme_finite(x[k] + scale * fuzz_unit(r));
}

static inline void extreme_corners(extreme_scene *s, double *out, size_t count) {
    const size_t dim = (size_t)s->dim;
    double centre[FROE_MAX_DIM] = {0};
    const double *from = extreme_vertex(&s->random, s->scene), drawn = extreme_scale(&s->random, s->scene);
    const double beside = s->style == 5 ? 1 : extreme_scale(&s->random, s->scene);
    const double around = s->style == 6 ? s->scale : beside, power = s->style == 6 ? fmin(drawn, around) : drawn;
    for (size_t k = 0; k < dim; k++) centre[k] = s->style != 2 ? around * fuzz_unit(&s->random) : from ? from[k] : 0;
    for (size_t c = 0; c < count; c++) {
        double *x = out + c * dim;
        if (s->style == 0) extreme_beside(&s->random, s->dim, (const double[FROE_MAX_DIM]){0}, s->scale, x);
        if (s->style == 1 || s->style == 2 || s->style > 4) extreme_beside(&s->random, s->dim, centre, power, x);
        for (size_t k = 0; k < dim && s->style == 3; k++) x[k] = extreme_number(&s->random, s->scene);
    }
    if (s->style == 4) {
        double flat[EXTREME_CORNERS * 3];
        for (size_t i = 0; i < count * dim; i++) out[i] = fuzz_coordinate(&s->random, s->fuzz);
        if (s->dim <= 3) fuzz_points(&s->random, s->fuzz, s->dim, flat, count), memcpy(out, flat, count * dim * 8);
    }
    if (from && s->style == 2 && fuzz_int(&s->random, 0, 1)) memcpy(out, from, dim * sizeof *out);
}

/** The same object once more. */
static inline void extreme_copy(extreme_scene *s, uint32_t object) {
    const froe_object o = froe_scene_object(s->scene, object);
    const size_t starts[2] = {0, o.corners}, dim = (size_t)s->dim;
    double coords[EXTREME_CORNERS * FROE_MAX_DIM];
    for (uint32_t c = 0; c < o.corners; c++)
        memcpy(coords + c * dim, froe_scene_vertex(s->scene, froe_scene_corner(s->scene, object, c)),
               dim * sizeof *coords);
    const bool runs = o.form == FROE_HULL || o.form == FROE_POLYGON;
    assert_int_equal(
        trees_add(s->scene, o.form, 1, coords, o.form == FROE_BALL ? &o.radius : NULL, runs ? starts : NULL), FROE_OK);
}

static inline void extreme_add(extreme_scene *s, froe_kind kind) {
    static const size_t corners[] = {[FROE_POINT] = 1, [FROE_SEGMENT] = 2, [FROE_POLYGON] = 3,
                                     [FROE_BOX] = 2,   [FROE_BALL] = 1,    [FROE_HULL] = EXTREME_CORNERS};
    double x[EXTREME_CORNERS * FROE_MAX_DIM];
    const size_t starts[2] = {0, corners[kind]}, objects = froe_scene_object_count(s->scene);
    if (s->style == 2 && objects && !fuzz_int(&s->random, 0, 7)) {
        extreme_copy(s, base_below(fuzz_bits(&s->random), (uint32_t)objects));
        return;
    }
    for (int tries = 0; tries < 9; tries++) { /* what has no area, or would be too large, is refused */
        extreme_corners(s, x, corners[kind]);
        for (int k = 0; k < s->dim && kind == FROE_BOX; k++) {
            const double a = x[k], b = x[s->dim + k];
            x[k] = fmin(a, b), x[s->dim + k] = fmax(a, b);
        }
        const double radius =
            s->style == 0 ? s->scale * fabs(fuzz_unit(&s->random)) : fabs(extreme_number(&s->random, s->scene));
        if (!trees_add(s->scene, kind, 1, x, kind == FROE_BALL ? &radius : NULL, kind == FROE_HULL ? starts : NULL))
            return;
    }
}

/** Adds objects of the kinds in the mask. */
static inline void extreme_grow(extreme_scene *s, unsigned kinds, int count) {
    while (count > 0) {
        const int kind = fuzz_int(&s->random, 0, FROE_KIND_COUNT - 1);
        if (kinds >> kind & 1) extreme_add(s, (froe_kind)kind), count--;
    }
}

/** A scene without objects, of the style. */
static inline extreme_scene extreme_begin(int dim, int style, uint64_t seed) {
    extreme_scene s = {.random = {base_hash(seed, 80, (uint64_t)dim)}, .dim = dim, .style = style};
    assert_int_equal(froe_scene_new(dim, NULL, &s.scene), FROE_OK);
    s.scale = extreme_scale(&s.random, s.scene);
    s.fuzz = (fuzz_class)fuzz_int(&s.random, 0, FUZZ_CLASSES - 1);
    return s;
}

/** A scene of 1 .. most objects of the kinds in the mask, of any style. */
static inline froe_scene *extreme_scene_new(int dim, unsigned kinds, int most, uint64_t seed) {
    fuzz_source r = {base_hash(seed, 83, (uint64_t)dim)};
    extreme_scene s = extreme_begin(dim, fuzz_int(&r, 0, EXTREME_STYLES - 1), seed);
    extreme_grow(&s, kinds, fuzz_int(&r, 1, most));
    return s.scene;
}

/* ------------------------------------------------------------------ places -- */

/** A vertex, between two vertices, with coordinates of several, an ulp or any length beside one, or anywhere. */
static inline void extreme_point(fuzz_source *r, const froe_scene *scene, double *x) {
    const int dim = froe_scene_dim(scene), style = fuzz_int(r, 0, 5);
    const double *u = extreme_vertex(r, scene), *v = extreme_vertex(r, scene), share = fabs(fuzz_unit(r));
    const double power = extreme_scale(r, scene);
    for (int k = 0; k < dim; k++) {
        x[k] = extreme_number(r, scene);
        if (!u || style == 0) continue;
        x[k] = style == 1 ? extreme_vertex(r, scene)[k] : u[k];
        if (style == 2) x[k] = nextafter(x[k], fuzz_int(r, 0, 1) ? DBL_MAX : -DBL_MAX);
        if (style == 3) x[k] = x[k] * share + v[k] * (1 - share);
        if (style == 4) x[k] += power * fuzz_unit(r);
        x[k] = extreme_finite(x[k]);
    }
}

/** A length >= 0: how far a vertex is from x, about, or any. */
static inline double extreme_length(fuzz_source *r, const froe_scene *scene, const double *x) {
    const double *v = extreme_vertex(r, scene);
    const int style = fuzz_int(r, 0, 3);
    double length = 0;
    if (!v || style == 0) return fuzz_int(r, 0, 3) ? fabs(extreme_number(r, scene)) : 0;
    for (int k = 0; k < froe_scene_dim(scene); k++)
        length = style == 1 ? fmax(length, fabs(v[k] - x[k])) : hypot(length, v[k] - x[k]);
    if (style == 2) length = nextafter(length, fuzz_int(r, 0, 1) ? DBL_MAX : 0);
    return extreme_finite(length);
}
#endif
