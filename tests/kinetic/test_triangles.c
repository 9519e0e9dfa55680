/* test_triangles.c: contacts of moving triangles, against linear programs in rationals at many instants, and by known
 * cases. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "kinetic/contact/meet.h"
#include "oracle/touching.h"
#include "support/found.h"
#include "support/fuzz.h"
#include "support/memory.h"

enum { MOST = 8, KNOTS = 3, WINDOW = 8 };

/* ----------------------------------------------------------------- made-up scenes -- */

typedef enum scene_kind {
    RANDOM,    /* anywhere, in 1 or 2 pieces between random times */
    CURVED,    /* the same on parabolas */
    LATTICE,   /* small whole numbers: everything happens at once */
    PARABOLIC, /* the same on parabolas */
    RIGID,     /* triangles that keep their shape, on a lattice: edges stay parallel */
    SLIDING,   /* all in one plane */
    STACKED,   /* in planes z = 0 or 1, moving as wholes up and down and along: face to face */
    FLAT,      /* triangles without area, some of the time or always */
    LINED,     /* all corners on one line */
    LIVES,     /* lattice motions that begin and end at whole times */
    FAR,       /* lattice, 2^40 from the origin */
    CUBIC,     /* as RANDOM, on cubics and parabolas */
    CUBICAL,   /* as LATTICE, on them */
    BODIES,    /* each a body of its own that turns, by right angles and others */
    FALLING,   /* the same along parabolas, and shapes that are no bodies */
    TUMBLING,  /* the same, and these on cubics */
    SCENES
} scene_kind;

typedef struct scene {
    size_t starts[3 * MOST + 1], count;
    double times[3 * MOST * KNOTS], at[9 * MOST * KNOTS], controls[9 * MOST * KNOTS], seconds[9 * MOST * KNOTS];
    double births[MOST], deaths[MOST];
    uint32_t bodies[3 * MOST];
} scene;

static double number(fuzz_source *r, scene_kind kind) {
    return kind == RANDOM || kind == CURVED || kind == CUBIC ? fuzz_int(r, -64, 64) * 0x1p-6 : fuzz_int(r, 0, 3);
}

static size_t times_of(fuzz_source *r, scene_kind kind, bool in_body, double *times) {
    size_t count = 0;
    times[count++] = 0;
    if (in_body) return count;
    if (kind != RIGID && kind != STACKED && fuzz_int(r, 0, 1))
        times[count++] = kind == RANDOM ? fuzz_int(r, 1, 255) / 32.0 : fuzz_int(r, 1, 7);
    times[count++] = WINDOW;
    return count;
}

/* Where corner `v` is at its knot `i`. */
static void corner(fuzz_source *r, scene_kind kind, const scene *s, size_t v, size_t i, double out[3]) {
    const double *first = s->at + 3 * s->starts[v], *own = s->at + 3 * s->starts[v - v % 3];
    for (size_t k = 0; k < 3; k++) out[k] = number(r, kind);
    if (kind == SLIDING) out[2] = out[0] + 2 * out[1];
    if (kind == LINED) out[1] = 2 * out[0], out[2] = 1 - out[0];
    if (kind == FLAT && v % 3 == 2 && fuzz_int(r, 0, 3)) /* on the edge of the others */
        for (size_t k = 0; k < 3; k++) out[k] = fuzz_int(r, 0, 1) ? own[k] : 0.5 * (own[k] + (first - 3)[k]);
    if (kind == STACKED && !i && v % 3) out[2] = own[2];
    if ((kind == RIGID || kind == STACKED) && i && v % 3)
        for (size_t k = 0; k < 3; k++) out[k] = first[k] + own[3 + k] - own[k];
    for (size_t k = 0; k < 3 && kind == FAR; k++) out[k] += 0x1p40;
}

