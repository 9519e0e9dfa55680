/* options.h: "name=value name=value" against a method's table of options. */
#ifndef FROE_BUILD_OPTIONS_H
#define FROE_BUILD_OPTIONS_H
#include "build/method.h"

/* Numbers are read and written by the C library, so both are to be called in the locale "C". */

/** Fills `value` with defaults, then with the settings. FROE_E_OPTIONS with the offending word. */
froe_status options_parse(const build_method *method, const char *settings, double *value, froe_diagnostic *diag);
/** Writes all options back as text, NUL-terminated, so that the text reproduces them. */
void options_print(const build_method *method, const double *value, char *text, size_t capacity);
#endif
