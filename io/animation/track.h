/* track.h: how one property of a node changes in an animation: keys, and what is between two of them.
 *
 *     STEP   ___|      LINEAR  /\      CUBIC  Hermite's spline, with a tangent before and one after each key
 *        ___|                 /  \            (glTF 2.0, appendix C)
 *
 * Turns are quaternions x, y, z, w: LINEAR is the spherical interpolation along the shorter way ("slerp"), found by
 * halving with square roots alone, so that it is the same on every machine; CUBIC is divided by its length. Before the
 * first key and after the last the value stands still. */
#ifndef FROE_IO_ANIMATION_TRACK_H
#define FROE_IO_ANIMATION_TRACK_H
#include "support/array.h"

typedef enum io_between { IO_STEP, IO_LINEAR, IO_CUBIC } io_between;

typedef struct io_track {
    io_between between;
    size_t width; /**< 3, or 4 of a turn */
    size_t count; /**< keys; 0: the property does not change */
    size_t first; /**< where its numbers begin: all times, then for each key a value; of CUBIC the tangent before, the
                       value and the tangent behind, in units of the value for each unit of time */
} io_track;
typedef ARRAY(double) io_numbers;

static inline double io_track_time(const double *numbers, const io_track *track, size_t key) {
    return numbers[track->first + key];
}
const double *io_track_value(const double *numbers, const io_track *track, size_t key);
/** Numbers for each key behind the times. */
size_t io_track_each(const io_track *track);

/** Which piece a time is in: the number of the key before it plus 1; 0: before the first key. */
size_t io_track_piece(const double *numbers, const io_track *track, double time);
/** The value at a time within a piece, its ends included. A turn has length 1. */
void io_track_at(const double *numbers, const io_track *track, size_t piece, double time, double *out);
/** Is it one value for ever? */
bool io_track_rests(const double *numbers, const io_track *track);
/** How far the value is from that of the first key at most, from the key before this one to this one.
 * REQUIRES: key > 0. */
double io_track_apart(const double *numbers, const io_track *track, size_t key);
/** Does it jump at the key? */
bool io_track_jumps(const double *numbers, const io_track *track, size_t key);

/** Not less than anywhere between two times within a piece: the length of the value, of its first derivative and of the
 * second. Of a turn: 1, the angular velocity, and its derivative; infinity where the quaternion may become 0. */
typedef struct io_bounds {
    double most, speed, bend;
} io_bounds;
io_bounds io_track_bounds(const double *numbers, const io_track *track, size_t piece, double from, double to);

/** Products of quaternions, and a vector turned by one of length 1. */
void io_turn_multiply(const double p[4], const double q[4], double out[4]);
void io_turn_apply(const double q[4], const double v[3], double out[3]);
/** Divides by the length. False: that is 0, or beyond doubles. */
bool io_normalize(double *v, size_t width);
double io_length(const double *v, size_t width);
#endif
