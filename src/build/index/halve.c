/* halve.c: classes, counts, and two runs. */
#include "build/index/halve.h"
#include <math.h>

enum { NUDGES = 8 };

bool halve_count(axis_work *work, const packed_box *box, const packed_fragment *f, uint32_t count, halve_cut *cut,
                 uint8_t *classes) {
    for (int i = 0; i < NUDGES; i++) {
        if (!(cut->value > box->lo[cut->axis] && cut->value < box->hi[cut->axis])) return false;
        uint32_t of[4] = {0}, k = 0; /* by class: 1, 2 or 3 */
        for (; k < count; k++) {
            const int first = axis_side(work, f + k, false, box, cut->axis, cut->value);
            const int last = axis_side(work, f + k, true, box, cut->axis, cut->value);
            if (!first || !last) break; /* an end lies in the cut */
            classes[k] = (uint8_t)((first < 0 || last < 0 ? 1 : 0) | (first > 0 || last > 0 ? 2 : 0));
            of[classes[k]]++;
        }
        if (k == count) {
            cut->both = of[3];
            cut->sides[0] = of[1] + of[3];
            cut->sides[1] = of[2] + of[3];
            return true;
        }
        cut->value = nextafter(cut->value, INFINITY);
    }
    return false;
}

void halve_deal(const axis_work *work, const packed_fragment *f, uint32_t count, const halve_cut *cut,
                const uint8_t *classes, packed_fragment *negative, packed_fragment *positive) {
    for (uint32_t i = 0; i < count; i++) {
        const packed_fragment fragment = f[i];
        if (classes[i] == 3)
            axis_divide(work, &fragment, cut->axis, cut->value, negative++, positive++);
        else
            *(classes[i] == 1 ? negative++ : positive++) = fragment;
    }
}
