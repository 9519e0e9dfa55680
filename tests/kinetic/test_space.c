/* test_space.c: partitions of moving triangles against trees of `cylindrical`, after every event. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "kinetic/moving.h"
#include "kinetic/space.h"
#include "support/memory.h"
#include "support/sanitized.h"
#include <string.h>

enum { SHARE = SANITIZED_SHARE(3) };

static froe_kinetic *start(froe_motion *m, uint64_t seed) {
    froe_kinetic_options o = froe_kinetic_defaults();
    froe_kinetic *k = NULL;
    froe_diagnostic why = {0};
    o.seed = seed;
    if (froe_kinetic_new(m, &o, NULL, &k, &why)) fail_msg("%s", why.message);
    return k;
}

static void follow(froe_kinetic *k, const space_kind *kind, uint64_t seed, uint64_t most, space_counts *counts) {
    froe_diagnostic why = {0};
    if (!space_follow(k, most, counts, &why))
        fail_msg("%s %d at %.17g: %s", kind->name, (int)seed, froe_kinetic_time(k), why.message);
    assert_int_equal(froe_kinetic_statistics(k).stuck, 0);
}

static const space_kind *kind_named(const char *name) {
    for (size_t i = 0; i < SPACE_KINDS; i++)
        if (!strcmp(space_kinds[i].name, name)) return space_kinds + i;
    fail_msg("There is no kind %s.", name);
    return NULL;
}

static void trees_are_those_of_cylindrical_after_every_event(void **state) {
    (void)state;
    space_counts counts = {0};
    for (size_t i = 0; i < SPACE_KINDS; i++)
        for (uint64_t seed = 1; seed <= 1; seed++) {
            const uint64_t before = counts.all;
            froe_motion *m = space_new(space_kinds + i, seed, NULL);
            froe_kinetic *k = start(m, seed);
            follow(k, space_kinds + i, seed, (space_kinds[i].legs ? 240 : 30) / SHARE, &counts);
            if (counts.all == before && space_kinds[i].count > 1) fail_msg("%s: no events", space_kinds[i].name);
            froe_kinetic_free(k);
            froe_motion_free(m);
        }
    if (SANITIZED) return; /* too few events for every kind */
    for (int j = 0; j < FROE_EVENT_TOUCH; j++)
        if (!counts.events[j]) fail_msg("no event of kind %s", froe_event_name((froe_event_kind)j));
    assert_true(counts.all >= 500 && counts.compared >= 500);
}

/* Of a tetrahedron that changes its form a face turns over while another vertex is behind it. Its edges enter cells
 * where the face was not: certificates that were renewed while a part of the tree was old hid that once. */
static void faces_turn_over_into_other_cells(void **state) {
    static const uint64_t missed[] = {1, 2, 3, 5};
    space_counts counts = {0};
    (void)state;
    for (size_t i = 0; i < sizeof missed / sizeof *missed; i++) {
        froe_motion *m = space_new(kind_named("soft"), missed[i], NULL);
        froe_kinetic *k = start(m, missed[i]);
        follow(k, kind_named("soft"), missed[i], 200, &counts);
        froe_kinetic_free(k);
        froe_motion_free(m);
    }
    assert_true(counts.events[FROE_EVENT_FLOP] >= 5);
}

/* In general position there is nothing to fall back to. */
static void nothing_is_made_anew_in_general_position(void **state) {
    static const char *const general[] = {"layers", "small", "swarm", "soft", "still", "curved", "cubics"};
    (void)state;
    for (size_t i = 0; i < sizeof general / sizeof *general; i++) {
        froe_motion *m = space_new(kind_named(general[i]), 9, NULL);
        froe_kinetic *k = start(m, 9);
        assert_int_equal(froe_kinetic_advance(k, SPACE_WINDOW, NULL, NULL, NULL), FROE_OK);
        const froe_kinetic_stats s = froe_kinetic_statistics(k);
        assert_int_equal(s.restarts + s.stuck, 0);
        assert_true(s.surgeries > 20);
        froe_kinetic_free(k);
        froe_motion_free(m);
    }
}

/* An edge turns upright and over in the very tick in which its plans go on, so that no certificate fails, and the tree
 * still has the edge as it was when that tick is handled: all is made anew after it. */
static void edges_may_turn_in_the_tick_in_which_plans_go_on(void **state) {
    static const size_t starts[] = {0, 1, 5, 9, 13, 17, 21};
    static const double times[] = {0,    0, 1.5, 2.3125, 8,      0, 1.5, 2.1875, 8,      0, 1.5625,
                                   2.25, 8, 0,   1.5,    2.3125, 8, 0,   1.5625, 2.1875, 8};
    static const double coords[] = {4, 3, 5,  4, 3, 5,  0, 3, 5, 5, 3, 5,  4, 3, 5,  5, 2, 3,  1, 2, 3,
                                    6, 2, 3,  5, 2, 3,  3, 1, 7, 1, 2, 13, 6, 2, 19, 5, 5, 25, 3, 1, 7,
                                    3, 1, 11, 3, 1, 10, 3, 1, 7, 3, 1, 7,  3, 1, 17, 3, 1, 16, 3, 1, 13};
    froe_motion_options w = froe_motion_defaults();
    froe_moving b = froe_moving_defaults();
    (void)state;
    w.dim = 3, w.begin = 0, w.end = 8, w.tick = 0.25;
    b.vertex_count = 6, b.count = 2, b.starts = starts, b.times = times, b.coords = coords;
    froe_motion *m = batch_motion(&w, &b, NULL);
    for (uint64_t seed = 1; seed <= 6; seed++) {
        froe_kinetic *k = start(m, seed);
        assert_int_equal(froe_kinetic_advance(k, 8, NULL, NULL, NULL), FROE_OK);
        assert_int_equal(froe_kinetic_statistics(k).stuck, 0);
        assert_int_equal(froe_kinetic_audit(k, NULL), FROE_OK);
        froe_kinetic_free(k);
    }
    froe_motion_free(m);
}

