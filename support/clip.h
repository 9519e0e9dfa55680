/* clip.h: what a half-plane leaves of convex rings and of segments, in plain doubles, for pictures and scores.
 *
 *           d > 0      e < 0       The caller tells how far inside each corner is: any number that is linear along
 *       p o------------*----o q    edges, and 0 on the border, which belongs to the half-plane (Sutherland and
 *                   share          Hodgman: Reentrant polygon clipping, 1974).
 *
 * Decisions have no use for it: there a point keeps where it comes from, and its side is asked exactly (src/geom).
 * That is how fragments (src/split/), cells (src/tree/shape.c) and moving segments are clipped, by labels. */
#ifndef FROE_SUPPORT_CLIP_H
#define FROE_SUPPORT_CLIP_H
#include <stdbool.h>

/** What is left of an edge from its first corner, at d, up to its second, at e, which belongs to the next edge. */
typedef struct support_clipped {
    bool corner;  /**< the first corner */
    bool meeting; /**< the point p + share (q - p), on the border */
    double share;
} support_clipped;

static inline support_clipped support_clip_edge(double d, double e) {
    const bool meeting = (d > 0 && e < 0) || (d < 0 && e > 0);
    return (support_clipped){d >= 0, meeting, meeting ? d / (d - e) : 0};
}

/** Shortens a segment, given by the shares of its length at which it begins and ends, to a half-plane in which its ends
 * are at d and e (Cyrus and Beck: Generalized two- and three-dimensional clipping, 1978). False: no end is inside. */
static inline bool support_clip_shares(double d, double e, double share[2]) {
    if (d < 0 && e < 0) return false;
    const double t = d / (d - e);
    if (d < 0 && t > share[0]) share[0] = t;
    if (e < 0 && t < share[1]) share[1] = t;
    return true;
}
#endif
