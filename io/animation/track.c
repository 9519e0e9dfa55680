/* track.c: see track.h. */
#include "animation/track.h"
#include <math.h>
#include <string.h>

/* ----------------------------------------------------------------- quaternions -- */

static double dot_of(const double *p, const double *q, size_t width) {
    double sum = 0;
    for (size_t k = 0; k < width; k++) sum += p[k] * q[k];
    return sum;
}

double io_length(const double *v, size_t width) {
    return sqrt(dot_of(v, v, width));
}

bool io_normalize(double *v, size_t width) {
    const double length = io_length(v, width);
    if (!(length > 0) || !isfinite(length)) return false;
    for (size_t k = 0; k < width; k++) v[k] /= length;
    return true;
}

void io_turn_multiply(const double p[4], const double q[4], double out[4]) {
    const double r[4] = {
        p[3] * q[0] + p[0] * q[3] + p[1] * q[2] - p[2] * q[1], p[3] * q[1] + p[1] * q[3] + p[2] * q[0] - p[0] * q[2],
        p[3] * q[2] + p[2] * q[3] + p[0] * q[1] - p[1] * q[0], p[3] * q[3] - p[0] * q[0] - p[1] * q[1] - p[2] * q[2]};
    memcpy(out, r, sizeof r);
}

void io_turn_apply(const double q[4], const double v[3], double out[3]) {
    const double t[3] = {2 * (q[1] * v[2] - q[2] * v[1]), 2 * (q[2] * v[0] - q[0] * v[2]),
                         2 * (q[0] * v[1] - q[1] * v[0])};
    const double r[3] = {v[0] + q[3] * t[0] + q[1] * t[2] - q[2] * t[1], v[1] + q[3] * t[1] + q[2] * t[0] - q[0] * t[2],
                         v[2] + q[3] * t[2] + q[0] * t[1] - q[1] * t[0]};
    memcpy(out, r, sizeof r);
}

/* The spherical interpolation by halving: the middle of an arc is the sum of its ends, divided by its length. */
static void turn_between(const double *p, const double *q, double share, double out[4]) {
    double low[4], high[4];
    const double sign = dot_of(p, q, 4) < 0 ? -1 : 1;
    for (int k = 0; k < 4; k++) low[k] = p[k], high[k] = sign * q[k];
    for (int step = 0; step < 64; step++) {
        double mid[4], chord[4];
        for (int k = 0; k < 4; k++) chord[k] = high[k] - low[k], mid[k] = low[k] + high[k];
        if (dot_of(chord, chord, 4) < 0x1p-40) break; /* a straight line differs by less than the last place */
        io_normalize(mid, 4);
        share *= 2;
        memcpy(share < 1 ? high : low, mid, sizeof mid);
        if (share >= 1) share -= 1;
    }
    for (int k = 0; k < 4; k++) out[k] = low[k] + share * (high[k] - low[k]);
    io_normalize(out, 4);
}

/* ----------------------------------------------------------------------- values -- */

size_t io_track_each(const io_track *track) {
    return track->between == IO_CUBIC ? 3 * track->width : track->width;
}

const double *io_track_value(const double *numbers, const io_track *track, size_t key) {
    const size_t before = track->between == IO_CUBIC ? track->width : 0;
    return numbers + track->first + track->count + io_track_each(track) * key + before;
}