/* ------------------------------------------------------------------ certificates -- */

typedef enum lack { LACK_LAYERS, LACK_WALLS, LACK_SIDES, LACK_TURNS, LACKS } lack;

/* Keeps certificates of one kind from ever failing: all but one above and below each end, as if its wall went through
 * one layer; those of regions, of ends, of turns. */
static void weaken(froe_kinetic *k, lack what) {
    cert_table *certs = &k->certs;
    for (uint32_t i = 0; i < certs->all.count; i++) {
        const cert_kind kind = certs->all.data[i].kind;
        const bool hit = (what == LACK_WALLS && kind <= CERT_RIGHT) || (what == LACK_TURNS && kind == CERT_TURN) ||
                         (what == LACK_SIDES && (kind == CERT_ABOVE || kind == CERT_BELOW));
        if (hit) cert_set_tick(certs, i, NOW_NEVER);
    }
    for (size_t i = 0; i < 4 * certs->segments.count && what == LACK_LAYERS; i++) {
        const uint32_t first = certs->segments.data[i / 4].end[i / 2 % 2][i % 2];
        for (uint32_t c = first; c != FROE_NONE; c = certs->all.data[c].next)
            if (c != first) cert_set_tick(certs, c, NOW_NEVER);
    }
}

/* Does the tree go wrong without certificates of a kind, within so many events? */
static bool goes_wrong(const space_kind *kind, uint64_t seed, lack what) {
    froe_motion *m = space_new(kind, seed, NULL);
    froe_kinetic *k = start(m, seed), *fresh = NULL;
    uint32_t found[2] = {0, 0};
    for (int i = 0; i < 300 && !found[0]; i++) {
        weaken(k, what);
        if (!(froe_kinetic_next(k) <= SPACE_WINDOW)) break;
        assert_int_equal(froe_kinetic_advance(k, froe_kinetic_next(k), NULL, NULL, NULL), FROE_OK);
        assert_int_equal(kinetic_copy(k, &fresh, NULL), FROE_OK);
        assert_int_equal(kinetic_compare(k, fresh, false, found), FROE_OK);
        froe_kinetic_free(fresh);
    }
    froe_kinetic_free(k);
    froe_motion_free(m);
    return found[0];
}

static void no_kind_of_certificate_may_be_missing(void **state) {
    (void)state;
    if (SANITIZED) skip(); /* they need not watch what is crippled */
    for (int what = 0; what < LACKS; what++) {
        int wrong = 0;
        for (uint64_t seed = 1; seed <= 4; seed++)
            wrong += goes_wrong(kind_named(seed % 2 ? "layers" : "soft"), seed, (lack)what);
        if (wrong < 2) fail_msg("without certificates of kind %d %d of 4 trees go wrong", what, wrong);
    }
    assert_false(goes_wrong(kind_named("layers"), 1, LACKS) || goes_wrong(kind_named("soft"), 2, LACKS));
}

/* How often a quadratic polynomial a + b s + c s^2 changes its sign within 0 < s < 1, of small whole numbers. */
static int changes_of(double a, double b, double c) {
    const double end = a + b + c, middle = -b / (2 * c), least = a + middle * b / 2;
    if (a * end < 0) return 1;
    return middle > 0 && middle < 1 && a * least < 0 ? 2 : 0;
}

static double area_of(const double p[3][2], const double q[3][2]) {
    return (p[1][0] - p[0][0]) * (q[2][1] - q[0][1]) - (p[1][1] - p[0][1]) * (q[2][0] - q[0][0]);
}

/* How often triangles turn over in all: roots of their areas, which are quadratic polynomials. */
static uint64_t count_flops(const froe_motion *m) {
    uint64_t count = 0;
    for (uint32_t o = 0; o < froe_motion_object_count(m); o++) {
        double p[3][2], q[3][2];
        for (int i = 0; i < 3; i++) {
            double at[3], to[3];
            assert_true(froe_motion_position(m, m->objects.data[o].vertices[i], 0, at));
            assert_true(froe_motion_position(m, m->objects.data[o].vertices[i], SPACE_WINDOW, to));
            for (int j = 0; j < 2; j++) p[i][j] = at[j], q[i][j] = to[j] - at[j];
        }
        count += (uint64_t)changes_of(area_of(p, p), area_of(p, q) + area_of(q, p), area_of(q, q));
    }
    return count;
}

static void triangles_turn_over_as_often_as_their_areas_have_roots(void **state) {
    uint64_t all = 0;
    (void)state;
    for (uint64_t seed = 1; seed <= 8; seed++) {
        froe_motion *m = space_new(kind_named("swarm"), seed, NULL);
        froe_kinetic *k = start(m, seed);
        space_counts counts = {0};
        assert_int_equal(froe_kinetic_advance(k, SPACE_WINDOW, space_count, &counts, NULL), FROE_OK);
        assert_int_equal(counts.events[FROE_EVENT_FLOP], count_flops(m));
        all += counts.events[FROE_EVENT_FLOP];
        froe_kinetic_free(k);
        froe_motion_free(m);
    }
    assert_true(all > 40);
}

