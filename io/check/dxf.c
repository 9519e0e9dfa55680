/* dxf.c: whether the numbers of a DXF file are numbers. GDAL takes what they begin with, and none for 0: so 1,5 is 1.
 *
 *      10            a group: a code, and what it says of the entity; from 10 to 59 and from 210 to 239 a number
 *     1.5
 *
 * What is not of this form, as a binary file, is left to GDAL. */
#include "check/check.h"
#include "support/decimal/decimal.h"
#include <stdlib.h>
#include <string.h>

static const char *line_behind(const char *at) {
    at += strcspn(at, "\r\n");
    return at + (at[0] == '\r' && at[1] == '\n' ? 2 : *at != '\0');
}

static bool is_number(const char *at) {
    char *end;
    at += strspn(at, " \t");
    if (strchr("\r\n", *at)) return false; /* the number of another line would be taken */
    (void)support_decimal(at, &end);
    return end != at && strchr("\r\n", end[strspn(end, " \t")]); /* or the text ends */
}

static bool begins_with(const char *at, const char *word) {
    at += strspn(at, " \t");
    return !strncmp(at, word, strlen(word));
}

/* Numbers elsewhere than in entities, and in blocks of these, draw nothing. */
static io_fault find_dxf_fault(formats_sink *sink, const char *text) {
    const char *at = text;
    bool begun = false, drawn = false; /* a section, of entities */
    (void)sink;
    for (size_t line = 2; *at; line += 2) {
        char *end;
        const long code = strtol(at, &end, 10);
        if (end == at || !strchr(" \t\r\n", *end)) break;
        at = line_behind(at);
        const bool number = (code >= 10 && code < 60) || (code >= 210 && code < 240);
        if (drawn && number && *at && !is_number(at))
            return (io_fault){"This is not a number with a decimal point.", line, FROE_E_FORMAT};
        if (begun && code == 2) drawn = begins_with(at, "ENTITIES") || begins_with(at, "BLOCKS");
        begun = code == 0 && begins_with(at, "SECTION");
        at = line_behind(at);
    }
    return (io_fault){.sentence = NULL};
}

froe_status io_dxf_check(const formats_source *source, formats_sink *sink) {
    return io_text_look(source, sink, true, find_dxf_fault);
}
