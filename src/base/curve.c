/* curve.c: the Z-curve. */
#include "base/curve.h"
#include <froe/froe.h>

uint64_t base_curve_place(int dim, const double *lo, const double *hi, const double *from, const double *to) {
    int bits = 60 / dim < 16 ? 60 / dim : 16;
    uint64_t cell[FROE_MAX_DIM], key = 0;
    for (int k = 0; k < dim; k++) { /* quarters and halves: no sum or difference overflows */
        double half = 0.5 * to[k] - 0.5 * from[k], at = 0.25 * lo[k] + 0.25 * hi[k] - 0.5 * from[k];
        double share = half > 0 ? at / half : 0;
        cell[k] = share > 0 ? share < 1 ? (uint64_t)(share * (double)(1u << bits)) : (1u << bits) - 1u : 0;
    }
    for (int bit = bits - 1; bit >= 0; bit--)
        for (int k = 0; k < dim; k++) key = key << 1 | (cell[k] >> bit & 1);
    return key;
}
