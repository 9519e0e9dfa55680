/* progress.h: a bar on stderr while a call works, and Ctrl-C to stop it.
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

/** Lets Ctrl-C set a flag instead of ending the program (a second one ends it;
 * where it is ignored, it stays so), and makes files beyond the allowed size an error of writing. */
void cli_catch_signals(void);
/** Whether Ctrl-C was pressed. */
bool cli_interrupted(void);

cli_progress cli_progress_begin(const cli_common *common, const char *what);
/** A froe_progress_fn: draws, and returns false once Ctrl-C was pressed. */
bool cli_progress_step(void *progress, double done);
/** Wipes the bar. */
void cli_progress_end(cli_progress *progress);
#endif
