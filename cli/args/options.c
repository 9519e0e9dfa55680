/* options.c: the parser of command lines. Numbers are read whole or refused;
 * for an unknown name the message names the nearest known one. */
#include "args/options.h"
#include "args/output.h"
#include "exit.h"
#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const cli_option cli_common_options[] = {
    {"json", 0, CLI_FLAG, offsetof(cli_common, json), .help = "print one JSON object instead of text"},
    {"quiet", 'q', CLI_FLAG, offsetof(cli_common, quiet),
     .help = "no progress bar and no text; errors are still printed"},
    {"seed", 0, CLI_WHOLE, offsetof(cli_common, seed), "S", .help = "seed of all random choices (default 1)"},
    {"threads", 0, CLI_WHOLE, offsetof(cli_common, threads), "T",
     .help = "threads to use; no answer depends on it (default 0: one per processor)", .max = 1024},
    {"limit-memory", 0, CLI_WHOLE, offsetof(cli_common, limit_memory), "MB",
     .help = "end when more memory is needed, in megabytes beside program and libraries", .min = 1, .max = 1000000000},
    {"limit-time", 0, CLI_WHOLE, offsetof(cli_common, limit_time), "S", .help = "end after so many seconds", .min = 1,
     .max = 1000000000},
    {"help", 'h', CLI_FLAG, offsetof(cli_common, help), .help = "print this text"},
    {0},
};

/* ------------------------------------------------------------------ hints -- */

enum { NAME_MAX_LENGTH = 31 };

static size_t least(size_t a, size_t b) {
    return a < b ? a : b;
}

/* Letters to insert, drop, change or swap with a neighbour (optimal string alignment: Damerau's
 * distance in the table of Wagner and Fischer); long words are far from everything. */
static size_t distance(const char *a, const char *b) {
    const size_t rows = strlen(a), columns = strlen(b);
    if (rows > NAME_MAX_LENGTH || columns > NAME_MAX_LENGTH) return SIZE_MAX;
    size_t table[NAME_MAX_LENGTH + 1][NAME_MAX_LENGTH + 1];
    for (size_t i = 0; i <= rows; i++) table[i][0] = i;
    for (size_t j = 0; j <= columns; j++) table[0][j] = j;
    for (size_t i = 1; i <= rows; i++)
        for (size_t j = 1; j <= columns; j++) {
            const size_t change = table[i - 1][j - 1] + (a[i - 1] != b[j - 1]);
            table[i][j] = least(change, least(table[i - 1][j], table[i][j - 1]) + 1);
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                table[i][j] = least(table[i][j], table[i - 2][j - 2] + 1);
        }
    return table[rows][columns];
}

const char *cli_nearest(const char *word, const char *const *names, size_t count) {
    const char *best = NULL;
    size_t limit = strlen(word) < 4 ? 2 : 3; /* exclusive */
    for (size_t i = 0; i < count; i++) {
        const size_t d = distance(word, names[i]);
        if (d < limit) limit = d, best = names[i];
    }
    return best;
}

/* ---------------------------------------------------------------- look-up -- */

/* An option together with the struct it fills. */
typedef struct place {
    const cli_option *option;
    char *base;
} place;

static bool is_name(const char *known, const char *name, size_t length) {
    return known && strlen(known) == length && !memcmp(known, name, length);
}

/* The option of a word "--name", "--name=value", "-n" or "-nvalue". `value` is what is attached to it, or NULL. */
static place find_option(const cli_part *parts, void *args, const char *word, const char **value) {
    const bool is_long = word[1] == '-';
    const char *name = word + 1 + is_long;
    const size_t length = is_long ? strcspn(name, "=") : 1;
    *value = name[length] ? name + length + is_long : NULL;
    for (const cli_part *part = parts; part->title; part++)
        for (const cli_option *option = part->options; option->type; option++) {
            const bool same_name = is_name(option->name, name, length) || is_name(option->alias, name, length);
            if (is_long ? same_name : option->letter == *name) return (place){option, (char *)args + part->at};
        }
    return (place){0};
}

/* Is a word an option of the command by its long name? Then it is no value of the option before it. */
static bool is_option(const cli_part *parts, void *args, const char *word) {
    const char *value;
    return !strncmp(word, "--", 2) && find_option(parts, args, word, &value).option;
}

