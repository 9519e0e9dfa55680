/* picture.h: values of options that several commands draw with. */
#ifndef FROE_CLI_PICTURE_ARGS_H
#define FROE_CLI_PICTURE_ARGS_H
#include <stddef.h>
#include <stdint.h>

/** Sets a field to a number that was given; NaN: it was not, and the field stays. */
void cli_set_number(double given, double *field);
/** A number given to --OPTION, and what it may be. */
typedef struct cli_range {
    const char *option;
    double given, lo, hi; /**< given: NaN if it was not */
} cli_range;
/** Returns 0, or an exit code after saying which number is out of its range. */
int cli_check_ranges(const cli_range *ranges, size_t count);
/** The same of a text that has to be UTF-8; NULL: it was not given. */
int cli_check_text(const char *option, const char *text);
/** Sets a field to --background: RRGGBB, or clear, FROE_DRAW_CLEAR. NULL: the field stays. Returns 0, or an exit code
 * after saying why. */
int cli_set_background(const char *given, uint32_t *field);
#endif
