/* Which rings are planar, convex and simple, against the definition: every edge has all
 * corners on one closed side, and no two edges meet but neighbours in their common corner. */
#include "support/memory.h"

#include "base/random.h"
#include "scene/polygon.h"
#include "scene/scene.h"
#include <math.h>
#include <string.h>

typedef struct lattice {
    int64_t x[3];
} lattice;

static lattice minus(lattice a, lattice b) {
    return (lattice){{a.x[0] - b.x[0], a.x[1] - b.x[1], a.x[2] - b.x[2]}};
}

static lattice cross(lattice a, lattice b) {
    return (lattice){
        {a.x[1] * b.x[2] - a.x[2] * b.x[1], a.x[2] * b.x[0] - a.x[0] * b.x[2], a.x[0] * b.x[1] - a.x[1] * b.x[0]}};
}

static int64_t dot(lattice a, lattice b) {
    return a.x[0] * b.x[0] + a.x[1] * b.x[1] + a.x[2] * b.x[2];
}

static bool same(lattice a, lattice b) {
    return memcmp(&a, &b, sizeof a) == 0;
}

/** Turn of a, b, c seen against the normal. */
static int turn(lattice normal, lattice a, lattice b, lattice c) {
    int64_t t = dot(normal, cross(minus(b, a), minus(c, a)));
    return (t > 0) - (t < 0);
}

static bool between(lattice a, lattice b, lattice x) { /* x on line ab: in the closed segment? */
    return dot(minus(x, a), minus(x, b)) <= 0;
}

/** Do the closed segments ab and cd of one plane meet? */
static bool meet(lattice n, lattice a, lattice b, lattice c, lattice d) {
    int tc = turn(n, a, b, c), td = turn(n, a, b, d), ta = turn(n, c, d, a), tb = turn(n, c, d, b);
    if (tc * td < 0 && ta * tb < 0) return true;
    return (!tc && between(a, b, c)) || (!td && between(a, b, d)) || (!ta && between(c, d, a)) ||
           (!tb && between(c, d, b));
}

typedef enum verdict { GOOD, FLAT, BAD } verdict;

/** The definition; `p` has no equal neighbours. */
static verdict judge(const lattice *p, int n) {
    lattice normal = {{0}}, zero = {{0}};
    for (int i = 0; i < n; i++)
        for (int j = 0; j < i; j++)
            for (int k = 0; k < j; k++)
                if (same(normal, zero)) normal = cross(minus(p[j], p[i]), minus(p[k], p[i]));
    if (same(normal, zero)) return FLAT;
    for (int i = 0; i < n; i++)
        if (dot(normal, minus(p[i], p[0])) != 0) return BAD;
    int sides = 0; /* bit 0: some corner left of some edge, bit 1: right */
    for (int i = 0; i < n; i++)
        for (int k = 0; k < n; k++) {
            int t = turn(normal, p[i], p[(i + 1) % n], p[k]);
            sides |= t > 0 ? 1 : t < 0 ? 2 : 0;
        }
    if (sides == 3) return BAD;
    for (int i = 0; i < n; i++) {
        lattice a = p[i], b = p[(i + 1) % n], c = p[(i + 2) % n];
        if (turn(normal, a, b, c) == 0 && dot(minus(a, b), minus(c, b)) > 0) return BAD; /* spike */
        for (int k = i + 2; k < n; k++)
            if ((k + 1) % n != i && meet(normal, a, b, p[k], p[(k + 1) % n])) return BAD;
    }
    return GOOD;
}

static int compact(lattice *p, int n) {
    int kept = 1;
    for (int i = 1; i < n; i++)
        if (!same(p[i], p[kept - 1])) p[kept++] = p[i];
    while (kept > 1 && same(p[kept - 1], p[0])) kept--;
    return kept;
}

/** The ring that came out must be a rotation of the one that went in. */
static void check_rotation(const froe_scene *s, const lattice *p, int n, double scale) {
    int matches = 0;
    assert_int_equal(scene_corners(s, 0), n);
    for (int shift = 0; shift < n; shift++) {
        int same_corners = 0;
        for (int i = 0; i < n; i++) {
            const double *x = scene_point(s, 0, (uint32_t)i);
            const int64_t *y = p[(i + shift) % n].x;
            same_corners +=
                x[0] == (double)y[0] * scale && x[1] == (double)y[1] * scale && x[2] == (double)y[2] * scale;
        }
        matches += same_corners == n;
    }
    assert_int_equal(matches, 1);
    lattice first[3];
    for (uint32_t i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) first[i].x[k] = (int64_t)(scene_point(s, 0, i)[k] / scale);
    lattice normal = cross(minus(first[1], first[0]), minus(first[2], first[0]));
    assert_true(dot(normal, normal) > 0);
}

