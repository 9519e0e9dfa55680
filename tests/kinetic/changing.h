/* changing.h: a partition in motion whose segments come, go, and get other plans, several at one instant, beside the
 * oracle. A number or bytes say what happens. */
#ifndef FROE_TESTS_KINETIC_CHANGING_H
#define FROE_TESTS_KINETIC_CHANGING_H
#include "kinetic/beside.h"
#include "support/fuzz.h"

enum { CHANGING_TIME = 16, CHANGING_MOST = 24 };

typedef struct changing_counts {
    uint64_t replans, jumps, births, deaths, audits;
} changing_counts;

/** Decisions: of `random`, or if there are `data` of these, and then zeros. */
typedef struct changing {
    fuzz_source random;
    const uint8_t *data;
    size_t size;
    int grid, questions;
    bool chained, curved, cubic, augmented;
    beside all;
    changing_counts counts;
} changing;

static inline int changing_int(changing *c, int low, int high) {
    if (!c->data) return fuzz_int(&c->random, low, high);
    if (!c->size) return low;
    c->size--;
    return low + *c->data++ % (high - low + 1);
}

/* ----------------------------------------------------------------------- changes -- */

typedef struct changing_plan {
    size_t count;
    double times[4], xy[8], controls[8], seconds[8];
} changing_plan;

/* From `begin` on, or a little before, until the end of the window. */
static inline void changing_draw(changing *c, double begin, changing_plan *plan) {
    const int pieces = changing_int(c, 0, 3);
    plan->count = (size_t)pieces + 1;
    double time = begin - (changing_int(c, 0, 3) == 0);
    for (size_t i = 0; i < plan->count; i++) {
        plan->times[i] = time;
        time = (i ? time : begin) + 0.5 * changing_int(c, 1, 6);
        if (i + 2 == plan->count && time < CHANGING_TIME) time = CHANGING_TIME + changing_int(c, 0, 1);
        for (size_t k = 0; k < 2; k++) {
            plan->xy[2 * i + k] = changing_int(c, 0, c->grid);
            const bool straight = !c->curved || changing_int(c, 0, 1);
            plan->controls[2 * i + k] = straight ? (double)NAN : changing_int(c, 0, c->grid);
        }
        if (isnan(plan->controls[2 * i]) || isnan(plan->controls[2 * i + 1]))
            plan->controls[2 * i] = plan->controls[2 * i + 1] = (double)NAN;
        const bool cubic = c->cubic && !isnan(plan->controls[2 * i]) && changing_int(c, 0, 1);
        for (size_t k = 0; k < 2; k++) plan->seconds[2 * i + k] = cubic ? changing_int(c, 0, c->grid) : (double)NAN;
    }
}

/* Adds some segments. Their first vertex may be the last one of the segment before. */
static inline void changing_add(changing *c, int count, double begin, bool later) {
    size_t starts[2 * PRESENT_MOST + 1] = {0};
    static const size_t most = 4;
    double times[2 * PRESENT_MOST * 4], xy[4 * PRESENT_MOST * 4], controls[4 * PRESENT_MOST * 4];
    double seconds[4 * PRESENT_MOST * 4];
    double births[PRESENT_MOST], deaths[PRESENT_MOST];
    uint32_t vertices[2 * PRESENT_MOST];
    for (uint32_t s = 0; s < (uint32_t)count; s++) {
        for (uint32_t e = 0; e < 2; e++) {
            changing_plan plan = {0};
            changing_draw(c, begin, &plan);
            const size_t at = starts[2 * s + e];
            for (size_t i = 0; i < plan.count && i < most; i++) {
                times[at + i] = plan.times[i];
                for (size_t k = 0; k < 2; k++) {
                    xy[2 * (at + i) + k] = plan.xy[2 * i + k], controls[2 * (at + i) + k] = plan.controls[2 * i + k];
                    seconds[2 * (at + i) + k] = plan.seconds[2 * i + k];
                }
            }
            starts[2 * s + e + 1] = at + plan.count;
            vertices[2 * s + e] = 2 * s + e;
        }
        if (c->chained && s && changing_int(c, 0, 1)) vertices[2 * s] = 2 * s - 1;
        births[s] = later && changing_int(c, 0, 2) == 0 ? begin + changing_int(c, 1, 4) : begin;
        deaths[s] = later && changing_int(c, 0, 2) == 0 ? births[s] + changing_int(c, 0, 4) : (double)INFINITY;
        c->counts.births++;
    }
    froe_moving b = froe_moving_defaults();
    b.vertex_count = 2 * (size_t)count, b.count = (size_t)count;
    b.starts = starts, b.times = times, b.coords = xy, b.controls = controls;
    b.second_controls = seconds, b.vertices = vertices, b.births = births, b.deaths = deaths;
    if (froe_motion_add(c->all.motion, &b, NULL)) abort();
}

/* Another plan for a vertex, which jumps, or goes on from where it is. */
static inline bool changing_replan(changing *c) {
    const uint32_t vertex = (uint32_t)changing_int(c, 0, (int)froe_motion_vertex_count(c->all.motion) - 1);
    const double now = froe_kinetic_time(c->all.kinetic);
    changing_plan plan = {0};
    froe_diagnostic why = {0};
    changing_draw(c, now, &plan);
    double at[2];
    if (changing_int(c, 0, 1) && froe_motion_position(c->all.motion, vertex, now, at)) {
        plan.times[0] = now;
        for (size_t k = 0; k < 2; k++) plan.xy[k] = at[k];
    } else {
        c->counts.jumps++;
    }
    c->counts.replans++;
    if (froe_kinetic_replan(c->all.kinetic, vertex, plan.count, plan.times, plan.xy, plan.controls, plan.seconds, &why))
        return BESIDE_FAIL(&c->all, "replan of vertex %u: %s", vertex, why.message);
    return true;
}

