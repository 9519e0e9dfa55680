/* sheet.h: which segments of the plane, or polygons of space seen along an axis, certainly lie side by side.
 *
 *     __       |    ___          A line sweeps over the edges and keeps those that it meets in order (Shamos and Hoey:
 *       \______|___/   high      Geometric intersection problems, 1976). Where two neighbours cross further on, one is
 *          7   |   7             removed. What lies above the lower of two neighbours must be what lies below the
 *     _________|____             upper one, or both may overlap something.
 *          4   |    \_ low
 *
 * An object is straight if all of its edges stay, and what lies beside them is right everywhere. Insides of straight
 * objects are disjoint; they meet where edges share ends, or where an end lies within an edge. The latter are reported,
 * so that no other pair of straight objects can cross, overlap or meet in a T-junction: long thin triangles side by
 * side, whose boxes all meet, need not be tested pair by pair. All decisions are exact. */
#ifndef FROE_MEASURE_SHEET_H
#define FROE_MEASURE_SHEET_H
#include "base/task.h"
#include "num/context.h"
#include "scene/scene.h"
#include "support/array.h"

/** Two objects, by their places in the list that the sheet was made of. */
typedef struct measure_touch {
    uint32_t a, b;
} measure_touch;

typedef struct measure_sheet {
    bool *crooked;                /**< [count] of the list: all that are not straight */
    ARRAY(measure_touch) touches; /**< straight ones of which one may have an end within an edge of the other */
} measure_sheet;

/** Sweeps over `count` segments of the plane (axis -1) or polygons of space seen along an axis; no two are equal.
 * Writes `sheet->crooked` and appends touches, some of them more than once. O(count log count + touches), whatever
 * crosses. FROE_E_MEMORY, FROE_E_CANCELLED. */
froe_status measure_sheet_sweep(num_context *context, base_task *task, const froe_scene *scene, int axis,
                                const uint32_t *objects, uint32_t count, measure_sheet *sheet);
#endif
