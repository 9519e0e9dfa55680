/* test_neighbours.c: triangles that share vertices, and when they meet elsewhere: against all basic solutions of linear
 * programs in rationals, by known cases, and as what ends a partition in space. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "kinetic/kinetic.h"
#include "oracle/touching.h"
#include "support/batch.h"
#include "support/found.h"
#include "support/fuzz.h"
#include "support/memory.h"
#include "support/sanitized.h"
#include <math.h>
#include <string.h>

enum { SHARE = SANITIZED_SHARE(3), WINDOW = 8, VERTICES = 7, FACES = 5, KNOTS = 3 };

/* --------------------------------------------------------------- made-up scenes -- */

typedef enum scene_kind {
    RANDOM,
    LATTICE, /* small whole numbers */
    CURVED,  /* the same on parabolas and cubics */
    STILL,   /* the same, and most vertices do not move */
    SLIDING, /* all in one plane */
    LINED,   /* all in one line */
    UPRIGHT, /* vertices above one another, moving along axes */
    SCENES
} scene_kind;

typedef struct scene {
    size_t starts[VERTICES + 1];
    double times[VERTICES * KNOTS], at[3 * VERTICES * KNOTS], controls[3 * VERTICES * KNOTS];
    double seconds[3 * VERTICES * KNOTS];
    uint32_t faces[3 * FACES];
} scene;

static void place(fuzz_source *r, scene_kind kind, double out[3]) {
    for (int k = 0; k < 3; k++) out[k] = kind == RANDOM ? fuzz_int(r, -64, 64) * 0x1p-6 : fuzz_int(r, 0, 3);
    if (kind == SLIDING) out[2] = out[0] + 2 * out[1];
    if (kind == LINED) out[1] = 2 * out[0], out[2] = 1 - out[0];
    if (kind == UPRIGHT) out[1] = floor(out[1] / 2);
}

static froe_moving make(fuzz_source *r, scene_kind kind, scene *s) {
    size_t n = 0;
    for (size_t v = 0; v < VERTICES; v++) {
        s->starts[v] = n;
        const size_t count = kind == STILL && fuzz_int(r, 0, 2) ? 1 : (size_t)fuzz_int(r, 2, KNOTS);
        for (size_t i = 0; i < count; i++, n++) {
            s->times[n] = i + 1 == count ? (i ? WINDOW : 0) : i ? fuzz_int(r, 1, 7) : 0;
            place(r, kind, s->at + 3 * n);
            if (kind == UPRIGHT && i) { /* along one axis */
                const int axis = fuzz_int(r, 0, 2);
                for (int k = 0; k < 3; k++)
                    if (k != axis) s->at[3 * n + (size_t)k] = s->at[3 * n - 3 + (size_t)k];
            }
            for (size_t k = 0; k < 3; k++) s->controls[3 * n + k] = s->seconds[3 * n + k] = NAN;
            const int degree = kind == CURVED ? fuzz_int(r, 1, 3) : 1;
            if (degree > 1) place(r, kind, s->controls + 3 * n);
            if (degree > 2) place(r, kind, s->seconds + 3 * n);
        }
    }
    s->starts[VERTICES] = n;
    for (size_t j = 0; j < FACES; j++)
        for (size_t i = 0; i < 3; i++) {
            uint32_t *f = s->faces + 3 * j;
            do f[i] = (uint32_t)fuzz_int(r, 0, VERTICES - 1);
            while ((i && f[i] == f[0]) || (i > 1 && f[i] == f[1]));
        }
    froe_moving b = froe_moving_defaults();
    b.vertex_count = VERTICES, b.count = FACES, b.starts = s->starts, b.times = s->times, b.coords = s->at;
    b.controls = s->controls, b.second_controls = s->seconds, b.vertices = s->faces;
    return b;
}

static froe_motion *motion_of(const froe_moving *batch, double tick) {
    froe_motion_options o = froe_motion_defaults();
    o.dim = 3, o.begin = 0, o.end = WINDOW, o.tick = tick;
    return batch_motion(&o, batch, NULL);
}

