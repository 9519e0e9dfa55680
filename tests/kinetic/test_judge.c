/* test_judge.c: what decides where doubles do not, each stage by itself: integers of 128 bits, of 320, dyadic numbers;
 * beside one another, and against whole numbers (GMP) of the plans as they are written. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "kinetic/motions.h"
#include "kinetic/moving.h"
#include "kinetic/now/near.h"
#include "kinetic/now/straight.h"
#include "oracle/truth.h"

enum { TICKS = 4, QUESTIONS = 35 };

/* -------------------------------------------------------------------- truth -- */

/* (b - a) x (d - c) */
static void turn(truth *g, mpq_t a[2], mpq_t b[2], mpq_t c[2], mpq_t d[2], mpq_t out) {
    mpq_t *t = g->t;
    for (int k = 0; k < 2; k++) mpq_sub(t[k], b[k], a[k]), mpq_sub(t[2 + k], d[k], c[k]);
    mpq_mul(t[4], t[0], t[3]);
    mpq_mul(t[5], t[1], t[2]);
    mpq_sub(out, t[4], t[5]);
}

/* False: parallel. */
static bool locate(truth *g, const now_state *now, name_point p, mpq_t out[2]) {
    if (name_is_vertex(p)) {
        truth_place(g, now->motion, p.a, now->tick, out);
        return true;
    }
    for (int i = 0; i < 4; i++)
        truth_place(g, now->motion, now->segments.data[i < 2 ? p.a : (uint32_t)p.b].end[i % 2], now->tick, g->x[i]);
    turn(g, g->x[0], g->x[1], g->x[2], g->x[3], out[1]);
    if (!mpq_sgn(out[1])) return false;
    turn(g, g->x[0], g->x[2], g->x[2], g->x[3], out[0]);
    mpq_div(out[0], out[0], out[1]);
    for (int k = 0; k < 2; k++) truth_between(g->x[0][k], g->x[1][k], out[0]);
    for (int k = 0; k < 2; k++) mpq_set(out[k], g->x[1][k]);
    return true;
}

static int true_order(truth *g, const now_state *now, name_point p, name_point q, bool both) {
    if (!locate(g, now, p, g->cross[0]) || !locate(g, now, q, g->cross[1])) return POLY_PARALLEL;
    int order = mpq_cmp(g->cross[0][0], g->cross[1][0]);
    if (!order && both) order = mpq_cmp(g->cross[0][1], g->cross[1][1]);
    return (order > 0) - (order < 0);
}

static int true_side(truth *g, const now_state *now, uint32_t segment, uint32_t vertex) {
    for (int i = 0; i < 2; i++) truth_place(g, now->motion, now_vertex(now, segment, i), now->tick, g->x[i]);
    truth_place(g, now->motion, vertex, now->tick, g->x[2]);
    turn(g, g->x[0], g->x[1], g->x[0], g->x[2], g->cross[0][0]);
    return mpq_sgn(g->cross[0][0]);
}

/* ------------------------------------------------------------------- stages -- */

static name_point any_name(const now_state *now, fuzz_source *r) {
    uint32_t n = (uint32_t)now->motion->objects.count, s = (uint32_t)fuzz_int(r, 0, (int)n - 1);
    uint32_t t = (uint32_t)fuzz_int(r, 0, (int)n - 2);
    t += t >= s;
    if (fuzz_int(r, 0, 1)) return name_crossing(s, t);
    return (name_point){now->segments.data[s].end[fuzz_int(r, 0, 1)], NAME_VERTEX};
}

static void check_order(now_state *now, truth *g, name_point p, name_point q) {
    for (int after = 0; after < 2; after++)
        for (int both = 0; both < 2; both++) {
            truth_set_time(g, now->motion, now->tick, after);
            const int expected = true_order(g, now, p, q, both);
            for (int stage = 0; stage < NOW_STAGES; stage++) {
                now->least = (now_stage)stage;
                assert_int_equal(now_judge_order(now, p, q, after, both), expected);
            }
        }
}

static void check_side(now_state *now, truth *g, uint32_t segment, uint32_t vertex) {
    for (int after = 0; after < 2; after++) {
        truth_set_time(g, now->motion, now->tick, after);
        const int expected = true_side(g, now, segment, vertex);
        for (int stage = 0; stage < NOW_STAGES; stage++) {
            now->least = (now_stage)stage;
            assert_int_equal(now_judge_side(now, segment, vertex, after), expected);
        }
    }
}

