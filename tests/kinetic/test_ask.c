/* test_ask.c: questions to partitions of moving segments, against all segments one by one in exact numbers; snapshots,
 * against the live partition node for node. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

#include "kinetic/beside.h"
#include "kinetic/moving.h"
#include "kinetic/space.h"
#include "oracle/touching.h"

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

/* At a vertex, on a segment, above or below an end, or anywhere on the lattice of halves. */
static void any_spot(const froe_kinetic *k, fuzz_source *r, int grid, double at[2]) {
    const froe_moving_object o =
        froe_motion_object(k->now.motion, (uint32_t)fuzz_int(r, 0, (int)froe_motion_object_count(k->now.motion) - 1));
    const int what = fuzz_int(r, 0, 4);
    double end[2][2];
    bool there = true;
    for (int e = 0; e < 2; e++)
        there = there && froe_motion_position(k->now.motion, o.vertices[e], froe_kinetic_time(k), end[e]);
    for (int c = 0; c < 2; c++) {
        at[c] = 0.5 * fuzz_int(r, -grid, 2 * grid);
        if (!there || what > 2) continue;
        if (what == 0) at[c] = end[0][c];
        if (what == 1) at[c] = 0.5 * (end[0][c] + end[1][c]);
        if (what == 2) at[c] = end[c][c] + (c ? fuzz_int(r, -1, 1) : 0);
    }
}

static const moving_kind kinds[] = {
    {.name = "lattice", .count = 24, .grid = 8, .length = 4, .speed = 1, .spin = 1},
    {.name = "no turns", .count = 30, .grid = 8, .length = 4, .speed = 1},
    {.name = "upright", .count = 24, .grid = 12, .length = 8, .speed = 1, .upright = true},
    {.name = "chains", .count = 25, .grid = 20, .length = 6, .speed = 1, .spin = 1, .chains = true},
    {.name = "lanes", .count = 24, .grid = 12, .length = 5, .speed = 2, .spin = 1, .lanes = true},
    {.name = "mortal", .count = 24, .grid = 16, .length = 6, .speed = 2, .spin = 1, .mortal = true},
    {.name = "loose", .count = 30, .grid = 200, .length = 60, .speed = 5, .spin = 3},
};

static void ask(beside *b, fuzz_source *r, int grid) {
    present p;
    beside_look(b, &p);
    for (int j = 0; j < 60; j++) {
        double from[2], to[2];
        any_spot(b->kinetic, r, grid, from), any_spot(b->kinetic, r, grid, to);
        if (!beside_locate(b, &p, from) || !beside_ray(b, &p, from, to)) fail_msg("%s", b->why);
        if (j % 10 == 0 && !beside_order(b, &p, from, to)) fail_msg("%s", b->why);
    }
    present_clear(&p);
}