static const froe_contact *found_neighbours(const froe_motion *m, found *f) {
    froe_contact_options o = froe_contact_defaults();
    o.neighbours = true, o.threads = 2;
    found_in(m, &o, f);
    return f->list;
}

/* ----------------------------------------------------------- against the oracle -- */

typedef struct tally {
    int contacts, instants, asked, met;
} tally;

static int shared_vertices(const froe_motion *m, uint32_t a, uint32_t b) {
    const froe_moving_object p = froe_motion_object(m, a), q = froe_motion_object(m, b);
    int count = 0;
    for (int i = 0; i < 9; i++) count += p.vertices[i / 3] == q.vertices[i % 3];
    return count;
}

/* At an instant, or within an instant of it: contacts are closed. */
static bool meet_about(const froe_motion *m, uint32_t a, uint32_t b, const mpq_t time) {
    mpq_t near;
    bool meet = oracle_neighbours_meet(m, a, b, time);
    mpq_init(near);
    for (int way = -1; way <= 1 && !meet; way += 2) {
        mpq_set_si(near, way, 1);
        mpq_div_2exp(near, near, 70);
        mpq_add(near, near, time);
        if (oracle_compare_time(near, 0) >= 0 && oracle_compare_time(near, WINDOW) <= 0)
            meet = oracle_neighbours_meet(m, a, b, near);
    }
    mpq_clear(near);
    return meet;
}

/* 1: they meet according to the list, 0: they do not, -1: it is about then that this changes. */
static int told_at(const found *f, uint32_t a, uint32_t b, const mpq_t time) {
    int told = 0;
    for (size_t i = 0; i < f->count; i++) {
        const froe_contact *c = &f->list[i];
        if (c->a != a || c->b != b) continue;
        if (oracle_compare_time(time, c->begin[0]) < 0 || oracle_compare_time(time, c->end[1]) > 0) continue;
        const bool within = oracle_compare_time(time, c->begin[1]) >= 0 && oracle_compare_time(time, c->end[0]) <= 0;
        told = within ? 1 : told ? told : -1;
    }
    return told;
}

static void check_time(const froe_motion *m, const found *f, uint32_t a, uint32_t b, const mpq_t time, tally *t) {
    const int told = told_at(f, a, b, time);
    if (told < 0) return;
    const bool meet = told ? meet_about(m, a, b, time) : oracle_neighbours_meet(m, a, b, time);
    t->asked++, t->met += meet;
    if (meet != told)
        fail_msg("triangles %u and %u with %d common vertices: %d at %.17g, told %d", a, b, shared_vertices(m, a, b),
                 meet, mpq_get_d(time), told);
}

/* Lasting contacts go on between their ends, and there is nothing just before their beginnings and after their ends. */
static void check_ends(const froe_motion *m, const found *f, const froe_contact *c, tally *t) {
    mpq_t time;
    mpq_init(time);
    for (int i = 0; i < 4; i++) {
        mpq_set_d(time, i < 2 ? c->begin[i] : c->end[i - 2]);
        check_time(m, f, c->a, c->b, time, t);
    }
    for (int i = 1; i < 4 && c->begin[1] < c->end[0]; i++) {
        mpq_set_d(time, c->begin[1] + i * 0.25 * (c->end[0] - c->begin[1]));
        check_time(m, f, c->a, c->b, time, t);
    }
    mpq_set_d(time, nextafter(c->begin[0], -1));
    if (c->begin[0] > 0) check_time(m, f, c->a, c->b, time, t);
    mpq_set_d(time, nextafter(c->end[1], WINDOW + 1));
    if (c->end[1] < WINDOW) check_time(m, f, c->a, c->b, time, t);
    mpq_clear(time);
}

