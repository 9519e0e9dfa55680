/* bodies.c: see bodies.h. */
#include "motion/bodies.h"
#include "exit.h"
#include "support/axes.h"
#include <froe/io.h>
#include <math.h>

/* The diagonal of the box around all vertices when the window begins. */
static double size_of(const froe_motion *motion) {
    double lo[3] = {0}, hi[3] = {0}, at[3];
    bool any = false;
    for (uint32_t v = 0; v < froe_motion_vertex_count(motion); v++) {
        if (!froe_motion_position(motion, v, froe_motion_window(motion).begin, at)) continue;
        for (int k = 0; k < 3; k++) {
            lo[k] = any && lo[k] < at[k] ? lo[k] : at[k];
            hi[k] = any && hi[k] > at[k] ? hi[k] : at[k];
        }
        any = true;
    }
    const double size = support_length((const double[]){hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]});
    return size > 0 ? size : 1;
}

bool cli_has_turning_bodies(const froe_motion *motion) {
    return froe_motion_body_count(motion) && froe_motion_window(motion).dim == 3;
}

int cli_replace_bodies(const char *file, const froe_motion *motion, double deviation, froe_motion **out,
                       double *reached) {
    froe_diagnostic diag;
    const double share = isnan(deviation) ? froe_motion_read_defaults().deviation : deviation;
    *out = NULL;
    if (!cli_has_turning_bodies(motion)) return 0;
    const froe_status status = froe_motion_without_bodies(motion, share * size_of(motion), NULL, out, reached, &diag);
    return status ? cli_fail_status(CLI_WORKING, file, status, &diag) : 0;
}
