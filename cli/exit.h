/* exit.h: how a command ends, and what it says when it fails.
 *
 *     froe: FILE: object 17, corner 2: Reason as a sentence. */
#ifndef FROE_CLI_EXIT_H
#define FROE_CLI_EXIT_H
#include <froe/froe.h>

/** Exit codes. */
enum {
    CLI_YES = 0,         /**< done; the answer is yes */
    CLI_NO = 1,          /**< the answer is no (an audit failed) */
    CLI_USE = 2,         /**< bad use: command, option, method */
    CLI_INPUT = 3,       /**< bad input: a file or an object in it */
    CLI_RESOURCES = 4,   /**< out of memory, over a budget or a limit, or no room to write */
    CLI_CANCELLED = 130, /**< Ctrl-C, as shells report it; after another signal main() adds its number to 128 */
    CLI_PIPE = 141       /**< what was to be read has no reader any more, as shells report it */
};

/** What was being done when a call failed: the cause of the same status can be the input,
 * the command line or the disk. */
typedef enum cli_stage { CLI_READING, CLI_WORKING, CLI_WRITING } cli_stage;

/** Prints "froe: FILE: sentence" on stderr (file may be NULL) and returns `code`. */
int cli_fail(int code, const char *file, const char *sentence, ...) __attribute__((format(printf, 3, 4)));
/** CLI_RESOURCES, for memory that was refused. */
int cli_fail_memory(void);
/** CLI_CANCELLED, or CLI_RESOURCES when the time of --limit-time has passed; file may be NULL. */
int cli_fail_cancelled(const char *file);
/** `code`, for a file that cannot be read or written (`done`), with the reason in errno; as above where that is memory
 * or a signal. */
int cli_fail_file(int code, const char *file, const char *done);
/** CLI_USE, for an option of numbers that got `given` of them instead of `needed`. */
int cli_fail_count(const char *option, size_t given, size_t needed);
/** CLI_USE, for a name that is none: "There is no WHAT 'NAME'." and the name that was perhaps
 * meant, or the sentence that says what there is, or both. */
int cli_fail_unknown(const char *what, const char *name, const char *meant, const char *sentence);
/** The same for a failed call of the library: says object, corner and reason and
 * returns the exit code of the status. */
int cli_fail_status(cli_stage stage, const char *file, froe_status status, const froe_diagnostic *diag);
#endif
