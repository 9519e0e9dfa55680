/* test_ask.c: questions to partitions of moving segments, against all segments one by one in whole numbers; snapshots,
 * against the live partition node for node. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

#include "kinetic/moving.h"

/* Linear motions from integers in the window 0 .. 64 are at multiples of 2^-31 at every tick. */
__extension__ typedef __int128 wide;
typedef struct spot {
    int64_t x, y;
} spot;
enum { MOST = 64, SCALE = 25 }; /* a tick is 2^-25: 64 / 2^31 */

typedef struct present {
    int count;
    spot end[MOST][2];
    bool here[MOST];
} present;

static spot whole(const double at[2]) {
    spot s = {(int64_t)ldexp(at[0], SCALE), (int64_t)ldexp(at[1], SCALE)};
    assert_true(ldexp((double)s.x, -SCALE) == at[0] && ldexp((double)s.y, -SCALE) == at[1]);
    return s;
}

/* By linear motion from knot to knot; speeds are whole, so this is exact. */
static spot vertex_at(const froe_motion *m, uint32_t vertex, double time) {
    size_t knot = 0;
    while (knot + 2 < froe_motion_knot_count(m, vertex) && froe_motion_knot(m, vertex, knot + 1).time <= time) knot++;
    const froe_moving_knot a = froe_motion_knot(m, vertex, knot), b = froe_motion_knot(m, vertex, knot + 1);
    double at[2];
    for (int c = 0; c < 2; c++) at[c] = a.at[c] + (b.at[c] - a.at[c]) / (b.time - a.time) * (time - a.time);
    return whole(at);
}

static void look(const froe_kinetic *k, present *p) {
    const froe_motion *m = k->now.motion;
    p->count = (int)froe_motion_object_count(m);
    for (int i = 0; i < p->count; i++) {
        p->here[i] = segment_at(k, (uint32_t)i)->here;
        for (int e = 0; e < 2; e++)
            p->end[i][e] = vertex_at(m, froe_motion_object(m, (uint32_t)i).vertices[e], froe_kinetic_time(k));
        spot *end = p->end[i];
        if (end[0].x > end[1].x || (end[0].x == end[1].x && end[0].y > end[1].y)) {
            spot other = end[0];
            end[0] = end[1], end[1] = other;
        }
    }
}

static wide cross(spot a, spot b, spot q) {
    return (wide)(b.x - a.x) * (q.y - a.y) - (wide)(b.y - a.y) * (q.x - a.x);
}
static int sign(wide x) {
    return (x > 0) - (x < 0);
}
static int order(spot a, spot b) {
    return a.x != b.x ? (a.x > b.x) - (a.x < b.x) : (a.y > b.y) - (a.y < b.y);
}

static bool is_on(const spot end[2], spot q) {
    return !cross(end[0], end[1], q) && order(end[0], q) <= 0 && order(q, end[1]) <= 0;
}

/* Is segment i strictly between the point and segment j, straight up (1) or down (-1)? Both span the point's x. */
static bool is_nearer(const present *p, int i, int j, spot q, int up) {
    const spot *a = p->end[i], *b = p->end[j];
    wide da = b[1].x - b[0].x, db = a[1].x - a[0].x; /* heights over q are cross / width */
    if (!da || !db) return false;
    /* heights over q as multiples of 2^-SCALE, rounded down, suffice where they differ; equal ones pass */
    wide ha = -cross(a[0], a[1], q) / db, hb = -cross(b[0], b[1], q) / da;
    return up > 0 ? ha + 1 < hb : ha - 1 > hb;
}

static void check_locate(froe_kinetic *k, const present *p, spot q) {
    froe_kinetic_place place;
    const double at[2] = {ldexp((double)q.x, -SCALE), ldexp((double)q.y, -SCALE)};
    assert_int_equal(froe_kinetic_locate(k, at, &place, NULL), FROE_OK);
    bool on = false;
    for (int i = 0; i < p->count; i++) on |= p->here[i] && is_on(p->end[i], q);
    assert_int_equal(on, place.on != FROE_NONE);
    if (on) {
        assert_true(is_on(p->end[place.on], q));
        return;
    }
    for (int up = 1; up >= -1; up -= 2) {
        uint32_t next = up > 0 ? place.above : place.below;
        if (next != FROE_NONE) {
            const spot *end = p->end[next];
            assert_true(order(end[0], q) < 0 && order(q, end[1]) < 0);
            assert_int_equal(sign(cross(end[0], end[1], q)), -up);
        }
        for (int i = 0; i < p->count; i++) {
            const spot *end = p->end[i];
            if (!p->here[i] || order(end[0], q) >= 0 || order(q, end[1]) >= 0) continue;
            if (sign(cross(end[0], end[1], q)) != -up) continue;
            assert_true(next != FROE_NONE);
            assert_false(is_nearer(p, i, (int)next, q, up));
        }
    }
}

