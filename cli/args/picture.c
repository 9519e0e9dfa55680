/* picture.c: numbers and colours. */
#include "args/picture.h"
#include "exit.h"
#include "support/utf8.h"
#include <froe/render.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

void cli_set_number(double given, double *field) {
    if (!isnan(given)) *field = given;
}

int cli_check_ranges(const cli_range *r, size_t count) {
    for (; count--; r++)
        if (r->given < r->lo || r->given > r->hi)
            return cli_fail(CLI_USE, NULL, "--%s: '%g' is not a number from %g to %g.", r->option, r->given, r->lo,
                            r->hi);
    return 0;
}

int cli_check_text(const char *option, const char *text) {
    for (size_t length = 1; text && *text; text += length) {
        length = support_utf8_length(text);
        if (!length) return cli_fail(CLI_USE, NULL, "--%s: The text is not UTF-8.", option);
    }
    return 0;
}

int cli_set_background(const char *given, uint32_t *field) {
    if (!given) return 0;
    if (strcmp(given, "clear") == 0) {
        *field = FROE_DRAW_CLEAR;
        return 0;
    }
    if (strlen(given) != 6 || strspn(given, "0123456789abcdefABCDEF") != 6)
        return cli_fail(CLI_USE, NULL, "--background: '%s' is neither six hexadecimal digits nor clear.", given);
    *field = (uint32_t)strtoul(given, NULL, 16);
    return 0;
}