static void check_motion(const froe_motion *m, tally tallies[4]) {
    static found f;
    found_neighbours(m, &f);
    mpq_t time;
    mpq_init(time);
    for (size_t i = 0; i < f.count; i++) {
        const froe_contact *c = &f.list[i];
        const int shared = shared_vertices(m, c->a, c->b);
        if (!shared) continue;
        tallies[shared].contacts++, tallies[shared].instants += c->instant;
        check_ends(m, &f, c, tallies + shared);
    }
    for (uint32_t a = 0; a < FACES; a++)
        for (uint32_t b = a + 1; b < FACES; b++) {
            const int shared = shared_vertices(m, a, b);
            for (int i = 0; i <= 3 * WINDOW && shared; i++) {
                mpq_set_si(time, i, 3);
                mpq_canonicalize(time);
                check_time(m, &f, a, b, time, tallies + shared);
            }
        }
    mpq_clear(time);
}

static void neighbours_meet_when_linear_programs_say_so(void **state) {
    (void)state;
    static scene s;
    tally all[4] = {{0}};
    for (int kind = 0; kind < SCENES; kind++) {
        tally t[4] = {{0}};
        fuzz_source r = {(uint64_t)kind + 3};
        for (int round = 0; round < 5; round++) {
            const froe_moving batch = make(&r, (scene_kind)kind, &s);
            froe_motion *m = motion_of(&batch, 0);
            check_motion(m, t);
            froe_motion_free(m);
        }
        assert_int_equal(t[3].contacts, 0);
        for (int n = 0; n < 4; n++) {
            all[n].contacts += t[n].contacts, all[n].instants += t[n].instants;
            all[n].asked += t[n].asked, all[n].met += t[n].met;
        }
        assert_true(t[1].contacts >= 3 && t[1].met > 12 && t[1].met < t[1].asked);
        if (kind >= SLIDING) assert_true(t[2].met > 8);
    }
    assert_true(all[1].instants > 2 && all[2].instants > 2 && all[3].asked > 40);
}

/* ------------------------------------------------------------------ known cases -- */

/* So many faces of vertices that go from one place to another. */
static froe_motion *faces_of(size_t vertices, const double from[][3], const double to[][3], size_t count,
                             const uint32_t *faces) {
    static scene s;
    for (size_t v = 0; v < vertices; v++) {
        s.starts[v] = 2 * v;
        s.times[2 * v] = 0, s.times[2 * v + 1] = WINDOW;
        memcpy(s.at + 6 * v, from[v], sizeof from[v]);
        memcpy(s.at + 6 * v + 3, to[v], sizeof to[v]);
    }
    s.starts[vertices] = 2 * vertices;
    froe_moving b = froe_moving_defaults();
    b.vertex_count = vertices, b.count = count, b.starts = s.starts, b.times = s.times, b.coords = s.at;
    b.vertices = faces;
    return motion_of(&b, 0);
}

static void assert_only(const froe_motion *m, double begin, double end) {
    static found f;
    const froe_contact *c = found_neighbours(m, &f);
    if (f.count != 1) fail_msg("%zu contacts", f.count);
    assert_true(c->begin[0] <= begin && begin <= c->begin[1] && c->end[0] <= end && end <= c->end[1]);
    assert_int_equal(c->instant, begin == end);
    froe_contact_options o = froe_contact_defaults();
    found_in(m, &o, &f);
    assert_int_equal(f.count, 0); /* unless it is asked for */
}

static const uint32_t two_leaves[] = {0, 1, 2, 0, 3, 4}, two_wings[] = {0, 1, 2, 0, 1, 3};

/* An edge goes through the inside of a triangle at whose corner it does not begin; a wing closes onto another; two
 * angles in a plane begin to overlap; a corner passes the common vertex. */
