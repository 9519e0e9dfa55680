/* segment.h: segments of the plane, for libraries that know bounding boxes alone. Coordinates are whole numbers below
 * 2^30 in doubles, so that these functions decide exactly. */
#ifndef FROE_BENCH_PEERS_SEGMENT_H
#define FROE_BENCH_PEERS_SEGMENT_H
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** ax < bx, or ax == bx and ay <= by. */
typedef struct peer_segment {
    double ax, ay, bx, by;
} peer_segment;

/** Sign of (b - a) x (c - a): coordinates are multiples of 1/2. */
static inline int peer_turn(double ax, double ay, double bx, double by, double cx, double cy) {
    double l = (ax - cx) * (by - cy), r = (ay - cy) * (bx - cx), d = l - r, e = (fabs(l) + fabs(r)) * 4.5e-16;
    if (d > e) return 1;
    if (d < -e) return -1;
    __extension__ typedef __int128 wide;
    wide a = (wide)(int64_t)(2 * (ax - cx)) * (int64_t)(2 * (by - cy));
    wide b = (wide)(int64_t)(2 * (ay - cy)) * (int64_t)(2 * (bx - cx));
    return (a > b) - (a < b);
}

static inline bool peer_meets_window(const peer_segment *s, const double lo[2], const double hi[2]) {
    double low = s->ay < s->by ? s->ay : s->by, high = s->ay < s->by ? s->by : s->ay;
    if (s->bx < lo[0] || s->ax > hi[0] || high < lo[1] || low > hi[1]) return false;
    if (s->ax >= lo[0] && s->ay >= lo[1] && s->ax <= hi[0] && s->ay <= hi[1]) return true;
    if (s->bx >= lo[0] && s->by >= lo[1] && s->bx <= hi[0] && s->by <= hi[1]) return true;
    bool up = s->by >= s->ay; /* the two corners that are furthest apart across this slope */
    int p = peer_turn(s->ax, s->ay, s->bx, s->by, lo[0], up ? hi[1] : lo[1]);
    int q = peer_turn(s->ax, s->ay, s->bx, s->by, hi[0], up ? lo[1] : hi[1]);
    return p * q <= 0;
}

static inline bool peer_meet(const peer_segment *a, const peer_segment *b) {
    double al = a->ay < a->by ? a->ay : a->by, ah = a->ay < a->by ? a->by : a->ay;
    double bl = b->ay < b->by ? b->ay : b->by, bh = b->ay < b->by ? b->by : b->ay;
    if (a->bx < b->ax || b->bx < a->ax || ah < bl || bh < al) return false;
    return peer_turn(a->ax, a->ay, a->bx, a->by, b->ax, b->ay) * peer_turn(a->ax, a->ay, a->bx, a->by, b->bx, b->by) <=
               0 &&
           peer_turn(b->ax, b->ay, b->bx, b->by, a->ax, a->ay) * peer_turn(b->ax, b->ay, b->bx, b->by, a->bx, a->by) <=
               0;
}

/** Is the segment above the point, or through it? Then *at is where. Points have x at half-integers: never on a corner.
 */
static inline bool peer_above(const peer_segment *s, double x, double y, double *at) {
    if (!(s->ax < x && x < s->bx) || (s->ay < y && s->by < y)) return false;
    if (peer_turn(s->ax, s->ay, s->bx, s->by, x, y) > 0) return false;
    *at = s->ay + (s->by - s->ay) * ((x - s->ax) / (s->bx - s->ax));
    return true;
}

#ifdef __cplusplus
}
#endif
#endif
