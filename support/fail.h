/* fail.h: how a failure gets its sentence. */
#ifndef FROE_SUPPORT_FAIL_H
#define FROE_SUPPORT_FAIL_H
#include "support/arithmetic.h"
#include <froe/froe.h>

/** Fills `diag` (unless NULL) with a printf-formatted sentence and returns `status`. */
froe_status support_fail(froe_diagnostic *diag, froe_status status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/** The same, with the place of the fault. FROE_NONE stands for what does not apply. */
froe_status support_fail_at(froe_diagnostic *diag, froe_status status, uint32_t object, uint32_t corner, uint32_t axis,
                            const char *format, ...) __attribute__((format(printf, 6, 7)));
/** FROE_E_MEMORY with its standard sentence. */
froe_status support_fail_memory(froe_diagnostic *diag);
/** FROE_E_CANCELLED with its standard sentence. */
froe_status support_fail_cancelled(froe_diagnostic *diag);

/** FROE_E_IO, or FROE_E_MEMORY where `error` is ENOMEM: "cannot DO 'PATH': REASON", of an errno value. */
froe_status support_fail_file(froe_diagnostic *diag, const char *doing, const char *path, int error);

/** The end of a path, short enough to leave room for the reason in a diagnostic. */
const char *support_short(const char *path);
/** What an errno value means, in words of the system, from the calling thread's own buffer. */
typedef struct support_reason {
    char text[96];
} support_reason;
support_reason support_errno(int error);
#endif