/* --------------------------------------------------------------------- invariants -- */

/* Cut out between any two lines and put back, the tree and its certificates are what they were. */
static void slabs_are_put_back_as_they_were(void **state) {
    static const char *const names[] = {"layers", "soft", "boxes", "steep", "fans"};
    (void)state;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        froe_motion *m = space_new(kind_named(names[i]), 4, NULL);
        froe_kinetic *k = start(m, 4);
        fuzz_source r = {i};
        assert_int_equal(froe_kinetic_advance(k, SPACE_WINDOW / 7.0, NULL, NULL, NULL), FROE_OK);
        for (int j = 0; j < 40; j++) {
            froe_diagnostic why = {0};
            k->now.line[0] = fuzz_int(&r, -500, 1500), k->now.line[1] = k->now.line[0] + fuzz_int(&r, 1, 400);
            participants_clear(&k->participants);
            assert_true(surgery_slab(k, ktree_node_at(&k->tree, KTREE_ROOT)->child[0]));
            if (froe_kinetic_audit(k, &why)) fail_msg("%s %d: %s", names[i], j, why.message);
        }
        froe_kinetic_free(k);
        froe_motion_free(m);
    }
}

/* Heights matter only by what is above what: leaned over, the scene has the same tree and the same events. */
static void a_scene_that_leans_has_the_same_tree(void **state) {
    static const char *const names[] = {"layers", "swarm", "sheets", "lattice", "tetrahedra"};
    (void)state;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        space_kind kind = *kind_named(names[i]);
        froe_motion *upright = space_new(&kind, 2, NULL);
        kind.lean = 7;
        froe_motion *leaning = space_new(&kind, 2, NULL);
        froe_kinetic *k = start(upright, 2), *other = start(leaning, 2);
        space_counts counts[2] = {0};
        uint32_t found[2];
        for (int step = 1; step <= 8; step++) {
            const double time = SPACE_WINDOW * step / 8.0;
            assert_int_equal(froe_kinetic_advance(k, time, space_count, counts, NULL), FROE_OK);
            assert_int_equal(froe_kinetic_advance(other, time, space_count, counts + 1, NULL), FROE_OK);
            assert_int_equal(kinetic_compare(k, other, true, found), FROE_OK);
            if (found[0]) fail_msg("%s: another tree", names[i]);
        }
        assert_memory_equal(counts, counts + 1, sizeof *counts);
        froe_kinetic_free(k);
        froe_kinetic_free(other);
        froe_motion_free(upright);
        froe_motion_free(leaning);
    }
}

/* However large or small it is, it has the same tree, certificates and events, and nothing is made anew: doubles decide
 * as much as elsewhere. */
static void a_scene_of_any_size_has_the_same_tree(void **state) {
    static const int scales[] = {-1050, -664, -300, 200, 480, 990};
    space_kind kind = *kind_named("small");
    kind.count /= 2;
    froe_motion *m = space_new(&kind, 2, NULL);
    froe_kinetic *k = start(m, 2);
    space_counts counts = {0};
    (void)state;
    assert_int_equal(froe_kinetic_advance(k, SPACE_WINDOW, space_count, &counts, NULL), FROE_OK);
    assert_true(counts.all > 10);
    for (size_t i = 0; i < sizeof scales / sizeof *scales; i++) {
        kind.scale = scales[i];
        froe_motion *scaled = space_new(&kind, 2, NULL);
        froe_kinetic *other = start(scaled, 2);
        space_counts again = {0};
        uint32_t found[2];
        assert_int_equal(froe_kinetic_advance(other, SPACE_WINDOW, space_count, &again, NULL), FROE_OK);
        assert_memory_equal(&counts, &again, sizeof counts);
        assert_int_equal(kinetic_compare(k, other, true, found), FROE_OK);
        if (found[0]) fail_msg("times 2^%d: another tree", scales[i]);
        const froe_kinetic_stats s = froe_kinetic_statistics(k), t = froe_kinetic_statistics(other);
        assert_int_equal(t.restarts, 0);
        assert_int_equal(t.crowds, s.crowds);
        froe_kinetic_free(other);
        froe_motion_free(scaled);
    }
    froe_kinetic_free(k);
    froe_motion_free(m);
}

/* ---------------------------------------------------------------------- relations -- */

/* The same motion with other vertices: from each knot. */
typedef void remake_fn(void *user, double at[3]);

static froe_motion *remade(const froe_motion *m, remake_fn *remake, void *user, bool backwards) {
    space_data *d = calloc(1, sizeof *d);
    froe_moving b = froe_moving_defaults();
    const froe_motion_options w = froe_motion_window(m);
    assert_non_null(d);
    b.vertex_count = froe_motion_vertex_count(m), b.count = froe_motion_object_count(m);
    for (uint32_t v = 0; v < b.vertex_count; v++) {
        d->starts[v + 1] = d->starts[v] + froe_motion_knot_count(m, v);
        for (size_t i = 0; i < d->starts[v + 1] - d->starts[v]; i++) {
            froe_moving_knot knot = froe_motion_knot(m, v, i);
            remake(user, knot.at);
            d->times[d->starts[v] + i] = knot.time;
            memcpy(d->coords + 3 * (d->starts[v] + i), knot.at, sizeof knot.at);
        }
    }
    for (uint32_t o = 0; o < b.count; o++) {
        const froe_moving_object object = froe_motion_object(m, o);
        memcpy(d->vertices + 3 * (backwards ? b.count - 1 - o : o), object.vertices, sizeof object.vertices);
    }
    b.starts = d->starts, b.times = d->times, b.coords = d->coords, b.vertices = d->vertices;
    froe_motion *out = batch_motion(&w, &b, NULL);
    free(d);
    return out;
}