/* The share of the way at which a segment is met first, as a fraction; false: not at all. */
static bool meets(const spot end[2], spot from, spot to, wide share[2]) {
    wide a = cross(end[0], end[1], from), b = cross(end[0], end[1], to);
    wide c = cross(from, to, end[0]), d = cross(from, to, end[1]);
    if (sign(a) * sign(b) > 0 || sign(c) * sign(d) > 0) return false;
    share[0] = a < 0 ? -a : a, share[1] = a < b ? b - a : a - b;
    if (a || b) return true;
    share[1] = 1; /* in one line: the nearer end, if it is on the way */
    bool found = false;
    if (is_on(end, from)) return share[0] = 0, true;
    wide length = (to.x > from.x ? to.x - from.x : from.x - to.x) + (to.y > from.y ? to.y - from.y : from.y - to.y);
    for (int e = 0; e < 2; e++) {
        const spot way[2] = {order(from, to) < 0 ? from : to, order(from, to) < 0 ? to : from};
        if (!is_on(way, end[e])) continue;
        wide gone = (end[e].x > from.x ? end[e].x - from.x : from.x - end[e].x) +
                    (end[e].y > from.y ? end[e].y - from.y : from.y - end[e].y);
        if (found && gone >= share[0]) continue;
        share[0] = gone, share[1] = length, found = true;
    }
    return found;
}

/* Fractions, not negative, by their continued fractions: products may be too wide. */
static int compare_shares(const wide a[2], const wide b[2]) {
    wide p[2] = {a[0], a[1]}, q[2] = {b[0], b[1]};
    for (int turn = 1;; turn = -turn) {
        wide x = p[0] / p[1], y = q[0] / q[1];
        if (x != y) return x < y ? -turn : turn;
        wide r = p[0] % p[1], s = q[0] % q[1];
        if (!r || !s) return r ? turn : s ? -turn : 0;
        p[0] = p[1], p[1] = r, q[0] = q[1], q[1] = s;
    }
}

static bool check_ray(froe_kinetic *k, const present *p, spot from, spot to) {
    const double a[2] = {ldexp((double)from.x, -SCALE), ldexp((double)from.y, -SCALE)};
    const double b[2] = {ldexp((double)to.x, -SCALE), ldexp((double)to.y, -SCALE)};
    uint32_t hit;
    assert_int_equal(froe_kinetic_ray(k, a, b, &hit, NULL), FROE_OK);
    wide best[2] = {0, 0}, share[2];
    bool found = false;
    for (int i = 0; i < p->count; i++) {
        if (!p->here[i] || !meets(p->end[i], from, to, share)) continue;
        if (found && compare_shares(share, best) >= 0) continue;
        best[0] = share[0], best[1] = share[1];
        found = true;
    }
    assert_int_equal(found, hit != FROE_NONE);
    if (!found) return false;
    assert_true(meets(p->end[hit], from, to, share));
    assert_int_equal(compare_shares(share, best), 0);
    return true;
}

/* --------------------------------------------------------------------- order -- */

typedef struct painting {
    const present *p;
    spot eye;
    uint32_t object[4096];
    double ends[4096][4];
    size_t count;
} painting;

static bool paint(void *user, uint32_t object, const double ends[4]) {
    painting *o = user;
    assert_true(o->count < 4096);
    o->object[o->count] = object;
    for (int i = 0; i < 4; i++) o->ends[o->count][i] = ends[i];
    o->count++;
    return true;
}

