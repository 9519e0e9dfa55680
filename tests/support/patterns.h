/* patterns.h: which of all possible events one is, by what tells them apart combinatorially.
 *
 * Points are ends (E) of segments, on the left or right, and crossings (I). Two that belong to different segments, or
 * an end and another segment, or the crossings of three segments, come together; which of them was on the left before,
 * which is higher, from which side they come, and in which order the segments cut makes 16 + 24 + 12 + 8 + 12 + 2
 * patterns. */
#ifndef FROE_TESTS_SUPPORT_PATTERNS_H
#define FROE_TESTS_SUPPORT_PATTERNS_H
#include "kinetic/kinetic.h"
#include "kinetic/moving.h"
#include <math.h>

typedef enum pattern_kind { PATTERN_EE, PATTERN_EI, PATTERN_II, PATTERN_ES, PATTERN_III, PATTERN_TURN } pattern_kind;
enum { PATTERN_KINDS = PATTERN_TURN + 1, PATTERN_MOST = 24 };
static const int pattern_counts[PATTERN_KINDS] = {16, 24, 12, 8, 12, 2};
static const char *const pattern_names[PATTERN_KINDS] = {"EE", "EI", "II", "ES", "III", "F"};

typedef struct pattern_counter {
    froe_kinetic *kinetic;
    uint64_t seen[PATTERN_KINDS][PATTERN_MOST], events;
} pattern_counter;

/* The only segment at a vertex; FROE_NONE: there are others. */
static inline uint32_t pattern_segment(const froe_kinetic *k, uint32_t vertex) {
    uint32_t e = k->tree.vertices.data[vertex];
    return e == FROE_NONE || ktree_segment_at(&k->tree, e / 2)->end[e % 2].next != FROE_NONE ? FROE_NONE : e / 2;
}

static inline bool pattern_is_left(const froe_kinetic *k, uint32_t segment, uint32_t vertex) {
    return now_vertex(&k->now, segment, 0) == vertex;
}

static inline bool pattern_is_higher(froe_kinetic *k, name_point p, name_point q) {
    return now_spot_of(&k->now, p).y > now_spot_of(&k->now, q).y;
}

/* The first p of two points is what was on the left. */
static inline int pattern_of_ends(froe_kinetic *k, name_point p, name_point q) {
    uint32_t s = pattern_segment(k, p.a), t = pattern_segment(k, q.a);
    if (s == FROE_NONE || t == FROE_NONE) return -1;
    return pattern_is_left(k, s, p.a) | pattern_is_left(k, t, q.a) << 1 | ktree_before(&k->tree, s, t) << 2 |
           pattern_is_higher(k, p, q) << 3;
}

static inline int pattern_of_end_and_crossing(froe_kinetic *k, name_point p, name_point q) {
    name_point end = name_is_vertex(p) ? p : q, crossing = name_is_vertex(p) ? q : p;
    uint32_t s = pattern_segment(k, end.a);
    if (s == FROE_NONE) return -1;
    int later = ktree_before(&k->tree, crossing.a, s) + ktree_before(&k->tree, (uint32_t)crossing.b, s);
    return pattern_is_left(k, s, end.a) | name_is_vertex(p) << 1 | pattern_is_higher(k, p, q) << 2 | later << 3;
}

static inline int pattern_of_crossings(froe_kinetic *k, name_point p, name_point q) {
    static const int numbers[16] = {[3] = 0, [5] = 1, [6] = 2, [9] = 3, [10] = 4, [12] = 5};
    const uint32_t all[4] = {p.a, (uint32_t)p.b, q.a, (uint32_t)q.b};
    int ranks = 0; /* of the segments of p among all four */
    for (int i = 0; i < 2; i++) {
        int rank = 0;
        for (int j = 0; j < 4; j++) rank += ktree_before(&k->tree, all[j], all[i]);
        ranks |= 1 << rank;
    }
    return 2 * numbers[ranks] + pattern_is_higher(k, p, q);
}

