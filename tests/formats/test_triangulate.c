/* test_triangulate.c: ears of polygons, against a search of all corners for each ear, and areas in whole numbers. */
#include "support/scenes.h"

#include "base/random.h"
#include "formats/input/triangulate.h"

enum { MOST = 64 };

typedef struct polygon {
    size_t count;
    int64_t xy[MOST][2];
} polygon;

static int64_t area(const int64_t *a, const int64_t *b, const int64_t *c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static int64_t ring_area(const polygon *p) {
    int64_t sum = 0;
    for (size_t i = 2; i < p->count; i++) sum += area(p->xy[0], p->xy[i - 1], p->xy[i]);
    return sum;
}

static bool between(const int64_t *a, const int64_t *b, const int64_t *p) {
    return area(a, b, p) == 0 && (p[0] - a[0]) * (p[0] - b[0]) <= 0 && (p[1] - a[1]) * (p[1] - b[1]) <= 0;
}

static int sign(int64_t x) {
    return (x > 0) - (x < 0);
}

static bool meet(const int64_t *a, const int64_t *b, const int64_t *c, const int64_t *d) {
    if (between(a, b, c) || between(a, b, d) || between(c, d, a) || between(c, d, b)) return true;
    return sign(area(a, b, c)) * sign(area(a, b, d)) < 0 && sign(area(c, d, a)) * sign(area(c, d, b)) < 0;
}

/** Could a new corner x come between corners i and i + 1? */
static bool fits(const polygon *p, size_t i, const int64_t *x) {
    const int64_t *u = p->xy[i], *v = p->xy[(i + 1) % p->count];
    if (area(u, v, x) == 0 && !between(u, v, x)) return false; /* no spikes */
    for (size_t j = 0; j < p->count; j++) {
        const int64_t *a = p->xy[j], *b = p->xy[(j + 1) % p->count];
        if (x[0] == a[0] && x[1] == a[1]) return false;
        if (j == i) continue;
        if (b != u && a != v && (meet(u, x, a, b) || meet(x, v, a, b))) return false;
        if (b == u && (between(u, x, a) || between(a, u, x) || meet(x, v, a, b))) return false;
        if (a == v && (between(x, v, b) || between(v, b, x) || meet(u, x, a, b))) return false;
    }
    return true;
}

/** A simple polygon that turns left, corners on a lattice, many of them straight. */
static polygon simple_polygon(uint64_t seed, size_t count, uint32_t range) {
    polygon p = {3, {{0, 0}, {range, 0}, {0, range}}};
    for (uint64_t draw = 0; draw < 4000 && p.count < count; draw++) {
        const int64_t x[2] = {base_below(base_hash(seed, draw, 0), range + 1),
                              base_below(base_hash(seed, draw, 1), range + 1)};
        const size_t i = base_below(base_hash(seed, draw, 2), (uint32_t)p.count);
        if (!fits(&p, i, x)) continue;
        memmove(p.xy + i + 2, p.xy + i + 1, (p.count - i - 1) * sizeof *p.xy);
        memcpy(p.xy + i + 1, x, sizeof x);
        p.count++;
    }
    assert_true(ring_area(&p) > 0);
    return p;
}

/** The definition: of the corners from `at` on, the first that turns left and has no other in its closed triangle. */
static size_t first_ear(const polygon *p, const size_t *ring, size_t left, size_t at) {
    for (size_t tried = 0; tried < left; tried++) {
        const size_t i = (at + tried) % left;
        const int64_t *a = p->xy[ring[(i + left - 1) % left]], *b = p->xy[ring[i]], *c = p->xy[ring[(i + 1) % left]];
        bool ear = area(a, b, c) > 0;
        for (size_t j = 0; j < left && ear; j++) {
            const int64_t *x = p->xy[ring[j]];
            ear = x == a || x == b || x == c || area(a, b, x) < 0 || area(b, c, x) < 0 || area(c, a, x) < 0;
        }
        if (ear) return i;
    }
    fail_msg("no ear");
    return 0;
}

static void check_definition(const polygon *p, const uint32_t *triangles) {
    size_t ring[MOST], at = 1;
    for (size_t i = 0; i < p->count; i++) ring[i] = i;
    for (size_t left = p->count; left >= 3; left--, triangles += 3) {
        const size_t i = first_ear(p, ring, left, at);
        assert_int_equal(triangles[0], ring[(i + left - 1) % left]);
        assert_int_equal(triangles[1], ring[i]);
        assert_int_equal(triangles[2], ring[(i + 1) % left]);
        memmove(ring + i, ring + i + 1, (left - i - 1) * sizeof *ring);
        at = i % (left - 1);
    }
}

/** In space, seen along z, x or y, from either side. */
static void triangulate(const polygon *p, uint32_t view, const froe_allocator *given, formats_indices *triangles) {
    double corners[MOST][3];
    const froe_allocator alloc = support_allocator(given);
    const bool turned = view & 1;
    for (size_t i = 0; i < p->count; i++) {
        corners[i][(view / 2) % 3] = turned ? (double)p->xy[i][1] : (double)p->xy[i][0];
        corners[i][(view / 2 + 1) % 3] = turned ? (double)p->xy[i][0] : (double)p->xy[i][1];
        corners[i][(view / 2 + 2) % 3] = (double)(p->xy[i][0] & 1) * 0.125; /* not quite flat */
    }
    assert_true(formats_triangulate(&alloc, corners[0], p->count, triangles));
    assert_int_equal(triangles->count, (p->count - 2) * 3);
}

static void simple_polygons_lose_the_first_ear_from_where_the_last_was(void **state) {
    (void)state;
    size_t corners = 0;
    for (uint32_t round = 0; round < 600; round++) {
        const polygon p = simple_polygon(round, 4 + round % 60, 3 + round % 40);
        formats_indices triangles = {0};
        triangulate(&p, round % 6, NULL, &triangles);
        check_definition(&p, triangles.data);
        const froe_allocator alloc = support_allocator(NULL);
        array_free(&alloc, &triangles);
        corners += p.count;
    }
    assert_true(corners > 10000);
}

static void any_ring_keeps_its_area_and_its_corners(void **state) {
    (void)state;
    const froe_allocator alloc = support_allocator(NULL);
    for (uint32_t round = 0; round < 600; round++) {
        polygon p = {.count = 3 + round % 60};
        for (uint64_t i = 0; i < p.count; i++)
            for (uint64_t k = 0; k < 2; k++) p.xy[i][k] = base_below(base_hash(round, i, k), 2 + round % 17);
        formats_indices triangles = {0};
        triangulate(&p, 0, NULL, &triangles);
        const uint32_t *t = triangles.data;
        int64_t sum = 0;
        size_t uses[MOST] = {0};
        for (size_t i = 0; i < p.count - 2; i++, t += 3) {
            sum += area(p.xy[t[0]], p.xy[t[1]], p.xy[t[2]]);
            for (int k = 0; k < 3; k++) uses[t[k]]++;
        }
        assert_true(sum == ring_area(&p));
        for (size_t i = 0; i < p.count; i++) assert_true(uses[i] > 0);
        array_free(&alloc, &triangles);
    }
}

/* ------------------------------------------------------------------ large ones -- */

enum { LARGE = 100000 };

/** Askew teeth, far from the origin; a spiral; a rectangle with straight corners; a star that crosses itself. */
static void large_corner(int shape, int64_t i, int64_t *x) {
    const int64_t half = LARGE / 2, turn = i < half ? i : LARGE - 1 - i, side = turn / 16 % 4;
    const int64_t r = 4 * (turn / 16) + (i < half ? 8 : 10), along = 2 * r * (turn % 16) / 16 - r;
    switch (shape) {
    case 0: /* a comb, its back below */
        x[0] = i < LARGE - 2 ? 3 * i + (i % 2 ? 70000 : 0) : i == LARGE - 2 ? 3 * LARGE - 40000 : -40000;
        x[1] = i < LARGE - 2 ? (i % 2 ? 70001 : 0) - i : -40000 - (i == LARGE - 2 ? LARGE : 0);
        break;
    case 1: /* two spirals of squares */
        x[0] = side == 0 ? along : side == 1 ? r : side == 2 ? -along : -r;
        x[1] = side == 0 ? -r : side == 1 ? along : side == 2 ? r : -along;
        break;
    case 2: /* 25,000 straight corners a side, seen askew */
        x[0] = i < LARGE / 4 ? i : i < half ? LARGE / 4 : i < 3 * LARGE / 4 ? 3 * LARGE / 4 - i : 0;
        x[1] = i < LARGE / 4 ? 0 : i < half ? i - LARGE / 4 : i < 3 * LARGE / 4 ? LARGE / 4 : LARGE - i;
        x[0] = 3 * x[0] - x[1], x[1] = 2 * x[1] + x[0];
        break;
    default:
        for (uint64_t k = 0; k < 2; k++) x[k] = base_below(base_hash(7, (uint64_t)i, k), 1 << 20);
    }
}

static void large_polygons_end(void **state) {
    (void)state;
    const froe_allocator alloc = support_allocator(NULL);
    double *corners = malloc(3 * LARGE * sizeof *corners);
    for (int shape = 0; shape < 4; shape++) {
        int64_t whole = 0, sum = 0, first[2], last[2], at[2], x[3][2];
        for (int64_t i = 0; i < LARGE; i++) {
            large_corner(shape, i, at);
            for (int k = 0; k < 2; k++) corners[3 * i + k] = (double)(at[k] + (INT64_C(1) << 44));
            corners[3 * i + 2] = (double)((at[0] ^ at[1]) & 7);
            if (i == 0) memcpy(first, at, sizeof at);
            if (i >= 2) whole += area(first, last, at);
            memcpy(last, at, sizeof at);
        }
        formats_indices triangles = {0};
        assert_true(formats_triangulate(&alloc, corners, LARGE, &triangles));
        const uint32_t *t = triangles.data, *end = t + triangles.count;
        assert_int_equal(end - t, 3 * (LARGE - 2));
        for (; t < end; t += 3) {
            for (int k = 0; k < 3; k++) large_corner(shape, t[k], x[k]);
            sum += area(x[0], x[1], x[2]);
        }
        assert_true(sum == whole || sum == -whole);
        array_free(&alloc, &triangles);
    }
    free(corners);
}

static froe_status with_allocator(void *user, const froe_allocator *alloc) {
    const polygon *p = user;
    double corners[MOST][3] = {{0}};
    formats_indices triangles = {0};
    for (size_t i = 0; i < p->count; i++)
        for (int k = 0; k < 2; k++) corners[i][k] = (double)p->xy[i][k];
    const bool done = formats_triangulate(alloc, corners[0], p->count, &triangles);
    array_free(alloc, &triangles);
    return done ? FROE_OK : FROE_E_MEMORY;
}

static void every_allocation_may_fail(void **state) {
    (void)state;
    polygon p = simple_polygon(1, MOST, 30);
    assert_true(test_memory_each(with_allocator, &p) > 4);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(simple_polygons_lose_the_first_ear_from_where_the_last_was),
        cmocka_unit_test(any_ring_keeps_its_area_and_its_corners),
        cmocka_unit_test(large_polygons_end),
        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