static void mirror(void *user, double at[3]) {
    const int *axis = user;
    if (*axis < 3) at[*axis] = -at[*axis];
}

/* Mirrored along an axis, or with its triangles numbered from behind and cutting in the order in which they did, a
 * scene has the same turns and triple crossings, and a tree of the same form. */
static void mirrored_or_renumbered_scenes_have_trees_alike(void **state) {
    static const char *const names[] = {"layers", "small", "swarm", "rigid", "still"};
    (void)state;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        froe_motion *m = space_new(kind_named(names[i]), 6, NULL);
        const uint32_t n = (uint32_t)froe_motion_object_count(m);
        uint32_t order[2][SPACE_MOST];
        for (uint32_t o = 0; o < n; o++) order[0][o] = (o * 7 + 3) % n;
        if (n % 7 == 0) fail_msg("%s: no order", names[i]);
        for (uint32_t o = 0; o < n; o++) order[1][o] = n - 1 - order[0][o];
        space_counts counts[5] = {0};
        froe_kinetic_stats stats[5];
        for (int change = 0; change < 5; change++) { /* an axis, a number from behind, nothing */
            int axis = change;
            froe_motion *other = remade(m, mirror, &axis, change == 3);
            froe_kinetic_options o = froe_kinetic_defaults();
            froe_kinetic *k = NULL;
            o.order = order[change == 3];
            assert_int_equal(froe_kinetic_new(other, &o, NULL, &k, NULL), FROE_OK);
            assert_int_equal(froe_kinetic_advance(k, 40, space_count, counts + change, NULL), FROE_OK);
            stats[change] = froe_kinetic_statistics(k);
            froe_kinetic_free(k);
            froe_motion_free(other);
        }
        assert_true(counts[4].all > 20);
        for (int change = 0; change < 4; change++) {
            for (int kind = FROE_EVENT_TRIPLE; kind < FROE_EVENT_KINDS; kind++) /* others may be told as one batch */
                if (kind != FROE_EVENT_BATCH) assert_int_equal(counts[change].events[kind], counts[4].events[kind]);
            assert_int_equal(stats[change].nodes, stats[4].nodes);
            assert_int_equal(stats[change].certificates, stats[4].certificates);
            assert_int_equal(stats[change].height, stats[4].height);
        }
        froe_motion_free(m);
    }
}

/* Segments of the plane as walls: triangles that stand on them, the third corner straight above the first, each in a
 * layer of its own. */
static froe_motion *walls_on(const froe_motion *plane) {
    space_data *d = calloc(1, sizeof *d);
    froe_moving b = froe_moving_defaults();
    froe_motion_options w = froe_motion_window(plane);
    assert_non_null(d);
    b.count = froe_motion_object_count(plane), b.vertex_count = 3 * b.count;
    assert_true(b.count <= SPACE_MOST);
    for (size_t v = 0; v < b.vertex_count; v++) {
        const uint32_t from = froe_motion_object(plane, (uint32_t)(v / 3)).vertices[v % 3 % 2];
        const size_t count = froe_motion_knot_count(plane, from);
        d->starts[v + 1] = d->starts[v] + count;
        for (size_t i = 0; i < count; i++) {
            const froe_moving_knot knot = froe_motion_knot(plane, from, i);
            double *at = d->coords + 3 * (d->starts[v] + i), *control = d->controls + 3 * (d->starts[v] + i);
            double *second = d->seconds + 3 * (d->starts[v] + i);
            d->times[d->starts[v] + i] = knot.time;
            for (int k = 0; k < 2; k++) at[k] = knot.at[k], control[k] = knot.control[k], second[k] = knot.second[k];
            at[2] = (double)(2 * (v / 3) + (v % 3 == 2));
            control[2] = isnan(control[0]) ? control[0] : at[2];
            second[2] = isnan(second[0]) ? second[0] : at[2];
        }
    }
    w.dim = 3;
    b.starts = d->starts, b.times = d->times, b.coords = d->coords, b.controls = d->controls;
    b.second_controls = d->seconds;
    froe_motion *out = batch_motion(&w, &b, NULL);
    free(d);
    return out;
}

static uint32_t shadow_of(const froe_kinetic *space, uint32_t wall) {
    return wall >= KTREE_END_1 ? wall : now_object_of(&space->now, wall);
}

static bool are_shadows(const froe_kinetic *plane, const froe_kinetic *space) {
    static uint32_t stack[1 << 16][2];
    size_t top = 0;
    stack[top][0] = ktree_node_at(&plane->tree, KTREE_ROOT)->child[0];
    stack[top++][1] = ktree_node_at(&space->tree, KTREE_ROOT)->child[0];
    while (top) {
        const uint32_t *pair = stack[--top];
        const ktree_node *p = ktree_node_at(&plane->tree, pair[0]), *q = ktree_node_at(&space->tree, pair[1]);
        if (!pair[0] != !pair[1]) return false;
        if (!pair[0]) continue;
        if (p->segment != now_object_of(&space->now, q->segment) || now_is_surface(&space->now, q->segment))
            return false;
        for (int i = 0; i < 2; i++)
            if (p->wall[i] != shadow_of(space, q->wall[i])) return false;
        assert_true(top + 4 <= sizeof stack / sizeof *stack);
        for (int i = 0; i < 4; i++) stack[top][0] = p->child[i], stack[top++][1] = q->child[i];
    }
    return true;
}