/* The polynomials behind claims count the same roots; and failures are first where each stage says so. */
static void check_claim(now_state *now, fuzz_source *r, const now_claim *claim, uint64_t *wide_claims) {
    enum { POWER = 20 };
    poly_wide wide;
    poly_exact exact;
    now->least = NOW_SHORT;
    if (now_claim_wide(now, claim, 0, (int64_t)1 << POWER, &wide)) {
        ++*wide_claims;
        now_claim_exact(now, claim, 0, &exact);
        assert_int_equal(wide_sign(&wide), exact_sign(&exact));
        for (int i = 0; i < 4; i++) {
            const int power = fuzz_int(r, 1, POWER - 1);
            const int64_t low = fuzz_int(r, 0, (1 << POWER) - (1 << power));
            int sign[2], changes = wide_variations(&wide, low, power, sign);
            now_claim_exact(now, claim, 0, &exact);
            assert_int_equal(changes, exact_variations(&now->context.arena, &exact, low, power, sign + 1));
            if (!changes) assert_int_equal(sign[0], sign[1]);
        }
    }
    int64_t first[NOW_STAGES];
    for (int stage = 0; stage < NOW_STAGES; stage++) {
        now->least = (now_stage)stage;
        first[stage] = now_first_failure(now, claim);
        assert_true(first[stage] == first[0]);
    }
}

static void check_tick(now_state *now, truth *g, fuzz_source *r, uint64_t *wide_claims) {
    for (int i = 0; i < QUESTIONS; i++) {
        const name_point p = any_name(now, r), q = any_name(now, r);
        const uint32_t segment = (uint32_t)fuzz_int(r, 0, (int)now->motion->objects.count - 1);
        check_order(now, g, p, q);
        if (name_is_vertex(q)) check_side(now, g, segment, q.a);
        now->lost = false;
        if (now_holds(now, &(now_claim){p, q, 0}) > 0 && !now->lost)
            check_claim(now, r, &(now_claim){p, q, 0}, wide_claims);
        const now_claim side = {{segment, NAME_SEGMENT}, q, 1};
        if (name_is_vertex(q) && now_holds(now, &side) > 0) check_claim(now, r, &side, wide_claims);
    }
}

static void check_motion(froe_motion *m, uint64_t seed, uint64_t judged[NOW_STAGES], uint64_t *wide_claims) {
    fuzz_source r = {seed};
    now_state now;
    truth g;
    truth_init(&g);
    assert_int_equal(now_new(m, NULL, &now), FROE_OK);
    for (int i = 0; i < TICKS; i++) {
        now.tick = i ? (int64_t)(fuzz_bits(&r) % (uint64_t)m->last_tick) | 1 : 1;
        check_tick(&now, &g, &r, wide_claims);
    }
    for (int stage = 0; stage < NOW_STAGES; stage++) judged[stage] += now.judged[stage];
    now_free(&now);
    truth_clear(&g);
    froe_motion_free(m);
}

/* At each tick a piece begins near 0, so that its coefficients of s^2 and s^3 are the widest by far. */
static const moving_kind bent = {.name = "bent",
                                 .count = 20,
                                 .grid = 3,
                                 .length = 2,
                                 .speed = 1,
                                 .curved = true,
                                 .cubic = true,
                                 .legs = 8,
                                 .late = 0x1p40,
                                 .tick = MOVING_TIME / 8};

static void all_stages_agree_with_whole_numbers(void **state) {
    (void)state;
    uint64_t judged[NOW_STAGES] = {0}, wide_claims = 0;
    for (size_t i = 0; i < MOVING_KINDS; i++) {
        uint64_t here[NOW_STAGES] = {0};
        check_motion(moving_new(moving_kinds + i, 5, NULL), i + 1, here, &wide_claims);
        for (int stage = 0; stage < NOW_STAGES; stage++) judged[stage] += here[stage];
        assert_true(here[NOW_WIDE] > 0);
    }
    for (uint64_t seed = 1; seed <= 4; seed++) check_motion(moving_new(&bent, seed, NULL), seed, judged, &wide_claims);
    for (int kind = 0; kind < MOTION_KINDS; kind++)
        check_motion(motion_new((motion_kind)kind), (uint64_t)kind + 99, judged, &wide_claims);
    /* a third of the questions begins at each stage; that so many more ended later says how often one was too narrow */
    assert_true(judged[NOW_SHORT] > 3500 && judged[NOW_WIDE] > 3500 && judged[NOW_DYADIC] > 3500);
    assert_true(wide_claims > 400);
}

/* ------------------------------------------------------------ tick by tick -- */

static int64_t last_of(now_state *now, name_point p) {
    if (name_is_vertex(p)) return now_course_last(now, p.a);
    int64_t last = INT64_MAX;
    for (int i = 0; i < 4; i++) {
        const uint32_t segment = i < 2 || p.b < 0 ? p.a : (uint32_t)p.b;
        const int64_t piece = now_course_last(now, now->segments.data[segment].end[i % 2]);
        last = piece < last ? piece : last;
    }
    return last;
}

