/* status.c: names and clauses of statuses. */
#include "support/arithmetic.h"
#include <froe/froe.h>

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
