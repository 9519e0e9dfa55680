/* test_turning.c: bodies that turn in the plane, exactly on circles: contacts and partitions against whole numbers and
 * rationals, and partitions against those made from scratch, after every event. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "kinetic/beside.h"
#include "kinetic/now/near.h"
#include "kinetic/now/turning.h"
#include "oracle/touching.h"
#include "support/contacts.h"
#include "support/memory.h"
#include "support/patterns.h"
#include "support/sanitized.h"
#include "support/turning.h"

/* Seeds below 0: with an augmented partition. */
static froe_kinetic *start(froe_motion *m, int seed) {
    froe_kinetic_options o = froe_kinetic_defaults();
    froe_kinetic *k = NULL;
    froe_diagnostic why = {0};
    o.seed = (uint64_t)abs(seed);
    o.augmented = seed < 0;
    if (froe_kinetic_new(m, &o, NULL, &k, &why)) fail_msg("%s", why.message);
    return k;
}

static void advance(froe_kinetic *k, double time) {
    froe_diagnostic why = {0};
    if (froe_kinetic_advance(k, time, NULL, NULL, &why)) fail_msg("%s", why.message);
}

/* --------------------------------------------------------------------- places -- */

static num_dyadic dyadic_sum(num_arena *arena, num_dyadic a, num_dyadic b) {
    return num_dyadic_add(arena, a, b);
}

/* (x w0 - x0 w)^2 + (y w0 - y0 w)^2  is  |v|^2 w^2 w0^2,  for the centre (x0, y0) / w0. */
static void assert_on_circle(num_arena *arena, const exact_point *p, const exact_point *c, const double *v) {
    arena->top = 0;
    num_dyadic off[2], sum = {0}, arm = {0};
    const num_dyadic at[2] = {p->x.c[0], p->y.c[0]}, from[2] = {c->x.c[0], c->y.c[0]};
    for (int k = 0; k < 2; k++) {
        off[k] =
            num_dyadic_sub(arena, num_dyadic_mul(arena, at[k], c->w.c[0]), num_dyadic_mul(arena, from[k], p->w.c[0]));
        const num_dyadic x = num_dyadic_from(arena, v[k]);
        sum = dyadic_sum(arena, sum, num_dyadic_mul(arena, off[k], off[k]));
        arm = dyadic_sum(arena, arm, num_dyadic_mul(arena, x, x));
    }
    const num_dyadic weight = num_dyadic_mul(arena, p->w.c[0], c->w.c[0]);
    assert_int_equal(num_dyadic_compare(sum, num_dyadic_mul(arena, arm, num_dyadic_mul(arena, weight, weight))), 0);
}

static void places_stay_on_their_circles_exactly(void **state) {
    (void)state;
    num_arena points = {0}, room = {0};
    const froe_allocator alloc = support_allocator(NULL);
    assert_int_equal(num_arena_reserve(&alloc, &points, POLY_LIMBS), FROE_OK);
    assert_int_equal(num_arena_reserve(&alloc, &room, POLY_LIMBS), FROE_OK);
    for (size_t i = 0; i < TURNING_KINDS; i++) {
        froe_motion *m = turning_new(turning_kinds + i, 5);
        for (uint32_t v = 0; v < froe_motion_vertex_count(m); v++) {
            if (froe_motion_vertex_body(m, v) == FROE_NONE) continue;
            for (int64_t tick = 1; tick < m->last_tick; tick += m->last_tick / 7) {
                motion_piece piece = motion_piece_at(m, v, tick), centre = piece;
                exact_point p, c;
                points.top = 0, centre.corner = NULL;
                exact_vertex_at(&points, m, &piece, tick, &p);
                exact_vertex_at(&points, m, &centre, tick, &c);
                assert_on_circle(&room, &p, &c, piece.corner);
            }
        }
        froe_motion_free(m);
    }
    num_arena_free(&alloc, &points), num_arena_free(&alloc, &room);
}

