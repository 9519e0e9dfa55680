/* help.h: --help texts and manual pages, both from the option tables. */
#ifndef FROE_CLI_HELP_H
#define FROE_CLI_HELP_H
#include "command.h"
#include <stdio.h>

/** The list of commands. */
void cli_help(FILE *out);
/** One command's usage, options and examples. */
void cli_help_command(FILE *out, const cli_command *command);
/** The same as roff: froe(1) for NULL, else froe-NAME(1). */
void cli_manual(FILE *out, const cli_command *command);
#endif
