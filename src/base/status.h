/* status.h: how a failure gets its sentence. */
#ifndef FROE_BASE_STATUS_H
#define FROE_BASE_STATUS_H
#include <froe/froe.h>

/** Fills `diag` (unless NULL) with a printf-formatted sentence and returns `status`. */
froe_status base_fail(froe_diagnostic *diag, froe_status status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/** The same, naming the culprit. Use FROE_NONE for what does not apply. */
froe_status base_fail_at(froe_diagnostic *diag, froe_status status, uint32_t object, uint32_t corner, uint32_t axis,
                         const char *format, ...) __attribute__((format(printf, 6, 7)));
/** FROE_E_MEMORY with its standard sentence. */
froe_status base_fail_memory(froe_diagnostic *diag);
#endif