static void places_in_doubles_are_near_those_of_rationals(void **state) {
    (void)state;
    mpq_t t, at[3];
    mpq_inits(t, at[0], at[1], at[2], NULL);
    for (size_t i = 0; i < TURNING_KINDS; i++) {
        froe_motion *m = turning_new(turning_kinds + i, 6);
        for (uint32_t v = 0; v < froe_motion_vertex_count(m); v++)
            for (double time = 0; time <= MOVING_TIME; time += 5.3) {
                double near[2];
                mpq_set_d(t, time);
                oracle_corner(m, v, t, at);
                assert_true(froe_motion_position(m, v, time, near));
                for (int k = 0; k < 2; k++) assert_true(fabs(mpq_get_d(at[k]) - near[k]) <= 1e-11);
            }
        froe_motion_free(m);
    }
    mpq_clears(t, at[0], at[1], at[2], NULL);
}

/* ------------------------------------------------------------------- contacts -- */

static void contacts_are_those_of_exact_brute_force(void **state) {
    (void)state;
    judged_contacts t = {0};
    for (size_t i = 0; i < TURNING_KINDS; i++) {
        turning_kind few = turning_kinds[i];
        few.bodies = 2, few.each = 2, few.free = few.free ? 1 : 0;
        froe_motion *m = turning_new(&few, i + 1);
        judge_contacts(m, &t);
        froe_motion_free(m);
    }
    assert_true(t.contacts > 20 && t.instants > 0 && t.lasting > 20);
}

/* ----------------------------------------------------------------- partitions -- */

static void trees_are_those_made_from_scratch_after_every_event(void **state) {
    (void)state;
    const uint64_t most = SANITIZED ? 10 : 35;
    pattern_counter counter = {0};
    for (size_t i = 0; i < TURNING_KINDS; i++)
        for (int seed = -1; seed <= 1; seed += 2) {
            froe_motion *m = turning_new(turning_kinds + i, 3);
            froe_kinetic *k = start(m, seed);
            froe_diagnostic why = {0};
            if (following_run(k, most, &counter, &why))
                fail_msg("%s %d at %.12g: %s", turning_kinds[i].name, seed, froe_kinetic_time(k), why.message);
            const froe_kinetic_stats s = froe_kinetic_statistics(k);
            assert_int_equal(s.stuck, 0);
            if (!turning_kinds[i].quarters && !turning_kinds[i].still) assert_int_equal(s.restarts, 0);
            froe_kinetic_free(k);
            froe_motion_free(m);
        }
    assert_true(counter.events >= TURNING_KINDS * 2 * most * 9 / 10);
    for (int j = 0; j < pattern_counts[PATTERN_TURN] && !SANITIZED; j++) assert_true(counter.seen[PATTERN_TURN][j]);
}

/* The exact polynomial at a share of the time, by its sign. */
static int exact_sign_at(num_arena *arena, const poly_exact *p, int64_t ticks) {
    const num_dyadic s = num_dyadic_scaled(arena, 1, (uint64_t)ticks, 0);
    num_dyadic y = p->c[p->degree];
    for (int i = p->degree - 1; i >= 0; i--) y = num_dyadic_add(arena, num_dyadic_mul(arena, y, s), p->c[i]);
    return y.sign;
}

/* Where polynomials of balls are sure of a sign, it is that of the exact one. */
static void certificates_in_doubles_have_the_signs_of_exact_ones(void **state) {
    (void)state;
    enum { SHARES = 16 };
    uint64_t sure = 0, unsure = 0;
    for (size_t i = 0; i < TURNING_KINDS; i++) {
        froe_motion *m = turning_new(turning_kinds + i, 8);
        froe_kinetic *k = start(m, 1);
        now_state *now = &k->now;
        const int64_t span = m->last_tick / 8; /* within a piece */
        for (size_t c = 0; c < k->certs.all.count; c++) {
            const now_claim claim = k->certs.all.data[c].claim;
            near_poly near;
            poly_exact exact;
            if (k->certs.all.data[c].kind > CERT_TURN || !now_is_turning_claim(now, &claim)) continue;
            if (!near_find_turning(now, &claim, 0, (double)span, &near)) continue;
            now_claim_exact(now, &claim, 0, &exact);
            const size_t top = now->context.arena.top;
            for (int j = 0; j <= SHARES; j++, now->context.arena.top = top) {
                const int64_t ticks = span / SHARES * j;
                const int sign = near_sign_at(&near, (double)ticks / (double)span);
                if (sign) assert_int_equal(sign, exact_sign_at(&now->context.arena, &exact, ticks));
                sure += sign != 0, unsure += !sign;
            }
        }
        froe_kinetic_free(k);
        froe_motion_free(m);
    }
    assert_true(sure > 5000 && unsure < sure / 20);
}