static place find_operand(const cli_part *parts, void *args, int position) {
    for (const cli_part *part = parts; part->title; part++)
        for (const cli_option *option = part->options; option->type; option++)
            if (!option->name && (option->type == CLI_TEXTS || position-- == 0))
                return (place){option, (char *)args + part->at};
    return (place){0};
}

static int refuse_unknown(const cli_part *parts, const char *word) {
    enum { MOST = 64 };
    const char *names[MOST];
    size_t count = 0;
    for (const cli_part *part = parts; part->title; part++)
        for (const cli_option *option = part->options; option->type; option++)
            if (option->name && count < MOST) names[count++] = option->name; /* one way: there are fewer */
    char name[NAME_MAX_LENGTH + 1] = "";
    const char *bare = word + strspn(word, "-");
    memcpy(name, bare, strcspn(bare, "=") < NAME_MAX_LENGTH ? strcspn(bare, "=") : NAME_MAX_LENGTH);
    const char *hint = cli_nearest(name, names, count);
    if (!hint) return cli_fail_unknown("option", word, NULL, "--help lists what there is.");
    snprintf(name, sizeof name, "--%.*s", NAME_MAX_LENGTH - 2, hint);
    return cli_fail_unknown("option", word, name, NULL);
}

/* ----------------------------------------------------------------- values -- */

static int refuse_value(const cli_option *option, const char *text, const char *wanted) {
    const char *const named = option->name ? option->name : option->value, *const dashes = option->name ? "--" : "";
    const char *const sentence = option->sentence;
    if (sentence) return cli_fail(CLI_USE, NULL, "%s%s: '%s' is not %s. %s", dashes, named, text, wanted, sentence);
    return cli_fail(CLI_USE, NULL, "%s%s: '%s' is not %s.", dashes, named, text, wanted);
}

static int set_whole(const cli_option *option, uint64_t *field, const char *text) {
    const uint64_t max = option->max ? option->max : UINT64_MAX;
    errno = 0;
    const uint64_t value = strtoumax(text, NULL, 10);
    const bool digits = *text && strspn(text, "0123456789") == strlen(text);
    if (digits && !errno && value >= option->min && value <= max) {
        *field = value;
        return 0;
    }
    char wanted[80];
    snprintf(wanted, sizeof wanted, "a whole number from %" PRIu64 " to %" PRIu64, option->min, max);
    return refuse_value(option, text, wanted);
}

/* Reads a finite number without leading blanks; returns where it ends, or NULL. */
static const char *read_real(const char *text, double *value) {
    char *end = NULL;
    if (!strchr("+-.0123456789", *text)) return NULL;
    *value = strtod(text, &end);
    return end != text && isfinite(*value) ? end : NULL;
}

static int set_reals(const cli_option *option, cli_reals *field, const char *text) {
    cli_reals list = {0};
    const char *at = text;
    while (list.count < sizeof list.at / sizeof *list.at && (at = read_real(at, &list.at[list.count])) != NULL) {
        list.count++;
        if (!*at) {
            *field = list;
            return 0;
        }
        if (*at++ != ',') break;
    }
    return refuse_value(option, text, "a list of finite numbers parted by commas");
}

static int set_choice(const cli_option *option, int *field, const char *text) {
    char wanted[160] = "one of";
    for (int i = 0; option->choices[i]; i++) {
        if (strcmp(text, option->choices[i]) == 0) {
            *field = i;
            return 0;
        }
        const size_t used = strlen(wanted);
        snprintf(wanted + used, sizeof wanted - used, "%s %s", i ? "," : "", option->choices[i]);
    }
    return refuse_value(option, text, wanted);
}

static int set_text(const cli_option *option, const char **field, const char *text) {
    /* Where a file is to be named, nothing is no name; other texts may be empty. */
    if (!*text && option->file) return refuse_value(option, text, "the name of a file");
    *field = text;
    return 0;
}