static void every_way_to_meet_is_told_to_the_instant(void **state) {
    const double leaf[][3] = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 3, 2}, {3, 1, 2}};
    const double under[][3] = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 3, -2}, {3, 1, 2}};
    const double wing[][3] = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 3, 4}},
                 shut[][3] = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 3, -4}};
    const double fan[][3] = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {-4, 2, 0}, {-4, -4, 0}};
    const double closed[][3] = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {4, 2, 0}, {-4, -4, 0}};
    const double spike[][3] = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {-1, -1, 1}, {-1, -1, 3}};
    const double pulled[][3] = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {-1, -1, 3}};
    (void)state;
    froe_motion *m[] = {faces_of(5, leaf, under, 2, two_leaves), faces_of(4, wing, shut, 2, two_wings),
                        faces_of(5, fan, closed, 2, two_leaves), faces_of(5, spike, pulled, 2, two_leaves)};
    assert_only(m[0], 4, 8);
    assert_only(m[1], 4, 4);
    assert_only(m[2], 4, 8); /* a side of one passes a side of the other, away from the vertex */
    assert_only(m[3], 4, 8);
    for (size_t i = 0; i < sizeof m / sizeof *m; i++) froe_motion_free(m[i]);
}

/* ------------------------------------------------------------------- partitions -- */

typedef struct fate {
    int refused, ended, lasted;
    uint64_t events;
} fate;

static bool note_touch(void *user, const froe_event *event) {
    uint32_t *pair = user;
    if (event->kind == FROE_EVENT_TOUCH) pair[0] = event->objects[0], pair[1] = event->objects[1];
    return true;
}

/* From event to event: the tree is the one made from scratch until it ends at the first contact. */
static void follow(froe_motion *m, uint64_t seed, fate *f) {
    static found all;
    froe_kinetic_options o = froe_kinetic_defaults();
    froe_contact_options what = froe_contact_defaults();
    froe_kinetic *k = NULL;
    froe_diagnostic why = {0};
    uint32_t pair[2] = {FROE_NONE, FROE_NONE};
    o.seed = seed;
    what.neighbours = true, what.first = true;
    what.from = froe_motion_window(m).tick; /* what meets at 0 alone has parted by the first tick, */
    what.to = WINDOW - what.from;           /* and what meets at the end has not by the last odd one */
    found_in(m, &what, &all);
    froe_status status = froe_kinetic_new(m, &o, NULL, &k, &why);
    if (status) {
        assert_int_equal(status, FROE_E_INPUT);
        assert_true(all.count && all.list[0].begin[0] <= what.from);
        f->refused++;
        return;
    }
    while (!status) {
        if (froe_kinetic_audit(k, &why)) fail_msg("seed %d at %.17g: %s", (int)seed, froe_kinetic_time(k), why.message);
        const double next = froe_kinetic_next(k);
        status = froe_kinetic_advance(k, next < WINDOW ? next : WINDOW, note_touch, pair, &why);
        f->events++;
        if (!(next < WINDOW)) break;
    }
    if (froe_kinetic_audit(k, &why)) fail_msg("seed %d at %.17g: %s", (int)seed, froe_kinetic_time(k), why.message);
    assert_int_equal(froe_kinetic_statistics(k).stuck, 0);
    assert_int_equal(status, all.count ? FROE_E_INPUT : FROE_OK);
    if (all.count) {
        assert_true(froe_kinetic_time(k) < all.list[0].begin[1]);
        bool first = false; /* of several whose beginnings doubles do not tell apart, any */
        for (size_t i = 0; i < all.count; i++) first |= pair[0] == all.list[i].a && pair[1] == all.list[i].b;
        assert_true(first);
    }
    f->ended += status != FROE_OK, f->lasted += status == FROE_OK;
    froe_kinetic_free(k);
}

static void a_partition_ends_when_neighbours_meet(void **state) {
    static const double ticks[] = {0, 0, 0x1p-10, 0x1p-3, 0.25, 0.5}; /* several plans go on within a long one */
    static scene s;
    fate f = {0};
    (void)state;
    for (uint64_t seed = 1; seed <= 300 / SHARE; seed++) {
        fuzz_source r = {seed};
        froe_moving batch = make(&r, (scene_kind)(seed % SCENES), &s);
        batch.count = 2 + seed / 7 % 2;
        froe_motion *m = motion_of(&batch, ticks[seed % 6]);
        follow(m, seed, &f);
        froe_motion_free(m);
    }
    assert_true(f.ended > 20 / SHARE && f.lasted > 5 / SHARE);
}

/* ------------------------------------------------------------------------ ghosts -- */