static froe_moving make(fuzz_source *r, scene_kind kind, size_t n, scene *s) {
    const bool cubic = kind == CUBIC || kind == CUBICAL || kind == TUMBLING;
    const bool curved = kind == CURVED || kind == PARABOLIC || kind == FALLING || cubic;
    size_t at = 0;
    for (size_t v = 0; v < 3 * n; v++) {
        s->starts[v] = at;
        const bool in_body = kind == BODIES || (kind >= FALLING && v / 3 % 2);
        const size_t count = times_of(r, kind, in_body, s->times + at);
        s->bodies[v] = in_body ? (uint32_t)(v / 3) : FROE_NONE;
        for (size_t i = 0; i < count; i++, at++) {
            corner(r, kind, s, v, i, s->at + 3 * at);
            const bool straight = !curved || fuzz_int(r, 0, 1);
            for (size_t k = 0; k < 3; k++) s->controls[3 * at + k] = straight ? NAN : number(r, kind);
            const bool again = cubic && !straight && fuzz_int(r, 0, 3);
            for (size_t k = 0; k < 3; k++) s->seconds[3 * at + k] = again ? number(r, kind) : NAN;
        }
    }
    s->starts[3 * n] = at;
    for (size_t j = 0; j < n; j++) {
        s->births[j] = kind == LIVES ? fuzz_int(r, 0, 4) : 0;
        s->deaths[j] = kind == LIVES ? fuzz_int(r, 4, 8) : WINDOW;
    }
    froe_moving b = froe_moving_defaults();
    b.vertex_count = 3 * n, b.count = n, b.starts = s->starts, b.times = s->times, b.coords = s->at;
    b.controls = s->controls, b.second_controls = s->seconds, b.births = s->births, b.deaths = s->deaths;
    if (kind >= BODIES) b.bodies = s->bodies;
    return b;
}

/* n bodies that turn in 1 or 2 steps. */
static froe_status add_bodies(froe_motion *m, uint32_t n, bool falling, uint64_t seed) {
    static const double turns[][4] = {{0, 0, 0, 1},          {0.5, 0.5, 0.5, 0.5},    {0.6, 0, 0, 0.8},
                                      {0, -0.6, 0, 0.8},     {0, 0, 0.28, 0.96},      {0.5, -0.5, 0.5, 0.5},
                                      {-0.48, 0.36, 0, 0.8}, {-0.5, -0.5, -0.5, -0.5}};
    fuzz_source r = {seed};
    froe_status status = FROE_OK;
    for (uint32_t i = 0; i < n && !status; i++) {
        double times[3] = {0, fuzz_int(&r, 1, 7), WINDOW}, at[9], controls[9], turn[12];
        froe_body body = froe_body_defaults();
        body.count = (size_t)fuzz_int(&r, 1, 3);
        times[body.count - 1] = body.count > 1 ? WINDOW : 0;
        for (size_t k = 0; k < 9; k++) {
            at[k] = fuzz_int(&r, 0, 3);
            controls[k] = falling && i % 2 ? (double)fuzz_int(&r, 0, 4) : (double)NAN;
        }
        for (size_t k = 0; k < 3; k++) memcpy(turn + 4 * k, turns[fuzz_int(&r, 0, 7)], sizeof turns[0]);
        body.times = times, body.coords = at, body.controls = controls, body.turns = turn;
        status = froe_motion_add_body(m, &body, NULL, NULL);
    }
    return status;
}

static froe_status motion_in_space(const froe_moving *batch, const froe_allocator *alloc, froe_motion **out) {
    froe_motion_options o = froe_motion_defaults();
    o.dim = 3, o.begin = 0, o.end = WINDOW;
    froe_status status = froe_motion_new(&o, alloc, out, NULL);
    if (!status && batch->bodies)
        status = add_bodies(*out, (uint32_t)batch->count, batch->bodies[0] == FROE_NONE,
                            (uint64_t)(batch->coords[0] + 8 * batch->coords[4] + 64 * batch->coords[8]));
    return status ? status : froe_motion_add(*out, batch, NULL);
}

static froe_motion *motion_of(const froe_moving *batch) {
    froe_motion *m = NULL;
    assert_int_equal(motion_in_space(batch, NULL, &m), FROE_OK);
    return m;
}

/* ----------------------------------------------------------------- against the oracle -- */

typedef struct tally {
    int contacts, instants, lasting, since_start, known;
} tally;

typedef struct asking {
    const froe_motion *m;
    uint32_t a, b;
    mpq_t time, none, slack;
} asking;

static void asking_init(asking *q) {
    mpq_inits(q->time, q->none, q->slack, NULL);
    mpq_set_ui(q->slack, 1, 1);
    mpq_div_2exp(q->slack, q->slack, 36);
}

static void asking_clear(asking *q) {
    mpq_clears(q->time, q->none, q->slack, NULL);
}

