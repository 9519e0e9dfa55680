/* picture.h: values of options that several commands draw with. */
#ifndef FROE_CLI_PICTURE_ARGS_H
#define FROE_CLI_PICTURE_ARGS_H
#include <stdint.h>

/** Sets a field to a number that was given; NaN: it was not, and the field stays. */
void cli_set_number(double given, double *field);
/** Sets a field to --background: RRGGBB, or clear, FROE_DRAW_CLEAR. NULL: the field stays. Returns 0, or an exit code
 * after saying why. */
int cli_set_background(const char *given, uint32_t *field);
#endif
