/* sets.h: two sets of points, nasty ones and some that touch, and whether there is a plane between them, by trying all
 * planes through dim of them in rationals. */
#ifndef FROE_TESTS_GEOM_SETS_H
#define FROE_TESTS_GEOM_SETS_H
#include "geom/plane.h"
#include "support/fuzz.h"
#include "support/rational.h"

typedef enum sets_answer { SETS_MEET, SETS_APART, SETS_FLAT } sets_answer;

enum { SETS_MOST = 24 };

typedef struct sets {
    int dim;
    uint32_t count;
    double x[SETS_MOST][3];
    int set[SETS_MOST];
} sets;

/** The plane through the points a, b (and c); false: they span none. */
static inline bool sets_plane(const sets *s, const uint32_t id[3], rational_plane *out) {
    geom_plane plane = {.form = GEOM_POINTS, .dim = s->dim};
    for (int i = 0; i < s->dim; i++) memcpy(plane.p[i], s->x[id[i]], sizeof plane.p[i]);
    rational_plane_set(out, &plane);
    return mpq_sgn(out->n[0]) || mpq_sgn(out->n[1]) || mpq_sgn(out->n[2]);
}

/** Does the plane have the sets on different sides? SETS_FLAT: all points are in it. */
static inline sets_answer sets_sides(const sets *s, rational_plane *h) {
    bool seen[2] = {false, false};
    rational_point p;
    rational_point_init(&p);
    for (uint32_t i = 0; i < s->count; i++) {
        rational_point_set(&p, s->dim, s->x[i]);
        int side = rational_side(h, &p) * s->set[i];
        if (side) seen[side > 0] = true;
    }
    rational_point_clear(&p);
    return seen[0] && seen[1] ? SETS_MEET : seen[0] || seen[1] ? SETS_APART : SETS_FLAT;
}

static inline sets_answer sets_oracle(const sets *s) {
    sets_answer answer = SETS_FLAT;
    rational_plane h;
    rational_plane_init(&h);
    for (uint32_t i = 0; i < s->count; i++)
        for (uint32_t j = 0; j < i; j++)
            for (uint32_t k = 0; k < (s->dim == 3 ? j : 1); k++) {
                uint32_t id[3] = {i, j, k};
                if (answer == SETS_APART || !sets_plane(s, id, &h)) continue;
                sets_answer this = sets_sides(s, &h);
                if (this != SETS_FLAT) answer = this;
            }
    rational_plane_clear(&h);
    return answer;
}

static inline void sets_make_nasty(sets *s, fuzz_source *r, int i) {
    double x[SETS_MOST * 3];
    s->count = (uint32_t)fuzz_int(r, 2, 9);
    fuzz_points(r, (fuzz_class)(i / 6 % FUZZ_CLASSES), s->dim, x, (int)s->count);
    for (uint32_t k = 0; k < s->count; k++) {
        s->set[k] = k == 0 ? -1 : k == 1 ? 1 : fuzz_int(r, 0, 1) * 2 - 1;
        memcpy(s->x[k], x + k * (uint32_t)s->dim, (size_t)s->dim * sizeof(double));
    }
}

/** Lattice points on either side of a plane, many of them in it. */
static inline void sets_make_touching(sets *s, fuzz_source *r, int i) {
    int n[3];
    (void)i;
    for (int k = 0; k < 3; k++) n[k] = fuzz_int(r, -2, 2);
    s->count = (uint32_t)fuzz_int(r, 4, 11);
    for (uint32_t at = 0; at < s->count; at++) {
        int side = 0;
        for (int k = 0; k < s->dim; k++) {
            int x = fuzz_int(r, -2, 2);
            s->x[at][k] = x;
            side += n[k] * x;
        }
        s->set[at] = at == 0 ? -1 : at == 1 ? 1 : side ? (side > 0 ? 1 : -1) : fuzz_int(r, 0, 1) * 2 - 1;
    }
}

#endif