/* Ticks are fine, or as long as it takes for much to be aligned at them. */
static void test_against_all(void **state) {
    (void)state;
    beside_counts sum = {0};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        for (uint64_t seed = 1; seed <= 3; seed++) {
            moving_kind kind = kinds[i];
            kind.tick = (double[]){0, 0.25, 1}[seed % 3];
            beside b = {.motion = moving_new(&kind, seed, NULL)};
            froe_kinetic_options options = froe_kinetic_defaults();
            fuzz_source r = {seed + 100 * i};
            options.seed = seed;
            options.augmented = seed % 2;
            assert_int_equal(froe_kinetic_new(b.motion, &options, NULL, &b.kinetic, NULL), FROE_OK);
            for (double time = 0; time < 12; time += 1.7) {
                assert_int_equal(
                    froe_kinetic_advance(b.kinetic, fmax(time, froe_kinetic_time(b.kinetic)), NULL, NULL, NULL),
                    FROE_OK);
                ask(&b, &r, kind.grid);
                if (kind.tick == 0) check_snapshot(b.kinetic);
            }
            assert_int_equal(froe_kinetic_audit(b.kinetic, NULL), FROE_OK);
            sum.rays += b.counts.rays, sum.hits += b.counts.hits, sum.pairs += b.counts.pairs;
            froe_kinetic_free(b.kinetic);
            froe_motion_free(b.motion);
        }
    assert_true(sum.hits > sum.rays / 4 && sum.hits < sum.rays);
    assert_true(sum.pairs > 400);
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

/* What is straight above and below points over and under the ends of two floors. */
static void test_up_is_inclined_to_the_left(void **state) {
    (void)state;
    const size_t starts[] = {0, 1, 2, 3, 4};
    const double times[4] = {0}, coords[] = {0, 5, 4, 5, 0, -5, 4, -5};
    froe_motion_options window = froe_motion_defaults();
    window.begin = 0, window.end = 1;
    froe_motion *m = NULL;
    assert_int_equal(froe_motion_new(&window, NULL, &m, NULL), FROE_OK);
    froe_moving b = froe_moving_defaults();
    b.vertex_count = 4, b.count = 2, b.starts = starts, b.times = times, b.coords = coords;
    assert_int_equal(froe_motion_add(m, &b, NULL), FROE_OK);
    const froe_kinetic_options o = froe_kinetic_defaults();
    froe_kinetic *k = NULL;
    assert_int_equal(froe_kinetic_new(m, &o, NULL, &k, NULL), FROE_OK);
    const uint32_t above[3] = {FROE_NONE, 0, 0}, below[3] = {1, 1, FROE_NONE};
    for (int i = 0; i < 3; i++) {
        froe_kinetic_place place;
        assert_int_equal(froe_kinetic_locate(k, (double[]){2.0 * i, 0}, &place, NULL), FROE_OK);
        assert_int_equal(place.on, FROE_NONE);
        assert_int_equal(place.above, above[i]);
        assert_int_equal(place.below, below[i]);
    }
    froe_kinetic_free(k);
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

/* ------------------------------------------------------------------ in space -- */

enum { CORNERS = 3, COLUMN_NEAR = 500 /* halvings of a tick */ };

/* Corners and a point in rationals. `near` is a time in ticks; the point is moved by so much less in y, and by the
 * square of that back in x, that nothing which moves until then is as near. */
typedef struct column {
    mpq_t time, near, little, v[CORNERS][3], p[3], t[6];
} column;

static void column_init(column *c) {
    mpq_t *all = (mpq_t *)c;
    for (size_t i = 0; i < sizeof *c / sizeof *all; i++) mpq_init(all[i]);
    mpq_set_ui(c->near, 1, 1);
    mpq_div_2exp(c->near, c->near, COLUMN_NEAR);
    mpq_set_ui(c->little, 1, 1);
    mpq_div_2exp(c->little, c->little, 10 * COLUMN_NEAR);
}

static void column_clear(column *c) {
    mpq_t *all = (mpq_t *)c;
    for (size_t i = 0; i < sizeof *c / sizeof *all; i++) mpq_clear(all[i]);
}

/* The cross product of q - p and r - p, or one coordinate of it. */
static void column_cross(column *c, mpq_t p[3], mpq_t q[3], mpq_t r[3], int axis, mpq_t out) {
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    mpq_sub(c->t[0], q[i], p[i]), mpq_sub(c->t[1], r[j], p[j]);
    mpq_mul(c->t[2], c->t[0], c->t[1]);
    mpq_sub(c->t[0], q[j], p[j]), mpq_sub(c->t[1], r[i], p[i]);
    mpq_mul(c->t[3], c->t[0], c->t[1]);
    mpq_sub(out, c->t[2], c->t[3]);
}

static void column_look(column *c, const froe_motion *m, uint32_t object) {
    const froe_moving_object o = froe_motion_object(m, object);
    for (int i = 0; i < CORNERS; i++) oracle_corner(m, o.vertices[i], c->time, c->v[i]);
}

/* Is the point between p and q? */
static bool column_on_edge(column *c, mpq_t p[3], mpq_t q[3]) {
    for (int axis = 0; axis < 3; axis++) {
        column_cross(c, p, q, c->p, axis, c->t[4]);
        if (mpq_sgn(c->t[4])) return false;
        const int before = mpq_cmp(p[axis], c->p[axis]), behind = mpq_cmp(q[axis], c->p[axis]);
        if (before * behind > 0) return false;
    }
    return true;
}

/* Is the point on the triangle? It is on an edge, or in its plane and on one side of all its edges. */
static bool column_is_on(column *c) {
    int axis = 0, area = 0;
    for (int i = 0; i < CORNERS; i++)
        if (column_on_edge(c, c->v[i], c->v[(i + 1) % 3])) return true;
    for (axis = 0; axis < 3 && !area; axis++) {
        column_cross(c, c->v[0], c->v[1], c->v[2], axis, c->t[4]);
        area = mpq_sgn(c->t[4]);
    }
    if (!area--) return false;
    mpq_set_ui(c->t[5], 0, 1);
    for (int i = 0; i < 3; i++) { /* the volume */
        column_cross(c, c->v[0], c->v[1], c->v[2], i, c->t[4]);
        mpq_sub(c->t[0], c->p[i], c->v[0][i]);
        mpq_mul(c->t[0], c->t[0], c->t[4]);
        mpq_add(c->t[5], c->t[5], c->t[0]);
    }
    if (mpq_sgn(c->t[5])) return false;
    int left = 0, right = 0;
    for (int i = 0; i < CORNERS; i++) {
        column_cross(c, c->v[i], c->v[(i + 1) % 3], c->p, axis - 1, c->t[4]);
        left += mpq_sgn(c->t[4]) > 0, right += mpq_sgn(c->t[4]) < 0;
    }
    return !left || !right;
}

/* Does the vertical line through the point meet the triangle, and how far above it? */
static bool column_height(column *c, mpq_t out) {
    int left = 0, right = 0;
    for (int i = 0; i < CORNERS; i++) {
        column_cross(c, c->v[i], c->v[(i + 1) % 3], c->p, 2, c->t[4]);
        left += mpq_sgn(c->t[4]) >= 0, right += mpq_sgn(c->t[4]) <= 0;
    }
    column_cross(c, c->v[0], c->v[1], c->v[2], 2, c->t[5]);
    if (!mpq_sgn(c->t[5]) || (left < CORNERS && right < CORNERS)) return false;
    mpq_sub(out, c->v[0][2], c->p[2]);
    for (int i = 0; i < 2; i++) { /* minus the normal in x and y times the way, by that in z */
        column_cross(c, c->v[0], c->v[1], c->v[2], i, c->t[4]);
        mpq_div(c->t[4], c->t[4], c->t[5]);
        mpq_sub(c->t[0], c->p[i], c->v[0][i]);
        mpq_mul(c->t[4], c->t[4], c->t[0]);
        mpq_sub(out, out, c->t[4]);
    }
    return true;
}

static void column_set_time(column *c, const froe_motion *m, const froe_kinetic *k, bool after) {
    mpq_set_d(c->time, froe_kinetic_time(k));
    mpq_set_d(c->t[0], froe_motion_window(m).tick);
    mpq_mul(c->t[0], c->t[0], c->near);
    if (after) mpq_add(c->time, c->time, c->t[0]);
}

typedef struct column_tally {
    int asked, on, above, below;
} column_tally;

/* All triangles one by one. */
static void check_column(column *c, froe_kinetic *k, const froe_motion *m, const double at[3], column_tally *tally) {
    froe_kinetic_place place, best = {FROE_NONE, FROE_NONE, FROE_NONE};
    mpq_t height, nearest[2];
    bool on = false;
    mpq_inits(height, nearest[0], nearest[1], NULL);
    assert_int_equal(froe_kinetic_locate_in_space(k, at, &place, NULL), FROE_OK);
    for (int i = 0; i < 3; i++) mpq_set_d(c->p[i], at[i]);
    column_set_time(c, m, k, false);
    for (uint32_t o = 0; o < froe_motion_object_count(m); o++) {
        const froe_moving_object life = froe_motion_object(m, o);
        if (froe_kinetic_time(k) < life.birth || froe_kinetic_time(k) > life.death) continue;
        column_look(c, m, o);
        const bool is_on = column_is_on(c);
        on = on || is_on;
        if (o == place.on) assert_true(is_on);
    }
    assert_int_equal(on, place.on != FROE_NONE);
    column_set_time(c, m, k, true);
    mpq_add(c->p[1], c->p[1], c->little);
    mpq_mul(height, c->little, c->little);
    mpq_sub(c->p[0], c->p[0], height);
    for (uint32_t o = 0; o < froe_motion_object_count(m) && !on; o++) {
        const froe_moving_object life = froe_motion_object(m, o);
        if (froe_kinetic_time(k) < life.birth || froe_kinetic_time(k) > life.death) continue;
        column_look(c, m, o);
        if (!column_height(c, height)) continue;
        const int up = mpq_sgn(height) > 0;
        uint32_t *found = up ? &best.above : &best.below;
        mpq_abs(height, height);
        if (*found != FROE_NONE && mpq_cmp(height, nearest[up]) >= 0) continue;
        *found = o;
        mpq_set(nearest[up], height);
    }
    if (!on && (place.above != best.above || place.below != best.below))
        fail_msg("%.17g %.17g %.17g at %.17g: %d %d, not %d %d", at[0], at[1], at[2], froe_kinetic_time(k),
                 (int)place.above, (int)place.below, (int)best.above, (int)best.below);
    tally->asked++, tally->on += on;
    tally->above += !on && best.above != FROE_NONE, tally->below += !on && best.below != FROE_NONE;
    mpq_clears(height, nearest[0], nearest[1], NULL);
}

/* Anywhere, in the middle of a triangle, on an edge or at a corner of one, or above or below that. */
static void some_point(fuzz_source *r, const froe_motion *m, double time, double out[3]) {
    const uint32_t o = (uint32_t)fuzz_int(r, 0, (int)froe_motion_object_count(m) - 1);
    const int share = fuzz_int(r, 0, 2);
    const froe_moving_object object = froe_motion_object(m, o);
    double v[3][3];
    for (int i = 0; i < 3; i++) assert_true(froe_motion_position(m, object.vertices[i], time, v[i]));
    for (int k = 0; k < 3; k++) {
        out[k] = share == 2 ? v[0][k] : 0.5 * v[0][k] + 0.5 * v[1][k];
        if (!share) out[k] = 0.5 * out[k] + 0.5 * v[2][k];
    }
    if (fuzz_int(r, 0, 1)) out[2] += fuzz_int(r, -2000, 2000);
    for (int k = 0; k < 2 && !fuzz_int(r, 0, 3); k++) out[k] += fuzz_int(r, -40, 40);
}

static void points_have_above_and_below_them_what_all_triangles_tell(void **state) {
    (void)state;
    column c;
    column_tally all = {0};
    column_init(&c);
    for (size_t i = 0; i < SPACE_KINDS; i++) {
        if (abs(space_kinds[i].scale) > 100) continue;
        froe_motion *m = space_new(space_kinds + i, 5, NULL);
        froe_kinetic_options o = froe_kinetic_defaults();
        froe_kinetic *k = NULL;
        fuzz_source r = {i + 1};
        assert_int_equal(froe_kinetic_new(m, &o, NULL, &k, NULL), FROE_OK);
        for (int step = 0; step < 6; step++) {
            const double next = froe_kinetic_next(k); /* at an event, and at any time */
            const double time = step % 2 && next < SPACE_WINDOW ? next : SPACE_WINDOW * step / 6.0;
            if (time > froe_kinetic_time(k)) assert_int_equal(froe_kinetic_advance(k, time, NULL, NULL, NULL), FROE_OK);
            for (int j = 0; j < 8; j++) {
                double at[3];
                some_point(&r, m, froe_kinetic_time(k), at);
                check_column(&c, k, m, at, &all);
            }
        }
        froe_kinetic_free(k);
        froe_motion_free(m);
    }
    assert_true(all.asked > 900 && all.on > 200 && all.above > 180 && all.below > 180);
    column_clear(&c);
}

/* Two walls in one upright plane: one has all nodes, and each is found by a point on it. */
static void points_on_walls_in_one_plane_are_found(void **state) {
    static const size_t starts[] = {0, 1, 2, 3, 4, 5, 6};
    static const double times[6] = {0}, coords[] = {0, 0, 0, 8, 8, 0, 4, 4, 2, 1, 1, 5, 7, 7, 5, 4, 4, 9};
    froe_motion_options w = froe_motion_defaults();
    froe_moving b = froe_moving_defaults();
    (void)state;
    w.dim = 3, w.begin = 0, w.end = 8;
    b.vertex_count = 6, b.count = 2, b.starts = starts, b.times = times, b.coords = coords;
    froe_motion *m = batch_motion(&w, &b, NULL);
    for (uint32_t first = 0; first < 2; first++) {
        const uint32_t order[2] = {first, 1 - first};
        froe_kinetic_options o = froe_kinetic_defaults();
        froe_kinetic *k = NULL;
        o.order = order;
        assert_int_equal(froe_kinetic_new(m, &o, NULL, &k, NULL), FROE_OK);
        for (uint32_t i = 0; i < 2; i++) {
            froe_kinetic_place place;
            assert_int_equal(froe_kinetic_locate_in_space(k, (double[]){3, 3, 1 + 5.0 * i}, &place, NULL), FROE_OK);
            assert_int_equal(place.on, i);
        }
        froe_kinetic_free(k);
    }
    froe_motion_free(m);
}

/* ------------------------------------------------------------------- layers -- */

typedef struct layer {
    uint32_t object;
    double corners[8];
} layer;

typedef struct layer_list {
    layer all[1 << 16];
    size_t count;
} layer_list;

static bool take_layer(void *user, uint32_t object, const double corners[8]) {
    layer_list *list = user;
    layer *l = list->all + list->count++;
    assert_true(list->count < sizeof list->all / sizeof *list->all);
    l->object = object;
    memcpy(l->corners, corners, sizeof l->corners);
    return true;
}

/* Between both walls, above the lower side and below the upper one? Either wall may be a point. */
static bool layer_has(const layer *l, const double at[2]) {
    const double *c = l->corners, share = (at[0] - c[0]) / (c[2] - c[0]);
    const double low = c[1] + share * (c[3] - c[1]), high = c[7] + share * (c[5] - c[7]);
    return at[0] > c[0] && at[0] < c[2] && at[1] > low && at[1] < high;
}

/* What covers a point is told once, and from below to above: heights in rationals say so. */
static int check_layers(column *c, const froe_motion *m, const layer_list *list, const double at[3]) {
    mpq_t height, last;
    size_t next = 0;
    int covered = 0, told = 0;
    mpq_inits(height, last, NULL);
    for (int i = 0; i < 3; i++) mpq_set_d(c->p[i], at[i]);
    for (uint32_t o = 0; o < froe_motion_object_count(m); o++) {
        column_look(c, m, o);
        covered += column_height(c, height);
    }
    for (; next < list->count; next++) {
        if (!layer_has(list->all + next, at)) continue;
        column_look(c, m, list->all[next].object);
        assert_true(column_height(c, height));
        if (told++) assert_true(mpq_cmp(height, last) > 0);
        mpq_set(last, height);
    }
    assert_int_equal(told, covered);
    mpq_clears(height, last, NULL);
    return told;
}

static void layers_are_told_from_below_to_above(void **state) {
    static layer_list list;
    static const size_t some[] = {0, 1, 3, 4, 6, 7, 8, 10};
    column c;
    int met = 0;
    (void)state;
    column_init(&c);
    for (size_t i = 0; i < sizeof some / sizeof *some; i++) {
        froe_motion *m = space_new(space_kinds + some[i], 3, NULL);
        froe_kinetic_options o = froe_kinetic_defaults();
        froe_kinetic *k = NULL;
        fuzz_source r = {i + 1};
        assert_int_equal(froe_kinetic_new(m, &o, NULL, &k, NULL), FROE_OK);
        assert_int_equal(froe_kinetic_advance(k, 21, NULL, NULL, NULL), FROE_OK);
        list.count = 0;
        assert_int_equal(froe_kinetic_layers(k, take_layer, &list, NULL), FROE_OK);
        column_set_time(&c, m, k, false);
        for (int j = 0; j < 60; j++) {
            double at[3];
            some_point(&r, m, froe_kinetic_time(k), at);
            for (int e = 0; e < 2; e++) at[e] += fuzz_int(&r, 1, 99) * 0.013;
            met += check_layers(&c, m, &list, at);
        }
        froe_kinetic_free(k);
        froe_motion_free(m);
    }
    assert_true(met > 300);
    column_clear(&c);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_against_all),
                                       cmocka_unit_test(test_instants),
                                       cmocka_unit_test(test_up_is_inclined_to_the_left),
                                       cmocka_unit_test(test_refusals),
                                       cmocka_unit_test(points_have_above_and_below_them_what_all_triangles_tell),
                                       cmocka_unit_test(points_on_walls_in_one_plane_are_found),
                                       cmocka_unit_test(layers_are_told_from_below_to_above)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
