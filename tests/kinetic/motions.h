/* motions.h: made-up motions for tests: n segments of two vertices each, in the window 0 .. 8. */
#ifndef FROE_TESTS_KINETIC_MOTIONS_H
#define FROE_TESTS_KINETIC_MOTIONS_H
#include "support/fuzz.h"
#include <froe/kinetic.h>

typedef enum motion_kind {
    MOTION_RANDOM,    /* anywhere in the unit square, in 1 to 3 pieces between random times */
    MOTION_QUADRATIC, /* the same on parabolas */
    MOTION_DECIMAL,   /* decimal coordinates and times, as in tracks */
    MOTION_LATTICE,   /* small whole numbers: everything happens at once */
    MOTION_PARABOLIC, /* the same on parabolas */
    MOTION_RIGID,     /* one translation for all: contacts that last */
    MOTION_SLIDING,   /* along one line: overlaps for good, ends that meet */
    MOTION_POINTS,    /* segments without length, some of the time or always */
    MOTION_LIVES,     /* lattice motions that begin and end at whole times */
    MOTION_CUBIC,     /* as MOTION_QUADRATIC, on cubics, too */
    MOTION_CUBICAL,   /* as MOTION_PARABOLIC, on cubics, too */
    MOTION_KINDS
} motion_kind;

enum { MOTION_MOST = 24, MOTION_KNOTS = 4 };

typedef struct motion_arrays {
    size_t starts[2 * MOTION_MOST + 1];
    double times[2 * MOTION_MOST * MOTION_KNOTS], xy[4 * MOTION_MOST * MOTION_KNOTS];
    double controls[4 * MOTION_MOST * MOTION_KNOTS], seconds[4 * MOTION_MOST * MOTION_KNOTS];
    double births[MOTION_MOST], deaths[MOTION_MOST];
} motion_arrays;

static inline double motion_number(fuzz_source *r, motion_kind kind) {
    switch (kind) {
    case MOTION_RANDOM:
        return fuzz_unit(r);
    case MOTION_QUADRATIC:
    case MOTION_CUBIC:
        return fuzz_int(r, -4096, 4096) * 0x1p-12;
    case MOTION_DECIMAL:
        return fuzz_int(r, 0, 2000) * 0.01;
    case MOTION_POINTS:
        return fuzz_int(r, 0, 2);
    default:
        return fuzz_int(r, 0, 4);
    }
}

/* Times of one plan: 0, some between, 8. Returns their number. */
static inline size_t motion_times(fuzz_source *r, motion_kind kind, double *times) {
    size_t count = 0;
    int step = 0;
    times[count++] = 0;
    while (count + 1 < MOTION_KNOTS && kind != MOTION_RIGID) {
        step += fuzz_int(r, 1, 4);
        double t = kind == MOTION_RANDOM ? step + 0.5 * fuzz_unit(r) : kind == MOTION_DECIMAL ? step * 0.7 : step;
        if (t >= 8) break;
        times[count++] = t;
    }
    times[count++] = 8;
    return count;
}

static inline void motion_place(fuzz_source *r, motion_kind kind, const motion_arrays *a, size_t at, double out[2]) {
    for (int k = 0; k < 2; k++) out[k] = motion_number(r, kind);
    if (kind == MOTION_SLIDING) out[1] = 2 * out[0] + 1;
    if (kind == MOTION_RIGID && at % 2) { /* behind a whole number of others, so pieces are 0 -> 8 */
        out[0] = a->xy[2 * at - 2] + 3;
        out[1] = a->xy[2 * at - 1] - 1;
    }
    if (kind == MOTION_POINTS && at && fuzz_int(r, 0, 2) == 0)
        for (size_t k = 0; k < 2; k++) out[k] = a->xy[2 * at - 2 + k];
}

/** Fills the batch, which points into `a`. */
static inline froe_moving motion_make(fuzz_source *r, motion_kind kind, size_t n, motion_arrays *a) {
    const bool cubics = kind == MOTION_CUBIC || kind == MOTION_CUBICAL;
    bool parabolas = kind == MOTION_QUADRATIC || kind == MOTION_PARABOLIC || kind == MOTION_POINTS || cubics;
    size_t at = 0;
    for (size_t v = 0; v < 2 * n; v++) {
        a->starts[v] = at;
        for (size_t count = motion_times(r, kind, a->times + at); count; count--, at++) {
            motion_place(r, kind, a, at, a->xy + 2 * at);
            bool straight = !parabolas || fuzz_int(r, 0, 1);
            for (size_t k = 0; k < 2; k++) a->controls[2 * at + k] = straight ? NAN : motion_number(r, kind);
            const bool cubic = cubics && !straight && fuzz_int(r, 0, 2);
            for (size_t k = 0; k < 2; k++) a->seconds[2 * at + k] = cubic ? motion_number(r, kind) : NAN;
        }
    }
    a->starts[2 * n] = at;
    for (size_t j = 0; j < n; j++) {
        a->births[j] = kind == MOTION_LIVES ? fuzz_int(r, 0, 4) : 0;
        a->deaths[j] = kind == MOTION_LIVES ? fuzz_int(r, 4, 8) : 8;
    }
    froe_moving b = froe_moving_defaults();
    b.vertex_count = 2 * n;
    b.count = n;
    b.starts = a->starts;
    b.times = a->times;
    b.coords = a->xy;
    b.controls = a->controls;
    b.second_controls = a->seconds;
    b.births = a->births;
    b.deaths = a->deaths;
    return b;
}
/** The batch, moving in the window. */
static inline froe_motion *motion_of(const froe_moving *batch, const froe_allocator *alloc) {
    froe_motion_options o = froe_motion_defaults();
    o.begin = 0;
    o.end = 8;
    froe_motion *m = NULL;
    assert_int_equal(froe_motion_new(&o, alloc, &m, NULL), FROE_OK);
    assert_int_equal(froe_motion_add(m, batch, NULL), FROE_OK);
    return m;
}

/** A motion of MOTION_MOST segments, always the same of a kind. */
static inline froe_motion *motion_new(motion_kind kind) {
    static motion_arrays a;
    fuzz_source r = {(uint64_t)kind + 1};
    const froe_moving batch = motion_make(&r, kind, MOTION_MOST, &a);
    return motion_of(&batch, NULL);
}
#endif
