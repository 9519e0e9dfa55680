/* fail.c: sentences and details of failures. */
#include "support/fail.h"
#include "support/utf8.h"
#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

void support_one_line(char *text) {
    while (*text) {
        const size_t length = support_utf8_length(text);
        if (!length || (unsigned char)*text < ' ' || *text == 0x7f) *text = '?';
        text += length ? length : 1;
    }
}

static void fill(froe_diagnostic *diag, froe_status status, uint32_t object, uint32_t corner, uint32_t axis,
                 const char *sentence, va_list args) {
    if (!diag) return;
    diag->status = status;
    diag->object = object;
    diag->corner = corner;
    diag->axis = axis;
    vsnprintf(diag->message, sizeof diag->message, sentence, args);
    support_one_line(diag->message);
}

froe_status support_fail(froe_diagnostic *diag, froe_status status, const char *sentence, ...) {
    va_list args;
    va_start(args, sentence);
    fill(diag, status, FROE_NONE, FROE_NONE, FROE_NONE, sentence, args);
    va_end(args);
    return status;
}

froe_status support_fail_at(froe_diagnostic *diag, froe_status status, uint32_t object, uint32_t corner, uint32_t axis,
                            const char *sentence, ...) {
    va_list args;
    va_start(args, sentence);
    fill(diag, status, object, corner, axis, sentence, args);
    va_end(args);
    return status;
}

froe_status support_fail_memory(froe_diagnostic *diag) {
    return support_fail(diag, FROE_E_MEMORY, "Out of memory.");
}

froe_status support_fail_cancelled(froe_diagnostic *diag) {
    return support_fail(diag, FROE_E_CANCELLED, "Cancelled.");
}

froe_status support_fail_null(froe_diagnostic *diag, const char *function) {
    return support_fail(diag, FROE_E_ARG, "An argument of %s is NULL.", function);
}

froe_status support_fail_defaults(froe_diagnostic *diag, const char *maker) {
    return support_fail(diag, FROE_E_OPTIONS, "The options do not come from %s().", maker);
}

void support_defaults(void *out, size_t size, const void *all, size_t known) {
    memcpy(out, all, size < known ? size : known);
    if (size > known) memset((char *)out + known, 0, size - known);
}

const char *support_short(const char *path) {
    enum { KEPT = 96 };
    size_t length = strlen(path);
    return length <= KEPT ? path : path + length - KEPT;
}

support_reason support_errno(int error) {
    support_reason reason;
    if (strerror_r(error, reason.text, sizeof reason.text))
        snprintf(reason.text, sizeof reason.text, "error %d", error);
    return reason;
}

froe_status support_fail_file(froe_diagnostic *diag, const char *done, const char *path, int error) {
    if (error == ENOMEM) return support_fail_memory(diag);
    return support_fail(diag, FROE_E_IO, "%s: The file cannot be %s: %s.", support_short(path), done,
                        support_errno(error).text);
}

froe_status support_fail_irregular(froe_diagnostic *diag, const char *path, unsigned mode) {
    const char *kind = S_ISDIR(mode) ? "a directory" : S_ISFIFO(mode) ? "a pipe" : "a device";
    return support_fail(diag, FROE_E_IO, "%s: It is %s, not a file.", support_short(path), kind);
}

froe_status support_fail_ending(froe_diagnostic *diag, froe_status status, const char *path, const char *what,
                                const char *endings) {
    return support_fail(diag, status, "%s: The ending of %s is %s.", support_short(path), what, endings);
}