static inline int pattern_of_contact(froe_kinetic *k, const now_claim *c) {
    uint32_t vertex, met = c->p.b == NAME_SEGMENT ? c->p.a : now_met_segment(&k->now, c->p, c->q);
    vertex = c->p.b == NAME_SEGMENT || !name_is_vertex(c->p) ? c->q.a : c->p.a;
    uint32_t s = pattern_segment(k, vertex);
    if (s == FROE_NONE || met == FROE_NONE) return -1;
    return pattern_is_left(k, s, vertex) | ktree_before(&k->tree, s, met) << 1 |
           (now_side(&k->now, met, vertex) > 0) << 2;
}

static inline double pattern_slope(froe_kinetic *k, uint32_t s) {
    now_spot a = now_spot_of(&k->now, (name_point){now_vertex(&k->now, s, 0), NAME_VERTEX});
    now_spot b = now_spot_of(&k->now, (name_point){now_vertex(&k->now, s, 1), NAME_VERTEX});
    return atan2(b.y - a.y, b.x - a.x);
}

/* The order of three by slope is an order of their ranks; the first on the steepest or the last comes first on the one
 * between. */
static inline int pattern_of_three(froe_kinetic *k, name_point p, name_point q) {
    name_point third;
    if (!name_third_crossing(p, q, &third)) return -1;
    uint32_t s[3] = {third.a, (uint32_t)third.b, p.a == third.a || p.a == (uint32_t)third.b ? (uint32_t)p.b : p.a};
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2 - i; j++)
            if (pattern_slope(k, s[j]) > pattern_slope(k, s[j + 1])) {
                uint32_t swap = s[j];
                s[j] = s[j + 1], s[j + 1] = swap;
            }
    int first = ktree_before(&k->tree, s[1], s[0]) + ktree_before(&k->tree, s[2], s[0]),
        second = ktree_before(&k->tree, s[2], s[1]);
    bool way = now_compare(&k->now, name_crossing(s[1], s[0]), name_crossing(s[1], s[2])) < 0;
    return 4 * first + 2 * second + way;
}

static inline bool pattern_count(void *user, const froe_event *event) {
    pattern_counter *counter = user;
    froe_kinetic *k = counter->kinetic;
    const now_claim *c = &k->events.reported;
    static const int kinds[FROE_EVENT_KINDS] = {PATTERN_EE,   PATTERN_EI, PATTERN_II, PATTERN_ES, PATTERN_III,
                                                PATTERN_TURN, -1,         -1,         -1,         -1};
    int kind = kinds[event->kind], pattern = -1;
    if (kind == PATTERN_EE) pattern = pattern_of_ends(k, c->p, c->q);
    if (kind == PATTERN_EI) pattern = pattern_of_end_and_crossing(k, c->p, c->q);
    if (kind == PATTERN_II) pattern = pattern_of_crossings(k, c->p, c->q);
    if (kind == PATTERN_ES) pattern = pattern_of_contact(k, c);
    if (kind == PATTERN_III) pattern = pattern_of_three(k, c->p, c->q);
    if (kind == PATTERN_TURN) pattern = k->now.segments.data[event->objects[0]].turned;
    if (pattern >= 0) counter->seen[kind][pattern]++;
    counter->events++;
    return true;
}

/** Over `most` instants at which something happens, and over a tick between each two now and then. Not FROE_OK: why. */
static inline froe_status following_run(froe_kinetic *k, uint64_t most, pattern_counter *counter,
                                        froe_diagnostic *diag) {
    fuzz_source r = {1};
    froe_status status = froe_kinetic_audit(k, diag);
    counter->kinetic = k;
    for (uint64_t steps = 0; steps < most && !status; steps++) {
        double next = froe_kinetic_next(k), now = froe_kinetic_time(k);
        if (!(next <= MOVING_TIME)) break;
        if (fuzz_int(&r, 0, 7) == 0) {
            status = froe_kinetic_advance(k, now + 0.4 * (next - now), pattern_count, counter, diag);
            if (!status && froe_kinetic_time(k) < next) status = froe_kinetic_audit(k, diag);
        }
        if (!status) status = froe_kinetic_advance(k, next, pattern_count, counter, diag);
        if (!status) status = froe_kinetic_audit(k, diag);
    }
    return status;
}
#endif
