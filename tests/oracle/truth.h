/* truth.h: where vertices are, in whole numbers (GMP), from the plans as they are written. */
#ifndef FROE_TESTS_ORACLE_TRUTH_H
#define FROE_TESTS_ORACLE_TRUTH_H
#include "kinetic/motion/motion.h"
#include <gmp.h>

enum { TRUTH_NEAR = 6000 /* halvings of a tick: nothing happens before */ };

typedef struct truth {
    mpq_t time, x[4][2], cross[2][2], t[7];
} truth;

static inline void truth_init(truth *g) {
    mpq_t *all = (mpq_t *)g;
    for (size_t i = 0; i < sizeof *g / sizeof *all; i++) mpq_init(all[i]);
}

static inline void truth_clear(truth *g) {
    mpq_t *all = (mpq_t *)g;
    for (size_t i = 0; i < sizeof *g / sizeof *all; i++) mpq_clear(all[i]);
}

/** At the tick, or just after it. */
static inline void truth_set_time(truth *g, const froe_motion *m, int64_t tick, bool after) {
    mpq_set_si(g->time, tick, 1);
    if (after) {
        mpq_set_si(g->t[0], 1, 1);
        mpq_div_2exp(g->t[0], g->t[0], TRUTH_NEAR);
        mpq_add(g->time, g->time, g->t[0]);
    }
    if (m->power >= 0)
        mpq_mul_2exp(g->time, g->time, (mp_bitcnt_t)m->power);
    else
        mpq_div_2exp(g->time, g->time, (mp_bitcnt_t)-m->power);
    mpq_set_d(g->t[0], m->begin);
    mpq_add(g->time, g->time, g->t[0]);
}

/* to = from + s (to - from) */
static inline void truth_between(mpq_t from, mpq_t to, const mpq_t s) {
    mpq_sub(to, to, from);
    mpq_mul(to, to, s);
    mpq_add(to, to, from);
}

static inline void truth_place(truth *g, const froe_motion *m, uint32_t vertex, int64_t tick, mpq_t out[2]) {
    const motion_piece p = motion_piece_at(m, vertex, tick);
    mpq_t *t = g->t;
    mpq_set_d(t[0], p.from->time), mpq_set_d(t[1], p.to->time);
    mpq_sub(t[1], t[1], t[0]);
    mpq_sub(t[0], g->time, t[0]);
    if (p.degree) mpq_div(t[0], t[0], t[1]); /* the share that has passed */
    for (int k = 0; k < 2; k++) {            /* De Casteljau: t[1 ..] are the control points */
        mpq_set_d(t[1], p.from->at[k]);
        if (p.degree > 1) mpq_set_d(t[2], p.from->control[k]);
        if (p.degree > 2) mpq_set_d(t[3], p.second[k]);
        if (p.degree) mpq_set_d(t[1 + p.degree], p.to->at[k]);
        for (int n = p.degree; n > 0; n--)
            for (int i = 1; i <= n; i++) {
                mpq_set(t[5], t[i + 1]);
                truth_between(t[i], t[5], t[0]);
                mpq_set(t[i], t[5]);
            }
        mpq_set(out[k], t[1]);
    }
}
#endif