/* Are two triangles to be kept apart at an odd tick: from the last before their contact to the first after? */
static bool is_watched(const froe_contact *c, double now, double tick) {
    return now + 2 * tick >= c->begin[0] && now <= c->end[1];
}

/* Which are left out, from the first number on; and what is there must not meet, by linear programs. */
static void check_ghosts(const froe_kinetic *k, const froe_motion *m, const found *all, fate *f) {
    const double now = froe_kinetic_time(k), tick = froe_motion_window(m).tick;
    bool ghost[FACES] = {false};
    mpq_t time, none;
    mpq_inits(time, none, NULL);
    mpq_set_d(time, now);
    for (uint32_t b = 0; b < froe_motion_object_count(m); b++) {
        for (size_t i = 0; i < all->count; i++) {
            const froe_contact *c = &all->list[i];
            if (c->b == b && !ghost[c->a] && is_watched(c, now, tick)) ghost[b] = true;
        }
        if (now_is_ghost(&k->now, b) != ghost[b]) fail_msg("triangle %u at %.17g: %d", b, now, ghost[b]);
        f->refused += ghost[b];
        for (uint32_t a = 0; a < b && !ghost[b]; a++)
            if (!ghost[a])
                assert_false(shared_vertices(m, a, b) ? oracle_neighbours_meet(m, a, b, time)
                                                      : oracle_triangles_meet(m, a, b, time, none));
    }
    mpq_clears(time, none, NULL);
}

static bool count_touches(void *user, const froe_event *event) {
    fate *f = user;
    f->ended += event->kind == FROE_EVENT_TOUCH;
    return true;
}

static bool count_events(void *user, const froe_event *event) {
    fate *f = user;
    (void)event;
    f->lasted++;
    return true;
}

static void ghosts_are_left_out_while_they_meet_others(void **state) {
    static const double ticks[] = {0, 0, 0x1p-10, 0x1p-3};
    static scene s;
    static found all;
    fate f = {0};
    (void)state;
    for (uint64_t seed = 1; seed <= 70 / SHARE; seed++) {
        fuzz_source r = {seed};
        froe_moving batch = make(&r, (scene_kind)(seed % SCENES), &s);
        batch.count = 2 + seed % 4;
        froe_motion *m = motion_of(&batch, ticks[seed / 7 % 4]);
        froe_kinetic_options o = froe_kinetic_defaults();
        froe_kinetic *k = NULL;
        froe_diagnostic why = {0};
        o.seed = seed, o.ghosts = true;
        found_neighbours(m, &all);
        assert_int_equal(froe_kinetic_new(m, &o, NULL, &k, NULL), FROE_OK);
        for (int step = 0; step < 60; step++) {
            if (froe_kinetic_audit(k, &why)) fail_msg("%d at %.17g: %s", (int)seed, froe_kinetic_time(k), why.message);
            if (step % 6 == 0) check_ghosts(k, m, &all, &f);
            const double next = froe_kinetic_next(k), to = WINDOW * (step + 1) / 60.0;
            assert_int_equal(froe_kinetic_advance(k,
                                                  next < to                   ? next
                                                  : to > froe_kinetic_time(k) ? to
                                                                              : froe_kinetic_time(k),
                                                  count_touches, &f, NULL),
                             FROE_OK);
        }
        assert_int_equal(froe_kinetic_statistics(k).stuck, 0);
        froe_kinetic_free(k);
        froe_motion_free(m);
    }
    assert_true(f.refused > 130 / SHARE && f.ended > 44 / SHARE);
}

static uint32_t below(froe_kinetic *k, double z) {
    froe_kinetic_place place;
    assert_int_equal(froe_kinetic_locate_in_space(k, (const double[]){1, 1, z}, &place, NULL), FROE_OK);
    return place.below;
}