static bool meet_at(asking *q, double time) {
    mpq_set_d(q->time, time);
    return oracle_triangles_meet(q->m, q->a, q->b, q->time, q->none);
}

static bool near_at(asking *q, double time) {
    mpq_set_d(q->time, time);
    return oracle_triangles_meet(q->m, q->a, q->b, q->time, q->slack);
}

/* An end of a contact, `from` the side of it where they are apart: no contact there, unless it is known exactly. */
static void check_contact(asking *q, const froe_contact *c, const froe_contact *before, tally *t) {
    assert_true(c->begin[0] <= c->begin[1] && c->end[0] <= c->end[1] && c->begin[0] <= c->end[0]);
    assert_true(c->begin[1] - c->begin[0] <= 8 * 0x1p-50 && c->end[1] - c->end[0] <= 8 * 0x1p-50);
    const bool known = c->begin[0] == c->begin[1], wide = c->begin[1] < c->end[0];
    if (known || wide) assert_true(meet_at(q, c->begin[1]));
    if (wide || c->end[0] == c->end[1]) assert_true(meet_at(q, c->end[0]));
    assert_true(near_at(q, c->begin[0]) && near_at(q, c->end[1])); /* a graze */
    if (!known && (!before || before->end[1] < c->begin[0])) assert_false(meet_at(q, c->begin[0]));
    if (c->end[0] < c->end[1] && !c->to_stop && c->instant) assert_false(meet_at(q, c->end[1]));
    for (int i = 1; i < 4 && wide; i++) assert_true(meet_at(q, c->begin[1] + i * 0.25 * (c->end[0] - c->begin[1])));
    if (wide) assert_false(c->instant);
    t->contacts++, t->instants += c->instant, t->lasting += !c->instant;
    t->since_start += c->since_start, t->known += known;
}

/* Whatever meets at a sample must have been found; between samples, grazes at rational times are likely. */
static void check_samples(asking *q, const froe_contact *list, int count) {
    enum { PARTS = 12 };
    const froe_moving_object p = froe_motion_object(q->m, q->a), o = froe_motion_object(q->m, q->b);
    for (int i = 0; i <= PARTS * WINDOW; i++) {
        mpq_set_si(q->time, i, PARTS);
        mpq_canonicalize(q->time);
        if (oracle_compare_time(q->time, fmax(p.birth, o.birth)) < 0 ||
            oracle_compare_time(q->time, fmin(p.death, o.death)) > 0)
            continue;
        bool told = false, doubtful = false;
        for (int k = 0; k < count; k++) {
            const bool after = oracle_compare_time(q->time, list[k].begin[0]) >= 0,
                       before = oracle_compare_time(q->time, list[k].end[1]) <= 0;
            if (!after || !before) continue;
            if (oracle_compare_time(q->time, list[k].begin[1]) >= 0 &&
                oracle_compare_time(q->time, list[k].end[0]) <= 0)
                told = true;
            else
                doubtful = true;
        }
        const bool meet = oracle_triangles_meet(q->m, q->a, q->b, q->time, q->none);
        if (told || !doubtful) assert_int_equal(meet, told);
    }
}

static void check_pair(asking *q, const found *f, tally *t) {
    static froe_contact list[FOUND_MOST];
    int count = 0;
    for (size_t i = 0; i < f->count; i++)
        if (f->list[i].a == q->a && f->list[i].b == q->b) list[count++] = f->list[i];
    for (int i = 0; i < count; i++) {
        assert_true(!i || list[i - 1].end[0] <= list[i].begin[1]);
        check_contact(q, &list[i], i ? &list[i - 1] : NULL, t);
    }
    check_samples(q, list, count);
}

static void check_motion(const froe_motion *m, tally *t) {
    static found f, again;
    froe_contact_options o = froe_contact_defaults();
    o.threads = 1;
    found_in(m, &o, &f);
    o.threads = 3;
    found_in(m, &o, &again);
    assert_int_equal(f.count, again.count);
    assert_memory_equal(f.list, again.list, f.count * sizeof *f.list);
    for (size_t i = 1; i < f.count; i++) assert_true(f.list[i - 1].begin[0] <= f.list[i].begin[0]);
    asking q = {.m = m};
    asking_init(&q);
    for (q.a = 0; q.a < froe_motion_object_count(m); q.a++)
        for (q.b = q.a + 1; q.b < froe_motion_object_count(m); q.b++) check_pair(&q, &f, t);
    asking_clear(&q);
}