/* The tree node for node, what is next to points and rays, and the order from an eye. */
static bool look_beside(beside *b, fuzz_source *r, const turning_kind *kind) {
    static present p;
    double at[4][2];
    beside_look(b, &p);
    present_build(&p);
    bool good = beside_tree(b, &p);
    for (int i = 0; i < 6 && good; i++) {
        for (int n = 0; n < 4; n++)
            for (int c = 0; c < 2; c++) at[n][c] = fuzz_int(r, -kind->grid, 2 * kind->grid) + 0.5;
        good = beside_locate(b, &p, at[0]) && beside_ray(b, &p, at[0], at[1]) &&
               (i % 3 || beside_order(b, &p, at[2], at[3]));
    }
    present_clear(&p);
    return good;
}

static void trees_and_answers_are_those_of_rationals(void **state) {
    (void)state;
    beside_counts all = {0};
    for (size_t i = 0; i < TURNING_KINDS; i++) {
        const turning_kind *kind = turning_kinds + i;
        fuzz_source r = {i + 1};
        froe_motion *m = turning_new(kind, 7);
        beside b = {.motion = m, .kinetic = start(m, 3)};
        for (int step = 0; step < (SANITIZED ? 4 : 12); step++) {
            const double next = froe_kinetic_next(b.kinetic), now = froe_kinetic_time(b.kinetic);
            if (!(next <= MOVING_TIME)) break;
            advance(b.kinetic, step % 3 == 2 ? now + 0.4 * (next - now) : next);
            if (!look_beside(&b, &r, kind))
                fail_msg("%s at %.17g: %s", kind->name, froe_kinetic_time(b.kinetic), b.why);
        }
        all.trees += b.counts.trees, all.hits += b.counts.hits, all.pairs += b.counts.pairs;
        froe_kinetic_free(b.kinetic);
        froe_motion_free(m);
    }
    assert_true(all.trees >= 9 * 4 && all.hits > all.trees && all.pairs > all.trees);
}

/* ------------------------------------------------------------------- known cases -- */

typedef struct meeting {
    froe_kinetic *kinetic;
    double instant[2];
    int contacts;
} meeting;

static bool note_contact(void *user, const froe_event *event) {
    meeting *n = user;
    if (event->kind != FROE_EVENT_CONTACT && event->kind != FROE_EVENT_BATCH) return true;
    if (!n->contacts++) assert_int_equal(froe_kinetic_instant(n->kinetic, n->instant, NULL), FROE_OK);
    return true;
}

/* A hand of length 5 that goes from 3 o'clock to 12 o'clock in 64 meets the point (3, 4), which is on its circle, with
 * its tip, where the tangent of half of the angle, 4 / (5 + 3), is the share u of the way by tan(45 degrees) = 1: u =
 * 1/2. From that on the hand is beyond it. A wall that ends in (3, 4) is met then. */
