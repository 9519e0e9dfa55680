/* progress.h: a bar on stderr while a call works, and signals that stop it.
 *
 *     cli_progress bar = cli_progress_begin(common, "building");
 *     options.progress = cli_progress_step;  options.user = &bar;
 *     ... the call ...
 *     cli_progress_end(&bar); */
#ifndef FROE_CLI_PROGRESS_H
#define FROE_CLI_PROGRESS_H
#include "args/options.h"

typedef struct cli_progress {
    const char *what;
    bool visible; /**< stderr is a terminal, without --quiet */
    int percent;  /**< drawn last; -1: nothing yet */
} cli_progress;

/** Lets Ctrl-C, `kill` and a terminal that is closed set a flag instead of ending the program (a second one ends it;
 * where it is ignored, it stays so), as does the time of --limit-time; and makes files beyond the allowed size an error
 * of writing. */
void cli_catch_signals(void);
/** Whether such a signal came. */
bool cli_interrupted(void);
/** Whether it was the time. */
bool cli_late(void);
/** The exit code of a program that the signal cancelled. */
int cli_signal_code(void);

cli_progress cli_progress_begin(const cli_common *common, const char *what);
/** A froe_progress_fn: draws, and returns false once such a signal came. */
bool cli_progress_step(void *progress, double done);
/** Wipes the bar. */
void cli_progress_end(cli_progress *progress);
#endif
