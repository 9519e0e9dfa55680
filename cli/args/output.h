/* output.h: the file that a command writes, or standard output in its place.
 *
 *     args->output.path      where to write      args->output.name      what messages and reports call it
 *
 * Writers know a format by the ending of a file, and make a file appear whole or not at all. So for standard output, a
 * pipe or a device with --output-format, the command writes a file with that ending into a folder for temporary files,
 * which is copied when the command has ended well. cli_run() opens and closes; commands see the paths alone. */
#ifndef FROE_CLI_OUTPUT_H
#define FROE_CLI_OUTPUT_H
#include "args/options.h"
#include "files.h"
#include <froe/froe.h>

/** The value of a CLI_OUTPUT option, and of --output-format beside it. */
typedef struct cli_output {
    const char *name; /**< NULL: not given */
    const char *path;
    const char *format;      /**< of standard output, a pipe or a device; NULL: not given */
    char ending[CLI_ENDING]; /**< what `format` names */
    int target;              /**< a descriptor, to which the copy goes; only behind cli_output_open() */
    char folder[CLI_FOLDER]; /**< made for the copy; "": the file itself is written */
    char copy[4096];
} cli_output;

/** -o and --output-format of a command whose arguments are the struct T, with the cli_output `output`. MORE: members
 * of the first, as .required; with .ending = "froe", standard output needs no format. */
#define CLI_OUTPUT_OPTIONS(T, VALUE, HELP, ...)                                                                        \
    {"output", 'o', CLI_OUTPUT, offsetof(T, output), VALUE, .help = HELP, .file = CLI_WRITTEN, __VA_ARGS__}, {         \
        "output-format", 0, CLI_TEXT, offsetof(T, output.format), "EXT",                                               \
            .help = "of standard output (-o -) or a pipe: the usual extension of its files, e.g. svg"                  \
    }

/** CLI_USE, after saying so, for the file of an option that does not end in .ENDING; path NULL: 0. */
int cli_check_ending(const char *option, const char *path, const char *ending);
/** Prepares the output of a command, if it has one. Where that is standard output, what is printed goes to standard
 * error from here on. Returns 0, or an exit code after saying why. On success cli_output_close() must follow. */
int cli_output_open(const cli_part *parts, void *args);
/** Copies what was written, if `code` is 0, and removes the copy. Returns `code`, or another exit code after saying
 * why. A reader that has gone away is no failure to tell of. */
int cli_output_close(const cli_part *parts, void *args, int code);
/** As cli_fail_status(), for a call that did not write it. Where the copy itself could not be written, both are named.
 */
int cli_output_fail(const cli_output *output, froe_status status, const froe_diagnostic *diag);
#endif
