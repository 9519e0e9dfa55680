/* exit.c: statuses to exit codes, in one table, and error messages. */
#include "exit.h"
#include "support/fail.h"
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static const unsigned char codes[FROE_STATUS_COUNT][3] = {
    /*                        reading        working        writing */
    [FROE_OK] = {CLI_YES, CLI_YES, CLI_YES},
    [FROE_E_ARG] = {CLI_USE, CLI_USE, CLI_USE},
    [FROE_E_OPTIONS] = {CLI_USE, CLI_USE, CLI_USE},
    [FROE_E_MEMORY] = {CLI_RESOURCES, CLI_RESOURCES, CLI_RESOURCES},
    [FROE_E_INPUT] = {CLI_INPUT, CLI_INPUT, CLI_INPUT},
    [FROE_E_LIMIT] = {CLI_RESOURCES, CLI_RESOURCES, CLI_RESOURCES},
    [FROE_E_BUDGET] = {CLI_RESOURCES, CLI_RESOURCES, CLI_RESOURCES},
    [FROE_E_CANCELLED] = {CLI_CANCELLED, CLI_CANCELLED, CLI_CANCELLED},
    [FROE_E_UNSUPPORTED] = {CLI_INPUT, CLI_USE, CLI_USE},
    [FROE_E_IO] = {CLI_INPUT, CLI_INPUT, CLI_RESOURCES},
    [FROE_E_FORMAT] = {CLI_INPUT, CLI_INPUT, CLI_INPUT},
    [FROE_E_FROZEN] = {CLI_USE, CLI_USE, CLI_USE},
    [FROE_E_AUDIT] = {CLI_NO, CLI_NO, CLI_NO},
};

static void say(const char *file, const char *format, va_list args) {
    fputs("froe: ", stderr);
    if (file) fprintf(stderr, "%s: ", file);
    vfprintf(stderr, format, args);
    fputc('\n', stderr);
}

int cli_fail(int code, const char *file, const char *format, ...) {
    va_list args;
    va_start(args, format);
    say(file, format, args);
    va_end(args);
    return code;
}

/* "object 17, corner 2: ", as far as it is known and the sentence does not name it already. */
static void place(char *out, size_t size, const froe_diagnostic *diag) {
    *out = '\0';
    if (diag->object == FROE_NONE || strstr(diag->message, "object ")) return;
    if (diag->corner == FROE_NONE)
        snprintf(out, size, "object %u: ", diag->object);
    else
        snprintf(out, size, "object %u, corner %u: ", diag->object, diag->corner);
}

/* The library names a file by the end of its path. A message that begins with it, as readers' do: what comes after. */
static const char *without_file(const char *reason, const char *file) {
    const char *end = support_short(file);
    const size_t length = strlen(end);
    return strncmp(reason, end, length) == 0 && strncmp(reason + length, ": ", 2) == 0 ? reason + length + 2 : reason;
}

/* Is the file in the message already, in quotes? */
static bool quotes(const char *reason, const char *file) {
    const char *end = support_short(file), *at = strstr(reason, end);
    return at && at > reason && at[-1] == '\'' && at[strlen(end)] == '\'';
}

int cli_fail_status(cli_stage stage, const char *file, froe_status status, const froe_diagnostic *diag) {
    const int code = (unsigned)status < FROE_STATUS_COUNT ? codes[status][stage] : CLI_USE;
    const bool told = diag && diag->status == status && diag->message[0];
    char where[64] = "";
    if (told) place(where, sizeof where, diag);
    const char *reason = told ? diag->message : froe_status_text(status);
    if (file) reason = without_file(reason, file);
    if (file && quotes(reason, file)) file = NULL;
    if (status == FROE_E_OPTIONS && stage != CLI_READING) file = NULL; /* the command line is wrong, not the file */
    int length = (int)strlen(reason);
    if (length && reason[length - 1] == '.') length--;
    return cli_fail(code, file, "%s%.*s", where, length, reason);
}