static void contacts_are_those_of_linear_programs(void **state) {
    (void)state;
    static scene s;
    fuzz_source r = {17};
    for (int kind = 0; kind < SCENES; kind++) {
        tally t = {0, 0, 0, 0, 0};
        const froe_moving batch = make(&r, (scene_kind)kind, kind < BODIES ? 5 : MOST, &s);
        froe_motion *m = motion_of(&batch);
        check_motion(m, &t);
        froe_motion_free(m);
        assert_true(t.contacts >= 2);
        if (kind >= LATTICE && kind != LINED && kind != LIVES && kind < CUBIC)
            assert_true(t.instants > 0 && t.known > 0);
        if (kind != STACKED) assert_true(t.lasting > 0);
    }
}

/* --------------------------------------------------------------- the same elsewhere -- */

/* The number of an earlier contact of the same pair. */
static size_t number_in_pair(const found *f, size_t i) {
    size_t count = 0;
    for (size_t k = 0; k < i; k++) count += f->list[k].a == f->list[i].a && f->list[k].b == f->list[i].b;
    return count;
}

static bool overlap(const double a[2], const double b[2]) {
    return a[0] <= b[1] && b[0] <= a[1];
}

/* The same contacts, wherever the scene lies, however large it is, and in whatever order its corners are given; only
 * enclosures may be a place wider. */
static void assert_alike(const found *f, const froe_moving *batch) {
    static found again;
    froe_motion *m = motion_of(batch);
    found_in(m, NULL, &again);
    assert_int_equal(f->count, again.count);
    for (size_t i = 0; i < f->count; i++) {
        const froe_contact *c = &f->list[i], *d = again.list;
        for (size_t k = 0; d->a != c->a || d->b != c->b || number_in_pair(&again, k) != number_in_pair(f, i); k++, d++)
            assert_true(k + 1 < again.count);
        assert_true(overlap(c->begin, d->begin) && overlap(c->end, d->end) && c->instant == d->instant);
        assert_true(c->since_start == d->since_start && c->to_stop == d->to_stop);
    }
    froe_motion_free(m);
}

static void scale_and_shift(scene *s, double scale, double shift) {
    for (size_t i = 0; i < 9 * MOST * KNOTS; i++) {
        s->at[i] = scale * (s->at[i] + shift);
        s->controls[i] = scale * (s->controls[i] + shift);
    }
}

static void contacts_do_not_depend_on_place_size_and_order(void **state) {
    (void)state;
    static const double changes[][2] = {{0x1p-1060, 0}, {0x1p1000, 0}, {1, 0x1p44}, {-1, 0}, {0x1p900, -1}};
    static scene s, changed;
    static found f;
    fuzz_source r = {23};
    uint32_t turned[3 * MOST];
    for (uint32_t i = 0; i < 3 * MOST; i++) turned[i] = i - i % 3 + (i % 3 * 2 + i / 3) % 3;
    for (int kind = LATTICE; kind <= LIVES; kind++) {
        froe_moving batch = make(&r, (scene_kind)kind, MOST, &s);
        froe_motion *m = motion_of(&batch);
        found_in(m, NULL, &f);
        froe_motion_free(m);
        for (size_t i = 0; i < sizeof changes / sizeof *changes; i++) {
            changed = s;
            scale_and_shift(&changed, changes[i][0], changes[i][1]);
            batch.coords = changed.at, batch.controls = changed.controls;
            assert_alike(&f, &batch);
        }
        batch.coords = s.at, batch.controls = s.controls, batch.vertices = turned;
        assert_alike(&f, &batch);
    }
}

/* ------------------------------------------------------------------ many bodies -- */

enum { CROWD = 200 };