static int turn_of(now_state *now, name_point p) {
    return name_is_crossing(p) ? now_judge_lines(now, p, true) : 0;
}

/* Counts, too, how often the lines of a crossing turned the other way before the claim failed. */
static void look_at_each_tick(now_state *now, const now_claim *claim, uint64_t found[2]) {
    const int64_t start = now->tick, p = last_of(now, claim->p), q = last_of(now, claim->q), last = p < q ? p : q;
    const int turn[2] = {turn_of(now, claim->p), turn_of(now, claim->q)};
    const int64_t first = now_first_failure(now, claim);
    int64_t tick = NOW_NEVER;
    for (now->tick = start + 2; now->tick <= last && tick == NOW_NEVER; now->tick += 2) {
        const bool turned = turn_of(now, claim->p) != turn[0] || turn_of(now, claim->q) != turn[1];
        const bool fails = now_holds(now, claim) < 0;
        if (turned || fails) tick = now->tick, found[turned]++;
    }
    now->tick = start;
    assert_true(first == tick);
}

static void failures_are_first(void **state) {
    (void)state;
    uint64_t found[2] = {0};
    for (size_t i = 0; i < MOVING_KINDS; i++) {
        moving_kind kind = moving_kinds[i];
        kind.tick = 0.25;
        froe_motion *m = moving_new(&kind, 7, NULL);
        fuzz_source r = {i + 1};
        now_state now;
        assert_int_equal(now_new(m, NULL, &now), FROE_OK);
        for (int j = 0; j < 400; j++) {
            now.tick = fuzz_int(&r, 0, (int)m->last_tick / 2) | 1;
            const name_point p = any_name(&now, &r), q = any_name(&now, &r);
            const now_claim side = {{(uint32_t)fuzz_int(&r, 0, (int)m->objects.count - 1), NAME_SEGMENT}, q, 1};
            now.least = (now_stage)(j % NOW_STAGES);
            now.lost = false;
            if (now_holds(&now, &(now_claim){p, q, 0}) > 0 && !now.lost)
                look_at_each_tick(&now, &(now_claim){p, q, 0}, found);
            if (name_is_vertex(side.q) && now_holds(&now, &side) > 0) look_at_each_tick(&now, &side, found);
        }
        now_free(&now);
        froe_motion_free(m);
    }
    assert_true(found[0] > 1000 && found[1] > 300);
}

/* -------------------------------------------------------------- in doubles -- */

/* A sign of which the polynomial in doubles is sure is that of whole numbers, at ticks that follow one another closely
 * around one at which the claim fails. Counts signs that are sure and that are not. */
static void look_near_failure(now_state *now, const now_claim *claim, fuzz_source *r, uint64_t seen[2]) {
    const int64_t start = now->tick, p = last_of(now, claim->p), q = last_of(now, claim->q), last = p < q ? p : q;
    const int64_t fails = now_first_failure(now, claim), around = fails == NOW_NEVER ? last : fails;
    near_claim near;
    near_find(now, claim, 0, (double)(last - start), &near);
    for (int i = -8; i <= 8; i++) {
        const int64_t tick = around + (fuzz_int(r, 0, 1) ? i : i * (int64_t)1000003);
        const int sign = near_sign_at(&near.value, (double)(tick - start) / (double)(last - start));
        if (tick < start || tick > last) continue;
        seen[!sign]++;
        if (!sign) continue;
        poly_exact exact;
        num_arena *arena = &now->context.arena;
        now_claim_exact(now, claim, 0, &exact);
        num_dyadic y = exact.c[exact.degree], at = num_dyadic_scaled(arena, 1, (uint64_t)(tick - start), 0);
        for (int j = exact.degree - 1; j >= 0; j--) y = num_dyadic_add(arena, num_dyadic_mul(arena, y, at), exact.c[j]);
        assert_int_equal(sign, y.sign);
    }
}

/* Asked at ticks in any order, and of a state that was asked nothing before. Threads know less of what was asked. */
static void places_in_doubles_do_not_depend_on_what_was_asked(void **state) {
    (void)state;
    for (size_t i = 0; i < MOVING_KINDS; i++) {
        froe_motion *m = moving_new(moving_kinds + i, 13, NULL);
        fuzz_source r = {i + 1};
        now_state asked, fresh;
        assert_int_equal(now_new(m, NULL, &asked), FROE_OK);
        for (int j = 0; j < 40; j++) {
            assert_int_equal(now_new(m, NULL, &fresh), FROE_OK);
            asked.tick = fresh.tick = (int64_t)(fuzz_bits(&r) % (uint64_t)m->last_tick) | 1;
            for (uint32_t v = 0; v < m->plans.count; v++) {
                const now_spot a = now_vertex_spot(&asked, v), b = now_vertex_spot(&fresh, v);
                assert_true(a.x == b.x && a.y == b.y && a.error == b.error);
            }
            now_free(&fresh);
        }
        now_free(&asked);
        froe_motion_free(m);
    }
}

