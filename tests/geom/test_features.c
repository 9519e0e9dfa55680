/* test_features.c: the corner, edge or interior of a triangle that is nearest to a point (geom/meet/feature.h), beside
 * signs in whole numbers. Edges have 21 bits and points up to 54, so that products are rounded; many points lie
 * within a unit of where one region ends. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "geom/meet/distance.h"
#include "geom/meet/feature.h"
#include "support/fuzz.h"
#include "support/sanitized.h"
#include <math.h>

__extension__ typedef __int128 whole;
enum { TRIALS = 200000 / SANITIZED_SHARE(8) };
static num_context context;

static whole dot(const whole a[3], const whole b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void between(const double p[3], const double q[3], whole out[3]) {
    for (int k = 0; k < 3; k++) out[k] = (whole)q[k] - (whole)p[k];
}

static void normal_of(const double p[3], const double q[3], const double r[3], whole n[3]) {
    whole e[3], f[3];
    between(p, q, e);
    between(p, r, f);
    for (int k = 0; k < 3; k++) n[k] = e[(k + 1) % 3] * f[(k + 2) % 3] - e[(k + 2) % 3] * f[(k + 1) % 3];
}

/* Two triangles that have edge 0 -> 1 in common, and a point beyond this edge or a corner of it, near the plane that
 * divides the regions of the edge and of either interior. */
typedef struct fold {
    double p[4][3], x[3];
} fold;

static void draw_fold(fuzz_source *r, fold *f) {
    whole n[3];
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 3; k++) f->p[i][k] = fuzz_int(r, -(1 << 20), 1 << 20);
    const int style = fuzz_int(r, 0, 3);
    normal_of(f->p[0], f->p[1], f->p[fuzz_int(r, 2, 3)], n);
    const double along = style == 3 ? fuzz_int(r, 0, 1) : fuzz_int(r, -500, 1500) / 1000.0;
    const double away = (fuzz_int(r, 0, 1) ? -1 : 1) * ldexp(fuzz_int(r, 1, 1000), fuzz_int(r, -18, 1));
    for (int k = 0; k < 3; k++) {
        const double foot = f->p[0][k] + along * (f->p[1][k] - f->p[0][k]);
        f->x[k] = style == 0 ? ldexp(fuzz_int(r, -(1 << 21), 1 << 21), 32) : floor(foot + away * (double)n[k]);
        if (style == 2) f->x[k] += fuzz_int(r, -4, 4);
    }
}

/* Does the hull of the first `count` corners hold the nearest point in its relative interior? */
static bool is_nearest(const double *x, const double *const corner[3], int count) {
    whole v[3][3], e[3][3], a[3], b[3];
    for (int i = 0; i < 3; i++) between(x, corner[i], v[i]), between(corner[i], corner[(i + 1) % 3], e[i]);
    for (int i = 0; i < 3; i++) a[i] = dot(e[i], v[i]), b[i] = dot(e[i], v[(i + 1) % 3]);
    if (count == 1) return a[0] > 0 && b[2] < 0;
    bool nearest = true;
    for (int i = 0; i < 3; i++) {
        whole n[3], across = 0;
        normal_of(corner[0], corner[1], corner[2], n);
        for (int k = 0; k < 3; k++)
            across += n[k] * (v[i][(k + 1) % 3] * e[i][(k + 2) % 3] - v[i][(k + 2) % 3] * e[i][(k + 1) % 3]);
        if (count == 2 && i == 0) return a[0] < 0 && b[0] > 0 && across < 0;
        nearest = nearest && across > 0;
    }
    return nearest;
}

/* The corners of a triangle with those of the feature first, in the same sense of rotation. */
static void turn_to(const double *const corner[3], const double *first, const double *out[3]) {
    int at = 0;
    while (corner[at] != first) at++;
    for (int i = 0; i < 3; i++) out[i] = corner[(at + i) % 3];
}