/* Triangles thrown up in a cube, each turning, and falling back through the others. */
static froe_motion *thrown_bodies(void) {
    static size_t starts[3 * CROWD + 1];
    static double times[3 * CROWD], at[9 * CROWD];
    static uint32_t bodies[3 * CROWD];
    fuzz_source r = {31};
    froe_motion_options o = froe_motion_defaults();
    froe_motion *m = NULL;
    o.dim = 3, o.begin = 0, o.end = WINDOW;
    assert_int_equal(froe_motion_new(&o, NULL, &m, NULL), FROE_OK);
    for (uint32_t i = 0; i < CROWD; i++) {
        double keys[2] = {0, WINDOW}, places[6], controls[6], turns[8], square[2] = {0, 0};
        for (size_t k = 0; k < 3; k++) {
            places[k] = 5 * fuzz_unit(&r);
            places[3 + k] = places[k] + 4 * fuzz_unit(&r);
            controls[k] = 0.5 * (places[k] + places[3 + k]) + (k == 2 ? 8 : 0);
        }
        for (size_t k = 0; k < 8; k++) {
            turns[k] = fuzz_unit(&r) + (k % 4 == 3);
            square[k / 4] += turns[k] * turns[k];
        }
        for (size_t k = 0; k < 8; k++) turns[k] /= sqrt(square[k / 4]);
        froe_body body = froe_body_defaults();
        body.count = 2, body.times = keys, body.coords = places, body.controls = controls, body.turns = turns;
        assert_int_equal(froe_motion_add_body(m, &body, NULL, NULL), FROE_OK);
    }
    for (uint32_t v = 0; v < 3 * CROWD; v++) {
        starts[v] = v;
        bodies[v] = v / 3;
        for (size_t k = 0; k < 3; k++) at[3 * v + k] = fuzz_unit(&r);
    }
    starts[3 * CROWD] = (size_t)3 * CROWD;
    froe_moving b = froe_moving_defaults();
    b.vertex_count = (size_t)3 * CROWD, b.count = CROWD, b.starts = starts, b.times = times, b.coords = at;
    b.bodies = bodies;
    assert_int_equal(froe_motion_add(m, &b, NULL), FROE_OK);
    return m;
}

/* Each pair is looked at over all the time, without boxes. */
static void boxes_miss_nothing_among_bodies_that_fall_and_turn(void **state) {
    (void)state;
    static found f;
    static uint32_t next[FOUND_MOST], first[CROWD]; /* of the contacts of each first object, in order of time */
    froe_motion *m = thrown_bodies();
    found_in(m, NULL, &f);
    assert_true(f.count > 75);
    for (uint32_t a = 0; a < CROWD; a++) first[a] = FROE_NONE;
    for (uint32_t i = (uint32_t)f.count; i-- > 0;) {
        next[i] = first[f.list[i].a];
        first[f.list[i].a] = i;
    }
    meet_worker w;
    assert_int_equal(meet_worker_new(m, &w), FROE_OK);
    for (uint32_t a = 0; a < CROWD; a++)
        for (uint32_t b = a + 1; b < CROWD; b++) {
            assert_int_equal(meet_find(m, &w, a, b, 0, WINDOW), FROE_OK);
            int count = 0;
            for (uint32_t i = first[a]; i != FROE_NONE; i = next[i]) {
                const froe_contact *c = &f.list[i];
                if (c->b != b) continue;
                assert_true(count < w.span_count);
                const meet_span *s = &w.spans[count++];
                assert_true(c->begin[0] <= s->begin.high && s->begin.low <= c->begin[1]);
                assert_true(c->end[0] <= s->end.high && s->end.low <= c->end[1] && c->instant == s->instant);
            }
            assert_int_equal(count, w.span_count);
        }
    meet_worker_free(m, &w);
    froe_motion_free(m);
}

/* -------------------------------------------------------------------- known cases -- */

/* Two triangles: one at rest, one that moves as a whole by `way` from 0 to 8, with a control point if `bend` is one. */
static size_t contacts_of(const double rest[9], const double start[9], const double way[3], const double *bend,
                          found *f) {
    static const size_t starts[] = {0, 1, 2, 3, 5, 7, 9};
    static const double times[] = {0, 0, 0, 0, WINDOW, 0, WINDOW, 0, WINDOW};
    double at[27], controls[27];
    for (size_t i = 0; i < 9; i++) {
        at[i] = rest[i];
        at[9 + i / 3 * 6 + i % 3] = start[i];
        at[12 + i / 3 * 6 + i % 3] = start[i] + way[i % 3];
        controls[i] = NAN;
        controls[9 + i / 3 * 6 + i % 3] = bend ? start[i] + bend[i % 3] : NAN;
        controls[12 + i / 3 * 6 + i % 3] = NAN;
    }
    froe_moving b = froe_moving_defaults();
    b.vertex_count = 6, b.count = 2, b.starts = starts, b.times = times, b.coords = at, b.controls = controls;
    froe_motion *m = motion_of(&b);
    found_in(m, NULL, f);
    froe_motion_free(m);
    return f->count;
}

