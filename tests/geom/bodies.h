/* bodies.h: random bodies of every kind for the oracle tests, in every class of nasty coordinates. */
#ifndef FROE_TESTS_GEOM_BODIES_H
#define FROE_TESTS_GEOM_BODIES_H
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "geom/body.h"
#include "geom/predicates.h"
#include "geom/turn.h"
#include "oracle/bodies.h"
#include "support/fuzz.h"
#include "support/sanitized.h"

enum { BODIES_SHARE = SANITIZED_SHARE(8) };

enum { BODIES_POINTS = 24, BODIES_EACH = 8 };

/* Two bodies, a point and a direction; coordinates from one pool of points, so that much is shared. */
typedef struct bodies_case {
    int dim;
    double points[BODIES_POINTS * FROE_MAX_DIM];
    uint32_t corners[2][BODIES_EACH];
    double boxes[2][2 * FROE_MAX_DIM];
    geom_body body[2];
    const double *point, *direction;
} bodies_case;

static inline const double *bodies_at(const bodies_case *c, uint32_t i) {
    return c->points + (size_t)i * (size_t)c->dim;
}

/* Corners 0, 1, 2 and perhaps the fourth of a parallelogram, if that one is exact. */
static inline void bodies_polygon(fuzz_source *r, bodies_case *c, int which) {
    geom_body *b = &c->body[which];
    num_context context;
    b->count = 3;
    if (num_context_new(NULL, &context) != FROE_OK) fail();
    const double *p = geom_body_point(b, 0), *q = geom_body_point(b, 1), *s = geom_body_point(b, 2);
    if (geom_projection_axis(&context, p, q, s) < 0) {
        b->form = FROE_HULL;
    } else if (fuzz_int(r, 0, 1)) {
        double *x = c->points + (size_t)(BODIES_POINTS - 1 - which) * 3;
        geom_plane plane = geom_plane_points(3, (const double *const[]){p, q, s});
        for (int k = 0; k < 3; k++) x[k] = p[k] + (s[k] - q[k]);
        bool fine = isfinite(x[0]) && isfinite(x[1]) && isfinite(x[2]) && !geom_side_vertex(&context, &plane, x);
        int axis = geom_projection_axis(&context, p, q, s), way = geom_projected_turn(&context, axis, p, q, s);
        const double *ring[4] = {p, q, s, x};
        for (int i = 0; i < 4 && fine; i++)
            fine = geom_projected_turn(&context, axis, ring[i], ring[(i + 1) % 4], ring[(i + 2) % 4]) == way;
        if (fine) c->corners[which][b->count++] = (uint32_t)(BODIES_POINTS - 1 - which);
    }
    num_context_free(&context);
}

static inline void bodies_form(fuzz_source *r, bodies_case *c, int which, froe_kind form) {
    geom_body *b = &c->body[which];
    *b = (geom_body){.form = form, .dim = c->dim, .count = 1, .coords = c->points, .corners = c->corners[which]};
    for (int i = 0; i < BODIES_EACH; i++) c->corners[which][i] = (uint32_t)fuzz_int(r, 0, BODIES_POINTS - 3);
    const double *p = geom_body_point(b, 0), *q = geom_body_point(b, 1);
    if (form == FROE_SEGMENT) b->count = 2, b->form = memcmp(p, q, (size_t)c->dim * sizeof *p) ? form : FROE_HULL;
    if (form == FROE_HULL) b->count = (uint32_t)fuzz_int(r, 1, 6);
    if (form == FROE_POLYGON) bodies_polygon(r, c, which);
    if (form == FROE_BALL) b->radius = fabs(q[0]);
    if (form == FROE_BALL && b->radius == 0) b->form = FROE_POINT;
    if (form != FROE_BOX) return;
    for (int k = 0; k < c->dim; k++) {
        c->boxes[which][k] = p[k] < q[k] ? p[k] : q[k];
        c->boxes[which][c->dim + k] = p[k] < q[k] ? q[k] : p[k];
    }
    b->coords = c->boxes[which];
    b->corners = NULL;
    b->count = 2;
}

static inline froe_kind bodies_kind(fuzz_source *r, int dim) {
    static const froe_kind any[] = {FROE_POINT, FROE_BOX, FROE_BALL, FROE_SEGMENT, FROE_HULL, FROE_POLYGON};
    return any[fuzz_int(r, 0, dim > 3 ? 2 : dim == 3 ? 5 : 4)];
}

/* -0 never reaches a scene. */
static inline void bodies_draw(fuzz_source *r, fuzz_class kind, int dim, bodies_case *c) {
    c->dim = dim;
    if (dim <= 3) {
        fuzz_points(r, kind, dim, c->points, BODIES_POINTS);
    } else {
        for (int i = 0; i < BODIES_POINTS * dim; i++) c->points[i] = fuzz_coordinate(r, kind);
    }
    for (int i = 0; i < BODIES_POINTS * dim; i++) c->points[i] += 0.0;
    for (int i = 0; i < 2; i++) bodies_form(r, c, i, bodies_kind(r, dim));
    c->point = bodies_at(c, (uint32_t)fuzz_int(r, 0, BODIES_POINTS - 3));
    c->direction = bodies_at(c, (uint32_t)fuzz_int(r, 0, BODIES_POINTS - 3));
    int shift = exact_shift(0, c->points, (size_t)(BODIES_POINTS * dim));
    exact_begin(shift);
}

/* Numbers of great span make the oracle slow. */
static inline int bodies_trials(fuzz_class kind, int trials) {
    bool slow = kind >= FUZZ_WIDE && kind != FUZZ_DENORMAL;
    return trials / BODIES_SHARE / (slow ? 8 : 1);
}
#endif