/* An order of two points, and the side of a segment on which the second is, at a tick of the first half. */
static void draw_claims(now_state *now, fuzz_source *r, now_claim *order, now_claim *side) {
    const froe_motion *m = now->motion;
    now->tick = (int64_t)(fuzz_bits(r) % (uint64_t)(m->last_tick / 2)) | 1;
    const name_point p = any_name(now, r), q = any_name(now, r);
    *order = (now_claim){p, q, 0};
    *side = (now_claim){{(uint32_t)fuzz_int(r, 0, (int)m->objects.count - 1), NAME_SEGMENT}, q, 1};
}

static void sure_signs_in_doubles_are_right(void **state) {
    (void)state;
    uint64_t seen[2] = {0};
    for (size_t i = 0; i < MOVING_KINDS; i++) {
        moving_kind kind = moving_kinds[i];
        kind.tick = 0x1p-45; /* so short that neighbouring ticks differ by the last places of doubles */
        froe_motion *m = moving_new(&kind, 11, NULL);
        fuzz_source r = {i + 1};
        now_state now;
        assert_int_equal(now_new(m, NULL, &now), FROE_OK);
        for (int j = 0; j < 300; j++) {
            now_claim order, side;
            draw_claims(&now, &r, &order, &side);
            now.lost = false;
            if (now_holds(&now, &order) > 0 && !now.lost) look_near_failure(&now, &order, &r, seen);
            if (name_is_vertex(side.q) && now_holds(&now, &side) > 0) look_near_failure(&now, &side, &r, seen);
        }
        now_free(&now);
        froe_motion_free(m);
    }
    assert_true(seen[0] > 10000 && seen[1] > 3000);
}

/* What is told of straight flight in doubles is so by whole numbers: the claim holds two ticks before the one that is
 * told, and not then; or it holds at the last tick and at others. Counts both. */
static void look_at_straight_flight(now_state *now, const now_claim *claim, fuzz_source *r, uint64_t seen[2]) {
    const int64_t start = now->tick, p = last_of(now, claim->p), q = last_of(now, claim->q), last = (p < q ? p : q) | 1;
    int64_t tick;
    if (last - start < 8 || !straight_first_failure(now, claim, &tick)) return;
    const bool never = tick == NOW_NEVER;
    const int64_t good = never ? last - 2 : tick - 2;
    seen[never]++;
    for (int i = 0; i < 4; i++) {
        now->tick = i ? start + (int64_t)(fuzz_bits(r) % (uint64_t)(good - start + 1)) : good;
        assert_true(now->tick < start || now_holds(now, claim) > 0);
    }
    now->tick = tick;
    assert_true(never || now_holds(now, claim) < 0);
    now->tick = start;
}

static void straight_flight_in_doubles_is_right(void **state) {
    (void)state;
    uint64_t seen[4] = {0};
    for (size_t i = 0; i < 3 * MOVING_KINDS; i++) {
        moving_kind kind = moving_kinds[i / 3];
        kind.tick = ldexp(1, -25 - 9 * (int)(i % 3)); /* at last neighbouring ticks differ by last places */
        froe_motion *m = moving_new(&kind, 17, NULL);
        fuzz_source r = {i + 1};
        now_state now;
        assert_int_equal(now_new(m, NULL, &now), FROE_OK);
        for (int j = 0; j < 300; j++) {
            now_claim order, side;
            draw_claims(&now, &r, &order, &side);
            look_at_straight_flight(&now, &order, &r,
                                    seen + 2 * (name_is_crossing(order.p) != name_is_crossing(order.q)));
            if (name_is_vertex(side.q)) look_at_straight_flight(&now, &side, &r, seen);
        }
        now_free(&now);
        froe_motion_free(m);
    }
    for (int i = 0; i < 4; i++) assert_true(seen[i] > 300);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_stages_agree_with_whole_numbers), cmocka_unit_test(failures_are_first),
        cmocka_unit_test(places_in_doubles_do_not_depend_on_what_was_asked),
        cmocka_unit_test(sure_signs_in_doubles_are_right), cmocka_unit_test(straight_flight_in_doubles_is_right)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
