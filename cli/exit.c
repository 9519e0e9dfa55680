/* exit.c: statuses to exit codes, in one table, and error messages. */
#include "exit.h"
#include "progress.h"
#include "support/fail.h"
#include <ctype.h>
#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#ifndef CLI_PROGRAM /* froe-mpi is built with some of these sources, too */
#define CLI_PROGRAM "froe"
#endif

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

int cli_fail(int code, const char *file, const char *sentence, ...) {
    enum { ROOM = 8192 }; /* a path of 4096 bytes, and more than any sentence has */
    char text[ROOM];
    va_list args;
    const int length = file ? snprintf(text, ROOM, "%s: ", file) : 0;
    const size_t at = length < ROOM ? (size_t)length : ROOM - 1;
    va_start(args, sentence);
    vsnprintf(text + at, ROOM - at, sentence, args);
    va_end(args);
    support_one_line(text);
    fprintf(stderr, CLI_PROGRAM ": %s\n", text);
    return code;
}

int cli_fail_memory(void) {
    return cli_fail(CLI_RESOURCES, NULL, "Out of memory.");
}

int cli_fail_cancelled(const char *file) {
    if (cli_late()) return cli_fail(CLI_RESOURCES, file, "It takes longer than --limit-time allows.");
    return cli_fail(CLI_CANCELLED, file, "Cancelled.");
}

int cli_fail_file(int code, const char *file, const char *done) {
    const int error = errno;
    if (error == ENOMEM) return cli_fail(CLI_RESOURCES, file, "Out of memory.");
    if (error == EINTR && cli_interrupted()) return cli_fail_cancelled(file);
    return cli_fail(code, file, "The file cannot be %s: %s.", done, support_errno(error).text);
}

int cli_fail_count(const char *option, size_t given, size_t needed) {
    return cli_fail(CLI_USE, NULL, "--%s: There %s %zu number%s, and %zu are needed.", option,
                    given == 1 ? "is" : "are", given, support_plural(given), needed);
}

int cli_fail_unknown(const char *what, const char *name, const char *meant, const char *sentence) {
    if (!meant) return cli_fail(CLI_USE, NULL, "There is no %s '%s'. %s", what, name, sentence);
    if (!sentence) return cli_fail(CLI_USE, NULL, "There is no %s '%s'. Did you mean '%s'?", what, name, meant);
    return cli_fail(CLI_USE, NULL, "There is no %s '%s'. Did you mean '%s'? %s", what, name, meant, sentence);
}

int cli_fail_status(cli_stage stage, const char *file, froe_status status, const froe_diagnostic *diag) {
    if (status == FROE_E_CANCELLED) return cli_fail_cancelled(file);
    const int code = codes[status][stage];
    if (diag->status != status) return cli_fail(code, file, "The call failed: %s.", froe_status_text(status));
    const char *sentence = diag->message;
    bool inside = false; /* does it name a file in the folder `file`? */
    if (file) {          /* The library names a file by the end of its path. Messages of readers begin with it. */
        char end[sizeof diag->message];
        snprintf(end, sizeof end, "%s", support_short(file));
        support_one_line(end);
        const size_t length = strlen(end);
        const bool begins = strncmp(sentence, end, length) == 0;
        inside = begins && sentence[length] == '/';
        if (inside)
            sentence += length;
        else if (begins && strncmp(sentence + length, ": ", 2) == 0)
            sentence += length + 2;
    }
    /* The sentence may name the object already, as such or as "segment 17: ". A reader names a row or a feature. */
    bool named = inside || strstr(sentence, "object ") || (stage == CLI_READING && islower((unsigned char)*sentence));
    for (int kind = 0; kind < FROE_KIND_COUNT; kind++) {
        const char *name = froe_kind_name((froe_kind)kind);
        const size_t length = strlen(name);
        named = named || (strncmp(sentence, name, length) == 0 && sentence[length] == ' ');
    }
    char where[64] = ""; /* sentences that know a corner name it */
    if (diag->object != FROE_NONE && !named) snprintf(where, sizeof where, "object %u: ", diag->object);
    if (status == FROE_E_OPTIONS && stage != CLI_READING && sentence == diag->message)
        file = NULL; /* the command line is wrong, not the file */
    if (inside) return cli_fail(code, NULL, "%s%s", file, sentence);
    return cli_fail(code, file, "%s%s", where, sentence);
}