/* A partition of walls is that of the segments they stand on, node for node. */
static void walls_have_the_tree_of_the_segments_below_them(void **state) {
    static const char *const kinds[] = {"random", "parabolas", "lattice 40", "rigid", "cubics", "all degrees"};
    (void)state;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        froe_motion *plane = moving_new(moving_kind_named(kinds[i]), 4, NULL), *walls = walls_on(plane);
        const uint32_t n = (uint32_t)froe_motion_object_count(plane);
        uint32_t order[SPACE_MOST];
        for (uint32_t o = 0; o < n; o++) order[o] = n - 1 - o;
        froe_kinetic_options o = froe_kinetic_defaults();
        froe_kinetic *k = NULL, *shadow = NULL;
        o.order = order;
        assert_int_equal(froe_kinetic_new(plane, &o, NULL, &shadow, NULL), FROE_OK);
        assert_int_equal(froe_kinetic_new(walls, &o, NULL, &k, NULL), FROE_OK);
        for (int step = 0; step < 60; step++) {
            const double next = froe_kinetic_next(shadow);
            if (!(next <= MOVING_TIME)) break;
            assert_int_equal(froe_kinetic_advance(shadow, next, NULL, NULL, NULL), FROE_OK);
            assert_int_equal(froe_kinetic_advance(k, next, NULL, NULL, NULL), FROE_OK);
            if (!are_shadows(shadow, k)) fail_msg("%s at %.17g: another tree", kinds[i], next);
        }
        froe_kinetic_free(k), froe_kinetic_free(shadow);
        froe_motion_free(walls), froe_motion_free(plane);
    }
}

/* ----------------------------------------------------------------------- changes -- */

/* A triangle in a layer of its own above all others, on a lattice. */
static void add_one(froe_motion *m, fuzz_source *r, int grid, double now) {
    static int layer = 1000;
    const double z = 2.0 * grid * ++layer;
    const size_t starts[4] = {0, 2, 4, 6};
    double times[6], coords[18];
    for (size_t i = 0; i < 6; i++) {
        times[i] = i % 2 ? SPACE_WINDOW : now;
        for (size_t k = 0; k < 3; k++) coords[3 * i + k] = k == 2 ? z : fuzz_int(r, 0, grid);
    }
    froe_moving b = froe_moving_defaults();
    b.vertex_count = 3, b.count = 1, b.starts = starts, b.times = times, b.coords = coords, b.births = &now;
    assert_int_equal(froe_motion_add(m, &b, NULL), FROE_OK);
}

/* Another way for a vertex, from where it is or, at the same height, from elsewhere. */
static void send_elsewhere(froe_kinetic *k, froe_motion *m, fuzz_source *r, int grid) {
    const uint32_t vertex = (uint32_t)fuzz_int(r, 0, (int)froe_motion_vertex_count(m) - 1);
    const double now = froe_kinetic_time(k), times[2] = {now, SPACE_WINDOW};
    double coords[6];
    assert_true(froe_motion_position(m, vertex, now, coords));
    for (int i = fuzz_int(r, 0, 1) ? 0 : 3; i < 6; i++) coords[i] = i % 3 == 2 ? coords[2] : fuzz_int(r, 0, grid);
    froe_diagnostic why = {0};
    if (froe_kinetic_replan(k, vertex, 2, times, coords, NULL, NULL, &why)) fail_msg("%s", why.message);
}

/* Of solids faces only go, as they would cross each other on other ways. */
static void change(froe_kinetic *k, froe_motion *m, fuzz_source *r, int grid, bool solid) {
    const int what = solid ? 1 : fuzz_int(r, 0, 3);
    if (what == 0) {
        add_one(m, r, grid, froe_kinetic_time(k));
        assert_int_equal(froe_kinetic_update(k, NULL), FROE_OK);
    } else if (what == 1) {
        const int object = fuzz_int(r, 0, (int)froe_motion_object_count(m) - 1);
        assert_int_equal(froe_kinetic_remove(k, (uint32_t)object, NULL), FROE_OK);
    } else {
        send_elsewhere(k, m, r, grid);
    }
}

static void triangles_come_and_go_and_take_other_ways(void **state) {
    static const space_kind kinds[] = {
        {.name = "lattice", .form = SPACE_LAYERS, .count = 14, .grid = 12, .reach = 5, .speed = 4, .spin = 2},
        {.name = "layers", .form = SPACE_LAYERS, .count = 14, .grid = 1000, .reach = 300, .speed = 300, .spin = 9},
        {.name = "solids", .form = SPACE_TETRAHEDRA, .count = 40, .grid = 1000, .reach = 300, .speed = 500}};
    space_counts counts = {0};
    froe_diagnostic why = {0};
    (void)state;
    for (size_t i = 0; i < 6; i++) { /* on the lattice much coincides at the tick itself, and not just after it */
        const space_kind *kind = kinds + i % 3;
        fuzz_source r = {i + 1};
        froe_motion *m = space_new(kind, i + 1, NULL);
        froe_kinetic *k = start(m, i + 1);
        for (int step = 1; step < 30; step++) {
            for (int j = fuzz_int(&r, 0, 2); j > 0; j--) {
                change(k, m, &r, kind->grid, kind->form == SPACE_TETRAHEDRA);
                if ((i % 3 && !space_is_alike(k, &counts, &why)) || froe_kinetic_audit(k, &why))
                    fail_msg("%s %d step %d: %s", kind->name, (int)i, step, why.message);
            }
            double next = froe_kinetic_next(k);
            if (fuzz_int(&r, 0, 1) || !(next < SPACE_WINDOW)) next = SPACE_WINDOW * step / 30.0;
            if (next > froe_kinetic_time(k))
                assert_int_equal(froe_kinetic_advance(k, next, space_count, &counts, NULL), FROE_OK);
            if ((i % 3 && !space_is_alike(k, &counts, &why)) || froe_kinetic_audit(k, &why))
                fail_msg("%s %d at %g: %s", kind->name, (int)i, froe_kinetic_time(k), why.message);
        }
        froe_kinetic_free(k);
        froe_motion_free(m);
    }
    assert_true(counts.all > 100);
}

