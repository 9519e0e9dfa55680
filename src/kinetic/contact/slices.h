/* slices.h: moving objects in boxes of the plane and of time.
 *
 *      x |        ____
 *        |   ____|   /|        an object's life is cut at the knots of its two vertices, and where it moves far
 *        |  |  _/|_/__|        compared with its size also at binary fractions of the window, which are the
 *        |__|_/__|_________ t  same for all objects; each slice gets its bounding box */
#ifndef FROE_KINETIC_SLICES_H
#define FROE_KINETIC_SLICES_H
#include "kinetic/motion/motion.h"

typedef struct motion_slice {
    uint32_t object;
    double from, to;
} motion_slice;

typedef struct motion_slices {
    ARRAY(motion_slice) slices;
    ARRAY(double) lo; /**< x, y, t of each slice's box */
    ARRAY(double) hi;
} motion_slices;

/** All slices between two times within the window. FROE_E_MEMORY, FROE_E_LIMIT (2^31 slices). O(knots + slices). */
froe_status motion_slices_find(const froe_motion *m, double from, double to, motion_slices *out);
void motion_slices_free(const froe_motion *m, motion_slices *slices);
#endif
