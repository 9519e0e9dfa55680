/* allowance.h: --limit-memory and --limit-time: what a command may take, so that a file that is not trusted ends it
 * with a sentence. (A header limits.h would hide the system's where this folder is searched.)
 *
 * Memory is limited by the system (RLIMIT_AS), beyond what program and libraries take: more is refused, which is what
 * any lack of memory is. Time ends calls by their progress, as Ctrl-C does; a library that reads a file and does not
 * listen is left behind a second later (args/crash.h). */
#ifndef FROE_CLI_ALLOWANCE_H
#define FROE_CLI_ALLOWANCE_H
#include "args/options.h"

/** Sets the limits of a command. Returns 0, or an exit code after saying why. */
int cli_limit(const cli_common *common);

/** What is to be told to cli_limit_resume(). */
typedef struct cli_limits {
    bool limited;
    uint64_t limit, mapped; /**< bytes */
} cli_limits;
/** Between these calls libraries are opened: they do not count. */
cli_limits cli_limit_pause(void);
void cli_limit_resume(cli_limits limits);
#endif
