/* slices.h: moving objects in boxes of the plane or of space, and of time.
 *
 *      x |        ____
 *        |   ____|   /|        an object's life is cut at the knots of its vertices, and where it moves far
 *        |  |  _/|_/__|        compared with its size also at binary fractions of the window, which are the
 *        |__|_/__|_________ t  same for all objects; each slice gets its bounding box */
#ifndef FROE_KINETIC_SLICES_H
#define FROE_KINETIC_SLICES_H
#include "kinetic/motion/motion.h"

typedef struct slices_entry {
    uint32_t object;
    double from, to;
} slices_entry;

typedef struct slices_table {
    ARRAY(slices_entry) slices;
    ARRAY(double) lo; /**< x, y (, z), t of each slice's box */
    ARRAY(double) hi;
} slices_table;

/** All slices between two times within the window. FROE_E_MEMORY, FROE_E_LIMIT (2^31 slices). O(knots + slices). */
froe_status slices_find(const froe_motion *m, double from, double to, slices_table *out);
void slices_free(const froe_motion *m, slices_table *slices);
#endif