size_t io_track_piece(const double *numbers, const io_track *track, double time) {
    size_t low = 0, high = track->count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (io_track_time(numbers, track, middle) <= time)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* Bezier's points of a piece of a spline. */
static void bezier_of(const double *numbers, const io_track *track, size_t piece, double out[4][4]) {
    const double *p = io_track_value(numbers, track, piece - 1), *q = io_track_value(numbers, track, piece);
    const double third = (io_track_time(numbers, track, piece) - io_track_time(numbers, track, piece - 1)) / 3;
    for (size_t k = 0; k < track->width; k++) {
        out[0][k] = p[k], out[3][k] = q[k];
        out[1][k] = p[k] + third * p[track->width + k];
        out[2][k] = q[k] - third * q[k - track->width];
    }
}

static void spline_at(const double *numbers, const io_track *track, size_t piece, double share, double *out) {
    double b[4][4];
    bezier_of(numbers, track, piece, b);
    for (int round = 3; round > 0; round--) /* de Casteljau */
        for (int i = 0; i < round; i++)
            for (size_t k = 0; k < track->width; k++) b[i][k] += share * (b[i + 1][k] - b[i][k]);
    memcpy(out, b[0], track->width * sizeof *out);
}

void io_track_at(const double *numbers, const io_track *track, size_t piece, double time, double *out) {
    const bool stands = !piece || piece == track->count || track->between == IO_STEP;
    const size_t key = piece ? piece - 1 : 0;
    const double *p = io_track_value(numbers, track, key);
    memcpy(out, p, track->width * sizeof *out);
    if (!stands) {
        const double from = io_track_time(numbers, track, key), to = io_track_time(numbers, track, piece);
        const double share = fmin(fmax((time - from) / (to - from), 0), 1);
        const double *q = io_track_value(numbers, track, piece);
        if (track->between == IO_CUBIC)
            spline_at(numbers, track, piece, share, out);
        else if (track->width == 4)
            turn_between(p, q, share, out);
        else
            for (size_t k = 0; k < 3; k++) out[k] = p[k] * (1 - share) + q[k] * share;
    }
    if (track->width == 4 && track->between == IO_CUBIC) io_normalize(out, 4);
}

bool io_track_rests(const double *numbers, const io_track *track) {
    const size_t each = io_track_each(track), width = track->width;
    const double *first = numbers + track->first + track->count;
    for (size_t key = 0; key < track->count; key++) {
        const double *value = io_track_value(numbers, track, key);
        for (size_t k = 0; k < width; k++)
            if (value[k] != io_track_value(numbers, track, 0)[k]) return false;
        for (size_t k = 0; each > width && track->count > 1 && k < each; k++)
            if ((k < width || k >= 2 * width) && first[each * key + k] != 0) return false;
    }
    return true;
}

double io_track_apart(const double *numbers, const io_track *track, size_t key) {
    const double *first = io_track_value(numbers, track, 0), *now = io_track_value(numbers, track, key);
    double b[4][4], apart[4], most = 0;
    const bool spline = track->between == IO_CUBIC; /* it stays within the hull of Bezier's points */
    if (spline) bezier_of(numbers, track, key, b);
    for (int i = spline ? 0 : 3; i < 4; i++) {
        for (size_t k = 0; k < track->width; k++) apart[k] = (spline ? b[i][k] : now[k]) - first[k];
        most = fmax(most, io_length(apart, track->width));
    }
    return most;
}

bool io_track_jumps(const double *numbers, const io_track *track, size_t key) {
    return track->between == IO_STEP && key > 0 &&
           memcmp(io_track_value(numbers, track, key), io_track_value(numbers, track, key - 1),
                  track->width * sizeof(double)) != 0;
}

/* ----------------------------------------------------------------------- bounds -- */

/* Derivatives of a quaternion that is divided by its length, from those of the quaternion: with n = q / |q|,
 * |n'| <= |q'| / |q| and |n''| <= |q''| / |q| + 3 |q'|^2 / |q|^2. A body turns with 2 n' times the inverse of n. */
static io_bounds bound_turn(double least, double speed, double bend) {
    if (!(least > 0)) return (io_bounds){1, (double)INFINITY, (double)INFINITY};
    const double n = speed / least;
    return (io_bounds){1, 2 * n, 2 * (bend / least + 3 * n * n) + 2 * n * n};
}

io_bounds io_track_bounds(const double *numbers, const io_track *track, size_t piece, double from, double to) {
    const size_t key = piece ? piece - 1 : 0, width = track->width;
    const double *p = io_track_value(numbers, track, key);
    if (!piece || piece == track->count || track->between == IO_STEP) return (io_bounds){io_length(p, width), 0, 0};
    const double *q = io_track_value(numbers, track, piece);
    const double step = io_track_time(numbers, track, piece) - io_track_time(numbers, track, key);
    io_bounds b = {fmax(io_length(p, width), io_length(q, width)), 0, 0};
    double apart[4];
    if (track->between == IO_LINEAR) {
        const double sign = width == 4 && dot_of(p, q, 4) < 0 ? -1 : 1;
        for (size_t k = 0; k < width; k++) apart[k] = sign * q[k] - p[k];
        /* An arc up to a quarter of the circle is at most 1.1108 times its chord; the body turns twice as fast. */
        b.speed = (width == 4 ? 2.2216 : 1) * io_length(apart, width) / step;
        return b;
    }
    double c[4][4], middle[4];
    bezier_of(numbers, track, piece, c);
    for (int i = 0; i < 4; i++) b.most = fmax(b.most, io_length(c[i], width));
    for (int i = 0; i < 3; i++) {
        for (size_t k = 0; k < width; k++) apart[k] = c[i + 1][k] - c[i][k];
        b.speed = fmax(b.speed, 3 * io_length(apart, width) / step);
    }
    for (int i = 0; i < 2; i++) {
        for (size_t k = 0; k < width; k++) apart[k] = c[i + 2][k] - 2 * c[i + 1][k] + c[i][k];
        b.bend = fmax(b.bend, 6 * io_length(apart, width) / (step * step));
    }
    if (width == 3) return b;
    const double half = 0.5 * (to - from);
    spline_at(numbers, track, piece, (from + half - io_track_time(numbers, track, key)) / step, middle);
    return bound_turn(io_length(middle, 4) - half * b.speed, b.speed, b.bend);
}