/* There and back again: at tick t and at the last but t all is in the same places, and so the tree is the same. */
static void back_again_the_tree_is_the_first(void **state) {
    static const char *const names[] = {"layers", "swarm", "sheets", "lattice"};
    (void)state;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        space_kind kind = *kind_named(names[i]);
        kind.legs = 2;
        froe_motion *m = space_new(&kind, 3, NULL);
        froe_kinetic *k = start(m, 3), *first = start(m, 3);
        uint32_t found[2];
        assert_int_equal(froe_kinetic_advance(first, SPACE_WINDOW / 5.0, NULL, NULL, NULL), FROE_OK);
        const double back = SPACE_WINDOW - froe_kinetic_time(first);
        assert_int_equal(froe_kinetic_advance(k, back, NULL, NULL, NULL), FROE_OK);
        assert_true(froe_kinetic_time(k) == back);
        assert_int_equal(kinetic_compare(k, first, false, found), FROE_OK);
        if (found[0]) fail_msg("%s: another tree", names[i]);
        froe_kinetic_free(k);
        froe_kinetic_free(first);
        froe_motion_free(m);
    }
}

/* What enters and leaves leaves nothing behind. */
static void a_triangle_that_leaves_leaves_the_tree_as_it_was(void **state) {
    froe_motion *m = space_new(kind_named("small"), 5, NULL);
    froe_kinetic *k = start(m, 5), *before = NULL;
    fuzz_source r = {1};
    uint32_t found[2];
    (void)state;
    assert_int_equal(froe_kinetic_advance(k, SPACE_WINDOW / 3.0, NULL, NULL, NULL), FROE_OK);
    for (int i = 0; i < 20; i++) {
        assert_int_equal(kinetic_copy(k, &before, NULL), FROE_OK);
        add_one(m, &r, 1000, froe_kinetic_time(k));
        assert_int_equal(froe_kinetic_update(k, NULL), FROE_OK);
        assert_int_equal(kinetic_compare(k, before, false, found), FROE_OK);
        assert_true(found[0]);
        const uint32_t last = (uint32_t)froe_motion_object_count(m) - 1;
        assert_int_equal(froe_kinetic_remove(k, last, NULL), FROE_OK);
        assert_int_equal(kinetic_compare(k, before, false, found), FROE_OK);
        assert_false(found[0]);
        froe_kinetic_free(before);
    }
    froe_kinetic_free(k);
    froe_motion_free(m);
}

/* ----------------------------------------------------------------------- contacts -- */

/* Two leaves, the second of which goes from a height to another, through the first or just so far as to touch it. */
static froe_motion *falling(double from, double to) {
    static const double plan[3][2] = {{0, 0}, {9, 0}, {0, 9}}, small[3][2] = {{1, 1}, {3, 1.5}, {1.5, 3}};
    static const size_t starts[] = {0, 2, 4, 6, 8, 10, 12};
    double times[12], coords[36];
    for (size_t i = 0; i < 12; i++) {
        const double *at = i < 6 ? plan[i / 2] : small[i / 2 - 3];
        const double z = i < 6 ? 0 : (i % 2 ? to : from) + (i / 2 == 3 ? 0 : 1);
        times[i] = i % 2 ? 8 : 0;
        coords[3 * i] = at[0] + (i % 2 ? 0.125 : 0), coords[3 * i + 1] = at[1], coords[3 * i + 2] = z;
    }
    froe_motion_options w = froe_motion_defaults();
    froe_moving b = froe_moving_defaults();
    froe_motion *m = NULL;
    w.dim = 3, w.begin = 0, w.end = 8, w.tick = 0x1p-16;
    b.vertex_count = 6, b.count = 2, b.starts = starts, b.times = times, b.coords = coords;
    assert_int_equal(froe_motion_new(&w, NULL, &m, NULL), FROE_OK);
    assert_int_equal(froe_motion_add(m, &b, NULL), FROE_OK);
    return m;
}

static void a_partition_ends_before_the_first_contact(void **state) {
    static const double ways[3][3] = {{3, -3, 4}, {3, -5, 3}, {1, -7, 1}}; /* from, to, and when they meet */
    space_counts counts = {0};
    froe_diagnostic why = {0};
    (void)state;
    for (size_t i = 0; i < 3; i++) {
        froe_motion *m = falling(ways[i][0], ways[i][1]);
        froe_kinetic *k = start(m, i + 1);
        assert_int_equal(froe_kinetic_advance(k, 8, space_count, &counts, &why), FROE_E_INPUT);
        assert_non_null(strstr(why.message, "Triangles 0 and 1 meet between"));
        assert_int_equal(counts.events[FROE_EVENT_TOUCH], i + 1);
        const double time = froe_kinetic_time(k);
        assert_true(time < ways[i][2] && time > ways[i][2] - 0x1p-14);
        if (!space_is_alike(k, &counts, &why) || froe_kinetic_audit(k, &why)) fail_msg("%s", why.message);
        assert_int_equal(froe_kinetic_advance(k, 8, NULL, NULL, NULL), FROE_E_INPUT); /* and stays there */
        assert_true(froe_kinetic_time(k) == time);
        assert_int_equal(froe_kinetic_remove(k, 0, NULL), FROE_OK); /* nothing is in the way any more */
        assert_int_equal(froe_kinetic_advance(k, 8, NULL, NULL, NULL), FROE_OK);
        assert_int_equal(froe_kinetic_audit(k, NULL), FROE_OK);
        froe_kinetic_free(k);
        froe_motion_free(m);
    }
}

