/* fail.h: how a failure gets its sentence.
 *
 * Every message has one form, which scripts/check-messages holds: places, each with a colon, then whole sentences,
 *
 *     map.csv: row 3: '1e' is not a number.
 *     There is no method 'x'. There are: bar, density.
 *
 * and each cause has one wording. A parameter called `sentence` is a message, or what stands at the end of one. */
#ifndef FROE_SUPPORT_FAIL_H
#define FROE_SUPPORT_FAIL_H
#include "support/arithmetic.h"
#include <froe/froe.h>
#include <stdint.h>

/** Fills `diag` (unless NULL) with a printf-formatted sentence and returns `status`. */
froe_status support_fail(froe_diagnostic *diag, froe_status status, const char *sentence, ...)
    __attribute__((format(printf, 3, 4)));
/** The same, with the place of the fault. FROE_NONE stands for what does not apply. */
froe_status support_fail_at(froe_diagnostic *diag, froe_status status, uint32_t object, uint32_t corner, uint32_t axis,
                            const char *sentence, ...) __attribute__((format(printf, 6, 7)));
/** FROE_E_MEMORY: "Out of memory." */
froe_status support_fail_memory(froe_diagnostic *diag);
/** FROE_E_CANCELLED: "Cancelled." */
froe_status support_fail_cancelled(froe_diagnostic *diag);
/** FROE_E_ARG: "An argument of FUNCTION is NULL." */
froe_status support_fail_null(froe_diagnostic *diag, const char *function);
/** FROE_E_OPTIONS: "The options do not come from MAKER()." */
froe_status support_fail_defaults(froe_diagnostic *diag, const char *maker);
/** What MAKER_into() does: writes the first `size` bytes of `all`, of `known` bytes, to `out`. A program that was
 * compiled when the struct was shorter has no room for more; what a newer program has beyond them becomes 0. */
void support_defaults(void *out, size_t size, const void *all, size_t known);
/** FROE_E_IO, or FROE_E_MEMORY where `error` is ENOMEM: "PATH: The file cannot be DONE: REASON.", of an errno value. */
froe_status support_fail_file(froe_diagnostic *diag, const char *done, const char *path, int error);
/** FROE_E_IO for an input that is not a regular file, by its mode (stat()): "PATH: It is a directory, not a file.", or
 * a pipe, or a device. */
froe_status support_fail_irregular(froe_diagnostic *diag, const char *path, unsigned mode);
/** `status` for an extension that is not among those that there are: "PATH: The ending of WHAT is ENDINGS." */
froe_status support_fail_ending(froe_diagnostic *diag, froe_status status, const char *path, const char *what,
                                const char *endings);

/** The ending of the noun behind a number: "s" unless that is 1. */
static inline const char *support_plural(uint64_t count) {
    return count == 1 ? "" : "s";
}
/** Replaces control characters, which would end the line or command a terminal, and bytes that are no UTF-8, such as
 * the first of a character at which a long name was cut, by question marks. support_fail() does so. */
void support_one_line(char *text);
/** The end of a path, short enough to leave room for the reason in a diagnostic. */
const char *support_short(const char *path);
/** What an errno value means, in words of the system, from the calling thread's own buffer. */
typedef struct support_reason {
    char text[96];
} support_reason;
support_reason support_errno(int error);
#endif
