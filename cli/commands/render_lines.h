/* render_lines.h: which lines a picture has, and how they are drawn, as said on the command line of froe render. */
#ifndef FROE_CLI_RENDER_LINES_H
#define FROE_CLI_RENDER_LINES_H
#include <froe/render.h>

/** All styles that a command line can give, and those of its preset. */
typedef struct render_styles {
    froe_line_style at[64];
    size_t count;
} render_styles;

/** --line-kinds KIND,...: sets the bits of the kinds; none: no bits. NULL: they stay. Returns 0 or an exit code, with a
 * message. */
int render_set_lines(const char *list, uint32_t *lines);
/** --line-style LINES=WIDTH:RRGGBB:DASH:GAP,... (or parted by blanks): appends a style for each. LINES are a kind,
 * hidden- and a kind, or visible or hidden for all kinds. A field that is empty, or missing at the end, stays as it is.
 * NULL: nothing is done. Returns 0 or an exit code, with a message. */
int render_add_styles(const char *list, render_styles *styles);
#endif
