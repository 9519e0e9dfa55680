/* present.h: where moving segments are just after an instant, what is next to a point and to a ray then, and the
 * partition that they make, by other means than froe's. Coordinates are polynomials with whole coefficients (GMP) in
 * two infinitesimals: d, the time since the instant, and e, by which vertical lines are inclined, which is smaller than
 * every power of d. The first coefficient that is not 0 tells the sign: 1, d, d^2, .., e, e d, ..
 *
 * Where a body turns, only the coefficients up to d^2 are right, which suffices where no more coincides than places at
 * the instant.
 *
 * What a segment has in a cell is an interval of the segment, between the solutions of linear inequalities, one for
 * each border of the cell. */
#ifndef FROE_TESTS_ORACLE_PRESENT_H
#define FROE_TESTS_ORACLE_PRESENT_H
#include <froe/kinetic.h>
#include <gmp.h>

enum { PRESENT_MOST = 32, GERM_D = 10, GERM_E = 2 };

/** A number. */
typedef struct germ {
    int d, e; /**< of its powers, the highest */
    mpz_t c[GERM_E][GERM_D];
} germ;

/** (x / w, y / w), w > 0. */
typedef struct germ_point {
    germ x, y, w;
} germ_point;

enum { PRESENT_LEFT, PRESENT_RIGHT, PRESENT_UP, PRESENT_DOWN };
#define PRESENT_END_0 0xfffffffeu
#define PRESENT_END_1 0xfffffffdu
#define PRESENT_NO_WALL 0xffffffffu

/** A segment cuts a cell; walls are through its ends, or where it crosses another segment; children are nodes, -1: none
 * (see src/kinetic/tree/ktree.h, whose words these are). */
typedef struct present_node {
    uint32_t segment, wall[2];
    int child[4];
} present_node;

typedef struct present {
    uint32_t count;
    bool here[PRESENT_MOST];         /**< there, and not just a point */
    int left[PRESENT_MOST];          /**< which of its ends is on the left */
    uint64_t key[PRESENT_MOST];      /**< the order in which they cut */
    germ_point end[PRESENT_MOST][2]; /**< left, right; all w are 1, and coordinates multiplied by `scale` */
    germ_point *crossing[PRESENT_MOST][PRESENT_MOST];
    mpz_t scale;
    present_node *nodes;
    int node_count, room;
} present;

/** The objects with `there`, cut in the order of `key`. Ends the program without memory. Clear it. */
void present_init(present *p, const froe_motion *m, double time, const bool *there, const uint64_t *key);
void present_clear(present *p);
/** Node 0 is the root, if there are nodes. */
void present_build(present *p);

/** Can it be asked of? Its coordinates are whole multiples of 2^-40, and not too large. */
bool present_takes(const double at[2]);
/** Does the point lie on the segment at the instant? */
bool present_is_on(const present *p, uint32_t segment, const double at[2]);
/** Is the point on the segment at the instant, but for rounding? */
bool present_is_near(const present *p, uint32_t segment, const double at[2]);
/** The next segment straight up (1) or down (-1), the first in order of several in one line; FROE_NONE. */
uint32_t present_next(present *p, const double at[2], int up);
/** The segments that a ray meets first, together; in doubles, how far on the way. False: none. */
bool present_ray(present *p, const double from[2], const double to[2], bool *first);
/** How far on the way, roughly, a ray crosses a segment. False: it does not, or they are parallel. */
bool present_share(present *p, uint32_t segment, const double from[2], const double to[2], double *share);
#endif
