/* strokes.h: lines on the page on their way to strokes: straight segments first.
 *
 * It speaks for gaps.c (what segments leave of each other) and strokes.c (polylines). */
#ifndef FROE_VIEW_PICTURE_STROKES_H
#define FROE_VIEW_PICTURE_STROKES_H
#include "view/print.h"

typedef struct view_segment {
    uint32_t vertex[2]; /**< where it may be chained; FROE_NONE: it ends within its line */
    print_point at[2];
    double near[2]; /**< grows towards the eye, linearly along the segment: 1 / depth, or in parallel - depth */
    double space[2][3];
    uint32_t object; /**< that it is a line of */
    uint32_t place;  /**< nodes that are painted before it; FROE_NONE: all */
    uint16_t kind;
    uint8_t hidden, used;
} view_segment;
typedef ARRAY(view_segment) view_segments;

/** Which lines run on into each other. */
typedef struct view_chains {
    const uint32_t *numbers; /**< see froe_picture_options */
    const uint32_t *groups; /**< per object: wires of different groups are strokes of their own; NULL: there are none */
} view_chains;
/** Do lines of a kind of two objects run on into each other? See froe_picture_options. */
static inline bool view_runs_on(const view_chains *c, uint32_t kind, uint32_t a, uint32_t b) {
    const bool apart = kind == FROE_LINE_WIRE && c->groups && c->groups[a] != c->groups[b];
    return !apart && (!c->numbers || c->numbers[a] == c->numbers[b]);
}
/** Where lines lie on each other, that of the highest strength is drawn: a visible one, then the widest. */
int view_strength(uint32_t kind, bool hidden);
/** Removes parts that shall not be drawn: those that nearly lie on a stronger or earlier segment, and, with a halo > 0,
 * those of visible ones nearer than that to a visible one that is in front by as much or more. FROE_E_MEMORY. */
froe_status view_cut_segments(const froe_allocator *alloc, const froe_projection *view, double halo,
                              view_segments *segments);
#endif
