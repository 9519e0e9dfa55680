/* render_lines.c: lists of kinds of lines, and of styles. */
#include "commands/render_lines.h"
#include "exit.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ------------------------------------------------------------------------- kinds -- */

/* The bit of the kind whose name this is; 0: there is none. */
static uint32_t kind_of(const char *name, size_t length) {
    for (uint32_t bit = 1; bit < FROE_LINE_END; bit <<= 1) {
        const char *known = froe_line_name((froe_line)bit);
        if (strlen(known) == length && memcmp(known, name, length) == 0) return bit;
    }
    return 0;
}

/* The names of all kinds, for messages. */
typedef struct kind_names {
    char text[160];
} kind_names;

static kind_names all_kinds(void) {
    kind_names names = {""};
    size_t used = 0;
    for (uint32_t bit = 1; bit < FROE_LINE_END; bit <<= 1) {
        const char *known = froe_line_name((froe_line)bit);
        snprintf(names.text + used, sizeof names.text - used, "%s%s", used ? ", " : "", known);
        used = strlen(names.text);
    }
    return names;
}

int render_set_lines(const char *list, uint32_t *lines) {
    if (!list) return 0;
    *lines = 0;
    while (*list && strcmp(list, "none") != 0) {
        const size_t length = strcspn(list, ",");
        const uint32_t kind = kind_of(list, length);
        if (!kind)
            return cli_fail(CLI_USE, NULL, "--line-kinds: '%.*s' is not one of %s.", (int)length, list,
                            all_kinds().text);
        *lines |= kind;
        list += length + (list[length] == ',');
    }
    return 0;
}

/* ------------------------------------------------------------------------ styles -- */

/* Which lines: a name of `length` bytes. False: it names none. */
static bool set_subject(const char *name, size_t length, froe_line_style *style) {
    static const char visible[] = "visible", hidden[] = "hidden";
    const size_t head = sizeof hidden - 1;
    if (length == sizeof visible - 1 && memcmp(name, visible, length) == 0) style->visible = UINT32_MAX;
    if (length >= head && memcmp(name, hidden, head) == 0) {
        if (length == head) style->hidden = UINT32_MAX;
        if (length > head && name[head] == '-') style->hidden = kind_of(name + head + 1, length - head - 1);
    } else if (!style->visible)
        style->visible = kind_of(name, length);
    return style->visible || style->hidden;
}

/* A number that is all of a field; NaN: it is none. */
static double number_of(const char *field, size_t length) {
    char *end;
    const double x = strtod(field, &end);
    return end == field + length && isfinite(x) ? x : NAN;
}

/* How: WIDTH:RRGGBB:DASH:GAP, up to `end`. */
static bool set_look(const char *look, const char *end, froe_line_style *style) {
    double *const numbers[] = {&style->width, NULL, &style->dash, &style->gap};
    int field = 0;
    for (; look <= end; field++) {
        const size_t length = strcspn(look, ":, ");
        if (field == 4) return false;
        if (length && numbers[field]) {
            *numbers[field] = number_of(look, length);
            if (isnan(*numbers[field])) return false;
        } else if (length) {
            if (length != 6 || strspn(look, "0123456789abcdefABCDEF") < 6) return false;
            style->colour = (uint32_t)strtoul(look, NULL, 16);
        }
        look += length + 1;
    }
    return isnan(style->dash) == isnan(style->gap);
}

int render_add_styles(const char *list, render_styles *styles) {
    while (list && *list) {
        const size_t length = strcspn(list, ", ");
        const char *equals = memchr(list, '=', length);
        froe_line_style style = froe_line_style_defaults();
        if (!equals || equals + 1 == list + length || !set_look(equals + 1, list + length, &style))
            return cli_fail(CLI_USE, NULL,
                            "--line-style: '%.*s' is not like crease=0.6, hidden=0.4:888888 or hidden=0.4:888888:4:2.",
                            (int)length, list);
        if (!set_subject(list, (size_t)(equals - list), &style))
            return cli_fail(CLI_USE, NULL,
                            "--line-style: '%.*s' is neither visible, hidden, a kind of lines, nor hidden- and a kind, "
                            "such as hidden-crease. The kinds are %s.",
                            (int)(equals - list), list, all_kinds().text);
        if (style.width <= 0 || style.width > 1e6)
            return cli_fail(CLI_USE, NULL, "--line-style: '%.*s' has a width that is not above 0 and up to 1e6.",
                            (int)length, list);
        if (!isnan(style.dash) && !(style.dash >= 0 && style.gap >= 0 && fmax(style.dash, style.gap) <= 1e6 &&
                                    (style.dash > 0) == (style.gap > 0)))
            return cli_fail(
                CLI_USE, NULL,
                "--line-style: '%.*s' has a dash and a gap that are not both above 0 and up to 1e6, nor both 0.",
                (int)length, list);
        if (styles->count == sizeof styles->at / sizeof *styles->at)
            return cli_fail(CLI_USE, NULL, "--line-style: '%.*s' is one style too many.", (int)length, list);
        styles->at[styles->count++] = style;
        list += length + (list[length] != '\0');
        list += strspn(list, " ");
    }
    return 0;
}