typedef struct touch_time {
    froe_kinetic *partition;
    double early, late, instant[2];
    froe_status status;
} touch_time;

static bool ask_for_instant(void *user, const froe_event *event) {
    touch_time *t = user;
    if (event->kind != FROE_EVENT_TOUCH) return true;
    t->early = event->early, t->late = event->late;
    t->status = froe_kinetic_instant(t->partition, t->instant, NULL);
    return true;
}

static void a_visitor_may_ask_when_the_first_contact_begins(void **state) {
    froe_motion *m = falling(3, -5); /* they meet at 3 */
    touch_time t = {.partition = start(m, 1), .status = FROE_E_CANCELLED};
    (void)state;
    assert_int_equal(froe_kinetic_advance(t.partition, 8, ask_for_instant, &t, NULL), FROE_E_INPUT);
    assert_int_equal(t.status, FROE_OK);
    assert_true(t.instant[0] == t.early && t.instant[1] == t.late && t.early <= 3 && t.late >= 3);
    assert_int_equal(froe_kinetic_instant(t.partition, t.instant, NULL), FROE_E_ARG); /* it is over */
    froe_kinetic_free(t.partition);
    froe_motion_free(m);
}

static void a_partition_of_no_triangles_lasts(void **state) {
    froe_motion_options w = froe_motion_defaults();
    froe_motion *m = NULL;
    (void)state;
    w.dim = 3, w.begin = 0, w.end = 8;
    assert_int_equal(froe_motion_new(&w, NULL, &m, NULL), FROE_OK);
    froe_kinetic *k = start(m, 1);
    assert_int_equal(froe_kinetic_advance(k, 8, NULL, NULL, NULL), FROE_OK);
    assert_true(froe_kinetic_next(k) == (double)INFINITY);
    assert_int_equal(froe_kinetic_audit(k, NULL), FROE_OK);
    froe_snapshot now = {0};
    const froe_snapshot_options o = froe_snapshot_defaults();
    assert_int_equal(froe_kinetic_snapshot(k, &o, &now, NULL), FROE_OK);
    assert_true(now.alike && !now.rounded);
    froe_tree_free(now.tree);
    froe_kinetic_free(k);
    froe_motion_free(m);
}

static void another_way_leads_past_a_contact(void **state) {
    const double times[2] = {1, 8}, coords[6] = {1.015625, 1, 2.25, 1.125, 1, 9};
    froe_motion *m = falling(3, -3);
    froe_kinetic *k = start(m, 1);
    (void)state;
    assert_int_equal(froe_kinetic_advance(k, 1, NULL, NULL, NULL), FROE_OK);
    assert_int_equal(froe_kinetic_replan(k, 3, 2, times, coords, NULL, NULL, NULL), FROE_OK);
    assert_int_equal(froe_kinetic_advance(k, 5, NULL, NULL, NULL), FROE_OK); /* the other corners come later */
    assert_int_equal(froe_kinetic_audit(k, NULL), FROE_OK);
    assert_int_equal(froe_kinetic_advance(k, 8, NULL, NULL, NULL), FROE_E_INPUT);
    froe_kinetic_free(k);
    froe_motion_free(m);
}

static void what_meets_at_the_start_is_refused_unless_unchecked(void **state) {
    froe_motion *m = falling(-0.5, 1);
    froe_kinetic_options o = froe_kinetic_defaults();
    froe_kinetic *k = NULL;
    froe_diagnostic why = {0};
    (void)state;
    assert_int_equal(froe_kinetic_new(m, &o, NULL, &k, &why), FROE_E_INPUT);
    assert_null(k);
    assert_non_null(strstr(why.message, "Triangles 0 and 1 meet between"));
    o.unchecked = true;
    assert_int_equal(froe_kinetic_new(m, &o, NULL, &k, NULL), FROE_OK);
    assert_int_equal(froe_kinetic_advance(k, 8, NULL, NULL, NULL), FROE_OK);
    froe_kinetic_free(k);
    froe_motion_free(m);
}

static froe_status with_memory(void *user, const froe_allocator *alloc) {
    froe_kinetic *k = NULL;
    froe_snapshot s = {0};
    froe_kinetic_options o = froe_kinetic_defaults();
    froe_status status = froe_kinetic_new(user, &o, alloc, &k, NULL);
    if (status) return status;
    status = froe_kinetic_advance(k, SPACE_WINDOW / 3.0, NULL, NULL, NULL);
    if (!status) status = froe_kinetic_snapshot(k, NULL, &s, NULL);
    if (!status) status = froe_kinetic_audit(k, NULL);
    froe_tree_free(s.tree);
    froe_kinetic_free(k);
    return status;
}