/* A line of sight to a point inside a fragment meets no fragment that was painted before it. */
static void check_order(froe_kinetic *k, painting *o, fuzz_source *r) {
    const double eye[2] = {ldexp((double)o->eye.x, -SCALE), ldexp((double)o->eye.y, -SCALE)};
    o->count = 0;
    assert_int_equal(froe_kinetic_order(k, eye, paint, o, NULL), FROE_OK);
    for (int tries = 0; tries < 40 && o->count; tries++) {
        size_t at = (size_t)fuzz_int(r, 0, (int)o->count - 1);
        const double *e = o->ends[at], q[2] = {0.5 * (e[0] + e[2]), 0.5 * (e[1] + e[3])};
        for (size_t i = 0; i < at; i++) { /* what was painted before it does not hide it */
            const double *f = o->ends[i];
            double u = (f[2] - f[0]) * (eye[1] - f[1]) - (f[3] - f[1]) * (eye[0] - f[0]);
            double v = (f[2] - f[0]) * (q[1] - f[1]) - (f[3] - f[1]) * (q[0] - f[0]);
            double s = (q[0] - eye[0]) * (f[1] - eye[1]) - (q[1] - eye[1]) * (f[0] - eye[0]);
            double t = (q[0] - eye[0]) * (f[3] - eye[1]) - (q[1] - eye[1]) * (f[2] - eye[0]);
            if (s * t < -1e-9 && u * v < -1e-9)
                fail_msg("segment %u of %zu, %g %g to %g %g, hides segment %u, %g %g to %g %g, from %g %g",
                         o->object[i], o->count, f[0], f[1], f[2], f[3], o->object[at], e[0], e[1], e[2], e[3], eye[0],
                         eye[1]);
        }
    }
}

/* ------------------------------------------------------------------ snapshots -- */

static void check_snapshot(froe_kinetic *k) {
    froe_snapshot s = {0};
    assert_int_equal(froe_kinetic_snapshot(k, NULL, &s, NULL), FROE_OK);
    assert_int_equal(s.rounded, 0);
    assert_true(s.alike);
    froe_tree_free(s.tree);
    froe_places_free(s.places);
}

/* ------------------------------------------------------------------------ runs -- */

static spot any_spot(const present *p, fuzz_source *r, int grid) {
    int i = fuzz_int(r, 0, p->count - 1);
    const spot *end = p->end[i];
    switch (fuzz_int(r, 0, 4)) {
    case 0:
        return end[fuzz_int(r, 0, 1)];
    case 1:
        return (spot){(end[0].x + end[1].x) / 2, (end[0].y + end[1].y) / 2};
    case 2:
        return (spot){end[0].x, end[fuzz_int(r, 0, 1)].y + fuzz_int(r, -1, 1) * ((int64_t)1 << SCALE)};
    default:
        return (spot){fuzz_int(r, -grid, 2 * grid) * ((int64_t)1 << (SCALE - 1)),
                      fuzz_int(r, -grid, 2 * grid) * ((int64_t)1 << (SCALE - 1))};
    }
}

static const moving_kind kinds[] = {
    {.name = "lattice", .count = 24, .grid = 8, .length = 4, .speed = 1, .spin = 1},
    {.name = "no turns", .count = 30, .grid = 8, .length = 4, .speed = 1},
    {.name = "upright", .count = 24, .grid = 12, .length = 8, .speed = 1, .upright = true},
    {.name = "chains", .count = 25, .grid = 20, .length = 6, .speed = 1, .spin = 1, .chains = true},
    {.name = "lanes", .count = 24, .grid = 12, .length = 5, .speed = 2, .spin = 1, .lanes = true},
    {.name = "mortal", .count = 24, .grid = 16, .length = 6, .speed = 2, .spin = 1, .mortal = true},
    {.name = "loose", .count = 40, .grid = 200, .length = 60, .speed = 5, .spin = 3},
};

static void test_against_all(void **state) {
    (void)state;
    static painting o;
    unsigned hits = 0, rays = 0;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        for (uint64_t seed = 1; seed <= 4; seed++) {
            froe_motion *m = moving_new(kinds + i, seed, NULL);
            froe_kinetic_options options = froe_kinetic_defaults();
            froe_kinetic *k = NULL;
            fuzz_source r = {seed + 100 * i};
            present p;
            options.seed = seed;
            options.augmented = seed % 2;
            assert_int_equal(froe_kinetic_new(m, &options, NULL, &k, NULL), FROE_OK);
            for (double time = 0; time < 12; time += 0.7) {
                assert_int_equal(froe_kinetic_advance(k, time, NULL, NULL, NULL), FROE_OK);
                look(k, &p);
                check_snapshot(k);
                for (int j = 0; j < 60; j++) {
                    check_locate(k, &p, any_spot(&p, &r, kinds[i].grid));
                    spot from = any_spot(&p, &r, kinds[i].grid), to = any_spot(&p, &r, kinds[i].grid);
                    hits += check_ray(k, &p, from, to);
                    rays++;
                }
                o.p = &p, o.eye = any_spot(&p, &r, kinds[i].grid);
                check_order(k, &o, &r);
            }
            assert_int_equal(froe_kinetic_audit(k, NULL), FROE_OK);
            froe_kinetic_free(k);
            froe_motion_free(m);
        }
    assert_true(hits > rays / 4 && hits < rays);
}

/* ------------------------------------------------------------------- instants -- */

