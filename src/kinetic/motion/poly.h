/* poly.h: polynomials in time, exactly: in stack integers of 128 and 320 bits where these are wide enough (short_*,
 * wide_*) and in dyadic numbers (exact_*): moving points, where the lines of moving segments cross, and what the order
 * of such points is and on which side of a line they are. The same in doubles is in now/near.h. */
#ifndef FROE_KINETIC_POLY_H
#define FROE_KINETIC_POLY_H
#include "kinetic/motion/motion.h"

/** Coefficients of the worst: the order of two crossings of segments that fly along cubics. */
enum { POLY_TERMS = 16 };
/** Limbs that suffice for any of these polynomials, and for shifting and scaling it. A place on a cubic has numbers of
 * up to 134 limbs, a crossing of 705, the order of two of 1,376: 448 thousand for two crossings, 363 for each
 * coordinate of their order, and 700 for shifting one polynomial twice. */
enum { POLY_LIMBS = 1 << 21 };

typedef struct poly_exact {
    int degree;
    num_dyadic c[POLY_TERMS];
} poly_exact;

typedef struct poly_short {
    int degree;
    num_short c[POLY_TERMS];
} poly_short;
typedef struct poly_wide {
    int degree;
    num_wide c[POLY_TERMS];
} poly_wide;

/** A point (x/w, y/w); w is not 0, and greater than 0 for vertices. Vertices in space have the height z/w, too. */
typedef struct exact_point {
    poly_exact x, y, z, w;
} exact_point;
typedef struct short_point {
    poly_short x, y, z, w;
} short_point;
typedef struct wide_point {
    poly_wide x, y, z, w;
} wide_point;

/** A vertex, time being counted in ticks from `tick`. */
void exact_vertex(num_arena *arena, const froe_motion *m, const motion_piece *piece, int64_t tick, exact_point *out);
/** The same at that tick alone: of degree 0. */
void exact_vertex_at(num_arena *arena, const froe_motion *m, const motion_piece *piece, int64_t tick, exact_point *out);

/** Where the line p[0] p[1] crosses the line p[2] p[3]. */
void exact_crossing(num_arena *arena, const exact_point p[4], exact_point *out);

/** Of the sign of q - p. The points p and q are each a vertex (count 1) or where the lines v[0] v[1] and v[2] v[3]
 * cross (count 4); those of q come after those of p. */
void wide_order(const wide_point *v, const int count[2], int axis, poly_wide *out);
void exact_order(num_arena *arena, const exact_point *v, const int count[2], int axis, poly_exact *out);

/** The same of two points, whose denominators may have any sign. */
void exact_claim_points(num_arena *arena, const exact_point *p, const exact_point *q, int axis, poly_exact *out);

#define POLY_PARALLEL 2 /**< no order: lines do not cross */
/** -1, 0, 1 as p is before, at or behind q just after time 0, in x, then, if `both`, in y. */
int short_order_sign(const short_point *v, const int count[2], bool both);
int wide_order_sign(const wide_point *v, const int count[2], bool both);
int exact_order_sign(num_arena *arena, const exact_point *v, const int count[2], bool both);
int exact_compare_points(num_arena *arena, const exact_point *p, const exact_point *q, bool both);

/** > 0: the vertex v[2] is on the left of v[0] v[1]. */
void wide_turn(const wide_point v[3], poly_wide *out);
void exact_turn(num_arena *arena, const exact_point v[3], poly_exact *out);
/** The sign of the turn just after time 0. */
int short_turn_sign(const short_point v[3]);
int wide_turn_sign(const wide_point v[3]);
int exact_turn_sign(num_arena *arena, const exact_point v[3]);

/** > 0: the line v[2] v[3] goes on to the left of where v[0] v[1] goes; 0: they are parallel. This is the denominator
 * of where they cross. */
void wide_lines(const wide_point v[4], poly_wide *out);
void exact_lines(num_arena *arena, const exact_point v[4], poly_exact *out);
/** The sign of that just after time 0. */
int short_lines_sign(const short_point v[4]);
int wide_lines_sign(const wide_point v[4]);
int exact_lines_sign(num_arena *arena, const exact_point v[4]);

/** In space: of the volume of the tetrahedron of four vertices just after time 0: > 0 where v[3] is above the triangle
 * of the others and these turn left, as seen from above. */
int short_volume_sign(const short_point v[4]);
int wide_volume_sign(const wide_point v[4]);
int exact_volume_sign(num_arena *arena, const exact_point v[4]);

/** p[0] q[1] - q[0] p[1]. REQUIRES: degrees that add up to less than POLY_TERMS. */
void exact_determinant(num_arena *arena, const poly_exact p[2], const poly_exact q[2], poly_exact *out);

/** The sign of the polynomial just after its time 0; 0: it is 0 for ever. */
int exact_sign(const poly_exact *p);
int wide_sign(const poly_wide *p);

/** How often the polynomial changes its sign within low < s < low + 2^power, at most (and by an even number less);
 * *sign: what it has there if it does not, which may be 0. Exact: Descartes' rule. */
int exact_variations(num_arena *arena, const poly_exact *p, int64_t low, int power, int *sign);
int wide_variations(const poly_wide *p, int64_t low, int power, int *sign);

void exact_negate(poly_exact *p);
#endif
