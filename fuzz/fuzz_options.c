/* fuzz_options.c: bytes as a command line: words between zeros, for a table with an option of every type. What is taken
 * lies within the ranges that the table tells; what is refused ends with an exit code. */
#include "args/options.h"
#include "args/output.h"
#include "exit.h"
#include "support.h"
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_WORDS = 40, MOST_BYTES = 500 };

typedef struct all_types {
    cli_common common;
    bool flag;
    const char *text;
    char *words;
    uint64_t whole;
    double real;
    int choice;
    cli_reals reals;
    cli_texts texts;
    cli_output output;
} all_types;

static const char *const choices[] = {"red", "green", "blue", NULL};

static const cli_option table[] = {
    {.type = CLI_TEXTS, .at = offsetof(all_types, texts), .value = "FILE", .help = "files"},
    {.name = "flag", .letter = 'f', .type = CLI_FLAG, .at = offsetof(all_types, flag), .help = "a flag"},
    {.name = "text", .letter = 't', .type = CLI_TEXT, .at = offsetof(all_types, text), .value = "T", .help = "a text"},
    {.name = "words", .type = CLI_WORDS, .at = offsetof(all_types, words), .value = "W", .help = "words"},
    {.name = "whole",
     .letter = 'n',
     .type = CLI_WHOLE,
     .at = offsetof(all_types, whole),
     .value = "N",
     .min = 3,
     .max = 1000,
     .help = "a number",
     .alias = "count"},
    {.name = "real", .type = CLI_REAL, .at = offsetof(all_types, real), .value = "R", .help = "a number"},
    {.name = "choice",
     .type = CLI_CHOICE,
     .at = offsetof(all_types, choice),
     .value = "C",
     .choices = choices,
     .help = "a choice"},
    {.name = "reals", .type = CLI_REALS, .at = offsetof(all_types, reals), .value = "R,...", .help = "numbers"},
    {.name = "output",
     .letter = 'o',
     .type = CLI_OUTPUT,
     .at = offsetof(all_types, output),
     .value = "FILE",
     .help = "a file",
     .file = CLI_WRITTEN,
     .ending = "csv"},
    {0},
};

static const cli_part parts[] = {{"All types", table, 0}, {"Options", cli_common_options, 0}, {0}};

/* In place of cli/exit.c, as there are thousands of refusals a second: sentences are put together and not told. */
int cli_fail(int code, const char *file, const char *sentence, ...) {
    char told[4000];
    va_list list;
    va_start(list, sentence);
    vsnprintf(told, sizeof told, sentence, list);
    va_end(list);
    if (!strchr(told, '.') || (file && !*file)) abort();
    return code;
}

int cli_fail_unknown(const char *what, const char *name, const char *meant, const char *sentence) {
    return cli_fail(CLI_USE, NULL, "There is no %s '%s'. %s %s", what, name, meant ? meant : "", sentence);
}

int cli_fail_count(const char *option, size_t given, size_t needed) {
    return cli_fail(CLI_USE, NULL, "%s: %zu of %zu.", option, given, needed);
}

int cli_fail_memory(void) {
    return CLI_RESOURCES;
}

static void check(const all_types *a) {
    const froe_diagnostic why = {.message = "a value lies beyond its range"};
    bool good = a->whole >= 3 && a->whole <= 1000 && isfinite(a->real) && a->choice >= 0 && a->choice < 3;
    good = good && a->reals.count <= 16 && a->texts.count <= 64 && a->common.threads <= 1024;
    for (size_t i = 0; i < a->reals.count && good; i++) good = isfinite(a->reals.at[i]);
    for (size_t i = 0; i < a->texts.count && good; i++) good = a->texts.at[i] != NULL;
    if (!good) fuzz_complain("options", &why);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    char text[MOST_BYTES + 1] = {0}, *words[MOST_WORDS + 1] = {NULL};
    int count = 0;
    if (size > MOST_BYTES) size = MOST_BYTES;
    if (size) memcpy(text, data, size);
    for (size_t at = 0; at < size && count < MOST_WORDS; at += strlen(text + at) + 1) words[count++] = text + at;
    all_types args = {.common = CLI_COMMON_DEFAULTS, .whole = 3};
    const int code = cli_parse("build", parts, count, words, &args);
    if (code == 0) check(&args);
    if (code < 0 || code > 4) abort();
    cli_release(parts, &args);
    return 0;
}
