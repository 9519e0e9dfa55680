/* name.h: points by name: a vertex, where the lines of two segments cross, or a line x = c that does not move. A name
 * stays the same while the point moves. */
#ifndef FROE_KINETIC_NAME_H
#define FROE_KINETIC_NAME_H
#include <stdbool.h>
#include <stdint.h>

enum {
    NAME_NONE = -1,   /**< no point: the border of an unbounded cell */
    NAME_VERTEX = -2, /**< vertex a */
    NAME_LINE = -3,   /**< the line x = line[a], y from -infinity on */
    NAME_SEGMENT = -4 /**< not a point: segment a */
};

/** b >= 0 says that it is the crossing of segments a < b. */
typedef struct name_point {
    uint32_t a;
    int32_t b;
} name_point;

static inline bool name_is(name_point p, name_point q) {
    return p.a == q.a && p.b == q.b;
}
static inline bool name_is_crossing(name_point p) {
    return p.b >= 0;
}
static inline bool name_is_vertex(name_point p) {
    return p.b == NAME_VERTEX;
}
static inline bool name_exists(name_point p) {
    return p.b != NAME_NONE;
}
static inline name_point name_crossing(uint32_t s, uint32_t t) {
    return s < t ? (name_point){s, (int32_t)t} : (name_point){t, (int32_t)s};
}
/** Of two crossings on one segment, where the other two segments cross. False: they have no segment in common. */
static inline bool name_third_crossing(name_point p, name_point q, name_point *out) {
    const uint32_t a[2] = {p.a, (uint32_t)p.b}, b[2] = {q.a, (uint32_t)q.b};
    for (int i = 0; i < 4; i++)
        if (a[i / 2] == b[i % 2]) {
            *out = name_crossing(a[1 - i / 2], b[1 - i % 2]);
            return true;
        }
    return false;
}
#endif
