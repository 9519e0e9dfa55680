/* overwrite.h: no command writes a file that it reads. */
#ifndef FROE_CLI_OVERWRITE_H
#define FROE_CLI_OVERWRITE_H
#include "args/options.h"

/** Keeps a mistyped command from overwriting its input: fails where a file that the options name for writing is one
 * that they name for reading, by whatever name, lies in a folder that is read, belongs to a Shapefile that is read, or
 * is named twice; and where an option other than a CLI_OUTPUT names standard output. cli_run() checks every command.
 * Returns 0, or an exit code after saying why. */
int cli_check_overwrite(const cli_part *parts, void *args);
#endif
