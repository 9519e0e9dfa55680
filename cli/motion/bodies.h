/* bodies.h: a motion whose bodies are replaced by corners on parabolas, for what follows no bodies. */
#ifndef FROE_CLI_MOTION_BODIES_H
#define FROE_CLI_MOTION_BODIES_H
#include <froe/kinetic.h>

/** Are there bodies that turn in space? Those of the plane stay as they are. */
bool cli_has_turning_bodies(const froe_motion *motion);
/** `deviation`: how far corners may be from where the bodies have them, as a share of the size of what moves; NaN: the
 * usual one. *out: the caller's; NULL if there are no bodies. *reached: how far they are at most. Returns an exit code,
 * after saying why; `file` is that of the motion. */
int cli_replace_bodies(const char *file, const froe_motion *motion, double deviation, froe_motion **out,
                       double *reached);
#endif
