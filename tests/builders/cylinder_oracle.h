/* cylinder_oracle.h: cylindrical partitions of the plane from their definition, in exact rationals.
 *
 *     F(cell, S)   S empty: a leaf. Otherwise the first segment of S, from a to b within the open cell, gives the node:
 *                  a wall at a unless a is on the left border, a wall at b, then its own line; each child
 *                  gets those of S that have more than a touch of its open cell
 *
 * All comparisons of left and right are by x, then y. It knows nothing of fragments, filters and names: a segment is
 * clipped anew, from its two ends, in every cell. */
#ifndef FROE_TESTS_BUILDERS_CYLINDER_ORACLE_H
#define FROE_TESTS_BUILDERS_CYLINDER_ORACLE_H
#include "scene/scene.h"
#include "support/rational.h"

typedef struct oracle_point {
    mpq_t x, y;
} oracle_point;

typedef struct oracle_cell {
    const oracle_point *left, *right; /**< NULL: none */
    uint32_t top, bottom;             /**< FROE_NONE: none */
} oracle_cell;

/** A part of a segment (or a point: both ends the same) in a cell. `wall`: it ends on the cell's wall there. */
typedef struct oracle_part {
    oracle_point end[2];
    bool wall[2];
} oracle_part;

static inline void oracle_point_init(oracle_point *p) {
    mpq_inits(p->x, p->y, NULL);
}
static inline void oracle_point_clear(oracle_point *p) {
    mpq_clears(p->x, p->y, NULL);
}
static inline void oracle_point_copy(oracle_point *to, const oracle_point *from) {
    mpq_set(to->x, from->x);
    mpq_set(to->y, from->y);
}
static inline void oracle_vertex(const froe_scene *s, uint32_t vertex, oracle_point *out) {
    mpq_set_d(out->x, scene_vertex(s, vertex)[0]);
    mpq_set_d(out->y, scene_vertex(s, vertex)[1]);
}
static inline int oracle_order(const oracle_point *p, const oracle_point *q) {
    int x = mpq_cmp(p->x, q->x);
    return x ? x : mpq_cmp(p->y, q->y);
}
static inline void oracle_part_init(oracle_part *p) {
    oracle_point_init(&p->end[0]), oracle_point_init(&p->end[1]);
}
static inline void oracle_part_clear(oracle_part *p) {
    oracle_point_clear(&p->end[0]), oracle_point_clear(&p->end[1]);
}

/** Left and right end of an object; a point twice. */
static inline void oracle_ends(const froe_scene *s, uint32_t object, oracle_point *left, oracle_point *right) {
    uint32_t last = scene_form(s, object) == FROE_POINT ? 0 : 1;
    oracle_vertex(s, scene_corner(s, object, 0), left);
    oracle_vertex(s, scene_corner(s, object, last), right);
    if (oracle_order(left, right) > 0) {
        mpq_swap(left->x, right->x);
        mpq_swap(left->y, right->y);
    }
}

/** out = (q - p) x (r - p) */
static inline void oracle_turn(mpq_t out, const oracle_point *p, const oracle_point *q, const oracle_point *r) {
    mpq_t a, b, c, d;
    mpq_inits(a, b, c, d, NULL);
    mpq_sub(a, q->x, p->x), mpq_sub(b, r->y, p->y);
    mpq_sub(c, q->y, p->y), mpq_sub(d, r->x, p->x);
    mpq_mul(a, a, b), mpq_mul(c, c, d);
    mpq_sub(out, a, c);
    mpq_clears(a, b, c, d, NULL);
}

/** > 0: above the line of a segment. */
static inline int oracle_above(const froe_scene *s, uint32_t segment, const oracle_point *p) {
    oracle_point left, right;
    mpq_t turn;
    oracle_point_init(&left), oracle_point_init(&right);
    mpq_init(turn);
    oracle_ends(s, segment, &left, &right);
    oracle_turn(turn, &left, &right, p);
    int sign = mpq_sgn(turn);
    mpq_clear(turn);
    oracle_point_clear(&left), oracle_point_clear(&right);
    return sign;
}

/** Where the segment pq crosses the line of another. */
static inline void oracle_crossing(const froe_scene *s, uint32_t segment, const oracle_point *p, const oracle_point *q,
                                   oracle_point *out) {
    oracle_point left, right;
    mpq_t at_p, at_q, step;
    oracle_point_init(&left), oracle_point_init(&right);
    mpq_inits(at_p, at_q, step, NULL);
    oracle_ends(s, segment, &left, &right);
    oracle_turn(at_p, &left, &right, p);
    oracle_turn(at_q, &left, &right, q);
    mpq_sub(at_q, at_p, at_q);
    mpq_div(at_p, at_p, at_q); /* p + t (q - p) */
    mpq_sub(step, q->x, p->x), mpq_mul(step, step, at_p), mpq_add(out->x, p->x, step);
    mpq_sub(step, q->y, p->y), mpq_mul(step, step, at_p), mpq_add(out->y, p->y, step);
    mpq_clears(at_p, at_q, step, NULL);
    oracle_point_clear(&left), oracle_point_clear(&right);
}

/** Cuts the part by the cell's top (want -1) or bottom (want 1). False: nothing is left. */
static inline bool oracle_clip_line(const froe_scene *s, uint32_t object, uint32_t line, int want, oracle_part *part) {
    if (line == FROE_NONE) return true;
    oracle_point left, right, at;
    oracle_point_init(&left), oracle_point_init(&right), oracle_point_init(&at);
    oracle_ends(s, object, &left, &right);
    int l = want * oracle_above(s, line, &left), r = want * oracle_above(s, line, &right);
    bool some = l > 0 || r > 0;
    if (some && (l < 0 || r < 0)) {
        oracle_crossing(s, line, &left, &right, &at);
        oracle_point *end = &part->end[l < 0 ? 0 : 1];
        if (oracle_order(&at, end) * (l < 0 ? 1 : -1) > 0) oracle_point_copy(end, &at);
    }
    oracle_point_clear(&left), oracle_point_clear(&right), oracle_point_clear(&at);
    return some;
}

/** The part of an object in an open cell. False: no more than a touch. */
static inline bool oracle_clip(const froe_scene *s, uint32_t object, const oracle_cell *cell, oracle_part *part) {
    bool point = scene_form(s, object) == FROE_POINT;
    oracle_ends(s, object, &part->end[0], &part->end[1]);
    part->wall[0] = part->wall[1] = false;
    if (!oracle_clip_line(s, object, cell->top, -1, part) || !oracle_clip_line(s, object, cell->bottom, 1, part))
        return false;
    if (oracle_order(&part->end[0], &part->end[1]) >= (point ? 1 : 0)) return false;
    const oracle_point *border[2] = {cell->left, cell->right};
    for (int i = 0; i < 2; i++) {
        int sign = i ? -1 : 1;
        if (!border[i] || sign * oracle_order(&part->end[i], border[i]) > 0) continue;
        oracle_point_copy(&part->end[i], border[i]); /* y does not matter */
        part->wall[i] = true;
    }
    if (point) return !part->wall[0] && !part->wall[1];
    return oracle_order(&part->end[0], &part->end[1]) < 0;
}
#endif
