/* bodies.h: the oracle for bodies: how two of them meet, how far one is from a point, where a ray meets one. Whole
 * numbers (GMP), straight from the definitions, by trying everything; shares nothing with the code under test.
 *
 *     exact_begin(shift);                       // all numbers of a case are taken back; x stands for x 2^shift
 *     exact_body a = exact_body_of(&body);
 *     exact_value t;  if (exact_ray(origin, direction, &a, &t)) ... exact_rounds_to(&t, 0.5) ...
 *
 * Every coordinate times 2^shift must be whole: 1074 always is enough, less is faster. */
#ifndef FROE_TESTS_ORACLE_BODIES_H
#define FROE_TESTS_ORACLE_BODIES_H
#include "geom/body.h"
#include <gmp.h>

enum { EXACT_CORNERS = 32 };

typedef struct exact_point {
    mpz_srcptr x[FROE_MAX_DIM];
} exact_point;

typedef struct exact_body {
    froe_kind form;
    int dim, count;                    /**< corners; boxes up to dimension 3 have all of theirs */
    exact_point corner[EXACT_CORNERS]; /**< balls: the centre */
    exact_point lo, hi;                /**< boxes, points and centres */
    mpz_srcptr radius;
} exact_body;

/** (p + q sqrt(r)) / s, s > 0. */
typedef struct exact_value {
    mpz_srcptr p, q, r, s;
} exact_value;

void exact_begin(int shift);
size_t exact_mark(void);
/** Takes back what was made since. */
void exact_release(size_t mark);
/** The least shift that makes these numbers whole, at least `shift`. */
int exact_shift(int shift, const double *x, size_t count);
exact_body exact_body_of(const geom_body *body);

/** 0 apart, 1 cross, 2 touch, 3 overlap; *corner: they have one corner in common and nothing else. */
int exact_contact(const exact_body *a, const exact_body *b, bool *corner);
/** Where the ray meets the body first; false: nowhere. */
bool exact_ray(const double *origin, const double *direction, const exact_body *b, exact_value *t);
/** The distance, times 2^shift. */
exact_value exact_distance(const double *point, const exact_body *b);

/** Takes back what was made since exact_mark(), except for this value. */
exact_value exact_keep(size_t mark, const exact_value *v);
int exact_compare(const exact_value *a, const exact_value *b);
/** The value of a double, times 2^power. */
exact_value exact_value_of(double x, int power);
/** Is x the double nearest to the value 2^-power, ties to even? */
bool exact_rounds_to(const exact_value *v, double x, int power);
#endif