static const double ground[9] = {0, 0, 0, 4, 0, 0, 0, 4, 0};

static void assert_contact(const found *f, double begin, double end, bool exact) {
    assert_int_equal(f->count, 1);
    const froe_contact *c = f->list;
    assert_true(c->begin[0] <= begin && begin <= c->begin[1] && c->end[0] <= end && end <= c->end[1]);
    assert_true(c->begin[1] - c->begin[0] < 1e-14 && c->end[1] - c->end[0] < 1e-14);
    if (exact) assert_true(c->begin[0] == c->begin[1] && c->end[0] == c->end[1]);
    assert_int_equal(c->instant, begin == end);
    assert_int_equal(c->since_start, begin == 0);
    assert_int_equal(c->to_stop, end == WINDOW);
}

static void touches_of_every_kind_are_told_to_the_instant(void **state) {
    (void)state;
    static found f;
    const double tip[9] = {1, 1, 4, 0, 1, 9, 1, 0, 9}, face[9] = {1, 1, 4, 3, 1, 4, 1, 3, 4};
    const double blade[9] = {1, -3, 4, 1, 3, 4, 1, 0, 9}, beside[9] = {0, -5, 0, 4, -5, 0, 2, -8, 0};
    const double down[3] = {0, 0, -8}, up_and_down[3] = {0, 0, 0}, dip[3] = {0, 0, -8}, short_dip[3] = {0, 0, -7.5};
    contacts_of(ground, tip, down, NULL, &f); /* a corner goes through: 4 .. 8 */
    assert_contact(&f, 4, 8, true);
    contacts_of(ground, tip, up_and_down, dip, &f); /* a corner grazes */
    assert_contact(&f, 4, 4, true);
    assert_int_equal(contacts_of(ground, tip, up_and_down, short_dip, &f), 0);
    contacts_of(ground, face, down, NULL, &f); /* face to face, for an instant, on its way through */
    assert_contact(&f, 4, 4, true);
    contacts_of(ground, face, up_and_down, dip, &f);
    assert_contact(&f, 4, 4, true);
    contacts_of(ground, blade, down, NULL, &f); /* an edge crosses the border */
    assert_contact(&f, 4, 8, true);
    contacts_of(ground, blade, (const double[]){9, 0, -12}, NULL, &f); /* through the border of the other at 8/3 */
    assert_contact(&f, 8.0 / 3, 8.0 / 3, false);
    contacts_of(ground, beside, (const double[]){0, 8, 0}, NULL, &f); /* in its plane: edge to parallel edge at 5 */
    assert_contact(&f, 5, 8, true);
    contacts_of(ground, beside, (const double[]){40, 40, 0}, NULL, &f); /* a corner meets a corner, in the plane */
    assert_int_equal(f.count, 0);
    contacts_of(ground, (const double[]){1, 1, 0, 9, 9, 8, 9, 0, 8}, (const double[]){-1, 0, 0}, NULL, &f);
    assert_contact(&f, 0, 8, true); /* at rest on it, sliding to its border */
    contacts_of(ground, (const double[]){1, 1, 0, 9, 9, 8, 9, 0, 8}, (const double[]){0, 0, 8}, NULL, &f);
    assert_contact(&f, 0, 0, true); /* lifted at once */
    contacts_of(ground, (const double[]){5, -1, 0, 9, 9, 8, 9, 0, 8}, (const double[]){-8, 8, 0}, NULL, &f);
    assert_contact(&f, 1, 5, true); /* its tip slides over the ground from corner to border */
}

/* What shares a corner is never told of; what is of one group, if so asked. */
static void neighbours_are_left_out(void **state) {
    (void)state;
    static found f;
    const double at[] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 4, 4, 0, 1, 1, -1, 1, 1, 1, 2, 2, 3};
    froe_moving b = froe_moving_defaults();
    b.vertex_count = 7, b.count = 3;
    b.starts = (const size_t[]){0, 1, 2, 3, 4, 5, 6, 7};
    b.times = (const double[]){0, 0, 0, 0, 0, 0, 0};
    b.coords = at;
    b.vertices = (const uint32_t[]){0, 1, 2, 2, 1, 3, 4, 5, 6};
    froe_motion *m = motion_of(&b);
    found_in(m, NULL, &f);
    assert_int_equal(f.count, 1);
    assert_true(f.list[0].a == 0 && f.list[0].b == 2 && f.list[0].since_start && f.list[0].to_stop);
    froe_motion_free(m);
}