typedef struct timing {
    froe_kinetic *k;
    unsigned exact, contacts;
} timing;

/* At the end of a bar that falls on a floor, the time of its contact is known. */
static bool time_it(void *user, const froe_event *event) {
    timing *t = user;
    double at[2];
    assert_int_equal(froe_kinetic_instant(t->k, at, NULL), FROE_OK);
    assert_true(at[0] <= at[1] && at[0] >= event->early - 1e-9 && at[1] <= event->late + 1e-9);
    if (event->kind != FROE_EVENT_CONTACT) return true;
    const double truth[3] = {3, 64.0 / 3, 16 * sqrt(2)}; /* y = 3 - t; 64 - 3 t; 32 - t^2 / 16 */
    for (int i = 0; i < 3; i++)
        if (fabs(at[0] - truth[i]) < 1e-6) {
            assert_true(at[0] <= nextafter(truth[i], 99) && at[1] >= nextafter(truth[i], 0));
            assert_true(at[1] <= nextafter(at[0], 99));
            t->exact += at[0] == at[1];
            t->contacts++;
        }
    return true;
}

static void test_instants(void **state) {
    (void)state;
    const size_t starts[] = {0, 1, 2, 4, 6, 8, 10, 12, 14};
    const double times[] = {0, 0, 0, 64, 0, 64, 0, 64, 0, 64, 0, 64, 0, 64};
    const double coords[] = {-100, 0,    100, 0,  0,  3,  0,  -61, 1,  9,    1,  9,  10, 64,
                             10,   -128, 11,  80, 11, 80, 20, 32,  20, -224, 21, 90, 21, 90};
    double controls[28];
    for (int i = 0; i < 28; i++) controls[i] = (double)NAN;
    controls[20] = 20, controls[21] = 32; /* at rest at first */
    froe_motion_options w = froe_motion_defaults();
    froe_motion *m = NULL;
    w.begin = 0, w.end = 64;
    assert_int_equal(froe_motion_new(&w, NULL, &m, NULL), FROE_OK);
    froe_moving b = froe_moving_defaults();
    b.vertex_count = 8, b.count = 4, b.starts = starts, b.times = times, b.coords = coords, b.controls = controls;
    froe_diagnostic why = {0};
    if (froe_motion_add(m, &b, &why)) fail_msg("%s", why.message);
    froe_kinetic_options o = froe_kinetic_defaults();
    timing t = {0};
    assert_int_equal(froe_kinetic_new(m, &o, NULL, &t.k, NULL), FROE_OK);
    assert_int_equal(froe_kinetic_advance(t.k, 64, time_it, &t, NULL), FROE_OK);
    assert_int_equal(t.contacts, 3);
    assert_int_equal(t.exact, 1);
    double at[2];
    assert_int_equal(froe_kinetic_instant(t.k, at, NULL), FROE_E_ARG);
    froe_kinetic_free(t.k);
    froe_motion_free(m);
}

static void test_refusals(void **state) {
    (void)state;
    froe_motion *m = moving_new(kinds, 1, NULL);
    froe_kinetic_options options = froe_kinetic_defaults();
    froe_kinetic *k = NULL;
    froe_kinetic_place place;
    uint32_t hit;
    const double good[2] = {1, 2}, bad[2] = {1, (double)NAN}, far[2] = {(double)INFINITY, 0};
    assert_int_equal(froe_kinetic_new(m, &options, NULL, &k, NULL), FROE_OK);
    assert_int_equal(froe_kinetic_locate(k, bad, &place, NULL), FROE_E_ARG);
    assert_int_equal(froe_kinetic_locate(NULL, good, &place, NULL), FROE_E_ARG);
    assert_int_equal(froe_kinetic_locate(k, good, NULL, NULL), FROE_E_ARG);
    assert_int_equal(froe_kinetic_ray(k, good, far, &hit, NULL), FROE_E_ARG);
    assert_int_equal(froe_kinetic_order(k, good, NULL, NULL, NULL), FROE_E_ARG);
    froe_snapshot snapshot;
    assert_int_equal(froe_kinetic_snapshot(k, NULL, NULL, NULL), FROE_E_ARG);
    assert_int_equal(froe_kinetic_snapshot(NULL, NULL, &snapshot, NULL), FROE_E_ARG);
    assert_int_equal(froe_kinetic_snapshot(k, &(froe_snapshot_options){.size = 1}, &snapshot, NULL), FROE_E_OPTIONS);
    froe_kinetic_free(k);
    froe_motion_free(m);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_against_all), cmocka_unit_test(test_instants),
                                       cmocka_unit_test(test_refusals)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
