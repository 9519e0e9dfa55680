/* status.c: names, sentences and details of failures. */
#include "base/status.h"
#include <stdarg.h>
#include <stdio.h>

static const char *const names[FROE_STATUS_COUNT] = {
    "FROE_OK",       "FROE_E_ARG",    "FROE_E_OPTIONS",   "FROE_E_MEMORY",      "FROE_E_INPUT",
    "FROE_E_LIMIT",  "FROE_E_BUDGET", "FROE_E_CANCELLED", "FROE_E_UNSUPPORTED", "FROE_E_IO",
    "FROE_E_FORMAT", "FROE_E_FROZEN", "FROE_E_AUDIT",
};
static const char *const texts[FROE_STATUS_COUNT] = {
    "ok",           "bad argument", "bad option",  "out of memory",          "bad input data",  "too large",
    "over budget",  "cancelled",    "unsupported", "input or output failed", "bad file format", "scene is frozen",
    "audit failed",
};

const char *froe_status_name(froe_status status) {
    return (unsigned)status < FROE_STATUS_COUNT ? names[status] : "FROE_E_?";
}

const char *froe_status_text(froe_status status) {
    return (unsigned)status < FROE_STATUS_COUNT ? texts[status] : "unknown status";
}

static void fill(froe_diagnostic *diag, froe_status status, uint32_t object, uint32_t corner, uint32_t axis,
                 const char *format, va_list args) {
    if (!diag) return;
    diag->status = status;
    diag->object = object;
    diag->corner = corner;
    diag->axis = axis;
    vsnprintf(diag->message, sizeof diag->message, format, args);
}

froe_status base_fail(froe_diagnostic *diag, froe_status status, const char *format, ...) {
    va_list args;
    va_start(args, format);
    fill(diag, status, FROE_NONE, FROE_NONE, FROE_NONE, format, args);
    va_end(args);
    return status;
}

froe_status base_fail_at(froe_diagnostic *diag, froe_status status, uint32_t object, uint32_t corner, uint32_t axis,
                         const char *format, ...) {
    va_list args;
    va_start(args, format);
    fill(diag, status, object, corner, axis, format, args);
    va_end(args);
    return status;
}

froe_status base_fail_memory(froe_diagnostic *diag) {
    return base_fail(diag, FROE_E_MEMORY, "out of memory");
}