/* The widest numbers that doubles make: the arena must hold whatever comes. Cubics of the widest would take hours. */
static void nasty_coordinates_stay_within_the_arena(void **state) {
    (void)state;
    static scene s;
    fuzz_source r = {5};
    for (int i = 0; i < FUZZ_CLASSES + FUZZ_WIDE; i++) {
        const int kind = i % FUZZ_CLASSES;
        const bool cubic = i >= FUZZ_CLASSES;
        const scene_kind curved[2][3] = {{PARABOLIC, BODIES, FALLING}, {CUBICAL, TUMBLING, CUBIC}};
        const froe_moving batch = make(&r, curved[cubic][kind % 3], 2, &s);
        fuzz_points(&r, (fuzz_class)kind, 3, s.at, s.starts[6]);
        for (size_t k = 0; k < 3 * s.starts[6]; k++)
            for (int second = 0; second < 2; second++) {
                double *x = second ? s.seconds + k : s.controls + k;
                if (!isnan(*x)) *x = fuzz_coordinate(&r, (fuzz_class)kind);
            }
        froe_motion *m = motion_of(&batch);
        meet_worker w;
        assert_int_equal(meet_worker_new(m, &w), FROE_OK);
        for (int t = 0; t < 4; t++) { /* no knot within */
            const froe_status status = meet_find(m, &w, 0, 1, t, t + 1);
            assert_true(status == FROE_OK || status == FROE_E_LIMIT);
        }
        assert_true(w.arena.high < w.arena.capacity / 2);
        meet_worker_free(m, &w);
        froe_motion_free(m);
    }
}

/* Chains of cubics would take hours. */
static void wide_numbers_of_cubics_are_refused(void **state) {
    (void)state;
    static scene s;
    static found f;
    for (int wide = 0; wide < 2; wide++) {
        fuzz_source r = {5};
        froe_diagnostic why;
        const froe_moving batch = make(&r, CUBICAL, 2, &s);
        f.count = 0;
        s.at[0] = wide ? 0x1p-1074 : 0x1p-90, s.at[1] = wide ? 0x1p300 : 1;
        froe_motion *m = motion_of(&batch);
        if (wide) {
            assert_int_equal(froe_motion_contacts(m, NULL, found_note, &f, &why), FROE_E_LIMIT);
            assert_string_equal(why.message, "Coordinates of 1375 bits and times of 4 are too wide for contacts along "
                                             "cubics in space.");
        } else {
            assert_int_equal(froe_motion_contacts(m, NULL, found_note, &f, &why), FROE_OK);
        }
        froe_motion_free(m);
    }
}

static froe_status find_with(void *user, const froe_allocator *alloc) {
    static found f;
    static scene s;
    fuzz_source r = {2};
    const froe_moving batch = make(&r, LATTICE, 4, &s);
    froe_contact_options o = froe_contact_defaults();
    froe_motion *m = NULL;
    o.threads = 2;
    f.count = 0;
    froe_status status = motion_in_space(&batch, alloc, &m);
    if (!status) status = froe_motion_contacts(m, &o, found_note, &f, NULL);
    if (!status) assert_true(f.count > 0);
    (void)user;
    froe_motion_free(m);
    return status;
}

static void every_allocation_may_fail(void **state) {
    (void)state;
    assert_true(test_memory_each(find_with, NULL) > 10);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(contacts_are_those_of_linear_programs),
        cmocka_unit_test(contacts_do_not_depend_on_place_size_and_order),
        cmocka_unit_test(boxes_miss_nothing_among_bodies_that_fall_and_turn),
        cmocka_unit_test(touches_of_every_kind_are_told_to_the_instant),
        cmocka_unit_test(neighbours_are_left_out),
        cmocka_unit_test(nasty_coordinates_stay_within_the_arena),
        cmocka_unit_test(wide_numbers_of_cubics_are_refused),
        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