static void sure_regions_are_right(void **state) {
    fuzz_source r = {1};
    int found[4] = {0};
    (void)state;
    for (int trial = 0; trial < TRIALS; trial++) {
        fold f;
        geom_feature feature;
        draw_fold(&r, &f);
        const double *const corner[3] = {f.p[0], f.p[1], f.p[2]}, *turned[3];
        if (!geom_feature_nearest(f.x, corner, &feature)) continue;
        turn_to(corner, feature.corner[0], turned);
        for (int i = 0; i < feature.count; i++) assert_ptr_equal(turned[i], feature.corner[i]);
        if (!is_nearest(f.x, turned, feature.count)) fail_msg("trial %d: %d corners", trial, feature.count);
        found[feature.count]++;
    }
    for (int count = 1; count <= 3; count++)
        if (found[count] < TRIALS / 400) fail_msg("%d features of %d corners", found[count], count);
}

/* The conditions of feature.h in whole numbers, for any corners of the second triangle. */
static bool is_shared(const fold *f, const double *const *nearest, int count) {
    whole v[3], e[3], g[3];
    between(f->x, nearest[0], v);
    between(nearest[0], nearest[count - 1], e);
    for (int i = 0; i < 4; i++) {
        if (i == 2 || f->p[i] == nearest[0] || f->p[i] == nearest[count - 1]) continue;
        between(nearest[0], f->p[i], g);
        if (count == 1 ? dot(v, g) <= 0 : dot(v, g) * dot(e, e) <= dot(e, v) * dot(e, g)) return false;
    }
    return true;
}

static void what_is_surely_shared_is_the_nearest_of_both(void **state) {
    fuzz_source r = {2};
    int found[3] = {0};
    (void)state;
    for (int trial = 0; trial < TRIALS; trial++) {
        fold f;
        geom_feature feature;
        draw_fold(&r, &f);
        const double *const one[3] = {f.p[0], f.p[1], f.p[2]}, *const other[3] = {f.p[3], f.p[1], f.p[0]};
        if (!geom_feature_nearest(f.x, one, &feature) || feature.count > 2) continue;
        if (!geom_feature_shared(f.x, other, feature.corner, feature.count)) continue;
        assert_true(feature.corner[0] != f.p[2] && feature.corner[feature.count - 1] != f.p[2]);
        if (!is_shared(&f, feature.corner, feature.count)) fail_msg("trial %d: %d corners", trial, feature.count);
        found[feature.count]++;
    }
    assert_true(found[1] > TRIALS / 100 && found[2] > TRIALS / 100);
}

/* Only corners and edges of triangles of space are, and where filters are asked. */
static void other_bodies_share_nothing(void **state) {
    static const double p[] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4, 4, 4, 0}, x[] = {2, -1, -1}, above[] = {1, 1, 1};
    static const double beside[] = {-1, -1, -1};
    static const uint32_t first[] = {0, 1, 2}, second[] = {1, 0, 3}, around[] = {0, 1, 4, 2};
    const geom_body one = {FROE_POLYGON, 3, 3, p, first, 0}, two = {FROE_POLYGON, 3, 3, p, second, 0};
    const geom_body four = {FROE_POLYGON, 3, 4, p, around, 0}, side = {FROE_SEGMENT, 3, 2, p, second, 0};
    const geom_body flat = {FROE_POLYGON, 2, 3, p, second, 0}, box = {FROE_BOX, 3, 2, p, first, 0};
    const geom_distance edge = geom_distance_from(&context, x, &one), face = geom_distance_from(&context, above, &one);
    const geom_distance corner = geom_distance_from(&context, beside, &one),
                        wall = geom_distance_from(&context, x, &box);
    (void)state;
    assert_true(geom_distance_shared(&context, x, &two, &edge));
    assert_true(geom_distance_shared(&context, beside, &two, &corner));
    assert_false(geom_distance_shared(&context, above, &two, &face));
    assert_false(geom_distance_shared(&context, x, &two, &wall));
    assert_false(geom_distance_shared(&context, x, &four, &edge));
    assert_false(geom_distance_shared(&context, x, &side, &edge));
    assert_false(geom_distance_shared(&context, x, &flat, &edge));
    context.first = NUM_BALL;
    assert_false(geom_distance_shared(&context, x, &two, &edge));
    context.first = NUM_FILTER;
}

static int begin(void **state) {
    (void)state;
    return num_context_new(NULL, &context);
}

static int end(void **state) {
    (void)state;
    num_context_free(&context);
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sure_regions_are_right),
        cmocka_unit_test(what_is_surely_shared_is_the_nearest_of_both),
        cmocka_unit_test(other_bodies_share_nothing),
    };
    return cmocka_run_group_tests(tests, begin, end);
}
