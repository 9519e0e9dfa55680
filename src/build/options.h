/* options.h: "name=value name=value" against a method's table of options.
 *
 *     info.options   [ public options .. | end | tuning .. | end ]
 *
 * Tuning is for tests and benches: constants that were chosen by measurement, and switches that leave a part of a
 * method out. It is set by build_tuned(). It is neither listed nor saved with a tree. */
#ifndef FROE_BUILD_OPTIONS_H
#define FROE_BUILD_OPTIONS_H
#include "build/method.h"

/* Numbers are read and written by the C library, so both are to be called in the locale "C". */

/** The table of tuning; NULL: there is none. */
const froe_option_info *options_tuning(const build_method *method);
/** Fills `value` with defaults, then with the settings, which may name tuning if `tuned`. FROE_E_OPTIONS with the
 * offending word. */
froe_status options_parse(const build_method *method, const char *settings, bool tuned, double *value,
                          froe_diagnostic *diag);
/** froe_build() with settings that may name tuning. */
froe_status build_tuned(froe_scene *scene, const froe_build_options *options, froe_tree **out, froe_diagnostic *diag);
/** Writes all public options back as text, NUL-terminated, so that the text reproduces them. */
void options_print(const build_method *method, const double *value, char *text, size_t capacity);
#endif
