/* moving.h: what moves: a file of moving features, a model with an animation, or a model and a table of poses. */
#ifndef FROE_CLI_MOTION_MOVING_H
#define FROE_CLI_MOTION_MOVING_H
#include "args/options.h"
#include <froe/io.h>

typedef struct cli_moving_args {
    const char *path, *format, *poses, *animation;
    double from, to, deviation; /**< NaN: not given */
} cli_moving_args;
#define CLI_MOVING_DEFAULTS                                                                                            \
    { .from = NAN, .to = NAN, .deviation = NAN }

/** All but the file itself and its format. */
extern const cli_option cli_moving_options[];

/** Reads it, with a progress bar. `followed`: for a partition, in which corners of bodies fly along parabolas. Returns
 * 0, or an exit code after saying why. */
int cli_read_moving(const cli_common *common, const cli_moving_args *args, bool followed, froe_motion **motion,
                    froe_motion_report *report);
/** Is a time, which may be NaN, in the window of a motion? CLI_USE after saying that --at is not, or 0. */
int cli_check_at(double at, const froe_motion *motion);
/** Adds what is told of an animation to an object. */
void cli_report_moving(const froe_motion_report *report, json_t *object);
#endif
