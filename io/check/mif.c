/* mif.c: whether lines and regions of a MIF file (of MapInfo) have as many points as they count, and these and other
 * objects numbers. GDAL takes what is no number for 0, and 1,5 for 1, and leaves out what is more.
 *
 *     Data
 *     Pline 2         or Pline Multiple 2, Region 2: as many parts, each a count and its points
 *     1 2.5
 *     3 4
 *         Pen (1,2,0)
 */
#include "check/check.h"
#include "support/decimal/decimal.h"
#include <stdlib.h>
#include <string.h>

typedef struct mif_check {
    size_t parts, points; /* still to come */
    bool listed;          /* no other numbers belong to the object */
} mif_check;

/* What stands behind a word; NULL: it is another one. */
static const char *behind(const char *line, const char *word) {
    for (; *word; line++, word++)
        if ((*line | 32) != *word) return NULL; /* in either case */
    return strchr(" \t\r\n", *line) ? line + strspn(line, " \t") : NULL;
}

static bool is_number(const char *at) {
    return *at >= '0' && *at <= '9';
}

/* How many numbers stand up to the end of the line; a comma may be behind each. SIZE_MAX: there is another word. */
static size_t numbers_at(const char *at) {
    size_t count = 0;
    for (char *end; *at && !strchr("\r\n", *at); at = end + strspn(end, " \t"), count++) {
        support_decimal(at, &end);
        if (end == at) return SIZE_MAX;
        end += *end == ',';
        if (!strchr(" \t\r\n", *end)) return SIZE_MAX;
    }
    return count;
}

/* Is the line of an object with numbers behind its word, of which one is none? */
static bool is_broken(const char *line) {
    static const char *const words[] = {"point", "line", "rect", "ellipse", "arc", "roundrect"};
    const char *next = NULL;
    for (size_t i = 0; i < sizeof words / sizeof *words && !next; i++) next = behind(line, words[i]);
    return numbers_at(next ? next : line) == SIZE_MAX && (next || strchr("+-.0123456789", *line));
}

/* The line of a word: is it of an object with points? */
static void look_at_object(mif_check *c, const char *line) {
    const char *next, *multiple = NULL;
    c->listed = true;
    if ((next = behind(line, "multipoint"))) {
        c->points = strtoul(next, NULL, 10);
    } else if ((next = behind(line, "region"))) {
        c->parts = strtoul(next, NULL, 10);
    } else if ((next = behind(line, "pline"))) {
        char *end = (char *)next;
        if ((multiple = behind(next, "multiple"))) c->parts = strtoul(multiple, &end, 10);
        end += strspn(end, " \t");
        if (is_number(end)) /* the first count stands here */
            c->points = strtoul(end, NULL, 10), c->parts -= c->parts > 0;
        else if (!multiple)
            c->parts = 1;
    } else {
        c->listed = false;
    }
}

static const char *look_at_line(mif_check *c, const char *line) {
    if (c->points) {
        c->points--;
        const size_t count = numbers_at(line);
        return count >= 2 && count != SIZE_MAX ? NULL : "A point is missing, or it is not two numbers.";
    }
    if (c->parts) {
        c->parts--, c->points = strtoul(line, NULL, 10);
        return is_number(line) ? NULL : "A count of points is missing.";
    }
    if (c->listed && *line && strchr("+-.0123456789", *line)) return "There are more points than were counted.";
    look_at_object(c, line);
    return c->listed || !is_broken(line) ? NULL : "A coordinate is not a number with a decimal point.";
}

static io_fault find_mif_fault(formats_sink *sink, const char *text) {
    mif_check c = {.points = 0};
    bool data = false;
    size_t line = 0;
    (void)sink;
    for (const char *at = text, *fault; *at; at += *at == '\n') {
        ++line;
        at += strspn(at, " \t\r");
        fault = data && *at != '\n' ? look_at_line(&c, at) : NULL;
        if (fault) return (io_fault){fault, line, FROE_E_FORMAT};
        const char *next = behind(at, "data"); /* a column may be called so, too */
        data = data || (next && strchr("\r\n", *next));
        at += strcspn(at, "\n");
    }
    const bool cut = c.points || c.parts;
    return (io_fault){cut ? "The file ends before all is there that was counted." : NULL, line, FROE_E_FORMAT};
}

froe_status io_mif_check(const formats_source *source, formats_sink *sink) {
    return io_text_look(source, sink, true, find_mif_fault);
}