static void the_tip_of_a_hand_passes_a_place_on_its_circle_at_its_instant(void **state) {
    (void)state;
    const double half = 0.70710678118654752440; /* sin 45 = cos 45: in proportion to (u, 1), it ends with (1, 1) */
    const double times[] = {0, MOVING_TIME}, at[] = {0, 0, 0, 0}, turns[] = {0, 1, half, half};
    froe_motion_options w = froe_motion_defaults();
    froe_motion *m = NULL;
    w.begin = 0, w.end = MOVING_TIME;
    assert_int_equal(froe_motion_new(&w, NULL, &m, NULL), FROE_OK);
    froe_body body = froe_body_defaults();
    body.count = 2, body.times = times, body.coords = at, body.turns = turns;
    uint32_t id;
    assert_int_equal(froe_motion_add_body(m, &body, &id, NULL), FROE_OK);
    const size_t starts[] = {0, 1, 2, 3, 4};
    const double zeros[4] = {0}, xy[] = {0, 0, 5, 0, 3, 4, 9, 4};
    froe_moving b = froe_moving_defaults();
    b.vertex_count = 4, b.count = 2, b.starts = starts, b.times = zeros, b.coords = xy;
    b.bodies = (const uint32_t[]){id, id, FROE_NONE, FROE_NONE};
    assert_int_equal(froe_motion_add(m, &b, NULL), FROE_OK);
    static found f;
    found_in(m, NULL, &f);
    assert_int_equal(f.count, 1);
    assert_true(f.list[0].instant);
    meeting n = {.kinetic = start(m, 1)};
    assert_int_equal(froe_kinetic_advance(n.kinetic, MOVING_TIME, note_contact, &n, NULL), FROE_OK);
    assert_int_equal(n.contacts, 1);
    /* q = (u half, 1 - u + u half): tan of half of the angle is 1/2 where u half = (1 - u + u half) / 2 */
    const double u = 0.5 / (0.5 * half + 0.5), expected = u * MOVING_TIME;
    assert_true(fabs(n.instant[0] - expected) < 1e-12 && fabs(f.list[0].begin[0] - expected) < 1e-12);
    assert_true(n.instant[0] <= f.list[0].begin[1] && f.list[0].begin[0] <= n.instant[1]);
    froe_kinetic_free(n.kinetic);
    froe_motion_free(m);
}

static void bad_bodies_are_refused_by_name(void **state) {
    (void)state;
    froe_motion *m = turning_new(turning_kinds, 1);
    froe_diagnostic why;
    const double times[] = {0, MOVING_TIME}, at[] = {0, 0, 0, 0};
    froe_body b = froe_body_defaults();
    b.count = 2, b.times = times, b.coords = at, b.turns = (const double[]){0, 1, 0.5, 0.5};
    assert_int_equal(froe_motion_add_body(m, &b, NULL, &why), FROE_E_INPUT);
    assert_string_equal(why.message, "body 4: The pair of turn 1, 0.5 0.5, has not the length 1.");
    b.turns = (const double[]){0, 1, 1, 0};
    assert_int_equal(froe_motion_add_body(m, &b, NULL, &why), FROE_E_INPUT);
    assert_string_equal(why.message, "body 4: Turns 0 and 1 are half a turn apart, which does not tell the way.");
    froe_moving two = froe_moving_defaults();
    const double xy[4] = {0, 0, 1, 1}, zeros[2] = {0};
    two.vertex_count = 2, two.count = 1, two.starts = (const size_t[]){0, 1, 2}, two.times = zeros, two.coords = xy;
    two.bodies = (const uint32_t[]){0, 1};
    assert_int_equal(froe_motion_add(m, &two, &why), FROE_E_INPUT);
    assert_string_equal(why.message, "segment 0: Its ends do not belong to the same body.");
    froe_kinetic *k = start(m, 1);
    assert_int_equal(froe_kinetic_replan(k, 3, 1, zeros, xy, NULL, NULL, &why), FROE_E_UNSUPPORTED);
    assert_string_equal(why.message, "Vertex 3 flies with body 0, and takes no plan of its own.");
    assert_int_equal(froe_kinetic_audit(k, NULL), FROE_OK);
    froe_kinetic_free(k);
    froe_motion_free(m);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(places_stay_on_their_circles_exactly),
        cmocka_unit_test(places_in_doubles_are_near_those_of_rationals),
        cmocka_unit_test(contacts_are_those_of_exact_brute_force),
        cmocka_unit_test(trees_are_those_made_from_scratch_after_every_event),
        cmocka_unit_test(certificates_in_doubles_have_the_signs_of_exact_ones),
        cmocka_unit_test(trees_and_answers_are_those_of_rationals),
        cmocka_unit_test(the_tip_of_a_hand_passes_a_place_on_its_circle_at_its_instant),
        cmocka_unit_test(bad_bodies_are_refused_by_name),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
