/* command.h: what a command is. One file and one line in commands.def make one.
 *
 * An arguments struct begins with a cli_common; `defaults` is such a struct, which
 * the parser overwrites. `run` gets the result and returns an exit code. */
#ifndef FROE_CLI_COMMAND_H
#define FROE_CLI_COMMAND_H
#include "args/options.h"
#include <jansson.h>

typedef struct cli_command {
    const char *name;
    const char *summary;  /**< one clause, for lists and the manual's NAME */
    const char *about;    /**< paragraphs parted by empty lines; for --help and the manual */
    const char *examples; /**< command lines, each ended by a newline */
    const cli_part *parts;
    const void *defaults;
    size_t size; /**< of the arguments */
    int (*run)(const void *args);
} cli_command;

/** The i-th command; NULL past the last. */
const cli_command *cli_command_at(size_t i);
/** The command of that name, or NULL. */
const cli_command *cli_command_named(const char *name);
/** Says that there is no such command, with a hint; returns the exit code. */
int cli_refuse_command(const char *name);
/** Parses the words after the name and runs the command; returns its exit code.
 * `report`, if given, receives the report it prints, or NULL; release it. */
int cli_run(const cli_command *command, int argc, char **argv, json_t **report);
#endif