static int set_value(place found, const char *text) {
    void *field = found.base + found.option->at;
    switch (found.option->type) { /* one way: each type has a case */
    case CLI_TEXT:
        return set_text(found.option, field, text);
    case CLI_OUTPUT: {
        cli_output *output = field;
        const int code = set_text(found.option, &output->name, text);
        output->path = output->name;
        return code;
    }
    case CLI_TEXTS: {
        cli_texts *list = field;
        const size_t most = sizeof list->at / sizeof *list->at;
        if (list->count == most)
            return cli_fail(CLI_USE, NULL, "%s: There are more than %zu.", found.option->value, most);
        const int code = set_text(found.option, &list->at[list->count], text);
        list->count += !code;
        return code;
    }
    case CLI_WORDS: {
        char **words = field;
        const size_t before = *words ? strlen(*words) + 1 : 0, length = strlen(text);
        char *joined = realloc(*words, before + length + 1);
        if (!joined) return cli_fail_memory();
        if (before) joined[before - 1] = ' ';
        memcpy(joined + before, text, length + 1);
        *words = joined;
        return 0;
    }
    case CLI_WHOLE:
        return set_whole(found.option, field, text);
    case CLI_REAL: {
        double value;
        const char *end = read_real(text, &value);
        if (!end || *end) return refuse_value(found.option, text, "a finite number");
        *(double *)field = value;
        return 0;
    }
    case CLI_CHOICE:
        return set_choice(found.option, field, text);
    case CLI_REALS:
        return set_reals(found.option, field, text);
    case CLI_FLAG:
    case CLI_END: /* one way: the end of a list has no name */
        break;
    }
    *(bool *)field = true;
    return 0;
}

/* ------------------------------------------------------------------ words -- */

static bool is_set(const cli_option *option, const char *base) {
    const void *field = base + option->at;
    switch (option->type) {
    case CLI_OUTPUT:
        return ((const cli_output *)field)->name != NULL;
    case CLI_TEXTS:
        return ((const cli_texts *)field)->count != 0;
    default: /* CLI_TEXT */
        return *(const char *const *)field != NULL;
    }
}

static int check_required(const char *command, const cli_part *parts, void *args) {
    for (const cli_part *part = parts; part->title; part++)
        for (const cli_option *option = part->options; option->type; option++) {
            if (!option->required || is_set(option, (char *)args + part->at)) continue;
            if (!option->name)
                return cli_fail(CLI_USE, NULL, "%s is missing. froe %s --help lists what there is.", option->value,
                                command);
            if (!option->letter)
                return cli_fail(CLI_USE, NULL, "--%s %s is missing. froe %s --help lists what there is.", option->name,
                                option->value, command);
            return cli_fail(CLI_USE, NULL, "-%c %s is missing. froe %s --help lists what there is.", option->letter,
                            option->value, command);
        }
    return 0;
}

int cli_parse(const char *command, const cli_part *parts, int argc, char **argv, void *args) {
    bool only_operands = false;
    int next = 0, operands = 0;
    while (next < argc) {
        const char *word = argv[next++], *value = word;
        place found;
        if (only_operands || word[0] != '-' || !word[1]) {
            found = find_operand(parts, args, operands++);
            if (!found.option) return cli_fail(CLI_USE, NULL, "'%s' is one operand too many.", word);
        } else if (strcmp(word, "--") == 0) {
            only_operands = true;
            continue;
        } else {
            found = find_option(parts, args, word, &value);
            if (!found.option) return refuse_unknown(parts, word);
            const bool is_flag = found.option->type == CLI_FLAG;
            if (is_flag && value) return cli_fail(CLI_USE, NULL, "--%s: It takes no value.", found.option->name);
            if (!is_flag && !value) { /* it is the next word */
                if (next == argc || is_option(parts, args, argv[next]))
                    return cli_fail(CLI_USE, NULL, "--%s: It needs a value, %s.", found.option->name,
                                    found.option->value);
                value = argv[next++];
            }
        }
        const int code = set_value(found, value);
        if (code) return code;
    }
    return ((cli_common *)args)->help ? 0 : check_required(command, parts, args);
}

int cli_check_needs(const cli_need *needs, size_t count) {
    for (; count--; needs++)
        if (needs->given && !needs->met) return cli_fail(CLI_USE, NULL, "--%s: %s", needs->option, needs->sentence);
    return 0;
}

void cli_release(const cli_part *parts, void *args) {
    for (const cli_part *part = parts; part->title; part++)
        for (const cli_option *option = part->options; option->type; option++)
            if (option->type == CLI_WORDS) {
                char **field = (char **)((char *)args + part->at + option->at);
                free(*field);
                *field = NULL;
            }
}