static inline bool changing_change(changing *c) {
    const uint32_t count = (uint32_t)froe_motion_object_count(c->all.motion);
    const int what = changing_int(c, 0, 9);
    if (what < 6) return changing_replan(c);
    if (what < 8 && count < CHANGING_MOST) {
        changing_add(c, 1, froe_kinetic_time(c->all.kinetic), true);
        return froe_kinetic_update(c->all.kinetic, NULL) == FROE_OK || BESIDE_FAIL(&c->all, "update");
    }
    const uint32_t gone = (uint32_t)changing_int(c, 0, (int)count - 1);
    c->all.dead[gone] = true;
    c->counts.deaths++;
    return froe_kinetic_remove(c->all.kinetic, gone, NULL) == FROE_OK || BESIDE_FAIL(&c->all, "remove");
}

/* On the lattice, or where a vertex is. */
static inline void changing_spot(changing *c, double at[2]) {
    const uint32_t vertex = (uint32_t)changing_int(c, 0, (int)froe_motion_vertex_count(c->all.motion) - 1);
    const int what = changing_int(c, 0, 3);
    const bool there =
        froe_motion_position(c->all.motion, vertex, froe_kinetic_time(c->all.kinetic), at) && present_takes(at);
    for (int k = 0; k < 2; k++)
        if (!there || what > k) at[k] = 0.5 * changing_int(c, -1, 2 * c->grid + 1);
}

static inline bool changing_compare(changing *c) {
    present p;
    froe_diagnostic why = {0};
    beside_look(&c->all, &p);
    present_build(&p);
    bool good = beside_tree(&c->all, &p);
    c->counts.audits++;
    if (good && froe_kinetic_audit(c->all.kinetic, &why)) good = BESIDE_FAIL(&c->all, "audit: %s", why.message);
    for (int i = 0; i < c->questions && good; i++) {
        double at[2], to[2];
        changing_spot(c, at), changing_spot(c, to);
        good = beside_locate(&c->all, &p, at) && beside_ray(&c->all, &p, at, to);
        if (good && i % 4 == 0) good = beside_order(&c->all, &p, at, to);
    }
    if (good && c->questions) good = beside_snapshot(&c->all, &p);
    present_clear(&p);
    return good;
}

/* --------------------------------------------------------------------------- runs -- */

/* Some changes at one instant; then to the next event, or on a little. */
static inline bool changing_step(changing *c) {
    const int changes = changing_int(c, 0, 3);
    bool good = true;
    for (int i = 0; i < changes && good; i++) {
        good = changing_change(c);
        if (good && changing_int(c, 0, 1)) good = changing_compare(c);
    }
    if (!good || !changing_compare(c)) return false;
    double next = froe_kinetic_next(c->all.kinetic);
    if (changing_int(c, 0, 3) == 0 || !(next <= CHANGING_TIME))
        next = froe_kinetic_time(c->all.kinetic) + 0.25 * changing_int(c, 1, 4);
    if (next > CHANGING_TIME) next = CHANGING_TIME;
    return froe_kinetic_time(c->all.kinetic) >= next ||
           froe_kinetic_advance(c->all.kinetic, next, NULL, NULL, NULL) == FROE_OK ||
           BESIDE_FAIL(&c->all, "advance to %g", next);
}

/** A motion of a kind that is drawn, through so many steps. False: `why` says what is wrong. */
static inline bool changing_run(changing *c, int steps) {
    froe_motion_options window = froe_motion_defaults();
    froe_kinetic_options options = froe_kinetic_defaults();
    window.begin = 0, window.end = CHANGING_TIME;
    window.tick = (double[]){0, 1, 0.5, 0x1p-8}[changing_int(c, 0, 3)];
    c->grid = changing_int(c, 2, 9);
    c->chained = changing_int(c, 0, 2) == 0;
    const int degree = changing_int(c, 1, 4);
    c->curved = degree > 2, c->cubic = degree == 3;
    options.augmented = c->augmented = changing_int(c, 0, 1);
    options.seed = (uint64_t)changing_int(c, 0, 255);
    c->all.why[0] = 0;
    memset(c->all.dead, 0, sizeof c->all.dead);
    if (froe_motion_new(&window, NULL, &c->all.motion, NULL)) abort();
    changing_add(c, changing_int(c, 1, 8), 0, changing_int(c, 0, 1));
    if (froe_kinetic_new(c->all.motion, &options, NULL, &c->all.kinetic, NULL)) abort();
    bool good = true;
    for (int i = 0; i < steps && good && (!c->data || c->size); i++) good = changing_step(c);
    if (good && froe_kinetic_statistics(c->all.kinetic).stuck)
        good = BESIDE_FAIL(&c->all, "a tick could not be settled");
    froe_kinetic_free(c->all.kinetic);
    froe_motion_free(c->all.motion);
    return good;
}
#endif
