/* halve.h: one axis-parallel cut through a cell of fragments, in general position. */
#ifndef FROE_BUILD_INDEX_HALVE_H
#define FROE_BUILD_INDEX_HALVE_H
#include "build/index/axis.h"

/** A cut, and the fragments on each side of it; those on both count in both. */
typedef struct halve_cut {
    int axis;
    double value;
    uint32_t sides[2], both;
} halve_cut;

/** Counts the fragments of the box beside cut->axis, cut->value, and leaves their classes in `classes`: 1 negative,
 * 2 positive, 3 both. A value that a corner lies at is moved to the next double. False: no value in the box will do. */
bool halve_count(axis_work *work, const packed_box *box, const packed_fragment *fragments, uint32_t count,
                 halve_cut *cut, uint8_t *classes);
/** Deals fragments to two runs, by their classes. */
void halve_deal(const axis_work *work, const packed_fragment *fragments, uint32_t count, const halve_cut *cut,
                const uint8_t *classes, packed_fragment *negative, packed_fragment *positive);
#endif