/* Three leaves, the second of which lies across the first, and the third elsewhere. */
static froe_motion *three_leaves(const double *births, const double *deaths) {
    static const double at[9][3] = {{0, 0, 0}, {9, 0, 0},  {0, 9, 0},  {0, 0, -1}, {9, 0, 1},
                                    {0, 9, 1}, {0, 0, -9}, {9, 0, -9}, {0, 9, -9}};
    static const double zeros[9];
    static const size_t starts[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
    froe_moving b = froe_moving_defaults();
    b.vertex_count = 9, b.count = 3, b.starts = starts, b.times = zeros, b.coords = at[0], b.births = births,
    b.deaths = deaths;
    return motion_of(&b, 0);
}

/* What was left out because of a triangle is there as soon as that has gone, or has gone elsewhere. */
static void ghosts_return_when_what_they_meet_goes(void **state) {
    (void)state;
    for (int way = 0; way < 2; way++) {
        froe_motion *m = three_leaves(NULL, NULL);
        froe_kinetic_options o = froe_kinetic_defaults();
        froe_kinetic *k;
        o.ghosts = true;
        assert_int_equal(froe_kinetic_new(m, &o, NULL, &k, NULL), FROE_OK);
        assert_int_equal(below(k, 5), 0);
        assert_int_equal(below(k, -0.5), 2);
        assert_true(now_is_ghost(&k->now, 1));
        if (way == 0) assert_int_equal(froe_kinetic_remove(k, 0, NULL), FROE_OK);
        for (uint32_t v = 0; way == 1 && v < 3; v++) {
            const double time = 0, to[3] = {v == 1 ? 9 : 0, v == 2 ? 9 : 0, 7};
            assert_int_equal(froe_kinetic_replan(k, v, 1, &time, to, NULL, NULL, NULL), FROE_OK);
        }
        assert_false(now_is_ghost(&k->now, 1));
        assert_int_equal(below(k, 5), 1);
        assert_int_equal(below(k, 9), way == 0 ? 1 : 0);
        assert_int_equal(froe_kinetic_audit(k, NULL), FROE_OK);
        assert_int_equal(froe_kinetic_advance(k, WINDOW, NULL, NULL, NULL), FROE_OK);
        assert_int_equal(below(k, 5), 1);
        froe_kinetic_free(k);
        froe_motion_free(m);
    }
}

/* A triangle that is born where another one is: the one with the greater number is left out from then on, and is there
 * before. */
static void nothing_is_left_out_for_what_is_not_born(void **state) {
    enum { BIRTH = 5 };
    (void)state;
    for (uint32_t born = 0; born < 2; born++) {
        const double births[3] = {born ? 0 : BIRTH, born ? BIRTH : 0, 0};
        froe_motion *m = three_leaves(births, NULL);
        froe_kinetic_options o = froe_kinetic_defaults();
        froe_kinetic *k;
        fate f = {0};
        o.ghosts = true;
        assert_int_equal(froe_kinetic_new(m, &o, NULL, &k, NULL), FROE_OK);
        assert_int_equal(below(k, 5), 1 - born);
        assert_int_equal(froe_kinetic_advance(k, BIRTH - 1, count_touches, &f, NULL), FROE_OK);
        assert_int_equal(below(k, 5), 1 - born);
        assert_int_equal(froe_kinetic_advance(k, WINDOW, count_touches, &f, NULL), FROE_OK);
        assert_int_equal(below(k, 5), 0);
        assert_int_equal(f.ended, 1);
        assert_int_equal(froe_kinetic_audit(k, NULL), FROE_OK);
        froe_kinetic_free(k);
        froe_motion_free(m);
    }
}

/* Taking out what has gone, by itself or by such a call, does not bring it back. */
static void what_has_gone_is_gone(void **state) {
    static const double deaths[3] = {2, 8, 8};
    static found all;
    froe_motion *m = three_leaves(NULL, deaths);
    froe_kinetic_options o = froe_kinetic_defaults();
    froe_kinetic *k;
    double gone = WINDOW;
    (void)state;
    o.ghosts = true;
    assert_int_equal(froe_kinetic_new(m, &o, NULL, &k, NULL), FROE_OK);
    for (int i = 1; i < WINDOW; i++) {
        assert_int_equal(froe_kinetic_advance(k, i, NULL, NULL, NULL), FROE_OK);
        if (i == 4) assert_int_equal(froe_kinetic_remove(k, 0, NULL), FROE_OK);
        if (i > 4) assert_int_equal(froe_kinetic_remove(k, 1, NULL), FROE_OK);
        if (i == 5) gone = froe_motion_object(m, 1).death;
    }
    assert_true(froe_motion_object(m, 0).death == 2 && froe_motion_object(m, 1).death == gone);
    found_neighbours(m, &all);
    assert_int_equal(all.count, 1);
    assert_true(all.list[0].end[1] == 2);
    froe_kinetic_free(k);
    froe_motion_free(m);
}

/* Objects that the motion has got, and the partition has not been told of, take no part. */
static void what_is_not_known_yet_takes_no_part(void **state) {
    static const double at[9] = {0, 0, -2, 9, 0, 3, 0, 9, 3}, zeros[3];
    static const size_t starts[] = {0, 1, 2, 3};
    froe_motion *m = three_leaves(NULL, NULL);
    froe_kinetic_options o = froe_kinetic_defaults();
    froe_moving b = froe_moving_defaults();
    froe_snapshot now;
    froe_kinetic *k;
    (void)state;
    o.ghosts = true;
    b.vertex_count = 3, b.count = 1, b.starts = starts, b.times = zeros, b.coords = at;
    assert_int_equal(froe_kinetic_new(m, &o, NULL, &k, NULL), FROE_OK);
    assert_int_equal(froe_motion_add(m, &b, NULL), FROE_OK);
    assert_int_equal(froe_kinetic_advance(k, 1, NULL, NULL, NULL), FROE_OK);
    assert_int_equal(below(k, 5), 0);
    assert_int_equal(froe_kinetic_audit(k, NULL), FROE_OK);
    assert_int_equal(froe_kinetic_snapshot(k, NULL, &now, NULL), FROE_OK);
    assert_int_equal(froe_scene_object_count(froe_tree_scene(now.tree)), 2);
    froe_tree_free(now.tree);
    assert_int_equal(froe_kinetic_update(k, NULL), FROE_OK);
    assert_true(now_is_ghost(&k->now, 1) && now_is_ghost(&k->now, 3));
    assert_int_equal(froe_kinetic_audit(k, NULL), FROE_OK);
    froe_kinetic_free(k);
    froe_motion_free(m);
}

static froe_status with_ghosts(void *user, const froe_allocator *alloc) {
    froe_kinetic_options o = froe_kinetic_defaults();
    froe_kinetic *k = NULL;
    o.ghosts = true;
    froe_status status = froe_kinetic_new(user, &o, alloc, &k, NULL);
    if (status) return status;
    status = froe_kinetic_advance(k, WINDOW, NULL, NULL, NULL);
    if (!status) status = froe_kinetic_audit(k, NULL);
    froe_kinetic_free(k);
    return status;
}

static void memory_may_run_out_among_ghosts(void **state) {
    static scene s;
    fuzz_source r = {4};
    const froe_moving batch = make(&r, RANDOM, &s);
    froe_motion *m = motion_of(&batch, 0);
    (void)state;
    assert_true(test_memory_each(with_ghosts, m) > 10);
    froe_motion_free(m);
}

/* A leaf that leans and rises through two others, from 2.4 to 4 and from 2.8 to 4.4. */
static froe_motion *rising_leaf(void) {
    static const double at[12][3] = {{0, 0, -5}, {0, 0, 5}, {9, 0, -3}, {9, 0, 7},   {0, 9, -3},  {0, 9, 7},
                                     {0, 0, 0},  {9, 0, 0}, {0, 9, 0},  {0, 0, 0.5}, {9, 0, 0.5}, {0, 9, 0.5}};
    static const double times[12] = {0, WINDOW, 0, WINDOW, 0, WINDOW};
    static const size_t starts[] = {0, 2, 4, 6, 7, 8, 9, 10, 11, 12};
    froe_moving b = froe_moving_defaults();
    b.vertex_count = 9, b.count = 3, b.starts = starts, b.times = times, b.coords = at[0];
    return motion_of(&b, 0);
}

/* Nothing is told before froe_kinetic_next() has it: neither that triangles leave and return, nor that they meet. */
static void what_comes_next_may_be_a_contact(void **state) {
    (void)state;
    for (int ghosts = 0; ghosts < 2; ghosts++) {
        froe_motion *m = rising_leaf();
        froe_kinetic_options o = froe_kinetic_defaults();
        froe_kinetic *k;
        fate f = {0};
        o.ghosts = ghosts;
        assert_int_equal(froe_kinetic_new(m, &o, NULL, &k, NULL), FROE_OK);
        froe_status status = FROE_OK;
        int steps = 0;
        for (double next; !status && (next = froe_kinetic_next(k)) < WINDOW; steps++) {
            if (next - 0.25 > froe_kinetic_time(k))
                assert_int_equal(froe_kinetic_advance(k, next - 0.25, count_events, &f, NULL), FROE_OK);
            assert_int_equal(f.lasted, 0);
            status = froe_kinetic_advance(k, next, count_touches, &f, NULL);
        }
        assert_int_equal(status, ghosts ? FROE_OK : FROE_E_INPUT);
        assert_int_equal(f.ended, ghosts ? 2 : 1);
        assert_true(steps >= (ghosts ? 4 : 1));
        froe_kinetic_free(k);
        froe_motion_free(m);
    }
}

/* Memory is refused while triangles leave and return: they are right after the call, or else after the next one. */
static void ghosts_are_right_after_memory_was_refused(void **state) {
    static found all;
    froe_motion *m = rising_leaf();
    size_t calls = 1;
    fate f = {0};
    (void)state;
    found_neighbours(m, &all);
    for (size_t i = 0; i < 4 * calls; i++) {
        test_memory memory;
        const froe_allocator alloc = test_memory_begin(&memory);
        froe_kinetic_options o = froe_kinetic_defaults();
        froe_kinetic *k;
        o.ghosts = true;
        assert_int_equal(froe_kinetic_new(m, &o, &alloc, &k, NULL), FROE_OK);
        assert_int_equal(froe_kinetic_advance(k, 1, NULL, NULL, NULL), FROE_OK);
        const size_t before = memory.calls;
        memory.fail_at = i < 4 ? 0 : before + i / 4, memory.fail_on = i / 2 % 2;
        const froe_status status = froe_kinetic_advance(k, 3.5, i % 2 ? count_touches : NULL, &f, NULL);
        assert_true(status == FROE_OK || (i >= 4 && status == FROE_E_MEMORY));
        if (i < 4) calls = memory.calls - before + 1;
        memory.fail_at = 0;
        assert_int_equal(froe_kinetic_audit(k, NULL), FROE_OK);
        check_ghosts(k, m, &all, &f);
        if (status) assert_int_equal(froe_kinetic_advance(k, 3.5, NULL, NULL, NULL), FROE_OK);
        assert_true(now_is_ghost(&k->now, 1) && now_is_ghost(&k->now, 2));
        assert_int_equal(froe_kinetic_audit(k, NULL), FROE_OK);
        froe_kinetic_free(k);
        test_memory_end(&memory);
    }
    assert_true(calls > 2);
    froe_motion_free(m);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(neighbours_meet_when_linear_programs_say_so),
        cmocka_unit_test(every_way_to_meet_is_told_to_the_instant),
        cmocka_unit_test(a_partition_ends_when_neighbours_meet),
        cmocka_unit_test(ghosts_are_left_out_while_they_meet_others),
        cmocka_unit_test(ghosts_return_when_what_they_meet_goes),
        cmocka_unit_test(nothing_is_left_out_for_what_is_not_born),
        cmocka_unit_test(what_has_gone_is_gone),
        cmocka_unit_test(what_is_not_known_yet_takes_no_part),
        cmocka_unit_test(memory_may_run_out_among_ghosts),
        cmocka_unit_test(what_comes_next_may_be_a_contact),
        cmocka_unit_test(ghosts_are_right_after_memory_was_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
