/* check.h: are the coordinates in a caller's question finite numbers? */
#ifndef FROE_QUERY_CHECK_H
#define FROE_QUERY_CHECK_H
#include "support/fail.h"
#include <math.h>

/** FROE_OK, or FROE_E_INPUT with "Coordinate 1 of `what` is nan, not a finite number." */
static inline froe_status query_check_point(const double *x, int dim, const char *what, froe_diagnostic *diag) {
    for (int k = 0; k < dim; k++)
        if (!isfinite(x[k]))
            return support_fail_at(diag, FROE_E_INPUT, FROE_NONE, FROE_NONE, (uint32_t)k,
                                   "Coordinate %d of %s is %g, not a finite number.", k, what, x[k]);
    return FROE_OK;
}
#endif