static void memory_may_run_out(void **state) {
    static const space_kind few[] = {
        {.form = SPACE_TETRAHEDRA, .count = 8, .grid = 900, .reach = 250, .speed = 600, .spin = 40},
        {.form = SPACE_LAYERS, .count = 4, .grid = 900, .reach = 300, .speed = 300, .mortal = true, .legs = 2}};
    (void)state;
    for (size_t i = 0; i < sizeof few / sizeof *few; i++) {
        froe_motion *m = space_new(few + i, 2, NULL);
        test_memory_each(with_memory, m);
        froe_motion_free(m);
    }
}

static froe_motion *flying_body(void) {
    static const double times[] = {0, 1}, centres[] = {0, 0, 0, 9, 0, 0}, turns[] = {0, 0, 0, 1, 0, 0, 0, 1};
    static const double corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0}, always[] = {0, 0, 0};
    static const size_t starts[] = {0, 1, 2, 3};
    static const uint32_t of[] = {0, 0, 0};
    uint32_t id;
    froe_motion_options w = froe_motion_defaults();
    froe_motion *m = NULL;
    w.dim = 3, w.begin = 0, w.end = 1;
    froe_body body = froe_body_defaults();
    body.count = 2, body.times = times, body.coords = centres, body.turns = turns;
    froe_moving b = froe_moving_defaults();
    b.vertex_count = 3, b.count = 1, b.starts = starts, b.times = always, b.coords = corners;
    b.bodies = of;
    assert_int_equal(froe_motion_new(&w, NULL, &m, NULL), FROE_OK);
    assert_int_equal(froe_motion_add_body(m, &body, &id, NULL), FROE_OK);
    assert_int_equal(froe_motion_add(m, &b, NULL), FROE_OK);
    return m;
}

static void what_is_not_there_is_refused(void **state) {
    const double at[3] = {0, 0, 0};
    froe_motion *m = space_new(kind_named("small"), 1, NULL);
    froe_kinetic *k = start(m, 1), *none = NULL;
    froe_kinetic_place place;
    uint32_t hit;
    froe_kinetic_options o = froe_kinetic_defaults();
    (void)state;
    assert_int_equal(froe_kinetic_locate(k, at, &place, NULL), FROE_E_UNSUPPORTED);
    assert_int_equal(froe_kinetic_ray(k, at, at, &hit, NULL), FROE_E_UNSUPPORTED);
    assert_int_equal(froe_kinetic_locate_in_space(k, (double[]){0, NAN, 0}, &place, NULL), FROE_E_ARG);
    assert_int_equal(froe_kinetic_locate_in_space(k, at, NULL, NULL), FROE_E_ARG);
    assert_int_equal(froe_kinetic_layers(k, NULL, NULL, NULL), FROE_E_ARG);
    froe_snapshot now = {0};
    froe_snapshot_options up = froe_snapshot_defaults();
    up.up = 3;
    assert_int_equal(froe_kinetic_snapshot(k, &up, &now, NULL), FROE_E_OPTIONS);
    assert_null(now.tree);
    up.up = 1;
    assert_int_equal(froe_kinetic_snapshot(k, &up, &now, NULL), FROE_OK);
    assert_int_equal(froe_scene_up(froe_tree_scene(now.tree)), 1);
    froe_tree_free(now.tree);
    o.augmented = true;
    assert_int_equal(froe_kinetic_new(m, &o, NULL, &none, NULL), FROE_E_UNSUPPORTED);
    assert_null(none);
    o.augmented = false, o.swap = 1;
    assert_int_equal(froe_kinetic_new(m, &o, NULL, &none, NULL), FROE_E_UNSUPPORTED);
    assert_null(none);
    o.swap = 0;
    froe_motion *bodies = flying_body();
    assert_int_equal(froe_kinetic_new(bodies, &o, NULL, &none, NULL), FROE_E_UNSUPPORTED);
    assert_null(none);
    froe_motion_free(bodies);
    froe_kinetic_free(k);
    froe_motion_free(m);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(trees_are_those_of_cylindrical_after_every_event),
        cmocka_unit_test(faces_turn_over_into_other_cells),
        cmocka_unit_test(nothing_is_made_anew_in_general_position),
        cmocka_unit_test(edges_may_turn_in_the_tick_in_which_plans_go_on),
        cmocka_unit_test(no_kind_of_certificate_may_be_missing),
        cmocka_unit_test(triangles_turn_over_as_often_as_their_areas_have_roots),
        cmocka_unit_test(slabs_are_put_back_as_they_were),
        cmocka_unit_test(a_scene_that_leans_has_the_same_tree),
        cmocka_unit_test(a_scene_of_any_size_has_the_same_tree),
        cmocka_unit_test(mirrored_or_renumbered_scenes_have_trees_alike),
        cmocka_unit_test(walls_have_the_tree_of_the_segments_below_them),
        cmocka_unit_test(triangles_come_and_go_and_take_other_ways),
        cmocka_unit_test(back_again_the_tree_is_the_first),
        cmocka_unit_test(a_triangle_that_leaves_leaves_the_tree_as_it_was),
        cmocka_unit_test(a_partition_ends_before_the_first_contact),
        cmocka_unit_test(a_visitor_may_ask_when_the_first_contact_begins),
        cmocka_unit_test(a_partition_of_no_triangles_lasts),
        cmocka_unit_test(another_way_leads_past_a_contact),
        cmocka_unit_test(what_meets_at_the_start_is_refused_unless_unchecked),
        cmocka_unit_test(memory_may_run_out),
        cmocka_unit_test(what_is_not_there_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
