/* options.h: what a command accepts, declared once as a table.
 *
 *     struct args { cli_common common; const char *scene; uint64_t leaf; };
 *     static const cli_option options[] = {
 *         {.type = CLI_TEXT, .at = offsetof(struct args, scene), .value = "SCENE", .required = true, .help = "..."},
 *         {"leaf", 'k', CLI_WHOLE, offsetof(struct args, leaf), "K", .help = "...", .max = 100},
 *         {0}};
 *
 * The parser, --help and the manual page all walk the same table. An entry
 * without a name is an operand, filled in the order of the command line. */
#ifndef FROE_CLI_OPTIONS_H
#define FROE_CLI_OPTIONS_H
#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/** What an option takes, and the type of the field it fills. */
typedef enum cli_type {
    CLI_END = 0,    /**< closes a table */
    CLI_FLAG = 1,   /**< nothing; bool */
    CLI_TEXT = 2,   /**< any text; const char * into argv */
    CLI_WORDS = 3,  /**< may be given again and again; char *, joined by blanks, owned by the arguments */
    CLI_WHOLE = 4,  /**< a whole number in [min, max]; uint64_t */
    CLI_REAL = 5,   /**< a finite number; double */
    CLI_CHOICE = 6, /**< one of `choices`; int, its position */
    CLI_REALS = 7,  /**< finite numbers parted by commas; cli_reals */
    CLI_TEXTS = 8,  /**< operands only: all that are left; cli_texts */
    CLI_OUTPUT = 9, /**< a file that is written; cli_output (output.h) */
} cli_type;

/** What happens to the file that an option names (overwrite.h). */
typedef enum cli_file {
    CLI_NO_FILE = 0, /**< the value is no name of a file */
    CLI_READ = 1,
    CLI_WRITTEN = 2,
} cli_file;

/** The value of a CLI_REALS option. */
typedef struct cli_reals {
    size_t count; /**< 0: not given */
    double at[16];
} cli_reals;

/** The value of a CLI_TEXTS operand. */
typedef struct cli_texts {
    size_t count;
    const char *at[64]; /**< into argv */
} cli_texts;

typedef struct cli_option {
    const char *name; /**< long name without its dashes; NULL: an operand */
    char letter;      /**< short name, or 0 */
    cli_type type;
    size_t at;                  /**< of the field in its struct */
    const char *value;          /**< what --help calls the value, e.g. "FILE" */
    const char *help;           /**< one or two lower-case clauses */
    bool required;              /**< of types CLI_TEXT, CLI_TEXTS and CLI_OUTPUT */
    uint64_t min, max;          /**< CLI_WHOLE; max 0: no limit */
    const char *const *choices; /**< CLI_CHOICE; ended by NULL */
    const char *alias;          /**< another long name, or NULL */
    cli_file file;              /**< CLI_TEXT, CLI_TEXTS, CLI_OUTPUT */
    const char *ending;         /**< CLI_OUTPUT: of standard output, where no format is named; or NULL */
    const char *sentence;       /**< behind the refusal of another value, or of standard output, or NULL */
} cli_option;

/** A table and where its struct lies within the command's arguments, so that
 * commands share tables. */
typedef struct cli_part {
    const char *title; /**< heading in --help; NULL ends a list of parts */
    const cli_option *options;
    size_t at;
} cli_part;

/** What every command accepts. The first member of every arguments struct. */
typedef struct cli_common {
    bool help, json, quiet;
    uint64_t seed, threads;
    uint64_t limit_memory, limit_time; /**< megabytes, seconds; 0: none */
    json_t **report;                   /**< set by cli_run(): receives the report too, or NULL */
} cli_common;
extern const cli_option cli_common_options[];
#define CLI_COMMON_DEFAULTS                                                                                            \
    { .seed = 1 }

/** Fills `args` from the words after the command's name. Returns 0, or an exit
 * code after saying on stderr what is wrong. --help excuses missing operands.
 * Messages name the command that tells more. */
int cli_parse(const char *command, const cli_part *parts, int argc, char **argv, void *args);
/** Frees what cli_parse() allocated within `args`. */
void cli_release(const cli_part *parts, void *args);

/** An option that does nothing but beside others. */
typedef struct cli_need {
    const char *option;   /**< one, or several: "places, --unrounded" */
    bool given, met;      /**< on the command line; what it needs is there */
    const char *sentence; /**< what it needs */
} cli_need;
/** CLI_USE, after saying so, for the first of `count` options that is given and whose need is not met, or 0. */
int cli_check_needs(const cli_need *needs, size_t count);

/** The one of `count` names closest to a mistyped word, or NULL when none is close. */
const char *cli_nearest(const char *word, const char *const *names, size_t count);
#endif