static void check_flat(const froe_scene *s, const lattice *p, int n, double scale) {
    int64_t longest = 0, got = 0;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < i; j++) {
            int64_t length = dot(minus(p[i], p[j]), minus(p[i], p[j]));
            longest = length > longest ? length : longest;
        }
    assert_int_equal(scene_form(s, 0), longest ? FROE_SEGMENT : FROE_POINT);
    assert_int_equal(scene_corners(s, 0), longest ? 2 : 1);
    for (int k = 0; k < 3 && longest; k++) {
        int64_t d = (int64_t)((scene_point(s, 0, 0)[k] - scene_point(s, 0, 1)[k]) / scale);
        got += d * d;
    }
    assert_int_equal(got, longest);
}

/** Adds the ring, scaled, as the only polygon of a scene and compares with the definition. */
static verdict check(const lattice *ring, int count, double scale) {
    double xyz[3 * 12];
    lattice p[12];
    for (int i = 0; i < count; i++)
        for (int k = 0; k < 3; k++) xyz[3 * i + k] = (double)ring[i].x[k] * scale;
    memcpy(p, ring, (size_t)count * sizeof *p);
    int n = compact(p, count);
    verdict expected = n < 3 ? FLAT : judge(p, n);
    froe_scene *s;
    froe_diagnostic diag;
    froe_objects b = froe_objects_defaults();
    const size_t starts[] = {0, (size_t)count};
    b.coords = xyz;
    b.count = 1;
    b.starts = starts;
    assert_int_equal(froe_scene_new(3, NULL, &s), FROE_OK);
    froe_status status = froe_scene_add(s, &b, &diag);
    assert_int_equal(status, expected == BAD ? FROE_E_INPUT : FROE_OK);
    if (expected == GOOD) check_rotation(s, p, n, scale);
    if (expected == FLAT) check_flat(s, p, n, scale);
    if (expected == BAD) {
        assert_int_equal(diag.object, 0);
        assert_true(diag.corner < (uint32_t)count);
        assert_int_equal(froe_scene_vertex_count(s), 0);
    } else {
        assert_int_equal(scene_form(s, 0), expected == GOOD ? FROE_POLYGON : scene_form(s, 0));
        assert_int_equal(scene_validate(s, &s->alloc, NULL), FROE_OK);
    }
    froe_scene_free(s);
    return expected;
}

static const lattice frames[][2] = {
    {{{1, 0, 0}}, {{0, 1, 0}}}, {{{0, 0, 1}}, {{0, -1, 0}}}, {{{1, 0, 2}}, {{0, 0, -3}}}, {{{1, 2, 3}}, {{3, -1, 2}}}};

static lattice in_frame(const lattice *frame, int64_t u, int64_t v) {
    lattice p;
    for (int k = 0; k < 3; k++) p.x[k] = u * frame[0].x[k] + v * frame[1].x[k];
    return p;
}

static void every_ring_of_a_small_grid_is_judged_as_by_definition(void **state) {
    (void)state;
    size_t seen[3] = {0};
    for (int n = 3; n <= 4; n++)
        for (int code = 0, all = n == 3 ? 729 : 6561; code < all; code++) {
            lattice ring[4];
            for (int i = 0, rest = code; i < n; i++, rest /= 9)
                ring[i] = in_frame(frames[code % 4], rest % 9 / 3, rest % 3);
            seen[check(ring, n, 1)]++;
        }
    assert_true(seen[GOOD] > 1000 && seen[FLAT] > 500 && seen[BAD] > 2000);
}

static void random_rings_are_judged_as_by_definition(void **state) {
    (void)state;
    const double scales[] = {1, 0x1p1000, 0x1p-1074, 0x1p-540};
    size_t seen[3] = {0};
    for (uint64_t round = 0; round < 30000; round++) {
        lattice ring[8];
        int n = 3 + (int)base_below(base_hash(1, round, 0), 6);
        for (int i = 0; i < n; i++) {
            uint64_t hash = base_hash(2, round, (uint64_t)i);
            ring[i] = in_frame(frames[round % 4], base_below(hash, 4), base_below(base_mix(hash), 4));
            if (round % 10 == 9 && i == n - 1) ring[i].x[round % 3]++; /* off the plane, mostly */
        }
        seen[check(ring, n, scales[round / 4 % 4])]++;
    }
    assert_true(seen[GOOD] > 500 && seen[FLAT] > 100 && seen[BAD] > 10000);
}

static int64_t round_to_lattice(double x) {
    return (int64_t)(x < 0 ? x - 0.5 : x + 0.5);
}

/** Corners on a circle, visited in steps of `step`, each edge halved where it can be. */
static int star(int n, int step, lattice *ring) {
    int count = 0;
    for (int i = 0; i < n; i++) {
        double angle = 6.283185307179586 * (i * step % n) / n;
        ring[count++] =
            in_frame(frames[3], 2 * round_to_lattice(1000 * cos(angle)), 2 * round_to_lattice(1000 * sin(angle)));
    }
    return count;
}

static void stars_are_refused_and_regular_rings_are_not(void **state) {
    (void)state;
    lattice ring[12];
    for (int n = 3; n <= 11; n++)
        for (int step = 1; step < n; step++) {
            bool whole = true; /* one round through all corners */
            for (int d = 2; d <= n; d++) whole = whole && !(n % d == 0 && step % d == 0);
            if (!whole) continue;
            verdict v = check(ring, star(n, step, ring), 1);
            assert_int_equal(v, step == 1 || step == n - 1 ? GOOD : BAD);
        }
}

static void corners_on_edges_are_welcome_wherever_the_ring_starts(void **state) {
    (void)state;
    lattice ring[12], turned[12];
    int n = 0;
    for (int i = 0; i < 4; i++) ring[n++] = in_frame(frames[3], i, 0);
    for (int i = 0; i < 4; i++) ring[n++] = in_frame(frames[3], 4, i);
    for (int i = 0; i < 4; i++) ring[n++] = in_frame(frames[3], 4 - i, 4 - i);
    for (int shift = 0; shift < n; shift++) {
        for (int i = 0; i < n; i++) turned[i] = ring[(i + shift) % n];
        assert_int_equal(check(turned, n, 1), GOOD);
        for (int i = 0; i < n; i++) turned[i] = ring[(2 * n - i + shift) % n];
        assert_int_equal(check(turned, n, 1), GOOD);
    }
}

/** One polygon whose fault is known. */
static void expect_fault(const double *xyz, size_t corners, uint32_t corner, const char *reason) {
    const double fine[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    double all[9 + 3 * 8];
    memcpy(all, fine, sizeof fine);
    memcpy(all + 9, xyz, corners * 3 * sizeof *xyz);
    const size_t starts[] = {0, 3, 3 + corners};
    froe_objects b = froe_objects_defaults();
    froe_scene *s;
    froe_diagnostic diag;
    b.coords = all;
    b.count = 2;
    b.starts = starts;
    assert_int_equal(froe_scene_new(3, NULL, &s), FROE_OK);
    assert_int_equal(froe_scene_add(s, &b, &diag), FROE_E_INPUT);
    assert_int_equal(diag.object, 1);
    assert_int_equal(diag.corner, corner);
    assert_non_null(strstr(diag.message, reason));
    froe_scene_free(s);
}

static void refusals_name_the_corner_and_the_reason(void **state) {
    (void)state;
    expect_fault((const double[]){0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0x1p-1074}, 4, 3, "not planar");
    expect_fault((const double[]){0, 0, 0, 4, 0, 0, 1, 1, 0, 0, 4, 0}, 4, 2, "not convex");
    expect_fault((const double[]){0, 0, 0, 0, 0, 0, 4, 0, 0, 1, 1, 0, 0, 4, 0}, 5, 3, "not convex");
    expect_fault((const double[]){0, 0, 0, 4, 0, 0, 4, 4, 0, 4, 2, 0, 0, 4, 0}, 5, 2, "folds back");
    expect_fault((const double[]){0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 0, 4, 0, 0, 0, 4, 0}, 6, 2, "intersects itself");
}

static void a_nearly_flat_triangle_is_a_polygon(void **state) {
    (void)state;
    const double xyz[] = {0, 0, 0, 1, 1, 1, 0.5, 0.5, 0.5 + 0x1p-53};
    froe_objects b = froe_objects_defaults();
    froe_scene *s;
    b.coords = xyz;
    b.count = 1;
    assert_int_equal(froe_scene_new(3, NULL, &s), FROE_OK);
    assert_int_equal(froe_scene_add(s, &b, NULL), FROE_OK);
    assert_int_equal(scene_form(s, 0), FROE_POLYGON);
    froe_scene_free(s);
}

static void a_huge_collinear_ring_becomes_its_extremes(void **state) {
    (void)state;
    enum { N = 100000 };
    double *xyz = malloc(3 * N * sizeof *xyz);
    const size_t starts[] = {0, N};
    assert_non_null(xyz);
    for (int i = 0; i < N; i++)
        for (int k = 0; k < 3; k++) xyz[3 * i + k] = (double)(i * 7919 % N) * (k - 1);
    froe_objects b = froe_objects_defaults();
    froe_scene *s;
    b.coords = xyz;
    b.count = 1;
    b.starts = starts;
    assert_int_equal(froe_scene_new(3, NULL, &s), FROE_OK);
    assert_int_equal(froe_scene_add(s, &b, NULL), FROE_OK);
    assert_int_equal(scene_form(s, 0), FROE_SEGMENT);
    assert_true(scene_point(s, 0, 0)[0] == 1 - N && scene_point(s, 0, 1)[0] == 0);
    froe_scene_free(s);
    free(xyz);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_ring_of_a_small_grid_is_judged_as_by_definition),
        cmocka_unit_test(random_rings_are_judged_as_by_definition),
        cmocka_unit_test(stars_are_refused_and_regular_rings_are_not),
        cmocka_unit_test(corners_on_edges_are_welcome_wherever_the_ring_starts),
        cmocka_unit_test(refusals_name_the_corner_and_the_reason),
        cmocka_unit_test(a_nearly_flat_triangle_is_a_polygon),
        cmocka_unit_test(a_huge_collinear_ring_becomes_its_extremes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
